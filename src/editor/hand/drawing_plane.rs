//! The plane that is drawn in, and legs in it.

use glam::{DVec2, DVec3};

use crate::editor::view::viewport::Viewport;
use crate::geometry::expressions::sin_cos_of_degrees;

/// The plane in which clicks set points: along an axis of the model the view plane, otherwise the
/// plane of x and y, unless that is seen from its edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawingPlane {
    axes: [DVec3; 2],
    names: [&'static str; 2],
}

impl DrawingPlane {
    /// The plane that is drawn in as the model is seen now.
    pub fn of(viewport: &Viewport) -> Self {
        let view = &viewport.orientation;
        match view.axes() {
            Some(axes) => Self {
                axes: axes.map(|axis| DVec3::AXES[axis]),
                names: axes.map(|axis| ["x", "y", "z"][axis]),
            },
            None if viewport.is_edge_on() => Self {
                axes: [view.right(), view.up()],
                names: ["right", "up"],
            },
            None => Self {
                axes: [DVec3::X, DVec3::Y],
                names: ["x", "y"],
            },
        }
    }

    /// The names of the plane's axes.
    pub fn names(&self) -> [&'static str; 2] {
        self.names
    }

    /// The direction of an axis, 0 or 1.
    pub fn axis(&self, axis: usize) -> DVec3 {
        self.lift(DVec2::AXES.get(axis).copied().unwrap_or_default())
    }

    /// The vector of space with two coordinates of the plane.
    pub fn lift(&self, by: DVec2) -> DVec3 {
        by.x * self.axes[0] + by.y * self.axes[1]
    }

    /// The coordinates of a vector of space in the plane.
    pub fn flatten(&self, vector: DVec3) -> DVec2 {
        DVec2::from_array(self.axes.map(|axis| axis.dot(vector)))
    }

    /// The component of a vector along the plane's normal.
    pub fn across(&self, vector: DVec3) -> DVec3 {
        vector - self.lift(self.flatten(vector))
    }

    /// The unit vector at an angle in degrees from the first axis to the second; along the axes exact.
    pub fn direction(&self, degrees: f64) -> DVec3 {
        let (sine, cosine) = sin_cos_of_degrees(degrees);
        self.lift(DVec2::new(cosine, sine))
    }
}

/// A leg that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Its length, in space.
    pub length: f64,
    /// Its angle in the plane that is drawn in, in degrees; none across it.
    pub degrees: Option<f64>,
}

impl Leg {
    /// The leg from one point to another.
    pub fn between(from: DVec3, to: DVec3, plane: &DrawingPlane) -> Self {
        let along = plane.flatten(to - from);
        Self {
            length: from.distance(to),
            degrees: (along != DVec2::ZERO).then(|| along.to_angle().to_degrees()),
        }
    }
}

/// The locked length or direction of the leg that is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LegLocks {
    /// The length; a positive number.
    pub length: Option<f64>,
    /// The angle in the plane that is drawn in, in degrees.
    pub degrees: Option<f64>,
}

impl LegLocks {
    /// The end of the leg that is nearest to a point among those that the locks leave: the ray of a
    /// locked angle, the sphere of a locked length, or the one point that both leave.
    pub fn constrained(&self, from: DVec3, to: DVec3, plane: &DrawingPlane) -> DVec3 {
        let mut leg = to - from;
        let direction = self.degrees.map(|degrees| plane.direction(degrees));
        if let Some(direction) = direction {
            leg = leg.dot(direction).max(0.0) * direction + plane.across(leg);
        }
        match self.length {
            Some(length) => {
                let along = leg.try_normalize().or(direction);
                from + length * along.unwrap_or(plane.direction(0.0))
            }
            None if direction.is_some() => from + leg,
            None => to,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn locks_keep_to_the_angle_and_to_the_length() {
        let plane = DrawingPlane::of(&Viewport::default());
        let (from, to) = (DVec3::new(1.0, 1.0, 0.0), DVec3::new(4.0, 5.0, 0.0));
        let end = |length, degrees| LegLocks { length, degrees }.constrained(from, to, &plane);
        assert_eq!(end(None, None), to);
        assert_eq!(end(None, Some(90.0)), DVec3::new(1.0, 5.0, 0.0));
        // The pointer is behind the ray.
        assert_eq!(end(None, Some(180.0)), from);
        assert_eq!(end(Some(2.0), Some(180.0)), DVec3::new(-1.0, 1.0, 0.0));
        assert!(end(Some(10.0), None).distance(DVec3::new(7.0, 9.0, 0.0)) < 1e-14);
        let leg = Leg::between(from, to, &plane);
        assert_eq!(leg.length, 5.0);
        assert!((leg.degrees.expect("an angle") - 53.130_102_354_155_98).abs() < 1e-13);
    }
}
