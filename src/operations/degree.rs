//! What the operations that change the degree share.

use super::amount::Amount;
use super::error::OperationError;
use super::operands::Operands;
use super::outcome::{Deviation, Outcome};
use super::parameter::{Kind, Parameter};
use crate::document::ParameterSpan;
use crate::geometry::FloatPolygon;

/// The parameter that is the degree which the curve gets.
pub(super) const fn degree(from: Amount, to: Amount, default: Amount) -> Parameter {
    Parameter {
        name: "degree",
        label: "Degree",
        help: "The degree that the curve gets",
        kind: Kind::whole_of(from, to, default),
    }
}

/// Let the curve of this degree stand in for the curve: the same one, or one near it.
pub(super) fn with_degree(input: &Operands, degree: usize) -> Result<Outcome, OperationError> {
    let polygon = input.polygon()?;
    let changed = polygon.with_degree(degree)?;
    let deviation = Deviation::of(&changed);
    let whole = |polygon: &FloatPolygon| [0.0, polygon.segments() as f64];
    let span = ParameterSpan {
        old: whole(polygon),
        new: whole(&changed.polygon),
    };
    Outcome::renumbered(input, changed.polygon, vec![span], deviation)
}
