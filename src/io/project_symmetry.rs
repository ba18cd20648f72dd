//! The JSON of a curve's symmetry in a project file.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::project_values::Coordinates;
use crate::geometry::{FloatPolygon, Mirror, Symmetry};

/// How far a polygon may be from its image, as a share of its size: one that is given by its clamped polygon is not
/// exact.
const NEAR: f64 = 1e-9;

/// How far the length of a normal may be from 1: farther, it is made 1.
const ROUNDING: f64 = 1e-12;

/// The known keys of a symmetry.
#[derive(Deserialize, Serialize)]
#[serde(expecting = "the symmetry of a curve, which is a JSON object")]
pub(super) struct ProjectSymmetry {
    /// A point of the mirror plane.
    through: Coordinates,
    /// Its normal.
    normal: Coordinates,
    /// Whether the curve is its own image in the perpendicular plane too.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    both: bool,
}

impl ProjectSymmetry {
    /// Write a symmetry; `None` for half a turn.
    pub(super) fn of(symmetry: &Symmetry, planar: bool) -> Option<Self> {
        let plane = symmetry.mirror().plane()?;
        let [through, normal] = plane.map(|it| Coordinates::of(it, planar));
        Some(Self {
            through,
            normal,
            both: symmetry.second().is_some(),
        })
    }

    /// The rule for a polygon; `None` if that is not symmetric so.
    pub(super) fn into_symmetry(self, polygon: &FloatPolygon) -> Option<Symmetry> {
        let [through, normal] = [self.through, self.normal].map(DVec3::from);
        let length = normal.length();
        let normal = match (length - 1.0).abs() <= ROUNDING {
            true => normal,
            false => normal.try_normalize()?,
        };
        let mirror = Mirror::of_plane(through, normal);
        let symmetry = match self.both {
            true => Symmetry::about_both(mirror, polygon)?,
            false => Symmetry::about(mirror, polygon),
        };
        (symmetry.mismatch(polygon) <= NEAR * polygon.size()).then_some(symmetry)
    }
}
