//! Remarks and counts of a reader, of which a damaged file may cause very many.

use crate::io::exchange::drawing::Drawing;

/// The most remarks that are kept; nobody reads more, and each takes memory.
const LIMIT: usize = 1000;

/// The most kinds that are counted each; each costs a comparison for all that follow.
const KIND_LIMIT: usize = 200;

/// Count something that is not a curve; above a limit, kinds are counted together.
pub(super) fn count(drawing: &mut Drawing, kind: &str, at: u64) {
    let known = drawing.other.len() < KIND_LIMIT || drawing.other.iter().any(|it| it.kind == kind);
    drawing.count_other(if known { kind } else { "further kinds" }, at);
}

/// The remarks of a reader; those above a limit are only counted.
#[derive(Default)]
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

    /// Get all remarks.
    pub(super) fn finish(mut self) -> Vec<String> {
        if self.more > 0 {
            self.kept
                .push(format!("and {} more remarks of this kind", self.more));
        }
        self.kept
    }
}
