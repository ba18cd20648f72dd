//! The true segment of a kind between two ends.

use glam::DVec2;

use super::clothoid::Clothoid;
use super::ends::{SAME, Task};
use super::error::BetweenError;
use super::existence::check_existence;
use super::log_aesthetic::LogAesthetic;
use super::pair::{Chain, PlaneSegment, clothoids, log_aesthetic_pair};
use super::parts::{Part, Parts};
use crate::geometry::differentiable::Differentiable;
use crate::geometry::references::{
    AnalyticForm, Placement, ReferenceCurve, ReferenceForm, clothoid, log_aesthetic,
};

/// Clothoids whose curvature changes by more than this factor, or its sign, are drawn from their
/// inflection.
const NEAR_INFLECTION: f64 = 1e-3;

/// The clothoid's α.
const CLOTHOID: f64 = -1.0;

/// The logarithmic spiral's α, with which there is a segment between ends as unlike as can be.
const LOGARITHMIC: f64 = 1.0;

/// The names of the ends.
const ENDS: [&str; 2] = ["start", "end"];

/// The ends of the chord.
pub(super) const CHORD: [DVec2; 2] = [DVec2::ZERO, DVec2::X];

/// Find the log-aesthetic segment, or the pair of them.
pub(super) fn log_aesthetic_parts(task: &Task, alpha: Option<f64>) -> Result<Parts, BetweenError> {
    let convex = task.is_convex();
    if !convex && alpha.is_some_and(|alpha| alpha != CLOTHOID) {
        let alpha = alpha.unwrap_or(CLOTHOID);
        return Err(inflection(task, name(alpha)));
    }
    let single = match (alpha, task.curvatures) {
        // All α have the arc.
        (None, _) if task.is_arc() => single(task, CLOTHOID),
        (None, [Some(curvature), _]) if convex => with_curvature(task, 0, curvature),
        (None, [None, Some(curvature)]) if convex => with_curvature(task, 1, curvature),
        (alpha, _) => single(task, alpha.unwrap_or(CLOTHOID)),
    };
    let single = single.and_then(|segment| {
        check_curvatures(task, segment.curvatures().map(|it| task.curvature(it)))?;
        Ok(segment)
    });
    match (single, task.curvatures) {
        (Ok(segment), _) => Ok(Parts::new(vec![part(task, segment, CHORD)?])),
        (Err(_), [Some(first), Some(last)]) => several(task, alpha, [first, last]),
        (Err(error), _) => Err(error),
    }
}

/// Find the segment of an α.
fn single(task: &Task, alpha: f64) -> Result<PlaneSegment, BetweenError> {
    if alpha == CLOTHOID {
        let clothoid = Clothoid::between(task.angles).ok_or(BetweenError::NoClothoid)?;
        return Ok(PlaneSegment::Clothoid(clothoid));
    }
    let found = LogAesthetic::leaning(alpha, task.turning(), task.lean());
    found.map(PlaneSegment::LogAesthetic).map_err(|most| {
        let half = 0.5 * task.turning();
        out_of_reach(task, name(alpha), [half - most, half + most])
    })
}

/// Find the segment of any α with a curvature at one end.
fn with_curvature(task: &Task, end: usize, curvature: f64) -> Result<PlaneSegment, BetweenError> {
    match LogAesthetic::with_curvature(task.turning(), task.lean(), end, curvature) {
        Ok(segment) => Ok(PlaneSegment::LogAesthetic(segment)),
        Err(Some(range)) => {
            let mut range = range.map(|it| task.curvature(it));
            range.sort_by(f64::total_cmp);
            let (end, asked) = (ENDS[end], task.curvature(curvature));
            Err(match range.iter().all(|it| it * asked < 0.0) {
                true => BetweenError::OtherTurn { end, asked },
                false => BetweenError::CurvatureOutOfReach { end, asked, range },
            })
        }
        Err(None) => single(task, LOGARITHMIC),
    }
}

/// Find two segments for two curvatures.
fn several(task: &Task, alpha: Option<f64>, curvatures: [f64; 2]) -> Result<Parts, BetweenError> {
    check_existence(task)?;
    let pair = match task.is_convex() {
        true => log_aesthetic_pair(task, alpha, curvatures),
        false => None,
    };
    let may_be_clothoids = alpha.is_none_or(|alpha| alpha == CLOTHOID);
    let clothoids = || may_be_clothoids.then(|| clothoids(task, curvatures));
    let Some(Chain { segments, points }) = pair.or_else(|| clothoids().flatten()) else {
        let alpha = alpha.map_or("any α".to_owned(), |alpha| format!("α = {alpha}"));
        return Err(BetweenError::NoPair { alpha });
    };
    let spans = points.windows(2).map(|span| [span[0], span[1]]);
    let parts = segments.into_iter().zip(spans);
    let parts = parts.map(|(segment, span)| part(task, segment, span));
    Ok(Parts::new(parts.collect::<Result<_, _>>()?))
}

