//! The two ends of an open curve and their jets.

use glam::DVec3;

use super::basis::uniform_basis_derivative;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;

/// One end of an open curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// Where u = 0.
    Start,
    /// Where u = L.
    Finish,
}

impl End {
    /// Both ends, the start first.
    pub const BOTH: [Self; 2] = [Self::Start, Self::Finish];

    /// Name the end as the screen and the command line spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Finish => "end",
        }
    }

    /// The opposite end.
    pub fn other(self) -> Self {
        match self {
            Self::Start => Self::Finish,
            Self::Finish => Self::Start,
        }
    }
}

impl FloatPolygon {
    /// Evaluate the curve's jet at one end. The tangent points along rising u at both ends; it
    /// is the direction of the first, or last, leg of the clamped polygon.
    pub fn end_jet(&self, end: End) -> Jet {
        match end {
            End::Start => self.segment_jet(0, 0.0),
            End::Finish => self.segment_jet(self.segments() - 1, 1.0),
        }
    }

    /// The numbers of the n vertices that act at one end, from the curve's start on: they fix
    /// the end point and the first n − 1 derivatives there.
    pub fn terminal_vertices(&self, end: End) -> std::ops::Range<usize> {
        let count = self.vertices().len();
        match end {
            End::Start => 0..self.degree(),
            End::Finish => count - self.degree()..count,
        }
    }

    /// The weights with which the n terminal vertices enter the `order`-th derivative at an end
    /// of a polynomial curve: Eulerian numbers over n! for the point itself.
    pub fn end_weights(&self, end: End, order: usize) -> Vec<f64> {
        let (t, skipped) = match end {
            End::Start => (0.0, 0),
            End::Finish => (1.0, 1),
        };
        let mut weights = uniform_basis_derivative(self.degree(), order, t);
        weights.rotate_left(skipped);
        weights.truncate(self.degree());
        weights
    }
}

/// Find the rotation that takes direction `from` to `to` the shortest way; in the plane z = 0 it
/// stays in the plane, half a turn included. `None` if either vector is zero.
pub fn rotation_between(from: DVec3, to: DVec3) -> Option<glam::DMat3> {
    let (from, to) = (from.try_normalize()?, to.try_normalize()?);
    if from.z == 0.0 && to.z == 0.0 {
        let (sine, cosine) = (from.truncate().perp_dot(to.truncate()), from.dot(to));
        let length = sine.hypot(cosine);
        let (sine, cosine) = (sine / length, cosine / length);
        return Some(glam::DMat3::from_cols(
            DVec3::new(cosine, sine, 0.0),
            DVec3::new(-sine, cosine, 0.0),
            DVec3::Z,
        ));
    }
    let axis = from.cross(to).try_normalize();
    let axis = axis.unwrap_or_else(|| from.any_orthonormal_vector());
    let angle = from.cross(to).length().atan2(from.dot(to));
    Some(glam::DMat3::from_axis_angle(axis, angle))
}
