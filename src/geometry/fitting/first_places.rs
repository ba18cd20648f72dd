//! First parameters of points: a mix of chord lengths and turning angles.

use glam::DVec2;

/// How often directions, and densities, are smoothed.
const DIRECTION_ROUNDS: usize = 3;
const DENSITY_ROUNDS: usize = 4;

/// The least density.
const LEAST: f64 = 1e-6;

/// The share of the parameters up to each point of an open curve, from 0 to 1.
///
/// The parameter grows as the chord times a density, (1 − b) + b (share of the turn) / (share of the length),
/// so that sharp parts get more vertices; `bend` is b.
pub(super) fn open_shares(points: &[DVec2], bend: f64) -> Vec<f64> {
    let sums = sums(points, bend);
    let all = sums
        .last()
        .copied()
        .unwrap_or_default()
        .max(f64::MIN_POSITIVE);
    sums.into_iter().map(|sum| sum / all).collect()
}

/// The same of a closed curve, whose last point is followed by the first one again.
pub(super) fn closed_shares(points: &[DVec2], bend: f64) -> Vec<f64> {
    let count = points.len();
    // Three rounds, of which the middle one knows no ends.
    let rounds: Vec<DVec2> = points.iter().cycle().take(3 * count + 1).copied().collect();
    let sums = sums(&rounds, bend);
    let (begin, end) = (sums[count], sums[2 * count]);
    let shares = sums[count..2 * count].iter();
    shares.map(|sum| (sum - begin) / (end - begin)).collect()
}

fn sums(points: &[DVec2], bend: f64) -> Vec<f64> {
    let chords: Vec<DVec2> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let lengths: Vec<f64> = chords.iter().map(|chord| chord.length()).collect();
    let length: f64 = lengths.iter().sum();
    let mut directions = unwrapped(&chords);
    for _ in 0..DIRECTION_ROUNDS {
        let before = directions.clone();
        for index in 1..directions.len().saturating_sub(1) {
            let near = [index - 1, index, index + 1];
            let weights = near.map(|it| lengths[it] * if it == index { 2.0 } else { 1.0 });
            let sum: f64 = near
                .iter()
                .zip(weights)
                .map(|(it, weight)| weight * before[*it])
                .sum();
            directions[index] = sum / weights.iter().sum::<f64>();
        }
    }
    let mut turns = vec![0.0; lengths.len()];
    for (index, pair) in directions.windows(2).enumerate() {
        let half = 0.5 * (pair[1] - pair[0]).abs();
        turns[index] += half;
        turns[index + 1] += half;
    }
    let turn = turns.iter().sum::<f64>().max(1e-9);
    let density = |(part, chord): (&f64, &f64)| {
        let relative = (part / turn) / (chord / length).max(1e-12);
        ((1.0 - bend) + bend * relative).max(LEAST).ln()
    };
    let mut densities: Vec<f64> = turns.iter().zip(&lengths).map(density).collect();
    for _ in 0..DENSITY_ROUNDS {
        let before = densities.clone();
        for index in 1..densities.len().saturating_sub(1) {
            let beside = before[index - 1] + before[index + 1];
            densities[index] = 0.25 * beside + 0.5 * before[index];
        }
    }
    let mut sum = 0.0;
    let steps = densities.iter().zip(&lengths);
    let sums = steps.map(|(density, chord)| {
        sum += density.exp() * chord;
        sum
    });
    std::iter::once(0.0)
        .chain(sums.collect::<Vec<f64>>())
        .collect()
}

/// The angles of chords, each within half a turn of the one before.
pub(super) fn unwrapped(chords: &[DVec2]) -> Vec<f64> {
    let mut angle = chords.first().map_or(0.0, |chord| chord.to_angle());
    let mut before = chords.first().copied().unwrap_or(DVec2::X);
    let turned = chords.iter().map(|chord| {
        angle += before.angle_to(*chord);
        before = *chord;
        angle
    });
    turned.collect()
}
