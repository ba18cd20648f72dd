//! Samples of a curve: what every drawn layer is made of.

use glam::{DVec2, DVec3};

use super::outline::GAP;
use crate::geometry::{Batch, FloatPolygon, Jet, Sampler};

/// Hold what is drawn at one parameter of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The point C(u).
    pub point: DVec3,
    /// The unit normal: to the left of a planar curve's tangent, towards the centre of curvature
    /// of a space curve; zero where there is none.
    pub normal: DVec3,
    /// The curvature: signed for planar curves, not negative in space; NaN at a cusp.
    pub curvature: f64,
    /// The arc length from the segment's start.
    pub arc_length: f64,
}

impl Sample {
    /// Derive what is drawn from a jet; the arc length is left at 0.
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

/// Sample segments at evenly spaced parameters, both of their ends included.
#[derive(Debug)]
pub(super) struct SegmentSampler {
    sampler: Sampler,
    batch: Batch,
    count: usize,
}

impl SegmentSampler {
    pub(super) fn new(degree: usize, count: usize) -> Self {
        Self {
            sampler: Sampler::even(degree, count),
            batch: Batch::default(),
            count,
        }
    }

    /// The number of steps that a segment is divided into.
    pub(super) fn steps(&self) -> usize {
        self.count
    }

    /// Fill `samples` with `count` + 1 samples of one segment.
    ///
    /// Arc lengths come from Simpson's rule on each pair of steps, with the speeds at hand.
    pub(super) fn fill(
        &mut self,
        polygon: &FloatPolygon,
        segment: usize,
        planar: bool,
        samples: &mut [Sample],
    ) {
        self.sampler.segment(polygon, segment, 2, &mut self.batch);
        let step = 1.0 / self.count as f64;
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
        self.mend_first_step(step, samples);
    }

    /// The first step has no neighbour before it: redo it by the parabola through the first
    /// three speeds, and shift what follows.
    fn mend_first_step(&self, step: f64, samples: &mut [Sample]) {
        if self.count < 2 {
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

/// Turn samples into a chain of points with a gap wherever the curvature changes sign, if the
/// points follow the curvature through infinity there.
pub(super) fn chain(
    samples: &[Sample],
    place: impl Fn(&Sample) -> DVec2 + Copy,
) -> impl Iterator<Item = DVec2> {
    let mut before: Option<&Sample> = None;
    samples.iter().flat_map(move |sample| {
        let point = place(sample);
        let gap = before.is_some_and(|before| {
            turned(before, sample) && leaps(place(before), point, before, sample)
        });
        before = Some(sample);
        gap.then_some(GAP).into_iter().chain([point])
    })
}

/// Whether the curve turns to its other side between two samples.
pub(super) fn turned(a: &Sample, b: &Sample) -> bool {
    a.curvature * b.curvature < 0.0 || a.normal.dot(b.normal) < 0.0
}

/// Whether a layer's points leap between two samples: it moves farther than the curve itself by
/// an order of magnitude.
pub(super) fn leaps(from: DVec2, to: DVec2, a: &Sample, b: &Sample) -> bool {
    from.distance_squared(to) > 400.0 * a.point.distance_squared(b.point)
}

/// Turn a point that is not finite into a gap.
pub(super) fn finite(point: DVec2) -> DVec2 {
    if point.is_finite() { point } else { GAP }
}
