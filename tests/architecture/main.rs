//! What ARCHITECTURE.md says of the layers and files of the library, read from the sources
//! themselves.
//!
//! `geometry ← document ← { analysis, io, operations } ← editor ← paper ← ui`, with `cli` beside the editor.

mod circles;
mod editor;
mod folders;
mod imports;
mod layers;
mod paths;
mod source;
mod words;

use source::Source;

/// What each folder of src may look at, besides itself.
const LAYERS: [(&str, &[&str]); 9] = [
    ("geometry", &[]),
    ("document", &["geometry"]),
    ("analysis", &["document", "geometry"]),
    ("io", &["document", "geometry"]),
    ("operations", &["document", "geometry"]),
    (
        "editor",
        &["analysis", "io", "operations", "document", "geometry"],
    ),
    ("paper", &["editor", "operations", "document", "geometry"]),
    (
        "ui",
        &[
            "paper",
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

/// Complain of what is wrong with any of the sources.
#[track_caller]
fn check_all(sources: &[Source], check: fn(&Source) -> Vec<String>) {
    assert_no_complaints(sources.iter().flat_map(check).collect());
}

#[track_caller]
fn assert_no_complaints(complaints: Vec<String>) {
    assert!(complaints.is_empty(), "\n{}\n", complaints.join("\n"));
}

/// Compare what a check says of a made-up source.
#[track_caller]
fn check(check: fn(&Source) -> Vec<String>, path: &str, text: &str, expected: &[&str]) {
    let source = Source {
        path: path.to_owned(),
        text: text.to_owned(),
    };
    assert_eq!(check(&source), expected, "{path}: {text}");
}
