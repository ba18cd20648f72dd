//! The list of features in the inspector, and the chip with the verdict.

use std::time::Duration;

use eframe::egui::{
    Button, Color32, PointerButton, Response, RichText, Role, ScrollArea, Sense, Ui, UiBuilder,
    WidgetInfo, pos2, vec2,
};
use lucide_icons::Icon;

use super::feature_marks::glyph;
use super::legend::legend_ui;
use super::theme::{self, ROW, STEP, Tokens};
use super::{figures, icons, widgets};
use crate::editor::{Editor, FeatureKind, FeatureReport, FeatureRow, Look, MenuSubject};
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
    let report = editor.sight().features();
    ui.spacing_mut().item_spacing.y = 0.0;
    let (_, heading) = ui.allocate_space(vec2(ui.available_width(), ROW));
    ui.scope_builder(UiBuilder::new().max_rect(heading), |ui| match report {
        Some(report) => verdict_ui(ui, report),
        None => {
            proving_ui(ui, editor);
        }
    });
    let chosen = editor.view().chosen_feature();
    match report.and_then(|report| rows_ui(ui, report, chosen)) {
        Some((u, PointerButton::Secondary)) => {
            if chosen != Some(u) {
                editor.look(Look::Feature(u));
            }
            editor.hand_mut().ask_for_menu(MenuSubject::Feature);
        }
        Some((u, _)) => {
            editor.look(Look::Feature(u));
            editor.look(Look::Around(u));
        }
        None => {}
    }
}

/// Show the features; returns the parameter of the one that was clicked, and with which button.
fn rows_ui(ui: &mut Ui, report: &FeatureReport, own: Option<f64>) -> Option<(f64, PointerButton)> {
    let area = ScrollArea::vertical()
        .id_salt("features")
        .auto_shrink([false, false]);
    // Room for the bar is always kept, so that no row moves when it appears.
    let width = ui.available_width() - ui.spacing().scroll.allocated_width();
    let mut clicked = None;
    area.show_rows(ui, ROW, report.rows.len(), |ui, range| {
        ui.set_max_width(width);
        for row in report.rows.get(range).unwrap_or_default() {
            let response = row_ui(ui, row, report.sampled, own == Some(row.middle));
            if response.clicked() {
                clicked = Some((row.middle, PointerButton::Primary));
            }
            if response.secondary_clicked() {
                clicked = Some((row.middle, PointerButton::Secondary));
            }
        }
    });
    clicked
}

fn verdict_ui(ui: &mut Ui, report: &FeatureReport) {
    let (icon, text) = verdict(report);
    let tokens = Tokens::of(ui);
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 1.5 * STEP;
        ui.label(icons::text(icon).color(colour_of(icon, tokens)));
        ui.label(RichText::new(text).color(tokens.text));
    });
}

/// The verdict's icon and words. Only undecided features are a doubt.
fn verdict(report: &FeatureReport) -> (Icon, String) {
    if report.polyline {
        let text = match report.sampled {
            true => "Points have no curvature",
            false => "A polyline: corners have no curvature",
        };
        return (Icon::Minus, text.to_owned());
    }
    let counts = counts(report);
    if report.sampled {
        return (Icon::ChartSpline, format!("{counts}, sampled"));
    }
    let is_doubtful = report.count(&[FeatureKind::Undecided]) > 0 || report.has_doubts;
    match report.monotone {
        Verdict::Undecided => (
            Icon::CircleQuestionMark,
            "Curvature monotone: undecided".to_owned(),
        ),
        Verdict::Disproved if is_doubtful => {
            (Icon::CircleQuestionMark, format!("At least {counts}"))
        }
        Verdict::Disproved => (Icon::Spline, counts),
        Verdict::Proved => {
            let kind = match report.constant {
                true => "constant",
                false => "monotone",
            };
            let icon = match is_doubtful {
                true => Icon::CircleQuestionMark,
                false => Icon::Check,
            };
            let verdict = format!("Curvature {kind}: proved");
            let Others { inflections, rest } = others(report);
            let parts = [verdict].into_iter().chain(inflections).chain(rest);
            (icon, parts.collect::<Vec<String>>().join(" · "))
        }
    }
}

