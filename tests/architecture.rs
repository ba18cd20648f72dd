//! The layers of the library and what each of them may know, read from the sources themselves.
//!
//! `geometry ← document ← { analysis, io, operations } ← editor ← ui`, with `cli` beside the editor.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// What each folder of src may look at, besides itself.
const LAYERS: [(&str, &[&str]); 8] = [
    ("geometry", &[]),
    ("document", &["geometry"]),
    ("analysis", &["document", "geometry"]),
    ("io", &["document", "geometry"]),
    ("operations", &["document", "geometry"]),
    (
        "editor",
        &["analysis", "io", "operations", "document", "geometry"],
    ),
    (
        "ui",
        &[
            "editor",
            "analysis",
            "io",
            "operations",
            "document",
            "geometry",
        ],
    ),
    (
        "cli",
        &["io", "analysis", "operations", "document", "geometry"],
    ),
];

/// What main.rs may look at: it only picks one of the two.
const MAIN: &[&str] = &["cli", "ui"];

/// Crates that only ui and main.rs may name.
const WINDOW_CRATES: [&str; 4] = ["egui", "eframe", "egui_plot", "rfd"];

/// The one file that may touch the disk.
const DISK: &str = "io/disk.rs";

/// The longest a file may be.
const MOST_LINES: usize = 500;

/// Files that may be longer, each with the reason why it is better not divided.
const LONG_FILES: &[(&str, &str)] = &[];

/// Marks of unfinished work.
const UNFINISHED: [&str; 5] = ["TODO", "FIXME", "todo!", "unimplemented!", "dbg!"];

/// A source file: its path below src, with forward slashes, and its text.
struct Source {
    path: String,
    text: String,
}

fn sources() -> Vec<Source> {
    sources_below("src")
}

fn sources_below(folder: &str) -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut folders = vec![root.clone()];
    let mut sources = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a readable folder") {
            let path: PathBuf = entry.expect("a readable entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let below = path.strip_prefix(&root).expect("a path below src");
                let parts = below.iter().map(|part| part.to_string_lossy());
                sources.push(Source {
                    path: parts.collect::<Vec<_>>().join("/"),
                    text: fs::read_to_string(&path).expect("a readable source"),
                });
            }
        }
    }
    assert!(!sources.is_empty(), "{folder} holds no sources");
    sources
}

/// Blank comments and the insides of string literals, so that only code is left; lines stay
/// where they are.
fn code(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (skipped, kept) = if rest.starts_with("//") {
            (rest.find('\n').unwrap_or(rest.len()), "")
        } else if rest.starts_with("/*") {
            (rest.find("*/").map_or(rest.len(), |end| end + 2), "")
        } else if first == '"' {
            (string_length(rest), "\"\"")
        } else if let Some(hashes) = raw_string_hashes(rest) {
            let close = format!("\"{}", "#".repeat(hashes));
            let open = hashes + 2;
            let end = rest[open..].find(&close);
            (
                end.map_or(rest.len(), |end| open + end + close.len()),
                "\"\"",
            )
        } else if rest.starts_with("'\"'") {
            (3, "")
        } else {
            code.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        code.push_str(kept);
        code.extend(rest[..skipped].chars().filter(|c| *c == '\n'));
        rest = &rest[skipped..];
    }
    code
}

fn string_length(text: &str) -> usize {
    let mut escaped = false;
    for (index, character) in text.char_indices().skip(1) {
        match character {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return index + 1,
            _ => {}
        }
    }
    text.len()
}

fn raw_string_hashes(text: &str) -> Option<usize> {
    let behind = text.strip_prefix('r')?;
    let hashes = behind.len() - behind.trim_start_matches('#').len();
    behind[hashes..].starts_with('"').then_some(hashes)
}

