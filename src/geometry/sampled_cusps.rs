//! Cusps of curves without a polygon, by samples: not proved.

use super::jet::Jet;
use super::parametric_curve::ParametricCurve;
use super::root::root;

/// Samples in all, about.
const SAMPLES: usize = 1024;

/// The least number of steps a piece.
const LEAST_STEPS: usize = 8;

/// A speed that is no more than this share of the speeds beside it is 0 but for rounding.
const STOPPED: f64 = 1e-9;

/// List the parameters u at which a curve stops, C′ = 0, as samples show: where the speed is least between two of
/// them and, once that place is found by C′ · C″ = 0, no more than rounding is left of it. There a curve has a
/// cusp, or at least no curvature that could be told.
pub fn sampled_cusps(curve: &dyn ParametricCurve) -> Vec<f64> {
    let pieces = curve.pieces();
    let steps = (SAMPLES / pieces).max(LEAST_STEPS);
    let mut cusps: Vec<f64> = Vec::new();
    for piece in 0..pieces {
        let at = |step: usize| step as f64 / steps as f64;
        let jets: Vec<Jet> = (0..=steps)
            .map(|step| curve.piece_jet(piece, at(step)))
            .collect();
        for (step, pair) in jets.windows(2).enumerate() {
            let [before, after] = [at(step), at(step + 1)];
            let fast = pair[0].speed().max(pair[1].speed());
            let stops = |t: f64| curve.piece_jet(piece, t).speed() <= STOPPED * fast;
            let between = || slowest(curve, piece, [before, after]);
            let found = [Some(before), between(), Some(after)];
            let found = found.into_iter().flatten().find(|t| stops(*t));
            let found = found.map(|t| piece as f64 + t);
            // A cusp at a sample is found from both sides.
            let width = 0.5 / steps as f64;
            cusps.extend(found.filter(|u| cusps.last().is_none_or(|last| u - last > width)));
        }
    }
    cusps
}

/// Find where the speed is least between two local parameters, if it falls at the first and rises at the second.
fn slowest(curve: &dyn ParametricCurve, piece: usize, [from, to]: [f64; 2]) -> Option<f64> {
    let rises = |t: f64| {
        let jet = curve.piece_jet(piece, t);
        jet.first.dot(jet.second) > 0.0
    };
    let side = |t: f64| if rises(t) { 1.0 } else { -1.0 };
    (!rises(from) && rises(to)).then(|| root([from, to], 0.0, side))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::references::ReferenceCurve;

    fn check(text: &str, expected: &[f64]) {
        let curve = ReferenceCurve::from_text(text).expect("a reference");
        let found = sampled_cusps(&curve).into_iter();
        let found: Vec<f64> = found.map(|u| curve.parameter(u)).collect();
        assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-7,
                "{text}: {found} {expected}"
            );
        }
    }

    #[test]
    fn cusps_are_found_wherever_they_are() {
        check("formula:x=t^2;y=t^3;from=-1;to=1", &[0.0]);
        check("formula:x=(t-0.1)^2;y=(t-0.1)^3;from=-1;to=1.3", &[0.1]);
        check("circle-involute:from=0,to=3", &[0.0]);
        let tau = std::f64::consts::TAU;
        check(
            "formula:x=t-sin(t);y=1-cos(t);from=-1;to=13",
            &[0.0, tau, 2.0 * tau],
        );
    }

    #[test]
    fn what_is_only_slow_has_none() {
        check("formula:x=t^2;y=t^3+1e-6*t;from=-1;to=1", &[]);
        check("formula:x=t;y=1/t;from=-1;to=1.1", &[]);
        check("conical-spiral", &[]);
    }
}
