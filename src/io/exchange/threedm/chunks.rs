//! The chunks that a 3DM file consists of: a code, a length and that many bytes, nested as the codes say.

use super::cursor::Cursor;

/// Marks a chunk that has a value in place of a length, and no bytes.
const SHORT: u32 = 0x8000_0000;
/// Marks a chunk whose last four bytes are the checksum of the others.
pub(super) const CHECKED: u32 = 0x8000;

pub(super) const COMMENT: u32 = 0x0000_0001;
pub(super) const END_OF_FILE: u32 = 0x0000_7FFF;
pub(super) const END_OF_TABLE: u32 = 0xFFFF_FFFF;

pub(super) const PROPERTIES: u32 = 0x1000_0014;
pub(super) const SETTINGS: u32 = 0x1000_0015;
pub(super) const LAYERS: u32 = 0x1000_0011;
pub(super) const LIGHTS: u32 = 0x1000_0012;
pub(super) const OBJECTS: u32 = 0x1000_0013;
pub(super) const DEFINITIONS: u32 = 0x1000_0021;

pub(super) const LIBRARY: u32 = 0xA000_0026;
pub(super) const UNITS: u32 = 0x2000_8031;
pub(super) const LAYER: u32 = 0x2000_8050;
pub(super) const LIGHT: u32 = 0x2000_8060;
pub(super) const OBJECT: u32 = 0x2000_8070;
pub(super) const DEFINITION: u32 = 0x2000_8076;

pub(super) const OBJECT_TYPE: u32 = 0x8200_0071;
pub(super) const OBJECT_ATTRIBUTES: u32 = 0x0200_8072;
pub(super) const OBJECT_END: u32 = 0x8200_007F;

pub(super) const CLASS: u32 = 0x0002_7FFA;
pub(super) const CLASS_ID: u32 = 0x0002_FFFB;
pub(super) const CLASS_DATA: u32 = 0x0002_FFFC;
pub(super) const CLASS_END: u32 = 0x8002_7FFF;

pub(super) const ANONYMOUS: u32 = 0x4000_8000;
pub(super) const COMPONENT: u32 = 0x4000_8002;

/// The version of a file, as far as its layout depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Archive {
    /// The version in the header: 2, 3, 4, 5, 50, 60, …
    pub(super) version: u32,
    /// The date of the openNURBS that wrote the file, as a number; 0 if the file does not say it.
    pub(super) opennurbs: u32,
}

impl Archive {
    /// The bytes of a chunk's length.
    pub(super) fn length_size(self) -> usize {
        if self.version < 50 { 4 } else { 8 }
    }
}

/// A chunk, without its code and its length.
#[derive(Clone, Copy)]
pub(super) struct Chunk<'a> {
    /// What it is.
    pub(super) code: u32,
    /// The value of a short chunk; otherwise the length.
    pub(super) value: i64,
    /// Its bytes with what is nested in it, without the checksum.
    pub(super) body: Cursor<'a>,
    /// The checksum in the file.
    pub(super) checksum: Option<u32>,
    /// The place of its code in the file, counted from 0.
    pub(super) at: usize,
    /// Whether the bytes end before the chunk does.
    pub(super) cut: bool,
}

impl Chunk<'_> {
    /// The place for remarks, counted from 1.
    pub(super) fn place(&self) -> u64 {
        place(self.at)
    }

    /// Whether it is of a kind that files consist of.
    pub(super) fn is_table(&self) -> bool {
        self.code == COMMENT || self.code >> 16 == PROPERTIES >> 16
    }

    /// Whether the checksum is not that of the bytes. Holds for chunks without nested ones alone.
    pub(super) fn damaged(&self) -> bool {
        self.checksum
            .is_some_and(|sum| sum != checksum(self.body.rest()))
    }
}

/// The place for remarks, counted from 1.
pub(super) fn place(at: usize) -> u64 {
    u64::try_from(at).unwrap_or(u64::MAX).saturating_add(1)
}

