//! Ends that are matched to other curves, and follow them.

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, MatchPlace, Reference};
use batten::editor::{Command, Editor, EndFitAction, Key, Look, Mark, ToolKind, told};
use batten::geometry::end_correction::{EndDifference, EndTarget};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{Continuity, End, FloatPolygon, PolygonKind};
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::Script;
use super::window::exporter;

/// What is left of a match that is met, in units of the curve's size.
const MET: f64 = 1e-10;

fn polygon(degree: usize, points: &[(f64, f64)]) -> FloatPolygon {
    FloatPolygon::planar(degree, points).expect("a polygon")
}

/// Two curves apart from each other: "first" runs up to "second".
fn script() -> (Script, [CurveId; 2]) {
    let first = [
        (0.0, 0.0),
        (1.0, 0.3),
        (2.1, 0.9),
        (3.0, 1.0),
        (4.2, 0.8),
        (5.0, 0.2),
        (6.0, -0.5),
    ];
    let second = [
        (8.0, 0.0),
        (9.1, 1.0),
        (10.0, 1.4),
        (11.2, 1.3),
        (12.0, 0.7),
        (13.1, -0.4),
        (14.0, -1.6),
        (14.6, -3.0),
    ];
    let curves = [
        Curve::new("first", polygon(4, &first)),
        Curve::new("second", polygon(5, &second)),
    ];
    let document = Document::from_curves(curves);
    let ids: Vec<CurveId> = document.ids().collect();
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    script.check();
    script.editor.activate(ids[1]);
    script.tool(ToolKind::EndFit);
    (script, [ids[0], ids[1]])
}

fn curve(script: &Script, id: CurveId) -> Curve {
    Curve::clone(script.editor.document().curve(id).expect("a curve"))
}

fn at(script: &Script, point: DVec3) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(point))
}

/// Pick the end of the first curve for the start of the second.
fn pick_end(script: &mut Script, ids: [CurveId; 2], level: Continuity, live: bool) {
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::SetContinuity(level));
    script.end_fit_action(EndFitAction::KeepMatched(live));
    script.end_fit_action(EndFitAction::PickFromCurve);
    let end = curve(script, ids[0]).polygon.end_jet(End::Finish).point;
    script.click(at(script, end));
}

/// What is missing at an end of the second curve for it to go on from a place of the first.
fn missing(script: &Script, matched: &EndMatch) -> f64 {
    let document = script.editor.document();
    let target = matched.target(document).expect("a target");
    let polygon = &document.curve(matched.curve).expect("a curve").polygon;
    EndDifference::between(polygon, matched.end, &target).residual(polygon.size()) / polygon.size()
}

fn first_match(script: &Script) -> EndMatch {
    let mut matches = script.editor.document().matches();
    *matches.next().expect("a match")
}

#[test]
fn a_target_is_picked_at_each_level_from_an_end_or_a_point() {
    for level in Continuity::ALL {
        let (mut script, ids) = script();
        pick_end(&mut script, ids, level, false);
        let jet = curve(&script, ids[0]).polygon.end_jet(End::Finish);
        let found = curve(&script, ids[1]).targets.start;
        assert_eq!(found, Some(level.target(&jet, true)), "{level:?}");
        assert_eq!(script.editor.document().matches().len(), 0);

        // At the other end the curve runs towards it: everything is turned round.
        script.end_fit_action(EndFitAction::Choose(End::Finish));
        script.end_fit_action(EndFitAction::PickFromCurve);
        script.click(at(&script, jet.point));
        let turned = level.target(&jet, true).turned(true);
        assert_eq!(
            curve(&script, ids[1]).targets.finish,
            Some(turned),
            "{level:?}"
        );

        // Any point of the other curve.
        let source = curve(&script, ids[0]).polygon;
        script.end_fit_action(EndFitAction::PickFromCurve);
        script.click(at(&script, source.point(1.25)));
        let target = curve(&script, ids[1]).targets.finish.expect("a target");
        let u = (12_000..=13_000).map(|step| f64::from(step) * 1e-4);
        let off = |u: f64| source.point(u).distance(target.point);
        let nearest = u.min_by(|a, b| off(*a).total_cmp(&off(*b)));
        let nearest = nearest.expect("a parameter");
        assert!(off(nearest) < 1e-4 * source.size());
        assert!((nearest - 1.25).abs() < 0.05, "{nearest}");
        script.undo_all();
        assert_eq!(curve(&script, ids[1]).targets.list(), []);
    }
}

#[test]
fn a_match_raised_level_by_level_warns_where_it_bends() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G1, true);
    let mut warned = 0;
    for level in [Continuity::G2, Continuity::G3] {
        let before = script.editor.document().clone();
        script.end_fit_action(EndFitAction::SetContinuity(level));
        let documents = [&before, script.editor.document()];
        let (text, bends) = batten::operations::matched(&ids, documents);
        let message = script.editor.message();
        assert_eq!(
            message.is_some_and(|it| it.warns),
            bends,
            "{level:?}: {text}"
        );
        if bends {
            let message = message.expect("a message");
            assert!(message.text.contains(&text), "{}", message.text);
            assert!(message.offers_undo);
            warned += 1;
        }
    }
    assert!(warned > 0);
}

