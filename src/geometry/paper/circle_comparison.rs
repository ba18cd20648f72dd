//! The paper's Table 1: the deviation of a B-spline and of a Bézier curve from a circle. Both polygons have
//! equal legs and equal turning angles. The measure is the largest distance of the evolute from the circle's
//! centre.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::geometry::root::maximum;
use crate::geometry::{BezierPolygon, FloatPolygon, PolygonError};

/// The radius of the circle in the paper.
pub const PAPER_RADIUS: f64 = 10.0;

/// The degrees of the paper's Table 1.
const PAPER_DEGREES: [usize; 4] = [3, 5, 7, 9];

/// The lowest degree at which harmonics give the B-spline's distance. From here on the rounding of the
/// vertices to doubles would hide it.
const BY_HARMONICS: usize = 7;

/// The number of harmonics on either side of 0. Those beyond add less than rounding does.
const HARMONICS: i32 = 400;

/// Samples of a segment. The search for the largest distance begins at the best one.
const SAMPLES: usize = 64;

/// Steps of the golden-section search. After 60 the bracket is as small as rounding.
const STEPS: usize = 60;

/// Hold one row of Table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircleComparison {
    /// The degree n.
    pub degree: usize,
    /// The largest distance of the B-spline segment's evolute from the centre.
    pub bspline: f64,
    /// The largest distance of the Bézier curve's evolute from the centre.
    pub bezier: f64,
}

impl CircleComparison {
    /// Compute the row for a degree and a regular polygon of `sides` sides and `radius`.
    ///
    /// The float polygon is that of [`regular_polygon`], the Bézier curve that of
    /// [`equal_leg_bezier`].
    ///
    /// # Errors
    /// [`PolygonError`] if the degree is out of range or the radius cannot be used.
    pub fn new(degree: usize, sides: usize, radius: f64) -> Result<Self, PolygonError> {
        let arc = regular_polygon(degree, sides, radius)?;
        let bspline = if degree < BY_HARMONICS {
            evolute_reach(&arc)
        } else {
            regular_evolute_reach(degree, sides, radius)
        };
        let bezier = equal_leg_bezier(degree, sides, radius)?;
        Ok(Self {
            degree,
            bspline,
            bezier: evolute_reach(&bezier),
        })
    }

    /// Compute the four rows of the paper.
    ///
    /// # Errors
    /// None for the paper's own figures.
    pub fn paper_table() -> Result<Vec<Self>, PolygonError> {
        let rows = PAPER_DEGREES.into_iter();
        rows.map(|degree| Self::new(degree, paper_sides(degree), PAPER_RADIUS))
            .collect()
    }
}

/// Return the sides of the regular polygon that the paper uses for a degree: 6 up to degree 3, 12 beyond.
pub fn paper_sides(degree: usize) -> usize {
    if degree <= 3 { 6 } else { 12 }
}

/// Make a float polygon of one segment from n + 1 consecutive corners of a regular polygon. The centre is the
/// origin and the y axis the axis of symmetry. The corners run clockwise over the top, as in the paper's
/// figure 1.
///
/// # Errors
/// [`PolygonError`] if the degree is out of range or the radius cannot be used.
pub fn regular_polygon(
    degree: usize,
    sides: usize,
    radius: f64,
) -> Result<FloatPolygon, PolygonError> {
    let step = TAU / sides as f64;
    let middle = 0.5 * degree as f64;
    let points: Vec<(f64, f64)> = (0..=degree)
        .map(|index| {
            let (sine, cosine) = ((index as f64 - middle) * step).sin_cos();
            (radius * sine, radius * cosine)
        })
        .collect();
    FloatPolygon::planar(degree, &points)
}

