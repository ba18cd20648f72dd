//! The command palette: find a command by typing a part of its name.

use eframe::egui::{
    Align2, Area, Context, Frame, Id, Key, Modifiers, Order, Response, Role, ScrollArea, Sense,
    TextEdit, Ui, Vec2, WidgetInfo, vec2,
};
use nucleo_matcher::pattern::{AtomKind, CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};

use super::action::Action;
use super::menu::compared;
use super::menu_item::beside;
use super::theme::{self, ROW, STEP, Tokens};
use super::{icons, widgets};
use crate::editor::{Command, Editor};

const WIDTH: f32 = 440.0;

/// The height of the help for the chosen command: two lines.
const HELP: f32 = 9.0 * STEP;

/// The palette, when it is open.
#[derive(Default)]
pub struct Palette {
    open: bool,
    /// Whether it was opened in this frame, so that the field takes the keyboard.
    fresh: bool,
    typed: String,
    chosen: usize,
}

impl Palette {
    /// Open it, empty.
    pub fn open(&mut self) {
        *self = Self {
            open: true,
            fresh: true,
            ..Self::default()
        };
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Show it over the canvas, if it is open.
    pub fn show(&mut self, context: &Context, editor: &Editor, commands: &mut Vec<Action>) {
        if !self.open {
            return;
        }
        let area = Area::new(Id::unique("palette"))
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, Vec2::new(0.0, 72.0));
        let shown = area.show(context, |ui| {
            let frame = Frame::popup(ui.style()).inner_margin(2.0 * STEP);
            frame.show(ui, |ui| {
                ui.set_width(WIDTH);
                self.contents_ui(ui, editor)
            })
        });
        let chosen = shown.inner.inner;
        let is_left = shown.response.clicked_elsewhere() && !self.fresh;
        self.open &= chosen.is_none() && !is_left;
        commands.extend(chosen);
        self.fresh = false;
    }

    fn contents_ui(&mut self, ui: &mut Ui, editor: &Editor) -> Option<Action> {
        let (steps, is_entered, is_left) = ui.input_mut(|input| {
            let mut count = |key| input.count_and_consume_key(Modifiers::NONE, key) as i64;
            let steps = count(Key::ArrowDown) - count(Key::ArrowUp);
            (steps, count(Key::Enter) > 0, count(Key::Escape) > 0)
        });
        let field = TextEdit::singleline(&mut self.typed)
            .hint_text("Find a command")
            .desired_width(f32::INFINITY)
            .min_size(Vec2::new(0.0, 32.0))
            .align(Align2::LEFT_CENTER);
        let field = ui.add(field).accessible_name("Find a command");
        field.request_focus();
        if field.changed() {
            self.chosen = 0;
        }
        let found = matches(&self.typed, editor);
        self.open &= !is_left;
        let moved = self.chosen as i64 + steps;
        self.chosen = moved.clamp(0, found.len().max(1) as i64 - 1) as usize;
        let by_key = found.get(self.chosen).copied().filter(|_| is_entered);
        let by_hand = self.list_ui(ui, editor, &found, steps != 0);
        let chosen = found.get(self.chosen);
        let help = |action: &Action| action.refusal(editor).unwrap_or_else(|| action.tooltip());
        help_ui(ui, &chosen.map(help).unwrap_or_default());
        by_key
            .or(by_hand)
            .filter(|action| action.is_enabled(editor))
    }

    fn list_ui(
        &mut self,
        ui: &mut Ui,
        editor: &Editor,
        found: &[Action],
        follow: bool,
    ) -> Option<Action> {
        if found.is_empty() {
            widgets::note(ui, "No matching command. Try another word.");
        }
        let mut clicked = None;
        // A list in a window of its own would otherwise grow by a little each frame.
        ScrollArea::vertical()
            .max_height(12.0 * ROW)
            .min_scrolled_height(12.0 * ROW)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                for (index, action) in found.iter().enumerate() {
                    let response = row_ui(ui, editor, *action, index == self.chosen);
                    if index == self.chosen && follow {
                        response.scroll_to_me(None);
                    }
                    if response.clicked() {
                        clicked = Some(*action);
                    }
                }
            });
        clicked
    }
}

