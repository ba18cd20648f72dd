//! The parameter that chooses an end of the curve.

use super::parameter::{Choice, Kind, Parameter};
use super::values::Values;
use crate::geometry::End;

/// Which end of the curve is meant; its options are in the order of [`End::BOTH`].
pub(super) const END: Parameter = Parameter {
    name: "end",
    label: "End",
    help: "The end of the curve",
    kind: Kind::Choice {
        options: &[Choice::new("start", "Start"), Choice::new("end", "End")],
        default: 1,
    },
};

/// The end that was chosen.
pub(super) fn end(values: &Values) -> End {
    values.choice(&END, &End::BOTH)
}
