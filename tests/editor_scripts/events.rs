//! Events as data, and the player that hands them to a window one by one and checks after each.

use std::path::Path;

use batten::document::Document;
use batten::editor::{Button, Command, Input, Key, Modifiers, Shortcut};
use batten::operations::Inputs;
use glam::DVec2;

use super::laws::check_written;
use super::places::Place;
use super::watch::{Done, Watch};
use super::window::{OfFile, Panel, Replacement, Window};

/// What stands in a failure between the law that is broken and what broke it.
pub const AFTER: &str = " — after ";

/// Something that a designer does.
#[derive(Clone, Debug)]
pub enum Event {
    /// The pointer moves here, and some screen points beside it.
    Move(Place, DVec2),
    /// A button goes down here.
    Press(Button, Place),
    /// A button goes up where the pointer is.
    Release(Button),
    /// Press and release in one place.
    Click(Button, Place),
    /// Two clicks in quick succession.
    DoubleClick(Place),
    /// Press, move by some screen points in two steps, and release.
    Drag(Button, Place, DVec2),
    /// The pointer leaves the canvas.
    Leave,
    /// The wheel turns.
    Zoom(Place, f64),
    /// Two fingers push the view.
    Pan(DVec2),
    /// A key goes down, with these modifiers held for it: a command's, or the canvas's.
    Key(Modifiers, Key),
    /// A key goes down and repeats some times while it is held.
    Repeat(Modifiers, Key, usize),
    /// These modifiers are held from now on.
    Hold(Modifiers),
    /// The space bar goes down or up.
    Space(bool),
    /// The key of an axis is held, or none is.
    Axis(Option<usize>),
    /// A command is given from a menu.
    Command(Command),
    /// A panel asks for something.
    Panel(Panel),
}

/// Hand events to a window and check after each input.
pub struct Player {
    /// The window.
    pub window: Window,
    watch: Watch,
    /// Where the pointer is.
    pointer: DVec2,
    held: Modifiers,
}

impl Player {
    /// Open a document.
    pub fn new(document: Document) -> Self {
        let window = Window::open(document);
        let watch = Watch::new(&window);
        Self {
            window,
            watch,
            pointer: DVec2::ZERO,
            held: Modifiers::NONE,
        }
    }

    /// Play some events.
    ///
    /// # Errors
    /// What does not hold after one of them, with it.
    pub fn play(&mut self, events: &[Event]) -> Result<(), String> {
        for event in events {
            self.play_one(event)
                .map_err(|error| format!("{error}{AFTER}{event:?}"))?;
        }
        Ok(())
    }

    /// Let go of everything, undo all, redo all and come back, write and read.
    ///
    /// # Errors
    /// What does not hold.
    pub fn settle(&mut self) -> Result<(), String> {
        for button in [Button::Primary, Button::Secondary, Button::Middle] {
            let at = self.pointer;
            self.input(Input::Released { button, at }, Done::Other)?;
        }
        self.input(Input::SpaceHeld(false), Done::Other)?;
        self.hold(Modifiers::NONE)?;
        self.panel(&Panel::Leave)?;
        self.panel(&Panel::CommitField)?;
        self.watch.rewind(&mut self.window)?;
        check_written(self.window.document())
    }

    /// Add the curves of a file.
    ///
    /// # Errors
    /// What does not hold.
    pub fn import(&mut self, file: &Path) -> Result<(), String> {
        self.window.import(file);
        self.watch.check(&self.window, Done::Other)
    }

    /// Save the document, whatever is going on.
    ///
    /// # Errors
    /// What does not hold.
    pub fn save(&mut self, file: &Path) -> Result<(), String> {
        let saved = self.window.save(file);
        saved.map_err(|refusal| format!("not saved: {refusal}"))?;
        self.watch.check(&self.window, Done::Other)
    }

    fn play_one(&mut self, event: &Event) -> Result<(), String> {
        match event {
            Event::Move(place, beside) => {
                let at = place.on_canvas(&mut self.window) + *beside;
                self.move_to(at)
            }
            Event::Press(button, place) => {
                let at = place.on_canvas(&mut self.window);
                self.press(*button, at)
            }
            Event::Release(button) => self.release(*button),
            Event::Click(button, place) => {
                let at = place.on_canvas(&mut self.window);
                self.press(*button, at)?;
                self.release(*button)
            }
            Event::DoubleClick(place) => {
                let at = place.on_canvas(&mut self.window);
                for _ in 0..2 {
                    self.press(Button::Primary, at)?;
                    self.release(Button::Primary)?;
                }
                self.input(Input::DoubleClicked { at }, Done::Other)
            }
            Event::Drag(button, place, by) => {
                let at = place.on_canvas(&mut self.window);
                self.press(*button, at)?;
                self.move_to(at + 0.5 * *by)?;
                self.move_to(at + *by)?;
                self.release(*button)
            }
            Event::Leave => self.input(Input::Left, Done::Other),
            Event::Zoom(place, factor) => {
                let at = place.on_canvas(&mut self.window);
                let factor = *factor;
                self.input(Input::Zoomed { at, factor }, Done::Other)
            }
            Event::Pan(by) => self.input(Input::Panned { by: *by }, Done::Other),
            Event::Key(held, key) => self.press_key(*held, *key, 0),
            Event::Repeat(held, key, times) => self.press_key(*held, *key, *times),
            Event::Hold(held) => self.hold(*held),
            Event::Space(held) => self.input(Input::SpaceHeld(*held), Done::Other),
            Event::Axis(axis) => self.input(Input::AxisHeld(*axis), Done::Other),
            Event::Command(command) => self.command(*command),
            Event::Panel(panel) => self.panel(panel),
        }
    }

