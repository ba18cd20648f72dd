//! Coordinates rounded to some digits.

use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, Parameter};
use super::values::Values;
use crate::document::Curve;
use crate::geometry::{ClampedPolygon, FloatPolygon, Progress, Rounded, counted, rounded_up};

type Rounding = fn(&Curve, usize) -> Result<Rounded<FloatPolygon>, OperationError>;

const POLYGON: Parameter = Parameter {
    name: "polygon",
    label: "Polygon",
    help: "The polygon whose coordinates are rounded",
    kind: Kind::Choice {
        options: &[
            Choice::new("float", "Float S-polygon"),
            Choice::new("clamped", "Closed S-polygon"),
        ],
        default: 0,
    },
};

const DIGITS: Parameter = Parameter {
    name: "digits",
    label: "Digits",
    help: "How many digits each coordinate keeps after the decimal point",
    kind: Kind::whole(0, 17, 3),
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "round",
    label: "Round coordinates",
    help: "Round the coordinates of the float or the closed S-polygon, and report what that does to the curve",
    inputs: Inputs::One,
    each: true,
    parameters: &[POLYGON, DIGITS],
    check: check_editable,
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let rounding = values.choice(&POLYGON, &[float_rounded as Rounding, closed_rounded]);
    let digits = values.whole(&DIGITS);
    let rounded = rounding(curve, digits)?;
    let remark = off_round_numbers(rounding, curve, &rounded.polygon, digits)?;
    let moved = Figure::length("rounding", "Largest rounding of a vertex", rounded.moved);
    let deviation = Deviation::AtMost(rounded.deviation);
    let mut outcome = Outcome::reshaped(id, rounded.polygon, deviation);
    outcome.figures.push(moved);
    outcome.remarks.extend(remark);
    let locked = curve.locked_vertices.iter().len();
    if locked > 0 {
        let vertices = counted(locked, "locked vertex keeps", "locked vertices keep");
        outcome.remarks.push(format!("{vertices} the coordinates"));
    }
    Ok(outcome)
}

/// Round the float S-polygon, but for its locked vertices.
fn float_rounded(curve: &Curve, digits: usize) -> Result<Rounded<FloatPolygon>, OperationError> {
    let before = &curve.polygon;
    let mut rounded = before.rounded(digits)?;
    if curve.locked_vertices.is_empty() {
        return Ok(rounded);
    }
    let locked = curve.locked_vertices.iter();
    let held: Vec<_> = locked.map(|index| (index, before.vertex(index))).collect();
    rounded.polygon.move_vertices(held)?;
    let pairs = before.vertices().iter().zip(rounded.polygon.vertices());
    Ok(Rounded {
        deviation: before.deviation(&rounded.polygon)?,
        moved: pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max),
        ..rounded
    })
}

/// Say how far vertices are off round numbers afterwards, if that can be seen: the float S-polygon
/// holds its own round numbers, but at high degrees not those of the closed one.
fn off_round_numbers(
    rounding: Rounding,
    curve: &Curve,
    polygon: &FloatPolygon,
    digits: usize,
) -> Result<Option<String>, OperationError> {
    /// What is not seen, in units of the last digit.
    const UNSEEN: f64 = 0.05;
    let after = Curve {
        polygon: polygon.clone(),
        ..curve.clone()
    };
    let left = rounding(&after, digits)?.moved;
    let unit = 0.1_f64.powi(digits as i32);
    Ok((left > UNSEEN * unit).then(|| {
        let left = rounded_up(left);
        format!("The vertices stay off round numbers by up to {left}: at this degree the float S-polygon cannot hold what the closed one needs")
    }))
}

/// Round the closed S-polygon and find the float one of the curve. That moves all of its vertices,
/// so none can be locked.
fn closed_rounded(curve: &Curve, digits: usize) -> Result<Rounded<FloatPolygon>, OperationError> {
    let polygon = &curve.polygon;
    let closed = ClampedPolygon::from_float(polygon).rounded(digits)?;
    let rounded = if polygon.is_periodic() {
        closed.polygon.nearest_periodic_float()?.polygon
    } else {
        closed.polygon.to_float()?
    };
    curve.check_held(&rounded)?;
    Ok(Rounded {
        // The float polygon is rounded once more, and a periodic one only comes near.
        deviation: polygon.deviation(&rounded)?,
        moved: closed.moved,
        polygon: rounded,
    })
}
