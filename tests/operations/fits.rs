//! Fits of points: what is reported of them.

use std::f64::consts::PI;

use batten::document::{Curve, Document, Edit};
use batten::geometry::features::{Feature, Features, Turning};
use batten::geometry::{End, FloatPolygon, Progress};
use batten::operations::fit::{curves, left_out, with_point_switched};
use batten::operations::{Deviation, Operands, Report, Value};
use glam::DVec3;

use super::runner::operation;
use crate::common::Random;

/// How far ends that meet are apart, in units of outlines of a size of 20.
const MET: f64 = 1e-12;

/// A wave, in steps that are even along x.
fn wave(count: usize) -> Vec<DVec3> {
    let place = |index: usize| 6.0 * index as f64 / (count - 1) as f64;
    let points = (0..count).map(place);
    points.map(|x| DVec3::new(x, x.sin(), 0.0)).collect()
}

fn report(points: Vec<DVec3>, given: &[(&'static str, f64)]) -> Result<Report, String> {
    let given = given.iter().map(|(name, number)| match *name {
        "degree" => (*name, Value::Whole(*number as usize)),
        _ => (*name, Value::List(vec![*number])),
    });
    report_of(points, given.collect())
}

/// Read values as they are typed.
fn typed(points: Vec<DVec3>, texts: &[(&'static str, &str)]) -> Result<Report, String> {
    let parameters = operation("fit").parameters.iter();
    let read = |(name, text): &(&'static str, &str)| {
        let parameter = parameters.clone().find(|it| it.name == *name);
        let parameter = parameter.expect("a parameter");
        let value = parameter.read(text).map_err(|error| error.to_string())?;
        assert_eq!(parameter.text(&value).replace(' ', ""), *text);
        Ok((*name, value))
    };
    report_of(
        points,
        texts.iter().map(read).collect::<Result<_, String>>()?,
    )
}

/// The curves of a fit that reaches what is asked.
fn fitted(points: Vec<DVec3>, given: Vec<(&'static str, Value)>) -> Vec<Curve> {
    let input = Operands::new(&Document::default(), []).expect("no curves");
    let input = input.with_points(points);
    let fit = operation("fit");
    let values = fit.values(&input, given).expect("values");
    let outcome = fit.run(&input, &values, &Progress::default());
    let outcome = outcome.expect("a fit");
    assert!(outcome.reached, "{:?}", outcome.remarks);
    let curve = |edit| match edit {
        Edit::Add(curve) => *curve,
        edit => panic!("{edit:?}"),
    };
    outcome.edits.into_iter().map(curve).collect()
}

/// Where a curve begins and ends.
fn ends(polygon: &FloatPolygon) -> [DVec3; 2] {
    End::BOTH.map(|end| polygon.end_jet(end).point)
}

fn report_of(points: Vec<DVec3>, given: Vec<(&'static str, Value)>) -> Result<Report, String> {
    let input = Operands::new(&Document::default(), []).map_err(|error| error.to_string())?;
    let input = input.with_points(points);
    let fit = operation("fit");
    let told = |error: batten::operations::OperationError| error.to_string();
    let values = fit.values(&input, given).map_err(told)?;
    let outcome = fit
        .run(&input, &values, &Progress::default())
        .map_err(told)?;
    Ok(Report::new(fit, &input, &outcome))
}

#[test]
fn distances_are_from_the_points_and_a_list_of_no_outliers_is_left_out() {
    let found = report(wave(60), &[]).expect("a fit");
    assert!(matches!(found.deviation, Deviation::FromPoints(off) if off < 0.01));
    let text = found.text();
    assert!(text.contains("Fit points: off the points by "), "{text}");
    assert!(text.contains("\nOutliers: 0\n"), "{text}");
    assert!(!text.contains("Outlying points"), "{text}");
    assert_eq!(
        serde_json::json!(found)["outlying_points"],
        serde_json::json!([])
    );
    let mut points = wave(60);
    points[30].y += 1.0;
    let text = report(points, &[]).expect("a fit").text();
    assert!(
        text.contains("\nOutliers: 1\nOutlying points: 30\n"),
        "{text}"
    );
}

#[test]
fn what_each_number_of_extrema_reaches_is_reported() {
    let found = report(wave(60), &[("tolerance", 2e-3)]).expect("a fit");
    assert!(found.reached && found.remarks.is_empty(), "{found:?}");
    let json = serde_json::json!(found);
    let rows = json["trade_off"].as_array().expect("rows");
    let numbers: Vec<_> = rows.iter().map(|row| row["extrema"].as_u64()).collect();
    // The fewest that keep the tolerance, and a few more to choose from.
    assert_eq!(numbers[..3], [Some(0), Some(1), Some(2)], "{json}");
    assert!(numbers.len() > 3, "{json}");
    let largest: Vec<f64> = rows
        .iter()
        .filter_map(|row| row["largest"].as_f64())
        .collect();
    assert!(
        largest[0] > 2e-3 && largest[1] > 2e-3 && largest[2] <= 2e-3,
        "{json}"
    );
    let fixed = report(wave(60), &[("extrema", 1.0), ("tolerance", 2e-3)]).expect("a fit");
    assert!(!fixed.reached);
    assert_eq!(serde_json::json!(fixed)["least_extrema"], 2);
}

#[test]
fn outliers_are_isolated_kept_or_named() {
    let mut points = wave(60);
    points[30].y += 1.0;
    let outlying = |texts: &[(&'static str, &str)]| {
        let found = typed(points.clone(), texts).expect("a fit");
        serde_json::json!(found)["outlying_points"].clone()
    };
    assert_eq!(outlying(&[]), serde_json::json!([30]));
    assert_eq!(
        outlying(&[("outliers", "isolated"), ("extrema", "fewest")]),
        serde_json::json!([30])
    );
    assert_eq!(
        outlying(&[("outliers", "keep"), ("extrema", "2")]),
        serde_json::json!([])
    );
    assert_eq!(
        outlying(&[("outliers", "1,30")]),
        serde_json::json!([1, 30])
    );
    // With a tolerance all points count, unless something else is asked for.
    assert_eq!(
        outlying(&[("tolerance", "0.01"), ("time-limit", "1")]),
        serde_json::json!([])
    );
    let left_out = [("tolerance", "0.01"), ("outliers", "isolated")];
    assert_eq!(outlying(&left_out), serde_json::json!([30]));
    let refused = typed(points.clone(), &[("outliers", "60")]).expect_err("there are 60");
    assert!(refused.contains("below 60"), "{refused}");
    let refused = typed(points.clone(), &[("outliers", "kept")]).expect_err("no word");
    assert!(
        refused.contains("isolated, or keep, or whole numbers"),
        "{refused}"
    );
}

#[test]
fn a_tolerance_that_is_missed_is_told_with_what_is_missed() {
    let found = report(wave(60), &[("tolerance", 1e-9), ("count", 8.0)]).expect("a fit");
    assert!(!found.reached);
    let [missed, below] = &found.remarks[..] else {
        panic!("{:?}", found.remarks);
    };
    assert!(missed.contains("the tolerance is 1e-9"), "{missed}");
    assert!(below.contains("below the estimated noise"), "{below}");
}

#[test]
fn too_few_points_are_refused_with_the_number_that_the_degree_needs() {
    let refused = report(wave(4), &[("degree", 5.0)]).expect_err("too few");
    assert_eq!(
        refused,
        "4 different points are too few for a curve of degree 5: at least 6 points that differ from the one before are needed, or a lower degree"
    );
}

#[test]
fn a_tolerance_below_the_noise_gives_the_nearest_that_was_found() {
    let mut points = wave(60);
    for (index, point) in points.iter_mut().enumerate() {
        point.y += 0.1 * (2.4 * (index * index) as f64).sin();
    }
    let found = report(points, &[("tolerance", 1e-17)]).expect("a fit");
    assert!(!found.reached, "{found:?}");
    let Deviation::FromPoints(off) = found.deviation else {
        panic!("{:?}", found.deviation);
    };
    let json = serde_json::json!(found);
    let rows = json["trade_off"].as_array().expect("rows");
    let largest = rows.iter().filter_map(|row| row["largest"].as_f64());
    let nearest = largest.fold(f64::INFINITY, f64::min);
    assert!(off <= 1.0001 * nearest && nearest < 0.25, "{off} {nearest}");
    assert!(
        json["noise"].as_f64().is_some_and(|noise| noise > 0.03),
        "{json}"
    );
}

#[test]
fn a_symmetric_fit_to_points_that_are_not_says_so() {
    let given = [("symmetric", "x")];
    let lopsided = typed(wave(40), &given).expect("a fit");
    let text = lopsided.text();
    assert!(!lopsided.reached, "{text}");
    assert!(
        text.contains("not their own mirror image: one is"),
        "{text}"
    );
    let even = typed(wave(40), &[("symmetric", "x"), ("extrema", "2")]);
    assert_eq!(
        even.unwrap_err(),
        "Curvature extrema: 2 is out of range: odd, as the curve is symmetric, is needed"
    );
}

#[test]
fn the_points_that_are_left_out_are_known_before_the_fit() {
    let corner = |index: usize| match index {
        0..25 => DVec3::new(0.1 * index as f64, 0.1 * (0.12 * index as f64).sin(), 0.0),
        _ => DVec3::new(2.4, 0.026 + 0.1 * (index as f64 - 24.0), 0.0),
    };
    let mut corner: Vec<DVec3> = (0..49).map(corner).collect();
    corner[35].x += 0.15;
    let mut spiral = wave(40);
    for (index, point) in spiral.iter_mut().enumerate() {
        point.z = 0.1 * index as f64;
    }
    spiral[20].z += 0.7;
    let mut flat = wave(40);
    flat[17].y += 0.4;
    for (points, texts) in [
        (&flat, &[][..]),
        (&flat, &[("outliers", "keep")]),
        (&flat, &[("outliers", "3,17,30")]),
        (&flat, &[("tolerance", "0.5")]),
        (&corner, &[("split-corners", "on")]),
        (&corner, &[("split-corners", "on"), ("outliers", "24,40")]),
        (&spiral, &[]),
    ] {
        let fit = operation("fit");
        let input = Operands::new(&Document::default(), []).expect("no curves");
        let input = input.with_points(points.clone());
        let read = |(name, text): &(&'static str, &str)| {
            let mut parameters = fit.parameters.iter();
            let parameter = parameters.find(|it| it.name == *name).expect("a parameter");
            (*name, parameter.read(text).expect("a value"))
        };
        let count = ("count", Value::List(vec![9.0]));
        let given = texts.iter().map(read).chain([count]);
        let values = fit.values(&input, given).expect("values");
        let outcome = fit.run(&input, &values, &Progress::default());
        let outcome = outcome.expect("a fit");
        let report = serde_json::json!(Report::new(fit, &input, &outcome));
        let known = left_out(&input, &values).expect("points");
        assert_eq!(
            report["outlying_points"],
            serde_json::json!(known),
            "{texts:?}"
        );
        assert_eq!(curves(&input, &values), outcome.edits.len(), "{texts:?}");
        for point in known {
            let (name, switched) =
                with_point_switched(&input, &values, point).expect("another value");
            let without = fit.values_with(&input, &values, [(name, switched)]);
            let without = left_out(&input, &without.expect("values")).expect("points");
            assert!(!without.contains(&point), "{texts:?} {point}");
        }
    }
}

/// The outline of a D: half a circle of radius 10 and its diameter, which begins in the middle of the half circle.
fn outline(last_repeats: bool) -> Vec<DVec3> {
    let arc = (0..=40).map(|it| {
        let angle = PI * (f64::from(it) / 40.0 - 0.5);
        DVec3::new(10.0 * angle.cos(), 10.0 * angle.sin(), 0.0)
    });
    let line = (1..20).map(|it| DVec3::new(0.0, 10.0 - f64::from(it), 0.0));
    let mut points: Vec<DVec3> = arc.chain(line).collect();
    points.rotate_left(20);
    points.extend(last_repeats.then(|| points[0]));
    points
}

#[test]
fn closed_points_are_split_at_their_corners() {
    for last_repeats in [false, true] {
        let values = vec![
            ("periodic", Value::Switch(true)),
            ("split-corners", Value::Switch(true)),
        ];
        let found = report_of(outline(last_repeats), values.clone()).expect("two fits");
        assert!(found.reached, "{}", found.text());
        let input = Operands::new(&Document::default(), []).expect("no curves");
        let input = input.with_points(outline(last_repeats));
        let values = operation("fit").values(&input, values).expect("values");
        assert_eq!(curves(&input, &values), 2);
    }
    let found = report_of(outline(false), vec![("periodic", Value::Switch(true))]).expect("a fit");
    assert!(
        found.text().contains("corners at 20, 40"),
        "{}",
        found.text()
    );
}

#[test]
fn pieces_of_closed_points_meet_at_their_corners() {
    let split = ("split-corners", Value::Switch(true));
    let pieces = fitted(outline(true), vec![split]);
    assert_eq!(pieces.len(), 2);
    let [[a, b], [c, d]] = [ends(&pieces[0].polygon), ends(&pieces[1].polygon)];
    for (end, start) in [(b, c), (d, a)] {
        assert!(end.distance(start) <= MET, "{end} {start}");
        assert!((end.y.abs() - 10.0).abs() <= MET, "{end}");
    }
}

#[test]
fn straight_pieces_keep_exact_ends() {
    let points: Vec<DVec3> = [0.0, 1.0, 2.5, 3.0, 4.5, 6.0, 7.0, 8.0]
        .map(|x| DVec3::new(x, 0.5 * x, 0.0))
        .into();
    let exact = ("ends", Value::Choice(1));
    let line = fitted(points.clone(), vec![exact]);
    let found = ends(&line[0].polygon);
    for (found, point) in found.into_iter().zip([points[0], points[7]]) {
        assert!(found.distance(point) <= MET, "{found}");
    }
}

#[test]
fn ends_without_curvature_are_no_inflections() {
    let half = wave(60).into_iter().filter(|point| point.x <= PI);
    let half: Vec<DVec3> = half.collect();
    for inflections in [vec![], vec![0.0]] {
        let zero = || Value::List(vec![0.0]);
        let found = fitted(
            half.clone(),
            vec![
                ("extrema", Value::List(vec![1.0])),
                ("inflections", Value::List(inflections)),
                ("start-curvature", zero()),
                ("end-curvature", zero()),
            ],
        );
        let features = Features::new(&found[0].polygon);
        assert_eq!(features.count(Feature::Inflection), 0);
        assert_eq!(features.count(Feature::CurvatureExtremum), 1);
    }
}

#[test]
fn a_ring_that_closes_but_for_rounding_goes_round_once() {
    let ring = (0..=60).map(|it| {
        let angle = 2.0 * PI * f64::from(it) / 60.0;
        DVec3::new(angle.cos(), angle.sin(), 0.0)
    });
    let ring: Vec<DVec3> = ring.collect();
    assert!(ring[0] != ring[60]);
    let periodic = ("periodic", Value::Switch(true));
    let found = fitted(ring, vec![periodic]);
    let turns = Turning::new(&found[0].polygon).total() / (2.0 * PI);
    assert!((turns - 1.0).abs() <= 1e-9, "{turns}");
}

#[test]
fn a_piece_that_has_no_fit_is_named() {
    let values = vec![
        ("periodic", Value::Switch(true)),
        ("split-corners", Value::Switch(true)),
        ("extrema", Value::List(vec![18.0])),
    ];
    let error = report_of(outline(false), values).expect_err("too few points");
    assert!(error.contains("piece 1, points 20 to 40: "), "{error}");
}

#[test]
fn points_far_off_the_curve_are_told() {
    for (extrema, is_told) in [(0.0, true), (2.0, false)] {
        let found = report(wave(60), &[("extrema", extrema)]).expect("a fit");
        let told = found
            .warnings
            .iter()
            .any(|it| it.starts_with("Points lie up to "));
        assert_eq!(told, is_told, "{extrema}: {:?}", found.warnings);
    }
}

#[test]
fn an_end_that_dives_between_noisy_points_is_told() {
    // Points of an arc with noise; where the tail of the last ones leads inwards the curvature dives.
    let arc = |bent: f64| -> Vec<DVec3> {
        let mut random = Random(3);
        let points = (0..80).map(|index| {
            let share = f64::from(index) / 79.0;
            let radius = 100.0 + random.between(-0.5, 0.5) - bent * (share - 0.9).max(0.0).powi(2);
            let angle = (150.0 - 120.0 * share).to_radians();
            radius * DVec3::new(angle.cos(), angle.sin(), 0.0)
        });
        points.collect()
    };
    for (bent, is_told) in [(0.0, false), (600.0, true)] {
        let found = report(arc(bent), &[]).expect("a fit");
        let told = found
            .warnings
            .iter()
            .any(|it| it.starts_with("The end bends to the radius"));
        assert_eq!(told, is_told, "{bent}: {:?}", found.warnings);
    }
}

#[test]
fn noisy_points_of_an_arch_get_its_one_extremum_and_no_inflection() {
    let mut random = Random(5);
    for trial in 0..5 {
        // Errors with a standard deviation of 0.25, as sums of twelve even ones.
        let mut error = || 0.25 * (0..12).map(|_| random.between(-0.5, 0.5)).sum::<f64>();
        let points: Vec<DVec3> = (0..80)
            .map(|index| {
                let t = f64::from(index) / 79.0;
                let y = 25.0 * (PI * (0.05 + 0.9 * t)).sin();
                DVec3::new(100.0 * t + error(), y + error(), 0.0)
            })
            .collect();
        let [curve] = fitted(points.clone(), Vec::new()).try_into().expect("one");
        let features = Features::new(&curve.polygon);
        let [extrema, inflections] =
            [Feature::CurvatureExtremum, Feature::Inflection].map(|it| features.count(it));
        assert_eq!([extrema, inflections], [1, 0], "trial {trial}");
        let report = report_of(points, Vec::new()).expect("a fit");
        let rms = report.figure("rms");
        assert!(
            matches!(rms, Some(Value::Real(rms)) if rms < 1.2 * 0.25),
            "trial {trial}: {rms:?}"
        );
    }
}
