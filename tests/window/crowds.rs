//! What lies over what on the canvas, and views that fit the window.

use batten::editor::Editor;
use eframe::egui::epaint::{CircleShape, PathShape};
use eframe::egui::{Color32, Event, Key, Modifiers, Pos2, Shape, vec2};

use super::hand::*;

/// The colours of float polygon and curve in the dark theme.
const FLOAT: Color32 = Color32::from_rgb(0xF5, 0xA5, 0x24);
const CURVE: Color32 = Color32::from_rgb(0xF4, 0xF6, 0xFA);

fn example(name: &str) -> Window {
    let place = batten::io::examples::EXAMPLES
        .iter()
        .position(|example| example.name == name);
    let mut editor = Editor::default();
    editor
        .open_example(place.expect("an example"))
        .expect("its curves");
    editor.dismiss_message();
    open_window_with(editor, 1440.0, 900.0)
}

/// The shapes that are painted, from back to front.
fn shapes(window: &Window) -> Vec<Shape> {
    let clipped = window.output().shapes.iter();
    clipped.map(|clipped| clipped.shape.clone()).collect()
}

/// The places in the order of painting of the discs of a colour on the canvas, with their radii.
fn discs(window: &Window, colour: Color32) -> Vec<(usize, f32)> {
    let canvas = window.state().canvas_rect().expect("a canvas");
    let shapes = shapes(window).into_iter().enumerate();
    let disc = |(place, shape)| match shape {
        Shape::Circle(CircleShape {
            center,
            radius,
            fill,
            ..
        }) if fill == colour && canvas.contains(center) => Some((place, radius)),
        _ => None,
    };
    shapes.filter_map(disc).collect()
}

/// The place in the order of painting of the longest line of a colour.
fn line(window: &Window, colour: Color32) -> usize {
    let lines = shapes(window).into_iter().enumerate();
    let length = |(place, shape): (usize, Shape)| match shape {
        Shape::Path(PathShape { points, stroke, .. })
            if stroke.color == eframe::egui::epaint::ColorMode::Solid(colour) =>
        {
            Some((points.len(), place))
        }
        _ => None,
    };
    lines.filter_map(length).max().expect("a line").1
}

#[test]
fn the_curve_lies_on_discs_and_under_what_is_selected() {
    let mut window = example("bottle");
    let curve_at = line(&window, CURVE);
    let plain = discs(&window, FLOAT);
    assert!(plain.len() > 25, "{}", plain.len());
    assert!(plain.iter().all(|(place, _)| *place < curve_at));
    let at = vertex(&window, 20);
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run();
    window.event(Event::PointerGone);
    window.run();
    let curve_at = line(&window, CURVE);
    let (under, above): (Vec<_>, Vec<_>) = discs(&window, FLOAT)
        .into_iter()
        .partition(|(place, _)| *place < curve_at);
    assert_eq!(under.len(), plain.len() - 1, "all but the selected vertex");
    let largest = |discs: &[(usize, f32)]| discs.iter().fold(0.0, |most, it| it.1.max(most));
    assert!(largest(&above) > largest(&under));
}

#[test]
fn vertices_of_other_curves_are_smaller() {
    let mut window = open_window();
    let radii = |window: &Window, colour: Color32| -> Vec<f32> {
        let discs = discs(window, colour).into_iter();
        discs.map(|(_, radius)| radius).collect()
    };
    let before = radii(&window, FLOAT);
    assert!(before.iter().all(|radius| *radius == 4.0));
    press(&mut window, Modifiers::COMMAND, Key::D);
    window.event(Event::PointerGone);
    window.run();
    let faint = FLOAT.gamma_multiply(0.3);
    let others = radii(&window, faint);
    assert_eq!(others.len(), before.len());
    assert!(others.iter().all(|radius| *radius == 2.0));
}

#[test]
fn the_view_is_fitted_again_until_it_is_changed() {
    let middle = |window: &Window| -> (Pos2, f64) {
        let editor = window.state().editor();
        let vertices = editor.document().curves().flat_map(|(_, curve)| {
            let vertices = curve.polygon.vertices().iter();
            vertices
                .map(|vertex| place(window, vertex.truncate()))
                .collect::<Vec<_>>()
        });
        let mut around = eframe::egui::Rect::NOTHING;
        vertices.for_each(|at| around.extend_with(at));
        (around.center(), editor.view().viewport().scale)
    };
    let mut window = open_window_of(1000.0, 700.0);
    let (_, small) = middle(&window);
    window.set_size(vec2(1900.0, 1100.0));
    window.run();
    let (centre, large) = middle(&window);
    assert!(large > 1.4 * small, "{small} to {large}");
    let canvas = window.state().canvas_rect().expect("a canvas");
    assert!(canvas.center().distance(centre) < 60.0);

    choose(&mut window, &["View", "Zoom out"]);
    let (_, zoomed) = middle(&window);
    window.set_size(vec2(1000.0, 700.0));
    window.run();
    assert_eq!(middle(&window).1, zoomed, "whoever zooms keeps the scale");

    press(&mut window, Modifiers::NONE, Key::H);
    let (_, fitted) = middle(&window);
    // Below the switches of the layers.
    let at = vertex(&window, 8);
    drag(&mut window, at, at + vec2(20.0, 20.0));
    window.set_size(vec2(1900.0, 1100.0));
    window.run();
    assert_eq!(middle(&window).1, fitted, "and so does whoever edits");
}