#[test]
fn a_point_is_passed_in_the_sense_that_turns_the_end_less() {
    for runs_back in [false, true] {
        let (mut script, ids) = script();
        if runs_back {
            let turned = curve(&script, ids[0]).polygon.reversed();
            let edit = Edit::SetPolygon {
                curve: ids[0],
                polygon: turned,
            };
            let reply = script.editor.apply("Reverse", vec![edit]);
            reply.expect("it can be reversed");
        }
        for end in End::BOTH {
            let own = curve(&script, ids[1]).polygon.end_jet(end).first;
            script.end_fit_action(EndFitAction::Choose(end));
            script.end_fit_action(EndFitAction::SetContinuity(Continuity::G2));
            script.end_fit_action(EndFitAction::KeepMatched(true));
            script.end_fit_action(EndFitAction::PickFromCurve);
            let point = curve(&script, ids[0]).polygon.point(1.5);
            script.click(at(&script, point));
            let target = curve(&script, ids[1]).targets.get(end);
            let along = target.and_then(|it| it.direction).expect("a direction");
            assert!(along.dot(own) > 0.0, "{end:?} {runs_back}: {along}");
            assert_eq!(first_match(&script).reversed, runs_back, "{end:?}");
            script.command(Command::Undo);
        }
    }
}

#[test]
fn a_match_is_flipped_from_the_curve_before_it() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G2, true);
    let matched = curve(&script, ids[1]).polygon;
    let flip = |script: &mut Script| script.end_fit_action(EndFitAction::TurnRound);
    flip(&mut script);
    assert!(missing(&script, &first_match(&script)) <= MET);
    flip(&mut script);
    assert_eq!(curve(&script, ids[1]).polygon, matched);
    // Another level begins there too.
    for level in [Continuity::G0, Continuity::G2] {
        script.end_fit_action(EndFitAction::SetContinuity(level));
    }
    assert_eq!(curve(&script, ids[1]).polygon, matched);
    // What is changed since is kept.
    flip(&mut script);
    let flipped = curve(&script, ids[1]).polygon;
    flip(&mut script);
    let moved = Edit::MoveVertices {
        curve: ids[1],
        moves: vec![(5, DVec3::new(13.2, 0.4, 0.0))],
    };
    let reply = script.editor.apply("Move", vec![moved]);
    reply.expect("it can be moved");
    let moved = curve(&script, ids[1]).polygon;
    flip(&mut script);
    let by = curve(&script, ids[1]).polygon.vertex(5) - flipped.vertex(5);
    assert!(by.length() > 0.3, "{by}");
    flip(&mut script);
    assert_eq!(curve(&script, ids[1]).polygon, moved);
    script.undo_all();
}

/// Let both ends of the second curve follow points of the first.
fn match_both(script: &mut Script, ids: [CurveId; 2], level: Continuity) {
    let places = [(End::Start, 1.0), (End::Finish, 2.0)];
    let matches = places.map(|(end, u)| {
        Edit::SetMatch(EndMatch {
            curve: ids[1],
            end,
            source: ids[0],
            place: MatchPlace::Parameter(u),
            continuity: level,
            reversed: false,
        })
    });
    let reply = script.editor.apply("Match", matches.to_vec());
    reply.expect("a match");
}

/// Move all vertices of a curve.
fn move_all(script: &mut Script, id: CurveId, to: impl Fn(DVec3) -> DVec3) {
    let vertices = curve(script, id).polygon;
    let moves = vertices.vertices().iter().map(|it| to(*it)).enumerate();
    let edit = Edit::MoveVertices {
        curve: id,
        moves: moves.collect(),
    };
    script.editor.apply("Move", vec![edit]).expect("a move");
}

#[test]
fn a_curve_that_follows_with_both_ends_moves_along_as_a_whole() {
    for level in Continuity::ALL {
        let (mut script, ids) = script();
        match_both(&mut script, ids, level);
        let matched = curve(&script, ids[1]).polygon;
        let turn = DVec2::from_angle(0.6);
        let moved = |it: DVec3| (1.5 * turn.rotate(it.truncate())).extend(0.0) + 90.0 * DVec3::Y;
        move_all(&mut script, ids[0], moved);
        let along = curve(&script, ids[1]).polygon;
        for (before, now) in matched.vertices().iter().zip(along.vertices()) {
            let off = now.distance(moved(*before));
            assert!(off <= MET * 90.0, "{level:?}: {off:e}");
        }
        assert!(missing(&script, &first_match(&script)) <= MET);
        script.command(Command::Undo);
        assert_eq!(curve(&script, ids[1]).polygon, matched);
        // A change of a part of the source takes the ends alone along.
        move_all(&mut script, ids[0], |it| {
            it + DVec3::new(0.0, 0.01 * it.x * it.x, 0.0)
        });
        let followed = curve(&script, ids[1]).polygon;
        assert!(followed != matched && missing(&script, &first_match(&script)) <= MET);
        script.undo_all();
    }
}

