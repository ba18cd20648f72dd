//! `batten edit`: a file of another program, saved back in its own format.

use std::path::Path;

use crate::io::{FileError, disk, formats};

/// Check that a file can be written back, before a window opens.
///
/// # Errors
/// If its format can only be read, or the file cannot be replaced.
pub(super) fn check(file: &Path) -> anyhow::Result<()> {
    formats::to_write(file).map_err(FileError::at(file))?;
    Ok(disk::check_replaceable(file)?)
}
