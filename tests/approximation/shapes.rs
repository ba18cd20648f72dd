//! Shape equivalence, spacings and tolerances.

use batten::geometry::approximation::{
    Approximated, ApproximationRequest, Goal, LevelFeature, MOST_FOR_SHAPE, MOST_SEGMENTS, Placing,
    Respaced, Spacing, approximate_between, approximate_by_steps, approximate_to_tolerance,
};
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{Differentiable, End, Progress};
use glam::DVec3;

use crate::common::{assert_near, assert_points_near};

const SHAPE: ApproximationRequest = ApproximationRequest {
    degree: 8,
    placing: Placing::Quasi,
    levels: 2,
    periodic: false,
    fit_ends: false,
};

fn curve(text: &str) -> ReferenceCurve {
    ReferenceCurve::from_text(text).expect("a reference")
}

fn goal(tolerance: f64) -> Goal {
    Goal {
        tolerance,
        spacing: None,
        most_segments: MOST_SEGMENTS,
    }
}

/// Which levels are equal: those of the curvature, then those of the torsion.
fn equal(found: &Approximated) -> Vec<(bool, usize, bool)> {
    let levels = found.levels.iter();
    levels
        .map(|it| (it.torsion, it.level, it.is_equal()))
        .collect()
}

#[test]
fn the_paper_s_figure_3_has_its_shape_to_the_levels_that_are_known() {
    let spiral = curve("conical-spiral");
    for placing in [Placing::OnCurve, Placing::Quasi] {
        let asked = ApproximationRequest { placing, ..SHAPE };
        let coarse = approximate_by_steps(&spiral, [0.0, 1.0], 20, &asked).expect("a curve");
        assert_eq!(coarse.interval, [3.5, 15.5]);
        let expected = [
            (false, 1, true),
            (false, 2, true),
            (true, 1, true),
            (true, 2, false),
        ];
        assert_eq!(equal(&coarse), expected, "{placing:?}: {:?}", coarse.levels);
        // One pair of extrema more, near the start.
        let torsion = &coarse.levels[3];
        assert_eq!(torsion.here.len(), torsion.there.len() + 2, "{torsion:?}");
        let fine = approximate_by_steps(&spiral, [0.0, 0.5], 39, &asked).expect("a curve");
        assert!(fine.is_equivalent(), "{placing:?}: {:?}", fine.levels);
    }
}

#[test]
fn levels_that_the_degree_does_not_have_are_left_out() {
    let spiral = curve("conical-spiral:from=2,to=6");
    for (degree, expected) in [
        (2, vec![]),
        (3, vec![(false, 1)]),
        (4, vec![(false, 1), (true, 1)]),
        (5, vec![(false, 1), (false, 2), (true, 1)]),
        (
            10,
            vec![
                (false, 1),
                (false, 2),
                (false, 3),
                (false, 4),
                (true, 1),
                (true, 2),
                (true, 3),
                (true, 4),
            ],
        ),
    ] {
        let asked = ApproximationRequest {
            degree,
            levels: 9,
            ..SHAPE
        };
        let found = approximate_between(&spiral, [2.0, 6.0], 24, Spacing::Parameter, &asked);
        let found = found.expect("a curve").levels;
        let found: Vec<(bool, usize)> = found.iter().map(|it| (it.torsion, it.level)).collect();
        assert_eq!(found, expected, "degree {degree}");
    }
}

#[test]
fn an_ellipse_has_its_four_extrema() {
    use LevelFeature::{Maximum, Minimum};
    let ellipse = curve("ellipse:a=3,b=1");
    let asked = ApproximationRequest {
        degree: 7,
        levels: 1,
        ..SHAPE
    };
    let found = approximate_between(&ellipse, [0.5, 6.5], 60, Spacing::Parameter, &asked);
    let found = found.expect("a curve");
    let there: Vec<LevelFeature> = found.levels[0].there.iter().map(|it| it.1).collect();
    assert_eq!(there, [Minimum, Maximum, Minimum, Maximum]);
    assert!(found.is_equivalent(), "{:?}", found.levels);
}

