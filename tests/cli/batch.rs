//! `batten apply` to many files from a shell.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::folder::*;

/// The keys of a line, and those that are there with `--full`.
const KEYS: [&str; 7] = [
    "file", "out", "reached", "extrema", "largest", "time", "error",
];
const FULL_KEYS: [&str; 2] = ["report", "messages"];

/// Run and return the exit code with the lines; their times are checked and taken out.
fn lines(folder: &Folder, arguments: &[&str]) -> (Option<i32>, Vec<Value>) {
    let output = folder.run(&[&["apply"], arguments].concat());
    let (out, err) = texts(&output);
    assert_eq!(err, "");
    let line = |line: &str| -> Value {
        let mut value: Value = serde_json::from_str(line).expect("a line of JSON");
        let object = value.as_object_mut().expect("an object");
        let keys: Vec<&str> = object.keys().map(String::as_str).collect();
        let mut expected = KEYS.to_vec();
        if arguments.contains(&"--full") {
            expected.extend(FULL_KEYS);
        }
        expected.sort_unstable();
        assert_eq!(keys, expected);
        let time = object.remove("time").and_then(|time| time.as_f64());
        assert!(time.is_some_and(|time| time > 0.0), "{line}");
        value
    };
    (output.status.code(), out.lines().map(line).collect())
}

/// A folder with an arc, a file that is none, and a hull.
fn three() -> Folder {
    let folder = Folder::new().with("bad.batten", "{");
    folder.done(&["example", "arc", "arc.batten"]);
    folder.done(&["example", "hull", "hull.csv"]);
    folder
}

const THREE: [&str; 3] = ["arc.batten", "bad.batten", "hull.csv"];

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
    let mut names: Vec<String> = entries
        .map(|entry| name(entry).into_string().expect("text"))
        .collect();
    names.sort();
    names
}

#[test]
fn a_bad_file_stops_no_other() {
    let folder = three();
    let arguments = [&["subdivide"][..], &THREE, &["--out-dir", "new/out"]].concat();
    let (code, lines) = lines(&folder, &arguments);
    assert_eq!(code, Some(1));
    let expected = [
        json!({"file": "arc.batten", "out": "new/out/arc.batten", "reached": true, "extrema": 1,
            "largest": 0.0, "error": null}),
        json!({"file": "bad.batten", "out": null, "reached": null, "extrema": null,
            "largest": null, "error":
            "bad.batten: line 1, column 1: EOF while parsing an object"}),
        json!({"file": "hull.csv", "out": "new/out/hull.batten", "reached": true, "extrema": 1,
            "largest": 0.0, "error": null}),
    ];
    assert_eq!(lines, expected);
    assert_eq!(
        names(&folder.path("new/out")),
        ["arc.batten", "hull.batten"]
    );
    // Each is what a run of its own writes and says.
    for (file, line) in THREE.iter().zip(lines) {
        let output = folder.run(&["apply", "subdivide", file, "one.batten"]);
        let (_, err) = texts(&output);
        match line["out"].as_str() {
            Some(out) => {
                let [many, one] = [out, "one.batten"].map(|it| fs::read(folder.path(it)).unwrap());
                assert_eq!(many, one, "{file}");
            }
            None => {
                let error = line["error"].as_str().expect("an error");
                assert_eq!(err, format!("batten: {error}\n"));
            }
        }
    }
}

#[test]
fn one_thread_does_what_all_do() {
    let folder = Folder::new();
    let files: Vec<String> = (0..30).map(|number| format!("{number}.batten")).collect();
    for (number, file) in files.iter().enumerate() {
        let example = ["arc", "hull", "s-curve", "figure2"][number % 4];
        folder.done(&["example", example, file]);
    }
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let run = |dir: &'static str, more: &[&str]| {
        let arguments = [&["extend"][..], &files, &["--out-dir", dir], more].concat();
        let (code, mut lines) = lines(&folder, &arguments);
        assert_eq!(code, Some(0));
        let told: Vec<Value> = lines.iter().map(|line| line["file"].clone()).collect();
        assert_eq!(told, files, "in the order of the files");
        for line in &mut lines {
            let out = line["out"].as_str().expect("a path");
            line["out"] = json!(out.strip_prefix(dir).expect("in the folder"));
        }
        let out = names(&folder.path(dir)).into_iter();
        let written = out.map(|name| {
            let bytes = fs::read(folder.path(dir).join(&name)).expect("a file");
            (name, bytes)
        });
        (lines, written.collect::<Vec<_>>())
    };
    let all = run("all", &[]);
    assert_eq!(all.1.len(), 30);
    assert!(run("one", &["--jobs", "1"]) == all);
    assert!(run("many", &["--jobs", "100"]) == all);
    for jobs in ["0", "1.5"] {
        let arguments = [
            "apply",
            "extend",
            files[0],
            "--out-dir",
            "a",
            "--jobs",
            jobs,
        ];
        folder.misused(&arguments, "a whole number from 1");
    }
}

