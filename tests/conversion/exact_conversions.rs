//! Conversions between the three polygons against exact rational arithmetic.

use crate::common::Random;
use crate::exact_witness::{
    ALLOWED_ULPS, Exact, Kind, Knots, Vertices, assert_exact, bezier_chain, converted, exact,
    homogeneous, integer, kinds, ulp,
};
use batten::geometry::{
    Amplification, BezierPolygon, ClampedPolygon, ExactPolygon, FloatPolygon, PolygonError,
};
use glam::DVec3;
use num_traits::{Signed, ToPrimitive};

/// What there and back may lose while the digits are kept, in units of the size: the rounding of
/// the result, and less than a tenth of that.
const THERE_AND_BACK: f64 = 1e-15;

/// What Σ|entries| may lose in double arithmetic.
const NORM_ROUNDINGS: f64 = 1e-13;

#[test]
fn the_witness_is_right() {
    let vertices = [0.0, 0.0, 6.0, 0.0].map(|x| DVec3::new(x, 0.0, 0.0));
    let vertices = homogeneous(&vertices, None);
    let knots = Knots::float(3);
    for (at, expected) in [(0, 1), (1, 4)] {
        let point = knots.blossom(&vertices, 0, &[0; 3].map(|_| integer(at)));
        assert_eq!(point[0], integer(expected));
    }
    assert_eq!(converted(&vertices, knots, knots), vertices);
}

#[test]
fn float_to_clamped_and_bezier_is_exact_but_for_one_rounding() {
    let mut random = Random(1);
    for kind in kinds(1..=25) {
        if kind.degree > 15 && kind.count > kind.degree + 2 {
            continue;
        }
        let (points, weights) = (kind.points(&mut random), kind.weights(&mut random));
        let (degree, segments) = (kind.degree, kind.count - kind.degree);
        let given = homogeneous(&points, weights.as_deref());
        let float = FloatPolygon::new(degree, points, weights, false).expect("valid");
        let knots = Knots::float(degree);

        let clamped = ClampedPolygon::from_float(&float);
        let expected = converted(&given, knots, Knots::clamped(degree, segments));
        assert_exact(
            &format!("{kind:?}"),
            clamped.vertices(),
            clamped.weights(),
            &expected,
        );

        if segments > 1 && degree > 6 {
            continue;
        }
        let bezier = BezierPolygon::from_float(&float);
        let expected = bezier_chain(&given, knots);
        assert_exact(
            &format!("{kind:?}"),
            bezier.vertices(),
            bezier.weights(),
            &expected,
        );
    }
}

/// Coordinates that are nothing beside the curve's size have all their digits too.
#[test]
fn coordinates_far_smaller_than_the_curve_are_exact_too() {
    let mut random = Random(7);
    for degree in (2..=12_usize).chain([18, 25]) {
        for count in [degree + 1, degree + 3, 2 * degree] {
            if degree > 12 && count > degree + 1 {
                continue;
            }
            let (knots, float) = (Knots::clamped(degree, count - degree), Knots::float(degree));
            // Float vertices of 0, of 1 and of 1e50 by turns.
            let sizes = [0.0, 1.0, 1e50];
            let exact_float: Vertices = (0..count)
                .map(|index| {
                    let mut coordinate = |axis: usize| {
                        let size = sizes[(index + axis + random.bits() as usize) % 3];
                        exact(size)
                    };
                    [coordinate(0), coordinate(1), coordinate(2), integer(1)]
                })
                .collect();
            // The clamped polygon in doubles is that of a float polygon that is near this one.
            let clamped = converted(&exact_float, float, knots);
            let double = |number: &Exact| number.to_f64().expect("a number");
            let points = clamped
                .iter()
                .map(|v| DVec3::new(double(&v[0]), double(&v[1]), double(&v[2])));
            let points: Vec<DVec3> = points.collect();
            let expected = converted(&homogeneous(&points, None), knots, float);
            let clamped = ClampedPolygon::new(degree, points, None).expect("valid");
            let found = clamped.to_float().expect("polynomial");
            for (found, expected) in found.vertices().iter().zip(&expected) {
                for axis in 0..3 {
                    assert_rounded(found[axis], &expected[axis], degree);
                }
            }
            let points: Vec<DVec3> = exact_float
                .iter()
                .map(|v| DVec3::new(double(&v[0]), double(&v[1]), double(&v[2])))
                .collect();
            let expected = converted(&homogeneous(&points, None), float, knots);
            let given = FloatPolygon::new(degree, points, None, false).expect("valid");
            let found = ClampedPolygon::from_float(&given);
            for (found, expected) in found.vertices().iter().zip(&expected) {
                for axis in 0..3 {
                    assert_rounded(found[axis], &expected[axis], degree);
                }
            }
            if degree > 6 && count > degree + 3 {
                continue;
            }
            let expected = bezier_chain(&homogeneous(given.vertices(), None), float);
            let found = BezierPolygon::from_float(&given);
            for (found, expected) in found.vertices().iter().zip(&expected) {
                for axis in 0..3 {
                    assert_rounded(found[axis], &expected[axis], degree);
                }
            }
        }
    }
}

