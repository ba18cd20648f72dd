//! The state of the hand.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::document::{CurveId, Document};
use crate::editor::hand::cycle::Cycle;
use crate::editor::hand::following::{Followers, Following};
use crate::editor::hand::gesture::GestureMachine;
use crate::editor::hand::input::Modifiers;
use crate::editor::hand::keeping::Keeping;
use crate::editor::hand::menu_request::MenuRequest;
use crate::editor::hand::tools::{Context, ToolKind, ToolSettings, Tools};
use crate::editor::hand::typed_point::TypedPoint;
use crate::editor::selection::Selection;
use crate::editor::view::View;
use crate::editor::view::layers::{Layer, Layers};
use crate::editor::view::overlay::{Closed, Hovering};
use crate::editor::view::shown::Shown;
use crate::editor::workspace::Workspace;

/// The movement of the selection by an arrow key until the user sets another, in units of the model.
const NUDGE_STEP: f64 = 0.1;

/// Hold the tool, its gesture, the selection, and which keys are held.
#[derive(Debug, Default)]
pub struct Hand {
    pub(in crate::editor) selection: Selection,
    pub(in crate::editor) tools: Tools,
    pub(in crate::editor) settings: ToolSettings,
    pub(in crate::editor) gestures: GestureMachine,
    pub(in crate::editor) modifiers: Modifiers,
    /// The axis of the model (0 x, 1 y, 2 z) whose key is held.
    pub(in crate::editor) axis: Option<usize>,
    pub(in crate::editor) snapping: bool,
    /// Whether alignment lines are left out of what attracts.
    pub(in crate::editor) ignores_lines: bool,
    pub(in crate::editor) ignores_edges: bool,
    /// The movement of the selection by an arrow key that the user set.
    nudge_step: Option<f64>,
    pub(in crate::editor) cycle: Cycle,
    pub(in crate::editor) following: Following,
    /// Whether features are kept while dragging.
    pub(in crate::editor) keeps: bool,
    /// Whether the key that inverts `keeps` is held.
    pub(in crate::editor) keeping_held: bool,
    pub(in crate::editor) keeping: Keeping,
    /// The point that is being typed, as far as the text is one.
    pub(in crate::editor) typed: Option<TypedPoint>,
    /// What the last isolation has hidden.
    pub(in crate::editor) isolated: Vec<CurveId>,
    /// The requested menu.
    pub(in crate::editor) menu: Option<MenuRequest>,
}

impl Hand {
    /// The steps that arrow keys can have.
    pub const NUDGE_STEPS: RangeInclusive<f64> = 1e-12..=1e12;

    /// The two measured points of a picture, if they are apart.
    pub fn measured_on(&self, picture: CurveId, document: &Document) -> Option<[DVec3; 2]> {
        let measurement = self.settings.measurement.as_ref();
        let measurement = measurement.filter(|it| it.picture() == Some(picture))?;
        Some(measurement.ends(document)).filter(|[from, to]| from != to)
    }

    /// Forget the selection and the settings of a document; the tool stays in use, and the way of drawing.
    pub(in crate::editor) fn begin_document(&mut self) {
        self.selection = Selection::default();
        self.isolated.clear();
        let (way, vertices_stay) = (self.settings.draw.way, self.settings.vertices_stay);
        self.settings = ToolSettings::default();
        self.settings.draw.way = way;
        self.settings.vertices_stay = vertices_stay;
        self.use_tool(self.tool());
        self.gestures.reset();
    }

    /// Let an arrow key move the selection by a step, at any zoom; other numbers change nothing.
    pub fn set_nudge_step(&mut self, step: f64) {
        if Self::NUDGE_STEPS.contains(&step) {
            self.nudge_step = Some(step);
        }
    }

