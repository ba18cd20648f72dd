//! `batten apply` from a shell.

use std::fs;

use serde_json::{Value, json};

use super::folder::*;

/// The keys that every report has.
const KEYS: [&str; 9] = [
    "operation",
    "reached",
    "residual",
    "deviation",
    "deviation_is",
    "largest_move",
    "features_before",
    "features_after",
    "remarks",
];

/// The keys of the features of each curve.
const COUNTS: [&str; 10] = [
    "largest_curvature",
    "name",
    "inflections",
    "curvature_extrema",
    "torsion_zeros",
    "torsion_extrema",
    "cusps",
    "undecided",
    "monotone",
    "harmony",
];

/// A folder with an example.
fn with_example(name: &str) -> (Folder, String) {
    let folder = Folder::new();
    let file = format!("{name}.batten");
    folder.done(&["example", name, &file]);
    (folder, file)
}

/// Apply an operation and read its report.
fn report(folder: &Folder, arguments: &[&str]) -> Value {
    let (out, err) = folder.done(&[&["apply"], arguments].concat());
    assert_eq!(err, "");
    serde_json::from_str(&out).unwrap()
}

fn curves(folder: &Folder, file: &str) -> Value {
    folder.inspect(&[file])["curves"].clone()
}

fn keys(value: &Value) -> Vec<&str> {
    value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

/// Targets beside both ends of a curve.
fn with_targets(folder: &Folder, file: &str, off: f64) {
    let text = fs::read_to_string(folder.path(file)).unwrap();
    let mut project: Value = serde_json::from_str(&text).unwrap();
    let ends = curves(folder, file)[0]["ends"].clone();
    let target = |end: &str| {
        let point = numbers(&ends[end]["point"]);
        let tangent = numbers(&ends[end]["tangent"]);
        json!({
            "point": [point[0] + off, point[1] - off],
            "direction": [tangent[0] - 0.1 * tangent[1], tangent[1] + 0.1 * tangent[0]],
        })
    };
    project["curves"][0]["targets"] = json!({"start": target("start"), "end": target("end")});
    fs::write(folder.path(file), project.to_string()).unwrap();
}

#[test]
fn every_operation_is_listed_has_help_and_reports_by_one_schema() {
    let (folder, file) = with_example("hull");
    with_targets(&folder, &file, 30.0);
    let (list, _) = folder.done(&["apply", "--list"]);
    let names: Vec<&str> = list
        .lines()
        .filter_map(|line| line.split(' ').next())
        .collect();
    assert!(names.contains(&"reverse") && names.contains(&"correct-ends"));
    let round =
        json!({"name": "round", "kind": "circle", "values": {"radius": 2}, "interval": [0, 3]});
    let round = json!({"format": "batten", "version": 2, "curves": [], "references": [round]});
    std::fs::write(folder.path("round.batten"), round.to_string()).expect("a file");
    for name in names {
        let (help, _) = folder.done(&["apply", name, "--help"]);
        for word in ["<OUT>", "--to-format"] {
            assert!(help.contains(word), "{name}: {word} in {help}");
        }
        // Where nothing is read there is no IN.
        let reads = !["mineur-farin", "between"].contains(&name);
        let source = match name {
            "approximate" => "<REFERENCE|IN>",
            _ => "<IN>",
        };
        for word in [source, "--from-format"] {
            assert_eq!(help.contains(word), reads, "{name}: {word} in {help}");
        }
        assert_eq!(help.contains("--curve <NAME>"), reads, "{name}: {help}");
        let read = match name {
            "mineur-farin" | "between" => &[name, "out.batten"][..],
            // A copy goes on from its curve where it may move.
            "join" => &[name, &file, &file, "out.batten", "--move-second"],
            "to-float" => &[name, "round.batten", "out.batten"],
            // The hull's middle.
            "make-symmetric" => &[
                name,
                &file,
                "out.batten",
                "--from",
                "4200,0",
                "--to",
                "4200,1",
            ],
            _ => &[name, &file, "out.batten"],
        };
        let report = report(&folder, read);
        assert_eq!(report["operation"], name);
        assert_eq!(report["reached"], true);
        let found = keys(&report);
        assert!(
            KEYS.iter().all(|key| found.contains(key)),
            "{name}: {found:?}"
        );
        for side in ["features_before", "features_after"] {
            for counts in report[side].as_array().unwrap() {
                let found = keys(counts);
                assert_eq!(found.len(), COUNTS.len());
                assert!(
                    COUNTS.iter().all(|key| found.contains(key)),
                    "{name}: {found:?}"
                );
            }
        }
        folder.inspect(&["out.batten"]);
    }
    let (help, _) = folder.done(&["--help"]);
    assert!(help.contains("apply"), "{help}");
}

#[test]
fn help_describes_each_parameter_with_range_and_default() {
    let folder = Folder::new();
    for (operation, words) in [
        (
            "trim",
            &[
                "--from <U>",
                "a parameter u, at least 0 and less than the number of segments; default: 0",
                "--to <U>",
                "default: the number of segments",
                "--subdivisions <COUNT>",
                "a whole number; default: automatic",
            ][..],
        ),
        (
            "reduce-degree",
            &[
                "--degree <N>",
                "a whole number, 1 to the degree − 1; default: the degree − 1",
            ],
        ),
        (
            "correct-ends",
            &[
                "--method <WORD>",
                "[default: joint]",
                "- joint: Both ends at once",
                "- steps: Step by step",
                "--tolerance <LENGTH>",
                "a length, more than 0; default: 1e-9 of the size of the polygon",
            ],
        ),
        (
            "extend",
            &[
                "--end <WORD>",
                "[default: end]",
                "a whole number, 1 to 10000; default: 1",
            ],
        ),
        (
            "round",
            &[
                "- float:",
                "- clamped:",
                "a whole number, 0 to 17; default: 3",
            ],
        ),
    ] {
        let (help, _) = folder.done(&["apply", operation, "--help"]);
        for words in words {
            assert!(help.contains(words), "{words} in {help}");
        }
    }
}

/// The command line of the paper's figure 2.
#[test]
fn a_mineur_farin_curve_is_made_of_its_parameters_alone() {
    let folder = Folder::new();
    let legs = [
        "--legs", "4", "--ratio", "2", "--angle", "90", "--degree", "4",
    ];
    let figure_2 = |polygon: &str, more: &[&str]| {
        let mut arguments = vec!["mineur-farin", "out.batten", "--polygon", polygon];
        arguments.extend(legs.iter().chain(more));
        report(&folder, &arguments)
    };
    let verdicts = |report: &Value| {
        let after = report["features_after"].as_array().unwrap();
        let verdicts = after.iter().map(|counts| counts["monotone"].clone());
        verdicts.collect::<Vec<Value>>()
    };
    let float = figure_2("float", &[]);
    assert_eq!(verdicts(&float), ["proved"]);
    assert_eq!(
        (&float["reached"], &float["deviation"]),
        (&json!(true), &json!(0.0))
    );
    assert_eq!(curves(&folder, "out.batten")[0]["degree"], 4);
    let bezier = figure_2("bezier", &[]);
    assert_eq!(verdicts(&bezier), ["disproved"]);
    assert_eq!(bezier["bezier_monotone"], false);
    let both = figure_2("both", &["--start", "-1,2", "--first-leg=-3,0"]);
    assert_eq!(verdicts(&both), ["proved", "disproved"]);
    assert_eq!(curves(&folder, "out.batten").as_array().unwrap().len(), 2);
    let in_space = figure_2("float", &["--torsion", "-20"]);
    assert_eq!(in_space["features_after"][0]["torsion_zeros"], 0);
    folder.misused(
        &["apply", "mineur-farin", "out.batten", "--legs", "3"],
        "4 vertices are too few: an open curve of degree 5 needs at least 6",
    );
}

#[test]
fn splitting_writes_both_parts_and_reports_features() {
    let (folder, file) = with_example("s-curve");
    let report = report(&folder, &["split", &file, "out.csv", "--at", "1"]);
    let parts = curves(&folder, "out.csv");
    let before = curves(&folder, &file)[0].clone();
    assert_eq!(parts.as_array().unwrap().len(), 2);
    let vertices = before["float"].as_array().unwrap();
    assert_eq!(parts[0]["float"], json!(vertices[..6]));
    assert_eq!(parts[1]["float"], json!(vertices[1..]));
    assert_eq!(report["deviation"], 0.0);
    assert_eq!(report["largest_move"], json!(null));
    assert_eq!(report["first_vertices"], 6);
    assert_eq!(report["second_vertices"], 9);
    let told = |side: &str| -> Vec<(String, u64)> {
        let counts = report[side].as_array().unwrap().iter();
        let told = counts.map(|counts| {
            let extrema = counts["curvature_extrema"].as_u64().unwrap();
            (counts["name"].as_str().unwrap().to_owned(), extrema)
        });
        told.collect()
    };
    assert_eq!(told("features_before"), [("s-curve".to_owned(), 2)]);
    assert_eq!(
        told("features_after"),
        [("s-curve".to_owned(), 1), ("s-curve 2".to_owned(), 1)]
    );
    // What is reported is what inspect finds.
    for part in 0..2 {
        let found = parts[part]["features"]["curvature_extrema"]
            .as_array()
            .unwrap();
        assert_eq!(found.len(), 1);
    }
}

#[test]
fn a_file_may_be_replaced_by_its_own_result_and_keeps_what_is_unknown() {
    let curve = |name: &str, note: &str| {
        let vertices = [[0, 0], [1, 2], [3, 2], [4, 0]];
        json!({"name": name, "degree": 3, "vertices": vertices, "note": note})
    };
    let mut text: Value =
        serde_json::from_str(&project(json!([curve("a", "x"), curve("b", "y")]))).unwrap();
    text["client"] = json!("K & Söhne");
    let folder = Folder::new().with("two.batten", text.to_string());
    let arguments = [
        "apply",
        "reverse",
        "two.batten",
        "two.batten",
        "--curve",
        "b",
    ];
    let (out, err) = folder.done(&arguments);
    assert!(out.contains("\"reached\": true"), "{out}");
    assert!(err.contains("note") && err.contains("client"), "{err}");
    let after: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("two.batten")).unwrap()).unwrap();
    assert_eq!(after["client"], "K & Söhne");
    let found = after["curves"].as_array().unwrap().iter();
    let found = found.map(|curve| {
        (
            &curve["name"],
            &curve["note"],
            numbers(&curve["vertices"][0]),
        )
    });
    assert_eq!(
        found.collect::<Vec<_>>(),
        [
            (&json!("a"), &json!("x"), vec![0.0, 0.0]),
            (&json!("b"), &json!("y"), vec![4.0, 0.0])
        ]
    );
}

