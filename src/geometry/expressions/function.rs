//! The functions that expressions can name.

use super::degrees::{sin_cos_of_degrees, tan_of_degrees};
use crate::geometry::coefficient::Coefficient;
use crate::geometry::interval::{Gap, Interval};
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
    One(One, fn(Interval) -> Result<Interval, Gap>),
    Two(Two, fn(Interval, Interval) -> Result<Interval, Gap>),
}

type OfOne<T> = fn(&PowerSeries<T>) -> PowerSeries<T>;
type OfTwo<T> = fn(&PowerSeries<T>, &PowerSeries<T>) -> PowerSeries<T>;

/// A function of one argument, of numbers and of bounds.
#[derive(Clone, Copy)]
pub(in crate::geometry) struct One {
    of_numbers: OfOne<f64>,
    of_bounds: OfOne<Interval>,
}

/// A function of two arguments, of numbers and of bounds.
#[derive(Clone, Copy)]
pub(in crate::geometry) struct Two {
    of_numbers: OfTwo<f64>,
    of_bounds: OfTwo<Interval>,
}

/// Coefficients that functions take.
pub(in crate::geometry) trait Argument: Coefficient {
    /// A function of one argument.
    fn one(function: One) -> OfOne<Self>;

    /// A function of two arguments.
    fn two(function: Two) -> OfTwo<Self>;
}

impl Argument for f64 {
    fn one(function: One) -> OfOne<Self> {
        function.of_numbers
    }

    fn two(function: Two) -> OfTwo<Self> {
        function.of_numbers
    }
}

impl Argument for Interval {
    fn one(function: One) -> OfOne<Self> {
        function.of_bounds
    }

    fn two(function: Two) -> OfTwo<Self> {
        function.of_bounds
    }
}

/// A function of one argument, by its series, for numbers and for bounds, and its range.
macro_rules! one {
    ($name:literal, $kind:expr, $of:expr, $over:expr $(,)?) => {{
        let (of_numbers, of_bounds): (OfOne<f64>, OfOne<Interval>) = ($of, $of);
        let one = One {
            of_numbers,
            of_bounds,
        };
        Function {
            name: $name,
            kind: $kind,
            of: Body::One(one, $over),
        }
    }};
}

/// A function of two arguments, as `one!`.
macro_rules! two {
    ($name:literal, $kind:expr, $of:expr, $over:expr $(,)?) => {{
        let (of_numbers, of_bounds): (OfTwo<f64>, OfTwo<Interval>) = ($of, $of);
        let two = Two {
            of_numbers,
            of_bounds,
        };
        Function {
            name: $name,
            kind: $kind,
            of: Body::Two(two, $over),
        }
    }};
}

/// The functions that there are.
const FUNCTIONS: &[Function] = &[
    one!(
        "sin",
        FunctionKind::OfAngle(|degrees| sin_cos_of_degrees(degrees).0),
        |f| f.sin_cos().0,
        Interval::sin,
    ),
    one!(
        "cos",
        FunctionKind::OfAngle(|degrees| sin_cos_of_degrees(degrees).1),
        |f| f.sin_cos().1,
        Interval::cos,
    ),
    one!(
        "tan",
        FunctionKind::OfAngle(tan_of_degrees),
        PowerSeries::tan,
        Interval::tan,
    ),
    one!(
        "asin",
        FunctionKind::ToAngle,
        PowerSeries::asin,
        Interval::asin,
    ),
    one!(
        "acos",
        FunctionKind::ToAngle,
        PowerSeries::acos,
        Interval::acos,
    ),
    one!("atan", FunctionKind::ToAngle, PowerSeries::atan, |f| {
        f.rising(f64::atan)
    }),
    one!("sinh", FunctionKind::Plain, |f| f.sinh_cosh().0, |f| f
        .rising(f64::sinh),),
    one!(
        "cosh",
        FunctionKind::Plain,
        |f| f.sinh_cosh().1,
        Interval::cosh,
    ),
    one!("tanh", FunctionKind::Plain, PowerSeries::tanh, |f| {
        f.rising(f64::tanh)
    }),
    one!("exp", FunctionKind::Plain, PowerSeries::exp, |f| {
        f.rising(f64::exp)
    }),
    one!("ln", FunctionKind::Plain, PowerSeries::ln, Interval::ln),
    one!("sqrt", FunctionKind::Root, |f| f.power(0.5), |f| f
        .power(0.5),),
    one!("abs", FunctionKind::Same, PowerSeries::abs, |f| Ok(f.abs())),
    two!("min", FunctionKind::Same, PowerSeries::lower, |f, g| Ok(
        f.lower(g)
    ),),
    two!("max", FunctionKind::Same, PowerSeries::upper, |f, g| Ok(
        f.upper(g)
    ),),
    two!(
        "hypot",
        FunctionKind::Same,
        |f, g| (&f.squared() + &g.squared()).power(0.5),
        |f, g| f.power(2.0)?.plus(g.power(2.0)?)?.power(0.5),
    ),
    two!(
        "atan2",
        FunctionKind::Direction,
        PowerSeries::direction,
        Interval::direction,
    ),
];

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
    pub(super) fn of<T: Argument>(self, arguments: &[PowerSeries<T>]) -> PowerSeries<T> {
        match (self.of, arguments) {
            (Body::One(of, _), [f]) => T::one(of)(f),
            (Body::Two(of, _), [f, g]) => T::two(of)(f, g),
            _ => PowerSeries::constant(T::UNKNOWN, 0),
        }
    }

    /// Bound its values over ranges of its arguments.
    ///
    /// # Errors
    /// [`Gap`] where it may have none, and if the arguments are not as many as it has.
    pub(super) fn over(self, arguments: &[Interval]) -> Result<Interval, Gap> {
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
