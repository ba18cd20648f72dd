//! Fair curves through given points.
//!
//! The points q₀ … q_m get parameters in proportion to the distances between them (chord length), over so many
//! segments that none holds two points. Of all float polygons whose curve passes the points there, the one with the
//! least Σ|Δ³ Pᵢ|² is taken.
//!
//! Where other parameters make a span slower than its neighbours, by a ratio r of the speeds, 0.3 (r² − 1) |Δ² Pᵢ|² is
//! added there: beside a short chord the curve would hook.

use glam::DVec3;

use super::jet_weights::JetWeights;
use super::objective::Objective;
use super::problem::Problem;
use crate::geometry::error::{MAX_DEGREE, PolygonError};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

/// The order of the differences; of two points, which a straight line joins, one less.
const ORDER: usize = 3;

/// The least weight of the vertices themselves: it keeps equations regular. Waves as long as ten segments weigh
/// a million times as much.
const LEAST_WEIGHT: f64 = 1e-9;

/// The most vertices, by points: short chords beside long ones ask for many.
const MOST_VERTICES: usize = 10;

/// The exponents of the distances that are tried: chord length, centripetal parameters, more even ones.
const EXPONENTS: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0];

/// The weight of second differences where speeds differ, and the ratio of speeds beyond which they weigh no more.
const TENSION: f64 = 0.3;
const MOST_RATIO: f64 = 1e3;

/// Speeds that differ by no more than this share are the same.
const EVEN: f64 = 1e-9;

/// What rounding may add to a number of segments.
const ROUNDING: f64 = 1e-9;

impl FloatPolygon {
    /// Find the fair curve of a degree n through some points, at least two, or three of a periodic one, in their order.
    ///
    /// An open curve begins and ends at the first and last point; the points are met to rounding. Where chord length
    /// asks for more than ten times as many vertices as points, the parameters go by square roots of the distances
    /// (centripetal), then by lower powers. Of degree 1 it is the polygon of the points themselves. Points of the plane
    /// z = 0 give a planar polygon.
    ///
    /// # Errors
    /// [`PolygonError::TooFewVertices`] for too few points; [`PolygonError::Overflow`] where the equations leave
    /// the range of numbers; otherwise as [`FloatPolygon::new`].
    pub fn through_points(
        degree: usize,
        points: &[DVec3],
        periodic: bool,
    ) -> Result<Self, PolygonError> {
        let least = if periodic { 3 } else { 2 };
        if degree == 1 || points.len() < least || !(1..=MAX_DEGREE).contains(&degree) {
            return Self::new(degree.min(MAX_DEGREE + 1), points.to_vec(), None, periodic);
        }
        let (places, segments) = places(degree, points, periodic);
        let count = if periodic {
            segments
        } else {
            segments + degree
        };
        let first = points[0];
        let begun = Self::new(degree, vec![first; count], None, periodic)?;
        let spread = Self::new(
            degree,
            along(points, &places, count, degree),
            None,
            periodic,
        )?;
        let planar = points.iter().all(|point| point.z == 0.0);
        let mut problem = Problem::new(&spread, planar, |_| true);
        problem.moved_from(begun.vertices());
        for (point, u) in points.iter().zip(&places) {
            problem.hold_point(JetWeights::at(&spread, *u).of_value(), *point);
        }
        problem.stiffen(tensions(points, &places, &spread));
        let least = Objective::Disturbance {
            order: if points.len() > 2 { ORDER } else { ORDER - 1 },
            fidelity: LEAST_WEIGHT,
            curve: [0.0; 2],
        };
        let found = problem.meet(least, spread.vertices(), 1);
        let overflow = PolygonError::Overflow {
            to: PolygonKind::Float,
            index: 0,
        };
        let found = found.ok_or(overflow)?;
        problem.polygon(&found.vertices)
    }
}

