//! Version 1 of the project file.

use std::fmt;

use glam::DVec3;
use serde::de::{Error, IgnoredAny, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::error::{Place, Problem, ReadError};
use super::loss::LossReport;
use super::object::Object;
use super::polygon::{Built, Written, build, written};
use super::project::{FORMAT, VERSION};
use super::reading::{CurveKeys, Owner, Reading, Remark, Remarks};
use crate::document::{Colour, Curve, EndTargets, cut};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, MAX_DEGREE, MAX_MAGNITUDE, PolygonKind};

/// A project as it is read.
pub(super) type Project = Object<ProjectV1>;

#[derive(Deserialize)]
#[serde(expecting = "a Batten project, which is a JSON object")]
pub(super) struct ProjectV1 {
    #[serde(default, rename = "format")]
    _format: IgnoredAny,
    #[serde(default, rename = "version")]
    _version: IgnoredAny,
    curves: Vec<Object<CurveV1>>,
}

/// A project as it is written.
#[derive(Serialize)]
pub(super) struct WrittenProject {
    format: &'static str,
    version: u64,
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
    weights: Option<Vec<Number>>,
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

impl WrittenProject {
    /// Take what version 1 writes of the curves.
    pub(super) fn from_curves(
        curves: &[&Curve],
        kind: PolygonKind,
        losses: &mut LossReport,
    ) -> Self {
        let curves = curves.iter().map(|curve| Object {
            value: CurveV1::from_curve(curve, kind, losses),
            extras: curve.extras.clone(),
        });
        Self {
            format: FORMAT,
            version: VERSION,
            curves: curves.collect(),
        }
    }
}

impl CurveV1 {
    fn into_curve(self, number: usize, remarks: &mut Remarks) -> Result<Curve, ReadError> {
        let given = self.name.filter(|name| !name.trim().is_empty());
        let name = given.unwrap_or_else(|| format!("curve {number}"));
        let place = |problem| Place::curve(number, &name).problem(problem);
        let weights = self.weights;
        let kind = self.polygon.0;
        let Built { polygon, off_by } = build(
            kind,
            self.degree.0,
            self.vertices
                .into_iter()
                .map(|vertex| vertex.point)
                .collect(),
            weights.map(|weights| weights.into_iter().map(|weight| weight.0).collect()),
            self.periodic.unwrap_or(false),
        )
        .map_err(place)?;
        if let Some(by) = off_by {
            let curve = (number, name.clone());
            remarks.add(Remark::CurveOff { curve, kind, by });
        }
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
            ..Curve::new(name, polygon)
        })
    }

    fn from_curve(curve: &Curve, kind: PolygonKind, losses: &mut LossReport) -> Self {
        let planar = curve.polygon.is_planar();
        let coordinates = |point: DVec3| Coordinates {
            point,
            dimension: if planar && point.z == 0.0 { 2 } else { 3 },
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
        let Written {
            vertices,
            weights,
            periodic,
            losses: lost,
        } = written(&curve.polygon, kind);
        for loss in lost {
            losses.add(curve, loss);
        }
        Self {
            name: Some(curve.name.clone()),
            degree: Degree(curve.polygon.degree()),
            polygon: Kind(kind),
            colour: curve.colour.map(HexColour),
            visible: (!curve.visible).then_some(false),
            locked: curve.locked.then_some(true),
            vertices: vertices.into_iter().map(coordinates).collect(),
            weights: weights.map(|weights| weights.into_iter().map(Number).collect()),
            periodic: Some(periodic),
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
    let Some(target) = target else {
        return Ok(None);
    };
    let direction = target.direction.map(|direction| direction.point);
    for value in [Some(target.point.point), direction]
        .into_iter()
        .flatten()
        .flat_map(|vector| vector.to_array())
    {
        if value.abs() > MAX_MAGNITUDE {
            let end = end.name();
            return Err(Problem::TargetOutOfRange { end, value });
        }
    }
    if direction == Some(DVec3::ZERO) {
        return Err(Problem::NoDirection { end: end.name() });
    }
    Ok(Some(EndTarget {
        point: target.point.point,
        direction,
    }))
}

/// A number. JSON has no infinite ones; serde_json refuses those that overflow.
#[derive(Clone, Copy, Serialize)]
struct Number(f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_f64(NumberVisitor).map(Self)
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = f64;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a number")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }
}

/// A whole number; whether it is a possible degree the polygon checks.
struct Degree(usize);

impl Serialize for Degree {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u64(self.0 as u64)
    }
}

impl<'de> Deserialize<'de> for Degree {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Number(value) = Number::deserialize(deserializer)?;
        if value >= 0.0 && value.fract() == 0.0 {
            // The cast keeps what is too large at the largest number, which is refused too.
            Ok(Self(value as usize))
        } else {
            Err(Error::custom(format!(
                "degree {value} is out of range: a whole number from 1 to {MAX_DEGREE} is needed"
            )))
        }
    }
}

#[derive(Default)]
struct Kind(PolygonKind);

impl Serialize for Kind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.name())
    }
}

impl<'de> Deserialize<'de> for Kind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let kind = PolygonKind::from_name(&name).map(Self);
        kind.ok_or_else(|| {
            Error::invalid_value(Unexpected::Str(&cut(&name)), &"float, clamped or bezier")
        })
    }
}

struct HexColour(Colour);

impl Serialize for HexColour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Colour([red, green, blue]) = self.0;
        serializer.serialize_str(&format!("#{red:02x}{green:02x}{blue:02x}"))
    }
}

impl<'de> Deserialize<'de> for HexColour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let digits = text.strip_prefix('#').filter(|digits| {
            digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
        });
        let value = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let value = value.ok_or_else(|| {
            Error::invalid_value(Unexpected::Str(&cut(&text)), &"a colour like #1f77b4")
        })?;
        let [_, red, green, blue] = value.to_be_bytes();
        Ok(Self(Colour([red, green, blue])))
    }
}

/// A point or vector, written with 2 or 3 numbers.
struct Coordinates {
    point: DVec3,
    dimension: usize,
}

impl Serialize for Coordinates {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.point.to_array().iter().take(self.dimension))
    }
}

impl<'de> Deserialize<'de> for Coordinates {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(CoordinatesVisitor)
    }
}

struct CoordinatesVisitor;

impl<'de> Visitor<'de> for CoordinatesVisitor {
    type Value = Coordinates;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("2 or 3 numbers in brackets")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Coordinates, A::Error> {
        let mut values = [0.0; 3];
        let mut dimension = 0;
        while let Some(Number(value)) = sequence.next_element()? {
            match values.get_mut(dimension) {
                Some(place) => *place = value,
                None => return Err(Error::invalid_length(dimension + 1, &self)),
            }
            dimension += 1;
        }
        if dimension < 2 {
            return Err(Error::invalid_length(dimension, &self));
        }
        Ok(Coordinates {
            point: DVec3::from_array(values),
            dimension,
        })
    }
}
