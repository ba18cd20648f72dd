//! Where there is a segment, where there is none, and what is said then.

use batten::geometry::End;
use batten::geometry::between::{BetweenError, Ends, SegmentKind};
use glam::DVec2;

use crate::common::Random;
use crate::{Placing, check, found, is_reached, off};

/// How near radii a million times apart come to the limit, in radians.
const NEARLY: f64 = 1e-3;

const CLOTHOID: SegmentKind = SegmentKind::LogAesthetic { alpha: None };

/// Ends on a chord from (0, 0) to (1, 0), by the angles of their directions to it in degrees.
fn on_chord(start: f64, end: f64) -> Ends {
    Ends {
        points: [DVec2::ZERO, DVec2::X],
        directions: [-start, end].map(|angle: f64| DVec2::from_angle(angle.to_radians())),
        curvatures: [None; 2],
    }
}

/// The chord of the segment whose radius of curvature has grown without limit: with α < 0 from 1 to
/// infinity, by arc length; with α > 1 from 0 to 1, by the angle.
fn steepest(alpha: f64, turning: f64) -> DVec2 {
    let steps = 200_000;
    let slope = |share: f64| {
        if alpha < 0.0 {
            let angle = 1.0 - (1.0 - share).powf(1.0 - alpha.recip());
            DVec2::from_angle(turning * angle)
        } else {
            share.powf((alpha - 1.0).recip()) * DVec2::from_angle(turning * share)
        }
    };
    let middles = (0..steps).map(|step| slope((f64::from(step) + 0.5) / f64::from(steps)));
    middles.sum()
}

#[test]
fn the_limits_that_are_told_are_those_of_segments_whose_radius_grows_without_limit() {
    for alpha in [-2.0, -0.5, 1.5, 2.0] {
        let kind = SegmentKind::LogAesthetic { alpha: Some(alpha) };
        let error = found(&on_chord(88.0, 2.0), kind, 5).expect_err("too far");
        let BetweenError::OutOfReach {
            reach,
            turning,
            angle,
            ..
        } = error
        else {
            panic!("{error}");
        };
        assert!((angle - 88.0_f64.to_radians()).abs() <= 1e-12);
        let limit = steepest(alpha, turning).to_angle();
        assert!(
            (reach[1] - limit).abs() <= NEARLY,
            "{alpha}: {limit} {reach:?}"
        );
        assert!((reach[0] + reach[1] - turning).abs() <= 1e-12);
        let [low, high] = reach.map(f64::to_degrees);
        for share in [0.15, 0.4, 0.6, 0.85] {
            let angle = low + share * (high - low);
            let ends = on_chord(angle, 90.0 - angle);
            check(&found(&ends, kind, 6).expect("a segment"), &ends, 0);
        }
        assert!(found(&on_chord(high + 0.01, 90.0 - high - 0.01), kind, 6).is_err());
    }
}

#[test]
fn the_clothoid_goes_on_through_its_inflection() {
    // With a chord at 30° to 60° of 90° it does not need one: ρ = (1 − 2Λθ)^{−1/2}, Λ up to 1/π.
    for (start, end, inflections) in [
        (50.0, 40.0, 0),
        (70.0, 20.0, 1),
        (30.0, -20.0, 1),
        (40.0, -40.0, 1),
        (-10.0, 70.0, 1),
        (0.0, 30.0, 1),
    ] {
        let ends = on_chord(start, end);
        let segment = found(&ends, CLOTHOID, 5).expect("a clothoid");
        check(&segment, &ends, inflections);
        let name = segment.parts[0].curve.to_string();
        assert_eq!(name.starts_with("clothoid"), inflections == 1, "{name}");
    }
}

#[test]
fn random_s_shaped_ends_are_joined_by_a_clothoid() {
    let mut random = Random(3);
    for case in 0..40 {
        let angles = [random.between(5.0, 80.0), random.between(5.0, 80.0)];
        let chord = on_chord(angles[0], -angles[1]);
        let placing = Placing::random(&mut random);
        let ends = Ends {
            points: chord.points.map(|point| placing.point(point)),
            directions: chord.directions.map(|direction| placing.vector(direction)),
            curvatures: [None; 2],
        };
        let segment = found(&ends, CLOTHOID, 4 + case % 6).expect("a clothoid");
        check(&segment, &ends, 1);
    }
}

#[test]
fn without_an_inflection_there_is_none_through_one() {
    let kind = SegmentKind::LogAesthetic { alpha: Some(0.5) };
    let error = found(&on_chord(30.0, -20.0), kind, 5).expect_err("an inflection");
    assert!(matches!(error, BetweenError::Inflection { .. }), "{error}");
    let any = found(&on_chord(30.0, -20.0), SegmentKind::AnyMonotone, 5).expect("a curve");
    check(&any, &on_chord(30.0, -20.0), 1);
}