/// Make the Bézier curve to compare with [`regular_polygon`], as its float polygon. It has n equal legs and
/// n − 1 equal turning angles θ/(n − 1), with θ the central angle of one side. It starts and ends where the
/// B-spline segment does.
///
/// # Errors
/// As [`regular_polygon`].
pub fn equal_leg_bezier(
    degree: usize,
    sides: usize,
    radius: f64,
) -> Result<FloatPolygon, PolygonError> {
    let segment = regular_polygon(degree, sides, radius)?;
    let (start, end) = (segment.point(0.0), segment.point(1.0));
    let middle = 0.5 * (degree as f64 - 1.0);
    let between = TAU / sides as f64 / (degree.max(2) - 1) as f64;
    // By symmetry the middle leg is parallel to the chord; clockwise turns are negative.
    let directions = (0..degree).map(|leg| -between * (leg as f64 - middle));
    let chord: f64 = directions.clone().map(f64::cos).sum();
    let leg_length = (end.x - start.x) / chord;
    let mut vertices = vec![start];
    let mut vertex = start;
    for angle in directions {
        vertex += leg_length * DVec3::new(angle.cos(), angle.sin(), 0.0);
        vertices.push(vertex);
    }
    BezierPolygon::new(degree, vertices, None)?.to_float()
}

/// Find the largest distance of the curve's evolute from the origin; infinite at an inflection.
pub fn evolute_reach(polygon: &FloatPolygon) -> f64 {
    largest(polygon.segments(), |u| {
        let centre = polygon.jet(u).centre_of_curvature();
        centre.map_or(f64::INFINITY, |centre| centre.length())
    })
}

/// Find the evolute's largest distance from the centre for [`regular_polygon`] of degree 3 or higher. Only
/// the result is rounded.
///
/// Let φ be the central angle of a side and R e^{iφj} the vertices. By Poisson summation the curve is
///
///   z(u) = ρ e^{iφu} (1 + ε(u)),   ε(u) = Σ_{k≠0} (φ/(φ + 2πk))^{n+1} e^{2πiku},
///
/// where u counts from the axis of symmetry and ρ = R (sin(φ/2)/(φ/2))^{n+1}. This is a circle plus harmonics
/// that fade as the degree grows. The centre of curvature is z + i z′ |z′|² / Im(z̄′ z″), with z′ = iφ
/// e^{iφu} ρ (1 + a), z″ = −φ² e^{iφu} ρ (1 + b), a = ε + ε′/(iφ), b = ε − 2iε′/φ − ε″/φ². The code
/// multiplies this out by hand, so that the ones cancel before rounding.
fn regular_evolute_reach(degree: usize, sides: usize, radius: f64) -> f64 {
    let angle = TAU / sides as f64;
    let order = degree as i32 + 1;
    let circle = radius * ((0.5 * angle).sin() / (0.5 * angle)).powi(order);
    let harmonics = (1..=HARMONICS).flat_map(|k| [-k, k]).map(|k| {
        let turn = TAU * f64::from(k);
        (turn, (angle / (angle + turn)).powi(order))
    });
    // Adding the smallest first keeps the digits of the sum.
    let mut harmonics: Vec<(f64, f64)> = harmonics.collect();
    harmonics.reverse();
    largest(1, |u| {
        let [mut a, mut b, mut epsilon] = [DVec2::ZERO; 3];
        for &(turn, weight) in &harmonics {
            let wave = weight * DVec2::from_angle(turn * u);
            // ε′ = i turn ε and ε″ = −turn² ε, for each harmonic.
            let share = turn / angle;
            epsilon += wave;
            a += (1.0 + share) * wave;
            b += (1.0 + share) * (1.0 + share) * wave;
        }
        // Re (1 + ā)(1 + b) − 1 and |1 + a|² − 1.
        let turning = a.x + b.x + a.dot(b);
        let speed = 2.0 * a.x + a.length_squared();
        let excess = epsilon + turning * (DVec2::X + epsilon) - a - speed * (DVec2::X + a);
        circle * excess.length() / (1.0 + turning)
    })
}

/// Find the largest value of a function over the segments: samples, then a golden-section search.
fn largest(segments: usize, value: impl Fn(f64) -> f64) -> f64 {
    let count = SAMPLES * segments;
    let step = segments as f64 / count as f64;
    let samples: Vec<f64> = (0..=count)
        .map(|index| value(index as f64 * step))
        .collect();
    let best = (0..samples.len()).max_by(|&a, &b| samples[a].total_cmp(&samples[b]));
    let best = best.unwrap_or_default();
    let beside = [best.saturating_sub(1), (best + 1).min(count)];
    let (_, largest) = maximum(beside.map(|index| index as f64 * step), STEPS, value);
    largest.max(samples[best])
}
