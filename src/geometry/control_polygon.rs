//! Degree, vertices and weights: the common data of all polygons of a curve.

use glam::DVec3;

use super::error::{MAX_DEGREE, PolygonError};
use super::vector;

/// The largest magnitude of a coordinate or weight, and the inverse of the smallest weight.
/// Derivatives, squares and cubes of such numbers still fit into a double.
pub const MAX_MAGNITUDE: f64 = 1e100;

/// Hold the degree n, at least n + 1 vertices, and optional weights, all checked.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlPolygon {
    pub(super) degree: usize,
    pub(super) vertices: Vec<DVec3>,
    pub(super) weights: Option<Vec<f64>>,
}

impl ControlPolygon {
    /// Build a polygon from its degree, vertices and optional weights; `periodic` tells for what.
    ///
    /// # Errors
    /// As [`FloatPolygon::new`](super::FloatPolygon::new).
    pub(super) fn new(
        degree: usize,
        vertices: Vec<DVec3>,
        weights: Option<Vec<f64>>,
        periodic: bool,
    ) -> Result<Self, PolygonError> {
        check_size(degree, vertices.len(), periodic)?;
        for (index, vertex) in vertices.iter().enumerate() {
            check_vertex(index, *vertex)?;
        }
        check_weights(weights.as_deref(), vertices.len())?;
        Ok(Self {
            degree,
            vertices,
            weights,
        })
    }

    /// The degree n.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The vertices.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The weights, one a vertex, of a rational curve.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// Whether the curve is rational: whether it has weights.
    pub fn is_rational(&self) -> bool {
        self.weights.is_some()
    }

    /// Whether the curve lies in the plane z = 0.
    pub fn is_planar(&self) -> bool {
        self.vertices.iter().all(|vertex| vertex.z == 0.0)
    }

    /// The diagonal of the box around the vertices: the size that tolerances are relative to.
    pub fn size(&self) -> f64 {
        diagonal(&self.vertices)
    }

    /// The vertices with their weights, which are 1 for a polynomial curve.
    pub(super) fn weighted_vertices(&self) -> impl Iterator<Item = (DVec3, f64)> + Clone + '_ {
        (0..self.vertices.len()).map(|index| self.weighted_vertex(index))
    }

    /// A vertex with its weight, which is 1 for a polynomial curve.
    pub(super) fn weighted_vertex(&self, index: usize) -> (DVec3, f64) {
        let weight = self.weights.as_ref().map_or(1.0, |weights| weights[index]);
        (self.vertices[index], weight)
    }

    /// Put converted vertices in their places.
    pub(super) fn replace(&mut self, converted: impl IntoIterator<Item = (usize, DVec3, f64)>) {
        for (index, point, weight) in converted {
            self.vertices[index] = point;
            if let Some(weights) = &mut self.weights {
                weights[index] = weight;
            }
        }
    }
}

/// Refuse degrees that there are not, and numbers of vertices that make no curve.
pub(super) fn check_size(degree: usize, found: usize, periodic: bool) -> Result<(), PolygonError> {
    check_degree(degree)?;
    let needed = degree + 1;
    if found < needed {
        return Err(PolygonError::TooFewVertices {
            found,
            needed,
            degree,
            periodic,
        });
    }
    Ok(())
}

pub(super) fn check_degree(degree: usize) -> Result<(), PolygonError> {
    if (1..=MAX_DEGREE).contains(&degree) {
        Ok(())
    } else {
        Err(PolygonError::DegreeOutOfRange { degree })
    }
}

pub(super) fn check_vertex(index: usize, vertex: DVec3) -> Result<(), PolygonError> {
    for (axis, value) in ['x', 'y', 'z'].into_iter().zip(vertex.to_array()) {
        if value.is_nan() || value.abs() > MAX_MAGNITUDE {
            return Err(PolygonError::BadCoordinate { index, axis, value });
        }
    }
    Ok(())
}

fn check_weights(weights: Option<&[f64]>, vertices: usize) -> Result<(), PolygonError> {
    let Some(weights) = weights else {
        return Ok(());
    };
    if weights.len() != vertices {
        return Err(PolygonError::WeightCount {
            weights: weights.len(),
            vertices,
        });
    }
    for (index, weight) in weights.iter().enumerate() {
        check_weight(index, *weight)?;
    }
    Ok(())
}

pub(super) fn check_weight(index: usize, weight: f64) -> Result<(), PolygonError> {
    if (1.0 / MAX_MAGNITUDE..=MAX_MAGNITUDE).contains(&weight) {
        Ok(())
    } else {
        Err(PolygonError::BadWeight {
            index,
            value: weight,
        })
    }
}

/// The diagonal of the box around some points.
pub(super) fn diagonal(points: &[DVec3]) -> f64 {
    let (low, high) = vector::bounds(points);
    vector::length(high - low)
}
