//! The curves and points of single entities.

use std::f64::consts::TAU;

use glam::DVec3;

use super::axes::{axes, unit_normal};
use super::groups::Trouble;
use super::notes::Notes;
use super::polylines::light;
use super::records::Record;
use super::splines::spline;
use crate::io::exchange::drawing::{Conic, Kind, Shape};

/// Turns that differ by less from a whole one are meant to close: writers round angles to 12 digits or fewer.
const CLOSING: f64 = 1e-9;

/// Read the curve or point of an entity; `None` if it is something else.
///
/// # Errors
/// [`Trouble`] if a value is missing or makes no curve.
pub fn curve(
    record: &Record<'_>,
    notes: &mut Notes,
) -> Result<Option<(Kind, Vec<Shape>)>, Trouble> {
    Ok(Some(match record.name {
        // Release 9 had lines in space as entities of their own.
        "LINE" | "3DLINE" => (Kind::Line, vec![line(record)?]),
        "POINT" => (Kind::Point, vec![Shape::Point(record.required_point(10)?)]),
        "CIRCLE" => (Kind::Circle, vec![circle(record, 0.0, TAU)?]),
        "ARC" => (Kind::Arc, vec![arc(record)?]),
        "ELLIPSE" => (Kind::Ellipse, vec![ellipse(record)?]),
        "LWPOLYLINE" => (Kind::Polyline, light(record, notes)?),
        "SPLINE" | "HELIX" => (Kind::Spline, vec![spline(record, notes)?]),
        _ => return Ok(None),
    }))
}

fn line(record: &Record<'_>) -> Result<Shape, Trouble> {
    Ok(Shape::Polyline {
        points: vec![record.required_point(10)?, record.required_point(11)?],
        closed: false,
    })
}

fn arc(record: &Record<'_>) -> Result<Shape, Trouble> {
    let from = record.required_real(50)?;
    let to = record.required_real(51)?;
    let turn = turn((to - from) / 360.0);
    let from = (from % 360.0).to_radians();
    circle(record, from, from + turn * TAU)
}

fn circle(record: &Record<'_>, from: f64, to: f64) -> Result<Shape, Trouble> {
    let radius = record.required_real(40)?;
    if radius <= 0.0 {
        return Err(record.trouble(format!("radius {radius} is not above 0")));
    }
    let conic = Conic {
        centre: record.required_point(10)?,
        x: DVec3::X * radius,
        y: DVec3::Y * radius,
        from,
        to,
    };
    Ok(Shape::Conic(conic).placed(&axes(record)?))
}

/// Ellipses lie in world coordinates; the extrusion only says on which side their angles turn.
fn ellipse(record: &Record<'_>) -> Result<Shape, Trouble> {
    let x = record.required_point(11)?;
    let ratio = record.required_real(40)?;
    let normal = unit_normal(record)?.unwrap_or(DVec3::Z);
    let side = normal.cross(x / x.abs().max_element()).try_normalize();
    let y = side.unwrap_or_default() * (x.length() * ratio);
    if y.length() == 0.0 || !y.is_finite() {
        return Err(record.trouble("an axis has no length"));
    }
    let from = record.real(41)?.unwrap_or(0.0);
    let to = record.real(42)?.unwrap_or(TAU);
    Ok(Shape::Conic(Conic {
        centre: record.required_point(10)?,
        x,
        y,
        from: from % TAU,
        to: from % TAU + turn((to - from) / TAU) * TAU,
    }))
}

/// Bring a difference of angles, in turns, above 0 and up to 1. None at all is a whole turn.
fn turn(turns: f64) -> f64 {
    if turns > 0.0 && turns < 1.0 - CLOSING {
        return turns;
    }
    let inside = turns.rem_euclid(1.0);
    let is_part = (CLOSING..=1.0 - CLOSING).contains(&inside);
    if is_part { inside } else { 1.0 }
}
