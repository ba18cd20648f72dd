//! The document's own properties, in the inspector.

use eframe::egui::{ComboBox, Ui};

use super::widgets;
use crate::editor::{Command, Editor, told};

/// Show what belongs to the document as a whole: its unit.
pub fn document_ui(ui: &mut Ui, editor: &mut Editor) {
    let unit = Command::SetUnit(None);
    let row = widgets::form_row(ui, "Unit", |ui| unit_ui(ui, editor));
    row.response.on_hover_text(unit.tooltip());
}

fn unit_ui(ui: &mut Ui, editor: &mut Editor) {
    let now = editor.document().unit();
    let name = |command: Command| match command {
        Command::SetUnit(Some(unit)) => unit.name(),
        _ => "none",
    };
    let choice = ComboBox::from_id_salt("document unit").selected_text(name(Command::SetUnit(now)));
    let choice = choice.show_ui(ui, |ui| {
        for command in Command::units() {
            let is_on = command == Command::SetUnit(now);
            if ui.selectable_label(is_on, name(command)).clicked() {
                told(editor.execute(command));
            }
        }
    });
    choice.response.accessible_name("Document unit");
}
