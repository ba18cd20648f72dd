//! The circle.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The circle.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "circle",
    label: "Circle",
    help: "(r cos t, r sin t): curvature 1/r",
    parameters: &[Parameter {
        name: "radius",
        label: "Radius",
        help: "The radius r",
        kind: Number::size(1.0),
    }],
    planar: true,
    interval: |_| [0.0, TAU],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let (sine, cosine) = PowerSeries::parameter(t, order).sin_cos();
    [
        cosine.times(values[0]),
        sine.times(values[0]),
        PowerSeries::constant(0.0, order),
    ]
}