fn row_ui(ui: &mut Ui, editor: &Editor, action: Action, chosen: bool) -> Response {
    let enabled = action.is_enabled(editor);
    let (rect, response) = widgets::row(ui, Sense::click(), chosen);
    let tokens = Tokens::of(ui);
    let colour = match (enabled, chosen) {
        (false, _) => tokens.faint_text,
        (true, true) => tokens.strong_text,
        (true, false) => tokens.text,
    };
    let inner = rect.shrink2(Vec2::new(2.0 * STEP, 0.0));
    if let Some(icon) = icons::of_action(action) {
        let place = inner.with_max_x(inner.left() + theme::ICON);
        widgets::icon(ui, place, icon, colour);
    }
    let label = inner.with_min_x(inner.left() + 7.0 * STEP);
    let title = action.title_now(editor);
    widgets::label_in(ui, label, &title, colour);
    if let Some(text) = beside(action, editor) {
        let (align, font) = (Align2::RIGHT_CENTER, theme::small_font());
        widgets::text_in(ui, inner, align, text, font, tokens.faint_text);
    }
    let name = match action.foreseen(editor) {
        Some(foreseen) => format!("{title} {foreseen}"),
        None => title,
    };
    response.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, enabled, chosen, &name));
    response.on_hover_text(action.tooltip_now(editor))
}

/// What the chosen command does, or why it is not available, in room for two lines.
fn help_ui(ui: &mut Ui, text: &str) {
    let size = vec2(ui.available_width(), HELP);
    ui.allocate_ui(size, |ui| {
        ui.set_min_size(size);
        widgets::note(ui, text);
    });
}

/// The commands whose names hold the typed words, best first, or else those whose tooltips do, or whose names resemble
/// them; those that are available before others. All of them without a text.
fn matches(typed: &str, editor: &Editor) -> Vec<Action> {
    let mut all = Action::all();
    if typed.trim().is_empty() {
        return all;
    }
    all.extend(compared(editor).map(Action::from));
    let ways: [(Text, AtomKind); 3] = [
        (Action::words, AtomKind::Substring),
        (|action, _| action.tooltip(), AtomKind::Substring),
        (Action::words, AtomKind::Fuzzy),
    ];
    let found = ways.map(|(text, kind)| scored(&all, typed, |action| text(action, editor), kind));
    let mut found = found.into_iter().filter(|found| !found.is_empty());
    let mut found = found.next().unwrap_or_default();
    found.sort_by_key(|action| !action.is_enabled(editor));
    found
}

/// A text that is searched for what is typed.
type Text = fn(Action, &Editor) -> String;

/// The commands with a text that resembles the typed one, best first.
fn scored(
    all: &[Action],
    typed: &str,
    text: impl Fn(Action) -> String,
    kind: AtomKind,
) -> Vec<Action> {
    let mut matcher = Matcher::new(Config::DEFAULT);
    let pattern = Pattern::new(typed, CaseMatching::Ignore, Normalization::Smart, kind);
    let mut buffer = Vec::new();
    let mut scored: Vec<_> = all
        .iter()
        .copied()
        .filter_map(|action| {
            let label = action.label();
            let words = text(action);
            let score = pattern.score(Utf32Str::new(&words, &mut buffer), &mut matcher)?;
            // The whole name before all others. Of two that match as well, what works on the document is meant
            // and does something, operations first, then the shorter name, then the one that begins so.
            let is_part = !label.eq_ignore_ascii_case(typed.trim());
            let lower = label.to_lowercase();
            let is_later = !lower.starts_with(&typed.trim().to_lowercase());
            let is_aside = matches!(
                action,
                Action::OpenExample(_) | Action::Command(Command::Compare(None))
            );
            let is_other = !matches!(action, Action::Command(Command::Operation(_)));
            let score = std::cmp::Reverse(score);
            let length = label.chars().count();
            let rank = (is_part, score, is_aside, is_other, length, is_later);
            Some((rank, action))
        })
        .collect();
    scored.sort_by_key(|(rank, _)| *rank);
    scored.into_iter().map(|(_, action)| action).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operations;
    use crate::ui::action::OTHER_WORDS;

    #[test]
    fn of_names_that_match_as_well_the_shorter_one_comes_first_then_the_one_that_begins_so() {
        let editor = Editor::default();
        let first = |typed: &str| matches(typed, &editor).first().map(|it| it.label());
        let told = ["comb", "picture"].map(|typed| first(typed).unwrap_or_default());
        assert_eq!(told, ["Curvature comb", "Picture to trace…"]);
    }

    #[test]
    fn other_words_name_operations_that_there_are() {
        for (name, _) in OTHER_WORDS {
            assert!(operations::find(name).is_some(), "{name}");
        }
    }

    #[test]
    fn other_words_for_a_command_find_it() {
        let editor = Editor::default();
        let found = |typed: &str| {
            let found = matches(typed, &editor).into_iter();
            found.map(|it| it.label()).collect::<Vec<_>>()
        };
        for (typed, label) in [
            ("two views", "Two panes"),
            ("deviation", "Compare with nothing"),
            ("flip", "Mirror…"),
            ("unhide", "Show all curves"),
            ("zoom to fit", "Fit all"),
        ] {
            assert_eq!(
                found(typed).first().map(String::as_str),
                Some(label),
                "{typed}"
            );
        }
    }
}
