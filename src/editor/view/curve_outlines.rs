//! The outlines of a curve and of what hangs on it: chains of points thinned to the view, sampled anew close
//! up.

use glam::{DVec2, DVec3};

use crate::analysis::{PieceSampler, Sample, SampledCurve, mark_closer};
use crate::editor::view::blocks::Blocks;
use crate::editor::view::comb::{CombSettings, Teeth};
use crate::editor::view::density::disc;
use crate::editor::view::evolute::Evolute;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{Bounds, GAP, Outline, OutlineKey, ViewBox, append_gap, thin};
use crate::editor::view::sample_chain::{chain, finite};
use crate::geometry::features::{SegmentFeatures, Sign, SignPiece};

/// A piece is sampled anew when its samples are farther apart than this, in screen points.
const COARSE: f64 = 8.0;

/// The evolute is followed closely within this distance from the curve, in units of the curve's
/// extent.
const REACH: f64 = 1.5;

/// Chords of the evolute are no longer than this there, in screen points.
const LONGEST_CHORD: f64 = 24.0;

/// The most samples of a piece that is sampled anew for a close view.
const FINEST: usize = 256;

/// The proved trend of the curvature on a piece of the curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceTrend {
    /// It rises.
    Rising,
    /// It falls.
    Falling,
    /// Nothing is proved.
    Undecided,
}

/// Hold the outlines of a curve in one orientation, block by block.
#[derive(Debug, Default)]
pub struct CurveOutlines {
    blocks: Blocks<Block>,
    fine: Option<PieceSampler>,
}

/// The outlines of the pieces of one block.
#[derive(Debug, Default)]
struct Block {
    bounds: Bounds,
    /// The outlines of the layers, by their numbers.
    outlines: [Outline; TRENDS + PieceTrend::ALL.len()],
    teeth: Teeth,
}

/// The number of the curve's outline.
const CURVE: usize = 0;

/// The number of the evolute's outline.
const EVOLUTE: usize = 1;

/// The number of the outline of the comb's envelope.
const COMB: usize = 2;

/// The number of the first trend's outline; the others follow in the order of [`PieceTrend::ALL`].
const TRENDS: usize = 3;

impl PieceTrend {
    /// Every trend that is drawn.
    pub const ALL: [Self; 3] = [Self::Rising, Self::Falling, Self::Undecided];

    /// The trend on a piece; `None` where the curvature is constant, and at an extremum.
    pub(in crate::editor) fn of(piece: &SignPiece) -> Option<Self> {
        match piece.sign {
            Sign::Positive => Some(Self::Rising),
            Sign::Negative => Some(Self::Falling),
            Sign::Unknown => Some(Self::Undecided),
            Sign::Zero | Sign::Root { .. } => None,
        }
    }
}

impl CurveOutlines {
    /// Forget blocks that have changed. Call this before any other method after a change of the curve or of the
    /// orientation.
    pub fn update(&mut self, sampled: SampledCurve<'_>, eye: Orientation) {
        let samples = sampled.samples;
        let revisions = samples.blocks().iter().map(|block| block.revision);
        self.blocks.update(eye, revisions, |index| {
            let mut bounds = Bounds::EMPTY;
            for sample in samples.block(index) {
                bounds.add(eye.flatten(sample.point));
            }
            Block {
                bounds,
                ..Block::default()
            }
        });
    }

    /// The box around the curve, as it is seen.
    pub fn bounds(&self) -> Bounds {
        let bounds = self.blocks.iter().map(|block| block.bounds);
        bounds.fold(Bounds::EMPTY, Bounds::united)
    }

    /// Append the visible part of the curve, thinned to the view's pixels. Gaps are
    /// [`crate::editor::GAP`] points.
    pub fn append_curve(
        &mut self,
        sampled: SampledCurve<'_>,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
    ) {
        let eye = self.blocks.eye;
        let place = move |sample: &Sample| eye.flatten(sample.point);
        self.append_chain(sampled, view, out, (CURVE, 0), place);
    }

