//! The table of commands: menus, keys, buttons and the command palette all read it.

use super::input::{Key, Modifiers};
use super::layers::Layer;
use super::orbit::NamedView;
use super::tools::ToolKind;
use crate::geometry::{End, PolygonKind};

/// Something that the user can ask for by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Command {
    /// Begin an empty document.
    New,
    /// Open a file.
    Open,
    /// Add the curves of a file to the document.
    Import,
    /// Save under the present path.
    Save,
    /// Save under another path.
    SaveAs,
    /// Write a drawing for CAD.
    ExportDxf,
    /// Write a table of polygon vertices.
    ExportCsv(PolygonKind),
    /// Open a built-in example, by its number.
    OpenExample(usize),
    /// Leave.
    Quit,
    /// Take back the last step.
    Undo,
    /// Make the last undone step again.
    Redo,
    /// Copy the selected vertices and remove them.
    Cut,
    /// Copy the selected curve or vertices.
    Copy,
    /// Add what was copied.
    Paste,
    /// Add a copy of the active curve.
    Duplicate,
    /// Remove the selected vertices.
    Delete,
    /// Remove the active curve.
    DeleteCurve,
    /// Select all vertices of the active curve, then of all curves.
    SelectAll,
    /// Select nothing.
    SelectNone,
    /// Reverse the active curve's direction.
    Reverse,
    /// Make the active curve periodic, or open.
    TogglePeriodic,
    /// Raise the active curve's degree by one; the polygon stays.
    RaiseDegree,
    /// Lower the active curve's degree by one; the polygon stays.
    LowerDegree,
    /// Raise the active curve's degree by one; the curve stays, as nearly as it can.
    RaiseCurveDegree,
    /// Lower the active curve's degree by one; the curve stays, as nearly as it can.
    LowerCurveDegree,
    /// Halve every segment of the active curve.
    Subdivide,
    /// Continue the active curve at one end by a segment.
    Extend(End),
    /// Divide the active curve: split it or trim it.
    Divide,
    /// Round the coordinates of one of the active curve's polygons.
    Round,
    /// Show or hide the active curve.
    ToggleVisible,
    /// Lock or unlock the active curve.
    ToggleLocked,
    /// Fit the selection, or everything.
    Fit,
    /// Fit everything.
    FitAll,
    /// Zoom in about the middle.
    ZoomIn,
    /// Zoom out about the middle.
    ZoomOut,
    /// See the model from a certain side.
    View(NamedView),
    /// Give the comb a legible scale.
    ResetComb,
    /// Show or hide a layer.
    ToggleLayer(Layer),
    /// Snap to grid, vertices and targets, or not.
    ToggleSnapping,
    /// Take a tool into the hand.
    Tool(ToolKind),
    /// Switch between the dark and the light theme.
    ToggleTheme,
    /// Show or hide the plots.
    TogglePlots,
    /// Find a command by its name.
    Palette,
    /// List the keys.
    Keys,
    /// Tell what this program is.
    About,
}

/// A key with its modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shortcut {
    /// The modifiers that must be held, and no others.
    pub modifiers: Modifiers,
    /// The key.
    pub key: Key,
}

impl Command {
    /// Whether it changes only how things are shown, so that a drag may go on.
    pub fn only_shows(self) -> bool {
        matches!(
            self,
            Self::ZoomIn
                | Self::ZoomOut
                | Self::ToggleLayer(_)
                | Self::ToggleSnapping
                | Self::ToggleTheme
                | Self::TogglePlots
        )
    }

