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
    /// The layers that are hidden, by their place in the list.
    pub(super) hidden: Option<Vec<usize>>,
}

impl Default for Shell {
    fn default() -> Self {
        Self {
            dark: true,
            plots: true,
            harmony: false,
            hidden: None,
        }
    }
}
