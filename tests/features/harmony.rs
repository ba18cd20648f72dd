//! The harmony of polygons and curves: closed forms, other ways to compute it, properties.

use std::f64::consts::TAU;

use batten::geometry::FloatPolygon;
use batten::geometry::features::{ExtremumKind, Features};
use batten::geometry::harmony::{
    Event, EventCounts, Harmony, Match, Mismatch, VertexFigure, VertexFlow,
};
use batten::geometry::paper::regular_polygon;
use batten::geometry::polygon_figures::{discrete_curvature, turning_angle};
use glam::{DMat3, DVec3};

use crate::common::{Random, assert_near};

/// What the quadrature of fairness may be off by, relative to itself.
const QUADRATURE: f64 = 1e-9;

fn planar(degree: usize, points: impl IntoIterator<Item = (f64, f64)>) -> FloatPolygon {
    let points: Vec<(f64, f64)> = points.into_iter().collect();
    FloatPolygon::planar(degree, &points).expect("a valid polygon")
}

fn harmony(polygon: &FloatPolygon) -> Harmony {
    Harmony::of(polygon, &Features::new(polygon))
}

/// A periodic polygon round an ellipse.
fn ellipse(degree: usize, count: usize, height: f64) -> FloatPolygon {
    let vertices = (0..count).map(|index| {
        let angle = TAU * (index as f64 + 0.25) / count as f64;
        DVec3::new(angle.cos(), height * angle.sin(), 0.0)
    });
    FloatPolygon::new(degree, vertices.collect(), None, true).expect("a valid polygon")
}

/// Legs in geometric progression that turn by one angle: the Mineur–Farin configuration.
fn spiral(degree: usize, count: usize, ratio: f64, angle: f64) -> FloatPolygon {
    let mut at = (0.0, 0.0);
    let points = (0..count as i32).map(|index| {
        let (leg, direction) = (ratio.powi(index), angle * f64::from(index));
        let point = at;
        at = (at.0 + leg * direction.cos(), at.1 + leg * direction.sin());
        point
    });
    planar(degree, points)
}

fn mapped(polygon: &FloatPolygon, map: impl Fn(DVec3) -> DVec3) -> FloatPolygon {
    let vertices = polygon.vertices().iter().map(|vertex| map(*vertex));
    let weights = polygon.weights().map(<[f64]>::to_vec);
    let periodic = polygon.is_periodic();
    FloatPolygon::new(polygon.degree(), vertices.collect(), weights, periodic).expect("valid")
}

