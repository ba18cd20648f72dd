//! The real program from a shell.

mod apply;
mod batch;
mod between;
mod compare;
mod edit;
mod folder;
mod inspect;
mod streams;
mod tables;

use std::fs;
use std::process::{Command as Process, Stdio};

use assert_cmd::cargo::cargo_bin;
use serde_json::{Value, json};

use folder::*;

#[test]
fn examples_are_listed_and_written() {
    let folder = Folder::new();
    let (list, _) = folder.done(&["example", "--list"]);
    let names: Vec<&str> = list
        .lines()
        .filter_map(|line| line.split(' ').next())
        .collect();
    assert_eq!(
        names,
        [
            "arc",
            "figure2",
            "hexagon",
            "s-curve",
            "periodic",
            "bottle",
            "hull",
            "composite"
        ]
    );
    for name in names {
        for extension in ["batten", "csv", "dxf"] {
            let file = format!("{name}.{extension}");
            folder.done(&["example", name, &file]);
            assert!(
                fs::metadata(folder.path(&file)).unwrap().len() > 80,
                "{file}"
            );
        }
        let [project, table] =
            ["batten", "csv"].map(|extension| folder.inspect(&[&format!("{name}.{extension}")]));
        assert_eq!(project, table, "{name}");
    }
    folder.misused(
        &["example", "arch", "a.batten"],
        "possible values: arc, figure2",
    );
    folder.misused(&["example"], "required");
    folder.misused(&["example", "arc"], "required");
    folder.refused(
        &["example", "arc", "a.docx"],
        "a.docx: “.docx” is not a format Batten knows: use one of .batten, .csv, .tsv, .dat, .txt, .xyz, .pts, .asc, .xy, .dxf, .step, .stp, .p21, .ap242, .igs, .iges, .3dm, .svg, .glif, .obj, .brep, .brp, .json",
    );
}

#[test]
fn the_arc_is_the_papers() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "arc.batten"]);
    let figure = &data("paper.json")["figure1"];
    let arc = folder.inspect(&["arc.batten"])["curves"][0].clone();
    assert_eq!(arc["float"], figure["float"], "to the last digit");
    check_near(&arc["clamped"], &figure["closed"], 1e-14, "clamped");
}

#[test]
fn table_1_is_recomputed() {
    let folder = Folder::new();
    let (text, _) = folder.done(&["table1", "--json"]);
    let found: Value = serde_json::from_str(&text).unwrap();
    let expected = data("paper.json")["table1"].clone();
    let (found, expected) = (found.as_array().unwrap(), expected.as_array().unwrap());
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let degree = &found["degree"];
        assert_eq!(degree, &expected["degree"]);
        let tolerance = if degree == 9 { 1e-5 } else { 1e-9 };
        for (key, tolerance) in [("bspline", tolerance), ("bezier", 1e-9)] {
            let (found, expected) = (
                found[key].as_f64().unwrap(),
                expected[key].as_f64().unwrap(),
            );
            assert!(
                (found / expected - 1.0).abs() < tolerance,
                "{degree} {key}: {found}"
            );
        }
    }
    let (text, _) = folder.done(&["table1"]);
    assert!(text.contains("     9   5.90128"), "{text}");
}

#[test]
fn parameters_outside_the_domain_are_refused() {
    let folder = Folder::new();
    folder.done(&["example", "hull", "hull.csv"]);
    folder.refused(
        &["inspect", "hull.csv", "--at", "0,10.5"],
        "hull.csv: curve 1 “hull”: the parameter 10.5 of --at lies outside the curve's domain, 0 to 10",
    );
    folder.refused(
        &["inspect", "hull.csv", "--at", "-1"],
        "hull.csv: curve 1 “hull”: the parameter -1 of --at lies outside the curve's domain, 0 to 10",
    );
    for at in ["NaN", "1,inf", "one", "1,,2"] {
        folder.misused(
            &["inspect", "hull.csv", "--at", at],
            "a finite number is needed",
        );
    }
}

