//! What points tell of each other: noise, outliers, corners, and points between them.

use std::collections::BTreeSet;
use std::ops::Range;

use glam::{DVec2, DVec3};

use super::first_places::unwrapped;

/// Neighbours on either side of a point that a cubic goes through.
const BESIDE: usize = 2;

/// The parts of a cubic on which the nearest point is looked for.
const PARTS: usize = 40;

/// How much farther off than its neighbours an outlier is, and its least distance by that of its neighbours.
const OUTLYING: f64 = 5.0;
const LEAST_OUTLYING: f64 = 0.02;

/// The points at either end that are no outliers, and how far two outliers are apart at least.
const END: usize = 3;
const APART: usize = 5;

/// The standard deviation of normal numbers in units of the median of their magnitudes.
const BY_MEDIAN: f64 = 1.4826;

/// How much larger a left out distance is than the noise of a point, on average.
const LEFT_OUT: f64 = 1.25;

/// Points of a ring that are looked at before its first and behind its last one.
const RING_CONTEXT: usize = 4;

/// The least turn of a corner, in radians, and how much sharper it is than its neighbours.
const CORNER: f64 = 0.5;
const SHARPER: f64 = 4.0;

/// The most corners that follow each other, and the least turn of each of them.
const MOST_BESIDE: usize = 3;
const SLAB: f64 = 0.8;

/// Points a corner at least, but for a few corners, and the most corners: more of them are noise, unless they are this
/// share of all sharp turns.
const POINTS_A_CORNER: usize = 20;
const FEW_CORNERS: usize = 8;
const MOST_CORNERS: usize = 200;
const CLEAR: f64 = 0.7;

/// The weight of a point between two points, as a share of theirs.
const LIGHT: f64 = 0.1;

/// The points of which the noise is estimated: of more the median hardly changes.
const ENOUGH: usize = 20_000;

/// Estimate the standard deviation of the points' noise; where points are sparse, an upper bound of it.
pub(super) fn noise(points: &[DVec3]) -> f64 {
    let step = points.len().div_ceil(ENOUGH).max(1);
    let indices = (0..points.len()).step_by(step);
    let distances = indices.filter_map(|index| left_out_distance(points, index, None));
    let mut sorted: Vec<f64> = distances.collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
    BY_MEDIAN * median / LEFT_OUT
}

/// List the isolated points that stand out from a smooth run: their neighbours fit well together without them.
/// None is near an end, and no two are within five points.
pub(super) fn outliers(points: &[DVec3]) -> Vec<usize> {
    let count = points.len();
    let distances = (0..count).map(|index| left_out_distance(points, index, None));
    let distances: Vec<f64> = distances.map(|it| it.unwrap_or(0.0)).collect();
    let around = |index: usize, by: usize| {
        let beside = [index.checked_sub(by), Some(index + by)];
        beside.into_iter().flatten().filter(move |it| *it < count)
    };
    let stands_out = |index: &usize| {
        let own = distances[*index];
        let space = 0.5 * points[index + 1].distance(points[index - 1]);
        let far = (APART..=APART + BESIDE).flat_map(|by| around(*index, by));
        let mut far = far.map(|other| distances[other]);
        own > LEAST_OUTLYING * space && far.all(|far| own > OUTLYING * far)
    };
    // Of the few points that are left the neighbours are measured again.
    let fits_without = |index: &usize| {
        let mut beside = (1..=BESIDE).flat_map(|by| around(*index, by));
        beside.all(|other| {
            let distance = left_out_distance(points, other, Some(*index));
            distance.is_none_or(|distance| distances[*index] > OUTLYING * distance)
        })
    };
    let inner = END..count.saturating_sub(END);
    let mut order: Vec<usize> = inner.filter(stands_out).filter(fits_without).collect();
    order.sort_by(|a, b| distances[*b].total_cmp(&distances[*a]));
    let mut found: BTreeSet<usize> = BTreeSet::new();
    for index in order {
        let near = index.saturating_sub(APART)..=index + APART;
        if found.range(near).next().is_none() {
            found.insert(index);
        }
    }
    found.into_iter().collect()
}

/// List the points where the direction turns sharply, and much more than beside them: inner ones, or with `periodic`
/// all of a ring, which does not repeat its first point. Where they are very many they are noise, and there is none.
pub fn corners(points: &[DVec2], periodic: bool) -> Vec<usize> {
    if !periodic {
        return inner_corners(points);
    }
    let around = RING_CONTEXT.min(points.len());
    let (before, behind) = (&points[points.len() - around..], &points[..around]);
    let corners = inner_corners(&[before, points, behind].concat()).into_iter();
    let own = corners.filter_map(|corner| corner.checked_sub(around));
    own.filter(|corner| *corner < points.len()).collect()
}

