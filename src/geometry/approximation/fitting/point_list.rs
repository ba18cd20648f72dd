//! Points that follow each other along a curve, with light ones between them.

use glam::DVec3;

use crate::geometry::fitting::with_middles;
use crate::geometry::vector;

/// The points of a fit.
pub(super) struct PointList {
    pub(super) points: Vec<DVec3>,
    pub(super) weights: Vec<f64>,
    /// Which of them are no light ones.
    counts: Vec<bool>,
    /// The share of the chord length up to each point.
    pub(super) shares: Vec<f64>,
    /// The diagonal of their box.
    pub(super) size: f64,
}

impl PointList {
    /// Take points with their weights, and put light ones between them.
    pub(super) fn new(points: &[DVec3], weights: &[f64]) -> Self {
        let (low, high) = vector::bounds(points);
        let (all, counts) = with_middles(points, weights);
        let (points, weights): (Vec<DVec3>, Vec<f64>) = all.into_iter().unzip();
        let shares = shares(&points);
        Self {
            points,
            weights,
            counts,
            shares,
            size: low.distance(high),
        }
    }

    /// Take points that count the same, at shares of the parameter.
    pub(super) fn placed(points: Vec<DVec3>, shares: Vec<f64>) -> Self {
        let (low, high) = vector::bounds(&points);
        Self {
            weights: vec![1.0; points.len()],
            counts: vec![true; points.len()],
            size: low.distance(high),
            points,
            shares,
        }
    }

    /// The number of points that count.
    pub(super) fn counting(&self) -> usize {
        self.counts.iter().filter(|counts| **counts).count()
    }

    /// The weights where curves of so many vertices can meet the points: light ones must not count then.
    pub(super) fn weights_for(&self, count: usize) -> Vec<f64> {
        let meets = count >= self.counting();
        let weights = self.weights.iter().zip(&self.counts);
        let weights = weights.map(|(weight, counts)| match !counts && meets {
            true => 0.0,
            false => *weight,
        });
        weights.collect()
    }

    /// The root mean square, weighed, and the largest length of the offsets of points that count.
    pub(super) fn errors(&self, offsets: &[DVec3]) -> [f64; 2] {
        let weighed = offsets.iter().zip(&self.weights).zip(&self.counts);
        let (mut sum, mut largest, mut all) = (0.0, 0.0_f64, 0.0);
        for ((offset, weight), _) in weighed.filter(|(_, counts)| **counts) {
            sum += weight * offset.length_squared();
            largest = largest.max(offset.length());
            all += weight;
        }
        [(sum / all.max(f64::MIN_POSITIVE)).sqrt(), largest]
    }
}

/// The share of the chord length up to each point.
fn shares(points: &[DVec3]) -> Vec<f64> {
    let mut length = 0.0;
    let chords = points.windows(2).map(|chord| {
        length += chord[0].distance(chord[1]);
        length
    });
    let lengths: Vec<f64> = std::iter::once(0.0)
        .chain(chords.collect::<Vec<f64>>())
        .collect();
    lengths.into_iter().map(|it| it / length).collect()
}
