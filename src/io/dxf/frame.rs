//! Everything around the entities that AutoCAD wants to see in a drawing: header, tables,
//! blocks and objects.

use glam::DVec3;

use super::writer::{MODEL_SPACE, Writer};
use crate::document::Curve;
use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;

/// A table of the drawing.
struct Table {
    name: &'static str,
    handle: u64,
    /// What its records are: the part of their class between `AcDb` and `TableRecord`.
    class: &'static str,
}

const fn table(name: &'static str, handle: u64, class: &'static str) -> Table {
    Table {
        name,
        handle,
        class,
    }
}

const VIEWPORTS: Table = table("VPORT", 0x1, "Viewport");
const LINE_TYPES: Table = table("LTYPE", 0x2, "Linetype");
const LAYERS: Table = table("LAYER", 0x3, "Layer");
const TEXT_STYLES: Table = table("STYLE", 0x4, "TextStyle");
const VIEWS: Table = table("VIEW", 0x5, "View");
const COORDINATE_SYSTEMS: Table = table("UCS", 0x6, "UCS");
const APPLICATIONS: Table = table("APPID", 0x7, "RegApp");
const DIMENSION_STYLES: Table = table("DIMSTYLE", 0x8, "DimStyle");
const BLOCK_RECORDS: Table = table("BLOCK_RECORD", 0x9, "Block");

// The other handles of the frame; those of entities begin above.
const VIEWPORT: u64 = 0xA;
const TEXT_STYLE: u64 = 0xB;
const PAPER_SPACE: u64 = 0x11;
const ROOT: u64 = 0x20;
const GROUPS: u64 = 0x21;
const LAYOUTS: u64 = 0x22;
const MODEL_LAYOUT: u64 = 0x23;
const PAPER_LAYOUT: u64 = 0x24;

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
    /// Make the layer of a curve, or of one of its polygons.
    pub(super) fn of(curve: &Curve, name: String, polygon: Option<PolygonKind>) -> Self {
        Self {
            name,
            // AutoCAD's numbers: 7 is black or white, whatever the background is not.
            colour: match polygon {
                None => 7,
                Some(PolygonKind::Float) => 5,
                Some(PolygonKind::Clamped) => 3,
                Some(PolygonKind::Bezier) => 6,
            },
            visible: curve.visible,
            locked: curve.locked,
        }
    }
}

/// Put the entities into a whole drawing.
pub(super) fn drawing(
    layers: &[Layer],
    entities: Writer,
    unit: Option<LengthUnit>,
    reach: (DVec3, DVec3),
) -> String {
    let mut rest = Writer::following(&entities);
    section(&mut rest, "CLASSES", |_| {});
    section(&mut rest, "TABLES", |writer| tables(writer, layers, reach));
    section(&mut rest, "BLOCKS", blocks);
    let entities = entities.into_text();
    section(&mut rest, "ENTITIES", |writer| writer.append(&entities));
    section(&mut rest, "OBJECTS", |writer| objects(writer, reach));
    rest.text(0, "EOF");
    let mut writer = Writer::new();
    let free_handle = rest.next_handle();
    section(&mut writer, "HEADER", |writer| {
        header(writer, free_handle, unit, reach)
    });
    writer.append(&rest.into_text());
    writer.into_text()
}

fn section(writer: &mut Writer, name: &str, content: impl FnOnce(&mut Writer)) {
    writer.text(0, "SECTION");
    writer.text(2, name);
    content(writer);
    writer.text(0, "ENDSEC");
}

fn header(
    writer: &mut Writer,
    free_handle: u64,
    unit: Option<LengthUnit>,
    (low, high): (DVec3, DVec3),
) {
    writer.text(9, "$ACADVER");
    writer.text(1, "AC1015");
    writer.text(9, "$DWGCODEPAGE");
    writer.text(3, "ANSI_1252");
    writer.text(9, "$INSBASE");
    writer.point(10, DVec3::ZERO);
    writer.text(9, "$EXTMIN");
    writer.point(10, low);
    writer.text(9, "$EXTMAX");
    writer.point(10, high);
    writer.text(9, "$INSUNITS");
    writer.integer(70, unit_code(unit));
    writer.text(9, "$MEASUREMENT");
    writer.integer(70, i64::from(unit != Some(LengthUnit::Inch)));
    writer.text(9, "$HANDSEED");
    writer.handle(5, free_handle);
}

fn tables(writer: &mut Writer, layers: &[Layer], bounds: (DVec3, DVec3)) {
    view(writer, bounds);
    line_types(writer);
    layer_table(writer, layers);
    text_styles(writer);
    VIEWS.write(writer, 0, |_| {});
    COORDINATE_SYSTEMS.write(writer, 0, |_| {});
    applications(writer);
    dimension_styles(writer);
    block_records(writer);
}

