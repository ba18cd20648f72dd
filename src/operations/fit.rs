//! A curve through the middle of points.

use glam::{DVec2, DVec3};

use super::amount::Amount;
use super::error::OperationError;
use super::fit_piece::{Piece, features, pieces};
use super::fit_warnings::warnings;
use super::inputs::Inputs;
use super::lists::{check_parity, given, given_count};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{ANY, Choice, Kind, POSITIVE, Parameter};
use super::time_limit::{TIME_LIMIT, best_so_far, limited};
use super::value::Value;
use super::values::Values;
use crate::document::{Curve, Edit};
use crate::geometry::approximation::{self, FitRequest, fit_points};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::fitting::{CountedPoints, Extrema, FitError, Fitted, PlaneFit, SymmetryAxis};
use crate::geometry::parameters::{OutOfRange, Quantity};
use crate::geometry::{MAX_DEGREE, Progress, counted, significant};

/// Points that are off a symmetric curve by more than so many tolerances are not symmetric.
const LOPSIDED: f64 = 10.0;

/// So many corners are named.
const NAMED: usize = 12;

/// A fit in space is far off if the nearest one with as many vertices is nearer by this factor.
const FAR: f64 = 1.3;

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree of the float polygon",
    kind: Kind::whole_of(
        Amount::Number(1.0),
        Amount::Number(MAX_DEGREE as f64),
        Amount::Of {
            words: "5, or less where there are few points",
            value: |input| Ok(input.points().len().saturating_sub(1).clamp(1, 5) as f64),
        },
    ),
};

const COUNT: Parameter = Parameter {
    name: "count",
    label: "Vertices",
    help: "The number of vertices",
    kind: Kind::optional_count(usize::MAX, false, |_| "as many as it takes"),
};

const MOST: Parameter = Parameter {
    name: "max-vertices",
    label: "Most vertices",
    help: "The most vertices that are tried",
    kind: Kind::optional_count(usize::MAX, false, |_| "half the number of points"),
};

const EXTREMA: Parameter = Parameter {
    name: "extrema",
    label: "Curvature extrema",
    help: "How many extrema of the curvature the curve has, proved",
    kind: Kind::count_or(&["fewest"], |_| "the fewest for the tolerance"),
};

const INFLECTIONS: Parameter = Parameter {
    name: "inflections",
    label: "Inflections",
    help: "How many inflections a planar curve has, in space zeros of the torsion, proved",
    kind: Kind::optional_count(usize::MAX, false, |_| "any number"),
};

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "How far points may be from the curve; it has as few extrema as this allows",
    kind: Kind::optional_number(POSITIVE, |_| "5e-4 of the size, or 3 times the noise"),
};

const ENDS: Parameter = Parameter {
    name: "ends",
    label: "Ends",
    help: "Whether the curve begins and ends just at the outer points",
    kind: Kind::Choice {
        options: &[Choice::new("free", "Free"), Choice::new("exact", "Exact")],
        default: 0,
    },
};

const PERIODIC: Parameter = Parameter {
    name: "periodic",
    label: "Periodic",
    help: "Close the curve: the first point follows the last one",
    kind: Kind::Switch { default: false },
};

/// Words of [`OUTLIERS`].
const ISOLATED: &str = "isolated";
const KEEP: &str = "keep";

const OUTLIERS: Parameter = Parameter {
    name: "outliers",
    label: "Outliers",
    help: "Points that do not count: isolated ones far off, or those with these numbers, from 0",
    kind: Kind::List {
        count: 1..=usize::MAX,
        whole: true,
        limits: ANY,
        quantity: Quantity::Number,
        words: &[ISOLATED, KEEP],
        none: |_| "isolated; keep with a tolerance",
        in_space: false,
    },
};

const SYMMETRIC: Parameter = Parameter {
    name: "symmetric",
    label: "Symmetric",
    help: "The axis in which an open curve is its own mirror image, bit for bit",
    kind: Kind::Choice {
        options: &[
            Choice::new("no", "No"),
            Choice::new("x", "In the x axis"),
            Choice::new("y", "In the y axis"),
        ],
        default: 0,
    },
};

