//! An estimate of how many curvature extrema a tolerance takes.

use std::ops::Range;

use glam::DVec2;

use super::monotone_runs::best_runs;
use super::problem::{Evenly, Problem};

/// Estimate the fewest extrema, of so many at most, with which a curve within a tolerance of this one gets by.
///
/// Where the curvature misses the nearest one that rises and falls so often by Δκ, the curve moves by about δ with
/// δ″ = Δκ along it. Of each stretch on which that one stays level, half the height of δ over its chord counts.
pub(super) fn estimated_extrema(
    problem: &Problem,
    vertices: &[DVec2],
    most: usize,
    tolerance: f64,
) -> usize {
    let samples = problem.sampled(vertices);
    let weights = samples.weights();
    let keeps = |extrema: usize| {
        let [runs, _] = best_runs(&samples.curvatures, &weights, extrema);
        let pools = runs.level_stretches(&samples.curvatures, &weights);
        pools
            .into_iter()
            .all(|pool| moved(&samples, pool) <= tolerance)
    };
    let (mut low, mut high) = (0, most);
    while low < high {
        let middle = low + (high - low) / 2;
        match keeps(middle) {
            true => high = middle,
            false => low = middle + 1,
        }
    }
    low
}

/// How far the curve moves where the curvature of a stretch becomes its mean.
fn moved(samples: &Evenly, stretch: Range<usize>) -> f64 {
    let curvatures = &samples.curvatures[stretch.clone()];
    let steps = &samples.steps[stretch];
    let length: f64 = steps.iter().sum();
    let turned: f64 = curvatures.iter().zip(steps).map(|(k, step)| k * step).sum();
    let mean = turned / length.max(f64::MIN_POSITIVE);
    let (mut along, mut slope, mut offset) = (0.0, 0.0, 0.0);
    let mut path = vec![(0.0, 0.0)];
    for (curvature, step) in curvatures.iter().zip(steps) {
        let bend = curvature - mean;
        offset += step * (slope + 0.5 * step * bend);
        slope += step * bend;
        along += step;
        path.push((along, offset));
    }
    let chord = offset / length.max(f64::MIN_POSITIVE);
    let heights = path.iter().map(|(along, offset)| offset - chord * along);
    let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), it| {
        (low.min(it), high.max(it))
    });
    0.5 * (high - low)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn a_wave_of_the_curvature_moves_the_curve_by_its_second_integral() {
        // κ = a sin(2πs/L) moves the curve by a (L/2π)² sin(2πs/L).
        let (amplitude, length, count) = (0.3, 5.0, 2000);
        let step = length / count as f64;
        let wave = |index: usize| amplitude * (TAU * (index as f64 + 0.5) / count as f64).sin();
        let samples = Evenly {
            places: (0..count).map(|index| index as f64).collect(),
            curvatures: (0..count).map(|index| 0.7 + wave(index)).collect(),
            steps: vec![step; count],
        };
        let expected = amplitude * (length / TAU).powi(2);
        let found = moved(&samples, 0..count);
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
    }
}