#[test]
fn convert_keeps_the_curve_by_every_polygon() {
    let folder = Folder::new();
    folder.done(&["example", "figure2", "a.batten"]);
    let expected = folder.inspect(&["a.batten"])["curves"][0].clone();
    for polygon in ["float", "clamped", "bezier"] {
        for extension in ["batten", "csv"] {
            let file = format!("{polygon}.{extension}");
            folder.done(&["convert", "a.batten", &file, "--polygon", polygon]);
            let text = fs::read_to_string(folder.path(&file)).unwrap();
            assert!(text.contains(polygon), "{file}");
            let found = folder.inspect(&[&file])["curves"][0].clone();
            assert_eq!(found["name"], "figure2");
            check_near(&found["float"], &expected["float"], 1e-12, &file);
        }
    }
    folder.misused(
        &["convert", "a.batten", "b.csv", "--polygon", "closed"],
        "possible values: float, clamped, bezier",
    );
}

#[test]
fn a_file_is_not_converted_into_itself() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "a.batten"]);
    let before = fs::read(folder.path("a.batten")).unwrap();
    folder.refused(
        &["convert", "a.batten", "./a.batten"],
        "./a.batten: a file is not converted into itself",
    );
    assert_eq!(fs::read(folder.path("a.batten")).unwrap(), before);
}

#[test]
fn convert_lists_what_is_lost() {
    let curve = json!([{"name": "a/b", "degree": 2, "colour": "#102030", "periodic": true,
        "vertices": [[0, 0], [1, 0], [1, 1], [0, 1]]}]);
    let folder = Folder::new().with("a.batten", project(curve));
    let check = |arguments: &[&str], expected: &str| {
        let arguments = [&["convert", "a.batten"], arguments].concat();
        let (out, err) = folder.done(&arguments);
        assert_eq!((out.as_str(), err.as_str()), ("", expected));
    };
    check(&["b.batten"], "");
    check(
        &["b.csv"],
        "batten: “a/b”: the colour isn't stored in the CSV table\n",
    );
    check(
        &["b.dxf", "--polygon", "float"],
        "batten: “a/b”: the name is written as “a_b”, which DXF allows\nbatten: “a/b”: the colour is written as the nearest that DXF has\nbatten: “a/b”: written as an open curve that ends where it begins\n",
    );
    check(
        &["c.batten", "--polygon", "bezier"],
        "batten: “a/b”: written as an open curve that ends where it begins\n",
    );
}

#[test]
fn degrees_are_lowered_within_a_tolerance_that_is_measured() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "a.batten"]);
    let before = folder.inspect(&["a.batten"])["curves"][0].clone();
    assert_eq!(before["degree"], 9);
    let lower = |out: &str, more: &[&str]| {
        let arguments = [&["convert", "a.batten", out, "--degree-at-most", "3"], more].concat();
        let (_, err) = folder.done(&arguments);
        assert!(
            err.starts_with("batten: “arc”: degree 9 becomes 3, "),
            "{err}"
        );
        let after = folder.inspect(&[out])["curves"][0].clone();
        assert_eq!(after["degree"], 3);
        let same = ["inflections", "curvature_extrema"].iter().all(|quantity| {
            let count = |curve: &Value| curve["features"][quantity].as_array().map(Vec::len);
            count(&after) == count(&before)
        });
        assert_eq!(
            same,
            !err.contains("; curvature extrema: 1 before, "),
            "{err}"
        );
        after["float"].as_array().expect("vertices").len()
    };
    let coarse = lower("b.batten", &["--tolerance", "1e-2"]);
    let fine = lower("fine.batten", &["--tolerance", "1e-6"]);
    assert!(coarse < fine, "{coarse} and {fine} vertices");
    lower("b.step", &[]);
    // The parameter runs as evenly along both curves.
    let at = |file: &str, u: f64| {
        let found = folder.inspect(&[file, "--at", &u.to_string()]);
        let point = &found["curves"][0]["at"][0]["point"];
        [0, 1].map(|axis| point[axis].as_f64().expect("a number"))
    };
    lower("c.batten", &["--tolerance", "1e-4"]);
    let domain = |file: &str| folder.inspect(&[file])["curves"][0]["domain"][1].as_f64();
    let [one, other] = ["a.batten", "c.batten"].map(|file| domain(file).expect("an end"));
    for place in 0..=10 {
        let share = f64::from(place) / 10.0;
        let [p, q] = [at("a.batten", share * one), at("c.batten", share * other)];
        let off = (p[0] - q[0]).hypot(p[1] - q[1]);
        assert!(off <= 1e-4, "{share}: {off}");
    }
    // A degree that is low enough stays.
    let (_, err) = folder.done(&["convert", "a.batten", "d.step", "--degree-at-most", "9"]);
    assert!(!err.contains("becomes"), "{err}");
    folder.misused(
        &["convert", "a.batten", "d.dxf", "--tolerance", "1"],
        "--degree-at-most",
    );
}

