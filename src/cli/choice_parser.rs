//! Choices that bring values of other parameters with them: `log-aesthetic:alpha=-1`.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command, Error};

use crate::operations::{Choice, Parameter, Value};

/// Values of parameters by their names.
pub(super) type Assignments = Vec<(&'static str, Value)>;

/// Read a word that can be chosen and, after a colon, values of other parameters of the operation, as
/// name=value with commas between them.
#[derive(Clone)]
pub(super) struct ChoiceParser {
    /// The parameter that is a choice.
    pub(super) parameter: &'static Parameter,
    /// Its options.
    pub(super) options: &'static [Choice],
    /// All parameters of the operation.
    pub(super) all: &'static [Parameter],
}

impl TypedValueParser for ChoiceParser {
    type Value = Assignments;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<Assignments, Error> {
        let text = value.to_string_lossy();
        let (word, rest) = text.split_once(':').unwrap_or((&text, ""));
        let word = self
            .words()
            .parse_ref(command, argument, OsStr::new(word))?;
        let refused = |reason: String| {
            let name = self.parameter.name;
            let message = format!("invalid value '{text}' for '--{name}': {reason}\n");
            Error::raw(ErrorKind::ValueValidation, message).with_cmd(command)
        };
        let read = |parameter: &'static Parameter, text: &str| {
            let value = parameter.read_given(text);
            let value = value.map_err(|error| refused(error.to_string()))?;
            Ok::<_, Error>((parameter.name, value))
        };
        let mut assignments = vec![read(self.parameter, &word)?];
        for part in rest.split(',').filter(|_| !rest.is_empty()) {
            let pair = part.split_once('=');
            let (name, value) = pair.ok_or_else(|| {
                refused(format!(
                    "“{part}” gives no parameter a value: write it as name=value"
                ))
            })?;
            let parameter = self.parameter_of(&word, name.trim()).map_err(&refused)?;
            if assignments
                .iter()
                .any(|(known, _)| *known == parameter.name)
            {
                return Err(refused(format!("“{}” is given twice", parameter.name)));
            }
            assignments.push(read(parameter, value)?);
        }
        Ok(assignments)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let options = self.options.iter();
        Some(Box::new(options.map(|option| {
            PossibleValue::new(option.name).help(option.label)
        })))
    }
}

impl ChoiceParser {
    /// Find a parameter that counts for a word.
    fn parameter_of(&self, word: &str, name: &str) -> Result<&'static Parameter, String> {
        let mut options = self.options.iter();
        let option = options.find(|option| option.name == word);
        let known = option.map_or(&[][..], |option| option.parameters);
        let mut all = self.all.iter();
        let found = all.find(|it| it.name == name && known.contains(&name));
        found.ok_or_else(|| no_such_parameter(word, name, known))
    }

    fn words(&self) -> PossibleValuesParser {
        PossibleValuesParser::new(self.options.iter().map(|option| option.name))
    }
}

/// Say that a word that can be chosen has no parameter of a name, and which it has.
pub(super) fn no_such_parameter(word: &str, name: &str, known: &[&str]) -> String {
    let known = match known {
        [] => "none".to_owned(),
        known => known.join(", "),
    };
    format!("{word} has no parameter “{name}”: it has {known}")
}
