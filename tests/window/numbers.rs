//! Numbers that are typed: into the table of vertices, and into every other field.

use batten::document::{Curve, Document, Edit};
use batten::editor::{Editor, Layers, ToolKind};
use batten::geometry::FloatPolygon;
use eframe::egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, TouchPhase, vec2};
use egui_kittest::kittest::Queryable;
use glam::{DVec2, DVec3};

use crate::hand::*;

/// High enough that no field has to be scrolled to.
const SIZE: (f32, f32) = (1480.0, 1300.0);

pub fn window_of(polygons: Vec<FloatPolygon>) -> Window {
    let mut editor = Editor::with_document(Document::default());
    for polygon in polygons {
        let curve = Box::new(Curve::new("curve", polygon));
        editor
            .apply("Add curve", vec![Edit::Add(curve)])
            .expect("an edit");
    }
    let first = editor.document().ids().next().expect("a curve");
    editor.activate(first);
    open_window_with(editor, SIZE.0, SIZE.1)
}

pub fn wave(count: u32, degree: usize) -> FloatPolygon {
    let points = (0..count).map(|i| (f64::from(i), (0.7 * f64::from(i)).sin()));
    FloatPolygon::planar(degree, &points.collect::<Vec<_>>()).expect("a polygon")
}

/// The events of a key that writes something.
pub fn stroke(key: Key, text: &str) -> [Event; 3] {
    let key = |pressed| Event::Key {
        key,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    [key(true), Event::Text(text.to_owned()), key(false)]
}

pub fn digit(digit: char) -> [Event; 3] {
    let key = Key::from_name(&digit.to_string()).expect("a digit");
    stroke(key, &digit.to_string())
}

pub fn strike(window: &mut Window, text: &str) {
    for character in text.chars() {
        let events = match character {
            '-' => stroke(Key::Minus, "-"),
            '.' => stroke(Key::Period, "."),
            character => digit(character),
        };
        for event in events {
            window.event(event);
        }
    }
    window.run();
}

pub fn enter(window: &mut Window) {
    press(window, Modifiers::NONE, Key::Enter);
}

/// Send events that all come in one frame.
pub fn in_one_frame(window: &mut Window, events: Vec<Event>) {
    window.input_mut().events.extend(events);
    window.step();
    window.run();
}

pub fn click_events(pos: eframe::egui::Pos2) -> Vec<Event> {
    let button = |pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    vec![Event::PointerMoved(pos), button(true), button(false)]
}

/// All that a shortcut could change.
pub type State = (Layers, ToolKind, Vec<Curve>, DVec2, f64, Vec<usize>);

pub fn state(window: &Window) -> State {
    let editor = window.state().editor();
    let active = editor.active().expect("a curve");
    let curves = editor.document().curves();
    (
        editor.sight().layers(),
        editor.hand().tool(),
        curves.map(|(_, curve)| Curve::clone(curve)).collect(),
        editor.view().viewport().centre,
        editor.view().viewport().scale,
        editor.hand().selection().of_curve(active).collect(),
    )
}

/// A window with some curves, and the table of the first one's vertices.
pub fn table_of(polygons: Vec<FloatPolygon>) -> Window {
    let mut window = window_of(polygons);
    show_vertices(&mut window);
    window
}

pub fn x(window: &Window, vertex: usize) -> f64 {
    curve(window).polygon.vertex(vertex).x
}

pub fn y(window: &Window, vertex: usize) -> f64 {
    curve(window).polygon.vertex(vertex).y
}

#[test]
fn enter_goes_down_the_table_and_the_next_digit_is_a_number() {
    let mut window = table_of(vec![wave(8, 3)]);
    let layers = window.state().editor().sight().layers();
    click(&mut window, "vertex 0 x");
    for number in ["-1.5", "2", "3.25"] {
        strike(&mut window, number);
        enter(&mut window);
    }
    assert_eq!(
        [x(&window, 0), x(&window, 1), x(&window, 2)],
        [-1.5, 2.0, 3.25]
    );
    // Enter on a number that is not edited goes on too; Shift and Enter goes back.
    enter(&mut window);
    press(&mut window, Modifiers::SHIFT, Key::Enter);
    press(&mut window, Modifiers::SHIFT, Key::Enter);
    strike(&mut window, "7");
    press(&mut window, Modifiers::SHIFT, Key::Enter);
    strike(&mut window, "9");
    enter(&mut window);
    assert_eq!([x(&window, 1), x(&window, 2)], [9.0, 7.0]);
    assert_eq!(window.state().editor().sight().layers(), layers);
    assert_eq!(
        window.state().editor().workspace().history().undo_steps(),
        6,
        "one a number, after Add"
    );
}

#[test]
fn tab_and_arrows_move_in_the_table() {
    let mut window = table_of(vec![wave(8, 3)]);
    click(&mut window, "vertex 0 x");
    strike(&mut window, "1");
    press(&mut window, Modifiers::NONE, Key::Tab);
    strike(&mut window, "2");
    press(&mut window, Modifiers::NONE, Key::Tab);
    strike(&mut window, "3");
    press(&mut window, Modifiers::SHIFT, Key::Tab);
    strike(&mut window, "4");
    press(&mut window, Modifiers::NONE, Key::ArrowDown);
    let polygon = curve(&window).polygon;
    assert_eq!([polygon.vertex(0).x, polygon.vertex(0).y], [1.0, 4.0]);
    assert_eq!(polygon.vertex(1).x, 3.0);
    for key in [Key::ArrowDown, Key::ArrowLeft, Key::ArrowUp, Key::ArrowUp] {
        press(&mut window, Modifiers::NONE, key);
    }
    strike(&mut window, "5");
    enter(&mut window);
    assert_eq!(x(&window, 0), 5.0);
    let before = state(&window);
    // The ends of the table keep the keyboard.
    press(&mut window, Modifiers::COMMAND, Key::End);
    press(&mut window, Modifiers::NONE, Key::End);
    for key in [Key::Tab, Key::ArrowDown, Key::ArrowRight, Key::Delete] {
        press(&mut window, Modifiers::NONE, key);
    }
    assert_eq!(state(&window), before);
    strike(&mut window, "6");
    enter(&mut window);
    assert_eq!(y(&window, 7), 6.0);
}

#[test]
fn escape_calls_an_edit_off_and_then_leaves_the_table() {
    let mut window = table_of(vec![wave(8, 3)]);
    let before = state(&window);
    click(&mut window, "vertex 2 y");
    strike(&mut window, "55");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(state(&window), before);
    strike(&mut window, "4");
    enter(&mut window);
    assert_eq!(y(&window, 2), 4.0, "the cell has kept the keyboard");
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::NONE, Key::D);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Draw);
}

