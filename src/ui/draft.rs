//! A number while it is being typed, and the remark beside a field whose text was not taken.

use std::fmt;
use std::ops::RangeInclusive;

use eframe::egui::text::{CCursor, CCursorRange};
use eframe::egui::text_edit::{TextEditOutput, TextEditState};
use eframe::egui::{
    Align2, Context, EventFilter, Id, Rect, Response, Stroke, TextEdit, Tooltip, Ui, UiBuilder,
    vec2,
};

use super::figures;
use super::theme::{self, Tokens};
use crate::document::quoted;
use crate::geometry::expressions::{ExpressionMistake, LengthUnit, NumberContext};
use crate::geometry::parameters::Quantity;

/// How long a remark stays, in seconds.
const SECONDS: f64 = 6.0;

/// The height of the mark under a mistake.
const CARET: f32 = 5.0;

/// The numbers that a field takes.
#[derive(Clone, Debug)]
pub struct Accepted {
    /// The quantity they measure.
    pub quantity: Quantity,
    /// The document's unit of length.
    pub unit: Option<LengthUnit>,
    /// How large they may be.
    pub range: RangeInclusive<f64>,
}

/// Why a text is not taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The column of the mistake, counted from 1, if it has one.
    column: Option<usize>,
    reason: String,
}

/// A number while it is being typed.
#[derive(Clone, Debug, Default)]
pub struct Draft {
    text: String,
    /// The number that it takes the place of.
    pub before: f64,
    /// Why Enter did not take it, until the text changes.
    refusal: Option<Fault>,
}

impl Accepted {
    /// Read a number that takes the place of `before`.
    ///
    /// # Errors
    /// [`Fault`]: the reason, and the column.
    pub fn read(&self, text: &str, before: f64) -> Result<f64, Fault> {
        let value = self.context(before).read(text)?;
        let range = &self.range;
        if range.contains(&value) {
            return Ok(value);
        }
        let (low, high) = (figures::exact(*range.start()), figures::exact(*range.end()));
        let reason = match (range.start().is_finite(), *range.end() < f64::MAX) {
            (true, true) => format!("Only numbers from {low} to {high}"),
            (true, false) => format!("Only numbers from {low} up"),
            _ => format!("Only numbers up to {high}"),
        };
        Err(Fault::from(reason))
    }

    fn context(&self, before: f64) -> NumberContext {
        NumberContext {
            quantity: self.quantity,
            unit: self.unit,
            before: Some(before),
        }
    }
}

impl From<String> for Fault {
    fn from(reason: String) -> Self {
        let column = None;
        Self { column, reason }
    }
}

impl From<ExpressionMistake> for Fault {
    fn from(mistake: ExpressionMistake) -> Self {
        Self {
            column: Some(mistake.column),
            reason: mistake.error.to_string(),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.column {
            Some(column) => write!(formatter, "Column {column}: {}", self.reason),
            None => formatter.write_str(&self.reason),
        }
    }
}

impl Draft {
    /// Begin with a number's exact digits.
    pub fn of(value: f64) -> Self {
        Self::instead_of(value, &figures::exact(value))
    }

    /// Begin with another text in a number's place.
    pub fn instead_of(value: f64, text: &str) -> Self {
        Self {
            text: text.to_owned(),
            before: value,
            refusal: None,
        }
    }

    /// Read the number; `None` if the text is as it was.
    ///
    /// # Errors
    /// Why it cannot be taken.
    pub fn value(&self, accepted: &Accepted) -> Result<Option<f64>, Fault> {
        if self.text == figures::exact(self.before) {
            return Ok(None);
        }
        if self.text.trim().is_empty() {
            return Err(Fault::from("Type a number, such as 12.5".to_owned()));
        }
        accepted.read(&self.text, self.before).map(Some)
    }

    /// Keep the text for correction and show why it is not taken.
    pub fn refuse(&mut self, fault: Fault) {
        self.refusal = Some(fault);
    }

    /// The remark on a text that was left without being taken; the field shows `shown` again.
    pub fn left(&self, ui: &Ui, fault: &Fault, shown: &str) -> Remark {
        let Fault { column, reason } = fault;
        let text = quoted(self.text.trim());
        let text = match column {
            Some(column) => format!("{text}, column {column}: {reason}: {shown} stays"),
            None => format!("{reason}: {shown} stays"),
        };
        Remark::new(ui, text)
    }

