//! What operations say of ends that follow other curves.

use batten::document::{CurveId, Document, Edit, MatchPlace};
use batten::geometry::{Continuity, End, Progress};
use batten::operations::{Deviation, Operands, OperationError, Outcome, Value};

use crate::common::matched;
use crate::runner::operation;

fn run(
    document: &Document,
    curve: CurveId,
    name: &str,
    given: &[(&str, Value)],
) -> Result<Outcome, OperationError> {
    let input = Operands::new(document, [curve])?;
    let operation = operation(name);
    let values = operation.values(&input, given.iter().cloned())?;
    operation.run(&input, &values, &Progress::default())
}

#[test]
fn an_end_that_follows_has_no_other_target() {
    let (document, [_, second]) = matched(Continuity::G1, 9.0);
    let elsewhere = [("start", Value::List(vec![0.0, 5.0]))];
    let refused = run(&document, second, "correct-ends", &elsewhere).expect_err("it follows");
    let message = refused.to_string();
    assert!(message.contains("is matched to “first”"), "{message}");
    let other = [("end", Value::List(vec![20.0, 5.0]))];
    let outcome = run(&document, second, "correct-ends", &other).expect("it is free");
    assert!(outcome.reached);
}

#[test]
fn what_becomes_of_a_match_is_told() {
    let (document, [first, second]) = matched(Continuity::G1, 9.0);
    let digits = [("digits", Value::Whole(1))];
    let rounded = run(&document, second, "round", &digits).expect("it can run");
    let corrected = "“second” was corrected afterwards, and moved by up to ";
    assert!(
        rounded.remarks.iter().any(|it| it.starts_with(corrected)),
        "{:?}",
        rounded.remarks
    );
    let from = [("from", Value::Real(1.0))];
    let trimmed = run(&document, second, "trim", &from).expect("it can run");
    let gone = "The start of “second” is no longer matched";
    assert!(
        trimmed.remarks.iter().any(|it| it == gone),
        "{:?}",
        trimmed.remarks
    );
    // A follower that is locked stays behind.
    let lock = Edit::SetLocked {
        curve: second,
        locked: true,
    };
    let locked = document.edited([lock]).expect("an edit");
    let moved = [("end", Value::List(vec![9.0, 5.0]))];
    let outcome = run(&locked, first, "correct-ends", &moved).expect("it can run");
    let left = "The start of “second” does not meet its match now";
    assert!(
        outcome.remarks.iter().any(|it| it == left),
        "{:?}",
        outcome.remarks
    );
}

#[test]
fn what_follows_an_extended_end_stays() {
    let (document, [first, second]) = matched(Continuity::G1, 9.0);
    let polygon = |document: &Document, id| document.curve(id).expect("a curve").polygon.clone();
    let outcome = run(&document, first, "extend", &[]).expect("it can run");
    let after = outcome.applied_to(&document).expect("an edit");
    let [was, now] = [&document, &after].map(|it| polygon(it, second));
    let off = was.deviation(&now).expect("the same numbers");
    assert!(off <= 1e-13 * was.size(), "{off}");
    let kept = after.match_of(second, End::Start).expect("a match");
    assert_eq!(kept.place, MatchPlace::Parameter(5.0));
    assert!(after.meets(kept));
    assert_eq!(outcome.deviation, Deviation::Exact);
    let told = "“second” follows the place where the end was";
    assert!(
        outcome.remarks.iter().any(|it| it == told),
        "{:?}",
        outcome.remarks
    );

    // An end that follows is free once it is extended.
    let start = [("end", Value::Choice(0))];
    let outcome = run(&document, second, "extend", &start).expect("it can run");
    let after = outcome.applied_to(&document).expect("an edit");
    assert!(after.match_of(second, End::Start).is_none());
    let extended = polygon(&document, second)
        .extended(End::Start, 1)
        .expect("a polygon");
    assert_eq!(polygon(&after, second), extended);
    let gone = "The start of “second” is no longer matched";
    assert!(
        outcome.remarks.iter().any(|it| it == gone),
        "{:?}",
        outcome.remarks
    );
}

#[test]
fn a_curve_that_follows_an_operation_is_named() {
    let (document, [first, _]) = matched(Continuity::G1, 9.0);
    let to = [("to", Value::Real(2.0))];
    let trimmed = run(&document, first, "trim", &to).expect("it can run");
    let told = trimmed.warnings.iter().chain(&trimmed.remarks);
    let told: Vec<&String> = told
        .filter(|it| it.starts_with("“second” follows, by up to "))
        .collect();
    assert_eq!(told.len(), 1, "{:?}", trimmed.warnings);
}

#[test]
fn a_reversed_curve_follows_with_its_other_end() {
    let (document, [_, second]) = matched(Continuity::G1, 9.0);
    let outcome = run(&document, second, "reverse", &[]).expect("it can run");
    let after = outcome.applied_to(&document).expect("an edit");
    let turned = after.match_of(second, End::Finish).expect("a match");
    assert!(after.meets(turned));
    assert!(
        !outcome.remarks.iter().any(|it| it.contains("matched")),
        "{:?}",
        outcome.remarks
    );
}

#[test]
fn what_follows_an_end_that_meets_its_image_stays_there() {
    let (document, [first, second]) = matched(Continuity::G1, 9.0);
    // The curve ends far from the axis, which a bridge reaches over: its end is inside afterwards.
    let axis = [
        ("from", Value::List(vec![12.0, 0.0])),
        ("to", Value::List(vec![12.0, 1.0])),
    ];
    let outcome = run(&document, first, "make-symmetric", &axis).expect("it can run");
    let after = outcome.applied_to(&document).expect("edits");
    let polygon = |document: &Document, id| document.curve(id).expect("a curve").polygon.clone();
    let was = polygon(&document, first).end_jet(End::Finish).point;
    let now = polygon(&after, second).end_jet(End::Start).point;
    let size = polygon(&document, first).size();
    assert!(was.distance(now) <= 1e-3 * size, "{was} {now}");
    let kept = after.match_of(second, End::Start).expect("a match");
    assert!(matches!(kept.place, MatchPlace::Parameter(_)), "{kept:?}");
    let told = "“second” follows the place where the end was";
    assert!(
        outcome.remarks.iter().any(|it| it == told),
        "{:?}",
        outcome.remarks
    );
}
