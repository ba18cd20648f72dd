//! Signals that end the program: they write the autosave, then close the window.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use eframe::egui::Context;

use crate::editor::Autosaver;

/// Whether a signal has requested the end of the program.
#[derive(Clone, Debug, Default)]
pub struct Signals(Arc<AtomicBool>);

impl Signals {
    /// Listen on a thread. A signal writes the autosave there and wakes a frame, which closes the
    /// window. If no frame comes in time, the thread ends the program. SIGHUP stays ignored if the
    /// program was started so, as by `nohup`.
    ///
    /// # Errors
    /// If the system refuses a signal handler or a thread.
    pub fn listen(context: &Context, autosaver: Option<Autosaver>) -> io::Result<Self> {
        let signals = Self::default();
        system::listen(signals.clone(), context.clone(), autosaver)?;
        Ok(signals)
    }

    /// Whether a signal has come.
    pub fn have_come(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[cfg(unix)]
mod system {
    use std::io;
    use std::sync::atomic::Ordering;
    use std::thread;
    use std::time::Duration;

    use eframe::egui::Context;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator;
    use signal_hook::low_level::emulate_default_handler;

    use super::super::seconds::seconds_of;
    use super::Signals;
    use crate::editor::Autosaver;
    use crate::io::disk;

    /// The time in which the window must close. Longer delays a logout, shorter ends a busy window
    /// that would have closed.
    const PATIENCE: Duration = Duration::from_secs(3);

    /// The variable that sets another time, in seconds: for tests on slow machines.
    const PATIENCE_VARIABLE: &str = "BATTEN_SIGNAL_SECONDS";

    pub fn listen(
        signals: Signals,
        context: Context,
        autosaver: Option<Autosaver>,
    ) -> io::Result<()> {
        let hangs_up = (!disk::ignores_signal(SIGHUP)).then_some(SIGHUP);
        let mut heard = iterator::Signals::new([SIGTERM, SIGINT].into_iter().chain(hangs_up))?;
        let serve = move || {
            if let Some(signal) = heard.forever().next() {
                if let Some(Err(error)) = autosaver.as_ref().map(Autosaver::write) {
                    eprintln!("batten: {error}");
                }
                signals.0.store(true, Ordering::Relaxed);
                context.request_repaint();
                thread::sleep(seconds_of(PATIENCE_VARIABLE).unwrap_or(PATIENCE));
                // A hidden window may have no frames.
                let _ = emulate_default_handler(signal);
            }
        };
        thread::Builder::new()
            .name("signals".to_owned())
            .spawn(serve)?;
        Ok(())
    }
}

#[cfg(not(unix))]
mod system {
    use std::io;

    use eframe::egui::Context;

    use super::Signals;
    use crate::editor::Autosaver;

    pub fn listen(_: Signals, _: Context, _: Option<Autosaver>) -> io::Result<()> {
        Ok(())
    }
}
