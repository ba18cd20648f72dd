//! Points on the canvas that set parameters when they are dragged.

use glam::DVec3;

use super::value::Value;
use crate::geometry::mineur_farin::Configuration;

/// Describe a point on the canvas that sets parameters when it is dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Where it is, in model space.
    pub at: DVec3,
    /// What it sets, in words.
    pub label: &'static str,
    /// What it sets.
    pub sets: Sets,
}

/// What a handle sets; parameters are named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sets {
    /// A list: the coordinates of the point.
    Point(&'static str),
    /// A list: the vector to the point.
    Vector {
        /// The list.
        parameter: &'static str,
        /// Where the vector begins.
        from: DVec3,
    },
    /// Two numbers: how long the vector to the point is, as a multiple of another vector, and the
    /// angle from that to it.
    RatioAndAngle {
        /// The multiple.
        ratio: &'static str,
        /// The angle.
        angle: &'static str,
        /// Where the vector begins.
        from: DVec3,
        /// The other vector.
        base: DVec3,
        /// The direction about which the angle turns.
        normal: DVec3,
    },
    /// Two numbers of a Mineur–Farin configuration, such that its last point follows.
    LastPoint {
        /// The length ratio.
        ratio: &'static str,
        /// The turning angle.
        angle: &'static str,
        /// The configuration.
        configuration: Configuration,
        /// The number of its legs.
        legs: usize,
    },
}

impl Handle {
    /// The values that the handle sets when it is dragged to a point.
    pub fn values(&self, point: DVec3) -> Vec<(&'static str, Value)> {
        let coordinates = |vector: DVec3| {
            let planar = vector.z == 0.0;
            let coordinates = &vector.to_array()[..if planar { 2 } else { 3 }];
            Value::List(coordinates.to_vec())
        };
        match self.sets {
            Sets::Point(parameter) => vec![(parameter, coordinates(point))],
            Sets::Vector { parameter, from } => vec![(parameter, coordinates(point - from))],
            Sets::RatioAndAngle {
                ratio,
                angle,
                from,
                base,
                normal,
            } => {
                let vector = point - from;
                let (sine, cosine) = (base.cross(vector).dot(normal), base.dot(vector));
                vec![
                    (ratio, Value::Real(vector.length() / base.length())),
                    (angle, Value::Real(sine.atan2(cosine))),
                ]
            }
            Sets::LastPoint {
                ratio,
                angle,
                configuration,
                legs,
            } => {
                let found = configuration.reaching(legs, point);
                vec![
                    (ratio, Value::Real(found.ratio)),
                    (angle, Value::Real(found.turn)),
                ]
            }
        }
    }
}
