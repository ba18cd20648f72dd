//! Curvature and torsion levels: against values of 420 digits, against curves whose levels have
//! a closed form, and where they are not numbers.

use crate::common::{assert_near, list, number, numbers, points, reference};
use batten::geometry::{BezierPolygon, CurvatureLevels, FloatPolygon, SegmentExpansion};
use glam::{DMat3, DVec3};

/// Rounding of levels, relative to the value itself; a fourth level loses three digits where its
/// terms cancel.
const LEVELS: f64 = 1e-12;

/// The same for segments with many vertices a turn, where eight differences of the vertices are
/// 1e-10 of them.
const FINE: f64 = 1e-10;

/// What rounding the vertices of a test's own polygon to doubles does to its levels, in units of 1:
/// high differences double it eight times or nine.
const ROUNDED_VERTICES: f64 = 1e-10;

#[track_caller]
fn assert_all_near(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (level, (found, expected)) in found.iter().zip(expected).enumerate() {
        let what = format!("{what}: level {}", level + 1);
        assert_near(&what, *found, *expected, tolerance, expected.abs());
    }
}

#[track_caller]
fn assert_within(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    for (level, (found, expected)) in found.iter().zip(expected).enumerate() {
        let what = format!("{what}: level {}", level + 1);
        assert_near(&what, *found, *expected, tolerance, 1.0);
    }
}

#[test]
fn fourth_levels_of_the_reference_curves() {
    let (curves, levels) = (reference("curves.json"), reference("curvature_levels.json"));
    let fourth = list(&levels["fourth"]);
    for (index, (curve, expected)) in list(&curves["curves"]).iter().zip(fourth).enumerate() {
        let degree = number(&curve["degree"]) as usize;
        let weights = (!curve["weights"].is_null()).then(|| numbers(&curve["weights"]));
        let polygon = FloatPolygon::new(degree, points(&curve["float"]), weights, false)
            .expect("a valid curve");
        for (u, expected) in numbers(&curve["u"]).into_iter().zip(list(expected)) {
            let what = format!("curve {index} at {u}");
            let found = polygon.curvature_levels(u, 1.0);
            let curvature = number(&expected["curvature"]);
            assert_near(
                &what,
                found.curvature[3],
                curvature,
                LEVELS,
                curvature.abs(),
            );
            if let Some(found) = found.torsion {
                let torsion = number(&expected["torsion"]);
                assert_near(&what, found[3], torsion, LEVELS, torsion.abs());
            }
        }
    }
}

#[test]
fn rational_curves_with_many_vertices_a_turn() {
    for curve in list(&reference("curvature_levels.json")["fine"]) {
        let degree = number(&curve["degree"]) as usize;
        let weights = Some(numbers(&curve["weights"]));
        let polygon = FloatPolygon::new(degree, points(&curve["float"]), weights, false)
            .expect("a valid curve");
        for (u, expected) in numbers(&curve["u"]).into_iter().zip(list(&curve["at_u"])) {
            let what = format!("degree {degree} at {u}");
            let found = polygon.curvature_levels(u, 1.0);
            assert_all_near(
                &what,
                &found.curvature,
                &numbers(&expected["curvature"]),
                FINE,
            );
            if let Some(torsion) = found.torsion {
                assert_all_near(&what, &torsion, &numbers(&expected["torsion"]), FINE);
            }
        }
    }
}

/// Make the one-segment polygon of a polynomial curve from its coefficients in powers of u: vertex
/// i is the blossom at the n knots i − n + 1 … i, in which uᵏ is the mean of all products of k of
/// them.
fn polygon_of_powers(degree: usize, coefficients: &[DVec3]) -> FloatPolygon {
    assert!(coefficients.len() <= degree + 1);
    let vertex = |index: usize| {
        let knots = (0..degree).map(|j| (index + 1 + j) as f64 - degree as f64);
        // The elementary symmetric polynomials of the knots, and the binomial coefficients.
        let mut symmetric = vec![0.0; degree + 1];
        let mut binomial = vec![0.0; degree + 1];
        (symmetric[0], binomial[0]) = (1.0, 1.0);
        for knot in knots {
            for k in (1..=degree).rev() {
                symmetric[k] += knot * symmetric[k - 1];
                binomial[k] += binomial[k - 1];
            }
        }
        let terms = coefficients.iter().zip(symmetric.iter().zip(&binomial));
        terms.map(|(c, (e, b))| *c * (e / b)).sum()
    };
    let vertices = (0..=degree).map(vertex).collect();
    FloatPolygon::new(degree, vertices, None, false).expect("a valid polygon")
}

