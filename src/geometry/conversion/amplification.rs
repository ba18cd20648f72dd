//! How much an error in one vertex grows on the way to another polygon.

use super::bezier_matrix::{blossom_row, float_to_bezier, middle_segment};
use super::exact_polygon::vertex_knots;
use super::knots::{clamp, unclamp};
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::check_degree;
use crate::geometry::polygon_kind::PolygonKind;

/// Say how much errors in the vertices grow in a conversion. For a rational curve it holds for
/// the homogeneous vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amplification {
    /// How much an error in one vertex can grow in another: the largest |∂output_i/∂input_j|.
    pub largest: f64,
    /// How much errors in all vertices can grow together: the largest Σ_j |∂output_i/∂input_j|.
    pub norm: f64,
}

impl Amplification {
    /// Compute the amplification of the conversion between two polygons of an open curve of
    /// degree n with L segments, to some 14 digits.
    ///
    /// To the clamped and the Bézier polygon it is at most 1: they interpolate. From them to the
    /// float polygon the norm is (2n − 1)!! for one segment (34 459 425 for degree 9) and, of the
    /// clamped polygon, 1.8e6 for degree 9 once N ≥ 2n. It depends on the segments only as long
    /// as N < 2n, and takes of the order of n³ operations.
    ///
    /// # Errors
    /// [`PolygonError::DegreeOutOfRange`], and [`PolygonError::TooFewVertices`] without a
    /// segment.
    pub fn of(
        from: PolygonKind,
        to: PolygonKind,
        degree: usize,
        segments: usize,
    ) -> Result<Self, PolygonError> {
        use PolygonKind::{Bezier, Clamped, Float};
        check_degree(degree)?;
        if segments == 0 {
            return Err(PolygonError::TooFewVertices {
                found: degree,
                needed: degree + 1,
                degree,
                periodic: false,
            });
        }
        Ok(match (from, to) {
            (Float, Clamped) => Self::of_columns(degree, segments, clamp),
            (Float, Bezier) => {
                let matrix = float_to_bezier::<2>(degree);
                let rows = matrix.chunks(degree + 1);
                Self::of_rows(rows.map(|row| row.iter().map(|entry| entry.value())))
            }
            (Clamped, Float) => Self::of_unclamping(degree, segments),
            (Bezier, Float | Clamped) => Self::of_blossoms(to, degree, segments),
            // Inserting knots keeps the end vertices and interpolates between the others.
            (Clamped, Bezier) | (Float, Float) | (Clamped, Clamped) | (Bezier, Bezier) => Self {
                largest: 1.0,
                norm: 1.0,
            },
        })
    }

    /// The amplification from the clamped to the float polygon, of a valid degree.
    pub(in crate::geometry) fn of_unclamping(degree: usize, segments: usize) -> Self {
        Self::of_columns(degree, segments, unclamp)
    }

    /// Convert unit vectors. The vertices between the first n and the last n do not change and
    /// change nothing, so they are left out.
    fn of_columns(degree: usize, segments: usize, convert: fn(usize, &mut [f64])) -> Self {
        let count = (segments + degree).min(2 * degree);
        let mut sums = vec![0.0; count];
        let mut largest = 0.0_f64;
        let mut unit = vec![0.0; count];
        for column in 0..count {
            unit.fill(0.0);
            unit[column] = 1.0;
            convert(degree, &mut unit);
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

    fn of_blossoms(to: PolygonKind, degree: usize, segments: usize) -> Self {
        // Beyond 2n segments the vertices in the middle only repeat.
        let segments = segments.min(2 * degree);
        let rows = (0..segments + degree).map(|index| {
            let segment = middle_segment(degree, segments, index) as i64;
            let knots = vertex_knots(to, degree, segments, index);
            let row = blossom_row(knots.map(move |knot| knot - segment));
            row.into_iter().map(|entry| entry as f64)
        });
        Self::of_rows(rows)
    }

    fn of_rows(rows: impl Iterator<Item = impl Iterator<Item = f64>>) -> Self {
        let none = Self {
            largest: 0.0,
            norm: 0.0,
        };
        rows.fold(none, |worst, row| {
            let (largest, sum) = row.fold((0.0_f64, 0.0), |(largest, sum), entry| {
                (largest.max(entry.abs()), sum + entry.abs())
            });
            Self {
                largest: worst.largest.max(largest),
                norm: worst.norm.max(sum),
            }
        })
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
    use PolygonKind::{Bezier, Clamped, Float};

    /// What the sums of the entries' magnitudes may lose in double arithmetic.
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
            let expected = double_factorial(degree);
            for from in [Clamped, Bezier] {
                let found = Amplification::of(from, Float, degree, 1).unwrap();
                assert_near(found.norm, expected);
            }
        }
    }

    #[test]
    fn clamped_ends_have_the_known_norms() {
        // Exact values of degrees 3 and 5.
        for (degree, norm) in [(3, 13.0), (5, 1273.0 / 3.0)] {
            for segments in [degree, 10 * degree] {
                let found = Amplification::of(Clamped, Float, degree, segments).unwrap();
                assert_near(found.norm, norm);
            }
        }
    }

    #[test]
    fn interpolation_never_amplifies() {
        for degree in 1..=25 {
            for segments in [1, 2, degree, 3 * degree] {
                for (from, to) in [(Float, Clamped), (Float, Bezier), (Clamped, Bezier)] {
                    let found = Amplification::of(from, to, degree, segments).unwrap();
                    assert_near(found.norm, 1.0);
                    assert!(found.largest <= 1.0 + ROUNDINGS);
                }
            }
        }
        assert!(Amplification::of(Clamped, Float, 26, 1).is_err());
        assert!(Amplification::of(Clamped, Float, 3, 0).is_err());
    }
}
