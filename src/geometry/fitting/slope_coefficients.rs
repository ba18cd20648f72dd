//! Bernstein coefficients of what tells the sign of curvature and of its slope, with their gradients.

use glam::DVec2;

use super::splines::Splines;
use crate::geometry::bezier_matrix::whole_basis;

/// A polynomial as the coefficients of tⁱ (1 − t)ᵈ⁻ⁱ, so that products are convolutions; empty if it is 0
/// everywhere.
type Scaled = Vec<f64>;

/// The slope of the curvature and the curvature on one segment, as Bernstein coefficients.
///
/// The slope has the sign of G = (x′y‴ − y′x‴) W − 3 (x′y″ − y′x″)(x′x″ + y′y″) with W = x′² + y′², the
/// curvature that of A = x′y″ − y′x″. By Descartes' rule a polynomial changes its sign at most as often as
/// its coefficients do. G is given in units of W², A in those of W, W taken in the middle of the segment:
/// both tell turns a segment, whatever the size of the curve.
pub(super) struct SegmentCoefficients {
    /// The coefficients of G.
    pub(super) slopes: Vec<f64>,
    /// The gradient of each by the segment's vertices: x, y, x, y, …
    pub(super) slope_gradients: Vec<Vec<f64>>,
    /// The coefficients of A.
    pub(super) bends: Vec<f64>,
    /// The gradient of each.
    pub(super) bend_gradients: Vec<Vec<f64>>,
    /// The turn of a segment at the pace of its middle.
    pub(super) turn: f64,
}

/// The derivatives of a degree's basis functions.
pub(super) struct SlopeTables {
    /// By order, less 1, and basis function.
    derivatives: [Vec<Scaled>; 3],
    /// The binomial coefficients by which G's and A's are divided.
    binomials: [Vec<f64>; 2],
}

impl SlopeTables {
    /// Make the tables of a degree.
    pub(super) fn new(degree: usize) -> Self {
        let derivatives = [1, 2, 3].map(|order| derived_basis(degree, order));
        let degrees = match degree {
            0 | 1 => [None, None],
            _ => [Some(4 * degree - 6), Some(2 * degree - 3)],
        };
        Self {
            derivatives,
            binomials: degrees.map(|degree| degree.map_or(Vec::new(), binomials)),
        }
    }

    /// The number of coefficients of G on a segment.
    pub(super) fn slopes(&self) -> usize {
        self.binomials[0].len()
    }

    /// The number of coefficients of A on a segment.
    pub(super) fn bends(&self) -> usize {
        self.binomials[1].len()
    }

