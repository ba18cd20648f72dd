//! Superspirals (Ziatdinov, "Family of superspirals with completely monotonic curvature given in
//! terms of Gauss hypergeometric function", 2012).
//!
//! The radius of curvature is ρ(ψ) = ₂F₁(a, b; c; −ψ) at direction angle ψ, and P = ∫ ρ e^{iψ} dψ. Near 0
//! the power series of ρ about ψ is summed after Pfaff's transformation,
//!
//!   ₂F₁(a, b; c; −ψ) = (1 + ψ)^{−a} ₂F₁(a, c − b; c; ψ/(1 + ψ)),
//!
//! derivative by derivative: the k-th one of ₂F₁(a, b; c; z) is (a)ₖ(b)ₖ/(c)ₖ ₂F₁(a + k, b + k; c + k; z).
//! Farther out ρ is continued from one expansion to the next by its differential equation
//!
//!   ψ(1 + ψ) ρ″ + (c + (a + b + 1)ψ) ρ′ + ab ρ = 0.

use std::f64::consts::TAU;
use std::ops::Bound;

use super::integral::MOST_TURNING;
use super::kind::{ReferenceKind, ReferenceParameter};
use crate::geometry::power_series::PowerSeries;

/// The numbers a and b that sums converge for without losing digits.
const MODERATE: (Bound<f64>, Bound<f64>) = (Bound::Included(-20.0), Bound::Included(20.0));

/// From here on the differential equation is solved for the pieces that are integrated, which is quick.
const SOLVED: f64 = 2.0;

/// Up to here the series is summed for the derivatives at a place: near 0, where its other solution is
/// singular, the equation would multiply rounding at each order.
const SUMMED: f64 = 4.0;

/// The order of the expansions of which the curve is put together. With pieces that reach at most a quarter
/// of the way from their middle to the singularity at −1 they err by 4⁻³⁰.
const ORDER: usize = 30;

/// How far a piece may reach from its middle, in units of the distance from its start to the singularity.
const REACH: f64 = 0.2;

/// How far a piece may reach at most, so that e^{iψ} converges as well.
const HALF_STEP: f64 = 0.5;

/// Terms of a series: far more than it takes where ψ ≥ −0.99.
const MOST_TERMS: usize = 20_000;

/// The superspiral by its direction angle.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "superspiral",
    label: "Superspiral",
    help: "Radius of curvature ₂F₁(a, b; c; −t) at direction angle t: completely monotone for a > 0, c > b > 0",
    parameters: &[
        ReferenceParameter {
            name: "a",
            label: "a",
            help: "The first parameter of the hypergeometric function",
            default: 0.5,
            limits: MODERATE,
        },
        ReferenceParameter {
            name: "b",
            label: "b",
            help: "The second parameter",
            default: 1.0,
            limits: MODERATE,
        },
        ReferenceParameter {
            name: "c",
            label: "c",
            help: "The third parameter",
            default: 1.5,
            limits: (Bound::Included(1e-3), Bound::Included(20.0)),
        },
    ],
    planar: true,
    interval: |_| [0.0, TAU],
    domain: |_| [-0.99, MOST_TURNING],
    series,
};

fn series(values: &[f64], psi: f64, order: usize) -> [PowerSeries; 3] {
    let radius = Radius {
        a: values[0],
        b: values[1],
        c: values[2],
    };
    let (mut place, mut point) = (0.0, [0.0; 2]);
    let mut last: Option<Expansion> = None;
    while place != psi {
        // Half the way to the next place.
        let reach = HALF_STEP.min(REACH * (1.0_f64 + place));
        let half = (0.5 * (psi - place)).clamp(-reach, reach);
        let next = if half.abs() < reach { psi } else { place + 2.0 * half };
        let expansion = radius.expansion(place + half, ORDER, SOLVED, last.as_ref());
        let directed = expansion.directed();
        for (coordinate, velocity) in point.iter_mut().zip(directed) {
            let integral = velocity.antiderivative(0.0, ORDER + 1);
            *coordinate += value_at(&integral, half) - value_at(&integral, -half);
        }
        last = Some(expansion);
        place = next;
    }
    let [run, rise] = radius.expansion(psi, order, SUMMED, last.as_ref()).directed();
    [
        run.antiderivative(point[0], order),
        rise.antiderivative(point[1], order),
        PowerSeries::constant(0.0, order),
    ]
}

