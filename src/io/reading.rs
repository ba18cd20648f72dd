//! The content of a file, and the remarks on it.

use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

use super::airfoil_order::AirfoilOrder;
use super::file_match::FileMatch;
use super::table_column::TableColumn;
use crate::document::{
    Curve, CurveId, Document, EditError, EndMatch, Extras, GuideLine, Reference, quoted,
};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{PolygonKind, counted, rounded_up};

/// The most unknown keys that are named one by one.
const MOST_NAMED: usize = 8;

/// The content of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// The curves, as a document holds them: of hundreds of thousands none is moved.
    pub curves: Vec<Arc<Curve>>,
    /// The references, likewise.
    pub references: Vec<Arc<Reference>>,
    /// The matches between them. They name only curves and references of this reading.
    pub matches: Vec<FileMatch>,
    /// The unit of length, if the file says one.
    pub unit: Option<LengthUnit>,
    /// The numbers of the curves, then of the references, if a project says them.
    pub numbers: Vec<u64>,
    /// The guide lines of a project.
    pub guide_lines: Vec<GuideLine>,
    /// The unknown keys of a project.
    pub extras: Extras,
    /// The remarks for the user.
    pub remarks: Remarks,
}

/// List remarks on a file that was read. Shown as one line a remark.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remarks(Vec<Remark>);

/// A remark on a file: no error, but good to know.
#[derive(Clone, Debug, PartialEq)]
pub enum Remark {
    /// A key that this program does not know: it has no effect.
    UnknownKey {
        /// The key.
        key: String,
        /// Whose key it is.
        owner: Owner,
    },
    /// How the columns and decimals of a table are told apart, where it is not by commas and
    /// points.
    Notation {
        /// The separator of columns: a comma, a semicolon or a tab.
        separator: char,
        /// Whether decimals follow a comma.
        decimal_commas: bool,
    },
    /// Lines of a table that begin with # but no curve.
    Comments {
        /// The first of them, counted from 1.
        first: usize,
        /// Their number.
        count: usize,
    },
    /// The text of a table is not UTF-8, and read as Latin-1.
    Latin1,
    /// Lines of a table of points that hold none.
    Skipped(Vec<usize>),
    /// A line of a table that begins as a row, and is taken for the title of the rows below it.
    Title {
        /// The line.
        line: usize,
        /// The title.
        title: String,
    },
    /// Lines of a table of points that repeat the point before.
    Repeated(Vec<usize>),
    /// Numbers of a table that are too small for a double, the first of them and all lines.
    Vanished {
        /// The first number.
        text: String,
        /// The lines.
        lines: Vec<usize>,
    },
    /// Points of a table with a number that is too large for a double, the first of them and all lines.
    TooLarge {
        /// The first number.
        text: String,
        /// The lines.
        lines: Vec<usize>,
    },
    /// Columns of a table with names of their own that are taken for x and y.
    Columns(Vec<TableColumn>),
    /// A unit that stands behind the numbers of a table.
    Measured(String),
    /// A word in the place of a unit in the name of a column.
    UnknownUnit(String),
    /// Points that are an airfoil in one of two orders.
    Airfoil {
        /// The name of the points.
        name: String,
        /// The order in the file.
        order: AirfoilOrder,
    },
    /// The line of an airfoil file with counts of points that are not those of its sides.
    Counts {
        /// The line.
        line: usize,
    },
    /// Two blocks that may be the sides of an airfoil in Lednicer order.
    MaybeSides {
        /// The numbers of their points.
        counts: [usize; 2],
    },
    /// Positions on the earth that are read in metres about a place in degrees.
    TangentPlane {
        /// The latitude, north.
        latitude: f64,
        /// The longitude, east.
        longitude: f64,
    },
    /// What the reader of a drawing tells.
    Drawn(String),
    /// A curve that is not symmetric as its file says.
    Asymmetric {
        /// The curve, counted from 1, with its name.
        curve: (usize, String),
    },
    /// A curve whose float polygon gives it back only nearly.
    CurveOff {
        /// The curve, counted from 1, with its name.
        curve: (usize, String),
        /// The polygon that it was given by.
        kind: PolygonKind,
        /// A bound of how far it is off.
        by: f64,
    },
}

