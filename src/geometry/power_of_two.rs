//! Powers of two, and numbers times powers of two that may themselves be out of range.

/// The exponent e with 2ᵉ ≤ |value| < 2ᵉ⁺¹; −1023 for 0 and numbers that small, 1024 for what is
/// not finite.
pub(super) fn exponent(value: f64) -> i32 {
    (value.to_bits() >> 52 & 0x7ff) as i32 - 1023
}

/// Compute 2ᵉ; 0 or infinite beyond the range of numbers.
pub(super) fn power_of_two(exponent: i32) -> f64 {
    times_power_of_two(1.0, exponent)
}

/// Compute value · 2ᵉ, rounded once; 0 or infinite beyond the range of numbers.
pub(super) fn times_power_of_two(value: f64, exponent: i32) -> f64 {
    // No value takes more than 2¹⁰²³ twice to leave the range of numbers.
    let half = exponent.clamp(-2040, 2040) / 2;
    value * normal_power_of_two(half) * normal_power_of_two(exponent.clamp(-2040, 2040) - half)
}

/// Compute 2ᵉ for an e from −1022 to 1023.
fn normal_power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