/// Assert that a number is the exact one rounded, in units of its own last place.
#[track_caller]
fn assert_rounded(found: f64, expected: &Exact, degree: usize) {
    let off = (exact(found) - expected).abs();
    let unit = exact(ulp(expected.to_f64().expect("a number").abs()));
    let allowed = unit * exact(ALLOWED_ULPS);
    assert!(
        off <= allowed,
        "degree {degree}: {found:e} for {expected:?}"
    );
}

#[test]
fn a_vertex_at_zero_is_zero_on_a_curve_of_size_1e50() {
    let mut random = Random(8);
    for degree in 3..=9_usize {
        let count = degree + 3;
        let knots = (Knots::clamped(degree, 3), Knots::float(degree));
        let column = |index: usize| -> Vec<Exact> {
            let mut points = vec![DVec3::ZERO; count];
            points[index].x = 1.0;
            let column = converted(&homogeneous(&points, None), knots.0, knots.1);
            column.into_iter().map(|[x, ..]| x).collect()
        };
        let columns: Vec<Vec<Exact>> = (0..count).map(column).collect();
        let row = |vertex: usize| columns.iter().map(|column| &column[vertex]).collect();
        let rows: Vec<Vec<&Exact>> = (0..count).map(row).collect();
        for (vertex, row) in rows.iter().enumerate() {
            // Pairs of vertices of size 1e50 that cancel in this one.
            let mut points = vec![DVec3::new(0.0, 1.0, 0.0); count];
            for pair in 0..count / 2 {
                let (one, other) = (2 * pair, 2 * pair + 1);
                let size = integer(random.between(3.0, 99.0) as i64)
                    * Exact::from_integer(num_bigint::BigInt::from(1) << 150);
                let [a, b] = [row[one], row[other]];
                let size = size * a.denom() * b.denom();
                points[one].x = (b * &size).to_f64().expect("a number");
                points[other].x = -(a * &size).to_f64().expect("a number");
                if exact(points[one].x) * a != -exact(points[other].x) * b {
                    (points[one].x, points[other].x) = (0.0, 0.0);
                }
            }
            let clamped = ClampedPolygon::new(degree, points, None).expect("valid");
            let float = clamped.to_float().expect("polynomial");
            assert_eq!(float.vertices()[vertex].x, 0.0, "degree {degree}, {vertex}");
        }
    }
}

#[test]
fn bezier_to_float_and_clamped_is_exact_but_for_one_rounding() {
    let mut random = Random(3);
    for kind in kinds(1..=25) {
        if kind.count > kind.degree + 2 && kind.degree > 6 {
            continue;
        }
        // One segment may have any vertices; several must join, as far as doubles allow.
        let (degree, segments) = (kind.degree, kind.count - kind.degree);
        let one = Knots::clamped(degree, 1);
        let bezier = if segments == 1 {
            let weights = kind.linear_weights(one);
            BezierPolygon::new(degree, kind.points(&mut random), weights).expect("valid")
        } else {
            let weights = kind.linear_weights(Knots::float(degree));
            let points = kind.points(&mut random);
            let float = FloatPolygon::new(degree, points, weights, false).expect("valid");
            BezierPolygon::from_float(&float)
        };
        let chain = homogeneous(bezier.vertices(), bezier.weights());
        // Each vertex from the polynomial of the segment in the middle of its knots.
        let vertex = |index: usize| {
            let segment = index.saturating_sub(degree / 2).min(segments - 1);
            let knots = Knots::float(degree).of_vertex(index).into_iter();
            let local: Vec<Exact> = knots.map(|k| k - integer(segment as i64)).collect();
            one.blossom(&chain[segment * degree..], 0, &local)
        };
        let expected: Vertices = (0..kind.count).map(vertex).collect();
        let what = format!("{kind:?}");
        match ExactPolygon::from_bezier(&bezier).to_float() {
            Ok(float) => assert_exact(&what, float.vertices(), float.weights(), &expected),
            Err(error) => assert_refusal_is_right(&what, &error, &expected),
        }
        // Several segments, and one whose float polygon is too large, are met as nearly as can be.
        let direct = bezier.to_float();
        if segments == 1 && degree <= 9 && kind.scale < 1e90 {
            assert_eq!(direct, ExactPolygon::from_bezier(&bezier).to_float());
        } else if let Err(error) = direct {
            assert!(degree > 9 || kind.scale > 1e90, "{kind:?}: {error}");
        }
    }
}

