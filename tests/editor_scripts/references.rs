//! References under the hand: added, picked, moved, rotated, scaled, hidden, copied, and measured by.

use batten::document::{CurveId, Edit, MatchPlace, Reference};
use batten::editor::{
    Command, EndFitAction, FeatureKind, HoverScene, Key, Mark, Modifiers, NamedView, PlotKind,
    ReferenceChange, ToolKind, Transformation,
};
use batten::geometry::references::{
    AnalyticForm, Placement, PointList, ReferenceCurve, ReferenceError, ReferenceForm, find,
};
use batten::geometry::{Continuity, End, ParametricCurve, figure};
use glam::{DQuat, DVec2, DVec3};

use super::script::Script;
use super::several::two;

/// What is left of a match that is met, in units of the curve's size.
const MET: f64 = 1e-9;

/// What a drag of whole screen points leaves of rounding, in units of what is moved.
const ROUNDING: f64 = 1e-12;

/// The paper's arc and a reference where its formula puts it, which is active, seen as a whole.
fn with(kind: &str) -> (Script, CurveId) {
    let mut script = Script::example("arc");
    let id = script.editor.document().next_id();
    let kind = find(kind).expect("a kind");
    let form = AnalyticForm::new(kind, kind.defaults()).expect("a form");
    let curve = ReferenceCurve::of(ReferenceForm::Analytic(form)).expect("a curve");
    let reference = Reference::new(kind.label.to_lowercase(), curve);
    let added = vec![Edit::AddReference(Box::new(reference))];
    script
        .editor
        .apply("Add reference", added)
        .expect("an edit");
    script.editor.activate(id);
    script.command(Command::FitAll);
    (script, id)
}

fn reference(script: &Script, id: CurveId) -> Reference {
    let found = script.editor.document().reference(id);
    Reference::clone(found.expect("a reference"))
}

fn curve(script: &Script, id: CurveId) -> ReferenceCurve {
    reference(script, id).curve
}

/// Where the point at a share of a reference is on the canvas.
fn seen(script: &Script, id: CurveId, share: f64) -> DVec2 {
    let shape = script.editor.document().shape(id).expect("a shape");
    let point = shape.jet(share * shape.pieces() as f64).point;
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(point))
}

/// The frame's corners and the handle that rotates, on the canvas.
fn frame(script: &mut Script) -> ([DVec2; 4], DVec2) {
    let viewport = *script.editor.view().viewport();
    let frame = script.scene().marks.iter().find_map(|mark| match mark {
        Mark::Frame { corners, arm } => Some((*corners, arm[1])),
        _ => None,
    });
    let (corners, turn) = frame.expect("a frame");
    (
        corners.map(|corner| viewport.to_screen(corner)),
        viewport.to_screen(turn),
    )
}

#[test]
fn a_new_reference_is_active_named_and_seen_and_one_step() {
    let (mut script, id) = with("circle");
    assert_eq!(reference(&script, id).name, "circle");
    assert_eq!(script.steps(), 1);
    let scene = script.scene();
    let drawn = scene
        .curves
        .iter()
        .find(|it| it.id == Some(id))
        .expect("it");
    assert!(drawn.is_reference && drawn.active && drawn.curve.len() > 16);
    script.command(Command::AddReference(find("circle").expect("a kind")));
    let second = script.curve();
    assert_eq!(reference(&script, second).name, "circle 2");
    // It is where its formula puts it, in units of the document.
    assert_eq!(*curve(&script, second).placement(), Placement::default());
    let [right, left] = [0.0, 0.5].map(|share| seen(&script, second, share));
    let scale = script.editor.view().viewport().scale;
    assert!(((right.x - left.x) / scale - 2.0).abs() < 1e-9);
    script.command(Command::Undo);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().references().len(), 0);
    assert_eq!(script.editor.document().len(), 1);
    script.command(Command::Redo);
    assert_eq!(script.curve(), id, "what comes back is active");
}

