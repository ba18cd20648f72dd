//! What files of each format keep of groups.

use glam::DVec3;

use super::exchange::drawing::{Drawing, Item, Kind, Shape};
use super::formats;
use super::{Loss, Reading};
use crate::document::{Colour, Curve, Document, Group, Reference};
use crate::geometry::FloatPolygon;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::ReferenceCurve;

fn curve(name: &str, group: Group) -> Curve {
    let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 0.0), (2.0, 1.0)]);
    Curve::new(name, polygon.expect("a polygon")).in_group(group)
}

fn document(groups: &[(&str, &[&str])]) -> Document {
    let curves = groups.iter();
    let curves = curves.map(|(name, path)| curve(name, Group::new(*path)));
    Document::from_curves(curves)
}

/// The groups of a file's curves, then of its references, with their names.
fn groups(reading: &Reading) -> Vec<(&str, Vec<&str>)> {
    let curves = reading.curves.iter().map(|it| (&it.name, &it.group));
    let references = reading.references.iter().map(|it| (&it.name, &it.group));
    let named = curves.chain(references).map(|(name, group)| {
        let path = group.names().iter().map(String::as_str);
        (name.as_str(), path.collect())
    });
    named.collect()
}

/// What a format reports of lost groups.
fn losses(extension: &str, document: &Document) -> Vec<Option<String>> {
    let format = formats::find(extension).expect("a format");
    let export = format.write(document, None).expect("a file");
    let losses = export.losses.losses.into_iter();
    let of_groups = losses.filter_map(|(_, loss)| match loss {
        Loss::Group { written } => Some(written.map(|group| group.to_string())),
        _ => None,
    });
    of_groups.collect()
}

fn read_back(extension: &str, document: &Document) -> Reading {
    let format = formats::find(extension).expect("a format");
    let export = format.write(document, None).expect("a file");
    format.read(&export.bytes).expect("what was written")
}

#[test]
fn formats_with_layers_give_groups_back() {
    let circle = ReferenceCurve::from_text("circle").expect("a circle");
    let circle = Reference::new("circle", circle).in_group("Deck".into());
    let all: [(&str, &[&str]); 3] = [("a", &["Deck", "Port"]), ("b", &["Hüll"]), ("c", &[])];
    let document = document(&all).with_references([circle]);
    for extension in [
        "batten", "step", "ap242", "igs", "3dm", "svg", "obj", "json",
    ] {
        assert_eq!(losses(extension, &document), [], "{extension}");
        let reading = read_back(extension, &document);
        let found = groups(&reading);
        for (name, path) in all.into_iter().chain([("circle", &["Deck"][..])]) {
            let own = found.iter().find(|own| own.0 == name);
            assert_eq!(own.expect(name).1, path, "{extension}: {name}");
        }
    }
}

#[test]
fn a_slash_in_a_name_is_kept_or_its_loss_reported() {
    let document = document(&[("a", &["Deck", "1/2"])]);
    for extension in ["batten", "3dm", "svg", "json"] {
        assert_eq!(losses(extension, &document), [], "{extension}");
        let reading = read_back(extension, &document);
        assert_eq!(
            groups(&reading),
            [("a", vec!["Deck", "1/2"])],
            "{extension}"
        );
    }
    for extension in ["step", "ap242", "igs", "obj"] {
        let written = Some("Deck/1/2".to_owned());
        assert_eq!(losses(extension, &document), [written], "{extension}");
        let reading = read_back(extension, &document);
        assert_eq!(
            groups(&reading),
            [("a", vec!["Deck", "1", "2"])],
            "{extension}"
        );
    }
}

#[test]
fn formats_without_layers_report_the_loss() {
    let document = document(&[("a", &["Deck"]), ("b", &[])]);
    for extension in ["brep", "glif", "csv", "tsv"] {
        assert_eq!(losses(extension, &document), [None], "{extension}");
    }
    let format = formats::find("brep").expect("a format");
    let document = document.with_unit(Some(LengthUnit::Millimetre));
    let export = format.write(&document, None).expect("a file");
    let told = export.losses.to_string();
    let [group, names] = [
        "“a”: the group isn't stored in the BREP",
        "“a” and “b”: the name isn't stored in the BREP",
    ];
    assert_eq!(told, format!("{group}\n{names}"));
}

#[test]
fn names_that_a_format_changes_are_reported() {
    for (extension, path, written) in [
        ("3dm", &["(a)"][..], Some("_(a)")),
        ("obj", &["default"], None),
        ("obj", &["n#1"], Some("n_1")),
        ("svg", &["a"; 61], Some("a/")),
    ] {
        let reported = losses(extension, &document(&[("a", path)]));
        let [reported] = &reported[..] else {
            panic!("{extension}: {reported:?}");
        };
        let begins = match (reported, written) {
            (Some(reported), Some(written)) => reported.starts_with(written),
            (reported, written) => reported.is_none() && written.is_none(),
        };
        assert!(begins, "{extension}: {reported:?}");
    }
}

