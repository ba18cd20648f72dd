//! The main job in the real window: open the arc, drag a vertex, correct an end, undo, redo, save,
//! export; the files are checked in numbers.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Result, ensure};
use batten::document::Curve;
use batten::geometry::end_correction::EndDifference;
use batten::geometry::{ClampedPolygon, End};
use batten::io::disk;
use batten_desktop_tests::arc::{self, arc, correct_an_end, fitted, place};
use batten_desktop_tests::{Display, Window};
use egui::{Key, Modifiers, Pos2, vec2};
use glam::DVec3;

/// A share of the curve's size: more than the canvas's single-precision places are off.
const PLACE_TOLERANCE: f64 = 1e-5;

/// What an end correction leaves, in units of the curve's size.
const CORRECTION_TOLERANCE: f64 = 1e-12;

#[test]
fn the_main_job_end_to_end() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let mut window = Window::open(&mut display, &[], 1.0)?;
    window.resize(1480, 920)?;
    arc::open(&mut window)?;
    window.key(Key::H, Modifiers::NONE)?;
    let canvas = window.find("Canvas")?;
    let original = arc();

    // Drag a vertex by 40 points to the right and 25 down.
    let way = vec2(40.0, 25.0);
    let from = place(canvas, &original, 9);
    window.drag(from, from + way)?;
    let dragged = saved(&mut window, "dragged")?;
    let scale = fitted(canvas).view().viewport().scale;
    let expected = original.vertex(9) + DVec3::new(40.0, -25.0, 0.0) / scale;
    let off = dragged.polygon.vertex(9).distance(expected);
    ensure!(
        off < PLACE_TOLERANCE * original.size(),
        "the vertex is {off} off"
    );
    for index in 0..9 {
        ensure!(
            dragged.polygon.vertex(index) == original.vertex(index),
            "vertex {index} moved"
        );
    }

    // Undo and redo are exact.
    window.key(Key::Z, Modifiers::COMMAND)?;
    let undone = saved(&mut window, "undone")?;
    ensure!(undone.polygon == original, "undo is not exact");
    window.key(Key::Z, Modifiers::COMMAND | Modifiers::SHIFT)?;
    let redone = saved(&mut window, "redone")?;
    ensure!(redone.polygon == dragged.polygon, "redo is not exact");
    window.key(Key::Z, Modifiers::COMMAND)?;

    correct_an_end(&mut window, canvas)?;
    let corrected = saved(&mut window, "corrected")?;
    let target = corrected
        .targets
        .get(End::Finish)
        .context("the target is saved")?;
    let difference = EndDifference::between(&corrected.polygon, End::Finish, &target);
    let left = difference.residual(original.size());
    ensure!(
        left < CORRECTION_TOLERANCE * original.size(),
        "{left} is left"
    );
    ensure!(corrected.polygon != original, "nothing was corrected");

    // Undo takes the correction back, redo makes it again.
    window.key(Key::Z, Modifiers::COMMAND)?;
    ensure!(
        saved(&mut window, "uncorrected")?.polygon == original,
        "undo is not exact"
    );
    window.key(Key::Z, Modifiers::COMMAND | Modifiers::SHIFT)?;
    ensure!(
        saved(&mut window, "recorrected")?.polygon == corrected.polygon,
        "redo is not exact"
    );

    export(&mut window, &corrected)?;
    Ok(())
}

/// Export a drawing and look for the closed S-polygon's vertices in it, digit for digit.
fn export(window: &mut Window, curve: &Curve) -> Result<()> {
    let path = window.folder().join("arc.dxf");
    window.key(Key::E, Modifiers::COMMAND)?;
    window.find_beginning("Export…")?;
    window.key(Key::Enter, Modifiers::NONE)?;
    answer_prompt(window, &path)?;
    window.find_beginning("1 curve exported to")?;
    let drawing = std::fs::read_to_string(&path).context("the export")?;
    let clamped = ClampedPolygon::from_float(&curve.polygon);
    for vertex in clamped.vertices() {
        let lines = drawing
            .lines()
            .map(str::trim)
            .filter_map(|line| line.parse::<f64>().ok());
        ensure!(
            lines.into_iter().any(|number| number == vertex.x),
            "{} is missing",
            vertex.x
        );
    }
    Ok(())
}

