//! Proved features where they are known: degenerate and symmetrical curves, knots at low
//! degrees, the paper's arc.

use std::f64::consts::TAU;

use crate::common::{Random, assert_near, counts, exact};
use crate::witness::ExactSegment;
use batten::geometry::features::{ExtremumKind, Features, Root, Trend, Verdict};
use batten::geometry::paper::regular_polygon;
use batten::geometry::{BezierPolygon, FloatPolygon};
use glam::DVec3;

/// The width of the interval of a root: what it is narrowed to, and one rounding of u.
const ROOT_WIDTH: f64 = 1.1e-12;

/// What rounding may do to a curvature that is well determined.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

fn planar(degree: usize, points: &[(f64, f64)]) -> FloatPolygon {
    FloatPolygon::planar(degree, points).expect("a valid polygon")
}

fn features(degree: usize, points: &[(f64, f64)]) -> Features {
    exact(&planar(degree, points))
}

/// The middle of bounds.
fn middle([low, high]: [f64; 2]) -> f64 {
    0.5 * (low + high)
}

fn places(roots: &[Root]) -> Vec<[f64; 2]> {
    roots.iter().map(|root| root.u).collect()
}

#[test]
fn the_ripple_of_the_papers_arc_is_proved() {
    let arc = regular_polygon(9, 12, 10.0).expect("a valid arc");
    let features = exact(&arc);
    assert_eq!(counts(&features), [0, 1, 0, 0, 0]);
    let extremum = features.curvature_extrema[0];
    assert!(extremum.u[0] <= 0.5 && 0.5 <= extremum.u[1], "{extremum:?}");
    assert!(extremum.u[1] - extremum.u[0] <= ROOT_WIDTH);
    assert_eq!(features.monotone, Verdict::Disproved);
    // The arc runs clockwise: the flattest place is the maximum of the signed curvature.
    assert_eq!(extremum.kind, ExtremumKind::Maximum);
    let trends: Vec<Trend> = features.trends.iter().map(|piece| piece.trend).collect();
    assert_eq!(trends, [Trend::Rising, Trend::Falling]);
    // Exact arithmetic with the same doubles finds the same one root, and none at the ends.
    let exact = &ExactSegment::all(&arc)[0];
    let slope = exact.curvature_slope();
    assert_eq!(slope.roots_inside(), 1);
    assert_eq!(extremum.u.map(|u| slope.sign_at(u)), [1, -1]);
    // The ripple is 1.31e-8 of the curvature.
    let ends = arc.jet(0.0).signed_curvature();
    let ripple = (ends / middle(extremum.value) - 1.0).abs();
    assert_near("ripple", ripple, 1.31e-8, 0.01, 1.31e-8);
}

#[test]
fn the_ends_of_the_papers_arc_are_decided_as_its_rounding_has_it() {
    let arc = regular_polygon(9, 12, 10.0).expect("a valid arc");
    // Moving one coordinate by some units in the last place moves the roots next to the ends
    // in or out of the domain: the proof follows the doubles given.
    let mut found = [0; 4];
    for vertex in 0..10 {
        for steps in [-40_i64, -3, 3, 40] {
            let mut vertices = arc.vertices().to_vec();
            let bits = vertices[vertex].x.to_bits() as i64 + steps;
            vertices[vertex].x = f64::from_bits(bits as u64);
            let moved = FloatPolygon::new(9, vertices, None, false).expect("a valid arc");
            let features = exact(&moved);
            let exact = ExactSegment::all(&moved)[0]
                .curvature_slope()
                .roots_inside();
            assert_eq!(
                counts(&features),
                [0, exact, 0, 0, 0],
                "vertex {vertex}, {steps}"
            );
            found[exact] += 1;
        }
    }
    assert!(found[1] > 0 && found[2] + found[3] > 0, "{found:?}");
}

