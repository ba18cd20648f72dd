//! Version 1 of the project file.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::error::ReadError;
use super::loss::LossReport;
use super::object::Object;
use super::polygon::FilePolygon;
use super::project_curves::{FORMAT, FileCurve, UnknownKeys, read_curves};
use super::project_values::{Coordinates, Degree, HexColour, Kind};
use super::reading::Reading;
use crate::document::{Curve, EndTargets, Extras};
use crate::geometry::PolygonKind;
use crate::geometry::end_correction::EndTarget;

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
        let curves = self.value.curves.into_iter();
        let curves = curves.map(|Object { value, extras }| FileCurve {
            extras,
            ..value.into_file_curve()
        });
        let none = (Vec::new(), UnknownKeys::default());
        read_curves(curves, Vec::new(), none, self.extras)
    }
}

impl CurveV1 {
    fn into_file_curve(self) -> FileCurve {
        let mut unknown = UnknownKeys::default();
        let targets = unknown.strip(self.targets).unwrap_or_default();
        let [start, finish] = [targets.start, targets.end].map(|target| unknown.strip(target));
        FileCurve {
            name: self.name,
            colour: self.colour.map(|colour| colour.0),
            visible: self.visible.unwrap_or(true),
            locked: self.locked.unwrap_or(false),
            polygon: FilePolygon {
                kind: self.polygon.0,
                degree: self.degree.0,
                vertices: self.vertices.into_iter().map(DVec3::from).collect(),
                weights: self.weights,
                periodic: self.periodic.unwrap_or(false),
            },
            locked_vertices: Vec::new(),
            targets: EndTargets {
                start: start.map(EndTarget::from),
                finish: finish.map(EndTarget::from),
            },
            unknown,
            extras: Extras::default(),
        }
    }

    fn from_curve(curve: &Curve, kind: PolygonKind, losses: &mut LossReport) -> Self {
        let planar = curve.polygon.is_planar();
        let coordinates = |vector| Coordinates::of(vector, planar);
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

impl From<Target> for EndTarget {
    fn from(target: Target) -> Self {
        Self {
            point: target.point.into(),
            direction: target.direction.map(DVec3::from),
            ..Self::default()
        }
    }
}
