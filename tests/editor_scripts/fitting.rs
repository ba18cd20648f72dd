//! Fits of points: whiskers, points that a click switches, and searches that are stopped.

use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use batten::document::{Document, Edit, Reference};
use batten::editor::{
    Command, Editor, HoverScene, Input, Key, Look, Mark, OperationInProgress, ToolKind,
};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm, find};
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::{Script, operation};

/// Longer than any step here takes: whoever waits so long has failed.
const LONG: Duration = Duration::from_secs(60);

/// A script in which a list of points is active.
fn scan(points: Vec<DVec3>) -> Script {
    let points = PointList::new(points).expect("points");
    let curve = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
    let scan = Edit::AddReference(Box::new(Reference::new("scan", curve)));
    let mut editor = Editor::with_document(Document::default());
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    editor.apply("Add scan", vec![scan]).expect("it is added");
    let scan = editor.document().references().next().expect("a scan").0;
    editor.activate(scan);
    editor.look(Look::All);
    Script { editor }
}

/// Points of a parabola with noise, the tenth of them far off.
fn parabola() -> Vec<DVec3> {
    let points = (0..24).map(|index| {
        let t = 0.1 * f64::from(index);
        let noise = 0.002 * f64::from((index * 37) % 11 - 5);
        let off = if index == 9 { 0.3 } else { 0.0 };
        DVec3::new(t, 0.2 * t * t + noise + off, 0.0)
    });
    points.collect()
}

/// A fit of the parabola that is previewed, with few vertices so that it is found soon.
fn fitting() -> Script {
    let mut script = scan(parabola());
    script.try_out("fit").expect("it can run");
    script
        .set("count", Value::List(vec![9.0]))
        .expect("a count");
    script
}

/// Points of waves that no search fits soon as near as is asked, and a search in the background that has shown a curve.
fn searching() -> (Script, Receiver<()>) {
    let points = (0..90).map(|index| {
        let t = 0.2 * f64::from(index);
        let noise = 0.01 * f64::from((index * 37) % 11 - 5);
        DVec3::new(t, t.sin() + noise, 0.0)
    });
    let mut script = scan(points.collect());
    let (sender, woken) = channel();
    let wake = move || sender.send(()).unwrap_or_default();
    script.editor.run_in_background(Duration::ZERO, wake);
    let begun = script.editor.preview_operation(operation("fit"));
    begun.expect("it can run");
    for (name, value) in [("tolerance", 1e-6), ("time-limit", 86_400.0)] {
        let value = Value::List(vec![value]);
        let set = script.editor.operating().set_values(&[(name, value)]);
        set.expect("a value");
    }
    wait_until(&mut script, |script| !script.made_curves().is_empty());
    assert!(is_pending(&script), "the search goes on");
    (script, woken)
}

/// Make frames until something holds.
#[track_caller]
fn wait_until(script: &mut Script, holds: impl Fn(&Script) -> bool) {
    let begin = Instant::now();
    while !holds(script) {
        assert!(begin.elapsed() < LONG, "it never holds");
        std::thread::sleep(Duration::from_millis(5));
        script.editor.begin_frame();
        script.editor.refresh();
    }
}

fn is_pending(script: &Script) -> bool {
    let operation = script.editor.operation();
    operation.is_some_and(OperationInProgress::is_pending)
}

/// The points that the present values leave out.
fn left_out(script: &Script) -> Vec<usize> {
    let operation = script.editor.operation().expect("an operation");
    let points = operation.fitted_points().expect("points");
    points.left_out().to_vec()
}

/// The points that the result leaves out.
fn outlying(script: &Script) -> Vec<usize> {
    match script.trial_report().figure("outlying_points") {
        Some(Value::Indices(points)) => points,
        other => panic!("{other:?}"),
    }
}

fn at_point(script: &Script, point: usize) -> DVec2 {
    let viewport = script.editor.view().viewport();
    let operation = script.editor.operation().expect("an operation");
    viewport.to_screen(viewport.flatten(operation.input().points()[point]))
}

fn click_point(script: &mut Script, point: usize) {
    let at = at_point(script, point);
    script.click(at);
}

#[test]
fn a_click_leaves_a_point_out_and_another_takes_it_back() {
    let mut script = fitting();
    assert_eq!((left_out(&script), outlying(&script)), (vec![9], vec![9]));
    for (point, expected) in [(5, vec![5, 9]), (9, vec![5]), (5, vec![]), (20, vec![20])] {
        click_point(&mut script, point);
        assert_eq!(left_out(&script), expected, "a click on {point}");
        assert_eq!(outlying(&script), expected, "a click on {point}");
    }
    // Each click is one change of values.
    for expected in [vec![], vec![5], vec![5, 9], vec![9]] {
        script.command(Command::Undo);
        assert_eq!(outlying(&script), expected);
    }
    assert!(script.editor.previewed_operation().is_some());
}

