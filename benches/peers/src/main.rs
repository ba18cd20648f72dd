//! Measures evaluation with three derivatives beside two other libraries, all in one run.
//!
//! The curve is planar, of degree 9 with 200 vertices on uniform knots, evaluated at 16
//! parameters a segment in rising order. Each library is measured in every way it offers, on the
//! whole curve and on its segments cut apart beforehand, and its best way counts. The program
//! first checks that all of them compute the same numbers, and ends with exit code 1 if Batten is
//! less than 20 times faster than either.

use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

use batten::geometry::{Batch, FloatPolygon, Sampler};
use curvo::prelude::NurbsCurve2D;
use glam::DVec3;
use truck_geometry::prelude::{BSplineCurve, KnotVec, ParametricCurve, Point2, Vector2};

const DEGREE: usize = 9;
const VERTICES: usize = 200;
const PARAMETERS: usize = 16;
const SEGMENTS: usize = VERTICES - DEGREE;

/// The ratio asked for.
const WANTED: f64 = 20.0;

/// Rounds measured, of which the fastest and the middle one are shown.
const ROUNDS: usize = 15;

/// The point and three derivatives.
type Jet = [[f64; 2]; 4];

/// What a library computes in one go.
enum Computed<'a> {
    One(Jet),
    Many(&'a Batch),
}

/// One way to evaluate the whole curve, handing on what it computes.
type Way = Box<dyn FnMut(&mut dyn FnMut(Computed))>;

fn one(take: &mut dyn FnMut(Computed), jet: Jet) {
    take(Computed::One(jet));
}

fn main() -> ExitCode {
    let points: Vec<[f64; 2]> = (0..VERTICES)
        .map(|index| {
            let turn = index as f64 / VERTICES as f64 * std::f64::consts::TAU;
            let radius = 10.0 + (7.0 * turn).sin();
            [radius * turn.cos(), radius * turn.sin()]
        })
        .collect();
    let parameters: Vec<f64> = (0..PARAMETERS)
        .map(|index| (index as f64 + 0.5) / PARAMETERS as f64)
        .collect();

    let mut ways: Vec<(&str, Way)> = Vec::new();
    ways.extend(batten_ways(&points, &parameters));
    ways.extend(curvo_ways(&points, &parameters));
    ways.extend(truck_ways(&points, &parameters));

    let expected = collect(&mut ways[0].1);
    for (name, way) in &mut ways {
        let found = collect(way);
        assert_eq!(found.len(), expected.len(), "{name}");
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            let error = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(error <= 1e-9, "{name} is off by {error:e}");
        }
    }

    let mut best: Vec<(&str, f64)> = Vec::new();
    println!("degree {DEGREE}, {VERTICES} vertices, three derivatives: nanoseconds a parameter");
    for (name, way) in &mut ways {
        let (fastest, middle) = measure(way);
        println!("{name:36} {fastest:9.1} fastest {middle:9.1} middle");
        let library = name.split(':').next().unwrap_or(name);
        match best.iter_mut().find(|(other, _)| *other == library) {
            Some((_, time)) => *time = time.min(fastest),
            None => best.push((library, fastest)),
        }
    }
    let own = best[0].1;
    let mut met = true;
    for (library, time) in &best[1..] {
        let ratio = time / own;
        println!("{library}, its best way: {ratio:.0} times as long as batten");
        met &= ratio >= WANTED;
    }
    if met {
        ExitCode::SUCCESS
    } else {
        eprintln!("less than {WANTED} times");
        ExitCode::FAILURE
    }
}

fn from_batch(batch: &Batch, index: usize) -> Jet {
    let jet = batch.jet(index);
    [jet.point, jet.first, jet.second, jet.third].map(|v| [v.x, v.y])
}

fn collect(way: &mut Way) -> Vec<Jet> {
    let mut all = Vec::new();
    way(&mut |computed| match computed {
        Computed::One(jet) => all.push(jet),
        Computed::Many(batch) => all.extend((0..batch.len()).map(|i| from_batch(batch, i))),
    });
    all
}

/// Run one way over the whole curve repeatedly, without looking at the results.
fn measure(way: &mut Way) -> (f64, f64) {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            let mut repeats = 0;
            while repeats < 2 || start.elapsed().as_millis() < 20 {
                way(&mut |computed| match computed {
                    Computed::One(jet) => {
                        black_box(jet);
                    }
                    Computed::Many(batch) => {
                        black_box(batch);
                    }
                });
                repeats += 1;
            }
            start.elapsed().as_secs_f64() * 1e9 / (repeats * SEGMENTS * PARAMETERS) as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    (times[0], times[ROUNDS / 2])
}

fn batten_ways(points: &[[f64; 2]], parameters: &[f64]) -> Vec<(&'static str, Way)> {
    let vertices = points
        .iter()
        .map(|[x, y]| DVec3::new(*x, *y, 0.0))
        .collect();
    let polygon = FloatPolygon::new(DEGREE, vertices, None, false).expect("a valid polygon");
    let sampler = Sampler::new(DEGREE, parameters);
    let (other_polygon, other_sampler) = (polygon.clone(), sampler.clone());
    let [mut batch, mut other_batch] = [Batch::default(), Batch::default()];
    vec![
        (
            "batten: batches",
            Box::new(move |take| {
                for segment in 0..SEGMENTS {
                    sampler.segment(black_box(&polygon), segment, 3, &mut batch);
                    take(Computed::Many(&batch));
                }
            }),
        ),
        (
            "batten: batches, taken apart",
            Box::new(move |take| {
                for segment in 0..SEGMENTS {
                    other_sampler.segment(black_box(&other_polygon), segment, 3, &mut other_batch);
                    for index in 0..PARAMETERS {
                        one(take, from_batch(&other_batch, index));
                    }
                }
            }),
        ),
    ]
}

