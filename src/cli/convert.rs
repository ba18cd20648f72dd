//! `batten convert` and `batten example`: curves written to files.

use anyhow::{Context, bail};

use super::ends::{Destination, Source};
use super::output::{self, Messages};
use crate::document::{Document, quoted};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{PolygonKind, Progress, counted, rounded_up};
use crate::io::examples::Example;
use crate::io::{Export, Format};
use crate::operations::{FloatWish, floated, lowered};

/// What happens on the way from one file to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Conversion {
    /// The polygon to write.
    pub(super) polygon: Option<PolygonKind>,
    /// The unit of what states none.
    pub(super) assumed_unit: Option<LengthUnit>,
    /// Whether float polygons are made of references.
    pub(super) to_float: bool,
    /// The highest degree that is written.
    pub(super) most_degree: Option<usize>,
    /// How far curves may move that get a lower degree or a float polygon.
    pub(super) tolerance: Option<f64>,
    /// Whether to write what cannot be read back.
    pub(super) force: bool,
}

impl Conversion {
    /// Make float polygons of references and lower degrees, and tell how far each curve moves.
    fn of(&self, document: Document) -> anyhow::Result<Document> {
        let document = match self.to_float {
            false => document,
            true => {
                let wish = FloatWish {
                    degree: None,
                    tolerance: self.tolerance,
                };
                let (made, told) = floated(&document, wish, &Progress::default())?;
                told.iter().for_each(|line| output::message(line));
                made
            }
        };
        let Some(most) = self.most_degree else {
            return Ok(document);
        };
        let (lower, told) = lowered(&document, most, self.tolerance, &Progress::default())?;
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
    conversion: &Conversion,
) -> anyhow::Result<()> {
    let Conversion { polygon, force, .. } = *conversion;
    if destination.is(source) {
        bail!(
            "{}: a file is not converted into itself",
            destination.name()
        );
    }
    let document = source.document(conversion.assumed_unit, &Messages::Printed)?;
    let document = conversion.of(document).with_context(|| source.name())?;
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