#[test]
fn a_click_beside_the_points_switches_none() {
    let mut script = fitting();
    let before = script.editor.operation().expect("a fit").values().clone();
    script.click(DVec2::new(500.0, 20.0));
    let after = script.editor.operation().expect("a fit").values();
    assert_eq!(*after, before);
}

#[test]
fn an_applied_fit_takes_clicks_on_points_with_the_select_tool_alone() {
    let mut script = fitting();
    script.editor.operating().apply().expect("a result");
    assert_eq!(script.steps(), 2, "the scan and the fit");
    click_point(&mut script, 5);
    assert_eq!(outlying(&script), [5, 9]);
    assert_eq!(script.steps(), 2, "the step is amended");
    let at = at_point(&script, 7);
    script.tool(ToolKind::Measure);
    script.click(at);
    script.tool(ToolKind::Select);
    let is_left_out = |script: &Script| {
        let operation = script.editor.operation();
        let points = operation.and_then(|it| it.fitted_points());
        points.is_some_and(|points| points.left_out().contains(&7))
    };
    assert!(!is_left_out(&script));
}

#[test]
fn whiskers_go_from_the_curve_through_the_points_as_many_times_longer_as_the_scale() {
    let mut script = fitting();
    script.editor.view_mut().whiskers.scale = Some(20.0);
    let (points, polygon) = (parabola(), script.polygon());
    let marks = script.scene().marks.clone();
    let whiskers = marks.iter().find_map(|mark| match mark {
        Mark::Whiskers { lines, .. } => Some(lines.clone()),
        _ => None,
    });
    let whiskers = whiskers.expect("whiskers");
    let kept: Vec<DVec3> = (0..24).filter(|it| *it != 9).map(|it| points[it]).collect();
    assert_eq!(whiskers.len(), kept.len());
    let mut largest = 0.0_f64;
    for ([foot, tip], point) in whiskers.into_iter().zip(kept) {
        let nearest = polygon.nearest(point);
        largest = largest.max(nearest.distance);
        assert!(foot.distance(nearest.point.truncate()) < 1e-12);
        let far = 20.0 * (point - nearest.point).truncate();
        assert!((tip - foot).distance(far) < 1e-12);
    }
    let told = format!(
        "largest distance {}",
        batten::geometry::significant(largest, 4)
    );
    let is_told = |mark: &Mark| matches!(mark, Mark::Extreme { text, .. } if *text == told);
    assert_eq!(
        marks.iter().filter(|mark| is_told(mark)).count(),
        1,
        "{marks:?}"
    );
    let shown = marks.iter().find_map(|mark| match mark {
        Mark::Points { kept, left_out, .. } => Some((kept.len(), left_out.clone())),
        _ => None,
    });
    assert_eq!(shown, Some((23, vec![points[9].truncate()])));

    script.editor.view_mut().whiskers.shown = false;
    let marks = &script.scene().marks;
    assert!(
        !marks
            .iter()
            .any(|mark| matches!(mark, Mark::Whiskers { .. }))
    );
}

#[test]
fn the_pointer_tells_what_a_click_on_a_point_would_do() {
    let mut script = fitting();
    for (point, expected) in [(4, "Click leaves it out"), (9, "click takes it back")] {
        let at = at_point(&script, point);
        script.move_to(at);
        let Some(HoverScene::Handle { text, .. }) = script.scene().hover.clone() else {
            panic!("nothing is hovered");
        };
        assert!(text.contains(&format!("Point {point}\n")), "{text}");
        assert!(
            text.contains("distance ") && text.contains(expected),
            "{text}"
        );
        assert!(
            script
                .editor
                .hint()
                .starts_with("Click to leave the point out")
        );
    }
}

#[test]
fn stop_keeps_the_best_that_was_found() {
    let (mut script, _woken) = searching();
    let before = script.steps();
    script.editor.operating().stop();
    wait_until(&mut script, |script| !is_pending(script));
    let report = serde_json::to_value(script.trial_report()).expect("a report");
    let remarks = report["remarks"].to_string();
    assert!(
        remarks.contains("Stopped: this is the best found so far"),
        "{remarks}"
    );
    assert_eq!(script.made_curves().len(), 1);
    let found = script.polygon();
    let applied = script.editor.operating().apply();
    applied.expect("the best found can be applied");
    script
        .editor
        .operating()
        .apply()
        .expect("once more changes nothing");
    assert_eq!((script.steps(), script.polygon()), (before + 1, found));
    script.command(Command::Undo);
    assert_eq!(script.editor.document().len(), 0);
}

