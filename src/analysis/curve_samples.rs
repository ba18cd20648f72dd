//! A parametric curve by its samples, block by block.

use std::ops::Range;

use glam::DVec3;

use super::leaps;
use super::revision::Revision;
use super::sample::{PieceSampler, Sample};
use crate::geometry::references::Placement;
use crate::geometry::{ParametricCurve, Range as Span, bounds};

/// Pieces in one block.
pub(super) const BLOCK: usize = 32;

/// The samples of a whole curve, shared evenly by its pieces …
const SAMPLES: usize = 4096;

/// … but never fewer or more than these a piece.
const SAMPLES_PER_PIECE: Range<usize> = 4..256;

/// Hold the samples of a curve at even parameters, and figures of them for each block of pieces.
#[derive(Debug)]
pub struct CurveSamples {
    planar: bool,
    pieces: usize,
    samples: Vec<Sample>,
    sampler: PieceSampler,
    blocks: Vec<Block>,
}

/// A curve with its samples, which plots, outlines and hit tests read.
#[derive(Clone, Copy)]
pub struct SampledCurve<'a> {
    /// The curve.
    pub curve: &'a dyn ParametricCurve,
    /// Its samples.
    pub samples: &'a CurveSamples,
}

/// Figures of one block's samples.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Changes when the block is sampled again.
    pub revision: Revision,
    /// The arc length.
    pub length: f64,
    /// The longest step between two samples.
    pub longest_step: f64,
    /// The smallest and largest sampled curvature.
    pub curvature: Option<Span>,
    /// Opposite corners of the box around the samples.
    corners: [DVec3; 2],
    /// The arc length from the block's start to each piece's.
    starts: [f64; BLOCK],
}

impl CurveSamples {
    /// Sample a whole curve.
    pub fn new(curve: &dyn ParametricCurve) -> Self {
        Self::with_about(SAMPLES, curve)
    }

    /// Sample a whole curve with about so many samples, as far as its pieces allow.
    pub(super) fn with_about(count: usize, curve: &dyn ParametricCurve) -> Self {
        let pieces = curve.pieces();
        let share = (count / pieces).next_power_of_two();
        let steps = share.clamp(SAMPLES_PER_PIECE.start, SAMPLES_PER_PIECE.end);
        let blank = Sample::of(&Default::default(), true);
        let empty = Block {
            revision: Revision::new(),
            length: 0.0,
            longest_step: 0.0,
            curvature: None,
            corners: [DVec3::ZERO; 2],
            starts: [0.0; BLOCK],
        };
        let mut samples = Self {
            planar: curve.is_planar(),
            pieces,
            samples: vec![blank; (steps + 1) * pieces],
            sampler: PieceSampler::new(steps),
            blocks: vec![empty; pieces.div_ceil(BLOCK)],
        };
        samples.redo(curve, 0..pieces);
        samples
    }

    /// Sample some pieces again, of a curve that has as many pieces as before and is planar if it
    /// was.
    pub fn redo(&mut self, curve: &dyn ParametricCurve, pieces: Range<usize>) {
        let size = self.steps() + 1;
        for piece in pieces.clone() {
            let samples = &mut self.samples[piece * size..(piece + 1) * size];
            self.sampler.fill(curve, piece, self.planar, samples);
        }
        let revision = Revision::new();
        for block in pieces.start / BLOCK..pieces.end.div_ceil(BLOCK) {
            self.blocks[block] = self.summary(block, revision);
        }
    }

    /// Free the room in which pieces are sampled, for a curve that hardly changes.
    pub(super) fn free_room(&mut self) {
        self.sampler = PieceSampler::new(self.steps());
    }

    /// Mark where a curve leaps that a formula gives: all else is continuous.
    pub(super) fn mark_leaps(&mut self, curve: &dyn ParametricCurve) {
        let size = self.steps() + 1;
        for (piece, samples) in self.samples.chunks_mut(size).enumerate() {
            leaps::mark(curve, piece, samples);
        }
        leaps::shorten(&mut self.samples, size);
        let revision = Revision::new();
        for block in 0..self.blocks.len() {
            self.blocks[block] = self.summary(block, revision);
        }
    }

    /// Place the samples of a curve that is not placed. `planar` is whether it lies in the plane z = 0
    /// then, which only a planar curve does.
    pub(super) fn placed(&self, placement: &Placement, planar: bool) -> Self {
        let samples = self.samples.iter();
        let samples = samples.map(|sample| sample.placed(placement, planar));
        let mut placed = Self {
            planar,
            pieces: self.pieces,
            samples: samples.collect(),
            sampler: PieceSampler::new(self.steps()),
            blocks: self.blocks.clone(),
        };
        let revision = Revision::new();
        for block in 0..placed.blocks.len() {
            placed.blocks[block] = placed.summary(block, revision);
        }
        placed
    }

    /// Whether the curve is planar, and its curvature therefore signed.
    pub fn is_planar(&self) -> bool {
        self.planar
    }

    /// The number of pieces.
    pub fn pieces(&self) -> usize {
        self.pieces
    }