fn curvo_curve(points: &[[f64; 2]], knots: Vec<f64>) -> NurbsCurve2D<f64> {
    let homogeneous = points
        .iter()
        .map(|[x, y]| nalgebra::Point3::new(*x, *y, 1.0));
    NurbsCurve2D::try_new(DEGREE, homogeneous.collect(), knots).expect("a valid curve")
}

/// The uniform knots of some vertices of which the first has the given number.
fn knots(first: usize, vertices: usize) -> Vec<f64> {
    (0..vertices + DEGREE + 1)
        .map(|index| (first + index) as f64 - DEGREE as f64)
        .collect()
}

fn curvo_ways(points: &[[f64; 2]], parameters: &[f64]) -> Vec<(&'static str, Way)> {
    fn jet(derivatives: Vec<nalgebra::Vector2<f64>>) -> Jet {
        [0, 1, 2, 3].map(|order| [derivatives[order].x, derivatives[order].y])
    }
    let whole = curvo_curve(points, knots(0, VERTICES));
    let with_evaluator = whole.clone();
    let pieces: Vec<NurbsCurve2D<f64>> = (0..SEGMENTS)
        .map(|k| curvo_curve(&points[k..=k + DEGREE], knots(k, DEGREE + 1)))
        .collect();
    let [first, second, third] = [0; 3].map(|_| parameters.to_vec());
    vec![
        (
            "curvo: whole curve",
            Box::new(move |take| {
                for segment in 0..SEGMENTS {
                    for t in &first {
                        one(take, jet(whole.rational_derivatives(segment as f64 + t, 3)));
                    }
                }
            }),
        ),
        (
            "curvo: whole curve, evaluator",
            Box::new(move |take| {
                let mut evaluator = with_evaluator.evaluator();
                for segment in 0..SEGMENTS {
                    for t in &second {
                        one(
                            take,
                            jet(evaluator.rational_derivatives(segment as f64 + t, 3)),
                        );
                    }
                }
            }),
        ),
        (
            "curvo: segment by segment",
            Box::new(move |take| {
                for (segment, piece) in pieces.iter().enumerate() {
                    let mut evaluator = piece.evaluator();
                    for t in &third {
                        one(
                            take,
                            jet(evaluator.rational_derivatives(segment as f64 + t, 3)),
                        );
                    }
                }
            }),
        ),
    ]
}

/// A curve with its derivatives as curves of their own.
struct TruckCurves {
    point: BSplineCurve<Point2>,
    derivatives: [BSplineCurve<Vector2>; 3],
}

impl TruckCurves {
    fn new(points: &[[f64; 2]], knots: Vec<f64>) -> Self {
        let points = points.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
        let point = BSplineCurve::new(KnotVec::from(knots), points);
        let first = point.derivation();
        let second = first.derivation();
        let third = second.derivation();
        Self {
            point,
            derivatives: [first, second, third],
        }
    }

    fn by_curves(&self, u: f64) -> Jet {
        let [first, second, third] = &self.derivatives;
        self.jet(u, [first.subs(u), second.subs(u), third.subs(u)])
    }

    fn by_methods(&self, u: f64) -> Jet {
        let third = self.derivatives[1].der(u);
        self.jet(u, [self.point.der(u), self.point.der2(u), third])
    }

    fn jet(&self, u: f64, [first, second, third]: [Vector2; 3]) -> Jet {
        let point = self.point.subs(u);
        [
            [point.x, point.y],
            [first.x, first.y],
            [second.x, second.y],
            [third.x, third.y],
        ]
    }
}

fn truck_ways(points: &[[f64; 2]], parameters: &[f64]) -> Vec<(&'static str, Way)> {
    let whole = || TruckCurves::new(points, knots(0, VERTICES));
    let pieces = || -> Vec<TruckCurves> {
        (0..SEGMENTS)
            .map(|k| TruckCurves::new(&points[k..=k + DEGREE], knots(k, DEGREE + 1)))
            .collect()
    };
    fn over_whole(
        curve: TruckCurves,
        parameters: Vec<f64>,
        evaluate: fn(&TruckCurves, f64) -> Jet,
    ) -> Way {
        Box::new(move |take| {
            for segment in 0..SEGMENTS {
                for t in &parameters {
                    one(take, evaluate(&curve, segment as f64 + t));
                }
            }
        })
    }
    fn over_pieces(
        curves: Vec<TruckCurves>,
        parameters: Vec<f64>,
        evaluate: fn(&TruckCurves, f64) -> Jet,
    ) -> Way {
        Box::new(move |take| {
            for (segment, curve) in curves.iter().enumerate() {
                for t in &parameters {
                    one(take, evaluate(curve, segment as f64 + t));
                }
            }
        })
    }
    let [a, b, c, d] = [0; 4].map(|_| parameters.to_vec());
    vec![
        (
            "truck: whole curve, methods",
            over_whole(whole(), a, TruckCurves::by_methods),
        ),
        (
            "truck: whole curve, derivative curves",
            over_whole(whole(), b, TruckCurves::by_curves),
        ),
        (
            "truck: segments, methods",
            over_pieces(pieces(), c, TruckCurves::by_methods),
        ),
        (
            "truck: segments, derivative curves",
            over_pieces(pieces(), d, TruckCurves::by_curves),
        ),
    ]
}
