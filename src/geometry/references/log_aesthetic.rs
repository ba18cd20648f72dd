//! Log-aesthetic curves in standard form (Yoshida and Saito, "Interactive aesthetic curve
//! segments", 2006).
//!
//! The radius of curvature is ρ = (1 + Λαs)^{1/α}, e^{Λs} for α = 0, at arc length s. With ρ = e^w,
//! w = ln(1 + Λαs)/α, the direction angle is θ = (1/Λ) ∫ e^{(α−1)w} dw. Written with
//! ψ(x) = ln(1 + x)/x and φ(x) = (eˣ − 1)/x, which are smooth at 0, both need no special cases:
//!
//!   w = Λ s ψ(Λαs),   θ = (w/Λ) φ((α − 1) w),   and back:   w = Λ θ ψ(Λ(α − 1)θ),   s = (w/Λ) φ(αw).

use super::integral::{MOST_TURNING, unit_speed};
use super::kind::{Coordinates, ReferenceKind};
use crate::geometry::coefficient::Coefficient;
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// The log-aesthetic curve by its arc length s.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "log-aesthetic",
    label: "Log-aesthetic curve",
    help: "Radius (1 + Λαs)^(1/α) at arc length s: α −1 clothoid, 0 Nielsen, 1 logarithmic, 2 involute",
    parameters: &[
        Parameter::new(
            "alpha",
            "α",
            "The slope α of the logarithmic curvature graph",
            Number::any(-1.0),
        ),
        Parameter::new(
            "lambda",
            "Λ",
            "How fast Λ the radius of curvature, 1 at s = 0, changes there",
            Number::any(0.5),
        ),
    ],
    interval,
    domain,
    coordinates: Coordinates::Planar(coordinates, Some(coordinates)),
};

/// From s = 0 to 1, or less if the curve ends before: nine tenths of the way there.
fn interval(values: &[f64]) -> [f64; 2] {
    [0.0, (0.9 * domain(values)[1]).min(1.0)]
}

/// The s with 1 + Λαs > 0 and a direction angle of at most [`MOST_TURNING`].
fn domain(values: &[f64]) -> [f64; 2] {
    let [alpha, lambda] = [values[0], values[1]];
    let end = |turning: f64| {
        let farthest = length(alpha, lambda, turning);
        let singular = -1.0 / (lambda * alpha);
        // Where the direction never turns so far the curve ends at the singularity, if anywhere.
        match (
            farthest.is_nan(),
            singular.is_finite() && singular * turning > 0.0,
        ) {
            (false, true) if singular.abs() < farthest.abs() => singular,
            (false, _) => farthest,
            (true, true) => singular,
            (true, false) => turning * f64::INFINITY,
        }
    };
    [end(-MOST_TURNING), end(MOST_TURNING)]
}

fn coordinates<T: Coefficient>(values: &[f64], s: &PowerSeries<T>) -> [PowerSeries<T>; 2] {
    let (at, order) = (s.value(), s.order());
    let [alpha, lambda] = [values[0], values[1]];
    let direction = |s: f64| angle(alpha, lambda, s);
    // With B = 1 + Λαs, κ′ B = −Λ κ.
    let base = T::of(1.0) + T::of(lambda) * T::of(alpha) * at;
    let growth = |s: f64| lambda * s * relative_logarithm(lambda * alpha * s);
    let falling = match lambda < 0.0 {
        true => at.rising(|s| -growth(s)),
        false => -at.rising(growth),
    };
    let start = falling.rising(f64::exp);
    let curvature = PowerSeries::by_recurrence(start, order, |curvature, k| {
        let share = T::of(1.0) + T::of(alpha) * T::of(k as f64);
        T::of(-lambda) * share * curvature[k] / (T::of(k as f64 + 1.0) * base)
    });
    let expansion = curvature.antiderivative(at.rising(direction), order);
    unit_speed((KIND.name, values), s, direction, &expansion)
}

/// The direction angle θ at arc length s; not a number beyond the singularity.
fn angle(alpha: f64, lambda: f64, s: f64) -> f64 {
    let relative = s * relative_logarithm(lambda * alpha * s);
    relative * relative_exponential((alpha - 1.0) * lambda * relative)
}

/// The arc length s at direction angle θ; not a number if it never turns so far.
fn length(alpha: f64, lambda: f64, angle: f64) -> f64 {
    let relative = angle * relative_logarithm(lambda * (alpha - 1.0) * angle);
    relative * relative_exponential(alpha * lambda * relative)
}

/// Compute Λ and the length of the segment from s = 0 along which ln ρ grows by `growth` and the
/// direction turns by `turning`: the formulas above for w = `growth`.
pub(in crate::geometry) fn lambda_and_length(alpha: f64, growth: f64, turning: f64) -> [f64; 2] {
    let turned = relative_exponential((alpha - 1.0) * growth);
    let lambda = growth * turned / turning;
    [
        lambda,
        turning * relative_exponential(alpha * growth) / turned,
    ]
}

/// ψ(x) = ln(1 + x)/x.
fn relative_logarithm(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.ln_1p() / x }
}

/// φ(x) = (eˣ − 1)/x.
pub(in crate::geometry) fn relative_exponential(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.exp_m1() / x }
}
