//! Parameters of operations: kinds of values, checks, and texts to and from values.

use std::ops::{Bound, RangeInclusive};

use super::amount::Amount;
use super::error::OperationError;
use super::operands::Operands;
use super::value::Value;
use crate::geometry::expressions::{NumberContext, parts};
use crate::geometry::parameters::{self, Limits, Number, Quantity, brief, check_limits};
use crate::geometry::references::ReferenceCurve;

/// A parameter of an operation.
pub type Parameter = parameters::Parameter<Kind>;

/// Text for an empty list: what the operation takes instead, for these operands or for any.
pub(super) type Meaning = fn(Option<&Operands>) -> &'static str;

/// What values a parameter takes.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Whole numbers, with both limits.
    Whole(Number<Amount>),
    /// Finite numbers.
    Real(Number<Amount>),
    /// One of several options.
    Choice {
        /// The options.
        options: &'static [Choice],
        /// Default: an index into the options.
        default: usize,
    },
    /// On or off.
    Switch {
        /// Value if none is given.
        default: bool,
    },
    /// A reference, as [`ReferenceCurve::from_text`] reads it, or none.
    Reference {
        /// Text for no reference.
        none: &'static str,
    },
    /// A list of finite numbers, such as the coordinates of a point, or none.
    List {
        /// Allowed lengths.
        count: RangeInclusive<usize>,
        /// Whether the numbers are whole, from 0 on.
        whole: bool,
        /// Limits of each number.
        limits: Limits,
        /// Quantity of each number.
        quantity: Quantity,
        /// Words that can stand for a list; a value of one of them is its place as a [`Value::Choice`].
        words: &'static [&'static str],
        /// Text for an empty list.
        none: Meaning,
        /// Whether only a curve in space has these values.
        in_space: bool,
    },
}

/// An option of a choice.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    /// Name on the command line.
    pub name: &'static str,
    /// Label in panels.
    pub label: &'static str,
    /// Names of the parameters that count for this option alone.
    pub parameters: &'static [&'static str],
}

impl Choice {
    /// Describe an option without parameters of its own.
    pub(super) const fn new(name: &'static str, label: &'static str) -> Self {
        Self {
            name,
            label,
            parameters: &[],
        }
    }
}

/// Any number.
pub(super) const ANY: Limits = (Bound::Unbounded, Bound::Unbounded);

/// Numbers above 0.
pub(super) const POSITIVE: Limits = (Bound::Excluded(0.0), Bound::Unbounded);

impl Kind {
    /// Whole numbers between two limits.
    pub(super) const fn whole(from: usize, to: usize, default: usize) -> Self {
        let [from, to, default] = [from as f64, to as f64, default as f64];
        Self::whole_of(
            Amount::Number(from),
            Amount::Number(to),
            Amount::Number(default),
        )
    }

    /// Whole numbers between limits that may depend on the operands.
    pub(super) const fn whole_of(from: Amount, to: Amount, default: Amount) -> Self {
        Self::Whole(Number {
            from: Bound::Included(from),
            to: Bound::Included(to),
            default,
            quantity: Quantity::Number,
        })
    }

    /// Plain numbers of any sign in a list of a given length.
    pub(super) const fn list(count: RangeInclusive<usize>, none: Meaning) -> Self {
        Self::List {
            count,
            whole: false,
            limits: ANY,
            quantity: Quantity::Number,
            words: &[],
            none,
            in_space: false,
        }
    }

    /// One number, or none.
    pub(super) const fn optional_number(limits: Limits, none: Meaning) -> Self {
        Self::List {
            count: 1..=1,
            whole: false,
            limits,
            quantity: Quantity::Number,
            words: &[],
            none,
            in_space: false,
        }
    }

    /// One whole number, or none.
    pub(super) const fn optional_count(most: usize, in_space: bool, none: Meaning) -> Self {
        Self::List {
            count: 1..=1,
            whole: true,
            limits: match most {
                usize::MAX => ANY,
                _ => (Bound::Included(0.0), Bound::Included(most as f64)),
            },
            quantity: Quantity::Number,
            words: &[],
            none,
            in_space,
        }
    }

    /// One whole number, or one of some words.
    pub(super) const fn count_or(words: &'static [&'static str], none: Meaning) -> Self {
        Self::List {
            count: 1..=1,
            whole: true,
            limits: ANY,
            quantity: Quantity::Number,
            words,
            none,
            in_space: false,
        }
    }

    /// A point or vector of the plane or of space, or none.
    pub(super) const fn vector(in_space: bool, none: Meaning) -> Self {
        Self::List {
            count: 2..=3,
            whole: false,
            limits: ANY,
            quantity: Quantity::Number,
            words: &[],
            none,
            in_space,
        }
    }
}

