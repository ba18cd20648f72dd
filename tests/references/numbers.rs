//! Typed numbers: random expressions against an evaluator of their trees, and what is never taken.

use batten::geometry::expressions::{
    ExpressionError, LengthUnit, NumberContext, sin_cos_of_degrees,
};
use batten::geometry::parameters::Quantity;
use proptest::prelude::*;

use crate::common::repeatable;

/// How far two ways to compute a number may be apart, by the largest number on the way.
const TOLERANCE: f64 = 1e-13;

/// An expression, how it is written, and what it comes to by arithmetic of this file alone.
#[derive(Clone, Debug)]
struct Case {
    text: String,
    /// How tightly it binds: 0 a sum, 1 a product, 2 a sign, 3 a power, 4 an operand.
    binds: u8,
    value: f64,
    /// The largest number on the way to the value, with what its rounding is multiplied by.
    size: f64,
}

impl Case {
    /// Written where something binds at least so tightly.
    fn inside(&self, binds: u8) -> String {
        match self.binds < binds {
            true => format!("({})", self.text),
            false => self.text.clone(),
        }
    }
}

fn combined(left: &Case, right: &Case, operator: usize, spaces: bool) -> Case {
    let (a, b) = (left.value, right.value);
    let (sign, binds, value, size) = match operator {
        0 => ("+", 0, a + b, left.size + right.size),
        1 => ("-", 0, a - b, left.size + right.size),
        2 => ("*", 1, a * b, left.size * right.size),
        _ => ("/", 1, a / b, left.size * right.size / (b * b)),
    };
    // What stands to the right of − and / binds tighter.
    let space = if spaces { " " } else { "" };
    Case {
        text: format!(
            "{}{space}{sign}{space}{}",
            left.inside(binds),
            right.inside(binds + 1)
        ),
        binds,
        value,
        size: size.max(value.abs()),
    }
}

fn called(inner: &Case, function: usize) -> Case {
    let x = inner.value;
    let (name, value, slope) = match function {
        0 => ("sin", x.sin(), 1.0),
        1 => ("cos", x.cos(), 1.0),
        2 => ("atan", x.atan(), 1.0),
        3 => ("tanh", x.tanh(), 1.0),
        _ => ("abs", x.abs(), 1.0),
    };
    // Numbers that come of angles are angles: radians make plain numbers of them.
    let text = match name {
        "atan" => format!("atan({})/(1rad)", inner.text),
        _ => format!("{name}({})", inner.text),
    };
    Case {
        text,
        binds: if name == "atan" { 1 } else { 4 },
        value,
        size: (slope * inner.size).max(value.abs()).max(1.0),
    }
}

fn number() -> impl Strategy<Value = Case> {
    (0u32..100_000, 0usize..4, any::<bool>()).prop_map(|(digits, form, comma)| {
        let value = f64::from(digits) / 1000.0;
        let plain = format!("{value}");
        let text = match form {
            0 => plain,
            1 => format!("{value:e}"),
            2 => format!("{value:.4}"),
            _ => format!("{}E-3", digits),
        };
        let value = text.parse().expect("a number");
        Case {
            // A decimal comma, where no function is around it, is put in below.
            text: if comma { format!("({text})") } else { text },
            binds: 4,
            value,
            size: value,
        }
    })
}

fn expression() -> impl Strategy<Value = Case> {
    number().prop_recursive(6, 64, 2, |inner| {
        prop_oneof![
            4 => (inner.clone(), inner.clone(), 0usize..4, any::<bool>())
                .prop_map(|(left, right, operator, spaces)| combined(&left, &right, operator, spaces)),
            1 => (inner.clone(), 0usize..5).prop_map(|(inner, function)| called(&inner, function)),
            1 => inner.clone().prop_map(|inner| Case {
                text: format!("-{}", inner.inside(3)),
                binds: 2,
                value: -inner.value,
                size: inner.size,
            }),
            1 => (inner.clone(), 0i32..4).prop_map(|(inner, power)| Case {
                text: format!("{}^{power}", inner.inside(4)),
                binds: 3,
                value: inner.value.powi(power),
                size: inner.size.max(1.0).powi(power) * f64::from(power.max(1)),
            }),
            1 => (inner.clone(), inner).prop_map(|(left, right)| Case {
                text: format!("max({},{})", left.text, right.text),
                binds: 4,
                value: left.value.max(right.value),
                size: left.size.max(right.size),
            }),
        ]
    })
}

