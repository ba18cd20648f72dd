//! Inputs other than one curve, by operations made for the purpose.

use std::ops::Bound;
use std::path::PathBuf;

use glam::DVec3;

use super::super::apply_arguments::{Given, command_of};
use super::*;
use crate::document::{Curve, Edit};
use crate::geometry::FloatPolygon;
use crate::geometry::parameters::{Number, Quantity};
use crate::operations::{Amount, Deviation, Kind, Parameter, Values};

const LENGTH: Parameter = Parameter {
    name: "length",
    label: "Length",
    help: "How long the line is",
    kind: Kind::Real(Number {
        from: Bound::Excluded(Amount::Number(0.0)),
        to: Bound::Unbounded,
        default: Amount::Number(10.0),
        quantity: Quantity::Length,
    }),
};

const ANGLE: Parameter = Parameter {
    name: "angle",
    label: "Angle",
    help: "Where the line points",
    kind: Kind::Real(Number {
        from: Bound::Excluded(Amount::Number(-std::f64::consts::PI)),
        to: Bound::Included(Amount::Number(std::f64::consts::PI)),
        default: Amount::Number(0.0),
        quantity: Quantity::Angle,
    }),
};

const BACK: Parameter = Parameter {
    name: "back",
    label: "There and back",
    help: "Whether the line comes back",
    kind: Kind::Switch { default: false },
};

/// Makes a line from nothing but parameters.
static LINE: Operation = Operation {
    name: "line",
    label: "Line",
    help: "Make a line",
    inputs: Inputs::None,
    each: false,
    parameters: &[LENGTH, ANGLE, BACK],
    check: |_| Ok(()),
    unused: |_| &[],
    run: |_, values, _| {
        let (Value::Real(length), Value::Real(angle), Value::Switch(back)) =
            (values.get(&LENGTH), values.get(&ANGLE), values.get(&BACK))
        else {
            panic!("{values:?}");
        };
        let tip = length * DVec3::new(angle.cos(), angle.sin(), 0.0);
        let vertices = [DVec3::ZERO, tip, DVec3::ZERO];
        added(&vertices[..if *back { 3 } else { 2 }])
    },
};

/// Gives a curve the polygon of another.
static FOLLOW: Operation = Operation {
    name: "follow",
    label: "Follow",
    help: "Let a curve follow another",
    inputs: Inputs::Two,
    each: false,
    parameters: &[],
    check: |_| Ok(()),
    unused: |_| &[],
    run: |input, _, _| {
        let [(curve, _), (_, other)] = input.curves() else {
            panic!("two curves");
        };
        let polygon = other.polygon.clone();
        let curve = *curve;
        Ok(outcome(vec![Edit::SetPolygon { curve, polygon }]))
    },
};

/// Makes a polyline of a table of points.
static POLYLINE: Operation = Operation {
    name: "polyline",
    label: "Polyline",
    help: "Make a polyline",
    inputs: Inputs::Points,
    each: false,
    parameters: &[],
    check: |_| Ok(()),
    unused: |_| &[],
    run: |input, _: &Values, _| added(input.points()),
};

fn added(vertices: &[DVec3]) -> Result<Outcome, OperationError> {
    let polygon = FloatPolygon::new(1, vertices.to_vec(), None, false)?;
    let curve = Curve::new("line", polygon);
    Ok(outcome(vec![Edit::Add(Box::new(curve))]))
}

fn outcome(edits: Vec<Edit>) -> Outcome {
    Outcome {
        edits,
        deviation: Deviation::Unmeasured,
        renumbered: true,
        ..Outcome::default()
    }
}

/// Parse arguments for an operation.
fn given(operation: &'static Operation, arguments: &[&str]) -> Result<Given, String> {
    let arguments = [&[operation.name], arguments].concat();
    let matches = command_of(operation).try_get_matches_from(arguments);
    let matches = matches.map_err(|error| error.to_string())?;
    Given::new(operation, &matches)
}

/// Apply an operation to some curves, all as from the command line but for the files.
fn apply(
    operation: &'static Operation,
    arguments: &[&str],
    curves: &[Curve],
) -> Result<(Vec<Curve>, Report), String> {
    let given = given(operation, arguments)?;
    let destination = Destination::new(given.out, given.to_format);
    let application = Application {
        operation,
        source: given.input.and_then(|path| Source::new(path, None, None)),
        second: None,
        destination: destination.expect("a file"),
        curves: given.curves,
        values: given.values,
        assumed_unit: None,
        best: false,
        text: false,
    };
    let document = Document::from_curves(curves.to_vec());
    let input = application.chosen(document, None, &Messages::Printed);
    let input = input.map_err(|error| error.to_string())?;
    let done = application.applied(&input);
    let (outcome, report) = done.map_err(|error| error.to_string())?;
    let document = outcome.applied_to(input.document());
    let document = document.map_err(|error| error.to_string())?;
    let curves = document.curves().map(|(_, curve)| Curve::clone(curve));
    Ok((curves.collect(), report))
}

