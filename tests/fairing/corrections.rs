//! End corrections: in turn, by rigid motions of the terminal vertices, and jointly, by the least
//! disturbance, which a dense solver of its own confirms.

use crate::common::Random;
use batten::geometry::basis::uniform_basis_derivative;
use batten::geometry::end_correction::{
    EndDifference, EndOverlap, EndTarget, correct_end, correct_in_turn,
};
use batten::geometry::fairing::joint_correction::{
    CorrectionError, Disturbance, JointCorrection, correct_jointly,
};
use batten::geometry::paper::regular_polygon;
use batten::geometry::{End, FloatPolygon, Progress, rotation_between};
use glam::{DMat3, DVec3};
use nalgebra::{DMatrix, DVector};

/// The residual that counts as met, in units of the curve's size.
const MET: f64 = 1e-12;

/// How far the moves may lie from those of the dense solver, in units of the largest.
const SAME_MOVES: f64 = 1e-8;

/// Targets tried for each kind of curve.
const TRIALS: usize = 1000;

/// The objective of the joint correction: first differences, and the moves themselves by this.
const FIDELITY: f64 = 1e-3;
const TURNED_FIDELITY: f64 = 0.1;

fn residual(polygon: &FloatPolygon, targets: &[(End, EndTarget)], size: f64) -> f64 {
    let ends = targets.iter();
    ends.map(|(end, target)| EndDifference::between(polygon, *end, target).residual(size))
        .fold(0.0, f64::max)
}

/// Targets within `shift` sizes and about `angle` radians of the actual ends.
fn targets_near(
    random: &mut Random,
    polygon: &FloatPolygon,
    shift: f64,
    angle: f64,
    in_space: bool,
) -> Vec<(End, EndTarget)> {
    let both = End::BOTH.into_iter().map(|end| {
        let jet = polygon.end_jet(end);
        let tangent = jet.tangent().expect("a tangent");
        let target = EndTarget {
            point: jet.point + random.vector(shift * polygon.size(), in_space),
            direction: Some(tangent + random.vector(angle, in_space)),
            ..EndTarget::default()
        };
        (end, target)
    });
    both.collect()
}

#[test]
fn apart_ends_are_corrected_in_one_pass_and_keep_their_curvature() {
    let mut random = Random(1);
    for trial in 0..TRIALS {
        let degree = 2 + trial % 11;
        let in_space = trial % 3 == 0;
        let count = 2 * degree + trial % 5;
        let polygon = random.gentle(degree, count, in_space, trial % 2 == 0);
        assert_eq!(EndOverlap::of(&polygon), EndOverlap::None);
        let targets = targets_near(&mut random, &polygon, 0.3, 0.8, in_space);
        let size = polygon.size();
        let outcome = correct_in_turn(&polygon, &targets, MET * size).expect("in range");
        let left = outcome.residuals.last().copied().unwrap_or(f64::NAN);
        assert!(
            outcome.converged && outcome.passes() == 1,
            "trial {trial}: {left:e}"
        );
        // Degree 2 has two terminal vertices, but its curvature three.
        for end in End::BOTH.into_iter().filter(|_| degree > 2) {
            let (before, after) = (polygon.end_jet(end), outcome.polygon.end_jet(end));
            let change = after.curvature() / before.curvature() - 1.0;
            assert!(
                change.abs() <= 1e-11,
                "trial {trial}: curvature changed by {change:e}"
            );
        }
        let (end, target) = &targets[trial % 2];
        let corrected = correct_end(&polygon, *end, target).expect("in range");
        // These vertices fix the point and n − 1 derivatives there.
        let fixed = polygon.terminal_vertices(end.other());
        let other = |polygon: &FloatPolygon| polygon.vertices()[fixed.clone()].to_vec();
        assert_eq!(other(&corrected), other(&polygon), "the other end moved");
    }
}