#[test]
fn cubics_keep_features_or_say_what_changes() {
    let folder = Folder::new();
    let written = |example: &str, file: &str, tolerance: &[&str]| {
        folder.done(&["example", example, "a.batten"]);
        let (_, err) = folder.done(&[&["convert", "a.batten", file], tolerance].concat());
        let line = err.lines().find(|line| line.contains("written as "));
        line.expect("a remark on the cubics").to_owned()
    };
    let cubics = |line: &str| -> usize {
        let (_, count) = line.split_once("written as ").expect("a count");
        let (count, _) = count.split_once(' ').expect("a count");
        count.parse().expect("a count")
    };
    for file in ["a.svg", "a.glif"] {
        let kept = written("s-curve", file, &[]);
        assert!(kept.ends_with(" off"), "{kept}");
        let arc = written("arc", file, &[]);
        assert!(
            arc.ends_with(" off; curvature extrema: 1 before, 3 as written"),
            "{arc}"
        );
        let [coarse, fine] =
            ["0.1", "1e-5"].map(|it| written("s-curve", file, &["--tolerance", it]));
        assert!(cubics(&coarse) < cubics(&fine), "{coarse}\n{fine}");
    }
}

/// A drawing in millimetres: two lines on Deck, one on Keel, and a hatch.
const DRAWING: &str = "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n\
  0\nLINE\n  8\nDeck\n 10\n0\n 20\n0\n 11\n3\n 21\n4\n\
  0\nLINE\n  8\nDeck\n 10\n0\n 20\n0\n 11\n6\n 21\n8\n\
  0\nLINE\n  8\nKeel\n 10\n0\n 20\n0\n 11\n9\n 21\n0\n\
  0\nHATCH\n  8\n0\n  0\nENDSEC\n  0\nEOF\n";

#[test]
fn layers_and_kinds_of_a_drawing_are_chosen() {
    let folder = Folder::new().with("a.dxf", DRAWING);
    let (_, err) = folder.done(&["convert", "a.dxf", "deck.batten", "--layer", "Deck"]);
    assert_eq!(
        err,
        "batten: a.dxf: 1 item not chosen, left out\n\
         batten: a.dxf: not understood: 1 HATCH at line 52\n"
    );
    let deck = folder.inspect(&["deck.batten"]);
    assert_eq!(deck["references"].as_array().map(Vec::len), Some(2));
    folder.refused(
        &["convert", "a.dxf", "b.batten", "--layer", "Mast"],
        "a.dxf: there is no layer Mast: the file has Deck, Keel",
    );
    folder.refused(
        &["convert", "a.dxf", "b.batten", "--kind", "spline"],
        "a.dxf: nothing of that kind is there: the file has 2 line on Deck, 1 line on Keel",
    );
    let (list, _) = folder.done(&["list", "a.dxf"]);
    let list: Value = serde_json::from_str(&list).expect("JSON");
    let row = json!({"layer": "Deck", "kind": "line", "count": 2, "degrees": [], "rational": 0,
        "periodic": 0, "hidden": 0, "bounds": [[0.0, 0.0, 0.0], [6.0, 8.0, 0.0]]});
    assert_eq!(list["rows"][0], row);
    assert_eq!(
        list["other"],
        json!([{"kind": "HATCH", "count": 1, "at": 52}])
    );
}

