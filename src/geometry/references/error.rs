//! Errors of references, with their columns in the text.

use thiserror::Error;

use super::nurbs::NurbsError;
use crate::geometry::expressions::{ExpressionError, ExpressionMistake};
use crate::geometry::parameters::OutOfRange;

/// A reason why a form, an interval or a placement makes no curve.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ReferenceError {
    /// There is no kind of this name.
    #[error("there is no reference “{name}”: the references are {known}")]
    NoSuchKind {
        /// The name given.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// The kind has no such parameter.
    #[error("{kind} has no parameter “{name}”: it has {known}")]
    NoSuchParameter {
        /// The kind's name.
        kind: &'static str,
        /// The name given.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// A parameter is given twice.
    #[error("“{name}” is given twice")]
    Twice {
        /// The parameter.
        name: String,
    },
    /// A part of a text is no assignment.
    #[error("“{text}” gives no parameter a value: write it as name=value")]
    NoAssignment {
        /// The part.
        text: String,
    },
    /// An expression means nothing.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// A number depends on t.
    #[error("“{text}” depends on t: a number is needed")]
    NotConstant {
        /// The expression given.
        text: String,
    },
    /// A mistake in one of a formula's coordinates.
    #[error("{coordinate}: {mistake}")]
    InFormula {
        /// The coordinate.
        coordinate: &'static str,
        /// The mistake, with its column in the coordinate's text.
        mistake: Box<ReferenceTextError>,
    },
    /// A coordinate of a formula is missing.
    #[error("the formula gives no {coordinate}: write formula:x=…;y=… and, in space, ;z=…")]
    NoCoordinate {
        /// The coordinate.
        coordinate: &'static str,
    },
    /// The numbers of values and parameters differ.
    #[error("{found} values for the {needed} parameters of {kind}")]
    ValueCount {
        /// The kind's name.
        kind: &'static str,
        /// The number of values.
        found: usize,
        /// The number of parameters.
        needed: usize,
    },
    /// A value is not allowed.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// Numbers are no B-spline.
    #[error(transparent)]
    Nurbs(#[from] NurbsError),
    /// The interval is empty or not finite.
    #[error(
        "the interval from t = {from} to t = {to} is empty: give two numbers, the smaller one first"
    )]
    EmptyInterval {
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// The interval leaves where the curve can be computed.
    #[error("t = {t} is out of range: with these parameters t can run from {from} to {to}")]
    OutsideDomain {
        /// The end of the interval that lies outside.
        t: f64,
        /// The smallest t.
        from: f64,
        /// The largest t.
        to: f64,
    },
    /// The curve has no point somewhere.
    #[error(
        "the curve has no point, or no direction, at t = {t}: give an interval without this place with the reference, such as from=1 and to=2"
    )]
    NotFinite {
        /// The parameter.
        t: f64,
    },
    /// The curve is a single point.
    #[error("the formulas give one point, the same for every t: let x or y depend on t")]
    OnePoint,
    /// The placement is no motion with a scale.
    #[error(
        "a placement needs a rotation, a scale from 1e-30 to 1e30 and a translation of finite numbers"
    )]
    BadPlacement,
    /// There are too few points for a line.
    #[error("{} no line: at least 2 are needed", if *found == 1 { "1 point makes".to_owned() } else { format!("{found} points make") })]
    TooFewPoints {
        /// The number of points.
        found: usize,
    },
    /// A point is not finite or too far away.
    #[error("point {index}: only finite coordinates up to 1e100 can be used")]
    BadPoint {
        /// The point, counted from 0.
        index: usize,
    },
    /// A weight is negative, not finite or too large, or not there.
    #[error("point {index} has no weight that can be used: from 0 to 1e100")]
    BadWeight {
        /// The point, counted from 0.
        index: usize,
    },
    /// No point has a weight above 0.
    #[error("no point has a weight above 0")]
    NoWeight,
}

/// A mistake in the text of a reference.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("column {column}: {error}")]
pub struct ReferenceTextError {
    /// The column of the mistake's first character, counted from 1.
    pub column: usize,
    /// The mistake.
    pub error: ReferenceError,
}

impl From<ExpressionMistake> for ReferenceTextError {
    fn from(mistake: ExpressionMistake) -> Self {
        Self {
            column: mistake.column,
            error: mistake.error.into(),
        }
    }
}
