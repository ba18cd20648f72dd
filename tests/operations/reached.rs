//! What counts as reached, confirmed by an evaluation of the tests' own.

use batten::document::Document;
use batten::geometry::{FloatPolygon, Progress};
use batten::operations::{self, Operands, OperationError, Outcome, Value};
use glam::{DVec2, DVec3};

use crate::common::Random;
use crate::runner::Runner;

/// The largest error of a point or a curvature, in units of the size, and of a direction in radians.
const EXACT: f64 = 1e-6;

/// Parts of a segment at which the slope of the curvature is looked at.
const PARTS: usize = 200;

/// Slopes below this share of the largest have no certain sign.
const CERTAIN: f64 = 1e-9;

/// The derivative of some order at the parameter u of a spline on the knots …, −1, 0, 1, …: Cox and de Boor's
/// recursion.
fn derivative(degree: usize, vertices: &[DVec2], u: f64, order: usize) -> DVec2 {
    let segments = vertices.len() - degree;
    let segment = (u.floor().max(0.0) as usize).min(segments - 1);
    let mut row: Vec<DVec2> = vertices[segment..=segment + degree].to_vec();
    for _ in 0..order {
        // Knots are 1 apart, so that the factor n / (n · 1) is 1.
        row = row.windows(2).map(|pair| pair[1] - pair[0]).collect();
    }
    let left = degree - order;
    let t = u - segment as f64;
    for level in 0..left {
        let width = (left - level) as f64;
        row = row
            .windows(2)
            .enumerate()
            .map(|(index, pair)| {
                let share = (t + width - 1.0 - index as f64) / width;
                pair[0].lerp(pair[1], share)
            })
            .collect();
    }
    row[0]
}

/// A planar curve as the tests see it.
struct Seen {
    degree: usize,
    vertices: Vec<DVec2>,
    size: f64,
}

impl Seen {
    fn new(polygon: &FloatPolygon) -> Self {
        let vertices: Vec<DVec2> = polygon.vertices().iter().map(|it| it.truncate()).collect();
        let low = vertices.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = vertices
            .iter()
            .copied()
            .fold(DVec2::NEG_INFINITY, DVec2::max);
        Self {
            degree: polygon.degree(),
            size: low.distance(high),
            vertices,
        }
    }

    fn end(&self, end: usize) -> f64 {
        end as f64 * (self.vertices.len() - self.degree) as f64
    }

    fn at(&self, u: f64, order: usize) -> DVec2 {
        derivative(self.degree, &self.vertices, u, order)
    }

    fn curvature(&self, u: f64) -> f64 {
        let first = self.at(u, 1);
        first.perp_dot(self.at(u, 2)) / first.length().powi(3)
    }

    /// The slope of the curvature times a power of the speed, and the size of its terms.
    fn slope(&self, u: f64) -> [f64; 2] {
        let [first, second, third] = [1, 2, 3].map(|order| self.at(u, order));
        let terms = [
            first.length_squared() * first.perp_dot(third),
            3.0 * first.dot(second) * first.perp_dot(second),
        ];
        [terms[0] - terms[1], terms[0].abs() + terms[1].abs()]
    }

