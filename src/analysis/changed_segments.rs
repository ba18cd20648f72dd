//! The segments of a curve that change with its vertices.

use std::ops::Range;

use super::vertex_chain::changed_range;
use crate::geometry::FloatPolygon;

/// List the segments that differ between two curves: `None` if the curves are of different kinds, so
/// that all do.
pub(super) fn changed_segments(
    old: &FloatPolygon,
    new: &FloatPolygon,
) -> Option<Vec<Range<usize>>> {
    let alike = old.degree() == new.degree()
        && old.is_periodic() == new.is_periodic()
        && old.is_rational() == new.is_rational()
        && old.vertices().len() == new.vertices().len()
        && old.is_planar() == new.is_planar();
    if !alike {
        return None;
    }
    let moved = changed_range(old.vertices(), new.vertices());
    let [before, after] = [old, new].map(|polygon| polygon.weights().unwrap_or_default());
    let weighted = changed_range(before, after);
    let ranges = moved.into_iter().chain(weighted);
    let changed = ranges.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
    Some(changed.map_or(Vec::new(), |changed| new.dependent_segments(&changed)))
}
