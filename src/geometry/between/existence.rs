//! Whether any curve with monotone curvature can have two curvatures at its ends.

use glam::DVec2;

use super::ends::Task;
use super::error::BetweenError;

/// Refuse two curvatures that no curve with monotone curvature has at these ends, by Kneser's theorem and
/// by Vogt's. Where a curvature is free nothing is refused.
///
/// # Errors
/// [`BetweenError::NotNested`], [`BetweenError::OtherLean`].
pub(super) fn check_existence(task: &Task) -> Result<(), BetweenError> {
    if let [Some(first), Some(last)] = task.curvatures {
        check_nested(task, [first, last])?;
        check_lean(task, [first, last])?;
    }
    Ok(())
}

/// Refuse end curvatures that no curve with monotone curvature has (Kneser's theorem).
///
/// If both have the same sign, one circle of curvature lies inside the other. If the signs differ, the
/// circles lie apart.
fn check_nested(task: &Task, [first, last]: [f64; 2]) -> Result<(), BetweenError> {
    if first == 0.0 || last == 0.0 {
        return Ok(());
    }
    let radii = [first.recip(), last.recip()];
    let [start, end] = [-task.angles[0], task.angles[1]].map(DVec2::from_angle);
    let centres = [radii[0] * start.perp(), DVec2::X + radii[1] * end.perp()];
    let distance = centres[0].distance(centres[1]);
    let turns = first * last > 0.0;
    // With signed radii both are one comparison.
    let apart = (radii[0] - radii[1]).abs();
    if if turns {
        distance < apart
    } else {
        distance > apart
    } {
        return Ok(());
    }
    let size = task.chord();
    Err(BetweenError::NotNested {
        turns,
        distance: size * distance,
        radii: radii.map(|radius| size * radius.abs()),
    })
}

/// Refuse curvatures of which the stronger one is not where the angle to the chord is larger, by Vogt's
/// theorem: with angles a and b, below π, curvature κ > 0 that rises, and κ₀ where the direction is the
/// chord's,
///
///   (1 − cos a) / κ₀ < ∫ |sin θ| dθ / κ up to there = ∫ sin θ dθ / κ from there on < (1 − cos b) / κ₀.
fn check_lean(task: &Task, [first, last]: [f64; 2]) -> Result<(), BetweenError> {
    let leans = task.lean() != 0.0 && (first > last) == (task.lean() > 0.0);
    if !task.is_convex() || leans {
        return Ok(());
    }
    Err(BetweenError::OtherLean {
        angles: task.angles,
        curvatures: [first, last].map(|it| task.curvature(it)),
    })
}
