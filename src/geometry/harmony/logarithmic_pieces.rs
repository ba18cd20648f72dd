//! The logarithmic curvature graph on the monotone pieces of the curvature: slope and straightness.

use super::fairness::SegmentFairness;
use super::graph_moments::GraphMoments;
use crate::geometry::features::{Features, Trend};
use crate::geometry::parametric_curve::ParametricCurve;

/// Hold the line nearest to the logarithmic curvature graph of a piece of a curve on which the
/// curvature is monotone and has one sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogarithmicPiece {
    /// The piece; of a periodic curve it may reach over the joint, beyond L.
    pub u: [f64; 2],
    /// The slope α: −1 of a clothoid, 1 of a logarithmic spiral, 2 of a circle involute.
    pub slope: f64,
    /// The straightness R², 1 of a log-aesthetic curve: the share of the graph's variance that the
    /// line accounts for.
    pub straightness: f64,
}

/// Put a line through the graph of each piece on which the curvature is proved to rise or to fall,
/// between inflections, in the order of u. `segments` hold the graphs of whole pieces of the curve.
pub(super) fn logarithmic_pieces(
    curve: &dyn ParametricCurve,
    planar: bool,
    features: &Features,
    segments: &[SegmentFairness],
) -> Vec<LogarithmicPiece> {
    let count = segments.len();
    let moments = |[from, to]: [f64; 2]| {
        let mut sums = GraphMoments::default();
        let mut start = from;
        while start < to {
            let segment = start.floor();
            let end = to.min(segment + 1.0);
            let (index, local) = (segment as usize % count, [start - segment, end - segment]);
            let own = if local == [0.0, 1.0] {
                segments[index].graph
            } else {
                GraphMoments::of(curve, index, local, planar)
            };
            sums = sums.merged(own);
            start = end;
        }
        sums
    };
    let period = count as f64;
    let monotone = monotone_pieces(features, curve.is_periodic().then_some(period));
    let pieces = monotone.into_iter();
    let pieces = pieces.flat_map(|piece| between_inflections(piece, features, period));
    let lines = pieces.filter_map(|u| {
        let (slope, straightness) = moments(u).line()?;
        Some(LogarithmicPiece {
            u,
            slope,
            straightness,
        })
    });
    lines.collect()
}

/// List the pieces on which the curvature rises or falls; one of a periodic curve may run over the
/// joint, at which the list of trends is cut.
fn monotone_pieces(features: &Features, period: Option<f64>) -> Vec<[f64; 2]> {
    let monotone = features.trends.iter();
    let mut monotone: Vec<_> = monotone
        .filter(|piece| piece.trend != Trend::Constant)
        .copied()
        .collect();
    if let (Some(period), [first, .., last]) = (period, &mut monotone[..])
        && first.u[0] == 0.0
        && last.u[1] == period
        && first.trend == last.trend
    {
        last.u[1] = period + first.u[1];
        monotone.remove(0);
    }
    monotone.iter().map(|piece| piece.u).collect()
}

/// Cut a piece at the inflections in it.
fn between_inflections([from, to]: [f64; 2], features: &Features, period: f64) -> Vec<[f64; 2]> {
    let mut pieces = Vec::new();
    let mut start = from;
    // A piece over the joint of a periodic curve has inflections of the next round.
    for round in [0.0, period] {
        let inflections = &features.inflections;
        let first = inflections.partition_point(|root| root.u[1] + round <= from);
        for root in &inflections[first..] {
            let [low, high] = root.u.map(|u| u + round);
            if low >= to {
                break;
            }
            pieces.push([start, low]);
            start = high;
        }
    }
    pieces.push([start, to]);
    pieces.retain(|[from, to]| from < to);
    pieces
}
