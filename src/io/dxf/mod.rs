//! AutoCAD's drawing exchange format, version AC1015 (AutoCAD 2000), as it is written.
//!
//! Each curve is a SPLINE on clamped knots that start at 0, which is what readers agree on,
//! with its polygons beside it as polylines on layers of their own. The curves of a group share its layers;
//! a curve without group has layers of its name, since entities have none. The header says the unit of the
//! document, or that there is none.
//! Numbers have the digits that it takes to read the very same number again.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use crate::document::{Colour, Curve, Document, Group, Reference};
use crate::geometry::{ClampedPolygon, PolygonKind};
use crate::io::error::WriteError;
use crate::io::exchange;
use crate::io::exchange::drawing::{Conic, Kind, Nurbs, Shape};
use crate::io::exchange::dxf::colours::nearest_index;
use crate::io::format::{ExportRow, FileUnit, Format, Writing};
use crate::io::loss::{Loss, LossReport};
use crate::io::polygon::FilePolygon;

mod frame;
mod layers;
mod writer;

use layers::Layers;
use writer::Writer;

/// The row of the table of formats.
pub static DXF: Format = Format {
    name: "DXF",
    extensions: &["dxf"],
    read: None,
    write: Some(write),
    write_back: Some(|document, _, losses| drawing(document, &[], losses)),
    rewrite: None,
    read_chosen: None,
    draw: Some(exchange::dxf::read),
    file_unit: FileUnit::Optional,
    holds_documents: false,
    exports: &[ExportRow {
        label: "Export DXF…",
        help: "Export curves as clamped splines, and both S-polygons on their own layers",
        icon: "share",
        key: None,
        polygon: None,
    }],
};

/// The most knots that a SPLINE can count: the group that holds their number has 16 bits.
const MOST_KNOTS: usize = i16::MAX as usize;

/// The polygons that are drawn beside the curve unless one is chosen.
const DRAWN: [PolygonKind; 2] = [PolygonKind::Float, PolygonKind::Clamped];

/// Write curves as a drawing in the unit of the document, with polygons beside each: those that are listed, or the
/// one that is chosen, or else the float and the clamped one.
///
/// A periodic curve is opened at u = 0; its last vertex is exactly its first one. A hidden curve
/// is on layers that are off, a locked one on layers that are locked.
///
/// # Errors
/// [`WriteError`] if there are no curves, or one has more vertices than the format can count.
fn write(
    document: &Document,
    writing: &Writing,
    losses: &mut LossReport,
) -> Result<Vec<u8>, WriteError> {
    let chosen = writing.polygon.map(|kind| vec![kind]);
    let listed = writing.beside.clone().or(chosen);
    drawing(document, listed.as_deref().unwrap_or(&DRAWN), losses)
}

/// Write curves with some of their polygons beside each.
fn drawing(
    document: &Document,
    kinds: &[PolygonKind],
    losses: &mut LossReport,
) -> Result<Vec<u8>, WriteError> {
    let format = DXF.name;
    let shapes = |reference: &Reference| exchange::writing::shapes(&reference.curve);
    let is_drawn = |reference: &Reference| shapes(reference).is_some();
    if document.curves().len() == 0 && !document.references().any(|(_, it)| is_drawn(it)) {
        return Err(WriteError::NoCurves { format });
    }
    let mut layers = Layers::new(kinds);
    let mut entities = Writer::new();
    let mut reach = Reach::default();
    for (_, curve) in document.curves() {
        let degree = curve.polygon.degree();
        // A periodic curve is written with its first vertices repeated.
        let repeated = if curve.polygon.is_periodic() {
            degree
        } else {
            0
        };
        let most = MOST_KNOTS - (degree + 1) - repeated;
        let vertices = curve.polygon.vertices().len();
        if vertices > most {
            return Err(WriteError::TooManyVertices {
                format,
                name: curve.name.clone(),
                vertices,
                most,
            });
        }
        let base = layers.take(curve);
        report(curve, &base, kinds, losses);
        entities.set_colour(curve.colour);
        spline(&mut entities, &clamped(curve), &base, &mut reach);
        entities.set_colour(None);
        for &kind in kinds {
            let layer = format!("{base}{}", layers::suffix(kind));
            let FilePolygon {
                vertices, periodic, ..
            } = FilePolygon::of(&curve.polygon, kind);
            polyline(&mut entities, &vertices, periodic, &layer, &mut reach);
        }
    }
    for (_, reference) in document.references() {
        let Some((_, shapes)) = shapes(reference) else {
            losses.add_reference(reference);
            continue;
        };
        let layer = layers.take_reference(reference);
        report_reference(reference, &layer, losses);
        entities.set_colour(reference.colour);
        for shape in shapes {
            match shape {
                Shape::Polyline { points, closed } => match points[..] {
                    [from, to] if !closed => {
                        line(&mut entities, [from, to], &layer, &mut reach);
                    }
                    _ => polyline(&mut entities, &points, closed, &layer, &mut reach),
                },
                Shape::Nurbs(nurbs) => spline(&mut entities, &nurbs, &layer, &mut reach),
                Shape::Conic(it) => conic(&mut entities, &it, &layer, &mut reach),
                Shape::Point(point) => single_point(&mut entities, point, &layer, &mut reach),
            }
        }
    }
    let reach = (reach.low, reach.high);
    let text = frame::drawing(layers.list(), entities, document.unit(), reach);
    Ok(text.into_bytes())
}

