//! The proved features of a curve, kept up to date segment by segment, and what is drawn of them.

use std::time::{Duration, Instant};

use glam::DVec2;

use super::curve_analysis::{CurveAnalysis, Drawn, Kept};
use super::outline::{GAP, ViewBox};
use super::sample::Sample;
use crate::geometry::FloatPolygon;
use crate::geometry::features::{Features, SegmentFeatures, SegmentProver, Sign, SignPiece};

/// Segments of a planar polynomial curve that are proved at once: a few thousandths of a second.
const AT_ONCE: usize = 1024;

/// Segments of other curves, which take several times as long.
const FEW_AT_ONCE: usize = 192;

/// Segments that are proved at once however long it takes.
const LEAST_AT_ONCE: usize = 16;

/// How long others may take: some are decided in whole numbers only.
const LONGEST: Duration = Duration::from_millis(100);

/// What is known of a curve's features.
#[derive(Debug)]
pub(super) struct CurveFeatures {
    prover: SegmentProver,
    segments: Vec<SegmentFeatures>,
    /// The segments that are to be proved.
    pending: Vec<usize>,
    /// Whether segments were added to these since they were last looked at.
    changed: bool,
    /// How many segments the last change made to be proved.
    proved: usize,
    assembled: Option<Features>,
}

impl CurveFeatures {
    /// Prepare for a planar curve, or one in space, of so many segments.
    pub(super) fn new(planar: bool, segments: usize) -> Self {
        Self {
            prover: SegmentProver::new(planar),
            segments: vec![SegmentFeatures::default(); segments],
            pending: Vec::new(),
            changed: false,
            proved: 0,
            assembled: None,
        }
    }

    /// Forget what was proved of a segment.
    pub(super) fn forget(&mut self, segment: usize) {
        self.pending.push(segment);
        self.changed = true;
        self.assembled = None;
    }

    /// The features of the whole polygon, if all are known.
    fn known(&mut self, polygon: &FloatPolygon) -> Option<&Features> {
        if !self.pending.is_empty() {
            return None;
        }
        let segments = &self.segments;
        let assemble = || Features::assemble(polygon, segments);
        Some(self.assembled.get_or_insert_with(assemble))
    }

    /// The share of the curve whose features are known.
    fn progress(&self) -> f64 {
        1.0 - self.pending.len() as f64 / self.segments.len().max(1) as f64
    }

    /// Go on proving, for a while.
    fn advance(&mut self, polygon: &FloatPolygon, planar: bool) {
        if std::mem::take(&mut self.changed) {
            // The last is taken first.
            self.pending.sort_unstable_by(|a, b| b.cmp(a));
            self.pending.dedup();
            self.proved = self.pending.len();
        }
        let is_quick = planar && !polygon.is_rational();
        let most = if is_quick { AT_ONCE } else { FEW_AT_ONCE };
        let left = self.pending.len().saturating_sub(most);
        let begin = Instant::now();
        let mut done = 0;
        while self.pending.len() > left
            && (done < LEAST_AT_ONCE || begin.elapsed() < LONGEST)
            && let Some(segment) = self.pending.pop()
        {
            done += 1;
            if let Some(known) = self.segments.get_mut(segment) {
                *known = self.prover.segment(polygon, segment);
            }
        }
    }
}

/// Prove the features of a polygon that is only looked at, in parts none of which takes long.
#[derive(Debug)]
pub struct FeatureProof {
    polygon: FloatPolygon,
    features: CurveFeatures,
}

impl FeatureProof {
    /// Begin a proof.
    pub fn new(polygon: FloatPolygon) -> Self {
        let count = polygon.segments();
        let mut features = CurveFeatures::new(polygon.is_planar(), count);
        (0..count).for_each(|segment| features.forget(segment));
        Self { polygon, features }
    }

    /// Go on, and return the features once all are known.
    pub fn advance(&mut self) -> Option<&Features> {
        self.features
            .advance(&self.polygon, self.polygon.is_planar());
        self.features.known(&self.polygon)
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
    /// Go on proving features, only of segments that changed since, and return them once all are
    /// known. A long curve takes several calls, so that none takes long.
    pub fn features(&mut self) -> Option<&Features> {
        let (curve, planar) = (self.curve().clone(), self.is_planar());
        self.curve_features().advance(&curve.polygon, planar);
        self.known_features()
    }

    /// The proved features, if all are known.
    pub fn known_features(&mut self) -> Option<&Features> {
        let curve = self.curve().clone();
        self.curve_features().known(&curve.polygon)
    }

    /// The share of the curve whose features are known.
    pub fn proof_progress(&self) -> f64 {
        self.curve_features_known().progress()
    }

    /// The number of segments that were proved anew when the features last changed.
    pub fn segments_proved(&self) -> usize {
        self.curve_features_known().proved
    }

    /// Append what is visible of the pieces of the curve on which its curvature does one thing;
    /// gaps lie between them.
    pub fn append_pieces(&mut self, view: &ViewBox, trend: PieceTrend, out: &mut Vec<DVec2>) {
        if self.known_features().is_none() {
            return;
        }
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
}
