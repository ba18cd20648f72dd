//! Numbers as people type them.

use super::brackets::with_decimal_points;
use super::error::{ExpressionError, ExpressionMistake, NoNumber};
use super::expression::Expression;
use super::measure::{Conventions, Dimension};
use super::reading::begins_name;
use super::unit::{LengthUnit, Unit};
use crate::geometry::parameters::Quantity;

/// Context of a typed number: its quantity, and the number it replaces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NumberContext {
    /// The quantity of the number.
    pub quantity: Quantity,
    /// The document's unit of length; without one no unit of length can be converted.
    pub unit: Option<LengthUnit>,
    /// The number there before: `+=2`, `-=1`, `*=1.1` and `/=2` change it.
    pub before: Option<f64>,
}

/// What can be done to the number before, and how a text that does so begins.
#[derive(Clone, Copy, PartialEq)]
enum Change {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// The spellings of changes.
const CHANGES: [(&str, Change); 7] = [
    ("+=", Change::Add),
    ("-=", Change::Subtract),
    ("−=", Change::Subtract),
    ("*=", Change::Multiply),
    ("×=", Change::Multiply),
    ("·=", Change::Multiply),
    ("/=", Change::Divide),
];

impl NumberContext {
    /// Read a number: `-8+1/2`, `10*cos(30deg)`, `sqrt(2)`, `2*pi`, `1e-3`; with a decimal comma (`3,5`),
    /// where a comma directly in a function's brackets separates its arguments (`max(1,2)`); in a unit
    /// (`12mm`, `1/2in`, `30deg`, `0.5rad`), which is converted; or relative to the number before (`+=2`,
    /// `*=1.1`). Numbers without a unit are in the document's unit, angles in degrees; sines and the like of
    /// numbers without a unit are those of radians. A curvature can be given by its radius: `R1652` or `r=1652` to
    /// the side of the number before, `-R 12cm` for a right turn, `+R 12cm` for a left one.
    ///
    /// The result is finite: a length in the document's unit, an angle in degrees, anything else as it is.
    ///
    /// # Errors
    /// [`ExpressionMistake`] with the column in this text, counted from 1.
    pub fn read(&self, text: &str) -> Result<f64, ExpressionMistake> {
        let start = text.len() - text.trim_start().len();
        let begun = text.get(start..).unwrap_or_default();
        let change = CHANGES.iter().find(|(sign, _)| begun.starts_with(sign));
        let Some((sign, change)) = change else {
            let value = self.number(text, self.quantity)?;
            // A radius without a sign bends to the side of the number before.
            let turns = value > 0.0 && self.before < Some(0.0) && self.is_unsigned_radius(text);
            return Ok(if turns { -value } else { value });
        };
        let before = self.before.ok_or_else(|| {
            let error = ExpressionError::NothingBefore { operator: sign };
            ExpressionMistake::at(text, start, error)
        })?;
        let (head, rest) = text.split_at(start + sign.len());
        let quantity = match change {
            Change::Add | Change::Subtract => self.quantity,
            Change::Multiply | Change::Divide => Quantity::Number,
        };
        let number = self.number(rest, quantity);
        let number = number.map_err(|mistake| mistake.shifted(head.chars().count()))?;
        let value = match change {
            Change::Add => before + number,
            Change::Subtract => before - number,
            Change::Multiply => before * number,
            Change::Divide => before / number,
        };
        finite(
            value,
            text,
            matches!(change, Change::Divide) && number == 0.0,
        )
    }

    /// Whether a text that is no number may become one when more is typed at its end.
    pub fn is_begun(&self, text: &str) -> bool {
        let Err(mistake) = self.read(text) else {
            return true;
        };
        if CHANGES.iter().any(|(sign, _)| *sign == text.trim()) {
            return true;
        }
        // The mistake may be a name that is not whole yet, or the end of the text.
        let last = |name: &str| text.trim_end().ends_with(name);
        match &mistake.error {
            ExpressionError::Syntax { found: None, .. } => true,
            // 1/0 becomes 1/0.5.
            ExpressionError::NotANumber { .. } => true,
            ExpressionError::UnknownName { name, .. } if last(name) && begins_name(name) => true,
            ExpressionError::UnknownUnit { name, .. } if last(name) && Unit::begins(name) => true,
            _ => self.read(&format!("{text}0")).is_ok(),
        }
    }