    /// Steps that each piece is sampled with; it has one sample more.
    pub fn steps(&self) -> usize {
        self.sampler.steps()
    }

    /// The samples of one piece, its ends included, at even parameters.
    pub fn piece(&self, piece: usize) -> &[Sample] {
        let size = self.steps() + 1;
        let own = piece * size..(piece + 1) * size;
        self.samples.get(own).unwrap_or_default()
    }

    /// The samples of the pieces of one block.
    pub fn block(&self, block: usize) -> &[Sample] {
        let (pieces, size) = (self.block_pieces(block), self.steps() + 1);
        let own = pieces.start * size..pieces.end * size;
        self.samples.get(own).unwrap_or_default()
    }

    /// The samples of all pieces.
    pub fn all(&self) -> &[Sample] {
        &self.samples
    }

    /// The blocks.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The pieces of one block.
    pub fn block_pieces(&self, block: usize) -> Range<usize> {
        block * BLOCK..((block + 1) * BLOCK).min(self.pieces)
    }

    /// Whether the curve leaps nowhere.
    pub fn is_continuous(&self) -> bool {
        self.samples.iter().all(|sample| !sample.leaps)
    }

    /// The longest side of the box around the curve, by its samples.
    pub fn extent(&self) -> f64 {
        let (low, high) = bounds(self.blocks.iter().flat_map(|block| block.corners));
        (high - low).max_element()
    }

    /// Measure the arc length, without leaps and the far ways to and from them: to plotting accuracy, not the
    /// exact figure.
    pub fn length(&self) -> f64 {
        self.blocks.iter().map(|block| block.length).sum()
    }

    /// Find the parameter at an arc length from the curve's start; the inverse of
    /// [`SampledCurve::length_at`].
    pub fn parameter_at_length(&self, length: f64) -> f64 {
        let mut left = length.max(0.0);
        let mut block = 0;
        while block + 1 < self.blocks.len() && self.blocks[block].length < left {
            left -= self.blocks[block].length;
            block += 1;
        }
        let last = self.pieces - 1;
        let mut piece = block * BLOCK;
        while piece < last && self.piece_length(piece) < left {
            left -= self.piece_length(piece);
            piece += 1;
        }
        let samples = self.piece(piece);
        let after = samples.partition_point(|sample| sample.arc_length < left);
        let (Some(b), Some(a)) = (samples.get(after), after.checked_sub(1)) else {
            return (piece + usize::from(after > 0)) as f64;
        };
        let step = b.arc_length - samples[a].arc_length;
        let share = if step > 0.0 {
            (left - samples[a].arc_length) / step
        } else {
            0.0
        };
        piece as f64 + (a as f64 + share) / self.steps() as f64
    }

    /// The smallest and largest sampled curvature.
    pub fn curvature(&self) -> Option<Span> {
        let spans = self.blocks.iter().filter_map(|block| block.curvature);
        spans.reduce(Span::union)
    }

    /// Measure from the start of a piece's block to the local parameter t.
    pub(super) fn length_in_block(&self, piece: usize, t: f64) -> f64 {
        self.blocks[piece / BLOCK].starts[piece % BLOCK] + self.length_within(piece, t)
    }

    fn summary(&self, block: usize, revision: Revision) -> Block {
        let samples = self.block(block);
        let mut longest: f64 = 0.0;
        for pair in samples.windows(2).filter(|pair| !pair[1].leaps) {
            longest = longest.max(pair[0].point.distance_squared(pair[1].point));
        }
        let mut length = 0.0;
        let mut starts = [0.0; BLOCK];
        for (start, piece) in starts.iter_mut().zip(self.block_pieces(block)) {
            *start = length;
            length += self.piece_length(piece);
        }
        let points = samples.iter().map(|sample| sample.point);
        Block {
            revision,
            length,
            longest_step: longest.sqrt(),
            curvature: Span::of(samples.iter().map(|sample| sample.curvature)),
            corners: bounds(points.filter(|point| point.is_finite())).into(),
            starts,
        }
    }

    fn piece_length(&self, piece: usize) -> f64 {
        self.piece(piece)
            .last()
            .map_or(0.0, |sample| sample.arc_length)
    }

    fn length_within(&self, piece: usize, t: f64) -> f64 {
        let (samples, steps) = (self.piece(piece), self.steps());
        let at = (t * steps as f64).clamp(0.0, steps as f64);
        let before = (at.floor() as usize).min(steps - 1);
        match samples.get(before..before + 2) {
            Some([a, b]) => a.arc_length + (at - before as f64) * (b.arc_length - a.arc_length),
            _ => 0.0,
        }
    }
}

impl SampledCurve<'_> {
    /// Measure the arc length from the curve's start to u, to plotting accuracy.
    pub fn length_at(&self, u: f64) -> f64 {
        let (piece, t) = self.curve.locate(u);
        let before = &self.samples.blocks()[..piece / BLOCK];
        let before: f64 = before.iter().map(|block| block.length).sum();
        before + self.samples.length_in_block(piece, t)
    }
}
