//! Proved features of random curves against exact arithmetic.

use std::ops::RangeInclusive;

use crate::common::Random;
use crate::witness::{ExactSegment, Polynomial};
use batten::geometry::FloatPolygon;
use batten::geometry::features::{
    Feature, Features, SegmentFeatures, SegmentProver, Sign, SignPiece, Undecided, Verdict,
};
use glam::DVec3;

/// The width to which roots are narrowed.
const ROOT_WIDTH: f64 = 1e-12;

/// Kinds of random curves.
#[derive(Clone, Copy)]
struct Kind {
    in_space: bool,
    rational: bool,
    /// Whether coordinates and weights are whole numbers, which makes special positions likely,
    /// or use all digits.
    whole: bool,
}

const PLANAR: Kind = Kind {
    in_space: false,
    rational: false,
    whole: true,
};

fn random_curve(random: &mut Random, degree: usize, kind: Kind) -> FloatPolygon {
    let count = degree + 1 + (random.bits() % 3) as usize;
    let mut number = |reach: f64| {
        let value = random.between(-reach, reach);
        if kind.whole { value.round() } else { value }
    };
    let vertices = (0..count).map(|_| {
        let z = if kind.in_space { number(100.0) } else { 0.0 };
        DVec3::new(number(100.0), number(100.0), z)
    });
    let vertices = vertices.collect();
    let weights = kind
        .rational
        .then(|| (0..count).map(|_| 6.0 + number(5.0)).collect());
    let periodic = random.bits().is_multiple_of(4);
    FloatPolygon::new(degree, vertices, weights, periodic).expect("a valid polygon")
}

/// A function on all segments: how it is found, and exactly.
struct Function {
    quantity: Feature,
    found: fn(&SegmentFeatures) -> &[SignPiece],
    exact: fn(&ExactSegment) -> Polynomial,
}

fn functions(in_space: bool) -> Vec<Function> {
    let slope: fn(&ExactSegment) -> Polynomial = if in_space {
        ExactSegment::space_curvature_slope
    } else {
        ExactSegment::curvature_slope
    };
    let mut functions = vec![Function {
        quantity: Feature::CurvatureExtremum,
        found: |segment| &segment.curvature_slope,
        exact: slope,
    }];
    if in_space {
        functions.push(Function {
            quantity: Feature::TorsionZero,
            found: |segment| &segment.torsion,
            exact: ExactSegment::torsion,
        });
        functions.push(Function {
            quantity: Feature::TorsionExtremum,
            found: |segment| &segment.torsion_slope,
            exact: ExactSegment::torsion_slope,
        });
    } else {
        functions.push(Function {
            quantity: Feature::Inflection,
            found: |segment| &segment.curvature,
            exact: ExactSegment::curvature,
        });
    }
    functions
}

/// What was found on many curves.
#[derive(Debug, Default)]
struct Tally {
    curves: usize,
    segments: usize,
    roots: usize,
    at_knots: usize,
    wide: usize,
    undecided_segments: usize,
}

/// Compare the pieces of one segment with an exact polynomial; returns whether all is decided.
fn check_segment(pieces: &[SignPiece], exact: &Polynomial, tally: &mut Tally) -> bool {
    let (mut start, mut roots, mut decided) = (0.0, 0, true);
    let exact = &exact.odd_part();
    for piece in pieces {
        match piece.sign {
            Sign::Positive | Sign::Negative => {
                let expected = if piece.sign == Sign::Positive { 1 } else { -1 };
                for part in [0.01, 0.5, 0.99] {
                    let t = start + part * (piece.until - start);
                    if start < t && t < piece.until {
                        assert_eq!(exact.sign_at(t), expected, "at {t}");
                    }
                }
            }
            Sign::Root { count, .. } => {
                roots += count;
                tally.wide += usize::from(piece.until - start > ROOT_WIDTH);
                let signs = [start, piece.until].map(|t| exact.sign_at(t));
                let expected = if count % 2 == 1 { -1 } else { 1 };
                assert_eq!(signs[0] * signs[1], expected, "{start}, {}", piece.until);
            }
            Sign::Zero => assert!(exact.is_zero()),
            Sign::Unknown => decided = false,
        }
        start = piece.until;
    }
    assert_eq!(start, 1.0, "the pieces cover the segment");
    tally.roots += roots;
    if decided {
        assert_eq!(roots, exact.roots_inside(), "{pieces:?}");
    }
    decided
}