/// The view shows everything, twice as wide as high.
fn view(writer: &mut Writer, (low, high): (DVec3, DVec3)) {
    VIEWPORTS.write(writer, 1, |writer| {
        VIEWPORTS.record(writer, VIEWPORT);
        let (middle, size) = (0.5 * (low + high), high - low);
        writer.text(2, "*Active");
        writer.integer(70, 0);
        flat_point(writer, 10, 0.0, 0.0);
        flat_point(writer, 11, 1.0, 1.0);
        flat_point(writer, 12, middle.x, middle.y);
        flat_point(writer, 13, 0.0, 0.0);
        flat_point(writer, 14, 10.0, 10.0);
        flat_point(writer, 15, 10.0, 10.0);
        writer.point(16, DVec3::Z);
        writer.point(17, DVec3::ZERO);
        let height = 1.1 * size.y.max(0.5 * size.x);
        writer.number(40, if height > 0.0 { height } else { 1.0 });
        writer.number(41, 2.0);
        writer.number(42, 50.0);
    });
}

fn line_types(writer: &mut Writer) {
    LINE_TYPES.write(writer, 3, |writer| {
        for name in ["ByBlock", "ByLayer", "Continuous"] {
            let handle = writer.take_handle();
            LINE_TYPES.record(writer, handle);
            writer.text(2, name);
            writer.integer(70, 0);
            writer.text(3, "");
            writer.integer(72, 65);
            writer.integer(73, 0);
            writer.number(40, 0.0);
        }
    });
}

fn layer_table(writer: &mut Writer, layers: &[Layer]) {
    LAYERS.write(writer, layers.len() + 1, |writer| {
        let zero = Layer {
            name: "0".to_owned(),
            colour: 7,
            visible: true,
            locked: false,
        };
        for layer in std::iter::once(&zero).chain(layers) {
            let handle = writer.take_handle();
            LAYERS.record(writer, handle);
            writer.text(2, &layer.name);
            writer.integer(70, if layer.locked { 4 } else { 0 });
            // A negative colour turns the layer off.
            let sign = if layer.visible { 1 } else { -1 };
            writer.integer(62, sign * layer.colour);
            writer.text(6, "Continuous");
        }
    });
}

fn text_styles(writer: &mut Writer) {
    TEXT_STYLES.write(writer, 1, |writer| {
        TEXT_STYLES.record(writer, TEXT_STYLE);
        writer.text(2, "Standard");
        writer.integer(70, 0);
        writer.number(40, 0.0);
        writer.number(41, 1.0);
        writer.number(50, 0.0);
        writer.integer(71, 0);
        writer.number(42, 2.5);
        writer.text(3, "txt");
        writer.text(4, "");
    });
}

fn applications(writer: &mut Writer) {
    APPLICATIONS.write(writer, 1, |writer| {
        let handle = writer.take_handle();
        APPLICATIONS.record(writer, handle);
        writer.text(2, "ACAD");
        writer.integer(70, 0);
    });
}

fn block_records(writer: &mut Writer) {
    BLOCK_RECORDS.write(writer, 2, |writer| {
        for (handle, name, layout) in [
            (MODEL_SPACE, "*Model_Space", MODEL_LAYOUT),
            (PAPER_SPACE, "*Paper_Space", PAPER_LAYOUT),
        ] {
            BLOCK_RECORDS.record(writer, handle);
            writer.text(2, name);
            writer.handle(340, layout);
        }
    });
}

fn dimension_styles(writer: &mut Writer) {
    DIMENSION_STYLES.begin(writer, 1);
    writer.text(100, "AcDbDimStyleTable");
    writer.integer(71, 1);
    let handle = writer.take_handle();
    writer.text(0, "DIMSTYLE");
    // The one record whose handle has another code.
    writer.handle(105, handle);
    writer.handle(330, DIMENSION_STYLES.handle);
    writer.text(100, "AcDbSymbolTableRecord");
    writer.text(100, "AcDbDimStyleTableRecord");
    writer.text(2, "Standard");
    writer.integer(70, 0);
    writer.handle(340, TEXT_STYLE);
    writer.text(0, "ENDTAB");
}

impl Table {
    fn write(&self, writer: &mut Writer, records: usize, content: impl FnOnce(&mut Writer)) {
        self.begin(writer, records);
        content(writer);
        writer.text(0, "ENDTAB");
    }

