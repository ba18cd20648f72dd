//! Other parameters for a curve, so that even steps are finer where it bends.

use glam::DVec3;

use super::error::ApproximationError;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::distance::places;
use crate::geometry::error::MAX_DEGREE;
use crate::geometry::power_series::PowerSeries;
use crate::geometry::quadrature::quadrature;

/// Newton's steps from there, whole ones and shortened ones: far more than it takes where the curve goes on.
const NEWTON_STEPS: usize = 100;

/// Final error of the measure, as a share of the whole: rounding where steps oscillate.
const ROUNDING: f64 = 1e-12;

/// Spacing of even steps of the new parameter along the curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// By the curve's own parameter.
    Parameter,
    /// By arc length.
    ArcLength,
    /// By ∫ √(1 + (rκ)²) ds: finer where the curve bends. r is the length of the curve over its turning, so
    /// that length and turning count alike.
    Curvature,
}

/// A curve by a parameter v in \[0, 1\] that grows evenly with arc length, or with arc length and turning.
pub struct Respaced<'a> {
    pub(super) spacing: Spacing,
    curve: &'a dyn Differentiable,
    /// The length r; 0 where arc length alone counts.
    radius: f64,
    /// The parameters t at even steps, and the measure up to there.
    table: Vec<(f64, f64)>,
}

impl<'a> Respaced<'a> {
    /// Respace a curve as [`Respaced::new`] does; `None` for its own parameter.
    ///
    /// # Errors
    /// As [`Respaced::new`].
    pub(super) fn by(
        curve: &'a dyn Differentiable,
        interval: [f64; 2],
        spacing: Spacing,
    ) -> Result<Option<Self>, ApproximationError> {
        let respaced = spacing != Spacing::Parameter;
        respaced
            .then(|| Self::new(curve, interval, spacing))
            .transpose()
    }

    /// Measure a curve between two of its parameters.
    ///
    /// # Errors
    /// [`ApproximationError::NoDirection`] where the curve stops, which leaves it no smooth parameter.
    pub fn new(
        curve: &'a dyn Differentiable,
        [from, to]: [f64; 2],
        spacing: Spacing,
    ) -> Result<Self, ApproximationError> {
        let mut respaced = Self {
            spacing,
            curve,
            radius: 0.0,
            table: Vec::new(),
        };
        let places = places(curve, [from, to]);
        if spacing == Spacing::Curvature {
            let totals = places.windows(2).fold([0.0; 2], |sums, step| {
                let values = quadrature(step[0], step[1], &|t| {
                    let (speed, turning) = respaced.rates(t, 0);
                    [speed.value(), turning.value().max(0.0).sqrt()]
                });
                [sums[0] + values[0], sums[1] + values[1]]
            });
            // A straight line has no turning to count.
            let radius = totals[0] / totals[1];
            respaced.radius = if radius.is_finite() { radius } else { 0.0 };
        }
        let mut measure = 0.0;
        respaced.table.push((from, 0.0));
        for step in places.windows(2) {
            let more = respaced.measure(step[0], step[1]);
            if !(more > 0.0 && more.is_finite()) {
                let parameter = step[0];
                return Err(ApproximationError::NoDirection { parameter });
            }
            measure += more;
            respaced.table.push((step[1], measure));
        }
        Ok(respaced)
    }

