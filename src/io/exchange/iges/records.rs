//! Records of a file: lines of 80 columns, the section's letter in column 73.

use crate::io::exchange::drawing::Unreadable;

/// Columns before the section's letter.
const BODY: usize = 72;

/// Remarks on lines without a section: a damaged file would otherwise give one a line.
const STRAY_REMARKS: usize = 20;

/// One line of the directory or parameter section.
#[derive(Clone, Copy)]
pub(super) struct Record<'a> {
    /// The columns before the section's letter.
    pub text: &'a [u8],
    /// The sequence number, if there is one.
    pub number: Option<u32>,
    /// The line in the file, from 1.
    pub line: u64,
}

impl<'a> Record<'a> {
    /// Give a field of eight columns, from 0, without blanks around it.
    pub fn field(&self, index: usize) -> &'a [u8] {
        let start = index.saturating_mul(8).min(self.text.len());
        let end = start.saturating_add(8).min(self.text.len());
        self.text.get(start..end).unwrap_or_default().trim_ascii()
    }
}

/// The lines of a file by section.
#[derive(Default)]
pub(super) struct Records<'a> {
    /// The text of the global section.
    pub global: Vec<u8>,
    pub directory: Vec<Record<'a>>,
    pub parameters: Vec<Record<'a>>,
    /// The counts of the terminate section.
    pub terminate: Option<Record<'a>>,
    pub remarks: Vec<String>,
    /// Whether the first line is the flag of compressed files.
    is_flagged: bool,
    /// Lines without a section.
    stray: usize,
}

impl<'a> Records<'a> {
    /// Sort the lines of a file by section.
    ///
    /// # Errors
    /// [`Unreadable`] for binary and compressed files, and where there is no directory.
    pub fn read(bytes: &'a [u8]) -> Result<Self, Unreadable> {
        let mut records = Self::default();
        for (index, line) in lines(bytes).enumerate() {
            let at = u64::try_from(index).unwrap_or(u64::MAX).saturating_add(1);
            if records.add(line, at)? {
                break;
            }
        }
        records.finish()
    }

    /// Add a line; `true` after the last one.
    fn add(&mut self, line: &'a [u8], at: u64) -> Result<bool, Unreadable> {
        let Some((letter, text, number)) = section(line) else {
            self.add_stray(line, at);
            return Ok(false);
        };
        let record = Record {
            text,
            number,
            line: at,
        };
        match letter {
            b'G' => {
                let padded = std::iter::repeat_n(b' ', BODY.saturating_sub(text.len()));
                self.global.extend(text.iter().copied().chain(padded));
            }
            b'D' => self.directory.push(record),
            b'P' => self.parameters.push(record),
            b'T' => {
                self.terminate = Some(record);
                return Ok(true);
            }
            b'C' => self.is_flagged = true,
            b'B' if at == 1 => {
                return Err(unreadable(
                    at,
                    "binary IGES; save it as IGES in fixed ASCII",
                ));
            }
            _ => {}
        }
        Ok(false)
    }

    fn add_stray(&mut self, line: &[u8], at: u64) {
        if line.trim_ascii().is_empty() {
            return;
        }
        self.stray = self.stray.saturating_add(1);
        if self.stray <= STRAY_REMARKS {
            self.remarks.push(format!(
                "line {at}: no section letter in column 73; the line is skipped"
            ));
        }
    }

    fn finish(mut self) -> Result<Self, Unreadable> {
        if self.directory.is_empty() {
            return Err(if self.is_flagged {
                unreadable(1, "compressed IGES; save it as IGES in fixed ASCII")
            } else {
                unreadable(
                    1,
                    "no directory section; this is no IGES file in fixed ASCII",
                )
            });
        }
        let untold = self.stray.saturating_sub(STRAY_REMARKS);
        if untold > 0 {
            self.remarks.push(format!(
                "{untold} more lines without a section letter are skipped"
            ));
        }
        match self.terminate {
            None => self
                .remarks
                .push("the terminate section is missing: the file is cut off".to_owned()),
            Some(record) => self.compare_counts(record),
        }
        Ok(self)
    }

    /// Compare the counts of the terminate section (`S      1G      2D      2P     11`) with the lines found.
    fn compare_counts(&mut self, record: Record) {
        for (index, name, found) in [
            (2, "directory", self.directory.len()),
            (3, "parameter", self.parameters.len()),
        ] {
            let digits = record.field(index);
            let count = digits.get(1..).and_then(whole::<usize>);
            if let Some(count) = count.filter(|count| *count != found) {
                self.remarks.push(format!(
                    "line {}: the terminate section counts {count} {name} lines, the file has {found}",
                    record.line
                ));
            }
        }
    }
}

/// Read a whole number with blanks around it.
pub(super) fn whole<T: std::str::FromStr>(digits: &[u8]) -> Option<T> {
    std::str::from_utf8(digits.trim_ascii()).ok()?.parse().ok()
}

/// Say why nothing can be read.
pub(super) fn unreadable(line: u64, reason: &str) -> Unreadable {
    Unreadable {
        at: Some(line),
        reason: reason.to_owned(),
    }
}

/// Split at line ends; a file without any is a row of 80-byte records.
fn lines(bytes: &[u8]) -> Box<dyn Iterator<Item = &[u8]> + '_> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if bytes.contains(&b'\n') {
        let split = bytes.split(|byte| *byte == b'\n');
        Box::new(split.map(|line| line.strip_suffix(b"\r").unwrap_or(line)))
    } else if bytes.contains(&b'\r') {
        Box::new(bytes.split(|byte| *byte == b'\r'))
    } else {
        Box::new(bytes.chunks(80))
    }
}

/// The section's letter, the columns before it and the sequence number.
fn section(line: &[u8]) -> Option<(u8, &[u8], Option<u32>)> {
    let at_column = |column: usize| {
        let letter = *line.get(column)?;
        let digits = line.get(column.checked_add(1)?..)?;
        let is_number = digits
            .iter()
            .all(|byte| byte.is_ascii_digit() || *byte == b' ');
        let is_section = b"SGDPTCB".contains(&letter) && is_number;
        is_section.then(|| {
            (
                letter,
                line.get(..column).unwrap_or_default(),
                whole(digits),
            )
        })
    };
    // Some writers count characters, not bytes, or lose a blank: the number still ends the line.
    let from_end = || at_column(line.trim_ascii_end().len().checked_sub(8)?);
    at_column(BODY).or_else(from_end)
}
