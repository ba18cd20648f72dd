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

/// A step along one piece, by the samples at its ends and their parameters.
struct Step<'a> {
    piece: usize,
    from: (f64, &'a Sample),
    to: (f64, &'a Sample),
    depth: u32,
    near: Option<&'a ViewBox>,
}

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
            self.follow(
                Step {
                    piece,
                    from: (at(0), &pair[0]),
                    to: (at(1), &pair[1]),
                    depth: 0,
                    near,
                },
                out,
            );
            out.push(self.place(&pair[1]));
        }
    }

    /// Append the points between the ends of a step.
    fn follow(&self, step: Step<'_>, out: &mut Vec<DVec2>) {
        let (from, to) = (self.place(step.from.1), self.place(step.to.1));
        let turns = turned(step.from.1, step.to.1);
        let is_short = from.distance(to) <= self.longest_chord;
        let is_far = |sample: &Sample| !(sample.curvature.abs() * self.reach >= 1.0);
        let leaves = is_far(step.from.1) && is_far(step.to.1);
        let is_aside = step.near.is_some_and(|view| {
            let mut bounds = Bounds::EMPTY;
            bounds.add(from);
            bounds.add(to);
            !bounds.may_meet(view)
        });
        if (is_short && !turns) || leaves || is_aside || step.depth == DEEPEST {
            if turns && leaps(from, to, step.from.1, step.to.1) {
                out.push(GAP);
            }
            return;
        }
        let t = 0.5 * (step.from.0 + step.to.0);
        let jet = self.curve.piece_jet(step.piece, t);
        let middle = Sample::of(&jet, self.planar);
        let depth = step.depth + 1;
        self.follow(
            Step {
                to: (t, &middle),
                depth,
                ..step
            },
            out,
        );
        out.push(self.place(&middle));
        self.follow(
            Step {
                from: (t, &middle),
                depth,
                ..step
            },
            out,
        );
    }

    /// The evolute's point that belongs to a sample; a gap where it is straight.
    pub fn place(&self, sample: &Sample) -> DVec2 {
        finite(self.eye.flatten(sample.centre()))
    }
}
