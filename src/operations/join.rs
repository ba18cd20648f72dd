//! Two curves joined: merged into one, bridged, or chained by a match.

use std::f64::consts::{PI, TAU};
use std::time::Duration;

use glam::DVec3;

use super::bridge::{self, BRIDGE, annotations, figures};
use super::composite::{Composite, Layout, Part, without_circles};
use super::crossing::new_crossing;
use super::editable::open_of;
use super::error::OperationError;
use super::fit_piece::features;
use super::inputs::Inputs;
use super::lists::{given, given_count};
use super::locks;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, POSITIVE, Parameter};
use super::targets::place_of;
use super::values::Values;
use crate::document::{Edit, EndMatch, MatchPlace};
use crate::geometry::approximation::blend;
use crate::geometry::approximation::merging::{
    MergeError, Merged, Track, check_joint, joint_of, merge, merge_blended,
};
use crate::geometry::distance::SideDeviation;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::bends::Bends;
use crate::geometry::fairing::bridging::{Bridge, join};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::{
    BezierPolygon, Continuity, End, FloatPolygon, Progress, counted, percent, rounded_up,
    significant,
};

const METHOD: Parameter = Parameter {
    name: "method",
    label: "Method",
    help: "Automatic: merge ends that meet, chain at a corner, bridge or blend a gap",
    kind: Kind::Choice {
        options: &[
            Choice::new("automatic", "Automatic"),
            Choice::new("merge", "Merge"),
            Choice::new("bridge", "Bridge"),
            Choice::new("chain", "Chain"),
            Choice::new("blend", "Blend"),
        ],
        default: 0,
    },
};

/// The meanings of the options of [`METHOD`].
const METHODS: [Option<Method>; 5] = [
    None,
    Some(Method::Merge),
    Some(Method::Bridge),
    Some(Method::Chain),
    Some(Method::Blend),
];

/// A way to join two curves.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Method {
    /// One curve, near both.
    Merge,
    /// Both curves stay in one, with vertices between them.
    Bridge,
    /// Two curves, the second one matched.
    Chain,
    /// One curve, near both, with a blend between them.
    Blend,
}

pub(super) const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Merge within",
    help: "How far a merged curve may be from what it is made of",
    kind: Kind::optional_number(POSITIVE, |_| "1e-4 of the size"),
};

/// The tolerance of a merged curve, by the size of both.
pub(super) const WITHIN: f64 = 1e-4;

/// How far a merged curve may be off where no tolerance is given, by the size: a match would move the second curve more.
pub(super) const ALSO_WITHIN: f64 = 1e-3;

const CONTINUITY: Parameter = Parameter {
    name: "continuity",
    label: "Chain up to",
    help: "How the second curve continues the first; automatic: G1, at corners above 10° G0",
    kind: Kind::Choice {
        options: &[
            Choice::new("automatic", "Automatic"),
            Choice::new("G0", "G0 (point)"),
            Choice::new("G1", "G1 (tangent)"),
            Choice::new("G2", "G2 (curvature)"),
            Choice::new("G3", "G3 (curvature slope)"),
        ],
        default: 0,
    },
};

/// The meanings of the options of [`CONTINUITY`].
const CONTINUITIES: [Option<Continuity>; 5] = [
    None,
    Some(Continuity::G0),
    Some(Continuity::G1),
    Some(Continuity::G2),
    Some(Continuity::G3),
];

/// Ends that meet at a larger angle than this, in radians, are meant to: 10°.
const CORNER: f64 = 10.0 * PI / 180.0;

/// A gap of at most this share of the size of both curves is closed by merging where a bridge does not fit into it.
const SMALL: f64 = 0.03;

/// Across a longer gap a merged curve may move both by this share.
const ACROSS: f64 = 0.01;

/// The share of a tolerance that is tried where nothing is found with it.
const NEARER: f64 = 0.2;

/// A composite with so many times the vertices of both curves is told: nobody shapes it by hand any more.
const CROWDED: usize = 4;

