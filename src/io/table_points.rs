//! Lists of points in tables as other programs write them: with titles, other columns, text between the
//! rows, and airfoils in either order.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;

use super::airfoil_order::{AirfoilOrder, around, is_selig, lednicer, uncounted, upper_first};
use super::decimals::{Decimals, is_number, measured};
use super::error::{Place, Problem, ReadError};
use super::exchange::short_names::{CUT, is_cut, short};
use super::exchange::spending::most_items;
use super::point_section::{Content, PointSection, TextAbove, Usual};
use super::reading::{Reading, Remark, Remarks, nameless};
use super::table_columns::{
    COLUMNS, ColumnChoice, ColumnNames, Coordinates, WEIGHT, are_units, columns,
};
use super::table_lines::Fields;
use super::tangent_plane::{TangentPlane, position};
use crate::document::Reference;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{PointList, ReferenceCurve, ReferenceError, ReferenceForm};

/// What columns are called that number the rows.
const COUNTERS: [&str; 10] = [
    "nr", "no", "n", "#", "id", "i", "index", "num", "number", "point",
];

/// A text below fewer rows is no title.
const LEAST_TITLED: usize = 2;

/// No airfoil in a file of several has more points.
const MOST_TITLED: usize = 2000;

/// No section of an airfoil has more points. To look for one takes memory.
const MOST_OF_AIRFOIL: usize = 100_000;

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

/// Rows without a blank line between them, one behind the other, with the texts above them.
#[derive(Default)]
struct Blocks {
    rows: Vec<Row>,
    /// Behind which row each block ends.
    ends: Vec<usize>,
    /// The titles with their blocks and lines.
    titles: Vec<(usize, usize, String)>,
    /// The blocks that end at a text without a blank line above it, which may be no title.
    at_texts: Vec<usize>,
}

/// Which fields of which lines are coordinates.
struct Layout {
    /// The number of columns of most rows.
    count: usize,
    /// How many rows these are.
    rows: usize,
    /// The number of columns up to the last with numbers.
    numeric: usize,
    /// The number of column names, if there are more.
    named: usize,
    /// The line with the names, and that with their units.
    names: Option<[usize; 2]>,
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

impl Blocks {
    /// End a block, which may have a title at a line.
    fn end(&mut self, title: Option<(usize, String)>) {
        let block = self.ends.len();
        self.titles
            .extend(title.map(|(line, title)| (block, line, title)));
        self.ends.push(self.rows.len());
    }

    /// End a block at a text without a blank line above it.
    fn end_at_text(&mut self, title: Option<(usize, String)>) {
        self.at_texts.push(self.ends.len());
        self.end(title);
    }

    /// Keep the end of the last block, if a text without rows below it is there: a blank line or the end of the file
    /// follows.
    fn keep_last_end(&mut self) {
        let last = self.ends.len();
        if !self.is_open() {
            self.at_texts.pop_if(|block| *block + 1 == last);
        }
    }

    /// Take titles out of the texts that may be none: above a title or below it is a whole airfoil.
    fn drop_titles(&mut self) {
        let at_texts = std::mem::take(&mut self.at_texts);
        let nexts = at_texts.iter().skip(1).map(|block| block + 1);
        let nexts: Vec<usize> = nexts.chain([self.ends.len()]).collect();
        let mut first = 0;
        for (block, next) in at_texts.into_iter().zip(nexts) {
            let end = block + 1;
            match self.are_airfoil(first..end) || self.are_airfoil(end..next) {
                true => first = end,
                false => self.at_texts.push(block),
            }
        }
    }

    /// Whether some blocks are an airfoil together.
    fn are_airfoil(&self, blocks: Range<usize>) -> bool {
        let begin = blocks.start.checked_sub(1).map_or(0, |it| self.ends[it]);
        let ends: Vec<usize> = self.ends[blocks].iter().map(|it| it - begin).collect();
        let length = ends.last().copied().unwrap_or_default();
        if length > MOST_TITLED {
            return false;
        }
        let rows = self.rows[begin..begin + length].iter();
        let points: Vec<DVec3> = rows.map(|row| row.point).collect();
        is_selig(&points)
            || lednicer(&points, &ends).is_some()
            || uncounted(&points, &ends).is_some_and(|it| it.is_certain)
    }

