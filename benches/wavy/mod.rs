//! The curve that the benchmarks share: a closed wave, planar or in space.

use std::f64::consts::TAU;

use batten::geometry::FloatPolygon;
use glam::DVec3;

/// Lay so many vertices along a wavy circle that rises and falls by `height`.
pub fn wavy(vertices: usize, degree: usize, height: f64, rational: bool) -> FloatPolygon {
    let points = (0..vertices).map(|index| {
        let turn = index as f64 / vertices as f64 * TAU;
        let radius = 10.0 + (7.0 * turn).sin();
        DVec3::new(
            radius * turn.cos(),
            radius * turn.sin(),
            height * (3.0 * turn).sin(),
        )
    });
    let weights = (0..vertices).map(|index| 1.0 + 0.3 * (index as f64).sin());
    let weights = rational.then(|| weights.collect());
    FloatPolygon::new(degree, points.collect(), weights, false).expect("a valid polygon")
}
