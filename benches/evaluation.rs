//! Measures evaluation in batches beside two kernels written for one degree each, the nearest
//! point and the joint correction.
//!
//! The two kernels are what a programmer would write who knows the degree at compile time and
//! keeps the vertices coordinate by coordinate: a polynomial in powers of the parameter for each
//! segment, and a table of basis values that all segments share.

mod wavy;

use std::hint::black_box;
use std::time::Duration;

use batten::geometry::end_correction::EndTarget;
use batten::geometry::fairing::joint_correction::{Disturbance, correct_jointly};
use batten::geometry::{Batch, End, Progress, Sampler, basis};
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, measurement::WallTime};
use criterion::{criterion_group, criterion_main};
use glam::DVec3;
use wavy::wavy;

/// Vertices of the curves evaluated.
const VERTICES: usize = 200;

/// Parameters a segment.
const PARAMETERS: usize = 16;

/// Values of x and y at all parameters, for the point and three derivatives.
type Output = [[[f64; PARAMETERS]; 2]; 4];

fn parameters() -> [f64; PARAMETERS] {
    std::array::from_fn(|index| (index as f64 + 0.5) / PARAMETERS as f64)
}

/// Evaluates segments of one degree as polynomials in t − ½.
struct PowerKernel<const SIZE: usize> {
    columns: [[f64; SIZE]; SIZE],
    offsets: [f64; PARAMETERS],
}

impl<const SIZE: usize> PowerKernel<SIZE> {
    fn new() -> Self {
        // The power k has the k-th derivative of the basis at ½, divided by k!.
        let mut factorial = 1.0;
        let rows: [_; SIZE] = std::array::from_fn(|power| {
            factorial *= power.max(1) as f64;
            let row: Vec<f64> = basis::uniform_basis_derivative(SIZE - 1, power, 0.5);
            std::array::from_fn::<_, SIZE, _>(|j| row[j] / factorial)
        });
        Self {
            columns: std::array::from_fn(|j| rows.map(|row| row[j])),
            offsets: parameters().map(|t| t - 0.5),
        }
    }

    #[inline(always)]
    fn segment(&self, vertices: [&[f64]; 2], orders: usize, out: &mut Output) {
        for (axis, vertices) in vertices.into_iter().enumerate() {
            let mut coefficients = [0.0; SIZE];
            for (column, vertex) in self.columns.iter().zip(vertices) {
                for power in 0..SIZE {
                    coefficients[power] += column[power] * vertex;
                }
            }
            for (order, out) in out.iter_mut().enumerate().take(orders) {
                let mut sums = [0.0; PARAMETERS];
                for power in (0..SIZE.saturating_sub(order)).rev() {
                    for (sum, offset) in sums.iter_mut().zip(&self.offsets) {
                        *sum = *sum * offset + coefficients[power];
                    }
                }
                out[axis] = sums;
                for power in 1..SIZE {
                    coefficients[power - 1] = coefficients[power] * power as f64;
                }
            }
        }
    }
}

/// Evaluates segments of one degree by a table of basis values.
struct TableKernel<const SIZE: usize> {
    table: [[[f64; PARAMETERS]; SIZE]; 4],
}

impl<const SIZE: usize> TableKernel<SIZE> {
    fn new() -> Self {
        let mut table = [[[0.0; PARAMETERS]; SIZE]; 4];
        for (order, table) in table.iter_mut().enumerate() {
            for (lane, t) in parameters().into_iter().enumerate() {
                let values: Vec<f64> = basis::uniform_basis_derivative(SIZE - 1, order, t);
                for (row, value) in table.iter_mut().zip(values) {
                    row[lane] = value;
                }
            }
        }
        Self { table }
    }

    #[inline(always)]
    fn segment(&self, vertices: [&[f64]; 2], orders: usize, out: &mut Output) {
        for (table, out) in self.table.iter().zip(out).take(orders) {
            for (axis, vertices) in vertices.into_iter().enumerate() {
                let mut sums = [0.0; PARAMETERS];
                for (row, vertex) in table.iter().zip(vertices) {
                    for lane in 0..PARAMETERS {
                        sums[lane] += row[lane] * vertex;
                    }
                }
                out[axis] = sums;
            }
        }
    }
}

