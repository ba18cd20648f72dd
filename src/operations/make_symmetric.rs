//! A curve that becomes its own mirror image.

use std::f64::consts::PI;

use super::bent_half::BentHalf;
use super::cutting::without_target;
use super::editable::check_editable;
use super::error::OperationError;
use super::half::{Half, KeptHalf, SAMPLES, crossings, drawn_half, one_side};
use super::inputs::Inputs;
use super::join::{self, ALSO_WITHIN, WITHIN, possible};
use super::lists::given;
use super::mirror::{FROM, PLANE, TO, check_free, plane_or_line};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, POSITIVE, Parameter};
use super::values::Values;
use super::whole::{
    OF_CUT, WHOLE, Whole, bridged, bridged_with_few_vertices, closed, merged, receded, smoothed,
    with_few_vertices,
};
use crate::document::{CurveId, Document, Edit, ParameterSpan};
use crate::geometry::approximation::merging::{MergeError, check_joint, joint_of};
use crate::geometry::distance::SideDeviation;
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::{
    BezierPolygon, End, FloatPolygon, Joint, Mirror, Progress, Symmetry, bounds, counted,
    significant,
};

const AXIS: Parameter = Parameter {
    name: "axis",
    label: "Axis",
    help: "The mirror line through the origin",
    kind: Kind::Choice {
        options: &[Choice::new("y", "Y"), Choice::new("x", "X")],
        default: 0,
    },
};

const KEEP: Parameter = Parameter {
    name: "keep",
    label: "Keep",
    help: "The half that its image completes; nearest: the mean of both, with as many vertices",
    kind: Kind::Choice {
        options: &[
            Choice::new("nearest", "Nearest"),
            Choice::new("first", "First half"),
            Choice::new("second", "Second half"),
        ],
        default: 0,
    },
};

const TOLERANCE: Parameter = Parameter {
    help: "How far the half may move; without it more where the half meets the axis askew",
    kind: Kind::optional_number(POSITIVE, |_| "1e-4 to 5e-3 of the size"),
    ..join::TOLERANCE
};

const STAY: Parameter = Parameter {
    name: "stay",
    label: "Stay symmetric",
    help: "Let later edits of one half change the other half too",
    kind: Kind::Switch { default: false },
};

/// The share of the work that bending is.
const BEGUN: f64 = 0.1;

/// The share of its size by which a half that meets the axis askew may move where no tolerance is given: what is traced by
/// hand meets no axis squarely.
const NEAR: f64 = 5e-3;

/// The corner with the image, in radians, from which on a half meets the axis askew: 1°.
const ASKEW: f64 = PI / 180.0;

/// A curve that moves by more than this share of its size was hardly symmetric.
const FAR: f64 = 0.02;

/// A curve that moves by more than this share of its size is another one.
const ANOTHER: f64 = 0.25;

/// A curve whose box keeps less than this share of its smaller side is flattened: an S is its own image by half a turn.
const FLAT: f64 = 0.5;

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "make-symmetric",
    label: "Make symmetric",
    help: "Make the curve its own mirror image; a curve on one side is joined to its image",
    inputs: Inputs::One,
    each: true,
    parameters: &[AXIS, FROM, TO, PLANE, KEEP, TOLERANCE, STAY],
    check: check_editable,
    unused: super::mirror::unused,
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    check_free(input, id)?;
    let axes = values.choice(&AXIS, &[[true, false, false], [false, true, false]]);
    let mirror = plane_or_line(values, axes)?;
    let mut outcome = made(input, values, mirror, progress)?;
    // A rule that the curve has already would take the result back to its own axis.
    if !values.switch(&STAY) && curve.symmetry.is_none() {
        return Ok(outcome);
    }
    let made = outcome.applied_to(&without_symmetry(input.document(), id)?)?;
    if let Some(made) = made.curve(id) {
        let both = Symmetry::about_both(mirror, &made.polygon);
        let both = both.filter(|it| it.holds(&made.polygon));
        let one = Symmetry::about(mirror, &made.polygon);
        let symmetry = both.or_else(|| Some(one).filter(|it| it.holds(&made.polygon)));
        if symmetry.is_some() && symmetry != curve.symmetry {
            outcome.edits.push(Edit::SetSymmetry {
                curve: id,
                symmetry,
            });
        }
    }
    Ok(outcome)
}