    fn input(&mut self, input: Input, done: Done) -> Result<(), String> {
        self.window.input(input);
        self.watch.check(&self.window, done)
    }

    fn move_to(&mut self, at: DVec2) -> Result<(), String> {
        self.pointer = at;
        self.input(Input::Moved { at }, Done::Other)
    }

    fn press(&mut self, button: Button, at: DVec2) -> Result<(), String> {
        self.move_to(at)?;
        self.input(Input::Rested { at }, Done::Other)?;
        self.input(Input::Pressed { button, at }, Done::Other)
    }

    fn release(&mut self, button: Button) -> Result<(), String> {
        let at = self.pointer;
        self.input(Input::Released { button, at }, Done::Other)
    }

    fn hold(&mut self, held: Modifiers) -> Result<(), String> {
        self.held = held;
        self.input(Input::Modifiers(held), Done::Other)
    }

    /// Press a key as a window passes it on: to its command, to a drag as an axis, to the canvas.
    fn press_key(&mut self, modifiers: Modifiers, key: Key, times: usize) -> Result<(), String> {
        let before = self.held;
        if modifiers != before {
            self.hold(modifiers)?;
        }
        let shortcut = Shortcut { modifiers, key };
        let axes = ['x', 'y', 'z'].map(Key::Character);
        let axis = axes.iter().position(|axis| *axis == key);
        let commands = self.window.commands();
        let command = commands
            .into_iter()
            .find(|command| command.shortcut() == Some(shortcut));
        match (command, axis) {
            (_, Some(axis)) if self.window.is_holding() && !modifiers.ctrl => {
                self.input(Input::AxisHeld(Some(axis)), Done::Other)?;
                self.input(Input::AxisHeld(None), Done::Other)?;
            }
            (Some(command), _) => self.command(command)?,
            (None, _) if let Some(asked) = Panel::of_key(shortcut) => self.panel(&asked)?,
            (None, _) => {
                let (pressed, repeated) = match key {
                    Key::Escape => (Done::Escape, Done::Escape),
                    Key::Left | Key::Right | Key::Up | Key::Down => (Done::Transform, Done::Repeat),
                    _ => (Done::Other, Done::Other),
                };
                self.input(Input::Key(key), pressed)?;
                for _ in 0..times {
                    self.input(Input::KeyRepeated(key), repeated)?;
                }
            }
        }
        if modifiers != before {
            self.hold(before)?;
        }
        Ok(())
    }

    fn command(&mut self, command: Command) -> Result<(), String> {
        let is_offered = self.window.is_enabled(command);
        let was_dragging = self.window.is_dragging();
        let names_items = self
            .window
            .message()
            .is_some_and(|text| text.starts_with("Press Del"));
        // A preview that ends brings back the selection before it.
        let selected = match self.window.is_trying() {
            true => usize::MAX,
            false => self.window.selection().items().len(),
        };
        let reply = self.window.execute(command);
        if let Err(refusal) = &reply
            && self.window.message() != Some(&refusal.0)
        {
            return Err(format!("a refusal that is not told: {refusal}"));
        }
        if command.only_shows() && was_dragging && !self.window.is_dragging() {
            return Err("a drag ended by what only shows".into());
        }
        let done = match command {
            _ if !is_offered => Done::Nothing,
            Command::Undo => Done::Undo,
            Command::Redo => Done::Redo,
            Command::Delete if !names_items => Done::Delete,
            Command::Delete | Command::DeleteCurve => Done::DeleteCurves(selected),
            Command::ConvertUnit(_) => Done::Convert,
            Command::Operation(operation) if operation.inputs == Inputs::Two => Done::Join,
            _ => Done::Other,
        };
        self.watch.check(&self.window, done)
    }

    fn is_applied(&self) -> bool {
        self.window.trial().is_some_and(|trial| trial.is_applied())
    }

    fn panel(&mut self, panel: &Panel) -> Result<(), String> {
        if matches!(panel, Panel::PreviewVertex(..) | Panel::PreviewWeight(..)) {
            self.watch.expect_field();
        }
        let (values, is_applied) = (self.window.values(), self.is_applied());
        let draws = self.window.undoes_points();
        let opening = self.window.opening();
        self.window.panel(panel);
        if let Panel::SetAnyValue(..) | Panel::SetValue(..) = panel
            && self.window.values().is_none() != values.is_none()
        {
            return Err("a value ended the operation, or began one".into());
        }
        let done = match panel {
            Panel::SetValue(..) | Panel::SetAnyValue(..) if self.window.values() == values => {
                Done::Look
            }
            Panel::SetValue(..) | Panel::SetAnyValue(..) if is_applied => Done::Amend,
            Panel::Replace(Replacement::MissingFile) => Done::Other,
            Panel::Replace(_) => Done::Replace,
            Panel::File(_) if self.window.opening() != opening => Done::Replace,
            Panel::File(OfFile::Reload) => Done::Reload,
            // Saving ends a drawing.
            Panel::File(OfFile::Save | OfFile::Change(_)) if !draws => Done::Look,
            Panel::Cut => Done::Delete,
            Panel::Transform(_) => Done::Transform,
            _ => Done::Other,
        };
        self.watch.check(&self.window, done)
    }
}
