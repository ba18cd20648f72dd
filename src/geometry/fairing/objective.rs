//! Objectives of a fairing step, to be minimised.

use glam::DVec3;

use super::flow::{Member, Sequence};
use super::jet_weights::JetWeights;
use super::least_squares::LeastSquares;
use super::unknowns::Unknowns;
use crate::geometry::banded::{BandedQr, BandedRow, difference_stencil};
use crate::geometry::float_polygon::FloatPolygon;

/// A sum of squares of the vertices p, which were at p⁰.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Objective {
    /// The disturbance Σ|Δᵏ(p − p⁰)|² + μ Σ|p − p⁰|² + λ ∫(|C − C⁰|² + ν |C″ − C⁰″|²) du, and Σ wᵢ|Δ²(p − p⁰)|² with
    /// the tensions w of the shape.
    Disturbance {
        /// The order k of the differences.
        order: usize,
        /// The weight μ.
        fidelity: f64,
        /// The weights λ and ν.
        curve: [f64; 2],
    },
    /// The moves of the curve Σ|C − C⁰|² + ν Σ|C″ − C⁰″|² at samples, the derivatives by u.
    CurveMoves {
        /// The weight ν.
        bending: f64,
    },
    /// The harmony Σ(ΔᵐK)² ℓ² + w Σ(Δ² log leg)² + ε Σ|p − p⁰|² / ℓ², with ℓ the mean leg and more
    /// or other measures in space.
    Harmony {
        /// The measure beside the legs.
        measure: Measure,
        /// The order m of its differences.
        order: usize,
        /// The weight ε.
        closeness: f64,
        /// The mean leg ℓ.
        leg: f64,
    },
}

/// Measure of harmony beside the legs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measure {
    /// The signed discrete curvature of a planar polygon.
    SignedCurvature,
    /// The discrete curvature as a vector, D₁ × D₂ / |D₁|³: smooth also where it vanishes, but it
    /// straightens the torsion out.
    CurvatureVector,
    /// The discrete curvature of a polygon in space, and the torsion angles φ.
    CurvatureAndTorsion,
}

/// The samples of a segment at which the moves of the curve count.
const SAMPLES: usize = 8;

/// The weight w of the legs' lengths beside the curvature.
const LEGS: f64 = 0.01;

/// The polygon at which an objective is evaluated.
#[derive(Clone, Copy)]
pub(super) struct Shape<'a> {
    pub(super) polygon: &'a FloatPolygon,
    /// The vertices before the step.
    pub(super) before: &'a [DVec3],
    /// The vertices whose harmony counts: differences over others do not.
    pub(super) counts: &'a [bool],
    /// The weights of second differences, by their first vertices; none count without.
    pub(super) tensions: &'a [f64],
}

