//! What values of arguments may be.

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::geometry::expressions::{LengthUnit, NumberContext};
use crate::geometry::{PolygonKind, Spacing};
use crate::io::examples::{EXAMPLES, Example};
use crate::io::exchange::drawing::Kind;
use crate::io::{ColumnChoice, Format, PRESETS, Preset, formats};

/// The most points that are written, and the most threads that may be asked for.
const MOST: usize = 1_000_000;

/// Read a format by its extension.
pub(super) fn format_parser(
    formats: impl IntoIterator<Item = &'static Format>,
) -> impl TypedValueParser<Value = &'static Format> {
    let formats = formats.into_iter();
    let names = PossibleValuesParser::new(formats.map(Format::extension));
    names.try_map(|name| formats::find(&name).ok_or("no such format"))
}

pub(super) fn spacing_parser() -> impl TypedValueParser<Value = Spacing> {
    let names = PossibleValuesParser::new(Spacing::ALL.map(Spacing::name));
    names.try_map(|name| {
        let mut all = Spacing::ALL.into_iter();
        all.find(|it| it.name() == name).ok_or("no such spacing")
    })
}

/// Read a number of points, which may be an expression.
pub(super) fn count(text: &str) -> Result<usize, String> {
    whole(text, 2)
}

/// Read a number of threads, which may be an expression.
pub(super) fn jobs(text: &str) -> Result<usize, String> {
    whole(text, 1)
}

fn whole(text: &str, least: usize) -> Result<usize, String> {
    let number = NumberContext::default().read(text);
    let number = number.map_err(|mistake| mistake.to_string())?;
    let is_count = number.fract() == 0.0 && (least as f64..=MOST as f64).contains(&number);
    match is_count {
        true => Ok(number as usize),
        false => Err(format!("a whole number from {least} to {MOST} is needed")),
    }
}

/// Read a tolerance, which may be an expression.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let number = NumberContext::default().read(text);
    let number = number.map_err(|mistake| mistake.to_string())?;
    match number > 0.0 {
        true => Ok(number),
        false => Err("a number above 0 is needed".to_owned()),
    }
}

/// Read a factor above 0, which may be an expression.
pub(super) fn scale(text: &str) -> Result<f64, String> {
    tolerance(text)
}

pub(super) fn preset_parser() -> impl TypedValueParser<Value = &'static Preset> {
    let names = PossibleValuesParser::new(PRESETS.iter().map(|preset| preset.name));
    names.try_map(|name| Preset::find(&name).ok_or("no such program"))
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

pub(super) fn kind_parser() -> impl TypedValueParser<Value = Kind> {
    let names = PossibleValuesParser::new(Kind::ALL.map(Kind::name));
    names.try_map(|name| {
        let mut all = Kind::ALL.into_iter();
        all.find(|kind| kind.name() == name).ok_or("no such kind")
    })
}

pub(super) fn parameter(text: &str) -> Result<f64, String> {
    let value: Result<f64, _> = text.trim().parse();
    value
        .ok()
        .filter(|value| value.is_finite())
        .ok_or_else(|| "a finite number is needed".to_owned())
}
