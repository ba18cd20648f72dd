//! Log-aesthetic segments, up to a similarity (Yoshida and Saito, "Interactive aesthetic curve
//! segments", 2006).
//!
//! Along a log-aesthetic curve ρ^α is linear in arc length, and ρ^{α−1} in the angle that the curve
//! has turned by. So a segment that turns by θ while ln ρ grows by g is known by α, g and θ alone.
//! With x the share of the turning that is done where the share w of g is,
//!
//!   x(w) = w φ((α−1) g w) / φ((α−1) g),   φ(y) = (eʸ − 1) / y,
//!
//! and its chord is θ ∫ e^{g w} e^{iθx} x′(w) dw in units of the first radius. Seen from the
//! direction half way, the chord leans towards the end by an angle that rises with g: 0 at g = 0,
//! where the segment is a circular arc, and opposite for −g. So one bracketed root finds g.

use glam::DVec2;

use crate::geometry::quadrature::{quadrature, settled_quadrature};
use crate::geometry::references::log_aesthetic::{lambda_and_length, relative_exponential};
use crate::geometry::root::root;

/// Largest growth of ln ρ: radii a million times apart.
const MOST_GROWTH: f64 = 13.8;

/// How far ln ρ^α and ln ρ^{α−1} may change: their exponential stays in the range of numbers, and the lean is at its
/// limit but for rounding long before.
const MOST_STRETCH: f64 = 600.0;

/// Precision of chords, relative to the length.
const EXACT: f64 = 4.0 * f64::EPSILON;

/// Range of α to search.
const ALPHAS: [f64; 2] = [-10.0, 10.0];

/// Number of steps between them.
const ALPHA_STEPS: usize = 80;

/// A log-aesthetic segment that turns left, up to a similarity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LogAesthetic {
    /// The slope of its logarithmic curvature graph.
    pub(super) alpha: f64,
    /// Growth of ln ρ from start to end; negative where it falls.
    pub(super) growth: f64,
    /// The angle that it turns by, positive.
    pub(super) turning: f64,
}

impl LogAesthetic {
    /// Find the segment whose chord leans by an angle towards the end.
    ///
    /// # Errors
    /// The largest lean that there is with this α, if it is less.
    pub(super) fn leaning(alpha: f64, turning: f64, lean: f64) -> Result<Self, f64> {
        let of = |growth| Self {
            alpha,
            growth,
            turning,
        };
        let wanted = lean.abs();
        let largest = MOST_GROWTH.min(MOST_STRETCH / alpha.abs().max((alpha - 1.0).abs()));
        let most = of(largest).lean();
        if !(wanted <= most) {
            return Err(most);
        }
        let missing = |growth| of(growth).lean() - wanted;
        let growth = root([0.0, largest], f64::EPSILON, missing);
        Ok(of(growth.copysign(lean)))
    }

    /// Find the segment whose chord leans by an angle and that has a curvature, for a chord of 1, at
    /// one end. Of several the one with α next to −1 is found.
    ///
    /// # Errors
    /// The least and the largest curvature that there is for some α from −10 to 10; `None` if there is
    /// no segment at all.
    pub(super) fn with_curvature(
        turning: f64,
        lean: f64,
        end: usize,
        curvature: f64,
    ) -> Result<Self, Option<[f64; 2]>> {
        let segment = |alpha: f64| Self::leaning(alpha, turning, lean).ok();
        let [from, to] = ALPHAS;
        let alphas =
            (0..=ALPHA_STEPS).map(|step| from + (to - from) * step as f64 / ALPHA_STEPS as f64);
        let known = alphas.filter_map(|alpha| Some((alpha, segment(alpha)?.curvatures()[end])));
        let known: Vec<(f64, f64)> = known.collect();
        let pairs = known.windows(2).map(|pair| [pair[0], pair[1]]);
        let around =
            pairs.filter(|[(_, low), (_, high)]| (low - curvature) * (high - curvature) <= 0.0);
        let clothoid = |[(low, _), (high, _)]: &[(f64, f64); 2]| (0.5 * (low + high) + 1.0).abs();
        let nearest = around.min_by(|a, b| clothoid(a).total_cmp(&clothoid(b)));
        let Some([(low, _), (high, _)]) = nearest else {
            let least = known.iter().map(|it| it.1).min_by(f64::total_cmp);
            let most = known.iter().map(|it| it.1).max_by(f64::total_cmp);
            return Err(least.zip(most).map(|(least, most)| [least, most]));
        };
        let missing =
            |alpha| segment(alpha).map_or(f64::NAN, |it| it.curvatures()[end] - curvature);
        let alpha = root([low, high], f64::EPSILON, missing);
        segment(alpha).ok_or(None)
    }

    /// The parameter Λ of the standard form, in which the first radius is 1, and the length in it.
    pub(super) fn lambda_and_length(&self) -> [f64; 2] {
        lambda_and_length(self.alpha, self.growth, self.turning)
    }

    /// Its chord in units of the first radius, where it starts along (1, 0).
    pub(super) fn chord(&self) -> DVec2 {
        DVec2::from_angle(0.5 * self.turning).rotate(self.chord_half_way())
    }

    /// Its curvatures at both ends, for a chord of 1.
    pub(super) fn curvatures(&self) -> [f64; 2] {
        let chord = self.chord_half_way().length();
        [chord, chord * (-self.growth).exp()]
    }

    /// Lean of its chord from the direction half way towards that at the end.
    fn lean(&self) -> f64 {
        self.chord_half_way().to_angle()
    }

    /// Its chord in units of the first radius, seen from the direction half way.
    fn chord_half_way(&self) -> DVec2 {
        let Self {
            alpha,
            growth,
            turning,
        } = *self;
        let stretch = (alpha - 1.0) * growth;
        let whole = relative_exponential(stretch);
        let functions = |w: f64| {
            let share = w * relative_exponential(stretch * w) / whole;
            let speed = turning * (alpha * growth * w).exp() / whole;
            let (sine, cosine) = (turning * (share - 0.5)).sin_cos();
            [speed * cosine, speed * sine]
        };
        let first = quadrature(0.0, 1.0, &functions);
        let [_, length] = self.lambda_and_length();
        let allowed = [EXACT * length; 2];
        DVec2::from(settled_quadrature([0.0, 1.0], first, allowed, &functions).values)
    }
}
