//! The JSON of a curve in a project file.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::error::{Place, Problem, ReadError};
use super::object::{Object, UnknownKeys, Version};
use super::polygon::FilePolygon;
use super::project_symmetry::ProjectSymmetry;
use super::project_values::{ByName, Coordinates, Degree, Number, points};
use super::reading::{Owner, Remark, Remarks};
use crate::document::{Colour, Curve, EndTargets, Group};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::{End, MAX_MAGNITUDE, PolygonKind};

/// The known keys of a curve.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "a curve, which is a JSON object", bound = "V: Version")]
pub(super) struct ProjectCurve<V> {
    #[serde(default)]
    name: Option<String>,
    /// The path of its group.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    group: Option<ByName<Group>>,
    degree: Degree,
    #[serde(default)]
    polygon: ByName<PolygonKind>,
    #[serde(default, alias = "color", skip_serializing_if = "Option::is_none")]
    colour: Option<ByName<Colour>>,
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
    targets: Option<Object<Targets<V>, V>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    symmetry: Option<Object<ProjectSymmetry, V>>,
}

#[derive(Deserialize, Serialize)]
#[serde(
    expecting = "the targets of a curve, which are a JSON object",
    bound = "V: Version"
)]
struct Targets<V> {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<Object<Target, V>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    end: Option<Object<Target, V>>,
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
    /// dκ/ds, the derivative of the curvature by arc length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    slope: Option<f64>,
}

impl<V> ProjectCurve<V> {
    /// Write a curve by one of its polygons.
    pub(super) fn of(curve: &Curve, kind: PolygonKind) -> Object<Self, V> {
        let planar = curve.polygon.is_planar();
        let coordinates = |vector| Coordinates::of(vector, planar);
        let target = |end| {
            let target = curve.targets.get(end)?;
            Some(Object::new(Target {
                point: coordinates(target.point),
                direction: target.direction.map(coordinates),
                curvature: target.curvature,
                normal: target.normal.map(coordinates),
                slope: target.slope,
            }))
        };
        let [start, end] = [End::Start, End::Finish].map(target);
        let targets = (start.is_some() || end.is_some()).then_some(Targets { start, end });
        let symmetry = curve.symmetry.as_ref();
        let symmetry = symmetry.and_then(|it| ProjectSymmetry::of(it, planar));
        let polygon = FilePolygon::of(&curve.polygon, kind);
        let written = Self {
            name: Some(curve.name.clone()),
            group: Some(&curve.group)
                .filter(|it| !it.is_none())
                .cloned()
                .map(ByName),
            degree: Degree(polygon.degree),
            polygon: ByName(kind),
            colour: curve.colour.map(ByName),
            visible: (!curve.visible).then_some(false),
            locked: curve.locked.then_some(true),
            vertices: polygon.vertices.into_iter().map(coordinates).collect(),
            weights: polygon.weights,
            periodic: Some(polygon.periodic),
            locked_vertices: curve.locked_vertices.iter().map(Number).collect(),
            targets: targets.map(Object::new),
            symmetry: symmetry.map(Object::new),
        };
        Object::new(written).with_extras(curve.extras.clone())
    }
}

/// Whether a curve has a key that version 1 does not know.
pub(super) fn needs_version_2(curve: &Curve) -> bool {
    let mut targets = curve.targets.list().into_iter();
    !curve.locked_vertices.is_empty()
        || !curve.group.is_none()
        || curve.symmetry.is_some()
        || targets.any(|(_, target)| {
            target.curvature.is_some() || target.normal.is_some() || target.slope.is_some()
        })
}

impl<V> Object<ProjectCurve<V>, V> {
    /// Check the curve with this number, counted from 1.
    ///
    /// # Errors
    /// [`ReadError`] with the curve, and with the vertex where one is wrong.
    pub(super) fn into_curve(
        self,
        number: usize,
        remarks: &mut Remarks,
    ) -> Result<Curve, ReadError> {
        let Self { value, extras, .. } = self;
        let given = value.name.filter(|name| !name.trim().is_empty());
        let name = given.unwrap_or_else(|| format!("curve {number}"));
        let place = |problem| Place::curve(number, &name).problem(problem);
        let polygon = FilePolygon {
            kind: value.polygon.0,
            degree: value.degree.0,
            vertices: points("vertex", value.vertices).map_err(place)?,
            weights: value.weights,
            periodic: value.periodic.unwrap_or(false),
        };
        let curve = polygon.into_curve(number, &name, remarks).map_err(place)?;
        for Number(vertex) in &value.locked_vertices {
            let checked = curve.polygon.check_index(*vertex);
            checked.map_err(|error| place(Problem::from(error)))?;
        }
        let mut unknown = UnknownKeys::default();
        let mut targets = EndTargets::default();
        if let Some(Targets { start, end }) = unknown.strip(value.targets) {
            targets.start = unknown.strip(start).map(EndTarget::from);
            targets.finish = unknown.strip(end).map(EndTarget::from);
        }
        for (end, target) in targets.list() {
            check(&target, end).map_err(place)?;
        }
        for key in unknown.0 {
            let curve = (number, name.clone());
            remarks.add(Remark::unknown_key(&key, Owner::Targets { curve }));
        }
        let mut symmetry = UnknownKeys::default();
        let given = symmetry.strip(value.symmetry);
        for key in symmetry.0 {
            let curve = (number, name.clone());
            remarks.add(Remark::unknown_key(&key, Owner::Symmetry { curve }));
        }
        let curve = Curve {
            group: value.group.map(|group| group.0).unwrap_or_default(),
            colour: value.colour.map(|colour| colour.0),
            visible: value.visible.unwrap_or(true),
            locked: value.locked.unwrap_or(false),
            locked_vertices: value.locked_vertices.into_iter().map(|it| it.0).collect(),
            targets,
            extras,
            ..curve
        };
        let Some(given) = given else {
            return Ok(curve);
        };
        let symmetry = given.into_symmetry(&curve.polygon);
        let symmetric = symmetry.and_then(|it| curve.with_symmetry(it).ok());
        Ok(match symmetric {
            // Either end may be the one whose target was set.
            Some(symmetric) if curve.targets.list().len() == 2 => Curve {
                targets: curve.targets,
                ..symmetric
            },
            Some(symmetric) => symmetric,
            None => {
                let owner = (number, name.clone());
                remarks.add(Remark::Asymmetric { curve: owner });
                curve
            }
        })
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
