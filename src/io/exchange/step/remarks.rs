//! Remarks of a reader, each with line, entity and reason.

/// The remarks so far. A damaged file may have a flaw a line: beyond a thousand they are counted only.
#[derive(Debug, Default)]
pub struct Remarks {
    texts: Vec<String>,
    more: usize,
}

const MOST: usize = 1000;

impl Remarks {
    /// Add a remark.
    pub fn add(&mut self, line: u64, entity: &str, reason: &str) {
        if self.texts.len() < MOST {
            self.texts.push(format!("line {line}: {entity}: {reason}"));
        } else {
            self.more += 1;
        }
    }

    /// Take all remarks.
    pub fn into_texts(mut self) -> Vec<String> {
        if self.more > 0 {
            self.texts
                .push(format!("{} more remarks of this kind", self.more));
        }
        self.texts
    }
}
