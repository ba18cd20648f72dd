//! A point of a curve with its first three derivatives, curvature and torsion.

use glam::DVec3;

use super::vector;

/// Hold a point of the curve and its first three derivatives by the parameter u.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Jet {
    /// The point C(u).
    pub point: DVec3,
    /// The first derivative C′(u).
    pub first: DVec3,
    /// The second derivative C″(u).
    pub second: DVec3,
    /// The third derivative C‴(u).
    pub third: DVec3,
}

impl From<[DVec3; 4]> for Jet {
    /// Hold a point and its first three derivatives.
    fn from([point, first, second, third]: [DVec3; 4]) -> Self {
        Self {
            point,
            first,
            second,
            third,
        }
    }
}

impl Jet {
    /// Compute the unit tangent, or `None` at a cusp (C′ = 0).
    pub fn tangent(&self) -> Option<DVec3> {
        vector::direction(self.first)
    }

    /// Compute the signed curvature of a planar curve, (x′y″ − y′x″) / |C′|³: positive where
    /// the curve turns left. Infinite or not a number at a cusp.
    pub fn signed_curvature(&self) -> f64 {
        let (first, second, factor) = self.scaled();
        factor * first.truncate().perp_dot(second.truncate()) / first.length().powi(3)
    }

    /// Compute the curvature of a space curve, |C′ × C″| / |C′|³ ≥ 0. Infinite or not a number
    /// at a cusp.
    pub fn curvature(&self) -> f64 {
        let (first, second, factor) = self.scaled();
        factor * first.cross(second).length() / first.length().powi(3)
    }

    /// Compute the curvature as a curve of that kind has it: signed if `planar`, ≥ 0 in space.
    pub fn curvature_of(&self, planar: bool) -> f64 {
        if planar {
            self.signed_curvature()
        } else {
            self.curvature()
        }
    }

    /// Compute the curvature vector, the derivative of the unit tangent by arc length: (C″ − (C″·t) t) / |C′|². Not
    /// a number at a cusp.
    pub fn curvature_vector(&self) -> DVec3 {
        let (first, second, factor) = self.scaled();
        let squared = first.length_squared();
        factor * (second - second.dot(first) / squared * first) / squared
    }

    /// Compute the jet of the curve passed the other way.
    pub fn turned(&self) -> Self {
        Self {
            first: -self.first,
            third: -self.third,
            ..*self
        }
    }

    /// Compute the slope dκ/ds of the curvature by arc length, of the signed curvature if `planar`:
    /// (|C′|² (C′ × C‴)·b − 3 (C′·C″) (C′ × C″)·b) / |C′|⁶, b the unit normal of the plane, in space
    /// that of the osculating plane. Not a number at a cusp, and in space where the curvature is 0.
    pub fn curvature_slope(&self, planar: bool) -> f64 {
        let (first, a) = vector::scaled(self.first);
        let (second, b) = vector::scaled(self.second);
        let (third, c) = vector::scaled(self.third);
        let normal = first.cross(second);
        let across = if planar {
            DVec3::Z
        } else {
            normal / normal.length()
        };
        let squared = first.length_squared();
        let turning = squared * first.cross(third).dot(across) * (c / a / a / a);
        let stretching = 3.0 * first.dot(second) * normal.dot(across) * (b / a / a) * (b / a / a);
        (turning - stretching) / squared.powi(3)
    }

    /// Compute the torsion (C′ × C″) · C‴ / |C′ × C″|²; not a number where the curvature is 0.
    pub fn torsion(&self) -> f64 {
        let (first, a) = vector::scaled(self.first);
        let (second, b) = vector::scaled(self.second);
        let (third, c) = vector::scaled(self.third);
        let normal = first.cross(second);
        c / b / a * normal.dot(third) / normal.length_squared()
    }

    /// Compute the speed |C′|.
    pub fn speed(&self) -> f64 {
        vector::length(self.first)
    }

    /// Compute the centre of curvature, the point of the evolute:
    /// C + |C′|² (C′ × C″) × C′ / |C′ × C″|². `None` where the curvature is 0 or at a cusp.
    pub fn centre_of_curvature(&self) -> Option<DVec3> {
        let (first, second, factor) = self.scaled();
        let normal = first.cross(second);
        let radius_vector = first.length_squared() * normal.cross(first) / normal.length_squared();
        let centre = self.point + radius_vector / factor;
        centre.is_finite().then_some(centre)
    }

    /// The first two derivatives, brought to sizes that can be squared and cubed, and the factor
    /// by which the curvature computed from them must be multiplied.
    fn scaled(&self) -> (DVec3, DVec3, f64) {
        let (first, a) = vector::scaled(self.first);
        let (second, b) = vector::scaled(self.second);
        (first, second, b / a / a)
    }
}
