//! A polygon that keeps its digits on the way from one kind of polygon to another.

use super::amplification::Amplification;
use super::bezier_polygon::BezierPolygon;
use super::clamped_polygon::ClampedPolygon;
use super::exact_vertices::{
    ExactVertices, RoundedVertices, check_weight, converted_error, converted_float, weight_loss,
};
use super::knots::unclamp;
use crate::geometry::bezier_matrix::{blossom_row, chain, dot, float_to_bezier, middle_segment};
use crate::geometry::blend::Blend;
use crate::geometry::control_polygon::ControlPolygon;
use crate::geometry::error::{MAX_DEGREE, PolygonError};
use crate::geometry::expansion::Expansion;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

/// Hold a float, clamped or Bézier polygon of an open curve by homogeneous vertices of three
/// doubles a number (159 bits), so that converting there and back loses nothing: the way back
/// amplifies errors by up to (2n − 1)!!, which is 5.8e30 for degree 25, and 2⁻¹⁵⁹ times that is
/// 8e-18. A periodic curve is opened at u = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactPolygon {
    kind: PolygonKind,
    degree: usize,
    vertices: ExactVertices<3>,
    /// Possible error of a weight.
    weight_loss: f64,
}

impl ExactPolygon {
    /// Take a float polygon as it is; a periodic one is unrolled.
    pub fn from_float(float: &FloatPolygon) -> Self {
        Self::new(PolygonKind::Float, &float.unrolled())
    }

    /// Take a clamped polygon as it is.
    pub fn from_clamped(clamped: &ClampedPolygon) -> Self {
        Self::new(PolygonKind::Clamped, clamped)
    }

    /// Take a chain of Bézier polygons as it is.
    pub fn from_bezier(bezier: &BezierPolygon) -> Self {
        Self::new(PolygonKind::Bezier, bezier)
    }

    /// The degree n.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The number of segments L.
    pub fn segments(&self) -> usize {
        match self.kind {
            PolygonKind::Float | PolygonKind::Clamped => self.vertices.len() - self.degree,
            PolygonKind::Bezier => (self.vertices.len() - 1) / self.degree,
        }
    }

    /// Convert to the float polygon, to some 45 digits of the largest number on the way.
    ///
    /// From Bézier polygons each vertex is taken from the segment in the middle of its knots;
    /// whether the others agree is not looked at.
    pub fn float_form(&self) -> Self {
        let (degree, to) = (self.degree, PolygonKind::Float);
        match self.kind {
            PolygonKind::Float => self.clone(),
            PolygonKind::Clamped => {
                let norm = Amplification::of_unclamping(degree, self.segments()).norm;
                self.with(to, norm, |v| v.change(|axis| unclamp(degree, axis)))
            }
            PolygonKind::Bezier => {
                let segments = self.segments();
                self.blossoms(segments + degree, |index| {
                    let segment = middle_segment(degree, segments, index);
                    (segment, segment as i64)
                })
            }
        }
    }

    /// Convert to the Bézier polygons, to as many digits.
    pub fn bezier_form(&self) -> Self {
        let (degree, to) = (self.degree, PolygonKind::Bezier);
        match self.kind {
            PolygonKind::Bezier => self.clone(),
            PolygonKind::Clamped => self.float_form().bezier_form(),
            PolygonKind::Float => {
                let matrix = float_to_bezier(degree);
                self.with(to, 1.0, |v| *v = v.map(|axis| chain(degree, &matrix, axis)))
            }
        }
    }

    /// Round to the float polygon, converting if this is not one.
    ///
    /// # Errors
    /// [`PolygonError::WeightLost`] if the exact polygon has a weight that is not positive (by
    /// more than 2⁻¹⁵⁰ of what it is a difference of), [`PolygonError::Overflow`] if it has a
    /// coordinate beyond the range of numbers.
    pub fn to_float(&self) -> Result<FloatPolygon, PolygonError> {
        converted_float(self.degree, self.float_form().rounded()?, false)
    }

    /// Round the vertices of a float polygon to a periodic one.
    ///
    /// # Errors
    /// As [`ExactPolygon::to_float`].
    pub(in crate::geometry) fn to_periodic_float(&self) -> Result<FloatPolygon, PolygonError> {
        converted_float(self.degree, self.rounded()?, true)
    }

    /// Round to the Bézier polygons, converting if these are not they.
    ///
    /// # Errors
    /// As [`ExactPolygon::to_float`].
    pub fn to_bezier(&self) -> Result<BezierPolygon, PolygonError> {
        let (vertices, weights) = self.bezier_form().rounded()?;
        BezierPolygon::new(self.degree, vertices, weights)
            .map_err(|error| converted_error(PolygonKind::Bezier, error))
    }

