//! A point of a curve with its first three derivatives, and what follows from them.

use glam::DVec3;

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

impl Jet {
    /// Compute the unit tangent, or `None` at a cusp (C′ = 0).
    pub fn tangent(&self) -> Option<DVec3> {
        self.first.try_normalize()
    }

    /// Compute the signed curvature of a planar curve, (x′y″ − y′x″) / |C′|³: positive where
    /// the curve turns left. Infinite or not a number at a cusp.
    pub fn signed_curvature(&self) -> f64 {
        self.first.truncate().perp_dot(self.second.truncate()) / self.speed().powi(3)
    }

    /// Compute the curvature of a space curve, |C′ × C″| / |C′|³ ≥ 0.
    pub fn curvature(&self) -> f64 {
        self.first.cross(self.second).length() / self.speed().powi(3)
    }

    /// Compute the torsion (C′ × C″) · C‴ / |C′ × C″|²; not a number where the curvature is 0.
    pub fn torsion(&self) -> f64 {
        let normal = self.first.cross(self.second);
        normal.dot(self.third) / normal.length_squared()
    }

    /// Compute the speed |C′|.
    pub fn speed(&self) -> f64 {
        self.first.length()
    }

    /// Compute the centre of curvature, the point of the evolute:
    /// C + |C′|² (C′ × C″) × C′ / |C′ × C″|². `None` where the curvature is 0 or at a cusp.
    pub fn centre_of_curvature(&self) -> Option<DVec3> {
        let normal = self.first.cross(self.second);
        let radius_vector =
            self.first.length_squared() * normal.cross(self.first) / normal.length_squared();
        let centre = self.point + radius_vector;
        centre.is_finite().then_some(centre)
    }
}
