//! The operation panel: the parameters of the operation that is tried out, and what it does.

use std::ops::{Bound, RangeInclusive};

use eframe::egui::{
    Button, ComboBox, Key, Label, ProgressBar, RichText, Role, ScrollArea, Sense, TextEdit, Ui,
    Vec2, WidgetInfo, vec2,
};
use lucide_icons::Icon;

use super::atlas::AtlasView;
use super::number_field::{FieldEvent, NumberField};
use super::theme::{STEP, Tokens};
use super::widgets::IconButton;
use super::{figures, widgets};
use crate::editor::{Editor, Trial, told};
use crate::geometry::approximation::LevelComparison;
use crate::geometry::features::Verdict;
use crate::geometry::harmony::{Harmony, Match};
use crate::geometry::{counted, rounded_up};
use crate::operations::{
    Atlas, Choice, Deviation, FeatureCounts, Figure, Kind, Limits, Parameter, Report, Unit, Value,
};

/// How faint figures are that are of other values.
const OUTDATED: f32 = 0.5;

/// The width of a column of figures.
const COLUMN: f32 = 96.0;

/// The width of the caption of a field.
const LABEL: f32 = 112.0;

/// The most options that stand side by side as buttons.
const MOST_BUTTONS: usize = 4;

/// The height that is kept for buttons and report.
const REPORT: f32 = 430.0;

/// The least height of the fields.
const LEAST_FIELDS: f32 = 120.0;

/// The width of a field for a number.
const FIELD: f32 = 120.0;