#[test]
fn the_curve_must_be_told_where_there_are_several() {
    let curve = |name: &str| json!({"name": name, "degree": 1, "vertices": [[0, 0], [1, 2]]});
    let names = ["hull", "deck", "deck"];
    let folder = Folder::new()
        .with("three.batten", project(json!(names.map(curve))))
        .with("none.batten", project(json!([])))
        .with("scan.dat", "0 0\n1 2\n3 1\n");
    let refused = |file: &str, more: &[&str], expected: &str| {
        let arguments = [&["apply", "reverse", file, "out.batten"], more].concat();
        folder.refused(&arguments, &format!("{file}: {expected}"));
        assert!(!folder.path("out.batten").exists());
    };
    refused(
        "three.batten",
        &[],
        "choose one with --curve: there are “hull”, “deck”, “deck”",
    );
    refused(
        "three.batten",
        &["--curve", "keel"],
        "there is no curve “keel”: there are “hull”, “deck”, “deck”",
    );
    refused(
        "three.batten",
        &["--curve", "deck"],
        "there are 2 curves “deck”: give them different names first",
    );
    refused("none.batten", &[], "there is no curve");
    refused(
        "scan.dat",
        &[],
        "there is no curve, only points: make a curve of them with batten apply fit",
    );
    folder.done(&[
        "apply",
        "reverse",
        "three.batten",
        "out.batten",
        "--curve",
        "hull",
    ]);
}

