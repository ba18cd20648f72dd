//! The window, driven through the labels that a screen reader reads: no display, no renderer.
#![cfg(feature = "gui")]

mod canvas;
mod crowds;
mod drawing;
#[path = "../common/drawings.rs"]
mod drawings;
mod editing;
mod exporting;
mod expressions;
mod fields;
mod files;
mod fitting;
mod generating;
mod grouping;
mod hand;
mod harmony;
mod help;
mod importing;
mod inspecting;
mod list;
mod locking;
mod matching;
mod menus;
mod numbers;
mod operations;
mod paper;
mod plots;
mod recovery;
mod references;
mod stillness;

use batten::editor::{Layer, ToolKind};
use batten::geometry::End;
use batten::io::disk;
use eframe::egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, TouchPhase, vec2};
use egui_kittest::kittest::Queryable;
use glam::DVec2;

use crate::hand::*;

#[test]
fn everything_is_in_its_place() {
    let mut window = open_window();
    for label in [
        "File",
        "Edit",
        "View",
        "Tools",
        "Help",
        "Canvas",
        "Curves",
        "Inspector",
        "Name",
        "Degree",
        "Features",
        "Comb scale",
        "Comb density",
        "Harmony strips",
    ] {
        window.get_by_label(label);
    }
    for tool in ToolKind::ALL {
        window.get_by_label(tool.label());
    }
    for layer in Layer::ALL {
        assert!(
            window.query_all_by_label(layer.label()).count() > 0,
            "{layer:?}"
        );
    }
    show_vertices(&mut window);
    for label in ["vertex 0", "vertex 0 x", "vertex 0 y"] {
        window.get_by_label(label);
    }
}

#[test]
fn the_main_job_through_the_window() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Ninth-degree arc"]);
    let original = curve(&window);
    assert_eq!(original.polygon.degree(), 9);

    let from = vertex(&window, 5);
    drag(&mut window, from, from + vec2(40.0, -30.0));
    let dragged = curve(&window);
    let scale = window.state().editor().view().viewport().scale;
    let moved = dragged.polygon.vertex(5) - original.polygon.vertex(5);
    let expected = DVec2::new(40.0, 30.0) / scale;
    assert!(moved.truncate().distance(expected) < 1e-4, "{moved}");
    assert!(window.state().editor().workspace().is_modified());

    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), original, "undo is exact");
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(curve(&window), dragged, "redo is exact");

    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("dragged.batten");
    press(&mut window, Modifiers::COMMAND, Key::S);
    answer(&mut window, &path);
    assert!(!window.state().editor().workspace().is_modified());
    let saved = disk::read_file(&path).expect("the saved file").curves;
    assert_eq!(saved[0].polygon, dragged.polygon, "numbers survive exactly");

    let path = folder.path().join("dragged.dxf");
    choose(&mut window, &["File", "Export as", "Export DXF…"]);
    click(&mut window, "Export…");
    answer(&mut window, &path);
    let drawing = std::fs::read_to_string(&path).expect("the export");
    assert!(drawing.contains("SPLINE"));
}

#[test]
fn an_end_is_corrected_by_the_panels_buttons() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    let original = curve(&window);
    let count = original.polygon.vertices().len();
    assert!(
        count >= 2 * original.polygon.degree(),
        "one pass is exact on the waterline"
    );
    click(&mut window, "End fit");
    click(&mut window, "Use current end");
    let target = original.polygon.end_jet(End::Finish).point;
    click(&mut window, "target y");
    type_over(&mut window, &format!("{}", target.y + 3.0));
    press(&mut window, Modifiers::NONE, Key::Enter);
    let wanted = curve(&window).targets.get(End::Finish).expect("a target");
    assert_eq!(
        wanted.point.y,
        target.y + 3.0,
        "a typed number is taken exactly"
    );

    click(&mut window, "Translate terminal vertices");
    let corrected = curve(&window).polygon.end_jet(End::Finish).point;
    assert!(corrected.distance(wanted.point) < 1e-12 * original.polygon.size());

    click(&mut window, "target direction");
    type_over(&mut window, "5");
    press(&mut window, Modifiers::NONE, Key::Enter);
    click(&mut window, "Rotate terminal vertices");
    let tangent = curve(&window)
        .polygon
        .end_jet(End::Finish)
        .tangent()
        .expect("a tangent");
    let degrees = tangent.truncate().to_angle().to_degrees();
    assert!((degrees - 5.0).abs() < 1e-9, "{degrees}");

    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window).polygon, original.polygon);
}

