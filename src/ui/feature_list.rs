//! The list of features in the inspector, and the chip that tells the verdict.

use std::time::Duration;

use eframe::egui::{
    Button, Response, RichText, Role, ScrollArea, Sense, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};
use lucide_icons::Icon;

use super::feature_marks::glyph;
use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::{figures, icons, widgets};
use crate::editor::{Editor, FeatureKind, FeatureReport, FeatureRow};
use crate::geometry::counted;
use crate::geometry::features::{Verdict, certain_text};

/// An interval wider than this is shown by both of its ends.
const WIDE: f64 = 1e-4;

/// The most digits of a curvature or torsion.
const DIGITS: usize = 4;

/// How often the progress of a proof is shown anew.
const PROGRESS: Duration = Duration::from_millis(100);

/// Show the verdict and the features of the active curve in all the room that there is, however many
/// they are; choosing one goes to it.
pub fn feature_list_ui(ui: &mut Ui, editor: &mut Editor) {
    let report = editor.features();
    ui.spacing_mut().item_spacing.y = 0.0;
    let (_, heading) = ui.allocate_space(vec2(ui.available_width(), ROW));
    ui.scope_builder(UiBuilder::new().max_rect(heading), |ui| match report {
        Some(report) => verdict_ui(ui, report),
        None => proving_ui(ui, editor),
    });
    let chosen = report.and_then(|report| rows_ui(ui, report, editor.chosen_feature()));
    if let Some(u) = chosen {
        editor.choose_feature(u);
        editor.go_to(u);
    }
}

/// Show the features; returns the parameter of the one that is chosen.
fn rows_ui(ui: &mut Ui, report: &FeatureReport, own: Option<f64>) -> Option<f64> {
    let area = ScrollArea::vertical()
        .id_salt("features")
        .auto_shrink([false, false]);
    let mut chosen = None;
    area.show_rows(ui, ROW, report.rows.len(), |ui, range| {
        for row in report.rows.get(range).unwrap_or_default() {
            if row_ui(ui, row, report.sampled, own == Some(row.middle)).clicked() {
                chosen = Some(row.middle);
            }
        }
    });
    chosen
}

fn verdict_ui(ui: &mut Ui, report: &FeatureReport) {
    let (icon, text) = verdict(report);
    let colour = colour_of(report, Tokens::of(ui));
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 1.5 * STEP;
        ui.label(icons::text(icon).color(colour));
        ui.label(RichText::new(text).color(colour));
    });
}

/// The verdict's icon and words.
fn verdict(report: &FeatureReport) -> (Icon, String) {
    let extrema = report.count(&[FeatureKind::CurvatureMaximum, FeatureKind::CurvatureMinimum]);
    if report.polyline {
        let text = match report.sampled {
            true => "Points have no curvature",
            false => "A polyline: corners have no curvature",
        };
        return (Icon::Minus, text.to_owned());
    }
    if report.sampled {
        let text = match extrema {
            0 => "No curvature extremum sampled".to_owned(),
            count => format!("{} sampled", count_extrema(count)),
        };
        return (Icon::ChartSpline, text);
    }
    match report.monotone {
        Verdict::Disproved if report.has_doubts => {
            let least = extrema.max(1);
            (Icon::Spline, format!("At least {}", count_extrema(least)))
        }
        Verdict::Proved if report.constant => {
            (Icon::Check, "Curvature constant: proved".to_owned())
        }
        Verdict::Proved => (Icon::Check, "Curvature monotone: proved".to_owned()),
        Verdict::Disproved => (Icon::Spline, count_extrema(extrema)),
        Verdict::Undecided => (
            Icon::CircleQuestionMark,
            "Curvature monotone: undecided".to_owned(),
        ),
    }
}

fn count_extrema(count: usize) -> String {
    counted(count, "curvature extremum", "curvature extrema")
}

fn colour_of(report: &FeatureReport, tokens: &Tokens) -> eframe::egui::Color32 {
    match report.monotone {
        Verdict::Proved => tokens.good,
        Verdict::Disproved => tokens.warning,
        Verdict::Undecided => tokens.undecided,
    }
}

/// Tell how far the proofs of a long curve have come.
fn proving_ui(ui: &mut Ui, editor: &Editor) {
    if let Some(progress) = editor.proof_progress() {
        widgets::caption(ui, &format!("Proving features: {:.0} %", 100.0 * progress));
        ui.ctx().request_repaint_after(PROGRESS);
    } else if editor.active().is_some() {
        widgets::caption(ui, "Features could not be proved: please report this curve");
    }
}

