//! Damaged files: remarks, never a panic.

use std::time::{Duration, Instant};

use super::{drawing, entities, file, read, section};

/// A generator of numbers by shifts and exclusive or.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }
}

const CURVES: &str = "0 LINE; 8 a; 62 3; 10 1; 20 2; 30 3; 11 4; 21 5; 31 6;
    0 ARC; 10 1; 20 2; 40 3; 50 10; 51 20; 210 0; 220 1; 230 0;
    0 ELLIPSE; 10 1; 20 2; 11 3; 21 0; 40 0.5; 41 0; 42 2;
    0 LWPOLYLINE; 90 3; 70 1; 10 0; 20 0; 42 1; 10 1; 20 0; 10 1; 20 1;
    0 POLYLINE; 66 1; 70 1; 0 VERTEX; 10 0; 20 0; 42 0.5; 0 VERTEX; 10 1; 20 1; 0 SEQEND;
    0 SPLINE; 70 11; 71 3; 40 0; 40 1; 40 2; 40 3; 40 4; 41 1; 41 2; 41 1; 41 1;
    10 0; 20 0; 10 1; 20 0; 10 1; 20 1; 10 0; 20 1;
    0 SPLINE; 70 1; 71 3; 11 0; 21 0; 11 1; 21 0; 11 1; 21 1; 11 0; 21 1;
    0 INSERT; 2 b; 10 1; 20 1; 41 2; 50 30; 70 2; 71 2; 44 5; 45 5;
    0 INSERT; 2 b; 10 1; 20 1; 230 -1; 67 1";

fn sample() -> String {
    let blocks =
        format!("0 BLOCK; 2 b; 10 1; 20 1; {CURVES}; 0 ENDBLK; 0 BLOCK; 2 *Paper_Space; 0 ENDBLK");
    file(&[
        section(
            "HEADER",
            "9 $ACADVER; 1 AC1015; 9 $DWGCODEPAGE; 3 ANSI_1252; 9 $INSUNITS; 70 4",
        ),
        section(
            "TABLES",
            "0 TABLE; 2 LAYER; 0 LAYER; 2 a; 62 -5; 70 1; 0 ENDTAB",
        ),
        section("BLOCKS", &blocks),
        section("ENTITIES", CURVES),
    ])
}

/// A binary sample, whose damage meets other checks.
fn binary_sample() -> Vec<u8> {
    let mut bytes = b"AutoCAD Binary DXF\r\n\x1a\0".to_vec();
    for (code, text) in [(0, "SECTION"), (2, "ENTITIES")] {
        bytes.extend([code, 0]);
        bytes.extend(text.bytes().chain([0]));
    }
    for number in 0..8_u8 {
        bytes.extend(b"\0\0CIRCLE\0\x08\0layer\0");
        for code in [10, 20, 40] {
            bytes.extend([code, 0]);
            bytes.extend(f64::from(number + code).to_le_bytes());
        }
    }
    bytes.extend(b"\0\0ENDSEC\0\0\0EOF\0");
    bytes
}

fn mutated(sample: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = sample.to_vec();
    for _ in 0..=numbers.below(4) {
        let at = numbers.below(bytes.len());
        let length = numbers.below(40).min(bytes.len() - at);
        match numbers.below(6) {
            0 => bytes[at] ^= 1 << numbers.below(8),
            1 => bytes.truncate(at.max(1)),
            2 => drop(bytes.drain(at..at + length)),
            3 => {
                let piece = bytes[at..at + length].to_vec();
                let to = numbers.below(bytes.len());
                drop(bytes.splice(to..to, piece));
            }
            4 => {
                let huge = [
                    "\n70\n2147483647\n",
                    "\n71\n-9\n",
                    "\n90\n9999999999999\n",
                    "\n10\nnan\n",
                ];
                let piece = huge[numbers.below(4)].bytes();
                drop(bytes.splice(at..at, piece));
            }
            _ => bytes[at] = b"0123456789-.e \n"[numbers.below(15)],
        }
        if bytes.is_empty() {
            bytes.push(b'0');
        }
    }
    bytes
}

