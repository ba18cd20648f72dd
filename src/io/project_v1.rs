//! Version 1 of the project file.

use glam::DVec3;
use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

use super::error::{Place, Problem, ReadError};
use super::loss::LossReport;
use super::object::Object;
use super::polygon::FilePolygon;
use super::reading::{CurveKeys, Owner, Reading, Remark, Remarks};
use crate::document::{Colour, Curve, EndTargets, Extras, quoted};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, MAX_DEGREE, MAX_MAGNITUDE, PolygonKind};

/// What a file says to be a project.
pub(super) const FORMAT: &str = "batten";

/// The version.
pub(super) const VERSION: u64 = 1;

/// A project.
pub(super) type Project = Object<ProjectV1>;

/// What is in a project.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "a Batten project, which is a JSON object")]
pub(super) struct ProjectV1 {
    /// [`FORMAT`], if it is a project.
    #[serde(default)]
    pub format: Value,
    /// [`VERSION`], if it is of this version.
    #[serde(default)]
    pub version: Value,
    curves: Vec<Object<CurveV1>>,
}

#[derive(Deserialize, Serialize)]
#[serde(expecting = "a curve, which is a JSON object")]
struct CurveV1 {
    #[serde(default)]
    name: Option<String>,
    degree: Degree,
    #[serde(default)]
    polygon: Kind,
    #[serde(default, alias = "color", skip_serializing_if = "Option::is_none")]
    colour: Option<HexColour>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    visible: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    locked: Option<bool>,
    vertices: Vec<Coordinates>,
    #[serde(default)]
    weights: Option<Vec<f64>>,
    #[serde(default)]
    periodic: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    targets: Option<Object<Targets>>,
}

#[derive(Default, Deserialize, Serialize)]
#[serde(expecting = "the targets of a curve, which are a JSON object")]
struct Targets {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<Object<Target>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    end: Option<Object<Target>>,
}

#[derive(Deserialize, Serialize)]
#[serde(expecting = "a target, which is a JSON object")]
struct Target {
    point: Coordinates,
    #[serde(default)]
    direction: Option<Coordinates>,
}

impl Project {
    /// Take what version 1 writes of curves, with the keys of the project that are not known.
    pub(super) fn from_curves(
        curves: &[&Curve],
        extras: &Extras,
        kind: PolygonKind,
        losses: &mut LossReport,
    ) -> Self {
        let curves = curves.iter().map(|curve| Object {
            value: CurveV1::from_curve(curve, kind, losses),
            extras: curve.extras.clone(),
        });
        Self {
            value: ProjectV1 {
                format: FORMAT.into(),
                version: VERSION.into(),
                curves: curves.collect(),
            },
            extras: extras.clone(),
        }
    }

    /// Check the content and make curves of it.
    pub(super) fn into_reading(self) -> Result<Reading, ReadError> {
        let mut remarks = Remarks::default();
        for (key, _) in self.extras.iter() {
            remarks.add(Remark::UnknownKey {
                key: key.to_owned(),
                owner: Owner::Project,
            });
        }
        let mut curves = Vec::with_capacity(self.value.curves.len());
        let mut keys = CurveKeys::default();
        for (index, Object { value, extras }) in self.value.curves.into_iter().enumerate() {
            let number = index + 1;
            let curve = value.into_curve(number, &mut remarks)?;
            for (key, _) in extras.iter() {
                keys.add(key, number, &curve.name);
            }
            curves.push(Curve { extras, ..curve });
        }
        keys.remark(&mut remarks);
        Ok(Reading {
            curves,
            extras: self.extras,
            remarks,
        })
    }
}

