//! Curvature and torsion levels (paper, section 5): the curvature, the curvature of its graph
//! over arc length, the curvature of that graph, and so on.
//!
//! Everything is Taylor arithmetic in the parameter u. Level m + 1 takes two derivatives of
//! level m, so level 4 of the curvature needs eight derivatives of the curve, level 4 of the
//! torsion nine. Derivatives by arc length are d/ds = (1/|C′|) d/du.

use std::array::from_fn;

use glam::{DVec3, DVec4};

use super::float_polygon::FloatPolygon;
use super::power_of_two::{exponent, power_of_two, times_power_of_two};
use super::segment_expansion::SegmentExpansion;
use super::taylor_series::TaylorSeries;

/// The number of levels.
pub const LEVELS: usize = 4;

/// Coefficients of level 1: six derivatives, two for each further level.
const FIRST: usize = 7;

/// Coefficients of C′ that the curvature needs, and those that the torsion needs.
const PLANAR: usize = FIRST + 1;
const SPATIAL: usize = FIRST + 2;

/// The order of the highest derivative of a curve that its levels take.
pub const LEVEL_ORDER: usize = SPATIAL;

/// Hold levels 1 to 4 of curvature and torsion at one parameter of a curve.
///
/// Level 1 is the curvature κ(s) and the torsion τ(s) themselves; level m + 1 is g″/(1 + g′²)^{3/2},
/// the signed curvature of the graph g = level m over arc length s. Levels above the first are
/// not invariant under scaling.
///
/// At a cusp (C′ = 0) no level is a number. Where the curvature of a space curve is 0 it has a
/// kink: level 1 is 0, its slope, the higher levels and the torsion are not numbers. On a straight
/// line whose derivatives are parallel without rounding all levels of the curvature are 0, and
/// those of the torsion not numbers. Values beyond the range of numbers are infinite or not
/// numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureLevels {
    /// Levels 1 to 4 of the curvature: signed (left turns are positive) if the curve lies in the
    /// plane z = 0, else level 1 is ≥ 0. Level 1 is per unit of length.
    pub curvature: [f64; LEVELS],
    /// The derivatives of levels 1 to 3 of the curvature by arc length; the first is dκ/ds.
    pub curvature_slopes: [f64; LEVELS - 1],
    /// Levels 1 to 4 of the torsion; `None` if the curve lies in the plane z = 0.
    pub torsion: Option<[f64; LEVELS]>,
    /// The derivatives of levels 1 to 3 of the torsion by arc length.
    pub torsion_slopes: Option<[f64; LEVELS - 1]>,
}

impl CurvatureLevels {
    /// Compute the levels of a curve, scaled by `scale` > 0, from its point and derivatives at a
    /// parameter; `planar` tells whether the curve lies in the plane z = 0.
    pub fn of_derivatives(
        derivatives: &[DVec3; LEVEL_ORDER + 1],
        scale: f64,
        planar: bool,
    ) -> Self {
        let mut factorial = 1.0;
        let series: [DVec4; LEVEL_ORDER + 1] = from_fn(|order| {
            factorial *= order.max(1) as f64;
            (derivatives[order] / factorial).extend(0.0)
        });
        if planar {
            planar_levels(&Motion::new::<{ PLANAR + 1 }>(
                from_fn(|order| series[order]),
                scale,
            ))
        } else {
            spatial_levels(&Motion::new(series, scale))
        }
    }

    /// Find the point of the logarithmic curvature graph: X = log ρ, Y = log |ρ ds/dρ|.
    pub fn logarithmic(&self) -> Option<(f64, f64)> {
        logarithmic_point(self.curvature[0], self.curvature_slopes[0])
    }
}

