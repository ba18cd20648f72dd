mod damage;
mod files;
mod writing;

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{classes, knots, read};
use crate::io::exchange::drawing::{Conic, Drawing, Item, Kind, Nurbs, Shape, Space};
use files::{Attributes, Tables, arc, line, nurbs, start};

const VERSIONS: [u32; 8] = [2, 3, 4, 5, 50, 60, 70, 80];
const IDENTITY: [f64; 16] = [
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
];

fn on_layer(layer: i32, name: &'static str) -> Attributes {
    Attributes {
        layer,
        name,
        ..Attributes::default()
    }
}

fn sound(tables: Tables) -> Drawing {
    let drawing = read(&tables.finish()).unwrap();
    assert_eq!(drawing.remarks, [""; 0]);
    drawing
}

fn one(class: u128, data: impl Fn(&Tables) -> files::File) -> Item {
    let mut tables = start(4);
    tables.record(class, data(&tables), &Attributes::default());
    let mut drawing = sound(tables);
    assert_eq!(drawing.items.len(), 1);
    drawing.items.remove(0)
}

/// A file with each curve, layers within each other, and a hidden and a coloured object.
fn sample(version: u32) -> Tables {
    let mut tables = start(version);
    tables.unit = 8;
    tables.layers =
        tables
            .part()
            .layer(5, "Außen", [1, 2, 3, 0], -1)
            .layer(7, "innen", [4, 5, 6, 0], 5);
    let part = tables.part();
    let points = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let curve = nurbs(part.clone(), 3, &[0.0, 0.0, 1.0, 1.0], &points, false);
    tables.record(classes::NURBS_CURVE, curve, &on_layer(7, "Kurve"));
    let own = Attributes {
        colour: [9, 8, 7, 0],
        source: 1,
        ..on_layer(5, "")
    };
    tables.record(
        classes::LINE_CURVE,
        line(part.clone(), DVec3::ZERO, DVec3::X),
        &own,
    );
    let hidden = Attributes {
        mode: 1,
        ..on_layer(5, "")
    };
    tables.record(classes::ARC_CURVE, arc(part.clone(), 0.0, TAU), &hidden);
    let paper = Attributes {
        paper: true,
        ..on_layer(5, "")
    };
    let point = part.clone().bytes(&[0x10]).numbers(&[1.0, 2.0, 3.0]);
    tables.record(classes::POINT, point, &paper);
    tables.record(0x4ED7D4E4_E947_11D3_BFE5_0010830122F0, part.clone(), &own);
    tables.record(0x12345678_0000_0000_0000_000000000001, part, &own);
    tables
}

#[test]
fn reads_all_versions() {
    for version in VERSIONS {
        let drawing = read(&sample(version).finish()).unwrap();
        assert_eq!(drawing.unit, Some(25.4), "version {version}");
        assert_eq!(drawing.remarks, ["1 item is hidden"]);
        let hidden = drawing.items.iter().filter(|item| item.hidden);
        assert_eq!(hidden.count(), 1, "version {version}");
        let [curve, line, circle, point] = drawing.items.as_slice() else {
            panic!("version {version}: {} items", drawing.items.len());
        };
        assert_eq!(curve.group[..], ["Außen", "innen"]);
        assert_eq!(curve.name.as_deref(), Some("Kurve"));
        assert_eq!(curve.colour, Some([4, 5, 6]));
        assert_eq!(line.group[..], ["Außen"]);
        assert_eq!(line.colour, Some([9, 8, 7]));
        assert_eq!((line.kind, line.name.as_deref()), (Kind::Line, None));
        assert_eq!(circle.kind, Kind::Circle);
        assert_eq!((point.kind, point.space), (Kind::Point, Space::Paper));
        let other: Vec<&str> = drawing.other.iter().map(|it| it.kind.as_str()).collect();
        assert_eq!(
            other,
            ["Mesh", "class 12345678-0000-0000-0000-000000000001"]
        );
    }
}

#[test]
fn refuses_other_files() {
    let reason = |bytes: &[u8]| read(bytes).unwrap_err().reason;
    assert!(reason(b"3D Geometry File Format        1rest").contains("save it as version 2"));
    assert!(reason(b"3D Geometry File Format       17rest").contains("version"));
    assert!(reason(b"3D Geometry File Format         ").contains("version"));
    assert!(reason(b"3D Geometry File Format        4").contains("no tables"));
    assert!(reason(b"ISO-10303-21; HEADER; FILE_DESCRIPTION").contains("not a 3DM file"));
    assert!(reason(b"3D").contains("too short"));
}

