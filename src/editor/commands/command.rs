//! The table of commands: menus, keys, buttons and the command palette all read it.

use crate::document::CurveId;
use crate::editor::hand::following::Follow;
use crate::editor::hand::input::{Key, Modifiers};
use crate::editor::hand::tools::{Arrangement, ToolKind};
use crate::editor::same_shape::KEEP_SHAPE;
use crate::editor::view::layers::Layer;
use crate::editor::view::{CombsOf, CurvatureDisplay, NamedView, PaneLayout};
use crate::geometry::Continuity;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{KINDS, ReferenceKind};
use crate::operations::{self, Operation};

/// Something that the user can ask for by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Command {
    /// Take back the last step.
    Undo,
    /// Make the last undone step again.
    Redo,
    /// Add copies of the selected curves and references.
    Duplicate,
    /// Remove the selected vertices, or the selected curves and references once they are named.
    Delete,
    /// Remove the selected curves and references.
    DeleteCurve,
    /// Select all vertices of the selected curves, then of all curves.
    SelectAll,
    /// Select nothing.
    SelectNone,
    /// Lock the selected vertices, or unlock them.
    ToggleVerticesLocked,
    /// Make the selected curves periodic, or open.
    TogglePeriodic,
    /// Keep the selected curves symmetric, or let their halves change alone.
    ToggleSymmetric,
    /// Do an operation on the active curve.
    Operation(&'static Operation),
    /// Say in which unit the document's numbers are, or that they have none; they stay.
    SetUnit(Option<LengthUnit>),
    /// Convert the document's numbers to a unit.
    ConvertUnit(LengthUnit),
    /// Add a reference of a kind.
    AddReference(&'static ReferenceKind),
    /// Add a reference by formulas.
    AddFormula,
    /// Show or hide the selected curves and references.
    ToggleVisible,
    /// Lock or unlock the selected curves and references.
    ToggleLocked,
    /// Put the selected curves and references in a group of their own.
    Group,
    /// Take the selected curves and references out of their groups.
    Ungroup,
    /// Hide what is not selected, or show it again.
    Isolate,
    /// Show what is hidden.
    ShowAll,
    /// Align or distribute what is selected.
    Arrange(Arrangement),
    /// Fit the selected vertices, or the selected curves.
    Fit,
    /// Fit everything.
    FitAll,
    /// Zoom in about the middle.
    ZoomIn,
    /// Zoom out about the middle.
    ZoomOut,
    /// See the model from a certain side.
    View(NamedView),
    /// See the model in one pane, or in several at once.
    Panes(PaneLayout),
    /// Give the comb a legible scale.
    ResetComb,
    /// Go to the feature that is chosen in the list.
    GoToFeature,
    /// Compare the active curve with another curve or reference in every plot, or with none.
    Compare(Option<CurveId>),
    /// Let the end of the active curve that the end-fit tool corrects follow another curve's end that it meets.
    Match(CurveId, Continuity),
    /// Show or hide a layer.
    ToggleLayer(Layer),
    /// Show the bands of rising and falling curvature on the canvas, or only under the plot.
    ToggleBands,
    /// Write curvatures as κ, as radii, or as both.
    ShowCurvature(CurvatureDisplay),
    /// Show the comb of the active curve, or those of others too.
    ShowCombs(CombsOf),
    /// Snap to grid, vertices and targets, or not.
    ToggleSnapping,
    /// Let alignment lines attract, too, or not.
    ToggleAlignment,
    /// Let points that are drawn snap to edges of pictures, or not.
    ToggleEdges,
    /// Remove all guides.
    RemoveGuides,
    /// Let the neighbours of dragged vertices follow, or not.
    Follow(Follow),
    /// Let the other closed vertices follow a dragged one, or stay.
    ToggleClosedFollow,
    /// Let inserting and deleting vertices keep the curve, or the other vertices.
    ToggleKeepShape,
    /// Let no drag add a feature, or let drags be free.
    ToggleKeeping,
    /// Take a tool into the hand.
    Tool(ToolKind),
}

/// A key with its modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shortcut {
    /// The modifiers that must be held, and no others.
    pub modifiers: Modifiers,
    /// The key.
    pub key: Key,
}

