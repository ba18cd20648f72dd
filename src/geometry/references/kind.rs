//! A kind of curve given by formulas, described once for fields and command line.

use std::hash::{Hash, Hasher};
use std::ops::{Bound, RangeBounds};

use super::error::ReferenceError;
use crate::geometry::expressions::Quantity;
use crate::geometry::power_series::PowerSeries;

/// Describe a kind of curve.
#[derive(Debug)]
pub struct ReferenceKind {
    /// What the command line calls it.
    pub name: &'static str,
    /// What menus and panels call it.
    pub label: &'static str,
    /// What it is, in one line, with its formula.
    pub help: &'static str,
    /// The numbers that shape it, in the order in which they are offered.
    pub parameters: &'static [ReferenceParameter],
    /// Whether it lies in the plane z = 0.
    pub planar: bool,
    /// The interval of its parameter t that is drawn if none is given, for checked values.
    pub(super) interval: fn(&[f64]) -> [f64; 2],
    /// Where t may run, for checked values.
    pub(super) domain: fn(&[f64]) -> [f64; 2],
    /// Expand the coordinates about t, to the given order; values are checked.
    pub(super) series: fn(&[f64], f64, usize) -> [PowerSeries; 3],
}

/// Describe a number that shapes a curve.
#[derive(Clone, Debug)]
pub struct ReferenceParameter {
    /// What the command line calls it.
    pub name: &'static str,
    /// What panels call it.
    pub label: &'static str,
    /// What it does, in one line.
    pub help: &'static str,
    /// What it is if it is not given.
    pub default: f64,
    /// The numbers that are allowed; all of them are finite.
    pub limits: (Bound<f64>, Bound<f64>),
}

/// Every t.
pub(super) const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Every number.
pub(super) const ANY: (Bound<f64>, Bound<f64>) = (Bound::Unbounded, Bound::Unbounded);

/// The numbers that sizes have: squares and cubes of them stay within the range of numbers.
pub(super) const SIZE: (Bound<f64>, Bound<f64>) = (Bound::Included(1e-30), Bound::Included(1e30));

impl PartialEq for ReferenceKind {
    /// Kinds are told apart by their names.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for ReferenceKind {}

impl Hash for ReferenceKind {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl ReferenceKind {
    /// The values of all parameters if none is given.
    pub fn defaults(&self) -> Vec<f64> {
        self.parameters.iter().map(|it| it.default).collect()
    }

    /// The interval of t that is drawn if nothing is given.
    pub fn default_interval(&self) -> [f64; 2] {
        (self.interval)(&self.defaults())
    }
}

impl ReferenceParameter {
    /// What it measures: what can have any size is a length.
    pub fn quantity(&self) -> Quantity {
        match self.limits == SIZE {
            true => Quantity::Length,
            false => Quantity::Number,
        }
    }

    /// Refuse a number that is not allowed.
    ///
    /// # Errors
    /// [`ReferenceError::OutOfRange`].
    pub fn check(&self, value: f64) -> Result<(), ReferenceError> {
        if value.is_finite() && self.limits.contains(&value) {
            return Ok(());
        }
        Err(ReferenceError::OutOfRange {
            label: self.label,
            value,
            needed: self.limits_words(),
        })
    }

    /// Say which numbers it takes.
    pub fn limits_words(&self) -> String {
        let (from, to) = self.limits;
        let from = match from {
            Bound::Included(from) => Some(format!("at least {}", plain(from))),
            Bound::Excluded(from) => Some(format!("more than {}", plain(from))),
            Bound::Unbounded => None,
        };
        let to = match to {
            Bound::Included(to) => Some(format!("at most {}", plain(to))),
            Bound::Excluded(to) => Some(format!("less than {}", plain(to))),
            Bound::Unbounded => None,
        };
        let words: Vec<String> = [from, to].into_iter().flatten().collect();
        match words.is_empty() {
            true => "a finite number".to_owned(),
            false => format!("a number of {}", words.join(" and ")),
        }
    }
}

/// Write a limit as briefly as it can be read back.
fn plain(number: f64) -> String {
    let (plain, power) = (format!("{number}"), format!("{number:e}"));
    if plain.len() <= power.len() + 3 {
        plain
    } else {
        power
    }
}
