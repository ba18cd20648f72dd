//! Curves that are no polygons are sampled, plotted, drawn and hit by the same code.

use std::f64::consts::{PI, TAU};

use batten::analysis::{CurveSamples, LevelPlot, LevelSeries, SampledCurve};
use batten::editor::{CombSettings, CurveOutlines, Orientation, ViewBox};
use batten::geometry::{EvenBatch, FloatPolygon, LEVELS, ParametricCurve};
use glam::{DVec2, DVec3};

/// Roundings of a handful of operations on numbers of the size of the curve.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Simpson's rule on a step of a circle, of which there are 2048: the step to the fourth power over
/// 180 is below this.
const QUADRATURE: f64 = 1e-13;

/// A circle about a centre, in as many pieces as one likes.
struct Circle {
    centre: DVec3,
    radius: f64,
    pieces: usize,
}

impl ParametricCurve for Circle {
    fn pieces(&self) -> usize {
        self.pieces
    }

    fn is_periodic(&self) -> bool {
        true
    }

    fn is_planar(&self) -> bool {
        self.centre.z == 0.0
    }

    fn continuity(&self) -> usize {
        usize::MAX
    }

    fn fill_derivatives(&self, piece: usize, t: f64, values: &mut [DVec3]) {
        assert!(piece < self.pieces);
        let rate = TAU / self.pieces as f64;
        let angle = rate * (piece as f64 + t);
        let mut factor = self.radius;
        for (order, value) in values.iter_mut().enumerate() {
            let turned = angle + 0.5 * PI * order as f64;
            *value = factor * DVec3::new(turned.cos(), turned.sin(), 0.0);
            factor *= rate;
        }
        if let Some(point) = values.first_mut() {
            *point += self.centre;
        }
    }
}

/// A straight line from one point to another.
struct Line([DVec3; 2]);

impl ParametricCurve for Line {
    fn pieces(&self) -> usize {
        1
    }

    fn is_periodic(&self) -> bool {
        false
    }

    fn is_planar(&self) -> bool {
        self.0.iter().all(|end| end.z == 0.0)
    }

    fn continuity(&self) -> usize {
        usize::MAX
    }

    fn fill_derivatives(&self, _: usize, t: f64, values: &mut [DVec3]) {
        let [start, finish] = self.0;
        for (order, value) in values.iter_mut().enumerate() {
            *value = match order {
                0 => start + t * (finish - start),
                1 => finish - start,
                _ => DVec3::ZERO,
            };
        }
    }
}

/// A float polygon that has nothing but what every parametric curve must have.
struct Plain<'a>(&'a FloatPolygon);

impl ParametricCurve for Plain<'_> {
    fn pieces(&self) -> usize {
        ParametricCurve::pieces(self.0)
    }

    fn is_periodic(&self) -> bool {
        self.0.is_periodic()
    }

    fn is_planar(&self) -> bool {
        self.0.is_planar()
    }

    fn continuity(&self) -> usize {
        ParametricCurve::continuity(self.0)
    }

    fn fill_derivatives(&self, piece: usize, t: f64, values: &mut [DVec3]) {
        self.0.fill_derivatives(piece, t, values);
    }
}

const VIEW: ViewBox = ViewBox {
    low: DVec2::new(-100.0, -100.0),
    high: DVec2::new(100.0, 100.0),
    pixel: 0.05,
};

fn circle() -> Circle {
    Circle {
        centre: DVec3::new(3.0, -2.0, 0.0),
        radius: 5.0,
        pieces: 3,
    }
}

