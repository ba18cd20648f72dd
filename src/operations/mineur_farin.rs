//! Curves on Mineur–Farin configurations.

use std::f64::consts::PI;
use std::ops::Bound;

use glam::DVec3;

use super::amount::Amount;
use super::atlas::Atlas;
use super::error::OperationError;
use super::handle::{Handle, Sets};
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, Parameter};
use super::value::Value;
use super::values::Values;
use crate::document::{Curve, Edit, free_name};
use crate::geometry::mineur_farin::{self, Configuration, Format};
use crate::geometry::parameters::{Number, OutOfRange, Quantity};
use crate::geometry::{MAX_DEGREE, Progress, rounded_up};

/// The most legs.
const MOST_LEGS: usize = 1000;

const LEGS: Parameter = Parameter {
    name: "legs",
    label: "Legs",
    help: "How many legs there are, one fewer than points",
    kind: Kind::whole(1, MOST_LEGS, 8),
};

const RATIO: Parameter = Parameter {
    name: "ratio",
    label: "Length ratio s",
    help: "The length of each leg, as a multiple of that before it",
    kind: Kind::Real(Number {
        from: Bound::Excluded(Amount::Number(0.0)),
        to: Bound::Unbounded,
        default: Amount::Number(1.2),
        quantity: Quantity::Number,
    }),
};

const ANGLE: Parameter = Parameter {
    name: "angle",
    label: "Turning angle θ",
    help: "The angle from each leg to the next, positive to the left",
    kind: angle(20.0),
};

const TORSION: Parameter = Parameter {
    name: "torsion",
    label: "Torsion angle",
    help: "The angle from the plane of two neighbouring legs to that of the next two; 0 in the plane",
    kind: angle(0.0),
};

const fn angle(default: f64) -> Kind {
    Kind::Real(Number {
        from: Bound::Included(Amount::Number(-PI)),
        to: Bound::Included(Amount::Number(PI)),
        default: Amount::Number(default.to_radians()),
        quantity: Quantity::Angle,
    })
}

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree of the float S-polygon; a Bézier polygon has as many legs as its degree",
    kind: Kind::whole(1, MAX_DEGREE, 5),
};

const POLYGON: Parameter = Parameter {
    name: "polygon",
    label: "Polygon",
    help: "Which control polygon the points are; both, to compare their curves",
    kind: Kind::Choice {
        options: &[
            Choice::new("float", "Float"),
            Choice::new("bezier", "Bézier"),
            Choice::new("both", "Both"),
        ],
        default: 0,
    },
};

const START: Parameter = Parameter {
    name: "start",
    label: "Start",
    help: "The first point",
    kind: Kind::vector(false, |_| "0, 0"),
};

const FIRST_LEG: Parameter = Parameter {
    name: "first-leg",
    label: "First leg",
    help: "The vector from the first point to the second",
    kind: Kind::vector(false, |_| "1, 0"),
};

/// A Bézier curve that is off by a larger share of its size is not the one that was asked for.
const SEEN: f64 = 1e-9;

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "mineur-farin",
    label: "Mineur–Farin curve",
    help: "Make a curve on points whose legs grow by one ratio and turn by one angle",
    inputs: Inputs::None,
    each: false,
    parameters: &[
        LEGS, RATIO, ANGLE, TORSION, DEGREE, POLYGON, START, FIRST_LEG,
    ],
    check: |_| Ok(()),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let configuration = configuration(values)?;
    let legs = values.whole(&LEGS);
    let float = Format::Float {
        degree: values.whole(&DEGREE),
    };
    let (all, both) = ([float, Format::Bezier], &[0, 1][..]);
    let chosen = values.choice(&POLYGON, &[&both[..1], &both[1..], both]);
    let mut outcome = Outcome::unchanged(Deviation::Exact);
    let mut taken: Vec<String> = Vec::new();
    for format in chosen.iter().map(|index| all[*index]) {
        let made = configuration.curve(format, legs)?;
        outcome.deviation = outcome.deviation.or(Deviation::of(&made));
        if made.deviation > SEEN * extent(&configuration, legs) {
            let off = rounded_up(made.deviation);
            outcome.remarks.push(format!("At degree {legs} doubles cannot hold the float S-polygon of the Bézier curve: the curve is off by up to {off}"));
        }
        let is_taken = |name: &str| {
            let mut curves = input.document().curves();
            taken.iter().any(|taken| taken == name) || curves.any(|(_, curve)| curve.name == name)
        };
        let name = free_name(name(format), is_taken);
        taken.push(name.clone());
        let curve = Curve::new(name, made.polygon);
        outcome.edits.push(Edit::Add(Box::new(curve)));
    }
    let is_bezier = chosen.contains(&1);
    if is_bezier {
        outcome.figures.extend(closed_form(&configuration, legs));
    }
    if chosen == [1] && values.whole(&DEGREE) != legs {
        let remark = format!("A Bézier polygon of {legs} legs has degree {legs}");
        outcome.remarks.push(remark);
    }
    outcome.handles = handles(&configuration, legs);
    let shown = if chosen == [1] { Format::Bezier } else { float };
    let plane = mineur_farin::Atlas::around(&configuration, shown, legs);
    outcome.atlas = Some(Atlas {
        plane,
        across: &ANGLE,
        up: &RATIO,
        bound: (is_bezier && configuration.torsion == 0.0).then_some("Bézier curves: closed form"),
    });
    Ok(outcome)
}

