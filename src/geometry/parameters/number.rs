//! A number with its range, default and quantity.

use std::ops::{Bound, RangeBounds, RangeInclusive};

use thiserror::Error;

use super::quantity::Quantity;

/// Allowed numbers: the lower and the upper limit.
pub type Limits = (Bound<f64>, Bound<f64>);

/// Sizes whose squares and cubes stay within the range of doubles.
pub const SIZES: RangeInclusive<f64> = 1e-30..=1e30;

/// Describe a number. Limits and default are of type `A`: numbers, or what an input turns into numbers.
#[derive(Clone, Copy, Debug)]
pub struct Number<A = f64> {
    /// Lower limit.
    pub from: Bound<A>,
    /// Upper limit.
    pub to: Bound<A>,
    /// Value if none is given.
    pub default: A,
    /// What the number measures.
    pub quantity: Quantity,
}

/// A number outside its limits.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{label}: {value} is out of range: {needed} is needed")]
pub struct OutOfRange {
    /// Label of the parameter.
    pub label: &'static str,
    /// The value given.
    pub value: Box<str>,
    /// The range.
    pub needed: Box<str>,
}

impl<A> Number<A> {
    /// Describe the numbers in words, with a text for each limit: "a length, more than 0".
    pub fn words(&self, noun: &str, text: impl Fn(&A) -> String) -> String {
        match bounds_words(self.from.as_ref().map(&text), self.to.as_ref().map(&text)) {
            Some(words) => format!("{noun}, {words}"),
            None => noun.to_owned(),
        }
    }
}

impl Number {
    /// Describe any finite number.
    pub const fn any(default: f64) -> Self {
        Self {
            from: Bound::Unbounded,
            to: Bound::Unbounded,
            default,
            quantity: Quantity::Number,
        }
    }

    /// Describe a plain number of a range with both ends.
    pub const fn between(from: f64, to: f64, default: f64) -> Self {
        Self {
            from: Bound::Included(from),
            to: Bound::Included(to),
            ..Self::any(default)
        }
    }

    /// Describe a length of [`SIZES`].
    pub const fn size(default: f64) -> Self {
        Self {
            quantity: Quantity::Length,
            ..Self::between(*SIZES.start(), *SIZES.end(), default)
        }
    }

    /// Refuse a number that is not finite, or outside the limits.
    ///
    /// # Errors
    /// [`OutOfRange`] with the parameter's label.
    pub fn check(&self, label: &'static str, value: f64) -> Result<(), OutOfRange> {
        check_limits(label, value, (self.from, self.to), self.quantity)
    }

    /// Describe the numbers in words: "a length, 1e-30 to 1e30".
    pub fn range_words(&self) -> String {
        let text = |limit: &f64| brief(self.quantity.shown(*limit));
        self.words(self.quantity.noun(), text)
    }
}

/// Refuse a number that is not finite, or outside the limits.
///
/// # Errors
/// [`OutOfRange`] with the parameter's label, and the numbers as they are shown.
pub fn check_limits(
    label: &'static str,
    value: f64,
    limits: Limits,
    quantity: Quantity,
) -> Result<(), OutOfRange> {
    if value.is_finite() && limits.contains(&value) {
        return Ok(());
    }
    let text = |limit: f64| brief(quantity.shown(limit));
    let needed = bounds_words(limits.0.map(text), limits.1.map(text));
    Err(OutOfRange {
        label,
        value: text(value).into(),
        needed: needed
            .unwrap_or_else(|| "a finite number".to_owned())
            .into(),
    })
}

/// Describe a range in words: "1 to 5", "more than 0"; `None` without limits.
fn bounds_words(from: Bound<String>, to: Bound<String>) -> Option<String> {
    use Bound::{Excluded, Included, Unbounded};
    Some(match (from, to) {
        (Included(from), Included(to)) => format!("{from} to {to}"),
        (Excluded(from), Excluded(to)) => format!("more than {from} and less than {to}"),
        (Included(from), Excluded(to)) => format!("at least {from} and less than {to}"),
        (Excluded(from), Included(to)) => format!("more than {from} and at most {to}"),
        (Included(from), Unbounded) => format!("at least {from}"),
        (Excluded(from), Unbounded) => format!("more than {from}"),
        (Unbounded, Included(to)) => format!("at most {to}"),
        (Unbounded, Excluded(to)) => format!("less than {to}"),
        (Unbounded, Unbounded) => return None,
    })
}

/// Whole numbers of no more digits are written in full.
const LONGEST_COUNT: usize = 12;

/// Write a number as briefly as it can be read back; counts in full.
pub fn brief(number: f64) -> String {
    let (plain, power) = (format!("{number}"), format!("{number:e}"));
    let is_count = number.fract() == 0.0 && plain.len() <= LONGEST_COUNT;
    if is_count || plain.len() <= power.len() + 3 {
        plain
    } else {
        power
    }
}