impl Parameter {
    /// Find the default for an input.
    ///
    /// # Errors
    /// As [`Amount::of`].
    pub fn default(&self, input: &Operands) -> Result<Value, OperationError> {
        Ok(match self.kind {
            // Defaults of whole numbers are small: no digit is lost.
            Kind::Whole(number) => Value::Whole(number.default.of(input)? as usize),
            Kind::Real(number) => Value::Real(number.default.of(input)?),
            Kind::Choice { default, .. } => Value::Choice(default),
            Kind::Switch { default } => Value::Switch(default),
            Kind::List { .. } => Value::List(Vec::new()),
            Kind::Reference { .. } => Value::Reference(input.reference().cloned().map(Box::new)),
        })
    }

    /// Whether the parameter applies to an input: some apply to curves in space only.
    pub fn applies(&self, input: &Operands) -> bool {
        match self.kind {
            Kind::List { in_space: true, .. } => {
                input.polygon().is_ok_and(|polygon| !polygon.is_planar())
            }
            _ => true,
        }
    }

    /// Find the limits for an input; `None` if the values are no numbers.
    ///
    /// # Errors
    /// As [`Amount::of`].
    pub fn limits(&self, input: &Operands) -> Result<Option<Limits>, OperationError> {
        let of = |bound: Bound<Amount>| {
            Ok::<_, OperationError>(match bound {
                Bound::Included(amount) => Bound::Included(amount.of(input)?),
                Bound::Excluded(amount) => Bound::Excluded(amount.of(input)?),
                Bound::Unbounded => Bound::Unbounded,
            })
        };
        Ok(match self.kind {
            Kind::Whole(number) | Kind::Real(number) => Some((of(number.from)?, of(number.to)?)),
            Kind::List { limits, .. } => Some(limits),
            _ => None,
        })
    }

    /// Refuse a value of another kind, or one that the input does not allow.
    ///
    /// # Errors
    /// [`OperationError::WrongKind`], [`OperationError::OnlyInSpace`], [`OperationError::OutOfRange`],
    /// or as [`Amount::of`].
    pub fn check(&self, value: &Value, input: &Operands) -> Result<(), OperationError> {
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

    /// Read a value as it is typed, angles in degrees, and check the limits that are the same for every
    /// input.
    ///
    /// # Errors
    /// As [`Parameter::check`].
    pub fn read(&self, text: &str) -> Result<Value, OperationError> {
        let text = text.trim();
        let quantity = self.quantity();
        let value = match self.kind {
            Kind::Reference { .. } if text.is_empty() => Some(Value::Reference(None)),
            Kind::Reference { .. } => {
                let curve = ReferenceCurve::from_text(text)?;
                Some(Value::Reference(Some(Box::new(curve))))
            }
            Kind::Whole { .. } => {
                let number = self.number(0, text)?;
                let is_whole = number >= 0.0 && number.fract() == 0.0;
                is_whole.then_some(Value::Whole(number as usize))
            }
            Kind::Real { .. } => Some(Value::Real(quantity.stored(self.number(0, text)?))),
            Kind::Choice { options, .. } => {
                let mut names = options.iter().map(|option| option.name);
                names.position(|name| name == text).map(Value::Choice)
            }
            Kind::Switch { .. } => match text {
                "on" => Some(Value::Switch(true)),
                "off" => Some(Value::Switch(false)),
                _ => None,
            },
            Kind::List { words, .. } if words.contains(&text) => {
                let place = words.iter().position(|word| *word == text);
                place.map(Value::Choice)
            }
            Kind::List { .. } => {
                let parts = parts(text, ',').into_iter().filter(|_| !text.is_empty());
                let numbers =
                    parts.map(|(before, part)| Ok(quantity.stored(self.number(before, part)?)));
                Some(Value::List(numbers.collect::<Result<_, OperationError>>()?))
            }
        };
        let value = value.ok_or_else(|| self.wrong_kind())?;
        self.check_kind(&value)?;
        let fixed = |bound: Bound<Amount>| match bound {
            Bound::Included(Amount::Number(number)) => Bound::Included(number),
            Bound::Excluded(Amount::Number(number)) => Bound::Excluded(number),
            _ => Bound::Unbounded,
        };
        let limits = match self.kind {
            Kind::Whole(number) | Kind::Real(number) => (fixed(number.from), fixed(number.to)),
            Kind::List { limits, .. } => limits,
            _ => ANY,
        };
        self.check_limits(&value, limits)?;
        Ok(value)
    }

    /// Read a value as [`Parameter::read`] does, but refuse an empty list.
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
        match (&self.kind, value) {
            (Kind::Choice { options, .. }, Value::Choice(index)) => options
                .get(*index)
                .map_or_else(String::new, |option| option.name.to_owned()),
            (Kind::List { words, .. }, Value::Choice(index)) => {
                words.get(*index).copied().unwrap_or_default().to_owned()
            }
            _ => value.text(self.quantity()),
        }
    }

