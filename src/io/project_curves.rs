//! What project files of every version say of curves, checked in one place.

use super::error::{Place, Problem, ReadError};
use super::file_match::{FileMatch, MatchSource};
use super::object::Object;
use super::polygon::FilePolygon;
use super::reading::{CurveKeys, Owner, Reading, Remark, Remarks};
use crate::document::{Colour, Curve, EndTargets, Extras, Reference};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, MAX_MAGNITUDE};
use glam::DVec3;

/// What a file says to be a project.
pub(super) const FORMAT: &str = "batten";

/// A curve of a project file, not yet checked. What a version does not have is empty.
pub(super) struct FileCurve {
    /// Its name, if it is given one.
    pub name: Option<String>,
    /// Its own colour.
    pub colour: Option<Colour>,
    /// Whether it is shown.
    pub visible: bool,
    /// Whether it is locked.
    pub locked: bool,
    /// One of its polygons.
    pub polygon: FilePolygon,
    /// Its locked vertices.
    pub locked_vertices: Vec<usize>,
    /// The targets of its ends.
    pub targets: EndTargets,
    /// Unknown keys that are not kept.
    pub unknown: UnknownKeys,
    /// Unknown keys that are kept.
    pub extras: Extras,
}

/// Unknown keys that are not kept.
#[derive(Default)]
pub(super) struct UnknownKeys(Vec<String>);

impl UnknownKeys {
    /// Take an object without its unknown keys, and remember these.
    pub(super) fn strip<T>(&mut self, object: Option<Object<T>>) -> Option<T> {
        let object = object?;
        let keys = object.extras.iter().map(|(key, _)| key.to_owned());
        self.0.extend(keys);
        Some(object.value)
    }
}

/// Check the curves of a project and the matches between them and its references, given with their unknown keys. The
/// project has `extras` of its own.
///
/// # Errors
/// [`ReadError`] with the curve.
pub(super) fn read_curves(
    given: impl Iterator<Item = FileCurve>,
    references: Vec<Reference>,
    (matches, unknown): (Vec<FileMatch>, UnknownKeys),
    extras: Extras,
) -> Result<Reading, ReadError> {
    let mut remarks = Remarks::default();
    for (key, _) in extras.iter() {
        remarks.add(Remark::UnknownKey {
            key: key.to_owned(),
            owner: Owner::Project,
        });
    }
    let mut curves = Vec::new();
    let mut keys = CurveKeys::default();
    for (index, curve) in given.enumerate() {
        let number = index + 1;
        let curve = curve.into_curve(number, &mut remarks)?;
        for (key, _) in curve.extras.iter() {
            keys.add(key, number, &curve.name);
        }
        curves.push(curve);
    }
    keys.remark(&mut remarks);
    for (index, reference) in references.iter().enumerate() {
        for (key, _) in reference.extras.iter() {
            let reference = (index + 1, reference.name.clone());
            let (key, owner) = (key.to_owned(), Owner::Reference { reference });
            remarks.add(Remark::UnknownKey { key, owner });
        }
    }
    for key in unknown.0 {
        let owner = Owner::Matches;
        remarks.add(Remark::UnknownKey { key, owner });
    }
    let reading = Reading {
        curves,
        references,
        matches,
        unit: None,
        numbers: Vec::new(),
        extras,
        remarks,
    };
    for matched in &reading.matches {
        let named = [MatchSource::Curve(matched.curve), matched.source];
        named
            .into_iter()
            .try_for_each(|it| check_named(it, &reading))?;
    }
    if !reading.matches.is_empty() {
        let made = reading.clone().into_document();
        made.map_err(|error| ReadError::from(Problem::Match(error)))?;
    }
    Ok(reading)
}

/// Refuse what a match names if it is not there.
fn check_named(named: MatchSource, reading: &Reading) -> Result<(), Problem> {
    match named {
        MatchSource::Curve(index) if index >= reading.curves.len() => {
            let count = reading.curves.len();
            Err(Problem::NoSuchCurve { index, count })
        }
        MatchSource::Reference(index) if index >= reading.references.len() => {
            let count = reading.references.len();
            Err(Problem::NoSuchReference { index, count })
        }
        _ => Ok(()),
    }
}

impl FileCurve {
    fn into_curve(self, number: usize, remarks: &mut Remarks) -> Result<Curve, ReadError> {
        let given = self.name.filter(|name| !name.trim().is_empty());
        let name = given.unwrap_or_else(|| format!("curve {number}"));
        let place = |problem| Place::curve(number, &name).problem(problem);
        let polygon = self.polygon.into_curve(number, &name, remarks);
        let curve = polygon.map_err(place)?;
        for vertex in &self.locked_vertices {
            let checked = curve.polygon.check_index(*vertex);
            checked.map_err(|error| place(Problem::from(error)))?;
        }
        for (end, target) in self.targets.list() {
            check(&target, end).map_err(place)?;
        }
        for key in self.unknown.0 {
            let curve = (number, name.clone());
            let owner = Owner::Targets { curve };
            remarks.add(Remark::UnknownKey { key, owner });
        }
        Ok(Curve {
            colour: self.colour,
            visible: self.visible,
            locked: self.locked,
            locked_vertices: self.locked_vertices.into_iter().collect(),
            targets: self.targets,
            extras: self.extras,
            ..curve
        })
    }
}

fn check(target: &EndTarget, end: End) -> Result<(), Problem> {
    let end = end.name();
    let vectors = [Some(target.point), target.direction, target.normal];
    let vectors = vectors.into_iter().flatten();
    let coordinates = vectors.flat_map(|vector| vector.to_array());
    let numbers = [target.curvature, target.slope].into_iter().flatten();
    let mut numbers = coordinates.chain(numbers);
    if let Some(value) = numbers.find(|number| number.abs() > MAX_MAGNITUDE) {
        return Err(Problem::TargetOutOfRange { end, value });
    }
    for (vector, what) in [(target.direction, "direction"), (target.normal, "normal")] {
        if vector == Some(DVec3::ZERO) {
            return Err(Problem::ZeroVector { end, what });
        }
    }
    Ok(())
}
