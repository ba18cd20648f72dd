//! Lists of points in tables as other programs write them: with titles, other columns, text between the
//! rows, and airfoils in either order.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DVec3;

use super::airfoil_order::{AirfoilOrder, around, is_selig, lednicer, uncounted, upper_first};
use super::decimals::{Decimals, is_number, measured};
use super::error::{Place, Problem, ReadError};
use super::exchange::spending::most_items;
use super::reading::{Reading, Remark, Remarks, nameless};
use super::table_columns::{COLUMNS, ColumnChoice, ColumnNames, Coordinates, WEIGHT, columns};
use super::table_lines::{Fields, LineContent, TableLine};
use super::tangent_plane::{TangentPlane, position};
use crate::document::Reference;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{PointList, ReferenceCurve, ReferenceError, ReferenceForm};

/// What columns are called that number the rows.
const COUNTERS: [&str; 10] = [
    "nr", "no", "n", "#", "id", "i", "index", "num", "number", "point",
];

/// No section of an airfoil has more points. To look for one takes memory.
const MOST_OF_AIRFOIL: usize = 100_000;

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
    pub(super) lines: Vec<TableLine<'a>>,
}

/// Read the sections of a file, and collect the remarks on them.
pub(super) struct PointReader<'a> {
    choice: Option<&'a ColumnChoice>,
    separator: char,
    unit: Option<LengthUnit>,
    lists: Vec<List>,
    most_lists: usize,
    skipped: Vec<usize>,
    repeated: Vec<usize>,
    too_large: Option<(String, Vec<usize>)>,
    remarks: Remarks,
}

/// A point with its line.
#[derive(Clone, Copy)]
pub(super) struct Row {
    /// The number of the line.
    pub(super) line: usize,
    /// The point.
    pub(super) point: DVec3,
    /// How much it counts, if a column tells.
    pub(super) weight: Option<f64>,
}

/// Rows that make a list of points.
struct List {
    /// The line where it begins.
    line: usize,
    name: String,
    rows: Vec<Row>,
    /// Whether the points are positions on the earth, in metres from its centre.
    is_on_earth: bool,
}

/// Rows without a blank line between them, with the text above them.
#[derive(Default)]
struct Block {
    title: Option<(usize, String)>,
    rows: Vec<Row>,
}

/// Which fields of which lines are coordinates.
struct Layout {
    /// The number of columns of most rows.
    count: usize,
    /// The number of column names, if there are more.
    named: usize,
    /// The line with the names.
    names: Option<usize>,
    /// The columns of the coordinates.
    coordinates: Coordinates,
    /// The unit behind the numbers of each of these columns.
    units: Vec<Option<String>>,
    /// The column of weights.
    weight: Option<usize>,
}

/// What a line of text is in a list of points.
enum Found {
    Row(Row),
    Text,
    /// A number too large for a double.
    TooLarge(String),
}

impl PointSection<'_> {
    /// Whether a line that could be a row is among them.
    pub(super) fn has_rows(&self) -> bool {
        self.fields().any(|(_, fields)| fields.numbers() >= 2)
    }

    fn fields(&self) -> impl Iterator<Item = (usize, &Fields<'_>)> {
        self.lines.iter().filter_map(|line| match &line.content {
            LineContent::Fields(fields) => Some((line.number, fields)),
            _ => None,
        })
    }
}

impl<'a> PointReader<'a> {
    /// Begin on a file of a length in bytes; `unit` is the one that a line of it says.
    pub(super) fn new(
        choice: Option<&'a ColumnChoice>,
        separator: char,
        unit: Option<LengthUnit>,
        length: usize,
    ) -> Self {
        Self {
            choice,
            separator,
            unit,
            lists: Vec::new(),
            most_lists: most_items(length),
            skipped: Vec::new(),
            repeated: Vec::new(),
            too_large: None,
            remarks: Remarks::default(),
        }
    }

