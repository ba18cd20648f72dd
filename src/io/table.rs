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
//! Tables of spreadsheets are read too: the line of column names tells whether commas,
//! semicolons or tabs stand between the columns, the numbers tell whether decimals follow a
//! point or a comma. Other lines that begin with `#` are comments.

use std::borrow::Cow;

use csv::{ReaderBuilder, StringRecord, WriterBuilder};
use glam::DVec3;

use super::decimals::Decimals;
use super::error::{Place, Problem, ReadError, WriteError};
use super::format::{ExportRow, Format};
use super::loss::{Loss, LossReport};
use super::polygon::FilePolygon;
use super::reading::{Reading, Remark, Remarks};
use super::table_header::{CurveHeader, TableHeader, begins_table};
use super::text::text;
use crate::document::{Curve, Document, Reference};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{PointList, ReferenceCurve, ReferenceError, ReferenceForm};
use crate::geometry::{PolygonError, PolygonKind};

/// The row of the table of formats.
pub static TABLE: Format = Format {
    name: "CSV table",
    extensions: &["csv"],
    read: Some(read),
    write,
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

/// The columns that a table can have, in the order in which they are written.
const COLUMNS: [&str; 4] = ["x", "y", "z", "weight"];

/// What begins the line that says the unit.
const UNIT_LINE: &str = "# unit=";

/// The column of weights, which points do not have.
const WEIGHT: usize = 3;

/// Read the curves and the lists of points of a file of tables.
///
/// # Errors
/// [`ReadError`] with the line, and with the curve and vertex where the numbers make no curve.
fn read(bytes: &[u8]) -> Result<Reading, ReadError> {
    let mut comments = Comments::default();
    let text = comments.blanked(text(bytes)?);
    let separator = separator(&text);
    let mut decimals = Decimals::default();
    let mut blocks: Vec<Block> = Vec::new();
    each_record(&text, separator, |line, record| {
        if let Some(header) = header_text(record, separator) {
            if !begins_table(&header) {
                comments.add(line);
                return Ok(());
            }
            let header = TableHeader::parse(&header);
            let header = header.map_err(|problem| Place::line(line).problem(problem))?;
            blocks.push(Block::new(line, header));
            return Ok(());
        }
        if begins_points(record, blocks.last()) {
            blocks.push(Block::new(line, TableHeader::default()));
        }
        let block = blocks.last_mut();
        let block = block.ok_or_else(|| Place::line(line).problem(Problem::NoTableHeader))?;
        block.take(line, record, &mut decimals)
    })?;
    if blocks.is_empty() {
        return Err(Problem::NoTableHeader.into());
    }
    let decimal_commas = decimals.are_commas()?;
    let mut remarks = Remarks::default();
    if decimal_commas || separator != ',' {
        remarks.add(Remark::Notation {
            separator,
            decimal_commas,
        });
    }
    comments.remark(&mut remarks);
    let mut reading = Reading {
        unit: comments.unit,
        ..Reading::default()
    };
    for mut block in blocks {
        match block.header.curve.take() {
            Some(header) => {
                let number = reading.curves.len() + 1;
                let curve = block.into_curve(header, number, &mut remarks)?;
                reading.curves.push(curve);
            }
            None => {
                let number = reading.references.len() + 1;
                reading.references.push(block.into_points(number)?);
            }
        }
    }
    Ok(Reading { remarks, ..reading })
}

/// Write curves as tables of one of their polygons (default: float), and references that are points
/// as tables of these, where they are placed, under a line that says the unit of length if there is one.
///
/// # Errors
/// [`WriteError::NoCurves`]: an empty file could not be read again.
fn write(
    document: &Document,
    polygon: Option<PolygonKind>,
    losses: &mut LossReport,
) -> Result<Vec<u8>, WriteError> {
    let unit = document.unit();
    let unit_line = unit.map(|unit| format!("{UNIT_LINE}{}\n", unit.symbol()));
    let mut bytes = unit_line.unwrap_or_default().into_bytes();
    let mut blocks = Vec::new();
    for (_, curve) in document.curves() {
        blocks.push(curve_block(curve, polygon.unwrap_or_default(), losses));
        losses.add_attributes(curve);
        losses.add_if(!curve.visible, curve, Loss::Hidden);
        losses.add_if(curve.locked, curve, Loss::Locked);
    }
    for (_, reference) in document.references() {
        match reference.points() {
            Some(points) => blocks.push(points_block(reference, &points)),
            None => losses.add_reference(reference),
        }
    }
    if blocks.is_empty() {
        return Err(WriteError::NoCurves { format: TABLE.name });
    }
    for block in blocks {
        if !bytes.is_empty() {
            bytes.push(b'\n');
        }
        bytes.extend(block.expect("a table of text can be written to memory"));
    }
    Ok(bytes)
}

fn points_block(reference: &Reference, points: &[DVec3]) -> csv::Result<Vec<u8>> {
    let header = TableHeader {
        curve: None,
        name: Some(reference.name.clone()),
    };
    let planar = points.iter().all(|point| point.z == 0.0);
    block(&header, if planar { 2 } else { 3 }, points, None)
}

fn curve_block(curve: &Curve, kind: PolygonKind, losses: &mut LossReport) -> csv::Result<Vec<u8>> {
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
    block(&header, columns, &polygon.vertices, weights)
}

/// Write a table with the first `columns` of [`COLUMNS`].
fn block(
    header: &TableHeader,
    columns: usize,
    points: &[DVec3],
    weights: Option<&[f64]>,
) -> csv::Result<Vec<u8>> {
    let mut writer = WriterBuilder::new().flexible(true).from_writer(Vec::new());
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

/// Whether a line of values begins a list of points that no line with a `#` announces: names of columns,
/// or at the start of a file numbers, where no table waits for its columns.
fn begins_points(record: &StringRecord, last: Option<&Block>) -> bool {
    let names = columns(record);
    let named = names.is_ok_and(|columns| !columns.contains(&WEIGHT));
    match last {
        None => named || are_coordinates(record),
        Some(block) => named && !block.columns.is_empty(),
    }
}

/// Whether a line of values has the coordinates of a point.
fn are_coordinates(record: &StringRecord) -> bool {
    let is_number = |text: &str| Decimals::default().number(text, "x", 0).is_ok();
    (2..=3).contains(&record.len()) && record.iter().all(is_number)
}

/// The comments of a file, and the unit of length that the first line of this kind says.
#[derive(Default)]
struct Comments {
    unit: Option<LengthUnit>,
    first: usize,
    count: usize,
}

impl Comments {
    /// Empty the lines of a text that are comments: what looks like a quotation mark in them is
    /// none.
    fn blanked<'a>(&mut self, text: &'a str) -> Cow<'a, str> {
        let is_comment = |line: &str| line.trim_start().starts_with('#') && !begins_table(line);
        if !text.lines().any(is_comment) {
            return Cow::Borrowed(text);
        }
        let mut blanked = String::with_capacity(text.len());
        for (index, line) in text.split('\n').enumerate() {
            if index > 0 {
                blanked.push('\n');
            }
            if is_comment(line) {
                match unit_of(line).filter(|_| self.unit.is_none()) {
                    Some(unit) => self.unit = Some(unit),
                    None => self.add(index + 1),
                }
            } else {
                blanked.push_str(line);
            }
        }
        Cow::Owned(blanked)
    }

    fn add(&mut self, line: usize) {
        self.first = if self.count == 0 {
            line
        } else {
            self.first.min(line)
        };
        self.count += 1;
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

/// Find what stands between the columns, from the line with their names: the first line that
/// neither is empty nor begins with `#`.
fn separator(text: &str) -> char {
    let mut lines = text.lines().map(|line| line.trim_start_matches(['"', ' ']));
    let is_filled = |line: &str| !line.trim_matches([',', ';', '\t', ' ']).is_empty();
    let names = lines.find(|line| is_filled(line) && !line.starts_with('#'));
    let mut separators = [';', '\t'].into_iter();
    let found = names.and_then(|names| separators.find(|separator| names.contains(*separator)));
    found.unwrap_or(',')
}

/// Hand over each line of values with its number, but for lines without any value; the empty
/// values that spreadsheets pad lines with are cut off.
fn each_record(
    text: &str,
    separator: char,
    mut take: impl FnMut(usize, &StringRecord) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let mut reader = ReaderBuilder::new()
        .delimiter(u8::try_from(separator).unwrap_or(b','))
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    let mut record = StringRecord::new();
    let (mut line, mut counted) = (1, 0);
    loop {
        let more = reader.read_record(&mut record);
        let more = more.map_err(|error| Problem::Table(error.to_string()))?;
        if !more {
            return Ok(());
        }
        // The position lies before the blank lines above the record, so these count too.
        let start = record
            .position()
            .map_or(0, |position| position.byte() as usize);
        let blank = text[start..].len() - text[start..].trim_start_matches(['\r', '\n']).len();
        line += text[counted..start + blank].matches('\n').count();
        counted = start + blank;
        let filled = (0..record.len()).rev();
        let mut filled = filled.filter(|index| !record[*index].trim().is_empty());
        if let Some(last) = filled.next() {
            record.truncate(last + 1);
            take(line, &record)?;
        }
    }
}

/// Join a line that begins with `#` to the text it was before it was split into columns.
fn header_text(record: &StringRecord, separator: char) -> Option<String> {
    let is_header = record.get(0)?.trim_start().starts_with('#');
    is_header.then(|| {
        record
            .iter()
            .collect::<Vec<_>>()
            .join(separator.encode_utf8(&mut [0; 4]))
            .trim()
            .to_owned()
    })
}

/// A table as it is being read.
struct Block {
    line: usize,
    header: TableHeader,
    /// For each column of the table which one of [`COLUMNS`] it is.
    columns: Vec<usize>,
    vertices: Vec<DVec3>,
    weights: Vec<f64>,
    /// The line of each vertex.
    lines: Vec<usize>,
}

impl Block {
    fn new(line: usize, header: TableHeader) -> Self {
        Self {
            line,
            header,
            columns: Vec::new(),
            vertices: Vec::new(),
            weights: Vec::new(),
            lines: Vec::new(),
        }
    }

    fn take(
        &mut self,
        line: usize,
        record: &StringRecord,
        decimals: &mut Decimals,
    ) -> Result<(), ReadError> {
        let place = |problem| Place::line(line).problem(problem);
        if self.columns.is_empty() && self.header.curve.is_none() && are_coordinates(record) {
            self.columns = (0..record.len()).collect();
        } else if self.columns.is_empty() {
            self.columns = columns(record).map_err(place)?;
            return Ok(());
        }
        let (found, needed) = (record.len(), self.columns.len());
        if found != needed {
            return Err(place(Problem::ValueCount { found, needed }));
        }
        let mut values = [0.0, 0.0, 0.0, 1.0];
        for (text, column) in record.iter().zip(&self.columns) {
            let value = decimals.number(text, COLUMNS[*column], line);
            values[*column] = value.map_err(place)?;
        }
        let [x, y, z, weight] = values;
        self.vertices.push(DVec3::new(x, y, z));
        self.weights.push(weight);
        self.lines.push(line);
        Ok(())
    }

    /// Make a reference of the points, with this number, counted from 1.
    fn into_points(self, number: usize) -> Result<Reference, ReadError> {
        let name = self.header.name;
        let name = name.unwrap_or_else(|| format!("points {number}"));
        let place = |line: usize| Place {
            line: Some(line),
            ..Place::reference(number, &name)
        };
        if self.columns.contains(&WEIGHT) {
            return Err(Place::line(self.line).problem(Problem::NoTableHeader));
        }
        let list = PointList::new(self.vertices);
        let curve = list.and_then(|list| ReferenceCurve::of(ReferenceForm::Points(list)));
        let curve = curve.map_err(|error| {
            let point = match error {
                ReferenceError::BadPoint { index, .. } => self.lines.get(index),
                _ => None,
            };
            place(point.copied().unwrap_or(self.line)).problem(error.into())
        });
        Ok(Reference::new(name.clone(), curve?))
    }

    fn into_curve(
        self,
        header: CurveHeader,
        number: usize,
        remarks: &mut Remarks,
    ) -> Result<Curve, ReadError> {
        let name = self.header.name;
        let name = name.unwrap_or_else(|| format!("curve {number}"));
        let place = |line: usize| Place {
            line: Some(line),
            ..Place::curve(number, &name)
        };
        if self.columns.is_empty() {
            return Err(place(self.line).problem(Problem::NoColumns));
        }
        let is_rational = self
            .columns
            .iter()
            .any(|column| COLUMNS[*column] == "weight");
        let polygon = FilePolygon {
            kind: header.kind,
            degree: header.degree,
            vertices: self.vertices,
            weights: is_rational.then_some(self.weights),
            periodic: header.periodic,
        };
        let curve = polygon.into_curve(number, &name, remarks);
        curve.map_err(|problem| {
            let vertex = match &problem {
                Problem::Polygon(
                    PolygonError::BadCoordinate { index, .. }
                    | PolygonError::BadWeight { index, .. },
                ) => self.lines.get(*index),
                _ => None,
            };
            place(vertex.copied().unwrap_or(self.line)).problem(problem)
        })
    }
}

fn columns(record: &StringRecord) -> Result<Vec<usize>, Problem> {
    let mut columns = Vec::with_capacity(COLUMNS.len());
    for name in record.iter().map(str::trim) {
        let known = COLUMNS
            .iter()
            .position(|column| name.eq_ignore_ascii_case(column));
        match known {
            Some(column) if !columns.contains(&column) => columns.push(column),
            _ if columns.is_empty() && name.parse::<f64>().is_ok() => {
                return Err(Problem::NoColumns);
            }
            _ => return Err(Problem::BadColumn(name.to_owned())),
        }
    }
    for needed in [0, 1] {
        if !columns.contains(&needed) {
            return Err(Problem::MissingColumn(COLUMNS[needed]));
        }
    }
    Ok(columns)
}

#[cfg(test)]
mod tests;
