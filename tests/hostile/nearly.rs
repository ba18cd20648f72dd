//! Curves that are nearly straight or nearly circular, or exactly.

use std::f64::consts::TAU;

use batten::geometry::FloatPolygon;
use glam::{DMat3, DVec3};

use crate::common::Random;
use crate::form::{Form, size, whole, whole_vector};

/// Vertices on a line, but for offsets from 1e-3 to 1e-15 of a leg; all of them, one, or none.
pub fn straight(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    let direction = if random.bits().is_multiple_of(2) {
        whole_vector(random, 9) + DVec3::X * 10.0
    } else {
        random.vector(1.0, true)
    };
    let uneven = random.bits().is_multiple_of(3);
    let mut along = whole(random, 5) as f64;
    let mut vertices = Vec::new();
    for _ in 0..form.vertices() {
        vertices.push(direction * along);
        along += if uneven {
            random.between(0.2, 2.0)
        } else {
            1.0
        };
    }
    offset(random, &mut vertices, direction.length(), [-15.0, -3.0]);
    let weights = near_one(random, vertices.len());
    Some(form.curve(&vertices, &weights))
}

/// Vertices of a regular polygon, of one squeezed, or of a helix, but for offsets from 1e-3 to
/// 1e-16 of the radius; all of them, one, or none.
pub fn circular(random: &mut Random, mut form: Form) -> Option<FloatPolygon> {
    let corners = 3 + (random.bits() % 14) as usize;
    if form.periodic && corners > form.degree && corners <= 9 {
        form.extra = corners - form.degree - 1;
    }
    let radius = [1.0, 10.0, 7.3, 1e-3, 1e5][(random.bits() % 5) as usize];
    let squeeze = if random.bits().is_multiple_of(4) {
        random.between(0.9, 1.0)
    } else {
        1.0
    };
    let rise = if random.bits().is_multiple_of(2) {
        0.0
    } else {
        size(random, -8.0, 0.0)
    };
    let vertex = |index: usize| {
        let angle = TAU * index as f64 / corners as f64;
        DVec3::new(angle.cos(), squeeze * angle.sin(), rise * index as f64) * radius
    };
    let mut vertices: Vec<_> = (0..form.vertices()).map(vertex).collect();
    if form.in_space && random.bits().is_multiple_of(2) {
        let turn = DMat3::from_rotation_x(0.3) * DMat3::from_rotation_y(1.1);
        vertices
            .iter_mut()
            .for_each(|vertex| *vertex = turn * *vertex);
    }
    offset(random, &mut vertices, radius, [-16.0, -3.0]);
    let weights = near_one(random, vertices.len());
    Some(form.curve(&vertices, &weights))
}

fn offset(random: &mut Random, vertices: &mut [DVec3], unit: f64, [low, high]: [f64; 2]) {
    let tiny = unit * size(random, low, high);
    match random.bits() % 4 {
        0 => {}
        1 => {
            let index = random.bits() as usize % vertices.len();
            vertices[index] += random.vector(tiny, true);
        }
        _ => {
            for vertex in vertices {
                *vertex += random.vector(tiny, true);
            }
        }
    }
}

fn near_one(random: &mut Random, count: usize) -> Vec<f64> {
    let off = size(random, -15.0, -1.0);
    let alternating = random.bits().is_multiple_of(3);
    let weight = |index: usize, random: &mut Random| match (alternating, index % 2) {
        (true, 1) => 0.5,
        (true, _) => 1.0,
        (false, _) => 1.0 + random.between(-off, off),
    };
    (0..count).map(|index| weight(index, random)).collect()
}
