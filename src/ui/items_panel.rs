//! The inspector of several selected curves and references: what they have in common, and what is mixed.

use std::sync::Arc;

use eframe::egui::{Align2, Button, Key, TextEdit, Ui, vec2};

use super::curve_item::Item;
use super::item_fields::{change_all, colour_ui, common, set_degree, state_ui};
use super::keyboard::{self, Typing};
use super::move_fields::MoveFields;
use super::number_field::NumberField;
use super::theme::{ROW, STEP};
use super::widgets;
use crate::document::{Curve, Edit, Group};
use crate::editor::{Command, Editor, told};
use crate::geometry::MAX_DEGREE;
use crate::io::counted_items;

/// What stands in place of a value that is not common.
const MIXED: &str = "mixed";

/// The panel's own state.
#[derive(Default)]
pub struct ItemsPanel {
    /// The path of a group that is being typed.
    group: Option<String>,
    movement: MoveFields,
}

impl ItemsPanel {
    /// Show what the selected items have in common.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, items: &[Item]) {
        let curves = items
            .iter()
            .filter_map(|item| editor.document().curve(item.id));
        let curves: Vec<Arc<Curve>> = curves.cloned().collect();
        let references = items.len() - curves.len();
        ui.strong(format!(
            "{} selected",
            counted_items(curves.len(), references)
        ));
        widgets::form_row(ui, "Group", |ui| self.group_ui(ui, editor, items));
        widgets::form_row(ui, "Colour", |ui| colour_ui(ui, editor, items));
        if !curves.is_empty() {
            widgets::form_row(ui, "Degree", |ui| degree_ui(ui, editor, &curves));
            widgets::form_row(ui, "Ends", |ui| ends_ui(ui, editor, &curves));
            widgets::form_row(ui, "Symmetry", |ui| symmetry_ui(ui, editor, &curves));
        }
        widgets::form_row(ui, "State", |ui| state_ui(ui, editor, items));
        widgets::section(ui, "Properties", true, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            facts_ui(ui, &curves);
        });
        let in_space = curves.iter().any(|curve| !curve.polygon.is_planar());
        widgets::section(ui, "Move by numbers", true, |ui| {
            self.movement.show(ui, editor, in_space)
        });
    }

    /// The path of the common group; one that is typed is the group of all.
    fn group_ui(&mut self, ui: &mut Ui, editor: &mut Editor, items: &[Item]) {
        let shown = common(items.iter().map(|item| &item.group));
        let shown = shown.map_or(String::new(), Group::to_string);
        let mut text = self.group.take().unwrap_or_else(|| shown.clone());
        let are_mixed = common(items.iter().map(|item| &item.group)).is_none();
        let field = TextEdit::singleline(&mut text)
            .hint_text(if are_mixed { MIXED } else { "" })
            .desired_width(f32::INFINITY)
            .align(Align2::LEFT_CENTER)
            .min_size(vec2(0.0, ROW));
        let response = ui.add(field).accessible_name("Group of all");
        keyboard::claim(ui.ctx(), response.id, Typing::Text, response.rect);
        if response.lost_focus() {
            let called_off = ui.input(|input| input.key_pressed(Key::Escape));
            if text != shown && !called_off {
                let group = Group::from(text.as_str());
                change_all(editor, items, "Move", |curve| Edit::SetGroup {
                    curve,
                    group: group.clone(),
                });
            }
        } else if response.has_focus() {
            self.group = Some(text);
        }
    }
}

fn degree_ui(ui: &mut Ui, editor: &mut Editor, curves: &[Arc<Curve>]) {
    let degrees = curves.iter().map(|curve| curve.polygon.degree());
    let shown = common(degrees.clone()).map_or(MIXED.to_owned(), |degree| degree.to_string());
    let largest = degrees.max().unwrap_or(1);
    let field = NumberField::new("Degree of all", largest as f64, shown);
    let field = field.width(64.0).range(1.0..=MAX_DEGREE as f64);
    let help = "Keep the polygons; Elevate degree with a tolerance keeps the curves";
    if let Some(degree) = field.help(help).typed(ui) {
        set_degree(editor, degree);
    }
}

fn ends_ui(ui: &mut Ui, editor: &mut Editor, curves: &[Arc<Curve>]) {
    let periodic = common(curves.iter().map(|curve| curve.polygon.is_periodic()));
    ui.spacing_mut().item_spacing.x = STEP;
    for (name, wanted) in [("Open", false), ("Periodic", true)] {
        // The command makes curves periodic unless all are.
        let can_be = wanted || periodic.is_some();
        let button = Button::selectable(periodic == Some(wanted), name);
        let response = ui.add_enabled(can_be, button);
        if response.clicked() && periodic != Some(wanted) {
            told(editor.execute(Command::TogglePeriodic));
        }
    }
    if periodic.is_none() {
        widgets::caption(ui, MIXED);
    }
}

fn symmetry_ui(ui: &mut Ui, editor: &mut Editor, curves: &[Arc<Curve>]) {
    let stay = common(curves.iter().map(|curve| curve.symmetry.is_some()));
    ui.spacing_mut().item_spacing.x = STEP;
    let command = Command::ToggleSymmetric;
    let mut stays = stay == Some(true);
    let response = ui.checkbox(&mut stays, "Keep");
    if response.on_hover_text(command.tooltip()).clicked() {
        told(editor.execute(command));
    }
    if stay.is_none() {
        widgets::caption(ui, MIXED);
    }
}

fn facts_ui(ui: &mut Ui, curves: &[Arc<Curve>]) {
    let in_words = |value: Option<String>| value.unwrap_or_else(|| MIXED.to_owned());
    let kinds = curves.iter().map(|curve| {
        let polygon = &curve.polygon;
        let place = if polygon.is_planar() {
            "planar"
        } else {
            "in space"
        };
        let kind = if polygon.is_rational() {
            "rational"
        } else {
            "polynomial"
        };
        format!("{place}, {kind}")
    });
    widgets::fact_row(ui, "Kind", &in_words(common(kinds)));
    let segments = curves
        .iter()
        .map(|curve| curve.polygon.segments().to_string());
    widgets::figure_row(ui, "Segments", &in_words(common(segments)));
    let vertices = curves.iter().map(|curve| curve.polygon.vertices().len());
    let each = common(vertices.clone()).map(|count| count.to_string());
    widgets::figure_row(ui, "Vertices of each", &in_words(each));
    widgets::figure_row(ui, "Vertices of all", &vertices.sum::<usize>().to_string());
}
