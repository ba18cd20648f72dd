//! A second history beside the editor's, to the bit: every state that undo and redo lead to.

use batten::document::{CurveId, Document};
use batten::editor::{Command, OperationInProgress, ToolKind, told};
use batten::operations::Inputs;

use super::laws::{check_document, check_matches, check_protected, check_selection, check_view};
use super::snapshot::Snapshot;
use super::window::Window;

/// What was done, as far as it decides what may come of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Done {
    /// A step was taken back.
    Undo,
    /// A step was made again.
    Redo,
    /// Escape was pressed.
    Escape,
    /// An arrow key was pressed, or a transformation typed: what is active stays so.
    Transform,
    /// An arrow key is held and repeats: it goes on with its step.
    Repeat,
    /// A command was given that is not offered now.
    Nothing,
    /// Vertices were deleted or cut.
    Delete,
    /// Curves and references are deleted, so many at most.
    DeleteCurves(usize),
    /// An operation on two curves was begun, which may make one of them.
    Join,
    /// All lengths were converted to another unit: those of what is locked or hidden, too.
    Convert,
    /// Another document may have been opened.
    Replace,
    /// The document's file was read again, as a step.
    Reload,
    /// The operation that was applied last got another value.
    Amend,
    /// Something was done that changes nothing shown.
    Look,
    /// Anything else.
    Other,
}

/// Remember every state that the document was in, to be compared with what undo and redo bring.
#[derive(Debug)]
pub struct Watch {
    /// The states that undo leads back to, the present one and those that redo leads on to.
    states: Vec<State>,
    /// The number of the present state.
    at: usize,
    /// What was shown last, a preview included.
    shown: State,
    /// Whether a panel's field showed a preview.
    field: bool,
    /// Whether an operation was tried out.
    trying: bool,
    /// Whether a drag was going on.
    dragging: bool,
    /// Whether a handle of an operation was dragged: Escape ends that first.
    handle: bool,
    /// Whether undo would have taken back a point of what is not finished.
    unfinished: bool,
    /// The curve that was active.
    active: Option<CurveId>,
}

/// A state of the document: its bits, and itself for what counts as equal.
#[derive(Clone, Debug)]
struct State {
    bits: Snapshot,
    document: Document,
    /// Whether a key made it, which may repeat.
    by_key: bool,
}

impl State {
    fn of(document: &Document) -> Self {
        Self {
            bits: Snapshot::of(document),
            document: document.clone(),
            by_key: false,
        }
    }
}

impl Watch {
    /// Begin with the document of a window that is at rest.
    pub fn new(window: &Window) -> Self {
        let state = State::of(window.document());
        Self {
            states: vec![state.clone()],
            at: 0,
            shown: state,
            field: false,
            trying: window.is_trying(),
            dragging: false,
            handle: false,
            unfinished: false,
            active: window.active(),
        }
    }

    /// Say that a panel's field is about to show a preview.
    pub fn expect_field(&mut self) {
        self.field = true;
    }

    /// Check everything after something was done.
    ///
    /// # Errors
    /// What does not hold, in words.
    pub fn check(&mut self, window: &Window, done: Done) -> Result<(), String> {
        // What is worked out later shows at the next event.
        let joins = |trial: &OperationInProgress| trial.operation().inputs == Inputs::Two;
        let done = match done {
            Done::Other if window.trial().is_some_and(joins) => Done::Join,
            done => done,
        };
        check_document(window.document())?;
        check_selection(window.document(), window.selection())?;
        check_view(window)?;
        check_matches(window)?;
        // What a joining operation shows may come while a key, a command or the same value does nothing, and when it
        // is amended.
        let nothing = matches!(
            done,
            Done::Transform | Done::Repeat | Done::Nothing | Done::Look | Done::Amend
        );
        let may_join = nothing && window.trial().is_some_and(joins);
        let replaced = done == Done::Replace
            && window.undo_steps() == 0
            && !window.can_redo()
            && !window.is_modified();
        if replaced {
            *self = Self::new(window);
            return Ok(());
        }
        let shown = State::of(window.document());
        if !matches!(done, Done::Undo | Done::Redo | Done::Reload) {
            // What an operation did, or would do, may be gone.
            let of_trial = window.trial().filter(|_| done == Done::Amend);
            let before = match of_trial {
                Some(trial) => Snapshot::of(trial.input().document()),
                None if self.trying => self.states[self.at].bits.clone(),
                None => self.shown.bits.clone(),
            };
            let made = if may_join { Done::Join } else { done };
            check_protected(&before, &shown.bits, made)?;
        }
        self.follow(window, done, &shown)?;
        let does_nothing = matches!(done, Done::Nothing | Done::Look) && !may_join;
        if does_nothing && shown.bits != self.shown.bits {
            return Err("a command that is not offered, or a value refused, did something".into());
        }
        let moves = matches!(done, Done::Transform | Done::Repeat);
        if moves && window.active() != self.active {
            return Err("another curve is active after moving vertices".into());
        }
        self.shown = shown;
        self.dragging = window.is_dragging();
        self.field &= window.is_in_gesture() && !window.is_trying();
        self.trying = window.is_trying();
        self.unfinished = window.undoes_points();
        self.active = window.active();
        let drags_handle = window
            .trial()
            .is_some_and(OperationInProgress::drags_handle);
        let ended_handle = std::mem::replace(&mut self.handle, drags_handle) && self.trying;
        let goes_on = window.is_in_gesture() && !ended_handle;
        if done == Done::Escape && (self.dragging || goes_on) {
            return Err("a gesture goes on after Escape".into());
        }
        if window.is_in_gesture() && !self.field && !self.dragging && !self.trying {
            return Err("a gesture goes on though nothing is held".into());
        }
        Ok(())
    }

