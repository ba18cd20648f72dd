//! Words of a text between blanks, with their lines.

use glam::DVec3;

use crate::io::exchange::drawing::Unreadable;

/// The rest of a text.
#[derive(Clone)]
pub(super) struct Tokens<'a> {
    rest: &'a [u8],
    /// The current line, from 1.
    line: u64,
}

impl<'a> Tokens<'a> {
    pub fn of(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            line: 1,
        }
    }

    /// Give the line of the next word.
    pub fn line(&mut self) -> u64 {
        self.skip_blanks();
        self.line
    }

    /// Take the next word.
    pub fn next(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let length = self
            .rest
            .iter()
            .take_while(|byte| !byte.is_ascii_whitespace())
            .count();
        let (word, rest) = self
            .rest
            .split_at_checked(length)
            .filter(|(word, _)| !word.is_empty())?;
        self.rest = rest;
        Some(word)
    }

    /// Give the next word without taking it.
    pub fn peek(&self) -> Option<&'a [u8]> {
        self.clone().next()
    }

    /// Skip words up to one and take it; `false` if it does not occur.
    pub fn skip_to(&mut self, word: &[u8]) -> bool {
        std::iter::from_fn(|| self.next()).any(|found| found == word)
    }

    /// Count the bytes left: no list is longer.
    pub fn left(&self) -> usize {
        self.rest.len()
    }

    /// Take a finite number.
    ///
    /// # Errors
    /// [`Unreadable`] with the line if there is none.
    pub fn number(&mut self) -> Result<f64, Unreadable> {
        let word = self.next();
        let text = word.and_then(|word| std::str::from_utf8(word).ok());
        let value = text.and_then(|text| text.parse::<f64>().ok());
        value
            .filter(|value| value.is_finite())
            .ok_or_else(|| self.fault("a number", word))
    }

    /// Take three numbers.
    ///
    /// # Errors
    /// As [`Self::number`].
    pub fn point(&mut self) -> Result<DVec3, Unreadable> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }

    /// Take a whole number.
    ///
    /// # Errors
    /// [`Unreadable`] with the line if there is none.
    pub fn integer(&mut self) -> Result<i64, Unreadable> {
        let word = self.next();
        let text = word.and_then(|word| std::str::from_utf8(word).ok());
        text.and_then(|text| text.parse().ok())
            .ok_or_else(|| self.fault("a whole number", word))
    }

    /// Take a count of things that follow, each with two bytes at least.
    ///
    /// # Errors
    /// As [`Self::integer`], and where the text is too short for them.
    pub fn count(&mut self) -> Result<usize, Unreadable> {
        let value = self.integer()?;
        let most = self.left() / 2 + 1;
        usize::try_from(value)
            .ok()
            .filter(|count| *count <= most)
            .ok_or_else(|| Unreadable {
                at: Some(self.line),
                reason: format!("a count of {value}, but only {} bytes follow", self.left()),
            })
    }

    /// Say what was expected.
    pub fn fault(&self, expected: &str, found: Option<&[u8]>) -> Unreadable {
        let found = match found {
            Some(word) => format!(
                "\"{}\"",
                String::from_utf8_lossy(word.get(..20).unwrap_or(word))
            ),
            None => "the end of the file".to_owned(),
        };
        Unreadable {
            at: Some(self.line),
            reason: format!("{expected} is expected, not {found}"),
        }
    }

    fn skip_blanks(&mut self) {
        while let Some((byte, rest)) = self
            .rest
            .split_first()
            .filter(|(byte, _)| byte.is_ascii_whitespace())
        {
            self.line = self.line.saturating_add(u64::from(*byte == b'\n'));
            self.rest = rest;
        }
    }
}