#[test]
fn the_loop_converges_or_stops_and_changes_nothing() {
    let mut random = Random(2);
    for degree in 3..=12 {
        for count in degree + 1..2 * degree {
            let polygon = random.gentle(degree, count, false, false);
            let targets = targets_near(&mut random, &polygon, 0.05, 0.2, false);
            let tolerance = MET * polygon.size();
            let outcome = correct_in_turn(&polygon, &targets, tolerance).expect("in range");
            let overlap = EndOverlap::of(&polygon);
            if count == degree + 1 {
                assert_eq!(overlap, EndOverlap::OneSegment);
                assert!(
                    !outcome.converged,
                    "degree {degree} converged in one segment"
                );
                assert!(outcome.passes() <= 8, "{} passes", outcome.passes());
            } else {
                let shared = 2 * degree - count;
                assert_eq!(overlap, EndOverlap::Partial { shared });
            }
            if outcome.converged {
                let left = residual(&outcome.polygon, &targets, polygon.size());
                assert!(left <= tolerance);
            } else {
                assert_eq!(outcome.polygon, polygon);
            }
        }
    }
}

#[test]
fn more_vertices_make_the_loop_converge_faster() {
    // Degree 9 on the corners of a dodecagon: from N = 10, which never converges, to N = 18,
    // which takes one pass.
    let mut passes = Vec::new();
    for count in 14..=18 {
        let corners = (0..count).map(|i| {
            let (sine, cosine) = (std::f64::consts::TAU / 12.0 * i as f64).sin_cos();
            (10.0 * sine, 10.0 * cosine)
        });
        let polygon = FloatPolygon::planar(9, &corners.collect::<Vec<_>>()).expect("valid");
        let targets = targets_near(&mut Random(5), &polygon, 0.02, 0.05, false);
        let tolerance = MET * polygon.size();
        let outcome = correct_in_turn(&polygon, &targets, tolerance).expect("in range");
        assert!(outcome.converged, "N = {count}: {:?}", outcome.residuals);
        passes.push(outcome.passes());
    }
    assert!(passes.is_sorted_by(|a, b| a > b), "{passes:?}");
    assert_eq!(passes.last(), Some(&1));
}

#[track_caller]
fn check_joint(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    disturbance: Disturbance,
) -> JointCorrection {
    let found = match correct_jointly(polygon, targets, disturbance, &[], &Progress::default()) {
        Ok(found) => found,
        Err(error) => panic!("{error}: {polygon:?} {targets:?}"),
    };
    let size = polygon.size();
    let left = residual(&found.polygon, targets, size);
    assert!(left <= MET * size, "residual {:e} of the size", left / size);
    assert_eq!(found.residual, left);
    for (end, target) in targets {
        let tangent = found.polygon.end_jet(*end).first;
        let forward = target
            .direction
            .is_none_or(|direction| tangent.dot(direction) > 0.0);
        assert!(forward, "the tangent at the {} flipped", end.name());
    }
    found
}

/// The disturbances by differences of order 1 to 3, of turned ends or not.
fn disturbances(turned: bool) -> [Disturbance; 3] {
    [1, 2, 3].map(|order| match turned {
        true => Disturbance::Turned(order),
        false => Disturbance::Differences(order),
    })
}

fn check_joint_for_many(seed: u64, in_space: bool, rational: bool) {
    let mut random = Random(seed);
    for trial in 0..TRIALS {
        let degree = 2 + trial % 11;
        let fewest = degree + 1 + usize::from(in_space && degree == 2);
        let count = fewest + (trial / 11) % (degree + 2);
        let polygon = arc(&mut random, degree, count, in_space, rational);
        let targets = targets_near(&mut random, &polygon, 0.01, 0.03, in_space);
        let turned = trial % 2 == 0;
        let found = check_joint(&polygon, &targets, disturbances(turned)[0]);
        if trial % 7 == 0 {
            let expected = dense_moves(&polygon, &targets, in_space, turned);
            let moves = polygon.vertices().iter().zip(found.polygon.vertices());
            let scale = moves.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
            for (index, expected) in expected.iter().enumerate() {
                let movement = found.polygon.vertex(index) - polygon.vertex(index);
                let error = movement.distance(*expected) / scale;
                assert!(error <= SAME_MOVES, "trial {trial}: off by {error:e}");
            }
        }
    }
}

