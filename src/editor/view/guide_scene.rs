//! The guides for moving vertices as the canvas draws them.

use glam::DVec2;

/// What guides the move of a vertex. Chains are points of the view plane, broken by
/// [`crate::editor::GAP`].
#[derive(Clone, Debug, Default)]
pub struct GuideScene {
    /// The selected vertex, and the corners of its safe region round it.
    pub region: Option<(DVec2, Vec<DVec2>)>,
    /// The border of that region.
    pub border: Vec<DVec2>,
    /// Where the region goes on beyond the radius in which it was looked for.
    pub limit: Vec<DVec2>,
    /// The moves that lose the chosen feature, the shortest first.
    pub arrows: Vec<LossArrow>,
    /// Texts, the weightiest first: one that would lie over an earlier one is left out.
    pub labels: Vec<GuideLabel>,
}

/// A move of a vertex that loses a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossArrow {
    /// From where the vertex is to where it goes.
    pub ends: [DVec2; 2],
    /// Whether no shorter one was found.
    pub is_shortest: bool,
}

/// A text beside a place.
#[derive(Clone, Debug, PartialEq)]
pub struct GuideLabel {
    /// The place.
    pub at: DVec2,
    /// On which side of it the text stands.
    pub outwards: DVec2,
    /// The text.
    pub text: String,
}

impl GuideScene {
    /// Show nothing.
    pub fn clear(&mut self) {
        self.region = None;
        self.border.clear();
        self.limit.clear();
        self.arrows.clear();
        self.labels.clear();
    }
}
