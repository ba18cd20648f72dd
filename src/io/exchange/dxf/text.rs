//! Strings of any code page, and the escapes for letters outside of it.

use encoding_rs::{BIG5, EUC_KR, Encoding, GBK, SHIFT_JIS, UTF_8, WINDOWS_1252};

use super::code_pages;
use crate::io::exchange::short_names::{beginning, short};

/// The first version whose text is UTF-8 (AutoCAD 2007).
const FIRST_UTF_8: &[u8] = b"AC1021";

/// How the strings of a file are coded.
#[derive(Clone, Copy, Debug)]
pub struct Decoder {
    page: Page,
    /// Whether strings that are UTF-8 are taken as such.
    prefers_utf_8: bool,
}

#[derive(Clone, Copy, Debug)]
enum Page {
    Encoding(&'static Encoding),
    /// The letters from byte 128 on.
    Dos(&'static str),
}

impl Default for Decoder {
    fn default() -> Self {
        Self {
            page: Page::Encoding(WINDOWS_1252),
            prefers_utf_8: true,
        }
    }
}

impl Decoder {
    /// Choose the coding by $ACADVER and $DWGCODEPAGE. Programs write UTF-8 under older versions too:
    /// `is_utf_8` says that the whole file is. The remark is about a code page that is not known.
    pub fn new(version: &[u8], page: &[u8], is_utf_8: bool) -> (Self, Option<String>) {
        let known = page_of(page);
        let remark = known.is_none().then(|| {
            let page = page.escape_ascii();
            format!("$DWGCODEPAGE {page} is unknown; names are read as ANSI_1252")
        });
        let decoder = Self {
            page: known.unwrap_or(Page::Encoding(WINDOWS_1252)),
            prefers_utf_8: is_utf_8 || version >= FIRST_UTF_8,
        };
        (decoder, remark.filter(|_| !decoder.prefers_utf_8))
    }

    /// Read a name.
    pub fn decode(&self, bytes: &[u8]) -> String {
        let bytes = beginning(bytes);
        let plain = match std::str::from_utf8(bytes) {
            Ok(text) if self.prefers_utf_8 || text.is_ascii() => text.to_owned(),
            _ => decode(self.page, bytes),
        };
        match plain.contains('\\') {
            true => short(&unescaped(&plain)),
            false => short(&plain),
        }
    }
}

fn decode(page: Page, bytes: &[u8]) -> String {
    match page {
        Page::Encoding(encoding) => encoding.decode_without_bom_handling(bytes).0.into_owned(),
        Page::Dos(letters) => bytes
            .iter()
            .map(|byte| dos_letter(letters, *byte))
            .collect(),
    }
}

fn dos_letter(letters: &str, byte: u8) -> char {
    match byte.checked_sub(128) {
        None => byte.into(),
        Some(index) => letters
            .chars()
            .nth(index.into())
            .unwrap_or(char::REPLACEMENT_CHARACTER),
    }
}

fn page_of(name: &[u8]) -> Option<Page> {
    let name = String::from_utf8_lossy(name).to_ascii_lowercase();
    if let Some(number) = name.strip_prefix("dos") {
        let letters = code_pages::letters(number.parse().ok()?);
        return letters.map(Page::Dos).or_else(|| numbered(number));
    }
    if let Some(number) = name.strip_prefix("ansi_") {
        return numbered(number);
    }
    let label = match name.as_str() {
        "" | "ascii" => "windows-1252".to_owned(),
        "mac-roman" => "macintosh".to_owned(),
        "ksc5601" => "euc-kr".to_owned(),
        _ => name.replace("8859_", "iso-8859-"),
    };
    Encoding::for_label(label.as_bytes()).map(Page::Encoding)
}

fn numbered(number: &str) -> Option<Page> {
    let encoding = match number {
        "932" => SHIFT_JIS,
        "936" => GBK,
        "949" => EUC_KR,
        "950" => BIG5,
        "65001" => UTF_8,
        "866" => Encoding::for_label(b"ibm866")?,
        _ => Encoding::for_label(format!("windows-{number}").as_bytes())?,
    };
    Some(Page::Encoding(encoding))
}

/// Replace \U+XXXX, a unit of UTF-16, and \M+NXXXX, two bytes of an Asian code page.
fn unescaped(text: &str) -> String {
    let mut units: Vec<u16> = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        if let Some((unit, after)) = utf_16_escape(rest) {
            units.push(unit);
            rest = after;
        } else if let Some((letters, after)) = page_escape(rest) {
            units.extend(letters.encode_utf16());
            rest = after;
        } else {
            units.extend_from_slice(first.encode_utf16(&mut [0; 2]));
            rest = rest.get(first.len_utf8()..).unwrap_or_default();
        }
    }
    String::from_utf16_lossy(&units)
}

fn utf_16_escape(text: &str) -> Option<(u16, &str)> {
    let text = text
        .strip_prefix("\\U+")
        .or_else(|| text.strip_prefix("\\u+"))?;
    hexadecimal(text)
}

fn page_escape(text: &str) -> Option<(String, &str)> {
    let text = text
        .strip_prefix("\\M+")
        .or_else(|| text.strip_prefix("\\m+"))?;
    let (digit, text) = text.split_at_checked(1)?;
    let encoding = match digit {
        "1" => SHIFT_JIS,
        "2" => BIG5,
        "3" => EUC_KR,
        "5" => GBK,
        _ => return None,
    };
    let (unit, after) = hexadecimal(text)?;
    Some((decode(Page::Encoding(encoding), &unit.to_be_bytes()), after))
}

fn hexadecimal(text: &str) -> Option<(u16, &str)> {
    let (digits, after) = text.split_at_checked(4)?;
    let all = digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    let unit = u16::from_str_radix(digits, 16).ok().filter(|_| all)?;
    Some((unit, after))
}
