//! Periodic curves, approximated by periodic float polygons.

use std::f64::consts::TAU;

use batten::geometry::approximation::{
    Approximated, ApproximationError, ApproximationRequest, Goal, LevelFeature, MOST_SEGMENTS,
    Placing, Spacing, approximate_between, approximate_to_tolerance,
};
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{FloatPolygon, Progress};

use crate::common::assert_points_near;

const ASKED: ApproximationRequest = ApproximationRequest {
    degree: 5,
    placing: Placing::Quasi,
    levels: 1,
    periodic: true,
    fit_ends: false,
};

const SPACINGS: [Spacing; 3] = [Spacing::Parameter, Spacing::ArcLength, Spacing::Curvature];

/// A smooth oval of degree 9.
fn oval() -> FloatPolygon {
    let point = |index: i32| {
        let angle = TAU * f64::from(index) / 12.0;
        (30.0 * angle.cos(), 20.0 * angle.sin())
    };
    let open = FloatPolygon::planar(9, &(0..12).map(point).collect::<Vec<_>>()).expect("12");
    FloatPolygon::new(9, open.vertices().to_vec(), None, true).expect("a polygon")
}

fn around(oval: &FloatPolygon, from: f64, count: usize, spacing: Spacing) -> Approximated {
    let found = approximate_between(oval, [from, from + 12.0], count, spacing, &ASKED);
    found.expect("a curve")
}

#[test]
fn they_stay_periodic_and_begin_where_they_are_asked_to() {
    let oval = oval();
    for spacing in SPACINGS {
        for from in [0.0, 3.3, -5.0] {
            let found = around(&oval, from, 40, spacing);
            assert!(found.polygon.is_periodic());
            assert_eq!(found.polygon.vertices().len(), 40);
            assert_eq!(found.end_errors, None);
            assert!(
                found.deviation.largest < 1e-3,
                "{spacing:?} {:?}",
                found.deviation
            );
            let begin = found.polygon.point(0.0);
            assert_points_near("begin", begin, oval.point(from), 1e-4, 30.0);
        }
    }
}

#[test]
fn the_error_is_of_order_degree_plus_1() {
    let oval = oval();
    for spacing in SPACINGS {
        let [coarse, fine] =
            [96, 192].map(|count| around(&oval, 0.0, count, spacing).deviation.largest);
        let order = (coarse / fine).log2();
        assert!((5.8..6.2).contains(&order), "{spacing:?}: {order}");
    }
}

#[test]
fn vertices_on_the_curve_are_its_points() {
    let asked = ApproximationRequest {
        placing: Placing::OnCurve,
        ..ASKED
    };
    let oval = oval();
    let found = approximate_between(&oval, [0.0, 12.0], 24, Spacing::Parameter, &asked);
    let found = found.expect("a curve");
    for (index, vertex) in found.polygon.vertices().iter().enumerate() {
        let t = 0.5 * (index as f64 - 2.0);
        assert_points_near("vertex", *vertex, oval.point(t), 1e-15, 30.0);
    }
}

#[test]
fn extrema_at_the_seam_count_on_both() {
    // The curvature of the oval has its maxima at multiples of half the period, one of them at the seam.
    use LevelFeature::{Maximum, Minimum};
    let oval = oval();
    for from in [4.0, 4.0 - 1e-9, 4.0 + 1e-9, 5.5] {
        let found = around(&oval, from, 60, Spacing::Parameter);
        let level = &found.levels[0];
        assert!(level.is_equal(), "{from}: {level:?}");
        let kinds = level.there.iter().map(|it| it.1);
        assert_eq!(kinds.clone().filter(|kind| *kind == Maximum).count(), 2);
        assert_eq!(kinds.filter(|kind| *kind == Minimum).count(), 2);
    }
}

#[test]
fn a_tolerance_is_reached_by_as_few_vertices_as_it_takes() {
    let (oval, progress) = (oval(), Progress::default());
    let goal = Goal {
        tolerance: 1e-6,
        spacing: None,
        most_segments: MOST_SEGMENTS,
    };
    let found = approximate_to_tolerance(&oval, [0.0, 12.0], &goal, &ASKED, &progress);
    let found = found.expect("a curve");
    assert!(found.meets(1e-6) && found.polygon.is_periodic());
    let count = found.polygon.vertices().len();
    for spacing in SPACINGS {
        let fewer = around(&oval, 0.0, count - 1, spacing);
        assert!(!fewer.meets(1e-6), "{count}, {spacing:?}");
    }
}

#[test]
fn without_ends_none_are_made_exact() {
    let asked = ApproximationRequest {
        fit_ends: true,
        ..ASKED
    };
    let oval = oval();
    let refused = approximate_between(&oval, [0.0, 12.0], 40, Spacing::Parameter, &asked);
    assert_eq!(refused, Err(ApproximationError::NoEnds));
}

#[test]
fn ripples_on_a_curvature_that_is_constant_do_not_count() {
    // The curvature of such a curve beside a circle varies by less than 1e-5 of itself.
    let circle = ReferenceCurve::from_text("circle:radius=10").expect("a reference");
    let asked = ApproximationRequest {
        degree: 9,
        levels: 2,
        periodic: false,
        ..ASKED
    };
    let near = |count: usize| {
        let found = approximate_between(&circle, [0.0, 6.0], count, Spacing::Parameter, &asked);
        found.expect("a curve")
    };
    assert!(near(30).is_equivalent(), "{:?}", near(30).levels);
    assert!(!near(12).is_equivalent(), "{:?}", near(12).levels);
    let least = near(30).levels[0].least;
    assert!((least - 1e-6).abs() < 1e-15, "{least}");
}

#[test]
fn corrections_that_grow_are_noticed() {
    let circle = ReferenceCurve::from_text("circle").expect("a reference");
    let asked = ApproximationRequest {
        degree: 15,
        periodic: false,
        ..ASKED
    };
    let growth = |count: usize| {
        let found = approximate_between(&circle, [0.0, 6.0], count, Spacing::Parameter, &asked);
        found
            .expect("a curve")
            .corrections
            .expect("a high degree")
            .growth
    };
    // On a circle the last of the corrections over the first is a_7 h^12 / a_1 with h = 6 / segments.
    assert!(growth(16) > 1.0, "{}", growth(16));
    assert!(growth(40) < 1e-6, "{}", growth(40));
}