/// The document with a curve whose halves change alone.
fn without_symmetry(document: &Document, curve: CurveId) -> Result<Document, OperationError> {
    let edit = Edit::SetSymmetry {
        curve,
        symmetry: None,
    };
    Ok(document.edited([edit])?)
}

/// Make the curve symmetric, one that does not stay so.
fn made(
    input: &Operands,
    values: &Values,
    mirror: Mirror,
    progress: &Progress,
) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let polygon = &curve.polygon;
    let keep = values.choice(&KEEP, &[None, Some(Half::First), Some(Half::Second)]);
    let size = BezierPolygon::from_float(polygon).size();
    let asked = given(values, &TOLERANCE);
    let tolerance = asked.unwrap_or(WITHIN * size);
    let crossings = crossings(polygon, &mirror, tolerance);
    let last = polygon.segments() as f64;
    let drawn = drawn_half(polygon, &crossings);
    let (half, span) = match (keep, &crossings[..]) {
        (None, _) | (_, [_, _]) if let Some(drawn) = drawn => drawn,
        (None, [_, ..]) => return nearest(input, polygon, &mirror, progress),
        (None, []) if polygon.is_periodic() => return nearest(input, polygon, &mirror, progress),
        (Some(Half::First), [first, second]) if polygon.is_periodic() => {
            (Half::First, [*first, *second])
        }
        (Some(Half::Second), [first, second]) if polygon.is_periodic() => {
            (Half::First, [*second, first + last])
        }
        (Some(_), _) if polygon.is_periodic() => return Ok(no_halves(id, crossings.len())),
        (Some(Half::First), [first, ..]) => (Half::First, [0.0, *first]),
        (Some(Half::Second), [.., at]) => (Half::Second, [*at, last]),
        (_, []) => (one_side(polygon, &mirror, tolerance)?, [0.0, last]),
    };
    let overshoots = drawn == Some((half, span));
    completed(input, (half, span, overshoots), &mirror, asked, progress)
}

/// The mean of the curve and its image.
fn nearest(
    input: &Operands,
    polygon: &FloatPolygon,
    mirror: &Mirror,
    progress: &Progress,
) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let symmetric = polygon.symmetrised(mirror)?;
    if symmetric == *polygon {
        let mut outcome = Outcome::unchanged(Deviation::Exact);
        outcome.remarks = vec!["The curve is symmetric already".to_owned()];
        return Ok(outcome);
    }
    curve.check_held(&symmetric)?;
    // A bound by the vertices would count points that slide along the curve.
    let deviation = SideDeviation::both_ways([polygon, &symmetric], progress);
    let deviation = deviation.map_err(|_| OperationError::Cancelled)?;
    let size = BezierPolygon::from_float(polygon).size();
    let is_far = deviation > FAR * size;
    let is_flat = is_far && smaller_side(&symmetric) < FLAT * smaller_side(polygon);
    let is_outline = !polygon.is_periodic() && joint_of(polygon, polygon).meets(WITHIN * size);
    let advice = match is_outline {
        true => "its ends meet: close it first",
        false => "its halves differ much: keep one of them",
    };
    let mut outcome = Outcome::reshaped(id, symmetric, Deviation::Measured(deviation));
    if deviation > ANOTHER * size || is_flat {
        outcome.requirements = vec![(id, vec![Requirement::Failed { left: None }])];
    }
    if is_far {
        let moved = significant(deviation, 3);
        outcome
            .warnings
            .push(format!("The curve moves by up to {moved}, {advice}"));
    }
    Ok(outcome)
}

