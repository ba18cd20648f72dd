//! The standard input and output in place of files, and formats that names do not tell.

use std::fs;
use std::io::Write;
use std::process::{Command as Process, Output, Stdio};

use assert_cmd::cargo::cargo_bin;
use serde_json::{Value, json};

use super::folder::*;

/// Run the program with an input.
fn piped(folder: &Folder, arguments: &[&str], input: &[u8]) -> Output {
    let mut process = Process::new(cargo_bin!("batten"));
    process.args(arguments).current_dir(folder.0.path());
    let process = process.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = process.stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn curves_pass_through_pipes() {
    let folder = Folder::new();
    folder.done(&["example", "hull", "hull.batten"]);
    let (project, report) = folder.done(&["example", "hull", "-", "--to-format", "batten"]);
    assert_eq!(
        project,
        fs::read_to_string(folder.path("hull.batten")).unwrap()
    );
    assert_eq!(report, "");
    let arguments = ["convert", "-", "-", "--from-format", "batten"];
    let to = |format| [&arguments[..], &["--to-format", format]].concat();
    let table = piped(&folder, &to("csv"), project.as_bytes());
    assert_eq!(table.status.code(), Some(0));
    let arguments = ["convert", "-", "--from-format", "csv", "back.batten"];
    let back = piped(&folder, &arguments, &table.stdout);
    assert_eq!(texts(&back), (String::new(), String::new()));
    assert_eq!(
        fs::read_to_string(folder.path("back.batten")).unwrap(),
        project
    );
    let inspected = piped(
        &folder,
        &["inspect", "-", "--from-format", "csv", "--at", "1"],
        &table.stdout,
    );
    let inspected: Value = serde_json::from_slice(&inspected.stdout).unwrap();
    assert_eq!(
        inspected,
        folder.inspect(&["hull.batten", "--at", "1"]),
        "the same curve"
    );
    let drawing = piped(&folder, &to("dxf"), project.as_bytes());
    folder.done(&["convert", "hull.batten", "hull.dxf"]);
    assert_eq!(drawing.stdout, fs::read(folder.path("hull.dxf")).unwrap());
}

#[test]
fn what_is_told_does_not_mix_with_what_is_written() {
    let input = project(
        json!([{"name": "a", "degree": 1, "vertices": [[0, 0], [1, 1]],
        "colour": "#102030", "weigths": 7}]),
    );
    let output = piped(
        &Folder::new(),
        &[
            "convert",
            "-",
            "-",
            "--from-format",
            "batten",
            "--to-format",
            "csv",
        ],
        input.as_bytes(),
    );
    let (out, err) = texts(&output);
    assert_eq!(
        out,
        "# degree=1 polygon=float periodic=false name=a\nx,y\n0.0,0.0\n1.0,1.0\n"
    );
    assert_eq!(
        err,
        "batten: standard input: curve 1 “a”: the key “weigths” is not known and has no effect\n\
         batten: “a”: the colour isn't stored in the CSV table\n\
         batten: “a”: unknown keys aren't stored in the CSV table\n"
    );
}

#[test]
fn bad_input_from_a_pipe_is_refused_with_its_place() {
    let folder = Folder::new();
    for arguments in [
        &["convert", "-", "out.batten", "--from-format", "csv"][..],
        &["inspect", "-", "--from-format", "csv"],
    ] {
        let output = piped(&folder, arguments, b"# degree=1\nx,y\n0,0\n1\n");
        assert_eq!(output.status.code(), Some(1));
        let expected = "batten: standard input: line 4: 1 value for 2 columns\n";
        assert_eq!(texts(&output), (String::new(), expected.to_owned()));
    }
    assert!(!folder.path("out.batten").exists());
}

#[test]
fn a_pipe_needs_a_format() {
    let folder = Folder::new();
    folder.done(&["example", "arc", "arc.batten"]);
    folder.misused(&["convert", "-", "out.csv"], "--from-format");
    folder.misused(&["inspect", "-"], "--from-format");
    folder.misused(&["convert", "arc.batten", "-"], "--to-format");
    folder.misused(&["example", "arc", "-"], "--to-format");
    folder.misused(
        &["convert", "-", "out.csv", "--from-format", "docx"],
        "possible values: batten, csv, tsv, dat, gpx, dxf, step",
    );
    assert!(!folder.path("-").exists());
}

#[test]
fn a_format_that_is_given_goes_before_the_name() {
    let folder = Folder::new().with("points.txt", "# degree=1\nx;y\n0;0,5\n1;1\n");
    let (out, err) = folder.done(&[
        "convert",
        "points.txt",
        "curve.json",
        "--from-format",
        "csv",
        "--to-format",
        "batten",
    ]);
    assert_eq!(out, "");
    assert_eq!(
        err,
        "batten: points.txt: read with semicolons between columns and decimal commas\n"
    );
    let found = folder.inspect(&["curve.json", "--from-format", "batten"]);
    assert_eq!(found["curves"][0]["float"], json!([[0.0, 0.5], [1.0, 1.0]]));
    folder.refused(
        &[
            "convert",
            "points.txt",
            "points.txt",
            "--from-format",
            "csv",
            "--to-format",
            "csv",
        ],
        "points.txt: a file is not converted into itself",
    );
}