#[test]
fn equal_stems_are_refused_before_anything_is_written() {
    let folder = three();
    folder.done(&["example", "arc", "hull.batten"]);
    let apply = |files: &[&'static str], more: &[&'static str]| {
        [&["apply", "reverse"], files, &["--out-dir", "out"], more].concat()
    };
    folder.misused(
        &apply(&["arc.batten", "hull.csv", "hull.batten"], &[]),
        "“hull.csv” and “hull.batten” would both be written to “out/hull.batten”: rename one",
    );
    folder.misused(
        &apply(
            &["HULL.csv", "none.batten", "hull.batten"],
            &["--to-format", "dxf"],
        ),
        "“HULL.csv” and “hull.batten” would both be written to “out/hull.dxf”",
    );
    folder.misused(
        &apply(&["arc.batten", "arc.batten"], &[]),
        "“arc.batten” and “arc.batten” would both",
    );
    folder.misused(
        &apply(&["arc.batten", "-"], &["--from-format", "csv"]),
        "“-” has no name to write a file under",
    );
    folder.misused(&apply(&[], &[]), "required");
    folder.misused(&apply(&["arc.batten"], &["--text"]), "cannot be used with");
    assert!(!folder.path("out").exists());
}

#[test]
fn no_result_replaces_an_input() {
    let folder = three();
    let before = fs::read(folder.path("arc.batten")).unwrap();
    fs::create_dir(folder.path("out")).unwrap();
    let check = |files: &[&'static str], dir, expected: &str| {
        let arguments = [&["apply", "subdivide"], files, &["--out-dir", dir]].concat();
        folder.misused(&arguments, expected);
        assert_eq!(fs::read(folder.path("arc.batten")).unwrap(), before);
        assert!(names(&folder.path("out")).len() <= 1);
    };
    check(
        &["hull.csv", "arc.batten"],
        ".",
        "“./arc.batten” would replace the input “arc.batten”: use another folder",
    );
    check(
        &["out/../arc.batten"],
        "out/..",
        "would replace the input “out/../arc.batten”",
    );
    #[cfg(unix)]
    {
        let link = folder.path("out/hull.batten");
        std::os::unix::fs::symlink(folder.path("arc.batten"), link).unwrap();
        check(
            &["hull.csv", "arc.batten"],
            "out",
            "“out/hull.batten” would replace the input “arc.batten”",
        );
    }
}

#[test]
fn only_operations_on_one_file_take_many() {
    let folder = three();
    let many = ["--out-dir", "out"];
    for files in [&["arc.batten"][..], &THREE, &["a", "b", "c", "d", "e"]] {
        let apply = |name| [&["apply", name], files, &many].concat();
        let only = "--out-dir is for operations that take one file:";
        folder.misused(
            &apply("join"),
            &format!("{only} join takes up to two files"),
        );
        for name in ["between", "mineur-farin"] {
            folder.misused(&apply(name), &format!("{only} {name} takes no file"));
        }
    }
    folder.misused(&["apply", "between", "--out-dir", "out"], "takes no file");
    folder.misused(
        &[
            "apply",
            "approximate",
            "arc.batten",
            "circle:radius=2",
            "--out-dir",
            "out",
        ],
        "“circle:radius=2” is a reference: --out-dir takes files",
    );
    for option in ["--full", "--jobs=2"] {
        let arguments = ["apply", "reverse", "arc.batten", "out.batten", option];
        folder.misused(&arguments, "--out-dir");
    }
    folder.misused(
        &["apply", "reverse", "arc.batten", "b.batten", "c.batten"],
        "unexpected argument “c.batten”: --out-dir DIR takes many files",
    );
    folder.misused(
        &[
            "apply", "join", "a.batten", "b.batten", "c.batten", "d.batten",
        ],
        "unexpected argument “d.batten”\n",
    );
    folder.misused(
        &["apply", "join", "a.batten"],
        "OUT, the file to write, is required",
    );
    assert_eq!(names(folder.0.path()), THREE);
    for (name, is_offered) in [("fit", true), ("approximate", true), ("join", false)] {
        let (help, _) = folder.done(&["apply", name, "--help"]);
        for words in ["--out-dir <DIR> <FILE>...", "--jobs <N>", "--full"] {
            assert_eq!(
                help.contains(words),
                is_offered,
                "{name}: {words} in {help}"
            );
        }
    }
}

#[test]
fn full_lines_hold_the_report_and_the_messages_of_a_run() {
    let curve = json!([{"name": "a", "degree": 2, "colour": "#102030", "weigths": 7,
        "vertices": [[0, 0], [1, 0], [1, 1], [0, 2]]}]);
    let folder = three().with("a.batten", project(curve));
    let files = ["a.batten", "bad.batten"];
    let more = ["--to-format", "csv", "--out-dir", "out", "--full"];
    let (code, lines) = lines(&folder, &[&["reverse"][..], &files, &more].concat());
    assert_eq!(code, Some(1));
    let (out, err) = folder.done(&["apply", "reverse", "a.batten", "one.csv"]);
    let report: Value = serde_json::from_str(&out).expect("a report");
    assert_eq!(lines[0]["report"], report);
    let messages = lines[0]["messages"].as_array().expect("messages");
    let messages = messages.iter().filter_map(Value::as_str);
    let told: String = messages.map(|line| format!("batten: {line}\n")).collect();
    assert!(told == err && told.lines().count() == 3, "{told}{err}");
    assert_eq!(
        (&lines[1]["report"], &lines[1]["messages"]),
        (&json!(null), &json!([]))
    );
    assert_eq!(lines[0]["out"], "out/a.csv");
    let [many, one] = ["out/a.csv", "one.csv"].map(|it| fs::read(folder.path(it)).unwrap());
    assert_eq!(many, one);
}

