//! Pictures: added, placed, traced, stored and missing.

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};

use batten::document::{CurveId, Edit, PictureSource, Reference};
use batten::editor::{
    Command, DrawWay, Editor, Key, Look, NamedView, PICTURE_PLANES, PictureChange, ReferenceChange,
    ToolKind, told,
};
use batten::geometry::distance::SideDeviation;
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{FloatPolygon, Progress};
use batten::io::{Decoded, Loss, PICTURE, TABLE, decode, disk};
use batten::operations::Value;
use glam::{DVec2, DVec3};
use image::{GrayImage, Luma};

use super::script::Script;

/// Rounding of places, in units of the picture's size.
const ROUNDING: f64 = 1e-12;

/// A picture of dark inside of a shape and light outside of it, with noise of a standard deviation as a share of white.
fn picture(size: [u32; 2], noise: f64, inside: impl Fn(DVec2) -> bool) -> GrayImage {
    GrayImage::from_fn(size[0], size[1], |x, y| {
        let places = (0..64).map(|index| {
            let by = DVec2::new(f64::from(index % 8), f64::from(index / 8)) / 8.0 + 1.0 / 16.0;
            DVec2::new(f64::from(x), f64::from(y)) + by
        });
        let covered = places.filter(|place| inside(*place)).count() as f64 / 64.0;
        let mut bits = (u64::from(x) << 32 | u64::from(y)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let random = (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        let value = 0.9 - 0.7 * covered + noise * 3f64.sqrt() * random;
        Luma([(255.0 * value).round() as u8])
    })
}

/// An editor with this picture added, which is active, seen as a whole.
fn with(path: &Path, picture: &GrayImage) -> (Script, CurveId) {
    picture.save(path).expect("a file");
    let mut editor = Editor::default();
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let reply = editor.import(&[path.to_owned()]).expect("a picture");
    assert!(reply.text.starts_with("1 picture"), "{}", reply.text);
    let (id, _) = editor.document().references().next().expect("a picture");
    editor.activate(id);
    let mut script = Script { editor };
    script.command(Command::FitAll);
    script.check();
    (script, id)
}

fn reference(script: &Script, id: CurveId) -> Reference {
    let found = script.editor.document().reference(id);
    Reference::clone(found.expect("a reference"))
}

/// The corner and the sides of a picture's frame.
fn frame(script: &Script, id: CurveId) -> [DVec3; 3] {
    let reference = reference(script, id);
    let (_, frame) = reference.framed().expect("a picture");
    frame
}

/// Where a place of the picture, in pixels from its upper left corner, is in the model.
fn placed(script: &Script, id: CurveId, pixel: DVec2) -> DVec3 {
    let reference = reference(script, id);
    let (picture, [corner, across, up]) = reference.framed().expect("a picture");
    let [width, height] = picture.pixels.map(f64::from);
    corner + pixel.x / width * across + (1.0 - pixel.y / height) * up
}

/// The measured points of a picture.
fn measured(script: &Script, id: CurveId) -> [DVec3; 2] {
    let document = script.editor.document();
    let ends = script.editor.hand().measured_on(id, document);
    ends.expect("a measurement")
}

fn on_canvas(script: &Script, point: DVec3) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(point))
}

fn disc(radius: f64) -> impl Fn(DVec2) -> bool {
    move |place| place.distance(DVec2::new(200.0, 150.0)) < radius
}

