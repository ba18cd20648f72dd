//! Operations that keep the curve keep it; those that do not stay within what they report.

use crate::common::{Kind, Random, kinds, reach};
use batten::geometry::{
    BezierPolygon, ClampedPolygon, End, ExactPolygon, FloatPolygon, PolygonError,
};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

/// What evaluating a curve twice may differ by, in units of the largest coordinate: a few
/// roundings of each level of de Boor's algorithm, and the quotient of a rational curve.
const ROUNDINGS: f64 = 32.0 * f64::EPSILON;

/// What two roundings of one number may differ by where it lies half way between two doubles, in
/// each of three coordinates.
const ONE_ROUNDING: f64 = 2.0 * f64::EPSILON;

/// What a bound of a deviation adds for the rounding of its own arithmetic, relatively.
const BOUND_ROUNDINGS: f64 = 128.0 * f64::EPSILON;

impl Kind {
    /// A smooth open polygon, as a designer lays one.
    fn gentle(self) -> FloatPolygon {
        let count = self.degree + 1 + self.extra;
        Random(self.seed).gentle(self.degree, count, self.in_space, self.rational)
    }
}

fn map(polygon: &FloatPolygon, matrix: DMat3, shift: DVec3) -> FloatPolygon {
    let vertices = polygon.vertices().iter().map(|v| matrix * *v + shift);
    let weights = polygon.weights().map(<[f64]>::to_vec);
    let (degree, periodic) = (polygon.degree(), polygon.is_periodic());
    FloatPolygon::new(degree, vertices.collect(), weights, periodic).expect("valid")
}

/// The largest difference of two lists of points.
fn distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// The largest distance of two curves at a hundred corresponding parameters of \[0, 1\].
fn sampled(a: impl Fn(f64) -> DVec3, b: impl Fn(f64) -> DVec3) -> f64 {
    let steps = (0..=100).map(|step| f64::from(step) / 100.0);
    steps.map(|t| a(t).distance(b(t))).fold(0.0, f64::max)
}

/// What moving a parameter by its rounding moves a point by.
fn shift(polygon: &FloatPolygon, u: f64) -> f64 {
    8.0 * f64::EPSILON * polygon.segments() as f64 * polygon.jet(u).speed()
}

