//! Fields for the formulas of a reference. Each text is previewed as soon as it is valid; a caret
//! marks the place of a mistake.

use eframe::egui::{Key, TextEdit, Ui, vec2};

use super::draft::{caret_ui, remark_ui};
use super::theme::{self, ROW, Tokens};
use super::widgets;
use crate::document::CurveId;
use crate::editor::{Editor, ReferenceChange};
use crate::geometry::references::{Formula, ReferenceError};

/// The coordinates, as their fields are called and as mistakes name them.
const COORDINATES: [(&str, &str); 3] = [("x(t)", "x"), ("y(t)", "y"), ("z(t)", "z")];

/// The texts in the fields of a reference.
#[derive(Default)]
pub struct FormulaFields {
    /// The reference that they belong to, while one of them has the keyboard.
    reference: Option<CurveId>,
    texts: [String; 3],
    /// Why the texts are no curve.
    error: Option<ReferenceError>,
}

impl FormulaFields {
    /// Show the fields of the active reference.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, id: CurveId, formula: &Formula) {
        if self.reference != Some(id) {
            let text = |text: Option<&str>| text.unwrap_or_default().to_owned();
            self.texts = formula.texts().map(text);
            self.error = None;
        }
        let mut is_typed = false;
        for coordinate in 0..COORDINATES.len() {
            is_typed |= self.field_ui(ui, editor, coordinate);
        }
        self.reference = is_typed.then_some(id);
    }

    /// Show the field of one coordinate; returns whether it has the keyboard.
    fn field_ui(&mut self, ui: &mut Ui, editor: &mut Editor, coordinate: usize) -> bool {
        let (label, name) = COORDINATES[coordinate];
        let tokens = Tokens::of(ui);
        let mistake = self.mistake(name);
        let row = widgets::form_row(ui, label, |ui| {
            let hint = if name == "z" { "none: planar" } else { "" };
            let field = TextEdit::singleline(&mut self.texts[coordinate])
                .id_salt(label)
                .font(theme::number_font())
                .hint_text(hint)
                .text_color(match mistake {
                    Some(_) => tokens.error,
                    None => tokens.strong_text,
                })
                .desired_width(f32::INFINITY)
                .min_size(vec2(0.0, ROW));
            field.show(ui)
        });
        let output = row.inner;
        let response = output.response.response.clone().accessible_name(label);
        if response.changed() {
            self.error = ReferenceChange::Formula(self.texts.clone())
                .preview(editor)
                .err();
        }
        if response.lost_focus() {
            let called_off = ui.input(|input| input.key_pressed(Key::Escape));
            if called_off {
                editor.abort_preview();
            } else {
                editor.commit_preview();
            }
            return false;
        }
        if let Some((column, text)) = self.mistake(name)
            && response.has_focus()
        {
            caret_ui(ui, &output, column);
            let below = response.rect.expand2(vec2(0.0, 6.0));
            remark_ui(ui, response.id.with("mistake"), below, &text);
        }
        response.has_focus()
    }

    /// The mistake in one coordinate: its column and its reason. A mistake of the whole
    /// curve has no column.
    fn mistake(&self, name: &str) -> Option<(usize, String)> {
        match self.error.as_ref()? {
            ReferenceError::InFormula {
                coordinate,
                mistake,
            } => (*coordinate == name).then(|| (mistake.column, mistake.error.to_string())),
            error => Some((1, error.to_string())),
        }
    }
}