#[test]
fn straight_lines_are_constant() {
    for direction in [(1.0, 0.0), (0.0, 1.0), (1.0, 3.0), (-7.0, 11.0)] {
        for degree in 1..=25 {
            let points: Vec<_> = (0..degree + 4)
                .map(|i| (direction.0 * i as f64, direction.1 * i as f64))
                .collect();
            let features = features(degree, &points);
            assert_eq!(counts(&features), [0; 5], "degree {degree}");
            assert_eq!(features.monotone, Verdict::Proved);
            assert_eq!(features.trends.len(), 1);
            assert_eq!(features.trends[0].trend, Trend::Constant);
            assert_eq!(features.trends[0].u, [0.0, 4.0]);
        }
    }
    let line = (0..12)
        .map(|i| DVec3::new(1.0, -2.0, 5.0) * f64::from(i))
        .collect();
    let weights = (1..13).map(f64::from).collect();
    let line = FloatPolygon::new(5, line, Some(weights), true).expect("a valid polygon");
    let features = exact(&line);
    assert!(features.undecided.is_empty() && features.curvature_extrema.is_empty());
    // A periodic line turns back twice.
    assert_eq!(features.cusps.len(), 2);
    assert!(features.cusps.iter().all(|cusp| cusp.proved));
    assert_eq!(features.monotone, Verdict::Undecided);
}

#[test]
fn polylines_have_no_features() {
    let features = features(1, &[(0.0, 0.0), (3.0, 1.0), (4.0, 5.0), (0.0, 6.0)]);
    assert_eq!(counts(&features), [0; 5]);
    assert_eq!(features.monotone, Verdict::Proved);
}

#[test]
fn a_straight_piece_next_to_a_bend_leaves_no_doubt() {
    for direction in [(1.0, 0.0), (1.0, 3.0)] {
        for degree in 3..=9 {
            let mut points: Vec<_> = (0..degree + 3)
                .map(|i| (direction.0 * i as f64, direction.1 * i as f64))
                .collect();
            let last = degree as f64 + 2.0;
            let [x, y] = [direction.0 * last, direction.1 * last];
            points.push((x + direction.0 - direction.1, y + direction.1 + direction.0));
            let features = features(degree, &points);
            assert_eq!(features.undecided, [], "degree {degree}");
            assert_eq!(features.trends[0].trend, Trend::Constant);
            assert_eq!(features.trends[0].u, [0.0, 3.0]);
            assert!(features.inflections.is_empty());
        }
    }
}

#[test]
fn a_straight_piece_between_opposite_bends_is_one_inflection() {
    let mut points = vec![(-1.0, 2.0), (0.0, 0.0)];
    points.extend((1..7).map(|i| (f64::from(i), 0.0)));
    points.extend([(7.0, 0.0), (8.0, -2.0)]);
    let features = features(4, &points);
    // Vertices 1 … 8 lie on the line: segments 1 … 4.
    assert_eq!(places(&features.inflections), [[1.0, 5.0]]);
    assert_eq!(features.undecided, []);
}

#[test]
fn coincident_vertices_are_cusps() {
    for degree in 2..=9 {
        let features = features(degree, &vec![(3.0, 4.0); degree + 3]);
        assert_eq!(features.curvature_extrema, []);
        assert_eq!(features.monotone, Verdict::Undecided);
        assert_eq!(features.cusps.len(), 1);
        assert!(features.cusps[0].proved);
        assert_eq!(features.cusps[0].u, [0.0, 3.0]);
    }
    // n coincident vertices stop the curve at one knot.
    let points = [
        (0.0, 0.0),
        (1.0, 2.0),
        (3.0, 3.0),
        (3.0, 3.0),
        (3.0, 3.0),
        (5.0, 2.0),
        (6.0, 0.0),
    ];
    let features = features(3, &points);
    assert_eq!(features.cusps.len(), 1);
    assert!(features.cusps[0].proved);
    assert_eq!(features.cusps[0].u, [2.0, 2.0]);
}

#[test]
fn the_cusp_of_a_cubic_is_found_and_nothing_is_claimed_there() {
    // C′ = (2 s, 3 s²) with s = t − ½.
    let features = features(3, &[(0.0, 0.0), (-2.0, 2.25), (-2.0, 1.5), (0.0, 3.75)]);
    assert_eq!(features.cusps.len(), 1);
    let cusp = features.cusps[0];
    assert!(cusp.proved && cusp.u[0] <= 0.5 && 0.5 <= cusp.u[1]);
    assert!(cusp.u[1] - cusp.u[0] <= 1e-9);
    assert_eq!(features.curvature_extrema, []);
    assert!(features.inflections.is_empty());
    assert_eq!(features.monotone, Verdict::Undecided);
}

