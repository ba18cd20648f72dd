//! The bytes of a file as text.

use super::error::{Place, Problem, ReadError};

/// Take a file's bytes as text, without the mark that some editors put before it.
///
/// # Errors
/// [`Problem::Empty`] or [`Problem::NotUtf8`].
pub(super) fn text(bytes: &[u8]) -> Result<&str, ReadError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let valid = &bytes[..error.valid_up_to()];
        let line_start = valid.iter().rposition(|byte| *byte == b'\n');
        let place = Place {
            line: Some(1 + valid.iter().filter(|byte| **byte == b'\n').count()),
            column: Some(valid.len() - line_start.map_or(0, |start| start + 1) + 1),
            ..Place::default()
        };
        place.problem(Problem::NotUtf8)
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(Problem::Empty.into());
    }
    Ok(text)
}

/// Where the lines of a text begin.
pub(super) struct Lines(Vec<usize>);

impl Lines {
    /// Find the lines of a text.
    pub(super) fn of(text: &str) -> Self {
        Self(text.match_indices('\n').map(|(at, _)| at + 1).collect())
    }

    /// The number of the line that holds a byte, from 1.
    pub(super) fn number(&self, position: usize) -> usize {
        self.0.partition_point(|start| *start <= position) + 1
    }

    /// Where a line begins, by its number from 1; `None` if there is none.
    pub(super) fn start(&self, number: usize) -> Option<usize> {
        match number {
            0 | 1 => Some(0),
            _ => self.0.get(number - 2).copied(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_in_lines() {
        let lines = Lines::of("a\nbc\n\nd");
        let numbers = [0, 1, 2, 3, 4, 5, 6, 9].map(|at| lines.number(at));
        assert_eq!(numbers, [1, 1, 2, 2, 2, 3, 4, 4]);
        let starts = [0, 1, 2, 3, 4, 5].map(|number| lines.start(number));
        assert_eq!(starts, [Some(0), Some(0), Some(2), Some(5), Some(6), None]);
    }
}
