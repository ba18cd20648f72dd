//! Curves of a lower degree, for programs that hold no higher one.

use std::fmt;

use super::degree::{Goal, changed_features, fewest};
use super::error::OperationError;
use crate::document::{Curve, Document, quoted};
use crate::geometry::{BezierPolygon, Progress, counted, rounded_up};

/// The tolerance without a wish, in units of a curve's size.
const WITHIN: f64 = 1e-4;

/// A curve that got a lower degree.
#[derive(Clone, Debug, PartialEq)]
pub struct Lowered {
    /// The curve's name.
    pub name: String,
    /// The degree before.
    pub degree: usize,
    /// The degree now.
    pub lowered: usize,
    /// The number of vertices now.
    pub vertices: usize,
    /// A bound of how far it moves.
    pub deviation: f64,
    /// Whether that is within the tolerance.
    pub is_within: bool,
    /// The inflections (in space zeros of the torsion) and the curvature extrema, before and now; `None` if they are the
    /// same, or not all known.
    pub changed: Option<[[usize; 2]; 2]>,
}

impl fmt::Display for Lowered {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let within = match self.is_within {
            true => "",
            false => ", which is more than the tolerance",
        };
        let features = self.changed.map_or_else(String::new, |[before, now]| {
            let [inflections, extrema] = [0, 1].map(|kind| (before[kind], now[kind]));
            format!(
                "; inflections: {} before, {} now; curvature extrema: {} before, {} now",
                inflections.0, inflections.1, extrema.0, extrema.1
            )
        });
        write!(
            formatter,
            "{}: degree {} becomes {}, {}, off by at most {}{within}{features}",
            quoted(&self.name),
            self.degree,
            self.lowered,
            counted(self.vertices, "vertex", "vertices"),
            rounded_up(self.deviation),
        )
    }
}

/// Give all curves of a higher degree than `most` that degree, with the fewest vertices within a tolerance (without one
/// 1e-4 of a curve's size) that keep its features where that is possible.
///
/// The result is a copy to export: it has the curves and references, their attributes and the unit, and no matches.
///
/// # Errors
/// [`OperationError`] if the degree is 0, or `progress` is cancelled.
pub fn lowered(
    document: &Document,
    most: usize,
    tolerance: Option<f64>,
    progress: &Progress,
) -> Result<(Document, Vec<Lowered>), OperationError> {
    let mut told = Vec::new();
    let mut curves = Vec::new();
    for (_, curve) in document.curves() {
        let mut copy = Curve::clone(curve);
        let polygon = &curve.polygon;
        if polygon.degree() > most {
            let size = BezierPolygon::from_float(polygon).size();
            let tolerance = tolerance.unwrap_or(WITHIN * size);
            let goal = Goal {
                degree: most,
                segments: None,
                least: polygon.segments(),
                tolerance: Some(tolerance),
            };
            let found = fewest(polygon, &goal, progress)?;
            told.push(Lowered {
                name: curve.name.clone(),
                degree: polygon.degree(),
                lowered: most,
                vertices: found.polygon.vertices().len(),
                deviation: found.deviation,
                is_within: found.deviation <= tolerance,
                changed: changed_features(polygon, &found.polygon, progress)?,
            });
            copy = Curve {
                group: copy.group,
                colour: copy.colour,
                visible: copy.visible,
                locked: copy.locked,
                ..Curve::new(copy.name, found.polygon)
            };
        }
        curves.push(copy);
    }
    let references = document.references();
    let references = references.map(|(_, it)| it.as_ref().clone());
    let lowered = Document::from_curves(curves).with_references(references);
    Ok((lowered.with_unit(document.unit()), told))
}
