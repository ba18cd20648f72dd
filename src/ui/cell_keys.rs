//! The meaning of keys while a cell of a table has the keyboard.

use eframe::egui::{Event, Key, Modifiers, Ui};

/// Where the keyboard goes from a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// To the row above.
    Up,
    /// To the row below.
    Down,
    /// To the column at the left.
    Left,
    /// To the column at the right.
    Right,
    /// To the right, and from the last column to the next row.
    Next,
    /// To the left, and from the first column to the row before.
    Previous,
    /// As many rows up as are in sight.
    PageUp,
    /// As many rows down as are in sight.
    PageDown,
    /// To the row's first column.
    RowStart,
    /// To the row's last column.
    RowEnd,
    /// To the first row.
    First,
    /// To the last row.
    Last,
}

/// The effect of a key on a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CellKey {
    /// Take the number that is being typed, and go on.
    Step(Step),
    /// Edit the number as it stands.
    Edit,
    /// Replace the number by the next text.
    Replace,
    /// Copy the number.
    Copy,
    /// Put a text in the number's place.
    Paste(String),
    /// Call the edit off; without one, leave the table.
    Escape,
}

/// Take this frame's keys for a cell that is not being edited, in order. What follows one that
/// begins an edit is left to the text field.
pub fn for_cell(ui: &Ui) -> Vec<CellKey> {
    take(ui, true)
}

/// Take the key out of this frame that ends the edit of a cell, if there is one.
pub fn for_text(ui: &Ui) -> Option<CellKey> {
    take(ui, false).pop()
}

fn take(ui: &Ui, is_idle: bool) -> Vec<CellKey> {
    let mut keys = Vec::new();
    let mut is_over = false;
    ui.input_mut(|input| {
        input.events.retain(|event| {
            if is_over {
                return true;
            }
            let key = match event {
                Event::Text(text) if is_idle && begins_number(text) => Some(CellKey::Replace),
                Event::Text(text) if is_idle && text == " " => Some(CellKey::Edit),
                Event::Copy | Event::Cut if is_idle => Some(CellKey::Copy),
                Event::Paste(text) if is_idle => Some(CellKey::Paste(text.clone())),
                _ => key_of(event, is_idle),
            };
            // The text that begins a number is the field's first.
            let stays = matches!(event, Event::Text(text) if text != " ");
            let begins = matches!(key, Some(CellKey::Replace | CellKey::Edit));
            is_over = key.is_some() && (begins || !is_idle);
            let is_taken = key.is_some();
            keys.extend(key);
            !is_taken || stays
        });
    });
    keys
}

fn begins_number(text: &str) -> bool {
    let first = text.chars().next();
    first.is_some_and(|first| first.is_ascii_alphanumeric() || "+-−.,*/(π".contains(first))
}

/// The meaning of a key; keys that a text needs count only while there is none.
fn key_of(event: &Event, is_idle: bool) -> Option<CellKey> {
    let Event::Key {
        key,
        pressed: true,
        modifiers,
        ..
    } = event
    else {
        return None;
    };
    let plain = !modifiers.any();
    let step = match key {
        Key::Escape if plain => return Some(CellKey::Escape),
        Key::Backspace if plain && is_idle => return Some(CellKey::Replace),
        Key::Enter if plain => Step::Down,
        Key::Tab if plain => Step::Next,
        Key::Enter if modifiers.shift_only() => Step::Up,
        Key::Tab if modifiers.shift_only() => Step::Previous,
        Key::ArrowUp if plain => Step::Up,
        Key::ArrowDown if plain => Step::Down,
        Key::PageUp if plain => Step::PageUp,
        Key::PageDown if plain => Step::PageDown,
        _ if is_idle => idle_step(*key, *modifiers)?,
        _ => return None,
    };
    Some(CellKey::Step(step))
}

fn idle_step(key: Key, modifiers: Modifiers) -> Option<Step> {
    let plain = !modifiers.any();
    let ctrl = modifiers.command_only();
    Some(match key {
        Key::ArrowLeft if plain => Step::Left,
        Key::ArrowRight if plain => Step::Right,
        Key::Home if plain => Step::RowStart,
        Key::End if plain => Step::RowEnd,
        Key::Home if ctrl => Step::First,
        Key::End if ctrl => Step::Last,
        _ => return None,
    })
}