    /// Show it as a text field that has the keyboard; all of it is selected when it `is_new`.
    /// `keys` are the keys that do not leave the field.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        field: (Id, Rect, &str),
        accepted: &Accepted,
        is_new: bool,
        keys: EventFilter,
    ) -> Response {
        let (id, rect, name) = field;
        if is_new {
            // Before the field is shown: keys that come in the same frame replace the number.
            select_all(ui.ctx(), id, &self.text);
        }
        let fault = self.fault(accepted);
        let tokens = Tokens::of(ui);
        let edit = TextEdit::singleline(&mut self.text)
            .id(id)
            .font(theme::number_font())
            .align(Align2::RIGHT_CENTER)
            .text_color(match fault {
                None => tokens.strong_text,
                Some(_) => tokens.error,
            })
            .event_filter(keys)
            .return_key(None)
            .min_size(rect.size())
            .desired_width(rect.width());
        let place = UiBuilder::new().max_rect(rect);
        let output = ui.scope_builder(place, |ui| edit.show(ui)).inner;
        let response = output.response.response.clone();
        let context = ui.ctx();
        context.accesskit_node_builder(id, |node| node.set_label(name));
        if response.changed() {
            self.refusal = None;
        }
        if let Some(fault) = fault {
            if let Some(column) = fault.column {
                caret_ui(ui, &output, column);
            }
            remark_ui(ui, id, rect.expand2(vec2(0.0, CARET)), &fault.to_string());
        }
        response
    }

    /// The fault of the text so far. A text that may still become a number has none.
    fn fault(&self, accepted: &Accepted) -> Option<Fault> {
        if self.refusal.is_some() {
            return self.refusal.clone();
        }
        let fault = self.value(accepted).err()?;
        let is_begun = || accepted.context(self.before).is_begun(&self.text);
        let is_whole = fault.column.is_none() && !self.text.trim().is_empty();
        (is_whole || !is_begun()).then_some(fault)
    }
}

/// A remark beside a field, for a while.
#[derive(Clone, Debug, Default)]
pub struct Remark {
    text: String,
    until: f64,
}

impl Remark {
    /// Show a text from now on.
    pub fn new(ui: &Ui, text: String) -> Self {
        let until = ui.input(|input| input.time) + SECONDS;
        Self { text, until }
    }

    /// Show it beside its field; returns whether to keep it.
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

/// Select all of a text field's text: typing replaces it.
pub fn select_all(context: &Context, id: Id, text: &str) {
    let mut state = TextEditState::load(context, id).unwrap_or_default();
    state
        .cursor
        .set_char_range(Some(CCursorRange::select_all_str(text)));
    state.store(context, id);
}

/// Mark a place in a text field from below: the left edge of the character in a column, counted from 1.
pub fn caret_ui(ui: &Ui, field: &TextEditOutput, column: usize) {
    let cursor = CCursor::new(column.saturating_sub(1));
    let place = field.galley.pos_from_cursor(cursor);
    // A right-aligned text begins left of its origin.
    let origin = field.galley_pos - vec2(field.galley.rect.left(), 0.0);
    let mut tip = place.translate(origin.to_vec2()).left_bottom();
    // A long text is scrolled.
    let rect = field.response.response.rect;
    tip.x = tip.x.clamp(rect.left(), rect.right());
    let caret = [tip + vec2(-3.0, CARET), tip, tip + vec2(3.0, CARET)];
    let stroke = Stroke::new(1.5, Tokens::of(ui).error);
    ui.painter().line(caret.to_vec(), stroke);
}

/// Show a remark beside a field.
pub fn remark_ui(ui: &Ui, id: Id, rect: Rect, text: &str) {
    let tooltip = Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), id, rect);
    tooltip.show(|ui| {
        ui.label(text);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn accepted(range: RangeInclusive<f64>) -> Accepted {
        Accepted {
            quantity: Quantity::Length,
            unit: Some(LengthUnit::Millimetre),
            range,
        }
    }

    #[test]
    fn a_draft_says_why_it_is_no_number() {
        let any = accepted(f64::NEG_INFINITY..=f64::INFINITY);
        let read = |text: &str, accepted: &Accepted| {
            let draft = Draft::instead_of(1.25, text);
            draft.value(accepted).map_err(|fault| fault.to_string())
        };
        assert_eq!(Draft::of(1.25).value(&any), Ok(None));
        assert_eq!(read("-3,5", &any), Ok(Some(-3.5)));
        assert_eq!(read("+=1cm", &any), Ok(Some(11.25)));
        let fault = read("2+one", &any).expect_err("no number");
        assert!(
            fault.starts_with("Column 3: “one” means nothing here"),
            "{fault}"
        );
        let expected = "Only numbers from 0 to 17".to_owned();
        assert_eq!(read("9*2", &accepted(0.0..=17.0)), Err(expected));
        let expected = "Only numbers from 0 up".to_owned();
        assert_eq!(read("-1", &accepted(0.0..=f64::MAX)), Err(expected));
    }

    #[test]
    fn what_may_become_a_number_is_no_fault_yet() {
        let any = accepted(0.0..=100.0);
        for text in ["", "-", "+.", "1e", "2e-", "sqr", "+=", "3*(1+", "2c"] {
            assert_eq!(Draft::instead_of(1.25, text).fault(&any), None, "{text}");
        }
        for text in ["1x", "101", "-1"] {
            assert!(
                Draft::instead_of(1.25, text).fault(&any).is_some(),
                "{text}"
            );
        }
    }
}