    /// Raise the degree of each Bézier polygon by one, exactly.
    ///
    /// # Errors
    /// [`PolygonError::DegreeOutOfRange`] beyond degree 25.
    pub(in crate::geometry) fn raised(&self) -> Result<Self, PolygonError> {
        let degree = self.degree + 1;
        if degree > MAX_DEGREE {
            return Err(PolygonError::DegreeOutOfRange { degree });
        }
        let mut raised = self.bezier_form();
        raised.vertices = raised.vertices.map(|axis| raised_chain(self.degree, axis));
        raised.degree = degree;
        Ok(raised)
    }

    /// Convert Bézier polygons that close into one curve to the vertices of a periodic float
    /// polygon, without looking whether they do.
    pub(in crate::geometry) fn periodic_blossoms(&self) -> Self {
        let (half, segments) = (self.degree / 2, self.segments());
        self.blossoms(segments, |index| {
            // The knots count from the start of the middle segment, wherever that wraps to.
            let start = index as i64 - half as i64;
            ((index + segments * self.degree - half) % segments, start)
        })
    }

    /// Keep one of the two copies of the first n vertices that a float polygon has whose curve
    /// closes: of each that from the end where it is the more accurate.
    pub(in crate::geometry) fn folded(&self) -> Self {
        let (half, segments) = (self.degree / 2, self.segments());
        let place = |index| {
            if index < half {
                index + segments
            } else {
                index
            }
        };
        let mut folded = self.clone();
        folded.vertices = self
            .vertices
            .map(|axis| (0..segments).map(|index| axis[place(index)]).collect());
        folded
    }

    /// The homogeneous vertices.
    pub(in crate::geometry) fn vertices(&self) -> &ExactVertices<3> {
        &self.vertices
    }

    fn new(kind: PolygonKind, polygon: &ControlPolygon) -> Self {
        Self {
            kind,
            degree: polygon.degree(),
            vertices: ExactVertices::of(polygon),
            weight_loss: 0.0,
        }
    }

    /// Change a copy's vertices by a conversion whose rows sum up to `norm`.
    fn with(&self, kind: PolygonKind, norm: f64, change: impl Fn(&mut ExactVertices<3>)) -> Self {
        let mut converted = self.clone();
        converted.kind = kind;
        converted.weight_loss = self.loss_after(norm);
        change(&mut converted.vertices);
        converted
    }

    fn loss_after(&self, norm: f64) -> f64 {
        norm * (self.weight_loss + weight_loss(self.vertices.largest_weight()))
    }

    /// Compute `count` float vertices from Bézier polygons, each from the segment in the middle of
    /// its knots: `place` tells that segment's number and where its knots count from.
    fn blossoms(&self, count: usize, place: impl Fn(usize) -> (usize, i64)) -> Self {
        let mut norm = 0.0_f64;
        let rows: Vec<(usize, Vec<Expansion<3>>)> = (0..count)
            .map(|index| {
                let (segment, start) = place(index);
                let last = index as i64 - start;
                let row = blossom_row(last + 1 - self.degree as i64..=last);
                norm = norm.max(row.iter().map(|entry| entry.abs() as f64).sum());
                let row = row.into_iter().map(Expansion::from).collect();
                (segment * self.degree, row)
            })
            .collect();
        let product = |axis: &[Expansion<3>]| {
            let rows = rows.iter();
            let vertex = |(first, row): &(usize, Vec<_>)| dot(row, &axis[*first..]);
            rows.map(vertex).collect()
        };
        Self {
            kind: PolygonKind::Float,
            degree: self.degree,
            vertices: self.vertices.map(product),
            weight_loss: self.loss_after(norm),
        }
    }

    /// Round to points and weights.
    ///
    /// # Errors
    /// [`PolygonError::WeightLost`] as in [`ExactPolygon::to_float`].
    pub(in crate::geometry) fn rounded(&self) -> Result<RoundedVertices, PolygonError> {
        let (vertices, weights) = self.vertices.all_rounded();
        for (index, weight) in weights.iter().flatten().enumerate() {
            check_weight(self.kind, index, *weight, self.weight_loss)?;
        }
        Ok((vertices, weights))
    }
}

/// Raise the degree of each polygon of a chain by one: vertex k becomes
/// (k·b_{k−1} + (n + 1 − k)·b_k) / (n + 1).
fn raised_chain(degree: usize, axis: &[Expansion<3>]) -> Vec<Expansion<3>> {
    let mut raised: Vec<Expansion<3>> = axis.first().copied().into_iter().collect();
    for window in axis.windows(degree + 1).step_by(degree) {
        let inner = window.windows(2).enumerate().map(|(index, leg)| {
            let before = (index + 1) as f64;
            let divisor = (degree + 1) as f64;
            Expansion::blend(before, &leg[0], divisor - before, &leg[1], divisor)
        });
        raised.extend(inner);
        raised.extend(window.last().copied());
    }
    raised
}