/// Count all features that the list has: "2 inflections · 4 extrema".
fn counts(report: &FeatureReport) -> String {
    let Others { inflections, rest } = others(report);
    let extrema = report.count(&[FeatureKind::CurvatureMaximum, FeatureKind::CurvatureMinimum]);
    // Where curvature is proved not to be monotone there is an extremum, even if none was counted; it may be
    // a cusp.
    let is_disproved = report.monotone == Verdict::Disproved;
    let has_cusps = report.count(&[FeatureKind::Cusp]) > 0;
    let least = usize::from(is_disproved && !has_cusps);
    let names = match report.count(&TORSION) {
        0 => ["extremum", "extrema"],
        _ => ["κ extremum", "κ extrema"],
    };
    let [one, several] = names;
    let extrema = match extrema.max(least) {
        0 if inflections.is_some() || !rest.is_empty() => None,
        count => Some(counted(count, one, several)),
    };
    let parts = inflections.into_iter().chain(extrema).chain(rest);
    parts.collect::<Vec<String>>().join(" · ")
}

/// The features of the torsion.
const TORSION: [FeatureKind; 3] = [
    FeatureKind::TorsionMaximum,
    FeatureKind::TorsionMinimum,
    FeatureKind::TorsionZero,
];

/// Counts of features other than curvature extrema: those named before the extrema, and those after.
struct Others {
    inflections: Option<String>,
    rest: Vec<String>,
}

/// Count inflections, and the features named after the extrema.
fn others(report: &FeatureReport) -> Others {
    let said = |kinds: &[FeatureKind], one: &str, several: &str| {
        let count = report.count(kinds);
        (count > 0).then(|| counted(count, one, several))
    };
    let [maximum, minimum, zero] = TORSION;
    let rest = [
        said(&[maximum, minimum], "τ extremum", "τ extrema"),
        said(&[zero], "τ zero", "τ zeros"),
        said(&[FeatureKind::Cusp], "cusp", "cusps"),
    ];
    Others {
        inflections: said(&[FeatureKind::Inflection], "inflection", "inflections"),
        rest: rest.into_iter().flatten().collect(),
    }
}

fn colour_of(icon: Icon, tokens: &Tokens) -> Color32 {
    match icon {
        Icon::Check => tokens.good,
        Icon::CircleQuestionMark => tokens.warning,
        _ => tokens.faint_text,
    }
}

/// Show the progress of the proofs of a long curve.
fn proving_ui(ui: &mut Ui, editor: &Editor) -> Option<Response> {
    if let Some(progress) = editor.sight().proof_progress() {
        ui.ctx().request_repaint_after(PROGRESS);
        let text = format!("Proving features: {:.0} %", 100.0 * progress);
        Some(widgets::caption(ui, &text))
    } else if editor.active().is_some() {
        let text = "Features could not be proved: please report this curve";
        Some(widgets::caption(ui, text))
    } else {
        None
    }
}

/// Show the verdict as a chip; pressing it shows the features.
pub fn chip_ui(ui: &mut Ui, editor: &mut Editor) -> Option<Response> {
    let Some(report) = editor.sight().features() else {
        let proving = proving_ui(ui, editor)?;
        return Some(proving.on_hover_ui(|ui| legend_ui(ui, "What the canvas shows:")));
    };
    let (icon, text) = verdict(report);
    let tokens = Tokens::of(ui);
    let button = Button::new((
        icons::text(icon).color(colour_of(icon, tokens)),
        RichText::new(text)
            .font(theme::small_font())
            .color(tokens.text),
    ));
    let response = ui.add(button).accessible_name("Verdict");
    let undecided = report.count(&[FeatureKind::Undecided]);
    let remark = match (report.sampled, undecided) {
        (true, _) => "Features of references are sampled, not proved.".to_owned(),
        (false, 0) => "Proved exactly for this polygon, not sampled.".to_owned(),
        (false, count) => format!(
            "Proved exactly for this polygon, not sampled, except {} in the list.",
            counted(count, "undecided place", "undecided places")
        ),
    };
    Some(response.on_hover_ui(|ui| legend_ui(ui, &remark)))
}

/// The short name of a feature.
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
    widgets::row_background(ui, rect, &response, is_chosen);
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
    left.max.x -= if high - low > WIDE { 24.0 } else { 38.0 } * STEP;
    let short = name.replace("maximum", "max").replace("minimum", "min");
    widgets::label_in(ui, left, &short, tokens.text);
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
        "{}{bend}\nu from {low}\nto {high}\n{width} wide. Click to go there and see the shortest moves that remove it.",
        row.kind.label()
    ))
}