/// The fairness by Simpson's rule with many steps, and the slope by Taylor arithmetic.
fn by_simpson(polygon: &FloatPolygon) -> [f64; 3] {
    const STEPS: usize = 1200;
    let mut sums = [0.0; 3];
    for segment in 0..polygon.segments() {
        for step in 0..=STEPS {
            let t = step as f64 / STEPS as f64;
            let factor = match step {
                0 | STEPS => 1.0,
                step if step % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let levels = polygon.segment_curvature_levels(segment, t, 1.0);
            let weight = factor / (3.0 * STEPS as f64) * polygon.segment_jet(segment, t).speed();
            sums[0] += weight;
            sums[1] += weight * levels.curvature[0].powi(2);
            sums[2] += weight * levels.curvature_slopes[0].powi(2);
        }
    }
    let length = sums[0];
    [length, sums[1] * length, sums[2] * length.powi(3)]
}

#[test]
fn a_round_polygon_has_the_bending_energy_of_a_circle() {
    let circle = regular_polygon(9, 12, 10.0).expect("a valid arc");
    let circle = FloatPolygon::new(
        9,
        regular(12, 10.0),
        circle.weights().map(<[f64]>::to_vec),
        true,
    )
    .expect("a valid polygon");
    let fairness = harmony(&circle).fairness;
    // κ varies by 1.3e-8 of itself.
    assert_near(
        "energy",
        fairness.bending_energy.expect("it settles"),
        TAU * TAU,
        1e-7,
        TAU * TAU,
    );
    let variation = fairness.variation.expect("it settles");
    assert!((0.0..=1e-9).contains(&variation), "{variation}");
}

/// The vertices of a regular polygon.
fn regular(count: usize, radius: f64) -> Vec<DVec3> {
    let angles = (0..count).map(|index| TAU * index as f64 / count as f64);
    angles
        .map(|angle| radius * DVec3::new(angle.cos(), angle.sin(), 0.0))
        .collect()
}

#[test]
fn fairness_agrees_with_simpsons_rule_and_taylor_arithmetic() {
    let mut random = Random(7);
    for case in 0..48 {
        let (in_space, rational) = (case % 2 == 1, case % 4 >= 2);
        let degree = 3 + case % 7;
        let polygon = random.gentle(degree, degree + 3, in_space, rational);
        let fairness = harmony(&polygon).fairness;
        let [length, bending, variation] = by_simpson(&polygon);
        let what = format!("case {case}, degree {degree}");
        assert_near(&what, fairness.length, length, QUADRATURE, length);
        let found = fairness.bending_energy.expect("it settles");
        assert_near(&what, found, bending, QUADRATURE, bending);
        let found = fairness.variation.expect("it settles");
        assert_near(&what, found, variation, 1e-7, variation);
    }
}

#[test]
fn fairness_is_infinite_at_cusps_and_corners_and_0_on_lines() {
    let cusp = planar(
        3,
        [(-1.0, 1.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (1.0, 1.0)],
    );
    let fairness = harmony(&cusp).fairness;
    assert_eq!((fairness.bending_energy, fairness.variation), (None, None));
    let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 2.0)];
    let polyline = harmony(&planar(1, points)).fairness;
    assert_eq!((polyline.bending_energy, polyline.variation), (None, None));
    // At degree 2 the curvature jumps.
    let parabolas = harmony(&planar(2, points)).fairness;
    assert!(parabolas.bending_energy.is_some_and(|energy| energy > 0.0));
    assert_eq!(parabolas.variation, None);
    let slanted = (0..40).map(|index| (0.1 * f64::from(index), 0.3 * f64::from(index)));
    let line = harmony(&planar(5, slanted)).fairness;
    assert!(
        line.bending_energy.is_some_and(|energy| energy <= 1e-20),
        "{line:?}"
    );
    assert!(
        line.variation.is_some_and(|variation| variation <= 1e-16),
        "{line:?}"
    );
}

#[test]
fn an_ellipse_is_in_harmony_and_a_dent_is_found() {
    // At degree 3 the slope of the curvature jumps, and there are more.
    for (degree, count) in [(4, 16), (5, 24), (8, 40), (9, 60)] {
        let polygon = ellipse(degree, count, 0.6);
        let found = harmony(&polygon);
        let four = EventCounts {
            extrema: 4,
            sign_changes: 0,
        };
        assert_eq!(
            (found.curvature.polygon, found.curvature.curve),
            (four, four)
        );
        assert_eq!(found.curvature.verdict, Match::Agrees, "degree {degree}");
        assert_eq!(found.regularity.irregularity, None, "degree {degree}");
        assert_eq!(found.slopes.len(), 4);
        // Dented too little to bend the curve back at high degrees, but not the polygon.
        let mut dented = polygon.clone();
        let vertex = count / 3;
        dented
            .move_vertices([(vertex, polygon.vertex(vertex) * 0.98)])
            .expect("valid");
        let found = harmony(&dented);
        assert!(found.curvature.polygon.extrema > 4);
        if degree < 8 {
            continue;
        }
        let Match::Differs(Mismatch::OfPolygon { vertex: found, .. }) = found.curvature.verdict
        else {
            panic!("degree {degree}: {:?}", found.curvature);
        };
        assert!(
            found.abs_diff(vertex) <= 2,
            "degree {degree}: {found} instead of {vertex}"
        );
    }
}

