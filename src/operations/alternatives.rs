//! What else reaches a tolerance, where an approximation does not, or by very many vertices.

use std::cell::Cell;

use crate::geometry::approximation::{
    Approximated, ApproximationRequest, Goal, MOST_FOR_SHAPE, approximate_to_tolerance,
};
use crate::geometry::{Differentiable, MAX_DEGREE, Progress, significant};

/// By how much the degree is raised at most.
const DEGREES: usize = 4;

/// More segments than this are many, and an alternative has no more.
const MANY: usize = 256;

/// Say what a tolerance fails by, or that it takes many vertices, and which fewer levels or higher degree reach
/// it with up to 256 segments. Both are tried: from the most levels down, from the lowest degree up. `None` where
/// the tolerance is reached by so many segments already, or nothing better is found.
pub(super) fn remark_on_alternatives(
    curve: &dyn Differentiable,
    interval: [f64; 2],
    goal: &Goal,
    asked: &ApproximationRequest,
    found: &Approximated,
    progress: &Progress,
) -> Option<String> {
    let is_reached = found.meets(goal.tolerance);
    if progress.is_cancelled() || (is_reached && found.polygon.segments() <= MANY) {
        return None;
    }
    let goal = Goal {
        most_segments: MANY,
        ..*goal
    };
    let degrees = asked.degree + 1..=(asked.degree + DEGREES).min(MAX_DEGREE);
    let tries = (asked.levels + degrees.clone().count()) as f64;
    let tried = Cell::new(0.0);
    let reaching = |asked: ApproximationRequest, what: String| {
        let from = tried.replace(tried.get() + 1.0) / tries;
        let progress = progress.part(from, tried.get() / tries);
        let found = approximate_to_tolerance(curve, interval, &goal, &asked, &progress).ok()?;
        let count = found.polygon.vertices().len();
        let reaches = format!("{what} reaches the tolerance with {count} vertices");
        found.meets(goal.tolerance).then_some(reaches)
    };
    let difference = found.first_difference();
    // Where the place alone fails, fewer levels are no help.
    let levels = match (difference, found.distance() <= goal.tolerance) {
        (_, false) => 0,
        (Some(difference), true) => difference.level,
        (None, true) => asked.levels,
    };
    let fewer = (0..levels).rev();
    let mut fewer = fewer.filter_map(|levels| {
        reaching(
            ApproximationRequest { levels, ..*asked },
            format!("levels {levels}"),
        )
    });
    let mut higher = degrees.filter_map(|degree| {
        reaching(
            ApproximationRequest { degree, ..*asked },
            format!("degree {degree}"),
        )
    });
    let enough: Vec<String> = fewer.next().into_iter().chain(higher.next()).collect();
    let (degree, segments) = (asked.degree, found.polygon.segments());
    let problem = match difference {
        _ if is_reached => format!("{segments} segments are many"),
        Some(level) if found.distance() <= goal.tolerance => format!(
            "{} has other features than the reference with up to {MOST_FOR_SHAPE} segments of degree {degree}",
            level.name()
        ),
        _ => format!(
            "The nearest of degree {degree} is off by {}",
            significant(found.distance(), 3)
        ),
    };
    match (is_reached, enough.is_empty()) {
        // Not all was tried.
        (_, true) if progress.is_cancelled() => (!is_reached).then_some(problem),
        (_, false) => Some(format!("{problem}: {}", enough.join(", "))),
        (true, true) => None,
        (false, true) => Some(format!(
            "{problem}: try a still higher degree, a larger tolerance, or a part of the reference"
        )),
    }
}
