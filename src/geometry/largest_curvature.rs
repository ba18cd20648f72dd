//! The largest curvature of a part of a curve, found at samples.

use super::float_polygon::FloatPolygon;

/// The samples of a segment, and the steps to the largest curvature beside the best of them, each to two thirds of the
/// way.
const SAMPLES: usize = 32;
const STEPS: usize = 40;

/// Find the largest curvature between two parameters, without its sign: the one near the largest of 32 samples a segment.
///
/// It is no bound. [`Features::largest_curvature`](super::features::Features::largest_curvature) is proved, and takes
/// longer.
pub fn largest_curvature(polygon: &FloatPolygon, [from, to]: [f64; 2]) -> f64 {
    let count = ((to - from).ceil() as usize * SAMPLES).max(SAMPLES);
    let step = (to - from) / count as f64;
    let curvature = |u: f64| polygon.jet(u).curvature();
    let samples = (0..=count).map(|index| from + step * index as f64);
    let samples = samples.map(|u| (u, curvature(u)));
    let best = samples.max_by(|a, b| a.1.total_cmp(&b.1));
    let (best, largest) = best.unwrap_or((from, 0.0));
    let (mut low, mut high) = ((best - step).max(from), (best + step).min(to));
    for _ in 0..STEPS {
        let third = (high - low) / 3.0;
        match curvature(low + third) < curvature(high - third) {
            true => low += third,
            false => high -= third,
        }
    }
    largest.max(curvature(0.5 * (low + high)))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// Of a parabola y = a x² it is 2 a, at the vertex.
    #[test]
    fn the_apex_of_a_parabola_between_two_samples_is_found() {
        const A: f64 = 50.0;
        // The float polygon of one segment from x = −1 to x = 1.03: the blossom of x ↦ (x, a x²).
        let knots = [-1.0, 0.0, 1.0, 2.0].map(|knot| -1.0 + 2.03 * knot);
        let vertices = knots.windows(2).map(|pair| match pair {
            [s, t] => DVec3::new(0.5 * (s + t), A * s * t, 0.0),
            _ => DVec3::ZERO,
        });
        let polygon = FloatPolygon::new(2, vertices.collect(), None, false).expect("a polygon");
        let found = largest_curvature(&polygon, [0.0, 1.0]);
        assert!((found / (2.0 * A) - 1.0).abs() < 1e-12, "{found}");
    }
}
