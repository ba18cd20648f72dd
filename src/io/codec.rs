//! What reads and writes each format: the one file that knows all of them.

use std::borrow::Borrow;

use super::error::{Problem, ReadError, WriteError};
use super::file_match::FileMatch;
use super::format::Format;
use super::loss::Export;
use super::reading::Reading;
use super::{dxf, project, table};
use crate::document::{Curve, CurveId, Document, Extras, Reference};
use crate::geometry::PolygonKind;

impl Format {
    /// Read the curves of a file's bytes.
    ///
    /// # Errors
    /// [`ReadError`] with the place. A format that [cannot be read](Self::can_read) says so.
    pub fn read(self, bytes: &[u8]) -> Result<Reading, ReadError> {
        match self {
            Self::Batten => project::read(bytes),
            Self::Csv => table::read(bytes),
            Self::Dxf => Err(ReadError::from(Problem::Unreadable(self))),
        }
    }

    /// Write curves to bytes, in no unit.
    ///
    /// `polygon` chooses by which polygon each curve is held (project and table) or which
    /// polygon is drawn beside it (DXF); without it a project and a table hold the float
    /// polygon, and a DXF draws the float and the clamped one. `extras` are those of the
    /// project, which only a project holds.
    ///
    /// # Errors
    /// [`WriteError`] if the format cannot hold the curves at all.
    pub fn write<C: Borrow<Curve>>(
        self,
        curves: &[C],
        extras: &Extras,
        polygon: Option<PolygonKind>,
    ) -> Result<Export, WriteError> {
        let curves: Vec<&Curve> = curves.iter().map(Borrow::borrow).collect();
        let mut export = match self {
            Self::Batten => {
                let kind = polygon.unwrap_or_default();
                project::write(&curves, &[], &[], (None, &[], extras), kind)
            }
            Self::Csv => table::write(&curves, &[], None, polygon.unwrap_or_default())?,
            Self::Dxf => dxf::write(&curves, None, polygon)?,
        };
        export.losses.project_keys = self != Self::Batten && !extras.is_empty();
        Ok(export)
    }

    /// Write a document to bytes as [`Format::write`] does its curves, a project with the references and
    /// the matches, a table with the references that are points.
    ///
    /// # Errors
    /// As [`Format::write`].
    pub fn write_document(
        self,
        document: &Document,
        polygon: Option<PolygonKind>,
    ) -> Result<Export, WriteError> {
        let curves: Vec<&Curve> = document.curves().map(|(_, curve)| &**curve).collect();
        let references: Vec<&Reference> = document.references().map(|(_, it)| &**it).collect();
        let (matches, extras) = (FileMatch::all(document), document.extras());
        let unit = document.unit();
        let numbers: Vec<u64> = document.all_ids().map(CurveId::number).collect();
        let kind = polygon.unwrap_or_default();
        let mut export = match self {
            Self::Batten => {
                let about = (unit, numbers.as_slice(), extras);
                project::write(&curves, &references, &matches, about, kind)
            }
            Self::Csv => table::write(&curves, &references, unit, kind)?,
            Self::Dxf => {
                let mut export = dxf::write(&curves, unit, polygon)?;
                export.losses.add_references(references);
                export
            }
        };
        if self != Self::Batten {
            export.losses.add_matches(document, |_| true);
            export.losses.project_keys = !extras.is_empty();
        }
        Ok(export)
    }
}
