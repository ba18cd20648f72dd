//! Files to read, with the answers to questions for the columns of their tables.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::document::{Document, EditError};
use crate::editor::reply::Refusal;
use crate::geometry::Progress;
use crate::geometry::expressions::LengthUnit;
use crate::io::exchange::drawing::Drawing;
use crate::io::exchange::import::{Found, ImportChoice};
use crate::io::{
    ColumnChoice, FileError, FileProblem, Fingerprint, Problem, ReadError, Reading, TableColumn,
    disk, formats,
};
use crate::operations::{FloatRequest, OperationError, floated};

/// The time to make float polygons of the references of some files.
const FLOAT_TIME: Duration = Duration::from_secs(60);

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
    /// The choices for files of other programs.
    pub(in crate::editor) choices: HashMap<PathBuf, ImportChoice>,
    /// Whether files of other programs are asked about even where there is nothing to choose.
    pub(in crate::editor) asks: bool,
    /// The revision whose last step these files made: it is taken back before they come in again.
    pub(in crate::editor) retakes: Option<u64>,
}

/// A file of another program, with what was found in it.
#[derive(Clone, Debug)]
pub struct FoundFile {
    /// The file.
    pub path: PathBuf,
    /// What is in it.
    pub found: Found,
    /// What is taken of it at first: all that is free, or what was chosen before.
    pub choice: ImportChoice,
}

/// The question what to take of files of other programs.
#[derive(Clone, Debug)]
pub struct ImportQuestion {
    /// The files.
    pub files: Vec<FoundFile>,
    /// Whether they replace the document.
    pub replaces: bool,
    pub(in crate::editor) waiting: FilesToRead,
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
    /// What is taken of each file of another program.
    Import(Vec<ImportChoice>),
    /// Without a question: ask again what to take of the files of other programs that came in last. What they made is
    /// taken back when the answer to that comes, unless something else was done since.
    Anew,
}

/// A reason why a file is not read.
pub(super) enum Unread {
    /// It cannot be.
    Refused(Refusal),
    /// Its columns must be chosen first.
    Asked(Box<ColumnQuestion>),
    /// What is taken must be chosen first.
    AskedImport(Box<ImportQuestion>),
}

impl From<FileError> for Unread {
    fn from(error: FileError) -> Self {
        Self::Refused(error.into())
    }
}

impl From<OperationError> for Unread {
    fn from(error: OperationError) -> Self {
        Self::Refused(Refusal(error.to_string()))
    }
}

impl From<EditError> for Unread {
    fn from(error: EditError) -> Self {
        Self::Refused(error.into())
    }
}

/// A document that was read from a file.
pub(super) struct ReadFile {
    pub(super) document: Document,
    pub(super) fingerprint: Option<Fingerprint>,
    pub(super) remarks: String,
}

impl FilesToRead {
    /// Files to read for a purpose, without any answer.
    pub(in crate::editor) fn new(paths: &[PathBuf], purpose: Purpose) -> Self {
        Self {
            paths: paths.to_owned(),
            purpose,
            answers: Vec::new(),
            choices: HashMap::new(),
            asks: false,
            retakes: None,
        }
    }

    /// Read everything in the files of other programs that are not edited in place, by their paths.
    ///
    /// # Errors
    /// [`Unread::AskedImport`] if there is something to choose and no choice yet.
    pub(super) fn drawings(&self) -> Result<HashMap<&Path, Drawing>, Unread> {
        if self.purpose == Purpose::Edit {
            return Ok(HashMap::new());
        }
        let is_drawing =
            |path: &&PathBuf| formats::to_read(path).is_ok_and(|format| format.draws());
        let mut drawings = HashMap::new();
        let mut files = Vec::new();
        let mut asks = false;
        for path in self.paths.iter().filter(is_drawing) {
            let (drawing, _) = disk::draw_file(path, None)?;
            let chosen = self.choices.get(path);
            let found = drawing.found();
            asks |= self.asks || (chosen.is_none() && found.asks());
            files.push(FoundFile {
                choice: chosen.cloned().unwrap_or_else(|| found.choice()),
                path: path.clone(),
                found,
            });
            drawings.insert(path.as_path(), drawing);
        }
        match asks {
            false => Ok(drawings),
            true => Err(Unread::AskedImport(Box::new(ImportQuestion {
                files,
                replaces: self.purpose == Purpose::Open,
                waiting: self.clone(),
            }))),
        }
    }

    /// Read one of the files: a drawing as chosen, a table by the answer for its columns.
    ///
    /// # Errors
    /// [`Unread`].
    pub(super) fn read(
        &self,
        path: &Path,
        drawings: &HashMap<&Path, Drawing>,
        progress: &Progress,
    ) -> Result<ReadFile, Unread> {
        let choice = self.choices.get(path);
        let (mut reading, fingerprint) = match drawings.get(path) {
            Some(drawing) => {
                let reading = choice.map_or_else(|| drawing.reading(), |it| drawing.reading_of(it));
                (reading, None)
            }
            None => {
                let (reading, fingerprint) = self.read_table(path)?;
                (reading, Some(fingerprint))
            }
        };
        if self.purpose != Purpose::Edit {
            let stem = path.file_stem().unwrap_or_default();
            reading.name_lists(&stem.to_string_lossy());
        }
        let mut remarks = vec![std::mem::take(&mut reading.remarks).to_string()];
        remarks.retain(|lines| !lines.is_empty());
        let mut document = reading.into_document()?;
        if let Some(choice) = choice.filter(|choice| choice.to_float) {
            let request = FloatRequest {
                degree: None,
                tolerance: choice.tolerance,
            };
            let progress = progress.limited(FLOAT_TIME);
            let (made, told) = floated(&document, request, &progress)?;
            document = made;
            remarks.extend(told);
        }
        Ok(ReadFile {
            document,
            fingerprint,
            remarks: remarks.join("\n"),
        })
    }

    fn read_table(&self, path: &Path) -> Result<(Reading, Fingerprint), Unread> {
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