/// Who has a key.
#[derive(Clone, Debug, PartialEq)]
pub enum Owner {
    /// The project.
    Project,
    /// Curves; kept with them.
    Curves {
        /// The first of them, counted from 1, with its name.
        first: (usize, String),
        /// Their number.
        count: usize,
    },
    /// The targets of a curve, which keep nothing unknown.
    Targets {
        /// The curve, counted from 1, with its name.
        curve: (usize, String),
    },
    /// The symmetry of a curve, which keeps nothing unknown.
    Symmetry {
        /// The curve, counted from 1, with its name.
        curve: (usize, String),
    },
    /// A reference; kept with it.
    Reference {
        /// The reference, counted from 1, with its name.
        reference: (usize, String),
    },
    /// Matches between curves, which keep nothing unknown.
    Matches,
}

impl Reading {
    /// Make a document of the content.
    ///
    /// # Errors
    /// [`EditError`] if a match cannot be; never for a reading of a format.
    pub fn into_document(self) -> Result<Document, EditError> {
        let document = Document::from_curves(self.curves)
            .with_references(self.references)
            .with_numbers(&self.numbers)
            .with_unit(self.unit)
            .with_guide_lines(self.guide_lines)
            .with_extras(self.extras);
        let curves: Vec<CurveId> = document.ids().collect();
        let references: Vec<CurveId> = document.references().map(|(id, _)| id).collect();
        let matches = self.matches.iter();
        let matches = matches.map(|matched| matched.between(&curves, &references));
        let matches: Vec<EndMatch> = matches.collect::<Result<_, _>>()?;
        document.with_matches(matches)
    }

    /// Name lists of points that say no name after their file: a document may hold those of several.
    pub fn name_lists(&mut self, file: &str) {
        let is_alone = self.references.len() == 1;
        for (number, reference) in (1..).zip(&mut self.references) {
            if reference.points().is_some() && reference.name == nameless(number) {
                Arc::make_mut(reference).name = match is_alone {
                    true => file.to_owned(),
                    false => format!("{file} {number}"),
                };
            }
        }
    }

    /// Whether there is neither a curve nor a reference.
    pub fn is_empty(&self) -> bool {
        self.curves.is_empty() && self.references.is_empty()
    }

    /// Count the curves, and the references if there are any, in words.
    pub fn counted(&self) -> String {
        counted_items(self.curves.len(), self.references.len())
    }
}

/// What a list of points is called that says no name, by its number from 1.
pub(super) fn nameless(number: usize) -> String {
    format!("points {number}")
}

/// Count curves, and references if there are any, in words.
pub fn counted_items(curves: usize, references: usize) -> String {
    let curves_told = counted(curves, "curve", "curves");
    let references_told = counted(references, "reference", "references");
    match (curves, references) {
        (_, 0) => curves_told,
        (0, _) => references_told,
        _ => format!("{curves_told} and {references_told}"),
    }
}

/// Count the curves, the references and the pictures of documents, in words.
pub fn counted_content<'a>(documents: impl IntoIterator<Item = &'a Document>) -> String {
    let (mut curves, mut references, mut pictures) = (0, 0, 0);
    for document in documents {
        curves += document.curves().len();
        for (_, reference) in document.references() {
            match reference.picture {
                Some(_) => pictures += 1,
                None => references += 1,
            }
        }
    }
    let others = counted_items(curves, references);
    let pictures_told = counted(pictures, "picture", "pictures");
    match (curves + references, pictures) {
        (_, 0) => others,
        (0, _) => pictures_told,
        _ => format!("{others} and {pictures_told}"),
    }
}

impl Remarks {
    /// Add a remark.
    pub fn add(&mut self, remark: Remark) {
        self.0.push(remark);
    }

    /// Whether there is nothing to say.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Add the remarks of another part of the file.
    pub(super) fn extend(&mut self, others: Self) {
        self.0.extend(others.0);
    }

    /// Whether a remark is among them.
    pub(super) fn contains(&self, remark: &Remark) -> bool {
        self.0.contains(remark)
    }

