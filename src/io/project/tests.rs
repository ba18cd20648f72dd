//! What a project file keeps, and what it refuses.

use glam::DVec3;
use proptest::prelude::*;
use std::sync::Arc;

use super::*;
use crate::document::{Colour, Curve, EndTargets, Extras, GuideLine, MatchPlace, Reference};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::references::ReferenceCurve;
use crate::geometry::{Continuity, End, FloatPolygon, MAX_MAGNITUDE};
use crate::io::{FileMatch, MatchSource, TABLE};

#[path = "../../../tests/common/repeatable.rs"]
mod repeatable;

fn line(name: &str) -> Curve {
    let polygon = FloatPolygon::planar(1, &[(0.0, 1.0), (2.0, 3.5)]);
    Curve::new(name, polygon.unwrap())
}

fn curves_of(text: &str) -> Vec<Curve> {
    let curves = read(text.as_bytes()).unwrap().curves;
    curves.into_iter().map(Arc::unwrap_or_clone).collect()
}

fn text_of(curves: &[&Curve]) -> String {
    let curves = curves.iter().copied().cloned();
    let written = PROJECT.write(&Document::from_curves(curves), None);
    String::from_utf8(written.unwrap().bytes).unwrap()
}

#[test]
fn the_layout_is_as_described() {
    assert_eq!(
        text_of(&[&line("arc")]),
        r#"{
  "format": "batten",
  "version": 1,
  "curves": [
    {
      "name": "arc",
      "degree": 1,
      "polygon": "float",
      "vertices": [
        [0.0, 1.0],
        [2.0, 3.5]
      ],
      "weights": null,
      "periodic": false
    }
  ]
}
"#
    );
}

#[test]
fn everything_is_kept() {
    let mut curve = line("a \"b\"\n曲");
    curve.colour = Some(Colour([0x1f, 0x00, 0xb4]));
    curve.visible = false;
    curve.locked = true;
    curve.targets = EndTargets {
        start: Some(EndTarget {
            point: DVec3::new(1.0, 2.0, 0.0),
            direction: None,
            ..EndTarget::default()
        }),
        finish: Some(EndTarget {
            point: DVec3::new(1.0, 2.0, 3.0),
            direction: Some(DVec3::X),
            ..EndTarget::default()
        }),
    };
    let text = text_of(&[&curve, &line("b")]);
    for part in [
        "\"colour\": \"#1f00b4\"",
        "\"visible\": false",
        "\"locked\": true",
        "\"point\": [1.0, 2.0]",
        "\"point\": [1.0, 2.0, 3.0]",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let reading = read(text.as_bytes()).unwrap();
    assert_eq!(reading.curves, [curve.into(), line("b").into()]);
    assert!(reading.remarks.is_empty(), "{}", reading.remarks);
}

#[test]
fn what_others_write_is_read() {
    let check = |curve: &str, expected: Curve| {
        let text = format!(r#"{{"format":"batten","version":1,"more":[{{}}],"curves":[{curve}]}}"#);
        let mut curves = curves_of(&text);
        curves[0].extras = Extras::default();
        assert_eq!(curves, [expected], "{curve}");
    };
    check(
        r#"{"name":"arc","degree":1,"vertices":[[0,1],[2,3.5]]}"#,
        line("arc"),
    );
    check(
        r#"{"degree":1.0,"polygon":"bezier","vertices":[[0,1,0],[2,3.5,0]],"weights":null,"more":null}"#,
        line("curve 1"),
    );
    check(
        r#"{"name":" ","degree":1,"polygon":"clamped","vertices":[[0,1],[2,3.5]],"targets":{}}"#,
        line("curve 1"),
    );
    let mut expected = line("arc");
    expected.targets.finish = Some(EndTarget {
        point: DVec3::new(7.0, 8.0, 0.0),
        direction: None,
        ..EndTarget::default()
    });
    expected.colour = Some(Colour([255, 0, 16]));
    check(
        r##"{"name":"arc","degree":1,"vertices":[[0,1],[2,3.5]],"colour":"#FF0010","periodic":null,
            "targets":{"start":null,"end":{"point":[7,8],"direction":null}}}"##,
        expected,
    );
    assert_eq!(
        read("\u{feff}{\"format\":\"batten\",\"version\":1,\"curves\":[]}\r\n".as_bytes()),
        Ok(Reading::default())
    );
}

#[test]
fn a_clamped_polygon_is_converted() {
    let text = r#"{"format":"batten","version":1,"curves":[{"name":"a","degree":2,
        "polygon":"clamped","vertices":[[0,0],[1,1],[2,0]]}]}"#;
    let curves = curves_of(text);
    let expected = FloatPolygon::planar(2, &[(-1.0, -1.0), (1.0, 1.0), (3.0, -1.0)]);
    assert_eq!(curves, [Curve::new("a", expected.unwrap())]);
}

