//! The logarithmic spiral.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The logarithmic spiral.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "logarithmic-spiral",
    label: "Logarithmic spiral",
    help: "a e^(bt) (cos t, sin t): turned, it is itself in another size",
    parameters: &[
        Parameter {
            name: "a",
            label: "Size a",
            help: "The distance from the pole at t = 0",
            kind: Number::size(1.0),
        },
        Parameter {
            name: "b",
            label: "Growth b",
            help: "How fast the logarithm of the radius grows by the angle",
            kind: Number::any(0.2),
        },
    ],
    planar: true,
    interval: |_| [0.0, TAU],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let (sine, cosine) = t.sin_cos();
    let radius = t.times(values[1]).exp().times(values[0]);
    [
        &radius * &cosine,
        &radius * &sine,
        PowerSeries::constant(0.0, order),
    ]
}
