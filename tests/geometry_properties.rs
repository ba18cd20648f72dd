//! What holds for every curve: invariances, agreement of the ways to evaluate, lengths, nearest
//! points.

mod common;

use batten::geometry::{Batch, ClampedPolygon, End, FloatPolygon, Jet, Sampler, segment_bezier};
use common::{Kind, Random, kinds, reach};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

/// A few roundings of the largest coordinate.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

fn vectors(jet: &Jet) -> [DVec3; 4] {
    [jet.point, jet.first, jet.second, jet.third]
}

/// What rounding may do to the r-th derivative: differences double it, quotients add to it.
fn derivative_tolerance(polygon: &FloatPolygon, order: usize) -> f64 {
    let doubled = 2.0_f64.powi(order as i32);
    let quotient = if polygon.is_rational() {
        16.0_f64.powi(1 + order as i32)
    } else {
        1.0
    };
    ROUNDINGS * doubled * quotient * reach(polygon.vertices())
}

proptest! {
    #![proptest_config(common::repeatable())]

    #[test]
    fn mapping_the_vertices_maps_the_curve(kind in kinds(1..=25), at in 0.0..1.0) {
        let polygon = kind.polygon();
        let mut random = Random(kind.seed ^ 1);
        let columns = [0; 3].map(|_| random.vector(1.0, true));
        let (matrix, shift) =
            (DMat3::from_cols(columns[0], columns[1], columns[2]), random.vector(10.0, true));
        let map = |point: DVec3| matrix * point + shift;
        let mapped = polygon.vertices().iter().map(|vertex| map(*vertex)).collect();
        let weights = polygon.weights().map(<[f64]>::to_vec);
        let mapped = FloatPolygon::new(kind.degree, mapped, weights, kind.periodic).expect("valid");
        let u = at * polygon.segments() as f64;
        let scale = reach(polygon.vertices()) + reach(mapped.vertices());
        prop_assert!(mapped.point(u).distance(map(polygon.point(u))) <= ROUNDINGS * scale);
    }

    #[test]
    fn reversing_runs_the_same_curve_backwards(kind in kinds(1..=25), at in 0.0..1.0) {
        let polygon = kind.polygon();
        let reversed = polygon.reversed();
        let last = polygon.segments() as f64;
        let u = at * last;
        let scale = reach(polygon.vertices());
        // Subtracting u from L rounds it, which moves the point along the curve.
        let moved = f64::EPSILON * last * polygon.jet(u).speed();
        let error = reversed.point(last - u).distance(polygon.point(u));
        prop_assert!(error <= ROUNDINGS * scale + moved, "{error:e}");
        prop_assert_eq!(reversed.reversed(), polygon);
    }

    #[test]
    fn equal_vertices_are_the_curve(kind in kinds(1..=25), at in 0.0..=1.0) {
        let place = Random(kind.seed).vector(10.0, kind.in_space);
        let vertices = vec![place; kind.degree + 1 + kind.extra];
        let weights = kind.polygon().weights().map(<[f64]>::to_vec);
        let polygon =
            FloatPolygon::new(kind.degree, vertices, weights, kind.periodic).expect("valid");
        let mut batch = Batch::default();
        Sampler::new(kind.degree, &[at]).segment(&polygon, 0, 3, &mut batch);
        for jet in [batch.jet(0), polygon.segment_jet(0, at)] {
            prop_assert!(jet.point.distance(place) <= ROUNDINGS * 10.0);
            prop_assert_eq!([jet.first, jet.second, jet.third], [DVec3::ZERO; 3]);
        }
    }

    #[test]
    fn batches_agree_with_single_parameters(
        kind in kinds(1..=25),
        parameters in proptest::collection::vec(0.0..=1.0, 1..40),
        order in 0..=3_usize,
    ) {
        let polygon = kind.polygon();
        let sampler = Sampler::new(kind.degree, &parameters);
        prop_assert_eq!(sampler.len(), parameters.len());
        let mut batch = Batch::default();
        // What another curve left behind must not be seen.
        let other = Kind { rational: true, in_space: true, ..kind }.polygon();
        sampler.segment(&other, 0, 3, &mut batch);
        for segment in 0..polygon.segments() {
            sampler.segment(&polygon, segment, order, &mut batch);
            prop_assert_eq!(batch.len(), parameters.len());
            for (index, t) in parameters.iter().enumerate() {
                let expected = polygon.segment_jet(segment, *t);
                let found = vectors(&batch.jet(index));
                for (r, expected) in vectors(&expected).into_iter().enumerate() {
                    if r > order {
                        prop_assert_eq!(found[r], DVec3::ZERO);
                        continue;
                    }
                    let error = found[r].distance(expected);
                    let allowed = derivative_tolerance(&polygon, r);
                    prop_assert!(error <= allowed, "{r}: {error:e} > {allowed:e}");
                    let stored = [0, 1, 2].map(|axis| batch.coordinate(r, axis)[index]);
                    prop_assert_eq!(DVec3::from_array(stored), found[r]);
                }
            }
        }
    }

    #[test]
    fn unrolling_a_periodic_curve_keeps_it(kind in kinds(1..=25), at in 0.0..1.0) {
        let polygon = Kind { periodic: true, ..kind }.polygon();
        let open = polygon.unrolled();
        prop_assert!(!open.is_periodic());
        prop_assert_eq!(open.segments(), polygon.segments());
        let segments = polygon.segments() as f64;
        let u = at * segments;
        prop_assert_eq!(open.jet(u), polygon.jet(u));
        let scale = reach(polygon.vertices());
        let once_more = polygon.point(u + segments).distance(polygon.point(u));
        let moved = 4.0 * f64::EPSILON * segments * polygon.jet(u).speed();
        prop_assert!(once_more <= ROUNDINGS * scale + moved);
        let joint = open.point(0.0).distance(open.point(segments));
        prop_assert!(joint <= ROUNDINGS * scale);
    }

    #[test]
    fn bezier_polygons_begin_and_end_on_the_curve(kind in kinds(1..=25)) {
        let polygon = kind.polygon();
        let degree = kind.degree;
        for segment in 0..polygon.segments() {
            let bezier = segment_bezier(&polygon, segment);
            let point = |index: usize| bezier[index].truncate() / bezier[index].w;
            let allowed = 4.0 * derivative_tolerance(&polygon, 0);
            for (t, end, inner) in [(0.0, 0, 1), (1.0, degree, degree - 1)] {
                let jet = polygon.segment_jet(segment, t);
                prop_assert!(point(end).distance(jet.point) <= allowed);
                let slope = degree as f64 * bezier[inner].w / bezier[end].w;
                let leg = (point(inner) - point(end)) * if t == 0.0 { slope } else { -slope };
                prop_assert!(leg.distance(jet.first) <= allowed * 8.0 * degree as f64);
            }
        }
    }

    #[test]
    fn clamped_polygons_begin_and_end_on_the_curve(kind in kinds(1..=25)) {
        let polygon = kind.polygon();
        let clamped = ClampedPolygon::from_float(&polygon);
        let vertices = clamped.vertices();
        let allowed = 4.0 * derivative_tolerance(&polygon, 0);
        let open = polygon.unrolled();
        prop_assert!(vertices[0].distance(open.end_jet(End::Start).point) <= allowed);
        let last = vertices[vertices.len() - 1];
        prop_assert!(last.distance(open.end_jet(End::Finish).point) <= allowed);
        prop_assert_eq!(clamped.knots().len(), vertices.len() + kind.degree + 1);
        prop_assert_eq!(clamped.segments(), polygon.segments());
    }

    #[test]
    fn lengths_add_up(kind in kinds(1..=9), cut in 0.0..1.0) {
        let polygon = kind.polygon();
        let tolerance = 1e-10;
        let whole: f64 = polygon.arc_length(tolerance);
        let parts: f64 = (0..polygon.segments())
            .map(|segment| {
                polygon.segment_arc_length(segment, 0.0, cut, tolerance)
                    + polygon.segment_arc_length(segment, cut, 1.0, tolerance)
            })
            .sum();
        prop_assert!((whole - parts).abs() <= 8.0 * tolerance * whole, "{whole} {parts}");
    }

    #[test]
    fn no_sample_is_nearer_than_the_nearest_point(kind in kinds(1..=9), seed in any::<u64>()) {
        let polygon = kind.polygon();
        let target = Random(seed).vector(12.0, kind.in_space);
        let nearest = polygon.nearest(target);
        let scale = reach(polygon.vertices());
        let segments = polygon.segments() as f64;
        prop_assert!((0.0..=segments).contains(&nearest.u));
        prop_assert!(nearest.point.distance(polygon.point(nearest.u)) <= 64.0 * ROUNDINGS * scale);
        prop_assert_eq!(nearest.distance, nearest.point.distance(target));
        for step in 0..=200 * polygon.segments() {
            let sample = polygon.point(step as f64 / 200.0).distance(target);
            prop_assert!(nearest.distance <= sample + ROUNDINGS * scale);
        }
    }
}

