//! All that is shown of one curve, kept up to date segment by segment.

mod drawn;
mod evolute;

pub(super) use drawn::{Drawn, Kept};

use std::ops::Range;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::comb::Teeth;
use super::curve_features::{CurveFeatures, PieceTrend};
use super::level_series::LevelSeries;
use super::orientation::Orientation;
use super::outline::{Bounds, Outline};
use super::plot_series::PlotBlock;
use super::sample::{Sample, SegmentSampler};
use super::vertex_chain::{VertexChain, changed_range};
use crate::document::Curve;
use crate::geometry::{ClampedPolygon, FloatPolygon, Range as Span};

/// Segments in one block.
const BLOCK: usize = 32;

/// Samples that a curve is given in all, shared evenly by its segments …
const SAMPLES: usize = 4096;

/// … but never fewer or more than these a segment.
const SAMPLES_PER_SEGMENT: Range<usize> = 4..256;

/// Hold the samples of a curve, its closed S-polygon, and what is drawn of both.
#[derive(Debug)]
pub struct CurveAnalysis {
    curve: Arc<Curve>,
    planar: bool,
    orientation: Orientation,
    /// Steps that each segment is sampled with; it has one sample more.
    steps: usize,
    samples: Vec<Sample>,
    sampler: SegmentSampler,
    fine: Option<SegmentSampler>,
    blocks: Vec<Block>,
    float: VertexChain,
    clamped: VertexChain,
    levels: LevelSeries,
    features: CurveFeatures,
    redone: usize,
}

/// What is derived from the segments of one block.
#[derive(Debug, Default)]
pub(super) struct Block {
    curve: Outline,
    evolute: Outline,
    comb: Outline,
    teeth: Teeth,
    pieces: [Outline; PieceTrend::ALL.len()],
    summary: BlockSummary,
    pub(super) plot: PlotBlock,
}

impl Block {
    fn outline(&mut self, kept: Kept) -> &mut Outline {
        match kept {
            Kept::Curve => &mut self.curve,
            Kept::Evolute => &mut self.evolute,
            Kept::Comb => &mut self.comb,
            Kept::Pieces(trend) => &mut self.pieces[trend as usize],
        }
    }
}

/// Figures of one block's samples.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BlockSummary {
    pub(super) length: f64,
    pub(super) curvature: Option<Span>,
    pub(super) bounds: Bounds,
    /// The longest step between two samples.
    longest: f64,
    /// The arc length from the block's start to each segment's.
    starts: [f64; BLOCK],
}

impl CurveAnalysis {
    /// Analyse a curve that is seen from somewhere.
    pub fn new(curve: Arc<Curve>, orientation: Orientation) -> Self {
        let polygon = &curve.polygon;
        let share = (SAMPLES / polygon.segments()).next_power_of_two();
        let steps = share.clamp(SAMPLES_PER_SEGMENT.start, SAMPLES_PER_SEGMENT.end);
        let blank = Sample::of(&Default::default(), true);
        let mut analysis = Self {
            planar: polygon.is_planar(),
            orientation,
            steps,
            samples: vec![blank; (steps + 1) * polygon.segments()],
            sampler: SegmentSampler::new(polygon.degree(), steps),
            fine: None,
            blocks: Vec::new(),
            float: VertexChain::default(),
            clamped: VertexChain::default(),
            levels: LevelSeries::default(),
            features: CurveFeatures::new(polygon.is_planar(), polygon.segments()),
            redone: 0,
            curve,
        };
        analysis.float.set_orientation(orientation);
        analysis.clamped.set_orientation(orientation);
        let blocks = analysis.curve.polygon.segments().div_ceil(BLOCK);
        analysis.blocks.resize_with(blocks, Block::default);
        analysis.sample(0..analysis.curve.polygon.segments());
        let polygon = &analysis.curve.polygon;
        analysis
            .float
            .update(polygon.vertices(), polygon.is_periodic());
        analysis
            .clamped
            .update(ClampedPolygon::from_float(polygon).vertices(), false);
        analysis
    }

