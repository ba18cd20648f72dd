//! Both ends at once: the least disturbance that meets every end condition.
//!
//! The vertex moves δ minimise Σ|Δᵏδᵢ|² + μ Σ|δᵢ|² under the end conditions, which are linear in
//! the vertices: an end point is a weighted mean of its n terminal vertices, and the tangent has
//! no part across the target direction. With H = DᵀD + μI (banded) and the rows A of the
//! conditions, δ = H⁻¹Aᵀλ, A H⁻¹Aᵀ λ = b.

use glam::DVec3;
use thiserror::Error;

use super::banded::BandedCholesky;
use super::end::End;
use super::end_correction::{EndDifference, EndTarget};
use super::error::PolygonError;
use super::float_polygon::FloatPolygon;
use super::pivoted_cholesky::PivotedCholesky;
use super::vector;

/// The order k of the differences kept small: 1 moves the vertices least.
const SMOOTHNESS: usize = 1;

/// The weight μ of the moves themselves; a correction fades over about 1/√μ vertices.
const FIDELITY: f64 = 1e-3;

/// Solutions repeated on what is left: two bring the residual down to rounding.
const REFINEMENTS: usize = 4;

/// The residual, in units of the curve's size, above which the conditions count as not met.
const MET: f64 = 1e-11;

/// Pivots of the small system below this share of the largest count as zero.
const RANK_TOLERANCE: f64 = 1e-13;

/// Why both ends cannot be corrected at once.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CorrectionError {
    /// A periodic curve has no ends.
    #[error("the curve is periodic and has no ends: open it first")]
    Periodic,
    /// A target direction is the zero vector.
    #[error("the {} has a target direction of length 0: give it a direction", .end.name())]
    NoDirection {
        /// The end.
        end: End,
    },
    /// The conditions contradict each other or the polygon has too few vertices for them.
    #[error(
        "{vertices} vertices of degree {degree} cannot meet these end conditions (off by {residual:.2e}): free a direction, or give the curve more vertices"
    )]
    NotSolvable {
        /// The number of vertices.
        vertices: usize,
        /// The degree.
        degree: usize,
        /// The largest residual left, as a length.
        residual: f64,
    },
    /// A vertex would leave the range of numbers.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

/// The result of a joint correction.
#[derive(Clone, Debug, PartialEq)]
pub struct JointCorrection {
    /// The corrected polygon.
    pub polygon: FloatPolygon,
    /// The largest move of a vertex.
    pub largest_move: f64,
    /// The vertex that moves most.
    pub largest_at: usize,
    /// The largest residual of an end afterwards, as [`EndDifference::residual`] measures it.
    pub residual: f64,
}

/// Move the vertices as little as possible so that every target is met, for any N ≥ n + 1,
/// polynomial or rational, in the plane or in space.
///
/// A planar curve with planar targets stays planar. Should a tangent come out backwards, the
/// system is solved again with the tangent's old length prescribed.
///
/// # Errors
/// [`CorrectionError`] if the curve is periodic, a direction is 0, or the conditions cannot be
/// met.
pub fn correct_jointly(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
) -> Result<JointCorrection, CorrectionError> {
    if polygon.is_periodic() {
        return Err(CorrectionError::Periodic);
    }
    let zero = |target: &EndTarget| {
        target
            .direction
            .is_some_and(|direction| vector::direction(direction).is_none())
    };
    if let Some((end, _)) = targets.iter().find(|(_, target)| zero(target)) {
        return Err(CorrectionError::NoDirection { end: *end });
    }
    let free = solve(polygon, targets, TangentLength::Free);
    match free {
        // A backward tangent is half a turn away from its target, so the target counts as missed.
        Err(CorrectionError::NotSolvable { .. }) => {
            solve(polygon, targets, TangentLength::Kept).or(free)
        }
        Ok(correction) if !points_forward(&correction.polygon, targets) => {
            solve(polygon, targets, TangentLength::Kept)
        }
        other => other,
    }
}

/// Whether the length of an end's derivative is free or kept.
#[derive(Clone, Copy, PartialEq)]
enum TangentLength {
    Free,
    Kept,
}

/// One scalar condition: Σ stencilᵢ (axis · Pᵢ) = value.
struct Condition {
    stencil: usize,
    axis: DVec3,
    value: f64,
}

fn points_forward(polygon: &FloatPolygon, targets: &[(End, EndTarget)]) -> bool {
    targets.iter().all(|(end, target)| {
        let along = |direction: DVec3| polygon.end_jet(*end).first.dot(direction) > 0.0;
        target.direction.is_none_or(along)
    })
}

fn solve(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    length: TangentLength,
) -> Result<JointCorrection, CorrectionError> {
    let flat = polygon.is_planar()
        && targets.iter().all(|(_, target)| {
            target.point.z == 0.0 && target.direction.is_none_or(|direction| direction.z == 0.0)
        });
    let mut stencils: Vec<Vec<f64>> = Vec::new();
    let mut conditions: Vec<Condition> = Vec::new();
    for (end, target) in targets {
        let (point, derivative) = end_stencils(polygon, *end);
        for axis in &[DVec3::X, DVec3::Y, DVec3::Z][..if flat { 2 } else { 3 }] {
            let value = target.point.dot(*axis);
            conditions.push(Condition {
                stencil: stencils.len(),
                axis: *axis,
                value,
            });
        }
        stencils.push(point);
        if let Some(direction) = target.direction.and_then(vector::direction) {
            let speed = polygon.end_jet(*end).speed();
            for (axis, value) in tangent_axes(direction, flat, length, speed) {
                conditions.push(Condition {
                    stencil: stencils.len(),
                    axis,
                    value,
                });
            }
        }
        stencils.push(derivative);
    }
    minimise(polygon, targets, &stencils, &conditions)
}