#[test]
fn the_arc_is_corrected_at_both_ends_at_once() {
    let mut window = open_window();
    let original = curve(&window);
    press(&mut window, Modifiers::NONE, Key::E);
    click(&mut window, "Start");
    click(&mut window, "Use current end");
    click(&mut window, "End");
    click(&mut window, "Use current end");
    click(&mut window, "target x");
    let target = original.polygon.end_jet(End::Finish).point;
    type_over(&mut window, &format!("{}", target.x + 0.5));
    press(&mut window, Modifiers::NONE, Key::Enter);
    click(&mut window, "Repeat");
    assert_eq!(
        curve(&window).polygon,
        original.polygon,
        "what does not converge changes nothing"
    );
    click(&mut window, "Both ends at once");
    let end = curve(&window).polygon.end_jet(End::Finish).point;
    assert!(
        (end.x - target.x - 0.5).abs() < 1e-12 * original.polygon.size(),
        "{end}"
    );
    assert!(window.query_all_by_label_contains("Largest move").count() > 0);
    // What the solve leaves is rounding.
    window.get_by_label("Length: 0");
    window.get_by_label("Remaining error: 0  0.0000°");
}

#[test]
fn coordinates_are_typed_and_dragged_in_the_table() {
    let mut window = open_window();
    show_vertices(&mut window);
    let original = curve(&window);
    click(&mut window, "vertex 3 x");
    type_over(&mut window, "1.25");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(curve(&window).polygon.vertex(3).x, 1.25);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), original);

    // Leaving a field as it was changes nothing, though it shows fewer digits than there are.
    click(&mut window, "vertex 3 x");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(!window.state().editor().workspace().is_modified());

    // What cannot be read changes nothing either.
    click(&mut window, "vertex 3 x");
    type_over(&mut window, "one");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(!window.state().editor().workspace().is_modified());

    let field = window.get_by_label("vertex 3 y").rect().center();
    drag(&mut window, field, field + vec2(30.0, 0.0));
    let dragged = curve(&window).polygon.vertex(3).y;
    assert!(dragged > original.polygon.vertex(3).y, "{dragged}");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), original, "a dragged field is one step");
}

#[test]
fn escape_calls_a_dragged_field_off() {
    let mut window = open_window();
    show_vertices(&mut window);
    let original = curve(&window);
    let field = window.get_by_label("vertex 3 y").rect().center();
    window.hover_at(field);
    window.run();
    window.drag_at(field);
    window.step();
    window.hover_at(field + vec2(30.0, 0.0));
    window.step();
    assert_ne!(curve(&window), original, "the drag is previewed");
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.hover_at(field + vec2(60.0, 0.0));
    window.step();
    window.drop_at(field + vec2(60.0, 0.0));
    window.run();
    assert_eq!(curve(&window), original);
    assert!(!window.state().editor().workspace().is_modified());
}

#[test]
fn degree_name_and_ends_are_changed_in_the_inspector() {
    let mut window = open_window();
    let polygon = curve(&window).polygon;
    window
        .get_all_by_label("Degree 8, keep polygon")
        .next()
        .expect("the button")
        .click();
    window.run();
    assert_eq!(curve(&window).polygon.degree(), 8);
    assert_eq!(
        curve(&window).polygon.vertices(),
        polygon.vertices(),
        "the polygon is kept"
    );
    click(&mut window, "Name");
    type_over(&mut window, "sheer");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(curve(&window).name, "sheer");
    click(&mut window, "Periodic");
    assert!(curve(&window).polygon.is_periodic());
    click(&mut window, "Locked");
    assert!(curve(&window).locked);
}

