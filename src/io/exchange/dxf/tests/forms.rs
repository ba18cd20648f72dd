//! Line ends, code pages, binary files, the header, and what is refused.

use super::{drawing, entities, file, groups, read, section};
use crate::io::exchange::drawing::Drawing;

const LINE: &str = "0 LINE; 8 walls; 10 0.1; 20 2; 11 3; 21 4";

/// The bytes of a binary file with the groups of a text.
fn binary(text: &str, start: &[u8], has_long_codes: bool) -> Vec<u8> {
    let mut bytes = start.to_vec();
    let lines: Vec<&str> = text.lines().collect();
    for pair in lines.chunks_exact(2) {
        let (code, value): (i16, &str) = (pair[0].parse().expect("a code"), pair[1]);
        match u8::try_from(code) {
            _ if has_long_codes => bytes.extend(code.to_le_bytes()),
            Ok(code) => bytes.push(code),
            Err(_) => {
                bytes.push(255);
                bytes.extend(code.to_le_bytes());
            }
        }
        match code {
            10..=59 | 210..=239 => {
                bytes.extend(value.parse::<f64>().expect("a number").to_le_bytes())
            }
            60..=79 => bytes.extend(value.parse::<i16>().expect("a number").to_le_bytes()),
            420..=429 | 90..=99 => {
                bytes.extend(value.parse::<i32>().expect("a number").to_le_bytes())
            }
            _ => {
                bytes.extend(value.as_bytes());
                bytes.push(0);
            }
        }
    }
    bytes
}

fn header(text: &str) -> String {
    section("HEADER", text)
}

/// The name of the layer of a point under a code page.
fn layer(version: &str, page: &str, name: &[u8]) -> (String, Vec<String>) {
    let header = header(&format!(
        "9 $ACADVER; 1 {version}; 9 $DWGCODEPAGE; 3 {page}"
    ));
    let text = file(&[header, section("ENTITIES", "0 POINT; 10 0; 20 0; 8 @")]);
    let at = text.find('@').expect("a name");
    let (before, after) = (&text.as_bytes()[..at], &text.as_bytes()[at + 1..]);
    let drawing = read(&[before, name, after].concat()).expect("a drawing");
    (drawing.items[0].group[0].clone(), drawing.remarks)
}

#[test]
fn all_line_ends_and_a_mark_are_read() {
    let text = entities(LINE);
    let expected = drawing(&text);
    let mixed: String = text
        .lines()
        .zip(["\r", "\n", "\r\n", "\r\r\n"].iter().cycle())
        .map(|(a, b)| format!("{a}{b}"))
        .collect();
    let ends = ["\r", "\r\n", "\r\r\n", " \n"].map(|end| text.replace('\n', end));
    for text in ends.into_iter().chain([
        mixed,
        format!("\u{feff}{text}"),
        format!("\n\n{text}\u{1a}"),
    ]) {
        let found = drawing(&text);
        assert_eq!(found.items[0].shapes, expected.items[0].shapes, "{text:?}");
        assert_eq!(found.remarks, [""; 0]);
    }
}

#[test]
fn comments_are_passed() {
    let text = groups("999 made by hand") + &entities(&LINE.replace("20 2", "20 2; 999 here"));
    assert_eq!(
        drawing(&text).items[0].shapes,
        drawing(&entities(LINE)).items[0].shapes
    );
}

#[test]
fn binary_files_of_all_versions_hold_the_same() {
    let text = file(&[
        header("9 $INSUNITS; 70 5"),
        section("ENTITIES", &format!("{LINE}; 420 66051")),
    ]);
    let expected = drawing(&text);
    assert_eq!(expected.unit, Some(10.0));
    let start = b"AutoCAD Binary DXF\r\n\x1a\0";
    let transferred = b"AutoCAD Binary DXF\n\x1a\0".as_slice();
    for bytes in [
        binary(&text, start, true),
        binary(&text, start, false),
        binary(&text, transferred, false),
    ] {
        let found = read(&bytes).expect("a drawing");
        assert_eq!(
            (found.unit, found.remarks.len()),
            (expected.unit, 0),
            "{:?}",
            found.remarks
        );
        assert_eq!(found.items[0].shapes, expected.items[0].shapes);
        assert_eq!(
            (&found.items[0].group, found.items[0].colour),
            (&expected.items[0].group, Some([1, 2, 3]))
        );
    }
}