#[test]
fn a_vertex_that_cannot_follow_the_pointer_does_not_push_the_others_away() {
    // Ends of a long curve are corrected apart from each other.
    for count in [8, 140] {
        check_drags_beside_matched_ends(count);
    }
}

fn check_drags_beside_matched_ends(count: usize) {
    let (mut script, ids) = script();
    let wave = |index: usize| {
        let x = 8.0 + 7.0 * index as f64 / (count - 1) as f64;
        (x, x.sin())
    };
    let wave: Vec<(f64, f64)> = (0..count).map(wave).collect();
    let edit = Edit::Add(Box::new(Curve::new("wave", polygon(5, &wave))));
    script.editor.apply("Add", vec![edit]).expect("an edit");
    let follower = script.editor.document().ids().last().expect("a curve");
    let ids = [ids[0], follower];
    match_both(&mut script, ids, Continuity::G2);
    let before = curve(&script, ids[1]).polygon;
    let by = 0.4;
    let beside = (1..7)
        .chain(count - 7..count - 1)
        .filter(|it| *it < count - 1);
    for vertex in beside {
        let moved = Edit::MoveVertices {
            curve: ids[1],
            moves: vec![(vertex, before.vertex(vertex) + by * DVec3::Y)],
        };
        script.editor.apply("Move", vec![moved]).expect("a move");
        let now = curve(&script, ids[1]).polygon;
        let moves = before.vertices().iter().zip(now.vertices());
        let farthest = moves
            .map(|(from, to)| from.distance(*to))
            .fold(0.0, f64::max);
        assert!(farthest <= 2.6 * by * (1.0 + MET), "{vertex}: {farthest}");
        assert!(now.vertex(vertex).y >= before.vertex(vertex).y, "{vertex}");
        script.command(Command::Undo);
    }
}

#[test]
fn a_live_match_follows_a_drag_of_the_other_curve_within_its_step() {
    for level in Continuity::ALL {
        let (mut script, ids) = script();
        let before = script.editor.document().clone();
        pick_end(&mut script, ids, level, true);
        let matched = first_match(&script);
        assert_eq!(matched.continuity, level);
        assert_eq!((matched.curve, matched.source), (ids[1], ids[0]));
        assert!(
            missing(&script, &matched) <= MET,
            "{level:?}: {:e}",
            missing(&script, &matched)
        );
        let report = script.end_fit().expect("figures");
        let shown = report.matched.expect("a match");
        assert_eq!(shown.source, "first");
        assert!(shown.missing.vector.length() <= MET * 20.0);
        assert_eq!(script.steps(), 1);
        let settled = script.editor.document().clone();

        // The far end keeps its point and direction.
        let far = curve(&script, ids[1]).polygon.end_jet(End::Finish);
        script.tool(ToolKind::Select);
        script.editor.activate(ids[0]);
        let from = script.at_vertex_of(ids[0], 6);
        script.press(from);
        for step in 1..=4 {
            script.move_to(from + f64::from(step) * DVec2::new(-6.0, 9.0));
            assert!(missing(&script, &matched) <= MET, "{level:?}");
        }
        let now = curve(&script, ids[1]).polygon.end_jet(End::Finish);
        assert!(now.point.distance(far.point) < 1e-10);
        let [now, far] = [now, far].map(|jet| jet.tangent().expect("a tangent"));
        assert!(now.distance(far) < 1e-10);
        // Escape restores both to the bit.
        script.key(Key::Escape);
        assert!(script.editor.document().is_same(&settled));
        script.release(from);

        script.drag(from, from + DVec2::new(-30.0, 40.0));
        assert_eq!(script.steps(), 2);
        assert!(missing(&script, &matched) <= MET, "{level:?}");
        let dragged = script.editor.document().clone();
        script.command(Command::Undo);
        assert!(script.editor.document().is_same(&settled));
        script.command(Command::Redo);
        assert!(script.editor.document().is_same(&dragged));
        script.undo_all();
        assert!(script.editor.document().is_same(&before));
    }
}

#[test]
fn a_match_at_a_point_is_kept_and_turned_round() {
    let (mut script, ids) = script();
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::SetContinuity(Continuity::G2));
    script.end_fit_action(EndFitAction::KeepMatched(true));
    script.end_fit_action(EndFitAction::PickFromCurve);
    let source = curve(&script, ids[0]).polygon;
    script.click(at(&script, source.point(1.5)));
    let matched = first_match(&script);
    let MatchPlace::Parameter(u) = matched.place else {
        panic!("{matched:?}");
    };
    assert!((u - 1.5).abs() < 0.05, "{u}");
    assert!(missing(&script, &matched) <= MET);
    let along = |script: &Script| {
        let jet = curve(script, ids[1]).polygon.end_jet(End::Start);
        (jet.tangent().expect("a tangent"), jet.signed_curvature())
    };
    let before = along(&script);
    script.end_fit_action(EndFitAction::TurnRound);
    let after = along(&script);
    assert!(before.0.distance(-after.0) < 1e-9);
    assert!((before.1 + after.1).abs() < 1e-8);
    assert!(first_match(&script).reversed);

    // Another level is one step, and the match can be removed with the target kept.
    script.end_fit_action(EndFitAction::SetContinuity(Continuity::G3));
    assert!(missing(&script, &first_match(&script)) <= 1e-9);
    let target = curve(&script, ids[1]).targets.start;
    script.end_fit_action(EndFitAction::KeepMatched(false));
    assert_eq!(script.editor.document().matches().len(), 0);
    assert_eq!(curve(&script, ids[1]).targets.start, target);
    assert_eq!(script.steps(), 4);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().matches().len(), 1);
}

