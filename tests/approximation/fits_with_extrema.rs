//! Fits with a number of extrema to noisy points of curves that have so many.

use std::fmt::Write;

use batten::geometry::approximation::FitRequest;
use batten::geometry::features::Features;
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{Differentiable, Progress};

use crate::common::Random;
use crate::fits::{BY_NOISE, fit_points, noisy};

/// By how much the errors of a fit may exceed those of the nearest with as many vertices, or the noise.
const BY_ANY: f64 = 1.3;

/// The number of points.
const POINTS: usize = 200;

/// References with the number of extrema of their curvature.
const SHAPES: [(&str, usize); 8] = [
    ("clothoid:from=0,to=2", 0),
    ("logarithmic-spiral:a=1,b=0.3,from=0,to=4", 0),
    ("log-aesthetic:alpha=0.5,lambda=0.5,from=0,to=5", 0),
    ("clothoid:from=-1.6,to=1.8", 0),
    ("parabola:focus=0.5,from=-1.5,to=2", 1),
    ("formula:x=t;y=sin(t);from=0.3;to=6", 2),
    ("ellipse:a=2,b=1,from=-0.3,to=5.98", 4),
    ("ellipse:a=3,b=1,from=-0.3,to=5.98", 4),
];

/// What came of some fits.
#[derive(Default)]
struct Tally {
    fits: usize,
    worst: f64,
    missed: Vec<String>,
}

impl Tally {
    /// Fit points that are off by noise of a share of the curve's size, and check the result.
    fn fit(
        &mut self,
        (text, extrema): (&str, usize),
        (degree, count): (usize, Option<usize>),
        noise: f64,
        seed: u64,
    ) {
        let mut random = Random(seed);
        let (points, off) = noisy(text, POINTS, noise * size(text), &mut random);
        let asked = FitRequest {
            degree,
            count,
            extrema: Some(extrema),
            ..FitRequest::default()
        };
        let found = fit_points(&points, &asked, &Progress::default()).expect("a curve");
        let proved = Features::new(&found.polygon).curvature_extrema.len();
        let limit = match count {
            None => BY_NOISE * off,
            Some(_) => BY_ANY * off.max(found.rms_of_any),
        };
        self.fits += 1;
        self.worst = self.worst.max(found.rms / limit);
        if !found.reached || proved != extrema || found.rms > limit {
            let mut line = format!("{text}, degree {degree}, noise {noise}, seed {seed}: ");
            let vertices = found.polygon.vertices().len();
            let share = found.rms / off;
            write!(
                line,
                "{proved} of {extrema} extrema, {vertices} vertices, {share:.3} of the noise"
            )
            .expect("a text takes all");
            self.missed.push(line);
        }
    }

    fn check(&self, name: &str, allowed: usize) {
        let (fits, missed) = (self.fits, self.missed.len());
        println!(
            "{name}: {} of {fits}, worst {:.3} of the limit",
            fits - missed,
            self.worst
        );
        assert!(missed <= allowed, "{name}: {:#?}", self.missed);
    }
}

/// The diagonal of the box about a reference.
fn size(text: &str) -> f64 {
    let curve = ReferenceCurve::from_text(text).expect("a reference");
    let [from, to] = curve.interval();
    let places = (0..=POINTS).map(|index| from + (to - from) * index as f64 / POINTS as f64);
    let points: Vec<_> = places.map(|t| curve.derivatives(t, 0)[0]).collect();
    let low = points.iter().copied().reduce(|a, b| a.min(b));
    let high = points.iter().copied().reduce(|a, b| a.max(b));
    low.zip(high).map_or(0.0, |(low, high)| low.distance(high))
}

#[test]
fn a_few_of_all_shapes_are_fitted_within_the_noise() {
    let mut tally = Tally::default();
    for (index, shape) in SHAPES.into_iter().enumerate() {
        let degree = 3 + index % 5;
        tally.fit(shape, (degree, None), [1e-4, 1e-3, 1e-2][index % 3], 5);
    }
    tally.fit(("circle:radius=10", 0), (5, None), 1e-3, 5);
    tally.check("open counts", 0);
}

/// A parabola's extremum, and the spiral curvature of a clothoid, with counts that are given: before there were
/// conditions on slopes these fits were up to fifty times as far off as need be.
#[test]
fn given_counts_are_fitted_as_nearly_as_any_curve_with_as_many_vertices() {
    let mut tally = Tally::default();
    for count in [8, 12, 20, 40] {
        tally.fit(SHAPES[4], (4, Some(count)), 1e-3, 3);
        tally.fit(SHAPES[0], (5, Some(count)), 1e-3, 3);
    }
    tally.check("given counts", 0);
}

/// Of circles only those that can be: a curve of degree 3 whose curvature is monotone over a whole turn needs far
/// more vertices than there are points to be as near as small noise, and one of degree 4 many. One of degree 5 under
/// the least noise takes 117 vertices for 200 points, and stays 1.33 times the noise off.
#[test]
#[ignore = "takes minutes"]
fn all_shapes_are_fitted_within_the_noise() {
    let mut open = Tally::default();
    for seed in 1..4 {
        for degree in 3..8 {
            for noise in [1e-4, 1e-3, 1e-2] {
                for shape in SHAPES {
                    open.fit(shape, (degree, None), noise, seed);
                }
                if degree > 4 {
                    open.fit(("circle:radius=10", 0), (degree, None), noise, seed);
                }
            }
        }
    }
    open.check("open counts", 1);
}

/// Where so few vertices or so much noise leave another shape nearer, fits are farther off: they are listed, and
/// may be a few.
#[test]
#[ignore = "takes minutes"]
fn given_counts_are_fitted_nearly_always() {
    let mut given = Tally::default();
    for degree in 3..8 {
        for noise in [1e-4, 1e-3, 1e-2] {
            for shape in SHAPES {
                for count in [10, 15, 25, 40] {
                    given.fit(shape, (degree, Some(count)), noise, 1);
                }
            }
        }
    }
    println!("{:#?}", given.missed);
    given.check("given counts", given.fits / 20);
}
