//! Superspiral segments, up to a similarity (Ziatdinov, "Family of superspirals with completely
//! monotonic curvature given in terms of Gauss hypergeometric function", 2012).
//!
//! For a > 0 and c > b > 0 the radius of curvature ₂F₁(a, b; c; −ψ) falls as the direction angle ψ rises
//! from −1, ever more slowly: a segment that turns by θ leans the less the later it begins. So one
//! bracketed root finds where it begins.

use glam::DVec2;

use super::ends::angle;
use super::root::root;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::references::{
    AnalyticForm, ReferenceCurve, ReferenceError, ReferenceForm, superspiral,
};

/// Where a segment may begin, the direction angle of the spiral: earlier it has hardly a finite radius, later
/// it is all but a circular arc.
const BEGINS: [f64; 2] = [-0.9, 60.0];

/// Precision of the start; correcting the ends does the rest.
const EXACT: f64 = 1e-14;

/// A segment of a superspiral.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Superspiral {
    /// The spiral.
    pub(super) form: AnalyticForm,
    /// The direction angles between which it runs.
    pub(super) interval: [f64; 2],
}

/// Why there is no segment of a superspiral.
pub(super) enum NoSuperspiral {
    /// Its radius of curvature is not monotone, or its numbers are out of range.
    Spiral(ReferenceError),
    /// The least and the largest lean of its segments.
    Leans([f64; 2]),
}

impl Superspiral {
    /// Find the segment of the superspiral a, b, c that turns by an angle, and whose chord leans by an
    /// angle from the direction half way towards that at the start.
    ///
    /// # Errors
    /// [`NoSuperspiral`].
    pub(super) fn leaning(
        values: [f64; 3],
        turning: f64,
        lean: f64,
    ) -> Result<Self, NoSuperspiral> {
        let form = AnalyticForm::new(&superspiral::KIND, values.to_vec());
        let form = form.map_err(NoSuperspiral::Spiral)?;
        let spiral = ReferenceCurve::of(ReferenceForm::Analytic(form.clone()));
        let spiral = spiral.map_err(NoSuperspiral::Spiral)?;
        let leans = |begin: f64| {
            let [from, to] = [begin, begin + turning].map(|angle| spiral.derivatives(angle, 0)[0]);
            let half_way = DVec2::from_angle(begin + 0.5 * turning);
            angle((to - from).truncate(), half_way)
        };
        let [most, least] = BEGINS.map(leans);
        if !(least <= lean && lean <= most) {
            return Err(NoSuperspiral::Leans([least, most]));
        }
        let begin = root(BEGINS, EXACT, |begin| leans(begin) - lean);
        Ok(Self {
            form,
            interval: [begin, begin + turning],
        })
    }
}
