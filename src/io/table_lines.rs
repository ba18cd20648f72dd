//! The lines of a table, split into fields.

use std::borrow::Cow;

use super::decimals::{is_number, measured};
use super::table_column::MOST_COLUMNS;
use super::table_header::begins_table;

/// What may stand between fields, in the order of preference; a space stands for any run of blanks.
const SEPARATORS: [char; 4] = [';', '\t', ',', ' '];

/// What comments begin with, beside `//`; `#` begins the line above a curve's table too.
pub(super) const COMMENT_MARKS: [char; 3] = ['#', '%', '!'];

/// What stands where a number is missing, beside nothing.
const MISSING: [&str; 8] = ["nan", "-nan", "inf", "-inf", "na", "n/a", "#n/a", "null"];

/// How many rows of numbers decide on the separator. More would read large files twice.
const DECIDING: usize = 256;

/// Lines of a file that follow each other. They are split into fields each time: those of millions would take too much
/// memory.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lines<'a> {
    /// The text of the file.
    text: &'a str,
    /// The place of the first line in it, and that behind the last, in bytes.
    range: [usize; 2],
    /// The number of the first line, counted from 1.
    first: usize,
    separator: char,
}

/// A line of a table.
#[derive(Clone, Debug)]
pub(super) struct TableLine<'a> {
    /// The number of the line, counted from 1.
    pub(super) number: usize,
    /// Where it begins in the text of the file, in bytes.
    at: usize,
    /// The line as it stands in the file.
    pub(super) text: &'a str,
    /// The content.
    pub(super) content: LineContent<'a>,
}

impl<'a> TableLine<'a> {
    /// The place of the line alone.
    pub(super) fn without_content(&self) -> Self {
        Self {
            content: LineContent::Blank,
            ..*self
        }
    }
}

/// The content of a line.
#[derive(Clone, Debug)]
pub(super) enum LineContent<'a> {
    /// Nothing but separators.
    Blank,
    /// A line that begins with a mark of comments but no table.
    Comment,
    /// The line above a table, without the quotation marks of a spreadsheet.
    Header(Cow<'a, str>),
    /// Values, or other text.
    Fields(Fields<'a>),
}

/// The fields of a line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fields<'a> {
    /// The fields without blanks around them, up to the last that is not empty.
    pub(super) values: Vec<Cow<'a, str>>,
    /// Their number with the empty ones at the end.
    pub(super) width: usize,
}

impl<'a> Fields<'a> {
    /// Split a line at a separator; of too many fields the first. A quoted field may hold the separator.
    pub(super) fn of(line: &'a str, separator: char) -> Self {
        const MOST: usize = MOST_COLUMNS + 1;
        let mut values: Vec<Cow<str>> = match separator {
            // In lists such as X=1.5 Y=2.5 a name may touch its number.
            ' ' => words(line).map(Cow::Borrowed).take(MOST).collect(),
            _ if line.contains('"') => unquoted(line, separator).take(MOST).collect(),
            _ => line.split(separator).map(trimmed).take(MOST).collect(),
        };
        let width = values.len();
        let filled = values.iter().rposition(|value| !value.is_empty());
        values.truncate(filled.map_or(0, |last| last + 1));
        Self { values, width }
    }

    /// Whether there are more than tables have.
    pub(super) fn are_too_many(&self) -> bool {
        self.width > MOST_COLUMNS
    }

    /// Whether at least so many of them are numbers, with a unit behind them or without.
    pub(super) fn have_numbers(&self, least: usize) -> bool {
        let are_numbers = |text: &&Cow<str>| is_number(text) || measured(text).is_some();
        self.values.iter().filter(are_numbers).take(least).count() == least
    }

    /// Whether they are a row in which a number is missing, such as `0.5, NaN`.
    pub(super) fn lack_a_number(&self) -> bool {
        let is_missing = |value: &Cow<str>| MISSING.contains(&value.to_lowercase().as_str());
        let (missing, others): (Vec<_>, Vec<_>) = self.values.iter().partition(|it| is_missing(it));
        self.values.len() >= 2 && !missing.is_empty() && others.into_iter().all(|it| is_number(it))
    }

