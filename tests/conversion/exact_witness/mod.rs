//! The witness of exact tests: conversions in rational arithmetic.
//!
//! It takes doubles as the rational numbers they are and evaluates blossoms by the general
//! recurrence on any knots; the library clamps and unclamps knot by knot, or multiplies by a
//! matrix.
#![allow(dead_code)] // Each test uses a part of it.

use crate::common::Random;
use glam::DVec3;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{FromPrimitive, Signed, ToPrimitive};

/// What a conversion may be off, in units of the last digit of the largest coordinate: the one
/// rounding of the result is half such a unit.
pub const ALLOWED_ULPS: f64 = 0.501;

pub type Exact = BigRational;

pub fn exact(value: f64) -> Exact {
    Exact::from_f64(value).expect("a finite number")
}

pub fn integer(value: i64) -> Exact {
    Exact::from_integer(BigInt::from(value))
}

/// Homogeneous vertices (w·x, w·y, w·z, w).
pub type Vertices = Vec<[Exact; 4]>;

pub fn homogeneous(points: &[DVec3], weights: Option<&[f64]>) -> Vertices {
    let vertex = |(index, point): (usize, &DVec3)| {
        let w = exact(weights.map_or(1.0, |weights| weights[index]));
        [
            exact(point.x) * &w,
            exact(point.y) * &w,
            exact(point.z) * &w,
            w,
        ]
    };
    points.iter().enumerate().map(vertex).collect()
}

/// Knots t_0, t_1 … of a polygon whose vertex i is the blossom at t_{i+1} … t_{i+n}.
#[derive(Clone, Copy)]
pub struct Knots {
    pub degree: usize,
    pub low: i64,
    pub high: i64,
}

impl Knots {
    pub fn float(degree: usize) -> Self {
        Self {
            degree,
            low: i64::MIN,
            high: i64::MAX,
        }
    }

    pub fn clamped(degree: usize, segments: usize) -> Self {
        Self {
            degree,
            low: 0,
            high: segments as i64,
        }
    }

    pub fn at(self, index: usize) -> i64 {
        (index as i64 - self.degree as i64).clamp(self.low, self.high)
    }

    pub fn of_vertex(self, index: usize) -> Vec<Exact> {
        (index + 1..=index + self.degree)
            .map(|k| integer(self.at(k)))
            .collect()
    }

    /// Evaluate the blossom of the polynomial of one segment (the general de Boor recurrence).
    pub fn blossom(
        self,
        vertices: &[[Exact; 4]],
        segment: usize,
        arguments: &[Exact],
    ) -> [Exact; 4] {
        assert_eq!(arguments.len(), self.degree);
        let window = &vertices[segment..=segment + self.degree];
        std::array::from_fn(|axis| {
            let values: Vec<Exact> = window.iter().map(|vertex| vertex[axis].clone()).collect();
            // A constant is its own blossom: the weights 1, the plane z = 0.
            if values.iter().all(|value| *value == values[0]) {
                return values[0].clone();
            }
            self.blossom_of_numbers(values, segment, arguments)
        })
    }

    pub fn blossom_of_numbers(
        self,
        mut values: Vec<Exact>,
        segment: usize,
        arguments: &[Exact],
    ) -> Exact {
        let degree = self.degree;
        for (level, argument) in arguments.iter().enumerate() {
            for j in 0..degree - level {
                let left = integer(self.at(segment + j + level + 1));
                let right = integer(self.at(segment + j + degree + 1));
                let share = (argument - &left) / (right - left);
                values[j] = &values[j] + (&values[j + 1] - &values[j]) * share;
            }
        }
        values.swap_remove(0)
    }
}

/// Convert exactly between the float and the clamped polygon.
pub fn converted(vertices: &Vertices, from: Knots, to: Knots) -> Vertices {
    let segments = vertices.len() - from.degree;
    let vertex =
        |index: usize| from.blossom(vertices, index.min(segments - 1), &to.of_vertex(index));
    (0..vertices.len()).map(vertex).collect()
}

