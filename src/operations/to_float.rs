//! Float polygons in the place of references: of one, of its group, or of all.

use std::ops::Bound;
use std::sync::Arc;

use super::error::OperationError;
use super::floats::{FloatRequest, floats_of};
use super::inputs::Inputs;
use super::lists::{given, given_count};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, POSITIVE, Parameter};
use super::time_limit::{TIME_LIMIT, best_so_far, limited};
use super::values::Values;
use crate::document::{CurveId, Edit, Group, Reference, quoted};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::parameters::Quantity;
use crate::geometry::{MAX_DEGREE, Progress};

const REFERENCES: Parameter = Parameter {
    name: "references",
    label: "References",
    help: "One, all of its group, or all; hidden ones stay unless chosen",
    kind: Kind::Choice {
        options: &[
            Choice::new("chosen", "Chosen, else all"),
            Choice::new("group", "Its group"),
            Choice::new("all", "All"),
        ],
        default: 0,
    },
};

/// Which references are converted.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Which {
    Chosen,
    Group,
    All,
}

const WHICH: [Which; 3] = [Which::Chosen, Which::Group, Which::All];

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "Largest distance of each curve from its reference",
    kind: Kind::optional_number(POSITIVE, |_| "1e-4 of the size of each"),
};

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree of the float polygons",
    kind: Kind::List {
        count: 1..=1,
        whole: true,
        limits: (Bound::Included(1.0), Bound::Included(MAX_DEGREE as f64)),
        quantity: Quantity::Number,
        words: &[],
        none: |_| "the one with the fewest vertices",
        in_space: false,
    },
};

const KEEP: Parameter = Parameter {
    name: "keep",
    label: "Keep references",
    help: "Leave the references where they are, beside the curves",
    kind: Kind::Switch { default: false },
};

/// The operation: its description, and how it is run.
pub static OPERATION: Operation = Operation {
    name: "to-float",
    label: "Convert to float polygon",
    help: "Put float polygons within a tolerance in the place of references: one, a group, or all",
    inputs: Inputs::References,
    each: false,
    parameters: &[REFERENCES, TOLERANCE, DEGREE, KEEP, TIME_LIMIT],
    check: |input| match WHICH
        .iter()
        .any(|which| !converted(input, *which).is_empty())
    {
        true => Ok(()),
        false => Err(OperationError::Inputs {
            needed: Inputs::References,
        }),
    },
    unused: |_| &[],
    run,
};

/// The smooth references that are converted.
fn converted(input: &Operands, which: Which) -> Vec<(CurveId, Arc<Reference>)> {
    let document = input.document();
    let chosen = input.chosen_reference();
    let group = chosen.and_then(|id| document.group(id));
    let references = document.references().filter(|(id, reference)| {
        let is_free = reference.visible && !reference.locked;
        let is_wanted = match (which, chosen) {
            (Which::All, _) | (_, None) => is_free,
            (Which::Chosen, Some(chosen)) => *id == chosen,
            (Which::Group, Some(_)) => {
                is_free && group.is_some_and(|group| is_within(&reference.group, group))
            }
        };
        is_wanted && reference.curve.form().is_smooth()
    });
    references
        .map(|(id, reference)| (id, reference.clone()))
        .collect()
}

/// Whether a group is another one or in it.
fn is_within(group: &Group, outer: &Group) -> bool {
    group.names().starts_with(outer.names())
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let references = converted(input, values.choice(&REFERENCES, &WHICH));
    if references.is_empty() {
        return Err(OperationError::PointsOnly);
    }
    let request = FloatRequest {
        degree: given_count(values, &DEGREE),
        tolerance: given(values, &TOLERANCE),
    };
    let search = limited(progress, values);
    let mut ids = input.document().next_ids();
    let mut outcome = Outcome::unchanged(Deviation::Exact);
    let (mut rows, mut failed) = (Vec::new(), 0);
    for (index, (id, reference)) in references.iter().enumerate() {
        let share = |index: usize| index as f64 / references.len() as f64;
        let own = search.part(share(index), share(index + 1));
        let own = own.hurried(1.0 / (references.len() - index) as f64);
        let found = floats_of(reference, request, &own);
        if progress.is_cancelled() {
            return Err(OperationError::Cancelled);
        }
        let name = quoted(&reference.name);
        let floats = match found {
            Ok(floats) => floats,
            Err(error) if references.len() == 1 => return Err(error),
            Err(error) => {
                failed += 1;
                outcome.remarks.push(format!("{name} stays: {error}"));
                continue;
            }
        };
        outcome.remarks.push(format!("{name}: {}", floats.told()));
        rows.push(vec![floats.vertices as f64, floats.deviation]);
        outcome.deviation = outcome.deviation.or(match floats.is_bounded {
            true => Deviation::AtMost(floats.deviation),
            false => Deviation::Measured(floats.deviation),
        });
        if !values.switch(&KEEP) {
            outcome.edits.push(Edit::Remove(*id));
        }
        for mut curve in floats.curves {
            if values.switch(&KEEP) {
                curve.name = input.document().free_name(&curve.name);
            }
            let limit = Requirement::Limit {
                found: floats.deviation,
                most: floats.tolerance,
            };
            let made = ids.next().ok_or(OperationError::Cancelled)?;
            outcome.requirements.push((made, vec![limit]));
            outcome.edits.push(Edit::Add(Box::new(curve)));
        }
    }
    if failed > 0 {
        // No curve stands for these: what is asked for is not reached.
        let none = input.document().next_ids().nth(outcome.requirements.len());
        let missing = Requirement::Failed { left: None };
        outcome
            .requirements
            .extend(none.map(|id| (id, vec![missing])));
    }
    if search.is_late() {
        outcome.remarks.push(best_so_far(&search, values));
    }
    outcome.figures = vec![
        Figure::count("converted", "Converted", rows.len()),
        Figure::table(
            "floats",
            "Vertices and deviations",
            &["vertices", "deviation"],
            rows,
        ),
    ];
    Ok(outcome)
}
