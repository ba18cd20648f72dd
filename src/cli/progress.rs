//! Telling on the standard error how far long computations have come.

use std::fmt::Display;
use std::io::{self, IsTerminal, Stderr, Write};
use std::panic::resume_unwind;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use crate::geometry::Progress as Done;

/// What takes less time is not told.
const PATIENCE: Duration = Duration::from_secs(1);

/// How often the line on a terminal is renewed.
const ON_TERMINAL: Duration = Duration::from_millis(100);

/// How often a line is added elsewhere.
const ELSEWHERE: Duration = Duration::from_secs(10);

/// Goes back to the start of a terminal's line and empties it.
const EMPTY_LINE: &str = "\r\x1b[2K";

/// How often a long computation is asked how far it has come.
const PAUSE: Duration = Duration::from_millis(100);

/// Compute something on another thread, and tell how far it has come while it takes long.
pub(super) fn watched<T: Send>(name: &str, compute: impl FnOnce(&Done) -> T + Send) -> T {
    let done = Done::default();
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        let shared = done.clone();
        let thread = scope.spawn(move || {
            // The receiver waits below until it has this.
            let _ = sender.send(compute(&shared));
        });
        let mut line = Progress::new();
        loop {
            match receiver.recv_timeout(PAUSE) {
                Ok(result) => return result,
                Err(RecvTimeoutError::Timeout) => {
                    line.tell(format_args!("{name}: {:.0} %", 100.0 * done.done()));
                }
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        // Nothing was sent: the thread panicked.
        match thread.join() {
            Err(panic) => resume_unwind(panic),
            Ok(()) => unreachable!("the result is sent before the thread ends"),
        }
    })
}

/// A line that tells how far a computation has come: renewed in place on a terminal, repeated now
/// and then elsewhere.
#[derive(Debug)]
pub(super) struct Progress<W: Write> {
    out: W,
    on_terminal: bool,
    begin: Instant,
    /// When the line was last written, after the begin.
    told: Option<Duration>,
}

impl Progress<Stderr> {
    /// Begin now, on the standard error.
    pub(super) fn new() -> Self {
        let out = io::stderr();
        let on_terminal = out.is_terminal();
        Self::begin(out, on_terminal)
    }
}

impl<W: Write> Progress<W> {
    fn begin(out: W, on_terminal: bool) -> Self {
        Self {
            out,
            on_terminal,
            begin: Instant::now(),
            told: None,
        }
    }

    /// Tell how far it has come now.
    pub(super) fn tell(&mut self, text: impl Display) {
        self.tell_at(self.begin.elapsed(), text);
    }

    fn tell_at(&mut self, now: Duration, text: impl Display) {
        let pause = if self.on_terminal {
            ON_TERMINAL
        } else {
            ELSEWHERE
        };
        if now < PATIENCE || self.told.is_some_and(|told| now < told + pause) {
            return;
        }
        self.told = Some(now);
        let (start, end) = if self.on_terminal {
            (EMPTY_LINE, "")
        } else {
            ("", "\n")
        };
        // Where nobody listens there is nobody to tell.
        let _ = write!(self.out, "{start}batten: {text}{end}");
        let _ = self.out.flush();
    }
}

impl<W: Write> Drop for Progress<W> {
    fn drop(&mut self) {
        if self.on_terminal && self.told.is_some() {
            let _ = write!(self.out, "{EMPTY_LINE}");
            let _ = self.out.flush();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text for segments that begin at these milliseconds.
    fn written(on_terminal: bool, milliseconds: &[u64]) -> String {
        let mut out = Vec::new();
        let mut progress = Progress::begin(&mut out, on_terminal);
        for (segment, time) in milliseconds.iter().enumerate() {
            progress.tell_at(
                Duration::from_millis(*time),
                format_args!("segment {segment}"),
            );
        }
        drop(progress);
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn short_proofs_are_silent() {
        assert_eq!(written(true, &[0, 500, 999]), "");
        assert_eq!(written(false, &[0, 500, 999]), "");
    }

    #[test]
    fn long_proofs_are_told_in_place_or_line_by_line() {
        let line = |segment| format!("batten: segment {segment}");
        let times = [0, 1000, 1050, 1100, 11_100];
        let [second, fourth, fifth] = [1, 3, 4].map(line);
        let expected = [&second, &fourth, &fifth].map(|line| format!("{EMPTY_LINE}{line}"));
        assert_eq!(written(true, &times), expected.concat() + EMPTY_LINE);
        assert_eq!(written(false, &times), format!("{second}\n{fifth}\n"));
    }
}