/// Convert exactly to the chain of Bézier polygons.
pub fn bezier_chain(vertices: &Vertices, from: Knots) -> Vertices {
    let (degree, segments) = (from.degree, vertices.len() - from.degree);
    let vertex = |index: usize| {
        let (segment, k) = if index == degree * segments {
            (segments - 1, degree)
        } else {
            (index / degree, index % degree)
        };
        let knot = |j: usize| integer((segment + usize::from(j >= degree - k)) as i64);
        let knots: Vec<Exact> = (0..degree).map(knot).collect();
        from.blossom(vertices, segment, &knots)
    };
    (0..=degree * segments).map(vertex).collect()
}

/// The unit of the last digit of a number.
pub fn ulp(value: f64) -> f64 {
    let next = f64::from_bits(value.abs().to_bits() + 1);
    next - value.abs()
}

/// Measure how far found vertices are off, in units of the last digit of the largest exact
/// coordinate; weights by that of the largest weight.
pub fn off(points: &[DVec3], weights: Option<&[f64]>, expected: &Vertices) -> f64 {
    assert_eq!(points.len(), expected.len());
    let projected: Vec<Vec<Exact>> = expected
        .iter()
        .map(|v| v[..3].iter().map(|axis| axis / &v[3]).collect())
        .collect();
    let largest = projected
        .iter()
        .flatten()
        .map(Signed::abs)
        .max()
        .expect("vertices");
    let unit = exact(ulp(largest.to_f64().expect("a number")));
    let mut worst = integer(0);
    for (point, expected) in points.iter().zip(&projected) {
        for (found, expected) in point.to_array().into_iter().zip(expected) {
            worst = worst.max((exact(found) - expected).abs() / &unit);
        }
    }
    if let Some(weights) = weights {
        let largest = expected.iter().map(|v| v[3].abs()).max().expect("vertices");
        let unit = exact(ulp(largest.to_f64().expect("a number")));
        for (found, expected) in weights.iter().zip(expected) {
            worst = worst.max((exact(*found) - &expected[3]).abs() / &unit);
        }
    }
    worst.to_f64().expect("a number")
}

#[track_caller]
pub fn assert_exact(what: &str, points: &[DVec3], weights: Option<&[f64]>, expected: &Vertices) {
    let off = off(points, weights, expected);
    assert!(off <= ALLOWED_ULPS, "{what}: {off} ulp");
}

#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub degree: usize,
    pub count: usize,
    pub in_space: bool,
    pub rational: bool,
    pub scale: f64,
}

/// Curves of every degree in `degrees`: planar and in space, polynomial and rational, with ends
/// that overlap or do not, small and large.
pub fn kinds(degrees: std::ops::RangeInclusive<usize>) -> Vec<Kind> {
    let mut kinds = Vec::new();
    for degree in degrees {
        if degree > 15 && degree % 5 != 0 {
            continue;
        }
        let counts = [degree + 1, degree + 2, 2 * degree, 2 * degree + 2];
        for (index, count) in counts.into_iter().enumerate() {
            if degree > 10 && index == 3 {
                continue;
            }
            let scale = [1.0, 10.0, 1e-100, 1e99][index];
            for rational in [false, true] {
                let in_space = (degree + index) % 2 == 0;
                let count = count.max(degree + 1);
                kinds.push(Kind {
                    degree,
                    count,
                    in_space,
                    rational,
                    scale,
                });
            }
        }
    }
    kinds
}

impl Kind {
    pub fn points(self, random: &mut Random) -> Vec<DVec3> {
        (0..self.count)
            .map(|_| random.vector(self.scale, self.in_space))
            .collect()
    }

    pub fn weights(self, random: &mut Random) -> Option<Vec<f64>> {
        self.rational
            .then(|| (0..self.count).map(|_| random.between(0.5, 2.0)).collect())
    }

    /// Weights that are positive in every polygon: a linear function, exact in binary.
    pub fn linear_weights(self, to: Knots) -> Option<Vec<f64>> {
        let weight = |index: usize| {
            let sum: i64 = (index + 1..=index + self.degree).map(|k| to.at(k)).sum();
            (16 * self.degree * self.degree) as f64 / 64.0 + sum as f64 / 64.0
        };
        self.rational.then(|| (0..self.count).map(weight).collect())
    }
}
