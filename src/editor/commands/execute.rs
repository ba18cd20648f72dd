//! Executing commands.

use std::sync::Arc;

use crate::document::{Curve, CurveId, Document, Edit, Reference, quoted};
use crate::editor::commands::command::Command;
use crate::editor::commands::locking;
use crate::editor::commands::references::{addition, new_formula, new_reference};
use crate::editor::polygon_edits::periodicity;
use crate::editor::reply::{Note, Reply, with_lines};
use crate::editor::selection::{Selection, VertexId};
use crate::editor::view::layers::Layer;
use crate::editor::view::{EvoluteCrowd, Look};
use crate::editor::workspace::{Interruption, Workspace};
use crate::editor::{Editor, Refusal};
use crate::geometry::counted;
use crate::geometry::expressions::LengthUnit;

/// The factor by which the zoom commands change the scale.
const ZOOM: f64 = 1.25;

impl Editor {
    /// Execute a command, if it is enabled. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be done; nothing is changed then.
    pub fn execute(&mut self, command: Command) -> Reply {
        if !command.is_enabled(self) {
            return Ok(Note::silent());
        }
        self.message = None;
        let reply = match command {
            Command::Undo => Ok(self.undo()),
            Command::Redo => {
                self.interrupt();
                let redone = self.step(Workspace::redo);
                Ok(redone.map_or_else(Note::silent, |it| Note::told(format!("Redone: {it}"))))
            }
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

    /// Take back a preview or the last point of an unfinished drawing, otherwise the last step.
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
        // The preview of a field is taken back, and no step before it.
        if in_field && self.workspace.history().undo_steps() == steps {
            return Note::silent();
        }
        if self.hand.tools.used().undo_label().is_some() {
            self.hand.tools.used_mut().undo();
            return Note::silent();
        }
        let undone = self.step(Workspace::undo);
        undone.map_or_else(Note::silent, |label| Note::told(format!("Undone: {label}")))
    }

    /// Undo or redo a step, and activate the first item that it brings back. Returns the step's label.
    fn step(&mut self, take: fn(&mut Workspace) -> Option<String>) -> Option<String> {
        let before: Vec<CurveId> = self.document().all_ids().collect();
        let label = take(&mut self.workspace);
        self.document_changed();
        let returned = self.document().all_ids().find(|id| !before.contains(id));
        if let Some(returned) = returned {
            self.activate(returned);
        }
        label
    }

    /// Execute a command that only changes the view.
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
            Command::Compare(other) => {
                if let Some(active) = self.active() {
                    self.view.compare(active, other);
                }
            }
            Command::ToggleLayer(layer) => {
                let shown = self.sight().layers().shows(layer);
                if matches!(layer, Layer::Float | Layer::Clamped) {
                    self.hand.settings.end_fit.closed = false;
                }
                self.view.layers.set(layer, !shown);
                if layer == Layer::Evolute {
                    self.view.evolute = EvoluteCrowd::default();
                }
            }
            Command::ToggleBands => self.view.bands_only_plotted ^= true,
            Command::ShowCurvature(display) => self.view.curvature_display = display,
            Command::ToggleSnapping => self.hand.snapping = !self.hand.snapping,
            Command::Follow(follow) => self.hand.following.toggle(follow),
            Command::ToggleClosedFollow => {
                let following = &mut self.hand.following;
                following.closed_stay = !following.closed_stay;
            }
            Command::ToggleKeepShape => self.hand.settings.vertices_stay ^= true,
            Command::ToggleKeeping => self.hand.keeps = !self.hand.keeps,
            _ => {}
        }
    }

    fn execute_idle(&mut self, command: Command) -> Reply {
        match command {
            Command::Delete => {
                let vertices_stay = self.hand.settings.vertices_stay;
                return self.delete("Delete", "deleted", vertices_stay);
            }
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
            Command::Tool(tool) => self.hand.use_tool(tool),
            Command::Operation(operation) => return self.preview_operation(operation),
            Command::AddReference(_) | Command::AddFormula => {
                let (label, curve) = match command {
                    Command::AddReference(kind) => (kind.label, new_reference(kind)),
                    _ => ("Formula", new_formula()),
                };
                let edit = addition(self.document(), label, curve)?;
                self.add("Add reference", vec![edit])?;
                // The view follows if the reference would not be seen.
                if let Some((id, _)) = self.active_reference() {
                    self.look(Look::New(vec![id]));
                }
            }
            Command::SetUnit(unit) if unit == self.document().unit() => {}
            Command::SetUnit(unit) => {
                self.make("Set document unit", vec![Edit::SetUnit(unit)], false)?;
                let text = match unit.map(LengthUnit::name) {
                    Some(name) => {
                        format!("The document is in {name} now; its numbers stay as they are")
                    }
                    None => "The document has no unit now".to_owned(),
                };
                return Ok(Note::done(text));
            }
            Command::ConvertUnit(unit) => {
                let label = "Convert document unit";
                self.make(label, vec![Edit::ConvertUnit(unit)], false)?;
                self.look(Look::All);
                let name = unit.name();
                return Ok(Note::done(format!(
                    "Converted to {name}: everything keeps its size"
                )));
            }
            _ => {
                let active = self.active().ok_or("There is no curve")?;
                return self.execute_on(command, active);
            }
        }
        Ok(Note::silent())
    }

    /// Execute a command on the active curve or reference.
    fn execute_on(&mut self, command: Command, id: CurveId) -> Reply {
        let curve = self.document().curve(id).cloned();
        let reference = self.document().reference(id).cloned();
        match command {
            Command::Duplicate => {
                let label = format!("Duplicate {}", noun(self.document(), id));
                let curves = curve.iter().map(|curve| Curve::clone(curve)).collect();
                let references = reference.iter().map(|it| Reference::clone(it)).collect();
                self.add_copies(&label, curves, references, Vec::new())
            }
            Command::DeleteCurve => self.change(Edit::Remove(id)),
            Command::TogglePeriodic => {
                let Some(curve) = curve else {
                    return Ok(Note::silent());
                };
                let periodic = !curve.polygon.is_periodic();
                let label = if periodic {
                    "Make periodic"
                } else {
                    "Open curve"
                };
                let edit = periodicity(id, &curve, periodic);
                let edit = edit.map_err(|error| format!("{}: {error}", quoted(&curve.name)))?;
                self.apply(label, vec![edit])
            }
            Command::ToggleVisible => self.change(Edit::SetVisible {
                curve: id,
                visible: !self.document().is_visible(id),
            }),
            Command::ToggleLocked => {
                let is_locked = curve.map(|it| it.locked).or(reference.map(|it| it.locked));
                self.change(Edit::SetLocked {
                    curve: id,
                    locked: !is_locked.unwrap_or(false),
                })
            }
            _ => Ok(Note::silent()),
        }
    }

    /// Make one edit as a step that is named after it. The reply is told. Locked curves are not removed.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be made.
    pub fn change(&mut self, edit: Edit) -> Reply {
        let document = self.document();
        let label = step_label(&edit, document);
        let Edit::Remove(id) = edit else {
            return self.apply(&label, vec![edit]);
        };
        let name = document.name(id).unwrap_or_default();
        let deleted = format!("{} deleted", quoted(name));
        if let Some(curve) = document.curve(id) {
            curve.check_unlocked()?;
        }
        if let Some(reference) = document.reference(id) {
            reference.check_unlocked()?;
        }
        let note = self.apply(&label, vec![edit])?;
        Ok(Note::done(with_lines(deleted, &note.text)))
    }
}

/// Name the step that an edit of a curve or reference makes.
fn step_label(edit: &Edit, document: &Document) -> String {
    let of = |verb: &str, id: CurveId| format!("{verb} {}", noun(document, id));
    match edit {
        Edit::SetVisible { curve, visible } => of(if *visible { "Show" } else { "Hide" }, *curve),
        Edit::SetLocked { curve, locked } => of(if *locked { "Lock" } else { "Unlock" }, *curve),
        Edit::Rename { curve, .. } => of("Rename", *curve),
        Edit::SetGroup { .. } => "Move to group".to_owned(),
        Edit::RenameGroup { .. } => "Rename group".to_owned(),
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