/// The parabola (a u, a u²).
fn parabola(degree: usize, size: f64) -> FloatPolygon {
    polygon_of_powers(degree, &[DVec3::ZERO, DVec3::X * size, DVec3::Y * size])
}

#[test]
fn the_parabola_of_every_degree_in_closed_form() {
    let levels = reference("curvature_levels.json");
    for degree in 2..=25 {
        let polygon = parabola(degree, 1.0);
        for expected in list(&levels["parabola"]) {
            let x = number(&expected["x"]);
            let what = format!("degree {degree} at {x}");
            let found = polygon.curvature_levels(x, 1.0);
            let q = 1.0 + 4.0 * x * x;
            let slope = -24.0 * x / q.powi(3);
            let bend = (480.0 * x * x - 24.0) / q.powf(4.5);
            let closed = [2.0 / q.powf(1.5), bend / (1.0 + slope * slope).powf(1.5)];
            assert_within(&what, &found.curvature, &closed, ROUNDED_VERTICES);
            assert_near(
                &what,
                found.curvature_slopes[0],
                slope,
                ROUNDED_VERTICES,
                1.0,
            );
            let all = numbers(&expected["curvature"]);
            if degree == 2 {
                // Its vertices are exact.
                assert_all_near(&what, &found.curvature, &all, LEVELS);
            } else if x != 0.0 {
                // At 0 the fourth level is a spike of height −2e14 and as narrow.
                assert_within(&what, &found.curvature, &all, ROUNDED_VERTICES);
            }
        }
    }
}

#[test]
fn a_parabola_of_a_size_whose_powers_leave_the_range_of_numbers() {
    // 2⁻³⁰⁰: κ′ is 1e180, and 1 + κ′² nothing but κ′².
    let size = 2.0_f64.powi(-300);
    let (x, q) = (0.25_f64, 1.25_f64);
    let found = parabola(2, size).curvature_levels(x, 1.0);
    let (slope, bend) = (-24.0 * x / q.powi(3), (480.0 * x * x - 24.0) / q.powf(4.5));
    let second = bend / slope.abs().powi(3) * size.powi(3);
    let expected = [2.0 / q.powf(1.5) / size, second];
    assert_all_near("tiny", &found.curvature[..2], &expected, LEVELS);
    // At the vertex of the parabola κ′ is 0 and level 2 is κ″ itself.
    let found = parabola(2, size).curvature_levels(0.0, 1.0);
    assert_all_near(
        "vertex",
        &found.curvature[..2],
        &[2.0 / size, -24.0 / size.powi(3)],
        LEVELS,
    );
    // 2³⁰⁰: κ′ vanishes beside 1, and level 3 underflows.
    let found = parabola(2, 1.0 / size).curvature_levels(x, 1.0);
    let expected = [2.0 / q.powf(1.5) * size, bend * size.powi(3)];
    assert_all_near("huge", &found.curvature[..2], &expected, LEVELS);
    assert_eq!(found.curvature[2..], [0.0, 0.0]);
}

#[test]
fn a_circle_has_one_constant_level_and_zeros() {
    let weights = vec![1.0, 0.5_f64.sqrt(), 1.0];
    let tilt = DMat3::from_rotation_x(0.7) * DMat3::from_rotation_y(0.4);
    for radius in [0.5, 1.0, 10.0] {
        let arc = [DVec3::X, DVec3::X + DVec3::Y, DVec3::Y].map(|point| point * radius);
        let tilted = arc.map(|point| tilt * point);
        for (arc, in_space) in [(arc, false), (tilted, true)] {
            let polygon = BezierPolygon::new(2, arc.to_vec(), Some(weights.clone()))
                .and_then(|bezier| bezier.to_float())
                .expect("the float polygon of the arc");
            for u in [0.0, 0.2, 0.5, 0.9, 1.0] {
                let what = format!("radius {radius} at {u}");
                let found = polygon.curvature_levels(u, 1.0);
                // Level m has the dimension of 2m − 1 lengths below.
                let inverse: f64 = 1.0 / radius;
                let units = [1, 3, 5, 7].map(|power| inverse.powi(power));
                let scaled = |levels: [f64; 4]| -> Vec<f64> {
                    levels
                        .iter()
                        .zip(units)
                        .map(|(level, unit)| level / unit)
                        .collect()
                };
                let curvature = scaled(found.curvature);
                assert_within(&what, &curvature, &[1.0, 0.0, 0.0, 0.0], ROUNDED_VERTICES);
                let slope = found.curvature_slopes[0] / inverse.powi(2);
                assert_near(&what, slope, 0.0, ROUNDED_VERTICES, 1.0);
                assert_eq!(found.torsion.is_some(), in_space);
                let torsion = scaled(found.torsion.unwrap_or_default());
                assert_within(&what, &torsion, &[0.0; 4], ROUNDED_VERTICES);
            }
        }
    }
}

