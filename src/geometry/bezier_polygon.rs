//! Bézier polygons: one a segment, and the chain of all of them.

use glam::{DVec3, DVec4};

use super::clamped_polygon::weighted;
use super::conversion::bezier_matrix::{blossom_row, float_to_bezier, middle_segment};
use super::conversion::closing::{smoothness_tolerance, worst_difference};
use super::conversion::exact_polygon::{ExactPolygon, chain};
use super::conversion::exact_vertices::ExactVertices;
use super::conversion::knots::clamp;
use super::error::PolygonError;
use super::float_polygon::{FloatPolygon, check_polygon};

/// Hold a curve by the Bézier polygons of its L segments in one chain of n·L + 1 vertices,
/// neighbours sharing the vertex at their joint.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPolygon {
    degree: usize,
    vertices: Vec<DVec3>,
    weights: Option<Vec<f64>>,
}

impl BezierPolygon {
    /// Build a chain of Bézier polygons.
    ///
    /// # Errors
    /// As [`FloatPolygon::new`], and [`PolygonError::BezierCount`] if the number of vertices is
    /// not n·L + 1.
    pub fn new(
        degree: usize,
        vertices: Vec<DVec3>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self, PolygonError> {
        check_polygon(degree, &vertices, weights.as_deref(), false)?;
        let found = vertices.len();
        if !(found - 1).is_multiple_of(degree) {
            return Err(PolygonError::BezierCount { found, degree });
        }
        Ok(Self {
            degree,
            vertices,
            weights,
        })
    }

    /// Convert a float polygon, segment by segment (the paper's SB and NSB): interpolation only,
    /// in double-double arithmetic, so each number is the exact one rounded. A periodic curve
    /// runs round once from u = 0.
    pub fn from_float(float: &FloatPolygon) -> Self {
        let degree = float.degree();
        let count = float.segments() + degree;
        let vertices = (0..count).map(|index| (float.vertex(index), float.weight(index)));
        let vertices = ExactVertices::new(vertices, float.is_rational());
        let matrix = float_to_bezier::<2>(degree);
        let (vertices, weights) = vertices
            .map(|axis| chain(degree, &matrix, axis))
            .all_rounded();
        Self {
            degree,
            vertices,
            weights,
        }
    }

    /// Convert to the float polygon of the same curve (the paper's BS and NBS), within one
    /// rounding of the exact one: the matrix holds integers, the products three doubles a number.
    ///
    /// Each float vertex is extrapolated from the segment nearest to the middle of its knots,
    /// where the errors that the Bézier vertices already have grow least.
    ///
    /// # Errors
    /// [`PolygonError::NotSmooth`] if the segments are not one curve of smoothness n − 1 on
    /// uniform knots, within 1e-9 of its size or what the conversion makes of rounding (at most
    /// 1e-6); [`PolygonError::DigitsLost`] if the float polygon of a single segment is so large
    /// that doubles do not hold the curve to 1e-6 of its size; [`PolygonError::WeightLost`] and
    /// [`PolygonError::Overflow`] as in [`super::ClampedPolygon::to_float`].
    pub fn to_float(&self) -> Result<FloatPolygon, PolygonError> {
        let float = ExactPolygon::from_bezier(self).to_float()?;
        self.check_smooth(&float)?;
        Ok(float)
    }

    /// The degree n.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The n·L + 1 vertices.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The weights, one a vertex, of a rational curve.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The number of segments L.
    pub fn segments(&self) -> usize {
        (self.vertices.len() - 1) / self.degree
    }

    /// The vertices with their weights, which are 1 for a polynomial curve.
    pub(super) fn weighted_vertices(&self) -> impl Iterator<Item = (DVec3, f64)> + Clone + '_ {
        weighted(&self.vertices, self.weights.as_deref())
    }

    /// Bound what an error of 1 in every vertex does to the float vertex `offset` of a segment.
    pub(super) fn vertex_norm(degree: usize, offset: usize) -> f64 {
        let first = offset as i64 + 1 - degree as i64;
        let row = blossom_row(first..=offset as i64);
        row.into_iter().map(|entry| entry.abs() as f64).sum()
    }

    fn check_smooth(&self, float: &FloatPolygon) -> Result<(), PolygonError> {
        let exact = Self::from_float(float);
        let norms = self.norms_there_and_back()?;
        let tolerance = |index: usize| smoothness_tolerance(norms[index]);
        let given = (self.vertices(), self.weights());
        match worst_difference(given, (exact.vertices(), exact.weights()), tolerance) {
            Some((index, distance)) if self.segments() == 1 => {
                Err(PolygonError::DigitsLost { index, distance })
            }
            Some((index, distance)) => Err(PolygonError::NotSmooth { index, distance }),
            None => Ok(()),
        }
    }

    /// Bound what an error of 1 in every vertex does to each vertex on the way to the float
    /// polygon and back.
    fn norms_there_and_back(&self) -> Result<Vec<f64>, PolygonError> {
        let (degree, segments) = (self.degree, self.segments());
        let norms: Vec<f64> = (0..=degree)
            .map(|offset| Self::vertex_norm(degree, offset))
            .collect();
        let bounds = (0..segments + degree).map(|index| {
            let offset = index - middle_segment(degree, segments, index);
            DVec3::new(norms[offset], 0.0, 0.0)
        });
        let bounds = FloatPolygon::new(degree, bounds.collect(), None, false)?;
        let back = Self::from_float(&bounds).vertices;
        Ok(back.into_iter().map(|vertex| vertex.x).collect())
    }
}

/// Convert one segment of a float polygon to its n + 1 homogeneous Bézier vertices.
///
/// # Panics
/// If the curve has no segment with this number.
pub fn segment_bezier(float: &FloatPolygon, segment: usize) -> Vec<DVec4> {
    let degree = float.degree();
    let mut window: Vec<DVec4> = (segment..=segment + degree)
        .map(|index| float.homogeneous(index))
        .collect();
    clamp(degree, &mut window);
    window
}
