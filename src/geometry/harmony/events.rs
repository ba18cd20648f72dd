//! Events of a sequence of numbers: extrema and changes of sign.

use super::flow::VertexSequence;
use crate::geometry::features::ExtremumKind;

/// Event of a curvature or torsion at one place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// It has an extremum.
    Extremum(ExtremumKind),
    /// It changes its sign.
    SignChange,
}

/// Hold an event of a sequence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SequenceEvent {
    pub(super) event: Event,
    /// Its place in numbers of vertices: a half in the middle of two.
    pub(super) at: f64,
}

/// A number with its rounding error.
#[derive(Clone, Copy)]
struct Rounded {
    vertex: f64,
    value: f64,
    rounding: f64,
}

impl Rounded {
    /// Whether it lies below another for certain.
    fn is_below(self, other: Self) -> bool {
        other.value - self.value > self.rounding + other.rounding
    }

    /// Its sign, or 0 if that is in doubt.
    fn sign(self) -> i8 {
        if self.value.abs() <= self.rounding {
            0
        } else if self.value > 0.0 {
            1
        } else {
            -1
        }
    }
}

/// List the extrema and changes of sign of a sequence in the order of its vertices. `rounding`
/// tells for each place how far its number may be off: numbers that differ by no more count as
/// equal, a plateau of them as one extremum, in its middle, and what may be 0 has no sign. Numbers
/// that are none are passed over.
pub(super) fn events(sequence: &VertexSequence, rounding: &[f64]) -> Vec<SequenceEvent> {
    let numbers = sequence.values().iter().zip(rounding).enumerate();
    let numbers = numbers.map(|(place, (value, rounding))| Rounded {
        vertex: sequence.vertex(place) as f64,
        value: *value,
        rounding: *rounding,
    });
    let mut numbers: Vec<Rounded> = numbers.filter(|number| number.value.is_finite()).collect();
    let period = sequence.values().len() as f64;
    let rises = if sequence.is_closed() {
        close(&mut numbers, period);
        numbers.first().map(|top| top.value > 0.0)
    } else {
        None
    };
    let mut events = extrema(&numbers, rises);
    events.extend(sign_changes(&numbers));
    if sequence.is_closed() {
        for event in &mut events {
            event.at %= period;
        }
    }
    events.sort_by(|a, b| a.at.total_cmp(&b.at));
    events
}

/// Let a closed sequence begin and end at its greatest number in magnitude: where it is a plateau,
/// at the start of that.
fn close(numbers: &mut Vec<Rounded>, period: f64) {
    let count = numbers.len();
    let magnitude = |place: usize| numbers[place].value.abs();
    let greatest = (0..count).max_by(|a, b| magnitude(*a).total_cmp(&magnitude(*b)));
    let Some(greatest) = greatest else {
        return;
    };
    let top = numbers[greatest];
    let is_level = |back: &usize| {
        let number = numbers[(greatest + count - back) % count];
        !number.is_below(top) && !top.is_below(number)
    };
    let level = (1..count).take_while(is_level).count();
    let start = (greatest + count - level) % count;
    numbers.rotate_left(start);
    for number in &mut numbers[count - start..] {
        number.vertex += period;
    }
    let mut last = numbers[0];
    last.vertex += period;
    numbers.push(last);
}

