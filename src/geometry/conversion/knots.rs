//! Clamping and unclamping an end: the steps between the float and the clamped polygon.
//!
//! Vertex i is the blossom of the curve at the n knots `knots[i] … knots[i + n − 1]`. One step
//! of clamping replaces the outermost knot by the end knot, which changes the vertices that have
//! it among their knots: each is interpolated between itself and its inner neighbour. Unclamping
//! undoes the same steps in reverse order, extrapolating.

use crate::geometry::blend::Blend;

/// The two ways between the float and the clamped polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::geometry) enum Direction {
    /// From the float to the clamped polygon: [`clamp`].
    Clamp,
    /// Back: [`unclamp`].
    Unclamp,
}

impl Direction {
    /// Convert vertices in place.
    pub(in crate::geometry) fn convert<T: Blend>(self, degree: usize, vertices: &mut [T]) {
        match self {
            Self::Clamp => clamp(degree, vertices),
            Self::Unclamp => unclamp(degree, vertices),
        }
    }
}

/// Take the vertices of a float polygon to those of the clamped one, in place.
pub(in crate::geometry) fn clamp<T: Blend>(degree: usize, vertices: &mut [T]) {
    let mut knots = float_knots(degree, vertices.len());
    clamp_start(degree, &mut knots, vertices);
    clamp_end(degree, &mut knots, vertices);
}

/// Undo [`clamp`].
pub(in crate::geometry) fn unclamp<T: Blend>(degree: usize, vertices: &mut [T]) {
    let knots = float_knots(degree, vertices.len());
    unclamp_end(degree, &knots, vertices);
    unclamp_start(degree, &knots, vertices);
}

/// List the N + n − 1 inner knots 1 − n, 2 − n, … of a float polygon.
fn float_knots(degree: usize, vertices: usize) -> Vec<f64> {
    (0..vertices + degree - 1)
        .map(|index| index as f64 - (degree as f64 - 1.0))
        .collect()
}

/// Clamp the curve's start at u = 0; only the first n − 1 vertices change.
fn clamp_start<T: Blend>(degree: usize, knots: &mut [f64], vertices: &mut [T]) {
    for outside in (1..degree).rev() {
        for index in 0..outside {
            let (left, right) = (knots[index], knots[index + degree]);
            let (here, inner) = (&vertices[index], &vertices[index + 1]);
            vertices[index] = T::blend(right, here, -left, inner, right - left);
        }
        knots.copy_within(1..outside, 0);
        knots[outside - 1] = 0.0;
    }
}

/// Clamp the curve's end at u = L; only the last n − 1 vertices change.
fn clamp_end<T: Blend>(degree: usize, knots: &mut [f64], vertices: &mut [T]) {
    let end = (vertices.len() - degree) as f64;
    let (last_knot, last_vertex) = (knots.len() - 1, vertices.len() - 1);
    for outside in (1..degree).rev() {
        for step in 0..outside {
            let index = last_vertex - step;
            let (left, right) = (knots[index - 1], knots[index + degree - 1]);
            let (inner, here) = (&vertices[index - 1], &vertices[index]);
            vertices[index] = T::blend(right - end, inner, end - left, here, right - left);
        }
        let first = last_knot + 1 - outside;
        knots.copy_within(first..last_knot, first + 1);
        knots[first] = end;
    }
}

/// Undo [`clamp_start`]; `knots` are the float knots.
fn unclamp_start<T: Blend>(degree: usize, knots: &[f64], vertices: &mut [T]) {
    for outside in 1..degree {
        // When this step was taken, 0 was (n − outside) fold and the knots left of it were
        // −outside … −1, so knot `index` was index − outside.
        for index in (0..outside).rev() {
            let left = index as f64 - outside as f64;
            let right = knots[index + degree];
            let (here, inner) = (&vertices[index], &vertices[index + 1]);
            vertices[index] = T::blend(right - left, here, left, inner, right);
        }
    }
}

/// Undo [`clamp_end`] on a polygon whose start is clamped; `knots` are the float knots.
fn unclamp_end<T: Blend>(degree: usize, knots: &[f64], vertices: &mut [T]) {
    let last = vertices.len() - 1;
    let end = (vertices.len() - degree) as f64;
    for outside in 1..degree {
        for step in (0..outside).rev() {
            let index = last - step;
            let left = knots[index - 1].max(0.0);
            let right = end + (outside - step) as f64;
            let (here, inner) = (&vertices[index], &vertices[index - 1]);
            vertices[index] = T::blend(right - left, here, end - right, inner, end - left);
        }
    }
}
