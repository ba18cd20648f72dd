//! The groups of a file, a code and a value each: pairs of lines, or bytes.

use crate::io::exchange::drawing::Unreadable;

/// The first bytes of a binary file.
const BINARY: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";
/// The same after a transfer that took the file for text.
const BINARY_TRANSFERRED: &[u8] = b"AutoCAD Binary DXF\n\x1a\0";
/// The most bytes of a damaged line that a remark quotes.
const QUOTED: usize = 24;
/// The greatest group code.
const LAST_CODE: i32 = 1071;

/// Something wrong at a place of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// The line or the byte, from 1.
    pub at: u64,
    /// What is wrong, without a full stop.
    pub reason: String,
}

/// The value of a group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'a> {
    /// A string, or in a text file any value, as it stands.
    Text(&'a [u8]),
    /// A number of a binary file.
    Real(f64),
    /// A whole number of a binary file.
    Integer(i64),
}

/// A code and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Group<'a> {
    /// What the value means.
    pub code: i32,
    /// The value.
    pub value: Value<'a>,
    /// The line of the value or the byte of the code, from 1.
    pub at: u64,
}

/// A cursor over groups.
///
/// It goes on after damage: at the next entity of a text file, at the end of a binary one.
#[derive(Clone, Debug)]
pub struct Groups<'a> {
    form: Form,
    /// The file up to where the cursor ends.
    bytes: &'a [u8],
    position: usize,
    /// The lines before the position, in a text file.
    lines: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Text,
    /// Binary, with codes of one byte (R12).
    Short,
    /// Binary, with codes of two bytes.
    Long,
}

impl<'a> Value<'a> {
    /// Take a number, finite or not.
    pub fn real(self) -> Option<f64> {
        match self {
            Self::Text(text) => std::str::from_utf8(text.trim_ascii()).ok()?.parse().ok(),
            Self::Real(real) => Some(real),
            Self::Integer(integer) => Some(integer as f64),
        }
    }

    /// Take a whole number, also from what some programs write as one: 1.0.
    pub fn integer(self) -> Option<i64> {
        let whole = |real: f64| (real.fract() == 0.0 && real.abs() < 1e15).then_some(real as i64);
        match self {
            Self::Text(text) => {
                let text = std::str::from_utf8(text.trim_ascii()).ok()?;
                text.parse().ok().or_else(|| whole(text.parse().ok()?))
            }
            Self::Real(real) => whole(real),
            Self::Integer(integer) => Some(integer),
        }
    }

    /// Take a string without the spaces around it; of a binary number nothing.
    pub fn text(self) -> &'a [u8] {
        match self {
            Self::Text(text) => text.trim_ascii(),
            _ => b"",
        }
    }

    /// Take a string for remarks.
    pub fn quoted(self) -> String {
        match self {
            Self::Text(text) => quoted(text),
            Self::Real(real) => format!("{real}"),
            Self::Integer(integer) => format!("{integer}"),
        }
    }
}

impl<'a> Groups<'a> {
    /// Start at the first group of a file.
    ///
    /// # Errors
    /// [`Unreadable`] for other formats by their names, and for what is no DXF file.
    pub fn of(bytes: &'a [u8]) -> Result<Self, Unreadable> {
        if let Some(reason) = refused(bytes) {
            return Err(Unreadable { at: None, reason });
        }
        let binary = [BINARY, BINARY_TRANSFERRED];
        let binary = binary.iter().find(|start| bytes.starts_with(start));
        if let Some(start) = binary {
            let position = start.len();
            let form = binary_form(bytes.get(position..).unwrap_or_default());
            return Ok(Self {
                form,
                bytes,
                position,
                lines: 0,
            });
        }
        let position = if bytes.starts_with(b"\xef\xbb\xbf") {
            3
        } else {
            0
        };
        let groups = Self {
            form: Form::Text,
            bytes,
            position,
            lines: 0,
        };
        groups.checked()
    }

