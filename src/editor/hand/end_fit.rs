//! The end-fit tool's words and state: the paper's seven steps.

use glam::{DVec2, DVec3};

use crate::analysis::CurveAnalysis;
use crate::document::{Curve, CurveId, Document, EndMatch, MatchPlace};
use crate::editor::hand::end_axis::EndAxis;
use crate::editor::reply::Reply;
use crate::editor::view::hit::REACH;
use crate::editor::view::viewport::Viewport;
use crate::geometry::end_correction::{EndDifference, EndOverlap, EndTarget};
use crate::geometry::{Continuity, End, Jet, ParametricCurve};
use crate::operations::LargestMove;

/// The loop's tolerance that is offered, in units of the polygon's size.
const TOLERANCE: f64 = 1e-9;

/// What evaluating an end point costs in accuracy, in units of its coordinates.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The largest figure that counts as rounding after a correction, relative to the largest coordinate. A derivative is
/// a difference of up to a dozen vertices, each of them rounded.
const NOISE: f64 = 64.0 * f64::EPSILON;

/// The figures of the seven steps at one end.
#[derive(Clone, Debug, PartialEq)]
pub struct EndFitReport {
    /// The end that is being corrected.
    pub end: End,
    /// Whether the curve is planar: figures in z are left out then.
    pub planar: bool,
    /// Why the curve's shape cannot be changed now: of a locked curve only the targets can be
    /// set.
    pub refusal: Option<String>,
    /// The degree n.
    pub degree: usize,
    /// The number of terminal vertices, which steps 5 and 6 move.
    pub terminal: usize,
    /// The number of vertices N.
    pub vertices: usize,
    /// The actual end, as a target that it meets: its direction is the unit tangent, none at a cusp.
    pub actual: EndTarget,
    /// The target as a whole; `None` until it is set.
    pub target: Option<EndTarget>,
    /// The axis on which the end lies.
    pub axis: Option<EndAxis>,
    /// Step 3: the difference vector; 0 where it is only rounding.
    pub difference: DVec3,
    /// Step 3: the difference angle, in radians.
    pub angle: f64,
    /// The larger distance from the target of the ends that have one.
    pub remaining_distance: f64,
    /// The larger angle from the target direction of these ends, in radians.
    pub remaining_angle: f64,
    /// The size of the polygon.
    pub size: f64,
    /// What is only rounding.
    pub noise: EndNoise,
    /// The tolerance that the loop works to, as a length.
    pub tolerance: f64,
    /// Whether every end that has a target is within the tolerance.
    pub within: bool,
    /// The number of ends that have a target.
    pub targets: usize,
    /// Passes made by "repeat" since the targets last changed.
    pub passes: usize,
    /// The difference from the target.
    pub missing: Option<EndDifference>,
    /// The match of the end.
    pub matched: Option<MatchReport>,
    /// The ends that follow this curve: name of the curve and end.
    pub followers: Vec<(String, End)>,
    /// How much the next pick takes of another curve.
    pub continuity: Continuity,
    /// Whether the next pick is kept matched.
    pub live: bool,
    /// Whether the next click on the canvas picks a target from another curve.
    pub picking: bool,
    /// How the two ends share their vertices.
    pub overlap: EndOverlap,
    /// The reply to the last action.
    pub outcome: Option<Reply>,
    /// The largest move of a vertex by the last "both ends at once", and which vertex.
    pub largest_move: Option<LargestMove>,
}

/// The errors of an end that are no larger than rounding makes them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndNoise {
    /// Of a distance: 64 units of rounding of the largest coordinate.
    pub length: f64,
    /// Of an angle in radians: that distance over the speed |C′| at the end.
    pub angle: f64,
    /// Of a curvature: that angle over the speed.
    pub curvature: f64,
    /// Of a curvature slope: that curvature over the speed.
    pub slope: f64,
}

impl EndNoise {
    /// The noise of an end with a speed, of a polygon with coordinates up to `far`; without speed only distances have
    /// any.
    fn of(far: f64, speed: f64) -> Self {
        let length = NOISE * far;
        let share = if speed > 0.0 { speed.recip() } else { 0.0 };
        let angle = length * share;
        let curvature = angle * share;
        Self {
            length,
            angle,
            curvature,
            slope: curvature * share,
        }
    }
}

/// The match of an end.
#[derive(Clone, Debug, PartialEq)]
pub struct MatchReport {
    /// The name of the other curve.
    pub source: String,
    /// The match.
    pub matched: EndMatch,
    /// The difference from the source at each level, up to G3.
    pub missing: EndDifference,
    /// Whether the match is met.
    pub met: bool,
}

impl EndFitReport {
    /// Whether the curve's vertices can be moved.
    pub fn can_move(&self) -> bool {
        self.refusal.is_none()
    }

