//! Tests with small files and closed forms.

mod conics;
mod damage;
mod entities;
mod links;
mod writer;

use glam::{DVec3, DVec4};

use super::read;
use crate::io::exchange::drawing::{Drawing, Nurbs, Shape};

/// An entity of a file for a test.
#[derive(Clone, Default)]
struct Given {
    entity: u32,
    form: i32,
    level: i32,
    matrix: u32,
    status: &'static str,
    colour: i32,
    label: &'static str,
    parameters: String,
}

fn given(entity: u32, parameters: &str) -> Given {
    Given {
        entity,
        parameters: parameters.to_owned(),
        ..Given::default()
    }
}

/// A file in millimetres; the entities get the numbers 1, 3, 5 and so on.
fn file(entities: &[Given]) -> String {
    let global = "1H,,1H;,4Htest,8Htest.igs,1Ha,1Ha,32,308,15,308,15,4Htest,1.,2,2HMM,1,0.01,;";
    file_with(global, entities)
}

fn file_with(global: &str, entities: &[Given]) -> String {
    let mut text = format!("{:<72}S{:>7}\n", "start", 1);
    for (index, part) in pieces(global, 72).into_iter().enumerate() {
        text += &format!("{part:<72}G{:>7}\n", index + 1);
    }
    let mut parameters = String::new();
    let mut line = 0;
    for (index, it) in entities.iter().enumerate() {
        let number = 2 * index + 1;
        let first = line + 1;
        for part in pieces(&format!("{},{};", it.entity, it.parameters), 64) {
            line += 1;
            parameters += &format!("{part:<64}{number:>8}P{line:>7}\n");
        }
        let status = if it.status.is_empty() {
            "00000000"
        } else {
            it.status
        };
        text += &format!(
            "{:>8}{first:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{status:>8}D{number:>7}\n",
            it.entity, 0, 0, it.level, 0, it.matrix, 0
        );
        text += &format!(
            "{:>8}{:>8}{:>8}{:>8}{:>8}{:>16}{:>8}{:>8}D{:>7}\n",
            it.entity,
            0,
            it.colour,
            line + 1 - first,
            it.form,
            "",
            it.label,
            0,
            number + 1
        );
    }
    text += &parameters;
    let counts = format!("S{:>7}G{:>7}D{:>7}P{line:>7}", 1, 1, 2 * entities.len());
    text + &format!("{counts:<72}T{:>7}\n", 1)
}

fn pieces(text: &str, columns: usize) -> Vec<String> {
    let bytes = text.as_bytes().chunks(columns);
    bytes
        .map(|part| String::from_utf8(part.to_vec()).unwrap())
        .collect()
}

fn drawing(entities: &[Given]) -> Drawing {
    read(file(entities).as_bytes()).unwrap()
}

fn only_shape(drawing: &Drawing) -> &Shape {
    assert_eq!(
        (drawing.items.len(), drawing.items[0].shapes.len()),
        (1, 1),
        "{drawing:?}"
    );
    &drawing.items[0].shapes[0]
}

fn has_remark(drawing: &Drawing, part: &str) -> bool {
    drawing.remarks.iter().any(|remark| remark.contains(part))
}

/// The point at a ratio of the way through a shape's parameters.
fn point_at(shape: &Shape, ratio: f64) -> DVec3 {
    match shape {
        Shape::Nurbs(it) => {
            let range = (it.knots[it.degree], it.knots[it.points.len()]);
            evaluate(it, range.0 + (range.1 - range.0) * ratio)
        }
        Shape::Conic(it) => {
            let t = it.from + (it.to - it.from) * ratio;
            it.centre + it.x * t.cos() + it.y * t.sin()
        }
        Shape::Polyline { points, .. } => points[0].lerp(points[1], ratio),
        Shape::Point(point) => *point,
    }
}

/// Evaluate by the recursive definition of B-splines, apart from the reader's de Boor.
fn evaluate(it: &Nurbs, t: f64) -> DVec3 {
    let last = it.knots[it.points.len()];
    let mut sum = DVec4::ZERO;
    for (index, point) in it.points.iter().enumerate() {
        let weight = it.weights.as_ref().map_or(1.0, |weights| weights[index]);
        sum += (*point * weight).extend(weight) * basis(&it.knots, index, it.degree, t, last);
    }
    sum.truncate() / sum.w
}

fn basis(knots: &[f64], index: usize, degree: usize, t: f64, last: f64) -> f64 {
    let (low, high) = (knots[index], knots[index + 1]);
    if degree == 0 {
        let is_inside = low <= t && t < high || t == last && low < high && high == last;
        return f64::from(u8::from(is_inside));
    }
    let (end, start) = (knots[index + degree], knots[index + degree + 1]);
    let mut sum = 0.0;
    if end > low {
        sum += (t - low) / (end - low) * basis(knots, index, degree - 1, t, last);
    }
    if start > high {
        sum += (start - t) / (start - high) * basis(knots, index + 1, degree - 1, t, last);
    }
    sum
}