#[test]
fn presets_write_what_a_program_reads() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "a.batten"]);
    let preset =
        |name: &'static str, out: &'static str| ["convert", "a.batten", out, "--preset", name];
    let (_, err) = folder.done(&preset("librecad", "a.dxf"));
    assert!(err.contains("degree 9 becomes 3, "), "{err}");
    assert_eq!(folder.inspect(&["a.dxf"])["curves"][0]["degree"], 3);
    let output =
        folder.run(&[&preset("librecad", "b.dxf")[..], &["--degree-at-most", "5"]].concat());
    let (_, err) = texts(&output);
    let reason = "b.dxf: “arc” has degree 5, and LibreCAD reads degrees up to 3: it leaves them blank. Choose a lower degree\n";
    assert!(
        output.status.code() == Some(1) && err.ends_with(reason),
        "{err}"
    );
    folder.refused(
        &preset("rhino", "a.step"),
        "Rhino takes 3DM: give OUT the extension .3dm",
    );
    let (_, err) = folder.done(&preset("glyphs", "a.glif"));
    assert!(err.contains("cubic Bézier, up to "), "{err}");
    // Half the size, in inches.
    folder.done(&["convert", "a.batten", "mm.batten", "--assume-unit", "mm"]);
    let sized = [
        "convert",
        "mm.batten",
        "b.step",
        "--unit",
        "in",
        "--scale",
        "127/5",
    ];
    folder.done(&sized);
    let [own, there] = ["a.batten", "b.step"].map(|file| {
        let found = folder.inspect(&[file]);
        found["curves"][0]["length"].as_f64().expect("a length")
    });
    assert!((there / own - 1.0).abs() < 1e-12, "{there} and {own}");
}

#[test]
fn unknown_keys_are_told_and_kept() {
    let curve =
        json!([{"name": "a", "degree": 1, "vertices": [[0, 0], [1, 1]], "weigths": [1, 2]}]);
    let text = project(curve).replacen('{', "{\"made by\": \"me\", ", 1);
    let folder = Folder::new().with("a.batten", text);
    let (_, err) = folder.done(&["convert", "a.batten", "b.batten"]);
    assert_eq!(
        err,
        "batten: a.batten: the project's key “made by” is not known and has no effect\n\
         batten: a.batten: curve 1 “a”: the key “weigths” is not known and has no effect\n"
    );
    let text = fs::read_to_string(folder.path("b.batten")).unwrap();
    for part in ["\"made by\": \"me\"", "\"weigths\": [1,2]"] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let (out, err) = folder.done(&["inspect", "b.batten"]);
    assert!(out.starts_with('{'), "{out}");
    assert_eq!(err.lines().count(), 2, "{err}");
}

#[test]
fn a_polygon_that_cannot_be_read_back_is_written_by_force_alone() {
    // The clamped weights are of one size: which tiny weights they come from is lost.
    let curve = json!([{"name": "extreme", "degree": 2, "weights": [1e-100, 1e100, 1e-100],
        "vertices": [[0, 0], [1, 2], [3, 2]]}]);
    let folder = Folder::new()
        .with("a.batten", project(curve))
        .with("old.csv", "old");
    for polygon in ["clamped", "bezier"] {
        for file in ["b.batten", "b.csv", "old.csv"] {
            let output = folder.run(&["convert", "a.batten", file, "--polygon", polygon]);
            let (out, err) = texts(&output);
            assert_eq!((output.status.code(), out.as_str()), (Some(1), ""), "{err}");
            let start = format!("batten: {file}: what would be written cannot be read back: ");
            assert!(err.starts_with(&start), "{err}");
            let end = "Nothing is written; --force writes it all the same\n";
            assert!(err.ends_with(end), "{err}");
        }
    }
    assert!(!folder.path("b.batten").exists() && !folder.path("b.csv").exists());
    assert_eq!(fs::read(folder.path("old.csv")).unwrap(), b"old");
    let (_, err) = folder.done(&[
        "convert",
        "a.batten",
        "b.csv",
        "--polygon",
        "clamped",
        "--force",
    ]);
    assert_eq!(
        err,
        "batten: “extreme”: the clamped polygon written cannot be converted back to a float polygon\n"
    );
    let text = fs::read_to_string(folder.path("b.csv")).unwrap();
    assert!(text.contains("polygon=clamped"), "{text}");
}