    /// Whether they can be a row of numbers: at least two, and no field that is two numbers.
    fn are_split(&self) -> bool {
        let is_unsplit = |value: &Cow<str>| {
            let words = value.split(|mark: char| mark.is_whitespace() || mark == ';');
            let mut words = words.filter(|word| !word.is_empty());
            words.clone().count() > 1 && words.all(is_number) && !is_number(value)
        };
        self.have_numbers(2) && !self.values.iter().any(is_unsplit)
    }
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    let parts = |word| match str::split_once(word, '=') {
        Some((name, number)) if matches!(name, "x" | "y" | "z" | "X" | "Y" | "Z") => [name, number],
        _ => [word, ""],
    };
    let words = line.split_whitespace().flat_map(parts);
    words.filter(|word| !word.is_empty())
}

fn trimmed(field: &str) -> Cow<'_, str> {
    Cow::Borrowed(field.trim())
}

/// Split a line that has quotation marks. Each line is read on its own: a mark in a title closes with it.
fn unquoted(line: &str, separator: char) -> impl Iterator<Item = Cow<'_, str>> {
    let mut rest = Some(line);
    std::iter::from_fn(move || {
        let (field, behind) = first_field(rest?, separator);
        rest = behind;
        Some(field)
    })
}

/// The first field of a line, without its quotation marks, and what stands behind its separator. Within marks a
/// doubled one stands for itself.
fn first_field(line: &str, separator: char) -> (Cow<'_, str>, Option<&str>) {
    let divided = |text| match str::split_once(text, separator) {
        Some((field, behind)) => (field, Some(behind)),
        None => (text, None),
    };
    let Some(mut inside) = line.trim_start_matches(' ').strip_prefix('"') else {
        let (field, behind) = divided(line);
        return (trimmed(field), behind);
    };
    let mut field = Cow::Borrowed("");
    while let Some((text, behind)) = inside.split_once('"') {
        field += text;
        let Some(rest) = behind.strip_prefix('"') else {
            let (tail, behind) = divided(behind);
            field += tail.trim_end();
            return (own_trimmed(field), behind);
        };
        field += "\"";
        inside = rest;
    }
    field += inside;
    (own_trimmed(field), None)
}

fn own_trimmed(field: Cow<'_, str>) -> Cow<'_, str> {
    match field {
        Cow::Borrowed(text) => trimmed(text),
        Cow::Owned(text) => Cow::Owned(text.trim().to_owned()),
    }
}

/// The inside of a point in brackets, such as `(1.0, 2.0)`, `[1.0, 2.0],` or `Point(3) = {1, 2, 0};`; any other line as
/// it is.
fn unbracketed(line: &str) -> &str {
    let (opening, closing) = (['(', '[', '{'], [')', ']', '}']);
    let point = line.trim().trim_end_matches([',', ';', ' ', '\t']);
    let inside = point.strip_suffix(closing).and_then(|it| {
        let (before, _) = it
            .char_indices()
            .rfind(|(_, mark)| opening.contains(mark))?;
        it.split_at_checked(before)
    });
    let Some((name, inside)) = inside else {
        return line;
    };
    let name = name.trim_matches(opening).trim();
    let is_word = name.chars().all(char::is_alphanumeric) && !is_number(name);
    if !is_word && !name.ends_with(['=', ':']) {
        return line;
    }
    let inside = inside.trim_matches(|mark| opening.contains(&mark) || closing.contains(&mark));
    let words = inside.split([',', ';', ' ', '\t']);
    let mut words = words.filter(|word| !word.is_empty());
    match words.clone().count() >= 2 && words.all(is_number) {
        true => inside,
        false => line,
    }
}

/// What a line says in the files of Tecplot: the names of the columns, or that a zone begins.
fn of_tecplot(line: &str) -> Option<LineContent<'_>> {
    let behind = |word: &str| {
        let (first, rest) = line.trim_start().split_at_checked(word.len())?;
        first.eq_ignore_ascii_case(word).then_some(rest.trim())
    };
    if let Some(rest) = behind("zone") {
        return (rest.is_empty() || rest.contains('=')).then_some(LineContent::Blank);
    }
    let names = behind("variables")?.strip_prefix('=')?;
    let values: Vec<Cow<str>> = match names.contains('"') {
        true => names.split('"').skip(1).step_by(2).map(trimmed).collect(),
        false => {
            let words = names.split([',', ' ', '\t']);
            words.filter(|word| !word.is_empty()).map(trimmed).collect()
        }
    };
    let width = values.len();
    Some(LineContent::Fields(Fields { values, width }))
}

