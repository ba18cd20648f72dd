//! The editor's message, in the canvas's corner above the status bar.

use std::time::Duration;

use eframe::egui::{Align2, Context, Frame, Label, Rect, RichText, ScrollArea, Stroke, vec2};
use lucide_icons::Icon;

use super::action::Action;
use super::icons;
use super::theme::{STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::editor::{Command, Editor};

/// The widest that a message gets before it wraps.
const WIDTH: f32 = 460.0;

/// The tallest that its text gets before it scrolls: some eight lines.
const TALLEST: f32 = 130.0;

/// How often the progress of a task is shown anew.
const REFRESH: Duration = Duration::from_millis(200);

/// Begin a text with a capital: those of the command line do not. Names of files stay.
pub fn sentence(text: &str) -> String {
    let first = text.split(' ').next().unwrap_or_default();
    let is_word = first.chars().all(char::is_alphabetic);
    let mut letters = text.chars();
    match letters.next().filter(|_| is_word) {
        Some(letter) => letter.to_uppercase().chain(letters).collect(),
        None => text.to_owned(),
    }
}

/// Show the message, if there is one, until it is dismissed or something else is done.
pub fn message_ui(
    context: &Context,
    canvas: Rect,
    editor: &mut Editor,
    commands: &mut Vec<Action>,
) {
    let Some(message) = editor.message().cloned() else {
        return;
    };
    let work = editor.filing().work();
    let is_of_work = work.is_some_and(|work| work.text == message.text);
    let read = editor.filing().reading().filter(|_| is_of_work);
    let text = match read {
        Some(share) if share > 0.0 => format!("{} {:.0} %", message.text, 100.0 * share),
        _ => message.text.clone(),
    };
    if read.is_some() {
        context.request_repaint_after(REFRESH);
    }
    let mut is_stopped = false;
    let corner = canvas.left_bottom() + vec2(6.0 * STEP, -6.0 * STEP);
    let place = (Align2::LEFT_BOTTOM, corner);
    let dismissed = widgets::overlay(context, "message", place, |ui| {
        let tokens = Tokens::of(ui);
        let (icon, colour, outline) = match (message.is_error, message.warns) {
            (true, _) => (Icon::TriangleAlert, tokens.error, tokens.error),
            (false, true) => (Icon::TriangleAlert, tokens.warning, tokens.outline),
            (false, false) => (Icon::Info, tokens.faint_text, tokens.outline),
        };
        let frame = Frame::popup(ui.style()).stroke(Stroke::new(1.0, outline));
        let shown = frame.inner_margin(2.0 * STEP).show(ui, |ui| {
            let width = WIDTH.min(canvas.width() - 8.0 * STEP).max(120.0);
            ui.set_max_width(width);
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0 * STEP;
                ui.add_space(0.0);
                ui.label(icons::text(icon).color(colour));
                ui.vertical(|ui| {
                    let offers = [
                        message.offers_undo,
                        message.offers_reload,
                        message.offers_choice,
                        read.is_some(),
                    ];
                    let buttons = offers.into_iter().filter(|it| *it).count();
                    ui.set_max_width(width - (18.0 + 14.0 * buttons as f32) * STEP);
                    let text = RichText::new(sentence(&text)).color(tokens.text);
                    let lines = ScrollArea::vertical().max_height(TALLEST);
                    lines.show(ui, |ui| ui.add(Label::new(text).wrap().selectable(true)));
                });
                if message.offers_undo && ui.small_button("Undo").clicked() {
                    commands.push(Command::Undo.into());
                }
                if message.offers_reload && ui.small_button("Reload").clicked() {
                    commands.push(Action::Reload);
                }
                if message.offers_choice && ui.small_button("Choose…").clicked() {
                    commands.push(Action::ChooseImport);
                }
                if read.is_some() {
                    is_stopped = ui.small_button("Stop").clicked();
                }
                IconButton::new(Icon::X, "Dismiss message")
                    .size(5.0 * STEP)
                    .show(ui)
                    .clicked()
            })
            .inner
        });
        shown.inner
    });
    if is_stopped {
        editor.filing_mut().stop_reading();
    }
    if is_stopped || dismissed.inner {
        editor.dismiss_message();
    }
}

#[cfg(test)]
mod tests {
    use super::sentence;

    #[test]
    fn messages_begin_with_a_capital_and_files_keep_their_names() {
        for (text, expected) in [
            ("the degree is 1 already", "The degree is 1 already"),
            ("hull.batten: no such file", "hull.batten: no such file"),
            ("/tmp/hull: no such file", "/tmp/hull: no such file"),
            ("“a” is locked", "“a” is locked"),
            ("2 curves exported", "2 curves exported"),
            ("", ""),
        ] {
            assert_eq!(sentence(text), expected);
        }
    }
}
