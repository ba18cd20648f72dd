//! Remarks of a reader, of which a damaged file may cause very many.

/// The most remarks that are kept; nobody reads more, and each takes memory.
const LIMIT: usize = 1000;

/// The remarks of a reader; those above a limit are only counted.
#[derive(Debug, Default)]
pub(super) struct Remarks {
    kept: Vec<String>,
    more: usize,
}

impl Remarks {
    /// Add a remark.
    pub(super) fn add(&mut self, remark: String) {
        if self.kept.len() < LIMIT {
            self.kept.push(remark);
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
