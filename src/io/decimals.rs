//! Numbers of tables, whose decimals follow a point or, in many countries, a comma.

use std::borrow::Cow;

use super::error::{Place, Problem, ReadError};
use super::reading::Remark;

/// The units that may stand behind numbers. Other words are labels, such as 12 b.
const UNITS: [&str; 13] = [
    "mm", "cm", "dm", "m", "km", "µm", "um", "in", "ft", "yd", "px", "deg", "°",
];

/// The decimal mark of a table, as far as the numbers read so far tell it.
#[derive(Default)]
pub(super) struct Decimals {
    mark: Option<DecimalMark>,
    /// Whether a comma was found that cannot be one between thousands.
    is_proved: bool,
    /// The first number whose comma can be one between thousands, with its line.
    doubtful: Option<(usize, String)>,
    /// The lines of numbers that are too small for a double, with the first of them.
    vanished: Option<(String, Vec<usize>)>,
}

#[derive(Clone, Copy, PartialEq)]
enum DecimalMark {
    Point,
    Comma,
}

impl Decimals {
    /// Read a number of a column.
    ///
    /// # Errors
    /// [`Problem`] if it is none, is infinite, or has another decimal mark than those before.
    pub(super) fn number(
        &mut self,
        text: &str,
        column: &'static str,
        line: usize,
    ) -> Result<f64, Problem> {
        let text = text.trim();
        // Typesetters and some spreadsheets write the minus sign itself.
        let plain = match text.is_ascii() {
            true => Cow::Borrowed(text),
            false => Cow::Owned(text.replace('\u{2212}', "-")),
        };
        let ungrouped = ungrouped(&plain);
        let is_grouped = ungrouped.is_some();
        let plain = ungrouped.map_or(plain, Cow::Owned);
        let mark = match (plain.contains('.'), plain.contains(',')) {
            (false, false) => None,
            (true, _) => Some(DecimalMark::Point),
            (false, true) => Some(DecimalMark::Comma),
        };
        let value: Option<f64> = match mark {
            Some(DecimalMark::Comma) => plain.replacen(',', ".", 1).parse().ok(),
            _ => plain.parse().ok(),
        };
        // Fortran writes the exponents of doubles as 1.0D-03.
        let of_fortran = || plain.replacen(['d', 'D'], "e", 1).parse().ok();
        let value = value
            .or_else(of_fortran)
            .ok_or_else(|| Problem::NotANumber {
                column,
                text: text.to_owned(),
            })?;
        if !value.is_finite() {
            return Err(Problem::NotFinite(text.to_owned()));
        }
        if mark.is_some() && self.mark.is_some() && mark != self.mark {
            return Err(Problem::MixedDecimals(text.to_owned()));
        }
        self.mark = self.mark.or(mark);
        if value == 0.0 && has_digits(text) {
            let (_, lines) = self.vanished.get_or_insert((text.to_owned(), Vec::new()));
            lines.push(line);
        }
        if mark == Some(DecimalMark::Comma) {
            if is_grouped || !may_be_grouped(&plain) {
                self.is_proved = true;
            } else if self.doubtful.is_none() {
                self.doubtful = Some((line, text.to_owned()));
            }
        }
        Ok(value)
    }

    /// Take the remark on numbers other than 0 that are too small for a double.
    pub(super) fn vanished(&mut self) -> Option<Remark> {
        let (text, lines) = self.vanished.take()?;
        Some(Remark::Vanished { text, lines })
    }

    /// Tell, after the last number, whether decimals follow a comma.
    ///
    /// # Errors
    /// [`Problem::AmbiguousComma`] with its line if each comma can as well be one between
    /// thousands.
    pub(super) fn are_commas(self) -> Result<bool, ReadError> {
        match self.doubtful {
            Some((line, text)) if !self.is_proved => {
                Err(Place::line(line).problem(Problem::AmbiguousComma(text)))
            }
            _ => Ok(self.mark == Some(DecimalMark::Comma)),
        }
    }
}

/// Whether a text is a finite number, with either decimal mark.
pub(super) fn is_number(text: &str) -> bool {
    let has_digits = text.bytes().any(|byte| byte.is_ascii_digit());
    has_digits && Decimals::default().number(text, "x", 0).is_ok()
}

