//! Values of expressions whose numbers have units.

use super::error::{ExpressionError, ExpressionMistake};
use super::expression::{Expression, Operator};
use super::function::{Function, FunctionKind};
use super::unit::{LengthUnit, Unit};
use crate::geometry::power_series::PowerSeries;

/// A number with its dimension: lengths in the document's unit, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measure {
    pub(super) number: f64,
    pub(super) dimension: Dimension,
}

/// The powers of length and of angle that a number measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dimension {
    length: f64,
    angle: f64,
}

impl Dimension {
    pub(super) const PLAIN: Self = Self::new(0.0, 0.0);
    pub(super) const LENGTH: Self = Self::new(1.0, 0.0);
    pub(super) const CURVATURE: Self = Self::new(-1.0, 0.0);
    pub(super) const ANGLE: Self = Self::new(0.0, 1.0);

    const fn new(length: f64, angle: f64) -> Self {
        Self { length, angle }
    }

    /// Its name.
    pub(super) fn name(self) -> &'static str {
        match (self.length, self.angle) {
            (0.0, 0.0) => "a plain number",
            (1.0, 0.0) => "a length",
            (2.0, 0.0) => "an area",
            (-1.0, 0.0) => "a curvature, 1/length",
            (0.0, 1.0) => "an angle",
            _ => "a product of units",
        }
    }

    fn plus(self, other: Self) -> Self {
        Self::new(self.length + other.length, self.angle + other.angle)
    }

    fn times(self, factor: f64) -> Self {
        Self::new(self.length * factor, self.angle * factor)
    }
}

impl Measure {
    fn plain(number: f64) -> Self {
        let dimension = Dimension::PLAIN;
        Self { number, dimension }
    }

    /// The number of an angle in radians; plain numbers are radians.
    pub(super) fn radians(self) -> f64 {
        if self.dimension == Dimension::ANGLE {
            self.number.to_radians()
        } else {
            self.number
        }
    }
}

/// The meaning of numbers without a unit.
#[derive(Clone, Copy)]
pub(super) struct Conventions {
    /// The document's unit of length, which lengths are converted to.
    pub(super) unit: Option<LengthUnit>,
    /// Whether plain numbers beside angles are degrees.
    pub(super) degrees: bool,
}

type MeasureResult = Result<Measure, ExpressionMistake>;

impl Conventions {
    /// Compute the value of a part of an expression without t.
    ///
    /// # Errors
    /// [`ExpressionMistake`] where units do not go together.
    pub(super) fn measure(self, node: &Expression) -> MeasureResult {
        match node {
            Expression::Number(number) => Ok(Measure::plain(*number)),
            // Numbers are read without t.
            Expression::Parameter => Ok(Measure::plain(f64::NAN)),
            Expression::Negative(inner) => self.measure(inner).map(|inner| Measure {
                number: -inner.number,
                ..inner
            }),
            Expression::InUnit(unit, column, inner) => self.in_unit(*unit, *column, inner),
            Expression::Call(function, column, arguments) => {
                self.call(*function, *column, arguments)
            }
            Expression::Combined(operator, column, operands) => {
                let [left, right] = &**operands;
                if *operator == Operator::Power {
                    return self.power(left, *column, right);
                }
                self.combined(
                    *operator,
                    *column,
                    self.measure(left)?,
                    self.measure(right)?,
                )
            }
        }
    }

    fn in_unit(self, unit: Unit, column: usize, inner: &Expression) -> MeasureResult {
        let inner = self.measure(inner)?;
        let (number, dimension) = match unit {
            Unit::Length(length) => {
                let document = self.unit.ok_or(ExpressionMistake {
                    column,
                    error: ExpressionError::NoDocumentUnit {
                        unit: length.symbol(),
                    },
                })?;
                // In this order 12 mm are 0.012 m to the bit.
                let converted = inner.number * length.millimetres() / document.millimetres();
                let is_same = length == document;
                let number = if is_same { inner.number } else { converted };
                (number, Dimension::LENGTH)
            }
            Unit::Degree => (inner.number, Dimension::ANGLE),
            Unit::Radian => (inner.number.to_degrees(), Dimension::ANGLE),
        };
        let dimension = inner.dimension.plus(dimension);
        Ok(Measure { number, dimension })
    }

