//! `batten convert` and `batten example`: curves written to files.

use anyhow::{Context, bail};

use super::ends::{Destination, Source};
use super::output::Messages;
use crate::document::Document;
use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;
use crate::io::examples::Example;
use crate::io::{Export, Format};

/// Write the curves of a source. What cannot be read back is refused without `force`.
///
/// # Errors
/// If the source cannot be read or the destination not be written; nothing is written then.
pub(super) fn convert(
    source: &Source,
    destination: &Destination,
    polygon: Option<PolygonKind>,
    assumed_unit: Option<LengthUnit>,
    force: bool,
) -> anyhow::Result<()> {
    if destination.is(source) {
        bail!(
            "{}: a file is not converted into itself",
            destination.name()
        );
    }
    let document = source.document(assumed_unit, &Messages::Printed)?;
    let (export, format) = exported(&document, destination, polygon)?;
    // A float polygon is read back as it is.
    let is_converted = polygon.is_some_and(|kind| kind != PolygonKind::Float);
    if is_converted
        && !force
        && let Err(error) = format.read(&export.bytes)
    {
        bail!(
            "{}: what would be written cannot be read back: {error}. Nothing is written; --force writes it all the same",
            destination.name()
        );
    }
    destination.write(export, &Messages::Printed)
}

/// Write an example.
///
/// # Errors
/// If the destination cannot be written.
pub(super) fn example(example: &Example, destination: &Destination) -> anyhow::Result<()> {
    let document = example.read()?.into_document()?;
    let (export, _) = exported(&document, destination, None)?;
    destination.write(export, &Messages::Printed)
}

fn exported(
    document: &Document,
    destination: &Destination,
    polygon: Option<PolygonKind>,
) -> anyhow::Result<(Export, &'static Format)> {
    let format = destination.format()?;
    let export = format.write(document, polygon);
    Ok((export.with_context(|| destination.name())?, format))
}