/// Show the verdict as a chip; pressing it shows the features.
pub fn chip_ui(ui: &mut Ui, editor: &mut Editor) -> Option<Response> {
    let Some(report) = editor.features() else {
        proving_ui(ui, editor);
        return None;
    };
    let (icon, text) = verdict(report);
    let colour = colour_of(report, Tokens::of(ui));
    let button = Button::new((
        icons::text(icon).color(colour),
        RichText::new(text).font(theme::small_font()).color(colour),
    ));
    let response = ui.add(button).accessible_name("Verdict");
    let inflections = report.count(&[FeatureKind::Inflection]);
    let undecided = report.count(&[FeatureKind::Undecided]);
    if report.sampled {
        let tooltip =
            "Features of references are sampled, not proved. The inspector lists them all.";
        return Some(response.on_hover_text(tooltip));
    }
    let tooltip = format!(
        "Proved for the numbers as they are: {}, {} undecided. The inspector lists them all.",
        counted(inflections, "inflection", "inflections"),
        counted(undecided, "piece", "pieces"),
    );
    Some(response.on_hover_text(tooltip))
}

/// What a feature is called where there is little room.
fn short_name(kind: FeatureKind) -> &'static str {
    match kind {
        FeatureKind::CurvatureMaximum => "κ maximum",
        FeatureKind::CurvatureMinimum => "κ minimum",
        FeatureKind::TorsionMaximum => "τ maximum",
        FeatureKind::TorsionMinimum => "τ minimum",
        FeatureKind::TorsionZero => "τ zero",
        FeatureKind::Inflection => "inflection",
        FeatureKind::Cusp => "cusp",
        FeatureKind::Undecided => "undecided",
    }
}

fn row_ui(ui: &mut Ui, row: &FeatureRow, sampled: bool, is_chosen: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    let tokens = Tokens::of(ui);
    if is_chosen {
        ui.painter().rect_filled(rect, RADIUS, tokens.selection);
    } else if response.hovered() {
        ui.painter().rect_filled(rect, RADIUS, tokens.button[0]);
    }
    if response.has_focus() {
        widgets::focus_ring(ui, rect);
    }
    let at = pos2(rect.left() + 3.0 * STEP, rect.center().y);
    glyph(ui.painter(), at, row.kind, tokens);
    let bend = row.bend().map_or(String::new(), |bend| format!(", {bend}"));
    let name = match (row.remark, row.count) {
        ("", 1) => short_name(row.kind).to_owned() + &bend,
        ("", count) => format!("{} ×{count}", short_name(row.kind)),
        (remark, _) => remark.to_owned(),
    };
    let [low, high] = row.u;
    let figure = |u: f64| figures::to_resolution(u, 1e-4);
    let u = if high - low > WIDE {
        format!("u {} … {}", figure(low), figure(high))
    } else {
        let name = if sampled { "t" } else { "u" };
        let at = if sampled { low } else { row.middle };
        format!("{name} {}", figure(at))
    };
    let mut left = rect.with_min_x(rect.left() + 6.0 * STEP);
    left.max.x -= if high - low > WIDE { 24.0 } else { 36.0 } * STEP;
    widgets::label_in(ui, left, &name, tokens.text);
    let inner = rect.with_max_x(rect.right() - STEP);
    let is_wide = row.value.is_none() && high - low > WIDE;
    let place = if is_wide {
        inner
    } else {
        inner.with_max_x(inner.right() - 20.0 * STEP)
    };
    widgets::number_in(ui, place, &u, tokens.text);
    let value = row.value.map_or(String::new(), |bounds| {
        if sampled {
            return figures::significant(bounds[0], DIGITS);
        }
        certain_text(bounds, DIGITS).unwrap_or_else(|| "?".to_owned())
    });
    widgets::number_in(ui, inner, &value, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{name} at {u}")));
    if sampled {
        let tooltip = format!(
            "{}{bend}, sampled\nt {low}. Click to go there.",
            row.kind.label()
        );
        return response.on_hover_text(tooltip);
    }
    let width = figures::significant(high - low, 2);
    response.on_hover_text(format!(
        "{}{bend}\nu from {low}\nto {high}\n{width} wide. Click to go there and to see the shortest moves found that lose it.",
        row.kind.label()
    ))
}
