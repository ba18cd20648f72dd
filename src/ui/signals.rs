//! Signals that ask the program to end: what is not saved is kept, then the window closes.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use eframe::egui::Context;

use crate::editor::Autosaver;

/// Whether the system has asked the program to end.
#[derive(Clone, Debug, Default)]
pub struct Signals(Arc<AtomicBool>);

impl Signals {
    /// Listen on a thread. When a signal comes, what is not saved is written there, and the frame is
    /// woken to close the window; should it not come to that soon, the program ends all the same.
    ///
    /// # Errors
    /// If the system does not let signals be heard.
    pub fn listen(context: &Context, autosaver: Option<Autosaver>) -> io::Result<Self> {
        let signals = Self::default();
        system::listen(signals.clone(), context.clone(), autosaver)?;
        Ok(signals)
    }

    /// Whether a signal has come.
    pub fn have_come(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    #[cfg_attr(not(unix), expect(dead_code, reason = "no signals there"))]
    fn take_note(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[cfg(unix)]
mod system {
    use std::io;
    use std::thread;
    use std::time::Duration;

    use eframe::egui::Context;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator;
    use signal_hook::low_level::emulate_default_handler;

    use super::Signals;
    use crate::editor::Autosaver;

    /// How long the window may take to close.
    const PATIENCE: Duration = Duration::from_secs(3);

    pub fn listen(
        signals: Signals,
        context: Context,
        autosaver: Option<Autosaver>,
    ) -> io::Result<()> {
        let mut heard = iterator::Signals::new([SIGTERM, SIGINT, SIGHUP])?;
        let serve = move || {
            if let Some(signal) = heard.forever().next() {
                if let Some(Err(error)) = autosaver.as_ref().map(Autosaver::write) {
                    eprintln!("batten: {error}");
                }
                signals.take_note();
                context.request_repaint();
                thread::sleep(PATIENCE);
                // A window that is not shown may have no frames.
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
