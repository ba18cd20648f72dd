//! Numbers as the screen shows them.

use crate::geometry::Range;
pub use crate::geometry::significant;

/// The most characters a number is written plainly with.
const LONGEST: usize = 14;

/// Numbers below this are written with an exponent.
pub const SMALL: f64 = 1e-4;

/// Write a number with as many decimals as `resolution` needs, so that neighbours line up:
/// the resolution is the smallest difference that matters. Numbers too long for that lose
/// decimals first, and are then written with an exponent.
pub fn to_resolution(value: f64, resolution: f64) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    let is_coarse = value.abs() >= 1e6 && resolution >= value.abs() * 1e-3;
    let before_point = value.abs().max(1.0).log10() as usize + 3;
    if is_coarse || before_point > LONGEST {
        return significant(value, 6);
    }
    let needed = decimals(resolution);
    let decimals = needed.min(LONGEST - before_point);
    if needed > 9 && decimals < needed && value.abs() < 1.0 {
        return significant(value, 6);
    }
    let text = without_negative_zero(format!("{value:.decimals$}"));
    let zeros = text
        .bytes()
        .take_while(|byte| b"-0.".contains(byte))
        .count();
    if value.abs() < SMALL && zeros < text.len() {
        // 1e-9, not 0.000000001.
        return significant(value, text.len() - zeros);
    }
    text
}

/// The number of decimals that tell values apart that differ by `resolution`.
pub fn decimals(resolution: f64) -> usize {
    if resolution > 0.0 && resolution.is_finite() {
        (-resolution.log10()).ceil().clamp(0.0, 15.0) as usize
    } else {
        6
    }
}

/// Write an angle given in radians as degrees.
pub fn degrees(radians: f64, decimals: usize) -> String {
    if radians.is_finite() {
        without_negative_zero(format!("{:.decimals$}", radians.to_degrees())) + "°"
    } else {
        "–".to_owned()
    }
}

/// Write an angle given in radians as degrees with three significant digits, however small it is.
pub fn small_angle(radians: f64) -> String {
    significant(radians.to_degrees(), 3) + "°"
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

fn without_negative_zero(text: String) -> String {
    let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
    match text.strip_prefix('-') {
        Some(rest) if is_zero => rest.to_owned(),
        _ => text,
    }
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
    fn fields_read_what_they_show_to_the_bit() {
        let context = NumberContext::default();
        for value in [0.1 + 0.2, -1e-300, 12.0, f64::MAX, 8.748_581_800_695_999] {
            assert_eq!(context.read(&exact(value)), Ok(value));
        }
    }
}