    /// List every command there is, in the order in which the palette offers them; `examples`
    /// is the number of built-in examples.
    pub fn all(examples: usize) -> Vec<Self> {
        let mut all = vec![
            Self::New,
            Self::Open,
            Self::Import,
            Self::Save,
            Self::SaveAs,
            Self::ExportDxf,
        ];
        all.extend(PolygonKind::ALL.map(Self::ExportCsv));
        all.extend((0..examples).map(Self::OpenExample));
        all.extend([
            Self::Quit,
            Self::Undo,
            Self::Redo,
            Self::Cut,
            Self::Copy,
            Self::Paste,
            Self::Duplicate,
            Self::Delete,
            Self::DeleteCurve,
            Self::SelectAll,
            Self::SelectNone,
            Self::Reverse,
            Self::TogglePeriodic,
            Self::RaiseDegree,
            Self::LowerDegree,
            Self::RaiseCurveDegree,
            Self::LowerCurveDegree,
            Self::Subdivide,
            Self::Extend(End::Start),
            Self::Extend(End::Finish),
            Self::Divide,
            Self::Round,
            Self::ToggleVisible,
            Self::ToggleLocked,
            Self::Fit,
            Self::FitAll,
            Self::ZoomIn,
            Self::ZoomOut,
        ]);
        all.extend(NamedView::ALL.map(Self::View));
        all.push(Self::ResetComb);
        all.extend(Layer::ALL.map(Self::ToggleLayer));
        all.push(Self::ToggleSnapping);
        all.extend(ToolKind::ALL.map(Self::Tool));
        all.extend([
            Self::ToggleTheme,
            Self::TogglePlots,
            Self::Palette,
            Self::Keys,
            Self::About,
        ]);
        all
    }

    /// What menus and buttons call the command.
    pub fn label(self) -> String {
        let label = match self {
            Self::New => "New",
            Self::Open => "Open…",
            Self::Import => "Import curves…",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::ExportDxf => "Export DXF…",
            Self::ExportCsv(PolygonKind::Float) => "Export float S-polygon as CSV…",
            Self::ExportCsv(PolygonKind::Clamped) => "Export closed S-polygon as CSV…",
            Self::ExportCsv(PolygonKind::Bezier) => "Export Bézier polygons as CSV…",
            Self::OpenExample(index) => return super::examples::title(index),
            Self::Quit => "Quit",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::Cut => "Cut",
            Self::Copy => "Copy",
            Self::Paste => "Paste",
            Self::Duplicate => "Duplicate curve",
            Self::Delete => "Delete vertices",
            Self::DeleteCurve => "Delete curve",
            Self::SelectAll => "Select all",
            Self::SelectNone => "Select nothing",
            Self::Reverse => "Reverse direction",
            Self::TogglePeriodic => "Periodic",
            Self::RaiseDegree => "Raise degree",
            Self::LowerDegree => "Lower degree",
            Self::RaiseCurveDegree => "Raise degree, keep curve",
            Self::LowerCurveDegree => "Lower degree, keep curve",
            Self::Subdivide => "Subdivide",
            Self::Extend(End::Start) => "Extend start",
            Self::Extend(End::Finish) => "Extend end",
            Self::Divide => "Split or trim…",
            Self::Round => "Round coordinates…",
            Self::ToggleVisible => "Visible",
            Self::ToggleLocked => "Locked",
            Self::Fit => "Fit selection",
            Self::FitAll => "Fit all",
            Self::ZoomIn => "Zoom in",
            Self::ZoomOut => "Zoom out",
            Self::View(view) => view.label(),
            Self::ResetComb => "Reset comb scale",
            Self::ToggleLayer(layer) => layer.label(),
            Self::ToggleSnapping => "Snapping",
            Self::Tool(tool) => tool.label(),
            Self::ToggleTheme => "Light theme",
            Self::TogglePlots => "Plots",
            Self::Palette => "Find a command…",
            Self::Keys => "Keys and mouse",
            Self::About => "About Batten",
        };
        label.to_owned()
    }

