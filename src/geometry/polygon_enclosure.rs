//! Bounds of the power series of a curve's coordinates.

use std::sync::OnceLock;

use super::basis::uniform_basis_derivative;
use super::error::MAX_DEGREE;
use super::expansion::DoubleDouble;
use super::float_polygon::FloatPolygon;
use super::interval::Interval;
use super::power_series::PowerSeries;

/// The most segments that one enclosure spans.
const MOST_SEGMENTS: i64 = 8;

/// Beyond a knot by this share of the parameter one polynomial stands for the next one: where they meet, they differ
/// by less than rounding.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl FloatPolygon {
    /// Bound the series of the coordinates for bounds of the series of u. Where these span knots, derivatives above
    /// the degree are unknown; `None` where they span many.
    pub(super) fn enclosed_over(
        &self,
        u: &PowerSeries<Interval>,
    ) -> Option<[PowerSeries<Interval>; 3]> {
        let room = ROUNDING * (1.0 + u.value().magnitude());
        let [low, high] = u.value().bounds();
        let last = self.segments() as i64 - 1;
        let segment = |u: f64| match self.is_periodic() {
            true => u.floor() as i64,
            false => (u.floor() as i64).clamp(0, last),
        };
        if !(low.is_finite() && high.is_finite()) {
            return None;
        }
        let first = segment(low + room);
        let last = segment(high - room).max(first);
        if last - first > MOST_SEGMENTS {
            return None;
        }
        let of = |segment: i64| {
            let local = u.clone().plus(Interval::number(-segment as f64));
            self.segment_enclosed(segment.rem_euclid(self.segments() as i64) as usize, &local)
        };
        let mut found = of(first);
        for segment in first + 1..=last {
            let next = of(segment);
            for (axis, next) in found.iter_mut().zip(&next) {
                *axis = axis.joined(next, self.degree());
            }
        }
        Some(found)
    }

    /// Bound the series of the coordinates on one segment for bounds of the series of its local parameter, which may
    /// lie beyond it.
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    fn segment_enclosed(
        &self,
        segment: usize,
        local: &PowerSeries<Interval>,
    ) -> [PowerSeries<Interval>; 3] {
        let degree = self.degree();
        let bases = middle_bases(degree);
        // About one of the vertices the differences are small, and so is their rounding.
        let origin = self.vertex(segment + degree / 2);
        let about_middle = local.clone().plus(Interval::number(-0.5));
        let expanded = |mut values: Vec<Interval>| {
            let mut coefficients = Vec::with_capacity(degree + 1);
            let mut factorial = 1.0;
            for (order, basis) in bases.iter().enumerate() {
                factorial *= order.max(1) as f64;
                let terms = values.iter().zip(basis);
                let sum = terms.fold(Interval::number(0.0), |sum, (value, basis)| {
                    sum + *value * *basis
                });
                coefficients.push(sum / Interval::number(factorial));
                values = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
            }
            PowerSeries::polynomial(coefficients, &about_middle)
        };
        let weight = |index: usize| Interval::number(self.weight(segment + index));
        let weights = self
            .is_rational()
            .then(|| expanded((0..=degree).map(weight).collect()));
        [0, 1, 2].map(|axis| {
            let place = Interval::number(origin[axis]);
            let value = |index: usize| {
                let coordinate = self.vertex(segment + index)[axis];
                let off = Interval::number(coordinate) - place;
                match self.is_rational() {
                    true => off * weight(index),
                    false => off,
                }
            };
            let own = expanded((0..=degree).map(value).collect());
            let own = match &weights {
                Some(weights) => &own / weights,
                None => own,
            };
            own.plus(place)
        })
    }
}

/// The bases of degrees n, n − 1, … 0 in the middle of a segment, to one rounding.
fn middle_bases(degree: usize) -> &'static [Vec<Interval>] {
    static BASES: [OnceLock<Vec<Vec<Interval>>>; MAX_DEGREE + 1] =
        [const { OnceLock::new() }; MAX_DEGREE + 1];
    let made = || {
        let rounded = |value: DoubleDouble| {
            let value = value.high();
            Interval::new(value.next_down(), value.next_up())
        };
        let basis = |degree| uniform_basis_derivative::<DoubleDouble>(degree, 0, 0.5);
        let degrees = (0..=degree).rev();
        degrees
            .map(|degree| basis(degree).into_iter().map(rounded).collect())
            .collect()
    };
    BASES
        .get(degree)
        .map_or(&[], |bases| bases.get_or_init(made))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::differentiable::Differentiable;

    /// Points, and derivatives, lie within their bounds over the whole of an interval, which are narrow at a place.
    #[test]
    fn curves_stay_within_their_bounds() {
        let points: Vec<(f64, f64)> = (0..12)
            .map(|index| {
                let t = f64::from(index);
                (100.0 + t + 0.3 * (2.0 * t).sin(), (0.7 * t).cos())
            })
            .collect();
        for degree in [1, 2, 5, 8] {
            let open = FloatPolygon::planar(degree, &points).expect("a polygon");
            let round = FloatPolygon::new(degree, open.vertices().to_vec(), None, true);
            let weights = (0..12).map(|index| 1.0 + 0.1 * f64::from(index)).collect();
            let rational =
                FloatPolygon::new(degree, open.vertices().to_vec(), Some(weights), false);
            for curve in [open, round.expect("periodic"), rational.expect("rational")] {
                for (from, width) in [(0.0, 0.25), (1.4, 0.3), (2.5, 0.0), (2.9, 1.7)] {
                    let t = Interval::new(from, from + width);
                    let bounds = curve.enclosed(&PowerSeries::parameter(t, 4));
                    let bounds = bounds.expect("few segments");
                    for step in 0..=8 {
                        let u = from + width * f64::from(step) / 8.0;
                        let values = curve.derivatives(u, 4);
                        let axes = PowerSeries::coordinates(&values);
                        for (axis, bounds) in axes.iter().zip(&bounds) {
                            let pairs = axis.coefficients().iter().zip(bounds.coefficients());
                            for (order, (value, bounds)) in pairs.enumerate() {
                                let [low, high] = bounds.bounds();
                                let room = 1e-12 * value.abs().max(1.0);
                                assert!(
                                    low - room <= *value && *value <= high + room,
                                    "degree {degree}, u = {u}, order {order}: {value} in {bounds:?}"
                                );
                                assert!(width > 0.0 || high - low <= 1e-11, "{bounds:?}");
                            }
                        }
                    }
                }
            }
        }
    }
}
