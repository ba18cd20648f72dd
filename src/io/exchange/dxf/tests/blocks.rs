//! Blocks and INSERT.

use glam::DVec3;

use super::{assert_near, drawing, file, section};
use crate::io::exchange::drawing::{Drawing, Shape, Space};

/// A drawing with blocks, each a name and its entities, and with entities.
fn inserted(blocks: &[(&str, &str)], entities: &str) -> Drawing {
    let block = |(name, text): &(&str, &str)| format!("0 BLOCK; 2 {name}; {text}; 0 ENDBLK;");
    let blocks: String = blocks.iter().map(block).collect();
    drawing(&file(&[
        section("BLOCKS", &blocks),
        section("ENTITIES", entities),
    ]))
}

fn points(drawing: &Drawing) -> Vec<DVec3> {
    let shapes = drawing.items.iter().flat_map(|item| &item.shapes);
    let point = |shape: &Shape| match shape {
        Shape::Point(point) => *point,
        other => panic!("{other:?} is no point"),
    };
    shapes.map(point).collect()
}

const POINT: &str = "10 1; 20 1; 30 0; 0 POINT; 8 0; 10 3; 20 2; 30 5";

#[test]
fn an_insert_moves_turns_and_scales_around_its_base() {
    let drawing = inserted(
        &[("a", POINT)],
        "0 INSERT; 2 A; 10 10; 20 20; 30 1; 41 2; 42 3; 43 4; 50 90",
    );
    assert_near(points(&drawing)[0], 10.0 - 3.0, 20.0 + 4.0, 21.0);
    assert_eq!(drawing.items[0].block.as_deref(), Some("a"));
    assert_eq!(drawing.remarks, [""; 0]);
}

#[test]
fn rows_and_columns_turn_with_the_insert_but_keep_its_scale_out() {
    let array = "70 2; 71 2; 44 10; 45 100; 50 90; 41 7; 42 7";
    let drawing = inserted(
        &[("a", "0 POINT; 10 0; 20 0")],
        &format!("0 INSERT; 2 a; 10 0; 20 0; {array}"),
    );
    let expected = [(0.0, 0.0), (0.0, 10.0), (-100.0, 0.0), (-100.0, 10.0)];
    for (point, (x, y)) in points(&drawing).into_iter().zip(expected) {
        assert_near(point, x, y, 0.0);
    }
    assert_eq!(drawing.items.len(), 4);
}

#[test]
fn an_extrusion_mirrors_an_insert_with_its_array() {
    let insert = "0 INSERT; 2 a; 10 10; 20 20; 30 1; 210 0; 220 0; 230 -1; 50 90; 70 2; 44 1";
    let drawing = inserted(&[("a", POINT)], insert);
    assert_near(points(&drawing)[0], -(10.0 - 1.0), 20.0 + 2.0, -6.0);
    assert_near(points(&drawing)[1], -(10.0 - 1.0), 20.0 + 3.0, -6.0);
}

#[test]
fn nested_inserts_multiply_and_name_the_inner_block() {
    let outer = "0 INSERT; 2 inner; 10 1; 20 0; 41 2; 42 2; 43 2";
    let blocks = [("outer", outer), ("inner", "0 POINT; 10 1; 20 0")];
    let drawing = inserted(&blocks, "0 INSERT; 2 outer; 10 0; 20 5; 50 90; 67 1");
    assert_near(points(&drawing)[0], 0.0, 8.0, 0.0);
    assert_eq!(drawing.items[0].block.as_deref(), Some("inner"));
    assert_eq!(drawing.items[0].space, Space::Paper);
}

#[test]
fn layer_0_and_the_colour_of_the_block_come_from_the_insert() {
    let layers = "0 LAYER; 2 red; 62 1; 0 LAYER; 2 blue; 62 5";
    let points = ["8 0", "8 0; 62 0", "8 blue", "8 blue; 62 0", "8 0; 62 3"];
    let points = points
        .map(|point| format!("0 POINT; 10 0; 20 0; {point};"))
        .concat();
    let blocks = format!(
        "0 BLOCK; 2 in; {points} 0 ENDBLK; 0 BLOCK; 2 out; 0 INSERT; 8 0; 2 in; 10 0; 20 0; 0 ENDBLK"
    );
    let insert = "0 INSERT; 8 red; 62 2; 2 out; 10 0; 20 0";
    let sections = [
        section("TABLES", layers),
        section("BLOCKS", &blocks),
        section("ENTITIES", insert),
    ];
    let drawing = drawing(&file(&sections));
    let found: Vec<_> = drawing
        .items
        .iter()
        .map(|it| (it.group[0].as_str(), it.colour))
        .collect();
    let (red, blue) = ([255, 0, 0], [0, 0, 255]);
    let expected = [
        ("red", red),
        ("red", red),
        ("blue", blue),
        ("blue", red),
        ("red", [0, 255, 0]),
    ];
    assert_eq!(found, expected.map(|(layer, colour)| (layer, Some(colour))));
}

