//! What holds for a whole file: its version, the library that wrote it and its unit.

use super::chunks::{Archive, Chunk, Chunks, LIBRARY, UNITS};
use super::cursor::Cursor;
use crate::io::exchange::drawing::Unreadable;

/// The bytes before the first chunk.
pub(super) const HEADER: usize = 32;
pub(super) const TITLE: &[u8; 24] = b"3D Geometry File Format ";
/// The first openNURBS of which layers tell their parents rightly; so do the files of this module.
pub(super) const NESTED_LAYERS: u32 = 200_505_111;
/// The first openNURBS of which edges tell two domains.
pub(super) const TWO_DOMAINS: u32 = 200_206_180;
/// The code of a unit of any length.
pub(super) const CUSTOM: u32 = 11;

/// The lengths of the units that have a code, in millimetres.
const LENGTHS: [(u32, f64); 24] = [
    (2, 1.0),
    (1, 1e-3),
    (3, 10.0),
    (4, 1e3),
    (5, 1e6),
    (6, 25.4e-6),
    (7, 0.0254),
    (8, 25.4),
    (9, 304.8),
    (10, 1_609_344.0),
    (12, 1e-7),
    (13, 1e-6),
    (14, 100.0),
    (15, 1e4),
    (16, 1e5),
    (17, 1e9),
    (18, 1e12),
    (19, 914.4),
    (20, 25.4 / 72.0),
    (21, 25.4 / 6.0),
    (22, 1_852_000.0),
    (23, 1.4959787e14),
    (24, 9.4607304725808e18),
    (25, 3.08567758e19),
];

/// Read the header, and refuse what no later part of a file could mend.
pub(super) fn archive(bytes: &[u8]) -> Result<Archive, Unreadable> {
    let refuse = |at, reason: &str| {
        Err(Unreadable {
            at: Some(at),
            reason: reason.to_owned(),
        })
    };
    let Some((title, rest)) = bytes.split_first_chunk::<24>() else {
        return refuse(1, "The file is too short for a 3DM file");
    };
    if title != TITLE {
        return refuse(1, "This is not a 3DM file");
    }
    let version = rest
        .get(..8)
        .and_then(|digits| str::from_utf8(digits).ok())
        .and_then(|digits| digits.trim().parse().ok());
    match version {
        Some(1) => refuse(
            25,
            "This is a 3DM file of version 1, which has another layout; save it as version 2 or later, \
             or as DXF, IGES or STEP",
        ),
        Some(version @ (2..=5 | 50 | 60 | 70 | 80)) => Ok(Archive {
            version,
            opennurbs: 0,
        }),
        // Later versions have kept the layout of curves so far.
        Some(version @ 81..=999) => Ok(Archive {
            version,
            opennurbs: 0,
        }),
        _ => refuse(
            25,
            "The version of this 3DM file is not known; save it as version 2 to 8",
        ),
    }
}

/// Read the date of the library from the table of properties.
pub(super) fn opennurbs(table: &Chunk, archive: Archive) -> u32 {
    Chunks::new(table.body, archive)
        .find(|chunk| chunk.code == LIBRARY)
        .and_then(|chunk| u32::try_from(chunk.value & 0xFFFF_FFFF).ok())
        .unwrap_or_default()
}

/// Read the length of a unit in millimetres from the table of settings, if it tells one.
pub(super) fn unit(table: &Chunk, archive: Archive) -> Result<Option<f64>, String> {
    let found = Chunks::new(table.body, archive).find(|chunk| chunk.code == UNITS);
    found.map_or(Ok(None), |chunk| length(chunk.body))
}

fn length(mut data: Cursor) -> Result<Option<f64>, String> {
    let version = data.int()?;
    if !(100..200).contains(&version) {
        return Err(format!("its layout {version} is not known"));
    }
    let code = data.word()?;
    if code != CUSTOM {
        return Ok(LENGTHS
            .iter()
            .find(|(known, _)| *known == code)
            .map(|(_, length)| *length));
    }
    // Three tolerances, and how lengths are shown.
    data.bytes(24 + 8)?;
    let metres = data.number()?;
    let length = metres * 1e3;
    if length > 0.0 && length.is_finite() {
        Ok(Some(length))
    } else {
        Err(format!("a unit of {metres} m"))
    }
}

/// The code of a unit of so many millimetres: [`CUSTOM`] if it has none.
pub(super) fn unit_code(length: f64) -> u32 {
    LENGTHS
        .iter()
        .find(|(_, known)| *known == length)
        .map_or(CUSTOM, |(code, _)| *code)
}
