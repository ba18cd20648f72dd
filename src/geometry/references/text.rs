//! References as text: `circle:radius=10`, `log-aesthetic:alpha=-1,lambda=0.5,from=0,to=1`.

use std::fmt;

use super::curve::ReferenceCurve;
use super::error::{ReferenceError, ReferenceTextError};
use super::form::{AnalyticForm, ReferenceForm};
use super::formula::{Coordinate, Formula};
use super::kind::ReferenceKind;
use super::placement::Placement;
use super::{KINDS, find};
use crate::geometry::expressions::{self, Expression, ExpressionError, NoNumber};

/// Prefix of formulas.
const FORMULA: &str = "formula";

/// The names of coordinates.
const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// The names that give the interval of t.
const INTERVAL: [&str; 2] = ["from", "to"];

impl ReferenceCurve {
    /// Whether a text begins as a reference does, with the name of a kind or `formula`.
    pub fn is_text(text: &str) -> bool {
        let name = Part::whole(text).split_once(':').0.trimmed().text;
        name == FORMULA || find(name).is_some()
    }

    /// Read a reference: a kind's name and, after a colon, values of its parameters, separated by
    /// commas; or `formula:x=…;y=…;z=…` with expressions in t, without z in the plane. `from` and `to`
    /// give the interval of t. Numbers can be expressions without t. What is not given has its default.
    /// It lies where its formula puts it.
    ///
    /// # Errors
    /// [`ReferenceTextError`] names the column where the mistake begins.
    pub fn from_text(text: &str) -> Result<Self, ReferenceTextError> {
        Self::from_text_over(text, [None; 2])
    }

    /// Read a reference as [`ReferenceCurve::from_text`] does; ends of the interval that the text does not
    /// give are the `other` ones, where there are any.
    ///
    /// # Errors
    /// As [`ReferenceCurve::from_text`].
    pub fn from_text_over(text: &str, other: [Option<f64>; 2]) -> Result<Self, ReferenceTextError> {
        let whole = Part::whole(text);
        let (name, rest) = whole.split_once(':');
        let name = name.trimmed();
        let assignments =
            |separator| rest.map_or(Ok(Vec::new()), |rest: Part| rest.assignments(separator));
        let (form, interval) = if name.text == FORMULA {
            formula(&whole, &assignments(';')?)?
        } else {
            let kind = find(name.text).ok_or_else(|| {
                let kinds = KINDS.iter().map(|kind| kind.name);
                name.error(ReferenceError::NoSuchKind {
                    name: name.text.to_owned(),
                    known: list(kinds.chain([FORMULA])),
                })
            })?;
            analytic(kind, &assignments(',')?)?
        };
        let default = form.default_interval();
        let [from, to] =
            [0, 1].map(|end: usize| interval[end].or(other[end]).unwrap_or(default[end]));
        Self::new(form, [from, to], Placement::default()).map_err(|error| whole.error(error))
    }
}

impl fmt::Display for ReferenceCurve {
    /// Write the reference as [`ReferenceCurve::from_text`] reads it, apart from its placement; points
    /// and B-splines have no text but their numbers.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let interval = INTERVAL.into_iter().zip(self.interval());
        let interval = interval.map(|(name, value)| format!("{name}={value}"));
        let (name, given, separator) = match self.form() {
            ReferenceForm::Analytic(form) => {
                let parameters = form.kind().parameters.iter().zip(form.values());
                let given = parameters.map(|(it, value)| format!("{}={value}", it.name));
                (form.kind().name, given.collect::<Vec<_>>(), ",")
            }
            ReferenceForm::Formula(formula) => {
                let texts = COORDINATES.into_iter().zip(formula.texts());
                let given = texts.filter_map(|(name, text)| Some(format!("{name}={}", text?)));
                (FORMULA, given.collect(), ";")
            }
            ReferenceForm::Points(points) => {
                return write!(formatter, "{} points", points.points().len());
            }
            ReferenceForm::Nurbs(nurbs) => {
                let (degree, points) = (nurbs.degree(), nurbs.points().len());
                return write!(formatter, "NURBS of degree {degree} with {points} points");
            }
            ReferenceForm::Frame(frame) => {
                let size = frame.size();
                return write!(formatter, "picture {} x {}", size.x, size.y);
            }
        };
        let given: Vec<String> = given.into_iter().chain(interval).collect();
        write!(formatter, "{name}:{}", given.join(separator))
    }
}

