//! Harmonising: the least change that leaves the features asked for.

use std::f64::consts::PI;
use std::ops::Bound;

use glam::DVec3;

use super::editable::{check_measurable, editable};
use super::error::OperationError;
use super::inputs::Inputs;
use super::lists::{LOCKED, check_parity, given, given_count, locked};
use super::matches::kept_places;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{ANY, Choice, Kind, Meaning, Parameter};
use super::time_limit::{TIME_LIMIT, best_so_far, limited, why_ended};
use super::turned_over::turned_over;
use super::values::Values;
use crate::document::{Curve, CurveId, Document};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::harmonising::{
    Harmonised, Harmony, HarmonyError, Held, farthest_move, flung, follows, harmonise,
};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::features::Features;
use crate::geometry::harmony::{Fairness, SegmentFairness, unevenness};
use crate::geometry::parameters::Quantity;
use crate::geometry::{
    BezierPolygon, Continuity, End, FloatPolygon, Progress, counted, percent, rounded_up,
    significant,
};

/// How far the curve may move without a wish, by its size.
const MOST_DEVIATION: f64 = 0.05;

/// More extrema than this are hardly what fairing is for.
const MANY: usize = 6;

const PROMINENT: Meaning = |_| "prominent ones (automatic)";

const FREE: Choice = Choice::new("free", "Free");
const POSITION: Choice = Choice::new("position", "Position");
const DIRECTION: Choice = Choice::new("direction", "Direction");
const CURVATURE: Choice = Choice::new("curvature", "Curvature");
const SLOPE: Choice = Choice::new("slope", "Curvature slope");
const SAME: Choice = Choice::new("same", "As above");
const ALL: Choice = Choice::new("all", "All");

const KEEP: Parameter = Parameter {
    name: "keep",
    label: "Keep ends",
    help: "Conditions that the ends keep; all derivatives: the curve beyond a stretch stays",
    kind: Kind::Choice {
        options: &NAMED,
        default: 2,
    },
};

/// The options of [`KEEP`].
const NAMED: [Choice; 6] = [FREE, POSITION, DIRECTION, CURVATURE, SLOPE, ALL];

/// Their meanings.
const LEVELS: [Held; 6] = [
    Held::Free,
    Held::Position,
    Held::Direction,
    Held::Curvature,
    Held::Slope,
    Held::All,
];

/// An end of its own may keep something else.
const ONE_END: Kind = Kind::Choice {
    options: &[SAME, FREE, POSITION, DIRECTION, CURVATURE, SLOPE, ALL],
    default: 0,
};

const KEEP_START: Parameter = Parameter {
    name: "keep-start",
    label: "Keep start",
    help: "What the start keeps, if not as above",
    kind: ONE_END,
};

const KEEP_END: Parameter = Parameter {
    name: "keep-end",
    label: "Keep end",
    help: "What the end keeps, if not as above",
    kind: ONE_END,
};

const STRETCH: Parameter = Parameter {
    name: "stretch",
    label: "Stretch",
    help: "Stretch to harmonise; on a periodic curve from a larger u over the seam to a smaller",
    kind: Kind::List {
        count: 2..=2,
        whole: false,
        limits: ANY,
        quantity: Quantity::Parameter,
        words: &[],
        none: |_| "the whole curve",
        in_space: false,
    },
};

const EXTREMA: Parameter = Parameter {
    name: "extrema",
    label: "Curvature extrema",
    help: "Curvature extrema that remain; prominent ones differ by 5 % from their neighbours",
    kind: Kind::optional_count(usize::MAX, false, PROMINENT),
};

const INFLECTIONS: Parameter = Parameter {
    name: "inflections",
    label: "Inflections",
    help: "How many inflections are to be left; of a curve in space, zeros of the torsion",
    kind: Kind::optional_count(usize::MAX, false, PROMINENT),
};

const TORSION_EXTREMA: Parameter = Parameter {
    name: "torsion-extrema",
    label: "Torsion extrema",
    help: "How many extrema of the torsion of a curve in space are to be left",
    kind: Kind::optional_count(usize::MAX, true, PROMINENT),
};

