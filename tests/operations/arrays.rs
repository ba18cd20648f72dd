//! Copies of curves in rows and rings.

use batten::document::Curve;
use batten::geometry::End;
use batten::geometry::end_correction::EndTarget;
use batten::operations::{Deviation, Value};
use glam::DVec3;

use crate::common::Random;
use crate::runner::{ROUNDING, Runner};

fn curve(seed: u64, in_space: bool) -> Curve {
    let mut curve = Curve::new("leaf", Random(seed).gentle(4, 9, in_space, false));
    curve.locked_vertices = [2].into_iter().collect();
    curve
}

fn list(numbers: &[f64]) -> Value {
    Value::List(numbers.to_vec())
}

#[test]
fn a_row_shifts_each_copy_by_the_step() {
    for in_space in [false, true] {
        let curve = curve(3, in_space);
        let runner = Runner::curves(vec![curve.clone()]);
        let step = if in_space {
            vec![1.5, -2.0, 0.5]
        } else {
            vec![1.5, -2.0]
        };
        let by = DVec3::new(1.5, -2.0, step.get(2).copied().unwrap_or(0.0));
        let given = [("count", Value::Whole(4)), ("step", list(&step))];
        let (outcome, curves) = runner.done("array", &given);
        assert_eq!(outcome.deviation, Deviation::Exact);
        let names: Vec<&str> = curves.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["leaf", "leaf 2", "leaf 3", "leaf 4"]);
        for (number, copy) in curves.iter().enumerate() {
            assert_eq!(copy.locked_vertices, curve.locked_vertices);
            let pairs = curve.polygon.vertices().iter().zip(copy.polygon.vertices());
            for (before, after) in pairs {
                assert_eq!(*before + number as f64 * by, *after);
            }
        }
    }
}

#[test]
fn a_ring_comes_round_and_quarters_are_exact() {
    let mut curve = curve(4, true);
    let jet = curve.polygon.end_jet(End::Start);
    curve
        .targets
        .set(End::Start, Some(EndTarget::keeping(&jet)));
    let runner = Runner::curves(vec![curve.clone()]);
    let about = DVec3::new(2.0, 1.0, 0.0);
    for count in [4, 5] {
        let angle = std::f64::consts::TAU / count as f64;
        let given = [
            ("count", Value::Whole(count)),
            ("angle", Value::Real(angle)),
            ("about", list(&[2.0, 1.0])),
        ];
        let (_, curves) = runner.done("array", &given);
        let size = curve.polygon.size();
        // The first one is the next of the last.
        for number in 0..count {
            let [one, next] = [number, (number + 1) % count].map(|it| &curves[it]);
            let pairs = one.polygon.vertices().iter().zip(next.polygon.vertices());
            for (before, after) in pairs {
                let [from, to] = [*before - about, *after - about];
                let (sin, cos) = angle.sin_cos();
                let turned = DVec3::new(
                    cos * from.x - sin * from.y,
                    sin * from.x + cos * from.y,
                    from.z,
                );
                assert!(
                    turned.distance(to) <= 10.0 * ROUNDING * size,
                    "{turned} {to}"
                );
            }
            // A target goes along: the end still meets it.
            let target = one.targets.get(End::Start).expect("a target");
            let start = one.polygon.end_jet(End::Start);
            assert!(target.point.distance(start.point) <= 10.0 * ROUNDING * size);
            let off = target.direction.expect("one").angle_between(start.first);
            assert!(off <= 1e-7, "{off}");
        }
        if count == 4 {
            let opposite = curve
                .polygon
                .vertices()
                .iter()
                .zip(curves[2].polygon.vertices());
            for (before, after) in opposite {
                let expected = about - (*before - about).with_z(-before.z);
                assert_eq!(expected, *after);
            }
        }
    }
}

#[test]
fn without_a_step_copies_stand_side_by_side() {
    let curve = curve(6, false);
    let (_, curves) = Runner::curves(vec![curve]).done("array", &[]);
    let across = curves.iter().map(|it| {
        let steps = 0..=8 * it.polygon.segments();
        let xs = steps.map(|step| it.polygon.point(step as f64 / 8.0).x);
        xs.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
    });
    let across: Vec<[f64; 2]> = across.collect();
    assert_eq!(across.len(), 3);
    assert!(
        across.windows(2).all(|pair| pair[0][1] < pair[1][0]),
        "{across:?}"
    );
}
