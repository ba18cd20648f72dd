//! Leaps of a curve given by a formula: through infinity, or over a jump.

use glam::DVec3;

use super::sample::Sample;
use crate::geometry::{Jet, ParametricCurve};

/// Steps that are halved so often leave of a leap what the curve itself does not have: a root of order
/// 5 still has a thousandth of its chord.
const HALVINGS: usize = 50;

/// A chord that is still this share of the first one is a leap.
const SHRUNK: f64 = 1e-3;

/// The cosine of the angle between a chord and the directions at its ends from which on the chord
/// follows the curve.
const ALONG: f64 = 0.5;

/// Steps that are so many times as long as half of all steps lead far away.
const FAR: f64 = 16.0;

/// A chord may be so many times as long as the step at the greater of the speeds at its ends, or the
/// inverse of this share at the lesser one.
const LONGER: f64 = 2.0;

/// One step of a piece, by the local parameters and the jets at its ends.
#[derive(Clone, Copy)]
struct Step {
    t: [f64; 2],
    jets: [Jet; 2],
}

impl Step {
    fn chord(&self) -> f64 {
        self.jets[0].point.distance(self.jets[1].point)
    }

    /// Whether the chord looks like a piece of a smooth curve.
    fn looks_smooth(&self) -> bool {
        let [a, b] = &self.jets;
        let chord = b.point - a.point;
        let length = chord.length();
        if !length.is_finite() {
            return false;
        }
        let follows = |jet: &Jet| chord.dot(jet.first) >= ALONG * length * jet.speed();
        let [slow, fast] = [a.speed().min(b.speed()), a.speed().max(b.speed())];
        let step = self.t[1] - self.t[0];
        let fits = length <= LONGER * fast * step && LONGER * length >= slow * step;
        follows(a) && follows(b) && fits
    }

    /// How far the curve may run in the step: by its chord, and by the speeds at its ends.
    fn reach(&self) -> f64 {
        let speeds: f64 = self.jets.iter().map(Jet::speed).sum();
        self.chord().max(0.5 * speeds * (self.t[1] - self.t[0]))
    }
}

/// Whether a piece of a curve leaps between two local parameters: a step about the place where it runs
/// fastest does not get shorter, however often it is halved.
pub fn leaps(curve: &dyn ParametricCurve, piece: usize, t: [f64; 2]) -> bool {
    let jet = |t: f64| curve.piece_jet(piece, t);
    let mut step = Step {
        t,
        jets: t.map(jet),
    };
    if step.looks_smooth() {
        return false;
    }
    let first = step.chord();
    for _ in 0..HALVINGS {
        let middle = 0.5 * (step.t[0] + step.t[1]);
        if !(step.t[0] < middle && middle < step.t[1]) {
            break;
        }
        let between = jet(middle);
        if !step.chord().is_finite() || !between.point.is_finite() {
            return true;
        }
        // The parameters can no longer be told apart.
        if step.jets.iter().any(|jet| jet.point == between.point) {
            break;
        }
        let halves = [
            Step {
                t: [step.t[0], middle],
                jets: [step.jets[0], between],
            },
            Step {
                t: [middle, step.t[1]],
                jets: [between, step.jets[1]],
            },
        ];
        step = match halves[0].reach() >= halves[1].reach() {
            true => halves[0],
            false => halves[1],
        };
    }
    !(step.chord() <= SHRUNK * first)
}

/// Mark the leaps between the samples of a piece at even parameters, and measure no arc length over
/// them.
pub fn mark(curve: &dyn ParametricCurve, piece: usize, samples: &mut [Sample]) {
    let steps = samples.len().saturating_sub(1).max(1) as f64;
    let (mut measured, mut length) = (0.0, 0.0);
    for index in 0..samples.len() {
        let t = [index.saturating_sub(1), index].map(|step| step as f64 / steps);
        let before = index.checked_sub(1).and_then(|before| samples.get(before));
        let before = before.map(|before| before.point);
        let sample = &mut samples[index];
        let own = sample.arc_length - measured;
        measured = sample.arc_length;
        sample.leaps = index > 0 && leaps(curve, piece, t);
        let chord = before.map_or(0.0, |before| before.distance(sample.point));
        length += match (sample.leaps, own.is_finite()) {
            (false, true) => own,
            (false, false) if chord.is_finite() => chord,
            _ => 0.0,
        };
        sample.arc_length = length;
        if !sample.point.is_finite() {
            sample.point = DVec3::NAN;
        }
    }
}

