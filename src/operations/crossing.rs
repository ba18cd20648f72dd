//! Crossings that an operation brings into a curve.

use crate::geometry::{FloatPolygon, curve_crossing, significant};

/// Say where a planar curve crosses itself, if none of those that it was made of did.
pub(super) fn new_crossing(before: &[&FloatPolygon], after: &FloatPolygon) -> Option<String> {
    let crosses = |polygon: &FloatPolygon| match polygon.is_planar() {
        true => curve_crossing(polygon),
        false => None,
    };
    let at = crosses(after)?;
    let is_new = before.iter().all(|polygon| crosses(polygon).is_none());
    is_new.then(|| {
        let [x, y] = at.to_array().map(|coordinate| significant(coordinate, 6));
        format!("The curve crosses itself now, at {x}, {y}")
    })
}
