//! How distances from a curve are drawn: whiskers that stand on the curve.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::geometry::bounds;

/// The share of the size of the points that the longest whisker has at most, without a scale of the user's own.
const LONGEST: f64 = 0.05;

/// How much longer or shorter than by a scale made to suit them the whiskers may get before they get another one: a
/// scale that changes with each distance says nothing about what a drag does.
const SUITABLE: RangeInclusive<f64> = 0.1..=2.5;

/// How whiskers are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whiskers {
    /// Whether they are shown.
    pub shown: bool,
    /// How many times they are longer than the distances; `None` for a round number that suits the distances.
    pub scale: Option<f64>,
    /// The distance between two curves beyond which they are marked and counted.
    pub limit: Option<f64>,
    /// Whether points past an end of the curve are left out of its deviation.
    pub within_ends: bool,
}

impl Whiskers {
    /// The scales that can be drawn.
    pub const SCALES: RangeInclusive<f64> = 1e-6..=1e15;

    /// The scale for some points with a largest distance.
    pub fn scale_for(&self, points: &[DVec3], largest: f64) -> f64 {
        let (least, most) = Self::SCALES.into_inner();
        let own = || {
            let (low, high) = bounds(points);
            // Shorter than they are, distances would mislead.
            round_below(LONGEST * (high - low).length() / largest).max(1.0)
        };
        let scale = self.scale.unwrap_or_else(own);
        // No distance, or no number.
        let scale = if scale.is_finite() { scale } else { 1.0 };
        scale.clamp(least, most)
    }

    /// The scale that whiskers keep, of the one they have and the one that suits the distances now.
    pub(super) fn kept_scale(had: Option<f64>, suiting: f64) -> f64 {
        let is_suitable = |had: &f64| SUITABLE.contains(&(had / suiting));
        had.filter(is_suitable).unwrap_or(suiting)
    }

    /// The whisker of a point with its nearest place: from that place through the point.
    pub fn whisker([point, nearest]: [DVec3; 2], scale: f64) -> [DVec3; 2] {
        [nearest, nearest + scale * (point - nearest)]
    }
}

impl Default for Whiskers {
    fn default() -> Self {
        Self {
            shown: true,
            scale: None,
            limit: None,
            within_ends: false,
        }
    }
}

/// The largest of the numbers 1, 2 and 5 times a power of ten up to another one.
fn round_below(number: f64) -> f64 {
    let power = 10.0_f64.powf(number.log10().floor());
    let fits = |digit: &f64| digit * power <= number;
    [5.0, 2.0].into_iter().find(fits).unwrap_or(1.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_the_users_or_a_round_one_that_suits_the_distances() {
        let points = [DVec3::ZERO, DVec3::X];
        let own = Whiskers::default();
        assert_eq!(own.scale_for(&points, 3e-4), 100.0);
        assert_eq!(own.scale_for(&points, 2.4e-4), 200.0);
        for largest in [0.0, f64::NAN, 3.0] {
            assert_eq!(own.scale_for(&points, largest), 1.0);
        }
        assert_eq!(own.scale_for(&[], 1.0), 1.0);
        let given = Whiskers {
            scale: Some(37.0),
            ..own
        };
        assert_eq!(given.scale_for(&points, 3e-4), 37.0);
    }

    #[test]
    fn a_scale_is_kept_while_its_whiskers_can_be_read() {
        let kept = Whiskers::kept_scale;
        assert_eq!(kept(None, 50.0), 50.0);
        assert_eq!(
            [20.0, 50.0, 500.0].map(|it| kept(Some(50.0), it)),
            [50.0; 3]
        );
        assert_eq!(
            [10.0, 1000.0].map(|it| kept(Some(50.0), it)),
            [10.0, 1000.0]
        );
    }
}
