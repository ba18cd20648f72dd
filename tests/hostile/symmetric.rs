//! Curves that are symmetric to the last bit, so that features lie exactly on knots.

use batten::geometry::FloatPolygon;
use glam::DVec3;

use crate::common::Random;
use crate::form::{Form, whole, whole_vector};

/// Vertices mirrored in a line, a point or, in space, an axis, with a knot, or else the middle of a
/// segment, as the centre.
pub fn about_a_knot(random: &mut Random, mut form: Form) -> Option<FloatPolygon> {
    make_even(random, &mut form);
    let digits = random.bits().is_multiple_of(2);
    let mirror = mirror(random, form);
    let draw = |random: &mut Random| {
        if digits {
            random.vector(10.0, true)
        } else {
            whole_vector(random, 9)
        }
    };
    mirrored(random, form, mirror, |random, _| draw(random))
}

/// Symmetric curves that look like arcs, bells and waves, and stars turned on by right angles: an
/// extremum, or an inflection, sits on a knot.
pub fn extrema_on_knots(random: &mut Random, mut form: Form) -> Option<FloatPolygon> {
    if form.periodic && random.bits().is_multiple_of(2) {
        return Some(star(random, form));
    }
    make_even(random, &mut form);
    let [bend, flat, turn] = [1, 2, 3].map(|reach| whole(random, reach) as f64);
    let unit = [1.0, 0.1, 3.7][(random.bits() % 3) as usize];
    let point = random.bits().is_multiple_of(2);
    let mirror = if point {
        DVec3::NEG_ONE
    } else {
        DVec3::new(-1.0, 1.0, 1.0)
    };
    let centre = 0.5 * (form.vertices() - 1) as f64;
    mirrored(random, form, mirror, |_, index| {
        let x = index as f64 - centre;
        let y = if point {
            x * (bend + turn * x * x)
        } else {
            x * x * (bend + flat * x * x) + turn * x.abs()
        };
        DVec3::new(x, y, x * x * x) * unit
    })
}

/// A centre on a knot three times out of four.
fn make_even(random: &mut Random, form: &mut Form) {
    let odd = usize::from(random.bits().is_multiple_of(4));
    form.extra = (form.extra & !1) + 1 - odd;
}

fn mirror(random: &mut Random, form: Form) -> DVec3 {
    let mirrors = [
        DVec3::new(-1.0, 1.0, 1.0),
        DVec3::new(-1.0, -1.0, 1.0),
        DVec3::NEG_ONE,
        DVec3::new(1.0, -1.0, -1.0),
    ];
    let count = if form.in_space { 4 } else { 2 };
    mirrors[(random.bits() % count) as usize]
}

fn mirrored(
    random: &mut Random,
    form: Form,
    mirror: DVec3,
    vertex: impl Fn(&mut Random, usize) -> DVec3,
) -> Option<FloatPolygon> {
    let count = form.vertices();
    let mut vertices = vec![DVec3::ZERO; count];
    let mut weights = vec![1.0; count];
    for index in 0..count.div_ceil(2) {
        let other = count - 1 - index;
        let drawn = vertex(random, index);
        let weight = Form::weight(random);
        // The vertex in the middle is its own mirror image.
        vertices[index] = if index == other {
            0.5 * (drawn + mirror * drawn)
        } else {
            drawn
        };
        vertices[other] = mirror * vertices[index];
        [weights[index], weights[other]] = [weight; 2];
    }
    Some(form.curve(&vertices, &weights))
}

/// A periodic curve that turns into itself by right angles, with mirror lines too.
fn star(random: &mut Random, form: Form) -> FloatPolygon {
    let [far, near] = [whole(random, 4) + 6, whole(random, 3) + 4];
    let corner = DVec3::new(far as f64, 0.0, 1.0);
    let between = DVec3::new(near as f64, near as f64, whole(random, 1) as f64);
    let quarter = |vertex: DVec3| DVec3::new(-vertex.y, vertex.x, vertex.z);
    let with_between = random.bits().is_multiple_of(2) || form.degree > 3;
    let mut vertices = Vec::new();
    let mut turned = [corner, between];
    while vertices.len() < 8 || vertices.len() <= form.degree {
        vertices.extend(&turned[..if with_between { 2 } else { 1 }]);
        turned = turned.map(quarter);
    }
    let weight = Form::weight(random);
    let weights: Vec<_> = (0..vertices.len())
        .map(|index| {
            if index % 2 == 1 && with_between {
                weight
            } else {
                1.0
            }
        })
        .collect();
    form.curve(&vertices, &weights)
}
