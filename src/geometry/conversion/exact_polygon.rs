//! A polygon that keeps its digits on the way from one kind of polygon to another.

use glam::DVec3;

use super::amplification::Amplification;
use super::bezier_matrix::{blossom_row, float_to_bezier, middle_segment};
use super::exact_vertices::{ExactVertices, check_weight, converted_error, weight_loss};
use super::knots::{clamp, unclamp};
use crate::geometry::bezier_polygon::BezierPolygon;
use crate::geometry::blend::Blend;
use crate::geometry::clamped_polygon::ClampedPolygon;
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
    /// What a weight may have lost.
    weight_loss: f64,
}

impl ExactPolygon {
    /// Take a float polygon as it is; a periodic one is unrolled.
    pub fn from_float(float: &FloatPolygon) -> Self {
        let count = float.segments() + float.degree();
        let vertices = (0..count).map(|index| (float.vertex(index), float.weight(index)));
        Self::new(
            PolygonKind::Float,
            float.degree(),
            vertices,
            float.is_rational(),
        )
    }

    /// Take a clamped polygon as it is.
    pub fn from_clamped(clamped: &ClampedPolygon) -> Self {
        let rational = clamped.weights().is_some();
        let vertices = clamped.weighted_vertices();
        Self::new(PolygonKind::Clamped, clamped.degree(), vertices, rational)
    }

    /// Take a chain of Bézier polygons as it is.
    pub fn from_bezier(bezier: &BezierPolygon) -> Self {
        let rational = bezier.weights().is_some();
        let vertices = bezier.weighted_vertices();
        Self::new(PolygonKind::Bezier, bezier.degree(), vertices, rational)
    }

