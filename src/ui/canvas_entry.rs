//! The entry field on the canvas, for a point, an angle or a factor of the tool in hand, and the
//! figures of the leg in progress.

use eframe::egui::{
    Align2, Context, Event, Frame, Id, Key, Rect, Stroke, TextEdit, Ui, Vec2, vec2,
};
use lucide_icons::Icon;

use super::canvas::{self, Canvas};
use super::chains::Screen;
use super::draft::remark_ui;
use super::keyboard::{self, Typing};
use super::number_field::NumberField;
use super::theme::{self, ROW, STEP, Tokens};
use super::widgets::{self, IconButton};
use super::{figures, item_fields};
use crate::editor::{
    DrawSettings, DrawWay, Editor, Entry, EntryError, Input, Key as EditorKey, LegLocks, ToolKind,
};
use crate::geometry::MAX_DEGREE;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;

/// What texts begin with that are numbers or points.
const BEGINNINGS: [char; 5] = ['-', '−', '.', '@', '('];

/// The widths of the field, of captions and of figures.
const FIELD: f32 = 208.0;
const CAPTION: f32 = 48.0;
const FIGURE: f32 = 76.0;
const SO_FAR: f32 = 56.0;

/// The panel gives way to points so near, in points of the screen: the next one is often set beside the last.
const AROUND: f32 = 80.0;

/// The field that digits typed on the canvas go to.
#[derive(Debug, Default)]
pub struct CanvasEntry {
    text: String,
    error: Option<EntryError>,
    /// Whether it had the keyboard in the last frame.
    is_typed: bool,
    rect: Option<Rect>,
    /// The size of the panel in the last frame.
    size: Vec2,
}

/// The identity of the field.
fn id() -> Id {
    Id::unique("canvas entry")
}

impl CanvasEntry {
    /// Give the keyboard to the field when something is typed on the canvas that the tool takes.
    /// Called before keys are looked at as commands.
    pub fn take_keys(&mut self, context: &Context, editor: &Editor, canvas: &Canvas) {
        let takes_text = editor.hand().entry(editor.view().viewport()).is_some();
        if !takes_text || !canvas.has_keyboard(context) {
            return;
        }
        let begins = |event: &Event| matches!(event, Event::Text(text) if begins(text));
        if context.input(|input| input.events.iter().any(begins)) {
            self.text.clear();
            self.error = None;
            let rect = self.rect.unwrap_or(Rect::NOTHING);
            keyboard::claim(context, id(), Typing::Text, rect);
            context.memory_mut(|memory| memory.request_focus(id()));
        }
    }

    /// Show the field, with the figures of the leg that is drawn, at the canvas's lower edge, or the upper one where
    /// it would lie over the last point. Returns where.
    pub fn show(&mut self, context: &Context, canvas: Rect, editor: &mut Editor) -> Option<Rect> {
        let Some(entry) = editor.hand().entry(editor.view().viewport()) else {
            *self = Self::default();
            return None;
        };
        let low = canvas.center_bottom() - vec2(0.0, 6.0 * STEP);
        let high = canvas.center_top() + vec2(0.0, 14.0 * STEP);
        let below = Align2::CENTER_BOTTOM.anchor_size(low, self.size);
        let last = editor.hand().last_drawn();
        let viewport = editor.view().viewport();
        let last = last.map(|last| Screen::new(viewport, canvas).pos(viewport.flatten(last)));
        let place = match last.is_some_and(|last| below.expand(AROUND).contains(last)) {
            true => (Align2::CENTER_TOP, high),
            false => (Align2::CENTER_BOTTOM, low),
        };
        let shown = widgets::overlay(context, "drawing", place, |ui| {
            let outline = Stroke::new(1.0, Tokens::of(ui).outline);
            let frame = Frame::popup(ui.style()).stroke(outline);
            frame.inner_margin(2.0 * STEP).show(ui, |ui| {
                ui.spacing_mut().item_spacing = vec2(STEP, STEP);
                if matches!(entry, Entry::Point(_)) {
                    ui.horizontal(|ui| leg_ui(ui, editor));
                }
                ui.horizontal(|ui| {
                    self.entry_ui(ui, editor, entry);
                    ui.add_space(2.0 * STEP);
                    draw_way_ui(ui, editor);
                });
            });
        });
        self.size = shown.response.rect.size();
        Some(shown.response.rect)
    }

