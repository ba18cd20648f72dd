//! A field for a number: typed exactly, or dragged.

use std::ops::RangeInclusive;

use eframe::egui::{
    Align2, CursorIcon, EventFilter, Id, Key, Painter, Rect, Response, Sense, Stroke, StrokeKind,
    Ui, Vec2, WidgetInfo, accesskit::Action, accesskit::ActionData, pos2,
};
use glam::DVec3;

use super::document_unit;
use super::draft::{Accepted, Draft, Remark};
use super::keyboard::{self, Typing};
use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::{figures, labels, widgets};
use crate::editor::Editor;
use crate::geometry::parameters::Quantity;

/// A user's action on a field. `T` is the meaning of the field's number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FieldEvent<T = f64> {
    /// Drag to a value, which is a preview.
    Preview(T),
    /// End the drag; its last preview counts.
    Commit,
    /// End the drag by Esc, without a change.
    Abort,
    /// Set a value at once, as by typing.
    Set(T),
}

impl<T> FieldEvent<T> {
    /// Turn the number into its meaning.
    pub fn map<U>(self, of: impl FnOnce(T) -> U) -> FieldEvent<U> {
        match self {
            Self::Preview(value) => FieldEvent::Preview(of(value)),
            Self::Set(value) => FieldEvent::Set(of(value)),
            Self::Commit => FieldEvent::Commit,
            Self::Abort => FieldEvent::Abort,
        }
    }

    /// Pass the event to the editor: `preview` shows a value, `set` makes it a step of undo.
    pub fn send(
        self,
        editor: &mut Editor,
        preview: impl FnOnce(&mut Editor, T),
        set: impl FnOnce(&mut Editor, T),
    ) {
        match self {
            Self::Preview(value) => preview(editor, value),
            Self::Set(value) => set(editor, value),
            Self::Commit => editor.commit_preview(),
            Self::Abort => editor.abort_preview(),
        }
    }
}

/// Show a form row with a field for each of the first `axes` components of a vector. `name` names the
/// vector for screen readers.
pub fn vector_row(
    ui: &mut Ui,
    (caption, name): (&str, &str),
    axes: usize,
    vector: DVec3,
    field: impl Fn(&str, f64) -> NumberField<'_>,
) -> Option<FieldEvent<DVec3>> {
    let width = field_width(ui, axes);
    let row = widgets::form_row(ui, caption, |ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        let mut changed = None;
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate().take(axes) {
            let name = format!("{name} {letter}");
            let event = field(&name, vector[axis]).width(width).show(ui);
            let event = event.map(|event| {
                event.map(|value| {
                    let mut vector = vector;
                    vector[axis] = value;
                    vector
                })
            });
            changed = event.or(changed);
        }
        changed
    });
    row.inner
}

/// The width of each of some fields that share a form row.
pub fn field_width(ui: &Ui, fields: usize) -> f32 {
    let free = ui.available_width() - widgets::CAPTION - 2.0 * STEP;
    ((free - STEP * fields as f32) / fields as f32).clamp(40.0, 120.0)
}

/// A number that can be typed (click, type, Enter) and dragged sideways (shift: finer).
pub struct NumberField<'a> {
    name: &'a str,
    value: f64,
    shown: String,
    speed: f64,
    width: f32,
    quantity: Quantity,
    range: RangeInclusive<f64>,
    flat: bool,
    typed_only: bool,
    read_only: bool,
    help: Option<&'a str>,
}

/// The draft in the field that has the keyboard, and the pass in which it was last shown: an older
/// draft does not count.
#[derive(Clone, Default)]
struct Kept {
    draft: Draft,
    pass: u64,
}

/// The drag that is going on.
#[derive(Clone, Copy, Default)]
struct Drag {
    start: f64,
    points: f64,
    called_off: bool,
}

impl<'a> NumberField<'a> {
    /// A field that shows `shown` for `value`; `name` is its name for screen readers.
    pub fn new(name: &'a str, value: f64, shown: String) -> Self {
        Self {
            name,
            value,
            shown,
            speed: 1.0,
            width: 80.0,
            quantity: Quantity::Number,
            range: f64::NEG_INFINITY..=f64::INFINITY,
            flat: false,
            typed_only: false,
            read_only: false,
            help: None,
        }
    }