fn item(kind: Kind, path: &[&str], name: Option<&str>, shapes: usize) -> Item {
    let line = |place: usize| Shape::Polyline {
        points: vec![DVec3::ZERO, DVec3::new(1.0, place as f64, 0.0)],
        closed: false,
    };
    Item {
        group: path.iter().map(|name| (*name).to_owned()).collect(),
        name: name.map(str::to_owned),
        at: 1,
        ..Item::new(kind, (0..shapes).map(line).collect())
    }
}

fn drawing(items: Vec<Item>) -> Drawing {
    Drawing {
        items,
        ..Drawing::default()
    }
}

fn reading(items: Vec<Item>) -> Reading {
    drawing(items).reading()
}

#[test]
fn the_pieces_of_an_item_are_a_group_and_so_is_a_block() {
    let mut block = item(Kind::Line, &["Layer"], Some("bolt"), 1);
    block.block = Some("Rivet".into());
    let reading = reading(vec![
        item(Kind::Polycurve, &["Layer"], Some("rail"), 2),
        item(Kind::Polycurve, &[], Some("rail"), 2),
        item(Kind::Path, &[], None, 2),
        item(Kind::Line, &[], Some("alone"), 1),
        block,
    ]);
    assert_eq!(
        groups(&reading),
        [
            ("rail 1", vec!["Layer", "rail"]),
            ("rail 2", vec!["Layer", "rail"]),
            ("rail 2 1", vec!["rail 2"]),
            ("rail 2 2", vec!["rail 2"]),
            ("path 1 1", vec!["path 1"]),
            ("path 1 2", vec!["path 1"]),
            ("alone", vec![]),
            ("bolt", vec!["Layer", "Rivet"]),
        ]
    );
}

fn point(group: &str, name: Option<&str>) -> Item {
    Item {
        shapes: vec![Shape::Point(DVec3::new(group.len() as f64, 0.0, 0.0))],
        ..item(Kind::Point, &[group], name, 0)
    }
}

#[test]
fn single_points_make_a_list_for_each_name_and_layer() {
    let reading = reading(vec![
        point("Scan", Some("keel")),
        point("Scan", Some("stem")),
        point("Scan", Some("keel")),
        point("Scan", Some("a")),
        point("Scan", Some("b")),
        point("Survey", Some("keel")),
        point("0", None),
    ]);
    assert_eq!(
        groups(&reading),
        [
            ("keel", vec!["Scan"]),
            ("points", vec!["Scan"]),
            ("points 2", vec![]),
        ]
    );
    let counts = reading.references.iter();
    let counts: Vec<usize> = counts
        .map(|it| it.points().expect("a list").len())
        .collect();
    assert_eq!(counts, [2, 3, 2]);
    assert_eq!(
        reading.remarks.to_string(),
        "points: its points had names of their own, which it has not\n\
         points 2: its points had names of their own, which it has not\n\
         points 2: its points had layers of their own, which it has not"
    );
}

#[test]
fn single_points_keep_their_colour_and_stay_hidden() {
    let red = |hidden| Item {
        colour: Some([200, 0, 0]),
        hidden,
        ..point("Scan", None)
    };
    let reading = reading(vec![red(false), red(true), red(false), red(true)]);
    let kept = reading.references.iter();
    let kept: Vec<_> = kept.map(|it| (it.visible, it.colour)).collect();
    let colour = Some(Colour([200, 0, 0]));
    assert_eq!(kept, [(true, colour), (false, colour)]);
    let mixed = drawing(vec![red(false), point("Scan", None), point("Far", None)]);
    let told = mixed.reading().remarks.to_string();
    assert_eq!(
        told,
        "points: its points had colours of their own, which it has not\n\
         a single point (at 1) is left out: a list has two or more"
    );
    let found = mixed.found();
    assert_eq!(found.references(&found.choice()), [1, 1]);
}

#[test]
fn layers_name_what_is_alone_on_them_where_items_have_no_names() {
    let items = vec![
        item(Kind::Line, &["Deck", "Rail"], None, 1),
        point("Scan", None),
        point("Scan", None),
        point("Keel", None),
        point("Keel", None),
        item(Kind::Line, &["Keel"], None, 1),
    ];
    let mut drawing = drawing(items);
    let keel = |points| (points, vec!["Keel"]);
    assert_eq!(
        groups(&drawing.reading()),
        [
            ("line 1", vec!["Deck", "Rail"]),
            ("line 2", vec!["Keel"]),
            ("points", vec!["Scan"]),
            keel("points 2"),
        ]
    );
    drawing.is_nameless = true;
    assert_eq!(
        groups(&drawing.reading()),
        [
            ("Rail", vec!["Deck"]),
            ("line 1", vec!["Keel"]),
            ("Scan", vec![]),
            keel("points"),
        ]
    );
}
