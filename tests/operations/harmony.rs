//! Harmonising, and what can be asked of ends by values.

use batten::document::Edit;
use batten::geometry::end_correction::EndTarget;
use batten::geometry::features::{Feature, Features};
use batten::geometry::{ClampedPolygon, End, FloatPolygon};
use batten::operations::{Deviation, OperationError, Value};
use glam::DVec3;

use crate::common::Random;
use crate::runner::Runner;

/// What is left at an end that meets its target, in units of the curve's size.
const MET: f64 = 1e-12;

/// An arc of a growing curvature, with noise.
fn noisy() -> Runner {
    let mut random = Random(3);
    let mut angle: f64 = 0.0;
    let mut point = DVec3::ZERO;
    let vertices = (0..30).map(|index| {
        angle += 0.02 + 0.004 * f64::from(index);
        point += DVec3::new(angle.cos(), angle.sin(), 0.0);
        point + random.vector(0.05, false)
    });
    let polygon = FloatPolygon::new(5, vertices.collect(), None, false).expect("valid");
    Runner::of(polygon)
}

fn extrema(polygon: &FloatPolygon) -> usize {
    Features::new(polygon).count(Feature::CurvatureExtremum)
}

fn list(numbers: &[f64]) -> Value {
    Value::List(numbers.to_vec())
}

