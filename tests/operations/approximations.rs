//! Approximations of references and curves.

use std::sync::{Arc, mpsc};
use std::thread;

use batten::document::{Curve, Document, Group, Reference};
use batten::geometry::references::{Nurbs, PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{FloatPolygon, ParametricCurve, Progress};
use batten::operations::{Deviation, Operands, OperationError, Outcome, Report, Value, find};
use glam::DVec3;
use serde_json::json;

use super::runner::Runner;

/// Run it on nothing but its parameters, as they are typed.
fn run(given: &[(&str, &str)]) -> Result<(Operands, Outcome), OperationError> {
    run_watched(given, &Progress::default())
}

fn run_watched(
    given: &[(&str, &str)],
    progress: &Progress,
) -> Result<(Operands, Outcome), OperationError> {
    let operation = find("approximate").expect("it is there");
    let input = Operands::new(&Document::default(), [])?;
    let read = |(name, text): &(&'static str, &str)| {
        let mut parameters = operation.parameters.iter();
        let parameter = parameters.find(|parameter| parameter.name == *name);
        Ok::<_, OperationError>((*name, parameter.expect("a parameter").read(text)?))
    };
    let given: Vec<(&'static str, &str)> = given
        .iter()
        .map(|(name, text)| {
            let mut parameters = operation.parameters.iter();
            let parameter = parameters.find(|parameter| parameter.name == *name);
            (parameter.expect("a parameter").name, *text)
        })
        .collect();
    let given: Result<Vec<(&str, Value)>, OperationError> = given.iter().map(read).collect();
    let values = operation.values(&input, given?)?;
    let outcome = operation.run(&input, &values, progress)?;
    Ok((input, outcome))
}

fn curve(input: &Operands, outcome: &Outcome) -> Curve {
    let after = outcome
        .applied_to(input.document())
        .expect("edits that can be made");
    let mut curves = after.curves();
    Curve::clone(curves.next().expect("a curve").1)
}

#[test]
fn a_reference_becomes_a_new_curve() {
    let given = [
        ("reference", "conical-spiral"),
        ("from", "0"),
        ("step", "1"),
        ("count", "20"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    assert!(outcome.reached);
    let curve = curve(&input, &outcome);
    assert_eq!(curve.name, "conical spiral");
    assert_eq!(
        (curve.polygon.degree(), curve.polygon.vertices().len()),
        (8, 20)
    );
    let Deviation::AtMost(deviation) = outcome.deviation else {
        panic!("{:?}", outcome.deviation);
    };
    // Both ways, within the part that is asked for.
    assert!(deviation > 0.0012 && deviation <= 0.0013, "{deviation}");
    assert!(!outcome.annotations.is_empty());
}

#[test]
fn the_report_compares_level_by_level() {
    let operation = find("approximate").expect("it is there");
    let given = [
        ("reference", "conical-spiral"),
        ("from", "0"),
        ("step", "1"),
        ("count", "20"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    let report = json!(Report::new(operation, &input, &outcome));
    let levels = report["equivalence"].as_array().expect("a list");
    let equal: Vec<bool> = levels
        .iter()
        .filter_map(|level| level["equal"].as_bool())
        .collect();
    assert_eq!(equal, [true, true, true, false]);
    assert_eq!(levels[3]["of"], "torsion");
    assert_eq!(levels[3]["level"], 2);
    assert!(levels[3]["first_difference"].is_u64());
    assert!(report["mean_deviation"].as_f64().expect("a number") > 0.0);
    assert_eq!(report["vertices"], 20);
    let summary = Report::new(operation, &input, &outcome).summary();
    assert!(
        summary.contains("another shape: torsion level 2 differs"),
        "{summary}"
    );
}

#[test]
fn a_tolerance_is_reached_or_said_to_be_missed() {
    let given = [
        ("reference", "clothoid:from=0,to=3"),
        ("tolerance", "1e-6"),
        ("fit-ends", "on"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    assert!(outcome.reached);
    assert!(matches!(outcome.deviation, Deviation::AtMost(off) if off <= 1e-6));
    let polygon = curve(&input, &outcome).polygon;
    let clothoid = ReferenceCurve::from_text("clothoid:from=0,to=3").expect("a reference");
    let end = batten::geometry::Differentiable::derivatives(&clothoid, 3.0, 0)[0];
    assert!(polygon.point(polygon.segments() as f64).distance(end) < 1e-12);
    let given = [&given[..2], &[("count", "10")]].concat();
    let (_, outcome) = run(&given).expect("it can run");
    assert!(!outcome.reached && outcome.is_useful());
}

#[test]
fn a_curve_gets_another_degree_and_count() {
    let runner = Runner::example("s-curve");
    let given = [
        ("degree", Value::Whole(7)),
        ("count", Value::List(vec![60.0])),
    ];
    let (outcome, curves) = runner.done("approximate", &given);
    let polygon: &FloatPolygon = &curves[0].polygon;
    assert_eq!(
        (curves.len(), polygon.degree(), polygon.vertices().len()),
        (1, 7, 60)
    );
    let size = runner.polygon().size();
    assert!(matches!(outcome.deviation, Deviation::AtMost(off) if off < 1e-4 * size));
    let ends = [0.0, 1.0].map(|share| {
        let [before, after] = [runner.polygon(), polygon]
            .map(|polygon| polygon.point(share * polygon.segments() as f64));
        before.distance(after)
    });
    assert!(ends.into_iter().all(|off| off < 1e-4 * size), "{ends:?}");
}

#[test]
fn what_cannot_be_is_refused() {
    let refused = |given: &[(&str, &str)], words: &str| {
        let error = run(given).expect_err("refused").to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&[], "choose a curve, or give a reference");
    refused(&[("reference", "circle:radius=x")], "column 15");
    let step = [("reference", "circle"), ("step", "1")];
    refused(
        &[&step[..], &[("to", "3")]].concat(),
        "Step and To cannot both be given",
    );
    refused(
        &[&step[..], &[("tolerance", "3")]].concat(),
        "Step and Tolerance cannot",
    );
    refused(
        &[("reference", "circle"), ("step", "0")],
        "Step: 0 is out of range",
    );
    refused(
        &[("reference", "circle"), ("tolerance", "0")],
        "Tolerance: 0 is out of range",
    );
    refused(
        &[("reference", "circle"), ("count", "3")],
        "3 vertices are too few",
    );
    refused(
        &[("reference", "circle"), ("from", "9")],
        "must be a positive number",
    );
    refused(
        &[
            ("reference", "formula:x=t;y=1/t;from=1;to=2"),
            ("from", "0"),
        ],
        "the curve has no point",
    );
    let periodic = Runner::example("periodic");
    let error = periodic
        .run("approximate", &[("fit-ends", Value::Switch(true))])
        .expect_err("refused")
        .to_string();
    assert!(error.contains("a periodic curve has no ends"), "{error}");
}

#[test]
fn a_periodic_curve_stays_periodic_unless_a_part_is_asked_for() {
    let runner = Runner::example("periodic");
    let period = runner.polygon().segments() as f64;
    let list = |number: f64| Value::List(vec![number]);
    let done = |given: &[(&'static str, Value)]| {
        let (outcome, curves) = runner.done("approximate", given);
        (outcome, curves[0].polygon.clone())
    };
    let (outcome, whole) = done(&[("count", list(60.0)), ("degree", Value::Whole(5))]);
    assert!(whole.is_periodic() && outcome.reached);
    assert!(outcome.figures.iter().all(|it| it.name != "start_error"));
    let size = runner.polygon().size();
    assert!(matches!(outcome.deviation, Deviation::AtMost(off) if off < 1e-3 * size));
    // A step that leads once round, vertex 0 at parameter 1.
    let given = [
        ("from", list(1.0)),
        ("step", list(period / 60.0)),
        ("count", list(60.0)),
        ("method", Value::Choice(0)),
    ];
    let (_, by_steps) = done(&given);
    assert!(by_steps.is_periodic());
    let begin = by_steps.vertices()[0].distance(runner.polygon().point(1.0));
    assert!(begin < 1e-13 * size, "{begin}");
    for given in [
        vec![("to", list(0.5 * period))],
        vec![("step", list(0.1)), ("count", list(30.0))],
    ] {
        let (outcome, part) = done(&given);
        assert!(!part.is_periodic());
        assert!(outcome.figures.iter().any(|it| it.name == "start_error"));
    }
}

#[test]
fn the_text_sets_features_side_by_side() {
    let operation = find("approximate").expect("it is there");
    let given = [
        ("reference", "conical-spiral"),
        ("from", "0"),
        ("step", "1"),
        ("count", "20"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    let text = Report::new(operation, &input, &outcome).text();
    let lines: Vec<&str> = text.lines().collect();
    let table = lines
        .iter()
        .position(|line| line.starts_with("torsion level 2: differs"));
    let table = &lines[table.expect("the level that differs")..];
    assert!(
        table[1].contains("reference") && table[1].contains("curve"),
        "{text}"
    );
    let marked: Vec<&&str> = table.iter().filter(|line| line.starts_with('>')).collect();
    assert_eq!(marked.len(), 1, "{text}");
    assert!(
        marked[0].contains("none") && marked[0].contains("at u = "),
        "{text}"
    );
    assert!(text.contains("End to end: "), "{text}");
    let given = [
        ("reference", "ellipse:a=3,b=1"),
        ("count", "40"),
        ("levels", "1"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    let text = Report::new(operation, &input, &outcome).text();
    let row = text.lines().find(|line| line.starts_with("    1 "));
    let row = row.expect("the first feature");
    assert!(
        row.contains("minimum at t = 1.57") && row.contains("minimum at u = "),
        "{text}"
    );
}

#[test]
fn the_report_says_that_corrections_grow() {
    let given = [("reference", "circle"), ("degree", "15"), ("count", "16")];
    let (_, outcome) = run(&given).expect("it can run");
    let told = outcome.remarks.join(". ");
    assert!(told.contains("do not fade but grow"), "{told}");
    let (_, outcome) = run(&[&given[..2], &[("count", "60")]].concat()).expect("it can run");
    assert_eq!(outcome.remarks, Vec::<String>::new());
}

/// The number of vertices that a remark says `what` takes.
fn count_told(told: &str, what: &str) -> usize {
    let (_, rest) = told
        .split_once(&format!("{what} reaches the tolerance with "))
        .unwrap_or_else(|| panic!("{told}"));
    let (count, _) = rest.split_once(" vertices").expect("a count");
    count.parse().expect("a number")
}

#[test]
fn what_reaches_a_tolerance_better_is_told() {
    // The second level of a quintic ripples round a spiral until there are very many segments.
    let given = [
        ("reference", "archimedean-spiral:to=2*pi"),
        ("degree", "5"),
        ("tolerance", "1e-4"),
        ("spacing", "parameter"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    let told = outcome.remarks.join(". ");
    assert!(outcome.reached, "{told}");
    let many = curve(&input, &outcome).polygon.segments();
    assert!(
        told.contains(&format!("{many} segments are many: ")),
        "{told}"
    );
    // What is said to do does.
    for (what, instead) in [("levels 1", ("levels", "1")), ("degree 6", ("degree", "6"))] {
        let count = count_told(&told, what);
        assert!(10 * count < many, "{told}");
        let others = given.iter().filter(|(name, _)| *name != instead.0);
        let instead: Vec<(&str, &str)> = others.copied().chain([instead]).collect();
        let (input, outcome) = run(&instead).expect("it can run");
        assert!(outcome.reached);
        assert_eq!(curve(&input, &outcome).polygon.vertices().len(), count);
        assert!(outcome.remarks.iter().all(|it| !it.contains("many")));
    }
}

#[test]
fn a_tolerance_that_is_missed_names_what_fails() {
    // A corner that is nearly sharp has no shape that a quintic could have.
    let given = [
        ("reference", "formula:x=t;y=sqrt((t-0.5)^2+1e-12)"),
        ("degree", "5"),
        ("tolerance", "1e-9"),
        ("spacing", "parameter"),
    ];
    let (_, outcome) = run(&given).expect("it can run");
    let told = outcome.remarks.join(". ");
    assert!(!outcome.reached && outcome.is_useful());
    assert!(
        told.contains("The nearest of degree 5 is off by "),
        "{told}"
    );
}

#[test]
fn vertices_on_the_curve_are_told_how_far_quasi_interpolation_would_be_off() {
    let given = [
        ("reference", "conical-spiral"),
        ("from", "0"),
        ("step", "1"),
        ("count", "20"),
        ("method", "on-curve"),
    ];
    let (_, outcome) = run(&given).expect("it can run");
    let told = outcome.remarks.join(". ");
    let expected = "With vertices on the curve it is 4.91 off: that keeps the shape, not the place. Method quasi would be 0.00";
    assert!(told.contains(expected), "{told}");
    // A straight line has no place to lose.
    let given = [("reference", "formula:x=t;y=2*t"), ("method", "on-curve")];
    let (_, outcome) = run(&given).expect("it can run");
    assert_eq!(outcome.remarks, Vec::<String>::new());
}

#[test]
fn a_cancelled_approximation_ends_before_its_search_does() {
    let search = [
        ("reference", "formula:x=sin(100*t);y=cos(t)"),
        ("degree", "5"),
        ("from", "0"),
        ("to", "6"),
        ("tolerance", "1e-3"),
    ];
    let many = [
        ("reference", "formula:x=sin(100*t);y=cos(t);to=6"),
        ("count", "10000"),
        ("spacing", "curvature"),
    ];
    for given in [&search[..], &many[..]] {
        let progress = Progress::default();
        progress.cancel();
        let found = run_watched(given, &progress);
        assert_eq!(found.err(), Some(OperationError::Cancelled));
    }
    // Cancelled where it first tells of progress, the search tries no more numbers of segments: with all of
    // them it has done half of its work.
    let progress = Progress::default();
    let other = progress.clone();
    let cancelling = thread::spawn(move || {
        while other.done() == 0.0 {
            thread::yield_now();
        }
        other.cancel();
    });
    let found = run_watched(&search, &progress);
    cancelling.join().expect("a thread that does not panic");
    assert_eq!(found.err(), Some(OperationError::Cancelled));
    assert!(progress.done() < 0.5, "{}", progress.done());
}

#[test]
fn a_deviation_that_is_only_sampled_says_so() {
    let operation = find("approximate").expect("it is there");
    for (reference, kind) in [("superspiral", "sampled"), ("circle", "bounded")] {
        let (input, outcome) = run(&[("reference", reference)]).expect("it can run");
        let report = Report::new(operation, &input, &outcome);
        assert_eq!(json!(report)["deviation_is"], kind);
        let is_sampled = kind == "sampled";
        let text = report.text();
        assert_eq!(
            text.lines().next().map(|it| it.contains("(sampled)")),
            Some(is_sampled),
            "{text}"
        );
        assert_eq!(
            text.contains("the curve moves by at most"),
            !is_sampled,
            "{text}"
        );
    }
}

#[test]
fn a_search_whose_time_is_up_tells_the_best_so_far() {
    let slow = [
        ("reference", "superspiral:from=0,to=200"),
        ("tolerance", "1e-13"),
        ("levels", "4"),
    ];
    for limit in ["1.5", "1e-6"] {
        let given = [&slow[..], &[("time-limit", limit)]].concat();
        let (_, outcome) = run(&given).expect("it can run");
        let told = outcome.remarks.join(". ");
        let reason = format!("The time limit of {limit} s ended the search");
        assert!(!outcome.reached && told.contains(&reason), "{told}");
        assert_eq!(outcome.is_useful(), limit == "1.5", "{told}");
    }
}

#[test]
fn a_curve_that_is_far_off_its_reference_says_so() {
    for (count, is_far) in [("9", true), ("40", false)] {
        let given = [("reference", "circle:to=20"), ("count", count)];
        let (_, outcome) = run(&given).expect("it can run");
        let remarks = outcome.remarks.join("\n");
        assert_eq!(
            remarks.contains("off a reference of size"),
            is_far,
            "{remarks}"
        );
    }
}

#[test]
fn progress_of_a_search_never_goes_back() {
    let given = [
        ("reference", "archimedean-spiral:to=2*pi"),
        ("degree", "5"),
        ("tolerance", "1e-4"),
        ("spacing", "parameter"),
    ];
    let progress = Progress::default();
    let other = progress.clone();
    let (sender, receiver) = mpsc::channel::<()>();
    let watching = thread::spawn(move || {
        let mut seen = vec![0.0];
        while receiver.try_recv() != Err(mpsc::TryRecvError::Disconnected) {
            let done = other.done();
            if seen.last() != Some(&done) {
                seen.push(done);
            }
            thread::yield_now();
        }
        seen
    });
    let found = run_watched(&given, &progress);
    drop(sender);
    let seen = watching.join().expect("a thread that does not panic");
    // Other degrees and fewer levels are tried after the search itself.
    let (_, outcome) = found.expect("it can run");
    assert!(
        outcome.remarks.iter().any(|it| it.contains("are many: ")),
        "{:?}",
        outcome.remarks
    );
    assert!(seen.len() > 5 && seen.is_sorted(), "{seen:?}");
    assert!(
        seen.iter().all(|done| (0.0..=1.0).contains(done)),
        "{seen:?}"
    );
}

/// With 20 vertices of degree 8 Nielsen's spiral would be 2e7 off.
#[test]
fn without_a_number_there_are_as_many_vertices_as_let_corrections_fade() {
    let (input, outcome) = run(&[("reference", "nielsen-spiral")]).expect("it can run");
    let count = curve(&input, &outcome).polygon.vertices().len();
    let doublings = count / 20;
    assert!(count == 20 * doublings && doublings.is_power_of_two() && doublings > 1);
    let Deviation::AtMost(deviation) = outcome.deviation else {
        panic!("{:?}", outcome.deviation);
    };
    assert!(deviation < 1e-3, "{deviation}");
    let grow = |outcome: &Outcome| outcome.remarks.iter().any(|it| it.contains("grow"));
    assert!(!grow(&outcome), "{:?}", outcome.remarks);
    // It is the first number that lets them: with half as many they grow.
    let half = (count / 2).to_string();
    let (_, outcome) =
        run(&[("reference", "nielsen-spiral"), ("count", &half)]).expect("it can run");
    assert!(grow(&outcome), "{:?}", outcome.remarks);
    let typed = [("reference", "nielsen-spiral"), ("count", "20")];
    let (input, outcome) = run(&typed).expect("it can run");
    assert_eq!(curve(&input, &outcome).polygon.vertices().len(), 20);
    assert!(grow(&outcome), "{:?}", outcome.remarks);
}

/// A cubic on uneven knots, which no float polygon holds; with a corner at its middle knot if it is triple.
fn spline(middle: usize) -> ReferenceCurve {
    let inner = [vec![1.0], vec![3.0; middle], vec![4.5]].concat();
    let knots = [vec![0.0; 4], inner, vec![5.0; 4]].concat();
    let count = knots.len() - 4;
    let corner = |index: usize| DVec3::new(10.0 * index as f64, 8.0 * (index % 2) as f64, 0.0);
    let nurbs = Nurbs::new(
        3,
        knots,
        (0..count).map(corner).collect::<Vec<_>>(),
        None,
        false,
    );
    let form = ReferenceForm::Nurbs(nurbs.expect("a spline"));
    ReferenceCurve::of(form).expect("a reference")
}

/// Convert references of a document, with the first one chosen, in as much time as a slow machine needs.
fn converted(document: &Document, given: &[(&str, Value)]) -> (Outcome, Document) {
    let operation = find("to-float").expect("it is there");
    let chosen = document.references().next().map(|(id, _)| id);
    let input = Operands::choose(document, operation.inputs, chosen, &[]).expect("references");
    let patience = [("time-limit", Value::List(vec![600.0]))];
    let values = operation.values(&input, patience.iter().chain(given).cloned());
    let outcome = operation.run(&input, &values.expect("values"), &Progress::default());
    let outcome = outcome.expect("curves");
    let after = outcome.applied_to(document).expect("edits");
    (outcome, after)
}

fn drawing() -> Document {
    let circle = ReferenceCurve::from_text("circle:radius=30").expect("a circle");
    let in_deck = |name: &str, curve: ReferenceCurve| {
        Reference::new(name, curve).in_group(Group::new(["Deck"]))
    };
    Document::default().with_references([
        in_deck("sheer", spline(1)),
        in_deck("port", circle),
        Reference::new("chine", spline(3)),
    ])
}

#[test]
fn a_line_that_is_chosen_keeps_the_others_from_nothing() {
    let line = PointList::new(vec![DVec3::ZERO, DVec3::X]).expect("points");
    let line = ReferenceCurve::of(ReferenceForm::Points(line)).expect("a line");
    let smooth = drawing()
        .references()
        .map(|(_, it)| it.clone())
        .collect::<Vec<_>>();
    let line = Arc::new(Reference::new("line", line));
    let document = Document::default().with_references([vec![line], smooth].concat());
    let (_, after) = converted(&document, &[("references", Value::Choice(2))]);
    assert_eq!((after.curves().count(), after.references().count()), (4, 1));
    let operation = find("to-float").expect("it is there");
    let chosen = document.references().next().map(|(id, _)| id);
    let input = Operands::choose(&document, operation.inputs, chosen, &[]).expect("references");
    let values = operation.values(&input, []).expect("values");
    let refused = operation.run(&input, &values, &Progress::default());
    assert!(matches!(refused, Err(OperationError::PointsOnly)));
}

#[test]
fn references_become_float_polygons_of_one_group_or_of_all() {
    let document = drawing();
    for (which, curves, references) in [(0, 1, 2), (1, 2, 1), (2, 4, 0)] {
        let given = [
            ("references", Value::Choice(which)),
            ("tolerance", Value::List(vec![1e-3])),
        ];
        let (outcome, after) = converted(&document, &given);
        assert!(outcome.reached, "{:?}", outcome.remarks);
        let counts = (after.curves().count(), after.references().count());
        assert_eq!(counts, (curves, references), "{:?}", outcome.remarks);
        assert_eq!(
            outcome.remarks.len(),
            3 - references,
            "{:?}",
            outcome.remarks
        );
        for (_, reference) in document.references() {
            let is_kept = after.references().any(|(_, it)| it.name == reference.name);
            let near = after.curves().filter(|(_, curve)| {
                curve.name == reference.name || curve.group.names().contains(&reference.name)
            });
            let near: Vec<_> = near.map(|(_, curve)| curve.clone()).collect();
            assert_eq!(near.is_empty(), is_kept, "{}", reference.name);
            for step in (0..=400).filter(|_| !is_kept) {
                let u = reference.curve.pieces() as f64 * step as f64 / 400.0;
                let point = reference.curve.jet(u).point;
                let off = near
                    .iter()
                    .map(|curve| curve.polygon.nearest(point).distance);
                let off = off.fold(f64::INFINITY, f64::min);
                assert!(off <= 1e-3, "{} at {u}: {off}", reference.name);
            }
        }
    }
}

#[test]
fn features_are_kept_and_corners_divide_a_reference() {
    let (outcome, after) = converted(&drawing(), &[("references", Value::Choice(2))]);
    assert!(outcome.reached, "{:?}", outcome.remarks);
    let [sheer, port, chine] = [0, 1, 2].map(|index| outcome.remarks[index].as_str());
    assert!(
        sheer.starts_with("“sheer”: ") && sheer.ends_with("; features kept"),
        "{sheer}"
    );
    // A circle has no extrema, a polygon near it some.
    assert!(port.ends_with("; features differ"), "{port}");
    let port = after.curves().find(|(_, curve)| curve.name == "port");
    let port = port.expect("the circle").1;
    assert!(port.polygon.is_periodic(), "it goes once round");
    assert!(
        chine.starts_with("“chine”: 2 curves between corners, "),
        "{chine}"
    );
    let parts = after
        .curves()
        .filter(|(_, curve)| curve.name.starts_with("chine"));
    let parts: Vec<_> = parts.map(|(_, curve)| curve.clone()).collect();
    let ends = [parts[0].polygon.segments() as f64, 0.0];
    let [one, other] = [0, 1].map(|index: usize| parts[index].polygon.point(ends[index]));
    assert!(
        one.distance(other) < 1e-9,
        "the corner stays: {one} and {other}"
    );
}

/// A closed path of cubic Béziers through points, with handles along their tangents: smooth but where two of them make
/// an angle.
fn path(sharp: &[usize]) -> ReferenceCurve {
    let places = [(40.0, 0.0), (0.0, 25.0), (-30.0, 0.0), (0.0, -25.0)];
    let at = |it: usize| {
        let (x, y) = places[it % places.len()];
        DVec3::new(x, y, 0.0)
    };
    let mut points = vec![at(0)];
    for it in 0..places.len() {
        let corner = at(it) + at(it + 1);
        // A handle that leaves a sharp point straight for the next one.
        let handle = |own: usize, other: usize| match sharp.contains(&(own % places.len())) {
            true => at(own) + 0.4 * (at(other) - at(own)),
            false => at(own) + 0.55 * (corner - at(own)),
        };
        points.extend([handle(it, it + 1), handle(it + 1, it), at(it + 1)]);
    }
    let knots = (0..=places.len()).flat_map(|it| {
        let is_end = it == 0 || it == places.len();
        vec![it as f64; if is_end { 4 } else { 3 }]
    });
    let nurbs = Nurbs::new(3, knots.collect::<Vec<_>>(), points, None, false);
    let form = ReferenceForm::Nurbs(nurbs.expect("a spline"));
    ReferenceCurve::of(form).expect("a reference")
}

#[test]
fn a_path_that_closes_smoothly_is_periodic_and_no_curve_ends_at_its_seam() {
    let seam = DVec3::new(40.0, 0.0, 0.0);
    for (sharp, curves) in [
        (&[][..], 1),
        (&[0], 1),
        (&[2], 1),
        (&[1, 3], 2),
        (&[0, 2], 2),
    ] {
        let document = Document::default().with_references([Reference::new("path", path(sharp))]);
        let given = [("tolerance", Value::List(vec![1e-2]))];
        let (outcome, after) = converted(&document, &given);
        assert!(outcome.reached, "{:?}", outcome.remarks);
        let made: Vec<FloatPolygon> = after.curves().map(|it| it.1.polygon.clone()).collect();
        assert_eq!(made.len(), curves, "{sharp:?}: {:?}", outcome.remarks);
        let is_round = sharp.is_empty();
        assert!(made.iter().all(|it| it.is_periodic() == is_round));
        let ends = made.iter().filter(|it| !it.is_periodic());
        let mut ends = ends.flat_map(|it| [0.0, it.segments() as f64].map(|u| it.point(u)));
        assert_eq!(
            ends.any(|end| end.distance(seam) < 1e-9),
            sharp.contains(&0),
            "{sharp:?}"
        );
        let reference = path(sharp);
        for step in 0..=400 {
            let point = reference.jet(step as f64 / 100.0).point;
            let off = made.iter().map(|it| it.nearest(point).distance);
            let off = off.fold(f64::INFINITY, f64::min);
            assert!(off <= 1e-2, "{sharp:?} at {step}: {off}");
        }
    }
}

#[test]
fn references_can_stay_beside_their_curves() {
    let given = [("keep", Value::Switch(true))];
    let (outcome, after) = converted(&drawing(), &given);
    assert!(outcome.reached);
    assert_eq!((after.curves().count(), after.references().count()), (1, 3));
}
