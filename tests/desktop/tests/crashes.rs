//! What a window that is killed, or asked to end by a signal, leaves behind: files are whole, and
//! what was not saved is offered at the next start.

use std::fmt;
use std::path::PathBuf;
use std::rc::Rc;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use batten::document::Document;
use batten::io::{Sessions, disk};
use batten_desktop_tests::arc::arc;
use batten_desktop_tests::{Display, Start, Window};
use egui::{Key, Modifiers};
use tempfile::TempDir;

/// The period of autosaves here: at most so many seconds' work may be lost.
const PERIOD: f64 = 0.5;

/// How late an autosave may be on a loaded machine, in seconds: frames and disk take their time.
const LATENESS: f64 = 1.0;

/// The longest that a window is worked in before it is killed.
const LONGEST: f64 = 2.5;

/// The longest between two saves, in seconds.
const SAVES: f64 = 2.0;

/// How far a vertex may be from a whole number of nudges, in nudges.
const NUDGE_TOLERANCE: f64 = 1e-6;

/// The button that gives up what is offered, and the same after one press.
const DISCARD: &str = "Discard work.batten";
const REALLY_DISCARD: &str = "Really discard work.batten";

/// A document whose edits are counted: each nudge moves all vertices by the same step.
struct Work {
    home: Rc<TempDir>,
    file: PathBuf,
    /// Where the first vertex was before any nudge.
    origin: f64,
    step: f64,
}

/// What came of killing a window.
#[derive(Debug, Default)]
struct Tally {
    kills: usize,
    offered: usize,
    /// What the last autosave holds that is not recovered yet, in nudges.
    left: Option<usize>,
    /// The most work that was lost, in seconds.
    largest_loss: f64,
}

impl Tally {
    /// Count what was recovered and what waits for the next window.
    fn recoverable(&self) -> usize {
        self.offered + usize::from(self.left.is_some())
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            kills,
            offered,
            largest_loss,
            ..
        } = self;
        write!(
            formatter,
            "{kills} kills: {offered} documents recovered, all that were left; no torn file; at most \
             {largest_loss:.2} s of work lost, with a period of {PERIOD} s"
        )
    }
}

impl Work {
    /// Write a file and find out how far a nudge goes.
    fn new(display: &mut Display) -> Result<Self> {
        let home = Rc::new(tempfile::tempdir()?);
        let file = home.path().join("work.batten");
        let curve = batten::document::Curve::new("arc".to_owned(), arc());
        disk::write_document(&file, &Document::from_curves([curve]), None)?;
        let mut work = Self {
            home,
            file,
            origin: arc().vertex(0).x,
            step: 1.0,
        };
        let mut window = work.open_selected(display)?;
        nudge(&mut window)?;
        window.key(Key::S, Modifiers::COMMAND)?;
        window.find_beginning("Saved to")?;
        window.kill()?;
        let moved = x_of(&disk::read_file(&work.file)?.into_document()?)?;
        work.step = moved - work.origin;
        ensure!(work.step > 0.0, "nothing was nudged");
        Ok(work)
    }

    fn open(&self, display: &mut Display) -> Result<Window> {
        self.open_with(display, &[])
    }

    /// Open a window by a command that takes the program as its argument.
    fn open_with(&self, display: &mut Display, command: &[&str]) -> Result<Window> {
        let file = self.file.to_string_lossy();
        let start = Start {
            command,
            arguments: &[&file],
            autosave_seconds: PERIOD,
            ..Start::default()
        };
        Window::open_at(display, self.home.clone(), start)
    }

    /// Open a window and select all vertices.
    fn open_selected(&self, display: &mut Display) -> Result<Window> {
        let mut window = self.open(display)?;
        select_all(&mut window)?;
        Ok(window)
    }

    /// Count the nudges in a document.
    fn nudges(&self, document: &Document) -> Result<usize> {
        let nudges = (x_of(document)? - self.origin) / self.step;
        let whole = nudges.round();
        ensure!(
            (nudges - whole).abs() < NUDGE_TOLERANCE && whole >= 0.0,
            "{nudges} nudges"
        );
        Ok(whole as usize)
    }

    /// Count the nudges in the file, which must be whole.
    fn in_file(&self) -> Result<usize> {
        let reading = disk::read_file(&self.file).context("the file is torn")?;
        self.nudges(&reading.into_document()?)
    }

