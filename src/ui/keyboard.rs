//! Keys: from egui's names to the editor's, and to the commands they stand for.

use std::sync::Arc;

use eframe::egui::{self, ColorImage, Context, Event, Id, Rect};

use super::action::Action;
use crate::editor::{Command, Editor, Key, Modifiers, Shortcut};

/// Translate modifier keys.
pub fn modifiers(modifiers: egui::Modifiers) -> Modifiers {
    Modifiers {
        shift: modifiers.shift,
        ctrl: modifiers.command,
        alt: modifiers.alt,
    }
}

/// Translate a key, if the editor knows it.
pub fn key(key: egui::Key) -> Option<Key> {
    use egui::Key as Theirs;
    Some(match key {
        Theirs::Enter => Key::Enter,
        Theirs::Escape => Key::Escape,
        Theirs::Delete => Key::Delete,
        Theirs::Backspace => Key::Backspace,
        Theirs::Tab => Key::Tab,
        Theirs::Space => Key::Space,
        Theirs::ArrowLeft => Key::Left,
        Theirs::ArrowRight => Key::Right,
        Theirs::ArrowUp => Key::Up,
        Theirs::ArrowDown => Key::Down,
        Theirs::Plus | Theirs::Equals => Key::Character('+'),
        Theirs::Minus => Key::Character('-'),
        other => return named_key(other.name()),
    })
}

/// Letters, digits and function keys are known by their names.
fn named_key(name: &str) -> Option<Key> {
    if let Some(number) = name.strip_prefix('F').and_then(|rest| rest.parse().ok()) {
        return Some(Key::Function(number));
    }
    let mut characters = name.chars();
    match (characters.next(), characters.next()) {
        (Some(one), None) if one.is_ascii_alphanumeric() => {
            Some(Key::Character(one.to_ascii_lowercase()))
        }
        _ => None,
    }
}

/// Write a shortcut as menus show it.
pub fn shortcut_text(shortcut: Shortcut) -> String {
    let Modifiers { ctrl, alt, shift } = shortcut.modifiers;
    let control = if cfg!(target_os = "macos") {
        "Cmd"
    } else {
        "Ctrl"
    };
    let held = [(ctrl, control), (alt, "Alt"), (shift, "Shift")];
    let held = held.into_iter().filter(|(is_held, _)| *is_held);
    let mut parts: Vec<String> = held.map(|(_, name)| name.to_owned()).collect();
    parts.push(match shortcut.key {
        Key::Character(character) => character.to_uppercase().to_string(),
        Key::Function(number) => format!("F{number}"),
        Key::Delete => "Del".to_owned(),
        Key::Escape => "Esc".to_owned(),
        // Others are written as they are called.
        key => format!("{key:?}"),
    });
    parts.join("+")
}

/// A name with the key that stands for it.
pub fn with_key(name: &str, shortcut: Option<Shortcut>) -> String {
    let key = shortcut.map(|shortcut| format!(" ({})", shortcut_text(shortcut)));
    format!("{name}{}", key.unwrap_or_default())
}

/// The target of typed keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Typing {
    /// Nothing: they are commands, or the canvas's.
    Nothing,
    /// A cell of a table, where a digit begins a number. It owns plain keys and the clipboard's.
    Cell,
    /// A text that is being edited. It owns plain keys and those that edit texts.
    Text,
}

/// The target of keys in the widget that has the keyboard.
pub fn typing(context: &Context) -> Typing {
    match claimed(context) {
        Some((typing, _)) => typing,
        None if context.text_edit_focused() => Typing::Text,
        None => Typing::Nothing,
    }
}

/// Claim keys for a widget while it has the keyboard. The claim comes before the focus:
/// even the first key is no command then.
pub fn claim(context: &Context, id: Id, typing: Typing, rect: Rect) {
    context.data_mut(|data| data.insert_temp(id, (typing, rect)));
}

/// Where the field or cell is that has the keyboard and takes numbers.
pub fn number_field(context: &Context) -> Option<Rect> {
    Some(claimed(context)?.1)
}

