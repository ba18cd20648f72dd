//! From inputs to gestures, to the tool in the hand, and from its effects to the document.

use std::sync::Arc;

use glam::DVec2;

use crate::analysis::AnalysisCache;
use crate::document::{Curve, CurveId, Document, Edit};
use crate::editor::Editor;
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::{Input, Key};
use crate::editor::hand::keeping::Keeping;
use crate::editor::hand::tools::{Context, Cursor, Effect, ToolKind};
use crate::editor::operating::OperationInProgress;
use crate::editor::reply::{Message, Note, Refusal, told};
use crate::editor::view::layers::Layers;
use crate::editor::view::{Look, REACH};
use crate::editor::workspace::Interruption;
use crate::geometry::features::SegmentFeatures;

/// What came of the step that a tool's effects make.
enum Step {
    None,
    Made,
    Refused,
}

impl Editor {
    /// Take what the hand does on the canvas.
    pub fn input(&mut self, input: Input) {
        if let Input::Modifiers(modifiers) = input {
            self.hand.modifiers = modifiers;
        }
        if let Input::AxisHeld(axis) = input {
            self.hand.axis = axis;
        }
        if let Input::KeepingHeld(held) = input {
            self.hand.keeping_held = held;
        }
        let field = self.workspace.interruption() == Some(Interruption::Commits);
        let (operation, previewed) = (self.operation(), self.previewed_operation());
        let holds = operation.is_some_and(OperationInProgress::holds_values);
        let drags_handle = operation.is_some_and(OperationInProgress::drags_handle);
        let previews = previewed.is_some();
        match input {
            Input::Key(Key::Escape) if field => return self.abort_preview(),
            Input::Key(Key::Escape) if holds && !drags_handle => {
                return self.operating().restore_values();
            }
            Input::Key(Key::Escape) if previews && !drags_handle => {
                return self.operating().leave();
            }
            Input::Key(Key::Escape)
                if self.hand.tool() == ToolKind::Select
                    && !self.hand.is_holding()
                    && self.hand.tools.dismiss_measurement() =>
            {
                return;
            }
            Input::Key(Key::Escape)
                if self.hand.tool() == ToolKind::Select
                    && !self.hand.is_holding()
                    && !self.recoverable.is_empty() =>
            {
                return self.leave_recoverable();
            }
            Input::Key(Key::Enter) if previews => return told(self.operating().apply()),
            _ => {}
        }
        if let Input::Moved { at } = input
            && !self.hand.gestures.is_holding()
        {
            self.hand.cycle.moved(at);
        }
        if matches!(
            input,
            Input::Pressed { .. } | Input::Key(_) | Input::KeyRepeated(_)
        ) {
            self.message = None;
        }
        let repeats = matches!(input, Input::KeyRepeated(_));
        for gesture in self.hand.gestures.input(input) {
            match gesture {
                Gesture::Pan(by) => self.view.viewport.pan(by),
                Gesture::Orbit(by) => self.look(Look::Orbit(by)),
                Gesture::Zoom(at, factor) if self.hand.turns_following() => {
                    let stiffer = self.hand.modifiers.shift;
                    let active = self.active().and_then(|id| self.document().curve(id));
                    let vertices = active.map_or(0, |curve| curve.polygon.vertices().len());
                    let most = vertices.saturating_sub(1);
                    self.hand.following.turn(factor, stiffer, most);
                    self.deliver(Gesture::Drag(at), repeats);
                }
                Gesture::Zoom(at, factor) => self.view.viewport.zoom(at, factor),
                Gesture::Key(Key::Tab) => self.hand.cycle.next(self.hand.gestures.pointer()),
                gesture => self.deliver(gesture, repeats),
            }
        }
    }

    /// Say what the mouse will do now.
    pub fn hint(&self) -> String {
        if self.hand.gestures.is_panning() {
            return "Drag to pan".into();
        }
        if self.hand.gestures.is_orbiting() {
            return "Drag to orbit; F3, F4, F5 look along the axes".into();
        }
        let previewed = self.previewed_operation();
        if previewed.is_some_and(OperationInProgress::drags_handle) {
            return "Drag; Shift constrains, Esc puts the handle back".into();
        }
        if self.is_over_handle() {
            return "Drag the handle to change the values in the panel".into();
        }
        if previewed.is_some_and(OperationInProgress::offers_handles) {
            return "Drag a handle, or change the values in the panel; Enter applies, Esc cancels"
                .into();
        }
        if previewed.is_some() && !self.hand.is_dragging() {
            return "Change the values in the panel; Enter applies, Esc cancels".into();
        }
        let hint = self.hand.tools.used().hint(&self.context());
        if !self.hand.is_dragging() || !self.hand.keeps_features() {
            return hint;
        }
        match self.hand.keeping.held_back() {
            Some(reason) => format!("Held at the last place proved to add nothing; {reason}"),
            None => format!("Features are kept. {hint}"),
        }
    }

