//! Polylines with their points on a curve, as near to it as a tolerance asks.

use glam::DVec3;

use super::parametric_curve::ParametricCurve;
use super::root::maximum;
use super::vector::length;

/// Samples of each piece while points are placed, at first and where those miss a bend, and when the result is measured.
const SAMPLES: [usize; 2] = [8, 128];
const MEASURED_SAMPLES: usize = 512;

/// Steps of the golden section that refine the largest distance: to 1e-5 of a sample's width.
const REFINING_STEPS: usize = 24;

/// A leg ends within this share of its length of the place where it would leave the tolerance.
const LEG_TOLERANCE: f64 = 1e-5;

/// The shortest leg, as a share of the parameter's interval: rounding hides what is shorter.
const SHORTEST: f64 = 1e-12;

/// The most points of a polyline: files with more are no use to a solver, and take minutes to find.
pub(super) const MOST_POINTS: usize = 100_000;

/// The most points whose legs are evened out: among more, a short last leg does not show.
const MOST_EVENED: usize = 2_000;

/// Halvings that even the distances of the legs out.
const HALVINGS: usize = 8;

/// Attempts to come within the tolerance where the samples had missed the largest distance.
const ATTEMPTS: usize = 8;

/// Find the parameters of as few points as keep the polyline through them within `tolerance` > 0 of the
/// curve, and the curve within it of the polyline.
///
/// Each leg goes as far as it can; then the tolerance is lowered as long as the number of points stays
/// the same, which makes the legs deviate alike. The result is measured with more samples. `None` if it takes
/// more than 100 000 points.
pub fn polyline_within(curve: &dyn ParametricCurve, tolerance: f64) -> Option<Vec<f64>> {
    let [mut samples, most] = SAMPLES;
    let mut target = tolerance;
    for _ in 0..ATTEMPTS {
        let parameters = evened(curve, target, samples)?;
        let measured = polyline_deviation(curve, &parameters);
        if measured <= tolerance {
            return Some(parameters);
        }
        // A leg over a bend that was missed says nothing of the others.
        match samples < most {
            true => samples *= 4,
            false => target *= 0.999 * tolerance / measured,
        }
    }
    None
}

/// Measure the largest distance between a curve and the polyline through its points at some parameters,
/// which rise from one end of the curve to the other.
///
/// Each arc is compared with its leg: no point of the leg is farther from the arc than some point of the arc
/// from the leg.
pub fn polyline_deviation(curve: &dyn ParametricCurve, parameters: &[f64]) -> f64 {
    let legs = parameters.windows(2);
    let deviations = legs.map(|leg| deviation(curve, [leg[0], leg[1]], MEASURED_SAMPLES));
    deviations.fold(0.0, f64::max)
}

fn evened(curve: &dyn ParametricCurve, tolerance: f64, samples: usize) -> Option<Vec<f64>> {
    let mut best = farthest_legs(curve, tolerance, samples, MOST_POINTS)?;
    if best.len() > MOST_EVENED {
        return Some(best);
    }
    let legs = (best.len() - 1) as f64;
    // The number of legs goes with the root of the tolerance.
    let [mut low, mut high] = [tolerance * ((legs - 1.0) / legs).powi(2), tolerance];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match farthest_legs(curve, middle, samples, best.len()) {
            Some(found) => (best, high) = (found, middle),
            None => low = middle,
        }
    }
    Some(best)
}

/// Place points from the start on, each as far from the one before as the tolerance allows. `None` if there
/// would be more than `most`.
fn farthest_legs(
    curve: &dyn ParametricCurve,
    tolerance: f64,
    samples: usize,
    most: usize,
) -> Option<Vec<f64>> {
    let end = curve.pieces() as f64;
    let mut parameters = vec![0.0];
    let mut step = end;
    loop {
        let from = parameters.last().copied().unwrap_or(end);
        if from >= end {
            return Some(parameters);
        }
        if parameters.len() == most {
            return None;
        }
        let to = farthest(curve, tolerance, samples, [from, end], step)?;
        parameters.push(to);
        step = to - from;
    }
}

/// Find the end of the farthest leg from a parameter that keeps the tolerance, at most the end of the curve;
/// `step` is a guess. `None` if it would be too short to be one.
///
/// The deviation goes nearly with the square of a leg's length, which predicts where it ends.
fn farthest(
    curve: &dyn ParametricCurve,
    tolerance: f64,
    samples: usize,
    [from, end]: [f64; 2],
    step: f64,
) -> Option<f64> {
    let [mut low, mut high] = [from, f64::INFINITY];
    let mut to = (from + step).min(end);
    for turn in 0.. {
        let found = deviation(curve, [from, to], samples);
        if found <= tolerance {
            low = to;
            if to == end {
                return Some(end);
            }
        } else {
            high = to;
        }
        // Without an upper bound the difference would be infinite, too.
        if high.is_finite() && high - low <= LEG_TOLERANCE * (high - from) {
            return Some(low);
        }
        if high - from < SHORTEST * curve.pieces() as f64 {
            return None;
        }
        let share = (1.0 - 0.4 * LEG_TOLERANCE) * (tolerance / found).sqrt();
        let predicted = from + share * (to - from);
        // Each second turn halves or doubles, wherever the prediction leads.
        let is_usable = turn % 2 == 0 && low < predicted && predicted < high;
        to = match (is_usable, high.is_finite()) {
            (true, _) => predicted.min(from + 4.0 * (to - from)),
            (false, true) => 0.5 * (low + high),
            (false, false) => from + 2.0 * (to - from),
        };
        to = to.min(end);
    }
    None
}