    fn is_unsigned_radius(&self, text: &str) -> bool {
        let is_radius = self.quantity == Quantity::Curvature && split_radius(text).is_some();
        is_radius && !text.trim_start().starts_with(['+', '-', '−'])
    }

    fn number(&self, text: &str, quantity: Quantity) -> Result<f64, ExpressionMistake> {
        if quantity == Quantity::Curvature
            && let Some((head, sign, radius)) = split_radius(text)
        {
            let radius = self.number(radius, Quantity::Length);
            let radius = radius.map_err(|mistake| mistake.shifted(head.chars().count()))?;
            return finite(sign / radius, text, radius == 0.0);
        }
        let expression = Expression::read_number(&with_decimal_points(text))?;
        let is_length = matches!(quantity, Quantity::Length | Quantity::Curvature);
        // Where lengths make no sense, any unit tells so, or cancels.
        let any_unit = (!is_length).then_some(LengthUnit::Millimetre);
        let conventions = Conventions {
            unit: self.unit.or(any_unit),
            degrees: quantity == Quantity::Angle,
        };
        let found = conventions.measure(&expression)?;
        let needed = match quantity {
            Quantity::Number => Dimension::PLAIN,
            Quantity::Length => Dimension::LENGTH,
            Quantity::Curvature => Dimension::CURVATURE,
            Quantity::Angle | Quantity::Parameter => Dimension::ANGLE,
        };
        if ![Dimension::PLAIN, needed].contains(&found.dimension) {
            let start = text.len() - text.trim_start().len();
            let error = ExpressionError::WrongQuantity {
                found: found.dimension.name(),
                needed: match quantity {
                    Quantity::Parameter => "a parameter",
                    _ => needed.name(),
                },
            };
            return Err(ExpressionMistake::at(text, start, error));
        }
        let value = match quantity {
            Quantity::Parameter => found.radians(),
            _ => found.number,
        };
        finite(value, text, expression.divides_by_zero())
    }
}

/// Split a curvature that is given by a radius, as `R1652` or `-r = 12mm`: what stands before the radius, the
/// sign of the curvature, and the radius. `None` for other texts, names that begin with r among them.
fn split_radius(text: &str) -> Option<(&str, f64, &str)> {
    let unsigned = text.trim_start();
    let negative = unsigned.strip_prefix(['-', '−']);
    let positive = unsigned.strip_prefix('+');
    let named = negative.or(positive).unwrap_or(unsigned).trim_start();
    let rest = named.strip_prefix(['R', 'r'])?.trim_start();
    let radius = rest.strip_prefix('=').unwrap_or(rest);
    if radius.starts_with(char::is_alphabetic) {
        return None;
    }
    let head = text.get(..text.len() - radius.len())?;
    Some((head, negative.map_or(1.0, |_| -1.0), radius))
}

/// Check that a text has a finite value.
fn finite(value: f64, text: &str, divides_by_zero: bool) -> Result<f64, ExpressionMistake> {
    if value.is_finite() {
        return Ok(value);
    }
    let start = text.len() - text.trim_start().len();
    let error = ExpressionError::NotANumber {
        text: text.trim().to_owned(),
        reason: NoNumber::of(value, divides_by_zero),
    };
    Err(ExpressionMistake::at(text, start, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn context(quantity: Quantity) -> NumberContext {
        NumberContext {
            quantity,
            unit: Some(LengthUnit::Millimetre),
            before: Some(10.0),
        }
    }

    #[track_caller]
    fn assert_read(quantity: Quantity, cases: &[(&str, f64)]) {
        for (text, expected) in cases {
            let found = context(quantity).read(text);
            let found = found.unwrap_or_else(|mistake| panic!("{text}: {mistake}"));
            assert_eq!(found, *expected, "{text}");
        }
    }

    #[track_caller]
    fn assert_refused(quantity: Quantity, text: &str, column: usize, words: &str) {
        let mistake = context(quantity).read(text).expect_err(text);
        assert_eq!(mistake.column, column, "{text}: {mistake}");
        let said = mistake.error.to_string();
        assert!(said.contains(words), "{text}: {said}");
    }

    #[test]
    fn arithmetic_and_functions_are_computed() {
        let cases = [
            ("-8+1/2", -7.5),
            ("10*cos(60deg)", 5.0),
            ("10*cos(90°)", 0.0),
            ("sqrt(4)", 2.0),
            ("pi", std::f64::consts::PI),
            ("1e-3", 0.001),
            (" −2 ", -2.0),
            ("3,5", 3.5),
            ("1,5e3", 1500.0),
            ("max(1,2)", 2.0),
            ("max((3,5),2)+0,25", 3.75),
            ("min(1, -2)", -2.0),
            ("hypot(3,4)", 5.0),
            ("2*3+4", 10.0),
            ("-2^2", -4.0),
            ("sin(pi/2)", 1.0),
        ];
        assert_read(Quantity::Number, &cases);
        assert_read(Quantity::Length, &cases);
    }

    #[test]
    fn units_are_converted() {
        let lengths = [
            ("12mm", 12.0),
            ("2.5 cm", 25.0),
            ("1in", 25.4),
            ("1/2in", 12.7),
            ("1/2\"", 12.7),
            ("1m - 1", 999.0),
            ("-(1+2)cm", -30.0),
            ("sqrt(3mm*12mm)", 6.0),
            ("2cm/(4mm)*1mm", 5.0),
            ("max(1cm, 2mm)", 10.0),
        ];
        assert_read(Quantity::Length, &lengths);
        let metres = NumberContext {
            unit: Some(LengthUnit::Metre),
            ..context(Quantity::Length)
        };
        assert_eq!(metres.read("12mm"), Ok(0.012));
        let angles = [
            ("30", 30.0),
            ("30deg", 30.0),
            ("pi/4 rad", 45.0),
            ("45 + 30°", 75.0),
            ("atan(1)", 45.0),
            ("atan2(-1cm, -10mm)", -135.0),
            ("max(10, 20deg)", 20.0),
        ];
        assert_read(Quantity::Angle, &angles);
        assert_read(Quantity::Curvature, &[("1/(5cm)", 0.02), ("0.5", 0.5)]);
        let radii = [
            ("R1652", 1.0 / 1652.0),
            ("r=1652", 1.0 / 1652.0),
            (" r = 5cm", 0.02),
            ("-R 8", -0.125),
            ("R-8", -0.125),
            ("1/1652", 1.0 / 1652.0),
            ("+=R2", 10.5),
        ];
        assert_read(Quantity::Curvature, &radii);
        let right = NumberContext {
            before: Some(-0.1),
            ..context(Quantity::Curvature)
        };
        for (text, value) in [
            ("R8", -0.125),
            ("r=8", -0.125),
            ("+R8", 0.125),
            ("-R8", -0.125),
        ] {
            assert_eq!(right.read(text), Ok(value), "{text}");
        }
        assert_eq!(right.read("0.125"), Ok(0.125));
        let parameters = [("180deg", std::f64::consts::PI), ("2", 2.0)];
        assert_read(Quantity::Parameter, &parameters);
    }

    #[test]
    fn changes_start_from_the_number_before() {
        let changes = [
            ("+=2", 12.0),
            ("-=1", 9.0),
            ("−= 1cm", 0.0),
            (" *=1,1", 11.0),
            ("/=2", 5.0),
            ("+=-2", 8.0),
            ("+2", 2.0),
        ];
        assert_read(Quantity::Length, &changes);
        assert_refused(Quantity::Length, "*=2mm", 3, "a length is given");
        assert_refused(Quantity::Length, "/=0", 1, "“/=0” divides by zero");
        assert_refused(Quantity::Length, " += 2x", 6, "“x” is no unit");
        let fresh = NumberContext {
            before: None,
            ..context(Quantity::Length)
        };
        let mistake = fresh.read(" +=2").expect_err("nothing before");
        assert_eq!(mistake.column, 2);
    }

    #[test]
    fn mistakes_name_their_columns() {
        use Quantity::{Angle, Curvature, Length, Number};
        assert_refused(Number, "", 1, "expected a number");
        assert_refused(Number, "one", 1, "“one” means nothing here");
        assert_refused(Number, "2*t", 3, "“t” means nothing here");
        assert_refused(Number, "1 + foo(2)", 5, "“foo” means nothing here");
        assert_refused(Number, "3 mm", 1, "a length is given where a plain number");
        assert_refused(Number, "3deg", 1, "an angle is given where a plain number");
        assert_refused(Length, "30deg", 1, "an angle is given where a length");
        assert_refused(Length, "2mm*3mm", 1, "an area is given where a length");
        assert_refused(Angle, "3mm", 1, "a length is given where an angle");
        assert_refused(Curvature, "3mm", 1, "where a curvature");
        assert_refused(Curvature, "R=0", 1, "“R=0” divides by zero");
        assert_refused(Curvature, "R 3deg", 3, "an angle is given where a length");
        assert_refused(Curvature, "R2 + foo", 6, "“foo” means nothing here");
        assert_refused(Length, "R3", 1, "“R3” means nothing here");
        assert_refused(Length, "1 + 2*3kg", 8, "“kg” is no unit here");
        assert_refused(
            Length,
            "1mm + 2deg",
            5,
            "a length and an angle do not go together",
        );
        assert_refused(Length, "2*sin(30deg+1)", 12, "an angle and a plain number");
        assert_refused(Length, "2*sin(3mm)", 3, "a length is given");
        assert_refused(
            Length,
            "2^(3mm)",
            2,
            "a length is given where a plain number",
        );
        assert_refused(
            Number,
            "1,5,5",
            4,
            "expected an operator or the end, found “.”",
        );
        assert_refused(Number, "cos(3,5)", 1, "cos needs one argument, not 2");
        assert_refused(Number, "1+max(3)", 3, "max needs two arguments");
        assert_refused(Number, "1/0", 1, "“1/0” divides by zero");
        assert_refused(Number, "sqrt(-1)", 1, "is not a real number");
        assert_refused(Number, "10^400", 1, "is too large");
        assert_refused(Number, "2+0^(0-1)", 1, "divides by zero");
        assert_refused(Number, "(1+2", 5, "a closing parenthesis");
        assert_refused(
            Number,
            "1 2",
            3,
            "expected an operator or the end, found “2”",
        );
        let unitless = NumberContext::default();
        let mistake = NumberContext {
            quantity: Length,
            ..unitless
        };
        let mistake = mistake.read("1 + 12mm").expect_err("no unit");
        assert_eq!(mistake.column, 7);
    }

    #[test]
    fn without_a_unit_lengths_are_refused_where_they_make_sense_and_cancel_elsewhere() {
        let read = |quantity, text: &str| {
            let context = NumberContext {
                quantity,
                ..NumberContext::default()
            };
            let read = context.read(text);
            read.map_err(|mistake| mistake.to_string())
        };
        let refused = read(Quantity::Angle, "2mm");
        let words = "column 1: a length is given where an angle is needed";
        assert_eq!(refused, Err(words.to_owned()));
        assert_eq!(read(Quantity::Number, "2cm/(5mm)"), Ok(4.0));
    }

    #[test]
    fn what_may_become_a_number_is_begun() {
        for text in [
            "", "-", "+.", "1e", "2e-", "1e-", "10*", "10*c", "sqr", "sqrt(2", "30d", "+=", "+= ",
            "max(1,", "1/0",
        ] {
            assert!(context(Quantity::Angle).is_begun(text), "{text}");
        }
        for text in ["R", "-r", "r=", "R1", "R 2c"] {
            assert!(context(Quantity::Curvature).is_begun(text), "{text}");
        }
        for text in ["1x", "foo", "c*2", "2)", "1..", "3k"] {
            assert!(!context(Quantity::Angle).is_begun(text), "{text}");
        }
    }
}
