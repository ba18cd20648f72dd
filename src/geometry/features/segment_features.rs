//! The features inside one segment.

use std::cell::LazyCell;

use super::arena::Arena;
use super::double_double::DoubleDouble;
use super::enclosure::at_ends;
use super::exact_numerators::ExactSegment;
use super::feature::Quantity;
use super::isolation::{Doubt, isolate};
use super::numerators::{Function, Numerators};
use super::segment_shape::SegmentShape;
use super::sign_piece::{Sign, SignPiece, append, with_starts};
use super::values;
use super::variations::certain_sign;
use crate::geometry::float_polygon::FloatPolygon;

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
    /// Where the tangent is proved to vanish, or where it may.
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
    quick: Arena<f64>,
    precise: Arena<DoubleDouble>,
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
        set_values(&mut features.curvature_slope, |t| {
            values::curvature(polygon, segment, t, planar)
        });
        set_values(&mut features.torsion_slope, |t| {
            values::torsion(polygon, segment, t)
        });
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
        let curvature = self.signs(Function::Feature(Quantity::Inflection));
        let curvature_slope = self.signs(Function::Feature(Quantity::CurvatureExtremum));
        let torsion = self.signs(Function::Feature(Quantity::TorsionZero));
        let torsion_slope = self.signs(Function::Feature(Quantity::TorsionExtremum));
        let cusps = self.cusps(&curvature_slope);
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

    fn signs(&mut self, function: Function) -> Vec<SignPiece> {
        let mut pieces = Vec::new();
        let polynomial = self.quick.of(function);
        if polynomial.vanishes() {
            append(&mut pieces, Sign::Zero, 1.0);
            return pieces;
        }
        let Err(doubt) = isolate(&mut self.prover.quick, polynomial, &mut pieces) else {
            return pieces;
        };
        pieces.clear();
        let exact = || self.exact.as_ref().map(|exact| exact.numerator(function));
        if doubt == Doubt::Everywhere && exact().is_some_and(|exact| exact.is_zero()) {
            append(&mut pieces, Sign::Zero, 1.0);
            return pieces;
        }
        let polynomial = self.precise().of(function);
        if isolate(&mut self.prover.precise, polynomial, &mut pieces).is_err() {
            pieces.clear();
            match self.exact.as_ref() {
                Some(exact) => exact.numerator(function).append_signs(&mut pieces),
                None => append(&mut pieces, Sign::Unknown, 1.0),
            }
        }
        pieces
    }

    fn precise(&mut self) -> Numerators {
        let (arena, shape, planar) = (&mut self.prover.precise, self.shape, self.prover.planar);
        *self
            .precise
            .get_or_insert_with(|| Numerators::new(arena, shape, planar))
    }

    /// Find where the tangent vanishes. The numerator of κ′ vanishes there as well, to at least
    /// the third order: so where its sign is known, and at its simple roots, there is no cusp.
    fn cusps(&mut self, slope: &[SignPiece]) -> Vec<LocalCusp> {
        if let Some(direction) = self.shape.line {
            let along = self.signs(Function::Along(direction));
            let mut cusps = line_cusps(&along);
            self.add_end_cusps(&mut cusps);
            return cusps;
        }
        let doubtful = |piece: &SignPiece| matches!(piece.sign, Sign::Unknown | Sign::Zero);
        let mut cusps = Vec::new();
        if slope.iter().any(doubtful) {
            let speed = self.signs(Function::Speed);
            let low = with_starts(&speed)
                .filter(|(_, piece)| !matches!(piece.sign, Sign::Positive))
                .map(|(start, piece)| [start, piece.until]);
            cusps.extend(low.map(|t| self.cusp(t)));
        }
        self.add_end_cusps(&mut cusps);
        cusps
    }

    /// Look for a cusp on a piece at its simplest fraction: there, and at few other places, can a
    /// zero of the whole tangent be proved.
    fn cusp(&self, t: [f64; 2]) -> LocalCusp {
        let [p, q] = simplest_fraction(t);
        let place = f64::from(p) / f64::from(q);
        let inside = t[0] < place && place < t[1];
        let proved = inside && self.tangent_vanishes(p, q);
        LocalCusp { t, proved }
    }

    fn tangent_vanishes(&self, p: u32, q: u32) -> bool {
        let exact = self.exact.as_ref();
        exact.is_some_and(|exact| exact.tangent_vanishes(p, q))
    }

    /// Add the ends at which every component of the tangent is exactly 0.
    fn add_end_cusps(&self, cusps: &mut Vec<LocalCusp>) {
        for (end, t) in [(0, 0.0), (1, 1.0)] {
            let may_vanish = self.quick.tangent.iter().all(|component| {
                let (values, errors) = self.prover.quick.coefficients(*component);
                let index = end as usize * component.degree();
                let end = values.get(index).zip(errors.get(index));
                end.is_none_or(|(value, error)| {
                    !matches!(certain_sign(*value, *error), Some(1 | -1))
                })
            });
            let inside = |cusp: &LocalCusp| cusp.proved && cusp.t[0] <= t && t <= cusp.t[1];
            if may_vanish && !cusps.iter().any(inside) && self.tangent_vanishes(end, 1) {
                cusps.push(LocalCusp {
                    t: [t, t],
                    proved: true,
                });
            }
        }
    }
}

/// Find the fraction of the least denominator between two numbers from 0 to 1, as well as rounding
/// lets it be found, by continued fractions.
fn simplest_fraction([low, high]: [f64; 2]) -> [u32; 2] {
    /// Simple enough for a curve that someone wrote down.
    const MOST_STEPS: usize = 8;
    let (mut low, mut high) = (low, high);
    // The last two convergents.
    let ([mut p, mut q], [mut last_p, mut last_q]) = ([1_u32, 0_u32], [0_u32, 1_u32]);
    for _ in 0..MOST_STEPS {
        let whole = low.floor();
        let ends = low == whole || whole + 1.0 <= high;
        let step = if low == whole {
            whole
        } else {
            whole + f64::from(u8::from(ends))
        };
        let next = |now: u32, last: u32| now.saturating_mul(step as u32).saturating_add(last);
        ([p, q], [last_p, last_q]) = ([next(p, last_p), next(q, last_q)], [p, q]);
        if ends {
            break;
        }
        (low, high) = (1.0 / (high - whole), 1.0 / (low - whole));
    }
    [p, q.max(1)]
}

/// Read off where a motion along a line, of which these are the velocity's signs, stands still.
fn line_cusps(velocity: &[SignPiece]) -> Vec<LocalCusp> {
    with_starts(velocity)
        .filter(|(_, piece)| piece.sign.direction().is_none())
        .map(|(start, piece)| LocalCusp {
            t: [start, piece.until],
            proved: matches!(piece.sign, Sign::Root { .. } | Sign::Zero),
        })
        .collect()
}

/// Put values into the roots among some pieces.
fn set_values(pieces: &mut [SignPiece], value_at: impl Fn(f64) -> f64) {
    let mut start = 0.0;
    for piece in pieces {
        if let Sign::Root { value } = &mut piece.sign {
            *value = value_at(0.5 * (start + piece.until));
        }
        start = piece.until;
    }
}