#[test]
fn two_curves_are_joined_from_one_file_or_two() {
    let line = |name: &str, x: f64| {
        let vertices = [0.0, 1.0, 2.0, 3.0, 4.0].map(|along| [x + along, 0.0]);
        json!({"name": name, "degree": 3, "vertices": vertices})
    };
    let folder = Folder::new()
        .with(
            "both.batten",
            project(json!([line("a", 0.0), line("b", 9.0)])),
        )
        .with("a.batten", project(json!([line("a", 0.0)])))
        .with(
            "b.batten",
            project(json!([line("a", 9.0), line("other", 50.0)])),
        );
    let vertices = |file: &str| -> Vec<Vec<f64>> {
        let text = fs::read_to_string(folder.path(file)).expect("a file");
        let project: Value = serde_json::from_str(&text).expect("a project");
        let curves = project["curves"].as_array().expect("curves");
        assert_eq!(curves.len(), 1);
        assert_eq!(curves[0]["name"], "a");
        let vertices = curves[0]["vertices"].as_array().expect("vertices");
        vertices.iter().map(numbers).collect()
    };
    let (out, _) = folder.done(&["apply", "join", "both.batten", "one.batten"]);
    let report: Value = serde_json::from_str(&out).expect("a report");
    assert_eq!(
        (&report["bridge"], &report["reached"]),
        (&json!(4), &json!(true))
    );
    assert_eq!(
        report["joined"],
        json!({ "first": "end", "second": "start" })
    );
    let two = [
        "apply",
        "join",
        "a.batten",
        "b.batten",
        "two.batten",
        "--with",
        "a",
    ];
    folder.done(&[&two[..], &["--bridge", "4"]].concat());
    // Options may stand between the files.
    folder.done(&[
        "apply",
        "join",
        "a.batten",
        "--with",
        "a",
        "b.batten",
        "--bridge=4",
        "two.batten",
    ]);
    for file in ["one.batten", "two.batten"] {
        for (index, vertex) in vertices(file).iter().enumerate() {
            assert!((vertex[0] - index as f64).abs() < 1e-9, "{vertex:?}");
        }
    }
    folder.done(&[&two[..], &["--bridge=0", "--move-second"]].concat());
    assert!((vertices("two.batten")[9][0] - 9.0).abs() < 1e-9);
    folder.refused(
        &["apply", "join", "a.batten", "b.batten", "none.batten"],
        "b.batten: choose one with --with: there are “a”, “other”",
    );
    folder.refused(
        &["apply", "join", "a.batten", "none.batten"],
        "a.batten: choose two with --curve and --with: there is “a”",
    );
    assert!(!folder.path("none.batten").exists());
}

#[test]
fn what_is_not_reached_is_reported_and_nothing_is_written() {
    let (folder, file) = with_example("arc");
    with_targets(&folder, &file, 0.3);
    let arguments = [
        "apply",
        "correct-ends",
        &file,
        "out.batten",
        "--method",
        "steps",
    ];
    let output = folder.run(&arguments);
    let (out, err) = texts(&output);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(
        err.contains("missed by "),
        "the miss is more than rounding: {err}"
    );
    assert!(
        err.starts_with("batten: Correct ends: not reached, nothing is changed; "),
        "{err}"
    );
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(found["reached"], false);
    assert!(found["residual"].as_f64().unwrap() > 1e-3);
    assert!(found["passes"].as_u64().unwrap() > 0);
    assert_eq!(found["features_before"], found["features_after"]);
    assert!(!folder.path("out.batten").exists());
    // With the curve on the standard output the report stands alone on the standard error.
    let arguments = [
        "apply",
        "correct-ends",
        &file,
        "-",
        "--to-format",
        "csv",
        "--method",
        "steps",
    ];
    let output = folder.run(&arguments);
    let (out, err) = texts(&output);
    assert_eq!((output.status.code(), out.as_str()), (Some(1), ""));
    assert_eq!(serde_json::from_str::<Value>(&err).unwrap(), found);
    let found = report(&folder, &["correct-ends", &file, "out.batten"]);
    assert_eq!(found["reached"], true);
    assert!(found["residual"].as_f64().unwrap() < 1e-8);
    assert!(found["largest_move"]["distance"].as_f64().unwrap() > 0.0);
}

