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

    /// What the view is called on screen.
    pub fn label(self) -> &'static str {
        match self {
            Self::Xy => "View XY, from above",
            Self::Xz => "View XZ, from the front",
            Self::Yz => "View YZ, from the side",
            Self::Isometric => "Isometric",
        }
    }
}

impl Editor {
    /// See the model from somewhere else; the middle of what is shown stays where it is.
    pub fn set_orientation(&mut self, orientation: Orientation) {
        let pivot = self.middle();
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

    /// What the view plane's coordinates are called.
    pub(in crate::editor) fn axis_names(&self) -> [&'static str; 2] {
        let axes = self.view.viewport.orientation.axes();
        axes.map_or(["right", "up"], |axes| {
            axes.map(|axis| ["x", "y", "z"][axis])
        })
    }

    /// The middle of the box around the polygons that are shown.
    fn middle(&self) -> DVec3 {
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
