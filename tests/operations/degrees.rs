//! Operations on degree, segments and direction.

use std::collections::BTreeMap;

use batten::document::{Curve, Edit};
use batten::geometry::features::{Feature, Features};
use batten::geometry::{End, FloatPolygon, MAX_DEGREE};
use batten::operations::{Deviation, Inputs, Value};
use glam::DVec3;

use crate::common::Random;
use crate::runner::{ROUNDING, Runner, apart, beside, examples};

/// How much larger a bound may be than the distance at samples.
const TIGHT: f64 = 1.2;

fn degree(degree: usize) -> [(&'static str, Value); 1] {
    [("degree", Value::Whole(degree))]
}

#[test]
fn reversing_swaps_and_turns_the_targets_and_twice_changes_nothing() {
    let runner = Runner::example("hull");
    let target = beside(runner.polygon(), End::Finish, 0.1, 0.2);
    let runner = runner.with_target(End::Finish, target);
    let (outcome, curves) = runner.done("reverse", &[]);
    assert_eq!(outcome.deviation, Deviation::Exact);
    let last = runner.polygon().segments() as f64;
    let off = apart(runner.polygon(), &curves[0].polygon, |u| last - u);
    assert!(off <= ROUNDING * runner.polygon().size(), "{off:e}");
    assert_eq!(curves[0].targets.start, Some(target.turned(true)));
    assert_eq!(curves[0].targets.finish, None);
    let (_, again) = Runner::curves(curves).done("reverse", &[]);
    assert_eq!(&again[0], runner.curve());
}

#[test]
fn subdividing_keeps_the_curve() {
    for (name, runner) in examples() {
        let (outcome, curves) = runner.done("subdivide", &[]);
        let polygon = &curves[0].polygon;
        assert_eq!(outcome.deviation, Deviation::Exact);
        assert_eq!(outcome.figures[0].value, Value::Whole(polygon.segments()));
        assert_eq!(polygon.segments(), 2 * runner.polygon().segments());
        let off = apart(runner.polygon(), polygon, |u| 2.0 * u);
        assert!(off <= ROUNDING * polygon.size(), "{name}: {off:e}");
    }
}

/// How far the points of a curve are from another one, at samples of the one and chords of the other.
fn farthest(one: &FloatPolygon, other: &FloatPolygon) -> f64 {
    let points = |polygon: &FloatPolygon| -> Vec<DVec3> {
        let places = (0..=2000).map(|it| f64::from(it) / 2000.0 * polygon.segments() as f64);
        places.map(|u| polygon.point(u)).collect()
    };
    let others = points(other);
    let nearest = |point: &DVec3| {
        let distances = others.windows(2).map(|chord| {
            let way = chord[1] - chord[0];
            let along = (*point - chord[0]).dot(way) / way.length_squared();
            point.distance(chord[0] + along.clamp(0.0, 1.0) * way)
        });
        distances.fold(f64::INFINITY, f64::min)
    };
    points(one).iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn another_degree_keeps_the_polygon() {
    let runner = Runner::example("bottle");
    let before = runner.polygon();
    for chosen in [1, 4, MAX_DEGREE] {
        let (outcome, curves) = runner.done("reinterpret-degree", &degree(chosen));
        assert_eq!(curves[0].polygon.degree(), chosen);
        assert_eq!(curves[0].polygon.vertices(), before.vertices());
        let Deviation::AtMost(bound) = outcome.deviation else {
            panic!("{:?}", outcome.deviation)
        };
        let far = farthest(before, &curves[0].polygon).max(farthest(&curves[0].polygon, before));
        assert!(far <= 1.01 * bound && bound <= 1.5 * far, "{far} {bound}");
    }
    let (outcome, _) = runner.done("reinterpret-degree", &degree(before.degree()));
    assert_eq!(
        (outcome.edits, outcome.deviation),
        (vec![], Deviation::Exact)
    );
    let message = runner.refused("reinterpret-degree", &degree(26));
    assert_eq!(message, "Degree: 26 is out of range: 1 to 25 is needed");
    let hull = Runner::example("hull");
    let message = hull.refused(
        "reinterpret-degree",
        &degree(hull.polygon().vertices().len()),
    );
    assert_eq!(message, "Degree: 16 is out of range: 1 to 15 is needed");
    // The default raises as long as there are vertices.
    let (_, curves) = runner.done("reinterpret-degree", &[]);
    assert_eq!(curves[0].polygon.degree(), before.degree() + 1);
    let (_, curves) = Runner::example("hexagon").done("reinterpret-degree", &[]);
    assert_eq!(curves[0].polygon.degree(), 3);
}

#[test]
fn one_segment_is_raised_exactly_and_lowered_again() {
    let runner = Runner::example("arc");
    let (outcome, curves) = runner.done("elevate-degree", &degree(12));
    assert_eq!(outcome.deviation, Deviation::Exact);
    assert!(outcome.remarks.is_empty());
    let raised = &curves[0].polygon;
    assert_eq!(raised.degree(), 12);
    let size = runner.polygon().size();
    // The float polygon of degree 12 is large, and so is the rounding of its vertices.
    assert!(apart(runner.polygon(), raised, |u| u) <= 1e-11 * size);
    let (outcome, curves) = Runner::of(raised.clone()).done("reduce-degree", &degree(9));
    assert!(
        matches!(outcome.deviation, Deviation::AtMost(bound) if bound <= 1e-9 * size),
        "{:?}",
        outcome.deviation
    );
    assert!(apart(runner.polygon(), &curves[0].polygon, |u| u) <= 1e-9 * size);
}

#[test]
fn several_segments_come_as_near_as_the_bound_says() {
    // What chords cut off, by the distance.
    const CHORDS: f64 = 1e-3;
    for (name, runner) in examples() {
        if runner.polygon().segments() == 1 {
            continue;
        }
        for operation in ["elevate-degree", "reduce-degree"] {
            let (outcome, curves) = runner.done(operation, &[]);
            let Deviation::AtMost(bound) = outcome.deviation else {
                panic!("{name}: {:?}", outcome.deviation);
            };
            let off = farthest(runner.polygon(), &curves[0].polygon);
            assert!(
                off <= (1.0 + CHORDS) * bound && bound < 0.01 * runner.polygon().size(),
                "{name}: {off} {bound}"
            );
            assert_eq!(outcome.remarks.is_empty(), operation == "reduce-degree");
        }
    }
}

#[test]
fn degrees_at_their_limits_are_refused_beforehand() {
    let points = |count: usize| -> Vec<DVec3> {
        let turns = (0..count).map(|i| i as f64);
        turns
            .map(|turn| DVec3::new(turn.cos(), turn.sin(), 0.0))
            .collect()
    };
    let polygon = |degree, count, periodic| {
        FloatPolygon::new(degree, points(count), None, periodic).expect("a polygon")
    };
    for (degree, count, periodic, operation, expected) in [
        (
            1,
            3,
            false,
            "reduce-degree",
            "the degree is 1 already, the lowest that there is",
        ),
        (
            MAX_DEGREE,
            30,
            false,
            "elevate-degree",
            "the degree is 25 already, the highest that there is",
        ),
        (
            4,
            5,
            true,
            "elevate-degree",
            "the degree is 4 already, the highest that a periodic curve of so few segments can have",
        ),
    ] {
        let runner = Runner::of(polygon(degree, count, periodic));
        assert_eq!(runner.refused(operation, &[]), expected);
    }
    let (_, curves) = Runner::of(polygon(4, 6, true)).done("elevate-degree", &[]);
    assert_eq!(curves[0].polygon.degree(), 5);
}

#[test]
fn locked_and_hidden_curves_are_refused_beforehand_by_every_operation() {
    let runner = || {
        let runner = Runner::example("s-curve");
        let target = beside(runner.polygon(), End::Start, 0.1, 0.2);
        runner.with_target(End::Start, target)
    };
    let curve = runner().id();
    let locked = Edit::SetLocked {
        curve,
        locked: true,
    };
    let visible = false;
    let hidden = Edit::SetVisible { curve, visible };
    for (edit, expected) in [
        (
            locked,
            "“s-curve” is locked: unlock it in the list of curves to change its shape",
        ),
        (
            hidden,
            "“s-curve” is hidden: show it in the list of curves to change it",
        ),
    ] {
        let runner = runner().edited(edit);
        let on_curves = batten::operations::ALL.iter();
        for operation in
            on_curves.filter(|operation| matches!(operation.inputs, Inputs::One | Inputs::Two))
        {
            let input = runner.input_of(operation);
            let refused = operation.check(&input).expect_err("refused");
            assert_eq!(refused.to_string(), expected, "{}", operation.name);
        }
    }
}

#[test]
fn other_curves_stay_as_they_are() {
    let other = Curve::new("other", Runner::example("hull").polygon().clone());
    let own = Runner::example("s-curve").curve().clone();
    let runner = Runner::curves(vec![own, other.clone()]);
    for operation in [
        "reverse",
        "refine",
        "subdivide",
        "elevate-degree",
        "split",
        "round",
    ] {
        let (_, curves) = runner.done(operation, &[]);
        assert_eq!(curves[1], other, "{operation}");
    }
}

/// The most curvature extrema of a fair curve.
const MOST_OF_A_FAIR_CURVE: usize = 8;

/// A fair curve: a turn that grows evenly along legs of one length.
fn fair(random: &mut Random, degree: usize, count: usize) -> FloatPolygon {
    let (mut angle, mut turn) = (0.0_f64, random.between(0.4, 6.0) / count as f64);
    let growth = random.between(-0.2, 0.4) / (count * count) as f64;
    let mut place = DVec3::ZERO;
    let vertices = (0..count).map(|_| {
        place += DVec3::new(angle.cos(), angle.sin(), 0.0);
        angle += turn;
        turn += growth;
        place
    });
    FloatPolygon::new(degree, vertices.collect(), None, false).expect("a polygon")
}

fn counts(polygon: &FloatPolygon) -> [usize; 4] {
    let features = Features::new(polygon);
    [
        Feature::Inflection,
        Feature::CurvatureExtremum,
        Feature::TorsionZero,
        Feature::TorsionExtremum,
    ]
    .map(|kind| features.count(kind))
}

/// How far a curve is from another one that runs about evenly along it, at most, and what its ends do not keep.
fn off(before: &FloatPolygon, after: &FloatPolygon) -> [f64; 2] {
    let pace = after.segments() as f64 / before.segments() as f64;
    let across = |step: usize| {
        let u = step as f64 / 40.0;
        let jet = after.jet(pace * u);
        // What one runs ahead of the other is no distance of the curves.
        let gap = before.point(u) - jet.point;
        gap.cross(jet.first.normalize()).length()
    };
    let apart = (0..=40 * before.segments()).map(across);
    let apart = apart.fold(0.0, f64::max);
    let missed = End::BOTH.map(|end| {
        let [old, new] = [before, after].map(|it| it.end_jet(end));
        let turned = old.first.normalize().cross(new.first.normalize());
        old.point.distance(new.point) + turned.length()
    });
    [apart, missed[0].max(missed[1])]
}

#[test]
fn refining_keeps_the_curve_its_ends_and_its_features() {
    let mut random = Random(12);
    for trial in 0..60 {
        let degree = 4 + trial % 6;
        let count = 11 + (random.bits() % 50) as usize;
        let runner = Runner::of(fair(&mut random, degree, count));
        let before = runner.polygon();
        let size = before.size();
        let (outcome, curves) = runner.done("refine", &[]);
        let after = &curves[0].polygon;
        let [apart, missed] = off(before, after);
        let told = format!("degree {degree}, {count} vertices: {outcome:?}");
        assert_eq!(after.vertices().len(), count + 1, "{told}");
        assert!(
            apart <= 2e-4 * size && missed <= 1e-9,
            "{apart:e} {missed:e}"
        );
        assert_eq!(counts(after), counts(before), "{told}");
        let Deviation::AtMost(bound) = outcome.deviation else {
            panic!("{told}");
        };
        assert!(apart <= bound * (1.0 + 1e-9), "{apart:e} {bound:e}");
    }
}

#[test]
fn refining_takes_as_few_vertices_as_keep_a_tolerance() {
    let mut random = Random(13);
    for degree in 5..=8 {
        let runner = Runner::of(fair(&mut random, degree, 20));
        let before = runner.polygon();
        let tolerance = 1e-9 * before.size();
        let given = [("tolerance", Value::List(vec![tolerance]))];
        let (_, curves) = runner.done("refine", &given);
        let after = &curves[0].polygon;
        assert!(off(before, after)[0] <= tolerance);
        let fewer = after.segments() - 1;
        if fewer > before.segments() {
            let fewer = before.refitted(degree, fewer).expect("a curve");
            assert!(fewer.deviation > tolerance, "{fewer:?}");
        }
        // A degree more and one less take more of them.
        for (operation, changed) in [
            ("elevate-degree", degree + 1),
            ("reduce-degree", degree - 1),
        ] {
            let given = [&given[..], &[("degree", Value::Whole(changed))]].concat();
            let (outcome, curves) = runner.done(operation, &given);
            let other = &curves[0].polygon;
            assert_eq!(other.degree(), changed);
            let [apart, missed] = off(before, other);
            assert!(
                apart <= tolerance && missed <= 1e-9,
                "{operation}: {apart:e} {missed:e}"
            );
            assert_eq!(counts(other), counts(before), "{operation}");
            let Deviation::AtMost(bound) = outcome.deviation else {
                panic!("{operation}: {outcome:?}");
            };
            assert!(bound <= TIGHT * apart, "{operation}: {bound:e} {apart:e}");
        }
    }
}

#[test]
fn a_lower_degree_tells_the_inflection_that_it_loses() {
    let bent = [(0.0, 0.0), (1.0, 1.0), (2.0, -0.8), (3.0, 0.5)];
    let runner = Runner::of(FloatPolygon::planar(3, &bent).expect("a polygon"));
    assert_eq!(counts(runner.polygon())[0], 1);
    let (outcome, _) = runner.done("reduce-degree", &[]);
    let told = "Inflections: 1 before, 0 now".to_owned();
    assert!(outcome.warnings.contains(&told), "{:?}", outcome.warnings);
}

#[test]
fn five_hundred_fair_curves_are_kept_by_more_and_by_fewer_vertices() {
    let mut random = Random(500);
    // By way and whether the degree is 3: how far off, and how many keep their features.
    let mut kept: BTreeMap<(&str, bool), (Vec<f64>, usize)> = BTreeMap::new();
    for trial in 0..500 {
        let degree = 3 + trial % 7;
        let least = 8.max(degree + 1);
        let count = least + random.bits() as usize % (61 - least);
        // A cubic whose turns hardly grow has extrema in every segment, and with more segments more.
        let curves = std::iter::repeat_with(|| fair(&mut random, degree, count));
        let mut fair = curves.filter(|polygon| counts(polygon)[1] <= MOST_OF_A_FAIR_CURVE);
        let runner = Runner::of(fair.next().expect("a fair curve"));
        let before = runner.polygon();
        let tolerance = ("tolerance", Value::List(vec![1e-9 * before.size()]));
        let operated = |name, given: &[(&str, Value)]| {
            let outcome = runner.run(name, given).expect("an outcome");
            let document = outcome.applied_to(runner.input.document()).expect("edits");
            let (_, curve) = document.curves().next().expect("a curve");
            let same = counts(&curve.polygon) == counts(before);
            assert_eq!(outcome.reached, same, "{outcome:?}");
            Some(curve.polygon.clone())
        };
        let fewer = before.segments().checked_sub(1).filter(|it| *it > 0);
        let higher = ("degree", Value::Whole(degree + 1));
        let results = [
            (
                "insert",
                before
                    .refitted(degree, before.segments() + 1)
                    .ok()
                    .map(|it| it.polygon),
            ),
            (
                "delete",
                fewer.and_then(|fewer| Some(before.refitted(degree, fewer).ok()?.polygon)),
            ),
            (
                "refine",
                operated("refine", std::slice::from_ref(&tolerance)),
            ),
            ("elevate", operated("elevate-degree", &[tolerance, higher])),
        ];
        for (way, after) in results {
            let Some(after) = after else { continue };
            let [apart, missed] = off(before, &after);
            assert!(missed <= 1e-9, "{way}: {missed:e}");
            let (offs, features) = kept.entry((way, degree == 3)).or_default();
            offs.push(apart / before.size());
            *features += usize::from(counts(&after) == counts(before));
        }
    }
    for ((way, is_cubic), (mut offs, features)) in kept {
        offs.sort_by(f64::total_cmp);
        let (tried, at_95) = (offs.len(), offs[offs.len() * 95 / 100]);
        let worst = offs[tried - 1];
        println!(
            "{way}, cubic {is_cubic}: {features} of {tried} keep features, 95 % {at_95:.1e}, worst {worst:.1e}"
        );
        match way {
            "insert" => assert!(at_95 <= 2e-4, "{at_95:e}"),
            "refine" => assert!(worst <= 1e-9 && features == tried),
            "elevate" => assert!(worst <= 1e-9 && (is_cubic || features == tried)),
            _ => {}
        }
        assert!(
            is_cubic || way == "delete" || 100 * features >= 95 * tried,
            "{way}"
        );
    }
}

#[test]
fn refining_works_for_every_kind_of_curve() {
    for (name, runner) in examples() {
        let before = runner.polygon();
        let (outcome, after) = match runner.run("refine", &[]) {
            Ok(outcome) => {
                let input = runner.input_of(batten::operations::find("refine").expect("one"));
                let after = outcome.applied_to(input.document()).expect("edits");
                let (_, curve) = after.curves().next().expect("a curve");
                (outcome.clone(), curve.polygon.clone())
            }
            Err(error) => panic!("{name}: {error}"),
        };
        let [apart, missed] = off(before, &after);
        assert_eq!(
            after.vertices().len(),
            before.vertices().len() + 1,
            "{name}"
        );
        assert_eq!(after.is_periodic(), before.is_periodic(), "{name}");
        if !before.is_periodic() {
            assert!(missed <= 1e-9, "{name}: {missed:e}");
        }
        let bound = match outcome.deviation {
            Deviation::AtMost(bound) => bound,
            Deviation::Exact => 0.0,
            other => panic!("{name}: {other:?}"),
        };
        let rounding = 1e-12 * before.size();
        assert!(
            apart <= bound * (1.0 + 1e-6) + rounding,
            "{name}: {apart:e} {bound:e}"
        );
        // What is not the same in kind is not reached.
        assert_eq!(outcome.reached, counts(before) == counts(&after), "{name}");
        let twice = 2 * before.segments() + before.vertices().len() - before.segments();
        let count = [("count", Value::List(vec![twice as f64]))];
        let (outcome, curves) = runner.done("refine", &count);
        assert_eq!(outcome.deviation, Deviation::Exact, "{name}");
        assert_eq!(
            curves[0].polygon,
            before.subdivided().expect("halved"),
            "{name}"
        );
    }
    let runner = Runner::example("hull");
    let has = runner.polygon().vertices().len();
    let fewer = [("count", Value::List(vec![(has - 1) as f64]))];
    let refused = runner.refused("refine", &fewer);
    assert!(refused.contains(&format!("{has} or more")), "{refused}");
}