/// Count the changes of an exact function's sign along a curve; `None` if a jump cannot be told.
fn exact_changes(
    curve: &FloatPolygon,
    exact: &[ExactSegment],
    function: &Function,
) -> Option<usize> {
    let planar = curve.is_planar();
    // The order of two numbers, or `None` if one of them does not exist.
    let jump = |k: usize| {
        let before = &exact[(k + exact.len() - 1) % exact.len()];
        match (function.quantity, curve.degree()) {
            (Feature::CurvatureExtremum, 2) => {
                let behind = exact[k].end_curvature(false, planar)?;
                Some(behind.cmp(&before.end_curvature(true, planar)?) as i32)
            }
            (Feature::TorsionExtremum, 3) => {
                Some(exact[k].end_torsion(false)?.cmp(&before.end_torsion(true)?) as i32)
            }
            _ => Some(0),
        }
    };
    let (mut roots, mut signs) = (0, Vec::new());
    for (k, segment) in exact.iter().enumerate() {
        if k > 0 || curve.is_periodic() {
            signs.push(jump(k)?);
        }
        let polynomial = (function.exact)(segment);
        if !polynomial.is_zero() {
            let inside = polynomial.roots_inside();
            let ends = [false, true].map(|at_end| polynomial.end_sign(at_end));
            assert_eq!(inside % 2 == 1, ends[0] != ends[1]);
            roots += inside;
            // The change inside the segment is counted already.
            signs.push(ends[0]);
            signs.push(2 * ends[1]);
        }
    }
    signs.retain(|sign| *sign != 0);
    if curve.is_periodic() {
        signs.extend(signs.first().copied());
    }
    let at_knots = signs.windows(2).filter(|pair| {
        let within = pair[0].abs() == 1 && pair[1].abs() == 2;
        !within && pair[0].signum() != pair[1].signum()
    });
    // A jump is followed by a segment's start, so that only starts are followed by ends.
    Some(roots + at_knots.count())
}

fn check_curve(curve: &FloatPolygon, prover: &mut SegmentProver, tally: &mut Tally) {
    let segments = 0..curve.segments();
    let found: Vec<_> = segments.map(|k| prover.segment(curve, k)).collect();
    let exact = ExactSegment::all(curve);
    let functions = functions(!curve.is_planar());
    tally.curves += 1;
    tally.segments += found.len();
    for (found, exact) in found.iter().zip(&exact) {
        let mut decided = true;
        for function in &functions {
            decided &= check_segment((function.found)(found), &(function.exact)(exact), tally);
        }
        tally.undecided_segments += usize::from(!decided);
    }
    let features = Features::exact(curve, &found);
    if !features.cusps.is_empty() {
        return;
    }
    for function in &functions {
        let count = features.count(function.quantity);
        let knots = match function.quantity {
            Feature::Inflection => at_knots(features.inflections.iter().map(|r| (r.u, r.count))),
            Feature::CurvatureExtremum => {
                at_knots(features.curvature_extrema.iter().map(|e| (e.u, e.count)))
            }
            Feature::TorsionZero => at_knots(features.torsion_zeros.iter().map(|r| (r.u, r.count))),
            Feature::TorsionExtremum => {
                at_knots(features.torsion_extrema.iter().map(|e| (e.u, e.count)))
            }
        };
        tally.at_knots += knots;
        let in_doubt = |doubt: &Undecided| doubt.quantity == function.quantity;
        if features.undecided.iter().any(in_doubt) {
            continue;
        }
        let Some(expected) = exact_changes(curve, &exact, function) else {
            continue;
        };
        assert_eq!(count, expected, "{:?} of {curve:?}", function.quantity);
        if function.quantity == Feature::CurvatureExtremum {
            let monotone = if expected == 0 {
                Verdict::Proved
            } else {
                Verdict::Disproved
            };
            assert_eq!(features.monotone, monotone, "{expected} extrema");
        }
    }
}

/// Count the features whose interval is a point.
fn at_knots(features: impl Iterator<Item = ([f64; 2], usize)>) -> usize {
    let points = features.filter(|(u, _)| u[0] == u[1]);
    points.map(|(_, count)| count).sum()
}