    /// Whether places are lines, not bytes.
    pub fn counts_lines(&self) -> bool {
        self.form == Form::Text
    }

    /// The place of the cursor: the next line or byte, from 1.
    pub fn at(&self) -> u64 {
        match self.form {
            Form::Text => self.lines + 1,
            _ => self.position as u64 + 1,
        }
    }

    /// End where another cursor stands.
    pub fn until(&self, end: &Self) -> Self {
        let bytes = self.bytes.get(..end.position).unwrap_or(self.bytes);
        Self {
            bytes,
            ..self.clone()
        }
    }

    /// Whether something but space follows.
    pub fn is_followed(&self) -> bool {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        rest.iter()
            .any(|byte| !byte.is_ascii_whitespace() && !matches!(byte, 0 | 0x1a))
    }

    /// All bytes of the file, up to where the cursor ends.
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    fn checked(self) -> Result<Self, Unreadable> {
        let mut probe = self.clone();
        match probe.filled_line() {
            None => Err(Unreadable {
                at: None,
                reason: "the file is empty".to_owned(),
            }),
            Some(line) if code(line).is_none() => Err(Unreadable {
                at: Some(probe.lines),
                reason: format!("{} is no group code: this is no DXF file", quoted(line)),
            }),
            Some(_) => Ok(self),
        }
    }

    fn line(&mut self) -> Option<&'a [u8]> {
        let rest = self
            .bytes
            .get(self.position..)
            .filter(|rest| !rest.is_empty())?;
        let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let length = end.unwrap_or(rest.len());
        let (line, rest) = rest.split_at_checked(length)?;
        // Transfers between systems turn \r\n into \r\r\n.
        let ends = match rest {
            [b'\r', b'\r', b'\n', ..] => 3,
            [b'\r', b'\n', ..] => 2,
            [_, ..] => 1,
            [] => 0,
        };
        self.position += length + ends;
        self.lines += 1;
        Some(line)
    }

    fn filled_line(&mut self) -> Option<&'a [u8]> {
        loop {
            let line = self.line()?;
            if !line.trim_ascii().is_empty() {
                return Some(line);
            }
        }
    }

    fn text_group(&mut self) -> Option<Result<Group<'a>, Trouble>> {
        let line = self.filled_line()?;
        let at = self.lines;
        let Some(code) = code(line) else {
            let next = self.go_on();
            let reason = format!("{} is no group code; reading goes on {next}", quoted(line));
            return Some(Err(Trouble { at, reason }));
        };
        let Some(value) = self.line() else {
            let reason = format!("the file ends after group code {code}");
            return Some(Err(Trouble { at, reason }));
        };
        let (value, at) = (Value::Text(value), self.lines);
        Some(Ok(Group { code, value, at }))
    }

    /// Go to the next line that is 0 before one that looks like the name of an entity.
    fn go_on(&mut self) -> String {
        let mut before = self.clone();
        let mut was_zero = false;
        loop {
            let here = self.clone();
            let Some(line) = self.line() else {
                return "nowhere".to_owned();
            };
            if was_zero && is_name(line.trim_ascii()) {
                *self = before;
                return format!("at line {}", self.at());
            }
            was_zero = line.trim_ascii() == b"0";
            before = here;
        }
    }

    fn binary_group(&mut self) -> Option<Result<Group<'a>, Trouble>> {
        if self.position >= self.bytes.len() {
            return None;
        }
        let at = self.at();
        let group = self.binary_code().and_then(|code| {
            let value = self.binary_value(code)?;
            Ok(Group { code, value, at })
        });
        Some(group.map_err(|reason| {
            self.position = self.bytes.len();
            Trouble { at, reason }
        }))
    }

    fn binary_code(&mut self) -> Result<i32, String> {
        if self.form == Form::Short {
            let [code] = self.array()?;
            if code != u8::MAX {
                return Ok(i32::from(code));
            }
        }
        Ok(i32::from(i16::from_le_bytes(self.array()?)))
    }

    fn binary_value(&mut self, code: i32) -> Result<Value<'a>, String> {
        match code {
            0..=9
            | 100..=105
            | 300..=309
            | 320..=369
            | 390..=399
            | 410..=419
            | 430..=439
            | 470..=481 => self.string(),
            999..=1003 | 1005..=1009 => self.string(),
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
                Ok(Value::Real(f64::from_le_bytes(self.array()?)))
            }
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                Ok(Value::Integer(i16::from_le_bytes(self.array()?).into()))
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => {
                Ok(Value::Integer(i32::from_le_bytes(self.array()?).into()))
            }
            160..=169 => Ok(Value::Integer(i64::from_le_bytes(self.array()?))),
            290..=299 => {
                let [value] = self.array()?;
                Ok(Value::Integer(value.into()))
            }
            310..=319 | 1004 => {
                let [length] = self.array()?;
                self.take(length.into()).map(Value::Text)
            }
            _ => Err(format!(
                "{code} is no group code; nothing can be read from here on"
            )),
        }
    }

    fn string(&mut self) -> Result<Value<'a>, String> {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        let length = rest.iter().position(|byte| *byte == 0);
        let length = length.ok_or_else(|| "the file ends within a string".to_owned())?;
        let text = self.take(length)?;
        self.position += 1;
        Ok(Value::Text(text))
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let bytes = self.take(N)?;
        bytes
            .try_into()
            .map_err(|_| "the file ends within a group".to_owned())
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let rest = self.bytes.get(self.position..).unwrap_or_default();
        let taken = rest.get(..count);
        self.position += taken.map_or(0, <[u8]>::len);
        taken.ok_or_else(|| "the file ends within a group".to_owned())
    }
}

