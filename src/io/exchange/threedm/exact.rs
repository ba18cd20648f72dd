//! Factors and multiples that give a number back exactly, where the format stores them in its place.

use glam::DVec3;

/// Steps between neighbouring numbers that are tried for a radius: 1e-14 of it at most.
const RADII: i32 = 40;

/// The number that divided by `weight` is `value`, or the one that comes closest.
pub(super) fn multiple(value: f64, weight: f64) -> f64 {
    let near = value * weight;
    neighbours(near)
        .find(|it| it / weight == value)
        .unwrap_or(near)
}

/// The number that multiplied by `factor` is `value`, or the one that comes closest.
pub(super) fn quotient(value: f64, factor: f64) -> f64 {
    let near = value / factor;
    neighbours(near)
        .find(|it| it * factor == value)
        .unwrap_or(near)
}

/// A radius and two axes that multiplied by it are `x` and `y`, or come closest.
pub(super) fn axes(x: DVec3, y: DVec3) -> (f64, DVec3, DVec3) {
    let near = x.length();
    let split = |radius: f64| {
        let axis = |half: DVec3| DVec3::from_array(half.to_array().map(|it| quotient(it, radius)));
        (radius, axis(x), axis(y))
    };
    let radii = (0..RADII).flat_map(|steps| [stepped(near, steps), stepped(near, -steps)]);
    radii
        .map(split)
        .find(|(radius, a, b)| *a * *radius == x && *b * *radius == y)
        .unwrap_or_else(|| split(near))
}

fn neighbours(near: f64) -> impl Iterator<Item = f64> {
    [0, 1, -1, 2, -2]
        .into_iter()
        .map(move |steps| stepped(near, steps))
}

fn stepped(mut number: f64, steps: i32) -> f64 {
    for _ in 0..steps.unsigned_abs() {
        number = if steps > 0 {
            number.next_up()
        } else {
            number.next_down()
        };
    }
    number
}
