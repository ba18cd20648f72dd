//! Expressions as trees, and their power series.

use super::function::{Argument, Function};
use super::unit::Unit;
use crate::geometry::interval::{Gap, Interval};
use crate::geometry::power_series::PowerSeries;

/// The most intervals that are looked at for a place without a value: some hundred lead to a pole.
const MOST_INTERVALS: usize = 20_000;

/// An expression in t. Where something can be wrong with a part, it has the column of it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::geometry) enum Expression {
    /// A number.
    Number(f64),
    /// The parameter t.
    Parameter,
    /// −a.
    Negative(Box<Self>),
    /// Two parts, combined, and the column of the operator.
    Combined(Operator, usize, Box<[Self; 2]>),
    /// A function of its arguments, and its column.
    Call(Function, usize, Vec<Self>),
    /// A part in a unit, and the unit's column.
    InUnit(Unit, usize, Box<Self>),
}

/// Operator between two expressions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
    Power,
}

impl Expression {
    /// Find the first place of an interval where it has no value or no slope: intervals are halved until it
    /// has both all over them.
    pub(in crate::geometry) fn first_gap(&self, [from, to]: [f64; 2]) -> Option<f64> {
        let mut left = vec![[from, to]];
        for _ in 0..MOST_INTERVALS {
            let [low, high] = left.pop()?;
            let range = self.range(Interval::new(low, high));
            let Err(gap) = range.and_then(Interval::of_coordinate) else {
                continue;
            };
            let middle = low + 0.5 * (high - low);
            if low < middle && middle < high {
                left.extend([[middle, high], [low, middle]]);
            } else if gap == Gap::Pole {
                return Some(rounder(low, high));
            } else if let Some(place) = [low, high].into_iter().find(|t| !self.has_slope(*t)) {
                return Some(place);
            }
        }
        None
    }

    fn has_slope(&self, t: f64) -> bool {
        let series = self.series(&PowerSeries::parameter(t, 1));
        series.coefficients().iter().all(|it| it.is_finite())
    }

    /// Whether t occurs in it.
    pub(in crate::geometry) fn depends_on_parameter(&self) -> bool {
        match self {
            Self::Number(_) => false,
            Self::Parameter => true,
            Self::Negative(inner) | Self::InUnit(_, _, inner) => inner.depends_on_parameter(),
            Self::Call(_, _, arguments) => arguments.iter().any(Self::depends_on_parameter),
            Self::Combined(_, _, operands) => operands.iter().any(Self::depends_on_parameter),
        }
    }

    /// Expand it for the series of t: angles are in radians.
    pub(in crate::geometry) fn series<T: Argument>(&self, t: &PowerSeries<T>) -> PowerSeries<T> {
        match self {
            Self::Number(number) => PowerSeries::constant(T::of(*number), t.order()),
            Self::Parameter => t.clone(),
            Self::Negative(inner) => -&inner.series(t),
            // Formulas are read without units of length; radians are what series have.
            Self::InUnit(Unit::Degree, _, inner) => {
                inner.series(t).times(T::of(1_f64.to_radians()))
            }
            Self::InUnit(Unit::Radian | Unit::Length(_), _, inner) => inner.series(t),
            Self::Call(function, _, arguments) => {
                let arguments = arguments.iter().map(|argument| argument.series(t));
                function.of(&arguments.collect::<Vec<_>>())
            }
            Self::Combined(operator, _, operands) => {
                let [left, right] = &**operands;
                let base = left.series(t);
                if *operator == Operator::Power && !right.depends_on_parameter() {
                    return base.power(right.value());
                }
                let other = right.series(t);
                match operator {
                    Operator::Plus => &base + &other,
                    Operator::Minus => &base - &other,
                    Operator::Times => &base * &other,
                    Operator::Over => &base / &other,
                    Operator::Power => (&other * &base.ln()).exp(),
                }
            }
        }
    }

    /// The value of an expression without t.
    pub(in crate::geometry) fn value(&self) -> f64 {
        self.series(&PowerSeries::constant(0.0, 0)).value()
    }

    /// Whether an expression without t divides by zero.
    pub(in crate::geometry) fn divides_by_zero(&self) -> bool {
        match self {
            Self::Number(_) | Self::Parameter => false,
            Self::Negative(inner) | Self::InUnit(_, _, inner) => inner.divides_by_zero(),
            Self::Call(_, _, arguments) => arguments.iter().any(Self::divides_by_zero),
            Self::Combined(operator, _, operands) => {
                let [left, right] = &**operands;
                let divides = match operator {
                    Operator::Over => right.value() == 0.0,
                    Operator::Power => left.value() == 0.0 && right.value() < 0.0,
                    _ => false,
                };
                divides || operands.iter().any(Self::divides_by_zero)
            }
        }
    }

    /// Bound its values for t in a range.
    fn range(&self, t: Interval) -> Result<Interval, Gap> {
        match self {
            Self::Number(number) => Ok(Interval::number(*number)),
            Self::Parameter => Ok(t),
            Self::Negative(inner) => Ok(inner.range(t)?.negative()),
            Self::InUnit(Unit::Degree, _, inner) => {
                inner.range(t)?.times(Interval::number(1_f64.to_radians()))
            }
            Self::InUnit(Unit::Radian | Unit::Length(_), _, inner) => inner.range(t),
            Self::Call(function, _, arguments) => {
                let arguments = arguments.iter().map(|argument| argument.range(t));
                function.over(&arguments.collect::<Result<Vec<_>, Gap>>()?)
            }
            Self::Combined(operator, _, operands) => {
                let [left, right] = &**operands;
                let base = left.range(t)?;
                if *operator == Operator::Power && !right.depends_on_parameter() {
                    return base.power(right.value());
                }
                let other = right.range(t)?;
                match operator {
                    Operator::Plus => base.plus(other),
                    Operator::Minus => base.plus(other.negative()),
                    Operator::Times => base.times(other),
                    Operator::Over => base.times(other.inverse()?),
                    Operator::Power => other.times(base.ln()?)?.rising(f64::exp),
                }
            }
        }
    }
}

/// Of two neighbouring numbers the one with fewer digits.
fn rounder(low: f64, high: f64) -> f64 {
    let digits = |number: f64| format!("{number}").len();
    if digits(high) < digits(low) {
        high
    } else {
        low
    }
}
