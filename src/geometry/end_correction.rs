//! The paper's seven steps (section 3): correct an end by moving its n terminal vertices as one
//! rigid body.
//!
//! Only the n terminal vertices act at an end. Translating them by the position difference and
//! then rotating them about the new end point by the difference angle moves the end jet, up to
//! the derivative of order n − 1, rigidly: with n ≥ 3 the end's curvature is kept, with n ≥ 4 its
//! slope too. With N ≥ 2n the other end does not feel it and one pass is exact. With fewer
//! vertices the two groups overlap, and correcting the ends in turn converges slowly, if at all
//! (n + 1 < N < 2n), or not (N = n + 1): see [`super::joint_correction`].

use glam::{DMat3, DVec3};

use super::control_polygon::MAX_MAGNITUDE;
use super::end::{End, rotation_between};
use super::error::PolygonError;
use super::float_polygon::FloatPolygon;
use super::vector;

/// Passes without halving of the residual after which the loop is taken not to converge.
const PATIENCE: usize = 4;

/// The most passes that the loop makes.
const MOST_PASSES: usize = 100;

/// What an end of the curve shall be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndTarget {
    /// Where the end point shall lie.
    pub point: DVec3,
    /// The direction that the tangent shall have, along rising u; of any length but 0. `None`
    /// leaves the direction free.
    pub direction: Option<DVec3>,
}

impl EndTarget {
    /// Turn the direction round, as when the curve is passed through the other way.
    pub fn turned(self) -> Self {
        Self {
            direction: self.direction.map(|direction| -direction),
            ..self
        }
    }

    /// Whether every number of the target can be used: the point's coordinates up to 1e100 in
    /// magnitude, the direction's too, and not all of these 0.
    pub fn is_usable(&self) -> bool {
        // The largest component of a vector passes over what is not a number.
        let usable = |vector: DVec3| vector.to_array().iter().all(|c| c.abs() <= MAX_MAGNITUDE);
        let directed = |direction: DVec3| usable(direction) && direction != DVec3::ZERO;
        usable(self.point) && self.direction.is_none_or(directed)
    }
}

/// What an end of the curve lacks of its target: the paper's third step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndDifference {
    /// The position difference vector, target minus actual end point.
    pub vector: DVec3,
    /// The angle in radians by which the tangent must turn: in the plane z = 0 signed, left
    /// turns positive; in space not negative. 0 where no direction is asked for, or where the
    /// curve has no tangent.
    pub angle: f64,
}

impl EndDifference {
    /// Measure what one end lacks of its target.
    pub fn between(polygon: &FloatPolygon, end: End, target: &EndTarget) -> Self {
        let jet = polygon.end_jet(end);
        let angle = match (jet.tangent(), target.direction) {
            (Some(actual), Some(wanted)) => angle_between(actual, wanted),
            _ => 0.0,
        };
        Self {
            vector: target.point - jet.point,
            angle,
        }
    }

    /// Express both differences as one length: the larger of the position difference and of
    /// the arc that `size` sweeps through the difference angle.
    pub fn residual(&self, size: f64) -> f64 {
        vector::length(self.vector).max(self.angle.abs() * size)
    }
}

/// Measure the angle from one direction to another in radians: in the plane z = 0 signed, left
/// turns positive; in space not negative. 0 if either vector is zero.
pub fn angle_between(from: DVec3, to: DVec3) -> f64 {
    let ((from, _), (to, _)) = (vector::scaled(from), vector::scaled(to));
    if from.z == 0.0 && to.z == 0.0 {
        let sine = from.truncate().perp_dot(to.truncate());
        sine.atan2(from.truncate().dot(to.truncate()))
    } else {
        from.cross(to).length().atan2(from.dot(to))
    }
}

/// Translate the n terminal vertices of an end by `vector` (step 5): the end point moves by just
/// that.
///
/// # Errors
/// [`PolygonError::BadCoordinate`] if a vertex would leave the range of numbers.
pub fn translate_end(
    polygon: &FloatPolygon,
    end: End,
    vector: DVec3,
) -> Result<FloatPolygon, PolygonError> {
    let mut corrected = polygon.clone();
    let moved = polygon.terminal_vertices(end);
    corrected.move_vertices(moved.map(|index| (index, polygon.vertex(index) + vector)))?;
    Ok(corrected)
}

