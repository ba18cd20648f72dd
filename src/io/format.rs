//! A row of the table of formats: how files of one format are read, written and exported.

use std::fmt;
use std::hash::{Hash, Hasher};

use super::error::{Problem, ReadError, WriteError};
use super::exchange::changes::Rewriter;
use super::exchange::drawing::{Drawing, Unreadable};
use super::exchange::remarks::shortened;
use super::loss::{DocumentLoss, Export, Loss, LossReport};
use super::reading::Reading;
use super::table_columns::ColumnChoice;
use crate::document::Document;
use crate::geometry::PolygonKind;

/// A file with a zero among so many bytes is binary.
const TOLD_BY: usize = 1024;

/// A file format. Its module defines it as a static row; [`super::formats`] lists the rows.
pub struct Format {
    /// The name in dialogs and messages.
    pub name: &'static str,
    /// The extensions of its files in lower case, without the dot. New files get the first.
    pub extensions: &'static [&'static str],
    /// Reads the bytes of a file; `None` if it is a drawing.
    pub(super) read: Option<ReadBytes>,
    /// Reads a file whose points are in chosen columns; `None` if it has no columns.
    pub(super) read_chosen: Option<ReadChosen>,
    /// Reads what a file of another program holds; `None` for Batten's own and for tables.
    pub(super) draw: Option<DrawBytes>,
    /// Writes a document and reports what the file does not hold; `None` if the format is only read.
    pub(super) write: Option<WriteDocument>,
    /// Writes a document back to a file that was read, where that differs from `write`: without what an export adds
    /// beside the curves.
    pub(super) write_back: Option<WriteDocument>,
    /// Writes changes into the text of a file that was read, and leaves everything else as it was; `None` if the format
    /// does not allow it.
    pub(super) rewrite: Option<Rewriter>,
    /// What its files say of the unit of length.
    pub(super) file_unit: FileUnit,
    /// Whether it holds matches and unknown keys; then a document can be saved in it.
    pub holds_documents: bool,
    /// The exports that the menu offers.
    pub exports: &'static [ExportRow],
}

/// Read the bytes of a file.
type ReadBytes = fn(&[u8]) -> Result<Reading, ReadError>;

/// Read the bytes of a file from chosen columns.
type ReadChosen = fn(&[u8], &ColumnChoice) -> Result<Reading, ReadError>;

/// Read the bytes of a file as a drawing.
type DrawBytes = fn(&[u8]) -> Result<Drawing, Unreadable>;

/// Write a document.
type WriteDocument = fn(&Document, &Writing, &mut LossReport) -> Result<Vec<u8>, WriteError>;

/// How a document is written, where formats leave a choice.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Writing {
    /// The polygon by which a project or a table holds each curve, or whose knots splines get; without one that which
    /// the format prefers.
    pub(super) polygon: Option<PolygonKind>,
    /// The polygons that a DXF draws beside each curve; without a list `polygon`, or those that it prefers.
    pub(super) beside: Option<Vec<PolygonKind>>,
    /// How far cubic Béziers may be off their curve; without it 1e-4 of its size.
    pub(super) tolerance: Option<f64>,
}

impl From<Option<PolygonKind>> for Writing {
    fn from(polygon: Option<PolygonKind>) -> Self {
        Self {
            polygon,
            ..Self::default()
        }
    }
}

/// What the files of a format say of the unit of length.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FileUnit {
    /// The unit, where it is known.
    Optional,
    /// Always a unit: numbers without one are written as millimetres.
    Always,
    /// Nothing: lengths have no unit at all, as in glyphs.
    None,
}

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

    /// Whether documents can be written in the format.
    pub fn can_write(&self) -> bool {
        self.write.is_some()
    }

    /// Read the bytes of a file.
    ///
    /// # Errors
    /// [`ReadError`] with the place.
    pub fn read(&self, bytes: &[u8]) -> Result<Reading, ReadError> {
        self.read_columns(bytes, None)
    }

    /// Read the bytes of a file, the points of a table from chosen columns.
    ///
    /// # Errors
    /// As [`Format::read`]; [`Problem::NoChoice`] if there are no columns to choose.
    pub fn read_columns(
        &self,
        bytes: &[u8],
        choice: Option<&ColumnChoice>,
    ) -> Result<Reading, ReadError> {
        match (self.read, choice) {
            (Some(read), None) => read(bytes),
            (Some(_), Some(choice)) => self.read_chosen.ok_or(Problem::NoChoice)?(bytes, choice),
            (None, Some(_)) if self.draw.is_some() => Err(Problem::NoChoice.into()),
            (None, _) => Ok(self.draw(bytes)?.reading()),
        }
    }

    /// Read everything that a file of another program holds.
    ///
    /// # Errors
    /// [`ReadError`] with the place if nothing can be read, or if the format has no drawings.
    pub fn draw(&self, bytes: &[u8]) -> Result<Drawing, ReadError> {
        let draw = self.draw.ok_or(Problem::NoDrawing(self.name))?;
        // Binary files have no lines.
        let is_binary = bytes.iter().take(TOLD_BY).any(|byte| *byte == 0);
        match draw(bytes) {
            Ok(mut drawing) => {
                drawing.tell_cut_names();
                let remarks = std::mem::take(&mut drawing.remarks).into_iter();
                drawing.remarks = remarks.map(shortened).collect();
                if drawing.is_empty() && drawing.remarks.is_empty() {
                    let none = format!("the {} has no curve and no point", self.name);
                    drawing.remarks.push(none);
                }
                Ok(Drawing {
                    is_binary,
                    is_unitless: self.file_unit == FileUnit::None,
                    ..drawing
                })
            }
            Err(error) => Err(error.into_error(is_binary)),
        }
    }

    /// Whether its files are drawings of other programs.
    pub fn draws(&self) -> bool {
        self.draw.is_some()
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
        self.write_as(document, &polygon.into())
    }

    /// Write a document as it is said.
    ///
    /// # Errors
    /// As [`Format::write`].
    pub(super) fn write_as(
        &self,
        document: &Document,
        writing: &Writing,
    ) -> Result<Export, WriteError> {
        let write = self.write.ok_or(WriteError::ReadOnly(self.name))?;
        self.written(write, document, writing)
    }

    /// Write a document back to a file of another program: the curves and references alone.
    ///
    /// # Errors
    /// As [`Format::write`].
    pub fn write_back(&self, document: &Document) -> Result<Export, WriteError> {
        let write = self.write_back.or(self.write);
        let write = write.ok_or(WriteError::ReadOnly(self.name))?;
        self.written(write, document, &Writing::default())
    }

    fn written(
        &self,
        write: WriteDocument,
        document: &Document,
        writing: &Writing,
    ) -> Result<Export, WriteError> {
        let mut losses = LossReport::new(self.name);
        if self.holds_documents {
            let bytes = write(document, writing, &mut losses)?;
            return Ok(Export { bytes, losses });
        }
        let (document, pictures) = &document.without_pictures();
        let bytes = write(document, writing, &mut losses)?;
        let pictures = pictures.iter().cloned();
        losses
            .losses
            .extend(pictures.map(|name| (name, Loss::Picture)));
        losses.add_matches(document, |_| true);
        losses.add_document(document);
        let unit = match (self.file_unit, document.unit()) {
            (FileUnit::Always, None) => Some(DocumentLoss::NoUnit),
            (FileUnit::None, Some(_)) => Some(DocumentLoss::Unit),
            _ => None,
        };
        losses.of_document.extend(unit);
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
