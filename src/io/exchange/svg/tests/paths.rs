//! Tests of paths and basic shapes.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::super::super::splines::at;
use super::*;
use crate::io::exchange::drawing::Conic;

#[test]
fn straight_commands_and_their_repeats() {
    let found = path("M10 10 20 10L20-5.5.5.5H30V40h-5-5v1Z m1 1l1 0");
    let first = [
        (10., 90.),
        (20., 90.),
        (20., 105.5),
        (0.5, 99.5),
        (30., 99.5),
        (30., 60.),
        (25., 60.),
        (20., 60.),
        (20., 59.),
    ];
    assert_eq!(
        shapes(&found),
        [chain(&first, true), chain(&[(11., 89.), (12., 89.)], false)]
    );
    assert_eq!(found.remarks, Vec::<String>::new());
    assert_eq!(found.unit, Some(1.0));
}

#[test]
fn drawing_goes_on_at_the_start_after_a_closed_subpath() {
    let found = path("m10 10 h5 v5 z l0 10");
    assert_eq!(shapes(&found)[1], chain(&[(10., 90.), (10., 80.)], false));
}

#[test]
fn cubic_and_smooth_cubic_are_one_spline() {
    let found = path("M0 0C0 10 10 20 20 20S40 30 40 40s5 5 10 10");
    let points = [
        (0., 100.),
        (0., 90.),
        (10., 80.),
        (20., 80.),
        (30., 80.),
        (40., 70.),
        (40., 60.),
        (40., 50.),
        (45., 55.),
        (50., 50.),
    ];
    assert_eq!(shapes(&found), [bezier(3, &points)]);
}

#[test]
fn quadratic_and_smooth_quadratic_are_one_spline() {
    let found = path("M0 0Q10 0 10 10T20 20t10 0q1 2 3 4");
    let points = [
        (0., 100.),
        (10., 100.),
        (10., 90.),
        (10., 80.),
        (20., 80.),
        (30., 80.),
        (30., 80.),
        (31., 78.),
        (33., 76.),
    ];
    assert_eq!(shapes(&found), [bezier(2, &points)]);
}

#[test]
fn smooth_commands_after_others_start_at_the_point() {
    let found = path("M0 0L10 0S20 10 30 0T40 0");
    assert_eq!(
        shapes(&found)[1],
        bezier(3, &[(10., 100.), (10., 100.), (20., 90.), (30., 100.)])
    );
    assert_eq!(
        shapes(&found)[2],
        bezier(2, &[(30., 100.), (30., 100.), (40., 100.)])
    );
}

#[test]
fn arcs_with_flags_without_separators() {
    let found = path("M20 50a10 10 0 0110-10");
    let Shape::Conic(arc) = &shapes(&found)[0] else {
        panic!()
    };
    assert_near(arc.centre, point(30., 50.));
    assert_near(at(arc, arc.from), point(20., 50.));
    assert_near(at(arc, arc.to), point(30., 60.));
    assert!((arc.to - arc.from - FRAC_PI_2).abs() < 1e-12);
}

#[test]
fn all_four_arcs_between_two_points() {
    for (large, sweep) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let found = path(&format!("M40 50A20 10 30 {large} {sweep} 50 45"));
        let Shape::Conic(arc) = &shapes(&found)[0] else {
            panic!()
        };
        assert_near(at(arc, arc.from), point(40., 50.));
        assert_near(at(arc, arc.to), point(50., 55.));
        assert_eq!(arc.to - arc.from > 0.5 * TAU, large == 1);
        // y goes up in the result, so the positive angle of SVG runs clockwise.
        assert_eq!(arc.x.cross(arc.y).z < 0.0, sweep == 1);
        assert!((arc.x.length() - 20.).abs() < 1e-12 && (arc.y.length() - 10.).abs() < 1e-12);
    }
}

#[test]
fn small_radii_grow_and_zero_radii_are_lines() {
    let found = path("M0 0A1 1 0 0 1 20 0A0 5 0 0 1 30 0A5 5 0 0 1 30 0");
    let Shape::Conic(arc) = &shapes(&found)[0] else {
        panic!()
    };
    assert_near(arc.centre, point(10., 100.));
    assert_eq!(arc.x.length(), 10.);
    assert_eq!(shapes(&found)[1], chain(&[(20., 100.), (30., 100.)], false));
    assert_eq!(shapes(&found).len(), 2);
}