impl Shortcut {
    /// A key alone.
    pub const fn plain(key: Key) -> Self {
        Self {
            modifiers: Modifiers::NONE,
            key,
        }
    }

    /// A letter with Ctrl.
    pub const fn ctrl(letter: char) -> Self {
        Self {
            modifiers: Modifiers::CTRL,
            key: Key::Character(letter),
        }
    }

    /// A letter with Ctrl and Shift.
    pub const fn ctrl_shift(letter: char) -> Self {
        Self {
            modifiers: Modifiers::CTRL_SHIFT,
            key: Key::Character(letter),
        }
    }
}

impl Command {
    /// Whether it changes only the view: it ends no preview.
    pub fn only_shows(self) -> bool {
        matches!(
            self,
            Self::Fit
                | Self::FitAll
                | Self::ZoomIn
                | Self::ZoomOut
                | Self::View(_)
                | Self::Panes(_)
                | Self::ResetComb
                | Self::GoToFeature
                | Self::Compare(_)
                | Self::ToggleLayer(_)
                | Self::ToggleBands
                | Self::ShowCurvature(_)
                | Self::ShowCombs(_)
                | Self::ToggleSnapping
                | Self::ToggleAlignment
                | Self::ToggleEdges
                | Self::Follow(_)
                | Self::ToggleClosedFollow
                | Self::ToggleKeepShape
                | Self::ToggleKeeping
        )
    }

    /// The commands that set the document's unit: none first.
    pub fn units() -> impl Iterator<Item = Self> {
        let units = LengthUnit::ALL.into_iter().map(Some);
        [None].into_iter().chain(units).map(Self::SetUnit)
    }

    /// List every command there is but those for one curve of a document, in the order in which the palette offers them.
    pub fn all() -> Vec<Self> {
        let mut all = vec![
            Self::Undo,
            Self::Redo,
            Self::Duplicate,
            Self::Delete,
            Self::DeleteCurve,
            Self::SelectAll,
            Self::SelectNone,
            Self::ToggleVerticesLocked,
            Self::TogglePeriodic,
            Self::ToggleSymmetric,
            Self::ToggleVisible,
            Self::ToggleLocked,
            Self::Group,
            Self::Ungroup,
            Self::Isolate,
            Self::ShowAll,
        ];
        all.extend(Arrangement::ALL.map(Self::Arrange));
        all.extend(Self::units());
        all.extend(LengthUnit::ALL.map(Self::ConvertUnit));
        all.extend(operations::ALL.iter().copied().map(Self::Operation));
        all.extend(KINDS.iter().copied().map(Self::AddReference));
        all.push(Self::AddFormula);
        all.extend([Self::Fit, Self::FitAll, Self::ZoomIn, Self::ZoomOut]);
        all.extend(NamedView::ALL.map(Self::View));
        all.extend(PaneLayout::ALL.map(Self::Panes));
        all.extend([Self::ResetComb, Self::GoToFeature, Self::Compare(None)]);
        all.extend(Layer::ALL.map(Self::ToggleLayer));
        all.push(Self::ToggleBands);
        all.extend(CurvatureDisplay::ALL.map(Self::ShowCurvature));
        all.extend(CombsOf::ALL.map(Self::ShowCombs));
        all.extend([
            Self::ToggleSnapping,
            Self::ToggleAlignment,
            Self::ToggleEdges,
            Self::RemoveGuides,
            Self::ToggleKeeping,
        ]);
        all.extend(Follow::ALL.map(Self::Follow));
        all.extend([Self::ToggleClosedFollow, Self::ToggleKeepShape]);
        all.extend(ToolKind::ALL.map(Self::Tool));
        all
    }

