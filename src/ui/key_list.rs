//! The list of keys and mouse actions, in groups.

use eframe::egui::{Label, RichText, ScrollArea, Ui, vec2};

use super::action::Action;
use super::keyboard;
use super::theme::{STEP, Tokens};

/// A gesture and its effect.
type Row = (&'static str, &'static str);

/// The gestures that the table of commands does not hold.
const GROUPS: [(&str, &[Row]); 8] = [
    (
        "View",
        &[
            ("Wheel, pinch", "Zoom to the pointer"),
            ("Middle button, Space and drag", "Pan"),
            ("Right button and drag", "Orbit"),
            ("Double-click on empty canvas", "Fit all"),
            ("Right click, menu key", "Menu of what is there"),
            ("Alt", "Hold to compare with the state before"),
            ("F6", "Focus panels"),
        ],
    ),
    (
        "Select and shape",
        &[
            ("Click, Shift and click", "Select, add to the selection"),
            ("Drag on empty canvas", "Select by a box"),
            ("Tab", "Cycle overlapping"),
            ("Drag a vertex", "Move the selection"),
            (
                "Drag a hollow square",
                "Move a vertex of the closed S-polygon",
            ),
            ("Drag the tip of a comb tooth", "Scale the comb"),
            (
                "Shift while dragging",
                "Lock to an axis, or to steps of 15°",
            ),
            ("X, Y, Z while dragging", "Lock to X, Y, Z"),
            ("Ctrl while dragging", "Toggle snapping"),
            ("K while dragging", "Toggle keeping features"),
            (
                "Wheel while dragging",
                "Live harmony, soft drag: how many vertices follow",
            ),
            ("Arrows; with Shift, Ctrl", "Nudge; nudge ×10, ×0.1"),
            ("Enter, Esc", "Operation: apply, cancel"),
            ("Esc", "Cancel the drag, leave the tool"),
        ],
    ),
    (
        "Draw",
        &[
            ("Click", "Set a vertex"),
            ("Click the first vertex", "End as a periodic curve"),
            ("Enter, right click", "End the curve"),
            ("Backspace", "Remove the last vertex"),
        ],
    ),
    (
        "Type on the canvas",
        &[
            ("x,y", "Draw, Add, Insert: a point; in space x,y,z"),
            ("@dx,dy", "A point relative to the last vertex"),
            ("@length<angle", "A point by length and angle from it"),
            ("Number", "Rotate: an angle in degrees. Scale: a factor"),
            ("Enter, Esc", "Confirm, cancel"),
        ],
    ),
    (
        "Numbers",
        &[
            ("Drag a number", "Change it; type for an exact value"),
            ("2*pi, 10*cos(30deg)", "Arithmetic and functions"),
            ("+=2, -=1, *=1.1, /=2", "Change the current number"),
            ("12mm, 2.5cm, 1/2in", "Convert to the document's unit"),
        ],
    ),
    (
        "Plots",
        &[
            ("Wheel, drag", "Zoom to the pointer, pan"),
            ("Shift and wheel", "Zoom along the curve alone"),
            ("Double-click", "Fit the plot"),
        ],
    ),
    (
        "List of curves",
        &[
            ("Double-click", "Rename"),
            ("Drag a row", "Move it to another place"),
        ],
    ),
    (
        "Table of vertices",
        &[
            ("Enter, Shift and Enter", "Confirm and go down, up"),
            ("Tab, Shift and Tab", "Confirm and go right, left"),
            ("Arrows, Page Up, Page Down", "Go to another cell"),
            ("Digit, sign, letter", "Replace the number"),
            ("Space, double-click", "Edit the number"),
            ("Esc", "Cancel the edit; leave"),
        ],
    ),
];

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
    let owned = |(keys, what): &Row| ((*keys).to_owned(), (*what).to_owned());
    let groups = GROUPS.into_iter();
    let groups = groups.map(|(heading, rows)| (heading, rows.iter().map(owned).collect()));
    let commands = Action::all().into_iter().filter_map(|action| {
        let keys = keyboard::shortcut_text(action.shortcut()?);
        Some((keys, action.label()))
    });
    groups.chain([("Commands", commands.collect())]).collect()
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
            let fitting = if is_last {
                rows.len()
            } else {
                left.saturating_sub(1)
            };
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
            assert_eq!(headings.count() - commands.count(), GROUPS.len());
        }
    }
}
