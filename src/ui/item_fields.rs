//! Fields of the inspector that one curve or reference has as several have.

use eframe::egui::{
    Checkbox, Color32, Rect, Response, RichText, Role, Sense, Ui, Vec2, WidgetInfo,
};

use super::curve_item::Item;
use super::theme::{self, ROW, STEP, Tokens};
use super::widgets;
use crate::document::{CurveId, Edit};
use crate::editor::{Editor, told};
use crate::io::counted_items;
use crate::operations::{Value, reinterpret_degree};

/// The value that all have in common, if it is one.
pub fn common<T: PartialEq>(mut values: impl Iterator<Item = T>) -> Option<T> {
    let first = values.next()?;
    values.all(|value| value == first).then_some(first)
}

/// Give the selected curves another degree; the polygons stay.
pub fn set_degree(editor: &mut Editor, degree: f64) {
    // The operation refuses a fraction.
    let degree = match degree.fract() == 0.0 {
        true => Value::Whole(degree as usize),
        false => Value::Real(degree),
    };
    let values = [("degree", degree)];
    told(editor.apply_operation(&reinterpret_degree::OPERATION, &values));
}

/// Switches of curves and references: visible, locked. A click on one that is mixed switches it on for all.
pub fn state_ui(ui: &mut Ui, editor: &mut Editor, items: &[Item]) {
    let visible = common(items.iter().map(|item| item.visible));
    if let Some(visible) = switch_ui(ui, "Visible", visible) {
        let verb = if visible { "Show" } else { "Hide" };
        change_all(editor, items, verb, |curve| Edit::SetVisible {
            curve,
            visible,
        });
    }
    let locked = common(items.iter().map(|item| item.locked));
    if let Some(locked) = switch_ui(ui, "Locked", locked) {
        let verb = if locked { "Lock" } else { "Unlock" };
        change_all(editor, items, verb, |curve| Edit::SetLocked {
            curve,
            locked,
        });
    }
}

/// A switch that is on, off or mixed; returns its state after a click.
fn switch_ui(ui: &mut Ui, name: &str, state: Option<bool>) -> Option<bool> {
    let mut is_on = state.unwrap_or(false);
    let switch = Checkbox::new(&mut is_on, name).indeterminate(state.is_none());
    ui.add(switch).clicked().then_some(is_on)
}

/// Make the same edit of every item, as one step.
pub fn change_all(editor: &mut Editor, items: &[Item], verb: &str, edit: impl Fn(CurveId) -> Edit) {
    if let [only] = items {
        return told(editor.change(edit(only.id)));
    }
    let references = items.iter().filter(|item| item.is_reference).count();
    let noun = counted_items(items.len() - references, references);
    let edits = items.iter().map(|item| edit(item.id)).collect();
    told(editor.apply(&format!("{verb} {noun}"), edits));
}

/// A swatch that opens a choice of colours; shows the common colour, or the theme's.
pub fn colour_ui(ui: &mut Ui, editor: &mut Editor, items: &[Item]) {
    let tokens = Tokens::of(ui);
    let name = match common(items.iter().map(|item| item.colour)) {
        Some(Some(_)) => "Custom",
        Some(None) => "Default",
        None => "Mixed",
    };
    let shown = common(items.iter().map(|item| item.shown_colour(tokens)));
    let swatch = RichText::new("      ").background_color(shown.unwrap_or(Color32::TRANSPARENT));
    let button = ui.menu_button((swatch, name), |ui| {
        let mut chosen = None;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            for (name, colour) in theme::CURVE_COLOURS {
                if choice_ui(ui, name, theme::of_document(colour)).clicked() {
                    chosen = Some(Some(colour));
                }
            }
        });
        if ui.button("Reset to default").clicked() {
            chosen = Some(None);
        }
        if let Some(colour) = chosen {
            change_all(editor, items, "Recolour", |curve| Edit::Recolour {
                curve,
                colour,
            });
            ui.close();
        }
    });
    button.response.accessible_name("Colour");
}

fn choice_ui(ui: &mut Ui, name: &str, colour: Color32) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(ROW), Sense::click());
    if response.hovered() || response.has_focus() {
        widgets::outline(ui, rect, 1.5, Tokens::of(ui).accent);
    }
    let swatch = Rect::from_center_size(rect.center(), Vec2::splat(4.0 * STEP));
    widgets::swatch(ui, swatch, colour);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    response.on_hover_text(name)
}
