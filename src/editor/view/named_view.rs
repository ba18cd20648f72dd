//! The named views: top, front, right and isometric.

use crate::editor::view::orientation::Orientation;

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

    /// How the view is turned, the side from which it looks, and its name on screen.
    fn row(self) -> (Orientation, &'static str, &'static str) {
        match self {
            Self::Xy => (Orientation::XY, "Top", "Top view (XY)"),
            Self::Xz => (Orientation::XZ, "Front", "Front view (XZ)"),
            Self::Yz => (Orientation::YZ, "Right", "Right view (YZ)"),
            Self::Isometric => (Orientation::isometric(), "Isometric", "Isometric"),
        }
    }

    /// How the view is turned.
    pub fn orientation(self) -> Orientation {
        self.row().0
    }

    /// The side from which it looks, in a word.
    pub fn name(self) -> &'static str {
        self.row().1
    }

    /// The view's name on screen.
    pub fn label(self) -> &'static str {
        self.row().2
    }
}

/// The name of the side from which an orientation looks: that of a named view, or "Orbit".
pub fn view_name(orientation: &Orientation) -> &'static str {
    let named = NamedView::ALL.into_iter();
    let mut named = named.filter(|view| view.orientation() == *orientation);
    named.next().map_or("Orbit", NamedView::name)
}
