//! Best division of a sequence into runs that rise and fall by turns.

use std::ops::Range;

/// The sequence is thinned out to about so many numbers, and to so many a run where there are many runs.
const ENOUGH: usize = 300;
const ENOUGH_A_RUN: usize = 4;

/// A division of a sequence into runs that rise and fall by turns.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::geometry) struct Runs {
    /// Whether the first run rises.
    pub(in crate::geometry) begins_rising: bool,
    /// The first number of each later run.
    pub(in crate::geometry) turns: Vec<usize>,
    /// The weighed sum of the squares by which the sequence misses the nearest one that rises and falls so.
    missed: f64,
}

impl Runs {
    /// Whether the run of a number rises.
    pub(in crate::geometry) fn rises(&self, index: usize) -> bool {
        let run = self.turns.partition_point(|turn| *turn <= index);
        self.begins_rising == run.is_multiple_of(2)
    }

    /// The stretches on which the nearest sequence that rises and falls so stays level though this one does not.
    pub(super) fn level_stretches(&self, values: &[f64], weights: &[f64]) -> Vec<Range<usize>> {
        let bounds = [&[0], &self.turns[..], &[values.len()]].concat();
        let mut level = Vec::new();
        for bounds in bounds.windows(2).filter(|bounds| bounds[0] < bounds[1]) {
            let sign = if self.rises(bounds[0]) { 1.0 } else { -1.0 };
            let run = (bounds[0]..bounds[1]).map(|it| (sign * values[it], weights[it]));
            let mut pools = Pools::default();
            run.for_each(|(value, weight)| pools.push(value, weight));
            let mut from = bounds[0];
            for pool in pools.pools {
                let to = from + pool.members;
                level.extend((pool.members > 1).then_some(from..to));
                from = to;
            }
        }
        level
    }
}

/// Find the two best divisions into runs that rise and fall by turns, with so many turns between
/// them: the one that begins rising and the one that begins falling, the better one first.
///
/// What the nearest monotone sequence of a run misses is found by pooling neighbours that are out of
/// order (Ayer and others, 1955), the best ends of runs by dynamic programming.
pub(in crate::geometry) fn best_runs(values: &[f64], weights: &[f64], turns: usize) -> [Runs; 2] {
    let enough = ENOUGH.max(ENOUGH_A_RUN * (turns + 1));
    let step = values.len().div_ceil(enough).max(1);
    let weighed = values.iter().copied().zip(weights.iter().copied());
    let thinned: Vec<(f64, f64)> = weighed.step_by(step).collect();
    let missed = [true, false].map(|rises| missed_by_runs(&thinned, rises));
    let mut found = [true, false].map(|begins_rising| {
        let (ends, missed) = best_ends(&missed, thinned.len(), turns, begins_rising);
        Runs {
            begins_rising,
            turns: ends.into_iter().map(|end| end * step).collect(),
            missed,
        }
    });
    found.sort_by(|a, b| a.missed.total_cmp(&b.missed));
    found
}

/// For every first number of a run, and every number of its members, what the nearest rising (or
/// falling) sequence misses.
fn missed_by_runs(values: &[(f64, f64)], rises: bool) -> Vec<Vec<f64>> {
    let sign = if rises { 1.0 } else { -1.0 };
    let from = |first: usize| {
        let mut pools = Pools::default();
        let grown = values[first..].iter().map(|(value, weight)| {
            pools.push(sign * value, *weight);
            pools.missed
        });
        grown.collect()
    };
    (0..values.len()).map(from).collect()
}

/// The nearest rising sequence to one that grows number by number.
#[derive(Default)]
struct Pools {
    pools: Vec<Pool>,
    /// The weighed sum of the squares by which it misses the sequence.
    missed: f64,
}

/// Neighbours that share a number.
#[derive(Clone, Copy)]
struct Pool {
    members: usize,
    /// Their weight, weighed sum and weighed sum of squares.
    sums: [f64; 3],
}

impl Pool {
    fn missed(&self) -> f64 {
        let [weight, sum, squares] = self.sums;
        (squares - sum * sum / weight).max(0.0)
    }
}

impl Pools {
    fn push(&mut self, value: f64, weight: f64) {
        let mut last = Pool {
            members: 1,
            sums: [weight, weight * value, weight * value * value],
        };
        while let Some(before) = self.pools.last().copied() {
            if before.sums[1] * last.sums[0] < last.sums[1] * before.sums[0] {
                break;
            }
            self.pools.pop();
            self.missed -= before.missed();
            last.members += before.members;
            for (sum, part) in last.sums.iter_mut().zip(before.sums) {
                *sum += part;
            }
        }
        // What a pool of several misses stands in the sum; one alone misses nothing.
        self.missed = (self.missed + last.missed()).max(0.0);
        self.pools.push(last);
    }
}

/// The ends of the first runs, the next one's first number each, and what all runs miss together.
fn best_ends(
    missed: &[Vec<Vec<f64>>; 2],
    count: usize,
    turns: usize,
    begins_rising: bool,
) -> (Vec<usize>, f64) {
    let run = |number: usize, first: usize, end: usize| {
        let rises = begins_rising == number.is_multiple_of(2);
        missed[usize::from(!rises)][first]
            .get((end - first).wrapping_sub(1))
            .copied()
            .unwrap_or_default()
    };
    // What the runs up to each end miss, and where the last of them begins.
    let mut best: Vec<f64> = (0..=count).map(|end| run(0, 0, end)).collect();
    let mut begins: Vec<Vec<usize>> = Vec::new();
    for number in 1..=turns {
        let last = |end: usize| {
            let splits = (number..end).map(|first| (first, best[first] + run(number, first, end)));
            let least = splits.min_by(|a, b| a.1.total_cmp(&b.1));
            least.unwrap_or((end, f64::INFINITY))
        };
        let found: Vec<(usize, f64)> = (0..=count).map(last).collect();
        best = found.iter().map(|(_, missed)| *missed).collect();
        begins.push(found.iter().map(|(first, _)| *first).collect());
    }
    let mut ends = Vec::new();
    let mut end = count;
    for begins in begins.iter().rev() {
        end = begins[end];
        ends.push(end);
    }
    ends.reverse();
    (ends, best[count])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_end_at_the_largest_turns() {
        // A ripple of 0.2 on a way up to 5 and down again.
        let values = [0.0, 1.0, 0.8, 2.0, 3.0, 5.0, 4.0, 3.0, 3.2, 1.0, 0.0];
        let even = [1.0; 11];
        let [up, down] = best_runs(&values, &even, 1);
        assert!(up.begins_rising && (5..=6).contains(&up.turns[0]), "{up:?}");
        // Each ripple pools two numbers that are 0.2 apart.
        assert!((up.missed - 2.0 * 2.0 * 0.1 * 0.1).abs() < 1e-12, "{up:?}");
        assert_eq!(up.level_stretches(&values, &even), [1..3, 7..9]);
        assert!(!down.begins_rising && down.missed > up.missed);
        let [all, _] = best_runs(&values, &even, 5);
        assert!(all.missed < 1e-12, "{all:?}");
    }

    #[test]
    fn without_turns_all_rises_or_all_falls() {
        let values = [3.0, 2.0, 2.5, 1.0];
        let [falls, rises] = best_runs(&values, &[1.0; 4], 0);
        assert!((0..4).all(|index| !falls.rises(index)));
        assert!((0..4).all(|index| rises.rises(index)));
        assert!(
            (falls.missed - 2.0 * 0.25 * 0.25).abs() < 1e-12,
            "{falls:?}"
        );
    }
}
