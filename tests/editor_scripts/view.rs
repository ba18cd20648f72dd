//! The view and what it shows: zoom, pan, hovering, the comb, what is redone.

use batten::document::{Curve, Document, Edit};
use batten::editor::{
    Button, CombSettings, Command, Editor, HoverScene, Input, Layer, Look, Mark, NamedView,
};
use batten::geometry::FloatPolygon;
use batten::io::examples::EXAMPLES;
use glam::{DVec2, DVec3};

use super::script::Script;

#[test]
fn a_drag_does_the_same_zoomed_and_panned() {
    let way = DVec2::new(0.75, -0.5);
    let moved = |prepare: &dyn Fn(&mut Script)| {
        let mut script = Script::example("arc");
        prepare(&mut script);
        let at = script.at_vertex(5);
        let to = at + DVec2::new(way.x, -way.y) * script.editor.view().viewport().scale;
        script.drag(at, to);
        script.polygon().vertex(5)
    };
    let plain = moved(&|_| {});
    let zoomed = moved(&|script| {
        let at = script.at_vertex(5);
        script.input(Input::Zoomed { at, factor: 3.7 });
        script.input(Input::Panned {
            by: DVec2::new(-40.0, 13.0),
        });
    });
    assert!(plain.distance(zoomed) <= 1e-12, "{plain} against {zoomed}");
}

#[test]
fn zooming_keeps_the_place_under_the_pointer() {
    let mut script = Script::example("arc");
    let at = DVec2::new(200.0, 300.0);
    let before = script.editor.view().viewport().to_model(at);
    for factor in [1.7, 0.2, 40.0] {
        script.input(Input::Zoomed { at, factor });
        assert!(
            script
                .editor
                .view()
                .viewport()
                .to_model(at)
                .distance(before)
                < 1e-10
        );
    }
    let scale = script.editor.view().viewport().scale;
    script.input(Input::Zoomed {
        at,
        factor: f64::NAN,
    });
    script.input(Input::Zoomed { at, factor: 0.0 });
    assert_eq!(script.editor.view().viewport().scale, scale);
}

#[test]
fn the_middle_button_and_space_push_the_view_and_change_nothing() {
    let mut script = Script::example("arc");
    let before = (script.polygon(), script.editor.view().viewport().centre);
    let at = script.at_vertex(4);
    script.input(Input::SpaceHeld(true));
    script.drag(at, at + DVec2::new(50.0, 0.0));
    script.input(Input::SpaceHeld(false));
    assert_eq!(script.polygon(), before.0);
    let moved = before.1 - script.editor.view().viewport().centre;
    assert!((moved.x * script.editor.view().viewport().scale - 50.0).abs() < 1e-9);
    script.drag_with(Button::Middle, at, at - DVec2::new(50.0, 0.0));
    assert!(script.editor.view().viewport().centre.distance(before.1) < 1e-9);
    assert_eq!(script.polygon(), before.0);
}

#[test]
fn hovering_tells_of_vertices_and_of_the_curve() {
    let mut script = Script::example("arc");
    script.move_to(script.at_vertex(6));
    match script.scene().hover.clone() {
        Some(HoverScene::Vertex { text, .. }) => assert!(text.starts_with("Vertex 6\n"), "{text}"),
        other => panic!("{other:?}"),
    }
    let middle = script.polygon().point(0.5).truncate();
    script.move_to(script.editor.view().viewport().to_screen(middle));
    match script.scene().hover.clone() {
        Some(HoverScene::Curve {
            u, centre, text, ..
        }) => {
            assert!((u - 0.5).abs() < 1e-6, "{u}");
            assert!(centre.expect("a centre").length() < 1e-6);
            assert!(text.contains("κ -0.112"), "{text}");
        }
        other => panic!("{other:?}"),
    }
    let readout = script.editor.sight().readout();
    assert!((readout.parameter.expect("u") - 0.5).abs() < 1e-6);
}

#[test]
fn the_comb_is_scaled_by_the_tip_of_a_tooth() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleLayer(Layer::Comb));
    let scene = script.scene().clone();
    let teeth = &scene.curves[0].teeth;
    let tooth = teeth[teeth.len() / 2];
    let viewport = *script.editor.view().viewport();
    let before = script.editor.view().comb().scale;
    let longer = tooth[0] + 1.5 * (tooth[1] - tooth[0]);
    let [from, to] = [tooth[1], longer].map(|at| viewport.to_screen(at));
    // A press in passing takes no tip, and shows none.
    let is_named = |script: &mut Script| {
        let marks = script.scene().marks.iter();
        marks
            .filter(|mark| matches!(mark, Mark::Name(_, name) if name == "Comb scale"))
            .count()
    };
    script.drag(from, to);
    assert_eq!(script.editor.view().comb().scale, before);
    script.move_to(from);
    assert_eq!(is_named(&mut script), 0);
    script.input(Input::Rested { at: from });
    assert_eq!(is_named(&mut script), 1);
    script.drag(from, to);
    let after = script.editor.view().comb().scale;
    assert!(
        (after / before - 1.5).abs() < 0.01,
        "{after} against {before}"
    );
    assert_eq!(script.steps(), 0);
}