#[test]
fn letters_are_typed_into_fields_and_are_commands_elsewhere() {
    let mut window = open_window();
    click(&mut window, "Name");
    press(&mut window, Modifiers::NONE, Key::D);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Select);
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::NONE, Key::D);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Draw);

    // Esc in a field is the field's alone: the tool stays in the hand.
    press(&mut window, Modifiers::NONE, Key::M);
    click(&mut window, "Name");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Measure);
    press(&mut window, Modifiers::COMMAND, Key::P);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Measure);
}

#[test]
fn what_a_plot_marks_goes_with_the_plot() {
    let mut window = open_window();
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    let on_plot = canvas.center_bottom() + vec2(0.0, 120.0);
    window.hover_at(on_plot);
    window.run();
    let hovered = |window: &Window| window.state().editor().sight().readout().parameter;
    assert!(hovered(&window).is_some_and(|u| 0.0 < u && u < 1.0));
    press(&mut window, Modifiers::NONE, Key::F8);
    window.hover_at(canvas.center_top() + vec2(0.0, 20.0));
    window.run();
    assert_eq!(hovered(&window), None);
}

#[test]
fn an_axis_key_held_before_a_drag_steers_it_and_keeps_the_tool() {
    let mut window = open_window();
    let before = curve(&window).polygon.vertex(4);
    let from = vertex(&window, 4);
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.key_down(Key::X);
    window.run();
    drag(&mut window, from, from + vec2(40.0, 30.0));
    window.key_up(Key::X);
    window.run();
    let after = curve(&window).polygon.vertex(4);
    assert!(after.x > before.x && after.y == before.y, "{after}");
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Select);
    // Without a drag the key chooses its tool, and the next drag is free again.
    press(&mut window, Modifiers::NONE, Key::X);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Delete);
    press(&mut window, Modifiers::NONE, Key::V);
    let from = vertex(&window, 4);
    drag(&mut window, from, from + vec2(0.0, 30.0));
    assert_ne!(curve(&window).polygon.vertex(4).y, before.y);
}

#[test]
fn the_wheel_zooms_to_the_pointer_and_the_middle_button_pans() {
    let mut window = open_window();
    let at = vertex(&window, 2);
    let before = window.state().editor().view().viewport().scale;
    window.hover_at(at);
    window.run();
    window.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, 2.0),
        phase: TouchPhase::Move,
        source: eframe::egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    window.run();
    assert!(window.state().editor().view().viewport().scale > 1.2 * before);
    assert!(
        vertex(&window, 2).distance(at) < 0.1,
        "the place under the pointer stays"
    );

    let from = at + vec2(60.0, 90.0);
    let by = vec2(25.0, 10.0);
    for (pos, pressed) in [(from, true), (from + by, false)] {
        window.event(Event::PointerMoved(pos));
        let button = PointerButton::Middle;
        window.event(Event::PointerButton {
            pos,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.run();
    }
    assert!(vertex(&window, 2).distance(at + by) < 0.1);
}

#[test]
fn the_palette_finds_commands() {
    let mut window = open_window();
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("comb".to_owned()));
    window.run();
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.state().editor().sight().layers().shows(Layer::Comb));
    window.get_by_label("Comb scale");
    window.get_by_label("Comb density");

    // No name has these words, a tooltip does.
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("raise degree".to_owned()));
    window.run();
    let found = window.query_all_by_label_contains("Elevate degree").count();
    assert!(found > 0);
    press(&mut window, Modifiers::NONE, Key::Escape);

    // What cannot be done says why, after what can, and Enter leaves the list open.
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("fit points".to_owned()));
    window.run();
    window.get_by_label_contains("Unavailable:");
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.get_by_label("Find a command");
}