/// The share of the size above which a move of the curve is told.
const TOLD: f64 = 0.01;

const MAX_DEVIATION: Parameter = Parameter {
    name: "max-deviation",
    label: "Deviation up to",
    help: "How far the curve may move at most",
    kind: Kind::optional_number(
        (Bound::Included(0.0), Bound::Unbounded),
        |_| "5 % of the size",
    ),
};

/// A polygon is torn whose unevenness is more than this, and so many times that before: a leg seven times as long as
/// its neighbours let expect, or a turn by 115° more.
const TORN: f64 = 2.0;
const MUCH_LESS_EVEN: f64 = 3.0;

/// The curvature is steep where its variation ∫κ′² ds · L³ is above that of a curvature that falls evenly from that of a
/// circle to 0, and so many times that before: nearly a step is left where a wave was.
const STEEP: f64 = 4.0 * PI * PI;
const MUCH_STEEPER: f64 = 3.0;

/// A move of a vertex by more than this share of the curve's size is named.
const FAR_MOVE: f64 = 0.5;

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "harmonise",
    label: "Harmonise",
    help: "Move the vertices as little as possible so that only the features asked for are left",
    inputs: Inputs::One,
    each: true,
    parameters: &[
        KEEP,
        KEEP_START,
        KEEP_END,
        STRETCH,
        EXTREMA,
        INFLECTIONS,
        TORSION_EXTREMA,
        MAX_DEVIATION,
        LOCKED,
        TIME_LIMIT,
    ],
    check: |input| check_measurable(editable(input)?),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let curve = editable(input)?;
    let (id, _) = input.curve()?;
    let keep = values.choice(&KEEP, &LEVELS);
    let chosen = |parameter| {
        let of_its_own = values.choice(parameter, &one_end());
        of_its_own.unwrap_or(keep)
    };
    let stretch = match *values.list(&STRETCH) {
        [from, to] => Some([from, to]),
        _ => None,
    };
    let chosen = [chosen(&KEEP_START), chosen(&KEEP_END)];
    let mut required = match stretch {
        Some(_) => chosen.map(|held| (held, None)),
        None => [0, 1].map(|index| raised(input.document(), id, End::BOTH[index], chosen[index])),
    };
    let symmetry = curve.symmetry.filter(|_| stretch.is_none());
    if let Some(symmetry) = symmetry.filter(|_| !curve.polygon.is_periodic()) {
        // Mirror images keep the same.
        let most = required[0].0.max(required[1].0);
        required.iter_mut().for_each(|(held, _)| *held = most);
        if symmetry.planes().next().is_some() && curve.polygon.is_planar() {
            check_parity(values, [(&EXTREMA, 1), (&INFLECTIONS, 0)])?;
        }
    }
    let asked = |parameter| given_count(values, parameter);
    let locked = locked(curve, values)?;
    let most = given(values, &MAX_DEVIATION);
    // Of the curve, not of the tails of its float polygon.
    let size = BezierPolygon::from_float(&curve.polygon).size();
    let most = most.or(Some(MOST_DEVIATION * size));
    let harmony = Harmony {
        stretch,
        ends: required.each_ref().map(|(held, _)| *held),
        locked: &locked,
        extrema: asked(&EXTREMA),
        inflections: asked(&INFLECTIONS),
        torsion_extrema: asked(&TORSION_EXTREMA),
        largest_deviation: most,
        symmetry,
    };
    let progress = limited(progress, values);
    let found = match harmonise(&curve.polygon, &harmony, &progress) {
        Ok(found) => found,
        Err(HarmonyError::Cancelled) if progress.is_late() => {
            let failed = Requirement::Failed { left: None };
            let why = why_ended(&progress, values);
            return Ok(Outcome {
                requirements: vec![(id, vec![failed])],
                remarks: vec![format!("{why} before a curve was found: allow more")],
                ..Outcome::unchanged(Deviation::Exact)
            });
        }
        Err(HarmonyError::Cancelled) => return Err(OperationError::Cancelled),
        Err(error) => return Err(error.into()),
    };
    let mut outcome = if found.polygon == curve.polygon {
        let mut outcome = Outcome::unchanged(Deviation::Exact);
        if found.reached {
            outcome.remarks = vec!["The curve has what is asked for already".to_owned()];
        }
        outcome
    } else {
        let deviation = match found.bounded {
            true => Deviation::AtMost(found.deviation),
            false => Deviation::Measured(found.deviation),
        };
        let mut outcome = Outcome::reshaped(id, found.polygon.clone(), deviation);
        let kept = kept_places(input.document(), id, &found.polygon);
        outcome.edits.extend(kept);
        outcome
    };
    let turned = turned_over(&curve.polygon, &found.polygon);
    let flung = flung(&curve.polygon, &found.polygon).map(|(vertex, distance)| {
        let distance = significant(distance, 3);
        format!("Vertex {vertex} moves by {distance}, farther than the polygon is large: ask for more features")
    });
    let torn = torn(&curve.polygon, &found.polygon);
    let steep = steeper(&curve.polygon, &found.polygon);
    let is_wrong = turned.is_some() || flung.is_some() || torn.is_some();
    let failed = is_wrong.then_some(Requirement::Failed { left: None });
    let requirements = found.requirements.iter().cloned().chain(failed);
    outcome.requirements = vec![(id, requirements.collect())];
    if !found.reached {
        outcome.remarks = vec![why_not(&found, &harmony)];
        let late = progress.is_late();
        let late = late.then(|| best_so_far(&progress, values));
        outcome.remarks.extend(late);
    }
    outcome.warnings = turned
        .map(|turned| format!("{turned}: ask for more extrema"))
        .into_iter()
        .chain(flung.or_else(|| tail(&curve.polygon, &found.polygon)))
        .chain(torn)
        .chain(steep)
        .collect();
    let raised = required.into_iter().filter_map(|(_, remark)| remark);
    outcome.remarks.extend(raised);
    if found.refitted {
        outcome.remarks.push(
            "Fitted to the curve: the least change of vertices does not do, or moves it too far"
                .to_owned(),
        );
    }
    if found.reached {
        outcome.warnings.extend(far(curve, &found));
        outcome
            .warnings
            .extend(found.displaced.map(remark_on_displaced));
        outcome.remarks.extend(remark_on_lost(&found));
        outcome.warnings.extend(many(&found, &harmony));
        let lost = follows(&found.polygon, &progress) == Some(false)
            && follows(&curve.polygon, &progress) == Some(true);
        outcome.warnings.extend(lost.then(|| {
            "No result was found whose discrete curvature follows the curve: refine, or allow more extrema"
                .to_owned()
        }));
    }
    if let Some(stretch) = stretch {
        let polygons = [&curve.polygon, &found.polygon];
        outcome.warnings.extend(added_outside(polygons, stretch));
    }
    // Where no number is given, fewer will do.
    let words = |given: Option<usize>, exact, most| if given.is_some() { exact } else { most };
    let extrema = words(harmony.extrema, "Extrema asked for", "Extrema, at most");
    let inflections = words(
        harmony.inflections,
        "Inflections asked for",
        "Inflections, at most",
    );
    outcome.figures = vec![
        Figure::count("iterations", "Iterations", found.iterations),
        Figure::count("asked_extrema", extrema, found.request.extrema),
        Figure::count("asked_inflections", inflections, found.request.inflections),
    ];
    if !curve.polygon.is_planar() {
        let asked = found.request.torsion_extrema;
        let label = words(
            harmony.torsion_extrema,
            "Torsion extrema asked for",
            "Torsion extrema, at most",
        );
        let figure = Figure::count("asked_torsion_extrema", label, asked);
        outcome.figures.push(figure);
    }
    outcome.annotations = stretch_marks(&curve.polygon, stretch);
    Ok(outcome)
}

