//! The reader, by small files with known curves.

use glam::DVec3;

use super::read;
use crate::io::exchange::drawing::{Conic, Drawing, Item, Nurbs, Shape};

mod blocks;
mod damage;
mod entities;
mod forms;
mod polylines;
mod splines;

/// Groups by code and value, separated by spaces and semicolons: `0 LINE; 8 walls`.
fn groups(text: &str) -> String {
    let groups = text
        .split(';')
        .map(str::trim)
        .filter(|group| !group.is_empty());
    let lines = groups.map(|group| group.replacen(' ', "\n", 1) + "\n");
    lines.collect()
}

fn section(name: &str, text: &str) -> String {
    groups(&format!("0 SECTION; 2 {name}; {text}; 0 ENDSEC"))
}

fn file(sections: &[String]) -> String {
    sections.concat() + "0\nEOF\n"
}

/// A file of some entities alone.
fn entities(text: &str) -> String {
    file(&[section("ENTITIES", text)])
}

fn drawing(text: &str) -> Drawing {
    read(text.as_bytes()).expect("a drawing")
}

/// Read entities that must not cause a remark.
fn items(text: &str) -> Vec<Item> {
    let drawing = drawing(&entities(text));
    assert_eq!(drawing.remarks, [""; 0]);
    drawing.items
}

/// Read the shapes of the only entity.
fn shapes(text: &str) -> Vec<Shape> {
    let items = items(text);
    let [item] = items.as_slice() else {
        panic!("{items:?} is not one item");
    };
    item.shapes.clone()
}

fn conic(text: &str) -> Conic {
    match shapes(text).as_slice() {
        [Shape::Conic(conic)] => conic.clone(),
        other => panic!("{other:?} is no conic"),
    }
}

fn nurbs(drawing: &Drawing) -> &Nurbs {
    match drawing.items.as_slice() {
        [Item { shapes, .. }] => match shapes.as_slice() {
            [Shape::Nurbs(nurbs)] => nurbs,
            other => panic!("{other:?} is no spline"),
        },
        other => panic!("{other:?} is not one item"),
    }
}

/// The remark on the only entity, which must be skipped.
fn remark(text: &str) -> String {
    let drawing = drawing(&entities(text));
    assert_eq!(drawing.items, []);
    drawing.remarks.join("; ")
}

fn at(conic: &Conic, parameter: f64) -> DVec3 {
    let (sine, cosine) = parameter.sin_cos();
    conic.centre + conic.x * cosine + conic.y * sine
}

fn assert_near(point: DVec3, x: f64, y: f64, z: f64) {
    let distance = point.distance(DVec3::new(x, y, z));
    assert!(distance < 1e-13, "{point} is not ({x}, {y}, {z})");
}