#[test]
fn reads_later_versions_with_a_remark() {
    let drawing = read(&sample(90).finish()).unwrap();
    assert_eq!(drawing.items.len(), 4);
    assert_eq!(
        drawing.remarks[0],
        "Version 9 is read as if it were version 8"
    );
}

#[test]
fn divides_rational_points_by_their_weights() {
    let points = [2.0, 0.0, 0.0, 2.0, 3.0, 3.0, 0.0, 0.5, 0.0, 8.0, 0.0, 4.0];
    let expected = [
        DVec3::X,
        DVec3::new(6.0, 6.0, 0.0),
        DVec3::new(0.0, 2.0, 0.0),
    ];
    for sign in [1.0, -1.0] {
        let points = points.map(|it| sign * it);
        let item = one(classes::NURBS_CURVE, |tables| {
            nurbs(tables.part(), 3, &[0.0, 0.0, 1.0, 1.0], &points, true)
        });
        assert_eq!(item.kind, Kind::Spline);
        let [Shape::Nurbs(curve)] = item.shapes.as_slice() else {
            panic!()
        };
        assert_eq!(curve.points, expected);
        assert_eq!(curve.weights, Some(vec![2.0, 0.5, 4.0]));
        assert_eq!(curve.knots, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    }
}

#[test]
fn drops_weights_that_are_alike() {
    let points = [2.0, 0.0, 0.0, 2.0, 4.0, 2.0, 0.0, 2.0];
    let item = one(classes::NURBS_CURVE, |tables| {
        nurbs(tables.part(), 2, &[0.0, 1.0], &points, true)
    });
    let [Shape::Nurbs(curve)] = item.shapes.as_slice() else {
        panic!()
    };
    assert_eq!((curve.degree, &curve.weights), (1, &None));
    assert_eq!(curve.points, [DVec3::X, DVec3::new(2.0, 1.0, 0.0)]);
}

#[test]
fn reads_flat_curves() {
    let item = one(classes::NURBS_CURVE, |tables| {
        let file = tables
            .part()
            .bytes(&[0x11])
            .ints(&[2, 0, 2, 2, 0, 0])
            .numbers(&[0.0; 6]);
        file.counted(&[3.0, 4.0], 1)
            .counted(&[1.0, 2.0, 3.0, 4.0], 2)
            .bytes(&[1])
    });
    let [Shape::Nurbs(curve)] = item.shapes.as_slice() else {
        panic!()
    };
    assert_eq!(
        curve.points,
        [DVec3::new(1.0, 2.0, 0.0), DVec3::new(3.0, 4.0, 0.0)]
    );
    assert_eq!(curve.knots, [3.0, 3.0, 4.0, 4.0]);
}

#[test]
fn completes_knots() {
    let complete = |inner: &[f64], degree, points, periodic| {
        let knots = knots::complete(inner, degree, points, periodic).unwrap();
        (knots[0], *knots.last().unwrap())
    };
    assert_eq!(
        complete(&[1.0, 1.0, 1.0, 3.0, 3.0, 3.0], 3, 4, false),
        (1.0, 3.0)
    );
    assert_eq!(
        complete(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 3, 4, false),
        (0.0, 7.0)
    );
    // One end each.
    assert_eq!(
        complete(&[1.0, 1.0, 1.0, 3.0, 4.0, 5.0], 3, 4, false),
        (1.0, 6.0)
    );
    // The spaces 1 2 3 4 repeat: before the first knot is a space of 4, after the last of 3.
    let uneven = [0.0, 1.0, 3.0, 6.0, 10.0, 11.0, 13.0, 16.0, 20.0];
    assert_eq!(complete(&uneven, 3, 7, true), (-4.0, 21.0));
}

#[test]
fn finds_periodic_curves() {
    let inner: Vec<f64> = (-2..=6).map(f64::from).collect();
    let square = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
    let points: Vec<DVec3> = square.into_iter().cycle().take(7).collect();
    assert!(knots::periodic(&inner, 3, &points, None));
    assert!(!knots::periodic(
        &inner,
        3,
        &points,
        Some(&[1.0, 1.0, 1.0, 1.0, 2.0, 1.0, 1.0])
    ));
    let mut open = points.clone();
    open[6] = DVec3::Z;
    assert!(!knots::periodic(&inner, 3, &open, None));
    let mut clamped = inner.clone();
    clamped[0] = clamped[1];
    assert!(!knots::periodic(&clamped, 3, &points, None));

    let flat: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
    let item = one(classes::NURBS_CURVE, |tables| {
        nurbs(tables.part(), 4, &inner, &flat, false)
    });
    let [
        Shape::Nurbs(Nurbs {
            knots,
            periodic: true,
            ..
        }),
    ] = item.shapes.as_slice()
    else {
        panic!("{item:?}")
    };
    assert_eq!(*knots, (-3..=7).map(f64::from).collect::<Vec<f64>>());
}

#[test]
fn reads_arcs() {
    let conic = |from, to| Conic {
        centre: DVec3::new(1.0, 2.0, 3.0),
        x: DVec3::new(0.0, 2.0, 0.0),
        y: DVec3::new(-2.0, 0.0, 0.0),
        from,
        to,
    };
    let item = one(classes::ARC_CURVE, |tables| arc(tables.part(), 0.5, PI));
    assert_eq!(item.kind, Kind::Arc);
    assert_eq!(item.shapes, [Shape::Conic(conic(0.5, PI))]);
    let item = one(classes::ARC_CURVE, |tables| {
        arc(tables.part(), 0.5, 0.5 + TAU)
    });
    assert_eq!(item.kind, Kind::Circle);
    assert_eq!(item.shapes, [Shape::Conic(conic(0.5, 0.5 + TAU))]);
}

#[test]
fn reads_polylines() {
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    let item = one(classes::POLYLINE_CURVE, |tables| {
        let file = tables.part().bytes(&[0x10]).counted(&corners, 3);
        file.counted(&[0.0, 1.0, 2.0, 3.0], 1).ints(&[3])
    });
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
    assert_eq!(item.kind, Kind::Polyline);
    assert_eq!(
        item.shapes,
        [Shape::Polyline {
            points,
            closed: true
        }]
    );
}

#[test]
fn reads_points_of_clouds() {
    let mut tables = start(50);
    let data = tables
        .part()
        .bytes(&[0x11])
        .counted(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 3);
    let data = data.numbers(&[0.0; 22]).ints(&[0, 0, 0]);
    tables.record(
        0x2488F347_F8FA_11D3_BFEC_0010830122F0,
        data,
        &on_layer(0, "cloud"),
    );
    let drawing = sound(tables);
    assert_eq!(drawing.items.len(), 2);
    assert_eq!(
        drawing.items[1].shapes,
        [Shape::Point(DVec3::new(4.0, 5.0, 6.0))]
    );
    assert_eq!(drawing.items[1].name.as_deref(), Some("cloud"));
}

fn polycurve(tables: &Tables, depth: usize) -> files::File {
    let part = tables.part();
    let head = part
        .clone()
        .bytes(&[0x10])
        .ints(&[2, 0, 0])
        .numbers(&[0.0; 6]);
    let head = head.counted(&[0.0, 1.0, 2.0], 1);
    let inner = if depth == 0 {
        part.clone()
            .object(classes::ARC_CURVE, arc(part.clone(), 0.0, PI))
    } else {
        part.clone()
            .object(classes::POLY_CURVE, polycurve(tables, depth - 1))
    };
    let line = line(part, DVec3::ZERO, DVec3::X);
    head.object(classes::LINE_CURVE, line).bytes(&inner.bytes)
}

#[test]
fn reads_nested_polycurves_in_order() {
    let item = one(classes::POLY_CURVE, |tables| polycurve(tables, 2));
    assert_eq!(item.kind, Kind::Polycurve);
    let is_line = |shape: &Shape| matches!(shape, Shape::Polyline { .. });
    let lines: Vec<bool> = item.shapes.iter().map(is_line).collect();
    assert_eq!(lines, [true, true, true, false]);
}

#[test]
fn refuses_polycurves_nested_too_deep() {
    let mut tables = start(60);
    tables.record(
        classes::POLY_CURVE,
        polycurve(&tables, 70),
        &on_layer(0, "deep"),
    );
    let drawing = read(&tables.finish()).unwrap();
    assert!(drawing.items.is_empty());
    assert!(
        drawing.remarks[0].contains("nested too deep"),
        "{:?}",
        drawing.remarks
    );
    assert!(
        drawing.remarks[0].contains("PolyCurve \"deep\""),
        "{:?}",
        drawing.remarks
    );
}

#[test]
fn reads_edges_of_breps() {
    let mut tables = start(70);
    let part = tables.part();
    let empty = || part.clone().bytes(&[0x10]).ints(&[0]);
    let line = line(part.clone(), DVec3::ZERO, DVec3::X);
    let curves = part
        .clone()
        .bytes(&[0x10])
        .ints(&[2, 0, 1])
        .object(classes::LINE_CURVE, line);
    let edge = |index: i32, curve: i32, to: f64| {
        let file = part.clone().ints(&[index, curve, 0]).numbers(&[0.0, to]);
        file.ints(&[0, 1, 1, 4]).numbers(&[0.0, 0.0, 1.0]).bytes
    };
    let edges = part.clone().bytes(&[0x10]).ints(&[3]);
    let edges = edges
        .bytes(&edge(0, 1, 1.0))
        .bytes(&edge(1, 0, 1.0))
        .bytes(&edge(2, 1, 0.5));
    let data = [empty(), curves, empty(), empty(), edges]
        .into_iter()
        .fold(part.clone().bytes(&[0x33]), |data, chunk| {
            data.chunk(0x4000_8000, chunk)
        });
    tables.record(
        0x60B5DBC5_E660_11D3_BFE4_0010830122F0,
        data,
        &on_layer(0, ""),
    );
    let drawing = read(&tables.finish()).unwrap();
    assert_eq!(drawing.items.len(), 1);
    assert_eq!(
        (drawing.items[0].kind, drawing.items[0].space),
        (Kind::Line, Space::Edge)
    );
    assert_eq!(
        (drawing.other[0].kind.as_str(), drawing.other[0].count),
        ("Brep", 1)
    );
    assert!(drawing.remarks[0].contains("2 of its edges are left out: edge 2: it has no curve"));
}

/// A block of a line and an arc, and a block of a point and the first block.
fn blocks(version: u32) -> Tables {
    let mut tables = start(version);
    tables.layers =
        tables
            .part()
            .layer(0, "Lage", [1, 2, 3, 0], -1)
            .layer(1, "Ort", [4, 5, 6, 0], -1);
    let member = |id, source| Attributes {
        id,
        mode: 3,
        source,
        ..on_layer(0, "Glied")
    };
    let part = tables.part();
    tables.record(
        classes::LINE_CURVE,
        line(part.clone(), DVec3::ZERO, DVec3::X),
        &member(11, 0),
    );
    tables.record(
        classes::ARC_CURVE,
        arc(part.clone(), 0.0, PI),
        &member(12, 3),
    );
    let point = part.clone().bytes(&[0x10]).numbers(&[1.0, 1.0, 1.0]);
    tables.record(classes::POINT, point, &member(13, 0));
    let mut shift = IDENTITY;
    shift[3] = 10.0;
    tables.reference(
        101,
        shift,
        &Attributes {
            mode: 3,
            ..Attributes {
                id: 14,
                ..on_layer(1, "")
            }
        },
    );
    tables.definitions =
        part.definition(101, "innen", &[11, 12])
            .definition(102, "außen", &[13, 14]);
    tables
}

#[test]
fn places_what_blocks_contain() {
    for version in [4, 50, 60, 80] {
        let mut tables = blocks(version);
        // Twice as large, then on by (0, 0, 5).
        let mut rows = IDENTITY.map(|it| 2.0 * it);
        (rows[11], rows[15]) = (5.0, 1.0);
        tables.reference(102, rows, &on_layer(1, "Bezug"));
        tables.reference(101, IDENTITY, &on_layer(1, "Bezug"));
        let drawing = sound(tables);
        let found: Vec<(Kind, &str)> = drawing
            .items
            .iter()
            .map(|it| (it.kind, it.block.as_deref().unwrap()))
            .collect();
        let expected = [
            (Kind::Point, "außen"),
            (Kind::Line, "innen"),
            (Kind::Arc, "innen"),
            (Kind::Line, "innen"),
            (Kind::Arc, "innen"),
        ];
        assert_eq!(found, expected);
        assert_eq!(
            drawing.items[0].shapes,
            [Shape::Point(DVec3::new(2.0, 2.0, 7.0))]
        );
        let points = vec![DVec3::new(20.0, 0.0, 5.0), DVec3::new(22.0, 0.0, 5.0)];
        assert_eq!(
            drawing.items[1].shapes,
            [Shape::Polyline {
                points,
                closed: false
            }]
        );
        let Shape::Conic(conic) = &drawing.items[2].shapes[0] else {
            panic!()
        };
        assert_eq!(conic.centre, DVec3::new(22.0, 4.0, 11.0));
        assert_eq!(
            (conic.x, conic.y),
            (DVec3::new(0.0, 4.0, 0.0), DVec3::new(-4.0, 0.0, 0.0))
        );
        // By their layer; by their parent.
        assert_eq!(drawing.items[3].colour, Some([1, 2, 3]));
        assert_eq!(drawing.items[4].colour, Some([4, 5, 6]));
        assert_eq!(drawing.items[3].group[..], ["Lage"]);
    }
}

#[test]
fn tells_of_blocks_that_nothing_refers_to() {
    let drawing = read(&blocks(4).finish()).unwrap();
    assert!(drawing.items.is_empty());
    assert_eq!(
        drawing.remarks,
        ["4 objects are left out: they are in blocks that nothing refers to"]
    );
}