#[test]
fn a_picture_is_an_item_with_a_name_a_size_and_an_opacity() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("vase.png");
    let (mut script, id) = with(&path, &picture([400, 300], 0.0, disc(80.0)));
    let found = reference(&script, id);
    assert_eq!(found.name, "vase");
    let dot = 25.4 / 96.0;
    let [corner, across, up] = frame(&script, id);
    assert_eq!(corner, DVec3::ZERO);
    assert!(across.distance(400.0 * dot * DVec3::X) < ROUNDING * 400.0);
    assert!(up.distance(300.0 * dot * DVec3::Y) < ROUNDING * 400.0);

    let steps = script.steps();
    told(PictureChange::Width(80.0).apply(&mut script.editor));
    let [_, across, up] = frame(&script, id);
    assert!((across.length() - 80.0).abs() < ROUNDING * 80.0);
    assert!((up.length() - 60.0).abs() < ROUNDING * 80.0);
    told(PictureChange::Height(30.0).apply(&mut script.editor));
    assert!((frame(&script, id)[1].length() - 40.0).abs() < ROUNDING * 80.0);
    for (plane, normal) in [
        (NamedView::Xz, DVec3::NEG_Y),
        (NamedView::Yz, DVec3::X),
        (NamedView::Xy, DVec3::Z),
    ] {
        told(PictureChange::Plane(plane).apply(&mut script.editor));
        let now = frame(&script, id);
        let found = now[1].cross(now[2]).normalize();
        assert!(found.distance(normal) < ROUNDING, "{plane:?}: {found}");
        // It stands on the plane in which clicks draw.
        assert!(now[0].dot(normal).abs() < ROUNDING * 100.0);
    }
    assert_eq!(script.steps(), steps + 5);

    // A locked picture keeps its place, and is drawn as strongly as one likes.
    let lock = Edit::SetLocked {
        curve: id,
        locked: true,
    };
    script.editor.apply("Lock", vec![lock]).expect("an edit");
    assert!(
        PictureChange::Width(10.0)
            .apply(&mut script.editor)
            .is_err()
    );
    told(PictureChange::Opacity(0.25).apply(&mut script.editor));
    let opacity = |script: &Script| reference(script, id).picture.expect("a picture").opacity;
    assert_eq!(opacity(&script), 0.25);
    script.check();
    script.undo_all();
    while Command::Redo.is_enabled(&script.editor) {
        script.command(Command::Redo);
    }
    assert_eq!(opacity(&script), 0.25);
}

#[test]
fn two_measured_points_give_the_size_and_the_direction() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("vase.png");
    for plane in PICTURE_PLANES {
        let (mut script, id) = with(&path, &picture([400, 300], 0.0, disc(80.0)));
        let refused = PictureChange::TrueDistance(5.0).apply(&mut script.editor);
        assert!(refused.is_err());
        told(PictureChange::Plane(plane).apply(&mut script.editor));
        script.command(Command::View(plane));
        script.command(Command::FitAll);
        script.tool(ToolKind::Measure);
        let pixels = [DVec2::new(120.0, 150.0), DVec2::new(280.0, 170.0)];
        for pixel in pixels {
            script.click(on_canvas(&script, placed(&script, id, pixel)));
        }
        let [from, to] = measured(&script, id);
        told(PictureChange::TrueDistance(500.0).apply(&mut script.editor));
        told(PictureChange::TrueDirection(PI / 6.0).apply(&mut script.editor));
        // The first point stays on its place of the picture, the second has the distance and the direction.
        let [first, second] = measured(&script, id);
        assert!(first.distance(from) < 500.0 * ROUNDING);
        assert!((second.distance(first) - 500.0).abs() < 500.0 * ROUNDING);
        let share = |at: DVec3| {
            let [corner, across, up] = frame(&script, id);
            let by = at - corner;
            DVec2::new(
                by.dot(across) / across.length_squared(),
                by.dot(up) / up.length_squared(),
            )
        };
        // What a click of whole points leaves is in `from` and `to` too.
        let size = 400.0 * 25.4 / 96.0;
        let before = (to - from).length() / size;
        let now = (second - first).length() / frame(&script, id)[1].length();
        assert!((before - now).abs() < ROUNDING, "{plane:?}");
        let horizontal = match plane {
            NamedView::Yz => DVec3::Y,
            _ => DVec3::X,
        };
        let angle = (second - first).angle_between(horizontal);
        assert!((angle - PI / 6.0).abs() < 1e-9, "{plane:?}: {angle}");
        assert!(share(first).x > 0.0 && share(second).x < 1.0);
        let steps = script.steps();
        // The first point comes to where it belongs, the second goes along.
        for (axis, to) in [(0, 0.0), (1, -40.0), (2, 7.5)] {
            told(PictureChange::FirstPoint { axis, to }.apply(&mut script.editor));
        }
        let [placed, along] = measured(&script, id);
        assert!(placed.distance(DVec3::new(0.0, -40.0, 7.5)) < 500.0 * ROUNDING);
        assert!((along - placed).distance(second - first) < 500.0 * ROUNDING);
        // The points are those of the picture after undo, too.
        let moves = script.steps() - steps;
        for _ in 0..moves + 2 {
            script.command(Command::Undo);
        }
        let [first, second] = measured(&script, id);
        let off = first.distance(from).max(second.distance(to));
        assert!(off < 500.0 * ROUNDING, "{plane:?}: {off}");
        script.check();
    }
}