    /// The quantity of its numbers.
    pub fn quantity(&self) -> Quantity {
        match self.kind {
            Kind::Real(number) => number.quantity,
            Kind::List { quantity, .. } => quantity,
            _ => Quantity::Number,
        }
    }

    /// Describe the values in words, for any input: "a whole number, 1 to the degree − 1".
    pub fn range_words(&self) -> String {
        let text = |amount: &Amount| self.amount_text(*amount);
        match &self.kind {
            Kind::Whole(number) => number.words("a whole number", text),
            Kind::Real(number) => number.words(number.quantity.noun(), text),
            Kind::Choice { options, .. } => {
                let names: Vec<&str> = options.iter().map(|option| option.name).collect();
                names.join(" or ")
            }
            Kind::Switch { .. } => "on or off".to_owned(),
            Kind::List {
                count,
                whole,
                words,
                ..
            } => {
                let words = words.iter().map(|word| (*word).to_owned());
                let all: Vec<String> = words.chain([self.list_words(count, *whole)]).collect();
                all.join(", or ")
            }
            Kind::Reference { .. } => {
                "a reference, such as circle:radius=10 or formula:x=…;y=…".to_owned()
            }
        }
    }

    /// Describe the default in words.
    pub fn default_words(&self) -> String {
        match self.kind {
            Kind::Whole(number) | Kind::Real(number) => self.amount_text(number.default),
            Kind::Choice { default, .. } => self.text(&Value::Choice(default)),
            Kind::Switch { default } => self.text(&Value::Switch(default)),
            Kind::List { none, .. } => none(None).to_owned(),
            Kind::Reference { none } => none.to_owned(),
        }
    }

    /// Describe the lists in words: "2 or 3 numbers, separated by commas".
    fn list_words(&self, count: &RangeInclusive<usize>, whole: bool) -> String {
        let (one, several) = match (whole, self.quantity()) {
            (true, _) => ("a whole number", "whole numbers"),
            (false, Quantity::Parameter) => ("a parameter u", "parameters u"),
            _ => ("a number", "numbers"),
        };
        match (*count.start(), *count.end()) {
            (1, 1) => one.to_owned(),
            (_, usize::MAX) => format!("{several}, separated by commas"),
            (least, most) if least == most => format!("{least} {several}, separated by commas"),
            (least, most) => format!("{least} or {most} {several}, separated by commas"),
        }
    }

    fn amount_text(&self, amount: Amount) -> String {
        match amount {
            Amount::Number(number) => brief(self.quantity().shown(number)),
            amount => amount.to_string(),
        }
    }

    fn check_kind(&self, value: &Value) -> Result<(), OperationError> {
        let fits = match (&self.kind, value) {
            (Kind::Whole(_), Value::Whole(_))
            | (Kind::Switch { .. }, Value::Switch(_))
            | (Kind::Reference { .. }, Value::Reference(_)) => true,
            (Kind::Real(_), Value::Real(number)) => number.is_finite(),
            (Kind::Choice { options, .. }, Value::Choice(index)) => *index < options.len(),
            (Kind::List { count, whole, .. }, Value::List(numbers)) => {
                let fits = |number: &f64| {
                    let counts = *number >= 0.0 && number.fract() == 0.0;
                    number.is_finite() && (!*whole || counts)
                };
                let given = numbers.is_empty() || count.contains(&numbers.len());
                given && numbers.iter().all(fits)
            }
            (Kind::List { words, .. }, Value::Choice(index)) => *index < words.len(),
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

    /// Read a number or an expression; `before` characters stand before it.
    fn number(&self, before: usize, text: &str) -> Result<f64, OperationError> {
        let context = NumberContext {
            quantity: self.quantity(),
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
        let whole;
        let numbers = match value {
            Value::Whole(number) => {
                whole = *number as f64;
                std::slice::from_ref(&whole)
            }
            Value::Real(number) => std::slice::from_ref(number),
            Value::List(numbers) => numbers,
            _ => &[],
        };
        for number in numbers {
            check_limits(self.label, *number, limits, self.quantity())?;
        }
        Ok(())
    }
}
