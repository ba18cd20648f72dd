//! The import panel: what files of other programs hold, and what of it is taken.

use std::path::Path;

use eframe::egui::{
    Align2, Context, Key, Rect, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2,
};
use lucide_icons::Icon;

use super::help::{self, Topic};
use super::keyboard::{self, Typing};
use super::number_field::NumberField;
use super::theme::{self, ROW, STEP, Tokens};
use super::{figures, widgets};
use crate::document::{Document, quoted};
use crate::editor::{FoundFile, ImportQuestion};
use crate::geometry::counted;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;
use crate::io::counted_items;
use crate::io::exchange::drawing::Space;
use crate::io::exchange::import::{FoundRow, ImportChoice};

/// The width of the panel.
const WIDTH: f32 = 660.0;

/// The height that the panel has beside its list, at most.
const REST: f32 = 330.0;

/// The least and the greatest height of the list.
const LIST: [f32; 2] = [4.0 * ROW, 16.0 * ROW];

/// The captions of the columns with their left edges, of the width of a row; figures end at the edge of the next one.
const COLUMNS: [(&str, f32); 6] = [
    ("Layer", 0.04),
    ("Kind", 0.29),
    ("Count", 0.41),
    ("Degree", 0.53),
    ("Form", 0.62),
    ("Size", 0.80),
];

/// The answer to the question what to take.
pub enum ImportAnswer {
    /// Take nothing.
    Cancel,
    /// Take this of each file.
    Take(Vec<ImportChoice>),
}

/// The choice that is being made.
#[derive(Default)]
pub struct ImportPanel {
    choices: Vec<ImportChoice>,
    /// Whether the question was asked in the last frame.
    is_open: bool,
}

impl ImportPanel {
    /// Ask what to take for a document. Returns the answer once there is one.
    pub fn show(
        &mut self,
        context: &Context,
        question: Option<&ImportQuestion>,
        document: &Document,
    ) -> Option<ImportAnswer> {
        let Some(question) = question else {
            self.is_open = false;
            return None;
        };
        let is_alone = question.replaces || document.is_empty();
        let receiving = document.unit().filter(|_| !question.replaces);
        let is_new = !std::mem::replace(&mut self.is_open, true);
        if is_new {
            let files = question.files.iter();
            let first = |file| first_choice(file, receiving, is_alone);
            self.choices = files.map(first).collect();
        }
        widgets::modal(context, "import", ImportAnswer::Cancel, |ui| {
            ui.set_width(WIDTH.min(context.content_rect().width() - 16.0 * STEP));
            let answer = self.panel_ui(ui, question, receiving, is_new);
            help::mark(ui, ui.min_rect(), Topic::Import);
            answer
        })
    }

