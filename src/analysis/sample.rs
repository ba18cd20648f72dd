//! Samples of a curve, of which every layer is drawn.

use glam::DVec3;

use crate::geometry::references::Placement;
use crate::geometry::{EvenBatch, Jet, ParametricCurve};

/// Hold the point, normal and curvature at one parameter of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The point C(u).
    pub point: DVec3,
    /// The unit normal: to the left of a planar curve's tangent, towards the centre of curvature
    /// of a space curve; zero where there is none.
    pub normal: DVec3,
    /// The curvature: signed for planar curves, not negative in space; NaN at a cusp.
    pub curvature: f64,
    /// The arc length from the piece's start; over a leap there is none.
    pub arc_length: f64,
    /// Whether the curve leaps between the sample before and this one: through infinity, or over a
    /// jump of its formula.
    pub leaps: bool,
}

impl Sample {
    /// Derive a sample from a jet; the arc length is left at 0.
    pub fn of(jet: &Jet, planar: bool) -> Self {
        let tangent = jet.tangent();
        let (normal, curvature) = if planar {
            let left = |t: DVec3| DVec3::new(-t.y, t.x, 0.0);
            (tangent.map_or(DVec3::ZERO, left), jet.signed_curvature())
        } else {
            let binormal = jet.first.cross(jet.second);
            let normal = binormal.cross(jet.first).normalize_or_zero();
            (normal, jet.curvature())
        };
        Self {
            point: jet.point,
            normal,
            curvature: if curvature.is_finite() {
                curvature
            } else {
                f64::NAN
            },
            arc_length: 0.0,
            leaps: false,
        }
    }

    /// Place the sample of a curve that is not placed: as of a planar curve if `planar`, where the
    /// curvature changes its sign with the side that is up, otherwise as of a curve in space.
    pub(super) fn placed(&self, placement: &Placement, planar: bool) -> Self {
        let normal = placement.rotation() * self.normal;
        let curvature = self.curvature / placement.scale();
        let turned_over = (placement.rotation() * DVec3::Z).z < 0.0;
        let is_turned = if planar { turned_over } else { curvature < 0.0 };
        let (normal, curvature) = match is_turned {
            true => (-normal, -curvature),
            false => (normal, curvature),
        };
        Self {
            point: placement.point(self.point),
            normal,
            curvature,
            arc_length: placement.scale() * self.arc_length,
            leaps: self.leaps,
        }
    }

    /// Compute the centre of curvature, the evolute's point; not finite where κ = 0.
    pub fn centre(&self) -> DVec3 {
        self.point + self.normal / self.curvature
    }

    /// Compute the tip of the curvature comb's tooth: on the convex side, |κ|·`scale` long.
    pub fn comb_tip(&self, scale: f64) -> DVec3 {
        self.point - self.normal * (self.curvature * scale)
    }
}

/// Sample pieces at evenly spaced parameters, both of their ends included.
#[derive(Debug)]
pub struct PieceSampler {
    batch: EvenBatch,
}

impl PieceSampler {
    /// Prepare to divide pieces into so many steps, at least one.
    pub fn new(steps: usize) -> Self {
        Self {
            batch: EvenBatch::new(steps),
        }
    }

    /// The number of steps that a piece is divided into.
    pub fn steps(&self) -> usize {
        self.batch.steps()
    }

    /// Fill `samples` with one more than `steps` samples of one piece.
    ///
    /// Arc lengths come from Simpson's rule on each pair of steps, with the speeds at hand.
    pub fn fill(
        &mut self,
        curve: &dyn ParametricCurve,
        piece: usize,
        planar: bool,
        samples: &mut [Sample],
    ) {
        curve.fill_batch(piece, 2, &mut self.batch);
        let step = 1.0 / self.steps() as f64;
        let mut before = 0.0;
        let mut speeds = [0.0; 3];
        for (index, sample) in samples.iter_mut().enumerate() {
            let jet = self.batch.jet(index);
            *sample = Sample::of(&jet, planar);
            speeds = [speeds[1], speeds[2], jet.speed()];
            // A step's own share, by the parabola through three neighbouring speeds.
            let [far, near, here] = speeds;
            before += match index {
                0 => 0.0,
                1 => 0.5 * step * (near + here),
                _ => step * (5.0 * here + 8.0 * near - far) / 12.0,
            };
            sample.arc_length = before;
        }
        self.correct_first_step(step, samples);
    }

    /// The first step has no neighbour before it: redo it by the parabola through the first
    /// three speeds, and shift what follows.
    fn correct_first_step(&self, step: f64, samples: &mut [Sample]) {
        if self.steps() < 2 {
            return;
        }
        let speed = |index: usize| self.batch.jet(index).speed();
        let better = step * (5.0 * speed(0) + 8.0 * speed(1) - speed(2)) / 12.0;
        let shift = better - samples[1].arc_length;
        for sample in &mut samples[1..] {
            sample.arc_length += shift;
        }
    }
}
