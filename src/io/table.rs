//! Polygon tables as comma-separated values: one block a curve, or a list of points.
//!
//! ```text
//! # degree=3 polygon=float periodic=false name=arc
//! x,y
//! -10.0,0.0
//! -5.0,8.660254037844386
//! …
//! ```
//!
//! Space curves have the columns `x,y,z`, rational ones `x,y,z,weight`. Columns are read by
//! their names in any order, so that `x,y,weight` is read too. Numbers are written with the
//! digits that it takes to read the very same number again.
//!
//! A line `# unit=mm` above all tables says the unit of length: mm, cm, m or in. Without it there is none.
//!
//! A table without `degree=` holds points, which make a reference: the line above its column names
//! may give it a name, as in `# name=scan`, or be left out, as may the names of the columns.
//!
//! Tables of other programs are read too: the rows tell whether commas, semicolons, tabs or blanks stand
//! between the columns, and whether decimals follow a point or a comma. Other lines that begin with `#` are
//! comments. The vertices of a curve are read strictly; points as far as there are any
//! ([`table_points`](super::table_points)).

use std::borrow::Cow;
use std::sync::Arc;

use csv::WriterBuilder;
use glam::DVec3;

use super::decimals::Decimals;
use super::error::{Place, Problem, ReadError, WriteError};
use super::format::{ExportRow, FileUnit, Format, Writing};
use super::loss::LossReport;
use super::point_section::{PointSection, TextAbove, commented_names};
use super::polygon::FilePolygon;
use super::reading::{Reading, Remark, Remarks};
use super::table_columns::{COLUMNS, ColumnChoice, ColumnNames, WEIGHT, vertex_columns};
use super::table_header::{CurveHeader, TableHeader, begins_table};
use super::table_lines::{Fields, LineContent, Lines, TableLine, separator};
use super::table_points::PointReader;
use super::text::text;
use crate::document::{Curve, Document, Group, Reference};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{PolygonError, PolygonKind};

/// The row of the table of formats.
pub static TABLE: Format = Format {
    name: "CSV table",
    extensions: &["csv"],
    read: Some(read),
    read_chosen: Some(read_chosen),
    draw: None,
    write: Some(write),
    write_back: None,
    rewrite: None,
    file_unit: FileUnit::Optional,
    holds_documents: false,
    exports: &[
        export("Export float S-polygon as CSV…", PolygonKind::Float),
        export("Export closed S-polygon as CSV…", PolygonKind::Clamped),
        export("Export Bézier polygons as CSV…", PolygonKind::Bezier),
    ],
};

const fn export(label: &'static str, polygon: PolygonKind) -> ExportRow {
    ExportRow {
        label,
        help: "Export a table of vertices; its header tells degree and kind",
        icon: "table",
        key: None,
        polygon: Some(polygon),
    }
}

/// The row of the same tables with tabs between the columns.
pub static TAB_TABLE: Format = Format {
    name: "TSV table",
    extensions: &["tsv"],
    read: Some(read),
    read_chosen: Some(read_chosen),
    draw: None,
    write: Some(write_with_tabs),
    write_back: None,
    rewrite: None,
    file_unit: FileUnit::Optional,
    holds_documents: false,
    exports: &[],
};

/// What begins the line that says the unit.
const UNIT_LINE: &str = "# unit=";

/// Read the curves and the lists of points of a file of tables.
///
/// # Errors
/// [`ReadError`] with the line, and with the curve and vertex where the numbers make no curve.
pub(super) fn read(bytes: &[u8]) -> Result<Reading, ReadError> {
    read_columns(bytes, None)
}

/// Read a file as [`read`] does, the points from chosen columns.
///
/// # Errors
/// As [`read`]; [`Problem::NoChoice`] if there are no points.
pub(super) fn read_chosen(bytes: &[u8], choice: &ColumnChoice) -> Result<Reading, ReadError> {
    read_columns(bytes, Some(choice))
}

