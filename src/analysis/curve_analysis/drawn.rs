//! What is drawn of a curve: chains of points thinned to the view, sampled anew where it is close.

use glam::DVec2;

use super::evolute::Evolute;
use super::{BLOCK, CurveAnalysis};
use crate::analysis::comb::CombSettings;
use crate::analysis::curve_features::PieceTrend;
use crate::analysis::outline::{Bounds, OutlineKey, ViewBox, append_gap, thin};
use crate::analysis::sample::{Sample, SegmentSampler, chain, finite};

/// A segment is sampled anew when its samples are farther apart than this, in screen points.
const COARSE: f64 = 8.0;

/// The evolute is followed closely within this distance from the curve, in units of the curve's
/// extent.
const REACH: f64 = 1.5;

/// Chords of the evolute are no longer than this there, in screen points.
const LONGEST_CHORD: f64 = 24.0;

/// The most samples of a segment that is sampled anew for a close view.
const FINEST: usize = 256;

impl CurveAnalysis {
    /// Append what is visible of the curve, thinned to the view's pixels. Gaps are
    /// [`crate::analysis::GAP`] points.
    pub fn append_curve(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        let eye = self.orientation;
        let place = move |sample: &Sample| eye.flatten(sample.point);
        let layer = Drawn {
            shape: 0,
            outline: Kept::Curve,
            place,
            points: |_: usize, samples: &[Sample], _: Option<&ViewBox>, out: &mut Vec<DVec2>| {
                out.extend(chain(samples, place));
            },
        };
        self.append(view, out, layer);
    }

    /// Append what is visible of the evolute; it breaks where it passes through infinity, and is
    /// followed more closely where it runs much faster than the curve.
    pub fn append_evolute(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        let bounds = self.bounds();
        // Powers of two: what blocks keep is not made anew whenever the view or the curve grows.
        let reach = REACH * (bounds.high - bounds.low).max_element();
        let reach = 2f64.powf(reach.log2().ceil());
        let evolute = Evolute {
            curve: self.curve.clone(),
            planar: self.planar,
            eye: self.orientation,
            longest_chord: LONGEST_CHORD * 2f64.powi(view.level() + 1),
            reach,
        };
        let layer = Drawn {
            shape: reach.to_bits(),
            outline: Kept::Evolute,
            place: |sample: &Sample| evolute.place(sample),
            points: |segment, samples: &[Sample], near: Option<&ViewBox>, out: &mut Vec<DVec2>| {
                evolute.append(segment, samples, near, out);
            },
        };
        self.append(view, out, layer);
    }

    /// Append what is visible of the comb's envelope.
    pub fn append_comb(&mut self, view: &ViewBox, comb: &CombSettings, out: &mut Vec<DVec2>) {
        let (scale, eye) = (comb.scale, self.orientation);
        let place = move |sample: &Sample| finite(eye.flatten(sample.comb_tip(scale)));
        let layer = Drawn {
            shape: scale.to_bits(),
            outline: Kept::Comb,
            place,
            points: |_: usize, samples: &[Sample], _: Option<&ViewBox>, out: &mut Vec<DVec2>| {
                out.extend(chain(samples, place));
            },
        };
        self.append(view, out, layer);
    }

    /// The box around the comb's tips, as they are seen.
    pub fn comb_bounds(&self, scale: f64) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for sample in &self.samples {
            bounds.add(self.orientation.flatten(sample.comb_tip(scale)));
        }
        bounds
    }

    /// Append the comb's visible teeth, each from its foot on the curve to its tip; where they
    /// would stand closer than three screen points they are thinned out.
    pub fn append_teeth(&mut self, view: &ViewBox, comb: &CombSettings, out: &mut Vec<[DVec2; 2]>) {
        let level = view.level();
        let spacing = 3.0 * 2f64.powi(level + 1);
        let density = comb.density.clamp(1, self.steps);
        for index in 0..self.blocks.len() {
            let range = self.block_segments(index);
            let (steps, samples) = (self.steps, &self.samples);
            let teeth = &mut self.blocks[index].teeth;
            let key = (level, comb.scale.to_bits(), density);
            teeth.refresh(key, spacing, &self.orientation, || {
                range.flat_map(move |segment| {
                    let own = &samples[segment * (steps + 1)..(segment + 1) * (steps + 1)];
                    (0..=density).map(move |tooth| &own[(tooth * steps + density / 2) / density])
                })
            });
            teeth.append(view, out);
        }
    }

    /// Append what is visible of one layer, made of the samples segment by segment.
    pub(in crate::analysis) fn append<P, C>(
        &mut self,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
        layer: Drawn<P, C>,
    ) where
        P: Fn(&Sample) -> DVec2,
        C: Fn(usize, &[Sample], Option<&ViewBox>, &mut Vec<DVec2>),
    {
        for index in 0..self.blocks.len() {
            let longest = self.summary(index).longest;
            let coarse = longest > COARSE * view.pixel && self.steps < FINEST;
            let key = OutlineKey {
                level: (!coarse).then(|| view.level()),
                shape: layer.shape,
            };
            let range = self.block_segments(index);
            let size = self.steps + 1;
            let samples = &self.samples;
            let outline = self.blocks[index].outline(layer.outline);
            outline.refresh(key, || {
                let mut chained = Vec::new();
                for segment in range {
                    let samples = &samples[segment * size..][..size];
                    if coarse {
                        // Only the box around these is needed.
                        chained.extend(samples.iter().map(&layer.place));
                    } else {
                        (layer.points)(segment, samples, None, &mut chained);
                    }
                }
                chained.into_iter()
            });
            if !coarse {
                outline.append(view, out);
            } else if outline.bounds().may_meet(view) {
                self.append_fine(index, view, out, &layer.place, &layer.points);
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
        place: &impl Fn(&Sample) -> DVec2,
        points: &impl Fn(usize, &[Sample], Option<&ViewBox>, &mut Vec<DVec2>),
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
            let mut bounds = Bounds::EMPTY;
            coarse.iter().for_each(|sample| bounds.add(place(sample)));
            if bounds.may_meet(view) {
                fine.fill(&self.curve.polygon, segment, self.planar, &mut samples);
                chained.clear();
                points(segment, &samples, Some(view), &mut chained);
                let spacing = 2f64.powi(view.level());
                thin(chained.iter().copied(), spacing, out, &mut bounds);
            } else {
                append_gap(out);
            }
        }
    }
}

/// An outline that a block keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::analysis) enum Kept {
    /// The curve.
    Curve,
    /// The evolute.
    Evolute,
    /// The comb's envelope.
    Comb,
    /// The pieces on which the curvature does one thing.
    Pieces(PieceTrend),
}

/// How a layer that is a chain of points is drawn.
pub(in crate::analysis) struct Drawn<P, C> {
    /// Whatever else the points depend on.
    pub shape: u64,
    /// Where a block keeps them.
    pub outline: Kept,
    /// The point of one sample.
    pub place: P,
    /// Appends the points of one segment; with a view, only what is near it needs care.
    pub points: C,
}
