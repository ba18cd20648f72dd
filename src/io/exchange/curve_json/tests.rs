use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use glam::DVec3;

use super::{read, write};
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape};

const LINE: &str = r#"{"degree": 1, "knots": [0, 0, 1, 1], "points": [[0, 1], [2, 3, 4]]}"#;

fn item(shape: Shape) -> Item {
    Item {
        at: 4,
        ..Item::new(Kind::Spline, vec![shape])
    }
}

fn drawing(items: Vec<Item>) -> Drawing {
    Drawing {
        unit: Some(25.4),
        items,
        ..Drawing::default()
    }
}

fn sample() -> Drawing {
    let third = 1.0 / 3.0;
    let mut first = item(Shape::Nurbs(Nurbs {
        degree: 2,
        knots: vec![-2.0, -1.0, 0.0, third, 2e20, 3e20, 4e20],
        points: vec![
            DVec3::new(0.1, third, -1e-300),
            DVec3::ONE,
            DVec3::new(5.5, 1e300, 0.0),
            DVec3::X,
        ],
        weights: Some(vec![1.0, third, 2.0, 1.0]),
        periodic: true,
    }));
    first.name = Some("a \"b\" \\ ü\n".to_owned());
    first.group = ["hull".to_owned(), "frames 1".to_owned()].into();
    let second = item(Shape::Nurbs(Nurbs {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        points: vec![DVec3::ZERO, DVec3::Y],
        weights: None,
        periodic: false,
    }));
    drawing(vec![first, Item { at: 5, ..second }])
}

#[test]
fn written_curves_are_read_back_bit_for_bit() {
    assert_eq!(read(&write(&sample(), "").unwrap()).unwrap(), sample());
}

#[test]
fn all_units() {
    for (name, unit) in [
        ("\"mm\"", Some(1.0)),
        ("\"cm\"", Some(10.0)),
        ("\"m\"", Some(1000.0)),
        ("\"in\"", Some(25.4)),
        ("null", None),
    ] {
        let text = format!("{{\"unit\": {name}, \"curves\": [{LINE}]}}");
        let found = read(text.as_bytes()).unwrap();
        assert_eq!((found.unit, found.remarks.len()), (unit, 0));
        assert!(
            String::from_utf8(write(&found, "").unwrap())
                .unwrap()
                .contains(&format!("\"unit\": {name}"))
        );
    }
    let found = read(format!("{{\"unit\": \"ell\", \"curves\": [{LINE}]}}").as_bytes()).unwrap();
    assert_eq!((found.unit, found.remarks.len()), (None, 1));
    let feet = Drawing {
        unit: Some(304.8),
        ..sample()
    };
    let found = read(&write(&feet, "").unwrap()).unwrap();
    let Shape::Nurbs(line) = &found.items[1].shapes[0] else {
        panic!()
    };
    assert_eq!(
        (found.unit, line.points[1]),
        (Some(1.0), DVec3::new(0.0, 304.8, 0.0))
    );
}

#[test]
fn a_bare_list_is_read() {
    let found = read(format!("\u{feff}[\n{LINE},\n{LINE}]").as_bytes()).unwrap();
    assert_eq!(found.items.len(), 2);
    assert_eq!(found.items[1].at, 3);
    let Shape::Nurbs(line) = &found.items[0].shapes[0] else {
        panic!()
    };
    assert_eq!(
        line.points,
        [DVec3::new(0.0, 1.0, 0.0), DVec3::new(2.0, 3.0, 4.0)]
    );
}

#[test]
fn knots_may_be_missing_and_groups_a_list() {
    let text = r#"[{"degree": 2, "points": [[0, 0], [1, 0], [1, 1], [2, 2]],
        "group": ["a/b", "c"], "weights": [2, 2, 2, 2]}]"#;
    let found = read(text.as_bytes()).unwrap();
    let Shape::Nurbs(curve) = &found.items[0].shapes[0] else {
        panic!()
    };
    assert_eq!(curve.knots, [0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0]);
    assert_eq!(curve.weights, None);
    assert_eq!(found.items[0].group[..], ["a/b", "c"]);
}

