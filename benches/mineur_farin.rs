//! Measures an atlas of 200 × 200 proofs, and its coarse picture.

use std::time::Duration;

use batten::geometry::Progress;
use batten::geometry::mineur_farin::{Atlas, AtlasSearch, Configuration, Format};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::DVec3;

fn atlas(format: Format, legs: usize, torsion: f64) -> Atlas {
    let configuration = Configuration {
        start: DVec3::ZERO,
        first_leg: DVec3::X,
        ratio: 2.0,
        turn: 1.5,
        torsion,
    };
    Atlas::around(&configuration, format, legs)
}

fn atlases(criterion: &mut Criterion) {
    let nobody = Progress::default();
    let mut group = criterion.benchmark_group("atlas");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(5))
        .warm_up_time(Duration::from_millis(500));
    for (name, format, legs, torsion) in [
        ("float, degree 5", Format::Float { degree: 5 }, 8, 0.0),
        ("float, degree 9", Format::Float { degree: 9 }, 12, 0.0),
        ("Bézier, degree 9", Format::Bezier, 9, 0.0),
        ("Bézier in space, degree 9", Format::Bezier, 9, 0.3),
        (
            "float in space, degree 9",
            Format::Float { degree: 9 },
            12,
            0.3,
        ),
    ] {
        let atlas = atlas(format, legs, torsion);
        group.bench_function(BenchmarkId::new("coarse picture", name), |bencher| {
            bencher.iter(|| AtlasSearch::new(atlas).refine(&nobody));
        });
        group.bench_function(BenchmarkId::new("finest picture", name), |bencher| {
            bencher.iter(|| {
                let mut search = AtlasSearch::new(atlas);
                while !search.found().is_finest() {
                    search.refine(&nobody);
                }
                search
            });
        });
    }
    group.finish();
}

criterion_group!(benches, atlases);
criterion_main!(benches);
