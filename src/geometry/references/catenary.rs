//! The catenary.

use super::kind::ReferenceKind;
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The catenary is 1e86 times as high as its size at this distance.
const MOST: f64 = 200.0;

/// The catenary.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "catenary",
    label: "Catenary",
    help: "(t, a cosh(t/a)), with its vertex at t = 0",
    parameters: &[Parameter {
        name: "a",
        label: "Size a",
        help: "The radius of curvature at the vertex, and its height",
        kind: Number::size(1.0),
    }],
    planar: true,
    interval: |values| [-2.0 * values[0], 2.0 * values[0]],
    domain: |values| [-MOST * values[0], MOST * values[0]],
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let (_, cosine) = t.clone().times(1.0 / values[0]).sinh_cosh();
    [
        t,
        cosine.times(values[0]),
        PowerSeries::constant(0.0, order),
    ]
}
