//! The application without a window, in three parts: the workspace (what is worked on), the view
//! (how it is seen) and the hand (what works on it). Nothing in here knows of egui.

mod commands;
mod dispatch;
mod hand;
mod jobs;
mod operating;
mod polygon_edits;
mod reply;
mod report;
mod same_shape;
mod selection;
mod sharper;
mod view;
mod workspace;

use std::time::Duration;

pub use commands::drawing::end_drawing;
pub use commands::{
    Command, CopyForm, PICTURE_PLANES, Pasted, PictureChange, ReferenceChange, Shortcut,
    measured_direction, met_curves, picture_plane,
};
pub use dispatch::MenuOf;
pub use hand::{
    Arrangement, Button, Cursor, DrawSettings, DrawWay, EndFitAction, EndFitReport, EndNoise,
    Entry, EntryError, Follow, Following, Hand, Input, Key, Leg, LegLocks, MATCH_END, MatchReport,
    MenuRequest, MenuSubject, Modifiers, ToolKind, ToolRow, Transformation,
};
pub use jobs::edited_file::EditedFile;
pub use jobs::exporting::ExportForecast;
pub use jobs::file_reading::{ColumnQuestion, FileAnswer, FoundFile, ImportQuestion};
pub use jobs::filing::{FileReply, Filing, is_project};
pub use jobs::pyramid::{PictureLevel, PictureTile, Pyramid, TILE};
pub use jobs::{Autosaver, FileWork, Recoverable, RecoverableDocument, Recovery, with_extension};
pub use operating::{FittedPoints, Operating, OperationInProgress, OtherResult, Run};
pub use reply::{Interrupted, Message, Note, Refusal, Reply, told};
pub use report::{CurveReport, Readout, ReferenceReport};
pub use selection::{Selection, VertexId};
pub use view::{
    Bounds, ChainOutlines, ClampedMark, CombSettings, CombsOf, CurvatureDisplay, CurveOutlines,
    CurveScene, DragReadout, EndFitMarks, EvoluteCrowd, FeatureKind, FeatureMark, FeatureReport,
    FeatureRow, GAP, GroundGrid, GuideLabel, GuideScene, HoverScene, Layer, LayerRow, LayerSample,
    Layers, Legs, Look, LossArrow, Mark, MeasuredFigure, NamedView, Orientation, PaneLayout,
    PaneView, PictureScene, PieceTrend, PlotBand, PlotKind, PlotScene, REACH, RULER, Scene, Sight,
    VertexMark, View, ViewBox, Viewport, Whiskers, grid_steps, ground_grid, view_name,
};
pub use workspace::{Interruption, PreviewId, Workspace};

use crate::document::{CurveId, Document, Edit, quoted};
use crate::io::examples::{EXAMPLES, FIRST};
use crate::operations::{followers, matched, newly_matched, told_of_bent};
use hand::gesture::Gesture;
use hand::snap_name::snap_name;
use jobs::Client;
use jobs::foreseeing::Foreseeing;
use jobs::patience::Patience;
use operating::Operations;
use reply::with_lines;
use view::overlay::Overlay;

/// Hold the running application: what is worked on, how it is seen, and what works on it.
#[derive(Debug, Default)]
pub struct Editor {
    workspace: Workspace,
    view: View,
    hand: Hand,
    operations: Operations,
    patience: Patience,
    foreseeing: Foreseeing,
    recovery: Recovery,
    filing: Filing,
    message: Option<Message>,
}

impl Editor {
    /// Begin with an example curve and its comb.
    pub fn new() -> Self {
        let mut editor = Self::default();
        editor.view.layers.set(Layer::Comb, true);
        let first = EXAMPLES.iter().position(|example| example.name == FIRST);
        told(editor.open_example(first.unwrap_or(0)));
        editor.message = None;
        editor
    }

    /// Begin with a document that counts as saved.
    pub fn with_document(document: Document) -> Self {
        let mut editor = Self::default();
        editor.replace(document, None);
        editor
    }

