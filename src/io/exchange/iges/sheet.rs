//! The lines of a file that is written: directory entries and their parameters.

use crate::io::exchange::drawing::Unreadable;

/// Columns of a parameter line before the pointer to its entry.
const COLUMNS: usize = 64;

/// The most lines of a section: sequence numbers have seven digits.
const LINES: usize = 9_999_999;

/// An entity to be written.
#[derive(Default)]
pub(super) struct Entity {
    /// The entity type.
    pub entity: u32,
    pub form: u32,
    pub level: usize,
    /// The transformation's number, or 0.
    pub matrix: usize,
    /// The eight status digits.
    pub status: &'static str,
    /// The colour number, or a pointer to a colour as a negative number.
    pub colour: i64,
    /// The parameters after the type.
    pub parameters: Vec<String>,
}

/// The directory and parameter sections.
#[derive(Default)]
pub(super) struct Sheet {
    directory: Vec<u8>,
    parameters: Vec<u8>,
    entities: usize,
    lines: usize,
}

impl Sheet {
    /// Give the number that the next entity gets.
    pub fn next(&self) -> usize {
        self.entities * 2 + 1
    }

    /// Add an entity and give its number.
    pub fn add(&mut self, entity: Entity) -> usize {
        let number = self.next();
        let first_line = self.lines + 1;
        let fields = std::iter::once(entity.entity.to_string()).chain(entity.parameters);
        for line in wrapped(fields, COLUMNS) {
            self.lines += 1;
            self.parameters.extend_from_slice(&line);
            self.parameters
                .extend(std::iter::repeat_n(b' ', COLUMNS - line.len()));
            self.parameters
                .extend(format!("{number:>8}P{:>7}\n", self.lines).into_bytes());
        }
        let Entity {
            entity: kind,
            form,
            level,
            matrix,
            status,
            colour,
            ..
        } = entity;
        let count = self.lines + 1 - first_line;
        let first = format!(
            "{kind:>8}{first_line:>8}{:>8}{:>8}{level:>8}{:>8}{matrix:>8}{:>8}{status:>8}D{number:>7}\n",
            0, 0, 0, 0
        );
        let second = format!(
            "{kind:>8}{:>8}{colour:>8}{count:>8}{form:>8}{:>32}D{:>7}\n",
            0,
            "0",
            number + 1
        );
        self.directory.extend(first.into_bytes());
        self.directory.extend(second.into_bytes());
        self.entities += 1;
        number
    }

    /// Give the file, with the fields of its global section.
    ///
    /// # Errors
    /// [`Unreadable`] if a section has too many lines.
    pub fn finish(self, global: Vec<String>) -> Result<Vec<u8>, Unreadable> {
        if self.lines > LINES || self.entities * 2 > LINES {
            return Err(Unreadable {
                at: None,
                reason: "the drawing needs more lines than an IGES file can number".to_owned(),
            });
        }
        let mut file = format!("{:<72}S{:>7}\n", "", 1).into_bytes();
        let mut count = 0;
        for line in wrapped(global.into_iter(), 72) {
            count += 1;
            file.extend_from_slice(&line);
            file.extend(std::iter::repeat_n(b' ', 72 - line.len()));
            file.extend(format!("G{count:>7}\n").into_bytes());
        }
        file.extend(self.directory);
        file.extend(self.parameters);
        let counts = format!(
            "S{:>7}G{count:>7}D{:>7}P{:>7}",
            1,
            self.entities * 2,
            self.lines
        );
        file.extend(format!("{counts:<72}T{:>7}\n", 1).into_bytes());
        Ok(file)
    }
}

/// Write a number so that reading it gives the same double, with the decimal point that marks reals.
pub(super) fn real(value: f64) -> String {
    let text = format!("{value:?}");
    match text.split_once('e') {
        Some((mantissa, exponent)) if mantissa.contains('.') => format!("{mantissa}E{exponent}"),
        Some((mantissa, exponent)) => format!("{mantissa}.E{exponent}"),
        None => text
            .strip_suffix('0')
            .filter(|text| text.ends_with('.'))
            .unwrap_or(&text)
            .to_owned(),
    }
}

/// Write a text as a Hollerith string, which counts bytes; line ends and such become blanks.
pub(super) fn hollerith(text: &str) -> String {
    let text = text.replace(char::is_control, " ");
    if text.is_empty() {
        return text;
    }
    format!("{}H{text}", text.len())
}

/// Break fields into lines: between fields, and within a text where it is longer than a line.
fn wrapped(fields: impl Iterator<Item = String>, columns: usize) -> Vec<Vec<u8>> {
    let mut lines = Vec::new();
    let mut line: Vec<u8> = Vec::new();
    let mut fields = fields.peekable();
    while let Some(field) = fields.next() {
        let mut bytes = field.into_bytes();
        bytes.push(if fields.peek().is_some() { b',' } else { b';' });
        if line.len() + bytes.len() > columns && !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for chunk in bytes.chunks(columns) {
            if line.len() == columns {
                lines.push(std::mem::take(&mut line));
            }
            line.extend_from_slice(chunk);
        }
    }
    lines.push(line);
    lines
}