#[test]
fn the_target_of_a_matched_end_is_not_set_by_hand() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G1, true);
    let before = script.editor.document().clone();
    let refusal = "the start of “second” is matched to “first”: remove the match to set its target";
    let refused = script
        .editor
        .end_fit_action(EndFitAction::SetPoint(DVec3::ONE));
    assert_eq!(refused.unwrap_err().0, refusal);
    // The end lies on its target: Alt takes the target.
    script.modifiers(batten::editor::Modifiers {
        alt: true,
        ..batten::editor::Modifiers::NONE
    });
    let target = before
        .curve(ids[1])
        .and_then(|it| it.targets.start)
        .expect("a target");
    let place = at(&script, target.point);
    script.drag(place, place + 40.0);
    script.modifiers(batten::editor::Modifiers::NONE);
    assert_eq!(script.message(), refusal);
    assert!(script.editor.document().is_same(&before));
    // Clearing it takes the match away too.
    script.end_fit_action(EndFitAction::ClearTarget);
    assert_eq!(script.editor.document().matches().len(), 0);
    assert_eq!(curve(&script, ids[1]).targets.start, None);
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn a_match_that_makes_a_bend_much_sharper_says_so() {
    // A fair curve whose end lies 2.3 from the other one: pulled there up to G2 by few vertices it gets a kink.
    let first = [
        (-22.218, -9.573),
        (-22.998, -5.013),
        (-20.750, -0.0795),
        (-15.488, 5.199),
        (-7.665, 9.989),
        (0.6314, 10.585),
        (6.9076, 4.139),
        (11.990, -2.485),
        (18.396, 0.778),
        (26.958, 17.027),
        (37.707, 46.377),
    ];
    let second = [
        (13.584, -14.117),
        (16.322, -1.861),
        (20.617, 6.074),
        (26.457, 9.701),
        (33.439, 9.408),
        (40.155, 6.559),
        (45.425, 2.293),
        (48.987, -3.135),
        (50.831, -9.716),
    ];
    for (continuity, warns) in [(Continuity::G0, false), (Continuity::G2, true)] {
        let curves = [
            Curve::new("first", polygon(5, &first)),
            Curve::new("second", polygon(5, &second)),
        ];
        let document = Document::from_curves(curves);
        let ids: Vec<CurveId> = document.ids().collect();
        let mut editor = Editor::with_document(document);
        let matched = EndMatch {
            curve: ids[0],
            end: End::Finish,
            source: ids[1],
            place: MatchPlace::End(End::Start),
            continuity,
            reversed: false,
        };
        let note = editor.apply("Match end", vec![Edit::SetMatch(matched)]);
        let note = note.expect("a match");
        assert_eq!(note.warns, warns, "{}", note.text);
        let begins = "The match moves “first” by up to ";
        assert!(note.text.starts_with(begins), "{}", note.text);
        let bends = note.text.contains("smallest radius") && note.text.contains(" now");
        assert_eq!(bends, warns, "{}", note.text);
    }
}

#[test]
fn a_follower_that_changes_its_character_is_named() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G2, true);
    let polygon = curve(&script, ids[0]).polygon;
    let last = polygon.vertices().len() - 1;
    // By hardly anything, then out of the plane.
    for (by, told) in [(1e-6 * DVec3::X, false), (2.0 * DVec3::Z, true)] {
        let mut vertices = polygon.vertices().to_vec();
        vertices[last] += by;
        let moved = FloatPolygon::new(polygon.degree(), vertices, None, false);
        let edit = Edit::SetPolygon {
            curve: ids[0],
            polygon: moved.expect("a polygon"),
        };
        let note = script.editor.apply("Move", vec![edit]).expect("a step");
        let names = note.text.contains("“second” follows, by up to ");
        assert_eq!(names, told, "{}", note.text);
        assert_eq!(
            note.text.contains("it leaves its plane"),
            told,
            "{}",
            note.text
        );
        assert_eq!((note.warns, note.offers_undo), (told, told));
    }
}