/// Compute the point of the logarithmic curvature graph at a curvature κ and its slope dκ/ds:
/// (log ρ, log |ρ ds/dρ|) to base 10, with the radius of curvature ρ = 1/|κ|; ρ ds/dρ is −κ/(dκ/ds).
///
/// The graph of a log-aesthetic curve is a straight line of slope α (Yoshida and Saito,
/// "Interactive aesthetic curve segments", 2006). `None` where κ or dκ/ds is 0 or beyond the
/// range of numbers.
pub fn logarithmic_point(curvature: f64, slope: f64) -> Option<(f64, f64)> {
    let curvature = curvature.abs().log10();
    let slope = slope.abs().log10();
    let there = curvature.is_finite() && slope.is_finite();
    there.then_some((-curvature, curvature - slope))
}

impl FloatPolygon {
    /// Compute the levels at the parameter u of the curve scaled by `scale` > 0: 1 for the curve
    /// as it is, 1 over its length for levels that do not depend on its size.
    ///
    /// A curve of degree n has n − 1 continuous derivatives, and level m of the curvature takes
    /// 2m, of the torsion 2m + 1. At a knot the levels are those of the segment that starts there
    /// (at u = L of the last one); [`FloatPolygon::segment_curvature_levels`] gives either side.
    pub fn curvature_levels(&self, u: f64, scale: f64) -> CurvatureLevels {
        let (segment, t) = self.locate(u);
        self.segment_curvature_levels(segment, t, scale)
    }

    /// Compute the levels at the local parameter t in \[0, 1\] of a given segment: at a knot this
    /// chooses the side, with t = 0 or t = 1.
    ///
    /// For many parameters of one segment keep a [`SegmentExpansion`].
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    pub fn segment_curvature_levels(&self, segment: usize, t: f64, scale: f64) -> CurvatureLevels {
        SegmentExpansion::new(self, segment, self.is_planar()).curvature_levels(t, scale)
    }
}

impl SegmentExpansion {
    /// Compute the levels at the local parameter t in \[0, 1\] of the curve scaled by `scale` > 0.
    pub fn curvature_levels(&self, t: f64, scale: f64) -> CurvatureLevels {
        if self.is_planar() {
            planar_levels(&Motion::new(self.about::<{ PLANAR + 1 }>(t), scale))
        } else {
            spatial_levels(&Motion::new(self.about::<{ SPATIAL + 1 }>(t), scale))
        }
    }
}

/// The derivative of the curve by its parameter, in a unit of length in which it is about 1.
struct Motion<const LENGTH: usize> {
    /// x′, y′ and z′.
    velocity: [TaylorSeries<LENGTH>; 3],
    /// The unit of length is 2 to this power.
    unit: i32,
}

impl<const LENGTH: usize> Motion<LENGTH> {
    #[inline(always)]
    fn new<const LONGER: usize>(curve: [DVec4; LONGER], scale: f64) -> Self {
        const { assert!(LONGER == LENGTH + 1) };
        let speed = exponent(curve[1].truncate().abs().max_element());
        let scaling = exponent(scale);
        let mantissa = times_power_of_two(scale, -scaling);
        let velocity = std::array::from_fn(|axis| {
            let coordinate = TaylorSeries(curve.map(|coefficient| coefficient[axis]));
            let velocity = coordinate.derivative::<LENGTH>();
            TaylorSeries(
                velocity
                    .0
                    .map(|value| times_power_of_two(value, -speed) * mantissa),
            )
        });
        let unit = speed + scaling;
        Self { velocity, unit }
    }
}

/// One level as a function of the parameter: a series times 2 to the power `exponent`.
#[derive(Clone, Copy)]
struct Level<const LENGTH: usize> {
    series: TaylorSeries<LENGTH>,
    exponent: i32,
}

impl<const LENGTH: usize> Level<LENGTH> {
    fn value(&self) -> f64 {
        times_power_of_two(self.series.value(), self.exponent)
    }
}

/// The arc length that belongs to a parameter.
struct ArcLength {
    /// du/ds, in the inverse of the unit.
    rate: TaylorSeries<FIRST>,
    unit: i32,
}

impl ArcLength {
    /// Compute the derivative of a level by arc length.
    fn slope<const LENGTH: usize>(&self, level: &Level<LENGTH>) -> f64 {
        let slope = level.series.0[1] * self.rate.value();
        times_power_of_two(slope, level.exponent - self.unit)
    }

