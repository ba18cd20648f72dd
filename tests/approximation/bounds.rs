//! Deviations that nothing between samples escapes, against dense samples of the tests' own.

use batten::geometry::approximation::{
    Approximated, ApproximationRequest, Goal, MOST_SEGMENTS, Placing, Spacing, approximate_between,
    approximate_to_tolerance,
};
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{Differentiable, FloatPolygon, Progress};
use glam::DVec3;

/// Samples of each curve.
const SAMPLES: usize = 3000;

/// Samples about each place where something is hidden.
const HIDDEN: usize = 400;

/// The room of a bound for rounding, by the size: integrals carry that of hundreds of terms.
const ROUNDING: f64 = 1e-13;

/// Steps of the golden section about the nearest sample.
const STEPS: usize = 60;

fn curve(text: &str) -> ReferenceCurve {
    ReferenceCurve::from_text(text).expect("a reference")
}

const PLACE: ApproximationRequest = ApproximationRequest {
    degree: 5,
    placing: Placing::Quasi,
    levels: 0,
    periodic: false,
    fit_ends: false,
};

/// Parameters of a part of a curve: even ones, and many about hidden places, ever denser towards them.
fn parameters([from, to]: [f64; 2], hidden: &[f64]) -> Vec<f64> {
    let even = (0..=SAMPLES).map(|index| from + (to - from) * index as f64 / SAMPLES as f64);
    let about = hidden.iter().flat_map(|place| {
        (0..HIDDEN).flat_map(move |index| {
            let off = (to - from) * 10.0_f64.powf(-9.0 * index as f64 / HIDDEN as f64);
            [place - off, *place, place + off]
        })
    });
    let mut all: Vec<f64> = even
        .chain(about)
        .filter(|t| (from..=to).contains(t))
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

/// The distance of a point from a curve that was sampled: from the nearest sample, or nearer beside it.
fn distance(point: DVec3, samples: &[(f64, DVec3)], at: &dyn Fn(f64) -> DVec3) -> f64 {
    let distances = samples
        .iter()
        .map(|(_, sample)| sample.distance_squared(point));
    let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    let (index, squared) = nearest.expect("samples");
    let [mut low, mut high] =
        [index.saturating_sub(1), (index + 1).min(samples.len() - 1)].map(|index| samples[index].0);
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..STEPS {
        let [a, b] = [high - share * (high - low), low + share * (high - low)];
        match at(a).distance_squared(point) < at(b).distance_squared(point) {
            true => high = b,
            false => low = a,
        }
    }
    at(0.5 * (low + high))
        .distance_squared(point)
        .min(squared)
        .sqrt()
}

/// The largest distance between a curve and the asked part of another one, both ways, as dense samples show it.
fn sampled(
    polygon: &FloatPolygon,
    curve: &dyn Differentiable,
    interval: [f64; 2],
    hidden: &[f64],
) -> f64 {
    let there = |t: f64| curve.derivatives(t, 0)[0];
    let samples: Vec<(f64, DVec3)> = parameters(interval, hidden)
        .into_iter()
        .map(|t| (t, there(t)))
        .collect();
    let from_there = samples
        .iter()
        .map(|(_, point)| polygon.nearest(*point).distance);
    let last = polygon.segments() as f64;
    let places = parameters([0.0, last], &[0.0, last]);
    // A quarter of them takes a quarter of the time.
    let here = places.into_iter().step_by(4);
    let from_here = here.map(|u| distance(polygon.point(u), &samples, &there));
    from_there.chain(from_here).fold(0.0, f64::max)
}

/// Check a deviation against dense samples; `bounded` tells whether it must be a bound.
fn check(what: &str, found: &Approximated, curve: &ReferenceCurve, hidden: &[f64], bounded: bool) {
    let deviation = found.deviation;
    let expected = sampled(&found.polygon, curve, found.interval, hidden);
    let largest = deviation.largest;
    assert_eq!(
        deviation.bounded, bounded,
        "{what}: {deviation:?}, {expected:e}"
    );
    assert!(
        largest >= expected * (1.0 - 1e-9) - 1e-15,
        "{what}: {largest:e}, but {expected:e}"
    );
    let size = found.polygon.size();
    assert!(
        largest <= 2.0 * expected + ROUNDING * size,
        "{what}: {largest:e}, but {expected:e}"
    );
}

#[test]
fn what_lies_between_samples_is_not_missed() {
    for (text, hidden) in [
        (
            "formula:x=t;y=t^2+0.1*exp(-((t-0.3137)*1e4)^2);from=0;to=1",
            0.3137,
        ),
        (
            "formula:x=t;y=t^2+1e-3*exp(-((t-0.71)*1e6)^2);from=0;to=1",
            0.71,
        ),
        (
            "formula:x=t;y=t^2+1e-7/(1+((t-0.7131)*1e7)^2);from=0;to=1",
            0.7131,
        ),
        (
            "formula:x=t+0.01*exp(-((t-0.4)*1e5)^2);y=t^2;z=t^3;from=0;to=1",
            0.4,
        ),
        ("formula:x=t;y=tanh((t-0.5123)*1e5);from=0;to=1", 0.5123),
        ("formula:x=t;y=atan((t-0.5123)*1e5);from=0;to=1", 0.5123),
        (
            "formula:x=t;y=t+sqrt((t-0.4321)^2+1e-12);from=0;to=1",
            0.4321,
        ),
        ("formula:x=t;y=abs(t-0.4321);from=0;to=1", 0.4321),
        ("formula:x=t;y=max(t^2,0.2);from=0;to=1", 0.2_f64.sqrt()),
        ("formula:x=t;y=1/(t+1e-3);from=0;to=1", 0.0),
        ("formula:x=t;y=sin(300*t);from=0;to=1", 0.5),
        ("formula:x=t;y=t^3+1e-6*sin(2*pi*96*t);from=0;to=1", 0.5),
        (
            "formula:x=cos(t);y=sin(t)+1e-5*exp(-((t-3)*1e4)^2);from=0;to=6",
            3.0,
        ),
    ] {
        let curve = curve(text);
        for (count, spacing) in [
            (12, Spacing::Parameter),
            (30, Spacing::Parameter),
            (30, Spacing::ArcLength),
        ] {
            let found = approximate_between(&curve, curve.interval(), count, spacing, &PLACE);
            // A corner has no arc length that is smooth.
            let Ok(found) = found else {
                assert!(
                    text.contains("abs") || text.contains("max"),
                    "{text}: {found:?}"
                );
                continue;
            };
            // Where vertices crowd on a peak nearest points jump between its flanks: a figure that is sampled.
            let bounded = spacing == Spacing::Parameter || found.deviation.bounded;
            check(
                &format!("{text}, {count}, {spacing:?}"),
                &found,
                &curve,
                &[hidden],
                bounded,
            );
        }
    }
}

#[test]
fn deviations_of_every_kind_are_those_of_dense_samples() {
    for text in [
        "circle:from=0,to=3",
        "ellipse:a=3,b=1,from=0.2,to=5",
        "catenary:a=2,from=-3,to=3",
        "circle-involute",
        "logarithmic-spiral",
        "archimedean-spiral",
        "parabola",
        "clothoid:from=-2,to=2",
        "nielsen-spiral:from=1,to=4",
        "log-aesthetic:alpha=2,lambda=0.5,from=6,to=12",
        "log-aesthetic:alpha=-1,lambda=0.5,from=0,to=1.4",
        "superspiral",
        "helix",
        "cubic-helix",
        "conical-helix",
        "conical-spiral:from=1,to=9",
    ] {
        let curve = curve(text);
        let bounded = !text.contains("superspiral");
        for (degree, placing, count) in [
            (3, Placing::Quasi, 24),
            (8, Placing::Quasi, 40),
            (5, Placing::OnCurve, 24),
        ] {
            let asked = ApproximationRequest {
                degree,
                placing,
                ..PLACE
            };
            let spacing = match degree {
                3 => Spacing::ArcLength,
                _ => Spacing::Parameter,
            };
            let found = approximate_between(&curve, curve.interval(), count, spacing, &asked);
            let what = format!("{text}, degree {degree}, {placing:?}");
            check(&what, &found.expect("a curve"), &curve, &[], bounded);
        }
    }
}

/// Beyond the ends the curve goes on, near the polygon's: that does not count.
#[test]
fn deviations_are_those_from_the_part_that_is_asked_for() {
    for (text, degree, placing) in [
        ("parabola:from=-3,to=3", 4, Placing::OnCurve),
        ("formula:x=t;y=sin(t);from=0.5;to=4", 6, Placing::OnCurve),
        (
            "formula:x=exp(t);y=exp(2*t);from=-1;to=1",
            2,
            Placing::Quasi,
        ),
    ] {
        let curve = curve(text);
        let asked = ApproximationRequest {
            degree,
            placing,
            ..PLACE
        };
        for count in [degree + 1, degree + 3, degree + 8] {
            let found =
                approximate_between(&curve, curve.interval(), count, Spacing::Parameter, &asked);
            let found = found.expect("a curve");
            let start = found.polygon.point(0.0);
            let [from, to] = found.interval;
            let ends = [from, to].map(|t| curve.derivatives(t, 0)[0]);
            check(&format!("{text}, {count}"), &found, &curve, &[], true);
            // The reference's own ends count too.
            for end in ends {
                let off = found.polygon.nearest(end).distance;
                assert!(
                    found.deviation.largest >= off * (1.0 - 1e-9),
                    "{text}, {count}, {start}"
                );
            }
        }
    }
}

#[test]
fn curves_and_their_parts_are_bounded_too() {
    let points: Vec<(f64, f64)> = (0..14)
        .map(|index| (f64::from(index), (1.3 * f64::from(index)).sin()))
        .collect();
    let open = FloatPolygon::planar(4, &points).expect("a curve");
    let vertices = open.vertices().to_vec();
    let weights = (0..14)
        .map(|index| 1.0 + 0.3 * f64::from(index % 3))
        .collect();
    let rational = FloatPolygon::new(4, vertices, Some(weights), false).expect("a curve");
    for given in [open, rational] {
        let end = given.segments() as f64;
        for interval in [[0.0, end], [1.3, 6.9]] {
            for count in [20, 37] {
                let found =
                    approximate_between(&given, interval, count, Spacing::Parameter, &PLACE);
                let found = found.expect("a curve");
                let expected = sampled(&found.polygon, &given, interval, &[]);
                let deviation = found.deviation;
                let share = deviation.largest / expected;
                assert!(
                    deviation.bounded && (0.999_999..1.02).contains(&share),
                    "{share}"
                );
            }
        }
    }
}

/// With 6 vertices samples show 2.5e-16.
#[test]
fn a_search_does_not_miss_a_peak_between_samples() {
    let peak = "formula:x=t;y=t^2+0.1*exp(-((t-0.3137)*1e4)^2);from=0;to=1";
    let curve = self::curve(peak);
    let goal = Goal {
        tolerance: 1e-8,
        spacing: Some(Spacing::Parameter),
        most_segments: 256,
    };
    let (progress, interval) = (Progress::default(), curve.interval());
    let found = approximate_to_tolerance(&curve, interval, &goal, &PLACE, &progress);
    let found = found.expect("a curve");
    check(peak, &found, &curve, &[0.3137], true);
    assert!(
        !found.meets(1e-8) && found.deviation.largest > 0.05,
        "{found:?}"
    );
    // Vertices that are close where the curve bends follow a wider one.
    let peak = "formula:x=t;y=t^2+0.1*exp(-((t-0.3137)*1e2)^2);from=0;to=1";
    let curve = self::curve(peak);
    let goal = Goal {
        tolerance: 1e-4,
        spacing: Some(Spacing::Curvature),
        most_segments: MOST_SEGMENTS,
    };
    let found = approximate_to_tolerance(&curve, interval, &goal, &PLACE, &progress);
    let found = found.expect("a curve");
    assert!(found.meets(1e-4), "{:?}", found.deviation);
    check(peak, &found, &curve, &[0.3137], true);
}
