//! B-splines on any knots: evaluation, bounds, and the float polygons of those that have one.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use batten::geometry::references::{Nurbs, NurbsError, ReferenceCurve, ReferenceForm};
use batten::geometry::{
    BezierPolygon, ClampedPolygon, Differentiable, FloatPolygon, ParametricCurve,
};
use glam::DVec3;

/// Roundings, in units of the size.
const ROUNDING: f64 = 1e-13;

fn flat(points: &[[f64; 2]]) -> Vec<DVec3> {
    points
        .iter()
        .map(|[x, y]| DVec3::new(*x, *y, 0.0))
        .collect()
}

/// A quarter of a circle after the other, as rational quadratics with double knots.
fn circle() -> Nurbs {
    let s = FRAC_1_SQRT_2;
    let corners = [
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [-1.0, 1.0],
        [-1.0, 0.0],
        [-1.0, -1.0],
        [0.0, -1.0],
        [1.0, -1.0],
        [1.0, 0.0],
    ];
    let weights = vec![1.0, s, 1.0, s, 1.0, s, 1.0, s, 1.0];
    let knots = [
        0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
    ];
    Nurbs::new(2, knots.to_vec(), flat(&corners), Some(weights), false).expect("a circle")
}

fn reference(nurbs: Nurbs) -> ReferenceCurve {
    ReferenceCurve::of(ReferenceForm::Nurbs(nurbs)).expect("a reference")
}

fn wave(degree: usize, count: usize, periodic: bool) -> FloatPolygon {
    let vertices = (0..count).map(|index| {
        let angle = TAU * index as f64 / count as f64;
        let radius = 10.0 + (3.0 * angle).cos();
        DVec3::new(
            radius * angle.cos(),
            radius * angle.sin(),
            (2.0 * angle).sin(),
        )
    });
    FloatPolygon::new(degree, vertices.collect(), None, periodic).expect("a polygon")
}

fn even_knots(count: usize, degree: usize) -> Vec<f64> {
    (0..=count + degree)
        .map(|knot| knot as f64 - degree as f64)
        .collect()
}

#[test]
fn a_circle_of_rational_arcs_is_one_at_every_place() {
    let curve = reference(circle());
    assert_eq!(curve.continuity(), 0);
    let pieces = curve.pieces();
    for step in 0..=400 {
        let u = pieces as f64 * f64::from(step) / 400.0;
        let jet = curve.jet(u);
        assert!((jet.point.length() - 1.0).abs() <= ROUNDING, "{u}");
        assert!((jet.signed_curvature() - 1.0).abs() <= 1e-11, "{u}");
        assert!(jet.curvature_slope(true).abs() <= 1e-9, "{u}");
    }
}

#[test]
fn even_knots_give_the_float_polygon_to_the_bit() {
    for degree in 1..=9 {
        let float = wave(degree, degree + 7, false);
        let points = float.vertices().to_vec();
        let knots = even_knots(points.len(), degree);
        let nurbs = Nurbs::new(degree, knots, points, None, false).expect("a curve");
        let found = nurbs.float_polygon().expect("a float polygon");
        assert_eq!(found.polygon, float);
        let curve = reference(nurbs);
        for step in 0..=70 {
            let t = float.segments() as f64 * f64::from(step) / 70.0;
            let at = curve.derivatives(t, 2);
            let jet = float.jet(t);
            assert!(
                at[0].distance(jet.point) <= ROUNDING * float.size(),
                "{degree} {t}"
            );
            assert!(at[1].distance(jet.first) <= 10.0 * ROUNDING * float.size());
        }
    }
}