const SPLIT: Parameter = Parameter {
    name: "split-corners",
    label: "Split corners",
    help: "Make one curve for each piece between corners of the points",
    kind: Kind::Switch { default: false },
};

/// Any direction of the plane.
const PLANE: std::ops::RangeInclusive<usize> = 2..=2;

const START_DIRECTION: Parameter = Parameter {
    name: "start-direction",
    label: "Start direction",
    help: "The direction at the start, along the curve",
    kind: Kind::list(PLANE, |_| "free"),
};

const START_CURVATURE: Parameter = Parameter {
    name: "start-curvature",
    label: "Start curvature",
    help: "The curvature at the start, positive where it turns left",
    kind: Kind::optional_number(ANY, |_| "free"),
};

const END_DIRECTION: Parameter = Parameter {
    name: "end-direction",
    label: "End direction",
    help: "The direction at the end, along the curve",
    kind: Kind::list(PLANE, |_| "free"),
};

const END_CURVATURE: Parameter = Parameter {
    name: "end-curvature",
    label: "End curvature",
    help: "The curvature at the end, positive where it turns left",
    kind: Kind::optional_number(ANY, |_| "free"),
};

/// What counts in the plane alone.
const IN_PLANE: [&Parameter; 8] = [
    &ENDS,
    &PERIODIC,
    &SYMMETRIC,
    &SPLIT,
    &START_DIRECTION,
    &START_CURVATURE,
    &END_DIRECTION,
    &END_CURVATURE,
];

/// The operation: its description, and how it is run.
pub static OPERATION: Operation = Operation {
    name: "fit",
    label: "Fit points",
    help: "Draw a curve with few curvature extrema through the middle of points",
    inputs: Inputs::Points,
    each: true,
    parameters: &[
        DEGREE,
        EXTREMA,
        TOLERANCE,
        COUNT,
        MOST,
        INFLECTIONS,
        ENDS,
        START_DIRECTION,
        START_CURVATURE,
        END_DIRECTION,
        END_CURVATURE,
        PERIODIC,
        SYMMETRIC,
        SPLIT,
        OUTLIERS,
        TIME_LIMIT,
    ],
    check: |_| Ok(()),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    if is_in_space(input) {
        return in_space(input, values, progress);
    }
    let points = input.points().iter().map(|point| point.truncate());
    let points: Vec<DVec2> = points.collect();
    let asked = PlaneFit {
        weights: input.weights().map(<[f64]>::to_vec),
        ..asked(points.len(), values)?
    };
    let progress = limited(progress, values);
    let (pieces, corners) = pieces(&points, asked.periodic, values.switch(&SPLIT));
    let asked = PlaneFit {
        lists_trade_off: pieces.len() == 1,
        ..asked
    };
    let fitted = fitted(&pieces, &points, &asked, &progress)?;
    let (requests, fitted): (Vec<PlaneFit>, Vec<Fitted>) = fitted.into_iter().unzip();
    let requirements = pieces.iter().zip(&requests).zip(&fitted);
    let requirements =
        requirements.map(|((piece, asked), found)| piece.requirements(&points, asked, found));
    let ids = input.document().next_ids();
    let mut outcome = outcome(input, values, &asked, &fitted, &corners);
    if fitted.iter().any(|found| found.stopped) {
        let fewest = asked.extrema == Extrema::Fewest;
        let more = if fewest { "; fewer extrema may do" } else { "" };
        outcome.remarks.push(best_so_far(&progress, values) + more);
    }
    let is_held = |own: &PlaneFit| own.exact_ends != asked.exact_ends;
    if let ([own], [piece]) = (&requests[..], &pieces[..]) {
        let remark = match piece.is_outer {
            [true, true] if is_held(own) => {
                Some("The ends are exact: with free ends the curve crosses itself")
            }
            [false, false] => {
                Some("No corner splits the points: with “Periodic” they close smoothly")
            }
            _ => None,
        };
        outcome.remarks.extend(remark.map(str::to_owned));
    }
    Ok(Outcome {
        requirements: ids.zip(requirements).collect(),
        ..outcome
    })
}

