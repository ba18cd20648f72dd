//! Units of length by the numbers of $INSUNITS.

/// The length of a unit in millimetres; `None` for 0 (no unit) and numbers without a meaning.
pub fn millimetres(number: i64) -> Option<f64> {
    Some(match number {
        1 => 25.4,
        2 => 304.8,
        3 => 1_609_344.0,
        4 => 1.0,
        5 => 10.0,
        6 => 1e3,
        7 => 1e6,
        8 => 25.4e-6,
        9 => 25.4e-3,
        10 => 914.4,
        11 => 1e-7,
        12 => 1e-6,
        13 => 1e-3,
        14 => 100.0,
        15 => 1e4,
        16 => 1e5,
        17 => 1e12,
        18 => 1.495_978_707e14,
        19 => 9.460_730_472_580_8e18,
        20 => 3.085_677_581_491_367e19,
        // The units of the United States survey: a foot is 1200/3937 m.
        21 => 1_200_000.0 / 3937.0,
        22 => 100_000.0 / 3937.0,
        23 => 3_600_000.0 / 3937.0,
        24 => 6_336_000_000.0 / 3937.0,
        _ => return None,
    })
}
