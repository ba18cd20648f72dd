//! Expressions as they are typed: in formulas, where they are curves of t, and in fields, where they are
//! numbers with units.
//!
//! One grammar reads both. [`NumberContext::read`] is what a field asks; formulas belong to
//! [`references`](crate::geometry::references).

mod brackets;
mod degrees;
mod error;
mod expression;
mod function;
mod measure;
mod number_context;
mod reading;
mod unit;

pub use brackets::parts;
pub use degrees::sin_cos_of_degrees;
pub use error::{ExpressionError, ExpressionMistake, NoNumber};
pub(in crate::geometry) use expression::Expression;
pub(in crate::geometry) use function::Argument;
pub use number_context::NumberContext;
pub use unit::LengthUnit;
