//! The JSON of a project file.
//!
//! One set of types reads and writes every version: in an older version the keys that came later are
//! unknown ones.

use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use super::error::{Problem, ReadError};
use super::file_match::{FileMatch, MatchSource};
use super::loss::LossReport;
use super::object::{Object, UnknownKeys, Version};
use super::polygon::FilePolygon;
use super::project_curves::{ProjectCurve, needs_version_2};
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
pub(super) type ProjectFile<V> = Object<Project<V, ReadCurves<V>, ReadReferences<V>>, V>;

type ReadCurves<V> = Vec<Object<ProjectCurve<V>, V>>;
type ReadReferences<V> = Vec<Object<ProjectReference, V>>;

/// A project to be written.
pub(super) type WrittenProject<'a> =
    Object<Project<Version2, WrittenCurves<'a>, WrittenReferences<'a>>, Version2>;

/// The known keys of a project.
#[derive(Deserialize, Serialize)]
#[serde(
    expecting = "a Batten project, which is a JSON object",
    bound(
        serialize = "V: Version, C: Serialize, R: Serialize",
        deserialize = "V: Version, C: Deserialize<'de>, R: Deserialize<'de>"
    )
)]
pub(super) struct Project<V, C, R> {
    /// [`FORMAT`], if it is a project.
    #[serde(default)]
    format: Value,
    /// The number of the version.
    #[serde(default)]
    version: Value,
    /// The unit of all coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<ByName<LengthUnit>>,
    curves: C,
    #[serde(
        default,
        deserialize_with = "given",
        skip_serializing_if = "Option::is_none"
    )]
    references: Option<R>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    matches: Vec<Object<ProjectMatch, V>>,
    /// The guide lines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    guides: Option<Object<ProjectGuides, V>>,
    /// The numbers of the curves, then of the references; without them they are counted from 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    numbers: Vec<Number>,
}

/// Take a value that is not null.
fn given<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

/// The curves of a document, each made when its turn to be written comes: drawings have many.
pub(super) struct WrittenCurves<'a> {
    document: &'a Document,
    kind: PolygonKind,
    /// The version of the file.
    version: u64,
}

impl Serialize for WrittenCurves<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.document.curves().map(|(_, curve)| {
            let mut written = ProjectCurve::<Version2>::of(curve, self.kind);
            if self.version == Version2::NUMBER {
                // An unknown key of version 1 must not become the group in version 2.
                written.extras.remove(GROUP);
            }
            written
        }))
    }
}

/// The references of a document, made in the same way.
pub(super) struct WrittenReferences<'a>(&'a Document);

impl Serialize for WrittenReferences<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let references = self.0.references();
        let references =
            references.map(|(_, reference)| ProjectReference::of::<Version2>(reference));
        serializer.collect_seq(references)
    }
}

impl<'a> WrittenProject<'a> {
    /// Write a document with each curve held by one of its polygons. The file says the first version
    /// that holds all of it.
    pub(super) fn of(document: &'a Document, kind: PolygonKind, losses: &mut LossReport) -> Self {
        let has_references = document.references().next().is_some();
        let numbers = document.all_ids().map(CurveId::number);
        let numbers: Vec<u64> = numbers.collect();
        let is_counted = (0..).zip(&numbers).all(|(place, number)| place == *number);
        let numbers = if is_counted { Vec::new() } else { numbers };
        let unit = document.unit().map(ByName);
        let matches: Vec<_> = FileMatch::all(document)
            .iter()
            .map(|matched| Object::new(matched.into()))
            .collect();
        let guides = ProjectGuides::of(document.guide_lines()).map(Object::new);
        let is_new = unit.is_some()
            || has_references
            || !matches.is_empty()
            || !numbers.is_empty()
            || guides.is_some()
            || document.curves().any(|(_, curve)| needs_version_2(curve));
        let version = match is_new {
            true => Version2::NUMBER,
            false => Version1::NUMBER,
        };
        for (_, curve) in document.curves() {
            let polygon = FilePolygon::of(&curve.polygon, kind);
            losses.extend(curve, polygon.losses(&curve.polygon));
        }
        let project = Project {
            format: FORMAT.into(),
            version: version.into(),
            unit,
            curves: WrittenCurves {
                document,
                kind,
                version,
            },
            references: has_references.then_some(WrittenReferences(document)),
            matches,
            guides,
            numbers: numbers.iter().map(|it| Number(*it as usize)).collect(),
        };
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
            curves.push(Arc::new(curve));
        }
        keys.remark(&mut remarks);
        let mut references = Vec::new();
        for (number, Object { value, extras, .. }) in
            (1..).zip(project.references.unwrap_or_default())
        {
            let reference = value.into_reference(number)?;
            for (key, _) in extras.iter() {
                let reference = (number, reference.name.clone());
                remarks.add(Remark::unknown_key(key, Owner::Reference { reference }));
            }
            references.push(Arc::new(Reference {
                extras,
                ..reference
            }));
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
