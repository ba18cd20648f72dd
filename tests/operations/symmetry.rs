//! Curves that become their own mirror images.

use batten::document::{Curve, Document};
use batten::geometry::distance::SideDeviation;
use batten::geometry::fairing::requirement::Requirement;
use batten::geometry::features::{Feature, Features};
use batten::geometry::{End, FloatPolygon, Mirror, Progress, Symmetry};
use batten::operations::{ALL, Deviation, Value};
use glam::{DVec2, DVec3};

use crate::common::{Random, check_symmetry};
use crate::runner::Runner;

/// The mirror line is the y axis.
const MIRROR: Mirror = Mirror::Signs([true, false, false]);

const FIRST: (&str, Value) = ("keep", Value::Choice(1));
const SECOND: (&str, Value) = ("keep", Value::Choice(2));

/// A quarter of an ellipse, or less by an angle: it ends on the axis, or beside it.
fn quarter(less: f64) -> FloatPolygon {
    let vertex = |index: usize| {
        let angle = std::f64::consts::FRAC_PI_2 - less + 0.12 * (index as f64 - 12.0);
        (40.0 * angle.cos(), 100.0 * angle.sin())
    };
    let vertices: Vec<(f64, f64)> = (0..14).map(vertex).collect();
    FloatPolygon::planar(3, &vertices).expect("a polygon")
}

#[track_caller]
fn check_is_symmetric(polygon: &FloatPolygon) {
    let count = polygon.vertices().len();
    for index in 0..count {
        let image = MIRROR.point(polygon.vertex(index));
        assert_eq!(polygon.vertex(count - 1 - index), image, "vertex {index}");
    }
}

#[test]
fn the_mean_of_both_halves_keeps_the_number_of_vertices() {
    for seed in 0..40 {
        let polygon = Random(seed).gentle(4, 8 + seed as usize % 9, false, seed % 2 == 0);
        let middle = polygon.point(0.5 * polygon.segments() as f64);
        let vertices = polygon.vertices().iter().map(|it| *it - middle);
        let weights = polygon.weights().map(<[f64]>::to_vec);
        let polygon = FloatPolygon::new(4, vertices.collect(), weights, false).expect("a polygon");
        let even = polygon.symmetrised(&MIRROR).expect("a polygon");
        let shift = |index: usize| 0.01 * polygon.size() * (7.0 * index as f64).sin();
        let vertices = even.vertices().iter().enumerate();
        let vertices = vertices.map(|(index, it)| *it + shift(index) * DVec3::new(1.0, 0.5, 0.0));
        let weights = polygon.weights().map(<[f64]>::to_vec);
        let polygon = FloatPolygon::new(4, vertices.collect(), weights, false).expect("a polygon");
        let (outcome, curves) = Runner::of(polygon.clone()).done("make-symmetric", &[]);
        let symmetric = &curves[0].polygon;
        assert_eq!(symmetric.vertices().len(), polygon.vertices().len());
        check_is_symmetric(symmetric);
        let Deviation::Measured(told) = outcome.deviation else {
            panic!("{:?}", outcome.deviation);
        };
        // Nearest points of dense samples, from both sides.
        let off = |from: &FloatPolygon, to: &FloatPolygon| {
            let steps = 40 * from.segments();
            let samples = (0..=steps).map(|step| from.point(step as f64 / 40.0));
            samples
                .map(|point| to.nearest(point).distance)
                .fold(0.0, f64::max)
        };
        let off = off(&polygon, symmetric).max(off(symmetric, &polygon));
        assert!(
            off <= told * (1.0 + 1e-6) && told <= 1.01 * off,
            "{off} {told}"
        );
        let (again, curves) = Runner::of(symmetric.clone()).done("make-symmetric", &[]);
        assert_eq!(again.deviation, Deviation::Exact);
        assert_eq!(curves[0].polygon, *symmetric);
    }
}

