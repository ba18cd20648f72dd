//! The list of keys and mouse actions, in groups.

use eframe::egui::{Label, RichText, ScrollArea, Ui, vec2};

use super::action::Action;
use super::keyboard;
use super::theme::{STEP, Tokens};

/// The gestures that the table of commands does not hold: headings behind `#`, and rows of keys and their effect.
const GESTURES: &str = include_str!("../../assets/keys.txt");

/// The width of a column, and of the keys in it.
const COLUMN: [f32; 2] = [340.0, 132.0];

/// A group: its heading, and its gestures with their effects.
type Group = (&'static str, Vec<(String, String)>);

/// Show the list in as many columns as the window has room for; it scrolls where it is too long.
pub fn key_list_ui(ui: &mut Ui) {
    let window = ui.ctx().content_rect().size();
    let columns = ((window.x - 120.0) / COLUMN[0]).floor().clamp(1.0, 3.0);
    ui.set_width(columns * COLUMN[0]);
    ui.strong("Keys and mouse");
    let height = (window.y - 180.0).clamp(120.0, 640.0);
    // Without a least height the list would grow by a little each frame.
    let area = ScrollArea::vertical()
        .auto_shrink([false, true])
        .max_height(height)
        .min_scrolled_height(height);
    area.show(ui, |ui| {
        let columns = in_columns(groups(), columns as usize);
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for column in columns {
                ui.vertical(|ui| column_ui(ui, &column));
            }
        });
    });
}

/// The groups of the list; the commands that have keys come last.
fn groups() -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for line in GESTURES.lines() {
        if let Some(heading) = line.strip_prefix("# ") {
            groups.push((heading, Vec::new()));
        } else if let Some((keys, what)) = line.split_once(" | ")
            && let Some((_, rows)) = groups.last_mut()
        {
            rows.push((keys.to_owned(), what.to_owned()));
        }
    }
    let commands = Action::all().into_iter().filter_map(|action| {
        let keys = keyboard::shortcut_text(action.shortcut()?);
        Some((keys, action.label()))
    });
    groups.push(("Commands", commands.collect()));
    groups
}

/// Fill so many columns evenly. Only a group longer than the rest of a column continues in the next.
fn in_columns(groups: Vec<Group>, count: usize) -> Vec<Vec<Group>> {
    let lines = |group: &Group| group.1.len() + 1;
    let long = groups.iter().map(lines).sum::<usize>().div_ceil(count);
    let mut columns = vec![Vec::new()];
    let mut left = long;
    for (heading, mut rows) in groups {
        if rows.len() >= left && rows.len() < long && columns.len() < count {
            columns.push(Vec::new());
            left = long;
        }
        loop {
            let is_last = columns.len() == count;
            let room = left.saturating_sub(1);
            let fitting = if is_last { rows.len() } else { room };
            let rest = rows.split_off(fitting.min(rows.len()));
            left = left.saturating_sub(rows.len() + 1);
            if let Some(column) = columns.last_mut()
                && !rows.is_empty()
            {
                column.push((heading, rows));
            }
            if rest.is_empty() {
                break;
            }
            columns.push(Vec::new());
            (rows, left) = (rest, long);
        }
    }
    columns
}

fn column_ui(ui: &mut Ui, groups: &[Group]) {
    let [width, left] = COLUMN;
    let right = width - left - 6.0 * STEP;
    ui.set_width(width);
    let tokens = Tokens::of(ui);
    for (index, (heading, rows)) in groups.iter().enumerate() {
        if index > 0 {
            ui.add_space(2.0 * STEP);
        }
        ui.label(RichText::new(*heading).color(tokens.accent));
        for (keys, what) in rows {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0 * STEP;
                let keys = RichText::new(keys).color(tokens.strong_text);
                for (text, width) in [(keys, left), (RichText::new(what), right)] {
                    ui.allocate_ui(vec2(width, 0.0), |ui| {
                        ui.set_width(width);
                        ui.add(Label::new(text).wrap());
                    });
                }
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_gestures_is_a_heading_or_a_row() {
        let all = groups();
        let gestures = &all[..all.len() - 1];
        let lines = gestures.iter().map(|(_, rows)| 1 + rows.len());
        let written = GESTURES.lines().filter(|line| !line.is_empty());
        assert_eq!(lines.sum::<usize>(), written.count());
        assert!(gestures.iter().all(|(_, rows)| !rows.is_empty()));
    }

    #[test]
    fn columns_hold_every_line_and_break_between_groups() {
        let rows = |groups: &[Group]| -> Vec<(String, String)> {
            groups.iter().flat_map(|(_, rows)| rows.clone()).collect()
        };
        for count in 1..=3 {
            let columns = in_columns(groups(), count);
            assert!(columns.len() <= count);
            assert_eq!(rows(&columns.concat()), rows(&groups()));
            for column in &columns {
                let ends = column.iter().map(|group| group.0);
                assert!(ends.collect::<Vec<&str>>().is_sorted_by(|a, b| a != b));
            }
            // The groups in the source are short: only the commands continue in another column.
            let headings = columns.concat().into_iter().map(|group| group.0);
            let commands = headings.clone().filter(|heading| *heading == "Commands");
            assert_eq!(headings.count() - commands.count(), groups().len() - 1);
        }
    }
}
