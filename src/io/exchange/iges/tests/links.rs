use glam::DVec3;

use super::*;
use crate::io::exchange::drawing::{Kind, Space};

const LINE: &str = "0.,0.,0.,1.,0.,0.";

/// A quarter turn about z, and a move.
const TURN: &str = "0.,-1.,0.,10.,1.,0.,0.,20.,0.,0.,1.,30.";
const MOVE: &str = "1.,0.,0.,1.,0.,1.,0.,2.,0.,0.,1.,3.";

#[test]
fn delimiters_and_units_come_from_the_global_section() {
    for (flag, name, unit) in [
        ("1", "4HINCH", Some(25.4)),
        ("2", "2HMM", Some(1.0)),
        ("3", "2HYD", Some(914.4)),
        ("4", "2HFT", Some(304.8)),
        ("5", "2HMI", Some(1_609_344.0)),
        ("6", "1HM", Some(1000.0)),
        ("7", "2HKM", Some(1.0e6)),
        ("8", "3HMIL", Some(0.0254)),
        ("9", "2HUM", Some(0.001)),
        ("10", "2HCM", Some(10.0)),
        ("11", "3HUIN", Some(2.54e-5)),
        ("", "2HCM", Some(10.0)),
        ("", "", None),
        ("3", "3Hell", None),
    ] {
        let global = format!("1H/:1H#:3Ha:#::::::::::1.:{flag}:{name}#").replace(':', "/");
        let text = file_with(&global, &[given(110, LINE)]).replace("110,", "110/");
        let text = text.replace("0.,0.,0.,1.,0.,0.;", "0./0./0./1./0./0.#");
        let drawing = read(text.as_bytes()).unwrap();
        assert_eq!(
            (drawing.unit, drawing.items.len()),
            (unit, 1),
            "{flag} {name} {:?}",
            drawing.remarks
        );
        assert_eq!(drawing.remarks.is_empty(), unit.is_some());
    }
}

#[test]
fn default_delimiters_may_be_left_out() {
    // A semicolon inside a text ends nothing.
    let drawing =
        read(file_with(",,3Ha,;,1Hb,1Hc,,,,,,,,1.,6,1HM;", &[given(110, LINE)]).as_bytes());
    assert_eq!(drawing.unwrap().unit, Some(1000.0));
}

#[test]
fn differing_unit_flag_and_name_have_a_remark() {
    let global = ",,1Ha,1Ha,1Hb,1Hc,,,,,,,1.,2,4HINCH;";
    let drawing = read(file_with(global, &[given(110, LINE)]).as_bytes()).unwrap();
    assert_eq!(drawing.unit, Some(1.0));
    assert!(has_remark(
        &drawing,
        "unit flag 2 and unit name INCH differ"
    ));
}

#[test]
fn nested_transformations_apply_from_the_inside() {
    let drawing = drawing(&[
        Given {
            matrix: 3,
            ..given(110, LINE)
        },
        Given {
            matrix: 5,
            ..given(124, MOVE)
        },
        given(124, TURN),
    ]);
    // (1, 0, 0) moved to (2, 2, 3), turned to (−2, 2, 3), moved.
    let end = point_at(only_shape(&drawing), 1.0);
    assert_eq!(end, DVec3::new(8.0, 22.0, 33.0));
}

#[test]
fn circular_transformations_are_refused() {
    let drawing = drawing(&[
        Given {
            matrix: 3,
            ..given(110, LINE)
        },
        Given {
            matrix: 3,
            ..given(124, MOVE)
        },
        Given {
            matrix: 99,
            ..given(110, LINE)
        },
    ]);
    assert!(drawing.items.is_empty());
    assert!(has_remark(&drawing, "in a circle"));
    assert!(has_remark(&drawing, "transformation D99 cannot be read"));
}

#[test]
fn status_digits_give_space_and_remarks() {
    let line = |status| Given {
        status,
        ..given(110, LINE)
    };
    let drawing = drawing(&[
        line("00000000"),
        line("00010000"),
        line("00020000"),
        line("00000500"),
        line("00000600"),
        line("01000000"),
    ]);
    let spaces: Vec<Space> = drawing.items.iter().map(|item| item.space).collect();
    use Space::{Edge, Model};
    // A curve in the parameter plane of a surface is none in space.
    assert_eq!(spaces, [Model, Edge, Edge, Edge, Model]);
    let hidden: Vec<bool> = drawing.items.iter().map(|item| item.hidden).collect();
    assert_eq!(hidden, [false, false, false, false, true]);
    assert!(has_remark(&drawing, "1 item is hidden (blank status 01)"));
    assert!(has_remark(
        &drawing,
        "1 curve lies in the parameter plane of a surface (use flag 05)"
    ));
}

