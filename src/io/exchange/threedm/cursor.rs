//! Numbers, strings and ids in order, each read within the bounds of its chunk.

use glam::DVec3;

use crate::io::exchange::short_names::{beginning, short};

/// A place in the bytes of a chunk.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    /// Start at the first of `bytes`, which is the byte `at` of the file, counted from 0.
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    /// What is left.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes
    }

    /// The place of the next byte in the file, counted from 0.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// Take the next `count` bytes.
    pub(super) fn bytes(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = self
            .bytes
            .split_at_checked(count)
            .ok_or_else(|| "its data end too early".to_owned())?;
        self.bytes = rest;
        self.at = self.at.saturating_add(count);
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut array = [0; N];
        array.copy_from_slice(self.bytes(N)?);
        Ok(array)
    }

    /// Read one byte.
    pub(super) fn byte(&mut self) -> Result<u8, String> {
        Ok(u8::from_le_bytes(self.array()?))
    }

    /// Read an integer of 32 bits.
    pub(super) fn int(&mut self) -> Result<i32, String> {
        Ok(i32::from_le_bytes(self.array()?))
    }

    /// Read an unsigned integer of 32 bits.
    pub(super) fn word(&mut self) -> Result<u32, String> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    /// Read a number.
    pub(super) fn number(&mut self) -> Result<f64, String> {
        Ok(f64::from_le_bytes(self.array()?))
    }

    /// Read three numbers as a point.
    pub(super) fn point(&mut self) -> Result<DVec3, String> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }

    /// Read two numbers as an interval.
    pub(super) fn interval(&mut self) -> Result<(f64, f64), String> {
        Ok((self.number()?, self.number()?))
    }

    /// Read the version that begins most data: major and minor in one byte.
    pub(super) fn version(&mut self) -> Result<(u8, u8), String> {
        let byte = self.byte()?;
        Ok((byte >> 4, byte & 15))
    }

    /// Read the count of what follows, `size` bytes or more each.
    pub(super) fn count(&mut self, size: usize) -> Result<usize, String> {
        let count = self.int()?;
        match usize::try_from(count) {
            Ok(count) if count.saturating_mul(size) <= self.bytes.len() => Ok(count),
            _ => Err(format!("its count {count} is wrong")),
        }
    }

    /// Read a counted array of numbers.
    pub(super) fn numbers(&mut self) -> Result<Vec<f64>, String> {
        let count = self.count(8)?;
        (0..count).map(|_| self.number()).collect()
    }

    /// Read a counted array of points.
    pub(super) fn points(&mut self) -> Result<Vec<DVec3>, String> {
        let count = self.count(24)?;
        (0..count).map(|_| self.point()).collect()
    }

    /// Read a class, object or layer id, as it is printed.
    pub(super) fn id(&mut self) -> Result<u128, String> {
        let [a, b, c, d, e, f, g, h, tail @ ..] = self.array::<16>()?;
        let [i, j, k, l, m, n, o, p] = tail;
        Ok(u128::from_be_bytes([
            d, c, b, a, f, e, h, g, i, j, k, l, m, n, o, p,
        ]))
    }

    /// Read a counted array of ids.
    pub(super) fn ids(&mut self) -> Result<Vec<u128>, String> {
        let count = self.count(16)?;
        (0..count).map(|_| self.id()).collect()
    }

    /// Read a name of UTF-16 units, the last of them 0.
    pub(super) fn text(&mut self) -> Result<String, String> {
        let count = self.count(2)?;
        let bytes = self.bytes(count.saturating_mul(2))?;
        let units: Vec<u16> = beginning(bytes)
            .as_chunks::<2>()
            .0
            .iter()
            .map(|&unit| u16::from_le_bytes(unit))
            .take_while(|&unit| unit != 0)
            .collect();
        Ok(short(&String::from_utf16_lossy(&units)))
    }

    /// Read a colour: red, green, blue and transparency; `None` if it is unset.
    pub(super) fn colour(&mut self) -> Result<Option<[u8; 3]>, String> {
        let [red, green, blue, alpha] = self.array()?;
        let unset = [red, green, blue, alpha] == [u8::MAX; 4];
        Ok((!unset).then_some([red, green, blue]))
    }
}
