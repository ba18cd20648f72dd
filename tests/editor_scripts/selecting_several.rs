//! Several curves and references, selected together: by clicks, by a box, and what commands make of them.

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, Group, MatchPlace};
use batten::editor::{CombsOf, Command, CopyForm, Editor, Key, Layer, Modifiers};
use batten::geometry::references::KINDS;
use batten::geometry::{Continuity, End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::script::Script;
use super::several::two;

/// The paper's arc, which is active, a longer curve and a short one below it, and a circle.
pub fn four() -> (Script, [CurveId; 4]) {
    let (mut script, [arc, other]) = two();
    let points: Vec<_> = (0..6)
        .map(|i| (3.0 * f64::from(i) - 8.0, -26.0 - f64::from(i % 2)))
        .collect();
    let short = FloatPolygon::planar(3, &points).expect("a polygon");
    let short = Edit::Add(Box::new(Curve::new("short", short)));
    script.editor.apply("add", vec![short]).expect("an edit");
    let circle = KINDS.iter().copied().find(|kind| kind.name == "circle");
    script.command(Command::AddReference(circle.expect("a circle")));
    let ids: Vec<CurveId> = script.editor.document().all_ids().collect();
    script.command(Command::FitAll);
    // A press on the curve is to take the curve, and no vertex of the closed S-polygon.
    if script.editor.sight().layers().shows(Layer::Clamped) {
        script.command(Command::ToggleLayer(Layer::Clamped));
    }
    script.editor.activate(arc);
    (script, [arc, other, ids[2], ids[3]])
}

/// Match the start of one curve to that of another.
pub fn match_starts(script: &mut Script, curve: CurveId, source: CurveId) {
    let matched = EndMatch {
        curve,
        end: End::Start,
        source,
        place: MatchPlace::End(End::Start),
        continuity: Continuity::G1,
        reversed: true,
    };
    let matched = vec![Edit::SetMatch(matched)];
    script.editor.apply("match", matched).expect("a match");
}

fn selected(script: &Script) -> Vec<CurveId> {
    let selection = script.editor.hand().selection();
    let document = script.editor.document();
    document
        .all_ids()
        .filter(|id| selection.has_item(*id))
        .collect()
}

/// Where a point of a curve or a reference is on the canvas.
pub fn on(script: &Script, id: CurveId, share: f64) -> DVec2 {
    let shape = script.editor.document().shape(id).expect("a shape");
    let viewport = script.editor.view().viewport();
    let point = shape.jet(share * shape.pieces() as f64).point;
    viewport.to_screen(viewport.flatten(point))
}

/// Draw a box around points of the canvas.
fn boxed(script: &mut Script, points: &[DVec2]) {
    let margin = DVec2::splat(9.0);
    let low = points.iter().copied().reduce(DVec2::min).expect("points") - margin;
    let high = points.iter().copied().reduce(DVec2::max).expect("points") + margin;
    script.drag(low, high);
}

/// Lock a curve.
pub fn lock(script: &mut Script, curve: CurveId) {
    let edit = Edit::SetLocked {
        curve,
        locked: true,
    };
    script.editor.apply("lock", vec![edit]).expect("an edit");
}

/// Hide a curve or a reference.
pub fn hide(script: &mut Script, curve: CurveId) {
    let edit = Edit::SetVisible {
        curve,
        visible: false,
    };
    script.editor.apply("hide", vec![edit]).expect("an edit");
}

#[test]
fn shift_click_takes_curves_and_references_and_a_click_takes_one_alone() {
    let (mut script, [arc, other, short, circle]) = four();
    assert_eq!(selected(&script), [arc]);
    let steps = script.steps();
    script.modifiers(Modifiers::SHIFT);
    script.click(on(&script, other, 0.52));
    script.click(on(&script, circle, 0.3));
    assert_eq!(selected(&script), [arc, other, circle]);
    assert_eq!(script.curve(), arc);
    script.click(on(&script, other, 0.52));
    assert_eq!(selected(&script), [arc, circle]);
    script.modifiers(Modifiers::NONE);
    script.click(on(&script, short, 0.52));
    assert_eq!((selected(&script), script.curve()), (vec![short], short));
    assert_eq!(script.steps(), steps, "selecting is no step");
}

#[test]
fn a_box_takes_vertices_of_selected_curves_and_curves_where_none_is_selected() {
    let (mut script, [arc, other, short, circle]) = four();
    let everywhere = [DVec2::splat(27.0), DVec2::new(990.0, 690.0)];
    boxed(&mut script, &everywhere);
    assert_eq!(script.selected_of(arc).len(), 10);
    assert!(script.selected_of(other).is_empty());
    // Beside everything: first no vertex is selected any more, then no curve.
    script.key(Key::Escape);
    assert_eq!(
        (selected(&script), script.selected_of(arc).len()),
        (vec![arc], 0)
    );
    script.key(Key::Escape);
    assert!(selected(&script).is_empty());
    assert_eq!(script.curve(), arc);
    let hint = {
        script.press(everywhere[0]);
        script.move_to(everywhere[1]);
        script.editor.hint()
    };
    assert!(hint.contains("curves in the box"), "{hint}");
    script.release(everywhere[1]);
    assert_eq!(selected(&script), [arc, other, short, circle]);
    boxed(&mut script, &everywhere);
    assert_eq!(
        script.editor.hand().selection().vertices().len(),
        10 + 9 + 6
    );
    // A box that meets a curve of none that are selected takes the curve.
    script.editor.activate(arc);
    let across = [on(&script, short, 0.5), on(&script, short, 0.52)];
    boxed(&mut script, &across);
    assert_eq!(selected(&script), [short]);
    // Shift adds curves, and vertices of those that are selected.
    script.modifiers(Modifiers::SHIFT);
    let at = script.at_vertex_of(short, 0);
    boxed(&mut script, &[at]);
    assert_eq!(script.selected_of(short), [0]);
    script.modifiers(Modifiers::NONE);
}

#[test]
fn a_box_leaves_out_what_is_locked_or_hidden() {
    let (mut script, [arc, other, short, circle]) = four();
    lock(&mut script, other);
    hide(&mut script, short);
    script.command(Command::SelectNone);
    boxed(&mut script, &[DVec2::splat(27.0), DVec2::new(990.0, 690.0)]);
    assert_eq!(selected(&script), [arc, circle]);
}

#[test]
fn a_curve_alone_needs_no_selection_for_a_box() {
    let mut script = Script::example("arc");
    script.command(Command::SelectNone);
    boxed(&mut script, &[DVec2::splat(27.0), DVec2::new(990.0, 690.0)]);
    assert_eq!(script.selected().len(), 10);
}

#[test]
fn a_command_on_several_is_one_step() {
    let (mut script, ids) = four();
    let [arc, other, short, circle] = ids;
    script.editor.hand_mut().select_items([arc, other, circle]);
    let (before, steps) = (script.editor.document().clone(), script.steps());
    let visible = |script: &Script| ids.map(|id| script.editor.document().is_visible(id));
    script.command(Command::ToggleVisible);
    assert_eq!(visible(&script), [false, false, true, false]);
    assert_eq!(script.steps(), steps + 1);
    assert_eq!(selected(&script), [arc, other, circle]);
    script.command(Command::ToggleVisible);
    assert_eq!(visible(&script), [true; 4]);
    // Mixed is brought to one.
    hide(&mut script, other);
    script.command(Command::ToggleVisible);
    assert_eq!(visible(&script), [true; 4]);
    script.command(Command::ToggleLocked);
    assert_eq!(Command::ToggleLocked.is_checked(&script.editor), Some(true));
    assert!(
        script
            .editor
            .document()
            .curve(short)
            .is_some_and(|it| !it.locked)
    );
    script.command(Command::ToggleLocked);
    script.command(Command::TogglePeriodic);
    let periodic = |script: &Script, id| {
        let curve = script.editor.document().curve(id).cloned();
        curve.expect("a curve").polygon.is_periodic()
    };
    assert!(periodic(&script, arc) && periodic(&script, other) && !periodic(&script, short));
    script.command(Command::TogglePeriodic);
    while script.steps() > steps {
        script.command(Command::Undo);
    }
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn what_a_command_leaves_out_is_told() {
    let (mut script, [arc, other, short, _]) = four();
    lock(&mut script, other);
    script.editor.hand_mut().select_items([arc, other, short]);
    script.command(Command::TogglePeriodic);
    assert!(
        script.message().contains("“other” is locked"),
        "{}",
        script.message()
    );
    script.command(Command::Undo);
    script.command(Command::DeleteCurve);
    assert!(
        script.message().contains("“other” is locked"),
        "{}",
        script.message()
    );
    assert!(
        script.message().contains("“short” deleted"),
        "{}",
        script.message()
    );
    assert_eq!(script.editor.document().curves().len(), 1);
    script.command(Command::Undo);
    assert_eq!(
        selected(&script),
        [arc, short],
        "what comes back is selected"
    );
}

#[test]
fn del_names_the_curves_and_deletes_them_when_it_is_pressed_again() {
    let (mut script, [arc, other, short, circle]) = four();
    script.editor.hand_mut().select_items([arc, other]);
    let steps = script.steps();
    script.command(Command::Delete);
    assert_eq!(script.steps(), steps);
    for name in ["Press Del again", "“other”"] {
        assert!(script.message().contains(name), "{}", script.message());
    }
    // What is named is what is deleted: with another selection it is named anew.
    script
        .editor
        .hand_mut()
        .select_items([other, short, circle]);
    script.command(Command::Delete);
    assert_eq!(script.steps(), steps);
    assert!(script.message().contains("“short”"), "{}", script.message());
    script.command(Command::Delete);
    assert_eq!(script.steps(), steps + 1);
    let left: Vec<CurveId> = script.editor.document().all_ids().collect();
    assert_eq!(left, [arc]);
    assert!(script.message().contains("deleted"), "{}", script.message());
    // Where vertices are selected it deletes these.
    script.command(Command::Undo);
    script.editor.activate(other);
    script.click(script.at_vertex_of(other, 3));
    script.command(Command::Delete);
    assert!(
        script.message().starts_with("1 vertex deleted"),
        "{}",
        script.message()
    );
    // Nothing is deleted that is not seen selected.
    script.command(Command::SelectNone);
    let before = script.editor.document().clone();
    script.command(Command::Delete);
    script.command(Command::Delete);
    assert!(script.editor.document().is_same(&before));
    assert!(
        script.message().contains("Nothing is selected"),
        "{}",
        script.message()
    );
}

#[test]
fn copies_hold_all_that_is_selected() {
    let (mut script, [arc, other, _, circle]) = four();
    script.editor.hand_mut().select_items([arc, other, circle]);
    let text = script.editor.copy(CopyForm::Own).expect("a text");
    assert!(script.message().contains("“other”"), "{}", script.message());
    script.editor.paste(&text).expect("copies");
    let document = script.editor.document();
    assert_eq!(
        (document.curves().len(), document.references().len()),
        (5, 2)
    );
    assert_eq!(selected(&script).len(), 3, "the copies are selected");
    script.command(Command::Undo);
    script.editor.hand_mut().select_items([arc, other]);
    let path = script.editor.copy(CopyForm::SvgPath).expect("a path");
    assert_eq!(path.matches('M').count(), 2, "{path}");
    let table = script.editor.copy(CopyForm::Table).expect("a table");
    assert!(table.lines().count() > 19, "{table}");
    let steps = script.steps();
    script.command(Command::Duplicate);
    assert_eq!(script.steps(), steps + 1);
    assert_eq!(script.editor.document().curves().len(), 5);
    assert_eq!(selected(&script).len(), 2);
    assert!(!selected(&script).contains(&arc));
}

#[test]
fn the_matches_that_a_deletion_of_several_dissolves_are_told() {
    let (mut script, [arc, other, short, _]) = four();
    match_starts(&mut script, short, other);
    script.editor.hand_mut().select_items([arc, other]);
    script.command(Command::DeleteCurve);
    assert!(
        script.message().contains("“short” is no longer matched"),
        "{}",
        script.message()
    );
    script.command(Command::Undo);
    assert_eq!(script.editor.document().matches().len(), 1);
}

#[test]
fn all_that_is_hidden_is_shown_in_one_step() {
    let (mut script, ids) = four();
    assert!(!Command::ShowAll.is_enabled(&script.editor), "nothing is");
    for id in [ids[1], ids[3]] {
        hide(&mut script, id);
    }
    let steps = script.steps();
    script.command(Command::ShowAll);
    let document = script.editor.document();
    assert!(ids.iter().all(|id| document.is_visible(*id)));
    assert_eq!(script.steps(), steps + 1);
    script.command(Command::Undo);
    assert!(!script.editor.document().is_visible(ids[3]));
}

#[test]
fn a_group_of_the_selection_lies_within_the_group_that_holds_it() {
    let (mut script, [arc, other, short, circle]) = four();
    let groups = |script: &Script| {
        let group = |id| script.editor.document().group(id).map(Group::to_string);
        [arc, other, short, circle].map(|id| group(id).unwrap_or_default())
    };
    script.editor.hand_mut().select_items([arc, other, circle]);
    script.command(Command::Group);
    assert_eq!(groups(&script), ["group 1", "group 1", "", "group 1"]);
    script.editor.hand_mut().select_items([arc, other]);
    script.command(Command::Group);
    let inner = "group 1/group 1";
    assert_eq!(groups(&script), [inner, inner, "", "group 1"]);
    script.editor.hand_mut().select_items([arc, short]);
    script.command(Command::Group);
    assert_eq!(groups(&script), ["group 2", inner, "group 2", "group 1"]);
    script
        .editor
        .hand_mut()
        .select_items([other, short, circle]);
    let steps = script.steps();
    script.command(Command::Ungroup);
    assert_eq!(groups(&script), ["group 2", "group 1", "", ""]);
    assert_eq!(script.steps(), steps + 1);
    script.editor.activate(short);
    assert!(!Command::Ungroup.is_enabled(&script.editor));
}

#[test]
fn isolating_hides_the_others_and_brings_back_what_it_has_hidden() {
    let (mut script, ids) = four();
    let [arc, other, short, circle] = ids;
    hide(&mut script, short);
    script.editor.hand_mut().select_items([arc, other]);
    let (before, steps) = (script.editor.document().clone(), script.steps());
    let visible = |script: &Script| ids.map(|id| script.editor.document().is_visible(id));
    script.command(Command::Isolate);
    assert_eq!(visible(&script), [true, true, false, false]);
    assert_eq!(Command::Isolate.is_checked(&script.editor), Some(true));
    assert_eq!(script.steps(), steps + 1);
    // What was hidden before stays hidden.
    script.command(Command::Isolate);
    assert_eq!(visible(&script), [true, true, false, true]);
    assert!(script.editor.document().is_same(&before));
    script.command(Command::Isolate);
    script.command(Command::Undo);
    assert_eq!(Command::Isolate.is_checked(&script.editor), Some(false));
    // What was shown meanwhile is no more hidden by it.
    script.editor.hand_mut().select_items([arc]);
    script.command(Command::Isolate);
    for curve in [other, circle] {
        let edit = Edit::SetVisible {
            curve,
            visible: true,
        };
        script.editor.apply("show", vec![edit]).expect("an edit");
    }
    script.command(Command::Isolate);
    assert_eq!(
        visible(&script),
        [true, false, false, false],
        "it isolates anew"
    );
}

#[test]
fn combs_stand_on_the_active_curve_the_selection_or_all_that_is_visible() {
    let (mut script, ids) = four();
    let [arc, other, short, _] = ids;
    if !script.editor.sight().layers().shows(Layer::Comb) {
        script.command(Command::ToggleLayer(Layer::Comb));
    }
    let with_comb = |script: &mut Script| -> Vec<CurveId> {
        let scene = script.scene();
        let combed = scene.curves.iter().filter(|curve| !curve.comb.is_empty());
        let combed: Vec<CurveId> = combed.filter_map(|curve| curve.id).collect();
        ids.into_iter().filter(|id| combed.contains(id)).collect()
    };
    assert_eq!(with_comb(&mut script), [arc]);
    script.editor.hand_mut().select_items([arc, other]);
    script.command(Command::ShowCombs(CombsOf::Selected));
    assert_eq!(with_comb(&mut script), [arc, other]);
    script.command(Command::ShowCombs(CombsOf::Visible));
    assert_eq!(with_comb(&mut script), ids);
    hide(&mut script, short);
    assert!(!with_comb(&mut script).contains(&short));
    // One scale suits all: the longest tooth of all is a part of the largest curve.
    script.command(Command::ResetComb);
    let scale = script.editor.view().comb().scale;
    script.editor.activate(other);
    script.command(Command::ResetComb);
    assert_eq!(script.editor.view().comb().scale, scale);
    script.command(Command::ShowCombs(CombsOf::Active));
    assert_eq!(with_comb(&mut script), [other]);
}

#[test]
fn combs_are_scaled_anew_when_a_sharper_curve_has_one_too() {
    let (mut script, [arc, ..]) = four();
    if !script.editor.sight().layers().shows(Layer::Comb) {
        script.command(Command::ToggleLayer(Layer::Comb));
    }
    let corners = [
        (0.0, 0.0),
        (1.0, 0.0),
        (1.002, 0.001),
        (1.0, 0.002),
        (0.0, 0.002),
    ];
    let needle = FloatPolygon::planar(3, &corners).expect("a polygon");
    let edit = Edit::Add(Box::new(Curve::new("needle", needle)));
    script.editor.apply("Add", vec![edit]).expect("an edit");
    script.editor.activate(arc);
    let scale = |script: &mut Script| {
        script.check();
        script.editor.view().comb().scale
    };
    let alone = scale(&mut script);
    script.command(Command::ShowCombs(CombsOf::Visible));
    let with_needle = scale(&mut script);
    assert!(with_needle < 0.1 * alone, "{with_needle} {alone}");
    // The scale stays while another curve becomes active.
    let last = script.editor.document().ids().last().expect("a curve");
    script.editor.activate(last);
    assert_eq!(scale(&mut script), with_needle);
}

#[test]
fn fitting_the_selection_fits_the_curves() {
    let (mut script, [arc, other, short, _]) = four();
    script.editor.hand_mut().select_items([other, short]);
    script.command(Command::Fit);
    let view = script.editor.view().viewport().view_box();
    let holds = |script: &Script, id: CurveId, share: f64| {
        let at = on(script, id, share);
        view.holds(script.editor.view().viewport().to_model(at))
    };
    assert!(holds(&script, other, 0.0) && holds(&script, short, 1.0));
    assert!(
        !holds(&script, arc, 0.5),
        "what is not selected is out of sight"
    );
}

#[test]
fn a_curve_that_crosses_itself_or_bends_sharply_when_it_closes_says_so() {
    // The tails of an arc's polygon cross; a ring's do not.
    let arc: Vec<(f64, f64)> = (0..9)
        .map(|index| {
            let angle = 0.55 * f64::from(index);
            (10.0 * angle.cos(), 10.0 * angle.sin() - 2.0 * angle)
        })
        .collect();
    let crossed = [
        (0.0, 0.0),
        (4.0, 0.0),
        (8.0, 2.0),
        (8.0, 8.0),
        (2.0, 8.0),
        (4.0, -6.0),
        (9.0, -6.0),
    ];
    // Of an arch's polygon the tails lie far outside.
    let arch = [(-40.0, -80.0), (20.0, 40.0), (80.0, 40.0), (140.0, -80.0)];
    // The closing leg of a flat arc makes two corners.
    let flat = (0..9).map(|index| {
        let angle = 0.1 * f64::from(index);
        (100.0 * angle.cos(), 100.0 * angle.sin())
    });
    for (vertices, warning) in [
        (arc, None),
        (crossed.to_vec(), Some("crosses itself")),
        (flat.collect(), Some("A bend has the radius")),
        (arch.to_vec(), Some("long, ")),
    ] {
        let curve = Curve::new(
            "curve",
            FloatPolygon::planar(3, &vertices).expect("a polygon"),
        );
        let mut script = Script {
            editor: Editor::with_document(Document::from_curves([curve])),
        };
        script.command(Command::TogglePeriodic);
        let message = script.editor.message();
        let told = message.filter(|it| it.warns).map(|it| it.text.as_str());
        let is_told = warning.is_some_and(|it| told.is_some_and(|text| text.contains(it)));
        assert_eq!(is_told, warning.is_some(), "{message:?}");
        assert_eq!(told.is_some(), warning.is_some(), "{message:?}");
    }
}

#[test]
fn a_closed_curve_opens_at_its_joint_and_keeps_its_shape() {
    let ring = |weights: Option<Vec<f64>>, height: f64| {
        let vertices = (0..9).map(|index| {
            let angle = f64::from(index) * std::f64::consts::TAU / 9.0;
            let (x, y) = (20.0 * angle.cos(), 12.0 * angle.sin() - 3.0 * angle);
            DVec3::new(x, y, height * f64::from(index))
        });
        FloatPolygon::new(4, vertices.collect(), weights, true).expect("a polygon")
    };
    let weights = (0..9).map(|index| 1.0 + 0.1 * f64::from(index)).collect();
    for polygon in [ring(None, 0.0), ring(None, 1.0), ring(Some(weights), 0.0)] {
        let mut curve = Curve::new("ring", polygon.clone());
        curve.locked_vertices = [1, 7].into_iter().collect();
        let mut script = Script {
            editor: Editor::with_document(Document::from_curves([curve])),
        };
        let before = script.editor.document().clone();
        script.command(Command::TogglePeriodic);
        let open = script.editor.document().curve(script.curve());
        let open = Curve::clone(open.expect("a curve"));
        assert!(!open.polygon.is_periodic());
        for step in 0..72 {
            let u = f64::from(step) / 8.0;
            assert_eq!(open.polygon.point(u), polygon.point(u), "u {u}");
        }
        // A locked vertex is there twice, and so is its lock.
        assert_eq!(open.locked_vertices, [1, 7, 10].into_iter().collect());
        script.command(Command::TogglePeriodic);
        assert!(script.editor.document().is_same(&before));
    }
}
