//! Kinds of whole numbers that several operations take.

use super::amount::Amount;
use super::parameter::Kind;
use crate::geometry::MAX_DEGREE;

/// Whole numbers in a range.
pub(super) const fn between(from: usize, to: usize, default: usize) -> Kind {
    Kind::Whole {
        from: Amount::Number(from as f64),
        to: Amount::Number(to as f64),
        default: Amount::Number(default as f64),
    }
}

/// The degrees that there are.
pub(super) const fn degree(default: usize) -> Kind {
    between(1, MAX_DEGREE, default)
}
