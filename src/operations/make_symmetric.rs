//! A curve that becomes its own mirror image.

use std::f64::consts::PI;
use std::time::Duration;

use glam::{DVec2, DVec3};

use super::bridge::{self, found};
use super::cutting::without_target;
use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::join::{ALSO_WITHIN, MERGING, TOLERANCE, WITHIN, merge_error, possible};
use super::lists::given;
use super::mirror::{FROM, PLANE, TO, check_free, plane_or_line};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, Parameter};
use super::values::Values;
use crate::document::{CurveId, Document, Edit, ParameterSpan};
use crate::geometry::approximation::close_halves;
use crate::geometry::approximation::merging::{MergeError, check_joint, joint_of, merge};
use crate::geometry::distance::SideDeviation;
use crate::geometry::fairing::bridging::{Bridge, join};
use crate::geometry::fairing::mirrored_half::joined_to_image;
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::features::{Feature, Features};
use crate::geometry::fitting::{PlaneFit, SymmetryAxis, fit_plane};
use crate::geometry::{
    BezierPolygon, End, FloatPolygon, Joint, Mirror, Progress, Symmetry, arc_length_between,
    bounds, counted, significant,
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

const STAY: Parameter = Parameter {
    name: "stay",
    label: "Stay symmetric",
    help: "Let later edits of one half change the other half too",
    kind: Kind::Switch { default: false },
};

/// The share of the tolerance that cutting the curve in half may take.
const OF_CUT: f64 = 0.1;

/// The shares that merging the half with its image may take, before the mean of both: each search finds another curve.
const OF_MERGE: [f64; 3] = [0.5, 0.2, 1.0];

/// A part of an open curve beyond the axis is an overshoot up to this share of the rest: a half that was drawn a little
/// too far. Of a longer one nobody knows which half is meant.
const OVERSHOOT: f64 = 0.1;

/// The share of a half that a bridge replaces where nothing else is found: less leaves no room to turn a corner off.
const RECEDED: f64 = 0.04;

/// The share of the work that bending is.
const BEGUN: f64 = 0.1;

/// How often the segments of a half that bends are halved: few vertices come first.
const HALVED: [u32; 2] = [0, 1];

/// How many vertices bend near the axis, as multiples of the degree and more: many bend fairly, few stay near.
const BENT: [[usize; 2]; 3] = [[4, 8], [2, 4], [1, 2]];

/// The share of its size by which a half that meets the axis askew may move where no tolerance is given: what is traced by
/// hand meets no axis squarely.
const NEAR: f64 = 5e-3;

/// The corner with the image, in radians, from which on a half meets the axis askew: 1°.
const ASKEW: f64 = PI / 180.0;

/// Beyond the tolerance, a fit within so many times of it shows what a larger one would give.
const LARGER: f64 = 4.0;

/// The time for a fit of both halves.
const FITTING: Duration = Duration::from_secs(5);

/// The points of a half to which one curve is fitted with its image.
const FITTED: usize = 200;

/// The relative precision of lengths that are compared with that.
const PRECISION: f64 = 1e-3;

/// How often segments are halved at most where the curve is cut.
const HALVINGS: u32 = 6;

/// The samples of a segment among which the curve crosses the mirror plane.
const SAMPLES: usize = 32;

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

/// Which half is kept.
#[derive(Clone, Copy, PartialEq)]
enum Half {
    First,
    Second,
}

impl Half {
    /// The end of the half at the mirror plane.
    fn inner(self) -> End {
        match self {
            Self::First => End::Finish,
            Self::Second => End::Start,
        }
    }

    /// A half and its image in the order of the whole.
    fn in_order<T>(self, half: T, image: T) -> [T; 2] {
        match self {
            Self::First => [half, image],
            Self::Second => [image, half],
        }
    }
}

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

/// The half of a shape that an open curve is, where it goes on beyond the mirror plane by no more than an overshoot.
fn drawn_half(polygon: &FloatPolygon, crossings: &[f64]) -> Option<(Half, [f64; 2])> {
    if polygon.is_periodic() || crossings.is_empty() {
        return None;
    }
    let last = polygon.segments() as f64;
    let places: Vec<f64> = [&[0.0], crossings, &[last]].concat();
    let parts = places.windows(2).map(|part| [part[0], part[1]]);
    let parts = parts.map(|[from, to]| {
        let length = arc_length_between(polygon, from, to, PRECISION);
        (length, [from, to])
    });
    let parts: Vec<(f64, [f64; 2])> = parts.collect();
    let whole: f64 = parts.iter().map(|(length, _)| length).sum();
    let longest = parts.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let (length, span) = longest?;
    let half = match span[0] == 0.0 {
        true => Half::First,
        false => Half::Second,
    };
    (whole - length <= OVERSHOOT * length).then_some((half, span))
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
    let (part, cut) = cut(polygon, span, OF_CUT * strict)?;
    // The vertices of the segments that the half spans: a cut between knots adds many.
    let most = 2 * ((span[1] - span[0]).ceil() as usize + polygon.degree());
    let image = image(&part, mirror)?;
    let [first, second] = half.in_order(&part, &image);
    let joint = joint_of(first, second);
    let checked = check_joint(joint, part.size(), strict);
    // Where the outer ends meet as well, the curve is one half of a closed outline.
    let closes = checked.is_ok() && is_outline([first, second], strict);
    let is_half = checked.is_ok() && !closes && !polygon.is_periodic();
    // What nearly meets the axis squarely is also found within the tolerance.
    let is_askew = is_half && (!joint.meets(strict) || joint.angle > ASKEW);
    let share = if is_askew { NEAR } else { ALSO_WITHIN };
    let near = match is_half {
        true => asked.unwrap_or(share * size),
        false => strict,
    };
    let is_apart = matches!(checked, Err(MergeError::Apart { .. }));
    let limits = [strict, near].map(|it| (1.0 - OF_CUT) * it);
    let mut bent = match closes {
        true => None,
        false => bent((polygon, &part), (half, span), mirror, limits, progress)?,
    };
    progress.set_done(BEGUN);
    if let Some(bent) = bent.as_ref().filter(|it| it.off <= FAR * size) {
        progress.show(bent.polygon.clone());
    }
    let is_wanted = |it: &mut Bent| it.off <= limits[0] || it.is_within(limits[1]);
    let wanted = bent.take_if(is_wanted).map(Bent::whole);
    let tolerance = match is_askew || wanted.is_some() {
        true => near,
        false => strict,
    };
    let wanted = match wanted {
        None if tolerance > strict => {
            let receded = receded(&part, half, mirror, progress)?;
            let is_fair = receded.fault.is_none() && receded.knuckle.is_none();
            Some(receded).filter(|it| is_fair && it.off <= limits[1])
        }
        wanted => wanted,
    };
    let whole = match (wanted, checked) {
        (Some(whole), _) => whole,
        (None, Ok(())) if closes => closed([first, second], mirror, tolerance, progress)?,
        (None, Ok(())) if polygon.is_periodic() => {
            return Ok(corner(id, joint_of(second, first).angle));
        }
        (None, Ok(())) => match merged(
            [first, second],
            mirror,
            tolerance,
            &progress.part(BEGUN, 0.6),
        ) {
            Err(OperationError::Merge(MergeError::NotFound)) => {
                smoothed((&part, [first, second]), half, mirror, tolerance, progress)?
            }
            merged => {
                let halves = (&part, [first, second]);
                with_few_vertices((merged?, most), halves, mirror, tolerance, progress)?
            }
        },
        (None, Err(MergeError::Corner { angle, .. })) => return Ok(corner(id, angle)),
        (None, Err(_)) => {
            let whole = bridged([first, second], mirror, progress)?;
            progress.show(whole.polygon.clone());
            progress.set_done(0.5);
            let halves = (&part, [first, second]);
            with_few_vertices((whole, most), halves, mirror, tolerance, progress)?
        }
    };
    let limit = (1.0 - OF_CUT) * tolerance;
    let is_nearer = |bent: &Bent| whole.off > limit.max(bent.off);
    let whole = match bent {
        Some(bent) if is_nearer(&bent) => bent.whole(),
        _ => whole,
    };
    let symmetric = whole.polygon;
    let deviation = whole.off + cut;
    let is_far = tolerance > strict && deviation > strict;
    let askew = is_far.then(|| askew(joint, deviation, strict));
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
    let kept = whole.kept.map(|share| from + share * (to - from));
    let spans = spans(kept, new, polygon.segments() as f64);
    let middle = symmetric.point(0.5 * (whole.joint[0] + whole.joint[1]));
    let (count, closes) = (symmetric.vertices().len(), symmetric.is_periodic());
    let mut outcome = Outcome::renumbered(input, symmetric, spans, deviation_is)?;
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
    let bridged = is_apart.then(|| bridged_over(part.end_jet(half.inner()).point, joint));
    let told = [askew, bridged, another, whole.fault.or(whole.knuckle)];
    outcome.warnings.extend(told.into_iter().flatten());
    Ok(outcome)
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

/// A half and its image in one.
struct Whole {
    polygon: FloatPolygon,
    method: &'static str,
    /// Where the first of both ends on it, and where the second begins.
    joint: [f64; 2],
    /// The shares of the half between which it is kept.
    kept: [f64; 2],
    /// How far it is from both.
    off: f64,
    /// Whether that is a bound.
    bounded: bool,
    /// Why it is no use.
    fault: Option<String>,
    /// What the user may not want of it.
    knuckle: Option<String>,
}

/// All of a half.
const WHOLE: [f64; 2] = [0.0, 1.0];

/// A half that was bent near the axis, and its image in one.
struct Bent {
    polygon: FloatPolygon,
    /// How far the half moves.
    off: f64,
    /// The inflections that neither the half nor its image has.
    waves: usize,
}

impl Bent {
    /// Whether it is fair and near.
    fn is_within(&self, limit: f64) -> bool {
        self.waves == 0 && self.off <= limit
    }

    fn whole(self) -> Whole {
        Whole {
            joint: [0.5 * self.polygon.segments() as f64; 2],
            kept: WHOLE,
            polygon: self.polygon,
            method: "bend",
            off: self.off,
            bounded: false,
            fault: None,
            knuckle: None,
        }
    }
}

/// Bend the vertices of a half near the axis so that it goes on smoothly into its image: the first try without waves within
/// the first limit, or the best one within the second. `None` for what has no plane.
fn bent(
    (polygon, part): (&FloatPolygon, &FloatPolygon),
    (half, [from, to]): (Half, [f64; 2]),
    mirror: &Mirror,
    [limit, near]: [f64; 2],
    progress: &Progress,
) -> Result<Option<Bent>, OperationError> {
    if polygon.is_periodic() {
        return Ok(None);
    }
    let own =
        2 * inflections(part, progress)? + 2 * usize::from(turns_back(part, half.inner(), mirror));
    let mut best: Option<Bent> = None;
    for halvings in HALVED {
        // The end of the cut is near the axis: it need not be exact.
        let is_whole = [from, to] == [0.0, polygon.segments() as f64];
        let cut = match is_whole && halvings == 0 {
            true => polygon.clone(),
            false => polygon.trimmed(from, to, halvings)?.polygon,
        };
        for [times, more] in BENT {
            let reach = times * polygon.degree() + more;
            let whole = match half.inner() {
                End::Start => joined_to_image(&cut, mirror, reach),
                End::Finish => {
                    let whole = joined_to_image(&cut.reversed(), mirror, reach);
                    whole.map(|it| it.reversed())
                }
            };
            let Some(whole) = whole else {
                return Ok(None);
            };
            let off = SideDeviation::of_curve(part, &whole, progress);
            let off = off.map_err(|_| OperationError::Cancelled)?;
            let bent = Bent {
                off: off.largest.distance(),
                waves: inflections(&whole, progress)?.saturating_sub(own),
                polygon: whole,
            };
            let rank = |it: &Bent| (it.off > near, it.waves, it.off);
            let is_better = |known: &Bent| rank(&bent) < rank(known);
            if best.as_ref().is_none_or(is_better) {
                best = Some(bent);
            }
            if best.as_ref().is_some_and(|it| it.is_within(limit)) {
                return Ok(best);
            }
        }
        if best.as_ref().is_some_and(|it| it.is_within(near)) {
            break;
        }
    }
    Ok(best)
}

/// Whether a planar half turns the other way at the mirror plane than before it: then its curvature changes its sign on
/// either side.
fn turns_back(part: &FloatPolygon, inner: End, mirror: &Mirror) -> bool {
    let jet = part.end_jet(inner);
    let (Some(tangent), Some([_, normal])) = (jet.tangent(), mirror.plane()) else {
        return false;
    };
    // Beyond the plane the part of the tangent across goes on, and that within it turns round.
    let across = tangent.dot(normal) * normal;
    let image = 2.0 * across - tangent;
    let turn = match inner {
        End::Start => image.truncate().perp_dot(tangent.truncate()),
        End::Finish => tangent.truncate().perp_dot(image.truncate()),
    };
    part.is_planar() && turn * jet.curvature_of(true) < 0.0
}

/// Count the proved inflections of a curve.
fn inflections(polygon: &FloatPolygon, progress: &Progress) -> Result<usize, OperationError> {
    let features = Features::proved(polygon, |_| !progress.is_cancelled());
    let features = features.ok_or(OperationError::Cancelled)?;
    Ok(features.count(Feature::Inflection))
}

/// Merge a half with its image.
fn merged(
    parts: [&FloatPolygon; 2],
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    // What it finds meanwhile is not symmetric yet.
    let progress = progress.limited(MERGING).unshown();
    let within = |tolerance: f64| {
        let merged = merge(parts[0], parts[1], tolerance, &progress)?;
        let symmetric = merged.polygon.symmetrised(mirror)?;
        merged.with_polygon(parts, symmetric, &progress)
    };
    let mut merged = within(OF_MERGE[0] * tolerance);
    for (tried, share) in OF_MERGE.iter().enumerate().skip(1) {
        progress.set_done(tried as f64 / OF_MERGE.len() as f64);
        let is_near =
            matches!(&merged, Ok(merged) if merged.deviation <= (1.0 - OF_CUT) * tolerance);
        if is_near || progress.is_cancelled() {
            break;
        }
        merged = match (merged, within(share * tolerance)) {
            (Ok(merged), Ok(other)) if other.deviation < merged.deviation => Ok(other),
            (Err(_), other) => other,
            (merged, _) => merged,
        };
    }
    let merged = merged.map_err(|error| merge_error(error, &progress))?;
    Ok(Whole {
        joint: [merged.tracks[0].at(parts[0].segments() as f64); 2],
        kept: WHOLE,
        polygon: merged.polygon,
        method: "merge",
        off: merged.deviation,
        bounded: merged.bounded,
        fault: None,
        knuckle: None,
    })
}

/// Whether a planar half and its image meet, without a corner, at their outer ends.
fn is_outline([first, second]: [&FloatPolygon; 2], tolerance: f64) -> bool {
    let joint = joint_of(second, first);
    let is_smooth = check_joint(joint, first.size(), tolerance).is_ok();
    joint.meets(tolerance) && is_smooth && first.is_planar()
}

/// The nearest periodic curve of a half and its image.
fn closed(
    parts: [&FloatPolygon; 2],
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let limited = progress.limited(MERGING).unshown();
    let mut nearest: Option<Whole> = None;
    for share in OF_MERGE {
        let found = match close_halves(parts, share * tolerance, &limited) {
            Ok(found) => found,
            Err(_) if progress.is_cancelled() => return Err(OperationError::Cancelled),
            Err(_) => continue,
        };
        let polygon = found.polygon.symmetrised(mirror)?;
        let off = SideDeviation::of_curve(parts[0], &polygon, progress);
        let off = off.map_err(|_| OperationError::Cancelled)?;
        let off = off.largest.distance();
        let whole = Whole {
            joint: [
                found.tracks[0].at(parts[0].segments() as f64),
                found.tracks[1].at(0.0),
            ],
            kept: WHOLE,
            polygon,
            method: "merge",
            off,
            bounded: false,
            fault: None,
            knuckle: (off > tolerance).then(|| rounded_corners(parts)),
        };
        if nearest.as_ref().is_none_or(|known| whole.off < known.off) {
            nearest = Some(whole);
        }
        let limit = (1.0 - OF_CUT) * tolerance;
        if nearest.as_ref().is_some_and(|known| known.off <= limit) {
            break;
        }
    }
    nearest.ok_or(MergeError::NotFound.into())
}

/// Bridge the gap between a curve and its image.
fn bridged(
    parts: [&FloatPolygon; 2],
    mirror: &Mirror,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let wanted = Bridge {
        vertices: None,
        second_moves: false,
    };
    let found = found(join(parts[0], parts[1], &wanted, progress))?;
    let fault = bridge::fault(&found, parts).or_else(|| bridge::spike(&found));
    let symmetric = found.polygon.symmetrised(mirror)?;
    Ok(Whole {
        joint: found.joint,
        kept: WHOLE,
        method: "bridge",
        // Both parts have as many segments, so that the bridge lies in the middle.
        off: found.polygon.deviation(&symmetric)?,
        bounded: true,
        knuckle: bridge::knuckle(&found).filter(|_| fault.is_none()),
        fault: fault
            .map(|fault| format!("{fault}: bring the end to the axis, perpendicular to it")),
        polygon: symmetric,
    })
}

/// A whole with more vertices than both halves have, as a cut or a bridge refines them, as one curve with fewer if one is
/// within the tolerance.
fn with_few_vertices(
    (whole, most): (Whole, usize),
    halves: (&FloatPolygon, [&FloatPolygon; 2]),
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let count = |polygon: &FloatPolygon| polygon.vertices().len();
    if count(&whole.polygon) <= most || whole.fault.is_some() {
        return Ok(whole);
    }
    let fitted = refitted(halves, mirror, tolerance, progress)?;
    let fewer = fitted.filter(|fitted| count(&fitted.polygon) < count(&whole.polygon));
    Ok(fewer.unwrap_or(whole))
}

/// Fit one curve with few extrema to points of a half and of its image; `None` if none is near, or the mirror plane is none
/// of those that fits know.
///
/// Merging keeps every wave of the half, and has no room to turn a corner off. A fit may smooth both away.
fn refitted(
    (part, parts): (&FloatPolygon, [&FloatPolygon; 2]),
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Option<Whole>, OperationError> {
    let axis = match mirror {
        Mirror::Signs([true, false, false]) => SymmetryAxis::Y,
        Mirror::Signs([false, true, false]) => SymmetryAxis::X,
        _ => return Ok(None),
    };
    if !part.is_planar() {
        return Ok(None);
    }
    let samples = |polygon: &FloatPolygon| {
        let whole = [0.0, polygon.segments() as f64];
        let steps = (0..=FITTED).map(|step| step as f64 / FITTED as f64);
        let parameters = steps.map(|share| whole[1] * share);
        let points = parameters.map(|u| polygon.point(u).truncate());
        points.collect::<Vec<DVec2>>()
    };
    let [mut points, second] = parts.map(samples);
    // Both meet at the axis, but for what the tolerance allows.
    points.extend(second.into_iter().skip(1));
    let within = (1.0 - OF_CUT) * tolerance;
    let asked = PlaneFit {
        degree: part.degree(),
        tolerance: Some((1.0 - OF_CUT) * within),
        outliers: Some(Vec::new()),
        mirror: Some(axis),
        of_curve: true,
        ..PlaneFit::default()
    };
    let fitted = match fit_plane(&points, &asked, &progress.limited(FITTING).unshown()) {
        Ok(fitted) => fitted,
        Err(_) if progress.is_cancelled() => return Err(OperationError::Cancelled),
        Err(_) => return Ok(None),
    };
    let off = SideDeviation::of_curve(part, &fitted.polygon, progress);
    let off = off.map_err(|_| OperationError::Cancelled)?;
    let off = off.largest.distance();
    let is_near = off <= within && fitted.crossing.is_none();
    Ok(is_near.then_some(Whole {
        joint: [0.5 * fitted.polygon.segments() as f64; 2],
        kept: WHOLE,
        polygon: fitted.polygon,
        method: "fit",
        off,
        bounded: false,
        fault: None,
        knuckle: None,
    }))
}

/// A half and its image in one where no merged curve is as fair: one fit within the tolerance, or a bridge, or what a larger
/// tolerance would give.
fn smoothed(
    halves: (&FloatPolygon, [&FloatPolygon; 2]),
    half: Half,
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    if let Some(fitted) = refitted(halves, mirror, tolerance, progress)? {
        return Ok(fitted);
    }
    progress.set_done(0.7);
    let receded = receded(halves.0, half, mirror, progress)?;
    progress.set_done(0.85);
    if receded.fault.is_none() && receded.off <= (1.0 - OF_CUT) * tolerance {
        return Ok(receded);
    }
    let fitted = refitted(halves, mirror, LARGER * tolerance, progress)?;
    Ok(fitted.unwrap_or(receded))
}

/// Bridge from a half to its image, in place of what lies near the axis: where both meet at a corner that no curve as fair
/// comes near.
fn receded(
    part: &FloatPolygon,
    half: Half,
    mirror: &Mirror,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let kept = match half.inner() {
        End::Start => [RECEDED, 1.0],
        End::Finish => [0.0, 1.0 - RECEDED],
    };
    let span = kept.map(|share| share * part.segments() as f64);
    let (short, _) = cut(part, span, OF_CUT * WITHIN * part.size())?;
    let image = image(&short, mirror)?;
    let [first, second] = half.in_order(&short, &image);
    let whole = bridged([first, second], mirror, progress)?;
    let off = SideDeviation::of_curve(part, &whole.polygon, progress);
    let off = off.map_err(|_| OperationError::Cancelled)?;
    Ok(Whole {
        off: off.largest.distance(),
        bounded: false,
        kept,
        ..whole
    })
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
fn bridged_over(end: DVec3, joint: Joint) -> String {
    let [x, y] = [end.x, end.y].map(|it| significant(it, 3));
    let gap = significant(joint.gap, 3);
    format!("The end at {x}, {y} is far from the axis: a bridge over {gap} joins it to its image")
}

/// Say which corners keep a closed curve from being near.
fn rounded_corners([first, second]: [&FloatPolygon; 2]) -> String {
    let angles = [joint_of(first, second), joint_of(second, first)].map(|joint| {
        let degrees = joint.angle.to_degrees();
        significant(degrees, 2)
    });
    let [inner, outer] = angles;
    format!(
        "The curve meets its image at corners of {inner}° and {outer}°, which are rounded: turn its ends perpendicular to the axis, or raise “{}”",
        TOLERANCE.label
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

/// Cut a part out of a curve, and say how far off it is: as near as asked for, or as halvings of segments bring it.
fn cut(
    polygon: &FloatPolygon,
    [from, to]: [f64; 2],
    within: f64,
) -> Result<(FloatPolygon, f64), OperationError> {
    if [from, to] == [0.0, polygon.segments() as f64] {
        return Ok((polygon.clone(), 0.0));
    }
    let mut part = polygon.trimmed(from, to, 0)?;
    for halvings in 1..=HALVINGS {
        if part.exact || part.deviation <= within {
            break;
        }
        part = polygon.trimmed(from, to, halvings)?;
    }
    let off = if part.exact { 0.0 } else { part.deviation };
    Ok((part.polygon, off))
}

/// The mirror image of a part, in the direction in which it goes on from it.
fn image(part: &FloatPolygon, mirror: &Mirror) -> Result<FloatPolygon, OperationError> {
    let vertices = part.vertices().iter().rev();
    let vertices = vertices.map(|it| mirror.point(*it)).collect();
    let weights = part.weights();
    let weights = weights.map(|weights| weights.iter().rev().copied().collect());
    Ok(FloatPolygon::new(part.degree(), vertices, weights, false)?)
}

/// The parameters at which a curve crosses the mirror plane, in their order; none where it stays within the tolerance on
/// one side.
fn crossings(polygon: &FloatPolygon, mirror: &Mirror, tolerance: f64) -> Vec<f64> {
    let last = polygon.segments() as f64;
    let inside = |u: f64| {
        if u >= last && polygon.is_periodic() {
            u - last
        } else {
            u
        }
    };
    let height = |u: f64| mirror.height(polygon.point(inside(u))).unwrap_or(0.0);
    let samples = 0..=polygon.segments() * SAMPLES;
    let heights = samples.map(|sample| sample as f64 / SAMPLES as f64);
    let heights = heights.map(|u| (u, height(u)));
    let heights: Vec<(f64, f64)> = heights.filter(|(_, at)| at.abs() > tolerance).collect();
    // A closed curve goes on from its end to its start.
    let over_the_joint = heights.first().filter(|_| polygon.is_periodic());
    let over_the_joint = over_the_joint.map(|(u, at)| (u + last, *at));
    let walked: Vec<(f64, f64)> = heights.iter().copied().chain(over_the_joint).collect();
    let crossed = walked.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0);
    let crossings = crossed.map(|pair| inside(bisected([pair[0].0, pair[1].0], pair[0].1, height)));
    let mut crossings: Vec<f64> = crossings.collect();
    crossings.sort_by(f64::total_cmp);
    crossings
}

/// The place between two at which the height, `below` at the first, changes its sign.
fn bisected([mut from, mut to]: [f64; 2], below: f64, height: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to {
            return middle;
        }
        match height(middle) * below > 0.0 {
            true => from = middle,
            false => to = middle,
        }
    }
}

/// The half that a curve on one side of the mirror plane is: inside is the end that goes on into its image, or else that
/// which meets it at the smaller corner; where both do, or none comes near, the nearer one.
fn one_side(
    polygon: &FloatPolygon,
    mirror: &Mirror,
    tolerance: f64,
) -> Result<Half, OperationError> {
    let image = image(polygon, mirror)?;
    let [first, second] = [Half::First, Half::Second].map(|half| {
        let [before, after] = half.in_order(polygon, &image);
        let height = mirror.height(polygon.end_jet(half.inner()).point);
        let height = height.unwrap_or(0.0).abs();
        match check_joint(joint_of(before, after), polygon.size(), tolerance) {
            Ok(()) => (0, height),
            Err(MergeError::Corner { angle, .. }) => (1, angle),
            Err(_) => (2, height),
        }
    });
    Ok(match second < first {
        true => Half::Second,
        false => Half::First,
    })
}
