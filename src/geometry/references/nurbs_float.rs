//! The float polygon of a B-spline on any knots, where it has one.

use glam::DVec4;

use super::nurbs::Nurbs;

use crate::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon, NearestFloat, PolygonError};

/// Knots this far from even places, in units of the interval, are even: files round them to 13 digits or more.
const EVEN: f64 = 1e-12;

/// A curve whose ends lie this near, in units of its largest coordinate, may be periodic.
const CLOSED: f64 = 1e-9;

/// What joins with smoothness n − 1 within rounding has no jump of a difference of order r above this times 2^r, in units
/// of the largest coordinate.
const SMOOTH: f64 = 1e-8;

/// No chain of more points is looked at: its conversion takes much memory, and nobody edits so many vertices.
const MOST_OF_CHAIN: usize = 1 << 18;

/// Up to this degree and size a polynomial curve on even clamped knots loses no digits on the way to its float polygon.
const PLAIN_DEGREE: usize = 3;
const PLAIN_SIZE: f64 = 1e100;

impl Nurbs {
    /// Find the float polygon of the same curve: there is one if its knots are those of a float, a clamped or a Bézier
    /// polygon, and its segments join with smoothness n − 1. A curve that closes with that smoothness is periodic.
    /// `None` for every other curve.
    pub fn float_polygon(&self) -> Option<NearestFloat> {
        let (n, count) = (self.degree(), self.points().len());
        let index = |knot: usize| knot as f64 - n as f64;
        let segments = (count - n) as f64;
        if self.has_knots(segments, index) {
            return self.unclamped().ok();
        }
        if self.has_knots(segments, |knot| index(knot).clamp(0.0, segments)) {
            let make = || ClampedPolygon::new(n, self.points().to_vec(), self.owned_weights());
            return self.converted(make, ClampedPolygon::nearest_periodic_float, |it| {
                it.nearest_float()
            });
        }
        if self.is_chain() && count <= MOST_OF_CHAIN && self.joins_smoothly() {
            let make = || BezierPolygon::new(n, self.points().to_vec(), self.owned_weights());
            return self.converted(make, BezierPolygon::nearest_periodic_float, |it| {
                it.nearest_float()
            });
        }
        None
    }

    /// Whether there is such a polygon: [`Nurbs::float_polygon`] is asked where its conversion may fail.
    pub fn has_float_polygon(&self) -> bool {
        let (n, segments) = (self.degree(), self.points().len() - self.degree());
        let clamped = |knot: usize| (knot as f64 - n as f64).clamp(0.0, segments as f64);
        let is_plain = n <= PLAIN_DEGREE
            && self.weights().is_none()
            && self
                .points()
                .iter()
                .all(|it| it.abs().max_element() <= PLAIN_SIZE);
        is_plain && self.has_knots(segments as f64, clamped) || self.float_polygon().is_some()
    }

    /// Whether it is a chain of Béziers that is too long for a conversion, though it may join smoothly.
    pub fn is_long_chain(&self) -> bool {
        self.points().len() > MOST_OF_CHAIN && self.is_chain() && self.joins_smoothly()
    }

    /// Whether the knots are those of Béziers of one length.
    fn is_chain(&self) -> bool {
        let (n, count) = (self.degree(), self.points().len());
        let segments = (count - 1) as f64 / n as f64;
        let repeated = |knot: usize| ((knot - 1) as f64 / n as f64).floor().clamp(0.0, segments);
        segments.fract() == 0.0 && self.has_knots(segments, repeated)
    }

    /// Whether the knots stand at given places of an interval of so many segments. The first and the last knot have no
    /// effect.
    fn has_knots(&self, segments: f64, place: impl Fn(usize) -> f64) -> bool {
        let [from, to] = self.interval();
        let is_there = |index: usize| {
            let place = from + (to - from) * (place(index) / segments);
            (self.knots()[index] - place).abs() <= EVEN * (to - from)
        };
        (1..self.knots().len() - 1).all(is_there)
    }

    /// Whether the derivatives up to n − 1 go on at all joints of Bézier segments, as far as a glance at the points beside
    /// them tells: in homogeneous coordinates the differences of these are alike at both sides.
    fn joins_smoothly(&self) -> bool {
        let (n, points) = (self.degree(), self.points());
        let mut inner = (n..points.len() - 1).step_by(n);
        let sizes = points.iter().map(|it| it.abs().max_element());
        let size = sizes.fold(0.0, f64::max);
        let homogeneous = |index: usize| {
            let weight = self.weights().map_or(1.0, |it| it[index]);
            (weight * points[index]).extend(size * weight)
        };
        inner.all(|joint| {
            let mut sides = [
                (0..n)
                    .map(|it| homogeneous(joint - it))
                    .collect::<Vec<DVec4>>(),
                (0..n)
                    .map(|it| homogeneous(joint + it))
                    .collect::<Vec<DVec4>>(),
            ];
            let weights = sides.iter().flatten().map(|it| it.w);
            // The last coordinate is the weight times the size.
            let largest = weights.fold(0.0, f64::max);
            (1..n).all(|order| {
                for side in &mut sides {
                    for index in 0..n - order {
                        side[index] = side[index + 1] - side[index];
                    }
                }
                // Against the parameter odd differences change their sign.
                let sign = if order % 2 == 0 { 1.0 } else { -1.0 };
                let jump = sides[1][0] - sign * sides[0][0];
                jump.length() <= SMOOTH * largest * (1_u64 << order) as f64
            })
        })
    }

    /// The curve on even knots, whose points are the float vertices.
    fn unclamped(&self) -> Result<NearestFloat, PolygonError> {
        let n = self.degree();
        let segments = self.points().len() - n;
        let repeats = |index: usize| {
            let is_same = |weights: &[f64]| weights[index] == weights[segments + index];
            let is_there = self.points()[index] == self.points()[segments + index];
            is_there && self.weights().is_none_or(is_same)
        };
        let is_periodic = segments > n && (0..n).all(repeats);
        let count = if is_periodic { segments } else { segments + n };
        let weights = self.weights().map(|weights| weights[..count].to_vec());
        let polygon = FloatPolygon::new(n, self.points()[..count].to_vec(), weights, is_periodic)?;
        Ok(NearestFloat {
            polygon,
            deviation: 0.0,
            is_close: true,
        })
    }

    /// The float polygon of another polygon of the curve: periodic where it closes smoothly.
    fn converted<P>(
        &self,
        make: impl Fn() -> Result<P, PolygonError>,
        periodic: impl Fn(&P) -> Result<NearestFloat, PolygonError>,
        open: impl Fn(&P) -> Result<NearestFloat, PolygonError>,
    ) -> Option<NearestFloat> {
        let polygon = make().ok()?;
        let points = self.points();
        let sizes = points.iter().map(|it| it.abs().max_element());
        let gap = points[0].distance(points[points.len() - 1]);
        let closes = gap <= CLOSED * sizes.fold(0.0, f64::max);
        let closed = closes.then(|| periodic(&polygon).ok()).flatten();
        closed.or_else(|| open(&polygon).ok())
    }

    fn owned_weights(&self) -> Option<Vec<f64>> {
        self.weights().map(<[f64]>::to_vec)
    }
}
