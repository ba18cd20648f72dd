//! What harmonising is asked, and what it returns.

use glam::DVec3;
use thiserror::Error;

use super::counts::ShapeCounts;
use super::displaced_inflection::displaced_inflection;
use super::requirement::Requirement;
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::error::PolygonError;
use crate::geometry::features::Features;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::harmony;
use crate::geometry::polygon_figures::{FOLD, turning_angles};
use crate::geometry::progress::Progress;
use crate::geometry::symmetry::Symmetry;

/// A curve without some of the features that stand out must be so many times nearer than one with all of them.
const LOST: f64 = 3.0;

/// A curve with an inflection where it turned before must be so many times nearer than one without.
const DISPLACED: f64 = 3.0;

/// A fitted curve, whose vertices may lie anywhere, must be so many times nearer than the least change of them.
const REFITTED: f64 = 2.0;

/// A curve whose polygon folds must be so many times nearer than one whose polygon does not.
const FOLDED: f64 = 4.0;

/// Held values of an end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Held {
    /// Nothing.
    Free,
    /// The point.
    Position,
    /// Point and direction.
    Direction,
    /// Point, direction and curvature, in space with the osculating plane.
    Curvature,
    /// All these and the slope of the curvature.
    Slope,
    /// Everything up to the derivative of order n − 1: the curve beyond stays as it is.
    All,
}

/// Request for harmonising. Without a requested number of features no more may remain than
/// stand out: extrema that differ by at least 5 % of the extrema beside them, and the inflections
/// between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmony<'a> {
    /// The stretch [u₀, u₁] of the curve, of a periodic one with u₀ > u₁ over the seam; `None` for all
    /// of it.
    pub stretch: Option<[f64; 2]>,
    /// The held values of its two ends.
    pub ends: [Held; 2],
    /// The vertices that stay where they are.
    pub locked: &'a [usize],
    /// Wanted number of extrema of the curvature.
    pub extrema: Option<usize>,
    /// Wanted number of inflections; in space, of zeros of the torsion.
    pub inflections: Option<usize>,
    /// Wanted number of extrema of the torsion, in space.
    pub torsion_extrema: Option<usize>,
    /// Largest move of the curve, as a length.
    pub largest_deviation: Option<f64>,
    /// The rule that the polygon follows and shall follow; without effect on a stretch.
    pub symmetry: Option<Symmetry>,
}

impl Harmony<'_> {
    /// Make the rule hold for a polygon that was found; as it is without one, and where numbers overflow.
    pub(super) fn completed(&self, polygon: FloatPolygon) -> FloatPolygon {
        let symmetry = self.symmetry.filter(|_| self.stretch.is_none());
        let completed = symmetry.and_then(|it| it.completed(&polygon, |_| true).ok());
        completed.unwrap_or(polygon)
    }
}

/// Result of harmonising.
#[derive(Clone, Debug, PartialEq)]
pub struct Harmonised {
    /// The polygon with the least change that meets the request, or else the one that
    /// comes closest.
    pub polygon: FloatPolygon,
    /// Whether it meets the requirements.
    pub reached: bool,
    /// What the polygon must hold: proved features, ends, vertices, deviation.
    pub requirements: Vec<Requirement>,
    /// The requested numbers of features.
    pub request: ShapeCounts,
    /// The proved numbers of features.
    pub counts: ShapeCounts,
    /// The number of undecided places, cusps included.
    pub undecided: usize,
    /// How far the curve moves.
    pub deviation: f64,
    /// Whether that is a bound; otherwise samples show it.
    pub bounded: bool,
    /// The number of Gauss–Newton steps in all.
    pub iterations: usize,
    /// Whether the curve was fitted to the old one instead, because the least change did not do or moves it
    /// farther.
    pub refitted: bool,
    /// An inflection that lies where the curve turned before.
    pub displaced: Option<DVec3>,
}

