//! The proved features and the harmony of curves, before an operation and afterwards.

use std::collections::BTreeMap;

use eframe::egui::{Role, Sense, Ui, WidgetInfo, vec2};

use super::steady_rows::SteadyRows;
use super::theme::{STEP, Tokens};
use super::{figures, widgets};
use crate::editor::OperationInProgress;
use crate::geometry::features::Verdict;
use crate::geometry::harmony::Match;
use crate::operations::FeatureCounts;

/// How faint figures are that are of other values.
pub const OUTDATED: f32 = 0.5;

/// The width of a column of figures.
const COLUMN: f32 = 96.0;

/// The most characters of a figure in a column, and in half of the panel.
const FITTING: usize = 9;
const HALF: usize = 15;

/// The features before and after an operation: rows keep their places.
#[derive(Default)]
pub struct Comparison {
    rows: SteadyRows,
    /// How many lines rows have taken: long figures, as those of several curves, have one together or each one.
    lines: BTreeMap<&'static str, usize>,
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
        before_after_ui(ui, "", ["before", "after"], 1);
        for (name, texts) in self.rows.in_place(rows(before, after)) {
            let texts = texts.unwrap_or_else(|| ["–".to_owned(), "–".to_owned()]);
            let longest = texts.iter().map(|text| text.chars().count()).max();
            let longest = longest.unwrap_or_default();
            let needed = 1 + usize::from(longest > FITTING) + usize::from(longest > HALF);
            let lines = self.lines.entry(name).or_default();
            *lines = needed.max(*lines);
            before_after_ui(ui, name, [&texts[0], &texts[1]], *lines);
        }
    }
}

/// The rows: name, text before and text afterwards. A row stands where any curve has its figure.
fn rows(before: &[FeatureCounts], after: &[FeatureCounts]) -> Vec<(&'static str, [String; 2])> {
    let mut rows = Vec::new();
    for (table, none) in [(&FEATURES[..], "0"), (&HARMONY[..], "–")] {
        for (name, text) in table {
            let of = |c: &FeatureCounts| text(c).unwrap_or_else(|| none.to_owned());
            if before.iter().chain(after).any(|c| text(c).is_some()) {
                rows.push((*name, [joined(before, of), joined(after, of)]));
            }
        }
    }
    rows
}

/// A figure in a few characters; `None` of a curve that has none.
type Text = fn(&FeatureCounts) -> Option<String>;

/// How many features of a kind there are. Curvature extrema are the measure of a curve: their row stays even
/// without any.
const FEATURES: [(&str, Text); 6] = [
    ("Curvature extrema", |c| {
        Some(c.curvature_extrema.to_string())
    }),
    ("Inflections", |c| several(c.inflections)),
    ("Torsion extrema", |c| several(c.torsion_extrema)),
    ("Torsion zeros", |c| several(c.torsion_zeros)),
    ("Cusps", |c| several(c.cusps)),
    ("Undecided", |c| several(c.undecided)),
];

fn several(count: usize) -> Option<String> {
    (count > 0).then(|| count.to_string())
}

/// The harmony, before and afterwards.
const HARMONY: [(&str, Text); 10] = [
    ("Discrete κ follows", |c| {
        Some(follows(c.harmony.curvature.verdict))
    }),
    ("Discrete τ follows", |c| {
        Some(follows(c.harmony.torsion?.verdict))
    }),
    ("Regular to order", |c| {
        let regularity = c.harmony.regularity;
        Some(format!("{} of {}", regularity.order, regularity.highest))
    }),
    ("Leg change Δ²", |c| {
        Some(figures::significant(c.harmony.figures.legs?.value, 3))
    }),
    ("Turning change Δ²", |c| {
        Some(figures::small_angle(c.harmony.figures.turns?.value))
    }),
    ("Torsion change Δ²", |c| {
        Some(figures::small_angle(c.harmony.figures.torsions?.value))
    }),
    ("Discrete κ extrema", |c| {
        Some(c.harmony.figures.curvature_extrema.to_string())
    }),
    ("Bending energy", |c| {
        Some(energy(c.harmony.fairness.bending_energy))
    }),
    ("Variation", |c| Some(energy(c.harmony.fairness.variation))),
    ("Slope α (longest)", |c| {
        Some(figures::significant(c.harmony.longest_slope()?.slope, 3))
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
    match &texts[..] {
        [] => "–".to_owned(),
        // Copies have the same figures.
        [first, _, _, ..] if texts.iter().all(|text| text == first) => format!("{first} each"),
        _ => texts.join(", "),
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
    let both = features.before.iter().chain(&features.after);
    let mut both = both.map(|counts| verdict(counts.monotone));
    let first = both.next();
    let text = match features.before.is_empty() || both.all(|it| Some(it) == first) {
        true => first.unwrap_or("–").to_owned(),
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

/// One row of figures, before and after: in columns beside the name, on a second line, or on a line each.
fn before_after_ui(ui: &mut Ui, name: &str, [before, after]: [&str; 2], lines: usize) {
    let told = format!("{name}: {before} before, {after} after");
    let line = 5.0 * STEP;
    let size = vec2(ui.available_width(), lines as f32 * line);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let tokens = Tokens::of(ui);
    let top = rect.with_max_y(rect.top() + line);
    widgets::label_in(ui, top, name, tokens.faint_text);
    let last = rect.with_min_y(rect.bottom() - line);
    let first = match lines {
        1 => last.with_max_x(last.right() - COLUMN),
        2 => last.with_max_x(last.center().x),
        _ => last.translate(vec2(0.0, -line)),
    };
    widgets::number_in(ui, first, before, tokens.text);
    widgets::number_in(ui, last, after, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, told.clone()));
}

fn verdict(monotone: Verdict) -> &'static str {
    match monotone {
        Verdict::Proved => "yes",
        Verdict::Disproved => "no",
        Verdict::Undecided => "undecided",
    }
}
