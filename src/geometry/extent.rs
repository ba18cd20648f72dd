//! How far a curve reaches along a direction.

use glam::DVec3;

use super::parametric_curve::ParametricCurve;
use super::root::root;

/// The samples of all pieces together, and the least and the most of one piece. Between two samples a curve that turns
/// back and forth again is passed over.
const SAMPLES: usize = 4096;
const PER_PIECE: [usize; 2] = [4, 128];

/// Find the least and the greatest component d·C of a curve along a direction d, at the ends of its pieces and where
/// d·C′ changes its sign.
///
/// Signs are compared at 4 to 128 places of each piece.
pub fn extent(curve: &impl ParametricCurve, direction: DVec3) -> [f64; 2] {
    let [least, most] = PER_PIECE;
    let samples = (SAMPLES / curve.pieces()).clamp(least, most);
    let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
    for piece in 0..curve.pieces() {
        let fill = |t: f64| {
            let mut values = [DVec3::ZERO; 2];
            curve.fill_derivatives(piece, t, &mut values);
            values.map(|value| direction.dot(value))
        };
        let mut add = |t: f64| {
            let [component, slope] = fill(t);
            extent = [extent[0].min(component), extent[1].max(component)];
            slope
        };
        let mut before = (0.0, add(0.0));
        for sample in 1..=samples {
            let t = sample as f64 / samples as f64;
            let now = (t, add(t));
            if before.1 * now.1 < 0.0 {
                add(root([before.0, t], 0.0, |t| fill(t)[1]));
            }
            before = now;
        }
    }
    extent
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    #[test]
    fn a_polygon_of_one_parabola_reaches_to_its_apex() {
        // The float polygon of y = x² from x = −1 to x = 3: the blossom of x ↦ (x, x²).
        let knots = [-1.0, 0.0, 1.0, 2.0].map(|knot| -1.0 + 4.0 * knot);
        let vertices = knots.windows(2).map(|pair| match pair {
            [s, t] => DVec3::new(0.5 * (s + t), s * t, 0.0),
            _ => DVec3::ZERO,
        });
        let polygon = FloatPolygon::new(2, vertices.collect(), None, false).expect("a polygon");
        let [low, high] = extent(&polygon, DVec3::Y);
        assert!(
            low.abs() <= 1e-15 && (high - 9.0).abs() <= 1e-14,
            "{low} {high}"
        );
        // Along (1, 1): x + x² is least at x = −1/2.
        let [low, high] = extent(&polygon, DVec3::new(1.0, 1.0, 0.0));
        assert!(
            (low + 0.25).abs() <= 1e-14 && (high - 12.0).abs() <= 1e-14,
            "{low} {high}"
        );
    }

    #[test]
    fn periodic_curves_reach_as_far_as_dense_points() {
        let vertices = (0..12).map(|index| {
            let angle = std::f64::consts::TAU * f64::from(index) / 12.0;
            let radius = 2.0 + f64::from(index % 3);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
        });
        let polygon = FloatPolygon::new(5, vertices.collect(), None, true).expect("a polygon");
        for direction in [DVec3::X, DVec3::Y, DVec3::new(0.6, -0.8, 0.0)] {
            let found = extent(&polygon, direction);
            let points =
                (0..=12_000).map(|step| direction.dot(polygon.point(f64::from(step) / 1000.0)));
            let dense = points.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], it| {
                [low.min(it), high.max(it)]
            });
            assert!(found[0] <= dense[0] && dense[1] <= found[1]);
            assert!(dense[0] - found[0] <= 1e-6 && found[1] - dense[1] <= 1e-6);
        }
    }
}