/// The smaller side of the box around samples of a planar curve; of one in space the middle one.
pub(super) fn smaller_side(polygon: &FloatPolygon) -> f64 {
    let samples = 0..=SAMPLES * polygon.segments();
    let samples = samples.map(|sample| polygon.point(sample as f64 / SAMPLES as f64));
    let (low, high) = bounds(samples);
    let mut sides = (high - low).to_array();
    sides.sort_by(f64::total_cmp);
    sides[1]
}

/// One half of the curve, or all of a curve on one side, with its image, within the tolerance that is asked for.
fn completed(
    input: &Operands,
    (half, span, overshoots): (Half, [f64; 2], bool),
    mirror: &Mirror,
    asked: Option<f64>,
    progress: &Progress,
) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let polygon = &curve.polygon;
    let size = BezierPolygon::from_float(polygon).size();
    let strict = asked.unwrap_or(WITHIN * size);
    let kept = KeptHalf::new(polygon, (half, span), mirror, OF_CUT * strict)?;
    let (whole, tolerance) = match found_whole(polygon, &kept, mirror, (asked, size), progress)? {
        Answer::Found(whole, tolerance) => (whole, tolerance),
        Answer::Corner(angle) => return Ok(corner(id, angle)),
    };
    let symmetric = whole.polygon;
    let deviation = whole.off + kept.off;
    let is_far = tolerance > strict && deviation > strict;
    let askew = is_far.then(|| askew(kept.joint(), deviation, strict));
    let replaced = match overshoots {
        true => None,
        false => replaced(polygon, span, &symmetric, progress)?,
    };
    let deviation_is = match (replaced, whole.bounded) {
        (Some(replaced), _) => Deviation::Measured(replaced.max(deviation)),
        (None, true) => Deviation::AtMost(deviation),
        (None, false) => Deviation::Measured(deviation),
    };
    let new = match half {
        Half::First => [0.0, whole.joint[0]],
        Half::Second => [whole.joint[1], symmetric.segments() as f64],
    };
    let [from, to] = span;
    let old = whole.kept.map(|share| from + share * (to - from));
    let spans = spans(old, new, polygon.segments() as f64);
    let middle = symmetric.point(0.5 * (whole.joint[0] + whole.joint[1]));
    let (count, closes) = (symmetric.vertices().len(), symmetric.is_periodic());
    let mut outcome = Outcome::renumbered(input, symmetric, spans, deviation_is)?;
    // The end that meets its image is an end no more, unless another half goes on there.
    if overshoots || span == [0.0, polygon.segments() as f64] {
        let joint = match half {
            Half::First => whole.joint[0],
            Half::Second => whole.joint[1],
        };
        outcome.keep_followers(input, half.inner(), joint)?;
    }
    for end in End::BOTH {
        if closes || end == half.inner() {
            let cut_off = without_target(input.document(), id, curve, end);
            outcome.edits.extend(cut_off);
        }
    }
    if closes {
        let told = "Both ends meet their images: the curve is closed".to_owned();
        outcome.remarks.push(told);
    }
    if overshoots {
        let told = "What went on beyond the axis is cut off".to_owned();
        outcome.remarks.push(told);
    }
    if whole.kept != WHOLE {
        let told = "The end is not perpendicular to the axis: a bridge replaces what is near it";
        outcome.remarks.push(told.to_owned());
    }
    outcome.annotations.push(Annotation::Point(middle));
    let limit = Requirement::Limit {
        found: deviation,
        most: tolerance,
    };
    let another = replaced
        .filter(|moved| *moved > ANOTHER * size)
        .map(|moved| {
            let moved = significant(moved, 3);
            format!("The half that its image replaces moves by up to {moved}: it is another curve")
        });
    let failed = whole.fault.as_ref().or(another.as_ref());
    if failed.is_none() && deviation > tolerance {
        let told = possible("curve", deviation, tolerance);
        outcome.remarks.insert(0, told);
    }
    let failed = failed.map(|_| Requirement::Failed { left: None });
    outcome.requirements = vec![(id, failed.into_iter().chain([limit]).collect())];
    outcome.figures = vec![
        Figure::word("method", "Method", whole.method),
        Figure::count("vertices", "Vertices", count),
    ];
    if let Some(replaced) = replaced {
        let [kept, replaced] = [deviation, replaced].map(|off| significant(off, 3));
        outcome.remarks.push(format!(
            "The half that is kept moves by up to {kept}. The other half, now its image, moves by up to {replaced}"
        ));
    }
    let is_apart = matches!(
        check_joint(kept.joint(), kept.part.size(), strict),
        Err(MergeError::Apart { .. })
    );
    let bridged = is_apart.then(|| bridged_over(&kept));
    let told = [askew, bridged, another, whole.fault.or(whole.knuckle)];
    outcome.warnings.extend(told.into_iter().flatten());
    Ok(outcome)
}