#[test]
fn a_reference_that_would_be_a_speck_or_out_of_sight_is_gone_to() {
    let zoomed = |command| {
        let mut script = Script::example("arc");
        for _ in 0..30 {
            script.command(command);
        }
        script.command(Command::AddReference(find("circle").expect("a kind")));
        let id = script.curve();
        let [right, left] = [0.0, 0.5].map(|share| seen(&script, id, share));
        assert_eq!(*curve(&script, id).placement(), Placement::default());
        ((right.x - left.x).abs(), 0.5 * (right + left))
    };
    let (extent, middle) = zoomed(Command::ZoomOut);
    assert!((200.0..700.0).contains(&extent), "{extent}");
    assert!(middle.distance(DVec2::new(500.0, 350.0)) < 1.0, "{middle}");
    let (extent, middle) = zoomed(Command::ZoomIn);
    assert!((30.0..700.0).contains(&extent), "{extent}");
    assert!(middle.cmpge(DVec2::ZERO).all() && middle.cmple(DVec2::new(1000.0, 700.0)).all());
}

#[test]
fn a_drag_moves_the_reference_and_esc_restores_it_to_the_bit() {
    for kind in ["circle", "conical-spiral", "clothoid"] {
        let (mut script, id) = with(kind);
        let before = curve(&script, id);
        let by = DVec2::new(60.0, -30.0);
        let from = seen(&script, id, 0.3);
        script.command(Command::ToggleSnapping);
        let steps = script.steps();
        let viewport = *script.editor.view().viewport();
        let snaps = script.editor.hand().snaps();
        if snaps {
            script.command(Command::ToggleSnapping);
        }
        script.drag(from, from + by);
        let moved = curve(&script, id).placement().translation();
        let by = by / viewport.scale;
        let expected = before.placement().translation() + DVec3::new(by.x, -by.y, 0.0);
        assert!(
            moved.distance(expected) <= 1e-9 * expected.length().max(1.0),
            "{kind}: {moved}"
        );
        assert_eq!(script.steps(), steps + 1);
        script.command(Command::Undo);
        assert_eq!(curve(&script, id), before);

        script.press(from);
        script.move_to(from + DVec2::new(40.0, 40.0));
        script.move_to(from + DVec2::new(80.0, 10.0));
        assert_ne!(curve(&script, id), before);
        script.key(Key::Escape);
        assert_eq!(curve(&script, id), before, "{kind}");
        assert_eq!(script.steps(), steps);
    }
}

#[test]
fn the_frame_scales_about_the_opposite_corner_and_rotates_about_its_middle() {
    let (mut script, id) = with("circle");
    let before = curve(&script, id);
    let (corners, turn) = frame(&mut script);
    let arm = corners[2] - corners[0];
    script.drag(corners[2], corners[0] + 0.5 * arm);
    let scaled = curve(&script, id);
    assert!(
        (scaled.placement().scale() - 0.5).abs() <= 0.01,
        "{scaled:?}"
    );
    let (now, _) = frame(&mut script);
    // The margin of the frame keeps its size on the screen.
    assert!(now[0].distance(corners[0]) < 20.0, "{now:?} {corners:?}");
    script.command(Command::Undo);
    assert_eq!(curve(&script, id), before);

    let middle = 0.5 * (corners[0] + corners[2]);
    let quarter = middle + DVec2::new(turn.y - middle.y, 0.0).abs();
    script.modifiers(Modifiers {
        shift: true,
        ..Modifiers::NONE
    });
    script.drag(turn, quarter);
    script.modifiers(Modifiers::NONE);
    let turned = curve(&script, id);
    let expected = DQuat::from_rotation_z((-90f64).to_radians());
    let angle = turned.placement().rotation().angle_between(expected);
    assert!(angle <= 1e-7, "{turned:?}");
    assert!(turned.is_planar(), "turning within the plane stays in it");
    script.command(Command::Undo);
    assert_eq!(curve(&script, id), before);
}

#[test]
fn in_space_it_rotates_about_the_direction_of_the_view() {
    let (mut script, id) = with("conical-spiral");
    script.command(Command::View(NamedView::Isometric));
    script.command(Command::FitAll);
    let before = curve(&script, id);
    let (corners, turn) = frame(&mut script);
    let middle = 0.5 * (corners[0] + corners[2]);
    let radius = middle.distance(turn);
    script.drag(turn, middle + radius * DVec2::from_angle(0.3));
    let turned = curve(&script, id);
    let rotation = turned.placement().rotation() * before.placement().rotation().inverse();
    let (axis, angle) = rotation.to_axis_angle();
    let towards = NamedView::Isometric.orientation().towards();
    assert!(axis.cross(towards).length() <= 1e-9, "{axis}");
    assert!(angle > 0.1);
    // Nothing moves towards the eye or away from it.
    for u in [0.0, 1.7, 3.2] {
        let [from, to] = [&before, &turned].map(|curve| curve.jet(u).point.dot(towards));
        assert!((from - to).abs() <= ROUNDING * 1e3, "{from} {to}");
    }
    script.command(Command::Undo);
    assert_eq!(curve(&script, id), before);
}

