//! A kind of curve given by formulas, described once for fields and command line.

use std::hash::{Hash, Hasher};

use crate::geometry::coefficient::Coefficient;
use crate::geometry::interval::Interval;
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
/// series: of numbers, and of bounds where the kind has any.
#[derive(Debug)]
pub(super) enum Coordinates {
    /// x and y of a curve in the plane z = 0.
    Planar(Expanded<f64, 2>, Option<Expanded<Interval, 2>>),
    /// x, y and z.
    Spatial(Expanded<f64, 3>, Option<Expanded<Interval, 3>>),
}

/// The series of `N` coordinates.
type Expanded<T, const N: usize> = fn(&[f64], &PowerSeries<T>) -> [PowerSeries<T>; N];

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
        matches!(self.coordinates, Coordinates::Planar(..))
    }

    /// Expand the coordinates about t, for checked values.
    pub(super) fn series(&self, values: &[f64], t: f64, order: usize) -> [PowerSeries; 3] {
        let t = PowerSeries::parameter(t, order);
        match self.coordinates {
            Coordinates::Planar(of, _) => in_plane(of(values, &t)),
            Coordinates::Spatial(of, _) => of(values, &t),
        }
    }

    /// Bound the coordinates for bounds of the series of t and checked values; `None` if there are no bounds.
    pub(super) fn enclosed(
        &self,
        values: &[f64],
        t: &PowerSeries<Interval>,
    ) -> Option<[PowerSeries<Interval>; 3]> {
        let own = PowerSeries::parameter(t.value(), t.order());
        let coordinates = match self.coordinates {
            Coordinates::Planar(_, of) => in_plane(of?(values, &own)),
            Coordinates::Spatial(_, of) => of?(values, &own),
        };
        Some(coordinates.map(|series| series.composed(t)))
    }

    /// The interval of t that is drawn if nothing is given.
    pub fn default_interval(&self) -> [f64; 2] {
        (self.interval)(&self.defaults())
    }
}

fn in_plane<T: Coefficient>([x, y]: [PowerSeries<T>; 2]) -> [PowerSeries<T>; 3] {
    let z = PowerSeries::constant(T::of(0.0), x.order());
    [x, y, z]
}
