//! Errors of reading and writing files, with their places.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::table_column::{MOST_COLUMNS, TableColumn};
use crate::document::{EditError, cut, escaped, quoted};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::ReferenceError;
use crate::geometry::{MAX_DEGREE, PolygonError, PolygonKind, counted};

/// A place in a file, as exactly as it is known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The line, counted from 1.
    pub line: Option<usize>,
    /// The byte in the line, counted from 1.
    pub column: Option<usize>,
    /// The curve, counted from 1.
    pub curve: Option<usize>,
    /// The reference, counted from 1.
    pub reference: Option<usize>,
    /// The name of the curve or of the reference.
    pub name: Option<String>,
    /// The vertex, counted from 0 as on the screen.
    pub vertex: Option<usize>,
}

impl Place {
    /// Name a line.
    pub fn line(line: usize) -> Self {
        Self {
            line: Some(line),
            ..Self::default()
        }
    }

    /// Name a curve: its number, counted from 1, and its name.
    pub fn curve(number: usize, name: &str) -> Self {
        Self {
            curve: Some(number),
            name: Some(name.to_owned()),
            ..Self::default()
        }
    }

    /// Name a reference: its number, counted from 1, and its name.
    pub fn reference(number: usize, name: &str) -> Self {
        Self {
            reference: Some(number),
            name: Some(name.to_owned()),
            ..Self::default()
        }
    }

    /// Make an error of a problem at this place.
    pub fn problem(self, problem: Problem) -> ReadError {
        ReadError {
            place: Box::new(self),
            problem,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |what: &str, value: Option<usize>| Some(format!("{what} {}", value?));
        let item = number("curve", self.curve).or(number("reference", self.reference));
        let item = item.map(|item| match &self.name {
            Some(name) => format!("{item} {}", quoted(name)),
            None => item,
        });
        let parts = [
            number("line", self.line),
            number("column", self.column),
            item,
            number("vertex", self.vertex),
        ];
        let known: Vec<String> = parts.into_iter().flatten().collect();
        formatter.write_str(&known.join(", "))
    }
}

/// A reason why a file cannot be read, with its place. Nothing is read then.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// The place.
    pub place: Box<Place>,
    /// The problem.
    pub problem: Problem,
}

impl From<Problem> for ReadError {
    fn from(problem: Problem) -> Self {
        Place::default().problem(problem)
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = self.place.to_string();
        // These problems name the vertex themselves, which continues the place.
        let continued = matches!(
            self.problem,
            Problem::Polygon(PolygonError::BadCoordinate { .. } | PolygonError::BadWeight { .. })
                | Problem::FewerCoordinates { .. }
        );
        match (place.is_empty(), continued) {
            (true, _) => write!(formatter, "{}", self.problem),
            (false, true) => write!(formatter, "{place}, {}", self.problem),
            (false, false) => write!(formatter, "{place}: {}", self.problem),
        }
    }
}

impl std::error::Error for ReadError {}

