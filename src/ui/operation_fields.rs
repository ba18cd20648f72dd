//! The fields of an operation's parameters.

use std::ops::{Bound, RangeInclusive};

use eframe::egui::{Button, ComboBox, Key, Role, TextEdit, Ui, Vec2, WidgetInfo};

use super::number_field::{FieldEvent, NumberField};
use super::theme::STEP;
use super::{figures, widgets};
use crate::editor::Trial;
use crate::operations::{Choice, Kind, Limits, Parameter, Unit, Value};

/// The width of the caption of a field.
const LABEL: f32 = 112.0;

/// The most options that stand side by side as buttons.
const MOST_BUTTONS: usize = 4;

/// The width of a field for a number.
const FIELD: f32 = 120.0;

/// The state of the fields.
#[derive(Default)]
pub struct OperationFields {
    /// The parameter whose field is dragged, with its value before.
    dragged: Option<(&'static str, Value)>,
    /// The list that is typed.
    typed: Option<TypedList>,
    /// Why the last value was not accepted.
    pub refusal: Option<String>,
}

/// A list that is typed: it counts as far as it is one, while it is typed.
struct TypedList {
    parameter: &'static str,
    text: String,
    before: Value,
}

impl OperationFields {
    /// Show the field of a parameter; returns the value that it is given.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        trial: &Trial,
        parameter: &'static Parameter,
    ) -> Option<Value> {
        let value = trial.values().get(parameter);
        let row = widgets::wide_form_row(ui, parameter.label, LABEL, |ui| {
            match (&parameter.kind, value) {
                (Kind::Choice { options, .. }, Value::Choice(chosen)) => {
                    choice_ui(ui, parameter.label, options, *chosen)
                }
                (Kind::List { none, .. }, _) => {
                    self.list_ui(ui, parameter, value, none(Some(trial.input())))
                }
                (Kind::Reference { none }, _) => self.list_ui(ui, parameter, value, none),
                (Kind::Switch { .. }, Value::Switch(on)) => {
                    let mut on = *on;
                    let switch = ui.checkbox(&mut on, "");
                    switch.widget_info(|| {
                        WidgetInfo::selected(Role::CheckBox, true, on, parameter.label)
                    });
                    switch.clicked().then_some(Value::Switch(on))
                }
                _ => self.number_ui(ui, trial, parameter, value),
            }
        });
        row.response.on_hover_text(parameter.help);
        row.inner
    }

    /// A field for numbers with commas between them, which may stay empty. What is typed counts at once,
    /// as far as it is a list that can be given.
    fn list_ui(
        &mut self,
        ui: &mut Ui,
        parameter: &'static Parameter,
        value: &Value,
        none: &str,
    ) -> Option<Value> {
        let typed = self
            .typed
            .take_if(|typed| typed.parameter == parameter.name);
        let (mut text, before) = match typed {
            Some(typed) => (typed.text, typed.before),
            None => (parameter.text(value), value.clone()),
        };
        let field = TextEdit::singleline(&mut text)
            .id_salt(parameter.name)
            .hint_text(none)
            .desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, parameter.label));
        // A text as it was means the same, with what no text tells, such as where a reference lies.
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
            return read.ok().filter(|read| field.changed() && read != value);
        }
        if !field.lost_focus() {
            return None;
        }
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            return Some(before).filter(|before| before != value);
        }
        match read {
            Ok(read) => Some(read).filter(|read| read != value),
            Err(error) => {
                self.refusal = Some(error.to_string());
                Some(before).filter(|before| before != value)
            }
        }
    }

    fn number_ui(
        &mut self,
        ui: &mut Ui,
        trial: &Trial,
        parameter: &'static Parameter,
        value: &Value,
    ) -> Option<Value> {
        let limits = parameter.limits(trial.input()).ok().flatten();
        let number = shown_number(value, parameter.unit());
        let range = field_range(limits, parameter.unit());
        let whole = matches!(value, Value::Whole(_));
        let shown = figures::short(number);
        let speed = if whole { 0.05 } else { speed(&range, number) };
        let field = NumberField::new(parameter.label, number, shown)
            .range(range)
            .quantity(parameter.unit().quantity())
            .speed(speed)
            .width(FIELD);
        let event = field.show(ui).1;
        if parameter.unit() == Unit::Angle {
            widgets::caption(ui, "°");
        }
        let of = |number: f64| given_number(number, value, parameter.unit());
        match event {
            FieldEvent::Idle => None,
            FieldEvent::Typed(number) if whole && number.fract() != 0.0 => {
                self.refusal = Some(format!("{}: a whole number is needed", parameter.label));
                None
            }
            FieldEvent::Typed(number) => Some(of(number)),
            FieldEvent::Preview(number) => {
                self.dragged.get_or_insert((parameter.name, value.clone()));
                Some(of(number))
            }
            FieldEvent::Commit => {
                self.dragged = None;
                None
            }
            FieldEvent::Abort => {
                let before = self.dragged.take();
                before
                    .filter(|(name, _)| *name == parameter.name)
                    .map(|(_, value)| value)
            }
        }
    }
}

/// A row of buttons of which one is pressed; those that do not fit stand below. Many options are a
/// list that opens.
fn choice_ui(ui: &mut Ui, label: &str, options: &'static [Choice], chosen: usize) -> Option<Value> {
    let mut clicked = None;
    if options.len() > MOST_BUTTONS {
        let now = options.get(chosen).map_or("", |option| option.label);
        let list = ComboBox::from_id_salt(label)
            .selected_text(now)
            .width(FIELD);
        let list = list.show_ui(ui, |ui| {
            for (index, option) in options.iter().enumerate() {
                let row = ui.selectable_label(index == chosen, option.label);
                if row.clicked() && index != chosen {
                    clicked = Some(Value::Choice(index));
                }
            }
        });
        let info = || WidgetInfo::labeled(Role::ComboBox, true, label);
        list.response.widget_info(info);
        return clicked;
    }
    ui.horizontal_wrapped(|ui| {
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

/// A number as its field shows it.
fn shown_number(value: &Value, unit: Unit) -> f64 {
    match value {
        Value::Whole(number) => *number as f64,
        Value::Real(number) => unit.shown(*number),
        Value::Choice(_)
        | Value::Switch(_)
        | Value::List(_)
        | Value::Indices(_)
        | Value::Reference(_) => 0.0,
    }
}

/// The value that a field's number stands for, of the kind of another value.
fn given_number(number: f64, like: &Value, unit: Unit) -> Value {
    match like {
        Value::Whole(_) => Value::Whole(number.round().max(0.0) as usize),
        _ => Value::Real(unit.typed(number)),
    }
}

fn field_range(limits: Option<Limits>, unit: Unit) -> RangeInclusive<f64> {
    let (from, to) = limits.unwrap_or((Bound::Unbounded, Bound::Unbounded));
    let from = match from {
        // What is excluded is refused with the words of the parameter.
        Bound::Included(from) | Bound::Excluded(from) => unit.shown(from),
        Bound::Unbounded => f64::NEG_INFINITY,
    };
    let to = match to {
        Bound::Included(to) | Bound::Excluded(to) => unit.shown(to),
        Bound::Unbounded => f64::INFINITY,
    };
    from..=to
}

/// By how much a number changes when its field is dragged by a point: a good way through a range
/// that has an end, otherwise a share of the number.
fn speed(range: &RangeInclusive<f64>, number: f64) -> f64 {
    let width = range.end() - range.start();
    if width.is_finite() && width > 0.0 {
        (0.005 * width).min(0.05)
    } else {
        (0.01 * number.abs()).max(f64::MIN_POSITIVE)
    }
}
