//! A reference curve: a form over an interval, placed.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;

use super::error::ReferenceError;
use super::form::ReferenceForm;
use super::placement::Placement;
use crate::geometry::control_polygon::MAX_MAGNITUDE;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::interval::Interval;
use crate::geometry::parametric_curve::ParametricCurve;
use crate::geometry::power_series::PowerSeries;
use crate::geometry::vector;

/// Samples by which the turning of a curve is estimated.
const SAMPLES: usize = 256;

/// The same of a curve that turns one way, by a turn at most, and so by less than half a turn between two of them: what it
/// turns between them adds up to all of it.
const ONE_WAY_SAMPLES: usize = 16;
const WHOLE_TURN: f64 = 1.01 * TAU;

/// The share of a piece by which rounding adds no other piece.
const ROUNDING: f64 = 1e-9;

/// A piece may turn by about so much.
const PIECE_TURNING: f64 = std::f64::consts::FRAC_PI_4;

/// A curve that moves by no more than this share of its coordinates over the whole interval is one point.
const STANDING: f64 = 8.0 * f64::EPSILON;

/// The numbers of pieces of a smooth curve.
const PIECES: std::ops::RangeInclusive<usize> = 8..=1024;

/// Form with the interval of its own parameter t that is drawn, and its placement.
///
/// As a [`ParametricCurve`] it has pieces over even parts of the interval, each of a moderate turning,
/// and as many continuous derivatives as one likes; points have a piece for each straight line
/// between two of them, and no continuous derivative; a B-spline has pieces between its knots.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceCurve {
    form: ReferenceForm,
    interval: [f64; 2],
    placement: Placement,
    pieces: usize,
    /// The ends of the pieces of a B-spline; empty where pieces are even.
    breaks: Arc<[f64]>,
}

impl ReferenceCurve {
    /// Draw a form from t = `from` to t = `to`, placed. Points are drawn in whole, whatever the
    /// interval: point i stands at t = i.
    ///
    /// # Errors
    /// [`ReferenceError::EmptyInterval`], [`ReferenceError::OutsideDomain`],
    /// [`ReferenceError::NotFinite`] if points or directions of the curve leave the range of numbers, and
    /// [`ReferenceError::OnePoint`] if it does not move.
    pub fn new(
        form: ReferenceForm,
        [from, to]: [f64; 2],
        placement: Placement,
    ) -> Result<Self, ReferenceError> {
        if let Some(points) = form.row() {
            return Ok(Self {
                interval: form.default_interval(),
                pieces: points.points().len() - 1,
                breaks: Arc::default(),
                form,
                placement,
            });
        }
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(ReferenceError::EmptyInterval { from, to });
        }
        let domain = form.domain();
        if let Some(t) = [from, to]
            .into_iter()
            .find(|t| !(domain[0] <= *t && *t <= domain[1]))
        {
            let [from, to] = domain;
            return Err(ReferenceError::OutsideDomain { t, from, to });
        }
        let mut curve = Self {
            form,
            interval: [from, to],
            placement,
            pieces: 1,
            breaks: Arc::default(),
        };
        let Some(turning) = curve.sampled_turning()? else {
            return Err(ReferenceError::OnePoint);
        };
        let pieces = (turning / PIECE_TURNING - ROUNDING).ceil() as usize;
        curve.pieces = pieces.clamp(*PIECES.start(), *PIECES.end());
        if let ReferenceForm::Nurbs(nurbs) = &curve.form {
            curve.breaks = nurbs.breaks([from, to]).into();
            curve.pieces = curve.breaks.len() - 1;
        }
        Ok(curve)
    }

    /// Draw a form over its default interval where its formula puts it.
    ///
    /// # Errors
    /// As [`ReferenceCurve::new`].
    pub fn of(form: ReferenceForm) -> Result<Self, ReferenceError> {
        let interval = form.default_interval();
        Self::new(form, interval, Placement::default())
    }

    /// The form.
    pub fn form(&self) -> &ReferenceForm {
        &self.form
    }

    /// The interval of the parameter t.
    pub fn interval(&self) -> [f64; 2] {
        self.interval
    }

    /// Its placement.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Refuse a formula that has no point or no slope somewhere in the interval, as at a pole: wherever that is,
    /// between samples too. Such a formula can be drawn, with gaps, but no curve without gaps follows it.
    ///
    /// # Errors
    /// [`ReferenceError::NotFinite`] with the first such place.
    pub fn check_points(&self) -> Result<(), ReferenceError> {
        let gap = match &self.form {
            ReferenceForm::Formula(formula) => formula.first_gap(self.interval),
            _ => None,
        };
        gap.map_or(Ok(()), |t| Err(ReferenceError::NotFinite { t }))
    }

    /// Draw another part of it.
    ///
    /// # Errors
    /// As [`ReferenceCurve::new`].
    pub fn over(&self, interval: [f64; 2]) -> Result<Self, ReferenceError> {
        Self::new(self.form.clone(), interval, self.placement)
    }

    /// Put it elsewhere.
    pub fn placed(self, placement: Placement) -> Self {
        Self { placement, ..self }
    }

    /// The parameter t that belongs to the parameter u of the curve in pieces.
    pub fn parameter(&self, u: f64) -> f64 {
        let ([from, to], share) = match self.breaks.is_empty() {
            true => (self.interval, u / self.pieces as f64),
            false => {
                let (piece, local) = self.locate(u);
                (self.ends(piece), local)
            }
        };
        from * (1.0 - share) + to * share
    }

    /// The parameters t at the ends of a piece of a B-spline.
    fn ends(&self, piece: usize) -> [f64; 2] {
        [self.breaks[piece], self.breaks[piece + 1]]
    }

    fn placed_values(&self, mut values: Vec<DVec3>) -> Vec<DVec3> {
        // Without a placement points keep their bits.
        if self.placement != Placement::default() {
            for (order, value) in values.iter_mut().enumerate() {
                *value = match order {
                    0 => self.placement.point(*value),
                    _ => self.placement.vector(*value),
                };
            }
        }
        values
    }

    /// Sum up the angles between the directions at even parameters; `None` if the curve moves nowhere by more
    /// than rounding.
    fn sampled_turning(&self) -> Result<Option<f64>, ReferenceError> {
        let [from, to] = self.interval;
        let mut last: Option<DVec3> = None;
        let (mut turning, mut moves) = (0.0, false);
        let samples = match &self.form {
            ReferenceForm::Analytic(form)
                if form.half_axes().is_some() && to - from <= WHOLE_TURN =>
            {
                ONE_WAY_SAMPLES
            }
            _ => SAMPLES,
        };
        for index in 0..=samples {
            let share = index as f64 / samples as f64;
            let t = from * (1.0 - share) + to * share;
            let values = self.derivatives(t, 1);
            let finite =
                |value: &DVec3| value.abs().max_element() <= MAX_MAGNITUDE && !value.is_nan();
            if !values.iter().all(finite) {
                return Err(ReferenceError::NotFinite { t });
            }
            // A curve that is placed far away moves as much as before.
            let own = values[0] - self.placement.translation();
            let farthest = own.abs().max_element();
            moves |= values[1].abs().max_element() * (to - from) > STANDING * farthest;
            // At a cusp the direction before counts.
            if let Some(direction) = vector::direction(values[1]) {
                turning += last.map_or(0.0, |last| last.angle_between(direction));
                last = Some(direction);
            }
        }
        Ok(moves.then_some(turning))
    }
}

