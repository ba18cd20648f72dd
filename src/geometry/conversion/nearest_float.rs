//! The float polygon that doubles allow for a curve given by its clamped or Bézier polygon.
//!
//! Usually it is the exact conversion, rounded: its curve is that of the given polygon but for a few
//! roundings. This fails where the float vertices are so large that their own rounding shows (from
//! degree 12 on rounding of the given vertices makes them so), or where each comes from another
//! Bézier segment. Then it is the nearest curve of several least-squares fits.

use super::amplification::double_factorial;
use super::bezier_polygon::BezierPolygon;
use super::chain_deviation::{chain_deviation, reach};
use super::chain_fit::ChainFit;
use super::clamped_polygon::ClampedPolygon;
use super::closing::{check_periodic, worst_difference};
use super::exact_polygon::ExactPolygon;
use super::exact_vertices::ExactVertices;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

/// How far, in units in the last place of the largest coordinate, a curve may be off that counts
/// as the one given.
const CLOSE_ULPS: f64 = 4.0;

/// How far, in units of the largest coordinate, polygons may lie from a smooth curve: decimal
/// rounding to ten digits is not refused, what single-precision writers leave is.
const SMOOTHNESS_TOLERANCE: f64 = 1e-9;

/// The same where a curve that has a float polygon is farther off for want of digits.
const DIGITS_TOLERANCE: f64 = 1e-6;

/// Factor by which the curve of a preferred polygon may be farther off.
const PREFERENCE: f64 = 4.0;

/// The force of a fit, in units of the curve's own: half a unit in the last place of 1, which
/// rounding moves the vertices by.
const FORCE: f64 = 0.5 * f64::EPSILON;

/// The forces tried where rounding has left no positive weights: those of decimals of ten to twelve
/// digits.
const DECIMAL_FORCES: [f64; 3] = [1e-11, 1e-10, 1e-9];

/// The force that holds a vertex where it is.
const STIFF: f64 = (1_u64 << 30) as f64;

/// The smallest weight of a fit that is believed, in units of the curve's weight there.
const BELIEVED: f64 = 1e-6;

/// The highest degree whose Bézier vertices, taken each from another segment, keep the curve.
const DIRECT_DEGREE: usize = 4;

/// The highest degree whose fits two doubles a number hold: the square of the condition, (2n − 1)!!
/// at most, leaves 56 bits.
const DOUBLE_DOUBLE_DEGREE: usize = 9;

/// Float polygon that stands for a clamped or Bézier polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct NearestFloat {
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// A proved bound of the distance between the two curves at equal parameters.
    pub deviation: f64,
    /// Whether that is at most four units in the last place of the largest coordinate given.
    pub is_close: bool,
}

impl BezierPolygon {
    /// Find the float polygon whose open curve is nearest to this one.
    ///
    /// # Errors
    /// [`PolygonError::NotSmooth`] if the segments are not one curve of smoothness n − 1 on
    /// uniform knots, within 1e-9 of the largest coordinate; [`PolygonError::DigitsLost`] if no
    /// float polygon in doubles holds a single segment within 1e-6 of it;
    /// [`PolygonError::WeightLost`] and [`PolygonError::Overflow`] as in
    /// [`ClampedPolygon::to_float`].
    pub fn nearest_float(&self) -> Result<NearestFloat, PolygonError> {
        let segments = self.segments();
        let target = Target::new(ExactPolygon::from_bezier(self), false);
        let exact = || ExactPolygon::from_bezier(self).to_float();
        let nearest = if segments == 1 || self.degree() <= DIRECT_DEGREE {
            target.nearest(exact(), None)?
        } else {
            match target.nearest_fit(None, None) {
                Some(nearest) => nearest,
                None => target.measured(exact()?),
            }
        };
        let tolerance = if segments == 1 {
            DIGITS_TOLERANCE
        } else {
            SMOOTHNESS_TOLERANCE
        };
        target.checked(nearest, tolerance, |polygon| {
            let (index, distance) = worst_difference(self, &Self::from_float(polygon));
            if segments == 1 {
                PolygonError::DigitsLost { index, distance }
            } else {
                PolygonError::NotSmooth { index, distance }
            }
        })
    }