/// Say that the curve moves far, and what moves it less.
fn far(curve: &Curve, found: &Harmonised) -> Option<String> {
    let size = BezierPolygon::from_float(&curve.polygon).size();
    (found.deviation > TOLD * size).then(|| {
        let moved = significant(found.deviation, 3);
        let share = percent(found.deviation / size);
        format!(
            "The curve moves by {moved}, {share} of its size: keep less at its ends, or allow more extrema"
        )
    })
}

/// What an end keeps: what is chosen, and what its target or match requires; says if that is more.
fn raised(document: &Document, id: CurveId, end: End, chosen: Held) -> (Held, Option<String>) {
    let target = document.curve(id).and_then(|curve| curve.targets.get(end));
    let of_target = target.map(|target| match target {
        EndTarget { slope: Some(_), .. } => Held::Slope,
        EndTarget {
            curvature: Some(_), ..
        } => Held::Curvature,
        EndTarget {
            direction: Some(_), ..
        } => Held::Direction,
        _ => Held::Position,
    });
    let of_match = document.match_of(id, end);
    let of_match = of_match.map(|it| match it.continuity {
        Continuity::G0 => Held::Position,
        Continuity::G1 => Held::Direction,
        Continuity::G2 => Held::Curvature,
        Continuity::G3 => Held::Slope,
    });
    let required = of_target.max(of_match).filter(|held| *held > chosen);
    let remark = required.map(|held| {
        let mut named = LEVELS.iter().zip(NAMED);
        let word = named.find(|(level, _)| **level == held);
        let word = word
            .map_or(ALL.label, |(_, choice)| choice.label)
            .to_lowercase();
        let from = if of_match >= of_target {
            "match"
        } else {
            "target"
        };
        format!(
            "The {} keeps its {word}, as its {from} requires",
            end.name()
        )
    });
    (required.unwrap_or(chosen), remark)
}

