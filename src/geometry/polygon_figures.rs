//! Figures of a polygon itself: legs, turning angles, discrete curvature.

use std::f64::consts::PI;

use glam::DVec3;

use super::end_correction::angle_between;
use super::float_polygon::FloatPolygon;
use super::jet::Jet;
use super::vector;

/// The smallest and the largest of some values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest.
    pub low: f64,
    /// The largest.
    pub high: f64,
}

impl Range {
    /// Find the smallest and largest of `values`, or `None` if there are none that compare.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let numbers = values.into_iter().filter(|value| !value.is_nan());
        numbers.fold(None, |range: Option<Self>, value| {
            Some(range.map_or(Self::at(value), |range| range.with(value)))
        })
    }

    /// The range that holds one value.
    pub fn at(value: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    /// The range widened to hold `value` too.
    pub fn with(self, value: f64) -> Self {
        Self {
            low: self.low.min(value),
            high: self.high.max(value),
        }
    }

    /// The largest magnitude in it: max(|low|, |high|).
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The range that holds both.
    pub fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }
}

/// A polygon that turns by more than this at a vertex, in radians, folds: nobody could drag it there.
pub const FOLD: f64 = 2.0 * PI / 3.0;

/// Measure the angle by which a polygon turns at `corner`, in radians: of a `planar` polygon, in the plane z = 0, left
/// turns are positive; of one in space all angles are, also where it has three vertices in that plane. A leg of length 0
/// turns by 0.
pub fn turning_angle(before: DVec3, corner: DVec3, after: DVec3, planar: bool) -> f64 {
    let angle = angle_between(corner - before, after - corner);
    if planar { angle } else { angle.abs() }
}

/// Measure the angles by which a float polygon turns, without their signs, with the vertices where it does.
pub fn turning_angles(polygon: &FloatPolygon) -> impl Iterator<Item = (usize, f64)> + '_ {
    let vertices = polygon.vertices();
    let count = vertices.len();
    let turns = match polygon.is_periodic() {
        true => count,
        false => count.saturating_sub(2),
    };
    (0..turns).map(move |first| {
        let [before, corner, after] = [0, 1, 2].map(|it| (first + it) % count);
        let [before, at, after] = [before, corner, after].map(|it| vertices[it]);
        (corner, turning_angle(before, at, after, false))
    })
}

/// Find the vertex where a float polygon turns most, and the angle without its sign; `None` without any turn.
pub fn sharpest_turn(polygon: &FloatPolygon) -> Option<(usize, f64)> {
    turning_angles(polygon).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Compute the discrete curvature of a polygon at `corner` (paper, section 3): D₁ × D₂ / |D₁|³
/// with the central differences D₁ = (after − before)/2 and D₂ = before − 2 corner + after.
/// Signed of a `planar` polygon, in the plane z = 0; not a number where `before` and `after` coincide.
pub fn discrete_curvature(before: DVec3, corner: DVec3, after: DVec3, planar: bool) -> f64 {
    let differences = Jet {
        first: 0.5 * (after - before),
        second: before - 2.0 * corner + after,
        ..Jet::default()
    };
    differences.curvature_of(planar)
}

/// Measure the angle by which a polygon in space leaves its plane along the leg from `start` to
/// `end`, in radians: from the osculating plane of its three vertices `before`, `start`, `end` to
/// that of `start`, `end`, `after`. Positive where the torsion is, as on a right-handed helix. 0
/// where a corner is straight or a leg has no length.
pub fn torsion_angle(before: DVec3, start: DVec3, end: DVec3, after: DVec3) -> f64 {
    let [entering, leg, leaving] =
        [start - before, end - start, after - end].map(|leg| vector::scaled(leg).0);
    let (first, second) = (entering.cross(leg), leg.cross(leaving));
    if first == DVec3::ZERO || second == DVec3::ZERO {
        return 0.0;
    }
    (leg.length() * entering.dot(second)).atan2(first.dot(second))
}

/// Compute the discrete torsion of a polygon at the leg from `start` to `end`, from the central
/// differences about its middle: (D₁ × D₂) · D₃ / |D₁ × D₂|² with D₁ = end − start,
/// D₂ = (before − start − end + after)/2 and D₃ = after − 3 end + 3 start − before. Not a number
/// where D₁ and D₂ are parallel.
pub fn discrete_torsion(before: DVec3, start: DVec3, end: DVec3, after: DVec3) -> f64 {
    let [entering, leg, leaving] = [start - before, end - start, after - end];
    let differences = Jet {
        first: leg,
        second: 0.5 * (leaving - entering),
        third: leaving - 2.0 * leg + entering,
        ..Jet::default()
    };
    differences.torsion()
}

impl FloatPolygon {
    /// Compute the parameter that belongs to vertex i, its Greville abscissa i − (n − 1)/2: the
    /// mean of its knots. It may lie outside \[0, L\].
    pub fn greville(&self, index: usize) -> f64 {
        index as f64 - 0.5 * (self.degree() as f64 - 1.0)
    }

    /// Compute the parameter that belongs to vertex i of the clamped polygon: the mean of its knots, which are those of
    /// this one within \[0, L\].
    pub fn clamped_greville(&self, index: usize) -> f64 {
        let (degree, last) = (self.degree(), self.segments() as f64);
        let knot = |after: usize| (index as f64 + after as f64 - degree as f64).clamp(0.0, last);
        (1..=degree).map(knot).sum::<f64>() / degree as f64
    }
}
