//! Points, angles and factors that are typed, what is locked of a leg, and curves that begin and end
//! at clicks.

use batten::editor::{
    Button, Command, DrawSettings, DrawWay, EntryError, Input, Key, LegLocks, Modifiers, NamedView,
    ToolKind,
};
use batten::geometry::{End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::script::Script;

/// How far a computed coordinate may be from what was asked for, in units of the curve's size.
const NEAR: f64 = 1e-12;

fn empty(tool: ToolKind) -> Script {
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.draw_by(DrawWay::Vertices);
    script.tool(tool);
    script
}

#[track_caller]
fn enter(script: &mut Script, text: &str) {
    script.editor.type_entry(text);
    script.check();
    if let Err(error) = script.editor.enter(text) {
        panic!("{text}: {error}");
    }
    script.check();
}

/// The points of the curve that a click would make, as it is drawn.
fn proposed(script: &mut Script) -> Vec<DVec2> {
    script.editor.refresh();
    script.editor.view().scene().proposal.curve.clone()
}

#[test]
fn a_polygon_is_typed_to_the_bit_as_one_step() {
    let mut script = empty(ToolKind::Draw);
    for text in ["1,2", "@3,0", "@2<90", "@1,1", "10,-4", "12,-4,0"] {
        enter(&mut script, text);
    }
    assert_eq!(script.steps(), 0);
    script.key(Key::Enter);
    let expected = [
        (1.0, 2.0),
        (4.0, 2.0),
        (4.0, 4.0),
        (5.0, 5.0),
        (10.0, -4.0),
        (12.0, -4.0),
    ];
    let expected = expected.map(|(x, y)| DVec3::new(x, y, 0.0));
    assert_eq!(script.polygon().vertices(), expected);
    assert_eq!(script.polygon().degree(), 5);
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert!(script.editor.document().is_empty());
}

#[test]
fn in_space_two_numbers_are_those_of_the_view_and_three_are_x_y_z() {
    let mut script = empty(ToolKind::Draw);
    script.command(Command::View(NamedView::Xz));
    for text in ["1,2", "@0,3", "4,5,6", "@1,1,1", "7,8", "@2<90"] {
        enter(&mut script, text);
    }
    script.key(Key::Enter);
    let expected = [
        DVec3::new(1.0, 0.0, 2.0),
        DVec3::new(1.0, 0.0, 5.0),
        DVec3::new(4.0, 5.0, 6.0),
        DVec3::new(5.0, 6.0, 7.0),
        // Across the plane the point is where the vertex before is.
        DVec3::new(7.0, 6.0, 8.0),
        DVec3::new(7.0, 6.0, 10.0),
    ];
    assert_eq!(script.polygon().vertices(), expected);
}

#[test]
fn what_is_wrong_changes_nothing_and_says_where() {
    let mut script = empty(ToolKind::Draw);
    let error = script.editor.enter("@1,2").expect_err("no vertex before");
    assert!(
        matches!(error, EntryError::Text { column: 1, .. }),
        "{error}"
    );
    enter(&mut script, "1,2");
    let error = script.editor.enter("3;4").expect_err("no point");
    assert!(error.to_string().starts_with("column 2: "), "{error}");
    assert!(script.editor.enter("1,2").is_err(), "the same point again");
    assert!(script.editor.enter("1,1e200").is_err(), "out of range");
    enter(&mut script, "3,4");
    script.key(Key::Enter);
    assert_eq!(script.polygon().vertices().len(), 2);
}

#[test]
fn the_curve_that_a_click_would_make_follows_the_pointer_and_what_is_typed() {
    let mut script = empty(ToolKind::Draw);
    assert!(proposed(&mut script).is_empty());
    for place in [(200.0, 500.0), (400.0, 300.0), (600.0, 320.0)] {
        script.click(DVec2::from(place));
    }
    script.move_to(DVec2::new(800.0, 500.0));
    let first = proposed(&mut script);
    assert!(first.len() > 10);
    script.move_to(DVec2::new(900.0, 100.0));
    let second = proposed(&mut script);
    assert_ne!(first, second);
    // What is typed counts more than the pointer.
    script.editor.type_entry("@5<0");
    let typed = proposed(&mut script);
    assert_ne!(typed, second);
    assert_eq!(
        script
            .editor
            .hand()
            .leg(&script.editor.context())
            .expect("a leg")
            .length,
        5.0
    );
    script.editor.type_entry("@5<");
    assert_eq!(
        proposed(&mut script),
        second,
        "what is no point yet is passed over"
    );
    // A click makes just that curve.
    script.editor.type_entry("");
    script.click(DVec2::new(900.0, 100.0));
    script.input(Input::Left);
    assert_eq!(proposed(&mut script), second);
    script.key(Key::Enter);
    assert!(proposed(&mut script).is_empty());
    assert_eq!(script.polygon().vertices().len(), 4);
    // On the first vertex it is the periodic curve.
    script.tool(ToolKind::Draw);
    for place in [(200.0, 500.0), (400.0, 300.0), (600.0, 320.0)] {
        script.click(DVec2::from(place));
    }
    script.move_to(DVec2::new(201.0, 500.0));
    let closed = proposed(&mut script);
    assert_eq!(closed.first(), closed.last());
}

#[test]
fn a_pointer_that_rests_proposes_no_point_after_a_typed_one() {
    let mut script = empty(ToolKind::Draw);
    script.move_to(DVec2::new(60.0, 500.0));
    for text in ["0,30", "100,30", "100,80"] {
        enter(&mut script, text);
    }
    let end = |script: &mut Script| *proposed(script).last().expect("a curve");
    let rests = end(&mut script);
    let last = DVec2::new(100.0, 80.0);
    script.draw_by(DrawWay::OnClicks);
    assert!(
        end(&mut script).distance(last) < 1e-9,
        "the curve ends at the last point"
    );
    script.draw_by(DrawWay::Vertices);
    assert_eq!(end(&mut script), rests);
    script.move_to(DVec2::new(70.0, 500.0));
    assert_ne!(
        end(&mut script),
        rests,
        "the pointer proposes a point once it moves"
    );
}

#[test]
fn escape_while_drawing_restores_to_the_bit() {
    let mut script = Script::example("s-curve");
    let before = script.editor.document().clone();
    script.tool(ToolKind::Draw);
    enter(&mut script, "0,0");
    enter(&mut script, "@10<30");
    script.editor.type_entry("@1,1");
    script.key(Key::Escape);
    script.key(Key::Escape);
    assert_eq!(script.editor.hand().tool(), ToolKind::Select);
    assert!(script.editor.document().is_same(&before));
    assert_eq!(script.steps(), 0);
}

#[test]
fn locks_hold_the_leg_and_a_click_keeps_to_them() {
    let mut script = empty(ToolKind::Draw);
    enter(&mut script, "1,1");
    let at = script
        .editor
        .view()
        .viewport()
        .to_screen(DVec2::new(4.0, 5.1));
    let lock = |length, degrees| LegLocks { length, degrees };
    script.editor.hand_mut().lock_leg(lock(Some(2.5), None));
    script.move_to(at);
    let leg = script
        .editor
        .hand()
        .leg(&script.editor.context())
        .expect("a leg");
    assert!((leg.length - 2.5).abs() < NEAR);
    script
        .editor
        .hand_mut()
        .lock_leg(lock(Some(2.5), Some(90.0)));
    script.click(at);
    script.editor.hand_mut().lock_leg(lock(None, Some(180.0)));
    script.click(
        script
            .editor
            .view()
            .viewport()
            .to_screen(DVec2::new(-3.3, 50.0)),
    );
    // Neither 0 nor what is no number can be locked.
    script
        .editor
        .hand_mut()
        .lock_leg(lock(Some(0.0), Some(f64::NAN)));
    assert_eq!(script.editor.hand().leg_locks(), Some(LegLocks::default()));
    script.key(Key::Enter);
    let vertices = script.polygon().vertices().to_vec();
    assert_eq!(vertices[1], DVec3::new(1.0, 3.5, 0.0));
    assert_eq!(vertices[2].y, 3.5);
    assert!((vertices[2].x + 3.3).abs() < 0.5, "{}", vertices[2]);
}

#[test]
fn vertices_are_added_and_inserted_where_is_typed() {
    for name in ["s-curve", "hull", "periodic"] {
        let mut script = Script::example(name);
        let before = script.polygon();
        let count = before.vertices().len();
        script.draw_by(DrawWay::Vertices);
        script.tool(ToolKind::AddVertex);
        enter(&mut script, "@3,4");
        let added = script.polygon();
        assert_eq!(added.vertices().len(), count + 1);
        let leg = added.vertex(count) - before.vertex(count - 1);
        assert!(leg.distance(DVec3::new(3.0, 4.0, 0.0)) < NEAR * before.size());
        assert_eq!(script.selected(), [count]);
        assert_eq!(script.steps(), 1);
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before);

        // At the start, where the pointer is.
        script.move_to(script.at_vertex(0) + DVec2::new(-3.0, 3.0));
        enter(&mut script, "@1,0");
        let leg = script.polygon().vertex(0) - before.vertex(0);
        assert!(
            leg.distance(DVec3::X) < NEAR * before.size(),
            "{name}: {leg}"
        );
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before);

        script.tool(ToolKind::Insert);
        script.input(Input::Left);
        let refused = script
            .editor
            .enter("@1,2")
            .expect_err("no leg is pointed at");
        assert!(matches!(refused, EntryError::Refused(_)));
        script.move_to(0.5 * (script.at_vertex(2) + script.at_vertex(3)));
        let shown = proposed(&mut script);
        assert!(!shown.is_empty(), "{name}");
        enter(&mut script, "@1,2");
        let leg = script.polygon().vertex(3) - before.vertex(2);
        assert!(leg.distance(DVec3::new(1.0, 2.0, 0.0)) < NEAR * before.size());
        assert_eq!(script.steps(), 1);
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before);
    }
}

