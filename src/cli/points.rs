//! `batten points`: points on a curve, written as a table.

use anyhow::{Context, anyhow, bail};
use glam::DVec3;

use super::ends::{Destination, Source};
use super::items::only;
use super::output::{self, Messages};
use crate::document::{CurveId, Document, Reference, quoted};
use crate::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use crate::geometry::{
    ParametricCurve, Spacing, counted, polyline_deviation, polyline_within, rounded_up,
};
use crate::io::WriteError;

/// How many points are placed.
#[derive(Clone, Copy, Debug)]
pub(super) enum Density {
    /// This many, spread so.
    Count(usize, Spacing),
    /// As few as keep the polyline this near to the curve; spread so, or with legs as long as each can be.
    Tolerance(f64, Option<Spacing>),
}

/// Write points on a curve or reference of a file, chosen by its name with an option, and say how near to it the polyline through them is.
///
/// # Errors
/// If the source cannot be read, no curve is chosen, or the destination cannot be written.
pub(super) fn run(
    source: &Source,
    destination: &Destination,
    density: Density,
    (name, option): (Option<&str>, &str),
) -> anyhow::Result<()> {
    let format = destination.format()?;
    let document = source.document(None, &Messages::Printed)?;
    let id = only(&document, name, option).with_context(|| source.name())?;
    let curve: &dyn ParametricCurve = match (document.curve(id), document.reference(id)) {
        (Some(curve), _) => &curve.polygon,
        (None, Some(reference)) => &reference.curve,
        (None, None) => bail!("{}: there is no curve", source.name()),
    };
    let title = title(&document, id);
    let parameters = match density {
        Density::Count(count, spacing) => Ok(spacing.parameters(curve, count)),
        Density::Tolerance(tolerance, spacing) => {
            let found = match spacing {
                Some(spacing) => spacing.within(curve, tolerance),
                None => polyline_within(curve, tolerance),
            };
            found.ok_or_else(|| {
                anyhow!(
                    "{}: {} would take more than 100 000 points within {tolerance:e}: allow more",
                    source.name(),
                    quoted(title)
                )
            })
        }
    }?;
    let points: Vec<DVec3> = parameters.iter().map(|u| curve.jet(*u).point).collect();
    let list = PointList::new(points)?;
    let reference = Reference::new(title, ReferenceCurve::of(ReferenceForm::Points(list))?);
    let points = Document::default().with_references([reference]);
    let export = format.write(&points.with_unit(document.unit()), None);
    let export = export.map_err(|error| match error {
        WriteError::NoCurves { format } => {
            anyhow!("{format} files hold curves, no tables of points: use .csv or .dat")
        }
        error => error.into(),
    });
    let export = export.with_context(|| destination.name())?;
    destination.write(export, &Messages::Printed)?;
    output::message(&format!(
        "{}; the polyline through them is within {} of {}",
        counted(parameters.len(), "point", "points"),
        rounded_up(polyline_deviation(curve, &parameters)),
        quoted(document.name(id).unwrap_or_default()),
    ));
    Ok(())
}

/// The title of the table: the name of the only list of points beside the only curve, which was made of it, or
/// that of the item.
fn title(document: &Document, id: CurveId) -> &str {
    let mut lists = document
        .references()
        .filter(|(_, it)| it.points().is_some());
    let is_only = document.curves().count() == 1 && document.curve(id).is_some();
    let name = match (lists.next(), lists.next()) {
        (Some((list, _)), None) if is_only => document.name(list),
        _ => document.name(id),
    };
    name.unwrap_or_default()
}
