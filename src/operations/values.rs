//! Checked values of an operation's parameters.

use super::error::OperationError;
use super::operands::Operands;
use super::parameter::{Kind, Parameter};
use super::value::Value;
use crate::geometry::references::ReferenceCurve;

/// Hold a value for every parameter of an operation, each in range for the input that they were
/// checked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Values(Vec<(&'static str, Value)>);

impl Values {
    /// Check values given by names; what is not given has its default.
    ///
    /// # Errors
    /// [`OperationError`] if a parameter does not exist or its value is not in range.
    pub(super) fn new<'a>(
        parameters: &[Parameter],
        input: &Operands,
        given: impl IntoIterator<Item = (&'a str, Value)>,
    ) -> Result<Self, OperationError> {
        let mut values = parameters
            .iter()
            .map(|parameter| Ok((parameter.name, parameter.default(input)?)))
            .collect::<Result<Vec<_>, OperationError>>()?;
        for (name, value) in given {
            let known = values.iter_mut().find(|(known, _)| *known == name);
            let (_, known) = known.ok_or_else(|| OperationError::NoSuchParameter {
                name: name.to_owned(),
            })?;
            *known = value;
        }
        for (parameter, (_, value)) in parameters.iter().zip(&values) {
            parameter.check(value, input)?;
        }
        Ok(Self(values))
    }

    /// The value of a parameter.
    ///
    /// # Panics
    /// If it is no parameter of the operation that the values were checked for.
    pub fn get(&self, parameter: &Parameter) -> &Value {
        let mut values = self.0.iter();
        match values.find(|(name, _)| *name == parameter.name) {
            Some((_, value)) => value,
            None => panic!("“{}” is no parameter of this operation", parameter.name),
        }
    }

    /// The value of a parameter that takes whole numbers.
    ///
    /// # Panics
    /// As [`Values::get`], and if the parameter takes something else.
    pub(super) fn whole(&self, parameter: &Parameter) -> usize {
        match self.get(parameter) {
            Value::Whole(number) => *number,
            other => panic!("“{}” is {other:?}, no whole number", parameter.name),
        }
    }

    /// The value of a parameter that takes numbers.
    ///
    /// # Panics
    /// As [`Values::whole`].
    pub(super) fn real(&self, parameter: &Parameter) -> f64 {
        match self.get(parameter) {
            Value::Real(number) => *number,
            other => panic!("“{}” is {other:?}, no number", parameter.name),
        }
    }

    /// Whether a parameter that is on or off is on.
    ///
    /// # Panics
    /// As [`Values::whole`].
    pub(super) fn switch(&self, parameter: &Parameter) -> bool {
        match self.get(parameter) {
            Value::Switch(on) => *on,
            other => panic!("“{}” is {other:?}, neither on nor off", parameter.name),
        }
    }

    /// What the chosen option of a parameter means; `meanings` are in the order of its options.
    ///
    /// # Panics
    /// As [`Values::whole`], and if there are more options than meanings.
    pub(super) fn choice<T: Copy>(&self, parameter: &Parameter, meanings: &[T]) -> T {
        match self.get(parameter) {
            Value::Choice(index) => meanings[*index],
            other => panic!("“{}” is {other:?}, no option", parameter.name),
        }
    }

    /// The reference of a parameter that takes one.
    ///
    /// # Panics
    /// As [`Values::whole`].
    pub(super) fn reference(&self, parameter: &Parameter) -> Option<&ReferenceCurve> {
        match self.get(parameter) {
            Value::Reference(reference) => reference.as_deref(),
            other => panic!("“{}” is {other:?}, no reference", parameter.name),
        }
    }

    /// The reference that was given for any parameter, if one was.
    pub fn given_reference(&self) -> Option<&ReferenceCurve> {
        self.0.iter().find_map(|(_, value)| match value {
            Value::Reference(reference) => reference.as_deref(),
            _ => None,
        })
    }

    /// The word of a parameter that takes lists or words, if it has one.
    pub(super) fn word(&self, parameter: &Parameter) -> Option<&'static str> {
        match (&parameter.kind, self.get(parameter)) {
            (Kind::List { words, .. }, Value::Choice(index)) => words.get(*index).copied(),
            _ => None,
        }
    }

    /// The numbers of a parameter that takes lists; none where it has a word.
    ///
    /// # Panics
    /// As [`Values::whole`].
    pub(super) fn list(&self, parameter: &Parameter) -> &[f64] {
        match self.get(parameter) {
            Value::List(numbers) => numbers,
            Value::Choice(_) => &[],
            other => panic!("“{}” is {other:?}, no list", parameter.name),
        }
    }
}
