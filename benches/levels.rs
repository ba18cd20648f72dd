//! Measures curvature and torsion levels: the expansion of a segment, and the levels at many
//! parameters of it, as the plots take them on every frame of a drag.

mod wavy;

use std::hint::black_box;
use std::time::Duration;

use batten::geometry::{FloatPolygon, SegmentExpansion};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use wavy::wavy;

/// Vertices of the curves.
const VERTICES: usize = 200;

/// Samples of a plot of the whole curve.
const SAMPLES: usize = 4096;

/// Each kind of curve: its name, the height of its waves in z, whether it has weights.
const KINDS: [(&str, f64, bool); 4] = [
    ("planar", 0.0, false),
    ("planar rational", 0.0, true),
    ("in space", 1.0, false),
    ("in space rational", 1.0, true),
];

/// Sums the fourth levels of the curvature, so that none can be left out.
fn sampled(polygon: &FloatPolygon, segments: usize, samples: usize) -> f64 {
    let mut sum = 0.0;
    let planar = polygon.is_planar();
    for segment in 0..segments {
        let expansion = SegmentExpansion::new(polygon, segment, planar);
        for index in 0..samples {
            let t = (index as f64 + 0.5) / samples as f64;
            sum += black_box(expansion.curvature_levels(t, 1.0)).curvature[3];
        }
    }
    sum
}

fn plot(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("plot of all levels, a sample");
    for degree in [3, 5, 9] {
        for (name, height, rational) in KINDS {
            let polygon = wavy(VERTICES, degree, height, rational);
            let segments = polygon.segments();
            let samples = SAMPLES / segments;
            group.throughput(Throughput::Elements((segments * samples) as u64));
            group.bench_function(BenchmarkId::new(name, degree), |bencher| {
                bencher.iter(|| sampled(black_box(&polygon), segments, samples));
            });
        }
    }
    group.finish();
}

fn drag(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("the touched segments of a plot, degree 9");
    for (name, height, rational) in KINDS {
        let polygon = wavy(VERTICES, 9, height, rational);
        let samples = SAMPLES / polygon.segments();
        group.bench_function(name, |bencher| {
            bencher.iter(|| sampled(black_box(&polygon), 10, samples));
        });
    }
    group.finish();
}

fn single(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("one segment, degree 9");
    for (name, height, rational) in KINDS {
        let polygon = wavy(VERTICES, 9, height, rational);
        let planar = polygon.is_planar();
        group.bench_function(BenchmarkId::new("expansion", name), |bencher| {
            bencher.iter(|| SegmentExpansion::new(black_box(&polygon), black_box(93), planar));
        });
        let expansion = SegmentExpansion::new(&polygon, 93, planar);
        group.bench_function(BenchmarkId::new("levels", name), |bencher| {
            bencher.iter(|| black_box(&expansion).curvature_levels(black_box(0.3), 1.0));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600));
    targets = plot, drag, single
}
criterion_main!(benches);
