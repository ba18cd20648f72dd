//! From the float polygon to the Bézier or clamped polygon in doubles and back: the curve comes
//! back, and what is said of how far it may be off is true. Curves are compared in exact
//! arithmetic at places of every segment, by integer basis functions of their own.

use crate::common::{Random, reach};
use crate::exact_witness::{Exact, Knots, homogeneous, integer, ulp};
use batten::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon, NearestFloat, PolygonError};
use glam::DVec3;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

/// How far the curve may be off that comes back, in units in the last place of the largest
/// coordinate of its Bézier vertices.
const ALLOWED_ULPS: f64 = 4.0;

/// What rounding the float vertices and weights may add, in units in the last place of the largest
/// coordinate of the float polygon.
const POLYGON_ULPS: f64 = 1.0;

/// Where in a segment curves are compared, in quarters.
const QUARTERS: [i64; 5] = [0, 1, 2, 3, 4];

#[derive(Clone, Copy, Debug)]
struct Case {
    degree: usize,
    segments: usize,
    in_space: bool,
    rational: bool,
    periodic: bool,
}

/// Curves of a degree: planar and in space, polynomial and rational, open and periodic, of one to
/// thirty segments.
fn cases(degree: usize) -> Vec<Case> {
    let mut cases = Vec::new();
    for (index, segments) in [1, 2, 3, 7, degree + 1, 30].into_iter().enumerate() {
        for rational in [false, true] {
            let in_space = (index + degree).is_multiple_of(2);
            let periodic = segments > degree && index % 2 == 1;
            cases.push(Case {
                degree,
                segments,
                in_space,
                rational,
                periodic,
            });
        }
    }
    cases
}

impl Case {
    fn polygon(self, random: &mut Random) -> FloatPolygon {
        let count = self.segments + if self.periodic { 0 } else { self.degree };
        let vertices = (0..count).map(|_| random.vector(100.0, self.in_space));
        let vertices = vertices.collect();
        let weights = (0..count).map(|_| random.between(0.5, 2.0)).collect();
        let weights = Some(weights).filter(|_| self.rational);
        FloatPolygon::new(self.degree, vertices, weights, self.periodic).expect("valid")
    }
}

/// The values of the basis functions of one segment of a float polygon at a number of quarters,
/// times n! 4ⁿ.
fn float_basis(degree: usize, quarters: i64) -> Vec<BigInt> {
    let mut values = vec![BigInt::one()];
    for level in 1..=degree as i64 {
        let at = |index: i64| {
            let index = usize::try_from(index).ok();
            index.and_then(|index| values.get(index)).cloned()
        };
        let value = |index: i64| {
            let falling = at(index).unwrap_or_default() * (4 * (index + 1) - quarters);
            falling + at(index - 1).unwrap_or_default() * (4 * (level - index) + quarters)
        };
        values = (0..=level).map(value).collect();
    }
    values
}

/// The values of Bernstein's polynomials at a number of quarters, times 4ⁿ.
fn bernstein(degree: usize, quarters: i64) -> Vec<BigInt> {
    let mut binomial = BigInt::one();
    let mut values = Vec::new();
    for k in 0..=degree {
        let power = |base: i64, exponent: usize| BigInt::from(base).pow(exponent as u32);
        values.push(&binomial * power(quarters, k) * power(4 - quarters, degree - k));
        binomial = binomial * (degree - k) / (k + 1);
    }
    values
}

/// Whole numbers that are the homogeneous coordinates of vertices times one power of two.
fn whole(points: &[DVec3], weights: Option<&[f64]>) -> Vec<[BigInt; 4]> {
    let vertices = homogeneous(points, weights);
    let denominators = vertices.iter().flatten().map(BigRational::denom);
    let scale = denominators.max().expect("vertices").clone();
    let vertices = vertices.iter();
    vertices
        .map(|v| v.each_ref().map(|number| (number * &scale).to_integer()))
        .collect()
}