#[test]
fn each_half_is_completed_by_its_image() {
    // A wave whose crossing of the axis is level: both halves go on smoothly.
    let vertex = |index: usize| {
        let t = 0.35 * (index as f64 - 7.0);
        (t, t.cos() + 0.05 * t * t * t)
    };
    let vertices: Vec<(f64, f64)> = (0..15).map(vertex).collect();
    let polygon = FloatPolygon::planar(4, &vertices).expect("a polygon");
    let size = polygon.size();
    for (keep, end) in [(FIRST, End::Start), (SECOND, End::Finish)] {
        let (outcome, curves) = Runner::of(polygon.clone()).done("make-symmetric", &[keep]);
        assert!(outcome.reached);
        let symmetric = &curves[0].polygon;
        check_is_symmetric(symmetric);
        let [before, after] = [&polygon, symmetric].map(|it| it.end_jet(end).point);
        assert!(before.distance(after) <= 1e-4 * size, "{before} {after}");
        let mut requirements = outcome.requirements.iter().flat_map(|(_, all)| all);
        let bound = requirements.find_map(|it| match it {
            Requirement::Limit { found, .. } => Some(*found),
            _ => None,
        });
        let bound = bound.expect("how far the half moves");
        assert!(bound <= 1e-4 * size, "{bound}");
        // The other half is another one, and that is told.
        let samples = |polygon: &FloatPolygon| -> Vec<DVec3> {
            let last = polygon.segments() as f64;
            (0..=3000)
                .map(|it| polygon.point(f64::from(it) / 3000.0 * last))
                .collect()
        };
        let [before, after] = [samples(&polygon), samples(symmetric)];
        let off = |from: &[DVec3], to: &[DVec3]| {
            let nearest = |at: &DVec3| {
                to.iter()
                    .map(|it| it.distance(*at))
                    .fold(f64::INFINITY, f64::min)
            };
            from.iter().map(nearest).fold(0.0, f64::max)
        };
        let whole = off(&before, &after).max(off(&after, &before));
        assert!(
            matches!(outcome.deviation, Deviation::Measured(told) if (told / whole - 1.0).abs() < 1e-2),
            "{:?}, not {whole}",
            outcome.deviation
        );
        // Every point of the half that is kept lies near the whole.
        let steps = 0..=60;
        let half = steps.map(|step| f64::from(step) / 60.0 * polygon.segments() as f64);
        let samples = 60_000;
        let spacing = symmetric.arc_length(1e-3) / f64::from(samples);
        for u in half {
            let at = polygon.point(u);
            if (at.x < 0.0) != (end == End::Start) {
                continue;
            }
            let share = |step: i32| f64::from(step) / f64::from(samples);
            let places = (0..=samples).map(|step| share(step) * symmetric.segments() as f64);
            let off = places.map(|place| symmetric.point(place).distance(at));
            let off = off.fold(f64::INFINITY, f64::min);
            assert!(off <= bound.hypot(spacing), "{off} beyond {bound} at {at}");
        }
    }
}

#[test]
fn a_curve_on_one_side_is_joined_to_its_image() {
    // It nearly reaches the axis, or leaves a gap: one curve is fitted in the time that there is, or a bridge remains.
    let methods: [(f64, &[&str]); 2] = [(5e-4, &["bend", "merge"]), (0.15, &["fit", "bridge"])];
    for (less, methods) in methods {
        let polygon = quarter(less);
        assert!(polygon.end_jet(End::Finish).point.x > 0.0);
        let (outcome, curves) = Runner::of(polygon.clone()).done("make-symmetric", &[]);
        let told = outcome.figures.iter().find(|it| it.name == "method");
        let Some(Value::Word(method)) = told.map(|it| it.value.clone()) else {
            panic!("{told:?}");
        };
        assert!(methods.contains(&method), "{method}");
        let symmetric = &curves[0].polygon;
        check_is_symmetric(symmetric);
        let [start, finish] = End::BOTH.map(|end| symmetric.end_jet(end).point);
        let outer = polygon.end_jet(End::Start).point;
        let size = polygon.size();
        assert!(start.distance(outer) <= 2e-4 * size, "{start} {outer}");
        assert!(finish.distance(MIRROR.point(outer)) <= 2e-4 * size);
    }
}

