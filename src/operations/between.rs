//! Segments between two ends.

use std::ops::Bound;

use glam::{DVec2, DVec3};

use super::amount::Amount;
use super::error::OperationError;
use super::handle::{Handle, Sets};
use super::inputs::Inputs;
use super::lists::given;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{ANY, Choice, Kind, POSITIVE, Parameter};
use super::time_limit::{TIME_LIMIT, best_so_far, limited, why_ended};
use super::value::Value;
use super::values::Values;
use crate::document::{Curve, Edit};
use crate::geometry::between::{BetweenError, Ends, Segment, SegmentKind, between};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::features::Verdict;
use crate::geometry::parameters::{Number, Quantity};
use crate::geometry::references::ReferenceForm;
use crate::geometry::{BezierPolygon, End, FloatPolygon, MAX_DEGREE, Progress, significant};

/// The length of the arrows for directions that curves give, in chords.
const ARROW: f64 = 0.25;

/// The ends if nothing is chosen.
const ENDS: Ends = Ends {
    points: [DVec2::ZERO, DVec2::new(10.0, 0.0)],
    directions: [DVec2::new(2.0, 2.0), DVec2::new(3.0, -1.5)],
    curvatures: [None; 2],
};

/// The clothoid's slope α.
const CLOTHOID: f64 = -1.0;

const KIND: Parameter = Parameter {
    name: "kind",
    label: "Kind",
    help: "Kind of the segment; any: some curve with monotone curvature",
    kind: Kind::Choice {
        options: &[
            Choice {
                name: "log-aesthetic",
                label: "Log-aesthetic",
                parameters: &["alpha"],
            },
            Choice {
                name: "superspiral",
                label: "Superspiral",
                parameters: &["a", "b", "c"],
            },
            Choice::new("any", "Any monotone"),
            Choice::new("clothoid", "Clothoid"),
        ],
        default: 0,
    },
};

const ALPHA: Parameter = Parameter {
    name: "alpha",
    label: "Slope α",
    help: "Slope of the logarithmic curvature graph: −1 clothoid, 1 logarithmic spiral, 2 circle involute",
    kind: Kind::optional_number(ANY, |_| "−1, or from the curvatures"),
};

const A: Parameter = spiral("a", "Superspiral a", 0.5);
const B: Parameter = spiral("b", "Superspiral b", 1.0);
const C: Parameter = spiral("c", "Superspiral c", 1.5);

/// A number of a superspiral.
const fn spiral(name: &'static str, label: &'static str, default: f64) -> Parameter {
    Parameter {
        name,
        label,
        help: "Of a superspiral: radius ₂F₁(a, b; c; −ψ) at direction angle ψ, with a > 0 and c > b > 0",
        kind: Kind::Real(Number {
            from: Bound::Excluded(Amount::Number(0.0)),
            to: Bound::Included(Amount::Number(20.0)),
            default: Amount::Number(default),
            quantity: Quantity::Number,
        }),
    }
}

const FROM: Parameter = Parameter {
    name: "from",
    label: "From",
    help: "Where the segment starts",
    kind: Kind::list(2..=2, |_| "by the curves, or 0, 0"),
};

const FROM_DIRECTION: Parameter = Parameter {
    name: "from-direction",
    label: "From direction",
    help: "The direction in which it starts",
    kind: Kind::list(2..=2, |_| "by the curves, or 2, 2"),
};

const FROM_CURVATURE: Parameter = Parameter {
    name: "from-curvature",
    label: "From curvature",
    help: "The curvature with which it starts, positive where it turns left",
    kind: Kind::optional_number(ANY, |_| "free"),
};

const TO: Parameter = Parameter {
    name: "to",
    label: "To",
    help: "Where the segment ends",
    kind: Kind::list(2..=2, |_| "by the curves, or 10, 0"),
};

const TO_DIRECTION: Parameter = Parameter {
    name: "to-direction",
    label: "To direction",
    help: "The direction in which it ends",
    kind: Kind::list(2..=2, |_| "by the curves, or 3, -1.5"),
};

const TO_CURVATURE: Parameter = Parameter {
    name: "to-curvature",
    label: "To curvature",
    help: "The curvature with which it ends, positive where it turns left",
    kind: Kind::optional_number(ANY, |_| "free"),
};

