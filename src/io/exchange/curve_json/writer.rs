//! Writes curves.

use glam::DVec3;
use serde::Serialize;

use super::super::splines::{checked, described, spline};
use super::units::UNITS;
use crate::io::exchange::drawing::{Drawing, Item, Unreadable};

/// Write all curves. A unit without a name of its own becomes millimetres.
pub(super) fn write(drawing: &Drawing) -> Result<Vec<u8>, Unreadable> {
    let (unit, scale) = unit(drawing.unit);
    let mut text = format!("{{\n  \"unit\": {},\n  \"curves\": [", json(&unit)?);
    let mut separator = "\n";
    for item in &drawing.items {
        for curve in curves(drawing, item, scale)? {
            text.push_str(separator);
            text.push_str("    ");
            text.push_str(&json(&curve)?);
            separator = ",\n";
        }
    }
    text.push_str("\n  ]\n}\n");
    Ok(text.into_bytes())
}

/// Say what an item is that JSON cannot hold.
pub(super) fn holds(item: &Item) -> Result<(), String> {
    match item.shapes.iter().all(|shape| spline(shape).is_some()) {
        true => Ok(()),
        false => Err("a point".to_owned()),
    }
}

#[derive(Serialize)]
struct Curve<'i> {
    name: Option<&'i str>,
    degree: usize,
    knots: Vec<f64>,
    points: Vec<[f64; 3]>,
    weights: Option<Vec<f64>>,
    periodic: bool,
    group: Option<Group>,
}

/// The path of a group: joined, or a list where that could not be taken apart again.
#[derive(Serialize)]
#[serde(untagged)]
enum Group {
    Joined(String),
    List(Vec<String>),
}

impl Group {
    fn of(path: &[String]) -> Option<Self> {
        let is_joinable = !path.iter().any(|name| name.contains('/'));
        (!path.is_empty()).then(|| match is_joinable {
            true => Self::Joined(path.join("/")),
            false => Self::List(path.to_vec()),
        })
    }
}

fn curves<'i>(drawing: &Drawing, item: &'i Item, scale: f64) -> Result<Vec<Curve<'i>>, Unreadable> {
    let refusal = |what: &str| Unreadable {
        at: None,
        reason: format!(
            "{} cannot be written as JSON: {what}",
            described(drawing, item)
        ),
    };
    let mut curves = Vec::new();
    for shape in &item.shapes {
        let spline = spline(shape).ok_or_else(|| refusal("it is a point"))?;
        let nurbs = checked(spline.into_owned()).map_err(|reason| refusal(&reason))?;
        let place = |it: &DVec3| (*it * scale).to_array();
        curves.push(Curve {
            name: item.name.as_deref(),
            degree: nurbs.degree,
            points: nurbs.points.iter().map(place).collect(),
            knots: nurbs.knots,
            weights: nurbs.weights,
            periodic: nurbs.periodic,
            group: Group::of(&item.group),
        });
    }
    Ok(curves)
}

/// Get the name of a unit, and by what lengths are multiplied.
fn unit(unit: Option<f64>) -> (Option<&'static str>, f64) {
    let Some(unit) = unit else { return (None, 1.0) };
    match UNITS.iter().find(|it| it.1 == unit) {
        Some((name, _)) => (Some(name), 1.0),
        None => (Some("mm"), unit),
    }
}

fn json(value: &impl Serialize) -> Result<String, Unreadable> {
    serde_json::to_string(value).map_err(|error| Unreadable {
        at: None,
        reason: format!("this cannot be written as JSON: {error}"),
    })
}