#[test]
fn the_hand_reaches_what_was_not_drawn_yet() {
    let polygon = Script::example("arc").polygon();
    let document = Document::from_curves([Curve::new("arc", polygon.clone())]);
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    editor
        .execute(Command::ToggleLayer(Layer::Comb))
        .expect("a command");
    let (viewport, comb) = (*editor.view().viewport(), editor.view().comb());
    // The tooth at a joint between segments.
    let jet = polygon.jet((polygon.segments() / 2) as f64);
    let tangent = jet.tangent().expect("a tangent").truncate();
    let foot = jet.point.truncate();
    let tooth = tangent.perp() * -jet.signed_curvature() * comb.scale;
    let button = Button::Primary;
    let [from, to] = [1.0, 1.5].map(|share| viewport.to_screen(foot + share * tooth));
    for input in [
        Input::Moved { at: from },
        Input::Rested { at: from },
        Input::Pressed { button, at: from },
        Input::Moved { at: to },
        Input::Released { button, at: to },
    ] {
        editor.input(input);
    }
    let ratio = editor.view().comb().scale / comb.scale;
    assert!((ratio - 1.5).abs() < 0.01, "{ratio}");
    // Nor was anything drawn since the document changed.
    let curve = editor.active().expect("a curve");
    let by = DVec3::new(0.0, 30.0 * viewport.pixel(), 0.0);
    let moved = polygon.vertices().iter().map(|vertex| *vertex + by);
    let moves = moved.enumerate().collect();
    editor
        .apply("lift", vec![Edit::MoveVertices { curve, moves }])
        .expect("an edit");
    let at = viewport.to_screen(viewport.flatten(polygon.vertex(3) + by));
    editor.input(Input::Moved { at });
    editor.input(Input::Pressed { button, at });
    editor.input(Input::Released { button, at });
    let selected: Vec<usize> = editor.hand().selection().of_curve(curve).collect();
    assert_eq!(selected, [3]);
}

#[test]
fn fitting_makes_the_comb_legible_and_shows_it() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleLayer(Layer::Comb));
    let fresh = script.editor.view().comb();
    for (scale, fit) in [(30.0, Command::FitAll), (1e6, Command::Fit)] {
        script
            .editor
            .view_mut()
            .set_comb(CombSettings { scale, density: 3 });
        script.command(fit);
        assert_eq!(script.editor.view().comb(), fresh);
        let scale = fresh.scale;
        let viewport = *script.editor.view().viewport();
        let polygon = script.polygon();
        let middle = polygon.jet(0.5);
        let normal = DVec2::new(0.0, 1.0);
        let tip = middle.point.truncate() + normal * scale * middle.curvature();
        let shown = |place: DVec2| {
            let at = viewport.to_screen(place);
            at.cmpge(DVec2::ZERO).all() && at.cmple(viewport.size).all()
        };
        assert!(shown(tip), "comb scale {scale}");
        // The curve stays large enough to be worked on.
        let size = polygon.size() * viewport.scale;
        assert!(size > 0.2 * viewport.size.y, "{size}");
    }
}

#[test]
fn another_active_curve_gets_a_legible_comb_and_its_own_view() {
    let polygon = Script::example("arc").polygon();
    let aside = |scale: f64| {
        let vertices = polygon.vertices().iter();
        let moved = vertices.map(|it| (scale * it.x + 3.0 * polygon.size(), scale * it.y));
        let moved: Vec<(f64, f64)> = moved.collect();
        FloatPolygon::planar(polygon.degree(), &moved).expect("a polygon")
    };
    let [alike, small] = [1.1, 1e-3].map(aside);
    let [arc, alike, small] = [("arc", polygon.clone()), ("alike", alike), ("small", small)]
        .map(|(name, polygon)| Curve::new(name, polygon));
    let mut editor = Editor::with_document(Document::from_curves([arc, alike, small]));
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let ids: Vec<_> = editor.document().ids().collect();
    editor.activate(ids[0]);
    editor.refresh();
    let comb = editor.view().comb();
    // Combs that can be read keep one scale, so that they can be compared.
    editor.activate(ids[1]);
    editor.refresh();
    assert_eq!(editor.view().comb(), comb);
    editor.activate(ids[2]);
    editor.refresh();
    assert!(editor.view().comb().scale < 1e-3 * comb.scale);
    let seen = |editor: &Editor, id| {
        let curve = editor.document().curve(id).expect("a curve");
        let view = *editor.view().viewport();
        let ends = [0.0, curve.polygon.segments() as f64].map(|u| curve.polygon.point(u));
        let [from, to] = ends.map(|it| view.to_screen(it.truncate()));
        from.distance(to) / view.size.y
    };
    assert!(seen(&editor, ids[2]) < 0.01);
    editor.execute(Command::Fit).expect("a view");
    assert!(seen(&editor, ids[2]) > 0.2);
    assert!(seen(&editor, ids[0]) > 10.0);
    editor.execute(Command::FitAll).expect("a view");
    assert!(seen(&editor, ids[0]) < 1.0);
}

