//! Sequential quadratic programming: the nearest curve whose curvature rises and falls as asked.

use glam::DVec2;

use super::banded_rows::{BandMatrix, Rows};
use super::conditions::{self, Conditions};
use super::interior_point::{QuadraticProgram, Solution};
use super::problem::{LEG_REACH, PlacedCurve, Problem, Start};
use crate::geometry::progress::Progress;

/// The weight of second differences of the logarithms of legs, by points a vertex.
const LEGS: f64 = 1e-3;

/// The weight of those of the outer legs and of their directions: few points tell how a curve ends. So many differences
/// more than the degree are outer ones, and the middle one never is.
const OUTER_LEGS: f64 = 1.0;
const OUTER: usize = 3;

/// The share of a point's offset along the curve that damps steps.
const TANGENT: f64 = 0.03;

/// The price of what violates a condition, by points, and how much it may grow.
const PRICE: f64 = 30.0;
const DEARER: f64 = 5.0;
const MOST_DEAR: f64 = 1e7;

/// The first, the least and the most damping, by the mean diagonal.
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-9;
const MOST_DAMPING: f64 = 1e3;

/// The longest move of a vertex, and the longest of a restoration, in legs.
const LONGEST: f64 = 0.5;
const LONGEST_RESTORED: f64 = 0.1;

/// The factor between the lengths that are tried along a step, and how many are.
const SHORTER: f64 = 0.3;
const LENGTHS: usize = 3;

/// How often damping grows for one step, and how many steps restore the conditions.
const DAMPINGS: usize = 8;
const RESTORATIONS: usize = 8;
const RESTORING_PRICE: f64 = 1e3;

/// A smaller relative gain is none, twice in a row ends the descent.
const SETTLED: f64 = 2e-3;
const CALM: usize = 2;

/// What a step must gain of the merit at least, against rounding.
const ROUNDING: f64 = 1e-10;

/// What ends may miss, in the units of their equations, and how near the last steps come.
const END_TOLERANCE: f64 = 1e-10;
const END_GOAL: f64 = 1e-13;

/// Rows shorter than this, and legs below this share of the mean one, count as so long.
const LEAST_ROW: f64 = 1e-9;
const LEAST_LEG: f64 = 1e-9;

/// The unit of distances is no less than this share of the mean leg, and renewed when the root mean square
/// leaves this range of it.
const LEAST_UNIT: f64 = 1e-9;
const RENEWED: [f64; 2] = [0.7, 1.5];

/// What a descent found.
pub(super) struct Descended {
    pub(super) start: Start,
    /// Whether all conditions hold.
    pub(super) holds: bool,
    /// How strongly each member of the slope presses.
    pub(super) press: Vec<f64>,
}

/// Step down from a start, at most so many steps, to where no point is farther than the limit.
///
/// Minimises ½ Σ w (offset across the curve)² / σ² with legs that go on evenly, σ the root mean square, under
/// the signs of the start, whose cuts slide to where less presses. A solution's signs are its proof. A limit that
/// cannot be kept does not count in the end: points beyond it are as near as its price makes them.
pub(super) fn descend(
    problem: &Problem,
    start: Start,
    limit: Option<f64>,
    steps: usize,
    progress: &Progress,
) -> Descended {
    let descent = Descent {
        problem,
        limit,
        sum: problem.data.weights.iter().sum(),
    };
    descent.run(start, steps, progress)
}

struct Descent<'a> {
    problem: &'a Problem<'a>,
    /// The largest distance of a point.
    limit: Option<f64>,
    /// The sum of the weights.
    sum: f64,
}

/// A curve with what its merit consists of.
struct Measured {
    start: Start,
    conditions: Conditions,
    /// The objective.
    value: f64,
}

/// How unevenly three legs go on, times the root of its weight.
struct LegBend {
    /// The first of the four vertices.
    first: usize,
    value: f64,
    gradient: [DVec2; LEG_REACH],
}

/// What one quadratic program is made of, but for its damping.
struct Model {
    scales: Vec<f64>,
    matrix: BandMatrix,
    gradient: Vec<f64>,
    /// The conditions' rows, each of length 1, and by what they were divided.
    rows: Rows,
    norms: Vec<f64>,
    values: Vec<f64>,
    equations: Vec<(Vec<f64>, f64)>,
}

/// A step that was taken.
struct Taken {
    measured: Measured,
    merit: f64,
    /// The share of the step that was gone.
    length: f64,
    /// The largest move, in legs.
    largest: f64,
    /// What the program itself left of violations.
    left: f64,
    multipliers: Vec<f64>,
    damping: f64,
}