    /// Changes of sign of a function along the curve, where its values are certain beside the size of their terms.
    fn changes(&self, of: impl Fn(f64) -> [f64; 2]) -> usize {
        let count = PARTS * (self.vertices.len() - self.degree);
        let even = (0..count).map(|part| (part as f64 + 0.5) / PARTS as f64);
        // An extremum may lie beside an end.
        let beside = (3..10).map(|digits| 10.0_f64.powi(-digits));
        let end = self.end(1);
        let starts = beside.clone().rev();
        let places = starts.chain(even).chain(beside.map(|it| end - it));
        let inside = places.map(of);
        let certain = inside.filter(|[value, size]| value.abs() > CERTAIN * size);
        let signs: Vec<bool> = certain.map(|[value, _]| value > 0.0).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    fn extrema(&self) -> usize {
        self.changes(|u| self.slope(u))
    }

    fn inflections(&self) -> usize {
        self.changes(|u| {
            let [first, second] = [1, 2].map(|order| self.at(u, order));
            [first.perp_dot(second), first.length() * second.length()]
        })
    }
}

/// What one end must have.
#[derive(Clone, Copy, Debug, Default)]
struct Wanted {
    point: Option<DVec2>,
    direction: Option<DVec2>,
    curvature: Option<f64>,
}

impl Wanted {
    /// Why an end does not have it.
    fn missed(&self, seen: &Seen, end: usize) -> Option<String> {
        let u = seen.end(end);
        let off = self
            .point
            .map_or(0.0, |point| seen.at(u, 0).distance(point));
        if !(off <= EXACT * seen.size) {
            return Some(format!("the point of end {end} is {off:e} off"));
        }
        let first = seen.at(u, 1);
        let angle = self
            .direction
            .map_or(0.0, |wanted| wanted.angle_to(first).abs());
        if !(angle <= EXACT) {
            return Some(format!("the direction of end {end} is {angle} off"));
        }
        let found = seen.curvature(u);
        let off = self.curvature.map_or(0.0, |wanted| (found - wanted).abs());
        let unit = seen.size.recip().max(self.curvature.unwrap_or(0.0).abs());
        if !(off <= EXACT * unit) {
            return Some(format!(
                "the curvature of end {end} is {found}, not {self:?}"
            ));
        }
        None
    }
}

/// One random case.
struct Case {
    operation: &'static str,
    input: Operands,
    values: Vec<(&'static str, Value)>,
    ends: [Wanted; 2],
    extrema: Option<usize>,
    inflections: Option<usize>,
    /// The points that must be near, and how near.
    near: Option<(Vec<DVec2>, f64)>,
}

/// What came of some cases.
#[derive(Debug, Default)]
struct Tally {
    reached: usize,
    refused: usize,
    wrong: Vec<String>,
}

fn list(numbers: &[f64]) -> Value {
    Value::List(numbers.to_vec())
}

fn point(random: &mut Random) -> DVec2 {
    DVec2::new(random.between(0.0, 10.0), random.between(0.0, 10.0))
}

fn polygon(random: &mut Random) -> FloatPolygon {
    let degree = 3 + (random.bits() % 4) as usize;
    let count = degree + 1 + (random.bits() % 14) as usize;
    let vertices = (0..count).map(|_| point(random).extend(0.0)).collect();
    FloatPolygon::new(degree, vertices, None, false).expect("a polygon")
}

/// A calm polygon: one that winds, with noise.
fn calm(random: &mut Random) -> FloatPolygon {
    let degree = 3 + (random.bits() % 4) as usize;
    let count = degree + 4 + (random.bits() % 30) as usize;
    let [mut angle, turn, rate] = [
        random.between(-3.0, 3.0),
        random.between(-0.3, 0.3),
        random.between(-0.03, 0.03),
    ];
    let noise = 10.0_f64.powf(random.between(-4.0, -0.7));
    let mut place = DVec3::ZERO;
    let vertices = (0..count).map(|index| {
        angle += turn + rate * index as f64;
        place += DVec3::new(angle.cos(), angle.sin(), 0.0);
        place + random.vector(noise, false)
    });
    FloatPolygon::new(degree, vertices.collect(), None, false).expect("a polygon")
}

/// What the ends have, up to a level: 0 for nothing, 3 for the curvature.
fn kept(polygon: &FloatPolygon, level: usize) -> [Wanted; 2] {
    let seen = Seen::new(polygon);
    [0, 1].map(|end| {
        let u = seen.end(end);
        Wanted {
            point: Some(seen.at(u, 0)).filter(|_| level >= 1),
            direction: Some(seen.at(u, 1)).filter(|_| level >= 2),
            curvature: Some(seen.curvature(u)).filter(|_| level >= 3),
        }
    })
}

fn harmonise(random: &mut Random) -> Case {
    let polygon = match random.bits() % 2 {
        0 => polygon(random),
        _ => calm(random),
    };
    let level = (random.bits() % 4) as usize;
    let ends = kept(&polygon, level);
    let mut count = || (!random.bits().is_multiple_of(3)).then_some((random.bits() % 4) as usize);
    let [extrema, inflections] = [count(), count()];
    let mut values = vec![("keep", Value::Choice(level))];
    let given = |count: usize| list(&[count as f64]);
    values.extend(extrema.map(|count| ("extrema", given(count))));
    values.extend(inflections.map(|count| ("inflections", given(count))));
    Case {
        operation: "harmonise",
        input: Runner::of(polygon).input,
        values,
        ends,
        extrema,
        inflections,
        near: None,
    }
}

fn between(random: &mut Random) -> Case {
    let direction = |random: &mut Random| {
        let angle = random.between(-1.5, 1.5);
        DVec2::new(angle.cos(), angle.sin())
    };
    let points = [DVec2::ZERO, DVec2::new(10.0, 0.0)];
    let directions = [direction(random), direction(random)];
    let mut curvature = || {
        let wanted = random.between(-0.4, 0.4);
        random.bits().is_multiple_of(2).then_some(wanted)
    };
    let curvatures = [curvature(), curvature()];
    let kind = (random.bits() % 4) as usize;
    let pair = |pair: DVec2| list(&[pair.x, pair.y]);
    let mut values = vec![
        ("kind", Value::Choice(kind)),
        ("from", pair(points[0])),
        ("to", pair(points[1])),
        ("from-direction", pair(directions[0])),
        ("to-direction", pair(directions[1])),
    ];
    let names = ["from-curvature", "to-curvature"];
    let given = names.into_iter().zip(curvatures);
    values.extend(given.filter_map(|(name, it)| it.map(|it| (name, list(&[it])))));
    Case {
        operation: "between",
        input: Operands::new(&Document::default(), []).expect("none is there"),
        values,
        ends: [0, 1].map(|end| Wanted {
            point: Some(points[end]),
            direction: Some(directions[end]),
            curvature: curvatures[end],
        }),
        extrema: None,
        inflections: None,
        near: None,
    }
}

fn correct_ends(random: &mut Random) -> Case {
    let polygon = match random.bits() % 2 {
        0 => polygon(random),
        _ => calm(random),
    };
    let seen = Seen::new(&polygon);
    let names = [
        ["start", "start-direction", "start-curvature"],
        ["end", "end-direction", "end-curvature"],
    ];
    let mut values = vec![("method", Value::Choice((random.bits() % 3 / 2) as usize))];
    let steps = values[0].1 == Value::Choice(1);
    let ends = [0, 1].map(|end| {
        let near = seen.at(seen.end(end), 0);
        let wanted = Wanted {
            point: Some(near + 0.3 * seen.size * random.vector(1.0, false).truncate()),
            direction: random
                .bits()
                .is_multiple_of(2)
                .then(|| point(random) - 5.0 * DVec2::ONE),
            curvature: random
                .bits()
                .is_multiple_of(3)
                .then(|| random.between(-2.0, 2.0)),
        };
        // The steps do not bring curvatures.
        let wanted = Wanted {
            curvature: wanted.curvature.filter(|_| !steps),
            ..wanted
        };
        let pair = |pair: DVec2| list(&[pair.x, pair.y]);
        values.extend(wanted.point.map(|it| (names[end][0], pair(it))));
        values.extend(wanted.direction.map(|it| (names[end][1], pair(it))));
        values.extend(wanted.curvature.map(|it| (names[end][2], list(&[it]))));
        wanted
    });
    Case {
        operation: "correct-ends",
        input: Runner::of(polygon).input,
        values,
        ends,
        extrema: None,
        inflections: None,
        near: None,
    }
}

fn fit(random: &mut Random) -> Case {
    let curve = Seen::new(&calm(random));
    let count = 12 + (random.bits() % 60) as usize;
    let noise = 10.0_f64.powf(random.between(-6.0, -2.0)) * curve.size;
    let points = (0..count).map(|index| {
        let u = index as f64 / (count - 1) as f64 * curve.end(1);
        curve.at(u, 0) + random.vector(noise, false).truncate()
    });
    let points: Vec<DVec2> = points.collect();
    let mut values = Vec::new();
    let extrema = (!random.bits().is_multiple_of(3)).then_some((random.bits() % 5) as usize);
    let inflections = random
        .bits()
        .is_multiple_of(4)
        .then_some((random.bits() % 3) as usize);
    let tolerance = (3.0 * noise).max(1e-3 * curve.size);
    let tolerance = random.bits().is_multiple_of(3).then_some(tolerance);
    let exact = random.bits().is_multiple_of(2);
    let given = |count: usize| list(&[count as f64]);
    values.extend(extrema.map(|count| ("extrema", given(count))));
    values.extend(inflections.map(|count| ("inflections", given(count))));
    values.extend(tolerance.map(|tolerance| ("tolerance", list(&[tolerance]))));
    values.push(("ends", Value::Choice(usize::from(exact))));
    values.push(("outliers", Value::Choice(1)));
    let outer = [points[0], points[count - 1]];
    let spatial = points.iter().map(|point| point.extend(0.0)).collect();
    let none = Operands::new(&Document::default(), []).expect("none is there");
    Case {
        operation: "fit",
        input: none.with_points(spatial),
        values,
        ends: outer.map(|point| Wanted {
            point: Some(point).filter(|_| exact),
            ..Wanted::default()
        }),
        extrema,
        inflections,
        near: tolerance.map(|tolerance| (points, tolerance)),
    }
}

fn join(random: &mut Random) -> Case {
    let first = calm(random);
    let moved = calm(random).vertices().to_vec();
    let by = random.vector(first.size(), false);
    let moved: Vec<DVec3> = moved.into_iter().map(|vertex| vertex + by).collect();
    let degree = first.degree();
    let count = moved.len().max(degree + 1);
    let moved = (0..count).map(|index| moved[index.min(moved.len() - 1)] + 1e-3 * index as f64);
    let second = FloatPolygon::new(degree, moved.collect(), None, false).expect("a polygon");
    let document = Document::from_curves([
        batten::document::Curve::new("a", first),
        batten::document::Curve::new("b", second),
    ]);
    let ids: Vec<_> = document.ids().collect();
    Case {
        operation: "join",
        input: Operands::new(&document, ids).expect("both are there"),
        // A bridge keeps both parts.
        values: vec![("method", Value::Choice(2))],
        ends: [Wanted::default(); 2],
        extrema: None,
        inflections: None,
        near: None,
    }
}

impl Case {
    fn run(&self) -> Result<Outcome, OperationError> {
        let operation = operations::find(self.operation).expect("an operation");
        let values = operation.values(&self.input, self.values.iter().cloned())?;
        operation.run(&self.input, &values, &Progress::default())
    }