/// Legs of about 1 that turn steadily, so that both ends have room to be corrected.
fn arc(
    random: &mut Random,
    degree: usize,
    count: usize,
    in_space: bool,
    rational: bool,
) -> FloatPolygon {
    let (mut angle, mut vertex) = (random.between(0.0, 6.0), random.vector(5.0, in_space));
    let mut vertices = vec![vertex];
    while vertices.len() < count {
        let rise = if in_space {
            random.between(-0.2, 0.2)
        } else {
            0.0
        };
        angle += random.between(0.25, 0.45);
        vertex += random.between(0.9, 1.1) * DVec3::new(angle.cos(), angle.sin(), rise);
        vertices.push(vertex);
    }
    let weights = (0..count).map(|_| random.between(0.8, 1.25)).collect();
    let weights = Some(weights).filter(|_| rational);
    FloatPolygon::new(degree, vertices, weights, false).expect("a valid polygon")
}

/// Solve for the moves with dense systems: of turned ends for the points alone, whose derivatives have the lengths that
/// are kept, then for all. Without vertices enough for these lengths they are free.
fn dense_moves(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    in_space: bool,
    turned: bool,
) -> Vec<DVec3> {
    let (points, directions) = (
        point_rows(polygon, targets, in_space),
        direction_rows(polygon, targets, in_space),
    );
    let moves = dense_solution(polygon, &points, in_space, turned);
    let moved = polygon.vertices().iter().zip(moves).enumerate();
    let moved: Vec<(usize, DVec3)> = moved
        .map(|(index, (vertex, movement))| (index, *vertex + movement))
        .collect();
    let mut placed = polygon.clone();
    placed.move_vertices(moved).expect("in range");
    let lengths = targets.iter().map(|(end, target)| {
        let (_, tangent) = end_influence(polygon, *end);
        let direction = target.direction.expect("a direction").normalize();
        let own = polygon.end_jet(*end).first.dot(direction);
        (tangent, direction, placed.end_jet(*end).speed() - own)
    });
    let rows: Vec<Row> = points.into_iter().chain(directions).collect();
    let all: Vec<Row> = rows.iter().cloned().chain(lengths).collect();
    let unknowns = polygon.vertices().len() * if in_space { 3 } else { 2 };
    let turns = turned && all.len() <= unknowns;
    dense_solution(polygon, if turns { &all } else { &rows }, in_space, turned)
}

/// The weight μ of the moves.
fn fidelity(turned: bool) -> f64 {
    if turned { TURNED_FIDELITY } else { FIDELITY }
}

/// Weights of the vertices' moves along an axis, and their sum.
type Row = (Vec<f64>, DVec3, f64);

fn point_rows(polygon: &FloatPolygon, targets: &[(End, EndTarget)], in_space: bool) -> Vec<Row> {
    let axes = &[DVec3::X, DVec3::Y, DVec3::Z][..if in_space { 3 } else { 2 }];
    let rows = targets.iter().flat_map(|(end, target)| {
        let (point, _) = end_influence(polygon, *end);
        let by = target.point - polygon.end_jet(*end).point;
        let row = move |axis: &DVec3| (point.clone(), *axis, by.dot(*axis));
        axes.iter().map(row)
    });
    rows.collect()
}