fn read_columns(bytes: &[u8], choice: Option<&ColumnChoice>) -> Result<Reading, ReadError> {
    let mut remarks = Remarks::default();
    let text = decoded(bytes, &mut remarks)?;
    let separator = separator(&text);
    let mut comments = Comments::default();
    let sections = sections(Lines::all(&text, separator), &mut comments)?;
    let has_points = sections.iter().any(|it| matches!(it, Section::Points(_)));
    if choice.is_some() && !has_points {
        return Err(Problem::NoChoice.into());
    }
    let mut decimals = Decimals::default();
    let mut reading = Reading::default();
    let mut points = PointReader::new(choice, separator, comments.unit, text.len());
    for section in sections {
        match section {
            Section::Curve(block) => {
                let number = reading.curves.len() + 1;
                let curve = block.into_curve(number, &mut decimals, &mut remarks)?;
                reading.curves.push(Arc::new(curve));
            }
            Section::Points(section) => points.read(&section, &mut decimals)?,
        }
    }
    let vanished = decimals.vanished();
    let decimal_commas = decimals.are_commas()?;
    if decimal_commas || [';', '\t'].contains(&separator) {
        reading.remarks.add(Remark::Notation {
            separator,
            decimal_commas,
        });
    }
    comments.remark(&mut reading.remarks);
    reading.remarks.extend(remarks);
    points.finish(&mut reading)?;
    if let Some(vanished) = vanished {
        reading.remarks.add(vanished);
    }
    match reading.is_empty() {
        true => Err(Problem::NoPoints.into()),
        false => Ok(reading),
    }
}

/// Take bytes as text with the line ends of this program. Points in other text than UTF-8 are read as
/// Latin-1, which old titles are in: numbers are the same.
fn decoded<'a>(bytes: &'a [u8], remarks: &mut Remarks) -> Result<Cow<'a, str>, ReadError> {
    let text = match (of_utf16(bytes), text(bytes)) {
        (Some(text), _) => Cow::Owned(text),
        (None, Err(error)) if error.problem == Problem::NotUtf8 => {
            let latin: String = bytes.iter().copied().map(char::from).collect();
            if latin.lines().any(begins_curve) {
                return Err(error);
            }
            remarks.add(Remark::Latin1);
            Cow::Owned(latin)
        }
        (None, text) => Cow::Borrowed(text?),
    };
    // A carriage return alone ends a line too.
    Ok(match text.contains('\r') {
        true => Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")),
        false => text,
    })
}

/// Take bytes as UTF-16, which begins with its mark.
fn of_utf16(bytes: &[u8]) -> Option<String> {
    let (mark, units) = bytes.split_at_checked(2)?;
    let of_unit: fn([u8; 2]) -> u16 = match mark {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let units = units
        .chunks_exact(2)
        .map(|unit| of_unit([unit[0], unit[1]]));
    let units: Vec<u16> = units.collect();
    Some(String::from_utf16_lossy(&units))
}

fn begins_curve(line: &str) -> bool {
    line.trim_start_matches(['"', ' ']).starts_with('#') && begins_table(line)
}

/// A part of a file: the table of a curve, or lines with points.
enum Section<'a> {
    Curve(Block<'a>),
    Points(PointSection<'a>),
}

/// Divide a file where a line with # announces a table, and where names of columns follow numbers.
fn sections<'a>(all: Lines<'a>, comments: &mut Comments) -> Result<Vec<Section<'a>>, ReadError> {
    let mut sections: Vec<Section> = Vec::new();
    let mut title = TitleAbove::default();
    for mut line in all.split() {
        let above = title.note(&line);
        if let LineContent::Header(header) = &line.content {
            let header = TableHeader::parse(header);
            let header = header.map_err(|problem| Place::line(line.number).problem(problem))?;
            let section = Section::announced(line.number, header, all.after(&line));
            begin(&mut sections, &line, section);
            continue;
        }
        if matches!(line.content, LineContent::Comment) {
            let names = match sections.last() {
                None | Some(Section::Points(_)) => commented_names(line.text, all.separator()),
                Some(Section::Curve(_)) => None,
            };
            let Some(names) = names else {
                comments.take(&line)?;
                continue;
            };
            line.content = LineContent::Fields(names);
        }
        let LineContent::Fields(fields) = &line.content else {
            continue;
        };
        if fields.are_too_many() {
            return Err(Place::line(line.number).problem(Problem::TooManyColumns));
        }
        if sections.last().is_none_or(|last| last.ends_before(fields)) {
            let first = above.unwrap_or_else(|| line.without_content());
            title = TitleAbove::default();
            let section = PointSection {
                line: first.number,
                lines: all.from(&first),
                ..PointSection::default()
            };
            begin(&mut sections, &first, Section::Points(section));
        }
        match sections.last_mut() {
            Some(Section::Curve(block)) => block.has_columns = true,
            Some(Section::Points(section)) => section.note(fields),
            None => {}
        }
    }
    Ok(sections)
}