/// Why a curve cannot be harmonised.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HarmonyError {
    /// The stretch is no part of the curve.
    #[error(
        "a stretch from u = {from} to {to} is no part of the curve: give two {} from 0 to {end}",
        if *periodic { "different numbers" } else { "rising numbers" }
    )]
    BadStretch {
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
        /// The largest parameter of the curve.
        end: f64,
        /// Whether the curve is periodic.
        periodic: bool,
    },
    /// A stretch over the seam leaves nothing where the curve could be cut.
    #[error(
        "a stretch from u = {from} over the seam to {to} leaves less than a segment: let a whole number lie between {to} and {from}, or harmonise the whole curve"
    )]
    NothingBeyond {
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// No vertex may move.
    #[error("no vertex may move: free the ends or vertices, or choose a longer stretch")]
    NothingMoves,
    /// The computation was ended early.
    #[error("harmonising was cancelled")]
    Cancelled,
    /// A vertex would leave the range of numbers.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

impl Harmonised {
    /// Distance from the request, and from the polygon that it was: a smaller one is better. A vertex that is flung away
    /// is the last resort.
    pub(super) fn rank(&self, before: &FloatPolygon) -> (bool, bool, f64) {
        let refitted = if self.refitted { REFITTED } else { 1.0 };
        let folded = if folds(before, &self.polygon) {
            FOLDED
        } else {
            1.0
        };
        let displaced = if self.displaced.is_some() {
            DISPLACED
        } else {
            1.0
        };
        let price = refitted * folded * displaced * self.priced(self.deviation);
        (!self.reached, flung(before, &self.polygon).is_some(), price)
    }

    /// A length that measures a change, the longer if features are lost.
    pub(super) fn priced(&self, length: f64) -> f64 {
        let price = if self.lacking() > 0 { LOST } else { 1.0 };
        price * length
    }

    /// The number of requested features that the curve has too few of.
    pub(super) fn lacking(&self) -> usize {
        self.counts.lacking(self.request)
    }

    /// Look for an inflection that the curve before, with these features, did not have there.
    pub(super) fn with_displaced(
        self,
        before: &FloatPolygon,
        of_before: &Features,
        progress: &Progress,
    ) -> Self {
        let features = Features::proved(&self.polygon, |_| !progress.is_cancelled());
        let displaced = features.and_then(|features| {
            displaced_inflection([before, &self.polygon], [of_before, &features])
        });
        Self { displaced, ..self }
    }

    /// Measure how far the curve is from the one that it was.
    pub(super) fn measure(&mut self, polygon: &FloatPolygon, progress: &Progress) {
        let measured = MeasuredDeviation::between(&self.polygon, polygon, progress);
        if let Some(measured) = measured.ok().filter(|it| it.bounded) {
            self.deviation = self.deviation.min(measured.largest);
        }
    }
}

/// How far a vertex moves, if that is farther than the polygon is large: it is no use then, however near the curve is.
pub fn flung(before: &FloatPolygon, after: &FloatPolygon) -> Option<(usize, f64)> {
    farthest_move(before, after).filter(|(_, distance)| *distance > before.size())
}

/// Whether a polygon turns back at a vertex where it did not before: nobody takes that for harmonious.
pub(super) fn folds(before: &FloatPolygon, after: &FloatPolygon) -> bool {
    let mut pairs = turning_angles(before).zip(turning_angles(after));
    pairs.any(|((_, before), (_, after))| before <= FOLD && after > FOLD)
}

/// The vertex that moves farthest, and how far.
pub fn farthest_move(before: &FloatPolygon, after: &FloatPolygon) -> Option<(usize, f64)> {
    let pairs = before.vertices().iter().zip(after.vertices());
    let moves = pairs.map(|(before, after)| after.distance(*before));
    moves.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Whether the discrete curvature of a polygon has the extrema and inflections of its curve, in their order; `None` if
/// the computation was cancelled.
pub fn follows(polygon: &FloatPolygon, progress: &Progress) -> Option<bool> {
    let features = Features::proved(polygon, |_| !progress.is_cancelled())?;
    let harmony = harmony::Harmony::of(polygon, &features);
    Some(harmony.curvature.verdict == harmony::Match::Agrees)
}
