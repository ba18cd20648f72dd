//! Keys in the order in which they were pressed, though several come in one frame.

use eframe::egui::{Context, Event, Key, Plugin, RawInput, Rect, Ui};

use super::canvas;
use super::keyboard::{self, Typing};

/// Let whatever follows an event that moves the keyboard's focus wait for another pass of the same
/// frame, when the focus is there: a digit typed right after a click on a field is the field's.
///
/// A press outside the field that has the keyboard waits too, until the field has given up its
/// number: the number then belongs to the curve it was typed for, whatever the press makes active.
#[derive(Default)]
pub struct KeyOrder {
    waiting: Vec<Event>,
}

impl Plugin for KeyOrder {
    fn debug_name(&self) -> &'static str {
        "key order"
    }

    fn input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let mut events = std::mem::take(&mut self.waiting);
        events.append(&mut input.events);
        let mut end = events.len();
        if let Some(field) = keyboard::number_field(context)
            && let Some(press) = events.iter().position(|event| presses_beside(event, field))
        {
            if !events.iter().take(press).any(is_key) {
                context.memory_mut(|memory| memory.request_focus(canvas::id()));
            }
            end = press;
        }
        let is_free = keyboard::typing(context) == Typing::Nothing;
        let held = context.input(|input| input.keys_down.iter().copied().collect::<Vec<Key>>());
        end = end_of_pass(events.get(..end).unwrap_or_default(), is_free, &held);
        self.waiting = events.split_off(end);
        drop_repeats(&events, &mut self.waiting);
        input.events = events;
    }

    fn on_end_pass(&mut self, ui: &mut Ui) {
        if !self.waiting.is_empty() {
            // The next pass comes in this frame; what still waits then, in the next frame.
            ui.ctx().request_discard("events wait for the keyboard");
            ui.ctx().request_repaint();
        }
    }
}

fn presses_beside(event: &Event, field: Rect) -> bool {
    matches!(event, Event::PointerButton { pos, pressed: true, .. } if !field.contains(*pos))
}

/// How many of the events belong to this pass. Where nothing is typed into, letters are commands:
/// one may take a tool to which the digits after it belong. A letter that was held before only repeats.
fn end_of_pass(events: &[Event], is_free: bool, held: &[Key]) -> usize {
    let takes_tool = |event: &Event| is_free && letter(event).is_some_and(|it| !held.contains(&it));
    let moved = events
        .iter()
        .position(|it| moves_keyboard(it) || takes_tool(it));
    let next = moved.and_then(|moved| {
        // A letter's own text comes right after it.
        let is_next = |event: &Event| match event {
            Event::Text(_) => !events.get(moved).is_some_and(takes_tool),
            event => is_key(event),
        };
        let mut later = events.iter().enumerate().skip(moved + 1);
        later.find(|(_, event)| is_next(event))
    });
    next.map_or(events.len(), |(place, _)| place)
}

/// The letter that an event presses.
fn letter(event: &Event) -> Option<Key> {
    let Event::Key {
        key, pressed: true, ..
    } = event
    else {
        return None;
    };
    let name = key.name();
    let is_letter = name.len() == 1 && name.chars().all(|letter| letter.is_ascii_alphabetic());
    is_letter.then_some(*key)
}

/// Whether an event may give the keyboard to another widget, or to another cell of a table.
fn moves_keyboard(event: &Event) -> bool {
    match event {
        Event::PointerButton { .. } => true,
        Event::Key {
            key, pressed: true, ..
        } => matches!(
            key,
            Key::Enter | Key::Tab | Key::Escape | Key::F6 | Key::ArrowUp | Key::ArrowDown
        ),
        _ => false,
    }
}

fn is_key(event: &Event) -> bool {
    match event {
        Event::Key { pressed, .. } => *pressed,
        Event::Text(_) | Event::Paste(_) | Event::PasteImage(_) | Event::Copy | Event::Cut => true,
        _ => false,
    }
}

/// Drop repeats of a held key that outrun the frames: they would continue after its release.
fn drop_repeats(shown: &[Event], waiting: &mut Vec<Event>) {
    let mut held: Vec<Key> = Vec::new();
    let mut is_repeat = |event: &Event| {
        let Event::Key { key, pressed, .. } = event else {
            return false;
        };
        let was_held = held.contains(key);
        if *pressed && !was_held {
            held.push(*key);
        } else if !*pressed {
            held.retain(|other| other != key);
        }
        *pressed && was_held && moves_keyboard(event)
    };
    for event in shown {
        is_repeat(event);
    }
    waiting.retain(|event| !is_repeat(event));
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Modifiers;

    fn key(key: Key, pressed: bool) -> Event {
        Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        }
    }

    #[test]
    fn what_follows_enter_waits_and_its_release_does_not() {
        let text = |text: &str| Event::Text(text.to_owned());
        let events = [
            text("1"),
            key(Key::Enter, true),
            key(Key::Enter, false),
            text("2"),
            key(Key::Enter, true),
        ];
        assert_eq!(end_of_pass(&events, false, &[]), 3);
        assert_eq!(end_of_pass(&events[..3], false, &[]), 3);
        assert_eq!(end_of_pass(&events[3..], false, &[]), 2);
    }

    #[test]
    fn a_letter_that_is_held_lets_nothing_wait() {
        let press = || [key(Key::X, true), Event::Text("x".to_owned())];
        let events: Vec<Event> = [press(), press(), press()].into_iter().flatten().collect();
        assert_eq!(end_of_pass(&events, true, &[Key::X]), 6);
        assert_eq!(end_of_pass(&events, true, &[Key::Y]), 2);
    }

    #[test]
    fn digits_wait_for_the_tool_that_a_letter_takes() {
        let text = |text: &str| Event::Text(text.to_owned());
        let events = [
            key(Key::D, true),
            text("d"),
            key(Key::D, false),
            key(Key::Num5, true),
            text("5"),
        ];
        assert_eq!(end_of_pass(&events, true, &[]), 3);
        assert_eq!(end_of_pass(&events, false, &[]), 5);
    }

    #[test]
    fn repeats_of_a_held_key_do_not_pile_up_but_presses_do() {
        let press = key(Key::Enter, true);
        let mut waiting = vec![press.clone(), press.clone()];
        drop_repeats(std::slice::from_ref(&press), &mut waiting);
        assert!(waiting.is_empty());
        let mut waiting = vec![key(Key::Enter, false), press.clone()];
        drop_repeats(&[press], &mut waiting);
        assert_eq!(waiting.len(), 2);
    }
}
