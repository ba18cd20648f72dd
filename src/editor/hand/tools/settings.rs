//! The settings of the tools: what outlives a gesture, and panels know too.

use glam::DVec2;

use super::draw_way::DrawWay;
use super::measured::Measurement;
use crate::editor::hand::drawing_plane::LegLocks;
use crate::editor::hand::end_fit::{EndFitSettings, LastAction};
use crate::editor::selection::Selection;

/// Hold what tools share with panels and with each other.
#[derive(Clone, Debug, Default)]
pub struct ToolSettings {
    /// How the draw tool makes curves.
    pub draw: DrawSettings,
    /// Whether inserting and deleting leave the other vertices in their places, instead of the curve in its shape.
    pub vertices_stay: bool,
    /// The locked length or direction of the leg that is drawn.
    pub locks: LegLocks,
    /// Where the user has put the pivot of rotations and scalings; `None` while it follows the selection.
    pub pivot: Option<DVec2>,
    /// The pivot of the last rotation or scaling, and what was selected: it stays as long as the selection.
    pub turned: Option<(DVec2, Selection)>,
    /// The finished measurement.
    pub measurement: Option<Measurement>,
    /// The settings of the end-fit tool.
    pub end_fit: EndFitSettings,
    /// The result of the last action of the end-fit panel.
    pub last_end_fit: Option<LastAction>,
}

/// How the draw tool makes a curve of clicks: it is kept from one curve to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DrawSettings {
    /// The degree; `None` for that of the active curve.
    pub degree: Option<usize>,
    /// What it makes of clicks.
    pub way: DrawWay,
}

impl ToolSettings {
    /// Forget what lasts only as long as a tool is in use.
    pub(super) fn renew(&mut self) {
        self.locks = LegLocks::default();
        self.pivot = None;
        self.turned = None;
        self.end_fit.picking = false;
        self.end_fit.closed = false;
    }
}
