//! Mistakes in expressions, with their columns.

use thiserror::Error;

use super::function::function_names;

/// A reason why an expression means nothing.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ExpressionError {
    /// It does not go on as an expression does.
    #[error("expected {expected}, found {}", found.as_ref().map_or("the end".to_owned(), |found| format!("“{found}”")))]
    Syntax {
        /// The character found; none at the end.
        found: Option<String>,
        /// The allowed text.
        expected: &'static str,
    },
    /// A name that means nothing.
    #[error(
        "“{name}” means nothing here: there are {known} and, followed by a parenthesis, {}",
        function_names().join(", ")
    )]
    UnknownName {
        /// The name given.
        name: String,
        /// The names that there are.
        known: &'static str,
    },
    /// The word after a number is no unit.
    #[error("“{name}” is no unit here: write {units}, or * to multiply")]
    UnknownUnit {
        /// The given one.
        name: String,
        /// The units that there are.
        units: &'static str,
    },
    /// A unit of length in a document that has none.
    #[error("the document has no unit to convert “{unit}” to: set one in Edit > Document unit")]
    NoDocumentUnit {
        /// The unit given.
        unit: &'static str,
    },
    /// A function has another number of arguments.
    #[error("{name} needs {needed}, not {found}")]
    ArgumentCount {
        /// The function.
        name: &'static str,
        /// The needed one.
        needed: &'static str,
        /// The given number.
        found: usize,
    },
    /// A value has another dimension than needed, such as an angle instead of a length.
    #[error("{found} is given where {needed} is needed")]
    WrongQuantity {
        /// The given one.
        found: &'static str,
        /// The needed one.
        needed: &'static str,
    },
    /// Quantities that cannot be added, subtracted or compared.
    #[error("{} and {} do not go together: give both the same kind of unit", .0[0], .0[1])]
    Mixed([&'static str; 2]),
    /// The value is no finite real number.
    #[error("“{text}” {}", .reason.words())]
    NotANumber {
        /// The given one.
        text: String,
        /// Why it does not.
        reason: NoNumber,
    },
    /// There is no value before that could be changed.
    #[error("there is no value to change: leave “{operator}” out")]
    NothingBefore {
        /// The start of the text.
        operator: &'static str,
    },
    /// It is too long to read.
    #[error(
        "the expression is too long: at most 1000 characters, and 50 parentheses within each other, can be read"
    )]
    TooLong,
}

/// Reason why a value is no finite real number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoNumber {
    /// A divisor is 0.
    DivisionByZero,
    /// As the square root of a negative number.
    NotReal,
    /// It is infinite, or beyond the range of numbers.
    TooLarge,
}

impl NoNumber {
    /// Find the reason why an expression's value is not finite.
    pub(in crate::geometry) fn of(value: f64, divides_by_zero: bool) -> Self {
        match value.is_nan() {
            _ if divides_by_zero => Self::DivisionByZero,
            true => Self::NotReal,
            false => Self::TooLarge,
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::DivisionByZero => "divides by zero",
            Self::NotReal => "is not a real number",
            Self::TooLarge => "is too large: numbers up to 1e308 can be used",
        }
    }
}

/// A mistake in an expression.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("column {column}: {error}")]
pub struct ExpressionMistake {
    /// The column of the mistake's first character, counted from 1.
    pub column: usize,
    /// The mistake.
    pub error: ExpressionError,
}

impl ExpressionMistake {
    /// A mistake at a byte of a text.
    pub(super) fn at(text: &str, byte: usize, error: ExpressionError) -> Self {
        let before = text.get(..byte).unwrap_or(text);
        Self {
            column: before.chars().count() + 1,
            error,
        }
    }

    /// Shift the mistake to a text with `characters` characters more at its beginning.
    #[must_use]
    pub fn shifted(self, characters: usize) -> Self {
        Self {
            column: self.column + characters,
            ..self
        }
    }
}
