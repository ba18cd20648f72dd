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
    /// The default interval of the parameter t, computed from checked values of the parameters.
    pub(super) interval: fn(&[f64]) -> [f64; 2],
    /// The domain of t, computed from checked values of the parameters.
    pub(super) domain: fn(&[f64]) -> [f64; 2],
    /// Its coordinates.
    pub(super) coordinates: Coordinates,
}

/// Coordinates of a kind, expanded for checked values and the series of t, to the order of that
/// series.
#[derive(Debug)]
pub(super) enum Coordinates {
    /// x and y of a curve in the plane z = 0.
    Planar(fn(&[f64], &PowerSeries) -> [PowerSeries; 2]),
    /// x, y and z.
    Spatial(fn(&[f64], &PowerSeries) -> [PowerSeries; 3]),
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

    /// Whether it lies in the plane z = 0.
    pub fn is_planar(&self) -> bool {
        matches!(self.coordinates, Coordinates::Planar(_))
    }

    /// Expand the coordinates about t, for checked values.
    pub(super) fn series(&self, values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
        let t = PowerSeries::parameter(t, order);
        match self.coordinates {
            Coordinates::Planar(of) => {
                let [x, y] = of(values, &t);
                [x, y, PowerSeries::constant(0.0, order)]
            }
            Coordinates::Spatial(of) => of(values, &t),
        }
    }

    /// The interval of t that is drawn if nothing is given.
    pub fn default_interval(&self) -> [f64; 2] {
        (self.interval)(&self.defaults())
    }
}