#[test]
fn arc_length_as_parameter_has_speed_1() {
    // The length of the parabola y = t²/2 from 0 to t is (t √(1 + t²) + asinh t)/2.
    let parabola = curve("parabola:focus=0.5,from=0,to=3");
    let length = |t: f64| 0.5 * (t * (1.0 + t * t).sqrt() + t.asinh());
    let respaced = Respaced::new(&parabola, [0.0, 3.0], Spacing::ArcLength).expect("a curve");
    let whole = length(3.0);
    for index in 0..=10 {
        let v = f64::from(index) / 10.0;
        let t = respaced.parameter(v);
        assert_near("length", length(t), v * whole, 1e-13, whole);
        assert_near("near", respaced.near(v), t, 1e-3, 3.0);
        let values = respaced.derivatives(v, 6);
        assert_points_near(
            "point",
            values[0],
            DVec3::new(t, 0.5 * t * t, 0.0),
            1e-13,
            1.0,
        );
        assert_near("speed", values[1].length(), whole, 1e-13, whole);
        // C′ · C″ = 0, C′ · C‴ = −|C″|².
        assert_near(
            "second",
            values[1].dot(values[2]),
            0.0,
            1e-12,
            whole.powi(3),
        );
        let third = values[1].dot(values[3]) + values[2].length_squared();
        assert_near("third", third, 0.0, 1e-11, whole.powi(4));
        let fourth = values[1].dot(values[4]) + 3.0 * values[2].dot(values[3]);
        assert_near("fourth", fourth, 0.0, 1e-10, whole.powi(5));
    }
}

#[test]
fn arc_length_goes_on_beyond_the_part_as_far_as_the_curve() {
    // The length of Nielsen's spiral from t = 1/2 on is ln 2t.
    let spiral = curve("nielsen-spiral");
    let respaced = Respaced::new(&spiral, [0.5, 10.0], Spacing::ArcLength).expect("a curve");
    for index in -25..=31 {
        let v = f64::from(index) / 10.0;
        let t = 0.5 * 20.0_f64.powf(v);
        assert_near("parameter", respaced.parameter(v), t, 1e-12, t);
    }
    // It is known to t = 2000 π.
    assert!(respaced.parameter(4.0).is_nan());
    let superspiral = curve("superspiral");
    let respaced = Respaced::new(&superspiral, [0.0, 6.0], Spacing::Curvature).expect("a curve");
    assert!(respaced.parameter(-20.0).is_nan());
}

/// With few segments vertices by arc length belong far outside of the part.
#[test]
fn tolerances_are_reached_by_arc_length_where_it_grows_by_the_logarithm() {
    let spiral = curve("nielsen-spiral");
    let asked = ApproximationRequest {
        degree: 6,
        levels: 0,
        ..SHAPE
    };
    let goal = Goal {
        spacing: Some(Spacing::ArcLength),
        ..goal(1e-4)
    };
    let found = approximate_to_tolerance(&spiral, [0.5, 2.0], &goal, &asked, &Progress::default());
    let found = found.expect("a curve");
    assert!(
        found.meets(1e-4) && found.polygon.segments() < 20,
        "{found:?}"
    );
}

#[test]
fn spacing_by_curvature_is_finer_where_the_curve_bends() {
    let ellipse = curve("ellipse:a=5,b=1");
    let respaced = Respaced::new(&ellipse, [0.0, 3.0], Spacing::Curvature).expect("a curve");
    // The ellipse bends most at t = 0.
    let step = |v: f64| {
        let [from, to] = [v, v + 0.01].map(|v| ellipse.derivatives(respaced.parameter(v), 0)[0]);
        from.distance(to)
    };
    assert!(3.0 * step(0.0) < step(0.5), "{} {}", step(0.0), step(0.5));
    let asked = ApproximationRequest {
        degree: 6,
        levels: 0,
        ..SHAPE
    };
    let by = |spacing| {
        let found = approximate_between(&ellipse, [0.0, 3.0], 20, spacing, &asked);
        found.expect("a curve").deviation.largest
    };
    assert!(by(Spacing::Curvature) < 0.1 * by(Spacing::ArcLength));
}

