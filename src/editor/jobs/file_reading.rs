//! Files to read, with the answers to questions for the columns of their tables.

use std::path::{Path, PathBuf};

use crate::document::EditError;
use crate::editor::reply::Refusal;
use crate::geometry::expressions::LengthUnit;
use crate::io::{
    ColumnChoice, FileError, FileProblem, Fingerprint, Problem, ReadError, Reading, TableColumn,
    disk,
};

/// What becomes of merged documents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::editor) enum Purpose {
    /// They replace the document.
    Open,
    /// The only one replaces the document, and is written back to its file in the file's format.
    Edit,
    /// They are added.
    Import,
    /// Copies of them are added.
    Paste,
}

/// Files to read.
#[derive(Clone, Debug)]
pub(in crate::editor) struct FilesToRead {
    pub(in crate::editor) paths: Vec<PathBuf>,
    pub(in crate::editor) purpose: Purpose,
    /// The choices for tables with these columns.
    pub(in crate::editor) answers: Vec<(Vec<TableColumn>, ColumnChoice)>,
}

/// A question for the columns of x and y in a table, with the files that wait for the answer.
#[derive(Clone, Debug)]
pub struct ColumnQuestion {
    /// The file.
    pub path: PathBuf,
    /// The columns that may be x and y.
    pub columns: Vec<TableColumn>,
    pub(in crate::editor) waiting: FilesToRead,
}

/// An answer to a question of files.
#[derive(Clone, Debug)]
pub enum FileAnswer {
    /// The unit of the document.
    Unit(LengthUnit),
    /// The columns of a table.
    Columns(ColumnChoice),
}

/// A reason why a file is not read.
pub(super) enum Unread {
    /// It cannot be.
    Refused(Refusal),
    /// Its columns must be chosen first.
    Asked(Box<ColumnQuestion>),
}

impl From<FileError> for Unread {
    fn from(error: FileError) -> Self {
        Self::Refused(error.into())
    }
}

impl From<EditError> for Unread {
    fn from(error: EditError) -> Self {
        Self::Refused(error.into())
    }
}

impl FilesToRead {
    /// Read one of the files, a table by the answer for its columns.
    ///
    /// # Errors
    /// [`Unread`].
    pub(super) fn read(&self, path: &Path) -> Result<(Reading, Fingerprint), Unread> {
        let error = match disk::read_with_fingerprint(path, None, None) {
            Ok(read) => return Ok(read),
            Err(error) => error,
        };
        let Some(columns) = ambiguous(&error) else {
            return Err(error.into());
        };
        let mut answers = self.answers.iter();
        match answers.find(|(known, _)| known == columns) {
            Some((_, choice)) => Ok(disk::read_with_fingerprint(path, None, Some(choice))?),
            None => Err(Unread::Asked(Box::new(ColumnQuestion {
                path: path.to_owned(),
                columns: columns.to_vec(),
                waiting: self.clone(),
            }))),
        }
    }
}

/// The columns that an error asks to choose from.
fn ambiguous(error: &FileError) -> Option<&[TableColumn]> {
    match &error.problem {
        FileProblem::Content(ReadError {
            problem: Problem::AmbiguousColumns(columns),
            ..
        }) => Some(columns),
        _ => None,
    }
}
