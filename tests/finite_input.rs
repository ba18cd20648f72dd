//! Whatever finite numbers a polygon is made of, nothing panics and nothing runs for ever.

mod common;

use batten::geometry::end_correction::{
    EndDifference, EndOverlap, EndTarget, align_end, angle_between, correct_end, correct_in_turn,
};
use batten::geometry::fairing::joint_correction::{Disturbance, correct_jointly};
use batten::geometry::features::Features;
use batten::geometry::harmony::Harmony;
use batten::geometry::polygon_figures::{
    discrete_curvature, discrete_torsion, torsion_angle, turning_angle,
};
use batten::geometry::{
    Batch, BezierPolygon, ClampedPolygon, End, FloatPolygon, MAX_DEGREE, Progress, Sampler,
    segment_bezier,
};
use glam::DVec3;
use proptest::prelude::*;

/// Coordinates that arithmetic stumbles over.
const COORDINATES: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1.0 + f64::EPSILON,
    0.1,
    3.0,
    1e-300,
    -1e-300,
    5e-324,
    1e-160,
    1e50,
    1e77,
    -1e77,
    1e100,
    -1e100,
];

/// Weights that arithmetic stumbles over.
const WEIGHTS: [f64; 5] = [1.0, 0.5, 2.0, 1e-100, 1e100];

/// Call everything there is on a polygon and on what its conversions make of it.
fn call_everything(polygon: &FloatPolygon, target: DVec3, direction: DVec3) {
    look_at(polygon, target);
    let clamped = ClampedPolygon::from_float(polygon);
    let _ = (clamped.knots(), clamped.segments());
    if let Ok(back) = clamped.to_float() {
        look_at(&back, target);
    }
    if let Ok(back) = BezierPolygon::from_float(polygon).to_float() {
        look_at(&back, target);
    }
    let both = End::BOTH.map(|end| {
        let target = EndTarget {
            point: target,
            direction: Some(direction),
            ..EndTarget::default()
        };
        (end, target)
    });
    let _ = correct_jointly(
        polygon,
        &both,
        Disturbance::Differences(1),
        &[],
        &Progress::default(),
    );
    if polygon.is_periodic() {
        return;
    }
    let _ = EndOverlap::of(polygon);
    let _ = correct_in_turn(polygon, &both, 1e-12 * polygon.size());
    for (end, target) in &both {
        let _ = correct_end(polygon, *end, target);
        let _ = align_end(polygon, *end, direction);
        let _ = EndDifference::between(polygon, *end, target).residual(polygon.size());
    }
}

fn look_at(polygon: &FloatPolygon, target: DVec3) {
    let last = polygon.segments() as f64;
    for u in [
        0.0,
        0.3,
        0.5 * last,
        last,
        -1.0,
        last + 1.0,
        1e300,
        f64::NAN,
    ] {
        let jet = polygon.jet(u);
        let _ = (jet.signed_curvature(), jet.curvature(), jet.torsion());
        let _ = (jet.tangent(), jet.speed(), jet.centre_of_curvature());
        let _ = polygon.point(u);
    }
    let nearest = polygon.nearest(target);
    assert!(
        (0.0..=last).contains(&nearest.u),
        "nearest at {}",
        nearest.u
    );
    let _ = polygon.arc_length(1e-9);
    let _ = polygon.arc_length(0.0);
    let _ = (polygon.size(), polygon.reversed(), polygon.unrolled());
    let (degree, mut batch) = (polygon.degree(), Batch::default());
    for sampler in [
        Sampler::even(degree, 17),
        Sampler::even(degree, 0),
        Sampler::new(degree, &[]),
    ] {
        for segment in 0..polygon.segments() {
            sampler.segment(polygon, segment, 3, &mut batch);
            let _: Vec<_> = (0..batch.len()).map(|index| batch.jet(index)).collect();
        }
    }
    let _ = segment_bezier(polygon, 0);
    let harmony = Harmony::of(polygon, &Features::default());
    assert_eq!(harmony.regularity.highest, degree - 1);
    let vertices = polygon.vertices();
    for four in vertices.windows(4) {
        let _ = torsion_angle(four[0], four[1], four[2], four[3]);
        let _ = discrete_torsion(four[0], four[1], four[2], four[3]);
    }
    for corner in vertices.windows(3) {
        for planar in [true, false] {
            let _ = discrete_curvature(corner[0], corner[1], corner[2], planar);
            let _ = turning_angle(corner[0], corner[1], corner[2], planar);
        }
        let _ = angle_between(corner[0], corner[1]);
    }
}

fn both_ways(degree: usize, vertices: &[DVec3], weights: Option<&[f64]>) {
    for periodic in [false, true] {
        let weights = weights.map(<[f64]>::to_vec);
        let polygon = FloatPolygon::new(degree, vertices.to_vec(), weights, periodic);
        let polygon = polygon.expect("a valid polygon");
        call_everything(&polygon, DVec3::new(1.0, 2.0, 0.0), DVec3::X);
    }
}

#[test]
fn every_degree_with_the_fewest_vertices() {
    for degree in 1..=MAX_DEGREE {
        let bent = (0..=degree).map(|i| DVec3::new(i as f64, (i * i) as f64 * 0.01, 0.0));
        let bent: Vec<DVec3> = bent.collect();
        both_ways(degree, &bent, None);
        both_ways(degree, &bent, Some(&vec![2.0; degree + 1]));
    }
}

#[test]
fn lines_and_coincident_vertices() {
    for degree in [1, 2, 3, 9, 25] {
        for scale in [1.0, 1e100, 1e-300, 5e-324] {
            let count = degree + 3;
            let line: Vec<DVec3> = (0..count)
                .map(|i| DVec3::new(scale, scale, 0.0) * (i as f64 / count as f64))
                .collect();
            both_ways(degree, &line, None);
            both_ways(degree, &vec![DVec3::splat(scale); count], None);
            let folded: Vec<DVec3> = (0..count).map(|i| line[i % 2]).collect();
            both_ways(degree, &folded, None);
        }
    }
}

#[test]
fn large_and_tiny_weights() {
    for degree in [1, 3, 9, 25] {
        let count = degree + 2;
        for scale in [1.0, 1e100, 1e-300] {
            let vertices: Vec<DVec3> = (0..count)
                .map(|i| DVec3::new(i as f64, (i % 3) as f64, 0.0) * (scale / count as f64))
                .collect();
            let weights: Vec<f64> = (0..count).map(|i| WEIGHTS[3 + i % 2]).collect();
            both_ways(degree, &vertices, Some(&weights));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..common::repeatable() })]

    #[test]
    fn any_finite_polygon(
        degree in 1..=MAX_DEGREE,
        extra in 0..6_usize,
        periodic in any::<bool>(),
        rational in any::<bool>(),
        flat in any::<bool>(),
        picks in proptest::collection::vec((0..16_usize, 0..16_usize, 0..16_usize, 0..5_usize), 34),
    ) {
        let count = degree + 1 + extra;
        let vector = |pick: &(usize, usize, usize, usize)| {
            let z = if flat { 0.0 } else { COORDINATES[pick.2] };
            DVec3::new(COORDINATES[pick.0], COORDINATES[pick.1], z)
        };
        let vertices = picks[..count].iter().map(vector).collect();
        let weights = picks[..count].iter().map(|pick| WEIGHTS[pick.3]).collect();
        let weights = Some(weights).filter(|_| rational);
        let polygon = FloatPolygon::new(degree, vertices, weights, periodic).expect("valid");
        call_everything(&polygon, vector(&picks[32]), vector(&picks[33]));
    }
}
