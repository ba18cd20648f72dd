//! A layout that stands still: nothing in the window moves while something is dragged, and the canvas
//! keeps its size.

use std::collections::{BTreeSet, HashMap};

use batten::document::{Curve, Document};
use batten::editor::{Editor, ToolKind};
use eframe::egui::{Event, Key, Modifiers, Pos2, Rect, Style, pos2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;
use crate::numbers::{click_events, enter, in_one_frame, stroke, wave};

/// A name of which a row shows only a part.
const LONG: &str =
    "Sheer strake, starboard side, frames 12 to 48, third revision after the tank test";

/// Texts and rectangles by identity.
type Places = HashMap<String, (String, Rect)>;

/// Where everything is that has a name, a text or an edge to be dragged, by its identity: its text and
/// its rectangle.
fn places(window: &Window) -> Places {
    let root = window.root();
    let named = root.children_recursive().filter_map(|node| {
        let node = node.accesskit_node();
        let text = node.label().or_else(|| node.value());
        let is_edge = format!("{:?}", node.role()) == "Splitter";
        let text = text.or_else(|| is_edge.then(String::new))?;
        let place = node.bounding_box()?;
        let [min, max] = [(place.x0, place.y0), (place.x1, place.y1)];
        let [min, max] = [min, max].map(|(x, y)| pos2(x as f32, y as f32));
        Some((format!("{:?}", node.id()), (text, Rect { min, max })))
    });
    named.collect()
}

/// Whether something may come and go, if nothing else moves by it: features, the monotone pieces that
/// end the inspector, what a plot says of its edge, and check marks.
fn comes_and_goes(text: &str) -> bool {
    let is_icon = text.chars().count() == 1 && !text.is_ascii();
    let parts = [" at u ", "slope α ", "beyond the plot"];
    is_icon || parts.iter().any(|part| text.contains(part))
}

fn check_still(before: &Places, after: &Places) {
    for (id, (text, place)) in before {
        let Some((now, moved)) = after.get(id) else {
            check_other(after, text, *place);
            continue;
        };
        // A text that changes may get another length; the chip is flush right.
        let keeps_left = now != text && place.min == moved.min;
        let keeps_right = (now != text || text == "Verdict")
            && (place.right(), place.top()) == (moved.right(), moved.top());
        let is_still =
            place == moved || ((keeps_left || keeps_right) && place.height() == moved.height());
        assert!(
            is_still,
            "{text:?} was at {place:?}, {now:?} is at {moved:?}"
        );
    }
    for (id, (text, place)) in after {
        if !before.contains_key(id) {
            check_other(before, text, *place);
        }
    }
}

/// What is there at one time only may come and go, or has another identity at the same place.
fn check_other(others: &Places, text: &str, place: Rect) {
    let mut others = others.values();
    let is_there = others.any(|(other, at)| other == text && *at == place);
    let may_go = comes_and_goes(text) || is_there;
    assert!(may_go, "{text:?} at {place:?} comes or goes");
}

/// Drag from a place along a way, and check after every step that nothing has moved. Returns what was
/// seen at each of them.
fn drag_still<T>(
    window: &mut Window,
    from: Pos2,
    way: impl Iterator<Item = Pos2>,
    mut seen: impl FnMut(&Window) -> T,
) -> Vec<T> {
    // No tooltip is wanted here.
    let never = |style: &mut Style| style.interaction.tooltip_delay = f32::INFINITY;
    window.ctx.all_styles_mut(never);
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    let mut before = None;
    let mut all = Vec::new();
    let mut last = from;
    for at in way {
        window.event(Event::PointerMoved(at));
        window.step();
        let now = places(window);
        match &before {
            None => before = Some(now),
            Some(before) => check_still(before, &now),
        }
        all.push(seen(window));
        last = at;
    }
    window.drop_at(last);
    window.run();
    all
}

/// A window with curves that have long names.
fn window_of_curves(count: usize, size: [f32; 2]) -> Window {
    let curves = (0..count).map(|index| Curve::new(format!("{LONG} {index}"), wave(8, 3)));
    let editor = Editor::with_document(Document::from_curves(curves));
    open_window_with(editor, size[0], size[1])
}

/// Drag a vertex up and down, far enough for features to come and go.
fn drag_vertex(window: &mut Window) {
    let from = vertex(window, 3);
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    let heights = [0.0, 0.3, 0.6, 0.9, 0.75, 0.5, 0.35, 0.15, 0.45];
    let top = canvas.top() + 60.0;
    let way = heights.map(|share| pos2(from.x + 8.0, top + share * (canvas.bottom() - top - 20.0)));
    let counts = drag_still(window, from, way.into_iter(), |window| {
        let report = window.state().editor().sight().features();
        report.map_or(0, |report| report.rows.len())
    });
    let different: BTreeSet<usize> = counts.iter().copied().collect();
    assert!(
        different.len() >= 2,
        "the features stay the same: {counts:?}"
    );
    press(window, Modifiers::COMMAND, Key::Z);
}

#[test]
fn nothing_moves_while_a_vertex_is_dragged_through_changes_of_its_features() {
    for (count, size) in [(1, [1000.0, 700.0]), (12, [1480.0, 920.0])] {
        let mut window = window_of_curves(count, size);
        drag_vertex(&mut window);
        // In a small window it lies below what is in sight.
        window.get_by_label("Harmony").scroll_to_me();
        window.run();
        click(&mut window, "Harmony");
        click(&mut window, "Harmony strips");
        drag_vertex(&mut window);
        show_vertices(&mut window);
        click(&mut window, "κ level 2");
        drag_vertex(&mut window);
    }
}

#[test]
fn nothing_moves_while_the_target_of_an_end_is_dragged() {
    let mut window = window_of_curves(2, [1000.0, 700.0]);
    press(&mut window, Modifiers::NONE, Key::E);
    click(&mut window, "Use current end");
    let field = window.get_by_label("target y").rect().center();
    let way = (1..8).map(|step| field + vec2(6.0 * step as f32, 0.0));
    let lengths = drag_still(&mut window, field, way, |window| {
        let told = window.get_by_label_contains("target y");
        told.value().unwrap_or_default()
    });
    assert!(lengths.first() != lengths.last(), "{lengths:?}");
}

#[test]
fn nothing_moves_while_a_number_of_an_operation_is_dragged() {
    let mut window = window_of_curves(2, [1480.0, 920.0]);
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("Mineur–Farin curve".to_owned()));
    window.run();
    enter(&mut window);
    let field = window.get_by_label("Length ratio s").rect().center();
    for sense in [1.0, -1.0] {
        let way = (1..16).map(|step| field + vec2(sense * 6.0 * step as f32, 0.0));
        let told = drag_still(&mut window, field, way, |window| {
            let told = window.get_by_label_contains("Monotone: ");
            let told = told.accesskit_node();
            told.label().or_else(|| told.value()).unwrap_or_default()
        });
        assert!(told.iter().all(|told| !told.is_empty()));
    }
    assert!(window.state().editor().previewed_operation().is_some());
}