/// The meanings of the options of one end.
fn one_end() -> [Option<Held>; 7] {
    let mut meanings = [None; 7];
    for (meaning, level) in meanings[1..].iter_mut().zip(LEVELS) {
        *meaning = Some(level);
    }
    meanings
}

/// Name a vertex that moves far beside the size of the curve: the polygon folds, however near the curve stays.
fn tail(before: &FloatPolygon, after: &FloatPolygon) -> Option<String> {
    let size = BezierPolygon::from_float(before).size();
    let (vertex, distance) = farthest_move(before, after)?;
    (distance > FAR_MOVE * size).then(|| {
        let distance = significant(distance, 3);
        format!("Vertex {vertex} moves by {distance}: ask for other extrema, or refine first, to move it less")
    })
}

/// Say that the polygon is far less even than before.
fn torn(before: &FloatPolygon, after: &FloatPolygon) -> Option<String> {
    let [was, now] = [before, after].map(unevenness);
    let (was, now) = was.zip(now)?;
    (now > TORN && now > MUCH_LESS_EVEN * was).then(|| {
        "The polygon gets far less even, in its legs or its angles: ask for more features, or refine first".to_owned()
    })
}

/// Say that the curvature changes far more steeply than before.
fn steeper(before: &FloatPolygon, after: &FloatPolygon) -> Option<String> {
    let variation = |polygon: &FloatPolygon| {
        let segments = SegmentFairness::all(polygon);
        Fairness::of(&segments, polygon.degree() - 1).variation
    };
    if before == after {
        return None;
    }
    let now = variation(after).filter(|now| *now > STEEP)?;
    let times = now / variation(before)?;
    (times > MUCH_STEEPER).then(|| {
        let times = match times < 1000.0 {
            true => format!("{times:.0}"),
            false => significant(times, 2),
        };
        format!(
            "The curvature changes more steeply, its variation is {times} times as large: ask for more features"
        )
    })
}

/// Say that an inflection lies where the curve turned before.
fn remark_on_displaced(place: DVec3) -> String {
    let [x, y] = [place.x, place.y].map(|it| significant(it, 4));
    format!("An inflection moves to {x}, {y}, where the curve turned: ask for fewer inflections")
}

/// Say how many of the prominent features are left, if not all of them.
fn remark_on_lost(found: &Harmonised) -> Option<String> {
    let (has, asked) = (found.counts, found.request);
    let counts = [
        (has.extrema, asked.extrema, "curvature extrema"),
        (has.inflections, asked.inflections, "inflections"),
        (
            has.torsion_extrema,
            asked.torsion_extrema,
            "torsion extrema",
        ),
    ];
    let lost = counts.into_iter().filter(|(has, asked, _)| has < asked);
    let lost = lost.map(|(has, asked, name)| format!("{has} of the {asked} prominent {name}"));
    let lost: Vec<String> = lost.collect();
    (!lost.is_empty()).then(|| {
        let lost = lost.join(" and ");
        format!("{lost} are left: ask for a number to keep more")
    })
}