fn direction_rows(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    in_space: bool,
) -> Vec<Row> {
    let rows = targets.iter().flat_map(|(end, target)| {
        let (_, tangent) = end_influence(polygon, *end);
        let own = polygon.end_jet(*end).first;
        let direction = target.direction.expect("a direction").normalize();
        let across = if in_space {
            let (first, second) = direction.any_orthonormal_pair();
            vec![first, second]
        } else {
            vec![DVec3::new(-direction.y, direction.x, 0.0)]
        };
        let row = move |axis: DVec3| (tangent.clone(), axis, -own.dot(axis));
        across.into_iter().map(row)
    });
    rows.collect()
}

/// The least moves under rows, from one dense system of moves and multipliers.
fn dense_solution(
    polygon: &FloatPolygon,
    rows: &[Row],
    in_space: bool,
    turned: bool,
) -> Vec<DVec3> {
    let fidelity = fidelity(turned);
    let count = polygon.vertices().len();
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let dimensions = if in_space { 3 } else { 2 };
    let unknowns = count * dimensions;
    let mut matrix = DMatrix::zeros(unknowns + rows.len(), unknowns + rows.len());
    for dimension in 0..dimensions {
        for index in 0..count {
            let here = dimension * count + index;
            matrix[(here, here)] += fidelity;
            if index + 1 < count {
                matrix[(here, here)] += 1.0;
                matrix[(here + 1, here + 1)] += 1.0;
                matrix[(here, here + 1)] -= 1.0;
                matrix[(here + 1, here)] -= 1.0;
            }
        }
    }
    let mut right = DVector::zeros(unknowns + rows.len());
    for (number, (stencil, axis, value)) in rows.iter().enumerate() {
        right[unknowns + number] = *value;
        for dimension in 0..dimensions {
            for (index, weight) in stencil.iter().enumerate() {
                let entry = weight * axis.dot(axes[dimension]);
                matrix[(unknowns + number, dimension * count + index)] = entry;
                matrix[(dimension * count + index, unknowns + number)] = entry;
            }
        }
    }
    let solution = matrix
        .full_piv_lu()
        .solve(&right)
        .expect("a regular system");
    let coordinate = |dimension: usize, index: usize| {
        if dimension < dimensions {
            solution[dimension * count + index]
        } else {
            0.0
        }
    };
    (0..count)
        .map(|index| DVec3::from_array([0, 1, 2].map(|axis| coordinate(axis, index))))
        .collect()
}

/// The weights with which the vertices enter an end's point and first derivative.
fn end_influence(polygon: &FloatPolygon, end: End) -> (Vec<f64>, Vec<f64>) {
    let degree = polygon.degree();
    let (t, first) = match end {
        End::Start => (0.0, 0),
        End::Finish => (1.0, polygon.segments() - 1),
    };
    let basis: Vec<f64> = uniform_basis_derivative(degree, 0, t);
    let slopes: Vec<f64> = uniform_basis_derivative(degree, 1, t);
    let weight = |j: usize| polygon.weight(first + j);
    let sum: f64 = (0..=degree).map(|j| weight(j) * basis[j]).sum();
    let slope: f64 = (0..=degree).map(|j| weight(j) * slopes[j]).sum();
    let count = polygon.vertices().len();
    let (mut point, mut tangent) = (vec![0.0; count], vec![0.0; count]);
    for j in 0..=degree {
        point[first + j] = weight(j) * basis[j] / sum;
        tangent[first + j] = weight(j) * (slopes[j] * sum - basis[j] * slope) / (sum * sum);
    }
    (point, tangent)
}

#[test]
fn joint_correction_in_the_plane() {
    check_joint_for_many(10, false, false);
}

#[test]
fn joint_correction_in_space() {
    check_joint_for_many(11, true, false);
}

#[test]
fn joint_correction_of_rational_curves() {
    check_joint_for_many(12, false, true);
    check_joint_for_many(13, true, true);
}

