//! What the editor tells the panels: plain figures and texts, made anew each frame.

use std::path::PathBuf;

use glam::DVec2;

use crate::geometry::{Amplification, Range};

/// Something that the editor cannot do itself and asks the window for.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Ask for a file to open in place of the document. Unsaved changes are asked about first.
    Open,
    /// Ask for a file whose curves are added.
    Import,
    /// Ask for a path to save under.
    SaveAs,
    /// Ask for a path to export to; the extension says the format, the name is a proposal.
    Export(Export),
    /// Ask about unsaved changes, then go on with what was wanted.
    ConfirmDiscard(AfterDiscard),
    /// Leave at once: nothing is unsaved.
    Quit,
    /// Put a text on the system's clipboard.
    CopyText(String),
    /// Read the system's clipboard and call [`super::Editor::paste_text`].
    Paste,
    /// Switch the theme.
    ToggleTheme,
    /// Show or hide the plots.
    TogglePlots,
    /// Open the command palette.
    Palette,
    /// Ask where the curve shall be divided.
    Divide,
    /// Ask how coordinates shall be rounded.
    Round,
    /// Show the list of keys.
    Keys,
    /// Show what this program is.
    About,
}

/// An export that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// The file's extension, which says its format.
    pub extension: &'static str,
    /// The polygon that is written, in formats that hold one.
    pub polygon: crate::geometry::PolygonKind,
    /// A proposal for the file's name.
    pub file_name: String,
}

/// What goes on once unsaved changes may be discarded.
#[derive(Clone, Debug, PartialEq)]
pub enum AfterDiscard {
    /// Begin an empty document.
    New,
    /// Ask for a file to open.
    Open,
    /// Open this file.
    OpenFile(PathBuf),
    /// Open a built-in example.
    OpenExample(usize),
    /// Leave.
    Quit,
}

/// A message to the user, shown until the next action.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The text.
    pub text: String,
    /// Whether something failed.
    pub is_error: bool,
    /// Whether it tells of a step that can be undone on the spot.
    pub offers_undo: bool,
}

/// What the status bar reads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readout {
    /// Where the pointer is, in the view plane.
    pub pointer: Option<DVec2>,
    /// What the view plane's coordinates are called: the model's, or "right" and "up" in a view
    /// that is turned against it.
    pub axes: [&'static str; 2],
    /// The parameter of the hovered place on the curve.
    pub u: Option<f64>,
    /// The curvature there.
    pub curvature: Option<f64>,
    /// Screen points a unit.
    pub scale: f64,
    /// The active curve's degree.
    pub degree: Option<usize>,
}

/// What the inspector says of the active curve, beside the curve itself.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveReport {
    /// Whether the curve is planar.
    pub planar: bool,
    /// The number of segments.
    pub segments: usize,
    /// The arc length, to plotting accuracy.
    pub length: f64,
    /// The smallest and largest curvature among the samples.
    pub curvature: Option<Range>,
    /// The smallest and largest leg of the float S-polygon.
    pub legs: Option<Range>,
    /// Its smallest and largest turning angle, in radians.
    pub turns: Option<Range>,
    /// How much errors in the closed S-polygon grow in the float S-polygon.
    pub amplification: Option<Amplification>,
}