    /// Compute the levels that begin with `first`, and the slopes of all but the last.
    #[inline(always)]
    fn levels(&self, first: Level<FIRST>) -> ([f64; LEVELS], [f64; LEVELS - 1]) {
        let second = self.next::<7, 6, 5>(&first);
        let third = self.next::<5, 4, 3>(&second);
        let fourth = self.next::<3, 2, 1>(&third);
        (
            [first.value(), second.value(), third.value(), fourth.value()],
            [self.slope(&first), self.slope(&second), self.slope(&third)],
        )
    }

    /// Compute the level after g: g″/(1 + g′²)^{3/2}.
    #[inline(always)]
    fn next<const LONG: usize, const MIDDLE: usize, const SHORT: usize>(
        &self,
        level: &Level<LONG>,
    ) -> Level<SHORT> {
        let slope = level.series.derivative::<MIDDLE>() * self.rate.truncated();
        let bend = slope.derivative::<SHORT>() * self.rate.truncated();
        let slope_exponent = level.exponent - self.unit;
        // Where g′ is large, 1 + g′² is computed in units of its size.
        let steep = (slope_exponent + exponent(slope.value())).max(0);
        let rise = slope.truncated::<SHORT>() * power_of_two(slope_exponent - steep);
        let mut square = rise * rise;
        square.0[0] += power_of_two(-2 * steep);
        Level {
            series: bend * square.half_power(-3),
            exponent: slope_exponent - self.unit - 3 * steep,
        }
    }
}

fn planar_levels(motion: &Motion<PLANAR>) -> CurvatureLevels {
    let [x, y, _] = motion.velocity;
    let turning = x.truncated() * y.derivative() - y.truncated() * x.derivative();
    let (x, y) = (x.truncated::<FIRST>(), y.truncated());
    let rate = (x * x + y * y).half_power(-1);
    let unit = motion.unit;
    let arc_length = ArcLength { rate, unit };
    let curvature = Level {
        series: turning * rate * rate * rate,
        exponent: -unit,
    };
    let (curvature, curvature_slopes) = arc_length.levels(curvature);
    CurvatureLevels {
        curvature,
        curvature_slopes,
        torsion: None,
        torsion_slopes: None,
    }
}

fn spatial_levels(motion: &Motion<SPATIAL>) -> CurvatureLevels {
    let unit = motion.unit;
    let velocity = motion.velocity;
    let acceleration = velocity.map(|series| series.derivative::<{ SPATIAL - 1 }>());
    let change = acceleration.map(|series| series.derivative::<FIRST>());
    let velocity = velocity.map(|series| series.truncated::<FIRST>());
    let acceleration = acceleration.map(|series| series.truncated());
    let rate = dot(&velocity, &velocity).half_power(-1);
    let arc_length = ArcLength { rate, unit };

    let binormal = cross(&velocity, &acceleration);
    let values = binormal.map(|series| series.value().abs());
    let size = exponent(values.into_iter().fold(0.0, f64::max));
    let binormal = binormal.map(|series| series * power_of_two(-size));
    let square = dot(&binormal, &binormal);
    let straight = binormal == [TaylorSeries::ZERO; 3];
    let length = if straight {
        square
    } else {
        square.half_power(1)
    };
    let curvature = Level {
        series: length * rate * rate * rate,
        exponent: size - unit,
    };
    // Two factors |C′ × C″| of the denominator, one of the numerator.
    let inverse = square.half_power(-1);
    let torsion = Level {
        series: dot(&binormal, &change) * inverse * inverse,
        exponent: -size - unit,
    };
    let (curvature, curvature_slopes) = arc_length.levels(curvature);
    let (torsion, torsion_slopes) = arc_length.levels(torsion);
    CurvatureLevels {
        curvature,
        curvature_slopes,
        torsion: Some(torsion),
        torsion_slopes: Some(torsion_slopes),
    }
}

type Vector = [TaylorSeries<FIRST>; 3];

#[inline(always)]
fn dot(a: &Vector, b: &Vector) -> TaylorSeries<FIRST> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
