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

    /// Make the replacements; `None` if parts overlap or are no parts of the text.
    pub(super) fn applied(mut self, text: &str) -> Option<String> {
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
