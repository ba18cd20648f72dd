//! Uniform subdivision: the same curve by twice as many segments.

use super::exact_vertices::{ExactVertices, converted_float};
use crate::geometry::error::PolygonError;
use crate::geometry::expansion::Expansion;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::tables::binomials;

impl FloatPolygon {
    /// Halve every segment: the same curve by 2L segments, its parameter running twice as fast
    /// (Lane and Riesenfeld, 1980).
    ///
    /// New vertex i is 2⁻ⁿ Σ_j C(n + 1, i + n − 2j) P_j, a mean with positive weights; sums are
    /// taken in double-double arithmetic, so each number is the exact one rounded. A periodic
    /// curve stays periodic.
    ///
    /// # Errors
    /// [`PolygonError::Overflow`] if rounding takes a weight out of the range of numbers.
    pub fn subdivided(&self) -> Result<Self, PolygonError> {
        let (degree, segments) = (self.degree(), self.segments());
        let count = 2 * segments + if self.is_periodic() { 0 } else { degree };
        let mask = mask(degree);
        let given = ExactVertices::<2>::of(&self.unrolled());
        let vertices = given.map(|axis| {
            (0..count)
                .map(|index| refined(&mask, degree, axis, index))
                .collect()
        });
        converted_float(degree, vertices.all_rounded(), self.is_periodic())
    }
}

/// The binomial coefficients of n + 1, divided by 2ⁿ: all exact.
fn mask(degree: usize) -> Vec<f64> {
    let scale = 0.5_f64.powi(degree as i32);
    let row = binomials(degree + 1).iter();
    row.map(|binomial| binomial.value() * scale).collect()
}

fn refined(mask: &[f64], degree: usize, axis: &[Expansion<2>], index: usize) -> Expansion<2> {
    let highest = index + degree;
    let terms = (highest % 2..mask.len())
        .step_by(2)
        .filter(|k| *k <= highest);
    terms.fold(Expansion::default(), |sum, k| {
        match axis.get((highest - k) / 2) {
            Some(vertex) => sum + *vertex * mask[k],
            None => sum,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::mask;

    #[test]
    fn the_mask_is_exact_for_every_degree() {
        for degree in 1..=25 {
            let mask = mask(degree);
            let scale = 2.0_f64.powi(degree as i32);
            assert_eq!(mask.iter().sum::<f64>(), 2.0, "degree {degree}");
            assert!(mask.iter().all(|entry| (entry * scale).fract() == 0.0));
        }
    }
}
