//! Placement of a reference: a similarity in space.

use glam::{DMat3, DQuat, DVec3};

use super::error::ReferenceError;
use crate::geometry::interval::Interval;
use crate::geometry::parameters::SIZES;
use crate::geometry::power_series::PowerSeries;

/// The largest error of the entries of a rotation matrix, which are sums of products of numbers up to 1.
const ROTATION_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Similarity: points are rotated about the origin, scaled, and then translated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    rotation: DQuat,
    scale: f64,
    translation: DVec3,
}

impl Default for Placement {
    /// Leave points where they are.
    fn default() -> Self {
        Self {
            rotation: DQuat::IDENTITY,
            scale: 1.0,
            translation: DVec3::ZERO,
        }
    }
}

impl Placement {
    /// Check a rotation, which is brought to length 1, a scale > 0 and a translation.
    ///
    /// # Errors
    /// [`ReferenceError::BadPlacement`] if a number is not finite, the scale is not positive, or the
    /// rotation is 0.
    pub fn new(rotation: DQuat, scale: f64, translation: DVec3) -> Result<Self, ReferenceError> {
        let length = rotation.length();
        let fits = length.is_finite() && length > 0.0 && SIZES.contains(&scale);
        if !fits || !translation.is_finite() {
            return Err(ReferenceError::BadPlacement);
        }
        // One that has length 1 but for rounding stays as it is, to the bit.
        let rotation = if rotation.is_normalized() {
            rotation
        } else {
            rotation.normalize()
        };
        Ok(Self {
            rotation,
            scale,
            translation,
        })
    }

    /// The rotation, of length 1.
    pub fn rotation(&self) -> DQuat {
        self.rotation
    }

    /// The scale, positive.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The translation.
    pub fn translation(&self) -> DVec3 {
        self.translation
    }

    /// Rotate the placed curve about a point.
    ///
    /// # Errors
    /// [`ReferenceError::BadPlacement`] if the numbers leave their range.
    pub fn rotated_about(&self, pivot: DVec3, turn: DQuat) -> Result<Self, ReferenceError> {
        let translation = pivot + turn * (self.translation - pivot);
        let rotation = (turn * self.rotation).normalize();
        Self::new(rotation, self.scale, translation)
    }

    /// Scale the placed curve about a point, by a factor > 0.
    ///
    /// # Errors
    /// [`ReferenceError::BadPlacement`] if the factor is not positive, or the numbers leave their
    /// range.
    pub fn scaled_about(&self, pivot: DVec3, factor: f64) -> Result<Self, ReferenceError> {
        let translation = pivot + factor * (self.translation - pivot);
        Self::new(self.rotation, factor * self.scale, translation)
    }

    /// Whether the plane z = 0 stays where it is, up side up or down.
    pub fn keeps_plane(&self) -> bool {
        let DQuat { x, y, z, w } = self.rotation;
        let about_z = x == 0.0 && y == 0.0;
        let turned_over = z == 0.0 && w == 0.0;
        (about_z || turned_over) && self.translation.z == 0.0
    }

    /// Place a point.
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.vector(point) + self.translation
    }

    /// Bound the placed coordinates by those before.
    pub(super) fn enclosed(
        &self,
        coordinates: [PowerSeries<Interval>; 3],
    ) -> [PowerSeries<Interval>; 3] {
        if *self == Self::default() {
            return coordinates;
        }
        let axes = DMat3::from_quat(self.rotation).transpose();
        [0, 1, 2].map(|axis| {
            let row = axes.col(axis).to_array();
            let entries = row.map(|it| Interval::number(it).widened(ROTATION_ROUNDING));
            let scale = Interval::number(self.scale);
            let [x, y, z] = [0, 1, 2].map(|from| {
                let along: &PowerSeries<Interval> = &coordinates[from];
                along.clone().times(entries[from] * scale)
            });
            (&(&x + &y) + &z).plus(Interval::number(self.translation[axis]))
        })
    }

    /// Place a derivative, which does not depend on the translation.
    pub fn vector(&self, vector: DVec3) -> DVec3 {
        self.scale * (self.rotation * vector)
    }
}
