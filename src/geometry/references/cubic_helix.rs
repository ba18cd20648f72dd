//! The cubic helix.

use super::kind::{EVERYWHERE, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The cubic helix.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "cubic-helix",
    label: "Cubic helix",
    help: "a (t, t², 2t³/3): of constant slope, curvature and torsion are both 2/(a (1 + 2t²)²)",
    parameters: &[Parameter {
        name: "a",
        label: "Size a",
        help: "The length a",
        kind: Number::size(1.0),
    }],
    planar: false,
    interval: |_| [-1.0, 1.0],
    domain: |_| EVERYWHERE,
    series,
};

fn series(values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
    let t = PowerSeries::parameter(t, order);
    let square = &t * &t;
    let cube = &square * &t;
    [
        t.times(values[0]),
        square.times(values[0]),
        cube.times(values[0] * 2.0 / 3.0),
    ]
}
