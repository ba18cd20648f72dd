//! Ends that are kept matched to other curves.

use super::curve::CurveId;
use crate::geometry::{Continuity, End, Jet, ParametricCurve};

/// An end of a curve that is kept matched to a place of another curve, or of a reference: its target is what the other
/// curve has there, and it is corrected as often as one of the two curves changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndMatch {
    /// The curve that follows.
    pub curve: CurveId,
    /// The matched end.
    pub end: End,
    /// The curve or the reference that it follows.
    pub source: CurveId,
    /// Where on it.
    pub place: MatchPlace,
    /// How much is matched.
    pub continuity: Continuity,
    /// Whether the curve passes the place against the direction of the other.
    pub reversed: bool,
}

/// A place of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MatchPlace {
    /// An end of an open curve, wherever it goes.
    End(End),
    /// A parameter u in \[0, L\].
    Parameter(f64),
}

impl MatchPlace {
    /// The point of a curve there with its derivatives, if the curve has this place.
    pub fn jet(self, curve: &dyn ParametricCurve) -> Option<Jet> {
        let pieces = curve.pieces();
        match self {
            Self::End(_) if curve.is_periodic() => None,
            Self::End(End::Start) => Some(curve.piece_jet(0, 0.0)),
            Self::End(End::Finish) => Some(curve.piece_jet(pieces - 1, 1.0)),
            Self::Parameter(u) => {
                let domain = 0.0..=pieces as f64;
                domain.contains(&u).then(|| curve.jet(u))
            }
        }
    }
}