    /// One sentence that says what the command does.
    pub fn tooltip(self) -> String {
        let tooltip = match self {
            Self::New => "Begin an empty document",
            Self::Open => "Open a .batten project or a CSV table in place of this document",
            Self::Import => "Add the curves of a file to this document",
            Self::Save => "Save the document to its file",
            Self::SaveAs => "Save the document to another file",
            Self::ExportDxf => {
                "Write curves and polygons as DXF: clamped splines, and both S-polygons on layers of their own"
            }
            Self::ExportCsv(_) => "Write a table of vertices, with degree and kind in its header",
            Self::OpenExample(index) => return super::examples::description(index),
            Self::Quit => "Leave Batten",
            Self::Undo => "Take back the last step",
            Self::Redo => "Make the last undone step again",
            Self::Cut => "Copy the selected vertices and remove them",
            Self::Copy => "Copy the active curve, or only its selected vertices",
            Self::Paste => "Add what was copied as a curve of its own",
            Self::Duplicate => "Add a copy of the active curve",
            Self::Delete => "Remove the selected vertices",
            Self::DeleteCurve => "Remove the active curve as a whole",
            Self::SelectAll => "Select all vertices of the active curve; again, of all curves",
            Self::SelectNone => "Select nothing",
            Self::Reverse => "Let the curve run the other way; its shape stays",
            Self::TogglePeriodic => {
                "Join the curve's end to its start, or open it; the polygon stays"
            }
            Self::RaiseDegree => {
                "Raise the degree by one; the polygon stays, the curve becomes smoother"
            }
            Self::LowerDegree => {
                "Lower the degree by one; the polygon stays, the curve follows it closer"
            }
            Self::RaiseCurveDegree => {
                "Raise the degree by one; the curve stays, exactly if it is one segment"
            }
            Self::LowerCurveDegree => {
                "Lower the degree by one; the curve stays as nearly as it can, and the error is told"
            }
            Self::Subdivide => "Halve every segment; the curve stays",
            Self::Extend(_) => "Continue the curve's end by one segment, exactly as it runs",
            Self::Divide => "Split the curve at a parameter, or keep a part of it",
            Self::Round => {
                "Round the float or the closed S-polygon to some digits, and tell what that does to the curve"
            }
            Self::ToggleVisible => "Show or hide the active curve",
            Self::ToggleLocked => "Protect the active curve's shape from edits, or release it",
            Self::Fit => "Show the selected vertices, or everything if fewer than two are selected",
            Self::FitAll => "Show everything",
            Self::ZoomIn => "Show less, larger",
            Self::ZoomOut => "Show more, smaller",
            Self::View(_) => "See the model from this side; drag with the right button to orbit",
            Self::ResetComb => "Give the curvature comb a legible scale",
            Self::ToggleLayer(_) => "Show or hide this layer",
            Self::ToggleSnapping => {
                "Let dragged points snap to the grid, to vertices and to targets"
            }
            Self::Tool(tool) => tool.tooltip(),
            Self::ToggleTheme => "Switch between the dark and the light theme",
            Self::TogglePlots => "Show or hide the plots under the canvas",
            Self::Palette => "Find a command by typing a part of its name",
            Self::Keys => "List what keys and mouse do",
            Self::About => "Tell version and licence",
        };
        tooltip.to_owned()
    }

    /// The key that gives the command.
    pub fn shortcut(self) -> Option<Shortcut> {
        let plain = |key| {
            Some(Shortcut {
                modifiers: Modifiers::NONE,
                key,
            })
        };
        let ctrl = |letter| {
            Some(Shortcut {
                modifiers: Modifiers::CTRL,
                key: Key::Character(letter),
            })
        };
        let ctrl_shift = |letter| {
            Some(Shortcut {
                modifiers: Modifiers::CTRL_SHIFT,
                key: Key::Character(letter),
            })
        };
        match self {
            Self::New => ctrl('n'),
            Self::Open => ctrl('o'),
            Self::Import => ctrl('i'),
            Self::Save => ctrl('s'),
            Self::SaveAs => ctrl_shift('s'),
            Self::ExportDxf => ctrl('e'),
            Self::Quit => ctrl('q'),
            Self::Undo => ctrl('z'),
            Self::Redo => ctrl_shift('z'),
            Self::Cut => ctrl('x'),
            Self::Copy => ctrl('c'),
            Self::Paste => ctrl('v'),
            Self::Duplicate => ctrl('d'),
            Self::Delete => plain(Key::Delete),
            Self::DeleteCurve => Some(Shortcut {
                modifiers: Modifiers::CTRL,
                key: Key::Delete,
            }),
            Self::SelectAll => ctrl('a'),
            Self::SelectNone => ctrl_shift('a'),
            Self::Fit => plain(Key::Character('f')),
            Self::FitAll => plain(Key::Character('h')),
            Self::ZoomIn => plain(Key::Character('+')),
            Self::ZoomOut => plain(Key::Character('-')),
            Self::View(view) => plain(Key::Function(2 + view as u8)),
            Self::ToggleLayer(layer) => plain(Key::Character(char::from(b'1' + layer as u8))),
            Self::ToggleSnapping => plain(Key::Character('g')),
            Self::Tool(tool) => plain(Key::Character(tool.letter())),
            Self::Palette => ctrl('p'),
            Self::Keys => plain(Key::Function(1)),
            Self::ToggleTheme => plain(Key::Function(9)),
            Self::TogglePlots => plain(Key::Function(8)),
            _ => None,
        }
    }
}