#[test]
fn turning_back_on_a_line_is_a_proved_cusp() {
    let features = features(
        3,
        &[(0.0, 0.0), (1.0, 2.0), (3.0, 6.0), (1.0, 2.0), (0.0, 0.0)],
    );
    assert_eq!(features.cusps.len(), 1, "{:?}", features.cusps);
    assert!(features.cusps[0].u[0] <= 1.0 && 1.0 <= features.cusps[0].u[1]);
    assert_eq!(features.undecided, []);
    assert_eq!(features.monotone, Verdict::Undecided);
}

#[test]
fn a_cusp_at_a_simple_fraction_is_proved() {
    // C′ = (2 s, 3 s²) with s = 3 t − 1, in Bézier form.
    let bezier = [(0.0, 0.0), (-2.0, 3.0), (-1.0, -3.0), (3.0, 9.0)];
    let vertices = bezier.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let bezier = BezierPolygon::new(3, vertices, None).expect("valid");
    let features = exact(&bezier.to_float().expect("one segment"));
    let [cusp] = features.cusps[..] else {
        panic!("{features:?}");
    };
    assert!(cusp.proved && cusp.u[0] <= 1.0 / 3.0 && 1.0 / 3.0 <= cusp.u[1]);
    assert!(cusp.u[1] <= cusp.u[0].next_up(), "{cusp:?}");
}

#[test]
fn vertices_on_a_line_need_not_be_round_numbers() {
    let vertices = [0.1, 0.7, 1.3, 1.9, 3.3, 4.1].map(|x| DVec3::new(x, x, 0.0));
    let line = FloatPolygon::new(4, vertices.to_vec(), None, false).expect("valid");
    let features = exact(&line);
    assert_eq!(counts(&features), [0; 5]);
    assert_eq!(features.undecided, []);
    assert_eq!(features.monotone, Verdict::Proved);
}

#[test]
fn both_sides_of_a_knot_may_agree_exactly() {
    // A square with rounded corners, of degree 2: κ is the same on both sides of every knot, and
    // its slope is 0 there at the curve's ends and where two arcs of one kind meet.
    let features = features(
        2,
        &[
            (0.0, 0.0),
            (1.0, 0.0),
            (2.0, 1.0),
            (2.0, 2.0),
            (1.0, 3.0),
            (0.0, 3.0),
        ],
    );
    assert_eq!(features.undecided, []);
    assert!(features.inflections.is_empty());
    let kinds = features
        .curvature_extrema
        .iter()
        .map(|extremum| extremum.kind);
    let kinds: Vec<_> = kinds.collect();
    use ExtremumKind::{Maximum, Minimum};
    assert_eq!(kinds, [Minimum, Maximum, Minimum]);
}

#[test]
fn torsion_may_jump_where_a_space_curve_is_flat() {
    // κ = 0 at u = 3; τ is 0 before and −½ just behind.
    let points = [
        [0, 0, 1],
        [1, 1, 1],
        [0, -1, 1],
        [1, -1, 1],
        [-1, -1, 1],
        [0, -1, 1],
        [0, 0, 1],
        [-1, 1, 0],
    ];
    let vertices = points
        .map(|point| DVec3::from(point.map(f64::from)))
        .to_vec();
    let curve = FloatPolygon::new(4, vertices, None, false).expect("valid");
    let features = exact(&curve);
    assert_eq!(counts(&features)[3], 1);
    let doubts: Vec<_> = features.undecided.iter().map(|doubt| doubt.u).collect();
    assert!(doubts.contains(&[3.0, 3.0]), "{doubts:?}");
}

