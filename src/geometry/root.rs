//! A root between two places.

/// Find where a function passes through 0 between two places at which it has opposite signs, as
/// closely as `tolerance`, or to neighbouring doubles.
pub(super) fn root(
    [mut low, mut high]: [f64; 2],
    tolerance: f64,
    function: impl Fn(f64) -> f64,
) -> f64 {
    let rises = function(low) < 0.0;
    loop {
        let middle = low + 0.5 * (high - low);
        if high - low <= tolerance || !(low < middle && middle < high) {
            return middle;
        }
        if (function(middle) < 0.0) == rises {
            low = middle;
        } else {
            high = middle;
        }
    }
}