#[test]
fn every_panel_and_dialog_has_names_in_both_themes_and_when_it_is_small() {
    for size in [(1480.0, 920.0), (960.0, 640.0)] {
        let mut window = open_window_of(size.0, size.1);
        for _ in 0..2 {
            for tool in ToolKind::ALL {
                let letter = Key::from_name(&tool.key().to_uppercase().to_string());
                press(&mut window, Modifiers::NONE, letter.expect("a letter"));
                assert_eq!(window.state().editor().hand().tool(), tool);
            }
            click(&mut window, "Use current end");
            press(&mut window, Modifiers::NONE, Key::V);
            for tab in ["Harmony strips", "κ level 2", "Log graph", "Curvature"] {
                click(&mut window, tab);
            }
            click(&mut window, "Verdict");
            for operation in ["Split curve", "Trim curve", "Round coordinates"] {
                press(&mut window, Modifiers::COMMAND, Key::P);
                window.event(Event::Text(operation.to_owned()));
                window.run();
                press(&mut window, Modifiers::NONE, Key::Enter);
                click(&mut window, "Cancel");
            }
            press(&mut window, Modifiers::NONE, Key::F8);
            press(&mut window, Modifiers::NONE, Key::F8);
            let canvas = window.state().canvas_rect().expect("a canvas");
            window.hover_at(canvas.center());
            press(&mut window, Modifiers::NONE, Key::F1);
            click(&mut window, "Close");
            click(&mut window, "Help");
            click(&mut window, "About Batten");
            click(&mut window, "Close");
            for menu in ["File", "Edit", "View", "Tools", "Help"] {
                click(&mut window, menu);
                press(&mut window, Modifiers::NONE, Key::Escape);
            }
            press(&mut window, Modifiers::NONE, Key::F9);
        }
    }
}

#[test]
fn an_empty_document_says_what_to_do() {
    let mut window = open_window();
    choose(&mut window, &["File", "New"]);
    window.get_by_label("Nothing here yet");
    for tool in ToolKind::ALL {
        let letter = Key::from_name(&tool.key().to_uppercase().to_string());
        press(&mut window, Modifiers::NONE, letter.expect("a letter"));
    }
}

#[test]
fn nothing_is_painted_anew_when_nothing_happens() {
    let mut window = open_window();
    window.hover_at(vertex(&window, 4));
    window.run();
    let steps = window.run();
    assert!(steps <= 2, "{steps} frames for nothing");
}

#[test]
fn the_key_that_keeps_features_steers_a_drag_and_is_a_switch_otherwise() {
    let mut window = open_window();
    let keeps = |window: &Window| window.state().editor().hand().keeps_features();
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.key_down(Key::K);
    window.run();
    assert!(keeps(&window));
    let before = curve(&window);
    let from = vertex(&window, 4);
    drag(&mut window, from, from + vec2(120.0, 90.0));
    let extrema = |curve: &batten::document::Curve| {
        let features = batten::geometry::features::Features::new(&curve.polygon);
        features.curvature_extrema.len() + features.inflections.len()
    };
    assert!(extrema(&curve(&window)) <= extrema(&before));
    window.key_up(Key::K);
    window.run();
    assert!(!keeps(&window), "the drag took the key");
    press(&mut window, Modifiers::NONE, Key::K);
    assert!(keeps(&window));
    press(&mut window, Modifiers::NONE, Key::K);
    assert!(!keeps(&window));
}

#[test]
fn choosing_a_feature_in_the_list_shows_how_to_lose_it() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "S-curve"]);
    let row = window
        .query_all_by_label_contains("κ maximum, ")
        .next()
        .expect("a row");
    row.click();
    window.run();
    assert!(window.state().editor().view().chosen_feature().is_some());
    let guides = &window.state().editor().view().scene().guides;
    assert!(!guides.arrows.is_empty(), "{:?}", guides.labels);
}
