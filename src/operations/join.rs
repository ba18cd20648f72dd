//! Two curves made one by a bridge between them.

use std::f64::consts::TAU;

use glam::DVec3;

use super::bridge::{self, BRIDGE, annotations, figures, joint};
use super::editable::open_of;
use super::error::OperationError;
use super::inputs::Inputs;
use super::lists::given_count;
use super::locks;
use super::matches::{handed_over, without_match};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, Parameter};
use super::values::Values;
use crate::document::{
    Curve, CurveId, Document, Edit, EditError, EndMatch, MatchPlace, ParameterSpan, Renumbering,
    quoted,
};
use crate::geometry::fairing::bridging::{Bridge, join};
use crate::geometry::{End, FloatPolygon, Progress};

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

/// The meanings of the options of [`ENDS`].
const MEANINGS: [Option<End>; 3] = [None, Some(End::Start), Some(End::Finish)];

const FIRST_END: Parameter = Parameter {
    name: "first-end",
    label: "First curve's end",
    help: "Which end of the first curve to join. Nearest: the closest pair of ends",
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
    help: "Let the second curve turn and move as a whole into the place where the bridge is most harmonious",
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
    help: "Make one curve of two open ones by a harmonious bridge between their ends; both stay as they are",
    inputs: Inputs::Two,
    parameters: &[BRIDGE, FIRST_END, SECOND_END, MOVE_SECOND, DROP_MATCH],
    check: |input| two(input).map(drop),
    unused: |_| &[],
    run,
};

/// A curve with its identity.
type Part<'a> = (CurveId, &'a Curve);

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
    let [(id, first), (other, second)] = two(input)?;
    let moves = values.switch(&MOVE_SECOND);
    if moves {
        second.check_vertices_unlocked(second.locked_vertices.iter())?;
    }
    // A copy that may move goes on from the curve.
    let same = first.polygon == second.polygon || first.polygon == second.polygon.reversed();
    if same && !moves {
        return Err(OperationError::JoinedWithItself);
    }
    let given = [&FIRST_END, &SECOND_END].map(|end| values.choice(end, &MEANINGS));
    let ends = nearest([&first.polygon, &second.polygon], given);
    let changed = second.polygon.with_degree(first.polygon.degree())?;
    let deviation = Deviation::of(&changed);
    let layout = Layout {
        follows: ends[0] == End::Finish,
        turned: ends[0] == ends[1],
    };
    let part = if layout.turned {
        changed.polygon.reversed()
    } else {
        changed.polygon.clone()
    };
    let wanted = Bridge {
        vertices: given_count(values, &BRIDGE),
        second_moves: moves,
    };
    // The first curve keeps its direction; joined at its start it comes after the second, and the
    // bridge leaves it backwards, so that it is the one that stays.
    let found = if layout.follows {
        bridge::found(join(&first.polygon, &part, &wanted, progress))?
    } else {
        let [first, part] = [&first.polygon, &part].map(FloatPolygon::reversed);
        bridge::found(join(&first, &part, &wanted, progress))?.reversed()
    };
    let composite = Composite {
        document: input.document(),
        parts: [(id, first), (other, second)],
        ends,
        layout,
        polygon: &found.polygon,
        second: &part,
    };
    let mut outcome = Outcome::unchanged(deviation);
    let (edits, dropped) = without_circles(
        input.document(),
        composite.edits(),
        values.switch(&DROP_MATCH),
    )?;
    outcome.edits = edits;
    outcome.renumbered = true;
    outcome.figures = vec![Figure::ends("joined", "Joined", ends)];
    outcome.figures.extend(figures(&found));
    if moves {
        let farthest = composite.farthest_move();
        let figure = Figure::length("second_move", "Largest move of the second", farthest);
        outcome.figures.push(figure);
    }
    outcome.remarks = bridge::remarks(&found);
    outcome.remarks.extend(dropped);
    outcome.remarks.extend(locks::lost(second, &[&part]));
    outcome.annotations = annotations(&found);
    outcome.joint = Some(joint(&found));
    Ok(outcome)
}

