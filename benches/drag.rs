//! Drag one vertex of a degree-9 curve and redo all that is on screen: the document, the closed
//! S-polygon, the curve, the evolute, the comb, both plots and the panels' figures. The time must
//! hardly grow with the number of vertices.
//!
//! Then a curve whose features take a second and more for each step of the drag: they are proved
//! beside the frame, which waits no longer than it is told to.
//!
//! Last, drags with the safe region of the vertex on screen and with features kept: the largest of
//! many frames is printed, and no frame may take more than 8 ms.
#![allow(missing_docs)]

mod wavy;
mod winding;

use std::hint::black_box;
use std::time::{Duration, Instant};

use batten::document::{Curve, Document};
use batten::editor::{Button, Command, Editor, Input, Layer, Look, PlotKind};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::DVec2;
use wavy::wavy;
use winding::winding;

const CANVAS: DVec2 = DVec2::new(1200.0, 700.0);

/// How long the frame waits for features: as long as in the window.
const PATIENCE: Duration = Duration::from_millis(4);

/// An editor in the middle of a drag of the vertex in the middle of a curve.
fn dragging(document: Document, close: bool) -> (Editor, DVec2) {
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(CANVAS));
    editor.view_mut().plot = Some(PlotKind::CURVATURE);
    editor
        .execute(Command::ToggleLayer(Layer::Comb))
        .expect("a command");
    let curve = editor.active().expect("a curve");
    let polygon = &editor.document().curve(curve).expect("the curve").polygon;
    let count = polygon.vertices().len();
    let vertex = polygon.vertex(count / 2).truncate();
    if close {
        // A dozen legs across the canvas, around the vertex.
        let leg = polygon.vertex(count / 2 + 1).truncate().distance(vertex);
        let factor = CANVAS.x / (12.0 * leg) / editor.view().viewport().scale;
        let at = editor.view().viewport().to_screen(vertex);
        editor.input(Input::Zoomed { at, factor });
        let at = editor.view().viewport().to_screen(vertex);
        editor.input(Input::Panned {
            by: 0.5 * CANVAS - at,
        });
    }
    editor.refresh();
    let at = editor.view().viewport().to_screen(vertex);
    editor.select_vertex(curve, count / 2, false);
    editor.input(Input::Moved { at });
    editor.input(Input::Pressed {
        button: Button::Primary,
        at,
    });
    editor.input(Input::Moved { at: at + 10.0 });
    assert!(editor.hand().is_dragging());
    let before = editor.document().curve(curve).expect("the curve").clone();
    editor.input(Input::Moved { at: at + 20.0 });
    let after = editor.document().curve(curve).expect("the curve").clone();
    assert_ne!(
        before.polygon.vertex(count / 2),
        after.polygon.vertex(count / 2)
    );
    (editor, at)
}

/// One frame of the drag.
fn frame(editor: &mut Editor, at: DVec2) {
    editor.begin_frame();
    editor.input(Input::Moved { at });
    editor.refresh();
    // The chip and the list read the features.
    black_box(editor.sight().features());
    black_box(editor.sight().features());
    black_box(editor.view().plots());
    black_box(editor.sight().report());
    black_box(editor.sight().readout());
    black_box(editor.hint());
    // The canvas comes after the panels, which may have changed something.
    editor.refresh();
    black_box(editor.view().scene());
}

fn drag(criterion: &mut Criterion) {
    for (name, close) in [
        ("whole curve in view", false),
        ("a dozen legs in view", true),
    ] {
        let mut group = criterion.benchmark_group(format!("drag a vertex, {name}"));
        for count in [100, 1_000, 10_000] {
            let (mut editor, at) = dragging(winding(count), close);
            let mut step = 0;
            group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
                bencher.iter(|| {
                    step = (step + 1) % 64;
                    frame(&mut editor, at + DVec2::new(10.0 + step as f64, 10.0));
                });
            });
        }
        group.finish();
    }
}

fn drag_beside_proofs(criterion: &mut Criterion) {
    let polygon = wavy(60, 25, 3.0, true);
    let document = Document::from_curves([Curve::new("wavy", polygon)]);
    let (mut editor, at) = dragging(document, false);
    editor.run_in_background(PATIENCE, || {});
    let mut step = 0;
    criterion.bench_function(
        "drag a vertex of a rational curve of degree 25 in space",
        |bencher| {
            bencher.iter(|| {
                step = (step + 1) % 64;
                frame(&mut editor, at + DVec2::new(10.0 + step as f64, 10.0));
            });
        },
    );
}

/// How many frames are looked at for the largest.
const FRAMES: usize = 600;

fn drag_in_a_safe_region(criterion: &mut Criterion) {
    for (name, keeps) in [
        ("region shown", false),
        ("region shown, features kept", true),
    ] {
        let (mut editor, at) = dragging(winding(60), false);
        editor
            .execute(Command::ToggleLayer(Layer::SafeRegion))
            .expect("a command");
        editor.run_in_background(PATIENCE, || {});
        editor.input(Input::KeepingHeld(keeps));
        // Round the vertex, wider and wider, into its region and far out of it.
        let place = |step: usize| {
            let reach = 4.0 + 0.1 * (step % FRAMES) as f64;
            at + reach * DVec2::from_angle(0.37 * step as f64)
        };
        let mut frames: Vec<Duration> = (0..FRAMES)
            .map(|step| {
                let begin = Instant::now();
                frame(&mut editor, place(step));
                begin.elapsed()
            })
            .collect();
        frames.sort_unstable();
        let [median, high, largest] = [FRAMES / 2, FRAMES * 99 / 100, FRAMES - 1];
        println!(
            "drag, {name}: median {:?}, 99 of 100 under {:?}, largest of {FRAMES} {:?}",
            frames[median], frames[high], frames[largest]
        );
        let mut step = 0;
        criterion.bench_function(
            &format!("drag a vertex of 60, degree 9, {name}"),
            |bencher| {
                bencher.iter(|| {
                    step += 1;
                    frame(&mut editor, place(step));
                });
            },
        );
    }
}

criterion_group!(benches, drag, drag_beside_proofs, drag_in_a_safe_region);
criterion_main!(benches);
