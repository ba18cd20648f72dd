//! The application without a window: commands, tools, gestures, selection, viewport and what the
//! canvas shows, in model coordinates. Nothing in here knows of egui.

mod clipboard;
mod command;
mod deleting;
mod dispatch;
mod drawing;
pub mod end_fit;
mod end_fit_actions;
mod examples;
mod execute;
mod feature_report;
mod files;
mod fitting;
mod gesture;
mod grid;
mod hit;
mod input;
mod layers;
mod orbit;
mod panels;
mod polygon_edits;
mod report;
mod reshaping;
mod scene;
mod selection;
mod snapping;
mod tools;
mod transforming;
mod viewport;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec2;

pub use command::{Command, Shortcut};
pub use end_fit::{EndFitAction, EndFitMarks, EndFitReport};
pub use feature_report::{FeatureKind, FeatureMark, FeatureReport, FeatureRow};
pub use files::with_extension;
pub use grid::grid_steps;
pub use hit::REACH;
pub use input::{Button, Input, Key, Modifiers};
pub use layers::{Layer, Layers};
pub use orbit::NamedView;
pub use report::{AfterDiscard, CurveReport, Export, Message, Readout, Request};
pub use reshaping::{Division, DivisionReport, ExtremaCount, RoundingReport};
pub use scene::{CurveScene, HoverScene, Mark, PlotScene, Scene, VertexMark};
pub use selection::{Selection, VertexId};
pub use tools::{Cursor, ToolKind, Transformation};
pub use viewport::Viewport;

use crate::analysis::{AnalysisCache, CombSettings};
use crate::document::{Curve, CurveId, Document, Edit, History};
use dispatch::Cycle;
use drawing::Ghost;
use end_fit::EndFitState;
use gesture::GestureMachine;
use tools::Tool;

/// Hold the running application: the document with its history, what is selected and shown, the
/// tool in the hand, and the analyses of all curves.
#[derive(Debug)]
pub struct Editor {
    history: History,
    path: Option<PathBuf>,
    analyses: AnalysisCache,
    selection: Selection,
    tool: ToolKind,
    tool_state: Box<dyn Tool>,
    gestures: GestureMachine,
    modifiers: Modifiers,
    /// The axis of the model (0 x, 1 y, 2 z) whose key is held.
    axis: Option<usize>,
    snapping: bool,
    viewport: Viewport,
    /// Whether the canvas has been given its size and the document fitted into it.
    placed: bool,
    layers: Layers,
    comb: CombSettings,
    end_fit: EndFitState,
    message: Option<Message>,
    /// Whether a number field is being dragged.
    field: bool,
    cycle: Cycle,
    hovered: Hovered,
    /// What panels said in the frame before: those that are shown first read it.
    hovered_before: Hovered,
    /// The report of the active curve's features, for the curve that it was made of.
    features: Option<(Arc<Curve>, Arc<FeatureReport>)>,
    scene: Scene,
    plots: PlotScene,
    ghost: Ghost,
}

/// What panels say is hovered there, to be marked on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Hovered {
    length: Option<f64>,
    vertex: Option<usize>,
}

impl Default for Editor {
    fn default() -> Self {
        Self::new()
    }
}

impl Editor {
    /// Begin with the built-in arc.
    pub fn new() -> Self {
        let mut editor = Self::with_document(Document::default());
        editor.open_example(0);
        editor.message = None;
        editor
    }

    /// Begin with a document that counts as saved.
    pub fn with_document(document: Document) -> Self {
        let mut editor = Self {
            history: History::new(document),
            path: None,
            analyses: AnalysisCache::default(),
            selection: Selection::default(),
            tool: ToolKind::default(),
            tool_state: ToolKind::default().take(),
            gestures: GestureMachine::default(),
            modifiers: Modifiers::NONE,
            axis: None,
            snapping: false,
            viewport: Viewport::default(),
            placed: false,
            layers: Layers::default(),
            comb: CombSettings::default(),
            end_fit: EndFitState::default(),
            message: None,
            field: false,
            cycle: Cycle::default(),
            hovered: Hovered::default(),
            features: None,
            hovered_before: Hovered::default(),
            scene: Scene::default(),
            plots: PlotScene::default(),
            ghost: Ghost::default(),
        };
        editor.document_replaced();
        editor
    }

