//! Number of vertices that points need.

use super::smoothing::Smoothing;
use crate::geometry::fitting::FitError;

/// The directions across a curve in space.
const AXES: f64 = 2.0;

/// Errors below this share of the points' size are rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// Find the number of vertices that explains the points best for its size (Bayes' information criterion:
/// Schwarz, 1978), of at most so many, or the least that keeps a tolerance; where none does, the one that comes nearest to it.
pub(super) fn best_count(
    smoothing: &Smoothing,
    most: usize,
    tolerance: Option<f64>,
) -> Result<usize, FitError> {
    let (list, degree) = (smoothing.list, smoothing.degree);
    let mut count = degree + 1;
    let mut best = (f64::INFINITY, count);
    loop {
        let [rms, largest] = smoothing.least(count)?.errors;
        if tolerance.is_some_and(|tolerance| largest <= tolerance) {
            return Ok(count);
        }
        // Each point tells its distance across the curve, in two directions.
        let told = AXES * list.counting() as f64;
        let variance = rms.max(ROUNDING * list.size).powi(2);
        let criterion = match tolerance {
            Some(_) => largest,
            None => told * variance.ln() + AXES * count as f64 * told.ln(),
        };
        if criterion < best.0 {
            best = (criterion, count);
        }
        // A good way beyond the best nothing better comes.
        if count >= most || (count > 2 * best.1 + 8 && tolerance.is_none()) {
            return Ok(best.1);
        }
        count = (count + count.div_ceil(6)).min(most);
    }
}