    /// Compute the coefficients on a segment, with or without their gradients.
    pub(super) fn on_segment(
        &self,
        splines: &Splines,
        vertices: &[DVec2],
        segment: usize,
        with_gradients: bool,
    ) -> SegmentCoefficients {
        let local = (0..=splines.degree).map(|k| vertices[(segment + k) % splines.count]);
        let local: Vec<DVec2> = local.collect();
        let [[x1, y1], [x2, y2], [x3, y3]] = [0, 1, 2].map(|order| {
            [0, 1].map(|axis| {
                let weights = local.iter().map(|vertex| vertex[axis]);
                combination(&self.derivatives[order], weights)
            })
        });
        let square = sum(&product(&x1, &x1), 1.0, &product(&y1, &y1));
        let bend = sum(&product(&x1, &y2), -1.0, &product(&y1, &x2));
        let jerk = sum(&product(&x1, &y3), -1.0, &product(&y1, &x3));
        let along = sum(&product(&x1, &x2), 1.0, &product(&y1, &y2));
        let slope = sum(&product(&jerk, &square), -3.0, &product(&bend, &along));
        let middle = value_in_middle(&square).max(f64::MIN_POSITIVE);
        let turn = value_in_middle(&bend).abs() / middle;
        let units = [1.0 / (middle * middle), 1.0 / middle];
        let [slope_binomials, bend_binomials] = &self.binomials;
        let finish = |polynomial: &Scaled, binomials: &Vec<f64>, unit: f64| {
            let coefficients = polynomial.iter().zip(binomials);
            let coefficients = coefficients.map(|(it, binomial)| unit * it / binomial);
            let mut all: Vec<f64> = coefficients.collect();
            all.resize(binomials.len(), 0.0);
            all
        };
        let mut coefficients = SegmentCoefficients {
            slopes: finish(&slope, slope_binomials, units[0]),
            slope_gradients: Vec::new(),
            bends: finish(&bend, bend_binomials, units[1]),
            bend_gradients: Vec::new(),
            turn,
        };
        if !with_gradients {
            return coefficients;
        }
        // The derivatives of G by x′, y′, x″, y″, x‴, y‴.
        let by_first = |a1: &Scaled, a2: &Scaled, b2: &Scaled, b3: &Scaled, sign: f64| {
            let grown = sum(
                &product(&scaled(b3, sign), &square),
                2.0,
                &product(a1, &jerk),
            );
            let lost = sum(
                &product(&scaled(b2, sign), &along),
                1.0,
                &product(&bend, a2),
            );
            sum(&grown, -3.0, &lost)
        };
        let by_second = |a1: &Scaled, b1: &Scaled, sign: f64| {
            let lost = sum(
                &product(&scaled(b1, -sign), &along),
                1.0,
                &product(&bend, a1),
            );
            scaled(&lost, -3.0)
        };
        let partial = [
            [
                by_first(&x1, &x2, &y2, &y3, 1.0),
                by_second(&x1, &y1, 1.0),
                product(&scaled(&y1, -1.0), &square),
            ],
            [
                by_first(&y1, &y2, &x2, &x3, -1.0),
                by_second(&y1, &x1, -1.0),
                product(&x1, &square),
            ],
        ];
        let bend_partial = [[&y2, &y1], [&x2, &x1]];
        let variables = 2 * local.len();
        let mut slope_gradients = vec![vec![0.0; variables]; slope_binomials.len()];
        let mut bend_gradients = vec![vec![0.0; variables]; bend_binomials.len()];
        let mut slope = vec![0.0; slope_binomials.len()];
        let mut bend = vec![0.0; bend_binomials.len()];
        let [first, second, third] = &self.derivatives;
        let by_vertex = first.iter().zip(second).zip(third).enumerate();
        for (vertex, ((first, second), third)) in by_vertex {
            for axis in 0..2 {
                let variable = 2 * vertex + axis;
                let [by_first, by_second, by_third] = &partial[axis];
                slope.fill(0.0);
                add_product(&mut slope, 1.0, by_first, first);
                add_product(&mut slope, 1.0, by_second, second);
                add_product(&mut slope, 1.0, by_third, third);
                let scaled = slope.iter().zip(slope_binomials);
                for (row, (value, binomial)) in slope_gradients.iter_mut().zip(scaled) {
                    row[variable] = units[0] * value / binomial;
                }
                let [with_first, with_second] = bend_partial[axis];
                let sign = [1.0, -1.0][axis];
                bend.fill(0.0);
                add_product(&mut bend, sign, with_first, first);
                add_product(&mut bend, -sign, with_second, second);
                let scaled = bend.iter().zip(bend_binomials);
                for (row, (value, binomial)) in bend_gradients.iter_mut().zip(scaled) {
                    row[variable] = units[1] * value / binomial;
                }
            }
        }
        coefficients.slope_gradients = slope_gradients;
        coefficients.bend_gradients = bend_gradients;
        coefficients
    }
}

/// The derivatives of the basis functions of a segment: differences of those of a lower degree, 0 above the degree.
fn derived_basis(degree: usize, order: usize) -> Vec<Scaled> {
    let Some(lower) = degree.checked_sub(order) else {
        return vec![Vec::new(); degree + 1];
    };
    let factorial: f64 = (1..=lower).map(|factor| factor as f64).product();
    let basis = whole_basis(lower).into_iter();
    let basis = basis.map(|function| function.iter().map(|it| *it as f64 / factorial).collect());
    let mut functions: Vec<Scaled> = basis.collect();
    for _ in 0..order {
        let zero = vec![0.0; lower + 1];
        let before = std::iter::once(&zero).chain(&functions);
        let behind = functions.iter().chain([&zero]);
        functions = before
            .zip(behind)
            .map(|(before, here)| sum(before, -1.0, here))
            .collect();
    }
    functions
}

fn binomials(degree: usize) -> Vec<f64> {
    let mut row = vec![1.0];
    for k in 0..degree {
        row.push(row[k] * (degree - k) as f64 / (k + 1) as f64);
    }
    row
}

fn combination(functions: &[Scaled], weights: impl Iterator<Item = f64>) -> Scaled {
    let length = functions.first().map_or(0, Vec::len);
    let mut all = vec![0.0; length];
    for (function, weight) in functions.iter().zip(weights) {
        for (sum, value) in all.iter_mut().zip(function) {
            *sum += weight * value;
        }
    }
    all
}

fn product(a: &[f64], b: &[f64]) -> Scaled {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut all = vec![0.0; a.len() + b.len() - 1];
    add_product(&mut all, 1.0, a, b);
    all
}

