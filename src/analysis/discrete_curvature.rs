//! The polygon's discrete curvature at its vertices, as it is plotted below the curve's own.

use std::ops::Range;

use glam::DVec2;

use super::bins::BINS;
use super::curve_samples::SampledCurve;
use super::vertex_chain::{Flow, VertexChain};
use crate::geometry::FloatPolygon;

/// How far apart vertices beyond an end are drawn, as a share of the curve's length …
const FLANK_STEP: f64 = 1.0 / 40.0;

/// … and how wide they may be together.
const WIDEST_FLANK: f64 = 1.0 / 6.0;

/// Append the polygon's discrete curvature at its vertices over the arc length at their
/// Greville abscissae, with the vertices' numbers; of vertices that share a bin only the
/// outermost are kept. `chain` holds the polygon's vertices, `sampled` is its curve.
///
/// Vertices whose abscissae lie beyond an end of the curve, where there is no arc length,
/// stand evenly spaced in a flank beside it. Returns the flanks' width, 0 if there are none.
///
/// Where only a part of the curve, between two arc lengths, is looked at, it has all its vertices if
/// they are no more than bins.
pub(super) fn append_discrete_curvature(
    polygon: &FloatPolygon,
    chain: &VertexChain,
    sampled: SampledCurve<'_>,
    part: Option<[f64; 2]>,
    out: &mut Vec<(usize, DVec2)>,
) -> f64 {
    let end = polygon.segments() as f64;
    let length = sampled.samples.length();
    let beyond = vertices_beyond_an_end(polygon);
    let step = length * FLANK_STEP.min(WIDEST_FLANK / (beyond as f64 + 0.5));
    let mut cursor = LengthCursor::default();
    let few = part.and_then(|part| vertices_of(polygon, sampled, part));
    let all = match few {
        Some(few) => {
            let value = |index| Some((index, chain.flow(Flow::Curvatures, index)?));
            few.filter_map(value).collect()
        }
        None => chain.extreme_curvatures().collect::<Vec<_>>(),
    };
    for (index, value) in all {
        if !value.is_finite() {
            continue;
        }
        let u = polygon.greville(index);
        let x = if polygon.is_periodic() {
            cursor.length_at(sampled, u.rem_euclid(end))
        } else if u < 0.0 {
            u.floor() * step
        } else if u > end {
            length + (u - end).ceil() * step
        } else {
            cursor.length_at(sampled, u)
        };
        out.push((index, DVec2::new(x, value)));
    }
    if beyond > 0 {
        (beyond as f64 + 0.5) * step
    } else {
        0.0
    }
}

/// The vertices of a part of a curve, if they are few and it is not periodic.
fn vertices_of(
    polygon: &FloatPolygon,
    sampled: SampledCurve<'_>,
    part: [f64; 2],
) -> Option<Range<usize>> {
    let [from, to] = part.map(|length| sampled.samples.parameter_at_length(length));
    let first = polygon.greville(0);
    let [from, to] = [from - first, to - first].map(|place| place.max(0.0) as usize);
    let vertices = from..(to + 2).min(polygon.vertices().len());
    let is_few = vertices.len() <= BINS as usize && !polygon.is_periodic();
    is_few.then_some(vertices)
}

/// Count the inner vertices of an open polygon whose Greville abscissae lie beyond one end:
/// those before number (n − 1)/2, the very first excepted.
fn vertices_beyond_an_end(polygon: &FloatPolygon) -> usize {
    if polygon.is_periodic() {
        0
    } else {
        (polygon.degree() / 2).saturating_sub(1)
    }
}

/// Remember the last arc length, so that calls in rising order walk along the curve once.
#[derive(Debug, Default)]
pub struct LengthCursor {
    block: usize,
    before_block: f64,
}

impl LengthCursor {
    /// Measure the arc length from the curve's start to u, as [`SampledCurve::length_at`] does.
    pub fn length_at(&mut self, sampled: SampledCurve<'_>, u: f64) -> f64 {
        let (piece, t) = sampled.curve.locate(u);
        self.length_on(sampled, piece, t)
    }

    /// Measure the arc length from the curve's start to the local parameter t of a piece.
    pub fn length_on(
        &mut self,
        SampledCurve { samples, .. }: SampledCurve<'_>,
        piece: usize,
        t: f64,
    ) -> f64 {
        if piece < samples.block_pieces(self.block).start {
            *self = Self::default();
        }
        while piece >= samples.block_pieces(self.block).end {
            self.before_block += samples.blocks()[self.block].length;
            self.block += 1;
        }
        self.before_block + samples.length_in_block(piece, t)
    }
}
