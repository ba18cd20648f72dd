//! Where the ticks of an axis stand, and how they are written.

use std::ops::RangeInclusive;

use egui_plot::{GridInput, GridMark};

/// The least distance of marks that a plot requests, in points; rooms are multiples of it.
const UNIT: f64 = 8.0;

/// The room for a tick across, in points.
const ACROSS: f64 = 80.0;

/// The room for a tick upwards, in points.
const UPWARDS: f64 = 24.0;

/// The room for a tick upwards in a low strip, in points.
const LOW: f64 = 20.0;

/// A logarithmic axis that shows less than this many decades has even ticks.
const NARROW: f64 = 0.7;

/// Beyond this power of ten there are no even ticks on a logarithmic axis: they could overflow.
const FARTHEST: f64 = 280.0;

/// The most decimals that a number is written with before it gets an exponent.
const DECIMALS: i32 = 4;

/// The share of a step by which rounding may change a number.
const SLACK: f64 = 1e-9;

/// The meaning of the numbers along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// The values themselves.
    Even,
    /// Logarithms to base 10 of the numbers beside the ticks.
    Logarithmic,
}

impl Scale {
    /// The marks of a horizontal axis.
    pub fn across(self, input: GridInput) -> Vec<GridMark> {
        self.marks(&input, ACROSS)
    }

    /// The marks of a vertical axis.
    pub fn upwards(self, input: GridInput) -> Vec<GridMark> {
        self.marks(&input, UPWARDS)
    }

    /// The marks of a vertical axis in a low strip.
    pub fn in_strip(self, input: GridInput) -> Vec<GridMark> {
        self.marks(&input, LOW)
    }

    fn marks(self, input: &GridInput, room: f64) -> Vec<GridMark> {
        let least = input.base_step_size / UNIT * room;
        match self {
            Self::Even => even_marks(input.bounds, least),
            Self::Logarithmic => logarithmic_marks(input.bounds, least),
        }
    }

    /// Write the number of a mark with enough digits to differ from its neighbours.
    pub fn number(self, mark: GridMark, range: &RangeInclusive<f64>) -> String {
        match self {
            Self::Even => {
                let largest = range.start().abs().max(range.end().abs());
                number(mark.value, mark.step_size, largest)
            }
            Self::Logarithmic => power(mark.value, mark.step_size),
        }
    }
}

/// The least of 1, 2 and 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let factors = [1.0, 2.0, 5.0].into_iter();
    let mut steps = factors.map(|factor| factor * power);
    let found = steps.find(|step| *step >= least * (1.0 - SLACK));
    found.unwrap_or(10.0 * power)
}

/// The multiples of the least round step of at least `least`.
fn even_marks((low, high): (f64, f64), least: f64) -> Vec<GridMark> {
    let step = round_step(least.max(f64::MIN_POSITIVE));
    let (first, last) = ((low / step).ceil(), (high / step).floor());
    // Rounding is larger than the step: there are no ticks.
    if !(step.is_finite() && last - first < 1e4 && first.abs().max(last.abs()) < 1e15) {
        return Vec::new();
    }
    let steps = 0..=(last - first).max(-1.0) as i64;
    let steps = steps.filter(|_| last >= first);
    let mark = |index: i64| GridMark {
        value: (first + index as f64) * step,
        step_size: step,
    };
    steps.map(mark).collect()
}

