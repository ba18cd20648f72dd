//! Harmonising noisy polygons of curves with known features.

use batten::geometry::fairing::harmonising::{Harmony, Held, harmonise, least_change};
use batten::geometry::features::{Feature, Features};
use batten::geometry::harmony::VertexFlow;
use batten::geometry::{FloatPolygon, Progress};
use glam::DVec3;

use crate::common::Random;
use crate::{HELD, check_ends};

/// Ask for the features that stand out, with ends that keep something.
fn wish(held: Held) -> Harmony<'static> {
    Harmony {
        stretch: None,
        ends: [held; 2],
        locked: &[],
        extrema: None,
        inflections: None,
        torsion_extrema: None,
        largest_deviation: None,
        symmetry: None,
    }
}

/// What curves there are before the noise.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    Clothoid,
    Spiral,
    Inflected,
    Humped,
}

impl Shape {
    const ALL: [Self; 4] = [Self::Clothoid, Self::Spiral, Self::Inflected, Self::Humped];

    /// The extrema of the curvature and the inflections.
    fn features(self) -> (usize, usize) {
        match self {
            Self::Clothoid | Self::Spiral => (0, 0),
            Self::Inflected => (0, 1),
            Self::Humped => (1, 0),
        }
    }

    /// Put vertices of unit legs on a curve of this shape.
    fn vertices(self, random: &mut Random, count: usize) -> Vec<DVec3> {
        let turn = random.between(0.5, 3.0);
        let low = random.between(0.1, 0.6);
        let ratio = random.between(2.0, 6.0);
        let middle = random.between(0.35, 0.65);
        let narrow = random.between(2.0, 4.0);
        let curvature = |share: f64| match self {
            Self::Clothoid => low + (1.0 - low) * share,
            Self::Spiral => ratio.powf(share),
            Self::Inflected => 2.0 * share - 2.0 * middle,
            Self::Humped => low + (-(narrow * (share - middle)).powi(2)).exp(),
        };
        const STEPS: usize = 64;
        let length = (count - 1) as f64;
        let steps = STEPS * (count - 1);
        let share = |step: usize| (step as f64 + 0.5) / steps as f64;
        let total: f64 = (0..steps).map(|step| curvature(share(step)).abs()).sum();
        let scale = turn / (total / steps as f64 * length);
        let mut angle = random.between(0.0, 6.0);
        let mut point = DVec3::ZERO;
        let mut vertices = vec![point];
        for step in 0..steps {
            let turned = scale * curvature(share(step)) / STEPS as f64;
            angle += 0.5 * turned;
            point += DVec3::new(angle.cos(), angle.sin(), 0.0) / STEPS as f64;
            angle += 0.5 * turned;
            if (step + 1) % STEPS == 0 {
                vertices.push(point);
            }
        }
        vertices
    }
}

/// How many curves of each shape are tried.
const TRIALS: usize = 60;

/// A noisy polygon, with its noise: a share of a leg in each coordinate.
fn noisy(shape: Shape, random: &mut Random, in_space: bool, rational: bool) -> (FloatPolygon, f64) {
    let degree = 4 + (random.bits() % 6) as usize;
    let count = 12 + (random.bits() % 49) as usize;
    let noise = random.between(0.02, 0.1);
    let mut vertices = shape.vertices(random, count);
    let rise = random.between(0.1, 0.3);
    for (index, vertex) in vertices.iter_mut().enumerate() {
        if in_space {
            // A helix on a cylinder over the planar curve: κ and τ are multiples of its curvature.
            vertex.z += rise * index as f64;
        }
        *vertex += random.vector(noise, in_space);
    }
    let end = random.between(1.2, 2.0);
    let weights = (0..count).map(|index| end.powf(index as f64 / count as f64));
    let weights = rational.then(|| weights.collect());
    let polygon = FloatPolygon::new(degree, vertices, weights, false).expect("valid");
    (polygon, noise)
}