#[test]
fn the_curve_may_come_and_go_by_pipes() {
    let (folder, file) = with_example("hexagon");
    let (project, err) = folder.done(&["apply", "subdivide", &file, "-", "--to-format", "batten"]);
    let report: Value = serde_json::from_str(&err).unwrap();
    assert_eq!(report["segments"], 2);
    let written: Value = serde_json::from_str(&project).unwrap();
    assert_eq!(
        written["curves"][0]["vertices"].as_array().unwrap().len(),
        5
    );
    folder.misused(&["apply", "reverse", "-", "out.csv"], "--from-format says");
    folder.misused(&["apply", "reverse", &file, "-"], "--to-format says");
}

#[test]
fn bad_values_and_bad_usage_are_told_apart() {
    let (folder, file) = with_example("hull");
    let split = |at: &'static str| ["apply", "split", "hull.batten", "out.batten", "--at", at];
    // Only the curve tells that there is no such place.
    folder.refused(
        &split("10.5"),
        "hull.batten: At u: 10.5 is out of range: more than 0 and less than 10 is needed",
    );
    for at in ["-1", "0", "NaN", "inf", "here", ""] {
        folder.misused(&split(at), "At u: ");
    }
    let apply = |arguments: &[&'static str]| [&["apply"], arguments].concat();
    for (arguments, expected) in [
        (
            &["revers", "a.batten", "b.batten"][..],
            "a similar subcommand exists: 'reverse'",
        ),
        (&["reverse"], "required"),
        (&["reverse", "a.batten"], "required"),
        (
            &["reverse", "a.batten", "b.batten", "--at", "1"],
            "unexpected argument",
        ),
        (
            &["round", "a.batten", "b.batten", "--polygon", "bezier"],
            "possible values: float, clamped",
        ),
        (
            &["round", "a.batten", "b.batten", "--digits", "18"],
            "0 to 17 is needed",
        ),
        (
            &["extend", "a.batten", "b.batten", "--segments", "1.5"],
            "a whole number",
        ),
        (
            &["--list", "reverse", "a.batten", "b.batten"],
            "cannot be used with",
        ),
        (
            &["harmonise", "a.batten", "b.batten", "--extrema", ""],
            "Curvature extrema: a whole number is needed",
        ),
        (
            &["harmonise", "a.batten", "b.batten", "--locked", "1,x"],
            "Also hold vertices: whole numbers, separated by commas are needed",
        ),
        (&[], "Usage"),
    ] {
        folder.misused(&apply(arguments), expected);
    }
    folder.refused(
        &["apply", "correct-ends", "hull.batten", "out.batten", "--start-normal", "0,0,1"],
        "hull.batten: Start normal: only a curve in space has this, and the curve lies in the plane z = 0",
    );
    folder.refused(
        &["apply", "reverse", &file, "out.docx"],
        "out.docx: “.docx” is not a format Batten knows: use one of .batten, .csv, .tsv, .dat, .txt, .xyz, .pts, .asc, .xy, .dxf, .step, .stp, .p21, .ap242, .igs, .iges, .3dm, .svg, .glif, .obj, .brep, .brp, .json",
    );
    folder.refused(
        &["apply", "translate-end", &file, "out.batten"],
        "hull.batten: no end of the curve has a target: set one first, or give “Correct ends” what you want by values",
    );
    assert_eq!(fs::read_dir(folder.path(".")).unwrap().count(), 1);
}

#[test]
fn a_locked_curve_is_not_changed() {
    let curve = json!([{"name": "a", "degree": 1, "vertices": [[0, 0], [1, 2]], "locked": true}]);
    let folder = Folder::new().with("a.batten", project(curve));
    folder.refused(
        &["apply", "reverse", "a.batten", "b.batten"],
        "a.batten: “a” is locked: unlock it in the list of curves to change its shape",
    );
}

/// A table of a degree-5 arc whose vertices are off it by turns.
fn ripple() -> String {
    let rows = (0..20).map(|index| {
        let (sine, cosine) = (0.1 * f64::from(index)).sin_cos();
        let radius = 10.0 + if index % 2 == 0 { 0.05 } else { -0.05 } + 0.02 * f64::from(index);
        format!("{},{}\n", radius * cosine, radius * sine)
    });
    format!("# degree=5\nx,y\n{}", rows.collect::<String>())
}

#[test]
fn harmonise_writes_what_it_reaches_and_the_best_only_if_wanted() {
    let folder = Folder::new().with("ripple.csv", ripple());
    let file = "ripple.csv";
    let asked = ["--extrema", "0", "--inflections", "0"];
    let found = report(
        &folder,
        &[&["harmonise", file, "fair.csv"][..], &asked[..]].concat(),
    );
    assert_eq!(found["reached"], true);
    assert_eq!(found["features_after"][0]["curvature_extrema"], 0);
    assert_eq!(found["features_after"][0]["undecided"], 0);
    assert!(found["iterations"].as_u64().is_some_and(|count| count > 0));
    for (best, written) in [(false, false), (true, true)] {
        let mut arguments = vec![
            "apply",
            "harmonise",
            &file,
            "best.csv",
            "--max-deviation",
            "1e-9",
        ];
        arguments.extend(asked);
        if best {
            arguments.push("--best");
        }
        let output = folder.run(&arguments);
        assert_eq!(output.status.code(), Some(1));
        let text = String::from_utf8(output.stdout).expect("text");
        let told: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(told["reached"], false);
        assert_eq!(folder.path("best.csv").exists(), written);
    }
}

#[test]
fn values_of_lists_may_begin_with_a_minus_sign() {
    let folder = Folder::new().with("ripple.csv", ripple());
    let file = "ripple.csv";
    for given in [&["--start=-1,2"][..], &["--start", "-1,2"]] {
        let arguments = [&["correct-ends", file, "out.batten"][..], given].concat();
        let found = report(&folder, &arguments);
        assert_eq!(found["reached"], true, "{found}");
    }
    let output = folder.run(&["apply", "correct-ends", file, "no.csv", "--start", "1"]);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8(output.stderr).expect("text");
    assert!(
        text.contains("2 or 3 numbers, separated by commas"),
        "{text}"
    );
}

/// Two curves: the start of the second is matched to the end of the first, which has a locked vertex.
const MATCHED: &str = r#"{"format":"batten","version":2,"curves":[
  {"name":"first","degree":3,"vertices":[[0,0],[1.25,0.4],[2,1.3],[3.2,1.1],[4.1,0.6],[5,0.3]],
   "locked_vertices":[1]},
  {"name":"second","degree":3,"vertices":[[3.5,0.9],[4.2,0.7],[5,0.4],[6,0.2],[7,0.7],[8,1.5],[9,2]]}],
  "matches":[{"curve":1,"end":"start","source":0,"at":"end","continuity":"G1"}]}"#;