    /// Bring the analysis up to date with the curve. Only segments that depend on a vertex that
    /// moved, or whose weight changed, are sampled again.
    pub fn update(&mut self, curve: &Arc<Curve>) {
        if Arc::ptr_eq(&self.curve, curve) {
            return;
        }
        let (old, new) = (&self.curve.polygon, &curve.polygon);
        let alike = old.degree() == new.degree()
            && old.is_periodic() == new.is_periodic()
            && old.is_rational() == new.is_rational();
        let changed = alike
            .then(|| self.float.update(new.vertices(), new.is_periodic()))
            .flatten();
        let Some(mut changed) = changed else {
            *self = Self::new(curve.clone(), self.orientation);
            return;
        };
        let [old, new] = [old, new].map(|polygon| polygon.weights().unwrap_or_default());
        if let Some(weights) = changed_range(old, new) {
            changed = if changed.is_empty() {
                weights
            } else {
                changed.start.min(weights.start)..changed.end.max(weights.end)
            };
        }
        self.curve = curve.clone();
        self.redone = 0;
        if changed.is_empty() {
            return;
        }
        let new = &self.curve.polygon;
        let moved = &new.vertices()[changed.clone()];
        let planar = if self.planar {
            moved.iter().all(|vertex| vertex.z == 0.0)
        } else {
            new.is_planar()
        };
        if planar != self.planar {
            *self = Self::new(curve.clone(), self.orientation);
            return;
        }
        for range in dependent_segments(new, &changed) {
            self.sample(range);
        }
        self.update_clamped(changed);
    }

    /// Choose from where the curve is seen; what is drawn of it is made anew.
    pub fn set_orientation(&mut self, orientation: Orientation) {
        if self.orientation == orientation {
            return;
        }
        self.orientation = orientation;
        self.float.set_orientation(orientation);
        self.clamped.set_orientation(orientation);
        for index in 0..self.blocks.len() {
            self.blocks[index] = Block::default();
            self.summarise(index);
        }
    }

    /// The curve as it was last analysed.
    pub fn curve(&self) -> &Arc<Curve> {
        &self.curve
    }

    /// Whether the curve is planar, and its curvature therefore signed.
    pub fn is_planar(&self) -> bool {
        self.planar
    }

    /// The float S-polygon as it is drawn.
    pub fn float(&mut self) -> &mut VertexChain {
        &mut self.float
    }

    /// The closed S-polygon as it is drawn; of a periodic curve, opened at u = 0.
    pub fn clamped(&mut self) -> &mut VertexChain {
        &mut self.clamped
    }

    /// The closed S-polygon's vertices.
    pub fn clamped_vertices(&self) -> &[DVec3] {
        self.clamped.vertices()
    }

    /// The number of segments that the last update sampled.
    pub fn segments_redone(&self) -> usize {
        self.redone
    }

    /// The samples of one segment, its ends included, at even parameters.
    pub fn segment_samples(&self, segment: usize) -> &[Sample] {
        let first = segment * (self.steps + 1);
        self.samples
            .get(first..first + self.steps + 1)
            .unwrap_or_default()
    }

    /// Measure the arc length from the samples: to plotting accuracy, not the exact figure.
    pub fn length(&self) -> f64 {
        (0..self.blocks.len())
            .map(|index| self.summary(index).length)
            .sum()
    }

    /// Measure the arc length from the curve's start to u, to plotting accuracy.
    pub fn length_at(&self, u: f64) -> f64 {
        let (segment, t) = self.curve.polygon.locate(u);
        let block = segment / BLOCK;
        let before: f64 = (0..block).map(|index| self.summary(index).length).sum();
        before + self.length_in_block(segment, t)
    }

    /// Find the parameter at an arc length from the curve's start; the inverse of
    /// [`CurveAnalysis::length_at`].
    pub fn parameter_at_length(&self, length: f64) -> f64 {
        let mut left = length.max(0.0);
        let mut block = 0;
        while block + 1 < self.blocks.len() && self.summary(block).length < left {
            left -= self.summary(block).length;
            block += 1;
        }
        let last = self.curve.polygon.segments() - 1;
        let mut segment = block * BLOCK;
        while segment < last && self.segment_length(segment) < left {
            left -= self.segment_length(segment);
            segment += 1;
        }
        let samples = self.segment_samples(segment);
        let after = samples.partition_point(|sample| sample.arc_length < left);
        let (Some(b), Some(a)) = (samples.get(after), after.checked_sub(1)) else {
            return (segment + usize::from(after > 0)) as f64;
        };
        let step = b.arc_length - samples[a].arc_length;
        let share = if step > 0.0 {
            (left - samples[a].arc_length) / step
        } else {
            0.0
        };
        segment as f64 + (a as f64 + share) / self.steps as f64
    }