#[test]
fn the_parts_of_one_circle_are_joined() {
    let found = path("M20 10A10 10 0 0 1 10 20A10 10 0 0 1 0 10A10 10 0 1 1 20 10Z");
    let shapes = shapes(&found);
    let [Shape::Conic(circle)] = shapes.as_slice() else {
        panic!("{shapes:?}")
    };
    assert_near(circle.centre, point(10., 90.));
    assert_eq!(circle.to, circle.from + TAU);
}

#[test]
fn a_damaged_path_is_read_up_to_the_damage() {
    let found = page("<path id='p' d='M0 0L10 0 20 x'/>\n<path d='L1 1'/>");
    assert_eq!(shapes(&found), [chain(&[(0., 100.), (10., 100.)], false)]);
    assert!(
        found.remarks[0].starts_with("line 2: <path> “p”: its data is damaged"),
        "{:?}",
        found.remarks
    );
    assert!(
        found.remarks[1].starts_with("line 3: <path>"),
        "{:?}",
        found.remarks
    );
}

#[test]
fn single_points_are_counted_in_a_remark() {
    let found = path("M0 0M1 1M2 2h1");
    assert_eq!(found.items.len(), 1);
    assert!(found.remarks[0].starts_with("line 2: 2 subpaths of one point are skipped"));
}

#[test]
fn basic_shapes() {
    let found = page(
        "<rect x='1' y='2' width='10%' height='4'/><circle cx='5' cy='6' r='2'/>\
         <ellipse cx='5' cy='6' rx='2' ry='3'/>\
         <line x1='1' y1='2' x2='3cm' y2='1mm'/><polyline points='0,0 1,0 1,1'/>\
         <polygon points='0 0 1 0 1 1'/>",
    );
    let shapes = shapes(&found);
    assert_eq!(
        shapes[0],
        chain(&[(1., 98.), (11., 98.), (11., 94.), (1., 94.)], true)
    );
    let circle = |rx, ry: f64| Conic {
        centre: point(5., 94.),
        x: point(rx, 0.),
        y: point(0., -ry),
        from: 0.0,
        to: TAU,
    };
    assert_eq!(shapes[1], Shape::Conic(circle(2., 2.)));
    assert_eq!(shapes[2], Shape::Conic(circle(2., 3.)));
    let Shape::Polyline { points, .. } = &shapes[3] else {
        panic!()
    };
    // Units within the drawing are those of CSS: 96 pixels an inch.
    assert_near(points[1], point(30. * 96. / 25.4, 100. - 96. / 25.4));
    assert_eq!(
        shapes[4],
        chain(&[(0., 100.), (1., 100.), (1., 99.)], false)
    );
    assert_eq!(shapes[5], chain(&[(0., 100.), (1., 100.), (1., 99.)], true));
    assert!(found.items.iter().all(|it| it.kind == Kind::Path));
}

#[test]
fn rounded_rectangles() {
    let found = page("<rect width='10' height='20' rx='2'/><rect width='10' height='10' rx='9'/>");
    let first = &found.items[0].shapes;
    assert_eq!(first.len(), 8);
    assert_eq!(first[0], chain(&[(2., 100.), (8., 100.)], false));
    let Shape::Conic(corner) = &first[1] else {
        panic!()
    };
    assert_near(at(corner, corner.from), point(8., 100.));
    assert_near(at(corner, corner.to), point(10., 98.));
    let [Shape::Conic(circle)] = found.items[1].shapes.as_slice() else {
        panic!()
    };
    assert_eq!(
        (circle.centre, circle.to - circle.from),
        (point(5., 95.), TAU)
    );
}

#[test]
fn shapes_without_extent_are_skipped_with_a_remark() {
    let found = page(
        "<rect width='0' height='1'/>\n<circle r='-1'/>\n<polyline points='1 1'/>\n\
         <polygon points='0 0 1 1 2'/>",
    );
    assert_eq!(found.items.len(), 1);
    let lines: Vec<_> = found.remarks.iter().map(|it| &it[..7]).collect();
    assert_eq!(lines, ["line 2:", "line 3:", "line 4:", "line 5:"]);
}
