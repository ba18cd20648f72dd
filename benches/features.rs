//! Measures the proofs of single segments and putting a curve's features together.

mod wavy;

use std::hint::black_box;
use std::time::Duration;

use batten::geometry::Progress;
use batten::geometry::features::{Feature, Features, SegmentFeatures, SegmentProver};
use batten::geometry::vertex_moves::{LossSearch, MoveProver, RegionSearch};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::DVec3;
use wavy::wavy;

/// Vertices of the curves that are put together.
const VERTICES: usize = 1000;

/// A closed wavy line with many inflections and extrema.
fn segments(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("features of one segment");
    group
        .measurement_time(Duration::from_secs(2))
        .warm_up_time(Duration::from_millis(500));
    for (name, height, rational) in [
        ("planar", 0.0, false),
        ("planar rational", 0.0, true),
        ("space", 3.0, false),
        ("space rational", 3.0, true),
    ] {
        for degree in [3, 5, 9] {
            let polygon = wavy(60, degree, height, rational);
            let mut prover = SegmentProver::new(polygon.is_planar());
            // One segment after the other, so that this is the mean over all of them.
            let mut segment = 0;
            group.bench_function(BenchmarkId::new(name, degree), |bencher| {
                bencher.iter(|| {
                    segment = (segment + 1) % polygon.segments();
                    prover.segment(black_box(&polygon), segment)
                });
            });
        }
    }
    group.finish();
}

fn assembly(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("features of a curve");
    group
        .measurement_time(Duration::from_secs(3))
        .warm_up_time(Duration::from_millis(500));
    let polygon = wavy(VERTICES, 9, 0.0, false);
    let mut prover = SegmentProver::new(true);
    let mut segments: Vec<_> = (0..polygon.segments())
        .map(|segment| prover.segment(&polygon, segment))
        .collect();
    group.bench_function("assembled, one segment of 991 redone", |bencher| {
        bencher.iter(|| {
            segments[500] = prover.segment(&polygon, 500);
            Features::assemble(black_box(&polygon), &segments)
        });
    });
    group.bench_function("all 991 segments", |bencher| {
        bencher.iter(|| Features::new(black_box(&polygon)));
    });
    group.finish();
}

/// What a drag that keeps features and its guides take: 60 vertices, degree 9.
fn moves(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("moves of a vertex");
    group
        .measurement_time(Duration::from_secs(3))
        .warm_up_time(Duration::from_millis(500))
        .sample_size(10);
    let nobody = Progress::default();
    for (name, rational) in [("polynomial", false), ("rational", true)] {
        let polygon = wavy(60, 9, 0.0, rational);
        let proved = SegmentFeatures::of_curve(&polygon, |_| true).unwrap_or_default();
        let vertex = 30;
        let mut prover = MoveProver::new(&polygon, &proved, vec![vertex]).expect("a vertex");
        let place = polygon.vertices()[vertex] + DVec3::new(0.01, 0.02, 0.0);
        group.bench_function(BenchmarkId::new("one place", name), |bencher| {
            bencher.iter(|| prover.rise(black_box(&[place])));
        });
        let search = |levels: usize| {
            let proved = SegmentFeatures::of_curve(&polygon, |_| true).unwrap_or_default();
            let search = RegionSearch::new(black_box(&polygon), &proved, vertex);
            let mut search = search.expect("a planar curve");
            for _ in 0..levels {
                search.refine(&nobody);
            }
            search
        };
        group.bench_function(BenchmarkId::new("first outline", name), |bencher| {
            bencher.iter(|| search(1));
        });
        group.bench_function(BenchmarkId::new("finest outline", name), |bencher| {
            bencher.iter(|| search(4));
        });
        let features = Features::assemble(&polygon, &proved);
        let extremum = &features.curvature_extrema[features.curvature_extrema.len() / 2];
        let losses = LossSearch {
            polygon: &polygon,
            proved: &proved,
            quantity: Feature::CurvatureExtremum,
            u: 0.5 * (extremum.u[0] + extremum.u[1]),
        };
        group.bench_function(BenchmarkId::new("losing an extremum", name), |bencher| {
            bencher.iter(|| black_box(&losses).run(&nobody));
        });
    }
    group.finish();
}

criterion_group!(benches, segments, assembly, moves);
criterion_main!(benches);
