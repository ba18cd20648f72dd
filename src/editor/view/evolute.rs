//! The evolute as a chain of points, refined where it runs much faster than the curve.

use glam::DVec2;

use crate::analysis::Sample;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{Bounds, GAP, ViewBox};
use crate::editor::view::sample_chain::{finite, leaps, turned};
use crate::geometry::ParametricCurve;

/// How often a step between two samples is halved at most.
const DEEPEST: u32 = 7;

/// The inputs of an evolute.
pub struct Evolute<'a> {
    pub curve: &'a dyn ParametricCurve,
    pub planar: bool,
    pub eye: Orientation,
    /// Steps whose ends are seen farther apart than this are halved …
    pub longest_chord: f64,
    /// … if one of them is nearer to the curve than this.
    pub reach: f64,
}

/// The evolute is hidden where its lines cover more than this share of the view, until they cover less than the other.
const COVERS: [f64; 2] = [1.0 / 3.0, 0.25];

/// Whether an evolute that would cover much of the view is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EvoluteCrowd {
    /// Whether it is drawn nevertheless.
    pub is_wanted: bool,
    /// Whether it is hidden now.
    pub is_hidden: bool,
}

impl EvoluteCrowd {
    /// Hide the lines of an evolute, as wide as a screen point, if they cover too much of the view.
    pub fn hide(&mut self, lines: &mut Vec<DVec2>, view: &ViewBox) {
        let pairs = lines
            .windows(2)
            .filter(|pair| pair.iter().all(|it| it.is_finite()));
        let length: f64 = pairs.map(|pair| view.seen_length(pair[0], pair[1])).sum();
        let sides = view.high - view.low;
        let most = COVERS[usize::from(self.is_hidden)];
        self.is_hidden = !self.is_wanted && length * view.pixel > most * sides.x * sides.y;
        if self.is_hidden {
            lines.clear();
        }
    }
}

/// A sample with its parameter on a piece.
type Place<'a> = (f64, &'a Sample);

impl Evolute<'_> {
    /// Append the evolute of one piece that is sampled at even parameters; with a view, only
    /// what is near it is followed closely.
    pub fn append(
        &self,
        piece: usize,
        samples: &[Sample],
        near: Option<&ViewBox>,
        out: &mut Vec<DVec2>,
    ) {
        let steps = samples.len().saturating_sub(1).max(1) as f64;
        let Some(first) = samples.first() else {
            return;
        };
        // Where the curvature jumps at a joint, so does the evolute.
        if self.curve.continuity() < 2 {
            out.push(GAP);
        }
        out.push(self.place(first));
        for (number, pair) in samples.windows(2).enumerate() {
            let at = |offset: usize| (number + offset) as f64 / steps;
            if pair[1].leaps {
                out.push(GAP);
                out.push(self.place(&pair[1]));
                continue;
            }
            let ends = [(at(0), &pair[0]), (at(1), &pair[1])];
            self.follow(piece, ends, (near, DEEPEST), out);
            out.push(self.place(&pair[1]));
        }
    }

    /// Append the points between the ends of a step along a piece, which is halved so many times at most.
    fn follow(
        &self,
        piece: usize,
        [start, end]: [Place<'_>; 2],
        (near, halvings): (Option<&ViewBox>, u32),
        out: &mut Vec<DVec2>,
    ) {
        let (from, to) = (self.place(start.1), self.place(end.1));
        let turns = turned(start.1, end.1);
        let is_short = from.distance(to) <= self.longest_chord;
        let is_far = |sample: &Sample| !(sample.curvature.abs() * self.reach >= 1.0);
        let leaves = is_far(start.1) && is_far(end.1);
        let is_aside = near.is_some_and(|view| {
            let mut bounds = Bounds::EMPTY;
            bounds.add(from);
            bounds.add(to);
            !bounds.may_meet(view)
        });
        if (is_short && !turns) || leaves || is_aside || halvings == 0 {
            if turns && leaps(from, to, start.1, end.1) {
                out.push(GAP);
            }
            return;
        }
        let t = 0.5 * (start.0 + end.0);
        let jet = self.curve.piece_jet(piece, t);
        let middle = Sample::of(&jet, self.planar);
        self.follow(piece, [start, (t, &middle)], (near, halvings - 1), out);
        out.push(self.place(&middle));
        self.follow(piece, [(t, &middle), end], (near, halvings - 1), out);
    }

    /// The evolute's point that belongs to a sample; a gap where it is straight.
    pub fn place(&self, sample: &Sample) -> DVec2 {
        finite(self.eye.flatten(sample.centre()))
    }
}
