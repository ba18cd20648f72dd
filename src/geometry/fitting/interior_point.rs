//! Quadratic programs with banded matrices.

use super::banded_rows::{BandFactor, BandMatrix, Layout, Rows};

/// The most steps.
const STEPS: usize = 60;

/// The share of the way to the boundary that a step goes.
const SHORT: f64 = 0.995;

/// A mean complementarity, residuals of conditions and of the gradient below these end the steps.
const SETTLED: f64 = 1e-9;
const SETTLED_GRADIENT: f64 = 1e-7;

/// Find the y that makes ½ yᵀHy + gᵀy + ρ Σ t small while c + C y + t ≥ 0, t ≥ 0 and E y = e.
///
/// The price ρ bounds the multipliers, so that there is always a solution.
pub(super) struct QuadraticProgram<'a> {
    pub(super) layout: &'a Layout,
    /// H, positive definite.
    pub(super) matrix: &'a BandMatrix,
    /// g.
    pub(super) gradient: &'a [f64],
    /// C.
    pub(super) rows: &'a Rows,
    /// c.
    pub(super) values: &'a [f64],
    /// ρ.
    pub(super) price: f64,
    /// E, a few full rows, and e.
    pub(super) equalities: &'a [(Vec<f64>, f64)],
}

/// A solution.
pub(super) struct Solution {
    pub(super) step: Vec<f64>,
    /// The multipliers of the conditions.
    pub(super) multipliers: Vec<f64>,
}

/// What the method changes: y; for each condition its slack s, its violation t and its multiplier λ, and
/// ρ − λ; the multipliers ν of the equalities.
struct Point {
    step: Vec<f64>,
    slack: Vec<f64>,
    violation: Vec<f64>,
    multiplier: Vec<f64>,
    rest: Vec<f64>,
    equality: Vec<f64>,
}

/// What a point misses of the conditions for a solution.
struct Residuals {
    conditions: Vec<f64>,
    gradient: Vec<f64>,
    equalities: Vec<f64>,
    /// The mean complementarity.
    gap: f64,
}

