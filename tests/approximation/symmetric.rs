//! Fits that are their own mirror images.

use batten::geometry::features::{Feature, Features};
use batten::geometry::fitting::{Extrema, FitError, Fitted, PlaneFit, SymmetryAxis, fit_plane};
use batten::geometry::{End, Progress};
use glam::DVec2;

/// The NACA 0012 section around its leading edge, its lower side with `count` points and `off` as a share of itself
/// away from the upper one.
fn section(count: usize, off: f64) -> Vec<DVec2> {
    let place = |index: usize, count: usize| {
        let x = 0.5 + 0.5 * (std::f64::consts::PI * index as f64 / (count - 1) as f64).cos();
        let even = [0.2969 * x.sqrt(), -0.126 * x, -0.3516 * x * x];
        let odd = [0.2843 * x.powi(3), -0.1015 * x.powi(4)];
        (x, 0.6 * even.into_iter().chain(odd).sum::<f64>())
    };
    let upper = (0..31).map(|index| place(index, 31)).map(DVec2::from);
    let lower = (0..count - 1).rev().map(|index| place(index, count));
    let lower = lower.map(|(x, y)| DVec2::new(x, -y * (1.0 + off * (40.0 * x).sin())));
    upper.chain(lower).collect()
}

fn fitted(points: &[DVec2], asked: PlaneFit) -> Result<Fitted, FitError> {
    let asked = PlaneFit { degree: 5, ..asked };
    fit_plane(points, &asked, &Progress::default())
}

/// Check that a fit is its own image, bit for bit.
fn check_image(found: &Fitted, mirror: SymmetryAxis, what: &str) {
    let vertices = found.polygon.vertices();
    for (vertex, other) in vertices.iter().zip(vertices.iter().rev()) {
        let image = match mirror {
            SymmetryAxis::X => [other.x, -other.y],
            SymmetryAxis::Y => [-other.x, other.y],
        };
        assert_eq!([vertex.x, vertex.y], image, "{what}");
    }
}

#[test]
fn a_symmetric_fit_is_its_own_image_with_odd_and_even_numbers_of_vertices() {
    for count in [14, 15] {
        let points = section(31, 0.0);
        let asked = PlaneFit {
            mirror: Some(SymmetryAxis::X),
            count: Some(count),
            extrema: Extrema::Exactly(1),
            ..PlaneFit::default()
        };
        let found = fitted(&points, asked).expect("a fit");
        check_image(&found, SymmetryAxis::X, &count.to_string());
        let features = Features::proved(&found.polygon, |_| true).expect("features");
        assert!(found.holds && features.count(Feature::CurvatureExtremum) == 1);
        assert!(found.deviation < 2e-3, "{count}: {}", found.deviation);
    }
}

#[test]
fn points_that_are_not_quite_images_are_met_in_the_middle() {
    // The sides differ in number and by 2 %, along the other axis, and the fewest extrema are an odd number.
    let turned: Vec<DVec2> = section(24, 0.02).iter().map(|it| it.perp()).collect();
    let asked = PlaneFit {
        mirror: Some(SymmetryAxis::Y),
        tolerance: Some(2e-3),
        ..PlaneFit::default()
    };
    let found = fitted(&turned, asked).expect("a fit");
    check_image(&found, SymmetryAxis::Y, "turned");
    assert!(
        found.deviation < 2e-3 && found.extrema % 2 == 1,
        "{found:?}"
    );
    assert!(found.trade_off.iter().all(|it| it.extrema % 2 == 1));
}

#[test]
fn ends_of_a_symmetric_fit_are_images_too() {
    let points = section(31, 0.0);
    let direction = DVec2::new(-1.0, 0.15).normalize();
    let asked = PlaneFit {
        mirror: Some(SymmetryAxis::X),
        extrema: Extrema::Exactly(3),
        exact_ends: [true, true],
        directions: [Some(direction), None],
        ..PlaneFit::default()
    };
    let found = fitted(&points, asked).expect("a fit");
    check_image(&found, SymmetryAxis::X, "ends");
    let [start, end] = [End::Start, End::Finish].map(|end| found.polygon.end_jet(end));
    assert!(start.point.truncate().distance(points[0]) < 1e-9);
    assert!(end.point.truncate().distance(points[60]) < 1e-9);
    let tangent = start.tangent().expect("a tangent").truncate();
    assert!(tangent.distance(direction) < 1e-9 && found.holds);
}
