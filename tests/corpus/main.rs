//! Real files of many programs, as an inventory lists them: what independent readers found in each.
//!
//! `BATTEN_CORPUS=DIR cargo test --test corpus -- --ignored`: the folder holds the files and `inventory.json`, a list of
//! objects with `file`, `format` and, by format, `objects` (3DM), `modelspace` and `insunits` (DXF), `contours` (GLIF)
//! or `raw` (STEP, IGES).

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use batten::document::{CurveId, Document, Edit};
use batten::geometry::references::Placement;
use batten::io::exchange::drawing::{Drawing, Kind, Space};
use batten::io::{Original, Rest, disk, formats};
use glam::DVec3;
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

/// Of the size of a drawing: what its transforms cost there and back.
const ROUNDING: f64 = 1e-12;

/// How many items of a file are moved.
const MOVED: usize = 12;

/// A document with one curve or reference moved.
fn moved(document: &Document, id: CurveId, by: DVec3) -> Document {
    let edit = match (document.curve(id), document.reference(id)) {
        (Some(curve), _) => {
            let vertices = curve.polygon.vertices().iter().map(|vertex| vertex + by);
            let moves = vertices.enumerate().collect();
            Edit::MoveVertices { curve: id, moves }
        }
        (None, reference) => {
            let own = &reference.expect("a reference").curve;
            let placement = own.placement();
            let to = placement.translation() + by;
            let placement = Placement::new(placement.rotation(), placement.scale(), to);
            let curve = own.clone().placed(placement.expect("a placement"));
            Edit::SetReference {
                reference: id,
                curve,
            }
        }
    };
    document.edited([edit]).expect("an edit")
}

/// Points of a document's curves and references, sorted: what is read again may have other names and seams.
fn places(document: &Document) -> Vec<[f64; 2]> {
    let shapes = document.all_ids().filter_map(|id| document.shape(id));
    let mut places: Vec<[f64; 2]> = shapes
        .flat_map(|shape| {
            let ends = [0.0, shape.pieces() as f64];
            ends.map(|u| shape.jet(u).point).map(|it| [it.x, it.y])
        })
        .collect();
    places.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    places
}

#[test]
#[ignore = "needs the files; BATTEN_CORPUS names their folder"]
fn what_is_not_edited_in_a_drawing_keeps_its_bytes() {
    let folder = corpus();
    let (mut files, mut kept, mut lost) = (0, 0, BTreeMap::<String, usize>::new());
    for extension in ["svg", "glif"] {
        let format = formats::find(extension).expect("a format");
        let paths = std::fs::read_dir(folder.join(extension)).expect("the folder");
        for path in paths.flatten().map(|it| it.path()) {
            let bytes = std::fs::read(&path).expect("the file");
            let Ok(reading) = format.read(&bytes) else {
                continue;
            };
            files += 1;
            let document = reading.into_document().expect("a document");
            let original = Original::new(format, bytes.clone(), document.clone());
            let same = original.written_back(&document).expect("the same file");
            assert!(same.export.bytes == bytes, "{}", path.display());
            let all: Vec<CurveId> = document.all_ids().collect();
            let size = places(&document)
                .iter()
                .flatten()
                .fold(1.0_f64, |size, it| size.max(it.abs()));
            let step = all.len().div_ceil(MOVED).max(1);
            for id in all.iter().copied().step_by(step) {
                let name = document.name(id).expect("a name");
                let place = format!("{}, {name}", path.display());
                let edited = moved(&document, id, DVec3::new(0.25 * size, 0.125 * size, 0.0));
                let written = match original.written_back(&edited) {
                    Ok(written) => written,
                    Err(error) => panic!("{place}: {error}"),
                };
                let why = match written.rest {
                    Rest::Kept => None,
                    Rest::Lost(why) => Some(why.expect("a reason")),
                };
                if let Some(why) = why {
                    let kind = why.split('”').next_back().unwrap_or_default();
                    *lost.entry(kind.to_owned()).or_default() += 1;
                    continue;
                }
                kept += 1;
                // All but one element is as it was.
                let new = &written.export.bytes;
                let start = bytes.iter().zip(new).take_while(|(a, b)| a == b).count();
                let pairs = bytes.iter().rev().zip(new.iter().rev());
                let end = pairs.take_while(|(a, b)| a == b).count();
                let changed = bytes.get(start..bytes.len().saturating_sub(end));
                let tags = changed.unwrap_or_default().iter();
                let tags = tags.filter(|byte| **byte == b'<').count();
                assert!(extension == "glif" || tags <= 1, "{place}: {tags} tags");
                let again = format.read(new).expect("a drawing").into_document();
                let again = places(&again.expect("a document"));
                let expected = places(&edited);
                assert_eq!(again.len(), expected.len(), "{place}");
                for (a, b) in again.iter().zip(&expected) {
                    let off = (a[0] - b[0]).abs();
                    assert!(off <= ROUNDING * size, "{place}: {a:?} {b:?}");
                }
            }
        }
    }
    println!("{files} files, {kept} edits in place, others: {lost:?}");
    assert!(files > 0 && kept > 0);
}