/// Find what stands between the fields: the separator that splits most rows into numbers. Where there
/// are none, the first line of text tells it.
pub(super) fn separator(text: &str) -> char {
    let lines = || text.lines().filter(|line| !is_commented(line));
    let mut counts = [0; SEPARATORS.len()];
    let has_digits = |line: &&str| line.bytes().any(|byte| byte.is_ascii_digit());
    for line in lines().filter(has_digits).map(unbracketed) {
        for (count, separator) in counts.iter_mut().zip(SEPARATORS) {
            *count += usize::from(Fields::of(line, separator).are_split());
        }
        if counts.contains(&DECIDING) {
            break;
        }
    }
    let most = counts.into_iter().max().filter(|most| *most > 0);
    let mut rated = counts.into_iter().zip(SEPARATORS);
    let told = rated.find(|(count, _)| Some(*count) == most);
    let is_filled = |line: &&str| !line.trim_matches([',', ';', '\t', ' ', '"']).is_empty();
    let names = lines().find(is_filled).unwrap_or_default();
    let named = || SEPARATORS.into_iter().find(|it| names.contains(*it));
    told.map(|(_, separator)| separator)
        .or_else(named)
        .unwrap_or(',')
}

impl<'a> Lines<'a> {
    /// All lines of a file.
    pub(super) fn all(text: &'a str, separator: char) -> Self {
        Self {
            text,
            range: [0, text.len()],
            first: 1,
            separator,
        }
    }

    /// These from a line of them on.
    pub(super) fn from(mut self, line: &TableLine) -> Self {
        self.range[0] = line.at;
        self.first = line.number;
        self
    }

    /// These behind a line of them.
    pub(super) fn after(mut self, line: &TableLine) -> Self {
        self.range[0] = self.range[1].min(line.at + line.text.len() + 1);
        self.first = line.number + 1;
        self
    }

    /// These before a line of them.
    pub(super) fn before(mut self, line: &TableLine) -> Self {
        self.range[1] = line.at;
        self
    }

    /// What stands between their fields.
    pub(super) fn separator(&self) -> char {
        self.separator
    }

    /// Split them into fields, one after the other.
    pub(super) fn split(self) -> impl Iterator<Item = TableLine<'a>> {
        let [mut end, last] = self.range;
        let text = self.text.get(end..last).unwrap_or_default();
        let lines = (self.first..).zip(text.split_inclusive('\n'));
        lines.map(move |(number, line)| {
            let at = end;
            end += line.len();
            let text = line.strip_suffix('\n').unwrap_or(line);
            TableLine {
                number,
                at,
                text,
                content: content(text, self.separator),
            }
        })
    }
}

