//! A report as text, for reading: the summary, figures, and levels of two curves side by side.

use super::outcome::Figure;
use super::report::Report;
use super::value::Value;
use crate::geometry::approximation::{LevelComparison, LevelFeature};
use crate::geometry::significant;

/// The width of a column of features.
const COLUMN: usize = 28;

impl Report {
    /// Write the report in lines: the summary, the operation's own figures, and for each level that is
    /// compared a table of the features of both curves, the first that differs marked by `>`.
    pub fn text(&self) -> String {
        let mut lines = vec![self.summary()];
        let is_empty = |figure: &&Figure| matches!(&figure.value, Value::Indices(indices) if indices.is_empty());
        let figures = self.figures.iter();
        lines.extend(figures.filter(|it| !is_empty(it)).map(figure_line));
        for level in self.equivalence.iter().flatten() {
            lines.extend(level_lines(level));
        }
        lines.join("\n") + "\n"
    }
}

fn figure_line(figure: &Figure) -> String {
    let text = match &figure.value {
        Value::Whole(count) | Value::Choice(count) => count.to_string(),
        Value::Real(number) => significant(figure.quantity.shown(*number), 6),
        Value::Switch(on) => if *on { "yes" } else { "no" }.to_owned(),
        Value::List(numbers) => joined(numbers.iter().map(|it| significant(*it, 6))),
        Value::Indices(indices) => joined(indices.iter().map(usize::to_string)),
        Value::Table { columns, rows } => {
            let line = |row: &Vec<f64>| {
                let cells = columns.iter().zip(row);
                let cells = cells.map(|(name, it)| match it.fract() == 0.0 {
                    true => format!("{name} {it}"),
                    false => format!("{name} {}", significant(*it, 4)),
                });
                format!("\n  {}", joined(cells))
            };
            rows.iter().map(line).collect()
        }
        Value::Word(word) => (*word).to_owned(),
        Value::Ends([first, second]) => {
            format!(
                "{} of the first and {} of the second",
                first.name(),
                second.name()
            )
        }
        Value::Reference(reference) => {
            let text = reference.as_ref().map(|reference| reference.to_string());
            text.unwrap_or_default()
        }
    };
    format!("{}: {text}", figure.label)
}

fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(", ")
}

/// A level of both curves: what counts, and a row for each feature.
fn level_lines(level: &LevelComparison) -> Vec<String> {
    let difference = level.first_difference();
    let verdict = match difference {
        None => "equal".to_owned(),
        Some(index) => format!("differs from feature {} on", index + 1),
    };
    let counts = significant(level.least, 2);
    let mut lines = vec![format!(
        "{}: {verdict} (sampled; changes below {counts} do not count)",
        level.name()
    )];
    if level.there.is_empty() && level.here.is_empty() {
        return lines;
    }
    lines.push(format!("      {:COLUMN$}{}", "reference", "curve"));
    for (index, (there, here)) in level.side_by_side().enumerate() {
        let mark = if difference == Some(index) { '>' } else { ' ' };
        let (there, here) = (cell(there, 't'), cell(here, 'u'));
        lines.push(format!("{mark} {:>3} {there:COLUMN$}{here}", index + 1));
    }
    lines
}

fn cell(feature: Option<(f64, LevelFeature)>, parameter: char) -> String {
    match feature {
        Some((place, feature)) => {
            let place = significant(place, 5);
            format!("{} at {parameter} = {place}", feature.name())
        }
        None => "none".to_owned(),
    }
}