#[test]
fn undo_in_the_middle_of_a_drag_takes_back_the_drag_alone() {
    let (mut script, id) = with("circle");
    let at = seen(&script, id, 0.3);
    script.drag(at, at + DVec2::new(30.0, 10.0));
    let (before, steps) = (curve(&script, id), script.steps());
    let (corners, turn) = frame(&mut script);
    for from in [seen(&script, id, 0.3), corners[2], turn] {
        script.press(from);
        script.move_to(from + DVec2::new(20.0, 8.0));
        script.move_to(from + DVec2::new(40.0, 16.0));
        assert_ne!(curve(&script, id), before);
        script.command(Command::Undo);
        assert_eq!(curve(&script, id), before);
        assert_eq!(script.steps(), steps);
        script.move_to(from + DVec2::new(60.0, 16.0));
        script.release(from + DVec2::new(60.0, 16.0));
        assert_eq!(curve(&script, id), before);
        assert_eq!(script.steps(), steps);
    }
    // A field that shows what there was before is no step: nothing before it is taken back.
    let origin = before.placement().translation();
    let shown = ReferenceChange::Translate(origin).preview(&mut script.editor);
    shown.expect("a place");
    script.command(Command::Undo);
    assert_eq!(curve(&script, id), before);
    assert_eq!(script.steps(), steps);
}

#[test]
fn the_rotate_and_the_scale_tool_take_a_reference_as_one_step() {
    let (mut script, id) = with("clothoid");
    let (before, steps) = (curve(&script, id), script.steps());
    script.tool(ToolKind::Rotate);
    let pivot = script
        .editor
        .hand()
        .pivot(&script.editor.context())
        .expect("a pivot");
    let at = script.editor.view().viewport().to_screen(pivot);
    let arm = DVec2::new(80.0, 0.0);
    script.drag(at + arm, at + DVec2::from_angle(-0.5).rotate(arm));
    let turned = curve(&script, id);
    let turn = DQuat::from_rotation_z(0.5);
    let angle = turned.placement().rotation().angle_between(turn);
    assert!(angle <= 1e-7, "{turned:?}");
    let pivot = pivot.extend(0.0);
    for u in [0.1, 0.8] {
        let expected = pivot + turn * (before.jet(u).point - pivot);
        let distance = turned.jet(u).point.distance(expected);
        assert!(distance <= ROUNDING * 1e3, "{distance}");
    }
    assert!(turned.is_planar());
    assert_eq!(script.steps(), steps + 1);
    script.command(Command::Undo);
    assert_eq!(curve(&script, id), before);

    // In mid-drag Esc restores to the bit; what is typed does the same.
    script.tool(ToolKind::Scale);
    script.press(at + arm);
    script.move_to(at + 2.0 * arm);
    let dragged = curve(&script, id);
    script.key(Key::Escape);
    assert_eq!(curve(&script, id), before);
    script.release(at + arm);
    let scaled = script.editor.transform(Transformation::Scale(2.0));
    scaled.expect("a scale");
    let typed = curve(&script, id);
    for found in [&dragged, &typed] {
        let placement = found.placement();
        let ratio = placement.scale() / before.placement().scale();
        assert!((ratio - 2.0).abs() <= 1e-9, "{ratio}");
        let still = pivot + 2.0 * (before.placement().translation() - pivot);
        assert!(placement.translation().distance(still) <= 1e-9);
    }
    assert_eq!(script.steps(), steps + 1);
    // It cannot be turned inside out, nor vanish.
    for factor in [0.0, -1.0] {
        let refused = script.editor.transform(Transformation::Scale(factor));
        assert!(refused.is_err(), "{factor}");
        assert_eq!(curve(&script, id), typed);
    }
    // What is locked stays.
    script.command(Command::ToggleLocked);
    script.tool(ToolKind::Rotate);
    assert_eq!(script.editor.hand().pivot(&script.editor.context()), None);
    assert!(
        script
            .editor
            .transform(Transformation::Rotate(1.0))
            .is_err()
    );
    assert_eq!(curve(&script, id), typed);
}

