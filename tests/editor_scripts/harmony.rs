//! The harmony of the active curve: measured where it is shown, in strips and on the canvas.

use batten::analysis::Flow;
use batten::document::{Curve, Document};
use batten::editor::{Command, Editor, Layer, Look, Mark, Modifiers, PlotKind, PlotScene};
use batten::geometry::FloatPolygon;
use batten::geometry::features::Features;
use batten::geometry::harmony::{Harmony, VertexFlow};
use batten::geometry::polygon_figures::discrete_curvature;
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::Script;

const STRIPS: PlotKind = PlotKind::Harmony;

fn strips(script: &mut Script) -> PlotScene {
    script.editor.view_mut().plot = Some(STRIPS);
    script.plots().clone()
}

/// What is marked on the canvas as least even.
fn uneven(script: &mut Script) -> Vec<(DVec2, String)> {
    let marks = script.scene().marks.iter();
    let uneven = marks.filter_map(|mark| match mark {
        Mark::Extreme { at, text } => Some((*at, text.clone())),
        _ => None,
    });
    uneven.collect()
}

fn measured(polygon: &FloatPolygon) -> Harmony {
    Harmony::of(polygon, &Features::new(polygon))
}

#[test]
fn harmony_is_measured_only_where_it_is_shown() {
    let mut script = Script::example("hull");
    script.scene();
    assert_eq!(script.editor.sight().harmony(), None);
    script.editor.view_mut().harmony = true;
    script.scene();
    let expected = measured(&script.polygon());
    assert_eq!(script.editor.sight().harmony(), Some(&expected));
    script.editor.view_mut().harmony = false;
    script.drag_vertex(5, DVec2::new(0.0, 12.0));
    assert_eq!(
        script.editor.sight().harmony(),
        None,
        "it is that of the curve before"
    );
    strips(&mut script);
    assert_eq!(
        script.editor.sight().harmony(),
        Some(&measured(&script.polygon()))
    );
    script.command(Command::Undo);
    assert_eq!(script.editor.sight().harmony(), Some(&expected));
}

#[test]
fn strips_show_the_flow_and_where_it_is_least_even() {
    let mut script = Script::example("hull");
    script.drag_vertex(5, DVec2::new(0.0, 25.0));
    let plots = strips(&mut script);
    let flow = VertexFlow::of(&script.polygon());
    let numbers = |flow: Flow| -> Vec<f64> {
        let series = &plots.flow[flow as usize];
        series.iter().map(|point| point.y).collect()
    };
    assert_eq!(numbers(Flow::Legs), flow.legs.values());
    assert_eq!(
        numbers(Flow::Turns),
        flow.turns.map(f64::to_degrees).values()
    );
    assert_eq!(numbers(Flow::Curvatures), flow.curvatures.values());
    assert!(
        numbers(Flow::TorsionAngles).is_empty(),
        "a planar curve has none"
    );
    let figures = measured(&script.polygon()).figures;
    let worst = [figures.legs, figures.turns, figures.sharpest];
    let places = plots.worst.map(|at| at.map(|at| at.x as usize));
    let expected = worst.map(|figure| figure.map(|figure| figure.vertex));
    assert_eq!(places[..3], expected);
    assert_eq!(places[3], None);
    // Where they are in a strip is their value.
    let at = plots.worst[2].expect("an extremum");
    let vertex = |index: usize| script.polygon().vertex(index);
    let index = at.x as usize;
    let bend = discrete_curvature(vertex(index - 1), vertex(index), vertex(index + 1), true);
    assert_eq!(at.y, bend);
    // All of them are marked on the canvas, those of one vertex together.
    let marks = uneven(&mut script);
    let names: Vec<&str> = marks
        .iter()
        .flat_map(|(_, text)| text.split(", "))
        .collect();
    assert_eq!(names.len(), 3, "{names:?}");
    for (at, _) in marks {
        let vertices = script.polygon().vertices().to_vec();
        assert!(
            vertices.iter().any(|vertex| vertex.truncate() == at),
            "{at}"
        );
    }
    script.command(Command::ToggleLayer(Layer::Float));
    assert_eq!(uneven(&mut script), []);
    script.command(Command::ToggleLayer(Layer::Float));
    script.editor.view_mut().plot = Some(PlotKind::CURVATURE);
    assert_eq!(uneven(&mut script), []);
}

#[test]
fn the_state_before_stays_in_the_strips_while_something_is_tried() {
    let mut script = Script::example("hull");
    let before = strips(&mut script).flow;
    let at = script.at_vertex(6);
    script.press(at);
    script.move_to(at + DVec2::new(5.0, 20.0));
    assert!(script.plots().before.is_none());
    script.modifiers(Modifiers {
        alt: true,
        ..Modifiers::NONE
    });
    let plots = script.plots();
    assert_ne!(plots.flow, before);
    assert_eq!(
        plots.before.as_ref().map(|plots| &plots.flow),
        Some(&before)
    );
    script.modifiers(Modifiers::NONE);
    script.release(at + DVec2::new(5.0, 20.0));
    script.command(Command::Undo);
    assert_eq!(strips(&mut script).flow, before);
    script.try_out("round").expect("it can run");
    script.set("digits", Value::Whole(0)).expect("a value");
    let plots = script.plots();
    assert_eq!(
        plots.before.as_ref().map(|plots| &plots.flow),
        Some(&before)
    );
}

#[test]
fn two_curves_are_compared_in_the_same_strips() {
    let in_space = (0..12).map(|index| {
        let angle = 0.4 * f64::from(index);
        DVec3::new(angle.cos(), angle.sin(), 0.3 * angle)
    });
    let helix = FloatPolygon::new(5, in_space.collect(), None, false).expect("a polygon");
    let planar = Script::example("hull").polygon();
    let curves = [Curve::new("hull", planar), Curve::new("helix", helix)];
    let mut editor = Editor::with_document(Document::from_curves(curves));
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    let ids: Vec<_> = script.editor.document().ids().collect();
    script.editor.activate(ids[1]);
    script.editor.view_mut().plot = Some(STRIPS);
    script.command(Command::Compare(Some(ids[0])));
    let plots = script.plots().clone();
    let other = plots.compared.as_ref().expect("another curve");
    assert_eq!(plots.flow.each_ref().map(Vec::len), [11, 10, 10, 9]);
    assert_eq!(other.flow.each_ref().map(Vec::len), [15, 14, 14, 0]);
    // What the other curve does is followed.
    let moved = script.at_vertex_of(ids[0], 3);
    script.drag(moved, moved + DVec2::new(9.0, 9.0));
    script.editor.activate(ids[1]);
    let followed = script
        .plots()
        .compared
        .as_ref()
        .map(|plots| plots.flow.clone());
    assert_ne!(followed.expect("another curve"), other.flow);
    // A curve is not compared with itself, nor with one that is gone.
    script.editor.activate(ids[0]);
    assert!(script.plots().compared.is_none());
    script.command(Command::DeleteCurve);
    assert_eq!(script.editor.active(), Some(ids[1]));
    assert!(script.plots().compared.is_none());
}