    /// Join the blocks that texts divide which are no titles. Returns the lines of these.
    fn join_at_texts(&mut self) -> Vec<usize> {
        let at_texts = std::mem::take(&mut self.at_texts);
        let is_at_text = |block: usize| at_texts.binary_search(&block).is_ok();
        let ends = std::mem::take(&mut self.ends).into_iter().enumerate();
        let ends = ends.filter(|(block, _)| !is_at_text(*block));
        self.ends = ends.map(|(_, end)| end).collect();
        let mut lines = Vec::new();
        for (block, line, title) in std::mem::take(&mut self.titles) {
            match block.checked_sub(1).is_some_and(is_at_text) {
                true => lines.push(line),
                false => {
                    let joined = at_texts.partition_point(|it| *it < block);
                    self.titles.push((block - joined, line, title));
                }
            }
        }
        lines
    }

    /// Whether there are rows behind the last block.
    fn is_open(&self) -> bool {
        self.ends.last().copied().unwrap_or_default() < self.rows.len()
    }

    /// Whether each block is one row: there a blank line follows every row.
    fn are_single(&self) -> bool {
        self.rows.len() == self.ends.len()
    }

    /// Divide them at the titles.
    fn by_title(self) -> Vec<Self> {
        if self.titles.iter().all(|(block, ..)| *block == 0) {
            return vec![self];
        }
        let mut parts: Vec<Self> = Vec::new();
        let mut rows = self.rows.into_iter();
        let mut titles = self.titles.into_iter().peekable();
        let mut begin = 0;
        for (block, end) in self.ends.into_iter().enumerate() {
            let title = titles.next_if(|(titled, ..)| *titled == block);
            if title.is_some() || parts.is_empty() {
                parts.push(Self::default());
            }
            if let Some(part) = parts.last_mut() {
                part.rows.extend(rows.by_ref().take(end - begin));
                part.end(title.map(|(_, line, title)| (line, title)));
            }
            begin = end;
        }
        parts
    }

