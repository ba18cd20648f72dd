//! The helix on a cylinder.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The helix on a cylinder.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "helix",
    label: "Helix",
    help: "(r cos t, r sin t, p t/2π): curvature and torsion are constant",
    parameters: &[
        Parameter {
            name: "radius",
            label: "Radius",
            help: "The radius r of the cylinder",
            kind: Number::size(1.0),
        },
        Parameter {
            name: "pitch",
            label: "Pitch",
            help: "How far p it rises in a turn",
            kind: Number::any(1.0),
        },
    ],
    planar: false,
    interval: |_| [0.0, 2.0 * TAU],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let (sine, cosine) = t.sin_cos();
    [
        cosine.times(values[0]),
        sine.times(values[0]),
        t.times(values[1] / TAU),
    ]
}
