//! The rulers along the left and the lower edge of each pane, from which guides are dragged.

use glam::DVec2;

use super::viewport::Viewport;
use crate::document::GuideLine;

/// The breadth of a ruler, in screen points.
pub const RULER: f64 = 16.0;

/// Find the guide that a drag from a place on the canvas would place, where the place is on a ruler: an upright one from
/// the ruler at the left, a level one from that below. A view that is turned against the model has no rulers.
pub fn guide_at(place: DVec2, viewport: &Viewport) -> Option<GuideLine> {
    let axes = viewport.orientation.axes()?;
    let is_at_left = (0.0..RULER).contains(&place.x);
    let is_below = (0.0..RULER).contains(&(viewport.size.y - place.y));
    let across = usize::from(!is_at_left);
    let axis = axes[across];
    let at = viewport.grounded(viewport.to_model(place))[axis];
    (is_at_left != is_below).then_some(GuideLine { axis, at })
}

/// Whether a place on the canvas is on a ruler or beyond the pane, where a guide is let go.
pub fn is_off(place: DVec2, viewport: &Viewport) -> bool {
    let [low, high] = [
        DVec2::new(RULER, 0.0),
        viewport.size - DVec2::new(0.0, RULER),
    ];
    place != place.clamp(low.min(high), high.max(low))
}