#[test]
fn a_project_names_its_pictures_from_its_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let (here, there) = (folder.path().join("here"), folder.path().join("there"));
    std::fs::create_dir_all(here.join("photos")).expect("a folder");
    let (script, id) = with(
        &here.join("photos/vase.png"),
        &picture([60, 40], 0.0, disc(10.0)),
    );
    let project = here.join("design.batten");
    let document = script.editor.document();
    disk::write_document(&project, document, None).expect("a file");
    let text = std::fs::read_to_string(&project).expect("a file");
    assert!(text.contains("\"photos/vase.png\""), "{text}");
    // Both are moved.
    std::fs::rename(&here, &there).expect("moved");
    let opened = |path: &Path| {
        let mut editor = Editor::default();
        told(editor.open(&[path.to_owned()]));
        editor.refresh();
        editor
    };
    let mut editor = opened(&there.join("design.batten"));
    let shown = |editor: &Editor| editor.view().scene().pictures[0].picture.clone();
    assert_eq!(shown(&editor).expect("a picture").size(), [60, 40]);
    let found = editor
        .document()
        .reference(id)
        .expect("a reference")
        .clone();
    let before = document.reference(id).expect("a reference").clone();
    assert_eq!(found.curve, before.curve);

    // Embedded it needs no file.
    editor.activate(id);
    told(PictureChange::Embed.apply(&mut editor));
    let alone = folder.path().join("alone.batten");
    disk::write_document(&alone, editor.document(), None).expect("a file");
    std::fs::remove_file(there.join("photos/vase.png")).expect("removed");
    let embedded = opened(&alone);
    assert_eq!(shown(&embedded).expect("a picture").size(), [60, 40]);
    let source = |editor: &Editor| {
        let reference = editor
            .document()
            .reference(id)
            .expect("a reference")
            .clone();
        reference.picture.clone().expect("a picture").source
    };
    assert!(matches!(source(&embedded), PictureSource::Embedded(_)));

    // Without either the frame stays and says which file is missing, until another one is named.
    let mut missing = opened(&there.join("design.batten"));
    let reason = shown(&missing).expect_err("no picture");
    assert!(reason.contains("vase.png"), "{reason}");
    picture([60, 40], 0.0, disc(10.0))
        .save(folder.path().join("other.png"))
        .expect("a file");
    missing.activate(id);
    told(PictureChange::Relink(folder.path().join("other.png")).apply(&mut missing));
    missing.refresh();
    assert!(shown(&missing).is_ok());
    missing.execute(Command::Undo).expect("a step");
    missing.refresh();
    assert!(shown(&missing).is_err());
}

#[test]
fn what_works_on_curves_leaves_pictures_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("vase.png");
    let (mut script, id) = with(&path, &picture([400, 300], 0.0, disc(80.0)));
    let points: Vec<(f64, f64)> = (0..8).map(|x| (10.0 * f64::from(x), 20.0)).collect();
    let polygon = FloatPolygon::planar(4, &points).expect("a polygon");
    let curve = batten::document::Curve::new("line", polygon);
    script
        .editor
        .apply("Add", vec![Edit::Add(Box::new(curve))])
        .expect("an edit");
    let document = script.editor.document().clone();

    // No other program gets the frame in place of the picture; it is told.
    let export = TABLE.write(&document, None).expect("a table");
    let lost = |(name, loss): &(String, Loss)| name == "vase" && *loss == Loss::Picture;
    assert!(export.losses.losses.iter().any(lost), "{:?}", export.losses);
    assert!(
        !String::from_utf8(export.bytes)
            .expect("text")
            .contains("vase")
    );

    // A box round everything takes the curve alone.
    script.command(Command::FitAll);
    script.tool(ToolKind::Select);
    script.key(Key::Escape);
    script.drag(DVec2::new(17.0, 2.0), DVec2::new(998.0, 698.0));
    assert!(!script.editor.hand().selection().items().contains(&id));
    script.check();
}