/// The text above a line with the names of columns, which is the title of what is below.
#[derive(Default)]
struct TitleAbove<'a> {
    /// The line that becomes the title.
    line: Option<TableLine<'a>>,
    /// What is known of it.
    text: TextAbove,
    /// Whether the line before is a row.
    is_below_row: bool,
}

impl<'a> TitleAbove<'a> {
    /// Look at the next line of the file. Returns the title above it.
    fn note(&mut self, line: &TableLine<'a>) -> Option<TableLine<'a>> {
        let above = self.line.clone();
        match &line.content {
            LineContent::Blank => {
                self.text.divide();
                self.is_below_row = false;
            }
            LineContent::Comment => {}
            LineContent::Header(_) => *self = Self::default(),
            LineContent::Fields(fields) if fields.have_numbers(2) => {
                self.line = None;
                self.is_below_row = true;
            }
            LineContent::Fields(_) => {
                if self.line.is_none() {
                    self.line = Some(line.without_content());
                    self.text.begin(self.is_below_row);
                } else if self.text.gives_way() {
                    self.line = Some(line.without_content());
                }
                self.is_below_row = false;
            }
        }
        above
    }
}

/// Begin a section at a line, which ends the one before.
fn begin<'a>(sections: &mut Vec<Section<'a>>, line: &TableLine, section: Section<'a>) {
    if let Some(last) = sections.last_mut() {
        let lines = match last {
            Section::Curve(block) => &mut block.lines,
            Section::Points(section) => &mut section.lines,
        };
        *lines = lines.before(line);
    }
    sections.push(section);
}

impl<'a> Section<'a> {
    fn announced(line: usize, header: TableHeader, lines: Lines<'a>) -> Self {
        match header.curve {
            Some(curve) => Self::Curve(Block {
                line,
                header: curve,
                name: header.name,
                lines,
                has_columns: false,
            }),
            None => Self::Points(PointSection {
                line,
                is_announced: true,
                name: header.name,
                lines,
                has_rows: false,
            }),
        }
    }

    /// Whether a line has the names of the columns of other points.
    fn ends_before(&self, fields: &Fields) -> bool {
        if fields.have_numbers(1) {
            return false;
        }
        let names = ColumnNames::of(fields);
        names.coordinates().is_some()
            && match self {
                Self::Curve(block) => !names.has_weights() && block.has_columns,
                Self::Points(section) => section.has_rows,
            }
    }
}

/// Write curves as tables of one of their polygons (default: float), and references that are points
/// as tables of these, where they are placed, under a line that says the unit of length if there is one.
///
/// # Errors
/// [`WriteError::NoCurves`]: an empty file could not be read again.
fn write(
    document: &Document,
    writing: &Writing,
    losses: &mut LossReport,
) -> Result<Vec<u8>, WriteError> {
    write_separated(document, writing, losses, &TABLE, b',')
}