fn content(line: &str, separator: char) -> LineContent<'_> {
    if is_commented(line) {
        return match line.contains('#') && begins_table(line) {
            false => LineContent::Comment,
            true => LineContent::Header(header(line, separator)),
        };
    }
    if let Some(content) = of_tecplot(line) {
        return content;
    }
    let line = unbracketed(line);
    let fields = Fields::of(line, separator);
    // Files that were put together may have other rows with blanks alone.
    let is_unsplit = separator != ' ' && fields.width == 1 && !line.contains('"');
    let by_blanks = is_unsplit.then(|| Fields::of(line, ' '));
    let are_numbers = |it: &Fields| it.values.len() > 1 && it.values.iter().all(|it| is_number(it));
    let fields = by_blanks.filter(are_numbers).unwrap_or(fields);
    match fields.values.is_empty() {
        true => LineContent::Blank,
        false => LineContent::Fields(fields),
    }
}

/// Whether a line begins with a mark of comments, in quotation marks or not, or tells a spreadsheet the
/// separator, as `sep=;` does.
fn is_commented(line: &str) -> bool {
    let begun = line.trim_start_matches(['"', ' ', '\t']);
    let tells_separator = || {
        let told = begun.strip_prefix("sep=").or(begun.strip_prefix("SEP="));
        told.is_some_and(|told| told.trim_end_matches(['"', ' ']).chars().count() == 1)
    };
    begun.starts_with(COMMENT_MARKS) || begun.starts_with("//") || tells_separator()
}

/// The text of a header: a spreadsheet may have quoted it, or padded it with separators.
fn header(line: &str, separator: char) -> Cow<'_, str> {
    let line = line.trim();
    match line.starts_with('"') {
        false => Cow::Borrowed(line),
        true => {
            let fields: Vec<Cow<str>> = unquoted(line, separator).collect();
            let joined = fields.join(separator.encode_utf8(&mut [0; 4]));
            Cow::Owned(joined.trim().to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_separator_is_the_one_that_splits_rows_into_numbers() {
        for (text, expected) in [
            ("title, with a comma\n1.0 0.5\n0.5 0.25\n", ' '),
            ("1,5 2,5\n3,5 4,5\n", ' '),
            ("1, 2\n3, 4\n", ','),
            ("0;1,5\n1;2,5\n", ';'),
            ("0\t1,5\n1\t2,5\n", '\t'),
            ("0.1\t0.2\n0.3 0.4\n0.5 0.6\n", ' '),
            ("P1 0.5 0.25 left\n", ' '),
            ("x;y\n", ';'),
            ("# a b\nx,y\n", ','),
            ("x\n", ','),
            ("sep=;\nx,y\n", ','),
            ("(1, 2)\n(3, 4)\n", ','),
            ("[1,5; 2,5],\n[3; 4]\n", ';'),
            ("(a) 1 2\n(b) 3 4\n", ' '),
            ("1,25  2,5\n3,5   4,5\n", ' '),
            ("1.5 mm, 2 mm\n2.5 mm, 3 mm\n", ','),
        ] {
            assert_eq!(separator(text), expected, "{text:?}");
        }
    }

    #[test]
    fn a_row_may_lack_a_number() {
        let lacks = |line| Fields::of(line, ',').lack_a_number();
        for line in ["nan,nan", "0.5,NaN", "n/a,1", "NULL,-inf,3"] {
            assert!(lacks(line), "{line}");
        }
        for line in ["1,2", "nan", "x,y", "NACA,12", "nan,x", ""] {
            assert!(!lacks(line), "{line}");
        }
    }

    #[test]
    fn a_quotation_mark_ends_with_its_line() {
        let fields = |line| Fields::of(line, ',').values;
        assert_eq!(fields("say \"so, 1\n"), ["say \"so", "1"]);
        assert_eq!(fields("\"1,5\", 2,,"), ["1,5", "2"]);
        assert_eq!(fields("\"open, 1"), ["open, 1"]);
        assert_eq!(fields("1, \"2\" ,\"3\"\r"), ["1", "2", "3"]);
        assert_eq!(
            fields("\"a \"\"b\"\", c\", \" 2 \"m"),
            ["a \"b\", c", "2 m"]
        );
        assert_eq!(fields("\"\",\"1\""), ["", "1"]);
        assert_eq!(fields(" ,,"), [] as [&str; 0]);
    }
}
