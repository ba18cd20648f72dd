//! A hand and an eye for the real window: starts Batten on a virtual display, finds widgets by
//! their labels, presses, drags and types, and takes pictures.
#![forbid(unsafe_code)]

pub mod arc;
mod display;

use std::ffi::OsStr;
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::rc::Rc;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow, bail, ensure};
use egui::accesskit::{Node, TreeUpdate};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect};
use egui_inspection::protocol::{
    EncodedPng, Request, Response, read_handshake, read_message, write_message,
};

pub use crate::display::Display;

/// How long the window may take to appear, and a widget to be found.
const PATIENCE: Duration = Duration::from_secs(60);

/// The running program with its window.
pub struct Window {
    program: Child,
    connection: TcpStream,
    home: Rc<tempfile::TempDir>,
    scale: f32,
}

/// How the program is started.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a> {
    /// A command that starts the program, as `nohup`; empty to start it directly.
    pub command: &'a [&'a str],
    /// The arguments of the program.
    pub arguments: &'a [&'a str],
    /// How many pixels a screen point has.
    pub scale: f32,
    /// At most so many seconds' work may be lost.
    pub autosave_seconds: f64,
}

impl Default for Start<'_> {
    fn default() -> Self {
        Self {
            command: &[],
            arguments: &[],
            scale: 1.0,
            autosave_seconds: 30.0,
        }
    }
}

impl Window {
    /// Start the program on a display and wait for its window. The program is the one named by
    /// `BATTEN`, or the one that Batten's own tests have built. Its home is a new folder.
    pub fn open(display: &mut Display, arguments: &[&str], scale: f32) -> Result<Self> {
        let start = Start {
            arguments,
            scale,
            ..Start::default()
        };
        Self::open_at(display, Rc::new(tempfile::tempdir()?), start)
    }

    /// Start the program as [`Window::open`] does, with a home that other windows may have too.
    pub fn open_at(
        display: &mut Display,
        home: Rc<tempfile::TempDir>,
        start: Start<'_>,
    ) -> Result<Self> {
        let program = program()?;
        let address = free_address()?;
        let program = program.as_os_str();
        let mut words = start.command.iter().map(OsStr::new).chain([program]);
        let mut child = Command::new(words.next().unwrap_or(program))
            .args(words)
            .args(start.arguments)
            .env("DISPLAY", display.name())
            .env_remove("WAYLAND_DISPLAY")
            // Neither a bus nor zenity is found: whatever the desktop offers, Batten asks itself.
            .env("DBUS_SESSION_BUS_ADDRESS", unreachable_bus(home.path()))
            .env("PATH", "")
            .env("WINIT_X11_SCALE_FACTOR", start.scale.to_string())
            .env("LIBGL_ALWAYS_SOFTWARE", "1")
            .env("HOME", home.path())
            .env("XDG_DATA_HOME", home.path().join("data"))
            .env("XDG_STATE_HOME", home.path().join("state"))
            .env(
                "BATTEN_AUTOSAVE_SECONDS",
                start.autosave_seconds.to_string(),
            )
            // A signal ends the window by a frame, or not at all while a test waits.
            .env(
                "BATTEN_SIGNAL_SECONDS",
                (2 * PATIENCE).as_secs().to_string(),
            )
            .env("EGUI_INSPECTION", &address)
            .stdin(Stdio::null())
            // On a terminal, nohup would write a file into the working folder.
            .stdout(Stdio::null())
            .spawn()
            .with_context(|| format!("{} does not start", program.display()))?;
        let connection = match connect(&address, &mut child) {
            Ok(connection) => connection,
            Err(error) => {
                let _ = child.kill();
                let _ = child.wait();
                display.check()?;
                return Err(error);
            }
        };
        let mut window = Self {
            program: child,
            connection,
            home,
            scale: start.scale,
        };
        window.settle()?;
        Ok(window)
    }

    /// A folder of the program's own, for files.
    pub fn folder(&self) -> &Path {
        self.home.path()
    }

    /// Kill the program, as nothing can be handled by it. Returns when it has ended.
    pub fn kill(mut self) -> Result<()> {
        self.program.kill()?;
        self.program.wait()?;
        Ok(())
    }

    /// Send the program a signal by its name, as "TERM".
    pub fn signal(&mut self, name: &str) -> Result<()> {
        let mut kill = Command::new("kill");
        let sent = kill.args(["-s", name]).arg(self.program.id().to_string());
        ensure!(sent.status()?.success(), "the signal {name} is not sent");
        Ok(())
    }

