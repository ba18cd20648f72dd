//! Curves whose numbers differ much in size.

use batten::geometry::FloatPolygon;

use crate::common::Random;
use crate::form::{Form, size};

/// Vertices, axes, weights or the whole curve between 1e-30 and 1e30 (weights at low degrees and
/// the whole curve to 1e±90).
pub fn mixed(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    let count = form.vertices();
    let mut vertices: Vec<_> = (0..count).map(|_| random.vector(9.0, true)).collect();
    if random.bits().is_multiple_of(2) {
        vertices
            .iter_mut()
            .for_each(|vertex| *vertex = vertex.round());
    }
    let mut weights = form.weights(random, count);
    let reach = if form.degree <= 5 {
        [3.0, 10.0, 30.0][(random.bits() % 3) as usize]
    } else {
        [1.0, 3.0, 8.0][(random.bits() % 3) as usize]
    };
    match random.bits() % 5 {
        0 => {
            for vertex in &mut vertices {
                *vertex *= size(random, -reach, reach);
            }
        }
        1 => {
            let [x, y] = [(); 2].map(|()| size(random, -reach, reach));
            for vertex in &mut vertices {
                vertex.x *= x;
                vertex.y *= y;
            }
        }
        2 => {
            let scale = size(random, -90.0, 90.0);
            vertices.iter_mut().for_each(|vertex| *vertex *= scale);
        }
        3 => {
            let far = random.vector(1.0, true) * size(random, 0.0, reach.min(12.0));
            vertices.iter_mut().for_each(|vertex| *vertex += far);
        }
        _ => {
            let index = random.bits() as usize % count;
            vertices[index].x = size(random, -90.0, 0.0);
        }
    }
    if random.bits().is_multiple_of(2) {
        let reach = if form.degree <= 3 && !form.in_space {
            90.0
        } else {
            reach
        };
        weights = (0..count).map(|_| size(random, -reach, reach)).collect();
    }
    Some(form.curve(&vertices, &weights))
}