/// The claim of the widget that has the keyboard.
fn claimed(context: &Context) -> Option<(Typing, Rect)> {
    let focused = context.memory(|memory| memory.focused())?;
    context.data(|data| data.get_temp(focused))
}

/// Whether a dialog or menu is open, so that keys are not for the window behind it.
pub fn is_covered(context: &Context) -> bool {
    egui::Popup::is_any_open(context) || context.memory(|memory| memory.top_modal_layer().is_some())
}

/// Whether the menu key is pressed, or Shift and F10, while nothing is typed.
pub fn asks_for_menu(context: &Context) -> bool {
    if is_covered(context) || typing(context) == Typing::Text {
        return false;
    }
    context.input(|input| {
        input.key_pressed(egui::Key::Menu)
            || (input.modifiers.shift && input.key_pressed(egui::Key::F10))
    })
}

/// A command that a key asks for.
pub enum KeyCommand {
    /// An action of the window's table.
    Action(Action),
    /// Paste this text of the clipboard.
    Paste(String),
    /// Paste this picture of the clipboard.
    PastePicture(Arc<ColorImage>),
}

/// Turns keys into commands.
///
/// A key that may steer a drag stands for its command when it is released, unless the pointer was
/// pressed meanwhile.
#[derive(Debug, Default)]
pub struct Keyboard {
    /// The effect of the held key, and the command that waits for its release.
    waiting: Option<(Steering, Action)>,
}

impl KeyCommand {
    /// Whether it counts while something is dragged: what changes curves or takes another tool would come by a slip of
    /// the other hand.
    fn can_be_given_in_a_drag(&self) -> bool {
        match self {
            Self::Action(Action::Command(command)) => {
                command.only_shows() || matches!(command, Command::Undo | Command::Redo)
            }
            Self::Action(action) => !matches!(action, Action::Cut),
            Self::Paste(_) | Self::PastePicture(_) => false,
        }
    }
}

impl Keyboard {
    /// Take the events out of this frame that stand for commands.
    pub fn take_commands(&mut self, context: &Context, editor: &Editor) -> Vec<KeyCommand> {
        if is_covered(context) {
            self.waiting = None;
            return Vec::new();
        }
        let typing = typing(context);
        let holding = editor.hand().is_holding();
        // Digits typed while something is dragged, or while a tool takes numbers, are meant for it.
        let is_number = |shortcut: &Shortcut| {
            shortcut.modifiers == Modifiers::NONE
                && matches!(shortcut.key, Key::Character('0'..='9' | '+' | '-'))
        };
        let takes_numbers = holding || editor.hand().entry(editor.view().viewport()).is_some();
        let table: Vec<(Shortcut, Action)> = Action::all()
            .into_iter()
            .filter_map(|command| Some((command.shortcut()?, command)))
            .filter(|(shortcut, _)| !(takes_numbers && is_number(shortcut)))
            .collect();
        let mut commands = Vec::new();
        context.input_mut(|input| {
            input.events.retain(|event| {
                commands.extend(self.released(event));
                let found = command_of(event, &table, typing);
                let found = found.filter(|it| !holding || it.can_be_given_in_a_drag());
                match (found, steering(event)) {
                    (None, _) => true,
                    (Some(KeyCommand::Action(command)), Some((steering, _))) => {
                        self.waiting = (!holding).then_some((steering, command));
                        true
                    }
                    (Some(found), _) => {
                        commands.push(found);
                        false
                    }
                }
            });
        });
        commands
    }

    /// The command that an event brings to its end of waiting.
    fn released(&mut self, event: &Event) -> Option<KeyCommand> {
        let (waiting, command) = self.waiting?;
        match event {
            Event::PointerButton { pressed: true, .. } | Event::WindowFocused(false) => {
                self.waiting = None;
                None
            }
            _ if steering(event) == Some((waiting, false)) => {
                self.waiting = None;
                Some(KeyCommand::Action(command))
            }
            _ => None,
        }
    }
}

/// The effect of a held key on a drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steering {
    /// It keeps the drag to an axis of the model: 0 x, 1 y, 2 z.
    Axis(usize),
    /// It turns round whether features are kept.
    Features,
}

