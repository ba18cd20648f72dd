//! `batten apply` to many files: each on its own, on some threads, with a line of JSON for each.

use std::collections::HashMap;
use std::io::{self, IsTerminal};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, SyncSender};
use std::thread::{self, Builder};
use std::time::Instant;

use anyhow::{anyhow, bail};
use serde::Serialize;

use super::apply::{Application, Done};
use super::many_files::ManyFiles;
use super::output::{self, Messages};
use super::progress::Progress;
use crate::geometry::panic_message;
use crate::io::{disk, json_layout};
use crate::operations::Report;

/// What is told of a file.
#[derive(Serialize)]
struct Line {
    file: String,
    out: Option<String>,
    reached: Option<bool>,
    extrema: Option<usize>,
    largest: Option<f64>,
    /// In seconds.
    time: f64,
    error: Option<String>,
    #[serde(flatten)]
    full: Option<Full>,
}

/// What is told only if all is wanted.
#[derive(Serialize)]
struct Full {
    report: Option<Report>,
    messages: Vec<String>,
}

/// A file that is done.
struct Told {
    /// Its place among the files.
    index: usize,
    /// Its line.
    text: String,
    /// Whether it failed.
    failed: bool,
}

/// Run the applications, each to one of the files, and print a line for each file, in the order of the files.
/// The exit code is 1 if one of them failed.
///
/// # Errors
/// If the folder cannot be made, no thread be started, or the standard output not be written.
pub(super) fn run(many: &ManyFiles, applications: &[Application]) -> anyhow::Result<ExitCode> {
    disk::create_folder(&many.folder)?;
    let all = || thread::available_parallelism().map_or(1, usize::from);
    let jobs = many.jobs.unwrap_or_else(all).min(applications.len());
    let next = AtomicUsize::new(0);
    let failed = thread::scope(|scope| {
        let (sender, receiver) = mpsc::sync_channel(jobs);
        for started in 0..jobs {
            let (sender, next) = (sender.clone(), &next);
            let work = move || work(many, applications, next, &sender);
            match Builder::new().spawn_scoped(scope, work) {
                Ok(_) => {}
                // Fewer threads do the same work.
                Err(_) if started > 0 => break,
                Err(error) => bail!("cannot start a thread: {error}"),
            }
        }
        drop(sender);
        print(&receiver, applications.len())
    })?;
    Ok(if failed {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    })
}

/// Take one file after the other, until there is none left or nobody listens.
fn work(
    many: &ManyFiles,
    applications: &[Application],
    next: &AtomicUsize,
    sender: &SyncSender<Told>,
) {
    loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        let (Some(application), Some(files)) = (applications.get(index), many.files.get(index))
        else {
            return;
        };
        let line = line(application, files, many.full);
        let told = Told {
            index,
            failed: line.error.is_some(),
            text: json_layout::to_line(&line),
        };
        if sender.send(told).is_err() {
            return;
        }
    }
}

/// Print the lines in the order of their files; returns whether a file failed.
fn print(receiver: &Receiver<Told>, count: usize) -> anyhow::Result<bool> {
    // Where lines appear on a terminal, they tell enough.
    let is_told = io::stderr().is_terminal() && !io::stdout().is_terminal();
    let mut progress = is_told.then(Progress::new);
    let mut waiting = HashMap::new();
    let (mut printed, mut failed) = (0, false);
    for (done, told) in receiver.iter().enumerate() {
        failed |= told.failed;
        waiting.insert(told.index, told.text);
        while let Some(text) = waiting.remove(&printed) {
            output::print(&text)?;
            printed += 1;
        }
        if let Some(progress) = &mut progress {
            progress.tell(format_args!("{} of {count} files", done + 1));
        }
    }
    Ok(failed)
}

/// Run an application, and tell what became of its file.
fn line(application: &Application, [file, out]: &[PathBuf; 2], full: bool) -> Line {
    let begin = Instant::now();
    let messages = Messages::Kept(Default::default());
    let result = catch_unwind(AssertUnwindSafe(|| application.run(&messages)));
    let time = begin.elapsed().as_micros() as f64 / 1e6;
    let result = result.unwrap_or_else(|panic| {
        let panic = panic_message(panic.as_ref());
        Err(anyhow!(
            "{}: the operation failed: {panic}",
            application.place()
        ))
    });
    let (report, written) = match result {
        Ok(Done { report, written }) => (Some(report), written),
        Err(error) => (None, Err(error)),
    };
    let missed = report.as_ref().filter(|report| !report.reached);
    let missed = missed.map(Report::summary);
    let (is_written, error) = match written {
        Ok(is_written) => (is_written, missed),
        Err(error) => (false, Some(format!("{error:#}"))),
    };
    let shown = |path: &Path| path.to_string_lossy().into_owned();
    Line {
        file: shown(file),
        out: is_written.then(|| shown(out)),
        reached: report.as_ref().map(|report| report.reached),
        extrema: report.as_ref().and_then(Report::extrema),
        largest: report.as_ref().and_then(Report::largest),
        time,
        error,
        full: full.then(|| Full {
            report,
            messages: messages.into_lines(),
        }),
    }
}

#[cfg(test)]
mod tests;
