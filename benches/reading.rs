//! Measures how long files of 10 MB take to be read and to become curves and references.

use std::hint::black_box;
use std::time::Duration;

use batten::document::{Curve, Document};
use batten::geometry::FloatPolygon;
use batten::io::{Format, formats};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;

/// The size of a file, in bytes.
const SIZE: usize = 10_000_000;

/// Curves of several degrees, about as long as those of real files, that rise by a height a radian.
fn document(curves: usize, height: f64) -> Document {
    let curve = |index: usize| {
        let degree = 3 + index % 5;
        let vertices = (0..12 + index % 30).map(|vertex| {
            let turn = 0.31 * vertex as f64 + 0.01 * index as f64;
            DVec3::new(
                40.0 * turn.cos() + index as f64,
                25.0 * turn.sin(),
                height * turn,
            )
        });
        let polygon = FloatPolygon::new(degree, vertices.collect(), None, false);
        Curve::new(format!("curve {index}"), polygon.expect("a polygon"))
    };
    Document::from_curves((0..curves).map(curve))
}

/// A file of a format, of about the size.
fn file(format: &Format, height: f64) -> Vec<u8> {
    let written = |curves: usize| {
        let written = format.write(&document(curves, height), None);
        written.expect("a file").bytes
    };
    let few = 200;
    let one = written(few).len() / few;
    written(SIZE / one)
}

fn reading(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("10 MB");
    for extension in ["step", "dxf", "igs", "3dm", "svg"] {
        let format = formats::find(extension).expect("a format");
        // A drawing has no height.
        let height = if extension == "svg" { 0.0 } else { 1.0 };
        let bytes = file(format, height);
        group.throughput(Throughput::Bytes(bytes.len() as u64));
        group.bench_function(format!("{format} to a drawing"), |bencher| {
            bencher.iter(|| format.draw(black_box(&bytes)).expect("a drawing"));
        });
        group.bench_function(format!("{format} to curves"), |bencher| {
            bencher.iter(|| format.read(black_box(&bytes)).expect("curves"));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .measurement_time(Duration::from_secs(5));
    targets = reading
}
criterion_main!(benches);
