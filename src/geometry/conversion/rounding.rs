//! Coordinates rounded to a number of decimal digits.

use glam::DVec3;

use super::clamped_polygon::ClampedPolygon;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::vector;

/// The most digits that a double has after the decimal point.
const DIGITS: usize = 1074;

/// Polygon with rounded coordinates, and the effect of rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounded<P> {
    /// The polygon; its weights are those of the polygon given.
    pub polygon: P,
    /// The largest distance that a vertex moved.
    pub moved: f64,
    /// A bound of the largest distance that a point of the curve moved, at most 0.1 % above it.
    /// It is never larger than `moved`, but for rounding.
    pub deviation: f64,
}

impl FloatPolygon {
    /// Round every coordinate to `digits` digits behind the decimal point, halves to even.
    ///
    /// # Errors
    /// [`PolygonError::BadCoordinate`] if a coordinate at the very end of the range of numbers
    /// leaves it.
    pub fn rounded(&self, digits: usize) -> Result<Rounded<Self>, PolygonError> {
        let vertices = rounded(self.vertices(), digits);
        let moved = moved(self.vertices(), &vertices);
        let weights = self.weights().map(<[f64]>::to_vec);
        let polygon = Self::new(self.degree(), vertices, weights, self.is_periodic())?;
        Ok(Rounded {
            deviation: self.deviation(&polygon)?,
            moved,
            polygon,
        })
    }
}

impl ClampedPolygon {
    /// Round every coordinate to so many digits behind the decimal point, halves to even. The
    /// float polygon of the curve moves by up to [`ClampedPolygon::amplification`] times as much
    /// as the vertices do, the curve by no more than they.
    ///
    /// # Errors
    /// As [`FloatPolygon::rounded`], and [`PolygonError::WeightLost`] if the weights differ by
    /// more than the bound's arithmetic can tell: by 1e14 for one segment of degree 25.
    pub fn rounded(&self, digits: usize) -> Result<Rounded<Self>, PolygonError> {
        let vertices = rounded(self.vertices(), digits);
        let moved = moved(self.vertices(), &vertices);
        let weights = self.weights().map(<[f64]>::to_vec);
        let polygon = Self::new(self.degree(), vertices, weights)?;
        Ok(Rounded {
            deviation: self.deviation(&polygon)?,
            moved,
            polygon,
        })
    }
}

fn rounded(vertices: &[DVec3], digits: usize) -> Vec<DVec3> {
    let round =
        |vertex: &DVec3| DVec3::from(vertex.to_array().map(|value| rounded_off(value, digits)));
    vertices.iter().map(round).collect()
}

/// Round a number as it is written with `digits` digits: the decimal nearest to the exact double,
/// then the double nearest to that.
pub(in crate::geometry) fn rounded_off(value: f64, digits: usize) -> f64 {
    let written = format!("{value:.digits$}", digits = digits.min(DIGITS));
    written.parse().unwrap_or(value)
}

/// Leave out the digits of a number that are too many: the decimal next to the exact double on the
/// side of zero, then the double nearest to that.
pub(in crate::geometry) fn cut_off(value: f64, digits: usize) -> f64 {
    let written = format!("{value:.DIGITS$}");
    let kept = written.len() - DIGITS + digits.min(DIGITS);
    written[..kept].parse().unwrap_or(value)
}

fn moved(before: &[DVec3], after: &[DVec3]) -> f64 {
    let pairs = before.iter().zip(after);
    pairs
        .map(|(a, b)| vector::length(*b - *a))
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::{cut_off, rounded_off};

    #[test]
    fn decimals_are_the_nearest_to_the_exact_double() {
        let cases = [
            (2.675, 2, 2.67),
            (0.125, 2, 0.12),
            (-1.807_42, 3, -1.807),
            (1e100, 3, 1e100),
        ];
        for (value, digits, expected) in cases {
            assert_eq!(rounded_off(value, digits), expected);
        }
        assert_eq!(cut_off(8.748_581_800_695_854, 3), 8.748);
        assert_eq!(cut_off(-1.807_034_341_227_822_7, 3), -1.807);
        assert_eq!(cut_off(-1.9, 0), -1.0);
        for value in [0.1, 1.0 / 3.0, 5e-324, -1e-300] {
            assert_eq!(rounded_off(value, 2000), value);
            assert_eq!(cut_off(value, 2000), value);
        }
    }
}
