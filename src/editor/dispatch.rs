//! From inputs to gestures, to the tool in the hand, and from its effects to the document.

use glam::DVec2;

use super::Editor;
use super::gesture::{Gesture, THRESHOLD};
use super::hit::HitTest;
use super::input::{Input, Key};
use super::tools::{Context, Cursor, Effect, ToolKind};

/// What came of the step that a tool's effects make.
enum Step {
    None,
    Made,
    Refused,
}

/// Which of several things at one place Tab has chosen, as long as the pointer stays there.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cycle {
    count: usize,
    at: Option<DVec2>,
}

impl Cycle {
    fn next(&mut self, at: Option<DVec2>) {
        self.count = self.count.wrapping_add(1);
        self.at = at;
    }

    /// Forget the choice once the pointer has moved by more than a hand that trembles.
    fn moved(&mut self, to: DVec2) {
        if self.at.is_none_or(|at| at.distance(to) > THRESHOLD) {
            *self = Self::default();
        }
    }
}

impl Editor {
    /// Take what the hand does on the canvas.
    pub fn input(&mut self, input: Input) {
        if let Input::Modifiers(modifiers) = input {
            self.modifiers = modifiers;
        }
        if let Input::AxisHeld(axis) = input {
            self.axis = axis;
        }
        if self.field && input == Input::Key(Key::Escape) {
            self.abort_field();
            return;
        }
        if let Input::Moved { at } = input
            && !self.gestures.is_holding()
        {
            self.cycle.moved(at);
        }
        if matches!(
            input,
            Input::Pressed { .. } | Input::Key(_) | Input::KeyRepeated(_)
        ) {
            self.commit_field();
            self.message = None;
        }
        let repeats = matches!(input, Input::KeyRepeated(_));
        for gesture in self.gestures.input(input) {
            match gesture {
                Gesture::Pan(by) => self.viewport.pan(by),
                Gesture::Orbit(by) => self.orbit(by),
                Gesture::Zoom(at, factor) => self.viewport.zoom(at, factor),
                Gesture::Key(Key::Tab) => self.cycle.next(self.gestures.pointer()),
                gesture => self.deliver(gesture, repeats),
            }
        }
    }

    /// Say what the mouse will do now.
    pub fn hint(&self) -> String {
        if self.gestures.is_panning() {
            return "Drag to push the view".into();
        }
        if self.gestures.is_orbiting() {
            return "Drag to turn the view; F2, F3, F4 look along the axes again".into();
        }
        self.tool_state.hint(&self.context())
    }

    /// The shape of the pointer while it rests here.
    pub fn cursor(&self) -> Cursor {
        if self.gestures.is_panning() {
            return Cursor::Grab;
        }
        if self.gestures.is_orbiting() {
            return Cursor::Grabbing;
        }
        self.tool_state.cursor(&self.context())
    }

    /// Hand a gesture to the tool and do what it wants. What a key that `repeats` does belongs to
    /// the step that it began.
    pub(super) fn deliver(&mut self, gesture: Gesture, repeats: bool) {
        let mut tool = std::mem::replace(&mut self.tool_state, ToolKind::Select.take());
        let effects = tool.gesture(gesture, &self.context());
        self.tool_state = tool;
        let active = self.selection.active();
        let mut step = Step::None;
        for effect in effects {
            self.take_effect(effect, repeats, &mut step);
        }
        self.document_changed();
        if self.selection.active() != active {
            self.end_fit.begin_anew();
        }
    }

    pub(super) fn context(&self) -> Context<'_> {
        let active = self.selection.active();
        let shown = self.scene.curves.iter().find(|curve| curve.id == active);
        Context {
            document: self.history.document(),
            before: self.history.before_gesture(),
            selection: &self.selection,
            viewport: &self.viewport,
            hits: HitTest {
                document: self.history.document(),
                analyses: &self.analyses,
                viewport: &self.viewport,
                layers: self.layers(),
                active,
                cycle: self.cycle.count,
            },
            modifiers: self.modifiers,
            axis: self.axis,
            snapping: self.snapping,
            comb: self.comb,
            teeth: shown.map_or(&[], |curve| &curve.teeth),
            end_fit: &self.end_fit,
            pointer: self.gestures.pointer().map(|at| self.viewport.to_model(at)),
        }
    }

    fn take_effect(&mut self, effect: Effect, repeats: bool, step: &mut Step) {
        match effect {
            Effect::Begin(label) => {
                self.end_fit.begin_anew();
                self.history.begin(label);
            }
            Effect::Preview(edits) => {
                if let Err(error) = self.history.preview(edits) {
                    self.fail(error.to_string());
                }
            }
            Effect::Commit => {
                self.history.commit();
            }
            Effect::Abort => self.history.abort(),
            Effect::Apply(label, edits) => {
                let made = self.make(&label, edits, repeats);
                *step = if made { Step::Made } else { Step::Refused };
            }
            Effect::Select(vertices) => self.selection.set(vertices),
            Effect::SelectMore(vertices) => self.selection.add(vertices),
            Effect::ToggleSelected(vertex) => self.selection.toggle(vertex),
            Effect::Activate(curve) => self.selection.activate(curve),
            Effect::SetComb(comb) => self.set_comb(comb),
            Effect::FitAll => self.fit_all(),
            Effect::Say(text) => match step {
                Step::None => self.say(text),
                Step::Made => self.say_done(text),
                // The message says why not.
                Step::Refused => {}
            },
            Effect::Finish => self.take(ToolKind::Select),
            Effect::EndFit(action) => self.end_fit_action(action),
        }
    }
}
