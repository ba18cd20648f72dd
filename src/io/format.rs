//! A row of the table of formats: how files of one format are read, written and exported.

use std::fmt;
use std::hash::{Hash, Hasher};

use super::error::{Problem, ReadError, WriteError};
use super::loss::{Export, LossReport};
use super::reading::Reading;
use crate::document::Document;
use crate::geometry::PolygonKind;

/// A file format. Its module defines it as a static row; [`super::formats`] lists the rows.
pub struct Format {
    /// The name in dialogs and messages.
    pub name: &'static str,
    /// The extensions of its files in lower case, without the dot. New files get the first.
    pub extensions: &'static [&'static str],
    /// Reads the bytes of a file; `None` if the format is only written.
    pub(super) read: Option<ReadBytes>,
    /// Writes a document and reports what the file does not hold.
    pub(super) write: WriteDocument,
    /// Whether it holds matches and unknown keys; then a document can be saved in it.
    pub holds_documents: bool,
    /// The exports that the menu offers.
    pub exports: &'static [ExportRow],
}

/// Read the bytes of a file.
type ReadBytes = fn(&[u8]) -> Result<Reading, ReadError>;

/// Write a document by one of its polygons; without a choice by those that the format prefers.
type WriteDocument =
    fn(&Document, Option<PolygonKind>, &mut LossReport) -> Result<Vec<u8>, WriteError>;

/// A row of the menu for an export.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct ExportRow {
    /// The label.
    pub label: &'static str,
    /// The help text.
    pub help: &'static str,
    /// The icon, by its name in the icon font.
    pub icon: &'static str,
    /// The letter that exports together with Ctrl.
    pub key: Option<char>,
    /// The polygon to write; `None`: those that the format prefers.
    pub polygon: Option<PolygonKind>,
}

/// A format with one of its exports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Exporter {
    /// The format.
    pub format: &'static Format,
    /// The row of the menu.
    pub row: &'static ExportRow,
}

impl Format {
    /// The extension of new files, without the dot.
    pub fn extension(&self) -> &'static str {
        self.extensions.first().copied().unwrap_or_default()
    }

    /// Whether files of the format can be read.
    pub fn can_read(&self) -> bool {
        self.read.is_some()
    }

    /// Read the bytes of a file.
    ///
    /// # Errors
    /// [`ReadError`] with the place. A format that [cannot be read](Self::can_read) says so.
    pub fn read(&self, bytes: &[u8]) -> Result<Reading, ReadError> {
        let read = self.read.ok_or(Problem::Unreadable(self.name))?;
        read(bytes)
    }

    /// Write a document to bytes.
    ///
    /// `polygon` chooses the polygon by which a project or a table holds each curve (default:
    /// float), or the one that a DXF draws beside it (default: float and clamped).
    ///
    /// # Errors
    /// [`WriteError`] if the format cannot hold the document at all.
    pub fn write(
        &self,
        document: &Document,
        polygon: Option<PolygonKind>,
    ) -> Result<Export, WriteError> {
        let mut losses = LossReport::new(self.name);
        let bytes = (self.write)(document, polygon, &mut losses)?;
        if !self.holds_documents {
            losses.add_matches(document, |_| true);
            losses.project_keys = !document.extras().is_empty();
        }
        Ok(Export { bytes, losses })
    }
}

impl fmt::Display for Format {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name)
    }
}

impl fmt::Debug for Format {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, formatter)
    }
}

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Format {}

impl Hash for Format {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}
