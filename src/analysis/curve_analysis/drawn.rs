//! What is drawn of a curve: chains of points thinned to the view, sampled anew where it is close.

use glam::DVec2;

use super::evolute::Evolute;
use super::{BLOCK, Block, CurveAnalysis};
use crate::analysis::comb::CombSettings;
use crate::analysis::outline::{Bounds, Outline, OutlineKey, ViewBox, append_gap, thin};
use crate::analysis::sample::{Sample, SegmentSampler, chain, finite};

/// A segment is sampled anew when its samples are farther apart than this, in screen points.
const COARSE: f64 = 8.0;

/// The evolute is followed closely within this distance from the curve, in units of the curve's
/// extent.
const REACH: f64 = 4.0;

/// The most samples of a segment that is sampled anew for a close view.
const FINEST: usize = 256;

impl CurveAnalysis {
    /// Append what is visible of the curve, thinned to the view's pixels. Gaps are
    /// [`crate::analysis::GAP`] points.
    pub fn append_curve(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        let eye = self.orientation;
        let place = move |sample: &Sample| eye.flatten(sample.point);
        let points = move |_, samples: &[Sample], out: &mut Vec<DVec2>| {
            out.extend(chain(samples, place));
        };
        self.append(view, out, 0, |block| &mut block.curve, points);
    }

    /// Append what is visible of the evolute; it breaks where it passes through infinity, and is
    /// followed more closely where it runs much faster than the curve.
    pub fn append_evolute(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        let bounds = self.bounds();
        let evolute = Evolute {
            curve: self.curve.clone(),
            planar: self.planar,
            eye: self.orientation,
            longest_chord: COARSE * view.pixel,
            reach: REACH * (bounds.high - bounds.low).max_element(),
        };
        let points = |segment, samples: &[Sample], out: &mut Vec<DVec2>| {
            evolute.append(segment, samples, out);
        };
        self.append(view, out, 0, |block| &mut block.evolute, points);
    }

    /// Append what is visible of the comb's envelope.
    pub fn append_comb(&mut self, view: &ViewBox, comb: &CombSettings, out: &mut Vec<DVec2>) {
        let (scale, eye) = (comb.scale, self.orientation);
        let place = move |sample: &Sample| finite(eye.flatten(sample.comb_tip(scale)));
        let points = move |_, samples: &[Sample], out: &mut Vec<DVec2>| {
            out.extend(chain(samples, place));
        };
        self.append(view, out, scale.to_bits(), |block| &mut block.comb, points);
    }

    /// Append the comb's visible teeth, each from its foot on the curve to its tip; where they
    /// would stand closer than three screen points they are thinned out.
    pub fn append_teeth(&mut self, view: &ViewBox, comb: &CombSettings, out: &mut Vec<[DVec2; 2]>) {
        let level = view.level();
        let spacing = 3.0 * 2f64.powi(level + 1);
        let stride = (self.steps / comb.density.clamp(1, self.steps)).max(1);
        for index in 0..self.blocks.len() {
            let range = self.block_segments(index);
            let (steps, samples) = (self.steps, &self.samples);
            let teeth = &mut self.blocks[index].teeth;
            let key = (level, comb.scale.to_bits(), stride);
            teeth.refresh(key, spacing, &self.orientation, || {
                range.flat_map(move |segment| {
                    let own = &samples[segment * (steps + 1)..(segment + 1) * (steps + 1)];
                    own.iter().step_by(stride)
                })
            });
            teeth.append(view, out);
        }
    }

    /// Append one layer that is a chain of points, made of the samples segment by segment;
    /// `shape` is whatever else the points depend on.
    pub(in crate::analysis) fn append(
        &mut self,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
        shape: u64,
        layer: impl Fn(&mut Block) -> &mut Outline,
        points: impl Fn(usize, &[Sample], &mut Vec<DVec2>),
    ) {
        for index in 0..self.blocks.len() {
            let longest = self.summary(index).longest;
            let coarse = longest > COARSE * view.pixel && self.steps < FINEST;
            let level = (!coarse).then(|| view.level());
            let range = self.block_segments(index);
            let size = self.steps + 1;
            let samples = &self.samples;
            let outline = layer(&mut self.blocks[index]);
            outline.refresh(OutlineKey { level, shape }, || {
                let mut chained = Vec::new();
                for segment in range {
                    points(segment, &samples[segment * size..][..size], &mut chained);
                }
                chained.into_iter()
            });
            if !coarse {
                outline.append(view, out);
            } else if outline.bounds().may_meet(view) {
                self.append_fine(index, view, out, &points);
            } else {
                append_gap(out);
            }
        }
    }

    /// Append a block whose samples are too coarse for the view: segments that the view touches
    /// are sampled anew, as densely as the view needs.
    fn append_fine(
        &mut self,
        index: usize,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
        points: &impl Fn(usize, &[Sample], &mut Vec<DVec2>),
    ) {
        let needed = self.steps as f64 * self.summary(index).longest / (COARSE * view.pixel);
        let steps = (needed.min(FINEST as f64) as usize).next_power_of_two();
        if self.fine.as_ref().is_none_or(|fine| fine.steps() != steps) {
            self.fine = Some(SegmentSampler::new(self.curve.polygon.degree(), steps));
        }
        let Some(fine) = &mut self.fine else {
            return;
        };
        let size = self.steps + 1;
        let mut samples = vec![self.samples[0]; steps + 1];
        let mut chained = Vec::new();
        for segment in index * BLOCK..((index + 1) * BLOCK).min(self.curve.polygon.segments()) {
            let coarse = &self.samples[segment * size..(segment + 1) * size];
            chained.clear();
            points(segment, coarse, &mut chained);
            let mut bounds = Bounds::EMPTY;
            chained.iter().for_each(|point| bounds.add(*point));
            if bounds.may_meet(view) {
                fine.fill(&self.curve.polygon, segment, self.planar, &mut samples);
                chained.clear();
                points(segment, &samples, &mut chained);
                let spacing = 2f64.powi(view.level());
                thin(chained.iter().copied(), spacing, out, &mut bounds);
            } else {
                append_gap(out);
            }
        }
    }
}