/// The largest distance of an arc from the leg between its ends; no number where a point is none.
fn deviation(curve: &dyn ParametricCurve, [from, to]: [f64; 2], samples: usize) -> f64 {
    let point = |u: f64| curve.jet(u).point;
    let ends = [from, to].map(point);
    let distance = |u: f64| distance_from_leg(ends, point(u));
    let mut largest = (0.0, [from, from]);
    let mut start = from;
    while start < to {
        let end = (start.floor() + 1.0).min(to);
        let place = |index: usize| start + (end - start) * index as f64 / samples as f64;
        for index in 1..=samples {
            let found = distance(place(index));
            if found.is_nan() {
                return found;
            }
            if found > largest.0 {
                let around = [place(index - 1), place((index + 1).min(samples))];
                largest = (found, around);
            }
        }
        start = end;
    }
    let (_, refined) = maximum(largest.1, REFINING_STEPS, distance);
    largest.0.max(refined)
}

fn distance_from_leg([from, to]: [DVec3; 2], point: DVec3) -> f64 {
    let leg = to - from;
    let along = (point - from).dot(leg) / leg.dot(leg);
    let foot = if along > 0.0 {
        from + along.min(1.0) * leg
    } else {
        from
    };
    length(point - foot)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;
    use crate::geometry::references::ReferenceCurve;

    #[test]
    fn an_arc_takes_as_few_points_as_its_sagitta_says() {
        let circle = ReferenceCurve::from_text("circle:radius=10").unwrap();
        for tolerance in [1.0_f64, 1e-2, 1e-4] {
            let parameters = polyline_within(&circle, tolerance).unwrap();
            // The sagitta of a leg over the angle 2 φ is 10 (1 − cos φ).
            let angle = 2.0 * (1.0 - tolerance / 10.0).acos();
            let legs = (std::f64::consts::TAU / angle).ceil() as usize;
            assert_eq!(parameters.len(), legs + 1, "{tolerance}");
            let measured = polyline_deviation(&circle, &parameters);
            assert!(
                measured <= tolerance && measured > 0.5 * tolerance,
                "{measured}"
            );
        }
    }

    #[test]
    fn legs_grow_where_the_curve_straightens() {
        let spiral = ReferenceCurve::from_text("clothoid:a=1,from=0,to=4").unwrap();
        let tolerance = 1e-4;
        let count = polyline_within(&spiral, tolerance).unwrap().len() as f64;
        // A leg h over the curvature κ = s deviates by κ h² / 8.
        let ideal = (2.0 / 3.0) * 8.0 / (8.0 * tolerance).sqrt();
        assert!(
            (ideal..1.1 * ideal + 3.0).contains(&count),
            "{count} against {ideal}"
        );
        let points = [8.0, 4.0, 2.0, 1.0, 0.0, 0.0].map(|x: f64| (x * x, x));
        let curve = FloatPolygon::planar(3, &points).unwrap();
        let legs = polyline_within(&curve, tolerance).unwrap();
        let deviations = legs
            .windows(2)
            .map(|leg| deviation(&curve, [leg[0], leg[1]], 64));
        let least = deviations.fold(f64::INFINITY, f64::min);
        assert!(least > 0.5 * tolerance, "{least}");
    }

    #[test]
    fn the_tolerance_holds_at_dense_samples() {
        let points = [
            (0.0, 0.0),
            (1.0, 9.0),
            (2.0, -9.0),
            (3.0, 4.0),
            (4.0, 0.0),
            (4.0, 0.1),
            (9.0, 0.0),
        ];
        let curve = FloatPolygon::planar(3, &points).unwrap();
        let end = curve.segments() as f64;
        for tolerance in [0.5, 1e-3, 1e-5] {
            let parameters = polyline_within(&curve, tolerance).unwrap();
            assert_eq!(
                [parameters[0], parameters[parameters.len() - 1]],
                [0.0, end]
            );
            for leg in parameters.windows(2) {
                let ends = [leg[0], leg[1]].map(|u| curve.point(u));
                for index in 0..=200 {
                    let u = leg[0] + (leg[1] - leg[0]) * f64::from(index) / 200.0;
                    let distance = distance_from_leg(ends, curve.point(u));
                    assert!(distance <= tolerance * (1.0 + 1e-9), "{u}: {distance}");
                }
            }
        }
        let straight = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)]);
        let parameters = polyline_within(&straight.unwrap(), 1e-9);
        assert_eq!(parameters.map(|it| it.len()), Some(2));
        assert_eq!(polyline_within(&curve, 1e-300), None);
    }
}
