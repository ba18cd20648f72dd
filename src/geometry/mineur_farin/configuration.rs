//! A configuration and the polygons on its points.

use glam::{DMat3, DVec3};

use crate::geometry::conversion::Approximation;
use crate::geometry::conversion::BezierPolygon;
use crate::geometry::error::PolygonError;
use crate::geometry::features::PowerVelocity;
use crate::geometry::float_polygon::FloatPolygon;

/// Directions count as parallel to the z axis if the sine of the angle between them is not above
/// this.
const UPRIGHT: f64 = 1e-9;

/// Steps that lead the last point to a place.
const WAY: usize = 32;

/// The most corrections a step of that.
const MOST_STEPS: usize = 30;

/// The largest change of ln s and of θ at once.
const LARGEST_CHANGE: f64 = 0.2;

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

    /// Change length ratio and turning angle so that the last point lies at a place, or as near to it as this
    /// finds: in the plane, where the last point is start + a (1 + λ + … + λᵏ⁻¹), it is exact to rounding.
    ///
    /// The last point is led along the straight way from where it is, in even steps,
    /// by damped Gauss–Newton steps in ln s and θ; derivatives come from the recurrence of the legs. Where the
    /// way leads through a place that cannot be reached, it goes on beside it.
    pub fn reaching(&self, legs: usize, place: DVec3) -> Self {
        let from = self.last_point(legs).0;
        let mut found = *self;
        for step in 1..=WAY {
            let target = from.lerp(place, step as f64 / WAY as f64);
            found = found.corrected(legs, target);
        }
        let (sine, cosine) = found.turn.sin_cos();
        Self {
            turn: sine.atan2(cosine),
            ..found
        }
    }

    /// Bring the last point nearer to a place, until rounding.
    fn corrected(mut self, legs: usize, target: DVec3) -> Self {
        let (mut last, mut slopes) = self.last_point(legs);
        for _ in 0..MOST_STEPS {
            let left = target - last;
            let [a, b] = slopes;
            // The normal equations of two unknowns.
            let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
            let determinant = aa * bb - ab * ab;
            let [ra, rb] = [a.dot(left), b.dot(left)];
            let change = [
                (bb * ra - ab * rb) / determinant,
                (aa * rb - ab * ra) / determinant,
            ];
            let largest = change.map(f64::abs).into_iter().fold(0.0, f64::max);
            if !largest.is_finite() {
                return self;
            }
            let mut share = (LARGEST_CHANGE / largest).min(1.0);
            let nearer = loop {
                let tried = Self {
                    ratio: self.ratio * (share * change[0]).exp(),
                    turn: self.turn + share * change[1],
                    ..self
                };
                let (point, slopes) = tried.last_point(legs);
                if point.distance(target) < left.length() {
                    break Some((tried, point, slopes));
                }
                share *= 0.5;
                if share * largest <= f64::EPSILON {
                    break None;
                }
            };
            match nearer {
                Some(nearer) => (self, last, slopes) = nearer,
                None => return self,
            }
        }
        self
    }

    /// The last point, and its derivatives by ln s and by θ.
    fn last_point(&self, legs: usize) -> (DVec3, [DVec3; 2]) {
        let step = self.step();
        let (sine, cosine) = self.turn.sin_cos();
        let turning = DMat3::from_cols_array(&[
            -sine, cosine, 0.0, //
            -cosine, -sine, 0.0, //
            0.0, 0.0, 0.0,
        ]);
        let turned = turning * DMat3::from_rotation_x(self.torsion) * self.ratio;
        let mut frame = self.frame();
        let mut slopes = [DMat3::ZERO; 2];
        let mut point = self.start;
        let mut point_slopes = [DVec3::ZERO; 2];
        for _ in 0..legs {
            point += frame.x_axis;
            point_slopes[0] += slopes[0].x_axis;
            point_slopes[1] += slopes[1].x_axis;
            slopes = [
                slopes[0] * step + frame * step,
                slopes[1] * step + frame * turned,
            ];
            frame *= step;
        }
        (point, point_slopes)
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

    /// Prove how the velocity of the Bézier curve on `legs` legs turns. The rotation M of a leg to the next one
    /// turns by θ about the binormal after turning by the torsion angle τ about the leg: as a quaternion
    /// (sin τ/2 cos θ/2, sin τ/2 sin θ/2, cos τ/2 sin θ/2, cos τ/2 cos θ/2), in the frame of the leg.
    pub(super) fn bezier_velocity(&self, legs: usize) -> PowerVelocity {
        let [turn, torsion] = [self.turn, self.torsion].map(|angle| (0.5 * angle).sin_cos());
        PowerVelocity {
            along: (torsion.0 * turn.1).powi(2),
            across: turn.0.powi(2),
            ratio: self.ratio,
            degree: legs,
        }
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