/// What is made of a half.
enum Answer {
    /// A curve with its image, and how far the half may move.
    Found(Whole, f64),
    /// A corner of this angle, in radians, that nothing smooth comes near.
    Corner(f64),
}

/// Find one curve of a half and its image, and the tolerance that it may take; or the corner at which they meet.
fn found_whole(
    polygon: &FloatPolygon,
    kept: &KeptHalf,
    mirror: &Mirror,
    (asked, size): (Option<f64>, f64),
    progress: &Progress,
) -> Result<Answer, OperationError> {
    let strict = asked.unwrap_or(WITHIN * size);
    // The vertices of the segments that the half spans: a cut between knots adds many.
    let [from, to] = kept.span;
    let most = 2 * ((to - from).ceil() as usize + polygon.degree());
    let (parts, joint) = (kept.parts(), kept.joint());
    let checked = check_joint(joint, kept.part.size(), strict);
    // Where the outer ends meet as well, the curve is one half of a closed outline.
    let closes = checked.is_ok() && is_outline(parts, strict);
    let is_half = checked.is_ok() && !closes && !polygon.is_periodic();
    // What nearly meets the axis squarely is also found within the tolerance.
    let is_askew = is_half && (!joint.meets(strict) || joint.angle > ASKEW);
    let share = if is_askew { NEAR } else { ALSO_WITHIN };
    let near = match is_half {
        true => asked.unwrap_or(share * size),
        false => strict,
    };
    let limits = [strict, near].map(|it| (1.0 - OF_CUT) * it);
    let mut bent = match closes {
        true => None,
        false => BentHalf::new(polygon, kept, mirror, limits, progress)?,
    };
    progress.set_done(BEGUN);
    if let Some(bent) = bent.as_ref().filter(|it| it.off <= FAR * size) {
        progress.show(bent.polygon.clone());
    }
    let is_wanted = |it: &mut BentHalf| it.off <= limits[0] || it.is_within(limits[1]);
    if let Some(bent) = bent.take_if(is_wanted) {
        return Ok(Answer::Found(bent.into(), near));
    }
    let tolerance = if is_askew { near } else { strict };
    if tolerance > strict {
        let receded = receded(kept, mirror, progress)?;
        let is_fair = receded.fault.is_none() && receded.knuckle.is_none();
        if is_fair && receded.off <= limits[1] {
            return Ok(Answer::Found(receded, near));
        }
    }
    let whole = match checked {
        Ok(()) if closes => closed(parts, mirror, tolerance, progress)?,
        Ok(()) if polygon.is_periodic() => {
            let [first, second] = parts;
            return Ok(Answer::Corner(joint_of(second, first).angle));
        }
        Ok(()) => match merged(parts, mirror, tolerance, &progress.part(BEGUN, 0.6)) {
            Err(OperationError::Merge(MergeError::NotFound)) => {
                smoothed(kept, mirror, tolerance, progress)?
            }
            merged => with_few_vertices((merged?, most), kept, mirror, tolerance, progress)?,
        },
        Err(MergeError::Corner { angle, .. }) => return Ok(Answer::Corner(angle)),
        Err(_) => {
            let whole = bridged(parts, mirror, progress)?;
            progress.show(whole.polygon.clone());
            progress.set_done(0.5);
            bridged_with_few_vertices((whole, most), mirror, tolerance, progress)?
        }
    };
    let limit = (1.0 - OF_CUT) * tolerance;
    let is_nearer = |bent: &BentHalf| whole.off > limit.max(bent.off);
    let whole = match bent.filter(is_nearer) {
        Some(bent) => bent.into(),
        None => whole,
    };
    Ok(Answer::Found(whole, tolerance))
}