    /// The target direction.
    pub fn target_direction(&self) -> Option<DVec3> {
        self.target?.direction
    }

    /// The angle of a planar curve's direction from the x axis, in radians.
    pub fn angle_of(&self, direction: DVec3) -> Option<f64> {
        self.planar.then(|| direction.truncate().to_angle())
    }

    /// Whether all that the target of this end asks for is there within the tolerance.
    pub fn is_met(&self) -> bool {
        let left = self.missing.map(|missing| missing.residual(self.size));
        left.is_some_and(|left| left <= self.tolerance)
    }
}

/// Something that the end-fit panel asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EndFitAction {
    /// Work on this end.
    Choose(End),
    /// Show the closed S-polygon (step 2), or go back to the float one (step 4).
    ShowClosed(bool),
    /// Put the target where the actual end is.
    TargetActual,
    /// Type the target point.
    SetPoint(DVec3),
    /// Type the target direction, or free it.
    SetDirection(Option<DVec3>),
    /// Type the target's curvature, or free it.
    SetCurvature(Option<f64>),
    /// Type the normal of the target's osculating plane, or free it.
    SetNormal(Option<DVec3>),
    /// Type the slope of the target's curvature, or free it.
    SetSlope(Option<f64>),
    /// Set the whole target.
    SetTarget(EndTarget),
    /// Remove the target and the match.
    ClearTarget,
    /// Pick the target from another curve by the next click: from an end, or any point.
    PickFromCurve,
    /// Choose how much is picked of another curve, or kept matched.
    SetContinuity(Continuity),
    /// Choose whether what is picked is kept matched while the other curve changes. Without that
    /// the target stays as it is now.
    KeepMatched(bool),
    /// Turn the target direction round.
    TurnRound,
    /// Translate the terminal vertices by the difference vector (step 5).
    Translate,
    /// Rotate them by the difference angle (step 6).
    Rotate,
    /// Repeat steps 2 to 6 on every end that has a target until within the tolerance (step 7).
    Repeat,
    /// Correct both ends at once by the least disturbance.
    BothAtOnce,
    /// Set the tolerance, as a length.
    SetTolerance(f64),
}

/// The label of the step that matches an end.
pub const MATCH_END: &str = "Match end";

/// Hold the settings of the end-fit tool.
#[derive(Clone, Debug, PartialEq)]
pub struct EndFitSettings {
    /// The end that is being corrected.
    pub end: End,
    /// Whether the next click picks a target from another curve.
    pub picking: bool,
    /// How much it takes.
    pub continuity: Continuity,
    /// Whether it is kept matched.
    pub live: bool,
    /// What the last pick took, to be kept matched afterwards.
    pub picked: Option<EndMatch>,
    /// Whether the closed S-polygon stands in for the float one, as in steps 2 and 3.
    pub closed: bool,
    /// The tolerance that was typed; `None` offers one by the curve's size.
    pub tolerance: Option<f64>,
}

impl Default for EndFitSettings {
    fn default() -> Self {
        Self {
            end: End::Finish,
            picking: false,
            continuity: Continuity::default(),
            live: false,
            picked: None,
            closed: false,
            tolerance: None,
        }
    }
}

/// The result of the last action of the end-fit panel, valid for one curve and one revision.
#[derive(Clone, Debug)]
pub struct LastAction {
    /// The curve.
    pub curve: CurveId,
    /// The end that it was for; `None` for all ends.
    pub end: Option<End>,
    /// The document's revision afterwards.
    pub revision: u64,
    /// The reply.
    pub reply: Reply,
    /// Passes made since the targets last changed.
    pub passes: usize,
    /// The largest move of a vertex by a joint correction, and which vertex.
    pub largest_move: Option<LargestMove>,
}

impl EndFitSettings {
    /// The tolerance for a curve, as a length.
    pub fn tolerance_for(&self, curve: &Curve) -> f64 {
        self.tolerance.unwrap_or(TOLERANCE * curve.polygon.size())
    }

