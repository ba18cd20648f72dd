//! The paper's rounding test: digits are taken from one vertex of a closed S-polygon, and the
//! float S-polygon of the curve and its evolute tell what that does.

use glam::DVec3;

use super::circle_comparison::{PAPER_RADIUS, evolute_reach, regular_polygon};
use super::clamped_polygon::ClampedPolygon;
use super::conversion::{cut_off, rounded_off};
use super::error::PolygonError;
use super::float_polygon::FloatPolygon;

/// The degree of the paper's arc, and the sides of the regular polygon that it lies on.
const ARC: (usize, usize) = (9, 12);

/// The vertex whose coordinates lose digits: the second.
const VERTEX: usize = 1;

/// How coordinates lose digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shortening {
    /// The digits that are too many are left out, as in the paper.
    CutOff,
    /// To the nearest number with so many digits.
    Rounded,
}

/// Hold what came of shortening the coordinates of the arc's second closed vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundingTest {
    /// The vertex as it was.
    pub before: DVec3,
    /// The vertex with fewer digits.
    pub after: DVec3,
    /// The float polygon of the curve that has this closed polygon.
    pub polygon: FloatPolygon,
    /// The largest distance of the float polygon's vertices from where they were.
    pub moved: f64,
    /// The largest distance of the evolute from the centre.
    pub evolute_reach: f64,
}

impl RoundingTest {
    /// Make the arc whose closed vertex loses digits: degree 9, on ten corners of a regular dodecagon
    /// of radius 10.
    ///
    /// # Errors
    /// None: the arc is valid.
    pub fn arc() -> Result<FloatPolygon, PolygonError> {
        let (degree, sides) = ARC;
        regular_polygon(degree, sides, PAPER_RADIUS)
    }

    /// Keep so many digits after the decimal point of the vertex's coordinates.
    ///
    /// # Errors
    /// None for the arc there is: the closed polygon stays valid.
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
