//! A drag of a handle of a previewed operation.

use glam::DVec2;

use crate::operations::Handle;

/// A handle that is dragged.
#[derive(Clone, Copy, Debug)]
pub(in crate::editor) struct HandleDrag {
    /// The handle when it was pressed.
    pub handle: Handle,
    /// Whether the handle stays in the plane z = 0.
    pub planar: bool,
    /// The pressed place in the view plane.
    pub from: DVec2,
}
