//! Points as they count in a fit.

use std::collections::BTreeSet;

use glam::DVec3;

use super::neighbours::{noise, outliers};

/// A point nearer than this share of the mean chord to the one before repeats it: files round, and circles close but
/// for rounding.
const REPEATED: f64 = 1e-6;

/// Of more points than the first number about as many as the second are looked at while a fit is searched for.
pub(super) const MANY: usize = 1500;
pub(super) const ENOUGH: usize = 500;

/// Points that count, how much each does, and what is known of the others.
pub struct CountedPoints {
    /// Those that count, without repeated ones.
    pub points: Vec<DVec3>,
    /// The weight of each, 1 on average.
    pub weights: Vec<f64>,
    /// The numbers of those that do not count, from 0 among all.
    pub outliers: Vec<usize>,
    /// The numbers of those that repeat the one before.
    pub repeated: Vec<usize>,
    /// The estimated standard deviation of the noise.
    pub noise: f64,
}

impl CountedPoints {
    /// Tell which points count: all but repeated ones, outliers and those of weight 0.
    ///
    /// `closes`: the last point may repeat the first. `left_out`: the outliers; `None` for isolated points that
    /// stand out. `weights`: one a point; `None` if all count the same.
    pub fn new(
        points: &[DVec3],
        closes: bool,
        left_out: Option<&[usize]>,
        weights: Option<&[f64]>,
    ) -> Self {
        let near = repeating(points);
        let mut repeated: Vec<usize> = (1..points.len())
            .filter(|index| points[*index].distance(points[index - 1]) <= near)
            .collect();
        let last = points.len().saturating_sub(1);
        if closes && is_closed(points) && repeated.last() != Some(&last) {
            repeated.push(last);
        }
        let is_new = |index: &usize| repeated.binary_search(index).is_err();
        let numbers: Vec<usize> = (0..points.len()).filter(is_new).collect();
        let differing: Vec<DVec3> = numbers.iter().map(|number| points[*number]).collect();
        let weight = |number: usize| match weights {
            Some(weights) => weights.get(number).copied().unwrap_or(0.0),
            None => 1.0,
        };
        let mut left_out: Vec<usize> = match left_out {
            None => outliers(&differing)
                .into_iter()
                .map(|it| numbers[it])
                .collect(),
            Some(given) => {
                let given: BTreeSet<&usize> = given.iter().collect();
                let numbers = numbers.iter().filter(|it| given.contains(it));
                numbers.copied().collect()
            }
        };
        left_out.extend(numbers.iter().filter(|number| weight(**number) == 0.0));
        left_out.sort_unstable();
        left_out.dedup();
        let counts = |number: &usize| left_out.binary_search(number).is_err();
        let counting: Vec<usize> = numbers.into_iter().filter(counts).collect();
        let weights: Vec<f64> = counting.iter().map(|number| weight(*number)).collect();
        let mean = weights.iter().sum::<f64>() / weights.len().max(1) as f64;
        Self {
            points: counting.into_iter().map(|number| points[number]).collect(),
            weights: weights.into_iter().map(|weight| weight / mean).collect(),
            outliers: left_out,
            repeated,
            noise: noise(&differing),
        }
    }

    /// The estimated standard deviation of the noise of those that count. Of many points neighbours are nearer to each
    /// other than their noise, which hides it: of them some are looked at.
    pub fn noise_of_counting(&self) -> f64 {
        match self.points.len() > MANY {
            true => noise(&every(&self.points, ENOUGH)),
            false => self.noise,
        }
    }
}

/// The numbers of those that are kept of many.
pub(super) fn kept_of(count: usize, enough: usize) -> Vec<usize> {
    let last = count.saturating_sub(1);
    let step = last.div_ceil(enough).max(1);
    let mut kept: Vec<usize> = (0..last).step_by(step).collect();
    kept.push(last);
    kept
}

/// Keep some of many, evenly, with the first and the last one.
pub(super) fn every<T: Copy>(all: &[T], enough: usize) -> Vec<T> {
    let kept = kept_of(all.len(), enough).into_iter();
    kept.filter_map(|number| all.get(number).copied()).collect()
}

/// Whether the last of some points repeats the first one.
pub fn is_closed(points: &[DVec3]) -> bool {
    match points {
        [first, .., last] => first.distance(*last) <= repeating(points),
        _ => false,
    }
}

/// The distance within which points are one but for rounding.
fn repeating(points: &[DVec3]) -> f64 {
    let length: f64 = points.windows(2).map(|it| it[0].distance(it[1])).sum();
    REPEATED * length / points.len().saturating_sub(1).max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_points_outliers_and_those_without_weight_do_not_count() {
        let points: Vec<DVec3> = [0.0, 1.0, 1.0, 2.0, 3.0, 4.0, 0.0]
            .iter()
            .map(|x| DVec3::X * *x)
            .collect();
        let weights = [2.0, 4.0, 9.0, 0.0, 6.0, 4.0, 1.0];
        let found = CountedPoints::new(&points, true, Some(&[0]), Some(&weights));
        assert_eq!(
            (&found.repeated[..], &found.outliers[..]),
            (&[2, 6][..], &[0, 3][..])
        );
        // Rounding does not make another point.
        let mut rounded = points.clone();
        rounded[2].y = 1e-12;
        rounded[6].x = -1e-12;
        let again = CountedPoints::new(&rounded, true, Some(&[0]), Some(&weights));
        assert_eq!(again.repeated, [2, 6]);
        let places: Vec<f64> = found.points.iter().map(|point| point.x).collect();
        assert_eq!(places, [1.0, 3.0, 4.0]);
        assert_eq!(found.weights.iter().sum::<f64>(), 3.0);
        assert_eq!(found.weights[1], 1.5 * found.weights[0]);
    }
}