#[test]
fn curves_do_not_follow_each_other_in_a_circle() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G1, true);
    let before = script.editor.document().clone();
    script.editor.activate(ids[0]);
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::KeepMatched(true));
    script.end_fit_action(EndFitAction::PickFromCurve);
    let end = curve(&script, ids[1]).polygon.end_jet(End::Finish).point;
    script.click(at(&script, end));
    assert_eq!(
        script.message(),
        "“second” follows “first” already: remove that match first"
    );
    assert!(script.editor.document().is_same(&before));
    let own = EndMatch {
        curve: ids[0],
        end: End::Start,
        source: ids[0],
        place: MatchPlace::End(End::Finish),
        continuity: Continuity::G0,
        reversed: false,
    };
    let refused = script.editor.apply("Match", vec![Edit::SetMatch(own)]);
    assert_eq!(
        refused.unwrap_err().0,
        "“first” cannot be matched to itself: choose another curve"
    );
}

#[test]
fn deleting_the_other_curve_dissolves_the_match_and_undo_brings_both_back() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G2, true);
    let before = script.editor.document().clone();
    script.editor.activate(ids[0]);
    script.command(Command::DeleteCurve);
    assert_eq!(
        script.message(),
        "“first” deleted\nThe start of “second” is no longer matched: what it followed is gone"
    );
    assert_eq!(script.editor.document().matches().len(), 0);
    assert_eq!(
        curve(&script, ids[1]),
        Curve::clone(before.curve(ids[1]).expect("it stays"))
    );
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));

    // A periodic curve has no end any more: the match stays at the same place, a parameter.
    script.editor.activate(ids[0]);
    let end = curve(&script, ids[0]).polygon.segments() as f64;
    script.command(Command::TogglePeriodic);
    let matched = first_match(&script);
    assert_eq!(matched.place, MatchPlace::Parameter(end));
    assert!(script.editor.document().meets(&matched));
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn a_picked_target_is_kept_matched_afterwards() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G1, false);
    assert_eq!(script.editor.document().matches().len(), 0);
    script.end_fit_action(EndFitAction::KeepMatched(true));
    let matched = first_match(&script);
    assert_eq!((matched.source, matched.end), (ids[0], End::Start));
    assert_eq!(matched.continuity, Continuity::G1);
    let whole: Vec<usize> = (0..curve(&script, ids[0]).polygon.vertices().len()).collect();
    let by = DVec3::new(0.3, -0.2, 0.0);
    let moves = whole.into_iter().map(|vertex| {
        let point = curve(&script, ids[0]).polygon.vertex(vertex);
        (vertex, point + by)
    });
    let moves = moves.collect();
    let moved = Edit::MoveVertices {
        curve: ids[0],
        moves,
    };
    script.editor.change(moved).expect("moved");
    assert!(missing(&script, &matched) < 1e-9);
    script.end_fit_action(EndFitAction::KeepMatched(false));
    assert_eq!(script.editor.document().matches().len(), 0);
    // Without a target nothing was picked for this end.
    script.end_fit_action(EndFitAction::ClearTarget);
    script.end_fit_action(EndFitAction::KeepMatched(true));
    assert_eq!(script.editor.document().matches().len(), 0);
}

#[test]
fn a_chain_of_curves_follows_from_the_first_to_the_last() {
    let (mut script, ids) = script();
    let points = [
        (16.0, -4.0),
        (17.0, -5.0),
        (18.0, -5.2),
        (19.0, -4.0),
        (20.0, -2.0),
        (21.0, 0.0),
    ];
    let third = script.editor.document().next_id();
    let added = Curve::new("third", polygon(3, &points));
    told(script.editor.apply("Add", vec![Edit::Add(Box::new(added))]));
    let link = |curve, source| EndMatch {
        curve,
        end: End::Start,
        source,
        place: MatchPlace::End(End::Finish),
        continuity: Continuity::G1,
        reversed: false,
    };
    let both = [link(third, ids[1]), link(ids[1], ids[0])];
    told(
        script
            .editor
            .apply("Match", both.map(Edit::SetMatch).to_vec()),
    );
    script.tool(ToolKind::Select);
    script.editor.activate(ids[0]);
    // The end of the second keeps its place, so that the third is moved by its start alone.
    let edit = Edit::MoveVertices {
        curve: ids[1],
        moves: vec![(7, DVec3::new(15.0, -2.0, 0.0))],
    };
    told(script.editor.apply("Move", vec![edit]));
    for matched in both {
        assert!(missing(&script, &matched) <= MET);
    }
    script.drag_vertex(5, DVec2::new(10.0, 20.0));
    for matched in both {
        assert!(missing(&script, &matched) <= MET);
    }
}

#[test]
fn locked_and_hidden_curves_follow_once_they_are_free() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G1, true);
    let matched = first_match(&script);
    let before = curve(&script, ids[1]).polygon;
    for protect in [Command::ToggleLocked, Command::ToggleVisible] {
        script.tool(ToolKind::Select);
        script.editor.activate(ids[1]);
        script.command(protect);
        script.editor.activate(ids[0]);
        script.drag_vertex(5, DVec2::new(10.0, 20.0));
        assert_eq!(curve(&script, ids[1]).polygon, before, "{protect:?}");
        assert!(missing(&script, &matched) > 1e-3, "{protect:?}");
        script.editor.activate(ids[1]);
        script.command(protect);
        assert!(missing(&script, &matched) <= MET, "{protect:?}");
        for _ in 0..3 {
            script.command(Command::Undo);
        }
        assert_eq!(curve(&script, ids[1]).polygon, before, "{protect:?}");
    }
}

