//! Expressions in t, as they are typed: read to a tree, and expanded in power series.

use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};
use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};

use super::error::{ReferenceError, ReferenceTextError};
use crate::geometry::power_series::PowerSeries;

/// The most characters of an expression: trees of it are not too deep to walk.
const MOST_CHARACTERS: usize = 1000;

/// The most parentheses within each other.
const MOST_NESTED: usize = 50;

/// The grammar of expressions.
#[derive(pest_derive::Parser)]
#[grammar = "geometry/references/expression.pest"]
struct Grammar;

/// An expression in t.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expression {
    /// A number.
    Number(f64),
    /// The parameter t.
    Parameter,
    /// −a.
    Negative(Box<Self>),
    /// Two expressions, combined.
    Combined(Operator, Box<[Self; 2]>),
    /// A function of an expression.
    Call(Function, Box<Self>),
}

/// What combines two expressions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
    Power,
}

/// A function that expressions can name.
#[derive(Clone, Copy)]
pub(super) struct Function {
    name: &'static str,
    of: fn(&PowerSeries) -> PowerSeries,
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl std::fmt::Debug for Function {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name)
    }
}

/// The functions that there are.
const FUNCTIONS: &[Function] = &[
    function("sin", |f| f.sin_cos().0),
    function("cos", |f| f.sin_cos().1),
    function("tan", PowerSeries::tan),
    function("asin", PowerSeries::asin),
    function("acos", PowerSeries::acos),
    function("atan", PowerSeries::atan),
    function("sinh", |f| f.sinh_cosh().0),
    function("cosh", |f| f.sinh_cosh().1),
    function("tanh", PowerSeries::tanh),
    function("exp", PowerSeries::exp),
    function("ln", PowerSeries::ln),
    function("sqrt", |f| f.power(0.5)),
    function("abs", PowerSeries::abs),
];

/// The names of numbers.
const NUMBERS: &[(&str, f64)] = &[
    ("pi", std::f64::consts::PI),
    ("π", std::f64::consts::PI),
    ("e", std::f64::consts::E),
];

/// The name of the parameter.
const PARAMETER: &str = "t";

const fn function(name: &'static str, of: fn(&PowerSeries) -> PowerSeries) -> Function {
    Function { name, of }
}

impl Expression {
    /// Read an expression: numbers, t, pi, e, the operators + − * / ^, parentheses and functions.
    /// Powers bind before signs, and from the right: −t^2 is −(t²), 2^3^2 is 2⁹.
    ///
    /// # Errors
    /// [`ReferenceTextError`] with the column in this text.
    pub(super) fn read(text: &str) -> Result<Self, ReferenceTextError> {
        check_size(text)?;
        let pairs = Grammar::parse(Rule::formula, text).map_err(|error| {
            let byte = match error.location {
                InputLocation::Pos(byte) | InputLocation::Span((byte, _)) => byte,
            };
            let (before, after) = text.split_at_checked(byte).unwrap_or((text, ""));
            let found = after.chars().next().map(String::from);
            let expected = expected(&error.variant, before);
            mistake(text, byte, ReferenceError::Syntax { found, expected })
        })?;
        let priorities = PrattParser::new()
            .op(Op::infix(Rule::plus, Assoc::Left) | Op::infix(Rule::minus, Assoc::Left))
            .op(Op::infix(Rule::times, Assoc::Left) | Op::infix(Rule::over, Assoc::Left))
            .op(Op::prefix(Rule::negative) | Op::prefix(Rule::positive))
            .op(Op::infix(Rule::power, Assoc::Right));
        let mut expressions = pairs.filter(|pair| pair.as_rule() == Rule::expression);
        match expressions.next() {
            Some(expression) => tree(&priorities, text, expression.into_inner()),
            None => Ok(Self::Number(0.0)),
        }
    }

    /// Whether t occurs in it.
    pub(super) fn depends_on_parameter(&self) -> bool {
        match self {
            Self::Number(_) => false,
            Self::Parameter => true,
            Self::Negative(inner) | Self::Call(_, inner) => inner.depends_on_parameter(),
            Self::Combined(_, operands) => operands.iter().any(Self::depends_on_parameter),
        }
    }

    /// Expand it about t.
    pub(super) fn series(&self, t: f64, order: usize) -> PowerSeries {
        match self {
            Self::Number(number) => PowerSeries::constant(*number, order),
            Self::Parameter => PowerSeries::parameter(t, order),
            Self::Negative(inner) => -&inner.series(t, order),
            Self::Call(function, inner) => (function.of)(&inner.series(t, order)),
            Self::Combined(operator, operands) => {
                let [left, right] = &**operands;
                let base = left.series(t, order);
                if *operator == Operator::Power && !right.depends_on_parameter() {
                    return base.power(right.value());
                }
                let other = right.series(t, order);
                match operator {
                    Operator::Plus => &base + &other,
                    Operator::Minus => &base - &other,
                    Operator::Times => &base * &other,
                    Operator::Over => &base / &other,
                    Operator::Power => (&other * &base.ln()).exp(),
                }
            }
        }
    }