    fn entry_ui(&mut self, ui: &mut Ui, editor: &mut Editor, entry: Entry) {
        let (caption, name, hint) = words(entry);
        caption_ui(ui, caption);
        let (_, rect) = ui.allocate_space(vec2(FIELD, ROW));
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
            remark_ui(ui, id(), rect, &error.to_string());
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
            // The text moves the leg in progress, which this frame has shown already.
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
            Err(error) => self.error = Some(error),
        }
        ui.ctx().request_repaint();
    }
}

fn begins(text: &str) -> bool {
    let first = text.chars().next();
    first.is_some_and(|first| first.is_ascii_digit() || BEGINNINGS.contains(&first))
}

/// The caption of the field, its name and its hint.
fn words(entry: Entry) -> (&'static str, &'static str, String) {
    match entry {
        Entry::Point([x, y]) => {
            let hint = format!("{x},{y}  @d{x},d{y}  @length<angle");
            ("Point", "typed point", hint)
        }
        Entry::Angle => ("Angle", "typed angle", "degrees".to_owned()),
        Entry::Factor => ("Factor", "typed factor", "such as 1.5".to_owned()),
    }
}

fn caption_ui(ui: &mut Ui, caption: &str) {
    let (_, rect) = ui.allocate_space(vec2(CAPTION, ROW));
    widgets::label_in(ui, rect, caption, Tokens::of(ui).faint_text);
}

/// Degree, length and angle of the drawing.
fn leg_ui(ui: &mut Ui, editor: &mut Editor) {
    degree_ui(ui, editor);
    let Some(locks) = editor.hand().leg_locks() else {
        return;
    };
    let leg = editor.hand().leg(&editor.context());
    let pixel = editor.view().viewport().pixel();
    let length = leg.map(|leg| leg.length);
    let unit = editor.document().unit().map(LengthUnit::symbol);
    let unit = unit.map_or(String::new(), |unit| format!(" {unit}"));
    let shown = |value| figures::to_resolution(value, 0.1 * pixel) + &unit;
    let words = ("Length", "leg length", Quantity::Length);
    let length = figure_ui(ui, words, (locks.length, length), shown);
    ui.add_space(2.0 * STEP);
    let degrees = leg.and_then(|leg| leg.degrees);
    let shown = |value| format!("{}°", figures::to_resolution(value, 0.01));
    let words = ("Angle", "leg angle", Quantity::Angle);
    let degrees = figure_ui(ui, words, (locks.degrees, degrees), shown);
    let new = LegLocks { length, degrees };
    if new != locks {
        editor.hand_mut().lock_leg(new);
    }
}

fn degree_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(degree) = editor.hand().drawn_degree(&editor.context()) else {
        return;
    };
    caption_ui(ui, "Degree");
    let field = NumberField::new("drawn degree", degree as f64, degree.to_string())
        .width(40.0)
        .range(1.0..=MAX_DEGREE as f64);
    if let Some(value) = field.typed(ui) {
        let degree = value.round() as usize;
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
    // What it has so far stands in a place of its own, so that nothing moves.
    let (_, rect) = ui.allocate_space(vec2(SO_FAR, ROW));
    if let Some(degree) = editor.hand().degree_so_far(&editor.context()) {
        let text = format!("{degree} so far");
        widgets::label_in(ui, rect, &text, Tokens::of(ui).faint_text);
    }
}

/// A figure of the leg, and whether it is locked: typing it locks it. Returns the locked value.
fn figure_ui(
    ui: &mut Ui,
    (caption, name, quantity): (&str, &str, Quantity),
    (locked, drawn): (Option<f64>, Option<f64>),
    shown: impl Fn(f64) -> String,
) -> Option<f64> {
    caption_ui(ui, caption);
    let value = locked.or(drawn);
    let text = value.map_or_else(|| "–".to_owned(), shown);
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
}

/// What the draw tool makes of clicks.
fn draw_way_ui(ui: &mut Ui, editor: &mut Editor) {
    if editor.hand().tool() != ToolKind::Draw {
        return;
    }
    let mut settings = editor.hand().draw_settings();
    for way in DrawWay::ALL {
        let response = ui.selectable_value(&mut settings.way, way, way.label());
        response.on_hover_text(way.tooltip());
    }
    if settings != editor.hand().draw_settings() {
        editor.hand_mut().set_draw_settings(settings);
    }
}
