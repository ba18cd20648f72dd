//! A curve whose ends are joined, so that it is periodic.

use std::time::Duration;

use super::bridge::{BRIDGE, annotations, detour, fault, figures, found, knuckle, remarks};
use super::crossing::new_crossing;
use super::cutting::without_target;
use super::editable::open;
use super::error::OperationError;
use super::fit_piece::features;
use super::inputs::Inputs;
use super::join::{ALSO_WITHIN, WITHIN};
use super::lists::given_count;
use super::make_symmetric::smaller_side;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::values::Values;
use crate::document::{Curve, CurveId, Edit, ParameterSpan};
use crate::geometry::approximation::merging::{MergeError, joint_of};
use crate::geometry::approximation::{SMALL_GAP, blend, close_within};
use crate::geometry::fairing::bends::Bends;
use crate::geometry::fairing::bridging::{Bridged, close};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::{
    BezierPolygon, End, FloatPolygon, Progress, cross, largest_curvature, significant,
};

/// A new curve that bends so many times as sharply as the curve, and as a blend of its ends, is no use.
const SHARPER: f64 = 4.0;
const SHARPER_THAN_BLEND: f64 = 1.25;

/// A bridge that bends so many times as sharply as the curve, and as a blend of its ends, has a lump.
const LUMP: f64 = 1.25;

/// Ends that overlap are no farther apart than this share of the size.
const OVERLAP: f64 = 0.25;

/// A curve is straight if its box is no wider than this share of its size.
const STRAIGHT: f64 = 1e-9;

/// How long a new curve near the curve may take.
const NEAR: Duration = Duration::from_secs(10);

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "close",
    label: "Close curve",
    help: "Join the ends of a curve by a harmonious bridge, or where they meet: it becomes periodic",
    inputs: Inputs::One,
    each: true,
    parameters: &[BRIDGE],
    check: |input| open(input, "closed").map(drop),
    unused: |_| &[],
    run,
};

/// Bridge the ends, and keep the curve. Where they meet, or no bridge fits, a curve near it is closed instead, if there
/// is one.
fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let (_, curve) = input.curve()?;
    let count = given_count(values, &BRIDGE);
    let is_free = count.is_none() && curve.locked_vertices.iter().next().is_none();
    let size = BezierPolygon::from_float(&curve.polygon).size();
    let meets = joint_of(&curve.polygon, &curve.polygon).meets(WITHIN * size);
    let near = |sharpest: f64| match is_free {
        true => closed_near(input, size, sharpest, progress),
        false => Ok(None),
    };
    if meets && let Some(closed) = near(f64::INFINITY)? {
        return Ok(closed);
    }
    let found = match found(close(&curve.polygon, count, progress)) {
        Err(OperationError::Cancelled) => return Err(OperationError::Cancelled),
        found => found,
    };
    let lump = found.as_ref().ok().and_then(|it| lump(&curve.polygon, it));
    let bridged = found.and_then(|found| bridged(input, &found));
    let is_clean = bridged.as_ref().is_ok_and(|it| it.requirements.is_empty());
    let sharpest = match (is_clean, lump) {
        (true, lump) => lump.filter(|_| !curve.polygon.is_rational()),
        (false, _) => Some(f64::INFINITY),
    };
    if !meets
        && let Some(sharpest) = sharpest
        && let Some(closed) = near(sharpest)?
    {
        return Ok(closed);
    }
    bridged
}

/// The largest curvature of a bridge, if it is larger than the curve and a blend of its ends ask for.
fn lump(curve: &FloatPolygon, found: &Bridged) -> Option<f64> {
    let on_bridge = largest_curvature(&found.polygon, found.joint);
    let asked = blend(curve, curve).map_or(0.0, |between| sharpest(&between));
    (on_bridge > LUMP * asked.max(sharpest(curve))).then_some(on_bridge)
}

/// The largest curvature of a curve.
fn sharpest(polygon: &FloatPolygon) -> f64 {
    largest_curvature(polygon, [0.0, polygon.segments() as f64])
}

/// The curve with a bridge between its ends.
fn bridged(input: &Operands, found: &Bridged) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let segments = curve.polygon.segments();
    let span = ParameterSpan {
        old: [0.0, segments as f64],
        new: [0.0, (segments << found.halvings[0]) as f64],
    };
    let mut outcome = closed(input, &found.polygon, vec![span], Deviation::Exact)?;
    outcome.renumbered = false;
    outcome.figures = figures(found);
    outcome.remarks.extend(remarks(found));
    let fault = fault(found, [&curve.polygon; 2]);
    let knuckle = knuckle(found).filter(|_| fault.is_none());
    outcome.warnings.extend(knuckle);
    let detour = detour(found, &curve.polygon);
    outcome.warnings.extend(detour.filter(|_| fault.is_none()));
    let crossing = new_crossing(&[&curve.polygon], &found.polygon);
    // There is nothing to go round.
    let straight = (smaller_side(&curve.polygon) <= STRAIGHT * curve.polygon.size())
        .then(|| "A straight curve folds back on itself when it is closed".to_owned());
    if fault.is_some() || crossing.is_some() || straight.is_some() {
        let failed = Requirement::Failed { left: None };
        outcome.requirements = vec![(id, vec![failed])];
    }
    outcome.warnings.extend(crossing.or(straight));
    let advice = match overlaps(&curve.polygon) {
        true => "the ends overlap, trim the curve first",
        false => "turn the ends towards each other",
    };
    outcome
        .warnings
        .extend(fault.map(|fault| format!("{fault}: {advice}")));
    outcome.annotations = annotations(found);
    outcome.joint = Some(found.joint);
    Ok(outcome)
}

