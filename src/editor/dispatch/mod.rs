//! Input handling: from inputs to gestures, to the tool in use, and from its effects to the document.

mod drag_report;
mod typing;

use drag_report::drag_report;
use glam::DVec2;

use crate::document::CurveId;
use crate::editor::Editor;
use crate::editor::hand::Hand;
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::{Input, Key};
use crate::editor::hand::menu::MenuTarget;
use crate::editor::hand::tools::{Context, Cursor, Effect, ToolKind, Tools};
use crate::editor::operating::OperationInProgress;
use crate::editor::reply::{Message, Note, Refusal, told};
use crate::editor::view::{Look, View};
use crate::editor::workspace::Interruption;

/// The subject of a requested context menu.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MenuOf {
    /// A place on the canvas: the item there is selected.
    Place(DVec2),
    /// A row of the list of curves, which becomes active.
    Item(CurveId),
    /// The selection: the menu key.
    Selection,
}

/// The step that a tool's effects make.
enum Step {
    None,
    Made,
    Refused,
}

impl Editor {
    /// Take an input from the canvas.
    pub fn input(&mut self, mut input: Input) {
        enter_pane(&mut self.view, &mut self.hand, &mut input);
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
                let ended = previewed.map(OperationInProgress::ended);
                self.operating().leave();
                self.message = ended.and_then(|it| Message::of(&Ok(it)));
                return;
            }
            Input::Key(Key::Escape)
                if self.hand.tool() == ToolKind::Select
                    && !self.hand.is_holding()
                    && self.hand.settings.measurement.take().is_some() =>
            {
                return;
            }
            Input::Key(Key::Escape)
                if self.hand.tool() == ToolKind::Select
                    && !self.hand.is_holding()
                    && !self.recovery.recoverable.is_empty() =>
            {
                return self.recovery.leave();
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
                Gesture::Pan(by) => self.view.pane.viewport.pan(by),
                Gesture::Orbit(by) => self.look(Look::Orbit(by)),
                Gesture::Zoom(at, factor) if self.hand.turns_following() => {
                    let stiffer = self.hand.modifiers.shift;
                    let active = self.active().and_then(|id| self.document().curve(id));
                    let vertices = active.map_or(0, |curve| curve.polygon.vertices().len());
                    let most = vertices.saturating_sub(1);
                    if let Some(followers) = self.hand.turned_followers() {
                        self.hand.following.turn(followers, factor, stiffer, most);
                    }
                    self.deliver(Gesture::Drag(at), repeats);
                }
                Gesture::Zoom(at, factor) => self.view.pane.viewport.zoom(at, factor),
                Gesture::Key(Key::Tab) => self.hand.cycle.next(self.hand.gestures.pointer()),
                gesture => self.deliver(gesture, repeats),
            }
        }
    }

    /// The hint for the status bar: what the mouse does now.
    pub fn hint(&self) -> String {
        if self.hand.gestures.is_panning() {
            return "Drag to pan".into();
        }
        if self.hand.gestures.is_orbiting() {
            return "Drag to orbit; F3, F4, F5 look along the axes".into();
        }
        let (tool, context) = (self.hand.tool(), self.context());
        let point = self
            .operation()
            .and_then(|it| it.point_under_pointer(tool, &context));
        if point.is_some() {
            return "Click to leave the point out of the fit, or to take it back".into();
        }
        let previewed = self.previewed_operation();
        let at = self.hand.gestures.pointer();
        let viewport = &self.view.pane.viewport;
        let is_over_handle =
            |it: &OperationInProgress| at.is_some_and(|at| it.handle_at(viewport, at).is_some());
        if previewed.is_some_and(OperationInProgress::drags_handle) {
            return "Drag; Shift constrains, Esc puts the handle back".into();
        }
        if previewed.is_some_and(is_over_handle) {
            return "Drag the handle to change the values in the panel".into();
        }
        if previewed.is_some_and(OperationInProgress::takes_clicks_on_curve) {
            return "Click the curve or drag a handle to set where; Enter applies, Esc cancels"
                .into();
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

    /// The shape of the pointer while it rests here.
    pub fn cursor(&self) -> Cursor {
        if self.hand.gestures.is_panning() {
            return Cursor::Grab;
        }
        if self.hand.gestures.is_orbiting() {
            return Cursor::Grabbing;
        }
        let (tool, context) = (self.hand.tool(), self.context());
        let point = self
            .operation()
            .and_then(|it| it.point_under_pointer(tool, &context));
        if point.is_some() {
            return Cursor::Point;
        }
        let previewed = self.previewed_operation();
        let drags_handle = previewed.is_some_and(OperationInProgress::drags_handle);
        let at = self.hand.gestures.pointer();
        let viewport = &self.view.pane.viewport;
        let is_over_handle =
            |it: &OperationInProgress| at.is_some_and(|at| it.handle_at(viewport, at).is_some());
        if drags_handle || previewed.is_some_and(is_over_handle) {
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
        if self.operating().take_gesture(gesture) {
            return;
        }
        if let Gesture::SecondaryClick(at) = gesture
            && self.hand.tools.used().undo_label().is_none()
        {
            return self.ask_for_menu(MenuOf::Place(at));
        }
        let begins = |tools: &mut Tools, context: &Context<'_>| tools.begins(gesture, context);
        if previews && self.with_tools(begins) {
            // The gesture is about the document without the preview, which ends now.
            let ended = self.previewed_operation().map(OperationInProgress::ended);
            self.operating().interrupt();
            if let Some(unready) = ended.filter(|note| note.warns) {
                self.message = Message::of(&Ok(unready));
            }
        }
        let effects = self.with_tools(|tools, context| tools.gesture(gesture, context));
        self.take_effects(effects, repeats);
    }

    /// Let the tools change while they see the rest of the editor.
    fn with_tools<R>(&mut self, change: impl FnOnce(&mut Tools, &Context<'_>) -> R) -> R {
        self.view.analyse(self.workspace.document());
        let layers = self.hand.layers(self.view.layers);
        let mut tools = std::mem::take(&mut self.hand.tools);
        let context = self.hand.context(&self.workspace, &self.view, layers);
        let result = change(&mut tools, &context);
        self.hand.tools = tools;
        result
    }

    /// Ask for a context menu; the previewed operation has none of its own on the canvas.
    pub fn ask_for_menu(&mut self, of: MenuOf) {
        let previews = self.previewed_operation().is_some();
        let target = match of {
            MenuOf::Item(id) => MenuTarget::of_item(self.document(), id),
            _ if previews => return,
            MenuOf::Place(at) => {
                self.view.analyse(self.workspace.document());
                MenuTarget::at(at, &self.context())
            }
            MenuOf::Selection => {
                let document = self.workspace.document();
                let viewport = &self.view.pane.viewport;
                return self.hand.ask_for_menu_of_selection(document, viewport);
            }
        };
        if let Some(id) = target.item() {
            self.hand.selection.focus(id);
        }
        self.hand.ask_for_menu_about(target);
        self.document_changed();
        self.operating().leave_stale();
    }

    /// Everything that tools look at.
    pub fn context(&self) -> Context<'_> {
        let layers = self.hand.layers(self.view.layers);
        self.hand.context(&self.workspace, &self.view, layers)
    }

    /// Carry out the effects of a tool. A key that `repeats` goes on with the step that it began.
    pub(in crate::editor) fn take_effects(&mut self, effects: Vec<Effect>, repeats: bool) {
        let mut step = Step::None;
        for effect in effects {
            match effect {
                Effect::Begin(label) => {
                    self.hand.keeping.end();
                    self.workspace.begin(&label, Interruption::Aborts);
                }
                Effect::Preview(edits) => {
                    let edits = self.hand.kept(edits, &self.workspace, &self.view.analyses);
                    let refusal = self.workspace.update(edits).err().map(Refusal::from);
                    Message::tell_update(&mut self.message, refusal);
                    self.hand.find_added(&self.workspace, &self.view.analyses);
                }
                Effect::Commit => {
                    let before = self.workspace.settled().clone();
                    let added = self.hand.added_beyond_the_drag(&self.workspace);
                    let analyses = &self.view.analyses;
                    self.hand.commit_kept(&mut self.workspace, analyses);
                    let warning =
                        drag_report(&self.hand, [&before, self.workspace.document()], added);
                    if !warning.is_empty() {
                        self.message = Message::of(&Ok(Note::done(warning).warning()));
                    }
                }
                Effect::Abort => {
                    self.hand.keeping.end();
                    self.workspace.abort();
                }
                Effect::Apply(label, edits) => {
                    let kept = self
                        .hand
                        .check_kept(&edits, &self.workspace, &self.view.analyses);
                    let reply = kept.and_then(|()| self.make(&label, edits, repeats));
                    step = match self.tell(reply) {
                        Ok(_) => Step::Made,
                        Err(_) => Step::Refused,
                    };
                }
                Effect::Select(vertices) => self.hand.selection.set(vertices),
                Effect::SelectMore(vertices) => self.hand.selection.add(vertices),
                Effect::ToggleSelected(vertex) => self.hand.selection.toggle(vertex),
                Effect::SelectItems(items) => self.hand.selection.set_items(items),
                Effect::ToggleItem(item) => self.hand.selection.toggle_item(item),
                Effect::Activate(item) => self.hand.selection.focus(item),
                Effect::Look(look) => self.look(look),
                Effect::Set(settings) => self.hand.settings = *settings,
                Effect::Say(text) if self.workspace.preview().is_some() => {
                    Message::tell_update(&mut self.message, Some(Refusal(text)));
                }
                Effect::Say(text) => {
                    self.message = match step {
                        Step::None => Message::of(&Ok(Note::told(text))),
                        Step::Made => Message::of(&Ok(Note::done(text))),
                        // The message says why not.
                        Step::Refused => self.message.take(),
                    };
                }
                Effect::Warn(text) => {
                    if !matches!(step, Step::Refused) {
                        self.message = Message::of(&Ok(Note::done(text).warning()));
                    }
                }
                Effect::Finish => {
                    self.interrupt();
                    self.hand.use_tool(ToolKind::Select);
                }
            }
        }
        self.document_changed();
        self.operating().leave_stale();
    }
}

/// Use the pane that the pointer is in, unless the hand holds something in another one, and tell the place within it.
fn enter_pane(view: &mut View, hand: &mut Hand, input: &mut Input) {
    let before = view.pane.viewport.orientation;
    let stays = matches!(input, Input::Pressed { .. } | Input::Zoomed { .. });
    let is_free = hand.gestures.is_free();
    if is_free && *input == Input::Left {
        view.use_chosen_pane();
    }
    if let Some(at) = input.place_mut() {
        if is_free {
            view.use_pane_at(*at, stays);
        }
        *at -= view.pane_corner();
    }
    if view.pane.viewport.orientation != before {
        hand.forget_pivot();
    }
}