#[test]
fn a_tolerance_and_the_shape_are_reached_by_as_few_vertices_as_it_takes() {
    for (text, tolerance) in [
        ("conical-spiral:from=1,to=12", 1e-5),
        ("clothoid:from=-2,to=2", 1e-6),
        ("log-aesthetic:alpha=-1,lambda=0.5,to=1.5", 1e-8),
        ("catenary:a=2,from=-3,to=3", 1e-4),
        ("formula:x=t;y=sin(t);from=0.1;to=9", 1e-5),
    ] {
        let curve = curve(text);
        let (progress, asked) = (Progress::default(), SHAPE);
        let interval = curve.interval();
        let found = approximate_to_tolerance(&curve, interval, &goal(tolerance), &asked, &progress)
            .expect("a curve");
        assert!(found.meets(tolerance), "{text}: {found:?}");
        let count = found.polygon.vertices().len();
        assert!(count < 120, "{text}: {count} vertices");
        for spacing in [Spacing::Parameter, Spacing::ArcLength, Spacing::Curvature] {
            if count > asked.degree + 1 {
                let fewer = approximate_between(&curve, interval, count - 1, spacing, &asked);
                assert!(!fewer.is_ok_and(|fewer| fewer.meets(tolerance)), "{text}");
            }
        }
    }
}

/// The ripple of a cubic near a helix is h²κ/8 high, h the step by the angle: it fades below 1e-5 of κ from about
/// 1400 segments on, whatever deviation is asked for.
#[test]
fn what_a_small_tolerance_reaches_a_larger_one_does_too() {
    let helix = curve("helix:to=2*pi");
    let asked = ApproximationRequest {
        degree: 3,
        levels: 1,
        ..SHAPE
    };
    let counts = [1e-3, 1e-6].map(|tolerance| {
        let goal = Goal {
            spacing: Some(Spacing::Parameter),
            ..goal(tolerance)
        };
        let progress = Progress::default();
        let found = approximate_to_tolerance(&helix, helix.interval(), &goal, &asked, &progress);
        let found = found.expect("a curve");
        assert!(found.meets(tolerance), "{tolerance}: {:?}", found.levels);
        found.polygon.segments()
    });
    // Counts above 128 are as few as it takes to 1 %.
    assert_near(
        "segments",
        counts[0] as f64,
        counts[1] as f64,
        0.01,
        counts[1] as f64,
    );
    let step = std::f64::consts::TAU / counts[0] as f64;
    assert_near("ripple", step * step / 8.0, 1e-5, 0.04, 1e-5);
}

#[test]
fn of_shapes_that_are_missed_the_one_with_most_equal_levels_and_fewest_vertices_counts() {
    let spiral = curve("archimedean-spiral:to=2*pi");
    let asked = ApproximationRequest { degree: 5, ..SHAPE };
    let goal = Goal {
        most_segments: 96,
        ..goal(1e-4)
    };
    let progress = Progress::default();
    let found = approximate_to_tolerance(&spiral, spiral.interval(), &goal, &asked, &progress);
    let found = found.expect("a curve");
    assert_eq!(equal(&found), [(false, 1, true), (false, 2, false)]);
    assert!(found.distance() <= 1e-4 && !found.meets(1e-4));
    // Far fewer than were tried.
    assert!(
        found.polygon.segments() < 48,
        "{}",
        found.polygon.segments()
    );
    assert!(MOST_FOR_SHAPE > goal.most_segments);
}

#[test]
fn ends_are_exact_if_asked() {
    let spiral = curve("conical-spiral");
    for placing in [Placing::OnCurve, Placing::Quasi] {
        let asked = ApproximationRequest {
            placing,
            fit_ends: true,
            ..SHAPE
        };
        let found = approximate_by_steps(&spiral, [0.0, 1.0], 20, &asked).expect("a curve");
        assert!(
            found
                .end_errors
                .is_some_and(|errors| errors.into_iter().all(|error| error < 1e-12)),
            "{:?}",
            found.end_errors
        );
        for (end, t) in [End::Start, End::Finish].into_iter().zip(found.interval) {
            let direction = spiral.derivatives(t, 1)[1].normalize();
            let jet = found.polygon.end_jet(end);
            assert_points_near("direction", jet.first.normalize(), direction, 1e-12, 1.0);
        }
    }
}
