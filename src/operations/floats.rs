//! References as float polygons near them.

use std::sync::Arc;
use std::time::Duration;

use glam::DVec3;

use super::error::OperationError;
use super::feature_change::feature_counts;
use crate::document::{Curve, CurveId, Document, Edit, Group, Reference, quoted};
use crate::geometry::approximation::{
    Approximated, ApproximationRequest, Goal, MOST_SEGMENTS, Placing, approximate_to_tolerance,
};
use crate::geometry::references::{Nurbs, ReferenceCurve, ReferenceForm, formulas};
use crate::geometry::{MAX_DEGREE, ParametricCurve, Progress, bounds, counted, rounded_up};

/// The tolerance without a wish, in units of a reference's size.
const WITHIN: f64 = 1e-4;

/// The least degrees that are tried without a wish. Kinks of the curvature at knots ask for a low one, smooth curves
/// for a high one: the fewest vertices decide.
const LEAST: [usize; 3] = [4, 5, 8];

/// A larger angle between the directions before and after a knot is a corner, in radians: about 0.06°. Smaller ones
/// come from programs that keep six or seven digits.
const CORNER: f64 = 1e-3;

/// Ends that are no farther apart than this share of the size are one point: programs round coordinates.
const CLOSED: f64 = 1e-9;

/// The most levels of curvature and torsion whose features are kept.
const LEVELS: usize = 2;

/// The time that one of many references has at most.
const TIME: Duration = Duration::from_secs(5);

/// The steps across a piece by which the size of a reference is measured.
const STEPS: usize = 8;

/// The float polygons that references get.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FloatRequest {
    /// The degree; without one, of some from 4 on and not below that of a spline, the one with the fewest vertices.
    pub degree: Option<usize>,
    /// How far they may be off; without it 1e-4 of a reference's size.
    pub tolerance: Option<f64>,
}

/// The curves that stand for a reference: one for each part between corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Floats {
    /// The curves, in the group and colour of the reference.
    pub curves: Vec<Curve>,
    /// The number of their vertices.
    pub vertices: usize,
    /// How far they are off at most.
    pub deviation: f64,
    /// Whether that is a proved bound; otherwise it is measured.
    pub is_bounded: bool,
    /// The tolerance.
    pub tolerance: f64,
    /// Whether it is within the tolerance.
    pub is_within: bool,
    /// Whether they have the features of the reference; `None` where these jump at knots, so that nothing is compared.
    pub keeps_features: Option<bool>,
}

/// Make the float polygons that stand for a smooth reference. Parts between corners become curves of their own, whose
/// ends are exact; a reference that closes without any corner becomes a periodic one.
///
/// # Errors
/// [`OperationError`] if it has no points, a part cannot be approximated, or `progress` is cancelled before anything
/// is found.
pub fn floats_of(
    reference: &Reference,
    request: FloatRequest,
    progress: &Progress,
) -> Result<Floats, OperationError> {
    let curve = &reference.curve;
    if !curve.form().is_smooth() {
        return Err(OperationError::PointsOnly);
    }
    curve.check_points()?;
    let tolerance = request.tolerance.unwrap_or(WITHIN * size(curve));
    let Parts { parts, is_round } = Parts::of(curve)?;
    let count = parts.len();
    let mut floats = Floats {
        curves: Vec::with_capacity(count),
        vertices: 0,
        deviation: 0.0,
        is_bounded: true,
        tolerance,
        is_within: true,
        keeps_features: Some(true),
    };
    let is_circle = curve.form().name() == formulas::CIRCLE.name;
    for (index, part) in parts.iter().enumerate() {
        let share = |index: usize| index as f64 / count as f64;
        let own = progress.part(share(index), share(index + 1));
        let own = own.hurried(1.0 / (count - index) as f64);
        let found = near(part, is_round, request.degree, tolerance, &own)?;
        floats.vertices += found.polygon.vertices().len();
        floats.deviation = floats.deviation.max(found.distance());
        floats.is_bounded &= found.deviation.bounded;
        floats.is_within &= found.distance() <= tolerance;
        let is_same = (!found.levels.is_empty()).then(|| found.is_equivalent());
        // A circle has none, a curve near it some: levels that are alike but for the tolerance do not show that.
        let adds = is_circle && feature_counts(&found.polygon) != [0; 2];
        let is_same = is_same.map(|is_same| is_same && !adds);
        floats.keeps_features = floats
            .keeps_features
            .zip(is_same)
            .map(|(all, one)| all && one);
        let name = match count {
            1 => reference.name.clone(),
            _ => format!("{} {}", reference.name, index + 1),
        };
        let mut made = Curve::new(name, found.polygon).in_group(match count {
            1 => reference.group.clone(),
            _ => Group::new(reference.group.names().iter().chain([&reference.name])),
        });
        made.colour = reference.colour;
        made.visible = reference.visible;
        floats.curves.push(made);
    }
    Ok(floats)
}

