//! Sines and cosines of angles in degrees, exact where they are rational.

use std::f64::consts::FRAC_1_SQRT_2;

/// Compute sine and cosine of an angle in degrees: of multiples of 30° to the bit where they are 0, ±1/2
/// or ±1, of odd multiples of 45° with the same digits; otherwise rounded as those of radians. Not
/// numbers if the angle is not finite.
pub fn sin_cos_of_degrees(degrees: f64) -> (f64, f64) {
    // Both remainders are exact.
    let turned = degrees % 360.0;
    let quarters = (turned / 90.0).round();
    let rest = turned - 90.0 * quarters;
    let (sine, cosine) = acute(rest);
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sine, cosine),
        1 => (cosine, 0.0 - sine),
        2 => (0.0 - sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// Compute the tangent of an angle in degrees: infinite at odd multiples of 90°.
pub(super) fn tan_of_degrees(degrees: f64) -> f64 {
    let (sine, cosine) = sin_cos_of_degrees(degrees);
    sine / cosine
}

/// Sine and cosine of −45° to 45°.
fn acute(degrees: f64) -> (f64, f64) {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    if degrees.abs() == 30.0 {
        (0.5_f64.copysign(degrees), cosine)
    } else if degrees.abs() == 45.0 {
        (FRAC_1_SQRT_2.copysign(degrees), FRAC_1_SQRT_2)
    } else {
        (sine, cosine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rational_values_are_exact() {
        for (degrees, sine, cosine) in [
            (0.0, 0.0, 1.0),
            (90.0, 1.0, 0.0),
            (180.0, 0.0, -1.0),
            (-90.0, -1.0, 0.0),
            (270.0, -1.0, 0.0),
            (360e9, 0.0, 1.0),
        ] {
            assert_eq!(sin_cos_of_degrees(degrees), (sine, cosine), "{degrees}");
        }
        for (degrees, sine) in [(30.0, 0.5), (150.0, 0.5), (210.0, -0.5), (-30.0, -0.5)] {
            assert_eq!(sin_cos_of_degrees(degrees).0, sine, "{degrees}");
            assert_eq!(sin_cos_of_degrees(degrees - 90.0).1, sine, "{degrees}");
        }
        assert_eq!(tan_of_degrees(45.0), 1.0);
        assert_eq!(tan_of_degrees(-225.0), -1.0);
        assert!(sin_cos_of_degrees(f64::INFINITY).0.is_nan());
    }

    #[test]
    fn others_are_those_of_radians() {
        for step in -4000..4000 {
            let degrees = f64::from(step) * 0.37;
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let (found_sine, found_cosine) = sin_cos_of_degrees(degrees);
            // Radians of many turns have an error of their own.
            let bound = 1e-15 * (1.0 + degrees.to_radians().abs());
            assert!((found_sine - sine).abs() < bound, "{degrees}");
            assert!((found_cosine - cosine).abs() < bound, "{degrees}");
        }
    }
}
