//! The deviation between two curves from a shell.

use serde_json::{Value, json};

use crate::folder::*;

fn line(name: &str, x: [f64; 2], y: f64) -> Value {
    json!({"name": name, "degree": 1, "polygon": "float", "vertices": [[x[0], y], [x[1], y]]})
}

fn compared(folder: &Folder, arguments: &[&str]) -> Value {
    let arguments = [&["compare"], arguments].concat();
    serde_json::from_str(&folder.done(&arguments).0).unwrap()
}

#[test]
fn both_sides_and_the_limit_are_told() {
    let lines = json!([
        line("part", [0.0, 1.0], 0.0),
        line("whole", [0.0, 4.0], 0.0)
    ]);
    let folder = Folder::new().with("lines.batten", project(lines));
    let both = [
        "lines.batten",
        "lines.batten",
        "--curve",
        "part",
        "--with",
        "whole",
    ];
    let found = compared(&folder, &both);
    let keys: Vec<&String> = found.as_object().unwrap().keys().collect();
    let expected = [
        "a", "b", "unit", "largest", "mean", "rms", "from_a", "from_b", "limit", "beyond",
        "whiskers",
    ];
    assert!(
        expected
            .iter()
            .all(|key| keys.contains(&&(*key).to_owned())),
        "{keys:?}"
    );
    assert_eq!(found["largest"], json!(3.0));
    assert_eq!(found["from_a"]["largest"], json!(0.0));
    assert_eq!(found["from_b"]["largest"], json!(3.0));
    assert_eq!(found["from_b"]["point"], json!([4.0, 0.0, 0.0]));
    // Over five units of length, of which four lie on B.
    assert!((found["mean"].as_f64().unwrap() - 0.9).abs() <= 1e-8);
    assert_eq!(found["beyond"], Value::Null);
    let within = compared(&folder, &[&both[..], &["--limit", "3"]].concat());
    assert_eq!(within["beyond"], json!(0));
    let output = folder.run(&[&["compare"], &both[..], &["--limit", "2"]].concat());
    assert_eq!(output.status.code(), Some(1));
    let beyond: Value = serde_json::from_str(&texts(&output).0).unwrap();
    // Of 101 places along B those from x = 3.04 on.
    assert_eq!(beyond["beyond"], json!(25));
    folder.refused(
        &["compare", "lines.batten", "lines.batten"],
        "lines.batten: choose one with --curve: there are “part”, “whole”",
    );
    folder.refused(
        &["compare", "lines.batten", "lines.batten", "--curve", "part"],
        "lines.batten: choose one with --with: there are “part”, “whole”",
    );
    folder.misused(&["compare", "lines.batten"], "required");
}

#[test]
fn points_and_units_are_respected() {
    let curve = json!({"format": "batten", "version": 2, "unit": "in",
        "curves": [line("line", [0.0, 4.0], 0.0)]});
    let millimetres = json!({"format": "batten", "version": 2, "unit": "mm",
        "curves": [line("line", [0.0, 101.6], 25.4)]});
    let folder = Folder::new()
        .with("inches.batten", curve.to_string())
        .with("millimetres.batten", millimetres.to_string())
        .with("points.csv", "x,y\n1,1\n2,-3\n");
    let found = compared(&folder, &["inches.batten", "millimetres.batten"]);
    assert_eq!(found["unit"], json!("in"));
    assert!((found["largest"].as_f64().unwrap() - 1.0).abs() <= 1e-14);
    let found = compared(&folder, &["points.csv", "inches.batten"]);
    assert_eq!(found["from_b"], Value::Null);
    assert_eq!(found["largest"], json!(3.0));
    assert_eq!(found["mean"], json!(2.0));
    assert_eq!(found["from_a"]["side"], json!("right"));
    assert_eq!(found["whiskers"], json!(2));
    folder.refused(
        &["compare", "points.csv", "points.csv"],
        "both are lists of points: fit a curve to one of them",
    );
}
