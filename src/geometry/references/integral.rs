//! Curves given by their direction angle: the point is an integral.

use crate::geometry::power_series::PowerSeries;
use crate::geometry::quadrature::{quadrature, settled_quadrature};

/// The largest direction angle that is computed, a thousand turns: the point takes time in proportion,
/// and more turns could not be told apart on any drawing.
pub(super) const MOST_TURNING: f64 = 1000.0 * std::f64::consts::TAU;

/// A direction may turn by so much between two steps of the quadrature, whose 16 points integrate
/// e^{iθ} over that to rounding.
const STEP: f64 = 4.0;

/// What the quadrature may err, relative to the length of the curve.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Integrate two functions from 0 to t, of which `turning` tells how far the direction of both
/// together turns on the way, and `speed` how large they become.
pub(super) fn integrated(
    t: f64,
    [turning, speed]: [f64; 2],
    functions: impl Fn(f64) -> [f64; 2],
) -> [f64; 2] {
    let steps = (turning.abs() / STEP).ceil();
    if t == 0.0 || !steps.is_finite() {
        return [0.0 * turning; 2];
    }
    let steps = steps.clamp(1.0, MOST_TURNING) as usize;
    let knot = |step: usize| t * (step as f64 / steps as f64);
    let allowed = ROUNDING * speed * t.abs() / steps as f64;
    (0..steps).fold([0.0; 2], |sum, step| {
        let span = [knot(step), knot(step + 1)];
        let whole = quadrature(span[0], span[1], &functions);
        let part = settled_quadrature(span, whole, [allowed; 2], &functions).values;
        [sum[0] + part[0], sum[1] + part[1]]
    })
}

/// Expand a planar curve of speed 1 that starts at the origin along the x axis: C′ = (cos θ, sin θ),
/// θ(0) = 0. `expansion` is the series of θ about t, to the order of the curve or one less.
pub(super) fn unit_speed(
    t: f64,
    order: usize,
    angle: impl Fn(f64) -> f64,
    expansion: &PowerSeries,
) -> [PowerSeries; 3] {
    let direction = |s: f64| {
        let (sine, cosine) = angle(s).sin_cos();
        [cosine, sine]
    };
    let [x, y] = integrated(t, [angle(t), 1.0], direction);
    let (sine, cosine) = expansion.sin_cos();
    [
        cosine.antiderivative(x, order),
        sine.antiderivative(y, order),
        PowerSeries::constant(0.0, order),
    ]
}
