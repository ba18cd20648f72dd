//! Neighbours that follow what is moved by hand.

use batten::geometry::end_correction::{EndDifference, EndTarget};
use batten::geometry::fairing::following::{follow_softly, follow_target};
use batten::geometry::fairing::joint_correction::CorrectionError;
use batten::geometry::{Continuity, End, FloatPolygon};
use glam::{DQuat, DVec3};

use crate::common::Random;

/// A fair polygon of unit legs.
fn fair(count: usize, degree: usize, in_space: bool, periodic: bool) -> FloatPolygon {
    let turn = if periodic {
        std::f64::consts::TAU / count as f64
    } else {
        2.0 / count as f64
    };
    let vertices = (0..count).map(|index| {
        let (sine, cosine) = (turn * index as f64).sin_cos();
        let z = if in_space { 0.2 * index as f64 } else { 0.0 };
        DVec3::new(cosine / turn, sine / turn, z)
    });
    FloatPolygon::new(degree, vertices.collect(), None, periodic).expect("valid")
}

#[test]
fn a_soft_drag_falls_off() {
    let polygon = fair(20, 4, false, true);
    let by = DVec3::new(1.0, 2.0, 0.0);
    let place = polygon.vertex(1) + by;
    let found = follow_softly(&polygon, &[(1, place)], 3, &[2]).expect("valid");
    let moved = |index: usize| found.vertex(index) - polygon.vertex(index);
    assert_eq!(found.vertex(1), place);
    assert_eq!(moved(2), DVec3::ZERO);
    for (index, share) in [(0, 1), (3, 2), (4, 3), (19, 2), (18, 3)] {
        let falloff = 0.5 + 0.5 * (std::f64::consts::PI * f64::from(share) / 4.0).cos();
        assert!(moved(index).distance(falloff * by) <= 1e-14, "{index}");
    }
    assert_eq!(moved(5), DVec3::ZERO);
    assert!(follow_softly(&polygon, &[(20, place)], 3, &[]).is_err());
}

/// A target near to what an end has, up to some level.
fn near_target(
    polygon: &FloatPolygon,
    end: End,
    level: Continuity,
    random: &mut Random,
    in_space: bool,
) -> EndTarget {
    let own = level.target(&polygon.end_jet(end), !in_space);
    let turn = DQuat::from_rotation_z(random.vector(0.3, false).x);
    EndTarget {
        point: own.point + random.vector(0.5, in_space),
        direction: own.direction.map(|direction| turn * direction),
        normal: own.normal.map(|normal| turn * normal),
        curvature: own.curvature.map(|curvature| 1.2 * curvature),
        slope: own.slope,
    }
}

#[test]
fn an_end_follows_its_target_and_the_other_end_and_what_is_far_or_locked_stays() {
    let mut random = Random(77);
    for trial in 0..120 {
        let in_space = trial % 3 == 1;
        let degree = 3 + trial % 6;
        let count = [40, 2 * degree + 1][trial % 2];
        let polygon = fair(count, degree, in_space, false);
        let end = End::BOTH[trial / 2 % 2];
        let level = Continuity::ALL[trial / 4 % Continuity::ALL.len()];
        let target = near_target(&polygon, end, level, &mut random, in_space);
        let (span, locked) = (6, [count / 2]);
        let found = follow_target(&polygon, end, &target, span, &locked);
        let found = found.unwrap_or_else(|error| panic!("trial {trial}: {error}"));
        let left = EndDifference::between(&found, end, &target).residual(polygon.size());
        assert!(left <= 1e-9 * polygon.size(), "trial {trial}: {left:e}");
        let other = end.other();
        let kept = Continuity::G1.target(&polygon.end_jet(other), !in_space);
        let moved = EndDifference::between(&found, other, &kept).residual(polygon.size());
        assert!(moved <= 1e-12 * polygon.size(), "trial {trial}: {moved:e}");
        for index in 0..count {
            let from_end = if end == End::Start {
                index
            } else {
                count - 1 - index
            };
            if from_end >= degree + span || locked.contains(&index) {
                assert_eq!(found.vertex(index), polygon.vertex(index), "trial {trial}");
            }
        }
        assert_eq!(found.is_planar(), !in_space, "trial {trial}");
    }
}

#[test]
fn a_target_out_of_reach_is_refused() {
    let polygon = fair(12, 4, false, false);
    let mut target = Continuity::G1.target(&polygon.end_jet(End::Start), true);
    target.point.x += 0.1;
    let all: Vec<usize> = (0..12).collect();
    let found = follow_target(&polygon, End::Start, &target, 3, &all);
    assert!(matches!(found, Err(CorrectionError::NotSolvable { .. })));
    let closed = fair(12, 4, false, true);
    let found = follow_target(&closed, End::Start, &target, 3, &[]);
    assert_eq!(found, Err(CorrectionError::Periodic));
}
