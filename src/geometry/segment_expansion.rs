//! One segment as polynomials in powers of the parameter, centred in the segment.

use glam::DVec4;

use super::basis::derivative_bases;
use super::error::MAX_DEGREE;
use super::expansion::Expansion;
use super::float_polygon::FloatPolygon;

/// A homogeneous vertex, or a difference of some, with twice the digits.
type Vector = Expansion<2, DVec4>;

/// Hold one segment of a curve by its Taylor polynomial about the middle of the segment, t = ½.
///
/// The k-th derivative at ½ is a mean of the k-th differences of the vertices, so the power
/// form is accurate at every order: expanding it about another t of the segment multiplies
/// errors by at most e, as |t − ½| ≤ ½ and each order of differences at most doubles them. The
/// differences are carried in double-double: those of a rational curve cancel in products of
/// vertices and weights, whose rounding each order would double. Nothing is allocated.
#[derive(Clone, Debug)]
pub struct SegmentExpansion {
    degree: usize,
    planar: bool,
    rational: bool,
    /// The coefficients of 1, s, s², … in s = t − ½ of the homogeneous curve; those of a rational
    /// one count from one of its vertices, because the division by the weight would otherwise
    /// lose what the coordinates' distance from the origin takes.
    coefficients: [DVec4; MAX_DEGREE + 1],
}

impl SegmentExpansion {
    /// Expand segment `segment` of a curve; `planar` tells whether the whole curve lies in the
    /// plane z = 0, so that its curvature is signed and it has no torsion.
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    pub fn new(polygon: &FloatPolygon, segment: usize, planar: bool) -> Self {
        let degree = polygon.degree();
        let means = derivative_bases::<{ MAX_DEGREE + 1 }>(degree, 0.5);
        let mut differences = [Vector::default(); MAX_DEGREE + 1];
        fill_vertices(polygon, segment, &mut differences[..=degree]);
        let mut coefficients = [DVec4::ZERO; MAX_DEGREE + 1];
        let mut factorial = 1.0;
        for order in 0..=degree {
            factorial *= order.max(1) as f64;
            let size = degree - order + 1;
            let terms = differences[..size].iter().zip(&means[order]);
            let sum = terms.fold(DVec4::ZERO, |sum, (difference, basis)| {
                sum + difference.parts()[0] * *basis
            });
            coefficients[order] = sum / factorial;
            for j in 0..size - 1 {
                differences[j] = differences[j + 1] - differences[j];
            }
        }
        Self {
            degree,
            planar,
            rational: polygon.is_rational(),
            coefficients,
        }
    }

    /// Whether the whole curve lies in the plane z = 0.
    pub fn is_planar(&self) -> bool {
        self.planar
    }

    /// Expand the curve about the local parameter t: the coefficients of hᵏ in C(t + h), which
    /// are the k-th derivatives over k!. They fit the derivatives; the point itself counts from
    /// a vertex of the segment if the curve is rational.
    #[inline(always)]
    pub(super) fn about<const LENGTH: usize>(&self, t: f64) -> [DVec4; LENGTH] {
        let step = t - 0.5;
        let mut shifted = self.coefficients;
        let shifted = &mut shifted[..=self.degree];
        let mut series = [DVec4::ZERO; LENGTH];
        for (order, coefficient) in series.iter_mut().enumerate().take(self.degree + 1) {
            let mut above = DVec4::ZERO;
            for value in shifted[order..].iter_mut().rev() {
                above = *value + step * above;
                *value = above;
            }
            *coefficient = above;
        }
        if self.rational {
            divide_by_weight(&mut series);
        }
        series
    }
}

/// Fill in the homogeneous vertices of a segment.
fn fill_vertices(polygon: &FloatPolygon, segment: usize, vertices: &mut [Vector]) {
    if !polygon.is_rational() {
        for (vertex, index) in vertices.iter_mut().zip(segment..) {
            *vertex = Vector::from(polygon.vertex(index).extend(1.0));
        }
        return;
    }
    let origin = Vector::from(polygon.vertex(segment + polygon.degree() / 2).extend(0.0));
    for (vertex, index) in vertices.iter_mut().zip(segment..) {
        let arm = Vector::from(polygon.vertex(index).extend(1.0)) - origin;
        *vertex = arm * polygon.weight(index);
    }
}

/// Divide the series of a homogeneous curve by that of its weight.
#[inline(always)]
fn divide_by_weight<const LENGTH: usize>(series: &mut [DVec4; LENGTH]) {
    let weights = series.map(|coefficient| coefficient.w);
    let inverse = 1.0 / weights[0];
    for k in 0..LENGTH {
        let mut value = series[k];
        for j in 1..=k {
            value -= weights[j] * series[k - j];
        }
        series[k] = value * inverse;
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use num_rational::BigRational;
    use num_traits::{FromPrimitive, ToPrimitive};

    use super::*;

    /// Roundings that an order may take, in units of the largest difference of that order: the
    /// mean, and the steps of the expansion, whose terms sum to at most e.
    const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

    fn exact(value: f64) -> BigRational {
        BigRational::from_f64(value).expect("a finite number")
    }

    /// De Boor's algorithm in exact arithmetic.
    fn de_boor(t: &BigRational, vertices: &[BigRational]) -> BigRational {
        let mut values = vertices.to_vec();
        for level in (1..vertices.len()).rev() {
            for j in 0..level {
                let rising = t + exact((level - 1 - j) as f64);
                let falling = exact((j + 1) as f64) - t;
                let sum = falling * &values[j] + rising * &values[j + 1];
                values[j] = sum / exact(level as f64);
            }
        }
        values[0].clone()
    }

    fn check(polygon: &FloatPolygon, t: f64, differences: &[BigRational]) {
        let found = SegmentExpansion::new(polygon, 0, true).about::<10>(t);
        let mut differences = differences.to_vec();
        let mut factorial = 1.0;
        for (order, coefficient) in found.iter().enumerate() {
            factorial *= order.max(1) as f64;
            if differences.is_empty() {
                assert_eq!(coefficient.x, 0.0);
                continue;
            }
            let expected = de_boor(&exact(t), &differences).to_f64().expect("in range");
            let sizes = differences.iter().filter_map(|d| d.to_f64());
            let size = sizes.fold(0.0_f64, |size, d| size.max(d.abs()));
            let error = (coefficient.x * factorial - expected).abs();
            let degree = polygon.degree();
            assert!(
                error <= ROUNDINGS * size,
                "degree {degree}, order {order}, t {t}"
            );
            differences = differences
                .windows(2)
                .map(|leg| &leg[1] - &leg[0])
                .collect();
        }
    }

    #[test]
    fn every_order_is_accurate_to_its_own_differences() {
        for degree in 1..=25 {
            let height = |j: usize| 7.0 + (0.05 * (j + degree) as f64).sin();
            let points = (0..=degree).map(|j| DVec3::new(height(j), 0.0, 0.0));
            let polygon = FloatPolygon::new(degree, points.collect(), None, false).unwrap();
            let vertices: Vec<_> = (0..=degree).map(|j| exact(height(j))).collect();
            for t in [0.0, 0.1, 0.5, 0.8, 1.0] {
                check(&polygon, t, &vertices);
            }
        }
    }
}