/// The point of a curve by the vertices and the values of their basis functions.
fn point(vertices: &[&[BigInt; 4]], basis: &[BigInt]) -> [Exact; 3] {
    let sum = |axis: usize| -> BigInt {
        let terms = vertices.iter().zip(basis);
        terms.map(|(vertex, value)| &vertex[axis] * value).sum()
    };
    let weight = sum(3);
    [0, 1, 2].map(|axis| BigRational::new(sum(axis), weight.clone()))
}

/// The points of a curve at the quarters of all segments.
fn float_points(polygon: &FloatPolygon) -> Vec<[Exact; 3]> {
    let vertices = whole(polygon.vertices(), polygon.weights());
    let bases = QUARTERS.map(|quarters| float_basis(polygon.degree(), quarters));
    let segments = 0..polygon.segments();
    let points = segments.flat_map(|segment| {
        let window: Vec<_> = (segment..=segment + polygon.degree())
            .map(|index| &vertices[index % vertices.len()])
            .collect();
        bases.each_ref().map(|basis| point(&window, basis))
    });
    points.collect()
}

fn bezier_points(polygon: &BezierPolygon) -> Vec<[Exact; 3]> {
    let degree = polygon.degree();
    let vertices = whole(polygon.vertices(), polygon.weights());
    let bases = QUARTERS.map(|quarters| bernstein(degree, quarters));
    let segments = 0..polygon.segments();
    let points = segments.flat_map(|segment| {
        let window = &vertices[segment * degree..=(segment + 1) * degree];
        let window: Vec<_> = window.iter().collect();
        bases.each_ref().map(|basis| point(&window, basis))
    });
    points.collect()
}

/// The segments of a curve next to its ends, where a clamped polygon has knots of its own.
fn some_segments(segments: usize) -> Vec<usize> {
    let mut some = vec![0, 1, segments - 1];
    some.retain(|segment| *segment < segments);
    some.dedup();
    some
}

/// The points of some segments by de Boor's recurrence on the clamped knots.
fn clamped_points(polygon: &ClampedPolygon) -> Vec<[Exact; 3]> {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    let given = homogeneous(polygon.vertices(), polygon.weights());
    let knots = Knots::clamped(degree, segments);
    let points = some_segments(segments).into_iter().flat_map(|segment| {
        QUARTERS.map(|quarters| {
            let at = integer(segment as i64) + BigRational::new(quarters.into(), 4.into());
            let [x, y, z, w] = knots.blossom(&given, segment, &vec![at; degree]);
            [x / &w, y / &w, z / &w]
        })
    });
    points.collect()
}

/// Choose the points of some segments.
fn of_some(points: &[[Exact; 3]]) -> Vec<[Exact; 3]> {
    let segments: Vec<_> = points.chunks(QUARTERS.len()).collect();
    some_segments(segments.len())
        .into_iter()
        .flat_map(|segment| segments[segment].to_vec())
        .collect()
}

