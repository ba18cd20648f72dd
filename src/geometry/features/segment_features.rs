//! The features inside one segment.

use std::cell::LazyCell;

use super::arena::Arena;
use super::enclosure::{UNKNOWN, at_ends, narrower};
use super::exact_numerators::ExactSegment;
use super::exact_polynomial::ExactPolynomial;
use super::feature::Feature;
use super::isolation::{Doubt, isolate};
use super::numerators::{Function, Numerators};
use super::refinement::bisect;
use super::segment_shape::SegmentShape;
use super::sign_piece::{Sign, SignPiece, append, with_starts};
use super::values::{at_extremum, is_known};
use super::variations::certain_sign;
use crate::geometry::expansion::DoubleDouble;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::whole_numbers::fraction;

/// Hold what is proved of one segment, its two ends included as far as they can be seen from
/// this side. It depends on the segment's n + 1 vertices and weights alone, so it stays valid
/// until one of them changes.
///
/// Each list of pieces covers the segment from t = 0 to t = 1; the first and the last piece
/// give the one-sided signs at its ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SegmentFeatures {
    /// The sign of the signed curvature of a planar curve; [`Sign::Zero`] throughout in space,
    /// where curvature has no sign.
    pub curvature: Vec<SignPiece>,
    /// The sign of the derivative of the curvature: signed in the plane, ≥ 0 in space.
    pub curvature_slope: Vec<SignPiece>,
    /// The sign of the torsion; [`Sign::Zero`] throughout in the plane.
    pub torsion: Vec<SignPiece>,
    /// The sign of the derivative of the torsion; [`Sign::Zero`] throughout in the plane.
    pub torsion_slope: Vec<SignPiece>,
    /// Places where the tangent vanishes or may vanish.
    pub cusps: Vec<LocalCusp>,
    /// Bounds of the curvature at t = 0 and t = 1, seen from inside.
    pub end_curvature: [[f64; 2]; 2],
    /// Bounds of the torsion at t = 0 and t = 1, seen from inside.
    pub end_torsion: [[f64; 2]; 2],
}

/// Hold a piece of a segment on which the tangent vanishes or may vanish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalCusp {
    /// The piece, in the local parameter.
    pub t: [f64; 2],
    /// Whether there is a zero of the tangent in it for certain.
    pub proved: bool,
}

/// Prove the features of single segments, one after the other, in room that is used again.
#[derive(Debug)]
pub struct SegmentProver {
    planar: bool,
    pub(super) quick: Arena<f64>,
    pub(super) precise: Arena<DoubleDouble>,
}

impl SegmentFeatures {
    /// Prove the features of every segment of a curve. `wanted` is asked before each one, with its
    /// number, whether to go on; `None` if not.
    pub fn of_curve(
        polygon: &FloatPolygon,
        mut wanted: impl FnMut(usize) -> bool,
    ) -> Option<Vec<Self>> {
        let mut prover = SegmentProver::new(polygon.is_planar());
        let segments = 0..polygon.segments();
        let prove = |segment| wanted(segment).then(|| prover.segment(polygon, segment));
        segments.map(prove).collect()
    }
}

impl SegmentProver {
    /// Prepare for curves in the plane z = 0, or for curves in space. All segments of a curve
    /// must be treated alike: curvature has a sign in the plane only.
    pub fn new(planar: bool) -> Self {
        Self {
            planar,
            quick: Arena::default(),
            precise: Arena::default(),
        }
    }

    /// Prove the features of one segment.
    ///
    /// Plain doubles decide nearly always; what they leave in doubt is repeated with twice the
    /// digits, at some 30 times the cost, and what these leave in doubt in whole numbers.
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    pub fn segment(&mut self, polygon: &FloatPolygon, segment: usize) -> SegmentFeatures {
        let shape = SegmentShape::new(polygon, segment, self.planar);
        let quick = Numerators::new(&mut self.quick, &shape, self.planar);
        let [start, end] = at_ends(&self.quick, &quick, &shape, self.planar);
        let planar = self.planar;
        let mut search = Search {
            prover: self,
            shape: &shape,
            quick,
            precise: None,
            exact: LazyCell::new(Box::new(|| ExactSegment::new(polygon, segment, planar))),
        };
        let mut features = search.features();
        features.end_curvature = [start[0], end[0]];
        features.end_torsion = [start[1], end[1]];
        search.set_values(&mut features.curvature_slope, Feature::CurvatureExtremum);
        search.set_values(&mut features.torsion_slope, Feature::TorsionExtremum);
        features
    }
}

