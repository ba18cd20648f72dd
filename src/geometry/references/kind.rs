//! A kind of curve given by formulas, described once for fields and command line.

use std::hash::{Hash, Hasher};

use crate::geometry::parameters::{Number, Parameter};
use crate::geometry::power_series::PowerSeries;

/// Describe a kind of curve.
#[derive(Debug)]
pub struct ReferenceKind {
    /// Its name in the command line.
    pub name: &'static str,
    /// Its label in menus and panels.
    pub label: &'static str,
    /// One line with its formula.
    pub help: &'static str,
    /// The numbers that shape it, in the order in which they are offered.
    pub parameters: &'static [Parameter<Number>],
    /// Whether it lies in the plane z = 0.
    pub planar: bool,
    /// The interval of its parameter t that is drawn if none is given, for checked values.
    pub(super) interval: fn(&[f64]) -> [f64; 2],
    /// The domain of t, for checked values.
    pub(super) domain: fn(&[f64]) -> [f64; 2],
    /// Expand the coordinates about t, to the given order; values are checked.
    pub(super) series: fn(&[f64], f64, usize) -> [PowerSeries; 3],
}

/// Every t.
pub(super) const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl PartialEq for ReferenceKind {
    /// Kinds with equal names are equal.
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
        self.parameters.iter().map(|it| it.kind.default).collect()
    }

    /// The interval of t that is drawn if nothing is given.
    pub fn default_interval(&self) -> [f64; 2] {
        (self.interval)(&self.defaults())
    }
}
