//! Values as project files of every version write them.

use glam::DVec3;
use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize};

use crate::document::{Colour, quoted};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{MAX_DEGREE, PolygonKind};

/// A whole number; whether it is a possible degree the polygon checks.
#[derive(Deserialize, Serialize)]
#[serde(try_from = "f64")]
pub(super) struct Degree(pub usize);

impl TryFrom<f64> for Degree {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        if value >= 0.0 && value.fract() == 0.0 {
            // The cast keeps what is too large at the largest number, which is refused too.
            Ok(Self(value as usize))
        } else {
            Err(format!(
                "degree {value} is out of range: a whole number from 1 to {MAX_DEGREE} is needed"
            ))
        }
    }
}

/// The number of a vertex or curve, counted from 0; whether there is one is checked elsewhere.
#[derive(Deserialize, Serialize)]
#[serde(try_from = "f64")]
pub(super) struct Number(pub usize);

impl TryFrom<f64> for Number {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        if value >= 0.0 && value.fract() == 0.0 {
            // The cast keeps what is too large at the largest number, which is refused too.
            Ok(Self(value as usize))
        } else {
            Err(format!(
                "{value} cannot be counted from 0: a whole number is needed"
            ))
        }
    }
}

/// A polygon by its name.
#[derive(Clone, Default, Deserialize, Serialize)]
#[serde(try_from = "String", into = "&str")]
pub(super) struct Kind(pub PolygonKind);

impl TryFrom<String> for Kind {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let kind = PolygonKind::from_name(&name).map(Self);
        kind.ok_or_else(|| {
            let name = quoted(&name);
            format!("{name} is not a polygon: float, clamped or bezier is needed")
        })
    }
}

impl From<Kind> for &str {
    fn from(kind: Kind) -> Self {
        kind.0.name()
    }
}

/// A unit of length by its symbol.
#[derive(Clone, Deserialize, Serialize)]
#[serde(try_from = "String", into = "&str")]
pub(super) struct Unit(pub LengthUnit);

impl TryFrom<String> for Unit {
    type Error = String;

    fn try_from(symbol: String) -> Result<Self, String> {
        let unit = LengthUnit::of_symbol(&symbol).map(Self);
        unit.ok_or_else(|| {
            let symbol = quoted(&symbol);
            format!("{symbol} is not a unit of length: mm, cm, m or in is needed")
        })
    }
}

impl From<Unit> for &str {
    fn from(unit: Unit) -> Self {
        unit.0.symbol()
    }
}

/// A colour such as #1f77b4.
#[derive(Clone, Deserialize, Serialize)]
#[serde(try_from = "String", into = "String")]
pub(super) struct HexColour(pub Colour);

impl TryFrom<String> for HexColour {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let digits = text.strip_prefix('#').filter(|digits| {
            digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
        });
        let value = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let value = value.ok_or_else(|| {
            let text = quoted(&text);
            format!("{text} is not a colour: one like #1f77b4 is needed")
        })?;
        let [_, red, green, blue] = value.to_be_bytes();
        Ok(Self(Colour([red, green, blue])))
    }
}

impl From<HexColour> for String {
    fn from(HexColour(Colour([red, green, blue])): HexColour) -> Self {
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}

/// A point or vector: 2 or 3 numbers. A third that is `null`, and a fourth, are refused where they
/// stand.
#[derive(Clone, Deserialize, Serialize)]
#[serde(expecting = "2 or 3 numbers in brackets")]
pub(super) struct Coordinates(
    f64,
    f64,
    #[serde(
        default,
        deserialize_with = "given",
        skip_serializing_if = "Option::is_none"
    )]
    Option<f64>,
    #[serde(default, deserialize_with = "refused", skip_serializing)] (),
);

fn given<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    f64::deserialize(deserializer).map(Some)
}

fn refused<'de, D: Deserializer<'de>>(_: D) -> Result<(), D::Error> {
    let found = Unexpected::Other("a fourth number");
    Err(D::Error::invalid_value(
        found,
        &"2 or 3 numbers in brackets",
    ))
}

impl Coordinates {
    /// Write a point or vector of a `planar` curve, which has no third number unless it is not 0, or
    /// of one in space.
    pub(super) fn of(DVec3 { x, y, z }: DVec3, planar: bool) -> Self {
        let third = (!planar || z != 0.0).then_some(z);
        Self(x, y, third, ())
    }
}

impl From<Coordinates> for DVec3 {
    fn from(Coordinates(x, y, z, ()): Coordinates) -> Self {
        Self::new(x, y, z.unwrap_or_default())
    }
}
