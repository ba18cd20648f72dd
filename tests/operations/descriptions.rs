//! What operations say of themselves.

use std::collections::HashSet;

use batten::document::Document;
use batten::geometry::Progress;
use batten::geometry::parameters::Quantity;
use batten::operations::{ALL, Inputs, Kind, Operands, OperationError, Value, find};

use crate::runner::{Runner, examples, operation};

/// What the command line has for itself.
const RESERVED: [&str; 7] = [
    "curve",
    "with",
    "from-format",
    "to-format",
    "help",
    "list",
    "best",
];

fn is_name(name: &str) -> bool {
    let mut letters = name.chars();
    !name.is_empty()
        && letters
            .all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-')
}

/// Whether a text begins with a capital letter and is one line without a full stop.
/// The most words of a parameter's label.
const MOST_WORDS: usize = 3;

/// Whether a help text is short enough for a tooltip.
fn is_help(text: &str) -> bool {
    text.chars().count() <= 100
}

fn is_phrase(text: &str) -> bool {
    text.starts_with(char::is_uppercase) && !text.ends_with('.') && !text.contains('\n')
}

#[test]
fn operations_are_found_by_their_names() {
    let mut names = HashSet::new();
    for operation in ALL {
        assert!(names.insert(operation.name), "{}", operation.name);
        assert_eq!(find(operation.name), Some(*operation));
    }
    assert_eq!(find("Reverse"), None);
}

#[test]
fn names_are_distinct_and_everything_has_words() {
    let mut labels = HashSet::new();
    for operation in ALL {
        let name = operation.name;
        assert!(is_name(name), "{name}");
        assert!(labels.insert(operation.label), "{name}");
        assert!(
            is_phrase(operation.label) && is_phrase(operation.help),
            "{name}"
        );
        assert!(is_help(operation.help), "{name}: {}", operation.help);
        let mut names: HashSet<&str> = RESERVED.into_iter().collect();
        let mut shown = HashSet::new();
        for parameter in operation.parameters {
            let place = format!("{name} {}", parameter.name);
            assert!(is_name(parameter.name), "{place}");
            assert!(names.insert(parameter.name), "{place}");
            assert!(shown.insert(parameter.label), "{place}");
            assert!(is_phrase(parameter.label), "{place}");
            assert!(is_phrase(parameter.help), "{place}");
            assert!(is_help(parameter.help), "{place}: {}", parameter.help);
            assert!(parameter.label.split(' ').count() <= MOST_WORDS, "{place}");
            assert!(!parameter.range_words().is_empty(), "{place}");
            assert!(!parameter.default_words().is_empty(), "{place}");
            if let Kind::Choice { options, default } = parameter.kind {
                let names: HashSet<&str> = options.iter().map(|option| option.name).collect();
                assert_eq!(names.len(), options.len(), "{place}");
                let plain = |name: &str| is_name(&name.to_lowercase());
                assert!(names.into_iter().all(plain), "{place}");
                assert!(
                    options.iter().all(|option| is_phrase(option.label)),
                    "{place}"
                );
                assert!(default < options.len(), "{place}");
            }
        }
    }
}

#[test]
fn defaults_are_allowed_wherever_the_operation_can_run() {
    let mut ran = HashSet::new();
    for (name, runner) in examples() {
        for operation in ALL {
            let input = runner.input_of(operation);
            if let Err(error) = operation.check(&input) {
                // Only what a closed curve lacks keeps an operation from an example.
                assert!(runner.polygon().is_periodic(), "{name}: {error}");
                assert!(error.to_string().contains("open it first"), "{error}");
                continue;
            }
            let values = operation.values(&input, []);
            let values =
                values.unwrap_or_else(|error| panic!("{name} {}: {error}", operation.name));
            for parameter in operation.parameters {
                let value = values.get(parameter);
                assert_eq!(Ok(value), parameter.default(&input).as_ref());
                // What is written is read as the same value.
                assert_eq!(parameter.read(&parameter.text(value)).as_ref(), Ok(value));
            }
            let outcome = operation.run(&input, &values, &Progress::default());
            let outcome =
                outcome.unwrap_or_else(|error| panic!("{name} {}: {error}", operation.name));
            // Arcs are closed by arcs, whose curvature is not monotone.
            let is_arc = outcome.remarks.iter().any(|it| it.contains("circular arc"));
            // The hull leaves the axis at an angle.
            let mut remarks = outcome.remarks.iter();
            let is_bent = remarks.any(|it| it.contains("meets its image at a corner of 45.0°"));
            // An S that is its own image by half a turn would be flattened, and its ends point away from each other.
            let warns = |text: &str| outcome.warnings.iter().any(|it| it.contains(text));
            let is_flat = warns("its halves differ much");
            let is_away = name == "s-curve" && warns("turn the ends towards each other");
            assert!(
                outcome.reached
                    || (operation.name == "between" && is_arc)
                    || (operation.name == "close" && is_away)
                    || (operation.name == "make-symmetric" && (is_bent || is_flat)),
                "{name} {}: {:?}",
                operation.name,
                outcome.remarks
            );
            ran.insert(operation.name);
        }
    }
    let missing = ALL.iter().find(|operation| !ran.contains(operation.name));
    assert_eq!(missing, None, "every operation runs on an example");
}

