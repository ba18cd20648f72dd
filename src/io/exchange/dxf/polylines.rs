//! Chains of segments and arcs: LWPOLYLINE, and POLYLINE with its VERTEX entities.

use std::f64::consts::TAU;

use glam::DVec3;

use super::axes::axes;
use super::groups::Trouble;
use super::notes::Notes;
use super::records::{Record, real};
use crate::io::exchange::drawing::{Affine, Conic, Shape};

/// Bits of group 70 of LWPOLYLINE and POLYLINE.
const CLOSED: i64 = 1;
const IN_SPACE: i64 = 8;
const MESH: i64 = 16 | 64;
/// The bit of group 70 of a VERTEX that controls a fitted spline and is not drawn itself.
const FRAME: i64 = 16;

/// Flatter arcs are read as segments: the rounding of a centre so far off moves them more than that does.
const FLAT: f64 = 1e-8;

/// A corner, and the tangent of a quarter of the angle of the arc after it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    point: DVec3,
    bulge: f64,
}

/// Read an LWPOLYLINE.
///
/// # Errors
/// [`Trouble`] if a value is missing or damaged, or there is but one corner.
pub fn light(record: &Record<'_>, notes: &mut Notes) -> Result<Vec<Shape>, Trouble> {
    let elevation = record.real(38)?.unwrap_or(0.0);
    let mut corners: Vec<Corner> = Vec::new();
    let mut has_y = true;
    for group in record.groups() {
        match (group.code, corners.last_mut()) {
            (10, _) if has_y => {
                corners.push(Corner {
                    point: DVec3::new(real(group)?, 0.0, elevation),
                    bulge: 0.0,
                });
                has_y = false;
            }
            (20, Some(corner)) => {
                corner.point.y = real(group)?;
                has_y = true;
            }
            (42, Some(corner)) => corner.bulge = real(group)?,
            (10, _) => break,
            _ => {}
        }
    }
    if !has_y {
        return Err(record.trouble("a corner has no y"));
    }
    note_count(record, corners.len(), notes)?;
    chain(record, &corners, record.integer(70)? & CLOSED != 0)
}

/// Whether a POLYLINE is a mesh.
///
/// # Errors
/// [`Trouble`] if the flags are damaged.
pub fn is_mesh(record: &Record<'_>) -> Result<bool, Trouble> {
    Ok(record.integer(70)? & MESH != 0)
}

/// Read a VERTEX; `None` if it is not drawn.
///
/// # Errors
/// [`Trouble`] if a value is missing or damaged.
pub fn vertex(record: &Record<'_>) -> Result<Option<Corner>, Trouble> {
    if record.integer(70)? & FRAME != 0 {
        return Ok(None);
    }
    Ok(Some(Corner {
        point: record.required_point(10)?,
        bulge: record.real(42)?.unwrap_or(0.0),
    }))
}

/// Read a POLYLINE with its vertices.
///
/// One that was fitted by arcs or a spline is read as the chain that is drawn.
///
/// # Errors
/// [`Trouble`] if a value is damaged, or there is but one corner.
pub fn heavy(record: &Record<'_>, mut corners: Vec<Corner>) -> Result<Vec<Shape>, Trouble> {
    let flags = record.integer(70)?;
    let is_closed = flags & CLOSED != 0;
    if flags & IN_SPACE != 0 {
        let points: Vec<_> = corners.iter().map(|corner| corner.point).collect();
        return polyline(record, points, is_closed).map(|shape| vec![shape]);
    }
    let elevation = match record.real(30)? {
        Some(elevation) => elevation,
        None => record.real(38)?.unwrap_or(0.0),
    };
    for corner in &mut corners {
        corner.point.z = elevation;
    }
    chain(record, &corners, is_closed)
}

fn note_count(record: &Record<'_>, found: usize, notes: &mut Notes) -> Result<(), Trouble> {
    let said = record.integer(90)?;
    if record.find(90).is_some() && usize::try_from(said) != Ok(found) {
        let name = record.name;
        notes.add(
            record.at,
            format_args!("{name} says {said} corners and has {found}"),
        );
    }
    Ok(())
}

fn polyline(record: &Record<'_>, points: Vec<DVec3>, closed: bool) -> Result<Shape, Trouble> {
    if points.len() < 2 {
        return Err(record.trouble(format!("it has {} of at least 2 corners", points.len())));
    }
    Ok(Shape::Polyline { points, closed })
}

fn chain(record: &Record<'_>, corners: &[Corner], closed: bool) -> Result<Vec<Shape>, Trouble> {
    let place = axes(record)?;
    let is_flat = |corner: &Corner| corner.bulge.abs() < FLAT;
    if corners.len() < 2 || corners.iter().all(is_flat) {
        let points: Vec<_> = corners.iter().map(|corner| corner.point).collect();
        return Ok(vec![polyline(record, points, closed)?.placed(&place)]);
    }
    let shapes = pieces(corners, closed, &place);
    if shapes.is_empty() {
        return Err(record.trouble("all its corners are one point"));
    }
    Ok(shapes)
}

/// Cut a chain where segments and arcs meet.
fn pieces(corners: &[Corner], closed: bool, place: &Affine) -> Vec<Shape> {
    let mut shapes = Vec::with_capacity(count(corners));
    let mut run: Vec<DVec3> = Vec::new();
    let ends = corners
        .iter()
        .skip(1)
        .chain(corners.first().filter(|_| closed));
    for (corner, end) in corners.iter().zip(ends) {
        if corner.point == end.point {
            continue;
        }
        if corner.bulge.abs() < FLAT {
            if run.is_empty() {
                run.push(corner.point);
            }
            run.push(end.point);
            continue;
        }
        end_run(&mut run, &mut shapes);
        shapes.push(Shape::Conic(arc(corner, end.point)));
    }
    end_run(&mut run, &mut shapes);
    shapes
        .into_iter()
        .map(|shape| shape.placed(place))
        .collect()
}

/// About how many runs of segments and arcs there are: a chain may have a million.
fn count(corners: &[Corner]) -> usize {
    let are_arcs = corners.iter().map(|corner| corner.bulge.abs() >= FLAT);
    let before = std::iter::once(true).chain(are_arcs.clone());
    let begins = are_arcs
        .zip(before)
        .filter(|(is_arc, before)| *is_arc || *before);
    begins.count()
}

fn end_run(run: &mut Vec<DVec3>, shapes: &mut Vec<Shape>) {
    if !run.is_empty() {
        shapes.push(Shape::Polyline {
            points: std::mem::take(run),
            closed: false,
        });
    }
}

/// The arc from a corner to the next: to the left of the chord's middle for a negative bulge.
fn arc(corner: &Corner, end: DVec3) -> Conic {
    let Corner {
        point: start,
        bulge,
    } = *corner;
    let chord = end - start;
    let left = DVec3::new(-chord.y, chord.x, 0.0);
    let centre = start + chord / 2.0 + left * ((1.0 / bulge - bulge) / 4.0);
    let x = start - centre;
    let y = DVec3::new(-x.y, x.x, 0.0) * bulge.signum();
    Conic {
        centre,
        x,
        y,
        from: 0.0,
        to: (4.0 * bulge.abs().atan()).min(TAU),
    }
}