#[cfg(unix)]
#[test]
fn a_broken_hard_link_is_told() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "a.batten"]);
    fs::hard_link(folder.path("a.batten"), folder.path("b.batten")).unwrap();
    let (_, err) = folder.done(&["example", "hull", "a.batten"]);
    assert_eq!(
        err,
        "batten: a.batten: the file had another name (a hard link), which keeps the old content\n"
    );
    assert_eq!(folder.inspect(&["b.batten"])["curves"][0]["name"], "arc");
}

#[test]
fn a_misspelled_command_is_bad_usage() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "arc.batten"]);
    for (word, meant) in [
        ("inspcet", "inspect"),
        ("convrt", "convert"),
        ("exampel", "example"),
        ("table", "table1"),
    ] {
        let expected = format!(
            "“{word}” is neither a command nor a file\n\n  tip: a command with a similar name is “{meant}”\n\nUsage: "
        );
        folder.misused(&[word, "arc.batten"], &expected);
        folder.misused(&[word], &expected);
    }
    let expected = "“frobnicate” is neither a command nor a file\n\nUsage: ";
    folder.misused(&["frobnicate", "arc.batten"], expected);
    folder.misused(&["in\u{202e}spect\n"], "“in\\u{202e}spect\\n” is neither");
}

#[test]
fn what_can_only_be_a_file_is_refused_as_one() {
    let folder = Folder::new().with("inspcet", "");
    let missing = "cannot read the file: No such file or directory (os error 2)";
    folder.refused(&["inspcet.batten"], &format!("inspcet.batten: {missing}"));
    folder.refused(
        &["new.batten", "inspcet"],
        &format!("new.batten: {missing}"),
    );
    let nameless = "the name has no extension that tells its format: add one of .batten, .csv, .tsv, .dat, .txt, .xyz, .pts, .asc, .xy, .gpx, .dxf, .step, .stp, .p21, .ap242, .igs, .iges, .3dm, .svg, .glif, .obj, .brep, .brp, .json, .png, .jpg, .jpeg, .webp, .tif, .tiff";
    folder.refused(&["inspcet"], &format!("inspcet: {nameless}"));
    folder.refused(&["./convrt"], &format!("./convrt: {nameless}"));
}

#[test]
fn bad_input_is_refused_with_file_and_place() {
    let folder = Folder::new()
        .with("empty.batten", "")
        .with(
            "cut.batten",
            "{\"format\": \"batten\",\n \"version\": 1,\n \"curves\": [",
        )
        .with("plain.csv", "x,y,weight\n0,0,1\n1,1,1\n")
        .with(
            "weight.batten",
            project(json!([
                {"name": "a", "degree": 1, "vertices": [[0, 0], [1, 1]]},
                {"name": "hull", "degree": 1, "vertices": [[0, 0], [1, 1]], "weights": [1, -1]},
            ])),
        );
    for command in ["inspect", "convert"] {
        let check = |file: &str, expected: &str| {
            let mut arguments = vec![command, file];
            if command == "convert" {
                arguments.push("out.csv");
            }
            folder.refused(&arguments, &format!("{file}: {expected}"));
            assert!(!folder.path("out.csv").exists());
        };
        check("empty.batten", "the file is empty");
        check("cut.batten", "line 3, column 12: EOF while parsing a list");
        check(
            "plain.csv",
            "line 1: the table does not say which curve its vertices make: put a line like “# degree=3 polygon=float periodic=false name=curve” above the line with the column names",
        );
        check(
            "weight.batten",
            "curve 2 “hull”, vertex 1: weight -1.0 cannot be used: weights are positive numbers from 1e-100 to 1e100",
        );
        check(
            "gone.csv",
            "cannot read the file: No such file or directory (os error 2)",
        );
    }
    folder.misused(&["inspect"], "Usage");
    folder.misused(&["--no-such-option"], "Usage");
}

