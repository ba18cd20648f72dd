//! The paper's figures as documents.

use batten::document::Edit;
use batten::editor::{Command, Editor, ToolKind};
use batten::geometry::features::{Feature, Features};
use batten::geometry::paper::{RoundingTest, Shortening};
use batten::geometry::{End, FloatPolygon};
use batten::operations::Value;
use batten::paper::{Block, PaperPage, has_shortened, show_shortened, spiral_deviations};
use glam::{DVec2, DVec3};

use super::script::Script;

/// How near ends come to their targets, relative to the curve's size.
const EXACT: f64 = 1e-14;

fn opened(page: PaperPage) -> Script {
    let mut script = Script::example("s-curve");
    page.open(&mut script.editor).expect("a page");
    script.check();
    script
}

fn polygons(editor: &Editor) -> Vec<FloatPolygon> {
    let curves = editor.document().curves();
    curves.map(|(_, curve)| curve.polygon.clone()).collect()
}

fn extrema(polygon: &FloatPolygon) -> usize {
    let features = Features::new(polygon);
    assert!(features.undecided.is_empty());
    features.count(Feature::CurvatureExtremum)
}

#[test]
fn every_page_opens_its_curves_unmodified() {
    for page in PaperPage::ALL {
        let script = opened(page);
        assert!(!script.editor.document().is_empty(), "{page:?}");
        assert!(!script.editor.workspace().is_modified(), "{page:?}");
        assert_eq!(PaperPage::ALL[page.place()], page);
        // A second curve is compared with the first.
        let compared = script.editor.sight().compared();
        let document = script.editor.document();
        let shown = document.len() + document.references().len();
        let compares = shown > 1 && page != PaperPage::Composite;
        assert_eq!(compared.is_some(), compares);
        assert!(compared.is_none() || compared != script.editor.active());
    }
}

#[test]
fn every_page_has_a_title_text_and_one_place_for_its_figures() {
    for page in PaperPage::ALL {
        assert!(!page.title().is_empty() && !page.title().starts_with('#'));
        let blocks: Vec<Block> = page.blocks().collect();
        let figures = blocks.iter().filter(|block| **block == Block::Figures);
        let expected = match page {
            PaperPage::Steps | PaperPage::Typical | PaperPage::Composite => 0,
            _ => 1,
        };
        assert_eq!(figures.count(), expected, "{page:?}");
        assert!(matches!(blocks.first(), Some(Block::Text(_))), "{page:?}");
        assert!(matches!(blocks.last(), Some(Block::Note(_))), "{page:?}");
    }
}

#[test]
fn digits_that_are_dragged_leave_nothing_to_save_but_after_an_edit_they_are_a_step() {
    let mut script = opened(PaperPage::Rounding);
    let arc = RoundingTest::arc().expect("an arc");
    assert_eq!(script.polygon(), arc);
    let drag = |script: &mut Script| {
        for digits in [6, 4, 3] {
            let test = RoundingTest::new(digits, Shortening::CutOff).expect("a test");
            show_shortened(&mut script.editor, &test);
            assert_eq!(script.polygon(), test.polygon);
        }
        script.editor.commit_preview();
        assert_eq!(polygons(&script.editor)[0], arc, "the other curve stays");
    };
    let curve = script.curve();
    drag(&mut script);
    assert_eq!((script.curve(), script.steps()), (curve, 0));
    assert!(!script.editor.workspace().is_modified());
    assert!(!Command::Undo.is_enabled(&script.editor));

    let test = RoundingTest::new(9, Shortening::CutOff).expect("a test");
    show_shortened(&mut script.editor, &test);
    for visible in [false, true] {
        script
            .editor
            .change(Edit::SetVisible { curve, visible })
            .expect("an edit");
    }
    let steps = script.steps();
    drag(&mut script);
    assert_eq!(script.steps(), steps + 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), test.polygon);
}

#[test]
fn the_rounding_test_waits_for_a_curve_that_it_knows() {
    let mut script = opened(PaperPage::Rounding);
    assert!(has_shortened(&script.editor));
    script.command(Command::ToggleLocked);
    assert!(!has_shortened(&script.editor));
    let before = script.editor.document().clone();
    let test = RoundingTest::new(3, Shortening::Rounded).expect("a test");
    show_shortened(&mut script.editor, &test);
    assert!(script.editor.document().is_same(&before));
    script.command(Command::ToggleLocked);
    script
        .operate("subdivide", &[])
        .expect("it can be subdivided");
    assert!(!has_shortened(&script.editor));
}

