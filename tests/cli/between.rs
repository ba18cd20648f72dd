//! `batten apply between` from a shell.

use serde_json::{Value, json};

use super::folder::*;

const ENDS: [&str; 8] = [
    "--from",
    "0,0",
    "--from-direction",
    "1,1",
    "--to",
    "10,0",
    "--to-direction",
    "2,-1",
];

fn arguments<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["apply", "between", "out.batten"], &ENDS[..], more].concat()
}

fn report(folder: &Folder, more: &[&str]) -> Value {
    let (out, err) = folder.done(&arguments(more));
    assert_eq!(err, "");
    serde_json::from_str(&out).unwrap()
}

#[test]
fn a_segment_is_made_of_what_is_given() {
    let folder = Folder::new();
    let more = ["--kind", "log-aesthetic:alpha=0.5", "--degree", "6"];
    let found = report(&folder, &more);
    assert_eq!(found["reached"], true);
    assert_eq!(found["alpha"], json!([0.5]));
    assert_eq!(found["features_before"], json!([]));
    assert_eq!(found["features_after"][0]["monotone"], "proved");
    let length = found["length"].as_f64().unwrap();
    assert!(found["deviation"].as_f64().unwrap() <= 1e-6 * length);
    let curves = &folder.inspect(&["out.batten"])["curves"];
    assert_eq!(
        (&curves[0]["degree"], &curves[0]["name"]),
        (&json!(6), &json!("segment 1"))
    );
    let end = numbers(&curves[0]["ends"]["end"]["point"]);
    assert!(
        (end[0] - 10.0).abs() < 1e-12 && end[1].abs() < 1e-12,
        "{end:?}"
    );
    // A parameter of its own says the same.
    let same = report(
        &folder,
        &["--kind", "log-aesthetic", "--alpha", "0.5", "--degree", "6"],
    );
    assert_eq!(same, found);
    // A clothoid by its name.
    let clothoid = report(&folder, &["--kind", "clothoid"]);
    assert_eq!(clothoid["alpha"], json!([-1.0]));
    // Negative numbers, and a tolerance.
    let found = report(
        &folder,
        &["--kind", "log-aesthetic:alpha=-1", "--tolerance", "1e-9"],
    );
    assert_eq!(found["alpha"], json!([-1.0]));
    assert!(found["deviation"].as_f64().unwrap() <= 1e-9);
}

#[test]
fn where_there_is_none_the_exit_code_and_the_report_say_so() {
    let folder = Folder::new();
    let none = [
        "apply",
        "between",
        "out.batten",
        "--from",
        "0,0",
        "--from-direction",
        "1,0.1",
        "--to",
        "10,0",
        "--to-direction",
        "1,0.2",
        "--kind",
        "log-aesthetic:alpha=0",
    ];
    let output = folder.run(&none);
    assert_eq!(output.status.code(), Some(1));
    let (out, err) = texts(&output);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(
        (&found["reached"], &found["deviation"]),
        (&json!(false), &Value::Null)
    );
    assert!(err.contains("ask for an inflection"), "{err}");
    assert!(!folder.path("out.batten").exists());
}

#[test]
fn a_kind_with_values_that_are_none_is_refused() {
    let folder = Folder::new();
    for (kind, words) in [
        ("spiral", "[possible values: log-aesthetic, "),
        ("log-aesthetic:alpha=-1,alpha=1", "“alpha” is given twice"),
        (
            "log-aesthetic:beta=1",
            "log-aesthetic has no parameter “beta”: it has alpha",
        ),
        (
            "superspiral:alpha=1",
            "superspiral has no parameter “alpha”: it has a, b, c",
        ),
        (
            "log-aesthetic:degree=4",
            "log-aesthetic has no parameter “degree”",
        ),
        (
            "clothoid:alpha=1",
            "clothoid has no parameter “alpha”: it has none",
        ),
        (
            "log-aesthetic:alpha",
            "“alpha” gives no parameter a value: write it as name=value",
        ),
        ("log-aesthetic:alpha=x", "Slope α: a number is needed"),
    ] {
        folder.misused(&arguments(&["--kind", kind]), words);
    }
    let of_another = ["--kind", "superspiral", "--alpha", "1"];
    folder.misused(
        &arguments(&of_another),
        "superspiral has no parameter “alpha”",
    );
    folder.misused(
        &arguments(&["--a", "1"]),
        "log-aesthetic has no parameter “a”",
    );
    let twice = ["--kind", "log-aesthetic:alpha=1", "--alpha", "2"];
    folder.misused(&arguments(&twice), "“alpha” is given twice");
}
