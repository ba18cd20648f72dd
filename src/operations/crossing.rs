//! Crossings that an operation brings into a curve.

use crate::geometry::{self, FloatPolygon, significant};

/// Say where a planar curve crosses itself, if none of those that it was made of did.
pub(super) fn new_crossing(before: &[&FloatPolygon], after: &FloatPolygon) -> Option<String> {
    let at = geometry::new_crossing(before, after)?;
    let [x, y] = at.to_array().map(|coordinate| significant(coordinate, 6));
    Some(format!("The curve crosses itself now, at {x}, {y}"))
}
