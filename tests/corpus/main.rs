//! Real files of many programs, as an inventory lists them: what independent readers found in each.
//!
//! `BATTEN_CORPUS=DIR cargo test --test corpus -- --ignored`: the folder holds the files and `inventory.json`, a list of
//! objects with `file`, `format` and, by format, `objects` (3DM), `modelspace` and `insunits` (DXF), `contours` (GLIF)
//! or `raw` (STEP, IGES).

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use batten::io::disk;
use batten::io::exchange::drawing::{Drawing, Kind, Space};
use serde_json::Value;

/// The longest that a file may take, in seconds.
const LONGEST: f64 = 5.0;

/// How many free items of a kind a file has, without those of blocks.
fn counted(drawing: &Drawing) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    let free = drawing.items.iter();
    for item in free.filter(|item| item.space == Space::Model && item.block.is_none()) {
        *counts.entry(item.kind.name()).or_default() += 1;
    }
    counts
}

/// The sum of some counts of an object.
fn sum(counts: &Value, names: &[&str]) -> usize {
    let numbers = names.iter().filter_map(|name| counts.get(name)?.as_u64());
    numbers.sum::<u64>() as usize
}

/// The differences between a drawing and its row of the inventory.
fn differences(drawing: &Drawing, row: &Value) -> Vec<String> {
    let counts = counted(drawing);
    let found =
        |kinds: &[&str]| -> usize { kinds.iter().filter_map(|kind| counts.get(kind)).sum() };
    let mut differences = Vec::new();
    let mut compare = |kinds: &[&str], expected: usize| {
        let found = found(kinds);
        if found != expected {
            differences.push(format!(
                "{} {}, expected {expected}",
                found,
                kinds.join(" or ")
            ));
        }
    };
    match row["format"].as_str() {
        Some("3dm") => {
            let objects = &row["objects"];
            compare(&["spline"], sum(objects, &["NurbsCurve"]));
            compare(&["polycurve"], sum(objects, &["PolyCurve"]));
            compare(&["line"], sum(objects, &["LineCurve"]));
            compare(&["polyline"], sum(objects, &["PolylineCurve"]));
            compare(&["arc", "circle"], sum(objects, &["ArcCurve"]));
        }
        Some("dxf") if row.get("modelspace").is_some() => {
            let entities = &row["modelspace"];
            compare(&["spline"], sum(entities, &["SPLINE", "HELIX"]));
            compare(&["line"], sum(entities, &["LINE"]));
            compare(&["arc"], sum(entities, &["ARC"]));
            compare(&["circle"], sum(entities, &["CIRCLE"]));
            compare(&["ellipse"], sum(entities, &["ELLIPSE"]));
            compare(&["point"], sum(entities, &["POINT"]));
        }
        Some("glif") => {
            // A contour of one point is an anchor.
            let anchors = drawing.other.iter().filter(|other| other.kind == "anchor");
            let anchors: usize = anchors.map(|other| other.count).sum();
            compare(&["path"], sum(row, &["contours"]) - anchors);
        }
        _ => {}
    }
    differences
}

fn corpus() -> PathBuf {
    let folder = std::env::var_os("BATTEN_CORPUS").expect("BATTEN_CORPUS names the folder");
    PathBuf::from(folder)
}

fn is_refused(path: &Path, error: &str) -> bool {
    // Version 1 of 3DM is refused by name.
    path.extension().is_some_and(|it| it == "3dm") && error.contains("version 1")
}

#[test]
#[ignore = "needs the files; BATTEN_CORPUS names their folder"]
fn every_file_holds_what_the_inventory_says() {
    let folder = corpus();
    let text = std::fs::read_to_string(folder.join("inventory.json")).expect("inventory.json");
    let rows: Vec<Value> = serde_json::from_str(&text).expect("JSON");
    let (mut read, mut complaints) = (0, Vec::new());
    for row in &rows {
        let name = row["file"].as_str().expect("a file");
        let path = folder.join(name);
        let is_drawing = batten::io::formats::to_read(&path).is_ok_and(|format| format.draws());
        if !is_drawing {
            continue;
        }
        let began = std::time::Instant::now();
        match disk::draw_file(&path, None) {
            Ok((drawing, _)) => {
                read += 1;
                let found = differences(&drawing, row);
                complaints.extend(found.into_iter().map(|it| format!("{name}: {it}")));
                // Whatever is in it becomes curves and references, or a remark.
                let reading = drawing.reading();
                let splines = drawing
                    .items
                    .iter()
                    .filter(|item| item.kind == Kind::Spline);
                let is_silent = reading.is_empty() && reading.remarks.is_empty();
                assert!(
                    !is_silent || splines.count() == 0,
                    "{name}: nothing is told"
                );
            }
            Err(error) if is_refused(&path, &error.to_string()) => {}
            Err(error) => complaints.push(format!("{name}: {error}")),
        }
        let took = began.elapsed().as_secs_f64();
        if took > LONGEST {
            complaints.push(format!("{name}: {took:.1} s"));
        }
    }
    println!("{read} files read");
    assert!(
        read > 0 && complaints.is_empty(),
        "{}",
        complaints.join("\n")
    );
}
