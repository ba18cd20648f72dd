//! Lines, points, circles, ellipses, their layers, colours and spaces.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::{assert_near, at, conic, drawing, entities, file, items, remark, section, shapes};
use crate::io::exchange::drawing::{Kind, Shape, Space};

const CIRCLE: &str = "0 CIRCLE; 8 0; 10 1; 20 2; 30 3; 40 5;";

#[test]
fn a_line_keeps_its_ends() {
    let points = vec![DVec3::new(0.1, 0.2, 0.3), DVec3::new(1e-300, -4.0, 0.0)];
    let text = "0 LINE; 8 0; 10 0.1; 20 0.2; 30 0.3; 11 1e-300; 21 -4";
    assert_eq!(
        shapes(text),
        [Shape::Polyline {
            points,
            closed: false
        }]
    );
}

#[test]
fn what_has_no_z_lies_at_the_elevation() {
    let text = "0 POINT; 10 1; 20 2; 38 7";
    assert_eq!(shapes(text), [Shape::Point(DVec3::new(1.0, 2.0, 7.0))]);
    assert_eq!(items(text)[0].kind, Kind::Point);
}

#[test]
fn circles_and_arcs_turn_around_their_extrusion() {
    let circle = conic(CIRCLE);
    assert_eq!((circle.from, circle.to), (0.0, TAU));
    assert_near(at(&circle, FRAC_PI_2), 1.0, 7.0, 3.0);
    let arc = conic("0 ARC; 10 0; 20 0; 30 0; 40 2; 50 350; 51 80");
    assert!((arc.to - arc.from - FRAC_PI_2).abs() < 1e-15);
    // Mirrored: x points the other way.
    let arc = conic("0 ARC; 10 3; 20 1; 30 0; 40 2; 50 0; 51 90; 210 0; 220 0; 230 -1");
    assert_near(at(&arc, arc.from), -5.0, 1.0, 0.0);
    assert_near(at(&arc, arc.to), -3.0, 3.0, 0.0);
    // The system of an extrusion along x has y as x and z as y.
    let circle = conic(&format!("{CIRCLE} 210 7; 220 0; 230 0"));
    assert_near(circle.centre, 3.0, 1.0, 2.0);
    assert_near(at(&circle, 0.0), 3.0, 6.0, 2.0);
}

#[test]
fn an_extrusion_near_z_takes_y_as_its_first_axis() {
    let circle = conic(&format!("{CIRCLE} 210 0.01; 220 0; 230 1"));
    let length = 1.0001_f64.sqrt();
    assert_near(circle.x, 5.0 / length, 0.0, -0.05 / length);
    assert_near(circle.y, 0.0, 5.0, 0.0);
}

#[test]
fn arcs_without_an_angle_are_whole_turns() {
    let arc = conic("0 ARC; 10 0; 20 0; 40 1; 50 30; 51 30");
    assert_eq!(arc.to - arc.from, TAU);
    let arc = conic("0 ARC; 10 0; 20 0; 40 1; 50 0; 51 359.9999999999");
    assert_eq!(arc.to - arc.from, TAU);
}

#[test]
fn ellipses_lie_in_world_coordinates() {
    let text = "0 ELLIPSE; 10 1; 20 1; 30 1; 11 0; 21 4; 31 0; 210 0; 220 0; 230 -1; 40 0.5;";
    let ellipse = conic(text);
    assert_near(at(&ellipse, 0.0), 1.0, 5.0, 1.0);
    assert_near(at(&ellipse, FRAC_PI_2), 3.0, 1.0, 1.0);
    assert_eq!((ellipse.from, ellipse.to), (0.0, TAU));
    let ellipse = conic(&format!("{text} 41 0; 42 6.28318530718"));
    assert_eq!(ellipse.to, TAU);
    let ellipse = conic(&format!(
        "{text} 41 3.141592653589793; 42 1.5707963267948966"
    ));
    assert_eq!((ellipse.from, ellipse.to), (PI, PI + 1.5 * PI));
    assert_eq!(items(&format!("{text} 41 0; 42 1"))[0].kind, Kind::Ellipse);
}

#[test]
fn layers_give_their_names_and_colours() {
    let layers = "0 TABLE; 2 LAYER; 0 LAYER; 2 Walls; 70 0; 62 1; 0 LAYER; 2 far; 70 1; 62 -31;
        0 LAYER; 2 exact; 62 7; 420 66051; 0 ENDTAB";
    let lines = [
        "8 WALLS",
        "8 far; 62 256",
        "8 exact",
        "8 far; 62 5",
        "8 none",
        "8 far; 420 255",
        "62 7",
    ];
    let lines = lines
        .map(|line| format!("0 POINT; 10 0; 20 0; {line};"))
        .concat();
    let drawing = drawing(&file(&[
        section("TABLES", layers),
        section("ENTITIES", &lines),
    ]));
    let found: Vec<_> = drawing
        .items
        .iter()
        .map(|item| (item.group.join("/"), item.colour))
        .collect();
    let expected = [
        ("Walls", Some([255, 0, 0])),
        ("far", Some([255, 191, 127])),
        ("exact", Some([1, 2, 3])),
        ("far", Some([0, 0, 255])),
        ("none", None),
        ("far", Some([0, 0, 255])),
        ("0", None),
    ];
    assert_eq!(
        found,
        expected.map(|(name, colour)| (name.to_owned(), colour))
    );
    for item in &drawing.items {
        assert_eq!(item.hidden, item.group[..] == ["far"]);
    }
    assert_eq!(
        drawing.remarks,
        ["layers that are off or frozen, their curves are hidden: far"]
    );
}