#[test]
fn numbers_and_enter_in_one_frame_keep_their_order() {
    let mut window = table_of(vec![wave(8, 3)]);
    click(&mut window, "vertex 0 x");
    let mut events = Vec::new();
    for number in ["12", "34", "56"] {
        events.extend(number.chars().flat_map(digit));
        events.extend(stroke(Key::Enter, "").into_iter().step_by(2));
    }
    in_one_frame(&mut window, events);
    assert_eq!(
        [x(&window, 0), x(&window, 1), x(&window, 2)],
        [12.0, 34.0, 56.0]
    );
}

#[test]
fn control_keys_work_from_a_cell_and_the_table_keeps_the_keyboard() {
    let mut window = table_of(vec![wave(8, 3)]);
    let original = curve(&window);
    click(&mut window, "vertex 1 x");
    strike(&mut window, "40");
    enter(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), original);
    strike(&mut window, "41");
    // A command takes what is being typed with it.
    press(&mut window, Modifiers::NONE, Key::F8);
    assert_eq!(x(&window, 2), 41.0);
    strike(&mut window, "42");
    enter(&mut window);
    assert_eq!(x(&window, 2), 42.0);
    // The clipboard is the cell's.
    window.event(Event::Paste("1,5\n".to_owned()));
    window.run();
    assert_eq!(x(&window, 3), 1.5);
    window.event(Event::Cut);
    window.run();
    assert_eq!(window.state().editor().document().len(), 1);
    assert_eq!(curve(&window).polygon.vertices().len(), 8);
}

