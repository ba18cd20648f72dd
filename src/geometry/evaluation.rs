//! Points and derivatives of a curve at single parameters.

use glam::{DVec3, DVec4};

use super::basis::derivative_bases;
use super::error::MAX_DEGREE;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;
use super::parametric_curve::ParametricCurve;
use super::vector;

impl FloatPolygon {
    /// Find the segment that holds u and the local parameter in it.
    ///
    /// A periodic curve takes u modulo L; an open one continues its first and last segment's
    /// polynomials beyond \[0, L\].
    pub fn locate(&self, u: f64) -> (usize, f64) {
        ParametricCurve::locate(self, u)
    }

    /// Evaluate the point C(u), a mean of the vertices: accurate to a few roundings of the largest
    /// coordinate for u in \[0, L\].
    pub fn point(&self, u: f64) -> DVec3 {
        let (segment, t) = self.locate(u);
        self.segment_point(segment, t)
    }

    /// Evaluate the point and the first three derivatives.
    pub fn jet(&self, u: f64) -> Jet {
        let (segment, t) = self.locate(u);
        self.segment_jet(segment, t)
    }

    /// Evaluate as [`FloatPolygon::jet`] does, on a given segment.
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    pub fn segment_jet(&self, segment: usize, t: f64) -> Jet {
        Jet::from(self.segment_derivatives(segment, t))
    }

    /// Evaluate the point alone.
    pub(super) fn segment_point(&self, segment: usize, t: f64) -> DVec3 {
        let [point] = self.segment_derivatives(segment, t);
        point
    }

    /// Compute the speed |C′| alone: all that arc length needs.
    pub(super) fn segment_speed(&self, segment: usize, t: f64) -> f64 {
        let [_, first] = self.segment_derivatives(segment, t);
        vector::length(first)
    }

    /// Evaluate the point and the derivatives of order 1, 2, … at the local parameter t.
    ///
    /// The derivative of order r of the homogeneous curve has the r-th differences of the
    /// vertices as its float polygon; a rational curve takes Leibniz' rule from there.
    pub(super) fn segment_derivatives<const COUNT: usize>(
        &self,
        segment: usize,
        t: f64,
    ) -> [DVec3; COUNT] {
        let degree = self.degree();
        // A rational curve is evaluated about one of its vertices: the quotient would otherwise
        // lose what the coordinates' distance from the origin takes.
        let origin = if self.is_rational() {
            self.vertex(segment + degree / 2)
        } else {
            DVec3::ZERO
        };
        let mut differences = [DVec4::ZERO; MAX_DEGREE + 1];
        for (j, value) in differences[..=degree].iter_mut().enumerate() {
            let weight = self.weight(segment + j);
            *value = ((self.vertex(segment + j) - origin) * weight).extend(weight);
        }
        let bases = derivative_bases::<COUNT>(degree, t);
        let mut values = [DVec4::ZERO; COUNT];
        for (order, (value, basis)) in values.iter_mut().zip(&bases).take(degree + 1).enumerate() {
            let size = degree + 1 - order;
            let terms = differences[..size].iter().zip(basis);
            *value = terms.fold(DVec4::ZERO, |sum, (vertex, weight)| sum + *vertex * *weight);
            for j in 0..size - 1 {
                differences[j] = differences[j + 1] - differences[j];
            }
        }
        if self.is_rational() {
            quotient(&mut values);
            values[0] += origin.extend(0.0);
        }
        values.map(DVec4::truncate)
    }
}

/// Take the derivatives of a projected curve from those of the homogeneous one (Leibniz).
fn quotient(values: &mut [DVec4]) {
    let weight = values[0].w;
    for order in 0..values.len() {
        let mut value = values[order].truncate();
        let mut binomial = 1.0;
        for k in 1..=order {
            binomial *= (order + 1 - k) as f64 / k as f64;
            value -= binomial * values[k].w * values[order - k].truncate();
        }
        values[order] = (value / weight).extend(values[order].w);
    }
}
