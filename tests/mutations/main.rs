//! Damaged files of every format: no reader panics or hangs, and none takes more memory than it may.
//!
//! `cargo test --test mutations` reads 5 000 of each format. The longer run reads 1 000 000 of each:
//!
//!     cargo test --release --test mutations -- --ignored --nocapture
//!
//! `BATTEN_MUTATIONS=N` reads N instead, `BATTEN_MUTATION_SEED=S` others. `BATTEN_CORPUS=DIR` damages the files of a
//! folder too. A reader that takes too much memory ends the whole run: the format is the one told last.

#[path = "../../src/io/exchange/mutate.rs"]
mod mutate;

use std::alloc::System;
use std::cell::Cell;
use std::fs;
use std::io::Cursor;

use batten::document::{Curve, Document, Reference};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{FloatPolygon, PolygonKind};
use batten::io::{Format, PICTURE, formats};
use cap::Cap;
use glam::DVec3;
use image::{ImageFormat, Rgb, RgbImage};

/// The bytes that reading one of these small files may take beside what there is.
const MEMORY: usize = 64 << 20;

/// The same of a picture: a damaged TIFF makes its library reserve room for 128 MB of a list's entries.
const PICTURE_MEMORY: usize = 256 << 20;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Curves of several degrees: planar, in space, rational, periodic; and points.
fn documents() -> Vec<Document> {
    let vertices = |count: usize, height: f64| -> Vec<DVec3> {
        let angle = |it: usize| 0.7 * it as f64;
        let vertex = |it: usize| {
            let (sine, cosine) = angle(it).sin_cos();
            DVec3::new(10.0 * cosine, 7.5 * sine, height * it as f64)
        };
        (0..count).map(vertex).collect()
    };
    let polygon = |degree, count, height, weights: Option<Vec<f64>>, periodic| {
        let polygon = FloatPolygon::new(degree, vertices(count, height), weights, periodic);
        polygon.expect("a polygon")
    };
    let weights = (0..8).map(|it| 1.0 + 0.25 * f64::from(it)).collect();
    let curve = |name: &str, polygon| Curve::new(name.to_owned(), polygon);
    let points = PointList::new(vertices(20, 0.0)).expect("points");
    let points = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
    vec![
        Document::from_curves([
            curve("planar", polygon(3, 8, 0.0, None, false)),
            curve("long", polygon(5, 30, 0.0, None, false)),
        ]),
        Document::from_curves([
            curve("space", polygon(4, 9, 1.0, None, false)),
            curve("rational", polygon(3, 8, 0.5, Some(weights), false)),
        ]),
        Document::from_curves([curve("periodic", polygon(3, 9, 0.0, None, true))])
            .with_references([Reference::new("points", points.clone())]),
        Document::default().with_references([Reference::new("points", points)]),
    ]
}

/// What a format cannot write itself.
const READ_ONLY: [(&str, &str); 1] = [(
    "GPX",
    "<?xml version=\"1.0\"?><gpx version=\"1.1\" xmlns=\"http://www.topografix.com/GPX/1/1\"><trk><name>a</name>\
     <trkseg><trkpt lat=\"47.1\" lon=\"8.2\"><ele>410.5</ele></trkpt><trkpt lat=\"47.2\" lon=\"8.25\"/>\
     <trkpt lat=\"47.25\" lon=\"8.3\"/></trkseg></trk></gpx>",
)];

/// Files of a format: the documents as it writes them, and those of the corpus.
fn samples(format: &Format) -> Vec<Vec<u8>> {
    let written = documents().into_iter().flat_map(|document| {
        let kinds = [None, Some(PolygonKind::Float)];
        let files = kinds.map(|kind| format.write(&document, kind));
        files.into_iter().flatten().map(|export| export.bytes)
    });
    let known = READ_ONLY.iter().filter(|(name, _)| *name == format.name);
    let known = known.map(|(_, text)| text.as_bytes().to_vec());
    let pictures = (format.name == PICTURE.name).then(pictures);
    let pictures = pictures.into_iter().flatten();
    let samples = written.chain(known).chain(pictures);
    let samples = samples.chain(corpus(format));
    samples.filter(|bytes| format.read(bytes).is_ok()).collect()
}

/// A small picture in every format.
fn pictures() -> Vec<Vec<u8>> {
    use ImageFormat::{Jpeg, Png, Tiff, WebP};
    let picture = RgbImage::from_fn(19, 12, |x, y| Rgb([(9 * x) as u8, (17 * y) as u8, 80]));
    let encoded = [Png, Jpeg, WebP, Tiff].map(|format| {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("a picture");
        bytes.into_inner()
    });
    encoded.to_vec()
}

/// The small files of the folder that `BATTEN_CORPUS` names.
fn corpus(format: &Format) -> Vec<Vec<u8>> {
    let Some(folder) = std::env::var_os("BATTEN_CORPUS") else {
        return Vec::new();
    };
    let files = fs::read_dir(folder).expect("a folder").flatten();
    let is_own = |path: &std::path::Path| {
        let extension = path.extension().and_then(|it| it.to_str());
        extension.is_some_and(|it| format.extensions.contains(&it.to_lowercase().as_str()))
    };
    let files = files.map(|entry| entry.path()).filter(|it| is_own(it));
    let files = files.filter_map(|path| fs::read(path).ok());
    files.filter(|bytes| bytes.len() < 1 << 17).collect()
}

fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().expect("a number"))
}

/// Read so many damaged files of each format.
fn run(times: u64) {
    let times = number("BATTEN_MUTATIONS").unwrap_or(times) as usize;
    let seed = number("BATTEN_MUTATION_SEED").unwrap_or(1);
    for format in formats::readable() {
        println!("{}", format.name);
        let samples = samples(format);
        assert!(!samples.is_empty(), "no sample of {}", format.name);
        let [read, refused] = [const { Cell::new(0) }; 2];
        let times = times.div_ceil(samples.len());
        let memory = match *format == PICTURE {
            true => PICTURE_MEMORY,
            false => MEMORY,
        };
        mutate::all(&samples, times, seed, |bytes| {
            ALLOCATOR
                .set_limit(ALLOCATOR.allocated() + memory)
                .expect("a limit");
            let result = format.read(bytes);
            ALLOCATOR.set_limit(usize::MAX).expect("no limit");
            match result {
                Ok(_) => read.set(read.get() + 1),
                Err(error) => {
                    assert!(!error.to_string().is_empty());
                    refused.set(refused.get() + 1);
                }
            }
        });
        println!("  {} read, {} refused", read.get(), refused.get());
        assert!(refused.get() > 0, "{}: no damage was noticed", format.name);
    }
}

#[test]
fn damaged_files_neither_panic_nor_hang() {
    run(5000);
}

#[test]
#[ignore = "a million files of each format take an hour"]
fn a_million_damaged_files_neither_panic_nor_hang() {
    run(1_000_000);
}