#[test]
fn clicks_near_an_edge_go_to_it_unless_it_is_switched_off() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("disc.png");
    let (mut script, id) = with(&path, &picture([400, 300], 0.02, disc(80.0)));
    let centre = placed(&script, id, DVec2::new(200.0, 150.0));
    let dot = 25.4 / 96.0;
    script.tool(ToolKind::Draw);
    script.draw_by(DrawWay::Points);
    let circle = |count: u32, off: f64| {
        (0..count).map(move |step| {
            let angle = f64::from(step) * TAU / f64::from(count);
            centre + (80.0 + off) * dot * DVec2::from_angle(angle).extend(0.0)
        })
    };
    for at in circle(12, 3.0) {
        script.click(on_canvas(&script, at));
    }
    script.key(Key::Enter);
    let radii = |script: &Script| -> Vec<f64> {
        let active = script.editor.active().expect("points");
        let points = reference(script, active).points().expect("points");
        points
            .iter()
            .map(|point| point.distance(centre) / dot)
            .collect()
    };
    let worst = |script: &Script| {
        let off = radii(script)
            .into_iter()
            .map(|radius| (radius - 80.0).abs());
        off.fold(0.0, f64::max)
    };
    assert_eq!(radii(&script).len(), 12);
    assert!(worst(&script) < 0.3, "{}", worst(&script));

    script.command(Command::ToggleEdges);
    script.tool(ToolKind::Draw);
    for at in circle(6, 3.0) {
        script.click(on_canvas(&script, at));
    }
    script.key(Key::Enter);
    assert!(worst(&script) > 2.5, "{}", worst(&script));
    script.check();
}

/// The radius of a vase at an angle about its middle, in pixels: its sharpest bend has a radius of 18.
fn vase(angle: f64) -> f64 {
    150.0 - 60.0 * (2.0 * angle).cos() - 25.0 * angle.sin() + 36.0 * (3.0 * angle).sin()
}

/// The largest distance between a curve and the vase up to these angles on both sides of its top, in pixels: both ways,
/// from dense points.
fn off_the_vase(polygon: &FloatPolygon, rim: f64, dot: f64) -> f64 {
    let outline = |rim: f64| {
        let points = (0..=7200).map(|step| {
            let share = f64::from(step) / 7200.0;
            let angle = (PI - rim) * (1.0 - share) + (rim + TAU) * share;
            (vase(angle) * dot * DVec2::from_angle(angle)).extend(0.0)
        });
        let list = PointList::new(points.collect()).expect("points");
        ReferenceCurve::of(ReferenceForm::Points(list)).expect("a curve")
    };
    let progress = Progress::default();
    // The curve may end beyond the rim, or the other way round.
    let [wide, narrow] = [rim + 0.1, rim - 0.05].map(outline);
    let there = SideDeviation::of_curve(polygon, &wide, &progress).expect("a distance");
    let back = SideDeviation::of_curve(&narrow, polygon, &progress).expect("a distance");
    there.largest.distance().max(back.largest.distance()) / dot
}

/// Trace the right half of the vase from beyond the axis at its bottom, fit a curve, make it whole and harmonise it.
fn traced_vase(to: f64, merges_coarsely: bool) -> (Script, f64) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("vase.png");
    let middle = DVec2::new(200.0, 320.0);
    // Rows are counted downwards.
    let inside = |place: DVec2| {
        let by = DVec2::new(place.x - middle.x, middle.y - place.y);
        by.length() < vase(by.to_angle())
    };
    let (mut script, id) = with(&path, &picture([400, 640], 0.02, inside));
    let dot = frame(&script, id)[1].length() / 400.0;
    let at = placed(&script, id, middle);
    told(ReferenceChange::Translate(-at).apply(&mut script.editor));
    script.command(Command::FitAll);

    // Clicks are up to four pixels off the edge.
    script.tool(ToolKind::Draw);
    script.draw_by(DrawWay::Points);
    let (from, clicks) = (-0.53 * PI, 64_u32);
    for step in 0..=clicks {
        let share = f64::from(step) / f64::from(clicks);
        let angle = from * (1.0 - share) + to * share;
        let off = 4.0 * (12.9 * f64::from(step)).sin();
        let place = (vase(angle) + off) * dot * DVec2::from_angle(angle);
        script.click(on_canvas(&script, place.extend(0.0)));
    }
    script.key(Key::Enter);
    let points = script.editor.active().expect("points");
    let traced = reference(&script, points).points().expect("points");
    assert_eq!(traced.len(), clicks as usize + 1);

    let tolerance = ("tolerance", Value::List(vec![0.5 * dot]));
    let coarse = [("tolerance", Value::List(vec![0.5 * dot]))];
    let within = if merges_coarsely { &coarse[..] } else { &[] };
    for (operation, values) in [
        ("fit", &[tolerance][..]),
        ("make-symmetric", within),
        ("harmonise", &[]),
    ] {
        script.operate(operation, values).expect("a curve");
        let message = script.message();
        println!("{message}");
        assert!(!message.contains("not reached"), "{message}");
    }
    (script, dot)
}

