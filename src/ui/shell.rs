//! What the window shows beside the document.

use serde::{Deserialize, Serialize};

use crate::editor::{Command, Editor};

/// What the window shows beside the document, kept from run to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shell {
    pub(super) dark: bool,
    pub(super) plots: bool,
    pub(super) legs: bool,
    /// The layers that are hidden, by their place in the list.
    pub(super) hidden: Option<Vec<usize>>,
}

impl Default for Shell {
    fn default() -> Self {
        Self {
            dark: true,
            plots: true,
            legs: false,
            hidden: None,
        }
    }
}

impl Shell {
    /// Whether a switch is on, the window's own switches included.
    pub fn is_checked(&self, editor: &Editor, command: Command) -> Option<bool> {
        match command {
            Command::ToggleTheme => Some(!self.dark),
            Command::TogglePlots => Some(self.plots),
            _ => editor.is_checked(command),
        }
    }
}
