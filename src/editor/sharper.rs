//! Bends that a change makes much sharper, though nobody asked for them.

use crate::document::{Document, quoted};
use crate::geometry::{FloatPolygon, largest_curvature, significant};

/// A bend that is so many times as sharp as all bends before is told.
const SHARPER: f64 = 8.0;

/// The radius of the sharpest bend of a curve, as text, if it is much sharper than all those before.
pub(super) fn sharper_radius(before: &FloatPolygon, after: &FloatPolygon) -> Option<String> {
    let largest =
        |polygon: &FloatPolygon| largest_curvature(polygon, [0.0, polygon.segments() as f64]);
    let [was, now] = [before, after].map(largest);
    // A curve that is scaled as a whole bends as before.
    let [size, least] = [before.size(), before.size().min(after.size())];
    (least * now > SHARPER * (size * was).max(1.0)).then(|| significant(now.recip(), 3))
}

/// Say which curve a drag bends much more sharply than it was.
pub(super) fn sharp_drag([before, after]: [&Document; 2]) -> Option<String> {
    after.curves().find_map(|(id, curve)| {
        let before = &before.curve(id)?.polygon;
        let is_changed = *before != curve.polygon;
        let radius = is_changed.then(|| sharper_radius(before, &curve.polygon))??;
        let name = quoted(&curve.name);
        Some(format!(
            "{name} is bent to the radius {radius} now, much sharper than before"
        ))
    })
}