/// The panel's own state.
#[derive(Default)]
pub struct OperationPanel {
    /// The parameter whose field is dragged, with its value before.
    dragged: Option<(&'static str, Value)>,
    /// The list that is typed.
    typed: Option<TypedList>,
    /// Why the last value was not accepted.
    refusal: Option<String>,
    atlas: AtlasView,
}

/// A list that is typed: it counts as far as it is one, while it is typed.
struct TypedList {
    parameter: &'static str,
    text: String,
    before: Value,
}

/// What the user asks for.
enum Asked {
    Set(&'static Parameter, Value),
    SetAll(Vec<(&'static str, Value)>),
    Apply,
    Leave,
}

impl OperationPanel {
    /// Show the panel of the operation that is tried out, or was applied last, in so much height: of many
    /// fields the last ones are reached by scrolling, so that the report below is in sight.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, height: f32) {
        let Some(trial) = editor.trial() else {
            *self = Self::default();
            return;
        };
        let atlas = atlas_of(trial).copied();
        let mut shows_atlas = false;
        let told_before = self.refusal.clone();
        // A click on a button also leaves a field: what was typed there counts first.
        let top = ui.cursor().top();
        let mut asked = Vec::from_iter(heading_ui(ui, trial));
        let left = height - (ui.cursor().top() - top) - REPORT;
        let fields = ScrollArea::vertical()
            .id_salt((trial.operation().name, "fields"))
            .max_height(left.max(LEAST_FIELDS));
        fields.show(ui, |ui| {
            let parameters = trial.operation().parameters.iter();
            for parameter in parameters.filter(|it| it.applies(trial.input())) {
                let set = self.parameter_ui(ui, trial, parameter);
                asked.extend(set.map(|value| Asked::Set(parameter, value)));
            }
        });
        // The buttons keep their place, whatever the report below has to say.
        asked.extend(buttons_ui(ui, trial, editor.operation_progress()));
        ui.add_space(STEP);
        if let Some(refusal) = &self.refusal {
            error_ui(ui, refusal);
        }
        if let Some(atlas) = &atlas {
            let view = &mut self.atlas;
            let shown =
                widgets::section(ui, "Atlas", true, |ui| view.show(ui, editor, trial, atlas));
            shows_atlas = shown.is_some();
            asked.extend(shown.flatten().map(Asked::SetAll));
            ui.add_space(STEP);
        }
        came_to_ui(ui, trial);
        editor.view_mut().show_atlas(shows_atlas);
        for asked in asked {
            match asked {
                Asked::Set(parameter, value) => {
                    let set = editor.set_value(parameter.name, value);
                    let refused = set.err().map(|error| error.to_string());
                    // A text that was refused just now gave back the value before it.
                    if refused.is_some() || self.refusal == told_before {
                        self.refusal = refused;
                    }
                }
                Asked::SetAll(values) => {
                    let set = editor.set_values(&values);
                    self.refusal = set.err().map(|error| error.to_string());
                }
                Asked::Apply => told(editor.apply_trial()),
                Asked::Leave => editor.leave_trial(),
            }
        }
    }

    fn parameter_ui(
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

/// The atlas that the operation offers.
fn atlas_of(trial: &Trial) -> Option<&Atlas> {
    let run = trial.run()?.as_ref().ok()?;
    run.outcome.atlas.as_ref()
}

fn heading_ui(ui: &mut Ui, trial: &Trial) -> Option<Asked> {
    let mut left = false;
    ui.horizontal(|ui| {
        ui.strong(trial.operation().label);
        if trial.is_applied() {
            widgets::caption(ui, "applied");
            widgets::at_right(ui, |ui| {
                let close = IconButton::new(Icon::X, "Close operation");
                left = close.size(5.0 * STEP).show(ui).clicked();
            });
        }
    });
    widgets::note(ui, trial.operation().help);
    left.then_some(Asked::Leave)
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

fn came_to_ui(ui: &mut Ui, trial: &Trial) {
    ui.scope(|ui| {
        if trial.is_pending() {
            ui.multiply_opacity(OUTDATED);
        }
        match trial.run() {
            None => {}
            Some(Err(error)) => error_ui(ui, &error.to_string()),
            Some(Ok(run)) => report_ui(ui, trial, &run.report),
        }
    });
}

fn report_ui(ui: &mut Ui, trial: &Trial, report: &Report) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        if !report.reached {
            error_ui(
                ui,
                match report.useful {
                    true => "Not reached: this is the best found",
                    false => "Not reached: nothing would be changed",
                },
            );
        }
        let length = |value: f64| figures::significant(value, 4);
        let deviation = match report.deviation {
            _ if !report.useful => None,
            Deviation::Exact => Some("none, exact".to_owned()),
            Deviation::AtMost(0.0) => Some("none".to_owned()),
            Deviation::AtMost(bound) => Some(format!("at most {}", rounded_up(bound))),
            Deviation::Measured(measured) => Some(length(measured)),
            Deviation::Unmeasured => Some("another curve, not measured".to_owned()),
        };
        if let Some(deviation) = deviation {
            widgets::figure_row(ui, "Deviation", &deviation);
        }
        if let Some(residual) = report.residual {
            widgets::figure_row(ui, "Residual", &length(residual));
        }
        if let Some(largest) = report.largest_move {
            let text = match largest.distance {
                0.0 => "none".to_owned(),
                distance => format!("{} at vertex {}", length(distance), largest.vertex),
            };
            widgets::figure_row(ui, "Largest move", &text);
        }
        for figure in &report.figures {
            widgets::figure_row(ui, figure.label, &figure_text(figure));
        }
        for level in report.equivalence.iter().flatten() {
            equivalence_ui(ui, level);
        }
        if report.useful {
            features_ui(ui, trial);
        }
    });
    for remark in &report.remarks {
        widgets::note(ui, remark);
    }
}

/// Whether a level has the features of what the curve stands for; both are listed as one points at it.
fn equivalence_ui(ui: &mut Ui, level: &LevelComparison) {
    let name = level.name();
    let there: Vec<&str> = level.there.iter().map(|feature| feature.name()).collect();
    let here = level.here.iter();
    let here: Vec<String> = here
        .map(|(u, feature)| format!("{} at u = {}", feature.name(), figures::significant(*u, 4)))
        .collect();
    let text = match level.first_difference() {
        None => format!("the same {}", counted(there.len(), "feature", "features")),
        Some(index) => format!("differs from feature {} on", index + 1),
    };
    let listed = |features: String| {
        if features.is_empty() {
            "none".to_owned()
        } else {
            features
        }
    };
    let hover = format!(
        "Reference: {}\nCurve: {}",
        listed(there.join(", ")),
        listed(here.join(", "))
    );
    let row = ui.scope(|ui| {
        if !level.is_equal() {
            let error = Tokens::of(ui).error;
            ui.visuals_mut().override_text_color = Some(error);
        }
        widgets::figure_row(ui, &name, &text);
    });
    row.response.on_hover_text(hover);
}

fn figure_text(figure: &Figure) -> String {
    match &figure.value {
        Value::Whole(number) => number.to_string(),
        Value::Real(number) if figure.unit == Unit::Angle => figures::degrees(*number, 4),
        Value::Real(number) => figures::significant(*number, 4),
        Value::Choice(index) => index.to_string(),
        Value::List(numbers) => {
            let numbers = numbers
                .iter()
                .map(|number| figures::significant(*number, 4));
            numbers.collect::<Vec<_>>().join(", ")
        }
        Value::Indices(indices) => {
            let indices = indices.iter().map(usize::to_string);
            indices.collect::<Vec<_>>().join(", ")
        }
        Value::Reference(reference) => {
            let text = reference.as_ref().map(|reference| reference.to_string());
            text.unwrap_or_default()
        }
        Value::Switch(on) => if *on { "yes" } else { "no" }.to_owned(),
    }
}

/// How many features of a kind there are.
type Count = fn(&FeatureCounts) -> usize;

/// The proved features, before and afterwards, of each kind that there is.
fn features_ui(ui: &mut Ui, trial: &Trial) {
    let Some((features, current)) = trial.features() else {
        widgets::figure_row(ui, "Features", "being proved …");
        return;
    };
    if !current && !trial.is_pending() {
        ui.multiply_opacity(OUTDATED);
    }
    let kinds: [(&str, Count); 6] = [
        ("Curvature extrema", |counts| counts.curvature_extrema),
        ("Inflections", |counts| counts.inflections),
        ("Torsion extrema", |counts| counts.torsion_extrema),
        ("Torsion zeros", |counts| counts.torsion_zeros),
        ("Cusps", |counts| counts.cusps),
        ("Undecided", |counts| counts.undecided),
    ];
    let (before, after) = (&features.before, &features.after);
    before_after_ui(ui, "", "before", "after");
    for (number, (name, count)) in kinds.into_iter().enumerate() {
        let mut all = before.iter().chain(after);
        // Extrema of the curvature are what a curve is judged by: told even if there are none.
        if number == 0 || all.any(|counts| count(counts) > 0) {
            let listed = |counts: &[FeatureCounts]| joined(counts, |c| count(c).to_string());
            before_after_ui(ui, name, &listed(before), &listed(after));
        }
    }
    let verdicts = |counts: &[FeatureCounts]| joined(counts, |c| verdict(c.monotone).to_owned());
    before_after_ui(ui, "Monotone", &verdicts(before), &verdicts(after));
    for (name, text) in HARMONY {
        let has = |counts: &FeatureCounts| text(&counts.harmony).is_some();
        if before.iter().chain(after).any(has) {
            let or_none = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
            let told = |counts: &[FeatureCounts]| joined(counts, |c| or_none(text(&c.harmony)));
            before_after_ui(ui, name, &told(before), &told(after));
        }
    }
}

/// A figure of the harmony in a few characters; `None` of a curve that has none.
type HarmonyText = fn(&Harmony) -> Option<String>;

/// The harmony, before and afterwards.
const HARMONY: [(&str, HarmonyText); 10] = [
    ("Discrete κ follows", |harmony| {
        Some(follows(harmony.curvature.verdict))
    }),
    ("Discrete τ follows", |harmony| {
        Some(follows(harmony.torsion?.verdict))
    }),
    ("Regular to order", |harmony| {
        let regularity = harmony.regularity;
        Some(format!("{} of {}", regularity.order, regularity.highest))
    }),
    ("Leg change Δ²", |harmony| {
        Some(figures::significant(harmony.figures.legs?.value, 3))
    }),
    ("Turning change Δ²", |harmony| {
        Some(figures::small_angle(harmony.figures.turns?.value))
    }),
    ("Torsion change Δ²", |harmony| {
        Some(figures::small_angle(harmony.figures.torsions?.value))
    }),
    ("Discrete κ extrema", |harmony| {
        Some(harmony.figures.curvature_extrema.to_string())
    }),
    ("Bending energy", |harmony| {
        Some(energy(harmony.fairness.bending_energy))
    }),
    ("Variation", |harmony| {
        Some(energy(harmony.fairness.variation))
    }),
    ("Slope α (longest)", |harmony| {
        Some(figures::significant(harmony.longest_slope()?.slope, 3))
    }),
];

/// Say whether a polygon's extrema and changes of sign are those of its curve.
fn follows(verdict: Match) -> String {
    match verdict {
        Match::Agrees => "yes",
        Match::Differs(_) => "no",
        Match::Undecided(_) => "undecided",
    }
    .to_owned()
}

/// Write an energy, which is infinite where it is not a number.
fn energy(energy: Option<f64>) -> String {
    energy.map_or("∞".to_owned(), |energy| figures::significant(energy, 5))
}

fn joined(counts: &[FeatureCounts], text: impl Fn(&FeatureCounts) -> String) -> String {
    let texts: Vec<String> = counts.iter().map(text).collect();
    if texts.is_empty() {
        "–".to_owned()
    } else {
        texts.join(", ")
    }
}

/// One row of figures in two columns: what was, and what is.
fn before_after_ui(ui: &mut Ui, name: &str, before: &str, after: &str) {
    let told = format!("{name}: {before} before, {after} after");
    let line = 5.0 * STEP;
    // The figures of several curves take a line of their own.
    let wide = before.contains(", ") || after.contains(", ");
    let lines = if wide { 2.0 } else { 1.0 };
    let size = vec2(ui.available_width(), lines * line);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let tokens = Tokens::of(ui);
    let top = rect.with_max_y(rect.top() + line);
    widgets::label_in(ui, top, name, tokens.faint_text);
    let rect = rect.with_min_y(rect.bottom() - line);
    let column = if wide { 0.5 * rect.width() } else { COLUMN };
    let left = rect.with_max_x(rect.right() - column);
    widgets::number_in(ui, left, before, tokens.text);
    widgets::number_in(ui, rect, after, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, told.clone()));
}

fn verdict(monotone: Verdict) -> &'static str {
    match monotone {
        Verdict::Proved => "yes",
        Verdict::Disproved => "no",
        Verdict::Undecided => "undecided",
    }
}

fn error_ui(ui: &mut Ui, text: &str) {
    let text = RichText::new(text).color(Tokens::of(ui).error);
    ui.add(Label::new(text).wrap());
}

/// Apply and Cancel; their keys are the canvas's, which has the keyboard unless a field has it.
fn buttons_ui(ui: &mut Ui, trial: &Trial, progress: Option<f64>) -> Option<Asked> {
    if trial.is_applied() {
        return None;
    }
    let mut asked = None;
    let fails = |run: &Result<crate::editor::Run, _>| {
        run.as_ref().map_or(true, |run| !run.outcome.is_useful())
    };
    let enabled = !trial.run().is_some_and(fails);
    ui.add_space(STEP);
    ui.horizontal(|ui| {
        let apply = ui.add_enabled_ui(enabled, |ui| widgets::primary_button(ui, "Apply"));
        if apply.inner.on_hover_text("Enter").clicked() {
            asked = Some(Asked::Apply);
        }
        if ui.button("Cancel").on_hover_text("Esc").clicked() {
            asked = Some(Asked::Leave);
        }
        if let Some(done) = progress {
            ui.add(ProgressBar::new(done as f32).show_percentage());
        }
    });
    asked
}
