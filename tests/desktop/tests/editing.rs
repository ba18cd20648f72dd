//! `batten edit` as another program calls it: a script sends a drawing, waits for the window and takes the result back
//! if it was saved.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use batten::document::Curve;
use batten::io::{disk, examples::EXAMPLES};
use batten_desktop_tests::arc::{arc, place};
use batten_desktop_tests::{Display, Start, Window};
use egui::{Key, Modifiers, vec2};

/// The other program. It has no search path, so it names its programs in full.
const HOST: &str = r#"program=$1 drawing=$2
sent="$drawing.sent.step"
/bin/cp "$drawing" "$sent"
"$program" edit --alone "$sent" &
echo $! > "$drawing.pid"
wait $!
code=$?
if [ $code = 0 ]; then /bin/cp "$sent" "$drawing"; fi
exit $code
"#;

/// A drawing with the arc, in the hands of the other program.
struct Host {
    window: Window,
    /// The folder, which stays until the drawing is read.
    home: Rc<tempfile::TempDir>,
    drawing: PathBuf,
    before: Vec<u8>,
}

impl Host {
    fn open(display: &mut Display) -> Result<Self> {
        let home = Rc::new(tempfile::tempdir()?);
        let script = home.path().join("host.sh");
        fs::write(&script, HOST)?;
        let drawing = home.path().join("arc.step");
        let document = EXAMPLES[0].read()?.into_document()?;
        disk::write_document(&drawing, &document, None)?;
        let before = fs::read(&drawing)?;
        let start = Start {
            command: &["/bin/sh", &script.to_string_lossy()],
            arguments: &[&drawing.to_string_lossy()],
            ..Start::default()
        };
        let mut window = Window::open_at(display, home.clone(), start)?;
        window.resize(1480, 920)?;
        window.key(Key::H, Modifiers::NONE)?;
        Ok(Self {
            window,
            home,
            drawing,
            before,
        })
    }

    /// Drag a vertex.
    fn drag(&mut self) -> Result<()> {
        let canvas = self.window.find("Canvas")?;
        let from = place(canvas, &arc(), 4);
        self.window.drag(from, from + vec2(30.0, 30.0))
    }

    fn save(&mut self) -> Result<()> {
        self.window.key(Key::S, Modifiers::COMMAND)
    }

    /// Close the window, and return the exit code of the host and the drawing that it has then.
    fn close(mut self) -> Result<(Option<i32>, Vec<u8>)> {
        self.window.send_last(quit());
        self.ended()
    }

    fn ended(self) -> Result<(Option<i32>, Vec<u8>)> {
        let status = self.window.exit_status()?;
        let drawing = fs::read(&self.drawing)?;
        drop(self.home);
        Ok((status.code(), drawing))
    }

    fn sent(&self) -> PathBuf {
        self.drawing.with_extension("step.sent.step")
    }

    /// The process of the window.
    fn process(&self) -> Result<String> {
        let text = fs::read_to_string(self.drawing.with_extension("step.pid"))?;
        Ok(text.trim().to_owned())
    }
}

/// The keys that leave the program.
fn quit() -> Vec<egui::Event> {
    let event = |pressed| egui::Event::Key {
        key: Key::Q,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::COMMAND,
    };
    vec![event(true), event(false)]
}

fn curve_in(bytes: &[u8]) -> Result<Arc<Curve>> {
    let format = batten::io::formats::find("step").context("STEP is known")?;
    let curves = format.read(bytes)?.curves;
    curves.into_iter().next().context("a curve")
}

#[test]
fn what_is_saved_goes_back() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let mut host = Host::open(&mut display)?;
    host.drag()?;
    host.save()?;
    host.window.find_beginning("Saved to")?;
    let before = curve_in(&host.before)?;
    let (code, after) = host.close()?;
    ensure!(code == Some(0), "{code:?}");
    let after = curve_in(&after)?;
    ensure!(after.name == before.name, "{}", after.name);
    let moved = after.polygon.vertex(4).distance(before.polygon.vertex(4));
    ensure!(moved > 0.1, "it has moved by {moved}");
    let kept = after.polygon.vertex(8).distance(before.polygon.vertex(8));
    ensure!(
        kept < 1e-6 * before.polygon.size(),
        "another has moved by {kept}"
    );
    Ok(())
}

#[test]
fn closing_without_saving_tells_it() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let host = Host::open(&mut display)?;
    let before = host.before.clone();
    let (code, after) = host.close()?;
    ensure!(code == Some(3), "{code:?}");
    ensure!(after == before, "the drawing has changed");

    let mut host = Host::open(&mut display)?;
    host.drag()?;
    let before = host.before.clone();
    host.window.key(Key::Q, Modifiers::COMMAND)?;
    let discard = host.window.find("Discard")?.center();
    host.window.send_last(click(discard));
    let (code, after) = host.ended()?;
    ensure!(code == Some(3), "discarded: {code:?}");
    ensure!(after == before, "the drawing has changed");
    Ok(())
}

#[test]
fn a_window_that_is_killed_changes_nothing() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let mut host = Host::open(&mut display)?;
    host.drag()?;
    let (before, process) = (host.before.clone(), host.process()?);
    let killed = Command::new("kill")
        .args(["-s", "KILL", &process])
        .status()?;
    ensure!(killed.success(), "{process} is not killed");
    let (code, after) = host.ended()?;
    ensure!(code.is_none_or(|code| code != 0 && code != 3), "{code:?}");
    ensure!(after == before, "the drawing has changed");
    Ok(())
}

#[test]
fn a_file_that_has_changed_meanwhile_is_not_overwritten_unasked() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let mut host = Host::open(&mut display)?;
    host.drag()?;
    fs::write(host.sent(), "of another program")?;
    host.save()?;
    host.window.find_beginning("The file has changed on disk")?;
    ensure!(
        fs::read_to_string(host.sent())? == "of another program",
        "it is overwritten"
    );
    host.window.click("Overwrite")?;
    host.window.find_beginning("Saved to")?;
    let (code, after) = host.close()?;
    ensure!(code == Some(0), "{code:?}");
    curve_in(&after)?;
    Ok(())
}

#[test]
fn saving_on_leaving_counts() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let mut host = Host::open(&mut display)?;
    host.drag()?;
    let before = host.before.clone();
    host.window.key(Key::Q, Modifiers::COMMAND)?;
    let save = host.window.find("Save")?.center();
    host.window.send_last(click(save));
    let begin = Instant::now();
    while fs::read(host.sent())? == before {
        ensure!(
            begin.elapsed() < Duration::from_secs(30),
            "nothing is saved"
        );
        std::thread::sleep(Duration::from_millis(50));
    }
    let (code, after) = host.ended()?;
    ensure!(code == Some(0), "{code:?}");
    ensure!(after != before, "the drawing is the old one");
    Ok(())
}

fn click(at: egui::Pos2) -> Vec<egui::Event> {
    let button = |pressed| egui::Event::PointerButton {
        pos: at,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    vec![egui::Event::PointerMoved(at), button(true), button(false)]
}
