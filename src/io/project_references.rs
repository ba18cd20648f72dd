//! The JSON of a reference in a project file.

use std::collections::BTreeMap;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::error::{Place, Problem, ReadError};
use super::object::Object;
use super::project_values::{self, ByName, Coordinates};
use crate::document::{Colour, Group, Picture, PictureSource, Reference};
use crate::geometry::references::{
    AnalyticForm, Formula, Frame, KINDS, Nurbs, Placement, PointList, ReferenceCurve,
    ReferenceError, ReferenceForm, ReferenceKind, find,
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
    /// Whether no lines join the points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    apart: Option<bool>,
    /// The degree of a B-spline, whose control points are the points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    degree: Option<usize>,
    /// The knots of a B-spline.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    knots: Option<Vec<f64>>,
    /// Whether its file calls a B-spline periodic.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    periodic: Option<bool>,
    /// The picture in the frame that the points are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    picture: Option<FilePicture>,
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

/// A picture: the path of its file, relative to the project's folder, or its bytes in base 64.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "a picture: a JSON object with a file or data, and pixels")]
struct FilePicture {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    data: Option<String>,
    pixels: [u32; 2],
    #[serde(default, skip_serializing_if = "Option::is_none")]
    opacity: Option<f64>,
}

impl From<&Picture> for FilePicture {
    fn from(picture: &Picture) -> Self {
        let (file, data) = match &picture.source {
            // A slash divides names on every system.
            PictureSource::File(path) => (Some(path.to_string_lossy().replace('\\', "/")), None),
            PictureSource::Embedded(bytes) => (None, Some(BASE64_STANDARD.encode(bytes))),
        };
        Self {
            file,
            data,
            pixels: picture.pixels,
            opacity: (picture.opacity != Picture::OPACITY).then_some(picture.opacity),
        }
    }
}

impl TryFrom<FilePicture> for Picture {
    type Error = Problem;

    fn try_from(found: FilePicture) -> Result<Self, Problem> {
        let source = match (found.file, found.data) {
            (Some(file), None) => PictureSource::File(file.into()),
            (None, Some(data)) => {
                let bytes = BASE64_STANDARD.decode(data);
                let bytes = bytes.map_err(|error| Problem::Picture(error.to_string()))?;
                PictureSource::Embedded(bytes.into())
            }
            _ => return Err(Problem::Picture("“file” or “data” is needed".to_owned())),
        };
        let opacity = found.opacity.unwrap_or(Self::OPACITY);
        if !(0.0..=1.0).contains(&opacity) {
            return Err(Problem::Picture(format!(
                "the opacity {opacity} is not from 0 to 1"
            )));
        }
        if found.pixels.contains(&0) {
            return Err(Problem::Picture("it has no pixels".to_owned()));
        }
        Ok(Self {
            opacity,
            ..Self::new(source, found.pixels)
        })
    }
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
            picture: reference.picture.as_ref().map(FilePicture::from),
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
                written.apart = list.is_apart().then_some(true);
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
            // Older versions read points.
            ReferenceForm::Frame(frame) => {
                let corners = frame.corners().iter();
                let corners = corners.map(|corner| Coordinates::of(*corner, true));
                written.points = Some(corners.collect());
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
    pub(super) fn into_reference(mut self, number: usize) -> Result<Reference, ReadError> {
        let given = self.name.clone().filter(|name| !name.trim().is_empty());
        let name = given.unwrap_or_else(|| format!("reference {number}"));
        let group = self.group.clone().unwrap_or_default().0;
        let (colour, visible, locked) = (self.colour, self.visible, self.locked);
        let place = |problem| Place::reference(number, &name).problem(problem);
        let picture = self.picture.take().map(Picture::try_from);
        let picture = picture.transpose().map_err(place)?;
        let curve = match picture {
            Some(_) => self.into_frame(),
            None => self.into_curve(),
        };
        let curve = curve.map_err(place)?;
        Ok(Reference {
            group,
            colour: colour.map(|colour| colour.0),
            visible: visible.unwrap_or(true),
            locked: locked.unwrap_or(false),
            picture,
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
                let list = match self.weights {
                    Some(weights) => list.with_weights(weights)?,
                    None => list,
                };
                ReferenceForm::Points(match self.apart {
                    Some(true) => list.apart(),
                    _ => list,
                })
            }
            _ => return Err(Problem::NoReference),
        };
        let interval = self.interval.unwrap_or_else(|| form.default_interval());
        Ok(ReferenceCurve::new(form, interval, placement)?)
    }

    /// The frame whose corners are the points: the third one says its size.
    fn into_frame(self) -> Result<ReferenceCurve, Problem> {
        let placement = self.placement()?;
        let points = self.points.ok_or(Problem::NoReference)?;
        let points = project_values::points("point", points)?;
        let opposite = points.get(2).ok_or(Problem::NoReference)?;
        let form = ReferenceForm::Frame(Frame::new(opposite.truncate())?);
        let interval = form.default_interval();
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
