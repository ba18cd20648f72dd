//! Strings of Part 21: ASCII between quotes, everything else escaped.

use encoding_rs::{
    Encoding, ISO_8859_2, ISO_8859_3, ISO_8859_4, ISO_8859_5, ISO_8859_6, ISO_8859_7, ISO_8859_8,
    WINDOWS_1252, WINDOWS_1254,
};

use crate::io::exchange::short_names::{LONGEST, beginning, short};

/// The pages A to I of `\P…\`: ISO 8859-1 to 8859-9. From 0xA0 the Windows pages are the same as the first
/// and last.
const PAGES: [&Encoding; 9] = [
    WINDOWS_1252,
    ISO_8859_2,
    ISO_8859_3,
    ISO_8859_4,
    ISO_8859_5,
    ISO_8859_6,
    ISO_8859_7,
    ISO_8859_8,
    WINDOWS_1254,
];

/// Decode a name: the characters between two quotes.
pub fn decode(raw: &[u8]) -> String {
    let raw = beginning(raw);
    let text = match std::str::from_utf8(raw) {
        Ok(text) => text.to_owned(),
        Err(_) => raw.iter().map(|byte| char::from(*byte)).collect(),
    };
    let mut out = String::with_capacity(text.len());
    let mut rest = text.as_str();
    let mut page = 0;
    let mut letters = 0;
    while let Some(head) = rest.chars().next().filter(|_| letters <= LONGEST) {
        letters += 1;
        let (piece, tail) = match head {
            '\'' => (
                "'".to_owned(),
                rest.strip_prefix("''").unwrap_or_else(|| skip(rest, 1)),
            ),
            '\\' => escape(rest, &mut page).unwrap_or_else(|| ("\\".to_owned(), skip(rest, 1))),
            '\n' | '\r' => (String::new(), skip(rest, 1)),
            _ => (head.to_string(), skip(rest, 1)),
        };
        out.push_str(&piece);
        rest = tail;
    }
    short(&out)
}

/// Encode a text, without its quotes.
pub fn encode(text: &str) -> String {
    let mut out = String::new();
    for head in text.chars() {
        match head {
            '\'' => out.push_str("''"),
            '\\' => out.push_str("\\\\"),
            ' '..='~' => out.push(head),
            '\0'..='\u{ffff}' => out.push_str(&format!("\\X2\\{:04X}\\X0\\", u32::from(head))),
            _ => out.push_str(&format!("\\X4\\{:08X}\\X0\\", u32::from(head))),
        }
    }
    out
}

/// Read an escape at the front: what it stands for, and what follows it.
fn escape<'t>(rest: &'t str, page: &mut usize) -> Option<(String, &'t str)> {
    if let Some(tail) = rest.strip_prefix("\\\\") {
        return Some(("\\".to_owned(), tail));
    }
    if let Some(tail) = rest.strip_prefix("\\S\\") {
        let code = u8::try_from(tail.chars().next()?)
            .ok()
            .filter(u8::is_ascii)?
            | 0x80;
        let bytes = [code];
        let (found, _) = PAGES.get(*page)?.decode_without_bom_handling(&bytes);
        return Some((found.into_owned(), skip(tail, 1)));
    }
    if let Some(tail) = rest.strip_prefix("\\X2\\") {
        return wide(tail, 4);
    }
    if let Some(tail) = rest.strip_prefix("\\X4\\") {
        return wide(tail, 8);
    }
    if let Some(tail) = rest.strip_prefix("\\X\\") {
        let code = u8::from_str_radix(tail.get(..2)?, 16).ok()?;
        return Some((char::from(code).to_string(), tail.get(2..)?));
    }
    if let Some(tail) = rest.strip_prefix("\\N\\") {
        return Some(("\n".to_owned(), tail));
    }
    if let Some(tail) = rest.strip_prefix("\\F\\") {
        return Some(("\u{c}".to_owned(), tail));
    }
    let tail = rest.strip_prefix("\\P")?;
    let letter = tail.chars().next().filter(|it| ('A'..='I').contains(it))?;
    *page = usize::from(u8::try_from(letter).ok()? - b'A');
    Some((String::new(), skip(tail, 1).strip_prefix('\\')?))
}

/// Read characters of four or eight hexadecimal digits up to `\X0\`.
fn wide(tail: &str, digits: usize) -> Option<(String, &str)> {
    let (inside, tail) = tail.split_once("\\X0\\")?;
    let mut units = Vec::new();
    let mut out = String::new();
    for chunk in inside.as_bytes().chunks(digits) {
        let code = u32::from_str_radix(std::str::from_utf8(chunk).ok()?, 16).ok()?;
        if digits == 4 {
            units.push(u16::try_from(code).ok()?);
        } else {
            out.push(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER));
        }
    }
    out.push_str(&String::from_utf16_lossy(&units));
    Some((out, tail))
}

fn skip(text: &str, count: usize) -> &str {
    text.char_indices()
        .nth(count)
        .map_or("", |(at, _)| text.get(at..).unwrap_or_default())
}