/// Assert that a conversion was refused for the first vertex that has no positive weight, or for
/// one too large to hold.
#[track_caller]
fn assert_refusal_is_right(what: &str, error: &PolygonError, expected: &Vertices) {
    match error {
        PolygonError::WeightLost { index, .. } => {
            let first = expected.iter().position(|v| !v[3].is_positive());
            assert_eq!(first, Some(*index), "{what}");
        }
        PolygonError::Overflow { index, .. } => {
            let vertex = &expected[*index];
            let limit = exact(1e100);
            let beyond = vertex[..3]
                .iter()
                .any(|axis| (axis / &vertex[3]).abs() > limit);
            assert!(beyond || vertex[3] > limit, "{what}");
        }
        other => panic!("{what}: {other}"),
    }
}

#[test]
fn weights_are_refused_exactly_where_the_exact_ones_are_not_positive() {
    let mut random = Random(4);
    let (mut refused, mut accepted) = (0, 0);
    for round in 0..400 {
        let degree = 2 + round % 8;
        let (count, spread) = (degree + 1 + round % 5, 0.6 / f64::from(1 << (round % 24)));
        let segments = count - degree;
        let points = (0..count).map(|_| random.vector(10.0, true)).collect();
        let weights: Vec<f64> = (0..count)
            .map(|_| 1.0 + random.between(-spread, spread))
            .collect();
        let clamped = ClampedPolygon::new(degree, points, Some(weights)).expect("valid");
        let given = homogeneous(clamped.vertices(), clamped.weights());
        let knots = Knots::clamped(degree, segments);
        let expected = converted(&given, knots, Knots::float(degree));
        match clamped.to_float() {
            Ok(float) => {
                accepted += 1;
                assert!(expected.iter().all(|v| v[3].is_positive()));
                assert_exact("accepted", float.vertices(), float.weights(), &expected);
            }
            Err(error) => {
                refused += 1;
                assert_refusal_is_right("refused", &error, &expected);
            }
        }
    }
    assert!(
        refused > 50 && accepted > 50,
        "{refused} refused, {accepted} accepted"
    );
}

#[test]
fn a_weight_of_exactly_zero_is_refused() {
    for degree in 2..=25_usize {
        // The weight u + degree(degree − 1)/2/degree vanishes at the first float vertex; times
        // the degree it is an integer everywhere.
        let knots = Knots::clamped(degree, 1);
        let shift = (degree * (degree - 1) / 2) as i64;
        let weight = |index: usize| {
            let sum: i64 = (index + 1..=index + degree).map(|k| knots.at(k)).sum();
            (sum + shift) as f64
        };
        let weights: Vec<f64> = (0..=degree).map(weight).collect();
        let points: Vec<DVec3> = (0..=degree).map(|i| DVec3::splat(i as f64)).collect();
        let clamped = ClampedPolygon::new(degree, points.clone(), Some(weights.clone()));
        let bezier = BezierPolygon::new(degree, points, Some(weights)).expect("valid");
        let mut floats = vec![
            clamped.expect("valid").to_float(),
            ExactPolygon::from_bezier(&bezier).to_float(),
        ];
        if degree <= 10 {
            // From there on the rounding of the given weights alone can make them 0.
            floats.push(bezier.to_float());
        }
        for float in floats {
            let error = float.expect_err("a weight of 0");
            let message = error.to_string();
            assert!(
                matches!(error, PolygonError::WeightLost { index: 0, .. }),
                "{message}"
            );
            assert!(message.contains("at vertex 0"), "{message}");
        }
    }
}

#[test]
fn there_and_back_loses_nothing_while_the_digits_are_kept() {
    let mut random = Random(5);
    for kind in kinds(1..=25) {
        let (points, weights) = (kind.points(&mut random), kind.weights(&mut random));
        let float = FloatPolygon::new(kind.degree, points, weights, false).expect("valid");
        let exact = ExactPolygon::from_float(&float).bezier_form();
        assert_eq!(exact.degree(), kind.degree);
        assert_eq!(exact.segments(), float.segments());
        let back = exact.to_float().expect("the same polygon");
        for (found, expected) in back.vertices().iter().zip(float.vertices()) {
            let error = (*found - *expected).abs().max_element();
            assert!(error <= THERE_AND_BACK * kind.scale, "{kind:?}: {error:e}");
        }
    }
}

