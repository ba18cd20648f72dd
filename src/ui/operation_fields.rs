//! The fields of an operation's parameters.

use std::ops::{Bound, RangeInclusive};

use eframe::egui::{Button, Key, Label, RichText, Role, TextEdit, TextStyle, Ui, Vec2, WidgetInfo};

use super::number_field::{FieldEvent, NumberField};
use super::theme::{self, STEP, Tokens};
use super::{figures, labels, widgets};
use crate::editor::OperationInProgress;
use crate::geometry::parameters::{Limits, Quantity};
use crate::operations::{Choice, Kind, Parameter, Value};

/// The least width of the captions of fields.
const LABEL: f32 = 72.0;

/// The most of a row that its caption takes.
const MOST_LABEL: f32 = 0.5;

/// The width of a field for a number.
const FIELD: f32 = 120.0;

/// The state of the fields.
#[derive(Default)]
pub struct OperationFields {
    /// The list that is typed.
    typed: Option<TypedList>,
    /// Why the last value was not accepted.
    pub refusal: Option<Refused>,
}

/// Why a value was not accepted.
#[derive(Clone, PartialEq)]
pub struct Refused {
    /// The parameter whose field that belongs to, if it is of one.
    pub parameter: Option<&'static str>,
    /// The reason, and the remedy.
    pub text: String,
}

/// A list that is typed: it counts as far as it is one, while it is typed.
struct TypedList {
    parameter: &'static str,
    text: String,
    before: Value,
}

impl OperationFields {
    /// Show the field of a parameter; returns the user's action on it.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        in_progress: &OperationInProgress,
        parameter: &'static Parameter,
    ) -> Option<FieldEvent<Value>> {
        let value = in_progress.values().get(parameter);
        let label = label_width(ui, in_progress);
        let row = widgets::wide_form_row(ui, parameter.label, label, |ui| {
            match (&parameter.kind, value) {
                (Kind::Choice { options, .. }, Value::Choice(chosen)) => {
                    choice_ui(ui, parameter.label, options, *chosen).map(FieldEvent::Set)
                }
                (Kind::List { .. } | Kind::Reference { .. }, _) => {
                    self.list_ui(ui, parameter, value, hint_of(in_progress, parameter))
                }
                (Kind::Switch { .. }, Value::Switch(on)) => {
                    let mut on = *on;
                    let switch = ui.checkbox(&mut on, "");
                    switch.widget_info(|| {
                        WidgetInfo::selected(Role::CheckBox, true, on, parameter.label)
                    });
                    // After a click of the pointer Enter applies, and does not switch back.
                    if switch.clicked() && switch.interact_pointer_pos().is_some() {
                        switch.surrender_focus();
                    }
                    let set = switch.clicked().then_some(Value::Switch(on));
                    set.map(FieldEvent::Set)
                }
                _ => self.number_ui(ui, in_progress, parameter, value),
            }
        });
        row.response.on_hover_text(parameter.help);
        self.below_ui(ui, in_progress, parameter, label);
        row.inner
    }

    /// Below a field: the meaning of an empty one, where the field is too narrow for it, and the refusal of
    /// its last value.
    fn below_ui(
        &self,
        ui: &mut Ui,
        in_progress: &OperationInProgress,
        parameter: &'static Parameter,
        label: f32,
    ) {
        let gap = ui.spacing().item_spacing.x;
        let below = |ui: &mut Ui, text: RichText| {
            ui.horizontal(|ui| {
                ui.add_space(label + gap);
                ui.add(Label::new(text.font(theme::small_font())).wrap());
            });
        };
        let room = ui.available_width() - label - gap;
        let hint = hint_of(in_progress, parameter);
        // It stays while there is a value: nothing below moves when one is typed.
        if !fits(ui, hint, room) {
            let text = format!("empty: {hint}");
            below(ui, RichText::new(text).color(Tokens::of(ui).faint_text));
        }
        let refused = self.refusal.as_ref();
        if let Some(refused) = refused.filter(|it| it.parameter == Some(parameter.name)) {
            below(ui, RichText::new(&refused.text).color(Tokens::of(ui).error));
        }
    }

    fn refuse(&mut self, parameter: &'static Parameter, text: String) {
        self.refusal = Some(Refused {
            parameter: Some(parameter.name),
            text,
        });
    }

    /// A field for numbers with commas between them, which may stay empty. A text is previewed at once,
    /// as far as it is a list that can be given.
    fn list_ui(
        &mut self,
        ui: &mut Ui,
        parameter: &'static Parameter,
        value: &Value,
        none: &str,
    ) -> Option<FieldEvent<Value>> {
        let is_own = |typed: &mut TypedList| typed.parameter == parameter.name;
        let typed = self.typed.take_if(is_own);
        let (mut text, before) = match typed {
            Some(typed) => (typed.text, typed.before),
            None => (parameter.text(value), value.clone()),
        };
        // What does not fit stands below.
        let hint = match fits(ui, none, ui.available_width()) {
            true => none,
            false => "",
        };
        let field = TextEdit::singleline(&mut text)
            .id_salt(parameter.name)
            .hint_text(hint)
            .desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, parameter.label));
        // An unchanged text keeps the value, with parts that no text shows, such as a reference's placement.
        let read = match text == parameter.text(&before) {
            true => Ok(before.clone()),
            false => parameter.read(&text),
        };
        if field.has_focus() {
            self.typed = Some(TypedList {
                parameter: parameter.name,
                text,
                before,
            });
            let changed = read.ok().filter(|read| field.changed() && read != value);
            return changed.map(FieldEvent::Preview);
        }
        if !field.lost_focus() {
            return None;
        }
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            return Some(FieldEvent::Abort);
        }
        match read {
            Ok(read) if read != *value => Some(FieldEvent::Set(read)),
            Ok(_) => Some(FieldEvent::Commit),
            Err(error) => {
                self.refuse(parameter, error.to_string());
                Some(FieldEvent::Abort)
            }
        }
    }

    fn number_ui(
        &mut self,
        ui: &mut Ui,
        in_progress: &OperationInProgress,
        parameter: &'static Parameter,
        value: &Value,
    ) -> Option<FieldEvent<Value>> {
        let limits = parameter.limits(in_progress.input()).ok().flatten();
        let number = shown_number(value, parameter.quantity());
        let range = field_range(limits, parameter.quantity());
        let whole = matches!(value, Value::Whole(_));
        let shown = figures::short(number);
        let speed = if whole { 0.05 } else { speed(&range, number) };
        let field = NumberField::new(parameter.label, number, shown)
            .range(range)
            .quantity(parameter.quantity())
            .speed(speed)
            .width(FIELD);
        let event = field.show(ui);
        if parameter.quantity() == Quantity::Angle {
            widgets::caption(ui, "°");
        }
        match event? {
            FieldEvent::Set(number) if whole && number.fract() != 0.0 => {
                let needed = format!("{}: a whole number is needed", parameter.label);
                self.refuse(parameter, needed);
                None
            }
            event => Some(event.map(|number| given_number(number, value, parameter.quantity()))),
        }
    }
}