/// Say that many extrema stand out, and how to keep fewer.
fn many(found: &Harmonised, harmony: &Harmony) -> Option<String> {
    let left = found.counts.extrema;
    (harmony.extrema.is_none() && left > MANY).then(|| {
        format!(
            "{left} curvature extrema stand out and stay: enter a number in Curvature extrema to keep fewer"
        )
    })
}

/// Say what the best that was found lacks.
fn why_not(found: &Harmonised, harmony: &Harmony) -> String {
    let (has, asked) = (found.counts, found.request);
    let counts = [
        (has.extrema, asked.extrema, harmony.extrema),
        (has.inflections, asked.inflections, harmony.inflections),
        (
            has.torsion_extrema,
            asked.torsion_extrema,
            harmony.torsion_extrema,
        ),
    ];
    let names = [
        ("curvature extremum", "curvature extrema"),
        ("inflection", "inflections"),
        ("torsion extremum", "torsion extrema"),
    ];
    // Where no number is given, fewer will do.
    let differ = |(has, asked, given): (usize, usize, Option<usize>)| {
        has > asked || (has < asked && given.is_some())
    };
    let mut parts: Vec<String> = Vec::new();
    for (count, (one, several)) in counts.into_iter().zip(names) {
        if differ(count) {
            let left = counted(count.0, one, several);
            parts.push(format!("{left} left, {} asked for", count.1));
        }
    }
    if found.undecided > 0 {
        let places = counted(found.undecided, "place", "places");
        parts.push(format!("{places} undecided"));
    }
    if parts.is_empty() {
        let most = harmony.largest_deviation.unwrap_or(f64::INFINITY);
        return format!(
            "The curve moves by up to {}, and {} is allowed: allow more, or ask for more features",
            rounded_up(found.deviation),
            significant(most, 3)
        );
    }
    format!(
        "{}: free the ends or vertices, or ask for other numbers",
        parts.join("; ")
    )
}

/// Say which features the rest of the curve has gained, before and afterwards: the vertices that move
/// reach beyond a stretch, and only its own features are asked for.
fn added_outside([before, after]: [&FloatPolygon; 2], [from, to]: [f64; 2]) -> Option<String> {
    let length = before.segments() as f64;
    let outside = |u: [f64; 2]| (u[0] - from).rem_euclid(length) > (to - from).rem_euclid(length);
    let counts = [before, after].map(|polygon| {
        let features = Features::new(polygon);
        let extrema = features.curvature_extrema.iter();
        let extrema = extrema.filter(|it| outside(it.u)).map(|it| it.count);
        let inflections = features.inflections.iter();
        let inflections = inflections.filter(|it| outside(it.u)).map(|it| it.count);
        [extrema.sum::<usize>(), inflections.sum::<usize>()]
    });
    let [extrema, inflections] = [0, 1].map(|kind| counts[1][kind].saturating_sub(counts[0][kind]));
    let parts = [
        (
            extrema,
            counted(extrema, "curvature extremum", "curvature extrema"),
        ),
        (
            inflections,
            counted(inflections, "inflection", "inflections"),
        ),
    ];
    let gained = parts.into_iter().filter(|(count, _)| *count > 0);
    let gained: Vec<String> = gained.map(|(_, words)| words).collect();
    (!gained.is_empty()).then(|| {
        format!(
            "The rest of the curve gains {}: keep all derivatives at the ends of the stretch, or ask for the whole curve",
            gained.join(" and ")
        )
    })
}

/// Annotation the ends of a stretch.
fn stretch_marks(polygon: &FloatPolygon, stretch: Option<[f64; 2]>) -> Vec<Annotation> {
    let ends = stretch.into_iter().flatten();
    ends.map(|u| Annotation::Point(polygon.point(u))).collect()
}
