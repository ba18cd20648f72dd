//! What operations on ends share: the targets of a curve, and what is left of them.

use super::editable::{check_measurable, open};
use super::error::OperationError;
use super::operands::Operands;
use super::outcome::{Annotation, Deviation, Outcome};
use crate::document::{Curve, CurveId};
use crate::geometry::end_correction::{EndDifference, EndTarget};
use crate::geometry::fairing::requirement::{PlaceRequest, Requirement};
use crate::geometry::{End, FloatPolygon, significant};

/// The tolerance of ends that is offered, in units of the size of the polygon.
pub(super) const SHARE_OF_SIZE: f64 = 1e-9;

/// Require an end of an open curve to meet a target within a length.
pub(super) fn place_of(
    polygon: &FloatPolygon,
    end: End,
    target: EndTarget,
    tolerance: f64,
) -> Requirement {
    Requirement::Place(PlaceRequest {
        u: end.parameter(polygon),
        target,
        tolerance: Some(tolerance),
        speed: None,
    })
}

/// Refuse a curve that is locked or hidden, has no ends, or no target.
pub(super) fn check_targets(input: &Operands) -> Result<(), OperationError> {
    let curve = open(input, "corrected at its ends")?;
    check_measurable(curve)?;
    if curve.targets.list().is_empty() {
        return Err(OperationError::NoTarget { end: None });
    }
    Ok(())
}

/// The target of an end.
///
/// # Errors
/// [`OperationError::NoTarget`].
pub(super) fn target(curve: &Curve, end: End) -> Result<EndTarget, OperationError> {
    let target = curve.targets.get(end);
    target.ok_or(OperationError::NoTarget { end: Some(end) })
}

/// What is left of a curve's targets, as a length: the largest of both ends.
pub(super) fn residual(curve: &Curve, polygon: &FloatPolygon) -> f64 {
    let size = polygon.size();
    let left = curve.targets.list().into_iter();
    left.map(|(end, target)| EndDifference::between(polygon, end, &target).residual(size))
        .fold(0.0, f64::max)
}

/// Say at which end a direction is asked for where the curve has none, if there is such an end.
pub(super) fn cusp(curve: &Curve, polygon: &FloatPolygon) -> Option<String> {
    let asks = |end: &End| curve.targets.get(*end)?.direction;
    let has_none = |end: &End| polygon.end_jet(*end).tangent().is_none();
    let mut ends = End::BOTH.into_iter();
    let end = ends.find(|end| asks(end).is_some() && has_none(end))?;
    let name = end.name();
    Some(format!("The curve has no direction at its {name}: a cusp"))
}

/// Put a corrected polygon in place, and tell how far the curve moves.
///
/// # Errors
/// [`OperationError::Edit`] if it moves a locked vertex; [`OperationError::Polygon`] if it cannot
/// be measured how far the curve moves.
pub(super) fn corrected(
    id: CurveId,
    curve: &Curve,
    polygon: FloatPolygon,
) -> Result<Outcome, OperationError> {
    curve.check_held(&polygon)?;
    let deviation = Deviation::AtMost(curve.polygon.deviation(&polygon)?);
    Ok(Outcome::reshaped(id, polygon, deviation))
}

/// Say how an end moves with the other one, whose terminal vertices it shares. `None` if it stays.
pub fn moved_with(before: &FloatPolygon, end: End, after: &FloatPolygon) -> Option<String> {
    let now = after.end_jet(end);
    let place = EndTarget::keeping(&before.end_jet(end));
    let size = before.size();
    let difference = EndDifference::of_jet(&now, after.is_planar(), &place);
    if difference.residual(size) <= SHARE_OF_SIZE * size {
        return None;
    }
    let moved = significant(difference.vector.length(), 3);
    let turned = significant(difference.angle.abs().to_degrees(), 3);
    let name = end.name();
    Some(format!(
        "The {name} moves by {moved} and turns by {turned}°, as both ends share vertices: “Both ends at once” keeps it"
    ))
}

/// Annotation the target of an end, and the way to it.
pub(super) fn annotations(curve: &Curve, end: End) -> Vec<Annotation> {
    let Some(target) = curve.targets.get(end) else {
        return Vec::new();
    };
    let from = curve.polygon.end_jet(end).point;
    let to = target.point;
    vec![Annotation::Arrow { from, to }, Annotation::Point(to)]
}