    /// Read the lists of points of a section.
    ///
    /// # Errors
    /// [`ReadError`] with the line: the columns are not told, or the points make no list.
    pub(super) fn read(
        &mut self,
        section: &PointSection,
        decimals: &mut Decimals,
    ) -> Result<(), ReadError> {
        let layout = self.layout(section)?;
        let blocks = match &layout {
            Some(layout) => self.blocks(section, layout, decimals)?,
            None => {
                self.skipped.extend(section.fields().map(|(line, _)| line));
                Vec::new()
            }
        };
        if blocks.is_empty() && section.is_announced {
            let found = 0;
            let error = ReferenceError::TooFewPoints { found };
            return Err(Place::line(section.line).problem(error.into()));
        }
        let is_on_earth = layout.is_some_and(|layout| layout.coordinates.on_earth.is_some());
        let (blocks, told) = match is_on_earth {
            true => (blocks, None),
            false => self.in_order(blocks),
        };
        let blocks = self.joined(blocks);
        let title = blocks.first().and_then(|block| block.title.clone());
        let title = title.map(|(_, title)| title).or(section.name.clone());
        let several = blocks.len() > 1;
        for (block, number) in blocks.into_iter().zip(1..) {
            if let ([only], true) = (&block.rows[..], several) {
                self.skipped.push(only.line);
                self.skipped
                    .extend(block.title.iter().map(|(line, _)| *line));
                continue;
            }
            let own = block.title.map(|(_, title)| title);
            let numbered = title.as_ref().map(|title| match number {
                1 => title.clone(),
                _ => format!("{title}, block {number}"),
            });
            let may_be_airfoil = !is_on_earth && block.rows.len() <= MOST_OF_AIRFOIL;
            let order = told.or_else(|| {
                let rows = may_be_airfoil.then_some(&block.rows)?;
                let points: Vec<DVec3> = rows.iter().map(|row| row.point).collect();
                is_selig(&points).then_some(AirfoilOrder::Selig)
            });
            self.add(section.line, own.or(numbered), block.rows, is_on_earth)?;
            if let (Some(order), Some(added)) = (order, self.lists.last()) {
                let name = added.name.clone();
                self.remarks.add(Remark::Airfoil { name, order });
            }
        }
        Ok(())
    }

    /// Add what was read to the content of the file.
    ///
    /// # Errors
    /// [`ReadError`] if the points make no list.
    pub(super) fn finish(mut self, reading: &mut Reading) -> Result<(), ReadError> {
        reading.unit = reading.unit.or(self.unit);
        let mut lists = std::mem::take(&mut self.lists);
        self.project(&mut lists);
        let several = lists.len() > 1;
        for (list, number) in lists.into_iter().zip(1..) {
            // A receiver that stands still makes a list of one point.
            let first = list.rows.first().map(|row| row.point);
            if several && list.rows.iter().all(|row| Some(row.point) == first) {
                self.repeated.extend(list.rows.iter().map(|row| row.line));
                continue;
            }
            let reference = self.reference(number, list)?;
            reading.references.push(Arc::new(reference));
        }
        for (lines, remark) in [
            (self.skipped, Remark::Skipped as fn(Vec<usize>) -> Remark),
            (self.repeated, Remark::Repeated),
        ] {
            if !lines.is_empty() {
                self.remarks.add(remark(lines));
            }
        }
        if let Some((text, lines)) = self.too_large {
            self.remarks.add(Remark::TooLarge { text, lines });
        }
        reading.remarks.extend(self.remarks);
        Ok(())
    }

    /// Project the positions on the earth to one plane.
    fn project(&mut self, lists: &mut [List]) {
        let on_earth = lists.iter_mut().filter(|list| list.is_on_earth);
        let mut rows: Vec<&mut Row> = on_earth.flat_map(|list| &mut list.rows).collect();
        let sum = rows.iter().map(|row| row.point).sum();
        // Only positions all around the earth have their middle at its centre.
        let any = rows.first().map(|row| row.point).unwrap_or_default();
        let plane = TangentPlane::below(sum).or_else(|| TangentPlane::below(any));
        let Some(plane) = plane else {
            return;
        };
        for row in &mut rows {
            row.point = plane.point(row.point);
        }
        let [latitude, longitude] = [plane.latitude, plane.longitude].map(f64::to_degrees);
        self.remarks.add(Remark::TangentPlane {
            latitude,
            longitude,
        });
    }

