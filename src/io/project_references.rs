//! The JSON of a reference in a project file.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::error::{Place, Problem, ReadError};
use super::object::Object;
use super::project_values::{self, ByName, Coordinates};
use crate::document::{Colour, Group, Reference};
use crate::geometry::references::{
    AnalyticForm, Formula, KINDS, Nurbs, Placement, PointList, ReferenceCurve, ReferenceError,
    ReferenceForm, ReferenceKind, find,
};

/// A reference: a kind with its values, formulas, or points, each over an interval and placed.
#[derive(Default, Deserialize, Serialize)]
#[serde(expecting = "a reference, which is a JSON object")]
pub(super) struct ProjectReference {
    #[serde(default)]
    name: Option<String>,
    /// The path of its group.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    group: Option<ByName<Group>>,
    #[serde(default, alias = "color", skip_serializing_if = "Option::is_none")]
    colour: Option<ByName<Colour>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    visible: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    locked: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    kind: Option<String>,
    /// The kind's values by their names; those that are left out have their defaults.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    values: BTreeMap<String, f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    formula: Option<FileFormula>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    points: Option<Vec<Coordinates>>,
    /// How much each point counts; of a B-spline the weights of its control points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    weights: Option<Vec<f64>>,
    /// The degree of a B-spline, whose control points are the points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    degree: Option<usize>,
    /// The knots of a B-spline.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    knots: Option<Vec<f64>>,
    /// Whether its file calls a B-spline periodic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    periodic: Option<bool>,
    /// The interval of the parameter t.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    interval: Option<[f64; 2]>,
    /// A quaternion, its real part last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rotation: Option<[f64; 4]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scale: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    translation: Option<Coordinates>,
}

/// Formulas as they were typed.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "formulas: a JSON object with x, y and, in space, z")]
struct FileFormula {
    x: String,
    y: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    z: Option<String>,
}

impl ProjectReference {
    /// Write a reference.
    pub(super) fn of<V>(reference: &Reference) -> Object<Self, V> {
        let curve = &reference.curve;
        let mut written = Self {
            name: Some(reference.name.clone()),
            group: Some(&reference.group)
                .filter(|it| !it.is_none())
                .cloned()
                .map(ByName),
            colour: reference.colour.map(ByName),
            visible: (!reference.visible).then_some(false),
            locked: reference.locked.then_some(true),
            ..Self::default()
        };
        match curve.form() {
            ReferenceForm::Analytic(form) => {
                let names = form.kind().parameters.iter().map(|it| it.name.to_owned());
                written.kind = Some(form.kind().name.to_owned());
                written.values = names.zip(form.values().iter().copied()).collect();
                written.interval = Some(curve.interval());
            }
            ReferenceForm::Formula(formula) => {
                let [x, y, z] = formula.texts();
                let text = |text: Option<&str>| text.map(str::to_owned);
                written.formula = Some(FileFormula {
                    x: text(x).unwrap_or_default(),
                    y: text(y).unwrap_or_default(),
                    z: text(z),
                });
                written.interval = Some(curve.interval());
            }
            ReferenceForm::Points(list) => {
                let planar = list.is_planar();
                let points = list.points().iter();
                let points = points.map(|point| Coordinates::of(*point, planar));
                written.points = Some(points.collect());
                written.weights = list.weights().map(<[f64]>::to_vec);
            }
            ReferenceForm::Nurbs(nurbs) => {
                let planar = nurbs.is_planar();
                let points = nurbs.points().iter();
                let points = points.map(|point| Coordinates::of(*point, planar));
                written.points = Some(points.collect());
                written.weights = nurbs.weights().map(<[f64]>::to_vec);
                written.degree = Some(nurbs.degree());
                written.knots = Some(nurbs.knots().to_vec());
                written.periodic = nurbs.is_periodic().then_some(true);
                written.interval = Some(curve.interval());
            }
        }
        let placement = curve.placement();
        if *placement != Placement::default() {
            written.rotation = Some(placement.rotation().to_array());
            written.scale = Some(placement.scale());
            written.translation = Some(Coordinates::of(placement.translation(), true));
        }
        Object::new(written).with_extras(reference.extras.clone())
    }

    /// Check the reference with this number, counted from 1.
    ///
    /// # Errors
    /// [`ReadError`] with the reference.
    pub(super) fn into_reference(self, number: usize) -> Result<Reference, ReadError> {
        let given = self.name.clone().filter(|name| !name.trim().is_empty());
        let name = given.unwrap_or_else(|| format!("reference {number}"));
        let group = self.group.clone().unwrap_or_default().0;
        let (colour, visible, locked) = (self.colour, self.visible, self.locked);
        let curve = self.into_curve();
        let curve = curve.map_err(|problem| Place::reference(number, &name).problem(problem))?;
        Ok(Reference {
            group,
            colour: colour.map(|colour| colour.0),
            visible: visible.unwrap_or(true),
            locked: locked.unwrap_or(false),
            ..Reference::new(name, curve)
        })
    }

    fn into_curve(self) -> Result<ReferenceCurve, Problem> {
        let placement = self.placement()?;
        let form = match (self.kind, self.formula, self.points) {
            (Some(kind), None, None) => ReferenceForm::Analytic(analytic(&kind, &self.values)?),
            (None, Some(FileFormula { x, y, z }), None) => {
                ReferenceForm::Formula(Formula::new(&x, &y, z.as_deref())?)
            }
            (None, None, Some(points)) if let Some(knots) = self.knots => {
                let points = project_values::points("point", points)?;
                let degree = self.degree.ok_or(Problem::NoReference)?;
                let periodic = self.periodic.unwrap_or(false);
                let nurbs = Nurbs::new(degree, knots, points, self.weights, periodic);
                ReferenceForm::Nurbs(nurbs.map_err(ReferenceError::from)?)
            }
            (None, None, Some(points)) => {
                let list = PointList::new(project_values::points("point", points)?)?;
                ReferenceForm::Points(match self.weights {
                    Some(weights) => list.with_weights(weights)?,
                    None => list,
                })
            }
            _ => return Err(Problem::NoReference),
        };
        let interval = self.interval.unwrap_or_else(|| form.default_interval());
        Ok(ReferenceCurve::new(form, interval, placement)?)
    }

    fn placement(&self) -> Result<Placement, ReferenceError> {
        let none = Placement::default();
        let rotation = self.rotation.map_or(none.rotation(), DQuat::from_array);
        let translation = self.translation.clone().map(DVec3::from);
        Placement::new(
            rotation,
            self.scale.unwrap_or(none.scale()),
            translation.unwrap_or(none.translation()),
        )
    }
}

/// Find a kind, and give it values by their names.
fn analytic(name: &str, values: &BTreeMap<String, f64>) -> Result<AnalyticForm, Problem> {
    let kind = find(name).ok_or_else(|| Problem::NoSuchKind {
        name: name.to_owned(),
        known: KINDS
            .iter()
            .map(|kind| kind.name)
            .collect::<Vec<_>>()
            .join(", "),
    })?;
    let is_known = |name: &String| kind.parameters.iter().any(|it| it.name == name);
    if let Some(name) = values.keys().find(|name| !is_known(name)) {
        let (kind, name) = (kind.name, name.clone());
        return Err(Problem::NoSuchValue { kind, name });
    }
    Ok(AnalyticForm::new(kind, given_values(kind, values))?)
}

fn given_values(kind: &ReferenceKind, values: &BTreeMap<String, f64>) -> Vec<f64> {
    let parameters = kind.parameters.iter();
    let value = parameters.map(|it| values.get(it.name).copied().unwrap_or(it.kind.default));
    value.collect()
}