    fn iter(&self) -> impl Iterator<Item = &Remark> {
        self.0.iter()
    }
}

/// The unknown keys of curves: one remark for all curves that have the same.
#[derive(Default)]
pub(super) struct CurveKeys {
    keys: Vec<CurveKey>,
    /// Where in the list a key is.
    places: HashMap<String, usize>,
}

struct CurveKey {
    key: String,
    first: (usize, String),
    /// The number of the last curve that has it: a curve may have it twice.
    last: usize,
    count: usize,
}

impl CurveKeys {
    /// Add a key of a curve, which is given by its number, counted from 1, and its name. Curves
    /// come in the order of their numbers.
    pub(super) fn add(&mut self, key: &str, number: usize, name: &str) {
        let known = self.places.get(key);
        if let Some(known) = known.and_then(|place| self.keys.get_mut(*place)) {
            known.count += usize::from(known.last != number);
            known.last = number;
            return;
        }
        self.places.insert(key.to_owned(), self.keys.len());
        self.keys.push(CurveKey {
            key: key.to_owned(),
            first: (number, name.to_owned()),
            last: number,
            count: 1,
        });
    }

    /// Add a remark for each key.
    pub(super) fn remark(self, remarks: &mut Remarks) {
        for CurveKey {
            key, first, count, ..
        } in self.keys
        {
            let owner = Owner::Curves { first, count };
            remarks.add(Remark::UnknownKey { key, owner });
        }
    }
}

impl fmt::Display for Remarks {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_key = |remark: &&Remark| matches!(remark, Remark::UnknownKey { .. });
        let others = self.iter().filter(|remark| !is_key(remark));
        let keys = self.iter().filter(is_key).take(MOST_NAMED);
        let mut lines: Vec<String> = others.chain(keys).map(ToString::to_string).collect();
        let unnamed = self.iter().filter(is_key).skip(MOST_NAMED).count();
        if unnamed > 0 {
            let keys = counted(unnamed, "other key is", "other keys are");
            lines.push(format!("{keys} not known either"));
        }
        formatter.write_str(&lines.join("\n"))
    }
}

/// Name lines with a verb: "line 3 was", "lines 3, 7 to 9 and 12 others were".
fn lines_told(lines: &[usize], one: &str, many: &str) -> String {
    let mut sorted = lines.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let count = sorted.len();
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for line in sorted {
        match runs.last_mut() {
            Some([_, last]) if *last + 1 == line => *last = line,
            _ => runs.push([line, line]),
        }
    }
    let length = |[first, last]: &[usize; 2]| last - first + 1;
    let named = &runs[..runs.len().min(MOST_NAMED)];
    let texts = named.iter().map(|run| match (run, length(run)) {
        ([first, _], 1) => first.to_string(),
        ([first, last], _) => format!("{first} to {last}"),
    });
    let mut texts: Vec<String> = texts.collect();
    let others = count - named.iter().map(length).sum::<usize>();
    if others > 0 {
        texts.push(counted(others, "other", "others"));
    }
    let last = texts.pop().unwrap_or_default();
    let listed = match texts.is_empty() {
        true => last,
        false => format!("{} and {last}", texts.join(", ")),
    };
    match count {
        1 => format!("line {listed} {one}"),
        _ => format!("lines {listed} {many}"),
    }
}

