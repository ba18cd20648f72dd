use std::f64::consts::TAU;

use glam::DVec3;

use super::{read, write};
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape};

const VERTICES: &str = "v 0 0 0\nv 1 0 0 2\nv 1 1 0.5\nv 2 1 0 1 0 0\n";

fn file(text: &str) -> Drawing {
    read(format!("{VERTICES}{text}").as_bytes()).unwrap()
}

fn spline(drawing: &Drawing) -> &Nurbs {
    match drawing.items[0].shapes.as_slice() {
        [Shape::Nurbs(nurbs)] => nurbs,
        other => panic!("{other:?}"),
    }
}

fn corners() -> [DVec3; 4] {
    [
        DVec3::ZERO,
        DVec3::X,
        DVec3::new(1.0, 1.0, 0.5),
        DVec3::new(2.0, 1.0, 0.0),
    ]
}

/// The value of a clamped quadratic with one inner knot at 1, by hand.
fn quadratic(points: &[DVec3], u: f64) -> DVec3 {
    if u <= 1.0 {
        let (a, b) = (
            points[0].lerp(points[1], u),
            points[1].lerp(points[2], 0.5 * u),
        );
        a.lerp(b, u)
    } else {
        let (a, b) = (
            points[1].lerp(points[2], 0.5 * u),
            points[2].lerp(points[3], u - 1.0),
        );
        a.lerp(b, u - 1.0)
    }
}

#[test]
fn splines_with_knots_names_and_groups() {
    let found = file(
        "# unit: 25.4 mm\no keel\ng hull/frames 1\ncstype bspline\ndeg 2\ncurv 0 2 1 2 -2 -1\n\
         parm u 0 0 0 \\\n1 2 2 2\nend\n",
    );
    let item = &found.items[0];
    assert_eq!(
        (item.kind, item.name.as_deref(), item.at),
        (Kind::Spline, Some("keel"), 10)
    );
    assert_eq!(item.group[..], ["hull", "frames 1"]);
    assert_eq!(found.unit, Some(25.4));
    let curve = spline(&found);
    assert_eq!((curve.degree, &curve.points[..]), (2, &corners()[..]));
    assert_eq!(curve.knots, [0., 0., 0., 1., 2., 2., 2.]);
    assert_eq!(curve.weights, None);
    assert!(found.remarks.is_empty());
}

#[test]
fn rational_splines() {
    let found = file("cstype rat bspline\ndeg 1\ncurv 0 1 1 2\nparm u 0 0 1 1\nend\n");
    assert_eq!(spline(&found).weights, Some(vec![1.0, 2.0]));
    assert_eq!(found.unit, None);
}

#[test]
fn bezier_curves() {
    let found =
        file("cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\ncurv 0 1 1 2 3 4\nend\n");
    assert_eq!(found.items.len(), 2);
    assert_eq!(
        (found.items[0].kind, &spline(&found).knots[..]),
        (Kind::Bezier, &[0., 0., 0., 0., 1., 1., 1., 1.][..])
    );
    let found = file("cstype bezier\ndeg 1\ncurv 3 9 1 2 3\nparm u 3 5 9\nend\n");
    assert_eq!(spline(&found).knots, [3., 3., 5., 9., 9.]);
}

#[test]
fn a_part_of_a_curve_is_cut_out() {
    for (from, to) in [
        (0.25, 1.5),
        (0.0, 1.0),
        (1.0, 2.0),
        (0.5, 0.75),
        (1.25, 2.0),
    ] {
        let found = file(&format!(
            "cstype bspline\ndeg 2\ncurv {from} {to} 1 2 3 4\nparm u 0 0 0 1 2 2 2\nend\n"
        ));
        let part = spline(&found);
        assert_eq!((part.knots[0], part.knots[part.points.len()]), (from, to));
        assert!(part.points[0].distance(quadratic(&corners(), from)) < 1e-15);
        assert!(
            part.points
                .last()
                .unwrap()
                .distance(quadratic(&corners(), to))
                < 1e-15
        );
        assert_eq!(
            part.points.len(),
            if from < 1.0 && to > 1.0 { 4 } else { 3 }
        );
    }
}