/// The box around everything drawn.
struct Reach {
    low: DVec3,
    high: DVec3,
}

impl Default for Reach {
    fn default() -> Self {
        Self {
            low: DVec3::INFINITY,
            high: DVec3::NEG_INFINITY,
        }
    }
}

impl Reach {
    fn add(&mut self, points: &[DVec3]) {
        for point in points {
            self.low = self.low.min(*point);
            self.high = self.high.max(*point);
        }
    }
}

fn report(curve: &Curve, layer: &str, kinds: &[PolygonKind], losses: &mut LossReport) {
    report_names(&curve.name, &curve.group, layer, losses);
    losses.add_own_attributes(curve);
    report_colour(&curve.name, curve.colour, losses);
    losses.add_if(curve.polygon.is_periodic(), curve, Loss::Periodic);
    for &kind in kinds {
        let is_rational = curve.polygon.is_rational();
        losses.add_if(is_rational, curve, Loss::PolygonWeights { kind });
    }
}

fn report_reference(reference: &Reference, layer: &str, losses: &mut LossReport) {
    let name = &reference.name;
    report_names(name, &reference.group, layer, losses);
    report_colour(name, reference.colour, losses);
    losses.add_point_weights(reference);
}

/// Report names that its layer does not hold.
fn report_names(name: &str, group: &Group, layer: &str, losses: &mut LossReport) {
    let written = layer.to_owned();
    let lost = match group.is_none() {
        false => Some(Loss::NoName),
        true if Kind::is_made_up(name) => Some(Loss::Unnamed),
        true => (layer != name).then(|| Loss::Name {
            written: written.clone(),
        }),
    };
    let lost = lost.map(|loss| (name.to_owned(), loss));
    losses.losses.extend(lost);
    if !group.is_none() {
        losses.add_group(name, group, Group::new([written]));
    }
}

fn report_colour(name: &str, colour: Option<Colour>, losses: &mut LossReport) {
    if colour.is_some_and(|it| !nearest_index(it.0).1) {
        losses.losses.push((name.to_owned(), Loss::NearestColour));
    }
}

/// The spline of a curve, on clamped knots.
fn clamped(curve: &Curve) -> Nurbs {
    let clamped = ClampedPolygon::from_float(&curve.polygon);
    let mut points = clamped.vertices().to_vec();
    if curve.polygon.is_periodic()
        && let (Some(first), Some(last)) = (points.first().copied(), points.last_mut())
    {
        *last = first;
    }
    Nurbs {
        degree: clamped.degree(),
        knots: clamped.knots(),
        points,
        weights: clamped.weights().map(<[f64]>::to_vec),
        periodic: false,
    }
}

fn spline(writer: &mut Writer, nurbs: &Nurbs, layer: &str, reach: &mut Reach) {
    reach.add(&nurbs.points);
    let planar = nurbs.points.iter().all(|point| point.z == 0.0);
    writer.entity("SPLINE", layer);
    writer.text(100, "AcDbSpline");
    if planar {
        writer.point(210, DVec3::Z);
    }
    let flags = 8 * i64::from(planar) + 4 * i64::from(nurbs.weights.is_some());
    writer.integer(70, flags);
    writer.count(71, nurbs.degree);
    writer.count(72, nurbs.knots.len());
    writer.count(73, nurbs.points.len());
    writer.integer(74, 0);
    writer.number(42, 1e-9);
    writer.number(43, 1e-9);
    for knot in &nurbs.knots {
        writer.number(40, *knot);
    }
    for weight in nurbs.weights.iter().flatten() {
        writer.number(41, *weight);
    }
    for point in &nurbs.points {
        writer.point(10, *point);
    }
}

