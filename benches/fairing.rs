//! How long harmonising takes, and a frame of live harmony.

use std::hint::black_box;

use batten::geometry::fairing::harmonising::{Harmony, Held, harmonise};
use batten::geometry::fairing::least_change::{Dragged, Reach, least_change};
use batten::geometry::{FloatPolygon, Progress};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::DVec3;

/// An arc of unit legs and growing curvature, with some noise: a share of a leg.
fn arc(count: usize, noise: f64) -> FloatPolygon {
    let mut angle: f64 = 0.0;
    let mut point = DVec3::ZERO;
    let vertices = (0..count).map(|index| {
        let share = index as f64 / count as f64;
        angle += (1.0 + 2.0 * share) / count as f64;
        point += DVec3::new(angle.cos(), angle.sin(), 0.0);
        // Irrational multiples scatter evenly.
        let scattered = |factor: f64| 2.0 * (factor * index as f64).fract() - 1.0;
        point + noise * DVec3::new(scattered(0.618_034), scattered(0.754_878), 0.0)
    });
    FloatPolygon::new(9, vertices.collect(), None, false).expect("valid")
}

fn live(criterion: &mut Criterion) {
    let mut group =
        criterion.benchmark_group("drags by least change, degree 9; all vertices follow a vertex");
    for count in [60, 250, 1000, 2000] {
        let polygon = arc(count, 0.0);
        let (vertex, by) = (count / 2, DVec3::new(0.3, 0.2, 0.0));
        let drags = [
            (
                "vertex",
                Dragged::Vertices(vec![(vertex, polygon.vertex(vertex) + by)]),
                count,
            ),
            (
                "point",
                Dragged::Point(0.5 * polygon.segments() as f64, by),
                1,
            ),
            ("closed vertex", Dragged::Clamped(0, by), 1),
        ];
        for (name, dragged, span) in drags {
            let reach = Reach {
                span,
                stiffness: 1e-4,
                locked: &[],
            };
            group.bench_function(BenchmarkId::new(name, count), |bencher| {
                bencher.iter(|| least_change(black_box(&polygon), &dragged, &reach));
            });
        }
    }
    group.finish();
}

fn harmonising(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("harmonise, degree 9, noise 5 % of a leg");
    group.sample_size(10);
    for count in [60, 250, 2000] {
        let polygon = arc(count, 0.05);
        let harmony = Harmony {
            stretch: None,
            ends: [Held::Direction; 2],
            locked: &[],
            extrema: Some(0),
            inflections: Some(0),
            torsion_extrema: None,
            largest_deviation: None,
            symmetry: None,
        };
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            bencher.iter(|| harmonise(black_box(&polygon), &harmony, &Progress::default()));
        });
    }
    group.finish();
}

criterion_group!(benches, live, harmonising);
criterion_main!(benches);
