//! Version 2 of the project file: locked vertices, targets with curvature, osculating plane and
//! slope of curvature, matches of ends, references, the unit of length, and numbers of curves and references.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::error::{Problem, ReadError};
use super::file_match::{FileMatch, MatchSource};
use super::loss::LossReport;
use super::object::Object;
use super::polygon::FilePolygon;
use super::project_curves::{FORMAT, FileCurve, UnknownKeys, read_curves};
use super::project_references::FileReference;
use super::project_values::{Coordinates, Degree, HexColour, Kind, Number, Unit};
use super::reading::Reading;
use crate::document::{Curve, EndTargets, Extras, MatchPlace, Reference};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{Continuity, End, PolygonKind};

/// The version.
pub(super) const VERSION: u64 = 2;

/// A project.
pub(super) type Project = Object<ProjectV2>;

/// What is in a project.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "a Batten project, which is a JSON object")]
pub(super) struct ProjectV2 {
    /// [`FORMAT`], if it is a project.
    #[serde(default)]
    pub format: Value,
    /// [`VERSION`], if it is of this version.
    #[serde(default)]
    pub version: Value,
    /// The unit of all coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<Unit>,
    curves: Vec<Object<CurveV2>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    references: Vec<Object<FileReference>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    matches: Vec<Object<Match>>,
    /// The numbers of the curves, then of the references.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    numbers: Vec<Number>,
}

#[derive(Deserialize, Serialize)]
#[serde(expecting = "a curve, which is a JSON object")]
struct CurveV2 {
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
    /// The locked vertices, counted from 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    locked_vertices: Vec<Number>,
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
    #[serde(default, skip_serializing_if = "Option::is_none")]
    curvature: Option<f64>,
    /// The normal of the osculating plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    normal: Option<Coordinates>,
    /// The slope of the curvature by arc length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    slope: Option<f64>,
}

/// An end that is matched to another curve or to a reference.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "a match, which is a JSON object")]
struct Match {
    /// The curve that follows, counted from 0.
    curve: Number,
    end: EndName,
    /// The curve that it follows, counted from 0 …
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<Number>,
    /// … or the reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    reference: Option<Number>,
    at: MatchedPlace,
    continuity: Level,
    #[serde(default)]
    reversed: bool,
}

/// An end, or a parameter u.
#[derive(Deserialize, Serialize)]
#[serde(untagged, expecting = "\"start\", \"end\" or a number is needed")]
enum MatchedPlace {
    End(EndName),
    Parameter(f64),
}

/// An end by its name.
#[derive(Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
enum EndName {
    Start,
    End,
}

/// A level of continuity by its name.
#[derive(Deserialize, Serialize)]
enum Level {
    G0,
    G1,
    G2,
    G3,
}

impl Project {
    /// Take what version 2 writes of curves, references and matches, with the unit and the keys of the
    /// project that are not known.
    pub(super) fn from_content(
        (curves, references, matches): (&[&Curve], &[&Reference], &[FileMatch]),
        (unit, numbers, extras): (Option<LengthUnit>, &[u64], &Extras),
        kind: PolygonKind,
        losses: &mut LossReport,
    ) -> Self {
        let curves = curves.iter().map(|curve| Object {
            value: CurveV2::from_curve(curve, kind, losses),
            extras: curve.extras.clone(),
        });
        let references = references.iter().map(|reference| Object {
            value: FileReference::of(reference),
            extras: reference.extras.clone(),
        });
        Self {
            value: ProjectV2 {
                format: FORMAT.into(),
                version: VERSION.into(),
                unit: unit.map(Unit),
                curves: curves.collect(),
                references: references.collect(),
                matches: matches.iter().map(|it| Object::new(it.into())).collect(),
                numbers: numbers.iter().map(|it| Number(*it as usize)).collect(),
            },
            extras: extras.clone(),
        }
    }

    /// Check the content and make curves of it.
    pub(super) fn into_reading(self) -> Result<Reading, ReadError> {
        let unit = self.value.unit.map(|unit| unit.0);
        let numbers = self.value.numbers.iter().map(|it| it.0 as u64).collect();
        let curves = self.value.curves.into_iter();
        let curves = curves.map(|Object { value, extras }| FileCurve {
            extras,
            ..value.into_file_curve()
        });
        let mut unknown = UnknownKeys::default();
        let matches = self.value.matches.into_iter();
        let matches = matches.filter_map(|matched| unknown.strip(Some(matched)));
        let matches: Vec<FileMatch> = matches.map(FileMatch::try_from).collect::<Result<_, _>>()?;
        let references = self.value.references.into_iter().enumerate();
        let references = references.map(|(index, Object { value, extras })| {
            let reference = value.into_reference(index + 1)?;
            Ok(Reference {
                extras,
                ..reference
            })
        });
        let references: Vec<Reference> = references.collect::<Result<_, ReadError>>()?;
        let reading = read_curves(curves, references, (matches, unknown), self.extras)?;
        Ok(Reading {
            unit,
            numbers,
            ..reading
        })
    }
}

impl CurveV2 {
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
            locked_vertices: self
                .locked_vertices
                .into_iter()
                .map(|vertex| vertex.0)
                .collect(),
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
                curvature: target.curvature,
                normal: target.normal.map(coordinates),
                slope: target.slope,
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
            locked_vertices: curve.locked_vertices.iter().map(Number).collect(),
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
            curvature: target.curvature,
            normal: target.normal.map(DVec3::from),
            slope: target.slope,
        }
    }
}

impl TryFrom<Match> for FileMatch {
    type Error = Problem;

    fn try_from(matched: Match) -> Result<Self, Problem> {
        Ok(Self {
            curve: matched.curve.0,
            end: matched.end.into(),
            source: match (matched.source, matched.reference) {
                (Some(curve), None) => MatchSource::Curve(curve.0),
                (None, Some(reference)) => MatchSource::Reference(reference.0),
                _ => return Err(Problem::MatchSource),
            },
            place: match matched.at {
                MatchedPlace::End(end) => MatchPlace::End(end.into()),
                MatchedPlace::Parameter(u) => MatchPlace::Parameter(u),
            },
            continuity: match matched.continuity {
                Level::G0 => Continuity::G0,
                Level::G1 => Continuity::G1,
                Level::G2 => Continuity::G2,
                Level::G3 => Continuity::G3,
            },
            reversed: matched.reversed,
        })
    }
}

impl From<&FileMatch> for Match {
    fn from(matched: &FileMatch) -> Self {
        Self {
            curve: Number(matched.curve),
            end: matched.end.into(),
            source: match matched.source {
                MatchSource::Curve(index) => Some(Number(index)),
                MatchSource::Reference(_) => None,
            },
            reference: match matched.source {
                MatchSource::Curve(_) => None,
                MatchSource::Reference(index) => Some(Number(index)),
            },
            at: match matched.place {
                MatchPlace::End(end) => MatchedPlace::End(end.into()),
                MatchPlace::Parameter(u) => MatchedPlace::Parameter(u),
            },
            continuity: match matched.continuity {
                Continuity::G0 => Level::G0,
                Continuity::G1 => Level::G1,
                Continuity::G2 => Level::G2,
                Continuity::G3 => Level::G3,
            },
            reversed: matched.reversed,
        }
    }
}

impl From<EndName> for End {
    fn from(name: EndName) -> Self {
        match name {
            EndName::Start => Self::Start,
            EndName::End => Self::Finish,
        }
    }
}

impl From<End> for EndName {
    fn from(end: End) -> Self {
        match end {
            End::Start => Self::Start,
            End::Finish => Self::End,
        }
    }
}
