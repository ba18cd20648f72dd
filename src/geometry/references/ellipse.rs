//! The ellipse.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind, ReferenceParameter, SIZE};
use crate::geometry::power_series::PowerSeries;

/// The ellipse.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "ellipse",
    label: "Ellipse",
    help: "(a cos t, b sin t)",
    parameters: &[
        ReferenceParameter {
            name: "a",
            label: "Half axis a",
            help: "Half the axis along x",
            default: 2.0,
            limits: SIZE,
        },
        ReferenceParameter {
            name: "b",
            label: "Half axis b",
            help: "Half the axis along y",
            default: 1.0,
            limits: SIZE,
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
