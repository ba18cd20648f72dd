//! Curves by formulas of one's own.

use super::error::{ReferenceError, ReferenceTextError};
use crate::geometry::expressions::{Argument, Expression};
use crate::geometry::power_series::PowerSeries;

/// Formulas x(t), y(t) and, of a curve in space, z(t).
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    pub(super) x: Coordinate,
    pub(super) y: Coordinate,
    pub(super) z: Option<Coordinate>,
}

/// A formula as typed, with its expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Coordinate {
    pub(super) text: String,
    pub(super) expression: Box<Expression>,
}

impl Formula {
    /// Read formulas: expressions in t, as [`ReferenceCurve::from_text`] reads them.
    ///
    /// [`ReferenceCurve::from_text`]: super::ReferenceCurve::from_text
    ///
    /// # Errors
    /// [`ReferenceError::InFormula`] names the coordinate and the column of a mistake.
    pub fn new(x: &str, y: &str, z: Option<&str>) -> Result<Self, ReferenceError> {
        let read = |coordinate: &'static str, text: &str| {
            Coordinate::read(text).map_err(|mistake| ReferenceError::InFormula {
                coordinate,
                mistake: Box::new(mistake),
            })
        };
        Ok(Self {
            x: read("x", x)?,
            y: read("y", y)?,
            z: z.map(|z| read("z", z)).transpose()?,
        })
    }

    /// The formulas as they were typed: x, y and, of a curve in space, z.
    pub fn texts(&self) -> [Option<&str>; 3] {
        let z = self.z.as_ref().map(|z| z.text.as_str());
        [Some(&self.x.text), Some(&self.y.text), z]
    }

    /// Find the first place of an interval where a coordinate has no value or no slope.
    pub(super) fn first_gap(&self, interval: [f64; 2]) -> Option<f64> {
        let coordinates = [Some(&self.x), Some(&self.y), self.z.as_ref()];
        let gaps = coordinates.into_iter().flatten();
        let gaps = gaps.filter_map(|it| it.expression.first_gap(interval));
        gaps.min_by(f64::total_cmp)
    }

    /// Expand the coordinates for the series of t.
    pub(super) fn series<T: Argument>(&self, t: &PowerSeries<T>) -> [PowerSeries<T>; 3] {
        let of = |coordinate: &Coordinate| coordinate.expression.series(t);
        let level = || PowerSeries::constant(T::of(0.0), t.order());
        let z = self.z.as_ref().map_or_else(level, of);
        [of(&self.x), of(&self.y), z]
    }
}

impl Coordinate {
    pub(super) fn read(text: &str) -> Result<Self, ReferenceTextError> {
        Ok(Self {
            text: text.to_owned(),
            expression: Box::new(Expression::read(text)?),
        })
    }
}
