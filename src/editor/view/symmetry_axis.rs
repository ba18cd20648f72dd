//! The axes of the active curve, if it stays symmetric.

use glam::DVec2;

use super::scene::Mark;
use super::sight::Sight;
use super::viewport::Viewport;
use crate::document::Curve;
use crate::geometry::Mirror;

/// A plane is seen from its edge if its normal is turned towards the eye by less than this sine.
const EDGE_ON: f64 = 1e-9;

impl Sight<'_> {
    /// The axes, across all that is seen.
    pub(super) fn symmetry_marks(self) -> Vec<Mark> {
        let active = self.active().and_then(|id| self.document().curve(id));
        let Some(curve) = active.filter(|curve| curve.visible) else {
            return Vec::new();
        };
        let seen = self.viewport().view_box();
        let reach = seen.low.distance(seen.high);
        let middle = 0.5 * (seen.low + seen.high);
        let axes = symmetry_axes(curve, self.viewport());
        let marks = axes.map(|[through, along]| {
            let foot = through + (middle - through).dot(along) * along;
            Mark::SymmetryAxis([foot - reach * along, foot + reach * along])
        });
        marks.collect()
    }
}

/// The axes of a curve as a viewport shows them: a point of each and its direction, of length 1. A plane that is not seen
/// from its edge has none.
pub fn symmetry_axes(
    curve: &Curve,
    viewport: &Viewport,
) -> impl Iterator<Item = [DVec2; 2]> + use<> {
    let symmetry = curve.symmetry;
    let mirrors = symmetry
        .into_iter()
        .flat_map(|it| [Some(it.mirror()), it.second()]);
    let planes = mirrors
        .flatten()
        .filter_map(|mirror: Mirror| mirror.plane());
    let towards = viewport.orientation.towards();
    let planes = planes.filter(move |[_, normal]| normal.dot(towards).abs() <= EDGE_ON);
    let orientation = viewport.orientation;
    planes.filter_map(move |[through, normal]| {
        let along = orientation.flatten(normal).try_normalize()?.perp();
        Some([orientation.flatten(through), along])
    })
}
