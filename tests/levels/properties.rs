//! What holds for the curvature levels of every curve: motions, scaling, reversal, continuity at
//! knots, and that no polygon makes them panic.

use crate::common::Random;
use batten::geometry::{CurvatureLevels, FloatPolygon, LEVELS};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

/// What rounding does to a level, in units of the largest value of that level on the segment: the
/// fourth levels of sixty thousand random curves err by less than 1e-10, a few by more than 1e-11.
const ROUNDING: f64 = 1e-9;

/// A gentle curve whose vertices are multiples of 2⁻²⁰: motions with integer matrices map them
/// without rounding.
fn polygon(degree: usize, in_space: bool, rational: bool, seed: u64) -> FloatPolygon {
    let gentle = Random(seed).gentle(degree, degree + 4, in_space, rational);
    mapped(&gentle, |vertex| {
        let grid = 2.0_f64.powi(20);
        (vertex * grid).round() / grid
    })
}

fn mapped(polygon: &FloatPolygon, map: impl Fn(DVec3) -> DVec3) -> FloatPolygon {
    let vertices = polygon
        .vertices()
        .iter()
        .map(|vertex| map(*vertex))
        .collect();
    let weights = polygon.weights().map(<[f64]>::to_vec);
    FloatPolygon::new(polygon.degree(), vertices, weights, polygon.is_periodic()).expect("valid")
}

/// Check that levels are `sign` times what they shall be, in units of their size on the segment.
fn check(
    found: &[f64; LEVELS],
    expected: &[f64; LEVELS],
    sizes: &[f64; LEVELS],
    sign: f64,
    levels: usize,
) -> Result<(), TestCaseError> {
    for level in 0..levels {
        let error = (found[level] - sign * expected[level]).abs();
        prop_assert!(
            error <= ROUNDING * sizes[level],
            "level {}: {found:?} instead of {expected:?}, of {sizes:?}",
            level + 1
        );
    }
    Ok(())
}

/// Find the largest value of each level on a segment.
fn sizes(
    polygon: &FloatPolygon,
    segment: usize,
    scale: f64,
    of: impl Fn(&CurvatureLevels) -> [f64; LEVELS],
) -> [f64; LEVELS] {
    let mut sizes = [0.0_f64; LEVELS];
    for step in 0..=16 {
        let t = f64::from(step) / 16.0;
        let levels = of(&polygon.segment_curvature_levels(segment, t, scale));
        for (size, level) in sizes.iter_mut().zip(levels) {
            *size = size.max(level.abs());
        }
    }
    sizes
}

fn curvature(levels: &CurvatureLevels) -> [f64; LEVELS] {
    levels.curvature
}

fn torsion(levels: &CurvatureLevels) -> [f64; LEVELS] {
    levels.torsion.unwrap_or_default()
}

