//! Everything around the entities that AutoCAD wants to see in a drawing: header, tables, blocks and
//! objects. `assets/drawing/frame.dxf` holds it, with a line `@…` for each value that depends on the curves.

use glam::DVec3;

use super::writer::Writer;
use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;

/// The drawing without layers and entities. Its handles are below those of entities.
const FRAME: &str = include_str!("../../../assets/drawing/frame.dxf");

/// The handle of the table of layers in the frame.
const LAYER_TABLE: u64 = 0x3;

/// A unit as `$INSUNITS` counts them; 0 says that there is none.
fn unit_code(unit: Option<LengthUnit>) -> i64 {
    match unit {
        None => 0,
        Some(LengthUnit::Inch) => 1,
        Some(LengthUnit::Millimetre) => 4,
        Some(LengthUnit::Centimetre) => 5,
        Some(LengthUnit::Metre) => 6,
    }
}

/// A layer of the drawing.
pub(super) struct Layer {
    name: String,
    colour: i64,
    visible: bool,
    locked: bool,
}

impl Layer {
    /// Make a layer, of polygons if a kind is given.
    pub(super) fn new(
        name: String,
        polygon: Option<PolygonKind>,
        visible: bool,
        locked: bool,
    ) -> Self {
        Self {
            name,
            // AutoCAD's numbers: 7 is black or white, whatever the background is not.
            colour: match polygon {
                None => 7,
                Some(PolygonKind::Float) => 5,
                Some(PolygonKind::Clamped) => 3,
                Some(PolygonKind::Bezier) => 6,
            },
            visible,
            locked,
        }
    }
}

/// Put layers and entities into the frame; `low` and `high` are the corners of the box around them.
pub(super) fn drawing(
    layers: &[Layer],
    entities: Writer,
    unit: Option<LengthUnit>,
    (low, high): (DVec3, DVec3),
) -> String {
    let mut records = Writer::following(&entities);
    for layer in layers {
        write_layer(&mut records, layer);
    }
    let next_handle = records.next_handle();
    let (layer_records, entities) = (records.into_text(), entities.into_text());
    let mut writer = Writer::new();
    for line in FRAME.split_inclusive('\n') {
        match line.trim_end() {
            "@low 10" => writer.point(10, low),
            "@high 10" => writer.point(10, high),
            "@low 14" => writer.point(14, low),
            "@high 15" => writer.point(15, high),
            "@unit" => writer.integer(70, unit_code(unit)),
            "@metric" => writer.integer(70, i64::from(unit != Some(LengthUnit::Inch))),
            "@next handle" => writer.handle(5, next_handle),
            "@middle 12" => {
                writer.number(12, 0.5 * (low.x + high.x));
                writer.number(22, 0.5 * (low.y + high.y));
            }
            "@height 40" => writer.number(40, view_height(high - low)),
            "@layer count" => writer.count(70, layers.len() + 1),
            "@layers" => writer.append(&layer_records),
            "@entities" => writer.append(&entities),
            _ => writer.append(line),
        }
    }
    writer.into_text()
}

/// The height of a view that shows everything and is twice as wide as high.
fn view_height(size: DVec3) -> f64 {
    let height = 1.1 * size.y.max(0.5 * size.x);
    if height > 0.0 { height } else { 1.0 }
}

fn write_layer(writer: &mut Writer, layer: &Layer) {
    let handle = writer.take_handle();
    writer.text(0, "LAYER");
    writer.handle(5, handle);
    writer.handle(330, LAYER_TABLE);
    writer.text(100, "AcDbSymbolTableRecord");
    writer.text(100, "AcDbLayerTableRecord");
    writer.text(2, &layer.name);
    writer.integer(70, if layer.locked { 4 } else { 0 });
    // A negative colour turns the layer off.
    let sign = if layer.visible { 1 } else { -1 };
    writer.integer(62, sign * layer.colour);
    writer.text(6, "Continuous");
}
