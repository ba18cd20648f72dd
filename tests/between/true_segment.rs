//! Log-aesthetic segments from their own formulas, by the direction angle: a witness that has nothing
//! in common with what solves them, by arc length and by ln ρ.

use glam::DVec2;

/// Steps of Simpson's rule.
const STEPS: usize = 4000;

/// A log-aesthetic segment that starts at the origin along (1, 0) with radius of curvature 1.
#[derive(Clone, Copy, Debug)]
pub struct TrueSegment {
    pub alpha: f64,
    /// The growth of ln ρ.
    pub growth: f64,
    pub turning: f64,
}

impl TrueSegment {
    /// The radius of curvature where the direction has turned by an angle: ρ^{α−1} is linear.
    pub fn radius(&self, angle: f64) -> f64 {
        let exponent = self.alpha - 1.0;
        let share = angle / self.turning;
        if exponent.abs() < 1e-9 {
            return (self.growth * share).exp();
        }
        let end = (exponent * self.growth).exp();
        (1.0 + share * (end - 1.0)).powf(exponent.recip())
    }

    /// Points at even angles from the start to the end, by Simpson's rule.
    pub fn points(&self) -> Vec<DVec2> {
        let step = self.turning / STEPS as f64;
        let slope = |angle: f64| self.radius(angle) * DVec2::from_angle(angle);
        let mut points = vec![DVec2::ZERO];
        let mut point = DVec2::ZERO;
        for index in 0..STEPS {
            let from = step * index as f64;
            let middle = 4.0 * slope(from + 0.5 * step);
            point += step / 6.0 * (slope(from) + middle + slope(from + step));
            points.push(point);
        }
        points
    }
}