    /// The parameter t that belongs to v; beyond \[0, 1\] the curve is continued. Not a number where it does not
    /// go on so far.
    pub fn parameter(&self, v: f64) -> f64 {
        let total = self.total();
        let wanted = v * total;
        let above = self.table.partition_point(|(_, measure)| *measure < wanted);
        let (start, below) = self.table[above.saturating_sub(1)];
        let mut low = if above == 0 { f64::NEG_INFINITY } else { start };
        let mut high = self.table.get(above).map_or(f64::INFINITY, |it| it.0);
        let mut t = self.near(v);
        let mut measured = below + self.measure(start, t);
        let mut share = 1.0;
        for _ in 0..NEWTON_STEPS {
            let missing = wanted - measured;
            if missing.abs() <= f64::EPSILON * wanted.abs() {
                return t;
            }
            (low, high) = if missing > 0.0 { (t, high) } else { (low, t) };
            let step = share * missing / self.weight(t, 0).value();
            let is_between = low < t + step && t + step < high;
            let has_ends = (high - low).is_finite();
            let next = match has_ends && !is_between {
                true => 0.5 * (low + high),
                false => t + step,
            };
            let more = self.measure(t, next);
            // Beyond the part a whole step could lead out of the curve where the measure grows otherwise than here.
            let expected = share * missing;
            if !has_ends && !((more - expected).abs() <= 0.5 * expected.abs()) {
                share *= 0.5;
                continue;
            }
            let moved = (next - t).abs();
            t = next;
            if !(moved > 2.0 * f64::EPSILON * t.abs()) {
                return t;
            }
            measured += more;
            share = (2.0 * share).min(1.0);
        }
        // Within the part the ends close in on t, however roughly quadrature measures sharp bends.
        let is_there = (high - low).is_finite() || (wanted - measured).abs() <= ROUNDING * total;
        if is_there { t } else { f64::NAN }
    }

    /// Growth of the measure from one parameter to another.
    fn measure(&self, from: f64, to: f64) -> f64 {
        let [more] = quadrature(from, to, &|t| [self.weight(t, 0).value()]);
        more
    }

    /// The parameters t between which the curve is measured.
    pub fn interval(&self) -> [f64; 2] {
        [self.table[0].0, self.table[self.table.len() - 1].0]
    }

    /// The whole measure.
    fn total(&self) -> f64 {
        self.table[self.table.len() - 1].1
    }

    /// A parameter near that of v in \[0, 1\], without computing it: between even steps of a table.
    pub fn near(&self, v: f64) -> f64 {
        let wanted = v.clamp(0.0, 1.0) * self.total();
        let above = self.table.partition_point(|(_, measure)| *measure < wanted);
        let above = above.clamp(1, self.table.len() - 1);
        let ((from, low), (to, high)) = (self.table[above - 1], self.table[above]);
        let share = (wanted - low) / (high - low);
        from * (1.0 - share) + to * share
    }

    /// The series of |C′| and of its square times the square of the turning: |C′ × C″|²/|C′|⁴.
    fn rates(&self, t: f64, order: usize) -> (PowerSeries, PowerSeries) {
        let values = self.curve.derivatives(t, order + 2);
        let [x, y, z] = PowerSeries::coordinates(&values).map(|series| series.derivative());
        let bends = [&x, &y, &z].map(PowerSeries::derivative);
        let squares = &(&(&x * &x) + &(&y * &y)) + &(&z * &z);
        let crossed = |a: &PowerSeries, b: &PowerSeries, c: usize, d: usize| {
            let product = &(a * &bends[d]) - &(b * &bends[c]);
            &product * &product
        };
        let bend = &(&crossed(&y, &z, 1, 2) + &crossed(&z, &x, 2, 0)) + &crossed(&x, &y, 0, 1);
        let speed = squares.power(0.5).truncated(order);
        (speed, &bend / &(&squares * &squares))
    }

    /// The series of √(|C′|² + r² |C′ × C″|²/|C′|⁴), the measure by t.
    fn weight(&self, t: f64, order: usize) -> PowerSeries {
        let (speed, turning) = self.rates(t, order);
        if self.radius == 0.0 {
            return speed;
        }
        (&(&speed * &speed) + &turning.times(self.radius * self.radius)).power(0.5)
    }
}

impl Differentiable for Respaced<'_> {
    /// With t(v): t′ = M / w(t), M the whole measure; the curve is a composition of series.
    fn derivatives(&self, v: f64, order: usize) -> Vec<DVec3> {
        let t = self.parameter(v);
        let total = self.total();
        let order = order.min(MAX_DEGREE);
        let rate = &PowerSeries::constant(total, order) / &self.weight(t, order);
        let mut inner = PowerSeries::constant(t, 0);
        for known in 0..order {
            let slope = rate.truncated(known).composed(&inner);
            inner = slope.antiderivative(t, known + 1);
        }
        let values = self.curve.derivatives(t, order);
        PowerSeries::reparametrised(&values, &inner)
    }
}