#[test]
fn a_half_that_goes_on_beyond_the_axis_is_no_mean_of_halves() {
    let vertex = |index: usize| (10.0 * index as f64 - 15.0, (index * index) as f64);
    let vertices: Vec<(f64, f64)> = (0..12).map(vertex).collect();
    let polygon = FloatPolygon::planar(3, &vertices).expect("a polygon");
    let outcome = Runner::of(polygon).run("make-symmetric", &[]);
    let outcome = outcome.expect("an outcome");
    assert!(!outcome.reached);
    // It is a half that was drawn too far, and crosses the axis askew.
    let remark = &outcome.remarks[0];
    assert!(remark.contains("meets its image at a corner"), "{remark}");
    assert!(outcome.edits.is_empty());
}

#[test]
fn a_corner_at_the_axis_is_not_reached() {
    let line: Vec<(f64, f64)> = (0..8)
        .map(|it| (f64::from(it) - 5.0, f64::from(it)))
        .collect();
    let polygon = FloatPolygon::planar(3, &line).expect("a polygon");
    let outcome = Runner::of(polygon).run("make-symmetric", &[FIRST]);
    let outcome = outcome.expect("an outcome");
    assert!(!outcome.reached && outcome.edits.is_empty());
    assert!(
        outcome.remarks[0].contains("at a corner of 90.0°"),
        "{outcome:?}"
    );
}

#[test]
fn closed_curves_become_symmetric() {
    let vertex = |index: usize| {
        let angle = std::f64::consts::TAU * (index as f64 + 0.3) / 12.0;
        DVec3::new(3.0 * angle.cos() + 0.1, 2.0 * angle.sin(), 0.0)
    };
    let vertices = (0..12).map(vertex).collect();
    let polygon = FloatPolygon::new(5, vertices, None, true).expect("a polygon");
    let (_, curves) = Runner::of(polygon).done("make-symmetric", &[]);
    let symmetric = &curves[0].polygon;
    assert!(symmetric.is_periodic());
    for vertex in symmetric.vertices() {
        assert!(symmetric.vertices().contains(&MIRROR.point(*vertex)));
    }
}

/// An egg whose halves differ, beginning at some angle; it leaves the axis at a right angle.
fn egg(begin: f64) -> FloatPolygon {
    let vertex = |index: usize| {
        let angle = std::f64::consts::TAU * (index as f64 + begin) / 48.0;
        let (sin, cos) = angle.sin_cos();
        DVec3::new(3.0 * cos + 0.5 * cos * cos, 2.0 * sin, 0.0)
    };
    let vertices = (0..48).map(vertex).collect();
    FloatPolygon::new(5, vertices, None, true).expect("a polygon")
}

/// How far a curve goes beside the axis x = 0.
fn half_width(polygon: &FloatPolygon) -> f64 {
    let steps = 8 * polygon.segments();
    let across = (0..=steps).map(|it| polygon.point(it as f64 / 8.0).x);
    across.fold(0.0, f64::max)
}

#[test]
fn either_half_of_a_closed_curve_is_completed_by_its_image() {
    for begin in [5.3, 12.2] {
        let polygon = egg(begin);
        let mut widths = Vec::new();
        for keep in [FIRST, SECOND] {
            let (outcome, curves) = Runner::of(polygon.clone()).done("make-symmetric", &[keep]);
            assert!(outcome.reached, "begin {begin}: {:?}", outcome.warnings);
            let whole = &curves[0].polygon;
            assert!(whole.is_periodic());
            assert_eq!(whole.symmetrised(&MIRROR).as_ref(), Ok(whole));
            widths.push(half_width(whole));
        }
        widths.sort_by(f64::total_cmp);
        // The halves are 3 − 0.5 and 3 + 0.5 wide.
        let [narrow, wide] = widths[..] else {
            panic!("{widths:?}")
        };
        assert!(
            (2.4..2.55).contains(&narrow) && (3.4..3.55).contains(&wide),
            "{widths:?}"
        );
    }
}

