//! The polygon's discrete curvature at its vertices, as it is plotted below the curve's own.

use glam::DVec2;

use super::curve_samples::SampledCurve;
use super::vertex_chain::VertexChain;
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
pub(super) fn append_discrete_curvature(
    polygon: &FloatPolygon,
    chain: &VertexChain,
    sampled: SampledCurve<'_>,
    out: &mut Vec<(usize, DVec2)>,
) -> f64 {
    let end = polygon.segments() as f64;
    let length = sampled.samples.length();
    let beyond = vertices_beyond_an_end(polygon);
    let step = length * FLANK_STEP.min(WIDEST_FLANK / (beyond as f64 + 0.5));
    let mut cursor = LengthCursor::default();
    for (index, value) in chain.extreme_curvatures() {
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

/// Count the inner vertices of an open polygon whose Greville abscissae lie beyond one end:
/// those before number (n − 1)/2, the very first excepted.
fn vertices_beyond_an_end(polygon: &FloatPolygon) -> usize {
    if polygon.is_periodic() {
        0
    } else {
        (polygon.degree() / 2).saturating_sub(1)
    }
}

/// Remember the arc length where the last question ended, so that questions in rising order
/// walk along the curve once.
#[derive(Debug, Default)]
pub struct LengthCursor {
    block: usize,
    before_block: f64,
}

impl LengthCursor {
    /// Measure the arc length from the curve's start to u, as [`SampledCurve::length_at`] does.
    pub fn length_at(&mut self, SampledCurve { curve, samples }: SampledCurve<'_>, u: f64) -> f64 {
        let (piece, t) = curve.locate(u);
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
