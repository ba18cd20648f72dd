//! Polygon tables as comma-separated values: one block a curve.
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

use csv::{ReaderBuilder, StringRecord, WriterBuilder};
use glam::DVec3;

use super::error::{Place, Problem, ReadError, WriteError};
use super::format::Format;
use super::loss::{Export, Loss, LossReport};
use super::polygon::{Written, build, written};
use super::project::text;
use super::table_header::TableHeader;
use crate::document::Curve;
use crate::geometry::{PolygonError, PolygonKind};

/// The columns that a table can have, in the order in which they are written.
const COLUMNS: [&str; 4] = ["x", "y", "z", "weight"];

/// Read the curves of a file of tables.
///
/// # Errors
/// [`ReadError`] with the line, and with the curve and vertex where the numbers make no curve.
pub fn read(bytes: &[u8]) -> Result<Vec<Curve>, ReadError> {
    let text = text(bytes)?;
    let mut blocks: Vec<Block> = Vec::new();
    each_record(text, |line, record| {
        if let Some(header) = header_text(record) {
            let header = TableHeader::parse(&header);
            let header = header.map_err(|problem| Place::line(line).problem(problem))?;
            blocks.push(Block::new(line, header));
            return Ok(());
        }
        let block = blocks.last_mut();
        let block = block.ok_or_else(|| Place::line(line).problem(Problem::NoTableHeader))?;
        block.take(line, record)
    })?;
    if blocks.is_empty() {
        return Err(Problem::NoTableHeader.into());
    }
    let numbered = blocks.into_iter().enumerate();
    numbered
        .map(|(index, block)| block.into_curve(index + 1))
        .collect()
}

/// Write curves as tables of one of their polygons.
///
/// # Errors
/// [`WriteError::NoCurves`]: an empty file could not be read again.
pub fn write(curves: &[&Curve], kind: PolygonKind) -> Result<Export, WriteError> {
    if curves.is_empty() {
        let format = Format::Csv;
        return Err(WriteError::NoCurves { format });
    }
    let mut losses = LossReport::new(Format::Csv);
    let mut bytes = Vec::new();
    for curve in curves {
        if !bytes.is_empty() {
            bytes.push(b'\n');
        }
        let block = block_bytes(curve, kind, &mut losses);
        bytes.extend(block.expect("a table of text can be written to memory"));
        losses.add_if(curve.colour.is_some(), curve, Loss::Colour);
        losses.add_if(!curve.visible, curve, Loss::Hidden);
        losses.add_if(curve.locked, curve, Loss::Locked);
        let has_targets = !curve.targets.list().is_empty();
        losses.add_if(has_targets, curve, Loss::Targets);
    }
    Ok(Export { bytes, losses })
}

fn block_bytes(curve: &Curve, kind: PolygonKind, losses: &mut LossReport) -> csv::Result<Vec<u8>> {
    let Written {
        vertices,
        weights,
        periodic,
        losses: lost,
    } = written(&curve.polygon, kind);
    for loss in lost {
        losses.add(curve, loss);
    }
    let header = TableHeader {
        degree: curve.polygon.degree(),
        kind,
        periodic,
        name: Some(curve.name.clone()),
    };
    let columns = match (&weights, curve.polygon.is_planar()) {
        (Some(_), _) => 4,
        (None, false) => 3,
        (None, true) => 2,
    };
    let mut writer = WriterBuilder::new().flexible(true).from_writer(Vec::new());
    writer.write_record([header.to_line()])?;
    writer.write_record(&COLUMNS[..columns])?;
    for (index, vertex) in vertices.iter().enumerate() {
        let weight = weights.as_ref().map_or(1.0, |weights| weights[index]);
        let values = [vertex.x, vertex.y, vertex.z, weight].map(|value| format!("{value:?}"));
        writer.write_record(&values[..columns])?;
    }
    writer
        .into_inner()
        .map_err(|error| error.into_error().into())
}

