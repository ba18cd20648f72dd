//! Writes statements.

use std::fmt::Write;
use std::sync::Arc;

use glam::DVec3;

use super::super::splines::{checked, described, spline};
use super::words::{DEFAULT_GROUP, UNIT};
use crate::io::exchange::drawing::{Drawing, Item, Nurbs, Shape, Unreadable};

/// Write a file.
pub(super) fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    let mut writer = Writer {
        text: format!("# {}\n", line(name)),
        vertices: 0,
    };
    if let Some(unit) = drawing.unit {
        writer.put(format_args!("{UNIT} {unit} mm"));
    }
    let (mut name, mut group) = (None, Arc::default());
    for item in &drawing.items {
        if item.name != name {
            writer.put(format_args!(
                "o {}",
                line(item.name.as_deref().unwrap_or_default())
            ));
            name = item.name.clone();
        }
        if item.group != group {
            writer.put(format_args!("g {}", group_name(&item.group)));
            group = Arc::clone(&item.group);
        }
        for shape in &item.shapes {
            writer
                .shape(shape)
                .map_err(|reason| refusal(drawing, item, &reason))?;
        }
    }
    Ok(writer.text.into_bytes())
}

struct Writer {
    text: String,
    /// How many vertices there are.
    vertices: usize,
}

impl Writer {
    fn put(&mut self, statement: std::fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{statement}");
    }

    fn shape(&mut self, shape: &Shape) -> Result<(), String> {
        match shape {
            Shape::Point(point) => {
                let numbers = self.put_vertices(&[*point], None)?;
                self.put(format_args!("p{numbers}"));
            }
            Shape::Polyline { points, closed } => {
                let first = self.vertices + 1;
                let mut numbers = self.put_vertices(points, None)?;
                if *closed {
                    let _ = write!(numbers, " {first}");
                }
                self.put(format_args!("l{numbers}"));
            }
            Shape::Nurbs(_) | Shape::Conic(_) => {
                if let Some(nurbs) = spline(shape) {
                    self.spline(&checked(nurbs.into_owned())?)?;
                }
            }
        }
        Ok(())
    }

    fn spline(&mut self, nurbs: &Nurbs) -> Result<(), String> {
        let numbers = self.put_vertices(&nurbs.points, nurbs.weights.as_deref())?;
        let rational = if nurbs.weights.is_some() { "rat " } else { "" };
        let from = nurbs.knots.get(nurbs.degree).copied().unwrap_or_default();
        let to = nurbs
            .knots
            .get(nurbs.points.len())
            .copied()
            .unwrap_or_default();
        let knots: String = nurbs.knots.iter().map(|it| format!(" {it:?}")).collect();
        self.put(format_args!(
            "cstype {rational}bspline\ndeg {}",
            nurbs.degree
        ));
        self.put(format_args!(
            "curv {from:?} {to:?}{numbers}\nparm u{knots}\nend"
        ));
        Ok(())
    }

    /// Write points and return their numbers.
    fn put_vertices(
        &mut self,
        points: &[DVec3],
        weights: Option<&[f64]>,
    ) -> Result<String, String> {
        let mut numbers = String::new();
        for (index, point) in points.iter().enumerate() {
            if !point.is_finite() {
                return Err("a number is not finite".to_owned());
            }
            let weight = weights.and_then(|it| it.get(index));
            let weight = weight.map(|it| format!(" {it:?}")).unwrap_or_default();
            self.put(format_args!(
                "v {:?} {:?} {:?}{weight}",
                point.x, point.y, point.z
            ));
            self.vertices += 1;
            let _ = write!(numbers, " {}", self.vertices);
        }
        Ok(numbers)
    }
}

/// Make a text fit into a line that ends there.
fn line(text: &str) -> String {
    let text = text.replace(char::is_control, " ").replace('#', "_");
    match text.strip_suffix('\\') {
        Some(start) => format!("{start}_"),
        None => text,
    }
}

/// Write the path of a group.
pub(super) fn group_name(group: &[String]) -> String {
    match group {
        [] => DEFAULT_GROUP.to_owned(),
        _ => line(&group.join("/")),
    }
}

fn refusal(drawing: &Drawing, item: &Item, reason: &str) -> Unreadable {
    Unreadable {
        at: None,
        reason: format!(
            "{} cannot be written as OBJ: {reason}",
            described(drawing, item)
        ),
    }
}
