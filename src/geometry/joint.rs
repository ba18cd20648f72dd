//! A joint: how one curve goes on from another where their ends meet, or nearly do.

use std::f64::consts::PI;

use glam::DVec3;

use super::continuity::Continuity;
use super::jet::Jet;

/// The largest angle between the tangents of curves that go on without a corner, in radians: 0.1°.
pub const SMOOTH: f64 = 0.1 * PI / 180.0;

/// The largest difference of two curvatures that counts as none, by the larger of both and of 1 over the size; of their
/// slopes, by the larger of both and of 1 over its square.
const EQUAL: f64 = 0.01;

/// The differences from the end of one curve to the start of another that goes on from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// The distance of the ends.
    pub gap: f64,
    /// The angle between the tangents, in radians; half a turn where an end has none.
    pub angle: f64,
    /// The difference κ₂ − κ₁ of signed curvatures, in space the length of that of the curvature vectors. Not a number
    /// at a cusp.
    pub curvature: f64,
    /// The difference of the slopes dκ/ds. Not a number at a cusp, and in space where a curve has no curvature.
    pub slope: f64,
    /// The larger magnitude of both curvatures, and of both slopes.
    largest: [f64; 2],
    /// The length of the difference of the curvature vectors.
    bend: f64,
}

impl Joint {
    /// Measure how a curve goes on at its start from the end of another, `planar` if both are.
    pub fn between(before: &Jet, after: &Jet, planar: bool) -> Self {
        let jets = [before, after];
        let tangents = before.tangent().zip(after.tangent());
        let [one, two] = jets.map(Jet::curvature_vector);
        let bend = (two - one).length();
        let curvatures = jets.map(|jet| jet.curvature_of(planar));
        let slopes = jets.map(|jet| match jet.curvature_slope(planar) {
            // A line in space has no osculating plane, and stays straight.
            _ if jet.first != DVec3::ZERO
                && jet.second == DVec3::ZERO
                && jet.third == DVec3::ZERO =>
            {
                0.0
            }
            slope => slope,
        });
        let largest = |[one, two]: [f64; 2]| one.abs().max(two.abs());
        Self {
            gap: before.point.distance(after.point),
            angle: tangents.map_or(PI, |(one, two)| one.angle_between(two)),
            curvature: if planar {
                curvatures[1] - curvatures[0]
            } else {
                bend
            },
            slope: slopes[1] - slopes[0],
            largest: [largest(curvatures), largest(slopes)],
            bend,
        }
    }

    /// Whether the ends meet within a tolerance.
    pub fn meets(self, tolerance: f64) -> bool {
        self.gap <= tolerance
    }

