//! The drawing taken apart into its groups again. Whether other programs read it is asked of
//! ezdxf by tests/exchange/check_dxf.py.

use std::collections::HashSet;
use std::f64::consts::TAU;

use glam::DVec3;

use super::*;
use crate::document::Colour;
use crate::geometry::FloatPolygon;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use crate::io::loss::Export;

type Pair = (i32, String);

fn curve(name: &str, degree: usize, vertices: &[[f64; 3]], weights: Option<Vec<f64>>) -> Curve {
    let vertices = vertices.iter().map(|vertex| DVec3::from_array(*vertex));
    let polygon = FloatPolygon::new(degree, vertices.collect(), weights, false);
    Curve::new(name, polygon.unwrap())
}

fn planar(name: &str) -> Curve {
    let vertices = [
        [0.1, -0.0, 0.0],
        [1.0, 1.0 / 3.0, 0.0],
        [2.0, 1e-7, 0.0],
        [3.0, 1e20, 0.0],
    ];
    curve(name, 2, &vertices, None)
}

fn spatial(name: &str) -> Curve {
    let vertices = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 2.0],
        [0.0, 1.0, 4.0],
    ];
    curve(name, 3, &vertices, Some(vec![1.0, 0.5, 2.0, 1.0]))
}

fn periodic() -> Curve {
    let vertices = [
        [1.0, 0.1, 0.0],
        [0.1, 1.0, 0.0],
        [-1.0, 0.3, 0.0],
        [0.0, -1.0, 0.0],
    ];
    let open = curve("round", 3, &vertices, None).polygon;
    let polygon = FloatPolygon::new(3, open.vertices().to_vec(), None, true).unwrap();
    Curve::new("round", polygon)
}

fn written(curves: &[&Curve], polygon: Option<PolygonKind>) -> Result<Export, WriteError> {
    let curves = curves.iter().copied().cloned();
    DXF.write(&Document::from_curves(curves), polygon)
}

/// Write a drawing and split it into its groups.
fn groups(curves: &[&Curve], polygon: Option<PolygonKind>) -> Vec<Pair> {
    let text = String::from_utf8(written(curves, polygon).unwrap().bytes).unwrap();
    assert!(text.is_ascii());
    let lines: Vec<&str> = text.lines().collect();
    let pairs = lines.chunks(2);
    pairs
        .map(|pair| (pair[0].trim().parse().unwrap(), pair[1].to_owned()))
        .collect()
}

/// Take the groups of each entity of a kind: everything up to the next one.
fn entities<'a>(groups: &'a [Pair], kind: &str) -> Vec<&'a [Pair]> {
    let starts: Vec<usize> = (0..groups.len()).filter(|i| groups[*i].0 == 0).collect();
    let spans = starts.windows(2).map(|span| &groups[span[0]..span[1]]);
    spans.filter(|span| span[0].1 == kind).collect()
}

fn values(entity: &[Pair], code: i32) -> Vec<&str> {
    let found = entity.iter().filter(|group| group.0 == code);
    found.map(|group| group.1.as_str()).collect()
}

fn numbers(entity: &[Pair], code: i32) -> Vec<f64> {
    let texts = values(entity, code).into_iter();
    texts.map(|text| text.parse().unwrap()).collect()
}

#[test]
fn a_spline_holds_the_clamped_polygon_to_the_last_digit() {
    for curve in [planar("a"), spatial("a")] {
        let groups = groups(&[&curve], None);
        let splines = entities(&groups, "SPLINE");
        let [spline] = splines[..] else {
            panic!("{} splines", splines.len());
        };
        let clamped = ClampedPolygon::from_float(&curve.polygon);
        let vertices = clamped.vertices();
        let degree = clamped.degree();
        assert_eq!(numbers(spline, 40), clamped.knots());
        assert_eq!(numbers(spline, 40)[0], 0.0);
        assert_eq!(numbers(spline, 41), clamped.weights().unwrap_or_default());
        for (code, axis) in [(10, 0), (20, 1), (30, 2)] {
            let expected: Vec<f64> = vertices.iter().map(|v| v.to_array()[axis]).collect();
            assert_eq!(numbers(spline, code), expected);
        }
        let counts = [71, 72, 73].map(|code| numbers(spline, code)[0] as usize);
        assert_eq!(counts, [degree, clamped.knots().len(), vertices.len()]);
        let flags = if curve.polygon.is_planar() { "8" } else { "4" };
        assert_eq!(values(spline, 70), [flags]);
    }
}

