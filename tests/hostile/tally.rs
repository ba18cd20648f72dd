//! What was found on many curves.

use std::fmt::{Display, Formatter, Result};
use std::time::Duration;

use batten::geometry::features::{Feature, Features, Verdict};

use crate::claims::claims;
use crate::witness::Truth;

/// Counts of one family.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub curves: usize,
    pub segments: usize,
    /// True changes of sign where there is no cusp, and those of them that are proved.
    pub features: usize,
    pub proved: usize,
    /// Intervals that hold several.
    pub several: usize,
    pub cusps: usize,
    pub proved_cusps: usize,
    /// Places said to be possible cusps where there is none.
    pub false_cusps: usize,
    /// Undecided pieces that touch a true cusp or knot without curvature, and others.
    pub undecided_at_cusps: usize,
    pub undecided: usize,
    /// Curves with an undecided piece that touches no such place.
    pub undecided_curves: usize,
    pub open_verdicts: usize,
    /// Values, those without one certain digit, and those with less than nine.
    pub values: usize,
    pub no_digits: usize,
    pub few_digits: usize,
    pub wrong: usize,
    /// What proving and the witness took.
    pub proving: Duration,
    pub witness: Duration,
}

impl Tally {
    pub fn add(&mut self, features: &Features, truth: &Truth) {
        self.curves += 1;
        self.segments += truth.segments();
        for quantity in truth.quantities() {
            let changes = truth.changes_of(*quantity);
            self.features += changes.iter().filter(|change| !change.singular).count();
            let claims = claims(features, *quantity);
            self.proved += claims.iter().map(|claim| claim.count).sum::<usize>();
            self.several += claims.iter().filter(|claim| claim.count > 1).count();
        }
        self.cusps += truth.cusps.len();
        for cusp in &features.cusps {
            let mut true_ones = truth.cusps.iter();
            let holds = true_ones.any(|place| truth.meets(&place.places, cusp.u));
            self.proved_cusps += usize::from(cusp.proved);
            self.false_cusps += usize::from(!holds);
        }
        let mut elsewhere = 0;
        for doubt in &features.undecided {
            let flat = doubt.quantity == Feature::TorsionExtremum;
            let at_cusp = truth.is_singular_within(doubt.u, flat);
            self.undecided_at_cusps += usize::from(at_cusp);
            elsewhere += usize::from(!at_cusp);
        }
        self.undecided += elsewhere;
        self.undecided_curves += usize::from(elsewhere > 0);
        self.open_verdicts += usize::from(features.monotone == Verdict::Undecided);
    }

    /// Count a value by the digits that are certain.
    pub fn value(&mut self, [low, high]: [f64; 2], printed: Option<f64>) {
        self.values += 1;
        self.no_digits += usize::from(printed.is_none());
        let tight = high - low <= 1e-9 * low.abs().max(high.abs());
        self.few_digits += usize::from(printed.is_some() && !tight);
    }

    pub fn join(&mut self, other: &Self) {
        for (sum, count) in [
            (&mut self.curves, other.curves),
            (&mut self.segments, other.segments),
            (&mut self.features, other.features),
            (&mut self.proved, other.proved),
            (&mut self.several, other.several),
            (&mut self.cusps, other.cusps),
            (&mut self.proved_cusps, other.proved_cusps),
            (&mut self.false_cusps, other.false_cusps),
            (&mut self.undecided_at_cusps, other.undecided_at_cusps),
            (&mut self.undecided, other.undecided),
            (&mut self.undecided_curves, other.undecided_curves),
            (&mut self.open_verdicts, other.open_verdicts),
            (&mut self.values, other.values),
            (&mut self.no_digits, other.no_digits),
            (&mut self.few_digits, other.few_digits),
            (&mut self.wrong, other.wrong),
        ] {
            *sum += count;
        }
        self.proving += other.proving;
        self.witness += other.witness;
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut Formatter) -> Result {
        write!(
            f,
            "{} curves, {} segments: {} of {} features proved ({} intervals with several); \
             cusps: {} true, {} intervals proved, {} in doubt for nothing; undecided pieces: {} at \
             cusps, {} elsewhere (on {} curves); {} verdicts open; values: {}, {} without a certain \
             digit, {} with less than nine; wrong: {}; {:.1?}, witness {:.1?}",
            self.curves,
            self.segments,
            self.proved,
            self.features,
            self.several,
            self.cusps,
            self.proved_cusps,
            self.false_cusps,
            self.undecided_at_cusps,
            self.undecided,
            self.undecided_curves,
            self.open_verdicts,
            self.values,
            self.no_digits,
            self.few_digits,
            self.wrong,
            self.proving,
            self.witness,
        )
    }
}
