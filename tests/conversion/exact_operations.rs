//! Subdivision, extension and raising against exact rational arithmetic.

use crate::common::Random;
use crate::exact_witness::{
    Exact, Kind, Knots, Vertices, assert_exact, homogeneous, integer, kinds,
};
use batten::geometry::{End, FloatPolygon};
use num_traits::Zero;

#[test]
fn subdivision_is_exact_but_for_one_rounding() {
    let mut random = Random(7);
    for kind in kinds(1..=15) {
        let (points, weights) = (kind.points(&mut random), kind.weights(&mut random));
        let (degree, segments) = (kind.degree, kind.count - kind.degree);
        let given = homogeneous(&points, weights.as_deref());
        let float = FloatPolygon::new(degree, points, weights, false).expect("valid");
        let fine = float.subdivided().expect("valid");
        assert_eq!(fine.segments(), 2 * segments);
        let knots = Knots::float(degree);
        let vertex = |index: usize| {
            let halves = knots.of_vertex(index).into_iter();
            let halves: Vec<Exact> = halves.map(|knot| knot / integer(2)).collect();
            knots.blossom(&given, (index / 2).min(segments - 1), &halves)
        };
        let expected: Vertices = (0..fine.vertices().len()).map(vertex).collect();
        assert_exact(
            &format!("{kind:?}"),
            fine.vertices(),
            fine.weights(),
            &expected,
        );
    }
}

#[test]
fn extension_is_exact_but_for_one_rounding() {
    let mut random = Random(8);
    for kind in kinds(1..=15) {
        let kind = Kind {
            scale: kind.scale.min(1e60),
            ..kind
        };
        let degree = kind.degree;
        let knots = Knots::float(degree);
        // Linear weights stay positive as long as that line does.
        let (points, weights) = (kind.points(&mut random), kind.linear_weights(knots));
        let float = FloatPolygon::new(degree, points, weights, false).expect("valid");
        for (end, added) in [(End::Finish, 1), (End::Finish, 4), (End::Start, 1)] {
            let longer = float.extended(end, added).expect("positive weights");
            let given = match end {
                End::Finish => float.clone(),
                End::Start => float.reversed(),
            };
            let found = match end {
                End::Finish => longer,
                End::Start => longer.reversed(),
            };
            let vertices = homogeneous(given.vertices(), given.weights());
            let last = given.segments() - 1;
            let new = (kind.count..kind.count + added)
                .map(|index| knots.blossom(&vertices, last, &knots.of_vertex(index)));
            let expected: Vertices = vertices.iter().cloned().chain(new).collect();
            assert_exact(
                &format!("{kind:?}"),
                found.vertices(),
                found.weights(),
                &expected,
            );
            assert_eq!(found.vertices()[..kind.count], *given.vertices());
        }
    }
}

#[test]
fn raising_one_segment_is_exact_but_for_one_rounding() {
    let mut random = Random(9);
    for kind in kinds(1..=15) {
        if kind.count > kind.degree + 1 {
            continue;
        }
        let degree = kind.degree;
        let knots = Knots::float(degree);
        let (points, weights) = (kind.points(&mut random), kind.linear_weights(knots));
        let given = homogeneous(&points, weights.as_deref());
        let float = FloatPolygon::new(degree, points, weights, false).expect("valid");
        let raised = float.with_degree(degree + 1).expect("positive weights");
        assert!(raised.exact);
        assert_eq!(raised.deviation, 0.0);
        // The blossom of the raised curve is the mean of the blossoms with one argument left out.
        let vertex = |index: usize| {
            let arguments = Knots::float(degree + 1).of_vertex(index);
            let mut sum: [Exact; 4] = std::array::from_fn(|_| Exact::zero());
            for left_out in 0..=degree {
                let mut others = arguments.clone();
                others.remove(left_out);
                let value = knots.blossom(&given, 0, &others);
                for (sum, value) in sum.iter_mut().zip(value) {
                    *sum += value / integer(degree as i64 + 1);
                }
            }
            sum
        };
        let expected: Vertices = (0..=degree + 1).map(vertex).collect();
        let polygon = raised.polygon;
        assert_exact(
            &format!("{kind:?}"),
            polygon.vertices(),
            polygon.weights(),
            &expected,
        );
    }
}