/// The Mineur–Farin configuration: legs multiply by s·e^{iθ}, which makes κ a power of a quadratic.
#[test]
fn mineur_farin_spirals_in_closed_form() {
    let (ratio, angle) = (1.2_f64, 0.3_f64);
    for degree in [3, 4, 5] {
        let mut vertices = vec![DVec3::ZERO];
        for index in 0..degree {
            let (sine, cosine) = (angle * f64::from(index)).sin_cos();
            let leg = DVec3::new(cosine, sine, 0.0) * ratio.powi(index);
            vertices.push(vertices[index as usize] + leg);
        }
        let polygon = BezierPolygon::new(degree as usize, vertices, None)
            .and_then(|bezier| bezier.to_float())
            .expect("the float polygon of the segment");
        let n = f64::from(degree);
        let (sine, cosine) = (ratio * angle.sin(), ratio * angle.cos());
        for t in [0.0, 0.3, 1.0] {
            // m = |1 + (λ − 1) t|², κ = c m^{−(n+1)/2}, ds/dt = n m^{(n−1)/2}.
            let m = (1.0 + (cosine - 1.0) * t).powi(2) + (sine * t).powi(2);
            let first = 2.0 * (cosine - 1.0) * (1.0 + (cosine - 1.0) * t) + 2.0 * sine * sine * t;
            let second = 2.0 * (cosine - 1.0).powi(2) + 2.0 * sine * sine;
            let factor = (n - 1.0) * sine / n;
            let curvature = factor * m.powf(-0.5 * (n + 1.0));
            // κ′ = −c (n+1)/(2n) m^{−n−1} m′
            let slope = -factor * (n + 1.0) / (2.0 * n) * m.powf(-n - 1.0) * first;
            let bend = -factor * (n + 1.0) / (2.0 * n * n)
                * (m * second - (n + 1.0) * first * first)
                * m.powf(-n - 2.0 - 0.5 * (n - 1.0));
            let found = polygon.curvature_levels(t, 1.0);
            let what = format!("degree {degree} at {t}");
            let expected = [curvature, bend / (1.0 + slope * slope).powf(1.5)];
            assert_within(&what, &found.curvature, &expected, ROUNDED_VERTICES);
            assert_near(
                &what,
                found.curvature_slopes[0],
                slope,
                ROUNDED_VERTICES,
                1.0,
            );
            let (across, up) = found.logarithmic().expect("on the graph");
            assert_near(&what, across, -curvature.log10(), ROUNDED_VERTICES, 1.0);
            let expected = (curvature / slope.abs()).log10();
            assert_near(&what, up, expected, ROUNDED_VERTICES, 1.0);
        }
    }
}

/// Coefficients of the Taylor polynomial, by arc length, of a planar curve from those of its
/// curvature: the direction angle is its integral, and (e^{iθ})′ = iθ′e^{iθ}.
fn powers_of_intrinsic_curve(curvature: &[f64]) -> Vec<DVec3> {
    let mut direction = vec![DVec3::X];
    let mut curve = vec![DVec3::ZERO];
    for k in 0..curvature.len() {
        let turned = (0..=k).map(|j| curvature[j] * DVec3::Z.cross(direction[k - j]));
        let next = turned.sum::<DVec3>() / (k + 1) as f64;
        direction.push(next);
        curve.push(direction[k] / (k + 1) as f64);
    }
    curve
}