#[test]
fn polygons_are_polylines_on_layers_of_their_own() {
    let (flat, space) = (planar("flat"), spatial("space"));
    let all = groups(&[&flat, &space], None);
    let flat_polylines = entities(&all, "LWPOLYLINE");
    let layers: Vec<&str> = flat_polylines.iter().map(|e| values(e, 8)[0]).collect();
    assert_eq!(layers, ["flat float polygon", "flat closed polygon"]);
    assert_eq!(numbers(flat_polylines[0], 20), [0.0, 1.0 / 3.0, 1e-7, 1e20]);
    assert_eq!(values(flat_polylines[0], 20)[0], "0.0", "not −0");
    let space_polylines = entities(&all, "POLYLINE");
    let layers: Vec<&str> = space_polylines.iter().map(|e| values(e, 8)[0]).collect();
    assert_eq!(layers, ["space float polygon", "space closed polygon"]);
    let vertices = entities(&all, "VERTEX");
    assert_eq!(vertices.len(), 8);
    assert_eq!(numbers(vertices[3], 30), [4.0]);
    assert_eq!(entities(&all, "SEQEND").len(), 2);
    let defined = entities(&all, "LAYER").into_iter();
    let defined: Vec<&str> = defined.map(|layer| values(layer, 2)[0]).collect();
    assert_eq!(
        defined,
        [
            "0",
            "flat",
            "flat float polygon",
            "flat closed polygon",
            "space",
            "space float polygon",
            "space closed polygon"
        ]
    );
}

#[test]
fn one_polygon_can_be_chosen() {
    for kind in PolygonKind::ALL {
        let groups = groups(&[&planar("a")], Some(kind));
        assert_eq!(entities(&groups, "SPLINE").len(), 1);
        let polylines = entities(&groups, "LWPOLYLINE");
        assert_eq!(polylines.len(), 1);
        assert_eq!(
            values(polylines[0], 8),
            [format!("a{}", layers::suffix(kind))]
        );
    }
}

#[test]
fn a_periodic_curve_ends_exactly_where_it_begins() {
    let curve = periodic();
    let groups = groups(&[&curve], None);
    let spline = entities(&groups, "SPLINE")[0];
    for code in [10, 20, 30] {
        let values = values(spline, code);
        assert_eq!(values.first(), values.last());
    }
    let closed: Vec<&str> = entities(&groups, "LWPOLYLINE")
        .iter()
        .map(|polyline| values(polyline, 70)[0])
        .collect();
    assert_eq!(
        closed,
        ["1", "0"],
        "the float polygon is closed, the clamped one is open"
    );
}

#[test]
fn handles_are_unique_and_below_the_next_one() {
    let groups = groups(&[&planar("a"), &spatial("b")], None);
    let seed = groups
        .iter()
        .position(|group| group.1 == "$HANDSEED")
        .unwrap();
    let next = u64::from_str_radix(&groups[seed + 1].1, 16).unwrap();
    let mut seen = HashSet::new();
    for (index, (code, value)) in groups.iter().enumerate() {
        if (*code == 5 && index != seed + 1) || *code == 105 {
            let handle = u64::from_str_radix(value, 16).unwrap();
            assert!(seen.insert(handle), "{value} is there twice");
            assert!(handle < next, "{value} is not below {next:X}");
        }
    }
    for (code, value) in &groups {
        if [330, 340, 350].contains(code) && value != "0" {
            let handle = u64::from_str_radix(value, 16).unwrap();
            assert!(seen.contains(&handle), "{value} is not there");
        }
    }
}

#[test]
fn names_are_written_in_ascii() {
    let groups = groups(&[&planar("Rücken 曲")], Some(PolygonKind::Float));
    let layer = values(entities(&groups, "SPLINE")[0], 8)[0];
    assert_eq!(layer, "R\\U+00FCcken \\U+66F2");
}

#[test]
fn hidden_and_locked_curves_are_on_such_layers() {
    let mut curve = planar("a");
    curve.visible = false;
    curve.locked = true;
    let groups = groups(&[&curve], Some(PolygonKind::Float));
    for layer in &entities(&groups, "LAYER")[1..] {
        assert!(numbers(layer, 62)[0] < 0.0);
        assert_eq!(values(layer, 70), ["4"]);
    }
}

#[test]
fn losses_are_reported() {
    let check = |curve: &Curve, expected: &[Loss]| {
        let losses = written(&[curve], Some(PolygonKind::Float)).unwrap().losses;
        let found: Vec<Loss> = losses.losses.into_iter().map(|(_, loss)| loss).collect();
        assert_eq!(found, expected);
    };
    check(&planar("a"), &[]);
    check(&periodic(), &[Loss::Periodic]);
    let kind = PolygonKind::Float;
    check(&spatial("a"), &[Loss::PolygonWeights { kind }]);
    let mut curve = planar("a/b");
    curve.colour = Some(Colour([1, 2, 3]));
    curve.targets.finish = Some(EndTarget {
        point: DVec3::X,
        direction: None,
        ..EndTarget::default()
    });
    let written = "a_b".to_owned();
    check(
        &curve,
        &[Loss::Name { written }, Loss::Targets, Loss::NearestColour],
    );
}

