//! Kinds of lists that several operations take.

use super::error::OperationError;
use super::parameter::{ANY, Kind, Parameter};
use super::values::Values;
use crate::document::Curve;
use crate::geometry::PolygonError;
use crate::geometry::parameters::{OutOfRange, Quantity};

/// Vertices that an operation must not move, beside those that are locked in the document.
pub(super) const LOCKED: Parameter = Parameter {
    name: "locked",
    label: "Also hold vertices",
    help: "Vertices that stay where they are, beside those that are locked already, counted from 0",
    kind: Kind::List {
        count: 1..=usize::MAX,
        whole: true,
        limits: ANY,
        quantity: Quantity::Number,
        words: &[],
        none: |_| "those of the curve",
        in_space: false,
    },
};

/// List the vertices of a curve that must not move.
///
/// # Errors
/// [`PolygonError::NoSuchVertex`] if one is given that the curve does not have.
pub(super) fn locked(curve: &Curve, values: &Values) -> Result<Vec<usize>, OperationError> {
    let mut locked: Vec<usize> = curve.locked_vertices.iter().collect();
    let count = curve.polygon.vertices().len();
    for number in values.list(&LOCKED) {
        let index = *number as usize;
        if index >= count {
            return Err(PolygonError::NoSuchVertex { index, count }.into());
        }
        locked.push(index);
    }
    Ok(locked)
}

/// Refuse numbers of features that an open symmetric curve cannot have, each parameter with its remainder by two: there
/// is an extremum in the middle, and all else comes in pairs.
///
/// # Errors
/// [`OperationError::OutOfRange`].
pub(super) fn check_parity(
    values: &Values,
    parameters: [(&Parameter, usize); 2],
) -> Result<(), OperationError> {
    for (parameter, remainder) in parameters {
        let count = given_count(values, parameter).filter(|count| count % 2 != remainder);
        let needed = ["even", "odd"][remainder % 2];
        if let Some(count) = count {
            return Err(OutOfRange {
                label: parameter.label,
                value: count.to_string().into(),
                needed: format!("{needed}, as the curve is symmetric,").into(),
            }
            .into());
        }
    }
    Ok(())
}

/// The number of a list of one, if it is given.
pub(super) fn given(values: &Values, parameter: &Parameter) -> Option<f64> {
    values.list(parameter).first().copied()
}

/// The whole number of a list of one, if it is given.
pub(super) fn given_count(values: &Values, parameter: &Parameter) -> Option<usize> {
    given(values, parameter).map(|count| count as usize)
}
