//! A virtual display: one server at a time, used only once a client has been answered.

use std::io::{BufRead, BufReader};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use anyhow::{Context, Result, bail, ensure};

/// How long a server may take to name its display.
const PATIENCE: Duration = Duration::from_secs(30);

/// How many servers are tried before it is a failure: on a loaded machine one may end at its start.
const SERVERS: usize = 3;

/// Whose turn it is: servers that start side by side compete for the same numbers and files, and
/// windows on software graphics for the same cores.
static TURN: Mutex<()> = Mutex::new(());

/// A virtual display, taken down when dropped; another waits for its end before it starts.
pub struct Display {
    server: Server,
    name: String,
    _turn: MutexGuard<'static, ()>,
}

impl Display {
    /// Start a virtual display of some size and wait until it answers a client.
    pub fn start(width: u32, height: u32) -> Result<Self> {
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let mut trouble = Vec::new();
        for _ in 0..SERVERS {
            let mut server = Server::start(width, height)?;
            match server.ready() {
                Ok(name) => {
                    return Ok(Self {
                        server,
                        name,
                        _turn: turn,
                    });
                }
                Err(error) => trouble.push(format!("{error:#}")),
            }
        }
        bail!("no display: {}", trouble.join("; "))
    }

    /// The display's name, as `DISPLAY` takes it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Fail if the server has ended meanwhile.
    pub fn check(&mut self) -> Result<()> {
        let ended = self.server.0.try_wait()?;
        ensure!(ended.is_none(), "the display {} has ended", self.name);
        Ok(())
    }
}

/// The server's process, ended when dropped.
struct Server(Child);

impl Server {
    fn start(width: u32, height: u32) -> Result<Self> {
        let server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-noreset", "-nolisten", "tcp"])
            .args(["-screen", "0"])
            .arg(format!("{width}x{height}x24"))
            .stdout(Stdio::piped())
            .spawn()
            .context("Xvfb does not start: is the package xvfb installed?")?;
        Ok(Self(server))
    }

    /// Wait for the display's number and greet it as a client would.
    fn ready(&mut self) -> Result<String> {
        let output = self.0.stdout.take().context("Xvfb has no output")?;
        let number = first_line(output)?;
        ensure!(
            !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()),
            "Xvfb names no display but says “{number}”"
        );
        let name = format!(":{number}");
        x11rb::connect(Some(&name)).with_context(|| format!("display {name} does not answer"))?;
        Ok(name)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Read the first line a process prints, with patience.
fn first_line(output: ChildStdout) -> Result<String> {
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut line = String::new();
        let read = BufReader::new(output).read_line(&mut line);
        let _ = sender.send(read.map(|_| line));
    });
    let line = receiver
        .recv_timeout(PATIENCE)
        .context("Xvfb says nothing")??;
    Ok(line.trim().to_owned())
}
