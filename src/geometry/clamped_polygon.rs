//! The clamped polygon: the same curve on knots that are n + 1 fold at both ends.

use glam::{DVec3, DVec4};

use super::error::PolygonError;
use super::float_polygon::{FloatPolygon, check_degree, check_vertices, check_weights};
use super::knots::{clamp_end, clamp_start, float_knots, unclamp_end, unclamp_start};
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
        check_degree(degree)?;
        if vertices.len() < degree + 1 {
            return Err(PolygonError::TooFewVertices {
                found: vertices.len(),
                needed: degree + 1,
                degree,
                periodic: false,
            });
        }
        check_vertices(&vertices)?;
        check_weights(weights.as_deref(), vertices.len())?;
        Ok(Self {
            degree,
            vertices,
            weights,
        })
    }

    /// Convert a float polygon. Every step interpolates between two vertices, so the result is
    /// accurate to a few roundings, and its weights are positive.
    ///
    /// A periodic curve is opened at u = 0 and runs round once.
    pub fn from_float(float: &FloatPolygon) -> Self {
        let open = float.unrolled();
        let degree = open.degree();
        let mut vertices: Vec<DVec4> = (0..open.vertices().len())
            .map(|index| open.homogeneous(index))
            .collect();
        let mut knots = float_knots(degree, vertices.len());
        clamp_start(degree, &mut knots, &mut vertices);
        clamp_end(degree, &mut knots, &mut vertices);
        let (vertices, weights) = projected(&vertices, float.is_rational());
        Self {
            degree,
            vertices,
            weights,
        }
    }

    /// Convert to the float polygon of the same curve (open, over the same segments).
    ///
    /// The conversion extrapolates: with one segment an error in a vertex grows by up to
    /// (2n − 1)!!, which is 3.4e7 for degree 9; with N ≥ 2n by 1.8e6.
    ///
    /// # Errors
    /// [`PolygonError::WeightLost`] if the exact float polygon has a weight that is not
    /// positive, [`PolygonError::Overflow`] if it has a coordinate beyond the range of numbers.
    pub fn to_float(&self) -> Result<FloatPolygon, PolygonError> {
        let mut vertices: Vec<DVec4> = self.homogeneous_vertices().collect();
        let steps = float_knots(self.degree, vertices.len());
        unclamp_end(self.degree, &steps, &mut vertices);
        unclamp_start(self.degree, &steps, &mut vertices);
        float_from_homogeneous(self.degree, &vertices, self.weights.is_some())
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

    fn homogeneous_vertices(&self) -> impl Iterator<Item = DVec4> + '_ {
        self.vertices.iter().enumerate().map(|(index, vertex)| {
            let weight = self.weights.as_ref().map_or(1.0, |weights| weights[index]);
            (*vertex * weight).extend(weight)
        })
    }
}

/// Split homogeneous vertices into points and, if the curve is rational, weights.
pub(super) fn projected(homogeneous: &[DVec4], rational: bool) -> (Vec<DVec3>, Option<Vec<f64>>) {
    if !rational {
        return (
            homogeneous.iter().map(|vertex| vertex.truncate()).collect(),
            None,
        );
    }
    let points = homogeneous.iter().map(|v| v.truncate() / v.w).collect();
    (points, Some(homogeneous.iter().map(|v| v.w).collect()))
}

/// Make a float polygon of converted vertices, refusing what it cannot hold.
pub(super) fn float_from_homogeneous(
    degree: usize,
    homogeneous: &[DVec4],
    rational: bool,
) -> Result<FloatPolygon, PolygonError> {
    let to = PolygonKind::Float;
    if rational {
        let mut numbered = homogeneous.iter().enumerate();
        if let Some((index, vertex)) =
            numbered.find(|(_, vertex)| vertex.w.is_nan() || vertex.w <= 0.0)
        {
            let weight = vertex.w;
            return Err(PolygonError::WeightLost { to, index, weight });
        }
    }
    let (vertices, weights) = projected(homogeneous, rational);
    FloatPolygon::new(degree, vertices, weights, false).map_err(|error| match error {
        PolygonError::BadCoordinate { index, .. } | PolygonError::BadWeight { index, .. } => {
            PolygonError::Overflow { to, index }
        }
        other => other,
    })
}
