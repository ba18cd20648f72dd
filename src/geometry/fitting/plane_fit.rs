//! What is asked of a fit of planar points.

use glam::DVec2;

use super::symmetry_axis::SymmetryAxis;

/// The number of extrema that is wished.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Extrema {
    /// The fewest with which the tolerance is kept.
    #[default]
    Fewest,
    /// Just so many.
    Exactly(usize),
}

impl Extrema {
    /// The number asked for.
    pub fn number(self) -> Option<usize> {
        match self {
            Self::Fewest => None,
            Self::Exactly(number) => Some(number),
        }
    }
}

/// What is asked of a fit in the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlaneFit {
    /// The degree.
    pub degree: usize,
    /// Whether the curve is periodic; the last point is then followed by the first one.
    pub periodic: bool,
    /// The number of vertices; `None` for as many as it takes.
    pub count: Option<usize>,
    /// The most vertices; `None` for half the number of points, at most 40, or 80 with a tolerance.
    pub most: Option<usize>,
    /// The number of curvature extrema.
    pub extrema: Extrema,
    /// The number of inflections; `None` for any.
    pub inflections: Option<usize>,
    /// The largest distance of points that count; `None` for 5e-4 of the size, or three times the noise.
    pub tolerance: Option<f64>,
    /// Whether the curve begins just at the first point, and ends just at the last one.
    pub exact_ends: [bool; 2],
    /// Unit tangents at the ends.
    pub directions: [Option<DVec2>; 2],
    /// Signed curvatures at the ends.
    pub curvatures: [Option<f64>; 2],
    /// The points that do not count, from 0; `None` for those that stand out.
    pub outliers: Option<Vec<usize>>,
    /// The axis in which the curve is its own mirror image. An open one has an odd number of extrema then, and an
    /// even one of inflections; the conditions at the start count for the end too.
    pub mirror: Option<SymmetryAxis>,
    /// Whether more numbers of extrema are tried than it takes, to tell what each of them reaches.
    pub lists_trade_off: bool,
    /// Whether the points are samples of a curve. They tell how it ends; other points hardly do.
    pub of_curve: bool,
    /// How much each point counts; `None` if all count the same. Those of weight 0 do not count.
    pub weights: Option<Vec<f64>>,
}