const CURVATURES: Parameter = Parameter {
    name: "curvatures",
    label: "Meet curvatures",
    help: "Whether the curvatures of the chosen curves are met too, where none is given",
    kind: Kind::Switch { default: false },
};

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree of the float polygon",
    kind: Kind::whole(3, MAX_DEGREE, 5),
};

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "How far the curve may be from the true segment",
    kind: Kind::optional_number(POSITIVE, |_| "1e-6 of its length"),
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "between",
    label: "Segment between two ends",
    help: "Join two points with directions by a segment of monotone curvature",
    inputs: Inputs::UpToTwo,
    each: false,
    parameters: &[
        KIND,
        ALPHA,
        A,
        B,
        C,
        FROM,
        FROM_DIRECTION,
        FROM_CURVATURE,
        TO,
        TO_DIRECTION,
        TO_CURVATURE,
        CURVATURES,
        DEGREE,
        TOLERANCE,
        TIME_LIMIT,
    ],
    check: |_| Ok(()),
    unused,
    run,
};

/// Each kind has numbers of its own.
fn unused(values: &Values) -> &'static [&'static str] {
    values.choice(
        &KIND,
        &[
            &[A.name, B.name, C.name][..],
            &[ALPHA.name],
            &[ALPHA.name, A.name, B.name, C.name],
            &[ALPHA.name, A.name, B.name, C.name],
        ],
    )
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let ends = ends(input, values);
    let degree = values.whole(&DEGREE);
    let tolerance = given(values, &TOLERANCE);
    let alpha = given(values, &ALPHA);
    let kinds = [
        SegmentKind::LogAesthetic { alpha },
        SegmentKind::Superspiral {
            values: [A, B, C].map(|parameter| values.real(&parameter)),
        },
        SegmentKind::AnyMonotone,
        SegmentKind::LogAesthetic {
            alpha: Some(CLOTHOID),
        },
    ];
    let kind = values.choice(&KIND, &kinds);
    let search = limited(progress, values);
    let mut outcome = match between(&ends, kind, degree, tolerance, &search) {
        Ok(segment) => {
            let mut outcome = made(input, &segment);
            let late = search.is_late() && !segment.is_found();
            let late = late.then(|| best_so_far(&search, values));
            outcome.remarks.extend(late);
            outcome
        }
        Err(BetweenError::Cancelled) if search.is_late() => {
            let why = why_ended(&search, values);
            let failed = Requirement::Failed { left: None };
            Outcome {
                requirements: vec![(input.document().next_id(), vec![failed])],
                remarks: vec![format!("{why} before a segment was found: allow more")],
                ..Outcome::unchanged(Deviation::Unmeasured)
            }
        }
        Err(BetweenError::Cancelled) => return Err(OperationError::Cancelled),
        Err(
            error @ (BetweenError::NoChord
            | BetweenError::NoDirection
            | BetweenError::ChordOutOfRange { .. }),
        ) => {
            return Err(error.into());
        }
        Err(error) => {
            let failed = Requirement::Failed { left: None };
            Outcome {
                requirements: vec![(input.document().next_id(), vec![failed])],
                remarks: vec![capitalised(&error.to_string())],
                ..Outcome::unchanged(Deviation::Unmeasured)
            }
        }
    };
    outcome.annotations = annotations(&ends);
    outcome.handles = handles(&ends);
    Ok(outcome)
}

/// Add the segment's curve, and tell its figures.
fn made(input: &Operands, segment: &Segment) -> Outcome {
    // Any monotone curve is its own true segment.
    let mut outcome = Outcome::unchanged(match segment.parts[..] {
        [] => Deviation::Exact,
        _ => Deviation::Measured(segment.deviation),
    });
    outcome.requirements = vec![(input.document().next_id(), segment.requirements.clone())];
    let name = input.document().free_name("segment 1");
    let curve = Curve::new(name, segment.polygon.clone()).in_group(input.group(None));
    outcome.edits = vec![Edit::Add(Box::new(curve))];
    outcome.figures = figures(segment);
    outcome.remarks = remarks(segment);
    outcome
}

