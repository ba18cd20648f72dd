//! The result of the operation in progress: report, figures, and features before and after.

use eframe::egui::text::LayoutJob;
use eframe::egui::{Color32, Label, TextStyle, Ui};
use lucide_icons::Icon;

use super::atlas::Values;
use super::feature_comparison::{Comparison, OUTDATED, monotone_ui};
use super::level_comparison::level_comparisons_ui;
use super::message::sentence;
use super::steady_rows::SteadyRows;
use super::theme::Tokens;
use super::trade_off::TradeOff;
use super::{document_unit, figures, widgets};
use crate::document::{CurveId, quoted};
use crate::editor::{OperationInProgress, Run};
use crate::geometry::parameters::Quantity;
use crate::geometry::rounded_up;
use crate::operations::{Deviation, Figure, Parameter, Report, Value};

/// The report of one operation; its rows keep their places.
#[derive(Default)]
pub struct ReportView {
    operation: &'static str,
    figures: SteadyRows,
    features: Comparison,
    trade_off: TradeOff,
}

impl ReportView {
    /// Show the result, faintly while other values run; returns the values that a click asks for.
    pub fn show(&mut self, ui: &mut Ui, in_progress: &OperationInProgress) -> Option<Values> {
        let operation = in_progress.operation().name;
        if self.operation != operation {
            *self = Self {
                operation,
                ..Self::default()
            };
        }
        let shown = ui.scope(|ui| {
            if in_progress.is_pending() {
                ui.multiply_opacity(OUTDATED);
            }
            let run = in_progress.run()?.as_ref().ok()?;
            if let Some(item) = run.item() {
                widgets::caption(ui, &name_of(in_progress, item));
            }
            let clicked = self.report_ui(ui, in_progress, &run.report);
            others_ui(ui, in_progress, run);
            clicked
        });
        shown.inner
    }

    fn report_ui(
        &mut self,
        ui: &mut Ui,
        in_progress: &OperationInProgress,
        report: &Report,
    ) -> Option<Values> {
        // The first one stands below the report.
        for warning in report.warnings.iter().skip(1) {
            widgets::warning(ui, warning);
        }
        let clicked = self.trade_off_ui(ui, in_progress, report);
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for (name, figure) in self.figures.in_place(figures_of(ui, report)) {
                let figure = figure.unwrap_or_else(|| "–".to_owned());
                widgets::figure_row(ui, name, &figure);
            }
            level_comparisons_ui(ui, report.equivalence.as_deref().unwrap_or_default());
            if report.useful {
                self.features.show(ui, in_progress);
            }
        });
        for remark in &report.remarks {
            widgets::note(ui, remark);
        }
        clicked
    }

    /// What each number of extrema reaches, if the operation has tried several.
    fn trade_off_ui(
        &mut self,
        ui: &mut Ui,
        in_progress: &OperationInProgress,
        report: &Report,
    ) -> Option<Values> {
        let mut tables = report
            .figures
            .iter()
            .filter_map(|figure| match &figure.value {
                Value::Table { rows, .. } => Some(rows),
                _ => None,
            });
        let rows = tables.next()?;
        if !in_progress.is_pending() {
            let parameters = in_progress.operation().parameters.iter();
            let value = |it: &Parameter| (it.name, in_progress.values().get(it).clone());
            self.trade_off.take(rows, parameters.map(value).collect());
        }
        let present = match report.figure("extrema") {
            Some(Value::Whole(extrema)) => Some(extrema),
            _ => None,
        };
        self.trade_off.show(ui, present)
    }
}

/// The name of a curve or a reference in a heading.
fn name_of(in_progress: &OperationInProgress, item: CurveId) -> String {
    let name = in_progress.input().document().name(item);
    quoted(name.unwrap_or_default())
}

/// Tell in a line what was done to each of the other items, or why nothing was.
fn others_ui(ui: &mut Ui, in_progress: &OperationInProgress, run: &Run) {
    let error = Tokens::of(ui).error;
    for other in &run.others {
        let text = other.line(in_progress.input().document());
        match other.is_useful() {
            true => drop(widgets::note(ui, &text)),
            false => {
                let icon = Icon::TriangleAlert;
                widgets::remark_with_icon(ui, icon, &text, error);
            }
        }
    }
}

/// Say why the values have no result, or only a partial one.
pub fn failure(in_progress: &OperationInProgress) -> Option<String> {
    let report = match in_progress.run()? {
        Err(error) => return Some(sentence(&error.to_string())),
        Ok(run) if run.report.reached => return None,
        Ok(run) => &run.report,
    };
    let otherwise = match report.useful {
        true => "this is the best found",
        false => "nothing will change",
    };
    let why = report.warnings.iter().chain(&report.remarks).next();
    let why = why.map_or(otherwise, String::as_str);
    Some(format!("Not reached: {why}"))
}

