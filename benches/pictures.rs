//! Pictures to trace: decoding one of 8 000 × 8 000 pixels, and cutting it into tiles of several sizes.
#![allow(missing_docs)]

use std::hint::black_box;
use std::io::Cursor;

use batten::editor::Pyramid;
use batten::io::decode;
use criterion::{Criterion, criterion_group, criterion_main};
use image::{GrayImage, ImageFormat, Luma};

const SIDE: u32 = 8_000;

/// A picture with soft shapes and noise, as a scan has them: neither flat nor without any order.
fn scan() -> GrayImage {
    GrayImage::from_fn(SIDE, SIDE, |x, y| {
        let [u, v] = [x, y].map(|at| f64::from(at) / f64::from(SIDE));
        let soft = 0.5 + 0.4 * (9.0 * u).sin() * (7.0 * v).cos();
        let noise = (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503)) % 8;
        Luma([(200.0 * soft) as u8 + noise as u8])
    })
}

fn reading(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a picture of 8 000 × 8 000 pixels in tiles");
    group.sample_size(10);
    let scan = scan();
    for (name, format) in [
        ("PNG", ImageFormat::Png),
        ("JPEG", ImageFormat::Jpeg),
        ("TIFF", ImageFormat::Tiff),
    ] {
        let mut bytes = Cursor::new(Vec::new());
        scan.write_to(&mut bytes, format).expect("a picture");
        let bytes = bytes.into_inner();
        group.bench_function(name, |bencher| {
            bencher.iter(|| Pyramid::of(decode(black_box(&bytes)).expect("a picture")));
        });
    }
    group.finish();
}

criterion_group!(benches, reading);
criterion_main!(benches);