/// A problem of a file's content.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Problem {
    /// Nothing of a drawing can be read.
    #[error("{0}")]
    Drawing(String),
    /// The format holds no drawings of other programs.
    #[error("{0} files are no drawings of other programs: “batten inspect” prints what they hold")]
    NoDrawing(&'static str),
    /// The file has no content.
    #[error("the file is empty")]
    Empty,
    /// A picture cannot be read.
    #[error("the picture cannot be read: {0}")]
    Picture(String),
    /// The file is not text in UTF-8.
    #[error("the file is not text in UTF-8 here: save it as UTF-8")]
    NotUtf8,
    /// The JSON is malformed, or has something else than belongs there.
    #[error("{0}")]
    Json(String),
    /// The table cannot be split into values.
    #[error("the table cannot be read: {0}")]
    Table(String),
    /// A number is written that is none, or is infinite.
    #[error("{} is not a finite number: only finite numbers can be used", quoted(.0))]
    NotFinite(String),
    /// The JSON is no project.
    #[error(
        "this is not a Batten project: it says {}, where \"format\": \"batten\" is needed",
        match .found { Some(found) => format!("\"format\": {}", cut(found)), None => "no \"format\"".to_owned() }
    )]
    WrongFormat {
        /// The format that it claims to have.
        found: Option<String>,
    },
    /// The project is of a version that this program does not know.
    #[error(
        "the project is of version {found}, and this Batten reads versions up to {newest}: open it with a newer Batten"
    )]
    NewerVersion {
        /// Its version.
        found: u64,
        /// The newest version that can be read.
        newest: u64,
    },
    /// The project has no version, or one that is no number from 1 up.
    #[error("the project's \"version\" is {}: a whole number from 1 up is needed", cut(.found))]
    BadVersion {
        /// The text in the file.
        found: String,
    },
    /// The vertices do not make a curve.
    #[error("{0}")]
    Polygon(#[from] PolygonError),
    /// A vertex or a point has 2 numbers where others have 3.
    #[error("{what} {index} has 2 numbers where others have 3: give all of them as many")]
    FewerCoordinates {
        /// What it is: vertex or point.
        what: &'static str,
        /// The vertex or the point, counted from 0.
        index: usize,
    },
    /// A periodic curve is given by a polygon that has two ends.
    #[error(
        "a periodic curve cannot be given by its {kind} polygon, which starts and ends somewhere: give its float polygon, or make it open"
    )]
    PeriodicKind {
        /// The polygon's kind.
        kind: PolygonKind,
    },
    /// A target has a direction or a normal that does not point anywhere.
    #[error("the target of the {end} has a {what} of length 0: give another one, or null")]
    ZeroVector {
        /// The end.
        end: &'static str,
        /// Which vector it is.
        what: &'static str,
    },
    /// A target has a number that cannot be used.
    #[error(
        "the target of the {end} has the number {value:e}: only numbers up to 1e100 can be used"
    )]
    TargetOutOfRange {
        /// The end.
        end: &'static str,
        /// The number.
        value: f64,
    },
    /// A match is of a curve that the project does not have.
    #[error("a match names curve {index}, and there are {count}, counted from 0")]
    NoSuchCurve {
        /// The number of the curve, counted from 0.
        index: usize,
        /// The number of curves.
        count: usize,
    },
    /// A match is of a reference that the project does not have.
    #[error("a match names reference {index}, and there are {count}, counted from 0")]
    NoSuchReference {
        /// The number of the reference, counted from 0.
        index: usize,
        /// The number of references.
        count: usize,
    },
    /// A match does not name one source.
    #[error("a match follows one thing: a curve, as source, or a reference")]
    MatchSource,
    /// A reference has no kind, formula, points or B-spline, or several of them.
    #[error(
        "a reference is one of four things: a kind with values, a formula, points or a B-spline"
    )]
    NoReference,
    /// A reference has a kind that is not known.
    #[error("{} is not a kind of reference that this program knows: there are {known}", quoted(.name))]
    NoSuchKind {
        /// The name given.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// A reference has a value that its kind does not.
    #[error("{kind} has no value {}", quoted(.name))]
    NoSuchValue {
        /// The kind's name.
        kind: &'static str,
        /// The value's name.
        name: String,
    },
    /// The keys of a reference make no curve.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// Ends cannot be matched as the project says.
    #[error("the project's matches are impossible: {0}")]
    Match(EditError),
    /// A table does not begin with a line that says what its vertices are.
    #[error(
        "the table does not say which curve its vertices make: put a line like “# degree=3 polygon=float periodic=false name=curve” above the line with the column names"
    )]
    NoTableHeader,
    /// A table has no rows that could be points.
    #[error("there are no points: no line has two numbers or more")]
    NoPoints,
    /// Columns are chosen where there are none to choose.
    #[error("columns can only be chosen in a table of points")]
    NoChoice,
    /// A column is chosen that the table does not have.
    #[error("the table has no column {column}: it has {}", listed(.known))]
    NoSuchColumn {
        /// The column, as it is chosen.
        column: String,
        /// The columns that there are.
        known: Vec<TableColumn>,
    },
    /// A table of points does not tell which columns are x and y.
    #[error("which columns are x and y? There are {}: name them x and y, or choose them", listed(.0))]
    AmbiguousColumns(Vec<TableColumn>),
    /// A line of a table has too many columns.
    #[error("the line has more than {MOST_COLUMNS} columns: a table of points needs 2 or 3")]
    TooManyColumns,
    /// A table has too many lists of points.
    #[error("the file has more than {0} lists of points: divide it")]
    TooManyLists(usize),
    /// Columns of points have different units.
    #[error(
        "the columns are in {} and in {}: give all coordinates in one unit",
        .0[0].name(), .0[1].name()
    )]
    MixedUnits([LengthUnit; 2]),
    /// The XML holds something else than tracks and routes.
    #[error("this is not a GPX file: it begins with <{}>", cut(.0))]
    NotGpx(String),
    /// All points of a list are one.
    #[error("all {0} points are at one place")]
    OnePlace(usize),
    /// A GPX file has no track or route of two points.
    #[error("there is no track and no route")]
    NoTrack,
    /// A point of a GPX file has no position.
    #[error("a point needs a {name}, a number from -{most} to {most}")]
    NoPosition {
        /// Latitude or longitude.
        name: &'static str,
        /// The largest number of degrees.
        most: f64,
    },
    /// The line above a table lacks the degree.
    #[error("the line lacks the degree: add, for example, degree=3 (from 1 to {MAX_DEGREE})")]
    NoDegree,
    /// The line above a table has something unknown.
    #[error(
        "{} is not known here: a line above a table holds degree=…, polygon=…, periodic=… and, last, name=…",
        quoted(.0)
    )]
    UnknownKey(String),
    /// The line above a table says something twice.
    #[error("{0} is given twice")]
    Repeated(&'static str),
    /// The line above a table has a value that cannot be used.
    #[error("{key}={} cannot be used: {needed}", cut(.value))]
    BadValue {
        /// Which value.
        key: &'static str,
        /// The text in the file.
        value: String,
        /// The needed value.
        needed: &'static str,
    },
    /// A table has no line with column names.
    #[error(
        "the table has no columns: put a line with their names, for example “x,y”, above its numbers"
    )]
    NoColumns,
    /// A column name is unknown or is there twice.
    #[error(
        "{} is not a column name that can stand here: the columns are x,y or x,y,z, then weight, each once and separated by commas, semicolons or tabs",
        quoted(.0)
    )]
    BadColumn(String),
    /// A column is missing.
    #[error("the column {0} is missing: the columns x and y are needed")]
    MissingColumn(&'static str),
    /// A line of a table has too many or too few values.
    #[error(
        "{} for {}",
        counted(*.found, "value", "values"),
        counted(*.needed, "column", "columns")
    )]
    ValueCount {
        /// The number of values.
        found: usize,
        /// The number of columns.
        needed: usize,
    },
    /// A value of a table is not a number.
    #[error("{} in column {column} is not a number", quoted(.text))]
    NotANumber {
        /// The column.
        column: &'static str,
        /// The text in the file.
        text: String,
    },
    /// A number has a decimal comma where others have a point, or the other way round.
    #[error(
        "{} has another decimal mark than the numbers before it: write all decimals with points, or all with commas",
        quoted(.0)
    )]
    MixedDecimals(String),
    /// No number tells whether commas are decimal ones.
    #[error(
        "{} can be read with a decimal comma or with a comma between thousands: write the table's decimals with points",
        quoted(.0)
    )]
    AmbiguousComma(String),
}

