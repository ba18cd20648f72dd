//! Curves with repeated vertices and vertices in line.

use batten::geometry::FloatPolygon;
use glam::DVec3;

use crate::common::Random;
use crate::form::{Form, whole, whole_vector};

/// Few places, each for up to n + 1 vertices in turn.
pub fn repeated(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    let mut vertices: Vec<DVec3> = Vec::new();
    let digits = random.bits().is_multiple_of(4);
    while vertices.len() < form.vertices() {
        let place = if digits {
            random.vector(3.0, true)
        } else {
            whole_vector(random, 2)
        };
        let most = if random.bits().is_multiple_of(3) {
            form.degree as u64 + 1
        } else {
            3
        };
        let times = 1 + random.bits() % most;
        vertices.extend((0..times).map(|_| place));
    }
    vertices.truncate(form.vertices());
    let weights = form.weights(random, vertices.len());
    Some(form.curve(&vertices, &weights))
}

/// Straight pieces of some vertices each, in whole steps that may turn back or stand still, or of
/// numbers whose products with the direction are rounded.
pub fn collinear(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    let mut vertices = vec![whole_vector(random, 3)];
    let unit = [1.0, 0.1, 1.0 / 3.0][(random.bits() % 3) as usize];
    while vertices.len() < form.vertices() {
        let direction = whole_vector(random, 3) * unit;
        let onwards = random.bits().is_multiple_of(2);
        for _ in 0..1 + random.bits() % (form.degree as u64 + 2) {
            let step = if onwards { 1 } else { whole(random, 2) };
            let last = *vertices.last().expect("a vertex");
            vertices.push(last + direction * step as f64);
        }
    }
    vertices.truncate(form.vertices());
    let weights = form.weights(random, vertices.len());
    Some(form.curve(&vertices, &weights))
}
