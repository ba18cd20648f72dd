//! A frame of the whole window while a vertex is dragged: editor, panels, plots and tessellation, everything
//! but the renderer. Needs no display.
#![allow(missing_docs)]

mod winding;

use std::hint::black_box;

use batten::document::{Curve, Document, Edit, Reference};
use batten::editor::{CombsOf, Command, Editor, Layer, Look};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{ClampedPolygon, FloatPolygon};
use batten::io::Decoded;
use batten::ui::App;
use criterion::{Bencher, BenchmarkId, Criterion, criterion_group, criterion_main};
use eframe::egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, vec2};
use glam::{DVec2, DVec3};
use winding::winding;

/// The allocator of the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

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
    /// Open the window on a curve of so many vertices, with the comb shown; a vertex is selected.
    fn open(count: usize, selected: usize) -> Self {
        Self::on(Self::editor(count, selected))
    }

    /// Open the window on the beginning of a curve.
    fn at_beginning(count: usize) -> Self {
        let mut editor = Self::editor(count, 0);
        let curve = editor.active().expect("a curve");
        for vertex in 1..SHOWN {
            editor.select_vertex(curve, vertex, true);
        }
        editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
        editor.look(Look::Selection);
        editor.select_vertex(curve, SHOWN - 1, false);
        Self::on(editor)
    }

    fn editor(count: usize, selected: usize) -> Editor {
        let mut editor = Editor::with_document(winding(count));
        let comb = Command::ToggleLayer(Layer::Comb);
        if !editor.sight().layers().shows(Layer::Comb) {
            editor.execute(comb).expect("a command");
        }
        // In a crowd only what is selected can be pressed.
        let curve = editor.active().expect("a curve");
        editor.select_vertex(curve, selected, false);
        editor
    }

    fn on(editor: Editor) -> Self {
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

    /// Where a point of the model is in the window.
    fn at(&self, point: DVec3) -> Pos2 {
        let at = self
            .app
            .editor()
            .view()
            .viewport()
            .to_screen(point.truncate());
        let canvas = self.app.canvas_rect().expect("the canvas was shown");
        canvas.min + vec2(at.x as f32, at.y as f32)
    }

    fn polygon(&self) -> &FloatPolygon {
        let editor = self.app.editor();
        let curve = editor.active().expect("a curve");
        &editor.document().curve(curve).expect("the curve").polygon
    }

    /// Press a handle of the curve, and drag it a little.
    fn press(&mut self, handle: Handle) -> Pos2 {
        let at = self.at(handle.place(self.polygon()));
        self.frame(vec![Event::PointerMoved(at)]);
        self.frame(vec![Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed: true,
            modifiers: Modifiers::NONE,
        }]);
        let to = at + vec2(10.0, 10.0);
        self.frame(vec![Event::PointerMoved(to)]);
        assert!(self.app.editor().workspace().preview().is_some());
        let off = self.at(handle.place(self.polygon())).distance(to);
        assert!(
            off < 2.0,
            "{handle:?} is {off} points away from the pointer"
        );
        at
    }
}

/// Vertices that the window shows where different handles are dragged.
const SHOWN: usize = 14;

/// What is dragged.
#[derive(Clone, Copy, Debug)]
enum Handle {
    Vertex(usize),
    Closed(usize),
    Curve(f64),
}

impl Handle {
    fn place(self, polygon: &FloatPolygon) -> DVec3 {
        match self {
            Self::Vertex(index) => polygon.vertex(index),
            Self::Closed(index) => ClampedPolygon::from_float(polygon).vertices()[index],
            Self::Curve(u) => polygon.point(u),
        }
    }
}

/// Measure the frames of a drag that goes on.
fn frames(bencher: &mut Bencher, window: &mut Window, at: Pos2) {
    let mut step = 0;
    bencher.iter(|| {
        step = (step + 1) % 64;
        let to = at + vec2(10.0 + step as f32, 10.0);
        black_box(window.frame(vec![Event::PointerMoved(to)]))
    });
}

fn drag(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a frame of the window while a vertex is dragged");
    for count in [100, 1_000, 10_000] {
        let mut window = Window::open(count, count / 2);
        let at = window.press(Handle::Vertex(count / 2));
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            frames(bencher, &mut window, at);
        });
    }
    group.finish();
}

fn handles(criterion: &mut Criterion) {
    for count in [60, 1_000] {
        let name = format!("a frame while a handle of {count} vertices is dragged");
        let mut group = criterion.benchmark_group(name);
        for (name, handle) in [
            ("vertex", Handle::Vertex(6)),
            ("closed vertex", Handle::Closed(5)),
            ("curve", Handle::Curve(2.5)),
        ] {
            let mut window = Window::at_beginning(count);
            let at = window.press(handle);
            group.bench_function(name, |bencher| frames(bencher, &mut window, at));
        }
        group.finish();
    }
}

