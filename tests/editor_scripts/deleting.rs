//! Deleting: only what is seen selected, never a curve by a command for vertices.

use batten::document::Document;
use batten::document::Edit;
use batten::editor::{Command, Editor, Key, Modifiers, Refusal, ToolKind};
use glam::DVec2;

use super::script::Script;
use super::several::two;

#[test]
fn after_a_leg_of_another_curve_is_dragged_delete_takes_nothing_unseen() {
    let (mut script, [arc, other]) = two();
    script.editor.activate(other);
    script.command(Command::SelectAll);
    assert_eq!(script.selected().len(), 9);
    let middle = 0.5 * (script.at_vertex_of(arc, 4) + script.at_vertex_of(arc, 5));
    script.drag(middle, middle + DVec2::new(20.0, -10.0));
    assert_eq!(script.curve(), arc);
    assert_eq!(script.selected(), [4, 5]);
    let before = script.editor.document().clone();
    script.command(Command::Delete);
    // Eight vertices would be no curve of degree 9: nothing changes, and nothing of the other.
    assert!(script.editor.document().is_same(&before));
    assert!(script.message().contains("too few"), "{}", script.message());
}

/// A way to remove what is selected.
type Removal = fn(&mut Editor) -> Result<(), Refusal>;

/// Nothing is removed, and reply and message name the command for curves.
fn check_refused(script: &mut Script, remove: Removal, before: &Document) {
    let Refusal(reason) = remove(&mut script.editor).expect_err("nothing is removed");
    assert!(script.editor.document().is_same(before));
    assert!(reason.contains("Delete curve"), "{reason}");
    assert_eq!(script.message(), reason);
}

#[test]
fn a_curve_is_removed_by_its_own_command_or_once_it_is_named() {
    let delete = |editor: &mut Editor| editor.execute(Command::Delete).map(|_| ());
    let cut = |editor: &mut Editor| editor.cut().map(|_| ());
    let mut script = Script::example("hull");
    let before = script.editor.document().clone();
    check_refused(&mut script, cut, &before);
    assert_eq!(delete(&mut script.editor), Ok(()));
    assert!(script.editor.document().is_same(&before));
    assert!(
        script.message().contains("Press Del again"),
        "{}",
        script.message()
    );
    script.command(Command::SelectAll);
    let removals: [Removal; 2] = [delete, cut];
    for remove in removals {
        check_refused(&mut script, remove, &before);
    }
}

#[test]
fn every_deletion_offers_to_be_undone() {
    let offers = |script: &Script| {
        let message = script.editor.message();
        message.is_some_and(|message| message.offers_undo && !message.is_error)
    };
    let mut script = Script::example("hull");
    let before = script.polygon();
    script.click(script.at_vertex(3));
    assert!(!offers(&script));
    script.command(Command::Delete);
    assert!(offers(&script), "{}", script.message());
    assert!(
        script.message().starts_with("1 vertex"),
        "{}",
        script.message()
    );
    script.command(Command::Undo);
    assert!(!offers(&script));
    script.click(script.at_vertex(3));
    assert!(script.editor.cut().is_ok());
    assert!(offers(&script), "{}", script.message());
    script.command(Command::Undo);
    script.tool(ToolKind::Delete);
    script.click(script.at_vertex(3));
    assert!(offers(&script), "{}", script.message());
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    script.command(Command::DeleteCurve);
    assert!(script.editor.document().is_empty());
    assert!(offers(&script), "{}", script.message());
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
}

#[test]
fn a_deletion_that_is_refused_offers_nothing() {
    let mut script = Script::example("hull");
    script.command(Command::ToggleLocked);
    script.tool(ToolKind::Delete);
    script.click(script.at_vertex(3));
    let message = script.editor.message().expect("a message");
    assert!(message.is_error && !message.offers_undo, "{message:?}");
    assert!(message.text.contains("locked"), "{message:?}");
}

#[test]
fn taking_the_last_vertex_of_the_active_curve_from_the_selection_activates_the_other() {
    let (mut script, [arc, other]) = two();
    script.click(script.at_vertex_of(arc, 0));
    script.modifiers(Modifiers::SHIFT);
    script.click(script.at_vertex_of(other, 8));
    assert_eq!(script.curve(), other);
    script.click(script.at_vertex_of(other, 8));
    assert_eq!(script.curve(), arc);
    assert_eq!(script.selected(), [0]);
}

#[test]
fn shift_click_on_another_curve_keeps_the_selection_and_its_curve() {
    let (mut script, [arc, other]) = two();
    script.click(script.at_vertex_of(arc, 0));
    script.modifiers(Modifiers::SHIFT);
    let polygon = script.editor.document().curve(other).expect("a curve");
    let place = polygon.polygon.point(2.3).truncate();
    script.click(script.editor.view().viewport().to_screen(place));
    assert_eq!(script.curve(), arc);
    assert_eq!(script.selected(), [0]);
    script.key(Key::Escape);
}

#[test]
fn hiding_the_active_curve_leaves_no_unseen_selection() {
    let (mut script, [arc, other]) = two();
    script.command(Command::SelectAll);
    script.command(Command::SelectAll);
    script
        .editor
        .change(Edit::SetVisible {
            curve: arc,
            visible: false,
        })
        .expect("a curve");
    assert_eq!(script.curve(), other);
    assert_eq!(script.selected().len(), 9);
}