#[test]
fn a_part_of_an_unclamped_rational_curve() {
    let whole = file("cstype rat bspline\ndeg 2\ncurv 2 4 1 2 3 4\nparm u 0 1 2 3 4 5 6\nend\n");
    assert_eq!(spline(&whole).knots, [0., 1., 2., 3., 4., 5., 6.]);
    let part = file("cstype rat bspline\ndeg 2\ncurv 2.5 4 1 2 3 4\nparm u 0 1 2 3 4 5 6\nend\n");
    let part = spline(&part);
    assert_eq!(part.knots, [2.5, 2.5, 2.5, 3., 4., 4., 4.]);
    // At the end of the uniform curve are its last two points in equal parts.
    let end = (corners()[2] + corners()[3]) / 2.0;
    assert!(part.points[3].distance(end) < 1e-15);
    // At 2.5 the basis is 1/8, 3/4, 1/8, and the weight of the second point is 2.
    let start = (corners()[0] / 8.0 + corners()[1] * 1.5 + corners()[2] / 8.0) / 1.75;
    assert!(part.points[0].distance(start) < 1e-15);
}

#[test]
fn a_range_beyond_the_knots_is_cut_to_them() {
    let found = file("cstype bspline\ndeg 2\ncurv 0 1 1 2 3 4\nparm u 0 .2 .4 .6 .8 .9 1\nend\n");
    assert_eq!(spline(&found).knots, [0., 0.2, 0.4, 0.6, 0.8, 0.9, 1.]);
    assert!(found.remarks[0].starts_with("line 7: the range"));
}

#[test]
fn polylines_and_points() {
    let found = file("l 1 2 3\nl 1/1 2/2 3 1\nl 1 2\np 1 -1\n");
    let kinds: Vec<_> = found.items.iter().map(|it| it.kind).collect();
    assert_eq!(
        kinds,
        [
            Kind::Polyline,
            Kind::Polyline,
            Kind::Line,
            Kind::Point,
            Kind::Point
        ]
    );
    let closed = |index: usize| match &found.items[index].shapes[0] {
        Shape::Polyline { points, closed } => *closed && points.len() == 3,
        _ => false,
    };
    assert!(!closed(0) && closed(1));
    assert_eq!(found.items[4].shapes, [Shape::Point(corners()[3])]);
}

#[test]
fn faces_and_surfaces_are_counted() {
    let found = file(
        "f 1 2 3\nf 1 2 3\ncstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 0 1 1\n\
         parm v 0 0 1 1\nend\nwhat 3\n",
    );
    let other: Vec<_> = found
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count, it.at))
        .collect();
    assert_eq!(other, [("f", 2, 5), ("surf", 1, 9), ("what", 1, 13)]);
    assert_eq!((found.items.len(), found.remarks.len()), (0, 0));
}

#[test]
fn damage_has_a_remark_with_its_line() {
    for (text, reason) in [
        ("v 1 x 2\n", "line 5: “v” is skipped: “x” is no number"),
        ("v 1 2\n", "a number is missing"),
        ("l 1 9\n", "there is no vertex 9"),
        ("l 1 0\n", "there is no vertex 0"),
        ("l 1 -9\n", "there is no vertex -9"),
        ("l 1\n", "fewer than two points"),
        ("parm u 1\n", "no curve before it"),
        ("curv 0 1 1 2\nend\n", "no cstype"),
        (
            "cstype cardinal\ndeg 3\ncurv 0 1 1 2 3 4\nend\n",
            "line 7: “curv” is skipped: curves of type cardinal",
        ),
        (
            "cstype bspline\ncurv 0 1 1 2\nparm u 0 0 1 1\nend\n",
            "no deg",
        ),
        (
            "cstype bspline\ndeg 1\ncurv 0 1 1 2\nend\n",
            "0 knots in place of 4",
        ),
        (
            "cstype bspline\ndeg 1\ncurv .5 .5 1 2\nparm u 0 0 1 1\nend\n",
            "is empty",
        ),
        (
            "cstype bspline\ndeg 1\ncurv 1 0 1 2\nparm u 0 0 1 1\nend\n",
            "is empty",
        ),
        (
            "cstype bspline\ndeg 1\ncurv 0 1 1 2\nparm u 0 0 1 nan\nend\n",
            "not finite",
        ),
        (
            "cstype bezier\ndeg 2\ncurv 0 1 1 2\nend\n",
            "no Bézier curves",
        ),
        (
            "cstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0\nend\n",
            "1 parameters in place of 2",
        ),
    ] {
        let found = file(text);
        assert_eq!(found.items.len(), 0, "{text}");
        assert!(
            found.remarks.len() == 1 && found.remarks[0].contains(reason),
            "{text} {:?}",
            found.remarks
        );
    }
    let found = file("cstype bspline\ndeg 1\ncurv 0 1 1 2\nparm u 0 0 1 1\n");
    assert_eq!((found.items.len(), found.remarks.len()), (1, 1));
    assert!(read(b"a\0b").is_err() && read(b"").is_err() && read(b"<svg/>").is_err());
}

