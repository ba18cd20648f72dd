//! A root, or a maximum, between two places.

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

/// Find the place of a maximum between two places, and the maximum, by steps of the golden section.
pub(super) fn maximum(
    [mut low, mut high]: [f64; 2],
    steps: usize,
    function: impl Fn(f64) -> f64,
) -> (f64, f64) {
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut inner = [high - share * (high - low), low + share * (high - low)];
    let mut values = inner.map(&function);
    for _ in 0..steps {
        if values[0] >= values[1] {
            high = inner[1];
            inner = [high - share * (high - low), inner[0]];
            values = [function(inner[0]), values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + share * (high - low)];
            values = [values[1], function(inner[1])];
        }
    }
    let best = usize::from(values[1] > values[0]);
    (inner[best], values[best])
}
