//! Proved features of a whole curve.

use crate::geometry::end::End;
use crate::geometry::float_polygon::FloatPolygon;

/// Hold the proved features of a curve, each list in the order of u.
///
/// An interval `u` = \[lo, hi\] is part of the domain \[0, L\], lo ≤ hi; on a periodic curve one
/// that reaches over the joint has hi > L. The intervals of a list are disjoint, across the joint
/// of a periodic curve as well. Each holds exactly one feature, or as many as its `count` says if
/// doubles of u cannot tell them apart. It is at most 1e-12 wide (and one rounding of u); a single
/// point at a knot; or the whole of a piece on which the function is exactly 0 between two
/// different signs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// Sign changes of the signed curvature of a planar curve.
    pub inflections: Vec<Root>,
    /// Where the curvature — signed in the plane, ≥ 0 in space — turns from rising to falling
    /// or back. In space that may be a point where it is 0.
    pub curvature_extrema: Vec<Extremum>,
    /// Sign changes of the torsion of a space curve.
    pub torsion_zeros: Vec<Root>,
    /// Extrema of the torsion of a space curve.
    pub torsion_extrema: Vec<Extremum>,
    /// Places where the tangent vanishes or may vanish: the curvature is undefined.
    pub cusps: Vec<Cusp>,
    /// Intervals where a function may have uncounted roots.
    pub undecided: Vec<Undecided>,
    /// Pieces of the domain on which the curvature is proved to rise, to fall or to be
    /// constant. What they leave out are the intervals of extrema, undecided pieces and cusps, and
    /// pieces whose ends doubles of u cannot tell apart. A piece on which the curvature is constant
    /// is listed even if it is an extremum, or undecided, as a whole.
    pub trends: Vec<TrendPiece>,
    /// Whether the curvature is monotone: without an extremum inside the domain.
    pub monotone: Verdict,
}

/// Hold a place where the curvature or torsion changes its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// The interval that holds it.
    pub u: [f64; 2],
    /// Number of changes in the interval: 1 unless doubles of u cannot separate them.
    pub count: usize,
}

/// Hold an extremum of curvature or torsion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremum {
    /// The interval that holds it.
    pub u: [f64; 2],
    /// How many extrema the interval holds, maxima and minima in turn: 1 unless doubles of u
    /// cannot tell them apart.
    pub count: usize,
    /// Whether it, or the first of several, is a maximum or a minimum.
    pub kind: ExtremumKind,
    /// Bounds of the curvature or torsion there, at the first of several; at a jump those of the
    /// greater side of a maximum and of the smaller side of a minimum. Infinite where nothing is
    /// known.
    pub value: [f64; 2],
}

impl Features {
    /// Tell how many features of a kind are proved.
    pub fn count(&self, quantity: Feature) -> usize {
        let places = self.places(quantity).into_iter();
        places.map(|(_, count)| count).sum()
    }

    /// The largest curvature of the curve with these features, without its sign: at an end or an extremum. Infinite at
    /// a cusp.
    pub fn largest_curvature(&self, polygon: &FloatPolygon) -> f64 {
        if !self.cusps.is_empty() {
            return f64::INFINITY;
        }
        let ends = End::BOTH.map(|end| polygon.end_jet(end).curvature());
        let extrema = self.curvature_extrema.iter().map(|it| {
            let [low, high] = it.value.map(f64::abs);
            match low.min(high) {
                known if known.is_finite() => known,
                _ => polygon.jet(0.5 * (it.u[0] + it.u[1])).curvature(),
            }
        });
        ends.into_iter().chain(extrema).fold(0.0, f64::max)
    }

    /// The intervals of u that hold the features of a kind, with their numbers.
    pub fn places(&self, quantity: Feature) -> Vec<([f64; 2], usize)> {
        let of_roots = |roots: &[Root]| roots.iter().map(|it| (it.u, it.count)).collect();
        let of_extrema = |extrema: &[Extremum]| extrema.iter().map(|it| (it.u, it.count)).collect();
        match quantity {
            Feature::Inflection => of_roots(&self.inflections),
            Feature::CurvatureExtremum => of_extrema(&self.curvature_extrema),
            Feature::TorsionZero => of_roots(&self.torsion_zeros),
            Feature::TorsionExtremum => of_extrema(&self.torsion_extrema),
        }
    }
}

/// Tell maxima from minima.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExtremumKind {
    /// Rising before, falling behind.
    Maximum,
    /// Falling before, rising behind.
    Minimum,
}

/// Hold a place where the tangent vanishes or may vanish.
///
/// Its interval is a double or lies between neighbouring ones; a piece on which the curve stands
/// still is a cusp as a whole. Where exact numbers would take too long, places are reported with
/// `proved` false: the tangent is too small there for its sign to be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cusp {
    /// The interval that holds it.
    pub u: [f64; 2],
    /// Whether the tangent vanishes somewhere in it for certain.
    pub proved: bool,
}

/// Hold a piece on which features may lie that could not be counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undecided {
    /// The piece.
    pub u: [f64; 2],
    /// Which features may lie in it.
    pub quantity: Feature,
    /// Whether there is at least one for certain: the signs on both sides differ.
    pub certain: bool,
}

/// Name a kind of feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Inflections of a planar curve.
    Inflection,
    /// Extrema of the curvature.
    CurvatureExtremum,
    /// Zeros of the torsion.
    TorsionZero,
    /// Extrema of the torsion.
    TorsionExtremum,
}

/// Hold a piece of the domain on which the curvature does one thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrendPiece {
    /// The piece.
    pub u: [f64; 2],
    /// The trend of the curvature in it.
    pub trend: Trend,
}

/// Trend of the curvature as u grows: signed in the plane, ≥ 0 in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trend {
    /// It falls strictly.
    Falling,
    /// It is the same throughout.
    Constant,
    /// It rises strictly.
    Rising,
}

/// Answer a question about the given doubles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Verdict {
    /// Proved to be so.
    Proved,
    /// Proved not to be so.
    Disproved,
    /// Not proved either way.
    #[default]
    Undecided,
}