/// Marks at numbers whose logarithms are `low` to `high`, at least `least` apart: even ones on a
/// short axis, otherwise 1, 2 and 5 times powers of ten where there is room, or powers of ten alone.
fn logarithmic_marks((low, high): (f64, f64), least: f64) -> Vec<GridMark> {
    if high - low < NARROW && low > -FARTHEST && high < FARTHEST {
        return close_marks([low, high], least);
    }
    let factors: &[f64] = if least <= 2f64.log10() {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let stride = round_step(least.max(1.0));
    let first = (low / stride).floor() as i64;
    let last = (high / stride).ceil() as i64;
    let powers = (first..=last).map(|index| index as f64 * stride);
    let values = powers.flat_map(|power| factors.iter().map(move |factor| power + factor.log10()));
    let step_size = if factors.len() > 1 {
        2f64.log10()
    } else {
        stride
    };
    let marks = values.map(|value| GridMark { value, step_size });
    marks
        .filter(|mark| (low..=high).contains(&mark.value))
        .collect()
}

/// Marks at even numbers on a logarithmic axis: they stand closest at its upper end.
fn close_marks([low, high]: [f64; 2], least: f64) -> Vec<GridMark> {
    let [from, to] = [low, high].map(|power| 10f64.powf(power));
    let marks = even_marks((from, to), to * (1.0 - 10f64.powf(-least)));
    let logarithm = |mark: GridMark| GridMark {
        value: mark.value.log10(),
        step_size: (1.0 + mark.step_size / mark.value).log10(),
    };
    marks
        .into_iter()
        .filter(|mark| mark.value > 0.0)
        .map(logarithm)
        .collect()
}

/// Write a number with enough digits to distinguish multiples of `step`: plainly, or with an exponent
/// where the largest of them is very large, or all are very small: all with the same one.
pub fn number(value: f64, step: f64, largest: f64) -> String {
    if !(value.abs() >= SLACK * step) {
        return "0".to_owned();
    }
    let lowest = (step.log10() + SLACK).floor() as i32;
    let plain =
        largest < 1e6 && (-lowest <= DECIMALS || largest >= 0.01 && -lowest <= 2 * DECIMALS);
    if plain {
        return format!("{value:.*}", (-lowest).max(0) as usize);
    }
    // All numbers of an axis have the exponent of the largest.
    let exponent = (largest.max(value.abs()).log10() + SLACK).floor() as i32;
    let digits = (exponent - lowest).clamp(0, 15) as usize;
    // One power could be beyond the range of numbers.
    let [first, second] = [exponent / 2, exponent - exponent / 2].map(|half| 10f64.powi(-half));
    format!("{:.digits$}e{exponent}", value * first * second)
}

/// Write the number of a logarithm with enough digits to distinguish its neighbours.
fn power(logarithm: f64, step: f64) -> String {
    let value = 10f64.powf(logarithm);
    let apart = value * (10f64.powf(step) - 1.0);
    // A neighbour at the next power of ten is far away, and the number is a round one.
    let apart = round_step(0.5 * apart.min(value));
    let text = number(value, apart, value);
    without_zeros(&text)
}

/// Remove trailing zeros of the decimals.
fn without_zeros(text: &str) -> String {
    let (digits, exponent) = match text.find('e') {
        Some(at) => text.split_at(at),
        None => (text, ""),
    };
    let digits = match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => digits,
    };
    format!("{digits}{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Marks of an axis of so many points, as they are written.
    fn written(scale: Scale, bounds: (f64, f64), points: f64) -> Vec<String> {
        let marks = marks(scale, bounds, points);
        let range = bounds.0..=bounds.1;
        let number = |mark: GridMark| scale.number(mark, &range);
        marks.into_iter().map(number).collect()
    }

    fn marks(scale: Scale, bounds: (f64, f64), points: f64) -> Vec<GridMark> {
        scale.across(GridInput {
            bounds,
            base_step_size: (bounds.1 - bounds.0) / points * UNIT,
        })
    }

    #[test]
    fn even_ticks_are_round_and_written_to_their_step() {
        let even = |low, high| written(Scale::Even, (low, high), 500.0);
        assert_eq!(even(0.0, 12.0), ["0", "2", "4", "6", "8", "10", "12"]);
        assert_eq!(even(-0.11, 0.11), ["-0.10", "-0.05", "0", "0.05", "0.10"]);
        assert_eq!(
            even(0.112, 0.1121),
            [
                "0.11200", "0.11202", "0.11204", "0.11206", "0.11208", "0.11210"
            ]
        );
        let small = ["0", "0.2e-4", "0.4e-4", "0.6e-4", "0.8e-4", "1.0e-4"];
        assert_eq!(even(0.0, 1.1e-4), small);
        assert_eq!(even(0.0, 4e-9), ["0", "1e-9", "2e-9", "3e-9", "4e-9"]);
        assert_eq!(
            even(-2.2e-5, 2.2e-5),
            ["-2e-5", "-1e-5", "0", "1e-5", "2e-5"]
        );
        assert_eq!(
            even(0.0, 2e-3),
            ["0", "0.0005", "0.0010", "0.0015", "0.0020"]
        );
        assert_eq!(even(0.0, 2e7), ["0", "0.5e7", "1.0e7", "1.5e7", "2.0e7"]);
    }

    #[test]
    fn no_tick_is_written_with_a_row_of_zeros() {
        for power in -300..300 {
            let high = 3.7 * 10f64.powi(power);
            for bounds in [(0.0, high), (-high, high), (0.3 * high, high)] {
                let texts = written(Scale::Even, bounds, 500.0);
                assert!((2..9).contains(&texts.len()), "{bounds:?}: {texts:?}");
                for text in texts {
                    assert!(text.len() <= 9, "{text}");
                    assert!(!text.contains("0.0000"), "{text}");
                }
            }
        }
    }

    #[test]
    fn logarithmic_ticks_are_1_2_5_where_there_is_room_or_powers_of_ten() {
        let log = |low, high, points| written(Scale::Logarithmic, (low, high), points);
        assert_eq!(log(-0.1, 1.2, 500.0), ["1", "2", "5", "10"]);
        assert_eq!(
            log(-3.1, 2.1, 500.0),
            ["0.001", "0.01", "0.1", "1", "10", "100"]
        );
        assert_eq!(
            log(-30.0, 31.0, 500.0),
            ["1e-30", "1e-20", "1e-10", "1", "1e10", "1e20", "1e30"]
        );
        assert_eq!(log(0.9, 1.01, 500.0), ["8", "8.5", "9", "9.5", "10"]);
        assert_eq!(
            log(0.95, 0.9501, 500.0),
            ["8.913", "8.9135", "8.914", "8.9145"]
        );
    }

    #[test]
    fn ticks_never_stand_closer_than_their_room() {
        for (low, span) in (0..200).map(|i| (f64::from(i % 17) - 8.3, 1.13f64.powi(i - 100))) {
            for points in [200.0, 700.0, 1600.0] {
                let bounds = (low, low + span);
                for scale in [Scale::Even, Scale::Logarithmic] {
                    let marks = marks(scale, bounds, points);
                    let room = ACROSS / points * span;
                    for pair in marks.windows(2) {
                        let apart = pair[1].value - pair[0].value;
                        assert!(
                            apart >= 0.999 * room,
                            "{scale:?} {bounds:?} {points}: {pair:?}"
                        );
                    }
                    assert!(marks.len() < 40);
                }
            }
        }
    }
}
