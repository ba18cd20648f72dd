//! Given data of a segment: its two ends.

use std::ops::RangeInclusive;

use glam::{DQuat, DVec2};

use super::error::BetweenError;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::references::{Placement, ReferenceError};

/// The lengths that can be computed with: their cubes are in the range of numbers.
const LENGTHS: RangeInclusive<f64> = 1e-100..=1e100;

/// Angles, in radians, that rounding leaves between directions that are the same.
const ROUNDING: f64 = 1e-14;

/// How far a curvature may be off the one asked for, relative to it, and be met: correcting the ends
/// does the rest.
pub(super) const SAME: f64 = 1e-9;

/// Hold the two ends that a segment runs between, in the plane z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// Its start and its end.
    pub points: [DVec2; 2],
    /// Its directions there, along the segment; of any length but 0.
    pub directions: [DVec2; 2],
    /// The signed curvatures there, positive where it turns left; `None` leaves them free.
    pub curvatures: [Option<f64>; 2],
}

/// Hold what is left of two ends once place, size and side are taken away: the chord runs from (0, 0)
/// to (1, 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Task {
    /// The angle from the direction at the start to the chord, and from the chord to the direction
    /// at the end, in radians, −π to π. Their sum, the angle that the segment turns by, is not
    /// negative.
    pub(super) angles: [f64; 2],
    /// The curvatures times the chord.
    pub(super) curvatures: [Option<f64>; 2],
    /// The ends that it was made of.
    ends: Ends,
    /// Whether left was made right.
    mirrored: bool,
}

impl Ends {
    /// Give directions of extreme lengths moderate ones, so that squares of them are in the range of numbers.
    pub(super) fn with_moderate_directions(&self) -> Self {
        let moderate = |direction: DVec2| {
            let size = direction.abs().max_element();
            if LENGTHS.contains(&size) {
                direction
            } else {
                direction / size
            }
        };
        Self {
            directions: self.directions.map(moderate),
            ..*self
        }
    }

    /// What the segment must have at its start, 0, or its end, 1.
    pub(super) fn target(&self, index: usize) -> EndTarget {
        EndTarget {
            point: self.points[index].extend(0.0),
            direction: Some(self.directions[index].extend(0.0)),
            curvature: self.curvatures[index],
            ..EndTarget::default()
        }
    }

    /// Take away place, size and side.
    ///
    /// # Errors
    /// [`BetweenError::NoChord`], [`BetweenError::NoDirection`].
    pub(super) fn task(&self) -> Result<Task, BetweenError> {
        let [from, to] = self.points;
        let chord = to - from;
        let size = from.abs().max_element().max(to.abs().max_element());
        let distance = chord.abs().max_element();
        if !(distance > f64::EPSILON * size) {
            return Err(BetweenError::NoChord);
        }
        if !LENGTHS.contains(&distance) {
            return Err(BetweenError::ChordOutOfRange { distance });
        }
        let directed = |vector: DVec2| vector.try_normalize().is_some();
        if !self.directions.into_iter().all(directed) {
            return Err(BetweenError::NoDirection);
        }
        let [first, last] = self.directions;
        let angles = [angle(first, chord), angle(chord, last)];
        let mirrored = angles[0] + angles[1] < 0.0;
        let side = if mirrored { -1.0 } else { 1.0 };
        let curvatures = self.curvatures;
        Ok(Task {
            angles: angles.map(|angle| side * angle),
            curvatures: curvatures.map(|it| it.map(|it| side * it * chord.length())),
            ends: *self,
            mirrored,
        })
    }
}

impl Task {
    /// The angle that the segment turns by, not negative.
    pub(super) fn turning(&self) -> f64 {
        self.angles[0] + self.angles[1]
    }

    /// By how much the chord leans from the direction half way towards that at the end: 0 for a
    /// circular arc, positive where the curvature falls.
    pub(super) fn lean(&self) -> f64 {
        0.5 * (self.angles[0] - self.angles[1])
    }

    /// Whether the ends can be joined without an inflection: both directions turn the same way from
    /// the chord, and so do the curvatures that are given.
    pub(super) fn is_convex(&self) -> bool {
        let given = self.curvatures.into_iter().flatten();
        self.angles.into_iter().chain(given).all(|it| it > 0.0)
    }

    /// Whether both directions follow the chord but for rounding, and no curvature is requested.
    pub(super) fn is_straight(&self) -> bool {
        let bends = self.curvatures.into_iter().flatten();
        let follow = self.angles.into_iter().all(|it| it.abs() <= ROUNDING);
        follow && bends.into_iter().all(|it| it == 0.0)
    }

    /// Whether the ends are those of a circular arc but for rounding: the angles to the chord are equal, and
    /// no curvature or that of the arc is asked for.
    pub(super) fn is_arc(&self) -> bool {
        let given = self.curvatures.into_iter().flatten();
        let arc = 2.0 * (0.5 * self.turning()).sin();
        self.lean().abs() <= ROUNDING
            && arc > 0.0
            && given.into_iter().all(|it| (it - arc).abs() <= SAME * arc)
    }

    /// The length of the chord.
    pub(super) fn chord(&self) -> f64 {
        let [from, to] = self.ends.points;
        from.distance(to)
    }

    /// The curvature at an end, of a curve that has it where the chord is 1.
    pub(super) fn curvature(&self, curvature: f64) -> f64 {
        let side = if self.mirrored { -1.0 } else { 1.0 };
        side * curvature / self.chord()
    }

    /// The point of the plane that a point stands for.
    fn point(&self, point: DVec2) -> DVec2 {
        let [from, to] = self.ends.points;
        let side = if self.mirrored { -1.0 } else { 1.0 };
        from + (to - from).rotate(DVec2::new(point.x, side * point.y))
    }

    /// The placement that brings a curve from one pair of points to another: `own` are points of the
    /// curve where its formula puts it, and `wanted` points on the chord from (0, 0) to (1, 0) at which
    /// they come to lie; `over` turns the curve over first.
    ///
    /// # Errors
    /// [`ReferenceError::BadPlacement`] if the points leave the range of sizes.
    pub(super) fn placement(
        &self,
        own: [DVec2; 2],
        wanted: [DVec2; 2],
        over: bool,
    ) -> Result<Placement, ReferenceError> {
        let wanted = wanted.map(|point| self.point(point));
        let [before, after] = [own, wanted].map(|[from, to]| to - from);
        let scale = after.length() / before.length();
        // Turning over about an axis in the plane takes an angle to twice the axis's less that angle.
        let rotation = if over ^ self.mirrored {
            let axis = DVec2::from_angle(0.5 * (after.to_angle() + before.to_angle()));
            DQuat::from_xyzw(axis.x, axis.y, 0.0, 0.0)
        } else {
            let half = DVec2::from_angle(0.5 * angle(before, after));
            DQuat::from_xyzw(0.0, 0.0, half.y, half.x)
        };
        let turned = scale * (rotation * own[0].extend(0.0));
        Placement::new(rotation, scale, wanted[0].extend(0.0) - turned)
    }
}

/// The angle from one vector to another, by a tangent: a cosine would lose half of the digits of small
/// angles.
pub(super) fn angle(from: DVec2, to: DVec2) -> f64 {
    from.perp_dot(to).atan2(from.dot(to))
}
