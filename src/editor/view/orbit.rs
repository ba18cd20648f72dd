//! From where the model is seen: the views along the axes, and orbiting between them.

use glam::{DVec2, DVec3};

use crate::editor::Editor;
use crate::editor::view::orientation::Orientation;

/// Radians that the view turns by for each screen point of a drag.
const TURN: f64 = 0.008;

/// A view with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NamedView {
    /// From above: x to the right, y up.
    Xy,
    /// From the front: x to the right, z up.
    Xz,
    /// From the side: y to the right, z up.
    Yz,
    /// From above a corner, all axes equally long.
    Isometric,
}

impl NamedView {
    /// Every view, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Xy, Self::Xz, Self::Yz, Self::Isometric];

    /// How the view is turned.
    pub fn orientation(self) -> Orientation {
        match self {
            Self::Xy => Orientation::XY,
            Self::Xz => Orientation::XZ,
            Self::Yz => Orientation::YZ,
            Self::Isometric => Orientation::isometric(),
        }
    }

    /// The side from which it looks, in a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xy => "Top",
            Self::Xz => "Front",
            Self::Yz => "Right",
            Self::Isometric => "Isometric",
        }
    }

    /// What the view is called on screen.
    pub fn label(self) -> &'static str {
        match self {
            Self::Xy => "Top view (XY)",
            Self::Xz => "Front view (XZ)",
            Self::Yz => "Right view (YZ)",
            Self::Isometric => "Isometric",
        }
    }
}

/// The name of the side from which an orientation looks: that of a named view, or "Orbit".
pub fn view_name(orientation: &Orientation) -> &'static str {
    let named = NamedView::ALL.into_iter();
    let mut named = named.filter(|view| view.orientation() == *orientation);
    named.next().map_or("Orbit", NamedView::name)
}

impl Editor {
    /// See the model from somewhere else; the middle of what is shown stays where it is.
    pub fn set_orientation(&mut self, orientation: Orientation) {
        let pivot = self.middle();
        self.view.target = pivot;
        let before = self.view.viewport.flatten(pivot);
        self.view.viewport.orientation = orientation;
        self.view.viewport.centre += self.view.viewport.flatten(pivot) - before;
        self.set_pivot(None);
    }

    /// Turn the view by a drag of some screen points.
    pub fn orbit(&mut self, by: DVec2) {
        if by.is_finite() {
            let turned = self
                .view
                .viewport
                .orientation
                .orbited(TURN * by.x, TURN * by.y);
            self.set_orientation(turned);
        }
    }

    /// Whether everything that is shown is planar, and seen from elsewhere than from above.
    pub fn is_orbited(&self) -> bool {
        let mut shown = self.document().curves().filter(|(_, curve)| curve.visible);
        self.view.viewport.orientation != Orientation::XY
            && shown.all(|(_, curve)| curve.polygon.is_planar())
    }

    /// The point of the model under a place of the view plane: in the plane through the middle of what was
    /// shown when the view was last turned or fitted, or in the plane z = 0 seen from above.
    pub(in crate::editor) fn point_under(&self, place: DVec2) -> DVec3 {
        let orientation = &self.view.viewport.orientation;
        orientation.point_at(place, self.view.target)
    }

    /// The middle of the box around the polygons that are shown.
    pub(in crate::editor) fn middle(&self) -> DVec3 {
        let shown = self.document().curves().filter(|(_, curve)| curve.visible);
        let vertices = shown.flat_map(|(_, curve)| curve.polygon.vertices());
        let (low, high) = vertices.fold(
            (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |(low, high), vertex| (low.min(*vertex), high.max(*vertex)),
        );
        if low.is_finite() {
            0.5 * (low + high)
        } else {
            DVec3::ZERO
        }
    }
}
