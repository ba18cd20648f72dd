//! Points and derivatives of a curve at single parameters.

use glam::{DVec3, DVec4};

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

    /// Evaluate the point C(u) by de Boor's algorithm, which interpolates only: accurate to a
    /// few roundings of the largest coordinate for u in \[0, L\].
    pub fn point(&self, u: f64) -> DVec3 {
        let (segment, t) = self.locate(u);
        if self.is_rational() {
            let homogeneous = de_boor(self.degree(), t, |j| self.homogeneous(segment + j));
            homogeneous.truncate() / homogeneous.w
        } else {
            de_boor(self.degree(), t, |j| self.vertex(segment + j).extend(1.0)).truncate()
        }
    }

    /// Evaluate the point and all derivatives by u up to `order`: `order` + 1 vectors.
    ///
    /// The derivative of order r of the homogeneous curve has the r-th differences of the
    /// vertices as its float polygon; a rational curve takes Leibniz' rule from there.
    pub fn derivatives(&self, u: f64, order: usize) -> Vec<DVec3> {
        let (segment, t) = self.locate(u);
        self.segment_derivatives(segment, t, order)
    }

    /// Evaluate as [`FloatPolygon::derivatives`] does, but on a given segment: at a knot this
    /// chooses the side, with t = 0 or t = 1.
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    pub fn segment_derivatives(&self, segment: usize, t: f64, order: usize) -> Vec<DVec3> {
        let mut values = vec![DVec4::ZERO; order + 1];
        self.fill_derivatives(segment, t, &mut values);
        values.into_iter().map(DVec4::truncate).collect()
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
        let mut values = [DVec4::ZERO; 4];
        self.fill_derivatives(segment, t, &mut values);
        let [point, first, second, third] = values.map(DVec4::truncate);
        Jet {
            point,
            first,
            second,
            third,
        }
    }

    /// Compute the speed |C′| alone: all that arc length needs.
    pub(super) fn segment_speed(&self, segment: usize, t: f64) -> f64 {
        let mut values = [DVec4::ZERO; 2];
        self.fill_derivatives(segment, t, &mut values);
        vector::length(values[1].truncate())
    }

    /// Fill `values` with the point and as many derivatives as there is room for.
    fn fill_derivatives(&self, segment: usize, t: f64, values: &mut [DVec4]) {
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
        for (r, value) in values.iter_mut().enumerate().take(degree + 1) {
            *value = de_boor(degree - r, t, |j| differences[j]);
            for j in 0..degree - r {
                differences[j] = differences[j + 1] - differences[j];
            }
        }
        if self.is_rational() {
            quotient(values);
            values[0] += origin.extend(0.0);
        }
    }
}

/// Run de Boor's algorithm on one segment of a uniform B-spline.
fn de_boor(degree: usize, t: f64, vertex: impl Fn(usize) -> DVec4) -> DVec4 {
    let mut values = [DVec4::ZERO; MAX_DEGREE + 1];
    for (j, value) in values[..=degree].iter_mut().enumerate() {
        *value = vertex(j);
    }
    for level in (1..=degree).rev() {
        let width = level as f64;
        for j in 0..level {
            // The knots of this step are j + 1 − level and j + 1, as t counts.
            let rising = t + (level - 1 - j) as f64;
            let falling = (j + 1) as f64 - t;
            values[j] = (falling * values[j] + rising * values[j + 1]) / width;
        }
    }
    values[0]
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
