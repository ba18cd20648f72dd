//! Aligning and distributing: vertices, and curves with references as a whole.

use batten::document::{Curve, CurveId, Document, Edit};
use batten::editor::{Arrangement, Command, Editor, NamedView, VertexId};
use batten::geometry::{FloatPolygon, extent};
use glam::DVec3;

use super::script::Script;
use super::selecting_several::{self, hide};

/// What is rounded in a move, in units of the document's size.
const ROUNDING: f64 = 1e-12;

/// Four curves in space: of several heights, the third with a locked vertex, the last one locked.
fn four() -> (Script, Vec<CurveId>) {
    let curve = |name: &str, at: f64, height: f64| {
        let vertices = (0..8).map(|index| {
            let along = f64::from(index);
            DVec3::new(
                at + along,
                height * (1.3 * along).sin() + at,
                0.3 * along + at,
            )
        });
        let polygon = FloatPolygon::new(4, vertices.collect(), None, false).expect("a polygon");
        Curve::new(name, polygon)
    };
    let curves = [
        curve("a", 0.0, 1.0),
        curve("b", 9.0, 2.0),
        curve("c", 30.0, 0.5),
        curve("d", 45.0, 3.0),
    ];
    let document = Document::from_curves(curves);
    let ids: Vec<CurveId> = document.ids().collect();
    let lock = Edit::SetLocked {
        curve: ids[3],
        locked: true,
    };
    let document = document.edited([lock]).expect("a lock");
    let mut script = Script {
        editor: Editor::with_document(document),
    };
    script.command(Command::FitAll);
    (script, ids)
}

fn select(script: &mut Script, items: &[CurveId]) {
    script.editor.hand_mut().select_items(items.to_vec());
}

fn polygon(script: &Script, id: CurveId) -> FloatPolygon {
    script
        .editor
        .document()
        .curve(id)
        .expect("a curve")
        .polygon
        .clone()
}

fn extents(script: &Script, ids: &[CurveId], direction: DVec3) -> Vec<[f64; 2]> {
    ids.iter()
        .map(|id| extent(&polygon(script, *id), direction))
        .collect()
}

#[test]
fn curves_line_up_as_they_are_drawn_in_every_view() {
    let views = [
        (NamedView::Xy, [DVec3::X, DVec3::Y]),
        (NamedView::Xz, [DVec3::X, DVec3::Z]),
        (NamedView::Yz, [DVec3::Y, DVec3::Z]),
    ];
    for (view, axes) in views {
        for arrangement in Arrangement::ALL {
            let (mut script, ids) = four();
            script.command(Command::View(view));
            select(&mut script, &ids);
            let before: Vec<FloatPolygon> = ids.iter().map(|id| polygon(&script, *id)).collect();
            let steps = script.steps();
            script.command(Command::Arrange(arrangement));
            assert_eq!(script.steps(), steps + 1, "{view:?} {arrangement:?}");
            assert!(
                script.message().contains("“d” (locked) stays"),
                "{}",
                script.message()
            );
            assert_eq!(polygon(&script, ids[3]), before[3]);
            let along = match arrangement {
                Arrangement::AlignLeft
                | Arrangement::AlignCentre
                | Arrangement::AlignRight
                | Arrangement::DistributeAcross => axes[0],
                _ => axes[1],
            };
            let now = extents(&script, &ids[..3], along);
            let figure = |[low, high]: [f64; 2]| match arrangement {
                Arrangement::AlignLeft | Arrangement::AlignBottom => low,
                Arrangement::AlignRight | Arrangement::AlignTop => high,
                _ => 0.5 * (low + high),
            };
            let even: Vec<f64> = match arrangement {
                Arrangement::DistributeAcross | Arrangement::DistributeUp => {
                    now.windows(2).map(|pair| pair[1][0] - pair[0][1]).collect()
                }
                _ => now.iter().map(|it| figure(*it)).collect(),
            };
            let first = even[0];
            for other in &even {
                assert!(
                    (other - first).abs() <= ROUNDING * 100.0,
                    "{arrangement:?}: {even:?}"
                );
            }
            // Nothing changes its shape, or moves across.
            for (id, before) in ids.iter().zip(&before) {
                let now = polygon(&script, *id);
                let by = now.vertex(0) - before.vertex(0);
                assert!((by - by.dot(along) * along).length() <= ROUNDING * 100.0);
                for index in 0..now.vertices().len() {
                    let off = now.vertex(index) - before.vertex(index) - by;
                    assert!(off.length() <= ROUNDING * 100.0, "{off}");
                }
            }
            script.command(Command::Undo);
            for (id, before) in ids.iter().zip(&before) {
                assert_eq!(polygon(&script, *id), *before);
            }
        }
    }
}