    /// The smallest and largest sampled curvature.
    pub fn curvature(&self) -> Option<Span> {
        let blocks = 0..self.blocks.len();
        let spans = blocks.filter_map(|index| self.summary(index).curvature);
        spans.reduce(Span::union)
    }

    /// The box around the curve, as it is seen.
    pub fn bounds(&self) -> Bounds {
        let mut all = Bounds::EMPTY;
        for index in 0..self.blocks.len() {
            all.unite(&self.summary(index).bounds);
        }
        all
    }

    /// Find the point of the curve that is seen nearest to `target`, if it is at most
    /// `reach` away: its parameter, place and distance. Sampled chords lead to it and Newton's
    /// method refines it.
    pub fn nearest(&self, target: DVec2, reach: f64) -> Option<(f64, DVec2, f64)> {
        let size = self.steps + 1;
        let mut best: Option<(f64, f64)> = None;
        for index in 0..self.blocks.len() {
            let BlockSummary {
                bounds, longest, ..
            } = *self.summary(index);
            if !(target.distance(target.clamp(bounds.low, bounds.high)) <= reach + longest) {
                continue;
            }
            for segment in self.block_segments(index) {
                let samples = &self.samples[segment * size..(segment + 1) * size];
                for (step, pair) in samples.windows(2).enumerate() {
                    let (from, to) = (self.seen(pair[0].point), self.seen(pair[1].point));
                    let chord = to - from;
                    let share =
                        ((target - from).dot(chord) / chord.length_squared()).clamp(0.0, 1.0);
                    let share = if share.is_nan() { 0.0 } else { share };
                    let distance = (from + share * chord).distance(target);
                    if best.is_none_or(|(nearest, _)| distance < nearest) {
                        let t = (step as f64 + share) / self.steps as f64;
                        best = Some((distance, segment as f64 + t));
                    }
                }
            }
        }
        let (_, u) = best?;
        let u = self.refined(u, target);
        let point = self.seen(self.curve.polygon.point(u));
        let distance = point.distance(target);
        (distance <= reach).then_some((u, point, distance))
    }