    /// Count the nudges in the autosave, which must be whole, if there is one.
    fn in_autosave(&self) -> Result<Option<usize>> {
        let folder = self.home.path().join("state/batten/sessions");
        let abandoned = Sessions::in_folder(folder).abandoned();
        ensure!(abandoned.len() <= 1, "{} autosaves", abandoned.len());
        let Some(session) = abandoned.first() else {
            return Ok(None);
        };
        let (origin, document) = session.read().context("the autosave is torn")?;
        ensure!(
            origin.path.as_ref() == Some(&self.file),
            "the autosave is of {:?}",
            origin.path
        );
        self.nudges(&document).map(Some)
    }

    /// Open a window, recover what the one before has left, work in it and kill it at a random moment;
    /// then look at what is left.
    fn kill_once(
        &self,
        display: &mut Display,
        random: &mut Random,
        tally: &mut Tally,
    ) -> Result<()> {
        let mut window = self.open(display)?;
        self.recover(&mut window, tally.left)?;
        tally.offered += usize::from(tally.left.is_some());
        select_all(&mut window)?;
        let before = self.in_file()?;
        // When each nudge was sent.
        let mut sent = Vec::new();
        let end = Instant::now() + random.seconds(LONGEST);
        // By time, not by the number of nudges: on a fast machine an autosave must still come between.
        let mut save = Instant::now() + random.seconds(SAVES);
        while Instant::now() < end {
            if Instant::now() > save {
                window.tap(Key::S, Modifiers::COMMAND)?;
                save = Instant::now() + random.seconds(SAVES);
            } else {
                sent.push(Instant::now());
                nudge(&mut window)?;
            }
        }
        // The last key is not waited for: the kill comes while it is worked on.
        if random.next() < 0.5 {
            window.tap_and_leave(Key::S, Modifiers::COMMAND)?;
        } else {
            sent.push(Instant::now());
            window.tap_and_leave(Key::ArrowRight, Modifiers::NONE)?;
        }
        std::thread::sleep(random.seconds(0.03));
        let killed = Instant::now();
        window.kill()?;
        tally.kills += 1;

        let (file, autosave) = (self.in_file()?, self.in_autosave()?);
        let kept = file.max(autosave.unwrap_or(0));
        ensure!(
            before <= kept && kept <= before + sent.len(),
            "{kept} nudges"
        );
        if let Some(lost) = sent.get(kept - before) {
            let loss = killed.duration_since(*lost).as_secs_f64();
            tally.largest_loss = tally.largest_loss.max(loss);
            ensure!(loss < PERIOD + LATENESS, "{loss} s of work are lost");
        }
        tally.left = autosave;
        Ok(())
    }

    /// Recover what an earlier window has left: open and save it, if it is newer than the file. It must be
    /// offered, and nothing else.
    fn recover(&self, window: &mut Window, left: Option<usize>) -> Result<()> {
        let Some(autosave) = left else {
            ensure!(!window.has(DISCARD)?, "nothing is left, and offered");
            return Ok(());
        };
        window.find(DISCARD)?;
        if autosave > self.in_file()? {
            window.click("Open work.batten")?;
            window.find_beginning("Recovered “work.batten”")?;
            window.key(Key::S, Modifiers::COMMAND)?;
            window.find_beginning("Saved to")?;
            let saved = self.in_file()?;
            ensure!(saved == autosave, "{saved} nudges instead of {autosave}");
        } else {
            window.click(DISCARD)?;
            window.click(REALLY_DISCARD)?;
        }
        ensure!(!window.has(DISCARD)?, "it is still offered");
        Ok(())
    }
}

fn select_all(window: &mut Window) -> Result<()> {
    window.tap(Key::A, Modifiers::COMMAND)
}

/// Move all vertices to the right.
fn nudge(window: &mut Window) -> Result<()> {
    window.tap(Key::ArrowRight, Modifiers::NONE)
}

fn quit(mut window: Window) -> Result<()> {
    let _ = window.tap_and_leave(Key::Q, Modifiers::COMMAND);
    ensure!(window.wait()?, "the program failed");
    Ok(())
}

