//! The proved features of a curve, kept up to date segment by segment, and what is drawn of them.

use glam::DVec2;

use super::curve_analysis::{CurveAnalysis, Drawn, Kept};
use super::outline::{GAP, ViewBox};
use super::sample::Sample;
use crate::geometry::FloatPolygon;
use crate::geometry::features::{Features, SegmentFeatures, SegmentProver, Sign, SignPiece};

/// What is known of a curve's features.
#[derive(Debug)]
pub(super) struct CurveFeatures {
    prover: SegmentProver,
    /// The features of each segment; empty before they are asked for.
    segments: Vec<SegmentFeatures>,
    /// The segments that have changed since.
    stale: Vec<usize>,
    /// How many segments were proved when they were last asked for.
    proved: usize,
    assembled: Option<Features>,
}

impl CurveFeatures {
    /// Prepare for a planar curve, or one in space.
    pub(super) fn new(planar: bool) -> Self {
        Self {
            prover: SegmentProver::new(planar),
            segments: Vec::new(),
            stale: Vec::new(),
            proved: 0,
            assembled: None,
        }
    }

    /// Forget what was proved of a segment.
    pub(super) fn forget(&mut self, segment: usize) {
        if !self.segments.is_empty() {
            self.stale.push(segment);
        }
        self.assembled = None;
    }

    fn prove(&mut self, polygon: &FloatPolygon) {
        if self.segments.is_empty() {
            let all = 0..polygon.segments();
            let prove = |segment| self.prover.segment(polygon, segment);
            self.segments = all.map(prove).collect();
            self.proved = self.segments.len();
            return;
        }
        if !self.stale.is_empty() {
            self.stale.sort_unstable();
            self.stale.dedup();
            self.proved = self.stale.len();
        }
        for segment in self.stale.drain(..) {
            if let Some(known) = self.segments.get_mut(segment) {
                *known = self.prover.segment(polygon, segment);
            }
        }
    }
}

/// What the curvature does on a piece of the curve, as far as it is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceTrend {
    /// It rises.
    Rising,
    /// It falls.
    Falling,
    /// Nothing is proved.
    Undecided,
}

impl PieceTrend {
    /// Every trend that is drawn.
    pub const ALL: [Self; 3] = [Self::Rising, Self::Falling, Self::Undecided];

    fn is_of(self, piece: &SignPiece) -> bool {
        matches!(
            (self, piece.sign),
            (Self::Rising, Sign::Positive)
                | (Self::Falling, Sign::Negative)
                | (Self::Undecided, Sign::Unknown)
        )
    }
}

impl CurveAnalysis {
    /// Bring the proved features up to date and return them: only segments that changed since
    /// are proved anew.
    pub fn features(&mut self) -> &Features {
        self.prove();
        let curve = self.curve().clone();
        let features = self.curve_features();
        let segments = &features.segments;
        let assemble = || Features::assemble(&curve.polygon, segments);
        features.assembled.get_or_insert_with(assemble)
    }

    /// The number of segments that were proved anew when the features last changed.
    pub fn segments_proved(&self) -> usize {
        self.curve_features_known().proved
    }

    /// Append what is visible of the pieces of the curve on which its curvature does one thing;
    /// gaps lie between them.
    pub fn append_pieces(&mut self, view: &ViewBox, trend: PieceTrend, out: &mut Vec<DVec2>) {
        self.prove();
        let segments = std::mem::take(&mut self.curve_features().segments);
        let (curve, eye) = (self.curve().clone(), self.orientation());
        let points =
            |segment: usize, samples: &[Sample], _: Option<&ViewBox>, out: &mut Vec<DVec2>| {
                let Some(features) = segments.get(segment) else {
                    return;
                };
                let at = |t: f64| eye.flatten(curve.polygon.segment_jet(segment, t).point);
                let steps = samples.len().saturating_sub(1).max(1) as f64;
                let mut start = 0.0;
                for piece in &features.curvature_slope {
                    let end = piece.until;
                    if trend.is_of(piece) {
                        out.push(at(start));
                        let inner = ((start * steps) as usize + 1)..samples.len();
                        let inner = inner.take_while(|index| (*index as f64) < end * steps);
                        out.extend(inner.map(|index| eye.flatten(samples[index].point)));
                        out.push(at(end));
                    } else {
                        out.push(GAP);
                    }
                    start = end;
                }
            };
        let layer = Drawn {
            shape: 0,
            outline: Kept::Pieces(trend),
            place: |sample: &Sample| eye.flatten(sample.point),
            points,
        };
        self.append(view, out, layer);
        self.curve_features().segments = segments;
    }

    fn prove(&mut self) {
        let curve = self.curve().clone();
        self.curve_features().prove(&curve.polygon);
    }
}