    /// Append the visible joints between pieces, with the curve's normals, which are shorter where the joints crowd.
    pub fn append_joints(
        &self,
        SampledCurve { curve, samples }: SampledCurve<'_>,
        view: &ViewBox,
        out: &mut Vec<[DVec2; 2]>,
    ) {
        let (eye, pieces) = (self.blocks.eye, samples.pieces());
        let ends = |piece: usize| {
            let own = samples.piece(piece);
            Some((own.first()?, own.last()?))
        };
        let mut step_before = samples.blocks().last().map_or(0.0, |it| it.longest_step);
        for (index, (own, block)) in self.blocks.iter().zip(samples.blocks()).enumerate() {
            // No piece is longer, nor the one before the first.
            let longest = samples.steps() as f64 * block.longest_step.max(step_before);
            step_before = block.longest_step;
            if disc(longest / view.pixel) == 0.0 || !own.bounds.meets(view) {
                continue;
            }
            for piece in samples.block_pieces(index) {
                let previous = match piece.checked_sub(1) {
                    None if !curve.is_periodic() => continue,
                    previous => previous.unwrap_or(pieces - 1),
                };
                let Some(((start, joint), (_, end))) = ends(previous).zip(ends(piece)) else {
                    continue;
                };
                let [last, at, next] = [start, joint, end].map(|sample| eye.flatten(sample.point));
                let size = disc(0.5 * (last.distance(at) + at.distance(next)) / view.pixel);
                if size > 0.0 && view.holds(at) {
                    out.push([at, f64::from(size) * eye.flatten(joint.normal)]);
                }
            }
        }
    }

    /// Append the visible part of the evolute. It breaks where it passes through infinity, and is refined
    /// where it runs much faster than the curve.
    pub fn append_evolute(
        &mut self,
        sampled: SampledCurve<'_>,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
    ) {
        let bounds = self.bounds();
        // Powers of two: what blocks keep is not made anew whenever the view or the curve grows.
        let reach = REACH * (bounds.high - bounds.low).max_element();
        let reach = 2f64.powf(reach.log2().ceil());
        let evolute = Evolute {
            curve: sampled.curve,
            planar: sampled.samples.is_planar(),
            eye: self.blocks.eye,
            longest_chord: LONGEST_CHORD * 2f64.powi(view.level() + 1),
            reach,
        };
        let layer = Drawn {
            shape: reach.to_bits(),
            outline: EVOLUTE,
            place: |sample: &Sample| evolute.place(sample),
            points: |piece, samples: &[Sample], near: Option<&ViewBox>, out: &mut Vec<DVec2>| {
                evolute.append(piece, samples, near, out);
            },
        };
        self.append(sampled, view, out, layer);
    }

    /// Append the visible part of the comb's envelope.
    pub fn append_comb(
        &mut self,
        sampled: SampledCurve<'_>,
        view: &ViewBox,
        comb: &CombSettings,
        out: &mut Vec<DVec2>,
    ) {
        let (scale, eye) = (comb.scale, self.blocks.eye);
        let place = move |sample: &Sample| finite(eye.flatten(sample.comb_tip(scale)));
        self.append_chain(sampled, view, out, (COMB, scale.to_bits()), place);
    }

