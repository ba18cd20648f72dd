//! Conditions on the signs of curvature and slope, and at the ends.

use glam::DVec2;

use super::banded_rows::Rows;
use super::problem::{EndValue, PlacedCurve, Problem, Start};
use super::splines::Splines;
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::end::End;

/// The least slope, by the turn of a segment, and what is asked for where nothing turns.
const MARGIN: f64 = 1e-4;
const LEAST_MARGIN: f64 = 1e-9;

/// The least turn of a segment where its sign is asked for.
const BEND_MARGIN: f64 = 1e-7;

/// The bend of an end that must have a curvature is not told by its sign too: it may be negative by so much.
const FREE_BEND: f64 = -1.0;

/// The turn of a segment, in radians, at an end without curvature: rounding must not make an inflection there.
const STRAIGHT_TURN: f64 = 1e-12;

/// How far inside, in segments, the sign of the turn is looked up.
const BESIDE: f64 = 0.25;

/// The share of its margin from which on a condition is met.
const MET: f64 = 0.5;

/// By how much of the limit a point is to be nearer than that, so that rounding does not matter.
const LIMIT_MARGIN: f64 = 1e-3;

/// Conditions: values that must not be negative.
pub(super) struct Conditions {
    pub(super) values: Vec<f64>,
    /// The gradients, where they are asked for.
    pub(super) rows: Rows,
    /// By how much each value may be negative.
    allowed: Vec<f64>,
    /// How many of them, the first ones, are on the slope, and on slope and curvature together.
    pub(super) slopes: usize,
    pub(super) shapes: usize,
}

impl Conditions {
    /// Evaluate the conditions on the members that a start tells the signs of and, with a limit, on the distances
    /// of the points.
    pub(super) fn new(
        problem: &Problem,
        start: &Start,
        limit: Option<f64>,
        with_gradients: bool,
    ) -> Self {
        let splines = &problem.splines;
        let vertices = &start.curve.vertices;
        let mut conditions = Self {
            values: Vec::new(),
            rows: Rows::new(splines.degree + 1),
            allowed: Vec::new(),
            slopes: problem.slope_places.len(),
            shapes: 0,
        };
        let signs = start.slopes.signs(problem.slope_places.len());
        let segments = 0..splines.segments();
        let segments = segments.map(|it| {
            problem
                .tables
                .on_segment(splines, vertices, it, with_gradients)
        });
        let segments: Vec<_> = segments.collect();
        let mut signs = signs.into_iter();
        for (segment, found) in segments.iter().enumerate() {
            let shared = usize::from(problem.shares_slopes(segment));
            let margin = MARGIN * found.turn + LEAST_MARGIN;
            for (index, value) in found.slopes.iter().enumerate().skip(shared) {
                let sign = signs.next().unwrap_or(1.0);
                let gradient = found.slope_gradients.get(index);
                // In the middle a curve that is its own mirror image has none.
                let is_middle = 2 * conditions.values.len() + 1 == conditions.slopes;
                let margin = match problem.data.mirror {
                    Some(_) if is_middle => -LEAST_MARGIN,
                    _ => margin,
                };
                conditions.push(segment, sign, *value, gradient, margin);
            }
        }
        if let Some(bends) = &start.bends {
            let mut signs = bends
                .signs(problem.tables.bends() * segments.len())
                .into_iter();
            for (segment, found) in segments.iter().enumerate() {
                for (index, value) in found.bends.iter().enumerate() {
                    let sign = signs.next().unwrap_or(1.0);
                    let gradient = found.bend_gradients.get(index);
                    let ends = [(0, 0), (segments.len() - 1, found.bends.len() - 1)];
                    let mut known = End::BOTH.into_iter().zip(ends);
                    let is_known = known
                        .any(|(end, member)| member == (segment, index) && problem.bends_at(end));
                    let margin = if is_known { FREE_BEND } else { BEND_MARGIN };
                    conditions.push(segment, sign, *value, gradient, margin);
                }
            }
        }
        conditions.shapes = conditions.values.len();
        if let Some(limit) = limit {
            conditions.push_distances(problem, &start.curve, limit, with_gradients);
        }
        conditions
    }