/// Rotate the n terminal vertices of an end about the actual end point (step 6): the end point
/// stays, the tangent turns with `rotation`.
///
/// # Errors
/// [`PolygonError::BadCoordinate`] if a vertex would leave the range of numbers.
pub fn rotate_end(
    polygon: &FloatPolygon,
    end: End,
    rotation: DMat3,
) -> Result<FloatPolygon, PolygonError> {
    let pivot = polygon.end_jet(end).point;
    let mut corrected = polygon.clone();
    let moved = polygon.terminal_vertices(end);
    corrected.move_vertices(moved.map(|index| {
        let arm = polygon.vertex(index) - pivot;
        (index, pivot + rotation * arm)
    }))?;
    Ok(corrected)
}

/// Rotate an end so that its tangent points along `direction` (step 6). A curve without a
/// tangent at this end is returned as it is.
///
/// # Errors
/// As [`rotate_end`].
pub fn align_end(
    polygon: &FloatPolygon,
    end: End,
    direction: DVec3,
) -> Result<FloatPolygon, PolygonError> {
    match rotation_between(polygon.end_jet(end).first, direction) {
        Some(rotation) => rotate_end(polygon, end, rotation),
        None => Ok(polygon.clone()),
    }
}

/// How the vertices of the two ends share the polygon, and so whether the loop converges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndOverlap {
    /// N ≥ 2n: no vertex is shared, and one pass is exact.
    None,
    /// n + 1 < N < 2n: the loop converges linearly.
    Partial {
        /// The number of vertices that belong to both ends.
        shared: usize,
    },
    /// N = n + 1, one segment: the loop does not converge.
    OneSegment,
}

impl EndOverlap {
    /// Tell how the ends of an open polygon overlap.
    pub fn of(polygon: &FloatPolygon) -> Self {
        let count = polygon.vertices().len();
        let terminal = polygon.terminal_vertices(End::Start).len();
        if count >= 2 * terminal {
            Self::None
        } else if count == polygon.degree() + 1 {
            Self::OneSegment
        } else {
            Self::Partial {
                shared: 2 * terminal - count,
            }
        }
    }
}

/// How the loop over steps 2 to 6 ended.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopOutcome {
    /// The corrected polygon if the loop converged; otherwise the polygon that it began with.
    pub polygon: FloatPolygon,
    /// Whether every end reached its target within the tolerance.
    pub converged: bool,
    /// The largest residual of the ends before the first pass and after each.
    pub residuals: Vec<f64>,
}

impl LoopOutcome {
    /// The number of passes made.
    pub fn passes(&self) -> usize {
        self.residuals.len() - 1
    }
}

/// Correct the ends in turn, pass by pass, until every residual is at most `tolerance` (a
/// length; angles count as arcs over the polygon's size).
///
/// It stops without a change as soon as four passes have not halved the residual.
///
/// # Errors
/// [`PolygonError`] if a vertex would leave the range of numbers.
pub fn correct_in_turn(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    tolerance: f64,
) -> Result<LoopOutcome, PolygonError> {
    let size = polygon.size();
    let residual = |polygon: &FloatPolygon| {
        let ends = targets.iter();
        ends.map(|(end, target)| EndDifference::between(polygon, *end, target).residual(size))
            .fold(0.0, f64::max)
    };
    let mut residuals = vec![residual(polygon)];
    let mut corrected = polygon.clone();
    let mut converged = residuals[0] <= tolerance;
    while !converged && residuals.len() <= MOST_PASSES {
        for (end, target) in targets {
            corrected = correct_end(&corrected, *end, target)?;
        }
        let now = residual(&corrected);
        residuals.push(now);
        converged = now <= tolerance;
        let earlier = residuals.len().checked_sub(PATIENCE + 1);
        if earlier.is_some_and(|index| now.is_nan() || now > 0.5 * residuals[index]) {
            break;
        }
    }
    Ok(LoopOutcome {
        polygon: if converged {
            corrected
        } else {
            polygon.clone()
        },
        converged,
        residuals,
    })
}

/// Correct one end by one translation and one rotation (steps 5 and 6).
///
/// # Errors
/// [`PolygonError`] if a vertex would leave the range of numbers.
pub fn correct_end(
    polygon: &FloatPolygon,
    end: End,
    target: &EndTarget,
) -> Result<FloatPolygon, PolygonError> {
    let difference = EndDifference::between(polygon, end, target);
    let translated = translate_end(polygon, end, difference.vector)?;
    match target.direction {
        Some(direction) => align_end(&translated, end, direction),
        None => Ok(translated),
    }
}
