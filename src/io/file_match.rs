//! Matches of ends between the curves of a file, which have no identities but their places in it.

use crate::document::{CurveId, Document, EditError, EndMatch, MatchPlace};
use crate::geometry::{Continuity, End};

/// An end that is matched to another curve of the same file: see [`EndMatch`]. Curves are given by
/// their places in the file, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FileMatch {
    /// The curve that follows.
    pub curve: usize,
    /// The end of it that does.
    pub end: End,
    /// The curve that it follows.
    pub source: usize,
    /// Where on that curve.
    pub place: MatchPlace,
    /// How much is matched.
    pub continuity: Continuity,
    /// Whether the curve passes the place against the direction of the other.
    pub reversed: bool,
}

impl FileMatch {
    /// List the matches of a document.
    pub(super) fn all(document: &Document) -> Vec<Self> {
        let place = |id| document.ids().position(|other| other == id);
        let matches = document.matches().filter_map(|matched| {
            Some(Self {
                curve: place(matched.curve)?,
                end: matched.end,
                source: place(matched.source)?,
                place: matched.place,
                continuity: matched.continuity,
                reversed: matched.reversed,
            })
        });
        matches.collect()
    }

    /// Find the match between curves of a document that have these identities, in the order of the
    /// file.
    ///
    /// # Errors
    /// [`EditError::NoSuchCurve`].
    pub fn between(&self, ids: &[CurveId]) -> Result<EndMatch, EditError> {
        let find = |index: usize| ids.get(index).copied().ok_or(EditError::NoSuchCurve);
        Ok(EndMatch {
            curve: find(self.curve)?,
            end: self.end,
            source: find(self.source)?,
            place: self.place,
            continuity: self.continuity,
            reversed: self.reversed,
        })
    }
}
