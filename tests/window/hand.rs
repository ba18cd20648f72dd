//! A hand for the window: it finds widgets by their labels, and presses, drags and types.

use std::path::Path;

use batten::document::Curve;
use batten::editor::Editor;
use batten::ui::App;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec2;

pub type Window = Harness<'static, App>;

pub fn open_window() -> Window {
    open_window_of(1480.0, 920.0)
}

pub fn open_window_of(width: f32, height: f32) -> Window {
    let mut editor = Editor::default();
    editor.open_example(0).expect("the arc");
    editor.dismiss_message();
    open_window_with(editor, width, height)
}

pub fn open_window_with(editor: Editor, width: f32, height: f32) -> Window {
    let builder = Harness::builder()
        .with_size(vec2(width, height))
        .with_max_steps(64);
    let mut window =
        builder.build_eframe(|creation| App::new(&creation.egui_ctx, None, false, editor));
    window.run();
    window
}

pub fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run();
}

/// Put the table of vertices in front in the side panel.
pub fn show_vertices(window: &mut Window) {
    window.get_by_label_contains("Vertices (").click();
    window.run();
}

/// Put the inspector in front in the side panel.
pub fn show_inspector(window: &mut Window) {
    click(window, "Inspector");
}

pub fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run();
}

/// Open a menu and choose an entry, through a submenu if need be.
pub fn choose(window: &mut Window, path: &[&str]) {
    for label in path {
        click(window, label);
    }
}

pub fn curve(window: &Window) -> Curve {
    let editor = window.state().editor();
    let active = editor.active().expect("a curve is active");
    Curve::clone(
        editor
            .document()
            .curve(active)
            .expect("the active curve is there"),
    )
}

/// Where a point of the model is in the window.
pub fn place(window: &Window, point: DVec2) -> Pos2 {
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    let at = window.state().editor().view().viewport().to_screen(point);
    canvas.min + vec2(at.x as f32, at.y as f32)
}

pub fn vertex(window: &Window, index: usize) -> Pos2 {
    place(window, curve(window).polygon.vertex(index).truncate())
}

pub fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    window.hover_at(to);
    window.step();
    window.drop_at(to);
    window.run();
}

/// Put a text into the field that has the keyboard, in place of what it holds.
pub fn type_over(window: &mut Window, text: &str) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run();
    window.event(Event::Text(text.to_owned()));
    window.run();
}

/// Answer the window's own prompt for a path.
pub fn answer(window: &mut Window, path: &Path) {
    click(window, "Path");
    type_over(window, &path.to_string_lossy());
    press(window, Modifiers::NONE, Key::Enter);
}

pub fn double_click(window: &mut Window, at: Pos2) {
    // A step of the test takes longer than a hand does.
    window
        .ctx
        .options_mut(|options| options.input_options.max_double_click_delay = 2.0);
    window.hover_at(at);
    // What was clicked before is long ago.
    for _ in 0..12 {
        window.step();
    }
    for pressed in [true, false, true, false] {
        window.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.step();
    }
    window.run();
    window.run();
}

/// Click with the second button.
pub fn right_click(window: &mut Window, at: Pos2) {
    window.hover_at(at);
    window.run();
    for pressed in [true, false] {
        window.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.step();
    }
    window.run();
}

/// Choose an entry of the menu: it is shown above everything else of that name.
pub fn pick(window: &mut Window, label: &str) {
    let entries: Vec<Pos2> = window
        .query_all_by_label(label)
        .map(|entry| entry.rect().center())
        .collect();
    let at = *entries.last().expect("an entry");
    drag(window, at, at);
}