#[test]
fn a_start_that_hardly_crosses_the_axis_is_no_half() {
    let polygon = egg(12.0);
    // The curve begins on the axis, or by a hair before it.
    let onto = (0..=1000).map(|it| f64::from(it) * 0.01 * 0.48);
    let start = onto.min_by(|a, b| {
        polygon
            .point(*a)
            .x
            .abs()
            .total_cmp(&polygon.point(*b).x.abs())
    });
    let start = start.expect("a place");
    for before in [0.0, 1e-3] {
        let from = (start - before).rem_euclid(48.0);
        let open = polygon
            .trimmed(from, from + 47.999, 3)
            .expect("a part")
            .polygon;
        let runner = Runner::of(open);
        // The half before the axis is 3 − 0.5 wide, the other one 3 + 0.5.
        for (keep, width) in [(FIRST, 2.5), (SECOND, 3.5)] {
            let outcome = runner.run("make-symmetric", &[keep]).expect("it can run");
            // How near the search comes in its time is another matter.
            if outcome.reached {
                let after = outcome.applied_to(runner.input.document());
                let after = after.expect("edits that can be made");
                let (_, whole) = after.curves().next().expect("a curve");
                let found = half_width(&whole.polygon);
                assert!((found - width).abs() < 0.05, "{before}: {found}");
            }
        }
    }
}

#[test]
fn a_closed_curve_beside_the_axis_has_no_halves() {
    let vertices = egg(0.0)
        .vertices()
        .iter()
        .map(|it| *it + 9.0 * DVec3::X)
        .collect();
    let polygon = FloatPolygon::new(5, vertices, None, true).expect("a polygon");
    let outcome = Runner::of(polygon).run("make-symmetric", &[FIRST]);
    let outcome = outcome.expect("it can run");
    assert!(!outcome.reached);
    assert!(
        outcome
            .remarks
            .concat()
            .contains("crosses the axis 0 times"),
        "{:?}",
        outcome.remarks
    );
}

#[test]
fn an_s_is_not_flattened_without_a_word() {
    let outcome = Runner::example("s-curve").run("make-symmetric", &[]);
    let outcome = outcome.expect("it can run");
    assert!(!outcome.reached, "{outcome:?}");
    let warning = outcome.warnings.first().expect("a warning");
    assert!(warning.contains("its halves differ much"), "{warning}");
}

/// Halves of outlines whose ends lie on the axis and leave it at a right angle.
#[test]
fn half_an_outline_becomes_a_closed_curve() {
    for (degree, segments, egg) in [(3, 12, 0.0), (4, 11, 0.2), (5, 16, 0.3)] {
        let step = std::f64::consts::PI / f64::from(segments);
        // The first vertex with which the curve begins at the axis.
        let begin = 0.5 * (f64::from(degree) - 1.0);
        let vertex = |index: i32| {
            let angle = -std::f64::consts::FRAC_PI_2 + step * (f64::from(index) - begin);
            let across = 40.0 * angle.cos() * (1.0 + egg * angle.sin());
            (across, 100.0 * angle.sin())
        };
        let vertices: Vec<(f64, f64)> = (0..segments + degree).map(vertex).collect();
        let polygon = FloatPolygon::planar(degree as usize, &vertices).expect("a polygon");
        let tolerance = 1e-4 * polygon.size();
        let (outcome, curves) = Runner::of(polygon.clone()).done("make-symmetric", &[]);
        assert!(outcome.reached, "{:?}", outcome.warnings);
        let whole = &curves[0].polygon;
        assert!(whole.is_periodic());
        assert_eq!(whole.symmetrised(&MIRROR).as_ref(), Ok(whole));
        let off = (0..=600).map(|it| {
            let point = polygon.point(f64::from(it * segments) / 600.0);
            whole.nearest(point).distance
        });
        let off = off.fold(0.0, f64::max);
        let told = match outcome.deviation {
            Deviation::Measured(told) => told,
            other => panic!("{other:?}"),
        };
        assert!(
            off <= told * (1.0 + 1e-6) + 1e-9 && told <= tolerance,
            "{off} {told}"
        );
    }
}

#[test]
fn a_curve_that_shall_stay_symmetric_does() {
    const STAY: (&str, Value) = ("stay", Value::Switch(true));
    let (_, curves) = Runner::of(quarter(0.0)).done("make-symmetric", &[STAY]);
    let symmetry = curves[0].symmetry.expect("a rule");
    assert_eq!(symmetry.mirror(), MIRROR);
    // About another axis later on: the rule goes along.
    let runner = Runner::curves(curves);
    let level = ("axis", Value::Choice(1));
    let (_, curves) = runner.done("make-symmetric", &[level]);
    let symmetry = curves[0].symmetry.expect("a rule");
    assert_eq!(symmetry.mirror(), Mirror::of_coordinate(1));
    check_symmetry(&curves[0]).expect("a symmetric curve");
}

