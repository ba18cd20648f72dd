//! Doing what the commands say.

use std::sync::Arc;

use crate::document::{Curve, CurveId, Document, Edit, Reference, quoted};
use crate::editor::commands::command::Command;
use crate::editor::commands::locking;
use crate::editor::commands::references::{new_formula, new_reference};
use crate::editor::operating::OperationInProgress;
use crate::editor::polygon_edits::periodicity;
use crate::editor::reply::{Note, Reply};
use crate::editor::selection::{Selection, VertexId};
use crate::editor::view::Look;
use crate::editor::view::layers::Layer;
use crate::editor::workspace::Interruption;
use crate::editor::{Editor, Refusal};
use crate::geometry::counted;

/// The factor by which the zoom commands change the scale.
const ZOOM: f64 = 1.25;

impl Editor {
    /// Execute a command, if it is enabled. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be done; nothing is changed then.
    pub fn execute(&mut self, command: Command) -> Reply {
        if !self.is_enabled(command) {
            return Ok(Note::silent());
        }
        self.message = None;
        let reply = match command {
            Command::Undo => Ok(self.undo()),
            Command::Redo => Ok(self.redo()),
            _ if command.only_shows() => {
                self.show(command);
                return Ok(Note::silent());
            }
            _ => {
                self.interrupt();
                self.execute_idle(command)
            }
        };
        self.tell(reply)
    }

    /// Whether a command can be given now.
    pub fn is_enabled(&self, command: Command) -> bool {
        let curve = self.active_curve();
        let active = self.active().is_some();
        let editable = curve
            .as_ref()
            .is_some_and(|(_, curve)| curve.check_editable().is_ok());
        let can_compare =
            |id: CurveId| self.active() != Some(id) && self.document().name(id).is_some();
        match command {
            Command::Undo => self.undo_label().is_some(),
            Command::Redo => {
                self.workspace.history().redo_label().is_some()
                    && self.hand.tools.used().undo_label().is_none()
                    && self.workspace.preview().is_none()
            }
            Command::Duplicate
            | Command::Delete
            | Command::DeleteCurve
            | Command::ToggleVisible
            | Command::ToggleLocked => active,
            Command::TogglePeriodic => editable,
            Command::Operation(operation) => self.check_operation(operation).is_ok(),
            Command::SelectAll | Command::Fit | Command::FitAll => !self.document().is_empty(),
            Command::SelectNone | Command::ToggleVerticesLocked => !self.hand.selection.is_empty(),
            Command::ConvertUnit(unit) => {
                let before = self.document().unit();
                before.is_some_and(|before| before != unit)
            }
            Command::GoToFeature => self.view.chosen_feature().is_some(),
            Command::Compare(other) => active && other.is_none_or(can_compare),
            // What is dragged is dragged in the plane that is seen.
            Command::View(_) => !self.hand.is_dragging(),
            _ => true,
        }
    }

    /// Whether a switch is on; `None` for commands that are no switches.
    pub fn is_checked(&self, command: Command) -> Option<bool> {
        let curve = self.active_curve().map(|(_, curve)| curve);
        let can_compare =
            |id: CurveId| self.active() != Some(id) && self.document().name(id).is_some();
        match command {
            Command::ToggleLayer(layer) => Some(self.sight().layers().shows(layer)),
            Command::Compare(other) => {
                let compared = self.view.compared().filter(|id| can_compare(*id));
                Some(compared == other)
            }
            Command::ToggleBands => Some(self.view.shows_bands()),
            Command::ToggleSnapping => Some(self.hand.snapping),
            Command::Follow(follow) => Some(self.hand.following.follow == Some(follow)),
            Command::ToggleKeeping => Some(self.hand.keeps),
            Command::Tool(tool) => Some(self.hand.tool() == tool),
            Command::Operation(operation) => {
                let previewed = self.previewed_operation();
                Some(previewed.is_some_and(|it| it.operation() == operation))
            }
            Command::View(view) => Some(self.view.viewport.orientation == view.orientation()),
            Command::SetUnit(unit) => Some(self.document().unit() == unit),
            Command::TogglePeriodic => Some(curve.is_some_and(|c| c.polygon.is_periodic())),
            Command::ToggleVisible => {
                let active = self.active();
                Some(active.is_some_and(|id| self.document().is_visible(id)))
            }
            Command::ToggleLocked => {
                let reference = self.active_reference();
                let locked = reference.map(|(_, reference)| reference.locked);
                Some(locked.or(curve.map(|curve| curve.locked)).unwrap_or(false))
            }
            _ => None,
        }
    }

