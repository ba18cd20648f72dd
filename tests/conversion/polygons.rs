//! Conversions between the three polygons, against exact rational arithmetic and there and back.

use crate::common::{Random, reach};
use batten::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon, segment_bezier};
use glam::DVec3;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{FromPrimitive, Signed, ToPrimitive, Zero};

/// How far interpolation may lie from the exact result, in roundings of the largest coordinate.
const INTERPOLATION: f64 = 4.0 * f64::EPSILON;

/// Roundings of the converted vertices, which the way back amplifies.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

fn exact(value: f64) -> BigRational {
    BigRational::from_f64(value).expect("a finite number")
}

fn integer(value: i64) -> BigRational {
    BigRational::from_integer(BigInt::from(value))
}

/// Evaluate the blossom of one segment's polynomial at n arguments, by the polygon's own
/// recurrence in exact arithmetic.
fn blossom(vertices: &[f64], segment: usize, arguments: &[i64]) -> BigRational {
    let degree = arguments.len();
    let mut values: Vec<BigRational> = vertices[segment..=segment + degree]
        .iter()
        .map(|value| exact(*value))
        .collect();
    for (level, argument) in arguments.iter().enumerate() {
        for j in 0..degree - level {
            let left = (segment + j + level + 1) as i64 - degree as i64;
            let right = (segment + j + 1) as i64;
            let share = BigRational::new(BigInt::from(argument - left), BigInt::from(right - left));
            values[j] = &values[j] + (&values[j + 1] - &values[j]) * share;
        }
    }
    values.swap_remove(0)
}

fn error(found: f64, expected: &BigRational) -> f64 {
    let difference = (exact(found) - expected).abs();
    difference.to_f64().expect("a number")
}

fn random_line(random: &mut Random, degree: usize, count: usize) -> FloatPolygon {
    let vertices = (0..count).map(|_| DVec3::new(random.between(-10.0, 10.0), 0.0, 0.0));
    FloatPolygon::new(degree, vertices.collect(), None, false).expect("valid")
}

fn x(vertices: &[DVec3]) -> Vec<f64> {
    vertices.iter().map(|vertex| vertex.x).collect()
}

#[test]
fn clamped_vertices_are_exact_but_for_a_few_roundings() {
    let mut random = Random(1);
    for degree in 1..=15 {
        for count in [degree + 1, degree + 2, degree + 3, 2 * degree + 1] {
            let float = random_line(&mut random, degree, count);
            let (vertices, segments) = (x(float.vertices()), float.segments());
            let clamped = ClampedPolygon::from_float(&float);
            for (index, found) in clamped.vertices().iter().enumerate() {
                let knots = (1..=degree).map(|k| (index + k) as i64 - degree as i64);
                let knots: Vec<i64> = knots.map(|knot| knot.clamp(0, segments as i64)).collect();
                let expected = blossom(&vertices, index.min(segments - 1), &knots);
                let error = error(found.x, &expected) / reach(float.vertices());
                assert!(
                    error <= INTERPOLATION,
                    "degree {degree}, N {count}: {error:e}"
                );
            }
        }
    }
}

#[test]
fn bezier_vertices_are_exact_but_for_a_few_roundings() {
    let mut random = Random(2);
    for degree in 1..=15 {
        let float = random_line(&mut random, degree, degree + 3);
        let vertices = x(float.vertices());
        for segment in 0..float.segments() {
            let bezier = segment_bezier(&float, segment);
            assert_eq!(bezier.len(), degree + 1);
            for (index, found) in bezier.iter().enumerate() {
                let knots: Vec<i64> = (0..degree)
                    .map(|k| (segment + usize::from(k >= degree - index)) as i64)
                    .collect();
                let expected = blossom(&vertices, segment, &knots);
                let error = error(found.x, &expected) / reach(float.vertices());
                assert!(error <= INTERPOLATION, "degree {degree}: {error:e}");
                assert_eq!(found.w, 1.0);
            }
        }
    }
}

/// (2n − 1)!!, the factor by which converting one segment back amplifies errors.
fn amplification(degree: usize) -> f64 {
    (1..=degree).map(|k| (2 * k - 1) as f64).product()
}

