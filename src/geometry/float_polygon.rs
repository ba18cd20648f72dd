//! The float polygon: control vertices on uniform, unclamped knots.

use std::ops::{Deref, Range};

use glam::{DVec3, DVec4};

use super::control_polygon::{ControlPolygon, check_vertex, check_weight};
use super::error::PolygonError;

/// Hold a B-spline curve of degree n by N vertices on uniform knots (paper, section 1:
/// the S-polygon in float format).
///
/// An open curve has L = N − n segments, a periodic one L = N; the parameter u runs over
/// \[0, L\], one unit a segment, and segment k depends on vertices k … k + n (modulo N when
/// periodic). Planar curves have z = 0. A value of this type is always valid: see
/// [`FloatPolygon::new`].
#[derive(Clone, Debug, PartialEq)]
pub struct FloatPolygon {
    polygon: ControlPolygon,
    periodic: bool,
}

impl Deref for FloatPolygon {
    type Target = ControlPolygon;

    fn deref(&self) -> &ControlPolygon {
        &self.polygon
    }
}

impl FloatPolygon {
    /// Build a polygon from its degree, vertices, optional weights and whether it is periodic. A
    /// height of −0 is taken as 0.
    ///
    /// # Errors
    /// [`PolygonError`] if the degree is not 1 … 25, there are fewer than n + 1 vertices, a
    /// coordinate is not finite (or beyond ±1e100), the numbers of weights and vertices differ,
    /// or a weight is not a positive number (1e-100 … 1e100).
    pub fn new(
        degree: usize,
        vertices: Vec<DVec3>,
        weights: Option<Vec<f64>>,
        periodic: bool,
    ) -> Result<Self, PolygonError> {
        let mut polygon = ControlPolygon::new(degree, vertices, weights, periodic)?;
        for vertex in &mut polygon.vertices {
            *vertex = without_negative_height(*vertex);
        }
        Ok(Self { polygon, periodic })
    }