#[test]
fn vertices_line_up_to_the_bit_and_locked_ones_stay() {
    let (mut script, ids) = four();
    let lock = Edit::SetVerticesLocked {
        curve: ids[0],
        vertices: vec![4],
        locked: true,
    };
    script.editor.change(lock).expect("a lock");
    let chosen: Vec<VertexId> = vec![(ids[0], 1), (ids[0], 4), (ids[1], 2), (ids[1], 5)];
    let pick = |script: &mut Script| {
        for (index, (curve, vertex)) in chosen.iter().enumerate() {
            script.editor.select_vertex(*curve, *vertex, index > 0);
        }
    };
    pick(&mut script);
    let before = [ids[0], ids[1]].map(|id| polygon(&script, id));
    script.command(Command::Arrange(Arrangement::AlignTop));
    let after = [ids[0], ids[1]].map(|id| polygon(&script, id));
    let highest = [
        before[0].vertex(1),
        before[1].vertex(2),
        before[1].vertex(5),
    ];
    let highest = highest
        .map(|it| it.y)
        .into_iter()
        .fold(f64::NEG_INFINITY, f64::max);
    for (polygon, was, index) in
        [(0, 0, 1), (1, 1, 2), (1, 1, 5)].map(|(a, b, index)| (&after[a], &before[b], index))
    {
        let [now, was] = [polygon, was].map(|it| it.vertex(index));
        assert_eq!(now, DVec3::new(was.x, highest, was.z));
    }
    assert_eq!(after[0].vertex(4), before[0].vertex(4));
    assert!(
        script.message().contains("1 locked vertex stays"),
        "{}",
        script.message()
    );
    script.command(Command::Undo);
    pick(&mut script);
    script.command(Command::Arrange(Arrangement::DistributeAcross));
    let mut xs = vec![
        polygon(&script, ids[0]).vertex(1).x,
        polygon(&script, ids[1]).vertex(2).x,
        polygon(&script, ids[1]).vertex(5).x,
    ];
    xs.sort_by(f64::total_cmp);
    assert!(
        (xs[2] - 2.0 * xs[1] + xs[0]).abs() <= ROUNDING * 100.0,
        "{xs:?}"
    );
}

#[test]
fn too_few_items_are_refused_and_nothing_changes() {
    let (mut script, ids) = four();
    let arrange = |script: &mut Script| {
        script
            .editor
            .execute(Command::Arrange(Arrangement::AlignLeft))
    };
    select(&mut script, &ids[..1]);
    assert!(!Command::Arrange(Arrangement::AlignLeft).is_enabled(&script.editor));
    select(&mut script, &[ids[2], ids[3]]);
    let before = script.editor.document().clone();
    let refusal = arrange(&mut script).expect_err("one of two is locked");
    assert_eq!(refusal.0, "Select 2 unlocked vertices, or as many curves");
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn a_circle_and_a_curve_line_up_and_a_hidden_curve_stays() {
    let (mut script, [arc, other, short, circle]) = selecting_several::four();
    hide(&mut script, other);
    select(&mut script, &[arc, other, short, circle]);
    let before = script.editor.document().clone();
    script.command(Command::Arrange(Arrangement::AlignRight));
    let after = script.editor.document();
    let reference = after.reference(circle).expect("the circle");
    let [_, right] = extent(&reference.curve, DVec3::X);
    for id in [arc, short] {
        let own = extent(&polygon(&script, id), DVec3::X);
        assert!((own[1] - right).abs() <= ROUNDING * 100.0);
    }
    assert_eq!(after.curve(other), before.curve(other));
    assert!(
        script.message().contains("(hidden) stays"),
        "{}",
        script.message()
    );
}