proptest! {
    #![proptest_config(repeatable())]

    #[test]
    fn random_expressions_come_to_what_their_trees_do(case in expression()) {
        let context = NumberContext::default();
        let found = context.read(&case.text);
        if case.value.is_finite() && case.text.chars().count() < 1000 && case.size < 1e200 {
            let found = found.map_err(|mistake| TestCaseError::fail(format!("{}: {mistake}", case.text)))?;
            let off = (found - case.value).abs();
            prop_assert!(off <= TOLERANCE * case.size, "{} = {found}, not {}", case.text, case.value);
        } else if let Ok(found) = found {
            prop_assert!(found.is_finite());
        }
    }

    #[test]
    fn nothing_that_is_typed_panics_and_columns_lie_in_the_text(text in "[-+*/^(),.=0-9a-z °\"π−×]{0,40}") {
        for quantity in [Quantity::Number, Quantity::Length, Quantity::Angle, Quantity::Curvature, Quantity::Parameter] {
            let context = NumberContext { quantity, unit: Some(LengthUnit::Inch), before: Some(2.0) };
            match context.read(&text) {
                Ok(value) => prop_assert!(value.is_finite()),
                Err(mistake) => {
                    prop_assert!((1..=text.chars().count() + 1).contains(&mistake.column), "{mistake}");
                    prop_assert!(!mistake.error.to_string().is_empty());
                }
            }
            context.is_begun(&text);
        }
    }

    #[test]
    fn what_becomes_a_number_is_begun_at_every_character(case in expression()) {
        let context = NumberContext::default();
        if context.read(&case.text).is_ok() {
            for (byte, _) in case.text.char_indices() {
                let begun = &case.text[..byte];
                let angle = context.read(begun).is_err_and(|mistake| {
                    use ExpressionError::{Mixed, WrongQuantity};
                    matches!(mistake.error, WrongQuantity { .. } | Mixed(_))
                });
                prop_assert!(angle || context.is_begun(begun), "{begun} of {}", case.text);
            }
        }
    }

    #[test]
    fn lengths_convert_there_and_back(value in -1e6f64..1e6, from in 0usize..4, to in 0usize..4) {
        let [from, to] = [from, to].map(|index| LengthUnit::ALL[index]);
        let read = |unit: LengthUnit, text: &str| {
            let context = NumberContext { quantity: Quantity::Length, unit: Some(unit), before: None };
            context.read(text).expect("a length")
        };
        let there = read(to, &format!("{value}{}", from.symbol()));
        let back = read(from, &format!("{there}{}", to.symbol()));
        prop_assert!((back - value).abs() <= 4.0 * f64::EPSILON * value.abs());
        prop_assert_eq!(read(from, &format!("{value} {}", from.symbol())), value);
    }

    #[test]
    fn sines_of_degrees_keep_their_symmetries_to_the_bit(degrees in -720.0f64..720.0) {
        let (sine, cosine) = sin_cos_of_degrees(degrees);
        prop_assert!((sine.hypot(cosine) - 1.0).abs() < 1e-15);
        prop_assert_eq!(sin_cos_of_degrees(-degrees), (-sine, cosine));
        // Turned by a multiple of 90°, which is exact for such numbers only where no digit is lost.
        let turned = degrees + 360.0;
        if turned - 360.0 == degrees {
            prop_assert_eq!(sin_cos_of_degrees(turned), (sine, cosine));
        }
    }
}
