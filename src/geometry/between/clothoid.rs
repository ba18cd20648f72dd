//! Clothoids between two ends, up to a similarity, with an inflection where the ends ask for one
//! (Bertolazzi and Frego, "G1 fitting with clothoids", 2015).
//!
//! With the angles measured from the chord, the direction of a clothoid of length 1 is
//! θ(τ) = φ₀ + (δ − A) τ + A τ², δ = φ₁ − φ₀, and A is the root of ∫ sin θ dτ that is next to 0.

use glam::DVec2;

use crate::geometry::quadrature::{quadrature, settled_quadrature};
use crate::geometry::root::root;

/// Steps of the search for a root.
const STEPS: usize = 64;

/// Precision of the integrals.
const EXACT: f64 = 4.0 * f64::EPSILON;

/// A clothoid of length 1, up to a similarity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clothoid {
    /// Its curvatures at both ends.
    pub(super) curvatures: [f64; 2],
}

impl Clothoid {
    /// Find the clothoid that starts with an angle to its chord and ends with another, and has no
    /// loop. `None` if there is none.
    pub(super) fn between([first, last]: [f64; 2]) -> Option<Self> {
        let turning = first + last;
        let of = |bend: f64| Self {
            curvatures: [turning - bend, turning + bend],
        };
        if first == last {
            return Some(of(0.0));
        }
        let sine = |bend: f64| of(bend).chord_from(-first).y;
        let towards = (last - first).signum();
        let steepest = {
            let largest = std::f64::consts::FRAC_PI_2 + first.abs().max(last.abs());
            turning.abs() + 2.0 * largest * (1.0 + (1.0 + turning.abs() / largest).sqrt())
        };
        let at = |step: usize| towards * steepest * step as f64 / STEPS as f64;
        let begun = sine(0.0);
        let step = (1..=STEPS).find(|step| sine(at(*step)) * begun <= 0.0)?;
        let mut places = [at(step - 1), at(step)];
        places.sort_by(f64::total_cmp);
        let found = of(root(places, f64::EPSILON, sine));
        (found.chord_from(-first).x > 0.0).then_some(found)
    }

    /// Its chord, where it starts at an angle to the axis.
    fn chord_from(&self, angle: f64) -> DVec2 {
        let [first, last] = self.curvatures;
        let functions = |share: f64| {
            let direction = angle + share * (first + 0.5 * share * (last - first));
            let (sine, cosine) = direction.sin_cos();
            [cosine, sine]
        };
        let whole = quadrature(0.0, 1.0, &functions);
        DVec2::from(settled_quadrature([0.0, 1.0], whole, [EXACT; 2], &functions).values)
    }

    /// The angle that it turns by.
    pub(super) fn turning(&self) -> f64 {
        0.5 * (self.curvatures[0] + self.curvatures[1])
    }

    /// Its chord, where it starts along (1, 0).
    pub(super) fn chord(&self) -> DVec2 {
        self.chord_from(0.0)
    }
}
