//! Limits and defaults of parameters that may depend on the input.

use std::fmt;

use super::error::OperationError;
use super::operands::Operands;

/// A number that is known once there is an input, and can be described before: a limit of a
/// parameter, or its default. Angles are in radians.
#[derive(Clone, Copy, Debug)]
pub enum Amount {
    /// The same number for every input.
    Number(f64),
    /// The number of segments of the curve, which is where its parameter ends.
    Segments,
    /// The degree of the curve, plus this.
    Degree(i8),
    /// Something else.
    Of {
        /// What it is, in words.
        words: &'static str,
        /// Find it.
        value: fn(&Operands) -> Result<f64, OperationError>,
    },
}

impl Amount {
    /// Find the number for an input.
    ///
    /// # Errors
    /// [`OperationError::Inputs`] if it depends on a curve and there is none.
    pub fn of(&self, input: &Operands) -> Result<f64, OperationError> {
        match self {
            Self::Number(number) => Ok(*number),
            Self::Segments => Ok(input.polygon()?.segments() as f64),
            Self::Degree(more) => Ok(input.polygon()?.degree() as f64 + f64::from(*more)),
            Self::Of { value, .. } => value(input),
        }
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(formatter, "{number}"),
            Self::Segments => formatter.write_str("the number of segments"),
            Self::Degree(0) => formatter.write_str("the degree"),
            Self::Degree(more) if *more > 0 => write!(formatter, "the degree + {more}"),
            Self::Degree(less) => write!(formatter, "the degree − {}", less.unsigned_abs()),
            Self::Of { words, .. } => formatter.write_str(words),
        }
    }
}
