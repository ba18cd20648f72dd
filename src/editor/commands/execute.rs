//! Executing commands.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::document::{Curve, CurveId, Document, Edit, Reference};
use crate::editor::commands::arranging::arrange;
use crate::editor::commands::command::Command;
use crate::editor::commands::deleting;
use crate::editor::commands::drawing::end_drawing;
use crate::editor::commands::end_matches;
use crate::editor::commands::items::{self, Change};
use crate::editor::commands::locking;
use crate::editor::commands::references::{addition, new_formula, new_reference};
use crate::editor::hand::end_fit::MATCH_END;
use crate::editor::operating::OperationInProgress;
use crate::editor::reply::{Message, Note, Reply, with_lines};
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
            return match command.need(self) {
                Some(need) => self.tell(Ok(Note::told(need))),
                None => Ok(Note::silent()),
            };
        }
        let shown = self.message.take();
        let reply = match command {
            Command::Undo => Ok(self.undo()),
            Command::Redo if self.hand.tools.used().redo_label().is_some() => {
                self.hand.tools.used_mut().redo();
                return Ok(Note::silent());
            }
            Command::Redo => {
                let lost = self.interrupt().lost;
                let redone = self.step(Workspace::redo);
                let told = |it| Note::told(format!("Redone: {it}"));
                lost.before(Ok(redone.map_or_else(Note::silent, told)))
            }
            _ if command.only_shows() => {
                self.show(command);
                return Ok(Note::silent());
            }
            _ => {
                let lost = self.interrupt().lost;
                let reply = self.execute_idle(command, shown);
                self.operating().tell_first(lost.clone());
                lost.before(reply)
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
        let changed = self.previewed_operation().map(OperationInProgress::changed);
        if self.operating().undo_values() {
            return changed.unwrap_or_else(Note::silent);
        }
        let ended = self.previewed_operation().map(OperationInProgress::ended);
        if self.interrupt().takes_back {
            return ended.unwrap_or_else(Note::silent);
        }
        // The preview of a field is taken back, and no step before it.
        if in_field && self.workspace.history().undo_steps() == steps {
            return Note::silent();
        }
        if self.hand.tools.used().undo_label().is_some() {
            self.hand.tools.used_mut().undo();
            return Note::silent();
        }
        let before = self.operation().and_then(|it| it.selection_before());
        let (before, made) = (before.cloned(), self.hand.selection.items());
        let undone = self.step(Workspace::undo);
        let document = self.workspace.document();
        // What an operation was about is selected again where all that it made is gone.
        if let Some(mut before) = before
            && made.iter().all(|item| document.name(*item).is_none())
        {
            before.retain_valid(document);
            self.hand.selection = before;
        }
        undone.map_or_else(Note::silent, |label| Note::told(format!("Undone: {label}")))
    }

    /// Undo or redo a step, and select the items that it brings back, beside the active one if it changes too: what made
    /// one curve of two had both selected. Returns the step's label.
    fn step(&mut self, take: fn(&mut Workspace) -> Option<String>) -> Option<String> {
        let before = self.document().clone();
        let label = take(&mut self.workspace);
        self.document_changed();
        let document = self.document();
        let ids: BTreeSet<CurveId> = before.all_ids().collect();
        let returned = document.all_ids().filter(|id| !ids.contains(id));
        let returned: Vec<CurveId> = returned.collect();
        let active = self.hand.selection.active();
        let changed = active
            .filter(|id| document.curve(*id).is_some() && document.curve(*id) != before.curve(*id));
        if !returned.is_empty() {
            self.hand
                .selection
                .set_items(changed.into_iter().chain(returned));
            self.operating().leave_stale();
        }
        label
    }

    /// Execute a command that only changes the view.
    fn show(&mut self, command: Command) {
        let viewport = &mut self.view.pane.viewport;
        let middle = 0.5 * viewport.size;
        match command {
            Command::ZoomIn => viewport.zoom(middle, ZOOM),
            Command::ZoomOut => viewport.zoom(middle, 1.0 / ZOOM),
            Command::Fit => self.look(Look::Selection),
            Command::FitAll => self.look(Look::All),
            Command::View(view) => self.look(Look::From(view.orientation())),
            Command::Panes(layout) => self.look(Look::Panes(layout)),
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
            Command::ShowCombs(of) => self.view.combs_of = of,
            Command::ShowCurvature(display) => self.view.curvature_display = display,
            Command::ToggleSnapping => self.hand.snapping = !self.hand.snapping,
            Command::ToggleEdges => self.hand.ignores_edges ^= true,
            Command::ToggleAlignment => self.hand.ignores_lines ^= true,
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

    /// Execute a command once nothing is previewed; `shown` is the message until then.
    fn execute_idle(&mut self, command: Command, shown: Option<Message>) -> Reply {
        match command {
            // It takes back the last point of a drawing.
            Command::Delete if !self.hand.tools.used().drawn().is_empty() => {
                self.hand.tools.used_mut().undo();
            }
            Command::Delete if self.hand.selection.is_empty() => {
                let (selection, document) = (&self.hand.selection, self.workspace.document());
                return match deleting::question(selection, document, shown.as_ref())? {
                    Some(question) => Ok(question),
                    None => self.execute_on_items(Command::DeleteCurve),
                };
            }
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
            Command::Arrange(arrangement) => return arrange(self, arrangement),
            Command::Match(source, level) => {
                let edits = end_matches::edits(self, source, level).unwrap_or_default();
                return self.apply(MATCH_END, edits);
            }
            Command::RemoveGuides => {
                let edits = vec![Edit::SetGuideLines(Vec::new())];
                return self.apply(&command.label(), edits);
            }
            Command::SelectNone => self.hand.selection.set_items([]),
            Command::Tool(tool) => {
                let ended = end_drawing(self);
                self.hand.use_tool(tool);
                return Ok(ended);
            }
            Command::Operation(operation) => {
                end_drawing(self);
                return self.preview_operation(operation);
            }
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
            _ => return self.execute_on_items(command),
        }
        Ok(Note::silent())
    }

    /// Execute a command on the selected curves and references, as one step. What it leaves out is told.
    pub(in crate::editor) fn execute_on_items(&mut self, command: Command) -> Reply {
        let items = self.hand.selection.items();
        let document = self.document();
        let change = match command {
            Command::Duplicate => {
                let label = format!("Duplicate {}", items::noun(document, &items));
                let (curves, references) = items::copies(document, &items);
                return self.add_copies(&label, curves, references, Vec::new());
            }
            Command::DeleteCurve => Change::removal(document, &items)?,
            Command::TogglePeriodic => Change::periodicity(document, &items)?,
            Command::ToggleSymmetric => Change::symmetry(document, &items)?,
            Command::ToggleVisible => Change::visibility(document, &items)?,
            Command::ToggleLocked => Change::lock(document, &items)?,
            Command::Group => Change::grouping(document, &items)?,
            Command::Ungroup => Change::ungrouping(document, &items)?,
            Command::Isolate => Change::isolation(document, &items, &self.hand.isolated)?,
            Command::ShowAll => Change::showing(document)?,
            _ => return Ok(Note::silent()),
        };
        let deleted = match command {
            Command::DeleteCurve => format!("{} deleted\n", items::named(document, &change.taken)),
            _ => String::new(),
        };
        let note = self.apply(&change.label, change.edits)?;
        if command == Command::Isolate {
            self.hand.isolated = change.taken;
        }
        let lines = with_lines(deleted + &note.text, &change.left_out.join("\n"));
        let lines = match &change.warning {
            Some(warning) => with_lines(warning.clone(), &lines),
            None => lines,
        };
        Ok(match lines.is_empty() {
            true => note,
            false => Note {
                warns: change.warning.is_some(),
                ..Note::done(lines)
            },
        })
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
    let of = |verb: &str, id: CurveId| format!("{verb} {}", items::noun(document, &[id]));
    match edit {
        Edit::SetVisible { curve, visible } => of(if *visible { "Show" } else { "Hide" }, *curve),
        Edit::SetLocked { curve, locked } => of(if *locked { "Lock" } else { "Unlock" }, *curve),
        Edit::Rename { curve, .. } => of("Rename", *curve),
        Edit::SetGroup { .. } => "Move to group".to_owned(),
        Edit::RenameGroup { .. } => "Rename group".to_owned(),
        Edit::Recolour { curve, .. } => of("Recolour", *curve),
        Edit::SetVerticesLocked { locked, .. } => locking::label(*locked).to_owned(),
        _ => "Edit curve".to_owned(),
    }
}

/// Select all vertices of the selected curves; if they are selected, those of all visible curves.
fn select_all(selection: &mut Selection, document: &Document) -> Result<(), Refusal> {
    let active = selection.active();
    if let Some(curve) = active.and_then(|id| document.curve(id)) {
        curve.check_visible()?;
    }
    let visible = document.curves().filter(|(_, curve)| curve.visible);
    let all = visible
        .flat_map(|(id, curve)| (0..curve.polygon.vertices().len()).map(move |index| (id, index)));
    let all: Vec<VertexId> = all.collect();
    let items = selection.items();
    let own = all.iter().copied().filter(|(id, _)| items.contains(id));
    let own: Vec<VertexId> = own.collect();
    let is_selected = own.iter().all(|vertex| selection.contains(*vertex));
    selection.set(if is_selected { all } else { own });
    Ok(())
}
