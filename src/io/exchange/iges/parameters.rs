//! Free-format parameters: fields between delimiters, with Hollerith strings (`5Hnames`).

use glam::DVec3;

use super::records::whole;
use crate::io::exchange::short_names::{beginning, short};

/// The two delimiters of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Delimiters {
    /// Between parameters.
    pub parameter: u8,
    /// After the last parameter.
    pub record: u8,
}

impl Default for Delimiters {
    fn default() -> Self {
        Self {
            parameter: b',',
            record: b';',
        }
    }
}

/// The parameters of one entity, from 0: its type.
///
/// Fields are kept as ranges of the text: files may hold millions of empty ones.
#[derive(Default)]
pub(super) struct Parameters {
    text: Vec<u8>,
    fields: Vec<(u32, u32)>,
    is_complete: bool,
}

impl Parameters {
    /// Split a text up to the record delimiter.
    pub fn split(text: Vec<u8>, delimiters: Delimiters) -> Self {
        let is_delimiter = |byte: &u8| *byte == delimiters.parameter || *byte == delimiters.record;
        let count = text.iter().filter(|byte| is_delimiter(byte)).count();
        let mut fields = Vec::with_capacity(count.saturating_add(1));
        let mut is_complete = false;
        let mut rest = text.as_slice();
        let position =
            |rest: &[u8]| u32::try_from(text.len().saturating_sub(rest.len())).unwrap_or(u32::MAX);
        loop {
            rest = rest.trim_ascii_start();
            let start = position(rest);
            rest = rest
                .get(hollerith(rest).map_or(0, |(_, end)| end)..)
                .unwrap_or_default();
            let length = rest.iter().position(is_delimiter).unwrap_or(rest.len());
            rest = rest.get(length..).unwrap_or_default();
            let end = position(rest);
            let Some((delimiter, next)) = rest.split_first() else {
                if end > start {
                    fields.push((start, end));
                }
                break;
            };
            fields.push((start, end));
            rest = next;
            if *delimiter == delimiters.record {
                is_complete = true;
                break;
            }
        }
        Self {
            text,
            fields,
            is_complete,
        }
    }

    /// Count the parameters, with the type.
    pub fn len(&self) -> usize {
        self.fields.len()
    }

    /// Say whether the record delimiter was found.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// Read a number; an empty field is 0.
    ///
    /// # Errors
    /// A reason if it is missing, is no number or is infinite.
    pub fn number(&self, index: usize) -> Result<f64, String> {
        let field = self
            .field(index)
            .ok_or_else(|| format!("parameter {index} is missing"))?;
        let value = if field.is_empty() {
            Some(0.0)
        } else {
            real(field)
        };
        let value = value.ok_or_else(|| {
            let text: String = String::from_utf8_lossy(field).chars().take(20).collect();
            format!("parameter {index} (\"{text}\") is no number")
        })?;
        if value.is_finite() {
            Ok(value)
        } else {
            Err(format!("parameter {index} is not finite"))
        }
    }

    /// Read three numbers.
    ///
    /// # Errors
    /// As [`Self::number`].
    pub fn point(&self, index: usize) -> Result<DVec3, String> {
        Ok(DVec3::new(
            self.number(index)?,
            self.number(index.saturating_add(1))?,
            self.number(index.saturating_add(2))?,
        ))
    }

    /// Read a whole number; an empty field is 0.
    ///
    /// # Errors
    /// As [`Self::number`], and where there is a fraction.
    pub fn integer(&self, index: usize) -> Result<i64, String> {
        if let Some(value) = self.field(index).and_then(whole::<i64>) {
            return Ok(value);
        }
        let value = self.number(index)?;
        // Beyond 2⁵³ a double does not tell whole numbers apart.
        if value.fract() == 0.0 && value.abs() < 9.0e15 {
            Ok(value as i64)
        } else {
            Err(format!("parameter {index} is no whole number"))
        }
    }

    /// Read a count of things that follow: there is at least one parameter for each.
    ///
    /// # Errors
    /// As [`Self::integer`], and where fewer parameters follow.
    pub fn count(&self, index: usize) -> Result<usize, String> {
        let value = self.integer(index)?;
        let left = self.len().saturating_sub(index);
        usize::try_from(value)
            .ok()
            .filter(|count| *count <= left)
            .ok_or_else(|| {
                format!("parameter {index} counts {value}, but {left} parameters follow")
            })
    }

    /// Read a pointer to a directory entry; `None` for the null pointer.
    pub fn pointer(&self, index: usize) -> Option<u32> {
        let value = self.integer(index).ok()?.unsigned_abs();
        u32::try_from(value).ok().filter(|number| *number > 0)
    }

    /// Read a list of pointers after their count, without null pointers.
    ///
    /// # Errors
    /// As [`Self::count`].
    pub fn pointers(&self, count_at: usize) -> Result<Vec<u32>, String> {
        let first = count_at.saturating_add(1);
        let end = first.saturating_add(self.count(count_at)?).min(self.len());
        Ok((first..end)
            .filter_map(|index| self.pointer(index))
            .collect())
    }

    /// Give the pointers to properties, which follow the entity's own `used` parameters and those to notes.
    pub fn properties(&self, used: usize) -> Vec<u32> {
        let Ok(notes) = self.count(used) else {
            return Vec::new();
        };
        self.pointers(used.saturating_add(notes).saturating_add(1))
            .unwrap_or_default()
    }

    /// Read a text.
    pub fn text(&self, index: usize) -> Option<String> {
        let field = self.field(index)?;
        let (start, end) = hollerith(field)?;
        let bytes = beginning(field.get(start..end.min(field.len()))?.trim_ascii());
        // Older programs write Latin-1.
        let text = std::str::from_utf8(bytes).map_or_else(
            |_| bytes.iter().map(|byte| char::from(*byte)).collect(),
            str::to_owned,
        );
        (!text.is_empty()).then(|| short(&text))
    }

    /// Give a field without the blanks around it.
    pub fn field(&self, index: usize) -> Option<&[u8]> {
        let (start, end) = *self.fields.get(index)?;
        let range = usize::try_from(start).ok()?..usize::try_from(end).ok()?;
        Some(self.text.get(range)?.trim_ascii())
    }
}

/// The range of the characters of a Hollerith string at the start of a text; its end may lie behind the text.
pub(super) fn hollerith(text: &[u8]) -> Option<(usize, usize)> {
    let digits = text
        .iter()
        .take(9)
        .take_while(|byte| byte.is_ascii_digit())
        .count();
    let count: usize = whole(text.get(..digits)?)?;
    let start = digits.checked_add(1)?;
    (*text.get(digits)? == b'H').then(|| (start, start.saturating_add(count)))
}

/// Read a number as Fortran writes it: `1.`, `-.5E3`, `1.D-03`.
fn real(field: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(field).ok()?;
    // Rust would take "inf" and "nan" as numbers.
    let is_number = text
        .bytes()
        .all(|byte| byte.is_ascii_digit() || b"+-.eEdD".contains(&byte));
    if !is_number {
        return None;
    }
    text.parse()
        .or_else(|_| text.replace(['d', 'D'], "e").parse())
        .ok()
}
