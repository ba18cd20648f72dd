//! Curves of a lower degree, for programs that hold no higher one.

use std::fmt;

use super::degree::{Goal, changed_features, fewest};
use super::error::OperationError;
use super::floats::{FloatRequest, floats_of};
use crate::document::{Curve, Document, Reference, first_quoted, quoted};
use crate::geometry::references::ReferenceForm;
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
    /// Whether features differ.
    pub differs: bool,
}

impl fmt::Display for Lowered {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let within = match self.is_within {
            true => "",
            false => ", which is more than the tolerance",
        };
        let differ = match self.differs {
            true => "; features differ".to_owned(),
            false => String::new(),
        };
        let features = self.changed.map_or(differ, |[before, now]| {
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

/// So many curves are told of one by one.
const FEW: usize = 3;

/// Tell of curves that got a lower degree: of many in one line for each kind, with the largest deviation.
pub fn told_of_lowered(lowered: &[Lowered]) -> Vec<String> {
    if lowered.len() <= FEW {
        return lowered.iter().map(ToString::to_string).collect();
    }
    let kinds = [
        (true, false, ""),
        (true, true, "; inflections or curvature extrema differ"),
        (false, false, ", which is more than the tolerance"),
        (
            false,
            true,
            ", which is more than the tolerance; inflections or curvature extrema differ",
        ),
    ];
    let lines = kinds.into_iter().filter_map(|(is_within, differs, told)| {
        let alike = lowered
            .iter()
            .filter(|it| it.is_within == is_within && it.differs == differs);
        let alike: Vec<&Lowered> = alike.collect();
        let names: Vec<&str> = alike.iter().map(|it| it.name.as_str()).collect();
        let becomes = alike.first()?.lowered;
        let most = alike.iter().map(|it| it.degree).max().unwrap_or_default();
        let vertices: usize = alike.iter().map(|it| it.vertices).sum();
        let off = alike.iter().map(|it| it.deviation).fold(0.0, f64::max);
        Some(format!(
            "{}: degrees up to {most} become {becomes}, {} in all, off by at most {}{told}",
            first_quoted(&names),
            counted(vertices, "vertex", "vertices"),
            rounded_up(off),
        ))
    });
    lines.collect()
}

/// Give all curves and B-spline references of a higher degree than `most` that degree, with the fewest vertices within a
/// tolerance (without one 1e-4 of a curve's size) that keep its features where that is possible. A reference becomes
/// curves.
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
    let is_high = |reference: &Reference| match reference.curve.form() {
        ReferenceForm::Nurbs(nurbs) => nurbs.degree() > most,
        _ => false,
    };
    let high = document.curves();
    let high = high.filter(|(_, curve)| curve.polygon.degree() > most);
    let count = high.count() + document.references().filter(|it| is_high(it.1)).count();
    let mut shares = (0..count).map(|index| [index, index + 1].map(|it| it as f64 / count as f64));
    let mut part = || match shares.next() {
        Some([from, to]) => progress.part(from, to),
        None => progress.clone(),
    };
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
            let found = fewest(polygon, &goal, &part())?;
            let changed = changed_features(polygon, &found.polygon, progress)?;
            told.push(Lowered {
                name: curve.name.clone(),
                degree: polygon.degree(),
                lowered: most,
                vertices: found.polygon.vertices().len(),
                deviation: found.deviation,
                is_within: found.deviation <= tolerance,
                changed,
                differs: changed.is_some(),
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
    let mut references = Vec::new();
    for (_, reference) in document.references() {
        match reference.curve.form() {
            ReferenceForm::Nurbs(nurbs) if nurbs.degree() > most => {
                let request = FloatRequest {
                    degree: Some(most),
                    tolerance,
                };
                let floats = floats_of(reference, request, &part())?;
                told.push(Lowered {
                    name: reference.name.clone(),
                    degree: nurbs.degree(),
                    lowered: most,
                    vertices: floats.vertices,
                    deviation: floats.deviation,
                    is_within: floats.is_within,
                    changed: None,
                    differs: floats.keeps_features == Some(false),
                });
                curves.extend(floats.curves);
            }
            _ => references.push(Reference::clone(reference)),
        }
    }
    let lowered = Document::from_curves(curves).with_references(references);
    Ok((lowered.with_unit(document.unit()), told))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ParametricCurve;
    use crate::geometry::references::{Nurbs, ReferenceCurve};
    use glam::DVec3;

    #[test]
    fn many_curves_are_told_of_by_kind() {
        let lowered = |index: usize| Lowered {
            name: format!("c{index}"),
            degree: 5 + index % 5,
            lowered: 3,
            vertices: 10,
            deviation: index as f64,
            is_within: true,
            changed: (index == 6).then_some([[0, 1], [0, 3]]),
            differs: index == 6,
        };
        let all: Vec<Lowered> = (1..=6).map(lowered).collect();
        assert_eq!(
            told_of_lowered(&all),
            [
                "“c1”, “c2”, “c3” and 2 others: degrees up to 9 become 3, 50 vertices in all, off by at most 5",
                "“c6”: degrees up to 6 become 3, 10 vertices in all, off by at most 6; \
                 inflections or curvature extrema differ",
            ]
        );
        let few: Vec<String> = all[..2].iter().map(ToString::to_string).collect();
        assert_eq!(told_of_lowered(&all[..2]), few);
    }

    #[test]
    fn splines_on_any_knots_are_lowered_too() {
        let points = (0..9).map(|index| {
            let t = f64::from(index);
            DVec3::new(t, (0.9 * t).sin(), 0.0)
        });
        let knots = [vec![0.0; 6], vec![1.0, 2.5, 3.0], vec![4.0; 6]].concat();
        let nurbs = Nurbs::new(5, knots, points.collect::<Vec<_>>(), None, false);
        let nurbs = ReferenceForm::Nurbs(nurbs.expect("a spline"));
        let own = ReferenceCurve::of(nurbs).expect("a reference");
        let document = Document::default().with_references([Reference::new("hull", own.clone())]);
        let (kept, told) = lowered(&document, 5, None, &Progress::default()).expect("kept");
        assert!(told.is_empty() && kept.references().len() == 1);
        let (made, told) = lowered(&document, 3, Some(1e-3), &Progress::default()).expect("made");
        assert_eq!((told[0].degree, told[0].lowered), (5, 3));
        assert!(told[0].is_within, "{told:?}");
        let (_, curve) = made.curves().next().expect("a curve");
        assert_eq!((curve.polygon.degree(), made.references().len()), (3, 0));
        let last = own.pieces() as f64;
        for step in 0..=50 {
            let point = own.jet(last * f64::from(step) / 50.0).point;
            let distance = curve.polygon.nearest(point).distance;
            assert!(distance <= 1e-3, "{distance} at {point}");
        }
    }
}