/// Fit the pieces, each in a share of the time that is left. Short ones come first: what they leave the long ones have.
fn fitted(
    pieces: &[Piece],
    points: &[DVec2],
    asked: &PlaneFit,
    progress: &Progress,
) -> Result<Vec<(PlaneFit, Fitted)>, OperationError> {
    let count = |piece: &Piece| piece.numbers.len();
    let mut order: Vec<(usize, &Piece)> = pieces.iter().enumerate().collect();
    order.sort_by_key(|(_, piece)| count(piece));
    let mut left: usize = pieces.iter().map(count).sum();
    let mut fitted = Vec::with_capacity(pieces.len());
    for (place, (index, piece)) in order.into_iter().enumerate() {
        let share = |place: usize| place as f64 / pieces.len() as f64;
        let own = progress.part(share(place), share(place + 1));
        let own = own.hurried(count(piece) as f64 / left.max(1) as f64);
        left -= count(piece);
        let found = piece.fit(points, asked, &own.of_curve(index));
        let found = found.map_err(|error| piece.told(error, index, pieces.len()))?;
        fitted.push((index, found));
    }
    fitted.sort_by_key(|(index, _)| *index);
    Ok(fitted.into_iter().map(|(_, found)| found).collect())
}

/// List the points that a fit with some values leaves out, by their numbers from 0.
///
/// # Errors
/// [`OperationError`] if the values do not suit the points.
pub fn left_out(input: &Operands, values: &Values) -> Result<Vec<usize>, OperationError> {
    let pieces = counted_pieces(input, values)?.into_iter();
    let left_out = pieces.flat_map(|(piece, counted)| {
        let left_out = counted.outliers.into_iter();
        left_out.map(move |number| piece.numbers[number])
    });
    let mut left_out: Vec<usize> = left_out.collect();
    // A corner belongs to two pieces.
    left_out.sort_unstable();
    left_out.dedup();
    Ok(left_out)
}

/// Say that the tolerance lies below the noise of the points, and what to expect of the search then.
pub fn expectation(input: &Operands, values: &Values) -> Option<String> {
    // Estimating takes time, and without a tolerance there is nothing to compare.
    let tolerance = given(values, &TOLERANCE)?;
    let pieces = counted_pieces(input, values).ok()?;
    let noise = pieces
        .iter()
        .map(|(_, counted)| counted.noise_of_counting());
    let remark = remark_on_noise(Some(tolerance), noise.fold(0.0, f64::max))?;
    Some(format!("{remark}: expect many extrema, or a miss"))
}

/// The pieces of the points, and which points of each count.
fn counted_pieces(
    input: &Operands,
    values: &Values,
) -> Result<Vec<(Piece, CountedPoints)>, OperationError> {
    let points = input.points();
    let asked = asked(points.len(), values)?;
    let in_space = is_in_space(input);
    let pieces = pieces_of(input, values).into_iter();
    let counted = pieces.map(|piece| {
        let own = piece.of(points);
        let given = asked.outliers.as_ref().map(|numbers| piece.own(numbers));
        let weights = input.weights().map(|weights| piece.of(weights));
        let closes = asked.periodic && piece.is_outer == [true; 2] && !in_space;
        let counted = CountedPoints::new(&own, closes, given.as_deref(), weights.as_deref());
        (piece, counted)
    });
    Ok(counted.collect())
}

/// Count the curves that a fit with some values makes.
pub fn curves(input: &Operands, values: &Values) -> usize {
    pieces_of(input, values).len()
}

/// The parameter with the value that leaves a point out too, or takes it back: a list of those left out. Points of
/// weight 0 need not be in it.
///
/// # Errors
/// As [`left_out`].
pub fn with_point_switched(
    input: &Operands,
    values: &Values,
    point: usize,
) -> Result<(&'static str, Value), OperationError> {
    let mut numbers = left_out(input, values)?;
    numbers.retain(|number| *number == point || counts(input, *number));
    match numbers.binary_search(&point) {
        Ok(place) => drop(numbers.remove(place)),
        Err(place) => numbers.insert(place, point),
    }
    let keep = [ISOLATED, KEEP].iter().position(|word| *word == KEEP);
    let value = match keep.filter(|_| numbers.is_empty()) {
        Some(keep) => Value::Choice(keep),
        None => Value::List(numbers.into_iter().map(|number| number as f64).collect()),
    };
    Ok((OUTLIERS.name, value))
}