    /// By how much the value changes when the pointer is dragged by one point.
    pub fn speed(mut self, speed: f64) -> Self {
        self.speed = speed;
        self
    }

    /// The field's width in points.
    pub fn width(mut self, width: f32) -> Self {
        self.width = width;
        self
    }

    /// What its numbers measure; without this they are mere numbers.
    pub fn quantity(mut self, quantity: Quantity) -> Self {
        self.quantity = quantity;
        self
    }

    /// The values that dragging and typing keep to.
    pub fn range(mut self, range: RangeInclusive<f64>) -> Self {
        self.range = range;
        self
    }

    /// A cell, whose table has the keyboard: without a frame until it is hovered, and perhaps only to be read.
    pub fn cell(mut self, read_only: bool) -> Self {
        self.flat = true;
        self.read_only = read_only;
        self
    }

    /// The text of its tooltip.
    pub fn help(mut self, help: &'a str) -> Self {
        self.help = Some(help);
        self
    }

    /// Show the field; returns the user's action on it.
    pub fn show(self, ui: &mut Ui) -> Option<FieldEvent> {
        let (_, rect) = ui.allocate_space(Vec2::new(self.width, ROW));
        let id = ui.make_persistent_id(self.name);
        keyboard::claim(ui.ctx(), id, Typing::Text, rect);
        if ui.memory(|memory| memory.has_focus(id)) && ui.is_enabled() {
            return self.typing_ui(ui, rect, id);
        }
        let typed = self.typed_before_leaving(ui, id);
        let (response, event) = self.resting_ui(ui, rect, id);
        if response.clicked() {
            response.request_focus();
        }
        if let Some(help) = self.help {
            response.on_hover_text(help);
        }
        typed.map(FieldEvent::Set).or(event)
    }

    /// Show the field; returns the number that was typed.
    pub fn typed(mut self, ui: &mut Ui) -> Option<f64> {
        self.typed_only = true;
        match self.show(ui) {
            Some(FieldEvent::Set(value)) => Some(value),
            _ => None,
        }
    }

    /// Show the field; returns the number that was typed or dragged to, without a preview in the document.
    pub fn changed(self, ui: &mut Ui) -> Option<f64> {
        match self.show(ui) {
            Some(FieldEvent::Set(value) | FieldEvent::Preview(value)) => Some(value),
            _ => None,
        }
    }

    /// The field has the keyboard: it is a text field with the exact number.
    fn typing_ui(&self, ui: &mut Ui, rect: Rect, id: Id) -> Option<FieldEvent> {
        let kept = take_kept(ui, id);
        let is_new = kept.is_none();
        let mut draft = kept.unwrap_or_else(|| Draft::of(self.value));
        let keys = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        let accepted = self.accepted(ui);
        let response = draft.show(ui, (id, rect, self.name), &accepted, is_new, keys);
        let is_left = !response.has_focus();
        let entered = !is_left && ui.input(|input| input.key_pressed(Key::Enter));
        match draft.value(&accepted) {
            // The text stays, for correction.
            Err(fault) if entered => draft.refuse(fault),
            _ if entered || is_left => {
                ui.memory_mut(|memory| memory.surrender_focus(id));
                return self.taken(ui, id, &draft).map(FieldEvent::Set);
            }
            _ => {}
        }
        let pass = ui.ctx().cumulative_pass_nr();
        ui.data_mut(|data| data.insert_temp(id, Kept { draft, pass }));
        None
    }

    /// The number that was being typed when the keyboard went elsewhere, if it counts.
    fn typed_before_leaving(&self, ui: &Ui, id: Id) -> Option<f64> {
        let draft = take_kept(ui, id)?;
        match ui.input(|input| input.key_pressed(Key::Escape)) {
            true => None,
            false => self.taken(ui, id, &draft),
        }
    }

    /// The number to take over; for a text that is none, a remark beside the field.
    fn taken(&self, ui: &Ui, id: Id, draft: &Draft) -> Option<f64> {
        draft.value(&self.accepted(ui)).unwrap_or_else(|fault| {
            let remark = draft.left(ui, &fault, &self.shown);
            ui.data_mut(|data| data.insert_temp(id, remark));
            None
        })
    }

    fn accepted(&self, ui: &Ui) -> Accepted {
        Accepted {
            quantity: self.quantity,
            unit: document_unit::get(ui.ctx()),
            range: self.range.clone(),
        }
    }

