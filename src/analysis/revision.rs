//! Revisions: names for the states of a part, to tell what changed.

use std::sync::atomic::{AtomicU64, Ordering};

/// Name one state of a part. Two states never share a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Revision(u64);

impl Revision {
    /// Name a new state.
    pub fn new() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

impl Default for Revision {
    fn default() -> Self {
        Self::new()
    }
}
