//! A value of a parameter, or a figure.

use crate::geometry::End;
use crate::geometry::parameters::Quantity;
use crate::geometry::references::ReferenceCurve;

/// A value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A whole number.
    Whole(usize),
    /// A finite number; angles are in radians.
    Real(f64),
    /// Which of the options it is, counted from 0.
    Choice(usize),
    /// On or off.
    Switch(bool),
    /// Some finite numbers; none where nothing is given.
    List(Vec<f64>),
    /// The numbers of some things, counted from 0; only figures have them.
    Indices(Vec<usize>),
    /// Rows of numbers under names; only figures have them.
    Table {
        /// The names of the columns.
        columns: &'static [&'static str],
        /// The rows.
        rows: Vec<Vec<f64>>,
    },
    /// A word; only figures have it.
    Word(&'static str),
    /// An end of a first curve and one of a second; only figures have them.
    Ends([End; 2]),
    /// A reference, or none.
    Reference(Option<Box<ReferenceCurve>>),
}

impl Value {
    /// Write the value, angles in degrees; an option by its index.
    pub fn text(&self, quantity: Quantity) -> String {
        let joined = |texts: Vec<String>| texts.join(", ");
        match self {
            Self::Whole(number) | Self::Choice(number) => number.to_string(),
            Self::Real(number) => quantity.shown(*number).to_string(),
            Self::Switch(on) => if *on { "on" } else { "off" }.to_owned(),
            Self::Reference(reference) => {
                let text = reference.as_ref().map(|reference| reference.to_string());
                text.unwrap_or_default()
            }
            Self::List(numbers) => {
                let shown = numbers.iter();
                joined(
                    shown
                        .map(|number| quantity.shown(*number).to_string())
                        .collect(),
                )
            }
            Self::Indices(indices) => joined(indices.iter().map(usize::to_string).collect()),
            Self::Table { rows, .. } => joined(rows.iter().map(|row| format!("{row:?}")).collect()),
            Self::Word(word) => (*word).to_owned(),
            Self::Ends(ends) => joined(ends.iter().map(|end| end.name().to_owned()).collect()),
        }
    }
}