fn batch(criterion: &mut Criterion) {
    for order in [0, 3] {
        let name = if order == 0 { "points" } else { "jets" };
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(1));
        batch_of_degree::<4>(&mut group, order);
        batch_of_degree::<6>(&mut group, order);
        batch_of_degree::<10>(&mut group, order);
        group.finish();
    }
}

fn batch_of_degree<const SIZE: usize>(group: &mut BenchmarkGroup<WallTime>, order: usize) {
    let degree = SIZE - 1;
    let segments = VERTICES - degree;
    group.throughput(Throughput::Elements((segments * PARAMETERS) as u64));
    let sampler = Sampler::new(degree, &parameters());
    for (name, height, rational) in [
        ("batten", 0.0, false),
        ("batten in space", 1.0, false),
        ("batten rational", 0.0, true),
        ("batten rational in space", 1.0, true),
    ] {
        let polygon = wavy(VERTICES, degree, height, rational);
        let mut batch = Batch::default();
        group.bench_function(BenchmarkId::new(name, degree), |bencher| {
            bencher.iter(|| {
                let polygon = black_box(&polygon);
                for segment in 0..segments {
                    sampler.segment(polygon, segment, order, &mut batch);
                    black_box(&batch);
                }
            });
        });
    }

    let polygon = wavy(VERTICES, degree, 0.0, false);
    let x: Vec<f64> = polygon.vertices().iter().map(|vertex| vertex.x).collect();
    let y: Vec<f64> = polygon.vertices().iter().map(|vertex| vertex.y).collect();
    let mut out = [[[0.0; PARAMETERS]; 2]; 4];
    let power = PowerKernel::<SIZE>::new();
    group.bench_function(BenchmarkId::new("power kernel", degree), |bencher| {
        bencher.iter(|| {
            for (x, y) in black_box(&x).windows(SIZE).zip(black_box(&y).windows(SIZE)) {
                power.segment([x, y], order + 1, &mut out);
                black_box(&out);
            }
        });
    });
    let table = TableKernel::<SIZE>::new();
    group.bench_function(BenchmarkId::new("table kernel", degree), |bencher| {
        bencher.iter(|| {
            for (x, y) in black_box(&x).windows(SIZE).zip(black_box(&y).windows(SIZE)) {
                table.segment([x, y], order + 1, &mut out);
                black_box(&out);
            }
        });
    });
}

fn single(criterion: &mut Criterion) {
    let polygon = wavy(VERTICES, 9, 0.0, false);
    let mut group = criterion.benchmark_group("single");
    group.bench_function("jet", |bencher| {
        bencher.iter(|| black_box(&polygon).jet(black_box(93.7)));
    });
    group.bench_function("nearest, 1000 vertices", |bencher| {
        let polygon = wavy(1000, 9, 0.0, false);
        let target = DVec3::new(4.0, 5.0, 0.0);
        bencher.iter(|| black_box(&polygon).nearest(black_box(target)));
    });
    group.bench_function("arc length to 1e-10, 1000 vertices", |bencher| {
        let polygon = wavy(1000, 9, 0.0, false);
        bencher.iter(|| black_box(&polygon).arc_length(1e-10));
    });
    group.finish();
}

fn correction(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("joint correction, degree 9");
    for vertices in [100, 1000] {
        let polygon = wavy(vertices, 9, 0.0, false);
        let targets = End::BOTH.map(|end| {
            let jet = polygon.end_jet(end);
            let point = jet.point + DVec3::new(0.1, -0.05, 0.0);
            let direction = Some(jet.first + DVec3::new(0.0, 0.02, 0.0));
            (
                end,
                EndTarget {
                    point,
                    direction,
                    ..EndTarget::default()
                },
            )
        });
        group.bench_function(BenchmarkId::from_parameter(vertices), |bencher| {
            bencher.iter(|| {
                correct_jointly(
                    black_box(&polygon),
                    &targets,
                    Disturbance::Differences(1),
                    &[],
                    &Progress::default(),
                )
            });
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
    targets = batch, single, correction
}
criterion_main!(benches);