fn figures(segment: &Segment) -> Vec<Figure> {
    let list = |name, label, numbers: Vec<f64>| Figure {
        name,
        label,
        value: Value::List(numbers),
        quantity: Quantity::Number,
    };
    let mut figures = vec![
        Figure::length("length", "Length", segment.length),
        Figure::count("segments", "Segments", segment.polygon.segments()),
        list(
            "curvatures",
            "Curvatures at the ends",
            End::BOTH.map(|end| curvature(&segment.polygon, end)).into(),
        ),
    ];
    for (parameter, name, label) in [("alpha", "alpha", "α"), ("lambda", "lambda", "Λ")] {
        let found = segment
            .parts
            .iter()
            .map(|part| shape(part.curve.form(), parameter));
        let found: Option<Vec<f64>> = found.collect();
        let found = found.filter(|found| !found.is_empty());
        figures.extend(found.map(|found| list(name, label, found)));
    }
    figures
}

/// A number of the standard form of a part; `None` if it has no such number.
fn shape(form: &ReferenceForm, name: &str) -> Option<f64> {
    let ReferenceForm::Analytic(form) = form else {
        return None;
    };
    let parameters = form.kind().parameters.iter();
    let mut values = parameters.zip(form.values());
    let (_, value) = values.find(|(parameter, _)| parameter.name == name)?;
    Some(*value)
}

fn remarks(segment: &Segment) -> Vec<String> {
    if segment.straight {
        return vec![
            "The ends lie on a straight line, and so does the segment: its curvature is 0 but for rounding"
                .to_owned(),
        ];
    }
    let mut remarks: Vec<String> = Vec::new();
    match &segment.parts[..] {
        [] => {}
        [part] => remarks.push(format!("The true segment is {}", part.curve)),
        parts => {
            let texts: Vec<String> = parts.iter().map(|part| part.curve.to_string()).collect();
            remarks.push(format!(
                "{} segments that meet with one curvature: {}",
                parts.len(),
                texts.join(" and ")
            ));
        }
    }
    if segment.deviation > segment.tolerance {
        remarks.push(format!(
            "The curve is {} off the true segment, and {} is allowed: allow more, or change the ends or the slope so that the curvature changes less",
            significant(segment.deviation, 3),
            significant(segment.tolerance, 3)
        ));
    }
    if segment.arc && segment.monotone != Verdict::Proved {
        remarks.push("The ends ask for a circular arc: its curvature is constant, and that of the curve, which is polynomial, wobbles slightly about it. An arc need not be monotone to count as reached".to_owned());
    } else if segment.monotone != Verdict::Proved {
        remarks.push(match curvatures_agree(segment) {
            true => "The ends ask almost for a circular arc: its curvature hardly changes, and that of a polynomial curve rises and falls".to_owned(),
            false if segment.monotone == Verdict::Disproved => {
                "The curvature is not monotone: try another degree, or ends whose curvatures differ less".to_owned()
            }
            false => "The curvature is not proved to be monotone: try another degree, or ends whose curvatures differ less".to_owned(),
        });
    }
    remarks
}

/// Whether both ends have almost the same curvature, as those of an arc have.
fn curvatures_agree(segment: &Segment) -> bool {
    /// The relative difference below which the curvature of an approximation may well wobble.
    const ALMOST: f64 = 1e-3;
    let [first, last] = End::BOTH.map(|end| curvature(&segment.polygon, end));
    (first - last).abs() <= ALMOST * first.abs()
}

fn curvature(polygon: &FloatPolygon, end: End) -> f64 {
    polygon.end_jet(end).signed_curvature()
}

/// The ends that are given; those that are not are the chosen curves'.
fn ends(input: &Operands, values: &Values) -> Ends {
    let offered = offered(input);
    let pair = |parameter, offered: DVec2| match *values.list(parameter) {
        [x, y] => DVec2::new(x, y),
        _ => offered,
    };
    let curvature = |parameter, offered: Option<f64>| {
        let offered = offered.filter(|_| *values.get(&CURVATURES) == Value::Switch(true));
        given(values, parameter).or(offered)
    };
    Ends {
        points: [pair(&FROM, offered.points[0]), pair(&TO, offered.points[1])],
        directions: [
            pair(&FROM_DIRECTION, offered.directions[0]),
            pair(&TO_DIRECTION, offered.directions[1]),
        ],
        curvatures: [
            curvature(&FROM_CURVATURE, offered.curvatures[0]),
            curvature(&TO_CURVATURE, offered.curvatures[1]),
        ],
    }
}