#[test]
fn composite_curve_is_one_item_with_its_pieces_in_order() {
    let drawing = drawing(&[
        Given {
            status: "00010000",
            ..given(110, "9.,0.,0.,1.,0.,0.")
        },
        Given {
            status: "00010000",
            matrix: 9,
            ..given(110, LINE)
        },
        given(102, "2,3,7"),
        Given {
            status: "00010000",
            ..given(102, "1,1")
        },
        given(124, MOVE),
        given(102, "2,13,99"),
        Given {
            status: "00010000",
            ..given(130, "1")
        },
    ]);
    assert_eq!(drawing.items.len(), 1);
    let item = &drawing.items[0];
    assert_eq!(
        (item.kind, item.space, item.shapes.len()),
        (Kind::Polycurve, Space::Model, 2)
    );
    assert_eq!(point_at(&item.shapes[0], 0.0), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(point_at(&item.shapes[1], 0.0), DVec3::X * 9.0);
    assert!(has_remark(
        &drawing,
        "its curve D13: 130 offset curve is not read; skipped"
    ));
    assert!(has_remark(&drawing, "its curve D99: entry D99 is missing"));
    assert!(has_remark(&drawing, "none of its curves can be read"));
}

#[test]
fn composite_curves_in_a_circle_have_a_remark() {
    let drawing = drawing(&[given(102, "1,3"), given(102, "1,1"), given(102, "1,5")]);
    assert!(drawing.items.is_empty());
    assert_eq!(
        drawing
            .remarks
            .iter()
            .filter(|it| it.contains("a part of itself"))
            .count(),
        3
    );
}

#[test]
fn subfigure_is_inserted_with_scale_and_placement() {
    let drawing = drawing(&[
        Given {
            status: "00010200",
            ..given(110, LINE)
        },
        Given {
            status: "00000200",
            ..given(308, "0,4Hbolt,1,1")
        },
        Given {
            matrix: 7,
            level: 4,
            ..given(408, "3,10.,20.,30.,2.")
        },
        given(124, TURN),
        given(408, "3,0.,0.,0."),
        Given {
            status: "00000200",
            ..given(308, "0,6Hunused,1,1")
        },
    ]);
    assert_eq!(drawing.items.len(), 2);
    let item = &drawing.items[0];
    assert_eq!(
        (item.block.as_deref(), item.space),
        (Some("bolt"), Space::Model)
    );
    assert_eq!(item.group[..], ["4"]);
    assert_eq!(point_at(&item.shapes[0], 1.0), DVec3::new(20.0, 42.0, 60.0));
    assert_eq!(point_at(&drawing.items[1].shapes[0], 1.0), DVec3::X);
    assert!(has_remark(
        &drawing,
        "subfigure \"unused\" is never inserted"
    ));
}

#[test]
fn subfigures_nest_but_not_in_themselves() {
    let drawing = drawing(&[
        given(110, LINE),
        given(308, "0,5Hinner,1,1"),
        given(408, "3,1.,0.,0.,1."),
        given(308, "1,5Houter,3,5,5,9"),
        given(408, "7,0.,1.,0.,1."),
        given(408, "7,0.,1.,0.,1."),
    ]);
    assert_eq!(drawing.items.len(), 2);
    assert_eq!(
        point_at(&drawing.items[0].shapes[0], 0.0),
        DVec3::new(1.0, 1.0, 0.0)
    );
    assert_eq!(drawing.items[0].block.as_deref(), Some("outer"));
    assert!(has_remark(&drawing, "it is a part of itself"));
}

#[test]
fn names_colours_levels_and_groups_are_found() {
    let drawing = drawing(&[
        Given {
            level: 2,
            colour: 2,
            ..given(110, "0.,0.,0.,1.,0.,0.,0,1,3")
        },
        Given {
            form: 15,
            ..given(406, "1,7Hby; nam")
        },
        Given {
            level: 2,
            form: 3,
            ..given(406, "2,0,9Houter/sub")
        },
        Given {
            colour: -9,
            label: "LABEL",
            level: 5,
            ..given(110, LINE)
        },
        given(314, "100.,50.,0.,6Horange"),
        Given {
            status: "00020000",
            ..given(110, LINE)
        },
        Given {
            form: 7,
            ..given(402, "1,11,0,1,15")
        },
        Given {
            form: 15,
            ..given(406, "1,5Hgroup")
        },
    ]);
    let items = &drawing.items;
    assert_eq!(items[0].name.as_deref(), Some("by; nam"));
    assert_eq!(
        (items[0].group.join("|"), items[0].colour),
        ("outer|sub".to_owned(), Some([255, 0, 0]))
    );
    assert_eq!(
        (items[1].name.as_deref(), items[1].colour),
        (Some("LABEL"), Some([255, 127, 0]))
    );
    assert_eq!(
        (items[1].group.join("|"), items[2].group.join("|")),
        ("5".to_owned(), "group".to_owned())
    );
    // Depends on a group alone.
    assert_eq!(items[2].space, Space::Model);
}

#[test]
fn other_entities_are_counted() {
    let drawing = drawing(&[
        given(128, "1"),
        given(128, "1"),
        given(999, "1"),
        given(0, ""),
    ]);
    let other: Vec<_> = drawing
        .other
        .iter()
        .map(|it| (it.kind.as_str(), it.count, it.at))
        .collect();
    assert_eq!(
        other,
        [
            ("128 B-spline surface", 2, 4),
            ("unknown entity type", 1, 8)
        ]
    );
}
