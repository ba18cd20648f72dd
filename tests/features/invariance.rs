//! What must not change proved features, and that any finite input is taken.

use std::f64::consts::TAU;

use crate::common::{Random, counts, exact};
use batten::geometry::FloatPolygon;
use batten::geometry::features::Features;
use glam::{DMat3, DVec3};
use proptest::prelude::*;

#[test]
fn size_and_place_do_not_matter() {
    let mut random = Random(11);
    for degree in 2..=12 {
        let points: Vec<_> = (0..degree + 4)
            .map(|_| random.vector(100.0, false).round())
            .collect();
        let build = |map: &dyn Fn(DVec3) -> DVec3, weighted: bool| {
            let vertices = points.iter().map(|point| map(*point)).collect();
            let weights = (0..points.len()).map(|i| 1.0 + (i % 3) as f64).collect();
            let weights = Some(weights).filter(|_| weighted);
            exact(&FloatPolygon::new(degree, vertices, weights, false).expect("valid"))
        };
        for weighted in [false, true] {
            let expected = counts(&build(&|point| point, weighted));
            for exponent in [-90, -50, 50, 90] {
                let scale = 10.0_f64.powi(exponent);
                assert_eq!(counts(&build(&|point| point * scale, weighted)), expected);
            }
            // Whole numbers stay exact.
            let far = DVec3::new(2.0_f64.powi(44), -(2.0_f64.powi(43)), 0.0);
            assert_eq!(counts(&build(&|point| point + far, weighted)), expected);
        }
    }
}

#[test]
fn the_joint_of_a_periodic_curve_is_a_knot_like_any_other() {
    let mut random = Random(12);
    for degree in 2..=9 {
        let points: Vec<_> = (0..degree + 3)
            .map(|_| random.vector(10.0, false))
            .collect();
        let found = (0..points.len()).map(|by| {
            let mut vertices = points.clone();
            vertices.rotate_left(by);
            counts(&Features::new(
                &FloatPolygon::new(degree, vertices, None, true).expect("valid"),
            ))
        });
        let found: Vec<_> = found.collect();
        assert!(found.iter().all(|counts| *counts == found[0]), "{found:?}");
        assert!(found[0][1] >= 2 && found[0][1].is_multiple_of(2) && found[0][0].is_multiple_of(2));
    }
}

/// Evaluate the blossom of a curve of one segment (de Boor's algorithm, one argument a level).
fn blossom(vertices: &[DVec3], arguments: &[f64]) -> DVec3 {
    let mut values = vertices.to_vec();
    let degree = arguments.len();
    for (level, argument) in arguments.iter().enumerate() {
        let width = (degree - level) as f64;
        for i in 0..degree - level {
            let right = i as f64 + 1.0;
            let share = (argument - (right - width)) / width;
            values[i] = values[i].lerp(values[i + 1], share);
        }
    }
    values[0]
}

/// The float polygon of degree n of the part of a curve of one segment that runs from `from` to
/// `from` + `length`.
fn part(vertices: &[DVec3], from: f64, length: f64) -> Vec<DVec3> {
    let degree = vertices.len() - 1;
    let knot = |index: usize| from + length * (index as f64 - degree as f64 + 1.0);
    (0..=degree)
        .map(|i| blossom(vertices, &(i..i + degree).map(knot).collect::<Vec<_>>()))
        .collect()
}

/// The float polygon of degree n + 1 of a curve of one segment of degree n.
fn raised(vertices: &[DVec3]) -> Vec<DVec3> {
    let degree = vertices.len();
    (0..=degree)
        .map(|i| {
            let knots: Vec<f64> = (i..i + degree)
                .map(|index| index as f64 - degree as f64 + 1.0)
                .collect();
            let without = |left_out: usize| {
                let kept = knots
                    .iter()
                    .enumerate()
                    .filter(|(index, _)| *index != left_out);
                blossom(vertices, &kept.map(|(_, knot)| *knot).collect::<Vec<_>>())
            };
            (0..degree).map(without).sum::<DVec3>() / degree as f64
        })
        .collect()
}

fn total(polygons: &[Vec<DVec3>]) -> [usize; 5] {
    let mut total = [0; 5];
    for vertices in polygons {
        let degree = vertices.len() - 1;
        let curve = FloatPolygon::new(degree, vertices.clone(), None, false).expect("valid");
        for (total, count) in total.iter_mut().zip(counts(&Features::new(&curve))) {
            *total += count;
        }
    }
    total
}

