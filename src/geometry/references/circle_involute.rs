//! The involute of a circle.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The involute of a circle.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "circle-involute",
    label: "Circle involute",
    help: "r (cos t + t sin t, sin t − t cos t): curvature 1/(r t), with a cusp at t = 0",
    parameters: &[Parameter {
        name: "radius",
        label: "Radius",
        help: "The radius r of the circle",
        kind: Number::size(1.0),
    }],
    planar: true,
    interval: |_| [1.0, TAU],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let (sine, cosine) = t.sin_cos();
    let x = &cosine + &(&t * &sine);
    let y = &sine - &(&t * &cosine);
    [
        x.times(values[0]),
        y.times(values[0]),
        PowerSeries::constant(0.0, order),
    ]
}
