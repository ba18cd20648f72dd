//! The time that a search has, and what it has found meanwhile.

use std::ops::Bound;
use std::time::Duration;

use super::lists::given;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::parameter::{Kind, Parameter};
use super::values::Values;
use crate::document::{Curve, Edit};
use crate::geometry::parameters::{Limits, brief};
use crate::geometry::{FloatPolygon, Progress};

/// The time without a wish, in seconds.
const TIME: f64 = 10.0;

/// The seconds after which a search ends.
pub(super) const TIME_LIMIT: Parameter = Parameter {
    name: "time-limit",
    label: "Time limit",
    help: "The seconds of computing, at most 86400, after which the search ends with the best so far",
    kind: Kind::optional_number(SECONDS, |_| "10"),
};

/// From more than nothing to a day: a search that takes longer is no search to wait for, and a typing
/// error such as 1e9 would keep a machine of many files busy.
const SECONDS: Limits = (Bound::Excluded(0.0), Bound::Included(86_400.0));

/// Give a search the time that the values allow.
pub(super) fn limited(progress: &Progress, values: &Values) -> Progress {
    progress.limited(Duration::from_secs_f64(seconds(values)))
}

/// Tell why a search ended before its end.
pub(super) fn why_ended(progress: &Progress, values: &Values) -> String {
    match progress.is_stopped() {
        true => "Stopped".to_owned(),
        false => format!(
            "The time limit of {} s ended the search",
            brief(seconds(values))
        ),
    }
}

/// Tell that a search ended before its end, with what it had found.
pub(super) fn best_so_far(progress: &Progress, values: &Values) -> String {
    let why = why_ended(progress, values);
    format!("{why}: this is the best found so far")
}

/// Tell the seconds that a search has.
fn seconds(values: &Values) -> f64 {
    given(values, &TIME_LIMIT).unwrap_or(TIME)
}

impl Operation {
    /// Whether the operation searches for a limited time, so that it can be stopped with the best found so far.
    pub fn can_be_stopped(&self) -> bool {
        let mut names = self.parameters.iter().map(|it| it.name);
        names.any(|name| name == TIME_LIMIT.name)
    }

    /// The edits that show the best curves found so far: in place of the curve that is worked on, or beside it.
    pub fn edits_of_best(
        &self,
        input: &Operands,
        values: &Values,
        best: Vec<FloatPolygon>,
    ) -> Vec<Edit> {
        let from_curve = values.given_reference().is_none();
        match (input.curve().ok().filter(|_| from_curve), &best[..]) {
            (Some((id, curve)), [only]) if has_same_vertices(&curve.polygon, only) => {
                Outcome::reshaped(id, only.clone(), Deviation::Unmeasured).edits
            }
            (Some(_), [only]) => {
                let outcome =
                    Outcome::renumbered(input, only.clone(), Vec::new(), Deviation::Unmeasured);
                outcome.map_or_else(|_| Vec::new(), |outcome| outcome.edits)
            }
            _ => {
                let name = input.document().free_name(self.name);
                let group = input.group(values.given_reference());
                let curves = best.into_iter().map(|it| Curve::new(name.clone(), it));
                let added = curves.map(|it| Edit::Add(Box::new(it.in_group(group.clone()))));
                added.collect()
            }
        }
    }
}

/// Whether a curve takes a polygon without new numbers for its vertices.
fn has_same_vertices(one: &FloatPolygon, other: &FloatPolygon) -> bool {
    let shape = |it: &FloatPolygon| (it.degree(), it.vertices().len(), it.is_periodic());
    shape(one) == shape(other)
}