#[test]
fn matched_curves_follow_and_locked_vertices_stay() {
    let folder = Folder::new();
    fs::write(folder.path("in.batten"), MATCHED).unwrap();
    let rounded = [
        "round",
        "in.batten",
        "out.batten",
        "--curve",
        "first",
        "--digits",
        "0",
    ];
    let report = report(&folder, &rounded);
    assert_eq!(
        report["remarks"],
        json!([
            "Curvature extrema: 2 before, 4 now",
            "1 locked vertex keeps the coordinates",
            "“second” follows, by up to 0.27"
        ])
    );
    let text = fs::read_to_string(folder.path("out.batten")).unwrap();
    let project: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(project["version"], 2);
    assert_eq!(project["curves"][0]["locked_vertices"], json!([1]));
    let vertices = &project["curves"][0]["vertices"];
    assert_eq!(
        vertices,
        &json!([
            [0.0, 0.0],
            [1.25, 0.4],
            [2.0, 1.0],
            [3.0, 1.0],
            [4.0, 1.0],
            [5.0, 0.0]
        ])
    );
    assert_eq!(project["matches"][0]["at"], "end");
    let ends = |index: usize, end: &str, what: &str| {
        numbers(&curves(&folder, "out.batten")[index]["ends"][end][what])
    };
    for what in ["point", "tangent"] {
        let pairs = ends(0, "end", what).into_iter().zip(ends(1, "start", what));
        for (from, to) in pairs {
            assert!((from - to).abs() < 1e-12, "{what}: {from} {to}");
        }
    }
}

#[test]
fn exports_name_the_matches_and_locks_that_they_lose() {
    let folder = Folder::new();
    fs::write(folder.path("in.batten"), MATCHED).unwrap();
    for (file, format) in [("out.csv", "CSV table"), ("out.dxf", "DXF")] {
        let (_, told) = folder.done(&["convert", "in.batten", file]);
        let expected = [
            format!("“first”: vertex locks aren't stored in the {format}"),
            format!("“second”: the match of its start to “first” isn't stored in the {format}"),
        ];
        for line in expected {
            assert!(told.contains(&line), "{line}: {told}");
        }
    }
    let (_, told) = folder.done(&["convert", "in.batten", "out.batten"]);
    assert!(!told.contains("matched"), "{told}");
}

#[test]
fn a_reference_is_approximated_in_place_of_a_file() {
    let folder = Folder::new();
    let arguments = [
        "approximate",
        "conical-spiral",
        "spiral.batten",
        "--degree",
        "8",
    ];
    let by_steps = [
        "--method", "on-curve", "--from", "0", "--step", "1", "--count", "20",
    ];
    let found = report(&folder, &[&arguments[..], &by_steps].concat());
    assert_eq!(found["reached"], true);
    let off = found["deviation"].as_f64().unwrap();
    assert!((4.9..4.91).contains(&off), "{off}");
    assert_eq!(found["equivalence"][0]["equal"], true);
    assert_eq!(curves(&folder, "spiral.batten")[0]["degree"], 8);
    let to_tolerance = [
        "--from",
        "1",
        "--to",
        "6",
        "--tolerance",
        "1e-6",
        "--fit-ends",
    ];
    // It may take long enough to tell of its progress.
    let asked = [&["apply"], &arguments[..], &to_tolerance].concat();
    let (out, _) = folder.done(&asked);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(found["reached"], true);
    assert!(found["deviation"].as_f64().unwrap() <= 1e-6);
    assert!(found["end_error"].as_f64().unwrap() <= 1e-12);
    let again = [
        "approximate",
        "spiral.batten",
        "again.batten",
        "--degree",
        "5",
        "--count",
        "40",
    ];
    let found = report(&folder, &again);
    assert!(found["deviation"].as_f64().unwrap() < 0.01);
    let arguments = ["apply", "approximate", "circle:radius=x", "out.batten"];
    folder.misused(&arguments, "column 15: “x” means nothing here");
}