#[test]
fn legs_in_geometric_progression_are_in_harmony_but_for_what_the_curve_adds() {
    let found = harmony(&spiral(9, 24, 1.2, 0.3));
    let figures = found.figures;
    for figure in [figures.legs, figures.turns] {
        assert!(
            figure.is_some_and(|figure| figure.value <= 1e-12),
            "{figures:?}"
        );
    }
    assert_eq!((figures.curvature_extrema, figures.sharpest), (0, None));
    assert_eq!(found.curvature.verdict, Match::Agrees);
    assert_eq!((found.regularity.order, found.regularity.highest), (8, 8));
    // κ(u + 1) = κ(u)/1.2: a logarithmic spiral, in steps.
    let [piece] = found.slopes[..] else {
        panic!("one piece: {:?}", found.slopes);
    };
    assert_eq!(piece.u, [0.0, 15.0]);
    assert_near("slope", piece.slope, 1.0, 1e-3, 1.0);
    assert_near("straightness", piece.straightness, 1.0, 1e-3, 1.0);
    // At degree 3 the curvature is not monotone beyond 77° (ratio 2).
    let found = harmony(&spiral(3, 8, 2.0, 1.5));
    assert!(found.curvature.curve.extrema > 0);
    assert!(
        matches!(
            found.curvature.verdict,
            Match::Differs(Mismatch::OfCurve { .. })
        ),
        "{:?}",
        found.curvature
    );
}

#[test]
fn an_s_has_its_inflection_in_the_same_place_in_the_order() {
    // The tangent turns as s³/3 − s: curvature s² − 1, a minimum between two inflections.
    let mut at = (0.0, 0.0);
    let points = (-20..=20).map(|index| {
        let s = 0.1 * f64::from(index);
        let angle = s.powi(3) / 3.0 - s;
        let point = at;
        at = (at.0 + 0.1 * angle.cos(), at.1 + 0.1 * angle.sin());
        point
    });
    let found = harmony(&planar(6, points));
    let counts = EventCounts {
        extrema: 1,
        sign_changes: 2,
    };
    assert_eq!(found.curvature.polygon, counts);
    assert_eq!(found.curvature.verdict, Match::Agrees);
    assert_eq!(found.slopes.len(), 4, "{:?}", found.slopes);
}

#[test]
fn harmony_figures_are_the_worst_of_all_vertices() {
    let mut random = Random(11);
    for case in 0..50 {
        let periodic = case % 2 == 1;
        let count = 12 + case;
        let gentle = random.gentle(4, count, false, false);
        let polygon =
            FloatPolygon::new(4, gentle.vertices().to_vec(), None, periodic).expect("valid");
        let at = |index: usize| polygon.vertex((index + count) % count);
        let leg = |index: usize| at(index).distance(at(index + 1)).ln();
        let turn = |i: usize| turning_angle(at(i + count - 1), at(i), at(i + 1), true);
        let bend = |i: usize| discrete_curvature(at(i + count - 1), at(i), at(i + 1), true);
        let worst = |of: &dyn Fn(usize) -> f64, vertices: std::ops::Range<usize>| {
            let figures = vertices.map(|vertex| VertexFigure {
                value: (of(vertex + count - 1) - 2.0 * of(vertex) + of(vertex + 1)).abs(),
                vertex,
            });
            figures
                .max_by(|a, b| a.value.total_cmp(&b.value))
                .expect("there are vertices")
        };
        let whole = 0..count;
        let [legs, turns, inner] = if periodic {
            [whole.clone(), whole.clone(), whole]
        } else {
            [1..count - 2, 2..count - 2, 2..count - 2]
        };
        let figures = harmony(&polygon).figures;
        for (found, expected) in [
            (figures.legs, worst(&leg, legs)),
            (figures.turns, worst(&turn, turns)),
        ] {
            let found = found.expect("there are vertices");
            assert_eq!(found.vertex, expected.vertex, "case {case}");
            assert_near("figure", found.value, expected.value, 1e-12, 1.0);
        }
        let turns_round = |i: &usize| (bend(*i + count - 1) < bend(*i)) != (bend(*i) < bend(i + 1));
        let extrema: Vec<usize> = inner.filter(turns_round).collect();
        assert_eq!(figures.curvature_extrema, extrema.len(), "case {case}");
        let sharpness = |i: &usize| (bend(*i + count - 1) - 2.0 * bend(*i) + bend(i + 1)).abs();
        let sharpest = extrema
            .into_iter()
            .max_by(|a, b| sharpness(a).total_cmp(&sharpness(b)));
        assert_eq!(
            figures.sharpest.map(|figure| figure.vertex),
            sharpest,
            "case {case}"
        );
    }
}

