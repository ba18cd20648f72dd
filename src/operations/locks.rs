//! What operations that make other vertices of a curve's do with locks.

use crate::document::{Curve, LockedVertices};
use crate::geometry::{FloatPolygon, counted};

/// The locked vertices of a part or another form of a curve: those that it has too.
pub(super) fn locks_of(curve: &Curve, part: &FloatPolygon) -> LockedVertices {
    curve.locked_vertices.carried(&curve.polygon, part)
}

/// Say how many locks are lost because none of the parts has their vertices, if any are.
pub(super) fn lost(curve: &Curve, parts: &[&FloatPolygon]) -> Option<String> {
    let held = |part: &&FloatPolygon| locks_of(curve, part).carried(part, &curve.polygon);
    let held: Vec<LockedVertices> = parts.iter().map(held).collect();
    let is_lost = |vertex: &usize| !held.iter().any(|held| held.contains(*vertex));
    match curve.locked_vertices.iter().filter(is_lost).count() {
        0 => None,
        1 => Some("1 lock is removed: its vertex is no longer there".to_owned()),
        count => Some(format!(
            "{} are removed: their vertices are no longer there",
            counted(count, "lock", "locks")
        )),
    }
}

/// Remark on locks where segments are halved.
pub(super) const LOCKS_HALVED: &str =
    "Locks go to the vertices that stand in the same places along the curve";

/// The vertex that takes the place of one after segments were halved so often: the one with the Greville abscissa
/// that is nearest to its own, now that u counts more segments. Vertex i stands at i − (n − 1)/2.
pub(super) fn halved(polygon: &FloatPolygon, halvings: usize, vertex: usize) -> usize {
    let (degree, is_periodic) = (polygon.degree(), polygon.is_periodic());
    let offset = (degree - 1) / 2;
    (1..=halvings).fold(vertex, |vertex, halving| {
        let segments = polygon.segments() << halving;
        match is_periodic {
            true => (2 * vertex + segments - offset) % segments,
            false => (2 * vertex)
                .saturating_sub(offset)
                .min(segments + degree - 1),
        }
    })
}