#[test]
fn references_of_a_project_are_approximated_and_inspected() {
    let project = json!({"format": "batten", "version": 2,
    "curves": [{"name": "line", "degree": 1, "vertices": [[0, 0], [0, 4]]}],
    "references": [
        {"name": "round", "kind": "circle", "values": {"radius": 2}, "interval": [0, 3],
         "scale": 2, "translation": [1, 0, 0]},
        {"name": "wave", "formula": {"x": "t", "y": "sin(t)"}, "interval": [0, 6]},
        {"name": "scan", "points": [[0, 0], [1, 2]]},
    ]});
    let folder = Folder::new().with("in.batten", project.to_string());
    let arguments = ["approximate", "in.batten", "out.batten", "--degree", "5"];
    let named = |name: &'static str| [&arguments[..], &["--curve", name]].concat();
    let found = report(&folder, &named("round"));
    assert!(found["deviation"].as_f64().unwrap() < 1e-4);
    let curves = curves(&folder, "out.batten");
    assert_eq!(curves.as_array().unwrap().len(), 2);
    let start = numbers(&curves[1]["ends"]["start"]["point"]);
    assert!(
        (start[0] - 5.0).abs() < 1e-4 && start[1].abs() < 1e-4,
        "{start:?}"
    );
    let refused = |arguments: &[&str], words: &str| {
        folder.refused(&[&["apply"], arguments].concat(), words);
    };
    refused(
        &arguments,
        "in.batten: choose one with --curve: there are “line”, “round”, “wave”, “scan”",
    );
    refused(
        &named("square"),
        "in.batten: there is no curve or reference “square”: there are “line”, “round”, “wave”, “scan”",
    );
    refused(
        &named("scan"),
        "in.batten: points have no derivatives, so they cannot be approximated: fit a curve to them",
    );
    let inspected = folder.inspect(&["in.batten"])["references"].clone();
    let round = json!({"name": "round", "group": "", "kind": "circle", "text": "circle:radius=2,from=0,to=3",
        "parameters": {"radius": 2.0}, "interval": [0.0, 3.0],
        "placement": {"rotation": [0.0, 0.0, 0.0, 1.0], "scale": 2.0, "translation": [1.0, 0.0, 0.0]},
        "features": {"sampled": true, "inflections": [], "curvature_extrema": [], "cusps": [],
            "curvature_jumps": []}});
    assert_eq!(inspected[0], round);
    assert_eq!(inspected[1]["parameters"], json!({"x": "t", "y": "sin(t)"}));
    let features = &inspected[1]["features"];
    let near = |found: &Value, expected: f64| (found.as_f64().unwrap() - expected).abs() < 1e-12;
    let pi = std::f64::consts::PI;
    assert!(near(&features["inflections"][0], pi), "{features}");
    let extrema = features["curvature_extrema"].as_array().unwrap();
    assert_eq!(extrema.len(), 2, "{features}");
    for (extremum, kind, place) in [
        (&extrema[0], "min", 0.5 * pi),
        (&extrema[1], "max", 1.5 * pi),
    ] {
        assert_eq!(extremum["kind"], kind);
        assert!(near(&extremum["t"], place), "{features}");
    }
    assert_eq!(
        inspected[2]["points"],
        json!([[0.0, 0.0, 0.0], [1.0, 2.0, 0.0]])
    );
    assert_eq!(inspected[2]["text"], Value::Null);
    // The only item needs no name.
    let only = json!({"format": "batten", "version": 2, "curves": [],
        "references": [{"name": "round", "kind": "circle", "values": {"radius": 2}, "interval": [0, 3]}]});
    let folder = Folder::new().with("in.batten", only.to_string());
    assert_eq!(report(&folder, &arguments)["reached"], true);
}

#[test]
fn references_are_listed_and_unknown_ones_named() {
    let folder = Folder::new();
    let (list, _) = folder.done(&["references"]);
    for line in [
        "circle  ",
        "  radius=1",
        "superspiral  ",
        "  a=0.5 ",
        "formula  ",
    ] {
        assert!(
            list.lines().any(|it| it.starts_with(line)),
            "{line}: {list}"
        );
    }
    let (help, _) = folder.done(&["apply", "approximate", "--help"]);
    assert!(
        help.contains("References: circle, ") && help.contains("“batten references”"),
        "{help}"
    );
    for word in ["cirle", "cirle:radius=3", "spiral:a=1"] {
        let arguments = ["apply", "approximate", word, "out.batten"];
        folder.misused(&arguments, "the references are circle, ");
    }
    let missing = ["apply", "approximate", "none.batten", "out.batten"];
    assert_eq!(folder.run(&missing).status.code(), Some(1));
}

#[test]
fn the_report_can_be_read_as_text() {
    let folder = Folder::new();
    let arguments = ["apply", "approximate", "clothoid", "out.batten", "--text"];
    let (out, _) = folder.done(&arguments);
    assert!(
        out.starts_with("Approximate: ") && out.contains("curvature level 1: "),
        "{out}"
    );
}

#[test]
fn a_reference_is_checked_only_where_it_is_used() {
    let folder = Folder::new();
    let formula = ["approximate", "formula:x=t;y=1/(t-0.3)", "out.batten"];
    let inside = [&["apply"], &formula[..]].concat();
    let place = "the curve has no point, or no direction, at t = 0.3: give an interval without this place with the reference, such as from=1 and to=2";
    folder.misused(&inside, place);
    // A pole that is a sample, and one that is none, are told alike.
    let sampled = ["apply", "approximate", "formula:x=t;y=1/t", "out.batten"];
    folder.misused(
        &sampled,
        "the curve has no point, or no direction, at t = 0: ",
    );
    let part = ["--from", "1", "--to", "2", "--degree", "5"];
    assert_eq!(
        report(&folder, &[&formula[..], &part].concat())["reached"],
        true
    );
    // The interval of the text does not count either, where another one is used.
    let wider = [
        "approximate",
        "formula:x=t;y=1/(t-0.3);from=1;to=2",
        "out.batten",
        "--from",
        "0",
    ];
    folder.misused(&[&["apply"], &wider[..]].concat(), place);
}

