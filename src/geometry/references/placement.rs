//! Placement of a reference: a similarity in space.

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::error::ReferenceError;
use crate::geometry::interval::Interval;
use crate::geometry::parameters::SIZES;
use crate::geometry::parametric_curve::ParametricCurve;
use crate::geometry::power_series::PowerSeries;

/// The largest error of the entries of a rotation matrix, which are sums of products of numbers up to 1.
const ROTATION_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The number of points that tell how a curve was moved.
const SAMPLES: usize = 33;

/// What points of a moved curve may be off, in units of its size.
const MOVED: f64 = 1e-9;

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

    /// Find the similarity that moved a curve, by points of it: a rotation about the z axis, a scale and a translation.
    /// `None` if the points stay, or do not move alike, as after a change of a part.
    pub fn between(before: &dyn ParametricCurve, after: &dyn ParametricCurve) -> Option<Self> {
        if before.pieces() != after.pieces() {
            return None;
        }
        let step = before.pieces() as f64 / (SAMPLES - 1) as f64;
        let points = |curve: &dyn ParametricCurve| -> Vec<DVec3> {
            let places = (0..SAMPLES).map(|it| it as f64 * step);
            places.map(|u| curve.jet(u).point).collect()
        };
        let (from, to) = (points(before), points(after));
        let (first, image) = (*from.first()?, *to.first()?);
        let pairs = || from.iter().zip(&to);
        let ways = pairs().map(|(from, to)| [*from - first, *to - image].map(DVec3::truncate));
        let farther = |a: &[DVec2; 2], b: &[DVec2; 2]| a[0].length().total_cmp(&b[0].length());
        let [own, its] = ways.max_by(farther)?;
        let rotation = DQuat::from_rotation_z(own.angle_to(its));
        let found = Self::new(rotation, its.length() / own.length(), DVec3::ZERO).ok()?;
        let found = Self {
            translation: image - found.vector(first),
            ..found
        };
        let is_there =
            |(from, to): (&DVec3, &DVec3)| found.point(*from).distance(*to) <= MOVED * own.length();
        (from != to && pairs().all(is_there)).then_some(found)
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

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::FloatPolygon;

    const VERTICES: [(f64, f64); 6] = [
        (0.0, 0.0),
        (1.0, 0.4),
        (2.0, 0.3),
        (3.1, -0.2),
        (4.0, 0.6),
        (5.0, 0.1),
    ];

    fn moved(by: impl Fn(DVec2) -> DVec2) -> FloatPolygon {
        let vertices = VERTICES.map(|(x, y)| by(DVec2::new(x, y)).into());
        FloatPolygon::planar(3, &vertices).expect("a polygon")
    }

    #[test]
    fn turns_scales_and_shifts_are_found() {
        let before = moved(|it| it);
        let turn = DVec2::from_angle(0.7);
        for scale in [1.0, 2.5] {
            let motion = |it: DVec2| scale * turn.rotate(it) + DVec2::new(30.0, -7.0);
            let found = Placement::between(&before, &moved(motion)).expect("a motion");
            let point = DVec2::new(-3.0, 8.0);
            let image = found.point(point.extend(0.0));
            let off = image.distance(motion(point).extend(0.0));
            assert!(off <= 1e-12 * 30.0, "{off}");
        }
    }

    #[test]
    fn other_changes_are_no_motions() {
        let before = moved(|it| it);
        let stretched = moved(|it| DVec2::new(it.x, 1.001 * it.y));
        assert_eq!(Placement::between(&before, &stretched), None);
        let mirrored = moved(|it| DVec2::new(it.x, -it.y));
        assert_eq!(Placement::between(&before, &mirrored), None);
        let mut bent = before.clone();
        bent.move_vertices([(3, DVec3::new(3.1, -0.25, 0.0))])
            .expect("in range");
        assert_eq!(Placement::between(&before, &bent), None);
        // What stays is not moved by rounding.
        assert_eq!(Placement::between(&before, &before), None);
    }
}