#[test]
fn its_distance_from_a_curve_is_measured_and_marked() {
    let (mut script, circle) = with("circle");
    // The arc is seen against a circle of radius 9 about the same centre.
    for change in [
        ReferenceChange::Scale(1.0),
        ReferenceChange::Translate(DVec3::ZERO),
        ReferenceChange::Value(0, 9.0),
    ] {
        change.apply(&mut script.editor).expect("a circle");
    }
    script.editor.refresh();
    assert!(script.editor.sight().deviation().is_none());
    let arc = script.editor.document().ids().next().expect("the arc");
    let polygon = script
        .editor
        .document()
        .curve(arc)
        .expect("the arc")
        .polygon
        .clone();
    let far = |u: f64| (polygon.point(u).length() - 9.0).abs();
    let largest = (0..=1000)
        .map(|step| far(f64::from(step) / 1000.0))
        .fold(0.0, f64::max);
    for (active, compared) in [(arc, circle), (circle, arc)] {
        script.editor.activate(active);
        script.command(Command::Compare(Some(compared)));
        script.editor.refresh();
        let deviation = script
            .editor
            .sight()
            .deviation()
            .expect("a deviation")
            .clone();
        let sides = &deviation.sides;
        let [own, other] = if active == arc { [0, 1] } else { [1, 0] };
        let found = sides[own].as_ref().expect("the arc's side");
        let most = found.largest.distance();
        assert!((most / largest - 1.0).abs() <= 1e-6, "{found:?}");
        assert!(found.mean <= most && found.mean > 0.999 * most);
        assert!((far(found.largest.at) - most).abs() <= ROUNDING);
        let [_, to] = found.largest.places;
        assert!((to.length() - 9.0).abs() <= ROUNDING);
        // Seen from the whole circle, the far side of it counts.
        let (side, found) = deviation.largest().expect("a distance");
        assert_eq!(side, other);
        assert!(found.distance() > 15.0, "{found:?}");
        let marks = script.scene().marks.clone();
        let text = format!("distance {}", figure(found.distance()));
        assert!(
            marks
                .iter()
                .any(|mark| matches!(mark, Mark::Extreme { text: own, .. } if *own == text))
        );
    }
    // Whiskers beyond a limit are marked apart.
    let whiskers = |script: &mut Script, limit: Option<f64>| {
        script.editor.view_mut().whiskers.limit = limit;
        script.editor.refresh();
        let marks = script.scene().marks.clone();
        let of = |mark: &Mark| match mark {
            Mark::Whiskers { lines, beyond } => Some((lines.len(), *beyond)),
            _ => None,
        };
        marks.iter().filter_map(of).collect::<Vec<_>>()
    };
    assert_eq!(whiskers(&mut script, None), [(202, false), (0, true)]);
    let [(within, _), (beyond, _)] = whiskers(&mut script, Some(1.0))[..] else {
        panic!("whiskers within and beyond the limit");
    };
    assert!(within > 100 && beyond > 50, "{within} {beyond}");
    // It follows a drag, and is not marked where one of both is hidden.
    script.editor.activate(arc);
    script.command(Command::Compare(Some(circle)));
    script.editor.refresh();
    let scale = script.editor.sight().deviation_scale();
    let from = script.at_vertex(3);
    script.press(from);
    script.move_to(from - DVec2::new(0.0, 400.0));
    script.editor.refresh();
    let sight = script.editor.sight();
    assert_eq!(sight.deviation_scale(), scale, "whiskers keep their scale");
    script.move_to(from - DVec2::new(0.0, 30.0));
    script.release(from - DVec2::new(0.0, 30.0));
    script.editor.refresh();
    let dragged = script.editor.sight().deviation().expect("a deviation");
    let from_arc = dragged.sides[0].as_ref().expect("the arc's side");
    assert!(from_arc.largest.distance() > largest);
    script.command(Command::ToggleVisible);
    let is_mark = |mark: &Mark| matches!(mark, Mark::Extreme { .. });
    assert!(!script.scene().marks.iter().any(is_mark));
    script.command(Command::Compare(None));
    script.editor.refresh();
    assert!(script.editor.sight().deviation().is_none());
}