    fn combined(
        self,
        operator: Operator,
        column: usize,
        left: Measure,
        right: Measure,
    ) -> MeasureResult {
        let (a, b) = (left.number, right.number);
        let sum = || self.common(column, left, right);
        let (number, dimension) = match operator {
            Operator::Plus => (a + b, sum()?),
            Operator::Minus => (a - b, sum()?),
            Operator::Times => (a * b, left.dimension.plus(right.dimension)),
            _ => (a / b, left.dimension.plus(right.dimension.times(-1.0))),
        };
        Ok(Measure { number, dimension })
    }

    fn power(self, base: &Expression, column: usize, exponent: &Expression) -> MeasureResult {
        let (base, exponent) = (self.measure(base)?, self.measure(exponent)?);
        needed(column, exponent, Dimension::PLAIN)?;
        let power = PowerSeries::constant(base.number, 0).power(exponent.number);
        Ok(Measure {
            number: power.value(),
            dimension: base.dimension.times(exponent.number),
        })
    }

    fn call(self, function: Function, column: usize, arguments: &[Expression]) -> MeasureResult {
        let inside = match function.kind {
            FunctionKind::Same => self,
            _ => Self {
                degrees: false,
                ..self
            },
        };
        let arguments = arguments.iter().map(|argument| inside.measure(argument));
        let arguments = arguments.collect::<Result<Vec<Measure>, _>>()?;
        let numbers: Vec<f64> = arguments.iter().map(|argument| argument.number).collect();
        let all_plain = || {
            let mut arguments = arguments.iter();
            arguments.try_for_each(|argument| needed(column, *argument, Dimension::PLAIN))
        };
        let common = || match arguments.as_slice() {
            [one] => Ok(one.dimension),
            [one, other] => inside.common(column, *one, *other),
            _ => Ok(Dimension::PLAIN),
        };
        let (number, dimension) = match (function.kind, arguments.as_slice()) {
            (FunctionKind::OfAngle(of_degrees), [angle]) if angle.dimension == Dimension::ANGLE => {
                (of_degrees(angle.number), Dimension::PLAIN)
            }
            (FunctionKind::OfAngle(_) | FunctionKind::Plain, _) => {
                all_plain()?;
                (function.value(&numbers), Dimension::PLAIN)
            }
            (FunctionKind::ToAngle, _) => {
                all_plain()?;
                (function.value(&numbers).to_degrees(), Dimension::ANGLE)
            }
            (FunctionKind::Direction, _) => {
                common()?;
                (function.value(&numbers).to_degrees(), Dimension::ANGLE)
            }
            (FunctionKind::Same, _) => (function.value(&numbers), common()?),
            (FunctionKind::Root, _) => (function.value(&numbers), common()?.times(0.5)),
        };
        Ok(Measure { number, dimension })
    }

    /// What two numbers that are added or compared measure: plain numbers beside lengths are in the
    /// document's unit.
    fn common(
        self,
        column: usize,
        left: Measure,
        right: Measure,
    ) -> Result<Dimension, ExpressionMistake> {
        let (one, other) = (left.dimension, right.dimension);
        let takes_plain =
            |it: Dimension| it.angle == 0.0 || (self.degrees && it == Dimension::ANGLE);
        if one == other || (other == Dimension::PLAIN && takes_plain(one)) {
            Ok(one)
        } else if one == Dimension::PLAIN && takes_plain(other) {
            Ok(other)
        } else {
            let error = ExpressionError::Mixed([one.name(), other.name()]);
            Err(ExpressionMistake { column, error })
        }
    }
}

/// Check the dimension of a number.
fn needed(column: usize, found: Measure, needed: Dimension) -> Result<(), ExpressionMistake> {
    if found.dimension == needed {
        return Ok(());
    }
    let error = ExpressionError::WrongQuantity {
        found: found.dimension.name(),
        needed: needed.name(),
    };
    Err(ExpressionMistake { column, error })
}
