//! `batten compare`: the deviation between two curves or references, as JSON.

use std::process::ExitCode;

use anyhow::{Context, anyhow, bail};
use serde::Serialize;

use super::ends::Source;
use super::items::only;
use super::output::{self, Messages};
use crate::analysis::{Deviation, Item};
use crate::document::{CurveId, Document, Edit, quoted};
use crate::geometry::Progress;
use crate::geometry::distance::{CurveSide, SideDeviation, Whisker};
use crate::geometry::expressions::LengthUnit;

/// A curve or reference of a source.
pub(super) struct Compared {
    /// The source.
    pub(super) source: Source,
    /// Its name; without one the only curve or reference.
    pub(super) name: Option<String>,
}

/// Print how far two curves or references are from each other; the exit code is 1 if that is more than the limit.
///
/// Figures are in the unit of the first source, into which the second one is converted.
///
/// # Errors
/// If a source cannot be read, no curve is chosen, both are lists of points, or a curve has a gap.
pub(super) fn run(compared: [&Compared; 2], limit: Option<f64>) -> anyhow::Result<ExitCode> {
    let [first, second] = compared;
    let read = |it: &Compared| it.source.document(None, &Messages::Printed);
    let (document, mut other) = (read(first)?, read(second)?);
    match (document.unit(), other.unit()) {
        (Some(unit), Some(own)) if own != unit => {
            let convert = other.apply(Edit::ConvertUnit(unit));
            convert.with_context(|| second.source.name())?;
        }
        (Some(unit), None) | (None, Some(unit)) => {
            let stateless = if other.unit().is_none() {
                second
            } else {
                first
            };
            output::message(&format!(
                "{}: states no unit; its numbers count in {}",
                stateless.source.name(),
                unit.name()
            ));
        }
        _ => {}
    }
    let named = [(&document, first, "--curve"), (&other, second, "--with")];
    let ids = named.map(|(document, it, option)| {
        let found = only(document, it.name.as_deref(), option);
        found.with_context(|| it.source.name())
    });
    let [a, b] = ids;
    let (a, b) = ((&document, a?), (&other, b?));
    let items = [item(a)?, item(b)?];
    let deviation = Deviation::measure(items.each_ref(), &Progress::default())?;
    let Some(deviation) = deviation else {
        bail!("both are lists of points: fit a curve to one of them");
    };
    let Some((_, largest)) = deviation.largest() else {
        bail!("there are no points to compare");
    };
    let largest = largest.distance();
    let beyond = |limit: f64| {
        deviation
            .whiskers()
            .filter(|it| it.distance() > limit)
            .count()
    };
    let [there, back] = deviation.sides.each_ref().map(Option::as_ref);
    let [from_a, from_b] = [
        there.map(|it| Side::of(it, [a, b])),
        back.map(|it| Side::of(it, [b, a])),
    ];
    let (past, within) = deviation.past_ends().unwrap_or((0, largest));
    output::print_json(&Report {
        a: document.name(a.1).unwrap_or_default(),
        b: other.name(b.1).unwrap_or_default(),
        unit: document.unit().or(other.unit()).map(LengthUnit::symbol),
        largest,
        mean: deviation.mean(),
        rms: deviation.rms(),
        from_a,
        from_b,
        limit,
        beyond: limit.map(beyond),
        whiskers: deviation.whiskers().count(),
        past_ends: past,
        largest_within: within,
    })?;
    Ok(match limit {
        Some(limit) if largest > limit => ExitCode::FAILURE,
        _ => ExitCode::SUCCESS,
    })
}

fn item((document, id): (&Document, CurveId)) -> anyhow::Result<Item> {
    let item = Item::of(document, id);
    item.ok_or_else(|| {
        anyhow!(
            "there is no {}",
            quoted(document.name(id).unwrap_or_default())
        )
    })
}

/// The parameter that belongs to one of the curve in pieces.
fn parameter((document, id): (&Document, CurveId), at: f64) -> f64 {
    match document.reference(id) {
        Some(reference) if reference.points().is_none() => reference.curve.parameter(at),
        _ => at,
    }
}

#[derive(Serialize)]
struct Report<'a> {
    /// The names of the two.
    a: &'a str,
    b: &'a str,
    /// The unit of all lengths; null if neither file says one.
    unit: Option<&'static str>,
    /// Of both sides.
    largest: f64,
    /// Over the arc length of both sides, or over the points.
    mean: f64,
    rms: f64,
    /// Null where the other one is a list of points.
    from_a: Option<Side>,
    from_b: Option<Side>,
    limit: Option<f64>,
    /// How many of the whiskers are longer than the limit; null without one.
    beyond: Option<usize>,
    whiskers: usize,
    /// How many of them lie past an end of the other curve, and the longest of the others.
    past_ends: usize,
    largest_within: f64,
}

#[derive(Serialize)]
struct Side {
    largest: f64,
    mean: f64,
    rms: f64,
    /// The parameter where the largest is, or the number of the point.
    at: f64,
    point: [f64; 3],
    nearest_at: f64,
    nearest: [f64; 3],
    /// On which side of the other curve.
    side: Option<&'static str>,
}

impl Side {
    fn of(side: &SideDeviation, [own, other]: [(&Document, CurveId); 2]) -> Self {
        let Whisker {
            at,
            nearest_at,
            places,
            side: of_curve,
            ..
        } = side.largest;
        let [point, nearest] = places.map(|it| it.to_array());
        Self {
            largest: side.largest.distance(),
            mean: side.mean,
            rms: side.rms,
            at: parameter(own, at),
            point,
            nearest_at: parameter(other, nearest_at),
            nearest,
            side: of_curve.map(CurveSide::name),
        }
    }
}