    /// The document, a running gesture's preview included.
    pub fn document(&self) -> &Document {
        self.history.document()
    }

    /// The document's history.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Whether there is something to save.
    pub fn is_modified(&self) -> bool {
        self.history.is_modified()
    }

    /// The file that the document was opened from or saved to.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The curve that panels show.
    pub fn active(&self) -> Option<CurveId> {
        self.selection.active()
    }

    /// Make a curve the active one; vertices of other curves are no longer selected.
    pub fn activate(&mut self, curve: CurveId) {
        if self.selection.active() != Some(curve) {
            let own: Vec<VertexId> = self.selection.of_curve(curve).map(|i| (curve, i)).collect();
            self.selection.set(own);
            self.selection.activate(curve);
            self.end_fit.begin_anew();
        }
    }

    /// What is selected.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The selected vertices of one curve, in rising order.
    pub fn selected_vertices(&self, curve: CurveId) -> Vec<usize> {
        self.selection.of_curve(curve).collect()
    }

    /// Select a vertex, alone or in addition.
    pub fn select_vertex(&mut self, curve: CurveId, vertex: usize, add: bool) {
        if add {
            self.selection.toggle((curve, vertex));
        } else {
            self.selection.set([(curve, vertex)]);
        }
        self.selection.retain_valid(self.history.document());
    }

    /// The tool in the hand.
    pub fn tool(&self) -> ToolKind {
        self.tool
    }

    /// Take a tool into the hand; a gesture that runs is called off.
    pub fn take(&mut self, tool: ToolKind) {
        self.call_off();
        self.tool = tool;
        self.tool_state = tool.take();
        self.end_fit.picking = false;
        self.end_fit.closed = false;
        self.end_fit.ghost = None;
    }

    /// The message to the user, if there is one.
    pub fn message(&self) -> Option<&Message> {
        self.message.as_ref()
    }

    /// Take the message away.
    pub fn dismiss_message(&mut self) {
        self.message = None;
    }

    /// How the model is mapped to the canvas.
    pub fn viewport(&self) -> &Viewport {
        &self.viewport
    }

    /// Tell how large the canvas is, in screen points. The first time everything is fitted into
    /// it; afterwards the middle of the view stays where it is.
    pub fn set_canvas_size(&mut self, size: DVec2) {
        if !(size.min_element() >= 1.0) {
            return;
        }
        self.viewport.size = size;
        if !self.placed {
            self.placed = true;
            self.fit_all();
        }
    }

    /// How the comb is drawn.
    pub fn comb(&self) -> CombSettings {
        self.comb
    }

    /// Draw the comb differently. A scale that is not a positive number is passed over.
    pub fn set_comb(&mut self, comb: CombSettings) {
        if comb.scale > 0.0 && comb.scale.is_finite() {
            self.comb = CombSettings {
                scale: comb.scale,
                density: comb
                    .density
                    .clamp(*CombSettings::DENSITY.start(), *CombSettings::DENSITY.end()),
            };
        }
    }

    /// Which layers are shown now.
    pub fn layers(&self) -> Layers {
        let mut layers = self.layers;
        if self.tool == ToolKind::EndFit && self.end_fit.closed {
            layers.set(Layer::Clamped, true);
            layers.set(Layer::Float, false);
        }
        layers
    }

    /// Which layers the user has chosen, whatever the tool in the hand makes of them.
    pub fn chosen_layers(&self) -> Layers {
        self.layers
    }

    /// Whether points snap.
    pub fn snaps(&self) -> bool {
        self.snapping
    }

    /// Whether a drag is going on.
    pub fn is_dragging(&self) -> bool {
        self.gestures.is_dragging()
    }