fn line(name: &str, points: &[(f64, f64)]) -> Curve {
    Curve::new(name, FloatPolygon::planar(1, points).expect("a polygon"))
}

#[test]
fn an_operation_on_nothing_reads_no_file() {
    let arguments = ["out.batten", "--length", "2", "--angle", "90", "--back"];
    let found = given(&LINE, &arguments).expect("understood");
    assert_eq!(found.input, None);
    assert_eq!(found.out, PathBuf::from("out.batten"));
    let (curves, report) = apply(&LINE, &arguments, &[]).expect("applied");
    let vertices = curves[0].polygon.vertices();
    assert_eq!(vertices.len(), 3);
    assert!(vertices[1].distance(DVec3::new(0.0, 2.0, 0.0)) < 1e-15);
    assert_eq!(report.summary(), "Line: curvature extrema: 0");
    let (curves, _) = apply(&LINE, &["o.batten", "--back=off"], &[]).expect("applied");
    assert_eq!(curves, [line("line", &[(0.0, 0.0), (10.0, 0.0)])]);
    for (arguments, expected) in [
        (&["in.batten", "out.batten"][..], "unexpected argument"),
        (&["out.batten", "--curve", "a"], "unexpected argument"),
        (
            &["out.batten", "--angle", "-180"],
            "Angle: -180 is out of range: more than -180 and at most 180 is needed",
        ),
        (
            &["out.batten", "--length", "0"],
            "Length: 0 is out of range: more than 0 is needed",
        ),
        (&["out.batten", "--back=maybe"], "on or off is needed"),
    ] {
        let error = given(&LINE, arguments).expect_err("not understood");
        assert!(error.contains(expected), "{error}");
    }
    let help = command_of(&LINE).render_help().to_string();
    for words in [
        "--angle <DEGREES>",
        "an angle in degrees, more than -180 and at most 180; default: 0",
        "a length, more than 0; default: 10",
        "--back[=<on|off>]",
        "on or off; default: off",
    ] {
        assert!(help.contains(words), "{words} in {help}");
    }
}

#[test]
fn two_curves_are_taken_by_their_names_or_as_they_stand() {
    let curves = [("a", 1.0), ("b", 2.0), ("c", 3.0)];
    let curves = curves.map(|(name, x)| line(name, &[(0.0, 0.0), (x, 0.0)]));
    let lengths = |arguments: &[&str], curves: &[Curve]| -> Result<Vec<f64>, String> {
        let (curves, _) = apply(&FOLLOW, arguments, curves)?;
        let ends = curves.iter().map(|curve| curve.polygon.vertices()[1].x);
        Ok(ends.collect())
    };
    let files = ["in.batten", "out.batten"];
    let named = |a, b| [&files[..], &["--curve", a, "--with", b]].concat();
    assert_eq!(lengths(&named("c", "a"), &curves), Ok(vec![1.0, 2.0, 1.0]));
    assert_eq!(lengths(&files, &curves[1..]), Ok(vec![3.0, 3.0]));
    for (arguments, expected) in [
        (
            files.to_vec(),
            "choose two with --curve and --with: there are “a”, “b”, “c”",
        ),
        (named("a", "a"), "choose two different curves"),
        (
            named("a", "d"),
            "there is no curve “d”: there are “a”, “b”, “c”",
        ),
    ] {
        assert_eq!(lengths(&arguments, &curves), Err(expected.to_owned()));
    }
    let alone = [&files[..], &["--curve", "a"]].concat();
    let error = lengths(&alone, &curves).expect_err("one is missing");
    assert!(
        error.starts_with("choose two with --curve and --with"),
        "{error}"
    );
}

#[test]
fn a_table_of_points_is_read() {
    let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 1.0)];
    let table = line("points", &points);
    let files = ["points.csv", "out.batten"];
    let (curves, _) = apply(&POLYLINE, &files, std::slice::from_ref(&table)).expect("applied");
    assert_eq!(curves, [table.clone(), line("line", &points)]);
    let second = [&files[..], &["--curve", "2"]].concat();
    let two = [line("other", &points[..2]), table.clone()];
    let (curves, _) = apply(&POLYLINE, &second, &two).expect("applied");
    assert_eq!(curves[2], line("line", &points));
    let error = apply(&POLYLINE, &files, &[table.clone(), table]).expect_err("refused");
    assert_eq!(
        error,
        "choose one with --curve: there are “points”, “points”"
    );
}
