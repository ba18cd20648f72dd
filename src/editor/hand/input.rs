//! Input from mouse and keys, independent of the window system.

use glam::DVec2;

/// A button of the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// The first button: picks and drags.
    Primary,
    /// The second button: turns the view; a click ends what is being drawn.
    Secondary,
    /// The middle button: pans.
    Middle,
}

/// The modifier keys that are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Hash)]
pub struct Modifiers {
    /// Shift: constrains, or adds to the selection.
    pub shift: bool,
    /// Ctrl, or the command key on a Mac: toggles snapping while dragging.
    pub ctrl: bool,
    /// Alt: shows the state before the gesture.
    pub alt: bool,
}

impl Modifiers {
    /// No key.
    pub const NONE: Self = Self {
        shift: false,
        ctrl: false,
        alt: false,
    };
    /// Shift alone.
    pub const SHIFT: Self = Self {
        shift: true,
        ctrl: false,
        alt: false,
    };
    /// Ctrl alone.
    pub const CTRL: Self = Self {
        shift: false,
        ctrl: true,
        alt: false,
    };
    /// Ctrl and shift.
    pub const CTRL_SHIFT: Self = Self {
        shift: true,
        ctrl: true,
        alt: false,
    };
}

/// A key that commands and tools know.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// A letter, digit or sign, in lower case.
    Character(char),
    /// Enter or Return.
    Enter,
    /// Escape.
    Escape,
    /// Delete.
    Delete,
    /// Backspace.
    Backspace,
    /// Tab.
    Tab,
    /// The space bar.
    Space,
    /// An arrow key.
    Left,
    /// An arrow key.
    Right,
    /// An arrow key.
    Up,
    /// An arrow key.
    Down,
    /// A function key, F1 to F12.
    Function(u8),
}

/// One event on the canvas; places are in screen points from the canvas's upper left corner,
/// y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// The pointer is now here.
    Moved {
        /// Where.
        at: DVec2,
    },
    /// The pointer has rested here for a moment.
    Rested {
        /// Where.
        at: DVec2,
    },
    /// A button went down.
    Pressed {
        /// The button.
        button: Button,
        /// Where.
        at: DVec2,
    },
    /// A button went up.
    Released {
        /// The button.
        button: Button,
        /// Where.
        at: DVec2,
    },
    /// The primary button was pressed and released twice in quick succession, the second time
    /// here; comes after the second release.
    DoubleClicked {
        /// Where.
        at: DVec2,
    },
    /// The pointer left the canvas.
    Left,
    /// The wheel turned, or fingers pinched: zoom about a place.
    Zoomed {
        /// Where.
        at: DVec2,
        /// The factor of the scale.
        factor: f64,
    },
    /// The view was pushed without a button (two fingers).
    Panned {
        /// By how many screen points.
        by: DVec2,
    },
    /// A key went down while the canvas has the keyboard.
    Key(Key),
    /// A key is still held, and repeats.
    KeyRepeated(Key),
    /// The space bar went down or up.
    SpaceHeld(bool),
    /// The key of an axis of the model (0 x, 1 y, 2 z) went down, or none is held any more.
    AxisHeld(Option<usize>),
    /// The key that turns round whether features are kept while dragging went down or up.
    KeepingHeld(bool),
    /// The modifier keys that are held have changed.
    Modifiers(Modifiers),
}

impl Input {
    /// Where it happens, if that counts.
    pub(in crate::editor) fn place_mut(&mut self) -> Option<&mut DVec2> {
        match self {
            Self::Moved { at }
            | Self::Rested { at }
            | Self::Pressed { at, .. }
            | Self::Released { at, .. }
            | Self::DoubleClicked { at }
            | Self::Zoomed { at, .. } => Some(at),
            _ => None,
        }
    }
}