    /// Find out which columns hold the coordinates; `None` if no line can be a row.
    fn layout(&mut self, section: &PointSection) -> Result<Option<Layout>, ReadError> {
        let rows = section.fields();
        let mut rows: Vec<(usize, &Fields)> =
            rows.filter(|(_, fields)| fields.numbers() >= 2).collect();
        let Some(count) = most_frequent(rows.iter().map(|(_, fields)| fields.values.len())) else {
            return Ok(None);
        };
        rows.retain(|(_, fields)| fields.values.len() == count);
        let first = rows.first().map_or(section.line, |(line, _)| *line);
        let names = self.names(section, first, count);
        let place = Place::line(names.as_ref().map_or(first, |(line, _)| *line));
        let named = names.as_ref().map(|(_, names)| names);
        let most = count.max(named.map_or(0, ColumnNames::count));
        let weight = self.choice.map(|choice| choice.weight(named, most));
        let weight = weight.transpose().map_err(|it| place.clone().problem(it))?;
        let chosen = self.choice.filter(|choice| choice.has_coordinates());
        let coordinates = match (chosen, named) {
            (Some(choice), _) => choice.places(named, most).map(Coordinates::of_lengths),
            (None, Some(names)) if self.choice.is_none() && names.has_weights() => {
                Err(Problem::NoTableHeader)
            }
            (None, _) => {
                let named_so = named.and_then(ColumnNames::coordinates);
                let numeric = || {
                    let places = self.numeric(&rows, count, named, weight.flatten());
                    places.map(Coordinates::of_lengths)
                };
                named_so.map_or_else(numeric, Ok)
            }
        };
        let coordinates = coordinates.map_err(|it| place.clone().problem(it))?;
        let places = coordinates.places.iter();
        let units = places.map(|place| common_unit(&rows, *place));
        let units: Vec<Option<String>> = units.collect();
        let taken = match coordinates.on_earth {
            Some(_) => self.take_unit(LengthUnit::Metre),
            None => self.take_units(named, &coordinates.places, &units),
        };
        taken.map_err(|it| place.problem(it))?;
        Ok(Some(Layout {
            count,
            named: names.as_ref().map_or(0, |(_, names)| names.count()),
            names: names.map(|(line, _)| line),
            coordinates,
            units,
            weight: weight.flatten(),
        }))
    }

    /// Find the line with the column names: the last line of text above the first row, if it names x and y
    /// or, where that is no title, has as many fields as the rows.
    fn names(
        &self,
        section: &PointSection,
        first: usize,
        count: usize,
    ) -> Option<(usize, ColumnNames)> {
        let above = section.fields().take_while(|(line, _)| *line < first);
        let is_rule = |fields: &Fields| {
            fields
                .values
                .iter()
                .all(|it| !it.contains(char::is_alphanumeric))
        };
        let words = above.filter(|(_, fields)| {
            fields.numbers() == 0 && !is_rule(fields) && !fields.lack_a_number()
        });
        let (line, fields) = words.last()?;
        let names = ColumnNames::of(fields);
        // Words of a title are seldom divided by commas or semicolons.
        let is_title = match self.separator {
            _ if self.choice.is_some_and(ColumnChoice::has_names) => false,
            ' ' => count <= 3,
            '\t' => count == 2,
            _ => false,
        };
        // The last column of a spreadsheet may be empty in all rows.
        let row = section.fields().find(|(line, _)| *line == first);
        let width = row.map_or(count, |(_, fields)| fields.width);
        let fits = [count, width].contains(&names.count());
        let is_there = |place: &usize| *place < count.max(width);
        let coordinates = names.coordinates();
        let are_there = coordinates.is_some_and(|it| it.places.iter().all(is_there));
        let are_names = are_there || (fits && !is_title);
        are_names.then_some((line, names))
    }

    /// Take the columns of numbers for the coordinates, but that of weights.
    ///
    /// # Errors
    /// [`Problem::AmbiguousColumns`] if there may be others.
    fn numeric(
        &mut self,
        rows: &[(usize, &Fields)],
        count: usize,
        names: Option<&ColumnNames>,
        weight: Option<usize>,
    ) -> Result<Vec<usize>, Problem> {
        let are_mostly = |place: &usize| {
            let numbers = rows
                .iter()
                .filter(|(_, fields)| is_number(&fields.values[*place]));
            2 * numbers.count() > rows.len() || common_unit(rows, *place).is_some()
        };
        let counts = |place: &usize| {
            let is_named = names
                .and_then(|names| names.get(*place))
                .is_some_and(is_counter);
            let numbers = rows
                .iter()
                .map(|(_, fields)| fields.values[*place].parse::<u64>().ok());
            let numbers: Option<Vec<u64>> = numbers.collect();
            is_named && numbers.is_some_and(|it| it.is_sorted_by(|a, b| *b == *a + 1))
        };
        let others = (0..count).filter(|place| Some(*place) != weight && !counts(place));
        let places: Vec<usize> = others.filter(are_mostly).collect();
        match (places.len(), names) {
            (2, Some(_)) => {
                let columns = columns(names, places.iter().copied());
                self.remarks.add(Remark::Columns(columns));
                Ok(places)
            }
            (2, None) | (3, None) => Ok(places),
            _ => Err(Problem::AmbiguousColumns(columns(names, places))),
        }
    }