#[test]
fn a_leg_without_length_is_the_worst_of_all() {
    let doubled = planar(
        3,
        [
            (0.0, 0.0),
            (1.0, 0.0),
            (2.0, 0.5),
            (2.0, 0.5),
            (3.0, 2.0),
            (3.0, 4.0),
        ],
    );
    let found = harmony(&doubled);
    let expected = VertexFigure {
        value: f64::INFINITY,
        vertex: 1,
    };
    assert_eq!(found.figures.legs, Some(expected));
    assert_eq!(found.regularity.order, 0);
}

#[test]
fn a_polygon_in_space_is_compared_in_curvature_and_torsion() {
    // Curvature and torsion of a conical spiral fall, those of a helix are constant.
    let conical = |index: i32| {
        let angle = 0.4 * f64::from(index);
        DVec3::new(angle.cos(), angle.sin(), 1.0) * angle
    };
    let vertices = (8..40).map(conical).collect();
    let polygon = FloatPolygon::new(7, vertices, None, false).expect("valid");
    let found = harmony(&polygon);
    let none = EventCounts::default();
    let torsion = found.torsion.expect("in space");
    assert_eq!(
        (found.curvature.polygon, found.curvature.curve),
        (none, none)
    );
    assert_eq!((torsion.polygon, torsion.curve), (none, none));
    assert_eq!(
        (found.curvature.verdict, torsion.verdict),
        (Match::Agrees, Match::Agrees)
    );
    // A curve that winds to the right and then to the left: one change of sign.
    let turning = (-15..=15).map(|index| {
        let t = 0.2 * f64::from(index);
        DVec3::new(t, t * t, t.powi(4))
    });
    let polygon = FloatPolygon::new(6, turning.collect(), None, false).expect("valid");
    let torsion = harmony(&polygon).torsion.expect("in space");
    assert_eq!(torsion.polygon.sign_changes, 1);
    assert_eq!(torsion.curve.sign_changes, 1);
    assert_eq!(harmony(&ellipse(4, 20, 0.5)).torsion, None);
}

#[test]
fn harmony_does_not_depend_on_place_size_and_sense() {
    let mut random = Random(3);
    for case in 0..24 {
        let (in_space, rational) = (case % 2 == 1, case % 4 >= 2);
        let gentle = random.gentle(5, 20, in_space, rational);
        // Multiples of 2⁻²⁰, which these motions map without rounding.
        let polygon = mapped(&gentle, |vertex| {
            (vertex * 2.0_f64.powi(20)).round() / 2.0_f64.powi(20)
        });
        let turn = DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z);
        let moved = mapped(&polygon, |vertex| {
            8.0 * (turn * vertex) + DVec3::new(16.0, -3.0, 0.0)
        });
        let [a, b] = [&polygon, &moved].map(harmony);
        assert_eq!(a.curvature.verdict, b.curvature.verdict, "case {case}");
        assert_eq!(
            a.torsion.map(|t| t.verdict),
            b.torsion.map(|t| t.verdict),
            "case {case}"
        );
        assert_eq!(a.regularity, b.regularity, "case {case}");
        assert_eq!(
            a.figures.legs.map(|f| f.vertex),
            b.figures.legs.map(|f| f.vertex)
        );
        let near = |what: &str, a: Option<f64>, b: Option<f64>, tolerance: f64| {
            let (a, b) = (a.expect("it settles"), b.expect("it settles"));
            assert_near(&format!("case {case}: {what}"), b, a, tolerance, a);
        };
        near(
            "bending",
            a.fairness.bending_energy,
            b.fairness.bending_energy,
            QUADRATURE,
        );
        near(
            "variation",
            a.fairness.variation,
            b.fairness.variation,
            1e-8,
        );
        assert_eq!(a.slopes.len(), b.slopes.len());
        for (a, b) in a.slopes.iter().zip(&b.slopes) {
            assert_near("α", b.slope, a.slope, 1e-6, a.slope.abs().max(1.0));
        }
        let reversed = harmony(&polygon.reversed());
        assert_eq!(
            a.curvature.polygon, reversed.curvature.polygon,
            "case {case}"
        );
        assert_eq!(a.curvature.curve, reversed.curvature.curve, "case {case}");
        assert_eq!(
            a.curvature.verdict == Match::Agrees,
            reversed.curvature.verdict == Match::Agrees
        );
        assert_eq!(a.regularity.order, reversed.regularity.order, "case {case}");
        near(
            "reversed",
            a.fairness.variation,
            reversed.fairness.variation,
            1e-8,
        );
    }
}