/// Whether ends that are near to each other each run past the other one.
fn overlaps(polygon: &FloatPolygon) -> bool {
    let [start, finish] = End::BOTH.map(|end| polygon.end_jet(end));
    let way = start.point - finish.point;
    let is_near = way.length() <= OVERLAP * BezierPolygon::from_float(polygon).size();
    is_near && start.first.dot(way) < 0.0 && finish.first.dot(way) < 0.0
}

/// A periodic curve near the curve, with a blend between ends that are apart; `None` if there is none with nothing to
/// warn of, or if it bends more sharply than allowed.
fn closed_near(
    input: &Operands,
    size: f64,
    most_curvature: f64,
    progress: &Progress,
) -> Result<Option<Outcome>, OperationError> {
    let (id, curve) = input.curve()?;
    let gap = joint_of(&curve.polygon, &curve.polygon).gap;
    let moved = if gap <= SMALL_GAP * size { gap } else { 0.0 };
    let (tolerance, most) = (WITHIN * size, moved.max(ALSO_WITHIN * size));
    let limited = progress.unshown().limited(NEAR);
    let found = match close_within(&curve.polygon, tolerance, &limited) {
        Err(MergeError::Cancelled) if !limited.is_late() => return Err(OperationError::Cancelled),
        Err(_) => return Ok(None),
        Ok(found) if found.deviation > most => return Ok(None),
        Ok(found) => found,
    };
    let place = |u: usize| found.tracks[0].at(u as f64);
    let segments = curve.polygon.segments();
    let span = |u: usize| ParameterSpan {
        old: [u as f64, u as f64 + 1.0],
        new: [place(u), place(u + 1)],
    };
    let spans = (0..segments).map(span).collect();
    let joint = [place(segments), found.polygon.segments() as f64];
    let between = blend(&curve.polygon, &curve.polygon);
    let relative = |polygon: &FloatPolygon| size * sharpest(polygon);
    let blended = between.as_ref().map_or(0.0, relative);
    let [was, now] = [&curve.polygon, &found.polygon].map(relative);
    let is_sharper = now > SHARPER * was.max(1.0) && now > SHARPER_THAN_BLEND * blended
        || now > size * most_curvature;
    // Between ends on both sides of the curve nothing can lie that does not cross it.
    let is_across = between.is_some_and(|between| cross(&[&curve.polygon, &between]));
    let crossing = new_crossing(&[&curve.polygon], &found.polygon);
    // Where the blend itself bends sharply, so must the curve.
    let is_knuckle =
        blended <= SHARPER * was.max(1.0) && Bends::between(&found.polygon, joint).is_knuckle();
    if crossing.is_some() && !is_across || is_knuckle || is_sharper || found.waves > 0 {
        return Ok(None);
    }
    let deviation = Deviation::Measured(found.deviation);
    let mut outcome = closed(input, &found.polygon, spans, deviation)?;
    let limit = Requirement::Limit {
        found: found.deviation,
        most,
    };
    let [before, now] = found.extrema;
    let requirements = features(Some(now), None).into_iter().chain([limit]);
    outcome.requirements = vec![(id, requirements.collect())];
    outcome.figures = vec![
        Figure::count("vertices", "Vertices", found.polygon.vertices().len()),
        Figure::count("extrema_before", "Curvature extrema before", before),
        Figure::count("extrema", "Curvature extrema", now),
    ];
    let moved = significant(found.deviation, 3);
    let why = match (gap <= tolerance, most_curvature.is_finite()) {
        (true, _) => "The ends meet",
        (false, true) => "A bridge would bend more sharply",
        (false, false) => "No bridge fits between the ends",
    };
    outcome
        .remarks
        .push(format!("{why}: a new curve within {moved} is closed"));
    outcome.warnings.extend(crossing);
    if curve.polygon.is_rational() && !found.polygon.is_rational() {
        outcome
            .remarks
            .push("The closed curve has no weights".to_owned());
    }
    let marks = joint.map(|at| Annotation::Point(found.polygon.point(at)));
    outcome.annotations.extend(marks);
    outcome.joint = Some(joint);
    Ok(Some(outcome))
}

/// Give the curve a periodic polygon: its ends and what belongs to them go.
fn closed(
    input: &Operands,
    polygon: &FloatPolygon,
    spans: Vec<ParameterSpan>,
    deviation: Deviation,
) -> Result<Outcome, OperationError> {
    let (id, curve): (CurveId, &Curve) = input.curve()?;
    let mut edits: Vec<Edit> = Vec::new();
    for end in End::BOTH {
        edits.extend(without_target(input.document(), id, curve, end));
    }
    let mut outcome = Outcome::renumbered(input, polygon.clone(), spans, deviation)?;
    edits.append(&mut outcome.edits);
    outcome.edits = edits;
    Ok(outcome)
}
