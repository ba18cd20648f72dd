//! What operations do with locked vertices.

use batten::document::{Curve, Edit};
use batten::operations::{ALL, Operation, Value};

use crate::runner::Runner;

fn runner(example: &str, vertices: &[usize]) -> Runner {
    let runner = Runner::example(example);
    let curve = runner.id();
    runner.edited(Edit::SetVerticesLocked {
        curve,
        vertices: vertices.to_vec(),
        locked: true,
    })
}

fn locks(curve: &Curve) -> Vec<usize> {
    curve.locked_vertices.iter().collect()
}

#[test]
fn parts_keep_the_locks_of_vertices_that_they_have() {
    let runner = runner("hull", &[1, 4, 7]);
    let before = runner.polygon();
    let degree = before.degree();
    let (outcome, curves) = runner.done("split", &[("at", Value::Real(3.0))]);
    let (first, second) = (&curves[0], &curves[1]);
    assert_eq!(first.polygon.vertices().len(), degree + 3);
    let expected = |from: usize, to: usize| -> Vec<usize> {
        let kept = [1, 4, 7]
            .into_iter()
            .filter(|vertex| (from..to).contains(vertex));
        kept.map(|vertex| vertex - from).collect()
    };
    assert_eq!(locks(first), expected(0, degree + 3));
    assert_eq!(locks(second), expected(3, before.vertices().len()));
    assert_eq!(outcome.remarks, Vec::<String>::new());

    let (outcome, curves) = runner.done("trim", &[("from", Value::Real(2.0))]);
    assert_eq!(locks(&curves[0]), expected(2, before.vertices().len()));
    assert_eq!(
        outcome.remarks,
        ["1 lock is removed: its vertex is no longer there"]
    );
}

#[test]
fn other_vertices_are_not_locked_and_the_report_says_so() {
    let lost = "3 locks are removed: their vertices are no longer there";
    for (name, values) in [
        ("trim", vec![("from", Value::Real(0.5))]),
        ("split", vec![("at", Value::Real(2.5))]),
        ("elevate-degree", vec![]),
        ("reduce-degree", vec![]),
    ] {
        let (outcome, curves) = runner("hull", &[1, 4, 7]).done(name, &values);
        for curve in &curves {
            assert!(locks(curve).is_empty(), "{name}");
        }
        assert!(
            outcome.remarks.iter().any(|remark| remark == lost),
            "{name}: {:?}",
            outcome.remarks
        );
    }
    let (outcome, curves) = runner("hull", &[1, 4, 7]).done("reinterpret-degree", &[]);
    assert_eq!(locks(&curves[0]), [1, 4, 7]);
    let stays =
        "The polygon stays, the curve changes; Elevate degree with a tolerance keeps the curve";
    assert_eq!(outcome.remarks, [stays]);
}

#[test]
fn rounding_leaves_locked_vertices_as_they_are() {
    let runner = runner("s-curve", &[0, 2]);
    let before = runner.polygon();
    let digits = [("digits", Value::Whole(0))];
    let (outcome, curves) = runner.done("round", &digits);
    for (index, (a, b)) in before
        .vertices()
        .iter()
        .zip(curves[0].polygon.vertices())
        .enumerate()
    {
        let rounded = b.to_array().iter().all(|number| number.fract() == 0.0);
        assert!(
            if [0, 2].contains(&index) {
                a == b
            } else {
                rounded
            },
            "vertex {index}"
        );
    }
    assert_eq!(outcome.remarks, ["2 locked vertices keep the coordinates"]);
    let closed = [("digits", Value::Whole(0)), ("polygon", Value::Choice(1))];
    let refused = runner.refused("round", &closed);
    assert!(
        refused.contains("vertex 0 of “s-curve” is locked"),
        "{refused}"
    );
}

#[test]
fn no_operation_moves_a_locked_vertex() {
    for example in ["hull", "s-curve", "periodic"] {
        let runner = runner(example, &[1, 3]);
        let before = runner.polygon();
        let held = [1, 3].map(|vertex| before.vertex(vertex));
        // Subdividing gives locks to other vertices, and images and copies take them along.
        let others = |it: &&&Operation| !["subdivide", "mirror", "array"].contains(&it.name);
        for operation in ALL.iter().filter(others) {
            let Ok(outcome) = runner.run(operation.name, &[]) else {
                continue;
            };
            let input = runner.input_of(operation);
            let after = outcome.applied_to(input.document());
            let after = after.expect("edits that can be made");
            for (_, curve) in after.curves() {
                for vertex in locks(curve) {
                    let place = curve.polygon.vertex(vertex);
                    assert!(held.contains(&place), "{} of {example}", operation.name);
                }
            }
        }
    }
}

#[test]
fn subdividing_locks_the_vertices_at_the_same_places_along_the_curve() {
    for example in ["hull", "s-curve", "periodic"] {
        let locked = [0, 1, 4];
        let runner = runner(example, &locked);
        let before = runner.polygon();
        let (_, curves) = runner.done("subdivide", &[]);
        let after = &curves[0].polygon;
        let length = after.segments() as f64;
        for vertex in locked {
            let wanted = 2.0 * before.greville(vertex);
            // Beyond the ends of an open curve there are fewer vertices than before.
            let first = after.greville(0);
            let wanted = if before.is_periodic() {
                wanted
            } else {
                wanted.max(first)
            };
            let apart = |other: usize| {
                let apart = (after.greville(other) - wanted).abs();
                if before.is_periodic() {
                    apart.min((length - apart).abs())
                } else {
                    apart
                }
            };
            let near = locks(&curves[0])
                .into_iter()
                .map(apart)
                .fold(f64::INFINITY, f64::min);
            assert!(near <= 0.5, "{example} {vertex}: {near}");
        }
    }
}
