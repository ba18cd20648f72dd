//! Random planar curves, and what is proved of them.

use batten::geometry::FloatPolygon;
use batten::geometry::features::{Features, SegmentFeatures, Verdict};
use glam::{DVec2, DVec3};

use crate::common::Random;

/// A curve with one of its vertices.
pub struct Case {
    pub polygon: FloatPolygon,
    pub vertex: usize,
    pub monotone: bool,
}

/// Draw a curve of degree 3 to 9 by its number: in turn gently bent, spiralling (mostly monotone),
/// wavy and closed; every other one rational.
pub fn case(number: usize) -> Case {
    let mut random = Random(number as u64 ^ 0x5afe);
    let degree = 3 + number % 7;
    let rational = (number / 7).is_multiple_of(2);
    let count = degree + 2 + (random.bits() % 12) as usize;
    let polygon = match (number / 14) % 4 {
        0 => random.gentle(degree, count, false, rational),
        1 | 2 => spiral(&mut random, degree, count, rational),
        _ => wave(&mut random, degree, count, rational),
    };
    let vertex = (random.bits() % polygon.vertices().len() as u64) as usize;
    let monotone = Features::new(&polygon).monotone == Verdict::Proved;
    Case {
        polygon,
        vertex,
        monotone,
    }
}

/// Lay legs that turn more and more.
fn spiral(random: &mut Random, degree: usize, count: usize, rational: bool) -> FloatPolygon {
    let (first, growth) = (random.between(-0.2, 0.3), random.between(0.01, 0.04));
    let (noise, fall) = (random.between(0.0, 0.004), random.between(0.97, 1.0));
    let (mut at, mut angle, mut leg) = (DVec2::ZERO, random.between(0.0, 6.0), 1.0);
    let mut vertices = vec![DVec3::ZERO];
    for index in 1..count {
        angle += first + growth * index as f64 + noise * random.between(-1.0, 1.0);
        at += leg * DVec2::from_angle(angle);
        leg *= fall;
        vertices.push(at.extend(0.0));
    }
    let slant = random.between(-0.02, 0.02);
    let weights = (0..count).map(|index| (slant * index as f64).exp());
    let weights = rational.then(|| weights.collect());
    FloatPolygon::new(degree, vertices, weights, false).expect("a valid polygon")
}

/// Lay a closed wave.
fn wave(random: &mut Random, degree: usize, count: usize, rational: bool) -> FloatPolygon {
    let height = random.between(0.0, 0.3);
    let vertices = (0..count).map(|index| {
        let turn = std::f64::consts::TAU * index as f64 / count as f64;
        let radius = 5.0 + height * random.between(-1.0, 1.0) + (2.0 * turn).sin();
        (radius * DVec2::from_angle(turn)).extend(0.0)
    });
    let vertices = vertices.collect();
    let weights = (0..count).map(|_| random.between(0.8, 1.25));
    let weights: Vec<f64> = weights.collect();
    let weights = rational.then_some(weights);
    FloatPolygon::new(degree, vertices, weights, true).expect("a valid polygon")
}

/// Prove all segments of a planar curve.
pub fn proved(polygon: &FloatPolygon) -> Vec<SegmentFeatures> {
    SegmentFeatures::of_curve(polygon, |_| true).expect("nobody cancels")
}

/// Put one vertex elsewhere.
pub fn moved(polygon: &FloatPolygon, vertex: usize, place: DVec3) -> FloatPolygon {
    let mut moved = polygon.clone();
    moved
        .move_vertices([(vertex, place)])
        .expect("a place in the plane");
    moved
}