#[test]
fn a_straight_line_is_as_long_as_its_segments() {
    for degree in 1..=25 {
        let vertices = (0..degree + 4).map(|i| DVec3::new(3.0, 4.0, 12.0) * i as f64);
        let line = FloatPolygon::new(degree, vertices.collect(), None, false).expect("valid");
        let length = line.arc_length(1e-14);
        assert!(
            (length - 52.0).abs() <= ROUNDINGS * 52.0,
            "degree {degree}: {length}"
        );
    }
}

#[test]
fn a_parabola_has_the_length_of_its_closed_form() {
    // (u, u²): the float vertices of a quadratic are the blossom at two consecutive knots.
    let vertices = (-1..=3).map(|i| (f64::from(i) + 0.5, f64::from(i * (i + 1))));
    let parabola = FloatPolygon::planar(2, &vertices.collect::<Vec<_>>()).expect("valid");
    let antiderivative = |u: f64| 0.5 * u * (1.0 + 4.0 * u * u).sqrt() + 0.25 * (2.0 * u).asinh();
    let expected = antiderivative(3.0);
    let found = parabola.arc_length(1e-14);
    assert!(
        (found - expected).abs() <= ROUNDINGS * expected,
        "{found} {expected}"
    );
    for (u, curvature) in [(0.0, 2.0), (1.0, 2.0 / 5.0_f64.powf(1.5))] {
        let found = parabola.jet(u).signed_curvature();
        assert!((found - curvature).abs() <= ROUNDINGS * curvature);
    }
}

