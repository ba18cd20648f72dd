//! The instances of a Part 21 file: an index of where each one stands, and its parts on demand.

use std::cell::Cell;
use std::cmp::Reverse;

use super::tokens::{Params, Value, keyword, number_of, skip_space, skipped, split_list};
use crate::io::exchange::drawing::Unreadable;
use crate::io::exchange::remarks::Remarks;
use crate::io::exchange::spending::most_items;

/// The index of a file.
pub struct Instances<'a> {
    bytes: &'a [u8],
    /// In the order of the file.
    entries: Vec<Entry>,
    /// Places in `entries`, by rising number.
    by_id: Vec<u32>,
    /// Bytes that may still be looked at, so that entities that refer to each other many times end.
    work: Cell<u64>,
    /// Bytes that shapes may still take up.
    memory: Cell<u64>,
}

/// One instance: `#id=NAME(…)`, or `#id=(NAME(…)NAME(…))`.
#[derive(Clone, Copy)]
pub struct Instance<'a> {
    /// Its number.
    pub id: u64,
    /// Its line, from 1.
    pub line: u64,
    body: &'a [u8],
}

/// What finding an instance costs, in bytes of reading.
const LOOK_UP: u64 = 64;

struct Entry {
    id: u64,
    start: u32,
    end: u32,
    line: u32,
}

impl<'a> Instances<'a> {
    /// Find all instances of all data sections.
    pub fn index(bytes: &'a [u8], remarks: &mut Remarks) -> Result<Self, Unreadable> {
        if u32::try_from(bytes.len()).is_err() {
            return Err(unreadable("the file is longer than 4 GB"));
        }
        let Some(start) = data_start(bytes) else {
            return Err(unreadable(
                "no DATA section: this is no STEP file, or it is cut off in its header",
            ));
        };
        let entries = Scan::new(bytes, start, remarks).entries();
        let mut by_id: Vec<u32> = (0..).take(entries.len()).collect();
        let id_of = |place: &u32| entries.get(*place as usize).map(|entry: &Entry| entry.id);
        by_id.sort_by_key(id_of);
        for pair in by_id.windows(2) {
            if let [first, second] = pair
                && id_of(first) == id_of(second)
                && let Some(entry) = entries.get(*second as usize)
            {
                remarks.add_at(
                    entry.line.into(),
                    &format!("#{}", entry.id),
                    "its number is taken, skipped",
                );
            }
        }
        by_id.dedup_by_key(|place| id_of(place));
        Ok(Self {
            bytes,
            entries,
            by_id,
            work: Cell::new(256_000_000 + 16 * bytes.len() as u64),
            memory: Cell::new((7 * bytes.len() as u64).max(72 << 20)),
        })
    }

    /// How many items a drawing may have.
    pub fn most_items(&self) -> usize {
        most_items(self.bytes.len())
    }

    /// Look an instance up to read it.
    pub fn get(&self, id: u64) -> Option<Instance<'a>> {
        let instance = self.find(id)?;
        self.charge(instance.body.len() as u64 + LOOK_UP)
            .then_some(instance)
    }

    /// Look an instance up if it is of that name.
    pub fn get_if(&self, id: u64, name: &str) -> Option<Instance<'a>> {
        let is_simple = |it: &Instance| !it.body.starts_with(b"(");
        let cheap = self
            .find(id)
            .filter(is_simple)
            .is_some_and(|it| !it.is(name));
        if cheap {
            self.charge(LOOK_UP);
            return None;
        }
        self.get(id).filter(|it| it.is(name))
    }

    /// Whether there is an instance of that number.
    pub fn has(&self, id: u64) -> bool {
        self.find(id).is_some()
    }

    /// Look at all instances, in the order of the file.
    pub fn all(&self) -> impl Iterator<Item = Instance<'a>> {
        self.entries.iter().filter_map(|entry| self.instance(entry))
    }

    /// Pay for work; false when the file has used up what its length allows.
    pub fn charge(&self, cost: u64) -> bool {
        let left = self.work.get().saturating_sub(cost);
        self.work.set(left);
        left > 0
    }

    /// Pay for memory, if there is as much.
    pub fn spend(&self, bytes: usize) -> bool {
        let left = self.memory.get().checked_sub(bytes as u64);
        self.memory.set(left.unwrap_or(self.memory.get()));
        left.is_some()
    }

    /// Do something, and give back the memory that it has paid for.
    pub fn lending<T>(&self, read: impl FnOnce() -> T) -> T {
        let before = self.memory.get();
        let result = read();
        self.memory.set(before);
        result
    }

    /// Whether the file has used up the work that its length allows.
    pub fn is_exhausted(&self) -> bool {
        self.work.get() == 0
    }

    fn find(&self, id: u64) -> Option<Instance<'a>> {
        let id_of = |place: &u32| self.entries.get(*place as usize).map(|entry| entry.id);
        let found = self.by_id.binary_search_by_key(&Some(id), id_of);
        let place = self.by_id.get(found.ok()?)?;
        self.instance(self.entries.get(*place as usize)?)
    }

    fn instance(&self, entry: &Entry) -> Option<Instance<'a>> {
        Some(Instance {
            id: entry.id,
            line: entry.line.into(),
            body: self.bytes.get(entry.start as usize..entry.end as usize)?,
        })
    }
}