/// A chain that moves the second curve by more than this share of its size, and so many times the gap, is told as a
/// warning: closing the gap must move it, a demand for curvature need not throw it.
const FAR: f64 = 0.01;
const FARTHER: f64 = 2.0;

/// A chain that moves the second curve by more than this share of its size makes another curve of it, however wide the
/// gap.
const ANOTHER: f64 = 0.1;

/// Pairs of ends whose gaps differ by less than this share are as close: the ends that point at each other are joined.
const ABOUT_AS_CLOSE: f64 = 0.1;

/// The time for the search of a merged curve, and for that of a blend.
pub(super) const MERGING: Duration = Duration::from_secs(10);
pub(super) const BLENDING: Duration = Duration::from_secs(20);

/// What is left of a match, in units of the curve's size.
const MET: f64 = 1e-9;

const ENDS: Kind = Kind::Choice {
    options: &[
        Choice::new("nearest", "Nearest"),
        Choice::new("start", "Start"),
        Choice::new("end", "End"),
    ],
    default: 0,
};

/// Distances that differ by no more than this share are alike, and so are angles that differ by no more.
const AS_CLOSE: f64 = 1e-9;

/// Ends that are no farther apart than this share of the size coincide.
const ROUNDING: f64 = 1e-12;

/// The meanings of the options of [`ENDS`].
const MEANINGS: [Option<End>; 3] = [None, Some(End::Start), Some(End::Finish)];

const FIRST_END: Parameter = Parameter {
    name: "first-end",
    label: "First curve's end",
    help: "Which end of the first is joined. Nearest: the closest pair; of two as close, the straighter",
    kind: ENDS,
};

const SECOND_END: Parameter = Parameter {
    name: "second-end",
    label: "Second curve's end",
    help: "The end of the second curve that is joined",
    kind: ENDS,
};

const MOVE_SECOND: Parameter = Parameter {
    name: "move-second",
    label: "Move the second",
    help: "Let the second curve turn and move to where the bridge is most harmonious",
    kind: Kind::Switch { default: false },
};

const DROP_MATCH: Parameter = Parameter {
    name: "drop-match",
    label: "Drop match",
    help: "Drop a match by which the joined curve would follow itself through other curves",
    kind: Kind::Switch { default: false },
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "join",
    label: "Join curves",
    help: "Join two open curves: merged into one, by a bridge between both, or as a chain",
    inputs: Inputs::Two,
    each: false,
    parameters: &[
        METHOD,
        TOLERANCE,
        BRIDGE,
        MOVE_SECOND,
        CONTINUITY,
        FIRST_END,
        SECOND_END,
        DROP_MATCH,
    ],
    check: |input| two(input).map(drop),
    unused,
    run,
};

/// Each method has values of its own; a value of a bridge implies one.
fn unused(values: &Values) -> &'static [&'static str] {
    match method(values) {
        Some(Method::Merge | Method::Blend) => &[BRIDGE.name, MOVE_SECOND.name, CONTINUITY.name],
        Some(Method::Bridge) => &[TOLERANCE.name, CONTINUITY.name],
        Some(Method::Chain) => &[TOLERANCE.name, BRIDGE.name, MOVE_SECOND.name],
        None => &[BRIDGE.name, MOVE_SECOND.name],
    }
}

/// The method that the values ask for; `None` for the best one.
fn method(values: &Values) -> Option<Method> {
    let implied = values.switch(&MOVE_SECOND) || given_count(values, &BRIDGE).is_some();
    let asked = values.choice(&METHOD, &METHODS);
    asked.or(implied.then_some(Method::Bridge))
}