fn configuration(values: &Values) -> Result<Configuration, OperationError> {
    let point = |parameter, none: DVec3| match *values.list(parameter) {
        [x, y] => DVec3::new(x, y, 0.0),
        [x, y, z] => DVec3::new(x, y, z),
        _ => none,
    };
    let first_leg = point(&FIRST_LEG, DVec3::X);
    if first_leg == DVec3::ZERO {
        return Err(OutOfRange {
            label: FIRST_LEG.label,
            value: "a vector of length 0".into(),
            needed: "a vector with a direction".into(),
        }
        .into());
    }
    Ok(Configuration {
        start: point(&START, DVec3::ZERO),
        first_leg,
        ratio: values.real(&RATIO),
        turn: values.real(&ANGLE),
        torsion: values.real(&TORSION),
    })
}

/// How far the points reach from the first.
fn extent(configuration: &Configuration, legs: usize) -> f64 {
    let points = configuration.points(legs);
    let far = points.iter().map(|it| it.distance(configuration.start));
    far.fold(0.0, f64::max)
}

/// What the curve of a format is called.
fn name(format: Format) -> &'static str {
    match format {
        Format::Float { .. } => "Mineur–Farin",
        Format::Bezier => "Mineur–Farin Bézier",
    }
}

/// What the closed form says of a planar Bézier curve.
fn closed_form(configuration: &Configuration, legs: usize) -> Vec<Figure> {
    if configuration.torsion != 0.0 || legs < 2 {
        return Vec::new();
    }
    let extremum = configuration.bezier_extremum();
    let monotone = Figure {
        name: "bezier_monotone",
        label: "Bézier monotone, closed form",
        value: Value::Switch(extremum.is_none()),
        quantity: Quantity::Number,
    };
    let place = extremum.map(|t| Figure {
        name: "bezier_extremum",
        label: "Bézier extremum at t",
        value: Value::Real(t),
        quantity: Quantity::Parameter,
    });
    [monotone].into_iter().chain(place).collect()
}

/// The first three points set the start, the first leg, and ratio and angle; so does the last one, if it is
/// another.
fn handles(configuration: &Configuration, legs: usize) -> Vec<Handle> {
    let points = configuration.points(2);
    let [start, second, third] = points[..] else {
        return Vec::new();
    };
    let last = configuration.points(legs).last().copied();
    let last = last.filter(|last| legs > 2 && last.is_finite());
    let last = last.map(|at| Handle {
        at,
        label: "length ratio and turning angle, by the last point",
        sets: Sets::LastPoint {
            ratio: RATIO.name,
            angle: ANGLE.name,
            configuration: *configuration,
            legs,
        },
    });
    let first = [
        Handle {
            at: start,
            label: "start",
            sets: Sets::Point(START.name),
        },
        Handle {
            at: second,
            label: "first leg",
            sets: Sets::Vector {
                parameter: FIRST_LEG.name,
                from: start,
            },
        },
        Handle {
            at: third,
            label: "length ratio and turning angle",
            sets: Sets::RatioAndAngle {
                ratio: RATIO.name,
                angle: ANGLE.name,
                from: second,
                base: configuration.first_leg,
                normal: configuration.binormal(),
            },
        },
    ];
    first.into_iter().chain(last).collect()
}
