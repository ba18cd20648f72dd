//! The clothoid, or Euler spiral.

use super::integral::{MOST_TURNING, unit_speed};
use super::kind::{Coordinates, ReferenceKind};
use crate::geometry::coefficient::Coefficient;
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The clothoid by its arc length s from the inflection.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "clothoid",
    label: "Clothoid",
    help: "Curvature s/a² at arc length s: direction angle s²/(2a²)",
    parameters: &[Parameter::new(
        "a",
        "Clothoid parameter",
        "The length a: the radius of curvature is a at arc length a",
        Number::size(1.0),
    )],
    interval: |values| [0.0, 2.0 * values[0]],
    domain,
    coordinates: Coordinates::Planar(coordinates, Some(coordinates)),
};

/// The direction turns by as much as can be computed.
fn domain(values: &[f64]) -> [f64; 2] {
    let end = values[0] * (2.0 * MOST_TURNING).sqrt();
    [-end, end]
}

fn coordinates<T: Coefficient>(values: &[f64], s: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let angle = |s: f64| 0.5 * (s / values[0]).powi(2);
    let relative = s.clone().times(T::of(1.0) / T::of(values[0]));
    let expansion = relative.squared().times(T::of(0.5));
    unit_speed((KIND.name, values), s, angle, &expansion)
}