fn write_with_tabs(
    document: &Document,
    writing: &Writing,
    losses: &mut LossReport,
) -> Result<Vec<u8>, WriteError> {
    write_separated(document, writing, losses, &TAB_TABLE, b'\t')
}

fn write_separated(
    document: &Document,
    writing: &Writing,
    losses: &mut LossReport,
    format: &Format,
    separator: u8,
) -> Result<Vec<u8>, WriteError> {
    let unit = document.unit().map(unit_line);
    let mut bytes = unit.unwrap_or_default().into_bytes();
    let mut blocks = Vec::new();
    for (_, curve) in document.curves() {
        let kind = writing.polygon.unwrap_or_default();
        blocks.push(curve_block(curve, kind, losses, separator));
        losses.add_attributes(curve);
        losses.add_group(&curve.name, &curve.group, Group::default());
        losses.add_state(&curve.name, curve.visible, curve.locked);
    }
    for (_, reference) in document.references() {
        match reference.points() {
            Some(points) => {
                blocks.push(points_block(reference, &points, separator));
                losses.add_list(reference);
            }
            None => losses.add_reference(reference),
        }
    }
    if blocks.is_empty() {
        return Err(WriteError::NoCurves {
            format: format.name,
        });
    }
    for block in blocks {
        if !bytes.is_empty() {
            bytes.push(b'\n');
        }
        bytes.extend(block.expect("a table of text can be written to memory"));
    }
    Ok(bytes)
}

fn points_block(reference: &Reference, points: &[DVec3], separator: u8) -> csv::Result<Vec<u8>> {
    let header = TableHeader {
        curve: None,
        name: Some(reference.name.clone()),
    };
    let planar = points.iter().all(|point| point.z == 0.0);
    let columns = if planar { 2 } else { 3 };
    block(&header, columns, points, None, separator)
}

fn curve_block(
    curve: &Curve,
    kind: PolygonKind,
    losses: &mut LossReport,
    separator: u8,
) -> csv::Result<Vec<u8>> {
    let polygon = FilePolygon::of(&curve.polygon, kind);
    losses.extend(curve, polygon.losses(&curve.polygon));
    let header = TableHeader {
        curve: Some(CurveHeader {
            degree: polygon.degree,
            kind,
            periodic: polygon.periodic,
        }),
        name: Some(curve.name.clone()),
    };
    let columns = match (&polygon.weights, curve.polygon.is_planar()) {
        (Some(_), _) => 4,
        (None, false) => 3,
        (None, true) => 2,
    };
    let weights = polygon.weights.as_deref();
    block(&header, columns, &polygon.vertices, weights, separator)
}

/// Write a table with the first `columns` of [`COLUMNS`].
fn block(
    header: &TableHeader,
    columns: usize,
    points: &[DVec3],
    weights: Option<&[f64]>,
    separator: u8,
) -> csv::Result<Vec<u8>> {
    let mut writer = WriterBuilder::new();
    let writer = writer.flexible(true).delimiter(separator);
    let mut writer = writer.from_writer(Vec::new());
    writer.write_record([header.to_line()])?;
    writer.write_record(&COLUMNS[..columns])?;
    for (index, point) in points.iter().enumerate() {
        let weight = weights.and_then(|weights| weights.get(index));
        let values = [point.x, point.y, point.z, *weight.unwrap_or(&1.0)];
        writer.write_record(&values.map(|value| format!("{value:?}"))[..columns])?;
    }
    let bytes = writer.into_inner();
    bytes.map_err(|error| error.into_error().into())
}

/// The line that says a unit.
pub(super) fn unit_line(unit: LengthUnit) -> String {
    format!("{UNIT_LINE}{}\n", unit.symbol())
}

/// The comments of a file, and the unit of length that a line says.
#[derive(Default)]
struct Comments {
    unit: Option<LengthUnit>,
    first: usize,
    count: usize,
}