/// Read the values of a kind, and the ends of the interval that are given.
fn analytic(
    kind: &'static ReferenceKind,
    assignments: &[Assignment<'_>],
) -> Result<(ReferenceForm, [Option<f64>; 2]), ReferenceTextError> {
    let mut values = kind.defaults();
    let names: Vec<&str> = kind.parameters.iter().map(|it| it.name).collect();
    let interval = assigned(kind.name, &names, assignments, |index, value| {
        let (number, parameter) = (value.number()?, &kind.parameters[index]);
        let checked = parameter.kind.check(parameter.label, number);
        checked.map_err(|error| value.error(error.into()))?;
        values[index] = number;
        Ok(())
    })?;
    // Every value is checked already.
    let form =
        AnalyticForm::new(kind, values).map_err(|error| ReferenceTextError { column: 1, error })?;
    Ok((ReferenceForm::Analytic(form), interval))
}

/// Take the values of known names, by the index of the name, and the ends of the interval that are given.
fn assigned(
    kind: &'static str,
    names: &[&str],
    assignments: &[Assignment<'_>],
    mut take: impl FnMut(usize, &Part<'_>) -> Result<(), ReferenceTextError>,
) -> Result<[Option<f64>; 2], ReferenceTextError> {
    let mut interval = [None; 2];
    for Assignment { name, value } in assignments {
        let position = |known: &[&str]| known.iter().position(|it| *it == name.text);
        if let Some(end) = position(&INTERVAL) {
            interval[end] = Some(value.number()?);
        } else if let Some(index) = position(names) {
            take(index, value)?;
        } else {
            return Err(name.error(ReferenceError::NoSuchParameter {
                kind,
                name: name.text.to_owned(),
                known: list(names.iter().copied().chain(INTERVAL)),
            }));
        }
    }
    Ok(interval)
}

/// Read formulas, and the ends of the interval that are given.
fn formula(
    whole: &Part<'_>,
    assignments: &[Assignment<'_>],
) -> Result<(ReferenceForm, [Option<f64>; 2]), ReferenceTextError> {
    let mut coordinates: [Option<Coordinate>; 3] = [None, None, None];
    let interval = assigned(FORMULA, &COORDINATES, assignments, |index, value| {
        let coordinate = Coordinate::read(value.text).map_err(|mistake| value.shifted(mistake))?;
        coordinates[index] = Some(coordinate);
        Ok(())
    })?;
    let missing = |coordinate| whole.error(ReferenceError::NoCoordinate { coordinate });
    let [x, y, z] = coordinates;
    let x = x.ok_or_else(|| missing("x"))?;
    let y = y.ok_or_else(|| missing("y"))?;
    Ok((ReferenceForm::Formula(Formula { x, y, z }), interval))
}

/// A part of a text that knows where it stands.
#[derive(Clone, Copy)]
struct Part<'a> {
    text: &'a str,
    /// The number of characters before it.
    before: usize,
}

/// A part `name=value`.
struct Assignment<'a> {
    name: Part<'a>,
    value: Part<'a>,
}

impl<'a> Part<'a> {
    fn whole(text: &'a str) -> Self {
        Self { text, before: 0 }
    }

    fn error(&self, error: ReferenceError) -> ReferenceTextError {
        let column = self.before + 1;
        ReferenceTextError { column, error }
    }

    /// The part from a byte of it on.
    fn from(&self, byte: usize) -> Self {
        Self {
            text: &self.text[byte..],
            before: self.before + self.text[..byte].chars().count(),
        }
    }

    fn split_once(&self, separator: char) -> (Self, Option<Self>) {
        match self.text.split_once(separator) {
            Some((first, rest)) => {
                let start = self.text.len() - rest.len();
                let first = Self {
                    text: first,
                    before: self.before,
                };
                (first, Some(self.from(start)))
            }
            None => (*self, None),
        }
    }

    fn trimmed(&self) -> Self {
        let start = self.text.len() - self.text.trim_start().len();
        let part = self.from(start);
        Self {
            text: part.text.trim_end(),
            ..part
        }
    }

    fn assignments(&self, separator: char) -> Result<Vec<Assignment<'a>>, ReferenceTextError> {
        let mut assignments: Vec<Assignment<'a>> = Vec::new();
        for (before, text) in expressions::parts(self.text, separator) {
            let part = Self {
                text,
                before: self.before + before,
            };
            let part = part.trimmed();
            let (name, value) = part.split_once('=');
            let name = name.trimmed();
            let Some(value) = value.filter(|_| !name.text.is_empty()) else {
                let text = part.text.to_owned();
                return Err(part.error(ReferenceError::NoAssignment { text }));
            };
            if assignments.iter().any(|known| known.name.text == name.text) {
                let given = name.text.to_owned();
                return Err(name.error(ReferenceError::Twice { name: given }));
            }
            let value = value.trimmed();
            assignments.push(Assignment { name, value });
        }
        Ok(assignments)
    }

    /// A mistake in this part as one of the whole text.
    fn shifted(&self, mistake: ReferenceTextError) -> ReferenceTextError {
        ReferenceTextError {
            column: self.before + mistake.column,
            ..mistake
        }
    }

    fn number(&self) -> Result<f64, ReferenceTextError> {
        let text = || self.text.to_owned();
        let mut divides_by_zero = false;
        let number: f64 = match self.text.parse() {
            Ok(number) => number,
            Err(_) => {
                let read = Expression::read(self.text);
                let expression = read.map_err(|mistake| self.shifted(mistake.into()))?;
                if expression.depends_on_parameter() {
                    return Err(self.error(ReferenceError::NotConstant { text: text() }));
                }
                divides_by_zero = expression.divides_by_zero();
                expression.value()
            }
        };
        if number.is_finite() {
            return Ok(number);
        }
        let reason = NoNumber::of(number, divides_by_zero);
        let text = text();
        Err(self.error(ExpressionError::NotANumber { text, reason }.into()))
    }
}

fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}