/// Give a curve with its samples and outlines to a check.
fn analysed(
    curve: &dyn ParametricCurve,
    eye: Orientation,
    check: impl Fn(SampledCurve<'_>, &mut CurveOutlines),
) {
    let samples = CurveSamples::new(curve);
    let sampled = SampledCurve {
        curve,
        samples: &samples,
    };
    let mut outlines = CurveOutlines::default();
    outlines.update(sampled, eye);
    check(sampled, &mut outlines);
}

#[test]
fn a_circle_has_its_length_curvature_and_levels() {
    let curve = circle();
    analysed(&curve, Orientation::XY, |sampled, _| {
        let (samples, length) = (sampled.samples, TAU * curve.radius);
        assert!((samples.length() - length).abs() <= QUADRATURE * length);
        for u in [0.0, 0.4, 1.5, 2.999] {
            let at = sampled.length_at(u);
            assert!((at - u / 3.0 * length).abs() <= QUADRATURE * length, "{u}");
            let back = samples.parameter_at_length(at);
            assert!((back - u).abs() <= 3.0 * QUADRATURE, "{u} {back}");
        }
        let kappa = 1.0 / curve.radius;
        let range = samples.curvature().expect("a range");
        assert!((range.low - kappa).abs() <= ROUNDING && (range.high - kappa).abs() <= ROUNDING);
        let mut points = Vec::new();
        LevelSeries::default().append(sampled, LevelPlot::CURVATURE, false, &mut points);
        assert!(points.len() > 10);
        for point in &points {
            assert!((point.y - kappa).abs() <= ROUNDING, "no gaps: {point}");
        }
        for level in 1..=LEVELS {
            let mut points = Vec::new();
            let plot = LevelPlot::Curvature(level);
            LevelSeries::default().append(sampled, plot, false, &mut points);
            let expected = if level == 1 { kappa } else { 0.0 };
            for point in &points {
                // Each level takes two derivatives more of what rounding has left.
                let rounding = ROUNDING * 30f64.powi(2 * (level as i32 - 1));
                assert!((point.y - expected).abs() <= rounding, "{level}: {point}");
            }
        }
    });
}

#[test]
fn a_circle_is_drawn_and_hit() {
    let curve = circle();
    let centre = curve.centre.truncate();
    analysed(&curve, Orientation::XY, |sampled, outlines| {
        let bounds = outlines.bounds();
        for (found, expected) in [(bounds.low, centre - 5.0), (bounds.high, centre + 5.0)] {
            assert!(found.distance(expected) <= 1e-4, "{found} {expected}");
        }
        let mut chain = Vec::new();
        outlines.append_curve(sampled, &VIEW, &mut chain);
        let rounding = ROUNDING * 10.0;
        let is_on = |point: &DVec2| (point.distance(centre) - 5.0).abs() <= rounding;
        assert!(chain.len() > 100 && chain.iter().all(is_on));
        let mut evolute = Vec::new();
        outlines.append_evolute(sampled, &VIEW, &mut evolute);
        let is_centre = |point: &DVec2| point.distance(centre) <= rounding;
        assert!(!evolute.is_empty() && evolute.iter().all(is_centre));
        let comb = CombSettings {
            scale: 10.0,
            density: 4,
        };
        let mut teeth = Vec::new();
        outlines.append_teeth(sampled, &VIEW, &comb, &mut teeth);
        // The start of a piece is the end of the one before.
        assert_eq!(teeth.len(), 13);
        for [foot, tip] in teeth {
            assert!(is_on(&foot));
            assert!((tip.distance(centre) - 7.0).abs() <= rounding);
        }
        for degrees in [0.0, 10.0, 123.0, 359.0] {
            let direction = DVec2::from_angle(f64::to_radians(degrees));
            let (u, point, distance) = outlines
                .nearest(sampled, centre + 5.5 * direction, 1.0)
                .expect("a hit");
            assert!(
                (u - degrees / 120.0).abs() <= ROUNDING * 3.0,
                "{degrees}: {u}"
            );
            assert!(point.distance(centre + 5.0 * direction) <= rounding);
            assert!((distance - 0.5).abs() <= rounding);
        }
        assert_eq!(outlines.nearest(sampled, centre, 1.0), None);
    });
}

#[test]
fn a_line_in_space_is_hit_where_it_is_seen() {
    let line = Line([DVec3::new(0.0, 0.0, 0.0), DVec3::new(3.0, 4.0, 12.0)]);
    analysed(&line, Orientation::XZ, |sampled, outlines| {
        assert!((sampled.samples.length() - 13.0).abs() <= ROUNDING * 13.0);
        // x and z are seen, so y makes no difference.
        let normal = DVec2::new(12.0, -3.0).normalize();
        let target = DVec2::new(1.0, 4.0) + 0.25 * normal;
        let (u, point, distance) = outlines.nearest(sampled, target, 1.0).expect("a hit");
        assert!((u - 1.0 / 3.0).abs() <= ROUNDING);
        assert!(point.distance(DVec2::new(1.0, 4.0)) <= ROUNDING * 13.0);
        assert!((distance - 0.25).abs() <= ROUNDING * 13.0);
        let mut points = Vec::new();
        LevelSeries::default().append(sampled, LevelPlot::CURVATURE, false, &mut points);
        assert!(!points.is_empty() && points.iter().all(|point| point.y == 0.0));
    });
}

#[test]
fn the_batches_of_float_polygons_are_what_any_curve_computes() {
    let points = (0..12).map(|i| {
        let i = f64::from(i);
        DVec3::new(i, (1.3 * i).sin(), (0.7 * i).cos())
    });
    let vertices: Vec<_> = points.collect();
    let weights = (0..12).map(|i| 1.0 + 0.2 * f64::from(i % 3)).collect();
    for (degree, weights, periodic) in [
        (3, None, false),
        (5, Some(weights), false),
        (4, None, true),
        (1, None, false),
    ] {
        let polygon = FloatPolygon::new(degree, vertices.clone(), weights, periodic)
            .expect("a valid polygon");
        let plain = Plain(&polygon);
        let (mut quick, mut slow) = (EvenBatch::new(8), EvenBatch::new(8));
        for piece in 0..polygon.segments() {
            polygon.fill_batch(piece, 3, &mut quick);
            plain.fill_batch(piece, 3, &mut slow);
            for index in 0..=8 {
                let (a, b) = (quick.jet(index), slow.jet(index));
                let single = plain.piece_jet(piece, index as f64 / 8.0);
                assert_eq!(b, single);
                for (a, b) in [
                    (a.point, b.point),
                    (a.first, b.first),
                    (a.second, b.second),
                    (a.third, b.third),
                ] {
                    assert!(a.distance(b) <= 8.0 * ROUNDING * 12.0, "{degree}: {a} {b}");
                }
            }
            let parameters = [0.0, 0.3, 1.0];
            let quick = polygon.levels(piece, &parameters, 1.0, false);
            let slow = plain.levels(piece, &parameters, 1.0, false);
            for (a, b) in quick.iter().zip(&slow) {
                let (a, b) = (a.curvature[0], b.curvature[0]);
                assert!(
                    (a - b).abs() <= 64.0 * ROUNDING * a.abs().max(1.0),
                    "{a} {b}"
                );
            }
        }
    }
}

#[test]
fn a_batch_forgets_what_it_held() {
    let mut batch = EvenBatch::new(4);
    let line = Line([DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)]);
    let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]).expect("valid");
    circle().fill_batch(0, 3, &mut batch);
    line.fill_batch(0, 1, &mut batch);
    let jet = batch.jet(4);
    assert_eq!((jet.point.z, jet.first.z), (3.0, 3.0));
    assert_eq!((jet.second, jet.third), (DVec3::ZERO, DVec3::ZERO));
    polygon.fill_batch(0, 1, &mut batch);
    let jet = batch.jet(4);
    assert_eq!((jet.point, jet.first.z), (DVec3::new(1.0, 0.5, 0.0), 0.0));
    assert_eq!(jet.second, DVec3::ZERO);
}

#[test]
fn parameters_are_located_in_periodic_and_open_curves() {
    let curve = circle();
    assert_eq!(curve.locate(3.25), (0, 0.25));
    assert_eq!(curve.locate(-0.25), (2, 0.75));
    let line = Line([DVec3::ZERO, DVec3::X]);
    assert_eq!(line.locate(1.0), (0, 1.0));
    assert_eq!(line.locate(-0.5), (0, -0.5));
    assert_eq!(line.jet(0.25).point, 0.25 * DVec3::X);
}
