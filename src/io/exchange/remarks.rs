//! Remarks of a reader, of which a damaged file may cause very many.

/// The most remarks that are kept; nobody reads more, and each takes memory.
const LIMIT: usize = 1000;

/// The letters of the longest remark.
const LONGEST: usize = 1000;

/// The remarks of a reader; those above a limit are only counted.
#[derive(Debug, Default)]
pub(super) struct Remarks {
    kept: Vec<String>,
    more: usize,
}

/// Cut a remark that is too long: it may name what the file holds.
pub(in crate::io) fn shortened(mut remark: String) -> String {
    if let Some((end, _)) = remark.char_indices().nth(LONGEST) {
        remark.truncate(end);
        remark.push('…');
        remark.shrink_to_fit();
    }
    remark
}

impl Remarks {
    /// Whether more remarks are only counted.
    pub(super) fn are_full(&self) -> bool {
        self.kept.len() >= LIMIT
    }

    /// Add a remark.
    pub(super) fn add(&mut self, remark: String) {
        if !self.are_full() {
            self.kept.push(shortened(remark));
        } else {
            self.more += 1;
        }
    }

    /// Add a remark on an entity, by its line.
    pub(super) fn add_at(&mut self, line: u64, entity: &str, reason: &str) {
        self.add(format!("line {line}: {entity}: {reason}"));
    }

    /// Get all remarks.
    pub(super) fn finish(mut self) -> Vec<String> {
        if self.more > 0 {
            self.kept
                .push(format!("and {} more remarks of this kind", self.more));
        }
        self.kept
    }
}