#[test]
fn colours_come_back() {
    let colours = [
        [255, 0, 0],
        [255, 255, 0],
        [0, 0, 255],
        [255, 255, 255],
        [51, 51, 51],
    ];
    let curves = colours.iter().zip(["a", "b", "c", "d", "e"]);
    let curves = curves.map(|(colour, name)| Curve {
        colour: Some(Colour(*colour)),
        ..planar(name)
    });
    let curves: Vec<Curve> = curves.collect();
    let curves: Vec<&Curve> = curves.iter().collect();
    let export = written(&curves, Some(PolygonKind::Float)).expect("written");
    assert!(export.losses.is_empty(), "{}", export.losses);
    let read = crate::io::formats::find("dxf");
    let read = read.expect("DXF").read(&export.bytes);
    let read = read.expect("it can be read").curves;
    let found: Vec<_> = read.iter().map(|curve| curve.colour).collect();
    assert_eq!(found, colours.map(|colour| Some(Colour(colour))));
}

/// The layers of a drawing with their colours and whether they are locked, and those of its splines.
fn layers_of(curves: &[&Curve]) -> (Vec<String>, Vec<String>) {
    let groups = groups(curves, Some(PolygonKind::Float));
    let layers = entities(&groups, "LAYER").into_iter();
    let layers = layers.map(|layer| {
        let [name, colour, flags] = [2, 62, 70].map(|code| values(layer, code)[0]);
        format!("{name}: {colour} {flags}")
    });
    let splines = entities(&groups, "SPLINE").into_iter();
    let splines = splines.map(|spline| values(spline, 8)[0].to_owned());
    (layers.skip(1).collect(), splines.collect())
}

#[test]
fn curves_of_a_group_share_its_layers() {
    let of = |name: &str, group: &str| planar(name).in_group(group.into());
    let mut hidden = of("c", "Deck");
    (hidden.visible, hidden.locked) = (false, true);
    let curves = [
        of("a", "Deck"),
        of("b", "Deck"),
        hidden,
        of("d", "Hull/Keel"),
    ];
    let (layers, splines) = layers_of(&[
        &curves[0],
        &curves[1],
        &curves[2],
        &curves[3],
        &planar("Deck"),
    ]);
    let expected = ["Deck", "Deck", "Deck hidden locked", "Hull$Keel", "Deck 2"];
    assert_eq!(splines, expected);
    let expected = [
        "Deck: 7 0",
        "Deck float polygon: 5 0",
        "Deck hidden locked: -7 4",
        "Deck hidden locked float polygon: -5 4",
        "Hull$Keel: 7 0",
        "Hull$Keel float polygon: 5 0",
        "Deck 2: 7 0",
        "Deck 2 float polygon: 5 0",
    ];
    assert_eq!(layers, expected);
    let bytes = written(&[&curves[0], &curves[1]], None).unwrap().bytes;
    let read = DXF.read(&bytes).unwrap();
    assert_eq!(read.curves[0].group, Group::from("Deck"));
    // A curve that is alone on its layer is called like it.
    let bytes = written(&[&planar("sheer")], None).unwrap().bytes;
    let read = DXF.read(&bytes).unwrap();
    assert_eq!(read.curves[0].name, "sheer");
    assert_eq!(read.curves[0].group, Group::default());
}

#[test]
fn names_and_paths_that_layers_cannot_hold_are_reported() {
    let losses = |group: &str| {
        let curve = planar("a").in_group(group.into());
        written(&[&curve], None).unwrap().losses.to_string()
    };
    let name = "“a”: the name of a curve in a group isn't stored in the DXF";
    assert_eq!(losses("Deck"), name);
    let path = "“a”: the group is written as “Deck$Port”, which DXF allows";
    assert_eq!(losses("Deck/Port"), format!("{name}\n{path}"));
}

#[test]
fn what_cannot_be_counted_is_refused() {
    let long = |count: usize| {
        let vertices: Vec<[f64; 3]> = (0..count).map(|i| [i as f64, 0.0, 0.0]).collect();
        curve("long", 3, &vertices, None)
    };
    let error = written(&[&long(32_764)], None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "“long” has 32764 vertices, and a DXF file can hold 32763 a curve: split the curve"
    );
    let longest = groups(&[&long(32_763)], None);
    let knots = entities(&longest, "SPLINE")
        .pop()
        .map(|spline| values(spline, 72));
    assert_eq!(knots, Some(vec!["32767"]), "the largest number of 16 bits");
    assert!(matches!(
        written(&[], None),
        Err(WriteError::NoCurves { .. })
    ));
}