    fn clamped(&self, value: f64) -> f64 {
        value.clamp(*self.range.start(), *self.range.end())
    }

    /// Show the field in a box as it is while nothing is typed: it can be dragged.
    pub fn resting_ui(&self, ui: &mut Ui, rect: Rect, id: Id) -> (Response, Option<FieldEvent>) {
        let mut sense = match self.typed_only || self.read_only {
            true => Sense::click(),
            false => Sense::click_and_drag(),
        };
        if self.flat {
            sense -= Sense::FOCUSABLE;
        }
        let response = ui.interact(rect, id, sense);
        if ui.is_rect_visible(rect) {
            self.paint(ui, rect, &response);
        }
        self.describe(ui, &response);
        self.remark_ui(ui, rect, id);
        if self.read_only {
            return (response, None);
        }
        let requested = self.requested_value(ui, id);
        let event = requested.or_else(|| self.drag(ui, &response));
        let cursor = match (ui.is_enabled(), self.typed_only) {
            (false, _) => return (response, event),
            (true, true) => CursorIcon::Text,
            (true, false) => CursorIcon::ResizeHorizontal,
        };
        (response.on_hover_and_drag_cursor(cursor), event)
    }

    fn remark_ui(&self, ui: &Ui, rect: Rect, id: Id) {
        let remark: Option<Remark> = ui.data(|data| data.get_temp(id));
        if remark.is_some_and(|remark| !remark.show(ui, id, rect)) {
            ui.data_mut(|data| data.remove_temp::<Remark>(id));
        }
    }

    fn paint(&self, ui: &Ui, rect: Rect, response: &Response) {
        let tokens = Tokens::of(ui);
        let is_hot = !self.read_only && (response.hovered() || response.dragged());
        if !self.flat || is_hot {
            // In a table the accent is for the cell that has the keyboard.
            let is_marked = is_hot && !self.flat;
            let outline = if is_marked {
                tokens.accent
            } else {
                tokens.outline
            };
            let (fill, outline) = (tokens.inset, Stroke::new(1.0, outline));
            ui.painter()
                .rect(rect, RADIUS, fill, outline, StrokeKind::Inside);
        }
        let mut at = pos2(rect.right() - 1.5 * STEP, rect.center().y);
        let painter = ui.painter_at(rect);
        let colour = match (is_hot, self.read_only) {
            (true, _) => tokens.strong_text,
            (false, true) => tokens.faint_text,
            (false, false) => ui.visuals().widgets.style(response).text_color(),
        };
        let room = rect.width() - 2.0 * STEP;
        let text = self.fitting(&painter, room);
        let width = |text: &str| labels::size(&painter, text, theme::number_font()).x;
        // A number goes before its unit where there is no room for both.
        let unit = self
            .unit(ui)
            .filter(|unit| width(&text) + width(unit) + STEP <= room);
        if let Some(unit) = unit {
            let colour = tokens.faint_text;
            let drawn = painter.text(at, Align2::RIGHT_CENTER, unit, theme::number_font(), colour);
            at.x = drawn.left() - STEP;
        }
        painter.text(at, Align2::RIGHT_CENTER, text, theme::number_font(), colour);
    }