#[test]
fn clamped_bezier_and_periodic_curves_have_a_float_polygon_others_have_none() {
    for degree in 2..=7 {
        let float = wave(degree, degree + 6, false);
        let clamped = ClampedPolygon::from_float(&float);
        // Files have knots of their own scale.
        let knots: Vec<f64> = clamped
            .knots()
            .iter()
            .map(|knot| 3.0 + 0.37 * knot)
            .collect();
        let nurbs = Nurbs::new(
            degree,
            knots.clone(),
            clamped.vertices().to_vec(),
            None,
            false,
        );
        let found = nurbs.expect("a curve").float_polygon().expect("a polygon");
        let off = found.polygon.deviation(&float).expect("alike");
        assert!(off <= 1e-12 * float.size(), "{degree}: {off:e}");

        let bezier = BezierPolygon::from_float(&float);
        let repeated = (0..=bezier.segments()).flat_map(|knot| vec![knot as f64; degree]);
        let ends = [0.0]
            .into_iter()
            .chain(repeated)
            .chain([bezier.segments() as f64]);
        let nurbs = Nurbs::new(
            degree,
            ends.collect::<Vec<_>>(),
            bezier.vertices().to_vec(),
            None,
            false,
        );
        let found = nurbs.expect("a curve").float_polygon().expect("a polygon");
        let off = found.polygon.deviation(&float).expect("alike");
        assert!(off <= 1e-12 * float.size(), "{degree}: {off:e}");

        let round = wave(degree, degree + 6, true);
        let open = ClampedPolygon::from_float(&round);
        let nurbs = Nurbs::new(degree, open.knots(), open.vertices().to_vec(), None, false);
        let found = nurbs.expect("a curve").float_polygon().expect("a polygon");
        assert!(found.polygon.is_periodic(), "{degree}");
        let off = found.polygon.deviation(&round).expect("alike");
        assert!(off <= 1e-12 * float.size(), "{degree}: {off:e}");

        let mut uneven = knots;
        uneven[degree + 1] += 0.01;
        let nurbs = Nurbs::new(degree, uneven, clamped.vertices().to_vec(), None, false);
        assert!(
            nurbs.expect("a curve").float_polygon().is_none(),
            "{degree}"
        );
    }
}

#[test]
fn the_curvature_jumps_between_pieces_and_each_piece_has_its_own() {
    // A cubic with a double knot: C¹ there.
    let points = flat(&[
        [0.0, 0.0],
        [1.0, 2.0],
        [3.0, 2.0],
        [4.0, 0.0],
        [6.0, -3.0],
        [8.0, 1.0],
    ]);
    let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0];
    let curve = reference(Nurbs::new(3, knots, points, None, false).expect("a curve"));
    assert_eq!(curve.continuity(), 1);
    let joint = (0..curve.pieces()).find(|piece| curve.parameter(*piece as f64) == 1.0);
    let joint = joint.expect("a piece begins at the knot");
    let [before, behind] = [curve.piece_jet(joint - 1, 1.0), curve.piece_jet(joint, 0.0)];
    assert!(before.point.distance(behind.point) <= ROUNDING);
    let jump = behind.signed_curvature() - before.signed_curvature();
    assert!(jump.abs() > 0.01, "{jump}");
}

#[test]
fn what_is_no_curve_is_refused_with_the_place() {
    let points = flat(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [3.0, 1.0]]);
    let new = |degree, knots: &[f64], weights: Option<Vec<f64>>| {
        Nurbs::new(degree, knots.to_vec(), points.clone(), weights, false).map(drop)
    };
    let good = [0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0];
    assert_eq!(new(2, &good, None), Ok(()));
    assert_eq!(new(0, &good, None), Err(NurbsError::Degree(0)));
    assert_eq!(new(26, &good, None), Err(NurbsError::Degree(26)));
    let error = NurbsError::Points {
        found: 4,
        degree: 4,
    };
    assert_eq!(new(4, &good, None), Err(error));
    let error = NurbsError::Knots {
        found: 6,
        needed: 7,
    };
    assert_eq!(new(2, &good[1..], None), Err(error));
    let falling = [0.0, 0.0, 0.0, 0.5, 0.4, 1.0, 1.0];
    assert_eq!(new(2, &falling, None), Err(NurbsError::Knot(4)));
    let infinite = [0.0, 0.0, 0.0, f64::NAN, 1.0, 1.0, 1.0];
    assert_eq!(new(2, &infinite, None), Err(NurbsError::Knot(3)));
    assert_eq!(new(2, &[1.0; 7], None), Err(NurbsError::NoInterval));
    assert_eq!(
        new(1, &[0.0, 0.0, 0.5, 0.5, 1.0, 1.0], None),
        Err(NurbsError::Break(2))
    );
    assert_eq!(
        new(2, &good, Some(vec![1.0, 0.0, 1.0, 1.0])),
        Err(NurbsError::Weight(1))
    );
    assert_eq!(
        new(2, &good, Some(vec![1.0; 3])),
        Err(NurbsError::Weight(3))
    );
}

