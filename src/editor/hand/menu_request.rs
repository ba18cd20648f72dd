//! A menu that is asked for, and what it is about.

use glam::DVec2;

/// What a menu is about; it is selected.
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
    /// What lies at no curve.
    Canvas,
    /// A feature of the active curve or reference, in the list.
    Feature,
    /// The plot of the active curve.
    Plot,
}

/// A menu that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MenuRequest {
    /// What it is about.
    pub subject: MenuSubject,
    /// Where on the canvas it is asked for by a key; otherwise it opens at the pointer.
    pub at: Option<DVec2>,
}
