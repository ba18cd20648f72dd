//! Parameters at which samples show where a curve is.

use std::ops::RangeInclusive;

use crate::geometry::differentiable::Differentiable;
use crate::geometry::interval::Interval;
use crate::geometry::power_series::PowerSeries;

/// Even steps to begin with.
const STEPS: usize = 128;

/// The most steps: where a curve changes more often, its lengths are rough.
const MOST_STEPS: usize = 4096;

/// The order of the polynomials that a curve looks like along a step, and the largest share of their terms that the
/// rest may have.
const LOOKS: (usize, f64) = (5, 0.5);

/// Parameters along which a curve looks like polynomials, from one to the next: even ones, and more where its bounds
/// over a step show more than those (a step, a peak that no sample meets).
pub(in crate::geometry) fn places(curve: &dyn Differentiable, [from, to]: [f64; 2]) -> Vec<f64> {
    let place = |step: usize| {
        let share = step as f64 / STEPS as f64;
        from * (1.0 - share) + to * share
    };
    let mut left: Vec<[f64; 2]> = (0..STEPS)
        .map(|step| [place(step), place(step + 1)])
        .collect();
    left.reverse();
    let mut places = vec![from];
    while let Some([from, to]) = left.pop() {
        let middle = from + 0.5 * (to - from);
        let can_halve = from < middle && middle < to && places.len() + left.len() < MOST_STEPS;
        if can_halve && looks_like_polynomial(curve, [from, to]) == Some(false) {
            left.extend([[middle, to], [from, middle]]);
        } else {
            places.push(to);
        }
    }
    places
}

/// Whether what a curve has beside its Taylor polynomial about the middle of an interval is small along it; `None` if
/// nothing is known of it between samples.
fn looks_like_polynomial(curve: &dyn Differentiable, [from, to]: [f64; 2]) -> Option<bool> {
    let (order, most) = LOOKS;
    let half = 0.5 * (to - from);
    let size = |t: Interval, orders: RangeInclusive<usize>| {
        let t = PowerSeries::of_coefficients(&[t, Interval::number(half)], order);
        let axes = curve.enclosed(&t)?;
        let coefficients = axes
            .iter()
            .flat_map(|axis| &axis.coefficients()[orders.clone()]);
        Some(coefficients.fold(0.0, |most: f64, it| most.max(it.magnitude())))
    };
    let polynomial = size(Interval::number(from + half), 1..=order - 1)?;
    let rest = size(Interval::new(from, to), order..=order)?;
    Some(rest <= most * polynomial)
}
