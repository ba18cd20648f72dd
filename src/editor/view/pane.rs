//! A pane: one view of the model on the canvas, with what is drawn in it.

use glam::DVec3;

use crate::editor::view::outlines::{Outlines, Sketch};
use crate::editor::view::scene::Scene;
use crate::editor::view::viewport::Viewport;

/// Hold how one pane of the canvas sees the model, and what it shows.
#[derive(Debug, Default)]
pub(in crate::editor) struct Pane {
    pub(in crate::editor) viewport: Viewport,
    /// The point about which the view turns.
    pub(in crate::editor) target: DVec3,
    /// The view that last showed everything, and the revision of the document then.
    pub(in crate::editor) fitted: Option<(Viewport, u64)>,
    pub(in crate::editor) outlines: Outlines,
    pub(in crate::editor) ghost: Sketch,
    pub(in crate::editor) proposed: Sketch,
    /// The other curves that an operation works on.
    pub(in crate::editor) other_ghosts: Vec<Sketch>,
    pub(in crate::editor) scene: Scene,
}