fn asked(extrema: usize, inflections: usize) -> Harmony<'static> {
    Harmony {
        stretch: None,
        ends: [Held::Direction; 2],
        locked: &[],
        extrema: Some(extrema),
        inflections: Some(inflections),
        torsion_extrema: None,
        largest_deviation: None,
        symmetry: None,
    }
}

fn largest_move(before: &FloatPolygon, after: &FloatPolygon) -> f64 {
    let moves = before.vertices().iter().zip(after.vertices());
    moves.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// Harmonise so many noisy curves of a shape. Returns how many have the features they had before
/// the noise, and the median of the largest moves in units of the noise.
fn harmonise_many(shape: Shape, trials: usize, rational: bool) -> (usize, f64) {
    let mut random = Random(7);
    let mut ratios = Vec::new();
    let (extrema, inflections) = shape.features();
    for _ in 0..trials {
        let (polygon, noise) = noisy(shape, &mut random, false, rational);
        let found = least_change(&polygon, &asked(extrema, inflections), &Progress::default());
        let found = found.expect("a result");
        check_ends(&polygon, &found.polygon);
        assert_eq!(found.polygon.weights(), polygon.weights());
        if found.reached {
            let features = Features::new(&found.polygon);
            assert_eq!(features.count(Feature::CurvatureExtremum), extrema);
            assert_eq!(features.count(Feature::Inflection), inflections);
            assert!(features.undecided.is_empty());
            ratios.push(largest_move(&polygon, &found.polygon) / noise);
        }
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN);
    println!(
        "{shape:?}: {} of {trials}, largest move {median:.2} times the noise",
        ratios.len()
    );
    (ratios.len(), median)
}

fn check_shapes(trials: usize, rational: bool) {
    for shape in Shape::ALL {
        let (reached, median) = harmonise_many(shape, trials, rational);
        let share = if shape == Shape::Humped { 0.95 } else { 0.98 };
        assert!(
            reached as f64 >= share * trials as f64,
            "{shape:?}: {reached} of {trials}"
        );
        assert!(median <= 2.0, "{shape:?}: {median} times the noise");
    }
}

#[test]
fn the_features_before_the_noise_come_back() {
    check_shapes(TRIALS, false);
}

/// `cargo test --test fairing -- --ignored --nocapture a_thousand`
#[test]
#[ignore = "a longer run of the test above"]
fn a_thousand_noisy_polygons() {
    check_shapes(250, false);
    check_shapes(250, true);
}

#[test]
fn rational_curves_keep_their_weights() {
    check_shapes(TRIALS, true);
}

#[test]
fn space_curves_lose_their_ripple() {
    let mut random = Random(11);
    let (mut reached, mut fewer) = (0, 0);
    let trials = TRIALS / 2;
    for _ in 0..trials {
        let (polygon, _) = noisy(Shape::Clothoid, &mut random, true, false);
        let harmony = Harmony {
            torsion_extrema: Some(0),
            ..asked(0, 0)
        };
        let found = harmonise(&polygon, &harmony, &Progress::default()).expect("a result");
        check_ends(&polygon, &found.polygon);
        let before = Features::new(&polygon).curvature_extrema.len();
        reached += usize::from(found.reached);
        fewer += usize::from(found.counts.extrema < before);
    }
    println!("space: {reached} of {trials}, {fewer} with fewer extrema");
    assert!(reached * 5 >= trials * 4, "{reached} of {trials}");
    assert_eq!(fewer, trials);
}

#[test]
fn a_stretch_of_a_noisy_curve_becomes_harmonious_by_itself() {
    let mut random = Random(19);
    let (mut reached, trials) = ([0; 2], 20);
    for _ in 0..trials {
        let mut vertices = Shape::Clothoid.vertices(&mut random, 44);
        for vertex in &mut vertices {
            *vertex += random.vector(0.03, false);
        }
        let polygon = FloatPolygon::new(5, vertices, None, false).expect("valid");
        for (count, held) in reached.iter_mut().zip([Held::Free, Held::Direction]) {
            let stretch = [8.0, 26.0];
            let harmony = Harmony {
                stretch: Some(stretch),
                ends: [held; 2],
                ..asked(0, 0)
            };
            let found = harmonise(&polygon, &harmony, &Progress::default()).expect("a result");
            *count += usize::from(found.reached);
            let features = Features::new(&found.polygon);
            let mut inside = features.curvature_extrema.iter();
            let any = inside.any(|it| it.u[1] >= stretch[0] && it.u[0] <= stretch[1]);
            assert_eq!(any, found.counts.extrema > 0);
            if held == Held::Direction {
                for u in stretch {
                    let [a, b] = [&polygon, &found.polygon].map(|it| it.jet(u));
                    assert!(a.point.distance(b.point) <= HELD * polygon.size());
                }
            }
        }
    }
    println!("stretches: {reached:?} of {trials}");
    assert!(
        reached.into_iter().all(|count| count * 20 >= trials * 19),
        "{reached:?}"
    );
}

/// A noisy polygon of many vertices.
fn long(shape: Shape, count: usize, noise: f64, degree: usize) -> FloatPolygon {
    let mut random = Random(29);
    let mut vertices = shape.vertices(&mut random, count);
    for vertex in &mut vertices {
        *vertex += random.vector(noise, false);
    }
    FloatPolygon::new(degree, vertices, None, false).expect("valid")
}

fn check_long(shape: Shape, count: usize, noise: f64, degree: usize) {
    let polygon = long(shape, count, noise, degree);
    let before = Features::new(&polygon).count(Feature::CurvatureExtremum);
    let (extrema, inflections) = shape.features();
    let asked = asked(extrema, inflections);
    let found = harmonise(&polygon, &asked, &Progress::default()).expect("a result");
    let farthest = largest_move(&polygon, &found.polygon) / noise;
    println!(
        "{shape:?}, {count} vertices, degree {degree}: {before} extrema, then {:?}, \
         largest move {farthest:.1} times the noise",
        found.counts
    );
    assert!(found.reached, "{:?}", found.counts);
    check_ends(&polygon, &found.polygon);
    let features = Features::new(&found.polygon);
    assert_eq!(features.count(Feature::CurvatureExtremum), extrema);
    assert_eq!(features.count(Feature::Inflection), inflections);
    assert!(before > count / 2 && features.undecided.is_empty());
}

#[test]
fn long_noisy_curves_get_their_features_back() {
    check_long(Shape::Clothoid, 600, 0.05, 5);
    check_long(Shape::Inflected, 2000, 0.03, 9);
}

/// `cargo test --release --test fairing -- --ignored --nocapture every_shape`
#[test]
#[ignore = "a longer run of the test above"]
fn long_noisy_curves_of_every_shape() {
    for shape in Shape::ALL {
        for (count, degree) in [(300, 4), (600, 5), (1000, 7), (2000, 5), (2000, 9)] {
            for noise in [0.03, 0.05] {
                check_long(shape, count, noise, degree);
            }
        }
    }
}

#[test]
fn the_best_found_comes_close_where_what_is_asked_is_out_of_reach() {
    // Curvatures of both signs are held at the ends, so an inflection is left.
    let polygon = long(Shape::Inflected, 200, 0.05, 5);
    let before = Features::new(&polygon).count(Feature::CurvatureExtremum);
    let held = Harmony {
        ends: [Held::Curvature; 2],
        ..asked(0, 0)
    };
    let found = harmonise(&polygon, &held, &Progress::default()).expect("a result");
    println!("200 vertices: {before} extrema, then {:?}", found.counts);
    assert!(!found.reached);
    assert!(
        (found.counts.extrema + found.counts.inflections) * 10 <= before,
        "{:?} of {before}",
        found.counts
    );
}

/// The coordinates of vertices.
type Vertices = [(f64, f64)];

/// Polygons at random, with the numbers of extrema for which a curve is fitted to them.
const TANGLED: [(usize, usize, &Vertices); 2] = [
    (
        5,
        12,
        &[
            (-4.570689275685332, 3.270761028869215),
            (4.2913156958878265, 3.1810212885627145),
            (-4.007445340065815, 0.8489963622593732),
            (-3.906927562157958, -4.5795588736676685),
            (-4.479446272375261, 4.970861508088843),
            (1.0767238197628117, -0.006926577388602695),
            (4.03813020934763, 3.5651197427838675),
            (2.381200639994626, -4.5255062099840915),
            (-1.5117642819368626, 4.526392209740678),
            (-1.2716009085138769, -2.7361680328436178),
            (-1.7721512546989326, 4.280689204361634),
            (-4.657522321378986, 1.297907516405413),
            (-3.665393879378308, 0.6870453200546294),
            (1.5479125257450406, 2.1386764239066913),
            (4.23210718405395, -4.652837287572398),
        ],
    ),
    (
        4,
        15,
        &[
            (4.81221058148159, 3.0794373344767028),
            (1.2844850198214077, -2.324737553528883),
            (4.128628900924319, 4.594388378770715),
            (-3.6087384097852904, 2.7575725031571565),
            (3.419308585435237, 1.5971735631398252),
            (2.004077664167305, -0.5494126788548837),
            (4.243078026249281, 4.712075281962813),
            (-1.1764668717982554, 3.0271153080035678),
            (-0.6707840861946366, -3.352457813167262),
            (-1.7453272314273605, -3.736699251651575),
            (4.088847599027046, 4.594240800441439),
            (-3.8081326759412515, 1.0067908118705846),
            (-0.9177590229141686, -3.8190996899821084),
            (-2.0452448518818303, -2.517836289193519),
            (2.4957681118975668, -4.959910440459541),
            (-3.101612960669163, -0.6122692988006309),
            (-4.789653269141287, 1.2752658853748047),
        ],
    ),
];

/// The largest distance of points on one curve from another curve.
fn off(one: &FloatPolygon, other: &FloatPolygon) -> f64 {
    const SAMPLES: usize = 24;
    let points = (0..=SAMPLES * one.segments()).map(|it| one.point(it as f64 / SAMPLES as f64));
    let far = points.map(|point| point.distance(other.nearest(point).point));
    far.fold(0.0, f64::max)
}

#[test]
fn a_fitted_curve_is_no_farther_away_than_it_says() {
    let mut fitted = 0;
    for (degree, extrema, vertices) in TANGLED {
        let polygon = FloatPolygon::planar(degree, vertices).expect("a polygon");
        for most in [0.55, 0.73, 5.0] {
            let asked = Harmony {
                inflections: None,
                largest_deviation: Some(most),
                ..asked(extrema, 0)
            };
            let found = harmonise(&polygon, &asked, &Progress::default()).expect("a result");
            let far = off(&polygon, &found.polygon).max(off(&found.polygon, &polygon));
            println!(
                "{extrema}: {} says {}, is {far}",
                found.reached, found.deviation
            );
            assert!(
                far <= 1.001 * found.deviation + 1e-12,
                "{far} {}",
                found.deviation
            );
            assert!(!found.reached || found.deviation <= most);
            fitted += usize::from(found.refitted);
        }
    }
    assert!(fitted > 0);
}

/// The Eppler 585 section by least squares without conditions, degree 5: seven extrema and more.
const SECTION: [(f64, f64); 24] = [
    (1.036028, -0.053239),
    (1.100464, -0.038867),
    (1.030518, -0.004611),
    (0.837713, 0.047409),
    (0.645960, 0.096231),
    (0.502779, 0.116657),
    (0.346694, 0.119244),
    (0.199032, 0.103367),
    (0.081892, 0.070811),
    (0.017381, 0.033515),
    (-0.000942, 0.006879),
    (0.000634, 0.000042),
    (-0.001047, -0.000391),
    (0.002373, -0.005327),
    (-0.000036, 0.000180),
    (0.004151, -0.016396),
    (0.146963, -0.031164),
    (0.364238, -0.029817),
    (0.548122, -0.032820),
    (0.734601, -0.013364),
    (0.926098, 0.014945),
    (1.033383, -0.002463),
    (1.006040, -0.009358),
    (0.841325, -0.000107),
];

#[test]
fn a_fit_leaves_locked_vertices_in_their_places() {
    let polygon = FloatPolygon::planar(5, &SECTION).expect("a polygon");
    let mut fitted = 0;
    for (extrema, locked) in [(1, [8]), (3, [12])] {
        let asked = Harmony {
            ends: [Held::Position; 2],
            inflections: None,
            locked: &locked,
            largest_deviation: Some(5e-3),
            ..asked(extrema, 0)
        };
        let found = harmonise(&polygon, &asked, &Progress::default()).expect("a result");
        assert!(found.reached, "{extrema} {locked:?}");
        for vertex in locked {
            assert_eq!(found.polygon.vertex(vertex), polygon.vertex(vertex));
        }
        assert!(off(&found.polygon, &polygon) <= 5e-3);
        fitted += usize::from(found.refitted);
    }
    assert!(fitted > 0);
}

/// The AG35 section with noise of 3e-4, fitted without conditions, degree 5: twenty extrema and four inflections, two of
/// them of a small bump below.
const NOISY: [(f64, f64); 35] = [
    (1.618779, -0.084092),
    (1.193266, -0.030343),
    (0.976445, 0.005277),
    (0.852532, 0.026803),
    (0.686831, 0.053706),
    (0.592292, 0.063291),
    (0.467413, 0.078385),
    (0.390692, 0.083142),
    (0.304785, 0.089599),
    (0.238395, 0.085531),
    (0.187656, 0.084046),
    (0.132167, 0.079814),
    (0.092538, 0.074242),
    (0.059576, 0.065144),
    (0.035443, 0.057692),
    (0.016895, 0.048509),
    (0.005070, 0.039754),
    (-0.002067, 0.031599),
    (-0.000640, 0.025259),
    (0.002710, 0.020031),
    (0.012509, 0.014827),
    (0.029221, 0.011122),
    (0.054324, 0.009096),
    (0.084548, 0.005396),
    (0.127705, 0.002620),
    (0.184009, -0.001229),
    (0.248974, -0.000280),
    (0.328516, -0.001198),
    (0.421362, -0.001108),
    (0.529995, -0.000843),
    (0.660935, 0.000570),
    (0.814063, 0.000645),
    (0.992566, 0.000838),
    (1.204901, -0.000017),
    (1.457166, -0.000047),
];

#[test]
fn no_inflection_moves_into_the_nose() {
    let polygon = FloatPolygon::planar(5, &NOISY).expect("a polygon");
    let wish = Harmony {
        ends: [Held::Direction; 2],
        inflections: None,
        largest_deviation: Some(0.05),
        ..asked(3, 0)
    };
    let found = harmonise(&polygon, &wish, &Progress::default()).expect("a result");
    assert!(found.reached && found.displaced.is_none());
    let features = Features::proved(&found.polygon, |_| true).expect("a proof");
    for (u, _) in features.places(Feature::Inflection) {
        let place = found.polygon.point(u[0]);
        assert!(place.x > 0.2, "{place}");
    }
    assert!(off(&found.polygon, &polygon) <= 5e-4);
}

/// A noisy ellipse of 44 unit legs and degree 5, whose curvature is monotone over the seam, and the
/// stretch where it is.
fn noisy_ellipse(random: &mut Random) -> (FloatPolygon, [f64; 2]) {
    const COUNT: usize = 44;
    let turn = std::f64::consts::TAU / COUNT as f64;
    let vertices = |noise: f64, random: &mut Random| {
        let place = |index: usize| {
            let (sine, cosine) = (turn * (index as f64 + 7.5)).sin_cos();
            DVec3::new(9.0 * cosine, 6.0 * sine, 0.0) + random.vector(noise, false)
        };
        let vertices = (0..COUNT).map(place).collect();
        FloatPolygon::new(5, vertices, None, true).expect("valid")
    };
    let fair = Features::new(&vertices(0.0, random));
    let places: Vec<f64> = fair.curvature_extrema.iter().map(|it| it.u[0]).collect();
    let (first, last) = (places[0], places[places.len() - 1]);
    (vertices(0.03, random), [last + 0.75, first - 0.75])
}

#[test]
fn a_stretch_over_the_seam_of_a_periodic_curve_is_harmonised_as_anywhere_else() {
    let mut random = Random(23);
    let (mut reached, trials) = (0, 12);
    for trial in 0..trials {
        let (polygon, stretch) = noisy_ellipse(&mut random);
        assert!(stretch[0] > stretch[1], "over the seam");
        let count = polygon.segments();
        let inside = |polygon: &FloatPolygon| {
            let extrema = Features::new(polygon).curvature_extrema;
            let within = extrema
                .iter()
                .filter(|it| it.u[1] >= stretch[0] || it.u[0] <= stretch[1]);
            within.map(|it| it.count).sum::<usize>()
        };
        assert!(inside(&polygon) > 0, "trial {trial}: noise");
        let harmony = Harmony {
            stretch: Some(stretch),
            locked: &[count - 1],
            ..asked(0, 0)
        };
        let found = harmonise(&polygon, &harmony, &Progress::default()).expect("a result");
        assert_eq!(
            inside(&found.polygon),
            found.counts.extrema,
            "trial {trial}"
        );
        reached += usize::from(found.reached);
        assert_eq!(found.polygon.vertex(count - 1), polygon.vertex(count - 1));
        for u in stretch {
            let [a, b] = [&polygon, &found.polygon].map(|polygon| polygon.jet(u));
            assert!(a.point.distance(b.point) <= HELD * polygon.size());
        }
        // As on the same curve that begins with the stretch.
        let first = stretch[0].floor() as usize;
        let shift = first as f64;
        let elsewhere = Harmony {
            stretch: Some([stretch[0] - shift, stretch[1] - shift + count as f64]),
            locked: &[count - 1 - first],
            ..harmony
        };
        let begun = polygon.begun_at(first);
        let again = harmonise(&begun, &elsewhere, &Progress::default()).expect("a result");
        assert_eq!(again.polygon.begun_at(count - first), found.polygon);
        assert_eq!(again.counts, found.counts, "trial {trial}");
    }
    println!("over the seam: {reached} of {trials}");
    assert_eq!(reached, trials);
}

#[test]
fn a_stretch_that_is_none_is_refused() {
    let mut random = Random(23);
    let (polygon, _) = noisy_ellipse(&mut random);
    let run = |polygon: &FloatPolygon, stretch: [f64; 2]| {
        let harmony = Harmony {
            stretch: Some(stretch),
            ..asked(0, 0)
        };
        let error = harmonise(polygon, &harmony, &Progress::default()).expect_err("no stretch");
        error.to_string()
    };
    let end = polygon.segments() as f64;
    let open = FloatPolygon::new(5, polygon.vertices().to_vec(), None, false).expect("valid");
    assert!(run(&open, [10.0, 3.0]).contains("two rising numbers"));
    assert!(run(&polygon, [10.0, 10.0]).contains("two different numbers"));
    assert!(run(&polygon, [end + 1.0, 3.0]).contains("two different numbers"));
    assert!(run(&polygon, [10.6, 10.2]).contains("let a whole number lie between"));
}

#[test]
fn a_faint_inflection_at_an_end_goes_with_a_small_move() {
    // A fit to a noisy scan, about 100 large; its first few per cent bend the other way.
    let vertices = [
        (-23.306, 10.524),
        (-69.281, 34.301),
        (-46.187, 21.775),
        (-28.265, 6.4971),
        (-12.993, 1.0952),
        (-1.1188, 0.13056),
        (9.3319, 1.3865),
        (20.723, 5.2196),
        (33.856, 13.979),
        (46.465, 31.412),
        (51.018, 61.304),
        (29.176, 103.33),
    ];
    let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
    let found = harmonise(&polygon, &asked(0, 0), &Progress::default()).expect("a result");
    assert!(found.reached);
    assert!(found.deviation < 0.3, "{}", found.deviation);
    // Its vertices stay where a hand can drag them.
    assert!(largest_move(&polygon, &found.polygon) < polygon.size());
}

#[test]
fn harmonising_does_not_fold_the_polygon() {
    // The float polygon of an S whose curvature falls a little at both ends.
    const HALF: [(f64, f64); 5] = [
        (12.14, 8.06),
        (42.53, 17.94),
        (74.01, 4.0),
        (86.18, -26.24),
        (86.67, -55.47),
    ];
    const LEG: f64 = 29.0;
    const SIZE: f64 = 141.0;
    let image = HALF.iter().rev().map(|(x, y)| (-x, -y));
    let vertices: Vec<(f64, f64)> = image.chain(HALF).collect();
    let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
    for held in [Held::Free, Held::Position, Held::Direction] {
        let wish = wish(held);
        let found = harmonise(&polygon, &wish, &Progress::default()).expect("a curve");
        assert!(found.reached, "{held:?}");
        assert!(
            found.deviation <= 1e-4 * SIZE,
            "{held:?}: {}",
            found.deviation
        );
        let pairs = polygon.vertices().iter().zip(found.polygon.vertices());
        let farthest = pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(farthest <= 0.25 * LEG, "{held:?}: {farthest}");
    }
}

#[test]
fn a_fit_that_is_less_even_than_the_polygon_was_is_no_harmony() {
    // One half of a vase, 240 high, drawn through 17 clicks. A fit with three extrema is 0.01 off, and its legs and turning
    // angles jump.
    let vertices = [
        (10.38, -14.36),
        (26.94, -8.45),
        (39.93, -0.02),
        (49.40, 10.92),
        (55.91, 23.88),
        (61.34, 37.30),
        (66.29, 50.78),
        (69.98, 64.83),
        (71.56, 79.23),
        (70.53, 93.75),
        (67.40, 107.88),
        (62.15, 121.39),
        (55.71, 134.30),
        (48.35, 146.72),
        (40.55, 158.84),
        (32.60, 170.87),
        (25.85, 183.69),
        (21.38, 197.52),
        (18.51, 211.65),
        (18.32, 226.39),
        (22.44, 240.35),
        (31.36, 252.83),
        (45.11, 263.79),
    ];
    let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
    let wish = wish(Held::Direction);
    let found = harmonise(&polygon, &wish, &Progress::default()).expect("a curve");
    assert!(found.reached);
    let uneven = |polygon: &FloatPolygon| {
        let turns = VertexFlow::of(polygon).turns;
        let changes = turns.second_differences().map(|(_, change)| change.abs());
        changes.fold(0.0, f64::max)
    };
    let [before, now] = [&polygon, &found.polygon].map(uneven);
    assert!(now <= before, "{now} after {before}");
    let size = polygon.size();
    assert!(found.deviation <= 5e-3 * size, "{}", found.deviation);
    assert!(largest_move(&polygon, &found.polygon) <= 0.01 * size);
    // What may not move so far is fitted nevertheless.
    let near = Harmony {
        largest_deviation: Some(0.1),
        ..wish
    };
    let found = harmonise(&polygon, &near, &Progress::default()).expect("a curve");
    assert!(found.reached && found.refitted, "{}", found.deviation);
}