impl Differentiable for ReferenceCurve {
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        self.placed_values(match &self.form {
            ReferenceForm::Analytic(form) => form.derivatives(t, order),
            ReferenceForm::Formula(formula) => {
                let t = PowerSeries::parameter(t, order);
                PowerSeries::derivatives(formula.series(&t).each_ref())
            }
            ReferenceForm::Points(points) => points.derivatives(t, order),
            ReferenceForm::Nurbs(nurbs) => nurbs.derivatives(t, order),
            ReferenceForm::Frame(frame) => frame.outline().derivatives(t, order),
        })
    }

    fn enclosed(&self, t: &PowerSeries<Interval>) -> Option<[PowerSeries<Interval>; 3]> {
        let coordinates = match &self.form {
            ReferenceForm::Analytic(form) => form.enclosed(t)?,
            ReferenceForm::Formula(formula) => formula.series(t),
            ReferenceForm::Nurbs(nurbs) => nurbs.enclosed(t)?,
            ReferenceForm::Points(_) | ReferenceForm::Frame(_) => return None,
        };
        Some(self.placement.enclosed(coordinates))
    }
}

impl ParametricCurve for ReferenceCurve {
    fn pieces(&self) -> usize {
        self.pieces
    }

    fn is_periodic(&self) -> bool {
        false
    }

    fn is_planar(&self) -> bool {
        self.form.is_planar() && self.placement.keeps_plane()
    }

    fn continuity(&self) -> usize {
        match &self.form {
            ReferenceForm::Points(_) | ReferenceForm::Frame(_) => 0,
            ReferenceForm::Nurbs(nurbs) => nurbs.continuity(),
            _ => usize::MAX,
        }
    }

