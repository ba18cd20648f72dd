//! Superspiral segments: they are found again from their ends.

use batten::geometry::between::{BetweenError, Ends, SegmentKind};
use glam::DVec2;

use crate::common::Random;
use crate::{Placing, check, found};

/// The superspiral 1, 1, 2, whose radius of curvature is ln(1 + ψ)/ψ.
const LOGARITHMIC: SegmentKind = SegmentKind::Superspiral {
    values: [1.0, 1.0, 2.0],
};

/// Steps of Simpson's rule.
const STEPS: usize = 2000;

/// How exactly the beginning of a segment is found again: near an arc all are alike.
const FOUND: f64 = 1e-7;

/// Points of the spiral at even direction angles, from the origin on.
fn points(begin: f64, turning: f64) -> Vec<DVec2> {
    let radius = |angle: f64| {
        if angle == 0.0 {
            1.0
        } else {
            angle.ln_1p() / angle
        }
    };
    let slope = |angle: f64| radius(angle) * DVec2::from_angle(angle);
    let step = turning / STEPS as f64;
    let mut points = vec![DVec2::ZERO];
    for index in 0..STEPS {
        let from = begin + step * index as f64;
        let sum = slope(from) + 4.0 * slope(from + 0.5 * step) + slope(from + step);
        points.push(points[index] + step / 6.0 * sum);
    }
    points
}

#[test]
fn segments_are_found_again_in_both_ways_and_on_both_sides() {
    let mut random = Random(4);
    for case in 0..12 {
        let (begin, turning) = (random.between(0.0, 3.0), random.between(0.4, 2.5));
        let placing = Placing::random(&mut random);
        let points: Vec<DVec2> = points(begin, turning)
            .into_iter()
            .map(|point| placing.point(point))
            .collect();
        let direction = |angle: f64| placing.vector(DVec2::from_angle(angle));
        let mut ends = Ends {
            points: [points[0], points[STEPS]],
            directions: [direction(begin), direction(begin + turning)],
            curvatures: [None; 2],
        };
        let reversed = case % 2 == 1;
        if reversed {
            ends.points.reverse();
            ends.directions = [-ends.directions[1], -ends.directions[0]];
        }
        let segment = found(&ends, LOGARITHMIC, 4 + case % 6).expect("a segment");
        check(&segment, &ends, 0);
        let [part] = &segment.parts[..] else {
            panic!("{} parts", segment.parts.len());
        };
        assert_eq!(part.reversed, reversed);
        let [from, to] = part.curve.interval();
        assert!((from - begin).abs() <= FOUND && (to - from - turning).abs() <= 1e-12);
        for point in points.iter().step_by(100) {
            let distance = segment.polygon.nearest(point.extend(0.0)).distance;
            assert!(distance <= 1e-6 * segment.length, "{distance:e} off");
        }
    }
}

#[test]
fn where_there_is_none_the_limits_are_told() {
    let ends = |start: f64, end: f64| Ends {
        points: [DVec2::ZERO, DVec2::X],
        directions: [-start, end].map(|angle| DVec2::from_angle(angle.to_radians())),
        curvatures: [None; 2],
    };
    let error = found(&ends(20.0, 70.0), LOGARITHMIC, 5).expect_err("too far");
    let BetweenError::OutOfReach { reach, .. } = error else {
        panic!("{error}");
    };
    let [low, high] = reach.map(f64::to_degrees);
    assert!(20.0 < low && low < high && high < 45.0, "{low} {high}");
    let inside = ends(0.5 * (low + high), 90.0 - 0.5 * (low + high));
    check(
        &found(&inside, LOGARITHMIC, 5).expect("a segment"),
        &inside,
        0,
    );
    // The same the other way round, with the curvature falling.
    let error = found(&ends(70.0, 20.0), LOGARITHMIC, 5).expect_err("too far");
    let BetweenError::OutOfReach {
        reach: mirrored, ..
    } = error
    else {
        panic!("{error}");
    };
    for (one, other) in reach
        .into_iter()
        .zip([1, 0].map(|index: usize| mirrored[index]))
    {
        assert!((one + other - 90.0_f64.to_radians()).abs() <= 1e-12);
    }
    let values = [1.0, 2.0, 1.5];
    let refused = found(&inside, SegmentKind::Superspiral { values }, 5);
    assert_eq!(refused, Err(BetweenError::NotMonotone { values }));
}
