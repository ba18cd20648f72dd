//! The changes of one function's sign along a whole curve, knots included.

use super::enclosure::UNKNOWN;
use super::sign_piece::{Sign, SignPiece, with_starts};

/// Hold a place on the curve exactly: a segment and a local parameter. A knot has two such
/// places, one a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) segment: usize,
    pub(super) t: f64,
}

impl Place {
    /// The curve's parameter, rounded down where it must be.
    pub(super) fn rounded_down(self) -> f64 {
        self.rounded(|sum, error| if error < 0.0 { sum.next_down() } else { sum })
    }

    /// The curve's parameter, rounded up where it must be.
    pub(super) fn rounded_up(self) -> f64 {
        self.rounded(|sum, error| if error > 0.0 { sum.next_up() } else { sum })
    }

    /// Whether this is the same point of the curve as another place, or the knot before it.
    fn meets(self, next: Self) -> bool {
        let knot = self.t == 1.0 && next.t == 0.0 && self.segment + 1 == next.segment;
        self == next || knot
    }

    fn rounded(self, correct: impl Fn(f64, f64) -> f64) -> f64 {
        let whole = self.segment as f64;
        let sum = whole + self.t;
        // Exact, as 0 ≤ t ≤ 1 and the number of the segment is 0 or at least 1.
        let error = if whole == 0.0 {
            0.0
        } else {
            self.t - (sum - whole)
        };
        correct(sum, error)
    }
}

/// Hold a proved change of sign: it lies between the places, at the only root of the function
/// between them, at a knot where the function jumps, or all along a piece where it is 0. Several
/// roots too close to tell apart are one, whatever the sign after them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    pub(super) places: [Place; 2],
    /// The sign before the change.
    pub(super) from: i8,
    /// The number of changes.
    pub(super) count: usize,
    /// Whether they are roots inside a segment.
    pub(super) is_root: bool,
    /// The bounds of the value that came with the first root.
    pub(super) value: [f64; 2],
}

/// Hold a piece on which the number of changes is not known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt {
    pub(super) places: [Place; 2],
    /// Whether the signs before and behind it differ.
    pub(super) changed: bool,
}

/// Hold a piece on which the sign is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) places: [Place; 2],
    /// The sign: −1, 0 or 1.
    pub(super) sign: i8,
}

/// Collect the changes of sign along a curve, segment after segment.
#[derive(Debug)]
pub(super) struct SignWalk {
    periodic: bool,
    sign: Option<i8>,
    gap: Gap,
    pub(super) changes: Vec<Change>,
    pub(super) doubts: Vec<Doubt>,
    pub(super) runs: Vec<Run>,
}

/// The stretch between the last piece with a sign and the next one.
#[derive(Clone, Copy, Debug)]
struct Gap {
    start: Place,
    unknown: bool,
    roots: usize,
    value: [f64; 2],
}

impl Gap {
    fn from(start: Place) -> Self {
        Self {
            start,
            unknown: false,
            roots: 0,
            value: UNKNOWN,
        }
    }
}

