//! The same curve, run through the other way.

use super::editable::check_editable;
use super::error::OperationError;
use super::input::Input;
use super::inputs::Inputs;
use super::matches::{Moved, followers, without_match};
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::values::Values;
use crate::document::{Edit, EndMatch, MatchPlace};
use crate::geometry::{End, Progress};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "reverse",
    label: "Reverse direction",
    help: "Reverse the direction of the curve; its shape stays",
    inputs: Inputs::One,
    parameters: &[],
    check: check_editable,
    unused: |_| &[],
    run,
};

fn run(input: &Input, _: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let last = curve.polygon.vertices().len() - 1;
    let locked = &curve.locked_vertices;
    let mut outcome = Outcome::unchanged(Deviation::Exact);
    outcome.renumbered = true;
    let document = input.document();
    let own = End::BOTH.into_iter();
    let removed = own.filter_map(|end| without_match(document, id, end));
    outcome.edits.extend(removed);
    outcome.edits.push(Edit::Renumber {
        curve: id,
        polygon: curve.polygon.reversed(),
        locked_vertices: locked.renumbered(|vertex| last.checked_sub(vertex)),
    });
    // The targets stay where they are: each becomes the other end's.
    for end in End::BOTH {
        let target = curve.targets.get(end.other());
        let target = target.map(|target| target.turned(curve.polygon.is_planar()));
        if target != curve.targets.get(end) {
            outcome.edits.push(Edit::SetTarget {
                curve: id,
                end,
                target,
            });
        }
    }
    // The matches stay where they are, too.
    let own = End::BOTH.into_iter();
    let own = own.filter_map(|end| document.match_of(id, end));
    let turned = own.map(|matched| {
        Edit::SetMatch(EndMatch {
            end: matched.end.other(),
            reversed: !matched.reversed,
            ..*matched
        })
    });
    outcome.edits.extend(turned);
    let segments = curve.polygon.segments() as f64;
    let followers = followers(document, id, |place| {
        let place = match place {
            MatchPlace::End(end) => MatchPlace::End(end.other()),
            MatchPlace::Parameter(u) => MatchPlace::Parameter(segments - u),
        };
        Moved::To(id, place, true)
    });
    outcome.edits.extend(followers);
    Ok(outcome)
}
