//! The panel of the tools that take a typed point, angle or factor: what they draw, their pivot, and the field that
//! digits typed on the canvas go to.

use eframe::egui::{Button, Context, Event, Id, Key, Rect, TextEdit, Ui, vec2};
use glam::DVec2;
use lucide_icons::Icon;

use super::canvas::{self, Canvas};
use super::draft::{remark_ui, select_all};
use super::keyboard::{self, Typing};
use super::message::sentence;
use super::number_field::NumberField;
use super::theme::{self, ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use super::{figures, item_fields};
use crate::editor::{
    Command, DrawSettings, DrawWay, Editor, Entry, EntryError, Input, Key as EditorKey, LegLocks,
    ToolKind, told,
};
use crate::geometry::MAX_DEGREE;
use crate::geometry::parameters::Quantity;

/// What texts begin with that are numbers or points.
const BEGINNINGS: [char; 5] = ['-', '−', '.', '@', '('];

/// The widths of the degree's field and of the figures.
const DEGREE: f32 = 48.0;
const FIGURE: f32 = 96.0;

/// The panel, with the text that is typed.
#[derive(Debug, Default)]
pub struct ToolPanel {
    text: String,
    error: Option<EntryError>,
    /// Whether the field had the keyboard in the last frame.
    is_typed: bool,
    rect: Option<Rect>,
}

/// The identity of the field.
fn id() -> Id {
    Id::unique("typed entry")
}

impl ToolPanel {
    /// Give the keyboard to the field when something is typed on the canvas that the tool takes. Returns whether it
    /// did. Called before keys are looked at as commands.
    pub fn take_keys(&mut self, context: &Context, editor: &Editor, canvas: &Canvas) -> bool {
        let takes_text = editor.hand().entry(editor.view().viewport()).is_some();
        if !takes_text || !canvas.has_keyboard(context) {
            return false;
        }
        let begins = |event: &Event| matches!(event, Event::Text(text) if begins(text));
        let takes = context.input(|input| input.events.iter().any(begins));
        if takes {
            self.text.clear();
            self.error = None;
            let rect = self.rect.unwrap_or(Rect::NOTHING);
            keyboard::claim(context, id(), Typing::Text, rect);
            context.memory_mut(|memory| memory.request_focus(id()));
        }
        takes
    }

    /// Show the fields of the tool in the hand.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let Some(entry) = editor.hand().entry(editor.view().viewport()) else {
            *self = Self::default();
            return;
        };
        ui.strong(editor.hand().tool().label());
        draw_way_ui(ui, editor);
        match entry {
            Entry::Point(_) => {
                if editor.hand().draw_settings().way != DrawWay::Points {
                    degree_ui(ui, editor);
                }
                widgets::form_row(ui, "Point", |ui| self.entry_ui(ui, editor, entry, 0.0));
                leg_ui(ui, editor);
                edges_ui(ui, editor);
            }
            Entry::Angle | Entry::Factor => {
                pivot_ui(ui, editor);
                let [caption, apply] = match entry {
                    Entry::Angle => ["Angle", "Apply rotation"],
                    _ => ["Factor", "Apply scaling"],
                };
                widgets::form_row(ui, caption, |ui| self.applied_ui(ui, editor, entry, apply));
            }
        }
    }

    /// Drop what is typed and shown, while something else stands in the panel's place.
    pub fn hide(&mut self, editor: &mut Editor) {
        if std::mem::take(&mut self.is_typed) {
            editor.type_entry("");
        }
    }

    /// The field with a button beside it.
    fn applied_ui(&mut self, ui: &mut Ui, editor: &mut Editor, entry: Entry, name: &str) {
        let is_ready = editor.hand().pivot(&editor.context()).is_some();
        let can_apply = is_ready && !self.text.trim().is_empty();
        let width = 14.0 * STEP;
        self.entry_ui(ui, editor, entry, width + ui.spacing().item_spacing.x);
        let button = Button::new("Apply").min_size(vec2(width, ROW));
        let response = ui.add_enabled(can_apply, button).accessible_name(name);
        if response.clicked() {
            self.enter(ui, editor);
        }
    }

    /// The field, as wide as there is room beside other widgets of a width.
    fn entry_ui(&mut self, ui: &mut Ui, editor: &mut Editor, entry: Entry, beside: f32) {
        let (name, hint) = words(entry);
        let (_, rect) = ui.allocate_space(vec2(ui.available_width() - beside, ROW));
        self.rect = Some(rect);
        keyboard::claim(ui.ctx(), id(), Typing::Text, rect);
        let tokens = Tokens::of(ui);
        let edit = TextEdit::singleline(&mut self.text)
            .id(id())
            .font(theme::number_font())
            .hint_text(hint)
            .text_color(match self.error {
                None => tokens.strong_text,
                Some(_) => tokens.error,
            })
            .return_key(None)
            .min_size(rect.size())
            .desired_width(rect.width());
        let response = ui.put(rect, edit);
        let context = ui.ctx();
        context.accesskit_node_builder(id(), |node| node.set_label(name));
        if response.changed() {
            self.error = None;
        }
        if let Some(error) = &self.error {
            remark_ui(ui, id(), rect, &sentence(&error.to_string()));
        }
        self.follow_keyboard(ui, editor, response.has_focus());
    }

    /// Preview the text, apply it on Enter, and return the keyboard to the canvas after that and on Esc.
    fn follow_keyboard(&mut self, ui: &Ui, editor: &mut Editor, has_keyboard: bool) {
        let was_typed = std::mem::replace(&mut self.is_typed, has_keyboard);
        if has_keyboard && ui.input(|input| input.key_pressed(Key::Enter)) {
            return self.enter(ui, editor);
        }
        let text = if has_keyboard { self.text.as_str() } else { "" };
        if editor.type_entry(text) {
            // The text moves the leg in progress, which this frame may have shown already.
            ui.ctx().request_repaint();
        }
        let called_off = || ui.input(|input| input.key_pressed(Key::Escape));
        if was_typed && !has_keyboard && called_off() {
            self.text.clear();
            self.error = None;
        }
    }

    fn enter(&mut self, ui: &Ui, editor: &mut Editor) {
        let is_empty = self.text.trim().is_empty();
        if is_empty {
            // As on the canvas, it ends the drawing.
            editor.input(Input::Key(EditorKey::Enter));
        }
        let entered = if is_empty {
            Ok(())
        } else {
            editor.enter(&self.text)
        };
        match entered {
            Ok(()) => {
                *self = Self {
                    rect: self.rect,
                    ..Self::default()
                };
                editor.type_entry("");
                ui.memory_mut(|memory| memory.request_focus(canvas::id()));
            }
            Err(error) => {
                // What is typed next takes the place of a point that is refused.
                if matches!(error, EntryError::Refused(_)) {
                    select_all(ui.ctx(), id(), &self.text);
                }
                self.error = Some(error);
            }
        }
        ui.ctx().request_repaint();
    }
}

