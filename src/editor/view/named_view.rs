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

    /// The view's name on screen.
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
