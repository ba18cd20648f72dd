//! A frame of the whole window while a vertex is dragged: editor, panels, plots and tessellation, everything
//! but the renderer. Needs no display.
#![allow(missing_docs)]

mod winding;

use std::hint::black_box;

use batten::editor::{Command, Editor, Layer};
use batten::ui::App;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use eframe::egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, vec2};
use winding::winding;

const SIZE: [f32; 2] = [1440.0, 900.0];

/// A frame of a display with 60 in a second.
const STEP: f64 = 1.0 / 60.0;

/// A window without a display.
struct Window {
    context: Context,
    app: App,
    time: f64,
}

impl Window {
    /// Open the window on a curve of so many vertices, with the comb shown.
    fn open(count: usize) -> Self {
        let mut editor = Editor::with_document(winding(count));
        let comb = Command::ToggleLayer(Layer::Comb);
        if !editor.sight().layers().shows(Layer::Comb) {
            editor.execute(comb).expect("a command");
        }
        // In a crowd only what is selected can be pressed.
        let curve = editor.active().expect("a curve");
        editor.select_vertex(curve, count / 2, false);
        let context = Context::default();
        let app = App::new(&context, None, false, editor);
        let mut window = Self {
            context,
            app,
            time: 0.0,
        };
        for _ in 0..8 {
            window.frame(Vec::new());
        }
        window
    }

    /// Run a frame, and return the number of triangles that would be painted.
    fn frame(&mut self, events: Vec<Event>) -> usize {
        self.time += STEP;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, SIZE.into())),
            time: Some(self.time),
            events,
            focused: true,
            ..RawInput::default()
        };
        let app = &mut self.app;
        let output = self.context.run_ui(input, |ui| app.show(ui));
        let meshes = self
            .context
            .tessellate(output.shapes, output.pixels_per_point);
        meshes.len()
    }

    /// Press the vertex in the middle of the curve.
    fn press(&mut self) -> Pos2 {
        let editor = self.app.editor();
        let curve = editor.active().expect("a curve");
        let polygon = &editor.document().curve(curve).expect("the curve").polygon;
        let vertex = polygon.vertex(polygon.vertices().len() / 2).truncate();
        let at = editor.view().viewport().to_screen(vertex);
        let canvas = self.app.canvas_rect().expect("the canvas was shown");
        let at = canvas.min + vec2(at.x as f32, at.y as f32);
        self.frame(vec![Event::PointerMoved(at)]);
        self.frame(vec![Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed: true,
            modifiers: Modifiers::NONE,
        }]);
        self.frame(vec![Event::PointerMoved(at + vec2(10.0, 10.0))]);
        assert!(self.app.editor().workspace().preview().is_some());
        at
    }
}

fn drag(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a frame of the window while a vertex is dragged");
    for count in [100, 1_000, 10_000] {
        let mut window = Window::open(count);
        let at = window.press();
        let mut step = 0;
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            bencher.iter(|| {
                step = (step + 1) % 64;
                let to = at + vec2(10.0 + step as f32, 10.0);
                black_box(window.frame(vec![Event::PointerMoved(to)]))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, drag);
criterion_main!(benches);
