//! What menus and buttons show of a command now.

use super::command::Command;
use super::end_matches;
use super::items;
use super::locking;
use crate::document::{CurveId, cut};
use crate::editor::Editor;
use crate::editor::operating::OperationInProgress;

impl Command {
    /// Whether the command can be given now.
    pub fn is_enabled(self, editor: &Editor) -> bool {
        let active = editor.active().is_some();
        let (document, items) = (editor.document(), editor.hand.selection.items());
        let can_compare =
            |id: CurveId| editor.active() != Some(id) && editor.document().name(id).is_some();
        match self {
            Command::Undo => undo_label(editor).is_some(),
            Command::Redo => redo_label(editor).is_some() && editor.workspace.preview().is_none(),
            Command::Delete => active || !editor.hand.tools.used().drawn().is_empty(),
            Command::Duplicate
            | Command::DeleteCurve
            | Command::ToggleVisible
            | Command::ToggleLocked
            | Command::Group
            | Command::Isolate => active,
            Command::Ungroup => {
                let mut groups = items.iter().filter_map(|id| document.group(*id));
                groups.any(|group| !group.is_none())
            }
            Command::Arrange(arrangement) => {
                let selection = &editor.hand.selection;
                let count = match selection.is_empty() {
                    true => items.len(),
                    false => selection.vertices().len(),
                };
                count >= arrangement.least()
            }
            Command::TogglePeriodic | Command::ToggleSymmetric => {
                let mut curves = items.iter().filter_map(|id| document.curve(*id));
                curves.any(|curve| curve.check_editable().is_ok())
            }
            Command::Operation(operation) => editor.input_of(operation).is_ok(),
            Command::SelectAll | Command::Fit | Command::FitAll => !editor.document().is_empty(),
            Command::SelectNone => !editor.hand.selection.has_no_item(),
            Command::ToggleVerticesLocked => !editor.hand.selection.is_empty(),
            Command::ConvertUnit(unit) => {
                let before = editor.document().unit();
                before.is_some_and(|before| before != unit)
            }
            Command::Match(source, level) => end_matches::edits(editor, source, level).is_some(),
            Command::RemoveGuides => !editor.document().guide_lines().is_empty(),
            Command::ShowAll => document.all_ids().any(|id| !document.is_visible(id)),
            Command::GoToFeature => editor.view.chosen_feature().is_some(),
            Command::Compare(other) => active && other.is_none_or(can_compare),
            // A drag moves vertices in the plane of this view.
            Command::View(_) | Command::Panes(_) => !editor.hand.is_dragging(),
            _ => true,
        }
    }

    /// Say what a command that cannot be given now needs, where the user can do something about it.
    pub fn need(self, editor: &Editor) -> Option<String> {
        let is_busy = editor.hand.is_holding() || editor.workspace.preview().is_some();
        if is_busy || self.is_enabled(editor) {
            return None;
        }
        let need = match self {
            Command::Undo => "nothing to undo".to_owned(),
            Command::Redo => "nothing to redo".to_owned(),
            Command::Delete
            | Command::Duplicate
            | Command::DeleteCurve
            | Command::ToggleVisible
            | Command::ToggleLocked
            | Command::Group
            | Command::Isolate => "select a curve first".to_owned(),
            Command::Ungroup => "select curves of a group first".to_owned(),
            Command::ToggleVerticesLocked => "select vertices first".to_owned(),
            Command::Arrange(arrangement) => {
                format!("select {} curves or vertices first", arrangement.least())
            }
            Command::TogglePeriodic | Command::ToggleSymmetric => {
                "select a curve that is not locked".to_owned()
            }
            Command::Operation(operation) => editor.input_of(operation).err()?.to_string(),
            Command::RemoveGuides => "there are none; drag one from a ruler".to_owned(),
            Command::ShowAll => "nothing is hidden".to_owned(),
            Command::GoToFeature => "choose a feature in its list first".to_owned(),
            _ => return None,
        };
        Some(format!("{}: {need}", self.label().trim_end_matches('…')))
    }

