//! The true features of a whole curve.

use std::cmp::Ordering;
use std::rc::Rc;

use batten::geometry::FloatPolygon;
use batten::geometry::features::Feature;
use num_bigint::BigInt;
use num_rational::BigRational;

use super::fraction::Fraction;
use super::isolation::Root;
use super::polynomial::Polynomial;
use super::segment::ExactSegment;
use super::{exact, power_of_two};

/// A place on a curve, exactly.
#[derive(Clone, Debug)]
pub enum Place {
    /// The knot with this number, which is its parameter.
    Knot(usize),
    /// The root of a polynomial inside a segment.
    Root {
        segment: usize,
        polynomial: Rc<Polynomial>,
        root: Root,
    },
}

impl Place {
    /// Compare the place's parameter with a number.
    pub fn compare(&self, u: &BigRational) -> Ordering {
        match self {
            Self::Knot(knot) => whole(*knot).cmp(u),
            Self::Root {
                segment,
                polynomial,
                root,
            } => root.compare(polynomial, &(u - whole(*segment))),
        }
    }

    /// The parameter, rounded.
    pub fn about(&self) -> f64 {
        match self {
            Self::Knot(knot) => *knot as f64,
            Self::Root {
                segment,
                polynomial,
                root,
            } => {
                let [low, _] = root.narrowed(polynomial, 60);
                let share = low * power_of_two(60);
                let whole = share.to_integer().to_string();
                *segment as f64 + whole.parse::<f64>().expect("a number") / 2f64.powi(60)
            }
        }
    }
}

/// A part of a curve from one place to another; nearly always a point.
#[derive(Clone, Debug)]
pub struct Singular {
    pub places: [Place; 2],
}

/// A change of a function's sign: at a point, or along a part where the function is 0.
#[derive(Clone, Debug)]
pub struct Change {
    pub places: [Place; 2],
    /// The sign before the change.
    pub from: i32,
    /// Whether it lies at a cusp, or else at a place without curvature where the torsion may
    /// jump: what happens there is left open.
    pub singular: bool,
}

/// All that is true of a curve.
#[derive(Debug)]
pub struct Truth {
    planar: bool,
    degree: usize,
    periodic: bool,
    segments: Vec<ExactSegment>,
    /// The functions by quantity, one polynomial a segment.
    functions: Vec<(Feature, Vec<Polynomial>)>,
    /// The changes of sign by quantity, in the order of u.
    pub changes: Vec<(Feature, Vec<Change>)>,
    /// Where the tangent vanishes.
    pub cusps: Vec<Singular>,
    /// The knots of a space curve without curvature.
    flat_knots: Vec<Singular>,
}

impl Truth {
    pub fn of(curve: &FloatPolygon) -> Self {
        let planar = curve.is_planar();
        let segments = ExactSegment::all(curve);
        let function = |quantity| {
            let of = |segment: &ExactSegment| match quantity {
                Feature::Inflection => segment.curvature(),
                Feature::CurvatureExtremum if planar => segment.curvature_slope(),
                Feature::CurvatureExtremum => segment.space_curvature_slope(),
                Feature::TorsionZero => segment.torsion(),
                Feature::TorsionExtremum => segment.torsion_slope(),
            };
            (quantity, segments.iter().map(of).collect())
        };
        let functions = quantities(planar).iter().copied().map(function).collect();
        let mut truth = Self {
            planar,
            degree: curve.degree(),
            periodic: curve.is_periodic(),
            cusps: cusps(&segments),
            segments,
            functions,
            changes: Vec::new(),
            flat_knots: Vec::new(),
        };
        truth.flat_knots = truth.flat_knots();
        let walked = truth.functions.iter();
        let walked =
            walked.map(|(quantity, functions)| (*quantity, truth.walk(*quantity, functions)));
        truth.changes = walked.collect();
        truth
    }