fn begins(text: &str) -> bool {
    let first = text.chars().next();
    first.is_some_and(|first| first.is_ascii_digit() || BEGINNINGS.contains(&first))
}

/// The name of the field and its hint.
fn words(entry: Entry) -> (&'static str, String) {
    match entry {
        Entry::Point([x, y]) => ("typed point", format!("{x},{y}  @d{x},d{y}  @l<a")),
        Entry::Angle => ("typed angle", "degrees".to_owned()),
        Entry::Factor => ("typed factor", "such as 1.5".to_owned()),
    }
}

/// Length and angle of the leg that is drawn.
fn leg_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(locks) = editor.hand().leg_locks() else {
        return;
    };
    let leg = editor.hand().leg(&editor.context());
    let pixel = editor.view().viewport().pixel();
    let length = leg.map(|leg| leg.length);
    let shown = |value| figures::to_resolution(value, 0.1 * pixel);
    let words = ("Length", "leg length", Quantity::Length);
    let length = figure_ui(ui, words, (locks.length, length), shown);
    let degrees = leg.and_then(|leg| leg.degrees);
    let shown = |value| format!("{}°", figures::to_resolution(value, 0.01));
    let words = ("Angle", "leg angle", Quantity::Angle);
    let degrees = figure_ui(ui, words, (locks.degrees, degrees), shown);
    let new = LegLocks { length, degrees };
    if new != locks {
        editor.hand_mut().lock_leg(new);
    }
}