#[test]
fn there_and_back_through_doubles_costs_the_amplification_times_a_digit() {
    let mut random = Random(6);
    for kind in kinds(2..=15) {
        let kind = Kind {
            rational: false,
            ..kind
        };
        let points = kind.points(&mut random);
        let float = FloatPolygon::new(kind.degree, points, None, false).expect("valid");
        let clamped = ClampedPolygon::from_float(&float);
        let back = clamped.to_float().expect("polynomial");
        let digit = ulp(crate::common::reach(clamped.vertices()));
        let allowed = clamped.amplification().norm * digit;
        for (found, expected) in back.vertices().iter().zip(float.vertices()) {
            let error = (*found - *expected).abs().max_element();
            assert!(error <= allowed, "{kind:?}: {error:e} > {allowed:e}");
        }
    }
}

#[test]
fn the_amplification_is_that_of_the_exact_matrix() {
    for degree in 1..=12 {
        for segments in [1, 2, 3, degree, degree + 3] {
            let count = segments + degree;
            let (clamped, float) = (Knots::clamped(degree, segments), Knots::float(degree));
            let mut rows = vec![integer(0); count];
            let mut largest = integer(0);
            for column in 0..count {
                let mut points = vec![DVec3::ZERO; count];
                points[column].x = 1.0;
                let columns = converted(&homogeneous(&points, None), clamped, float);
                for (row, vertex) in rows.iter_mut().zip(columns) {
                    *row += vertex[0].abs();
                    largest = largest.max(vertex[0].abs());
                }
            }
            let norm = rows.into_iter().max().expect("rows");
            let found = Amplification::of_unclamping(degree, segments);
            for (found, expected) in [(found.norm, norm), (found.largest, largest)] {
                let expected = expected.to_f64().expect("a number");
                assert!(
                    (found / expected - 1.0).abs() <= NORM_ROUNDINGS,
                    "degree {degree}, L {segments}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn the_deviation_is_a_bound_though_the_vertices_are_far_apart() {
    // At degree 25 the nearest float polygon has other vertices and the same curve, nearly.
    let (degree, segments) = (25, 2);
    let points = (0..degree + segments).map(|i| {
        let angle = 0.3 * i as f64;
        1000.0 * DVec3::new(angle.cos(), angle.sin(), 0.0)
    });
    let float = FloatPolygon::new(degree, points.collect(), None, false).expect("valid");
    let clamped = ClampedPolygon::from_float(&float);
    let back = clamped.nearest_float().expect("close").polygon;
    let bound = float.deviation(&back).expect("the same knots");
    let (from, to) = (Knots::float(degree), Knots::clamped(degree, segments));
    let ends = [&float, &back].map(|polygon| {
        let vertices = homogeneous(polygon.vertices(), None);
        converted(&vertices, from, to).swap_remove(0)
    });
    let squared = (0..2).map(|axis| {
        let difference = &ends[0][axis] - &ends[1][axis];
        &difference * &difference
    });
    let squared = squared.fold(integer(0), |sum, part| sum + part);
    assert!(squared <= exact(bound) * exact(bound), "{bound:e}");
}

#[test]
fn an_axis_keeps_its_digits_though_another_is_fitted() {
    let mut random = Random(79);
    let mut fitted = 0;
    for round in 0..200 {
        let (degree, segments) = (8 + round % 4, 1 + round % 5);
        let mut point = || {
            let size = 10_f64.powf(random.between(0.0, 50.0));
            DVec3::new(
                size * random.between(-9.0, 9.0),
                random.between(-9.0, 9.0),
                0.0,
            )
        };
        let points: Vec<DVec3> = (0..degree + segments).map(|_| point()).collect();
        let clamped = ClampedPolygon::new(degree, points, None).expect("valid");
        let exact = clamped.to_float().expect("polynomial");
        let Ok(nearest) = clamped.nearest_float() else {
            continue;
        };
        let axis = |polygon: &FloatPolygon, axis: usize| -> Vec<f64> {
            polygon
                .vertices()
                .iter()
                .map(|vertex| vertex[axis])
                .collect()
        };
        fitted += usize::from(axis(&nearest.polygon, 0) != axis(&exact, 0));
        assert_eq!(
            axis(&nearest.polygon, 1),
            axis(&exact, 1),
            "degree {degree}"
        );
    }
    assert!(fitted > 5, "{fitted} of 200 were fitted");
}
