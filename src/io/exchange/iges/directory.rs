//! The directory: two lines for each entity.

use std::collections::HashMap;
use std::ops::Range;

use super::records::{Record, Records, whole};

/// Remarks on damaged entries: each is one line of a file that may have millions.
const REMARKS: usize = 50;

/// An entity's entry.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Entry {
    /// The sequence number of its first line, by which others refer to it.
    pub number: u32,
    /// The entity type.
    pub entity: u32,
    pub form: i32,
    /// The level; a pointer to levels if negative.
    pub level: i32,
    /// The transformation's number, or 0.
    pub matrix: u32,
    /// Status digits 1–2 are 01.
    pub is_hidden: bool,
    /// Status digits 3–4.
    pub subordinate: u8,
    /// Status digits 5–6.
    pub usage: u8,
    /// The colour number; a pointer to a colour if negative.
    pub colour: i32,
    pub label: Option<String>,
    /// The line in the file, from 1.
    pub line: u64,
    /// Which parameter lines are its own.
    pub parameters: Range<u32>,
}

/// All entries in the file's order.
#[derive(Default)]
pub(super) struct Directory {
    pub entries: Vec<Entry>,
    pub remarks: Vec<String>,
    by_number: HashMap<u32, u32>,
    /// Remarks beyond the limit.
    untold: usize,
}

impl Directory {
    /// Pair the directory's lines and find the parameter lines of each entry.
    pub fn read(records: &Records) -> Self {
        let mut directory = Self::default();
        let mut lines = Lines::of(&records.parameters);
        let mut expected: u32 = 1;
        let mut rest = records.directory.as_slice();
        while let Some((first, after)) = rest.split_first() {
            let number = first.number.unwrap_or(expected);
            expected = number.saturating_add(1);
            rest = after;
            let second = after
                .first()
                .filter(|second| second.number.is_none_or(|it| it == expected));
            match second {
                Some(second) if number % 2 == 1 => {
                    expected = number.saturating_add(2);
                    rest = after.get(1..).unwrap_or_default();
                    directory.add(number, first, second, &mut lines);
                }
                _ => directory.remark(first.line, "directory line without its pair; skipped"),
            }
        }
        if directory.untold > 0 {
            let count = directory.untold;
            directory
                .remarks
                .push(format!("{count} more remarks on the directory"));
        }
        directory
    }

    /// Find the entry that a pointer names.
    pub fn find(&self, number: u32) -> Option<&Entry> {
        let index = *self.by_number.get(&number)?;
        self.entries.get(usize::try_from(index).ok()?)
    }

    fn add(&mut self, number: u32, first: &Record, second: &Record, lines: &mut Lines) {
        let Some(entity) = whole::<u32>(first.field(0)) else {
            self.remark(
                first.line,
                "directory entry without an entity type; skipped",
            );
            return;
        };
        let status = status(first.field(8));
        let mut entry = Entry {
            number,
            entity,
            form: whole(second.field(4)).unwrap_or_default(),
            level: whole(first.field(4)).unwrap_or_default(),
            matrix: whole(first.field(6)).unwrap_or_default(),
            is_hidden: status[0] != 0,
            subordinate: status[1],
            usage: status[2],
            colour: whole(second.field(2)).unwrap_or_default(),
            label: label(second),
            line: first.line,
            parameters: 0..0,
        };
        let pointer: Option<u32> = whole(first.field(1));
        let count: u32 = whole(second.field(3)).unwrap_or_default();
        match pointer
            .ok_or("no parameter data")
            .and_then(|it| lines.claim(number, it, count))
        {
            Ok(range) => entry.parameters = range,
            // The null entity stands for a deleted one.
            Err(_) if entity == 0 => {}
            Err(reason) => self.remark(first.line, &format!("type {entity}: {reason}")),
        }
        let index = u32::try_from(self.entries.len()).unwrap_or(u32::MAX);
        if *self.by_number.entry(number).or_insert(index) != index {
            self.remark(
                first.line,
                &format!("type {entity}: a second entry D{number}"),
            );
        }
        self.entries.push(entry);
    }

    fn remark(&mut self, line: u64, reason: &str) {
        if self.remarks.len() < REMARKS {
            self.remarks.push(format!("line {line}: {reason}"));
        } else {
            self.untold = self.untold.saturating_add(1);
        }
    }
}

/// Which entry owns each parameter line: no line serves two, so that reading all of them takes linear time.
struct Lines<'a, 'b> {
    records: &'b [Record<'a>],
    by_number: HashMap<u32, u32>,
    is_claimed: Vec<bool>,
}

impl<'a, 'b> Lines<'a, 'b> {
    fn of(records: &'b [Record<'a>]) -> Self {
        let mut by_number = HashMap::with_capacity(records.len());
        for (index, record) in (0_u32..).zip(records) {
            let number = record.number.unwrap_or_else(|| index.saturating_add(1));
            by_number.entry(number).or_insert(index);
        }
        Self {
            records,
            by_number,
            is_claimed: vec![false; records.len()],
        }
    }

    /// Claim the lines of an entry: those that name it, or as many as it counts where none names an entry.
    fn claim(&mut self, entry: u32, pointer: u32, count: u32) -> Result<Range<u32>, &'static str> {
        let first = *self
            .by_number
            .get(&pointer)
            .ok_or("its parameter line is missing")?;
        let start = usize::try_from(first).map_err(|_| "its parameter line is missing")?;
        let is_named = self.owner(start) == Some(entry);
        let limit = if is_named {
            usize::MAX
        } else {
            usize::try_from(count).unwrap_or(0)
        };
        let mut end = start;
        while end < self.records.len() && end.saturating_sub(start) < limit {
            if is_named && self.owner(end) != Some(entry) {
                break;
            }
            match self.is_claimed.get_mut(end) {
                Some(claimed) if !*claimed => *claimed = true,
                _ => break,
            }
            end = end.saturating_add(1);
        }
        if end == start {
            return Err("its parameter lines belong to another entity");
        }
        Ok(first..u32::try_from(end).unwrap_or(u32::MAX))
    }

    /// The entry that a parameter line names in columns 65–72.
    fn owner(&self, index: usize) -> Option<u32> {
        whole(self.records.get(index)?.field(8))
    }
}

/// The first three pairs of status digits; blanks stand for zeros.
fn status(field: &[u8]) -> [u8; 3] {
    let padding = 8_usize.saturating_sub(field.len());
    let digits = std::iter::repeat_n(&b' ', padding).chain(field);
    let mut pairs = [0_u8; 3];
    for (index, digit) in digits.take(6).enumerate() {
        let value = digit.saturating_sub(b'0').min(9);
        if let Some(pair) = pairs.get_mut(index / 2) {
            *pair = pair.saturating_mul(10).saturating_add(value);
        }
    }
    pairs
}

/// The label of eight characters and its number.
fn label(second: &Record) -> Option<String> {
    let label = second.field(7);
    if label.is_empty() {
        return None;
    }
    let text = String::from_utf8_lossy(label);
    Some(match whole::<u32>(second.field(8)) {
        Some(subscript) if subscript > 0 => format!("{text} {subscript}"),
        _ => text.into_owned(),
    })
}