fn monotone() -> [(&'static str, Value); 2] {
    ["extrema", "inflections"].map(|name| (name, list(&[0.0])))
}

#[test]
fn a_noisy_arc_becomes_monotone_and_keeps_its_ends() {
    let runner = noisy();
    assert!(extrema(runner.polygon()) > 5);
    let (outcome, curves) = runner.done("harmonise", &monotone());
    let found = &curves[0].polygon;
    assert_eq!(extrema(found), 0);
    assert!(matches!(outcome.deviation, Deviation::AtMost(bound) if bound < 0.5));
    for end in End::BOTH {
        let [before, after] = [runner.polygon(), found].map(|polygon| polygon.end_jet(end));
        let size = found.size();
        assert!(before.point.distance(after.point) <= MET * size);
        let tangents = [before, after].map(|jet| jet.tangent().expect("a tangent"));
        assert!(tangents[0].distance(tangents[1]) <= MET);
    }
}

#[test]
fn a_monotone_curve_is_left_as_it_is() {
    let (_, curves) = noisy().done("harmonise", &monotone());
    let (outcome, again) = Runner::curves(curves.clone()).done("harmonise", &[]);
    assert_eq!(outcome.edits, []);
    assert_eq!(again, curves);
}

#[test]
fn a_remark_says_where_features_that_stand_out_are_lost() {
    let vertices = [
        (0.20, 1.05),
        (2.81, 0.69),
        (5.92, -0.11),
        (9.36, 0.75),
        (11.25, 1.00),
        (14.78, 0.33),
        (18.52, -0.50),
        (21.35, -0.44),
        (24.06, 1.57),
        (27.19, 0.46),
        (30.19, -0.83),
        (32.82, -0.07),
        (37.32, -1.21),
        (39.27, -1.09),
        (41.93, 0.30),
        (45.99, -0.92),
        (48.36, 0.60),
        (51.14, -0.60),
        (54.26, -1.07),
        (57.23, -0.66),
        (60.18, -0.70),
        (63.51, -1.57),
        (66.05, -1.38),
        (68.57, -1.29),
        (71.51, 0.23),
        (74.71, -0.15),
        (78.45, -0.81),
    ];
    let polygon = FloatPolygon::planar(12, &vertices).expect("valid");
    let given = [
        ("inflections", list(&[2.0])),
        // A stretch is not fitted, which would find a curve that keeps them.
        ("stretch", list(&[0.0, 15.0])),
        ("keep", Value::Choice(3)),
        ("keep-start", Value::Choice(1)),
        ("keep-end", Value::Choice(2)),
        ("locked", list(&[24.0, 25.0])),
    ];
    let (outcome, curves) = Runner::of(polygon).done("harmonise", &given);
    let asked = outcome.figures.iter().find(|it| it.name == "asked_extrema");
    let Some(Value::Whole(asked)) = asked.map(|it| it.value.clone()) else {
        panic!("{:?}", outcome.figures);
    };
    let left = extrema(&curves[0].polygon);
    assert!(left < asked);
    let remark = format!("{left} of the {asked} prominent curvature extrema are left");
    let remarks = outcome.remarks.join("\n");
    assert!(remarks.contains(&remark), "{remarks}");
}

#[test]
fn locked_vertices_stay_to_the_bit() {
    let runner = noisy();
    let curve = runner.id();
    let vertices = vec![9];
    let lock = Edit::SetVerticesLocked {
        curve,
        vertices,
        locked: true,
    };
    let runner = runner.edited(lock);
    let mut given = monotone().to_vec();
    given.push(("locked", list(&[17.0])));
    let outcome = runner.run("harmonise", &given).expect("it can run");
    let after = outcome.applied_to(runner.input.document()).expect("edits");
    let (_, after) = after.curves().next().expect("a curve");
    for vertex in [9, 17] {
        assert_eq!(
            after.polygon.vertex(vertex),
            runner.polygon().vertex(vertex)
        );
    }
    assert_ne!(after.polygon, *runner.polygon());
}

#[test]
fn a_stretch_leaves_the_curve_beyond_it() {
    let runner = noisy();
    let given = [
        ("stretch", list(&[5.0, 20.0])),
        ("keep", Value::Choice(5)),
        ("extrema", list(&[0.0])),
        ("inflections", list(&[0.0])),
    ];
    let outcome = runner.run("harmonise", &given).expect("it can run");
    let after = outcome.applied_to(runner.input.document()).expect("edits");
    let (_, after) = after.curves().next().expect("a curve");
    for u in [0.0, 2.5, 4.75, 20.25, 23.0, 25.0] {
        let [a, b] = [runner.polygon(), &after.polygon].map(|polygon| polygon.point(u));
        assert_eq!(a, b, "u = {u}");
    }
    assert_eq!(outcome.annotations.len(), 2);
}

#[test]
fn a_stretch_of_a_periodic_curve_goes_over_the_seam() {
    let mut random = Random(5);
    let vertices = (0..40).map(|index| {
        let (sine, cosine) = (0.157_079_632_679_489_66 * (f64::from(index) + 7.0)).sin_cos();
        DVec3::new(9.0 * cosine, 6.0 * sine, 0.0) + random.vector(0.02, false)
    });
    let polygon = FloatPolygon::new(4, vertices.collect(), None, true).expect("valid");
    let runner = Runner::of(polygon);
    let given = [
        ("stretch", list(&[36.0, 3.0])),
        ("extrema", list(&[0.0])),
        ("inflections", list(&[0.0])),
    ];
    let (outcome, curves) = runner.done("harmonise", &given);
    assert_eq!(outcome.annotations.len(), 2);
    let inside = |polygon: &FloatPolygon| {
        let extrema = Features::new(polygon).curvature_extrema;
        let within = extrema
            .iter()
            .filter(|it| it.u[1] >= 36.0 || it.u[0] <= 3.0);
        within.count()
    };
    assert!(inside(runner.polygon()) > 0);
    assert_eq!(inside(&curves[0].polygon), 0);
    // The vertices that do not act on the stretch stay.
    for vertex in 7..36 {
        assert_eq!(
            curves[0].polygon.vertex(vertex),
            runner.polygon().vertex(vertex)
        );
    }
}

#[test]
fn what_the_rest_of_the_curve_gains_is_told() {
    let mut told = 0;
    for keep in 1..=5 {
        let runner = noisy();
        let given = [
            ("stretch", list(&[5.0, 20.0])),
            ("keep", Value::Choice(keep)),
            ("extrema", list(&[0.0])),
            ("inflections", list(&[0.0])),
        ];
        let outcome = runner.run("harmonise", &given).expect("it can run");
        let after = outcome.applied_to(runner.input.document()).expect("edits");
        let (_, after) = after.curves().next().expect("a curve");
        let outside = |u: [f64; 2]| u[0] < 5.0 || u[0] > 20.0;
        let counts = [runner.polygon(), &after.polygon].map(|polygon| {
            let features = Features::new(polygon);
            let extrema = features.curvature_extrema.iter().map(|it| it.u);
            let inflections = features.inflections.iter().map(|it| it.u);
            [
                extrema.filter(|u| outside(*u)).count(),
                inflections.filter(|u| outside(*u)).count(),
            ]
        });
        let gains = counts[1][0] > counts[0][0] || counts[1][1] > counts[0][1];
        let mut warnings = outcome.warnings.iter();
        let says = warnings.any(|it| it.starts_with("The rest of the curve gains"));
        assert_eq!(says, gains, "keep {keep}: {counts:?}");
        told += usize::from(says);
    }
    assert!(told > 0, "the ends reach beyond the stretch");
}

#[test]
fn what_only_curves_in_space_have_is_refused_for_planar_ones() {
    let planar = noisy();
    let refused = planar.refused("harmonise", &[("torsion-extrema", list(&[0.0]))]);
    assert_eq!(
        refused,
        "Torsion extrema: only a curve in space has this, and the curve lies in the plane z = 0"
    );
    let normal = ("end-normal", list(&[0.0, 0.0, 1.0]));
    let refused = planar.refused("correct-ends", std::slice::from_ref(&normal));
    assert!(
        refused.starts_with("End normal: only a curve in space"),
        "{refused}"
    );
    let vertices = planar.polygon().vertices().iter().enumerate();
    let raised = vertices.map(|(index, vertex)| vertex.with_z(0.1 * (index as f64).sin()));
    let raised = FloatPolygon::new(5, raised.collect(), None, false).expect("valid");
    let jet = raised.end_jet(End::Finish);
    let normal = jet.first.cross(jet.second).to_array();
    let given = [("end-normal", list(&normal))];
    let outcome = Runner::of(raised).run("correct-ends", &given);
    assert!(outcome.expect("it can run").reached);
}

#[test]
fn what_cannot_be_reached_offers_the_best_found() {
    let runner = noisy();
    let given = [("max-deviation", list(&[1e-6]))]
        .into_iter()
        .chain(monotone());
    let outcome = runner
        .run("harmonise", &given.collect::<Vec<_>>())
        .expect("it can run");
    assert!(!outcome.reached);
    assert!(outcome.is_useful());
    assert!(
        outcome.remarks[0].contains("is allowed"),
        "{:?}",
        outcome.remarks
    );
    let refused = runner.refused("harmonise", &[("stretch", list(&[4.0, 30.0]))]);
    assert!(refused.contains("no part of the curve"), "{refused}");
    let refused = runner.refused("harmonise", &[("locked", list(&[99.0]))]);
    assert!(refused.contains("99"), "{refused}");
}

#[test]
fn the_curve_moves_by_a_share_of_its_own_size() {
    let mut random = Random(11);
    let reached = (0..20).filter(|_| {
        let (mut angle, mut place) = (0.0_f64, DVec3::ZERO);
        let mut vertices: Vec<DVec3> = (0..16)
            .map(|index| {
                angle += 0.04 + 0.01 * f64::from(index);
                place += DVec3::new(angle.cos(), angle.sin(), 0.0);
                place + random.vector(0.1, false)
            })
            .collect();
        // Far ends of the float polygon, which the curve does not come near.
        vertices[0].y += 20.0;
        vertices[15].y -= 20.0;
        let runner = Runner::of(FloatPolygon::new(6, vertices, None, false).expect("valid"));
        let outcome = runner.run("harmonise", &monotone()).expect("it can run");
        let deviation = match outcome.deviation {
            Deviation::Exact => 0.0,
            Deviation::AtMost(deviation) => deviation,
            other => panic!("{other:?}"),
        };
        let size = ClampedPolygon::from_float(runner.polygon()).size();
        assert!(
            !outcome.reached || deviation <= 0.05 * size,
            "{deviation} {size}"
        );
        outcome.reached
    });
    assert!(reached.count() > 5);
}

#[test]
fn ends_are_corrected_to_what_is_given() {
    let runner = Runner::example("s-curve");
    let polygon = runner.polygon();
    let jet = polygon.end_jet(End::Start);
    let point = jet.point + DVec3::new(0.02, -0.03, 0.0) * polygon.size();
    for order in 0..6 {
        let given = [
            ("order", Value::Choice(order)),
            ("start", list(&[point.x, point.y])),
            ("start-direction", list(&[jet.first.x, jet.first.y])),
            ("start-curvature", list(&[0.5 / polygon.size()])),
            ("end-curvature", list(&[0.0])),
        ];
        let (_, curves) = runner.done("correct-ends", &given);
        let found = &curves[0].polygon;
        let size = polygon.size();
        assert!(found.end_jet(End::Start).point.distance(point) <= MET * size);
        let curvature = found.end_jet(End::Start).signed_curvature();
        assert!((curvature * size - 0.5).abs() <= 1e-10, "{curvature}");
        let [before, after] = [polygon, found].map(|polygon| polygon.end_jet(End::Finish));
        assert!(
            before.point.distance(after.point) <= MET * size,
            "it keeps its point"
        );
        assert!(after.signed_curvature().abs() * size <= 1e-10);
    }
    let nothing = runner.run("correct-ends", &[]);
    assert_eq!(nothing, Err(OperationError::NoTarget { end: None }));
}

#[test]
fn steps_do_not_move_locked_vertices() {
    let runner = Runner::example("bottle");
    let start = runner.polygon().end_jet(End::Start).point;
    let given = [
        ("method", Value::Choice(1)),
        ("start", list(&[start.x + 1.0, start.y])),
        ("locked", list(&[1.0])),
    ];
    let outcome = runner.run("correct-ends", &given).expect("it can run");
    assert!(!outcome.reached && outcome.edits.is_empty());
    assert!(
        outcome.remarks[0].contains("vertex 1, which is locked"),
        "{:?}",
        outcome.remarks
    );
    let (_, curves) = runner.done("correct-ends", &given[1..]);
    assert_eq!(curves[0].polygon.vertex(1), runner.polygon().vertex(1));
}

#[test]
fn too_many_conditions_are_told() {
    let points = [(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (2.0, 2.0)];
    let polygon = FloatPolygon::planar(3, &points).expect("valid");
    let runner = Runner::of(polygon);
    let asked = |end: &'static str| {
        let name = |what: &'static str| match (end, what) {
            ("start", "curvature") => "start-curvature",
            ("start", _) => "start-slope",
            (_, "curvature") => "end-curvature",
            _ => "end-slope",
        };
        [
            (name("curvature"), list(&[0.3])),
            (name("slope"), list(&[0.2])),
        ]
    };
    let given = [asked("start"), asked("end")].concat();
    let outcome = runner.run("correct-ends", &given).expect("it can run");
    assert!(!outcome.reached);
    let start = "10 end conditions cannot be met by 8 coordinates";
    assert!(
        outcome.remarks[0].starts_with(start),
        "{:?}",
        outcome.remarks
    );
}