/// Take a number with a unit behind it, such as `12.3 mm`, apart.
pub(super) fn measured(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let last = text.rfind(|it: char| it.is_ascii_digit() || it == '.' || it == ',')?;
    let (number, unit) = text.split_at(last + 1);
    let unit = unit.trim_start();
    (UNITS.contains(&unit) && is_number(number)).then_some((number, unit))
}

/// Whether a number is written with a digit other than 0 before its exponent.
fn has_digits(text: &str) -> bool {
    let digits = text.split(['e', 'E', 'd', 'D']).next();
    let digits = digits.unwrap_or_default();
    digits.bytes().any(|digit| (b'1'..=b'9').contains(&digit))
}

/// Take the marks between thousands out of a number that can be read in one way only: 1.234,5 or 1,234.5, or with
/// narrow or hard spaces or apostrophes between the thousands.
fn ungrouped(text: &str) -> Option<String> {
    let last = text.rfind(['.', ','])?;
    let (whole, decimals) = text.split_at(last);
    let grouping = |mark: &char| ['.', ',', '\'', '\u{2019}', '\u{a0}', '\u{202f}'].contains(mark);
    let mark = whole.chars().find(grouping)?;
    let mut groups = whole.trim_start_matches(['+', '-']).split(mark);
    let is_number = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    let head = groups.next()?;
    let is_whole = (1..=3).contains(&head.len())
        && is_number(head)
        && groups.all(|group| group.len() == 3 && is_number(group));
    (is_whole && !decimals.starts_with(mark)).then(|| whole.replace(mark, "") + decimals)
}

/// Whether a number with a comma can be a whole one with its thousands set apart, such as 12,345.
fn may_be_grouped(text: &str) -> bool {
    let digits = text.trim_start_matches(['+', '-']);
    let is_number = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    digits.split_once(',').is_some_and(|(head, tail)| {
        (1..=3).contains(&head.len())
            && !head.starts_with('0')
            && tail.len() == 3
            && is_number(head)
            && is_number(tail)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(texts: &[&str]) -> Result<(Vec<f64>, bool), String> {
        let mut decimals = Decimals::default();
        let mut values = Vec::new();
        for (index, text) in texts.iter().enumerate() {
            let value = decimals.number(text, "x", index + 1);
            values.push(value.map_err(|problem| problem.to_string())?);
        }
        let are_commas = decimals.are_commas().map_err(|error| error.to_string())?;
        Ok((values, are_commas))
    }

    #[test]
    fn decimal_commas_are_read_where_they_can_be_nothing_else() {
        for (text, value) in [
            ("0,125", 0.125),
            ("1,5", 1.5),
            ("-12,3456", -12.3456),
            (",5", 0.5),
            ("1234,567", 1234.567),
            ("1,234e-3", 1.234e-3),
            ("7,", 7.0),
        ] {
            assert_eq!(read(&[text]), Ok((vec![value], true)), "{text}");
            // One that is sure decides for those that are not.
            let expected = Ok((vec![1.234, value, 5.0], true));
            assert_eq!(read(&["1,234", text, "5"]), expected, "{text}");
        }
        assert_eq!(read(&["1.234", "5"]), Ok((vec![1.234, 5.0], false)));
    }

    #[test]
    fn commas_that_may_set_thousands_apart_are_refused() {
        for text in ["1,234", "-12,345", "+999,000"] {
            let expected = format!(
                "line 2: “{text}” can be read with a decimal comma or with a comma between thousands: write the table's decimals with points"
            );
            assert_eq!(read(&["7", text, "8"]), Err(expected), "{text}");
        }
        for text in ["1,234,567", "1.23,5", "1,2345.5", "1.234.5", ",", "1,5x"] {
            let expected = format!("“{text}” in column x is not a number");
            assert_eq!(read(&[text]), Err(expected));
        }
        for [first, second] in [["0,5", "2.5"], ["2.5", "0,5"], ["1.5", "1,234"]] {
            let expected = format!(
                "“{second}” has another decimal mark than the numbers before it: write all decimals with points, or all with commas"
            );
            assert_eq!(read(&[first, second]), Err(expected));
        }
    }
}