/// Name columns, of many the first.
fn listed(columns: &[TableColumn]) -> String {
    const MOST: usize = 30;
    let named: Vec<String> = columns.iter().take(MOST).map(ToString::to_string).collect();
    match columns.len().saturating_sub(MOST) {
        0 => named.join(", "),
        others => format!("{} and {others} more", named.join(", ")),
    }
}

/// A reason why curves cannot be written in a format.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum WriteError {
    /// There are no curves.
    #[error("there is no curve to write: {format} files need at least one")]
    NoCurves {
        /// The name of the format.
        format: &'static str,
    },
    /// There are no points.
    #[error("there are no points to write: a {format} holds points alone")]
    NoPoints {
        /// The name of the format.
        format: &'static str,
    },
    /// Files of the format are only read.
    #[error("{0} files can be read but not written")]
    ReadOnly(&'static str),
    /// The format cannot hold a curve.
    #[error("{format}: {reason}")]
    Refused {
        /// The name of the format.
        format: &'static str,
        /// Which curve, and why.
        reason: String,
    },
    /// Nothing is in the scope that is chosen.
    #[error("{}", match *.0 {
        "selected" => "nothing is selected: select what to write, or write what is visible",
        "visible" => "everything is hidden: show the curves to write, or write all",
        _ => "there is nothing to write",
    })]
    NothingChosen(&'static str),
    /// A program cannot read the degree of a curve.
    #[error(
        "{} has degree {degree}, and {program} reads degrees up to {most}: {why}. Choose a lower degree",
        quoted(.name)
    )]
    DegreeTooHigh {
        /// The curve's name.
        name: String,
        /// Its degree.
        degree: usize,
        /// The program.
        program: &'static str,
        /// The highest degree that it reads.
        most: usize,
        /// What it does with higher ones.
        why: &'static str,
    },
    /// Points on a curve would be too many.
    #[error("{} would take more than 100 000 points within {within:e}: allow more", quoted(.name))]
    TooManyPoints {
        /// The curve's name.
        name: String,
        /// How near the polyline through them was to be.
        within: f64,
    },
    /// The document cannot have the unit or the scale.
    #[error("{0}")]
    Size(#[from] EditError),
    /// A curve has more vertices than the format can count.
    #[error(
        "{} has {vertices} vertices, and a {format} file can hold {most} a curve: split the curve",
        quoted(.name)
    )]
    TooManyVertices {
        /// The name of the format.
        format: &'static str,
        /// The curve's name.
        name: String,
        /// The number of its vertices.
        vertices: usize,
        /// The most that can be written.
        most: usize,
    },
}