/// Measure no arc length over the far ways of a curve to a leap and from it either, lest a plot show nothing
/// else: over steps that are many times as long as half of all steps are. `size` is the number of samples of
/// a piece.
pub fn shorten(samples: &mut [Sample], size: usize) {
    let is_first = |index: usize| index.is_multiple_of(size);
    // Behind a leap what was measured from the piece's start has lost its digits; there chords count.
    let broken: Vec<bool> = samples
        .chunks(size)
        .map(|piece| piece.iter().any(|sample| sample.leaps))
        .collect();
    let mut steps: Vec<f64> = (0..samples.len())
        .map(|index| match is_first(index) || samples[index].leaps {
            true => 0.0,
            false if broken[index / size] => {
                samples[index].point.distance(samples[index - 1].point)
            }
            false => samples[index].arc_length - samples[index - 1].arc_length,
        })
        .collect();
    let inner = (0..samples.len()).filter(|index| !is_first(*index) && !samples[*index].leaps);
    let mut sorted: Vec<f64> = inner.map(|index| steps[index]).collect();
    sorted.sort_by(f64::total_cmp);
    let Some(median) = sorted.get(sorted.len() / 2) else {
        return;
    };
    let longest = FAR * median;
    let leaping: Vec<usize> = (0..samples.len())
        .filter(|index| samples[*index].leaps)
        .collect();
    for leap in leaping {
        let is_far = |index: &usize| is_first(*index) || steps[*index] > longest;
        let before: Vec<usize> = (0..leap).rev().take_while(is_far).collect();
        let after: Vec<usize> = (leap + 1..samples.len()).take_while(is_far).collect();
        for index in before.into_iter().chain(after) {
            steps[index] = 0.0;
        }
    }
    let mut length = 0.0;
    for (index, (sample, step)) in samples.iter_mut().zip(&steps).enumerate() {
        length = if is_first(index) { 0.0 } else { length + step };
        sample.arc_length = length;
    }
}

/// Mark the leaps between closer samples of a piece, also at even parameters: they lie where `coarse`
/// ones have them.
pub fn mark_closer(
    curve: &dyn ParametricCurve,
    piece: usize,
    coarse: &[Sample],
    closer: &mut [Sample],
) {
    let [few, many] = [coarse.len(), closer.len()].map(|count| count.saturating_sub(1).max(1));
    let leaping = coarse.iter().enumerate().filter(|(_, sample)| sample.leaps);
    for (step, _) in leaping {
        let steps = ((step - 1) * many / few + 1)..=(step * many).div_ceil(few);
        for step in steps {
            let t = [step - 1, step].map(|step| step as f64 / many as f64);
            if let Some(sample) = closer.get_mut(step) {
                sample.leaps = leaps(curve, piece, t);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::geometry::references::ReferenceCurve;

    /// The values of t at which a formula leaps, to a step of its samples.
    fn found(formula: &str) -> Vec<f64> {
        let curve = ReferenceCurve::from_text(formula).expect("a formula");
        let pieces = curve.pieces();
        let steps = (1024 / pieces).max(8);
        let mut found = Vec::new();
        for piece in 0..pieces {
            for step in 0..steps {
                let t = [step, step + 1].map(|step| step as f64 / steps as f64);
                if leaps(&curve, piece, t) {
                    found.push(curve.parameter(piece as f64 + 0.5 * (t[0] + t[1])));
                }
            }
        }
        found
    }

    fn check(formula: &str, expected: &[f64]) {
        let found = found(formula);
        assert_eq!(found.len(), expected.len(), "{formula}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 0.05,
                "{formula}: {found} {expected}"
            );
        }
    }

    #[test]
    fn poles_of_either_kind_are_leaps() {
        check("formula:x=t;y=1/t;from=-1;to=1.1", &[0.0]);
        check("formula:x=t;y=1/t^2;from=-1;to=1.1", &[0.0]);
        check("formula:x=t;y=1/(t-0.3)^3;from=-1;to=1.1", &[0.3]);
        check(
            "formula:x=t;y=tan(t);from=-4;to=5.1",
            &[-FRAC_PI_2, FRAC_PI_2, 3.0 * FRAC_PI_2],
        );
        check("formula:x=1/(t-1);y=t/(t-1);from=-1;to=3.1", &[1.0]);
    }

    #[test]
    fn what_is_steep_or_bent_is_no_leap() {
        check("formula:x=t;y=1/(t^2+0.0001);from=-1;to=1.1", &[]);
        check("formula:x=t^2;y=t^3;from=-1;to=1.1", &[]);
        check("formula:x=cos(9*t);y=sin(9*t);from=-9;to=9.1", &[]);
        check("formula:x=t;y=exp(20*t);from=-1;to=1.1", &[]);
        check("formula:x=t*cos(t);y=t*sin(t);z=t;from=0;to=40", &[]);
    }
}
