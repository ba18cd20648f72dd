//! What is derived from the blocks of a chain in one orientation, block by block.

use crate::analysis::Revision;
use crate::editor::view::orientation::Orientation;

/// Keep something of each block of samples or vertices, until the block or the orientation changes.
#[derive(Debug)]
pub struct Blocks<T> {
    /// From where it is seen.
    pub eye: Orientation,
    kept: Vec<(Revision, T)>,
}

impl<T> Default for Blocks<T> {
    fn default() -> Self {
        Self {
            eye: Orientation::default(),
            kept: Vec::new(),
        }
    }
}

impl<T> Blocks<T> {
    /// Make anew what is kept of blocks that have changed, by their numbers.
    pub fn update(
        &mut self,
        eye: Orientation,
        revisions: impl ExactSizeIterator<Item = Revision>,
        make: impl Fn(usize) -> T,
    ) {
        if self.eye != eye {
            self.eye = eye;
            self.kept.clear();
        }
        self.kept.truncate(revisions.len());
        for (index, revision) in revisions.enumerate() {
            match self.kept.get_mut(index) {
                Some((known, _)) if *known == revision => {}
                Some(kept) => *kept = (revision, make(index)),
                None => self.kept.push((revision, make(index))),
            }
        }
    }

    /// What is kept of each block, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &T> {
        self.kept.iter().map(|(_, kept)| kept)
    }

    /// What is kept of each block, to be changed.
    pub fn iter_mut(&mut self) -> impl ExactSizeIterator<Item = &mut T> {
        self.kept.iter_mut().map(|(_, kept)| kept)
    }
}