    /// Change the edits of a drag so that it adds no feature, if features are kept.
    pub(in crate::editor) fn kept(&mut self, edits: Vec<Edit>) -> Vec<Edit> {
        if !self.hand.keeps_features() || self.workspace.preview().is_none() {
            return edits;
        }
        let proved = known_features(&self.view.analyses);
        let settled = self.workspace.settled();
        let try_out = |edits| self.workspace.previewed(edits);
        self.hand.keeping.keep(edits, settled, try_out, proved)
    }

    /// End a drag, or a field's preview, and keep what it shows as one step. Where features are kept, a
    /// match that can be met after all is met only if that adds none.
    pub(in crate::editor) fn commit_kept(&mut self) {
        if self.hand.keeps_features() {
            let settled = self.workspace.settled().clone();
            let proved = known_features(&self.view.analyses);
            let keeping = &mut self.hand.keeping;
            let allowed = |after: &Document| keeping.allows(after, &settled, proved);
            self.workspace.take_time(allowed);
        }
        self.hand.keeping.end();
        self.workspace.commit();
    }

    /// Refuse moves of vertices that are one step if they add a feature, if features are kept.
    ///
    /// # Errors
    /// [`Refusal`] that says what would be added.
    pub(in crate::editor) fn check_kept(&self, edits: &[Edit]) -> Result<(), Refusal> {
        let moves = edits
            .iter()
            .all(|edit| matches!(edit, Edit::MoveVertices { .. }));
        if !moves || !self.hand.keeps_features() {
            return Ok(());
        }
        let proved = known_features(&self.view.analyses);
        match Keeping::refusal(edits.to_vec(), self.workspace.settled(), proved) {
            None => Ok(()),
            Some(reason) => Err(Refusal(format!("Features are kept (K): {reason}"))),
        }
    }

    /// The shape of the pointer while it rests here.
    pub fn cursor(&self) -> Cursor {
        if self.hand.gestures.is_panning() {
            return Cursor::Grab;
        }
        if self.hand.gestures.is_orbiting() {
            return Cursor::Grabbing;
        }
        let previewed = self.previewed_operation();
        let drags_handle = previewed.is_some_and(OperationInProgress::drags_handle);
        if drags_handle || self.is_over_handle() {
            return Cursor::Move;
        }
        if previewed.is_some_and(OperationInProgress::offers_handles) {
            return Cursor::Default;
        }
        self.hand.tools.used().cursor(&self.context())
    }

    /// Hand a gesture to the tool and do what it wants. What a key that `repeats` does belongs to
    /// the step that it began.
    pub(in crate::editor) fn deliver(&mut self, gesture: Gesture, repeats: bool) {
        let previews = self.previewed_operation().is_some();
        if previews && self.drag_handle(gesture) {
            return;
        }
        if let Gesture::SecondaryClick(at) = gesture
            && self.hand.tools.used().undo_label().is_none()
        {
            return self.ask_for_menu_at(at);
        }
        let previewed = self.previewed_operation();
        if previewed.is_some_and(OperationInProgress::offers_handles) {
            return self.leave_beside_handles(gesture);
        }
        self.view.analyse(self.workspace.document());
        let layers = self.hand.layers(self.view.layers);
        let mut tools = std::mem::take(&mut self.hand.tools);
        if previews && tools.used().begins(gesture, &self.context_with(layers)) {
            // The gesture is about the document without the preview, which ends now.
            self.operating().interrupt();
            self.view.analyse(self.workspace.document());
        }
        let context = self.context_with(layers);
        let effects = tools.used_mut().gesture(gesture, &context);
        self.hand.tools = tools;
        self.take_effects(effects, repeats);
    }

    /// Take a gesture that is meant for a handle of the previewed operation. Returns whether it is.
    fn drag_handle(&mut self, gesture: Gesture) -> bool {
        match gesture {
            Gesture::DragStart(at) => self.operating().begin_handle_drag(at),
            Gesture::Click(at) | Gesture::DoubleClick(at) => {
                let previewed = self.previewed_operation();
                previewed.is_some_and(|it| it.handle_at(&self.view.viewport, at).is_some())
            }
            Gesture::Drag(at) => {
                let previewed = self.previewed_operation();
                let given = previewed.and_then(|it| it.dragged_values(at, &self.context()));
                self.operating().go_on_with_handle(given)
            }
            Gesture::DragEnd(_) => {
                let drags = self.operating().end_handle_drag();
                if drags {
                    self.operating().keep_values();
                }
                drags
            }
            Gesture::Cancel => {
                let drags = self.operating().end_handle_drag();
                if drags {
                    self.operating().restore_values();
                }
                drags
            }
            _ => false,
        }
    }

