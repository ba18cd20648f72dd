//! A handle of an operation while it is dragged.

use glam::DVec2;

use crate::operations::Handle;

/// Hold a handle that is dragged.
#[derive(Clone, Debug)]
pub struct HandleDrag {
    /// The handle as it was when it was pressed.
    pub handle: Handle,
    /// Whether it stays in the plane z = 0.
    pub planar: bool,
    /// Where it was pressed, in the view plane.
    pub from: DVec2,
}
