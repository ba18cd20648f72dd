//! The axis on which an end lies, and the target with a tangent perpendicular to it.

use glam::DVec3;

use crate::document::{Curve, CurveId, Document};
use crate::geometry::End;
use crate::geometry::end_correction::EndTarget;

/// An end lies on an axis if it is nearer than this share of the polygon's size: it was put there by hand.
const NEAR: f64 = 1e-3;

/// An axis on which an end lies.
#[derive(Clone, Debug, PartialEq)]
pub struct EndAxis {
    /// Its name.
    pub name: String,
    /// The target on the axis with a tangent perpendicular to it.
    pub target: EndTarget,
}

impl EndAxis {
    /// Find the axis on which an end, or its target, lies: a guide, the axis of a symmetric curve, or an axis of the
    /// model. Of several it is the one that the tangent crosses most steeply.
    pub fn of(document: &Document, id: CurveId, end: End) -> Option<Self> {
        let curve = document.curve(id)?;
        let jet = curve.polygon.end_jet(end);
        let target = curve.targets.get(end).unwrap_or(EndTarget {
            point: jet.point,
            ..EndTarget::default()
        });
        let tangent = target.direction.or(jet.tangent())?;
        let near = NEAR * curve.polygon.size();
        let off = |[through, normal]: [DVec3; 2]| (target.point - through).dot(normal);
        let planes = planes(document, curve).filter(|(_, plane)| off(*plane).abs() <= near);
        let steepness = |[_, normal]: [DVec3; 2]| normal.dot(tangent).abs();
        let (name, plane) =
            planes.max_by(|(_, a), (_, b)| steepness(*a).total_cmp(&steepness(*b)))?;
        let [_, normal] = plane;
        let across = if normal.dot(tangent) < 0.0 {
            -normal
        } else {
            normal
        };
        let point = target.point - off(plane) * normal;
        Some(Self {
            name,
            target: EndTarget {
                point,
                direction: Some(across),
                normal: None,
                ..target
            },
        })
    }
}

/// The planes that are axes for a curve, with their names.
fn planes<'a>(
    document: &'a Document,
    curve: &'a Curve,
) -> impl Iterator<Item = (String, [DVec3; 2])> + 'a {
    let planar = curve.polygon.is_planar();
    let guides = document.guide_lines().iter();
    let guides = guides.map(|it| ("guide".to_owned(), it.plane()));
    let symmetric = document.curves().filter(|(_, it)| it.visible);
    let symmetric = symmetric.flat_map(|(_, it)| {
        let planes = it.symmetry.into_iter().flat_map(|rule| rule.planes());
        planes.map(move |plane| (format!("axis of {}", it.name), plane))
    });
    let names = match planar {
        true => ["y axis", "x axis", ""],
        false => ["yz plane", "xz plane", "xy plane"],
    };
    let model = names.into_iter().zip(DVec3::AXES);
    let model = model.map(|(name, normal)| (name.to_owned(), [DVec3::ZERO, normal]));
    let all = guides.chain(symmetric).chain(model);
    // A planar curve lies in the plane z = 0.
    all.filter(move |(_, [_, normal])| !planar || normal.z == 0.0)
}
