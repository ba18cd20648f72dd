//! Comparing what is stated of a curve with what is true.

use std::time::Instant;

use batten::geometry::FloatPolygon;
use batten::geometry::features::{
    ExtremumKind, Feature, Features, SegmentFeatures, SegmentProver, Sign, SignPiece, Trend,
    TrendPiece, Verdict, certain_text,
};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::claims::{Claim, claims};
use crate::tally::Tally;
use crate::witness::{Change, Fraction, Place, Truth, exact};

/// The width to which roots are narrowed.
const ROOT_WIDTH: f64 = 1e-12;

/// The most digits that are printed of a value.
const DIGITS: usize = 17;

/// Compare all that is stated of a curve with the truth; returns what is wrong.
pub fn check(curve: &FloatPolygon, tally: &mut Tally) -> Vec<String> {
    let start = Instant::now();
    let mut prover = SegmentProver::new(curve.is_planar());
    let segments = (0..curve.segments()).map(|k| prover.segment(curve, k));
    let segments: Vec<_> = segments.collect();
    let features = Features::exact(curve, &segments);
    tally.proving += start.elapsed();
    let start = Instant::now();
    let truth = Truth::of(curve);
    let mut check = Check {
        curve,
        features: &features,
        truth: &truth,
        wrong: Vec::new(),
    };
    for quantity in truth.quantities() {
        check.claimed(*quantity, tally);
        check.not_missed(*quantity);
        check.doubts(*quantity);
        for (index, segment) in segments.iter().enumerate() {
            check.pieces(*quantity, index, pieces(segment, *quantity));
        }
    }
    check.nothing_of_other_quantities();
    check.cusps();
    check.trends();
    check.trends_leave_nothing_out();
    check.verdict();
    tally.add(&features, &truth);
    tally.witness += start.elapsed();
    check.wrong
}

struct Check<'a> {
    curve: &'a FloatPolygon,
    features: &'a Features,
    truth: &'a Truth,
    wrong: Vec<String>,
}