    /// The quantities that a curve has features of.
    pub fn quantities(&self) -> &'static [Feature] {
        quantities(self.planar)
    }

    pub fn changes_of(&self, quantity: Feature) -> &[Change] {
        let found = self.changes.iter().find(|(of, _)| *of == quantity);
        found.map_or(&[], |(_, changes)| changes)
    }

    /// The changes in an interval in the order in which the interval has them, which may reach over
    /// the joint of a periodic curve.
    pub fn changes_inside(&self, quantity: Feature, u: [f64; 2]) -> Vec<&Change> {
        let changes = self.changes_of(quantity);
        let inside = changes
            .iter()
            .map(|change| self.lies_inside(&change.places, u));
        let inside: Vec<bool> = inside.collect();
        let count = changes.len();
        let first = (0..count).find(|index| inside[*index] && !inside[(index + count - 1) % count]);
        let first = first.unwrap_or(0);
        let turned = (first..first + count).map(|index| index % count);
        let held = turned.filter(|index| inside[*index]);
        held.map(|index| &changes[index]).collect()
    }

    /// The function of a quantity on a segment.
    pub fn function(&self, quantity: Feature, segment: usize) -> &Polynomial {
        let found = self.functions.iter().find(|(of, _)| *of == quantity);
        &found.expect("a quantity of this curve").1[segment]
    }

    pub fn segments(&self) -> usize {
        self.segments.len()
    }

    /// Whether a part of the curve lies inside an interval, whichever turn of a periodic curve it
    /// is counted in.
    pub fn lies_inside(&self, places: &[Place; 2], u: [f64; 2]) -> bool {
        self.turns(u).iter().any(|[low, high]| {
            places[0].compare(low) != Ordering::Less && places[1].compare(high) != Ordering::Greater
        })
    }

    /// Whether a part of the curve and an interval have a point in common.
    pub fn meets(&self, places: &[Place; 2], u: [f64; 2]) -> bool {
        self.turns(u).iter().any(|[low, high]| {
            places[1].compare(low) != Ordering::Less && places[0].compare(high) != Ordering::Greater
        })
    }

    /// Whether a part of the curve reaches inside an interval, beyond the interval's ends.
    pub fn reaches_into(&self, places: &[Place; 2], u: [f64; 2]) -> bool {
        self.turns(u).iter().any(|[low, high]| {
            places[1].compare(low) == Ordering::Greater && places[0].compare(high) == Ordering::Less
        })
    }

    /// Whether an interval touches a cusp or, if these count, a knot without curvature.
    pub fn is_singular_within(&self, u: [f64; 2], flat_knots: bool) -> bool {
        let flat: &[Singular] = if flat_knots { &self.flat_knots } else { &[] };
        let mut singular = self.cusps.iter().chain(flat);
        singular.any(|place| self.meets(&place.places, u))
    }

    fn turns(&self, u: [f64; 2]) -> Vec<[BigRational; 2]> {
        let turn = whole(self.segments.len());
        let by = |turns: i64| u.map(|u| exact(u) + &turn * BigInt::from(turns));
        if self.periodic {
            [-1, 0, 1].map(by).to_vec()
        } else {
            vec![by(0)]
        }
    }

    /// The sign of the jump at the start of a segment of the quantity whose slope is walked along;
    /// `None` at a singular place.
    pub fn jump(&self, quantity: Feature, segment: usize) -> Option<i32> {
        let count = self.segments.len();
        let [before, behind] = [
            &self.segments[(segment + count - 1) % count],
            &self.segments[segment],
        ];
        let jump = match (quantity, self.degree) {
            (Feature::CurvatureExtremum, 2) => {
                let behind = behind.end_curvature(false, self.planar)?;
                behind.cmp(&before.end_curvature(true, self.planar)?)
            }
            (Feature::TorsionExtremum, 3) => {
                behind.end_torsion(false)?.cmp(&before.end_torsion(true)?)
            }
            _ => Ordering::Equal,
        };
        Some(jump as i32)
    }

    /// Enclose κ|κ| or τ at an extremum: at a jump the greater side of a maximum, the lesser one of
    /// a minimum. The root is narrowed to 2⁻⁹⁶ of its isolating interval; the values at both ends
    /// are widened by what the value changes over as much before it, which at an extremum is more
    /// than what it changes inside.
    pub fn value(&self, quantity: Feature, change: &Change) -> [Fraction; 2] {
        let mut values: Vec<[Fraction; 2]> = Vec::new();
        for place in &change.places {
            match place {
                Place::Root {
                    segment,
                    polynomial,
                    root,
                } => {
                    // A root may lie much closer to a piece's end than the piece is long.
                    let hull = (0..5).map(|times| {
                        let bits = root.level() + (NARROW << times);
                        let ends = root.narrowed(polynomial, bits);
                        self.hull(quantity, *segment, ends)
                    });
                    let mut hull = hull.skip_while(|hull| !Fraction::agree(hull));
                    let widest = || {
                        let ends = root.narrowed(polynomial, root.level() + (NARROW << 4));
                        self.hull(quantity, *segment, ends)
                    };
                    values.push(hull.next().unwrap_or_else(widest));
                }
                Place::Knot(knot) => {
                    let count = self.segments.len();
                    let sides = [(*knot + count - 1, 1), (*knot, 0)];
                    for (segment, t) in sides {
                        let t = whole(t);
                        values.push(self.hull(quantity, segment % count, [t.clone(), t]));
                    }
                }
            }
        }
        let values = values.into_iter();
        let best = if change.from > 0 {
            values.max_by(|a, b| a[1].cmp(&b[1]))
        } else {
            values.min_by(|a, b| a[0].cmp(&b[0]))
        };
        best.expect("two places")
    }

    fn hull(&self, quantity: Feature, segment: usize, ends: [BigRational; 2]) -> [Fraction; 2] {
        let segment = &self.segments[segment];
        let at = |t: &BigRational| match quantity {
            Feature::TorsionExtremum => segment.torsion_at(t),
            _ => segment.curvature_at(t, self.planar),
        };
        let before = &ends[0] - (&ends[1] - &ends[0]);
        let [before, a, b] = [&before, &ends[0], &ends[1]].map(|t| {
            // Where there is none, nearly there, towards the middle.
            let half = power_of_two(-1);
            let aside = power_of_two(-2 * NARROW as i64);
            let aside = if *t < half { t + aside } else { t - aside };
            at(t).unwrap_or_else(|| at(&aside).unwrap_or_else(Fraction::zero))
        });
        Fraction::widened([a, b], &before)
    }

    fn walk(&self, quantity: Feature, functions: &[Polynomial]) -> Vec<Change> {
        let mut runs: Vec<(Place, Place, i32)> = Vec::new();
        for (segment, function) in functions.iter().enumerate() {
            if segment > 0 || self.periodic {
                let jump = self.jump(quantity, segment).unwrap_or(0);
                if jump != 0 {
                    runs.push((Place::Knot(segment), Place::Knot(segment), jump));
                }
            }
            if function.is_zero() {
                continue;
            }
            let polynomial = Rc::new(function.odd_part());
            let mut sign = function.end_sign(false);
            let mut start = Place::Knot(segment);
            for root in polynomial.simple_roots() {
                let place = Place::Root {
                    segment,
                    polynomial: polynomial.clone(),
                    root,
                };
                runs.push((start, place.clone(), sign));
                (start, sign) = (place, -sign);
            }
            assert_eq!(
                sign,
                function.end_sign(true),
                "the signs at the ends agree with the roots"
            );
            runs.push((start, Place::Knot(segment + 1), sign));
        }
        let mut changes = Vec::new();
        let mut add = |from: &(Place, Place, i32), start: Place| {
            let places = [from.1.clone(), start];
            changes.push(Change {
                singular: self.is_singular(quantity, &places),
                places,
                from: from.2,
            });
        };
        for pair in runs.windows(2).filter(|pair| pair[0].2 != pair[1].2) {
            add(&pair[0], pair[1].0.clone());
        }
        if let (Some(first), Some(last), true) = (runs.first(), runs.last(), self.periodic)
            && first.2 != last.2
            && let Place::Knot(knot) = first.0
        {
            add(last, Place::Knot(knot + self.segments.len()));
        }
        changes
    }

    fn is_singular(&self, quantity: Feature, places: &[Place; 2]) -> bool {
        let flat: &[Singular] = if quantity == Feature::TorsionExtremum {
            &self.flat_knots
        } else {
            &[]
        };
        let mut singular = self.cusps.iter().chain(flat);
        singular.any(|other| self.parts_meet(places, &other.places))
    }

    /// Whether two parts of the curve have a point in common.
    fn parts_meet(&self, a: &[Place; 2], b: &[Place; 2]) -> bool {
        let turn = if self.periodic {
            self.segments.len()
        } else {
            0
        };
        let before = |p: &Place, q: &Place, by: [usize; 2]| precedes(p, by[0], q, by[1]);
        [[0, 0], [turn, 0], [0, turn]].iter().any(|[by_a, by_b]| {
            before(&a[0], &b[1], [*by_a, *by_b]) && before(&b[0], &a[1], [*by_b, *by_a])
        })
    }

    fn flat_knots(&self) -> Vec<Singular> {
        if self.planar || self.degree < 3 {
            return Vec::new();
        }
        let count = self.segments.len();
        let flat = |knot: &usize| {
            let before = &self.segments[(knot + count - 1) % count];
            before.end_vanishes(true, ExactSegment::normal)
                || self.segments[*knot].end_vanishes(false, ExactSegment::normal)
        };
        let knots = (usize::from(!self.periodic)..count).filter(flat);
        knots.map(at_knot).collect()
    }
}