/// Refuse ends that ask for an inflection: by a curvature that turns the other way, if the directions do not.
pub(super) fn inflection(task: &Task, kind: String) -> BetweenError {
    let turned = |curvature: &Option<f64>| curvature.is_some_and(|curvature| curvature < 0.0);
    let place = task.curvatures.iter().position(turned);
    let bends = task.angles.into_iter().all(|angle| angle > 0.0);
    match place.filter(|_| bends) {
        Some(place) => BetweenError::OtherTurn {
            end: ENDS[place],
            asked: task.curvature(task.curvatures[place].unwrap_or_default()),
        },
        None => BetweenError::Inflection { kind },
    }
}

pub(super) fn out_of_reach(task: &Task, kind: String, reach: [f64; 2]) -> BetweenError {
    BetweenError::OutOfReach {
        kind,
        turning: task.turning(),
        reach,
        angle: task.angles[0],
    }
}

fn name(alpha: f64) -> String {
    format!("a log-aesthetic curve with α = {alpha}")
}

/// Refuse if curvatures differ from the requested ones.
pub(super) fn check_curvatures(task: &Task, found: [f64; 2]) -> Result<(), BetweenError> {
    let asked = task.curvatures.map(|it| it.map(|it| task.curvature(it)));
    for ((end, found), asked) in ENDS.into_iter().zip(found).zip(asked) {
        if let Some(asked) = asked.filter(|asked| !((found - asked).abs() <= SAME * asked.abs())) {
            return Err(match found * asked < 0.0 {
                true => BetweenError::OtherTurn { end, asked },
                false => BetweenError::OtherCurvature { end, found, asked },
            });
        }
    }
    Ok(())
}

/// Place a segment between two points on the chord from (0, 0) to (1, 0).
fn part(task: &Task, segment: PlaneSegment, wanted: [DVec2; 2]) -> Result<Part, BetweenError> {
    match segment {
        PlaneSegment::LogAesthetic(segment) => log_aesthetic_part(task, segment, wanted),
        PlaneSegment::Clothoid(clothoid) => clothoid_part(task, clothoid, wanted),
    }
}

fn log_aesthetic_part(
    task: &Task,
    segment: LogAesthetic,
    wanted: [DVec2; 2],
) -> Result<Part, BetweenError> {
    let [lambda, length] = segment.lambda_and_length();
    let form = AnalyticForm::new(&log_aesthetic::KIND, vec![segment.alpha, lambda])?;
    placed(task, form, [0.0, length], wanted, false)
}

/// Place a clothoid: far from its inflection as a log-aesthetic curve, whose numbers stay moderate
/// where it is all but an arc; elsewhere from its inflection.
fn clothoid_part(
    task: &Task,
    clothoid: Clothoid,
    wanted: [DVec2; 2],
) -> Result<Part, BetweenError> {
    let [first, last] = clothoid.curvatures;
    if first > 0.0 && last > NEAR_INFLECTION * first && first > NEAR_INFLECTION * last {
        let segment = LogAesthetic {
            alpha: CLOTHOID,
            growth: (first / last).ln(),
            turning: clothoid.turning(),
        };
        return log_aesthetic_part(task, segment, wanted);
    }
    // Its curvature rises; turned over it falls.
    let over = last < first;
    let side = if over { -1.0 } else { 1.0 };
    let squared = (last - first).abs().recip();
    let form = AnalyticForm::new(&clothoid::KIND, vec![squared.sqrt()])?;
    let interval = [first, last].map(|curvature| side * curvature * squared);
    placed(task, form, interval, wanted, over)
}

/// Place an interval of a curve between two points on the chord from (0, 0) to (1, 0). `over`: its left
/// is the segment's right.
fn placed(
    task: &Task,
    form: AnalyticForm,
    interval: [f64; 2],
    wanted: [DVec2; 2],
    over: bool,
) -> Result<Part, BetweenError> {
    let form = ReferenceForm::Analytic(form);
    let plain = ReferenceCurve::new(form, interval, Placement::default())?;
    let own = interval.map(|t| plain.derivatives(t, 0)[0].truncate());
    Ok(Part {
        curve: plain.placed(task.placement(own, wanted, over)?),
        reversed: false,
    })
}
