//! The ray along which one vertex moves: the places to try, and the largest distance.

use glam::{DVec2, DVec3};

use super::move_prover::{MoveError, MoveProver};
use crate::geometry::features::{Features, RayForecast, SegmentFeatures};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::vector;

/// Precision of a border on a ray, as a share of its distance.
pub const PRECISION: f64 = 0.01;

/// A border nearer than this share of the limit is taken to be at the vertex.
const NEAREST: f64 = 1e-9;

/// Distance of the tried places from a foreseen change, as a share of its own.
const ASIDE: f64 = 0.4 * PRECISION;

/// The most changes that are tried on one ray, the nearest first.
const MOST_CHANGES: usize = 24;

/// The radius within which moves of a vertex are looked for: twice the longest leg that meets it,
/// or where these have no length the size of the polygon; 0 if all of it is one point.
pub fn reach(polygon: &FloatPolygon, vertex: usize) -> f64 {
    let vertices = polygon.vertices();
    let count = vertices.len();
    let Some(own) = vertices.get(vertex) else {
        return 0.0;
    };
    let joins_ends = polygon.is_periodic();
    let before = (vertex > 0 || joins_ends).then(|| (vertex + count - 1) % count);
    let behind = (vertex + 1 < count || joins_ends).then(|| (vertex + 1) % count);
    let legs = [before, behind].into_iter().flatten();
    let longest = legs
        .map(|other| vector::length(vertices[other] - own))
        .fold(0.0, f64::max);
    if longest > 0.0 {
        2.0 * longest
    } else {
        polygon.size()
    }
}

/// Proofs of a vertex's moves along rays from its place.
#[derive(Debug)]
pub(super) struct RayProver {
    pub(super) prover: MoveProver,
    forecast: RayForecast,
    pub(super) centre: DVec3,
    pub(super) limit: f64,
}

impl RayProver {
    /// Prepare for the moves of one vertex of a curve.
    ///
    /// # Errors
    /// As [`MoveProver::new`].
    pub(super) fn new(
        polygon: &FloatPolygon,
        proved: &[SegmentFeatures],
        vertex: usize,
    ) -> Result<Self, MoveError> {
        let prover = MoveProver::new(polygon, proved, vec![vertex])?;
        Ok(Self {
            prover,
            forecast: RayForecast::new(polygon, vertex)?,
            centre: polygon.vertex(vertex),
            limit: reach(polygon, vertex),
        })
    }

    /// The place of the vertex at a distance along a ray.
    pub(super) fn place(&self, direction: DVec2, distance: f64) -> DVec3 {
        self.centre + (distance * direction).extend(0.0)
    }

    /// Prove the features with the vertex at a distance along a ray; `None` if it cannot be there.
    pub(super) fn features(&mut self, direction: DVec2, distance: f64) -> Option<Features> {
        let place = self.place(direction, distance);
        self.prover.features(&[place]).ok()
    }

    /// List the distances at which to try a ray, in rising order: evenly up to the first change that
    /// is foreseen, evenly up to `within`, and beside and between the changes.
    pub(super) fn tries(&self, direction: DVec2, within: f64, even: usize) -> Vec<f64> {
        let changes = self.forecast.changes(direction, within);
        let nearest = changes.first().copied().unwrap_or(within);
        let mut tries = Vec::new();
        for end in [nearest, within] {
            let step = end / even as f64;
            tries.extend((1..=even).map(|count| step * count as f64));
        }
        for pair in changes.windows(2).take(MOST_CHANGES) {
            tries.push(0.5 * (pair[0] + pair[1]));
        }
        for change in changes.iter().take(MOST_CHANGES) {
            tries.extend([(1.0 - ASIDE) * change, (1.0 + ASIDE) * change]);
        }
        tries.retain(|distance| *distance > 0.0 && *distance <= within);
        tries.sort_by(f64::total_cmp);
        tries.dedup();
        tries
    }

    /// Choose where to try between a place where something holds and one where it does not; `None`
    /// once they are near enough to each other.
    pub(super) fn between(&self, holds: f64, fails: f64) -> Option<f64> {
        if fails - holds <= PRECISION * fails || fails <= NEAREST * self.limit {
            None
        } else if holds == 0.0 {
            Some(0.125 * fails)
        } else if fails > 2.0 * holds {
            Some((holds * fails).sqrt())
        } else {
            Some(0.5 * (holds + fails))
        }
    }
}
