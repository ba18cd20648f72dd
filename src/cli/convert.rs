//! `batten convert` and `batten example`: curves written to files.

use anyhow::{Context, bail};

use super::ends::{Destination, Source};
use super::output::{self, Messages};
use crate::document::{Document, quoted};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{PolygonKind, Progress, counted, rounded_up};
use crate::io::examples::Example;
use crate::io::{Export, Format};
use crate::operations::lowered;

/// Which degrees are lowered.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lowering {
    /// The highest degree that is written.
    pub(super) most: usize,
    /// How far curves may move.
    pub(super) tolerance: Option<f64>,
}

impl Lowering {
    /// Approximate the curves of higher degrees, and tell how far each of them moves.
    fn of(self, document: &Document) -> anyhow::Result<Document> {
        let Self { most, tolerance } = self;
        let (lower, told) = lowered(document, most, tolerance, &Progress::default())?;
        for it in told {
            let within = match it.is_within {
                true => "",
                false => ", which is more than the tolerance",
            };
            let features = it.changed.map_or_else(String::new, |[before, now]| {
                let [inflections, extrema] = [0, 1].map(|kind| (before[kind], now[kind]));
                format!(
                    "; inflections: {} before, {} now; curvature extrema: {} before, {} now",
                    inflections.0, inflections.1, extrema.0, extrema.1
                )
            });
            output::message(&format!(
                "{}: degree {} becomes {most}, {}, off by at most {}{within}{features}",
                quoted(&it.name),
                it.degree,
                counted(it.vertices, "vertex", "vertices"),
                rounded_up(it.deviation),
            ));
        }
        Ok(lower)
    }
}

/// Write the curves of a source. What cannot be read back is refused without `force`.
///
/// # Errors
/// If the source cannot be read or the destination not be written; nothing is written then.
pub(super) fn convert(
    source: &Source,
    destination: &Destination,
    polygon: Option<PolygonKind>,
    assumed_unit: Option<LengthUnit>,
    lowering: Option<Lowering>,
    force: bool,
) -> anyhow::Result<()> {
    if destination.is(source) {
        bail!(
            "{}: a file is not converted into itself",
            destination.name()
        );
    }
    let document = source.document(assumed_unit, &Messages::Printed)?;
    let document = match lowering {
        Some(lowering) => lowering.of(&document).with_context(|| source.name())?,
        None => document,
    };
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