/// The effect of an event's key on a drag, and whether it is held.
pub fn steering(event: &Event) -> Option<(Steering, bool)> {
    let Event::Key {
        key,
        pressed,
        modifiers,
        ..
    } = event
    else {
        return None;
    };
    if *pressed && modifiers.command {
        return None;
    }
    let steering = match key {
        egui::Key::X => Steering::Axis(0),
        egui::Key::Y => Steering::Axis(1),
        egui::Key::Z => Steering::Axis(2),
        egui::Key::K => Steering::Features,
        _ => return None,
    };
    Some((steering, *pressed))
}

fn command_of(event: &Event, table: &[(Shortcut, Action)], typing: Typing) -> Option<KeyCommand> {
    let is_free = typing == Typing::Nothing;
    match event {
        Event::Copy if is_free => Some(KeyCommand::Action(Action::Copy)),
        Event::Cut if is_free => Some(KeyCommand::Action(Action::Cut)),
        Event::Paste(text) if is_free => Some(KeyCommand::Paste(text.clone())),
        Event::PasteImage(image) if is_free => Some(KeyCommand::PastePicture(image.clone())),
        Event::Key {
            key: pressed,
            pressed: true,
            repeat,
            modifiers: held,
            ..
        } => {
            let shortcut = pressed_shortcut(*pressed, *held)?;
            let found = table.iter().find(|(keys, _)| *keys == shortcut);
            let command = found.map(|(_, command)| *command);
            let command = command.or_else(|| alias(shortcut))?;
            let repeats = matches!(
                command,
                Action::Command(Command::Undo | Command::Redo | Command::ZoomIn | Command::ZoomOut)
            );
            let is_mine = !belongs_to(typing, shortcut);
            (is_mine && (repeats || !repeat)).then_some(KeyCommand::Action(command))
        }
        _ => None,
    }
}

fn pressed_shortcut(pressed: egui::Key, held: egui::Modifiers) -> Option<Shortcut> {
    let mut shortcut = Shortcut {
        modifiers: modifiers(held),
        key: key(pressed)?,
    };
    if shortcut.key == Key::Character('+') {
        // Plus needs shift on many keyboards.
        shortcut.modifiers.shift = false;
    }
    Some(shortcut)
}

/// Keys that people know from elsewhere.
fn alias(shortcut: Shortcut) -> Option<Action> {
    (shortcut == Shortcut::ctrl('y')).then_some(Command::Redo.into())
}

/// Whether the text being edited needs the key.
fn belongs_to(typing: Typing, shortcut: Shortcut) -> bool {
    let edits: &[char] = match typing {
        Typing::Nothing => return false,
        Typing::Cell => &['x', 'c', 'v'],
        Typing::Text => &['z', 'y', 'x', 'c', 'v', 'a'],
    };
    match shortcut.key {
        // Another name could be begun while one is typed.
        Key::Function(2) => typing == Typing::Text,
        Key::Function(_) => false,
        Key::Character(letter) if shortcut.modifiers.ctrl => edits.contains(&letter),
        _ => !shortcut.modifiers.ctrl,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_the_editors_names() {
        assert_eq!(key(egui::Key::A), Some(Key::Character('a')));
        assert_eq!(key(egui::Key::Num7), Some(Key::Character('7')));
        assert_eq!(key(egui::Key::F9), Some(Key::Function(9)));
        assert_eq!(key(egui::Key::F), Some(Key::Character('f')));
        assert_eq!(key(egui::Key::Equals), Some(Key::Character('+')));
        assert_eq!(key(egui::Key::Home), None);
    }

    #[test]
    fn every_command_has_a_key_of_its_own() {
        let commands = Action::all();
        let keys: Vec<Shortcut> = commands
            .iter()
            .filter_map(|command| command.shortcut())
            .collect();
        for (index, shortcut) in keys.iter().enumerate() {
            assert!(
                !keys[..index].contains(shortcut),
                "{}",
                shortcut_text(*shortcut)
            );
        }
    }
}
