//! What the operation at hand came to: its report, its figures and the features before and afterwards.

use eframe::egui::{Label, RichText, Ui};

use super::feature_comparison::{OUTDATED, features_ui};
use super::level_comparison::level_comparisons_ui;
use super::theme::Tokens;
use super::{figures, widgets};
use crate::editor::Trial;
use crate::geometry::rounded_up;
use crate::operations::{Deviation, Figure, Report, Unit, Value};

/// Show what the operation came to, faintly while other values are being tried.
pub fn came_to_ui(ui: &mut Ui, trial: &Trial) {
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
                    false => "Not reached: nothing will change",
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
        level_comparisons_ui(ui, report.equivalence.as_deref().unwrap_or_default());
        if report.useful {
            features_ui(ui, trial);
        }
    });
    for remark in &report.remarks {
        widgets::note(ui, remark);
    }
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

/// Show an error, wrapped.
pub fn error_ui(ui: &mut Ui, text: &str) {
    let text = RichText::new(text).color(Tokens::of(ui).error);
    ui.add(Label::new(text).wrap());
}
