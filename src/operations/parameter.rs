//! A parameter of an operation, described once.

use std::fmt::Display;
use std::ops::{Bound, RangeInclusive};

use super::amount::Amount;
use super::error::OperationError;
use super::input::Input;
use super::value::Value;
use crate::geometry::expressions::{NumberContext, Quantity, parts};
use crate::geometry::references::ReferenceCurve;

/// Describe a parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// What the command line calls it.
    pub name: &'static str,
    /// What the panel calls it.
    pub label: &'static str,
    /// What it does, in one line.
    pub help: &'static str,
    /// What values it takes.
    pub kind: Kind,
}

/// What values a parameter takes.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Whole numbers.
    Whole {
        /// The smallest that is allowed.
        from: Amount,
        /// The largest that is allowed.
        to: Amount,
        /// What it is if it is not given.
        default: Amount,
    },
    /// Finite numbers.
    Real {
        /// Where those begin that are allowed.
        from: Bound<Amount>,
        /// Where they end.
        to: Bound<Amount>,
        /// What it is if it is not given.
        default: Amount,
        /// The unit.
        unit: Unit,
    },
    /// One of several words.
    Choice {
        /// The words.
        options: &'static [Choice],
        /// Which one it is if it is not given, counted from 0.
        default: usize,
    },
    /// On or off.
    Switch {
        /// What it is if it is not given.
        default: bool,
    },
    /// A reference, as [`ReferenceCurve::from_text`] reads it, or none.
    Reference {
        /// What it means if none is given.
        none: &'static str,
    },
    /// Some finite numbers, such as the coordinates of a point, or none.
    List {
        /// How many there can be.
        count: RangeInclusive<usize>,
        /// Whether they are whole numbers from 0 on.
        whole: bool,
        /// Their unit.
        unit: Unit,
        /// What it means if none is given: for an input, or whatever the input is.
        none: fn(Option<&Input>) -> &'static str,
        /// Whether only a curve in space has what they tell.
        in_space: bool,
    },
}

/// A word that can be chosen.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    /// What the command line calls it.
    pub name: &'static str,
    /// What the panel calls it.
    pub label: &'static str,
    /// The names of those parameters of the operation that count for this word alone.
    pub parameters: &'static [&'static str],
}

/// The numbers that a parameter allows for one input.
pub type Limits = (Bound<f64>, Bound<f64>);

/// The unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A mere number.
    None,
    /// A length, in the units of the coordinates.
    Length,
    /// An angle: in radians, written in degrees.
    Angle,
    /// A parameter u of a curve.
    Parameter,
}

impl Parameter {
    /// What it is for an input if it is not given.
    ///
    /// # Errors
    /// As [`Amount::of`].
    pub fn default(&self, input: &Input) -> Result<Value, OperationError> {
        Ok(match self.kind {
            // Defaults of whole numbers are small: no digit is lost.
            Kind::Whole { default, .. } => Value::Whole(default.of(input)? as usize),
            Kind::Real { default, .. } => Value::Real(default.of(input)?),
            Kind::Choice { default, .. } => Value::Choice(default),
            Kind::Switch { default } => Value::Switch(default),
            Kind::List { .. } => Value::List(Vec::new()),
            Kind::Reference { .. } => Value::Reference(input.reference().cloned().map(Box::new)),
        })
    }

    /// Whether there is something to give for an input: a planar curve has nothing that only curves in
    /// space have.
    pub fn applies(&self, input: &Input) -> bool {
        match self.kind {
            Kind::List { in_space: true, .. } => {
                input.polygon().is_ok_and(|polygon| !polygon.is_planar())
            }
            _ => true,
        }
    }

    /// The numbers that are allowed for an input; `None` if the values are no numbers.
    ///
    /// # Errors
    /// As [`Amount::of`].
    pub fn limits(&self, input: &Input) -> Result<Option<Limits>, OperationError> {
        let Some((from, to)) = self.range() else {
            return Ok(None);
        };
        let of = |bound: Bound<Amount>| {
            Ok::<_, OperationError>(match bound {
                Bound::Included(amount) => Bound::Included(amount.of(input)?),
                Bound::Excluded(amount) => Bound::Excluded(amount.of(input)?),
                Bound::Unbounded => Bound::Unbounded,
            })
        };
        Ok(Some((of(from)?, of(to)?)))
    }

