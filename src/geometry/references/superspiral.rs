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

use std::cell::RefCell;
use std::f64::consts::TAU;

use super::integral::MOST_TURNING;
use super::kind::{Coordinates, ReferenceKind};
use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// From this ψ on the pieces to integrate come from the differential equation, which is quick.
const SOLVED: f64 = 2.0;

/// Up to here the series is summed for the derivatives at a place: near 0, where its other solution is
/// singular, the equation would multiply rounding at each order.
const SUMMED: f64 = 4.0;

/// The order of the expansions of which the curve is put together. With pieces that reach at most a quarter
/// of the way from their middle to the singularity at −1 they err by 4⁻³⁰.
const ORDER: usize = 30;

/// Largest reach of a piece from its middle, in units of the distance from its start to the singularity.
const REACH: f64 = 0.2;

/// Largest reach of a piece for which e^{iψ} converges as well.
const HALF_STEP: f64 = 0.5;

/// Terms of a series: far more than it takes where ψ ≥ −0.99.
const MOST_TERMS: usize = 20_000;

/// The domain of ψ: nearer to the singularity at −1 there are ever more pieces.
const DOMAIN: [f64; 2] = [-0.99, MOST_TURNING];

/// The superspiral by its direction angle.
pub static KIND: ReferenceKind = ReferenceKind {
    name: "superspiral",
    label: "Superspiral",
    help: "Radius of curvature ₂F₁(a, b; c; −t) at direction angle t: completely monotone for a > 0, c > b > 0",
    parameters: &[
        Parameter::new(
            "a",
            "a",
            "The first parameter of the hypergeometric function",
            Number::between(-20.0, 20.0, 0.5),
        ),
        Parameter::new(
            "b",
            "b",
            "The second parameter",
            Number::between(-20.0, 20.0, 1.0),
        ),
        Parameter::new(
            "c",
            "c",
            "The third parameter",
            Number::between(1e-3, 20.0, 1.5),
        ),
    ],
    interval: |_| [0.0, TAU],
    domain: |_| DOMAIN,
    coordinates: Coordinates::Planar(coordinates, None),
};

thread_local! {
    /// A cache: the spiral that this thread evaluated last. Each point is an integral from 0, and the next
    /// points of the same spiral use its pieces again.
    static LAST: RefCell<Option<Spiral>> = const { RefCell::new(None) };
}

/// Expand the spiral.
fn coordinates(values: &[f64], psi: &PowerSeries) -> [PowerSeries; 2] {
    let radius = Radius {
        a: values[0],
        b: values[1],
        c: values[2],
    };
    LAST.with_borrow_mut(|last| {
        let kept = last.take().filter(|spiral| spiral.radius == radius);
        let spiral = last.insert(kept.unwrap_or_else(|| Spiral::new(radius)));
        spiral.series(psi.value(), psi.order())
    })
}

/// The evaluated part of a superspiral: pieces from 0 on in either direction.
struct Spiral {
    radius: Radius,
    ahead: Vec<Piece>,
    behind: Vec<Piece>,
}

/// A piece of a superspiral.
struct Piece {
    /// Its start, nearer to 0, and its end.
    span: [f64; 2],
    /// The point where it ends.
    end: [f64; 2],
    /// The series about its middle.
    expansion: Expansion,
    /// The antiderivatives of ρ cos ψ and ρ sin ψ about its middle, without their constants.
    integrals: [PowerSeries; 2],
    /// The point where the piece begins.
    begin: [f64; 2],
}

impl Spiral {
    fn new(radius: Radius) -> Self {
        Self {
            radius,
            ahead: Vec::new(),
            behind: Vec::new(),
        }
    }

    fn series(&mut self, psi: f64, order: usize) -> [PowerSeries; 2] {
        let radius = self.radius;
        let (point, last) = match self.piece(psi) {
            Some(piece) => (piece.point(psi), Some(&piece.expansion)),
            None => ([0.0; 2], None),
        };
        let Some(below) = order.checked_sub(1) else {
            return point.map(|coordinate| PowerSeries::constant(coordinate, 0));
        };
        // The point is known, and so one derivative less is needed.
        let expansion = radius.expansion(psi, below, SUMMED, last);
        let [run, rise] = expansion.directed();
        [
            run.antiderivative(point[0], order),
            rise.antiderivative(point[1], order),
        ]
    }

    /// The piece that holds ψ, after those before it are known; `None` at 0.
    fn piece(&mut self, psi: f64) -> Option<&Piece> {
        let sign = psi.signum();
        let pieces = if psi < 0.0 {
            &mut self.behind
        } else {
            &mut self.ahead
        };
        while psi.abs() > 0.0
            && pieces
                .last()
                .is_none_or(|last| sign * (psi - last.span[1]) > 0.0)
        {
            let piece = self.radius.piece(sign, pieces.last());
            pieces.push(piece);
        }
        let before = pieces.partition_point(|piece| sign * (psi - piece.span[1]) > 0.0);
        pieces.get(before)
    }
}

impl Piece {
    /// The point of the spiral at ψ.
    fn point(&self, psi: f64) -> [f64; 2] {
        let middle = self.expansion.psi;
        let along = |axis: usize| {
            let integral = &self.integrals[axis];
            let from = value_at(integral, self.span[0] - middle);
            self.begin[axis] + value_at(integral, psi - middle) - from
        };
        [along(0), along(1)]
    }
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
#[derive(Clone, Copy, PartialEq)]
struct Radius {
    a: f64,
    b: f64,
    c: f64,
}

impl Radius {
    /// Make the piece after the last, or the first one from 0, in a direction.
    fn piece(&self, sign: f64, last: Option<&Piece>) -> Piece {
        let (from, begin) = last.map_or((0.0, [0.0; 2]), |last| (last.span[1], last.end));
        // Half the way to the next place.
        let half = sign * HALF_STEP.min(REACH * (1.0 + from));
        let expansion = last.map(|last| &last.expansion);
        let expansion = self.expansion(from + half, ORDER, SOLVED, expansion);
        let integrals = expansion
            .directed()
            .map(|velocity| velocity.antiderivative(0.0, ORDER + 1));
        let mut piece = Piece {
            span: [from, from + 2.0 * half],
            end: begin,
            expansion,
            integrals,
            begin,
        };
        piece.end = piece.point(piece.span[1]);
        piece
    }

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
