//! Kinds of lists that several operations take.

use super::error::OperationError;
use super::input::Input;
use super::parameter::{Kind, Parameter, Unit};
use super::values::Values;
use crate::document::Curve;
use crate::geometry::PolygonError;

/// What it means if none is given: for an input, or whatever the input is.
pub(super) type Meaning = fn(Option<&Input>) -> &'static str;

/// One number, or none.
pub(super) const fn number(none: Meaning) -> Kind {
    Kind::List {
        count: 1..=1,
        whole: false,
        unit: Unit::None,
        none,
        in_space: false,
    }
}

/// One whole number, or none.
pub(super) const fn count(none: Meaning) -> Kind {
    Kind::List {
        count: 1..=1,
        whole: true,
        unit: Unit::None,
        none,
        in_space: false,
    }
}

/// A point or vector of the plane or of space, or none.
pub(super) const fn vector(none: Meaning) -> Kind {
    Kind::List {
        count: 2..=3,
        whole: false,
        unit: Unit::None,
        none,
        in_space: false,
    }
}

/// One whole number of what only curves in space have, or none.
pub(super) const fn count_in_space(none: Meaning) -> Kind {
    Kind::List {
        count: 1..=1,
        whole: true,
        unit: Unit::None,
        none,
        in_space: true,
    }
}

/// A vector that only curves in space have, or none.
pub(super) const fn vector_in_space(none: Meaning) -> Kind {
    Kind::List {
        count: 2..=3,
        whole: false,
        unit: Unit::None,
        none,
        in_space: true,
    }
}

/// Vertices that an operation must not move, beside those that are locked in the document.
pub(super) const LOCKED: Parameter = Parameter {
    name: "locked",
    label: "Also locked",
    help: "Vertices that stay where they are, beside those that are locked already, counted from 0",
    kind: Kind::List {
        count: 1..=usize::MAX,
        whole: true,
        unit: Unit::None,
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

/// The number of a list of one, if it is given.
pub(super) fn given(values: &Values, parameter: &Parameter) -> Option<f64> {
    values.list(parameter).first().copied()
}

/// The whole number of a list of one, if it is given.
pub(super) fn given_count(values: &Values, parameter: &Parameter) -> Option<usize> {
    given(values, parameter).map(|count| count as usize)
}

/// The number of a list of one, if it is given.
///
/// # Errors
/// [`OperationError::OutOfRange`] if it is not positive.
pub(super) fn positive(
    values: &Values,
    parameter: &Parameter,
) -> Result<Option<f64>, OperationError> {
    match given(values, parameter) {
        Some(number) if number <= 0.0 => Err(OperationError::OutOfRange {
            label: parameter.label,
            value: number.to_string(),
            needed: "more than 0".to_owned(),
        }),
        number => Ok(number),
    }
}