    /// Whether the primary button is held on the canvas: a drag goes on, or may begin.
    pub fn is_holding(&self) -> bool {
        self.gestures.is_holding()
    }

    /// Make edits as one step; a drag that goes on is called off. An error becomes the message,
    /// and nothing is changed. Returns whether they were made.
    pub fn apply(&mut self, label: &str, edits: Vec<Edit>) -> bool {
        self.commit_field();
        if self.gestures.is_dragging() {
            self.call_off();
        }
        self.message = None;
        self.make(label, edits, false)
    }

    /// Make edits as one step, or as a part of the last one where a key `repeats`. An error becomes
    /// the message, and nothing is changed. The first curve of a document is brought into view.
    fn make(&mut self, label: &str, edits: Vec<Edit>, repeats: bool) -> bool {
        self.end_fit.begin_anew();
        let was_empty = self.document().is_empty();
        let made = if repeats {
            self.history.extend(label, edits)
        } else {
            self.history.apply(label, edits)
        };
        if let Err(error) = &made {
            self.fail(error.to_string());
        }
        self.document_changed();
        if was_empty && !self.document().is_empty() {
            self.fit_all();
        }
        made.is_ok()
    }

    /// Show what edits would make, as while a number field is dragged: begins a gesture, or
    /// goes on with it.
    pub fn preview_field(&mut self, label: &str, edits: Vec<Edit>) {
        if !self.field {
            self.call_off();
            self.end_fit.begin_anew();
            self.history.begin(label);
            self.field = true;
        }
        if let Err(error) = self.history.preview(edits) {
            self.fail(error.to_string());
        }
        self.document_changed();
    }

    /// End the field's gesture as one step.
    pub fn commit_field(&mut self) {
        if std::mem::take(&mut self.field) {
            self.history.commit();
        }
    }

    /// End the field's gesture and restore.
    pub fn abort_field(&mut self) {
        if std::mem::take(&mut self.field) {
            self.history.abort();
            self.document_changed();
        }
    }

    /// Forget what panels marked, before they are shown anew.
    pub fn hover_nothing(&mut self) {
        self.hovered_before = std::mem::take(&mut self.hovered);
    }

    /// Mark the point at an arc length of the active curve, as while the plot is hovered, until
    /// [`Editor::hover_nothing`].
    pub fn hover_length(&mut self, arc_length: f64) {
        self.hovered.length = Some(arc_length);
    }

    /// Mark a vertex of the active curve, as while its row is hovered, until
    /// [`Editor::hover_nothing`].
    pub fn hover_vertex(&mut self, vertex: usize) {
        self.hovered.vertex = Some(vertex);
    }

    /// Say something.
    fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: text.into(),
            is_error: false,
            offers_undo: false,
        });
    }

    /// Say what the step that was just made came to, with the offer to undo it.
    fn say_done(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: text.into(),
            is_error: false,
            offers_undo: true,
        });
    }

    /// Say that something failed.
    fn fail(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: text.into(),
            is_error: true,
            offers_undo: false,
        });
    }

    /// Call off whatever gesture runs.
    fn call_off(&mut self) {
        self.abort_field();
        if self.gestures.is_dragging() {
            self.deliver(gesture::Gesture::Cancel, false);
        }
        self.gestures.reset();
    }

    /// Put right what depends on the document after it has changed.
    fn document_changed(&mut self) {
        self.selection.retain_valid(self.history.document());
    }

    /// Put right what depends on the document after it was replaced by another.
    fn document_replaced(&mut self) {
        self.selection = Selection::default();
        self.end_fit = EndFitState::default();
        self.document_changed();
        self.tool_state = self.tool.take();
        self.gestures.reset();
        if self.placed {
            if self.document().is_empty() {
                // An empty document has no size: it begins at the usual scale.
                self.viewport.centre = DVec2::ZERO;
                self.viewport.scale = Viewport::default().scale;
            }
            self.fit_all();
        }
    }
}
