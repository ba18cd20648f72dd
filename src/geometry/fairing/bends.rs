//! How sharply a curve bends between two of its points, beside what their tangents and their distance ask for.

use std::f64::consts::PI;

use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::largest_curvature;

/// An excess that is seen as a knuckle.
const KNUCKLE: f64 = 3.0;

/// Curvatures of a part of a curve, without their signs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bends {
    /// The largest one.
    pub largest: f64,
    /// The larger one of those at its ends.
    at_ends: f64,
    /// The one that turns the tangents into each other over the distance of the ends.
    over_gap: f64,
}

impl Bends {
    /// Measure the curvatures between two parameters.
    pub fn between(polygon: &FloatPolygon, joint: [f64; 2]) -> Self {
        let ends = joint.map(|u| polygon.jet(u));
        let way = ends[1].point - ends[0].point;
        let turns = ends.map(|jet| jet.tangent().map_or(PI, |it| it.angle_between(way)));
        // Over no way there is no angle.
        let turns = turns.into_iter().filter(|turn| turn.is_finite());
        let at_ends = ends.map(|jet| jet.curvature());
        Self {
            largest: largest_curvature(polygon, joint),
            at_ends: at_ends[0].max(at_ends[1]),
            over_gap: turns.sum::<f64>() / way.length(),
        }
    }

    /// Compare the largest curvature with what the ends have and need: 1 for an arc that goes on as one.
    pub fn excess(&self) -> f64 {
        let needed = self.at_ends.max(self.over_gap);
        match self.largest > needed {
            true => self.largest / needed,
            false => 1.0,
        }
    }

    /// Whether the part bends so much more sharply than its ends that the eye sees a knuckle.
    pub fn is_knuckle(&self) -> bool {
        self.excess() > KNUCKLE
    }
}
