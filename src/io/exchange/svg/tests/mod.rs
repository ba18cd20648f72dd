//! Tests of SVG: what they share, and damaged files.

mod paths;
mod tree;
mod writer;

use glam::DVec3;

use super::{read, write};
use crate::io::exchange::drawing::{Drawing, Item, Kind, Nurbs, Shape};

fn drawing(attributes: &str, content: &str) -> Drawing {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' {attributes}>\n{content}</svg>"
    );
    read(text.as_bytes()).unwrap()
}

/// A page of 100 mm by 100 mm, a coordinate a millimetre.
fn page(content: &str) -> Drawing {
    drawing(
        "width='100mm' height='100mm' viewBox='0 0 100 100'",
        content,
    )
}

fn path(data: &str) -> Drawing {
    page(&format!("<path d='{data}'/>"))
}

fn point(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

fn chain(points: &[(f64, f64)], closed: bool) -> Shape {
    Shape::Polyline {
        points: points.iter().map(|it| point(it.0, it.1)).collect(),
        closed,
    }
}

fn bezier(degree: usize, points: &[(f64, f64)]) -> Shape {
    let last = (points.len() - 1) / degree;
    let mut knots = vec![0.0];
    knots.extend((0..=last).flat_map(|it| vec![it as f64; degree]));
    knots.push(last as f64);
    Shape::Nurbs(Nurbs {
        degree,
        knots,
        points: points.iter().map(|it| point(it.0, it.1)).collect(),
        weights: None,
        periodic: false,
    })
}

fn item(shapes: Vec<Shape>) -> Item {
    Item {
        at: 1,
        ..Item::new(Kind::Path, shapes)
    }
}

fn shapes(drawing: &Drawing) -> Vec<Shape> {
    drawing
        .items
        .iter()
        .flat_map(|it| it.shapes.clone())
        .collect()
}

/// The first points of lines, which are enough to see a transform.
fn starts(drawing: &Drawing) -> Vec<DVec3> {
    let start = |it: Shape| match it {
        Shape::Polyline { points, .. } => points[0],
        other => panic!("{other:?}"),
    };
    shapes(drawing).into_iter().map(start).collect()
}

fn assert_near(a: DVec3, b: DVec3) {
    assert!(a.distance(b) < 1e-12 * (1.0 + b.length()), "{a} is not {b}");
}

#[test]
fn mutations_do_not_panic() {
    let samples = [
        write(&writer::sample(), "a").unwrap(),
        b"<svg width='9mm' viewBox='0 0 1 1'><symbol id='a' viewBox='0 0 3 3'>\
          <path d='M0 0a1 2 3 01 4 5q1 1 2 2t9 9z'/>\
          </symbol><g transform='rotate(3 4 5)skewX(4)'><use href='#a' width='3'/></g>\
          <rect width='3' height='4' rx='1'/>\
          <style>.a{fill:red}</style><polygon class='a' points='1 2 3 4'/></svg>"
            .to_vec(),
    ];
    super::super::mutate::all(&samples, 1000, 0, |bytes| {
        let _ = read(bytes);
    });
}