    /// What menus and buttons call the command.
    pub fn label(self) -> String {
        let label = match self {
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::Duplicate => "Duplicate curve",
            Self::Delete => "Delete vertices",
            Self::DeleteCurve => "Delete curve",
            Self::SelectAll => "Select all",
            Self::SelectNone => "Deselect all",
            Self::ToggleVerticesLocked => "Lock vertices",
            Self::TogglePeriodic => "Periodic",
            Self::ToggleSymmetric => "Stays symmetric",
            Self::Operation(operation) if operation.parameters.is_empty() => operation.label,
            // What asks for more before anything is done.
            Self::Operation(operation) => return format!("{}…", operation.label),
            Self::AddReference(kind) => return format!("Add reference: {}", kind.label),
            Self::AddFormula => "Add reference: Formula",
            Self::SetUnit(None) => "Document unit: none",
            Self::SetUnit(Some(unit)) => return format!("Document unit: {}", unit.name()),
            Self::ConvertUnit(unit) => return format!("Convert document to {}", unit.name()),
            Self::ToggleVisible => "Visible",
            Self::ToggleLocked => "Locked",
            Self::Group => "Group",
            Self::Ungroup => "Ungroup",
            Self::Isolate => "Isolate",
            Self::ShowAll => "Show all curves",
            Self::Arrange(arrangement) => arrangement.label(),
            Self::Fit => "Fit selection",
            Self::FitAll => "Fit all",
            Self::ZoomIn => "Zoom in",
            Self::ZoomOut => "Zoom out",
            Self::View(view) => view.label(),
            Self::Panes(layout) => layout.label(),
            Self::ResetComb => "Reset comb scale",
            Self::GoToFeature => "Go to feature",
            Self::Compare(None) => "Compare with nothing",
            Self::Compare(Some(_)) => "Compare with another curve",
            Self::Match(_, level) => return format!("Match up to {}", level.name()),
            Self::ToggleLayer(layer) => layer.label(),
            Self::ToggleBands => "Feature bands on the canvas",
            Self::ShowCurvature(display) => display.label(),
            Self::ShowCombs(of) => of.label(),
            Self::ToggleSnapping => "Snapping",
            Self::ToggleAlignment => "Alignment lines",
            Self::ToggleEdges => "Edges of pictures",
            Self::RemoveGuides => "Remove guides",
            Self::Follow(follow) => follow.label(),
            Self::ToggleClosedFollow => "Closed vertices follow",
            Self::ToggleKeepShape => KEEP_SHAPE,
            Self::ToggleKeeping => "Keep features",
            Self::Tool(tool) => tool.label(),
        };
        label.to_owned()
    }