    /// Refuse a value that is of another kind, or not allowed for an input.
    ///
    /// # Errors
    /// [`OperationError::WrongKind`], [`OperationError::OnlyInSpace`], [`OperationError::OutOfRange`],
    /// or as [`Amount::of`].
    pub fn check(&self, value: &Value, input: &Input) -> Result<(), OperationError> {
        self.check_kind(value)?;
        let is_given = *value != Value::List(Vec::new());
        if is_given && !self.applies(input) {
            let label = self.label;
            return Err(OperationError::OnlyInSpace { label });
        }
        match self.limits(input)? {
            Some(limits) => self.check_limits(value, limits),
            None => Ok(()),
        }
    }

    /// Read a value as it is typed, angles in degrees. Of the limits those are checked that are the
    /// same for every input.
    ///
    /// # Errors
    /// As [`Parameter::check`].
    pub fn read(&self, text: &str) -> Result<Value, OperationError> {
        let text = text.trim();
        let value = match self.kind {
            Kind::Reference { .. } if text.is_empty() => Some(Value::Reference(None)),
            Kind::Reference { .. } => {
                let curve = ReferenceCurve::from_text(text)?;
                Some(Value::Reference(Some(Box::new(curve))))
            }
            Kind::Whole { .. } => text.parse().ok().map(Value::Whole),
            Kind::Real { unit, .. } => Some(Value::Real(unit.typed(self.number(0, text)?))),
            Kind::Choice { options, .. } => {
                let mut names = options.iter().map(|option| option.name);
                names.position(|name| name == text).map(Value::Choice)
            }
            Kind::Switch { .. } => match text {
                "on" => Some(Value::Switch(true)),
                "off" => Some(Value::Switch(false)),
                _ => None,
            },
            Kind::List { unit, .. } => {
                let parts = parts(text, ',').into_iter().filter(|_| !text.is_empty());
                let numbers = parts.map(|(before, part)| self.number(before, part));
                let numbers = numbers.map(|number| number.map(|number| unit.typed(number)));
                Some(Value::List(numbers.collect::<Result<_, _>>()?))
            }
        };
        let value = value.ok_or_else(|| self.wrong_kind())?;
        self.check_kind(&value)?;
        let fixed = |bound: Bound<Amount>| match bound {
            Bound::Included(Amount::Number(number)) => Bound::Included(number),
            Bound::Excluded(Amount::Number(number)) => Bound::Excluded(number),
            _ => Bound::Unbounded,
        };
        if let Some((from, to)) = self.range() {
            self.check_limits(&value, (fixed(from), fixed(to)))?;
        }
        Ok(value)
    }

    /// Read a value as [`Parameter::read`] does, but no empty list: what is not wanted is not given.
    ///
    /// # Errors
    /// As [`Parameter::read`].
    pub fn read_given(&self, text: &str) -> Result<Value, OperationError> {
        match self.read(text)? {
            Value::List(numbers) if numbers.is_empty() => Err(self.wrong_kind()),
            value => Ok(value),
        }
    }

    /// Write a value as [`Parameter::read`] reads it.
    pub fn text(&self, value: &Value) -> String {
        let shown = |number: &f64| self.unit().shown(*number).to_string();
        match (&self.kind, value) {
            (Kind::Choice { options, .. }, Value::Choice(index)) => options
                .get(*index)
                .map_or_else(String::new, |option| option.name.to_owned()),
            (_, Value::Whole(number)) => number.to_string(),
            (_, Value::Real(number)) => shown(number),
            (_, Value::Choice(index)) => index.to_string(),
            (_, Value::Switch(on)) => if *on { "on" } else { "off" }.to_owned(),
            (_, Value::Reference(reference)) => {
                let text = reference.as_ref().map(|reference| reference.to_string());
                text.unwrap_or_default()
            }
            (_, Value::List(numbers)) => joined(numbers.iter().map(shown)),
            (_, Value::Indices(indices)) => joined(indices.iter().map(usize::to_string)),
            (_, Value::Ends(ends)) => joined(ends.iter().map(|end| end.name().to_owned())),
        }
    }

