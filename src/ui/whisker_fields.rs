//! The switch and the scale of whiskers, which show distances.

use eframe::egui::{Role, Ui, WidgetInfo};
use lucide_icons::Icon;

use super::figures;
use super::number_field::NumberField;
use super::widgets::{self, IconButton};
use crate::editor::Whiskers;

/// The width of the field for the scale.
const FIELD: f32 = 76.0;

/// Show the switch and, with the scale that is drawn, the field for the scale.
pub fn whisker_fields_ui(ui: &mut Ui, scale: f64, whiskers: &mut Whiskers) {
    let switch = ui.checkbox(&mut whiskers.shown, "");
    switch.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, whiskers.shown, "Whiskers"));
    switch.on_hover_text("Show the distances, magnified");
    ui.add_enabled_ui(whiskers.shown, |ui| scale_ui(ui, scale, whiskers));
}

/// The field for the scale, and the way back to the one that suits the distances.
fn scale_ui(ui: &mut Ui, scale: f64, whiskers: &mut Whiskers) {
    widgets::caption(ui, "×");
    let shown = figures::significant(scale, 4);
    let field = NumberField::new("Whisker scale", scale, shown).width(FIELD);
    let field = field.range(Whiskers::SCALES).speed(0.02 * scale);
    let field = field.help("How many times the whiskers are longer than the distances");
    if let Some(scale) = field.changed(ui) {
        whiskers.scale = Some(scale);
    }
    let reset = IconButton::new(Icon::RotateCcw, "Reset whisker scale");
    let reset = reset.tooltip("Suit the scale to the distances");
    if reset.enabled(whiskers.scale.is_some()).show(ui).clicked() {
        whiskers.scale = None;
    }
}
