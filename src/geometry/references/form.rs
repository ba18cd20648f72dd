//! Form of a reference, without its placement.

use glam::DVec3;

use super::error::ReferenceError;
use super::formula::Formula;
use super::formulas::{CIRCLE, ELLIPSE};
use super::frame::Frame;
use super::kind::{EVERYWHERE, ReferenceKind};
use super::nurbs::Nurbs;
use super::point_list::PointList;
use crate::geometry::interval::Interval;
use crate::geometry::power_series::PowerSeries;

/// A curve by its formula, or points.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceForm {
    /// A kind of curve with its values.
    Analytic(AnalyticForm),
    /// Formulas typed by the user.
    Formula(Formula),
    /// Points, joined by straight lines.
    Points(PointList),
    /// A B-spline on any knots.
    Nurbs(Nurbs),
    /// The frame of a picture.
    Frame(Frame),
}

/// Kind of curve with a checked value for each parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct AnalyticForm {
    kind: &'static ReferenceKind,
    values: Vec<f64>,
}

impl AnalyticForm {
    /// Check the values of a kind, in the order of its parameters.
    ///
    /// # Errors
    /// [`ReferenceError::ValueCount`] and [`ReferenceError::OutOfRange`].
    pub fn new(kind: &'static ReferenceKind, values: Vec<f64>) -> Result<Self, ReferenceError> {
        let (found, needed) = (values.len(), kind.parameters.len());
        if found != needed {
            let kind = kind.name;
            return Err(ReferenceError::ValueCount {
                kind,
                found,
                needed,
            });
        }
        for (parameter, value) in kind.parameters.iter().zip(&values) {
            parameter.kind.check(parameter.label, *value)?;
        }
        Ok(Self { kind, values })
    }

    /// The kind.
    pub fn kind(&self) -> &'static ReferenceKind {
        self.kind
    }

    /// The values, in the order of the kind's parameters.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The point at t and its derivatives by t; outside of the kind's domain nothing is a number.
    pub(super) fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        let [from, to] = (self.kind.domain)(&self.values);
        if !(from..=to).contains(&t) {
            return vec![DVec3::NAN; order + 1];
        }
        if let Some([a, b]) = self.half_axes().filter(|_| order < 3) {
            let (sin, cos) = t.sin_cos();
            let all = [[cos, sin], [-sin, cos], [-cos, -sin]];
            let all = all.map(|[x, y]| DVec3::new(a * x, b * y, 0.0));
            return all.into_iter().take(order + 1).collect();
        }
        PowerSeries::derivatives(self.kind.series(&self.values, t, order).each_ref())
    }

    /// The half axes of a circle or an ellipse, which turn one way alone, by a turn for each 2π of their parameter.
    pub(super) fn half_axes(&self) -> Option<[f64; 2]> {
        match (self.kind.name, self.values.first(), self.values.last()) {
            (name, Some(a), Some(b)) if [CIRCLE.name, ELLIPSE.name].contains(&name) => {
                Some([*a, *b])
            }
            _ => None,
        }
    }

    /// Bound the coordinates for bounds of the series of t.
    pub(super) fn enclosed(&self, t: &PowerSeries<Interval>) -> Option<[PowerSeries<Interval>; 3]> {
        self.kind.enclosed(&self.values, t)
    }
}

impl ReferenceForm {
    /// Its name in the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Analytic(form) => form.kind.name,
            Self::Formula(_) => "formula",
            Self::Points(_) => "points",
            Self::Nurbs(_) => "nurbs",
            Self::Frame(_) => "picture",
        }
    }

    /// Make it larger about its origin by its own numbers, at the same parameters. `None` for formulas, frames and kinds
    /// that are not sized by lengths alone, which are placed larger, and where a number leaves its range.
    pub fn scaled(&self, factor: f64) -> Option<Self> {
        match self {
            Self::Analytic(form) => {
                let sizes = form.half_axes().and(Some(&form.values))?;
                let sizes = sizes.iter().map(|size| factor * size).collect();
                AnalyticForm::new(form.kind, sizes).ok().map(Self::Analytic)
            }
            Self::Points(points) => points.scaled(factor).ok().map(Self::Points),
            Self::Nurbs(nurbs) => nurbs.scaled(factor).ok().map(Self::Nurbs),
            Self::Formula(_) | Self::Frame(_) => None,
        }
    }

    /// Its label in menus and lists.
    pub fn label(&self) -> &'static str {
        match self {
            Self::Analytic(form) => form.kind.label,
            Self::Formula(_) => "Formula",
            Self::Points(_) => "Points",
            Self::Nurbs(_) => "NURBS",
            Self::Frame(_) => "Picture",
        }
    }

    /// Whether it lies in the plane z = 0.
    pub fn is_planar(&self) -> bool {
        match self {
            Self::Analytic(form) => form.kind.is_planar(),
            Self::Formula(formula) => formula.texts()[2].is_none(),
            Self::Points(points) => points.is_planar(),
            Self::Nurbs(nurbs) => nurbs.is_planar(),
            Self::Frame(_) => true,
        }
    }

    /// Whether a text in the command line describes it.
    pub fn has_text(&self) -> bool {
        matches!(self, Self::Analytic(_) | Self::Formula(_))
    }

    /// Whether it has a curvature, but perhaps at the knots of a B-spline; points and frames have none.
    pub fn is_smooth(&self) -> bool {
        self.row().is_none()
    }

    /// The points that straight lines join, of points and of frames.
    pub(super) fn row(&self) -> Option<&PointList> {
        match self {
            Self::Points(points) => Some(points),
            Self::Frame(frame) => Some(frame.outline()),
            Self::Analytic(_) | Self::Formula(_) | Self::Nurbs(_) => None,
        }
    }

    /// Whether it may run through infinity, or jump, within its domain: formulas may.
    pub fn may_leap(&self) -> bool {
        matches!(self, Self::Formula(_))
    }

    /// The interval of its parameter t that is drawn if none is given: of points all of them.
    pub fn default_interval(&self) -> [f64; 2] {
        match self {
            Self::Analytic(form) => (form.kind.interval)(&form.values),
            Self::Formula(_) => [0.0, 1.0],
            Self::Points(points) => [0.0, (points.points().len() - 1) as f64],
            Self::Nurbs(nurbs) => nurbs.interval(),
            Self::Frame(_) => [0.0, 4.0],
        }
    }

    /// The domain of t.
    pub fn domain(&self) -> [f64; 2] {
        match self {
            Self::Analytic(form) => (form.kind.domain)(&form.values),
            Self::Formula(_) => EVERYWHERE,
            Self::Points(_) | Self::Nurbs(_) | Self::Frame(_) => self.default_interval(),
        }
    }
}