#[test]
fn damaged_curves_are_skipped_with_a_remark() {
    let cases = [
        (
            r#"{"degree": 1, "points": [[0], [1, 1]]}"#,
            "fewer than two",
        ),
        (
            r#"{"degree": 1, "points": [[0, 0, 0, 0], [1, 1]]}"#,
            "more than three",
        ),
        (r#"{"degree": 0, "points": [[0, 0], [1, 1]]}"#, "too few"),
        (
            r#"{"degree": 99999999999, "points": [[0, 0], [1, 1]]}"#,
            "too few",
        ),
        (r#"{"degree": -1, "points": [[0, 0], [1, 1]]}"#, "invalid"),
        (r#"{"points": [[0, 0], [1, 1]]}"#, "missing field `degree`"),
        (
            r#"{"degree": 1, "knots": [0, 1], "points": [[0, 0], [1, 1]]}"#,
            "2 knots in place of 4",
        ),
        (
            r#"{"degree": 1, "knots": [0, 1, 0, 1], "points": [[0, 0], [1, 1]]}"#,
            "do not rise",
        ),
        (
            r#"{"degree": 1, "knots": [0, 1, 1, 2], "points": [[0, 0], [1, 1]]}"#,
            "do not rise",
        ),
        (
            r#"{"degree": 1, "points": [[0, 0], [1, 1]], "weights": [1]}"#,
            "1 weights",
        ),
        (
            r#"{"degree": 1, "points": [[0, 0], [1, 1]], "weights": [1, 0]}"#,
            "not above 0",
        ),
        (
            r#"{"degree": 1, "points": [[0, 0], [1, 1e999]]}"#,
            "out of range",
        ),
        ("3", "invalid type"),
    ];
    let broken = read(b"[\n{\"degree\": 1,\n\"points\": 7}]").unwrap();
    assert_eq!(
        broken.remarks,
        ["line 3: a curve is skipped: invalid type: integer `7`, expected a sequence"]
    );
    for (curve, reason) in cases {
        let found = read(format!("[\n{LINE},\n{curve},\n{LINE}]").as_bytes()).unwrap();
        assert_eq!(found.items.len(), 2, "{curve}");
        let remark = &found.remarks[0];
        assert!(
            remark.starts_with("line 3: a curve is skipped") && remark.contains(reason),
            "{remark}"
        );
    }
}

#[test]
fn what_comes_before_damage_is_kept() {
    let found = read(format!("{{\"curves\": [\n{LINE},\n{}", &LINE[..20]).as_bytes()).unwrap();
    assert_eq!(found.items.len(), 1);
    assert!(found.remarks[0].starts_with("line 3: the file is damaged"));
    for text in [
        "",
        "{",
        "{}",
        "[",
        "3",
        "{\"curves\": 3}",
        &"[".repeat(100_000),
    ] {
        assert!(read(text.as_bytes()).is_err(), "{text}");
    }
    assert_eq!(read(b"[]").unwrap(), Drawing::default());
    assert_eq!(read(b"\xff").unwrap_err().at, Some(1));
}

#[test]
fn arcs_and_polylines_become_splines() {
    let circle = Conic {
        centre: DVec3::new(1.0, 2.0, 3.0),
        x: DVec3::X,
        y: DVec3::Z,
        from: 0.0,
        to: TAU,
    };
    let corners = Shape::Polyline {
        points: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        closed: true,
    };
    let found = read(
        &write(
            &drawing(vec![item(Shape::Conic(circle)), item(corners)]),
            "",
        )
        .unwrap(),
    )
    .unwrap();
    let Shape::Nurbs(circle) = &found.items[0].shapes[0] else {
        panic!()
    };
    assert_eq!((circle.degree, circle.points.len()), (2, 9));
    assert_eq!(circle.points[0], circle.points[8]);
    assert!(circle.points[1].distance(DVec3::new(2.0, 2.0, 4.0)) < 1e-15);
    let weights = circle.weights.as_ref().unwrap();
    assert!((weights[1] - FRAC_1_SQRT_2).abs() < 1e-15 && weights[2] == 1.0);
    let Shape::Nurbs(corners) = &found.items[1].shapes[0] else {
        panic!()
    };
    assert_eq!(
        corners.points,
        [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ZERO]
    );
    assert_eq!(corners.knots, [0.0, 0.0, 1.0, 2.0, 3.0, 3.0]);
}

#[test]
fn points_and_damaged_splines_are_refused_by_name() {
    let mut point = item(Shape::Point(DVec3::X));
    point.name = Some("keel".to_owned());
    let error = write(&drawing(vec![point]), "").unwrap_err().reason;
    assert!(
        error.contains("“keel”") && error.contains("point"),
        "{error}"
    );
    let mut damaged = sample();
    if let Shape::Nurbs(nurbs) = &mut damaged.items[0].shapes[0] {
        nurbs.points[0].x = f64::NAN;
    }
    assert!(
        write(&damaged, "")
            .unwrap_err()
            .reason
            .contains("not finite")
    );
}

#[test]
fn mutations_do_not_panic() {
    let files = [
        write(&sample(), "").unwrap(),
        format!("[{LINE}, {LINE}]").into_bytes(),
    ];
    super::super::mutate::all(&files, 1000, 0, |bytes| {
        let _ = read(bytes);
    });
}