    /// The value of an expression without t.
    pub(super) fn value(&self) -> f64 {
        self.series(0.0, 0).value()
    }
}

fn check_size(text: &str) -> Result<(), ReferenceTextError> {
    let mut depth = 0_usize;
    for (index, (byte, character)) in text.char_indices().enumerate() {
        depth = match character {
            '(' => depth + 1,
            ')' => depth.saturating_sub(1),
            _ => depth,
        };
        if depth > MOST_NESTED || index == MOST_CHARACTERS {
            return Err(mistake(text, byte, ReferenceError::TooLong));
        }
    }
    Ok(())
}

/// Make a tree of an expression's parts.
fn tree(
    priorities: &PrattParser<Rule>,
    text: &str,
    parts: Pairs<'_, Rule>,
) -> Result<Expression, ReferenceTextError> {
    let combined =
        |operator, left, right| Ok(Expression::Combined(operator, Box::new([left?, right?])));
    let mut reading = priorities
        .map_primary(|part| operand(priorities, text, part))
        .map_prefix(|sign, inner| match sign.as_rule() {
            Rule::negative => Ok(Expression::Negative(Box::new(inner?))),
            _ => inner,
        })
        .map_infix(|left, operator, right| match operator.as_rule() {
            Rule::plus => combined(Operator::Plus, left, right),
            Rule::minus => combined(Operator::Minus, left, right),
            Rule::times => combined(Operator::Times, left, right),
            Rule::over => combined(Operator::Over, left, right),
            _ => combined(Operator::Power, left, right),
        });
    reading.parse(parts)
}

fn operand(
    priorities: &PrattParser<Rule>,
    text: &str,
    part: Pair<'_, Rule>,
) -> Result<Expression, ReferenceTextError> {
    let refused = |error| mistake(text, part.as_span().start(), error);
    let word = part.as_str();
    match part.as_rule() {
        Rule::number => {
            let number = word.parse().ok().filter(|it: &f64| it.is_finite());
            let text = word.to_owned();
            let number = number.ok_or_else(|| refused(ReferenceError::NotANumber { text }))?;
            Ok(Expression::Number(number))
        }
        Rule::name if word == PARAMETER => Ok(Expression::Parameter),
        Rule::name => {
            let known = NUMBERS.iter().find(|(name, _)| *name == word);
            let (_, number) = known.ok_or_else(|| refused(unknown_name(word)))?;
            Ok(Expression::Number(*number))
        }
        Rule::call => {
            let mut parts = part.clone().into_inner();
            let name = parts.next().map_or("", |name| name.as_str());
            let function = FUNCTIONS.iter().find(|function| function.name == name);
            let function = *function.ok_or_else(|| refused(unknown_name(name)))?;
            let empty = || {
                refused(ReferenceError::NotANumber {
                    text: word.to_owned(),
                })
            };
            let inner = parts.next().ok_or_else(empty)?;
            let inner = tree(priorities, text, inner.into_inner())?;
            Ok(Expression::Call(function, Box::new(inner)))
        }
        _ => tree(priorities, text, part.into_inner()),
    }
}

fn unknown_name(name: &str) -> ReferenceError {
    let functions: Vec<&str> = FUNCTIONS.iter().map(|function| function.name).collect();
    ReferenceError::UnknownName {
        name: name.to_owned(),
        functions: functions.join(", "),
    }
}

/// Say how an expression could go on after its beginning.
fn expected(variant: &ErrorVariant<Rule>, before: &str) -> &'static str {
    let ErrorVariant::ParsingError { positives, .. } = variant else {
        return "an expression";
    };
    let operator = |rule: &Rule| matches!(rule, Rule::plus | Rule::times | Rule::power);
    let open = before.matches('(').count() > before.matches(')').count();
    match (positives.iter().any(operator), open) {
        (true, true) => "an operator or a closing parenthesis",
        (true, false) => "an operator or the end",
        (false, _) => "a number, t, a function or a parenthesis",
    }
}

/// A mistake at a byte of a text.
fn mistake(text: &str, byte: usize, error: ReferenceError) -> ReferenceTextError {
    let before = text.get(..byte).unwrap_or(text);
    ReferenceTextError {
        column: before.chars().count() + 1,
        error,
    }
}