impl Descent<'_> {
    fn run(&self, start: Start, steps: usize, progress: &Progress) -> Descended {
        let mut price = PRICE * self.sum;
        let mut damping = FIRST_DAMPING;
        let mut unit = self.unit(&start.curve);
        let mut now = self.measured(start, unit, true);
        let mut press = vec![0.0; now.conditions.values.len()];
        let mut calm = 0;
        for _ in 0..steps {
            if progress.is_cancelled() {
                break;
            }
            let rms = self.unit(&now.start.curve);
            if rms < RENEWED[0] * unit || rms > RENEWED[1] * unit {
                unit = rms;
                now.value = self.value(&now.start.curve, unit);
            }
            let model = self.model(&now, unit);
            let merit = model.merit(now.value, &model.values, price);
            let Some(taken) = self.step(&now, &model, unit, price, damping, merit) else {
                break;
            };
            let gain = (merit - taken.merit) / now.value.abs().max(f64::MIN_POSITIVE);
            damping = (taken.damping * damping_factor(taken.length)).max(LEAST_DAMPING);
            if taken.left > 1e-7 && taken.largest < 0.3 {
                price = (price * DEARER).min(MOST_DEAR * self.sum);
            }
            press = taken.multipliers;
            now = taken.measured;
            let shapes = &press[..now.conditions.shapes];
            let slid = self.slide(&mut now.start, shapes, now.conditions.slopes);
            now.conditions = self.conditions(&now.start, true);
            let settled = gain < SETTLED && !slid && now.conditions.hold();
            calm = if settled { calm + 1 } else { 0 };
            if calm >= CALM {
                break;
            }
        }
        if self.limit.is_some() {
            now.conditions = Conditions::new(self.problem, &now.start, None, true);
        }
        let holds = self.restore(&mut now);
        press.truncate(now.conditions.slopes);
        Descended {
            start: now.start,
            holds,
            press,
        }
    }

    fn unit(&self, curve: &PlacedCurve) -> f64 {
        let legs = self.legs(&curve.vertices);
        let mean = legs.iter().sum::<f64>() / legs.len().max(1) as f64;
        let [rms, _] = self.problem.errors(curve);
        rms.max(LEAST_UNIT * mean).max(f64::MIN_POSITIVE)
    }

    fn measured(&self, start: Start, unit: f64, with_gradients: bool) -> Measured {
        Measured {
            conditions: self.conditions(&start, with_gradients),
            value: self.value(&start.curve, unit),
            start,
        }
    }

    fn conditions(&self, start: &Start, with_gradients: bool) -> Conditions {
        Conditions::new(self.problem, start, self.limit, with_gradients)
    }

    fn value(&self, curve: &PlacedCurve, unit: f64) -> f64 {
        let offsets = self.problem.offsets(curve);
        let weighed = offsets.iter().zip(self.problem.data.weights);
        let near: f64 = weighed
            .map(|(offset, weight)| weight * offset.length_squared())
            .sum();
        let bends = self.leg_bends(&curve.vertices);
        let even: f64 = bends.iter().map(|it| it.value * it.value).sum();
        0.5 * near / (unit * unit) + 0.5 * even
    }

    fn legs(&self, vertices: &[DVec2]) -> Vec<f64> {
        self.legs_of(vertices).map(DVec2::length).collect()
    }

    /// The legs of the polygon, of a periodic one also the closing leg.
    fn legs_of<'v>(&self, vertices: &'v [DVec2]) -> impl Iterator<Item = DVec2> + 'v {
        let count = vertices.len();
        let legs = if self.problem.splines.periodic {
            count
        } else {
            count - 1
        };
        (0..legs).map(move |leg| vertices[(leg + 1) % count] - vertices[leg])
    }

    /// The second differences of the logarithms of legs, and those of the directions of outer ones.
    fn leg_bends(&self, vertices: &[DVec2]) -> Vec<LegBend> {
        let splines = &self.problem.splines;
        let legs: Vec<DVec2> = self.legs_of(vertices).collect();
        let count = legs.len();
        let bends = match splines.periodic {
            true => count,
            false => count.saturating_sub(2),
        };
        let outer = (splines.degree + OUTER).min(bends.saturating_sub(1) / 2);
        let calms_ends = self.problem.data.calms_ends;
        let by_points = self.sum / splines.count as f64;
        let bend = |first: usize| {
            let three = [0, 1, 2].map(|it| legs[(first + it) % count]);
            let is_outer = calms_ends && (first < outer || first + outer >= bends);
            let weight = if is_outer { OUTER_LEGS } else { LEGS };
            let factor = (weight * by_points).sqrt();
            let turn = is_outer.then(|| LegBend::of_directions(first, three, factor));
            [Some(LegBend::of_lengths(first, three, factor)), turn]
        };
        (0..bends).flat_map(bend).flatten().collect()
    }

    /// The mean of the legs at each vertex, in which its moves are counted.
    fn scales(&self, vertices: &[DVec2]) -> Vec<f64> {
        let legs = self.legs(vertices);
        let count = vertices.len();
        let least = LEAST_LEG * legs.iter().sum::<f64>() / legs.len().max(1) as f64;
        let scale = |vertex: usize| {
            let [before, behind] = match self.problem.splines.periodic {
                true => [(vertex + count - 1) % count, vertex],
                false => [vertex.max(1) - 1, vertex.min(legs.len() - 1)],
            };
            (0.5 * (legs[before] + legs[behind])).max(least)
        };
        (0..count).map(scale).collect()
    }

    fn model(&self, now: &Measured, unit: f64) -> Model {
        let problem = self.problem;
        let (splines, layout) = (&problem.splines, &problem.layout);
        let PlacedCurve { vertices, places } = &now.start.curve;
        let scales = self.scales(vertices);
        let width = splines.degree + 1;
        let mut across = Rows::new(width);
        let mut along = Rows::new(width);
        let (mut off_across, mut off_along) = (Vec::new(), Vec::new());
        let last = places.len().saturating_sub(1);
        let points = problem
            .data
            .points
            .iter()
            .zip(places)
            .zip(problem.data.weights);
        for (index, ((point, u), weight)) in points.enumerate() {
            let [at, first] = splines.jet(vertices, *u);
            let tangent = first.normalize_or(DVec2::X);
            let is_end = !splines.periodic && (index == 0 || index == last);
            let (segment, basis) = splines.basis(*u);
            let factor = weight.sqrt() / unit;
            let off = factor * (at - *point);
            let share = if is_end { 1.0 } else { TANGENT.sqrt() };
            let row = |direction: DVec2| {
                let basis = basis.iter().take(width);
                basis.flat_map(move |value| (*value * direction).to_array())
            };
            across.push(segment, row(factor * tangent.perp()));
            along.push(segment, row(factor * share * tangent));
            off_across.push(off.dot(tangent.perp()));
            off_along.push(if is_end { off.dot(tangent) } else { 0.0 });
        }
        let mut legs = Rows::new(LEG_REACH);
        let mut off_legs = Vec::new();
        for bend in self.leg_bends(vertices) {
            let gradient = bend.gradient.into_iter();
            legs.push(bend.first, gradient.flat_map(|it| it.to_array()));
            off_legs.push(bend.value);
        }
        let mut matrix = BandMatrix::new(layout);
        let mut gradient = vec![0.0; layout.unknowns()];
        for (rows, off) in [
            (&mut across, off_across),
            (&mut along, off_along),
            (&mut legs, off_legs),
        ] {
            scale(rows, &scales);
            layout.add_squares(rows, &vec![1.0; rows.firsts.len()], &mut matrix);
            layout.add_transposed(rows, &off, &mut gradient);
        }
        if let Some(mirror) = problem.data.mirror {
            layout.symmetrise(mirror, &mut matrix);
            layout.symmetrise_right(mirror, &mut gradient);
        }
        let (rows, norms) = normalised(&now.conditions.rows, &scales);
        Model {
            values: shares(&now.conditions.values, &norms),
            equations: conditions::equations(problem, vertices, &scales),
            scales,
            matrix,
            gradient,
            rows,
            norms,
        }
    }

    /// Find a step that makes the merit smaller, with as much damping as that takes.
    fn step(
        &self,
        now: &Measured,
        model: &Model,
        unit: f64,
        price: f64,
        mut damping: f64,
        merit: f64,
    ) -> Option<Taken> {
        let mean = model.matrix.diagonal().sum::<f64>() / self.problem.layout.unknowns() as f64;
        let enough = merit - ROUNDING * merit.abs();
        for _ in 0..DAMPINGS {
            let mut matrix = model.matrix.clone();
            matrix.add_to_diagonal(damping * mean);
            let solve = |values: &[f64]| self.program(model, &matrix, values, price);
            if let Some(solution) = solve(&model.values) {
                let mut taken = self.along(now, model, unit, price, enough, &solution);
                let largest = largest(&solution.step);
                if taken.is_none() && largest <= LONGEST {
                    // The conditions bend away from their tangents: solve again with their values there.
                    let there = self.moved(now, model, unit, &solution.step, 1.0);
                    let there = shares(&there.conditions.values, &model.norms);
                    let linear = self.problem.layout.times(&model.rows, &solution.step);
                    let values: Vec<f64> = there.iter().zip(&linear).map(|(a, b)| a - b).collect();
                    let corrected = solve(&values);
                    let corrected = corrected.filter(|it| self::largest(&it.step) < 1.0);
                    taken = corrected.and_then(|it| {
                        let measured = self.moved(now, model, unit, &it.step, 1.0);
                        let merit = self.merit(&measured, model, price);
                        (merit < enough).then_some((measured, merit, 1.0))
                    });
                }
                if let Some((measured, merit, length)) = taken {
                    let linear = self.problem.layout.times(&model.rows, &solution.step);
                    let values = linear.iter().zip(&model.values);
                    let left = values.map(|(a, b)| (-(a + b)).max(0.0)).sum();
                    return Some(Taken {
                        measured,
                        merit,
                        length,
                        largest,
                        left,
                        multipliers: solution.multipliers,
                        damping,
                    });
                }
            }
            damping *= 10.0;
            if damping > MOST_DAMPING {
                break;
            }
        }
        None
    }

    fn program(
        &self,
        model: &Model,
        matrix: &BandMatrix,
        values: &[f64],
        price: f64,
    ) -> Option<Solution> {
        let program = QuadraticProgram {
            layout: &self.problem.layout,
            matrix,
            gradient: &model.gradient,
            rows: &model.rows,
            values,
            price,
            equalities: &model.equations,
        };
        program.solve()
    }

    /// Try ever shorter shares of a step.
    fn along(
        &self,
        now: &Measured,
        model: &Model,
        unit: f64,
        price: f64,
        enough: f64,
        solution: &Solution,
    ) -> Option<(Measured, f64, f64)> {
        let mut length = (LONGEST / largest(&solution.step).max(f64::MIN_POSITIVE)).min(1.0);
        for _ in 0..LENGTHS {
            let measured = self.moved(now, model, unit, &solution.step, length);
            let merit = self.merit(&measured, model, price);
            if merit < enough {
                return Some((measured, merit, length));
            }
            length *= SHORTER;
        }
        None
    }

    fn moved(
        &self,
        now: &Measured,
        model: &Model,
        unit: f64,
        step: &[f64],
        length: f64,
    ) -> Measured {
        let mut start = now.start.clone();
        self.advance(&mut start.curve, &model.scales, step, length);
        self.measured(start, unit, false)
    }

    fn advance(&self, curve: &mut PlacedCurve, scales: &[f64], step: &[f64], length: f64) {
        for (index, (vertex, scale)) in curve.vertices.iter_mut().zip(scales).enumerate() {
            let unknown = self.problem.layout.unknown(index);
            *vertex += length * *scale * DVec2::new(step[unknown], step[unknown + 1]);
        }
        if let Some(mirror) = self.problem.data.mirror {
            mirror.symmetrise(&mut curve.vertices);
        }
        self.problem.project(curve, 2);
    }

    fn merit(&self, measured: &Measured, model: &Model, price: f64) -> f64 {
        let values = shares(&measured.conditions.values, &model.norms);
        let vertices = &measured.start.curve.vertices;
        let equations = conditions::equations(self.problem, vertices, &model.scales);
        merit(measured.value, &values, &equations, price)
    }

    fn slide(&self, start: &mut Start, press: &[f64], slopes: usize) -> bool {
        let (of_slopes, of_bends) = press.split_at(slopes.min(press.len()));
        let tables = self.problem.tables;
        let before = (start.slopes.clone(), start.bends.clone());
        start.slopes.slide(of_slopes, tables.slopes());
        if let Some(bends) = &mut start.bends {
            bends.slide(of_bends, tables.bends());
        }
        if self.problem.data.mirror.is_some() {
            start.slopes.symmetrise(of_slopes.len());
            if let Some(bends) = &mut start.bends {
                bends.symmetrise(of_bends.len());
            }
        }
        before != (start.slopes.clone(), start.bends.clone())
    }

    /// Go to the nearest curve that meets all conditions. Returns whether it does.
    fn restore(&self, now: &mut Measured) -> bool {
        for _ in 0..RESTORATIONS {
            let scales = self.scales(&now.start.curve.vertices);
            let equations = conditions::equations(self.problem, &now.start.curve.vertices, &scales);
            let held = equations.iter().all(|(_, missed)| missed.abs() < END_GOAL);
            if held && now.conditions.hold() {
                return true;
            }
            let (rows, norms) = normalised(&now.conditions.rows, &scales);
            let mut matrix = BandMatrix::new(&self.problem.layout);
            matrix.add_to_diagonal(1.0);
            let model = Model {
                gradient: vec![0.0; self.problem.layout.unknowns()],
                values: shares(&now.conditions.values, &norms),
                matrix,
                rows,
                norms,
                equations,
                scales,
            };
            let solution = self.program(&model, &model.matrix, &model.values, RESTORING_PRICE);
            let Some(solution) = solution.filter(|it| largest(&it.step) <= LONGEST_RESTORED) else {
                break;
            };
            self.advance(&mut now.start.curve, &model.scales, &solution.step, 1.0);
            now.conditions = Conditions::new(self.problem, &now.start, None, true);
        }
        let vertices = &now.start.curve.vertices;
        let equations = conditions::equations(self.problem, vertices, &self.scales(vertices));
        let held = equations
            .iter()
            .all(|(_, missed)| missed.abs() < END_TOLERANCE);
        held && now.conditions.hold()
    }
}