#[test]
fn any_monotone_curve_is_found_where_no_log_aesthetic_segment_is() {
    for (start, end) in [(20.0, 70.0), (75.0, 15.0), (40.0, 50.0), (100.0, 40.0)] {
        for degree in [4, 5, 7] {
            let ends = on_chord(start, end);
            let segment = found(&ends, SegmentKind::AnyMonotone, degree).expect("a curve");
            check(&segment, &ends, 0);
            assert!(segment.parts.is_empty());
        }
    }
}

#[test]
fn a_straight_segment_is_straight() {
    for kind in [CLOTHOID, SegmentKind::AnyMonotone] {
        let ends = on_chord(0.0, 0.0);
        let segment = found(&ends, kind, 4).expect("a line");
        check(&segment, &ends, 0);
        assert_eq!(segment.length, 1.0);
    }
}

#[test]
fn any_monotone_curve_is_found_where_a_log_aesthetic_segment_is() {
    let ends = |directions: [[f64; 2]; 2], curvatures| Ends {
        points: [DVec2::ZERO, DVec2::new(10.0, 0.0)],
        directions: directions.map(DVec2::from),
        curvatures,
    };
    // Harmonising does not reach these.
    for (ends, inflections, degree) in [
        (
            ends([[1.0, 1.0], [2.0, -1.0]], [Some(-0.3), Some(0.1)]),
            1,
            5,
        ),
        (ends([[-1.0, 0.2], [-1.0, -0.1]], [None; 2]), 0, 5),
        (ends([[-1.0, 0.2], [-1.0, 0.1]], [None; 2]), 1, 7),
    ] {
        let segment = found(&ends, SegmentKind::AnyMonotone, degree).expect("a curve");
        check(&segment, &ends, inflections);
    }
}

#[test]
fn a_stronger_curvature_where_the_angle_to_the_chord_is_smaller_is_refused() {
    // Circles of curvature one inside the other: only the angles tell.
    for kind in [CLOTHOID, SegmentKind::AnyMonotone] {
        let mut ends = Ends {
            points: [DVec2::ZERO, DVec2::new(10.0, 0.0)],
            directions: [DVec2::new(1.0, 1.0), DVec2::new(2.0, -1.0)],
            curvatures: [Some(-0.1), Some(-0.3)],
        };
        let error = found(&ends, kind, 5).expect_err("no such curve");
        let BetweenError::OtherLean { angles, curvatures } = error else {
            panic!("{error}");
        };
        assert!((angles[0].to_degrees() - 45.0).abs() <= 1e-12);
        assert!((angles[1].tan() - 0.5).abs() <= 1e-12);
        let [first, last] = curvatures;
        assert!((first + 0.1).abs() <= 1e-15 && (last + 0.3).abs() <= 1e-15);
        ends.curvatures = [Some(-0.25), Some(-0.06)];
        check(&found(&ends, kind, 5).expect("a curve"), &ends, 0);
    }
}

#[test]
fn the_ends_of_an_arc_are_joined_by_the_arc() {
    let bend = Some(2.0 * 30.0_f64.to_radians().sin());
    for (kind, curvatures) in [
        (CLOTHOID, [None; 2]),
        (CLOTHOID, [bend; 2]),
        (SegmentKind::AnyMonotone, [None; 2]),
        (SegmentKind::AnyMonotone, [bend; 2]),
    ] {
        let curvatures = curvatures.map(|it: Option<f64>| it.map(|it| -it));
        let ends = Ends {
            directions: on_chord(-30.0, -30.0).directions,
            curvatures,
            ..on_chord(30.0, 30.0)
        };
        let segment = found(&ends, kind, 5).expect("an arc");
        assert!(segment.arc && is_reached(&segment));
        assert!(off(&segment, &ends) <= crate::EXACT);
        let bends = segment.polygon.end_jet(End::Start).signed_curvature();
        assert!((bends + 1.0).abs() <= NEARLY, "{bends}");
        let angle = 30.0_f64.to_radians();
        let apart = (segment.length - angle / angle.sin()).abs();
        assert!(apart <= segment.tolerance, "{apart}");
    }
}

#[test]
fn ends_that_are_none_are_refused() {
    let nowhere = Ends {
        points: [DVec2::ONE; 2],
        ..on_chord(10.0, 20.0)
    };
    let aimless = Ends {
        directions: [DVec2::ZERO, DVec2::X],
        ..on_chord(10.0, 20.0)
    };
    let far = Ends {
        points: [DVec2::new(1e300, 0.0), DVec2::ZERO],
        ..on_chord(10.0, 20.0)
    };
    let error = found(&far, CLOTHOID, 5).expect_err("too far");
    assert!(
        matches!(error, BetweenError::ChordOutOfRange { .. }),
        "{error}"
    );
    // A short direction is one.
    let plain = on_chord(10.0, 20.0);
    let short = Ends {
        directions: plain.directions.map(|direction| 1e-300 * direction),
        ..plain
    };
    check(&found(&short, CLOTHOID, 5).expect("a clothoid"), &plain, 0);
    let errors = [nowhere, aimless].map(|ends| found(&ends, CLOTHOID, 5).err());
    let expected = [BetweenError::NoChord, BetweenError::NoDirection];
    assert_eq!(errors, expected.map(Some));
}
