//! What splitting and trimming share.

use super::amount::Amount;
use super::parameter::{Kind, Parameter};
use crate::document::{Curve, CurveId, Edit};
use crate::geometry::{End, MAX_SUBDIVISIONS};

/// How often segments may be halved to bring a knot to where the curve is cut.
pub(super) const SUBDIVISIONS: Parameter = Parameter {
    name: "subdivisions",
    label: "Subdivisions",
    help: "How often segments may be halved so that a knot lies at the cut and the part is exact; without a knot there it comes near",
    kind: Kind::Whole {
        from: Amount::Number(0.0),
        to: Amount::Number(MAX_SUBDIVISIONS as f64),
        default: Amount::Number(0.0),
    },
};

/// Forget the target of an end that is cut off, if it has one.
pub(super) fn without_target(id: CurveId, curve: &Curve, end: End) -> Option<Edit> {
    curve.targets.get(end).map(|_| Edit::SetTarget {
        curve: id,
        end,
        target: None,
    })
}