    /// Which polygon of the curve this is.
    pub fn kind(&self) -> PolygonKind {
        self.kind
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

    /// Convert to another polygon of the same curve, to some 45 digits of the largest number on
    /// the way.
    ///
    /// From Bézier polygons each vertex is taken from the segment in the middle of its knots;
    /// whether the others agree is not looked at.
    pub fn converted(&self, to: PolygonKind) -> Self {
        use PolygonKind::{Bezier, Clamped, Float};
        let degree = self.degree;
        match (self.kind, to) {
            (Float, Clamped) => self.with(to, 1.0, |v| v.change(|axis| clamp(degree, axis))),
            (Clamped, Float) => {
                let norm = Amplification::of_unclamping(degree, self.segments()).norm;
                self.with(to, norm, |v| v.change(|axis| unclamp(degree, axis)))
            }
            (Float, Bezier) => {
                let matrix = float_to_bezier(degree);
                self.with(to, 1.0, |v| *v = v.map(|axis| chain(degree, &matrix, axis)))
            }
            (Bezier, Float | Clamped) => self.blossoms(to),
            (Clamped, Bezier) => self.converted(Float).converted(Bezier),
            (Float, Float) | (Clamped, Clamped) | (Bezier, Bezier) => self.clone(),
        }
    }

    /// Round to the float polygon, converting if this is not one.
    ///
    /// # Errors
    /// [`PolygonError::WeightLost`] if the exact polygon has a weight that is not positive (by
    /// more than 2⁻¹⁵⁰ of what it is a difference of), [`PolygonError::Overflow`] if it has a
    /// coordinate beyond the range of numbers.
    pub fn to_float(&self) -> Result<FloatPolygon, PolygonError> {
        let (vertices, weights) = self.rounded(PolygonKind::Float)?;
        FloatPolygon::new(self.degree, vertices, weights, false)
            .map_err(|error| converted_error(PolygonKind::Float, error))
    }

    /// Round to the clamped polygon, converting if this is not one.
    ///
    /// # Errors
    /// As [`ExactPolygon::to_float`].
    pub fn to_clamped(&self) -> Result<ClampedPolygon, PolygonError> {
        let (vertices, weights) = self.rounded(PolygonKind::Clamped)?;
        ClampedPolygon::new(self.degree, vertices, weights)
            .map_err(|error| converted_error(PolygonKind::Clamped, error))
    }

    /// Round to the Bézier polygons, converting if these are not they.
    ///
    /// # Errors
    /// As [`ExactPolygon::to_float`].
    pub fn to_bezier(&self) -> Result<BezierPolygon, PolygonError> {
        let (vertices, weights) = self.rounded(PolygonKind::Bezier)?;
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
        let mut raised = self.converted(PolygonKind::Bezier);
        raised.vertices = raised.vertices.map(|axis| raised_chain(self.degree, axis));
        raised.degree = degree;
        Ok(raised)
    }

    /// Convert Bézier polygons that close into one curve to the vertices of a periodic float
    /// polygon, without looking whether they do.
    pub(in crate::geometry) fn periodic_blossoms(&self) -> Self {
        let (degree, segments) = (self.degree, self.segments());
        self.blossoms_at(PolygonKind::Float, segments, |index| {
            let first = index as i64 + 1 - degree as i64;
            let segment = (index + segments * degree - degree / 2) % segments;
            // The knots, counted from the start of the middle segment, wherever that wraps to.
            let start = index as i64 - (degree / 2) as i64;
            (
                segment,
                (first..=index as i64).map(|knot| knot - start).collect(),
            )
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

    fn new(
        kind: PolygonKind,
        degree: usize,
        vertices: impl Iterator<Item = (DVec3, f64)> + Clone,
        rational: bool,
    ) -> Self {
        Self {
            kind,
            degree,
            vertices: ExactVertices::new(vertices, rational),
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

    fn blossoms(&self, to: PolygonKind) -> Self {
        let (degree, segments) = (self.degree, self.segments());
        self.blossoms_at(to, segments + degree, |index| {
            let segment = middle_segment(degree, segments, index);
            let knots = vertex_knots(to, degree, segments, index);
            (segment, knots.map(|knot| knot - segment as i64).collect())
        })
    }

    /// Compute `count` vertices from Bézier polygons: for each the segment to take it from, and
    /// its n knots counted from there.
    fn blossoms_at(
        &self,
        to: PolygonKind,
        count: usize,
        place: impl Fn(usize) -> (usize, Vec<i64>),
    ) -> Self {
        let mut norm = 0.0_f64;
        let rows: Vec<(usize, Vec<Expansion<3>>)> = (0..count)
            .map(|index| {
                let (segment, knots) = place(index);
                let row = blossom_row(knots.into_iter());
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
            kind: to,
            degree: self.degree,
            vertices: self.vertices.map(product),
            weight_loss: self.loss_after(norm),
        }
    }

    /// Round to points and weights of this kind of polygon, converting if needed.
    ///
    /// # Errors
    /// [`PolygonError::WeightLost`] as in [`ExactPolygon::to_float`].
    pub(in crate::geometry) fn rounded(
        &self,
        to: PolygonKind,
    ) -> Result<RoundedVertices, PolygonError> {
        if self.kind != to {
            return self.converted(to).rounded(to);
        }
        let (vertices, weights) = self.vertices.all_rounded();
        for (index, weight) in weights.iter().flatten().enumerate() {
            check_weight(to, index, *weight, self.weight_loss)?;
        }
        Ok((vertices, weights))
    }
}

/// Points and, of a rational curve, weights.
pub(in crate::geometry) type RoundedVertices = (Vec<DVec3>, Option<Vec<f64>>);

/// The n knots of a vertex of an open float or clamped polygon.
pub(in crate::geometry) fn vertex_knots(
    kind: PolygonKind,
    degree: usize,
    segments: usize,
    index: usize,
) -> impl Iterator<Item = i64> {
    let (low, high) = match kind {
        PolygonKind::Clamped => (0, segments as i64),
        PolygonKind::Float | PolygonKind::Bezier => (i64::MIN, i64::MAX),
    };
    let first = index as i64 + 1 - degree as i64;
    (first..=index as i64).map(move |knot| knot.clamp(low, high))
}

/// Sum up the products of a row and as many numbers.
pub(in crate::geometry) fn dot<const K: usize>(
    row: &[Expansion<K>],
    numbers: &[Expansion<K>],
) -> Expansion<K> {
    let products = row.iter().zip(numbers);
    products.fold(Expansion::default(), |sum, (a, b)| sum.plus_product(*a, *b))
}

/// Convert one coordinate of a float polygon to that of the chain of Bézier polygons.
pub(in crate::geometry) fn chain<const K: usize>(
    degree: usize,
    matrix: &[Expansion<K>],
    axis: &[Expansion<K>],
) -> Vec<Expansion<K>> {
    let size = degree + 1;
    let mut chain = Vec::with_capacity(degree * (axis.len() - degree) + 1);
    for (segment, window) in axis.windows(size).enumerate() {
        let shared = usize::from(segment > 0);
        chain.extend(matrix.chunks(size).skip(shared).map(|row| dot(row, window)));
    }
    chain
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
