//! The dialogs that divide a curve and round its coordinates: they tell beforehand what will come
//! of it.

use eframe::egui::{Button, Ui, vec2};

use super::dialogs::Decision;
use super::number_field::{FieldEvent, NumberField};
use super::theme::{ROW, STEP, Tokens};
use super::{figures, widgets};
use crate::editor::{Division, DivisionReport, Editor, ExtremaCount, RoundingReport};
use crate::geometry::{MAX_SUBDIVISIONS, PolygonKind, counted, noun};

/// The width of these dialogs.
const WIDTH: f32 = 420.0;

/// Splitting or trimming, as it is being chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct DivisionDialog {
    trims: bool,
    /// Where it is split, or where the part that is kept begins.
    from: f64,
    /// Where the part that is kept ends.
    to: f64,
    subdivisions: u32,
    /// What would come of it, for what was last looked at.
    tried: Option<(Division, u32, Result<DivisionReport, String>)>,
}

impl DivisionDialog {
    /// Begin in the middle of the active curve.
    pub fn new(editor: &Editor) -> Self {
        let segments = active_segments(editor);
        Self {
            trims: false,
            from: if segments > 1.0 {
                (0.5 * segments).floor()
            } else {
                0.5
            },
            to: segments,
            subdivisions: 0,
            tried: None,
        }
    }

    fn division(&self) -> Division {
        if self.trims {
            Division::Trim(self.from, self.to)
        } else {
            Division::Split(self.from)
        }
    }

    /// Show the dialog's contents.
    pub fn show(&mut self, ui: &mut Ui, editor: &Editor) -> Option<Decision> {
        ui.set_width(WIDTH);
        ui.strong("Split or trim the curve");
        choice_ui(
            ui,
            &mut self.trims,
            [(false, "Split in two"), (true, "Keep a part")],
        );
        let last = active_segments(editor);
        let first = if self.trims { "From u" } else { "At u" };
        parameter_ui(ui, first, &mut self.from, last);
        if self.trims {
            parameter_ui(ui, "To u", &mut self.to, last);
        }
        widgets::form_row(ui, "Subdivisions", |ui| {
            let shown = self.subdivisions.to_string();
            let field = NumberField::new("Subdivisions", f64::from(self.subdivisions), shown);
            let field = field.range(0.0..=f64::from(MAX_SUBDIVISIONS)).speed(0.05);
            if let FieldEvent::Typed(value) | FieldEvent::Preview(value) = field.show(ui).1 {
                self.subdivisions = value.round().max(0.0) as u32;
            }
            let noun = noun(self.subdivisions as usize, "halving", "halvings");
            widgets::caption(ui, &format!("{noun} of the segments, at most"));
        });
        widgets::note(
            ui,
            "At a knot (a whole u) the parts are exact. Elsewhere they are if subdividing brings \
             a knot there; otherwise they come near.",
        );
        let (division, most) = (self.division(), self.subdivisions);
        let tried = self.tried.take();
        let tried = tried.filter(|tried| (tried.0, tried.1) == (division, most));
        let (_, _, tried) = self
            .tried
            .insert(tried.unwrap_or_else(|| (division, most, editor.try_division(division, most))));
        let is_good = tried.is_ok();
        let (text, colour) = match tried {
            Ok(report) => {
                let vertices = report
                    .parts
                    .iter()
                    .map(|part| part.polygon.vertices().len());
                let counts: Vec<String> = vertices.map(|count| count.to_string()).collect();
                let counts = counts.join(" and ");
                let quality = if report.is_exact() {
                    "exact".to_owned()
                } else {
                    let off = figures::significant(report.deviation(), 3);
                    format!("at most {off} off the curve")
                };
                (format!("{counts} vertices, {quality}"), Tokens::of(ui).text)
            }
            Err(reason) => (reason.clone(), Tokens::of(ui).error),
        };
        outcome_ui(ui, &text, colour);
        let verb = if self.trims { "Trim" } else { "Split" };
        let decided = Decision::Divide(self.division(), self.subdivisions);
        buttons_ui(ui, verb, is_good, decided)
    }
}

/// Rounding, as it is being chosen.
#[derive(Debug)]
pub struct RoundingDialog {
    kind: PolygonKind,
    digits: usize,
    /// What would come of it, for the kind and the digits that were last looked at.
    tried: Option<(PolygonKind, usize, Result<RoundingReport, String>)>,
}

impl Default for RoundingDialog {
    fn default() -> Self {
        Self {
            kind: PolygonKind::Float,
            digits: 3,
            tried: None,
        }
    }
}

