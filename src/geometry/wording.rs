//! Numbers in messages, and the message of a panic.

use std::any::Any;

/// Say a number with its noun: "1 vertex", but "0 vertices" and "7 vertices".
pub fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", noun(count, one, many))
}

/// Return the message of a panic that was caught; "no message" if its payload is not a text.
pub fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("no message").to_owned()
}

/// Singular or plural noun for a count.
pub fn noun<'a>(count: usize, one: &'a str, many: &'a str) -> &'a str {
    if count == 1 { one } else { many }
}

/// The most characters a number is written plainly with.
const LONGEST: usize = 14;

/// Numbers below this are written with an exponent.
pub const SMALL: f64 = 1e-4;

/// Write a figure for reading: seven significant digits.
pub fn figure(value: f64) -> String {
    significant(value, 7)
}

/// Write a share in per cent: two significant digits, from 10 % on whole ones.
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        whole if whole >= 10.0 => format!("{whole:.0} %"),
        small => format!("{} %", significant(small, 2)),
    }
}

/// Write a number with some significant digits: plainly where that is short, otherwise with an
/// exponent, and then without zeros at its end: 1e-9.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    if (-4..digits as i32).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        let text = format!("{value:.*e}", digits.saturating_sub(1).min(3));
        match text.split_once('e') {
            Some((digits, exponent)) if digits.contains('.') => {
                let digits = digits.trim_end_matches('0').trim_end_matches('.');
                format!("{digits}e{exponent}")
            }
            _ => text,
        }
    }
}

/// Write the radius of a curvature, 1/|κ|; that of a straight place is ∞.
pub fn radius_of(curvature: f64, digits: usize) -> String {
    let radius = 1.0 / curvature.abs();
    if radius.is_infinite() {
        "∞".to_owned()
    } else {
        significant(radius, digits)
    }
}

/// Write a coordinate where a screen point spans `pixel`: to a hundredth of that.
pub fn coordinate(value: f64, pixel: f64) -> String {
    to_resolution(value, 0.01 * pixel.max(1e-300))
}

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
fn decimals(resolution: f64) -> usize {
    if resolution > 0.0 && resolution.is_finite() {
        (-resolution.log10()).ceil().clamp(0.0, 15.0) as usize
    } else {
        6
    }
}

/// Write degrees with a fixed number of decimals.
pub fn degrees_text(degrees: f64, decimals: usize) -> String {
    without_negative_zero(format!("{degrees:.decimals$}")) + "°"
}

/// Take the sign from a zero.
fn without_negative_zero(text: String) -> String {
    let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
    match text.strip_prefix('-') {
        Some(rest) if is_zero => rest.to_owned(),
        _ => text,
    }
}

/// Write a bound with two digits, rounded up.
pub fn rounded_up(bound: f64) -> String {
    let mut text = format!("{bound:.1e}");
    if !text.parse().is_ok_and(|shown: f64| shown >= bound) {
        // Less than half of the last digit is missing: the next number of two digits is not less.
        let digit = 10f64.powi(bound.log10().floor() as i32 - 1);
        text = format!("{:.1e}", bound + 0.5 * digit);
    }
    match text.parse() {
        // Numbers of a usual size are written without a power of ten.
        Ok(shown @ (0.0 | 1e-3..1e5)) => shown.to_string(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_never_shown_smaller_than_they_are() {
        for (bound, shown) in [
            (3.04e-10, "3.1e-10"),
            (32.48, "33"),
            (1671.0, "1700"),
            (1.01e-5, "1.1e-5"),
            (9.96e-3, "0.01"),
            (9.91e-3, "0.01"),
            (2.0, "2"),
            (0.0, "0"),
        ] {
            assert_eq!(rounded_up(bound), shown);
        }
    }

    #[test]
    fn radii_have_no_sign_and_straight_places_are_infinite() {
        let written = [0.001, -0.25, 0.0, -0.0, f64::NAN].map(|k| radius_of(k, 6));
        assert_eq!(written, ["1000.00", "4.00000", "∞", "∞", "–"]);
    }

    #[test]
    fn one_thing_is_not_said_in_the_plural() {
        let said = [0, 1, 2].map(|count| counted(count, "vertex", "vertices"));
        assert_eq!(said, ["0 vertices", "1 vertex", "2 vertices"]);
    }
}