impl<'a> Instance<'a> {
    /// Take the name of its entity; of a complex instance the part that says most.
    pub fn name(&self) -> &'a str {
        let (name, _) = keyword(self.body);
        if !name.is_empty() {
            return name;
        }
        let rank = |name: &str| match name {
            "B_SPLINE_CURVE_WITH_KNOTS"
            | "BEZIER_CURVE"
            | "UNIFORM_CURVE"
            | "QUASI_UNIFORM_CURVE" => 3,
            "RATIONAL_B_SPLINE_CURVE" | "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION" => 2,
            "REPRESENTATION_ITEM" | "GEOMETRIC_REPRESENTATION_ITEM" | "CURVE" | "NAMED_UNIT" => 0,
            _ => 1,
        };
        let names = self.parts().map(|(name, _)| name);
        names.min_by_key(|name| Reverse(rank(name))).unwrap_or("")
    }

    /// Take the parameters of a part, or of the whole if it is a simple instance of that name.
    pub fn part(&self, name: &str) -> Option<Params<'a>> {
        self.parts()
            .find(|(own, _)| own.eq_ignore_ascii_case(name))
            .map(|(_, params)| params)
    }

    /// Take the parameters of a simple instance; empty for a complex one.
    pub fn params(&self) -> Params<'a> {
        let (name, rest) = keyword(self.body);
        let rest = skip_space(rest)
            .strip_prefix(b"(")
            .filter(|_| !name.is_empty());
        rest.map_or_else(Params::default, |rest| split_list(rest).0)
    }

    /// Take the first parameters of a representation item, name first. The parts of a complex instance leave
    /// the name to REPRESENTATION_ITEM: it is missing then.
    pub fn named_params<const N: usize>(&self, part: &str) -> [Value<'a>; N] {
        let mut simple = self.params();
        let mut complex = self.part(part).unwrap_or_default();
        let is_simple = simple.clone().next().is_some();
        std::array::from_fn(|place| {
            let value = match (is_simple, place) {
                (true, _) => simple.next(),
                (false, 0) => None,
                (false, _) => complex.next(),
            };
            value.unwrap_or(Value::Missing)
        })
    }

    /// Whether it is, or has, an entity of that name.
    pub fn is(&self, name: &str) -> bool {
        let (own, _) = keyword(self.body);
        if own.is_empty() {
            self.part(name).is_some()
        } else {
            own.eq_ignore_ascii_case(name)
        }
    }

    /// Look at its parts: one for a simple instance.
    pub fn parts(&self) -> impl Iterator<Item = (&'a str, Params<'a>)> + use<'a> {
        let mut rest = match self.body.strip_prefix(b"(") {
            Some(inside) => inside,
            None => self.body,
        };
        std::iter::from_fn(move || {
            let (name, tail) = keyword(skip_space(rest));
            let tail = skip_space(tail)
                .strip_prefix(b"(")
                .filter(|_| !name.is_empty())?;
            let (params, tail) = split_list(tail);
            rest = tail;
            Some((name, params))
        })
    }

    /// Look at all instances that it refers to, however deep in its lists.
    pub fn references(&self) -> impl Iterator<Item = u64> + use<'a> {
        let mut rest = self.body;
        std::iter::from_fn(move || {
            while let Some((byte, tail)) = rest.split_first() {
                rest = tail.get(skipped(*byte, tail)..).unwrap_or_default();
                if *byte == b'#'
                    && let Some((id, tail)) = number_of(rest)
                {
                    rest = tail;
                    return Some(id);
                }
            }
            None
        })
    }

    /// Take the name of a representation item: the first parameter, or that of its part REPRESENTATION_ITEM.
    pub fn label(&self) -> Option<&'a [u8]> {
        let params = self
            .part("REPRESENTATION_ITEM")
            .unwrap_or_else(|| self.params());
        match params.first::<1>() {
            [Value::Text(text)] if !text.trim_ascii().is_empty() => Some(text),
            _ => None,
        }
    }
}

/// The walk through the data sections.
struct Scan<'a, 'r> {
    bytes: &'a [u8],
    at: usize,
    /// The place up to which lines are counted, and the line there.
    counted: (usize, u32),
    newline: u8,
    remarks: &'r mut Remarks,
}

impl<'a, 'r> Scan<'a, 'r> {
    fn new(bytes: &'a [u8], at: usize, remarks: &'r mut Remarks) -> Self {
        let newline = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
        Self {
            bytes,
            at,
            counted: (0, 1),
            newline,
            remarks,
        }
    }

