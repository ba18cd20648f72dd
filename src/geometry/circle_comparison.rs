//! The paper's Table 1: how well a float polygon and a Bézier polygon of constant legs and
//! turning angles approximate a circle, measured by the evolute's largest distance from the
//! centre.

use std::f64::consts::TAU;

use glam::DVec3;

use super::bezier_polygon::BezierPolygon;
use super::error::PolygonError;
use super::float_polygon::FloatPolygon;

/// The radius of the circle in the paper.
pub const PAPER_RADIUS: f64 = 10.0;

/// The degrees of the paper's Table 1, with the sides of the regular polygon used for each.
pub const PAPER_ROWS: [(usize, usize); 4] = [(3, 6), (5, 12), (7, 12), (9, 12)];

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
    /// The float polygon lies on n + 1 consecutive corners. The Bézier polygon has n equal legs
    /// and n − 1 equal turning angles θ/(n − 1), θ the central angle of one side, from the
    /// B-spline segment's start to its end.
    ///
    /// # Errors
    /// [`PolygonError`] if the degree is out of range or the radius cannot be used.
    pub fn new(degree: usize, sides: usize, radius: f64) -> Result<Self, PolygonError> {
        let bspline = regular_polygon(degree, sides, radius)?;
        let bezier = equal_leg_bezier(&bspline, TAU / sides as f64)?.to_float()?;
        Ok(Self {
            degree,
            bspline: evolute_reach(&bspline),
            bezier: evolute_reach(&bezier),
        })
    }

    /// Compute the four rows of the paper.
    ///
    /// # Errors
    /// None for the paper's own figures.
    pub fn paper_table() -> Result<Vec<Self>, PolygonError> {
        let rows = PAPER_ROWS.iter();
        rows.map(|&(degree, sides)| Self::new(degree, sides, PAPER_RADIUS))
            .collect()
    }
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

/// Find the largest distance between the curve's evolute and the origin.
pub fn evolute_reach(polygon: &FloatPolygon) -> f64 {
    let distance = |u: f64| {
        let centre = polygon.jet(u).centre_of_curvature();
        centre.map_or(f64::INFINITY, |centre| centre.length())
    };
    let count = SAMPLES * polygon.segments();
    let step = polygon.segments() as f64 / count as f64;
    let samples: Vec<f64> = (0..=count)
        .map(|index| distance(index as f64 * step))
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
        if distance(left) < distance(right) {
            low = left;
        } else {
            high = right;
        }
    }
    distance(0.5 * (low + high)).max(samples[best])
}

fn equal_leg_bezier(segment: &FloatPolygon, turn: f64) -> Result<BezierPolygon, PolygonError> {
    let degree = segment.degree();
    let (start, end) = (segment.point(0.0), segment.point(1.0));
    let middle = 0.5 * (degree as f64 - 1.0);
    let between = turn / (degree.max(2) - 1) as f64;
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
    BezierPolygon::new(degree, vertices, None)
}
