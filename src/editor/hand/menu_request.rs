//! A request for a context menu, and its subject.

use glam::DVec2;

/// The subject of a context menu: selected items, or the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MenuSubject {
    /// The selected vertices.
    Vertex,
    /// A leg of a float polygon, whose two vertices are selected.
    Leg,
    /// An end of the active curve.
    End,
    /// The active curve.
    Curve,
    /// The active reference.
    Reference,
    /// A place away from all curves.
    Canvas,
    /// A feature of the active curve or reference, in the list.
    Feature,
    /// The plot of the active curve.
    Plot,
}

/// A request for a context menu.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MenuRequest {
    /// Its subject.
    pub subject: MenuSubject,
    /// The place on the canvas, if a key requests it; otherwise the menu opens at the pointer.
    pub at: Option<DVec2>,
}