    fn panel_ui(
        &mut self,
        ui: &mut Ui,
        question: &ImportQuestion,
        receiving: Option<LengthUnit>,
        is_new: bool,
    ) -> Option<ImportAnswer> {
        // A number that Enter ends is taken first; the Enter that asked for files is no answer.
        let is_typing = is_new || keyboard::typing(ui.ctx()) == Typing::Text;
        let files = &question.files;
        let (verb, place) = match question.replaces {
            true => ("Open", ""),
            false => ("Add", " to the document"),
        };
        ui.strong(match &files[..] {
            [file] => format!("{verb} {}{place}", name_of(&file.path)),
            files => format!("{verb} {}{place}", counted(files.len(), "file", "files")),
        });
        let screen = ui.ctx().content_rect().height();
        let most = (screen - REST).clamp(LIST[0], LIST[1]);
        captions_ui(ui);
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            let area = ScrollArea::vertical().id_salt("found").max_height(most);
            area.auto_shrink([false, true]).show(ui, |ui| {
                for (file, choice) in files.iter().zip(&mut self.choices) {
                    file_ui(ui, file, choice, files.len() > 1);
                }
            });
        });
        self.sum_ui(ui, files, receiving);
        self.unit_ui(ui, files, receiving);
        self.floats_ui(ui, files);
        let is_empty = files
            .iter()
            .zip(&self.choices)
            .all(|(file, choice)| file.found.taken(choice).next().is_none());
        let is_entered = !is_typing && ui.input(|input| input.key_pressed(Key::Enter));
        let mut answer = None;
        ui.horizontal(|ui| {
            widgets::at_right(ui, |ui| {
                let button = |ui: &mut Ui| widgets::primary_button(ui, verb);
                let take = ui.add_enabled_ui(!is_empty, button).inner;
                if (take.clicked() || is_entered) && !is_empty {
                    answer = Some(ImportAnswer::Take(self.choices.clone()));
                }
                if ui.button("Cancel").clicked() {
                    answer = Some(ImportAnswer::Cancel);
                }
            });
        });
        answer
    }

    /// What is taken in all, with buttons for all and for nothing.
    fn sum_ui(&mut self, ui: &mut Ui, files: &[FoundFile], receiving: Option<LengthUnit>) {
        let (mut curves, mut references, mut left_out) = (0, 0, 0);
        for (file, choice) in files.iter().zip(&self.choices) {
            for row in file.found.taken(choice) {
                curves += row.curves + if choice.to_float { row.smooth } else { 0 };
            }
            let [taken, lone] = file.found.references(choice);
            references += taken;
            left_out += lone;
        }
        let mut told = counted_items(curves, references);
        if left_out > 0 {
            let points = counted(left_out, "single point", "single points");
            told.push_str(&format!(" ({points} left out)"));
        }
        let size = match files {
            [file] => {
                let choice = self.choices.first();
                choice.and_then(|choice| file.found.size(choice, receiving))
            }
            _ => None,
        };
        let told = match size {
            Some(size) => format!("Taken: {told}; {size}"),
            None => format!("Taken: {told}"),
        };
        ui.horizontal(|ui| {
            ui.label(told);
            widgets::at_right(ui, |ui| {
                let none = ui.button("Take none").clicked();
                let all = ui.button("Take all").clicked();
                for (file, choice) in files.iter().zip(&mut self.choices) {
                    if none {
                        choice.taken.clear();
                    }
                    if all {
                        let keys = file.found.rows.iter().map(|row| row.key.clone());
                        choice.taken = keys.collect();
                    }
                }
            });
        });
    }

    /// The unit that files say, or one for all that say none.
    fn unit_ui(&mut self, ui: &mut Ui, files: &[FoundFile], receiving: Option<LengthUnit>) {
        let asks = |file: &FoundFile| file.found.unit.is_none() && !file.found.is_unitless;
        let Some(first) = files.iter().position(asks) else {
            return;
        };
        let (Some(file), Some(choice)) = (files.get(first), self.choices.get(first)) else {
            return;
        };
        let (mut unit, offers) = (choice.unit, file.found.unit_offers(choice, receiving));
        let text = match files {
            [_] => "The file states no unit of length. It is in".to_owned(),
            _ => format!(
                "Some files state no unit of length. They are in ({})",
                name_of(&file.path)
            ),
        };
        ui.label(text);
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for (offered, size) in offers {
                let name = offered.map_or("no unit", LengthUnit::name);
                ui.horizontal(|ui| {
                    ui.set_min_height(5.0 * STEP);
                    ui.add_space(2.0 * STEP);
                    if ui.radio(unit == offered, name).clicked() {
                        unit = offered;
                    }
                    let rect = ui.max_rect();
                    let at = rect.with_min_x(rect.left() + 36.0 * STEP);
                    let colour = Tokens::of(ui).faint_text;
                    let font = theme::number_font();
                    widgets::text_in(ui, at, Align2::LEFT_CENTER, size, font, colour);
                });
            }
        });
        for (file, choice) in files.iter().zip(&mut self.choices) {
            if asks(file) {
                choice.unit = unit;
            }
        }
    }

    /// Whether references become float polygons, and how near.
    fn floats_ui(&mut self, ui: &mut Ui, files: &[FoundFile]) {
        let pairs = || files.iter().zip(&self.choices);
        let smooth: usize = pairs()
            .flat_map(|(file, choice)| file.found.taken(choice))
            .map(|row| row.smooth)
            .sum();
        let Some(first) = self.choices.first() else {
            return;
        };
        let (mut to_float, mut tolerance) = (first.to_float && smooth > 0, first.tolerance);
        let unit = first.unit;
        let references = counted(smooth, "smooth reference", "smooth references");
        ui.horizontal(|ui| {
            ui.add_enabled_ui(smooth > 0, |ui| {
                let text = format!("Make float polygons of {references}, within");
                ui.checkbox(&mut to_float, text).on_hover_text(
                    "Curves near them take their place; features stay where possible",
                );
            });
            ui.add_enabled_ui(to_float, |ui| {
                let shown = tolerance.map_or("1e-4 of size".to_owned(), figures::short);
                let field = NumberField::new("tolerance", tolerance.unwrap_or(1e-4), shown);
                let field = field.quantity(Quantity::Length).width(96.0);
                let field = field.range(f64::MIN_POSITIVE..=f64::INFINITY);
                tolerance = field.typed(ui).or(tolerance);
                if let Some(unit) = unit {
                    widgets::caption(ui, unit.symbol());
                }
            });
        });
        for choice in &mut self.choices {
            (choice.to_float, choice.tolerance) = (to_float, tolerance);
        }
    }
}

