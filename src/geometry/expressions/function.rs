//! The functions that expressions can name.

use super::degrees::{sin_cos_of_degrees, tan_of_degrees};
use super::range::{Gap, ValueRange};
use crate::geometry::power_series::PowerSeries;

/// A function that expressions can name.
#[derive(Clone, Copy)]
pub(in crate::geometry) struct Function {
    /// Its spelling.
    pub(super) name: &'static str,
    /// The dimensions of its arguments and its value.
    pub(super) kind: FunctionKind,
    /// Its power series, of those of its arguments.
    of: Body,
}

/// The dimensions of a function's arguments and value.
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
    One(
        OfOne<PowerSeries>,
        fn(ValueRange) -> Result<ValueRange, Gap>,
    ),
    Two(
        OfTwo<PowerSeries>,
        fn(ValueRange, ValueRange) -> Result<ValueRange, Gap>,
    ),
}

type OfOne<T> = fn(&T) -> T;
type OfTwo<T> = fn(&T, &T) -> T;

/// The functions that there are.
const FUNCTIONS: &[Function] = &[
    one(
        "sin",
        FunctionKind::OfAngle(|degrees| sin_cos_of_degrees(degrees).0),
        |f| f.sin_cos().0,
        ValueRange::sin,
    ),
    one(
        "cos",
        FunctionKind::OfAngle(|degrees| sin_cos_of_degrees(degrees).1),
        |f| f.sin_cos().1,
        ValueRange::cos,
    ),
    one(
        "tan",
        FunctionKind::OfAngle(tan_of_degrees),
        PowerSeries::tan,
        ValueRange::tan,
    ),
    one(
        "asin",
        FunctionKind::ToAngle,
        PowerSeries::asin,
        ValueRange::asin,
    ),
    one(
        "acos",
        FunctionKind::ToAngle,
        PowerSeries::acos,
        ValueRange::acos,
    ),
    one("atan", FunctionKind::ToAngle, PowerSeries::atan, |f| {
        f.rising(f64::atan)
    }),
    one(
        "sinh",
        FunctionKind::Plain,
        |f| f.sinh_cosh().0,
        |f| f.rising(f64::sinh),
    ),
    one(
        "cosh",
        FunctionKind::Plain,
        |f| f.sinh_cosh().1,
        ValueRange::cosh,
    ),
    one("tanh", FunctionKind::Plain, PowerSeries::tanh, |f| {
        f.rising(f64::tanh)
    }),
    one("exp", FunctionKind::Plain, PowerSeries::exp, |f| {
        f.rising(f64::exp)
    }),
    one("ln", FunctionKind::Plain, PowerSeries::ln, ValueRange::ln),
    one(
        "sqrt",
        FunctionKind::Root,
        |f| f.power(0.5),
        |f| f.power(0.5),
    ),
    one("abs", FunctionKind::Same, PowerSeries::abs, |f| Ok(f.abs())),
    two(
        "min",
        FunctionKind::Same,
        |f, g| if f.value() <= g.value() { f } else { g }.clone(),
        |f, g| Ok(f.lower(g)),
    ),
    two(
        "max",
        FunctionKind::Same,
        |f, g| if f.value() >= g.value() { f } else { g }.clone(),
        |f, g| Ok(f.upper(g)),
    ),
    two(
        "hypot",
        FunctionKind::Same,
        |f, g| (&(f * f) + &(g * g)).power(0.5),
        |f, g| f.power(2.0)?.plus(g.power(2.0)?)?.power(0.5),
    ),
    two(
        "atan2",
        FunctionKind::Direction,
        PowerSeries::direction,
        ValueRange::direction,
    ),
];

const fn one(
    name: &'static str,
    kind: FunctionKind,
    of: OfOne<PowerSeries>,
    over: fn(ValueRange) -> Result<ValueRange, Gap>,
) -> Function {
    let of = Body::One(of, over);
    Function { name, kind, of }
}

const fn two(
    name: &'static str,
    kind: FunctionKind,
    of: OfTwo<PowerSeries>,
    over: fn(ValueRange, ValueRange) -> Result<ValueRange, Gap>,
) -> Function {
    let of = Body::Two(of, over);
    Function { name, kind, of }
}

/// List the names of the functions that there are.
pub(super) fn function_names() -> Vec<&'static str> {
    FUNCTIONS.iter().map(|function| function.name).collect()
}

impl Function {
    /// Find a function by its name.
    pub(super) fn find(name: &str) -> Option<Self> {
        let mut functions = FUNCTIONS.iter();
        functions.find(|function| function.name == name).copied()
    }

    /// The number of arguments.
    pub(super) fn arguments(self) -> usize {
        match self.of {
            Body::One(..) => 1,
            Body::Two(..) => 2,
        }
    }

    /// Its power series, of those of its arguments; no number if they are not as many as it has.
    pub(super) fn of(self, arguments: &[PowerSeries]) -> PowerSeries {
        match (self.of, arguments) {
            (Body::One(of, _), [f]) => of(f),
            (Body::Two(of, _), [f, g]) => of(f, g),
            _ => PowerSeries::constant(f64::NAN, 0),
        }
    }

    /// Bound its values over ranges of its arguments.
    ///
    /// # Errors
    /// [`Gap`] where it may have none, and if the arguments are not as many as it has.
    pub(super) fn over(self, arguments: &[ValueRange]) -> Result<ValueRange, Gap> {
        match (self.of, arguments) {
            (Body::One(_, over), [f]) => over(*f),
            (Body::Two(_, over), [f, g]) => over(*f, *g),
            _ => Err(Gap::Pole),
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
