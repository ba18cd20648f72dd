//! The clamped polygon: the same curve on knots that are n + 1 fold at both ends.

use std::ops::Deref;

use glam::DVec3;

use super::amplification::{Amplification, double_factorial};
use super::end_conversion::ConvertedEnds;
use super::exact_vertices::{check_weight, converted_float, weight_loss};
use super::knots::Direction;
use crate::geometry::control_polygon::ControlPolygon;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

/// Hold a curve of degree n by its vertices on the knots 0 (n + 1 times), 1 … L − 1,
/// L (n + 1 times): the S-polygon in closed format. It starts and ends on its first and last
/// vertex, tangent to its first and last leg.
#[derive(Clone, Debug, PartialEq)]
pub struct ClampedPolygon(ControlPolygon);

impl Deref for ClampedPolygon {
    type Target = ControlPolygon;

    fn deref(&self) -> &ControlPolygon {
        &self.0
    }
}

impl ClampedPolygon {
    /// Build a clamped polygon from its degree, vertices and optional weights.
    ///
    /// # Errors
    /// As [`FloatPolygon::new`].
    pub fn new(
        degree: usize,
        vertices: Vec<DVec3>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self, PolygonError> {
        ControlPolygon::new(degree, vertices, weights, false).map(Self)
    }

    /// Convert a float polygon. Every step interpolates between two vertices, in double-double
    /// arithmetic, and exactly where that leaves a number too few digits, so each is the exact one
    /// rounded, and the weights are positive. Vertices that do not change stay as they are, bit for
    /// bit.
    ///
    /// A periodic curve is opened at u = 0 and runs round once.
    pub fn from_float(float: &FloatPolygon) -> Self {
        if float.is_periodic() {
            return Self::from_float(&float.unrolled());
        }
        let ends = ConvertedEnds::<2>::new(float, Direction::Clamp, 1.0);
        let mut polygon = ControlPolygon::clone(float);
        polygon.replace(ends.rounded());
        Self(polygon)
    }

    /// Convert to the float polygon of the same curve (open, over the same segments), each number
    /// the exact one rounded: the steps carry three doubles a number, and whole numbers of any
    /// length where that leaves too few digits. Vertices that do not change stay as they are, bit
    /// for bit.
    ///
    /// The conversion extrapolates: an error that the given vertices already have, be it half a
    /// unit of their last digit, grows by up to [`ClampedPolygon::amplification`].
    ///
    /// # Errors
    /// [`PolygonError::WeightLost`] if the exact float polygon has a weight that is not positive
    /// (by more than 2⁻¹⁵⁰ of what it is a difference of), [`PolygonError::Overflow`] if it has a
    /// coordinate beyond the range of numbers.
    pub fn to_float(&self) -> Result<FloatPolygon, PolygonError> {
        let norm = double_factorial(self.degree);
        let ends = ConvertedEnds::<3>::new(self, Direction::Unclamp, norm);
        let converted: Vec<_> = ends.rounded().collect();
        if self.is_rational() {
            let loses = weight_loss(ends.largest_weight() * self.amplification().norm);
            let mut weights = converted.iter();
            weights.try_for_each(|(index, _, weight)| {
                check_weight(PolygonKind::Float, *index, *weight, loses)
            })?;
        }
        let mut polygon = self.0.clone();
        polygon.replace(converted);
        converted_float(polygon.degree, (polygon.vertices, polygon.weights), false)
    }

    /// Compute how much errors in the vertices grow in [`ClampedPolygon::to_float`].
    pub fn amplification(&self) -> Amplification {
        Amplification::of_unclamping(self.degree, self.segments())
    }

    /// The number of segments L.
    pub fn segments(&self) -> usize {
        self.vertices.len() - self.degree
    }

    /// The full knot vector, N + n + 1 numbers from 0 to L.
    pub fn knots(&self) -> Vec<f64> {
        let last = self.segments() as f64;
        (0..self.vertices.len() + self.degree + 1)
            .map(|index| (index as f64 - self.degree as f64).clamp(0.0, last))
            .collect()
    }
}
