//! Mirror images of curves.

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, MatchPlace};
use batten::geometry::end_correction::EndTarget;
use batten::geometry::{Continuity, End, FloatPolygon, Progress};
use batten::operations::{Operands, Outcome, Value};
use glam::DVec3;

use crate::common::Random;
use crate::runner::{ROUNDING, Runner, operation};

/// The places of the options.
const AXES: [(usize, [f64; 3]); 3] = [
    (0, [-1.0, 1.0, 1.0]),
    (1, [1.0, -1.0, 1.0]),
    (2, [-1.0, -1.0, 1.0]),
];
const PLANES: [(usize, [f64; 3]); 3] = [
    (1, [1.0, 1.0, -1.0]),
    (2, [1.0, -1.0, 1.0]),
    (3, [-1.0, 1.0, 1.0]),
];

fn random(seed: u64, in_space: bool) -> Runner {
    Runner::of(Random(seed).gentle(4, 9, in_space, seed.is_multiple_of(2)))
}

#[test]
fn images_in_axes_and_planes_are_exact_and_their_own_inverses() {
    let of = |name, options: [(usize, [f64; 3]); 3]| options.map(|(at, signs)| (name, at, signs));
    let all = [of("axis", AXES), of("plane", PLANES)].concat();
    for (seed, (name, at, signs)) in all.into_iter().enumerate() {
        let runner = random(seed as u64, true);
        let given = [(name, Value::Choice(at))];
        let (_, curves) = runner.done("mirror", &given);
        let [image] = &curves[..] else {
            panic!("it replaces the curve: {curves:?}");
        };
        let signs = DVec3::from(signs);
        let pairs = runner
            .polygon()
            .vertices()
            .iter()
            .zip(image.polygon.vertices());
        for (before, after) in pairs {
            assert_eq!(*before * signs, *after, "{name} {at}");
        }
        assert_eq!(runner.polygon().weights(), image.polygon.weights());
        let (_, back) = Runner::curves(curves).done("mirror", &given);
        assert_eq!(back[0].polygon, *runner.polygon(), "{name} {at}");
    }
}

#[test]
fn a_line_keeps_its_points_and_turns_a_perpendicular() {
    let runner = random(5, false);
    let line = [
        ("from", Value::List(vec![1.0, 2.0])),
        ("to", Value::List(vec![4.0, 6.0])),
    ];
    let (_, curves) = runner.done("mirror", &line);
    let (through, along) = (DVec3::new(1.0, 2.0, 0.0), DVec3::new(0.6, 0.8, 0.0));
    let size = runner.polygon().size();
    let pairs = runner
        .polygon()
        .vertices()
        .iter()
        .zip(curves[0].polygon.vertices());
    for (before, after) in pairs {
        let middle = 0.5 * (*before + *after) - through;
        assert!(middle.cross(along).length() <= ROUNDING * size);
        assert!((*after - *before).dot(along).abs() <= ROUNDING * size);
    }
    let half = [("from", Value::List(vec![1.0, 2.0]))];
    assert_eq!(runner.refused("mirror", &half), "From needs To");
    let point = [&line[..1], &[("to", Value::List(vec![1.0, 2.0]))]].concat();
    assert!(runner.refused("mirror", &point).contains("length 0"));
    let both = [&line[..], &[("plane", Value::Choice(1))]].concat();
    let refused = runner.refused("mirror", &both);
    assert_eq!(refused, "From and Plane cannot both be given");
}

#[test]
fn targets_and_locks_go_along() {
    let target = EndTarget {
        point: DVec3::new(3.0, 1.0, 0.0),
        direction: Some(DVec3::new(1.0, 2.0, 0.0)),
        curvature: Some(0.25),
        slope: Some(-0.5),
        normal: None,
    };
    let locked = |curve| Edit::SetVerticesLocked {
        curve,
        vertices: vec![2, 5],
        locked: true,
    };
    let runner = random(3, false).with_target(End::Start, target);
    let id = runner.id();
    let runner = runner.edited(locked(id));
    let (_, curves) = runner.done("mirror", &[]);
    let image = &curves[0];
    assert_eq!(image.locked_vertices.iter().collect::<Vec<_>>(), [2, 5]);
    let found = image.targets.start.expect("a target");
    assert_eq!(found.point, DVec3::new(-3.0, 1.0, 0.0));
    assert_eq!(found.direction, Some(DVec3::new(-1.0, 2.0, 0.0)));
    assert_eq!([found.curvature, found.slope], [Some(-0.25), Some(0.5)]);
    let (_, curves) = runner.done("mirror", &[("axis", Value::Choice(2))]);
    let found = curves[0].targets.start.expect("a target");
    assert_eq!([found.curvature, found.slope], [Some(0.25), Some(-0.5)]);
    // The image of an end has the image of its curvature.
    let [before, after] =
        [runner.polygon(), &image.polygon].map(|it| it.end_jet(End::Finish).curvature_of(true));
    assert!((before + after).abs() <= ROUNDING * before.abs());
}

