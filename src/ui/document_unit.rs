//! The document's unit of length, for fields that convert to it.

use eframe::egui::{Context, Id};

use crate::geometry::expressions::LengthUnit;

fn id() -> Id {
    Id::unique("document unit")
}

/// Set the document's unit for the fields of this frame.
pub fn set(context: &Context, unit: Option<LengthUnit>) {
    context.data_mut(|data| data.insert_temp(id(), unit));
}

/// Append the document's unit, if it has one, to the text of a length.
pub fn length(context: &Context, text: String) -> String {
    LengthUnit::behind(get(context), text)
}

/// Append one over the document's unit, if it has one, to the text of a curvature.
pub fn curvature(context: &Context, text: String) -> String {
    match get(context) {
        Some(unit) => format!("{text} /{}", unit.symbol()),
        None => text,
    }
}

/// What one unit, and several, are called.
pub fn names(context: &Context) -> [&'static str; 2] {
    match get(context) {
        Some(unit) => [unit.symbol(); 2],
        None => ["unit", "units"],
    }
}

/// The document's unit.
pub fn get(context: &Context) -> Option<LengthUnit> {
    context.data(|data| data.get_temp(id())).flatten()
}