#[test]
fn half_a_vase_is_traced_fitted_made_whole_and_harmonised() {
    const RIM: f64 = 0.42 * PI;
    let (script, dot) = traced_vase(RIM, false);
    let polygon = script.polygon();
    let off = off_the_vase(&polygon, RIM, dot);
    println!("{} vertices, off {off:.3} pixels", polygon.vertices().len());
    assert!(!polygon.is_periodic() && off <= 0.5, "{off} pixels");
}

#[test]
fn half_an_outline_that_ends_beyond_the_axis_closes() {
    // Its ends are square to the axis but for hundredths of a degree, which are rounded.
    let (script, dot) = traced_vase(0.53 * PI, true);
    let polygon = script.polygon();
    let off = off_the_vase(&polygon, 0.5 * PI, dot);
    println!("{} vertices, off {off:.3} pixels", polygon.vertices().len());
    assert!(polygon.is_periodic() && off <= 0.5, "{off} pixels");
}

#[test]
fn a_pasted_picture_is_embedded_and_lies_beside_the_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawn = picture([40, 30], 0.0, |at| at.x < 20.0);
    let (mut script, first) = with(&folder.path().join("first.png"), &drawn);
    let rgba: Vec<u8> = (0..60 * 50)
        .flat_map(|at| [at as u8, 7, 9, 255 - (at % 3) as u8])
        .collect();
    let copied = Decoded {
        size: [60, 50],
        rgba: rgba.clone(),
    };
    let reply = script.editor.paste(&copied).expect("a picture");
    assert!(reply.text.starts_with("1 picture added"), "{}", reply.text);
    let last = script.editor.document().references().last();
    let (id, reference) = last.expect("a picture");
    let source = &reference.picture.as_ref().expect("a picture").source;
    let PictureSource::Embedded(bytes) = source else {
        panic!("{source:?}");
    };
    let kept = decode(bytes).expect("a picture");
    assert_eq!((kept.size, kept.rgba), (copied.size, rgba));
    let [corner, across, _] = frame(&script, first);
    let [other, ..] = frame(&script, id);
    assert!(other.x > corner.x + across.x, "{other}");
    assert_eq!(other.y, corner.y);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().references().len(), 1);
    let empty = Decoded {
        size: [0, 0],
        rgba: Vec::new(),
    };
    assert!(script.editor.paste(&empty).is_err());
}

/// `BATTEN_PICTURES=DIR cargo test --test editor_scripts real_pictures -- --ignored --nocapture`
#[test]
#[ignore = "needs a folder of pictures"]
fn real_pictures_have_as_many_pixels_as_their_frames_say() {
    let folder = std::env::var("BATTEN_PICTURES").expect("a folder");
    let mut folders = vec![PathBuf::from(folder)];
    let (mut read, mut refused) = (0, 0);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let extension = path.extension().and_then(|it| it.to_str()).unwrap_or("");
            if path.is_dir() {
                folders.push(path);
            } else if PICTURE.extensions.contains(&extension) {
                let bytes = std::fs::read(&path).expect("a file");
                match (PICTURE.read(&bytes), decode(&bytes)) {
                    (Ok(reading), Ok(decoded)) => {
                        let picture = reading.references[0].picture.as_ref();
                        assert_eq!(picture.expect("a picture").pixels, decoded.size);
                        let [width, height] = decoded.size.map(|it| it as usize);
                        assert_eq!(decoded.rgba.len(), 4 * width * height);
                        read += 1;
                    }
                    (Err(reason), _) => {
                        refused += 1;
                        println!("{}: {reason}", path.display());
                    }
                    (_, Err(reason)) => {
                        refused += 1;
                        println!("{}: {reason}", path.display());
                    }
                }
            }
        }
    }
    println!("{read} pictures read, {refused} refused");
    assert!(read > 0);
}
