//! `batten convert` and `batten example`: curves written to files.

use anyhow::{Context, bail};

use super::ends::{Destination, Source};
use crate::geometry::PolygonKind;
use crate::io::examples::Example;
use crate::io::{Export, Format, Reading};

/// Write the curves of a source. What cannot be read back is refused without `force`.
///
/// # Errors
/// If the source cannot be read or the destination not be written; nothing is written then.
pub(super) fn convert(
    source: &Source,
    destination: &Destination,
    polygon: Option<PolygonKind>,
    force: bool,
) -> anyhow::Result<()> {
    if destination.is(source) {
        bail!(
            "{}: a file is not converted into itself",
            destination.name()
        );
    }
    let reading = source.read()?;
    let (export, format) = exported(&reading, destination, polygon)?;
    // The float polygon is what is read: nothing can happen to it.
    let is_converted = polygon.is_some_and(|kind| kind != PolygonKind::Float);
    if is_converted
        && !force
        && format.can_read()
        && let Err(error) = format.read(&export.bytes)
    {
        bail!(
            "{}: what would be written cannot be read back: {error}. Nothing is written; --force writes it all the same",
            destination.name()
        );
    }
    destination.write(export)
}

/// Write an example.
///
/// # Errors
/// If the destination cannot be written.
pub(super) fn example(example: &Example, destination: &Destination) -> anyhow::Result<()> {
    let reading = example.read()?;
    destination.write(exported(&reading, destination, None)?.0)
}

fn exported(
    reading: &Reading,
    destination: &Destination,
    polygon: Option<PolygonKind>,
) -> anyhow::Result<(Export, Format)> {
    let format = destination.format()?;
    let document = reading.clone().into_document()?;
    let export = format.write_document(&document, polygon);
    Ok((export.with_context(|| destination.name())?, format))
}