/// How many bits narrower than isolated a root is wanted for the values there.
const NARROW: u64 = 96;

fn quantities(planar: bool) -> &'static [Feature] {
    if planar {
        &[Feature::Inflection, Feature::CurvatureExtremum]
    } else {
        &[
            Feature::CurvatureExtremum,
            Feature::TorsionZero,
            Feature::TorsionExtremum,
        ]
    }
}

fn whole(number: usize) -> BigRational {
    BigRational::from_integer(BigInt::from(number))
}

fn at_knot(knot: usize) -> Singular {
    Singular {
        places: [Place::Knot(knot), Place::Knot(knot)],
    }
}

/// Whether one place comes before another one or is the same, each moved by some segments.
fn precedes(p: &Place, by_p: usize, q: &Place, by_q: usize) -> bool {
    let moved = |place: &Place, by: usize| match place {
        Place::Knot(knot) => Place::Knot(knot + by),
        Place::Root {
            segment,
            polynomial,
            root,
        } => Place::Root {
            segment: segment + by,
            polynomial: polynomial.clone(),
            root: root.clone(),
        },
    };
    match (moved(p, by_p), moved(q, by_q)) {
        (Place::Knot(knot), other) => other.compare(&whole(knot)) != Ordering::Less,
        (other, Place::Knot(knot)) => other.compare(&whole(knot)) != Ordering::Greater,
        (
            Place::Root {
                segment,
                polynomial,
                root,
            },
            Place::Root {
                segment: other_segment,
                polynomial: other_polynomial,
                root: other_root,
            },
        ) => {
            if segment != other_segment {
                return segment < other_segment;
            }
            let common = polynomial.common_factor(&other_polynomial);
            let order = root.order(&polynomial, &other_root, &other_polynomial, &common);
            order != Ordering::Greater
        }
    }
}

fn cusps(segments: &[ExactSegment]) -> Vec<Singular> {
    let mut cusps = Vec::new();
    for (segment, exact) in segments.iter().enumerate() {
        let [x, y, z] = exact.tangent();
        let common = x.common_factor(y).common_factor(z);
        if common.is_zero() {
            cusps.push(Singular {
                places: [Place::Knot(segment), Place::Knot(segment + 1)],
            });
            continue;
        }
        let ends = [false, true].map(|at_end| exact.end_vanishes(at_end, ExactSegment::tangent));
        if ends[0] {
            cusps.push(at_knot(segment));
        }
        let polynomial = Rc::new(common.radical());
        for root in polynomial.simple_roots() {
            let place = Place::Root {
                segment,
                polynomial: polynomial.clone(),
                root,
            };
            cusps.push(Singular {
                places: [place.clone(), place],
            });
        }
        if ends[1] {
            cusps.push(at_knot(segment + 1));
        }
    }
    cusps
}
