//! The half of a curve that its mirror image completes: which one it is, and how it is cut out.

use super::error::OperationError;
use crate::geometry::approximation::merging::{MergeError, check_joint, joint_of};
use crate::geometry::{End, FloatPolygon, Joint, Mirror, arc_length_between};

/// A part of an open curve beyond the axis is an overshoot up to this share of the rest: a half that was drawn a little
/// too far. Of a longer one nobody knows which half is meant.
const OVERSHOOT: f64 = 0.1;

/// The relative precision of lengths that are compared with that.
const PRECISION: f64 = 1e-3;

/// How often segments are halved at most where the curve is cut.
const HALVINGS: u32 = 6;

/// The samples of a segment among which the curve crosses the mirror plane.
pub(super) const SAMPLES: usize = 32;

/// Which half is kept.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Half {
    First,
    Second,
}

impl Half {
    /// The end of the half at the mirror plane.
    pub(super) fn inner(self) -> End {
        match self {
            Self::First => End::Finish,
            Self::Second => End::Start,
        }
    }

    /// The shares of the half that stay without one next to the mirror plane.
    pub(super) fn kept(self, without: f64) -> [f64; 2] {
        match self.inner() {
            End::Start => [without, 1.0],
            End::Finish => [0.0, 1.0 - without],
        }
    }

    /// A half and its image in the order of the whole.
    pub(super) fn in_order<T>(self, half: T, image: T) -> [T; 2] {
        match self {
            Self::First => [half, image],
            Self::Second => [image, half],
        }
    }
}

/// The half that is kept, with its image.
pub(super) struct KeptHalf {
    pub(super) half: Half,
    /// The parameters of the curve between which it lies.
    pub(super) span: [f64; 2],
    pub(super) part: FloatPolygon,
    image: FloatPolygon,
    /// How far the part is off the curve.
    pub(super) off: f64,
}

impl KeptHalf {
    /// Cut a half out of a curve, as near as asked for or as halvings of segments bring it.
    pub(super) fn new(
        polygon: &FloatPolygon,
        (half, span): (Half, [f64; 2]),
        mirror: &Mirror,
        within: f64,
    ) -> Result<Self, OperationError> {
        let (part, off) = cut(polygon, span, within)?;
        Ok(Self {
            half,
            span,
            image: image(&part, mirror)?,
            part,
            off,
        })
    }

    /// The half without the share that is next to the mirror plane.
    pub(super) fn receded(
        &self,
        share: f64,
        mirror: &Mirror,
        within: f64,
    ) -> Result<Self, OperationError> {
        let kept = self.half.kept(share);
        let span = kept.map(|share| share * self.part.segments() as f64);
        Self::new(&self.part, (self.half, span), mirror, within)
    }

    /// The half and its image in the order of the whole.
    pub(super) fn parts(&self) -> [&FloatPolygon; 2] {
        self.half.in_order(&self.part, &self.image)
    }

    /// How the half goes on into its image.
    pub(super) fn joint(&self) -> Joint {
        let [first, second] = self.parts();
        joint_of(first, second)
    }

    /// The end at the mirror plane.
    pub(super) fn inner(&self) -> End {
        self.half.inner()
    }
}

/// The half of a shape that an open curve is, where it goes on beyond the mirror plane by no more than an overshoot.
pub(super) fn drawn_half(polygon: &FloatPolygon, crossings: &[f64]) -> Option<(Half, [f64; 2])> {
    if polygon.is_periodic() || crossings.is_empty() {
        return None;
    }
    let last = polygon.segments() as f64;
    let places: Vec<f64> = [&[0.0], crossings, &[last]].concat();
    let parts = places.windows(2).map(|part| [part[0], part[1]]);
    let parts = parts.map(|[from, to]| {
        let length = arc_length_between(polygon, from, to, PRECISION);
        (length, [from, to])
    });
    let parts: Vec<(f64, [f64; 2])> = parts.collect();
    let whole: f64 = parts.iter().map(|(length, _)| length).sum();
    let longest = parts.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let (length, span) = longest?;
    let half = match span[0] == 0.0 {
        true => Half::First,
        false => Half::Second,
    };
    (whole - length <= OVERSHOOT * length).then_some((half, span))
}

