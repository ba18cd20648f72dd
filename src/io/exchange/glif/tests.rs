use std::collections::HashMap;

use glam::DVec3;

use super::{read, rewriting, write};
use crate::io::exchange::changes::{Changes, ItemChange};
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape};
use crate::io::loss::{Loss, LossReport};

fn glyph(outline: &str) -> Drawing {
    let text = format!(
        "<glyph name='a' format='2'><advance width='9'/>\n<outline>\n{outline}</outline></glyph>"
    );
    read(text.as_bytes()).unwrap()
}

/// A contour of points as `x y type`, separated by commas.
fn contour(points: &str) -> Drawing {
    let points = points.split(',').map(|it| {
        let words: Vec<_> = it.split_whitespace().collect();
        let kind = words
            .get(2)
            .map(|it| format!(" type='{it}'"))
            .unwrap_or_default();
        format!("<point x='{}' y='{}'{kind}/>", words[0], words[1])
    });
    glyph(&format!(
        "<contour>{}</contour>",
        points.collect::<String>()
    ))
}

fn points(points: &[(f64, f64)]) -> Vec<DVec3> {
    points
        .iter()
        .map(|it| DVec3::new(it.0, it.1, 0.0))
        .collect()
}

fn chain(corners: &[(f64, f64)], closed: bool) -> Shape {
    Shape::Polyline {
        points: points(corners),
        closed,
    }
}

fn spline(degree: usize, knots: &[f64], corners: &[(f64, f64)]) -> Shape {
    Shape::Nurbs(Nurbs {
        degree,
        knots: knots.to_vec(),
        points: points(corners),
        weights: None,
        periodic: false,
    })
}

#[test]
fn closed_contour_of_lines() {
    let found = contour("0 0 line,1 0 line,1 1.5 line");
    assert_eq!(
        found.items[0].shapes,
        [chain(&[(0., 0.), (1., 0.), (1., 1.5)], true)]
    );
    let item = &found.items[0];
    assert_eq!(
        (item.kind, item.name.as_deref(), item.at),
        (Kind::Path, Some("a"), 3)
    );
    assert_eq!(found.unit, None);
}

#[test]
fn open_contour() {
    let found = contour("0 0 move,1 0 line,1 1,2 2,3 1 curve");
    let curve = spline(
        3,
        &[0., 0., 0., 0., 1., 1., 1., 1.],
        &[(1., 0.), (1., 1.), (2., 2.), (3., 1.)],
    );
    assert_eq!(
        found.items[0].shapes,
        [chain(&[(0., 0.), (1., 0.)], false), curve]
    );
}

#[test]
fn closed_contour_begins_at_its_first_point_on_the_curve() {
    let found = contour("1 1,2 2,3 1 curve,0 0 line");
    let curve = spline(
        3,
        &[0., 0., 0., 0., 1., 1., 1., 1.],
        &[(0., 0.), (1., 1.), (2., 2.), (3., 1.)],
    );
    assert_eq!(
        found.items[0].shapes,
        [chain(&[(3., 1.), (0., 0.)], false), curve]
    );
}

#[test]
fn implied_points_are_those_of_a_uniform_spline() {
    let found = contour("0 0 move,1 0,2 1,3 0,4 0 qcurve");
    let knots = [0., 0., 0., 1., 2., 3., 3., 3.];
    assert_eq!(
        found.items[0].shapes,
        [spline(
            2,
            &knots,
            &[(0., 0.), (1., 0.), (2., 1.), (3., 0.), (4., 0.)]
        )]
    );
    let found = contour("0 0 move,1 0,2 1,3 0,4 0 curve");
    let knots = [0., 0., 0., 0., 1., 2., 2., 2., 2.];
    assert_eq!(
        found.items[0].shapes,
        [spline(
            3,
            &knots,
            &[(0., 0.), (1., 0.), (2., 1.), (3., 0.), (4., 0.)]
        )]
    );
}