/// Check the message for a file with two curves, the second of which is `curve`.
fn check_curve(curve: &str, expected: &str) {
    let first = r#"{"name":"a","degree":1,"vertices":[[0,0],[1,1]]}"#;
    let text = format!("{{\"format\":\"batten\",\"version\":1,\"curves\":[{first},\n{curve}]}}");
    check(&text, expected);
}

fn check(text: &str, expected: &str) {
    let message = read(text.as_bytes()).unwrap_err().to_string();
    assert_eq!(message, expected, "{text}");
}

#[test]
fn files_that_are_no_projects_are_refused() {
    check("", "the file is empty");
    check("\u{feff} \n", "the file is empty");
    for text in ["[1, 2]", "x,y\n0,1\n"] {
        let problem = read(text.as_bytes()).unwrap_err().problem;
        assert_eq!(problem, Problem::WrongFormat { found: None }, "{text}");
    }
    check(
        "{}",
        "this is not a Batten project: it says no \"format\", where \"format\": \"batten\" is needed",
    );
    check(
        r#"{"format":"other","version":1}"#,
        "this is not a Batten project: it says \"format\": \"other\", where \"format\": \"batten\" is needed",
    );
    check(
        r#"{"format":"batten","version":3,"curves":{}}"#,
        "the project is of version 3, and this Batten reads versions up to 2: open it with a newer Batten",
    );
    for (version, found) in [
        ("", "not given"),
        (r#","version":"1""#, "\"1\""),
        (r#","version":0"#, "0"),
    ] {
        check(
            &format!(r#"{{"format":"batten"{version},"curves":[]}}"#),
            &format!("the project's \"version\" is {found}: a whole number from 1 up is needed"),
        );
    }
    check(
        r#"{"format":"batten","version":1}"#,
        "line 1, column 31: missing field `curves`",
    );
    check(
        "{\"format\":\"batten\",\"version\":1,\"curves\":[]}\n x",
        "line 2, column 2: trailing characters",
    );
}

#[test]
fn malformed_json_is_refused_with_its_place() {
    check(
        "{\"format\"\n",
        "line 2, column 0: EOF while parsing an object",
    );
    check_curve(
        "{\"name\":\"hull\",\"degree\":2,\n\"vertices\":[[0,0],[1,1],[2,,0]]}",
        "line 3, column 28, curve 2, vertex 2: expected value",
    );
    check_curve(
        "{\"name\":\"hull\",\"degree\":2 \"vertices\"",
        "line 2, column 27, curve 2: expected `,` or `}`",
    );
    let nested = format!("{{\"more\":{}", "[".repeat(100_000));
    check_curve(
        &nested,
        "line 2, column 100010, curve 2: expected `,` or `]`",
    );
}

#[test]
fn numbers_that_are_none_are_refused_with_their_place() {
    for value in ["NaN", "-Infinity", "1e999", "-1e400"] {
        let curve = format!("{{\"degree\":1,\"vertices\":[[0,0],[1,{value}]]}}");
        let text = format!("{{\"format\":\"batten\",\"version\":1,\"curves\":[\n{curve}]}}");
        let error = read(text.as_bytes()).unwrap_err();
        let place = (error.place.line, error.place.curve, error.place.vertex);
        assert_eq!(place, (Some(2), Some(1), Some(1)), "{error}");
        assert_eq!(error.problem, Problem::NotFinite(value.to_owned()));
    }
}

#[test]
fn content_of_the_wrong_kind_is_refused_with_its_place() {
    check_curve(
        "7",
        "line 2, column 1, curve 2: invalid type: integer `7`, expected a curve, which is a JSON object",
    );
    check_curve(
        r#"{"degree":1,"vertices":1000000000}"#,
        "line 2, column 33, curve 2: invalid type: integer `1000000000`, expected a sequence",
    );
    check_curve(
        r#"{"degree":1,"vertices":[[0,0],[1]]}"#,
        "line 2, column 33, curve 2, vertex 1: invalid length 1, expected 2 or 3 numbers in brackets",
    );
    check_curve(
        r#"{"degree":1,"vertices":[[0,0],[1,2,3,4]]}"#,
        "line 2, column 37, curve 2, vertex 1: invalid value: a fourth number, expected 2 or 3 numbers in brackets",
    );
    check_curve(
        r#"{"degree":1,"vertices":[[0,0],[1,2,null]]}"#,
        "line 2, column 39, curve 2, vertex 1: invalid type: null, expected a number",
    );
    check_curve(
        r#"{"degree":1,"vertices":[[0,0],7]}"#,
        "line 2, column 31, curve 2, vertex 1: invalid type: integer `7`, expected 2 or 3 numbers in brackets",
    );
    check_curve(
        r#"{"degree":1,"vertices":[[0,0],[1,"2"]]}"#,
        "line 2, column 36, curve 2, vertex 1: invalid type: string \"2\", expected a number",
    );
    check_curve(
        r#"{"degree":1,"vertices":[[0,0],[1,2]],"weights":[1,null]}"#,
        "line 2, column 54, curve 2, vertex 1: invalid type: null, expected a number",
    );
    check_curve(
        r#"{"vertices":[[0,0],[1,2]]}"#,
        "line 2, column 26, curve 2: missing field `degree`",
    );
    for degree in ["-1", "2.5"] {
        check_curve(
            &format!(r#"{{"name":"b","vertices":[],"degree":{degree}}}"#),
            &format!(
                "line 2, column {}, curve 2: degree {degree} is out of range: a whole number from 1 to 25 is needed",
                36 + degree.len()
            ),
        );
    }
    check_curve(
        r#"{"degree":1,"polygon":"closed"}"#,
        "line 2, column 31, curve 2: “closed” is not a polygon: float, clamped or bezier is needed",
    );
    check_curve(
        r#"{"degree":1,"colour":"red"}"#,
        "line 2, column 27, curve 2: “red” is not a colour: one like #1f77b4 is needed",
    );
}

#[test]
fn a_vertex_with_fewer_numbers_than_others_is_refused() {
    let check = |curves: &str, references: &str, expected: &str| {
        let text = format!(
            r#"{{"format":"batten","version":2,"curves":[{curves}],"references":[{references}]}}"#
        );
        assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), expected);
    };
    check(
        r#"{"name":"hull","degree":1,"vertices":[[0,0,1],[1,1,1],[2,0]]}"#,
        "",
        "curve 1 “hull”, vertex 2 has 2 numbers where others have 3: give all of them as many",
    );
    check(
        "",
        r#"{"name":"scan","points":[[0,0],[1,1,0],[2,0]]}"#,
        "reference 1 “scan”, point 0 has 2 numbers where others have 3: give all of them as many",
    );
}

#[test]
fn vertices_that_make_no_curve_are_refused_with_their_curve() {
    let vertices = r#""vertices":[[0,0],[1,2],[3,4]]"#;
    let check = |rest: &str, expected: &str| {
        let curve = format!(r#"{{"name":"hull",{rest}}}"#);
        check_curve(&curve, &format!("curve 2 “hull”{expected}"));
    };
    for degree in ["0", "26", "1e300"] {
        let shown = if degree == "1e300" {
            "18446744073709551615"
        } else {
            degree
        };
        check(
            &format!(r#""degree":{degree},{vertices}"#),
            &format!(": degree {shown} is out of range: a degree from 1 to 25 is needed"),
        );
    }
    check(
        &format!(r#""degree":3,{vertices}"#),
        ": 3 vertices are too few: an open curve of degree 3 needs at least 4",
    );
    check(
        &format!(r#""degree":2,{vertices},"weights":[1,2]"#),
        ": 2 weights for 3 vertices: give one weight a vertex, or none at all",
    );
    check(
        r#""degree":1,"vertices":[[0,0],[1,1]],"weights":[1]"#,
        ": 1 weight for 2 vertices: give one weight a vertex, or none at all",
    );
    check(
        r#""degree":1,"vertices":[[0,0]]"#,
        ": 1 vertex is too few: an open curve of degree 1 needs at least 2",
    );
    check(
        &format!(r#""degree":2,{vertices},"weights":[1,-2,1]"#),
        ", vertex 1: weight -2.0 cannot be used: weights are positive numbers from 1e-100 to 1e100",
    );
    check(
        r#""degree":1,"vertices":[[0,0],[1,1e200]]"#,
        ", vertex 1: coordinate y is 1e200, and only finite numbers up to 1e100 can be used",
    );
    check(
        &format!(r#""degree":2,{vertices},"polygon":"clamped","periodic":true"#),
        ": a periodic curve cannot be given by its clamped polygon, which starts and ends somewhere: give its float polygon, or make it open",
    );
    check(
        r#""degree":2,"polygon":"bezier","vertices":[[0,0],[1,2],[3,4],[5,6]]"#,
        ": 4 vertices do not make Bézier polygons of degree 2: the number must be a multiple of 2, plus 1",
    );
    check(
        &format!(
            r#""degree":2,{vertices},"targets":{{"end":{{"point":[0,0],"direction":[0,0]}}}}"#
        ),
        ": the target of the end has a direction of length 0: give another one, or null",
    );
    check(
        &format!(r#""degree":2,{vertices},"targets":{{"start":{{"point":[0,1e200]}}}}"#),
        ": the target of the start has the number 1e200: only numbers up to 1e100 can be used",
    );
}

fn number() -> impl Strategy<Value = f64> {
    any::<f64>().prop_map(|value| {
        if value.abs() <= MAX_MAGNITUDE {
            value
        } else {
            1.0 / 3.0
        }
    })
}

prop_compose! {
    fn any_curve()(
        degree in 1usize..=25,
        more in 0usize..5,
        planar in any::<bool>(),
        weighted in any::<bool>(),
    )(
        vertices in prop::collection::vec([number(), number(), number()], degree + 1 + more),
        weights in prop::collection::vec(1e-100..1e100f64, degree + 1 + more),
        name in "\\PC*[a-z#=,\"\n ]*x",
        degree in Just(degree), planar in Just(planar), weighted in Just(weighted),
        periodic in any::<bool>(),
        colour in any::<Option<[u8; 3]>>(),
        visible in any::<bool>(),
        locked in any::<bool>(),
        locked_vertices in prop::collection::vec(0..degree + 1, 0..3),
        start in any_target(), finish in any_target(),
    ) -> Curve {
        let vertices = vertices.into_iter().map(|[x, y, z]| {
            DVec3::new(x, y, if planar { 0.0 } else { z })
        });
        let weights = weighted.then_some(weights);
        let polygon = FloatPolygon::new(degree, vertices.collect(), weights, periodic);
        let curve = Curve::new(name, polygon.expect("valid by construction"));
        let locked_vertices = locked_vertices.into_iter().collect();
        let targets = EndTargets { start, finish };
        Curve { colour: colour.map(Colour), visible, locked, locked_vertices, targets, ..curve }
    }
}

prop_compose! {
    fn any_target()(
        point in prop::array::uniform3(number()),
        direction in prop::option::of(prop::array::uniform3(number())),
        normal in prop::option::of(prop::array::uniform3(number())),
        curvature in prop::option::of(number()),
        slope in prop::option::of(number()),
        given in any::<bool>(),
    ) -> Option<EndTarget> {
        let directed = |vector: [f64; 3]| Some(DVec3::from(vector)).filter(|v| *v != DVec3::ZERO);
        let target = EndTarget {
            point: point.into(),
            direction: direction.and_then(directed),
            normal: normal.and_then(directed),
            curvature,
            slope,
        };
        given.then_some(target)
    }
}

#[test]
fn what_version_1_holds_is_written_as_version_1() {
    let mut curve = line("arc");
    curve.locked = true;
    let target = EndTarget {
        point: DVec3::X,
        direction: Some(DVec3::Y),
        ..EndTarget::default()
    };
    curve.targets.start = Some(target);
    assert!(text_of(&[&curve]).contains("\"version\": 1"));
    let more = [
        EndTarget {
            curvature: Some(0.5),
            ..target
        },
        EndTarget {
            normal: Some(DVec3::Z),
            ..target
        },
        EndTarget {
            slope: Some(-0.0),
            ..target
        },
    ];
    for target in more {
        let mut curve = curve.clone();
        curve.targets.finish = Some(target);
        let text = text_of(&[&line("plain"), &curve]);
        assert!(text.contains("\"version\": 2"), "{text}");
        assert_eq!(curves_of(&text)[1], curve);
    }
    curve.locked_vertices.set(1, true);
    let text = text_of(&[&curve]);
    assert!(text.contains("\"version\": 2"), "{text}");
    assert!(text.contains("\"locked_vertices\": [1]"), "{text}");
    assert_eq!(curves_of(&text)[0], curve);
}

#[test]
fn keys_of_version_2_mean_nothing_in_version_1() {
    let text = r#"{"format":"batten","version":1,"curves":[{"degree":1,"vertices":[[0,0],[1,2]],
        "locked_vertices":[9],"targets":{"end":{"point":[0,0],"slope":"steep"}}}]}"#;
    let reading = read(text.as_bytes()).unwrap();
    let curve = &reading.curves[0];
    assert!(curve.locked_vertices.is_empty());
    assert_eq!(curve.targets.finish.unwrap().slope, None);
    assert_eq!(
        curve.extras.iter().collect::<Vec<_>>(),
        [("locked_vertices", "[9]")]
    );
    assert_eq!(
        reading.remarks.to_string(),
        "curve 1 “curve 1”: the key “slope” of its targets is not known, has no effect and is not \
         kept\ncurve 1 “curve 1”: the key “locked_vertices” is not known and has no effect"
    );
    // Kept as it is, also when the file becomes one of version 2.
    let mut curve = Curve::clone(curve);
    curve.locked_vertices.set(0, true);
    curve.extras = Extras::default();
    curve.extras.push("more", "1e999");
    assert_eq!(curves_of(&text_of(&[&curve])), [curve]);
}

#[test]
fn groups_are_kept_and_make_a_file_one_of_version_2() {
    let curve = line("keel").in_group("Hull/1\\/2".into());
    let text = text_of(&[&line("plain"), &curve]);
    assert!(text.contains("\"version\": 2"), "{text}");
    assert!(text.contains(r#""group": "Hull/1\\/2""#), "{text}");
    assert_eq!(text.matches("group").count(), 1, "{text}");
    assert_eq!(curves_of(&text), [line("plain"), curve]);

    let circle = ReferenceCurve::from_text("circle").unwrap();
    let circle = Reference::new("circle", circle).in_group("Hull".into());
    let document = Document::default().with_references([circle.clone()]);
    let written = PROJECT.write(&document, None).unwrap();
    assert_eq!(read(&written.bytes).unwrap().references, [circle.into()]);
}

#[test]
fn a_group_in_a_file_of_version_1_is_an_unknown_key() {
    let text = r#"{"format":"batten","version":1,"curves":[{"name":"a","group":5,"degree":1,
        "vertices":[[0,0],[1,2]]}]}"#;
    let [curve] = &curves_of(text)[..] else {
        panic!("one curve");
    };
    assert!(curve.group.is_none());
    assert_eq!(curve.extras.iter().collect::<Vec<_>>(), [("group", "5")]);
    let written = text_of(&[curve]);
    assert!(written.contains("\"version\": 1"), "{written}");
    assert_eq!(curves_of(&written), std::slice::from_ref(curve));

    // In version 2 it would have another meaning: it goes.
    for group in ["", "Deck"] {
        let mut locked = curve.clone().in_group(group.into());
        locked.locked_vertices.set(0, true);
        let read = curves_of(&text_of(&[&locked]));
        locked.extras = Extras::default();
        assert_eq!(read, [locked]);
    }
}

#[test]
fn a_group_that_is_no_text_is_refused_with_its_place() {
    let text = r#"{"format":"batten","version":2,"curves":[{"group":["a"],"degree":1,
        "vertices":[[0,0],[1,2]]}]}"#;
    let error = read(text.as_bytes()).unwrap_err().to_string();
    assert!(error.starts_with("line 1, column 50, curve 1: "), "{error}");
}

#[test]
fn wrong_content_of_version_2_is_refused_with_its_place() {
    for (content, expected) in [
        (
            r#""locked_vertices":[2]"#,
            "curve 1 “arc”: vertex 2 does not exist: the polygon has 2 vertices, counted from 0",
        ),
        (
            r#""locked_vertices":[0,1.5]"#,
            "line 1, column 116, curve 1: 1.5 cannot be counted from 0: a whole number is needed",
        ),
        (
            r#""targets":{"end":{"point":[0,0],"curvature":1e101}}"#,
            "curve 1 “arc”: the target of the end has the number 1e101: only numbers up to 1e100 \
             can be used",
        ),
        (
            r#""targets":{"start":{"point":[0,0],"normal":[0,0,0]}}"#,
            "curve 1 “arc”: the target of the start has a normal of length 0: give another one, or \
             null",
        ),
    ] {
        let curve = format!(r#"{{"name":"arc","degree":1,"vertices":[[0,0],[1,2]],{content}}}"#);
        let text = format!(r#"{{"format":"batten","version":2,"curves":[{curve}]}}"#);
        assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), expected);
    }
}

fn bits(curve: &Curve) -> Vec<u64> {
    let vertices = curve.polygon.vertices().iter();
    let numbers = vertices.flat_map(|vertex| vertex.to_array());
    let weights = curve.polygon.weights().into_iter().flatten().copied();
    numbers.chain(weights).map(f64::to_bits).collect()
}

proptest! {
    #![proptest_config(repeatable::repeatable())]

    #[test]
    fn every_curve_survives_bit_for_bit(curve in any_curve()) {
        let back = read(text_of(&[&curve]).as_bytes()).expect("what is written is read").curves;
        prop_assert_eq!(bits(&back[0]), bits(&curve));
        prop_assert_eq!(&*back[0], &curve);
    }

    #[test]
    fn every_polygon_survives_a_table_bit_for_bit(mut curve in any_curve()) {
        curve.name = curve.name.trim().to_owned();
        let document = Document::from_curves([curve.clone()]);
        let bytes = TABLE.write(&document, None).expect("one curve").bytes;
        let back = TABLE.read(&bytes).expect("what is written is read").curves;
        prop_assert_eq!(bits(&back[0]), bits(&curve));
        prop_assert_eq!((&back[0].name, &back[0].polygon), (&curve.name, &curve.polygon));
    }

    #[test]
    fn no_bytes_make_the_readers_panic(
        bytes in prop::collection::vec(any::<u8>(), 0..200),
        cut in 0usize..400,
        at in 0usize..400,
        other in any::<u8>(),
    ) {
        let table = "# one\n# degree=1\nx;y\n0;1,5\n\"# two\"\n2,25;3\n";
        let mut texts = [text_of(&[&line("arc")]), table.to_owned()].map(String::into_bytes);
        for text in &mut texts {
            text.truncate(cut);
            if let Some(byte) = text.get_mut(at) {
                *byte = other;
            }
        }
        let [text, table] = texts;
        for input in [bytes, text, table] {
            // Whatever it is, the message can be shown.
            for format in [&PROJECT, &TABLE] {
                if let Err(error) = format.read(&input) {
                    prop_assert!(!error.to_string().is_empty());
                }
            }
        }
    }
}

#[test]
fn arrays_in_place_of_objects_are_refused() {
    check_curve(
        r#"["hull",1,"float",null,true,false,[[0,0],[1,2]],null,false]"#,
        "line 2, column 0, curve 2: invalid type: sequence, expected a curve, which is a JSON object",
    );
    let with_targets = |targets: &str, expected: &str| {
        let curve = format!(r#"{{"degree":1,"vertices":[[0,0],[1,2]],"targets":{targets}}}"#);
        check_curve(&curve, expected);
    };
    with_targets(
        r#"[{"point":[0,0]}]"#,
        "line 2, column 47, curve 2: invalid type: sequence, expected the targets of a curve, which are a JSON object",
    );
    with_targets(
        r#"{"end":[[0,0],[1,0]]}"#,
        "line 2, column 54, curve 2: invalid type: sequence, expected a target, which is a JSON object",
    );
}

#[test]
fn long_texts_of_a_file_are_cut_in_messages() {
    let long = "x".repeat(100_000);
    let turned = "a\u{202e}b\u{2066}";
    let texts = [
        format!(r#"{{"format":"{long}","version":1}}"#),
        format!(r#"{{"format":{{"{long}":1}},"version":1}}"#),
        format!(r#"{{"format":"batten","version":"{long}"}}"#),
        format!(r#"{{"format":"batten","version":1,"curves":"{long}"}}"#),
        format!(r#"{{"format":"batten","version":1,"curves":[{{"degree":"{long}"}}]}}"#),
        format!(r#"{{"format":"batten","version":1,"curves":[{{"polygon":"{long}"}}]}}"#),
        format!(r#"{{"format":"batten","version":1,"curves":[{{"colour":"{long}"}}]}}"#),
    ];
    for text in texts {
        let message = read(text.as_bytes()).unwrap_err().to_string();
        let length = message.chars().count();
        assert!(message.contains('…') && length < 300, "{length}");
        let text = text.replace(&long, turned);
        let message = read(text.as_bytes()).unwrap_err().to_string();
        assert!(!message.contains(['\u{202e}', '\u{2066}']), "{message}");
        assert!(message.contains("\\u{202e}"), "{message}");
    }
}

/// Two lines, the second of which goes on from the first.
const MATCHED: &str = r#"{"format":"batten","version":2,"curves":[
  {"name":"a","degree":1,"vertices":[[0,0],[1,2]]},{"name":"b","degree":1,"vertices":[[1,2],[3,3]]}],
  "matches":[MATCH]}"#;

#[test]
fn matches_are_read_and_written() {
    for (at, place) in [
        ("\"start\"", MatchPlace::End(End::Start)),
        ("\"end\"", MatchPlace::End(End::Finish)),
        ("0.25", MatchPlace::Parameter(0.25)),
    ] {
        for (reversed, written) in [(true, ",\"reversed\":true"), (false, "")] {
            let matched = format!(
                r#"{{"curve":1,"end":"start","source":0,"at":{at},"continuity":"G2"{written},"more":1}}"#
            );
            let text = MATCHED.replace("MATCH", &matched);
            let reading = read(text.as_bytes()).unwrap();
            let expected = FileMatch {
                curve: 1,
                end: End::Start,
                source: MatchSource::Curve(0),
                place,
                continuity: Continuity::G2,
                reversed,
            };
            assert_eq!(reading.matches, [expected]);
            assert_eq!(
                reading.remarks.to_string(),
                "the key “more” of the matches is not known, has no effect and is not kept"
            );
            let document = reading.clone().into_document().unwrap();
            let bytes = PROJECT.write(&document, None).unwrap().bytes;
            let back = read(&bytes).unwrap();
            assert_eq!(
                (back.curves, back.matches),
                (reading.curves, reading.matches)
            );
        }
    }
}

#[test]
fn matches_that_cannot_be_are_refused() {
    let matched = |curve: &str, source: &str, at: &str| {
        format!(
            r#"{{"curve":{curve},"end":"start","source":{source},"at":{at},"continuity":"G1"}}"#
        )
    };
    let circle = [matched("1", "0", "\"end\""), matched("0", "1", "1")].join(",");
    for (matches, expected) in [
        (
            matched("1", "2", "0"),
            "a match names curve 2, and there are 2, counted from 0",
        ),
        (
            matched("1", "1", "0"),
            "the project's matches are impossible: “b” cannot be matched to itself: choose another curve",
        ),
        (
            matched("1", "0", "1.5"),
            "the project's matches are impossible: “b” cannot be matched to “a”: an end needs an open \
             curve, and u must lie on the curve",
        ),
        (
            circle,
            "the project's matches are impossible: “b” follows “a” already: remove that match first",
        ),
        (
            matched("1", "0", "\"middle\""),
            "line 3, column 62: \"start\", \"end\" or a number is needed",
        ),
        (
            matched("1", "-1", "0"),
            "line 3, column 49: -1 cannot be counted from 0: a whole number is needed",
        ),
    ] {
        let text = MATCHED.replace("MATCH", &matches);
        assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), expected);
    }
}

#[test]
fn brackets_without_end_are_told_by_their_place() {
    let error = |text: &str| PROJECT.read(text.as_bytes()).unwrap_err().to_string();
    let count = 1_000_000;
    let expected = format!("line 1, column {count}: EOF while parsing a list");
    assert_eq!(error(&"[".repeat(count)), expected);
    assert!(error("[1, 2]").starts_with("this is not a Batten project"));
}

#[test]
fn guides_are_kept_by_coordinate_and_unknown_to_version_1() {
    let lines = [(0, 12.5), (1, -0.1), (1, 80.0), (2, 1e-300)];
    let lines = lines.map(|(axis, at)| GuideLine { axis, at });
    let document = Document::default().with_guide_lines(lines);
    let bytes = PROJECT.write(&document, None).unwrap().bytes;
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains("\"version\": 2"), "{text}");
    let reading = read(text.as_bytes()).unwrap();
    assert!(reading.remarks.is_empty(), "{}", reading.remarks);
    assert!(reading.into_document().unwrap().is_same(&document));
    // Older programs keep the key.
    let older = read(text.replace("\"version\": 2", "\"version\": 1").as_bytes()).unwrap();
    assert!(older.extras.iter().any(|(key, _)| key == "guides"));
    let more = text.replace("\"guides\": {", "\"guides\": {\"w\": [1],");
    let remarks = read(more.as_bytes()).unwrap().remarks.to_string();
    assert_eq!(
        remarks,
        "the project's key “w” is not known and has no effect"
    );
}
