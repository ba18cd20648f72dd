//! What the operations that change the degree share.

use super::amount::Amount;
use super::error::OperationError;
use super::input::Input;
use super::outcome::{Deviation, Outcome};
use super::parameter::{Kind, Parameter};

/// The parameter that is the degree which the curve gets.
pub(super) const fn degree(from: Amount, to: Amount, default: Amount) -> Parameter {
    Parameter {
        name: "degree",
        label: "Degree",
        help: "The degree that the curve gets",
        kind: Kind::Whole { from, to, default },
    }
}

/// Let the curve of this degree stand in for the curve: the same one, or one near it.
pub(super) fn with_degree(input: &Input, degree: usize) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let changed = curve.polygon.with_degree(degree)?;
    let deviation = Deviation::of(&changed);
    Ok(Outcome::renumbered(id, curve, changed.polygon, deviation))
}