/// The search for the signs of all numerators of one segment.
struct Search<'a> {
    prover: &'a mut SegmentProver,
    shape: &'a SegmentShape,
    quick: Numerators,
    precise: Option<Numerators>,
    exact: LazyCell<Option<ExactSegment>, Box<dyn FnOnce() -> Option<ExactSegment> + 'a>>,
}

impl Search<'_> {
    fn features(&mut self) -> SegmentFeatures {
        let (curvature, _) = self.signs(Function::Feature(Feature::Inflection));
        let (curvature_slope, tier) = self.signs(Function::Feature(Feature::CurvatureExtremum));
        let (torsion, _) = self.signs(Function::Feature(Feature::TorsionZero));
        let (torsion_slope, _) = self.signs(Function::Feature(Feature::TorsionExtremum));
        let cusps = self.cusps(tier);
        SegmentFeatures {
            curvature,
            curvature_slope,
            torsion,
            torsion_slope,
            cusps,
            end_curvature: Default::default(),
            end_torsion: Default::default(),
        }
    }

    /// Find the signs of a function, and the effort.
    fn signs(&mut self, function: Function) -> (Vec<SignPiece>, Tier) {
        let mut pieces = Vec::new();
        let polynomial = self.quick.of(function);
        if polynomial.vanishes {
            append(&mut pieces, Sign::Zero, 1.0);
            return (pieces, Tier::Exact);
        }
        let Err(doubt) = isolate(&mut self.prover.quick, polynomial, &mut pieces) else {
            return (pieces, Tier::Rounded);
        };
        pieces.clear();
        let exact = || self.exact.as_ref().map(|exact| exact.numerator(function));
        if doubt == Doubt::Everywhere && exact().is_some_and(|exact| exact.is_zero()) {
            append(&mut pieces, Sign::Zero, 1.0);
            return (pieces, Tier::Exact);
        }
        let polynomial = self.precise().of(function);
        if isolate(&mut self.prover.precise, polynomial, &mut pieces).is_ok() {
            return (pieces, Tier::Rounded);
        }
        pieces.clear();
        match self.exact.as_ref() {
            Some(exact) => exact.numerator(function).append_signs(&mut pieces),
            None => append(&mut pieces, Sign::Unknown, 1.0),
        }
        (pieces, Tier::Exact)
    }

    fn precise(&mut self) -> Numerators {
        let (arena, shape, planar) = (&mut self.prover.precise, self.shape, self.prover.planar);
        *self
            .precise
            .get_or_insert_with(|| Numerators::new(arena, shape, planar))
    }

    /// Find where the tangent vanishes. The numerator of κ′ vanishes there as well, to at least
    /// the third order: where rounded numbers found all its roots, and that they are simple, there
    /// is no cusp. Otherwise cusps are the roots that all components of the tangent share.
    fn cusps(&mut self, slope: Tier) -> Vec<LocalCusp> {
        let mut cusps = Vec::new();
        if slope == Tier::Exact {
            let zeros = self.exact.as_ref().and_then(ExactSegment::tangent_zeros);
            match zeros {
                Some(zeros) => cusps.extend(exact_cusps(&zeros)),
                None => cusps.extend(self.possible_cusps()),
            }
        }
        self.add_end_cusps(&mut cusps);
        cusps
    }

    /// List the pieces on which the speed, or the velocity on a line, is not proved to differ
    /// from 0.
    fn possible_cusps(&mut self) -> Vec<LocalCusp> {
        let (speed, on_line) = match self.shape.line {
            Some(direction) => (self.signs(Function::Along(direction)).0, true),
            None => (self.signs(Function::Speed).0, false),
        };
        let low = with_starts(&speed).filter(|(_, piece)| piece.sign.direction().is_none());
        low.map(|(start, piece)| LocalCusp {
            t: [start, piece.until],
            proved: on_line && piece.sign != Sign::Unknown,
        })
        .collect()
    }

    /// Bound the curvature or torsion at the roots of its derivative.
    fn set_values(&mut self, pieces: &mut [SignPiece], quantity: Feature) {
        let (mut start, mut is_maximum) = (0.0, false);
        for piece in pieces {
            let ends = [start, piece.until];
            if let Sign::Root { count, value } = &mut piece.sign {
                *value = self.value(quantity, (ends, is_maximum), *count);
            }
            start = piece.until;
            is_maximum = piece.sign == Sign::Positive;
        }
    }

    fn value(&mut self, quantity: Feature, place: ([f64; 2], bool), count: usize) -> [f64; 2] {
        let curve = (self.shape, self.prover.planar);
        let mut bounds = UNKNOWN;
        if count == 1 {
            bounds = at_extremum(&self.prover.quick, &self.quick, curve, quantity, place);
            if is_known(bounds) {
                return bounds;
            }
            let may_be_flat = quantity == Feature::CurvatureExtremum && bounds[0] <= 0.0;
            let flat = |exact: &ExactSegment| exact.is_flat_between(place.0);
            if may_be_flat && self.exact.as_ref().is_some_and(flat) {
                return [0.0, 0.0];
            }
            let precise = self.precise();
            bounds = at_extremum(&self.prover.precise, &precise, curve, quantity, place);
        }
        match self.exact.as_ref() {
            Some(exact) if !is_known(bounds) => narrower(bounds, exact.enclose(quantity, place.0)),
            _ => bounds,
        }
    }

    /// Add the ends at which every component of the tangent is exactly 0.
    fn add_end_cusps(&self, cusps: &mut Vec<LocalCusp>) {
        for (end, t) in [(0_usize, 0.0), (1, 1.0)] {
            let may_vanish = self.quick.tangent.iter().all(|component| {
                let (values, errors) = self.prover.quick.coefficients(*component);
                let index = end * component.degree;
                let end = values.get(index).zip(errors.get(index));
                end.is_none_or(|(value, error)| {
                    !matches!(certain_sign(*value, *error), Some(1 | -1))
                })
            });
            let inside = |cusp: &LocalCusp| cusp.proved && cusp.t[0] <= t && t <= cusp.t[1];
            let vanishes = |exact: &ExactSegment| exact.tangent_vanishes(end == 1);
            if may_vanish && !cusps.iter().any(inside) && self.exact.as_ref().is_some_and(vanishes)
            {
                cusps.push(LocalCusp {
                    t: [t, t],
                    proved: true,
                });
            }
        }
    }
}

/// Effort of finding the signs of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tier {
    /// Rounded numbers were enough: all roots are simple.
    Rounded,
    /// It took whole numbers, or the function is 0 throughout.
    Exact,
}

/// Separate the zeros of the tangent as far as doubles can.
fn exact_cusps(zeros: &ExactPolynomial) -> Vec<LocalCusp> {
    let proved = |t: [f64; 2], proved: bool| LocalCusp { t, proved };
    if zeros.is_zero() {
        return vec![proved([0.0, 1.0], true)];
    }
    let mut pieces = Vec::new();
    zeros.append_simple_roots(&mut pieces);
    let mut before = Sign::Zero;
    let mut cusps = Vec::new();
    for (start, piece) in with_starts(&pieces) {
        let t = [start, piece.until];
        match (piece.sign, before.direction()) {
            (Sign::Root { count: 1, .. }, Some(sign)) => {
                let narrow = bisect(t, |t| 0.cmp(&(zeros.sign_at(&fraction(t)) * sign)));
                cusps.push(proved(narrow, true));
            }
            (Sign::Root { .. }, _) => cusps.push(proved(t, true)),
            (Sign::Unknown, _) => cusps.push(proved(t, false)),
            _ => {}
        }
        before = piece.sign;
    }
    cusps
}