/// The two curves, if both are open and neither is locked or hidden.
fn two(input: &Operands) -> Result<[Part<'_>; 2], OperationError> {
    let needed = Inputs::Two;
    let [first, second] = input.curves() else {
        return Err(OperationError::Inputs { needed });
    };
    for (_, curve) in [first, second] {
        open_of(curve, "joined")?;
    }
    Ok([(first.0, &first.1), (second.0, &second.1)])
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let parts = two(input)?;
    let [first, second] = parts.map(|(_, curve)| curve);
    let moves = values.switch(&MOVE_SECOND);
    // A copy that may move goes on from the curve.
    let same = first.polygon == second.polygon || first.polygon == second.polygon.reversed();
    if same && !moves {
        return Err(OperationError::JoinedWithItself);
    }
    let given_ends = [&FIRST_END, &SECOND_END].map(|end| values.choice(end, &MEANINGS));
    let ends = nearest([&first.polygon, &second.polygon], given_ends);
    let layout = Layout {
        follows: ends[0] == End::Finish,
        turned: ends[0] == ends[1],
    };
    let sizes = [first, second].map(|it| BezierPolygon::from_float(&it.polygon).size());
    let size = sizes[0].max(sizes[1]);
    let tolerance = given(values, &TOLERANCE);
    let joining = Joining {
        input,
        values,
        parts,
        ends,
        layout,
        size,
        tolerance: tolerance.unwrap_or(WITHIN * size),
        is_given: tolerance.is_some(),
        progress,
    };
    match method(values) {
        Some(Method::Merge) => joining.merged(joining.tolerance).map(|(merged, _)| merged),
        Some(Method::Bridge) => joining.bridge().map(|(outcome, _)| outcome),
        Some(Method::Chain) => joining.chained(),
        Some(Method::Blend) => {
            let (blended, _) = joining.blended()?;
            Ok(blended)
        }
        None => joining.best(),
    }
}

/// Two curves to join.
struct Joining<'a> {
    input: &'a Operands,
    values: &'a Values,
    parts: [Part<'a>; 2],
    ends: [End; 2],
    layout: Layout,
    /// The size of the larger curve.
    size: f64,
    tolerance: f64,
    /// Whether the user gave it.
    is_given: bool,
    progress: &'a Progress,
}

