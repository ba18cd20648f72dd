//! The export panel: the program or format, what is written and how, and what that loses.

use eframe::egui::{Context, Key, RichText, ScrollArea, Ui};
use lucide_icons::Icon;

use super::help::{self, Topic};
use super::keyboard::{self, Typing};
use super::number_field::NumberField;
use super::theme::{ROW, STEP, Tokens};
use super::{figures, widgets};
use crate::editor::Editor;
use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;
use crate::io::{ExportChoice, PRESETS, Preset, Scope, counted_items, formats};

/// The width of the panel.
const WIDTH: f32 = 560.0;

/// The width of lists that open.
const LIST: f32 = 176.0;

/// The height of the list of losses, which keeps its size whatever is chosen.
const LOSSES: f32 = 6.0 * ROW;

/// The degrees that are offered as the highest.
const DEGREES: [usize; 5] = [3, 5, 7, 10, 15];

/// The answer of the panel.
pub enum ExportAnswer {
    /// Write nothing.
    Cancel,
    /// Ask for a file and write this.
    Write(Box<ExportChoice>),
}

/// The choice that is being made; `None` while the panel is closed.
#[derive(Default)]
pub struct ExportPanel {
    choice: Option<ExportChoice>,
}

impl ExportPanel {
    /// Open the panel with a choice.
    pub fn open(&mut self, choice: ExportChoice) {
        self.choice = Some(choice);
    }

    /// Show the panel, if it is open. Returns the answer once there is one.
    pub fn show(&mut self, context: &Context, editor: &mut Editor) -> Option<ExportAnswer> {
        let choice = self.choice.as_mut()?;
        if editor.filing().export_forecast().is_none() {
            context.request_repaint();
        }
        let answer = widgets::modal(context, "export", ExportAnswer::Cancel, |ui| {
            ui.set_width(WIDTH);
            let answer = panel_ui(ui, choice, editor);
            help::mark(ui, ui.min_rect(), Topic::Export);
            answer
        });
        if answer.is_some() {
            self.choice = None;
        }
        editor.filing_mut().foresee_export(self.choice.as_ref());
        answer
    }
}

fn panel_ui(ui: &mut Ui, choice: &mut ExportChoice, editor: &Editor) -> Option<ExportAnswer> {
    let is_typing = keyboard::typing(ui.ctx()) == Typing::Text;
    ui.strong("Export");
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = STEP;
        program_ui(ui, choice);
        content_ui(ui, choice);
        form_ui(ui, choice);
        size_ui(ui, choice, editor.document().unit());
    });
    ui.separator();
    let can_write = forecast_ui(ui, editor);
    let is_entered = !is_typing && ui.input(|input| input.key_pressed(Key::Enter));
    let mut answer = None;
    ui.horizontal(|ui| {
        widgets::at_right(ui, |ui| {
            let button = |ui: &mut Ui| widgets::primary_button(ui, "Export…");
            let write = ui.add_enabled_ui(can_write, button).inner;
            if (write.clicked() || is_entered) && can_write {
                answer = Some(ExportAnswer::Write(Box::new(choice.clone())));
            }
            if ui.button("Cancel").clicked() {
                answer = Some(ExportAnswer::Cancel);
            }
        });
    });
    answer
}

