//! A configuration and the polygons on its points.

use glam::{DMat3, DVec3};

use crate::geometry::bezier_polygon::BezierPolygon;
use crate::geometry::conversion::Approximation;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;

/// Directions count as parallel to the z axis if the sine of the angle between them is not above
/// this.
const UPRIGHT: f64 = 1e-9;

/// Hold a Mineur–Farin configuration: leg k is sᵏ Mᵏ a, where a is the first leg, s the length ratio
/// and M the rotation that turns by the turning angle θ about the binormal, and the binormal by the
/// torsion angle about the leg. In the plane legs multiply by the complex number λ = s e^{iθ}.
///
/// The binormal of the first two legs is upright: as near to the z axis as the first leg allows; if
/// that is parallel to the z axis, the y axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Configuration {
    /// The first point.
    pub start: DVec3,
    /// From the first point to the second.
    pub first_leg: DVec3,
    /// The length of each leg, as a multiple of that before it.
    pub ratio: f64,
    /// The angle from each leg to the next, in radians, positive to the left.
    pub turn: f64,
    /// The angle from the plane of two neighbouring legs to that of the next two, in radians.
    pub torsion: f64,
}

/// Say which control polygon the points of a configuration are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A float polygon.
    Float {
        /// Its degree.
        degree: usize,
    },
    /// A Bézier polygon, of as many legs as its degree.
    Bezier,
}

impl Configuration {
    /// List the points, one more than there are legs.
    pub fn points(&self, legs: usize) -> Vec<DVec3> {
        let step = self.step();
        // The first column is the leg.
        let mut frame = self.frame();
        let mut point = self.start;
        let mut points = vec![point];
        for _ in 0..legs {
            point += frame.x_axis;
            points.push(point);
            frame *= step;
        }
        points
    }

    /// The curve on the points as the polygon of a format; a Bézier curve is held by the float
    /// polygon nearest to it.
    ///
    /// # Errors
    /// [`PolygonError`] if the number of legs is below the degree, the degree is out of range, or
    /// points lie beyond the range of coordinates; for a Bézier polygon also as
    /// [`BezierPolygon::nearest_float`].
    pub fn curve(&self, format: Format, legs: usize) -> Result<Approximation, PolygonError> {
        let points = self.points(legs);
        match format {
            Format::Float { degree } => {
                let polygon = FloatPolygon::new(degree, points, None, false)?;
                Ok(Approximation::exact(polygon))
            }
            Format::Bezier => {
                let nearest = BezierPolygon::new(legs, points, None)?.nearest_float()?;
                Ok(Approximation {
                    polygon: nearest.polygon,
                    exact: false,
                    deviation: nearest.deviation,
                })
            }
        }
    }

    /// The float polygon of the Bézier curve on the points in closed form, up to a translation: quick,
    /// where the general conversion keeps more digits.
    ///
    /// As C′(t) = n (I + (sM − I) t)ⁿ⁻¹ a, leg i of the float polygon is n ∏ (I + (sM − I) j) a over
    /// j = i − n + 2 … i: the blossom of C′ at the knots that the leg's two vertices share.
    ///
    /// # Errors
    /// [`PolygonError`] if the degree is out of range, or points lie beyond the range of coordinates.
    pub(super) fn bezier_as_float(&self, degree: usize) -> Result<FloatPolygon, PolygonError> {
        let (frame, growth) = (self.frame(), self.step() - DMat3::IDENTITY);
        let mut point = DVec3::ZERO;
        let mut vertices = vec![point];
        for leg in 0..degree {
            let knots = (leg + 2)..(leg + 1 + degree);
            let blossom = knots.fold(DVec3::X * degree as f64, |vector, knot| {
                let knot = knot as f64 - degree as f64;
                vector + knot * (growth * vector)
            });
            point += frame * blossom;
            vertices.push(point);
        }
        FloatPolygon::new(degree, vertices, None, false)
    }

    /// Find where the curvature of the planar Bézier curve on the points has its only extremum, if
    /// that lies inside the curve: at t* = (1 − s cos θ) / (1 − 2 s cos θ + s²), as
    /// κ(t) is a multiple of 1 / |1 + (λ − 1) t|ⁿ⁺¹. So the curvature is monotone if s cos θ ≥ 1 or
    /// s ≤ cos θ. A straight line has no extremum.
    pub fn bezier_extremum(&self) -> Option<f64> {
        let (ratio, cosine) = (self.ratio, self.turn.cos());
        let inside = ratio * cosine < 1.0 && ratio > cosine;
        let speed = 1.0 - 2.0 * ratio * cosine + ratio * ratio;
        inside.then(|| (1.0 - ratio * cosine) / speed)
    }

    /// The unit vector that is normal to the first two legs, so that a positive angle turns to the
    /// left about it; 0 if the first leg is.
    pub fn binormal(&self) -> DVec3 {
        let along = self.first_leg.normalize_or_zero();
        let upright = if along.cross(DVec3::Z).length() > UPRIGHT {
            DVec3::Z
        } else {
            DVec3::Y
        };
        (upright - along * along.dot(upright)).normalize_or_zero()
    }

    /// sM: takes each leg to the next, in the frame of the first.
    fn step(&self) -> DMat3 {
        let (sine, cosine) = self.turn.sin_cos();
        let turning = DMat3::from_cols_array(&[
            cosine, sine, 0.0, //
            -sine, cosine, 0.0, //
            0.0, 0.0, 1.0,
        ]);
        turning * DMat3::from_rotation_x(self.torsion) * self.ratio
    }

    /// The first leg, and what is normal to it within the plane of the first two legs and beyond, as
    /// long as the leg.
    fn frame(&self) -> DMat3 {
        let (leg, binormal) = (self.first_leg, self.binormal());
        DMat3::from_cols(leg, binormal.cross(leg), binormal * leg.length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_of_a_bezier_curves_float_polygon_is_its_conversion() {
        for (torsion, degree) in [(0.0, 2), (0.0, 5), (0.3, 5), (0.3, 7)] {
            let configuration = Configuration {
                start: DVec3::ZERO,
                first_leg: DVec3::new(1.0, 2.0, 0.5),
                ratio: 1.3,
                turn: -0.7,
                torsion,
            };
            let converted = configuration
                .curve(Format::Bezier, degree)
                .expect("a curve");
            let found = configuration.bezier_as_float(degree).expect("a polygon");
            let (converted, found) = (converted.polygon.vertices(), found.vertices());
            let size = converted.iter().map(|vertex| vertex.length());
            let size = size.fold(0.0, f64::max);
            for (a, b) in converted.iter().zip(found) {
                let off = (*a - converted[0]).distance(*b);
                assert!(off <= 1e-9 * size, "degree {degree}: {off:e} of {size:e}");
            }
        }
    }
}
