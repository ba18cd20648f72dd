//! Values in the JSON of a project file.

use std::borrow::Cow;

use glam::DVec3;
use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::error::Problem;
use crate::document::{Colour, Group, quoted};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{Continuity, End, MAX_DEGREE, PolygonKind};

/// A degree as a whole number; the polygon checks whether it is possible.
#[derive(Deserialize, Serialize)]
#[serde(try_from = "f64")]
pub(super) struct Degree(pub usize);

impl TryFrom<f64> for Degree {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        let needed = || {
            format!(
                "degree {value} is out of range: a whole number from 1 to {MAX_DEGREE} is needed"
            )
        };
        whole(value).map(Self).ok_or_else(needed)
    }
}

/// The number of a vertex or curve, counted from 0; whether there is one is checked elsewhere.
#[derive(Deserialize, Serialize)]
#[serde(try_from = "f64")]
pub(super) struct Number(pub usize);

impl TryFrom<f64> for Number {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        let needed = || format!("{value} cannot be counted from 0: a whole number is needed");
        whole(value).map(Self).ok_or_else(needed)
    }
}

/// A whole number from 0. What is too large becomes the largest number, which is refused later.
fn whole(value: f64) -> Option<usize> {
    (value >= 0.0 && value.fract() == 0.0).then_some(value as usize)
}

/// A value that a file gives by its name.
#[derive(Clone, Copy, Default)]
pub(super) struct ByName<T>(pub T);

/// A type whose values have names in project files.
pub(super) trait Named: Sized {
    /// How a message goes on after a wrong name.
    const NEEDED: &'static str;

    fn of_name(name: &str) -> Option<Self>;

    fn name(&self) -> Cow<'static, str>;
}

impl<T: Named> Serialize for ByName<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0.name())
    }
}

impl<'de, T: Named> Deserialize<'de> for ByName<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let value = T::of_name(&name).map(Self);
        value.ok_or_else(|| D::Error::custom(format_args!("{} is {}", quoted(&name), T::NEEDED)))
    }
}

impl Named for PolygonKind {
    const NEEDED: &'static str = "not a polygon: float, clamped or bezier is needed";

    fn of_name(name: &str) -> Option<Self> {
        Self::from_name(name)
    }

    fn name(&self) -> Cow<'static, str> {
        Self::name(*self).into()
    }
}

impl Named for Group {
    const NEEDED: &'static str = "not a path of groups: names with / between them are needed";

    fn of_name(name: &str) -> Option<Self> {
        Some(name.into())
    }

    fn name(&self) -> Cow<'static, str> {
        self.to_string().into()
    }
}

impl Named for LengthUnit {
    const NEEDED: &'static str = "not a unit of length: mm, cm, m or in is needed";

    fn of_name(name: &str) -> Option<Self> {
        Self::of_symbol(name)
    }

    fn name(&self) -> Cow<'static, str> {
        self.symbol().into()
    }
}

impl Named for End {
    const NEEDED: &'static str = "not an end: start or end is needed";

    fn of_name(name: &str) -> Option<Self> {
        let mut ends = [Self::Start, Self::Finish].into_iter();
        ends.find(|end| end.name() == name)
    }

    fn name(&self) -> Cow<'static, str> {
        Self::name(*self).into()
    }
}

impl Named for Continuity {
    const NEEDED: &'static str = "not a continuity: G0, G1, G2 or G3 is needed";

    fn of_name(name: &str) -> Option<Self> {
        Self::from_name(name)
    }

    fn name(&self) -> Cow<'static, str> {
        Self::name(*self).into()
    }
}

impl Named for Colour {
    const NEEDED: &'static str = "not a colour: one like #1f77b4 is needed";

    fn of_name(name: &str) -> Option<Self> {
        let digits = name.strip_prefix('#').filter(|digits| {
            digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
        });
        let [_, red, green, blue] = u32::from_str_radix(digits?, 16).ok()?.to_be_bytes();
        Some(Self([red, green, blue]))
    }

    fn name(&self) -> Cow<'static, str> {
        let Self([red, green, blue]) = self;
        format!("#{red:02x}{green:02x}{blue:02x}").into()
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

/// Take vertices or points, as `what` says, which have all 2 or all 3 numbers.
///
/// # Errors
/// [`Problem::FewerCoordinates`] at the first that has fewer numbers than others.
pub(super) fn points(what: &'static str, all: Vec<Coordinates>) -> Result<Vec<DVec3>, Problem> {
    let lacks_third = |point: &Coordinates| point.2.is_none();
    let lacking = all.iter().position(lacks_third);
    match lacking.filter(|_| !all.iter().all(lacks_third)) {
        Some(index) => Err(Problem::FewerCoordinates { what, index }),
        None => Ok(all.into_iter().map(DVec3::from).collect()),
    }
}

impl From<Coordinates> for DVec3 {
    fn from(Coordinates(x, y, z, ()): Coordinates) -> Self {
        Self::new(x, y, z.unwrap_or_default())
    }
}
