//! Mirror images, and half-turns.

use glam::{DVec2, DVec3};

use super::end_correction::EndTarget;
use super::vector;

/// A map to the mirror image in a plane, or a half-turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mirror {
    /// The coordinates change their signs where it says so: bit for bit.
    Signs([bool; 3]),
    /// Any mirror plane.
    Plane {
        /// A point of the plane.
        through: DVec3,
        /// Its normal, of length 1.
        normal: DVec3,
    },
}

impl Mirror {
    /// The mirror line through two points of the plane z = 0; `None` if they are one.
    pub fn through(from: DVec3, to: DVec3) -> Option<Self> {
        let along = vector::direction(to - from)?;
        Some(Self::Plane {
            through: from,
            normal: DVec3::new(-along.y, along.x, 0.0),
        })
    }

    /// The mirror plane through a point with a normal of length 1; by signs if it is one of a coordinate.
    pub fn of_plane(through: DVec3, normal: DVec3) -> Self {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let coordinate = axes.iter().position(|axis| normal.abs() == *axis);
        match coordinate.filter(|_| through == DVec3::ZERO) {
            Some(coordinate) => Self::of_coordinate(coordinate),
            None => Self::Plane { through, normal },
        }
    }

    /// The mirror plane of a coordinate that changes its sign, through the origin.
    pub fn of_coordinate(coordinate: usize) -> Self {
        Self::Signs([0, 1, 2].map(|axis| axis == coordinate))
    }

    /// The vertical plane perpendicular to this one: through the same point, or the origin. `None` for a half-turn and
    /// for a plane that is not vertical.
    pub fn perpendicular(&self) -> Option<Self> {
        match *self {
            Self::Signs([true, false, false]) => Some(Self::of_coordinate(1)),
            Self::Signs([false, true, false]) => Some(Self::of_coordinate(0)),
            Self::Plane { through, normal } if normal.z == 0.0 => Some(Self::Plane {
                through,
                normal: DVec3::new(-normal.y, normal.x, 0.0),
            }),
            _ => None,
        }
    }

    /// A point of the mirror plane and its normal; `None` for a half-turn, which has none.
    pub fn plane(&self) -> Option<[DVec3; 2]> {
        match *self {
            Self::Signs([true, false, false]) => Some([DVec3::ZERO, DVec3::X]),
            Self::Signs([false, true, false]) => Some([DVec3::ZERO, DVec3::Y]),
            Self::Signs([false, false, true]) => Some([DVec3::ZERO, DVec3::Z]),
            Self::Signs(_) => None,
            Self::Plane { through, normal } => Some([through, normal]),
        }
    }

    /// The nearest point that is its own image.
    pub fn foot(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Signs(signs) => {
                let foot = |axis: usize| if signs[axis] { 0.0 } else { point[axis] };
                DVec3::new(foot(0), foot(1), foot(2))
            }
            Self::Plane { through, normal } => point - (point - *through).dot(*normal) * *normal,
        }
    }

    /// The image of a point.
    pub fn point(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Signs(_) => self.vector(point),
            Self::Plane { through, normal } => {
                point - 2.0 * (point - *through).dot(*normal) * *normal
            }
        }
    }

    /// The image of a direction.
    pub fn vector(&self, vector: DVec3) -> DVec3 {
        match self {
            Self::Signs(signs) => {
                // 0 − x and not −x: the image of 0 is 0, not −0.
                let image = |axis: usize| {
                    if signs[axis] {
                        0.0 - vector[axis]
                    } else {
                        vector[axis]
                    }
                };
                DVec3::new(image(0), image(1), image(2))
            }
            Self::Plane { normal, .. } => vector - 2.0 * vector.dot(*normal) * *normal,
        }
    }

    /// The distance of a point from the mirror plane, negative on one side; `None` for half a turn, which has none.
    pub fn height(&self, point: DVec3) -> Option<f64> {
        let [through, normal] = self.plane()?;
        Some((point - through).dot(normal))
    }

    /// Whether a left turn in the plane z = 0 becomes a right turn.
    pub fn turns_plane(&self) -> bool {
        match self {
            Self::Signs([x, y, _]) => x != y,
            Self::Plane { normal, .. } => normal.truncate() != DVec2::ZERO,
        }
    }

    /// Whether a right hand becomes a left one.
    fn turns_space(&self) -> bool {
        match self {
            Self::Signs(signs) => signs.iter().filter(|it| **it).count() % 2 == 1,
            Self::Plane { .. } => true,
        }
    }

    /// The image of an end's target, of a curve that is planar or not: a signed curvature and its slope change their
    /// signs with the turn; in space the curvature stays, and the normal C′ × C″ is turned with the hand.
    pub fn target(&self, target: EndTarget, planar: bool) -> EndTarget {
        let signed = |number: f64| match planar && self.turns_plane() {
            true => -number,
            false => number,
        };
        let normal = |normal: DVec3| match self.turns_space() {
            true => -self.vector(normal),
            false => self.vector(normal),
        };
        EndTarget {
            point: self.point(target.point),
            direction: target.direction.map(|it| self.vector(it)),
            curvature: target.curvature.map(signed),
            normal: target.normal.map(normal),
            slope: target.slope.map(signed),
        }
    }
}
