//! The functions that expressions can name.

use super::degrees::{sin_cos_of_degrees, tan_of_degrees};
use crate::geometry::power_series::PowerSeries;

/// A function that expressions can name.
#[derive(Clone, Copy)]
pub(super) struct Function {
    /// How it is written.
    pub(super) name: &'static str,
    /// What it asks of its arguments, and what it gives.
    pub(super) kind: FunctionKind,
    /// Its power series, of those of its arguments.
    of: Body,
}

/// What a function asks of its arguments, and what it gives.
#[derive(Clone, Copy)]
pub(super) enum FunctionKind {
    /// A number of an angle; this is it for degrees.
    OfAngle(fn(f64) -> f64),
    /// An angle of a number.
    ToAngle,
    /// A number of a number.
    Plain,
    /// What was given, or something else of its kind.
    Same,
    /// The square root: that of an area is a length.
    Root,
    /// An angle of two of a kind.
    Direction,
}

#[derive(Clone, Copy)]
enum Body {
    One(fn(&PowerSeries) -> PowerSeries),
    Two(fn(&PowerSeries, &PowerSeries) -> PowerSeries),
}

/// The functions that there are.
pub(super) const FUNCTIONS: &[Function] = &[
    one(
        "sin",
        FunctionKind::OfAngle(|degrees| sin_cos_of_degrees(degrees).0),
        |f| f.sin_cos().0,
    ),
    one(
        "cos",
        FunctionKind::OfAngle(|degrees| sin_cos_of_degrees(degrees).1),
        |f| f.sin_cos().1,
    ),
    one(
        "tan",
        FunctionKind::OfAngle(tan_of_degrees),
        PowerSeries::tan,
    ),
    one("asin", FunctionKind::ToAngle, PowerSeries::asin),
    one("acos", FunctionKind::ToAngle, PowerSeries::acos),
    one("atan", FunctionKind::ToAngle, PowerSeries::atan),
    one("sinh", FunctionKind::Plain, |f| f.sinh_cosh().0),
    one("cosh", FunctionKind::Plain, |f| f.sinh_cosh().1),
    one("tanh", FunctionKind::Plain, PowerSeries::tanh),
    one("exp", FunctionKind::Plain, PowerSeries::exp),
    one("ln", FunctionKind::Plain, PowerSeries::ln),
    one("sqrt", FunctionKind::Root, |f| f.power(0.5)),
    one("abs", FunctionKind::Same, PowerSeries::abs),
    two("min", FunctionKind::Same, |f, g| {
        if f.value() <= g.value() { f } else { g }.clone()
    }),
    two("max", FunctionKind::Same, |f, g| {
        if f.value() >= g.value() { f } else { g }.clone()
    }),
    two("hypot", FunctionKind::Same, |f, g| {
        (&(f * f) + &(g * g)).power(0.5)
    }),
    two("atan2", FunctionKind::Direction, PowerSeries::direction),
];

const fn one(
    name: &'static str,
    kind: FunctionKind,
    of: fn(&PowerSeries) -> PowerSeries,
) -> Function {
    let of = Body::One(of);
    Function { name, kind, of }
}

const fn two(
    name: &'static str,
    kind: FunctionKind,
    of: fn(&PowerSeries, &PowerSeries) -> PowerSeries,
) -> Function {
    let of = Body::Two(of);
    Function { name, kind, of }
}

impl Function {
    /// Find a function by its name.
    pub(super) fn find(name: &str) -> Option<Self> {
        let mut functions = FUNCTIONS.iter();
        functions.find(|function| function.name == name).copied()
    }

    /// How many arguments it has.
    pub(super) fn arguments(self) -> usize {
        match self.of {
            Body::One(_) => 1,
            Body::Two(_) => 2,
        }
    }

    /// Its power series, of those of its arguments; no number if they are not as many as it has.
    pub(super) fn of(self, arguments: &[PowerSeries]) -> PowerSeries {
        match (self.of, arguments) {
            (Body::One(of), [f]) => of(f),
            (Body::Two(of), [f, g]) => of(f, g),
            _ => PowerSeries::constant(f64::NAN, 0),
        }
    }

    /// Its value.
    pub(super) fn value(self, arguments: &[f64]) -> f64 {
        let constant = |argument: &f64| PowerSeries::constant(*argument, 0);
        let arguments: Vec<PowerSeries> = arguments.iter().map(constant).collect();
        self.of(&arguments).value()
    }
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl std::fmt::Debug for Function {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name)
    }
}
