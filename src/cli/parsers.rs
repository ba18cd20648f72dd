//! What values of arguments may be.

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;
use crate::io::examples::{EXAMPLES, Example};
use crate::io::{ColumnChoice, Format, formats};

/// Read a format by its extension.
pub(super) fn format_parser(
    formats: impl IntoIterator<Item = &'static Format>,
) -> impl TypedValueParser<Value = &'static Format> {
    let formats = formats.into_iter();
    let names = PossibleValuesParser::new(formats.map(Format::extension));
    names.try_map(|name| formats::find(&name).ok_or("no such format"))
}

/// Read columns by their numbers, counted from 1, or by their names.
pub(super) fn columns(text: &str) -> Result<ColumnChoice, &'static str> {
    text.parse()
}

pub(super) fn example_parser() -> impl TypedValueParser<Value = Example> {
    let names = PossibleValuesParser::new(EXAMPLES.map(|example| example.name));
    names.try_map(|name| Example::find(&name).ok_or("no such example"))
}

pub(super) fn polygon_parser() -> impl TypedValueParser<Value = PolygonKind> {
    let names = PossibleValuesParser::new(PolygonKind::ALL.map(PolygonKind::name));
    names.try_map(|name| PolygonKind::from_name(&name).ok_or("no such polygon"))
}

pub(super) fn unit_parser() -> impl TypedValueParser<Value = LengthUnit> {
    let symbols = PossibleValuesParser::new(LengthUnit::ALL.map(LengthUnit::symbol));
    symbols.try_map(|symbol| LengthUnit::of_symbol(&symbol).ok_or("no such unit"))
}

pub(super) fn parameter(text: &str) -> Result<f64, String> {
    let value: Result<f64, _> = text.trim().parse();
    value
        .ok()
        .filter(|value| value.is_finite())
        .ok_or_else(|| "a finite number is needed".to_owned())
}
