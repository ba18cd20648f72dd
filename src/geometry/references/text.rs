//! References as text: `circle:radius=10`, `log-aesthetic:alpha=-1,lambda=0.5,from=0,to=1`.

use std::fmt;

use super::curve::ReferenceCurve;
use super::error::{ReferenceError, ReferenceTextError};
use super::form::{AnalyticForm, ReferenceForm};
use super::kind::ReferenceKind;
use super::placement::Placement;
use super::{KINDS, find};

/// The names that give the interval of t.
const INTERVAL: [&str; 2] = ["from", "to"];

impl ReferenceCurve {
    /// Read a reference: a kind's name and, after a colon, values of its parameters, separated by
    /// commas; `from` and `to` give the interval of t. What is not given has its default. It lies
    /// where its formula puts it.
    ///
    /// # Errors
    /// [`ReferenceTextError`] names the column where the mistake begins.
    pub fn from_text(text: &str) -> Result<Self, ReferenceTextError> {
        let whole = Part::whole(text);
        let (name, rest) = whole.split_once(':');
        let name = name.trimmed();
        let kind = find(name.text).ok_or_else(|| {
            name.error(ReferenceError::NoSuchKind {
                name: name.text.to_owned(),
                known: list(KINDS.iter().map(|kind| kind.name)),
            })
        })?;
        let assignments = rest.map_or(Ok(Vec::new()), |rest| rest.assignments(','))?;
        let (form, interval) = analytic(kind, &assignments)?;
        let default = form.default_interval();
        let [from, to] = [0, 1].map(|end: usize| interval[end].unwrap_or(default[end]));
        Self::new(form, [from, to], Placement::default()).map_err(|error| whole.error(error))
    }
}

impl fmt::Display for ReferenceCurve {
    /// Write the reference as [`ReferenceCurve::from_text`] reads it, apart from its placement; points
    /// have no text but their number.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let form = match self.form() {
            ReferenceForm::Analytic(form) => form,
            ReferenceForm::Points(points) => {
                return write!(formatter, "{} points", points.points().len());
            }
        };
        formatter.write_str(form.kind().name)?;
        let parameters = form.kind().parameters.iter().map(|it| it.name);
        let given = parameters.zip(form.values().iter().copied());
        let interval = self.interval();
        let given = given.chain(INTERVAL.into_iter().zip(interval));
        for (index, (name, value)) in given.enumerate() {
            let separator = if index == 0 { ':' } else { ',' };
            write!(formatter, "{separator}{name}={value}")?;
        }
        Ok(())
    }
}

/// Read the values of a kind, and the ends of the interval that are given.
fn analytic(
    kind: &'static ReferenceKind,
    assignments: &[Assignment<'_>],
) -> Result<(ReferenceForm, [Option<f64>; 2]), ReferenceTextError> {
    let mut values = kind.defaults();
    let mut interval = [None; 2];
    for Assignment { name, value } in assignments {
        let number = value.number()?;
        if let Some(end) = INTERVAL.iter().position(|known| *known == name.text) {
            interval[end] = Some(number);
            continue;
        }
        let mut parameters = kind.parameters.iter();
        let Some(index) = parameters.position(|it| it.name == name.text) else {
            let known = kind.parameters.iter().map(|it| it.name);
            return Err(name.error(ReferenceError::NoSuchParameter {
                kind: kind.name,
                name: name.text.to_owned(),
                known: list(known.chain(INTERVAL)),
            }));
        };
        let checked = kind.parameters[index].check(number);
        checked.map_err(|error| value.error(error))?;
        values[index] = number;
    }
    // Every value is checked already.
    let form =
        AnalyticForm::new(kind, values).map_err(|error| ReferenceTextError { column: 1, error })?;
    Ok((ReferenceForm::Analytic(form), interval))
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
        let mut rest = Some(*self);
        while let Some(text) = rest {
            let (part, next) = text.split_once(separator);
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
            rest = next;
        }
        Ok(assignments)
    }

    fn number(&self) -> Result<f64, ReferenceTextError> {
        let number = self.text.parse().ok().filter(|it: &f64| it.is_finite());
        number.ok_or_else(|| {
            self.error(ReferenceError::NotANumber {
                text: self.text.to_owned(),
            })
        })
    }
}

fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}