#[test]
fn a_point_typed_in_the_middle_of_a_drag_ends_it() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let count = before.vertices().len();
    script.draw_by(DrawWay::Vertices);
    script.tool(ToolKind::AddVertex);
    let at = script.at_vertex(count - 1) + DVec2::new(30.0, 20.0);
    script.press(at);
    script.move_to(at + DVec2::new(40.0, 0.0));
    enter(&mut script, "@2,1");
    script.move_to(at + DVec2::new(90.0, 0.0));
    script.release(at + DVec2::new(90.0, 0.0));
    let leg = script.polygon().vertex(count) - before.vertex(count - 1);
    assert!(leg.distance(DVec3::new(2.0, 1.0, 0.0)) < NEAR * before.size());
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);

    // Wrong text lets the drag go on, which Esc then takes back to the bit.
    script.press(at);
    script.move_to(at + DVec2::new(40.0, 0.0));
    script.editor.type_entry("@2");
    assert!(script.editor.enter("@2").is_err());
    script.key(Key::Escape);
    script.release(at);
    assert_eq!(script.polygon(), before);
    assert_eq!(script.steps(), 0);
}

#[test]
fn locked_and_hidden_curves_take_no_vertices_that_are_typed() {
    for command in [Command::ToggleLocked, Command::ToggleVisible] {
        let mut script = Script::example("s-curve");
        script.command(command);
        let before = script.polygon();
        script.tool(ToolKind::AddVertex);
        let refused = script.editor.enter("1,2").expect_err("it is not editable");
        assert!(matches!(refused, EntryError::Refused(_)), "{refused}");
        assert!(proposed(&mut script).is_empty());
        assert_eq!(script.polygon(), before);
        assert_eq!(script.steps(), 1);
    }
}

