//! Edits of a text at places of it.

use std::ops::Range;

/// Replacements in a text.
#[derive(Debug, Default)]
pub(super) struct TextEdits(Vec<(Range<usize>, String)>);

impl TextEdits {
    /// Replace a part of the text. Parts must not overlap.
    pub(super) fn replace(&mut self, part: Range<usize>, by: impl Into<String>) {
        self.0.push((part, by.into()));
    }

    /// Make the replacements in the text of a file, which may have bytes before it.
    ///
    /// # Errors
    /// The reason, if parts overlap or are no parts of the text.
    pub(super) fn written(
        self,
        bytes: &[u8],
        text: &str,
        before: usize,
    ) -> Result<Vec<u8>, String> {
        let edited = self.applied(text);
        let edited = edited.ok_or("two changes meet in one place of the file")?;
        let mut written = bytes.get(..before).unwrap_or_default().to_vec();
        written.extend(edited.into_bytes());
        Ok(written)
    }

    /// Make the replacements; `None` if parts overlap or are no parts of the text.
    fn applied(mut self, text: &str) -> Option<String> {
        self.0.sort_by_key(|(part, _)| (part.start, part.end));
        let mut edited = String::with_capacity(text.len());
        let mut at = 0;
        for (part, by) in &self.0 {
            edited.push_str(text.get(at..part.start)?);
            edited.push_str(by);
            text.get(part.clone())?;
            at = part.end;
        }
        edited.push_str(text.get(at..)?);
        Some(edited)
    }
}
