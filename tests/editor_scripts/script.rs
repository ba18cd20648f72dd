//! A hand that works the editor without a window: every step leaves a valid document.

use batten::analysis::LevelPlot;
use batten::document::{CurveId, Edit, Renumbering};
use batten::editor::{
    Button, Command, DrawSettings, DrawWay, Editor, EndFitAction, EndFitReport, FeatureReport,
    Input, Key, Look, Modifiers, OperationInProgress, PlotKind, PlotScene, Reply, Scene, ToolKind,
    told,
};
use batten::geometry::FloatPolygon;
use batten::io::examples::EXAMPLES;
use batten::operations::{self, Operation, OperationError, Report, Value};
use glam::DVec2;

use super::laws::{check_document, check_selection};

/// Hold an editor with a canvas of 1000 by 700 screen points.
pub struct Script {
    /// The editor.
    pub editor: Editor,
}

impl Script {
    /// Begin with a built-in example.
    pub fn example(name: &str) -> Self {
        let index = EXAMPLES.iter().position(|example| example.name == name);
        let mut editor = Editor::default();
        editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
        told(editor.open_example(index.expect("an example")));
        let mut script = Self { editor };
        script.check();
        script
    }

    /// The active curve.
    pub fn curve(&self) -> CurveId {
        self.editor.active().expect("an active curve")
    }

    /// The active curve's polygon.
    pub fn polygon(&self) -> FloatPolygon {
        let curve = self.editor.document().curve(self.curve());
        curve.expect("the active curve").polygon.clone()
    }

    /// Give the active curve another polygon, of any degree and number of vertices.
    pub fn set_polygon(&mut self, polygon: FloatPolygon) {
        let id = self.curve();
        let curve = self.editor.document().curve(id).expect("the active curve");
        let renumbering = Renumbering::of_vertices(curve, &polygon, |_| None);
        let edit = Edit::Renumber {
            curve: id,
            polygon,
            renumbering,
        };
        self.editor.apply("another", vec![edit]).expect("an edit");
    }

    /// The selected vertices of the active curve.
    pub fn selected(&self) -> Vec<usize> {
        self.selected_of(self.curve())
    }

    /// The selected vertices of a curve.
    pub fn selected_of(&self, curve: CurveId) -> Vec<usize> {
        self.editor.hand().selection().of_curve(curve).collect()
    }

    /// The message's text; empty if there is none.
    pub fn message(&self) -> String {
        self.editor
            .message()
            .map(|message| message.text.clone())
            .unwrap_or_default()
    }

    /// Where a vertex of the active curve is on the canvas.
    pub fn at_vertex(&self, index: usize) -> DVec2 {
        self.at_vertex_of(self.curve(), index)
    }

    /// Where a vertex of a curve is on the canvas.
    pub fn at_vertex_of(&self, curve: CurveId, index: usize) -> DVec2 {
        let viewport = self.editor.view().viewport();
        let curve = self.editor.document().curve(curve).expect("a curve");
        viewport.to_screen(viewport.flatten(curve.polygon.vertex(index)))
    }

    /// Send one input.
    pub fn input(&mut self, input: Input) {
        self.editor.input(input);
        self.check();
    }

    /// Move the pointer.
    pub fn move_to(&mut self, at: DVec2) {
        self.input(Input::Moved { at });
    }

    /// Move the pointer here and press the primary button.
    pub fn press(&mut self, at: DVec2) {
        self.move_to(at);
        self.input(Input::Pressed {
            button: Button::Primary,
            at,
        });
    }

    /// Release the primary button.
    pub fn release(&mut self, at: DVec2) {
        self.input(Input::Released {
            button: Button::Primary,
            at,
        });
    }

    /// Choose what the draw tool makes of clicks.
    pub fn draw_by(&mut self, way: DrawWay) {
        let settings = self.editor.hand().draw_settings();
        let settings = DrawSettings { way, ..settings };
        self.editor.hand_mut().set_draw_settings(settings);
    }

    /// Press and release in one place.
    pub fn click(&mut self, at: DVec2) {
        self.press(at);
        self.release(at);
    }

    /// Click while these modifiers are held.
    pub fn click_with(&mut self, modifiers: Modifiers, at: DVec2) {
        self.modifiers(modifiers);
        self.click(at);
        self.modifiers(Modifiers::NONE);
    }

    /// Drag with the primary button.
    pub fn drag(&mut self, from: DVec2, to: DVec2) {
        self.drag_with(Button::Primary, from, to);
    }

    /// Drag with a button, by way of the middle.
    pub fn drag_with(&mut self, button: Button, from: DVec2, to: DVec2) {
        self.move_to(from);
        self.input(Input::Pressed { button, at: from });
        self.move_to(0.5 * (from + to));
        self.move_to(to);
        self.input(Input::Released { button, at: to });
    }

