//! The curve that the benchmarks of drags share: a spiral.

use batten::document::{Curve, Document};
use batten::geometry::FloatPolygon;

/// Make a slowly winding curve of degree 9 with as many turns whatever its number of vertices.
pub fn winding(count: usize) -> Document {
    let points: Vec<(f64, f64)> = (0..count)
        .map(|index| {
            let angle = 12.0 * index as f64 / count as f64;
            let radius = 100.0 + 60.0 * angle;
            (radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    let polygon = FloatPolygon::planar(9, &points).expect("a polygon");
    Document::from_curves([Curve::new("winding", polygon)])
}
