//! What is kept up to date vertex by vertex is what would be made anew.

mod common;

use std::sync::Arc;

use batten::analysis::{CurveAnalysis, Flow, LevelPlot};
use batten::document::Curve;
use batten::editor::{
    ChainOutlines, CombSettings, CurveOutlines, Legs, Orientation, PieceTrend, ViewBox,
};
use batten::geometry::features::Features;
use batten::geometry::harmony::Harmony;
use batten::geometry::{FloatPolygon, Progress};
use common::Random;
use glam::{DVec2, DVec3};

/// Edits of each curve.
const EDITS: usize = 12;

/// The plots that are kept, one of a curve.
const PLOTS: [LevelPlot; 2] = [LevelPlot::CURVATURE, LevelPlot::Curvature(2)];

/// How far closed polygons may differ that are converted whole and in part, in units of the
/// curve's size.
const CONVERSION: f64 = 8.0 * f64::EPSILON;

fn random_polygon(random: &mut Random, degree: usize) -> FloatPolygon {
    let count = degree + 1 + (random.bits() % 120) as usize;
    let in_space = random.bits().is_multiple_of(3);
    let vertices =
        (0..count).map(|i| DVec3::new(i as f64, 0.0, 0.0) + random.vector(2.0, in_space));
    let vertices = vertices.collect();
    let weights = random.bits().is_multiple_of(2);
    let weights = weights.then(|| (0..count).map(|_| random.between(0.5, 2.0)).collect());
    let periodic = random.bits().is_multiple_of(3);
    FloatPolygon::new(degree, vertices, weights, periodic).expect("a valid polygon")
}

fn edit(random: &mut Random, polygon: &mut FloatPolygon) {
    let count = polygon.vertices().len() as u64;
    for _ in 0..1 + random.bits() % 3 {
        let index = (random.bits() % count) as usize;
        let in_space = !polygon.is_planar();
        let place = polygon.vertex(index) + random.vector(1.0, in_space);
        match random.bits() % 8 {
            // The first weight turns a polynomial curve into a rational one.
            0..=2 if polygon.is_rational() || random.bits().is_multiple_of(8) => polygon
                .set_weight(index, random.between(0.2, 5.0))
                .expect("a valid weight"),
            // Off the plane, and perhaps back to it.
            3 => {
                let z = (random.bits() % 2) as f64;
                let place = DVec3::new(place.x, place.y, z);
                polygon
                    .move_vertices(vec![(index, place)])
                    .expect("a valid place");
            }
            _ => polygon
                .move_vertices(vec![(index, place)])
                .expect("a valid place"),
        }
    }
}

/// The outlines of a curve and of its float S-polygon, kept from edit to edit.
#[derive(Default)]
struct Outlines {
    curve: CurveOutlines,
    float: ChainOutlines,
}

/// What is drawn of a curve, and one plot of it, gaps included.
fn drawn(
    analysis: &mut CurveAnalysis,
    outlines: &mut Outlines,
    eye: Orientation,
    plot: LevelPlot,
) -> Vec<[u64; 2]> {
    let view = ViewBox {
        low: DVec2::new(-20.0, -20.0),
        high: DVec2::new(150.0, 20.0),
        pixel: 0.05,
    };
    let mut points = Vec::new();
    let Outlines { curve, float } = outlines;
    let sampled = analysis.sampled();
    curve.update(sampled, eye);
    let segments = analysis.proved_segments().expect("all is proved");
    for trend in PieceTrend::ALL {
        curve.append_trend(sampled, segments, trend, &view, &mut points);
    }
    curve.append_curve(sampled, &view, &mut points);
    curve.append_evolute(sampled, &view, &mut points);
    let comb = CombSettings {
        scale: 3.0,
        density: 5,
    };
    curve.append_comb(sampled, &view, &comb, &mut points);
    let mut teeth = Vec::new();
    curve.append_teeth(sampled, &view, &comb, &mut teeth);
    points.extend(teeth.into_flattened());
    let mut dots = Vec::new();
    analysis.append_discrete_curvature(None, &mut dots);
    points.extend(dots.into_iter().map(|(_, place)| place));
    analysis.append_levels(plot, false, &mut points);
    for flow in Flow::ALL {
        analysis.float().append_flow(flow, &mut points);
    }
    float.update(analysis.float(), eye);
    let mut legs = Legs::default();
    float.append_legs(analysis.float(), 0, None, &view, &mut legs);
    for (chain, strength) in legs.chains() {
        points.extend(chain);
        points.push(DVec2::splat(f64::from(strength)));
    }
    float.append_discs(analysis.float(), &view, |index, place, size| {
        points.extend([place, DVec2::new(index as f64, f64::from(size))]);
    });
    let bits = |point: DVec2| point.to_array().map(f64::to_bits);
    points.into_iter().map(bits).collect()
}

/// Prove what is not proved yet.
fn proved(analysis: &mut CurveAnalysis) -> Features {
    if let Some(proof) = analysis.proof() {
        analysis.take_proof(proof.run(&Progress::default()));
    }
    analysis.known_features().expect("all is proved").clone()
}

