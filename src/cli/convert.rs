//! `batten convert` and `batten example`: curves written to files.

use anyhow::{Context, bail};

use super::ends::{Destination, Source};
use super::export_arguments::ExportArguments;
use super::output::{self, Messages};
use super::progress::watched;
use crate::document::Document;
use crate::geometry::PolygonKind;
use crate::geometry::expressions::LengthUnit;
use crate::io::examples::Example;
use crate::io::{Export, ExportChoice};
use crate::operations::{FloatRequest, floated, lowered};

/// What happens on the way from one file to another.
#[derive(Debug)]
pub(super) struct Conversion {
    /// The polygon to write.
    pub(super) polygon: Option<PolygonKind>,
    /// The unit of what states none.
    pub(super) assumed_unit: Option<LengthUnit>,
    /// Whether float polygons are made of references.
    pub(super) to_float: bool,
    /// The highest degree that is written.
    pub(super) most_degree: Option<usize>,
    /// The largest deviation of lower degrees, float polygons and cubic Béziers.
    pub(super) tolerance: Option<f64>,
    /// What is written and how.
    pub(super) export: ExportArguments,
    /// Whether to write what cannot be read back.
    pub(super) force: bool,
}

impl Conversion {
    /// Make float polygons of references, and tell how far each is off.
    fn floated(&self, document: Document) -> anyhow::Result<Document> {
        if !self.to_float {
            return Ok(document);
        }
        let request = FloatRequest {
            degree: None,
            tolerance: self.tolerance,
        };
        let (made, told) = watched("float polygons", |progress| {
            floated(&document, request, progress)
        })?;
        told.iter().for_each(|line| output::message(line));
        Ok(made)
    }

    /// Lower the degrees that are too high, and tell how far each curve moves.
    fn lowered(&self, document: Document, most: Option<usize>) -> anyhow::Result<Document> {
        let Some(most) = self.most_degree.or(most) else {
            return Ok(document);
        };
        let (lower, told) = watched("lower degrees", |progress| {
            lowered(&document, most, self.tolerance, progress)
        })?;
        for it in told {
            output::message(&it.to_string());
        }
        Ok(lower)
    }

    /// Write a document as the options say.
    fn written(&self, document: Document, destination: &Destination) -> anyhow::Result<Export> {
        let format = destination.format()?;
        let place = || destination.name();
        let document = destination.placed(document);
        match self.export.choice(format, &document)? {
            None => {
                let document = self.lowered(document, None)?;
                let choice = ExportChoice {
                    tolerance: self.tolerance,
                    ..ExportChoice::new(format)
                };
                let export = match choice.holds_cubics_alone() {
                    true => choice.write(&document),
                    false => format.write(&document, self.polygon),
                };
                export.with_context(place)
            }
            Some((choice, items)) => {
                let choice = ExportChoice {
                    knots: self.polygon,
                    tolerance: self.tolerance,
                    ..choice
                };
                let chosen = choice.chosen(&document, &items).with_context(place)?;
                let lower = self.lowered(chosen, choice.most_degree)?;
                choice.write(&lower).with_context(place)
            }
        }
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
    let Conversion { polygon, force, .. } = conversion;
    if destination.is(source) {
        bail!(
            "{}: a file is not converted into itself",
            destination.name()
        );
    }
    let document = source.document(conversion.assumed_unit, &Messages::Printed)?;
    let document = conversion.floated(document);
    let document = document.with_context(|| source.name())?;
    let export = conversion.written(document, destination)?;
    let format = destination.format()?;
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
    let export = destination.format()?.write(&document, None);
    let export = export.with_context(|| destination.name())?;
    destination.write(export, &Messages::Printed)
}