#[test]
fn the_joint_of_a_periodic_polygon_is_a_vertex_like_others() {
    let polygon = ellipse(5, 24, 0.6);
    let whole = harmony(&polygon);
    for start in 0..24 {
        let mut vertices = polygon.vertices().to_vec();
        vertices.rotate_left(start);
        let found = harmony(&FloatPolygon::new(5, vertices, None, true).expect("valid"));
        assert_eq!(found.curvature, whole.curvature, "start {start}");
        assert_eq!(found.regularity, whole.regularity);
        let [a, b] = [&found, &whole].map(|harmony| harmony.figures.legs.expect("legs").value);
        assert_near("legs", a, b, 1e-12, 1.0);
        let energies = [&found, &whole].map(|harmony| harmony.fairness.bending_energy);
        let [a, b] = energies.map(|energy| energy.expect("it settles"));
        assert_near("energy", a, b, 1e-12, b);
    }
}

#[test]
fn what_is_not_known_of_the_curve_is_left_open() {
    let cusp = planar(
        3,
        [(-1.0, 1.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (1.0, 1.0)],
    );
    let verdict = harmony(&cusp).curvature.verdict;
    let Match::Undecided([low, high]) = verdict else {
        panic!("{verdict:?}");
    };
    assert!(low <= 1.0 && 1.0 <= high, "{low} {high}");
}

#[test]
fn the_papers_arc_has_an_extremum_that_its_polygon_has_not() {
    let arc = regular_polygon(9, 12, 10.0).expect("a valid arc");
    let found = harmony(&arc);
    let Match::Differs(Mismatch::OfCurve { event, u }) = found.curvature.verdict else {
        panic!("{:?}", found.curvature);
    };
    assert_eq!(event, Event::Extremum(ExtremumKind::Maximum));
    assert_near("u", u, 0.5, 1e-12, 1.0);
    assert_eq!(found.curvature.polygon, EventCounts::default());
    let flow = VertexFlow::of(&arc);
    assert_eq!(flow.curvatures.values().len(), 8);
}

#[test]
fn a_curve_in_space_has_no_hand_where_its_vertices_lie_in_the_plane() {
    let points = (0..10).map(|index| {
        let (sine, cosine) = (2.8 - 0.35 * f64::from(index)).sin_cos();
        let height = if index == 1 { 1.0 } else { 0.0 };
        DVec3::new(20.0 * cosine, 20.0 * sine, height)
    });
    let points: Vec<DVec3> = points.collect();
    let mirrored = points.iter().map(|at| DVec3::new(at.x, -at.y, at.z));
    let of = |points| FloatPolygon::new(5, points, None, false).expect("a valid polygon");
    let pair = [points.clone(), mirrored.collect()].map(of);
    let [one, other] = pair.each_ref().map(VertexFlow::of);
    assert_eq!(one.turns, other.turns);
    assert_eq!(one.curvatures, other.curvatures);
    let all = [one.turns.values(), one.curvatures.values()].concat();
    assert!(all.iter().all(|value| *value > 0.0), "{all:?}");
    let [one, other] = pair.each_ref().map(|it| harmony(it).figures);
    assert_eq!(one, other);
}