#[test]
fn a_number_reaches_the_curve_it_was_typed_for_though_a_click_makes_another_active() {
    let other = FloatPolygon::planar(2, &[(0.0, 5.0), (3.0, 6.0), (6.0, 5.0), (7.0, 5.0)]);
    let mut window = table_of(vec![wave(8, 3), other.expect("a polygon")]);
    let ids: Vec<_> = window.state().editor().document().ids().collect();
    let polygon = |window: &Window, place: usize| {
        let editor = window.state().editor();
        let curve = editor.document().curve(ids[place]).expect("the curve");
        curve.polygon.clone()
    };
    let untouched = polygon(&window, 1);
    let at = place(&window, untouched.vertex(1).truncate());
    click(&mut window, "vertex 2 x");
    let mut events: Vec<Event> = digit('7').into();
    events.extend(click_events(at));
    in_one_frame(&mut window, events);
    assert_eq!(window.state().editor().active(), Some(ids[1]));
    assert_eq!(polygon(&window, 1), untouched);
    assert_eq!(polygon(&window, 0).vertex(2).x, 7.0);

    // A target's field, too, is of one curve and end.
    click(&mut window, "End fit");
    click(&mut window, "Use current end");
    click(&mut window, "target x");
    strike(&mut window, "8");
    press(&mut window, Modifiers::COMMAND, Key::D);
    let targets = |window: &Window| {
        let editor = window.state().editor();
        let curves = editor.document().curves();
        let points = curves.map(|(_, curve)| curve.targets.finish.map(|target| target.point.x));
        points.collect::<Vec<_>>()
    };
    assert_eq!(targets(&window)[..2], [None, Some(8.0)]);
}