#[test]
fn extrema_next_to_a_cusp_have_values_of_the_right_sign() {
    let points = [
        (0.0, 0.0),
        (0.3, 1.0),
        (0.6, 2.0),
        (0.8999999999999999, 2.0),
        (1.2, 3.0),
        (1.5, 3.0),
        (1.2, 3.0),
        (0.8999999999999999, 3.0),
    ];
    let vertices = points.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let curve = FloatPolygon::new(3, vertices, None, true).expect("valid");
    let features = exact(&curve);
    let last = features.curvature_extrema.last().expect("extrema");
    assert_eq!(last.kind, ExtremumKind::Maximum);
    assert!(last.value[0] > 1e19, "{last:?}");
    let lows = features.curvature_extrema.windows(2);
    assert!(lows.into_iter().all(|pair| pair[0].u[0] <= pair[1].u[0]));
}

#[test]
fn sizes_far_apart_are_no_doubt_at_low_degrees() {
    let vertices = [(168.0, -276.0), (1e-150, -325.0), (-168.0, -276.0)];
    let vertices = vertices.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let weights = Some(vec![26.0, 24.0, 26.0]);
    let curve = FloatPolygon::new(2, vertices, weights, false).expect("valid");
    let features = exact(&curve);
    assert_eq!(features.undecided, []);
    assert_ne!(features.monotone, Verdict::Undecided);
}

#[test]
fn symmetrical_curves_have_their_extremum_in_the_middle() {
    for degree in 3..=25 {
        for extra in 0..4 {
            let last = (degree + extra) as i32;
            let points: Vec<_> = (0..=last)
                .map(|i| f64::from(2 * i - last))
                .map(|x| (x, (x * x * (1.0 + x * x / 64.0)).round()))
                .collect();
            let features = features(degree, &points);
            let middle = (extra as f64 + 1.0) / 2.0;
            let holds = |u: [f64; 2]| u[0] <= middle && middle <= u[1];
            let found: Vec<_> = features
                .curvature_extrema
                .iter()
                .filter(|extremum| holds(extremum.u))
                .collect();
            assert_eq!(found.len(), 1, "degree {degree}, {extra}: {features:?}");
            assert!(found[0].u[1] - found[0].u[0] <= 3.0 * ROOT_WIDTH);
            assert_eq!(features.undecided, [], "degree {degree}");
        }
    }
}

#[test]
fn a_quadratic_jumps_at_its_knots_by_the_stated_rule() {
    // With the legs a, b, c the curvature is a × b / |b|³ before the knot and b × c / |b|³ behind.
    // It rises up to the knot and from it on, and has a maximum in the second segment.
    let up = features(2, &[(-9.0, 0.0), (0.0, 0.0), (3.0, 3.0), (-5.0, 5.0)]);
    assert_eq!(counts(&up), [0, 1, 0, 0, 0]);
    assert!(up.curvature_extrema[0].u[0] > 1.0);
    let down = features(2, &[(-9.0, 0.0), (0.0, 0.0), (3.0, 3.0), (2.0, 5.0)]);
    assert_eq!(counts(&down), [0, 3, 0, 0, 0]);
    // The maximum before the knot and the minimum behind it share their place.
    let [at_knot, inside] = down.curvature_extrema[..] else {
        panic!("three extrema at two places");
    };
    let kinds = [at_knot, inside].map(|extremum| extremum.kind == ExtremumKind::Maximum);
    assert_eq!(kinds, [true, true]);
    assert_eq!((at_knot.u, at_knot.count, inside.count), ([1.0, 1.0], 2, 1));
    let cube = 18.0_f64.powf(1.5);
    assert_near("before", middle(at_knot.value), 27.0 / cube, ROUNDINGS, 1.0);
    // A zigzag changes its sense at the knot: κ jumps from one sign to the other.
    let zigzag = features(2, &[(0.0, 0.0), (1.0, 3.0), (4.0, 4.0), (5.0, 7.0)]);
    assert_eq!(places(&zigzag.inflections), [[1.0, 1.0]]);
}

#[test]
fn a_symmetrical_cubic_has_an_extremum_on_its_knot() {
    let features = features(
        3,
        &[(-6.0, 0.0), (-3.0, 4.0), (0.0, 5.0), (3.0, 4.0), (6.0, 0.0)],
    );
    let mut extrema = features.curvature_extrema.iter();
    let on_knot = extrema
        .find(|extremum| extremum.u == [1.0, 1.0])
        .expect("an extremum");
    assert_eq!(features.undecided, []);
    // C″ = P₁ − 2 P₂ + P₃ = (0, −2) and C′ = (P₃ − P₁) / 2 = (3, 0) at the knot.
    assert_near(
        "curvature",
        middle(on_knot.value),
        -2.0 / 9.0,
        ROUNDINGS,
        1.0,
    );
}

