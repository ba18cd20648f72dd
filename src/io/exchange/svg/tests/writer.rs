//! Tests of writing.

use std::f64::consts::TAU;

use super::super::super::splines::at;
use super::*;
use crate::io::exchange::drawing::Conic;

pub(super) fn sample() -> Drawing {
    let third = 1.0 / 3.0;
    let mut items = vec![
        item(vec![bezier(
            3,
            &[(-0.1, third), (1e-7, 2e20), (3.0, -7.7), (0.1 + 0.2, 5.0)],
        )]),
        item(vec![bezier(
            2,
            &[
                (0.0, 0.0),
                (third, 1.0),
                (2.0, 3.0),
                (-1.0, 1.0),
                (0.0, 0.0),
            ],
        )]),
        item(vec![chain(&[(0.0, 0.0), (1.1, third), (-2.0, 3.0)], true)]),
        item(vec![
            chain(&[(0.7, 0.0), (1.0, 1.0)], false),
            bezier(3, &[(1.0, 1.0), (2.0, 2.0), (3.0, 1.0), (third, 1.0)]),
            chain(&[(third, 1.0), (0.7, 0.0)], false),
        ]),
        item(vec![Shape::Conic(Conic {
            centre: point(third, -2.0),
            x: point(7.0 / 3.0, 0.0),
            y: point(0.0, 1.1),
            from: 0.0,
            to: TAU,
        })]),
    ];
    items[0].group = ["A \"<&> 1".to_owned(), "B".to_owned()].into();
    items[0].name = Some("curve & 'one'\n".trim().to_owned());
    items[1].group = ["A \"<&> 1".to_owned()].into();
    items[3].group = ["C".to_owned()].into();
    items[4].group = ["C".to_owned(), "D".to_owned()].into();
    for (it, red) in items.iter_mut().zip(1..) {
        it.colour = Some([red, 0, 255]);
    }
    Drawing {
        unit: Some(1.0),
        items,
        ..Drawing::default()
    }
}

#[test]
fn written_drawings_are_read_back_bit_for_bit() {
    let drawing = sample();
    let text = write(&drawing, "a & b").unwrap();
    let found = read(&text).unwrap();
    assert_eq!(found.unit, Some(1.0));
    assert_eq!(found.remarks, Vec::<String>::new());
    for item in &drawing.items {
        let same = found
            .items
            .iter()
            .find(|it| it.colour == item.colour)
            .unwrap();
        assert_eq!(
            (&same.group, &same.name, &same.shapes),
            (&item.group, &item.name, &item.shapes)
        );
    }
}

#[test]
fn written_arcs_are_read_back_within_rounding() {
    for (from, span) in [
        (0.3, 0.1),
        (-2.0, 1.0),
        (1.0, 3.1),
        (2.0, 3.2),
        (0.5, 6.0),
        (0.4, TAU),
    ] {
        for y in [point(-3.0, 4.0), point(3.0, -4.0), point(1.0, 2.0)] {
            let arc = Conic {
                centre: point(10.0, -20.0),
                x: point(8.0, 6.0),
                y,
                from,
                to: from + span,
            };
            let line = chain(&[(0.0, 0.0), (at(&arc, from).x, at(&arc, from).y)], false);
            let drawing = Drawing {
                items: vec![item(vec![line, Shape::Conic(arc.clone())])],
                ..Drawing::default()
            };
            let found = read(&write(&drawing, "").unwrap()).unwrap();
            assert_eq!(found.items.len(), 1);
            let Shape::Conic(same) = &found.items[0].shapes[1] else {
                panic!()
            };
            assert_eq!(
                found.items[0].shapes.len(),
                2,
                "{from} {span} {:?}",
                found.items[0].shapes
            );
            for part in 0..=16 {
                let share = f64::from(part) / 16.0;
                let point = at(same, same.from + share * (same.to - same.from));
                // Skewed axes give other parameters, but the same ellipse.
                let local = point - arc.centre;
                let det = arc.x.cross(arc.y).z;
                let (u, v) = (local.cross(arc.y).z / det, arc.x.cross(local).z / det);
                assert!((u.hypot(v) - 1.0).abs() < 1e-12);
            }
            assert!(at(same, same.from).distance(at(&arc, arc.from)) < 1e-12);
            assert!(at(same, same.to).distance(at(&arc, arc.to)) < 1e-12);
            assert_eq!(same.x.cross(same.y).z > 0.0, arc.x.cross(arc.y).z > 0.0);
        }
    }
}

#[test]
fn other_units_are_written_in_millimetres() {
    let drawing = Drawing {
        unit: Some(25.4),
        items: vec![item(vec![chain(&[(1.0, 2.0), (3.0, -4.0)], false)])],
        ..Drawing::default()
    };
    let found = read(&write(&drawing, "").unwrap()).unwrap();
    assert_eq!(
        shapes(&found),
        [chain(&[(25.4, 50.8), (3.0 * 25.4, -4.0 * 25.4)], false)]
    );
}

#[test]
fn what_svg_cannot_hold_is_refused_by_name() {
    let spline = |change: &dyn Fn(&mut Nurbs)| {
        let Shape::Nurbs(mut nurbs) = bezier(3, &[(0., 0.), (1., 0.), (2., 1.), (3., 1.)]) else {
            panic!()
        };
        change(&mut nurbs);
        Shape::Nurbs(nurbs)
    };
    let cases = [
        (
            spline(&|it| it.knots[1] = -1.0),
            "general spline of degree 3",
        ),
        (
            spline(&|it| it.weights = Some(vec![1.0, 2.0, 1.0, 1.0])),
            "rational spline of degree 3",
        ),
        (spline(&|it| it.points[1].z = 1.0), "plane z = 0"),
        (spline(&|it| it.points[1].x = f64::NAN), "not finite"),
        (
            bezier(4, &[(0., 0.), (1., 0.), (2., 1.), (3., 1.), (4., 1.)]),
            "spline of degree 4",
        ),
        (Shape::Point(DVec3::ZERO), "a point"),
    ];
    for (shape, reason) in cases {
        let mut item = item(vec![shape]);
        item.name = Some("keel".to_owned());
        let drawing = Drawing {
            items: vec![item],
            ..Drawing::default()
        };
        let error = write(&drawing, "").unwrap_err().reason;
        assert!(
            error.contains("“keel”") && error.contains(reason),
            "{error}"
        );
    }
}