/// The largest distance of points.
fn distance(a: &[[Exact; 3]], b: &[[Exact; 3]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let squares = a.iter().zip(b).map(|(a, b)| {
        let differences = a.iter().zip(b).map(|(a, b)| a - b);
        differences
            .map(|difference| &difference * &difference)
            .sum()
    });
    let worst: Exact = squares.fold(Exact::zero(), |worst: Exact, square: Exact| {
        worst.max(square)
    });
    worst.to_f64().expect("a number").sqrt()
}

/// Assert that what is said of how far the curve may be off holds, and measure how far it is.
#[track_caller]
fn check_bound(case: Case, given: &[[Exact; 3]], nearest: &NearestFloat, found: &[[Exact; 3]]) {
    let off = distance(found, given);
    // The distance here is rounded once.
    assert!(
        off <= nearest.deviation * (1.0 + f64::EPSILON),
        "{case:?}: off by {off:e}, more than {:e}",
        nearest.deviation
    );
}

#[track_caller]
fn check_kept(case: Case, original: &FloatPolygon, nearest: &NearestFloat, found: &[[Exact; 3]]) {
    // Rounding a float polygon larger than its curve costs that much by itself.
    let curve = ulp(reach(BezierPolygon::from_float(original).vertices()));
    let allowed = ALLOWED_ULPS * curve + POLYGON_ULPS * ulp(reach(original.vertices()));
    let off = distance(found, &float_points(original));
    assert!(off <= allowed, "{case:?}: {} ulp", off / curve);
    assert!(
        nearest.deviation <= allowed,
        "{case:?}: {:e}",
        nearest.deviation
    );
}

#[test]
fn float_to_bezier_and_back_keeps_the_curve() {
    let mut random = Random(21);
    for case in (1..=25).flat_map(cases) {
        let polygon = case.polygon(&mut random);
        let bezier = BezierPolygon::from_float(&polygon);
        let nearest = if case.periodic {
            bezier.nearest_periodic_float()
        } else {
            bezier.nearest_float()
        };
        let nearest = nearest.unwrap_or_else(|error| panic!("{case:?}: {error}"));
        let found = float_points(&nearest.polygon);
        check_bound(case, &bezier_points(&bezier), &nearest, &found);
        check_kept(case, &polygon, &nearest, &found);
    }
}

#[test]
fn float_to_clamped_and_back_keeps_the_curve() {
    let mut random = Random(22);
    for case in (1..=25).flat_map(cases) {
        let polygon = case.polygon(&mut random);
        let clamped = ClampedPolygon::from_float(&polygon);
        let nearest = if case.periodic {
            clamped.nearest_periodic_float()
        } else {
            clamped.nearest_float()
        };
        let nearest = nearest.unwrap_or_else(|error| panic!("{case:?}: {error}"));
        let found = float_points(&nearest.polygon);
        check_bound(case, &clamped_points(&clamped), &nearest, &of_some(&found));
        check_kept(case, &polygon, &nearest, &found);
    }
}

/// Round all coordinates to so many digits behind the decimal point.
fn rounded(points: &[DVec3], digits: usize) -> Vec<DVec3> {
    let round = |value: f64| format!("{value:.digits$}").parse().expect("a number");
    let points = points.iter();
    points
        .map(|p| DVec3::from_array(p.to_array().map(round)))
        .collect()
}

#[test]
fn polygons_rounded_to_ten_digits_are_read_with_a_bound_that_holds() {
    let mut random = Random(23);
    for case in (1..=25).flat_map(cases) {
        let polygon = case.polygon(&mut random);
        let bezier = BezierPolygon::from_float(&polygon);
        // Coordinates up to 100: eight digits behind the point, rounded by up to 5e-9.
        let points = rounded(bezier.vertices(), 8);
        let weights = bezier.weights().map(|weights| {
            let weights = weights.iter().map(|w| DVec3::new(*w, 0.0, 0.0));
            let weights = rounded(&weights.collect::<Vec<_>>(), 10);
            weights.into_iter().map(|w| w.x).collect()
        });
        let bezier = BezierPolygon::new(case.degree, points, weights).expect("valid");
        let nearest = if case.periodic {
            bezier.nearest_periodic_float()
        } else {
            bezier.nearest_float()
        };
        let nearest = match nearest {
            Ok(nearest) => nearest,
            Err(PolygonError::WeightLost { .. }) if case.rational && case.degree > 10 => continue,
            Err(error) => panic!("{case:?}: {error}"),
        };
        let found = float_points(&nearest.polygon);
        check_bound(case, &bezier_points(&bezier), &nearest, &found);
    }
}

#[test]
fn single_segments_are_read_with_a_bound_that_holds_or_refused_for_lost_digits() {
    let mut random = Random(24);
    for degree in 1..=25 {
        for in_space in [false, true] {
            let case = Case {
                degree,
                segments: 1,
                in_space,
                rational: false,
                periodic: false,
            };
            let points = (0..=degree).map(|_| random.vector(100.0, in_space));
            let bezier = BezierPolygon::new(degree, points.collect(), None).expect("valid");
            match bezier.nearest_float() {
                Ok(nearest) => {
                    let found = float_points(&nearest.polygon);
                    check_bound(case, &bezier_points(&bezier), &nearest, &found);
                }
                Err(error) => {
                    let lost = matches!(error, PolygonError::DigitsLost { .. });
                    assert!(lost && degree > 12, "{degree}: {error}");
                }
            }
        }
    }
}
