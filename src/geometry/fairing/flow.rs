//! The flow of control vertices with its slopes: lengths of legs, discrete curvature, torsion
//! angles, each with its gradient by the vertices.

use glam::DVec3;

use super::dual::{DualVector, differentiate};

/// A sequence along a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sequence {
    /// The logarithms of the legs' lengths.
    LogLeg,
    /// The discrete curvature |D₁ × D₂| / |D₁|³ at the corners.
    Curvature,
    /// The discrete curvature seen along a unit vector, (D₁ × D₂)·b / |D₁|³: signed for a planar
    /// polygon and the normal of its plane.
    SeenCurvature(DVec3),
    /// The angles between successive osculating planes, about the leg between them; positive for a
    /// right-handed turn.
    TorsionAngle,
}

/// A member of a sequence.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    pub(super) value: f64,
    /// The gradient by the vertices that it depends on, in their order.
    pub(super) gradient: [DVec3; 4],
}

impl Sequence {
    /// Number of successive vertices that a member depends on.
    pub(super) fn width(self) -> usize {
        match self {
            Self::LogLeg => 2,
            Self::Curvature | Self::SeenCurvature(_) => 3,
            Self::TorsionAngle => 4,
        }
    }

    /// Evaluate the member that depends on these successive vertices.
    ///
    /// # Panics
    /// If there are fewer than [`Sequence::width`].
    pub(super) fn member(self, vertices: &[DVec3]) -> Member {
        let leg = |index: usize| vertices[index + 1] - vertices[index];
        match self {
            Self::LogLeg => {
                let formula = |[leg, ..]: [DualVector; 3]| leg.dot(leg).ln() * 0.5;
                let found = differentiate([leg(0), DVec3::ZERO, DVec3::ZERO], formula);
                member(found, &[&[-1.0, 1.0]])
            }
            Self::Curvature | Self::SeenCurvature(_) => {
                let first = 0.5 * (vertices[2] - vertices[0]);
                let second = leg(1) - leg(0);
                let formula = |[first, second, _]: [DualVector; 3]| {
                    let normal = first.cross(second);
                    let turning = match self {
                        Self::SeenCurvature(axis) => normal.along(axis),
                        _ => normal.length(),
                    };
                    turning / first.length().cubed()
                };
                let found = differentiate([first, second, DVec3::ZERO], formula);
                member(found, &[&[-0.5, 0.0, 0.5], &[1.0, -2.0, 1.0]])
            }
            Self::TorsionAngle => {
                let formula = |[a, b, c]: [DualVector; 3]| {
                    let (before, after) = (a.cross(b), b.cross(c));
                    (b.length() * a.dot(after)).atan2(before.dot(after))
                };
                let found = differentiate([leg(0), leg(1), leg(2)], formula);
                member(
                    found,
                    &[&[-1.0, 1.0], &[0.0, -1.0, 1.0], &[0.0, 0.0, -1.0, 1.0]],
                )
            }
        }
    }
}

/// Pass a gradient by vectors on to the vertices of which each is a combination.
fn member((value, by_vector): (f64, [DVec3; 3]), stencils: &[&[f64]]) -> Member {
    let mut gradient = [DVec3::ZERO; 4];
    for (slope, stencil) in by_vector.iter().zip(stencils) {
        for (sum, weight) in gradient.iter_mut().zip(*stencil) {
            *sum += *weight * *slope;
        }
    }
    Member { value, gradient }
}