    fn begin(&self, writer: &mut Writer, records: usize) {
        writer.text(0, "TABLE");
        writer.text(2, self.name);
        writer.handle(5, self.handle);
        writer.handle(330, 0);
        writer.text(100, "AcDbSymbolTable");
        writer.count(70, records);
    }

    fn record(&self, writer: &mut Writer, handle: u64) {
        writer.text(0, self.name);
        writer.handle(5, handle);
        writer.handle(330, self.handle);
        writer.text(100, "AcDbSymbolTableRecord");
        writer.text(100, &format!("AcDb{}TableRecord", self.class));
    }
}

fn blocks(writer: &mut Writer) {
    for (record, name, paper) in [
        (MODEL_SPACE, "*Model_Space", false),
        (PAPER_SPACE, "*Paper_Space", true),
    ] {
        let begin = |writer: &mut Writer, entity: &str, class: &str| {
            let handle = writer.take_handle();
            writer.text(0, entity);
            writer.handle(5, handle);
            writer.handle(330, record);
            writer.text(100, "AcDbEntity");
            if paper {
                writer.integer(67, 1);
            }
            writer.text(8, "0");
            writer.text(100, class);
        };
        begin(writer, "BLOCK", "AcDbBlockBegin");
        writer.text(2, name);
        writer.integer(70, 0);
        writer.point(10, DVec3::ZERO);
        writer.text(3, name);
        writer.text(1, "");
        begin(writer, "ENDBLK", "AcDbBlockEnd");
    }
}

fn objects(writer: &mut Writer, reach: (DVec3, DVec3)) {
    dictionary(
        writer,
        ROOT,
        0,
        &[("ACAD_GROUP", GROUPS), ("ACAD_LAYOUT", LAYOUTS)],
    );
    dictionary(writer, GROUPS, ROOT, &[]);
    let layouts = [("Model", MODEL_LAYOUT), ("Layout1", PAPER_LAYOUT)];
    dictionary(writer, LAYOUTS, ROOT, &layouts);
    let spaces = [(MODEL_SPACE, 1024), (PAPER_SPACE, 0)];
    for ((order, (name, handle)), (space, flags)) in (0..).zip(layouts).zip(spaces) {
        writer.text(0, "LAYOUT");
        writer.handle(5, handle);
        writer.handle(330, LAYOUTS);
        plot_settings(writer, flags);
        layout(writer, name, order, space, reach);
    }
}

fn dictionary(writer: &mut Writer, handle: u64, owner: u64, entries: &[(&str, u64)]) {
    writer.text(0, "DICTIONARY");
    writer.handle(5, handle);
    writer.handle(330, owner);
    writer.text(100, "AcDbDictionary");
    writer.integer(281, 1);
    for (name, entry) in entries {
        writer.text(3, name);
        writer.handle(350, *entry);
    }
}

/// Write how a layout would be printed: an A3 sheet, one to one.
fn plot_settings(writer: &mut Writer, flags: i64) {
    writer.text(100, "AcDbPlotSettings");
    for code in [1, 2, 4, 6] {
        writer.text(code, "");
    }
    for code in 40..44 {
        writer.number(code, 0.0);
    }
    writer.number(44, 420.0);
    writer.number(45, 297.0);
    for code in [46, 47, 48, 49, 140, 141] {
        writer.number(code, 0.0);
    }
    writer.number(142, 1.0);
    writer.number(143, 1.0);
    writer.integer(70, flags);
    writer.integer(72, 1);
    writer.integer(73, 0);
    writer.integer(74, 5);
    writer.text(7, "");
    writer.integer(75, 16);
    writer.number(147, 1.0);
    writer.number(148, 0.0);
    writer.number(149, 0.0);
}

fn layout(writer: &mut Writer, name: &str, order: i64, space: u64, reach: (DVec3, DVec3)) {
    let (low, high) = match space {
        MODEL_SPACE => reach,
        _ => (DVec3::ZERO, DVec3::ZERO),
    };
    writer.text(100, "AcDbLayout");
    writer.text(1, name);
    writer.integer(70, 1);
    writer.integer(71, order);
    flat_point(writer, 10, 0.0, 0.0);
    flat_point(writer, 11, 420.0, 297.0);
    writer.point(12, DVec3::ZERO);
    writer.point(14, low);
    writer.point(15, high);
    writer.number(146, 0.0);
    writer.point(13, DVec3::ZERO);
    writer.point(16, DVec3::X);
    writer.point(17, DVec3::Y);
    writer.integer(76, 0);
    writer.handle(330, space);
}

fn flat_point(writer: &mut Writer, code: u32, x: f64, y: f64) {
    writer.number(code, x);
    writer.number(code + 10, y);
}
