//! Narrowing an interval that holds one root.

use std::cmp::Ordering;

use super::variations::certain_sign;

/// Lag of the secant behind bisection that forces a bisection: half of 2⁵, five steps.
const LEAD: f64 = 16.0;

/// Hold an interval at whose ends a function has opposite signs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    /// The interval.
    pub(super) ends: [f64; 2],
    /// Approximate values at both ends; 0 where an end is a root itself.
    pub(super) values: [f64; 2],
    /// The sign behind the first end.
    pub(super) sign: i8,
}

/// Narrow an interval that holds one simple root to the width `target`, or as far as signs can
/// be told.
///
/// `evaluate` gives a value and its error bound. The steps are those of the ITP method
/// (Oliveira, Takahashi, 2020): never more than five above bisection's number, and few where
/// the function is nearly linear.
pub(super) fn refine(
    mut bracket: Bracket,
    target: f64,
    evaluate: impl Fn(f64) -> (f64, f64),
) -> [f64; 2] {
    let [low, high] = bracket.ends;
    // A multiple of the interval that bisection would have reached by now: it is not exceeded.
    let mut slack = LEAD * (high - low);
    while bracket.width() > target {
        let t = bracket.next(slack - 0.5 * bracket.width(), target);
        slack *= 0.5;
        if !bracket.cut(t, evaluate(t)) {
            bracket.enclose(t, target, &evaluate);
            break;
        }
    }
    bracket.ends
}

/// Narrow an interval to neighbouring doubles about the place that `side` compares a place with,
/// or to that place itself.
pub(super) fn bisect([mut low, mut high]: [f64; 2], side: impl Fn(f64) -> Ordering) -> [f64; 2] {
    loop {
        let middle = low + 0.5 * (high - low);
        if !(low < middle && middle < high) {
            return [low, high];
        }
        match side(middle) {
            Ordering::Less => low = middle,
            Ordering::Equal => return [middle; 2],
            Ordering::Greater => high = middle,
        }
    }
}

impl Bracket {
    fn width(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// Choose where to evaluate next, at most `leeway` from the middle.
    fn next(&self, leeway: f64, target: f64) -> f64 {
        let [low, _] = self.ends;
        let middle = low + 0.5 * self.width();
        let [from, to] = self.values.map(f64::abs);
        let secant = low + self.width() * (from / (from + to));
        let secant = if secant.is_nan() { middle } else { secant };
        let nudge = (0.2 * self.width() * self.width()).max(0.25 * target);
        let towards = (middle - secant).signum();
        let nudged = if nudge <= (middle - secant).abs() {
            secant + towards * nudge
        } else {
            middle
        };
        let reach = leeway.max(0.0);
        nudged.clamp(middle - reach, middle + reach)
    }

    /// Cut the interval where a value is known; `false` if its sign is not.
    fn cut(&mut self, t: f64, (value, error): (f64, f64)) -> bool {
        if !(self.ends[0] < t && t < self.ends[1]) {
            return false;
        }
        match certain_sign(value, error) {
            Some(0) | None => false,
            Some(sign) => {
                let end = usize::from(sign != self.sign);
                self.ends[end] = t;
                self.values[end] = value;
                true
            }
        }
    }

    /// Approach a place of unknown sign from both sides.
    fn enclose(&mut self, t: f64, target: f64, evaluate: &impl Fn(f64) -> (f64, f64)) {
        for direction in [-1.0, 1.0] {
            let mut step = 0.375 * target;
            loop {
                let probe = t + direction * step;
                if !(self.ends[0] < probe && probe < self.ends[1])
                    || self.cut(probe, evaluate(probe))
                {
                    break;
                }
                step *= 2.0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// The requested widths.
    const TARGET: f64 = 1e-12;

    fn refined(function: impl Fn(f64) -> f64, error: f64) -> ([f64; 2], u32) {
        let calls = Cell::new(0);
        let evaluate = |t: f64| {
            calls.set(calls.get() + 1);
            (function(t), error)
        };
        let values = [function(0.0), function(1.0)];
        let sign = if values[0] < 0.0 { -1 } else { 1 };
        let bracket = Bracket {
            ends: [0.0, 1.0],
            values,
            sign,
        };
        (refine(bracket, TARGET, evaluate), calls.get())
    }

    #[test]
    fn roots_are_narrowed_quickly_and_never_lost() {
        let root = 0.3_f64;
        for (power, most) in [(1, 10), (3, 14), (9, 30)] {
            let (found, calls) = refined(|t| t.powi(power) - root.powi(power), 1e-17);
            assert!(
                found[0] <= root + 1e-15 && root - 1e-15 <= found[1],
                "{found:?}"
            );
            assert!(found[1] - found[0] <= TARGET, "{found:?}");
            assert!(calls <= most, "{calls} calls for power {power}");
        }
    }

    #[test]
    fn noise_leaves_an_honest_width() {
        let (found, _) = refined(|t| t - 0.7, 1e-6);
        assert!(found[0] <= 0.7 - 1e-6 && 0.7 + 1e-6 <= found[1]);
        assert!(found[1] - found[0] <= 1e-5);
    }
}
