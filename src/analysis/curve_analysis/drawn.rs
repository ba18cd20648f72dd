//! What is drawn of a curve: chains of points thinned to the view, sampled anew where it is close.

use glam::DVec2;

use super::{BLOCK, Block, CurveAnalysis};
use crate::analysis::comb::CombSettings;
use crate::analysis::outline::{Bounds, Outline, OutlineKey, ViewBox, append_gap, thin};
use crate::analysis::sample::{Sample, SegmentSampler, chain, finite};

/// A segment is sampled anew when its samples are farther apart than this, in screen points.
const COARSE: f64 = 8.0;

/// The most samples of a segment that is sampled anew for a close view.
const FINEST: usize = 256;

impl CurveAnalysis {
    /// Append what is visible of the curve, thinned to the view's pixels. Gaps are
    /// [`crate::analysis::GAP`] points.
    pub fn append_curve(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        let eye = self.orientation;
        let place = move |sample: &Sample| eye.flatten(sample.point);
        self.append(view, out, 0, |block| &mut block.curve, place);
    }

    /// Append what is visible of the evolute; it breaks where it passes through infinity.
    pub fn append_evolute(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        let eye = self.orientation;
        let place = move |sample: &Sample| finite(eye.flatten(sample.centre()));
        self.append(view, out, 0, |block| &mut block.evolute, place);
    }

    /// Append what is visible of the comb's envelope.
    pub fn append_comb(&mut self, view: &ViewBox, comb: &CombSettings, out: &mut Vec<DVec2>) {
        let (scale, eye) = (comb.scale, self.orientation);
        let place = move |sample: &Sample| finite(eye.flatten(sample.comb_tip(scale)));
        self.append(view, out, scale.to_bits(), |block| &mut block.comb, place);
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

    /// Append one layer that is a chain of points made of the samples; `shape` is whatever else
    /// the points depend on.
    fn append(
        &mut self,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
        shape: u64,
        layer: impl Fn(&mut Block) -> &mut Outline,
        place: impl Fn(&Sample) -> DVec2 + Copy,
    ) {
        for index in 0..self.blocks.len() {
            let longest = self.summary(index).longest;
            let coarse = longest > COARSE * view.pixel && self.steps < FINEST;
            let level = (!coarse).then(|| view.level());
            let range = self.block_segments(index);
            let size = self.steps + 1;
            let samples = &self.samples[range.start * size..range.end * size];
            let outline = layer(&mut self.blocks[index]);
            outline.refresh(OutlineKey { level, shape }, || chain(samples, place));
            if !coarse {
                outline.append(view, out);
            } else if outline.bounds().may_meet(view) {
                self.append_fine(index, view, out, place);
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
        place: impl Fn(&Sample) -> DVec2 + Copy,
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
        for segment in index * BLOCK..((index + 1) * BLOCK).min(self.curve.polygon.segments()) {
            let coarse = &self.samples[segment * size..(segment + 1) * size];
            let mut bounds = Bounds::EMPTY;
            chain(coarse, place).for_each(|point| bounds.add(point));
            if bounds.may_meet(view) {
                fine.fill(&self.curve.polygon, segment, self.planar, &mut samples);
                let spacing = 2f64.powi(view.level());
                thin(chain(&samples, place), spacing, out, &mut bounds);
            } else {
                append_gap(out);
            }
        }
    }
}
