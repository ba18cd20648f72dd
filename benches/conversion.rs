//! Measures the conversions between the polygons, beside clamping in plain doubles.

use std::hint::black_box;
use std::time::Duration;

use batten::geometry::{
    Amplification, BezierPolygon, ClampedPolygon, FloatPolygon, segment_bezier,
};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::{DVec3, DVec4};

/// Vertices of the curves converted.
const VERTICES: usize = 1000;

fn wavy(degree: usize, vertices: usize, rational: bool) -> FloatPolygon {
    let points = (0..vertices).map(|index| {
        let turn = 0.1 * index as f64;
        DVec3::new(10.0 * turn, 3.0 * turn.sin(), 0.0)
    });
    let weights = (0..vertices).map(|index| 1.0 + 0.01 * (0.1 * index as f64).sin());
    let weights = rational.then(|| weights.collect());
    FloatPolygon::new(degree, points.collect(), weights, false).expect("a valid polygon")
}

/// Clamp both ends of homogeneous vertices in doubles, knot by knot, as a program would that
/// does not mind a few lost digits, and divide by the weights.
fn clamped_in_doubles(float: &FloatPolygon) -> (Vec<DVec3>, Option<Vec<f64>>) {
    let (degree, count) = (float.degree(), float.vertices().len());
    let mut vertices: Vec<DVec4> = (0..count).map(|index| float.homogeneous(index)).collect();
    for _ in 0..2 {
        for outside in (1..degree).rev() {
            for index in 0..outside {
                let left = (index as f64) - outside as f64;
                let right = (index + 1) as f64;
                let inner = vertices[index + 1];
                vertices[index] = (right * vertices[index] - left * inner) / (right - left);
            }
        }
        vertices.reverse();
    }
    let weights = float
        .is_rational()
        .then(|| vertices.iter().map(|v| v.w).collect());
    let points = vertices.iter().map(|v| {
        if float.is_rational() {
            v.truncate() / v.w
        } else {
            v.truncate()
        }
    });
    (points.collect(), weights)
}

fn conversions(criterion: &mut Criterion) {
    for (name, degree, vertices, rational) in [
        ("degree 3", 3, VERTICES, false),
        ("degree 9", 9, VERTICES, false),
        ("degree 9, rational", 9, VERTICES, true),
        ("degree 25", 25, VERTICES, false),
        ("degree 9, 30 vertices", 9, 30, false),
    ] {
        let float = wavy(degree, vertices, rational);
        let clamped = ClampedPolygon::from_float(&float);
        let bezier = BezierPolygon::from_float(&float);
        let mut group = criterion.benchmark_group(name);
        group.bench_function("float to clamped in plain doubles", |bencher| {
            bencher.iter(|| clamped_in_doubles(black_box(&float)));
        });
        group.bench_function("float to clamped", |bencher| {
            bencher.iter(|| ClampedPolygon::from_float(black_box(&float)));
        });
        group.bench_function("clamped to float", |bencher| {
            bencher.iter(|| black_box(&clamped).to_float());
        });
        group.bench_function("float to bezier", |bencher| {
            bencher.iter(|| BezierPolygon::from_float(black_box(&float)));
        });
        group.bench_function("bezier to float", |bencher| {
            bencher.iter(|| black_box(&bezier).to_float());
        });
        group.bench_function("one segment to bezier", |bencher| {
            bencher.iter(|| segment_bezier(black_box(&float), black_box(5)));
        });
        group.finish();
    }
}

fn amplification(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("amplification");
    for degree in [3, 9, 25] {
        group.bench_function(BenchmarkId::from_parameter(degree), |bencher| {
            bencher.iter(|| Amplification::of_unclamping(black_box(degree), black_box(100)));
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
    targets = conversions, amplification
}
criterion_main!(benches);