    /// Find the float polygon whose periodic curve is nearest to this one: the way back from
    /// [`BezierPolygon::from_float`] of a periodic polygon.
    ///
    /// # Errors
    /// [`PolygonError::NotPeriodic`] if the curve does not close with smoothness n − 1, within
    /// 1e-9 of the largest coordinate; [`PolygonError::TooFewVertices`] if it has fewer than n + 1
    /// segments; and as [`BezierPolygon::nearest_float`].
    pub fn nearest_periodic_float(&self) -> Result<NearestFloat, PolygonError> {
        check_periodic(self.degree(), self.segments())?;
        let given = ExactPolygon::from_bezier(self);
        let exact = given.periodic_blossoms().to_periodic_float();
        let worst = |polygon: &FloatPolygon| worst_difference(self, &Self::from_float(polygon));
        nearest_periodic(given, exact, PolygonKind::Bezier, worst)
    }
}

impl ClampedPolygon {
    /// Find the float polygon whose open curve is nearest to this one: that of
    /// [`ClampedPolygon::to_float`] unless its vertices are so large that their rounding shows.
    /// Vertices that do not change stay as they are, bit for bit.
    ///
    /// # Errors
    /// [`PolygonError::DigitsLost`] if no float polygon in doubles holds the curve within 1e-6 of
    /// its largest coordinate, and as [`ClampedPolygon::to_float`].
    pub fn nearest_float(&self) -> Result<NearestFloat, PolygonError> {
        let ends = self.ends()?;
        let target = Target::new(ExactPolygon::from_clamped(&ends), false);
        let nearest = target.nearest(ends.to_float(), Some(&ends))?;
        let nearest = target.checked(nearest, DIGITS_TOLERANCE, |polygon| {
            let (index, distance) = worst_difference(&ends, &Self::from_float(polygon));
            let left_out = self.vertices().len() - ends.vertices().len();
            let in_last_half = index >= ends.vertices().len() / 2;
            let index = index + if in_last_half { left_out } else { 0 };
            PolygonError::DigitsLost { index, distance }
        })?;
        Ok(NearestFloat {
            polygon: self.with_ends_of(&nearest.polygon)?,
            ..nearest
        })
    }

    /// Find the float polygon whose periodic curve is nearest to this one: the way back from
    /// [`ClampedPolygon::from_float`] of a periodic polygon.
    ///
    /// # Errors
    /// As [`BezierPolygon::nearest_periodic_float`].
    pub fn nearest_periodic_float(&self) -> Result<NearestFloat, PolygonError> {
        check_periodic(self.degree(), self.segments())?;
        let given = ExactPolygon::from_clamped(self);
        let exact = given.float_form().folded().to_periodic_float();
        let worst = |polygon: &FloatPolygon| worst_difference(self, &Self::from_float(polygon));
        nearest_periodic(given, exact, PolygonKind::Clamped, worst)
    }

    /// Leave out the middle: ends convert alike where 2n vertices of each are there.
    fn ends(&self) -> Result<Self, PolygonError> {
        let (kept, count) = (2 * self.degree(), self.vertices().len());
        if count <= 2 * kept {
            return Ok(self.clone());
        }
        let vertices = both_ends(self.vertices(), kept);
        let weights = self.weights().map(|weights| both_ends(weights, kept));
        Self::new(self.degree(), vertices, weights)
    }

    /// Put the converted ends, the first and the last n − 1 vertices, in their places.
    fn with_ends_of(&self, ends: &FloatPolygon) -> Result<FloatPolygon, PolygonError> {
        if ends.vertices().len() == self.vertices().len() {
            return Ok(ends.clone());
        }
        let changed = self.degree() - 1;
        let vertices = with_ends(self.vertices(), ends.vertices(), changed);
        let weights = self.weights().zip(ends.weights());
        let weights = weights.map(|(weights, ends)| with_ends(weights, ends, changed));
        FloatPolygon::new(self.degree(), vertices, weights, false)
    }

