use std::sync::Arc;

use super::super::{exact, write};
use super::*;
use crate::io::exchange::drawing::Unreadable;

fn item(kind: Kind, shapes: Vec<Shape>) -> Item {
    Item {
        group: vec!["Batten".to_owned()].into(),
        colour: Some([10, 20, 30]),
        ..Item::new(kind, shapes)
    }
}

fn spline(degree: usize, knots: Vec<f64>, weights: Option<Vec<f64>>) -> Shape {
    let count = knots.len() - degree - 1;
    let points = (0..count as u32).map(|it| {
        let t = f64::from(it);
        DVec3::new(t / 3.0, (1.1 * t).sin(), 1e-7 * t.powi(9))
    });
    let points = points.collect();
    Shape::Nurbs(Nurbs {
        degree,
        knots,
        points,
        weights,
        periodic: false,
    })
}

fn polyline(points: &[DVec3], closed: bool) -> Shape {
    Shape::Polyline {
        points: points.to_vec(),
        closed,
    }
}

fn tilted(from: f64, to: f64) -> Conic {
    let x = DVec3::new(0.3, -1.7, 0.9);
    let y = x.cross(DVec3::new(0.1, 0.2, 0.7)).normalize() * x.length();
    Conic {
        centre: DVec3::new(1.0 / 3.0, 2.5, -7.1),
        x,
        y,
        from,
        to,
    }
}

fn round_trip(drawing: &Drawing) -> Drawing {
    let read = read(&write(drawing, "Test").unwrap()).unwrap();
    assert_eq!(read.remarks, [""; 0]);
    assert_eq!(read.unit, drawing.unit);
    assert_eq!(read.items.len(), drawing.items.len());
    read
}

#[test]
fn gives_back_every_number() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.1, 0.7, 1.0 / 3.0)];
    let uniform: Vec<f64> = (0..20).map(f64::from).collect();
    let clamped = vec![0.1, 0.1, 0.1, 0.1, 0.3, 0.3, 0.7, 0.9, 0.9, 0.9, 0.9];
    let weights = vec![1.0, 0.5_f64.sqrt(), 2.0, 0.5, 1.0, 0.25, 1.0];
    let chain = vec![
        polyline(&[DVec3::new(-2.0, 0.0, 0.0), DVec3::X], false),
        Shape::Conic(Conic {
            centre: DVec3::ZERO,
            x: DVec3::X,
            y: DVec3::Y,
            from: 0.0,
            to: 1.0,
        }),
    ];
    let mut named = item(
        Kind::Spline,
        vec![spline(3, clamped.clone(), Some(weights))],
    );
    named.name = Some("Straße 😀".to_owned());
    named.group = ["Außen", "innen", "tief"].map(str::to_owned).into();
    let drawing = Drawing {
        unit: Some(25.4),
        items: vec![
            item(Kind::Spline, vec![spline(9, uniform, None)]),
            named,
            item(Kind::Polycurve, vec![spline(3, clamped, None)]),
            item(Kind::Polycurve, chain),
            item(Kind::Circle, vec![Shape::Conic(tilted(0.3, 0.3 + TAU))]),
            item(Kind::Arc, vec![Shape::Conic(tilted(-1.0, 2.0 / 3.0))]),
            item(Kind::Line, vec![polyline(&corners[1..], false)]),
            item(Kind::Polyline, vec![polyline(&corners[1..], false)]),
            item(Kind::Polyline, vec![polyline(&corners, true)]),
            item(Kind::Point, vec![Shape::Point(corners[2])]),
        ],
        ..Drawing::default()
    };
    let mut read = round_trip(&drawing);
    for item in &mut read.items {
        item.at = 0;
    }
    assert_eq!(read, drawing);
}

/// The format has the products of points and weights alone: some points have none.
#[test]
fn gives_back_rational_points_but_for_the_last_digit() {
    let knots = vec![0.0, 0.0, 0.0, 0.0, 0.3, 0.5, 0.7, 1.0, 1.0, 1.0, 1.0];
    let weights = vec![1.0, 0.3, 3.1, 1.0 / 3.0, 1.7, 0.9, 1.1];
    let items = vec![item(Kind::Spline, vec![spline(3, knots, Some(weights))])];
    let drawing = Drawing {
        unit: Some(1.0),
        items,
        ..Drawing::default()
    };
    let read = round_trip(&drawing);
    let [Shape::Nurbs(a), Shape::Nurbs(b)] =
        [&drawing, &read].map(|drawing| drawing.items[0].shapes[0].clone())
    else {
        panic!()
    };
    assert_eq!((&a.weights, &a.knots), (&b.weights, &b.knots));
    for (a, b) in a.points.iter().zip(&b.points) {
        let apart = (*a - *b).abs();
        assert!(apart.cmple(a.abs() * f64::EPSILON).all(), "{a} {b}");
    }
}

#[test]
fn keeps_periodic_curves() {
    let knots: Vec<f64> = (-3..=7).map(f64::from).collect();
    let square = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
    let points = square.into_iter().cycle().take(7).collect();
    let curve = Shape::Nurbs(Nurbs {
        degree: 3,
        knots,
        points,
        weights: None,
        periodic: true,
    });
    let items = vec![item(Kind::Spline, vec![curve])];
    let drawing = Drawing {
        unit: Some(1.0),
        items,
        ..Drawing::default()
    };
    assert_eq!(
        round_trip(&drawing).items[0].shapes,
        drawing.items[0].shapes
    );
}