    /// The unit of its numbers.
    pub fn unit(&self) -> Unit {
        match self.kind {
            Kind::Real { unit, .. } | Kind::List { unit, .. } => unit,
            Kind::Whole { .. }
            | Kind::Choice { .. }
            | Kind::Switch { .. }
            | Kind::Reference { .. } => Unit::None,
        }
    }

    /// Say which values it takes, for any input: "a whole number, 1 to the degree − 1".
    pub fn range_words(&self) -> String {
        let noun = match self.kind {
            Kind::Whole { .. } => "a whole number",
            Kind::Real { .. } => self.unit().noun(),
            Kind::Choice { options, .. } => {
                let names: Vec<&str> = options.iter().map(|option| option.name).collect();
                return names.join(" or ");
            }
            Kind::Switch { .. } => return "on or off".to_owned(),
            Kind::List { .. } => return self.list_words(),
            Kind::Reference { .. } => {
                return "a reference, such as circle:radius=10 or formula:x=…;y=…".to_owned();
            }
        };
        let words = self.range().map(|(from, to)| {
            let words = |amount: Amount| self.amount_words(amount);
            bounds_words(from.map(words), to.map(words))
        });
        match words.flatten() {
            Some(words) => format!("{noun}, {words}"),
            None => noun.to_owned(),
        }
    }

    /// Say what it is if it is not given.
    pub fn default_words(&self) -> String {
        match self.kind {
            Kind::Whole { default, .. } | Kind::Real { default, .. } => self.amount_words(default),
            Kind::Choice { default, .. } => self.text(&Value::Choice(default)),
            Kind::Switch { default } => self.text(&Value::Switch(default)),
            Kind::List { none, .. } => none(None).to_owned(),
            Kind::Reference { none } => none.to_owned(),
        }
    }

    /// Say which lists it takes: "2 or 3 numbers, separated by commas".
    fn list_words(&self) -> String {
        let Kind::List {
            count, whole, unit, ..
        } = &self.kind
        else {
            return String::new();
        };
        let (least, most) = (*count.start(), *count.end());
        let noun = match (*whole, *unit) {
            (true, _) => ("a whole number", "whole numbers"),
            (false, Unit::Parameter) => ("a parameter u", "parameters u"),
            _ => ("a number", "numbers"),
        };
        let (one, several) = noun;
        match (least, most) {
            (1, 1) => one.to_owned(),
            (_, usize::MAX) => format!("{several}, separated by commas"),
            (least, most) if least == most => format!("{least} {several}, separated by commas"),
            (least, most) => format!("{least} or {most} {several}, separated by commas"),
        }
    }

    fn amount_words(&self, amount: Amount) -> String {
        match amount {
            Amount::Number(number) => self.text(&Value::Real(number)),
            amount => amount.to_string(),
        }
    }

    fn range(&self) -> Option<(Bound<Amount>, Bound<Amount>)> {
        match self.kind {
            Kind::Whole { from, to, .. } => Some((Bound::Included(from), Bound::Included(to))),
            Kind::Real { from, to, .. } => Some((from, to)),
            Kind::Choice { .. }
            | Kind::Switch { .. }
            | Kind::List { .. }
            | Kind::Reference { .. } => None,
        }
    }

    fn check_kind(&self, value: &Value) -> Result<(), OperationError> {
        let fits = match (&self.kind, value) {
            (Kind::Whole { .. }, Value::Whole(_))
            | (Kind::Switch { .. }, Value::Switch(_))
            | (Kind::Reference { .. }, Value::Reference(_)) => true,
            (Kind::Real { .. }, Value::Real(number)) => number.is_finite(),
            (Kind::Choice { options, .. }, Value::Choice(index)) => *index < options.len(),
            (Kind::List { count, whole, .. }, Value::List(numbers)) => {
                let fits = |number: &f64| {
                    let counts = *number >= 0.0 && number.fract() == 0.0;
                    number.is_finite() && (!*whole || counts)
                };
                let given = numbers.is_empty() || count.contains(&numbers.len());
                given && numbers.iter().all(fits)
            }
            _ => false,
        };
        if fits { Ok(()) } else { Err(self.wrong_kind()) }
    }