impl Joining<'_> {
    /// Merge curves that meet if the tolerance allows it, chain those that meet at a corner, bridge a gap.
    ///
    /// Where no bridge between the segments as they are fits the gap without a knuckle, a merged curve closes it, if there
    /// is one, or else a bridge between finer segments, or a chain. Where that bridge has a knuckle, too, a blend without
    /// one comes first.
    fn best(&self) -> Result<Outcome, OperationError> {
        let second = self.second();
        let [left, right] = self.in_order(&self.parts[0].1.polygon, &second);
        let joint = joint_of(left, right);
        if joint.meets(self.tolerance) {
            return match check_joint(joint, self.size, self.tolerance) {
                Ok(()) => self.merged_or_chained(),
                Err(_) => self.chained(),
            };
        }
        let gap = joint.gap;
        let (bridged, fits) = self.bridge()?;
        if fits {
            return Ok(bridged);
        }
        let is_clean = bridged.requirements.is_empty() && bridged.warnings.is_empty();
        if !is_clean && let Some(blended) = self.clean_blend()? {
            return Ok(blended);
        }
        // A hair more, so that rounding does not leave the ends apart.
        let closed = gap * (1.0 + MET);
        let tolerance = match gap > SMALL * self.size {
            _ if self.is_given => self.tolerance,
            true => self.tolerance.max(ACROSS * self.size),
            false => self.tolerance.max(closed),
        };
        let merged = match self.merged(tolerance) {
            // A search for a nearer curve goes other ways.
            Err(OperationError::Merge(MergeError::NotFound)) => self.merged(NEARER * tolerance),
            merged => merged,
        };
        match merged {
            Ok((mut merged, possible)) if possible <= tolerance => {
                let moved = rounded_up(possible);
                let other = match bridged.requirements.is_empty() {
                    true => "Bridge keeps both",
                    false => "Chain keeps the first",
                };
                merged.remarks.push(format!(
                    "Merged: no plain bridge fits the gap. The curves move by at most {moved}; {other}"
                ));
                Ok(merged)
            }
            Err(OperationError::Cancelled) => Err(OperationError::Cancelled),
            _ if bridged.requirements.is_empty() => Ok(bridged),
            Ok((_, possible)) => self.chained_because(&nearest_merge(tolerance, possible)),
            Err(_) => self.chained(),
        }
    }

    /// A blend with nothing to warn of: the search takes long where the quintic alone shows that there is none.
    fn clean_blend(&self) -> Result<Option<Outcome>, OperationError> {
        let second = self.second();
        let [left, right] = self.in_order(&self.parts[0].1.polygon, &second);
        let between = blend(left, right);
        let is_bent = |it: &FloatPolygon| Bends::between(it, [0.0, 1.0]).is_knuckle();
        if between.as_ref().is_none_or(is_bent) {
            return Ok(None);
        }
        match self.blended() {
            Ok((blended, possible)) => {
                let is_clean = possible <= self.most() && blended.warnings.is_empty();
                Ok(is_clean.then_some(blended))
            }
            Err(OperationError::Cancelled) => Err(OperationError::Cancelled),
            Err(_) => Ok(None),
        }
    }

    /// How far one curve of both may be off: without a tolerance of the user's farther than is sought.
    fn most(&self) -> f64 {
        match self.is_given {
            true => self.tolerance,
            false => self.tolerance.max(ALSO_WITHIN * self.size),
        }
    }

    /// Merge within the tolerance, or chain and say why.
    fn merged_or_chained(&self) -> Result<Outcome, OperationError> {
        let why = match self.merged_by(Method::Merge, [self.tolerance, self.most()]) {
            Ok((merged, possible)) if possible <= self.most() => return Ok(merged),
            Ok((_, possible)) => nearest_merge(self.tolerance, possible),
            Err(OperationError::LockedInMerge { name }) => {
                format!("“{name}” has locked vertices and cannot be merged")
            }
            Err(OperationError::Merge(MergeError::NotFound)) => {
                "No merged curve was found".to_owned()
            }
            Err(error) => return Err(error),
        };
        self.chained_because(&why)
    }

    fn chained_because(&self, why: &str) -> Result<Outcome, OperationError> {
        let mut chained = self.chained()?;
        chained.remarks.push(format!("{why}: chained"));
        Ok(chained)
    }

    /// The second curve in the direction of the composite.
    fn second(&self) -> FloatPolygon {
        let polygon = &self.parts[1].1.polygon;
        match self.layout.turned {
            true => polygon.reversed(),
            false => polygon.clone(),
        }
    }

    /// Two polygons in their order along the composite.
    fn in_order<'a>(
        &self,
        first: &'a FloatPolygon,
        second: &'a FloatPolygon,
    ) -> [&'a FloatPolygon; 2] {
        match self.layout.follows {
            true => [first, second],
            false => [second, first],
        }
    }

    /// One curve of both, and how far it is from them: not reached if that is more than the tolerance.
    fn merged(&self, tolerance: f64) -> Result<(Outcome, f64), OperationError> {
        self.merged_by(Method::Merge, [tolerance; 2])
    }

    /// One curve of both with a blend between them, and how far it is from them.
    fn blended(&self) -> Result<(Outcome, f64), OperationError> {
        self.merged_by(Method::Blend, [self.tolerance, self.most()])
    }

    /// One curve of both, found in one of two ways, and how far it is from them. The tolerance is sought; where it is
    /// missed, but not what is allowed at most, that is what the curve keeps.
    fn merged_by(
        &self,
        method: Method,
        [tolerance, most]: [f64; 2],
    ) -> Result<(Outcome, f64), OperationError> {
        let is_blend = method == Method::Blend;
        let [(_, first), (_, second)] = self.parts;
        for curve in [first, second] {
            if curve.locked_vertices.iter().next().is_some() {
                let name = curve.name.clone();
                return Err(OperationError::LockedInMerge { name });
            }
        }
        let part = self.second();
        let [left, right] = self.in_order(&first.polygon, &part);
        // What is found on the way may not be what is taken.
        let progress = match self::method(self.values) {
            Some(_) => self.progress.clone(),
            None => self.progress.unshown(),
        };
        let progress = progress.limited(if is_blend { BLENDING } else { MERGING });
        let found = match is_blend {
            true => merge_blended(left, right, tolerance, &progress),
            false => merge(left, right, tolerance, &progress),
        };
        let Merged {
            polygon,
            tracks,
            deviation,
            bounded,
            extrema,
            waves,
        } = found.map_err(|error| merge_error(error, &progress))?;
        let sought = tolerance;
        let tolerance = match deviation <= most {
            true => tolerance.max(deviation * (1.0 + MET)),
            false => tolerance,
        };
        let deviation_is = match bounded {
            true => Deviation::AtMost(deviation),
            false => Deviation::Measured(deviation),
        };
        let mut outcome = Outcome::unchanged(deviation_is);
        let composite = self.composite(&polygon, &part, Some(&tracks));
        self.compose(&composite, &mut outcome)?;
        let id = self.parts[0].0;
        let limit = Requirement::Limit {
            found: deviation,
            most: tolerance,
        };
        let outer = [(left, End::Start), (right, End::Finish)];
        let ends = outer.map(|(part, end)| {
            let target = EndTarget::keeping(&part.end_jet(end));
            place_of(&polygon, end, target, MET * self.size)
        });
        let requirements = features(Some(extrema[1]), None).into_iter().chain(ends);
        outcome.requirements = vec![(id, requirements.chain([limit]).collect())];
        let name = if is_blend { "blend" } else { "merge" };
        outcome.figures = self.method(name).into();
        outcome.figures.extend([
            Figure::length("tolerance", "Tolerance", tolerance),
            Figure::count("vertices", "Vertices", polygon.vertices().len()),
            Figure::count("extrema_before", "Curvature extrema of both", extrema[0]),
            Figure::count("extrema", "Curvature extrema", extrema[1]),
        ]);
        if (left.is_rational() || right.is_rational()) && !polygon.is_rational() {
            outcome
                .remarks
                .push("The merged curve has no weights".to_owned());
        }
        if deviation > sought && deviation <= tolerance {
            let [sought, found] = [significant(sought, 3), rounded_up(deviation)];
            outcome.remarks.push(format!(
                "No {name} within {sought} was found, this one is within {found}"
            ));
        }
        if deviation > tolerance {
            outcome.remarks.push(possible(name, deviation, tolerance));
        }
        // Ends that meet have one place, those of a blend two.
        let mut joint = [tracks[0].at(left.segments() as f64), tracks[1].at(0.0)];
        if is_blend {
            let knuckle = bridge::sharper("blend", &Bends::between(&polygon, joint));
            let crossing = new_crossing(&[left, right], &polygon);
            let wavy = (waves > 0).then(|| {
                let added = counted(waves, "inflection", "inflections");
                format!("The blend needs {added} more than its ends ask for: choose Chain")
            });
            let told = [knuckle, crossing, wavy].into_iter().flatten();
            outcome.warnings.extend(told);
        } else {
            joint[1] = joint[0];
        }
        let marks = joint.map(|at| Annotation::Point(polygon.point(at)));
        outcome.annotations.extend(marks);
        outcome.joint = Some(joint);
        Ok((outcome, deviation))
    }

    /// Join by a bridge, which is not reached if it goes a long way round. Says whether the parts fit it as they are and
    /// nothing is to be warned of.
    fn bridge(&self) -> Result<(Outcome, bool), OperationError> {
        let [(_, first), (_, second)] = self.parts;
        let moves = self.values.switch(&MOVE_SECOND);
        if moves {
            second.check_vertices_unlocked(second.locked_vertices.iter())?;
        }
        let changed = second.polygon.with_degree(first.polygon.degree())?;
        let deviation = Deviation::of(&changed);
        let part = match self.layout.turned {
            true => changed.polygon.reversed(),
            false => changed.polygon.clone(),
        };
        let wanted = Bridge {
            vertices: given_count(self.values, &BRIDGE),
            second_moves: moves,
        };
        // The first curve keeps its direction; joined at its start it comes after the second, and the
        // bridge leaves it backwards, so that it is the one that stays.
        let found = if self.layout.follows {
            bridge::found(join(&first.polygon, &part, &wanted, self.progress))?
        } else {
            let [first, part] = [&first.polygon, &part].map(FloatPolygon::reversed);
            bridge::found(join(&first, &part, &wanted, self.progress))?.reversed()
        };
        let mut outcome = Outcome::unchanged(deviation);
        let composite = Composite {
            halvings: found.halvings,
            ..self.composite(&found.polygon, &part, None)
        };
        let moved = moves.then(|| composite.farthest_move());
        self.compose(&composite, &mut outcome)?;
        outcome.figures = self.method("bridge").into();
        outcome.figures.extend(figures(&found));
        if let Some(moved) = moved {
            let figure = Figure::length("second_move", "Largest move of the second", moved);
            outcome.figures.push(figure);
            outcome.deviation = outcome.deviation.or(Deviation::AtMost(moved));
            let moved = significant(moved, 3);
            outcome.remarks.push(format!(
                "The first curve stays, the second moves by up to {moved}"
            ));
        }
        outcome.remarks.extend(bridge::remarks(&found));
        outcome.remarks.extend(locks::lost(second, &[&part]));
        outcome.annotations = annotations(&found);
        outcome.joint = Some(found.joint);
        let polygons = [&first.polygon, &part];
        let fault = bridge::fault(&found, polygons);
        let knuckle = bridge::knuckle(&found).filter(|_| fault.is_none());
        // Where the second moves, or nobody asked for a bridge, the operation chose what crosses; a bridge that crosses
        // in a knuckle is no use.
        let is_chosen = moves || method(self.values).is_none() || knuckle.is_some();
        outcome.warnings.extend(knuckle);
        let crossing = new_crossing(&polygons, &found.polygon);
        let failed = vec![(self.parts[0].0, vec![Requirement::Failed { left: None }])];
        if let Some(crossing) = crossing {
            let warning = match moves {
                true => format!("{crossing}: let the second curve stay, or join other ends"),
                false => crossing,
            };
            outcome.warnings.push(warning);
            if is_chosen {
                outcome.requirements = failed.clone();
            }
        }
        outcome.warnings.extend(self.crowded(&found.polygon));
        let size = BezierPolygon::from_float(&second.polygon).size();
        if changed.deviation > FAR * size {
            let (degree, moved) = (first.polygon.degree(), significant(changed.deviation, 3));
            outcome.warnings.push(format!(
                "The second curve gets the degree {degree} and moves by {moved}: begin with it, or raise the degree"
            ));
        }
        if let Some(fault) = &fault {
            outcome.requirements = failed;
            let [left, right] = self.in_order(&first.polygon, &part);
            let other = match check_joint(joint_of(left, right), self.size, self.tolerance) {
                Ok(()) => "Merge or Chain",
                Err(_) => "Chain",
            };
            outcome
                .warnings
                .push(format!("{fault}: {other}, or move the ends apart"));
        }
        let is_plain = found.is_plain && fault.is_none() && outcome.warnings.is_empty();
        Ok((outcome, is_plain))
    }

    /// Say that a composite has many more vertices than both curves.
    fn crowded(&self, composite: &FloatPolygon) -> Option<String> {
        let own: usize = self
            .parts
            .iter()
            .map(|(_, it)| it.polygon.vertices().len())
            .sum();
        let count = composite.vertices().len();
        let text = format!(
            "The bridge leads to {count} vertices, both curves have {own}: Blend takes fewer"
        );
        (count > CROWDED * own).then_some(text)
    }

    /// Let the second curve follow the end of the first.
    fn chained(&self) -> Result<Outcome, OperationError> {
        let [(id, first), (other, second)] = self.parts;
        let [source_end, end] = self.ends;
        let asked = self.values.choice(&CONTINUITY, &CONTINUITIES);
        let turned = self.second();
        let [left, right] = self.in_order(&first.polygon, &turned);
        let joint = joint_of(left, right);
        let continuity = asked.unwrap_or(match joint.angle <= CORNER {
            true => Continuity::G1,
            false => Continuity::G0,
        });
        let edit = Edit::SetMatch(EndMatch {
            curve: other,
            end,
            source: id,
            place: MatchPlace::End(source_end),
            continuity,
            reversed: self.layout.turned,
        });
        let drops = self.values.switch(&DROP_MATCH);
        let document = self.input.document();
        let (edits, dropped) = without_circles(document, vec![edit], drops)?;
        let after = document.edited(edits.iter().cloned())?;
        let polygon = after.curve(other).map(|curve| &curve.polygon);
        let polygon = polygon.unwrap_or(&second.polygon);
        // Points that slide along the curve do not move it.
        let moved = SideDeviation::both_ways([&second.polygon, polygon], self.progress);
        let moved = moved.map_err(|_| OperationError::Cancelled)?;
        let planar = second.polygon.is_planar();
        let mut target = continuity.target(&first.polygon.end_jet(source_end), planar);
        if self.layout.turned {
            target = target.turned(planar);
        }
        let tolerance = MET * polygon.size();
        let mut outcome = Outcome::unchanged(match moved {
            0.0 => Deviation::Exact,
            moved => Deviation::Measured(moved),
        });
        outcome.requirements = vec![(other, vec![place_of(polygon, end, target, tolerance)])];
        outcome.edits = edits;
        outcome.figures = self.method("chain").into();
        outcome.figures.push(Figure::length(
            "second_move",
            "Largest move of the second",
            moved,
        ));
        outcome.remarks = dropped;
        let told = format!(
            "Both stay curves; the second follows the first up to {} and moves by up to {}",
            continuity.name(),
            significant(moved, 3)
        );
        let size = BezierPolygon::from_float(&second.polygon).size();
        let share = percent(moved / size);
        // Who asks for a chain knows that it moves the second.
        let another = match method(self.values) {
            Some(_) => ANOTHER,
            None => FAR,
        };
        let advice = match moved {
            _ if moved > FAR * size && moved > FARTHER * joint.gap => {
                Some("chain up to less, or merge")
            }
            _ if moved > another * size => Some("Bridge keeps both, or join other ends"),
            _ => None,
        };
        let far = advice.map(|advice| format!("The second moves by {share} of its size: {advice}"));
        outcome.warnings.extend(far);
        outcome.remarks.push(told);
        // Nobody asked for another curve.
        let is_chosen = method(self.values).is_none() && asked.is_none();
        if is_chosen && moved > ANOTHER * size {
            outcome
                .requirements
                .push((other, vec![Requirement::Failed { left: None }]));
        }
        Ok(outcome)
    }

    fn composite<'a>(
        &'a self,
        polygon: &'a FloatPolygon,
        second: &'a FloatPolygon,
        tracks: Option<&'a [Track; 2]>,
    ) -> Composite<'a> {
        Composite {
            document: self.input.document(),
            parts: self.parts,
            ends: self.ends,
            layout: self.layout,
            polygon,
            second,
            halvings: [0; 2],
            tracks,
        }
    }

    /// The method, and the ends that it joins.
    fn method(&self, name: &'static str) -> [Figure; 2] {
        let method = Figure::word("method", "Method", name);
        [method, Figure::ends("joined", "Joined", self.ends)]
    }

    /// Make the first curve the composite.
    fn compose(&self, composite: &Composite, outcome: &mut Outcome) -> Result<(), OperationError> {
        let drops = self.values.switch(&DROP_MATCH);
        let (edits, dropped) = without_circles(self.input.document(), composite.edits(), drops)?;
        outcome.edits = edits;
        outcome.renumbered = true;
        outcome.remarks.extend(dropped);
        Ok(())
    }
}