proptest! {
    #![proptest_config(crate::common::repeatable())]

    #[test]
    fn conversions_commute_with_affine_maps(kind in kinds(1..=25)) {
        let polygon = kind.polygon();
        let mut random = Random(kind.seed ^ 1);
        let columns = [0; 3].map(|_| random.vector(1.0, true));
        let matrix = DMat3::from_cols(columns[0], columns[1], columns[2]);
        let shift = random.vector(10.0, true);
        let mapped = map(&polygon, matrix, shift);
        // The map itself rounds, in units of what goes into its sums.
        let allowed = ROUNDINGS * (3.0 * reach(polygon.vertices()) + 10.0);
        let images = |points: &[DVec3]| -> Vec<DVec3> {
            points.iter().map(|v| matrix * *v + shift).collect()
        };
        let (a, b) = (ClampedPolygon::from_float(&polygon), ClampedPolygon::from_float(&mapped));
        prop_assert!(distance(&images(a.vertices()), b.vertices()) <= allowed);
        let (a, b) = (BezierPolygon::from_float(&polygon), BezierPolygon::from_float(&mapped));
        prop_assert!(distance(&images(a.vertices()), b.vertices()) <= allowed);
        let (a, b) = (polygon.subdivided().expect("valid"), mapped.subdivided().expect("valid"));
        prop_assert!(distance(&images(a.vertices()), b.vertices()) <= allowed);
    }

    #[test]
    fn scaling_by_a_power_of_two_scales_every_conversion_bit_for_bit(
        kind in kinds(1..=25),
        power in -60..60,
    ) {
        let kind = Kind { rational: false, ..kind };
        let (polygon, factor) = (kind.polygon(), 2.0_f64.powi(power));
        let scaled = map(&polygon, DMat3::from_diagonal(DVec3::splat(factor)), DVec3::ZERO);
        let times = |points: &[DVec3]| -> Vec<DVec3> {
            points.iter().map(|point| *point * factor).collect()
        };
        let (a, b) = (ClampedPolygon::from_float(&polygon), ClampedPolygon::from_float(&scaled));
        prop_assert_eq!(times(a.vertices()), b.vertices());
        let (a, b) = (a.to_float().expect("valid"), b.to_float().expect("valid"));
        prop_assert_eq!(times(a.vertices()), b.vertices());
    }

    #[test]
    fn conversions_commute_with_reversal(kind in kinds(1..=25)) {
        let polygon = kind.polygon().unrolled();
        let reversed = polygon.reversed();
        let backwards = |points: &[DVec3]| -> Vec<DVec3> {
            points.iter().rev().copied().collect()
        };
        let allowed = ONE_ROUNDING * reach(polygon.vertices());
        let (a, b) = (ClampedPolygon::from_float(&polygon), ClampedPolygon::from_float(&reversed));
        prop_assert!(distance(&backwards(a.vertices()), b.vertices()) <= allowed);
        let backwards_clamped = ClampedPolygon::new(
            kind.degree,
            backwards(a.vertices()),
            a.weights().map(|weights| weights.iter().rev().copied().collect()),
        );
        let backwards_clamped = backwards_clamped.expect("valid");
        if let (Ok(a), Ok(b)) = (a.to_float(), backwards_clamped.to_float()) {
            let allowed = ONE_ROUNDING * reach(a.vertices());
            prop_assert!(distance(&backwards(a.vertices()), b.vertices()) <= allowed);
        }
        let (a, b) = (BezierPolygon::from_float(&polygon), BezierPolygon::from_float(&reversed));
        prop_assert!(distance(&backwards(a.vertices()), b.vertices()) <= allowed);
        let (a, b) = (polygon.subdivided().expect("valid"), reversed.subdivided().expect("valid"));
        prop_assert!(distance(a.reversed().vertices(), b.vertices()) <= allowed);
    }

    #[test]
    fn vertices_away_from_the_ends_do_not_change_a_bit(kind in kinds(2..=9)) {
        let polygon = kind.polygon().unrolled();
        let clamped = ClampedPolygon::from_float(&polygon);
        let inner = kind.degree - 1..(polygon.vertices().len() + 1).saturating_sub(kind.degree);
        prop_assert_eq!(clamped.vertices().get(inner.clone()), polygon.vertices().get(inner.clone()));
        if let Ok(back) = clamped.to_float() {
            let found = back.vertices().get(inner.clone());
            prop_assert_eq!(found, polygon.vertices().get(inner));
        }
    }

    #[test]
    fn subdivision_keeps_the_curve(kind in kinds(1..=25), at in 0.0..1.0) {
        let polygon = kind.polygon();
        let fine = polygon.subdivided().expect("valid");
        prop_assert_eq!(fine.is_periodic(), polygon.is_periodic());
        prop_assert_eq!(fine.segments(), 2 * polygon.segments());
        let u = at * polygon.segments() as f64;
        let error = fine.point(2.0 * u).distance(polygon.point(u));
        let allowed = ROUNDINGS * reach(polygon.vertices());
        prop_assert!(error <= allowed, "{error:e} > {allowed:e}");
    }

    #[test]
    fn extension_keeps_the_curve_and_continues_its_end(
        kind in kinds(1..=25),
        added in 0..4_usize,
        at in 0.0..1.0,
    ) {
        let polygon = Kind { rational: false, ..kind }.polygon().unrolled();
        let segments = polygon.segments();
        let u = at * segments as f64;
        let longer = polygon.extended(End::Finish, added).expect("polynomial");
        prop_assert_eq!(longer.point(u), polygon.point(u));
        prop_assert_eq!(&longer.vertices()[..polygon.vertices().len()], polygon.vertices());
        // The (n + 1)-th differences vanish, as far as rounded vertices have such.
        let degree = kind.degree;
        let count = longer.vertices().len();
        for first in (count - degree - 1 - added)..(count - degree - 1) {
            let mut differences = longer.vertices()[first..first + degree + 2].to_vec();
            let allowed = reach(&differences) * f64::EPSILON * 2.0_f64.powi(degree as i32 + 1);
            while differences.len() > 1 {
                for index in 1..differences.len() {
                    differences[index - 1] = differences[index] - differences[index - 1];
                }
                differences.pop();
            }
            prop_assert!(differences[0].abs().max_element() <= 2.0 * allowed);
        }
        let before = polygon.extended(End::Start, added).expect("polynomial");
        prop_assert_eq!(&before.vertices()[added..], polygon.vertices());
        prop_assert_eq!(
            before.reversed(),
            polygon.reversed().extended(End::Finish, added).expect("polynomial")
        );
    }

    #[test]
    fn raising_one_segment_keeps_the_curve(kind in kinds(1..=12), by in 1..=3_usize, t in 0.0..1.0) {
        let kind = Kind { extra: 0, periodic: false, ..kind };
        let polygon = kind.gentle();
        let Ok(raised) = polygon.with_degree(kind.degree + by) else {
            // Far from the segment the weights of a rational curve may change sign.
            prop_assume!(!kind.rational);
            return Err(TestCaseError::fail("a polynomial curve can be raised"));
        };
        prop_assert!(raised.exact);
        prop_assert_eq!(raised.polygon.degree(), kind.degree + by);
        let weights = raised.polygon.weights().unwrap_or(&[1.0]);
        let (low, high) = weights.iter().fold((f64::MAX, 0.0_f64), |(low, high), w| {
            (low.min(*w), high.max(*w))
        });
        let error = raised.polygon.point(t).distance(polygon.point(t));
        let allowed = ROUNDINGS * reach(raised.polygon.vertices()) * (high / low);
        prop_assert!(error <= allowed, "{error:e} > {allowed:e}");
    }

    #[test]
    fn parts_between_knots_are_the_curve_bit_for_bit(kind in kinds(1..=25), at in 0.0..1.0) {
        let polygon = kind.polygon();
        let segments = polygon.segments();
        let from = (at * segments as f64) as usize;
        let to = if kind.periodic { from + segments } else { segments };
        let [start, end] = [from, to].map(|knot| knot as f64);
        let part = polygon.trimmed(start, end, 0).expect("a part");
        prop_assert!(part.exact);
        let part = part.polygon;
        prop_assert!(!part.is_periodic());
        for (segment, there) in (from..to).enumerate() {
            prop_assert_eq!(
                part.segment_jet(segment, 0.3),
                polygon.segment_jet(there % segments, 0.3)
            );
        }
        if kind.periodic {
            // Half a segment on, round once, across the joint.
            let from = from as f64 + 0.5;
            let part = polygon.trimmed(from, from + segments as f64, 1).expect("a part");
            prop_assert!(part.exact);
            let ends = [0.0, 2.0 * segments as f64].map(|u| part.polygon.point(u));
            let expected = polygon.point(from);
            let allowed = ROUNDINGS * reach(polygon.vertices());
            prop_assert!(ends.iter().all(|end| end.distance(expected) <= allowed));
        }
        if from > 0 && !kind.periodic {
            let (before, after) = polygon.split(start, 0).expect("two parts");
            prop_assert_eq!(before.polygon.vertices(), &polygon.vertices()[..from + kind.degree]);
            prop_assert_eq!(after.polygon, part);
        }
    }

    #[test]
    fn parts_between_dyadic_parameters_are_exact(kind in kinds(1..=15), at in 1..64_u32) {
        let polygon = Kind { periodic: false, ..kind }.polygon();
        let last = polygon.segments() as f64;
        let u = f64::from(at) / 64.0 * last;
        let (before, after) = polygon.split(u, 6).expect("two parts");
        prop_assert!(before.exact && after.exact);
        prop_assert_eq!((before.deviation, after.deviation), (0.0, 0.0));
        let allowed = ROUNDINGS * reach(polygon.vertices());
        for (part, from, to) in [(before.polygon, 0.0, u), (after.polygon, u, last)] {
            let length = part.segments() as f64;
            let error = sampled(
                |t| part.point(t * length),
                |t| polygon.point(from + t * (to - from)),
            );
            let allowed = allowed + shift(&polygon, u) + 1e-14 * reach(polygon.vertices());
            prop_assert!(error <= allowed, "{error:e} > {allowed:e}");
        }
    }

    #[test]
    fn parts_between_any_parameters_deviate_as_reported(
        kind in kinds(1..=9),
        [low, high] in [0.0..0.49, 0.51..1.0_f64],
        subdivisions in 0..3_u32,
    ) {
        let polygon = kind.gentle();
        let last = polygon.segments() as f64;
        let (from, to) = (low * last, high * last);
        let Ok(part) = polygon.trimmed(from, to, subdivisions) else {
            // Beyond the ends the weights of a rational curve may change sign.
            prop_assert!(kind.rational);
            return Ok(());
        };
        prop_assume!(!part.exact);
        let length = part.polygon.segments() as f64;
        let step = (to - from) / length;
        let found = sampled(
            |t| part.polygon.point(t * length),
            |t| polygon.point(from + step * (t * length)),
        );
        let size = reach(polygon.vertices());
        prop_assert!(found <= part.deviation + ROUNDINGS * size, "{found:e}");
        if polygon.segments() == 1 {
            // One polynomial: nothing but rounding.
            prop_assert!(part.deviation <= 1e-11 * size, "{:e}", part.deviation);
        }
    }

    #[test]
    fn other_degrees_deviate_as_reported(kind in kinds(2..=9), degree in 1..=12_usize) {
        let polygon = if kind.periodic { kind.polygon() } else { kind.gentle() };
        let Ok(changed) = polygon.with_degree(degree) else {
            prop_assert!(kind.rational || kind.periodic);
            return Ok(());
        };
        prop_assert_eq!(changed.polygon.segments(), polygon.segments());
        prop_assert_eq!(changed.polygon.is_periodic(), polygon.is_periodic());
        prop_assume!(!changed.exact);
        let last = polygon.segments() as f64;
        let found = sampled(|t| changed.polygon.point(t * last), |t| polygon.point(t * last));
        prop_assert!(found <= changed.deviation, "{found:e} > {:e}", changed.deviation);
        let reversed = polygon.reversed().with_degree(degree).expect("as before");
        let error = distance(reversed.polygon.reversed().vertices(), changed.polygon.vertices());
        prop_assert!(error <= ROUNDINGS * reach(changed.polygon.vertices()), "{error:e}");
    }

    #[test]
    fn rounding_moves_the_curve_by_no_more_than_it_says(kind in kinds(1..=12), digits in 0..9_usize) {
        let polygon = kind.polygon();
        let rounded = polygon.rounded(digits).expect("valid");
        let half = 0.5 * 10.0_f64.powi(-(digits as i32));
        prop_assert!(rounded.moved <= half * 3.0_f64.sqrt() + ROUNDINGS * 10.0);
        prop_assert!(rounded.deviation <= rounded.moved * (1.0 + BOUND_ROUNDINGS));
        let last = polygon.segments() as f64;
        let found = sampled(|t| rounded.polygon.point(t * last), |t| polygon.point(t * last));
        prop_assert!(found <= rounded.deviation + ROUNDINGS * 10.0);
        prop_assert_eq!(polygon.deviation(&rounded.polygon), Ok(rounded.deviation));
        let again = rounded.polygon.rounded(digits).expect("valid");
        prop_assert_eq!((again.moved, again.deviation), (0.0, 0.0));
        prop_assert_eq!(again.polygon, rounded.polygon);

        let clamped = ClampedPolygon::from_float(&polygon);
        let rounded = clamped.rounded(digits).expect("valid");
        prop_assert!(rounded.deviation <= rounded.moved * (1.0 + BOUND_ROUNDINGS));
        let (a, b) = [&clamped, &rounded.polygon].map(|c| {
            ExactPolygon::from_clamped(c).to_bezier().expect("interpolated")
        }).into();
        // The joints of the Bézier polygons are points of the curves.
        for (p, q) in a.vertices().iter().zip(b.vertices()).step_by(kind.degree) {
            prop_assert!(p.distance(*q) <= rounded.deviation + ROUNDINGS * 10.0);
        }
    }

    #[test]
    fn smoothly_closed_polygons_become_periodic_again(kind in kinds(1..=9)) {
        let kind = Kind { periodic: true, rational: kind.rational && kind.degree < 7, ..kind };
        let polygon = kind.polygon();
        let digit = f64::EPSILON * reach(polygon.vertices());
        let clamped = ClampedPolygon::from_float(&polygon);
        let bezier = BezierPolygon::from_float(&polygon);
        let norm = clamped.amplification().norm;
        // Weights between ½ and 2 add a factor of the quotient.
        let allowed = digit * norm * if kind.rational { 32.0 } else { 2.0 };
        for back in [clamped.nearest_periodic_float(), bezier.nearest_periodic_float()] {
            let back = back.expect("closes smoothly").polygon;
            prop_assert!(back.is_periodic());
            let error = distance(back.vertices(), polygon.vertices());
            prop_assert!(error <= allowed, "{error:e} > {allowed:e}");
        }
        let mut moved = clamped.vertices().to_vec();
        moved[0].x += 0.01;
        let weights = clamped.weights().map(<[f64]>::to_vec);
        let open = ClampedPolygon::new(kind.degree, moved, weights).expect("valid");
        let refused = open.nearest_periodic_float().expect_err("does not close");
        prop_assert!(matches!(refused, PolygonError::NotPeriodic { .. }), "{}", refused);
    }
}
