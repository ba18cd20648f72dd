//! The true segment: one reference curve, or several that follow each other.

use glam::DVec3;

use crate::geometry::differentiable::Differentiable;
use crate::geometry::quadrature::{quadrature, settled_quadrature};
use crate::geometry::references::ReferenceCurve;

/// Relative rounding error of a curvature.
const ROUNDING: f64 = 1e-9;

/// Relative precision of integrated lengths.
const EXACT: f64 = 1e-12;

/// A reference curve, or a piece of one, and which way it is passed through.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The curve.
    pub curve: ReferenceCurve,
    /// Whether it is passed through from its end to its start.
    pub reversed: bool,
}

/// Parts that follow each other, by one parameter: that of each times its scale, so arc length
/// where theirs is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parts {
    pub(super) parts: Vec<Part>,
    /// The start of each.
    begins: Vec<f64>,
    /// The end of the last.
    pub(super) end: f64,
}

impl Parts {
    /// Put parts one after the other.
    pub(super) fn new(parts: Vec<Part>) -> Self {
        let mut end = 0.0;
        let mut begins = Vec::new();
        for part in &parts {
            let [from, to] = part.curve.interval();
            begins.push(end);
            end += part.curve.placement().scale() * (to - from);
        }
        Self { parts, begins, end }
    }

    /// The signed curvature at a parameter.
    pub(super) fn curvature(&self, t: f64) -> f64 {
        match self.derivatives(t, 2)[..] {
            [_, first, second] => {
                first.truncate().perp_dot(second.truncate()) / first.length().powi(3)
            }
            _ => f64::NAN,
        }
    }

    /// Whether it is a circular arc: the curvatures at the ends, between which it is monotone, are equal
    /// but for rounding.
    pub(super) fn is_arc(&self) -> bool {
        let [first, last] = [0.0, self.end].map(|t| self.curvature(t));
        (first - last).abs() <= ROUNDING * first.abs()
    }

    /// The length of all together, along the true segment.
    pub(super) fn length(&self) -> f64 {
        let speed = |t: f64| [self.derivatives(t, 1)[1].length()];
        let spans = self
            .begins
            .iter()
            .zip(self.begins.iter().skip(1).chain([&self.end]));
        let lengths = spans.map(|(from, to)| {
            let first = quadrature(*from, *to, &speed);
            let allowed = first.map(|length| EXACT * length);
            let [length] = settled_quadrature([*from, *to], first, allowed, &speed).values;
            length
        });
        lengths.sum()
    }
}

impl Differentiable for Parts {
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        let later = self.begins.iter().rposition(|begin| *begin <= t);
        let index = later.unwrap_or(0);
        let (Some(part), Some(begin)) = (self.parts.get(index), self.begins.get(index)) else {
            return vec![DVec3::NAN; order + 1];
        };
        let [from, to] = part.curve.interval();
        let scale = part.curve.placement().scale();
        let done = (t - begin) / scale;
        let (own, rate) = if part.reversed {
            (to - done, -1.0 / scale)
        } else {
            (from + done, 1.0 / scale)
        };
        let mut values = part.curve.derivatives(own, order);
        let mut factor = 1.0;
        for value in &mut values {
            *value *= factor;
            factor *= rate;
        }
        values
    }
}