#[test]
fn circles_open_in_the_degree_that_was_asked_for() {
    for degree in [2, 3, 15] {
        let script = opened(PaperPage::Circles { degree });
        let degrees = polygons(&script.editor);
        let degrees: Vec<usize> = degrees.iter().map(|polygon| polygon.degree()).collect();
        assert_eq!(degrees, [degree, degree]);
    }
}

#[test]
fn the_seven_steps_reach_the_targets_that_the_page_sets() {
    let mut script = opened(PaperPage::Steps);
    assert_eq!(script.editor.hand().tool(), ToolKind::EndFit);
    let polygon = script.polygon();
    assert!(polygon.vertices().len() >= 2 * polygon.degree());
    for end in ["start", "end"] {
        let which = [("end", Value::Choice(usize::from(end == "end")))];
        for step in ["translate-end", "rotate-end"] {
            script.operate(step, &which).expect("a step");
        }
    }
    let curve = script.curve();
    let curve = script.editor.document().curve(curve).expect("a curve");
    for end in [End::Start, End::Finish] {
        let jet = curve.polygon.jet(end.parameter(&curve.polygon));
        let target = curve.targets.get(end).expect("a target");
        let left = jet.point.distance(target.point);
        assert!(left <= EXACT * curve.polygon.size(), "{end:?}: {left}");
        let direction = target.direction.expect("a direction").normalize();
        let off = jet.first.normalize().distance(direction);
        assert!(off <= EXACT, "{end:?}: {off}");
    }
}

#[test]
fn figure_2_has_a_monotone_curve_and_one_that_is_not() {
    let script = opened(PaperPage::Typical);
    let counts: Vec<usize> = polygons(&script.editor).iter().map(extrema).collect();
    assert_eq!(counts, [0, 1]);
    // The Bézier curve's float polygon lies far away; both curves and the polygon that they share are well seen.
    let viewport = script.editor.view().viewport();
    let [shared, bezier] = polygons(&script.editor).try_into().expect("two curves");
    let seen = |point: DVec3| viewport.to_screen(viewport.flatten(point));
    let corners: Vec<DVec2> = shared.vertices().iter().copied().map(seen).collect();
    let end = seen(bezier.point(1.0));
    for place in corners.iter().chain([&end]) {
        let is_inside =
            place.cmpge(DVec2::ZERO).all() && place.cmple(DVec2::new(1000.0, 700.0)).all();
        assert!(is_inside, "{place}");
    }
    let height = corners.iter().fold(0.0_f64, |most, place| {
        most.max((place.y - corners[0].y).abs())
    });
    assert!(height > 300.0, "{height}");
}

#[test]
fn the_composite_is_both_of_its_parts_and_monotone() {
    let script = opened(PaperPage::Composite);
    let [composite, first, second] = polygons(&script.editor).try_into().expect("three curves");
    let vertices = composite.vertices();
    let (before, after) = (first.vertices(), second.vertices());
    assert_eq!(vertices.len(), before.len() + 5 + after.len());
    assert!(vertices.starts_with(before) && vertices.ends_with(after));
    assert_eq!(extrema(&composite), 0);
}

#[test]
fn figure_3_keeps_its_place_by_quasi_interpolation() {
    for (vertices, quasi) in [(20, 0.0012), (32, 1.7e-6)] {
        let [on_curve, placed] = spiral_deviations(vertices).expect("a spiral");
        assert!(placed < quasi, "{vertices}: {placed}");
        let far = if vertices == 20 { 4.85..4.95 } else { 1.0..2.0 };
        assert!(far.contains(&on_curve), "{vertices}: {on_curve}");
    }
    let script = opened(PaperPage::Spiral { vertices: 20 });
    let polygon = script.polygon();
    assert_eq!((polygon.degree(), polygon.vertices().len()), (8, 20));
    let first = polygons(&script.editor)[0].vertex(0);
    assert!(first.distance(DVec3::new(2.0, 2.0, 0.0)) < EXACT, "{first}");
    // The next page is seen from above again, by the tool that selects.
    let mut script = script;
    PaperPage::Arc.open(&mut script.editor).expect("a page");
    assert!(!script.editor.sight().is_orbited());
    assert_eq!(script.editor.hand().tool(), ToolKind::Select);
}