#[test]
fn joint_correction_of_the_ninth_degree_arc() {
    let arc = regular_polygon(9, 12, 10.0).expect("a valid arc");
    let mut random = Random(14);
    for _ in 0..TRIALS {
        let targets = targets_near(&mut random, &arc, 0.02, 0.1, false);
        let found = check_joint(&arc, &targets, Disturbance::Differences(1));
        assert!(found.polygon.is_planar());
    }
}

#[test]
fn tangents_are_never_flipped_by_large_targets() {
    let arc = regular_polygon(9, 12, 10.0).expect("a valid arc");
    let mut random = Random(15);
    let mut solved = 0;
    for _ in 0..TRIALS {
        let targets = targets_near(&mut random, &arc, 0.5, 3.0, false);
        if let Ok(found) = correct_jointly(
            &arc,
            &targets,
            Disturbance::Differences(1),
            &[],
            &Progress::default(),
        ) {
            solved += 1;
            for (end, target) in &targets {
                let direction = target.direction.expect("a direction");
                assert!(found.polygon.end_jet(*end).first.dot(direction) > 0.0);
            }
        }
    }
    assert_eq!(solved, TRIALS);
}

#[test]
fn degree_1_has_its_direction_from_two_vertices() {
    let mut random = Random(16);
    for count in 4..8 {
        let polygon = arc(&mut random, 1, count, false, false);
        let targets = targets_near(&mut random, &polygon, 0.05, 0.2, false);
        for turned in [false, true] {
            check_joint(&polygon, &targets, disturbances(turned)[0]);
        }
        let tolerance = MET * polygon.size();
        let outcome = correct_in_turn(&polygon, &targets, tolerance).expect("in range");
        assert!(outcome.converged && outcome.passes() == 1);
    }
    for count in 2..4 {
        let polygon = arc(&mut random, 1, count, false, false);
        let mut targets = targets_near(&mut random, &polygon, 0.05, 0.2, false);
        targets
            .iter_mut()
            .for_each(|(_, target)| target.direction = None);
        for turned in [false, true] {
            check_joint(&polygon, &targets, disturbances(turned)[0]);
        }
    }
}

#[test]
fn what_cannot_be_solved_says_so() {
    let mut random = Random(17);
    // Two points and two directions in space are ten conditions, three vertices nine numbers.
    let polygon = arc(&mut random, 2, 3, true, false);
    let targets = targets_near(&mut random, &polygon, 0.01, 0.03, true);
    match correct_jointly(
        &polygon,
        &targets,
        Disturbance::Differences(1),
        &[],
        &Progress::default(),
    ) {
        Err(error @ CorrectionError::NotSolvable { .. }) => {
            let message = error.to_string();
            let start = "10 end conditions cannot be met by 9 coordinates that may change (off by";
            assert!(message.starts_with(start), "{message}");
        }
        other => panic!("{other:?}"),
    }
    let vertices = polygon.vertices().to_vec();
    let periodic = FloatPolygon::new(2, vertices, None, true).expect("valid");
    let refused = correct_jointly(
        &periodic,
        &targets,
        Disturbance::Differences(1),
        &[],
        &Progress::default(),
    );
    assert_eq!(refused, Err(CorrectionError::Periodic));
    let mut nowhere = targets;
    nowhere[1].1.direction = Some(DVec3::ZERO);
    let refused = correct_jointly(
        &polygon,
        &nowhere,
        Disturbance::Differences(1),
        &[],
        &Progress::default(),
    );
    assert_eq!(
        refused,
        Err(CorrectionError::NoDirection { end: End::Finish })
    );
}