    /// The highest level of continuity that holds where ends within a tolerance meet, for curves of this size: tangents
    /// within 0.1°, curvatures and slopes within 1 %. `None` if they do not meet.
    pub fn continuity(self, tolerance: f64, size: f64) -> Option<Continuity> {
        if !self.meets(tolerance) {
            return None;
        }
        let scales = [self.largest[0] * size, self.largest[1] * size * size].map(|it| it.max(1.0));
        let is_equal = |found: f64, scale: f64| found.abs() <= EQUAL * scale;
        let levels = [
            self.angle <= SMOOTH,
            is_equal(self.bend * size, scales[0]),
            is_equal(self.slope * size * size, scales[1]),
        ];
        let held = levels.into_iter().take_while(|holds| *holds).count();
        Continuity::ALL.get(held).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The jet of a circle about the origin, passed to the left, in the plane spanned by x and `up`.
    fn circle(radius: f64, angle: f64, up: DVec3) -> Jet {
        let (sine, cosine) = angle.sin_cos();
        let out = cosine * DVec3::X + sine * up;
        let along = -sine * DVec3::X + cosine * up;
        Jet {
            point: radius * out,
            first: radius * along,
            second: -radius * out,
            third: -radius * along,
        }
    }

    fn moved(jet: Jet, point: DVec3) -> Jet {
        Jet { point, ..jet }
    }

    #[test]
    fn each_level_needs_those_before_it() {
        let before = circle(2.0, 0.0, DVec3::Y);
        let at = before.point;
        let level = |after: Jet| Joint::between(&before, &after, true).continuity(1e-3, 4.0);
        assert_eq!(level(before), Some(Continuity::G3));
        assert_eq!(level(moved(before, at + 2e-3 * DVec3::X)), None);
        let turned = circle(2.0, 0.5 * SMOOTH, DVec3::Y);
        assert_eq!(level(moved(turned, at)), Some(Continuity::G3));
        let corner = circle(2.0, 1.5 * SMOOTH, DVec3::Y);
        assert_eq!(level(moved(corner, at)), Some(Continuity::G0));
        // 1 % of the curvature 0.5, and a hair to either side.
        for (share, expected) in [(0.0099, Continuity::G3), (0.0102, Continuity::G1)] {
            let other = circle(2.0 / (1.0 + share), 0.0, DVec3::Y);
            assert_eq!(level(moved(other, at)), Some(expected));
        }
        // The same curvature, and a slope of 0.1.
        let sloped = before.third + 0.1 * before.speed().powi(3) * DVec3::NEG_X;
        let sloped = Jet {
            third: sloped,
            ..before
        };
        let joint = Joint::between(&before, &sloped, true);
        assert!((joint.slope - 0.1).abs() < 1e-15, "{joint:?}");
        assert_eq!(level(sloped), Some(Continuity::G2));
    }

    #[test]
    fn figures_of_circles_and_lines_are_those_of_the_textbook() {
        let before = circle(2.0, 0.0, DVec3::Y);
        let after = moved(circle(5.0, 0.25, DVec3::Y), before.point + 0.5 * DVec3::Y);
        let joint = Joint::between(&before, &after, true);
        assert_eq!(joint.gap, 0.5);
        assert!((joint.angle - 0.25).abs() < 1e-15);
        assert!((joint.curvature - (0.2 - 0.5)).abs() < 1e-15);
        assert!(joint.slope.abs() < 1e-15);
        let line = Jet {
            point: before.point,
            first: DVec3::Y,
            ..Jet::default()
        };
        let joint = Joint::between(&line, &before, true);
        assert_eq!((joint.gap, joint.curvature), (0.0, 0.5));
        assert_eq!(joint.continuity(1e-9, 1.0), Some(Continuity::G1));
    }

    #[test]
    fn in_space_planes_that_differ_have_other_curvatures() {
        let before = circle(2.0, 0.0, DVec3::Y);
        let level = |after: Jet| Joint::between(&before, &after, false).continuity(1e-9, 4.0);
        assert_eq!(level(before), Some(Continuity::G3));
        // The same tangent and curvature, turned about the tangent.
        let (sine, cosine) = 0.1_f64.sin_cos();
        let tilted = Jet {
            second: -2.0 * (cosine * DVec3::X + sine * DVec3::Z),
            ..before
        };
        let joint = Joint::between(&before, &tilted, false);
        assert!((joint.curvature - (0.05_f64).sin()).abs() < 1e-15);
        assert_eq!(level(tilted), Some(Continuity::G1));
    }

    #[test]
    fn lines_in_space_go_on_in_every_way() {
        let before = Jet {
            first: DVec3::new(1.0, 2.0, 3.0),
            ..Jet::default()
        };
        let after = Jet {
            first: 4.0 * before.first,
            ..before
        };
        let joint = Joint::between(&before, &after, false);
        assert_eq!(joint.continuity(0.0, 1.0), Some(Continuity::G3));
    }

    #[test]
    fn a_cusp_has_nothing_beyond_its_point() {
        let before = circle(1.0, 0.0, DVec3::Y);
        let cusp = moved(Jet::default(), before.point);
        for planar in [true, false] {
            let joint = Joint::between(&before, &cusp, planar);
            assert_eq!(joint.angle, PI);
            assert_eq!(joint.continuity(0.0, 1.0), Some(Continuity::G0));
        }
    }
}