#[test]
fn no_document_inherits_the_comb_of_another() {
    let fresh = |name| Script::example(name).editor.view().comb();
    let mut script = Script::example("arc");
    for name in ["hull", "arc", "bottle"] {
        script.editor.view_mut().set_comb(CombSettings {
            scale: 1e7,
            density: 60,
        });
        let index = EXAMPLES.iter().position(|example| example.name == name);
        let opened = script.editor.open_example(index.expect("an example"));
        assert!(opened.is_ok(), "{opened:?}");
        assert_eq!(script.editor.view().comb(), fresh(name), "{name}");
    }
}

#[test]
fn tips_of_the_comb_yield_to_legs_and_to_what_is_beside_a_vertex() {
    // A leg of another curve runs through the tip, its ends far away; or its end lies beside.
    for (from, to, taken) in [
        (DVec2::new(-120.0, 0.0), DVec2::new(120.0, 0.0), true),
        (DVec2::new(0.0, 11.0), DVec2::new(240.0, 40.0), false),
    ] {
        let mut script = Script::example("arc");
        script.command(Command::ToggleLayer(Layer::Comb));
        let arc = script.curve();
        let teeth = script.scene().curves[0].teeth.clone();
        let viewport = *script.editor.view().viewport();
        let tip = viewport.to_screen(teeth[teeth.len() / 2][1]);
        let ends = [from, to].map(|off| viewport.to_model(tip + off));
        let ends = ends.map(|end| (end.x, end.y));
        let other = Curve::new("other", FloatPolygon::planar(1, &ends).expect("a leg"));
        script
            .editor
            .apply("add", vec![Edit::Add(Box::new(other))])
            .expect("an edit");
        script.editor.activate(arc);
        let before = (
            script.editor.document().clone(),
            script.editor.view().comb(),
        );
        script.drag(tip, tip + DVec2::new(5.0, 25.0));
        assert_eq!(script.editor.view().comb(), before.1);
        assert_eq!(!script.editor.document().is_same(&before.0), taken);
    }
}

#[test]
fn a_planar_drawing_seen_at_an_angle_says_so() {
    let mut script = Script::example("arc");
    assert!(!script.editor.sight().is_orbited());
    script.drag_with(
        Button::Secondary,
        DVec2::new(300.0, 300.0),
        DVec2::new(310.0, 330.0),
    );
    assert!(script.editor.sight().is_orbited());
    script.command(Command::View(NamedView::Xy));
    assert!(!script.editor.sight().is_orbited());
    // A drawing in space is seen from anywhere.
    let curve = script.curve();
    let moves = vec![(3, DVec3::new(1.0, 2.0, 3.0))];
    script
        .editor
        .apply("lift", vec![Edit::MoveVertices { curve, moves }])
        .expect("an edit");
    script.command(Command::View(NamedView::Isometric));
    assert!(!script.editor.sight().is_orbited());
}

/// Prove all features, however many frames that takes on this machine.
fn prove(script: &mut Script) {
    while script.features().is_none() {}
}

#[test]
fn only_segments_that_depend_on_a_vertex_are_redone() {
    let mut script = Script::example("arc");
    let points: Vec<DVec3> = (0..200)
        .map(|i| {
            let i = f64::from(i);
            DVec3::new(i, (0.1 * i).sin(), 0.0)
        })
        .collect();
    let polygon = FloatPolygon::new(9, points, None, false).expect("a polygon");
    script.set_polygon(polygon);
    let curve = script.curve();
    prove(&mut script);
    let weigh = |weight| Edit::SetWeight {
        curve,
        vertex: 50,
        weight,
    };
    let moves = vec![(100, DVec3::new(100.0, 3.0, 0.0))];
    // The first weight makes the curve rational: that changes all of it.
    for (edit, expected) in [
        (Edit::MoveVertices { curve, moves }, 10),
        (weigh(2.0), 191),
        (weigh(3.0), 10),
    ] {
        script.editor.apply("edit", vec![edit]).expect("an edit");
        script.scene();
        prove(&mut script);
        let analysis = script.editor.view().analysis(curve).expect("an analysis");
        assert_eq!(analysis.segments_redone(), expected);
        assert_eq!(analysis.segments_proved(), expected);
    }
}