#[test]
fn references_of_a_group_share_its_layer_with_curves() {
    let group = Group::new(["Hull"]);
    let own = planar("own").in_group(group.clone());
    let line = PointList::new(vec![DVec3::ZERO, DVec3::X]).unwrap();
    let line = ReferenceCurve::of(ReferenceForm::Points(line)).unwrap();
    let line = Reference::new("line", line).in_group(group);
    let document = Document::from_curves([own]).with_references([line]);
    let export = DXF.write(&document, None).unwrap();
    let drawing = exchange::dxf::read(&export.bytes).unwrap();
    let curves = drawing.items.iter().filter(|item| {
        item.shapes
            .iter()
            .all(|it| it.nurbs().is_some() || it.corners() == Some(2))
    });
    let groups: Vec<&[String]> = curves.map(|item| &item.group[..]).collect();
    assert_eq!(groups, [["Hull"], ["Hull"]]);
    let told = export.losses.to_string();
    assert!(
        told.contains("“own” and “line”: the name of a curve in a group isn't stored"),
        "{told}"
    );
}

#[test]
fn round_ellipses_of_the_plane_are_circles_and_arcs() {
    let turned = DVec3::new(0.6, 0.8, 0.0);
    let conic = |x: DVec3, y: DVec3, to: f64| Conic {
        centre: DVec3::new(3.0, -1.0, 0.5),
        x,
        y,
        from: 0.25,
        to,
    };
    let [x, y] = [2.0 * DVec3::X, 2.0 * DVec3::Y];
    let cases = [
        (Kind::Circle, conic(x, y, 0.25 + TAU)),
        (Kind::Arc, conic(x, y, 3.0)),
        (Kind::Arc, conic(x, -y, 6.0)),
        (Kind::Arc, conic(turned, DVec3::new(-0.8, 0.6, 0.0), 5.0)),
        (Kind::Ellipse, conic(x, 2.0 * DVec3::Z, 3.0)),
        (Kind::Ellipse, conic(x, DVec3::Y, 3.0)),
    ];
    for (kind, conic) in cases {
        let mut writer = Writer::new();
        super::conic(&mut writer, &conic, "0", &mut Reach::default());
        let entities = writer.into_text();
        let text = format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n");
        let drawing = exchange::dxf::read(text.as_bytes()).expect("a drawing");
        let [item] = &drawing.items[..] else {
            panic!("{kind:?}: {:?}", drawing.items);
        };
        assert_eq!(item.kind, kind);
        let [Shape::Conic(found)] = &item.shapes[..] else {
            panic!("{:?}", item.shapes);
        };
        assert!((found.to - found.from - (conic.to - conic.from)).abs() < 1e-14);
        let at = |it: &Conic, u: f64| it.centre + u.cos() * it.x + u.sin() * it.y;
        let ends = |it: &Conic| [it.from, it.to].map(|u| at(it, u));
        let [mut expected, found] = [ends(&conic), ends(found)];
        // An arc runs anticlockwise; a whole circle has no ends.
        if conic.x.cross(conic.y).z < 0.0 {
            expected.reverse();
        }
        for (expected, found) in expected.iter().zip(found) {
            let distance = expected.distance(found);
            assert!(
                kind == Kind::Circle || distance < 1e-14,
                "{kind:?} {distance}"
            );
        }
    }
}

#[test]
fn what_has_neither_a_name_nor_a_group_is_on_layer_0() {
    let circle = || ReferenceCurve::from_text("circle").unwrap();
    let mut hidden = Reference::new("circle 2", circle());
    hidden.visible = false;
    let references = [
        Reference::new("circle 1", circle()),
        hidden,
        Reference::new("circle 3", circle()).in_group(Group::new(["Deck", "polyline 1"])),
        Reference::new("rim", circle()),
    ];
    let curves = ["spline 1", "spline 2"].map(planar);
    let document = Document::from_curves(curves).with_references(references);
    let export = DXF.write(&document, None).unwrap();
    let drawing = exchange::dxf::read(&export.bytes).unwrap();
    let circles = drawing.items.iter().filter(|it| it.kind == Kind::Circle);
    let found: Vec<(String, bool)> = circles.map(|it| (it.group.join("/"), it.hidden)).collect();
    let expected = [
        ("0", false),
        ("0 hidden", true),
        ("Deck", false),
        ("rim", false),
    ];
    assert_eq!(
        found,
        expected.map(|(name, hidden)| (name.to_owned(), hidden))
    );
    let splines = drawing.items.iter().filter(|it| it.kind == Kind::Spline);
    assert!(splines.into_iter().all(|it| *it.group == ["0"]));
    let told = export.losses.to_string();
    let unnamed =
        "“spline 1”, “spline 2”, “circle 1” and 1 other: the name isn't stored in the DXF";
    assert!(told.contains(unnamed), "{told}");
    assert!(
        told.contains("“circle 3”: the group is written as “Deck”"),
        "{told}"
    );
}