    /// Add for each point that counts what its distance leaves of the limit, as a share of that. Of a curve that is
    /// its own mirror image the images of the points count too, so that steps are symmetric.
    fn push_distances(
        &mut self,
        problem: &Problem,
        curve: &PlacedCurve,
        limit: f64,
        with_gradients: bool,
    ) {
        let (splines, data) = (&problem.splines, &problem.data);
        let points = data.points.iter().zip(&curve.places).zip(data.counts);
        let points = points.filter(|(_, counts)| **counts);
        for ((point, place), _) in points {
            let image = data.mirror.map(|mirror| {
                let place = splines.end() - place;
                (mirror.image(*point), place)
            });
            for (point, place) in [Some((*point, *place)), image].into_iter().flatten() {
                let off = splines.point(&curve.vertices, place) - point;
                let (segment, basis) = splines.basis(place);
                let across = -off.normalize_or_zero() / limit;
                let weights = basis.iter().take(splines.degree + 1);
                let gradient = weights.flat_map(|weight| (*weight * across).to_array());
                let gradient = with_gradients.then(|| gradient.collect());
                let value = 1.0 - off.length() / limit;
                self.push(segment, 1.0, value, gradient.as_ref(), LIMIT_MARGIN);
            }
        }
    }

    fn push(
        &mut self,
        segment: usize,
        sign: f64,
        value: f64,
        gradient: Option<&Vec<f64>>,
        margin: f64,
    ) {
        self.values.push(sign * value - margin);
        self.allowed.push((1.0 - MET) * margin);
        if let Some(gradient) = gradient {
            self.rows.push(segment, gradient.iter().map(|it| sign * it));
        }
    }

    /// Whether all are met.
    pub(super) fn hold(&self) -> bool {
        let mut pairs = self.values.iter().zip(&self.allowed);
        pairs.all(|(value, allowed)| value + allowed >= 0.0)
    }
}

/// The equations E y = e of the conditions at the ends and of held vertices, for moves of vertices in units of
/// `scales`.
///
/// A point's rows tell shares of a leg, those of a direction radians, those of a curvature turns a segment.
pub(super) fn equations(
    problem: &Problem,
    vertices: &[DVec2],
    scales: &[f64],
) -> Vec<(Vec<f64>, f64)> {
    let splines = &problem.splines;
    let mut equations = Vec::new();
    for condition in problem.data.ends {
        let u = match condition.end {
            End::Start => 0.0,
            End::Finish => splines.end(),
        };
        let [at, first, second] = splines.jet(vertices, u);
        let (segment, t) = splines.locate(u);
        let basis =
            |order: usize| -> Vec<f64> { uniform_basis_derivative(splines.degree, order, t) };
        let mut add = |right: f64, entry: &dyn Fn(usize) -> DVec2| {
            let mut row = vec![0.0; problem.layout.unknowns()];
            for k in 0..=splines.degree {
                let unknown = problem.layout.unknown(segment + k);
                let gradient = scales[segment + k] * entry(k);
                row[unknown] += gradient.x;
                row[unknown + 1] += gradient.y;
            }
            equations.push((row, right));
        };
        match condition.value {
            EndValue::Point(point) => {
                let weights = basis(0);
                let unit = scales[segment].recip();
                let missing = unit * (point - at);
                add(missing.x, &|k| unit * weights[k] * DVec2::X);
                add(missing.y, &|k| unit * weights[k] * DVec2::Y);
            }
            EndValue::Direction(direction) => {
                let weights = basis(1);
                let unit = first.length().max(f64::MIN_POSITIVE).recip();
                let across = unit * direction.perp();
                add(-across.dot(first), &|k| weights[k] * across);
            }
            EndValue::Curvature(curvature) => {
                let [firsts, seconds] = [1, 2].map(basis);
                let square = first.length_squared().max(f64::MIN_POSITIVE);
                let speed = square.sqrt();
                let turn = first.perp_dot(second) / square;
                let wanted = match curvature == 0.0 {
                    true => STRAIGHT_TURN.copysign(turn_beside(splines, vertices, condition.end)),
                    false => curvature * speed,
                };
                add(wanted - turn, &|k| {
                    let by_first =
                        -second.perp() / square - (2.0 * turn / square + curvature / speed) * first;
                    firsts[k] * by_first + seconds[k] * first.perp() / square
                });
            }
        }
    }
    for held in problem.data.held {
        let missing = (held.point - vertices[held.vertex]) / scales[held.vertex];
        for (axis, right) in missing.to_array().into_iter().enumerate() {
            let mut row = vec![0.0; problem.layout.unknowns()];
            row[problem.layout.unknown(held.vertex) + axis] = 1.0;
            equations.push((row, right));
        }
    }
    equations
}

/// By how much a curve turns beside an end.
fn turn_beside(splines: &Splines, vertices: &[DVec2], end: End) -> f64 {
    let inside = match end {
        End::Start => BESIDE,
        End::Finish => splines.end() - BESIDE,
    };
    let [_, first, second] = splines.jet(vertices, inside);
    first.perp_dot(second)
}