/// The weights of second differences, by their first vertices; none where all speeds are the same.
fn tensions(points: &[DVec3], places: &[f64], polygon: &FloatPolygon) -> Vec<f64> {
    let (periodic, last) = (polygon.is_periodic(), polygon.segments() as f64);
    let ends = places.iter().copied().chain(periodic.then_some(last));
    let ends: Vec<f64> = ends.collect();
    let speeds = ends.windows(2).enumerate().map(|(span, ends)| {
        let chord = points[span].distance(points[(span + 1) % points.len()]);
        chord / (ends[1] - ends[0])
    });
    let speeds: Vec<f64> = speeds.collect();
    let count = speeds.len();
    let beside = |span: usize| match periodic {
        true => [(span + count - 1) % count, (span + 1) % count],
        false => [span.saturating_sub(1), (span + 1).min(count - 1)],
    };
    let tension = |span: usize| {
        let [before, behind] = beside(span).map(|it| speeds[it] / speeds[span]);
        let ratio = before.max(behind).min(MOST_RATIO);
        match ratio > 1.0 + EVEN {
            true => TENSION * (ratio * ratio - 1.0),
            false => 0.0,
        }
    };
    let tensions: Vec<f64> = (0..count).map(tension).collect();
    if tensions.iter().all(|tension| *tension == 0.0) {
        return Vec::new();
    }
    let vertices = polygon.vertices().len();
    let windows = if periodic { vertices } else { vertices - 2 };
    let of_window = |first: usize| {
        // The influence of the middle vertex is largest there.
        let u = (first + 1) as f64 - 0.5 * (polygon.degree() as f64 - 1.0);
        let u = if periodic { u.rem_euclid(last) } else { u };
        let span = ends.partition_point(|end| *end <= u).clamp(1, count) - 1;
        tensions[span]
    };
    (0..windows).map(of_window).collect()
}

/// The parameters of the points, and the number of segments.
fn places(degree: usize, points: &[DVec3], periodic: bool) -> (Vec<f64>, usize) {
    let tail = if periodic { 0 } else { degree };
    let most = (MOST_VERTICES * points.len()).saturating_sub(tail) as f64;
    let closing = points.last().zip(points.first()).filter(|_| periodic);
    let chords = points.windows(2).map(|pair| (&pair[0], &pair[1]));
    let chords: Vec<f64> = chords.chain(closing).map(|(a, b)| a.distance(*b)).collect();
    let powers = EXPONENTS.map(|exponent| Powers::new(&chords, exponent));
    let [.., even] = &powers;
    let chosen = powers
        .iter()
        .find(|it| it.segments() <= most)
        .unwrap_or(even);
    let fewest = if periodic { degree + 1 } else { 1 };
    let segments = (chosen.segments() as usize).max(fewest);
    let ends = chosen.ends.iter().map(|end| segments as f64 * end);
    let mut places: Vec<f64> = [0.0].into_iter().chain(ends).collect();
    places.truncate(points.len());
    (places, segments)
}

/// Powers of distances, added up.
struct Powers {
    /// The share of the sum behind each distance.
    ends: Vec<f64>,
    /// The least share of one.
    least: f64,
}

impl Powers {
    fn new(chords: &[f64], exponent: f64) -> Self {
        let powers = chords.iter().map(|chord| chord.powf(exponent));
        let powers: Vec<f64> = powers.collect();
        let least = powers.iter().copied().fold(f64::INFINITY, f64::min);
        let mut sum = 0.0;
        let mut ends: Vec<f64> = Vec::new();
        for power in powers {
            sum += power;
            ends.push(sum);
        }
        ends.iter_mut().for_each(|end| *end /= sum);
        Self {
            ends,
            least: least / sum,
        }
    }

    /// The number of segments of which none holds two points.
    fn segments(&self) -> f64 {
        (self.least.recip() - ROUNDING).ceil()
    }
}

/// Vertices on the polyline of the points, each where its influence is largest.
fn along(points: &[DVec3], places: &[f64], count: usize, degree: usize) -> Vec<DVec3> {
    let vertex = |index: usize| {
        let u = index as f64 - 0.5 * (degree as f64 - 1.0);
        let next = places.partition_point(|place| *place <= u);
        let next = next.clamp(1, points.len() - 1);
        let [from, to] = [places[next - 1], places[next]];
        points[next - 1].lerp(points[next], (u - from) / (to - from))
    };
    (0..count).map(vertex).collect()
}