fn is_word(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// Split code into words and single other characters, without spaces.
fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

/// List the modules at the top of the library that a file names: behind `crate::`, behind
/// `batten::`, and in groups such as `use crate::{geometry::End, io};`.
fn modules_named(text: &str) -> BTreeSet<String> {
    let code = code(text);
    let tokens = tokens(&code);
    let mut named = BTreeSet::new();
    for (index, window) in tokens.windows(3).enumerate() {
        if !(matches!(window[0], "crate" | "batten") && window[1] == ":" && window[2] == ":") {
            continue;
        }
        let behind = &tokens[index + 3..];
        if behind.first() != Some(&"{") {
            named.extend(behind.first().map(ToString::to_string));
            continue;
        }
        let (mut depth, mut before) = (0, "");
        for token in behind {
            match *token {
                "{" => depth += 1,
                "}" => depth -= 1,
                "," => {}
                name if depth == 1 && matches!(before, "{" | ",") => {
                    named.insert(name.to_owned());
                }
                _ => {}
            }
            before = token;
            if depth == 0 {
                break;
            }
        }
    }
    named
}

/// List the crates or items that a file names by their words.
fn words_named<'a>(text: &str, words: &'a [&str]) -> Vec<&'a str> {
    let code = code(text);
    let tokens = tokens(&code);
    let named = words.iter().filter(|word| tokens.contains(*word));
    named.copied().collect()
}