/// A polygon around a circle, with a bump that makes several extrema.
fn bump() -> String {
    let rows = (0..9).map(|index| {
        let (sine, cosine) = (0.1 * f64::from(index)).sin_cos();
        let radius = if index == 4 { 11.0 } else { 10.0 };
        format!("{},{}\n", radius * cosine, radius * sine)
    });
    format!("# degree=3\nx,y\n{}", rows.collect::<String>())
}

#[test]
fn a_file_that_is_not_reached_has_failed() {
    let folder = three().with("bump.csv", bump());
    let arguments = [
        "harmonise",
        "bump.csv",
        "arc.batten",
        "--extrema",
        "1",
        "--max-deviation",
        "1e-9",
        "--out-dir",
        "out",
    ];
    let (code, first) = lines(&folder, &arguments);
    assert_eq!(code, Some(1));
    assert_eq!(
        (&first[0]["reached"], &first[0]["out"]),
        (&json!(false), &json!(null))
    );
    assert_eq!(first[1]["error"], json!(null));
    assert_eq!(names(&folder.path("out")), ["arc.batten"]);
    let mut single = arguments.to_vec();
    single.truncate(7);
    single[2] = "one.csv";
    let output = folder.run(&[&["apply"], &single[..]].concat());
    let error = first[0]["error"].as_str().expect("an error");
    assert!(error.contains("not reached"), "{error}");
    assert_eq!(texts(&output).1, format!("batten: {error}\n"));
    // The best is written if it is wanted; the file has failed all the same.
    let (code, best) = lines(&folder, &[&arguments[..], &["--best"]].concat());
    assert_eq!(code, Some(1));
    assert_eq!(best[0]["out"], "out/bump.batten");
    assert_eq!(best[0]["error"], first[0]["error"]);
    assert_eq!(names(&folder.path("out")), ["arc.batten", "bump.batten"]);
}

#[test]
fn a_folder_that_cannot_be_made_is_refused() {
    let folder = three();
    let output = folder.run(&["apply", "reverse", "arc.batten", "--out-dir", "hull.csv"]);
    let (out, err) = texts(&output);
    assert_eq!((output.status.code(), out.as_str()), (Some(1), ""));
    assert!(
        err.starts_with("batten: hull.csv: cannot create the folder: "),
        "{err}"
    );
}

#[test]
fn options_hold_for_every_file() {
    let table = |offset: f64| {
        let rows = (0..9).map(|x| format!("{x};{};{}\n", f64::from(x), offset + f64::from(x * x)));
        format!("station;a;b\n{}", rows.collect::<String>())
    };
    let folder = Folder::new()
        .with("a.csv", table(0.0))
        .with("b.csv", table(5.0));
    let arguments = [
        "fit",
        "a.csv",
        "b.csv",
        "--out-dir",
        "out",
        "--columns",
        "a,b",
        "--assume-unit",
        "in",
        "--degree",
        "3",
        "--tolerance",
        "0.1",
    ];
    let (code, lines) = lines(&folder, &arguments);
    assert_eq!(code, Some(0), "{lines:?}");
    for file in ["out/a.batten", "out/b.batten"] {
        let inspected = folder.inspect(&[file]);
        assert_eq!(inspected["unit"], "in");
        assert_eq!(inspected["curves"][0]["degree"], 3);
    }
}

#[test]
fn twenty_airfoils_are_fitted() {
    let airfoils = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/airfoils");
    let folder = Folder::new();
    let files: Vec<String> = names(&airfoils)
        .into_iter()
        .filter(|name| name.ends_with(".dat"))
        .collect();
    for name in &files {
        fs::copy(airfoils.join(name), folder.path(name)).expect("copied");
    }
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    // A slow machine is given the time.
    let more = [
        "--tolerance",
        "0.01",
        "--time-limit",
        "600",
        "--out-dir",
        "fair",
    ];
    let (code, lines) = lines(&folder, &[&["fit"][..], &files, &more].concat());
    assert_eq!((code, lines.len()), (Some(0), 20), "{lines:?}");
    for (file, line) in files.iter().zip(&lines) {
        assert_eq!(line["file"], json!(file));
        let largest = line["largest"].as_f64().expect("a distance");
        assert!(largest > 0.0 && largest < 0.05, "{line}");
        let out = line["out"].as_str().expect("a path");
        assert_eq!(out, format!("fair/{}", file.replace(".dat", ".batten")));
        let fair = folder.inspect(&[out]);
        let extrema = fair["curves"][0]["features"]["curvature_extrema"].as_array();
        assert_eq!(
            line["extrema"],
            json!(extrema.expect("extrema").len()),
            "{file}"
        );
    }
}