impl RoundingDialog {
    /// Show the dialog's contents.
    pub fn show(&mut self, ui: &mut Ui, editor: &Editor) -> Option<Decision> {
        ui.set_width(WIDTH);
        ui.strong("Round coordinates");
        let kinds = [
            (PolygonKind::Float, "Float S-polygon"),
            (PolygonKind::Clamped, "Closed S-polygon"),
        ];
        choice_ui(ui, &mut self.kind, kinds);
        widgets::form_row(ui, "Digits", |ui| {
            let shown = self.digits.to_string();
            let field = NumberField::new("Digits", self.digits as f64, shown);
            let field = field.range(0.0..=17.0).speed(0.05);
            if let FieldEvent::Typed(value) | FieldEvent::Preview(value) = field.show(ui).1 {
                self.digits = value.round().max(0.0) as usize;
            }
            widgets::caption(ui, "behind the decimal point");
        });
        let (kind, digits) = (self.kind, self.digits);
        let tried = self.tried.take();
        let tried = tried.filter(|tried| (tried.0, tried.1) == (kind, digits));
        let (_, _, tried) = self
            .tried
            .insert(tried.unwrap_or_else(|| (kind, digits, editor.try_rounding(kind, digits))));
        let is_good = tried.is_ok();
        match tried {
            Ok(report) => {
                let length = |value: f64| figures::significant(value, 4);
                let counts = report.extrema();
                if counts.contains(&None) {
                    ui.ctx().request_repaint();
                }
                let [before, after] = counts.map(extrema);
                let rows = [
                    ("Largest move of a vertex", length(report.moved)),
                    ("… of the float S-polygon", length(report.float_moved)),
                    (
                        "Largest move of the curve, at most",
                        length(report.deviation),
                    ),
                    ("Curvature extrema before", before),
                    ("Curvature extrema afterwards", after),
                ];
                for (name, figure) in rows {
                    widgets::figure_row(ui, name, &figure);
                }
            }
            Err(reason) => outcome_ui(ui, reason, Tokens::of(ui).error),
        }
        let decided = Decision::Round(self.kind, self.digits);
        buttons_ui(ui, "Round", is_good, decided)
    }
}

/// How many curvature extrema are proved, and how many pieces are undecided.
fn extrema(count: Option<ExtremaCount>) -> String {
    match count {
        None => "being proved …".to_owned(),
        Some(ExtremaCount { proved, undecided }) => match undecided {
            0 => proved.to_string(),
            doubts => {
                let pieces = counted(doubts, "piece", "pieces");
                format!("{proved}, {pieces} undecided")
            }
        },
    }
}

fn active_segments(editor: &Editor) -> f64 {
    let active = editor.active().and_then(|id| editor.document().curve(id));
    active.map_or(1.0, |curve| curve.polygon.segments() as f64)
}

/// A row of buttons of which one is pressed.
fn choice_ui<T: PartialEq + Copy>(ui: &mut Ui, chosen: &mut T, choices: [(T, &str); 2]) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        for (choice, name) in choices {
            let button = Button::selectable(*chosen == choice, name);
            if ui.add_sized(vec2(140.0, ROW), button).clicked() {
                *chosen = choice;
            }
        }
    });
}

fn parameter_ui(ui: &mut Ui, name: &str, value: &mut f64, last: f64) {
    widgets::form_row(ui, name, |ui| {
        let shown = figures::to_resolution(*value, 1e-6);
        let field = NumberField::new(name, *value, shown).range(0.0..=last);
        let field = field.speed((0.005 * last).min(0.05)).width(120.0);
        if let FieldEvent::Typed(typed) | FieldEvent::Preview(typed) = field.show(ui).1 {
            *value = typed;
        }
        widgets::caption(ui, &format!("of {last}"));
    });
}

fn outcome_ui(ui: &mut Ui, text: &str, colour: eframe::egui::Color32) {
    let text = eframe::egui::RichText::new(text).color(colour);
    ui.add(eframe::egui::Label::new(text).wrap());
}

fn buttons_ui(ui: &mut Ui, verb: &str, is_good: bool, decided: Decision) -> Option<Decision> {
    let mut decision = None;
    ui.horizontal(|ui| {
        widgets::at_right(ui, |ui| {
            let done = ui.add_enabled_ui(is_good, |ui| widgets::primary_button(ui, verb));
            if done.inner.clicked() {
                decision = Some(decided);
            }
            if ui.button("Cancel").clicked() {
                decision = Some(Decision::Close);
            }
        });
    });
    decision
}
