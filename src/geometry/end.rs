//! The two ends of an open curve and their jets.

use glam::{DMat3, DVec3};

use super::control_polygon::diagonal;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;
use super::vector;

/// One end of an open curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    /// The end at u = 0.
    Start,
    /// The end at u = L.
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

    /// The parameter u of the end on an open curve.
    pub fn parameter(self, polygon: &FloatPolygon) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Finish => polygon.segments() as f64,
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

    /// The numbers of the terminal vertices of one end, from the curve's start on: the n vertices
    /// that fix the end point and the first n − 1 derivatives there. For degree 1 the two of the
    /// end's leg, since one alone has no direction.
    pub fn terminal_vertices(&self, end: End) -> std::ops::Range<usize> {
        let (count, terminal) = (self.vertices().len(), self.degree().max(2));
        match end {
            End::Start => 0..terminal,
            End::Finish => count - terminal..count,
        }
    }

    /// The number of legs at either end whose vertices belong beyond the curve: the means of their knots (Greville
    /// abscissae) i − (n − 1)/2 lie outside the domain. 0 for a periodic curve.
    pub fn tail_legs(&self) -> usize {
        match self.is_periodic() {
            true => 0,
            false => (self.degree() - 1) / 2,
        }
    }

    /// The size of an end: the diagonal of the box around its terminal vertices. What is missing of
    /// an end is relative to it, however long the curve is.
    pub fn end_size(&self, end: End) -> f64 {
        diagonal(&self.vertices()[self.terminal_vertices(end)])
    }
}

/// Find the rotation that takes direction `from` to `to` the shortest way; in the plane z = 0 it
/// stays in the plane, half a turn included. `None` if either vector is zero.
pub fn rotation_between(from: DVec3, to: DVec3) -> Option<DMat3> {
    let (from, to) = (vector::direction(from)?, vector::direction(to)?);
    if from.z == 0.0 && to.z == 0.0 {
        let (sine, cosine) = (from.truncate().perp_dot(to.truncate()), from.dot(to));
        let length = sine.hypot(cosine);
        let (sine, cosine) = (sine / length, cosine / length);
        return Some(DMat3::from_cols(
            DVec3::new(cosine, sine, 0.0),
            DVec3::new(-sine, cosine, 0.0),
            DVec3::Z,
        ));
    }
    if from.dot(to) >= 0.0 {
        return Some(turn_by_acute(from, to));
    }
    // Near half a turn the axis from × to is nothing but rounding: half a turn about an axis that
    // is surely orthogonal to `from` leaves less than a right angle to go.
    let across = from.cross(to);
    let axis = if across.length() > 1e-4 {
        (across - across.dot(from) * from).normalize()
    } else {
        from.any_orthonormal_vector()
    };
    let half_turn = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z) * 2.0;
    let half_turn = half_turn - DMat3::IDENTITY;
    Some(turn_by_acute(-from, to) * half_turn)
}

/// The rotation of one unit vector to another that is at most a right angle away:
/// I + V + V²/(1 + from · to), V the matrix of v ↦ (from × to) × v.
fn turn_by_acute(from: DVec3, to: DVec3) -> DMat3 {
    let v = from.cross(to);
    let cross = DMat3::from_cols(
        DVec3::new(0.0, v.z, -v.y),
        DVec3::new(-v.z, 0.0, v.x),
        DVec3::new(v.y, -v.x, 0.0),
    );
    DMat3::IDENTITY + cross + cross * cross * (1.0 / (1.0 + from.dot(to)))
}
