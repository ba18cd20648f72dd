//! Moves that lose a feature.

use batten::geometry::features::{Feature, Features};
use batten::geometry::vertex_moves::{FeatureLoss, FeatureRise, LossSearch};
use batten::geometry::{FloatPolygon, Progress};

use crate::curves::{case, moved, proved};

fn losses(polygon: &FloatPolygon, quantity: Feature, u: f64) -> Vec<FeatureLoss> {
    let search = LossSearch {
        polygon,
        proved: &proved(polygon),
        quantity,
        u,
    };
    let found = search.run(&Progress::default());
    found
        .expect("a planar curve without doubts")
        .expect("moves")
}

/// The middles of all features of a kind.
fn places(features: &Features, quantity: Feature) -> Vec<f64> {
    let intervals: Vec<[f64; 2]> = match quantity {
        Feature::Inflection => features.inflections.iter().map(|root| root.u).collect(),
        _ => {
            let extrema = features.curvature_extrema.iter();
            extrema.map(|extremum| extremum.u).collect()
        }
    };
    intervals
        .iter()
        .map(|[low, high]| 0.5 * (low + high))
        .collect()
}

#[test]
fn every_move_is_proved_to_lose_a_feature_and_to_add_none() {
    let (mut chosen, mut found, mut vertices) = (0, 0, 0);
    for number in (0..112).step_by(4) {
        let polygon = case(number).polygon;
        let before = Features::new(&polygon);
        for quantity in [Feature::CurvatureExtremum, Feature::Inflection] {
            let Some(u) = places(&before, quantity).first().copied() else {
                continue;
            };
            let losses = losses(&polygon, quantity, u);
            chosen += 1;
            found += usize::from(losses.iter().any(|loss| loss.to.is_some()));
            vertices += losses.len();
            for loss in &losses {
                let Some(to) = loss.to else {
                    continue;
                };
                let distance = loss.distance().expect("a move");
                assert!(distance <= loss.limit);
                let after = Features::new(&moved(&polygon, loss.vertex, to));
                assert!(after.count(quantity) < before.count(quantity));
                assert!(FeatureRise::between(&before, &after).is_none());
            }
        }
    }
    println!("{chosen} features, {found} can be lost by a vertex of {vertices}");
    assert!(2 * found > chosen, "{found} of {chosen}");
}

/// A dent in a nearly round arc makes extrema; moving the dented vertex back is the shortest way to
/// lose one.
#[test]
fn a_dent_is_lost_by_moving_its_vertex_back() {
    let angle = |index: i32| 0.25 * f64::from(index) + 0.004 * f64::from(index * index);
    let mut points: Vec<(f64, f64)> = vec![(0.0, 0.0)];
    for index in 0..14 {
        let (x, y) = points[points.len() - 1];
        points.push((x + angle(index).cos(), y + angle(index).sin()));
    }
    let clean = FloatPolygon::planar(4, &points).expect("a polygon");
    assert_eq!(
        Features::new(&clean).count(Feature::CurvatureExtremum),
        0,
        "a spiral"
    );
    let dented = 7;
    let place = clean.vertices()[dented];
    let polygon = moved(&clean, dented, place * 1.01);
    let before = Features::new(&polygon);
    let extrema = places(&before, Feature::CurvatureExtremum);
    assert!(!extrema.is_empty());
    for u in extrema {
        let losses = losses(&polygon, Feature::CurvatureExtremum, u);
        let own = losses.iter().find(|loss| loss.vertex == dented);
        let own = own.expect("the vertex is near").distance().expect("a move");
        // Going all the way back loses every extremum, so the shortest way is no longer.
        let back = place.distance(polygon.vertices()[dented]);
        assert!(own <= 1.01 * back, "{own} {back}");
    }
}

#[test]
fn a_cancelled_search_finds_nothing() {
    let polygon = case(0).polygon;
    let cancelled = Progress::default();
    cancelled.cancel();
    let search = LossSearch {
        polygon: &polygon,
        proved: &proved(&polygon),
        quantity: Feature::CurvatureExtremum,
        u: 0.5,
    };
    assert_eq!(search.run(&cancelled), Ok(None));
}