impl SignWalk {
    /// Walk along all segments of a curve.
    ///
    /// `pieces` gives those of a segment; `jump` the sign of the jump at the start of a segment of
    /// the quantity whose derivative the function is. A jump counts as a slope.
    pub(super) fn new<'a>(
        (segments, periodic): (usize, bool),
        pieces: impl Fn(usize) -> &'a [SignPiece],
        jump: impl Fn(usize) -> i8,
    ) -> Self {
        let start = Place { segment: 0, t: 0.0 };
        let mut walk = Self {
            periodic,
            sign: None,
            gap: Gap::from(start),
            changes: Vec::new(),
            doubts: Vec::new(),
            runs: Vec::new(),
        };
        for segment in 0..segments {
            if segment > 0 {
                walk.knot(segment, &jump);
            }
            for (from, piece) in with_starts(pieces(segment)) {
                walk.piece(segment, from, piece);
            }
        }
        if periodic && walk.sign.is_some() {
            walk.go_round(segments, pieces, jump);
        } else if walk.gap.unknown {
            walk.doubt(
                Place {
                    segment: segments - 1,
                    t: 1.0,
                },
                false,
            );
        }
        walk
    }

    /// Go on from the end of a periodic curve to the first piece with a sign.
    fn go_round<'a>(
        &mut self,
        segments: usize,
        pieces: impl Fn(usize) -> &'a [SignPiece],
        jump: impl Fn(usize) -> i8,
    ) {
        let runs = std::mem::take(&mut self.runs);
        'round: for segment in 0..segments {
            self.knot(segments + segment, &|_| jump(segment));
            for (from, piece) in with_starts(pieces(segment)) {
                self.piece(segments + segment, from, piece);
                if piece.sign.direction().is_some() {
                    break 'round;
                }
            }
        }
        // All pieces were seen before.
        self.runs = runs;
    }

    fn doubt(&mut self, until: Place, changed: bool) {
        let places = [self.gap.start, until];
        self.doubts.push(Doubt { places, changed });
    }

    fn knot(&mut self, segment: usize, jump: &impl Fn(usize) -> i8) {
        let sign = jump(segment);
        // A periodic walk ends at the first piece with a sign, so it begins there too.
        if sign != 0 && !(self.periodic && self.sign.is_none()) {
            let before = Place {
                segment: segment - 1,
                t: 1.0,
            };
            self.sign_piece(sign, [before, Place { segment, t: 0.0 }]);
        }
    }

    fn piece(&mut self, segment: usize, from: f64, piece: SignPiece) {
        let places = [from, piece.until].map(|t| Place { segment, t });
        match piece.sign {
            Sign::Positive => self.sign_piece(1, places),
            Sign::Negative => self.sign_piece(-1, places),
            Sign::Zero => {
                let last = self.runs.last();
                let continues = last.is_some_and(|last| last.places[1].meets(places[0]));
                self.run(0, places, continues);
            }
            Sign::Root { count, value } => {
                if self.gap.roots == 0 {
                    self.gap.value = value;
                }
                self.gap.roots += count;
            }
            Sign::Unknown => self.gap.unknown = true,
        }
    }

    fn sign_piece(&mut self, sign: i8, places: [Place; 2]) {
        let changed = self.sign.is_some_and(|before| before != sign);
        let certain = match self.sign {
            Some(_) => !self.gap.unknown,
            // The part of a periodic curve before its first sign is seen again at the end.
            None => self.periodic || !self.gap.unknown,
        };
        let count = self.gap.roots.max(usize::from(changed));
        if !certain {
            self.doubt(places[0], changed);
        } else if count > 0 {
            self.changes.push(Change {
                places: [self.gap.start, places[0]],
                from: if changed { -sign } else { sign },
                count,
                is_root: self.gap.roots > 0,
                value: self.gap.value,
            });
        }
        self.run(sign, places, certain && count == 0);
        self.sign = Some(sign);
        self.gap = Gap::from(places[1]);
    }

    fn run(&mut self, sign: i8, places: [Place; 2], continues: bool) {
        match self.runs.last_mut() {
            Some(last) if last.sign == sign && continues => last.places[1] = places[1],
            // Even a run of no length, between two roots: the next piece may lengthen it.
            _ => self.runs.push(Run { places, sign }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Read a segment written as + − 0, r for a root and ? for unknown.
    fn segment(signs: &str) -> Vec<SignPiece> {
        let count = signs.len() as f64;
        let sign = |letter| match letter {
            '+' => Sign::Positive,
            '-' => Sign::Negative,
            '0' => Sign::Zero,
            'r' => Sign::roots(1),
            'd' => Sign::roots(2),
            _ => Sign::Unknown,
        };
        let until = (1..).map(|index| f64::from(index) / count);
        let pieces = signs.chars().map(sign).zip(until);
        pieces
            .map(|(sign, until)| SignPiece { sign, until })
            .collect()
    }

    /// The numbers of changes and of doubts, with all jumps the same.
    fn counts(periodic: bool, segments: &[&str], jump: i8) -> (usize, usize) {
        let segments: Vec<_> = segments.iter().map(|signs| segment(signs)).collect();
        let size = (segments.len(), periodic);
        let walk = SignWalk::new(size, |k| &segments[k], |_| jump);
        (walk.changes.len(), walk.doubts.len())
    }

    #[test]
    fn knots_are_counted_once() {
        for (segments, expected) in [
            (["+r-", "-r+"], (2, 0)),
            (["+", "-"], (1, 0)),
            (["-r+", "-"], (2, 0)),
            // Exact zeros between different signs are one change.
            (["+0", "0-"], (1, 0)),
            (["+0", "0+"], (0, 0)),
            (["+?-", "-"], (0, 1)),
            // At the ends nothing changes, as far as is known.
            (["?+", "+?"], (0, 2)),
            (["0+", "+0"], (0, 0)),
            (["?", "?"], (0, 1)),
        ] {
            assert_eq!(counts(false, &segments, 0), expected, "{segments:?}");
        }
    }

    #[test]
    fn jumps_are_slopes() {
        for (jump, segments, expected) in [
            (1, ["+", "+"], (0, 0)),
            (-1, ["+", "+"], (2, 0)),
            (-1, ["+", "-"], (1, 0)),
            (1, ["0", "+"], (0, 0)),
            (-1, ["0", "+"], (1, 0)),
        ] {
            assert_eq!(counts(false, &segments, jump), expected, "{segments:?}");
        }
    }

    #[test]
    fn a_periodic_curve_has_no_ends() {
        for (segments, expected) in [
            (["+", "r-"], (2, 0)),
            (["0+", "+0"], (0, 0)),
            (["?+", "+"], (0, 1)),
            (["?", "?"], (0, 1)),
            (["?", "+r-"], (1, 1)),
        ] {
            assert_eq!(counts(true, &segments, 0), expected, "{segments:?}");
        }
        assert_eq!(counts(true, &["+", "+"], -1), (4, 0));
    }
}