impl<'a> Iterator for Groups<'a> {
    type Item = Result<Group<'a>, Trouble>;

    fn next(&mut self) -> Option<Self::Item> {
        match self.form {
            Form::Text => self.text_group(),
            _ => self.binary_group(),
        }
    }
}

fn refused(bytes: &[u8]) -> Option<String> {
    let starts = |start: &[u8]| bytes.starts_with(start);
    let digits = bytes
        .get(2..6)
        .is_some_and(|it| it.iter().all(u8::is_ascii_digit));
    if (starts(b"AC") && digits) || starts(b"AC1.") || starts(b"AC2.") || starts(b"MC0.0") {
        return Some("this is a DWG file: save it as DXF in the program that made it".to_owned());
    }
    if starts(b"AutoCAD DXB") {
        return Some("this is a DXB file: save it as DXF in the program that made it".to_owned());
    }
    if starts(b"\xff\xfe") || starts(b"\xfe\xff") {
        return Some("this is UTF-16 text, which DXF is not: save it as ASCII or UTF-8".to_owned());
    }
    None
}

/// Tell the forms apart by the first group: 0, or 999 of a comment.
fn binary_form(rest: &[u8]) -> Form {
    match rest {
        [0, 0, ..] | [0xe7, 3, ..] => Form::Long,
        _ => Form::Short,
    }
}

fn code(line: &[u8]) -> Option<i32> {
    let text = std::str::from_utf8(line.trim_ascii()).ok()?;
    text.parse()
        .ok()
        .filter(|code| (-5..=LAST_CODE).contains(code))
}

fn is_name(text: &[u8]) -> bool {
    let letter = |byte: &u8| byte.is_ascii_uppercase();
    text.iter().any(letter)
        && text
            .iter()
            .all(|byte| letter(byte) || byte.is_ascii_digit() || *byte == b'_')
}

fn quoted(text: &[u8]) -> String {
    let text = text.trim_ascii();
    let start = text.get(..QUOTED).unwrap_or(text);
    let dots = if start.len() < text.len() { "…" } else { "" };
    format!("\"{}{dots}\"", start.escape_ascii())
}