    /// Undo all and redo all, and come back to the present state.
    ///
    /// # Errors
    /// The first state that is not as it was.
    pub fn rewind(&mut self, window: &mut Window) -> Result<(), String> {
        if window.is_in_gesture() {
            return Err("a gesture goes on".into());
        }
        // What is not finished would be undone first.
        told(window.execute(Command::Tool(ToolKind::Select)));
        self.check(window, Done::Other)?;
        let (present, last) = (self.at, self.states.len() - 1);
        let route = (0..present)
            .map(|_| Command::Undo)
            .chain((0..last).map(|_| Command::Redo))
            .chain((present..last).map(|_| Command::Undo));
        for command in route.collect::<Vec<Command>>() {
            let before = self.at;
            told(window.execute(command));
            let done = if command == Command::Undo {
                Done::Undo
            } else {
                Done::Redo
            };
            self.check(window, done)?;
            if self.at == before {
                return Err(format!("{command:?} did nothing at step {before}"));
            }
        }
        Ok(())
    }

    /// Follow the editor's history by the number of its steps.
    fn follow(&mut self, window: &Window, done: Done, shown: &State) -> Result<(), String> {
        let mut settled = State::of(window.settled());
        settled.by_key = matches!(done, Done::Transform | Done::Repeat);
        let pending = self.field && !self.shown.document.is_same(&self.states[self.at].document);
        let steps = window.undo_steps();
        match done {
            Done::Undo if !self.unfinished || self.dragging => self.follow_undo(steps, pending)?,
            Done::Redo if !pending && steps > self.at => {
                if self.at + 1 >= self.states.len() {
                    return Err("a step was redone that was never undone".into());
                }
                self.at += 1;
            }
            Done::Repeat if self.states[self.at].by_key && steps == self.at => {
                self.go_on(settled.clone())?;
            }
            Done::Amend => self.follow_amended(settled.clone(), steps)?,
            _ => {
                let shows = pending.then(|| self.shown.clone());
                let first = shows.or_else(|| self.drawn(window, steps));
                self.follow_steps(done, first, &settled, steps)?;
            }
        }
        if steps != self.at {
            return Err(format!("{steps} steps to undo, not {}", self.at));
        }
        let expected = &self.states[self.at].bits;
        if settled.bits != *expected {
            let bits = &settled.bits;
            return Err(format!(
                "the document changed without a step: {bits:?}, not {expected:?}"
            ));
        }
        if !window.is_in_gesture() && shown.bits != settled.bits {
            return Err("a preview without a gesture".into());
        }
        let can_redo = self.at + 1 < self.states.len();
        if window.can_redo() != can_redo {
            return Err(format!("redo is offered: {}", window.can_redo()));
        }
        Ok(())
    }

    /// Undo takes a step back, or what a drag or a field shows.
    fn follow_undo(&mut self, steps: usize, pending: bool) -> Result<(), String> {
        if pending && !self.dragging && steps == self.at {
            // The field's step was made and taken back: it can be made again.
            self.states.truncate(self.at + 1);
            self.states.push(self.shown.clone());
            return Ok(());
        }
        let may_stay = self.at == 0 || self.dragging || self.field || self.trying;
        if steps + 1 == self.at {
            self.at -= 1;
        } else if !(steps == self.at && may_stay) {
            return Err(format!("undo led from step {} to {steps}", self.at));
        }
        Ok(())
    }

    /// A key that is held goes on with the step that it made.
    fn go_on(&mut self, now: State) -> Result<(), String> {
        let before = self.at.checked_sub(1).and_then(|at| self.states.get(at));
        if before.is_some_and(|before| now.document.is_same(&before.document)) {
            return Err("a step that changes nothing".into());
        }
        self.states[self.at] = now;
        Ok(())
    }

    /// Another value makes another step in place of the operation's, or none, or the first.
    fn follow_amended(&mut self, now: State, steps: usize) -> Result<(), String> {
        if steps + 1 == self.at {
            self.at -= 1;
            self.states.truncate(self.at + 1);
            return Ok(());
        }
        if steps != self.at {
            return self.follow_steps(Done::Amend, None, &now, steps);
        }
        if now.bits != self.states[self.at].bits {
            self.states.truncate(self.at + 1);
            self.go_on(now)?;
        }
        Ok(())
    }

    /// What a drawing became that ended before a step of something else.
    fn drawn(&self, window: &Window, steps: usize) -> Option<State> {
        if !self.unfinished || steps != self.at + 2 {
            return None;
        }
        let mut history = window.history().clone();
        history.undo()?;
        Some(State::of(history.document()))
    }

    /// What is no undo makes steps or none: a first one of a field or a drawing that it ends, and its own.
    fn follow_steps(
        &mut self,
        done: Done,
        first: Option<State>,
        now: &State,
        steps: usize,
    ) -> Result<(), String> {
        let made = steps
            .checked_sub(self.at)
            .ok_or(format!("{} steps became {steps}", self.at))?;
        let new = match (made, first) {
            (0, _) => return Ok(()),
            _ if done == Done::Escape => return Err("Escape made a step".into()),
            (1, _) => vec![now.clone()],
            (2, Some(first)) => vec![first, now.clone()],
            (made, _) => return Err(format!("{made} steps at once")),
        };
        self.states.truncate(self.at + 1);
        for state in new {
            if state.document.is_same(&self.states[self.at].document) {
                return Err("a step that changes nothing".into());
            }
            self.states.push(state);
            self.at += 1;
        }
        Ok(())
    }
}