/// Put float polygons in the place of all smooth references of a document, and tell of each. One that has none within
/// the tolerance stays.
///
/// # Errors
/// [`OperationError::Edit`] if the document cannot take them; never for those that are made here.
pub fn floated(
    document: &Document,
    request: FloatRequest,
    progress: &Progress,
) -> Result<(Document, Vec<String>), OperationError> {
    let references = document.references();
    let smooth = references.filter(|(_, reference)| reference.curve.form().is_smooth());
    let smooth: Vec<(CurveId, Arc<Reference>)> = smooth
        .map(|(id, reference)| (id, reference.clone()))
        .collect();
    let (mut edits, mut told) = (Vec::new(), Vec::new());
    for (index, (id, reference)) in smooth.iter().enumerate() {
        let share = |index: usize| index as f64 / smooth.len() as f64;
        let own = progress.part(share(index), share(index + 1));
        own.set_done(0.0);
        let own = own.hurried(1.0 / (smooth.len() - index) as f64);
        let text = match floats_of(reference, request, &own.limited(TIME)) {
            Ok(floats) if floats.is_within => {
                let text = floats.told();
                edits.push(Edit::Remove(*id));
                let added = floats.curves.into_iter().map(Box::new).map(Edit::Add);
                edits.extend(added);
                text
            }
            Ok(floats) => format!("stays a reference: {}", floats.told()),
            Err(error) => format!("stays a reference: {error}"),
        };
        told.push(format!("{}: {text}", quoted(&reference.name)));
    }
    Ok((document.edited(edits)?, told))
}

impl Floats {
    /// Tell the vertices, the deviation and whether features are kept.
    pub fn told(&self) -> String {
        let pieces = match self.curves.len() {
            1 => String::new(),
            count => format!("{count} curves between corners, "),
        };
        let vertices = counted(self.vertices, "vertex", "vertices");
        let off = rounded_up(self.deviation);
        let off = match self.is_bounded {
            true => format!("off by at most {off}"),
            false => format!("off by {off}, measured"),
        };
        let within = match self.is_within {
            true => "",
            false => ", which is more than the tolerance",
        };
        let features = match self.keeps_features {
            Some(true) => "; features kept",
            Some(false) => "; features differ",
            None => "; features not compared",
        };
        format!("{pieces}{vertices}, {off}{within}{features}")
    }
}

/// The float polygon within the tolerance that has the features and, of several degrees, the fewest vertices; or the
/// nearest to that.
fn near(
    part: &ReferenceCurve,
    is_round: bool,
    degree: Option<usize>,
    tolerance: f64,
    progress: &Progress,
) -> Result<Approximated, OperationError> {
    let own = match part.form() {
        ReferenceForm::Nurbs(nurbs) => nurbs.degree(),
        _ => 1,
    };
    let mut degrees = match degree {
        Some(degree) => vec![degree],
        None => LEAST.map(|least| own.clamp(least, MAX_DEGREE)).to_vec(),
    };
    degrees.dedup();
    let mut best: Option<Approximated> = None;
    let mut refused = OperationError::Cancelled;
    for (index, degree) in degrees.iter().enumerate() {
        // With more vertices than a polygon that is good enough has another degree is no gain.
        let is_good = |it: &&Approximated| it.distance() <= tolerance && it.is_equivalent();
        let fewer = best.as_ref().filter(is_good);
        let fewer = fewer.map(|it| it.polygon.vertices().len().saturating_sub(degree + 1));
        let goal = Goal {
            tolerance,
            spacing: None,
            most_segments: fewer.map_or(MOST_SEGMENTS, |fewer| fewer.min(MOST_SEGMENTS)),
        };
        if goal.most_segments == 0 {
            continue;
        }
        let asked = ApproximationRequest {
            degree: *degree,
            placing: Placing::Quasi,
            // Beyond the continuous derivatives levels jump at knots.
            levels: part.continuity().saturating_sub(1).min(LEVELS),
            periodic: is_round,
            fit_ends: !is_round,
        };
        let own = progress.hurried(1.0 / (degrees.len() - index) as f64);
        match approximate_to_tolerance(part, part.interval(), &goal, &asked, &own) {
            Ok(found) => {
                let rank = |it: &Approximated| {
                    let is_within = it.distance() <= tolerance;
                    (!is_within, !it.is_equivalent(), it.polygon.vertices().len())
                };
                if best.as_ref().is_none_or(|best| rank(&found) < rank(best)) {
                    best = Some(found);
                }
            }
            Err(error) => refused = error.into(),
        }
    }
    best.ok_or(refused)
}

/// The parts of a reference between its corners, which only splines have.
struct Parts {
    parts: Vec<ReferenceCurve>,
    /// Whether the only part closes without a corner.
    is_round: bool,
}