    /// Take the units of columns, from their names and from behind their numbers.
    ///
    /// # Errors
    /// [`Problem::MixedUnits`].
    fn take_units(
        &mut self,
        names: Option<&ColumnNames>,
        places: &[usize],
        units: &[Option<String>],
    ) -> Result<(), Problem> {
        let named = places.iter().filter_map(|place| names?.unit(*place));
        let behind = units.iter().flatten().map(String::as_str);
        if let Some(unit) = behind.clone().next() {
            self.remark_once(Remark::Measured(unit.to_owned()));
        }
        for text in named.chain(behind) {
            match LengthUnit::of_symbol(text) {
                Some(unit) => self.take_unit(unit)?,
                None => self.remark_once(Remark::UnknownUnit(text.to_owned())),
            }
        }
        Ok(())
    }

    fn remark_once(&mut self, remark: Remark) {
        if !self.remarks.contains(&remark) {
            self.remarks.add(remark);
        }
    }

    /// Take a unit, which must be the one that is known already.
    ///
    /// # Errors
    /// [`Problem::MixedUnits`].
    fn take_unit(&mut self, unit: LengthUnit) -> Result<(), Problem> {
        match self.unit.replace(unit) {
            Some(known) if known != unit => Err(Problem::MixedUnits([known, unit])),
            _ => Ok(()),
        }
    }

    /// Divide a section at its blank lines.
    ///
    /// # Errors
    /// [`ReadError`] with the line: there are too many blocks of several rows, or the decimals are mixed.
    fn blocks(
        &mut self,
        section: &PointSection,
        layout: &Layout,
        decimals: &mut Decimals,
    ) -> Result<Vec<Block>, ReadError> {
        let mut blocks = Vec::new();
        let mut block = Block::default();
        let mut lists = self.lists.len();
        for line in &section.lines {
            let LineContent::Fields(fields) = &line.content else {
                if !block.rows.is_empty() {
                    lists += usize::from(block.rows.len() > 1);
                    self.check_count(lists, line.number)?;
                    block.rows.shrink_to_fit();
                    blocks.push(std::mem::take(&mut block));
                }
                continue;
            };
            match layout.found(line.number, fields, decimals) {
                Ok(Found::Row(row)) => block.rows.push(row),
                Ok(Found::TooLarge(text)) => {
                    let (_, lines) = self.too_large.get_or_insert((text, Vec::new()));
                    lines.push(line.number);
                }
                Ok(Found::Text) if layout.names == Some(line.number) => {}
                Ok(Found::Text) if fields.lack_a_number() => self.skipped.push(line.number),
                Ok(Found::Text) => match title(line.text) {
                    Some(title) if block.rows.is_empty() && block.title.is_none() => {
                        block.title = Some((line.number, title));
                    }
                    _ => self.skipped.push(line.number),
                },
                Err(problem) => return Err(Place::line(line.number).problem(problem)),
            }
        }
        match block.rows.is_empty() {
            true => self.skipped.extend(block.title.map(|(line, _)| line)),
            false => blocks.push(block),
        }
        Ok(blocks)
    }