/// The first thing that the user may not want in the result.
pub fn warning(in_progress: &OperationInProgress) -> Option<&str> {
    let run = in_progress.run()?.as_ref().ok()?;
    run.report.warnings.first().map(String::as_str)
}

/// Show the summary, always of as many rows: how far the curve moves and its vertices, or whether it has
/// the shape of its source; and whether its curvature is monotone.
pub fn summary_ui(ui: &mut Ui, in_progress: &OperationInProgress) {
    let Some(run) = in_progress.run() else {
        return;
    };
    let report = run.as_ref().ok().map(|run| &run.report);
    let dash = || "–".to_owned();
    ui.scope(|ui| {
        if in_progress.is_pending() {
            ui.multiply_opacity(OUTDATED);
        }
        let deviation = report.and_then(|report| deviation(ui, report));
        widgets::figure_row(ui, "Deviation", &deviation.unwrap_or_else(dash));
        if let Some(report) = report.filter(|report| report.equivalence.is_some()) {
            widgets::figure_row(ui, "Shape", &shape(report));
        } else {
            let largest = report.and_then(|report| largest_move(ui, report));
            widgets::figure_row(ui, "Largest move", &largest.unwrap_or_else(dash));
        }
        match report.filter(|report| report.useful) {
            Some(_) => monotone_ui(ui, in_progress),
            None => drop(widgets::figure_row(ui, "Monotone", &dash())),
        }
    });
}

/// How far the curve moves, in words.
fn deviation(ui: &Ui, report: &Report) -> Option<String> {
    Some(match report.deviation {
        _ if !report.useful => return None,
        Deviation::Exact => "none, exact".to_owned(),
        Deviation::AtMost(0.0) => "none".to_owned(),
        Deviation::AtMost(bound) => {
            let bound = document_unit::length(ui.ctx(), rounded_up(bound));
            format!("at most {bound}")
        }
        Deviation::Measured(sampled) => format!("{}, sampled", length(ui, sampled)),
        Deviation::FromPoints(measured) => length(ui, measured),
        Deviation::Unmeasured => "another curve, not measured".to_owned(),
    })
}

/// How far the vertex moves that moves most, in words.
fn largest_move(ui: &Ui, report: &Report) -> Option<String> {
    let largest = report.largest_move?;
    Some(match largest.distance {
        0.0 => "none".to_owned(),
        distance => format!("{} at vertex {}", length(ui, distance), largest.vertex),
    })
}

/// Whether the curve has the shape of its source, in words.
fn shape(report: &Report) -> String {
    match report.differing_level() {
        Some(level) => format!("{} differs", level.name()),
        None => "the same at all levels".to_owned(),
    }
}

fn length(ui: &Ui, value: f64) -> String {
    document_unit::length(ui.ctx(), figures::significant(value, 4))
}

/// The figures beside those of the summary, by their names.
fn figures_of(ui: &Ui, report: &Report) -> Vec<(&'static str, String)> {
    let residual = report
        .residual
        .map(|residual| ("Residual", length(ui, residual)));
    let figures = report.figures.iter();
    // A table has a plot of its own.
    let figures = figures.filter(|figure| !matches!(figure.value, Value::Table { .. }));
    let figures = figures.map(|figure| (figure.label, figure_text(ui, figure)));
    residual.into_iter().chain(figures).collect()
}

fn figure_text(ui: &Ui, figure: &Figure) -> String {
    match &figure.value {
        Value::Whole(number) => number.to_string(),
        Value::Real(number) if figure.quantity == Quantity::Angle => figures::degrees(*number, 4),
        Value::Real(number) if figure.quantity == Quantity::Length => length(ui, *number),
        Value::Real(number) => figures::significant(*number, 4),
        Value::Choice(index) => index.to_string(),
        Value::List(numbers) => joined(numbers, |number| figures::significant(*number, 4)),
        Value::Indices(indices) => joined(indices, usize::to_string),
        Value::Table { rows, .. } => rows.len().to_string(),
        Value::Word(word) => (*word).to_owned(),
        Value::Ends([first, second]) => format!("{} and {}", first.name(), second.name()),
        Value::Reference(reference) => {
            let text = reference.as_ref().map(|reference| reference.to_string());
            text.unwrap_or_default()
        }
        Value::Switch(on) => if *on { "yes" } else { "no" }.to_owned(),
    }
}

fn joined<T>(all: &[T], text: impl Fn(&T) -> String) -> String {
    all.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// Show an error or a warning on three lines; a tooltip shows a longer one.
pub fn three_lines_ui(ui: &mut Ui, text: &str, colour: Color32) {
    let font = TextStyle::Body.resolve(ui.style());
    let width = ui.available_width();
    let mut job = LayoutJob::simple(text.to_owned(), font, colour, width);
    job.wrap.max_rows = 3;
    ui.add(Label::new(job));
}
