//! Deviations between curves, from both sides, against dense evaluation by another search for nearest points.

use batten::geometry::distance::SideDeviation;
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{FloatPolygon, Progress};
use glam::DVec3;

use crate::common::Random;

/// Even samples of a side. Means by the trapezium rule are then right to 1e-7 of the size.
const SAMPLES: usize = 12_000;

/// Steps of the golden section about the highest samples.
const SECTIONS: usize = 60;

/// The error of the largest distance, by the size.
const LARGEST: f64 = 1e-9;

/// The error of the mean and of the root mean square, by the size.
const MEAN: f64 = 1e-6;

fn measured(curve: &FloatPolygon, other: &FloatPolygon) -> SideDeviation {
    SideDeviation::of_curve(curve, other, &Progress::default()).expect("curves have points")
}

fn line(from: f64, to: f64) -> FloatPolygon {
    // Degree 1: the vertices are the curve's ends.
    FloatPolygon::planar(1, &[(from, 0.0), (to, 0.0)]).expect("a polygon")
}

/// The largest distance, the mean and the root mean square of a side.
fn dense(curve: &FloatPolygon, other: &FloatPolygon) -> [f64; 3] {
    let distance = |u: f64| other.nearest(curve.point(u)).distance;
    let last = curve.segments() as f64;
    let at = |index: usize| last * index as f64 / SAMPLES as f64;
    let samples: Vec<f64> = (0..=SAMPLES).map(|index| distance(at(index))).collect();
    let (mut length, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for (index, sample) in samples.iter().enumerate() {
        let at_end = index == 0 || index == SAMPLES;
        let weight = curve.jet(at(index)).speed() * if at_end { 0.5 } else { 1.0 };
        length += weight;
        sum += weight * sample;
        squares += weight * sample * sample;
    }
    let mut order: Vec<usize> = (0..=SAMPLES).collect();
    order.sort_by(|a, b| samples[*b].total_cmp(&samples[*a]));
    let mut largest = 0.0_f64;
    for index in order.into_iter().take(20) {
        let [mut low, mut high] = [at(index.saturating_sub(1)), at((index + 1).min(SAMPLES))];
        for _ in 0..SECTIONS {
            let third = (high - low) / 3.0;
            match distance(low + third) < distance(high - third) {
                true => low += third,
                false => high -= third,
            }
        }
        largest = largest
            .max(samples[index])
            .max(distance(0.5 * (low + high)));
    }
    [largest, sum / length, (squares / length).sqrt()]
}

fn check_pairs(pairs: u64) {
    for seed in 0..pairs {
        let mut random = Random(seed * 7919 + 5);
        let mut curve = || {
            let degree = 2 + (random.bits() % 6) as usize;
            let count = degree + 1 + (random.bits() % 10) as usize;
            let in_space = random.bits().is_multiple_of(4);
            let mut place = DVec3::ZERO;
            let vertices = (0..count).map(|_| {
                place += DVec3::X + random.vector(1.0, in_space);
                place
            });
            FloatPolygon::new(degree, vertices.collect(), None, false).expect("a polygon")
        };
        let (first, second) = (curve(), curve());
        let size = first.size().max(second.size());
        for (curve, other) in [(&first, &second), (&second, &first)] {
            let found = measured(curve, other);
            let [largest, mean, rms] = dense(curve, other);
            let off = found.largest.distance() - largest;
            assert!(off.abs() <= LARGEST * size, "pair {seed}: {off:e}");
            for (found, expected) in [(found.mean, mean), (found.rms, rms)] {
                let off = found - expected;
                assert!(off.abs() <= MEAN * size, "pair {seed}: {off:e}");
            }
        }
    }
}

#[test]
fn forty_pairs_deviate_as_dense_samples_show() {
    check_pairs(40);
}

/// The longer run: `cargo test --test approximation a_thousand_pairs -- --ignored`.
#[test]
#[ignore = "ten minutes"]
fn a_thousand_pairs_deviate_as_dense_samples_show() {
    check_pairs(1000);
}

#[test]
fn the_whole_tells_what_its_part_lacks() {
    let (part, whole) = (line(0.0, 1.0), line(0.0, 4.0));
    let there = measured(&part, &whole);
    assert_eq!([there.largest.distance(), there.mean, there.rms], [0.0; 3]);
    let back = measured(&whole, &part);
    assert_eq!(back.largest.distance(), 3.0);
    // ∫₁⁴ (x − 1) dx / 4 and √(∫₁⁴ (x − 1)² dx / 4).
    assert!((back.mean - 1.125).abs() <= 1e-8, "{}", back.mean);
    assert!((back.rms - 1.5).abs() <= 1e-8, "{}", back.rms);
    assert!((back.extent - 4.0).abs() <= 1e-14, "{}", back.extent);
}

#[test]
fn equal_circles_deviate_by_closed_forms_and_tell_their_sides() {
    let circle = |radius: f64| {
        ReferenceCurve::from_text(&format!("circle:radius={radius}")).expect("a circle")
    };
    let (small, large) = (circle(2.0), circle(5.0));
    for (curve, other, side) in [(&small, &large, "inside"), (&large, &small, "outside")] {
        let found = SideDeviation::of_curve(curve, other, &Progress::default());
        let found = found.expect("circles have points");
        for value in [found.largest.distance(), found.mean, found.rms] {
            assert!((value - 3.0).abs() <= 1e-12, "{value}");
        }
        assert_eq!(found.largest.side.map(|it| it.name()), Some(side));
        assert_eq!(found.whiskers.len(), 101);
    }
}

#[test]
fn points_count_from_their_side_alone() {
    let points = [(0.5, 0.25), (1.0, -0.5), (5.0, 0.0)];
    let points = points.map(|(x, y)| DVec3::new(x, y, 0.0));
    let line = line(0.0, 4.0);
    let found = SideDeviation::of_points(&points, &line, &Progress::default());
    let found = found.expect("a line has points").expect("points");
    assert_eq!((found.largest.at, found.largest.distance()), (2.0, 1.0));
    assert!((found.mean - 1.75 / 3.0).abs() <= 1e-15);
    assert!((found.rms - (1.3125_f64 / 3.0).sqrt()).abs() <= 1e-15);
    let sides = found
        .whiskers
        .iter()
        .map(|it| it.side.map(|side| side.name()));
    let sides: Vec<_> = sides.collect();
    assert_eq!(sides, [Some("left"), Some("right"), None]);
    let none = SideDeviation::of_points(&[], &line, &Progress::default());
    assert_eq!(none, Ok(None));
}
