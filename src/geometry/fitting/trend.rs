//! Points beside a curve in long runs: noise does not lie so, a shape that the curve lacks does.

use glam::DVec2;

use crate::geometry::float_polygon::FloatPolygon;

/// The serial correlation of normal errors is beyond so many standard deviations, 1/√n, in one of a hundred and sixty.
const DEVIATIONS: f64 = 2.5;

/// Whether the signed distances of points follow each other more than those of independent errors: their serial
/// correlation Σ eᵢ eᵢ₊₁ / Σ eᵢ² is above 2.5/√n (Durbin and Watson, 1950).
///
/// `points` are in their order along the curve, with the parameters where it is nearest to them.
pub(super) fn has_trend(polygon: &FloatPolygon, points: &[(DVec2, f64)]) -> bool {
    let off = |(point, u): &(DVec2, f64)| {
        let jet = polygon.jet(*u);
        let along = jet.first.truncate().normalize_or_zero();
        along.perp_dot(*point - jet.point.truncate())
    };
    let off: Vec<f64> = points.iter().map(off).collect();
    let square: f64 = off.iter().map(|it| it * it).sum();
    let next: f64 = off.iter().zip(off.iter().skip(1)).map(|(a, b)| a * b).sum();
    next * (off.len() as f64).sqrt() > DEVIATIONS * square
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bow_beside_a_line_is_a_trend_and_a_zigzag_is_none() {
        let line = FloatPolygon::planar(1, &[(0.0, 0.0), (40.0, 0.0)]).expect("a polygon");
        let beside = |off: fn(f64) -> f64| -> Vec<(DVec2, f64)> {
            let places = (0..=40).map(f64::from);
            places.map(|x| (DVec2::new(x, off(x)), x / 40.0)).collect()
        };
        assert!(has_trend(&line, &beside(|x| (0.2 * x).sin())));
        assert!(!has_trend(&line, &beside(|x| (2.5 * x).sin())));
        assert!(!has_trend(&line, &beside(|_| 0.0)));
    }
}