#[test]
fn operations_on_either_curve_leave_a_match_where_it_is() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G2, true);
    let inner = EndMatch {
        curve: ids[1],
        end: End::Finish,
        source: ids[0],
        place: MatchPlace::Parameter(1.5),
        continuity: Continuity::G1,
        reversed: false,
    };
    told(script.editor.apply("Match", vec![Edit::SetMatch(inner)]));
    let before = script.editor.document().clone();
    let follower = |script: &Script, id: CurveId| curve(script, id).polygon;
    type Step = (usize, &'static str, Vec<(&'static str, Value)>);
    let steps: [Step; 6] = [
        (0, "reverse", vec![]),
        (1, "reverse", vec![]),
        (0, "subdivide", vec![]),
        (
            0,
            "extend",
            vec![("end", Value::Choice(0)), ("segments", Value::Whole(2))],
        ),
        (0, "trim", vec![("from", Value::Real(1.0))]),
        (0, "split", vec![("at", Value::Real(1.0))]),
    ];
    for (number, name, values) in steps {
        script.editor.activate(ids[number]);
        script.operate(name, &values).expect("it can run");
        let size = before.curve(ids[1]).expect("a curve").polygon.size();
        let now = follower(&script, ids[1]);
        let then = &before.curve(ids[1]).expect("a curve").polygon;
        let then = if (number, name) == (1, "reverse") {
            then.reversed()
        } else {
            then.clone()
        };
        let pairs = now.vertices().iter().zip(then.vertices());
        let moved = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(moved < 1e-9 * size, "{name}: {moved:e}");
        let matches: Vec<EndMatch> = script.editor.document().matches().copied().collect();
        assert_eq!(matches.len(), 2, "{name}");
        for matched in matches {
            assert!(missing(&script, &matched) <= MET, "{name}: {matched:?}");
        }
        script.command(Command::Undo);
        assert!(script.editor.document().is_same(&before), "{name}");
    }
    // What is cut off is followed no longer.
    script.editor.activate(ids[0]);
    script
        .operate("trim", &[("from", Value::Real(2.0))])
        .expect("a part");
    assert_eq!(script.editor.document().matches().len(), 1);
    assert!(
        script.message().contains("1 match to it is removed"),
        "{}",
        script.message()
    );
    script.command(Command::Undo);

    // The matched end goes with the second part.
    script.editor.activate(ids[1]);
    script.operate("split", &[]).expect("two parts");
    let second = script.editor.document().ids().last().expect("a part");
    let document = script.editor.document();
    assert!(document.match_of(second, End::Finish).is_some());
    assert!(document.match_of(ids[1], End::Start).is_some());
    assert_eq!(document.matches().len(), 2);
}

#[test]
fn a_match_is_saved_and_imported_with_its_curves() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G3, true);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("matched.batten");
    told(script.editor.save(&path));
    let before = script.editor.document().clone();
    let text = std::fs::read_to_string(&path).expect("a file");
    assert!(
        text.contains("\"version\": 2") && text.contains("\"continuity\": \"G3\""),
        "{text}"
    );

    let mut opened = Editor::new();
    told(opened.open(std::slice::from_ref(&path)));
    assert!(opened.document().is_same(&before));

    told(opened.import(std::slice::from_ref(&path)));
    let ids: Vec<CurveId> = opened.document().ids().collect();
    let matches: Vec<EndMatch> = opened.document().matches().copied().collect();
    assert_eq!(matches.len(), 2);
    assert_eq!((matches[1].curve, matches[1].source), (ids[3], ids[2]));
    told(opened.execute(Command::Undo));
    assert!(opened.document().is_same(&before));
}

#[test]
fn an_export_names_the_matches_of_what_it_holds() {
    let (mut script, ids) = script();
    pick_end(&mut script, ids, Continuity::G1, true);
    let folder = tempfile::tempdir().expect("a folder");
    for extension in ["csv", "dxf"] {
        let path = folder.path().join("matched").with_extension(extension);
        let export = exporter(extension, PolygonKind::Float);
        told(script.editor.export(&path, &export));
        let message = script.message();
        let line = "the match of its start to “first” isn't stored";
        assert!(message.contains(line), "{message}");
    }
    // A curve that is hidden is not exported, and nothing of it is lost.
    told(script.editor.change(Edit::SetVisible {
        curve: ids[1],
        visible: false,
    }));
    let path = folder.path().join("one.csv");
    let export = exporter("csv", PolygonKind::Float);
    told(script.editor.export(&path, &export));
    assert!(
        !script.message().contains("the match of"),
        "{}",
        script.message()
    );
}