impl Comments {
    /// Take a comment, or the unit that it says.
    ///
    /// # Errors
    /// [`Problem::MixedUnits`] with the line.
    fn take(&mut self, line: &TableLine) -> Result<(), ReadError> {
        let Some(unit) = unit_of(line.text) else {
            if self.count == 0 {
                self.first = line.number;
            }
            self.count += 1;
            return Ok(());
        };
        match self.unit.replace(unit) {
            Some(known) if known != unit => {
                Err(Place::line(line.number).problem(Problem::MixedUnits([known, unit])))
            }
            _ => Ok(()),
        }
    }

    fn remark(&self, remarks: &mut Remarks) {
        let Self { first, count, .. } = *self;
        if count > 0 {
            remarks.add(Remark::Comments { first, count });
        }
    }
}

/// The unit that a line says, if it says one; spreadsheets pad lines with separators.
fn unit_of(line: &str) -> Option<LengthUnit> {
    let symbol = line.trim_matches(['"', ' ']).strip_prefix(UNIT_LINE)?;
    LengthUnit::of_symbol(symbol.trim_end_matches([',', ';', '\t', ' ', '\r']))
}

/// The table of a curve.
struct Block<'a> {
    line: usize,
    header: CurveHeader,
    name: Option<String>,
    lines: Lines<'a>,
    /// Whether a line that names its columns was found.
    has_columns: bool,
}

/// The vertices of a table.
#[derive(Default)]
struct Vertices {
    /// For each column of the table which one of [`COLUMNS`] it is.
    columns: Vec<usize>,
    vertices: Vec<DVec3>,
    weights: Vec<f64>,
    /// The line of each vertex.
    lines: Vec<usize>,
}

impl Block<'_> {
    fn into_curve(
        self,
        number: usize,
        decimals: &mut Decimals,
        remarks: &mut Remarks,
    ) -> Result<Curve, ReadError> {
        let mut table = Vertices::default();
        for line in self.lines.split() {
            if let LineContent::Fields(fields) = &line.content {
                let taken = table.take(line.number, fields, decimals);
                taken.map_err(|problem| Place::line(line.number).problem(problem))?;
            }
        }
        let name = self.name;
        let name = name.unwrap_or_else(|| format!("curve {number}"));
        let place = |line: usize| Place {
            line: Some(line),
            ..Place::curve(number, &name)
        };
        if table.columns.is_empty() {
            return Err(place(self.line).problem(Problem::NoColumns));
        }
        let polygon = FilePolygon {
            kind: self.header.kind,
            degree: self.header.degree,
            vertices: table.vertices,
            weights: table.columns.contains(&WEIGHT).then_some(table.weights),
            periodic: self.header.periodic,
        };
        let curve = polygon.into_curve(number, &name, remarks);
        curve.map_err(|problem| {
            let vertex = match &problem {
                Problem::Polygon(
                    PolygonError::BadCoordinate { index, .. }
                    | PolygonError::BadWeight { index, .. },
                ) => table.lines.get(*index),
                _ => None,
            };
            place(vertex.copied().unwrap_or(self.line)).problem(problem)
        })
    }
}

impl Vertices {
    /// Take the names of the columns, then a vertex from each line.
    fn take(
        &mut self,
        line: usize,
        fields: &Fields,
        decimals: &mut Decimals,
    ) -> Result<(), Problem> {
        if self.columns.is_empty() {
            self.columns = vertex_columns(&fields.values)?;
            return Ok(());
        }
        let (found, needed) = (fields.values.len(), self.columns.len());
        if found != needed {
            return Err(Problem::ValueCount { found, needed });
        }
        let mut values = [0.0, 0.0, 0.0, 1.0];
        for (text, column) in fields.values.iter().zip(&self.columns) {
            values[*column] = decimals.number(text, COLUMNS[*column], line)?;
        }
        let [x, y, z, weight] = values;
        self.vertices.push(DVec3::new(x, y, z));
        self.weights.push(weight);
        self.lines.push(line);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
