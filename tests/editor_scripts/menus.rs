//! Clicks with the second button: what the menu that is asked for is about, and what is selected then.

use batten::editor::{Button, Command, Input, MenuOf, MenuSubject, ToolKind};
use batten::geometry::references::find;
use batten::geometry::{End, FloatPolygon};
use glam::DVec2;

use super::script::Script;
use super::several::two;

/// A place on the canvas at which nothing lies.
const NOWHERE: DVec2 = DVec2::new(4.0, 5.0);

/// Click with the second button; tells what the menu is about that is asked for.
fn ask(script: &mut Script, at: DVec2) -> Option<MenuSubject> {
    let button = Button::Secondary;
    script.move_to(at);
    script.input(Input::Pressed { button, at });
    script.input(Input::Released { button, at });
    let asked = script.editor.hand_mut().take_menu();
    assert_eq!(
        script.editor.hand_mut().take_menu(),
        None,
        "it is asked for once"
    );
    asked.map(|asked| asked.subject)
}

fn at_end(script: &Script, end: End) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(script.polygon().end_jet(end).point))
}

#[test]
fn a_vertex_that_is_not_selected_is_selected_first() {
    let (mut script, [arc, other]) = two();
    let vertex = script.at_vertex(4);
    assert_eq!(ask(&mut script, vertex), Some(MenuSubject::Vertex));
    assert_eq!(script.selected(), [4]);
    // What is selected stays so: the menu is about all of it.
    script.editor.select_vertex(arc, 6, true);
    assert_eq!(ask(&mut script, vertex), Some(MenuSubject::Vertex));
    assert_eq!(script.selected(), [4, 6]);
    // That of another curve makes this the active one.
    let vertex = script.at_vertex_of(other, 8);
    assert_eq!(ask(&mut script, vertex), Some(MenuSubject::Vertex));
    assert_eq!((script.curve(), script.selected()), (other, vec![8]));
    assert_eq!(script.steps(), 1, "only the curve was added");
}

#[test]
fn a_leg_selects_its_two_vertices() {
    let mut script = Script::example("s-curve");
    let legs = script.polygon().vertices().len() - 1;
    let found = (0..legs).find(|leg| {
        let at = 0.5 * (script.at_vertex(*leg) + script.at_vertex(leg + 1));
        ask(&mut script, at) == Some(MenuSubject::Leg)
    });
    let leg = found.expect("a leg that is free in its middle");
    assert_eq!(script.selected(), [leg, leg + 1]);
}

#[test]
fn an_end_is_the_one_that_the_end_fit_tool_then_has() {
    let (mut script, [arc, _]) = two();
    script.editor.activate(arc);
    for end in End::BOTH {
        script.tool(ToolKind::Select);
        let at = at_end(&script, end);
        assert_eq!(ask(&mut script, at), Some(MenuSubject::End));
        script.tool(ToolKind::EndFit);
        let report = script.end_fit().expect("a report");
        assert_eq!(report.end, end);
    }
}

#[test]
fn of_an_end_and_a_vertex_beside_it_the_nearer_one_has_the_menu() {
    let mut script = Script::example("s-curve");
    let points = [(0.0, 0.0), (1.0, 0.02), (2.0, 0.0), (3.0, 1.0)];
    script.set_polygon(FloatPolygon::planar(2, &points).expect("a polygon"));
    // The end is midway between the first two vertices: seen from far, near both.
    let away = |script: &Script| at_end(script, End::Start).distance(script.at_vertex(1));
    while away(&script) > 5.0 {
        script.command(Command::ZoomOut);
    }
    assert!(away(&script) > 1.5, "they are told apart");
    let seen = at_end(&script, End::Start);
    assert_eq!(ask(&mut script, seen), Some(MenuSubject::End));
    let vertex = script.at_vertex(1);
    assert_eq!(ask(&mut script, vertex), Some(MenuSubject::Vertex));
}