#[test]
fn the_canvas_keeps_its_size_whatever_is_selected_and_done() {
    let mut window = window_of_curves(3, [1000.0, 700.0]);
    let canvas = window.state().canvas_rect();
    let side = window.get_by_label("Curves").rect();
    let check = |window: &Window| {
        assert_eq!(window.state().canvas_rect(), canvas);
        assert_eq!(window.get_by_label("Curves").rect(), side);
    };
    for tool in ToolKind::ALL {
        let letter = Key::from_name(&tool.key().to_uppercase().to_string());
        press(&mut window, Modifiers::NONE, letter.expect("a letter"));
        check(&window);
    }
    press(&mut window, Modifiers::NONE, Key::V);
    press(&mut window, Modifiers::COMMAND, Key::A);
    check(&window);
    show_vertices(&mut window);
    check(&window);
    for operation in ["Split curve", "Approximate", "Mineur–Farin curve"] {
        press(&mut window, Modifiers::COMMAND, Key::P);
        window.event(Event::Text(operation.to_owned()));
        window.run();
        enter(&mut window);
        check(&window);
        press(&mut window, Modifiers::NONE, Key::Escape);
        press(&mut window, Modifiers::NONE, Key::V);
    }
    choose(&mut window, &["Edit", "Select all"]);
    press(&mut window, Modifiers::COMMAND, Key::Delete);
    check(&window);
}

