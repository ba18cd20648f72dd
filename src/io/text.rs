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