    fn entries(mut self) -> Vec<Entry> {
        let mut entries = Vec::new();
        let mut inside = true;
        loop {
            let rest = skip_space(self.rest());
            self.at = self.bytes.len() - rest.len();
            if rest.is_empty() {
                break;
            }
            let line = self.line();
            let (end, ended) = statement_end(rest);
            let statement = rest.get(..end).unwrap_or_default();
            if !ended {
                self.remarks
                    .add_at(line.into(), &head(statement), "no semicolon ends it");
            }
            let (word, _) = keyword(statement);
            match word {
                "ENDSEC" => inside = false,
                "DATA" => inside = true,
                "END-ISO-10303-21" => return entries,
                _ if !inside => {}
                _ => self.instance(statement, line, &mut entries),
            }
            self.at += end + usize::from(ended);
        }
        if inside {
            let line = self.line();
            self.remarks.add_at(
                line.into(),
                "ENDSEC",
                "it is missing: the file may be cut off",
            );
        }
        entries
    }

    fn instance(&mut self, statement: &[u8], line: u32, entries: &mut Vec<Entry>) {
        let Some((id, body)) = instance_head(statement) else {
            if !statement.is_empty() {
                self.remarks
                    .add_at(line.into(), &head(statement), "no instance, skipped");
            }
            return;
        };
        if !matches!(
            body.first(),
            Some(b'(' | b'!' | b'_' | b'A'..=b'Z' | b'a'..=b'z')
        ) {
            self.remarks.add_at(
                line.into(),
                &format!("#{id}"),
                "no entity follows its number, skipped",
            );
            return;
        }
        let end = self.at + statement.len();
        if let (Ok(start), Ok(end)) = (u32::try_from(end - body.len()), u32::try_from(end)) {
            entries.push(Entry {
                id,
                start,
                end,
                line,
            });
        }
    }

    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    fn line(&mut self) -> u32 {
        let (from, line) = self.counted;
        let passed = self.bytes.get(from..self.at).unwrap_or_default();
        let lines = passed.iter().filter(|byte| **byte == self.newline).count();
        self.counted = (
            self.at,
            line.saturating_add(u32::try_from(lines).unwrap_or(u32::MAX)),
        );
        self.counted.1
    }
}

fn unreadable(reason: &str) -> Unreadable {
    Unreadable {
        at: None,
        reason: reason.to_owned(),
    }
}

/// Find the place after `DATA;`, not taking those words within strings; or, if a string of the header has no
/// end, after the first line that begins so.
fn data_start(bytes: &[u8]) -> Option<usize> {
    let mut at = 0;
    while let Some(byte) = bytes.get(at) {
        let rest = bytes.get(at..).unwrap_or_default();
        if byte.is_ascii_alphabetic() {
            let (word, tail) = keyword(rest);
            if word == "DATA" && opens_data(tail) {
                return Some(bytes.len() - tail.len() + statement_end(tail).0 + 1);
            }
            at += word.len().max(1);
        } else {
            at += 1 + skipped(*byte, bytes.get(at + 1..).unwrap_or_default());
        }
    }
    let pieces = |byte: &u8| matches!(byte, b'\n' | b'\r');
    let mut at = 0;
    for line in bytes.split(pieces) {
        if line
            .strip_prefix(b"DATA")
            .is_some_and(|tail| skip_space(tail).starts_with(b";"))
        {
            return Some(at + 4);
        }
        at += line.len() + 1;
    }
    None
}

fn opens_data(tail: &[u8]) -> bool {
    let tail = skip_space(tail);
    match tail.strip_prefix(b"(") {
        Some(tail) => skip_space(split_list(tail).1).starts_with(b";"),
        None => tail.starts_with(b";"),
    }
}

/// Find the semicolon of a statement. A line that begins as an instance does ends the one before it, so that
/// one lost quote or semicolon does not lose the rest of the file.
fn statement_end(bytes: &[u8]) -> (usize, bool) {
    let mut at = 0;
    let mut string = None;
    while let Some(byte) = bytes.get(at) {
        match (byte, string) {
            (b'\n' | b'\r', _)
                if instance_head(bytes.get(at + 1..).unwrap_or_default()).is_some() =>
            {
                return (at, false);
            }
            (quote, Some(open)) if *quote == open => string = None,
            (_, Some(_)) => {}
            (b';', None) => return (at, true),
            (b'\'' | b'"', None) => string = Some(*byte),
            (b'/', None) => at += skipped(b'/', bytes.get(at + 1..).unwrap_or_default()),
            _ => {}
        }
        at += 1;
    }
    (bytes.len(), false)
}

fn instance_head(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let (id, rest) = number_of(bytes.strip_prefix(b"#")?)?;
    Some((id, skip_space(skip_space(rest).strip_prefix(b"=")?)))
}

fn head(statement: &[u8]) -> String {
    String::from_utf8_lossy(statement.get(..statement.len().min(20)).unwrap_or_default())
        .trim()
        .to_owned()
}