/// The left half of a bottle that was traced by hand, down to its middle.
const WAVY: [(f64, f64); 36] = [
    (-12.3, 250.7),
    (-13.0, 242.9),
    (-13.5, 235.0),
    (-13.8, 226.9),
    (-13.9, 218.7),
    (-13.8, 210.5),
    (-13.7, 202.1),
    (-13.7, 193.8),
    (-14.3, 185.6),
    (-15.7, 177.6),
    (-18.0, 169.8),
    (-21.1, 162.2),
    (-24.7, 154.7),
    (-28.2, 147.1),
    (-31.3, 139.5),
    (-33.6, 131.8),
    (-35.2, 123.9),
    (-36.1, 115.8),
    (-36.8, 107.5),
    (-37.4, 99.0),
    (-37.6, 90.6),
    (-37.1, 82.6),
    (-36.1, 75.1),
    (-35.2, 67.5),
    (-35.4, 59.1),
    (-37.1, 49.7),
    (-39.2, 40.2),
    (-39.6, 32.0),
    (-37.5, 25.6),
    (-35.4, 18.8),
    (-37.0, 8.5),
    (-34.3, 0.1),
    (-22.6, -0.6),
    (-13.6, -0.2),
    (-6.5, -0.6),
    (0.0, -0.8),
];

#[test]
fn a_symmetric_curve_is_harmonised_as_its_own_mirror_image() {
    // About a slanted line: the fit has to turn the curve.
    let turn = DVec2::from_angle(0.7);
    let placed =
        |x: f64, y: f64| (turn.rotate(DVec2::new(x, y)) + DVec2::new(30.0, -20.0)).extend(0.0);
    let left = WAVY.iter().map(|(x, y)| placed(*x, *y));
    let right = WAVY[..35].iter().rev().map(|(x, y)| placed(-x, *y));
    let polygon = FloatPolygon::new(5, left.chain(right).collect(), None, false);
    let mirror = Mirror::through(placed(0.0, 0.0), placed(0.0, 100.0)).expect("a line");
    let polygon = polygon.expect("a polygon");
    let curve = Curve::new("bottle", polygon.clone());
    let curve = curve.with_symmetry(Symmetry::about(mirror, &polygon));
    let runner = Runner::curves(vec![curve.expect("a symmetric curve")]);
    let count = |feature| Features::new(runner.polygon()).count(feature);
    assert!(count(Feature::CurvatureExtremum) >= 17);
    let asked = |extrema: f64| {
        // Longer than it takes on any machine.
        let asked = [
            ("extrema", extrema),
            ("inflections", 4.0),
            ("time-limit", 600.0),
        ];
        asked.map(|(name, number)| (name, Value::List(vec![number])))
    };
    let (outcome, curves) = runner.done("harmonise", &asked(11.0));
    let told = &outcome.remarks;
    assert!(told.iter().all(|it| !it.contains("corrected")), "{told:?}");
    check_symmetry(&curves[0]).expect("a symmetric curve");
    let features = Features::new(&curves[0].polygon);
    assert_eq!(features.count(Feature::CurvatureExtremum), 11);
    assert_eq!(features.count(Feature::Inflection), 4);
    assert!(
        matches!(outcome.deviation, Deviation::Measured(by) | Deviation::AtMost(by) if by < 3.0)
    );
    let refused = runner.refused("harmonise", &asked(10.0));
    assert!(
        refused.contains("odd, as the curve is symmetric"),
        "{refused}"
    );
}

