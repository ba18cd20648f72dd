//! Fair curves through given points.

use batten::geometry::FloatPolygon;
use glam::DVec3;

use crate::common::Random;

fn through(degree: usize, points: &[DVec3], periodic: bool) -> FloatPolygon {
    FloatPolygon::through_points(degree, points, periodic).expect("a curve")
}

/// How far the points are from the curve at most.
fn off(polygon: &FloatPolygon, points: &[DVec3]) -> f64 {
    let far = points.iter().map(|point| polygon.nearest(*point).distance);
    far.fold(0.0, f64::max)
}

fn size(points: &[DVec3]) -> f64 {
    let far = points
        .iter()
        .flat_map(|a| points.iter().map(|b| a.distance(*b)));
    far.fold(0.0, f64::max)
}

#[test]
fn random_points_are_met_in_their_order() {
    let mut random = Random(3);
    for degree in 1..=9 {
        for periodic in [false, true] {
            for count in [2, 3, 4, 7, 20] {
                if periodic && count < 3.max(if degree == 1 { 2 } else { 3 }) {
                    continue;
                }
                let in_space = count % 2 == 0;
                let points: Vec<DVec3> =
                    (0..count).map(|_| random.vector(10.0, in_space)).collect();
                let polygon = through(degree, &points, periodic);
                let case = format!("degree {degree}, {count} points, periodic {periodic}");
                let most = (10 * count).max(2 * degree + 2);
                assert!(polygon.vertices().len() <= most, "{case}");
                assert!(off(&polygon, &points) < 1e-11 * size(&points), "{case}");
                assert_eq!(polygon.is_planar(), !in_space, "{case}");
                if !periodic {
                    let ends = [0.0, polygon.segments() as f64].map(|u| polygon.point(u));
                    assert!(
                        ends[0].distance(points[0]) < 1e-11 * size(&points),
                        "{case}"
                    );
                    assert!(
                        ends[1].distance(points[count - 1]) < 1e-11 * size(&points),
                        "{case}"
                    );
                }
            }
        }
    }
}

#[test]
fn two_points_make_a_straight_line() {
    let points = [DVec3::new(1.0, 2.0, 0.0), DVec3::new(7.0, -1.0, 0.0)];
    for degree in 1..=9 {
        let polygon = through(degree, &points, false);
        let across = (points[1] - points[0]).normalize();
        for vertex in polygon.vertices() {
            assert!(
                (*vertex - points[0]).cross(across).length() < 1e-9,
                "{degree}"
            );
        }
    }
}

#[test]
fn points_on_a_line_and_on_a_quadratic_give_them_back() {
    // Third differences of a quadratic vanish: no other curve through its points has smaller ones.
    let at = |t: f64| DVec3::new(t, 0.3 * t * t - t, 0.1 * t * t);
    // Points whose chords are as long as their parameters' differences: on a line, unevenly.
    let places = [0.0, 1.0, 2.5, 3.5, 5.0, 7.0];
    let points: Vec<DVec3> = places
        .iter()
        .map(|t| DVec3::new(*t, 0.5 * t, 0.0))
        .collect();
    let polygon = through(5, &points, false);
    let speed = polygon.jet(0.0).first;
    for u in 0..=2 * polygon.segments() {
        let first = polygon.jet(0.5 * u as f64).first;
        assert!(
            first.distance(speed) < 1e-7 * speed.length(),
            "even along the line"
        );
    }
    // Three points: the quadratic through them.
    let points = [at(0.0), at(1.0), at(2.0)];
    let polygon = through(4, &points, false);
    let third = polygon.jet(0.7 * polygon.segments() as f64).third;
    assert!(third.length() < 1e-6 * size(&points), "{third}");
}

#[test]
fn short_chords_beside_long_ones_do_not_ask_for_many_vertices() {
    let xs = [0.0, 1e-4, 10.0, 20.0, 20.001, 30.0];
    let points: Vec<DVec3> = xs.iter().map(|x| DVec3::new(*x, x.sin(), 0.0)).collect();
    let polygon = through(5, &points, false);
    assert!(
        polygon.vertices().len() <= 60,
        "{}",
        polygon.vertices().len()
    );
    assert!(off(&polygon, &points) < 1e-11 * 30.0);
}

/// A short chord at an end, too short for parameters by chord length.
#[test]
fn beside_a_short_chord_the_curve_does_not_hook() {
    let mut random = Random(5);
    for case in 0..200 {
        let degree = 3 + case % 6;
        let short = random.between(0.02, 0.1);
        let (mut at, mut heading) = (DVec3::ZERO, 0.0_f64);
        let points = (0..6).map(|step| {
            let here = at;
            let chord = if step == 0 { short } else { 1.0 } * random.between(8.0, 12.0);
            at += chord * DVec3::new(heading.cos(), heading.sin(), 0.0);
            heading += random.between(-0.6, 0.6);
            here
        });
        let points: Vec<DVec3> = points.collect();
        let polygon = through(degree, &points, false);
        assert!(off(&polygon, &points) < 1e-11 * size(&points));
        let first = points[1] - points[0];
        let angle = polygon.jet(0.0).first.angle_between(first).to_degrees();
        assert!(angle < 30.0, "degree {degree}, chord {short}: {angle}°");
        let steps = 32 * polygon.segments();
        let curvatures = (0..=steps).map(|it| polygon.jet(it as f64 / 32.0).curvature());
        let sharpest = curvatures.fold(0.0, f64::max) * first.length();
        assert!(sharpest < 3.0, "degree {degree}, chord {short}: {sharpest}");
    }
}

#[test]
fn points_of_a_circle_make_nearly_one() {
    for count in [6, 12, 24] {
        let points: Vec<DVec3> = (0..count)
            .map(|index| {
                let angle = std::f64::consts::TAU * f64::from(index) / f64::from(count);
                DVec3::new(angle.cos(), angle.sin(), 0.0)
            })
            .collect();
        let polygon = through(5, &points, true);
        let steps = 8 * polygon.segments();
        let radii = (0..steps).map(|step| polygon.point(f64::from(step as u32) / 8.0).length());
        let off = radii.fold(0.0_f64, |most, radius| most.max((radius - 1.0).abs()));
        assert!(
            off < 0.01 * (6.0 / f64::from(count)).powi(4),
            "{count}: {off}"
        );
    }
}

#[test]
fn too_few_points_are_refused() {
    let two = [DVec3::ZERO, DVec3::X];
    assert!(FloatPolygon::through_points(3, &two[..1], false).is_err());
    assert!(FloatPolygon::through_points(3, &two, true).is_err());
    assert!(FloatPolygon::through_points(26, &two, false).is_err());
    assert!(FloatPolygon::through_points(0, &two, false).is_err());
}