    /// Build a polynomial open polygon of a planar curve from (x, y) pairs.
    ///
    /// # Errors
    /// As [`FloatPolygon::new`].
    pub fn planar(degree: usize, points: &[(f64, f64)]) -> Result<Self, PolygonError> {
        let vertices = points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0));
        Self::new(degree, vertices.collect(), None, false)
    }

    /// Whether the curve is periodic.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// Whether the other polygon has the same degree and number of vertices and is open or periodic as this one, so
    /// that vertices and parameters mean the same in both.
    pub fn has_numbers_of(&self, other: &Self) -> bool {
        let numbers =
            |polygon: &Self| (polygon.degree(), polygon.vertices().len(), polygon.periodic);
        numbers(self) == numbers(other)
    }

    /// The vertices that are elsewhere than in another polygon; none where numbers or weights differ, which cannot be
    /// compared.
    pub fn moved_vertices(&self, before: &Self) -> Vec<usize> {
        if !self.has_numbers_of(before) || self.weights() != before.weights() {
            return Vec::new();
        }
        let pairs = before.vertices().iter().zip(self.vertices()).enumerate();
        let moved = pairs.filter(|(_, (before, now))| before != now);
        moved.map(|(index, _)| index).collect()
    }

    /// The number of segments L, which is also the end of the parameter's domain \[0, L\].
    pub fn segments(&self) -> usize {
        if self.periodic {
            self.vertices.len()
        } else {
            self.vertices.len() - self.degree
        }
    }

    /// List the segments that depend on the vertices of a range: one range, or two where a periodic
    /// curve's segments wrap around.
    pub fn dependent_segments(&self, changed: &Range<usize>) -> Vec<Range<usize>> {
        let (degree, segments) = (self.degree, self.segments());
        if !self.periodic {
            let first = changed.start.saturating_sub(degree);
            return vec![first..changed.end.min(segments)];
        }
        if changed.len() + degree >= segments {
            return vec![0..segments];
        }
        match changed.start.checked_sub(degree) {
            Some(first) => vec![first..changed.end],
            None => {
                let wrapped = changed.start + segments - degree;
                vec![0..changed.end, wrapped..segments]
            }
        }
    }

    /// The vertex that segment and knot counting reach with number `index`: modulo N if periodic.
    ///
    /// # Panics
    /// If the curve is open and has no vertex `index`.
    pub fn vertex(&self, index: usize) -> DVec3 {
        self.vertices[self.wrapped(index)]
    }

    /// The weight that goes with [`FloatPolygon::vertex`]; 1 for a polynomial curve.
    ///
    /// # Panics
    /// As [`FloatPolygon::vertex`].
    pub fn weight(&self, index: usize) -> f64 {
        let index = self.wrapped(index);
        self.weights.as_ref().map_or(1.0, |weights| weights[index])
    }

    /// The homogeneous vertex (w·x, w·y, w·z, w) with number `index`, modulo N if periodic.
    ///
    /// # Panics
    /// As [`FloatPolygon::vertex`].
    pub fn homogeneous(&self, index: usize) -> DVec4 {
        let weight = self.weight(index);
        (self.vertex(index) * weight).extend(weight)
    }

    /// Change where some vertices are; everything else stays.
    ///
    /// # Errors
    /// [`PolygonError`] if a number or coordinate cannot be used; nothing is changed then.
    pub fn move_vertices(
        &mut self,
        moves: impl IntoIterator<Item = (usize, DVec3)> + Clone,
    ) -> Result<(), PolygonError> {
        for (index, point) in moves.clone() {
            self.check_index(index)?;
            check_vertex(index, point)?;
        }
        for (index, point) in moves {
            self.polygon.vertices[index] = without_negative_height(point);
        }
        Ok(())
    }

    /// Change the weight of one vertex. A polynomial curve becomes a rational one; when all
    /// weights are 1 the curve is polynomial again.
    ///
    /// # Errors
    /// [`PolygonError`] if the vertex does not exist or the weight cannot be used.
    pub fn set_weight(&mut self, index: usize, weight: f64) -> Result<(), PolygonError> {
        self.check_index(index)?;
        check_weight(index, weight)?;
        let count = self.vertices.len();
        let held = &mut self.polygon.weights;
        let weights = held.get_or_insert_with(|| vec![1.0; count]);
        weights[index] = weight;
        if weights.iter().all(|weight| *weight == 1.0) {
            *held = None;
        }
        Ok(())
    }

    /// Reverse the direction in which the curve runs; the curve itself is the same.
    pub fn reversed(&self) -> Self {
        let mut reversed = self.clone();
        reversed.polygon.vertices.reverse();
        if let Some(weights) = &mut reversed.polygon.weights {
            weights.reverse();
        }
        if self.periodic {
            // The joint u = 0 lies between fixed vertices: keep it where it was.
            reversed.polygon.vertices.rotate_right(self.degree);
            if let Some(weights) = &mut reversed.polygon.weights {
                weights.rotate_right(self.degree);
            }
        }
        reversed
    }

    /// Let a periodic curve begin with another of its segments, modulo L; the curve itself is the same,
    /// and so is an open one.
    pub fn begun_at(&self, segment: usize) -> Self {
        let mut begun = self.clone();
        if self.periodic {
            let first = segment % self.vertices.len();
            begun.polygon.vertices.rotate_left(first);
            if let Some(weights) = &mut begun.polygon.weights {
                weights.rotate_left(first);
            }
        }
        begun
    }

    /// The open polygon of a range of vertices, across the joint as often as needed.
    ///
    /// # Errors
    /// [`PolygonError::TooFewVertices`] if there are fewer than n + 1.
    pub(super) fn window(&self, vertices: Range<usize>) -> Result<Self, PolygonError> {
        let weights = vertices.clone().map(|index| self.weight(index)).collect();
        let weights = Some(weights).filter(|_| self.is_rational());
        let vertices = vertices.map(|index| self.vertex(index)).collect();
        Self::new(self.degree, vertices, weights, false)
    }

    /// Refuse a periodic curve.
    ///
    /// # Errors
    /// [`PolygonError::PeriodicCurve`], which says that it cannot be `done`.
    pub(super) fn check_open(&self, done: &'static str) -> Result<(), PolygonError> {
        if self.is_periodic() {
            Err(PolygonError::PeriodicCurve { done })
        } else {
            Ok(())
        }
    }

    fn wrapped(&self, index: usize) -> usize {
        if self.periodic {
            index % self.vertices.len()
        } else {
            index
        }
    }

    /// Refuse the number of a vertex that does not exist.
    ///
    /// # Errors
    /// [`PolygonError::NoSuchVertex`].
    pub fn check_index(&self, index: usize) -> Result<(), PolygonError> {
        let count = self.vertices.len();
        if index < count {
            Ok(())
        } else {
            Err(PolygonError::NoSuchVertex { index, count })
        }
    }
}

/// Write a height of −0 as 0: a planar curve has no heights that could differ.
fn without_negative_height(vertex: DVec3) -> DVec3 {
    vertex.with_z(vertex.z + 0.0)
}