    /// The numbers of rows of the blocks.
    fn lengths(&self) -> impl Iterator<Item = usize> {
        let begins = [0].into_iter().chain(self.ends.iter().copied());
        self.ends.iter().zip(begins).map(|(end, begin)| end - begin)
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
                Blocks::default()
            }
        };
        if blocks.ends.is_empty() && section.is_announced {
            let found = 0;
            let error = ReferenceError::TooFewPoints { found };
            return Err(Place::line(section.line).problem(error.into()));
        }
        let is_on_earth = layout.is_some_and(|layout| layout.coordinates.on_earth.is_some());
        let parts = match is_on_earth || blocks.are_single() {
            true => vec![blocks],
            false => blocks.by_title(),
        };
        let has_parts = parts.len() > 1;
        let mut name = section.name.clone();
        for part in parts {
            self.add_blocks((section.line, name.take()), part, is_on_earth, has_parts)?;
        }
        Ok(())
    }

    /// Add the blocks of a section, which has a line and may have a name, or those below one title of it.
    fn add_blocks(
        &mut self,
        (line, name): (usize, Option<String>),
        blocks: Blocks,
        is_on_earth: bool,
        is_part: bool,
    ) -> Result<(), ReadError> {
        let (blocks, told) = match is_on_earth {
            true => (blocks, None),
            false => self.in_order(blocks),
        };
        let blocks = self.joined(blocks);
        let lengths: Vec<usize> = blocks.lengths().collect();
        let several = lengths.len() > 1 || is_part;
        let mut rows = blocks.rows.into_iter();
        let mut titles = blocks.titles.into_iter().peekable();
        let first = titles.peek().filter(|(block, ..)| *block == 0);
        let title = first.map(|(.., title)| title.clone());
        let title = title.or(name);
        for (index, length) in lengths.into_iter().enumerate() {
            let rows: Vec<Row> = match several {
                true => rows.by_ref().take(length).collect(),
                false => std::mem::take(&mut rows).collect(),
            };
            let own = titles.next_if(|(block, ..)| *block == index);
            if let ([only], true) = (&rows[..], several) {
                self.skipped.push(only.line);
                self.skipped.extend(own.map(|(_, line, _)| line));
                continue;
            }
            let numbered = title.as_ref().map(|title| match index {
                0 => title.clone(),
                _ => format!("{title}, block {}", index + 1),
            });
            let may_be_airfoil = !is_on_earth && rows.len() <= MOST_OF_AIRFOIL;
            let order = told.or_else(|| {
                let rows = may_be_airfoil.then_some(&rows)?;
                let points: Vec<DVec3> = rows.iter().map(|row| row.point).collect();
                is_selig(&points).then_some(AirfoilOrder::Selig)
            });
            let own = own.map(|(.., title)| title);
            self.add(line, own.or(numbered), rows, is_on_earth)?;
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
        if lists.iter().any(|list| is_cut(&list.name)) {
            self.remarks.add(Remark::Drawn(CUT.to_owned()));
        }
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
        let Some(usual) = section.usual() else {
            return Ok(None);
        };
        let count = usual.count;
        let contents = section.contents(count);
        let names = self.names(section, &usual);
        let place = Place::line(names.as_ref().map_or(usual.first, |([line, _], _)| *line));
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
                    let places = self.numeric(&contents, usual.rows, named, weight.flatten());
                    places.map(Coordinates::of_lengths)
                };
                named_so.map_or_else(numeric, Ok)
            }
        };
        let coordinates = coordinates.map_err(|it| place.clone().problem(it))?;
        let places = coordinates.places.iter();
        let units = places.map(|place| contents.get(*place)?.unit.clone());
        let units: Vec<Option<String>> = units.collect();
        let taken = match coordinates.on_earth {
            Some(_) => self.take_unit(LengthUnit::Metre),
            None => self.take_units(named, &coordinates.places, &units),
        };
        taken.map_err(|it| place.problem(it))?;
        Ok(Some(Layout {
            count,
            rows: usual.rows,
            numeric: contents
                .iter()
                .rposition(|content| content.has_numbers())
                .map_or(0, |last| last + 1),
            named: names.as_ref().map_or(0, |(_, names)| names.count()),
            names: names.map(|(lines, _)| lines),
            coordinates,
            units,
            weight: weight.flatten(),
        }))
    }

    /// Find the line with the column names, and that with their units below it or the same: the last line of text above
    /// the first row, if it names x and y or, where that is no title, has as many fields as the rows.
    fn names(&self, section: &PointSection, usual: &Usual) -> Option<([usize; 2], ColumnNames)> {
        let (count, width) = (usual.count, usual.width);
        let above = section.fields().take_while(|(line, _)| *line < usual.first);
        let is_rule = |fields: &Fields| {
            fields
                .values
                .iter()
                .all(|it| !it.contains(char::is_alphanumeric))
        };
        let words = above.filter(|(_, fields)| {
            !fields.have_numbers(1) && !is_rule(fields) && !fields.lack_a_number()
        });
        let words: Vec<(usize, Fields)> = words.collect();
        let fits = |names: &ColumnNames| [count, width].contains(&names.count());
        // A title may stand below names of x and y, but no other names.
        let has_coordinates =
            |(_, fields): &(usize, Fields)| ColumnNames::of(fields).coordinates().is_some();
        let last = words.len().checked_sub(1)?;
        let above = words.iter().rposition(has_coordinates).filter(|place| {
            let below = words.get(place + 1..).unwrap_or_default();
            let mut below = below.iter().map(|(_, fields)| ColumnNames::of(fields));
            let names = ColumnNames::of(&words[*place].1);
            let next = words.get(place + 1);
            next.is_some_and(|(_, fields)| are_units(fields, &names)) || !below.any(|it| fits(&it))
        });
        let (line, fields) = &words[above.unwrap_or(last)];
        let names = ColumnNames::of(fields);
        let units = words.get(above.unwrap_or(last) + 1);
        let (line, names) = match units.filter(|(_, fields)| are_units(fields, &names)) {
            Some((below, units)) => ([*line, *below], names.with_units(units)),
            None => ([*line; 2], names),
        };
        // Words of a title are seldom divided by commas or semicolons.
        let is_title = match self.separator {
            _ if self.choice.is_some_and(ColumnChoice::has_names) => false,
            ' ' => count <= 3,
            '\t' => count == 2,
            _ => false,
        };
        // The last column of a spreadsheet may be empty in all rows.
        let fits = fits(&names);
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
        contents: &[Content],
        rows: usize,
        names: Option<&ColumnNames>,
        weight: Option<usize>,
    ) -> Result<Vec<usize>, Problem> {
        let is_named = |place: usize| {
            let name = names.and_then(|names| names.get(place));
            name.is_some_and(is_counter)
        };
        let columns_of_numbers = contents.iter().enumerate().filter(|(place, content)| {
            let counts = content.counter.is_some() && is_named(*place);
            let are_mostly = 2 * content.numbers > rows || content.unit.is_some();
            Some(*place) != weight && !counts && are_mostly
        });
        let places: Vec<usize> = columns_of_numbers.map(|(place, _)| place).collect();
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
    ) -> Result<Blocks, ReadError> {
        let mut blocks = Blocks {
            rows: Vec::with_capacity(layout.rows),
            ..Blocks::default()
        };
        let mut title_above: Option<(usize, String)> = None;
        let (mut lists, mut begin) = (self.lists.len(), 0);
        let mut text = TextAbove::default();
        for (line, fields) in section.split() {
            let Some(fields) = fields else {
                if blocks.is_open() {
                    lists += usize::from(blocks.rows.len() - begin > 1);
                    self.check_count(lists, line.number)?;
                    begin = blocks.rows.len();
                    blocks.end(title_above.take());
                } else {
                    blocks.keep_last_end();
                    text.divide();
                }
                continue;
            };
            let is_first = !blocks.is_open() && title_above.is_none();
            if is_first
                && layout.may_be_title(&fields)
                && let Some(title) = title(line.text)
            {
                self.tell_title(line.number, &fields, &title);
                title_above = Some((line.number, title));
                continue;
            }
            match layout.found(line.number, &fields, decimals) {
                Ok(Found::Row(row)) => blocks.rows.push(row),
                Ok(Found::TooLarge(text)) => {
                    let (_, lines) = self.too_large.get_or_insert((text, Vec::new()));
                    lines.push(line.number);
                }
                Ok(Found::Text) if layout.names.is_some_and(|it| it.contains(&line.number)) => {}
                Ok(Found::Text) if fields.lack_a_number() => self.skipped.push(line.number),
                Ok(Found::Text) => match title(line.text) {
                    Some(title) if is_first => {
                        text.begin(false);
                        self.tell_title(line.number, &fields, &title);
                        title_above = Some((line.number, title));
                    }
                    // Below rows the last text is the title, those before belong to what is above.
                    Some(title) if !blocks.is_open() && text.gives_way() => {
                        self.tell_title(line.number, &fields, &title);
                        let above = title_above.replace((line.number, title));
                        self.skipped.extend(above.map(|(line, _)| line));
                    }
                    Some(title) if blocks.rows.len() >= begin + LEAST_TITLED => {
                        text.begin(true);
                        lists += 1;
                        self.check_count(lists, line.number)?;
                        begin = blocks.rows.len();
                        blocks.end_at_text(title_above.replace((line.number, title)));
                    }
                    _ => self.skipped.push(line.number),
                },
                Err(problem) => return Err(Place::line(line.number).problem(problem)),
            }
        }
        match blocks.is_open() {
            true => blocks.end(title_above),
            false => {
                blocks.keep_last_end();
                self.skipped.extend(title_above.map(|(line, _)| line));
            }
        }
        blocks.drop_titles();
        self.skipped.extend(blocks.join_at_texts());
        Ok(blocks)
    }

    /// Tell a title that begins with a number, as a row does.
    fn tell_title(&mut self, line: usize, fields: &Fields, title: &str) {
        if fields.values.first().is_some_and(|it| is_number(it)) {
            let title = title.to_owned();
            self.remarks.add(Remark::Title { line, title });
        }
    }

    /// Bring an airfoil in Lednicer order into that around the section.
    fn in_order(&mut self, blocks: Blocks) -> (Blocks, Option<AirfoilOrder>) {
        let Blocks { rows, ends, .. } = &blocks;
        if rows.len() > MOST_OF_AIRFOIL {
            return (blocks, None);
        }
        let points: Vec<DVec3> = rows.iter().map(|row| row.point).collect();
        let is_same = |a: Row, b: Row| a.point == b.point;
        let (rows, order) = if let Some(sides) = lednicer(&points, ends) {
            if !sides.are_counted {
                self.remarks.add(Remark::Counts { line: rows[0].line });
            }
            let rows = around(&rows[1..], sides.split, is_same);
            (rows, AirfoilOrder::Lednicer)
        } else if let Some(sides) = uncounted(&points, ends) {
            if !sides.is_certain {
                let counts = [sides.split, rows.len() - sides.split];
                self.remarks.add(Remark::MaybeSides { counts });
                return (blocks, None);
            }
            let (rows, split) = upper_first(rows, sides.split, sides.is_upper_second);
            (around(&rows, split, is_same), AirfoilOrder::Uncounted)
        } else {
            return (blocks, None);
        };
        let mut titles = blocks.titles.into_iter();
        let title = titles.next().map(|(_, line, title)| (line, title));
        self.skipped.extend(titles.map(|(_, line, _)| line));
        let mut around = Blocks {
            rows,
            ..Blocks::default()
        };
        around.end(title);
        (around, Some(order))
    }

    /// Join blocks of one row each.
    fn joined(&mut self, mut blocks: Blocks) -> Blocks {
        if blocks.are_single() && !blocks.ends.is_empty() {
            blocks.ends = vec![blocks.rows.len()];
            let (first, others): (Vec<_>, Vec<_>) =
                blocks.titles.into_iter().partition(|it| it.0 == 0);
            blocks.titles = first;
            self.skipped
                .extend(others.into_iter().map(|(_, line, _)| line));
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
        let count = rows.len();
        rows.dedup_by(|row, before| {
            let is_repeated = row.point == before.point;
            repeated.extend(is_repeated.then_some(row.line));
            is_repeated
        });
        if rows.len() == 1 && count > 1 {
            let place = Place {
                line: Some(first),
                ..Place::reference(number, &name)
            };
            return Err(place.problem(Problem::OnePlace(count)));
        }
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
    /// Whether a line has more fields than the rows, the next of which is no number.
    fn has_text_behind(&self, fields: &Fields) -> bool {
        let most = self.count.max(self.named);
        fields.values.get(most).is_some_and(|text| !is_number(text))
    }

    /// Whether a line has the coordinates of a row and text behind them, where no names of columns tell what it is.
    fn may_be_title(&self, fields: &Fields) -> bool {
        let places = &mut self.coordinates.places.iter();
        self.names.is_none()
            && self.has_text_behind(fields)
            && places.all(|place| fields.values.get(*place).is_some_and(|it| is_number(it)))
    }

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
        let lacks_text = (self.numeric..self.count).contains(&length);
        if ![self.count, self.named].contains(&length)
            && !is_padded
            && !lacks_text
            && !self.has_text_behind(fields)
        {
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

/// Whether a column's name is one of a row's number.
fn is_counter(name: &str) -> bool {
    let name = name.trim_end_matches('.').to_lowercase();
    COUNTERS.contains(&name.as_str())
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
    title.contains(char::is_alphabetic).then(|| short(&title))
}

/// Whether a text above rows is read as their title.
pub(super) fn is_title(text: &str) -> bool {
    let fields = Fields::of(text, ' ');
    title(text).is_some_and(|title| title == text)
        && !text.starts_with('#')
        && !text.contains(char::is_control)
        && !fields.have_numbers(2)
        && ColumnNames::of(&fields).coordinates().is_none()
}