/// Whether a point counts by its weight, if it has one.
pub fn counts(input: &Operands, point: usize) -> bool {
    let weight = input.weights().and_then(|weights| weights.get(point));
    weight.is_none_or(|weight| *weight != 0.0)
}

fn is_in_space(input: &Operands) -> bool {
    input.points().iter().any(|point| point.z != 0.0)
}

/// The pieces of the points, one for each curve.
fn pieces_of(input: &Operands, values: &Values) -> Vec<Piece> {
    let flat = input.points().iter().map(|point| point.truncate());
    let flat: Vec<DVec2> = flat.collect();
    match is_in_space(input) {
        true => vec![Piece::whole(flat.len())],
        false => pieces(&flat, values.switch(&PERIODIC), values.switch(&SPLIT)).0,
    }
}

/// Tell a cancellation from other errors.
fn told(error: FitError) -> OperationError {
    match error {
        FitError::Cancelled => OperationError::Cancelled,
        error => error.into(),
    }
}

/// What is asked for in the plane.
fn asked(points: usize, values: &Values) -> Result<PlaneFit, OperationError> {
    let direction = |parameter: &Parameter| {
        let numbers = values.list(parameter);
        let [x, y] = *numbers else { return Ok(None) };
        match DVec2::new(x, y).try_normalize() {
            Some(direction) => Ok(Some(direction)),
            None => Err(OperationError::from(OutOfRange {
                label: parameter.label,
                value: "0, 0".into(),
                needed: "no direction: give one that is not 0".into(),
            })),
        }
    };
    let tolerance = given(values, &TOLERANCE);
    let left_out = values.list(&OUTLIERS);
    if let Some(beyond) = left_out.iter().find(|it| **it >= points as f64) {
        return Err(OutOfRange {
            label: OUTLIERS.label,
            value: beyond.to_string().into(),
            needed: format!("below {points}, the number of points,").into(),
        }
        .into());
    }
    let outliers = match values.word(&OUTLIERS) {
        Some(KEEP) => Some(Vec::new()),
        Some(_) => None,
        None if left_out.is_empty() => tolerance.map(|_| Vec::new()),
        None => Some(left_out.iter().map(|number| *number as usize).collect()),
    };
    let exact = values.choice(&ENDS, &[false, true]);
    Ok(PlaneFit {
        degree: values.whole(&DEGREE),
        periodic: values.switch(&PERIODIC),
        of_curve: false,
        count: vertices(points, values)?,
        most: given_count(values, &MOST),
        extrema: given_count(values, &EXTREMA).map_or(Extrema::Fewest, Extrema::Exactly),
        inflections: given_count(values, &INFLECTIONS),
        tolerance,
        exact_ends: [exact, exact],
        directions: [direction(&START_DIRECTION)?, direction(&END_DIRECTION)?],
        curvatures: [
            given(values, &START_CURVATURE),
            given(values, &END_CURVATURE),
        ],
        outliers,
        mirror: mirror(values)?,
        lists_trade_off: false,
        weights: None,
    })
}

/// The axis in which the curve is its own mirror image.
///
/// # Errors
/// If it cannot be with the other values.
fn mirror(values: &Values) -> Result<Option<SymmetryAxis>, OperationError> {
    let mirror = values.choice(
        &SYMMETRIC,
        &[None, Some(SymmetryAxis::X), Some(SymmetryAxis::Y)],
    );
    let other = [&PERIODIC, &SPLIT].into_iter().find(|it| values.switch(it));
    if let (Some(_), Some(other)) = (mirror, other) {
        return Err(OperationError::Exclude {
            first: SYMMETRIC.label,
            second: other.label,
        });
    }
    if mirror.is_some() {
        check_parity(values, [(&EXTREMA, 1), (&INFLECTIONS, 0)])?;
    }
    Ok(mirror)
}