    /// What a menu calls the command now: undo and redo name their step.
    pub fn label(&self, command: Command) -> String {
        let named = |label: &str| {
            let mut letters = label.chars();
            let first = letters
                .next()
                .map(|letter| letter.to_lowercase().to_string());
            format!(
                "{} {}{}",
                command.label(),
                first.unwrap_or_default(),
                letters.as_str()
            )
        };
        if let (Some(_), Command::Duplicate | Command::DeleteCurve) =
            (self.active_reference(), command)
        {
            return command.label().replace("curve", "reference");
        }
        match command {
            Command::Compare(Some(id)) => self.document().name(id).map(str::to_owned),
            Command::Undo => self.undo_label().map(named),
            Command::Redo => self.workspace.history().redo_label().map(named),
            Command::ToggleVerticesLocked => {
                let label = locking::command_label(&self.hand.selection, self.document());
                Some(label.to_owned())
            }
            _ => None,
        }
        .unwrap_or_else(|| command.label())
    }

    /// The active curve.
    pub fn active_curve(&self) -> Option<(CurveId, Arc<Curve>)> {
        let id = self.hand.selection.active()?;
        Some((id, self.document().curve(id)?.clone()))
    }

    /// The active reference.
    pub fn active_reference(&self) -> Option<(CurveId, Arc<Reference>)> {
        let id = self.hand.selection.active()?;
        Some((id, self.document().reference(id)?.clone()))
    }

    /// What undo would take back: a point of what the tool has not finished comes first.
    fn undo_label(&self) -> Option<&str> {
        let operation = self.operation();
        if operation.is_some_and(OperationInProgress::has_changed_values) {
            return Some("Change of values");
        }
        let point = self.hand.tools.used().undo_label();
        point.or_else(|| self.workspace.history().undo_label())
    }

    /// Take back what a drag shows or what the tool has not finished, otherwise the last step.
    fn undo(&mut self) -> Note {
        let in_field = self.workspace.interruption() == Some(Interruption::Commits);
        let steps = self.workspace.history().undo_steps();
        if self.operating().undo_values() {
            return Note::silent();
        }
        let previewed = self.previewed_operation();
        let cancelled = previewed.map(|it| format!("{}: cancelled", it.operation().label));
        if self.interrupt() {
            return cancelled.map_or_else(Note::silent, Note::told);
        }
        // What a field shows is taken back, and no step before it.
        if in_field && self.workspace.history().undo_steps() == steps {
            return Note::silent();
        }
        if self.hand.tools.used().undo_label().is_some() {
            self.hand.tools.used_mut().undo();
            return Note::silent();
        }
        let before: Vec<CurveId> = self.document().all_ids().collect();
        let undone = self.workspace.undo();
        self.activate_returned(&before);
        undone.map_or_else(Note::silent, |label| Note::told(format!("Undone: {label}")))
    }

    fn redo(&mut self) -> Note {
        self.interrupt();
        let before: Vec<CurveId> = self.document().all_ids().collect();
        let redone = self.workspace.redo();
        self.activate_returned(&before);
        redone.map_or_else(Note::silent, |label| Note::told(format!("Redone: {label}")))
    }

    /// Make the first curve active that was not there before: the one that was waited for.
    fn activate_returned(&mut self, before: &[CurveId]) {
        self.document_changed();
        let returned = self.document().all_ids().find(|id| !before.contains(id));
        if let Some(returned) = returned {
            self.activate(returned);
        }
    }

    /// Do what changes nothing but how things are shown.
    fn show(&mut self, command: Command) {
        let viewport = &mut self.view.viewport;
        let middle = 0.5 * viewport.size;
        match command {
            Command::ZoomIn => viewport.zoom(middle, ZOOM),
            Command::ZoomOut => viewport.zoom(middle, 1.0 / ZOOM),
            Command::Fit => self.look(Look::Selection),
            Command::FitAll => self.look(Look::All),
            Command::View(view) => self.look(Look::From(view.orientation())),
            Command::ResetComb => self.look(Look::ResetComb),
            Command::GoToFeature => {
                if let Some(u) = self.view.chosen_feature() {
                    self.look(Look::Around(u));
                }
            }
            Command::Compare(other) => self.view.compare(other),
            Command::ToggleLayer(layer) => {
                let shown = self.sight().layers().shows(layer);
                if matches!(layer, Layer::Float | Layer::Clamped) {
                    self.hand.tools.end_fit.settings.closed = false;
                }
                self.view.layers.set(layer, !shown);
            }
            Command::ToggleBands => self.view.show_bands(!self.view.shows_bands()),
            Command::ToggleSnapping => self.hand.snapping = !self.hand.snapping,
            Command::Follow(follow) => self.hand.following.toggle(follow),
            Command::ToggleKeeping => self.hand.keeps = !self.hand.keeps,
            _ => {}
        }
    }