/// A random curve that stays symmetric: about the y axis, both axes or a slanted line.
fn symmetric(seed: u64) -> Curve {
    let periodic = seed.is_multiple_of(3);
    let count = 7 + 2 * (seed % 4) as usize + usize::from(periodic);
    let degree = 2 + seed as usize % 4;
    let open = Random(seed).gentle(
        degree,
        count,
        seed.is_multiple_of(7),
        seed.is_multiple_of(5),
    );
    let weights = open.weights().map(<[f64]>::to_vec);
    let polygon = FloatPolygon::new(degree, open.vertices().to_vec(), weights, periodic);
    let polygon = polygon.expect("a polygon");
    let slanted = Mirror::through(DVec3::new(1.0, 2.0, 0.0), DVec3::new(4.0, 6.0, 0.0));
    let mirror = match seed % 4 {
        0 => slanted.expect("a line"),
        _ => MIRROR,
    };
    let both = Symmetry::about_both(mirror, &polygon);
    let symmetry = both.unwrap_or_else(|| Symmetry::about(mirror, &polygon));
    let curve = Curve::new(format!("curve {seed}"), polygon);
    curve.with_symmetry(symmetry).expect("a symmetric curve")
}

#[test]
fn every_operation_keeps_a_symmetric_curve_so_or_says_that_it_does_not() {
    let (mut kept, mut lost) = (0, 0);
    for seed in 0..500 {
        let operation = ALL[seed as usize % ALL.len()];
        let curve = symmetric(seed);
        check_symmetry(&curve).unwrap_or_else(|error| panic!("{seed}: {error}"));
        let runner = Runner::curves(vec![curve]);
        // The seconds that a search has: what it finds is of no account here.
        let hastily = operation
            .parameters
            .iter()
            .find(|it| it.name == "time-limit");
        let hastily = hastily.map(|it| (it.name, Value::List(vec![0.05])));
        let given: Vec<(&str, Value)> = hastily.into_iter().collect();
        let Ok(outcome) = runner.run(operation.name, &given) else {
            continue;
        };
        let before = runner.input_of(operation).document().clone();
        let after: Document = outcome.applied_to(&before).expect("edits that can be made");
        for (_, curve) in after.curves() {
            let checked = check_symmetry(curve);
            checked.unwrap_or_else(|error| panic!("{seed}, {}: {error}", operation.name));
        }
        match after.asymmetric_since(&before).count() {
            0 => kept += 1,
            _ => {
                lost += 1;
                let says = |it: &String| it.contains("does not stay symmetric");
                assert!(
                    outcome.remarks.iter().any(says),
                    "{seed}, {}",
                    operation.name
                );
            }
        }
    }
    println!("{kept} kept, {lost} told that they do not stay symmetric");
    assert!(kept > 200);
}

/// Half of a bottle that was traced by clicks from its base to its neck: its start crosses the axis by a tenth of a
/// millimetre, and not squarely.
const TRACED: [(f64, f64); 20] = [
    (-104.224, -55.8214),
    (-38.1210, 21.5559),
    (4.30064, 26.4193),
    (28.4749, 21.2856),
    (40.4769, 24.7486),
    (44.1884, 29.2239),
    (47.5986, 33.8376),
    (46.6608, 50.4179),
    (42.5922, 75.1486),
    (34.6282, 94.7007),
    (44.7336, 118.794),
    (47.0030, 144.331),
    (47.1906, 157.112),
    (42.6131, 164.648),
    (24.3810, 176.177),
    (11.4790, 187.349),
    (12.9625, 195.244),
    (12.2613, 210.434),
    (13.6225, 269.762),
    (1.63133, 467.486),
];

#[test]
fn a_traced_half_that_meets_the_axis_nearly_squarely_becomes_whole() {
    let half = FloatPolygon::planar(5, &TRACED).expect("a polygon");
    let runner = Runner::of(half.clone());
    // A tolerance that its corner cannot keep is not exceeded.
    let within = ("tolerance", Value::List(vec![1e-4 * half.size()]));
    let outcome = runner.run("make-symmetric", &[within]).expect("an outcome");
    assert!(!outcome.reached && outcome.is_useful());
    // Without one the corner is turned off, and that is said.
    let (outcome, curves) = runner.done("make-symmetric", &[]);
    let told = outcome.warnings.first().map(String::as_str);
    assert!(
        told.is_some_and(|it| it.starts_with("The half met the axis 5.3° askew")),
        "{told:?}"
    );
    let whole = &curves[0].polygon;
    check_is_symmetric(whole);
    let off = SideDeviation::of_curve(&half, whole, &Progress::default()).expect("a distance");
    // What is cut off of the half lies beyond the axis by a tenth of a millimetre.
    assert!(off.largest.distance() < 2.5e-3 * half.size());
    let width = whole.end_jet(End::Finish).point.x - whole.end_jet(End::Start).point.x;
    assert!(width.abs() > 20.0, "{width}");
}