#[test]
fn a_search_that_is_applied_and_stopped_is_applied_with_the_best_found() {
    let (mut script, _woken) = searching();
    let before = script.steps();
    script.editor.operating().apply().expect("it waits");
    assert_eq!(script.steps(), before);
    script.editor.operating().stop();
    wait_until(&mut script, |script| !is_pending(script));
    assert_eq!(script.steps(), before + 1);
    assert!(
        script
            .editor
            .operation()
            .is_some_and(OperationInProgress::is_applied)
    );
}

#[test]
fn values_that_are_edited_during_a_search_begin_another_that_can_be_stopped() {
    let (mut script, _woken) = searching();
    script.editor.operating().stop();
    let degree = ("degree", Value::Whole(4));
    let set = script.editor.operating().set_values(&[degree]);
    set.expect("a degree");
    let is_degree = |script: &Script| {
        let made = script.made_curves();
        let curve = made
            .first()
            .and_then(|id| script.editor.document().curve(*id));
        curve.is_some_and(|curve| curve.polygon.degree() == 4)
    };
    wait_until(&mut script, is_degree);
    assert!(is_pending(&script), "stopping was about the search before");
    script.editor.operating().stop();
    wait_until(&mut script, |script| !is_pending(script));
    assert_eq!(script.polygon().degree(), 4);
}

#[test]
fn a_search_that_is_left_leaves_nothing_behind() {
    type Leave = fn(&mut Script);
    let ways: [(&str, Leave); 5] = [
        ("Esc", |script| script.input(Input::Key(Key::Escape))),
        ("closing the panel", |script| {
            script.editor.operating().leave()
        }),
        ("a vertex key", |script| script.command(Command::Delete)),
        ("undo", |script| {
            while script.editor.previewed_operation().is_some() {
                script.command(Command::Undo);
            }
        }),
        ("another document", |script| {
            batten::editor::told(script.editor.open_example(0));
        }),
    ];
    for (way, leave) in ways {
        let (mut script, _woken) = searching();
        leave(&mut script);
        let is_left = script.editor.previewed_operation().is_none();
        if is_left {
            let left = script.editor.document().clone();
            std::thread::sleep(Duration::from_millis(100));
            script.editor.begin_frame();
            script.editor.refresh();
            let now = script.editor.document();
            assert!(now.is_same(&left), "{way}: a late result");
            let mut names = now.curves().map(|(_, curve)| curve.name.clone());
            assert!(
                names.all(|name| name != "fit"),
                "{way}: a curve that nobody applied"
            );
        } else {
            // The panel stays: then its search does, or has ended with a report.
            assert!(is_pending(&script), "{way}");
        }
    }
}

#[test]
fn an_approximation_that_is_stopped_keeps_the_best_found() {
    for from_curve in [false, true] {
        let mut script = Script::example("s-curve");
        if !from_curve {
            let kind = find("conical-spiral").expect("a kind");
            script.command(Command::AddReference(kind));
        }
        let before = script.editor.document().clone();
        script.editor.run_in_background(Duration::ZERO, || ());
        let begun = script.editor.preview_operation(operation("approximate"));
        begun.expect("it can run");
        for (name, value) in [
            ("degree", Value::Whole(2)),
            ("tolerance", Value::List(vec![1e-12])),
            ("time-limit", Value::List(vec![86_400.0])),
        ] {
            let set = script.editor.operating().set_values(&[(name, value)]);
            set.expect("a value");
        }
        let is_shown = |script: &Script| !script.editor.document().is_same(&before);
        wait_until(&mut script, is_shown);
        assert!(is_pending(&script), "the search goes on");
        script.editor.operating().stop();
        wait_until(&mut script, |script| !is_pending(script));
        let report = serde_json::to_value(script.trial_report()).expect("a report");
        let remarks = report["remarks"].to_string();
        assert!(remarks.contains("Stopped: "), "{remarks}");
        script.editor.operating().leave();
        assert!(script.editor.document().is_same(&before));
    }
}

#[test]
fn a_tolerance_below_the_noise_is_told_during_the_search() {
    let (script, _woken) = searching();
    let expectation = |script: &Script| {
        let points = script.editor.operation()?.fitted_points()?;
        points.expectation().map(str::to_owned)
    };
    let told = expectation(&script).expect("the tolerance is far too small");
    assert!(
        told.starts_with("The tolerance 1e-6 is below the estimated noise 0.0"),
        "{told}"
    );
    let mut coarse = fitting();
    assert_eq!(expectation(&coarse), None);
    let wide = Value::List(vec![0.5]);
    coarse.set("tolerance", wide).expect("a tolerance");
    assert_eq!(expectation(&coarse), None);
}
