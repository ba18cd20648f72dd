//! The paper's rounding test. It shortens the coordinates of one clamped vertex and measures how far the
//! float vertices and the evolute move.

use glam::DVec3;

use super::circle_comparison::{PAPER_RADIUS, evolute_reach, regular_polygon};
use crate::geometry::conversion::{cut_off, rounded_off};
use crate::geometry::{ClampedPolygon, FloatPolygon, PolygonError};

/// The degree of the paper's arc, and the sides of its regular polygon.
const ARC: (usize, usize) = (9, 12);

/// The vertex to shorten: the second.
const VERTEX: usize = 1;

/// The way to shorten a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shortening {
    /// Leave out the last digits, as the paper does.
    CutOff,
    /// Round to the nearest number.
    Rounded,
}

/// Hold the result of the rounding test: the arc after shortening its second clamped vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundingTest {
    /// The vertex with all its digits.
    pub before: DVec3,
    /// The vertex after shortening.
    pub after: DVec3,
    /// The float polygon of the changed curve.
    pub polygon: FloatPolygon,
    /// The largest move of a float vertex.
    pub moved: f64,
    /// The largest distance of the evolute from the centre.
    pub evolute_reach: f64,
}

impl RoundingTest {
    /// Make the paper's arc: degree 9, on ten corners of a regular dodecagon of radius 10.
    ///
    /// # Errors
    /// None: the arc is valid.
    pub fn arc() -> Result<FloatPolygon, PolygonError> {
        let (degree, sides) = ARC;
        regular_polygon(degree, sides, PAPER_RADIUS)
    }

    /// Shorten the vertex's coordinates to `digits` digits after the decimal point.
    ///
    /// # Errors
    /// None for this arc: the clamped polygon stays valid.
    pub fn new(digits: usize, shortening: Shortening) -> Result<Self, PolygonError> {
        let arc = Self::arc()?;
        let closed = ClampedPolygon::from_float(&arc);
        let mut vertices = closed.vertices().to_vec();
        let before = vertices[VERTEX];
        let shortened = match shortening {
            Shortening::CutOff => cut_off,
            Shortening::Rounded => rounded_off,
        };
        let after = DVec3::from(before.to_array().map(|value| shortened(value, digits)));
        vertices[VERTEX] = after;
        let polygon = if after == before {
            arc.clone()
        } else {
            ClampedPolygon::new(closed.degree(), vertices, None)?.to_float()?
        };
        let pairs = arc.vertices().iter().zip(polygon.vertices());
        Ok(Self {
            before,
            after,
            moved: pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max),
            evolute_reach: evolute_reach(&polygon),
            polygon,
        })
    }
}
