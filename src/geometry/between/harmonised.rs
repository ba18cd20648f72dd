//! Any segment with monotone curvature: a simple polygon with exact ends, harmonised.

use std::f64::consts::PI;

use glam::DVec3;

use super::ends::{Ends, Task};
use super::error::BetweenError;
use super::existence::check_existence;
use super::polygon::{Fit, exact_ends, fit, monotony, quasi};
use super::solving::log_aesthetic_parts;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::fairing::harmonising::{
    Harmonised, Harmony, HarmonyError, Held, least_change,
};
use crate::geometry::features::Verdict;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// The length that derivatives at the ends have at most, in chords.
const LONGEST: f64 = 3.0;

/// The numbers of segments that are tried.
const COUNTS: [usize; 3] = [16, 24, 40];

/// The share of the time that is left for each of them.
const SHARE: f64 = 0.3;

/// The α of the log-aesthetic segments that are tried where harmonising does not do: that of the curvatures
/// or the clothoid's, with pairs and chains of them, then those of spirals.
const ALPHAS: [Option<f64>; 4] = [None, Some(1.0), Some(0.0), Some(2.0)];

/// Find a polygon with exact ends and monotone curvature, without an inflection unless the ends ask
/// for one. Where harmonising finds none, one that follows a log-aesthetic segment does, if there is one;
/// without one, that which comes closest. `tolerance` tells how near it is by the segment's length.
pub(super) fn monotone(
    task: &Task,
    ends: &Ends,
    degree: usize,
    tolerance: &dyn Fn(f64) -> f64,
    progress: &Progress,
) -> Result<Fit, BetweenError> {
    check_existence(task)?;
    let own = best_harmonised(task, ends, degree, progress);
    if let Ok((fit, true)) = own {
        return Ok(fit);
    }
    for alpha in ALPHAS {
        if progress.is_cancelled() {
            break;
        }
        let parts = log_aesthetic_parts(task, alpha);
        let found =
            parts.and_then(|parts| fit(&parts, ends, degree, tolerance(parts.length()), progress));
        match found {
            // It is a monotone curve of its own, whatever it is near to.
            Ok(found) if found.monotone == Verdict::Proved => {
                return Ok(Fit {
                    deviation: 0.0,
                    ..found
                });
            }
            _ => {}
        }
    }
    if progress.is_cancelled() && (own.is_err() || !progress.is_late()) {
        return Err(BetweenError::Cancelled);
    }
    own.map(|(fit, _)| fit)
}

/// Find the harmonised polygon that has monotone curvature and its ends, or the first one; tell which.
fn best_harmonised(
    task: &Task,
    ends: &Ends,
    degree: usize,
    progress: &Progress,
) -> Result<(Fit, bool), BetweenError> {
    let mut best: Option<Fit> = None;
    for count in COUNTS {
        if progress.is_cancelled() {
            break;
        }
        let begun = quasi(&Cubic::between(task, ends), 1.0, degree, count)?;
        let begun = exact_ends(&begun, ends, progress)?;
        let found = match harmonised(&begun, task, ends, &progress.hurried(SHARE)) {
            Err(BetweenError::Cancelled) => continue,
            found => found?,
        };
        let fit = Fit {
            monotone: monotony(&found.polygon, progress),
            polygon: found.polygon,
            deviation: 0.0,
        };
        if found.reached {
            return Ok((fit, true));
        }
        best.get_or_insert(fit);
    }
    let best = best.ok_or(BetweenError::Cancelled)?;
    Ok((best, false))
}

/// Harmonise a polygon so that no extrema of the curvature are left, and an inflection only where
/// the ends ask for one; the ends keep their requested values.
fn harmonised(
    polygon: &FloatPolygon,
    task: &Task,
    ends: &Ends,
    progress: &Progress,
) -> Result<Harmonised, BetweenError> {
    let held = ends.curvatures.map(|it| match it {
        Some(_) => Held::Curvature,
        None => Held::Direction,
    });
    let harmony = Harmony {
        stretch: None,
        ends: held,
        locked: &[],
        extrema: Some(0),
        inflections: Some(usize::from(!task.is_convex())),
        torsion_extrema: None,
        largest_deviation: None,
        symmetry: None,
    };
    least_change(polygon, &harmony, progress).map_err(|error| match error {
        HarmonyError::Cancelled => BetweenError::Cancelled,
        error => error.into(),
    })
}

/// A cubic that has the points and directions of two ends: its coefficients by the powers of t.
struct Cubic([DVec3; 4]);

impl Cubic {
    /// Where the directions make a triangle with the chord it is the parabola in it, unless its sides
    /// are long.
    fn between(task: &Task, ends: &Ends) -> Self {
        let [from, to] = ends.points;
        let chord = to - from;
        let sides = task.angles.map(|angle| angle.sin() / task.turning().sin());
        let [before, behind] = if task.is_convex() && task.turning() < PI {
            [sides[1], sides[0]].map(|side| (2.0 * side).min(LONGEST))
        } else {
            [1.0; 2]
        };
        let along = |index: usize, length: f64| {
            length * chord.length() * ends.directions[index].normalize_or_zero()
        };
        let (first, last) = (along(0, before), along(1, behind));
        let (square, cube) = (3.0 * chord - 2.0 * first - last, first + last - 2.0 * chord);
        Self([from, first, square, cube].map(|it| it.extend(0.0)))
    }
}

impl Differentiable for Cubic {
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        let Self([point, first, square, cube]) = *self;
        let mut values = vec![
            point + t * (first + t * (square + t * cube)),
            first + t * (2.0 * square + 3.0 * t * cube),
            2.0 * square + 6.0 * t * cube,
            6.0 * cube,
        ];
        values.resize(order + 1, DVec3::ZERO);
        values
    }
}
