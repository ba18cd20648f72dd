//! Polygons with more or fewer vertices whose curve stays.

use std::cell::RefCell;
use std::sync::Arc;

use crate::document::{Curve, CurveId, Edit, EditError, quoted};
use crate::editor::polygon_edits::{deletion, replacement};
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{FloatPolygon, PolygonError, rounded_up};
use crate::operations::{changed_features, feature_counts};

/// The switch that inserting and deleting vertices follow.
pub const KEEP_SHAPE: &str = "Keep shape";

/// A polygon with more or fewer vertices that keeps its curve's shape.
#[derive(Clone, Debug)]
pub struct SameShape {
    /// The polygon.
    pub polygon: FloatPolygon,
    /// How far its curve is off, at most.
    pub deviation: f64,
    /// How many curvature extrema and inflections the curve had and has.
    pub features: [[usize; 2]; 2],
}

impl SameShape {
    /// Find the polygon with so many vertices more, or fewer, that is nearest to a curve in its own parameter.
    ///
    /// # Errors
    /// Says so if a vertex is locked, since all move, or if so few vertices make no curve of this degree.
    pub fn of(curve: &Curve, more: isize) -> Result<Self, String> {
        if let Some(vertex) = curve.locked_vertices.iter().next() {
            return Err(format!(
                "vertex {vertex} of {} is locked, and all move to keep the shape: unlock it, or switch {} off",
                quoted(&curve.name),
                KEEP_SHAPE,
            ));
        }
        let polygon = &curve.polygon;
        let refused = |error| {
            let name = curve.name.clone();
            advised(EditError::Polygon { name, error })
        };
        let (degree, count) = (polygon.degree(), polygon.vertices().len());
        let segments = polygon.segments().checked_add_signed(more);
        let least = if polygon.is_periodic() { degree + 1 } else { 1 };
        let Some(segments) = segments.filter(|segments| *segments >= least) else {
            return Err(refused(PolygonError::TooFewVertices {
                found: count.saturating_add_signed(more),
                needed: degree + 1,
                degree,
                periodic: polygon.is_periodic(),
            }));
        };
        let found = polygon.refitted(degree, segments).map_err(refused)?;
        let features = [polygon, &found.polygon].map(feature_counts);
        Ok(Self {
            polygon: found.polygon,
            deviation: found.deviation,
            features,
        })
    }

    /// Whether the curve has more features of a kind than before.
    pub fn adds(&self) -> bool {
        adds(self.features)
    }

    /// Say how far the curve moves, and which features change.
    pub fn told(&self, unit: Option<LengthUnit>) -> String {
        let moved = match self.deviation {
            0.0 => "No deviation".to_owned(),
            bound => format!(
                "Deviation at most {}",
                LengthUnit::behind(unit, rounded_up(bound))
            ),
        };
        match changed_features(self.features) {
            None => moved,
            Some(change) => format!("{moved}; {change}"),
        }
    }
}

/// A deletion of vertices of a curve.
#[derive(Debug)]
pub struct Removal {
    /// The edit.
    pub edit: Edit,
    /// What it does to the curve, in words.
    pub told: Option<String>,
    /// Whether it adds curvature extrema or inflections.
    pub adds: bool,
}

/// Find the edit that deletes vertices of a curve, by their numbers in rising order, and what it does to the curve, whose
/// lengths have a unit: keep its shape, or leave the other vertices in their places.
///
/// # Errors
/// Says so if a vertex is locked that would be deleted or moved, or if the rest is no curve of this degree.
pub fn removal(
    id: CurveId,
    curve: &Curve,
    indices: &[usize],
    (vertices_stay, unit): (bool, Option<LengthUnit>),
) -> Result<Removal, String> {
    if vertices_stay {
        let edit = deletion(id, curve, indices).map_err(advised)?;
        let features = match &edit {
            Edit::Renumber { polygon, .. } => [&curve.polygon, polygon].map(feature_counts),
            _ => Default::default(),
        };
        let change = changed_features(features);
        return Ok(Removal {
            edit,
            told: change.map(|change| format!("Features change: {change}")),
            adds: adds(features),
        });
    }
    let same = SameShape::of(curve, -(indices.len() as isize))?;
    Ok(Removal {
        told: Some(same.told(unit)),
        adds: same.adds(),
        edit: replacement(id, curve, same.polygon),
    })
}

/// Whether there are more features of a kind than before.
fn adds([before, now]: [[usize; 2]; 2]) -> bool {
    before.iter().zip(&now).any(|(before, now)| now > before)
}

/// Say why vertices cannot come or go, and the way out.
fn advised(refused: EditError) -> String {
    match refused {
        EditError::Polygon { .. } => format!("{refused}; lower its degree first"),
        refused => refused.to_string(),
    }
}

/// The polygon of the same shape for the curve that was looked at last.
#[derive(Debug, Default)]
pub struct LastSameShape(RefCell<Option<Found>>);

type Found = (Arc<Curve>, Result<Arc<SameShape>, String>);

impl LastSameShape {
    /// As [`SameShape::of`], found anew only for another curve. One value asks for one number of vertices.
    ///
    /// # Errors
    /// As [`SameShape::of`].
    pub fn of(&self, curve: &Arc<Curve>, more: isize) -> Result<Arc<SameShape>, String> {
        let mut last = self.0.borrow_mut();
        if let Some((of, found)) = last.as_ref()
            && Arc::ptr_eq(of, curve)
        {
            return found.clone();
        }
        let found = SameShape::of(curve, more).map(Arc::new);
        *last = Some((curve.clone(), found.clone()));
        found
    }
}
