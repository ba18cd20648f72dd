//! Conditions on the sign of the curvature's slope, at samples all along a curve.

use glam::DVec3;

use super::dual::{Dual, DualVector, differentiate, slope_numerator};
use super::jet_weights::{JetWeights, ORDERS};
use crate::geometry::float_polygon::FloatPolygon;

/// Least distance of slopes from 0, in their units.
const MARGIN: f64 = 1e-3;

/// A condition is active up to this slope, in margins, and from this multiplier on.
const ACTIVE: [f64; 2] = [10.0, 0.01];

/// A multiplier changes at most by this factor at a time, and never falls below the least.
const CHANGE: f64 = 10.0;
const LEAST: f64 = 1e-9;

/// The logarithm goes over into a parabola here.
const JOINT: f64 = -0.5;

/// The slope of the curvature at a parameter is to have a sign.
#[derive(Clone, Debug)]
pub(super) struct SlopeSign {
    pub(super) u: f64,
    /// Whether the curvature is to rise.
    pub(super) rises: bool,
    weights: JetWeights,
    /// The unit of slopes: how far noise of the points moves this one.
    unit: f64,
    multiplier: f64,
    pub(super) active: bool,
}

/// The share of a condition in the minimised sum: half its value, and the derivatives of that by the slope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pressure {
    pub(super) value: f64,
    pub(super) first: f64,
    pub(super) second: f64,
}

impl SlopeSign {
    /// Ask for a sign at a local parameter of a segment.
    pub(super) fn new(polygon: &FloatPolygon, segment: usize, t: f64, rises: bool) -> Self {
        Self {
            u: segment as f64 + t,
            rises,
            weights: JetWeights::of_segment(polygon, segment, t),
            unit: 1.0,
            multiplier: 1.0,
            active: false,
        }
    }

    /// Ask for a sign.
    pub(super) fn ask(&mut self, rises: bool) {
        if rises != self.rises {
            self.rises = rises;
            self.active = false;
            self.multiplier = self.multiplier.min(1.0);
        }
    }

    /// Measure the slope in another unit, if it is one.
    pub(super) fn measure_in(&mut self, unit: f64) {
        if unit > 0.0 && unit.is_finite() {
            self.unit = unit;
        }
    }

    /// Evaluate the slope dκ/du, positive where it has the requested sign, and its gradient by the
    /// vertices.
    pub(super) fn slope(&self, vertices: &[DVec3]) -> (f64, Vec<(usize, DVec3)>) {
        let jet = self.weights.jet(vertices);
        let factor = if self.rises { 1.0 } else { -1.0 } / self.unit;
        let formula = |derivatives: [DualVector; 3]| slope(derivatives) * factor;
        let (value, by_derivative) = differentiate([jet[1], jet[2], jet[3]], formula);
        let mut gradient = [DVec3::ZERO; ORDERS];
        gradient[1..].copy_from_slice(&by_derivative);
        (value, self.weights.gradient(&gradient))
    }

    /// Evaluate the curvature here.
    pub(super) fn curvature(&self, vertices: &[DVec3]) -> f64 {
        let jet = self.weights.jet(vertices);
        let normal = jet[1].cross(jet[2]);
        normal.length() / jet[1].length().powi(3)
    }

    /// Evaluate the pressure −(λ/ρ) φ(ρ(x − m)) at a slope x, with the multiplier λ, a weight ρ and the
    /// margin m: φ(t) = ln(1 + t), but a parabola for t < −½, so that it is defined, and has two derivatives,
    /// where the condition is missed too (Ben-Tal and Zibulevsky, "Penalty/barrier multiplier methods",
    /// 1997).
    pub(super) fn pressure(&self, weight: f64, slope: f64) -> Pressure {
        let t = weight * (slope - MARGIN);
        let at = 1.0 + t.max(JOINT);
        let beyond = (t - JOINT).min(0.0);
        let (first, second) = (at.recip(), -at.powi(-2));
        let value = at.ln() + (first + 0.5 * second * beyond) * beyond;
        Pressure {
            value: -self.multiplier / weight * value,
            first: -self.multiplier * (first + second * beyond),
            second: -self.multiplier * weight * second,
        }
    }

    /// Take the pressure at a slope as the new multiplier.
    pub(super) fn update(&mut self, weight: f64, slope: f64) {
        let pressure = -self.pressure(weight, slope).first;
        let range = [self.multiplier / CHANGE, self.multiplier * CHANGE];
        self.multiplier = pressure.clamp(range[0], range[1]).max(LEAST);
        self.active = slope < ACTIVE[0] * MARGIN && self.multiplier > ACTIVE[1];
    }
}

/// dκ/du = (|C′|² (C′ × C‴) − 3 (C′·C″) (C′ × C″))·b / |C′|⁵ with b the normal of the osculating plane.
fn slope(derivatives: [DualVector; 3]) -> Dual {
    let [first, second, _] = derivatives;
    let squared = first.dot(first);
    let fifth = squared * squared * squared.sqrt();
    slope_numerator(derivatives, None) / (fifth * first.cross(second).length())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_the_curvature_and_gradients_agree_with_differences() {
        let place = |x: f64, z: f64| DVec3::new(x, 0.1 * x * x + 0.05 * x.sin(), z * x * x * x);
        const STEP: f64 = 1e-5;
        for z in [0.005, 0.02] {
            let vertices: Vec<DVec3> = (0..8).map(|x| place(f64::from(x), z)).collect();
            let polygon = FloatPolygon::new(5, vertices.clone(), None, false).expect("a polygon");
            let sign = SlopeSign::new(&polygon, 1, 0.3, true);
            let (slope, gradient) = sign.slope(&vertices);
            let jet = polygon.jet(1.3);
            let expected = jet.curvature_slope(false) * jet.first.length();
            assert!(
                (slope - expected).abs() <= 1e-12 * expected.abs(),
                "{slope} {expected}"
            );
            for (vertex, gradient) in gradient {
                for axis in 0..3 {
                    let moved = |by: f64| {
                        let mut moved = vertices.clone();
                        moved[vertex][axis] += by;
                        sign.slope(&moved).0
                    };
                    let difference = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
                    let apart = (gradient[axis] - difference).abs();
                    assert!(
                        apart <= 1e-7 * (1.0 + gradient[axis].abs()),
                        "{vertex} {axis}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_pressure_has_two_derivatives_everywhere() {
        let polygon = FloatPolygon::new(3, vec![DVec3::ZERO; 4], None, false).expect("a polygon");
        let sign = SlopeSign::new(&polygon, 0, 0.0, true);
        const STEP: f64 = 1e-6;
        for slope in [-3.0, -0.06, MARGIN + JOINT / 10.0, -0.04, 0.0, 0.5] {
            let at = |slope: f64| sign.pressure(10.0, slope);
            let [before, here, behind] = [slope - STEP, slope, slope + STEP].map(at);
            let first = (behind.value - before.value) / (2.0 * STEP);
            let second = (behind.first - before.first) / (2.0 * STEP);
            assert!(
                (first - here.first).abs() < 1e-6 * here.first.abs(),
                "{slope}"
            );
            assert!(
                (second - here.second).abs() < 1e-4 * here.second.abs(),
                "{slope}"
            );
        }
    }
}
