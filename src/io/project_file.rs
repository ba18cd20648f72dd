//! The JSON of a project file.
//!
//! One set of types reads and writes every version: in an older version the keys that came later are
//! unknown ones.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::error::{Problem, ReadError};
use super::file_match::{FileMatch, MatchSource};
use super::loss::LossReport;
use super::object::{Object, UnknownKeys, Version};
use super::project_curves::ProjectCurve;
use super::project_guides::ProjectGuides;
use super::project_matches::ProjectMatch;
use super::project_references::ProjectReference;
use super::project_values::{ByName, Number};
use super::reading::{CurveKeys, Owner, Reading, Remark, Remarks};
use crate::document::{CurveId, Document, Reference};
use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;

/// The value of the key `format` in a project.
pub(super) const FORMAT: &str = "batten";

/// The key of the group of a curve or of a reference.
const GROUP: &str = "group";

/// Version 1 of the project file.
pub(super) struct Version1;

/// Version 2 of the project file.
pub(super) struct Version2;

impl Version for Version1 {
    const NUMBER: u64 = 1;
    const LATER_KEYS: &'static [&'static str] = &[
        "unit",
        "references",
        "matches",
        "numbers",
        "locked_vertices",
        GROUP,
        "curvature",
        "normal",
        "slope",
        "symmetry",
        "guides",
    ];
}

impl Version for Version2 {
    const NUMBER: u64 = 2;
    const LATER_KEYS: &'static [&'static str] = &[];
}

/// A project as a file of version `V` holds it.
pub(super) type ProjectFile<V> = Object<Project<V>, V>;

/// The known keys of a project.
#[derive(Deserialize, Serialize)]
#[serde(
    expecting = "a Batten project, which is a JSON object",
    bound = "V: Version"
)]
pub(super) struct Project<V> {
    /// [`FORMAT`], if it is a project.
    #[serde(default)]
    format: Value,
    /// The number of the version.
    #[serde(default)]
    version: Value,
    /// The unit of all coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<ByName<LengthUnit>>,
    curves: Vec<Object<ProjectCurve<V>, V>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    references: Vec<Object<ProjectReference, V>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    matches: Vec<Object<ProjectMatch, V>>,
    /// The guide lines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    guides: Option<Object<ProjectGuides, V>>,
    /// The numbers of the curves, then of the references; without them they are counted from 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    numbers: Vec<Number>,
}

impl ProjectFile<Version2> {
    /// Write a document with each curve held by one of its polygons. The file says the first version
    /// that holds all of it.
    pub(super) fn of(document: &Document, kind: PolygonKind, losses: &mut LossReport) -> Self {
        let curves = document.curves();
        let references = document.references();
        let numbers = document.all_ids().map(CurveId::number);
        let numbers: Vec<u64> = numbers.collect();
        let is_counted = (0..).zip(&numbers).all(|(place, number)| place == *number);
        let numbers = if is_counted { Vec::new() } else { numbers };
        let mut project = Project {
            format: FORMAT.into(),
            version: Version1::NUMBER.into(),
            unit: document.unit().map(ByName),
            curves: curves
                .map(|(_, curve)| ProjectCurve::of(curve, kind, losses))
                .collect(),
            references: references
                .map(|(_, reference)| ProjectReference::of(reference))
                .collect(),
            matches: FileMatch::all(document)
                .iter()
                .map(|matched| Object::new(matched.into()))
                .collect(),
            guides: ProjectGuides::of(document.guide_lines()).map(Object::new),
            numbers: numbers.iter().map(|it| Number(*it as usize)).collect(),
        };
        if project.unit.is_some()
            || !project.references.is_empty()
            || !project.matches.is_empty()
            || !project.numbers.is_empty()
            || project.guides.is_some()
            || project.curves.iter().any(|it| it.value.needs_version_2())
        {
            project.version = Version2::NUMBER.into();
            // An unknown key of version 1 must not become the group in version 2.
            for curve in &mut project.curves {
                curve.extras.remove(GROUP);
            }
        }
        Object::new(project).with_extras(document.extras().clone())
    }
}

impl<V: Version> ProjectFile<V> {
    /// Check the content and make curves and references of it.
    ///
    /// # Errors
    /// [`ReadError`] with the curve or the reference.
    pub(super) fn into_reading(self) -> Result<Reading, ReadError> {
        let Self {
            value: project,
            extras,
            ..
        } = self;
        let mut remarks = Remarks::default();
        for (key, _) in extras.iter() {
            remarks.add(Remark::unknown_key(key, Owner::Project));
        }
        let mut curves = Vec::new();
        let mut keys = CurveKeys::default();
        for (number, curve) in (1..).zip(project.curves) {
            let curve = curve.into_curve(number, &mut remarks)?;
            for (key, _) in curve.extras.iter() {
                keys.add(key, number, &curve.name);
            }
            curves.push(curve);
        }
        keys.remark(&mut remarks);
        let mut references = Vec::new();
        for (number, Object { value, extras, .. }) in (1..).zip(project.references) {
            let reference = value.into_reference(number)?;
            for (key, _) in extras.iter() {
                let reference = (number, reference.name.clone());
                remarks.add(Remark::unknown_key(key, Owner::Reference { reference }));
            }
            references.push(Reference {
                extras,
                ..reference
            });
        }
        let mut unknown = UnknownKeys::default();
        let matches = project.matches.into_iter();
        let matches = matches.filter_map(|matched| unknown.strip(Some(matched)));
        let matches: Vec<FileMatch> = matches.map(FileMatch::try_from).collect::<Result<_, _>>()?;
        for key in unknown.0 {
            remarks.add(Remark::unknown_key(&key, Owner::Matches));
        }
        let mut unknown = UnknownKeys::default();
        let guides = unknown.strip(project.guides);
        for key in unknown.0 {
            remarks.add(Remark::unknown_key(&key, Owner::Project));
        }
        let reading = Reading {
            curves,
            references,
            matches,
            unit: project.unit.map(|unit| unit.0),
            numbers: project.numbers.iter().map(|it| it.0 as u64).collect(),
            guide_lines: guides.map_or_else(Vec::new, ProjectGuides::into_lines),
            extras,
            remarks,
        };
        check_matches(&reading)?;
        Ok(reading)
    }
}

/// Refuse matches that name missing curves, or cannot be.
fn check_matches(reading: &Reading) -> Result<(), Problem> {
    for matched in &reading.matches {
        for named in [MatchSource::Curve(matched.curve), matched.source] {
            match named {
                MatchSource::Curve(index) if index >= reading.curves.len() => {
                    let count = reading.curves.len();
                    return Err(Problem::NoSuchCurve { index, count });
                }
                MatchSource::Reference(index) if index >= reading.references.len() => {
                    let count = reading.references.len();
                    return Err(Problem::NoSuchReference { index, count });
                }
                _ => {}
            }
        }
    }
    if !reading.matches.is_empty() {
        let document = reading.clone().into_document();
        document.map_err(Problem::Match)?;
    }
    Ok(())
}
