//! Mirror images, and half-turns.

use glam::DVec3;

use super::end_correction::EndTarget;
use super::vector;

/// A map to the mirror image, in a plane or about an axis through two points of the plane z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mirror {
    /// The coordinates change their signs where it says so: bit for bit.
    Signs([bool; 3]),
    /// The vertical plane through a point of the plane z = 0 with a direction of length 1 in it.
    Line {
        /// The point.
        through: DVec3,
        /// The direction.
        along: DVec3,
    },
}

impl Mirror {
    /// The mirror line through two points of the plane z = 0; `None` if they are one.
    pub fn through(from: DVec3, to: DVec3) -> Option<Self> {
        let along = vector::direction(to - from)?;
        Some(Self::Line {
            through: from,
            along,
        })
    }

    /// The image of a point.
    pub fn point(&self, point: DVec3) -> DVec3 {
        match self {
            Self::Signs(_) => self.vector(point),
            Self::Line { through, .. } => *through + self.vector(point - *through),
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
            Self::Line { along, .. } => {
                let flat = DVec3::new(vector.x, vector.y, 0.0);
                let image = 2.0 * flat.dot(*along) * *along - flat;
                image.with_z(vector.z)
            }
        }
    }

    /// The distance of a point from the mirror plane, negative on one side; `None` for half a turn, which has none.
    pub fn height(&self, point: DVec3) -> Option<f64> {
        match self {
            Self::Signs([true, false, false]) => Some(point.x),
            Self::Signs([false, true, false]) => Some(point.y),
            Self::Signs([false, false, true]) => Some(point.z),
            Self::Signs(_) => None,
            Self::Line { through, along } => {
                let across = DVec3::new(-along.y, along.x, 0.0);
                Some((point - *through).dot(across))
            }
        }
    }

    /// Whether a left turn in the plane z = 0 becomes a right turn.
    pub fn turns_plane(&self) -> bool {
        match self {
            Self::Signs([x, y, _]) => x != y,
            Self::Line { .. } => true,
        }
    }

    /// Whether a right hand becomes a left one.
    fn turns_space(&self) -> bool {
        match self {
            Self::Signs(signs) => signs.iter().filter(|it| **it).count() % 2 == 1,
            Self::Line { .. } => true,
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
