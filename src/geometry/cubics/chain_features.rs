//! Inflections and curvature extrema of chains of cubic Béziers, proved cubic by cubic.

use glam::DVec2;

use super::cubic::Cubic;
use crate::geometry::conversion::BezierPolygon;
use crate::geometry::features::{SegmentProver, Sign, SignPiece};

/// Curvatures that differ by less than this part of the largest one do not jump. Rounding is far below it,
/// and nobody sees a jump of this size.
const SAME: f64 = 1e-6;

/// Whether curvature and curvature slope are above 0, piece by piece along a cubic.
#[derive(Debug, Default)]
pub(super) struct CubicSigns {
    /// The signs of the curvature.
    pub(super) curvature: Vec<bool>,
    /// The signs of its slope.
    pub(super) slope: Vec<bool>,
    /// Whether a sign is unknown on some piece.
    pub(super) undecided: bool,
}

impl CubicSigns {
    /// Prove the signs along a cubic. There are none along a straight one.
    pub(super) fn of(cubic: &Cubic) -> Self {
        let vertices = cubic.iter().map(|it| it.extend(0.0)).collect();
        let polygon = BezierPolygon::new(3, vertices, None).and_then(|it| it.to_float());
        let Ok(polygon) = polygon else {
            return Self::default();
        };
        let features = SegmentProver::new(true).segment(&polygon, 0);
        let all = features.curvature.iter().chain(&features.curvature_slope);
        Self {
            undecided: { all }.any(|piece| matches!(piece.sign, Sign::Unknown)),
            curvature: signs(&features.curvature),
            slope: signs(&features.curvature_slope),
        }
    }
}

fn signs(pieces: &[SignPiece]) -> Vec<bool> {
    let known = pieces.iter().filter_map(|piece| match piece.sign {
        Sign::Positive => Some(true),
        Sign::Negative => Some(false),
        Sign::Zero | Sign::Root { .. } | Sign::Unknown => None,
    });
    known.collect()
}

/// How often signs change from one to the next.
pub(super) fn changes(signs: &[bool]) -> usize {
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Hold the numbers of features of a chain of cubics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainFeatures {
    /// The inflections, those at joints included.
    pub inflections: usize,
    /// How often the curvature turns from rising to falling or back, inside a cubic or at a joint.
    pub curvature_extrema: usize,
    /// Whether the curvature jumps at a joint.
    pub jumps: bool,
    /// Whether there may be more, on pieces whose signs could not be told.
    pub undecided: bool,
}

impl ChainFeatures {
    /// Count the features along a chain, those at the joint of a closed one included.
    pub fn of(chain: &[Cubic], is_closed: bool) -> Self {
        let (mut curvature, mut slope, mut undecided) = (Vec::new(), Vec::new(), false);
        for signs in chain.iter().map(CubicSigns::of) {
            curvature.extend(signs.curvature);
            slope.extend(signs.slope);
            undecided |= signs.undecided;
        }
        if is_closed {
            curvature.extend(curvature.first().copied());
            slope.extend(slope.first().copied());
        }
        Self {
            inflections: changes(&curvature),
            curvature_extrema: changes(&slope),
            jumps: jumps(chain, is_closed),
            undecided,
        }
    }
}

fn jumps(chain: &[Cubic], is_closed: bool) -> bool {
    let ends: Vec<[f64; 2]> = chain.iter().map(end_curvatures).collect();
    let largest = ends.iter().flatten();
    let largest = largest.fold(0.0, |largest: f64, it| largest.max(it.abs()));
    let around = ends.first().filter(|_| is_closed);
    let next = ends.iter().skip(1).chain(around);
    // A cubic without a leg at its end has no curvature there: it jumps too.
    ends.iter()
        .zip(next)
        .any(|([_, before], [after, _])| !((before - after).abs() <= SAME * largest))
}

/// The curvatures at start and end.
fn end_curvatures([a, b, c, d]: &Cubic) -> [f64; 2] {
    let curvature = |leg: DVec2, next: DVec2| 2.0 / 3.0 * leg.perp_dot(next) / leg.length().powi(3);
    [curvature(*b - *a, *c - *b), -curvature(*c - *d, *b - *c)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cubic(points: [(f64, f64); 4]) -> Cubic {
        points.map(DVec2::from)
    }

    #[test]
    fn features_of_a_chain_are_counted_across_joints() {
        let arch = cubic([(0.0, 0.0), (1.0, 1.0), (2.0, 1.0), (3.0, 0.0)]);
        let dip = cubic([(3.0, 0.0), (4.0, -1.0), (5.0, -1.0), (6.0, 0.0)]);
        let alone = ChainFeatures::of(&[arch], false);
        assert_eq!((alone.inflections, alone.curvature_extrema), (0, 1));
        assert!(!alone.jumps);
        // It turns right, then left. The extrema are inside the two.
        let both = ChainFeatures::of(&[arch, dip], false);
        assert_eq!((both.inflections, both.jumps), (1, true));
        assert_eq!(both.curvature_extrema, 2);
        let closed = ChainFeatures::of(&[arch, dip], true);
        assert_eq!(closed.inflections, 2);
        let [a, b, c, d] = arch;
        assert_eq!(
            end_curvatures(&arch),
            end_curvatures(&[d, c, b, a]).map(|it| -it)
        );
        let line = cubic([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]);
        let straight = ChainFeatures::of(&[line, line], false);
        assert_eq!((straight.inflections, straight.curvature_extrema), (0, 0));
    }
}