impl Remark {
    /// Name an unknown key.
    pub(super) fn unknown_key(key: &str, owner: Owner) -> Self {
        let key = key.to_owned();
        Self::UnknownKey { key, owner }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let curve = |(number, name): &(usize, String)| format!("curve {number} {}", quoted(name));
        match self {
            Self::UnknownKey { key, owner } => {
                let key = quoted(key);
                match owner {
                    Owner::Project => write!(
                        formatter,
                        "the project's key {key} is not known and has no effect"
                    ),
                    Owner::Curves { first, count: 1 } => write!(
                        formatter,
                        "{}: the key {key} is not known and has no effect",
                        curve(first)
                    ),
                    Owner::Curves { first, count } => write!(
                        formatter,
                        "the key {key} of {count} curves is not known and has no effect; the first is {}",
                        curve(first)
                    ),
                    Owner::Reference {
                        reference: (number, name),
                    } => write!(
                        formatter,
                        "reference {number} {}: the key {key} is not known and has no effect",
                        quoted(name)
                    ),
                    Owner::Matches => write!(
                        formatter,
                        "the key {key} of the matches is not known, has no effect and is not kept"
                    ),
                    Owner::Symmetry { curve: owner } => write!(
                        formatter,
                        "{}: the key {key} of its symmetry is not known, has no effect and is not kept",
                        curve(owner)
                    ),
                    Owner::Targets { curve: owner } => write!(
                        formatter,
                        "{}: the key {key} of its targets is not known, has no effect and is not kept",
                        curve(owner)
                    ),
                }
            }
            Self::Notation {
                separator,
                decimal_commas,
            } => {
                let columns = match separator {
                    ';' => Some("semicolons between columns"),
                    '\t' => Some("tabs between columns"),
                    _ => None,
                };
                let decimals = decimal_commas.then_some("decimal commas");
                let parts: Vec<&str> = columns.into_iter().chain(decimals).collect();
                write!(formatter, "read with {}", parts.join(" and "))
            }
            Self::CurveOff {
                curve: owner,
                kind,
                by,
            } => write!(
                formatter,
                "{}: read from its {kind} polygon, the curve may be off by up to {}",
                curve(owner),
                rounded_up(*by)
            ),
            Self::Asymmetric { curve: owner } => write!(
                formatter,
                "{}: it is not symmetric as the file says, and does not stay so",
                curve(owner)
            ),
            Self::Drawn(told) => formatter.write_str(told),
            Self::Latin1 => write!(formatter, "the text is not UTF-8 and was read as Latin-1"),
            Self::Skipped(lines) => write!(
                formatter,
                "{} skipped (no point)",
                lines_told(lines, "was", "were")
            ),
            Self::Title { line, title } => write!(
                formatter,
                "line {line} is taken for the title {}, though it begins with numbers",
                quoted(title)
            ),
            Self::Repeated(lines) => write!(
                formatter,
                "{} left out (the same point as before)",
                lines_told(lines, "was", "were")
            ),
            Self::Vanished { text, lines } => write!(
                formatter,
                "{} read as 0 in part (the number {} is too small)",
                lines_told(lines, "was", "were"),
                quoted(text)
            ),
            Self::TooLarge { text, lines } => write!(
                formatter,
                "{} left out (the number {} is too large)",
                lines_told(lines, "was", "were"),
                quoted(text)
            ),
            Self::Columns(columns) => {
                let columns: Vec<String> = columns.iter().map(ToString::to_string).collect();
                write!(
                    formatter,
                    "x and y are the columns {}",
                    columns.join(" and ")
                )
            }
            Self::Measured(unit) => write!(
                formatter,
                "numbers are read with the unit {} behind them",
                quoted(unit)
            ),
            Self::UnknownUnit(unit) => write!(
                formatter,
                "the unit {} is not known: mm, cm, m and in are",
                quoted(unit)
            ),
            Self::Airfoil { name, order } => {
                write!(formatter, "{}: an airfoil in {order} order", quoted(name))?;
                match order {
                    AirfoilOrder::Uncounted => formatter
                        .write_str(" without its line of counts: both sides make one section"),
                    AirfoilOrder::Selig | AirfoilOrder::Lednicer => Ok(()),
                }
            }
            Self::Counts { line } => write!(
                formatter,
                "line {line}: the counts are not those of the two sides, which the blank line divides"
            ),
            Self::MaybeSides {
                counts: [first, second],
            } => write!(
                formatter,
                "the two blocks may be the sides of an airfoil: a line “{first}. {second}.” above the points makes one section of them"
            ),
            Self::TangentPlane {
                latitude,
                longitude,
            } => write!(
                formatter,
                "in metres, x east and y north of latitude {latitude:.6}°, longitude {longitude:.6}°; without elevations"
            ),
            Self::Comments { first, count: 1 } => {
                write!(formatter, "line {first} is taken as a comment")
            }
            Self::Comments { first, count } => write!(
                formatter,
                "{count} lines are taken as comments, the first is line {first}"
            ),
        }
    }
}
