//! The helix on a cone.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The helix on a cone.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "conical-helix",
    label: "Conical helix",
    help: "a e^(bt) (cos t, sin t, c): of constant slope on a cone; radii of curvature and torsion are proportional to the arc length",
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
        Parameter {
            name: "rise",
            label: "Rise c",
            help: "The height of the cone by its radius",
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
    let radius = t.times(values[1]).exp().times(values[0]);
    let height = radius.clone().times(values[2]);
    [&radius * &cosine, &radius * &sine, height]
}