/// Add `factor` a b.
fn add_product(sums: &mut [f64], factor: f64, a: &[f64], b: &[f64]) {
    for (shift, a) in a.iter().enumerate() {
        let a = factor * a;
        for (sum, b) in sums[shift..].iter_mut().zip(b) {
            *sum += a * b;
        }
    }
}

/// a + `factor` b.
fn sum(a: &[f64], factor: f64, b: &[f64]) -> Scaled {
    let mut all = vec![0.0; a.len().max(b.len())];
    for (sum, a) in all.iter_mut().zip(a) {
        *sum += a;
    }
    for (sum, b) in all.iter_mut().zip(b) {
        *sum += factor * b;
    }
    all
}

fn scaled(a: &[f64], factor: f64) -> Scaled {
    a.iter().map(|it| factor * it).collect()
}

fn value_in_middle(a: &[f64]) -> f64 {
    let degree = a.len() as i32 - 1;
    a.iter().sum::<f64>() * 0.5_f64.powi(degree)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertices(count: usize) -> Vec<DVec2> {
        let vertex = |index: usize| {
            let t = index as f64;
            DVec2::new(t + 0.3 * (1.7 * t).sin(), (0.9 * t).cos())
        };
        (0..count).map(vertex).collect()
    }

    /// The value of a polynomial given by its Bernstein coefficients.
    fn value(coefficients: &[f64], t: f64) -> f64 {
        let degree = coefficients.len() - 1;
        let terms = coefficients.iter().zip(binomials(degree)).enumerate();
        let term = |(power, (coefficient, binomial)): (usize, (&f64, f64))| {
            let powers = t.powi(power as i32) * (1.0 - t).powi((degree - power) as i32);
            coefficient * binomial * powers
        };
        terms.map(term).sum()
    }

    #[test]
    fn coefficients_are_those_of_curvature_and_slope() {
        for degree in [2, 3, 5, 9] {
            let splines = Splines {
                degree,
                count: degree + 4,
                periodic: false,
            };
            let vertices = vertices(splines.count);
            let tables = SlopeTables::new(degree);
            for segment in 0..splines.segments() {
                let at = |t: f64| splines.jet::<4>(&vertices, segment as f64 + t);
                let found = tables.on_segment(&splines, &vertices, segment, false);
                let unit = at(0.5)[1].length_squared();
                for t in [0.0, 0.3, 1.0_f64] {
                    let [_, first, second, third] = at(t.min(1.0 - 1e-15));
                    let bend = first.perp_dot(second);
                    let slope = first.perp_dot(third) * first.length_squared()
                        - 3.0 * bend * first.dot(second);
                    let [bend, slope] = [bend / unit, slope / unit.powi(2)];
                    assert!(
                        (value(&found.bends, t) - bend).abs() < 1e-11,
                        "{degree} {t}"
                    );
                    assert!(
                        (value(&found.slopes, t) - slope).abs() < 1e-10,
                        "{degree} {t}"
                    );
                }
            }
        }
    }

    #[test]
    fn gradients_are_difference_quotients() {
        const STEP: f64 = 1e-5;
        let splines = Splines {
            degree: 5,
            count: 7,
            periodic: false,
        };
        let vertices = vertices(splines.count);
        let tables = SlopeTables::new(5);
        let at = |vertices: &[DVec2]| tables.on_segment(&splines, vertices, 1, true);
        let here = at(&vertices);
        // Units depend on the vertices: compare with them taken out.
        let unit = |vertices: &[DVec2]| splines.jet::<2>(vertices, 1.5)[1].length_squared();
        for vertex in 0..6 {
            for axis in 0..2 {
                let moved = |by: f64| {
                    let mut moved = vertices.clone();
                    moved[vertex + 1][axis] += by;
                    let found = at(&moved);
                    let ratio = unit(&moved) / unit(&vertices);
                    (found.slopes[4] * ratio * ratio, found.bends[2] * ratio)
                };
                let [before, behind] = [moved(-STEP), moved(STEP)];
                let slope = (behind.0 - before.0) / (2.0 * STEP);
                let bend = (behind.1 - before.1) / (2.0 * STEP);
                let entry = 2 * vertex + axis;
                assert!(
                    (here.slope_gradients[4][entry] - slope).abs() < 1e-8,
                    "{vertex}"
                );
                assert!(
                    (here.bend_gradients[2][entry] - bend).abs() < 1e-8,
                    "{vertex}"
                );
            }
        }
    }
}
