//! Bytes in the making: numbers, strings and chunks of an archive of version 4.

use glam::DVec3;

use super::chunks::{CHECKED, CLASS, CLASS_DATA, CLASS_END, CLASS_ID, checksum};

/// The bytes of a part of a file.
#[derive(Clone, Default)]
pub(super) struct Output {
    bytes: Vec<u8>,
}

impl Output {
    pub(super) fn len(&self) -> usize {
        self.bytes.len()
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    pub(super) fn bytes(mut self, bytes: &[u8]) -> Self {
        self.bytes.extend_from_slice(bytes);
        self
    }

    pub(super) fn append(self, other: &Self) -> Self {
        self.bytes(&other.bytes)
    }

    pub(super) fn byte(self, byte: u8) -> Self {
        self.bytes(&[byte])
    }

    pub(super) fn int(self, int: i32) -> Self {
        self.bytes(&int.to_le_bytes())
    }

    pub(super) fn word(self, word: u32) -> Self {
        self.bytes(&word.to_le_bytes())
    }

    /// A count or a length. No file is written in which one of them is larger than the largest.
    pub(super) fn count(self, count: usize) -> Self {
        self.int(i32::try_from(count).unwrap_or(i32::MAX))
    }

    pub(super) fn numbers(self, numbers: &[f64]) -> Self {
        numbers
            .iter()
            .fold(self, |output, number| output.bytes(&number.to_le_bytes()))
    }

    pub(super) fn point(self, point: DVec3) -> Self {
        self.numbers(&point.to_array())
    }

    pub(super) fn id(self, id: u128) -> Self {
        let [a, b, c, d, e, f, g, h, tail @ ..] = id.to_be_bytes();
        self.bytes(&[d, c, b, a, f, e, h, g]).bytes(&tail)
    }

    pub(super) fn text(self, text: &str) -> Self {
        if text.is_empty() {
            return self.count(0);
        }
        let units: Vec<u16> = text.encode_utf16().chain([0]).collect();
        let output = self.count(units.len());
        units
            .iter()
            .fold(output, |output, unit| output.bytes(&unit.to_le_bytes()))
    }

    /// A colour, opaque.
    pub(super) fn colour(self, [red, green, blue]: [u8; 3]) -> Self {
        self.bytes(&[red, green, blue, 0])
    }

    /// A chunk without nested ones.
    pub(super) fn chunk(self, code: u32, body: &Self) -> Self {
        let sum = checksum(&body.bytes);
        self.checked(code, body, sum)
    }

    /// A chunk of chunks: its checksum covers none of them.
    pub(super) fn container(self, code: u32, body: &Self) -> Self {
        self.checked(code, body, 0)
    }

    fn checked(self, code: u32, body: &Self, sum: u32) -> Self {
        let checked = code & CHECKED != 0;
        let length = body.len() + if checked { 4 } else { 0 };
        let output = self.word(code).count(length).bytes(&body.bytes);
        if checked { output.word(sum) } else { output }
    }

    /// A chunk that has a value in place of bytes.
    pub(super) fn short(self, code: u32, value: i32) -> Self {
        self.word(code).int(value)
    }

    /// An object of a class. `own` are the bytes of its data outside of nested chunks.
    pub(super) fn object(self, class: u128, data: &Self, own: &Self) -> Self {
        let body = Self::default()
            .chunk(CLASS_ID, &Self::default().id(class))
            .checked(CLASS_DATA, data, checksum(&own.bytes))
            .short(CLASS_END, 0);
        self.container(CLASS, &body)
    }
}