#[test]
fn what_the_arguments_alone_get_wrong_is_told_with_the_usage_of_the_operation() {
    let folder = Folder::new();
    for (arguments, expected) in [
        (
            &["approximate", "cirle", "out.batten"][..],
            "the references are circle, ",
        ),
        (
            &["approximate", "circle:radius=1/0", "out.batten"],
            "“1/0” divides by zero",
        ),
        (
            &["approximate", "circle:radius=sqrt(-1)", "out.batten"],
            "“sqrt(-1)” is not a real number",
        ),
        (
            &["approximate", "circle:radius=10^400", "out.batten"],
            "“10^400” is too large",
        ),
        (
            &["approximate", "formula:x=1;y=2", "out.batten"],
            "the formulas give one point",
        ),
        (
            &[
                "approximate",
                "circle",
                "out.batten",
                "--step",
                "1",
                "--to",
                "2",
            ],
            "Step and To cannot both be given",
        ),
        (
            &["between", "out.batten", "--from", "1,1", "--to", "1,1"],
            "both ends are at the same point",
        ),
    ] {
        let arguments = [&["apply"], arguments].concat();
        folder.misused(&arguments, expected);
        let (_, told) = texts(&folder.run(&arguments));
        let usage = format!("Usage: batten apply {} ", arguments[1]);
        assert!(told.contains(&usage), "{told}");
    }
    folder.done(&["example", "hull", "hull.batten"]);
    for option in ["--start-direction", "--end-direction"] {
        folder.misused(
            &[
                "apply",
                "correct-ends",
                "hull.batten",
                "out.batten",
                option,
                "0,0",
            ],
            "direction: a vector of length 0 has no direction",
        );
    }
    folder.misused(
        &[
            "apply",
            "approximate",
            "circle",
            "out.batten",
            "--tolerance",
            "0",
        ],
        "Tolerance: 0 is out of range",
    );
    assert!(!folder.path("out.batten").exists());
    // What a file must tell first is not.
    folder.refused(
        &["apply", "approximate", "none.batten", "out.batten"],
        "none.batten: cannot read the file: No such file or directory (os error 2)",
    );
}

#[test]
fn a_time_limit_is_a_day_at_most_and_told_with_few_digits() {
    let rows: String = (0..40)
        .map(|x| format!("{x},{}\n", f64::from(x * x % 7)))
        .collect();
    let folder = Folder::new().with("a.csv", format!("x,y\n{rows}"));
    let fit = |limit| ["apply", "fit", "a.csv", "b.batten", "--time-limit", limit];
    for limit in ["86401", "1e300"] {
        let expected =
            format!("Time limit: {limit} is out of range: more than 0 and at most 86400 is needed");
        folder.misused(&fit(limit), &expected);
    }
    folder.misused(&fit("0"), "Time limit: 0 is out of range");
    let (_, err) = texts(&folder.run(&fit("1e-300")));
    assert!(
        err.contains("The time limit of 1e-300 s ended the search"),
        "{err}"
    );
}

#[test]
fn steps_refuse_what_bends_an_end() {
    let (folder, file) = with_example("arc");
    for (name, label) in [
        ("end-curvature", "End curvature"),
        ("start-slope", "Start curvature slope"),
    ] {
        let option = format!("--{name}=0.1");
        let steps = [
            "apply",
            "correct-ends",
            &file,
            "out.batten",
            "--method",
            "steps",
            &option,
        ];
        let expected = format!(
            "{label}: the steps meet points and directions only: use “Both ends at once” (--method joint)"
        );
        folder.misused(&steps, &expected);
    }
    let (help, _) = folder.done(&["apply", "correct-ends", "--help"]);
    assert_eq!(
        help.matches("by the joint method only").count(),
        6,
        "{help}"
    );
}

#[test]
fn rounding_is_no_reason() {
    let (folder, file) = with_example("arc");
    let arguments = [
        "apply",
        "correct-ends",
        &file,
        "out.batten",
        "--tolerance",
        "1e-300",
        "--end",
        "0,0",
    ];
    let (_, err) = texts(&folder.run(&arguments));
    assert!(
        err.contains("Rounding leaves more") && !err.contains("missed by"),
        "{err}"
    );
}

#[test]
fn whole_numbers_take_arithmetic() {
    let folder = Folder::new();
    let degree = |text: &'static str| {
        [
            "apply",
            "approximate",
            "circle",
            "out.batten",
            "--degree",
            text,
        ]
    };
    folder.done(&degree("2+3"));
    assert_eq!(curves(&folder, "out.batten")[0]["degree"], 5);
    folder.misused(&degree("5/2"), "Degree: a whole number, 1 to 25 is needed");
    folder.misused(&degree("5-6"), "Degree: a whole number, 1 to 25 is needed");
    folder.misused(&degree("2+"), "column 3");
}

#[test]
fn a_cusp_is_said_in_the_report_and_places_are_exact() {
    let folder = Folder::new();
    let cusp = [
        "approximate",
        "formula:x=(t-0.25)^2;y=(t-0.25)^3",
        "a.batten",
        "--count",
        "40",
    ];
    let found = report(&folder, &cusp);
    let told = found["remarks"].to_string();
    assert!(
        told.contains("has a cusp at 0.25000: it has no curvature there"),
        "{told}"
    );
    // κ of the parabola y = (t − 1.5)² is largest at t = 1.5, to the last digits.
    let parabola = [
        "approximate",
        "formula:x=t;y=(t-1.5)^2;from=0;to=4",
        "b.batten",
        "--degree",
        "7",
    ];
    let found = report(&folder, &parabola);
    let first = &found["equivalence"][0];
    assert_eq!(first["sampled"], true);
    assert_eq!(first["reference"][0]["feature"], "maximum");
    let t = first["reference"][0]["t"].as_f64().unwrap();
    assert!((t - 1.5).abs() < 1e-12, "{t}");
}

