//! Operations with random values.

use std::ops::Bound;

use batten::document::EditError;
use batten::geometry::Progress;
use batten::operations::{ALL, Kind, Operands, OperationError, Parameter, Report, Value};

use crate::common::Random;
use crate::runner::examples;

/// Rounds over all examples and operations.
const ROUNDS: usize = 3;

/// The seconds that a search has.
const TIME: f64 = 0.05;

/// The largest whole number that is drawn: more only takes longer.
const MOST: f64 = 60.0;

/// Draw a value that the parameter allows for the input.
fn value(parameter: &Parameter, input: &Operands, random: &mut Random) -> Value {
    let limits = parameter.limits(input).expect("there is a curve");
    let (from, to) = limits.unwrap_or((Bound::Unbounded, Bound::Unbounded));
    let number = |bound| match bound {
        Bound::Included(number) | Bound::Excluded(number) => Some(number),
        Bound::Unbounded => None,
    };
    let low = number(from).unwrap_or(-1e3);
    if parameter.name == "time-limit" {
        return Value::List(vec![TIME]);
    }
    match &parameter.kind {
        Kind::Whole { .. } => {
            let high = number(to).unwrap_or(MOST).min(low + MOST);
            // Small ones are drawn more often: time grows with some exponentially.
            let share = random.between(0.0, 1.0).powi(3);
            Value::Whole((low + share * (high + 1.0 - low)).min(high) as usize)
        }
        Kind::Real { .. } => {
            let high = number(to).unwrap_or(low + 1e3);
            let value = random.between(low, high);
            // Whole and halved parameters are the special ones.
            let nice = (2.0 * value).round() / 2.0;
            let allowed = parameter.check(&Value::Real(nice), input).is_ok();
            Value::Real(if allowed && random.bits().is_multiple_of(2) {
                nice
            } else {
                value
            })
        }
        Kind::Choice { options, .. } => {
            Value::Choice((random.bits() % options.len() as u64) as usize)
        }
        Kind::Reference { .. } => {
            let texts = [
                "",
                "circle:radius=3",
                "conical-spiral",
                "clothoid:from=-1,to=2",
            ];
            let text = texts[random.bits() as usize % texts.len()];
            parameter.read(text).expect("a reference or none")
        }
        Kind::Switch { .. } => Value::Switch(random.bits().is_multiple_of(2)),
        Kind::List { count, whole, .. } => {
            let most = (*count.end()).min(4);
            let drawn = count.start() + random.bits() as usize % (most - count.start() + 1);
            let given = random.bits().is_multiple_of(3) && parameter.applies(input);
            let least = number(from).unwrap_or(if *whole { 0.0 } else { -4.0 });
            let number = |_| {
                let number = random.between(least, 6.0);
                if *whole { number.floor() } else { number }
            };
            Value::List((0..if given { drawn } else { 0 }).map(number).collect())
        }
    }
}

#[test]
fn random_values_neither_panic_nor_make_edits_that_are_refused() {
    assert_harmless(0x0b5e_55ed);
}

#[test]
fn other_random_values_neither_panic_nor_make_edits_that_are_refused() {
    assert_harmless(0x0b5e_55ee);
}

/// Run all operations on all examples with random values.
fn assert_harmless(seed: u64) {
    let mut random = Random(seed);
    let (mut reached, mut refused) = (0, 0);
    for round in 0..ROUNDS {
        for (name, runner) in examples() {
            for operation in ALL {
                let input = &runner.input_of(operation);
                if operation.check(input).is_err() {
                    continue;
                }
                let parameters = operation.parameters.iter();
                let given: Vec<(&str, Value)> = parameters
                    .map(|parameter| (parameter.name, value(parameter, input, &mut random)))
                    .collect();
                let place = format!("round {round}: {name} {} {given:?}", operation.name);
                let values = operation.values(input, given.iter().cloned());
                let values = values.unwrap_or_else(|error| panic!("{place}: {error}"));
                let outcome = operation.run(input, &values, &Progress::default());
                let outcome = match outcome {
                    Ok(outcome) => outcome,
                    Err(
                        error @ (OperationError::Polygon(_)
                        | OperationError::NoTarget { .. }
                        | OperationError::Edit(EditError::BadTarget)
                        | OperationError::Harmony(_)
                        | OperationError::OutOfRange { .. }
                        | OperationError::NotBySteps { .. }
                        | OperationError::Bridge(_)
                        | OperationError::Merge(_)
                        | OperationError::LockedInMerge { .. }
                        | OperationError::Approximation(_)
                        | OperationError::Fit(_)
                        | OperationError::Piece { .. }
                        | OperationError::Exclude { .. }
                        | OperationError::Needs { .. }
                        | OperationError::NoDirection { .. }
                        | OperationError::Correction(_)),
                    ) => {
                        assert!(!error.to_string().is_empty());
                        refused += 1;
                        continue;
                    }
                    Err(error) => panic!("{place}: {error}"),
                };
                let after = outcome.applied_to(input.document());
                let after = after.unwrap_or_else(|error| panic!("{place}: {error}"));
                if !outcome.is_useful() {
                    assert!(after.is_same(input.document()), "{place}");
                }
                let report = Report::new(operation, input, &outcome);
                assert!(report.summary().starts_with(operation.label), "{place}");
                let json = serde_json::to_value(&report).expect("JSON");
                // No figure of its own has the name of one that all have.
                let keys = json.as_object().map(serde_json::Map::len);
                let own = report.figures.len() + usize::from(report.equivalence.is_some());
                assert_eq!(keys, Some(9 + own), "{place}");
                let largest = report.largest_move.map_or(0.0, |largest| largest.distance);
                assert!(largest.is_finite(), "{place}");
                reached += usize::from(outcome.reached);
            }
        }
    }
    assert!(reached > 200 && refused > 5, "{reached} {refused}");
}