    fn execute_idle(&mut self, command: Command) -> Reply {
        match command {
            Command::Delete => return self.delete("Delete", "deleted"),
            Command::ToggleVerticesLocked => {
                let selection = &self.hand.selection;
                let count = counted(selection.vertices().len(), "vertex", "vertices");
                let (edits, locked) = locking::edits(selection, self.document());
                self.apply(locking::label(locked), edits)?;
                let done = if locked { "locked" } else { "unlocked" };
                return Ok(Note::done(format!("{count} {done}")));
            }
            Command::SelectAll => {
                select_all(&mut self.hand.selection, self.workspace.document())?;
            }
            Command::SelectNone => self.hand.selection.clear(),
            Command::Tool(tool) => self.use_tool(tool),
            Command::Operation(operation) => return self.preview_operation(operation),
            Command::AddReference(kind) => {
                return self.add_reference(kind.label, new_reference(kind));
            }
            Command::AddFormula => return self.add_reference("Formula", new_formula()),
            Command::SetUnit(unit) => return self.set_unit(unit),
            Command::ConvertUnit(unit) => return self.convert_unit(unit),
            _ => {
                if let Some((id, reference)) = self.active_reference() {
                    return self.execute_on_reference(command, id, &reference);
                }
                let Some((id, curve)) = self.active_curve() else {
                    return Err(Refusal::from("There is no curve"));
                };
                return self.execute_on(command, id, &curve);
            }
        }
        Ok(Note::silent())
    }

    /// Do what is done to the active curve.
    fn execute_on(&mut self, command: Command, id: CurveId, curve: &Arc<Curve>) -> Reply {
        match command {
            Command::Duplicate => self.add_copies(
                "Duplicate curve",
                vec![Curve::clone(curve)],
                Vec::new(),
                Vec::new(),
            ),
            Command::DeleteCurve => {
                curve.check_unlocked()?;
                self.delete_whole(id, &curve.name)
            }
            Command::TogglePeriodic => {
                let periodic = !curve.polygon.is_periodic();
                let label = if periodic {
                    "Make periodic"
                } else {
                    "Open curve"
                };
                match periodicity(id, curve, periodic) {
                    Ok(edit) => self.apply(label, vec![edit]),
                    Err(error) => Err(Refusal(format!("{}: {error}", quoted(&curve.name)))),
                }
            }
            Command::ToggleVisible => self.change(Edit::SetVisible {
                curve: id,
                visible: !curve.visible,
            }),
            Command::ToggleLocked => self.change(Edit::SetLocked {
                curve: id,
                locked: !curve.locked,
            }),
            _ => Ok(Note::silent()),
        }
    }

    /// Do what is done to the active reference.
    fn execute_on_reference(
        &mut self,
        command: Command,
        id: CurveId,
        reference: &Arc<Reference>,
    ) -> Reply {
        match command {
            Command::Duplicate => {
                let copy = vec![Reference::clone(reference)];
                self.add_copies("Duplicate reference", Vec::new(), copy, Vec::new())
            }
            Command::DeleteCurve => {
                reference.check_unlocked()?;
                self.delete_whole(id, &reference.name)
            }
            Command::ToggleVisible => self.change(Edit::SetVisible {
                curve: id,
                visible: !reference.visible,
            }),
            Command::ToggleLocked => self.change(Edit::SetLocked {
                curve: id,
                locked: !reference.locked,
            }),
            _ => Ok(Note::silent()),
        }
    }

    /// Make one edit as a step that is named after it. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be made.
    pub fn change(&mut self, edit: Edit) -> Reply {
        let label = step_label(&edit, self.document());
        self.apply(&label, vec![edit])
    }
}

/// Name the step that an edit of a curve or reference makes.
fn step_label(edit: &Edit, document: &Document) -> String {
    let of = |verb: &str, id: CurveId| format!("{verb} {}", noun(document, id));
    match edit {
        Edit::SetVisible { curve, visible } => of(if *visible { "Show" } else { "Hide" }, *curve),
        Edit::SetLocked { curve, locked } => of(if *locked { "Lock" } else { "Unlock" }, *curve),
        Edit::Rename { curve, .. } => of("Rename", *curve),
        Edit::Recolour { curve, .. } => of("Recolour", *curve),
        Edit::Remove(curve) => of("Delete", *curve),
        Edit::SetVerticesLocked { locked, .. } => locking::label(*locked).to_owned(),
        _ => "Edit curve".to_owned(),
    }
}

/// The word for a curve or a reference in labels.
fn noun(document: &Document, id: CurveId) -> &'static str {
    match document.reference(id) {
        Some(_) => "reference",
        None => "curve",
    }
}

/// Select all vertices of the active curve; if they are selected, those of all visible curves.
fn select_all(selection: &mut Selection, document: &Document) -> Result<(), Refusal> {
    let active = selection.active();
    if let Some(curve) = active.and_then(|id| document.curve(id)) {
        curve.check_visible()?;
    }
    let visible = document.curves().filter(|(_, curve)| curve.visible);
    let all = visible
        .flat_map(|(id, curve)| (0..curve.polygon.vertices().len()).map(move |index| (id, index)));
    let all: Vec<VertexId> = all.collect();
    let own = all.iter().copied().filter(|(id, _)| Some(*id) == active);
    let own: Vec<VertexId> = own.collect();
    let is_selected = own.iter().all(|vertex| selection.contains(*vertex));
    selection.set(if is_selected { all } else { own });
    Ok(())
}
