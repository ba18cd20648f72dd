//! The pieces of a curve on which its curvature rises, falls or stays constant.

use std::collections::HashMap;

use super::feature::{Cusp, Trend, TrendPiece};
use super::separation::ChangeInterval;
use super::sign_walk::{Place, Run};

/// List the pieces on which the slope of the curvature has one sign, in the order of u.
///
/// They begin and end at the narrowed intervals of the slope's roots, and leave out the cusps, at
/// which the slope may have the same sign on both sides. A cusp that reaches beyond `end`, over the
/// joint of a periodic curve, goes on at the start.
pub(super) fn trends(
    runs: &[Run],
    found: &[ChangeInterval],
    cusps: &[Cusp],
    end: f64,
) -> Vec<TrendPiece> {
    let cusps = unrolled(cusps, end);
    let mut pieces = Vec::new();
    for (run, [mut low, high]) in with_intervals(runs, found) {
        let first = cusps.partition_point(|cusp| cusp[1] < low);
        for cusp in cusps[first..].iter().take_while(|cusp| cusp[0] <= high) {
            push(&mut pieces, [low, cusp[0]], run.sign);
            low = cusp[1];
        }
        push(&mut pieces, [low, high], run.sign);
    }
    pieces
}

/// List runs with their intervals of u, which reach as far as the roots beside them.
fn with_intervals<'a>(
    runs: &'a [Run],
    found: &[ChangeInterval],
) -> impl Iterator<Item = (&'a Run, [f64; 2])> {
    let narrowed = found.iter().filter(|found| found.is_narrow);
    let narrowed = narrowed.map(|found| (key(found.change.places[0]), found.u));
    let narrowed: HashMap<_, _> = narrowed.collect();
    let mut root_before: Option<[f64; 2]> = None;
    runs.iter().enumerate().map(move |(index, run)| {
        let [start, end] = run.places;
        // A root has a width: runs that meet, as at knots, have none between them.
        let next = runs.get(index + 1).filter(|next| next.places[0] != end);
        let root_after = next.and_then(|_| narrowed.get(&key(end)).copied());
        let low = root_before.map_or_else(|| start.rounded_up(), |root| root[1]);
        let high = root_after.map_or_else(|| end.rounded_down(), |root| root[0]);
        root_before = root_after;
        (run, [low, high])
    })
}

fn key(place: Place) -> (usize, u64) {
    (place.segment, place.t.to_bits())
}

/// The intervals of cusps, inside the domain and in order.
fn unrolled(cusps: &[Cusp], end: f64) -> Vec<[f64; 2]> {
    let over_the_joint = cusps.last().map(|cusp| [0.0, cusp.u[1] - end]);
    let over_the_joint = over_the_joint.filter(|part| part[1] > 0.0);
    let parts = cusps.iter().map(|cusp| [cusp.u[0], cusp.u[1].min(end)]);
    over_the_joint.into_iter().chain(parts).collect()
}

/// Append a piece, unless nothing is left of it: doubles of u may not tell its ends apart.
fn push(pieces: &mut Vec<TrendPiece>, u: [f64; 2], sign: i8) {
    let trend = match sign {
        0 => Trend::Constant,
        sign if sign > 0 => Trend::Rising,
        _ => Trend::Falling,
    };
    if u[0] < u[1] {
        pieces.push(TrendPiece { u, trend });
    }
}