#[test]
fn what_is_marked_as_invisible_is_hidden() {
    let found = drawing(&entities(
        "0 POINT; 10 1; 20 2; 0 POINT; 10 1; 20 2; 60 1; 0 TEXT; 60 1; 0 POINT; 10 3; 20 2; 60 1",
    ));
    let hidden: Vec<bool> = found.items.iter().map(|item| item.hidden).collect();
    assert_eq!(hidden, [false, true, true]);
    assert_eq!(
        found.remarks,
        ["line 12: 2 entities are marked as invisible, they are hidden"]
    );
}

#[test]
fn a_frozen_layer_or_a_mark_of_an_insert_hides_all_in_its_block_and_a_layer_that_is_off_its_own() {
    let layers = "0 TABLE; 2 LAYER; 0 LAYER; 2 frozen; 70 1; 62 7; 0 LAYER; 2 off; 62 -7; \
                  0 LAYER; 2 plain; 62 7; 0 ENDTAB";
    // A block with a point on its own layer and one on that of the insert, alone and within another block.
    let blocks = "0 BLOCK; 2 a; 10 0; 20 0; 0 POINT; 8 plain; 10 2; 20 0; 0 POINT; 8 0; 10 2; 20 0; 0 ENDBLK; \
                  0 BLOCK; 2 outer; 10 0; 20 0; 0 INSERT; 8 plain; 2 a; 10 0; 20 0; 0 ENDBLK";
    let hidden_by = |insert: &str| {
        let found = drawing(&file(&[
            section("TABLES", layers),
            section("BLOCKS", blocks),
            section("ENTITIES", &format!("0 INSERT; 10 0; 20 0; {insert}")),
        ]));
        let hidden: Vec<bool> = found.items.iter().map(|item| item.hidden).collect();
        (hidden, found.remarks.join("; "))
    };
    let layers = "layers that are off or frozen, their curves are hidden";
    let marked = "2 entities are marked as invisible, they are hidden";
    for name in ["a", "outer"] {
        let told = (vec![true; 2], format!("{layers}: frozen"));
        assert_eq!(hidden_by(&format!("2 {name}; 8 frozen")), told);
        let (hidden, told) = hidden_by(&format!("2 {name}; 8 plain; 60 1"));
        assert!(hidden == [true; 2] && told.ends_with(marked), "{told}");
        let plain = hidden_by(&format!("2 {name}; 8 plain"));
        assert_eq!(plain, (vec![false; 2], String::new()));
    }
    assert_eq!(
        hidden_by("2 a; 8 off"),
        (vec![false, true], format!("{layers}: off"))
    );
    assert_eq!(hidden_by("2 outer; 8 off"), (vec![false; 2], String::new()));
}

#[test]
fn paper_space_is_told_by_mark_and_by_block() {
    let blocks = "0 BLOCK; 2 *Paper_Space0; 10 0; 20 0; 0 POINT; 10 2; 20 0; 0 ENDBLK";
    let points = "0 POINT; 10 0; 20 0; 0 POINT; 67 1; 10 1; 20 0";
    let drawing = drawing(&file(&[
        section("BLOCKS", blocks),
        section("ENTITIES", points),
    ]));
    let spaces: Vec<_> = drawing.items.iter().map(|item| item.space).collect();
    assert_eq!(spaces, [Space::Model, Space::Paper, Space::Paper]);
    assert!(drawing.items.iter().all(|item| item.block.is_none()));
}

#[test]
fn what_is_no_curve_is_counted_with_its_first_line() {
    let drawing = drawing(&entities("0 TEXT; 1 a; 0 HATCH; 10 0; 0 TEXT; 1 b"));
    let found: Vec<_> = drawing
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count, it.at))
        .collect();
    assert_eq!(found, [("TEXT", 2, 6), ("HATCH", 1, 10)]);
}

#[test]
fn what_applications_store_is_no_part_of_an_entity() {
    let text =
        "0 LINE; 102 {MINE; 10 9; 20 9; 102 }; 10 1; 20 2; 11 3; 21 4; 1010 7; 101 Embedded; 10 5";
    let points = vec![DVec3::new(1.0, 2.0, 0.0), DVec3::new(3.0, 4.0, 0.0)];
    assert_eq!(
        shapes(text),
        [Shape::Polyline {
            points,
            closed: false
        }]
    );
}

#[test]
fn entities_that_make_no_curve_are_skipped_by_name_and_line() {
    let cases = [
        (
            "0 LINE; 10 1; 20 2; 11 3",
            "line 6: LINE skipped: group 21 is missing",
        ),
        (
            "0 LINE; 10 x; 20 2",
            "line 8: LINE skipped: group 10 holds \"x\", no finite number",
        ),
        (
            "0 POINT; 10 1e999; 20 2",
            "line 8: POINT skipped: group 10 holds \"1e999\", no finite number",
        ),
        (
            "0 CIRCLE; 10 1; 20 2; 40 0",
            "line 6: CIRCLE skipped: radius 0 is not above 0",
        ),
        (
            "0 CIRCLE; 10 1; 20 2; 40 1; 210 0; 220 0; 230 0",
            "line 6: CIRCLE skipped: its extrusion has no length",
        ),
        (
            "0 ELLIPSE; 10 1; 20 2; 11 1; 21 0; 40 0",
            "line 6: ELLIPSE skipped: an axis has no length",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(remark(text), expected);
    }
}
