//! Curves with exact cusps at dyadic places, and with near ones.

use batten::geometry::FloatPolygon;
use glam::DVec3;

use crate::common::Random;
use crate::form::{Form, size, whole_vector};
use crate::prescribed::{Powers, doubles, float_vertices, integral, small, times, with_roots};

/// The most cusps of one segment.
const MOST: usize = 7;

/// One cusp of a simple or higher order.
pub fn one(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    with_cusps(random, form, 1)
}

/// As many cusps in one segment as the degree and the digits allow, up to seven.
pub fn several(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    let count = 2 + random.bits() as usize % (MOST - 1);
    with_cusps(random, form, count)
}

/// A cusp, one of whose vertices is moved by some units in the last place, or some more.
pub fn near(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    let count = 1 + random.bits() as usize % 3;
    let curve = with_cusps(random, form, count)?;
    let mut vertices = curve.vertices().to_vec();
    let index = random.bits() as usize % vertices.len();
    let axis = random.bits() as usize % if form.in_space { 3 } else { 2 };
    let value = &mut vertices[index][axis];
    match random.bits() % 3 {
        0 => *value = value.next_up(),
        1 => {
            let units = (random.bits() % 64) as f64 * f64::EPSILON;
            *value += value.abs().max(1.0) * units;
        }
        _ => *value += value.abs().max(1.0) * size(random, -16.0, -4.0),
    }
    let weights = curve.weights().map(<[f64]>::to_vec);
    FloatPolygon::new(form.degree, vertices, weights, form.periodic).ok()
}

fn with_cusps(random: &mut Random, form: Form, count: usize) -> Option<FloatPolygon> {
    // Where the digits are too many fewer cusps are asked for.
    (1..=count).rev().find_map(|count| {
        (0..4).find_map(|_| {
            if form.rational {
                rational(random, form, count)
            } else {
                polynomial(random, form, count)
            }
        })
    })
}

/// C′ = Π (2^level t − k)^m · (A, B, D).
fn polynomial(random: &mut Random, form: Form, count: usize) -> Option<FloatPolygon> {
    let product = cusps(random, count, 1, form.degree.checked_sub(2)?)?;
    let rest = (form.degree - product.len()).min(3);
    let mut coordinate = || {
        let rest = small(random, rest);
        float_vertices(form.degree, &integral(&times(&product, &rest)))
    };
    let [x, y, z] = [coordinate()?, coordinate()?, coordinate()?];
    let segment = doubles([&x, &y, &z])?;
    let (vertices, _) = surrounded(random, form, segment);
    let weights = vec![1.0; vertices.len()];
    Some(form.curve(&vertices, &weights))
}

/// C = C₀ + Π (2^level t − k)² · (A, B, D) / W, the weights being powers of two: vertex i is
/// C₀ + (float vertex i of the product) / wᵢ.
fn rational(random: &mut Random, form: Form, count: usize) -> Option<FloatPolygon> {
    let product = cusps(random, count, 2, form.degree)?;
    let rest = (form.degree + 1 - product.len()).min(3);
    let mut coordinate = || {
        let rest = small(random, rest);
        float_vertices(form.degree, &times(&product, &rest))
    };
    let [x, y, z] = [coordinate()?, coordinate()?, coordinate()?];
    let segment = doubles([&x, &y, &z])?;
    let weight = |random: &mut Random| 2f64.powi((random.bits() % 4) as i32 - 1);
    let segment_weights: Vec<f64> = segment.iter().map(|_| weight(random)).collect();
    let pairs = segment.iter().zip(&segment_weights);
    let segment = pairs.map(|(vertex, weight)| *vertex / *weight).collect();
    let (vertices, first) = surrounded(random, form, segment);
    let mut weights: Vec<f64> = vertices.iter().map(|_| weight(random)).collect();
    weights[first..first + segment_weights.len()].copy_from_slice(&segment_weights);
    Some(form.curve(&vertices, &weights))
}

/// Draw distinct places with orders that `least` begins; `None` if they make more than `room`.
fn cusps(random: &mut Random, count: usize, least: usize, room: usize) -> Option<Powers> {
    let level = if count > 3 {
        4
    } else {
        1 + (random.bits() % 4) as u32
    };
    let places = 1_i64 << level;
    let mut roots: Vec<(i64, u32, usize)> = Vec::new();
    let row = random.bits().is_multiple_of(2);
    for index in 0..count as i64 {
        // In a row about the middle, or anywhere, the ends included.
        let k = if row {
            (places - count as i64) / 2 + index + 1
        } else {
            (random.bits() % (places as u64 + 1)) as i64
        };
        let higher = usize::from(random.bits().is_multiple_of(5));
        if (0..=places).contains(&k) && roots.iter().all(|root| root.0 != k) {
            roots.push((k, level, least + higher));
        }
    }
    let sum: usize = roots.iter().map(|root| root.2).sum();
    (!roots.is_empty() && sum <= room).then(|| with_roots(&roots))
}

/// Put the other vertices of the curve before and behind those of a segment; returns the index of
/// the segment's first vertex.
fn surrounded(random: &mut Random, form: Form, segment: Vec<DVec3>) -> (Vec<DVec3>, usize) {
    let reach = segment
        .iter()
        .map(|vertex| vertex.abs().max_element())
        .fold(1.0, f64::max);
    let before = random.bits() as usize % (form.extra + 1);
    let mut other = || (whole_vector(random, 9) * (reach / 16.0)).round();
    let mut vertices: Vec<DVec3> = (0..before).map(|_| other()).collect();
    vertices.extend(segment);
    while vertices.len() < form.vertices() {
        vertices.push(other());
    }
    (vertices, before)
}