/// The failure of a merge: one that ends because its time is over has found nothing.
pub(super) fn merge_error(error: MergeError, progress: &Progress) -> OperationError {
    match error {
        MergeError::Cancelled if progress.is_late() => MergeError::NotFound.into(),
        MergeError::Cancelled => OperationError::Cancelled,
        error => error.into(),
    }
}

/// Say which tolerance a merge misses, and which one is possible.
fn nearest_merge(tolerance: f64, possible: f64) -> String {
    let (tolerance, possible) = (significant(tolerance, 3), rounded_up(possible));
    format!("No merged curve is within {tolerance} of both, one within {possible} is possible")
}

/// The ends that are joined: those that are given, and of the others those that lie closest. Of pairs as
/// close the two that point at each other best are joined, and of those the pair that turns no curve round.
fn nearest(polygons: [&FloatPolygon; 2], given: [Option<End>; 2]) -> [End; 2] {
    let options = given.map(|end| end.map_or(End::BOTH.to_vec(), |end| vec![end]));
    let pairs = options[0]
        .iter()
        .rev()
        .flat_map(|first| options[1].iter().map(move |second| [*first, *second]));
    let gaps: Vec<([End; 2], Gap)> = pairs.map(|ends| (ends, Gap::of(polygons, ends))).collect();
    let distances = gaps.iter().map(|(_, gap)| gap.distance);
    let least = distances.fold(f64::INFINITY, f64::min);
    let size = polygons.map(|polygon| polygon.size()).into_iter();
    let as_close = least * (1.0 + ABOUT_AS_CLOSE) + ROUNDING * size.fold(0.0, f64::max);
    let closest = gaps.into_iter().filter(|(_, gap)| gap.distance <= as_close);
    // Turnings that differ by rounding are alike.
    let turning = |gap: &Gap| (gap.turning / AS_CLOSE).round();
    let best = closest.min_by(|(_, a), (_, b)| turning(a).total_cmp(&turning(b)));
    best.map_or([End::Finish, End::Start], |(ends, _)| ends)
}

