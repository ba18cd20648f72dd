//! The clamped polygon: the same curve on knots that are n + 1 fold at both ends.

use glam::DVec3;

use super::conversion::amplification::{Amplification, double_factorial};
use super::conversion::end_conversion::ConvertedEnds;
use super::conversion::exact_vertices::{check_weight, converted_error, weight_loss};
use super::conversion::knots::Direction;
use super::error::PolygonError;
use super::float_polygon::{FloatPolygon, check_polygon};
use super::polygon_kind::PolygonKind;

/// Hold a curve of degree n by its vertices on the knots 0 (n + 1 times), 1 … L − 1,
/// L (n + 1 times): the S-polygon in closed format. It starts and ends on its first and last
/// vertex, tangent to its first and last leg.
#[derive(Clone, Debug, PartialEq)]
pub struct ClampedPolygon {
    degree: usize,
    vertices: Vec<DVec3>,
    weights: Option<Vec<f64>>,
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
        check_polygon(degree, &vertices, weights.as_deref(), false)?;
        Ok(Self {
            degree,
            vertices,
            weights,
        })
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
        let degree = float.degree();
        let (given, way) = (float.weights(), Direction::Clamp);
        let ends = ConvertedEnds::<2>::new(degree, float.vertices(), given, way, 1.0);
        let mut vertices = float.vertices().to_vec();
        let mut weights = float.weights().map(<[f64]>::to_vec);
        replace(&mut vertices, weights.as_deref_mut(), ends.rounded());
        Self {
            degree,
            vertices,
            weights,
        }
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
        let (degree, to) = (self.degree, PolygonKind::Float);
        let given = self.weights.as_deref();
        let (norm, way) = (double_factorial(degree), Direction::Unclamp);
        let ends = ConvertedEnds::<3>::new(degree, &self.vertices, given, way, norm);
        let converted: Vec<_> = ends.rounded().collect();
        if given.is_some() {
            let loses = weight_loss(ends.largest_weight() * self.amplification().norm);
            let mut weights = converted.iter();
            weights.try_for_each(|(index, _, weight)| check_weight(to, *index, *weight, loses))?;
        }
        let (mut vertices, mut weights) = (self.vertices.clone(), self.weights.clone());
        replace(&mut vertices, weights.as_deref_mut(), converted);
        FloatPolygon::new(degree, vertices, weights, false)
            .map_err(|error| converted_error(to, error))
    }

    /// Compute how much errors in the vertices grow in [`ClampedPolygon::to_float`].
    pub fn amplification(&self) -> Amplification {
        Amplification::of_unclamping(self.degree, self.segments())
    }

    /// The degree n.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The vertices; the first and the last are the curve's end points.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The weights, one a vertex, of a rational curve.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
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

    /// The vertices with their weights, which are 1 for a polynomial curve.
    pub(super) fn weighted_vertices(&self) -> impl Iterator<Item = (DVec3, f64)> + Clone + '_ {
        weighted(&self.vertices, self.weights.as_deref())
    }
}

/// Pair points and weights; a polynomial curve has weights 1.
pub(super) fn weighted<'a>(
    points: &'a [DVec3],
    weights: Option<&'a [f64]>,
) -> impl Iterator<Item = (DVec3, f64)> + Clone + 'a {
    let weight = move |index| weights.map_or(1.0, |weights: &[f64]| weights[index]);
    let numbered = points.iter().enumerate();
    numbered.map(move |(index, point)| (*point, weight(index)))
}

/// Put converted vertices in their places.
fn replace(
    points: &mut [DVec3],
    mut weights: Option<&mut [f64]>,
    converted: impl IntoIterator<Item = (usize, DVec3, f64)>,
) {
    for (index, point, weight) in converted {
        points[index] = point;
        if let Some(weights) = &mut weights {
            weights[index] = weight;
        }
    }
}
