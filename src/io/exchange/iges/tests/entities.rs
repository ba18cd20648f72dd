use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use super::*;
use crate::io::exchange::drawing::{Kind, Space};

#[test]
fn line_keeps_its_points() {
    let drawing = drawing(&[given(110, "1.,2.D0,-3.,4.5E1,,0")]);
    assert_eq!(drawing.unit, Some(1.0));
    assert_eq!(drawing.remarks, Vec::<String>::new());
    let item = &drawing.items[0];
    assert_eq!(
        (item.kind, item.space, item.at),
        (Kind::Line, Space::Model, 4)
    );
    let points = vec![DVec3::new(1.0, 2.0, -3.0), DVec3::new(45.0, 0.0, 0.0)];
    assert_eq!(
        item.shapes,
        [Shape::Polyline {
            points,
            closed: false
        }]
    );
}

#[test]
fn unbounded_line_has_a_remark() {
    let line = Given {
        form: 1,
        ..given(110, "0.,0.,0.,1.,0.,0.")
    };
    assert!(has_remark(
        &drawing(&[line]),
        "line 4: type 110: an unbounded line"
    ));
}

#[test]
fn arc_runs_anticlockwise() {
    let drawing = drawing(&[given(100, "5.,1.,2.,4.,2.,1.,5.")]);
    let Shape::Conic(arc) = only_shape(&drawing) else {
        panic!()
    };
    assert_eq!(drawing.items[0].kind, Kind::Arc);
    assert_eq!(arc.centre, DVec3::new(1.0, 2.0, 5.0));
    assert_eq!((arc.x, arc.y), (DVec3::X * 3.0, DVec3::Y * 3.0));
    assert_eq!((arc.from, arc.to), (0.0, FRAC_PI_2));
}

#[test]
fn arc_with_equal_ends_is_a_circle() {
    let drawing = drawing(&[given(100, "0.,0.,0.,2.,0.,2.,0.")]);
    let Shape::Conic(arc) = only_shape(&drawing) else {
        panic!()
    };
    assert_eq!(
        (drawing.items[0].kind, arc.from, arc.to),
        (Kind::Circle, 0.0, TAU)
    );
}

#[test]
fn point_and_point_set_are_points() {
    let set = Given {
        form: 1,
        ..given(106, "1,2,7.,1.,2.,3.,4.")
    };
    let drawing = drawing(&[given(116, "1.,2.,3.,0"), set]);
    let points: Vec<&Shape> = drawing.items.iter().flat_map(|item| &item.shapes).collect();
    assert!(drawing.items.iter().all(|item| item.kind == Kind::Point));
    let at = |x, y, z| Shape::Point(DVec3::new(x, y, z));
    assert_eq!(
        points,
        [&at(1.0, 2.0, 3.0), &at(1.0, 2.0, 7.0), &at(3.0, 4.0, 7.0)]
    );
}

#[test]
fn chains_of_points_are_polylines() {
    let chain = |form, text| Given {
        form,
        ..given(106, text)
    };
    let drawing = drawing(&[
        chain(11, "1,3,0.,0.,0.,1.,0.,1.,1."),
        chain(12, "2,2,0.,0.,1.,1.,0.,2."),
        chain(13, "3,2,0.,0.,1.,9.,9.,9.,1.,0.,2.,9.,9.,9."),
        chain(63, "1,4,0.,0.,0.,1.,0.,1.,1.,0.,0."),
        chain(31, "1,2,0.,0.,0.,1.,0."),
    ]);
    let shapes: Vec<(usize, bool)> = drawing
        .items
        .iter()
        .map(|item| match &item.shapes[0] {
            Shape::Polyline { points, closed } => (points.len(), *closed),
            _ => panic!(),
        })
        .collect();
    assert_eq!(shapes, [(3, false), (2, false), (2, false), (3, true)]);
    assert_eq!(drawing.items[1].shapes, drawing.items[2].shapes);
    assert_eq!(drawing.other[0].kind, "106 form 31");
}

/// One segment of degree 3 in two halves: y = x³ on x from 0 to 2.
#[test]
fn smooth_parametric_spline_has_simple_knots() {
    let first = "0.,1.,0.,0.,0.,0.,0.,1.,0.,0.,0.,0.";
    let second = "1.,1.,0.,0.,1.,3.,3.,1.,0.,0.,0.,0.";
    let end = "2.,1.,0.,0.,8.,12.,6.,1.,0.,0.,0.,0.";
    let drawing = drawing(&[given(
        112,
        &format!("3,2,2,2,0.,1.,2.,{first},{second},{end}"),
    )]);
    let Shape::Nurbs(nurbs) = only_shape(&drawing) else {
        panic!()
    };
    assert_eq!(nurbs.knots, [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0]);
    for index in 0..=20 {
        let x = f64::from(index) / 10.0;
        assert!((evaluate(nurbs, x) - DVec3::new(x, x * x * x, 0.0)).length() < 1e-14);
    }
}

