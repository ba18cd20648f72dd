//! Growth of vertex errors in a conversion.

use super::knots::unclamp;

/// Say how much errors in the vertices grow in a conversion. For a rational curve it holds for
/// the homogeneous vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amplification {
    /// Largest growth of an error of one vertex in another: the largest |∂output_i/∂input_j|.
    pub largest: f64,
    /// Largest growth of errors of all vertices together: the largest Σ_j |∂output_i/∂input_j|.
    pub norm: f64,
}

impl Amplification {
    /// Compute the amplification from the clamped to the float polygon of an open curve of a valid
    /// degree n with at least one segment, to some 14 digits.
    ///
    /// The norm is (2n − 1)!! for one segment (34 459 425 for degree 9), and 1.8e6 for degree 9 once
    /// N ≥ 2n. It depends on the segments only as long as N < 2n, and takes of the order of n³
    /// operations. The vertices between the first n and the last n do not change and change nothing,
    /// so they are left out; the others are converted one by one.
    pub fn of_unclamping(degree: usize, segments: usize) -> Self {
        let count = (segments + degree).min(2 * degree);
        let mut sums = vec![0.0; count];
        let mut largest = 0.0_f64;
        let mut unit = vec![0.0; count];
        for column in 0..count {
            unit.fill(0.0);
            unit[column] = 1.0;
            unclamp(degree, &mut unit);
            for (sum, entry) in sums.iter_mut().zip(&unit) {
                *sum += entry.abs();
                largest = largest.max(entry.abs());
            }
        }
        Self {
            largest,
            norm: sums.into_iter().fold(0.0, f64::max),
        }
    }
}

/// Compute (2n − 1)!!: the norm of the conversion of one segment to the float polygon, and a bound
/// of that of more.
pub(in crate::geometry) fn double_factorial(degree: usize) -> f64 {
    (1..=degree).map(|k| (2 * k - 1) as f64).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding error of the sums of the entries' magnitudes.
    const ROUNDINGS: f64 = 1e-13;

    #[track_caller]
    fn assert_near(found: f64, expected: f64) {
        assert!(
            (found / expected - 1.0).abs() <= ROUNDINGS,
            "{found} {expected}"
        );
    }

    #[test]
    fn one_segment_has_a_double_factorial() {
        for degree in 1..=25 {
            let found = Amplification::of_unclamping(degree, 1);
            assert_near(found.norm, double_factorial(degree));
        }
    }

    #[test]
    fn clamped_ends_have_the_known_norms() {
        // Exact values of degrees 3 and 5.
        for (degree, norm) in [(3, 13.0), (5, 1273.0 / 3.0)] {
            for segments in [degree, 10 * degree] {
                assert_near(Amplification::of_unclamping(degree, segments).norm, norm);
            }
        }
    }
}
