//! Warnings of end corrections that change the curve more than they correct it.

use std::f64::consts::PI;

use super::crossing::new_crossing;
use super::error::OperationError;
use crate::document::Curve;
use crate::geometry::end_correction::{EndDifference, EndTarget};
use crate::geometry::{BezierPolygon, End, FloatPolygon, significant};

/// A curve that moves more than so many times as far as its ends has changed as a whole. Spreading a
/// correction evenly over the polygon stays below.
const MUCH: f64 = 10.0;

/// A curve that moves by more than this share of its size, and more than twice as far as its ends, has changed as a
/// whole, too: curvatures and directions say little about how far a curve may move.
const FAR: f64 = 0.01;

/// A curve that moves by more than this share of its size, more than [`MUCH`] times as far as its ends, and farther than
/// half of it would turn with them, is another curve.
const ANOTHER: f64 = 0.1;

/// A target direction that turns an end by more than this angle seems to point the wrong way.
const BACK: f64 = 0.6 * PI;

/// Advise to refine a polygon before its ends are corrected: so many vertices more fade a correction out near each end.
pub(super) fn refine_first(polygon: &FloatPolygon) -> String {
    let count = polygon.vertices().len() + 2 * polygon.degree();
    format!("refine to {count} vertices first")
}

/// Say where a correction moves the curve far, turns it over, as `turned` says, or leads it out of its plane.
///
/// # Errors
/// [`OperationError::Polygon`] if it cannot be measured how far the curve moves.
pub(super) fn warnings_of_change(
    curve: &Curve,
    after: &FloatPolygon,
    turned: Option<&str>,
) -> Result<Vec<String>, OperationError> {
    let before = &curve.polygon;
    let mut warnings = Vec::new();
    let refine = refine_first(before);
    let advice = format!("{refine}, or hold vertices with “Also hold vertices” (--locked)");
    if let Some([moved, shift]) = moved_far(curve, after)? {
        let [moved, shift] = [moved, shift].map(|length| significant(length, 3));
        warnings.push(format!(
            "The curve moves by up to {moved}, its ends by {shift}: {advice}"
        ));
    }
    warnings.extend(points_back(curve));
    if let Some(turned) = turned {
        warnings.push(format!("{turned}: {advice}, or turn the target direction"));
    }
    let crossing = new_crossing(&[before], after);
    warnings.extend(crossing.map(|crossing| format!("{crossing}: {advice}")));
    if before.is_planar() && !after.is_planar() {
        warnings.push(
            "A target lies outside the plane z = 0: the curve becomes a curve in space".to_owned(),
        );
    }
    Ok(warnings)
}

/// Say which targets turn an end so far that their directions seem to point the wrong way.
fn points_back(curve: &Curve) -> impl Iterator<Item = String> {
    let targets = curve.targets.list().into_iter();
    targets.filter_map(|(end, target)| {
        let turn = EndDifference::between(&curve.polygon, end, &target).angle;
        (turn.abs() > BACK).then(|| {
            let (name, turn) = (end.name(), significant(turn.abs().to_degrees(), 3));
            format!(
                "The target direction turns the {name} by {turn}°: the opposite one may be meant"
            )
        })
    })
}

/// Whether a correction makes another curve of it.
///
/// # Errors
/// [`OperationError::Polygon`] if it cannot be measured.
pub(super) fn is_another(curve: &Curve, after: &FloatPolygon) -> Result<bool, OperationError> {
    let size = BezierPolygon::from_float(&curve.polygon).size();
    let targets = curve.targets.list().into_iter();
    let turns = targets.map(|(end, target)| {
        EndDifference::between(&curve.polygon, end, &target)
            .angle
            .abs()
    });
    // Half of a curve may turn with its end.
    let turned = 0.5 * size * turns.fold(0.0, f64::max);
    let far = moved_far(curve, after)?;
    Ok(far.is_some_and(|[moved, shift]| moved > (ANOTHER * size).max(MUCH * shift).max(turned)))
}

/// How far a correction moves the curve, and how far its ends, if the curve changes as a whole.
///
/// # Errors
/// [`OperationError::Polygon`] if it cannot be measured.
pub(super) fn moved_far(
    curve: &Curve,
    after: &FloatPolygon,
) -> Result<Option<[f64; 2]>, OperationError> {
    let before = &curve.polygon;
    let targets = curve.targets.list().into_iter();
    let asked = targets
        .clone()
        .map(|(end, target)| correction(before, end, &target));
    let asked = asked.fold(0.0, f64::max);
    let shifts = targets.map(|(end, target)| before.end_jet(end).point.distance(target.point));
    let shift = shifts.fold(0.0, f64::max);
    let moved = before.deviation(after)?;
    let size = BezierPolygon::from_float(before).size();
    let is_far = moved > MUCH * asked || moved > (FAR * size).max(2.0 * shift);
    Ok(is_far.then_some([moved, shift]))
}

/// The size of a correction as a length: the shift, or how far the terminal legs turn or bend.
fn correction(polygon: &FloatPolygon, end: End, target: &EndTarget) -> f64 {
    let vertices = polygon.terminal_vertices(end);
    let vertices = polygon.vertices().get(vertices).unwrap_or_default();
    let legs = vertices.windows(2).map(|leg| leg[0].distance(leg[1]));
    let leg = legs.fold(0.0, f64::max);
    EndDifference::between(polygon, end, target).residual(leg)
}
