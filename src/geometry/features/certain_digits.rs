//! Numbers of which all digits are certain, from bounds.

/// The most digits that tell doubles apart.
const ENOUGH: usize = 17;

/// Find the number with the most significant digits, up to `most` of them, that both bounds round
/// to, as the double whose shortest decimal form it is. `None` if not even the first digit is
/// certain, or a bound is not finite.
fn certain_digits([low, high]: [f64; 2], most: usize) -> Option<f64> {
    if !(low.is_finite() && high.is_finite()) {
        return None;
    }
    if low == 0.0 && high == 0.0 {
        return Some(0.0);
    }
    let written = |value: f64, digits: usize| format!("{value:.*e}", digits - 1);
    (1..=most.min(ENOUGH)).rev().find_map(|digits| {
        let decimal = written(low, digits);
        let number: f64 = decimal.parse().ok()?;
        // The shortest form of the double must have no other digits.
        let same =
            decimal == written(high, digits) && (digits == ENOUGH || is_shortest(&decimal, number));
        (same && number != 0.0).then_some(number)
    })
}

/// Write the number with the most significant digits, up to `most` of them, that both bounds round
/// to, with those digits and no others: with a power of ten where zeros would stand beside them that
/// are not certain, or many zeros in front. `None` if not even the first digit is certain, or a bound
/// is not finite.
pub fn certain_text(bounds: [f64; 2], most: usize) -> Option<String> {
    /// Smaller numbers are written with a power of ten.
    const LEAST: f64 = 1e-4;
    let number = certain_digits(bounds, most)?;
    let plain = number.to_string();
    let is_padded = plain.len() > 1 && plain.ends_with('0') && !plain.contains('.');
    Some(if number != 0.0 && (is_padded || number.abs() < LEAST) {
        format!("{number:e}")
    } else {
        plain
    })
}

/// Whether a decimal is the shortest form of a double, but for zeros at its end.
fn is_shortest(decimal: &str, number: f64) -> bool {
    let trimmed = |text: &str| {
        let (digits, exponent) = text.split_once('e').unwrap_or((text, ""));
        let digits = if digits.contains('.') {
            digits.trim_end_matches('0').trim_end_matches('.')
        } else {
            digits
        };
        format!("{digits}e{exponent}")
    };
    trimmed(decimal) == trimmed(&format!("{number:e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_digits_that_both_bounds_share_are_told() {
        for (low, high, most, expected) in [
            (0.123_456, 0.123_461, 17, Some(0.123_46)),
            (0.123_444_9, 0.123_446_1, 17, Some(0.1234)),
            (0.1, 0.1, 17, Some(0.1)),
            (0.1, 0.1, 2, Some(0.1)),
            (1.0 / 3.0, 1.0 / 3.0, 17, Some(1.0 / 3.0)),
            (1.0 / 3.0, 1.0 / 3.0, 4, Some(0.3333)),
            (-2.0e300, -1.96e300, 17, Some(-2e300)),
            (9.96, 10.04, 17, Some(10.0)),
            (0.0, 0.0, 17, Some(0.0)),
            (-1e-20, 1e-20, 17, None),
            (1.0, 2.0, 17, None),
            (1.0, f64::INFINITY, 17, None),
            (f64::NEG_INFINITY, f64::INFINITY, 17, None),
        ] {
            assert_eq!(
                certain_digits([low, high], most),
                expected,
                "{low} … {high}"
            );
        }
    }

    #[test]
    fn no_digit_is_written_that_is_not_certain() {
        for (low, high, expected) in [
            (9.96, 10.04, "1e1"),
            (11.99, 12.01, "12"),
            (-0.125, -0.125, "-0.125"),
            (
                -827_492_733_192_208.7,
                -827_492_733_192_162.3,
                "-8.274927331922e14",
            ),
            (2e-7, 2e-7, "2e-7"),
            (1e300, 1e300, "1e300"),
            (0.0, 0.0, "0"),
        ] {
            assert_eq!(certain_text([low, high], 17).as_deref(), Some(expected));
        }
        assert_eq!(
            certain_text([120_338.1, 120_338.2], 4).as_deref(),
            Some("1.203e5")
        );
        assert_eq!(certain_text([-1.0, 1.0], 17), None);
    }

    #[test]
    fn sixteen_digits_are_not_told_if_the_shortest_form_differs_in_the_last_one() {
        // Between neighbouring doubles at 9e15 lie two decimals of 16 digits and a half.
        let mut state = 7_u64;
        for _ in 0..2000 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let low = 1.0 + (state >> 12) as f64 / (1_u64 << 52) as f64;
            let high = low.next_up();
            let Some(found) = certain_digits([low, high], 17) else {
                panic!("{low} … {high}");
            };
            let digits = format!("{found:e}").trim_start_matches('-').len() - "e0".len();
            let digits = if digits > 1 { digits - 1 } else { digits };
            for bound in [low, high] {
                let rounded: f64 = format!("{bound:.*e}", digits - 1)
                    .parse()
                    .expect("a number");
                assert_eq!(rounded, found, "{low} … {high}");
            }
        }
    }
}