    /// What does not hold of an outcome that says it is reached.
    fn wrong(&self, outcome: &Outcome) -> Option<String> {
        let after = outcome
            .applied_to(self.input.document())
            .expect("edits that can be made");
        let (_, curve) = after.curves().last().expect("a curve");
        let seen = Seen::new(&curve.polygon);
        let ends = self.ends.iter().enumerate();
        let mut missed: Vec<String> = ends.filter_map(|(end, it)| it.missed(&seen, end)).collect();
        let counts = [
            ("extrema", self.extrema, Seen::extrema as fn(&Seen) -> usize),
            ("inflections", self.inflections, Seen::inflections),
        ];
        for (name, wanted, found) in counts {
            let Some(wanted) = wanted else { continue };
            let found = found(&seen);
            if found != wanted {
                missed.push(format!("{found} {name}, not {wanted}"));
            }
        }
        if self.operation == "between" && seen.extrema() > 0 && !is_arc(&seen) {
            missed.push(format!("{} extrema of a monotone segment", seen.extrema()));
        }
        if self.operation == "join" {
            missed.extend(self.parts_changed(&curve.polygon));
        }
        if let Some((points, tolerance)) = &self.near {
            let farthest = points.iter().map(|point| distance(&seen, *point));
            let farthest = farthest.fold(0.0, f64::max);
            if farthest > tolerance * (1.0 + EXACT) {
                missed.push(format!(
                    "a point is {farthest:e} off, {tolerance:e} is allowed"
                ));
            }
        }
        (!missed.is_empty()).then(|| missed.join("; "))
    }