impl Objective {
    /// Collect the residuals at some vertices.
    pub(super) fn gather<'a>(
        &self,
        shape: Shape,
        unknowns: &'a Unknowns,
        vertices: &[DVec3],
    ) -> LeastSquares<'a> {
        let mut squares = LeastSquares::new(unknowns);
        self.visit(shape, unknowns, vertices, &mut |row| match row {
            Row::Scalar(residual, gradient) => squares.add(residual, gradient),
            Row::Vector(residual, stencil) => squares.add_vector(residual, stencil),
        });
        squares
    }

    /// Evaluate it at some vertices, but for what does not depend on the unknowns.
    pub(super) fn value(&self, shape: Shape, unknowns: &Unknowns, vertices: &[DVec3]) -> f64 {
        let mut sum = 0.0;
        self.visit(shape, unknowns, vertices, &mut |row| {
            sum += match row {
                Row::Scalar(residual, _) => residual * residual,
                Row::Vector(residual, _) => residual.length_squared(),
            };
        });
        sum
    }

    fn visit(
        &self,
        shape: Shape,
        unknowns: &Unknowns,
        vertices: &[DVec3],
        row: &mut impl FnMut(Row),
    ) {
        let mut moves = |factor: f64| {
            for (vertex, _) in unknowns.vertices() {
                let residual = factor * (vertices[vertex] - shape.before[vertex]);
                row(Row::Vector(residual, &[(vertex, factor)]));
            }
        };
        let moved = |terms: &[(usize, f64)]| -> DVec3 {
            let terms = terms.iter();
            terms
                .map(|(vertex, weight)| *weight * (vertices[*vertex] - shape.before[*vertex]))
                .sum()
        };
        match *self {
            Self::Disturbance {
                order,
                fidelity,
                curve,
            } => {
                moves(fidelity.sqrt());
                let stencil = difference_stencil(order);
                for first in windows(shape.polygon, stencil.len()) {
                    let touched = wrapped(shape.polygon, first, stencil.len());
                    let terms: Vec<(usize, f64)> = touched.zip(stencil.iter().copied()).collect();
                    row(Row::Vector(moved(&terms), &terms));
                }
                let stencil = difference_stencil(2);
                for (first, tension) in shape.tensions.iter().enumerate() {
                    let factor = tension.sqrt();
                    let touched = wrapped(shape.polygon, first, stencil.len());
                    let factors = stencil.iter().map(|it| factor * it);
                    let terms: Vec<(usize, f64)> = touched.zip(factors).collect();
                    row(Row::Vector(moved(&terms), &terms));
                }
                let [weight, bending] = curve;
                if weight > 0.0 {
                    let factor = (weight / SAMPLES as f64).sqrt();
                    let factors = [(0, factor), (2, factor * bending.sqrt())];
                    curve_rows(shape.polygon, unknowns, &factors, &mut |terms| {
                        row(Row::Vector(moved(terms), terms));
                    });
                }
            }
            Self::CurveMoves { bending } => {
                let factors = [(0, 1.0), (2, bending.sqrt())];
                curve_rows(shape.polygon, unknowns, &factors, &mut |terms| {
                    row(Row::Vector(moved(terms), terms));
                });
            }
            Self::Harmony {
                order,
                measure,
                closeness,
                leg,
            } => {
                moves(closeness.sqrt() / leg);
                let mut differences = |sequence, order, factor| {
                    difference_rows(shape, unknowns, vertices, (sequence, order, factor), row);
                };
                differences(Sequence::LogLeg, 2, LEGS.sqrt());
                let seen = |axis: &DVec3| (Sequence::SeenCurvature(*axis), leg);
                let sequences = match measure {
                    Measure::SignedCurvature => vec![seen(&DVec3::Z)],
                    Measure::CurvatureVector => DVec3::AXES.iter().map(seen).collect(),
                    Measure::CurvatureAndTorsion => {
                        vec![(Sequence::Curvature, leg), (Sequence::TorsionAngle, 1.0)]
                    }
                };
                for (sequence, factor) in sequences {
                    differences(sequence, order, factor);
                }
            }
        }
    }
}