    /// One sentence that says what the command does.
    pub fn tooltip(self) -> String {
        let tooltip = match self {
            Self::Undo => "Undo the last step",
            Self::Redo => "Redo the last undone step",
            Self::Duplicate => "Add copies of the selected curves and references",
            Self::Delete => {
                "Delete the selected vertices; without any, Del twice deletes the curves"
            }
            Self::DeleteCurve => "Delete the selected curves and references",
            Self::SelectAll => "Select all vertices of the selected curves; again, of all curves",
            Self::SelectNone => "Deselect all",
            Self::ToggleVerticesLocked => {
                "Lock the selected vertices so that nothing moves them, or unlock them"
            }
            Self::TogglePeriodic => {
                "Join the end of each selected curve to its start, or open it; the polygons stay"
            }
            Self::ToggleSymmetric => {
                "Let an edit of one half of a symmetric curve change the other half too, or not"
            }
            Self::Operation(operation) => operation.help,
            Self::AddReference(kind) => return format!("{}: {}", kind.label, kind.help),
            Self::AddFormula => "Add a curve by formulas x(t), y(t) and z(t) of your own",
            Self::SetUnit(_) => {
                "Set the unit that the document's numbers are in; the numbers stay as they are"
            }
            Self::ConvertUnit(_) => {
                "Convert every number of the document to this unit; everything keeps its size"
            }
            Self::ToggleVisible => "Show or hide the selected curves and references",
            Self::ToggleLocked => {
                "Protect the shapes of selected curves from edits, or release them"
            }
            Self::Group => "Put the selected curves and references in a new group",
            Self::Ungroup => "Take the selected curves and references out of their group",
            Self::Isolate => "Show only what is selected; again, show what that has hidden",
            Self::ShowAll => "Show every curve, reference and picture that is hidden",
            Self::Arrange(arrangement) => arrangement.tooltip(),
            Self::Fit => "Show the selected vertices, or the selected curves if fewer than two are",
            Self::FitAll => "Zoom to fit everything",
            Self::ZoomIn => "Enlarge the view",
            Self::ZoomOut => "Show more of the model",
            Self::View(_) => "See the model from this side; drag with the right button to orbit",
            Self::Panes(layout) => layout.tooltip(),
            Self::ResetComb => "Scale the curvature comb to a readable size",
            Self::GoToFeature => "Show the surroundings of the feature that is chosen in the list",
            Self::Compare(None) => "Show the plots of the active curve alone",
            Self::Compare(Some(_)) => "Show the plots of this curve beside those of the active one",
            Self::Match(_, level) => {
                let label = level.label();
                return format!("Let the end follow the other curve here, up to the {label}");
            }
            Self::ToggleLayer(layer) => layer.row().help,
            Self::ToggleBands => {
                "Show the bands of rising and falling curvature along the curve, or only under the plot"
            }
            Self::ShowCombs(_) => "Choose which curves have a comb; all combs have one scale",
            Self::ShowCurvature(_) => "Choose whether the window shows κ, the radius R, or both",
            Self::ToggleSnapping => {
                "Let dragged points snap to the grid, to vertices and to targets"
            }
            Self::ToggleEdges => {
                "Snap drawn points to the strongest edge of a picture near the pointer"
            }
            Self::RemoveGuides => "Remove all guides; to remove one, drag it onto a ruler",
            Self::ToggleAlignment => {
                "While snapping is on, snap to lines through vertices, ends and their tangents"
            }
            Self::Follow(follow) => follow.tooltip(),
            Self::ToggleClosedFollow => {
                "Let the other vertices of the closed S-polygon follow a dragged one, or stay"
            }
            Self::ToggleKeepShape => {
                "Let inserting and deleting a vertex keep the curve, or the places of the others"
            }
            Self::ToggleKeeping => {
                "Let no edit of vertices add a curvature extremum or an inflection"
            }
            Self::Tool(tool) => tool.row().help,
        };
        tooltip.to_owned()
    }

    /// The key that gives the command.
    pub fn shortcut(self) -> Option<Shortcut> {
        let plain = |key| Some(Shortcut::plain(key));
        let ctrl = |letter| Some(Shortcut::ctrl(letter));
        let ctrl_shift = |letter| Some(Shortcut::ctrl_shift(letter));
        match self {
            Self::Undo => ctrl('z'),
            Self::Redo => ctrl_shift('z'),
            Self::Duplicate => ctrl('d'),
            Self::Delete => plain(Key::Delete),
            Self::DeleteCurve => Some(Shortcut {
                modifiers: Modifiers::CTRL,
                key: Key::Delete,
            }),
            Self::SelectAll => ctrl('a'),
            Self::SelectNone => ctrl_shift('a'),
            Self::ToggleVerticesLocked => plain(Key::Character('l')),
            Self::Group => ctrl('g'),
            Self::Ungroup => ctrl_shift('g'),
            Self::Isolate => plain(Key::Character('o')),
            Self::Fit => plain(Key::Character('f')),
            Self::FitAll => plain(Key::Character('h')),
            Self::ZoomIn => plain(Key::Character('+')),
            Self::ZoomOut => plain(Key::Character('-')),
            // F2 renames and F6 focuses panels, as elsewhere.
            Self::View(NamedView::Isometric) => plain(Key::Function(7)),
            Self::View(view) => plain(Key::Function(3 + view as u8)),
            Self::ToggleLayer(layer) => plain(Key::Character(layer.key()?)),
            Self::ToggleSnapping => plain(Key::Character('g')),
            Self::Follow(Follow::InHarmony) => plain(Key::Character('n')),
            Self::Follow(Follow::Softly) => plain(Key::Character('j')),
            Self::ToggleKeeping => plain(Key::Character('k')),
            Self::Tool(tool) => plain(Key::Character(tool.key())),
            _ => None,
        }
    }
}