/// A curve's own Taylor polynomial of degree 12 has its levels at the parameter it is taken at.
#[test]
fn the_logarithmic_graph_of_log_aesthetic_curves_is_a_line_of_slope_alpha() {
    const RATE: f64 = 0.5;
    for alpha in [-1.0, -0.5, 0.5, 1.0, 2.0] {
        for s in [0.0, 0.3, 1.0] {
            // κ(s + h) = (1 + Λα(s + h))^{−1/α}
            let base = 1.0 + RATE * alpha * s;
            let exponent = -1.0 / alpha;
            let mut coefficients = vec![base.powf(exponent)];
            for k in 0..11 {
                let factor = (exponent - f64::from(k)) / f64::from(k + 1);
                coefficients.push(coefficients[k as usize] * factor * RATE * alpha / base);
            }
            let polygon = polygon_of_powers(12, &powers_of_intrinsic_curve(&coefficients));
            let found = polygon.curvature_levels(0.0, 1.0);
            let what = format!("alpha {alpha} at {s}");
            let (across, up) = found.logarithmic().expect("on the graph");
            assert_near(
                &what,
                across,
                -coefficients[0].log10(),
                ROUNDED_VERTICES,
                1.0,
            );
            let line = alpha * across - RATE.log10();
            assert_near(&what, up, line, ROUNDED_VERTICES, 1.0);
            let slope = coefficients[1];
            let second = 2.0 * coefficients[2] / (1.0 + slope * slope).powf(1.5);
            let expected = [coefficients[0], second];
            assert_within(&what, &found.curvature, &expected, ROUNDED_VERTICES);
            if alpha == -1.0 {
                // The curvature of a clothoid is a straight line over its length.
                assert_within(&what, &found.curvature[1..], &[0.0; 3], ROUNDED_VERTICES);
            }
        }
    }
}

#[test]
fn helices_and_conical_spirals() {
    // (a cos s, a sin s, b s) has constant curvature and torsion.
    let (a, b) = (1.5, 0.75);
    let mut factorial = 1.0;
    let mut cosine = [0.0; 13];
    let mut sine = [0.0; 13];
    for k in 0..13_usize {
        factorial *= k.max(1) as f64;
        let sign = if k / 2 % 2 == 0 { 1.0 } else { -1.0 };
        *(if k % 2 == 0 {
            &mut cosine[k]
        } else {
            &mut sine[k]
        }) = sign / factorial;
    }
    let helix = (0..13).map(|k| {
        let z = if k == 1 { b } else { 0.0 };
        DVec3::new(a * cosine[k], a * sine[k], z)
    });
    let polygon = polygon_of_powers(12, &helix.collect::<Vec<_>>());
    let found = polygon.curvature_levels(0.0, 1.0);
    let square = a * a + b * b;
    assert_within(
        "helix",
        &found.curvature,
        &[a / square, 0.0, 0.0, 0.0],
        ROUNDED_VERTICES,
    );
    let torsion = found.torsion.expect("a curve in space");
    assert_within(
        "helix",
        &torsion,
        &[b / square, 0.0, 0.0, 0.0],
        ROUNDED_VERTICES,
    );

    // (s sin s, s cos s, s) at s = 0: κ = √(s⁴+5s²+8)/(s²+2)^{3/2}, τ = −(s²+6)/(s⁴+5s²+8).
    let spiral = (0..13).map(|k| {
        let z = if k == 1 { 1.0 } else { 0.0 };
        let below = |series: &[f64; 13]| if k == 0 { 0.0 } else { series[k - 1] };
        DVec3::new(below(&sine), below(&cosine), z)
    });
    let polygon = polygon_of_powers(12, &spiral.collect::<Vec<_>>());
    let found = polygon.curvature_levels(0.0, 1.0);
    let torsion = found.torsion.expect("a curve in space");
    // At s = 0 both are even: κ = 1 − 7/16 s² …, τ = −3/4 + (11/32) s² …, ds² there 2 ds².
    assert_within(
        "spiral",
        &found.curvature,
        &[1.0, -7.0 / 16.0],
        ROUNDED_VERTICES,
    );
    assert_within("spiral", &torsion, &[-0.75, 11.0 / 32.0], ROUNDED_VERTICES);
    assert_near(
        "spiral",
        found.curvature_slopes[0],
        0.0,
        ROUNDED_VERTICES,
        1.0,
    );
}

fn all(levels: &CurvatureLevels) -> Vec<f64> {
    let torsion = levels.torsion.iter().flatten();
    levels.curvature.iter().chain(torsion).copied().collect()
}