impl Check<'_> {
    fn expect(&mut self, holds: bool, message: impl FnOnce() -> String) {
        if !holds {
            self.wrong.push(message());
        }
    }

    fn claimed(&mut self, quantity: Feature, tally: &mut Tally) {
        let claims = claims(self.features, quantity);
        let truth = self.truth;
        for claim in &claims {
            let changes = truth.changes_inside(quantity, claim.u);
            let regular = changes.iter().filter(|change| !change.singular).count();
            self.expect(regular == claim.count && changes.len() == regular, || {
                format!(
                    "{quantity:?} in {:?}: {} claimed, {regular} true, {} at cusps",
                    claim.u,
                    claim.count,
                    changes.len() - regular
                )
            });
            self.expect(is_narrow(claim, &changes), || {
                format!("{quantity:?} in {:?}: too wide", claim.u)
            });
            if let Some(first) = changes.iter().find(|change| !change.singular)
                && regular == claim.count
            {
                self.extremum(quantity, claim, first, tally);
            }
        }
        self.disjoint(quantity, claims.iter().map(|claim| claim.u).collect());
    }

    /// The kind and the value of the first extremum of an interval.
    fn extremum(&mut self, quantity: Feature, claim: &Claim, change: &Change, tally: &mut Tally) {
        let Some((kind, value)) = claim.extremum else {
            return;
        };
        let maximum = kind == ExtremumKind::Maximum;
        self.expect(maximum == (change.from > 0), || {
            format!("{quantity:?} in {:?}: it is not a {kind:?}", claim.u)
        });
        let truth = self.truth.value(quantity, change);
        // The witness has κ|κ|, and τ itself.
        let squared = quantity == Feature::CurvatureExtremum;
        let compared = |bound: BigRational| {
            let power = if squared { &bound * bound.abs() } else { bound };
            Fraction::from(power)
        };
        let holds = |low: Option<BigRational>, high: Option<BigRational>| {
            low.is_none_or(|low| compared(low) <= truth[1])
                && high.is_none_or(|high| truth[0] <= compared(high))
        };
        let [low, high] = value;
        self.expect(low <= high, || {
            format!("{quantity:?} in {:?}: bounds {value:?}", claim.u)
        });
        let finite = |bound: f64| bound.is_finite().then(|| exact(bound));
        let infinite = low == f64::INFINITY || high == f64::NEG_INFINITY;
        self.expect(!infinite && holds(finite(low), finite(high)), || {
            format!(
                "{quantity:?} in {:?}: {value:?} does not hold the value{} {}",
                claim.u,
                if squared { ", whose square is" } else { "" },
                truth[0].written()
            )
        });
        let printed = certain_text(value, DIGITS);
        let digits = printed.map(|text| text.parse().expect("a number"));
        tally.value(value, digits);
        if let Some(printed) = digits {
            let [low, high] = rounding_to(printed);
            self.expect(holds(Some(low), Some(high)), || {
                format!("{quantity:?} in {:?}: {printed:e} is printed", claim.u)
            });
        }
    }

    fn disjoint(&mut self, quantity: Feature, intervals: Vec<[f64; 2]>) {
        for pair in intervals.windows(2) {
            self.expect(pair[0][1] < pair[1][0], || {
                format!("{quantity:?}: {pair:?} are not disjoint and in order")
            });
        }
        let turn = exact(self.truth.segments() as f64);
        for u in &intervals {
            let inside =
                0.0 <= u[0] && u[0] <= u[1] && (self.curve.is_periodic() || exact(u[1]) <= turn);
            self.expect(inside, || format!("{quantity:?}: {u:?} lies outside"));
        }
        if let (Some(first), Some(last)) = (intervals.first(), intervals.last())
            && self.curve.is_periodic()
            && intervals.len() > 1
        {
            self.expect(exact(last[1]) < exact(first[0]) + turn, || {
                format!("{quantity:?}: {first:?} and {last:?} meet at the joint")
            });
        }
    }

    fn not_missed(&mut self, quantity: Feature) {
        let truth = self.truth;
        let claims = claims(self.features, quantity);
        let doubts = self.features.undecided.iter();
        let doubts: Vec<_> = doubts.filter(|doubt| doubt.quantity == quantity).collect();
        for change in truth.changes_of(quantity) {
            let claimed = claims
                .iter()
                .any(|claim| truth.lies_inside(&change.places, claim.u));
            let doubtful = doubts
                .iter()
                .any(|doubt| truth.meets(&change.places, doubt.u));
            let cusp = self.features.cusps.iter();
            let at_cusp =
                change.singular && cusp.clone().any(|cusp| truth.meets(&change.places, cusp.u));
            self.expect(claimed || doubtful || at_cusp, || {
                format!("{quantity:?} missed at {:?}", about(change))
            });
        }
    }

    fn doubts(&mut self, quantity: Feature) {
        let truth = self.truth;
        let features = self.features;
        let doubts = features
            .undecided
            .iter()
            .filter(|doubt| doubt.quantity == quantity);
        for doubt in doubts {
            let mut changes = truth.changes_of(quantity).iter();
            let holds = changes.any(|change| truth.lies_inside(&change.places, doubt.u));
            self.expect(!doubt.certain || holds, || {
                format!("{quantity:?} in {:?}: said to be certain", doubt.u)
            });
        }
    }

    fn nothing_of_other_quantities(&mut self) {
        let all = [
            Feature::Inflection,
            Feature::CurvatureExtremum,
            Feature::TorsionZero,
            Feature::TorsionExtremum,
        ];
        for quantity in all {
            if !self.truth.quantities().contains(&quantity) {
                let none = claims(self.features, quantity).is_empty();
                self.expect(none, || format!("{quantity:?} makes no sense here"));
            }
        }
    }

    fn cusps(&mut self) {
        let (truth, features) = (self.truth, self.features);
        for cusp in &features.cusps {
            let mut places = truth.cusps.iter();
            let holds = places.any(|place| truth.lies_inside(&place.places, cusp.u));
            self.expect(!cusp.proved || holds, || format!("no cusp in {:?}", cusp.u));
        }
        for place in &truth.cusps {
            let found = features.cusps.iter();
            let found = found
                .clone()
                .any(|cusp| truth.lies_inside(&place.places, cusp.u));
            self.expect(found, || {
                format!(
                    "cusp missed at {:?}",
                    place.places.each_ref().map(Place::about)
                )
            });
        }
        let intervals: Vec<_> = features.cusps.iter().map(|cusp| cusp.u).collect();
        for pair in intervals.windows(2) {
            self.expect(pair[0][1] < pair[1][0], || {
                format!("cusps {pair:?} are not disjoint and in order")
            });
        }
    }

    fn trends(&mut self) {
        let (truth, features) = (self.truth, self.features);
        for piece in &features.trends {
            let changes = truth.changes_of(Feature::CurvatureExtremum).iter();
            let changed = changes
                .clone()
                .any(|change| truth.reaches_into(&change.places, piece.u));
            // Where it is constant throughout, the whole piece may be one extremum.
            self.expect(!changed || piece.trend == Trend::Constant, || {
                format!("{piece:?} holds an extremum")
            });
            let mut cusps = truth.cusps.iter();
            let broken = cusps.any(|place| truth.reaches_into(&place.places, piece.u));
            self.expect(!broken, || format!("{piece:?} holds a cusp"));
            for segment in 0..truth.segments() {
                self.trend_on(piece, segment);
            }
        }
    }

    /// The slope of the curvature in the middle of the part of a piece on a segment, and its jump
    /// at the segment's start.
    fn trend_on(&mut self, piece: &TrendPiece, segment: usize) {
        let sign = match piece.trend {
            Trend::Falling => -1,
            Trend::Constant => 0,
            Trend::Rising => 1,
        };
        let turn = self.truth.segments() as f64;
        let turns: &[f64] = if self.curve.is_periodic() {
            &[0.0, turn]
        } else {
            &[0.0]
        };
        for by in turns {
            let start = segment as f64 + by;
            let [low, high] = [piece.u[0].max(start), piece.u[1].min(start + 1.0)];
            if low < high {
                let slope = self.truth.function(Feature::CurvatureExtremum, segment);
                let parts = [exact(1.0) / BigInt::from(2), exact(1.0) / BigInt::from(3)];
                let found = parts.map(|part| {
                    let [low, high] = [low, high].map(|u| exact(u) - exact(start));
                    slope.sign(&(&low + (high - &low) * part))
                });
                // A root without a change of sign may lie in one of the places.
                let agrees = if sign == 0 {
                    slope.is_zero()
                } else {
                    found.contains(&sign) && !found.contains(&-sign)
                };
                self.expect(agrees, || {
                    format!("{piece:?}: slopes {found:?} in segment {segment}")
                });
            }
            if piece.u[0] < start && start < piece.u[1] {
                let jump = self.truth.jump(Feature::CurvatureExtremum, segment);
                let agrees = jump == Some(0) || jump == Some(sign);
                self.expect(agrees, || format!("{piece:?}: jump {jump:?} at {start}"));
            }
        }
    }

    /// Between pieces with a trend lie an extremum, an undecided piece, a cusp, or no more than
    /// rounding.
    fn trends_leave_nothing_out(&mut self) {
        let features = self.features;
        let end = self.truth.segments() as f64;
        let mut gaps: Vec<[f64; 2]> = Vec::new();
        let mut last = 0.0;
        for piece in &features.trends {
            gaps.push([last, piece.u[0]]);
            last = piece.u[1];
        }
        if !self.curve.is_periodic() {
            gaps.push([last, end]);
        }
        let extrema = features.curvature_extrema.iter().map(|extremum| extremum.u);
        let doubts = features.undecided.iter();
        let doubts = doubts.filter(|doubt| doubt.quantity == Feature::CurvatureExtremum);
        let cusps = features.cusps.iter().map(|cusp| cusp.u);
        let mut explained: Vec<_> = extrema
            .chain(doubts.map(|doubt| doubt.u))
            .chain(cusps)
            .collect();
        explained.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for [low, high] in gaps {
            let mut reached = low;
            let shifts: &[f64] = if self.curve.is_periodic() {
                &[-end, 0.0]
            } else {
                &[0.0]
            };
            for by in shifts {
                for u in &explained {
                    let rounding = 4.0 * f64::EPSILON * end;
                    if u[0] + by <= reached + rounding && u[1] + by > reached {
                        reached = u[1] + by;
                    }
                }
            }
            let rounding = 4.0 * f64::EPSILON * end;
            self.expect(high <= reached + rounding, || {
                format!("nothing is said of the curvature's slope from {reached} to {high}")
            });
        }
    }

    fn verdict(&mut self) {
        let changes = self.truth.changes_of(Feature::CurvatureExtremum);
        let extrema = changes.iter().filter(|change| !change.singular).count();
        let right = match self.features.monotone {
            Verdict::Proved => extrema == 0 && self.truth.cusps.is_empty(),
            Verdict::Disproved => extrema > 0,
            Verdict::Undecided => {
                let mut doubts = self.features.undecided.iter();
                let any = doubts.any(|doubt| doubt.quantity == Feature::CurvatureExtremum);
                self.features.curvature_extrema.is_empty()
                    && (any || !self.features.cusps.is_empty())
            }
        };
        let verdict = self.features.monotone;
        self.expect(right, || {
            format!("monotone {verdict:?} with {extrema} extrema")
        });
    }

    /// The pieces of one segment: a sign holds all along a piece, a root lies where it is said.
    fn pieces(&mut self, quantity: Feature, segment: usize, pieces: &[SignPiece]) {
        let function = self.truth.function(quantity, segment);
        let mut start = 0.0;
        for piece in pieces {
            let [low, high] = [start, piece.until].map(exact);
            let signs = [1, 2].map(|third| {
                function.sign(&(&low + (&high - &low) * BigInt::from(third) / BigInt::from(3)))
            });
            let right = match piece.sign {
                Sign::Positive => low == high || signs.contains(&1) && !signs.contains(&-1),
                Sign::Negative => low == high || signs.contains(&-1) && !signs.contains(&1),
                Sign::Zero => function.is_zero(),
                _ => true,
            };
            self.expect(right && start <= piece.until, || {
                format!(
                    "{quantity:?} in segment {segment}, {start} … {}: {:?}",
                    piece.until, piece.sign
                )
            });
            start = piece.until;
        }
        self.expect(start == 1.0, || {
            format!("{quantity:?} in segment {segment}: until {start}")
        });
    }
}