    /// The unit that stands behind a length; in a table it stands above the column.
    fn unit(&self, ui: &Ui) -> Option<&'static str> {
        let is_length = self.quantity == Quantity::Length && !self.flat && !self.shown.is_empty();
        let unit = document_unit::get(ui.ctx()).filter(|_| is_length)?;
        Some(unit.symbol())
    }

    /// The text that fits: a number too long for the field gets fewer digits, and if that is not enough
    /// an ellipsis before its end.
    fn fitting(&self, painter: &Painter, width: f32) -> String {
        let fits = |text: &str| labels::size(painter, text, theme::number_font()).x <= width;
        if fits(&self.shown) {
            return self.shown.clone();
        }
        if let Some(shorter) = self.shorter().find(|text| fits(text)) {
            return shorter;
        }
        let mut text = self.shown.clone();
        while !fits(&text) && text.chars().count() > 2 {
            let left = text.chars().skip(2);
            text = std::iter::once('…').chain(left).collect();
        }
        text
    }

    /// The number with fewer and fewer digits, down to the last that differs from 0; a text with a unit
    /// has no shorter form.
    fn shorter(&self) -> impl Iterator<Item = String> {
        let value = self.value;
        let is_plain = self.shown.ends_with(|last: char| last.is_ascii_digit());
        let shows = move |decimals: &usize| {
            value.abs() >= 0.1_f64.powi(*decimals as i32).max(figures::SMALL)
        };
        let plain = (1..=9).rev().filter(shows);
        let plain = plain.map(move |decimals| format!("{value:.decimals$}"));
        let short = (1..=4)
            .rev()
            .map(move |digits| figures::significant(value, digits));
        plain.chain(short).filter(move |_| is_plain)
    }

    fn describe(&self, ui: &Ui, response: &Response) {
        response.widget_info(|| WidgetInfo {
            label: Some(self.name.to_owned()),
            ..WidgetInfo::drag_value(ui.is_enabled() && !self.read_only, self.value)
        });
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.add_action(Action::SetValue);
            node.set_value(self.shown.clone());
        });
    }

    /// A number that a screen reader, or a test, sets.
    fn requested_value(&self, ui: &Ui, id: Id) -> Option<FieldEvent> {
        let accepted = self.accepted(ui);
        ui.input(|input| {
            let mut requests = input.accesskit_action_requests(id, Action::SetValue);
            requests.find_map(|request| match &request.data {
                Some(ActionData::NumericValue(value)) if value.is_finite() => {
                    Some(FieldEvent::Set(self.clamped(*value)))
                }
                Some(ActionData::Value(text)) => {
                    let value = accepted.read(text, self.value).ok()?;
                    Some(FieldEvent::Set(value))
                }
                _ => None,
            })
        })
    }

    fn drag(&self, ui: &Ui, response: &Response) -> Option<FieldEvent> {
        let memory = response.id.with("drag");
        if response.drag_started() {
            let drag = Drag {
                start: self.value,
                ..Drag::default()
            };
            ui.data_mut(|data| data.insert_temp(memory, drag));
            // Whatever had the keyboard is left, as it is by a click.
            ui.memory_mut(|memory| {
                if let Some(focused) = memory.focused() {
                    memory.surrender_focus(focused);
                }
            });
        }
        let mut drag = ui.data(|data| data.get_temp::<Drag>(memory))?;
        // Esc also ends egui's drag: look for it first.
        let is_escape = ui.input(|input| input.key_pressed(Key::Escape));
        let is_over = response.drag_stopped() || !response.dragged();
        let event = if drag.called_off {
            None
        } else if is_escape {
            drag.called_off = true;
            Some(FieldEvent::Abort)
        } else if is_over {
            Some(FieldEvent::Commit)
        } else {
            self.dragged_on(ui, response, &mut drag)
        };
        ui.data_mut(|data| {
            if is_over {
                data.remove_temp::<Drag>(memory);
            } else {
                data.insert_temp(memory, drag);
            }
        });
        event
    }

    fn dragged_on(&self, ui: &Ui, response: &Response, drag: &mut Drag) -> Option<FieldEvent> {
        let is_fine = ui.input(|input| input.modifiers.shift);
        let fine = if is_fine { 0.1 } else { 1.0 };
        let moved = f64::from(response.drag_delta().x) * fine;
        drag.points += moved;
        (moved != 0.0).then(|| FieldEvent::Preview(self.dragged_to(drag, fine)))
    }

    /// The dragged value, rounded to the step of one point of the drag.
    fn dragged_to(&self, drag: &Drag, fine: f64) -> f64 {
        let value = drag.start + drag.points * self.speed;
        let step = 10f64.powf((self.speed * fine).log10().floor());
        let steps = (value / step).round();
        let short = match step < 1.0 {
            // Dividing by the inverse keeps decimal fractions short: 0.3, not 0.30000000000000004.
            true => steps / (1.0 / step).round(),
            false => steps * step,
        };
        self.clamped(if short.is_finite() { short } else { value })
    }
}

fn take_kept(ui: &Ui, id: Id) -> Option<Draft> {
    let kept: Kept = ui.data_mut(|data| data.remove_temp(id))?;
    let is_fresh = ui.ctx().cumulative_pass_nr() <= kept.pass + 1;
    is_fresh.then_some(kept.draft)
}