/// The directions in which a tangent is prescribed, with the values it shall have there.
fn tangent_axes(
    direction: DVec3,
    flat: bool,
    length: TangentLength,
    speed: f64,
) -> impl Iterator<Item = (DVec3, f64)> {
    let across = if flat {
        [Some(DVec3::new(-direction.y, direction.x, 0.0)), None]
    } else {
        let (first, second) = direction.any_orthonormal_pair();
        [Some(first), Some(second)]
    };
    let along = (length == TangentLength::Kept).then_some((direction, speed));
    across
        .into_iter()
        .flatten()
        .map(|axis| (axis, 0.0))
        .chain(along)
}

/// The weights with which all vertices enter an end's point and derivative. For a rational curve
/// the weights take part: C′ = Σ wᵢ (bᵢ′ − (w′/w) bᵢ) Pᵢ / w.
fn end_stencils(polygon: &FloatPolygon, end: End) -> (Vec<f64>, Vec<f64>) {
    let range = polygon.terminal_vertices(end);
    let basis = polygon.end_weights(end, 0);
    let slopes = polygon.end_weights(end, 1);
    let weighted = |values: &[f64]| -> f64 {
        let pairs = values.iter().zip(range.clone());
        pairs
            .map(|(value, index)| value * polygon.weight(index))
            .sum()
    };
    let (weight, weight_slope) = (weighted(&basis), weighted(&slopes));
    let mut point = vec![0.0; polygon.vertices().len()];
    let mut derivative = point.clone();
    for (j, index) in range.clone().enumerate() {
        let share = polygon.weight(index) / weight;
        point[index] = share * basis[j];
        derivative[index] = share * (slopes[j] - weight_slope / weight * basis[j]);
    }
    (point, derivative)
}

fn minimise(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    stencils: &[Vec<f64>],
    conditions: &[Condition],
) -> Result<JointCorrection, CorrectionError> {
    let count = polygon.vertices().len();
    let factor = BandedCholesky::of_differences(count, SMOOTHNESS, FIDELITY);
    let responses: Vec<Vec<f64>> = stencils.iter().map(|row| factor.solve(row)).collect();
    let entry = |row: usize, column: usize| {
        let (a, b) = (&conditions[row], &conditions[column]);
        a.axis.dot(b.axis) * dot(&stencils[a.stencil], &responses[b.stencil])
    };
    // Points and derivatives, and the ends of a curve with very different weights, differ by
    // orders of magnitude: each condition is measured in its own unit.
    let units: Vec<f64> = (0..conditions.len())
        .map(|row| entry(row, row).sqrt().recip())
        .collect();
    let gram = |row: usize, column: usize| units[row] * entry(row, column) * units[column];
    let factor_of_gram = PivotedCholesky::new(conditions.len(), gram, RANK_TOLERANCE);
    let size = polygon.size();
    let mut corrected = polygon.clone();
    let Some(gram) = factor_of_gram else {
        return report(polygon, corrected, targets, size);
    };
    for _ in 0..REFINEMENTS {
        let missing: Vec<f64> = conditions
            .iter()
            .zip(&units)
            .map(|(condition, unit)| {
                let stencil = &stencils[condition.stencil];
                unit * (condition.value - functional(&corrected, stencil, condition.axis))
            })
            .collect();
        let multipliers = gram.solve(&missing);
        let mut moves = vec![DVec3::ZERO; count];
        let multipliers = multipliers
            .iter()
            .zip(&units)
            .map(|(value, unit)| value * unit);
        for (condition, multiplier) in conditions.iter().zip(multipliers) {
            let response = &responses[condition.stencil];
            for (movement, value) in moves.iter_mut().zip(response) {
                *movement += multiplier * *value * condition.axis;
            }
        }
        let moved: Vec<(usize, DVec3)> = moves
            .iter()
            .enumerate()
            .map(|(index, movement)| (index, corrected.vertex(index) + *movement))
            .collect();
        corrected.move_vertices(moved)?;
    }
    report(polygon, corrected, targets, size)
}

fn report(
    before: &FloatPolygon,
    polygon: FloatPolygon,
    targets: &[(End, EndTarget)],
    size: f64,
) -> Result<JointCorrection, CorrectionError> {
    let residual = targets
        .iter()
        .map(|(end, target)| EndDifference::between(&polygon, *end, target).residual(size))
        .fold(0.0, f64::max);
    let reach = polygon.vertices().iter().map(|v| v.abs().max_element());
    let scale = reach.fold(size, f64::max);
    if residual.is_nan() || residual > MET * scale {
        return Err(CorrectionError::NotSolvable {
            vertices: before.vertices().len(),
            degree: before.degree(),
            residual,
        });
    }
    let moves = before.vertices().iter().zip(polygon.vertices());
    let (largest_at, largest_move) =
        moves
            .map(|(old, new)| old.distance(*new))
            .enumerate()
            .fold((0, 0.0), |best, candidate| {
                if candidate.1 > best.1 {
                    candidate
                } else {
                    best
                }
            });
    Ok(JointCorrection {
        polygon,
        largest_move,
        largest_at,
        residual,
    })
}

fn functional(polygon: &FloatPolygon, stencil: &[f64], axis: DVec3) -> f64 {
    let terms = stencil.iter().zip(polygon.vertices());
    terms
        .filter(|(weight, _)| **weight != 0.0)
        .map(|(weight, vertex)| weight * vertex.dot(axis))
        .sum()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