#[test]
fn exact_circles_have_constant_curvature() {
    // (1 − t², 2 t) / (1 + t²) times 21 on two segments, and times 35 on one of degree 3.
    let two = (
        2,
        vec![(21.0, -21.0), (21.0, 21.0), (-7.0, 21.0), (-15.0, 15.0)],
        vec![1.0, 1.0, 3.0, 7.0],
    );
    let cubic = (
        3,
        vec![(7.0, -42.0), (70.0, 0.0), (7.0, 42.0), (-20.0, 30.0)],
        vec![5.0, 2.0, 5.0, 14.0],
    );
    let curves = [two, cubic]
        .into_iter()
        .flat_map(|(degree, points, weights)| {
            [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [3.0, 5.0, 4.0]].map(|tilt| {
                // In the plane, upright, and in the plane of two vectors of length 5.
                let place = |(x, y): &(f64, f64)| match tilt {
                    [_, _, 1.0] => DVec3::new(*x, *y, 0.0),
                    [_, up, 0.0] => DVec3::new(*x, up, *y),
                    [a, b, c] => DVec3::new(a * x, b * y, c * x),
                };
                let vertices = points.iter().map(place).collect();
                FloatPolygon::new(degree, vertices, Some(weights.clone()), false).expect("valid")
            })
        });
    for curve in curves {
        let features = exact(&curve);
        assert_eq!(counts(&features), [0; 5], "{features:?}");
        assert_eq!(features.undecided, []);
        assert_eq!(features.monotone, Verdict::Proved);
        let length = curve.segments() as f64;
        let [piece] = features.trends[..] else {
            panic!("one piece");
        };
        assert_eq!((piece.trend, piece.u), (Trend::Constant, [0.0, length]));
    }
}

#[test]
fn a_plane_curve_in_space_has_no_torsion() {
    let mut random = Random(3);
    let mut whole = || random.between(-50.0, 50.0).round();
    let vertices = (0..30).map(|_| {
        let (x, y) = (whole(), whole());
        DVec3::new(x, y, 2.0 * x - 3.0 * y)
    });
    let mut vertices: Vec<_> = vertices.collect();
    let curve = FloatPolygon::new(5, vertices.clone(), None, true).expect("valid");
    let features = exact(&curve);
    assert_eq!(counts(&features)[2..4], [0, 0]);
    assert_eq!(features.undecided, []);
    // One vertex beside the plane is enough, by however little: then the torsion is proved where
    // the curve leaves the plane.
    vertices[7].z = vertices[7].z.next_up();
    let bent = FloatPolygon::new(5, vertices, None, true).expect("valid");
    let features = exact(&bent);
    assert_ne!(counts(&features)[3], 0);
    assert_eq!(features.undecided, []);
}

#[test]
fn an_ellipse_like_curve_has_four_vertices_wherever_its_joint_is() {
    for degree in [3, 4, 5, 8] {
        let vertices: Vec<_> = (0..16)
            .map(|i| f64::from(i) / 16.0 * TAU)
            .map(|angle| DVec3::new(9.0 * angle.cos(), 5.0 * angle.sin(), 0.0))
            .collect();
        for by in 0..4 {
            let mut vertices = vertices.clone();
            vertices.rotate_left(by);
            let curve = FloatPolygon::new(degree, vertices, None, true).expect("valid");
            let features = exact(&curve);
            assert_eq!(features.undecided, [], "degree {degree}");
            let kinds: Vec<_> = features.curvature_extrema.iter().map(|e| e.kind).collect();
            let maxima = kinds
                .iter()
                .filter(|kind| **kind == ExtremumKind::Maximum)
                .count();
            // A cubic's slope jumps at the knots, which adds small extrema in pairs.
            if degree > 3 {
                assert_eq!(
                    (kinds.len(), maxima),
                    (4, 2),
                    "degree {degree}: {features:?}"
                );
            }
            assert_eq!(kinds.len(), 2 * maxima);
        }
    }
}