/// The ends that the chosen curves offer, open ones in the plane: of two those that are nearest to each
/// other; from the end of one the segment goes on.
fn offered(input: &Operands) -> Ends {
    let polygons = input.curves().iter().map(|(_, curve)| &curve.polygon);
    let polygons = polygons.filter(|polygon| !polygon.is_periodic() && polygon.is_planar());
    let polygons: Vec<&FloatPolygon> = polygons.collect();
    match polygons[..] {
        [] => ENDS,
        [curve] => going_on(curve),
        [first, second, ..] => {
            let pairs = End::BOTH
                .into_iter()
                .flat_map(|a| End::BOTH.map(|b| (a, b)));
            let pairs = pairs.map(|(a, b)| joining(first, a, second, b));
            let distance = |ends: &Ends| ends.points[0].distance(ends.points[1]);
            let nearest = pairs.min_by(|a, b| distance(a).total_cmp(&distance(b)));
            nearest.unwrap_or(ENDS)
        }
    }
}

/// The ends of a segment that goes on from the end of a curve, to the side that the curve bends to, half as far as the
/// curve is large: [`ENDS`], moved there.
fn going_on(curve: &FloatPolygon) -> Ends {
    let jet = curve.end_jet(End::Finish);
    let bends_left = jet.signed_curvature() > 0.0;
    let tangent = jet.tangent().unwrap_or(DVec3::X).truncate();
    let side = if bends_left { -1.0 } else { 1.0 };
    let seen = |it: DVec2| DVec2::new(it.x, side * it.y);
    let turn = seen(ENDS.directions[0]).normalize().angle_to(tangent);
    let scale = 0.5 * BezierPolygon::from_float(curve).size() / ENDS.points[1].length();
    let moved = |it: DVec2| scale * DVec2::from_angle(turn).rotate(seen(it));
    let start = jet.point.truncate();
    let curvature = Some(jet.signed_curvature()).filter(|it| it.is_finite());
    Ends {
        points: ENDS.points.map(|point| start + moved(point)),
        directions: ENDS.directions.map(moved),
        curvatures: [curvature, None],
    }
}

/// The ends of a segment that goes on from an end of one curve, and goes over into an end of another.
fn joining(first: &FloatPolygon, leaves: End, second: &FloatPolygon, arrives: End) -> Ends {
    let (from, to) = (first.end_jet(leaves), second.end_jet(arrives));
    // Passed through the other way, a curve's direction and signed curvature change their signs.
    let sides = [
        if leaves == End::Finish { 1.0 } else { -1.0 },
        if arrives == End::Start { 1.0 } else { -1.0 },
    ];
    let jets = [from, to];
    let points = jets.map(|jet| jet.point.truncate());
    let length = ARROW * points[0].distance(points[1]);
    let at = |index: usize| {
        let tangent = jets[index].tangent().unwrap_or(DVec3::X);
        sides[index] * length * tangent.truncate()
    };
    let curvature = |index: usize| sides[index] * jets[index].signed_curvature();
    Ends {
        points,
        directions: [at(0), at(1)],
        curvatures: [0, 1].map(|index| Some(curvature(index)).filter(|it| it.is_finite())),
    }
}

/// An arrow at each end.
fn annotations(ends: &Ends) -> Vec<Annotation> {
    let pairs = ends.points.into_iter().zip(ends.directions);
    let arrows = pairs.map(|(point, direction)| Annotation::Arrow {
        from: point.extend(0.0),
        to: (point + direction).extend(0.0),
    });
    arrows.collect()
}

/// The points, and the tips of the arrows.
fn handles(ends: &Ends) -> Vec<Handle> {
    let parameters = [(&FROM, &FROM_DIRECTION), (&TO, &TO_DIRECTION)];
    let ends = ends.points.into_iter().zip(ends.directions);
    let pairs = ends
        .zip(parameters)
        .map(|((point, direction), (at, towards))| {
            let from = point.extend(0.0);
            [
                Handle {
                    at: from,
                    label: at.label,
                    sets: Sets::Point(at.name),
                },
                Handle {
                    at: from + direction.extend(0.0),
                    label: towards.label,
                    sets: Sets::Vector {
                        parameter: towards.name,
                        from,
                    },
                },
            ]
        });
    pairs.flatten().collect()
}

fn capitalised(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters
        .next()
        .map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + characters.as_str()
}