/// Hand over each line of values with its number, but for lines without any value; the empty
/// values that spreadsheets pad lines with are cut off.
fn each_record(
    text: &str,
    mut take: impl FnMut(usize, &StringRecord) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let mut reader = ReaderBuilder::new()
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

/// Join a line that begins with `#` to the text it was before it was split at commas.
fn header_text(record: &StringRecord) -> Option<String> {
    let is_header = record.get(0)?.trim_start().starts_with('#');
    is_header.then(|| {
        record
            .iter()
            .collect::<Vec<_>>()
            .join(",")
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

    fn take(&mut self, line: usize, record: &StringRecord) -> Result<(), ReadError> {
        let place = |problem| Place::line(line).problem(problem);
        if self.columns.is_empty() {
            self.columns = columns(record).map_err(place)?;
            return Ok(());
        }
        let (found, needed) = (record.len(), self.columns.len());
        if found != needed {
            return Err(place(Problem::ValueCount { found, needed }));
        }
        let mut values = [0.0, 0.0, 0.0, 1.0];
        for (text, column) in record.iter().zip(&self.columns) {
            values[*column] = number(text, COLUMNS[*column]).map_err(place)?;
        }
        let [x, y, z, weight] = values;
        self.vertices.push(DVec3::new(x, y, z));
        self.weights.push(weight);
        self.lines.push(line);
        Ok(())
    }

    fn into_curve(self, number: usize) -> Result<Curve, ReadError> {
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
        let polygon = build(
            self.header.kind,
            self.header.degree,
            self.vertices,
            is_rational.then_some(self.weights),
            self.header.periodic,
        );
        let polygon = polygon.map_err(|problem| {
            let vertex = match &problem {
                Problem::Polygon(
                    PolygonError::BadCoordinate { index, .. }
                    | PolygonError::BadWeight { index, .. },
                ) => self.lines.get(*index),
                _ => None,
            };
            place(vertex.copied().unwrap_or(self.line)).problem(problem)
        })?;
        Ok(Curve::new(name, polygon))
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

fn number(text: &str, column: &'static str) -> Result<f64, Problem> {
    let text = text.trim();
    let value: f64 = text.parse().map_err(|_| Problem::NotANumber {
        column,
        text: text.to_owned(),
    })?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Problem::NotFinite(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Colour;
    use crate::geometry::FloatPolygon;

    fn curve(
        name: &str,
        vertices: &[[f64; 3]],
        weights: Option<Vec<f64>>,
        periodic: bool,
    ) -> Curve {
        let vertices = vertices.iter().map(|vertex| DVec3::from_array(*vertex));
        let polygon = FloatPolygon::new(2, vertices.collect(), weights, periodic);
        Curve::new(name, polygon.unwrap())
    }

    fn planar() -> Curve {
        let vertices = [
            [0.1, 1e-300, 0.0],
            [-2.5e7, 1.0 / 3.0, 0.0],
            [3.0, -1e100, 0.0],
        ];
        curve("arc", &vertices, None, false)
    }

    fn spatial() -> Curve {
        let vertices = [
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 2.0, 5.0],
        ];
        curve("a \"b\", c=d\n", &vertices, None, true)
    }

    fn rational() -> Curve {
        let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        curve("weighted", &vertices, Some(vec![1.0, 0.1, 1e-100]), false)
    }

    #[test]
    fn the_layout_is_as_described() {
        let check = |curve: Curve, expected: &str| {
            let bytes = write(&[&curve], PolygonKind::Float).unwrap().bytes;
            assert_eq!(String::from_utf8(bytes).unwrap(), expected);
        };
        check(
            planar(),
            "# degree=2 polygon=float periodic=false name=arc\nx,y\n0.1,1e-300\n-25000000.0,0.3333333333333333\n3.0,-1e100\n",
        );
        check(
            rational(),
            "# degree=2 polygon=float periodic=false name=weighted\nx,y,z,weight\n0.0,0.0,0.0,1.0\n1.0,0.0,0.0,0.1\n1.0,1.0,0.0,1e-100\n",
        );
        check(
            spatial(),
            "\"# degree=2 polygon=float periodic=true name=\"\"a \\\"\"b\\\"\", c=d\\n\"\"\"\nx,y,z\n0.0,0.0,1.0\n1.0,0.0,0.0\n1.0,1.0,0.0\n0.0,2.0,5.0\n",
        );
    }

    #[test]
    fn tables_come_back_exactly() {
        let curves = [planar(), spatial(), rational()];
        let export = write(&curves.each_ref(), PolygonKind::Float).unwrap();
        assert!(export.losses.is_empty(), "{}", export.losses);
        assert_eq!(read(&export.bytes).unwrap(), curves);
    }

    #[test]
    fn what_a_table_does_not_hold_is_reported() {
        let mut changed = spatial();
        changed.name = "c".to_owned();
        changed.colour = Some(Colour([1, 2, 3]));
        changed.visible = false;
        changed.locked = true;
        changed.targets.start = Some(crate::geometry::end_correction::EndTarget {
            point: DVec3::ZERO,
            direction: None,
        });
        let losses = write(&[&changed], PolygonKind::Bezier).unwrap().losses;
        let losses: Vec<Loss> = losses.losses.into_iter().map(|(_, loss)| loss).collect();
        let expected = [
            Loss::Periodic,
            Loss::Colour,
            Loss::Hidden,
            Loss::Locked,
            Loss::Targets,
        ];
        assert_eq!(losses, expected);
        assert!(matches!(
            write(&[], PolygonKind::Float),
            Err(WriteError::NoCurves { .. })
        ));
    }

    #[test]
    fn tables_of_other_programs_are_read() {
        let check = |text: &str, expected: &[[f64; 3]], weights: Option<Vec<f64>>| {
            let curves = read(text.as_bytes()).unwrap();
            assert_eq!(
                curves,
                [curve("curve 1", expected, weights, false)],
                "{text:?}"
            );
        };
        let plane = [[0.0, 1.0, 0.0], [2.0, 3.0, 0.0], [4.0, 5.0, 0.0]];
        // Marks, line ends, blank lines, padding and upper case are a spreadsheet's.
        check(
            "\u{feff}# degree=2,,\r\n\r\nX,Y,\r\n0,1\r\n2, 3 ,\r\n,,\r\n4,5",
            &plane,
            None,
        );
        check(" #degree=2\n y , x \n1,0\n3,2\n5,4\n", &plane, None);
        check(
            "# degree=2\nx,y,weight\n0,1,1\n2,3,2\n4,5,3\n",
            &plane,
            Some(vec![1.0, 2.0, 3.0]),
        );
        check(
            "# degree=2 polygon=bezier\nx,y\n0,0\n1,1\n2,0\n",
            &[[-1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [3.0, -1.0, 0.0]],
            None,
        );
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let check = |text: &str, expected: &str| {
            let message = read(text.as_bytes()).unwrap_err().to_string();
            assert_eq!(message, expected, "{text:?}");
        };
        let hint = "the table does not say which curve its vertices make: put a line like “# degree=3 polygon=float periodic=false name=curve” above the line with the column names";
        check("", "the file is empty");
        check("\n \n", "the file is empty");
        check(",,\n", hint);
        check("\n\nx,y\n0,0\n", &format!("line 3: {hint}"));
        check(
            "# degree=2 name=hull",
            "line 1, curve 1 “hull”: the table has no columns: put a line with their names, for example “x,y”, above its numbers",
        );
        check(
            "# degree=2\n\n0,1\n",
            "line 3: the table has no columns: put a line with their names, for example “x,y”, above its numbers",
        );
        check(
            "# degree=2\nx;y\n",
            "line 2: “x;y” is not a column name that can stand here: the columns are x,y or x,y,z, then weight, each once and separated by commas",
        );
        check(
            "# degree=2\nx,x\n",
            "line 2: “x” is not a column name that can stand here: the columns are x,y or x,y,z, then weight, each once and separated by commas",
        );
        check(
            "# degree=2\nx,z\n",
            "line 2: the column y is missing: the columns x and y are needed",
        );
        let rows = "\nx,y\n0,0\n1,0\n\n";
        check(
            &format!("# degree=2{rows}2,3,4\n"),
            "line 6: 3 values for 2 columns",
        );
        check(
            &format!("# degree=2{rows}2\n"),
            "line 6: 1 values for 2 columns",
        );
        check(
            &format!("# degree=2{rows}2,two\n"),
            "line 6: “two” in column y is not a number",
        );
        for value in ["NaN", "inf", "-infinity", "1e999"] {
            check(
                &format!("# degree=2{rows}2,{value}\n"),
                &format!(
                    "line 6: “{value}” is not a finite number: only finite numbers can be used"
                ),
            );
        }
        check(
            &format!("# degree=2 name=hull{rows}2,1e200\n"),
            "line 6, curve 1 “hull”, vertex 2: coordinate y is 1e200, and only finite numbers up to 1e100 can be used",
        );
        check(
            "# degree=1\nx,y,weight\n0,0,1\n1,1,-2\n",
            "line 4, curve 1 “curve 1”, vertex 1: weight -2.0 cannot be used: weights are positive numbers from 1e-100 to 1e100",
        );
        check(
            &format!("# degree=0{rows}"),
            "line 1, curve 1 “curve 1”: degree 0 is out of range: a degree from 1 to 25 is needed",
        );
        check(
            &format!("# degree=26{rows}"),
            "line 1, curve 1 “curve 1”: degree 26 is out of range: a degree from 1 to 25 is needed",
        );
        check(
            &format!("# degree=1{rows}\n# degree=2 name=b{rows}"),
            "line 7, curve 2 “b”: 2 vertices are too few: an open curve of degree 2 needs at least 3",
        );
        check(
            &format!("# degree=1 polygon=clamped periodic=true{rows}"),
            "line 1, curve 1 “curve 1”: a periodic curve cannot be given by its clamped polygon, which starts and ends somewhere: give its float polygon, or make it open",
        );
        check(
            "# degree=2 vertices=1000000000\nx,y\n",
            "line 1: “vertices=1000000000” is not known here: a line above a table holds degree=…, polygon=…, periodic=… and, last, name=…",
        );
    }

    #[test]
    fn text_that_is_not_utf8_is_refused_with_its_place() {
        let error = read(b"# degree=2\nx,\xff").unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 2, column 3: the file is not text in UTF-8 here: save it as UTF-8"
        );
    }
}