    /// Let the view show the workspace with these layers, as the hand works on it.
    pub(in crate::editor) fn shown<'a>(
        &'a self,
        workspace: &'a Workspace,
        layers: Layers,
    ) -> Shown<'a> {
        Shown {
            workspace,
            selection: &self.selection,
            layers,
            pointer: self.gestures.pointer(),
            is_dragging: self.gestures.is_dragging(),
            is_holding: self.gestures.is_holding(),
            cycle: self.cycle.count(),
        }
    }

    /// Let tools see the parts of the editor, with the layers that are shown.
    pub(in crate::editor) fn context<'a>(
        &'a self,
        workspace: &'a Workspace,
        view: &'a View,
        layers: Layers,
    ) -> Context<'a> {
        let pointer = self.gestures.pointer();
        Context {
            document: workspace.document(),
            before: workspace.settled(),
            selection: &self.selection,
            viewport: &view.pane.viewport,
            hits: view.sight(self.shown(workspace, layers)),
            modifiers: self.modifiers,
            axis: self.axis,
            snapping: self.snapping,
            ignores_lines: self.ignores_lines,
            ignores_edges: self.ignores_edges,
            nudge_step: self.nudge_step(),
            following: self.following,
            added: self.keeping.added(),
            held_back: self.keeping.held_back(),
            settings: &self.settings,
            pointer: pointer.map(|at| view.pane.viewport.to_model(at)),
            rested: self.gestures.rested(),
            typed: self.typed,
        }
    }

    /// The layers that are shown, of those that the user chose: the end-fit tool may show the closed
    /// S-polygon in place of the float one.
    pub(in crate::editor) fn layers(&self, chosen: Layers) -> Layers {
        let mut layers = chosen;
        if self.tool() == ToolKind::EndFit && self.settings.end_fit.closed {
            layers.set(Layer::Clamped, true);
            layers.set(Layer::Float, false);
        }
        layers
    }

    /// The items that the pointer can hover.
    pub(in crate::editor) fn hovering(&self, shown: Shown<'_>) -> Hovering {
        let tool = self.tool();
        if self.gestures.is_dragging() {
            let held = shown
                .only_vertex()
                .filter(|_| tool == ToolKind::Select && shown.workspace.preview().is_some());
            return held.map_or(Hovering::Nothing, Hovering::Dragged);
        }
        let points_at_things = matches!(
            tool,
            ToolKind::Select
                | ToolKind::Delete
                | ToolKind::EndFit
                | ToolKind::Rotate
                | ToolKind::Scale
        );
        match points_at_things && !self.gestures.is_panning() {
            true => Hovering::Document {
                closed: (tool == ToolKind::Select).then_some(match self.following.closed_stay {
                    true => Closed::Stay,
                    false => Closed::Follow {
                        span: self.following.point_span(),
                    },
                }),
            },
            false => Hovering::Nothing,
        }
    }

    /// Use another tool, or the same anew.
    pub(in crate::editor) fn use_tool(&mut self, tool: ToolKind) {
        self.tools.choose(tool, &mut self.settings);
        self.typed = None;
    }

    /// The selection.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The tool in the hand.
    pub fn tool(&self) -> ToolKind {
        self.tools.kind()
    }

    /// Whether points snap.
    pub fn snaps(&self) -> bool {
        self.snapping
    }

    /// How far an arrow key moves the selection.
    pub fn nudge_step(&self) -> f64 {
        self.nudge_step.unwrap_or(NUDGE_STEP)
    }

    /// How the neighbours of dragged vertices follow.
    pub fn following(&self) -> Following {
        self.following
    }

    /// Which followers of what is dragged the wheel sets.
    pub(in crate::editor) fn turned_followers(&self) -> Option<Followers> {
        let turned = self.tools.used().wheel_turns(&self.following);
        turned.filter(|_| self.is_dragging())
    }

    /// Whether the wheel sets how many vertices follow what is dragged.
    pub fn turns_following(&self) -> bool {
        self.turned_followers().is_some()
    }

    /// Whether a drag keeps features: it adds no curvature extremum and no inflection.
    pub fn keeps_features(&self) -> bool {
        self.keeps != self.keeping_held
    }

    /// Whether a drag is going on.
    pub fn is_dragging(&self) -> bool {
        self.gestures.is_dragging()
    }

    /// Whether the primary button is held on the canvas: a drag goes on, or may begin.
    pub fn is_holding(&self) -> bool {
        self.gestures.is_holding()
    }
}