/// What is taken at first, where the file says no unit in that of the document. Alone in a document it is in a
/// likely one; beside curves without a unit it has none either.
fn first_choice(file: &FoundFile, receiving: Option<LengthUnit>, is_alone: bool) -> ImportChoice {
    let choice = file.choice.clone();
    let is_asked = file.found.unit.is_none() && !file.found.is_unitless;
    let likely = || {
        let likely = is_alone.then(|| file.found.likely_unit(&choice));
        receiving.or(likely.flatten())
    };
    let unit = choice.unit.or_else(|| is_asked.then(likely).flatten());
    ImportChoice { unit, ..choice }
}

fn name_of(path: &Path) -> String {
    quoted(&path.file_name().unwrap_or_default().to_string_lossy())
}

/// The box of a column in a row.
fn column(row: Rect, index: usize) -> Rect {
    let edge = |index: usize| {
        let share = COLUMNS.get(index).map_or(1.0, |(_, share)| *share);
        row.left() + share * row.width()
    };
    let right = edge(index + 1) - 2.0 * STEP;
    Rect::from_min_max(pos2(edge(index), row.top()), pos2(right, row.bottom()))
}

fn captions_ui(ui: &mut Ui) {
    let size = vec2(ui.available_width(), 5.0 * STEP);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let colour = Tokens::of(ui).faint_text;
    for (index, (caption, _)) in COLUMNS.into_iter().enumerate() {
        let font = theme::small_font();
        let (at, align) = match caption {
            "Count" => (column(rect, index), Align2::RIGHT_CENTER),
            _ => (column(rect, index), Align2::LEFT_CENTER),
        };
        widgets::text_in(ui, at, align, caption, font, colour);
    }
}

fn file_ui(ui: &mut Ui, file: &FoundFile, choice: &mut ImportChoice, is_named: bool) {
    if is_named {
        ui.strong(name_of(&file.path));
    }
    for row in &file.found.rows {
        row_ui(ui, row, choice);
    }
    if file.found.rows.is_empty() {
        widgets::note(ui, "The file holds no curve.");
    }
    ui.add_space(STEP);
    let tokens = Tokens::of(ui);
    for text in file.found.not_understood() {
        let text = format!("Not understood, left out: {text}");
        widgets::remark_with_icon(ui, Icon::TriangleAlert, &text, tokens.warning);
    }
    for text in &file.found.remarks {
        widgets::remark_with_icon(ui, Icon::Info, text, tokens.faint_text);
    }
}

/// A kind on a layer, taken or not.
fn row_ui(ui: &mut Ui, row: &FoundRow, choice: &mut ImportChoice) {
    let is_taken = choice.taken.contains(&row.key);
    let (rect, response) = widgets::row(ui, Sense::click(), false);
    let layer = match row.key.space {
        Space::Model => row.key.layer_name(),
        Space::Paper => format!("{} (layout for printing)", row.key.layer_name()),
        Space::Edge => format!("{} (edges)", row.key.layer_name()),
    };
    let kind = row.key.kind.name();
    let name = format!("{layer}, {kind}: {}", row.count);
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, is_taken, &name));
    let tokens = Tokens::of(ui);
    let (mark, colour) = match is_taken {
        true => (Icon::SquareCheck, tokens.text),
        false => (Icon::Square, tokens.faint_text),
    };
    let square = Rect::from_min_size(rect.min, vec2(ROW, ROW));
    widgets::icon(ui, square, mark, colour);
    let degrees: Vec<String> = row.degrees.iter().map(ToString::to_string).collect();
    let forms = [
        (row.rational, "rational"),
        (row.periodic, "periodic"),
        (row.hidden, "hidden"),
        (row.inserted, "in blocks"),
    ];
    let forms = forms.iter().filter(|(count, _)| *count > 0);
    let forms: Vec<String> = forms
        .map(|(count, word)| format!("{count} {word}"))
        .collect();
    let size = row.bounds.map_or(String::new(), |bounds| {
        crate::io::exchange::import::size_told(bounds, 1.0, None)
    });
    let texts = [
        layer,
        kind.to_owned(),
        row.count.to_string(),
        degrees.join(", "),
        forms.join(", "),
        size,
    ];
    let mut is_cut = false;
    for (index, text) in texts.iter().enumerate() {
        let at = column(rect, index);
        match index {
            2 => widgets::number_in(ui, at, text, colour),
            _ => is_cut |= widgets::label_in(ui, at, text, colour),
        }
    }
    let becomes = counted_items(row.curves, row.count.saturating_sub(row.curves));
    let response = response.on_hover_ui(|ui| {
        if is_cut {
            ui.label(texts.join("  "));
        }
        ui.label(format!("Becomes {becomes}"));
    });
    if response.clicked() {
        match is_taken {
            true => drop(choice.taken.remove(&row.key)),
            false => drop(choice.taken.insert(row.key.clone())),
        }
    }
}
