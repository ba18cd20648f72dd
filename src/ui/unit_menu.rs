//! The document's unit of length and the step of the arrow keys, in a menu.

use eframe::egui::{Context, Id, Popup, PopupCloseBehavior, Role, Sense, Ui, Vec2, WidgetInfo};

use super::action::Action;
use super::figures;
use super::menu::{entries_ui, units};
use super::number_field::NumberField;
use super::shell::Shell;
use super::theme::{self, STEP};
use super::widgets;
use crate::editor::{Editor, Hand};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::parameters::Quantity;

/// The size of the cell in the status bar.
pub const CELL: Vec2 = Vec2::new(72.0, 5.0 * STEP);

/// The width of the popup.
const POPUP: f32 = 260.0;

/// Open the menu of the status bar, with the nudge step.
pub fn open(context: &Context) {
    Popup::open_id(context, popup_id());
}

fn popup_id() -> Id {
    Id::unique("unit menu")
}

/// Show the document's unit in the status bar: a press opens its menu, with the nudge step.
pub fn unit_cell_ui(ui: &mut Ui, editor: &mut Editor, shell: &Shell, actions: &mut Vec<Action>) {
    let unit = editor.document().unit().map_or("none", LengthUnit::symbol);
    let texts = ["unit", unit];
    let response = widgets::cell(ui, CELL, Sense::click(), texts, theme::small_font());
    let name = format!("Unit {unit}");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let popup = Popup::menu(&response)
        .id(popup_id())
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    popup.show(|ui| {
        ui.set_width(POPUP);
        entries_ui(ui, editor, shell, units(), actions);
        ui.separator();
        nudge_ui(ui, editor);
    });
    response.on_hover_text("Document unit and nudge step");
}

fn nudge_ui(ui: &mut Ui, editor: &mut Editor) {
    let row = widgets::form_row(ui, "Nudge step", |ui| {
        let step = editor.hand().nudge_step();
        let field = NumberField::new("Nudge step", step, figures::short(step))
            .range(Hand::NUDGE_STEPS)
            .quantity(Quantity::Length)
            .speed(0.02 * step);
        if let Some(step) = field.changed(ui) {
            editor.hand_mut().set_nudge_step(step);
        }
    });
    let tooltip = "How far an arrow key moves the selection, at any zoom; Shift ×10, Ctrl ×0.1";
    row.response.on_hover_text(tooltip);
}