/// The width of the captions: that of the longest, so that none is cut off.
pub fn label_width(ui: &Ui, in_progress: &OperationInProgress) -> f32 {
    let parameters = in_progress.operation().parameters.iter();
    let widths = parameters.map(|parameter| text_width(ui, parameter.label));
    let most = (MOST_LABEL * ui.available_width()).max(LABEL);
    (widths.fold(0.0, f32::max) + STEP).clamp(LABEL, most)
}

fn text_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Body.resolve(ui.style());
    labels::size(ui.painter(), text, font).x
}

/// Whether a text fits into a field of a width.
fn fits(ui: &Ui, text: &str, width: f32) -> bool {
    text_width(ui, text) + 4.0 * STEP <= width
}

/// The meaning of an empty field, for parameters that may be empty.
fn hint_of(in_progress: &OperationInProgress, parameter: &Parameter) -> &'static str {
    match parameter.kind {
        Kind::List { none, .. } => none(Some(in_progress.input())),
        Kind::Reference { none } => none,
        _ => "",
    }
}

/// A row of buttons of which one is pressed; options that do not fit into it are a list that opens.
fn choice_ui(ui: &mut Ui, label: &str, options: &'static [Choice], chosen: usize) -> Option<Value> {
    if !fits_as_buttons(ui, options) {
        let all = options.iter().map(|option| option.label.to_owned());
        let width = FIELD.max(ui.available_width());
        let (other, _) = widgets::drop_down(ui, label, width, &chosen, all.enumerate());
        return other.map(Value::Choice);
    }
    let mut clicked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing = Vec2::splat(STEP);
        for (index, option) in options.iter().enumerate() {
            let button = Button::selectable(index == chosen, option.label);
            if ui.add(button).clicked() && index != chosen {
                clicked = Some(Value::Choice(index));
            }
        }
    });
    clicked
}

/// Whether options fit side by side into the row.
fn fits_as_buttons(ui: &Ui, options: &[Choice]) -> bool {
    let padding = 2.0 * ui.spacing().button_padding.x + STEP;
    let widths = options.iter();
    let widths = widths.map(|option| text_width(ui, option.label) + padding);
    widths.sum::<f32>() - STEP <= ui.available_width()
}

/// A number as its field shows it.
fn shown_number(value: &Value, quantity: Quantity) -> f64 {
    match value {
        Value::Whole(number) => *number as f64,
        Value::Real(number) => quantity.shown(*number),
        _ => 0.0,
    }
}

/// The value that a field's number stands for, of the kind of another value.
fn given_number(number: f64, like: &Value, quantity: Quantity) -> Value {
    match like {
        Value::Whole(_) => Value::Whole(number.round().max(0.0) as usize),
        _ => Value::Real(quantity.stored(number)),
    }
}

fn field_range(limits: Option<Limits>, quantity: Quantity) -> RangeInclusive<f64> {
    let (from, to) = limits.unwrap_or((Bound::Unbounded, Bound::Unbounded));
    let shown = |bound, unbounded| match bound {
        // The parameter's own message refuses an excluded bound.
        Bound::Included(value) | Bound::Excluded(value) => quantity.shown(value),
        Bound::Unbounded => unbounded,
    };
    shown(from, f64::NEG_INFINITY)..=shown(to, f64::INFINITY)
}

/// By how much a number changes when its field is dragged by a point: a good way through a range
/// that has an end, otherwise a share of the number.
fn speed(range: &RangeInclusive<f64>, number: f64) -> f64 {
    let width = range.end() - range.start();
    match width.is_finite() && width > 0.0 {
        true => (0.005 * width).min(0.05),
        false => (0.01 * number.abs()).max(f64::MIN_POSITIVE),
    }
}