#[test]
fn a_copy_leaves_the_curve_and_a_matched_end_is_not_torn_off() {
    let first = random(7, false).curve().clone();
    let second = Curve {
        name: "second".to_owned(),
        ..first.clone()
    };
    let runner = Runner::curves(vec![first, second]);
    let document = runner.input.document();
    let ids: Vec<_> = document.ids().collect();
    let matched = EndMatch {
        curve: ids[0],
        end: End::Start,
        source: ids[1],
        place: MatchPlace::End(End::Start),
        continuity: Continuity::G1,
        reversed: false,
    };
    let runner = runner.edited(Edit::SetMatch(matched));
    let refused = runner.refused("mirror", &[]);
    assert_eq!(
        refused,
        "the start follows “second”: release the match, or mirror a copy (--copy)"
    );
    let (_, curves) = runner.done("mirror", &[("copy", Value::Switch(true))]);
    assert_eq!(curves.len(), 3);
    assert_eq!(curves[0].polygon, *runner.polygon());
    assert_eq!(curves[2].name, "curve 2");
}

#[test]
fn copies_of_a_curve_are_no_new_features() {
    let runner = Runner::example("s-curve");
    let copy = ("copy", Value::Switch(true));
    for (operation, given) in [("mirror", &[copy][..]), ("array", &[])] {
        let report = runner.report(operation, given);
        assert!(report.features.is_some());
        assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    }
}

/// A body that is its own image in the y axis, and a handle on its right side that follows it with both ends.
fn body_with_handle() -> (Document, [CurveId; 2]) {
    let half = [(6.0, -8.0), (5.5, -4.0), (4.0, -1.5), (2.0, 0.0)];
    let left = half.iter().map(|(x, y)| (-x, *y));
    let right = half.iter().rev().copied();
    let vertices: Vec<(f64, f64)> = left.chain([(0.0, 0.5)]).chain(right).collect();
    let body = FloatPolygon::planar(3, &vertices).expect("a polygon");
    let handle = [
        (4.0, -1.0),
        (5.0, 0.0),
        (6.5, 0.5),
        (8.0, 0.0),
        (9.0, -1.5),
        (8.5, -3.0),
        (7.0, -4.0),
        (6.0, -4.5),
    ];
    let handle = FloatPolygon::planar(3, &handle).expect("a polygon");
    let curves = [Curve::new("body", body), Curve::new("handle", handle)];
    let document = Document::from_curves(curves);
    let ids: Vec<CurveId> = document.ids().collect();
    let [body, handle] = ids.try_into().expect("two");
    let matched = |end, u| {
        Edit::SetMatch(EndMatch {
            curve: handle,
            end,
            source: body,
            place: MatchPlace::Parameter(u),
            continuity: Continuity::G1,
            reversed: false,
        })
    };
    let edits = [matched(End::Start, 4.25), matched(End::Finish, 5.5)];
    let document = document.edited(edits).expect("matched");
    assert!(document.matches().all(|it| document.meets(it)));
    (document, [body, handle])
}