/// Follow the numbers up and down. `rises` tells what they do before the first one, which is an
/// extremum then if they turn there; `None` at an end.
fn extrema(numbers: &[Rounded], mut rises: Option<bool>) -> Vec<SequenceEvent> {
    let mut found = Vec::new();
    let Some(first) = numbers.first() else {
        return found;
    };
    // The lowest and the highest number since the last turn, each with the end of its plateau.
    let (mut lowest, mut highest) = ([*first; 2], [*first; 2]);
    for number in numbers {
        extend(&mut lowest, *number, |new, old| new.value < old.value);
        extend(&mut highest, *number, |new, old| new.value > old.value);
        let (turned, kind, top) = match rises {
            Some(true) => (number.is_below(highest[0]), ExtremumKind::Maximum, highest),
            Some(false) => (lowest[0].is_below(*number), ExtremumKind::Minimum, lowest),
            None => {
                if lowest[0].is_below(*number) {
                    rises = Some(true);
                } else if number.is_below(highest[0]) {
                    rises = Some(false);
                }
                continue;
            }
        };
        if turned {
            found.push(SequenceEvent {
                event: Event::Extremum(kind),
                at: 0.5 * (top[0].vertex + top[1].vertex),
            });
            rises = rises.map(|rises| !rises);
            (lowest, highest) = ([*number; 2], [*number; 2]);
        }
    }
    found
}

/// Take a number into a plateau, or begin another with it.
fn extend(plateau: &mut [Rounded; 2], number: Rounded, beyond: fn(Rounded, Rounded) -> bool) {
    let [top, _] = *plateau;
    let apart = top.is_below(number) || number.is_below(top);
    if beyond(number, top) {
        *plateau = if apart {
            [number; 2]
        } else {
            [
                Rounded {
                    vertex: top.vertex,
                    ..number
                },
                number,
            ]
        };
    } else if !apart {
        plateau[1] = number;
    }
}

fn sign_changes(numbers: &[Rounded]) -> Vec<SequenceEvent> {
    let mut last: Option<Rounded> = None;
    let mut found = Vec::new();
    for number in numbers.iter().filter(|number| number.sign() != 0) {
        if let Some(before) = last.filter(|before| before.sign() != number.sign()) {
            found.push(SequenceEvent {
                event: Event::SignChange,
                at: 0.5 * (before.vertex + number.vertex),
            });
        }
        last = Some(*number);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(values: &[f64], closed: bool, rounding: f64) -> Vec<(char, f64)> {
        let sequence = VertexSequence::of(values, closed);
        let events = events(&sequence, &vec![rounding; values.len()]);
        let told = events.iter().map(|event| {
            let letter = match event.event {
                Event::Extremum(ExtremumKind::Maximum) => '^',
                Event::Extremum(ExtremumKind::Minimum) => 'v',
                Event::SignChange => '0',
            };
            (letter, event.at)
        });
        told.collect()
    }

    #[test]
    fn extrema_and_changes_of_sign_come_in_order() {
        let values = [1.0, 3.0, 2.0, -1.0, -4.0, -4.0, -2.0, 0.0, 0.0, 5.0];
        let expected = [('^', 1.0), ('0', 2.5), ('v', 4.5), ('0', 7.5)];
        assert_eq!(found(&values, false, 0.0), expected);
    }

    #[test]
    fn ends_and_rounding_make_no_extrema() {
        assert_eq!(found(&[1.0, 2.0, 3.0], false, 0.0), []);
        assert_eq!(found(&[3.0, 3.0, 3.0], false, 0.0), []);
        let level = [2.0, 2.0 + 1e-9, 2.0 - 1e-9, 2.0 + 1e-9, 2.0];
        assert_eq!(found(&level, false, 2e-9), []);
        assert_eq!(found(&level, true, 2e-9), []);
        assert_eq!(
            found(&[1.0, 2.0, 2.0 + 1e-9, 2.0, 1.0], false, 1e-9),
            [('^', 2.0)]
        );
        assert_eq!(found(&[], false, 0.0), []);
    }

    #[test]
    fn a_closed_sequence_has_as_many_maxima_as_minima() {
        let values = [5.0, 1.0, 2.0, 1.0, 5.0];
        let expected = [('v', 1.0), ('^', 2.0), ('v', 3.0), ('^', 4.5)];
        assert_eq!(found(&values, true, 0.0), expected);
        let values = [1.0, -1.0, -3.0, 2.0];
        let expected = [('0', 0.5), ('v', 2.0), ('0', 2.5), ('^', 3.0)];
        assert_eq!(found(&values, true, 0.0), expected);
    }
}