#[test]
fn thousands_of_rows_are_typed_into_and_scroll_into_sight() {
    let mut window = table_of(vec![wave(5000, 3)]);
    click(&mut window, "vertex 0 y");
    press(&mut window, Modifiers::COMMAND, Key::End);
    window.get_by_label("vertex 4999 y");
    strike(&mut window, "3");
    press(&mut window, Modifiers::SHIFT, Key::Enter);
    assert_eq!(y(&window, 4999), 3.0);
    press(&mut window, Modifiers::NONE, Key::PageUp);
    assert!(window.query_by_label("vertex 4999 y").is_none());
    press(&mut window, Modifiers::COMMAND, Key::Home);
    let cell = window.get_by_label("vertex 0 y").rect().center();
    window.hover_at(cell);
    window.run();
    for _ in 0..8 {
        window.event(Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: vec2(0.0, -20.0),
            phase: TouchPhase::Move,
            source: eframe::egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        window.run();
    }
    assert!(
        window.query_by_label("vertex 0 y").is_none(),
        "scrolled away"
    );
    let layers = window.state().editor().sight().layers();
    strike(&mut window, "25");
    enter(&mut window);
    assert_eq!(y(&window, 0), 25.0);
    assert_eq!(window.state().editor().sight().layers(), layers);
    window.get_by_label("vertex 1 y");
}

#[test]
fn a_polynomial_curve_gets_weights_and_loses_them() {
    let mut window = table_of(vec![wave(8, 3)]);
    let original = curve(&window);
    assert!(window.query_by_label("vertex 1 weight").is_none());
    click(&mut window, "Column Weights");
    assert_eq!(curve(&window), original, "showing a column changes nothing");
    click(&mut window, "vertex 1 weight");
    strike(&mut window, "2.5");
    enter(&mut window);
    assert_eq!(curve(&window).polygon.weight(1), 2.5);
    assert_eq!(curve(&window).polygon.weight(2), 1.0);
    press(&mut window, Modifiers::SHIFT, Key::Enter);
    strike(&mut window, "1");
    enter(&mut window);
    assert!(!curve(&window).polygon.is_rational());
    assert_eq!(curve(&window), original);
    window.get_by_label("vertex 1 weight");

    // A weight that cannot be is refused in its field.
    strike(&mut window, "-1");
    enter(&mut window);
    assert_eq!(curve(&window), original);
    window.get_by_label_contains("weights are positive numbers");
    assert!(window.state().editor().message().is_none());
    press(&mut window, Modifiers::NONE, Key::Escape);
}

#[test]
fn a_planar_curve_gets_heights() {
    for periodic in [false, true] {
        let polygon = wave(8, 3);
        let polygon = FloatPolygon::new(3, polygon.vertices().to_vec(), None, periodic);
        let mut window = table_of(vec![polygon.expect("a polygon")]);
        assert!(window.query_by_label("vertex 1 z").is_none());
        click(&mut window, "Column z");
        click(&mut window, "vertex 7 z");
        strike(&mut window, "0.5");
        enter(&mut window);
        assert_eq!(curve(&window).polygon.vertex(7).z, 0.5);
        assert!(!curve(&window).polygon.is_planar());
    }
}

#[test]
fn the_numbers_of_locked_and_hidden_curves_are_read_only_and_say_so() {
    let planar = wave(8, 3);
    let vertices = planar.vertices().iter().map(|at| *at + DVec3::Z);
    let rational = FloatPolygon::new(3, vertices.collect(), Some(vec![2.0; 8]), false);
    for (switch, words) in [("Locked", "is locked"), ("Visible", "is hidden")] {
        let mut window = window_of(vec![rational.clone().expect("a polygon")]);
        click(&mut window, switch);
        show_vertices(&mut window);
        let before = state(&window);
        for field in ["vertex 1 x", "vertex 2 z", "vertex 3 weight"] {
            click(&mut window, field);
            strike(&mut window, "7");
            enter(&mut window);
            assert_eq!(state(&window), before);
            let at = window.get_by_label(field).rect().center();
            drag(&mut window, at, at + vec2(40.0, 0.0));
            assert_eq!(state(&window), before);
        }
        click(&mut window, "vertex 1 x");
        strike(&mut window, "7");
        window.get_by_label_contains(words);
        // Reading goes on.
        press(&mut window, Modifiers::NONE, Key::ArrowDown);
        assert!(window.query_by_label_contains(words).is_none());
    }
}

#[test]
fn what_is_no_number_is_refused_beside_its_field() {
    let mut window = table_of(vec![wave(8, 3)]);
    let before = state(&window);
    // Enter keeps the text to be changed.
    click(&mut window, "vertex 1 x");
    strike(&mut window, "1.2.3");
    enter(&mut window);
    window.get_by_label_contains("Column 4: expected an operator or the end, found “.”");
    press(&mut window, Modifiers::NONE, Key::Backspace);
    press(&mut window, Modifiers::NONE, Key::Backspace);
    enter(&mut window);
    assert_eq!(x(&window, 1), 1.2);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(state(&window), before);

    // Leaving says that the old number stays.
    strike(&mut window, "4-");
    click(&mut window, "Canvas");
    window.get_by_label_contains("“4-”, column 3: expected a number");
    assert_eq!(state(&window), before);
    show_inspector(&mut window);
    click(&mut window, "Degree");
    type_over(&mut window, "26");
    enter(&mut window);
    window.get_by_label_contains("Only numbers from 1 to 7");
    click(&mut window, "Name");
    window.get_by_label_contains("Only numbers from 1 to 7: 3 stays");
    assert_eq!(curve(&window).polygon.degree(), 3);
}

#[test]
fn an_edit_moves_no_number_in_the_window() {
    let mut window = table_of(vec![wave(8, 3)]);
    let places = |window: &Window| {
        let fields = ["vertex 0 x", "vertex 3 y", "vertex 7 y"];
        fields.map(|label| window.get_by_label(label).rect())
    };
    let before = places(&window);
    let features = |window: &Window| {
        let report = window.state().editor().sight().features();
        report.map(|report| report.rows.len())
    };
    let count = features(&window);
    click(&mut window, "vertex 3 y");
    strike(&mut window, "-40.123456");
    enter(&mut window);
    click(&mut window, "Canvas");
    assert_ne!(features(&window), count);
    assert_eq!(places(&window), before);
}