/// The chunks of a part of a file, one after the other.
pub(super) struct Chunks<'a> {
    cursor: Cursor<'a>,
    archive: Archive,
    /// Where something that is no chunk ended the chunks, counted from 0.
    pub(super) fault: Option<usize>,
}

impl<'a> Chunks<'a> {
    pub(super) fn new(cursor: Cursor<'a>, archive: Archive) -> Self {
        Self {
            cursor,
            archive,
            fault: None,
        }
    }

    /// What follows the last chunk.
    pub(super) fn rest(&self) -> Cursor<'a> {
        self.cursor
    }

    /// Go on at the next place after `at` where a chunk of `code` begins; false if there is none.
    pub(super) fn resume(&mut self, whole: Cursor<'a>, at: usize, code: u32) -> bool {
        let mut cursor = whole;
        let Ok(_) = cursor.bytes((at + 1).saturating_sub(whole.at())) else {
            return false;
        };
        let code = code.to_le_bytes();
        let Some(found) = cursor.rest().windows(4).position(|window| window == code) else {
            return false;
        };
        self.fault = None;
        self.cursor = cursor;
        self.cursor.bytes(found).is_ok()
    }

    fn chunk(&mut self) -> Result<Chunk<'a>, String> {
        let at = self.cursor.at();
        let code = self.cursor.word()?;
        let value = if self.archive.length_size() == 4 {
            i64::from(self.cursor.int()?)
        } else {
            let low = u64::from(self.cursor.word()?);
            let high = i64::from(self.cursor.int()?);
            (high << 32) | i64::from_ne_bytes(low.to_ne_bytes())
        };
        let mut chunk = Chunk {
            code,
            value,
            body: Cursor::new(&[], self.cursor.at()),
            checksum: None,
            at,
            cut: false,
        };
        if code & SHORT == 0 {
            self.fill(&mut chunk)?;
        }
        Ok(chunk)
    }

    fn fill(&mut self, chunk: &mut Chunk<'a>) -> Result<(), String> {
        let checked = chunk.code & CHECKED != 0;
        let least = if checked { 4 } else { 0 };
        if chunk.value < least {
            return Err(format!("its length {} is wrong", chunk.value));
        }
        let start = self.cursor.at();
        let left = self.cursor.rest().len();
        let length = usize::try_from(chunk.value).unwrap_or(usize::MAX);
        chunk.cut = length > left;
        let bytes = self.cursor.bytes(length.min(left))?;
        chunk.body = Cursor::new(bytes, start);
        if checked
            && !chunk.cut
            && let Some((own, &sum)) = bytes.split_last_chunk()
        {
            chunk.body = Cursor::new(own, start);
            chunk.checksum = Some(u32::from_le_bytes(sum));
        }
        Ok(())
    }
}

impl<'a> Iterator for Chunks<'a> {
    type Item = Chunk<'a>;

    fn next(&mut self) -> Option<Chunk<'a>> {
        if self.cursor.rest().is_empty() || self.fault.is_some() {
            return None;
        }
        let start = self.cursor;
        let chunk = self.chunk().ok();
        if chunk.is_none() {
            self.cursor = start;
            self.fault = Some(start.at());
        }
        chunk
    }
}

/// The checksum of bytes: CRC-32 as in zip files.
pub(super) fn checksum(bytes: &[u8]) -> u32 {
    let sum = bytes.iter().fold(u32::MAX, |sum, &byte| {
        let low = sum.to_le_bytes()[0] ^ byte;
        (sum >> 8) ^ TABLE[usize::from(low)]
    });
    !sum
}

const TABLE: [u32; 256] = {
    let mut table = [0; 256];
    let mut index = 0;
    while index < 256 {
        let mut sum = index as u32;
        let mut bit = 0;
        while bit < 8 {
            sum = (sum >> 1) ^ (0xEDB8_8320 & (sum & 1).wrapping_neg());
            bit += 1;
        }
        table[index] = sum;
        index += 1;
    }
    table
};