#[test]
fn a_conversion_that_fails_leaves_the_old_file() {
    let folder = Folder::new()
        .with("none.batten", project(json!([])))
        .with("old.csv", "old");
    folder.refused(
        &["convert", "none.batten", "old.csv"],
        "old.csv: there is no curve to write: CSV table files need at least one",
    );
    assert_eq!(fs::read(folder.path("old.csv")).unwrap(), b"old");
    assert_eq!(fs::read_dir(folder.0.path()).unwrap().count(), 2);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    // More than a pipe holds, so that writing meets the closed end.
    let vertices: Vec<[f64; 2]> = (0..20_000).map(|i| [f64::from(i), 0.1]).collect();
    let curve = json!([{"name": "long", "degree": 3, "vertices": vertices}]);
    let folder = Folder::new().with("long.batten", project(curve));
    let mut process = Process::new(cargo_bin!("batten"));
    // Not inspect: on a slow machine it tells of its progress.
    process
        .args(["convert", "long.batten", "-", "--to-format", "csv"])
        .current_dir(folder.0.path());
    let mut child = process
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(texts(&output).1, "");
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn help_says_what_there_is() {
    let folder = Folder::new();
    let (help, _) = folder.done(&["--help"]);
    for word in [
        "example",
        "table1",
        "convert",
        "inspect",
        "[FILE]...",
        "Exit codes",
    ] {
        assert!(help.contains(word), "{word} in {help}");
    }
    let (help, _) = folder.done(&["convert", "--help"]);
    assert!(
        help.contains("[possible values: float, clamped, bezier]"),
        "{help}"
    );
    let (version, _) = folder.done(&["--version"]);
    assert_eq!(version, format!("batten {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn the_editor_does_not_open_on_files_that_cannot_be_read() {
    let good = r#"{"format":"batten","version":1,"curves":[]}"#;
    let folder = Folder::new()
        .with("bad.batten", "{")
        .with("good.batten", good);
    for files in [&["bad.batten"][..], &["good.batten", "bad.batten"]] {
        let output = folder.run(files);
        let (_, err) = texts(&output);
        assert_eq!(output.status.code(), Some(1), "{files:?}: {err}");
        assert!(err.starts_with("batten: bad.batten: line 1"), "{err}");
    }
}

#[test]
fn what_is_typed_wrong_neither_turns_nor_floods_the_message() {
    let folder = Folder::new();
    let long = "x".repeat(3000);
    for arguments in [
        ["convert", "-", "-", "--to-format", "d\u{202e}xf"],
        ["convert", "-", "-", "--to-format", &long],
        ["example", "hu\u{202e}ll", "a.batten", "--fo\u{202e}o", "1"],
        ["inspect", "a.batten", "--at", &long, "-"],
    ] {
        let output = folder.run(&arguments);
        let (_, err) = texts(&output);
        assert_eq!(output.status.code(), Some(2), "{err}");
        assert!(!err.contains('\u{202e}') && !err.contains(&long), "{err}");
        assert!(err.len() < 1000, "{err}");
    }
    folder.misused(&["example", "hu\u{202e}ll", "a.batten"], "hu\\u{202e}ll");
}

/// The folder lets anybody replace the file, which only its owner may write.
#[cfg(unix)]
#[test]
fn a_file_that_may_not_be_written_is_not_replaced() {
    use std::os::unix::fs::PermissionsExt;
    use std::os::unix::process::CommandExt;

    const NOBODY: u32 = 65_534;
    let folder = Folder::new().with("theirs.batten", "kept");
    let mode = |path, mode| fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    mode(folder.path("."), 0o777);
    // Only root can become somebody else; others may not write to a file of their own.
    let program = folder.path("program");
    fs::copy(cargo_bin!("batten"), &program).unwrap();
    mode(program.clone(), 0o755);
    let mut process = Process::new(&program);
    process.args(["example", "arc", "theirs.batten"]);
    process.current_dir(folder.path("."));
    let output = match process.uid(NOBODY).gid(NOBODY).output() {
        Ok(output) => output,
        Err(_) => {
            mode(folder.path("theirs.batten"), 0o444);
            folder.run(&["example", "arc", "theirs.batten"])
        }
    };
    let (_, err) = texts(&output);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(
        err.contains("theirs.batten: the file is read-only"),
        "{err}"
    );
    assert_eq!(fs::read(folder.path("theirs.batten")).unwrap(), b"kept");
}