    /// Whether the switch is on; `None` for a command that is no switch.
    pub fn is_checked(self, editor: &Editor) -> Option<bool> {
        let (document, items) = (editor.document(), editor.hand.selection.items());
        let can_compare =
            |id: CurveId| editor.active() != Some(id) && editor.document().name(id).is_some();
        match self {
            Command::ToggleLayer(layer) => Some(editor.sight().layers().shows(layer)),
            Command::Compare(other) => {
                let compared = editor.sight().compared().filter(|id| can_compare(*id));
                Some(compared == other)
            }
            Command::Match(source, level) => {
                Some(end_matches::level(editor, source) == Some(level))
            }
            Command::ToggleBands => Some(!editor.view.bands_only_plotted),
            Command::ShowCombs(of) => Some(editor.view.combs_of == of),
            Command::ShowCurvature(display) => Some(editor.view.curvature_display == display),
            Command::ToggleSnapping => Some(editor.hand.snapping),
            Command::ToggleEdges => Some(!editor.hand.ignores_edges),
            Command::ToggleAlignment => Some(!editor.hand.ignores_lines),
            Command::Follow(follow) => Some(editor.hand.following.follow == Some(follow)),
            Command::ToggleClosedFollow => Some(!editor.hand.following.closed_stay),
            Command::ToggleKeepShape => Some(!editor.hand.settings.vertices_stay),
            Command::ToggleKeeping => Some(editor.hand.keeps),
            Command::Tool(tool) => Some(editor.hand.tool() == tool),
            Command::Operation(operation) => {
                let previewed = editor.previewed_operation();
                Some(previewed.is_some_and(|it| it.operation() == operation))
            }
            Command::View(view) => {
                Some(editor.view.pane.viewport.orientation == view.orientation())
            }
            Command::Panes(layout) => Some(editor.view.pane_layout() == layout),
            Command::SetUnit(unit) => Some(editor.document().unit() == unit),
            Command::TogglePeriodic => Some(items::are_periodic(document, &items)),
            Command::ToggleSymmetric => Some(items::are_symmetric(document, &items)),
            Command::ToggleVisible => {
                Some(!items.is_empty() && items::are_visible(document, &items))
            }
            Command::Isolate => {
                Some(!items::hidden_still(document, &editor.hand.isolated).is_empty())
            }
            Command::ToggleLocked => Some(!items.is_empty() && items::are_locked(document, &items)),
            _ => None,
        }
    }

    /// The label in menus now: undo and redo name their step.
    pub fn label_now(self, editor: &Editor) -> String {
        let named = |label: &str| {
            let mut letters = label.chars();
            let first = letters
                .next()
                .map(|letter| letter.to_lowercase().to_string());
            format!(
                "{} {}{}",
                self.label(),
                first.unwrap_or_default(),
                letters.as_str()
            )
        };
        if let Command::Duplicate | Command::DeleteCurve = self {
            let items = editor.hand.selection.items();
            if !items.is_empty() {
                let noun = items::noun(editor.document(), &items);
                return self.label().replace("curve", &noun);
            }
        }
        match self {
            Command::Compare(Some(id)) => editor.document().name(id).map(str::to_owned),
            Command::Match(source, level) => {
                let name = editor.document().name(source);
                name.map(|name| format!("Match to {}, {}", cut(name), level.name()))
            }
            Command::Undo => undo_label(editor).map(named),
            Command::Redo => redo_label(editor).map(named),
            Command::ToggleVerticesLocked => {
                let label = locking::command_label(&editor.hand.selection, editor.document());
                Some(label.to_owned())
            }
            _ => None,
        }
        .unwrap_or_else(|| self.label())
    }
}

/// The label of the step that undo takes back: a point of an unfinished drawing comes first.
fn undo_label(editor: &Editor) -> Option<&str> {
    let operation = editor.operation();
    if operation.is_some_and(OperationInProgress::has_changed_values) {
        return Some("Change of values");
    }
    let point = editor.hand.tools.used().undo_label();
    point.or_else(|| editor.workspace.history().undo_label())
}

/// The label of the step that redo makes again: a point of an unfinished drawing, or a step of the document while
/// nothing is drawn.
fn redo_label(editor: &Editor) -> Option<&str> {
    let tool = editor.hand.tools.used();
    let of_document = || editor.workspace.history().redo_label();
    match tool.undo_label() {
        None => tool.redo_label().or_else(of_document),
        Some(_) => tool.redo_label(),
    }
}
