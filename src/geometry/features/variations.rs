//! Changes of sign in a row of coefficients of which some signs may be unknown.

use super::scalar::Scalar;

/// Rounding error of comparing a value with its error bound.
const COMPARISON: f64 = 1.0 - f64::EPSILON * 16.0;

/// Find the sign of a number known up to an error bound: `None` if it cannot be told, 0 if the
/// number is exactly 0.
#[inline]
pub(super) fn certain_sign(value: f64, error: f64) -> Option<i8> {
    if value.abs() * COMPARISON > error {
        Some(if value > 0.0 { 1 } else { -1 })
    } else if error == 0.0 {
        Some(0)
    } else {
        None
    }
}

/// Signs that a row of Bernstein coefficients allows.
///
/// By Descartes' rule a polynomial has no more roots in the open interval, each counted as often
/// as its multiplicity, than its coefficients change sign, and as many but for an even number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Variations {
    /// Every coefficient is exactly 0.
    Zero,
    /// No sign but those of exact zeros is known.
    Unknown,
    /// No change: the function has this sign.
    None(i8),
    /// Exactly one change, from this sign to its opposite.
    One(i8),
    /// More than one change, or possibly more.
    Many,
}

impl Variations {
    /// Read the signs of coefficients given by values and error bounds.
    pub(super) fn of<T: Scalar>(values: &[T], errors: &[f64]) -> Self {
        let mut most = Most::default();
        let (mut known, mut first, mut last) = (None, Some(0), Some(0));
        for (value, error) in values.iter().zip(errors) {
            let sign = certain_sign(value.rounded(), *error);
            if sign == Some(0) {
                continue;
            }
            if first == Some(0) {
                first = sign;
            }
            last = sign;
            known = known.or(sign);
            most.take(sign);
        }
        let Some(known) = known else {
            return if first == Some(0) {
                Self::Zero
            } else {
                Self::Unknown
            };
        };
        match (most.count(), first, last) {
            (0, ..) => Self::None(known),
            (1, Some(sign), Some(_)) => Self::One(sign),
            _ => Self::Many,
        }
    }
}

/// Counts the most changes that a row can have, whatever its unknown signs are.
struct Most {
    /// The most changes if the last sign is positive, and if it is negative.
    ending: [Option<u32>; 2],
    /// Whether all coefficients so far may be 0.
    empty: bool,
}

impl Default for Most {
    fn default() -> Self {
        Self {
            ending: [None; 2],
            empty: true,
        }
    }
}

impl Most {
    fn take(&mut self, sign: Option<i8>) {
        let start = self.empty.then_some(0);
        let [positive, negative] = self.ending;
        let after = |same: Option<u32>, other: Option<u32>| {
            same.max(other.map(|changes| changes + 1)).max(start)
        };
        let next = [after(positive, negative), after(negative, positive)];
        self.ending = match sign {
            Some(1) => [next[0], None],
            Some(_) => [None, next[1]],
            None => next,
        };
        self.empty &= sign.is_none();
    }

    fn count(&self) -> u32 {
        self.ending.into_iter().flatten().max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Read a row written as + − 0 and ? for unknown.
    fn variations(row: &str) -> Variations {
        let coefficient = |sign| match sign {
            '+' => (1.0, 0.5),
            '-' => (-1.0, 0.5),
            '0' => (0.0, 0.0),
            _ => (0.1, 0.5),
        };
        let (values, errors): (Vec<f64>, Vec<f64>) = row.chars().map(coefficient).unzip();
        Variations::of(&values, &errors)
    }

    #[test]
    fn rows_allow_what_descartes_rule_allows() {
        for (row, expected) in [
            ("000", Variations::Zero),
            ("?0?", Variations::Unknown),
            ("++0+", Variations::None(1)),
            ("0--0", Variations::None(-1)),
            ("+--", Variations::One(1)),
            ("0-?+", Variations::One(-1)),
            ("-0?0+", Variations::One(-1)),
            ("-??+", Variations::Many),
            ("+?+", Variations::Many),
            ("+-+", Variations::Many),
            ("?++", Variations::Many),
            ("--?", Variations::Many),
            ("?+?", Variations::Many),
            ("??+", Variations::Many),
            ("0?+", Variations::Many),
            ("+?0", Variations::Many),
        ] {
            assert_eq!(variations(row), expected, "{row}");
        }
    }
}