/// A residual, with its gradient by vertices, or with the weights of the vertices of which it is a
/// combination.
enum Row<'a> {
    Scalar(f64, &'a [(usize, DVec3)]),
    Vector(DVec3, &'a [(usize, f64)]),
}

/// Visit the weights of the vertices in derivatives of the curve at samples, times a factor for each
/// order, as far as they depend on the unknowns. Fewer rows with the same sum of squares take their place where they can.
fn curve_rows(
    polygon: &FloatPolygon,
    unknowns: &Unknowns,
    factors: &[(usize, f64)],
    row: &mut impl FnMut(&[(usize, f64)]),
) {
    let width = polygon.degree() + 1;
    // All segments without weights have the same rows.
    let common = (!polygon.is_rational()).then(|| fewer(sampled(polygon, 0, factors), width));
    for segment in 0..polygon.segments() {
        let mut reached = wrapped(polygon, segment, width);
        if !reached.any(|vertex| unknowns.moves(vertex)) {
            continue;
        }
        let own;
        let rows = match &common {
            Some(rows) => rows,
            None => {
                own = sampled(polygon, segment, factors);
                &own
            }
        };
        for BandedRow { first, entries, .. } in rows {
            let touched = wrapped(polygon, segment + first, entries.len());
            let terms: Vec<(usize, f64)> = touched.zip(entries.iter().copied()).collect();
            row(&terms);
        }
    }
}

/// The weights of a segment's vertices at the samples.
fn sampled(polygon: &FloatPolygon, segment: usize, factors: &[(usize, f64)]) -> Vec<BandedRow> {
    let of_sample = |sample: usize| {
        let t = (sample as f64 + 0.5) / SAMPLES as f64;
        let weights = JetWeights::of_segment(polygon, segment, t);
        let rows = factors.iter().map(move |(order, factor)| BandedRow {
            first: 0,
            entries: weights
                .terms(*order)
                .map(|(_, weight)| factor * weight)
                .collect(),
            right: 0.0,
        });
        rows.collect::<Vec<_>>()
    };
    (0..SAMPLES).flat_map(of_sample).collect()
}

/// At most one row for each column, with the same sum of squares; the rows themselves if they are fewer.
fn fewer(rows: Vec<BandedRow>, columns: usize) -> Vec<BandedRow> {
    match BandedQr::new(rows.clone(), columns) {
        Some(factors) => factors.triangle(),
        None => rows,
    }
}

/// Visit the differences of a sequence, times a factor, as far as they depend on the unknowns.
fn difference_rows(
    shape: Shape,
    unknowns: &Unknowns,
    vertices: &[DVec3],
    (sequence, order, factor): (Sequence, usize, f64),
    row: &mut impl FnMut(Row),
) {
    let stencil = difference_stencil(order);
    let width = sequence.width() + order;
    let mut known: Vec<Option<Member>> = vec![None; vertices.len()];
    let mut touched = [DVec3::ZERO; 4];
    let mut gradient: Vec<(usize, DVec3)> = Vec::with_capacity(width);
    for first in windows(shape.polygon, width) {
        let mut reached = wrapped(shape.polygon, first, width);
        if !reached.any(|vertex| unknowns.moves(vertex)) {
            continue;
        }
        let mut reached = wrapped(shape.polygon, first, width);
        if !reached.all(|vertex| shape.counts[vertex]) {
            continue;
        }
        gradient.clear();
        gradient.extend(wrapped(shape.polygon, first, width).map(|vertex| (vertex, DVec3::ZERO)));
        let mut residual = 0.0;
        for (offset, weight) in stencil.iter().enumerate() {
            let start = (first + offset) % vertices.len();
            let member = *known[start].get_or_insert_with(|| {
                let near = wrapped(shape.polygon, start, sequence.width());
                for (place, vertex) in touched.iter_mut().zip(near) {
                    *place = vertices[vertex];
                }
                sequence.member(&touched)
            });
            residual += factor * weight * member.value;
            for (place, slope) in member.gradient[..sequence.width()].iter().enumerate() {
                gradient[offset + place].1 += factor * weight * *slope;
            }
        }
        row(Row::Scalar(residual, &gradient));
    }
}

/// The first vertices of all runs of so many successive ones.
fn windows(polygon: &FloatPolygon, width: usize) -> std::ops::Range<usize> {
    let count = polygon.vertices().len();
    if polygon.is_periodic() {
        0..count
    } else {
        0..(count + 1).saturating_sub(width)
    }
}

/// A run of successive vertices.
fn wrapped(
    polygon: &FloatPolygon,
    first: usize,
    width: usize,
) -> impl Iterator<Item = usize> + use<> {
    let count = polygon.vertices().len();
    (first..first + width).map(move |vertex| vertex % count)
}
