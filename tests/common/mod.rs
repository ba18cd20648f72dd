//! What the integration tests share: the reference values and random numbers that repeat.
#![allow(dead_code, unused_imports)] // Each test uses a part of it.

mod matched;
mod repeatable;
mod symmetric;

use batten::geometry::FloatPolygon;
use batten::geometry::features::{Feature, Features, SegmentFeatures};
use glam::DVec3;
pub use matched::matched;
use proptest::prelude::*;
pub use repeatable::repeatable;
use serde_json::Value;
pub use symmetric::check_symmetry;

/// Read one file of tests/data.
pub fn reference(name: &str) -> Value {
    let path = format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect("the reference file is there");
    serde_json::from_str(&text).expect("the reference file is JSON")
}

/// Read a number.
pub fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// Read a list of numbers.
pub fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

/// Read a list.
pub fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

/// Read a point of two or three coordinates.
pub fn point(value: &Value) -> DVec3 {
    let coordinates = numbers(value);
    let z = coordinates.get(2).copied().unwrap_or(0.0);
    DVec3::new(coordinates[0], coordinates[1], z)
}

/// Read a list of points.
pub fn points(value: &Value) -> Vec<DVec3> {
    list(value).iter().map(point).collect()
}

/// Find the largest coordinate of some points: what absolute errors are relative to.
pub fn reach(points: &[DVec3]) -> f64 {
    let largest = points.iter().map(|point| point.abs().max_element());
    largest.fold(0.0, f64::max)
}

/// Assert that a number lies within `tolerance` · `scale` of what it shall be.
#[track_caller]
pub fn assert_near(what: &str, found: f64, expected: f64, tolerance: f64, scale: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= tolerance * scale,
        "{what}: {found:e} instead of {expected:e}, off by {:.2e} of {scale:.2e}",
        error / scale
    );
}

/// Assert that two points are equal within `tolerance` · `scale`.
#[track_caller]
pub fn assert_points_near(what: &str, found: DVec3, expected: DVec3, tolerance: f64, scale: f64) {
    let error = found.distance(expected);
    assert!(
        error <= tolerance * scale,
        "{what}: {found} instead of {expected}, off by {:.2e} of {scale:.2e}",
        error / scale
    );
}

/// Numbers that look random and are the same in every run (a splitmix generator).
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// The next number between `low` and `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The next vector with coordinates up to ±`size`; z is 0 in the plane.
    pub fn vector(&mut self, size: f64, in_space: bool) -> DVec3 {
        let x = self.between(-size, size);
        let y = self.between(-size, size);
        let z = if in_space {
            self.between(-size, size)
        } else {
            0.0
        };
        DVec3::new(x, y, z)
    }

    /// An arc-like open polygon of unit legs that wander gently, as a designer would lay them.
    pub fn gentle(
        &mut self,
        degree: usize,
        vertices: usize,
        in_space: bool,
        rational: bool,
    ) -> FloatPolygon {
        let mut angle = self.between(0.0, 6.0);
        let mut vertex = DVec3::ZERO;
        let mut all = vec![vertex];
        while all.len() < vertices {
            let z = if in_space {
                self.between(-0.3, 0.3)
            } else {
                0.0
            };
            angle += self.between(0.0, 0.5);
            vertex += DVec3::new(angle.cos(), angle.sin(), z) * self.between(0.7, 1.3);
            all.push(vertex);
        }
        let weights = (0..vertices).map(|_| self.between(0.5, 2.0)).collect();
        let weights = Some(weights).filter(|_| rational);
        FloatPolygon::new(degree, all, weights, false).expect("a valid polygon")
    }
}

/// What a random polygon is like: `extra` vertices more than one segment has.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub degree: usize,
    pub extra: usize,
    pub periodic: bool,
    pub rational: bool,
    pub in_space: bool,
    pub seed: u64,
}

impl Kind {
    /// Draw the polygon.
    pub fn polygon(self) -> FloatPolygon {
        let mut random = Random(self.seed);
        let count = self.degree + 1 + self.extra;
        let vertices = (0..count).map(|_| random.vector(10.0, self.in_space));
        let vertices = vertices.collect();
        let weights = (0..count).map(|_| random.between(0.5, 2.0)).collect();
        let weights = Some(weights).filter(|_| self.rational);
        FloatPolygon::new(self.degree, vertices, weights, self.periodic).expect("valid")
    }
}

/// Polygons of these degrees, of every kind.
pub fn kinds(degrees: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = Kind> {
    (degrees, 0..12_usize, any::<[bool; 3]>(), any::<u64>()).prop_map(
        |(degree, extra, [periodic, rational, in_space], seed)| Kind {
            degree,
            extra,
            periodic,
            rational,
            in_space,
            seed,
        },
    )
}

/// Prove the features of the doubles given, however small.
pub fn exact(polygon: &FloatPolygon) -> Features {
    let segments = SegmentFeatures::of_curve(polygon, |_| true).expect("a proof");
    Features::exact(polygon, &segments)
}

/// The numbers of inflections, curvature extrema, torsion zeros, torsion extrema, and whatever
/// is in doubt.
pub fn counts(features: &Features) -> [usize; 5] {
    [
        features.count(Feature::Inflection),
        features.count(Feature::CurvatureExtremum),
        features.count(Feature::TorsionZero),
        features.count(Feature::TorsionExtremum),
        features.undecided.len() + features.cusps.len(),
    ]
}