#[test]
fn a_list_of_points_is_measured_point_by_point() {
    let mut script = Script::example("arc");
    let arc = script.curve();
    let polygon = script.polygon();
    let place = polygon.point(0.4);
    let out = place.normalize();
    let points = [polygon.point(0.2), place + 0.25 * out, polygon.point(0.7)];
    let rows = points.map(|point| format!("{},{}", point.x, point.y));
    script
        .editor
        .paste(&rows.join("\n"))
        .expect("a list of points");
    script.command(Command::Compare(Some(arc)));
    script.editor.refresh();
    let found = script.editor.sight().deviation().expect("a deviation");
    let [Some(found), None] = &found.sides else {
        panic!("points count from their side alone: {found:?}");
    };
    // What is pasted stands aside: the points are measured where they are.
    let (_, list) = script
        .editor
        .document()
        .references()
        .next()
        .expect("a list");
    let points = list.points().expect("points");
    let nearest = |point: DVec3| {
        let places = (0..=20_000).map(|step| polygon.point(f64::from(step) / 20_000.0));
        places
            .map(|place| place.distance(point))
            .fold(f64::INFINITY, f64::min)
    };
    let distances: Vec<f64> = points.iter().map(|point| nearest(*point)).collect();
    let largest = distances.iter().copied().fold(0.0, f64::max);
    let mean = distances.iter().sum::<f64>() / 3.0;
    let most = &found.largest;
    assert!((most.distance() / largest - 1.0).abs() <= 1e-6, "{found:?}");
    assert!((found.mean / mean - 1.0).abs() <= 1e-6, "{found:?}");
    assert_eq!(distances[most.at as usize], largest);
    assert_eq!(most.places[0], points[most.at as usize]);
}

#[test]
fn the_status_bar_tells_the_references_own_parameter() {
    let (mut script, id) = with("circle");
    script.move_to(seen(&script, id, 0.25));
    script.editor.refresh();
    let readout = script.editor.sight().readout();
    assert_eq!(readout.parameter_name, "t");
    let [from, to] = curve(&script, id).interval();
    let expected = from + 0.25 * (to - from);
    let found = readout.parameter.expect("a parameter");
    assert!(
        (found - expected).abs() <= 1e-2 * (to - from),
        "{found} {expected}"
    );
}

#[test]
fn hidden_and_locked_references_are_left_alone() {
    let (mut script, id) = with("circle");
    let from = seen(&script, id, 0.3);
    let before = curve(&script, id);
    script.command(Command::ToggleLocked);
    script.drag(from, from + DVec2::new(50.0, 0.0));
    assert_eq!(curve(&script, id), before);
    let refused = ReferenceChange::Scale(3.0).apply(&mut script.editor);
    assert!(refused.is_err());
    let refused = script.editor.execute(Command::DeleteCurve);
    assert!(refused.is_err(), "what is locked is not deleted");
    script.click(from);
    assert_eq!(script.curve(), id, "but it is picked");
    script.command(Command::ToggleLocked);
    script.command(Command::ToggleVisible);
    assert!(script.scene().curves.iter().all(|it| it.id != Some(id)));
    script.move_to(from);
    assert_eq!(script.scene().hover, None);
    script.drag(from, from + DVec2::new(50.0, 0.0));
    assert_eq!(curve(&script, id), before);
}

#[test]
fn a_click_selects_it_and_a_curve_in_front_of_it_comes_first() {
    let (mut script, [arc, other]) = two();
    script.command(Command::AddReference(find("circle").expect("a kind")));
    let id = script.curve();
    script.command(Command::FitAll);
    script.editor.activate(arc);
    script.click(seen(&script, id, 0.4));
    assert_eq!(script.curve(), id);
    assert!(script.editor.hand().selection().is_empty());
    script.click(seen(&script, other, 0.5));
    assert_eq!(script.curve(), other);
}