/// The number of vertices asked for, at most as many as there are points.
fn vertices(points: usize, values: &Values) -> Result<Option<usize>, OperationError> {
    match given_count(values, &COUNT) {
        Some(count) if count > points => Err(OutOfRange {
            label: COUNT.label,
            value: count.to_string().into(),
            needed: format!("at most {points}, the number of points,").into(),
        }
        .into()),
        count => Ok(count),
    }
}

fn outcome(
    input: &Operands,
    values: &Values,
    asked: &PlaneFit,
    fitted: &[Fitted],
    corners: &[usize],
) -> Outcome {
    let name = |index: usize| match fitted.len() {
        1 => "fit".to_owned(),
        _ => format!("fit {}", index + 1),
    };
    let curves = fitted.iter().enumerate().map(|(index, found)| {
        let name = input.document().free_name(&name(index));
        let curve = Curve::new(name, found.polygon.clone());
        Edit::Add(Box::new(curve.in_group(input.group(None))))
    });
    let marked = fitted.iter().flat_map(|found| &found.outliers);
    let marked = marked.filter_map(|(index, _)| input.points().get(*index));
    let worst = |of: fn(&Fitted) -> f64| fitted.iter().map(of).fold(0.0, f64::max);
    let warnings = of_pieces(fitted, |found| warnings(asked, found));
    let mut remarks = of_pieces(fitted, |found| remarks(asked, found));
    if !corners.is_empty() && !values.switch(&SPLIT) {
        let named: Vec<String> = corners.iter().take(NAMED).map(usize::to_string).collect();
        let more = match corners.len().saturating_sub(NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        remarks.push(format!(
            "The points have corners at {}{more}: with “Split corners” each piece becomes a curve",
            named.join(", ")
        ));
    }
    Outcome {
        edits: curves.collect(),
        figures: figures(fitted),
        warnings,
        remarks,
        annotations: marked.map(|point| Annotation::Point(*point)).collect(),
        ..Outcome::unchanged(Deviation::FromPoints(worst(|found| found.deviation)))
    }
}

fn figures(fitted: &[Fitted]) -> Vec<Figure> {
    let sum = |of: fn(&Fitted) -> usize| fitted.iter().map(of).sum();
    let worst = |of: fn(&Fitted) -> f64| fitted.iter().map(of).fold(0.0, f64::max);
    let outliers = fitted.iter().flat_map(|found| &found.outliers);
    let mut outliers: Vec<usize> = outliers.map(|(index, _)| *index).collect();
    // A corner belongs to two pieces.
    outliers.dedup();
    let rows = |found: &Fitted| {
        let rows = found.trade_off.iter();
        let rows = rows.map(|it| vec![it.extrema as f64, it.vertices as f64, it.rms, it.largest]);
        rows.collect::<Vec<_>>()
    };
    let least = fitted.iter().find_map(|found| found.least_extrema);
    let mut figures = vec![
        Figure::count(
            "vertices",
            "Vertices",
            sum(|it| it.polygon.vertices().len()),
        ),
        Figure::count("extrema", "Curvature extrema", sum(|it| it.extrema)),
        Figure::count("inflections", "Inflections", sum(|it| it.inflections)),
        Figure::length("rms", "Off on average (RMS)", worst(|it| it.rms)),
        Figure::length("largest", "Largest distance", worst(|it| it.largest)),
        Figure::length("noise", "Estimated noise", worst(|it| it.noise)),
        Figure::count("outliers", "Outliers", outliers.len()),
        Figure::indices("outlying_points", "Outlying points", &outliers),
    ];
    figures.extend(least.map(|least| {
        let label = "Extrema that keep the tolerance";
        Figure::count("least_extrema", label, least)
    }));
    if let [found] = fitted {
        let columns = &["extrema", "vertices", "rms", "largest"];
        figures.push(Figure::table(
            "trade_off",
            "Trade-off",
            columns,
            rows(found),
        ));
    }
    figures
}

/// Fewer extrema are advised where they bring the points nearer than this share of their distance.
const NEARER: f64 = 0.8;

/// What is to say of each piece, named where there are several.
fn of_pieces(fitted: &[Fitted], said: impl Fn(&Fitted) -> Vec<String>) -> Vec<String> {
    let is_one = fitted.len() == 1;
    let told = fitted.iter().enumerate().flat_map(|(index, found)| {
        let told = said(found).into_iter();
        told.map(move |text| match is_one {
            true => text,
            false => format!("Piece {}: {text}", index + 1),
        })
    });
    told.collect()
}

/// What is to say beside the figures.
fn remarks(asked: &PlaneFit, found: &Fitted) -> Vec<String> {
    let mut remarks = remarks_on_points(&found.outliers, &found.repeated);
    if !found.holds {
        let has = counted(found.extrema, "curvature extremum", "curvature extrema");
        let is_wish = asked.extrema != Extrema::Fewest || asked.inflections.is_some();
        remarks.push(match is_wish {
            true => format!(
                "No curve was found that holds all that is asked for: this one has {has}. Ask for other extrema, or more vertices"
            ),
            false => format!(
                "No curve was found whose extrema are proved and that has no loop: this one has {has}. Allow more time, or more vertices"
            ),
        });
    }
    if let Some(tolerance) = asked.tolerance.filter(|it| found.deviation > *it) {
        let [off, tolerance] = [found.deviation, tolerance].map(|length| significant(length, 3));
        let more = match (found.least_extrema, asked.extrema) {
            (Some(least), _) => {
                format!("with {} it is kept", counted(least, "extremum", "extrema"))
            }
            (None, Extrema::Exactly(_)) => "allow more, or another number of extrema".to_owned(),
            (None, Extrema::Fewest) if found.stopped => "allow more time, or more".to_owned(),
            (None, Extrema::Fewest) => "allow more".to_owned(),
        };
        remarks.push(format!(
            "One point is {off} off the curve, the tolerance is {tolerance}: {more}"
        ));
    } else if asked.tolerance.is_none() && asked.extrema == Extrema::Fewest {
        let tolerance = significant(found.tolerance, 3);
        if found.deviation > found.tolerance {
            let off = significant(found.deviation, 3);
            remarks.push(format!(
                "Nothing found keeps {tolerance}, 5e-4 of the size or 3 times the noise: one point is {off} off"
            ));
        }
    }
    if let Extrema::Exactly(number) = asked.extrema {
        let fewer = found.trade_off.iter().filter(|it| it.extrema < number);
        let best = fewer.min_by(|a, b| a.largest.total_cmp(&b.largest));
        let nearer = best.filter(|it| it.largest < NEARER * found.deviation);
        remarks.extend(nearer.map(|it| {
            let [now, then] = [found.deviation, it.largest].map(|length| significant(length, 3));
            format!(
                "A point is {now} off; with {} extrema at most {then}: ask for fewer",
                it.extrema
            )
        }));
    }
    if asked.mirror.is_some() && found.deviation > LOPSIDED * found.tolerance {
        let off = significant(found.deviation, 3);
        remarks.push(format!(
            "The points are not their own mirror image: one is {off} off the symmetric curve"
        ));
    }
    remarks.extend(remark_on_noise(asked.tolerance, found.noise));
    remarks
}

/// Tell the points that do not count.
fn remarks_on_points(outliers: &[(usize, f64)], repeated: &[usize]) -> Vec<String> {
    let mut remarks = Vec::new();
    if !outliers.is_empty() {
        let points = outliers.iter();
        let points = points.map(|(index, off)| format!("{index} ({} off)", significant(*off, 3)));
        let points: Vec<String> = points.collect();
        remarks.push(format!("Left out: {}", points.join(", ")));
    }
    if !repeated.is_empty() {
        let points = counted(repeated.len(), "point repeats", "points repeat");
        remarks.push(format!("{points} the one before: each counts once"));
    }
    remarks
}

/// Tell a tolerance below the noise.
fn remark_on_noise(tolerance: Option<f64>, noise: f64) -> Option<String> {
    let tolerance = tolerance.filter(|tolerance| *tolerance < noise)?;
    let [noise, tolerance] = [noise, tolerance].map(|length| significant(length, 3));
    Some(format!(
        "The tolerance {tolerance} is below the estimated noise {noise} of the points"
    ))
}

/// Fit a curve in space.
fn in_space(
    input: &Operands,
    values: &Values,
    progress: &Progress,
) -> Result<Outcome, OperationError> {
    let points: &[DVec3] = input.points();
    let asked = asked(points.len(), values)?;
    let asked = FitRequest {
        degree: asked.degree,
        count: asked.count,
        most: asked.most,
        extrema: asked.extrema.number(),
        torsion_zeros: asked.inflections,
        tolerance: asked.tolerance,
        outliers: asked.outliers,
        weights: input.weights().map(<[f64]>::to_vec),
    };
    let progress = limited(progress, values);
    let found = fit_points(points, &asked, &progress).map_err(told)?;
    let mut remarks = remarks_in_space(input, values, &asked, &found);
    if found.stopped {
        remarks.push(best_so_far(&progress, values));
    }
    let outliers: Vec<usize> = found.outliers.iter().map(|(index, _)| *index).collect();
    let features = features(asked.extrema, asked.torsion_zeros);
    let limit = asked.tolerance.map(|most| Requirement::Limit {
        found: found.deviation,
        most,
    });
    let requirements = features.into_iter().chain(limit).collect();
    let name = input.document().free_name("fit");
    let curve = Curve::new(name, found.polygon.clone()).in_group(input.group(None));
    let marked = outliers.iter().filter_map(|index| points.get(*index));
    Ok(Outcome {
        requirements: vec![(input.document().next_id(), requirements)],
        edits: vec![Edit::Add(Box::new(curve))],
        figures: vec![
            Figure::count("vertices", "Vertices", found.polygon.vertices().len()),
            Figure::count("extrema", "Curvature extrema", found.extrema),
            Figure::count("inflections", "Torsion zeros", found.torsion_zeros),
            Figure::length("rms", "Off on average (RMS)", found.rms),
            Figure::length("largest", "Largest distance", found.largest),
            Figure::length("noise", "Estimated noise", found.noise),
            Figure::count("outliers", "Outliers", outliers.len()),
            Figure::indices("outlying_points", "Outlying points", &outliers),
        ],
        remarks,
        annotations: marked.map(|point| Annotation::Point(*point)).collect(),
        ..Outcome::unchanged(Deviation::FromPoints(found.deviation))
    })
}

/// What is to say of a curve in space beside the figures.
fn remarks_in_space(
    input: &Operands,
    values: &Values,
    asked: &FitRequest,
    found: &approximation::Fitted,
) -> Vec<String> {
    let mut remarks = remarks_on_points(&found.outliers, &found.repeated);
    let is_missed = |asked: Option<usize>, found: usize| asked.is_some_and(|it| it != found);
    if is_missed(asked.extrema, found.extrema) {
        let has = counted(found.extrema, "curvature extremum", "curvature extrema");
        remarks.push(format!(
            "The curve has {has}: give it more vertices, or ask for other extrema"
        ));
    } else if is_missed(asked.torsion_zeros, found.torsion_zeros) {
        let has = counted(found.torsion_zeros, "zero", "zeros");
        remarks.push(format!(
            "Its torsion has {has}: give it other vertices, or ask for other inflections"
        ));
    } else if found.rms > FAR * found.rms_of_any {
        let [rms, any] = [found.rms, found.rms_of_any].map(|length| significant(length, 3));
        remarks.push(format!(
            "With any number of extrema the RMS is {any}, not {rms}"
        ));
    }
    if let Some(tolerance) = asked.tolerance.filter(|it| found.deviation > *it) {
        let [off, tolerance] = [found.deviation, tolerance].map(|length| significant(length, 3));
        remarks.push(format!(
            "One point is {off} off the curve, the tolerance is {tolerance}: allow more"
        ));
    }
    remarks.extend(remark_on_noise(asked.tolerance, found.noise));
    let is_given = |parameter: &&&Parameter| {
        let default = parameter.default(input).ok();
        default.as_ref() != Some(values.get(parameter))
    };
    let ignored: Vec<&str> = IN_PLANE
        .iter()
        .filter(is_given)
        .map(|it| it.label)
        .collect();
    if !ignored.is_empty() {
        remarks.push(format!("Of planar points alone: {}", ignored.join(", ")));
    }
    remarks
}