#[test]
fn the_osculating_circle_of_a_target_is_dragged() {
    let (mut script, ids) = script();
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::TargetActual);
    script.end_fit_action(EndFitAction::SetCurvature(Some(0.5)));
    let target = |script: &Script| curve(script, ids[1]).targets.start.expect("a target");
    let before = target(&script);
    assert_eq!(before.curvature, Some(0.5));
    let circle = script.scene().ends[0].circle.clone();
    assert!(circle.len() > 10);
    let [along, point] = [before.direction.expect("a direction"), before.point];
    let across = DVec3::Z.cross(along.normalize());
    // Every point of the circle is 2 from its centre.
    let centre = (point + 2.0 * across).truncate();
    for place in circle {
        assert!((place.distance(centre) - 2.0).abs() < 1e-12);
    }
    // Drag its far point to the other side: the new circle passes through it.
    let top = at(&script, point + 4.0 * across);
    let to = at(&script, point - 8.0 * across);
    script.press(top);
    script.move_to(0.5 * (top + to));
    script.move_to(to);
    let dragged = target(&script).curvature.expect("a curvature");
    assert!((dragged + 0.25).abs() < 1e-3, "{dragged}");
    assert!(
        script.editor.hint().contains("radius"),
        "{}",
        script.editor.hint()
    );
    script.key(Key::Escape);
    assert_eq!(target(&script), before);
    script.release(to);
    script.drag(top, to);
    assert!((target(&script).curvature.expect("a curvature") + 0.25).abs() < 1e-3);
    assert_eq!(
        script.editor.workspace().history().undo_label(),
        Some("Change target curvature of start")
    );
    script.command(Command::Undo);
    assert_eq!(target(&script), before);
}

#[test]
fn fields_of_a_target_depend_on_each_other() {
    let (mut script, ids) = script();
    let target = |script: &Script| curve(script, ids[1]).targets.start.unwrap_or_default();
    let jet = curve(&script, ids[1]).polygon.end_jet(End::Start);
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::SetSlope(Some(0.1)));
    let expected = EndTarget {
        point: jet.point,
        direction: jet.tangent(),
        curvature: Some(jet.signed_curvature()),
        normal: None,
        slope: Some(0.1),
    };
    assert_eq!(target(&script), expected);
    let report = script.end_fit().expect("figures");
    let missing = report.missing.expect("differences");
    assert_eq!(missing.slope, 0.1 - jet.curvature_slope(true));
    script.end_fit_action(EndFitAction::SetPoint(DVec3::ONE));
    assert_eq!(
        target(&script),
        EndTarget {
            point: DVec3::ONE,
            ..expected
        }
    );
    script.end_fit_action(EndFitAction::SetCurvature(None));
    assert_eq!(
        (target(&script).curvature, target(&script).slope),
        (None, None)
    );
    script.end_fit_action(EndFitAction::SetCurvature(Some(2.0)));
    script.end_fit_action(EndFitAction::SetDirection(None));
    assert_eq!(target(&script).curvature, None);
    assert_eq!(script.steps(), 5);
    script.undo_all();
    assert_eq!(curve(&script, ids[1]).targets.start, None);
}

#[test]
fn a_match_that_cannot_be_met_is_shown_and_met_once_it_can_be() {
    let (mut script, ids) = script();
    let all = (0..8).collect::<Vec<usize>>();
    let lock = |vertices, locked| Edit::SetVerticesLocked {
        curve: ids[1],
        vertices,
        locked,
    };
    told(script.editor.change(lock(all.clone(), true)));
    let before = curve(&script, ids[1]).polygon;
    pick_end(&mut script, ids, Continuity::G1, true);
    let matched = first_match(&script);
    assert_eq!(curve(&script, ids[1]).polygon, before);
    assert!(!script.editor.document().meets(&matched));
    let shown = script.end_fit().and_then(|report| report.matched);
    assert!(!shown.expect("a match").met);
    let marks = |script: &mut Script| -> Vec<Option<bool>> {
        let ends = &script.scene().ends;
        ends.iter().map(|marks| marks.matched).collect()
    };
    assert_eq!(marks(&mut script), [Some(false)]);

    // Some of the vertices are enough.
    told(script.editor.change(lock(all[..5].to_vec(), false)));
    assert!(script.editor.document().meets(&matched));
    assert_eq!(marks(&mut script), [Some(true)]);
    let after = curve(&script, ids[1]).polygon;
    assert_eq!(after.vertices()[5..], before.vertices()[5..]);
    assert_ne!(after.vertices()[..5], before.vertices()[..5]);
    script.command(Command::Undo);
    assert_eq!(curve(&script, ids[1]).polygon, before);
    assert_eq!(marks(&mut script), [Some(false)]);
}

