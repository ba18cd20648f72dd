//! The Archimedean spiral.

use std::f64::consts::TAU;

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The Archimedean spiral.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "archimedean-spiral",
    label: "Archimedean spiral",
    help: "(a + bt) (cos t, sin t): its windings lie 2πb apart",
    parameters: &[
        Parameter {
            name: "a",
            label: "Start a",
            help: "The radius at t = 0",
            kind: Number::any(1.0),
        },
        Parameter {
            name: "b",
            label: "Growth b",
            help: "How fast the radius grows by the angle",
            kind: Number::any(0.2),
        },
    ],
    planar: true,
    interval: |_| [0.0, 2.0 * TAU],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let (sine, cosine) = t.sin_cos();
    let radius = t.times(values[1]).plus(values[0]);
    [
        &radius * &cosine,
        &radius * &sine,
        PowerSeries::constant(0.0, order),
    ]
}