#[test]
fn contour_without_points_on_the_curve_is_periodic() {
    let found = contour("0 0,1 0,1 1");
    let [Shape::Nurbs(ring)] = found.items[0].shapes.as_slice() else {
        panic!()
    };
    assert!(ring.periodic);
    assert_eq!(
        ring.points,
        points(&[(1., 1.), (0., 0.), (1., 0.), (1., 1.), (0., 0.)])
    );
    assert_eq!(ring.knots, [-2., -1., 0., 1., 2., 3., 4., 5.]);
}

#[test]
fn a_curve_of_one_control_point_is_quadratic_and_of_none_a_line() {
    let found = contour("0 0 move,1 1,2 0 curve,3 0 qcurve");
    let knots = [0., 0., 0., 1., 1., 1.];
    let expected = [
        spline(2, &knots, &[(0., 0.), (1., 1.), (2., 0.)]),
        chain(&[(2., 0.), (3., 0.)], false),
    ];
    assert_eq!(found.items[0].shapes, expected);
}

#[test]
fn components_anchors_and_guidelines_are_counted() {
    let text = "<glyph format='2'><anchor x='1' y='2' name='top'/><guideline x='1'/><image fileName='a'/>\
                <outline>\
                <component base='b' xScale='2'/><component base='b'/>\
                <contour><point x='1' y='2' type='move' name='t'/>\
                </contour></outline></glyph>";
    let found = read(text.as_bytes()).unwrap();
    let other: Vec<_> = found
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count))
        .collect();
    assert_eq!(
        other,
        [
            ("anchor", 2),
            ("guideline", 1),
            ("image", 1),
            ("component b", 2)
        ]
    );
    assert!(found.items.is_empty() && found.remarks.is_empty());
}

#[test]
fn damaged_contours_are_skipped_with_a_remark() {
    for (text, reason) in [
        (
            "1 x line,2 2 line",
            "line 3: <contour>: it is skipped because the point in line 3 has no y",
        ),
        ("1 1 what,2 2 line", "“what”"),
        ("1 1 line", "one point alone"),
        ("inf 1 line,2 2 line", "no x"),
    ] {
        let found = contour(text);
        assert_eq!(found.items.len(), 0);
        assert!(found.remarks[0].contains(reason), "{:?}", found.remarks);
    }
    for text in [
        "0 0 move,1 1 line,2 2",
        "0 0 move,1 1,2 2 line",
        "0 0 line,1 1 move,3 3 line",
    ] {
        let found = contour(text);
        assert_eq!((found.items.len(), found.remarks.len()), (1, 1));
    }
    assert!(
        read(b"<svg/>")
            .unwrap_err()
            .reason
            .contains("its root is <svg>")
    );
    assert_eq!(glyph("<contour/>").remarks.len(), 1);
}

fn samples() -> Vec<Drawing> {
    let third = format!("{}", 1.0_f64 / 3.0);
    [
        "0 0 line,1e-7 0 line,1 1.1 line",
        "0 0 move,1 0 line,THIRD 1,2 2,3 1 curve,4 4 line",
        "1 1,2 THIRD,3 1 curve,0 0 line,5 5 line",
        "0 0 move,1 0,2 1,3 0,4 0 qcurve,5 5 line,6 6,7 7 qcurve",
        "0 0 curve,1 0,2 1,3 0 qcurve,4 4 line,5 5,6 6",
        "0 0,1 0,1 1,-1 THIRD",
        "0 0,1 0",
    ]
    .map(|it| contour(&it.replace("THIRD", &third)))
    .to_vec()
}

#[test]
fn written_glyphs_are_read_back_bit_for_bit() {
    for drawing in samples() {
        let found = read(&write(&drawing, "a").unwrap()).unwrap();
        assert_eq!(found.remarks, Vec::<String>::new());
        assert_eq!(found.items.len(), 1);
        assert_eq!(found.items[0].shapes, drawing.items[0].shapes);
        assert_eq!(found.items[0].name, drawing.items[0].name);
    }
}