    /// Bring an airfoil in Lednicer order into that around the section.
    fn in_order(&mut self, blocks: Vec<Block>) -> (Vec<Block>, Option<AirfoilOrder>) {
        if blocks.iter().map(|block| block.rows.len()).sum::<usize>() > MOST_OF_AIRFOIL {
            return (blocks, None);
        }
        let rows: Vec<Row> = blocks
            .iter()
            .flat_map(|it| it.rows.iter().copied())
            .collect();
        let points: Vec<DVec3> = rows.iter().map(|row| row.point).collect();
        let lengths = blocks.iter().map(|block| block.rows.len());
        let ends = lengths.scan(0, |end, length| {
            *end += length;
            Some(*end)
        });
        let ends: Vec<usize> = ends.collect();
        let is_same = |a: Row, b: Row| a.point == b.point;
        let (rows, order) = if let Some(sides) = lednicer(&points, &ends) {
            if !sides.are_counted {
                self.remarks.add(Remark::Counts { line: rows[0].line });
            }
            let rows = around(&rows[1..], sides.split, is_same);
            (rows, AirfoilOrder::Lednicer)
        } else if let Some(sides) = uncounted(&points, &ends) {
            if !sides.is_certain {
                let counts = [sides.split, rows.len() - sides.split];
                self.remarks.add(Remark::MaybeSides { counts });
                return (blocks, None);
            }
            let (rows, split) = upper_first(&rows, sides.split, sides.is_upper_second);
            (around(&rows, split, is_same), AirfoilOrder::Uncounted)
        } else {
            return (blocks, None);
        };
        let mut titles = blocks.into_iter().filter_map(|block| block.title);
        let title = titles.next();
        self.skipped.extend(titles.map(|(line, _)| line));
        (vec![Block { title, rows }], Some(order))
    }

    /// Join blocks of one row each: there a blank line follows every row.
    fn joined(&mut self, mut blocks: Vec<Block>) -> Vec<Block> {
        if blocks.iter().all(|block| block.rows.len() == 1) && !blocks.is_empty() {
            let others = blocks.split_off(1);
            for Block { title, rows } in others {
                self.skipped.extend(title.map(|(line, _)| line));
                blocks[0].rows.extend(rows);
            }
        }
        blocks
    }

    /// Skip a line.
    pub(super) fn skip(&mut self, line: usize) {
        self.skipped.push(line);
    }

    /// Add a list of points; `first` is the line where it begins.
    ///
    /// # Errors
    /// [`Problem::TooManyLists`] with the line.
    pub(super) fn add(
        &mut self,
        first: usize,
        name: Option<String>,
        rows: Vec<Row>,
        is_on_earth: bool,
    ) -> Result<(), ReadError> {
        let number = self.lists.len() + 1;
        self.check_count(number, rows.first().map_or(first, |row| row.line))?;
        self.lists.push(List {
            line: first,
            name: name.unwrap_or_else(|| nameless(number)),
            rows,
            is_on_earth,
        });
        Ok(())
    }

    /// Refuse more lists than the file can have, at a line.
    fn check_count(&self, lists: usize, line: usize) -> Result<(), ReadError> {
        match lists > self.most_lists {
            true => Err(Place::line(line).problem(Problem::TooManyLists(self.most_lists))),
            false => Ok(()),
        }
    }

    /// Make a reference of a list, without repeated points.
    ///
    /// # Errors
    /// [`ReadError`] if the points make no list.
    fn reference(&mut self, number: usize, list: List) -> Result<Reference, ReadError> {
        let List {
            line: first,
            name,
            mut rows,
            ..
        } = list;
        let repeated = &mut self.repeated;
        rows.dedup_by(|row, before| {
            let is_repeated = row.point == before.point;
            repeated.extend(is_repeated.then_some(row.line));
            is_repeated
        });
        let points: Vec<DVec3> = rows.iter().map(|row| row.point).collect();
        let weights: Option<Vec<f64>> = rows.iter().map(|row| row.weight).collect();
        let list = PointList::new(points).and_then(|list| match weights {
            Some(weights) => list.with_weights(weights),
            None => Ok(list),
        });
        let curve = list.and_then(|list| ReferenceCurve::of(ReferenceForm::Points(list)));
        let curve = curve.map_err(|error| {
            let line = match error {
                ReferenceError::BadPoint { index } | ReferenceError::BadWeight { index } => {
                    rows.get(index).map(|row| row.line)
                }
                _ => None,
            };
            let place = Place {
                line: Some(line.unwrap_or(first)),
                ..Place::reference(number, &name)
            };
            place.problem(error.into())
        });
        Ok(Reference::new(name.clone(), curve?))
    }
}

