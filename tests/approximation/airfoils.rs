//! Fits of airfoils that others have measured, checked by an evaluation of their own.

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use batten::geometry::basis::uniform_basis_derivative;
use batten::geometry::fairing::harmonising::{Harmony, Held, harmonise};
use batten::geometry::features::Turning;
use batten::geometry::fitting::{Extrema, Fitted, PlaneFit, fit_plane};
use batten::geometry::{FloatPolygon, Progress};
use glam::{DVec2, DVec3};
use nalgebra::DMatrix;

/// The degree of all fits.
const DEGREE: usize = 5;

/// The samples of a segment by which a curve is measured.
const SAMPLES: usize = 200;

/// A section turns by half a turn and a little; a loop makes that more than this.
const ONCE_ROUND: f64 = 2.0 * PI;

/// What a fit is, by the test's own evaluation.
struct Seen {
    /// The largest distance of a point from the curve, by the chord.
    largest: f64,
    /// The length of the curve by that of the polyline of the points.
    length: f64,
    /// The largest distance of the curve from that polyline, by three times the larger of the largest distance
    /// of a point and a quarter of the widest gap.
    astray: f64,
    /// How often the slope of the curvature changes its sign.
    extrema: usize,
    vertices: usize,
}

/// The files of a folder: title, points.
fn files(folder: &Path) -> Vec<(String, Vec<DVec2>)> {
    let entries = fs::read_dir(folder).expect("the folder of airfoils");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> = paths.collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == "dat"));
    paths.sort();
    let read = |path: &PathBuf| {
        let bytes = fs::read(path).expect("a file");
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        (name.into_owned(), points(&String::from_utf8_lossy(&bytes)))
    };
    paths.iter().map(read).collect()
}

/// The lines of two numbers, each point once.
fn points(text: &str) -> Vec<DVec2> {
    let lines = text.lines().filter_map(|line| {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map_while(|it| it.parse().ok())
            .collect();
        match numbers[..] {
            [x, y] if x.abs() < 1.6 => Some(DVec2::new(x, y)),
            _ => None,
        }
    });
    let mut points: Vec<DVec2> = lines.collect();
    points.dedup();
    points
}

/// The part of a section from its trailing edge over the upper side to its leading edge.
fn upper(points: &[DVec2]) -> Vec<DVec2> {
    let nose = (0..points.len()).min_by(|a, b| points[*a].x.total_cmp(&points[*b].x));
    points[..=nose.expect("points")].to_vec()
}

/// Evaluate a uniform B-spline by de Boor's algorithm.
fn de_boor(vertices: &[DVec2], degree: usize, u: f64) -> DVec2 {
    let segment = (u as usize).min(vertices.len() - degree - 1);
    let mut near = vertices[segment..=segment + degree].to_vec();
    for level in 1..=degree {
        for index in (level..=degree).rev() {
            // The knots of vertex i are i − n … i + 1.
            let knot = (segment + index) as f64 - degree as f64;
            let share = (u - knot) / (degree + 1 - level) as f64;
            near[index] = near[index - 1].lerp(near[index], share);
        }
    }
    near[degree]
}