#[test]
fn what_glif_cannot_hold_is_refused_by_name() {
    let cubic = [(0., 0.), (1., 0.), (2., 1.), (3., 0.), (4., 0.)];
    let arc = Conic {
        centre: DVec3::ZERO,
        x: DVec3::X,
        y: DVec3::Y,
        from: 0.0,
        to: 1.0,
    };
    let cases = [
        (Shape::Conic(arc), "an arc"),
        (Shape::Point(DVec3::X), "a point"),
        (
            spline(3, &[0., 0., 0., 0., 1., 2., 2., 2., 2.], &cubic),
            "general spline",
        ),
        (
            spline(2, &[0., 0., 0., 1., 3., 4., 4., 4.], &cubic),
            "general spline",
        ),
        (chain(&[(0., 0.), (f64::INFINITY, 0.)], false), "not finite"),
    ];
    for (shape, reason) in cases {
        let item = Item {
            name: Some("keel".to_owned()),
            at: 1,
            ..Item::new(Kind::Spline, vec![shape])
        };
        let drawing = Drawing {
            items: vec![item],
            ..Drawing::default()
        };
        let error = write(&drawing, "a").unwrap_err().reason;
        assert!(
            error.contains("“keel”") && error.contains(reason),
            "{error}"
        );
    }
}

#[test]
fn mutations_do_not_panic() {
    let files: Vec<_> = samples().iter().map(|it| write(it, "a").unwrap()).collect();
    super::super::mutate::all(&files[3..6], 1000, 0, |bytes| {
        let _ = read(bytes);
    });
}

#[test]
fn a_piece_that_is_drawn_anew_leaves_its_contour_closed_and_other_points_as_they_are() {
    let glyph = r#"<?xml version="1.0"?>
<glyph name="n" format="2">
  <outline>
    <contour>
      <point x="0" y="0" type="line" smooth="yes"/>
      <point x="0" y="50"/>
      <point x="50" y="100"/>
      <point x="100" y="100" type="curve" smooth="yes"/>
      <point x="100" y="0" type="line" name="foot"/>
    </contour>
  </outline>
</glyph>
"#;
    let cubic = |points: [[f64; 2]; 4]| {
        Shape::Nurbs(Nurbs {
            degree: 3,
            knots: [[0.0; 4], [1.0; 4]].concat(),
            points: points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
            weights: None,
            periodic: false,
        })
    };
    let rewritten = |end: f64| {
        let halves = vec![
            cubic([[6e-15, 0.0], [0.0, 25.0], [12.0, 50.0], [35.0, 70.0]]),
            cubic([[35.0, 70.0], [60.0, 90.0], [75.0, 100.0], [100.0, end]]),
        ];
        let change = ItemChange {
            name: "n".to_owned(),
            shapes: vec![Some(halves), None],
        };
        let changes = Changes {
            items: HashMap::from([(0, change)]),
            added: Vec::new(),
        };
        let mut losses = LossReport::new("GLIF");
        let bytes = rewriting::rewritten(glyph.as_bytes(), &changes, &mut losses);
        let text = String::from_utf8(bytes.expect("a glyph")).expect("text");
        let losses: Vec<Loss> = losses.losses.into_iter().map(|it| it.1).collect();
        (text, losses)
    };
    let (text, losses) = rewritten(99.999_999_999_999_99);
    assert_eq!(losses, []);
    assert_eq!(text.matches("<contour>").count(), 1);
    for kept in [
        "<point x=\"0\" y=\"0\" type=\"line\" smooth=\"yes\"/>",
        "<point x=\"100\" y=\"100\" type=\"curve\" smooth=\"yes\"/>",
        "<point x=\"100\" y=\"0\" type=\"line\" name=\"foot\"/>",
    ] {
        assert!(text.contains(kept), "{text}");
    }
    let found = read(text.as_bytes()).expect("a glyph");
    assert_eq!(found.items.len(), 1);
    // An end that has moved opens the contour, and that is told.
    let (text, losses) = rewritten(90.0);
    assert!(text.contains("type=\"move\""));
    assert_eq!(losses, [Loss::PointAttributes, Loss::Opened]);
    // A point beside the gap keeps its name, also in a contour of its own, and none stands twice.
    assert_eq!(text.matches("name=\"foot\"").count(), 1, "{text}");
}
