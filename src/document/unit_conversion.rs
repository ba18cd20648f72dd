//! Converting a document to another unit of length: everything keeps its size, with other numbers.

use std::sync::Arc;

use super::curve::Curve;
use super::document::Document;
use super::error::EditError;
use super::reference::Reference;
use crate::geometry::FloatPolygon;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::references::{Placement, ReferenceCurve, ReferenceError};
use glam::DVec3;

impl Document {
    /// Give the document another unit and every length the number that it has in it, locked and hidden
    /// curves included: none changes its size. Each number is off by at most its rounding.
    ///
    /// # Errors
    /// [`EditError::NoUnit`] if the document has none; otherwise of the first curve or reference whose numbers
    /// get too large or too small. The document is unchanged then.
    pub(super) fn convert_unit(&mut self, unit: LengthUnit) -> Result<(), EditError> {
        let before = self.unit.ok_or(EditError::NoUnit)?;
        if before == unit {
            return Ok(());
        }
        let converted = |length: f64| length * before.millimetres() / unit.millimetres();
        *self = self.with_lengths(&converted)?.with_unit(Some(unit));
        Ok(())
    }

    /// The document larger by a factor, about the origin, in the same unit.
    ///
    /// # Errors
    /// [`EditError`] of the first curve or reference whose numbers get too large or too small.
    pub fn scaled(&self, factor: f64) -> Result<Self, EditError> {
        self.with_lengths(&|length| factor * length)
    }

    /// The document with all lengths changed in the same proportion.
    fn with_lengths(&self, changed: &impl Fn(f64) -> f64) -> Result<Self, EditError> {
        let mut document = self.clone();
        for (_, curve) in &mut document.curves {
            *curve = Arc::new(converted_curve(curve, changed)?);
        }
        for (_, reference) in &mut document.references {
            *reference = Arc::new(converted_reference(reference, changed(1.0))?);
        }
        for line in &mut document.guide_lines {
            line.at = changed(line.at);
        }
        Ok(document)
    }
}

fn converted_curve(curve: &Curve, converted: &impl Fn(f64) -> f64) -> Result<Curve, EditError> {
    let point = |at: DVec3| DVec3::from_array(at.to_array().map(converted));
    let polygon = &curve.polygon;
    let vertices = polygon.vertices().iter().map(|at| point(*at)).collect();
    let weights = polygon.weights().map(<[f64]>::to_vec);
    let refused = |error| EditError::Polygon {
        name: curve.name.clone(),
        error,
    };
    let polygon = FloatPolygon::new(polygon.degree(), vertices, weights, polygon.is_periodic());
    let target = |target: EndTarget| EndTarget {
        point: point(target.point),
        // One over a length, and over its square.
        curvature: target.curvature.map(|curvature| curvature / converted(1.0)),
        slope: target.slope.map(|slope| slope / converted(1.0).powi(2)),
        ..target
    };
    let mut changed = curve.clone();
    changed.polygon = polygon.map_err(refused)?;
    changed.targets.start = curve.targets.start.map(target);
    changed.targets.finish = curve.targets.finish.map(target);
    match changed.symmetry {
        _ if !changed.targets.are_usable() => Err(EditError::BadTarget),
        Some(symmetry) => changed.kept_symmetric(symmetry, None),
        None => Ok(changed),
    }
}

fn converted_reference(reference: &Reference, factor: f64) -> Result<Reference, EditError> {
    let curve = larger(&reference.curve, factor).map_err(|error| EditError::Reference {
        name: reference.name.clone(),
        error,
    })?;
    Ok(Reference {
        curve,
        ..reference.clone()
    })
}

/// The curve larger about the origin: by its own numbers where it can be, so that a radius is the one that is seen.
fn larger(curve: &ReferenceCurve, factor: f64) -> Result<ReferenceCurve, ReferenceError> {
    let placement = curve.placement();
    match curve.form().scaled(factor) {
        Some(form) => {
            let (rotation, scale) = (placement.rotation(), placement.scale());
            let placement = Placement::new(rotation, scale, factor * placement.translation())?;
            ReferenceCurve::new(form, curve.interval(), placement)
        }
        None => Ok(curve
            .clone()
            .placed(placement.scaled_about(DVec3::ZERO, factor)?)),
    }
}