/// A window on so many curves of so many vertices side by side, all with combs or the first alone.
fn crowd(count: usize, vertices: usize, combs: CombsOf) -> Window {
    let curve = |place: usize| {
        let points = (0..vertices).map(|index| {
            let x = index as f64;
            (x, 3.0 * (0.4 * x).sin() + 2.0 * place as f64)
        });
        let points: Vec<(f64, f64)> = points.collect();
        let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
        Curve::new(format!("curve {place}"), polygon)
    };
    let mut editor = Editor::with_document(Document::from_curves((0..count).map(curve)));
    if !editor.sight().layers().shows(Layer::Comb) {
        let comb = Command::ToggleLayer(Layer::Comb);
        editor.execute(comb).expect("a command");
    }
    editor
        .execute(Command::ShowCombs(combs))
        .expect("a command");
    Window::on(editor)
}

fn crowds(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a frame of many curves while the pointer moves");
    for (name, count, vertices, combs) in [
        ("200 of 50 vertices with combs", 200, 50, CombsOf::Visible),
        ("3 000 of 10 vertices", 3000, 10, CombsOf::Active),
    ] {
        let mut window = crowd(count, vertices, combs);
        let at = window.at(window.polygon().vertex(vertices / 2));
        group.bench_function(name, |bencher| {
            let mut step = 0;
            bencher.iter(|| {
                step = (step + 1) % 64;
                let to = at + vec2(10.0 + step as f32, 10.0);
                black_box(window.frame(vec![Event::PointerMoved(to)]))
            });
        });
    }
    group.finish();
}

/// A curve beside so many points that it is compared with.
fn compared(points: usize) -> Editor {
    let document = winding(100);
    let (id, curve) = document.curves().next().expect("a curve");
    let segments = curve.polygon.segments() as f64;
    let places = (0..points).map(|index| {
        let u = segments * (index as f64 + 0.5) / points as f64;
        curve.polygon.point(u) + 3.0 * (0.7 * index as f64).sin() * DVec3::Y
    });
    let points = PointList::new(places.collect()).expect("points");
    let points = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
    let points = Edit::AddReference(Box::new(Reference::new("points", points)));
    let mut editor = Editor::with_document(document);
    editor
        .apply("Add points", vec![points])
        .expect("they are added");
    let (points, _) = editor.document().references().next().expect("points");
    editor.activate(id);
    editor
        .execute(Command::Compare(Some(points)))
        .expect("a comparison");
    editor
}

fn whiskers(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a frame with whiskers while a vertex is dragged");
    for points in [1_000] {
        let mut window = Window::on(compared(points));
        // The worker measures.
        while window.app.editor().sight().deviation().is_none() {
            std::thread::sleep(std::time::Duration::from_millis(20));
            window.frame(Vec::new());
        }
        let at = window.press(Handle::Vertex(50));
        group.bench_function(BenchmarkId::from_parameter(points), |bencher| {
            frames(bencher, &mut window, at);
        });
    }
    group.finish();
}

/// A window on a curve, before a picture of so many pixels on each side if there is one.
fn before_picture(side: Option<u32>) -> Window {
    let mut editor = Editor::with_document(winding(100));
    if let Some(side) = side {
        let pixels =
            (0..side * side).flat_map(|at| [(at % 251) as u8, (at / side % 251) as u8, 90, 255]);
        let picture = Decoded {
            size: [side; 2],
            rgba: pixels.collect(),
        };
        // A document without a unit would ask for one.
        let unit = Command::SetUnit(Some(LengthUnit::Millimetre));
        editor.execute(unit).expect("a unit");
        editor.paste(&picture).expect("a picture");
        assert_eq!(editor.document().references().len(), 1);
    }
    let mut window = Window::on(editor);
    // The worker cuts it into tiles, of which a frame hands over a few.
    for _ in 0..100 {
        std::thread::sleep(std::time::Duration::from_millis(20));
        window.frame(Vec::new());
    }
    window
}

fn panning(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a frame while the view is panned");
    for (name, side) in [
        ("without a picture", None),
        ("over a picture of 4 000 × 4 000 pixels", Some(4_000)),
    ] {
        let mut window = before_picture(side);
        let at = window
            .app
            .canvas_rect()
            .expect("the canvas was shown")
            .center();
        window.frame(vec![Event::PointerMoved(at)]);
        window.frame(vec![Event::PointerButton {
            pos: at,
            button: PointerButton::Middle,
            pressed: true,
            modifiers: Modifiers::NONE,
        }]);
        let before = *window.app.editor().view().viewport();
        window.frame(vec![Event::PointerMoved(at + vec2(30.0, 10.0))]);
        assert_ne!(*window.app.editor().view().viewport(), before);
        group.bench_function(name, |bencher| frames(bencher, &mut window, at));
    }
    group.finish();
}

criterion_group!(benches, drag, handles, crowds, whiskers, panning);
criterion_main!(benches);