/// A reason why a file's name does not tell a usable format.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FormatError {
    /// The name has no extension.
    #[error("the name has no extension that tells its format: add one of {known}")]
    NoExtension {
        /// The extensions that could be used.
        known: String,
    },
    /// The file is a drawing of AutoCAD in its own format.
    #[error("DWG files are not read or written: use DXF, which the same programs know")]
    Dwg,
    /// The extension is unknown.
    #[error("“.{}” is not a format Batten knows: use one of {known}", cut(.extension))]
    UnknownExtension {
        /// The extension.
        extension: String,
        /// The extensions that could be used.
        known: String,
    },
    /// The format is only read.
    #[error(
        "{format} files can be read but not written: the formats that can be written are {known}"
    )]
    NotWritable {
        /// The name of the format.
        format: &'static str,
        /// The extensions that can be written.
        known: String,
    },
}

/// Show a path in a message: whole, but [escaped].
pub fn shown_path(path: &Path) -> String {
    escaped(&path.display().to_string())
}

/// A problem with a file. The message begins with the file.
#[derive(Debug, Error)]
#[error("{}: {problem}", shown_path(.path))]
pub struct FileError {
    /// The file.
    pub path: PathBuf,
    /// The problem.
    pub problem: FileProblem,
}

impl FileError {
    /// Name the file that a problem is one of.
    pub fn at<P: Into<FileProblem>>(path: &Path) -> impl FnOnce(P) -> Self {
        move |problem| Self {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }
}

/// A reason why a file cannot be read or written.
#[derive(Debug, Error)]
pub enum FileProblem {
    /// Its format is not known or cannot be used so.
    #[error("{0}")]
    Format(#[from] FormatError),
    /// Its content cannot be used.
    #[error("{0}")]
    Content(#[from] ReadError),
    /// The curves cannot be written to it.
    #[error("{0}")]
    Export(#[from] WriteError),
    /// The system refused.
    #[error("cannot {action} the file: {error}")]
    System {
        /// The action that failed.
        action: &'static str,
        /// The error of the system.
        error: io::Error,
    },
    /// The system refused to create a folder.
    #[error("cannot create the folder: {0}")]
    Folder(io::Error),
    /// The folder that it would be in is not there.
    #[error("the folder {} does not exist: create it first", shown_path(.0))]
    NoFolder(PathBuf),
    /// It is a folder.
    #[error("this is a folder, not a file")]
    IsFolder,
    /// It is a device.
    #[error("this is a device, not a file")]
    IsDevice,
    /// It is protected against writing.
    #[error("the file is read-only: save under another name, or allow writing to it")]
    ReadOnly,
    /// It is larger than this many bytes.
    #[error("the file is larger than {} MiB, the most that Batten reads", .0 >> 20)]
    TooLarge(u64),
}

impl FileProblem {
    /// Name the action that the system refused.
    pub(super) fn system(action: &'static str) -> impl Fn(io::Error) -> Self {
        move |error| Self::System { action, error }
    }
}
