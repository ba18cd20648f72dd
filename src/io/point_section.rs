//! The lines of a table that hold points, and what most of them have in their columns.

use std::collections::HashMap;

use super::decimals::{is_number, measured};
use super::table_columns::ColumnNames;
use super::table_lines::{COMMENT_MARKS, Fields, LineContent, Lines, TableLine};

/// Lines of a table that hold points: those below one line with column names, if there is one.
#[derive(Debug, Default)]
pub(super) struct PointSection<'a> {
    /// The number of the first line.
    pub(super) line: usize,
    /// Whether a line with # announces the points.
    pub(super) is_announced: bool,
    /// The name that the line with # gives.
    pub(super) name: Option<String>,
    /// The lines.
    pub(super) lines: Lines<'a>,
    /// Whether a line that could be a row is among them.
    pub(super) has_rows: bool,
}

/// The shape of most rows of a section.
pub(super) struct Usual {
    /// How many fields they have.
    pub(super) count: usize,
    /// How many rows there are.
    pub(super) rows: usize,
    /// The line of the first.
    pub(super) first: usize,
    /// Its number of fields with the empty ones at the end.
    pub(super) width: usize,
}

/// What the rows have in one column.
#[derive(Clone, Default)]
pub(super) struct Content {
    /// How many are numbers.
    pub(super) numbers: usize,
    /// The last number, as long as each is the one before and 1.
    pub(super) counter: Option<u64>,
    /// The unit behind all numbers.
    pub(super) unit: Option<String>,
}

impl<'a> PointSection<'a> {
    /// Look at a line of it.
    pub(super) fn note(&mut self, fields: &Fields) {
        self.has_rows = self.has_rows || fields.have_numbers(2);
    }

    /// Split the lines; of comments those with the names of columns. Blank lines have no fields.
    pub(super) fn split(&self) -> impl Iterator<Item = (TableLine<'a>, Option<Fields<'a>>)> {
        let separator = self.lines.separator();
        self.lines.split().filter_map(move |mut line| {
            let content = std::mem::replace(&mut line.content, LineContent::Blank);
            match content {
                LineContent::Fields(fields) => Some((line, Some(fields))),
                LineContent::Blank => Some((line, None)),
                LineContent::Comment => {
                    let names = commented_names(line.text, separator)?;
                    Some((line, Some(names)))
                }
                LineContent::Header(_) => None,
            }
        })
    }

    /// The fields of all lines that have any, with the numbers of the lines.
    pub(super) fn fields(&self) -> impl Iterator<Item = (usize, Fields<'a>)> {
        let lines = self.split();
        lines.filter_map(|(line, fields)| Some((line.number, fields?)))
    }

    /// The lines that could be rows.
    fn rows(&self) -> impl Iterator<Item = (usize, Fields<'a>)> {
        self.fields().filter(|(_, fields)| fields.have_numbers(2))
    }

    /// Find the most frequent number of fields; of several the one that comes first. `None` if no line can be a row.
    pub(super) fn usual(&self) -> Option<Usual> {
        let mut found: HashMap<usize, (usize, Usual)> = HashMap::new();
        for (place, (line, fields)) in self.rows().enumerate() {
            let count = fields.values.len();
            let begin = || {
                let usual = Usual {
                    count,
                    rows: 0,
                    first: line,
                    width: fields.width,
                };
                (place, usual)
            };
            found.entry(count).or_insert_with(begin).1.rows += 1;
        }
        let found = found.into_values();
        let most = found.max_by_key(|(place, usual)| (usual.rows, usize::MAX - place));
        most.map(|(_, usual)| usual)
    }

    /// Collect what most rows have in each column.
    pub(super) fn contents(&self, count: usize) -> Vec<Content> {
        let mut contents = vec![Content::default(); count];
        let rows = self.rows().map(|(_, fields)| fields.values);
        let rows = rows.filter(|values| values.len() == count);
        for (index, values) in rows.enumerate() {
            for (content, text) in contents.iter_mut().zip(&values) {
                content.take(text, index == 0);
            }
        }
        contents
    }
}

impl Content {
    /// Whether there are numbers, with a unit behind them or without.
    pub(super) fn has_numbers(&self) -> bool {
        self.numbers > 0 || self.unit.is_some()
    }

    /// Take the field of the next row.
    fn take(&mut self, text: &str, is_first: bool) {
        self.numbers += usize::from(is_number(text));
        if is_first || self.counter.is_some() {
            let next = self.counter.map(|it| it.saturating_add(1));
            let number = text.parse().ok();
            self.counter = number.filter(|number| is_first || Some(*number) == next);
        }
        if is_first || self.unit.is_some() {
            let unit = measured(text).map(|(_, unit)| unit);
            self.unit = unit
                .filter(|unit| is_first || self.unit.as_deref() == Some(unit))
                .map(str::to_owned);
        }
    }
}

/// What is known of the last text above rows. Where it touches other rows above, it may belong to these.
#[derive(Default)]
pub(super) struct TextAbove {
    touches_rows: bool,
    /// Whether a blank line is below it.
    is_divided: bool,
}

impl TextAbove {
    /// Take a text as the title, which may touch rows above.
    pub(super) fn begin(&mut self, touches_rows: bool) {
        *self = Self {
            touches_rows,
            is_divided: false,
        };
    }

    /// Go on behind a blank line.
    pub(super) fn divide(&mut self) {
        self.is_divided = true;
    }

    /// Tell whether the next text is the title in its place, and take that.
    pub(super) fn gives_way(&mut self) -> bool {
        let gives_way = self.touches_rows;
        if gives_way {
            self.begin(!self.is_divided);
        }
        gives_way
    }
}

/// Take a comment such as `# x y` for the names of columns.
pub(super) fn commented_names(line: &str, separator: char) -> Option<Fields<'_>> {
    let is_mark = |it: char| ['"', ' ', '\t', '/'].contains(&it) || COMMENT_MARKS.contains(&it);
    let names = line.trim_start_matches(is_mark);
    let fields = [separator, ' '].map(|separator| Fields::of(names, separator));
    let are_names = |fields: &Fields| ColumnNames::of(fields).coordinates().is_some();
    fields.into_iter().find(are_names)
}