#[test]
fn values_are_checked_one_by_one() {
    let runner = Runner::example("s-curve");
    let check = |name: &str, given: &[(&str, Value)], expected: &str| {
        assert_eq!(runner.refused(name, given), expected);
    };
    check(
        "split",
        &[("at", Value::Real(5.0))],
        "At u: 5 is out of range: more than 0 and less than 5 is needed",
    );
    check(
        "trim",
        &[("from", Value::Real(-0.5))],
        "From u: -0.5 is out of range: at least 0 and less than 5 is needed",
    );
    check(
        "reduce-degree",
        &[("degree", Value::Whole(5))],
        "Degree: 5 is out of range: 1 to 4 is needed",
    );
    check(
        "split",
        &[("at", Value::Whole(1))],
        "At u: a parameter u, more than 0 and less than the number of segments is needed",
    );
    check(
        "split",
        &[("at", Value::Real(f64::NAN))],
        "At u: a parameter u, more than 0 and less than the number of segments is needed",
    );
    check(
        "extend",
        &[("end", Value::Choice(2))],
        "End: start or end is needed",
    );
    check(
        "reverse",
        &[("at", Value::Real(1.0))],
        "there is no parameter “at”",
    );
    check(
        "trim",
        &[("from", Value::Real(3.0)), ("to", Value::Real(2.0))],
        "there is no part from u = 3 to u = 2: u runs from 0 to 5, and a part begins before it ends",
    );
}

#[test]
fn what_is_typed_is_read_with_the_limits_that_are_known() {
    let parameters = operation("extend").parameters;
    let [end, segments] = parameters else {
        panic!("two parameters");
    };
    assert_eq!(end.read("start"), Ok(Value::Choice(0)));
    assert_eq!(segments.read(" 12 "), Ok(Value::Whole(12)));
    for text in ["", "0", "-1", "1.5", "10001", "many"] {
        assert!(segments.read(text).is_err(), "{text}");
    }
    let parameters = operation("correct-ends").parameters;
    let named = |name| parameters.iter().find(|parameter| parameter.name == name);
    let tolerance = named("tolerance").expect("it is there");
    let point = named("start").expect("it is there");
    assert_eq!(point.read(" -1, 2.5"), Ok(Value::List(vec![-1.0, 2.5])));
    assert_eq!(point.read(""), Ok(Value::List(Vec::new())));
    for text in ["1", "1,2,3,4", "1,x", "1,,2", "1,inf"] {
        assert!(point.read(text).is_err(), "{text}");
    }
    let locked = named("locked").expect("it is there");
    for (parameter, text, expected) in [
        (
            locked,
            "1,x",
            "Also hold vertices: whole numbers, separated by commas are needed: column 3: “x” means",
        ),
        (
            point,
            "1",
            "Start point: 2 or 3 numbers, separated by commas are needed",
        ),
        (
            named("start-slope").expect("it is there"),
            "1,2",
            "Start curvature slope: a number is needed",
        ),
    ] {
        let refused = parameter.read(text).expect_err("refused");
        assert!(refused.to_string().starts_with(expected), "{refused}");
    }
    assert_eq!(
        point.read("sqrt(16), max(1,-2)*2"),
        Ok(Value::List(vec![4.0, 2.0]))
    );
    assert!(point.read_given("").is_err(), "nothing is no value");
    assert_eq!(point.read_given("1,2"), point.read("1,2"));
    assert_eq!(tolerance.quantity(), Quantity::Length);
    assert_eq!(tolerance.read("1e-6"), Ok(Value::Real(1e-6)));
    for text in ["0", "-1", "inf", "NaN"] {
        assert!(tolerance.read(text).is_err(), "{text}");
    }
}

#[test]
fn an_operation_runs_on_nothing_but_the_inputs_it_wants() {
    let runner = Runner::example("arc");
    let document = runner.input.document();
    let none = Operands::new(document, []).expect("none is there");
    let twice = Operands::new(document, [runner.id(), runner.id()]).expect("it is there");
    let points = runner.input.clone().with_points(vec![glam::DVec3::ZERO]);
    for operation in ALL {
        let (wrong, expected) = match operation.inputs {
            Inputs::None => (&runner.input, "this works on no curve: choose none"),
            Inputs::UpToTwo => (&twice, "choose no more than two different curves"),
            Inputs::Two => (&none, "choose two different curves"),
            Inputs::OneOrNone => (&twice, "choose a curve, or give a reference"),
            Inputs::Points => (&none, "a table of points is needed"),
            Inputs::References => (
                &none,
                "there is no smooth reference, such as a spline of a drawing or a formula",
            ),
            _ => (&none, "choose one curve"),
        };
        for input in [wrong, &twice, &points] {
            let refused = operation.check(input).expect_err("refused");
            assert!(matches!(refused, OperationError::Inputs { .. }));
            assert_eq!(refused.to_string(), expected);
            assert!(operation.values(input, []).is_err());
        }
    }
    let gone = Operands::new(&Document::default(), [runner.id()]).expect_err("not there");
    assert_eq!(gone.to_string(), "the curve is no longer in the document");
}
