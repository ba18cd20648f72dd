//! Where curves come from and go to: files, or the standard input and output.

use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};

use super::output::{self, Messages};
use crate::document::Document;
use crate::geometry::expressions::LengthUnit;
use crate::io::exchange::import::ImportFilter;
use crate::io::{
    ColumnChoice, Export, ExportChoice, FileError, FileProblem, Format, FormatError, Problem,
    ReadError, Reading, disk, formats, shown_path,
};

/// The name that stands for the standard input or output.
pub(super) const STANDARD: &str = "-";

/// A source of curves.
pub(super) struct Source {
    /// The file; `None`: the standard input.
    path: Option<PathBuf>,
    /// The format, whatever the file's name says.
    format: Option<&'static Format>,
    /// The columns of points in a table.
    columns: Option<ColumnChoice>,
    /// What is taken of a drawing; without it what is free.
    filter: Option<ImportFilter>,
}

impl Source {
    /// Name a source; the standard input is one only if its format is given.
    pub(super) fn new(
        path: PathBuf,
        format: Option<&'static Format>,
        columns: Option<ColumnChoice>,
    ) -> Option<Self> {
        let path = Some(path).filter(|path| path.as_os_str() != STANDARD);
        let is_known = path.is_some() || format.is_some();
        is_known.then_some(Self {
            path,
            format,
            columns,
            filter: None,
        })
    }

    /// Take of a drawing only what a filter chooses.
    pub(super) fn choosing(self, filter: ImportFilter) -> Self {
        let filter = Some(filter).filter(|filter| *filter != ImportFilter::default());
        Self { filter, ..self }
    }

    /// Read what the filter chooses of a drawing.
    fn chosen(&self, filter: &ImportFilter) -> anyhow::Result<Reading> {
        let drawing = match (&self.path, self.format) {
            (None, Some(format)) => disk::draw_stream(io::stdin().lock(), &self.name(), format)?,
            (path, format) => {
                let path = path.as_deref().unwrap_or(Path::new(STANDARD));
                disk::draw_file(path, format)?.0
            }
        };
        let choice = drawing.found().matching(filter);
        Ok(drawing.reading_of(&choice.with_context(|| self.name())?))
    }

    /// Read it, and tell its remarks.
    ///
    /// # Errors
    /// [`FileError`], naming the source and the place in it.
    pub(super) fn read(&self, messages: &Messages) -> anyhow::Result<Reading> {
        if let Some(filter) = &self.filter {
            let reading = self.chosen(filter)?;
            messages.report(&self.name(), &reading.remarks);
            return Ok(reading);
        }
        let columns = self.columns.as_ref();
        let reading = match (&self.path, self.format) {
            (None, Some(format)) => {
                disk::read_stream(io::stdin().lock(), &self.name(), format, columns)
            }
            (path, format) => {
                let path = path.as_deref().unwrap_or(Path::new(STANDARD));
                let read = disk::read_with_fingerprint(path, format, columns);
                read.map(|(reading, _)| reading)
            }
        };
        let reading = reading.map_err(|error| match &error.problem {
            FileProblem::Content(ReadError {
                problem: Problem::AmbiguousColumns(_),
                ..
            }) => anyhow!("{error} with --columns, as in --columns 1,2"),
            FileProblem::Format(FormatError::UnknownExtension { .. }) => {
                anyhow!("{error}, or name its format with --from-format")
            }
            _ => error.into(),
        })?;
        messages.report(&self.name(), &reading.remarks);
        Ok(reading)
    }

    /// Read it as a document, in an assumed unit if it states none.
    ///
    /// # Errors
    /// As [`Source::read`].
    pub(super) fn document(
        &self,
        assumed: Option<LengthUnit>,
        messages: &Messages,
    ) -> anyhow::Result<Document> {
        let document = self.read(messages)?.into_document()?;
        let unit = document.unit().or(assumed);
        Ok(document.with_unit(unit))
    }

    /// What messages call it.
    pub(super) fn name(&self) -> String {
        match &self.path {
            None => "standard input".to_owned(),
            Some(path) => shown_path(path),
        }
    }
}

/// A destination of curves.
pub(super) enum Destination {
    /// The standard output, in this format.
    Standard(&'static Format),
    /// A file, of this format whatever its name says.
    File(PathBuf, Option<&'static Format>),
}

impl Destination {
    /// Name the pictures of a document from the folder that it is written to.
    pub(super) fn placed(&self, document: Document) -> Document {
        match self {
            Self::Standard(_) => document,
            Self::File(path, _) => disk::beside_pictures(document, path),
        }
    }

    /// Name a destination; the standard output is one only if its format is given.
    pub(super) fn new(path: PathBuf, format: Option<&'static Format>) -> Option<Self> {
        if path.as_os_str() == STANDARD {
            format.map(Self::Standard)
        } else {
            Some(Self::File(path, format))
        }
    }

    /// The format to write.
    ///
    /// # Errors
    /// [`FileError`] if it is not given and the file's name does not tell it.
    pub(super) fn format(&self) -> Result<&'static Format, FileError> {
        match self {
            Self::Standard(format) | Self::File(_, Some(format)) => Ok(*format),
            Self::File(path, None) => formats::to_write(path).map_err(FileError::at(path)),
        }
    }

    /// Whether its format holds cubic Béziers alone.
    pub(super) fn holds_cubics_alone(&self) -> bool {
        self.format()
            .is_ok_and(|format| ExportChoice::new(format).holds_cubics_alone())
    }

    /// Whether it is the standard output.
    pub(super) fn is_standard(&self) -> bool {
        matches!(self, Self::Standard(_))
    }

    /// Whether it is the file that a source is.
    pub(super) fn is(&self, source: &Source) -> bool {
        match (self, &source.path) {
            (Self::File(path, _), Some(source)) => disk::is_same_file(source, path),
            _ => false,
        }
    }

    /// Write an export, and tell its losses.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn write(&self, export: Export, messages: &Messages) -> anyhow::Result<()> {
        match self {
            Self::Standard(_) => {
                output::print_bytes(&export.bytes)?;
                messages.tell(&export.losses.to_string());
            }
            Self::File(path, _) => {
                let saved = disk::write_export(path, export)?;
                messages.tell(&saved.losses.to_string());
                if let Some(line) = saved.broken_links() {
                    messages.tell(&format!("{}: {line}", self.name()));
                }
            }
        }
        Ok(())
    }

    /// What messages call it.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Standard(_) => "standard output".to_owned(),
            Self::File(path, _) => shown_path(path),
        }
    }
}