/// Whether a planar half and its image meet, without a corner, at their outer ends.
fn is_outline([first, second]: [&FloatPolygon; 2], tolerance: f64) -> bool {
    let joint = joint_of(second, first);
    let is_smooth = check_joint(joint, first.size(), tolerance).is_ok();
    joint.meets(tolerance) && is_smooth && first.is_planar()
}

/// The spans of the part that is kept: across the joint of a periodic curve there are two.
fn spans([from, to]: [f64; 2], [start, end]: [f64; 2], last: f64) -> Vec<ParameterSpan> {
    let span = |old: [f64; 2], new: [f64; 2]| ParameterSpan { old, new };
    if to <= last {
        return vec![span([from, to], [start, end])];
    }
    let joint = start + (end - start) * (last - from) / (to - from);
    vec![
        span([from, last], [start, joint]),
        span([0.0, to - last], [joint, end]),
    ]
}

/// How far a curve is from the symmetric one where that replaces a part of it; `None` if all of it is kept.
fn replaced(
    polygon: &FloatPolygon,
    span: [f64; 2],
    symmetric: &FloatPolygon,
    progress: &Progress,
) -> Result<Option<f64>, OperationError> {
    if span == [0.0, polygon.segments() as f64] {
        return Ok(None);
    }
    let distance = SideDeviation::both_ways([polygon, symmetric], progress);
    distance.map(Some).map_err(|_| OperationError::Cancelled)
}

/// Say why a half moves farther than a tolerance, by the joint with its image.
fn askew(joint: Joint, off: f64, tolerance: f64) -> String {
    let beside = 0.5 * joint.gap;
    let beside = match beside > tolerance {
        true => format!("{} beside it and ", significant(beside, 2)),
        false => String::new(),
    };
    let [angle, off] = [0.5 * joint.angle.to_degrees(), off].map(|it| significant(it, 2));
    format!("The half met the axis {beside}{angle}° askew: it moves by up to {off}")
}

/// Say which end of a half far from the axis is joined to its image, and over what gap.
fn bridged_over(kept: &KeptHalf) -> String {
    let end = kept.part.end_jet(kept.inner()).point;
    let [x, y, gap] = [end.x, end.y, kept.joint().gap].map(|it| significant(it, 3));
    format!(
        "The end at {x}, {y} is far from the axis: a bridge over {gap} joins it to its image. “Mirror” as a copy leaves both apart"
    )
}

/// Say that a half meets its image at a corner.
fn corner(id: CurveId, angle: f64) -> Outcome {
    let angle = significant(angle.to_degrees(), 3);
    refused(
        id,
        format!(
            "The curve meets its image at a corner of {angle}°: turn its end perpendicular to the axis first"
        ),
    )
}

/// Say that the axis does not cut a closed curve in half.
fn no_halves(id: CurveId, crossings: usize) -> Outcome {
    let times = counted(crossings, "time", "times");
    refused(
        id,
        format!(
            "The curve crosses the axis {times}: only one that crosses it twice has two halves"
        ),
    )
}

fn refused(id: CurveId, why: String) -> Outcome {
    Outcome {
        requirements: vec![(id, vec![Requirement::Failed { left: None }])],
        remarks: vec![why],
        ..Outcome::unchanged(Deviation::Unmeasured)
    }
}
