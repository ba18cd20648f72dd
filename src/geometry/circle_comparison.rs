//! The paper's Table 1: how well a float polygon and a Bézier polygon of constant legs and
//! turning angles approximate a circle, measured by the evolute's largest distance from the
//! centre.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::bezier_polygon::BezierPolygon;
use super::error::PolygonError;
use super::float_polygon::FloatPolygon;

/// The radius of the circle in the paper.
pub const PAPER_RADIUS: f64 = 10.0;

/// The degrees of the paper's Table 1.
const PAPER_DEGREES: [usize; 4] = [3, 5, 7, 9];

/// The degree from which on the B-spline's distance is computed by its harmonics: from its
/// vertices, given as doubles, it would be lost in their rounding as the degree grows.
const BY_HARMONICS: usize = 7;

/// The harmonics on either side that count: what those beyond could add is below rounding.
const HARMONICS: i32 = 400;

/// Samples of a segment between which the largest distance is searched.
const SAMPLES: usize = 64;

/// Steps of the golden-section search: the bracket shrinks to rounding.
const STEPS: usize = 60;

/// One row of Table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircleComparison {
    /// The degree n.
    pub degree: usize,
    /// The evolute's largest distance from the centre, of the B-spline segment.
    pub bspline: f64,
    /// The same of the Bézier curve.
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

/// The sides of the regular polygon on which the paper puts a B-spline of some degree: 6 up to the
/// third, 12 beyond.
pub fn paper_sides(degree: usize) -> usize {
    if degree <= 3 { 6 } else { 12 }
}

/// Place a float polygon of one segment on n + 1 consecutive corners of a regular polygon about
/// the origin, symmetric about the y axis, running clockwise over the top as in the paper's
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

/// Make the Bézier curve that the float polygon of [`regular_polygon`] is compared with: n equal
/// legs and n − 1 equal turning angles θ/(n − 1), θ the central angle of one side, from the
/// B-spline segment's start to its end. It is given by its float polygon.
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

/// Find the largest distance between the curve's evolute and the origin.
pub fn evolute_reach(polygon: &FloatPolygon) -> f64 {
    largest(polygon.segments(), |u| {
        let centre = polygon.jet(u).centre_of_curvature();
        centre.map_or(f64::INFINITY, |centre| centre.length())
    })
}

/// Find the largest distance between the evolute and the centre for the float polygon on a regular
/// polygon of some degree from 3 on, exactly but for the rounding of the result.
///
/// With φ the central angle of a side and the vertices R e^{iφj}, Poisson's sum makes of the curve
///
///   z(u) = ρ e^{iφu} (1 + ε(u)),   ε(u) = Σ_{k≠0} (φ/(φ + 2πk))^{n+1} e^{2πiku},
///
/// u counted from where it is symmetric, ρ = R (sin(φ/2)/(φ/2))^{n+1}: a circle and harmonics that fade as the degree grows. The centre
/// of curvature z + i z′ |z′|² / Im(z̄′ z″) is multiplied out with z′ = iφ e^{iφu} ρ (1 + a) and
/// z″ = −φ² e^{iφu} ρ (1 + b), a = ε + ε′/(iφ), b = ε − 2iε′/φ − ε″/φ², so that the ones cancel
/// before anything is rounded.
fn regular_evolute_reach(degree: usize, sides: usize, radius: f64) -> f64 {
    let angle = TAU / sides as f64;
    let order = degree as i32 + 1;
    let circle = radius * ((0.5 * angle).sin() / (0.5 * angle)).powi(order);
    let harmonics = (1..=HARMONICS).flat_map(|k| [-k, k]).map(|k| {
        let turn = TAU * f64::from(k);
        (turn, (angle / (angle + turn)).powi(order))
    });
    // The smallest come first, so that their sum keeps its digits.
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

/// Find the largest value of a function over some segments.
fn largest(segments: usize, value: impl Fn(f64) -> f64) -> f64 {
    let count = SAMPLES * segments;
    let step = segments as f64 / count as f64;
    let samples: Vec<f64> = (0..=count)
        .map(|index| value(index as f64 * step))
        .collect();
    let best = (0..samples.len()).max_by(|&a, &b| samples[a].total_cmp(&samples[b]));
    let best = best.unwrap_or_default();
    let (mut low, mut high) = (
        best.saturating_sub(1) as f64 * step,
        (best + 1).min(count) as f64 * step,
    );
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for _ in 0..STEPS {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if value(left) < value(right) {
            low = left;
        } else {
            high = right;
        }
    }
    value(0.5 * (low + high)).max(samples[best])
}