proptest! {
    #![proptest_config(crate::common::repeatable())]

    #[test]
    fn rigid_motions_scaling_and_reversal_keep_the_counts(
        degree in 2..=10_usize,
        extra in 0..5_usize,
        in_space in any::<bool>(),
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let points: Vec<_> =
            (0..=degree + extra).map(|_| random.vector(10.0, in_space)).collect();
        let weights: Vec<f64> = points.iter().map(|_| random.between(0.5, 2.0)).collect();
        let weights = Some(weights).filter(|_| seed.is_multiple_of(3));
        let curve = FloatPolygon::new(degree, points, weights, seed.is_multiple_of(2));
        let curve = curve.expect("valid");
        let expected = counts(&Features::new(&curve));
        prop_assert_eq!(counts(&Features::new(&curve.reversed())), expected);
        let angle = random.between(0.0, TAU);
        let turn = if in_space {
            DMat3::from_axis_angle(random.vector(1.0, true).normalize(), angle)
        } else {
            DMat3::from_rotation_z(angle)
        };
        let shift = random.vector(30.0, in_space);
        let scale = random.between(0.01, 100.0);
        let moves = curve.vertices().iter().map(|vertex| turn * *vertex * scale + shift);
        let moves: Vec<_> = moves.enumerate().collect();
        let mut moved = curve.clone();
        moved.move_vertices(moves).expect("valid");
        prop_assert_eq!(counts(&Features::new(&moved)), expected);
    }

    #[test]
    fn subdividing_and_raising_a_segment_keep_the_counts(
        degree in 3..=8_usize,
        in_space in any::<bool>(),
        cut in 0.2..0.8_f64,
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let vertices: Vec<_> = (0..=degree).map(|_| random.vector(10.0, in_space)).collect();
        let expected = total(std::slice::from_ref(&vertices));
        let halves = [part(&vertices, 0.0, cut), part(&vertices, cut, 1.0 - cut)];
        prop_assert_eq!(total(&halves), expected);
        prop_assert_eq!(total(&[raised(&vertices)]), expected);
    }

    #[test]
    fn any_finite_polygon_is_taken(
        degree in 1..=25_usize,
        extra in 0..4_usize,
        periodic in any::<bool>(),
        spread in prop::sample::select(vec![0.0, 3.0, 30.0, 99.0]),
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let number = |random: &mut Random| match random.bits() % 8 {
            0 => 0.0,
            1 => 1.0,
            _ => random.between(-1.0, 1.0) * 10.0_f64.powf(random.between(-spread, spread)),
        };
        let in_space = seed.is_multiple_of(3);
        let count = degree + 1 + extra;
        let vertices = (0..count).map(|_| {
            let z = if in_space { number(&mut random) } else { 0.0 };
            DVec3::new(number(&mut random), number(&mut random), z)
        });
        let vertices = vertices.collect();
        let weights = (0..count).map(|_| 10.0_f64.powf(random.between(-spread, spread)));
        let weights = Some(weights.collect()).filter(|_| seed.is_multiple_of(2));
        let curve = FloatPolygon::new(degree, vertices, weights, periodic).expect("valid");
        let features = Features::new(&curve);
        let end = curve.segments() as f64;
        let mut intervals: Vec<[f64; 2]> = Vec::new();
        intervals.extend(features.inflections.iter().map(|root| root.u));
        intervals.extend(features.torsion_zeros.iter().map(|root| root.u));
        intervals.extend(features.curvature_extrema.iter().map(|extremum| extremum.u));
        intervals.extend(features.torsion_extrema.iter().map(|extremum| extremum.u));
        intervals.extend(features.cusps.iter().map(|cusp| cusp.u));
        intervals.extend(features.undecided.iter().map(|doubt| doubt.u));
        intervals.extend(features.trends.iter().map(|piece| piece.u));
        let last = if periodic { 2.0 * end } else { end };
        for [low, high] in intervals {
            prop_assert!(0.0 <= low && low <= high && low <= end && high <= last);
        }
        prop_assert!(features.trends.iter().all(|piece| piece.u[1] <= end));
        for pair in features.trends.windows(2) {
            prop_assert!(pair[0].u[1] <= pair[1].u[0]);
        }
    }
}
