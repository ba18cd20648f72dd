//! Curves given by their direction angle: the point is an integral.

use std::cell::RefCell;

use crate::geometry::coefficient::Coefficient;
use crate::geometry::power_series::PowerSeries;
use crate::geometry::quadrature::{quadrature, settled_quadrature};

/// The largest direction angle that is computed, a thousand turns: the first point takes time in proportion,
/// and more turns could not be told apart on any drawing.
pub(super) const MOST_TURNING: f64 = 1000.0 * std::f64::consts::TAU;

/// A direction may turn by so much between two knots of the quadrature, whose 16 points integrate
/// e^{iθ} over that to rounding.
const STEP: f64 = 4.0;

/// Error bound of the quadrature, relative to the length of the curve and to the direction angle, which is
/// itself rounded: less could not be told from rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

thread_local! {
    /// The integrals of the curve that this thread evaluated last: callers evaluate its points one after
    /// the other, and each is an integral from 0.
    static LAST: RefCell<Option<Integrals>> = const { RefCell::new(None) };
}

/// A curve among all: its kind and the values of its parameters.
pub(super) type Identity<'a> = (&'static str, &'a [f64]);

/// Integrate two functions of a curve, which are nowhere above 1 or below −1, from 0 to t. `angle` is how far the
/// direction of both together turns from 0 on; it rises or falls all along on either side of 0.
pub(super) fn integrated<T: Coefficient>(
    identity: Identity<'_>,
    t: T,
    angle: impl Fn(f64) -> f64,
    functions: impl Fn(f64) -> [f64; 2],
) -> [T; 2] {
    t.moving(|t| {
        // The rounding of each span, and once more of their sum.
        let error = 2.0 * ROUNDING * (1.0 + angle(t).abs()) * t.abs();
        (integrated_numbers(identity, t, &angle, &functions), error)
    })
}

fn integrated_numbers(
    (kind, values): Identity<'_>,
    t: f64,
    angle: &impl Fn(f64) -> f64,
    functions: &impl Fn(f64) -> [f64; 2],
) -> [f64; 2] {
    if t == 0.0 || !angle(t).is_finite() {
        return [0.0 * angle(t); 2];
    }
    LAST.with_borrow_mut(|last| {
        let same = |kept: &Integrals| kept.kind == kind && kept.values == values;
        let kept = last.take().filter(same);
        let kept = last.insert(kept.unwrap_or_else(|| Integrals::new((kind, values), angle)));
        kept.until(t, angle, functions)
    })
}

/// The integrals of a curve at knots, as far as they were needed. Where the knots lie depends on the curve
/// alone, so a point is the same to the bit whichever was evaluated before.
struct Integrals {
    kind: &'static str,
    values: Vec<f64>,
    /// The knots from 0 on, ahead and behind.
    sides: [Vec<Knot>; 2],
}

/// A parameter, the integrals from 0 to it, and where the next knot is.
struct Knot {
    at: f64,
    sum: [f64; 2],
    next: f64,
}

impl Integrals {
    fn new((kind, values): Identity<'_>, angle: &impl Fn(f64) -> f64) -> Self {
        let start = |sign| vec![Knot::new(0.0, [0.0; 2], sign, angle)];
        Self {
            kind,
            values: values.to_vec(),
            sides: [start(1.0), start(-1.0)],
        }
    }

    /// The integrals from 0 to t, after the knots on the way are known.
    fn until(
        &mut self,
        t: f64,
        angle: &impl Fn(f64) -> f64,
        functions: &impl Fn(f64) -> [f64; 2],
    ) -> [f64; 2] {
        let knots = &mut self.sides[usize::from(t < 0.0)];
        while let Some(last) = knots.last()
            && last.next.abs() <= t.abs()
            && last.next != last.at
        {
            let sum = last.continued(last.next, angle, functions);
            knots.push(Knot::new(last.next, sum, t.signum(), angle));
        }
        let count = knots.partition_point(|knot| knot.at.abs() <= t.abs());
        let before = count.checked_sub(1).and_then(|index| knots.get(index));
        before.map_or([f64::NAN; 2], |knot| knot.continued(t, angle, functions))
    }
}

impl Knot {
    fn new(at: f64, sum: [f64; 2], sign: f64, angle: &impl Fn(f64) -> f64) -> Self {
        let next = at + sign * span(at, sign, angle);
        Self { at, sum, next }
    }

    /// The integrals from 0 to t.
    fn continued(
        &self,
        t: f64,
        angle: &impl Fn(f64) -> f64,
        functions: &impl Fn(f64) -> [f64; 2],
    ) -> [f64; 2] {
        let whole = quadrature(self.at, t, functions);
        let allowed = [ROUNDING * (1.0 + angle(t).abs()) * (t - self.at).abs(); 2];
        let part = settled_quadrature([self.at, t], whole, allowed, functions).values;
        [self.sum[0] + part[0], self.sum[1] + part[1]]
    }
}

/// The largest power of 2 within which the direction turns by at most [`STEP`] from a parameter on.
fn span(from: f64, sign: f64, angle: &impl Fn(f64) -> f64) -> f64 {
    let start = angle(from);
    let is_small = |span: f64| (angle(from + sign * span) - start).abs() <= STEP;
    let mut span = 1.0;
    while is_small(2.0 * span) && span < f64::MAX / 4.0 {
        span *= 2.0;
    }
    while !is_small(span) && span > 0.0 {
        span *= 0.5;
    }
    span
}

/// Expand a planar curve of speed 1 that starts at the origin along the x axis: C′ = (cos θ, sin θ),
/// θ(0) = 0. `t` is the series of its parameter, `expansion` that of θ, to the same order or one less.
pub(super) fn unit_speed<T: Coefficient>(
    identity: Identity<'_>,
    t: &PowerSeries<T>,
    angle: impl Fn(f64) -> f64,
    expansion: &PowerSeries<T>,
) -> [PowerSeries<T>; 2] {
    let direction = |s: f64| {
        let (sine, cosine) = angle(s).sin_cos();
        [cosine, sine]
    };
    let [x, y] = integrated(identity, t.value(), &angle, direction);
    let (sine, cosine) = expansion.sin_cos();
    [
        cosine.antiderivative(x, t.order()),
        sine.antiderivative(y, t.order()),
    ]
}