#[test]
fn curves_references_and_the_canvas_have_menus_of_their_own() {
    let (mut script, [arc, other]) = two();
    script.editor.activate(other);
    let shape = script.editor.document().shape(arc).expect("a curve");
    let point = shape.jet(0.5).point;
    let viewport = *script.editor.view().viewport();
    let at = viewport.to_screen(viewport.flatten(point));
    assert_eq!(ask(&mut script, at), Some(MenuSubject::Curve));
    assert_eq!(script.curve(), arc);
    assert_eq!(ask(&mut script, NOWHERE), Some(MenuSubject::Canvas));
    assert_eq!(script.curve(), arc);
    // Vertices that are selected stay so for a menu of the canvas.
    script.editor.select_vertex(arc, 1, false);
    assert_eq!(ask(&mut script, NOWHERE), Some(MenuSubject::Canvas));
    assert_eq!(script.selected_of(arc), [1]);
    script.command(Command::AddReference(find("circle").expect("a kind")));
    let circle = script.curve();
    script.editor.activate(arc);
    script.command(Command::FitAll);
    let shape = script.editor.document().shape(circle).expect("a circle");
    let viewport = *script.editor.view().viewport();
    let on_it = |share: f64| {
        let point = shape.jet(share * shape.pieces() as f64).point;
        viewport.to_screen(viewport.flatten(point))
    };
    let places: Vec<DVec2> = (0..32).map(|step| on_it(f64::from(step) / 32.0)).collect();
    let mut asked = places.into_iter().map(|at| ask(&mut script, at));
    assert!(asked.any(|subject| subject == Some(MenuSubject::Reference)));
    drop(asked);
    assert_eq!(script.curve(), circle);
    // A row of the list asks for the same.
    for (id, subject) in [(arc, MenuSubject::Curve), (circle, MenuSubject::Reference)] {
        script.editor.ask_for_menu(MenuOf::Item(id));
        let asked = script.editor.hand_mut().take_menu().expect("a menu");
        assert_eq!((asked.subject, script.curve()), (subject, id));
    }
}

#[test]
fn a_drag_with_the_second_button_and_the_end_of_drawing_ask_for_none() {
    let mut script = Script::example("s-curve");
    let vertex = script.at_vertex(2);
    script.drag_with(Button::Secondary, vertex, vertex + DVec2::new(30.0, 0.0));
    assert_eq!(script.editor.hand_mut().take_menu(), None);
    assert_eq!(script.selected(), [0; 0]);
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.tool(ToolKind::Draw);
    for (x, y) in [
        (100.0, 400.0),
        (300.0, 200.0),
        (500.0, 210.0),
        (700.0, 420.0),
    ] {
        script.click(DVec2::new(x, y));
    }
    assert_eq!(ask(&mut script, DVec2::new(710.0, 400.0)), None);
    assert_eq!(script.editor.document().len(), 1, "it ends the drawing");
    // Nor does one while an operation is tried out.
    script.try_out("round").expect("it can run");
    let vertex = script.at_vertex(1);
    assert_eq!(ask(&mut script, vertex), None);
    assert!(script.editor.previewed_operation().is_some());
}

#[test]
fn the_menu_key_asks_for_a_menu_beside_what_is_selected() {
    let mut script = Script::example("s-curve");
    script.editor.select_vertex(script.curve(), 3, false);
    script.editor.ask_for_menu(MenuOf::Selection);
    let asked = script.editor.hand_mut().take_menu().expect("a menu");
    assert_eq!(asked.subject, MenuSubject::Vertex);
    assert_eq!(asked.at, Some(script.at_vertex(3)));
    script.command(Command::SelectNone);
    script.editor.ask_for_menu(MenuOf::Selection);
    let asked = script.editor.hand_mut().take_menu().expect("a menu");
    assert_eq!(asked.subject, MenuSubject::Curve);
    script.editor.begin_empty();
    script.editor.ask_for_menu(MenuOf::Selection);
    let asked = script.editor.hand_mut().take_menu().expect("a menu");
    assert_eq!(asked.subject, MenuSubject::Canvas);
}