    /// Drag a vertex by some screen points.
    pub fn drag_vertex(&mut self, index: usize, by: DVec2) {
        let at = self.at_vertex(index);
        self.drag(at, at + by);
    }

    /// Press a key.
    pub fn key(&mut self, key: Key) {
        self.input(Input::Key(key));
    }

    /// Hold these modifiers and no others.
    pub fn modifiers(&mut self, modifiers: Modifiers) {
        self.input(Input::Modifiers(modifiers));
    }

    /// Give a command; what it came to is the message.
    pub fn command(&mut self, command: Command) {
        told(self.editor.execute(command));
        self.check();
    }

    /// The number of steps that can be taken back.
    pub fn steps(&self) -> usize {
        self.editor.workspace().history().undo_steps()
    }

    /// Take back every step.
    pub fn undo_all(&mut self) {
        while self.steps() > 0 {
            self.command(Command::Undo);
        }
    }

    /// Apply an operation with some values.
    pub fn operate(&mut self, name: &str, given: &[(&str, Value)]) -> Reply {
        let reply = self.editor.apply_operation(operation(name), given);
        self.check();
        reply
    }

    /// Try an operation out.
    pub fn try_out(&mut self, name: &str) -> Reply {
        let reply = self.editor.preview_operation(operation(name));
        self.check();
        reply
    }

    /// Whether a handle of the operation in progress is dragged.
    pub fn drags_handle(&self) -> bool {
        let operation = self.editor.operation();
        operation.is_some_and(OperationInProgress::drags_handle)
    }

    /// The curves that the operation in progress has made.
    pub fn made_curves(&self) -> Vec<CurveId> {
        let made = self.editor.operation();
        made.map_or_else(Vec::new, |it| it.made_curves(self.editor.document()))
    }

    /// Give the operation another value.
    pub fn set(&mut self, parameter: &str, value: Value) -> Result<(), OperationError> {
        let set = self.editor.operating().set_values(&[(parameter, value)]);
        self.check();
        set
    }

    /// What the operation that is tried out, or was applied last, reports.
    #[track_caller]
    pub fn trial_report(&self) -> Report {
        let trial = self.editor.operation().expect("an operation");
        trial.report().expect("a report").clone()
    }

    /// Let the end-fit panel do something that succeeds.
    #[track_caller]
    pub fn end_fit_action(&mut self, action: EndFitAction) {
        let reply = self.editor.end_fit_action(action);
        reply.expect("an end-fit action");
        self.check();
    }

    /// Take a tool.
    pub fn tool(&mut self, tool: ToolKind) {
        self.command(Command::Tool(tool));
    }

    /// What the canvas shows now.
    pub fn scene(&mut self) -> &Scene {
        self.editor.refresh();
        self.editor.view().scene()
    }

    /// The features of the active curve, if they are proved by now.
    pub fn features(&mut self) -> Option<FeatureReport> {
        self.editor.refresh();
        self.editor.sight().features().cloned()
    }

    /// The plot that is shown now: the curvature, unless another was chosen.
    pub fn plots(&mut self) -> &PlotScene {
        let kind = self.editor.view().plot.unwrap_or(PlotKind::CURVATURE);
        self.editor.view_mut().plot = Some(kind);
        self.editor.refresh();
        self.editor.view().plots()
    }

    /// Show a plot of levels.
    pub fn level_plot(&mut self, plot: LevelPlot, normalised: bool) -> &PlotScene {
        let kind = PlotKind::Levels { plot, normalised };
        self.editor.view_mut().plot = Some(kind);
        self.plots()
    }

    /// The figures of the end-fit panel.
    pub fn end_fit(&mut self) -> Option<EndFitReport> {
        self.editor.refresh();
        self.editor
            .hand()
            .end_fit(self.editor.workspace(), self.editor.view())
    }

    /// Check that all that panels and canvas read can be made, and that the document is valid.
    pub fn check(&mut self) {
        self.editor.refresh();
        self.editor.sight().report();
        self.editor
            .hand()
            .end_fit(self.editor.workspace(), self.editor.view());
        self.editor.sight().readout();
        assert!(!self.editor.hint().is_empty());
        let document = self.editor.document();
        assert_eq!(check_document(document), Ok(()));
        assert_eq!(
            check_selection(document, self.editor.hand().selection()),
            Ok(())
        );
    }
}

/// Find an operation by its name.
#[track_caller]
pub fn operation(name: &str) -> &'static Operation {
    operations::find(name).unwrap_or_else(|| panic!("no operation {name}"))
}
