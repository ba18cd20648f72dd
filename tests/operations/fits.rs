//! Fits of points: what is reported of them.

use batten::document::Document;
use batten::geometry::Progress;
use batten::operations::{Deviation, Operands, Report, Value};
use glam::DVec3;

use super::runner::operation;

/// A wave, in steps that are even along x.
fn wave(count: usize) -> Vec<DVec3> {
    let place = |index: usize| 6.0 * index as f64 / (count - 1) as f64;
    let points = (0..count).map(place);
    points.map(|x| DVec3::new(x, x.sin(), 0.0)).collect()
}

fn report(points: Vec<DVec3>, given: &[(&'static str, f64)]) -> Result<Report, String> {
    let input = Operands::new(&Document::default(), []).map_err(|error| error.to_string())?;
    let input = input.with_points(points);
    let fit = operation("fit");
    let given = given.iter().map(|(name, number)| match *name {
        "degree" => (*name, Value::Whole(*number as usize)),
        _ => (*name, Value::List(vec![*number])),
    });
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
fn a_fit_that_any_number_of_extrema_would_bring_much_nearer_says_so() {
    let found = report(wave(60), &[("extrema", 1.0), ("count", 12.0)]).expect("a fit");
    assert!(found.reached, "{found:?}");
    let [remark] = &found.remarks[..] else {
        panic!("{:?}", found.remarks);
    };
    assert!(
        remark
            .starts_with("With any number of extrema 12 vertices come nearer to the points: RMS "),
        "{remark}"
    );
    let json = serde_json::json!(found);
    assert!(json["rms"].as_f64() > json["rms_of_any"].as_f64(), "{json}");
    let near = report(wave(60), &[("extrema", 2.0), ("count", 12.0)]).expect("a fit");
    assert!(near.reached && near.remarks.is_empty(), "{near:?}");
}

#[test]
fn a_tolerance_that_is_missed_is_told_with_what_is_missed() {
    let found = report(wave(60), &[("tolerance", 1e-9), ("count", 8.0)]).expect("a fit");
    assert!(!found.reached);
    let [remark] = &found.remarks[..] else {
        panic!("{:?}", found.remarks);
    };
    assert!(remark.contains("the tolerance is 1e-9"), "{remark}");
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
fn a_tolerance_that_nothing_keeps_is_missed_by_as_little_as_was_tried() {
    let mut points = wave(60);
    for (index, point) in points.iter_mut().enumerate() {
        point.y += 0.1 * (2.4 * (index * index) as f64).sin();
    }
    let tolerance = ("tolerance", 1e-17);
    let off = |given: &[(&'static str, f64)]| {
        let found = report(points.clone(), given).expect("a fit");
        assert!(!found.reached, "{found:?}");
        let Deviation::FromPoints(off) = found.deviation else {
            panic!("{:?}", found.deviation);
        };
        (off, found.remarks)
    };
    let (nearest, remarks) = off(&[tolerance]);
    for count in [6, 7, 9, 11, 13, 16, 19, 23, 27, 32, 38, 45, 53, 60] {
        let (other, _) = off(&[tolerance, ("count", f64::from(count))]);
        assert!(nearest <= other, "{count}: {nearest} {other}");
    }
    assert!(!remarks.join(" ").contains("extrema"), "{remarks:?}");
}
