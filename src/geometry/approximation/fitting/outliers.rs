//! Points that are far from a curve that is not stiff, and stand out from their neighbours.

use glam::DVec3;

use super::point_list::{PointList, median};
use super::smoothing::Smoothing;
use crate::geometry::fitting::FitError;
use crate::geometry::progress::Progress;

/// Points a vertex while searching for outliers: such a curve is not stiff.
const POINTS_A_VERTEX: usize = 8;

/// Searches for outliers: a curve without the known ones shows the others.
const SEARCHES: usize = 8;

/// While outliers are looked for no chord counts for more than so many times those about it, as the long
/// chords to an outlier would leave it a part of the curve of its own.
const CAP: f64 = 2.0;

/// Least distance of an outlier, in standard deviations.
const OUTLYING: f64 = 6.0;

/// Points that are off by less than this share of the mean distance of neighbours are no outliers.
const NEGLIGIBLE: f64 = 1e-3;

/// The standard deviation of normal errors in units of their median.
const BY_MEDIAN: f64 = 1.4826;

/// Let those points no longer count that are far from a curve of a degree that is not stiff, and stand out
/// from their neighbours: what such a curve misses in a row is none.
pub(super) fn leave_out_outliers(
    list: &mut PointList,
    degree: usize,
    progress: &Progress,
) -> Result<(), FitError> {
    let points = list.points.len();
    let least = degree + 1;
    let count = (points / POINTS_A_VERTEX).max(least);
    let negligible = NEGLIGIBLE * list.mean_chord();
    for _ in 0..SEARCHES {
        list.share_chords(CAP);
        let smoothed = Smoothing::new(list, degree, progress).least(count)?;
        let distances: Vec<f64> = smoothed.offsets.iter().map(|it| it.length()).collect();
        let standing_out = standing_out(list, &smoothed.offsets);
        let limits = [&distances, &standing_out]
            .map(|lengths| (OUTLYING * deviation(list, lengths)).max(negligible));
        let is_off = |index: &usize| {
            let index = *index;
            let near = list.neighbours(index).map(|other| distances[other]);
            // The worst pull the curve to them, and their neighbours wait for the next search.
            let is_worst = near.fold(0.0, f64::max) <= distances[index];
            is_worst && distances[index] > limits[0] && standing_out[index] > limits[1]
        };
        let mut counts = vec![true; points];
        for index in (0..points).filter(is_off) {
            counts[index] = false;
        }
        let left = counts.iter().filter(|counts| **counts).count();
        if counts == list.counts || left < least {
            break;
        }
        list.counts = counts;
    }
    list.share_chords(f64::INFINITY);
    Ok(())
}

/// Distance of each point's offset from the median of its counted neighbours' offsets.
fn standing_out(list: &PointList, offsets: &[DVec3]) -> Vec<f64> {
    let stands_out = |index: usize| {
        let near: Vec<DVec3> = list.neighbours(index).map(|it| offsets[it]).collect();
        let middle = [0, 1, 2].map(|axis| median(near.iter().map(|offset| offset[axis])));
        offsets[index].distance(DVec3::from_array(middle))
    };
    (0..offsets.len()).map(stands_out).collect()
}

/// The standard deviation of normal errors, by the median of those that count.
fn deviation(list: &PointList, lengths: &[f64]) -> f64 {
    let kept = lengths.iter().zip(&list.counts);
    let kept = kept.filter_map(|(length, counts)| counts.then_some(*length));
    BY_MEDIAN * median(kept)
}
