//! The ellipse.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The ellipse.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "ellipse",
    label: "Ellipse",
    help: "(a cos t, b sin t)",
    parameters: &[
        Parameter {
            name: "a",
            label: "Half axis a",
            help: "Half the axis along x",
            kind: Number::size(2.0),
        },
        Parameter {
            name: "b",
            label: "Half axis b",
            help: "Half the axis along y",
            kind: Number::size(1.0),
        },
    ],
    planar: true,
    interval: |_| [0.0, TAU],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let (sine, cosine) = PowerSeries::parameter(t, order).sin_cos();
    [
        cosine.times(values[0]),
        sine.times(values[1]),
        PowerSeries::constant(0.0, order),
    ]
}