/// Measure the harmony.
fn measured(analysis: &mut CurveAnalysis) -> Harmony {
    if let Some(measurement) = analysis.harmony_measurement() {
        let measured = measurement.run(&Progress::default());
        analysis.take_harmony(measured.expect("it is not cancelled"));
    }
    analysis.harmony().expect("it is measured").clone()
}

#[test]
fn an_edited_curve_is_analysed_as_if_it_were_new() {
    let mut random = Random(12);
    for (degree, plot) in (1..=9).cycle().take(27).zip(PLOTS.into_iter().cycle()) {
        let mut polygon = random_polygon(&mut random, degree);
        let eye = if degree % 2 == 0 {
            Orientation::isometric()
        } else {
            Orientation::default()
        };
        let curve = |polygon: &FloatPolygon| Arc::new(Curve::new("curve", polygon.clone()));
        let mut kept = CurveAnalysis::new(curve(&polygon));
        let mut outlines = Outlines::default();
        for number in 0..EDITS {
            proved(&mut kept);
            drawn(&mut kept, &mut outlines, eye, plot);
            edit(&mut random, &mut polygon);
            let curve = curve(&polygon);
            kept.update(&curve);
            let mut fresh = CurveAnalysis::new(curve);
            for segment in 0..polygon.segments() {
                let [kept, fresh] = [&kept, &fresh].map(|analysis| analysis.samples());
                assert_eq!(kept.piece(segment), fresh.piece(segment));
            }
            assert_eq!(kept.harmony(), None, "it was another curve's");
            assert_eq!(proved(&mut kept), proved(&mut fresh));
            // What was measured some edits ago spares work too.
            if number % 3 == 0 {
                assert_eq!(measured(&mut kept), measured(&mut fresh));
            }
            assert_eq!(kept.samples().length(), fresh.samples().length());
            let made_anew = drawn(&mut fresh, &mut Outlines::default(), eye, plot);
            assert_eq!(drawn(&mut kept, &mut outlines, eye, plot), made_anew);
            let [old, new] = [&kept, &fresh].map(|analysis| analysis.clamped().vertices());
            let pairs = old.iter().zip(new);
            for (kept, fresh) in pairs {
                assert!(kept.distance(*fresh) <= CONVERSION * polygon.size());
            }
        }
    }
}

#[test]
fn a_proof_counts_for_segments_that_did_not_change_meanwhile() {
    let points: Vec<_> = (0..20)
        .map(|i| (f64::from(i), (1.1 * f64::from(i)).sin()))
        .collect();
    let before = FloatPolygon::planar(3, &points).expect("a valid polygon");
    let curve = Arc::new(Curve::new("curve", before.clone()));
    let mut analysis = CurveAnalysis::new(curve.clone());
    let stale = analysis.proof().expect("nothing is proved");
    let mut after = before.clone();
    after
        .move_vertices([(10, DVec3::new(10.0, 5.0, 0.0))])
        .expect("a valid place");
    analysis.update(&Arc::new(Curve::new("curve", after.clone())));
    // What was begun for the curve before leaves open the segments that the vertex touches.
    analysis.take_proof(stale.run(&Progress::default()));
    assert_eq!(analysis.segments_proved(), 13);
    assert_eq!(analysis.proof_progress(), 1.0 - 4.0 / 17.0);
    assert_eq!(analysis.known_features(), None);
    let rest = analysis.proof().expect("four segments are open");
    // Cancelled before it began, it proves nothing.
    let cancelled = Progress::default();
    cancelled.cancel();
    analysis.take_proof(rest.run(&cancelled));
    assert_eq!(analysis.segments_proved(), 0);
    analysis.take_proof(rest.run(&Progress::default()));
    assert_eq!(analysis.segments_proved(), 4);
    assert_eq!(analysis.known_features(), Some(&Features::new(&after)));
    // Back to the very curve that it was made of, the stale proof counts for nothing.
    analysis.update(&curve);
    analysis.take_proof(stale.run(&Progress::default()));
    assert_eq!(analysis.segments_proved(), 0);
    assert_eq!(proved(&mut analysis), Features::new(&before));
}

#[test]
fn a_straight_stretch_has_the_curvature_zero() {
    for degree in [3, 5] {
        let straight: Vec<(f64, f64)> = (0..9)
            .map(|it| (0.1 * f64::from(it), 0.3 * f64::from(it)))
            .collect();
        let polygon = FloatPolygon::planar(degree, &straight).expect("a polygon");
        let analysis = CurveAnalysis::new(Arc::new(Curve::new("line", polygon)));
        let curvature = analysis.curvature().expect("a curvature");
        assert_eq!([curvature.low, curvature.high], [0.0; 2]);
        // Bends to one side keep theirs; the stretch before them is straight.
        let bent = straight
            .iter()
            .copied()
            .chain([(0.9, 3.5), (0.7, 4.0), (0.4, 4.2)]);
        let polygon = FloatPolygon::planar(degree, &bent.collect::<Vec<_>>()).expect("a polygon");
        let analysis = CurveAnalysis::new(Arc::new(Curve::new("bend", polygon)));
        let curvature = analysis.curvature().expect("a curvature");
        assert!(
            curvature.low == 0.0 && curvature.high > 0.1,
            "{curvature:?}"
        );
    }
}
