//! Continuity of two curves at a common point.

use super::end_correction::EndTarget;
use super::jet::Jet;

/// How smoothly one curve goes on from another: what they share where they meet. Each level
/// includes those before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Continuity {
    /// The point.
    G0,
    /// The tangent's direction.
    #[default]
    G1,
    /// The curvature; in space also the osculating plane.
    G2,
    /// The slope dκ/ds of the curvature.
    G3,
}

impl Continuity {
    /// All levels, from the lowest.
    pub const ALL: [Self; 4] = [Self::G0, Self::G1, Self::G2, Self::G3];

    /// The level's name, such as G2.
    pub fn name(self) -> &'static str {
        match self {
            Self::G0 => "G0",
            Self::G1 => "G1",
            Self::G2 => "G2",
            Self::G3 => "G3",
        }
    }

    /// The shared property beyond the level before.
    pub fn label(self) -> &'static str {
        match self {
            Self::G0 => "position",
            Self::G1 => "direction",
            Self::G2 => "curvature",
            Self::G3 => "slope of curvature",
        }
    }

    /// Find a level by its name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|level| level.name() == name)
    }

    /// What an end must be to go on from a point of a curve at this level, along the curve's
    /// direction. Curvature and slope are signed if `planar`, which both curves must be then. What
    /// the point does not have is free: at a cusp the direction and all beyond it, in space the
    /// osculating plane and the slope where the curvature is 0.
    pub fn target(self, jet: &Jet, planar: bool) -> EndTarget {
        let asks = |level: Self| self >= level;
        let direction = jet.tangent().filter(|_| asks(Self::G1));
        let finite = |number: f64| Some(number).filter(|number| number.is_finite());
        let curved = direction.filter(|_| asks(Self::G2));
        let normal = jet.first.cross(jet.second).try_normalize();
        EndTarget {
            point: jet.point,
            direction,
            curvature: curved.and_then(|_| finite(jet.curvature_of(planar))),
            normal: curved.and(normal).filter(|_| !planar),
            slope: curved
                .filter(|_| asks(Self::G3))
                .and_then(|_| finite(jet.curvature_slope(planar))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// The jet at u = 0 of the parabola (u, u²/2) turned about the x axis.
    fn parabola(normal: DVec3) -> Jet {
        Jet {
            point: DVec3::ONE,
            first: DVec3::X,
            second: normal.cross(DVec3::X),
            third: DVec3::ZERO,
        }
    }

    #[test]
    fn each_level_asks_for_more() {
        let jet = parabola(DVec3::Z);
        let mut expected = EndTarget {
            point: DVec3::ONE,
            ..EndTarget::default()
        };
        assert_eq!(Continuity::G0.target(&jet, true), expected);
        expected.direction = Some(DVec3::X);
        assert_eq!(Continuity::G1.target(&jet, true), expected);
        expected.curvature = Some(1.0);
        assert_eq!(Continuity::G2.target(&jet, true), expected);
        // κ = (1 + u²)^(−3/2) is largest at the apex.
        expected.slope = Some(0.0);
        assert_eq!(Continuity::G3.target(&jet, true), expected);
        for level in Continuity::ALL {
            assert_eq!(Continuity::from_name(level.name()), Some(level));
        }
    }

    #[test]
    fn in_space_the_plane_is_asked_for_and_the_curvature_has_no_sign() {
        let planar = Continuity::G2.target(&parabola(DVec3::NEG_Z), true);
        assert_eq!((planar.curvature, planar.normal), (Some(-1.0), None));
        for normal in [DVec3::NEG_Z, DVec3::Y] {
            let target = Continuity::G2.target(&parabola(normal), false);
            assert_eq!(target.curvature, Some(1.0));
            assert_eq!(target.normal, Some(normal));
        }
    }

    #[test]
    fn what_a_point_does_not_have_is_free() {
        let cusp = Jet {
            first: DVec3::ZERO,
            ..parabola(DVec3::Z)
        };
        for planar in [true, false] {
            let target = Continuity::G3.target(&cusp, planar);
            assert_eq!(target, Continuity::G0.target(&cusp, planar));
        }
        let straight = Jet {
            second: DVec3::ZERO,
            ..parabola(DVec3::Z)
        };
        let target = Continuity::G3.target(&straight, false);
        assert_eq!(
            (target.curvature, target.normal, target.slope),
            (Some(0.0), None, None)
        );
        assert_eq!(Continuity::G3.target(&straight, true).slope, Some(0.0));
    }
}