/// An ellipse or an arc of one; in the plane a circle or an arc of one where it is round.
fn conic(writer: &mut Writer, conic: &Conic, layer: &str, reach: &mut Reach) {
    let Conic { centre, x, y, .. } = *conic;
    reach.add(&[
        centre - x - y,
        centre + x + y,
        centre - x + y,
        centre + x - y,
    ]);
    let is_flat = x.z == 0.0 && y.z == 0.0;
    let turned = DVec3::new(-x.y, x.x, 0.0);
    if is_flat && (turned == y || turned == -y) {
        circle(writer, conic, layer);
    } else {
        ellipse(writer, conic, layer);
    }
}

/// A circle or an arc of one, anticlockwise about z.
fn circle(writer: &mut Writer, conic: &Conic, layer: &str) {
    let Conic { centre, x, y, .. } = *conic;
    let is_clockwise = x.cross(y).z < 0.0;
    let [from, to] = match is_clockwise {
        true => [-conic.to, -conic.from],
        false => [conic.from, conic.to],
    };
    let is_whole = conic.is_whole();
    writer.entity(if is_whole { "CIRCLE" } else { "ARC" }, layer);
    writer.text(100, "AcDbCircle");
    writer.point(10, centre);
    writer.number(40, x.length());
    if !is_whole {
        let start = x.y.atan2(x.x);
        writer.text(100, "AcDbArc");
        for (code, angle) in [(50, from), (51, to)] {
            writer.number(code, (start + angle).to_degrees().rem_euclid(360.0));
        }
    }
}

/// An arc of an ellipse from its longer half-axis, anticlockwise about the normal of its plane: about z in the plane.
fn ellipse(writer: &mut Writer, conic: &Conic, layer: &str) {
    let Conic {
        centre,
        mut x,
        mut y,
        mut from,
        mut to,
    } = *conic;
    let is_flat = x.z == 0.0 && y.z == 0.0;
    if is_flat && x.cross(y).z < 0.0 {
        (y, from, to) = (-y, -to, -from);
    }
    if y.length() > x.length() {
        (x, y, from, to) = (y, -x, from - FRAC_PI_2, to - FRAC_PI_2);
    }
    writer.entity("ELLIPSE", layer);
    writer.text(100, "AcDbEllipse");
    writer.point(10, centre);
    writer.point(11, x);
    let normal = if is_flat { DVec3::Z } else { x.cross(y) };
    writer.point(210, normal.normalize_or(DVec3::Z));
    writer.number(40, y.length() / x.length());
    writer.number(41, from);
    writer.number(42, to);
}

fn single_point(writer: &mut Writer, point: DVec3, layer: &str, reach: &mut Reach) {
    reach.add(&[point]);
    writer.entity("POINT", layer);
    writer.text(100, "AcDbPoint");
    writer.point(10, point);
}

fn line(writer: &mut Writer, ends: [DVec3; 2], layer: &str, reach: &mut Reach) {
    reach.add(&ends);
    writer.entity("LINE", layer);
    writer.text(100, "AcDbLine");
    for (code, end) in [(10, ends[0]), (11, ends[1])] {
        writer.point(code, end);
    }
}

fn polyline(
    writer: &mut Writer,
    vertices: &[DVec3],
    is_closed: bool,
    layer: &str,
    reach: &mut Reach,
) {
    let closed = i64::from(is_closed);
    reach.add(vertices);
    if vertices.iter().all(|vertex| vertex.z == 0.0) {
        writer.entity("LWPOLYLINE", layer);
        writer.text(100, "AcDbPolyline");
        writer.count(90, vertices.len());
        writer.integer(70, closed);
        writer.number(43, 0.0);
        for vertex in vertices {
            writer.number(10, vertex.x);
            writer.number(20, vertex.y);
        }
        return;
    }
    let owner = writer.entity("POLYLINE", layer);
    writer.text(100, "AcDb3dPolyline");
    writer.integer(66, 1);
    writer.point(10, DVec3::ZERO);
    writer.integer(70, 8 + closed);
    for vertex in vertices {
        writer.part("VERTEX", owner, layer);
        writer.text(100, "AcDbVertex");
        writer.text(100, "AcDb3dPolylineVertex");
        writer.point(10, *vertex);
        writer.integer(70, 32);
    }
    writer.part("SEQEND", owner, layer);
}

#[cfg(test)]
mod tests;