/// The half that a curve on one side of the mirror plane is: inside is the end that goes on into its image, or else that
/// which meets it at the smaller corner; where both do, or none comes near, the nearer one.
pub(super) fn one_side(
    polygon: &FloatPolygon,
    mirror: &Mirror,
    tolerance: f64,
) -> Result<Half, OperationError> {
    let image = image(polygon, mirror)?;
    let [first, second] = [Half::First, Half::Second].map(|half| {
        let [before, after] = half.in_order(polygon, &image);
        let height = mirror.height(polygon.end_jet(half.inner()).point);
        let height = height.unwrap_or(0.0).abs();
        match check_joint(joint_of(before, after), polygon.size(), tolerance) {
            Ok(()) => (0, height),
            Err(MergeError::Corner { angle, .. }) => (1, angle),
            Err(_) => (2, height),
        }
    });
    Ok(match second < first {
        true => Half::Second,
        false => Half::First,
    })
}

/// The parameters at which a curve crosses the mirror plane, in their order; none where it stays within the tolerance on
/// one side.
pub(super) fn crossings(polygon: &FloatPolygon, mirror: &Mirror, tolerance: f64) -> Vec<f64> {
    let last = polygon.segments() as f64;
    let inside = |u: f64| {
        if u >= last && polygon.is_periodic() {
            u - last
        } else {
            u
        }
    };
    let height = |u: f64| mirror.height(polygon.point(inside(u))).unwrap_or(0.0);
    let samples = 0..=polygon.segments() * SAMPLES;
    let heights = samples.map(|sample| sample as f64 / SAMPLES as f64);
    let heights = heights.map(|u| (u, height(u)));
    let heights: Vec<(f64, f64)> = heights.filter(|(_, at)| at.abs() > tolerance).collect();
    // A closed curve goes on from its end to its start.
    let over_the_joint = heights.first().filter(|_| polygon.is_periodic());
    let over_the_joint = over_the_joint.map(|(u, at)| (u + last, *at));
    let walked: Vec<(f64, f64)> = heights.iter().copied().chain(over_the_joint).collect();
    let crossed = walked.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0);
    let crossings = crossed.map(|pair| inside(bisected([pair[0].0, pair[1].0], pair[0].1, height)));
    let mut crossings: Vec<f64> = crossings.collect();
    crossings.sort_by(f64::total_cmp);
    crossings
}

/// The place between two at which the height, `below` at the first, changes its sign.
fn bisected([mut from, mut to]: [f64; 2], below: f64, height: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to {
            return middle;
        }
        match height(middle) * below > 0.0 {
            true => from = middle,
            false => to = middle,
        }
    }
}

/// Cut a part out of a curve, and say how far off it is: as near as asked for, or as halvings of segments bring it.
fn cut(
    polygon: &FloatPolygon,
    [from, to]: [f64; 2],
    within: f64,
) -> Result<(FloatPolygon, f64), OperationError> {
    if [from, to] == [0.0, polygon.segments() as f64] {
        return Ok((polygon.clone(), 0.0));
    }
    let mut part = polygon.trimmed(from, to, 0)?;
    for halvings in 1..=HALVINGS {
        if part.exact || part.deviation <= within {
            break;
        }
        part = polygon.trimmed(from, to, halvings)?;
    }
    let off = if part.exact { 0.0 } else { part.deviation };
    Ok((part.polygon, off))
}

/// The mirror image of a part, in the direction in which it goes on from it.
fn image(part: &FloatPolygon, mirror: &Mirror) -> Result<FloatPolygon, OperationError> {
    let vertices = part.vertices().iter().rev();
    let vertices = vertices.map(|it| mirror.point(*it)).collect();
    let weights = part.weights();
    let weights = weights.map(|weights| weights.iter().rev().copied().collect());
    Ok(FloatPolygon::new(part.degree(), vertices, weights, false)?)
}