#[test]
fn parameters_are_changed_one_step_each_and_what_cannot_be_is_refused() {
    let (mut script, id) = with("circle");
    let steps = script.steps();
    let change = |script: &mut Script, change: ReferenceChange| {
        let reply = change.apply(&mut script.editor);
        script.check();
        reply
    };
    change(&mut script, ReferenceChange::Value(0, 7.5)).expect("a radius");
    change(&mut script, ReferenceChange::Interval([0.0, 1.0])).expect("an interval");
    change(&mut script, ReferenceChange::Translate(DVec3::X)).expect("a place");
    change(&mut script, ReferenceChange::Scale(2.0)).expect("a scale");
    assert_eq!(script.steps(), steps + 4);
    let start = curve(&script, id).jet(0.0).point;
    assert!(
        start.distance(DVec3::new(16.0, 0.0, 0.0)) <= ROUNDING * 16.0,
        "{start}"
    );
    let before = curve(&script, id);
    for refused in [
        ReferenceChange::Value(0, -1.0),
        ReferenceChange::Interval([2.0, 1.0]),
        ReferenceChange::Scale(0.0),
        ReferenceChange::Translate(DVec3::NAN),
    ] {
        assert!(change(&mut script, refused.clone()).is_err(), "{refused:?}");
        assert_eq!(curve(&script, id), before);
    }
    // While a field is dragged nothing is refused aloud; the last good form stays.
    let mut preview = |value| {
        let change = ReferenceChange::Value(0, value);
        change.preview(&mut script.editor)
    };
    assert!(preview(9.0).is_ok() && preview(-9.0).is_err());
    script.check();
    assert_ne!(curve(&script, id), before);
    script.editor.abort_preview();
    assert_eq!(curve(&script, id), before);
}

#[test]
fn it_is_nudged_by_the_arrow_keys() {
    let (mut script, id) = with("circle");
    let before = curve(&script, id);
    script.key(Key::Right);
    let nudged = curve(&script, id).placement().translation() - before.placement().translation();
    assert!(nudged.x > 0.0 && nudged.y == 0.0);
    script.command(Command::Undo);
    assert_eq!(curve(&script, id), before);
}

#[test]
fn it_is_copied_cut_pasted_duplicated_and_deleted() {
    let (mut script, id) = with("circle");
    let text = script
        .editor
        .copy(batten::editor::CopyForm::Own)
        .expect("a copy");
    script.editor.paste(&text).expect("a reference");
    script.check();
    let copy = script.curve();
    assert_eq!(script.message(), "1 reference pasted");
    assert_eq!(reference(&script, copy).name, "circle 2");
    assert_eq!(curve(&script, copy).form(), curve(&script, id).form());
    assert_ne!(
        curve(&script, copy).placement(),
        curve(&script, id).placement()
    );
    script.command(Command::Duplicate);
    assert_eq!(reference(&script, script.curve()).name, "circle 3");
    script.command(Command::DeleteCurve);
    assert_eq!(script.message(), "“circle 3” deleted");
    script.editor.activate(copy);
    script.editor.cut().expect("a cut");
    script.check();
    assert_eq!(script.editor.document().references().len(), 1);
    script.undo_all();
    assert_eq!(script.editor.document().references().len(), 0);
}

#[test]
fn a_pasted_table_of_points_is_a_list_that_is_drawn_and_has_no_comb() {
    let mut script = Script::example("arc");
    let pasted = script.editor.paste("x\ty\n0\t0\n1,5\t2\n4\t1\n");
    pasted.expect("points");
    script.check();
    assert_eq!(
        script.message(),
        "1 reference pasted\nread with tabs between columns and decimal commas"
    );
    let id = script.curve();
    script.command(Command::FitAll);
    let scene = script.scene();
    let drawn = scene
        .curves
        .iter()
        .find(|it| it.id == Some(id))
        .expect("it");
    assert_eq!(drawn.points.len(), 3);
    assert!(drawn.comb.is_empty() && drawn.teeth.is_empty() && drawn.evolute.is_empty());
    assert!(script.plots().series.is_empty());
    let features = script.features().expect("a report");
    assert!(features.sampled && features.rows.is_empty());
}

#[test]
fn its_comb_evolute_plots_and_features_are_shown() {
    let (mut script, id) = with("log-aesthetic");
    for layer in [batten::editor::Layer::Comb, batten::editor::Layer::Evolute] {
        if Command::ToggleLayer(layer).is_checked(&script.editor) == Some(false) {
            script.command(Command::ToggleLayer(layer));
        }
    }
    let scene = script.scene();
    let drawn = scene
        .curves
        .iter()
        .find(|it| it.id == Some(id))
        .expect("it");
    assert!(!drawn.comb.is_empty() && !drawn.teeth.is_empty() && !drawn.evolute.is_empty());
    assert!(!script.plots().series.is_empty());
    let level = batten::analysis::LevelPlot::Curvature(2);
    assert!(!script.level_plot(level, false).series.is_empty());
    script.editor.view_mut().plot = Some(PlotKind::Harmony);
    script.check();
    assert!(script.plots().flow.iter().all(Vec::is_empty));
    let features = script.features().expect("a report");
    assert!(features.sampled, "features of references are not proved");
    assert_eq!(features.count(&[FeatureKind::CurvatureMaximum]), 0);
}