impl LegBend {
    /// The second difference of the logarithms of the legs.
    fn of_lengths(first: usize, legs: [DVec2; 3], factor: f64) -> Self {
        let [a, b, c] = legs.map(|leg| 0.5 * square(leg).ln());
        let slopes = legs.map(|leg| leg / square(leg));
        Self::new(first, a - 2.0 * b + c, slopes, factor)
    }

    /// The second difference of the directions of the legs.
    fn of_directions(first: usize, legs: [DVec2; 3], factor: f64) -> Self {
        let [a, b, c] = legs;
        let turn = |from: DVec2, to: DVec2| from.perp_dot(to).atan2(from.dot(to));
        let slopes = legs.map(|leg| leg.perp() / square(leg));
        Self::new(first, turn(b, c) - turn(a, b), slopes, factor)
    }

    /// `slopes` are the derivatives of what is differenced, by each leg.
    fn new(first: usize, value: f64, slopes: [DVec2; 3], factor: f64) -> Self {
        let [a, b, c] = slopes;
        let gradient = [-a, a + 2.0 * b, -2.0 * b - c, c];
        Self {
            first,
            value: factor * value,
            gradient: gradient.map(|it| factor * it),
        }
    }
}

fn square(leg: DVec2) -> f64 {
    leg.length_squared().max(f64::MIN_POSITIVE)
}