    fn wrong_kind(&self) -> OperationError {
        OperationError::WrongKind {
            label: self.label,
            needed: self.range_words(),
            verb: self.verb(),
        }
    }

    /// Whether what it takes "is" or "are".
    fn verb(&self) -> &'static str {
        match &self.kind {
            Kind::List { count, .. } if *count.end() > 1 => "are",
            _ => "is",
        }
    }

    /// Read a number, which may be an expression; so many characters stand before it.
    fn number(&self, before: usize, text: &str) -> Result<f64, OperationError> {
        let context = NumberContext {
            quantity: self.unit().quantity(),
            ..NumberContext::default()
        };
        context
            .read(text)
            .map_err(|mistake| OperationError::NotANumber {
                label: self.label,
                needed: self.range_words(),
                verb: self.verb(),
                mistake: Box::new(mistake.shifted(before)),
            })
    }

    fn check_limits(&self, value: &Value, limits: Limits) -> Result<(), OperationError> {
        use std::ops::RangeBounds;
        let number = match value {
            Value::Whole(number) => *number as f64,
            Value::Real(number) => *number,
            Value::Choice(_)
            | Value::Switch(_)
            | Value::List(_)
            | Value::Indices(_)
            | Value::Ends(_)
            | Value::Reference(_) => return Ok(()),
        };
        if limits.contains(&number) {
            return Ok(());
        }
        let words = |number: f64| self.text(&Value::Real(number));
        let needed = bounds_words(limits.0.map(words), limits.1.map(words));
        Err(OperationError::OutOfRange {
            label: self.label,
            value: self.text(value),
            needed: needed.unwrap_or_else(|| self.range_words()),
        })
    }
}

impl Unit {
    /// The number that is shown for one in this unit: angles in degrees.
    pub fn shown(self, number: f64) -> f64 {
        match self {
            Self::Angle => number.to_degrees(),
            Self::None | Self::Length | Self::Parameter => number,
        }
    }

    /// The number in this unit that is meant by one that is typed.
    pub fn typed(self, shown: f64) -> f64 {
        match self {
            Self::Angle => shown.to_radians(),
            Self::None | Self::Length | Self::Parameter => shown,
        }
    }

    /// What numbers in this unit measure.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::None | Self::Parameter => Quantity::Number,
            Self::Length => Quantity::Length,
            Self::Angle => Quantity::Angle,
        }
    }

    fn noun(self) -> &'static str {
        match self {
            Self::None => "a number",
            Self::Length => "a length",
            Self::Angle => "an angle in degrees",
            Self::Parameter => "a parameter u",
        }
    }
}

/// Say where numbers begin and end; `None` if they do neither.
fn bounds_words(from: Bound<impl Display>, to: Bound<impl Display>) -> Option<String> {
    use Bound::{Excluded, Included, Unbounded};
    Some(match (from, to) {
        (Included(from), Included(to)) => format!("{from} to {to}"),
        (Excluded(from), Excluded(to)) => format!("more than {from} and less than {to}"),
        (Included(from), Excluded(to)) => format!("at least {from} and less than {to}"),
        (Excluded(from), Included(to)) => format!("more than {from} and at most {to}"),
        (Included(from), Unbounded) => format!("at least {from}"),
        (Excluded(from), Unbounded) => format!("more than {from}"),
        (Unbounded, Included(to)) => format!("at most {to}"),
        (Unbounded, Excluded(to)) => format!("less than {to}"),
        (Unbounded, Unbounded) => return None,
    })
}

fn joined(numbers: impl Iterator<Item = String>) -> String {
    numbers.collect::<Vec<_>>().join(", ")
}