fn inner_corners(points: &[DVec2]) -> Vec<usize> {
    let chords: Vec<DVec2> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let directions = unwrapped(&chords);
    let turns: Vec<f64> = directions.windows(2).map(|it| it[1] - it[0]).collect();
    let (mut found, mut next) = (Vec::new(), 0);
    while let Some(first) = (next..turns.len()).find(|turn| turns[*turn].abs() > CORNER) {
        let run = turns[first..].iter().take_while(|turn| turn.abs() > CORNER);
        next = first + run.count();
        let run = &turns[first..next];
        // Corners beside each other, as at the end of a slab, turn by more than a bend that few points follow; at a
        // point that is off the direction comes back.
        let comes_back = run.len() > 2 && run.iter().sum::<f64>().abs() < CORNER;
        let is_slab = run.len() <= MOST_BESIDE
            && !comes_back
            && run.iter().all(|turn| turn.abs() > SLAB)
            && stands_out(&turns, first..next);
        let corners = (first..next).filter(|turn| is_slab || stands_out(&turns, *turn..turn + 1));
        found.extend(corners.map(|turn| turn + 1));
    }
    // Noise turns everywhere: a corner is sharper than the other turns by far.
    let is_found = |turn: &usize| found.binary_search(&(turn + 1)).is_ok();
    let others = (0..turns.len()).filter(|turn| !is_found(turn));
    let mut others: Vec<f64> = others.map(|turn| turns[turn].abs()).collect();
    others.sort_by(f64::total_cmp);
    let quiet = others.get(others.len() / 2).copied().unwrap_or_default();
    found.retain(|corner| turns[corner - 1].abs() > SHARPER * quiet);
    // Of the many sharp turns of noise few are corners.
    let sharp = turns.iter().filter(|turn| turn.abs() > CORNER).count();
    let most = (points.len() / POINTS_A_CORNER + FEW_CORNERS).min(MOST_CORNERS);
    match found.len() > most && (found.len() as f64) < CLEAR * sharp as f64 {
        true => Vec::new(),
        false => found,
    }
}

/// Whether each turn of a run is much sharper than those beside the run.
fn stands_out(turns: &[f64], run: Range<usize>) -> bool {
    let beside = [run.start.checked_sub(1), Some(run.end)];
    let beside = beside.into_iter().flatten();
    let beside = beside.filter_map(|turn| turns.get(turn));
    let most = beside.fold(0.0_f64, |most, turn| most.max(turn.abs()));
    turns[run].iter().all(|turn| turn.abs() > SHARPER * most)
}

/// Put a light point between each two points, on the cubic through two neighbours on each side, so that the curve
/// does not bulge where points are sparse. Returns points with their weights, and which of them are no light ones.
pub(in crate::geometry) fn with_middles(
    points: &[DVec3],
    weights: &[f64],
) -> (Vec<(DVec3, f64)>, Vec<bool>) {
    let count = points.len();
    let mut all: Vec<(DVec3, f64)> = points
        .iter()
        .copied()
        .zip(weights.iter().copied())
        .collect();
    if count < 2 * BESIDE {
        return (all, vec![true; count]);
    }
    let heavy = std::mem::take(&mut all);
    all.push(heavy[0]);
    let mut counts = vec![true];
    for index in 0..count - 1 {
        let first = index.saturating_sub(1).min(count - 2 * BESIDE);
        let near = std::array::from_fn(|other| points[first + other]);
        let cubic = Cubic::new(near, f64::sqrt);
        let at = index - first;
        let middle = 0.5 * (cubic.places[at] + cubic.places[at + 1]);
        let [before, behind] = [heavy[index], heavy[index + 1]];
        let light = LIGHT * 0.5 * (before.1 + behind.1);
        all.extend([(cubic.point(middle), light), behind]);
        counts.extend([false, true]);
    }
    (all, counts)
}

/// The distance of a point from the cubic through two neighbours on each side, `without` another one. `None`
/// near the ends.
fn left_out_distance(points: &[DVec3], index: usize, without: Option<usize>) -> Option<f64> {
    let counts = |other: &usize| Some(*other) != without;
    let mut before = (0..index).rev().filter(counts);
    let mut behind = (index + 1..points.len()).filter(counts);
    let (second, first) = (before.next()?, before.next()?);
    let near = [first, second, behind.next()?, behind.next()?];
    let cubic = Cubic::new(near.map(|other| points[other]), |chord| chord);
    let [begin, end] = [cubic.places[1], cubic.places[2]];
    let step = (end - begin) / PARTS as f64;
    let target = points[index];
    let mut before = cubic.point(begin);
    let distances = (1..=PARTS).map(|part| {
        let here = cubic.point(begin + part as f64 * step);
        let chord = here - before;
        let share = (target - before).dot(chord) / chord.length_squared().max(f64::MIN_POSITIVE);
        let nearest = before + share.clamp(0.0, 1.0) * chord;
        before = here;
        nearest.distance(target)
    });
    Some(distances.fold(f64::INFINITY, f64::min))
}

/// The cubic through four points at given parameters, by divided differences (Newton).
struct Cubic {
    places: [f64; 2 * BESIDE],
    differences: [DVec3; 2 * BESIDE],
}

