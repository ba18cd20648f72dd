//! Requirements of a curve, and the one check of whether it holds them.

use glam::DVec3;

use super::counts::{CountRequest, counted};
use crate::geometry::end_correction::{EndDifference, EndTarget};
use crate::geometry::features::Features;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;
use crate::geometry::progress::Progress;
use crate::geometry::vector;

/// The residual, in units of the curve's size, above which points and directions count as not met.
const MET: f64 = 1e-11;

/// The same for curvatures and their slopes, in units of the larger of what is asked and 1 over the
/// size, and over its square.
const CURVATURE_MET: f64 = 1e-10;

/// Rounding error of a vertex and of combinations of its coordinates, in units of the largest.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The share of its speed with which a place counts as stopped: a cusp in the making.
const STOPPED: f64 = 1e-3;

/// One thing that is asked of a curve.
#[derive(Clone, Debug, PartialEq)]
pub enum Requirement {
    /// Numbers of features, proved, with nothing undecided.
    Features {
        /// The stretch [u₀, u₁] that counts, of a periodic curve with u₀ > u₁ over the seam; `None` for the curve.
        stretch: Option<[f64; 2]>,
        /// The numbers.
        request: CountRequest,
    },
    /// Values at a place.
    Place(PlaceRequest),
    /// A vertex that stays.
    Vertex {
        /// Its number.
        vertex: usize,
        /// Where it is.
        point: DVec3,
    },
    /// A measured length that must not be larger than another one.
    Limit {
        /// The length.
        found: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// What a search that failed was for; it never holds.
    Failed {
        /// What was left, as a length, of the nearest that was tried.
        left: Option<f64>,
    },
}

/// Values that a curve must have at a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceRequest {
    /// The parameter u.
    pub u: f64,
    /// The values.
    pub target: EndTarget,
    /// How far the curve may miss them, as [`EndDifference::residual`] measures it; `None` for rounding alone.
    pub tolerance: Option<f64>,
    /// The speed |C′(u)| before: a curve that stops where a direction is asked for has none. `None` where only
    /// the present one matters.
    pub speed: Option<f64>,
}

/// Whether requirements hold, and by how much they are missed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Check {
    /// Whether all of them hold.
    pub holds: bool,
    /// The largest miss as a length, of all but the features; `None` if features alone are asked for.
    pub residual: Option<f64>,
}

impl Check {
    /// Check a polygon; `None` if `progress` is cancelled while features are proved.
    pub fn of(
        requirements: &[Requirement],
        polygon: &FloatPolygon,
        progress: &Progress,
    ) -> Option<Self> {
        let asks = |it: &Requirement| matches!(it, Requirement::Features { .. });
        let features = match requirements.iter().any(asks) {
            true => Some(Features::proved(polygon, |_| !progress.is_cancelled())?),
            false => None,
        };
        Some(Self::with_features(
            requirements,
            polygon,
            features.as_ref(),
        ))
    }

    /// Check a polygon whose features are known.
    pub(super) fn with_features(
        requirements: &[Requirement],
        polygon: &FloatPolygon,
        features: Option<&Features>,
    ) -> Self {
        let mut check = Self {
            holds: true,
            residual: None,
        };
        let size = polygon.size();
        for requirement in requirements {
            let (holds, left) = match requirement {
                Requirement::Features { stretch, request } => {
                    let has = features.is_some_and(|features| {
                        counted(features, polygon.is_planar(), *stretch).has(*request)
                    });
                    (has, None)
                }
                Requirement::Place(place) => (
                    place.is_met(polygon, size),
                    Some(place.residual(polygon, size)),
                ),
                Requirement::Vertex { vertex, point } => {
                    let found = polygon.vertices().get(*vertex);
                    let left = found.map(|found| vector::length(*found - *point));
                    (left == Some(0.0), left)
                }
                Requirement::Limit { found, most } => {
                    (found <= most, Some((found - most).max(0.0)))
                }
                Requirement::Failed { left } => (false, *left),
            };
            check.add(holds, left);
        }
        check
    }

    /// Count another check in.
    pub fn and(mut self, other: Self) -> Self {
        self.add(other.holds, other.residual);
        self
    }

    fn add(&mut self, holds: bool, left: Option<f64>) {
        self.holds &= holds;
        self.residual = match (self.residual, left) {
            (Some(a), Some(b)) => Some(vector::larger(a, b)),
            (a, b) => a.or(b),
        };
    }
}

impl PlaceRequest {
    /// Whether a curve has the values: the tangent points where it should, the curve has not stopped, and what is
    /// missing is within the tolerance, or rounding.
    ///
    /// `size` is the length by which angles, curvatures and slopes are measured.
    pub(super) fn is_met(&self, polygon: &FloatPolygon, size: f64) -> bool {
        let jet = polygon.jet(self.u);
        if !self.points_forward(&jet) || self.is_stopped(&jet) {
            return false;
        }
        match self.tolerance {
            Some(tolerance) => self.difference(polygon).residual(size) <= tolerance,
            None => self.is_met_but_for_rounding(polygon, size),
        }
    }

    fn difference(&self, polygon: &FloatPolygon) -> EndDifference {
        let planar = polygon.is_planar() && self.target.is_planar();
        EndDifference::of_jet(&polygon.jet(self.u), planar, &self.target)
    }

    fn residual(&self, polygon: &FloatPolygon, size: f64) -> f64 {
        self.difference(polygon).residual(size)
    }

    /// A backward tangent is half a turn away from its target, however small the curve is.
    fn points_forward(&self, jet: &Jet) -> bool {
        let along = |direction: DVec3| jet.first.dot(direction) > 0.0;
        self.target.direction.is_none_or(along)
    }

    /// An end that has all but stopped would make anything of derivatives.
    fn is_stopped(&self, jet: &Jet) -> bool {
        let target = &self.target;
        let bends = target.curvature.is_some() || target.slope.is_some();
        let asks = bends || target.direction.is_some();
        asks && self
            .speed
            .is_some_and(|before| jet.speed() < STOPPED * before)
    }

    fn is_met_but_for_rounding(&self, polygon: &FloatPolygon, size: f64) -> bool {
        let left = self.difference(polygon);
        let placed = EndDifference {
            curvature: 0.0,
            slope: 0.0,
            ..left
        };
        let scale = size.max(vector::reach(polygon.vertices()));
        // What the rounding of vertices makes of derivatives.
        let speed = polygon.jet(self.u).speed();
        let rounding = ROUNDING * scale / (speed * speed);
        let close = |left: f64, wanted: Option<f64>, unit: f64, rounding: f64| {
            let wanted = wanted.map_or(unit, |wanted| wanted.abs().max(unit));
            left.abs() <= (CURVATURE_MET * wanted).max(rounding)
        };
        let target = &self.target;
        placed.residual(size) <= MET * scale
            && close(left.curvature, target.curvature, size.recip(), rounding)
            && close(
                left.slope,
                target.slope,
                (size * size).recip(),
                rounding / speed,
            )
    }
}
