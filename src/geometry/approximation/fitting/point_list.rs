//! Points that follow each other along a curve, and which of them count.

use glam::DVec3;

use crate::geometry::vector;

/// Neighbours on either side that a point is compared with.
const NEIGHBOURS: usize = 3;

/// The points of a fit.
pub(super) struct PointList<'a> {
    pub(super) points: &'a [DVec3],
    /// Whether each point counts.
    pub(super) counts: Vec<bool>,
    /// The share of the chord length up to each point.
    pub(super) shares: Vec<f64>,
    /// Whether all lie in the plane z = 0.
    pub(super) planar: bool,
    /// The diagonal of their box.
    pub(super) size: f64,
}

impl<'a> PointList<'a> {
    /// Take points, all of which count.
    pub(super) fn new(points: &'a [DVec3]) -> Self {
        let (low, high) = vector::bounds(points);
        let mut list = Self {
            points,
            counts: vec![true; points.len()],
            shares: Vec::new(),
            planar: points.iter().all(|point| point.z == 0.0),
            size: low.distance(high),
        };
        list.share_chords(f64::INFINITY);
        list
    }

    /// The number of points that count.
    pub(super) fn counting(&self) -> usize {
        self.counts.iter().filter(|counts| **counts).count()
    }

    /// The mean distance of neighbours.
    pub(super) fn mean_chord(&self) -> f64 {
        let chords = self
            .points
            .windows(2)
            .map(|chord| chord[0].distance(chord[1]));
        chords.sum::<f64>() / self.points.len().saturating_sub(1).max(1) as f64
    }

    /// Share out the chord lengths of the points that count, where no chord counts for more than so many
    /// times those about it.
    pub(super) fn share_chords(&mut self, cap: f64) {
        let counting = self.points.iter().zip(&self.counts);
        let counting = counting.filter_map(|(point, counts)| counts.then_some(*point));
        let counting: Vec<DVec3> = counting.collect();
        let chords = counting.windows(2).map(|chord| chord[0].distance(chord[1]));
        let chords: Vec<f64> = chords.collect();
        let about = |index: usize| {
            let last = (index + NEIGHBOURS + 1).min(chords.len());
            median(
                chords[index.saturating_sub(NEIGHBOURS)..last]
                    .iter()
                    .copied(),
            )
        };
        let capped = |(index, chord): (usize, &f64)| match cap * about(index) {
            most if most > 0.0 => chord.min(most),
            _ => *chord,
        };
        let mut lengths = chords.iter().enumerate().map(capped);
        let mut length = 0.0;
        let mut first = true;
        let lengths = self.counts.iter().map(|counts| {
            if *counts && !std::mem::take(&mut first) {
                length += lengths.next().unwrap_or_default();
            }
            length
        });
        let lengths: Vec<f64> = lengths.collect();
        self.shares = lengths.into_iter().map(|it| it / length).collect();
    }

    /// List the points next to one, on either side, that count.
    pub(super) fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> {
        let last = self.points.len() - 1;
        let near = index.saturating_sub(NEIGHBOURS)..=(index + NEIGHBOURS).min(last);
        near.filter(move |other| *other != index && self.counts[*other])
    }

    /// The root mean square and the largest length of the counted offsets.
    pub(super) fn errors(&self, offsets: &[DVec3]) -> [f64; 2] {
        let kept = offsets.iter().zip(&self.counts);
        let kept = kept.filter_map(|(offset, counts)| counts.then_some(offset.length()));
        let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0);
        for distance in kept {
            sum += distance * distance;
            largest = largest.max(distance);
            count += 1;
        }
        [(sum / count.max(1) as f64).sqrt(), largest]
    }
}

/// The median, of none 0.
pub(super) fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}