/// The upper side of the aerofoil Aquila, as a fit of its points in per cent of the chord.
const UPPER: [(f64, f64); 9] = [
    (209.00036, -12.63742),
    (154.78224, -8.61668),
    (96.30465, -0.17238),
    (53.69564, 9.1546),
    (14.55549, 10.3837),
    (-0.57567, 2.21578),
    (-0.28941, -0.6506),
    (0.71671, -0.9391),
    (0.94888, -0.64066),
];

#[test]
fn of_both_ends_at_the_axis_the_squarer_one_is_inside() {
    let upper = FloatPolygon::planar(5, &UPPER).expect("a polygon");
    let [tail, nose] = End::BOTH.map(|end| upper.end_jet(end).point);
    assert!(tail.x > 99.0 && nose.x < 1.0 && tail.y.abs().max(nose.y.abs()) < 0.5);
    for half in [upper.reversed(), upper] {
        let level = ("axis", Value::Choice(1));
        let (_, curves) = Runner::of(half.clone()).done("make-symmetric", &[level]);
        let whole = &curves[0].polygon;
        assert!(!whole.is_periodic());
        // The tail stays a corner, of two ends; the nose is round.
        let ends = End::BOTH.map(|end| whole.end_jet(end).point);
        assert!(ends.iter().all(|end| end.x > 99.0), "{ends:?}");
        let middle = whole.point(0.5 * whole.segments() as f64);
        assert!(middle.x < 1.0 && middle.y.abs() < 1e-12, "{middle}");
        let off = SideDeviation::of_curve(&half, whole, &Progress::default());
        let off = off.expect("a distance").largest.distance();
        assert!(off < 5e-3 * half.size(), "{off}");
    }
}

/// Half of a bottle that meets the y axis squarely.
const BOTTLE: [(f64, f64); 14] = [
    (-24.0, 2.0),
    (-12.0, 0.7),
    (0.0, 0.0),
    (12.0, 0.7),
    (24.0, 2.0),
    (33.0, 8.0),
    (38.0, 20.0),
    (39.0, 36.0),
    (35.0, 54.0),
    (28.0, 70.0),
    (22.0, 84.0),
    (20.0, 97.0),
    (23.0, 109.0),
    (28.0, 118.0),
];

#[test]
fn a_half_drawn_beside_the_axis_keeps_its_vertices() {
    // Farther beyond the axis the half is no longer square to it: segments are halved there.
    let near = [0.0, 0.01, -0.01, 0.03, -0.03].map(|beside| (beside, 0.02, 28));
    let far = [(-0.3, 0.05, 41), (-1.0, 0.15, 41)];
    for (beside, within, most) in near.into_iter().chain(far) {
        let vertices = BOTTLE.map(|(x, y)| (x + beside, y));
        let half = FloatPolygon::planar(5, &vertices).expect("a polygon");
        for half in [half.reversed(), half] {
            let runner = Runner::of(half.clone());
            let given = ("tolerance", Value::List(vec![within]));
            let (outcome, curves) = runner.done("make-symmetric", &[given]);
            assert!(outcome.reached, "{beside}: {:?}", outcome.remarks);
            let whole = &curves[0].polygon;
            check_is_symmetric(whole);
            assert!(
                whole.vertices().len() <= most,
                "{beside}: {}",
                whole.vertices().len()
            );
            let ends = End::BOTH.map(|end| whole.end_jet(end).point);
            let outer = half.vertices()[0].y < half.vertices()[13].y;
            let outer = if outer { End::Finish } else { End::Start };
            let outer = half.end_jet(outer).point;
            assert!(
                ends.iter().any(|end| end.distance(outer) < within),
                "{beside}"
            );
        }
    }
}