#[test]
fn without_numbers_what_stands_out_is_left() {
    // A hump of curvature with small waves on it.
    let mut angle: f64 = 0.0;
    let mut point = DVec3::ZERO;
    let vertices = (0..40).map(|index| {
        let share = f64::from(index) / 39.0;
        let wave = 0.005 * (2.1 * f64::from(index)).sin();
        angle += 0.02 + 0.1 * (std::f64::consts::PI * share).sin() + wave;
        point += DVec3::new(angle.cos(), angle.sin(), 0.0);
        point
    });
    let polygon = FloatPolygon::new(4, vertices.collect(), None, false).expect("valid");
    let runner = Runner::of(polygon);
    assert!(extrema(runner.polygon()) > 3);
    let (outcome, curves) = runner.done("harmonise", &[]);
    assert_eq!(extrema(&curves[0].polygon), 1);
    let asked = outcome
        .figures
        .iter()
        .find(|figure| figure.name == "asked_extrema");
    assert_eq!(asked.map(|figure| &figure.value), Some(&Value::Whole(1)));
}

#[test]
fn ends_keep_what_their_targets_require() {
    let runner = noisy();
    let curve = runner.id();
    let jets = End::BOTH.map(|end| runner.polygon().end_jet(end));
    let target = EndTarget {
        curvature: Some(jets[0].signed_curvature()),
        ..EndTarget::keeping(&jets[0])
    };
    let set = Edit::SetTarget {
        curve,
        end: End::Start,
        target: Some(target),
    };
    let runner = runner.edited(set);
    let given = [monotone().to_vec(), vec![("keep", Value::Choice(0))]].concat();
    let (outcome, curves) = runner.done("harmonise", &given);
    let after = curves[0].polygon.end_jet(End::Start);
    let size = curves[0].polygon.size();
    assert!(after.point.distance(jets[0].point) < 1e-9 * size);
    let off = after.signed_curvature() - jets[0].signed_curvature();
    assert!(off.abs() * size < 1e-6, "{off}");
    let remark = "The start keeps its curvature, as its target requires".to_owned();
    assert!(outcome.remarks.contains(&remark), "{:?}", outcome.remarks);
    // The other end is as free as was asked.
    assert!(
        !outcome
            .remarks
            .iter()
            .any(|it| it.starts_with("The end keeps"))
    );
}
