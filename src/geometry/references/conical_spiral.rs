//! The conical spiral (paper, section 5).

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The conical spiral.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "conical-spiral",
    label: "Conical spiral",
    help: "(t cos t, t sin t, b t): an Archimedean spiral that rises with its radius",
    parameters: &[Parameter {
        name: "rise",
        label: "Rise",
        help: "How far b it rises where its radius grows by 1",
        kind: Number::any(1.0),
    }],
    planar: false,
    interval: |_| [0.0, 15.5],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let (sine, cosine) = t.sin_cos();
    [&t * &cosine, &t * &sine, t.times(values[0])]
}