/// Whether clicks snap to the edges of pictures, where there are any.
fn edges_ui(ui: &mut Ui, editor: &mut Editor) {
    let document = editor.document();
    let is_seen = document
        .references()
        .any(|(_, it)| it.picture.is_some() && it.visible);
    if !is_seen || editor.hand().tool() != ToolKind::Draw {
        return;
    }
    let command = Command::ToggleEdges;
    let mut is_on = command.is_checked(editor) == Some(true);
    let switch = ui.checkbox(&mut is_on, command.label());
    if switch.on_hover_text(command.tooltip()).clicked() {
        told(editor.execute(command));
    }
}

fn degree_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(degree) = editor.hand().drawn_degree(&editor.context()) else {
        return;
    };
    widgets::form_row(ui, "Degree", |ui| {
        let field = NumberField::new("drawn degree", degree as f64, degree.to_string())
            .width(DEGREE)
            .range(1.0..=MAX_DEGREE as f64);
        if let Some(value) = field.typed(ui) {
            set_degree(editor, value.round() as usize);
        }
        if let Some(degree) = editor.hand().degree_so_far(&editor.context()) {
            widgets::note(ui, &format!("{degree} so far"));
        }
    });
}

fn set_degree(editor: &mut Editor, degree: usize) {
    if editor.hand().tool() == ToolKind::Draw {
        let settings = DrawSettings {
            degree: Some(degree),
            ..editor.hand().draw_settings()
        };
        editor.hand_mut().set_draw_settings(settings);
    } else {
        item_fields::set_degree(editor, degree as f64);
    }
}

/// A figure of the leg, and whether it is locked: typing it locks it. Returns the locked value.
fn figure_ui(
    ui: &mut Ui,
    (caption, name, quantity): (&str, &str, Quantity),
    (locked, drawn): (Option<f64>, Option<f64>),
    shown: impl Fn(f64) -> String,
) -> Option<f64> {
    let value = locked.or(drawn);
    let text = value.map_or_else(|| "–".to_owned(), shown);
    let row = widgets::form_row(ui, caption, |ui| {
        let field = NumberField::new(name, value.unwrap_or(0.0), text)
            .width(FIGURE)
            .quantity(quantity);
        let typed = field.typed(ui);
        let tokens = Tokens::of(ui);
        let (icon, verb, colour) = match locked {
            Some(_) => (Icon::Lock, "Unlock", tokens.accent),
            None => (Icon::LockOpen, "Lock", tokens.text),
        };
        let label = format!("{verb} {name}");
        let lock = IconButton::new(icon, &label).colour(colour);
        if lock.enabled(value.is_some()).show(ui).clicked() {
            return if locked.is_some() { None } else { drawn };
        }
        typed.or(locked)
    });
    row.inner
}

/// What the tools that draw make of clicks.
fn draw_way_ui(ui: &mut Ui, editor: &mut Editor) {
    let tool = editor.hand().tool();
    let is_offered = |way: &DrawWay| match tool {
        ToolKind::Draw => true,
        ToolKind::AddVertex => !way.passes_points(),
        _ => false,
    };
    let ways: Vec<DrawWay> = DrawWay::ALL.into_iter().filter(is_offered).collect();
    let mut settings = editor.hand().draw_settings();
    // Four ways are wider than a narrow panel.
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        for way in ways {
            let is_chosen = match tool {
                ToolKind::AddVertex => way.ends_on_clicks() == settings.way.ends_on_clicks(),
                _ => way == settings.way,
            };
            let response = ui.selectable_label(is_chosen, way.label());
            if response.on_hover_text(way.tooltip()).clicked() && !is_chosen {
                settings.way = way;
            }
        }
    });
    if settings != editor.hand().draw_settings() {
        editor.hand_mut().set_draw_settings(settings);
    }
}

fn pivot_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(pivot) = editor.hand().pivot(&editor.context()) else {
        let text = "Select vertices, or a curve that is neither locked nor hidden.";
        widgets::note(ui, text);
        return;
    };
    widgets::form_row(ui, "Pivot", |ui| {
        let pixel = editor.view().viewport().pixel();
        let axes = [("pivot x", DVec2::X), ("pivot y", DVec2::Y)];
        for (name, axis) in axes {
            let value = pivot.dot(axis);
            let shown = figures::significant(value, 6);
            let field = NumberField::new(name, value, shown).speed(pixel);
            if let Some(changed) = field.quantity(Quantity::Length).changed(ui) {
                let pivot = pivot + axis * (changed - value);
                editor.hand_mut().set_pivot(Some(pivot));
            }
        }
    });
}
