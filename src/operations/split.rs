//! One curve cut into two.

use std::ops::Bound;

use super::amount::Amount;
use super::cutting::{SUBDIVISIONS, fairest, remark_on_nearness, without_target};
use super::editable::open;
use super::error::OperationError;
use super::handle::{Handle, OnCurve, Sets};
use super::inputs::Inputs;
use super::locks;
use super::matches::handed_over;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{Kind, Parameter};
use super::values::Values;
use crate::document::{Curve, Edit, EndMatch, MatchPlace, ParameterSpan, Renumbering};
use crate::geometry::parameters::{Number, Quantity};
use crate::geometry::{End, Progress};

/// Where a cut is offered: at the knot in the middle.
const MIDDLE: Amount = Amount::Of {
    words: "the knot in the middle (0.5 for one segment)",
    value: middle,
};

fn middle(input: &Operands) -> Result<f64, OperationError> {
    let segments = input.polygon()?.segments();
    Ok(if segments > 1 {
        (segments / 2) as f64
    } else {
        0.5
    })
}

const AT: Parameter = Parameter {
    name: "at",
    label: "At u",
    help: "Where the curve is cut",
    kind: Kind::Real(Number {
        from: Bound::Excluded(Amount::Number(0.0)),
        to: Bound::Excluded(Amount::Segments),
        default: MIDDLE,
        quantity: Quantity::Parameter,
    }),
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "split",
    label: "Split curve",
    help: "Cut the curve into two; at knots (whole u) the parts are exact",
    inputs: Inputs::One,
    each: false,
    parameters: &[AT, SUBDIVISIONS],
    check: |input| open(input, "cut in two at one place").map(drop),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let at = values.real(&AT);
    let last = curve.polygon.segments() as f64;
    let cut = |halvings| {
        let (first, second) = curve.polygon.split(at, halvings)?;
        Ok(vec![first, second])
    };
    let spans = [[0.0, at], [at, last]];
    let parts = fairest(&curve.polygon, &spans, values, progress, cut)?;
    let Ok([first, second]) = <[_; 2]>::try_from(parts) else {
        return Err(OperationError::Cancelled);
    };
    let deviation = Deviation::of(&first).or(Deviation::of(&second));
    let segments = [&first, &second].map(|part| part.polygon.segments());
    let counts = [&first, &second].map(|part| part.polygon.vertices().len());
    let lost = locks::lost(curve, &[&first.polygon, &second.polygon]);
    let part = |old: [f64; 2], segments: usize| ParameterSpan {
        old,
        new: [0.0, segments as f64],
    };
    let parts = [part([0.0, at], segments[0]), part([at, last], segments[1])];
    let mut outcome = Outcome::renumbered(input, first.polygon, vec![parts[0]], deviation)?;
    outcome.remarks = lost
        .into_iter()
        .chain(remark_on_nearness(deviation))
        .collect();
    let document = input.document();
    let cut_off = without_target(document, id, curve, End::Finish);
    outcome.edits.extend(cut_off);
    let added_polygon = second.polygon;
    let mut added = Curve::new(document.free_name(&curve.name), added_polygon.clone());
    added.group = curve.group.clone();
    added.colour = curve.colour;
    added.locked_vertices = locks::locks_of(curve, &added.polygon);
    added.targets.finish = curve.targets.finish;
    outcome.edits.push(Edit::Add(Box::new(added)));
    // The end goes with the second part, and so does what it follows and what follows it.
    let second = document.next_id();
    let own = document.match_of(id, End::Finish);
    let own = own.map(|matched| {
        Edit::SetMatch(EndMatch {
            curve: second,
            ..*matched
        })
    });
    outcome.edits.extend(own);
    let of_second = Renumbering::of_parameters(curve, &added_polygon, vec![parts[1]]);
    let followers = handed_over(document, [id, second], false, |place| match place {
        MatchPlace::Parameter(u) if u <= at => None,
        MatchPlace::End(End::Start) => None,
        place => of_second.place(place),
    });
    outcome.edits.extend(followers);
    outcome.figures = vec![
        Figure::count("first_vertices", "Vertices of the first part", counts[0]),
        Figure::count("second_vertices", "Vertices of the second part", counts[1]),
    ];
    outcome
        .annotations
        .push(Annotation::Point(curve.polygon.point(at)));
    outcome.handles.push(Handle {
        at: curve.polygon.point(at),
        label: AT.label,
        sets: Sets::OnCurve(OnCurve::Number(AT.name)),
    });
    Ok(outcome)
}