    /// Append the visible pieces of the curve with one trend, by the features of its segments, with gaps
    /// between them.
    pub fn append_trend(
        &mut self,
        sampled: SampledCurve<'_>,
        features: &[SegmentFeatures],
        trend: PieceTrend,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
    ) {
        let eye = self.blocks.eye;
        let points =
            |segment: usize, samples: &[Sample], _: Option<&ViewBox>, out: &mut Vec<DVec2>| {
                let Some(features) = features.get(segment) else {
                    return;
                };
                let at = |t: f64| eye.flatten(sampled.curve.piece_jet(segment, t).point);
                let steps = samples.len().saturating_sub(1).max(1) as f64;
                let mut start = 0.0;
                for piece in &features.curvature_slope {
                    let end = piece.until;
                    if PieceTrend::of(piece) == Some(trend) {
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
            outline: TRENDS + trend as usize,
            place: |sample: &Sample| eye.flatten(sample.point),
            points,
        };
        self.append(sampled, view, out, layer);
    }

    /// The box around the comb's tips, as they are seen.
    pub fn comb_bounds(&self, sampled: SampledCurve<'_>, scale: f64) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for sample in sampled.samples.all() {
            bounds.add(self.blocks.eye.flatten(sample.comb_tip(scale)));
        }
        bounds
    }

    /// Append the comb's visible teeth, each from its foot on the curve to its tip; where they
    /// would stand closer than three screen points they are thinned out.
    pub fn append_teeth(
        &mut self,
        sampled: SampledCurve<'_>,
        view: &ViewBox,
        comb: &CombSettings,
        out: &mut Vec<[DVec2; 2]>,
    ) {
        let (samples, level) = (sampled.samples, view.level());
        let spacing = 3.0 * 2f64.powi(level + 1);
        let density = comb.density.clamp(1, samples.steps());
        let eye = self.blocks.eye;
        for (index, block) in self.blocks.iter_mut().enumerate() {
            let key = (level, comb.scale.to_bits(), density);
            block.teeth.refresh(key, spacing, &eye, || {
                let pieces = samples.block_pieces(index);
                pieces.flat_map(move |piece| teeth(samples.piece(piece), density))
            });
            block.teeth.append(view, out);
        }
    }

    /// Find the tooth of the comb whose tip is seen nearest to `target`, if it is at most `reach` away,
    /// of those that are longer than `shortest`.
    pub fn tooth(
        &self,
        sampled: SampledCurve<'_>,
        comb: &CombSettings,
        target: DVec2,
        reach: f64,
        shortest: f64,
    ) -> Option<[DVec2; 2]> {
        let (samples, steps) = (sampled.samples, sampled.samples.steps());
        let density = comb.density.clamp(1, steps);
        let mut best: Option<(f64, [DVec2; 2])> = None;
        for (index, (own, block)) in self.blocks.iter().zip(samples.blocks()).enumerate() {
            let steepest = block.curvature.map_or(0.0, |range| range.magnitude());
            let Bounds { low, high } = own.bounds;
            let away = target.distance(target.clamp(low, high));
            if !(away <= reach + comb.scale * steepest) {
                continue;
            }
            let pieces = samples.block_pieces(index);
            for sample in pieces.flat_map(|piece| teeth(samples.piece(piece), density)) {
                let foot = self.seen(sample.point);
                let tip = self.seen(sample.comb_tip(comb.scale));
                let distance = tip.distance(target);
                let is_near = distance <= reach && tip.distance(foot) > shortest;
                if is_near && best.is_none_or(|(nearest, _)| distance < nearest) {
                    best = Some((distance, [foot, tip]));
                }
            }
        }
        best.map(|(_, tooth)| tooth)
    }

    /// Find the point of the curve that is seen nearest to `target`, if it is at most
    /// `reach` away: its parameter, place and distance.
    pub fn nearest(
        &self,
        sampled: SampledCurve<'_>,
        target: DVec2,
        reach: f64,
    ) -> Option<(f64, DVec2, f64)> {
        let passes = self.passes(sampled, target, reach).into_iter();
        passes.min_by(|a, b| a.2.total_cmp(&b.2))
    }

    /// Find where the curve is seen to pass `target` at most `reach` away: parameter, place and distance of the
    /// nearest point of each run of samples there. Sampled chords lead to it and Newton's method refines it.
    pub fn passes(
        &self,
        sampled: SampledCurve<'_>,
        target: DVec2,
        reach: f64,
    ) -> Vec<(f64, DVec2, f64)> {
        let samples = sampled.samples;
        let mut runs: Vec<(f64, f64)> = Vec::new();
        let mut runs_on = false;
        for (index, (own, block)) in self.blocks.iter().zip(samples.blocks()).enumerate() {
            let Bounds { low, high } = own.bounds;
            if !(target.distance(target.clamp(low, high)) <= reach + block.longest_step) {
                runs_on = false;
                continue;
            }
            for piece in samples.block_pieces(index) {
                let steps = samples.piece(piece).windows(2).enumerate();
                for (step, pair) in steps.filter(|(_, pair)| !pair[1].leaps) {
                    let (from, to) = (self.seen(pair[0].point), self.seen(pair[1].point));
                    let chord = to - from;
                    let share =
                        ((target - from).dot(chord) / chord.length_squared()).clamp(0.0, 1.0);
                    let share = if share.is_nan() { 0.0 } else { share };
                    let distance = (from + share * chord).distance(target);
                    let is_near = distance <= reach + 0.5 * chord.length();
                    let t = (step as f64 + share) / samples.steps() as f64;
                    let found = (distance, piece as f64 + t);
                    match runs.last_mut().filter(|_| runs_on) {
                        Some(run) if is_near && distance < run.0 => *run = found,
                        Some(_) => {}
                        None if is_near => runs.push(found),
                        None => {}
                    }
                    runs_on = is_near;
                }
            }
        }
        let refined = runs.into_iter().map(|(_, start)| {
            let u = self.refined(sampled, start, target);
            let point = self.seen(sampled.curve.jet(u).point);
            (u, point, point.distance(target))
        });
        let near = refined.filter(|(_, _, distance)| *distance <= reach);
        near.collect()
    }

    /// Refine the parameter of the point that is seen nearest to `target`.
    fn refined(&self, sampled: SampledCurve<'_>, start: f64, target: DVec2) -> f64 {
        let end = sampled.samples.pieces() as f64;
        let step = 1.0 / sampled.samples.steps() as f64;
        let mut u = start;
        for _ in 0..8 {
            let jet = sampled.curve.jet(u);
            let away = self.seen(jet.point) - target;
            let (first, second) = (self.seen(jet.first), self.seen(jet.second));
            let slope = first.length_squared() + away.dot(second);
            if !(slope > 0.0) {
                break;
            }
            u = (u - away.dot(first) / slope)
                .clamp(start - step, start + step)
                .clamp(0.0, end);
        }
        u
    }

    fn seen(&self, point: DVec3) -> DVec2 {
        self.blocks.eye.flatten(point)
    }

    /// Append the visible part of a layer that has one point for each sample.
    fn append_chain(
        &mut self,
        sampled: SampledCurve<'_>,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
        (outline, shape): (usize, u64),
        place: impl Fn(&Sample) -> DVec2 + Copy,
    ) {
        let points = |_: usize, samples: &[Sample], _: Option<&ViewBox>, out: &mut Vec<DVec2>| {
            out.extend(chain(samples, place));
        };
        let layer = Drawn {
            shape,
            outline,
            place,
            points,
        };
        self.append(sampled, view, out, layer);
    }

    /// Append the visible part of one layer, made of the samples piece by piece.
    fn append<P, C>(
        &mut self,
        sampled: SampledCurve<'_>,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
        layer: Drawn<P, C>,
    ) where
        P: Fn(&Sample) -> DVec2,
        C: Fn(usize, &[Sample], Option<&ViewBox>, &mut Vec<DVec2>),
    {
        let samples = sampled.samples;
        let blocks = self.blocks.iter_mut().zip(samples.blocks());
        for (index, (own, block)) in blocks.enumerate() {
            let coarse = block.longest_step > COARSE * view.pixel && samples.steps() < FINEST;
            let key = OutlineKey {
                level: (!coarse).then(|| view.level()),
                shape: layer.shape,
            };
            let outline = &mut own.outlines[layer.outline];
            outline.refresh(key, || {
                let mut chained = Vec::new();
                for piece in samples.block_pieces(index) {
                    let samples = samples.piece(piece);
                    if coarse {
                        // Only the box around these is needed.
                        chained.extend(samples.iter().map(&layer.place));
                    } else {
                        (layer.points)(piece, samples, None, &mut chained);
                    }
                }
                chained.into_iter()
            });
            if !coarse {
                outline.append(view, out);
            } else if outline.bounds().may_meet(view) {
                let fine = &mut self.fine;
                outline.append_close(view, layer.shape, out, |out| {
                    append_fine(fine, sampled, index, view, out, &layer);
                });
            } else {
                append_gap(out);
            }
        }
    }
}

/// The samples of one piece at which teeth of the comb stand: `density` + 1 of them.
fn teeth(samples: &[Sample], density: usize) -> impl Iterator<Item = &Sample> {
    let steps = samples.len().saturating_sub(1);
    (0..=density).map(move |tooth| &samples[(tooth * steps + density / 2) / density])
}

/// Append a block whose samples are too coarse for the view: pieces that the view touches are
/// sampled anew, as densely as the view needs.
fn append_fine<P, C>(
    fine: &mut Option<PieceSampler>,
    SampledCurve { curve, samples }: SampledCurve<'_>,
    index: usize,
    view: &ViewBox,
    out: &mut Vec<DVec2>,
    layer: &Drawn<P, C>,
) where
    P: Fn(&Sample) -> DVec2,
    C: Fn(usize, &[Sample], Option<&ViewBox>, &mut Vec<DVec2>),
{
    let longest = samples.blocks()[index].longest_step;
    let needed = samples.steps() as f64 * longest / (COARSE * view.pixel);
    let steps = (needed.min(FINEST as f64) as usize).next_power_of_two();
    let kept = fine.take().filter(|fine| fine.steps() == steps);
    let fine = fine.insert(kept.unwrap_or_else(|| PieceSampler::new(steps)));
    let mut closer = vec![samples.all()[0]; steps + 1];
    let mut chained = Vec::new();
    for piece in samples.block_pieces(index) {
        let mut bounds = Bounds::EMPTY;
        let places = samples.piece(piece).iter().map(&layer.place);
        places.for_each(|place| bounds.add(place));
        if bounds.may_meet(view) {
            fine.fill(curve, piece, samples.is_planar(), &mut closer);
            mark_closer(curve, piece, samples.piece(piece), &mut closer);
            chained.clear();
            (layer.points)(piece, &closer, Some(view), &mut chained);
            let spacing = 2f64.powi(view.level());
            thin(chained.iter().copied(), spacing, out, &mut bounds);
        } else if out.last().is_none_or(|last| !last.is_nan()) {
            out.push(GAP);
        }
    }
}

/// How a layer that is a chain of points is drawn.
struct Drawn<P, C> {
    /// A key of other inputs, such as the bits of the comb's scale.
    shape: u64,
    /// The number of the outline.
    outline: usize,
    /// The point of one sample.
    place: P,
    /// Appends the points of one piece; with a view, only what is near it needs care.
    points: C,
}