    /// Both curves are parts of the composite, whichever way they run: to the bit, or with halved segments but for
    /// rounding.
    fn parts_changed(&self, composite: &FloatPolygon) -> Option<String> {
        let size = composite.size();
        let missing = self.input.curves().iter().filter(|(_, part)| {
            let mut halved = part.polygon.vertices().to_vec();
            let mut rounding = 0.0;
            !(0..=4).any(|_| {
                let turned: Vec<DVec3> = halved.iter().rev().copied().collect();
                let same = |window: &[DVec3], part: &[DVec3]| {
                    let mut pairs = window.iter().zip(part);
                    pairs.all(|(a, b)| a.distance(*b) <= rounding * size)
                };
                let mut windows = composite.vertices().windows(halved.len());
                let found = windows.any(|it| same(it, &halved) || same(it, &turned));
                halved = with_halved_segments(&halved, composite.degree());
                rounding = 1e-12;
                found
            })
        });
        let missing = missing.count();
        (missing > 0).then(|| format!("{missing} parts are changed"))
    }
}

/// The vertices of the same curve with halved segments, by doubling each vertex and taking n means (Lane and
/// Riesenfeld, 1980).
fn with_halved_segments(vertices: &[DVec3], degree: usize) -> Vec<DVec3> {
    let mut halved: Vec<DVec3> = vertices.iter().flat_map(|it| [*it; 2]).collect();
    for _ in 0..degree {
        let pairs = halved.windows(2);
        halved = pairs.map(|pair| pair[0].midpoint(pair[1])).collect();
    }
    halved
}

/// Whether the curvature of a curve hardly changes.
fn is_arc(seen: &Seen) -> bool {
    let count = 10 * (seen.vertices.len() - seen.degree);
    let values = (0..=count).map(|index| seen.curvature(seen.end(1) * index as f64 / count as f64));
    let values: Vec<f64> = values.collect();
    let [low, high] = [f64::min, f64::max]
        .map(|pick: fn(f64, f64) -> f64| values.iter().copied().fold(values[0], pick));
    high - low <= 1e-3 * (1.0 / seen.size).max(high.abs())
}

/// The distance of a point from a curve: the nearest of many, then Newton's steps.
fn distance(seen: &Seen, point: DVec2) -> f64 {
    let count = 40 * (seen.vertices.len() - seen.degree);
    let end = seen.end(1);
    let place = |index: usize| end * index as f64 / count as f64;
    let off = |u: f64| seen.at(u, 0).distance(point);
    let nearest = (0..=count).min_by(|a, b| off(place(*a)).total_cmp(&off(place(*b))));
    let mut u = place(nearest.unwrap_or_default());
    let mut best = off(u);
    for _ in 0..20 {
        let [at, first, second] = [0, 1, 2].map(|order| seen.at(u, order));
        let slope = first.length_squared() + (at - point).dot(second);
        if slope <= 0.0 {
            break;
        }
        u = (u - (at - point).dot(first) / slope).clamp(0.0, end);
        best = best.min(off(u));
    }
    best
}

/// Run so many cases of a kind: each that says it is reached must hold what is asked.
fn assert_confirmed(make: fn(&mut Random) -> Case, cases: usize, seed: u64) {
    let mut random = Random(seed);
    let mut tally = Tally::default();
    let mut operation = "";
    for number in 0..cases {
        let case = make(&mut random);
        operation = case.operation;
        let Ok(outcome) = case.run() else {
            tally.refused += 1;
            continue;
        };
        tally.reached += usize::from(outcome.reached);
        let wrong = outcome.reached.then(|| case.wrong(&outcome)).flatten();
        tally
            .wrong
            .extend(wrong.map(|wrong| format!("case {number}: {wrong}")));
    }
    println!("{operation}: {cases} cases, {tally:?}");
    assert!(tally.wrong.is_empty(), "{operation}: {tally:#?}");
    assert!(5 * tally.reached > cases, "{operation}: {tally:?}");
}

/// A few and a thousand cases of each kind.
macro_rules! confirmed {
    ($($make:ident, $few:ident, $many:ident;)*) => {$(
        #[test]
        fn $few() {
            assert_confirmed($make, 12, 0x5eed);
        }

        #[test]
        #[ignore = "takes minutes"]
        fn $many() {
            assert_confirmed($make, 1000, 0x1000);
        }
    )*};
}

confirmed! {
    harmonise, harmonised_curves_hold_what_is_asked, a_thousand_harmonised_curves_do;
    between, segments_hold_what_is_asked, a_thousand_segments_do;
    correct_ends, corrected_ends_hold_what_is_asked, a_thousand_corrected_ends_do;
    fit, fits_hold_what_is_asked, a_thousand_fits_do;
    join, joined_curves_hold_what_is_asked, a_thousand_joined_curves_do;
}

/// A case of harmonising that keeps the ends up to a level: 0 for nothing, 3 for the curvature.
fn harmonising(
    degree: usize,
    vertices: &[[f64; 2]],
    level: usize,
    counts: [Option<usize>; 2],
) -> Case {
    let vertices = vertices
        .iter()
        .map(|[x, y]| DVec3::new(*x, *y, 0.0))
        .collect();
    let polygon = FloatPolygon::new(degree, vertices, None, false).expect("a polygon");
    let [extrema, inflections] = counts;
    let mut values = vec![("keep", Value::Choice(level))];
    let given = |count: usize| list(&[count as f64]);
    values.extend(extrema.map(|count| ("extrema", given(count))));
    values.extend(inflections.map(|count| ("inflections", given(count))));
    Case {
        operation: "harmonise",
        ends: kept(&polygon, level),
        input: Runner::of(polygon).input,
        values,
        extrema,
        inflections,
        near: None,
    }
}

#[test]
fn harmonising_neither_turns_nor_stops_nor_bends_kept_ends() {
    let cases = [
        harmonising(
            4,
            &[
                [0.0, 0.0],
                [4.0, 0.0],
                [1.0, 7.0],
                [2.0, 1.0],
                [5.0, 5.0],
                [7.0, 2.0],
                [9.0, 4.0],
            ],
            2,
            [Some(3), Some(2)],
        ),
        harmonising(
            4,
            &[
                [1.0, 7.0],
                [6.0, 0.0],
                [9.0, 1.0],
                [3.0, 3.0],
                [5.0, 6.0],
                [1.0, 5.0],
                [6.0, 8.0],
                [1.0, 8.0],
                [4.0, 1.0],
                [4.0, 8.0],
            ],
            2,
            [None, None],
        ),
        harmonising(
            3,
            &[
                [4.01, 8.92],
                [9.16, 6.2],
                [6.58, 5.24],
                [0.16, 2.53],
                [7.56, 6.47],
            ],
            3,
            [Some(4), Some(1)],
        ),
    ];
    for (number, case) in cases.iter().enumerate() {
        let outcome = case.run().expect("it runs");
        println!(
            "case {number}: reached {}, residual {:?}",
            outcome.reached, outcome.residual
        );
        let wrong = outcome.reached.then(|| case.wrong(&outcome)).flatten();
        assert_eq!(wrong, None, "case {number}");
        assert!(outcome.residual.is_some(), "case {number}");
    }
}

#[test]
fn a_monotone_segment_has_the_curvature_asked_for_or_says_that_it_has_not() {
    let case = Case {
        operation: "between",
        input: Operands::new(&Document::default(), []).expect("none is there"),
        values: vec![
            ("kind", Value::Choice(2)),
            ("from", list(&[0.0, 0.0])),
            ("from-direction", list(&[3.0, -4.0])),
            ("to", list(&[10.0, 0.0])),
            ("to-direction", list(&[3.0, 2.0])),
            ("from-curvature", list(&[0.15])),
        ],
        ends: [
            Wanted {
                point: Some(DVec2::ZERO),
                direction: Some(DVec2::new(3.0, -4.0)),
                curvature: Some(0.15),
            },
            Wanted {
                point: Some(DVec2::new(10.0, 0.0)),
                direction: Some(DVec2::new(3.0, 2.0)),
                curvature: None,
            },
        ],
        extrema: None,
        inflections: None,
        near: None,
    };
    let outcome = case.run().expect("it runs");
    println!(
        "reached {}, residual {:?}",
        outcome.reached, outcome.residual
    );
    assert_eq!(
        outcome.reached.then(|| case.wrong(&outcome)).flatten(),
        None
    );
}

#[test]
fn curves_too_small_to_be_measured_are_refused() {
    for size in [1e-90, 1e-110, 1e-310, 5e-324] {
        let corner = |(x, y): (f64, f64)| DVec3::new(x * size, y * size, 0.0);
        let vertices = [
            (0.0, 0.0),
            (3.0, 1.0),
            (5.0, 4.0),
            (9.0, 5.0),
            (12.0, 2.0),
            (15.0, 7.0),
        ];
        let vertices = vertices.map(corner).to_vec();
        let polygon = FloatPolygon::new(3, vertices, None, false).expect("a polygon");
        let ends = kept(&polygon, 2);
        let runner = Runner::of(polygon);
        let case = |operation, values| Case {
            operation,
            input: runner.input.clone(),
            values,
            ends: [
                Wanted {
                    direction: Some(DVec2::new(-1.0, 2.0)),
                    ..ends[0]
                },
                ends[1],
            ],
            extrema: None,
            inflections: None,
            near: None,
        };
        let corrected = case(
            "correct-ends",
            vec![("start-direction", list(&[-1.0, 2.0]))],
        );
        let harmonised = case("harmonise", vec![("extrema", list(&[0.0]))]);
        if size == 1e-90 {
            let outcome = corrected.run().expect("it runs");
            assert!(
                outcome.reached && corrected.wrong(&outcome).is_none(),
                "{outcome:?}"
            );
            continue;
        }
        for case in [corrected, harmonised] {
            let refused = case.run().expect_err("it is too small").to_string();
            assert!(refused.contains("scale it up"), "{size:e}: {refused}");
        }
    }
}