/// Read a project file.
fn project_in(folder: &Folder, file: &str) -> Value {
    let text = fs::read_to_string(folder.path(file)).expect("a file");
    serde_json::from_str(&text).expect("a project")
}

/// A project of one straight curve from x on, in a unit if one is given.
fn straight(name: &str, x: f64, unit: Option<&str>) -> String {
    let vertices = [0.0, 1.0, 2.0, 3.0, 4.0].map(|along| [x + along, 0.0]);
    let curves = json!([{"name": name, "degree": 3, "vertices": vertices}]);
    let mut project = json!({"format": "batten", "version": 2, "curves": curves});
    if let Some(unit) = unit {
        project["unit"] = json!(unit);
    }
    project.to_string()
}

#[test]
fn a_fit_is_appended_to_everything_that_its_file_holds() {
    let points: Vec<[f64; 2]> = (0..12)
        .map(|x| [f64::from(x), f64::from(x * x) / 20.0])
        .collect();
    let given = json!({"format": "batten", "version": 2, "unit": "cm", "note": "kept",
    "curves": [{"name": "line", "degree": 1, "vertices": [[0, 0], [0, 4], [1, 5]]}],
    "references": [
        {"name": "wave", "formula": {"x": "t", "y": "sin(t)"}, "interval": [0, 6]},
        {"name": "scan", "points": points},
    ]});
    let mut plain = given.clone();
    plain.as_object_mut().expect("an object").remove("note");
    let folder = Folder::new()
        .with("in.batten", given.to_string())
        .with("plain.batten", plain.to_string());
    let fit = |curve: &str| -> Value {
        let arguments = ["apply", "fit", "in.batten", "out.batten", "--curve", curve];
        serde_json::from_str(&folder.done(&arguments).0).expect("a report")
    };
    assert_eq!(fit("scan")["reached"], true);
    let written = project_in(&folder, "out.batten");
    assert_eq!(
        (&written["unit"], &written["note"]),
        (&json!("cm"), &json!("kept"))
    );
    let curves = written["curves"].as_array().expect("curves");
    let names: Vec<&Value> = curves.iter().map(|curve| &curve["name"]).collect();
    assert_eq!(names, ["line", "fit"]);
    assert_eq!(
        written["references"].as_array().expect("references").len(),
        2
    );
    assert_eq!(written["references"][0]["formula"]["y"], "sin(t)");
    // By its number: the line is the first, the points are the second that can be fitted.
    fit("2");
    assert_eq!(project_in(&folder, "out.batten"), written);
    folder.refused(
        &["apply", "fit", "plain.batten", "none.batten"],
        "plain.batten: choose one with --curve: there are “line”, “scan”",
    );
}

#[test]
fn units_are_kept_or_converted_by_join_fit_and_convert() {
    let folder = Folder::new()
        .with("cm.batten", straight("a", 0.0, Some("cm")))
        .with("mm.batten", straight("b", 90.0, Some("mm")))
        .with("none.batten", straight("c", 9.0, None));
    let last_x = |file: &str| -> f64 {
        let vertices = &project_in(&folder, file)["curves"][0]["vertices"];
        let vertices = vertices.as_array().expect("vertices");
        numbers(&vertices[vertices.len() - 1])[0]
    };
    let join = ["apply", "join", "cm.batten"];
    // 94 mm are 9.4 cm.
    let converted = [&join[..], &["mm.batten", "out.batten"]].concat();
    let (_, told) = folder.done(&converted);
    assert!(
        told.contains("mm.batten: converted from millimetres to centimetres"),
        "{told}"
    );
    assert!((last_x("out.batten") - 9.4).abs() < 1e-9);
    assert_eq!(project_in(&folder, "out.batten")["unit"], "cm");
    let counted = [&join[..], &["none.batten", "out.batten"]].concat();
    let (_, told) = folder.done(&counted);
    assert!(
        told.contains("none.batten: no unit given: the numbers count in centimetres"),
        "{told}"
    );
    assert!((last_x("out.batten") - 13.0).abs() < 1e-9);
    let assumed = [&counted[..], &["--assume-unit", "in"]].concat();
    folder.done(&assumed);
    assert!((last_x("out.batten") - 13.0 * 2.54).abs() < 1e-9);
    // Where only the incoming unit is known, the document's must be told.
    let unknown = ["apply", "join", "none.batten", "cm.batten", "new.batten"];
    folder.refused(
        &unknown,
        "none.batten: the curves to add are in centimetres, the document states no unit: choose the document's unit with --assume-unit",
    );
    assert!(!folder.path("new.batten").exists());
    folder.done(&[&unknown[..], &["--assume-unit", "cm"]].concat());
    assert_eq!(project_in(&folder, "new.batten")["unit"], "cm");
    folder.done(&["apply", "fit", "cm.batten", "out.batten"]);
    assert_eq!(project_in(&folder, "out.batten")["unit"], "cm");
    let convert = [
        "convert",
        "none.batten",
        "out.batten",
        "--assume-unit",
        "in",
    ];
    folder.done(&convert);
    assert_eq!(project_in(&folder, "out.batten")["unit"], "in");
    folder.done(&["convert", "cm.batten", "out.batten", "--assume-unit", "in"]);
    assert_eq!(project_in(&folder, "out.batten")["unit"], "cm");
}