fn pieces(segment: &SegmentFeatures, quantity: Feature) -> &[SignPiece] {
    match quantity {
        Feature::Inflection => &segment.curvature,
        Feature::CurvatureExtremum => &segment.curvature_slope,
        Feature::TorsionZero => &segment.torsion,
        Feature::TorsionExtremum => &segment.torsion_slope,
    }
}

/// At most 1e-12 wide and one rounding of u, unless the function is 0 all along.
fn is_narrow(claim: &Claim, changes: &[&Change]) -> bool {
    let [low, high] = claim.u;
    let along = changes.iter().any(|change| {
        let [start, end] = change.places.each_ref().map(Place::about);
        end - start > ROOT_WIDTH
    });
    let rounding = 2.0 * (high.next_up() - high);
    along || high - low <= ROOT_WIDTH + rounding
}

/// The interval of the numbers that round to a printed one: half a unit of its last digit each way.
fn rounding_to(printed: f64) -> [BigRational; 2] {
    if printed == 0.0 {
        return [BigRational::zero(), BigRational::zero()];
    }
    let text = format!("{printed:e}");
    let (digits, exponent) = text.split_once('e').expect("an exponent");
    let behind = digits
        .split_once('.')
        .map_or(0, |(_, behind)| behind.len() as i32);
    let last = exponent.parse::<i32>().expect("a number") - behind;
    let digits: BigInt = digits.replace('.', "").parse().expect("digits");
    let unit = BigRational::from_integer(BigInt::from(10)).pow(last);
    let half = &unit / BigInt::from(2);
    let number = unit * digits;
    [&number - &half, number + half]
}

fn about(change: &Change) -> [f64; 2] {
    change.places.each_ref().map(Place::about)
}