    /// Do slow work on threads of their own from now on. A frame waits for all of it together no
    /// longer than `patience`; `wake` is called there when something is new to show later.
    pub fn run_in_background(
        &mut self,
        patience: Duration,
        wake: impl Fn() + Clone + Send + 'static,
    ) {
        self.patience = Patience::new(patience);
        self.hand.keeping.hurry();
        self.view.run_in_background(wake.clone());
        self.foreseeing = Client::background("foresight", wake.clone());
        self.recovery.autosaving.run_in_background(wake.clone());
        self.filing.run_in_background(wake.clone());
        self.operations = Operations::background(wake);
    }

    /// Begin a frame: take the results of background work.
    pub fn begin_frame(&mut self) {
        self.patience.renew();
        self.operating().receive();
        self.receive_files();
        let selection = &self.hand.selection;
        let patience = &mut self.patience;
        self.filing.forecast(&self.workspace, selection, patience);
    }

    /// The workspace: the document, its history and its file.
    pub fn workspace(&self) -> &Workspace {
        &self.workspace
    }

    /// How it is seen.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// How it is seen, to be changed.
    pub fn view_mut(&mut self) -> &mut View {
        &mut self.view
    }

    /// The view of the document, for panels to read.
    pub fn sight(&self) -> Sight<'_> {
        let layers = self.hand.layers(self.view.layers);
        self.view.sight(self.hand.shown(&self.workspace, layers))
    }

    /// Change how the model is seen.
    pub fn look(&mut self, look: Look) {
        let layers = self.hand.layers(self.view.layers);
        let before = self.view.pane.viewport.orientation;
        self.view
            .look(look, self.hand.shown(&self.workspace, layers));
        if self.view.pane.viewport.orientation != before {
            self.hand.forget_pivot();
        }
    }

    /// Bring up to date all that is derived from the document and how it is seen: analyses, features, harmony,
    /// distances, guides, the scene and what is hovered, and the plot that is shown. Panels read after this.
    pub fn refresh(&mut self) {
        let layers = self.hand.layers(self.view.layers);
        let shown = self.hand.shown(&self.workspace, layers);
        self.view.update(shown, &mut self.patience);
        let mut overlay = self.overlay();
        let shown = self.hand.shown(&self.workspace, layers);
        self.view.guide(shown, &overlay);
        let operation = self.operations.current(&self.workspace, shown.active());
        self.view.each_other_pane(|view| {
            view.outline();
            let viewport = &view.pane.viewport;
            let points = operation.map(|it| it.point_marks(viewport, &view.whiskers, None));
            let previewed = operation.filter(|it| !it.is_applied());
            let marks = previewed.map(|it| it.marks(viewport));
            let marks = points.into_iter().chain(marks).flatten().collect();
            view.draw(shown, &mut overlay.elsewhere(marks));
        });
        self.view.draw(shown, &mut overlay);
        self.view.draw_plot(shown, &overlay);
    }

    /// The marks of the tool and of the operation in progress.
    fn overlay(&self) -> Overlay {
        let (context, tool) = (self.context(), self.hand.tool());
        let mut marks = self.hand.tools.used().marks(&context);
        // That of a picture is in the way of tools that trace it.
        let traces = !matches!(self.hand.tool(), ToolKind::Select | ToolKind::Measure);
        let measurement = self.hand.settings.measurement.as_ref();
        let measurement = measurement.filter(|it| !traces || it.picture().is_none());
        if let Some(measurement) = measurement {
            marks.extend(measurement.marks(context.hits));
        }
        let (active, operation) = (self.active(), self.operation());
        let (viewport, pointer) = (&self.view.pane.viewport, self.hand.gestures.pointer());
        let previewed = self.previewed_operation();
        match previewed {
            Some(previewed) => {
                marks.extend(previewed.marks(viewport));
                marks.extend(previewed.handle_marks(viewport, pointer));
            }
            None => marks.extend(snap_name(tool, &context)),
        }
        let point = operation.and_then(|it| it.point_under_pointer(tool, &context));
        if let Some(operation) = operation {
            marks.extend(operation.point_marks(viewport, &self.view.whiskers, point));
        }
        let point_hover =
            || operation.and_then(|operation| operation.point_hover(viewport, point?));
        let is_made = |it: &&OperationInProgress| {
            active.is_some_and(|id| it.made_curves(self.document()).contains(&id))
        };
        let given = operation.filter(|it| !it.is_applied() || is_made(it));
        let given = given.and_then(|it| it.values().given_reference());
        let run = operation.and_then(OperationInProgress::finished);
        let alters = active.filter(|_| tool != ToolKind::Draw);
        let before = || match self.hand.modifiers.alt && self.workspace.preview().is_some() {
            true => context.hits.shown.settled_active().cloned(),
            // A correction of ends is shown against the curve before it.
            false => operation
                .filter(|it| !it.is_applied() || tool == ToolKind::EndFit)
                .and_then(|it| it.before(active)),
        };
        Overlay {
            marks,
            handle: previewed
                .and_then(|it| it.handle_hover(viewport, pointer))
                .or_else(point_hover),
            measures_points: operation.is_some_and(|it| it.fitted_points().is_some()),
            hovering: self.hand.hovering(context.hits.shown),
            guides: tool == ToolKind::Select,
            fitted_end: (tool == ToolKind::EndFit).then_some(self.hand.settings.end_fit.end),
            before: before(),
            others_before: previewed
                .map_or_else(Vec::new, |it| it.others_before(active, self.document())),
            unreached: previewed.map_or_else(Vec::new, |it| it.unreached(self.document())),
            proposal: match previewed {
                Some(_) => None,
                None => self
                    .hand
                    .proposal(&context)
                    .map(|polygon| (polygon, alters)),
            },
            given: given.map(|curve| self.view.given_reference(curve)),
            joint: run.and_then(|run| run.outcome.joint),
            atlas: run.and_then(|run| Some(run.outcome.atlas.as_ref()?.plane)),
        }
    }

    /// What works on it: the tool, the selection, and which keys are held.
    pub fn hand(&self) -> &Hand {
        &self.hand
    }

    /// The hand, to set its tools.
    pub fn hand_mut(&mut self) -> &mut Hand {
        &mut self.hand
    }

    /// The document with the preview.
    pub fn document(&self) -> &Document {
        self.workspace.document()
    }

    /// The curve or the reference that panels show.
    pub fn active(&self) -> Option<CurveId> {
        self.hand.selection.active()
    }

    /// Select a curve or a reference alone and make it the active one; its selected vertices stay selected.
    pub fn activate(&mut self, item: CurveId) {
        self.hand.selection.activate(item);
        self.operating().leave_stale();
    }

    /// Select a vertex, alone or in addition.
    pub fn select_vertex(&mut self, curve: CurveId, vertex: usize, add: bool) {
        if add {
            self.hand.selection.toggle((curve, vertex));
        } else {
            self.hand.selection.set([(curve, vertex)]);
        }
        self.document_changed();
        self.operating().leave_stale();
    }

    /// The message to the user, if there is one.
    pub fn message(&self) -> Option<&Message> {
        self.message.as_ref()
    }

    /// Take the message away.
    pub fn dismiss_message(&mut self) {
        self.message = None;
    }

    /// Make edits as one step. Ends a preview. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if they cannot be made, or move vertices so that a feature is added while features are
    /// kept; nothing is changed then.
    pub fn apply(&mut self, label: &str, edits: Vec<Edit>) -> Reply {
        let lost = self.interrupt().lost;
        let kept = self
            .hand
            .check_kept(&edits, &self.workspace, &self.view.analyses);
        let reply = kept.and_then(|()| self.make(label, edits, false));
        self.tell(lost.before(reply))
    }

    /// Make edits as one step, or as a part of the last one where a key `repeats`; tells which
    /// matches that dissolves. The first curve of a document is brought into view, unless it is there.
    fn make(&mut self, label: &str, edits: Vec<Edit>, repeats: bool) -> Reply {
        let was_empty = self.document().is_empty();
        let before = self.workspace.settled().clone();
        let newly = newly_matched(&edits);
        let made = if repeats {
            self.workspace.extend(label, edits)
        } else {
            self.workspace.apply(label, edits)
        };
        self.document_changed();
        if was_empty && !self.document().is_empty() {
            self.look(Look::New(self.document().all_ids().collect()));
            self.look(Look::ResetComb);
        }
        made?;
        let documents = [&before, self.document()];
        let (moves, bends) = matched(&newly, documents);
        let follow = told_of_bent(&followers(documents, &newly));
        let warns = bends || !follow.is_empty();
        let told = with_lines(
            with_lines(moves, &follow),
            &dissolved(self.document(), &before),
        );
        Ok(match (newly.is_empty(), warns) {
            (_, true) => Note::done(told).warning(),
            (false, false) => Note::done(told),
            (true, false) => Note::told(told),
        })
    }

    /// Change the document without a step and with nothing to save, unless it was edited since it was opened.
    /// Returns whether it did.
    pub fn amend_opened(&mut self, edits: &[Edit]) -> bool {
        let Ok(document) = self.document().edited(edits.to_vec()) else {
            return false;
        };
        let amends = self.workspace.is_as_opened();
        if amends {
            self.workspace.replace(document, None);
            self.document_changed();
        }
        amends
    }

    /// Show what edits would make, as while a number field is dragged: begins a preview, or goes
    /// on with it. Once something else is begun it is kept.
    pub fn preview(&mut self, label: &str, edits: Vec<Edit>) {
        if self.workspace.interruption() != Some(Interruption::Commits) {
            self.interrupt();
            self.hand.keeping.end();
            self.workspace.begin(label, Interruption::Commits);
        }
        let edits = self.hand.kept(edits, &self.workspace, &self.view.analyses);
        let refusal = self.workspace.update(edits).err().map(Refusal::from);
        Message::tell_update(&mut self.message, refusal);
        self.document_changed();
        let held_back = self.hand.keeping.held_back();
        if let Some(reason) = held_back.filter(|_| self.hand.keeps_features()) {
            let held = format!("Held at the last place proved to add nothing; {reason}");
            Message::tell_update(&mut self.message, Some(Refusal(held)));
        }
    }

    /// Keep the preview of a number field as one step.
    pub fn commit_preview(&mut self) {
        if self.workspace.interruption() == Some(Interruption::Commits) {
            let before = self.workspace.settled().clone();
            self.hand
                .commit_kept(&mut self.workspace, &self.view.analyses);
            let follow = told_of_bent(&followers([&before, self.workspace.document()], &[]));
            if !follow.is_empty() {
                self.message = Message::of(&Ok(Note::done(follow).warning()));
            }
        }
    }

    /// Take back the preview of a number field.
    pub fn abort_preview(&mut self) {
        if self.workspace.interruption() == Some(Interruption::Commits) {
            self.workspace.abort();
            Message::tell_update(&mut self.message, None);
            self.document_changed();
        }
    }

    /// Show the message that tells of a reply.
    fn tell(&mut self, reply: Reply) -> Reply {
        self.message = Message::of(&reply);
        reply
    }

    /// End the preview because something else begins: the value of a number field is kept, a drag or an operation
    /// is taken back.
    pub fn interrupt(&mut self) -> Interrupted {
        let drags = self.hand.is_dragging();
        if drags {
            self.deliver(Gesture::Cancel, false);
        }
        self.hand.gestures.reset();
        if let Some(previewed) = self.previewed_operation() {
            let ended = previewed.ended();
            let waits = previewed.is_waiting_to_apply();
            self.operating().interrupt();
            self.message = Message::of(&Ok(ended.clone()));
            return Interrupted {
                takes_back: true,
                lost: if waits { ended } else { Note::silent() },
            };
        }
        let ended = self.workspace.interrupt();
        self.document_changed();
        Interrupted {
            takes_back: drags || ended == Some(Interruption::Aborts),
            lost: Note::silent(),
        }
    }

    /// Put right what depends on the document after it has changed. What is selected is selected of
    /// the document that is shown.
    fn document_changed(&mut self) {
        self.hand.selection.retain_valid(self.workspace.document());
    }
}

/// Name the matches that are gone since an earlier state because their places are, and the curves that are no longer
/// symmetric, a line each.
fn dissolved(document: &Document, before: &Document) -> String {
    let lines = document.dissolved_since(before).map(|(matched, curve)| {
        let (end, name) = (matched.end.name(), quoted(&curve.name));
        format!("The {end} of {name} is no longer matched: what it followed is gone")
    });
    let asymmetric = document.asymmetric_since(before);
    let asymmetric = asymmetric.map(|it| format!("{} does not stay symmetric", quoted(&it.name)));
    lines.chain(asymmetric).collect::<Vec<String>>().join("\n")
}