#[test]
fn angles_and_factors_are_typed() {
    for name in ["s-curve", "hull", "periodic"] {
        let mut script = Script::example(name);
        let before = script.polygon();
        let leg = |polygon: &FloatPolygon| polygon.vertex(4) - polygon.vertex(1);
        script.tool(ToolKind::Rotate);
        enter(&mut script, "90");
        let turned = leg(&script.polygon());
        let expected = leg(&before).truncate().perp();
        assert!(turned.truncate().distance(expected) < NEAR * before.size());
        assert_eq!(turned.z, leg(&before).z);
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before);
        script.tool(ToolKind::Scale);
        enter(&mut script, "2");
        let scaled = leg(&script.polygon());
        assert!(scaled.distance(2.0 * leg(&before)) < NEAR * before.size());
        assert!(script.editor.enter("twice").is_err());
        assert_eq!(script.steps(), 1);
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before);
    }
}

#[test]
fn an_angle_typed_in_the_middle_of_a_drag_counts_instead_of_the_drag() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script.tool(ToolKind::Rotate);
    let centre = 0.5 * script.editor.view().viewport().size;
    script.press(centre + DVec2::new(200.0, 0.0));
    script.move_to(centre + DVec2::new(100.0, 150.0));
    assert_ne!(script.polygon(), before);
    enter(&mut script, "180");
    let typed = script.polygon();
    script.move_to(centre + DVec2::new(10.0, 250.0));
    script.release(centre + DVec2::new(10.0, 250.0));
    assert_eq!(script.polygon(), typed);
    let leg = |polygon: &FloatPolygon| polygon.vertex(4) - polygon.vertex(1);
    assert!(leg(&typed).distance(-leg(&before)) < NEAR * before.size());
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
}