#[test]
fn layers_and_the_comb_are_in_sight_in_a_small_window_and_tell_their_keys() {
    let mut window = window_of_curves(1, [1000.0, 700.0]);
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    for label in ["Evolute", "Safe region", "Comb scale", "Comb density"] {
        let place = window.get_by_label(label).rect();
        assert!(canvas.contains_rect(place), "{label}: {place:?}");
    }
    // The degree gives way to the hint: the inspector tells it.
    window.get_by_label_contains("scale ");
    window.get_by_label("Live harmony");
    window.hover_at(window.get_by_label("Evolute").rect().center());
    window.run_steps(60);
    window.get_by_label_contains("Evolute (4)");
    let draw = ToolKind::Draw.label();
    let rail = window.get_by_label(draw).rect();
    window.hover_at(rail.center());
    window.run_steps(60);
    let tooltip = window.get_by_label_contains(&format!("{draw} (D)")).rect();
    assert!(tooltip.left() >= rail.right(), "{tooltip:?}");
}

#[test]
fn a_curve_is_renamed_in_its_row_and_keys_are_its_names() {
    let mut window = window_of_curves(2, [1000.0, 700.0]);
    let row = format!("curve {LONG} 0");
    let name = |window: &Window| curve(window).name;
    let at = window.get_by_label(&row).rect().left_center() + vec2(60.0, 0.0);
    // All of a long name is told on hovering.
    window.hover_at(at);
    window.run_steps(60);
    window.get_by_label(&format!("{LONG} 0"));

    let mut events = click_events(at);
    events.extend(click_events(at));
    events.extend(stroke(Key::D, "d"));
    in_one_frame(&mut window, events);
    window.run();
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Select);
    for (key, text) in [
        (Key::X, "x"),
        (Key::Num4, "4"),
        (Key::Space, " "),
        (Key::K, "k"),
    ] {
        for event in stroke(key, text) {
            window.event(event);
        }
        window.run();
    }
    enter(&mut window);
    assert_eq!(name(&window), "dx4 k");
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Select);

    // F2 renames wherever the pointer is, but for a field of text.
    let canvas = window.state().canvas_rect().expect("a canvas");
    window.hover_at(canvas.center());
    window.run();
    let view = window.state().editor().view().viewport().orientation;
    press(&mut window, Modifiers::NONE, Key::F2);
    window.event(Event::Text("bow".to_owned()));
    window.run();
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(name(&window), "dx4 k", "Esc keeps the old name");
    press(&mut window, Modifiers::NONE, Key::F2);
    window.event(Event::Text("bow".to_owned()));
    window.run();
    enter(&mut window);
    assert_eq!(name(&window), "bow");
    click(&mut window, "Name");
    press(&mut window, Modifiers::NONE, Key::F2);
    assert!(window.query_by_label("Curve name").is_none());
    press(&mut window, Modifiers::NONE, Key::Escape);
    let turned = window.state().editor().view().viewport().orientation;
    assert_eq!(turned, view);
}

#[test]
fn everything_about_an_end_fits_into_the_panel() {
    for size in [[1000.0, 1100.0], [1480.0, 1100.0]] {
        let mut window = window_of_curves(2, size);
        press(&mut window, Modifiers::NONE, Key::E);
        click(&mut window, "Use current end");
        let tab = window.get_by_label("Tool").rect();
        for name in [
            "Require direction",
            "Translate terminal vertices",
            "Rotate terminal vertices",
        ] {
            let control = window.get_by_label(name).rect();
            assert!(control.right() <= tab.right(), "{name}: {control}, {tab}");
        }
    }
}