    /// Wait until nothing changes any more.
    pub fn settle(&mut self) -> Result<()> {
        self.ask(Request::Settle { max_steps: 200 }).map(|_| ())
    }

    /// Find the place of the widget with this label.
    pub fn find(&mut self, label: &str) -> Result<Rect> {
        self.find_where(label, |node| node.label() == Some(label))
    }

    /// Find the place of a widget whose label or value begins so.
    pub fn find_beginning(&mut self, beginning: &str) -> Result<Rect> {
        self.find_where(beginning, |node| {
            let texts = [node.label(), node.value()];
            texts
                .into_iter()
                .flatten()
                .any(|text| text.starts_with(beginning))
        })
    }

    /// Whether a widget with this label is there now.
    pub fn has(&mut self, label: &str) -> Result<bool> {
        let tree = self.tree()?;
        Ok(tree
            .nodes
            .iter()
            .any(|(_, node)| node.label() == Some(label)))
    }

    /// Collect all labels and values, for messages.
    pub fn texts(&mut self) -> Result<Vec<String>> {
        let tree = self.tree()?;
        let texts = tree
            .nodes
            .iter()
            .flat_map(|(_, node)| [node.label(), node.value()]);
        Ok(texts.flatten().map(str::to_owned).collect())
    }

    /// Click the widget with this label.
    pub fn click(&mut self, label: &str) -> Result<()> {
        let place = self.find(label)?.center();
        self.click_at(place)
    }

    /// Click a place.
    pub fn click_at(&mut self, place: Pos2) -> Result<()> {
        self.events(vec![Event::PointerMoved(place)])?;
        self.events(vec![button(place, true)])?;
        self.events(vec![button(place, false)])?;
        self.settle()
    }

    /// Press at one place, move to another in steps, and release.
    pub fn drag(&mut self, from: Pos2, to: Pos2) -> Result<()> {
        self.events(vec![Event::PointerMoved(from)])?;
        self.events(vec![button(from, true)])?;
        for step in 1..=8 {
            let share = step as f32 / 8.0;
            self.events(vec![Event::PointerMoved(from + share * (to - from))])?;
        }
        self.events(vec![button(to, false)])?;
        self.settle()
    }

    /// Press at one place and move to another, without releasing.
    pub fn hold(&mut self, from: Pos2, to: Pos2) -> Result<()> {
        self.events(vec![Event::PointerMoved(from)])?;
        self.events(vec![button(from, true)])?;
        self.events(vec![Event::PointerMoved(from.lerp(to, 0.5))])?;
        self.events(vec![Event::PointerMoved(to)])
    }

    /// Release the button.
    pub fn release(&mut self, place: Pos2) -> Result<()> {
        self.events(vec![button(place, false)])?;
        self.settle()
    }

    /// Move the pointer.
    pub fn move_to(&mut self, place: Pos2) -> Result<()> {
        self.events(vec![Event::PointerMoved(place)])?;
        self.settle()
    }

    /// Press a key.
    pub fn key(&mut self, key: Key, modifiers: Modifiers) -> Result<()> {
        self.tap(key, modifiers)?;
        self.settle()
    }

    /// Press a key and return after the frame that gets it.
    pub fn tap(&mut self, key: Key, modifiers: Modifiers) -> Result<()> {
        self.events(key_events(key, modifiers))
    }

    /// Press a key and return at once.
    pub fn tap_and_leave(&mut self, key: Key, modifiers: Modifiers) -> Result<()> {
        let events = key_events(key, modifiers);
        Ok(write_message(
            &mut self.connection,
            &Request::ApplyEvents { events },
        )?)
    }

    /// Type a text into the field that has the keyboard.
    pub fn write(&mut self, text: &str) -> Result<()> {
        self.events(vec![Event::Text(text.to_owned())])?;
        self.settle()
    }

