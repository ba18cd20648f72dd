//! Nielsen's spiral.

use super::integral::{MOST_TURNING, integrated};
use super::kind::{Coordinates, ReferenceKind};
use crate::geometry::coefficient::Coefficient;
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// Euler's constant γ.
const EULER: f64 = 0.577_215_664_901_532_9;

/// Nielsen's spiral by its direction angle.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "nielsen-spiral",
    label: "Nielsen’s spiral",
    help: "a (Ci t, Si t), cosine and sine integral: direction angle t, curvature t/a",
    parameters: &[Parameter::new(
        "a",
        "Size a",
        "The radius of curvature at t = 1",
        Number::size(1.0),
    )],
    interval: |_| [0.5, 10.0],
    domain: |_| [1e-30, MOST_TURNING],
    coordinates: Coordinates::Planar(coordinates, Some(coordinates)),
};

/// Ci t = γ + ln t + ∫ (cos u − 1)/u du, Si t = ∫ sin u/u du, from 0 to t.
fn coordinates<T: Coefficient>(values: &[f64], angle: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let (t, order) = (angle.value(), angle.order());
    let relative = |u: f64| {
        let half = (0.5 * u).sin();
        // Quadrature never asks for u = 0.
        [-2.0 * half * half / u, u.sin() / u]
    };
    let [cosine, sine] = integrated((KIND.name, &[]), t, |u| u, relative);
    let (sines, cosines) = angle.sin_cos();
    let (rise, run) = (&sines / angle, &cosines / angle);
    let x = run.antiderivative(T::of(EULER) + t.ln() + cosine, order);
    let y = rise.antiderivative(sine, order);
    [x.times(T::of(values[0])), y.times(T::of(values[0]))]
}
