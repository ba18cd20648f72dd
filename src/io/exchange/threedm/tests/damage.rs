use std::time::{Duration, Instant};

use super::super::read;
use super::files::{Attributes, start};
use super::*;

/// A generator of numbers that only look random.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }
}

fn mutated(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(3) {
        let at = 32 + random.below(bytes.len().saturating_sub(36));
        match random.below(5) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.next() as u8,
            2 => bytes.truncate(at),
            3 => {
                let piece: Vec<u8> = bytes[at..]
                    .iter()
                    .take(random.below(200))
                    .copied()
                    .collect();
                bytes.splice(at..at, piece);
            }
            _ => {
                let counts = [u32::MAX, 0x7FFF_FFFF, 0x1000_0000, 0];
                let count = counts[random.below(4)].to_le_bytes();
                bytes
                    .iter_mut()
                    .skip(at)
                    .zip(count)
                    .for_each(|(byte, new)| *byte = new);
            }
        }
        if bytes.len() < 40 {
            break;
        }
    }
    bytes
}

#[test]
fn survives_damage() {
    let mut referred = blocks(4);
    referred.reference(102, IDENTITY, &on_layer(1, ""));
    let mut newer = blocks(60);
    newer.reference(102, IDENTITY, &on_layer(1, ""));
    let files = [
        sample(2).finish(),
        sample(4).finish(),
        sample(70).finish(),
        referred.finish(),
        newer.finish(),
    ];
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for round in 0..10_000 {
        let bytes = mutated(&files[round % files.len()], &mut random);
        if let Ok(drawing) = read(&bytes) {
            assert!(drawing.items.len() < 100);
        }
    }
}

#[test]
fn keeps_what_comes_before_a_cut() {
    let bytes = sample(4).finish();
    let whole = read(&bytes).unwrap();
    let circle = usize::try_from(whole.items[2].at).unwrap();
    let drawing = read(&bytes[..circle + 60]).unwrap();
    assert_eq!(drawing.items, whole.items[..2]);
    let told = drawing.remarks.join("; ");
    assert!(told.contains("the file ends within"), "{told}");
    assert!(told.contains(&format!("byte {circle}")), "{told}");
}

#[test]
fn goes_on_after_a_wrong_length() {
    let bytes = sample(4).finish();
    let whole = read(&bytes).unwrap();
    let place = usize::try_from(whole.items[1].at).unwrap() - 1;
    for length in [-1, 3, 40, 1_000_000] {
        let mut bytes = bytes.clone();
        bytes[place + 4..place + 8].copy_from_slice(&i32::to_le_bytes(length));
        let drawing = read(&bytes).unwrap();
        assert!(
            drawing.items.len() >= 3,
            "length {length}: {}",
            drawing.items.len()
        );
        assert_eq!(drawing.items[0], whole.items[0]);
        assert_eq!(drawing.items.last(), whole.items.last());
        assert!(!drawing.remarks.is_empty());
    }
}

#[test]
fn finds_the_objects_after_a_wrong_table() {
    let bytes = sample(4).finish();
    for code in [0x1000_0014_u32, 0x1000_0015, 0x1000_0011] {
        let code = code.to_le_bytes();
        let place = bytes.windows(4).position(|window| window == code).unwrap();
        for length in [-1, 1, 7, 1_000_000] {
            let mut bytes = bytes.clone();
            bytes[place + 4..place + 8].copy_from_slice(&i32::to_le_bytes(length));
            let drawing = read(&bytes).unwrap();
            assert_eq!(
                drawing.items.len(),
                4,
                "{code:?} {length} {:?}",
                drawing.remarks
            );
            assert!(drawing.remarks.len() >= 2, "{code:?} {length}");
        }
    }
}

#[test]
fn tells_of_wrong_checksums() {
    let mut bytes = sample(4).finish();
    let five = 5.0_f64.to_le_bytes();
    let at = bytes.windows(8).position(|window| window == five).unwrap();
    bytes[at + 6] ^= 1;
    let drawing = read(&bytes).unwrap();
    assert_eq!(drawing.items.len(), 4);
    assert!(drawing.remarks[0].contains("NurbsCurve: its checksum is wrong"));
}

