//! Remarks about a file.

use std::collections::HashSet;

use super::groups::Trouble;
use crate::io::exchange::remarks::shortened;

/// The most remarks that are kept. A file with more is damaged as a whole: the rest is counted.
const MOST: usize = 1000;

/// The remarks so far.
#[derive(Debug)]
pub struct Notes {
    /// Whether places are lines, not bytes.
    lines: bool,
    remarks: Vec<String>,
    left_out: usize,
    /// The places of entities that were remarked on when they were placed.
    placed: HashSet<u64>,
}

impl Notes {
    /// Start without remarks, on places in lines or in bytes.
    pub fn new(lines: bool) -> Self {
        Self {
            lines,
            remarks: Vec::new(),
            left_out: 0,
            placed: HashSet::new(),
        }
    }

    /// Remark on a place.
    pub fn add(&mut self, at: u64, remark: impl std::fmt::Display) {
        if self.remarks.len() >= MOST {
            self.left_out = self.left_out.saturating_add(1);
            return;
        }
        let unit = self.unit();
        self.remarks
            .push(shortened(format!("{unit} {at}: {remark}")));
    }

    /// Remark on an entity at most once, however often its block is inserted.
    pub fn add_once(&mut self, at: u64, remark: impl std::fmt::Display) {
        if self.placed.len() >= MOST || self.placed.insert(at) {
            self.add(at, remark);
        }
    }

    /// Remark that an entity is skipped.
    pub fn skip(&mut self, name: &str, trouble: &Trouble) {
        self.add(
            trouble.at,
            format_args!("{name} skipped: {}", trouble.reason),
        );
    }

    /// Remark on the file as a whole.
    pub fn add_whole(&mut self, remark: impl Into<String>) {
        self.remarks.push(remark.into());
    }

    /// Take all remarks.
    pub fn into_remarks(self) -> Vec<String> {
        let mut remarks = self.remarks;
        if self.left_out > 0 {
            remarks.push(format!("{} more remarks are left out", self.left_out));
        }
        remarks
    }

    fn unit(&self) -> &'static str {
        if self.lines { "line" } else { "byte" }
    }
}
