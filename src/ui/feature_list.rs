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
use super::{document_unit, figures, icons, widgets};
use crate::editor::{
    CurvatureDisplay, Editor, FeatureKind, FeatureReport, FeatureRow, Look, MenuSubject,
};
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
        None => drop(proving_ui(ui, editor)),
    });
    let chosen = editor.view().chosen_feature();
    let display = editor.view().curvature_display;
    let Some((u, button)) = report.and_then(|report| rows_ui(ui, report, chosen, display)) else {
        return;
    };
    if chosen != Some(u) || button == PointerButton::Primary {
        editor.look(Look::Feature(u));
    }
    match button {
        PointerButton::Secondary => editor.hand_mut().ask_for_menu(MenuSubject::Feature),
        _ => editor.look(Look::Around(u)),
    }
}

/// Show the features; returns the parameter of the one that was clicked, and with which button.
fn rows_ui(
    ui: &mut Ui,
    report: &FeatureReport,
    own: Option<f64>,
    display: CurvatureDisplay,
) -> Option<(f64, PointerButton)> {
    let area = ScrollArea::vertical()
        .id_salt("features")
        .auto_shrink([false, false]);
    // Room for the bar is always kept, so that no row moves when it appears.
    let width = ui.available_width() - ui.spacing().scroll.allocated_width();
    let mut clicked = None;
    area.show_rows(ui, ROW, report.rows.len(), |ui, range| {
        ui.set_max_width(width);
        for row in report.rows.get(range).unwrap_or_default() {
            let states = (report.sampled, own == Some(row.middle));
            let response = row_ui(ui, row, states, display);
            let buttons = [PointerButton::Secondary, PointerButton::Primary];
            let button = buttons.into_iter().find(|it| response.clicked_by(*it));
            clicked = button.map(|button| (row.middle, button)).or(clicked);
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
            true => "No curvature",
            false => "A polyline: corners have no curvature",
        };
        return (Icon::Minus, text.to_owned());
    }
    let counts = counts(report);
    if report.sampled {
        return (Icon::ChartSpline, format!("{counts}, sampled"));
    }
    let is_doubtful = report.count(&[FeatureKind::Undecided]) > 0 || report.has_doubts;
    let doubt = |otherwise| match is_doubtful {
        true => Icon::CircleQuestionMark,
        false => otherwise,
    };
    match report.monotone {
        Verdict::Undecided => {
            let text = "Curvature monotone: undecided".to_owned();
            (Icon::CircleQuestionMark, text)
        }
        Verdict::Disproved if is_doubtful => (doubt(Icon::Spline), format!("At least {counts}")),
        Verdict::Disproved => (Icon::Spline, counts),
        Verdict::Proved => {
            let kind = match report.constant {
                true => "constant",
                false => "monotone",
            };
            let verdict = format!("Curvature {kind}: proved");
            (doubt(Icon::Check), listed(report, Some(verdict), None))
        }
    }
}

/// Count all features that the list has: "2 inflections · 4 extrema".
fn counts(report: &FeatureReport) -> String {
    let extrema = report.count(&[FeatureKind::CurvatureMaximum, FeatureKind::CurvatureMinimum]);
    // Where curvature is proved not to be monotone there is an extremum, even if none was counted; it may be
    // a cusp.
    let is_disproved = report.monotone == Verdict::Disproved;
    let has_cusps = report.count(&[FeatureKind::Cusp]) > 0;
    let extrema = extrema.max(usize::from(is_disproved && !has_cusps));
    let others = listed(report, None, None);
    if extrema == 0 && !others.is_empty() {
        return others;
    }
    let [one, several] = match report.count(&TORSION) {
        0 => ["extremum", "extrema"],
        _ => ["κ extremum", "κ extrema"],
    };
    listed(report, None, Some(counted(extrema, one, several)))
}

/// The features of the torsion.
const TORSION: [FeatureKind; 3] = [
    FeatureKind::TorsionMaximum,
    FeatureKind::TorsionMinimum,
    FeatureKind::TorsionZero,
];

/// List a verdict, the inflections, the curvature extrema as they are written, and the other features.
fn listed(report: &FeatureReport, verdict: Option<String>, extrema: Option<String>) -> String {
    let said = |kinds: &[FeatureKind], one: &str, several: &str| {
        let count = report.count(kinds);
        (count > 0).then(|| counted(count, one, several))
    };
    let parts = [
        verdict,
        said(&[FeatureKind::Inflection], "inflection", "inflections"),
        extrema,
        said(&TORSION[..2], "τ extremum", "τ extrema"),
        said(&TORSION[2..], "τ zero", "τ zeros"),
        said(&[FeatureKind::Cusp], "cusp", "cusps"),
        said(&[FeatureKind::CurvatureJump], "κ jump", "κ jumps"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    parts.join(" · ")
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
    editor.active()?;
    let text = match editor.sight().proof_progress() {
        Some(progress) => {
            ui.ctx().request_repaint_after(PROGRESS);
            format!("Proving features: {:.0} %", 100.0 * progress)
        }
        None => "Features could not be proved: please report this curve".to_owned(),
    };
    Some(widgets::caption(ui, &text))
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
        FeatureKind::CurvatureJump => "κ jump",
        FeatureKind::Undecided => "undecided",
    }
}

fn row_ui(
    ui: &mut Ui,
    row: &FeatureRow,
    (sampled, is_chosen): (bool, bool),
    display: CurvatureDisplay,
) -> Response {
    let (rect, response) = widgets::row(ui, Sense::click(), is_chosen);
    let tokens = Tokens::of(ui);
    let at = pos2(rect.left() + 3.0 * STEP, rect.center().y);
    glyph(ui.painter(), at, row.kind, tokens);
    let bend = row.bend().map_or(String::new(), |bend| format!(", {bend}"));
    let radius = row
        .value
        .filter(|_| row.bend().is_some() && display.shows_radius());
    let radius_with = |digits: usize| {
        let [low, high] = radius?;
        let radius = figures::radius_of(0.5 * (low + high), digits);
        Some(format!(", R {}", document_unit::length(ui.ctx(), radius)))
    };
    let radius = radius_with(4);
    let name = match (row.remark, row.count) {
        ("", 1) => short_name(row.kind).to_owned() + &bend + radius.as_deref().unwrap_or_default(),
        ("", count) => format!("{} ×{count}", short_name(row.kind)),
        (remark, _) => remark.to_owned(),
    };
    let [low, high] = row.u;
    let is_wide = high - low > WIDE;
    let figure = |u: f64| figures::to_resolution(u, 1e-4);
    let u = match (is_wide, sampled) {
        (true, _) => format!("u {} … {}", figure(low), figure(high)),
        (false, true) => format!("t {}", figure(low)),
        (false, false) => format!("u {}", figure(row.middle)),
    };
    let mut left = rect.with_min_x(rect.left() + 6.0 * STEP);
    left.max.x -= if is_wide { 24.0 } else { 38.0 } * STEP;
    let bend_with = |digits: usize| match (row.remark, row.count, row.bend(), radius_with(digits)) {
        ("", 1, Some("tightest"), Some(radius)) => Some(format!("Tightest{radius}")),
        ("", 1, Some(_), Some(radius)) => Some(format!("Flattest{radius}")),
        _ => None,
    };
    // As many digits as there is room for.
    let fits = |text: &String| !widgets::cut_short(ui, text, left.width(), tokens.text).elided;
    let bends = (3..=4).rev().filter_map(bend_with);
    let alone = || Some(radius_with(4)?.trim_start_matches(", ").to_owned());
    let short = bends.into_iter().find(fits);
    let short = short.or_else(|| bend_with(4).and_then(|_| alone()));
    let short = short.unwrap_or_else(|| name.replace("maximum", "max").replace("minimum", "min"));
    widgets::label_in(ui, left, &short, tokens.text);
    let inner = rect.with_max_x(rect.right() - STEP);
    let place = match row.value.is_none() && is_wide {
        true => inner,
        false => inner.with_max_x(inner.right() - 20.0 * STEP),
    };
    widgets::number_in(ui, place, &u, tokens.text);
    let value = row.value.map_or(String::new(), |bounds| match sampled {
        true => figures::significant(bounds[0], DIGITS),
        false => certain_text(bounds, DIGITS).unwrap_or_else(|| "?".to_owned()),
    });
    widgets::number_in(ui, inner, &value, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{name} at {u}")));
    let kind = row.kind.label();
    let width = figures::significant(high - low, 2);
    response.on_hover_text(match sampled {
        true => format!("{kind}{bend}, sampled\nt {low}. Click to go there."),
        false => format!(
            "{kind}{bend}\nu from {low}\nto {high}\n{width} wide. Click to see the shortest moves that remove it."
        ),
    })
}