    /// Refine the parameter of the point that is seen nearest to `target`.
    fn refined(&self, start: f64, target: DVec2) -> f64 {
        let end = self.curve.polygon.segments() as f64;
        let step = 1.0 / self.steps as f64;
        let mut u = start;
        for _ in 0..8 {
            let jet = self.curve.polygon.jet(u);
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
        self.orientation.flatten(point)
    }

    pub(super) fn blocks(&self) -> usize {
        self.blocks.len()
    }

    pub(super) fn block_segments(&self, index: usize) -> Range<usize> {
        index * BLOCK..((index + 1) * BLOCK).min(self.curve.polygon.segments())
    }

    pub(super) fn plot_block(&mut self, index: usize) -> &mut PlotBlock {
        &mut self.blocks[index].plot
    }

    /// From where the curve is seen.
    pub fn orientation(&self) -> Orientation {
        self.orientation
    }

    pub(super) fn curve_features_known(&self) -> &CurveFeatures {
        &self.features
    }

    pub(super) fn curve_features(&mut self) -> &mut CurveFeatures {
        &mut self.features
    }

    pub(super) fn level_series(&mut self) -> &mut LevelSeries {
        &mut self.levels
    }

    pub(super) fn summary(&self, index: usize) -> &BlockSummary {
        &self.blocks[index].summary
    }

    fn summarise(&mut self, index: usize) {
        let range = self.block_segments(index);
        let samples = &self.samples[range.start * (self.steps + 1)..range.end * (self.steps + 1)];
        let mut bounds = Bounds::EMPTY;
        let mut longest: f64 = 0.0;
        for pair in samples.windows(2) {
            longest = longest.max(pair[0].point.distance_squared(pair[1].point));
        }
        for sample in samples {
            bounds.add(self.orientation.flatten(sample.point));
        }
        let mut length = 0.0;
        let mut starts = [0.0; BLOCK];
        for (start, segment) in starts.iter_mut().zip(range) {
            *start = length;
            length += self.segment_length(segment);
        }
        self.blocks[index].summary = BlockSummary {
            length,
            curvature: Span::of(samples.iter().map(|sample| sample.curvature)),
            bounds,
            longest: longest.sqrt(),
            starts,
        };
    }

    fn sample(&mut self, segments: Range<usize>) {
        let size = self.steps + 1;
        self.redone += segments.len();
        let blocks = segments.start / BLOCK..segments.end.div_ceil(BLOCK);
        for segment in segments {
            let samples = &mut self.samples[segment * size..(segment + 1) * size];
            self.sampler
                .fill(&self.curve.polygon, segment, self.planar, samples);
            self.features.forget(segment);
        }
        for block in blocks {
            self.blocks[block] = Block::default();
            self.levels.forget(block);
            self.summarise(block);
        }
    }

    /// Carry moved vertices over to the closed polygon: inner vertices are the same, and the
    /// n − 1 at either end are converted anew if they may have moved.
    fn update_clamped(&mut self, changed: Range<usize>) {
        let polygon = &self.curve.polygon;
        let (count, degree) = (polygon.vertices().len(), polygon.degree());
        let simple = !polygon.is_periodic() && !polygon.is_rational() && count > 4 * degree;
        if !simple {
            let clamped = ClampedPolygon::from_float(polygon);
            self.clamped.update(clamped.vertices(), false);
            return;
        }
        let near_end = changed.start < degree || changed.end > count - degree;
        let inner = changed.start.max(degree)..changed.end.min(count - degree);
        if !inner.is_empty() {
            self.clamped
                .replace(inner.start, &polygon.vertices()[inner]);
        }
        if near_end {
            let ends = [0..2 * degree, count - 2 * degree..count];
            for (range, keep_first) in ends.into_iter().zip([true, false]) {
                let vertices = polygon.vertices()[range.clone()].to_vec();
                let Ok(part) = FloatPolygon::new(degree, vertices, None, false) else {
                    continue;
                };
                let part = ClampedPolygon::from_float(&part);
                let (first, own) = if keep_first {
                    (0, &part.vertices()[..degree])
                } else {
                    (count - degree, &part.vertices()[degree..])
                };
                self.clamped.replace(first, own);
            }
        }
    }

    /// Measure from the start of a segment's block to the local parameter t.
    pub(super) fn length_in_block(&self, segment: usize, t: f64) -> f64 {
        self.summary(segment / BLOCK).starts[segment % BLOCK] + self.length_within(segment, t)
    }

    fn segment_length(&self, segment: usize) -> f64 {
        self.segment_samples(segment)
            .last()
            .map_or(0.0, |sample| sample.arc_length)
    }

    fn length_within(&self, segment: usize, t: f64) -> f64 {
        let samples = self.segment_samples(segment);
        let at = (t * self.steps as f64).clamp(0.0, self.steps as f64);
        let before = (at.floor() as usize).min(self.steps - 1);
        match samples.get(before..before + 2) {
            Some([a, b]) => a.arc_length + (at - before as f64) * (b.arc_length - a.arc_length),
            _ => 0.0,
        }
    }
}

/// List the segments that depend on the vertices of a range: one range, or two where a periodic
/// curve's segments wrap around.
fn dependent_segments(polygon: &FloatPolygon, changed: &Range<usize>) -> Vec<Range<usize>> {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    if !polygon.is_periodic() {
        let first = changed.start.saturating_sub(degree);
        return vec![first..changed.end.min(segments)];
    }
    if changed.len() + degree >= segments {
        return vec![0..segments];
    }
    match changed.start.checked_sub(degree) {
        Some(first) => vec![first..changed.end],
        None => {
            let wrapped = changed.start + segments - degree;
            vec![0..changed.end, wrapped..segments]
        }
    }
}
