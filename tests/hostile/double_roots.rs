//! Curves whose numerators have multiple roots where the tangent does not vanish.

use batten::geometry::FloatPolygon;
use glam::DVec3;

use crate::common::Random;
use crate::form::{Form, whole};
use crate::prescribed::{
    Powers, doubles, float_vertices, integral, number, small, times, with_roots,
};

/// A graph (t, y) with y″ = Π (2^level t − k)^m · A, or (t, t², z) with such a z‴ in space, sheared:
/// inflections, or zeros of the torsion, of multiplicity 2 to 4, and extrema of one less.
pub fn multiple_roots(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    (0..6).find_map(|_| graph(random, form))
}

fn graph(random: &mut Random, form: Form) -> Option<FloatPolygon> {
    let order = if form.in_space { 3 } else { 2 };
    let room = form.degree.checked_sub(order)?;
    let level = 1 + (random.bits() % 4) as u32;
    let mut roots: Vec<(i64, u32, usize)> = Vec::new();
    let mut left = room;
    while left >= 2 && roots.len() < 3 {
        let multiplicity = 2 + (random.bits() % 3) as usize;
        let k = (random.bits() % ((1 << level) + 1)) as i64;
        if multiplicity <= left && roots.iter().all(|root| root.0 != k) {
            roots.push((k, level, multiplicity));
        }
        left -= multiplicity.min(left);
    }
    let product = with_roots(&roots);
    let rest = (room + 1 - product.len()).min(2);
    let mut last: Powers = times(&product, &small(random, rest));
    for _ in 0..order {
        last = integral(&last);
    }
    let line = vec![number(0), number(1)];
    let square = vec![number(0), number(0), number(1)];
    let flat = vec![number(0)];
    let [y, z] = if form.in_space {
        [&square, &last]
    } else {
        [&last, &flat]
    };
    let [x, y, z] = [&line, y, z].map(|powers| float_vertices(form.degree, powers));
    let (x, y, z) = (x?, y?, z?);
    let shear = [whole(random, 2), whole(random, 2)];
    let x: Vec<_> = x.iter().zip(&y).map(|(x, y)| x + y * shear[0]).collect();
    let z: Vec<_> = z.iter().zip(&x).map(|(z, x)| z + x * shear[1]).collect();
    let mut vertices = doubles([&x, &y, &z])?;
    while vertices.len() < form.vertices() {
        let by = DVec3::new(
            whole(random, 4) as f64,
            whole(random, 4) as f64,
            whole(random, 4) as f64,
        );
        vertices.push(*vertices.last()? + by);
    }
    // Equal weights leave the roots where they are.
    let weights = vec![2.0; vertices.len()];
    Some(form.curve(&vertices, &weights))
}