#[test]
fn the_sampled_features_of_an_inner_curve_are_where_they_are() {
    // The clothoid from −2 to 2 has its inflection at t = 0 and no extremum within.
    let mut script = Script::example("arc");
    script.command(Command::AddReference(find("clothoid").expect("a kind")));
    let change = ReferenceChange::Interval([-2.0, 1.0]);
    change.apply(&mut script.editor).expect("an interval");
    let features = script.features().expect("a report");
    let [row] = &features.rows[..] else {
        panic!("{:?}", features.rows);
    };
    assert_eq!(row.kind, FeatureKind::Inflection);
    assert!(row.u[0].abs() <= 1e-12, "{row:?}");
}

#[test]
fn vertices_snap_to_its_ends_its_points_and_the_curve() {
    let (mut script, id) = with("circle");
    let start = curve(&script, id).jet(0.0).point;
    let arc = script.editor.document().ids().next().expect("a curve");
    script.editor.activate(arc);
    if !script.editor.hand().snaps() {
        script.command(Command::ToggleSnapping);
    }
    let from = script.at_vertex_of(arc, 4);
    script.drag(from, seen(&script, id, 0.0) + DVec2::new(2.0, 3.0));
    let vertex = |script: &Script| {
        let curve = script.editor.document().curve(arc).expect("a curve");
        curve.polygon.vertex(4)
    };
    assert_eq!(vertex(&script), start);
    script.command(Command::Undo);
    let on = seen(&script, id, 0.37);
    script.drag(script.at_vertex_of(arc, 4), on + DVec2::new(1.0, 1.0));
    let radius = start.length();
    let off = (vertex(&script).length() - radius).abs();
    assert!(off <= 1e-9 * radius, "{off}");
}

#[test]
fn points_past_an_end_are_left_out_of_the_deviation_on_demand() {
    let mut script = Script::example("arc");
    let arc = script.curve();
    let polygon = script.polygon();
    let end = polygon.end_jet(End::Finish);
    let onward = end.tangent().expect("a direction");
    // One point beside the curve, one past its end.
    let beside = polygon.point(0.5 * polygon.segments() as f64) + 0.25 * DVec3::Z;
    let points = PointList::new(vec![beside, end.point + 4.0 * onward]).expect("points");
    let points = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
    let edit = Edit::AddReference(Box::new(Reference::new("scan", points)));
    script.editor.apply("Add", vec![edit]).expect("an edit");
    let scan = script.editor.document().all_ids().last().expect("a scan");
    script.editor.activate(arc);
    script.command(Command::Compare(Some(scan)));
    let mut largest = |within_ends: bool| {
        script.editor.view_mut().whiskers.within_ends = within_ends;
        script.editor.refresh();
        let sight = script.editor.sight();
        let whole = sight.whole_deviation().expect("a deviation");
        assert_eq!(whole.past_ends().map(|(past, _)| past), Some(1));
        let shown = sight.deviation().expect("a deviation");
        let largest = shown.largest().expect("a distance").1.distance();
        let marks = script.scene().marks.clone();
        let of = |mark: &Mark| match mark {
            Mark::Whiskers { lines, .. } => lines.len(),
            _ => 0,
        };
        (largest, marks.iter().map(of).sum::<usize>())
    };
    let [all, within] = [false, true].map(&mut largest);
    assert!((all.0 - 4.0).abs() <= 1e-9 && all.1 == 2, "{all:?}");
    assert!(
        (within.0 - 0.25).abs() <= 1e-9 && within.1 == 1,
        "{within:?}"
    );
    assert_eq!(largest(false), all);
}

