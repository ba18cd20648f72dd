//! The orientation of the view plane in space.

use glam::{DQuat, DVec2, DVec3};

/// Turn space so that the view plane lies before the eye, orthographically: `right` and `up` are
/// the view plane's axes, `towards` points from the model to the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    right: DVec3,
    up: DVec3,
    towards: DVec3,
}

impl Default for Orientation {
    fn default() -> Self {
        Self::XY
    }
}

impl Orientation {
    /// Seen from above: x to the right, y up.
    pub const XY: Self = Self {
        right: DVec3::X,
        up: DVec3::Y,
        towards: DVec3::Z,
    };
    /// Seen from the front: x to the right, z up.
    pub const XZ: Self = Self {
        right: DVec3::X,
        up: DVec3::Z,
        towards: DVec3::NEG_Y,
    };
    /// Seen from the side: y to the right, z up.
    pub const YZ: Self = Self {
        right: DVec3::Y,
        up: DVec3::Z,
        towards: DVec3::X,
    };

    /// Seen from above a corner, with all three axes equally long.
    pub fn isometric() -> Self {
        let towards = DVec3::new(1.0, -1.0, 1.0).normalize();
        let right = DVec3::new(1.0, 1.0, 0.0).normalize();
        Self {
            right,
            up: towards.cross(right),
            towards,
        }
    }

    /// The direction to the right, a unit vector.
    pub fn right(&self) -> DVec3 {
        self.right
    }

    /// The direction upwards, a unit vector.
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// The direction from the model to the eye, a unit vector.
    pub fn towards(&self) -> DVec3 {
        self.towards
    }

    /// Map a point or vector to the view plane. Along an axis of the model this is exact.
    pub fn flatten(&self, point: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(point), self.up.dot(point))
    }

    /// How near a point is to the eye.
    pub fn depth(&self, point: DVec3) -> f64 {
        self.towards.dot(point)
    }

    /// The vector of space that a vector of the view plane is.
    pub fn lift(&self, vector: DVec2) -> DVec3 {
        vector.x * self.right + vector.y * self.up
    }

    /// The point seen at a place of the view plane that is as near to the eye as `like`.
    pub fn point_at(&self, place: DVec2, like: DVec3) -> DVec3 {
        self.lift(place) + self.depth(like) * self.towards
    }

    /// The axes of the model that the view plane's own are, as 0, 1, 2 for x, y, z; `None` if the
    /// view is turned against the model.
    pub fn axes(&self) -> Option<[usize; 2]> {
        let axis = |direction: DVec3| DVec3::AXES.iter().position(|axis| *axis == direction);
        Some([axis(self.right)?, axis(self.up)?])
    }

    /// Whether this is the view from above, in which planar curves are seen as they are.
    pub fn is_from_above(&self) -> bool {
        self.towards == DVec3::Z
    }

    /// Turn the view as by rolling a ball: `across` about the vertical of the model (z), `over`
    /// about the horizontal of the screen, in radians. It stops when seen straight from above or
    /// below, so that z never points down.
    pub fn orbited(&self, across: f64, over: f64) -> Self {
        let elevation = self.towards.z.clamp(-1.0, 1.0).asin();
        let over = (elevation + over)
            .clamp(-0.5 * std::f64::consts::PI, 0.5 * std::f64::consts::PI)
            - elevation;
        let tilt = DQuat::from_axis_angle(self.right, -over);
        let turn = DQuat::from_axis_angle(DVec3::Z, -across);
        let towards = (turn * tilt * self.towards).normalize();
        let right = turn * self.right;
        let right = (right - right.dot(towards) * towards).normalize();
        Self {
            right,
            up: towards.cross(right),
            towards,
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::*;

    fn check(view: &Orientation) {
        let turned = DMat3::from_cols(view.right, view.up, view.towards);
        let rest = turned * turned.transpose() - DMat3::IDENTITY;
        let error = rest
            .to_cols_array()
            .into_iter()
            .fold(0.0, |a: f64, b| a.max(b.abs()));
        assert!(error <= 4.0 * f64::EPSILON, "{view:?}");
        assert!((turned.determinant() - 1.0).abs() <= 4.0 * f64::EPSILON);
        let point = DVec3::new(1.0, -2.5, 4.0);
        let back = view.point_at(view.flatten(point), point);
        assert!(back.distance(point) <= 1e-14, "{back}");
    }

    #[test]
    fn views_are_right_handed_and_orthonormal() {
        let mut view = Orientation::isometric();
        check(&view);
        for step in 0..200 {
            view = view.orbited(0.3 * f64::from(step).sin(), 0.2 * f64::from(step).cos());
            check(&view);
            assert!(view.up.z >= -1e-12, "z never points down");
        }
        for view in [Orientation::XY, Orientation::XZ, Orientation::YZ] {
            check(&view);
        }
    }

    #[test]
    fn views_along_an_axis_are_exact() {
        let point = DVec3::new(0.1, 0.2, 0.3);
        for (view, axes) in [
            (Orientation::XY, [0, 1]),
            (Orientation::XZ, [0, 2]),
            (Orientation::YZ, [1, 2]),
        ] {
            assert_eq!(view.axes(), Some(axes));
            let flat = view.flatten(point);
            assert_eq!(flat.to_array(), axes.map(|axis| point[axis]));
            assert_eq!(view.point_at(flat, point), point);
        }
        assert_eq!(Orientation::isometric().axes(), None);
    }
}
