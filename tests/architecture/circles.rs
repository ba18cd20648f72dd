//! Files that import each other: each circle of them has a reason, and stands on the page.

use std::fs;
use std::path::Path;

use crate::assert_no_complaints;
use crate::imports::Imports;
use crate::source::Source;

/// The circles that the section “Circles” of ARCHITECTURE.md lists, each with its reason.
fn justified_circles() -> Vec<(Vec<String>, String)> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("ARCHITECTURE.md");
    let page = fs::read_to_string(page).expect("a readable page");
    let (_, section) = page
        .split_once("\n## Circles\n")
        .expect("a section “Circles”");
    let section = section.split("\n## ").next().unwrap_or_default();
    let entries = section.split("\n- ").skip(1);
    entries
        .map(|entry| {
            let (files, reason) = entry.split_once("`:").expect("files: a reason");
            let files = files.split('`').skip(1).step_by(2).map(str::to_owned);
            (files.collect(), reason.trim().to_owned())
        })
        .collect()
}

#[test]
fn files_that_import_each_other_have_a_reason() {
    let imports = Imports::of(&Source::all());
    let circles = imports.circles();
    let justified = justified_circles();
    let mut complaints = Vec::new();
    for circle in &circles {
        if !justified.iter().any(|(files, _)| files == circle) {
            let files: Vec<String> = circle.iter().map(|file| format!("`{file}`")).collect();
            complaints.push(format!("- {}: a circle without a reason", files.join(", ")));
            let arrows = imports.arrows();
            let inside = arrows.filter(|(from, to)| circle.contains(from) && circle.contains(to));
            complaints.extend(inside.map(|(from, to)| format!("  {from} → {to}")));
        }
    }
    for (files, reason) in &justified {
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        if !circles.contains(&files) {
            complaints.push(format!("{files:?} is no circle: take it off the page"));
        }
        if reason.is_empty() {
            complaints.push(format!("{files:?} has no reason"));
        }
    }
    assert_no_complaints(complaints);
}