#[test]
fn mutations_never_panic() {
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let samples = [sample().into_bytes(), binary_sample()];
    for sample in &samples {
        assert!(!read(sample).expect("a drawing").items.is_empty());
        for _ in 0..2000 {
            // What is read need not be right, but it must come, and be finite.
            let _ = read(&mutated(sample, &mut numbers));
        }
    }
}

#[test]
fn a_lost_line_costs_one_entity() {
    let text = entities("0 POINT; 10 1; 20 2; 0 POINT; 10 3; 20 4; 30 5; 8 a; 0 POINT; 10 5; 20 6");
    let damaged = text.replacen("10\n3\n", "10\n", 1);
    let drawing = drawing(&damaged);
    assert_eq!(drawing.items.len(), 2);
    let expected = [
        "line 19: in POINT: \"a\" is no group code; reading goes on at line 20",
        "line 12: POINT skipped: group 20 is missing",
    ];
    assert_eq!(drawing.remarks, expected);
}

#[test]
fn a_cut_file_keeps_what_is_whole() {
    let text = entities("0 POINT; 10 1; 20 2; 0 POINT; 10 3; 20 4");
    let drawing = drawing(&text[..text.len() - 17]);
    assert_eq!(drawing.items.len(), 1);
    let expected = [
        "line 15: in POINT: the file ends after group code 20",
        "line 16: the file ends without EOF",
        "line 12: POINT skipped: group 20 is missing",
    ];
    assert_eq!(drawing.remarks, expected);
}

#[test]
fn sections_out_of_order_are_remarked_on() {
    let blocks = "0 BLOCK; 2 a; 0 BLOCK; 2 a; 0 ENDBLK; 0 BLOCK; 2 c";
    let text = file(&[
        section("BLOCKS", blocks),
        section("WHAT", ""),
        section("ENTITIES", "0 POINT; 10 1; 20 1"),
    ]);
    let text = text.replacen("0\nENDSEC\n", "", 1) + "0\nLINE\n";
    let expected = [
        "line 10: BLOCK a has no ENDBLK before this BLOCK",
        "line 10: BLOCK a skipped: it is there already",
        "line 20: the section before has no ENDSEC",
        "line 16: BLOCK c has no ENDBLK",
        "line 20: SECTION skipped: its name \"WHAT\" is unknown",
        "line 39: what follows EOF is left out",
    ];
    let drawing = drawing(&text);
    assert_eq!(drawing.remarks, expected);
    assert_eq!(drawing.items.len(), 1);
}

#[test]
fn entities_outside_of_sections_are_read() {
    let text = file(&[
        section("HEADER", "9 $INSUNITS; 70 4"),
        super::groups("0 POINT; 10 1; 20 1"),
    ]);
    let drawing = drawing(&text);
    assert_eq!(drawing.items.len(), 1);
    assert_eq!(
        drawing.remarks,
        ["line 12: POINT outside of a section is read as an entity"]
    );
}

#[test]
fn remarks_are_counted_above_1000() {
    let drawing = drawing(&entities(&"0 LINE;".repeat(1500)));
    assert_eq!(drawing.remarks.len(), 1001);
    assert_eq!(drawing.remarks[1000], "500 more remarks are left out");
}

#[test]
fn large_coordinates_that_overflow_are_skipped() {
    let block = "0 BLOCK; 2 a; 0 POINT; 10 1e300; 20 0; 0 ENDBLK";
    let insert = "0 INSERT; 2 a; 10 0; 20 0; 41 1e300; 70 3";
    let drawing = drawing(&file(&[
        section("BLOCKS", block),
        section("ENTITIES", insert),
    ]));
    assert_eq!(drawing.items, []);
    assert_eq!(
        drawing.remarks,
        ["line 10: point skipped: it reaches beyond all numbers"]
    );
}

#[test]
fn many_names_take_no_time() {
    let text: String = (0..100_000)
        .map(|number| format!("0\nN{number}\n"))
        .collect();
    let text = format!("0\nSECTION\n2\nENTITIES\n{text}0\nENDSEC\n0\nEOF\n");
    let start = Instant::now();
    let others = drawing(&text).other;
    assert_eq!(others.len(), 201, "the rest has one row");
    let count: usize = others.iter().map(|other| other.count).sum();
    assert_eq!(count, 100_000);
    assert!(start.elapsed() < Duration::from_secs(20));
}