/// Splines of a degree on uneven knots, some of them multiple, in space.
fn uneven(degree: usize) -> Nurbs {
    let inner = [0.3, 1.0, 1.0, 1.7, 4.0, 4.0, 4.0, 4.2];
    let inner = inner.into_iter().filter(|knot| *knot != 4.0 || degree > 2);
    let knots = [
        vec![0.0; degree + 1],
        inner.collect(),
        vec![5.0; degree + 1],
    ]
    .concat();
    let points = (0..knots.len() - degree - 1).map(|index| {
        let t = index as f64;
        DVec3::new(t, (1.3 * t).sin(), 0.1 * t * t)
    });
    let points: Vec<DVec3> = points.collect();
    Nurbs::new(degree, knots, points, None, false).expect("a spline")
}

#[test]
fn a_chain_of_beziers_is_the_same_curve() {
    for degree in [2, 3, 5, 8] {
        let nurbs = uneven(degree);
        let chain = nurbs.bezier_chain().expect("a chain");
        let inner = &chain.knots()[degree + 1..chain.points().len()];
        let times = |knot: f64| inner.iter().filter(|it| **it == knot).count();
        assert!(inner.iter().all(|knot| times(*knot) == degree), "{inner:?}");
        let [own, other] = [nurbs, chain].map(reference);
        for step in 0..=200 {
            let t = f64::from(step) / 40.0;
            let [point, expected] = [&other, &own].map(|it| it.derivatives(t, 0)[0]);
            assert!(
                point.distance(expected) <= 20.0 * ROUNDING,
                "degree {degree}, t = {t}: {point} for {expected}"
            );
        }
    }
    assert_eq!(circle().bezier_chain(), None, "a rational one has none");
}

#[test]
fn a_glance_at_the_knots_tells_whether_there_is_a_float_polygon() {
    let clamped = |degree: usize, count: usize| {
        let inner = (0..=count - degree).map(|knot| knot as f64);
        let last = (count - degree) as f64;
        let knots = [vec![0.0; degree], inner.collect(), vec![last; degree]].concat();
        let points = wave(degree, count, false).vertices().to_vec();
        Nurbs::new(degree, knots, points, None, false).expect("a spline")
    };
    let chain = |nurbs: &Nurbs| nurbs.bezier_chain().expect("a chain");
    let smooth = [(2, 7), (3, 9), (5, 11)].map(|(degree, count)| clamped(degree, count));
    let chains: Vec<Nurbs> = smooth.iter().map(chain).collect();
    // Corners and jumps of the second derivative at the joints.
    let others = [2, 3, 5, 8].map(uneven);
    let sharp = others.each_ref().map(chain);
    let far = smooth.each_ref().map(|nurbs| {
        let points = nurbs.points().iter().map(|it| *it + 1e6 * DVec3::X);
        let knots = nurbs.knots().to_vec();
        Nurbs::new(
            nurbs.degree(),
            knots,
            points.collect::<Vec<_>>(),
            None,
            false,
        )
        .expect("a spline")
    });
    let all = smooth.iter().chain(&chains).chain(&others).chain(&sharp);
    let all: Vec<&Nurbs> = all.chain(&far).collect();
    let has: Vec<bool> = all.iter().map(|it| it.has_float_polygon()).collect();
    let made: Vec<bool> = all.iter().map(|it| it.float_polygon().is_some()).collect();
    assert_eq!(has, made);
    let expected = [[true; 6].to_vec(), vec![false; 8], vec![true; 3]].concat();
    assert_eq!(has, expected);
    let mut bounds = None;
    smooth[1].widen(&mut bounds, 16);
    let [low, high] = bounds.expect("a box");
    let curve = reference(smooth[1].clone());
    for step in 0..=96 {
        let point = curve.derivatives(f64::from(step) / 16.0, 0)[0];
        let room = DVec3::splat(ROUNDING * 20.0);
        assert!(
            point.cmpge(low - room).all() && point.cmple(high + room).all(),
            "{point}"
        );
    }
}