    /// Whether a vertex is one of the float polygon too.
    fn keeps(&self, index: usize) -> bool {
        let changed = self.degree() - 1;
        index >= changed && index + changed < self.vertices().len()
    }
}

/// Find the float polygon whose periodic curve is nearest to a given polygon's; `exact` is what it
/// is but for rounding, `worst` finds the vertex of the given one that another curve misses most.
fn nearest_periodic(
    given: ExactPolygon,
    exact: Result<FloatPolygon, PolygonError>,
    from: PolygonKind,
    worst: impl FnOnce(&FloatPolygon) -> (usize, f64),
) -> Result<NearestFloat, PolygonError> {
    let target = Target::new(given, true);
    let nearest = target.nearest(exact, None)?;
    target.checked(nearest, SMOOTHNESS_TOLERANCE, |polygon| {
        let (index, distance) = worst(polygon);
        PolygonError::NotPeriodic {
            from,
            index,
            distance,
        }
    })
}

fn both_ends<T: Copy>(list: &[T], kept: usize) -> Vec<T> {
    [&list[..kept], &list[list.len() - kept..]].concat()
}

fn with_ends<T: Copy>(list: &[T], ends: &[T], changed: usize) -> Vec<T> {
    let middle = &list[changed..list.len() - changed];
    [&ends[..changed], middle, &ends[ends.len() - changed..]].concat()
}

/// The curve that a float polygon is looked for.
struct Target {
    degree: usize,
    chain: ExactVertices<3>,
    periodic: bool,
    /// The largest coordinate of the Bézier vertices.
    reach: f64,
}

impl Target {
    fn new(given: ExactPolygon, periodic: bool) -> Self {
        let chain = given.bezier_form();
        Self {
            degree: given.degree(),
            reach: reach(chain.vertices()),
            chain: chain.vertices().clone(),
            periodic,
        }
    }

    /// Take the exact polygon if it is close, else the nearest of it and the fits.
    fn nearest(
        &self,
        exact: Result<FloatPolygon, PolygonError>,
        kept: Option<&ClampedPolygon>,
    ) -> Result<NearestFloat, PolygonError> {
        let measured = exact.map(|polygon| self.measured(polygon));
        if let Ok(nearest) = &measured
            && nearest.is_close
        {
            return measured;
        }
        if let Err(error) = &measured
            && !self.is_explained(error)
        {
            return measured;
        }
        match (self.nearest_fit(measured.as_ref().ok(), kept), measured) {
            (Some(fitted), Ok(exact)) => Ok(self.with_axes_of(&exact, fitted)),
            (Some(fitted), Err(_)) => Ok(fitted),
            (None, measured) => measured,
        }
    }

    /// Put the exact coordinates of an axis, each rounded by itself, in place of those of a fit,
    /// as far as the curve allows: the axes of a polynomial curve do not depend on each other.
    fn with_axes_of(&self, exact: &NearestFloat, fitted: NearestFloat) -> NearestFloat {
        if self.chain.is_rational() {
            return fitted;
        }
        (0..3).fold(fitted, |nearest, axis| {
            let mut vertices = nearest.polygon.vertices().to_vec();
            for (vertex, exact) in vertices.iter_mut().zip(exact.polygon.vertices()) {
                vertex[axis] = exact[axis];
            }
            let polygon = FloatPolygon::new(self.degree, vertices, None, self.periodic);
            let tried = polygon.map(|polygon| self.measured(polygon));
            tried
                .ok()
                .filter(|tried| tried.is_close || tried.deviation <= nearest.deviation)
                .unwrap_or(nearest)
        })
    }

    /// Whether the rounding of the given weights explains that a weight is lost.
    fn is_explained(&self, error: &PolygonError) -> bool {
        let PolygonError::WeightLost { weight, .. } = error else {
            return false;
        };
        let largest = self.chain.largest_weight();
        let explained = FORCE * double_factorial(self.degree) * largest;
        weight + explained > BELIEVED * largest
    }

    /// Find the fit whose curve is nearest, unless `exact` is preferred.
    fn nearest_fit(
        &self,
        exact: Option<&NearestFloat>,
        kept: Option<&ClampedPolygon>,
    ) -> Option<NearestFloat> {
        if self.degree <= DOUBLE_DOUBLE_DEGREE {
            self.nearest_fit_with::<2>(exact, kept)
        } else {
            self.nearest_fit_with::<3>(exact, kept)
        }
    }

