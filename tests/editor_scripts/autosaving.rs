//! What is not saved, kept for the case of a crash and recovered; files that others change.

use std::fs;
use std::path::PathBuf;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use batten::editor::{Command, Editor};
use batten::io::{Sessions, disk};
use glam::DVec2;
use tempfile::TempDir;

use super::script::Script;

const PERIOD: Duration = Duration::from_secs(30);

/// How the vertices are dragged here.
const BY: DVec2 = DVec2::new(40.0, 30.0);

/// A folder for sessions and files, and the time, which the tests let pass.
struct Desk {
    folder: TempDir,
    now: Instant,
}

impl Desk {
    fn new() -> Self {
        Self {
            folder: tempfile::tempdir().expect("a folder"),
            now: Instant::now(),
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn sessions(&self) -> Sessions {
        Sessions::in_folder(self.path("sessions"))
    }

    /// A window with the arc.
    fn window(&self) -> Script {
        let mut script = Script::example("arc");
        script.editor.autosave_in(self.sessions(), PERIOD);
        script
    }

    /// Show a frame after some seconds.
    fn pass(&mut self, seconds: u64, script: &mut Script) -> Option<Duration> {
        self.now += Duration::from_secs(seconds);
        script.editor.autosave(self.now, false)
    }

    /// The autosaves that lie in the folder: their revisions.
    fn autosaves(&self) -> Vec<u64> {
        let folders = fs::read_dir(self.path("sessions")).into_iter().flatten();
        let paths = folders.map(|folder| folder.expect("a folder").path().join("autosave"));
        let found = paths.filter_map(|path| fs::read(path).ok());
        let mut revisions: Vec<u64> = found
            .map(|bytes| {
                let (origin, _) = batten::io::autosave::read(&bytes).expect("an autosave");
                origin.revision
            })
            .collect();
        revisions.sort();
        revisions
    }

    /// End a window as a crash does.
    fn crash(script: Script) {
        drop(script);
    }
}

/// Whether the document's file holds something else than when it was last read or written.
fn is_file_changed(script: &Script) -> bool {
    let workspace = script.editor.workspace();
    let found = workspace.path().and_then(disk::fingerprint);
    found.is_some() && found != workspace.fingerprint()
}

fn drag(script: &mut Script, vertex: usize) {
    script.drag_vertex(vertex, BY);
}

#[test]
fn changes_are_written_once_within_the_period() {
    let mut desk = Desk::new();
    let mut script = desk.window();
    assert_eq!(desk.pass(0, &mut script), None, "nothing to write");
    assert_eq!(desk.pass(100, &mut script), None);
    assert!(desk.autosaves().is_empty());

    drag(&mut script, 4);
    let wait = desk
        .pass(0, &mut script)
        .expect("there is something to write");
    assert!(wait < PERIOD && wait > PERIOD / 2, "{wait:?}");
    desk.pass(20, &mut script);
    assert!(desk.autosaves().is_empty());
    // Later changes do not put it off.
    drag(&mut script, 5);
    desk.pass(9, &mut script);
    let revision = script.editor.workspace().revision();
    assert_eq!(desk.autosaves(), [revision]);
    assert_eq!(desk.pass(1, &mut script), None, "nothing has changed since");

    drag(&mut script, 5);
    desk.pass(0, &mut script);
    desk.pass(29, &mut script);
    assert_eq!(desk.autosaves(), [script.editor.workspace().revision()]);
}

#[test]
fn changes_are_written_at_once_when_the_window_loses_the_keyboard() {
    let desk = Desk::new();
    let mut script = desk.window();
    script.editor.autosave(desk.now, true);
    assert!(desk.autosaves().is_empty());
    drag(&mut script, 4);
    script.editor.autosave(desk.now, true);
    assert_eq!(desk.autosaves().len(), 1);
}

#[test]
fn nothing_stays_of_what_is_saved_undone_discarded_or_closed() {
    let mut desk = Desk::new();
    for end in 0..4 {
        let mut script = desk.window();
        drag(&mut script, 4);
        desk.pass(0, &mut script);
        desk.pass(30, &mut script);
        assert_eq!(desk.autosaves().len(), 1);
        match end {
            0 => {
                let saved = script.editor.save(&desk.path("arc.batten"));
                saved.expect("a file");
            }
            1 => script.command(Command::Undo),
            2 => script.editor.begin_empty(),
            _ => script.editor.recovery_mut().close(),
        }
        desk.pass(0, &mut script);
        assert!(desk.autosaves().is_empty(), "{end}");
        Desk::crash(script);
        let found = Editor::new();
        assert!(
            found.recovery().recoverable().is_empty() && desk.sessions().abandoned().is_empty()
        );
    }
    let left = fs::read_dir(desk.path("sessions")).expect("the folder");
    assert_eq!(left.count(), 0);
}

#[test]
fn an_autosave_holds_what_a_save_would_write() {
    let mut desk = Desk::new();
    let mut script = desk.window();
    let original = script.polygon();
    // Only the drag is not saved.
    script.press(script.at_vertex(4));
    script.move_to(script.at_vertex(4) + BY);
    assert_ne!(script.polygon(), original);
    desk.pass(0, &mut script);
    desk.pass(30, &mut script);
    assert!(desk.autosaves().is_empty());
    script.release(script.at_vertex(4));
    let dragged = script.polygon();
    script.press(script.at_vertex(6));
    script.move_to(script.at_vertex(6) + BY);
    desk.pass(0, &mut script);
    desk.pass(30, &mut script);
    Desk::crash(script);
    let mut script = desk.window();
    script.editor.recover(0).expect("a document");
    assert_eq!(script.polygon(), dragged);
}

#[test]
fn several_crashed_sessions_are_offered_and_recovered() {
    let mut desk = Desk::new();
    let path = desk.path("arc.batten");
    let mut scripts = [desk.window(), desk.window(), desk.window()];
    scripts[1].editor.save(&path).expect("a file");
    for (vertex, script) in scripts.iter_mut().enumerate() {
        drag(script, vertex + 3);
        desk.pass(0, script);
        desk.pass(30, script);
    }
    assert!(
        desk.window().editor.recovery().recoverable().is_empty(),
        "they run"
    );
    let polygons: Vec<_> = scripts.iter().map(Script::polygon).collect();
    scripts.into_iter().for_each(Desk::crash);

    let mut script = desk.window();
    assert!(
        desk.window().editor.recovery().recoverable().is_empty(),
        "offered once"
    );
    let found = script.editor.recovery().recoverable();
    assert_eq!(found.len(), 3);
    for found in found {
        let content = found.content.as_ref().expect("a document");
        assert_eq!(
            (content.curves, content.vertices),
            (1, polygons[0].vertices().len())
        );
        assert!(!content.is_file_changed && content.picture[0].len() > 50);
    }
    let named = found.iter().position(|found| {
        let content = found.content.as_ref().expect("a document");
        content.name.as_deref() == Some("arc.batten")
    });
    let id = script.editor.recovery().recoverable()[named.expect("the saved one")].id;
    script.editor.recover(id).expect("a document");
    script.check();
    assert_eq!(script.polygon(), polygons[1]);
    assert_eq!(script.editor.workspace().path(), Some(path.as_path()));
    assert!(script.editor.workspace().is_modified() && !is_file_changed(&script));
    script.command(Command::Undo);
    assert!(
        script.editor.workspace().is_modified(),
        "it was never saved"
    );

    // The other two are offered again, and so is this one should it crash now.
    desk.pass(0, &mut script);
    assert_eq!(desk.autosaves().len(), 3);
    Desk::crash(script);
    let mut script = desk.window();
    assert_eq!(script.editor.recovery().recoverable().len(), 3);
    for id in [0, 2] {
        script.editor.recovery_mut().discard(id);
    }
    assert_eq!(desk.autosaves().len(), 1);
    script.editor.recover(1).expect("a document");
    script.editor.save(&path).expect("a file");
    desk.pass(0, &mut script);
    assert!(desk.autosaves().is_empty());
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn a_recovered_document_that_is_given_up_is_gone() {
    let mut desk = Desk::new();
    let mut script = desk.window();
    drag(&mut script, 4);
    script.editor.autosave(desk.now, true);
    Desk::crash(script);
    let mut script = desk.window();
    script.editor.recover(0).expect("a document");
    desk.pass(0, &mut script);
    script.editor.begin_empty();
    desk.pass(0, &mut script);
    Desk::crash(script);
    assert!(desk.autosaves().is_empty());
}

#[test]
fn a_damaged_autosave_is_told_and_can_be_discarded() {
    let desk = Desk::new();
    for damage in [
        "",
        "{",
        "{}\n{}",
        "{\"format\": \"batten autosave\", \"version\": 9}\n",
    ] {
        let mut script = desk.window();
        drag(&mut script, 4);
        script.editor.autosave(desk.now, true);
        Desk::crash(script);
        let folders = fs::read_dir(desk.path("sessions")).expect("the folder");
        for folder in folders {
            let path = folder.expect("a session").path().join("autosave");
            fs::write(path, damage).expect("damage");
        }
        let mut script = desk.window();
        let original = script.polygon();
        let [found] = script.editor.recovery().recoverable() else {
            panic!("one damaged autosave");
        };
        let error = found.content.as_ref().expect_err("damaged").to_string();
        assert!(error.contains("autosave"), "{error}");
        // Opening it is refused, and loses nothing.
        let id = found.id;
        script.editor.recover(id).expect_err("damaged");
        assert_eq!(script.polygon(), original);
        Desk::crash(script);
        let mut script = desk.window();
        assert_eq!(script.editor.recovery().recoverable().len(), 1);
        script.editor.recovery_mut().discard(id);
        Desk::crash(script);
        assert!(desk.window().editor.recovery().recoverable().is_empty());
    }
}

#[test]
fn what_cannot_be_written_is_told_once_and_tried_again() {
    let mut desk = Desk::new();
    let mut script = desk.window();
    drag(&mut script, 4);
    desk.pass(0, &mut script);
    fs::remove_dir_all(desk.path("sessions")).expect("the folder");
    assert!(desk.pass(29, &mut script).is_some(), "it tries again");
    let message = script.message();
    assert!(
        message.starts_with("Changes are not kept for a crash"),
        "{message}"
    );
    script.editor.dismiss_message();
    assert!(desk.pass(30, &mut script).is_some());
    assert_eq!(script.message(), "", "told once");
}

#[test]
fn writing_beside_the_frame_comes_to_the_same() {
    let mut desk = Desk::new();
    let mut script = desk.window();
    let (sender, woken) = channel();
    let wake = move || sender.send(()).unwrap_or_default();
    script.editor.run_in_background(Duration::ZERO, wake);
    drag(&mut script, 4);
    desk.pass(0, &mut script);
    desk.pass(29, &mut script);
    while desk.autosaves().is_empty() {
        woken
            .recv_timeout(Duration::from_secs(60))
            .expect("it wakes");
    }
    // From another thread, as when a signal comes, the newest is written.
    drag(&mut script, 5);
    desk.pass(0, &mut script);
    let autosaver = script
        .editor
        .recovery()
        .autosaver()
        .cloned()
        .expect("a session");
    let written = std::thread::spawn(move || autosaver.write()).join();
    written.expect("no panic").expect("an autosave");
    assert_eq!(desk.autosaves(), [script.editor.workspace().revision()]);
}

#[test]
fn a_panic_keeps_what_is_not_saved() {
    let desk = Desk::new();
    let mut script = desk.window();
    let now = desk.now;
    let panicked = std::thread::spawn(move || {
        drag(&mut script, 4);
        script.editor.autosave(now, false);
        panic!("on purpose");
    });
    panicked.join().expect_err("a panic");
    assert_eq!(desk.autosaves().len(), 1);
}

#[test]
fn a_file_that_another_program_changes_is_noticed() {
    let desk = Desk::new();
    let path = desk.path("arc.batten");
    let mut script = Script::example("arc");
    script.editor.save(&path).expect("a file");
    assert!(!is_file_changed(&script));
    script.editor.look_at_file();
    script.editor.begin_frame();
    assert_eq!(script.message(), format!("Saved to {}", path.display()));

    // Of the same length, within the same instant.
    let text = fs::read_to_string(&path).expect("the file");
    fs::write(&path, text.replace("\"degree\": 9", "\"degree\": 8")).expect("the file");
    assert!(is_file_changed(&script));
    script.editor.look_at_file();
    script.editor.begin_frame();
    let message = script.editor.message().expect("a message");
    assert!(message.offers_reload && !message.is_error);
    assert_eq!(message.text, "Another program has changed “arc.batten”");
    script.editor.dismiss_message();
    script.editor.look_at_file();
    script.editor.begin_frame();
    assert_eq!(script.message(), "", "told once");

    // Saving to the own file is refused, and writes nothing.
    script.editor.save_unless_changed().expect_err("changed");
    let reply = script.editor.filing_mut().take_reply().expect("a reply");
    assert!(reply.is_file_changed && is_file_changed(&script));

    script.editor.save(&path).expect("overwritten");
    assert!(!is_file_changed(&script));
    // The same change once more, after the own save: it is told again.
    fs::write(&path, text.replace("\"degree\": 9", "\"degree\": 8")).expect("the file");
    script.editor.look_at_file();
    script.editor.begin_frame();
    assert!(script.editor.message().is_some_and(|it| it.offers_reload));
    script.editor.save(&path).expect("overwritten");
    fs::write(&path, text.replace("\"degree\": 9", "\"degree\": 8")).expect("the file");
    script
        .editor
        .open(std::slice::from_ref(&path))
        .expect("a file");
    assert!(!is_file_changed(&script));
    assert_eq!(script.polygon().degree(), 8);

    // What is not there cannot be overwritten.
    fs::remove_file(&path).expect("the file");
    assert!(!is_file_changed(&script));
}

#[test]
fn a_recovered_document_knows_that_its_file_has_changed_since() {
    let desk = Desk::new();
    let path = desk.path("arc.batten");
    let mut script = desk.window();
    script.editor.save(&path).expect("a file");
    drag(&mut script, 4);
    script.editor.autosave(desk.now, true);
    Desk::crash(script);
    let mut text = fs::read_to_string(&path).expect("the file");
    text.push('\n');
    fs::write(&path, text).expect("the file");
    let mut script = desk.window();
    let content = script.editor.recovery().recoverable()[0].content.as_ref();
    assert!(content.expect("a document").is_file_changed);
    script.editor.recover(0).expect("a document");
    assert!(is_file_changed(&script));
}

#[test]
fn a_second_window_on_a_file_says_so() {
    let mut desk = Desk::new();
    let path = desk.path("arc.batten");
    let mut first = desk.window();
    first.editor.save(&path).expect("a file");
    desk.pass(0, &mut first);
    let line = "Another window has this file open: the last save wins";

    let mut second = desk.window();
    second
        .editor
        .open(std::slice::from_ref(&path))
        .expect("a file");
    assert!(second.message().ends_with(line), "{}", second.message());
    // As when the path is given to the program.
    let mut third = Script::example("arc");
    third
        .editor
        .open(std::slice::from_ref(&path))
        .expect("a file");
    third.editor.autosave_in(desk.sessions(), PERIOD);
    assert!(third.message().ends_with(line), "{}", third.message());
    assert!(
        third.message().starts_with("1 curve read"),
        "{}",
        third.message()
    );
    // Both go on.
    drag(&mut second, 4);
    second.editor.save(&path).expect("a file");
    assert!(!second.message().contains(line), "told once");
    assert!(is_file_changed(&first));

    first.editor.begin_empty();
    desk.pass(0, &mut first);
    Desk::crash(third);
    second
        .editor
        .open(std::slice::from_ref(&path))
        .expect("a file");
    assert!(!second.message().contains(line), "{}", second.message());
}

#[test]
fn saving_in_mid_drag_writes_the_state_before_and_lets_the_drag_go_on() {
    let desk = Desk::new();
    let path = desk.path("arc.batten");
    let mut script = Script::example("arc");
    let original = script.polygon();
    let at = script.at_vertex(4);
    script.press(at);
    script.move_to(at + BY);
    script.editor.save(&path).expect("a file");
    let read = || disk::read_file(&path).expect("the file").curves;
    assert_eq!(read()[0].polygon, original);
    assert!(script.editor.hand().is_dragging());
    script.move_to(at + 2.0 * BY);
    script.release(at + 2.0 * BY);
    script.check();
    let dragged = script.polygon();
    let moved = dragged.vertex(4) - original.vertex(4);
    assert!(moved.x > 0.0 && script.editor.workspace().is_modified());
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert!(!script.editor.workspace().is_modified(), "as it was saved");
    script.command(Command::Redo);
    script.editor.save(&path).expect("a file");
    assert_eq!(read()[0].polygon, dragged);
}

#[test]
fn a_slow_save_does_not_hold_the_frame_and_saves_the_state_of_its_request() {
    let desk = Desk::new();
    let path = desk.path("arc.batten");
    let mut script = Script::example("arc");
    let (sender, woken) = channel();
    let wake = move || sender.send(()).unwrap_or_default();
    script.editor.run_in_background(Duration::ZERO, wake);
    let saved = script.polygon();
    let note = script.editor.save(&path).expect("begun");
    // Without patience the frame goes on at once. The save may be finished by now all the same.
    assert!(note.text == "Saving arc.batten…" || note.text.starts_with("Saved to"));
    if script.editor.filing().work().is_some() {
        assert_eq!(script.message(), "Saving arc.batten…");
    }
    drag(&mut script, 4);
    while script.editor.filing().work().is_some() {
        woken
            .recv_timeout(Duration::from_secs(60))
            .expect("it wakes");
        script.editor.begin_frame();
    }
    let reply = script
        .editor
        .filing_mut()
        .take_reply()
        .expect("the final reply");
    assert!(reply.reply.expect("saved").text.starts_with("Saved to"));
    let written = disk::read_file(&path).expect("the file").curves;
    assert_eq!(written[0].polygon, saved);
    assert!(
        script.editor.workspace().is_modified(),
        "the drag is not saved"
    );
    script.command(Command::Undo);
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn an_empty_document_is_not_kept_for_recovery() {
    let mut desk = Desk::new();
    let mut script = desk.window();
    drag(&mut script, 4);
    desk.pass(0, &mut script);
    desk.pass(40, &mut script);
    assert_eq!(desk.autosaves().len(), 1);
    script.command(Command::DeleteCurve);
    assert!(script.editor.document().is_empty());
    desk.pass(0, &mut script);
    desk.pass(40, &mut script);
    assert!(desk.autosaves().is_empty());
    Desk::crash(script);
    let next = desk.window();
    assert!(next.editor.recovery().recoverable().is_empty());
}