impl QuadraticProgram<'_> {
    /// Solve by Mehrotra's predictor and corrector. `None` if the matrix cannot be factored.
    pub(super) fn solve(&self) -> Option<Solution> {
        let mut point = self.first();
        for _ in 0..STEPS {
            let residuals = self.residuals(&point);
            if self.is_settled(&residuals) {
                break;
            }
            let stiffness = self.stiffness(&point);
            let mut matrix = self.matrix.clone();
            self.layout.add_squares(self.rows, &stiffness, &mut matrix);
            let equalities = Equalities::new(matrix.factor()?, self.equalities);
            let predicted = self.direction(&point, &residuals, &stiffness, &equalities, None)?;
            let length = point.length(&predicted);
            let target = match self.values.is_empty() {
                true => 0.0,
                false => {
                    residuals.gap * (point.gap_after(&predicted, length) / residuals.gap).powi(3)
                }
            };
            let corrected = Some((target, &predicted));
            let direction =
                self.direction(&point, &residuals, &stiffness, &equalities, corrected)?;
            let [primal, dual] = point.length(&direction);
            let whole = primal.min(dual);
            point.advance(&direction, if whole < 1.0 { SHORT * whole } else { 1.0 });
        }
        let is_finite = point.step.iter().all(|value| value.is_finite());
        is_finite.then_some(Solution {
            step: point.step,
            multipliers: point.multiplier,
        })
    }

    fn first(&self) -> Point {
        let multiplier = (0.5 * self.price).min(1.0);
        let slack: Vec<f64> = self.values.iter().map(|value| value.max(1e-2)).collect();
        let missing = slack.iter().zip(self.values);
        Point {
            step: vec![0.0; self.gradient.len()],
            violation: missing
                .map(|(slack, value)| (slack - value).max(1e-2))
                .collect(),
            multiplier: vec![multiplier; slack.len()],
            rest: vec![self.price - multiplier; slack.len()],
            equality: vec![0.0; self.equalities.len()],
            slack,
        }
    }

    fn residuals(&self, point: &Point) -> Residuals {
        let mut conditions = self.layout.times(self.rows, &point.step);
        let mut gap = 0.0;
        for (index, it) in conditions.iter_mut().enumerate() {
            *it += self.values[index] + point.violation[index] - point.slack[index];
            gap += point.multiplier[index] * point.slack[index]
                + point.rest[index] * point.violation[index];
        }
        let mut gradient = self.matrix.times(&point.step);
        for (sum, value) in gradient.iter_mut().zip(self.gradient) {
            *sum += value;
        }
        let negative: Vec<f64> = point.multiplier.iter().map(|it| -it).collect();
        self.layout
            .add_transposed(self.rows, &negative, &mut gradient);
        for ((row, _), multiplier) in self.equalities.iter().zip(&point.equality) {
            for (sum, value) in gradient.iter_mut().zip(row) {
                *sum -= multiplier * value;
            }
        }
        let equalities = self.equalities.iter();
        Residuals {
            equalities: equalities
                .map(|(row, right)| dot(row, &point.step) - right)
                .collect(),
            gap: gap / (2 * conditions.len()).max(1) as f64,
            conditions,
            gradient,
        }
    }

    fn is_settled(&self, residuals: &Residuals) -> bool {
        residuals.gap < SETTLED * (1.0 + 1e-6 * self.price)
            && largest(&residuals.conditions) < SETTLED
            && largest(&residuals.equalities) < SETTLED
            && largest(&residuals.gradient) < SETTLED_GRADIENT * (1.0 + largest(self.gradient))
    }

    /// The weights by which conditions enter the matrix once slacks and violations are eliminated.
    fn stiffness(&self, point: &Point) -> Vec<f64> {
        let weight = |index: usize| {
            let soft = point.slack[index] / point.multiplier[index]
                + point.violation[index] / point.rest[index];
            1.0 / soft
        };
        (0..self.values.len()).map(weight).collect()
    }

    /// The Newton direction to a complementarity, corrected by the products of a predicted direction.
    fn direction(
        &self,
        point: &Point,
        residuals: &Residuals,
        stiffness: &[f64],
        equalities: &Equalities,
        corrected: Option<(f64, &Point)>,
    ) -> Option<Point> {
        let count = self.values.len();
        let mut products = vec![[0.0; 2]; count];
        for (index, [low, high]) in products.iter_mut().enumerate() {
            *low = -point.multiplier[index] * point.slack[index];
            *high = -point.rest[index] * point.violation[index];
            if let Some((target, predicted)) = corrected {
                let change = predicted.multiplier[index];
                *low += target - change * predicted.slack[index];
                *high += target + change * predicted.violation[index];
            }
        }
        let right = |index: usize| {
            let [low, high] = products[index];
            low / point.multiplier[index] - high / point.rest[index] - residuals.conditions[index]
        };
        let right: Vec<f64> = (0..count).map(right).collect();
        let weighed = right.iter().zip(stiffness);
        let weighed: Vec<f64> = weighed.map(|(right, weight)| right * weight).collect();
        let mut force: Vec<f64> = residuals.gradient.iter().map(|it| -it).collect();
        self.layout.add_transposed(self.rows, &weighed, &mut force);
        let (step, equality) = equalities.solve(&force, &residuals.equalities)?;
        let moved = self.layout.times(self.rows, &step);
        let mut direction = Point {
            step,
            slack: vec![0.0; count],
            violation: vec![0.0; count],
            multiplier: vec![0.0; count],
            rest: vec![0.0; count],
            equality,
        };
        for index in 0..count {
            let change = stiffness[index] * (right[index] - moved[index]);
            let [low, high] = products[index];
            direction.multiplier[index] = change;
            direction.rest[index] = -change;
            direction.slack[index] = (low - point.slack[index] * change) / point.multiplier[index];
            direction.violation[index] =
                (high + point.violation[index] * change) / point.rest[index];
        }
        Some(direction)
    }
}

impl Point {
    /// How far a direction may be followed until a slack or violation, or a multiplier, is 0; at most 1.
    fn length(&self, direction: &Self) -> [f64; 2] {
        let least = |values: &[f64], changes: &[f64]| {
            let falling = values
                .iter()
                .zip(changes)
                .filter(|(_, change)| **change < 0.0);
            let limits = falling.map(|(value, change)| -value / change);
            limits.fold(1.0, f64::min)
        };
        [
            least(&self.slack, &direction.slack).min(least(&self.violation, &direction.violation)),
            least(&self.multiplier, &direction.multiplier).min(least(&self.rest, &direction.rest)),
        ]
    }

    /// The mean complementarity behind a step.
    fn gap_after(&self, direction: &Self, [primal, dual]: [f64; 2]) -> f64 {
        let product = |index: usize| {
            let low = self.multiplier[index] + dual * direction.multiplier[index];
            let high = self.rest[index] + dual * direction.rest[index];
            low * (self.slack[index] + primal * direction.slack[index])
                + high * (self.violation[index] + primal * direction.violation[index])
        };
        let sum: f64 = (0..self.slack.len()).map(product).sum();
        sum / (2 * self.slack.len()) as f64
    }

