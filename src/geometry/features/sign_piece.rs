//! Proved signs of a function on pieces of a segment.

use super::enclosure::UNKNOWN;

/// Sign of a function on a piece of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sign {
    /// It is above 0, but for single points where it may touch 0 (roots of even multiplicity).
    Positive,
    /// It is below 0, but for such points.
    Negative,
    /// It is 0 throughout, exactly.
    Zero,
    /// It changes its sign: it has one root, of odd multiplicity.
    Root {
        /// The number of such roots: 1 unless doubles cannot separate them.
        count: usize,
        /// Bounds of the curvature or torsion at the first one, if the function is its
        /// derivative.
        value: [f64; 2],
    },
    /// Nothing is known: the piece is too small, or the function lies within rounding of 0.
    Unknown,
}

impl Sign {
    /// Roots where nothing is known yet of the curvature or torsion.
    pub(super) fn roots(count: usize) -> Self {
        Self::Root {
            count,
            value: UNKNOWN,
        }
    }

    /// 1 or −1 where the sign is known and not 0.
    pub(super) fn direction(self) -> Option<i8> {
        match self {
            Self::Positive => Some(1),
            Self::Negative => Some(-1),
            _ => None,
        }
    }

    pub(super) fn from_direction(direction: i8) -> Self {
        if direction > 0 {
            Self::Positive
        } else {
            Self::Negative
        }
    }
}

/// Hold one piece of a segment: it begins where the piece before it ends, the first one at
/// t = 0, and the last ends at t = 1. A piece may be a single point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignPiece {
    /// The sign of the function inside the piece.
    pub sign: Sign,
    /// The local parameter, in \[0, 1\], where the piece ends.
    pub until: f64,
}

/// List pieces with the local parameters where they begin.
pub(super) fn with_starts(pieces: &[SignPiece]) -> impl Iterator<Item = (f64, SignPiece)> + '_ {
    let starts = std::iter::once(0.0).chain(pieces.iter().map(|piece| piece.until));
    starts.zip(pieces.iter().copied())
}

/// Append a piece, or lengthen the last one if it says the same.
pub(super) fn append(pieces: &mut Vec<SignPiece>, sign: Sign, until: f64) {
    match pieces.last_mut() {
        Some(last) if last.sign == sign && !matches!(sign, Sign::Root { .. }) => {
            last.until = until;
        }
        _ => pieces.push(SignPiece { sign, until }),
    }
}