#[test]
fn places_in_binary_files_are_bytes() {
    let text = entities("0 CIRCLE; 10 0; 20 0; 40 -1");
    let mut bytes = binary(&text, b"AutoCAD Binary DXF\r\n\x1a\0", true);
    let expected = "byte 44: CIRCLE skipped: radius -1 is not above 0";
    assert_eq!(read(&bytes).expect("a drawing").remarks, [expected]);
    bytes.truncate(60);
    let remarks = read(&bytes).expect("a drawing").remarks;
    assert_eq!(
        remarks[0],
        "byte 53: in CIRCLE: the file ends within a group"
    );
    assert_eq!(remarks[1], "byte 61: the file ends without EOF");
}

#[test]
fn names_are_read_by_their_code_page() {
    let cases: [(&str, &str, &[u8], &str); 9] = [
        ("AC1015", "ANSI_1252", b"W\xe4nde", "Wände"),
        ("AC1015", "ANSI_1251", b"\xd1\xf2\xe5\xed\xfb", "Стены"),
        ("AC1009", "dos437", b"W\x84nde", "Wände"),
        ("AC1009", "dos850", b"\xd0", "ð"),
        ("AC1018", "ANSI_932", b"\x95\xc7\x83\x5c", "壁ソ"),
        ("AC1018", "ANSI_936", b"\xc7\xbd\xcc\xe5", "墙体"),
        ("AC1015", "ANSI_1252", "Wände".as_bytes(), "Wände"),
        ("AC1032", "ANSI_1252", "Wände".as_bytes(), "Wände"),
        ("AC1032", "ANSI_1250", b"W\xe4nde", "Wände"),
    ];
    for (version, page, name, expected) in cases {
        let (found, remarks) = layer(version, page, name);
        assert_eq!(
            (found.as_str(), remarks.len()),
            (expected, 0),
            "{version} {page}"
        );
    }
    let (found, remarks) = layer("AC1015", "klingon", b"W\xe4nde");
    assert_eq!(found, "Wände");
    assert_eq!(
        remarks,
        ["line 2: $DWGCODEPAGE klingon is unknown; names are read as ANSI_1252"]
    );
}

#[test]
fn escapes_are_letters() {
    let cases = [
        (r"W\U+00E4nde", "Wände"),
        (r"\U+D83D\U+DE00", "😀"),
        (r"\M+195c7x", "壁x"),
        (r"a\U+12 \M+9 b", r"a\U+12 \M+9 b"),
    ];
    for (name, expected) in cases {
        assert_eq!(layer("AC1015", "ANSI_1252", name.as_bytes()).0, expected);
    }
}

#[test]
fn units_come_from_the_header_alone() {
    let unit = |text: &str| -> Drawing { drawing(&file(&[header(text)])) };
    let cases = [
        (1, 25.4),
        (2, 304.8),
        (4, 1.0),
        (5, 10.0),
        (6, 1000.0),
        (14, 100.0),
        (21, 304.800_609_601_219_2),
    ];
    for (number, expected) in cases {
        let found = unit(&format!("9 $INSUNITS; 70 {number}"));
        assert_eq!(found.unit, Some(expected));
    }
    for text in [
        "9 $INSUNITS; 70 0",
        "9 $MEASUREMENT; 70 1",
        "9 $LUNITS; 70 4",
    ] {
        let found = unit(text);
        assert_eq!((found.unit, found.remarks.len()), (None, 0));
    }
    let found = unit("9 $INSUNITS; 70 99");
    assert_eq!(
        (found.unit, found.remarks),
        (None, vec!["line 8: $INSUNITS \"99\" is no unit".to_owned()])
    );
}

#[test]
fn other_formats_are_refused_by_name() {
    let cases: [(&[u8], &str); 6] = [
        (b"AC1032\0\0\0", "DWG"),
        (b"AutoCAD DXB 1.0\r\n\x1a\0", "DXB"),
        (b"\xff\xfe0\0", "UTF-16"),
        (b"", "empty"),
        (b"<svg/>", "no group code"),
        (b"0\nLINE\n0\nEOF\n", "no SECTION"),
    ];
    for (bytes, expected) in cases {
        let error = read(bytes).expect_err("no drawing");
        assert!(error.reason.contains(expected), "{}", error.reason);
    }
    let error = read(b"\n<svg/>").expect_err("no drawing");
    assert_eq!(error.at, Some(2));
}