#[test]
fn vertex_tools_on_a_source_keep_the_matched_place_and_the_locks() {
    let source: Vec<(f64, f64)> = (0..12)
        .map(|i| (f64::from(i), f64::from(i).sin()))
        .collect();
    let second = [
        (8.0, 4.0),
        (9.0, 5.0),
        (10.0, 5.5),
        (11.0, 5.4),
        (12.0, 5.0),
        (13.0, 4.0),
    ];
    for tool in [ToolKind::Insert, ToolKind::Delete, ToolKind::AddVertex] {
        let curves = [
            Curve::new("first", polygon(3, &source)),
            Curve::new("second", polygon(3, &second)),
        ];
        let document = Document::from_curves(curves);
        let ids: Vec<CurveId> = document.ids().collect();
        let matched = EndMatch {
            curve: ids[1],
            end: End::Start,
            source: ids[0],
            place: MatchPlace::Parameter(6.25),
            continuity: Continuity::G1,
            reversed: false,
        };
        let lock = Edit::SetVerticesLocked {
            curve: ids[0],
            vertices: vec![10],
            locked: true,
        };
        let document = document
            .edited([lock, Edit::SetMatch(matched)])
            .expect("a match");
        assert!(document.meets(&matched));
        let mut script = Script {
            editor: Editor::with_document(document),
        };
        script.editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
        script.check();
        script.command(Command::ZoomOut);
        let before = script.editor.document().clone();
        let [old, follower] = [0, 1].map(|index| curve(&script, ids[index]));
        let point = old.polygon.point(6.25);

        script.command(Command::ToggleKeepShape);
        script.editor.activate(ids[0]);
        script.tool(tool);
        let [first, second] = [0, 1].map(|vertex| old.polygon.vertex(vertex));
        // Far from the matched place: it must not move.
        script.click(at(
            &script,
            match tool {
                ToolKind::Insert => 0.5 * (first + second),
                ToolKind::Delete => second,
                _ => first - DVec3::new(1.0, 1.0, 0.0),
            },
        ));
        let new = curve(&script, ids[0]);
        let change = new.polygon.vertices().len() as isize - 12;
        assert_eq!(
            change,
            if tool == ToolKind::Delete { -1 } else { 1 },
            "{}",
            script.message()
        );
        let place = MatchPlace::Parameter(6.25 + change as f64);
        assert_eq!(first_match(&script).place, place, "{tool:?}");
        assert_eq!(new.polygon.point(6.25 + change as f64), point, "{tool:?}");
        assert_eq!(curve(&script, ids[1]).polygon, follower.polygon, "{tool:?}");
        let locked: Vec<usize> = new.locked_vertices.iter().collect();
        assert_eq!(locked, [(10 + change) as usize], "{tool:?}");
        assert_eq!(
            new.polygon.vertex(locked[0]),
            old.polygon.vertex(10),
            "{tool:?}"
        );
        script.undo_all();
        assert!(script.editor.document().is_same(&before), "{tool:?}");
    }
}

/// The names that the canvas shows beside places.
fn names(script: &mut Script) -> Vec<String> {
    let marks = script.scene().marks.iter();
    let names = marks.filter_map(|mark| match mark {
        Mark::Name(_, name) => Some(name.clone()),
        _ => None,
    });
    names.collect()
}

#[test]
fn a_pick_says_beforehand_what_it_takes_and_prefers_curves_to_points() {
    let (mut script, ids) = script();
    let source = curve(&script, ids[0]).polygon;
    let end = source.end_jet(End::Finish).point;
    // Points on the curve, one of them at its end.
    let points = vec![source.point(0.5), source.point(1.25), end, end + DVec3::Y];
    let list = ReferenceForm::Points(PointList::new(points).expect("points"));
    let list = Reference::new("scan", ReferenceCurve::of(list).expect("a reference"));
    let add = Edit::AddReference(Box::new(list));
    script.editor.apply("add", vec![add]).expect("an edit");
    script.editor.activate(ids[1]);
    script.check();
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::SetContinuity(Continuity::G2));
    script.end_fit_action(EndFitAction::KeepMatched(false));
    script.end_fit_action(EndFitAction::PickFromCurve);
    script.move_to(at(&script, end));
    assert_eq!(
        names(&mut script),
        ["first, end: position, direction, curvature"]
    );
    // Away from the curve there are only points, which have no direction.
    let apart = at(&script, end + DVec3::Y);
    script.move_to(apart);
    assert_eq!(
        names(&mut script),
        ["scan, end: Points have no direction: pick them with G0"]
    );
    let before = script.editor.document().clone();
    script.click(apart);
    assert_eq!(
        script.message(),
        "Points have no direction: pick them with G0"
    );
    assert!(script.editor.document().is_same(&before));
    script.end_fit_action(EndFitAction::SetContinuity(Continuity::G0));
    script.click(apart);
    let target = curve(&script, ids[1]).targets.start.expect("a target");
    assert_eq!((target.point, target.direction), (end + DVec3::Y, None));
    script.end_fit_action(EndFitAction::SetContinuity(Continuity::G2));
    script.end_fit_action(EndFitAction::PickFromCurve);
    script.click(at(&script, end));
    let target = curve(&script, ids[1]).targets.start.expect("a target");
    assert_eq!(target.point, end);
    assert!(target.curvature.is_some());
}
