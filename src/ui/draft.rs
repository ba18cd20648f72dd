//! A number while it is being typed, and the remark beside a field whose text was not taken.

use std::ops::RangeInclusive;

use eframe::egui::{
    Align2, EventFilter, Id, Rect, Response, TextEdit, Tooltip, Ui, text::CCursorRange,
    text_edit::TextEditState,
};

use super::figures;
use super::theme::{self, Tokens};
use crate::document::quoted;

/// How long a remark stays, in seconds.
const SECONDS: f64 = 6.0;

/// A number while it is being typed.
#[derive(Clone, Debug, Default)]
pub struct Draft {
    text: String,
    before: String,
    /// Why Enter did not take it; what is typed next takes this away.
    refusal: Option<String>,
}

impl Draft {
    /// Begin with a number's exact digits.
    pub fn of(value: f64) -> Self {
        let text = figures::exact(value);
        Self {
            before: text.clone(),
            text,
            refusal: None,
        }
    }

    /// Begin with another text in a number's place.
    pub fn instead_of(value: f64, text: &str) -> Self {
        Self {
            text: text.to_owned(),
            ..Self::of(value)
        }
    }

    /// Read the number; `None` if the text is as it was.
    ///
    /// # Errors
    /// Why it cannot be taken, in words.
    pub fn value(&self, range: &RangeInclusive<f64>) -> Result<Option<f64>, String> {
        if self.text == self.before {
            return Ok(None);
        }
        let Some(value) = figures::read(&self.text) else {
            return Err(match self.text.trim() {
                "" => "Type a number, such as 12.5".to_owned(),
                text => format!("{} is not a number", quoted(text)),
            });
        };
        if range.contains(&value) {
            return Ok(Some(value));
        }
        let (low, high) = (figures::exact(*range.start()), figures::exact(*range.end()));
        Err(match (range.start().is_finite(), *range.end() < f64::MAX) {
            (true, true) => format!("Only numbers from {low} to {high}"),
            (true, false) => format!("Only numbers from {low} on"),
            _ => format!("Only numbers up to {high}"),
        })
    }

    /// Keep the text, to be changed, and say why it is not taken.
    pub fn refuse(&mut self, reason: String) {
        self.refusal = Some(reason);
    }

    /// Show it as a text field that has the keyboard; all of it is selected when it `is_new`.
    /// `keys` are the keys that do not leave the field.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        field: (Id, Rect, &str),
        range: &RangeInclusive<f64>,
        is_new: bool,
        keys: EventFilter,
    ) -> Response {
        let (id, rect, name) = field;
        if is_new {
            // Before the field is shown: keys that come in the same frame replace the number.
            let mut state = TextEditState::default();
            let all = CCursorRange::select_all_str(&self.text);
            state.cursor.set_char_range(Some(all));
            state.store(ui.ctx(), id);
        }
        let error = self.error(range);
        let tokens = Tokens::of(ui);
        let edit = TextEdit::singleline(&mut self.text)
            .id(id)
            .font(theme::number_font())
            .align(Align2::RIGHT_CENTER)
            .text_color(if error.is_none() {
                tokens.strong_text
            } else {
                tokens.error
            })
            .event_filter(keys)
            .return_key(None)
            .min_size(rect.size())
            .desired_width(rect.width());
        let response = ui.put(rect, edit);
        ui.ctx()
            .accesskit_node_builder(id, |node| node.set_label(name));
        if response.changed() {
            self.refusal = None;
        }
        if let Some(error) = error {
            remark_ui(ui, id, rect, &error);
        }
        response
    }

    /// What is wrong with the text so far. What may still become a number is not wrong yet.
    fn error(&self, range: &RangeInclusive<f64>) -> Option<String> {
        if self.refusal.is_some() {
            return self.refusal.clone();
        }
        let is_begun = figures::read(&self.text).is_none()
            && figures::read(&format!("{}0", self.text)).is_some();
        self.value(range).err().filter(|_| !is_begun)
    }
}

/// A remark beside a field, for a while.
#[derive(Clone, Debug, Default)]
pub struct Remark {
    text: String,
    until: f64,
}

impl Remark {
    /// Say something from now on.
    pub fn new(ui: &Ui, text: String) -> Self {
        let until = ui.input(|input| input.time) + SECONDS;
        Self { text, until }
    }

    /// Say that what was typed was not taken when its field was left; `shown` stays.
    pub fn left(ui: &Ui, reason: &str, shown: &str) -> Self {
        Self::new(ui, format!("{reason}: {shown} stays"))
    }

    /// Show it beside its field; tells whether it is to be kept.
    pub fn show(&self, ui: &Ui, id: Id, rect: Rect) -> bool {
        let left = self.until - ui.input(|input| input.time);
        if left > 0.0 {
            remark_ui(ui, id, rect, &self.text);
            let time = std::time::Duration::from_secs_f64(left);
            ui.ctx().request_repaint_after(time);
        }
        left > 0.0
    }
}

/// Say something beside a field.
pub fn remark_ui(ui: &Ui, id: Id, rect: Rect, text: &str) {
    let tooltip = Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), id, rect);
    tooltip.show(|ui| {
        ui.label(text);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draft_says_why_it_is_no_number() {
        let any = f64::NEG_INFINITY..=f64::INFINITY;
        let read =
            |text: &str, range: &RangeInclusive<f64>| Draft::instead_of(1.25, text).value(range);
        assert_eq!(Draft::of(1.25).value(&any), Ok(None));
        assert_eq!(read("-3,5", &any), Ok(Some(-3.5)));
        assert_eq!(read("one", &any), Err("“one” is not a number".to_owned()));
        let expected = "Only numbers from 0 to 17".to_owned();
        assert_eq!(read("18", &(0.0..=17.0)), Err(expected));
        let expected = "Only numbers from 0 on".to_owned();
        assert_eq!(read("-1", &(0.0..=f64::MAX)), Err(expected));
    }

    #[test]
    fn what_may_become_a_number_is_no_error_yet() {
        let any = f64::NEG_INFINITY..=f64::INFINITY;
        for text in ["", "-", "+.", "1e", "2e-"] {
            assert_eq!(Draft::instead_of(1.25, text).error(&any), None, "{text}");
        }
        assert!(Draft::instead_of(1.25, "1x").error(&any).is_some());
    }
}
