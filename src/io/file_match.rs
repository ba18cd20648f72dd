//! Matches of ends between the curves of a file, which have no identities but their places in it.

use crate::document::{CurveId, Document, EditError, EndMatch, MatchPlace};
use crate::geometry::{Continuity, End};

/// An end that is matched to another curve or to a reference of the same file: see [`EndMatch`]. Curves are given by
/// their places in the file, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FileMatch {
    /// The curve that follows.
    pub curve: usize,
    /// The matched end.
    pub end: End,
    /// The source of the match.
    pub source: MatchSource,
    /// Where on that curve.
    pub place: MatchPlace,
    /// How much is matched.
    pub continuity: Continuity,
    /// Whether the curve passes the place against the direction of the other.
    pub reversed: bool,
}

/// The source of a match, by its place in the file, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatchSource {
    /// A curve.
    Curve(usize),
    /// A reference.
    Reference(usize),
}

impl FileMatch {
    /// List the matches of a document.
    pub(super) fn all(document: &Document) -> Vec<Self> {
        let place = |id| document.ids().position(|other| other == id);
        let source = |id| match place(id) {
            Some(place) => Some(MatchSource::Curve(place)),
            None => {
                let mut references = document.references();
                let place = references.position(|(other, _)| other == id);
                place.map(MatchSource::Reference)
            }
        };
        let matches = document.matches().filter_map(|matched| {
            Some(Self {
                curve: place(matched.curve)?,
                end: matched.end,
                source: source(matched.source)?,
                place: matched.place,
                continuity: matched.continuity,
                reversed: matched.reversed,
            })
        });
        matches.collect()
    }

    /// Find the match between curves and references of a document that have these identities, in the
    /// order of the file.
    ///
    /// # Errors
    /// [`EditError::NoSuchCurve`].
    pub fn between(
        &self,
        curves: &[CurveId],
        references: &[CurveId],
    ) -> Result<EndMatch, EditError> {
        let find = |ids: &[CurveId], index: usize| {
            let found = ids.get(index).copied();
            found.ok_or(EditError::NoSuchCurve)
        };
        Ok(EndMatch {
            curve: find(curves, self.curve)?,
            end: self.end,
            source: match self.source {
                MatchSource::Curve(index) => find(curves, index)?,
                MatchSource::Reference(index) => find(references, index)?,
            },
            place: self.place,
            continuity: self.continuity,
            reversed: self.reversed,
        })
    }
}