fn differences(vertices: &[DVec2]) -> Vec<DVec2> {
    vertices.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

fn distance_to_chord(point: DVec2, chord: &[DVec2]) -> f64 {
    let along = chord[1] - chord[0];
    let share = (point - chord[0]).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    (chord[0] + share.clamp(0.0, 1.0) * along).distance(point)
}

fn look_at(points: &[DVec2], vertices: &[DVec2]) -> Seen {
    let segments = vertices.len() - DEGREE;
    let places = (0..=SAMPLES * segments).map(|it| it as f64 / SAMPLES as f64);
    let places: Vec<f64> = places.collect();
    let curve: Vec<DVec2> = places
        .iter()
        .map(|u| de_boor(vertices, DEGREE, *u))
        .collect();
    let distance = |point: &DVec2| {
        let chords = curve
            .windows(2)
            .map(|chord| distance_to_chord(*point, chord));
        chords.fold(f64::INFINITY, f64::min)
    };
    let largest = points.iter().map(distance).fold(0.0, f64::max);
    let off = |place: &DVec2| {
        let chords = points
            .windows(2)
            .map(|chord| distance_to_chord(*place, chord));
        chords.fold(f64::INFINITY, f64::min)
    };
    let farthest = curve.iter().step_by(7).map(off).fold(0.0, f64::max);
    let length = |points: &[DVec2]| -> f64 {
        points
            .windows(2)
            .map(|pair| pair[0].distance(pair[1]))
            .sum()
    };
    let gaps = points.windows(2).map(|pair| pair[0].distance(pair[1]));
    let gap = gaps.fold(0.0, f64::max);
    let first = differences(vertices);
    let [second, third] = [differences(&first), differences(&differences(&first))];
    let slope = |u: &f64| {
        let [a, b, c] = [
            de_boor(&first, DEGREE - 1, *u),
            de_boor(&second, DEGREE - 2, *u),
            de_boor(&third, DEGREE - 3, *u),
        ];
        let grows = a.perp_dot(c) * a.length_squared();
        let shrinks = 3.0 * a.perp_dot(b) * a.dot(b);
        let rounding = 1e-11 * (grows.abs() + shrinks.abs());
        let slope = grows - shrinks;
        (slope.abs() > rounding).then_some(slope > 0.0)
    };
    let signs: Vec<bool> = places.iter().filter_map(slope).collect();
    let across = points.iter().map(|point| point.x);
    let chord = across.clone().fold(f64::MIN, f64::max) - across.fold(f64::MAX, f64::min);
    Seen {
        largest: largest / chord,
        length: length(&curve) / length(points),
        astray: farthest / (3.0 * largest.max(0.25 * gap)),
        extrema: signs.windows(2).filter(|pair| pair[0] != pair[1]).count(),
        vertices: vertices.len(),
    }
}

/// Fit points, and check what the fit says of itself.
fn fit(name: &str, points: &[DVec2], asked: &PlaneFit) -> (Fitted, Seen) {
    let found = fit_plane(points, asked, &Progress::default());
    let found = found.unwrap_or_else(|error| panic!("{name}: {error}"));
    let vertices = found
        .polygon
        .vertices()
        .iter()
        .map(|vertex| vertex.truncate());
    let seen = look_at(points, &vertices.collect::<Vec<DVec2>>());
    let chord = points.iter().map(|it| it.x).fold(f64::MIN, f64::max)
        - points.iter().map(|it| it.x).fold(f64::MAX, f64::min);
    // The distance that is told is from the part of the curve where the point belongs.
    assert!(seen.largest <= found.largest / chord + 1e-6, "{name}");
    assert_eq!(seen.extrema, found.extrema, "{name}");
    assert!(seen.length < 1.02, "{name}: {} times as long", seen.length);
    let turn = Turning::new(&found.polygon).total().abs();
    assert!(turn < ONCE_ROUND, "{name}: turns by {turn}");
    assert!(seen.astray < 1.0, "{name}: {} astray", seen.astray);
    assert!(
        seen.vertices <= (points.len() / 2).max(DEGREE + 1),
        "{name}"
    );
    (found, seen)
}

fn asked(extrema: Extrema, tolerance: Option<f64>) -> PlaneFit {
    PlaneFit {
        degree: DEGREE,
        extrema,
        tolerance,
        outliers: tolerance.map(|_| Vec::new()),
        ..PlaneFit::default()
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/airfoils")
}

#[test]
fn sections_have_the_wished_number_of_extrema() {
    for (extrema, limit) in [(1, 1e-3), (3, 3.5e-4)] {
        let fits = files(&folder()).into_iter().map(|(name, points)| {
            let (found, seen) = fit(&name, &points, &asked(Extrema::Exactly(extrema), None));
            assert!(found.holds && found.extrema == extrema, "{name}");
            assert!(seen.vertices <= 40, "{name}");
            seen.largest
        });
        let median = median(fits.collect());
        assert!(median <= limit, "{extrema} extrema: {median}");
    }
}

#[test]
fn upper_sides_have_the_wished_number_of_extrema() {
    for (extrema, limit) in [(0, 6e-4), (2, 1.5e-4)] {
        let fits = files(&folder()).into_iter().map(|(name, points)| {
            let asked = asked(Extrema::Exactly(extrema), None);
            let (found, seen) = fit(&name, &upper(&points), &asked);
            assert!(found.holds && found.extrema == extrema, "{name}");
            seen.largest
        });
        let median = median(fits.collect());
        assert!(median <= limit, "{extrema} extrema: {median}");
    }
}

#[test]
fn a_tolerance_of_a_thousandth_is_kept_with_few_extrema() {
    let fits = files(&folder()).into_iter().map(|(name, points)| {
        let (found, seen) = fit(&name, &points, &asked(Extrema::Fewest, Some(1e-3)));
        assert!(found.deviation <= 1e-3 && seen.largest <= 1e-3, "{name}");
        assert!(found.extrema <= 6, "{name}: {}", found.extrema);
        found.extrema as f64
    });
    assert!(median(fits.collect()) <= 2.0);
}

#[test]
fn fits_without_wishes_are_near_and_calm() {
    let fits = files(&folder()).into_iter().map(|(name, points)| {
        let (_, seen) = fit(&name, &points, &asked(Extrema::Fewest, None));
        seen.largest
    });
    let median = median(fits.collect());
    assert!(median <= 7e-4, "{median}");
}

#[test]
fn no_loop_hides_in_a_nose() {
    for (name, points) in files(&folder().join("loops")) {
        let (found, _) = fit(&name, &points, &asked(Extrema::Fewest, None));
        assert!(found.holds, "{name}");
    }
}

#[test]
fn beside_a_section_whose_ends_cross_there_is_one_whose_ends_do_not() {
    // What is not exact may be farther off by this factor.
    const ABOUT: f64 = 1.25;
    let mut sections = files(&folder()).into_iter();
    let (_, points) = sections
        .find(|(name, _)| name == "e339")
        .expect("a section");
    let asked = asked(Extrema::Fewest, None);
    let found = fit_plane(&points, &asked, &Progress::default()).expect("a fit");
    assert!(found.crossing.is_some());
    let exact = found.uncrossed.iter().find(|it| it.has_exact_ends);
    let exact = &exact.expect("a fit with exact ends").fitted;
    assert!(exact.holds && exact.crossing.is_none());
    assert!(exact.deviation <= ABOUT * found.tolerance.max(found.deviation));
    let ends = [0.0, exact.polygon.segments() as f64];
    for (u, point) in ends.into_iter().zip([points[0], points[points.len() - 1]]) {
        let end = exact.polygon.point(u).truncate();
        assert!(end.distance(point) < 1e-9, "{end}");
    }
}

/// Print a line for each wish: how many fits hold, distances by the chord, vertices, seconds.
#[test]
#[ignore = "takes minutes; BATTEN_AIRFOILS names the folder of files"]
fn all_wishes_of_all_sections() {
    let folder = std::env::var_os("BATTEN_AIRFOILS").map_or_else(folder, PathBuf::from);
    let files = files(&folder);
    let wishes = [1, 2, 3].map(|extrema| (asked(Extrema::Exactly(extrema), None), false));
    let sides = [0, 1, 2, 3].map(|extrema| (asked(Extrema::Exactly(extrema), None), true));
    let near = [1e-3, 5e-4, 2e-4].map(|it| (asked(Extrema::Fewest, Some(it)), false));
    let plain = [(asked(Extrema::Fewest, None), false)];
    for (asked, is_upper) in wishes.into_iter().chain(sides).chain(near).chain(plain) {
        let mut rows: Vec<(bool, Seen, f64)> = Vec::new();
        for (name, points) in &files {
            let points = if is_upper {
                upper(points)
            } else {
                points.clone()
            };
            let start = Instant::now();
            let (found, seen) = fit(name, &points, &asked);
            let near = asked
                .tolerance
                .is_none_or(|tolerance| found.deviation <= tolerance);
            rows.push((found.holds && near, seen, start.elapsed().as_secs_f64()));
        }
        let mut largest: Vec<f64> = rows.iter().map(|(_, seen, _)| seen.largest).collect();
        largest.sort_by(f64::total_cmp);
        let at = |share: f64| largest[(share * (largest.len() - 1) as f64) as usize];
        let times: Vec<f64> = rows.iter().map(|(_, _, time)| *time).collect();
        println!(
            "{:?} {:?} {}: {} of {}; largest {:.1e} {:.1e} {:.1e}; extrema {}, vertices {}; {:.2} s, {:.1} s",
            asked.extrema,
            asked.tolerance,
            if is_upper { "upper" } else { "whole" },
            rows.iter().filter(|(reached, ..)| *reached).count(),
            rows.len(),
            at(0.5),
            at(0.9),
            at(1.0),
            median(
                rows.iter()
                    .map(|(_, seen, _)| seen.extrema as f64)
                    .collect()
            ),
            median(
                rows.iter()
                    .map(|(_, seen, _)| seen.vertices as f64)
                    .collect()
            ),
            median(times.clone()),
            times.iter().fold(0.0, |most: f64, it| most.max(*it)),
        );
    }
}

/// A float polygon near points without conditions: least squares with a little of third differences, and
/// parameters of the nearest points.
fn unconditioned(points: &[DVec2], count: usize) -> Vec<DVec2> {
    const ROUNDS: usize = 6;
    let segments = (count - DEGREE) as f64;
    let chords = points
        .windows(2)
        .map(|pair| pair[0].distance(pair[1]).sqrt());
    let mut places = vec![0.0];
    for chord in chords {
        places.push(places[places.len() - 1] + chord);
    }
    let all = places[places.len() - 1];
    let mut places: Vec<f64> = places.iter().map(|it| it * segments / all).collect();
    let mut vertices = Vec::new();
    for _ in 0..ROUNDS {
        let rows = points.len() + count - 3;
        let mut matrix = DMatrix::<f64>::zeros(rows, count);
        let mut right = DMatrix::<f64>::zeros(rows, 2);
        for (row, (point, u)) in points.iter().zip(&places).enumerate() {
            let first = (*u as usize).min(count - DEGREE - 1);
            for (k, value) in uniform_basis_derivative(DEGREE, 0, u - first as f64)
                .into_iter()
                .enumerate()
            {
                matrix[(row, first + k)] = value;
            }
            (right[(row, 0)], right[(row, 1)]) = (point.x, point.y);
        }
        let fair = (1e-4 * points.len() as f64 / count as f64).sqrt();
        for first in 0..count - 3 {
            for (k, factor) in [-1.0, 3.0, -3.0, 1.0].into_iter().enumerate() {
                matrix[(points.len() + first, first + k)] = fair * factor;
            }
        }
        let solved = matrix
            .svd(true, true)
            .solve(&right, 1e-14)
            .expect("a solution");
        vertices = (0..count)
            .map(|it| DVec2::new(solved[(it, 0)], solved[(it, 1)]))
            .collect();
        for (point, u) in points.iter().zip(&mut places) {
            let near = (0..=80).map(|it| (*u + (it - 40) as f64 / 80.0).clamp(0.0, segments));
            let off = |u: &f64| de_boor(&vertices, DEGREE, *u).distance(*point);
            let best = near.min_by(|a, b| off(a).total_cmp(&off(b)));
            *u = best.unwrap_or(*u);
        }
        places[0] = 0.0;
        let last = places.len() - 1;
        places[last] = segments;
    }
    vertices
}

#[test]
fn polygons_of_sections_are_harmonised_with_their_ends() {
    for (extrema, limit) in [(1, 1.2e-3), (3, 6e-4)] {
        let moves = files(&folder()).into_iter().map(|(name, points)| {
            let vertices = unconditioned(&points, 24);
            let pairs: Vec<(f64, f64)> = vertices.iter().map(|it| (it.x, it.y)).collect();
            let polygon = FloatPolygon::planar(DEGREE, &pairs).expect("a polygon");
            let harmony = Harmony {
                stretch: None,
                ends: [Held::Position; 2],
                locked: &[],
                extrema: Some(extrema),
                inflections: None,
                torsion_extrema: None,
                largest_deviation: Some(0.05 * polygon.size()),
                symmetry: None,
            };
            let found = harmonise(&polygon, &harmony, &Progress::default()).expect("a result");
            assert!(found.reached, "{name}: {extrema}");
            let after = found
                .polygon
                .vertices()
                .iter()
                .map(|vertex| vertex.truncate());
            let after: Vec<DVec2> = after.collect();
            let end = polygon.segments() as f64;
            for u in [0.0, end] {
                let [before, after] = [&vertices, &after].map(|it| de_boor(it, DEGREE, u));
                assert!(before.distance(after) < 1e-9, "{name}");
            }
            let samples = (0..=400).map(|it| de_boor(&vertices, DEGREE, end * it as f64 / 400.0));
            let seen = look_at(&samples.collect::<Vec<DVec2>>(), &after);
            assert_eq!(seen.extrema, extrema, "{name}");
            seen.largest
        });
        let median = median(moves.collect());
        assert!(median <= limit, "{extrema} extrema: {median}");
    }
}

#[test]
fn a_polygon_that_folds_gives_way_to_one_that_does_not() {
    for section in ["ah6407", "hobie"] {
        let mut points = files(&folder()).into_iter();
        let (_, points) = points.find(|(name, _)| name == section).expect("a section");
        let (found, _) = fit(section, &points, &asked(Extrema::Exactly(3), None));
        let legs: Vec<DVec3> = found
            .polygon
            .vertices()
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect();
        let turns = legs.windows(2).map(|pair| pair[0].angle_between(pair[1]));
        let largest = turns.fold(0.0, f64::max).to_degrees();
        assert!(found.holds && largest < 120.0, "{section}: {largest}");
    }
}

#[test]
fn a_bend_that_the_points_do_not_show_is_told() {
    // With too few extrema the nose of the first becomes a corner. That of the second does in the fit with the smallest
    // error, whose polygon folds.
    for (section, extrema, is_told) in [
        ("goe114", 1, true),
        ("nm-retro-saumon-30", 1, false),
        ("naca2412", 1, false),
    ] {
        let points = files(&folder())
            .into_iter()
            .find(|(name, _)| name == section);
        let (_, points) = points.expect("a section");
        let (found, _) = fit(section, &points, &asked(Extrema::Exactly(extrema), None));
        assert!(found.holds, "{section}");
        let bend = found.sharp_bend.filter(|it| it.curvature > 4.0 * it.shown);
        assert_eq!(bend.is_some(), is_told, "{section}: {:?}", found.sharp_bend);
        let nose = bend.map_or(0.0, |it| it.at.length());
        assert!(nose < 0.01, "{section}: {nose}");
    }
}