#[test]
fn rotations_take_one_direction_to_the_other_also_near_half_a_turn() {
    let mut random = Random(18);
    for trial in 0..TRIALS {
        let in_space = trial % 4 != 0;
        let from = random.vector(2.0, in_space);
        let nudge = 10.0_f64.powi(-((trial % 20) as i32));
        let to = match trial % 3 {
            0 => random.vector(1e-3, in_space),
            1 => -from + random.vector(nudge, in_space),
            _ => from + random.vector(nudge, in_space),
        };
        let rotation = rotation_between(from, to).expect("directions");
        let found = rotation * from.normalize();
        let error = found.distance(to.normalize());
        assert!(
            error <= 1e-15 * 4.0,
            "trial {trial}: {from} to {to} is off by {error:e}"
        );
        let square = rotation * rotation.transpose() - DMat3::IDENTITY;
        let largest = square
            .to_cols_array()
            .into_iter()
            .map(f64::abs)
            .fold(0.0, f64::max);
        assert!(largest <= 1e-15 * 4.0, "not a rotation by {largest:e}");
    }
    assert_eq!(rotation_between(DVec3::ZERO, DVec3::X), None);
}

/// The curvature and slope that count as met, in units of what is asked, and of 1 over the size and
/// its square where less is asked.
const CURVATURE_MET: f64 = 1e-10;

/// How an end is asked for: up to which derivative.
fn target_of(polygon: &FloatPolygon, end: End, level: usize) -> EndTarget {
    let (jet, planar) = (polygon.end_jet(end), polygon.is_planar());
    EndTarget {
        point: jet.point,
        direction: jet.tangent().filter(|_| level > 0),
        curvature: Some(jet.curvature_of(planar)).filter(|_| level > 1),
        normal: Some(jet.first.cross(jet.second)).filter(|_| level > 1 && !planar),
        slope: Some(jet.curvature_slope(planar)).filter(|_| level > 2),
    }
}

/// How many numbers a target prescribes, up to this derivative at each end.
fn conditions(level: usize, planar: bool) -> usize {
    let numbers = if planar { [2, 3, 4, 5] } else { [3, 5, 8, 9] };
    2 * numbers[level]
}