/// Compare random curves of these degrees with exact arithmetic; fewer than one segment in a
/// thousand may stay undecided.
fn check_curves(seed: u64, degrees: RangeInclusive<usize>, count: usize, kind: Kind) {
    let mut random = Random(seed);
    let mut prover = SegmentProver::new(!kind.in_space);
    let mut tally = Tally::default();
    for degree in degrees.cycle().take(count) {
        let curve = random_curve(&mut random, degree, kind);
        check_curve(&curve, &mut prover, &mut tally);
    }
    assert_eq!(tally.curves, count);
    assert!(tally.roots > count / 4, "{tally:?}");
    assert_eq!(tally.wide, 0);
    assert!(
        1000 * tally.undecided_segments < tally.segments,
        "{tally:?}"
    );
}

#[test]
fn planar_curves_of_degrees_2_to_6() {
    check_curves(1, 2..=6, 4000, PLANAR);
}

#[test]
fn planar_curves_of_degrees_7_to_10() {
    check_curves(2, 7..=10, 2600, PLANAR);
}

#[test]
fn planar_curves_with_all_digits() {
    check_curves(
        3,
        2..=10,
        600,
        Kind {
            whole: false,
            ..PLANAR
        },
    );
}

#[test]
fn planar_rational_curves() {
    check_curves(
        4,
        2..=7,
        900,
        Kind {
            rational: true,
            ..PLANAR
        },
    );
}

#[test]
fn space_curves() {
    check_curves(
        5,
        2..=8,
        1500,
        Kind {
            in_space: true,
            ..PLANAR
        },
    );
}

#[test]
fn rational_space_curves() {
    check_curves(
        6,
        2..=5,
        400,
        Kind {
            in_space: true,
            rational: true,
            whole: true,
        },
    );
}

#[test]
fn curves_of_high_degree() {
    for (kind, degrees, count) in [
        (PLANAR, 18..=25, 8),
        (
            Kind {
                rational: true,
                ..PLANAR
            },
            12..=13,
            2,
        ),
        (
            Kind {
                in_space: true,
                ..PLANAR
            },
            14..=15,
            2,
        ),
    ] {
        check_curves(7, degrees, count, kind);
    }
}

/// A curve that nearly, or exactly, has something special.
fn special_curve(random: &mut Random, degree: usize) -> FloatPolygon {
    let count = degree + 1 + (random.bits() % 4) as usize;
    let in_space = random.bits().is_multiple_of(4);
    let tiny = 10.0_f64.powf(random.between(-17.0, -2.0));
    let mut vertices: Vec<DVec3> = match random.bits() % 5 {
        // Nearly straight.
        0 => (0..count)
            .map(|i| DVec3::new(1.0, 0.3, 0.0) * i as f64 + random.vector(tiny, in_space))
            .collect(),
        // Nearly a circle.
        1 => (0..count)
            .map(|i| DVec3::new((0.5 * i as f64).cos(), (0.5 * i as f64).sin(), 0.0) * 10.0)
            .map(|vertex| vertex + random.vector(tiny, in_space))
            .collect(),
        // Turning back on itself, nearly.
        2 => (0..count)
            .map(|i| DVec3::new((i % 3) as f64, (i % 2) as f64, 0.0))
            .map(|vertex| vertex + random.vector(tiny, in_space))
            .collect(),
        // A small grid, on which vertices coincide and lie in line.
        3 => (0..count)
            .map(|_| random.vector(1.5, in_space).round())
            .collect(),
        // Legs of very different lengths.
        _ => (0..count)
            .map(|_| random.vector(1.0, in_space) * 10.0_f64.powf(random.between(-6.0, 2.0)))
            .collect(),
    };
    if random.bits().is_multiple_of(4) {
        let far = random.vector(1e6, false);
        vertices.iter_mut().for_each(|vertex| *vertex += far);
    }
    let weights = random.bits().is_multiple_of(3).then(|| {
        (0..count)
            .map(|_| 10.0_f64.powf(random.between(-3.0, 3.0)))
            .collect()
    });
    let periodic = random.bits().is_multiple_of(4);
    FloatPolygon::new(degree, vertices, weights, periodic).expect("a valid polygon")
}

#[test]
fn curves_near_something_special_are_never_misjudged() {
    let (count, mut random) = (1000, Random(8));
    let mut tally = Tally::default();
    for degree in (2..=6).cycle().take(count) {
        let curve = special_curve(&mut random, degree);
        let mut prover = SegmentProver::new(curve.is_planar());
        check_curve(&curve, &mut prover, &mut tally);
    }
    // What stays undecided are double roots on the small grids.
    assert!(500 * tally.undecided_segments < tally.segments, "{tally:?}");
    assert_eq!(tally.wide, 0);
    assert!(tally.roots > count / 4, "{tally:?}");
}
