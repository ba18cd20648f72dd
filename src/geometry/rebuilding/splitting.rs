//! Parts of a curve.

use super::kept_ends::with_ends;
use crate::geometry::conversion::approximation::Approximation;
use crate::geometry::conversion::deviation::from_part;
use crate::geometry::conversion::quasi_interpolation::{NewKnots, quasi_interpolated};
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;

/// Most subdivisions that bring a knot to a cut.
pub const MAX_SUBDIVISIONS: u32 = 12;

/// Most segments of a part: more than any drawn curve needs.
pub const MAX_PART_SEGMENTS: usize = 100_000;

impl FloatPolygon {
    /// Take the part of the curve between any two parameters, as an open curve.
    ///
    /// If up to `subdivisions` halvings of the segments (never more than [`MAX_SUBDIVISIONS`])
    /// bring knots to both places, they are made and the part is exact. Otherwise it is a uniform
    /// curve over (`to` − `from`) · 2^`subdivisions` segments, rounded up, near the curve: exact
    /// but for rounding where no knot lies between, else nearest to it as in [`FloatPolygon::refitted`], with an
    /// error that falls with the (n + 1)-th power of the length of its segments; its ends and end tangents are kept.
    ///
    /// # Errors
    /// [`PolygonError::NoSuchPart`] if the part is empty or leaves the curve, also for what is not a
    /// number; [`PolygonError::TooManySegments`] if it had more than [`MAX_PART_SEGMENTS`];
    /// [`PolygonError::WeightLost`] or [`PolygonError::Overflow`] if the part cannot
    /// be held.
    pub fn trimmed(
        &self,
        from: f64,
        to: f64,
        subdivisions: u32,
    ) -> Result<Approximation, PolygonError> {
        self.check_part(from, to)?;
        let most = subdivisions.min(MAX_SUBDIVISIONS);
        let factor = |halvings: u32| f64::from(1_u32 << halvings);
        let is_knot = |u: f64, halvings| (u * factor(halvings)).fract() == 0.0;
        let needed = (0..=most).find(|halvings| is_knot(from, *halvings) && is_knot(to, *halvings));
        let segments = ((to - from) * factor(needed.unwrap_or(most))).ceil();
        if segments > MAX_PART_SEGMENTS as f64 {
            let (segments, most) = (segments as usize, MAX_PART_SEGMENTS);
            return Err(PolygonError::TooManySegments { segments, most });
        }
        let Some(halvings) = needed else {
            return self.trimmed_near(from, to, segments);
        };
        // Only the segments that the part touches are subdivided.
        let (first, last) = (from.floor(), to.ceil());
        let mut part = self.window(first as usize..last as usize + self.degree())?;
        for _ in 0..halvings {
            part = part.subdivided()?;
        }
        let knot = |u: f64| ((u - first) * factor(halvings)) as usize;
        let part = part.window(knot(from)..knot(to) + self.degree())?;
        Ok(Approximation::exact(part))
    }

    /// Cut an open curve at any parameter into the parts before and behind it, each as
    /// [`FloatPolygon::trimmed`] takes it.
    ///
    /// # Errors
    /// As [`FloatPolygon::trimmed`], and [`PolygonError::PeriodicCurve`] for a periodic curve.
    pub fn split(
        &self,
        at: f64,
        subdivisions: u32,
    ) -> Result<(Approximation, Approximation), PolygonError> {
        self.check_open("cut in two at one place")?;
        let before = self.trimmed(0.0, at, subdivisions)?;
        Ok((
            before,
            self.trimmed(at, self.segments() as f64, subdivisions)?,
        ))
    }

    fn trimmed_near(
        &self,
        from: f64,
        to: f64,
        segments: f64,
    ) -> Result<Approximation, PolygonError> {
        let step = (to - from) / segments;
        let knots = NewKnots {
            degree: self.degree(),
            start: from,
            step,
            segments: segments as usize,
            periodic: false,
        };
        // One polynomial stays what it is.
        let is_one = from.floor() + 1.0 >= to;
        let polygon = match is_one {
            true => quasi_interpolated(self, &knots)?,
            false => self.nearest_on(&knots)?,
        };
        let polygon = with_ends(polygon, [from, to].map(|u| self.jet(u)));
        Ok(Approximation {
            deviation: from_part(self, from, step, &polygon),
            polygon,
            exact: false,
        })
    }

    fn check_part(&self, from: f64, to: f64) -> Result<(), PolygonError> {
        let segments = self.segments();
        let last = segments as f64;
        let inside = if self.is_periodic() {
            (0.0..last).contains(&from) && to - from <= last
        } else {
            from >= 0.0 && to <= last
        };
        if inside && from < to {
            Ok(())
        } else {
            Err(PolygonError::NoSuchPart { from, to, segments })
        }
    }
}
