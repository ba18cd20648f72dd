//! The proved features and the harmony of curves, before an operation and afterwards.

use eframe::egui::{Role, Sense, Ui, WidgetInfo, vec2};

use super::steady_rows::SteadyRows;
use super::theme::{STEP, Tokens};
use super::{figures, widgets};
use crate::editor::OperationInProgress;
use crate::geometry::features::Verdict;
use crate::geometry::harmony::{Harmony, Match};
use crate::operations::FeatureCounts;

/// How faint figures are that are of other values.
pub const OUTDATED: f32 = 0.5;

/// The width of a column of figures.
const COLUMN: f32 = 96.0;

/// How many features of a kind there are.
type Count = fn(&FeatureCounts) -> usize;

/// The features before and after an operation: rows keep their places.
#[derive(Default)]
pub struct Comparison {
    rows: SteadyRows,
    /// Whether figures take a line of their own, as those of several curves do.
    is_wide: bool,
}

impl Comparison {
    /// Show the proved features, before and afterwards, of each kind that there is.
    pub fn show(&mut self, ui: &mut Ui, in_progress: &OperationInProgress) {
        let Some((features, current)) = in_progress.features() else {
            widgets::figure_row(ui, "Features", "proving…");
            return;
        };
        if !current && !in_progress.is_pending() {
            ui.multiply_opacity(OUTDATED);
        }
        let (before, after) = (&features.before, &features.after);
        self.is_wide |= before.len().max(after.len()) > 1;
        before_after_ui(ui, "", ["before", "after"], false);
        for (name, texts) in self.rows.in_place(rows(before, after)) {
            let texts = texts.unwrap_or_else(|| ["–".to_owned(), "–".to_owned()]);
            before_after_ui(ui, name, [&texts[0], &texts[1]], self.is_wide);
        }
    }
}

/// The rows: name, text before and text afterwards.
fn rows(before: &[FeatureCounts], after: &[FeatureCounts]) -> Vec<(&'static str, [String; 2])> {
    let kinds: [(&str, Count); 6] = [
        ("Curvature extrema", |counts| counts.curvature_extrema),
        ("Inflections", |counts| counts.inflections),
        ("Torsion extrema", |counts| counts.torsion_extrema),
        ("Torsion zeros", |counts| counts.torsion_zeros),
        ("Cusps", |counts| counts.cusps),
        ("Undecided", |counts| counts.undecided),
    ];
    let mut rows = Vec::new();
    for (number, (name, count)) in kinds.into_iter().enumerate() {
        let mut all = before.iter().chain(after);
        // Curvature extrema are the measure of a curve: their row stays even without any.
        if number == 0 || all.any(|counts| count(counts) > 0) {
            let listed = |counts: &[FeatureCounts]| joined(counts, |c| count(c).to_string());
            rows.push((name, [listed(before), listed(after)]));
        }
    }
    for (name, text) in HARMONY {
        let has = |counts: &FeatureCounts| text(&counts.harmony).is_some();
        if before.iter().chain(after).any(has) {
            let or_none = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
            let told = |counts: &[FeatureCounts]| joined(counts, |c| or_none(text(&c.harmony)));
            rows.push((name, [told(before), told(after)]));
        }
    }
    rows
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

/// The row on whether a polygon's extrema and sign changes are those of its curve.
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

/// Show whether the curvature is proved to be monotone, before and afterwards, in one row.
pub fn monotone_ui(ui: &mut Ui, in_progress: &OperationInProgress) {
    let Some((features, current)) = in_progress.features() else {
        widgets::figure_row(ui, "Monotone", "proving…");
        return;
    };
    let verdicts = |counts: &[FeatureCounts]| joined(counts, |c| verdict(c.monotone).to_owned());
    let [before, after] = [&features.before, &features.after].map(|counts| verdicts(counts));
    let text = match features.before.is_empty() || before == after {
        true => after.clone(),
        false => format!("{before} · now {after}"),
    };
    ui.scope(|ui| {
        if !current && !in_progress.is_pending() {
            ui.multiply_opacity(OUTDATED);
        }
        let row = widgets::figure_row(ui, "Monotone", &text);
        let told = format!("Monotone: {before} before, {after} after");
        row.widget_info(|| WidgetInfo::labeled(Role::Label, true, told.clone()));
    });
}

/// One row of figures in two columns: before and after.
fn before_after_ui(ui: &mut Ui, name: &str, [before, after]: [&str; 2], is_wide: bool) {
    let told = format!("{name}: {before} before, {after} after");
    let line = 5.0 * STEP;
    let lines = if is_wide { 2.0 } else { 1.0 };
    let size = vec2(ui.available_width(), lines * line);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let tokens = Tokens::of(ui);
    let top = rect.with_max_y(rect.top() + line);
    widgets::label_in(ui, top, name, tokens.faint_text);
    let rect = rect.with_min_y(rect.bottom() - line);
    let column = if is_wide { 0.5 * rect.width() } else { COLUMN };
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