/// What lies between two ends.
struct Gap {
    distance: f64,
    /// How far the straight way from one to the other turns where it leaves and where it arrives, in radians.
    turning: f64,
}

impl Gap {
    fn of(polygons: [&FloatPolygon; 2], ends: [End; 2]) -> Self {
        let jets = [0, 1].map(|part: usize| polygons[part].end_jet(ends[part]));
        let way = jets[1].point - jets[0].point;
        // Out of the first curve, and into the second.
        let tangents = [0, 1].map(|part: usize| {
            let follows = (ends[part] == End::Finish) == (part == 0);
            let tangent = jets[part].tangent().unwrap_or(DVec3::ZERO);
            if follows { tangent } else { -tangent }
        });
        let [out, into] = tangents;
        // A way of rounding has no direction.
        let size = polygons.map(|polygon| polygon.size()).into_iter();
        let turning = match way.length() <= ROUNDING * size.fold(0.0, f64::max) {
            true => out.angle_between(into),
            false => out.angle_between(way) + way.angle_between(into),
        };
        Self {
            distance: way.length(),
            // An end without a direction points nowhere.
            turning: if turning.is_finite() { turning } else { TAU },
        }
    }
}

/// Say which tolerance would be kept in place of the one that was asked for.
pub(super) fn possible(name: &str, deviation: f64, tolerance: f64) -> String {
    let (possible, asked) = (rounded_up(deviation), significant(tolerance, 3));
    let label = TOLERANCE.label;
    format!("A {name} within {possible} is possible, {asked} is asked for: raise “{label}”")
}