#[test]
fn a_point_has_no_levels() {
    for (degree, z) in [(1, 0.0), (4, 0.0), (4, 1.0), (9, 2.0)] {
        let vertices = vec![DVec3::new(3.0, -1.0, z); degree + 1];
        let polygon = FloatPolygon::new(degree, vertices, None, false).expect("valid");
        let levels = polygon.curvature_levels(0.4, 1.0);
        assert!(
            all(&levels).iter().all(|level| level.is_nan()),
            "{levels:?}"
        );
        assert!(levels.curvature_slopes[0].is_nan());
        assert_eq!(levels.logarithmic(), None);
    }
}

#[test]
fn cusps_have_no_levels() {
    // The semicubical parabola (u², u³), and the same with a third coordinate.
    for z in [DVec3::ZERO, DVec3::Z] {
        let powers = [DVec3::ZERO, DVec3::ZERO, DVec3::X, DVec3::Y + z];
        let levels = polygon_of_powers(3, &powers).curvature_levels(0.0, 1.0);
        assert!(
            all(&levels).iter().all(|level| level.is_nan()),
            "{levels:?}"
        );
        assert_eq!(levels.logarithmic(), None);
    }
}

#[test]
fn straight_lines_have_levels_of_zero_and_no_torsion() {
    for degree in [1, 2, 5, 25] {
        for direction in [DVec3::new(2.0, 1.0, 0.0), DVec3::new(2.0, 1.0, 4.0)] {
            let vertices = (0..=degree).map(|index| direction * (index * index) as f64);
            let polygon = FloatPolygon::new(degree, vertices.collect(), None, false);
            let polygon = polygon.expect("a valid polygon");
            let levels = polygon.curvature_levels(1.0, 1.0);
            assert_eq!(levels.curvature, [0.0; 4]);
            assert_eq!(levels.curvature_slopes[0], 0.0);
            assert_eq!(levels.torsion.is_some(), direction.z != 0.0);
            assert!(levels.torsion.iter().flatten().all(|level| level.is_nan()));
            assert_eq!(levels.logarithmic(), None);
        }
    }
}

#[test]
fn an_inflection_in_space_is_a_kink_of_the_curvature() {
    // (u, u³, u³) lies in a plane; seen as a curve in space its curvature is |κ|.
    let powers = [DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::Y + DVec3::Z];
    let levels = polygon_of_powers(3, &powers).curvature_levels(0.0, 1.0);
    assert_eq!(levels.curvature[0], 0.0);
    assert!(levels.curvature[1..].iter().all(|level| level.is_nan()));
    assert!(
        levels
            .torsion
            .is_some_and(|torsion| torsion.iter().all(|level| level.is_nan()))
    );
    // In the plane it is smooth: κ = 6u + …, odd, so level 2 is 0 too.
    let powers = [DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::Y];
    let levels = polygon_of_powers(3, &powers).curvature_levels(0.0, 1.0);
    assert_within(
        "planar",
        &levels.curvature[..2],
        &[0.0; 2],
        ROUNDED_VERTICES,
    );
    assert_near("planar", levels.curvature_slopes[0], 6.0, LEVELS, 6.0);
}

#[test]
fn one_expansion_serves_all_parameters_of_a_segment() {
    let polygon = crate::common::Random(5).gentle(9, 20, true, true);
    for segment in 0..polygon.segments() {
        let expansion = SegmentExpansion::new(&polygon, segment, polygon.is_planar());
        for t in [0.0, 0.25, 1.0] {
            let single = polygon.segment_curvature_levels(segment, t, 2.0);
            assert_eq!(expansion.curvature_levels(t, 2.0), single);
        }
    }
}

#[test]
fn a_periodic_curve_has_the_levels_of_the_open_one_that_runs_round_once() {
    let open = crate::common::Random(7).gentle(5, 12, true, true);
    let weights = open.weights().map(<[f64]>::to_vec);
    let periodic = FloatPolygon::new(5, open.vertices().to_vec(), weights, true).expect("valid");
    let unrolled = periodic.unrolled();
    for segment in 0..periodic.segments() {
        let found = periodic.segment_curvature_levels(segment, 0.3, 1.0);
        assert_eq!(found, unrolled.segment_curvature_levels(segment, 0.3, 1.0));
    }
    // Past the end the parameter begins again.
    assert_eq!(
        periodic.curvature_levels(12.25, 1.0),
        periodic.curvature_levels(0.25, 1.0)
    );
}
