//! A column of a table.

use std::fmt;

use crate::document::quoted;

/// So many columns a line has at most: as many as spreadsheets know.
pub const MOST_COLUMNS: usize = 16_384;

/// A column as messages and dialogs show it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableColumn {
    /// The number, counted from 1.
    pub number: usize,
    /// The name, if the table has one.
    pub name: Option<String>,
}

impl fmt::Display for TableColumn {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", self.number)?;
        match &self.name {
            Some(name) => write!(formatter, " {}", quoted(name)),
            None => Ok(()),
        }
    }
}