#[test]
fn an_end_is_matched_to_it_by_a_click_and_follows_its_parameters() {
    let (mut script, id) = with("circle");
    let arc = script.editor.document().ids().next().expect("a curve");
    script.editor.activate(arc);
    script.tool(ToolKind::EndFit);
    script.end_fit_action(EndFitAction::Choose(End::Finish));
    script.end_fit_action(EndFitAction::SetContinuity(Continuity::G2));
    script.end_fit_action(EndFitAction::KeepMatched(true));
    script.end_fit_action(EndFitAction::PickFromCurve);
    script.click(seen(&script, id, 0.3));
    let matched = *script
        .editor
        .document()
        .match_of(arc, End::Finish)
        .expect("a match");
    assert_eq!((matched.source, matched.continuity), (id, Continuity::G2));
    let MatchPlace::Parameter(u) = matched.place else {
        panic!("{matched:?}");
    };
    assert!(script.editor.document().meets(&matched));
    script.editor.activate(id);
    let change = ReferenceChange::Translate(DVec3::new(0.4, 0.3, 0.0));
    change.apply(&mut script.editor).expect("a place");
    script.check();
    assert!(script.editor.document().meets(&matched));
    let document = script.editor.document();
    let polygon = &document.curve(arc).expect("a curve").polygon;
    let expected = document.shape(id).expect("a reference").jet(u);
    let end = polygon.end_jet(End::Finish);
    assert!(end.point.distance(expected.point) <= MET * polygon.size());
    // The arc runs against the circle there.
    assert!(matched.reversed);
    assert!((end.signed_curvature() + expected.signed_curvature()).abs() <= 1e-6);
}

#[test]
fn what_is_hovered_on_it_is_told_with_its_own_parameter() {
    let (mut script, id) = with("circle");
    script.move_to(seen(&script, id, 0.25));
    let hover = script.scene().hover.clone();
    let Some(HoverScene::Curve { curve, text, .. }) = hover else {
        panic!("{hover:?}");
    };
    assert_eq!(curve, id);
    assert!(text.starts_with("t 1.5") && text.contains("κ 1"), "{text}");
}

#[test]
fn commands_of_curves_do_nothing_to_a_reference() {
    let (mut script, id) = with("circle");
    let before = script.editor.document().clone();
    for command in Command::all() {
        let own = matches!(
            command,
            Command::AddReference(_)
                | Command::AddFormula
                | Command::Duplicate
                | Command::Delete
                | Command::DeleteCurve
                | Command::ToggleVisible
                | Command::ToggleLocked
                | Command::Group
                | Command::Ungroup
                | Command::Isolate
                | Command::ShowAll
                | Command::SetUnit(_)
                | Command::ConvertUnit(_)
                | Command::Undo
                | Command::Redo
        );
        if own {
            continue;
        }
        script.editor.activate(id);
        script.command(command);
        script.key(Key::Escape);
        script.check();
        assert!(script.editor.document().is_same(&before), "{command:?}");
    }
}

#[test]
fn delete_removes_a_reference_that_is_active_unless_it_is_locked() {
    let (mut script, id) = with("circle");
    let before = script.editor.document().clone();
    script.command(Command::ToggleLocked);
    script.command(Command::Delete);
    assert!(script.editor.document().reference(id).is_some());
    script.command(Command::ToggleLocked);
    script.command(Command::Delete);
    assert!(script.editor.document().reference(id).is_none());
    assert_eq!(script.editor.document().len(), before.len());
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn formulas_are_typed_and_a_mistake_leaves_the_last_good_form() {
    let mut script = Script::example("arc");
    script.command(Command::AddFormula);
    let id = script.curve();
    let before = curve(&script, id);
    let steps = script.steps();
    let formula = |texts: [&str; 3]| ReferenceChange::Formula(texts.map(str::to_owned));
    let preview = |script: &mut Script, texts| {
        let shown = formula(texts).preview(&mut script.editor);
        script.check();
        shown
    };
    preview(&mut script, ["2*cos(t)", "sin(t)", ""]).expect("formulas");
    let good = curve(&script, id);
    let refused = preview(&mut script, ["2*cos(t", "sin(t)", ""]);
    let Err(ReferenceError::InFormula {
        coordinate,
        mistake,
    }) = refused
    else {
        panic!("{refused:?}");
    };
    assert_eq!(coordinate, "x");
    assert!(mistake.column >= 7, "{mistake:?}");
    assert_eq!(curve(&script, id), good);
    assert!(preview(&mut script, ["2*cos(t)", "1/0*t", ""]).is_err());
    assert_eq!(curve(&script, id), good);
    preview(&mut script, ["2*cos(t)", "sin(t)", "t"]).expect("in space");
    script.editor.commit_preview();
    script.check();
    assert_eq!(script.steps(), steps + 1);
    assert!(!curve(&script, id).is_planar());
    script.command(Command::Undo);
    assert_eq!(curve(&script, id), before);
}
