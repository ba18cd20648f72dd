//! Log-aesthetic segments by even steps of ln ρ.
//!
//! By arc length a curve with α ≠ 0 may end soon beyond the segment: where 1 + Λαs is 0. By ln ρ it never
//! does. With c the change of ln (1 + Λαs) along the whole segment and v the share of the change of ln ρ,
//!
//!   s(v) = (e^{cv} − 1) / (e^c − 1)   of the length.

use glam::DVec3;

use super::parts::Parts;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::power_series::PowerSeries;
use crate::geometry::references::{ReferenceForm, log_aesthetic};

/// A log-aesthetic segment by a parameter v in \[0, 1\] that grows evenly with ln ρ.
pub(super) struct ByGrowth<'a> {
    parts: &'a Parts,
    /// The change c of ln (1 + Λαs) from the start to the end.
    change: f64,
}

impl<'a> ByGrowth<'a> {
    /// Pass through a segment of one log-aesthetic part evenly by ln ρ; `None` for others.
    pub(super) fn of(parts: &'a Parts) -> Option<Self> {
        let [part] = &parts.parts[..] else {
            return None;
        };
        let ReferenceForm::Analytic(form) = part.curve.form() else {
            return None;
        };
        let &[alpha, lambda] = form.values() else {
            return None;
        };
        let log_aesthetic = form.kind().name == log_aesthetic::KIND.name && !part.reversed;
        let [from, to] = part.curve.interval().map(|s| (lambda * alpha * s).ln_1p());
        let change = to - from;
        // Without a change, arc length is the same parameter.
        let changes = change.is_finite() && change != 0.0;
        (log_aesthetic && changes).then_some(Self { parts, change })
    }

    /// The arc length from the start that belongs to v.
    pub(super) fn arc_length(&self, v: f64) -> f64 {
        self.parts.end * (self.change * v).exp_m1() / self.change.exp_m1()
    }
}

impl Differentiable for ByGrowth<'_> {
    fn derivatives(&self, v: f64, order: usize) -> Vec<DVec3> {
        let s = self.arc_length(v);
        let change = self.change;
        let rate = self.parts.end * change * (change * v).exp() / change.exp_m1();
        let mut powers = vec![s];
        powers.extend((0..order).map(|k| rate * change.powi(k as i32)));
        let inner = PowerSeries::of_derivatives(powers.into_iter());
        let values = self.parts.derivatives(s, order);
        PowerSeries::reparametrised(&values, &inner)
    }
}