    /// Leave a gesture beside the handles without effect on the operation that offers them; a double
    /// click on nothing still shows everything.
    fn leave_beside_handles(&mut self, gesture: Gesture) {
        let is_over_curve = |at: DVec2| {
            let hits = self.context().hits;
            hits.vertex(at).is_some()
                || hits.curve(at).is_some()
                || hits.leg(at, 0.5 * REACH).is_some()
        };
        match gesture {
            Gesture::DoubleClick(at) if !is_over_curve(at) => self.look(Look::All),
            Gesture::DragStart(at) if is_over_curve(at) => {
                let previewed = self.previewed_operation();
                let label = previewed.map_or("", |it| it.operation().label);
                let first = format!("Apply or cancel {label} before you edit curves on the canvas");
                self.message = Message::of(&Err(Refusal(first)));
            }
            _ => {}
        }
    }

    /// Whether the pointer rests on a handle.
    fn is_over_handle(&self) -> bool {
        let at = self.hand.gestures.pointer();
        let handle = |at| {
            self.previewed_operation()?
                .handle_at(&self.view.viewport, at)
        };
        at.and_then(handle).is_some()
    }

    /// Do what a tool wants.
    pub(in crate::editor) fn take_effects(&mut self, effects: Vec<Effect>, repeats: bool) {
        let mut step = Step::None;
        for effect in effects {
            self.take_effect(effect, repeats, &mut step);
        }
        self.document_changed();
        self.operating().leave_stale();
    }

    pub(in crate::editor) fn context(&self) -> Context<'_> {
        self.context_with(self.hand.layers(self.view.layers))
    }

    fn context_with(&self, layers: Layers) -> Context<'_> {
        Context {
            document: self.workspace.document(),
            before: self.workspace.settled(),
            selection: &self.hand.selection,
            viewport: &self.view.viewport,
            hits: self.view.sight(self.hand.shown(&self.workspace, layers)),
            modifiers: self.hand.modifiers,
            axis: self.hand.axis,
            snapping: self.hand.snapping,
            nudge_step: self.hand.nudge_step(),
            following: self.hand.following,
            pointer: self
                .hand
                .gestures
                .pointer()
                .map(|at| self.view.viewport.to_model(at)),
            typed: self.hand.typed,
        }
    }

    fn take_effect(&mut self, effect: Effect, repeats: bool, step: &mut Step) {
        match effect {
            Effect::Begin(label) => {
                self.hand.keeping.end();
                self.workspace.begin(&label, Interruption::Aborts);
            }
            Effect::Preview(edits) => {
                let edits = self.kept(edits);
                self.update(edits);
            }
            Effect::Commit => self.commit_kept(),
            Effect::Abort => {
                self.hand.keeping.end();
                self.workspace.abort();
            }
            Effect::Apply(label, edits) => {
                let kept = self.check_kept(&edits);
                let reply = kept.and_then(|()| self.make(&label, edits, repeats));
                *step = match self.tell(reply) {
                    Ok(_) => Step::Made,
                    Err(_) => Step::Refused,
                };
            }
            Effect::Select(vertices) => self.hand.selection.set(vertices),
            Effect::SelectMore(vertices) => self.hand.selection.add(vertices),
            Effect::ToggleSelected(vertex) => self.hand.selection.toggle(vertex),
            Effect::Activate(curve) => self.hand.selection.activate(curve),
            Effect::Look(look) => self.look(look),
            Effect::Say(text) if self.workspace.preview().is_some() => {
                self.tell_of_update(Some(Refusal(text)));
            }
            Effect::Say(text) => {
                self.message = match step {
                    Step::None => Message::of(&Ok(Note::told(text))),
                    Step::Made => Message::of(&Ok(Note::done(text))),
                    // The message says why not.
                    Step::Refused => self.message.take(),
                };
            }
            Effect::Finish => self.use_tool(ToolKind::Select),
        }
    }
}

/// The features that are proved of curves as they are shown.
fn known_features(
    analyses: &AnalysisCache,
) -> impl Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>> + '_ {
    |id, curve| {
        let analysis = analyses.get(id)?;
        let known = analysis.proved_segments()?;
        Arc::ptr_eq(analysis.curve(), curve).then(|| known.to_vec())
    }
}
