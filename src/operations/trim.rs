//! A part of a curve.

use std::ops::Bound;

use super::amount::Amount;
use super::cutting::{SUBDIVISIONS, fairest, remark_on_nearness, without_target};
use super::editable::check_editable;
use super::error::OperationError;
use super::handle::{Handle, OnCurve, Sets};
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{Kind, Parameter};
use super::values::Values;
use crate::document::ParameterSpan;
use crate::geometry::parameters::{Number, Quantity};
use crate::geometry::{End, FloatPolygon, Progress};

const FROM: Parameter = Parameter {
    name: "from",
    label: "From u",
    help: "Where the part that is kept begins",
    kind: Kind::Real(Number {
        from: Bound::Included(Amount::Number(0.0)),
        to: Bound::Excluded(Amount::Segments),
        default: Amount::Number(0.0),
        quantity: Quantity::Parameter,
    }),
};

const TO: Parameter = Parameter {
    name: "to",
    label: "To u",
    help: "End of the part that is kept; on a periodic curve it may lie up to one turn past the start",
    kind: Kind::Real(Number {
        from: Bound::Excluded(Amount::Number(0.0)),
        to: Bound::Included(Amount::Of {
            words: "the number of segments (a periodic curve: twice that)",
            value: last,
        }),
        default: Amount::Segments,
        quantity: Quantity::Parameter,
    }),
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "trim",
    label: "Trim curve",
    help: "Keep a part of the curve; between knots (whole u) it is exact",
    inputs: Inputs::One,
    each: false,
    parameters: &[FROM, TO, SUBDIVISIONS],
    check: check_editable,
    unused: |_| &[],
    run,
};

fn last(input: &Operands) -> Result<f64, OperationError> {
    let polygon = input.polygon()?;
    let turns = if polygon.is_periodic() { 2.0 } else { 1.0 };
    Ok(turns * polygon.segments() as f64)
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let polygon = &curve.polygon;
    let (from, to) = (values.real(&FROM), values.real(&TO));
    let turn = polygon.segments() as f64;
    let handles = handles(polygon, [from, to]);
    if !polygon.is_periodic() && [from, to] == [0.0, turn] {
        return Ok(Outcome {
            handles,
            remarks: vec!["Nothing is cut off: drag an end, or set From u or To u".to_owned()],
            ..Outcome::unchanged(Deviation::Exact)
        });
    }
    let cut = |halvings| Ok(vec![polygon.trimmed(from, to, halvings)?]);
    let parts = fairest(polygon, &[[from, to]], values, progress, cut)?;
    let Ok([part]) = <[_; 1]>::try_from(parts) else {
        return Err(OperationError::Cancelled);
    };
    let deviation = Deviation::of(&part);
    let segments = part.polygon.segments();
    let vertices = Figure::count("vertices", "Vertices", part.polygon.vertices().len());
    let ends = End::BOTH.map(|end| Annotation::Point(part.polygon.end_jet(end).point));
    let scale = segments as f64 / (to - from);
    let span = |old: [f64; 2], turns: f64| ParameterSpan {
        old,
        new: old.map(|u| (u + turns * turn - from) * scale),
    };
    let mut spans = vec![span([from, to.min(turn)], 0.0)];
    // On a periodic curve the part may lie past the joint.
    if polygon.is_periodic() && to >= turn {
        spans.push(span([0.0, to - turn], 1.0));
    }
    let mut outcome = Outcome::renumbered(input, part.polygon, spans, deviation)?;
    if from > 0.0 {
        let cut_off = without_target(input.document(), id, curve, End::Start);
        outcome.edits.extend(cut_off);
    }
    if to < turn {
        let cut_off = without_target(input.document(), id, curve, End::Finish);
        outcome.edits.extend(cut_off);
    }
    outcome.remarks.extend(remark_on_nearness(deviation));
    outcome.figures.push(vertices);
    outcome.annotations.extend(ends);
    outcome.handles = handles;
    Ok(outcome)
}

/// The ends of the part.
fn handles(polygon: &FloatPolygon, part: [f64; 2]) -> Vec<Handle> {
    let turn = polygon.is_periodic().then(|| polygon.segments() as f64);
    let ends = End::BOTH.into_iter().zip([&FROM, &TO]).zip(part);
    let handles = ends.map(|((end, parameter), u)| Handle {
        at: polygon.point(u),
        label: parameter.label,
        sets: Sets::OnCurve(OnCurve::PartEnd {
            parameters: [FROM.name, TO.name],
            part,
            end,
            turn,
        }),
    });
    handles.collect()
}