#[test]
fn a_window_at_twice_the_scale_and_in_the_light_theme() -> Result<()> {
    let mut display = Display::start(3200, 2000)?;
    let mut window = Window::open(&mut display, &[], 2.0)?;
    window.resize(1480, 920)?;
    arc::open(&mut window)?;
    window.key(Key::H, Modifiers::NONE)?;
    window.key(Key::F9, Modifiers::NONE)?;
    let canvas = window.find("Canvas")?;
    let polygon = arc();
    window.move_to(place(canvas, &polygon, 4))?;
    window.find_beginning("Drag a vertex")?;
    Ok(())
}

#[test]
fn quitting_asks_about_unsaved_changes() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let mut window = Window::open(&mut display, &[], 1.0)?;
    arc::open(&mut window)?;
    let canvas = window.find("Canvas")?;
    let from = place(canvas, &arc(), 5);
    window.drag(from, from + vec2(30.0, 30.0))?;
    window.key(Key::Q, Modifiers::COMMAND)?;
    window.click("Cancel")?;
    ensure!(window.has("Canvas")?, "the window is gone");
    window.key(Key::Q, Modifiers::COMMAND)?;
    let discard = window.find_beginning("Discard")?.center();
    window.send_last(press_and_release(discard));
    ensure!(window.wait()?, "the program failed");
    Ok(())
}

#[test]
fn saving_with_the_button_held_writes_the_state_before_the_drag() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let mut window = Window::open(&mut display, &[], 1.0)?;
    arc::open(&mut window)?;
    let canvas = window.find("Canvas")?;
    saved(&mut window, "arc")?;
    let path = window.folder().join("arc.batten");
    std::fs::remove_file(&path)?;
    let original = arc();
    let from = place(canvas, &original, 5);
    window.hold(from, from + vec2(30.0, 30.0))?;
    window.key(Key::S, Modifiers::COMMAND)?;
    window.find_beginning("Saved to")?;
    let read = || -> Result<Arc<Curve>> {
        let curves = disk::read_file(&path)?.curves;
        curves.into_iter().next().context("the file has no curve")
    };
    ensure!(read()?.polygon == original, "the drag is saved");
    window.move_to(from + vec2(60.0, 10.0))?;
    window.release(from + vec2(60.0, 10.0))?;
    window.key(Key::S, Modifiers::COMMAND)?;
    window.find_beginning("Saved to")?;
    let moved = read()?.polygon.vertex(5) - original.vertex(5);
    let scale = fitted(canvas).view().viewport().scale;
    let off = (moved - DVec3::new(60.0, -10.0, 0.0) / scale).length();
    ensure!(
        off < PLACE_TOLERANCE * original.size(),
        "the drag has not gone on: {moved}"
    );
    Ok(())
}

/// Save under a new name and read the curve back.
fn saved(window: &mut Window, name: &str) -> Result<Arc<Curve>> {
    let path = window.folder().join(format!("{name}.batten"));
    window.key(Key::S, Modifiers::COMMAND | Modifiers::SHIFT)?;
    answer_prompt(window, &path)?;
    window.find_beginning(&format!("Saved to {}", path.display()))?;
    let curves = disk::read_file(&path)?.curves;
    curves.into_iter().next().context("the file has no curve")
}

/// Type a path into the prompt that takes over where no dialog service answers.
fn answer_prompt(window: &mut Window, path: &Path) -> Result<()> {
    let field = window.find("Path")?;
    window.click_at(field.center())?;
    window.key(Key::A, Modifiers::COMMAND)?;
    window.write(&path.to_string_lossy())?;
    window.key(Key::Enter, Modifiers::NONE)
}

fn press_and_release(place: Pos2) -> Vec<egui::Event> {
    let button = |pressed| egui::Event::PointerButton {
        pos: place,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    vec![
        egui::Event::PointerMoved(place),
        button(true),
        button(false),
    ]
}