#[test]
fn skips_wrong_numbers_with_a_remark() {
    let knots = [0.0, 0.0, 1.0, 1.0];
    let points = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let part = || start(4).part();
    let homogeneous = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 2.0, 2.0, 2.0, 1.0];
    let with = |at: usize, number: f64| {
        let mut points = points;
        points[at] = number;
        nurbs(part(), 3, &knots, &points, false)
    };
    let cases = [
        (with(4, f64::NAN), "no number"),
        (with(4, f64::INFINITY), "no number"),
        (with(0, -1.23432101234321e308), "not set"),
        (
            nurbs(part(), 3, &[0.0, 0.0, 1.0, f64::NAN], &points, false),
            "no number",
        ),
        (
            nurbs(part(), 3, &[0.0, 1.0, 0.5, 1.0], &points, false),
            "do not rise",
        ),
        (nurbs(part(), 3, &[1.0; 4], &points, false), "no length"),
        (
            nurbs(part(), 3, &[0.0, 1.0, 1.0], &points, false),
            "3 knots for 3 points",
        ),
        (nurbs(part(), 4, &knots, &points, false), "of degree 3"),
        (nurbs(part(), 1, &knots, &points, false), "of degree 0"),
        (nurbs(part(), -1, &knots, &points, false), "its order -1"),
        (
            nurbs(part(), 3, &knots, &homogeneous, true),
            "weight is not positive",
        ),
    ];
    for (data, reason) in cases {
        let mut tables = start(4);
        tables.record(classes::NURBS_CURVE, data, &on_layer(0, "bad"));
        let line = line(part(), DVec3::ZERO, DVec3::X);
        tables.record(classes::LINE_CURVE, line, &on_layer(0, "good"));
        let drawing = read(&tables.finish()).unwrap();
        assert_eq!(drawing.items.len(), 1, "{reason}");
        assert_eq!(drawing.remarks.len(), 1, "{reason}");
        assert!(
            drawing.remarks[0].contains("NurbsCurve \"bad\": "),
            "{:?}",
            drawing.remarks
        );
        assert!(
            drawing.remarks[0].contains(reason),
            "{reason}: {:?}",
            drawing.remarks
        );
    }
}

#[test]
fn does_not_trust_counts() {
    let mut tables = start(4);
    let part = tables.part();
    let huge = part
        .clone()
        .bytes(&[0x10])
        .ints(&[3, 0, 4, i32::MAX, 0, 0])
        .numbers(&[0.0; 6]);
    tables.record(
        classes::NURBS_CURVE,
        huge.ints(&[i32::MAX]),
        &on_layer(0, ""),
    );
    tables.record(
        classes::POLYLINE_CURVE,
        part.bytes(&[0x10]).ints(&[-5]),
        &on_layer(0, ""),
    );
    let drawing = read(&tables.finish()).unwrap();
    assert!(drawing.items.is_empty());
    assert!(drawing.remarks[0].contains("its count 2147483647 is wrong"));
    assert!(drawing.remarks[1].contains("its count -5 is wrong"));
}

#[test]
fn refuses_blocks_within_themselves() {
    let mut tables = start(4);
    let inner = Attributes {
        id: 1,
        mode: 3,
        ..Attributes::default()
    };
    tables.reference(101, IDENTITY, &inner);
    tables.reference(101, IDENTITY, &on_layer(0, "free"));
    tables.reference(999, IDENTITY, &on_layer(0, "lost"));
    let mut perspective = IDENTITY;
    perspective[12] = 0.5;
    tables.reference(101, perspective, &on_layer(0, "perspective"));
    tables.definitions = tables.part().definition(101, "Ring", &[1, 77]);
    let drawing = read(&tables.finish()).unwrap();
    let told = drawing.remarks.join("; ");
    for reason in [
        "\"Ring\" contains itself",
        "1 objects of its definition",
        "is missing",
        "a perspective",
    ] {
        assert!(told.contains(reason), "{reason}: {told}");
    }
}

/// Blocks of which each contains the next one ten times: 10¹² lines, or nothing as often.
fn chain(with_lines: bool) -> Vec<u8> {
    let mut tables = start(4);
    let part = tables.part();
    tables.definitions = part.clone();
    for depth in 0..12_u128 {
        let member = Attributes {
            id: 1 + depth,
            mode: 3,
            ..Attributes::default()
        };
        tables.reference(101 + depth, IDENTITY, &member);
        let members = [2 + depth; 10];
        tables.definitions = tables
            .definitions
            .clone()
            .definition(101 + depth, "Kette", &members);
    }
    if with_lines {
        let member = Attributes {
            id: 13,
            mode: 3,
            ..Attributes::default()
        };
        tables.record(
            classes::LINE_CURVE,
            line(part, DVec3::ZERO, DVec3::X),
            &member,
        );
    }
    tables.reference(101, IDENTITY, &on_layer(0, "free"));
    tables.finish()
}

#[test]
fn cuts_off_endless_blocks() {
    let start = Instant::now();
    for with_lines in [true, false] {
        let drawing = read(&chain(with_lines)).unwrap();
        assert!(drawing.items.len() <= 1_000_000);
        let told = drawing.remarks.join("; ");
        assert!(told.contains("take too much memory"), "{told}");
    }
    assert!(start.elapsed() < Duration::from_secs(10));
}

#[test]
fn survives_layers_within_themselves() {
    let mut tables = start(4);
    tables.layers = tables
        .part()
        .layer(0, "a", [0; 4], 1)
        .layer(1, "b", [0; 4], 0);
    let line = line(tables.part(), DVec3::ZERO, DVec3::X);
    tables.record(classes::LINE_CURVE, line, &on_layer(0, ""));
    let drawing = read(&tables.finish()).unwrap();
    assert_eq!(drawing.items[0].group.len(), 64);
}