proptest! {
    #![proptest_config(crate::common::repeatable())]

    #[test]
    fn rotating_and_moving_the_curve_keeps_its_levels(
        degree in 2..=15_usize,
        [in_space, rational] in any::<[bool; 2]>(),
        seed in any::<u64>(),
        at in 0..=8_u8,
    ) {
        // Integer matrices that rotate and scale, by 3 in space and by 5 in the plane.
        let (matrix, scale, shift) = if in_space {
            let columns = [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]];
            (DMat3::from_cols_array_2d(&columns), 3.0, DVec3::new(16.0, -8.0, 2.0))
        } else {
            let columns = [[3.0, 4.0, 0.0], [-4.0, 3.0, 0.0], [0.0, 0.0, 5.0]];
            (DMat3::from_cols_array_2d(&columns), 5.0, DVec3::new(16.0, -8.0, 0.0))
        };
        let original = polygon(degree, in_space, rational, seed);
        let turned = mapped(&original, |vertex| matrix * vertex + shift);
        let t = f64::from(at) / 8.0;
        let expected = original.segment_curvature_levels(1, t, scale);
        let found = turned.segment_curvature_levels(1, t, 1.0);
        let size = sizes(&original, 1, scale, curvature);
        check(&found.curvature, &expected.curvature, &size, 1.0, LEVELS)?;
        prop_assert_eq!(found.torsion.is_some(), in_space);
        // Each segment of degree 2 lies in a plane: its torsion is rounding, which each further
        // level amplifies.
        let (size, levels) = if degree == 2 {
            ([1.0; LEVELS], 2)
        } else {
            (sizes(&original, 1, scale, torsion), LEVELS)
        };
        check(&torsion(&found), &torsion(&expected), &size, 1.0, levels)?;
    }

    #[test]
    fn scaling_by_a_power_of_two_is_the_same_as_the_scale_argument(
        degree in 2..=25_usize,
        [in_space, rational] in any::<[bool; 2]>(),
        seed in any::<u64>(),
        t in 0.0..=1.0,
        power in -300..=300_i32,
    ) {
        let original = polygon(degree, in_space, rational, seed);
        let scale = 2.0_f64.powi(power);
        let scaled = mapped(&original, |vertex| vertex * scale);
        let found = scaled.segment_curvature_levels(2, t, 1.0);
        let expected = original.segment_curvature_levels(2, t, scale);
        let bits = |levels: &CurvatureLevels| {
            (curvature(levels).map(f64::to_bits), torsion(levels).map(f64::to_bits))
        };
        prop_assert_eq!(bits(&found), bits(&expected));
        // κ and τ themselves scale with the inverse length, dκ/ds with its square.
        let unscaled = original.segment_curvature_levels(2, t, 1.0);
        prop_assert_eq!(found.curvature[0] * scale, unscaled.curvature[0]);
        prop_assert_eq!(found.curvature_slopes[0] * scale * scale, unscaled.curvature_slopes[0]);
        prop_assert_eq!(
            (torsion(&found)[0] * scale).to_bits(),
            torsion(&unscaled)[0].to_bits()
        );
    }

    /// Backwards, κ of a planar curve changes its sign and so do all its levels: g becomes
    /// −g(L − s), g′ stays and g″ changes. In space |κ| and τ become g(L − s), which keeps g″.
    #[test]
    fn reversing_the_curve_changes_signs_in_the_plane_only(
        degree in 3..=15_usize,
        [in_space, rational] in any::<[bool; 2]>(),
        seed in any::<u64>(),
        at in 0..=8_u8,
    ) {
        let original = polygon(degree, in_space, rational, seed);
        let reversed = original.reversed();
        let t = f64::from(at) / 8.0;
        let expected = original.segment_curvature_levels(1, t, 1.0);
        let found = reversed.segment_curvature_levels(original.segments() - 2, 1.0 - t, 1.0);
        let sign = if in_space { 1.0 } else { -1.0 };
        let size = sizes(&original, 1, 1.0, curvature);
        check(&found.curvature, &expected.curvature, &size, sign, LEVELS)?;
        let size = sizes(&original, 1, 1.0, torsion);
        check(&torsion(&found), &torsion(&expected), &size, 1.0, LEVELS)?;
        let (found, expected) = (found.curvature_slopes[0], -sign * expected.curvature_slopes[0]);
        prop_assert!((found - expected).abs() <= ROUNDING * expected.abs().max(1.0));
    }

    /// Level m of the curvature takes 2m derivatives of the curve, of the torsion 2m + 1; a curve of
    /// degree n has n − 1 continuous ones.
    #[test]
    fn levels_are_continuous_at_knots_as_far_as_the_curve_is_smooth(
        degree in 2..=12_usize,
        [in_space, rational] in any::<[bool; 2]>(),
        seed in any::<u64>(),
    ) {
        let polygon = polygon(degree, in_space, rational, seed);
        let before = polygon.segment_curvature_levels(1, 1.0, 1.0);
        let after = polygon.segment_curvature_levels(2, 0.0, 1.0);
        let smooth = ((degree - 1) / 2).min(LEVELS);
        let size = sizes(&polygon, 1, 1.0, curvature);
        check(&before.curvature, &after.curvature, &size, 1.0, smooth)?;
        let smooth = ((degree - 2) / 2).min(LEVELS);
        let size = sizes(&polygon, 1, 1.0, torsion);
        check(&torsion(&before), &torsion(&after), &size, 1.0, smooth)?;
    }

    #[test]
    fn the_next_level_jumps_at_knots(
        degree in 2..=8_usize,
        [in_space, rational] in any::<[bool; 2]>(),
        seed in any::<u64>(),
    ) {
        let polygon = polygon(degree, in_space, rational, seed);
        let before = polygon.segment_curvature_levels(1, 1.0, 1.0).curvature;
        let after = polygon.segment_curvature_levels(2, 0.0, 1.0).curvature;
        let level = (degree - 1) / 2;
        let jump = (before[level] - after[level]).abs();
        prop_assert!(jump > ROUNDING * before[level].abs(), "{before:?} {after:?}");
    }

    #[test]
    fn no_polygon_makes_the_levels_panic(
        degree in 1..=25_usize,
        coordinates in proptest::collection::vec((-1e100..1e100, -1.0..1.0, -1e-100..1e-100), 26),
        weights in proptest::option::of(proptest::collection::vec(-99..=99_i32, 26)),
        t in -1.0..2.0,
        scale in any::<f64>(),
    ) {
        let vertices = coordinates[..=degree].iter().map(|&(x, y, z)| DVec3::new(y, x, z));
        let weights = weights.map(|all| all[..=degree].iter().map(|e| 10.0_f64.powi(*e)).collect());
        let polygon = FloatPolygon::new(degree, vertices.collect(), weights, false).expect("valid");
        let levels = polygon.curvature_levels(t, scale);
        let (across, up) = levels.logarithmic().unwrap_or_default();
        prop_assert!(across.is_finite() && up.is_finite());
    }
}