impl CurveV1 {
    fn into_curve(self, number: usize, remarks: &mut Remarks) -> Result<Curve, ReadError> {
        let given = self.name.filter(|name| !name.trim().is_empty());
        let name = given.unwrap_or_else(|| format!("curve {number}"));
        let place = |problem| Place::curve(number, &name).problem(problem);
        let polygon = FilePolygon {
            kind: self.polygon.0,
            degree: self.degree.0,
            vertices: self.vertices.into_iter().map(DVec3::from).collect(),
            weights: self.weights,
            periodic: self.periodic.unwrap_or(false),
        };
        let curve = polygon.into_curve(number, &name, remarks).map_err(place)?;
        let mut forgotten = Forgotten::default();
        let targets = forgotten.strip(self.targets).unwrap_or_default();
        let targets = EndTargets {
            start: checked(forgotten.strip(targets.start), End::Start).map_err(place)?,
            finish: checked(forgotten.strip(targets.end), End::Finish).map_err(place)?,
        };
        for key in forgotten.0 {
            let curve = (number, name.clone());
            let owner = Owner::Targets { curve };
            remarks.add(Remark::UnknownKey { key, owner });
        }
        Ok(Curve {
            colour: self.colour.map(|colour| colour.0),
            visible: self.visible.unwrap_or(true),
            locked: self.locked.unwrap_or(false),
            targets,
            ..curve
        })
    }

    fn from_curve(curve: &Curve, kind: PolygonKind, losses: &mut LossReport) -> Self {
        let planar = curve.polygon.is_planar();
        let coordinates = |DVec3 { x, y, z }| {
            let third = (!planar || z != 0.0).then_some(z);
            Coordinates(x, y, third, ())
        };
        let target = |target: EndTarget| {
            Object::new(Target {
                point: coordinates(target.point),
                direction: target.direction.map(coordinates),
            })
        };
        let targets = Targets {
            start: curve.targets.start.map(target),
            end: curve.targets.finish.map(target),
        };
        let polygon = FilePolygon::of(&curve.polygon, kind);
        losses.extend(curve, polygon.losses(&curve.polygon));
        Self {
            name: Some(curve.name.clone()),
            degree: Degree(polygon.degree),
            polygon: Kind(kind),
            colour: curve.colour.map(HexColour),
            visible: (!curve.visible).then_some(false),
            locked: curve.locked.then_some(true),
            vertices: polygon.vertices.into_iter().map(coordinates).collect(),
            weights: polygon.weights,
            periodic: Some(polygon.periodic),
            targets: (targets.start.is_some() || targets.end.is_some())
                .then(|| Object::new(targets)),
        }
    }
}

/// Unknown keys that are not kept.
#[derive(Default)]
struct Forgotten(Vec<String>);

impl Forgotten {
    fn strip<T>(&mut self, object: Option<Object<T>>) -> Option<T> {
        let object = object?;
        let keys = object.extras.iter().map(|(key, _)| key.to_owned());
        self.0.extend(keys);
        Some(object.value)
    }
}

fn checked(target: Option<Target>, end: End) -> Result<Option<EndTarget>, Problem> {
    let Some(Target { point, direction }) = target else {
        return Ok(None);
    };
    let target = EndTarget {
        point: point.into(),
        direction: direction.map(DVec3::from),
        ..EndTarget::default()
    };
    let end = end.name();
    let vectors = [target.point, target.direction.unwrap_or_default()];
    let mut values = vectors.into_iter().flat_map(|vector| vector.to_array());
    if let Some(value) = values.find(|value| value.abs() > MAX_MAGNITUDE) {
        return Err(Problem::TargetOutOfRange { end, value });
    }
    if target.direction == Some(DVec3::ZERO) {
        return Err(Problem::NoDirection { end });
    }
    Ok(Some(target))
}

/// A whole number; whether it is a possible degree the polygon checks.
#[derive(Deserialize, Serialize)]
#[serde(try_from = "f64")]
struct Degree(usize);

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

/// A polygon by its name.
#[derive(Clone, Default, Deserialize, Serialize)]
#[serde(try_from = "String", into = "&str")]
struct Kind(PolygonKind);

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

/// A colour such as #1f77b4.
#[derive(Clone, Deserialize, Serialize)]
#[serde(try_from = "String", into = "String")]
struct HexColour(Colour);

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
#[derive(Deserialize, Serialize)]
#[serde(expecting = "2 or 3 numbers in brackets")]
struct Coordinates(
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

impl From<Coordinates> for DVec3 {
    fn from(Coordinates(x, y, z, ()): Coordinates) -> Self {
        Self::new(x, y, z.unwrap_or_default())
    }
}