/// The program that reads the file, and the format.
fn program_ui(ui: &mut Ui, choice: &mut ExportChoice) {
    widgets::form_row(ui, "Program", |ui| {
        let none = (None, "any".to_owned());
        let presets = PRESETS.iter();
        let presets = presets.map(|preset| (Some(preset), preset.program.to_owned()));
        let all: Vec<(Option<&'static Preset>, String)> =
            [none].into_iter().chain(presets).collect();
        let (other, _) = widgets::drop_down(ui, "Program", LIST, &choice.preset, all);
        match other {
            None => {}
            Some(None) => choice.preset = None,
            Some(Some(preset)) => *choice = choice.clone().with_preset(preset),
        }
        if let Some(preset) = choice.preset {
            widgets::remark(ui, preset.help);
        }
    });
    widgets::form_row(ui, "Format", |ui| {
        let all = formats::writable().filter(|format| !format.holds_documents);
        let all: Vec<_> = all
            .map(|format| (format, format!("{} (.{})", format.name, format.extension())))
            .collect();
        let (other, _) = widgets::drop_down(ui, "Format", LIST, &choice.format, all);
        if let Some(format) = other {
            *choice = ExportChoice {
                scope: choice.scope,
                unit: choice.unit,
                scale: choice.scale,
                ..ExportChoice::new(format)
            };
            if !choice.holds_curves() {
                choice.curves = false;
                choice.points = Some(0.01);
            }
        }
    });
}

/// What is written: which items, and what of each curve.
fn content_ui(ui: &mut Ui, choice: &mut ExportChoice) {
    widgets::form_row(ui, "Items", |ui| {
        for scope in Scope::ALL {
            let name = match scope {
                Scope::Selected => "Selected",
                Scope::Visible => "Visible",
                Scope::All => "All",
            };
            if ui.radio(choice.scope == scope, name).clicked() {
                choice.scope = scope;
            }
        }
    });
    widgets::form_row(ui, "Contents", |ui| {
        ui.add_enabled_ui(choice.holds_curves(), |ui| {
            ui.checkbox(&mut choice.curves, "Curves");
        });
        for kind in PolygonKind::ALL {
            let name = match kind {
                PolygonKind::Float => "Float polygons",
                PolygonKind::Clamped => "Closed polygons",
                PolygonKind::Bezier => "Bézier polygons",
            };
            let mut is_drawn = choice.polygons.contains(&kind);
            if ui.checkbox(&mut is_drawn, name).changed() {
                choice.polygons.retain(|other| *other != kind);
                choice.polygons.extend(Some(kind).filter(|_| is_drawn));
            }
        }
    });
    widgets::form_row(ui, "", |ui| {
        let mut has_points = choice.points.is_some();
        let text = "Points on each curve, polyline within";
        if ui.checkbox(&mut has_points, text).changed() {
            choice.points = has_points.then_some(0.01);
        }
        ui.add_enabled_ui(has_points, |ui| {
            let within = choice.points.unwrap_or(0.01);
            let field = NumberField::new("points within", within, figures::short(within));
            if let Some(value) = length(field).typed(ui) {
                choice.points = Some(value);
            }
        });
    });
}

/// How curves are written: knots, degree and tolerance.
fn form_ui(ui: &mut Ui, choice: &mut ExportChoice) {
    widgets::form_row(ui, "Knots", |ui| {
        ui.add_enabled_ui(choice.has_knots(), |ui| {
            let all = PolygonKind::ALL.map(|kind| {
                let name = match kind {
                    PolygonKind::Float => "uniform, unclamped",
                    PolygonKind::Clamped => "clamped",
                    PolygonKind::Bezier => "Bézier pieces",
                };
                (kind, name.to_owned())
            });
            let preferred = match choice.holds_splines() {
                true => PolygonKind::Clamped,
                false => PolygonKind::Float,
            };
            let shown = choice.knots.unwrap_or(preferred);
            let (other, _) = widgets::drop_down(ui, "Knots", LIST, &shown, all);
            choice.knots = other.or(choice.knots);
        });
        let note = match (choice.holds_cubics_alone(), choice.has_knots()) {
            (true, _) => "the format holds cubic Béziers alone",
            (false, true) => "most programs expect clamped",
            (false, false) => "",
        };
        widgets::remark(ui, note);
    });
    widgets::form_row(ui, "Degree", |ui| {
        ui.add_enabled_ui(!choice.holds_cubics_alone() && choice.curves, |ui| {
            let own = (None, "as it is".to_owned());
            let degrees = DEGREES.map(|degree| (Some(degree), format!("at most {degree}")));
            let other = choice
                .most_degree
                .filter(|degree| !DEGREES.contains(degree));
            let other = other.map(|degree| (Some(degree), format!("at most {degree}")));
            let all = [own].into_iter().chain(degrees).chain(other);
            let (chosen, _) =
                widgets::drop_down(ui, "Highest degree", LIST, &choice.most_degree, all);
            choice.most_degree = chosen.unwrap_or(choice.most_degree);
        });
        let is_near = choice.most_degree.is_some() || choice.holds_cubics_alone();
        ui.add_enabled_ui(is_near, |ui| {
            ui.label("within");
            let shown = choice
                .tolerance
                .map_or("1e-4 of size".to_owned(), figures::short);
            let value = choice.tolerance.unwrap_or(1e-4);
            let field = NumberField::new("curves within", value, shown);
            choice.tolerance = length(field).typed(ui).or(choice.tolerance);
        });
    });
}

/// The unit and the scale.
fn size_ui(ui: &mut Ui, choice: &mut ExportChoice, own: Option<LengthUnit>) {
    widgets::form_row(ui, "Unit", |ui| {
        let own = own.map_or("none, as the document", LengthUnit::name);
        let own = (None, own.to_owned());
        let units = LengthUnit::ALL.map(|unit| (Some(unit), unit.name().to_owned()));
        let all = [own].into_iter().chain(units);
        let (other, _) = widgets::drop_down(ui, "Unit", LIST, &choice.unit, all);
        choice.unit = other.unwrap_or(choice.unit);
        ui.label("scale");
        let field = NumberField::new("scale", choice.scale, figures::short(choice.scale));
        let field = field.range(f64::MIN_POSITIVE..=f64::INFINITY).width(96.0);
        choice.scale = field.typed(ui).unwrap_or(choice.scale);
    });
}

fn length(field: NumberField<'_>) -> NumberField<'_> {
    let field = field.quantity(Quantity::Length).width(96.0);
    field.range(f64::MIN_POSITIVE..=f64::INFINITY)
}

/// What the file will hold and lose. Returns whether it can be written.
fn forecast_ui(ui: &mut Ui, editor: &Editor) -> bool {
    let tokens = Tokens::of(ui);
    let forecast = editor.filing().export_forecast();
    let heading = match forecast {
        Some(Ok(forecast)) => {
            let [curves, references] = forecast.counts;
            let kilobytes = (forecast.bytes as f64 / 1000.0).max(0.1);
            let counted = counted_items(curves, references);
            format!("{counted}, {} kB. ", figures::significant(kilobytes, 2))
        }
        _ => String::new(),
    };
    let loses = match forecast {
        None => "Working out what is lost…".to_owned(),
        Some(Err(_)) => "This cannot be written:".to_owned(),
        Some(Ok(it)) if it.losses.is_empty() => "Nothing is lost.".to_owned(),
        Some(Ok(_)) => "Lost or changed:".to_owned(),
    };
    ui.label(RichText::new(heading + &loses).color(tokens.text));
    let area = ScrollArea::vertical().id_salt("losses");
    let area = area.max_height(LOSSES).min_scrolled_height(LOSSES);
    area.auto_shrink([false, false]).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 0.5 * STEP;
        match forecast {
            None => {}
            Some(Err(refusal)) => {
                let text = super::message::sentence(&refusal.0);
                widgets::remark_with_icon(ui, Icon::TriangleAlert, &text, tokens.error);
            }
            Some(Ok(forecast)) => {
                for line in &forecast.losses {
                    widgets::remark_with_icon(ui, Icon::TriangleAlert, line, tokens.warning);
                }
                for line in &forecast.rounding {
                    widgets::remark_with_icon(ui, Icon::Info, line, tokens.faint_text);
                }
            }
        }
    });
    matches!(forecast, Some(Ok(_)))
}