fn x_of(document: &Document) -> Result<f64> {
    let (_, curve) = document.curves().next().context("no curve")?;
    Ok(curve.polygon.vertex(0).x)
}

/// Random numbers in [0, 1), the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        // Marsaglia's xorshift.
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A duration below so many seconds.
    fn seconds(&mut self, most: f64) -> Duration {
        Duration::from_secs_f64(most * self.next())
    }
}

/// Kill so many windows one after the other, and more until so many have left something, at most ten
/// times as many; `BATTEN_KILL_SEED` gives other moments.
fn kill(times: usize, offered: usize) -> Result<Tally> {
    let mut display = Display::start(1600, 1000)?;
    let work = Work::new(&mut display)?;
    let seed = std::env::var("BATTEN_KILL_SEED").ok();
    let seed = seed.map_or(Ok(1), |seed| seed.parse::<u64>())?;
    let mut random = Random(0x5eed_5eed_5eed_5eed ^ (seed << 32));
    let mut tally = Tally::default();
    while tally.kills < times || (tally.recoverable() < offered && tally.kills < 10 * times) {
        let killed = work.kill_once(&mut display, &mut random, &mut tally);
        killed.with_context(|| format!("kill {}", tally.kills))?;
        if tally.kills % 10 == 0 {
            println!("{tally}");
        }
    }
    let mut window = work.open(&mut display)?;
    work.recover(&mut window, tally.left)?;
    tally.offered += usize::from(tally.left.is_some());
    quit(window)?;
    let left = work.in_autosave()?;
    ensure!(left.is_none(), "an autosave is left");
    println!("{tally}");
    Ok(tally)
}

#[test]
fn killed_windows_lose_at_most_a_periods_work() -> Result<()> {
    let tally = kill(6, 1)?;
    ensure!(tally.offered > 0, "nothing was ever recovered");
    Ok(())
}

#[test]
#[ignore = "200 windows take half an hour"]
fn two_hundred_killed_windows_lose_at_most_a_periods_work() -> Result<()> {
    let tally = kill(200, 21)?;
    ensure!(tally.offered > 20, "{tally:?}");
    Ok(())
}

#[test]
fn signals_keep_what_is_not_saved_and_end_an_idle_window() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let work = Work::new(&mut display)?;
    // Started by nohup, these tests and their windows ignore SIGHUP.
    let hangs_up = (!disk::ignores_signal(1)).then_some("HUP");
    for name in ["TERM", "INT"].into_iter().chain(hangs_up) {
        let mut window = work.open_selected(&mut display)?;
        let before = work.in_file()?;
        nudge(&mut window)?;
        window.settle()?;
        window.signal(name)?;
        // Without a frame that closes the window, the program ends much later, and not well.
        ensure!(window.wait()?, "SIG{name} is no good end");
        match work.in_autosave()? {
            Some(kept) if kept == before + 1 => {}
            kept => bail!("SIG{name} keeps {kept:?} nudges instead of {}", before + 1),
        }
        ensure!(work.in_file()? == before, "a signal saves nothing");
        let mut window = work.open(&mut display)?;
        work.recover(&mut window, Some(before + 1))?;
        quit(window)?;
    }
    Ok(())
}

#[test]
fn a_window_started_with_nohup_outlives_a_hangup() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let work = Work::new(&mut display)?;
    let mut window = work.open_with(&mut display, &["/usr/bin/nohup"])?;
    select_all(&mut window)?;
    let before = work.in_file()?;
    window.signal("HUP")?;
    nudge(&mut window)?;
    window.key(Key::S, Modifiers::COMMAND)?;
    window.find_beginning("Saved to")?;
    ensure!(work.in_file()? == before + 1, "the window works on");
    quit(window)
}

#[test]
fn a_second_window_on_a_file_is_told() -> Result<()> {
    let mut display = Display::start(1600, 1000)?;
    let work = Work::new(&mut display)?;
    let mut first = work.open(&mut display)?;
    first.settle()?;
    let mut second = work.open(&mut display)?;
    second.find_beginning("1 curve read")?;
    ensure!(
        second
            .texts()?
            .iter()
            .any(|text| text.contains("Another window has this file open")),
        "the second window does not know of the first"
    );
    // A window that another one covers is not painted: the upper one goes first.
    quit(second)?;
    quit(first)
}