    /// Give the window another size, in screen points, and wait until it has it: the display
    /// tells the window of its new size some frames later.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<()> {
        let wanted = [width, height].map(|points| (points as f32 * self.scale).round() as u32);
        self.ask(Request::Resize { width, height })?;
        let begin = Instant::now();
        loop {
            let size = self.screenshot()?.size;
            if size == wanted {
                return self.settle();
            }
            ensure!(
                begin.elapsed() < PATIENCE,
                "the window stays at {size:?} pixels instead of {wanted:?}"
            );
        }
    }

    /// Take a picture, as a PNG file.
    pub fn picture(&mut self, path: &Path) -> Result<()> {
        self.settle()?;
        Ok(std::fs::write(path, self.screenshot()?.bytes)?)
    }

    /// Wait until the program has ended and tell whether it did so well.
    pub fn wait(self) -> Result<bool> {
        Ok(self.exit_status()?.success())
    }

    /// Wait until the program has ended and return how.
    pub fn exit_status(mut self) -> Result<ExitStatus> {
        let begin = Instant::now();
        while begin.elapsed() < PATIENCE {
            if let Some(status) = self.program.try_wait()? {
                return Ok(status);
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        bail!("the program does not end")
    }

    /// Send events without waiting for what follows from them; the connection may end with them.
    pub fn send_last(&mut self, events: Vec<Event>) {
        let _ = self.events(events);
    }

    fn events(&mut self, events: Vec<Event>) -> Result<()> {
        self.ask(Request::ApplyEvents { events }).map(|_| ())
    }

    fn find_where(&mut self, what: &str, fits: impl Fn(&Node) -> bool) -> Result<Rect> {
        let begin = Instant::now();
        loop {
            let tree = self.tree()?;
            let found = tree.nodes.iter().find(|(_, node)| fits(node));
            if let Some(bounds) = found.and_then(|(_, node)| node.bounds()) {
                return Ok(Rect::from_min_max(
                    Pos2::new(bounds.x0 as f32, bounds.y0 as f32),
                    Pos2::new(bounds.x1 as f32, bounds.y1 as f32),
                ));
            }
            if begin.elapsed() > PATIENCE / 4 {
                let texts = self.texts()?.join(" | ");
                bail!("nothing is called “{what}” among: {texts}");
            }
            self.settle()?;
        }
    }

    fn screenshot(&mut self) -> Result<EncodedPng> {
        match self.ask(Request::GetScreenshot {
            pixels_per_point: None,
        })? {
            Response::Screenshot(picture) => Ok(picture),
            other => bail!("no picture: {other:?}"),
        }
    }

    fn tree(&mut self) -> Result<TreeUpdate> {
        match self.ask(Request::GetTree)? {
            Response::Tree {
                accesskit: Some(tree),
                ..
            } => Ok(tree),
            other => bail!("no widget tree: {other:?}"),
        }
    }

    fn ask(&mut self, request: Request) -> Result<Response> {
        write_message(&mut self.connection, &request)?;
        match read_message(&mut self.connection)? {
            Response::Error { message } => Err(anyhow!(message)),
            response => Ok(response),
        }
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    }
}

fn key_events(key: Key, modifiers: Modifiers) -> Vec<Event> {
    let event = |pressed| Event::Key {
        key,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers,
    };
    vec![event(true), event(false)]
}

/// Find the program: `BATTEN`, or what Batten's tests have built into the folder of this build.
fn program() -> Result<PathBuf> {
    if let Some(path) = std::env::var_os("BATTEN") {
        return Ok(path.into());
    }
    let this = std::env::current_exe()?;
    let name = format!("batten{}", std::env::consts::EXE_SUFFIX);
    let mut places = this
        .ancestors()
        .skip(1)
        .take(2)
        .map(|folder| folder.join(&name));
    let built = places.find(|path| path.is_file());
    built.context("Batten is not built: `cargo test --no-run` builds it for these tests")
}

/// The address of a bus that is not there.
fn unreachable_bus(folder: &Path) -> String {
    format!("unix:path={}/no-bus", folder.display())
}

/// Find a port on the loopback that nobody uses.
fn free_address() -> Result<String> {
    let listener = TcpListener::bind("127.0.0.1:0")?;
    Ok(listener.local_addr()?.to_string())
}

/// Wait for the program's answer; give up as soon as the program has ended.
fn connect(address: &str, program: &mut Child) -> Result<TcpStream> {
    let begin = Instant::now();
    loop {
        if let Some(status) = program.try_wait()? {
            bail!("the program has ended ({status}) before its window appeared");
        }
        match greet(address) {
            Ok(connection) => return Ok(connection),
            Err(error) if begin.elapsed() > PATIENCE => {
                return Err(error).context(
                    "the window does not appear; only programs built by `cargo test` can be controlled",
                );
            }
            Err(_) => std::thread::sleep(Duration::from_millis(50)),
        }
    }
}

fn greet(address: &str) -> Result<TcpStream> {
    let mut connection = TcpStream::connect(address)?;
    connection.set_read_timeout(Some(PATIENCE))?;
    read_handshake(&mut connection)?;
    Ok(connection)
}
