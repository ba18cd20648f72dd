//! The density of a polygon on the screen: where it crowds, discs shrink and vanish, then legs fade.

use glam::{DVec2, DVec3};

use crate::analysis::VertexChain;
use crate::editor::view::orientation::Orientation;

/// From this spacing on, in screen points, discs have their full size.
const FULL_DISC: f64 = 14.0;

/// Up to this spacing there are no discs; from here on legs have their full strength.
const NO_DISC: f64 = 6.0;

/// Up to this spacing there are no legs.
const NO_LEG: f64 = 3.0;

/// The smallest share of its full size that the disc of a selected or locked vertex has.
const SMALLEST_KEPT: f32 = 0.4;

/// A vertex of the closed S-polygon this near to that of the float one, in screen points, is the same
/// on screen.
const SAME: f64 = 1.0;

/// The share of its full size that a disc has at a spacing in screen points.
pub fn disc(spacing: f64) -> f32 {
    ((spacing - NO_DISC) / (FULL_DISC - NO_DISC)).clamp(0.0, 1.0) as f32
}

/// The share of its full size that the disc of a selected or locked vertex has next to another such: it
/// shrinks, and never vanishes.
pub fn disc_among_kept(spacing: f64) -> f32 {
    disc(spacing).max(SMALLEST_KEPT)
}

/// The share of its full strength that a leg has at a spacing in screen points.
pub fn leg(spacing: f64) -> f32 {
    ((spacing - NO_LEG) / (NO_DISC - NO_LEG)).clamp(0.0, 1.0) as f32
}

/// The vertices of a polygon as they are seen, with their spacing.
#[derive(Clone, Copy)]
pub struct SeenChain<'a> {
    /// The polygon.
    pub chain: &'a VertexChain,
    /// From where it is seen.
    pub eye: Orientation,
}

impl SeenChain<'_> {
    /// Where a vertex is seen, if there is one of this number.
    pub fn place(&self, index: usize) -> Option<DVec2> {
        let vertex: DVec3 = self.chain.get(index)?;
        Some(self.eye.flatten(vertex))
    }

    /// The length of the leg that begins at a vertex; beyond the ends that of the last leg.
    fn length(&self, leg: isize) -> f64 {
        let count = self.chain.vertices().len();
        let from = match self.chain.is_closed() {
            true => leg.rem_euclid(count.max(1) as isize) as usize,
            false => leg.clamp(0, count.saturating_sub(2) as isize) as usize,
        };
        let ends = self.place(from).zip(self.place(from + 1));
        ends.map_or(0.0, |(from, to)| from.distance(to))
    }

    /// The spacing around a vertex, in units of the model: a mean over the four legs next to it, so that
    /// neighbours differ little.
    pub fn spacing(&self, vertex: usize) -> f64 {
        let leg = vertex as isize;
        let near = self.length(leg - 1) + self.length(leg);
        let far = self.length(leg - 2) + self.length(leg + 1);
        (2.0 * near + far) / 6.0
    }

    /// The spacing along the leg that begins at a vertex: a mean over it and the two next to it.
    pub fn leg_spacing(&self, leg: usize) -> f64 {
        let leg = leg as isize;
        0.25 * (self.length(leg - 1) + 2.0 * self.length(leg) + self.length(leg + 1))
    }

    /// Whether a vertex is seen where a vertex of another polygon is whose number differs by no more than
    /// `reach`; `pixel` is the size of a screen point.
    pub fn coincides(&self, other: &Self, vertex: usize, reach: usize, pixel: f64) -> bool {
        let Some(own) = self.place(vertex) else {
            return false;
        };
        let near = |index: usize| {
            let place = other.place(index);
            place.is_some_and(|place| place.distance(own) <= SAME * pixel)
        };
        near(vertex) || (vertex.saturating_sub(reach)..=vertex + reach).any(near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_shrink_from_14_points_to_6_and_legs_fade_from_6_to_3() {
        for (spacing, expected) in [
            (f64::INFINITY, (1.0, 1.0)),
            (14.0, (1.0, 1.0)),
            (10.0, (0.5, 1.0)),
            (6.0, (0.0, 1.0)),
            (4.5, (0.0, 0.5)),
            (3.0, (0.0, 0.0)),
            (0.0, (0.0, 0.0)),
        ] {
            assert_eq!((disc(spacing), leg(spacing)), expected, "{spacing}");
        }
    }
}
