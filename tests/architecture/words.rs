//! Words that only some files may have, or none.

use crate::paths::named_paths;
use crate::source::{Source, code, tokens};
use crate::{check, check_all};

/// Crates that only ui and main.rs may name.
const WINDOW_CRATES: [&str; 4] = ["egui", "eframe", "egui_plot", "rfd"];

/// The one file that may touch the disk.
const DISK: &str = "io/disk.rs";

/// The files that say whether a request is reached, and repeat it in reports.
const JUDGES: [&str; 3] = [
    "operations/operation.rs",
    "operations/outcome.rs",
    "operations/report.rs",
];

/// Marks of unfinished work.
const UNFINISHED: [&str; 5] = ["TODO", "FIXME", "todo!", "unimplemented!", "dbg!"];

/// List the crates or items that a file names by their words.
fn words_named<'a>(text: &str, words: &'a [&str]) -> Vec<&'a str> {
    let code = code(text);
    let tokens = tokens(&code);
    let named = words.iter().filter(|word| tokens.contains(*word));
    named.copied().collect()
}

fn check_window(source: &Source) -> Vec<String> {
    if source.path.starts_with("ui/") || ["ui.rs", "main.rs"].contains(&source.path.as_str()) {
        return Vec::new();
    }
    let named = words_named(&source.text, &WINDOW_CRATES);
    let complain = |name: &str| format!("src/{} names {name}: only ui may", source.path);
    named.into_iter().map(complain).collect()
}

fn check_disk(source: &Source) -> Vec<String> {
    let code = code(&source.text);
    let is_disk =
        |names: &[String]| matches!(names, [first, second, ..] if first == "std" && second == "fs");
    let mut paths = named_paths(&tokens(&code)).into_iter();
    if source.path != DISK && paths.any(|path| is_disk(&path.names)) {
        let complaint = format!("src/{} names std::fs: only src/{DISK} may", source.path);
        return vec![complaint];
    }
    Vec::new()
}

/// Whether an operation says itself that its request is reached: the check of requirements alone may.
fn check_reached(source: &Source) -> Vec<String> {
    if !source.path.starts_with("operations/") || JUDGES.contains(&source.path.as_str()) {
        return Vec::new();
    }
    let code = code(&source.text);
    let tokens = tokens(&code);
    // An assignment, and no comparison.
    let said = tokens.windows(3).filter(|words| match words {
        ["reached", mark @ ("=" | ":"), next] => next != mark,
        _ => false,
    });
    let complaint = |_| {
        format!(
            "src/{} sets reached: only the check of requirements may",
            source.path
        )
    };
    said.map(complaint).collect()
}

fn check_words(source: &Source) -> Vec<String> {
    let lines = source.text.lines().zip(1..);
    let mut complaints: Vec<String> = lines
        .flat_map(|(line, number)| {
            let found = UNFINISHED.iter().filter(move |mark| line.contains(**mark));
            found.map(move |mark| format!("src/{}:{number} says {mark}", source.path))
        })
        .collect();
    if words_named(&source.text, &["unsafe"]) == ["unsafe"] {
        complaints.push(format!("src/{} is unsafe", source.path));
    }
    complaints
}

/// Whether all properties draw their cases from a seed that is known: see tests/common/repeatable.rs.
fn check_properties(source: &Source) -> Vec<String> {
    let code = code(&source.text);
    let tokens = tokens(&code);
    let blocks = tokens.windows(2).enumerate();
    let blocks = blocks.filter(|(_, window)| *window == ["proptest", "!"]);
    let chance = blocks.filter(|(index, _)| {
        let mut head = tokens[*index..].iter().take_while(|token| **token != "fn");
        !head.any(|token| *token == "repeatable")
    });
    let complaint = || {
        let path = &source.path;
        format!("{path} has properties without #![proptest_config(common::repeatable())]")
    };
    chance.map(|_| complaint()).collect()
}

#[test]
fn only_the_ui_knows_the_window() {
    check_all(&Source::all(), check_window);
}

#[test]
fn only_one_file_touches_the_disk() {
    check_all(&Source::all(), check_disk);
}

#[test]
fn no_operation_says_itself_that_it_is_reached() {
    check_all(&Source::all(), check_reached);
    let said = ["src/operations/fit.rs sets reached: only the check of requirements may"];
    for text in [
        "fn f() { outcome.reached = true; }",
        "fn f() { Outcome { reached: true } }",
    ] {
        check(check_reached, "operations/fit.rs", text, &said);
        check(check_reached, "operations/operation.rs", text, &[]);
    }
    check(
        check_reached,
        "operations/fit.rs",
        "fn f() -> bool { a.reached == b.reached }",
        &[],
    );
}

#[test]
fn nothing_is_unsafe_or_unfinished() {
    check_all(&Source::all(), check_words);
}

#[test]
fn properties_are_repeatable() {
    check_all(&Source::all(), check_properties);
    check_all(&Source::below("tests"), check_properties);
}

#[test]
fn window_crates_the_disk_unfinished_work_and_chance_are_caught() {
    let egui = ["src/editor/tool.rs names egui: only ui may"];
    check(
        check_window,
        "editor/tool.rs",
        "fn f(x: egui::Pos2) {}",
        &egui,
    );
    check(check_window, "editor/tool.rs", "//! Knows no egui.", &[]);
    check(check_window, "ui/canvas.rs", "use egui::Ui;", &[]);

    let disk = ["src/io/csv.rs names std::fs: only src/io/disk.rs may"];
    for text in [
        "use std::fs;",
        "use std::{fs, io};",
        "use std::fs::File;",
        "fn f() { std::fs::read(x); }",
    ] {
        check(check_disk, "io/csv.rs", text, &disk);
        check(check_disk, "io/disk.rs", text, &[]);
    }
    check(check_disk, "io/csv.rs", "use std::{fmt, io};", &[]);

    let mark = ["dbg", "!(x)"].concat();
    let found = ["src/io/csv.rs:2 says dbg!"];
    check(check_words, "io/csv.rs", &format!("\n{mark}"), &found);
    let found = ["src/io/csv.rs is unsafe"];
    check(check_words, "io/csv.rs", "unsafe { f() }", &found);
    check(check_words, "lib.rs", "#![forbid(unsafe_code)]", &[]);

    let chance = ["line.rs has properties without #![proptest_config(common::repeatable())]"];
    for text in [
        "proptest! { #[test] fn f() {} }",
        "proptest!(|(x in 0..9)| {});",
    ] {
        check(check_properties, "line.rs", text, &chance);
    }
    let seeded = "proptest! { #![proptest_config(common::repeatable())] #[test] fn f() {} }";
    check(check_properties, "line.rs", seeded, &[]);
}