    fn fill_derivatives(&self, piece: usize, t: f64, values: &mut [DVec3]) {
        assert!(piece < self.pieces, "piece {piece} of {}", self.pieces);
        let Some(order) = values.len().checked_sub(1) else {
            return;
        };
        let found = match &self.form {
            // Where two legs meet the side counts.
            ReferenceForm::Points(points) => {
                self.placed_values(points.leg_derivatives(piece, t, order))
            }
            ReferenceForm::Frame(frame) => {
                self.placed_values(frame.outline().leg_derivatives(piece, t, order))
            }
            // At a knot too.
            ReferenceForm::Nurbs(nurbs) => {
                let [from, to] = self.ends(piece);
                let at = from * (1.0 - t) + to * t;
                self.placed_values(nurbs.derivatives_beside(0.5 * (from + to), at, order))
            }
            _ => self.derivatives(self.parameter(piece as f64 + t), order),
        };
        let rate = match self.breaks.is_empty() {
            true => (self.interval[1] - self.interval[0]) / self.pieces as f64,
            false => self.breaks[piece + 1] - self.breaks[piece],
        };
        let mut factor = 1.0;
        for (value, found) in values.iter_mut().zip(found) {
            *value = found * factor;
            factor *= rate;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bounds of derivatives up to this order are checked.
    const ORDER: usize = 6;

    /// Check that bounds over intervals of t = t(s) hold the coefficients at every s, and are narrow at a place.
    fn check(text: &str) {
        let curve = ReferenceCurve::from_text(text).expect("a reference");
        let [from, to] = curve.interval();
        for (start, width) in [(0.0, 0.07), (0.31, 0.0), (0.4, 0.02), (0.9, 0.1)] {
            let at = |s: f64| from + (to - from) * (start + width * s);
            let rate = (to - from) * 0.1;
            // t = t₀ + rate s + s²: as a way along two curves leads.
            let series = |t: Interval| {
                let numbers = [rate, 1.0].map(Interval::number);
                PowerSeries::of_coefficients(&[&[t][..], &numbers].concat(), ORDER)
            };
            let over = curve.enclosed(&series(Interval::new(at(0.0), at(1.0))));
            let over = over.expect("bounds");
            for step in 0..=10 {
                let t = at(f64::from(step) / 10.0);
                let inner = PowerSeries::of_coefficients(&[t, rate, 1.0], ORDER);
                let values = PowerSeries::reparametrised(&curve.derivatives(t, ORDER), &inner);
                let here = curve.enclosed(&series(Interval::number(t)));
                let here = here.expect("bounds");
                let axes = PowerSeries::coordinates(&values);
                for (axis, (over, here)) in axes.iter().zip(over.iter().zip(&here)) {
                    let all = over.coefficients().iter().zip(here.coefficients());
                    for (order, (value, (over, here))) in
                        axis.coefficients().iter().zip(all).enumerate()
                    {
                        let room = 1e-10 * value.abs().max(1.0);
                        for (bounds, most) in [(over, f64::INFINITY), (here, 10.0 * room)] {
                            let [low, high] = bounds.bounds();
                            assert!(
                                low - room <= *value && *value <= high + room,
                                "{text}, t = {t}, order {order}: {value} in {bounds:?}"
                            );
                            assert!(
                                high - low <= most,
                                "{text}, t = {t}, order {order}: {bounds:?}"
                            );
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn curves_of_every_kind_but_one_stay_within_their_bounds() {
        for kind in crate::geometry::references::KINDS {
            let curve = ReferenceCurve::from_text(kind.name).expect("a reference");
            let t = PowerSeries::parameter(Interval::number(curve.interval()[0]), 1);
            match kind.name {
                "superspiral" => assert_eq!(curve.enclosed(&t), None),
                name => check(name),
            }
        }
        for text in [
            "log-aesthetic:alpha=2,lambda=-0.4",
            "log-aesthetic:alpha=0,lambda=0.7,from=-1,to=2",
            "log-aesthetic:alpha=-0.5,lambda=0.2,from=-1,to=1",
            "clothoid:a=3,from=-4,to=4",
        ] {
            check(text);
        }
    }

    #[test]
    fn formulas_of_every_function_stay_within_their_bounds() {
        for y in [
            "sin(3*t)*cos(t)+tan(t/2)",
            "asin(t/3)+acos(t/3)*atan(t)",
            "sinh(t)-cosh(2*t)+tanh(3*t)",
            "exp(-t^2)*ln(t+2)+sqrt(t+1)",
            "abs(t+1)+min(t,3)*max(t-9,sin(t))",
            "hypot(t,2)+atan2(t+1,-3)+atan2(2,t)+atan2(-1-t,1)",
            "(t+2)^-2.5+(t-5)^3+2^t+t^0+(t+1)/(t^2+1)",
            "t*30deg+1e-3*t^7",
        ] {
            check(&format!("formula:x=t;y={y};z=-t;from=0;to=1.25"));
        }
    }
}
