//! The parabola.

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The parabola.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "parabola",
    label: "Parabola",
    help: "(t, t²/(4f)), with its vertex at t = 0",
    parameters: &[Parameter {
        name: "focus",
        label: "Focal length",
        help: "The distance f of the focus from the vertex",
        kind: Number::size(1.0),
    }],
    planar: true,
    interval: |values| [-2.0 * values[0], 2.0 * values[0]],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let height = (&t * &t).times(0.25 / values[0]);
    [t, height, PowerSeries::constant(0.0, order)]
}