#[test]
fn keeps_units() {
    for unit in [1.0, 10.0, 1000.0, 25.4, 304.8, 0.7, 25.4 / 90.0, 1e-9] {
        let drawing = Drawing {
            unit: Some(unit),
            ..Drawing::default()
        };
        round_trip(&drawing);
    }
    let bytes = write(&Drawing::default(), "").unwrap();
    assert_eq!(read(&bytes).unwrap().unit, Some(1.0));
}

#[test]
fn writes_ellipses_as_rational_curves() {
    for (from, to) in [(0.0, TAU), (0.5, 0.6), (-2.0, 1.5)] {
        let conic = Conic {
            y: DVec3::new(0.3, 0.4, 0.5),
            ..tilted(from, to)
        };
        let items = vec![item(Kind::Ellipse, vec![Shape::Conic(conic.clone())])];
        let read = round_trip(&Drawing {
            unit: Some(1.0),
            items,
            ..Drawing::default()
        });
        let [Shape::Nurbs(curve)] = read.items[0].shapes.as_slice() else {
            panic!()
        };
        let weights = curve.weights.as_ref().unwrap();
        // Each piece by its Bernstein polynomials: no point may leave the ellipse.
        for start in (0..curve.points.len() - 1).step_by(2) {
            let inverse =
                glam::DMat3::from_cols(conic.x, conic.y, conic.x.cross(conic.y)).inverse();
            for step in 0..=20 {
                let t = f64::from(step) / 20.0;
                let parts = [(1.0 - t).powi(2), 2.0 * t * (1.0 - t), t * t];
                let weighted = |index: usize| parts[index] * weights[start + index];
                let sum: f64 = (0..3).map(weighted).sum();
                let point: DVec3 = (0..3)
                    .map(|it| curve.points[start + it] * weighted(it))
                    .sum();
                let plane = inverse * (point / sum - conic.centre);
                assert!((plane.truncate().length() - 1.0).abs() < 1e-13, "{plane}");
                assert!(plane.z.abs() < 1e-14);
            }
        }
        if to - from == TAU {
            assert_eq!(curve.points.first(), curve.points.last());
        }
    }
}

#[test]
fn splits_chains_that_do_not_meet() {
    let line = |from: f64| polyline(&[DVec3::X * from, DVec3::X * (from + 1.0)], false);
    let items = vec![item(Kind::Path, vec![line(0.0), line(1.0), line(5.0)])];
    let bytes = write(
        &Drawing {
            items,
            ..Drawing::default()
        },
        "",
    )
    .unwrap();
    let read = read(&bytes).unwrap();
    let counts: Vec<usize> = read.items.iter().map(|it| it.shapes.len()).collect();
    assert_eq!(counts, [2, 1]);
}

#[test]
fn puts_curves_without_a_group_on_the_default_layer() {
    let mut curve = item(Kind::Point, vec![Shape::Point(DVec3::ZERO)]);
    (curve.group, curve.colour) = (Arc::default(), None);
    let drawing = Drawing {
        items: vec![curve],
        ..Drawing::default()
    };
    let mut read = read(&write(&drawing, "Profil").unwrap()).unwrap();
    assert_eq!(read.items.remove(0).group[..], ["Default"]);
}

#[test]
fn writes_names_of_layers_that_rhino_accepts() {
    let mut curve = item(Kind::Point, vec![Shape::Point(DVec3::ZERO)]);
    curve.group = ["(a)", "", "b\n::c"].map(str::to_owned).into();
    let drawing = Drawing {
        unit: Some(1.0),
        items: vec![curve],
        ..Drawing::default()
    };
    assert_eq!(
        round_trip(&drawing).items[0].group[..],
        ["_(a)", "_", "b::c"]
    );
}

#[test]
fn names_the_curve_that_cannot_be_written() {
    let mut bad = item(
        Kind::Spline,
        vec![spline(2, vec![0.0, 0.0, 0.0, 1.0, f64::NAN, 1.0], None)],
    );
    bad.name = Some("Bug".to_owned());
    let items = vec![item(Kind::Point, vec![Shape::Point(DVec3::ZERO)]), bad];
    let Unreadable { reason, .. } = write(
        &Drawing {
            items,
            ..Drawing::default()
        },
        "",
    )
    .unwrap_err();
    assert!(
        reason.contains("Curve 2 \"Bug\" (spline) cannot be written"),
        "{reason}"
    );
}

#[test]
fn finds_exact_factors() {
    assert_eq!(exact::multiple(0.1, 0.3) / 0.3, 0.1);
    assert_eq!(exact::quotient(0.7, 1e3) * 1e3, 0.7);
    let (x, y) = (tilted(0.0, 1.0).x, tilted(0.0, 1.0).y);
    let (radius, a, b) = exact::axes(x, y);
    assert_eq!((a * radius, b * radius), (x, y));
    assert!((a.length() - 1.0).abs() < 1e-13);
}