#[test]
fn a_cusp_has_the_length_of_its_closed_form() {
    // (u², u³) about u = 1: its speed has a kink there, and no curvature.
    let vertices = (-2..=2).map(|i| {
        let [a, b, c] = [i, i + 1, i + 2].map(|knot| f64::from(knot) - 1.0);
        ((a * b + a * c + b * c) / 3.0, a * b * c)
    });
    let cusp = FloatPolygon::planar(3, &vertices.collect::<Vec<_>>()).expect("valid");
    let half = (13.0_f64.powf(1.5) - 8.0) / 27.0;
    let length = cusp.arc_length(1e-12);
    assert!(
        (length - 2.0 * half).abs() <= 1e-11,
        "{length} {}",
        2.0 * half
    );
    assert_eq!(cusp.jet(1.0).tangent(), None);
    assert_eq!(cusp.jet(1.0).centre_of_curvature(), None);
}

#[test]
fn curvature_scales_inversely_over_the_whole_range_of_numbers() {
    let polygon = Kind {
        degree: 5,
        extra: 3,
        periodic: false,
        rational: false,
        in_space: true,
        seed: 7,
    };
    let polygon = polygon.polygon();
    let jet = polygon.jet(1.3);
    for power in [-900, -600, -300, 0, 150, 300] {
        let factor = 2.0_f64.powi(power);
        let scaled = polygon.vertices().iter().map(|vertex| *vertex * factor);
        let scaled = FloatPolygon::new(5, scaled.collect(), None, false).expect("valid");
        let found = scaled.jet(1.3);
        let ratio = |found: f64, expected: f64| (found / expected - 1.0).abs();
        assert!(
            ratio(found.curvature() * factor, jet.curvature()) <= 1e-14,
            "{power}"
        );
        assert!(
            ratio(found.torsion() * factor, jet.torsion()) <= 1e-14,
            "{power}"
        );
        assert!(
            ratio(found.speed() / factor, jet.speed()) <= 1e-14,
            "{power}"
        );
        assert!(
            ratio(scaled.size() / factor, polygon.size()) <= 1e-14,
            "{power}"
        );
        assert!(ratio(scaled.arc_length(1e-9) / factor, polygon.arc_length(1e-9)) <= 1e-13);
        let centre = found.centre_of_curvature().map(|centre| centre / factor);
        let expected = jet.centre_of_curvature().expect("a centre");
        let error = centre.expect("a centre").distance(expected) / expected.length();
        assert!(error <= 1e-14, "{power}: {error:e}");
    }
}
