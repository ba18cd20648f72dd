//! Log-aesthetic curves, as witnesses.

use glam::DVec3;

use crate::geometry::parametric_curve::ParametricCurve;

/// A log-aesthetic curve ρ = (1 + Λαs)^(1/α), e^(Λs) for α = 0, by its derivatives alone, over
/// 0 ≤ s ≤ 1 in one piece. Its parameter runs faster than s, so that nothing is easy.
pub(super) struct LogAesthetic {
    pub(super) alpha: f64,
    pub(super) lambda: f64,
}

impl LogAesthetic {
    /// κ, κ′ and the direction angle at s.
    fn at(&self, s: f64) -> [f64; 3] {
        let Self { alpha, lambda } = *self;
        let base = 1.0 + lambda * alpha * s;
        let radius = if alpha == 0.0 {
            (lambda * s).exp()
        } else {
            base.powf(1.0 / alpha)
        };
        // dρ/ds = Λ ρ^(1−α).
        let slope = -lambda * radius.powf(-1.0 - alpha);
        let angle = if alpha == 1.0 {
            base.ln() / lambda
        } else if alpha == 0.0 {
            (1.0 - (-lambda * s).exp()) / lambda
        } else {
            (base.powf(1.0 - 1.0 / alpha) - 1.0) / (lambda * (alpha - 1.0))
        };
        [1.0 / radius, slope, angle]
    }
}

impl ParametricCurve for LogAesthetic {
    fn pieces(&self) -> usize {
        1
    }

    fn is_periodic(&self) -> bool {
        false
    }

    fn is_planar(&self) -> bool {
        true
    }

    fn continuity(&self) -> usize {
        9
    }

    fn fill_derivatives(&self, _: usize, t: f64, values: &mut [DVec3]) {
        // s = (t + t²)/2.
        let (s, first, second) = (0.5 * (t + t * t), 0.5 + t, 1.0);
        let [curvature, slope, angle] = self.at(s);
        let tangent = DVec3::new(angle.cos(), angle.sin(), 0.0);
        let normal = DVec3::new(-angle.sin(), angle.cos(), 0.0);
        let by_length = [
            tangent,
            curvature * normal,
            slope * normal - curvature * curvature * tangent,
        ];
        values[1] = first * by_length[0];
        values[2] = second * by_length[0] + first * first * by_length[1];
        values[3] = 3.0 * first * second * by_length[1] + first.powi(3) * by_length[2];
    }
}
