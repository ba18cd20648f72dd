//! What the window shows beside the document.

use serde::{Deserialize, Serialize};

/// What the window shows beside the document, kept from run to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shell {
    pub(super) dark: bool,
    pub(super) plots: bool,
    /// Whether the plot in front is that of harmony.
    pub(super) harmony: bool,
    /// Whether plots show curves scaled to length 1.
    pub(super) normalised: bool,
    /// The layers that are hidden, by their place in the list.
    pub(super) hidden: Option<Vec<usize>>,
    /// How far an arrow key moves the selection; none is as the editor begins.
    pub(super) nudge_step: Option<f64>,
    /// Whether bands of rising and falling curvature are shown on the canvas.
    pub(super) bands: bool,
}

impl Default for Shell {
    fn default() -> Self {
        Self {
            dark: true,
            plots: true,
            harmony: false,
            normalised: false,
            hidden: None,
            nudge_step: None,
            bands: true,
        }
    }
}
