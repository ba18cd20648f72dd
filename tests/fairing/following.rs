//! Neighbours that follow what is moved by hand.

use batten::geometry::end_correction::{EndDifference, EndTarget};
use batten::geometry::fairing::following::{
    Moved, follow_in_harmony, follow_softly, follow_target,
};
use batten::geometry::fairing::joint_correction::{CorrectionError, Disturbance, correct_jointly};
use batten::geometry::polygon_figures::{discrete_curvature, turning_angle};
use batten::geometry::{ClampedPolygon, Continuity, End, FloatPolygon, Progress};
use glam::{DQuat, DVec3};

use crate::check_ends;
use crate::common::Random;

const STIFFNESS: f64 = 0.01;

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

/// The largest second difference of the discrete curvature.
fn roughness(polygon: &FloatPolygon) -> f64 {
    let corners = polygon.vertices().windows(3);
    let curvature: Vec<f64> = corners
        .map(|c| discrete_curvature(c[0], c[1], c[2]))
        .collect();
    let differences = curvature
        .windows(3)
        .map(|k| (k[0] - 2.0 * k[1] + k[2]).abs());
    differences.fold(0.0, f64::max)
}

#[test]
fn neighbours_follow_in_harmony_and_all_else_stays() {
    let mut random = Random(31);
    for trial in 0..60 {
        let (in_space, periodic) = (trial % 3 == 1, trial % 5 == 4);
        let degree = 3 + trial % 7;
        let polygon = fair(40, degree, in_space, periodic);
        let vertex = (random.bits() % 40) as usize;
        let place = polygon.vertex(vertex) + random.vector(0.3, in_space);
        let moved = Moved::Vertices(vec![(vertex, place)]);
        let locked = [(vertex + 3) % 40];
        let span = 6;
        let found = follow_in_harmony(&polygon, &moved, span, STIFFNESS, &locked).expect("valid");
        assert_eq!(found.vertex(vertex), place, "trial {trial}");
        for index in 0..40_usize {
            let apart = index.abs_diff(vertex);
            let apart = if periodic {
                apart.min(40 - apart)
            } else {
                apart
            };
            if apart > span || locked.contains(&index) {
                assert_eq!(found.vertex(index), polygon.vertex(index), "trial {trial}");
            }
        }
        if !periodic {
            check_ends(&polygon, &found);
        }
        let again = follow_in_harmony(&polygon, &moved, span, STIFFNESS, &locked);
        assert_eq!(again, Ok(found), "trial {trial}");
    }
}

#[test]
fn following_is_smoother_than_moving_alone_and_than_a_falloff() {
    let polygon = fair(40, 5, false, false);
    let place = polygon.vertex(20) + DVec3::new(0.2, 0.3, 0.0);
    let mut alone = polygon.clone();
    alone.move_vertices([(20, place)]).expect("in range");
    let soft = follow_softly(&polygon, &[(20, place)], 8, &[]).expect("valid");
    let moved = Moved::Vertices(vec![(20, place)]);
    let harmonious = follow_in_harmony(&polygon, &moved, 8, 1e-6, &[]).expect("valid");
    let [alone, soft, harmonious] = [&alone, &soft, &harmonious].map(roughness);
    assert!(
        harmonious < soft && soft < 0.1 * alone,
        "{harmonious} {soft} {alone}"
    );
}

#[test]
fn a_vertex_of_the_closed_polygon_goes_where_it_is_moved() {
    for degree in 2..=7 {
        let polygon = fair(30, degree, false, false);
        let clamped = ClampedPolygon::from_float(&polygon);
        for index in [0, 1, 2, 14, 28, 29] {
            let place = clamped.vertices()[index] + DVec3::new(0.1, -0.2, 0.0);
            let moved = Moved::Clamped(index, place);
            let found = follow_in_harmony(&polygon, &moved, 6, STIFFNESS, &[]).expect("valid");
            let reached = ClampedPolygon::from_float(&found).vertices()[index];
            let left = reached.distance(place);
            assert!(
                left <= 1e-9 * polygon.size(),
                "degree {degree} {index}: {left:e}"
            );
            if (2..28).contains(&index) {
                check_ends(&polygon, &found);
            }
        }
    }
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

#[test]
fn large_moves_do_not_fold_the_polygon() {
    let polygon = fair(34, 5, false, false);
    for span in 5..20 {
        for legs in [1.0, 2.0, 4.0] {
            let place = polygon.vertex(15) + legs * DVec3::new(0.6, 0.8, 0.0);
            let moved = Moved::Vertices(vec![(15, place)]);
            let found = follow_in_harmony(&polygon, &moved, span, 1e-4, &[]).expect("valid");
            let corners = found.vertices().windows(3);
            let turns = corners.map(|c| turning_angle(c[0], c[1], c[2]).abs());
            let most = turns.fold(0.0, f64::max);
            assert!(most < 1.2, "span {span}, {legs} legs: {most}");
        }
    }
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
        let found = follow_target(&polygon, end, &target, span, STIFFNESS, &locked);
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
fn following_a_target_is_smoother_than_the_least_disturbance() {
    let polygon = fair(40, 5, false, false);
    let jet = polygon.end_jet(End::Finish);
    let target = EndTarget {
        point: jet.point + DVec3::new(0.8, 0.6, 0.0),
        direction: jet.tangent(),
        ..EndTarget::default()
    };
    let followed = follow_target(&polygon, End::Finish, &target, 10, 1e-6, &[]);
    let targets = [(End::Finish, target)];
    let least = correct_jointly(
        &polygon,
        &targets,
        Disturbance::Differences(1),
        &[],
        &Progress::default(),
    );
    let followed = roughness(&followed.expect("reached"));
    let least = roughness(&least.expect("reached").polygon);
    assert!(followed < 0.5 * least, "{followed} {least}");
}

#[test]
fn a_target_out_of_reach_is_refused() {
    let polygon = fair(12, 4, false, false);
    let mut target = Continuity::G1.target(&polygon.end_jet(End::Start), true);
    target.point.x += 0.1;
    let all: Vec<usize> = (0..12).collect();
    let found = follow_target(&polygon, End::Start, &target, 3, STIFFNESS, &all);
    assert!(matches!(found, Err(CorrectionError::NotSolvable { .. })));
    let closed = fair(12, 4, false, true);
    let found = follow_target(&closed, End::Start, &target, 3, STIFFNESS, &[]);
    assert_eq!(found, Err(CorrectionError::Periodic));
}