#[test]
fn the_way_back_costs_the_conversion_s_amplification_and_no_more() {
    let mut random = Random(3);
    for degree in 1..=12 {
        for count in [degree + 1, degree + 2, 2 * degree, 3 * degree] {
            for rational in [false, true] {
                if rational && degree > 8 {
                    continue; // Rounding alone can make a weight negative.
                }
                let float = random.gentle(degree, count, true, rational);
                let allowed = ROUNDINGS * amplification(degree) * reach(float.vertices());
                let allowed = if rational { 8.0 * allowed } else { allowed };
                let clamped = ClampedPolygon::from_float(&float)
                    .to_float()
                    .expect("valid");
                let bezier = BezierPolygon::from_float(&float).to_float().expect("valid");
                for back in [clamped, bezier] {
                    assert_eq!(back.is_rational(), rational);
                    for (found, expected) in back.vertices().iter().zip(float.vertices()) {
                        let error = found.distance(*expected);
                        assert!(
                            error <= allowed,
                            "degree {degree}, N {count}: {error:e} > {allowed:e}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn one_segment_has_the_integer_matrix_whose_norm_is_a_double_factorial() {
    for degree in 1..=10 {
        let mut rows = vec![0.0; degree + 1];
        for column in 0..=degree {
            let mut vertices = vec![DVec3::ZERO; degree + 1];
            vertices[column].x = 1.0;
            let unit = BezierPolygon::new(degree, vertices, None).expect("valid");
            let float = unit.to_float().expect("a float polygon");
            for (row, vertex) in rows.iter_mut().zip(float.vertices()) {
                assert_eq!(
                    vertex.x,
                    vertex.x.round(),
                    "degree {degree}: not an integer"
                );
                *row += vertex.x.abs();
            }
        }
        let norm = rows.into_iter().fold(0.0, f64::max);
        assert_eq!(norm, amplification(degree), "degree {degree}");
    }
}

#[test]
fn powers_have_the_elementary_symmetric_means_of_their_knots_as_vertices() {
    // The blossom of u^k at n arguments is their k-th elementary symmetric mean.
    for degree in 1..=9_usize {
        for power in 0..=degree {
            let vertices = (0..degree + 4).map(|index| {
                let knots = (1..=degree).map(|k| (index + k) as f64 - degree as f64);
                DVec3::new(symmetric_mean(knots, power), 0.0, 0.0)
            });
            let float = FloatPolygon::new(degree, vertices.collect(), None, false);
            let float = float.expect("valid");
            for step in 0..=32 {
                let u = step as f64 / 8.0;
                let error = (float.point(u).x - u.powi(power as i32)).abs();
                let scale = reach(float.vertices());
                assert!(
                    error <= INTERPOLATION * scale,
                    "u^{power}, degree {degree}: {error:e}"
                );
            }
        }
    }
}

fn symmetric_mean(values: impl Iterator<Item = f64>, power: usize) -> f64 {
    // The coefficients of Π(1 + v x).
    let mut coefficients = vec![1.0];
    for value in values {
        coefficients.push(0.0);
        for index in (1..coefficients.len()).rev() {
            coefficients[index] += value * coefficients[index - 1];
        }
    }
    let count = coefficients.len() - 1;
    let binomial = (0..power).fold(1.0, |b, k| b * (count - k) as f64 / (k + 1) as f64);
    coefficients[power] / binomial
}

#[test]
fn a_quarter_circle_is_exact_in_all_three_polygons() {
    let weights = vec![1.0, 0.5_f64.sqrt(), 1.0];
    let corners = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let bezier = BezierPolygon::new(2, corners.clone(), Some(weights.clone())).expect("valid");
    let clamped = ClampedPolygon::new(2, corners, Some(weights)).expect("valid");
    for float in [bezier.to_float(), clamped.to_float()] {
        let float = float.expect("positive weights");
        for step in 0..=16 {
            let jet = float.jet(f64::from(step) / 16.0);
            assert!((jet.point.length() - 1.0).abs() <= INTERPOLATION);
            assert!((jet.signed_curvature() - 1.0).abs() <= 16.0 * INTERPOLATION);
        }
        let length = float.arc_length(1e-13);
        assert!((length - std::f64::consts::FRAC_PI_2).abs() <= INTERPOLATION * 4.0);
    }
}

#[test]
fn the_exact_witness_itself_is_right() {
    // The blossom at n equal arguments is the point: cubic, vertices 0, 0, 6, 0 at u = 0 and 1.
    let vertices = [0.0, 0.0, 6.0, 0.0];
    assert_eq!(blossom(&vertices, 0, &[0, 0, 0]), integer(1));
    assert_eq!(blossom(&vertices, 0, &[1, 1, 1]), integer(4));
    assert!(blossom(&[0.0; 4], 0, &[5, 6, 7]).is_zero());
}
