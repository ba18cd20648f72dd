//! An operation, described once for menus, panel and command line.

use std::hash::{Hash, Hasher};

use super::error::OperationError;
use super::inputs::Inputs;
use super::matched_curves;
use super::operands::Operands;
use super::outcome::Outcome;
use super::parameter::Parameter;
use super::value::Value;
use super::values::Values;
use crate::geometry::Progress;

/// Describe an operation and how it is done.
#[derive(Debug)]
pub struct Operation {
    /// What the command line calls it.
    pub name: &'static str,
    /// What menus, the panel and the step of undo call it.
    pub label: &'static str,
    /// What it does, in one line.
    pub help: &'static str,
    /// What it works on.
    pub inputs: Inputs,
    /// Whether it runs on each of several selected items by itself, and not on the active one alone.
    pub each: bool,
    /// What can be chosen, in the order in which it is offered.
    pub parameters: &'static [Parameter],
    /// Tell why it cannot run on this input, whatever the values.
    pub(crate) check: fn(&Operands) -> Result<(), OperationError>,
    /// Name the parameters that mean nothing with these values, as numbers of a kind that is not chosen.
    pub(crate) unused: fn(&Values) -> &'static [&'static str],
    /// Do it.
    pub(crate) run: fn(&Operands, &Values, &Progress) -> Result<Outcome, OperationError>,
}

impl PartialEq for Operation {
    /// Operations are told apart by their names.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Operation {}

impl Hash for Operation {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl Operation {
    /// List the parameters that there is something to give for, with these values of them.
    pub fn parameters_for(
        &self,
        input: &Operands,
        values: &Values,
    ) -> impl Iterator<Item = &'static Parameter> {
        let unused = (self.unused)(values);
        let applying = self.parameters.iter().filter(|it| it.applies(input));
        applying.filter(move |parameter| !unused.contains(&parameter.name))
    }

    /// Tell beforehand why the operation cannot run on this input, whatever the values: the curve
    /// is locked or hidden, it has no ends, its degree is the highest already.
    ///
    /// # Errors
    /// [`OperationError`].
    pub fn check(&self, input: &Operands) -> Result<(), OperationError> {
        let needed = self.inputs;
        if !input.is(needed) {
            return Err(OperationError::Inputs { needed });
        }
        (self.check)(input)
    }

    /// Check values given by the parameters' names; what is not given has its default. Of values
    /// given twice the last counts.
    ///
    /// # Errors
    /// As [`Operation::check`], and if a parameter does not exist or its value is not in range.
    pub fn values<'a>(
        &self,
        input: &Operands,
        given: impl IntoIterator<Item = (&'a str, Value)>,
    ) -> Result<Values, OperationError> {
        self.check(input)?;
        Values::new(self.parameters, input, given)
    }

    /// Replace some of the values that were checked for this input.
    ///
    /// # Errors
    /// As [`Operation::values`].
    pub fn values_with<'a>(
        &self,
        input: &Operands,
        values: &Values,
        given: impl IntoIterator<Item = (&'a str, Value)>,
    ) -> Result<Values, OperationError> {
        let kept = self.parameters.iter();
        let kept = kept.map(|parameter| (parameter.name, values.get(parameter).clone()));
        self.values(input, kept.chain(given))
    }

    /// Run the operation with values that were checked for this input.
    ///
    /// The document accepts the edits of the outcome. Here alone it is decided whether what was asked for is
    /// reached, on the vertices as the document has them; if not, edits are those of the best that was found, if
    /// there is one.
    ///
    /// # Errors
    /// As [`Operation::check`]; if the values make no curve; [`OperationError::Cancelled`]
    /// if `progress` was cancelled meanwhile.
    pub fn run(
        &self,
        input: &Operands,
        values: &Values,
        progress: &Progress,
    ) -> Result<Outcome, OperationError> {
        self.check(input)?;
        let mut outcome = (self.run)(input, values, progress)?;
        let after = outcome.applied_to(input.document())?;
        matched_curves::tell(&mut outcome, input.document(), &after);
        let check = outcome.check(&after, progress);
        let check = check.ok_or(OperationError::Cancelled)?;
        outcome.reached = check.holds;
        outcome.residual = check.residual;
        if progress.is_cancelled() {
            return Err(OperationError::Cancelled);
        }
        Ok(outcome)
    }
}