fn sample() -> Drawing {
    let third = 1.0 / 3.0;
    let shapes = [
        (
            Kind::Spline,
            Shape::Nurbs(Nurbs {
                degree: 2,
                knots: vec![-2.0, -1.0, 0.0, third, 2e20, 3e20, 4e20],
                points: vec![
                    DVec3::new(0.1, third, -1e-300),
                    DVec3::ONE,
                    DVec3::new(5.5, 1e300, 0.0),
                    DVec3::X,
                ],
                weights: Some(vec![1.0, third, 2.0, 1.0]),
                periodic: false,
            }),
        ),
        (
            Kind::Polyline,
            Shape::Polyline {
                points: vec![DVec3::ZERO, DVec3::splat(third), DVec3::Y],
                closed: true,
            },
        ),
        (Kind::Point, Shape::Point(DVec3::splat(-third))),
        (
            Kind::Spline,
            Shape::Nurbs(Nurbs {
                degree: 1,
                knots: vec![0.0, 0.0, 1.0, 1.0],
                points: vec![DVec3::ZERO, DVec3::Y],
                weights: None,
                periodic: false,
            }),
        ),
    ];
    let mut items: Vec<_> = shapes
        .into_iter()
        .map(|(kind, shape)| Item::new(kind, vec![shape]))
        .collect();
    items[0].name = Some("the keel".to_owned());
    items[1].name = Some("the keel".to_owned());
    items[1].group = ["hull".to_owned(), "frame 1".to_owned()].into();
    items[3].group = ["hull".to_owned()].into();
    Drawing {
        unit: Some(25.4),
        items,
        ..Drawing::default()
    }
}

#[test]
fn written_curves_are_read_back_bit_for_bit() {
    let mut found = read(&write(&sample(), "a\nb").unwrap()).unwrap();
    found.items.iter_mut().for_each(|it| it.at = 0);
    assert_eq!(found, sample());
}

#[test]
fn arcs_are_written_as_rational_splines() {
    let arc = Conic {
        centre: DVec3::ZERO,
        x: DVec3::X,
        y: DVec3::Y,
        from: 0.0,
        to: TAU / 3.0,
    };
    let mut drawing = sample();
    drawing.items[0].shapes = vec![Shape::Conic(arc)];
    let found = read(&write(&drawing, "").unwrap()).unwrap();
    let curve = spline(&found);
    assert_eq!((curve.degree, curve.points.len()), (2, 5));
    let middle = DVec3::new(0.5, 0.75_f64.sqrt(), 0.0);
    assert!(curve.points[2].distance(middle) < 1e-15);
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let mut drawing = sample();
    drawing.items[2].shapes = vec![Shape::Point(DVec3::NAN)];
    assert!(
        write(&drawing, "")
            .unwrap_err()
            .reason
            .contains("item 3 (point)")
    );
}

#[test]
fn mutations_do_not_panic() {
    let other = format!(
        "{VERTICES}cstype rat bspline\ndeg 2\ncurv 2.5 4 1 2 3 4\nparm u 0 1 2 3 4 5 6\nend\np 1\n"
    );
    super::super::mutate::all(
        &[write(&sample(), "").unwrap(), other.into_bytes()],
        1000,
        0,
        |bytes| {
            let _ = read(bytes);
        },
    );
}
