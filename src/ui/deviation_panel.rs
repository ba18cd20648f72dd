//! The deviation of the active curve or reference from another one, in the inspector.

use eframe::egui::Ui;

use super::number_field::NumberField;
use super::whisker_fields::whisker_fields_ui;
use super::{document_unit, figures, plots, widgets};
use crate::analysis::Deviation;
use crate::document::CurveId;
use crate::editor::{Editor, Whiskers};
use crate::geometry::distance::Whisker;
use crate::geometry::parameters::Quantity;

/// The width of the field for the limit.
const FIELD: f32 = 96.0;

/// Show the choice of the other curve and the deviation from it.
pub fn deviation_ui(ui: &mut Ui, editor: &mut Editor) {
    if editor.document().all_ids().count() < 2 {
        return;
    }
    widgets::form_row(ui, "Compare with", |ui| {
        plots::compare_choice_ui(ui, editor, "Compare distances with");
    });
    let Some(compared) = editor.sight().compared() else {
        return;
    };
    let mut whiskers = editor.view().whiskers;
    match editor.sight().deviation() {
        Some(deviation) => {
            figures_ui(ui, editor, compared, deviation);
            past_ends_ui(ui, editor, &mut whiskers);
            let scale = editor.sight().deviation_scale();
            widgets::form_row(ui, "Whiskers", |ui| {
                whisker_fields_ui(ui, scale, &mut whiskers);
            });
            limit_ui(ui, deviation, &mut whiskers);
            let copy = ui.button("Copy table");
            if copy
                .on_hover_text("Copy every whisker as a table with tabs")
                .clicked()
            {
                ui.copy_text(deviation.table());
            }
        }
        None => drop(widgets::note(
            ui,
            "Deviations are measured where one of the two is a curve.",
        )),
    }
    editor.view_mut().whiskers = whiskers;
}

/// The limit, and how many whiskers are beyond it.
fn limit_ui(ui: &mut Ui, deviation: &Deviation, whiskers: &mut Whiskers) {
    widgets::form_row(ui, "Limit", |ui| {
        let shown = whiskers.limit.map(|it| figures::significant(it, 4));
        let field = NumberField::new(
            "Deviation limit",
            whiskers.limit.unwrap_or(0.0),
            shown.unwrap_or("none".to_owned()),
        );
        let field = field.range(0.0..=f64::MAX).quantity(Quantity::Length);
        let field = field.help("Mark and count whiskers beyond it; 0: no limit");
        if let Some(limit) = field.width(FIELD).typed(ui) {
            whiskers.limit = Some(limit).filter(|limit| *limit > 0.0);
        }
        if let Some(limit) = whiskers.limit {
            let is_beyond = |it: &&Whisker| it.distance() > limit;
            let beyond = deviation.whiskers().filter(is_beyond).count();
            let of = deviation.whiskers().count();
            widgets::caption(ui, &format!("{beyond} of {of} beyond"))
                .on_hover_text("How many whiskers are longer than the limit");
        }
    });
}

fn figures_ui(ui: &mut Ui, editor: &Editor, compared: CurveId, deviation: &Deviation) {
    let Some((side, found)) = deviation.largest() else {
        return;
    };
    let length = |value: f64| document_unit::length(ui.ctx(), figures::significant(value, 4));
    let [largest, mean, rms] = [found.distance(), deviation.mean(), deviation.rms()].map(length);
    let [own, other] = deviation.sides.each_ref().map(|it| {
        let largest = it.as_ref().map(|it| length(it.largest.distance()));
        largest.unwrap_or("–".to_owned())
    });
    widgets::figure_row(ui, "Largest distance", &largest);
    widgets::figure_row(ui, "Mean, RMS", &format!("{mean}, {rms}"));
    by_side_ui(ui, deviation);
    widgets::figure_row(ui, "From this one", &own)
        .on_hover_text("The largest distance of its points from the other one");
    widgets::figure_row(ui, "From the other", &other)
        .on_hover_text("The largest distance of the other one's points from this one");
    let ids = [editor.active(), Some(compared)];
    let at = |item: usize, value: f64| place(editor, ids[item], value);
    let (own, other) = (at(side, found.at), at(1 - side, found.nearest_at));
    let of_curve = found.side.map(|it| format!(", {}", it.name()));
    let place = format!("{own}, {other}{}", of_curve.unwrap_or_default());
    widgets::figure_row(ui, "Largest at", &place);
}

/// How many whiskers lie past an end, and whether they are left out.
fn past_ends_ui(ui: &mut Ui, editor: &Editor, whiskers: &mut Whiskers) {
    let Some(whole) = editor.sight().whole_deviation() else {
        return;
    };
    let Some((past, others)) = whole.past_ends() else {
        return;
    };
    let others = document_unit::length(ui.ctx(), figures::significant(others, 4));
    let found = format!("{past}, others ≤ {others}");
    widgets::figure_row(ui, "Past an end", &found)
        .on_hover_text("Whiskers past an end of the other curve, and the longest of the others");
    if editor.sight().has_points_within_ends() {
        ui.checkbox(&mut whiskers.within_ends, "Leave them out")
            .on_hover_text("Count only points beside the curve, not those past its ends");
    }
}

/// The mean distance on each side, and its share.
fn by_side_ui(ui: &mut Ui, deviation: &Deviation) {
    for (side, mean, share) in deviation.by_side() {
        let mean = document_unit::length(ui.ctx(), figures::significant(mean, 4));
        let label = format!("Mean {}", side.name());
        let figures = format!("{mean}, {:.0} %", 100.0 * share);
        widgets::figure_row(ui, &label, &figures).on_hover_text(
            "Mean distance on this side of the curve, and the share of places there",
        );
    }
}

/// A place of a curve or a reference in words.
fn place(editor: &Editor, id: Option<CurveId>, at: f64) -> String {
    let reference = id.and_then(|id| editor.document().reference(id));
    let short = |value: f64| figures::significant(value, 4);
    match reference {
        Some(reference) if reference.points().is_some() => format!("point {at}"),
        Some(reference) => format!("t = {}", short(reference.curve.parameter(at))),
        None => format!("u = {}", short(at)),
    }
}
