//! Groups of curves and references, and undo.

use batten::document::{CurveId, Edit, Group};
use batten::editor::{Command, told};
use batten::operations::Value;

use super::script::Script;

/// The groups of all curves, then of all references.
fn groups(script: &Script) -> Vec<String> {
    let document = script.editor.document();
    let groups = document.all_ids().filter_map(|id| document.group(id));
    groups.map(Group::to_string).collect()
}

fn group(script: &mut Script, curve: CurveId, path: &str) {
    let group = path.into();
    told(script.editor.change(Edit::SetGroup { curve, group }));
}

#[test]
fn moving_to_a_group_and_renaming_it_are_steps() {
    let mut script = Script::example("hull");
    let curve = script.curve();
    group(&mut script, curve, "Hull/Port");
    assert_eq!(groups(&script)[0], "Hull/Port");
    assert_eq!(
        script.editor.workspace().history().undo_label(),
        Some("Move to group")
    );
    let (from, to) = (Group::from("Hull"), Group::from("Ship/Hull"));
    told(script.editor.change(Edit::RenameGroup { group: from, to }));
    assert_eq!(groups(&script)[0], "Ship/Hull/Port");
    assert_eq!(
        script.editor.workspace().history().undo_label(),
        Some("Rename group")
    );
    assert_eq!(script.steps(), 2);
    script.command(Command::Undo);
    assert_eq!(groups(&script)[0], "Hull/Port");
    script.command(Command::Undo);
    assert_eq!(groups(&script)[0], "");
    script.command(Command::Redo);
    assert_eq!(groups(&script)[0], "Hull/Port");
    let (from, to) = (Group::from("Deck"), Group::from("Hull"));
    let refused = script.editor.change(Edit::RenameGroup { group: from, to });
    assert!(refused.is_err());
    assert_eq!(script.message(), "there is no group “Deck”");
}

#[test]
fn copies_and_parts_stay_in_the_group() {
    let mut script = Script::example("s-curve");
    let curve = script.curve();
    group(&mut script, curve, "Deck");
    script.command(Command::Duplicate);
    assert_eq!(groups(&script), ["Deck"; 2]);
    let text = script
        .editor
        .copy(batten::editor::CopyForm::Own)
        .expect("the text of a curve");
    script.editor.paste(&text).expect("a copy");
    assert_eq!(groups(&script), ["Deck"; 3]);
    let at = [("at", Value::Real(1.0))];
    script.operate("split", &at).expect("two parts");
    assert_eq!(groups(&script), ["Deck"; 4]);
    script.undo_all();
    assert_eq!(groups(&script), [""]);
}

#[test]
fn a_locked_and_hidden_curve_moves_to_a_group() {
    let mut script = Script::example("arc");
    let curve = script.curve();
    let edits = vec![
        Edit::SetLocked {
            curve,
            locked: true,
        },
        Edit::SetVisible {
            curve,
            visible: false,
        },
    ];
    script.editor.apply("Lock and hide", edits).expect("edits");
    group(&mut script, curve, "Deck");
    assert_eq!(groups(&script), ["Deck"]);
}