#[test]
fn parametric_spline_with_a_kink_keeps_it() {
    let first = "0.,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,0.";
    let second = "1.,1.,0.,0.,1.,-1.,0.,0.,0.,0.,0.,0.";
    let drawing = drawing(&[given(112, &format!("3,0,2,2,0.,1.,2.,{first},{second}"))]);
    let Shape::Nurbs(nurbs) = only_shape(&drawing) else {
        panic!()
    };
    assert_eq!(
        (nurbs.degree, nurbs.knots.as_slice()),
        (2, &[0., 0., 0., 1., 1., 2., 2., 2.][..])
    );
    assert_eq!(evaluate(nurbs, 0.5), DVec3::new(0.5, 0.25, 0.0));
    assert_eq!(evaluate(nurbs, 1.5), DVec3::new(1.5, 0.5, 0.0));
}

/// Knots −3 to 8, seven points, degree 3.
const FLOAT: &str = "6,3,0,0,1,0,-3.,-2.,-1.,0.,1.,2.,3.,4.,5.,6.,7.,1.,1.,1.,1.,1.,1.,1.,\
    0.,0.,0.,1.,2.,0.,2.,-1.,1.,3.,3.,0.,4.,0.,2.,5.,1.,0.,6.,0.,0.";

fn spline(range: &str) -> Nurbs {
    let drawing = drawing(&[given(126, &format!("{FLOAT},{range}"))]);
    assert_eq!(drawing.items[0].kind, Kind::Spline);
    match only_shape(&drawing) {
        Shape::Nurbs(nurbs) => nurbs.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn spline_over_its_whole_domain_keeps_its_knots() {
    let nurbs = spline("0.,4.,0.,0.,1.");
    assert_eq!(nurbs.knots, (-3..8).map(f64::from).collect::<Vec<_>>());
    assert_eq!(
        (nurbs.points.len(), nurbs.weights, nurbs.periodic),
        (7, None, false)
    );
}

#[test]
fn spline_is_cut_to_its_range() {
    let whole = spline("0.,4.");
    for (range, from, to) in [
        ("0.5,3.25", 0.5, 3.25),
        ("1.,2.", 1.0, 2.0),
        ("0.,.5", 0.0, 0.5),
        ("2.5,4.", 2.5, 4.0),
    ] {
        let part = spline(range);
        assert_eq!((part.knots[3], part.knots[part.points.len()]), (from, to));
        for index in 0..=40 {
            let t = from + (to - from) * f64::from(index) / 40.0;
            assert!(
                (evaluate(&part, t) - evaluate(&whole, t)).length() < 1e-14,
                "{range} {t}"
            );
        }
    }
}

#[test]
fn rational_spline_is_cut_on_its_circle() {
    let weight = 0.5_f64.sqrt();
    let knots = "0.,0.,0.,1.,1.,2.,2.,2.";
    let points = "1.,0.,0.,1.,1.,0.,0.,1.,0.,-1.,1.,0.,-1.,0.,0.";
    let text = format!("4,2,1,0,0,0,{knots},1.,{weight},1.,{weight},1.,{points},.3,1.6");
    let drawing = drawing(&[given(126, &text)]);
    let Shape::Nurbs(nurbs) = only_shape(&drawing) else {
        panic!()
    };
    assert_eq!(nurbs.knots, [0.3, 0.3, 0.3, 1.0, 1.0, 1.6, 1.6, 1.6]);
    for index in 0..=40 {
        let point = point_at(only_shape(&drawing), f64::from(index) / 40.0);
        assert!((point.length() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn range_beyond_the_knots_or_missing_has_a_remark() {
    for (range, remark) in [
        (",-1.,4.", "goes beyond the knots"),
        (",2.,2.", "is empty"),
        ("", "is missing"),
    ] {
        let drawing = drawing(&[given(126, &format!("{FLOAT}{range}"))]);
        assert!(has_remark(&drawing, remark), "{:?}", drawing.remarks);
        assert_eq!(drawing.items.len(), 1);
    }
}

#[test]
fn damaged_spline_is_skipped_with_its_reason() {
    for (text, reason) in [
        (
            "1,1,0,0,1,0,0.,0.,1.,1.,1.,0.,0.,0.,0.,1.,0.,0.,0.,1.",
            "a weight is not positive",
        ),
        (
            "1,1,0,0,1,0,0.,0.,-1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.",
            "the knots do not rise",
        ),
        (
            "1,1,0,0,1,0,0.,0.,0.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.",
            "the knots span no length",
        ),
        (
            "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,1.E999,0.,1.,0.,0.,0.,1.",
            "parameter 14 is not finite",
        ),
        (
            "1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,nan,0.,1.,0.,0.,0.,1.",
            "parameter 14 (\"nan\") is no number",
        ),
        ("1,3,0,0,1,0,0.,0.,1.,1.", "too few for degree 3"),
        ("999999999,3,0,0,1,0,0.", "counts 999999999"),
        ("4,3,0,0,1,0,0.", "need 36 parameters"),
    ] {
        let drawing = drawing(&[given(126, text)]);
        assert!(drawing.items.is_empty());
        assert!(
            has_remark(&drawing, "line 4: type 126: "),
            "{:?}",
            drawing.remarks
        );
        assert!(
            has_remark(&drawing, reason),
            "{:?} {reason}",
            drawing.remarks
        );
    }
}
