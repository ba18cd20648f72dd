//! The paper's seven steps (section 3): correct an end by moving its n terminal vertices as one
//! rigid body.
//!
//! Only the n terminal vertices act at an end. Translating them by the position difference and
//! then rotating them about the new end point by the difference angle moves the end jet, up to
//! the derivative of order n − 1, rigidly: with n ≥ 3 the end's curvature is kept, with n ≥ 4 its
//! slope too. With N ≥ 2n the other end does not feel it and one pass is exact. With fewer
//! vertices the two groups overlap, and correcting the ends in turn converges slowly, if at all
//! (n + 1 < N < 2n), or not (N = n + 1): see [`super::fairing::joint_correction`].

use glam::{DMat3, DVec3};

use super::control_polygon::MAX_MAGNITUDE;
use super::end::{End, rotation_between};
use super::error::PolygonError;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;
use super::vector;

/// Passes without halving of the residual after which the loop is taken not to converge.
const PATIENCE: usize = 4;

/// The most passes that the loop makes.
const MOST_PASSES: usize = 100;

/// Target of an end of the curve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndTarget {
    /// The wanted end point.
    pub point: DVec3,
    /// The direction that the tangent shall have, along rising u; of any length but 0. `None`
    /// leaves the direction free.
    pub direction: Option<DVec3>,
    /// The curvature that the curve shall have there: signed for a planar curve, positive where it
    /// turns left; its magnitude counts in space. `None` leaves it free.
    pub curvature: Option<f64>,
    /// The normal of the osculating plane of a curve in space, along C′ × C″; of any length but 0.
    /// `None` leaves the plane free. A planar curve has its plane already.
    pub normal: Option<DVec3>,
    /// The slope dκ/ds of the curvature by arc length. `None` leaves it free.
    pub slope: Option<f64>,
}

impl EndTarget {
    /// Keep an end at its point, in its direction if it has one.
    pub fn keeping(jet: &Jet) -> Self {
        Self {
            point: jet.point,
            direction: jet.tangent(),
            ..Self::default()
        }
    }

    /// Turn the target round, as when the curve, `planar` or not, is passed through the other way:
    /// the direction points back. The signed curvature of a planar curve changes its sign, and its
    /// slope stays; in space the curvature stays, its slope and the normal change their signs.
    pub fn turned(self, planar: bool) -> Self {
        let turned = |number: f64| -number;
        Self {
            point: self.point,
            direction: self.direction.map(|direction| -direction),
            curvature: self.curvature.map(|it| if planar { -it } else { it }),
            normal: self.normal.map(|normal| -normal),
            slope: if planar {
                self.slope
            } else {
                self.slope.map(turned)
            },
        }
    }

    /// Whether every number of the target can be used: up to 1e100 in magnitude, and no vector but
    /// the point 0.
    pub fn is_usable(&self) -> bool {
        // The largest component of a vector passes over what is not a number.
        let usable = |number: f64| number.abs() <= MAX_MAGNITUDE;
        let bounded = |vector: DVec3| vector.to_array().into_iter().all(usable);
        let directed = |direction: DVec3| bounded(direction) && direction != DVec3::ZERO;
        bounded(self.point)
            && self.direction.is_none_or(directed)
            && self.normal.is_none_or(directed)
            && self.curvature.is_none_or(usable)
            && self.slope.is_none_or(usable)
    }

    /// Whether the target can be met without leaving the plane z = 0.
    pub fn is_planar(&self) -> bool {
        let level = |vector: DVec3| vector.z == 0.0;
        let upright = |vector: DVec3| vector.x == 0.0 && vector.y == 0.0;
        level(self.point) && self.direction.is_none_or(level) && self.normal.is_none_or(upright)
    }
}

/// Difference of an end from its target: the paper's third step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndDifference {
    /// The position difference vector, target minus actual end point.
    pub vector: DVec3,
    /// The angle in radians by which the tangent must turn: in the plane z = 0 signed, left
    /// turns positive; in space not negative. 0 where no direction is asked for, or where the
    /// curve has no tangent.
    pub angle: f64,
    /// The curvature that is missing, target minus actual; 0 where none is asked for.
    pub curvature: f64,
    /// The angle in radians, not negative, by which the osculating plane must turn; 0 where no plane
    /// is asked for, or where the curve has none.
    pub plane: f64,
    /// The slope of the curvature that is missing, target minus actual; 0 where none is asked for.
    pub slope: f64,
}

impl EndDifference {
    /// Measure the difference of an end from its target.
    pub fn between(polygon: &FloatPolygon, end: End, target: &EndTarget) -> Self {
        let planar = polygon.is_planar() && target.is_planar();
        Self::of_jet(&polygon.end_jet(end), planar, target)
    }

    /// Measure the difference of a point of a curve, `planar` or not, from a target.
    pub fn of_jet(jet: &Jet, planar: bool, target: &EndTarget) -> Self {
        let angle = match (jet.tangent(), target.direction) {
            (Some(actual), Some(wanted)) => angle_between(actual, wanted),
            _ => 0.0,
        };
        let curvature = target.curvature.map_or(0.0, |wanted| {
            let wanted = if planar { wanted } else { wanted.abs() };
            wanted - jet.curvature_of(planar)
        });
        let actual = vector::scaled(jet.first)
            .0
            .cross(vector::scaled(jet.second).0);
        let plane = match target.normal.filter(|_| !planar) {
            Some(wanted) if actual != DVec3::ZERO => angle_between(actual, wanted).abs(),
            _ => 0.0,
        };
        let slope = target
            .slope
            .map_or(0.0, |wanted| wanted - jet.curvature_slope(planar));
        Self {
            vector: target.point - jet.point,
            angle,
            curvature,
            plane,
            slope,
        }
    }

    /// Express the differences as one length, the largest of: the position difference; the arcs that
    /// `size` sweeps through the angles; the curvature times `size`², its slope times `size`³.
    /// Infinite where the curve has no curvature or slope to compare.
    pub fn residual(&self, size: f64) -> f64 {
        let lengths = [
            vector::length(self.vector),
            self.angle.abs() * size,
            self.plane * size,
            self.curvature.abs() * size * size,
            self.slope.abs() * size * size * size,
        ];
        lengths.into_iter().fold(0.0, vector::larger)
    }
}

/// The largest [residual](EndDifference::residual) of a polygon's ends.
pub(super) fn largest_residual(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    size: f64,
) -> f64 {
    let left = targets.iter();
    left.map(|(end, target)| EndDifference::between(polygon, *end, target).residual(size))
        .fold(0.0, vector::larger)
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

/// Overlap of the two ends' vertices, which decides whether the loop converges.
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

/// Result of the loop over steps 2 to 6.
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
    let residual = |polygon: &FloatPolygon| largest_residual(polygon, targets, size);
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
