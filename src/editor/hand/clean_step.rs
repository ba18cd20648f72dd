//! Steps by decimal numbers, without what rounding leaves.

use glam::DVec3;

/// How far a sum of two decimal numbers is from the decimal number that it stands for, in units in the last place.
const ROUNDING: f64 = 4.0;

/// A decimal number is told from a chance neighbour if its last place is this many times the rounding.
const TOLD_APART: f64 = 1e3;

/// The most decimal places that are looked at.
const MOST_PLACES: i32 = 15;

/// A point after a step: where a sum of coordinates is a short decimal number but for its rounding it is that
/// number. Coordinates that the step does not change stay to the bit.
pub fn stepped(from: DVec3, by: DVec3) -> DVec3 {
    let axes = [0, 1, 2].map(|axis| match by[axis] {
        0.0 => from[axis],
        step => decimal_sum(from[axis], step),
    });
    DVec3::from_array(axes)
}

/// The sum of two numbers: the shortest decimal number within its rounding, if one is.
fn decimal_sum(from: f64, by: f64) -> f64 {
    let sum = from + by;
    let rounding = ROUNDING * f64::EPSILON * from.abs().max(by.abs()).max(sum.abs());
    let is_told = |places: &i32| 10f64.powi(-places) > TOLD_APART * rounding;
    let places = (0..=MOST_PLACES).take_while(is_told);
    let mut decimals = places.filter_map(|places| {
        let places = places as usize;
        format!("{sum:.places$}").parse::<f64>().ok()
    });
    let short = decimals.find(|decimal| (decimal - sum).abs() <= rounding);
    // A zero that is left keeps no sign.
    short.map_or(sum, |decimal| decimal + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nudges_by_decimals_land_on_decimals() {
        let mut at = 42.0;
        for step in 1..=1000 {
            at = decimal_sum(at, 0.01);
            let expected = format!("{:.2}", 42.0 + f64::from(step) / 100.0);
            assert_eq!(at, expected.parse::<f64>().unwrap());
        }
        for _ in 0..1000 {
            at = decimal_sum(at, -0.1 * 0.1);
        }
        assert_eq!(at, 42.0);
        assert_eq!(decimal_sum(0.3, -0.1 - 0.2).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn what_is_no_decimal_is_only_added() {
        let third = 1.0 / 3.0;
        assert_eq!(decimal_sum(third, 0.1), third + 0.1);
        let from = DVec3::new(third, 0.1 + 0.2, 5.0);
        assert_eq!(stepped(from, DVec3::Z), DVec3::new(third, 0.1 + 0.2, 6.0));
        assert_eq!(decimal_sum(1e300, 1e284), 1e300 + 1e284);
        assert_eq!(decimal_sum(1e-300, 1e-300), 2e-300);
    }
}
