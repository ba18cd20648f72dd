//! The features inside one segment.

use super::arena::{Arena, Polynomial};
use super::double_double::DoubleDouble;
use super::enclosure::at_ends;
use super::isolation::{Effort, isolate};
use super::numerators::Numerators;
use super::segment_shape::SegmentShape;
use super::sign_piece::{Sign, SignPiece, append, with_starts};
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

/// Picks a polynomial of which the signs are wanted.
type Choice = fn(&Numerators) -> Polynomial;

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
    /// digits, at some 30 times the cost. The cost is bounded by the degree alone.
    ///
    /// # Panics
    /// If the curve has no segment with this number.
    pub fn segment(&mut self, polygon: &FloatPolygon, segment: usize) -> SegmentFeatures {
        let shape = SegmentShape::new(polygon, segment, self.planar);
        let quick = Numerators::new(&mut self.quick, &shape, self.planar);
        let [start, end] = at_ends(&self.quick, &quick, &shape, self.planar);
        let mut search = Search {
            prover: self,
            shape: &shape,
            quick,
            precise: None,
        };
        let mut features = search.features();
        features.end_curvature = [start[0], end[0]];
        features.end_torsion = [start[1], end[1]];
        let planar = self.planar;
        let jet = |t: f64| polygon.segment_jet(segment, t);
        set_values(&mut features.curvature_slope, |t| {
            if planar {
                jet(t).signed_curvature()
            } else {
                jet(t).curvature()
            }
        });
        set_values(&mut features.torsion_slope, |t| jet(t).torsion());
        features
    }
}

/// The search for the signs of all numerators of one segment.
struct Search<'a> {
    prover: &'a mut SegmentProver,
    shape: &'a SegmentShape,
    quick: Numerators,
    precise: Option<Numerators>,
}

impl Search<'_> {
    fn features(&mut self) -> SegmentFeatures {
        let curvature = self.signs(|numerators| numerators.curvature);
        let curvature_slope = self.signs(|numerators| numerators.curvature_slope);
        let torsion = self.signs(|numerators| numerators.torsion);
        let torsion_slope = self.signs(|numerators| numerators.torsion_slope);
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

    fn signs(&mut self, choose: Choice) -> Vec<SignPiece> {
        let mut pieces = Vec::new();
        let polynomial = choose(&self.quick);
        if polynomial.vanishes() {
            append(&mut pieces, Sign::Zero, 1.0);
        } else if isolate(
            &mut self.prover.quick,
            polynomial,
            Effort::Quick,
            &mut pieces,
        )
        .is_err()
        {
            pieces.clear();
            let polynomial = choose(&self.precise());
            // A thorough search never gives up.
            let _ = isolate(
                &mut self.prover.precise,
                polynomial,
                Effort::Thorough,
                &mut pieces,
            );
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
        if self.shape.straight {
            let along = self.signs(|numerators| numerators.tangent[0]);
            let mut cusps = line_cusps(&along);
            self.add_end_cusps(&mut cusps);
            return cusps;
        }
        let doubtful =
            |piece: &SignPiece| matches!(piece.sign, Sign::Unknown | Sign::Edge | Sign::Zero);
        let mut cusps = Vec::new();
        if slope.iter().any(doubtful) {
            let speed = self.signs(|numerators| numerators.speed);
            let low = with_starts(&speed)
                .filter(|(_, piece)| !matches!(piece.sign, Sign::Positive))
                .map(|(start, piece)| [start, piece.until]);
            cusps.extend(low.map(|t| LocalCusp { t, proved: false }));
        }
        self.add_end_cusps(&mut cusps);
        cusps
    }

    /// Add the ends at which every component of the tangent is exactly 0.
    fn add_end_cusps(&mut self, cusps: &mut Vec<LocalCusp>) {
        for (at_end, t) in [(false, 0.0), (true, 1.0)] {
            let vanishes = self.quick.tangent.iter().all(|component| {
                let (values, errors) = self.prover.quick.coefficients(*component);
                let index = if at_end { component.degree() } else { 0 };
                let end = values.get(index).zip(errors.get(index));
                end.is_none_or(|(value, error)| certain_sign(*value, *error) == Some(0))
            });
            let inside = |cusp: &LocalCusp| cusp.proved && cusp.t[0] <= t && t <= cusp.t[1];
            if vanishes && !cusps.iter().any(inside) {
                cusps.push(LocalCusp {
                    t: [t, t],
                    proved: true,
                });
            }
        }
    }
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