impl Cubic {
    /// The parameters grow by a measure of the chords.
    fn new(points: [DVec3; 2 * BESIDE], measure: impl Fn(f64) -> f64) -> Self {
        let mut places = [0.0; 2 * BESIDE];
        for (index, chord) in points.windows(2).enumerate() {
            places[index + 1] = places[index] + measure(chord[0].distance(chord[1]));
        }
        let mut differences = points;
        for order in 1..differences.len() {
            for index in (order..differences.len()).rev() {
                let rise = differences[index] - differences[index - 1];
                differences[index] = rise / (places[index] - places[index - order]);
            }
        }
        Self {
            places,
            differences,
        }
    }

    fn point(&self, place: f64) -> DVec3 {
        let [first, inner @ ..] = self.differences;
        let [begin, second, third, _] = self.places;
        let [a, b, c] = inner;
        first + (place - begin) * (a + (place - second) * (b + (place - third) * c))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn arc(count: usize) -> Vec<DVec3> {
        let point = |index: usize| DVec2::from_angle(2.0 * index as f64 / count as f64);
        (0..count).map(|index| point(index).extend(0.0)).collect()
    }

    fn flat(points: &[DVec3]) -> Vec<DVec2> {
        points.iter().map(|point| point.truncate()).collect()
    }

    #[test]
    fn a_point_beside_a_smooth_run_is_an_outlier_and_no_end_is() {
        let mut points = arc(40);
        assert!(outliers(&points).is_empty());
        points[0] += DVec3::new(0.05, 0.0, 0.02);
        points[17] += DVec3::new(0.05, 0.05, 0.0);
        assert_eq!(outliers(&points), [17]);
    }

    #[test]
    fn noise_on_an_arc_has_no_corners() {
        let mut state = 7_u64;
        let mut noise = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let share = (state >> 11) as f64 / (1_u64 << 53) as f64;
            0.02 * (share - 0.5)
        };
        for _ in 0..20 {
            let points: Vec<DVec2> = flat(&arc(80))
                .into_iter()
                .map(|point| point + DVec2::new(noise(), noise()))
                .collect();
            let found = corners(&points, false);
            assert!(found.len() <= 2, "{found:?}");
        }
    }

    #[test]
    fn corners_are_sharp_points_and_not_tight_bends() {
        assert!(corners(&flat(&arc(9)), false).is_empty());
        let mut points = arc(40);
        let legs = (1..20).map(|it| points[39] + 0.05 * it as f64 * DVec3::X);
        let legs: Vec<DVec3> = legs.collect();
        points.extend(legs);
        assert_eq!(corners(&flat(&points), false), [39]);
        // A ring that begins at its corner, or between its points, has the same one.
        let drop = (1..40).map(|it| {
            let angle = TAU * it as f64 / 40.0;
            DVec2::new(angle.sin() * (0.5 * angle).sin(), -(0.5 * angle).sin())
        });
        let mut drop: Vec<DVec2> = std::iter::once(DVec2::ZERO).chain(drop).collect();
        assert_eq!(corners(&drop, true), [0]);
        drop.rotate_left(7);
        assert_eq!(corners(&drop, true), [33]);
    }

    #[test]
    fn corners_beside_each_other_and_many_of_them_are_found() {
        // A comb of slabs: at the foot and at the head of each one two corners that follow each other.
        let slab = |tooth: usize| {
            let x = 12.0 * tooth as f64;
            let along = (0..=5).map(move |it| DVec2::new(x + it as f64, 0.0));
            let up = (1..=5).map(move |it| DVec2::new(x + 5.0, it as f64));
            let down = (0..=4).map(move |it| DVec2::new(x + 6.0, 5.0 - it as f64));
            let back = (0..6).map(move |it| DVec2::new(x + 6.0 + it as f64, 0.0));
            along.chain(up).chain(down).chain(back)
        };
        let points: Vec<DVec2> = (0..12).flat_map(slab).collect();
        let each = [5, 10, 11, 16].into_iter();
        let all: Vec<usize> = (0..12)
            .flat_map(|tooth| each.clone().map(move |corner| 22 * tooth + corner))
            .collect();
        assert_eq!(corners(&points, false), all);
    }

    #[test]
    fn middles_lie_on_the_curve_of_the_points() {
        let mut weights = [1.0; 40];
        weights[20] = 3.0;
        let (points, counts) = with_middles(&arc(40), &weights);
        assert_eq!((points.len(), counts.len()), (79, 79));
        for ((point, _), _) in points.iter().zip(&counts).filter(|(_, counts)| !**counts) {
            assert!((point.length() - 1.0).abs() < 1e-5, "{point}");
        }
        let near: Vec<f64> = points[38..42].iter().map(|(_, weight)| *weight).collect();
        assert_eq!(near, [1.0, 2.0 * LIGHT, 3.0, 2.0 * LIGHT]);
    }
}