#[test]
fn circles_in_skewed_blocks_stay_exact() {
    let drawing = inserted(
        &[("a", "0 CIRCLE; 10 0; 20 0; 40 1")],
        "0 INSERT; 2 a; 10 0; 20 0; 41 3; 42 -2",
    );
    let [Shape::Conic(conic)] = drawing.items[0].shapes.as_slice() else {
        panic!("{:?}", drawing.items);
    };
    assert_eq!((conic.x, conic.y), (DVec3::X * 3.0, DVec3::Y * -2.0));
}

#[test]
fn attributes_and_other_entities_of_blocks_are_counted() {
    let block = "0 TEXT; 1 a; 0 POINT; 10 0; 20 0";
    let insert = "0 INSERT; 66 1; 2 a; 10 0; 20 0; 70 3; 0 ATTRIB; 1 x; 0 SEQEND";
    let drawing = inserted(&[("a", block)], insert);
    let found: Vec<_> = drawing
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count))
        .collect();
    assert_eq!(found, [("TEXT", 3), ("ATTRIB", 1)]);
}

#[test]
fn missing_and_external_blocks_are_remarked_on() {
    let drawing = inserted(
        &[("far", "70 4; 1 other.dwg")],
        "0 INSERT; 2 far; 10 0; 20 0; 0 INSERT; 2 gone; 10 0; 20 0; 0 INSERT; 2 far; 41 0",
    );
    let expected = [
        "line 22: INSERT skipped: block far stands in another file",
        "line 30: INSERT skipped: block gone is not in the file",
        "line 38: INSERT skipped: block far stands in another file",
    ];
    assert_eq!(drawing.remarks, expected);
    assert_eq!(drawing.other[0].count, 3);
}

#[test]
fn blocks_that_hold_themselves_end() {
    let a = "0 POINT; 10 1; 20 1; 0 INSERT; 2 b; 10 0; 20 0; 0 INSERT; 2 b; 10 0; 20 0";
    let blocks = [("a", a), ("b", "0 INSERT; 2 a; 10 0; 20 0")];
    let drawing = inserted(&blocks, "0 INSERT; 2 a; 10 0; 20 0");
    assert_eq!(drawing.items.len(), 1);
    assert_eq!(
        drawing.remarks,
        ["line 38: INSERT skipped: the block holds itself"]
    );
}

#[test]
fn nesting_ends_at_64() {
    let blocks: Vec<_> = (0..70)
        .map(|number| {
            let insert = format!(
                "0 POINT; 10 0; 20 0; 0 INSERT; 2 b{}; 10 0; 20 0",
                number + 1
            );
            (format!("b{number}"), insert)
        })
        .collect();
    let blocks: Vec<_> = blocks
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    let drawing = inserted(&blocks, "0 INSERT; 2 b0; 10 0; 20 0");
    assert_eq!(drawing.items.len(), 64);
    assert!(drawing.remarks[0].ends_with("blocks are nested more than 64 deep"));
    assert_eq!(drawing.remarks.len(), 1);
}

#[test]
fn chains_that_multiply_are_cut_off() {
    let blocks: Vec<_> = (0..20)
        .map(|number| {
            let insert = format!(
                "0 INSERT; 2 b{}; 10 0; 20 0; 70 32767; 71 32767",
                number + 1
            );
            (format!("b{number}"), insert)
        })
        .collect();
    let mut blocks: Vec<_> = blocks
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    blocks.push(("b20", "0 POINT; 10 0; 20 0"));
    let drawing = inserted(&blocks, "0 INSERT; 2 b0; 10 0; 20 0; 0 POINT; 10 0; 20 0");
    assert!(
        drawing.remarks[0].contains("INSERT cut off"),
        "{:?}",
        drawing.remarks
    );
    assert_eq!(drawing.remarks.len(), 1);
    assert!(
        drawing
            .items
            .last()
            .is_some_and(|item| item.block.is_none())
    );
}

#[test]
fn a_scale_of_0_is_refused() {
    let drawing = inserted(&[("a", POINT)], "0 INSERT; 2 a; 10 0; 20 0; 41 0");
    assert!(
        drawing.remarks[0].ends_with("INSERT skipped: its scale is 0"),
        "{:?}",
        drawing.remarks
    );
}