    /// Collect the figures of the seven steps.
    pub fn report(
        &self,
        document: &Document,
        id: CurveId,
        analysis: &CurveAnalysis,
        last: Option<&LastAction>,
    ) -> EndFitReport {
        let curve = analysis.curve().clone();
        let polygon = &curve.polygon;
        let jet = polygon.end_jet(self.end);
        let target = curve.targets.get(self.end);
        let difference = target.map(|target| EndDifference::between(polygon, self.end, &target));
        let planar = analysis.is_planar();
        let size = polygon.size();
        let tolerance = self.tolerance_for(&curve);
        let targets = curve.targets.list();
        let remaining: Vec<EndDifference> = targets
            .iter()
            .map(|(end, target)| EndDifference::between(polygon, *end, target))
            .collect();
        let largest =
            |of: &dyn Fn(&EndDifference) -> f64| remaining.iter().map(of).fold(0.0, f64::max);
        let residual = largest(&|left| left.residual(size));
        EndFitReport {
            end: self.end,
            planar,
            refusal: curve.check_editable().err().map(|error| error.to_string()),
            degree: polygon.degree(),
            terminal: polygon.terminal_vertices(self.end).len(),
            vertices: polygon.vertices().len(),
            actual: Continuity::G3.target(&jet, planar),
            target,
            axis: EndAxis::of(document, id, self.end),
            difference: difference.map_or(DVec3::ZERO, |difference| {
                let far = jet.point.abs().max_element().max(size);
                above(difference.vector, ROUNDING * far)
            }),
            angle: difference.map_or(0.0, |difference| difference.angle),
            missing: difference,
            matched: match_report(document, id, self.end),
            followers: followers(document, id),
            continuity: self.continuity,
            live: self.live,
            remaining_distance: largest(&|left| left.vector.length()),
            remaining_angle: largest(&|left| left.angle.abs()),
            size,
            noise: EndNoise::of(jet.point.abs().max_element().max(size), jet.speed()),
            tolerance,
            within: !targets.is_empty() && residual <= tolerance,
            targets: targets.len(),
            passes: last.map_or(0, |last| last.passes),
            overlap: EndOverlap::of(polygon),
            picking: self.picking,
            outcome: last
                .filter(|last| last.end.is_none_or(|end| end == self.end))
                .map(|last| last.reply.clone()),
            largest_move: last.and_then(|last| last.largest_move),
        }
    }
}

fn match_report(document: &Document, curve: CurveId, end: End) -> Option<MatchReport> {
    let matched = *document.match_of(curve, end)?;
    let all = EndMatch {
        continuity: Continuity::G3,
        ..matched
    };
    let polygon = &document.curve(curve)?.polygon;
    Some(MatchReport {
        source: document.curve(matched.source)?.name.clone(),
        matched,
        met: document.meets(&matched),
        missing: EndDifference::between(polygon, end, &all.target(document)?),
    })
}

fn followers(document: &Document, source: CurveId) -> Vec<(String, End)> {
    let matches = document.matches();
    let following = matches.filter(|matched| matched.source == source);
    let named = following.filter_map(|matched| {
        let curve = document.curve(matched.curve)?;
        Some((curve.name.clone(), matched.end))
    });
    named.collect()
}

/// Put components that are not above the rounding at 0.
fn above(vector: DVec3, rounding: f64) -> DVec3 {
    DVec3::from_array(vector.to_array().map(|component| {
        if component.abs() > rounding {
            component
        } else {
            0.0
        }
    }))
}

/// Find the end of another curve seen nearest to a place of the view plane, as something to match
/// an end of one's own to: so that the tangents continue each other. Curves that `takes` refuses do not count.
pub fn nearest_other_end(
    document: &Document,
    (curve, end): (CurveId, End),
    place: DVec2,
    viewport: &Viewport,
    takes: impl Fn(CurveId) -> bool,
) -> Option<EndMatch> {
    let ends = other_ends(document, Some(curve)).filter(|(source, ..)| takes(*source));
    let near = ends
        .map(|(source, other, jet)| {
            let distance = viewport.flatten(jet.point).distance(place);
            (distance, source, other)
        })
        .filter(|(distance, ..)| *distance <= 2.0 * REACH * viewport.pixel());
    let (_, source, picked) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(EndMatch {
        curve,
        end,
        source,
        place: MatchPlace::End(picked),
        continuity: Continuity::default(),
        // An end goes on into a start; two ends, or two starts, run towards each other.
        reversed: picked == end,
    })
}

/// List the ends of the visible curves other than `own`, and of the visible references, with their
/// jets.
pub fn other_ends(
    document: &Document,
    own: Option<CurveId>,
) -> impl Iterator<Item = (CurveId, End, Jet)> + '_ {
    let others = document.curves().filter(move |(id, curve)| {
        Some(*id) != own && curve.visible && !curve.polygon.is_periodic()
    });
    let others =
        others.map(|(id, curve)| -> (CurveId, &dyn ParametricCurve) { (id, &curve.polygon) });
    let references = document
        .references()
        .filter(|(_, it)| it.visible && it.picture.is_none());
    let references =
        references.map(|(id, it)| -> (CurveId, &dyn ParametricCurve) { (id, &it.curve) });
    others.chain(references).flat_map(|(id, curve)| {
        let jet = move |end| Some((id, end, MatchPlace::End(end).jet(curve)?));
        End::BOTH.map(jet).into_iter().flatten()
    })
}
