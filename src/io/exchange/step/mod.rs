//! STEP, ISO 10303-21: the curves of AP203, AP214 and AP242.

mod assembly;
mod curves;
mod cuts;
mod evaluation;
mod expansion;
mod flaw;
mod form;
mod instances;
mod items;
mod output;
mod placements;
mod reader;
mod representations;
mod shapes;
mod splines;
mod styles;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_structure;
#[cfg(test)]
mod tests_writer;
mod text;
mod tokens;
mod trims;
mod units;
mod writer;

pub use reader::read;
pub use writer::{Protocol, write};