#[test]
fn curvature_and_slope_are_met_where_they_can_be() {
    let mut random = Random(21);
    let mut missed = Vec::new();
    for trial in 0..TRIALS {
        let degree = 2 + trial % 11;
        let (in_space, rational) = (trial % 3 == 0, trial % 2 == 0);
        let count = degree + 1 + (random.bits() as usize) % (2 * degree);
        let polygon = arc(&mut random, degree, count, in_space, rational);
        let mut perturbed = polygon.clone();
        let moves = polygon.vertices().iter().enumerate();
        let moves: Vec<(usize, DVec3)> = moves
            .map(|(index, vertex)| (index, *vertex + random.vector(0.03, in_space)))
            .collect();
        perturbed.move_vertices(moves).expect("in range");
        let freedoms = count * if in_space { 3 } else { 2 };
        let mut level = if degree == 2 { 2 } else { 3 };
        while conditions(level, !in_space) > freedoms {
            level -= 1;
        }
        let targets = End::BOTH.map(|end| (end, target_of(&perturbed, end, level)));
        let turned = trial % 80 < 40 && level > 0 && conditions(level, !in_space) + 2 <= freedoms;
        for (order, disturbance) in (1..=3).zip(disturbances(turned)) {
            let found = match correct_jointly(
                &polygon,
                &targets,
                disturbance,
                &[],
                &Progress::default(),
            ) {
                Ok(found) => found,
                Err(error) => {
                    missed.push(format!("{trial} order {order} degree {degree} N {count} space {in_space} rational {rational} level {level}: {error}"));
                    continue;
                }
            };
            let size = polygon.size();
            if trial % 40 == 0 {
                let slope = unexplained(&polygon, &found.polygon, (level, turned), order);
                assert!(
                    slope <= STATIONARY,
                    "trial {trial} order {order}: {slope:e}"
                );
            }
            for (end, target) in &targets {
                let left = EndDifference::between(&found.polygon, *end, target);
                let placed = EndDifference {
                    curvature: 0.0,
                    slope: 0.0,
                    plane: 0.0,
                    ..left
                };
                assert!(
                    placed.residual(size) <= MET * size,
                    "trial {trial}: {left:?}"
                );
                assert!(left.plane <= CURVATURE_MET, "trial {trial}: {left:?}");
                let unit = |wanted: Option<f64>, least: f64| wanted.unwrap_or(0.0).abs().max(least);
                let curvature = left.curvature.abs() / unit(target.curvature, 1.0 / size);
                let slope = left.slope.abs() / unit(target.slope, 1.0 / (size * size));
                assert!(curvature <= CURVATURE_MET, "trial {trial}: {curvature:e}");
                assert!(slope <= CURVATURE_MET, "trial {trial}: {slope:e}");
                let tangent = found.polygon.end_jet(*end).first;
                assert!(target.direction.is_none_or(|it| tangent.dot(it) > 0.0));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

/// How much of the objective's gradient the conditions may leave unexplained, as a share of it:
/// differences of the conditions leave about the cube root of the rounding squared, times what
/// third derivatives amplify it by.
const STATIONARY: f64 = 1e-4;

/// The share of the gradient of the objective at a correction that is no combination of gradients of
/// what is held at the ends, of turned ends the lengths of the derivatives too: 0 where what is not asked about moves
/// least.
fn unexplained(
    before: &FloatPolygon,
    after: &FloatPolygon,
    (level, turned): (usize, bool),
    order: usize,
) -> f64 {
    let fidelity = fidelity(turned);
    let dimensions = if before.is_planar() { 2 } else { 3 };
    let count = before.vertices().len();
    let unknowns = count * dimensions;
    let moves: Vec<DVec3> = before
        .vertices()
        .iter()
        .zip(after.vertices())
        .map(|(a, b)| *b - *a)
        .collect();
    // Differences of differences: the transposed differences have alternating signs.
    let mut gradient = DVector::zeros(unknowns);
    let binomial = [
        [1.0, -1.0, 0.0, 0.0],
        [1.0, -2.0, 1.0, 0.0],
        [1.0, -3.0, 3.0, -1.0],
    ][order - 1];
    for dimension in 0..dimensions {
        let value = |index: usize| moves[index][dimension];
        for index in 0..count {
            gradient[index * dimensions + dimension] += fidelity * value(index);
        }
        for first in 0..count.saturating_sub(order) {
            let difference: f64 = (0..=order).map(|k| binomial[k] * value(first + k)).sum();
            for k in 0..=order {
                gradient[(first + k) * dimensions + dimension] += binomial[k] * difference;
            }
        }
    }
    let held = |polygon: &FloatPolygon| -> Vec<f64> {
        let ends = End::BOTH.into_iter().flat_map(|end| {
            let target = target_of(polygon, end, level);
            let mut numbers = target.point.to_array().to_vec();
            numbers.extend(target.direction.unwrap_or_default().to_array());
            numbers.extend(target.curvature);
            let normal = target.normal.unwrap_or_default();
            numbers.extend(normal.normalize_or_zero().to_array());
            numbers.extend(target.slope);
            numbers.extend(Some(polygon.end_jet(end).speed()).filter(|_| turned));
            numbers
        });
        ends.collect()
    };
    let step = 1e-5;
    let columns: Vec<DVector<f64>> = (0..unknowns)
        .map(|unknown| {
            let moved = |by: f64| {
                let (index, axis) = (unknown / dimensions, unknown % dimensions);
                let mut polygon = after.clone();
                let mut place = polygon.vertex(index);
                place[axis] += by;
                polygon.move_vertices([(index, place)]).expect("in range");
                DVector::from_vec(held(&polygon))
            };
            (moved(step) - moved(-step)) / (2.0 * step)
        })
        .collect();
    let jacobian = DMatrix::from_columns(&columns);
    let decomposed = jacobian.transpose().svd(true, true);
    let bases = decomposed.u.expect("vectors");
    let largest = decomposed.singular_values.max();
    let mut left = gradient.clone();
    for (column, size) in bases.column_iter().zip(decomposed.singular_values.iter()) {
        if *size > 1e-7 * largest {
            let share = column.dot(&left);
            left -= share * column;
        }
    }
    left.norm() / gradient.norm()
}

#[test]
fn locked_vertices_are_held_by_corrections() {
    let mut random = Random(22);
    for trial in 0..100 {
        let degree = 3 + trial % 6;
        let in_space = trial % 2 == 0;
        let polygon = arc(&mut random, degree, 3 * degree, in_space, trial % 3 == 0);
        let targets = targets_near(&mut random, &polygon, 0.01, 0.03, in_space);
        let locked = [1, 3 * degree / 2, 3 * degree - 1];
        let disturbance = match trial % 4 {
            3 => Disturbance::Harmony,
            order => Disturbance::Differences(1 + order),
        };
        let found = correct_jointly(
            &polygon,
            &targets,
            disturbance,
            &locked,
            &Progress::default(),
        )
        .expect("room");
        for vertex in locked {
            assert_eq!(found.polygon.vertex(vertex), polygon.vertex(vertex));
        }
        let left = residual(&found.polygon, &targets, polygon.size());
        assert!(left <= MET * polygon.size(), "trial {trial}: {left:e}");
    }
    let arc = regular_polygon(3, 12, 10.0).expect("a valid arc");
    let targets = targets_near(&mut random, &arc, 0.01, 0.03, false);
    let all = [0, 1, 2, 3];
    let refused = correct_jointly(
        &arc,
        &targets,
        Disturbance::Differences(1),
        &all,
        &Progress::default(),
    );
    assert!(
        matches!(
            refused,
            Err(CorrectionError::NotSolvable { freedoms: 0, .. })
        ),
        "{refused:?}"
    );
}

#[test]
fn ends_of_space_curves_are_straightened() {
    let mut random = Random(24);
    for trial in 0..50 {
        let polygon = arc(&mut random, 4 + trial % 5, 16, true, trial % 2 == 0);
        let targets = End::BOTH.map(|end| {
            let target = EndTarget {
                curvature: Some(0.0),
                ..target_of(&polygon, end, 1)
            };
            (end, target)
        });
        let found = correct_jointly(
            &polygon,
            &targets,
            Disturbance::Differences(1),
            &[],
            &Progress::default(),
        );
        let found = found.unwrap_or_else(|error| panic!("trial {trial}: {error}"));
        for end in End::BOTH {
            let curvature = found.polygon.end_jet(end).curvature() * polygon.size();
            assert!(curvature <= CURVATURE_MET, "trial {trial}: {curvature:e}");
        }
    }
}

#[test]
fn an_end_does_not_stop_to_have_a_curvature_that_it_cannot_have() {
    let mut random = Random(25);
    let polygon = arc(&mut random, 1, 8, false, false);
    let target = EndTarget {
        curvature: Some(0.1),
        ..target_of(&polygon, End::Start, 1)
    };
    let refused = correct_jointly(
        &polygon,
        &[(End::Start, target)],
        Disturbance::Differences(1),
        &[],
        &Progress::default(),
    );
    let message = refused.expect_err("polylines are straight").to_string();
    assert!(message.contains("contradict each other"), "{message}");
}

#[test]
fn a_cancelled_correction_gives_no_polygon() {
    let mut random = Random(26);
    let polygon = arc(&mut random, 3, 12, false, false);
    let targets = targets_near(&mut random, &polygon, 0.01, 0.03, false);
    let cancelled = Progress::default();
    cancelled.cancel();
    for disturbance in [Disturbance::Differences(1), Disturbance::Harmony] {
        let correct =
            |progress: &Progress| correct_jointly(&polygon, &targets, disturbance, &[], progress);
        assert!(correct(&Progress::default()).is_ok());
        assert_eq!(correct(&cancelled), Err(CorrectionError::Cancelled));
    }
}