    fn nearest_fit_with<const K: usize>(
        &self,
        exact: Option<&NearestFloat>,
        kept: Option<&ClampedPolygon>,
    ) -> Option<NearestFloat> {
        let chain = self.chain.resized::<K>();
        let fit = ChainFit::new(self.degree, &chain, self.periodic);
        let keeps = |index| kept.is_some_and(|clamped| clamped.keeps(index));
        let places = match kept {
            Some(clamped) => {
                let known = ExactPolygon::from_clamped(clamped).vertices().resized();
                fit.places().map_with(&known, |places, known| {
                    let choose = |index| if keeps(index) { known } else { places }[index];
                    (0..places.len()).map(choose).collect()
                })
            }
            None => fit.places(),
        };
        let stiff = fit.even_forces(STIFF);
        let attempt = |mut forces: Vec<f64>| {
            for (index, force) in forces.iter_mut().enumerate() {
                if keeps(index) {
                    *force = stiff[index];
                }
            }
            let vertices = fit.solved(&places, &forces)?;
            self.believed(&vertices, &places, kept)
        };
        let even = attempt(fit.even_forces(FORCE));
        if even.as_ref().is_some_and(|even| even.is_close) {
            return even;
        }
        // Vertices with more than their own rounding: a force as large as their error keeps the
        // float polygon from following it.
        let forces = even.as_ref().map_or(DECIMAL_FORCES.to_vec(), |even| {
            vec![(even.deviation / self.reach).clamp(FORCE, SMOOTHNESS_TOLERANCE)]
        });
        let gentle = forces
            .into_iter()
            .filter_map(|force| attempt(fit.even_forces(force)))
            .min_by(|a, b| a.deviation.total_cmp(&b.deviation));
        let loose = attempt(fit.curve_forces(FORCE));
        let candidates = [exact.cloned(), gentle, even, loose];
        let deviations = candidates.iter().flatten().map(|c| c.deviation);
        let least = deviations.fold(f64::INFINITY, f64::min);
        let mut candidates = candidates.into_iter().flatten();
        candidates.find(|candidate| candidate.deviation <= PREFERENCE * least)
    }

    /// Round a fit to a polygon; `None` if it has a weight far below the curve's own.
    fn believed<const K: usize>(
        &self,
        vertices: &ExactVertices<K>,
        places: &ExactVertices<K>,
        kept: Option<&ClampedPolygon>,
    ) -> Option<NearestFloat> {
        let (mut points, mut weights) = vertices.all_rounded();
        if let Some(clamped) = kept {
            for index in (0..points.len()).filter(|index| clamped.keeps(*index)) {
                points[index] = clamped.vertices()[index];
                if let (Some(weights), Some(given)) = (&mut weights, clamped.weights()) {
                    weights[index] = given[index];
                }
            }
        }
        let mut numbered = weights.iter().flatten().enumerate();
        if !numbered.all(|(index, weight)| *weight > BELIEVED * places.rounded(index).1) {
            return None;
        }
        let polygon = FloatPolygon::new(self.degree, points, weights, self.periodic).ok()?;
        Some(self.measured(polygon))
    }

    fn measured(&self, polygon: FloatPolygon) -> NearestFloat {
        let deviation = chain_deviation(&self.chain.resized(), &polygon);
        NearestFloat {
            polygon,
            deviation,
            is_close: deviation <= CLOSE_ULPS * (self.reach.next_up() - self.reach),
        }
    }

    /// Refuse a polygon whose curve is another one.
    fn checked(
        &self,
        nearest: NearestFloat,
        tolerance: f64,
        reason: impl FnOnce(&FloatPolygon) -> PolygonError,
    ) -> Result<NearestFloat, PolygonError> {
        // Written so that a deviation that is not a number is refused too.
        if nearest.deviation <= tolerance * self.reach {
            Ok(nearest)
        } else {
            Err(reason(&nearest.polygon))
        }
    }
}