impl Layout {
    /// Tell whether a line is a row.
    ///
    /// # Errors
    /// [`Problem`] if its decimals are not those of the rows before.
    fn found(
        &self,
        line: usize,
        fields: &Fields,
        decimals: &mut Decimals,
    ) -> Result<Found, Problem> {
        let most = self.count.max(self.named);
        let length = fields.values.len();
        let is_padded = length < most && fields.width >= most;
        if ![self.count, self.named].contains(&length) && !is_padded {
            return Ok(Found::Text);
        }
        let text = |place: &usize| fields.values.get(*place).map_or("", |text| text.as_ref());
        let places = &self.coordinates.places;
        let number = |(place, unit): (&usize, &Option<String>)| match (unit, text(place)) {
            (None, text) => text,
            (Some(unit), text) => measured(text)
                .filter(|(_, behind)| behind == unit)
                .map_or("", |(number, _)| number),
        };
        let coordinates = places.iter().zip(&self.units).map(number);
        let texts: Vec<&str> = coordinates.chain(self.weight.iter().map(text)).collect();
        if let Some(text) = texts.iter().find(|text| is_too_large(text)) {
            return Ok(Found::TooLarge((*text).to_owned()));
        }
        if !texts.iter().all(|text| is_number(text)) {
            return Ok(Found::Text);
        }
        let (coordinates, weight) = texts.split_at(places.len());
        let mut point = [0.0; 3];
        for ((value, text), column) in point.iter_mut().zip(coordinates).zip(COLUMNS) {
            *value = decimals.number(text, column, line)?;
        }
        let weight = weight.first().copied();
        let weight = weight.map(|text| decimals.number(text, COLUMNS[WEIGHT], line));
        let [x, y, z] = point;
        let point = match self.coordinates.on_earth {
            Some([east, north]) => position(Some(north * y), Some(east * x))?,
            None => DVec3::new(x, y, z),
        };
        Ok(Found::Row(Row {
            line,
            point,
            weight: weight.transpose()?,
        }))
    }
}

/// The unit behind all numbers of a column; `None` if there is none, or not the same everywhere.
fn common_unit(rows: &[(usize, &Fields)], place: usize) -> Option<String> {
    let unit = |(_, fields): &(usize, &Fields)| {
        let (_, unit) = measured(fields.values.get(place)?)?;
        Some(unit.to_owned())
    };
    let first = unit(rows.first()?)?;
    let is_common = rows.iter().all(|row| unit(row).as_ref() == Some(&first));
    is_common.then_some(first)
}

/// Whether a column's name is one of a row's number.
fn is_counter(name: &str) -> bool {
    let name = name.trim_end_matches('.').to_lowercase();
    COUNTERS.contains(&name.as_str())
}

/// Find the most frequent number; of several the one that comes first.
fn most_frequent(numbers: impl Iterator<Item = usize>) -> Option<usize> {
    let mut counts: HashMap<usize, (usize, usize)> = HashMap::new();
    for (place, number) in numbers.enumerate() {
        counts.entry(number).or_insert((0, place)).0 += 1;
    }
    let rated = |(_, (count, place)): &(usize, (usize, usize))| (*count, usize::MAX - place);
    counts
        .into_iter()
        .max_by_key(rated)
        .map(|(number, _)| number)
}

/// Whether a text is a number that only lacks a larger exponent to be finite.
fn is_too_large(text: &str) -> bool {
    let is_infinite = text.parse().is_ok_and(f64::is_infinite);
    is_infinite && text.bytes().any(|byte| byte.is_ascii_digit())
}

/// The text of a title, without what a spreadsheet puts around it; `None` for a line without letters.
fn title(line: &str) -> Option<String> {
    let line = line.trim_matches([',', ';', '\t', ' ']);
    let inner = line
        .strip_prefix('"')
        .and_then(|line| line.strip_suffix('"'));
    let words: Vec<&str> = inner.unwrap_or(line).split_whitespace().collect();
    let title = words.join(" ");
    title.contains(char::is_alphabetic).then_some(title)
}

/// Whether a text above rows is read as their title.
pub(super) fn is_title(text: &str) -> bool {
    let fields = Fields::of(text, ' ');
    title(text).is_some_and(|title| title == text)
        && !text.starts_with('#')
        && !text.contains(char::is_control)
        && fields.numbers() < 2
        && ColumnNames::of(&fields).coordinates().is_none()
}