impl Model {
    fn merit(&self, value: f64, values: &[f64], price: f64) -> f64 {
        merit(value, values, &self.equations, price)
    }
}

/// The objective and the price of all violations.
fn merit(value: f64, conditions: &[f64], equations: &[(Vec<f64>, f64)], price: f64) -> f64 {
    let violated: f64 = conditions.iter().map(|it| (-it).max(0.0)).sum();
    let missed: f64 = equations.iter().map(|(_, missed)| missed.abs()).sum();
    let merit = value + price * (violated + missed);
    if merit.is_finite() {
        merit
    } else {
        f64::INFINITY
    }
}

/// How damping changes after a step of which so much was gone.
fn damping_factor(length: f64) -> f64 {
    match length {
        1.0 => 0.2,
        length if length > 0.2 => 1.0,
        _ => 5.0,
    }
}

/// Count the moves of vertices in units.
fn scale(rows: &mut Rows, scales: &[f64]) {
    for (first, row) in rows.iter_mut() {
        for (index, value) in row.iter_mut().enumerate() {
            *value *= scales[(first + index / 2) % scales.len()];
        }
    }
}

/// The rows of conditions in units of moves, each divided by its length, and these lengths.
fn normalised(rows: &Rows, scales: &[f64]) -> (Rows, Vec<f64>) {
    let mut rows = rows.clone();
    scale(&mut rows, scales);
    let mut norms = Vec::new();
    for (_, row) in rows.iter_mut() {
        let square: f64 = row.iter().map(|value| value * value).sum();
        let norm = square.sqrt().max(LEAST_ROW);
        for value in row {
            *value /= norm;
        }
        norms.push(norm);
    }
    (rows, norms)
}

fn shares(values: &[f64], norms: &[f64]) -> Vec<f64> {
    values
        .iter()
        .zip(norms)
        .map(|(value, norm)| value / norm)
        .collect()
}

fn largest(step: &[f64]) -> f64 {
    step.iter().fold(0.0, |most, value| most.max(value.abs()))
}
