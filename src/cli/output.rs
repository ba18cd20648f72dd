//! Printing to readers that may go away.

use std::cell::{Cell, RefCell};
use std::io::{self, BufWriter, ErrorKind, Write};

use serde::{Serialize, Serializer};

use crate::document::cut;
use crate::io::{Remarks, json_layout};

/// Where the remarks on files go.
#[derive(Debug)]
pub(super) enum Messages {
    /// To the standard error, at once.
    Printed,
    /// Into a list, where they belong to one file among many.
    Kept(RefCell<Vec<String>>),
}

impl Messages {
    /// Tell a text, line by line.
    pub(super) fn tell(&self, text: &str) {
        match self {
            Self::Printed => message(text),
            Self::Kept(list) => list.borrow_mut().extend(text.lines().map(str::to_owned)),
        }
    }

    /// Return the lines that were kept.
    pub(super) fn into_lines(self) -> Vec<String> {
        match self {
            Self::Printed => Vec::new(),
            Self::Kept(list) => list.into_inner(),
        }
    }

    /// Tell the remarks on a file, each line with the file in front.
    pub(super) fn report(&self, name: &str, remarks: &Remarks) {
        for line in remarks.to_string().lines() {
            self.tell(&format!("{name}: {line}"));
        }
    }
}

/// Print to the standard output. A reader that has gone away wants no more, which is no error.
pub(super) fn print(text: &str) -> anyhow::Result<()> {
    print_bytes(text.as_bytes())
}

/// Print to the standard error what is meant for the standard output, where curves go there.
pub(super) fn print_error(text: &str) {
    // Where nobody listens there is nobody to tell.
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Print bytes, as [`print`] does text.
pub(super) fn print_bytes(bytes: &[u8]) -> anyhow::Result<()> {
    printed(|out| out.write_all(bytes))
}

/// Print a value as JSON.
pub(super) fn print_json<T: Serialize>(value: &T) -> anyhow::Result<()> {
    printed(|out| json_layout::write(value, out))
}

/// A list whose elements are made when they are printed, one by one.
pub(super) struct OneByOne<I>(Cell<Option<I>>);

impl<I> OneByOne<I> {
    /// Wait to print the elements, once.
    pub(super) fn new(elements: I) -> Self {
        Self(Cell::new(Some(elements)))
    }
}

impl<I: Iterator> Serialize for OneByOne<I>
where
    I::Item: Serialize,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.take().into_iter().flatten())
    }
}

fn printed(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> anyhow::Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    match write(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(anyhow::Error::new(error).context("cannot write to the standard output"))
        }
        _ => Ok(()),
    }
}

/// Print what is wrong with the usage to the standard error; what was typed is made fit for it.
pub(super) fn usage(text: &str) {
    let mut out = io::stderr().lock();
    for line in text.lines() {
        let words: Vec<String> = line.split(' ').map(cut).collect();
        // Where nobody listens there is nobody to tell.
        let _ = writeln!(out, "{}", words.join(" "));
    }
}

/// Print to the standard error, each line with the program's name in front.
pub(super) fn message(text: &str) {
    let mut out = io::stderr().lock();
    for line in text.lines() {
        // Where nobody listens there is nobody to tell.
        let _ = writeln!(out, "batten: {line}");
    }
}
