//! Numbers as the screen shows them.

use crate::geometry::Range;
pub use crate::geometry::{SMALL, coordinate, degrees_text, radius_of, significant, to_resolution};

/// Write an angle given in radians as degrees.
pub fn degrees(radians: f64, decimals: usize) -> String {
    if radians.is_finite() {
        degrees_text(radians.to_degrees(), decimals)
    } else {
        "–".to_owned()
    }
}

/// Write an angle given in radians as degrees with three significant digits, however small it is.
pub fn small_angle(radians: f64) -> String {
    significant(radians.to_degrees(), 3) + "°"
}

/// Write an angle given in radians as degrees; a tiny one with its own digits.
pub fn angle(radians: f64) -> String {
    let shown = radians.to_degrees();
    match shown != 0.0 && shown.abs() < 1e-3 {
        true => small_angle(radians),
        false => degrees(radians, 4),
    }
}

/// Write a number so that reading it gives the very same number.
pub fn exact(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(SMALL..1e15).contains(&magnitude) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// The most digits that a field shows.
const MOST_DIGITS: usize = 10;

/// Write a number for a field: exactly if that is short, otherwise with six significant digits.
pub fn short(value: f64) -> String {
    let exact = exact(value);
    if exact.len() > MOST_DIGITS {
        significant(value, 6)
    } else {
        exact
    }
}

/// Write a range as "low … high".
pub fn range(range: Option<Range>, text: impl Fn(f64) -> String) -> String {
    range.map_or_else(
        || "–".to_owned(),
        |range| format!("{} … {}", text(range.low), text(range.high)),
    )
}

/// Write the range of radii, 1/|κ|, of a range of curvatures as "low … high"; ∞ where it holds 0.
pub fn radii(curvature: Option<Range>, digits: usize) -> String {
    let Some(Range { low, high }) = curvature else {
        return "–".to_owned();
    };
    let largest = low.abs().max(high.abs());
    let smallest = match low <= 0.0 && high >= 0.0 {
        true => 0.0,
        false => low.abs().min(high.abs()),
    };
    [largest, smallest]
        .map(|k| radius_of(k, digits))
        .join(" … ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::expressions::NumberContext;

    #[test]
    fn numbers_line_up_and_stay_short() {
        assert_eq!(to_resolution(1.0 / 3.0, 0.001), "0.333");
        assert_eq!(to_resolution(-0.0001, 0.01), "0.00");
        assert_eq!(to_resolution(2.5e12, 1e9), "2.5e12");
        assert_eq!(to_resolution(1e9 + 0.3, 1e-5), "1000000000.30");
        assert_eq!(to_resolution(-2e9, 0.2), "-2000000000.0");
        assert_eq!(to_resolution(1.5e-13, 1e-14), "1.5e-13");
        assert_eq!(to_resolution(1e-9, 1e-9), "1e-9");
        assert_eq!(to_resolution(-2.34e-9, 1e-11), "-2.34e-9");
        assert_eq!(to_resolution(3e-9, 1e-6), "0.000000");
        assert_eq!(to_resolution(0.00123, 1e-5), "0.00123");
        assert_eq!(exact(1e-9), "1e-9");
        assert_eq!(short(1.234_567_89e-9), "1.235e-9");
        assert_eq!(significant(1e-9, 6), "1e-9");
        assert_eq!(to_resolution(f64::NAN, 0.1), "–");
        assert_eq!(significant(8.918_176, 4), "8.918");
        assert_eq!(significant(-1.25e-9, 4), "-1.25e-9");
        assert_eq!(significant(123_456.0, 4), "1.235e5");
        assert_eq!(degrees(std::f64::consts::PI, 1), "180.0°");
    }

    #[test]
    fn radii_run_from_the_tightest_place_to_the_flattest() {
        let radii = |low, high| radii(Some(Range { low, high }), 3);
        assert_eq!(radii(0.1, 0.5), "2.00 … 10.0");
        assert_eq!(radii(-0.5, -0.1), "2.00 … 10.0");
        assert_eq!(radii(-0.5, 0.25), "2.00 … ∞");
        assert_eq!(super::radii(None, 3), "–");
    }

    #[test]
    fn fields_read_what_they_show_to_the_bit() {
        let context = NumberContext::default();
        for value in [0.1 + 0.2, -1e-300, 12.0, f64::MAX, 8.748_581_800_695_999] {
            assert_eq!(context.read(&exact(value)), Ok(value));
        }
    }
}
