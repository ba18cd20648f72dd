//! Telling what changed from what did not.

use std::sync::atomic::{AtomicU64, Ordering};

/// Name one state of something that changes: two states that were made apart never share a name.
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
