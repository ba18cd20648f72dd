//! Log-aesthetic segments of chosen α: they are found again from their ends.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use batten::geometry::Progress;
use batten::geometry::between::{BetweenError, Ends, SegmentKind, between};
use glam::DVec2;

use crate::common::{Random, list, number, points, reference};
use crate::true_segment::TrueSegment;
use crate::{Placing, check, found, off};

/// How far a polygon's curve may be from the true segment, in units of its length.
const NEAR: f64 = 1e-6;

/// What Simpson's rule with 4000 steps leaves of a segment's length, and what the search for nearest
/// points may add.
const WITNESS: f64 = 1e-9;

/// What a sweep came to.
#[derive(Debug, Default)]
struct Worst {
    /// What ends are off, in units of the polygon's size.
    ends: f64,
    /// The distance from the true segment, in units of its length.
    distance: f64,
    /// How many segments a polygon has at most.
    segments: usize,
    /// How many have been looked at.
    cases: usize,
}

/// Draw admissible cases: α from −2 to 2, turning up to 160°, curvatures of the ends 5 % to ten times
/// apart, degrees 4 to 9, any place, size and side.
fn sweep(seed: u64, cases: usize) -> Worst {
    let mut random = Random(seed);
    let mut worst = Worst::default();
    for case in 0..cases {
        let side = if random.bits().is_multiple_of(2) {
            1.0
        } else {
            -1.0
        };
        let segment = TrueSegment {
            alpha: random.between(-2.0, 2.0),
            growth: side * random.between(1.05_f64.ln(), 10.0_f64.ln()),
            turning: random.between(3.0, 160.0).to_radians(),
        };
        let degree = 4 + case % 6;
        let points = segment.points();
        let placing = Placing::random(&mut random);
        let ends = placing.ends(points[points.len() - 1], segment.turning);
        let kind = SegmentKind::LogAesthetic {
            alpha: Some(segment.alpha),
        };
        let result = found(&ends, kind, degree);
        let result = result.unwrap_or_else(|error| panic!("{segment:?}: {error}"));
        check(&result, &ends, 0);
        let near = points.iter().step_by(40).map(|point| {
            let point = placing.point(*point).extend(0.0);
            result.polygon.nearest(point).distance
        });
        let distance = near.fold(0.0, f64::max) / result.length;
        assert!(distance <= NEAR, "{segment:?}: {distance:e} off");
        let said = result.deviation / result.length;
        assert!(
            distance <= said + WITNESS,
            "{distance:e}, said to be {said:e}"
        );
        worst.ends = worst.ends.max(off(&result, &ends));
        worst.distance = worst.distance.max(distance);
        worst.segments = worst.segments.max(result.polygon.segments());
        worst.cases += 1;
    }
    worst
}

#[test]
fn every_admissible_case_is_found_again_exact_at_its_ends_and_proved_monotone() {
    println!("{:?}", sweep(1, 60));
}

/// A thousand cases: a minute or two.
#[test]
#[ignore = "takes minutes"]
fn a_thousand_admissible_cases_are_found_again() {
    println!("{:?}", sweep(2, 1000));
}

#[test]
fn ends_that_bend_sharply_are_reached_at_all_degrees() {
    // Radii 22.5 times apart: by arc length the involute ends at 1/505 of the length beyond.
    for degree in 4..=9 {
        let segment = TrueSegment {
            alpha: 2.0,
            growth: -(22.5_f64.ln()),
            turning: FRAC_PI_2,
        };
        let points = segment.points();
        for side in [1.0, -1.0] {
            let placing = Placing {
                origin: DVec2::ZERO,
                axis: DVec2::X,
                side,
            };
            let ends = placing.ends(points[points.len() - 1], segment.turning);
            let kind = SegmentKind::LogAesthetic { alpha: Some(2.0) };
            check(&found(&ends, kind, degree).expect("a segment"), &ends, 0);
        }
    }
}

#[test]
fn an_alpha_far_from_all_that_is_used_has_limits_that_are_numbers() {
    for alpha in [-1e9, -100.0, 100.0, 1e9] {
        let ends = Ends {
            points: [DVec2::ZERO, DVec2::new(5.0, 3.0)],
            directions: [DVec2::X, DVec2::Y],
            curvatures: [None; 2],
        };
        let kind = SegmentKind::LogAesthetic { alpha: Some(alpha) };
        let error = found(&ends, kind, 5).expect_err("nearly an arc");
        let BetweenError::OutOfReach { reach, .. } = error else {
            panic!("{error}");
        };
        let middle = 0.5 * (reach[0] + reach[1]);
        assert!((middle - FRAC_PI_4).abs() <= 1e-12, "{reach:?}");
    }
}

#[test]
fn points_are_those_of_35_digits() {
    for segment in list(&reference("log_aesthetic_segments.json")["segments"]) {
        let [alpha, turning] = ["alpha", "turning"].map(|key| number(&segment[key]));
        let expected = points(&segment["points"]);
        let end = expected[expected.len() - 1].truncate();
        let placing = Placing {
            origin: DVec2::ZERO,
            axis: DVec2::X,
            side: 1.0,
        };
        let ends = placing.ends(end, turning);
        let kind = SegmentKind::LogAesthetic { alpha: Some(alpha) };
        let tolerance = Some(1e-9 * number(&segment["length"]));
        let found = between(&ends, kind, 7, tolerance, &Progress::default()).expect("a segment");
        check(&found, &ends, 0);
        for point in expected {
            let distance = found.polygon.nearest(point).distance;
            assert!(
                distance <= 1.01e-9 * found.length,
                "α = {alpha}: {distance:e} off"
            );
        }
        assert!((found.length / number(&segment["length"]) - 1.0).abs() <= 1e-8);
    }
}
