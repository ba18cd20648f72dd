//! Copies of a curve in a row, in a ring, or along a spiral.

use std::collections::BTreeSet;
use std::ops::Bound;

use glam::DVec3;

use super::amount::Amount;
use super::copied_matches::match_own_copies;
use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Copying, Deviation, Outcome};
use super::parameter::{Kind, Parameter};
use super::values::Values;
use crate::document::{Curve, Edit, EndTargets, free_name};
use crate::geometry::end_correction::EndTarget;
use crate::geometry::parameters::{Number, Quantity};
use crate::geometry::{BezierPolygon, FloatPolygon, Progress, bounds};

/// The most curves of an array.
const MOST: usize = 1000;

/// The step of an array without one, by the width of the curves.
const STEP_BY_WIDTH: f64 = 1.25;

const COUNT: Parameter = Parameter {
    name: "count",
    label: "Curves",
    help: "How many there are with the curve itself",
    kind: Kind::whole(2, MOST, 3),
};

const STEP: Parameter = Parameter {
    name: "step",
    label: "Step",
    help: "How far each copy is from the one before",
    kind: Kind::vector(
        false,
        |_| "1.25 times the width; none where an angle is given",
    ),
};

const ANGLE: Parameter = Parameter {
    name: "angle",
    label: "Angle",
    help: "How far each copy is turned from the one before, about the z axis",
    kind: Kind::Real(Number {
        from: Bound::Included(Amount::Number(-std::f64::consts::TAU)),
        to: Bound::Included(Amount::Number(std::f64::consts::TAU)),
        default: Amount::Number(0.0),
        quantity: Quantity::Angle,
    }),
};

const ABOUT: Parameter = Parameter {
    name: "about",
    label: "About",
    help: "The point that copies are turned about",
    kind: Kind::vector(false, |_| "the origin"),
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "array",
    label: "Array",
    help: "Copy the curve several times, each copy a step and an angle further",
    inputs: Inputs::One,
    each: true,
    parameters: &[COUNT, STEP, ANGLE, ABOUT],
    check: check_editable,
    unused: |values| match values.real(&ANGLE) {
        0.0 => &["about"],
        _ => &[],
    },
    run,
};

fn run(input: &Operands, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (_, curve) = input.curve()?;
    let angle = values.real(&ANGLE);
    let step = match point(values.list(&STEP)) {
        Some(step) => step,
        None if angle != 0.0 => DVec3::ZERO,
        None => width(&together(input, &curve.polygon)) * DVec3::X,
    };
    let about = point(values.list(&ABOUT)).unwrap_or_default();
    let taken = input.document().names().map(str::to_owned);
    let mut taken: BTreeSet<String> = taken.collect();
    let mut outcome = Outcome::unchanged(Deviation::Exact);
    for copy in 1..values.whole(&COUNT) {
        let times = copy as f64;
        let place = Place {
            turn: Turn::by(times * angle),
            about,
            shift: times * step,
        };
        let name = free_name(&curve.name, |name| taken.contains(name));
        taken.insert(name.clone());
        let copy = place.copy(curve, name)?;
        outcome.edits.push(Edit::Add(Box::new(copy)));
    }
    outcome.copied = Some(Copying::Moved);
    match_own_copies(&mut outcome, input)?;
    Ok(outcome)
}

/// A point or a vector of the plane or of space.
fn point(numbers: &[f64]) -> Option<DVec3> {
    match *numbers {
        [x, y] => Some(DVec3::new(x, y, 0.0)),
        [x, y, z] => Some(DVec3::new(x, y, z)),
        _ => None,
    }
}

/// The polygons of the curves that get copies at once: what lies together stays together.
fn together<'a>(input: &'a Operands, own: &'a FloatPolygon) -> Vec<&'a FloatPolygon> {
    let curves = input.document().curves();
    let along = curves.filter(|(id, _)| input.goes_along(*id));
    let along = along.map(|(_, curve)| &curve.polygon);
    along.chain([own]).collect()
}

/// The step that sets copies of curves side by side.
fn width(polygons: &[&FloatPolygon]) -> f64 {
    let closed = polygons.iter().map(|it| BezierPolygon::from_float(it));
    let closed: Vec<BezierPolygon> = closed.collect();
    let vertices = closed.iter().flat_map(|it| it.vertices());
    let (low, high) = bounds(vertices.copied());
    match high.x - low.x {
        0.0 => (high - low).length(),
        width => STEP_BY_WIDTH * width,
    }
}

/// A turn about the z axis; by quarters it is exact.
#[derive(Clone, Copy, Debug)]
struct Turn {
    sin: f64,
    cos: f64,
}

impl Turn {
    fn by(angle: f64) -> Self {
        let quarters = angle / std::f64::consts::FRAC_PI_2;
        let nearest = quarters.round();
        if (quarters - nearest).abs() > 4.0 * f64::EPSILON * quarters.abs() {
            let (sin, cos) = angle.sin_cos();
            return Self { sin, cos };
        }
        let (sin, cos) = match nearest.rem_euclid(4.0) {
            0.0 => (0.0, 1.0),
            1.0 => (1.0, 0.0),
            2.0 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
        Self { sin, cos }
    }

    fn vector(self, vector: DVec3) -> DVec3 {
        let Self { sin, cos } = self;
        let DVec3 { x, y, z } = vector;
        DVec3::new(cos * x - sin * y, sin * x + cos * y, z)
    }
}

/// Where a copy lies: turned about a point, and then shifted.
struct Place {
    turn: Turn,
    about: DVec3,
    shift: DVec3,
}

impl Place {
    fn point(&self, point: DVec3) -> DVec3 {
        let Self { turn, about, shift } = self;
        // What is not turned is not rounded by it.
        match turn.sin == 0.0 && turn.cos == 1.0 {
            true => point + *shift,
            false => *about + turn.vector(point - *about) + *shift,
        }
    }

    fn target(&self, target: EndTarget) -> EndTarget {
        let vector = |vector: DVec3| self.turn.vector(vector);
        EndTarget {
            point: self.point(target.point),
            direction: target.direction.map(vector),
            normal: target.normal.map(vector),
            ..target
        }
    }

    /// The curve there, with its locks and targets.
    fn copy(&self, curve: &Curve, name: String) -> Result<Curve, OperationError> {
        let polygon = &curve.polygon;
        let vertices = polygon.vertices().iter().map(|it| self.point(*it));
        let weights = polygon.weights().map(<[f64]>::to_vec);
        let polygon = FloatPolygon::new(
            polygon.degree(),
            vertices.collect(),
            weights,
            polygon.is_periodic(),
        )?;
        let mut targets = EndTargets::default();
        for (end, target) in curve.targets.list() {
            targets.set(end, Some(self.target(target)));
        }
        Ok(Curve {
            name,
            polygon,
            targets,
            extras: Default::default(),
            ..curve.clone()
        })
    }
}