    fn advance(&mut self, direction: &Self, length: f64) {
        let add = |values: &mut Vec<f64>, changes: &[f64]| {
            for (value, change) in values.iter_mut().zip(changes) {
                *value += length * change;
            }
        };
        add(&mut self.step, &direction.step);
        add(&mut self.slack, &direction.slack);
        add(&mut self.violation, &direction.violation);
        add(&mut self.multiplier, &direction.multiplier);
        add(&mut self.rest, &direction.rest);
        add(&mut self.equality, &direction.equality);
    }
}

/// A factored matrix with a few full equality rows (Schur complement).
struct Equalities<'a> {
    factor: BandFactor,
    rows: &'a [(Vec<f64>, f64)],
    /// The inverse matrix times each row.
    solved: Vec<Vec<f64>>,
}

impl<'a> Equalities<'a> {
    fn new(factor: BandFactor, rows: &'a [(Vec<f64>, f64)]) -> Self {
        let solved = rows.iter().map(|(row, _)| factor.solve(row)).collect();
        Self {
            factor,
            rows,
            solved,
        }
    }

    /// Solve for a step that cancels what the equalities miss. `None` if they depend on each other.
    fn solve(&self, force: &[f64], missed: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let mut step = self.factor.solve(force);
        if self.rows.is_empty() {
            return Some((step, Vec::new()));
        }
        let system = self.rows.iter().zip(missed).map(|((row, _), missed)| {
            let products = self.solved.iter().map(|solved| dot(row, solved));
            let mut line: Vec<f64> = products.collect();
            line.push(-missed - dot(row, &step));
            line
        });
        let multipliers = eliminated(system.collect())?;
        for (solved, multiplier) in self.solved.iter().zip(&multipliers) {
            for (sum, value) in step.iter_mut().zip(solved) {
                *sum += multiplier * value;
            }
        }
        Some((step, multipliers))
    }
}

/// Solve a few linear equations, each with its right side at its end, by elimination with pivots.
fn eliminated(mut lines: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let count = lines.len();
    for pivot in 0..count {
        let best = (pivot..count).max_by(|a, b| {
            let [a, b] = [a, b].map(|line| lines[*line][pivot].abs());
            a.total_cmp(&b)
        })?;
        lines.swap(pivot, best);
        let head = lines[pivot].clone();
        if head[pivot] == 0.0 || !head[pivot].is_finite() {
            return None;
        }
        for (_, line) in lines
            .iter_mut()
            .enumerate()
            .filter(|(line, _)| *line != pivot)
        {
            let factor = line[pivot] / head[pivot];
            for (value, own) in line.iter_mut().zip(&head) {
                *value -= factor * own;
            }
        }
    }
    let solved = lines.iter().enumerate();
    Some(
        solved
            .map(|(index, line)| line[count] / line[index])
            .collect(),
    )
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The point of a region that is nearest to (3, 2): x ≤ 1, or too far, and y = x − `shift`.
    fn nearest(limit: f64, price: f64, shift: Option<f64>) -> Solution {
        let layout = Layout::new(1, 1, false);
        let mut matrix = BandMatrix::new(&layout);
        matrix.add_to_diagonal(1.0);
        let mut rows = Rows::new(1);
        rows.push(0, [-1.0, 0.0]);
        let equalities: Vec<_> = shift
            .map(|shift| (vec![1.0, -1.0], shift))
            .into_iter()
            .collect();
        let program = QuadraticProgram {
            layout: &layout,
            matrix: &matrix,
            gradient: &[-3.0, -2.0],
            rows: &rows,
            values: &[limit],
            price,
            equalities: &equalities,
        };
        program.solve().expect("a solution")
    }

    #[test]
    fn solutions_meet_conditions_and_equalities_or_pay_their_price() {
        for (limit, price, shift, expected, multiplier) in [
            (1.0, 1e3, None, [1.0, 2.0], 2.0),
            (5.0, 1e3, None, [3.0, 2.0], 0.0),
            (1.0, 0.5, None, [2.5, 2.0], 0.5),
            (1.0, 1e3, Some(0.5), [1.0, 0.5], 3.5),
        ] {
            let found = nearest(limit, price, shift);
            for (a, b) in found.step.iter().zip(expected) {
                assert!((a - b).abs() < 1e-6, "{limit} {price}: {:?}", found.step);
            }
            assert!((found.multipliers[0] - multiplier).abs() < 1e-6);
        }
    }
}