#[test]
fn a_fitted_view_leaves_tails_out_and_draws_them_fainter() {
    // A fair arc of degree 5 with 20 vertices: two legs at either end lie beyond the curve.
    let vertices: Vec<(f64, f64)> = (0..20)
        .map(|i| {
            let angle = 0.1 * f64::from(i);
            (30.0 * angle.sin(), -30.0 * angle.cos())
        })
        .collect();
    let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
    let tails = polygon.tail_legs();
    assert_eq!(tails, 2);
    let mut script = Script::example("arc");
    script.set_polygon(polygon.clone());
    script.editor.look(Look::All);
    let viewport = *script.editor.view().viewport();
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for vertex in &polygon.vertices()[tails..20 - tails] {
        let at = viewport.to_screen(vertex.truncate());
        (low, high) = (low.min(at), high.max(at));
    }
    let free = viewport.size - (high - low);
    assert!(
        free.min_element() < 150.0,
        "the curve fills the view: {free}"
    );
    // Strengths of legs, the faintest first: those beyond the ends are fewer and fainter.
    let scene = script.scene();
    let chains = scene.curves[0].float.chains();
    let strengths: Vec<(f32, usize)> = chains.map(|(chain, it)| (it, chain.len())).collect();
    let faint: usize = strengths
        .iter()
        .filter(|it| it.0 < 0.7)
        .map(|it| it.1)
        .sum();
    let full: usize = strengths
        .iter()
        .filter(|it| it.0 >= 0.7)
        .map(|it| it.1)
        .sum();
    assert!(faint > 0 && faint < full, "{strengths:?}");
}

#[test]
fn an_evolute_that_would_cover_the_canvas_is_hidden_until_it_is_wanted() {
    let mut script = Script::example("bottle");
    let drawn = |script: &mut Script| {
        let active = script.scene().curves.iter().find(|curve| curve.active);
        active.is_some_and(|curve| !curve.evolute.is_empty())
    };
    let is_hidden = |script: &Script| script.editor.view().evolute.is_hidden;
    assert!(drawn(&mut script) && !is_hidden(&script));
    // A curve that swings everywhere: its evolute runs to infinity and back at each inflection.
    let noisy: Vec<(f64, f64)> = (0..2000)
        .map(|index| {
            let t = f64::from(index);
            (t, 3.0 * (2.1 * t).sin() + 2.0 * (0.7 * t).cos())
        })
        .collect();
    script.set_polygon(FloatPolygon::planar(3, &noisy).expect("a polygon"));
    script.command(Command::FitAll);
    assert!(!drawn(&mut script) && is_hidden(&script));
    script.editor.view_mut().evolute.is_wanted = true;
    assert!(drawn(&mut script) && !is_hidden(&script));
    // Switched off and on it is hidden again.
    for _ in 0..2 {
        script.command(Command::ToggleLayer(Layer::Evolute));
    }
    assert!(!drawn(&mut script) && is_hidden(&script));
    script.command(Command::ToggleLayer(Layer::Evolute));
    script.scene();
    assert!(!is_hidden(&script));
}

#[test]
fn the_whole_comb_is_as_long_as_the_box_of_the_curve() {
    let mut script = Script::example("bottle");
    script.command(Command::ToggleLayer(Layer::Comb));
    script.scene();
    let whole = script.editor.sight().whole_comb_scale().expect("a scale");
    let density = script.editor.view().comb().density;
    let scale = 0.2 * whole;
    script
        .editor
        .view_mut()
        .set_comb(CombSettings { scale, density });
    let curves = &script.scene().curves;
    let curve = curves.iter().find(|curve| curve.active).expect("it");
    let teeth = curve.teeth.iter().map(|[foot, tip]| foot.distance(*tip));
    let longest = teeth.fold(0.0, f64::max);
    let points = curve.curve.iter().filter(|point| point.is_finite());
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for point in points {
        (low, high) = (low.min(*point), high.max(*point));
    }
    let share = longest / (high - low).max_element();
    assert!((share - 0.2).abs() < 0.01, "{share}");
}