#[test]
fn drawn_through_ends_a_curve_begins_and_ends_at_clicks() {
    for view in [NamedView::Xy, NamedView::Yz] {
        for degree in 1..=9 {
            let mut script = empty(ToolKind::Draw);
            script.command(Command::View(view));
            let settings = DrawSettings {
                degree: Some(degree),
                way: DrawWay::OnClicks,
            };
            script.editor.hand_mut().set_draw_settings(settings);
            for text in ["1,2", "@3,1", "@4<-40"] {
                enter(&mut script, text);
            }
            script.input(Input::Pressed {
                button: Button::Secondary,
                at: DVec2::new(500.0, 300.0),
            });
            script.input(Input::Released {
                button: Button::Secondary,
                at: DVec2::new(500.0, 300.0),
            });
            let polygon = script.polygon();
            let seen = |point: DVec3| script.editor.view().viewport().flatten(point);
            let start = seen(polygon.end_jet(End::Start).point);
            assert!(start.distance(DVec2::new(1.0, 2.0)) < NEAR * polygon.size());
            let last = DVec2::new(4.0, 3.0) + 4.0 * DVec2::from_angle((-40.0_f64).to_radians());
            let end = seen(polygon.end_jet(End::Finish).point);
            assert!(end.distance(last) < NEAR * polygon.size());
            assert_eq!(polygon.degree(), degree);
            assert_eq!(polygon.vertices().len(), 1 + 2 * (degree / 2 + 1));
            assert_eq!(script.steps(), 1);
            // The next one is drawn in the same way.
            script.tool(ToolKind::Draw);
            assert_eq!(script.editor.hand().draw_settings(), settings);
        }
    }
}

#[test]
fn shift_keeps_to_fifteen_degrees_while_it_is_shown() {
    let mut script = empty(ToolKind::Draw);
    enter(&mut script, "0,0");
    script.modifiers(Modifiers::SHIFT);
    script.move_to(
        script
            .editor
            .view()
            .viewport()
            .to_screen(DVec2::new(5.0, 3.1)),
    );
    let degrees = script
        .editor
        .hand()
        .leg(&script.editor.context())
        .and_then(|leg| leg.degrees);
    assert!(
        (degrees.expect("an angle") - 30.0).abs() < 1e-9,
        "{degrees:?}"
    );
}

#[test]
fn the_view_follows_what_is_typed() {
    let in_sight = |script: &Script, point: DVec2| {
        let viewport = script.editor.view().viewport();
        let at = viewport.to_screen(point);
        at.cmpge(DVec2::ZERO).all() && at.cmple(viewport.size).all()
    };
    // In an empty document the first two points set the size.
    let mut script = empty(ToolKind::Draw);
    script.editor.type_entry("5000,7000");
    assert!(in_sight(&script, DVec2::new(5000.0, 7000.0)));
    enter(&mut script, "5000,7000");
    script.editor.type_entry("@300<0");
    let viewport = *script.editor.view().viewport();
    let seen = viewport.size.min_element() / viewport.scale;
    assert!((300.0..3000.0).contains(&seen), "{seen}");
    enter(&mut script, "@300<0");
    // From then on the view only widens, before Enter.
    let before = *script.editor.view().viewport();
    script.editor.type_entry("@1<0");
    assert_eq!(*script.editor.view().viewport(), before);
    script.editor.type_entry("@9000<90");
    assert!(in_sight(&script, DVec2::new(5300.0, 16000.0)));
    assert!(in_sight(&script, DVec2::new(5000.0, 7000.0)));
    assert!(script.editor.view().viewport().scale < before.scale);
}

#[test]
fn a_figure_typed_digit_by_digit_turns_about_the_pivot_that_is_shown() {
    for (tool, text) in [
        (ToolKind::Rotate, "30"),
        (ToolKind::Rotate, "-180"),
        (ToolKind::Scale, "0.5"),
    ] {
        let mut script = Script::example("s-curve");
        script.tool(tool);
        let pivot = |script: &Script| {
            let pivot = script.editor.hand().pivot(&script.editor.context());
            pivot.expect("a pivot")
        };
        let (shown, before) = (pivot(&script), script.polygon());
        for length in 1..=text.len() {
            script.editor.type_entry(&text[..length]);
            script.check();
            assert_eq!(pivot(&script), shown, "{text}");
        }
        enter(&mut script, text);
        assert_eq!(pivot(&script), shown, "{text}");
        let figure: f64 = text.parse().expect("a number");
        let size = before.size();
        for (index, vertex) in before.vertices().iter().enumerate() {
            let from = vertex.truncate() - shown;
            let expected = match tool {
                ToolKind::Rotate => DVec2::from_angle(figure.to_radians()).rotate(from),
                _ => figure * from,
            };
            let found = script.polygon().vertex(index).truncate() - shown;
            assert!(found.distance(expected) <= NEAR * size, "{text}: {index}");
        }
    }
}