#[test]
fn a_copy_follows_the_image_of_what_the_curve_follows() {
    let (document, [body, handle]) = body_with_handle();
    let runner = Runner {
        input: Operands::new(&document, [handle]).expect("it is there"),
    };
    let outcome = runner.run("mirror", &[("copy", Value::Switch(true))]);
    let outcome = outcome.expect("it can run");
    let both = document.edited(outcome.edits).expect("valid");
    assert_eq!(both.matches().len(), 4, "{:?}", outcome.remarks);
    let images: Vec<&EndMatch> = both.matches().filter(|it| it.curve != handle).collect();
    let places: Vec<MatchPlace> = images.iter().map(|it| it.place).collect();
    for (place, expected) in places.iter().zip([1.75, 0.5]) {
        let MatchPlace::Parameter(u) = place else {
            panic!("{place:?}");
        };
        assert!((u - expected).abs() <= 1e-12, "{u}");
    }
    assert!(images.iter().all(|it| it.source == body && it.reversed));
    let check = |document: &Document| {
        assert!(document.matches().all(|it| document.meets(it)));
        let polygon = |id| &document.curve(id).expect("a curve").polygon;
        let pairs = polygon(handle).vertices().iter();
        let pairs = pairs.zip(polygon(images[0].curve).vertices());
        for (own, image) in pairs {
            let expected = DVec3::new(-own.x, own.y, 0.0);
            assert!(image.distance(expected) <= 1e-11, "{image} for {expected}");
        }
    };
    check(&both);
    // The body changes alike on both sides: both handles follow.
    let vertices = both.curve(body).expect("a curve").polygon.vertices();
    let move_ends = |moves: &[(usize, f64)]| {
        let to = |index: usize, by: f64| vertices[index] + DVec3::new(by, 0.5, 0.0);
        let moves = moves.iter().map(|(index, by)| (*index, to(*index, *by)));
        Edit::MoveVertices {
            curve: body,
            moves: moves.collect(),
        }
    };
    let edit = move_ends(&[(0, -0.4), (vertices.len() - 1, 0.4)]);
    check(&both.edited([edit]).expect("valid"));
    // What is no image of itself is not followed.
    let edit = move_ends(&[(0, -0.4)]);
    let uneven = document.edited([edit]).expect("valid");
    let runner = Runner {
        input: Operands::new(&uneven, [handle]).expect("it is there"),
    };
    let outcome = runner.run("mirror", &[("copy", Value::Switch(true))]);
    let outcome = outcome.expect("it can run");
    let told = "The end of the copy of “handle” is not matched: “body” is neither mirrored nor its own image";
    assert_eq!(outcome.remarks.first().map(String::as_str), Some(told));
}

#[test]
fn copies_of_several_curves_follow_each_other() {
    let (document, [body, handle]) = body_with_handle();
    let beside = Operands::new(&document, [body]).map(|it| vec![(body, Ok(it))]);
    let input = Operands::new(&document, [handle]).expect("it is there");
    let input = input.with_beside(beside.expect("it is there"));
    let operation = operation("mirror");
    let given = [("axis", Value::Choice(1)), ("copy", Value::Switch(true))];
    let values = operation.values(&input, given).expect("valid");
    let shares = operation.run_on_each(&input, &values, &Progress::default());
    let edits = shares
        .into_iter()
        .flat_map(|it| it.outcome.expect("it can run").edits);
    let all = document.edited(edits).expect("valid");
    let [handle_copy, body_copy] = {
        let mut ids = document.next_ids();
        [(); 2].map(|()| ids.next().expect("an id"))
    };
    let images: Vec<&EndMatch> = all.matches().filter(|it| it.curve == handle_copy).collect();
    assert_eq!(images.len(), 2);
    assert!(images.iter().all(|it| it.source == body_copy));
    assert!(all.matches().all(|it| all.meets(it)));
}

#[test]
fn copies_of_an_array_follow_those_beside_them() {
    let (document, [body, handle]) = body_with_handle();
    let array = operation("array");
    let both = Operands::new(&document, [handle]).expect("it is there");
    let beside = Operands::new(&document, [body]).map(|it| vec![(body, Ok(it))]);
    let both = both.with_beside(beside.expect("it is there"));
    let given = [
        ("count", Value::Whole(3)),
        ("angle", Value::Real(0.5)),
        ("step", Value::List(vec![30.0, -7.0])),
    ];
    let values = array.values(&both, given).expect("valid");
    let shares = array.run_on_each(&both, &values, &Progress::default());
    let outcomes: Vec<Outcome> = shares
        .into_iter()
        .map(|it| it.outcome.expect("it can run"))
        .collect();
    assert!(outcomes.iter().all(|it| it.remarks.is_empty()));
    let edits = outcomes.into_iter().flat_map(|it| it.edits);
    let all = document.edited(edits).expect("valid");
    assert_eq!(all.matches().len(), 6);
    assert!(all.matches().all(|it| all.meets(it)));
    let mut ids = document.next_ids();
    let [first, second, first_body, second_body] =
        [(); 4].map(|()| ids.next().expect("an identity"));
    for (handle, body) in [(first, first_body), (second, second_body)] {
        let own: Vec<_> = all.matches().filter(|it| it.curve == handle).collect();
        assert!(own.iter().all(|it| it.source == body) && own.len() == 2);
    }
    // Each copy is told once that it follows nothing.
    let alone = Operands::new(&document, [handle]).expect("it is there");
    let values = array.values(&alone, [("count", Value::Whole(4))]);
    let outcome = array.run(&alone, &values.expect("valid"), &Progress::default());
    let remarks = outcome.expect("it can run").remarks;
    let told =
        |end| format!("The {end} of the copy of “handle” is not matched: “body” is not copied");
    assert_eq!(remarks, [told("start"), told("end")]);
}