impl Parts {
    fn of(curve: &ReferenceCurve) -> Result<Self, OperationError> {
        let (gap, angle) = joint(curve, [curve.pieces() - 1, 0]);
        let is_smooth = gap <= CLOSED * size(curve) && angle <= CORNER;
        let ReferenceForm::Nurbs(nurbs) = curve.form() else {
            return Ok(Self {
                parts: vec![curve.clone()],
                is_round: is_smooth,
            });
        };
        // Where the curve stops there is no direction to compare.
        let is_corner = |piece: &usize| joint(curve, [piece - 1, *piece]).1 > CORNER;
        let corners = (1..curve.pieces()).filter(is_corner);
        let mut parts = Vec::new();
        let mut rest = nurbs.clone();
        for piece in corners {
            if let Some([before, after]) = divided(&rest, curve.parameter(piece as f64)) {
                parts.push(before);
                rest = after;
            }
        }
        let is_round = is_smooth && parts.is_empty();
        let [from, to] = curve.interval();
        // Of a closed one the last part goes on into the first.
        let first = parts.first().filter(|_| is_smooth);
        let joined = first.and_then(|first| followed(&rest, first, [from, to]));
        let own = match &joined {
            Some(_) => parts.split_off(1),
            None => [parts, vec![rest]].concat(),
        };
        let own = own.into_iter().map(|part| {
            let [start, end] = part.interval();
            (part, [from.max(start), to.min(end)])
        });
        let joined = joined.into_iter().map(|part| {
            let whole = part.interval();
            (part, whole)
        });
        let placed = own.chain(joined).map(|(part, interval)| {
            ReferenceCurve::new(ReferenceForm::Nurbs(part), interval, *curve.placement())
        });
        Ok(Self {
            parts: placed.collect::<Result<_, _>>()?,
            is_round,
        })
    }
}

/// The gap between the end of a piece and the start of another one, and the angle between their directions.
fn joint(curve: &ReferenceCurve, [before, after]: [usize; 2]) -> (f64, f64) {
    let [end, start] = [(before, 1.0), (after, 0.0)].map(|(piece, t)| {
        let mut values = [DVec3::ZERO; 2];
        curve.fill_derivatives(piece, t, &mut values);
        values
    });
    (end[0].distance(start[0]), end[1].angle_between(start[1]))
}

/// A spline that goes on into another one, exactly: clamped where they meet, at the ends of an interval that both come
/// from. `None` where they are not, or where their interval is a part of them.
fn followed(before: &Nurbs, after: &Nurbs, [from, to]: [f64; 2]) -> Option<Nurbs> {
    let (degree, [knots, others]) = (before.degree(), [before.knots(), after.knots()]);
    let last = knots.len().checked_sub(degree + 1)?;
    let is_clamped = knots.get(last..)?.iter().all(|knot| *knot == to)
        && others.get(..=degree)?.iter().all(|knot| *knot == from);
    if !is_clamped || after.degree() != degree {
        return None;
    }
    let shifted = others
        .get(degree + 1..)?
        .iter()
        .map(|knot| knot - from + to);
    let knots = knots.get(..knots.len() - 1)?.iter().copied();
    let points = [before.points(), after.points().get(1..)?].concat();
    let weights = match [before.weights(), after.weights()] {
        [None, None] => None,
        [own, others] => {
            let own = own.map_or(vec![1.0; before.points().len()], <[f64]>::to_vec);
            let others = others.map_or(vec![1.0; after.points().len()], <[f64]>::to_vec);
            let share = own.last()? / others.first()?;
            let others = others.iter().skip(1).map(|weight| share * weight);
            Some(own.iter().copied().chain(others).collect())
        }
    };
    let knots: Vec<f64> = knots.chain(shifted).collect();
    Nurbs::new(degree, knots, points, weights, false).ok()
}

/// The parts of a spline before and after an inner knot at which it is not smooth, exactly; `None` at any other place.
/// No part knows of the other: what is beyond its end is its own polynomial.
fn divided(nurbs: &Nurbs, at: f64) -> Option<[Nurbs; 2]> {
    let (degree, knots, points) = (nurbs.degree(), nurbs.knots(), nurbs.points());
    let first = knots.iter().position(|knot| *knot == at)?;
    let times = knots.iter().filter(|knot| **knot == at).count();
    let next = (first + times).checked_sub(degree + 1)?;
    let part = |knots: Vec<f64>, range: std::ops::Range<usize>| {
        let weights = match nurbs.weights() {
            Some(weights) => Some(weights.get(range.clone())?.to_vec()),
            None => None,
        };
        Nurbs::new(degree, knots, points.get(range)?.to_vec(), weights, false).ok()
    };
    let ends = vec![at; degree + 1];
    let before = [knots.get(..first)?, &ends].concat();
    let after = [&ends, knots.get(first + times..)?].concat();
    let is_corner = times >= degree;
    let parts = [part(before, 0..first)?, part(after, next..points.len())?];
    is_corner.then_some(parts)
}

/// The diagonal of the box around a reference, as samples show.
fn size(curve: &ReferenceCurve) -> f64 {
    let steps = STEPS * curve.pieces();
    let points = (0..=steps).map(|step| curve.jet(step as f64 / STEPS as f64).point);
    let (low, high) = bounds(points);
    low.distance(high)
}
