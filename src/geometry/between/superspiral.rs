//! Superspiral segments, up to a similarity (Ziatdinov, "Family of superspirals with completely
//! monotonic curvature given in terms of Gauss hypergeometric function", 2012).
//!
//! For a > 0 and c > b > 0 the radius of curvature ₂F₁(a, b; c; −ψ) falls ever more slowly as the direction
//! angle ψ rises from −1. A segment that turns by θ leans the less the later it begins, so bisection
//! finds its start.

use glam::DVec2;

use super::ends::{Task, angle};
use super::error::BetweenError;
use super::parts::{Part, Parts};
use super::solving::{CHORD, check_curvatures, inflection, out_of_reach};
use crate::geometry::differentiable::Differentiable;
use crate::geometry::references::{AnalyticForm, ReferenceCurve, ReferenceForm, superspiral};
use crate::geometry::root::root;

/// Where a segment may begin, the direction angle of the spiral: earlier it has hardly a finite radius, later
/// it is all but a circular arc.
const BEGINS: [f64; 2] = [-0.9, 60.0];

/// Precision of the start; correcting the ends does the rest.
const EXACT: f64 = 1e-14;

/// Find the superspiral segment. Where the curvature must fall the spiral, whose curvature rises, is
/// passed through from its end to its start, and turned over, so that it bends as before.
pub(super) fn superspiral_parts(task: &Task, values: [f64; 3]) -> Result<Parts, BetweenError> {
    let [a, b, c] = values;
    if !(a > 0.0 && b > 0.0 && c > b) {
        return Err(BetweenError::NotMonotone { values });
    }
    let kind = format!("the superspiral {a}, {b}, {c}");
    if !task.is_convex() {
        return Err(inflection(task, kind));
    }
    let form = AnalyticForm::new(&superspiral::KIND, values.to_vec())?;
    let spiral = ReferenceCurve::of(ReferenceForm::Analytic(form))?;
    let point = |angle: f64| spiral.derivatives(angle, 0)[0].truncate();
    let turning = task.turning();
    // How far the chord leans from the direction half way towards that at the start.
    let leans = |begin: f64| {
        let half_way = DVec2::from_angle(begin + 0.5 * turning);
        angle(point(begin + turning) - point(begin), half_way)
    };
    let (lean, reversed) = (task.lean().abs(), task.lean() > 0.0);
    let [most, least] = BEGINS.map(leans);
    if !(least <= lean && lean <= most) {
        let side = if reversed { 1.0 } else { -1.0 };
        let mut reach = [least, most].map(|lean| 0.5 * turning + side * lean);
        reach.sort_by(f64::total_cmp);
        return Err(out_of_reach(task, kind, reach));
    }
    let begin = root(BEGINS, EXACT, |begin| leans(begin) - lean);
    let interval = [begin, begin + turning];
    let mut own = interval.map(point);
    if reversed {
        own.reverse();
    }
    let placement = task.placement(own, CHORD, reversed)?;
    let curve = spiral.over(interval)?.placed(placement);
    let parts = Parts::new(vec![Part { curve, reversed }]);
    check_curvatures(task, [0.0, parts.end].map(|t| parts.curvature(t)))?;
    Ok(parts)
}