/// Remove the matches from some edits that would let curves follow each other in a circle; the texts name those
/// that no curve had before.
///
/// # Errors
/// [`OperationError::MatchCircle`] if there is such a match and `drops` is false.
fn without_circles(
    document: &Document,
    edits: Vec<Edit>,
    drops: bool,
) -> Result<(Vec<Edit>, Vec<String>), OperationError> {
    let mut after = document.clone();
    let (mut kept, mut dropped) = (Vec::new(), Vec::new());
    for edit in edits {
        match (after.apply(edit.clone()), &edit) {
            (Err(EditError::MatchCycle { name, source_name }), Edit::SetMatch(matched)) => {
                if !drops {
                    return Err(OperationError::MatchCircle { name, source_name });
                }
                let (curve, end) = (matched.curve, matched.end);
                if after.match_of(curve, end).is_some() {
                    let remove = Edit::RemoveMatch { curve, end };
                    after.apply(remove.clone())?;
                    kept.push(remove);
                } else {
                    let [name, source] = [name, source_name].map(|name| quoted(&name));
                    dropped.push(format!("{name} does not follow {source}, which follows it"));
                }
            }
            (result, _) => {
                result?;
                kept.push(edit);
            }
        }
    }
    Ok((kept, dropped))
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
    let as_close = least * (1.0 + AS_CLOSE) + f64::EPSILON * size.fold(0.0, f64::max);
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
        let turning = match way == DVec3::ZERO {
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

/// How the second curve lies in the composite.
#[derive(Clone, Copy)]
struct Layout {
    /// Whether it comes after the first.
    follows: bool,
    /// Whether it runs the other way.
    turned: bool,
}

/// The composite, with what it was made of.
struct Composite<'a> {
    document: &'a Document,
    parts: [Part<'a>; 2],
    ends: [End; 2],
    layout: Layout,
    polygon: &'a FloatPolygon,
    /// The second part in its direction and degree, where it was.
    second: &'a FloatPolygon,
}

impl Composite<'_> {
    /// The numbers of the first vertices of both parts, which are the parameters of their starts.
    fn offsets(&self) -> [usize; 2] {
        let count = self.polygon.vertices().len();
        if self.layout.follows {
            [0, count - self.second.vertices().len()]
        } else {
            [count - self.parts[0].1.polygon.vertices().len(), 0]
        }
    }

    fn farthest_move(&self) -> f64 {
        let [_, offset] = self.offsets();
        let after = self.polygon.vertices().iter().skip(offset);
        let pairs = self.second.vertices().iter().zip(after);
        pairs.fold(0.0, |most, (a, b)| most.max(a.distance(*b)))
    }

    /// The first curve becomes the composite. Locks, targets and matches stay with their vertices,
    /// ends and places.
    fn edits(&self) -> Vec<Edit> {
        let [(id, first), (other, second)] = self.parts;
        let [first_offset, second_offset] = self.offsets();
        let joined = self.ends[0];
        let own = |end| self.document.match_of(other, end);
        let mut edits: Vec<Edit> = Vec::new();
        edits.extend(without_match(self.document, id, joined));
        for end in End::BOTH {
            edits.extend(without_match(self.document, other, end));
        }
        let locked = &first.locked_vertices;
        let locked = locked.renumbered(|vertex| Some(first_offset + vertex));
        let span =
            ParameterSpan::shifted([0.0, first.polygon.segments() as f64], first_offset as f64);
        let inside = match joined {
            End::Start => span.new[0],
            End::Finish => span.new[1],
        };
        edits.push(Edit::Renumber {
            curve: id,
            polygon: self.polygon.clone(),
            renumbering: Renumbering::of_parameters(first, self.polygon, vec![span])
                .with_locked_vertices(locked)
                .with_end(joined, MatchPlace::Parameter(inside)),
        });
        let kept = second.locked_vertices.carried(&second.polygon, self.second);
        let kept: Vec<usize> = kept.iter().map(|vertex| second_offset + vertex).collect();
        if !kept.is_empty() {
            edits.push(Edit::SetVerticesLocked {
                curve: id,
                vertices: kept,
                locked: true,
            });
        }
        // The free end of the second curve takes the place of the first one's joined end.
        let free = self.ends[1].other();
        let planar = second.polygon.is_planar();
        let target = second.targets.get(free);
        let target = target.map(|target| {
            if self.layout.turned {
                target.turned(planar)
            } else {
                target
            }
        });
        if target != first.targets.get(joined) {
            edits.push(Edit::SetTarget {
                curve: id,
                end: joined,
                target,
            });
        }
        let own = own(free).filter(|matched| matched.source != id);
        edits.extend(own.map(|matched| {
            Edit::SetMatch(EndMatch {
                curve: id,
                end: joined,
                reversed: matched.reversed != self.layout.turned,
                ..*matched
            })
        }));
        edits.extend(self.followers());
        edits.push(Edit::Remove(other));
        edits
    }

    /// The matches at places of the second curve, which are places of the composite then.
    fn followers(&self) -> Vec<Edit> {
        let [(id, _), (other, second)] = self.parts;
        let [_, offset] = self.offsets();
        let joined = self.ends[0];
        let length = second.polygon.segments() as f64;
        let within = |u: f64| {
            let u = if self.layout.turned { length - u } else { u };
            MatchPlace::Parameter(offset as f64 + u)
        };
        let place = |place: MatchPlace| {
            Some(match place {
                MatchPlace::End(end) if end != self.ends[1] => MatchPlace::End(joined),
                MatchPlace::End(End::Start) => within(0.0),
                MatchPlace::End(End::Finish) => within(length),
                MatchPlace::Parameter(u) => within(u),
            })
        };
        // What the first curve followed of the second is part of the same curve now.
        let is_own = |edit: &Edit| matches!(edit, Edit::SetMatch(matched) if matched.curve == id);
        let mut followers = handed_over(self.document, [other, id], self.layout.turned, place);
        followers.retain(|edit| !is_own(edit));
        followers
    }
}
