//! Kinds of lists that several operations take.

use super::error::OperationError;
use super::parameter::{Kind, Parameter, Unit};
use super::values::Values;
use crate::document::Curve;
use crate::geometry::PolygonError;

/// One number, or none.
pub(super) const fn number(none: &'static str) -> Kind {
    Kind::List {
        count: 1..=1,
        whole: false,
        unit: Unit::None,
        none,
    }
}

/// One whole number, or none.
pub(super) const fn count(none: &'static str) -> Kind {
    Kind::List {
        count: 1..=1,
        whole: true,
        unit: Unit::None,
        none,
    }
}

/// A point or vector of the plane or of space, or none.
pub(super) const fn vector(none: &'static str) -> Kind {
    Kind::List {
        count: 2..=3,
        whole: false,
        unit: Unit::None,
        none,
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
        none: "those of the curve",
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