/// The series of ρ about one ψ.
struct Expansion {
    psi: f64,
    series: PowerSeries,
}

impl Expansion {
    /// The series of ρ cos ψ and ρ sin ψ.
    fn directed(&self) -> [PowerSeries; 2] {
        let angle = PowerSeries::parameter(self.psi, self.series.order());
        let (sine, cosine) = angle.sin_cos();
        [&self.series * &cosine, &self.series * &sine]
    }
}

/// The parameters of ρ.
struct Radius {
    a: f64,
    b: f64,
    c: f64,
}

impl Radius {
    /// Expand ρ about ψ; beyond `summed` it is continued from `last`, an expansion near there.
    fn expansion(
        &self,
        psi: f64,
        order: usize,
        summed: f64,
        last: Option<&Expansion>,
    ) -> Expansion {
        let series = match last {
            Some(last) if psi > summed => self.continued(psi, order, last),
            _ => self.summed(psi, order),
        };
        Expansion { psi, series }
    }

    /// Sum up the derivatives: coefficient k is (−1)ᵏ (a)ₖ(b)ₖ/((c)ₖ k!) ₂F₁(a + k, b + k; c + k; −ψ).
    fn summed(&self, psi: f64, order: usize) -> PowerSeries {
        let Self { a, b, c } = *self;
        let sum = |k: f64| {
            if psi < 0.0 {
                hypergeometric(a + k, b + k, c + k, -psi)
            } else {
                let share = psi / (1.0 + psi);
                (1.0 + psi).powf(-a - k) * hypergeometric(a + k, c - b, c + k, share)
            }
        };
        let mut factor = 1.0;
        PowerSeries::by_recurrence(sum(0.0), order, |_, k| {
            let k = k as f64;
            factor *= -(a + k) * (b + k) / ((c + k) * (k + 1.0));
            factor * sum(k + 1.0)
        })
    }

    /// Continue from another expansion by the differential equation.
    fn continued(&self, psi: f64, order: usize, last: &Expansion) -> PowerSeries {
        let Self { a, b, c } = *self;
        let distance = psi - last.psi;
        let value = value_at(&last.series, distance);
        let slope = value_at(&last.series.derivative(), distance);
        PowerSeries::by_recurrence(value, order, |coefficients, k| {
            let Some(below) = k.checked_sub(1) else {
                return slope;
            };
            let k = below as f64;
            let first = (k + 1.0) * ((1.0 + 2.0 * psi) * k + c + (a + b + 1.0) * psi);
            let second = (k + a) * (k + b);
            let sum = first * coefficients[below + 1] + second * coefficients[below];
            -sum / (psi * (1.0 + psi) * (k + 1.0) * (k + 2.0))
        })
    }
}

/// Sum up the hypergeometric series ₂F₁(a, b; c; z), 0 ≤ z < 1, c > 0.
fn hypergeometric(a: f64, b: f64, c: f64, z: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for index in 0..MOST_TERMS {
        let k = index as f64;
        let ratio = (a + k) * (b + k) / ((c + k) * (k + 1.0)) * z;
        term *= ratio;
        sum += term;
        // What is left is less than a geometric series.
        let left = term.abs() * z.max(ratio) / (1.0 - z);
        if ratio.abs() < 1.0 && left <= 0.25 * f64::EPSILON * sum.abs() {
            break;
        }
    }
    sum
}

/// Evaluate a series at a distance from where it was expanded, by Horner's rule.
fn value_at(series: &PowerSeries, distance: f64) -> f64 {
    let coefficients = series.coefficients().iter().rev();
    coefficients.fold(0.0, |sum, coefficient| sum * distance + coefficient)
}