fn layer(path: &str) -> Option<(&'static str, &'static [&'static str])> {
    let folder = path.split(['/', '.']).next()?;
    let mut layers = LAYERS.iter();
    layers.find(|(name, _)| *name == folder).copied()
}

/// Whether a module named behind `crate::` is a layer; macros and constants are not.
fn is_layer(name: &str) -> bool {
    LAYERS.iter().any(|(layer, _)| *layer == name)
}

fn check_arrows(source: &Source) -> Vec<String> {
    let named = modules_named(&source.text);
    let (this, allowed) = match source.path.as_str() {
        "main.rs" => ("main.rs", MAIN),
        "lib.rs" => return Vec::new(),
        path => match layer(path) {
            Some(layer) => layer,
            None => return vec![format!("src/{path} belongs to no layer of the table")],
        },
    };
    let wrong = named.iter().filter(|name| {
        is_layer(name) && name.as_str() != this && !allowed.contains(&name.as_str())
    });
    wrong
        .map(|name| {
            format!(
                "src/{} names {name}, but {this} may only look at {allowed:?}",
                source.path
            )
        })
        .collect()
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
    let tokens = tokens(&code);
    let path = ["std", ":", ":", "fs"];
    let group = ["std", ":", ":", "{"];
    let names = tokens.windows(4).enumerate().any(|(index, window)| {
        let grouped = || {
            let inside = tokens[index..].iter().take_while(|token| **token != ";");
            inside.into_iter().any(|token| *token == "fs")
        };
        window == path || (window == group && grouped())
    });
    if names && source.path != DISK {
        let complaint = format!("src/{} names std::fs: only src/{DISK} may", source.path);
        return vec![complaint];
    }
    Vec::new()
}

fn check_words(source: &Source) -> Vec<String> {
    let mut complaints = Vec::new();
    let mut lines = source.text.lines().zip(1..);
    complaints.extend(lines.by_ref().flat_map(|(line, number)| {
        let found = UNFINISHED.iter().filter(|mark| line.contains(**mark));
        found.map(move |mark| format!("src/{}:{number} says {mark}", source.path))
    }));
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

fn check_length(source: &Source) -> Vec<String> {
    let lines = source.text.lines().count();
    let excused = LONG_FILES.iter().any(|(path, _)| *path == source.path);
    if lines > MOST_LINES && !excused {
        return vec![format!(
            "src/{} has {lines} lines: divide it by its nouns, or list it in LONG_FILES with the \
             reason why it is better whole",
            source.path
        )];
    }
    Vec::new()
}

#[track_caller]
fn check_all(check: fn(&Source) -> Vec<String>) {
    let complaints: Vec<String> = sources().iter().flat_map(check).collect();
    assert!(complaints.is_empty(), "\n{}\n", complaints.join("\n"));
}

#[test]
fn no_layer_looks_the_wrong_way() {
    check_all(check_arrows);
}

#[test]
fn only_the_ui_knows_the_window() {
    check_all(check_window);
}

#[test]
fn only_one_file_touches_the_disk() {
    check_all(check_disk);
}

#[test]
fn nothing_is_unsafe_or_unfinished() {
    check_all(check_words);
}

#[test]
fn properties_are_repeatable() {
    check_all(check_properties);
    let complaints: Vec<String> = sources_below("tests")
        .iter()
        .flat_map(check_properties)
        .collect();
    assert!(complaints.is_empty(), "\n{}\n", complaints.join("\n"));
}

#[test]
fn no_file_is_too_long_without_a_reason() {
    check_all(check_length);
    for folder in ["tests", "benches"] {
        for Source { path, text } in sources_below(folder) {
            let lines = text.lines().count();
            assert!(lines <= MOST_LINES, "{folder}/{path} has {lines} lines");
        }
    }
    for (path, _) in LONG_FILES {
        let source = sources().into_iter().find(|source| source.path == *path);
        let still_long = source.is_some_and(|source| source.text.lines().count() > MOST_LINES);
        assert!(still_long, "LONG_FILES lists src/{path}, which is not long");
    }
}

#[track_caller]
fn check(check: fn(&Source) -> Vec<String>, path: &str, text: &str, expected: &[&str]) {
    let source = Source {
        path: path.to_owned(),
        text: text.to_owned(),
    };
    assert_eq!(check(&source), expected, "{path}: {text}");
}

#[test]
fn an_arrow_against_the_table_is_caught() {
    let wrong = ["src/geometry/jet.rs names document, but geometry may only look at []"];
    for text in [
        "use crate::document::Curve;",
        "pub use crate::document;",
        "use crate::{geometry::{End, document}, document::Curve};",
        "use crate::{\n    geometry,\n    document,\n};",
        "fn f() -> crate::document::Curve { x }",
        "#[cfg(test)] mod tests { use crate :: document::Curve; }",
        "/* \" */ use crate::document::Curve; // \"",
        "const QUOTE: char = '\"'; use crate::document::Curve; const S: &str = \"\";",
    ] {
        check(check_arrows, "geometry/jet.rs", text, &wrong);
    }
    let siblings =
        ["src/io/dxf.rs names analysis, but io may only look at [\"document\", \"geometry\"]"];
    check(
        check_arrows,
        "io/dxf.rs",
        "use crate::analysis::Comb;",
        &siblings,
    );
    let main = ["src/main.rs names editor, but main.rs may only look at [\"cli\", \"ui\"]"];
    check(
        check_arrows,
        "main.rs",
        "use batten::editor::Editor;",
        &main,
    );
    let stray = ["src/helpers.rs belongs to no layer of the table"];
    check(check_arrows, "helpers.rs", "", &stray);
}

#[test]
fn what_the_table_allows_is_let_through() {
    for (path, text) in [
        (
            "geometry/jet.rs",
            "use crate::geometry::End; use super::vector;",
        ),
        ("geometry/jet.rs", "use crate::{geometry::{io, ui}};"),
        (
            "geometry/jet.rs",
            "// see crate::document\nconst S: &str = \"crate::io::\\\"x\";",
        ),
        (
            "geometry/jet.rs",
            "const S: &str = r#\"use crate::io; \"\"#;",
        ),
        ("document/edit.rs", "use crate::geometry::FloatPolygon;"),
        ("ui/canvas.rs", "use crate::{editor::Tool, geometry::End};"),
        ("cli.rs", "use crate::io::project;"),
        (
            "main.rs",
            "fn main() { batten::cli::run(); batten::ui::run(); }",
        ),
        ("lib.rs", "pub use crate::ui::run;"),
    ] {
        check(check_arrows, path, text, &[]);
    }
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

    assert_eq!(check_length(&long_source(MOST_LINES)).len(), 0);
    assert_eq!(check_length(&long_source(MOST_LINES + 1)).len(), 1);
}

fn long_source(lines: usize) -> Source {
    Source {
        path: "io/long.rs".to_owned(),
        text: "\n".repeat(lines),
    }
}
