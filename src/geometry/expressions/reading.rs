//! Reading expressions.

use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};
use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};

use super::error::{ExpressionError, ExpressionMistake, NoNumber};
use super::expression::{Expression, Operator};
use super::function::{Function, function_names};
use super::unit::Unit;

/// The most characters of an expression: trees of it are not too deep to walk.
const MOST_CHARACTERS: usize = 1000;

/// The most parentheses within each other.
const MOST_NESTED: usize = 50;

/// The grammar of expressions.
#[derive(pest_derive::Parser)]
#[grammar = "geometry/expressions/expression.pest"]
struct Grammar;

/// The names of numbers.
const NUMBERS: [(&str, f64); 3] = [
    ("pi", std::f64::consts::PI),
    ("π", std::f64::consts::PI),
    ("e", std::f64::consts::E),
];

/// The name of the parameter.
const PARAMETER: &str = "t";

/// Reads an expression of one sort.
struct Reader<'a> {
    text: &'a str,
    priorities: PrattParser<Rule>,
    sort: &'static Sort,
}

/// Allowed contents of an expression, and their description.
struct Sort {
    is_formula: bool,
    names: &'static str,
    units: &'static str,
    operand: &'static str,
}

static FORMULA: Sort = Sort {
    is_formula: true,
    names: "t, pi, e",
    units: "deg or rad",
    operand: "a number, t, a function or a parenthesis",
};

static NUMBER: Sort = Sort {
    is_formula: false,
    names: "pi, e",
    units: "mm, cm, m, in, deg or rad",
    operand: "a number, a function or a parenthesis",
};

impl Expression {
    /// Read a formula: numbers, t, pi, e, the operators + − * / ^, parentheses, functions, and angles in
    /// degrees or radians. Powers bind before signs, and from the right: −t^2 is −(t²), 2^3^2 is 2⁹.
    /// Units bind as * does: 1/2deg is half a degree.
    ///
    /// # Errors
    /// [`ExpressionMistake`] with the column in this text.
    pub(in crate::geometry) fn read(text: &str) -> Result<Self, ExpressionMistake> {
        Reader::new(text, &FORMULA).read()
    }

    /// Read a number: as a formula without t, in units of length too.
    ///
    /// # Errors
    /// [`ExpressionMistake`] with the column in this text.
    pub(super) fn read_number(text: &str) -> Result<Self, ExpressionMistake> {
        Reader::new(text, &NUMBER).read()
    }
}

impl<'a> Reader<'a> {
    fn new(text: &'a str, sort: &'static Sort) -> Self {
        let priorities = PrattParser::new()
            .op(Op::infix(Rule::plus, Assoc::Left) | Op::infix(Rule::minus, Assoc::Left))
            .op(Op::infix(Rule::times, Assoc::Left)
                | Op::infix(Rule::over, Assoc::Left)
                | Op::postfix(Rule::unit))
            .op(Op::prefix(Rule::negative) | Op::prefix(Rule::positive))
            .op(Op::infix(Rule::power, Assoc::Right));
        Self {
            text,
            priorities,
            sort,
        }
    }

    fn read(&self) -> Result<Expression, ExpressionMistake> {
        self.check_size()?;
        let pairs = Grammar::parse(Rule::formula, self.text).map_err(|error| {
            let byte = match error.location {
                InputLocation::Pos(byte) | InputLocation::Span((byte, _)) => byte,
            };
            let (before, after) = self.text.split_at_checked(byte).unwrap_or((self.text, ""));
            let found = after.chars().next().map(String::from);
            let expected = self.expected(&error.variant, before);
            self.mistake(byte, ExpressionError::Syntax { found, expected })
        })?;
        let mut expressions = pairs.filter(|pair| pair.as_rule() == Rule::expression);
        match expressions.next() {
            Some(expression) => self.tree(expression.into_inner()),
            None => Ok(Expression::Number(0.0)),
        }
    }

    fn check_size(&self) -> Result<(), ExpressionMistake> {
        let mut depth = 0_usize;
        for (index, (byte, character)) in self.text.char_indices().enumerate() {
            depth = match character {
                '(' => depth + 1,
                ')' => depth.saturating_sub(1),
                _ => depth,
            };
            if depth > MOST_NESTED || index == MOST_CHARACTERS {
                return Err(self.mistake(byte, ExpressionError::TooLong));
            }
        }
        Ok(())
    }

    /// Make a tree of an expression's parts.
    fn tree(&self, parts: Pairs<'_, Rule>) -> Result<Expression, ExpressionMistake> {
        let mut reading = self
            .priorities
            .map_primary(|part| self.operand(part))
            .map_prefix(|sign, inner| match sign.as_rule() {
                Rule::negative => Ok(Expression::Negative(Box::new(inner?))),
                _ => inner,
            })
            .map_postfix(|inner, unit| self.in_unit(inner?, &unit))
            .map_infix(|left, sign, right| {
                let operator = match sign.as_rule() {
                    Rule::plus => Operator::Plus,
                    Rule::minus => Operator::Minus,
                    Rule::times => Operator::Times,
                    Rule::over => Operator::Over,
                    _ => Operator::Power,
                };
                let operands = Box::new([left?, right?]);
                Ok(Expression::Combined(operator, self.column(&sign), operands))
            });
        reading.parse(parts)
    }

    fn operand(&self, part: Pair<'_, Rule>) -> Result<Expression, ExpressionMistake> {
        let word = part.as_str();
        match part.as_rule() {
            Rule::number => {
                let number = word.parse().ok().filter(|it: &f64| it.is_finite());
                let text = word.to_owned();
                let reason = NoNumber::TooLarge;
                let refused = || self.refused(&part, ExpressionError::NotANumber { text, reason });
                number.map(Expression::Number).ok_or_else(refused)
            }
            Rule::name if word == PARAMETER && self.sort.is_formula => Ok(Expression::Parameter),
            Rule::name => {
                let known = NUMBERS.iter().find(|(name, _)| *name == word);
                let (_, number) =
                    known.ok_or_else(|| self.refused(&part, self.unknown_name(word)))?;
                Ok(Expression::Number(*number))
            }
            Rule::call => self.call(part),
            _ => self.tree(part.into_inner()),
        }
    }

    fn call(&self, part: Pair<'_, Rule>) -> Result<Expression, ExpressionMistake> {
        let mut parts = part.clone().into_inner();
        let name = parts.next().map_or("", |name| name.as_str());
        let function = Function::find(name);
        let function = function.ok_or_else(|| self.refused(&part, self.unknown_name(name)))?;
        let arguments = parts.map(|argument| self.tree(argument.into_inner()));
        let arguments = arguments.collect::<Result<Vec<Expression>, _>>()?;
        if arguments.len() != function.arguments() {
            let error = ExpressionError::ArgumentCount {
                name: function.name,
                needed: match function.arguments() {
                    1 => "one argument",
                    _ => "two arguments, with a comma between them",
                },
                found: arguments.len(),
            };
            return Err(self.refused(&part, error));
        }
        Ok(Expression::Call(function, self.column(&part), arguments))
    }

    fn in_unit(
        &self,
        inner: Expression,
        part: &Pair<'_, Rule>,
    ) -> Result<Expression, ExpressionMistake> {
        let known = Unit::written(part.as_str())
            .filter(|unit| !(self.sort.is_formula && matches!(unit, Unit::Length(_))));
        let unit = known.ok_or_else(|| {
            let error = ExpressionError::UnknownUnit {
                name: part.as_str().to_owned(),
                units: self.sort.units,
            };
            self.refused(part, error)
        })?;
        Ok(Expression::InUnit(unit, self.column(part), Box::new(inner)))
    }

    fn unknown_name(&self, name: &str) -> ExpressionError {
        ExpressionError::UnknownName {
            name: name.to_owned(),
            known: self.sort.names,
        }
    }

    /// Say how an expression could go on after its beginning.
    fn expected(&self, variant: &ErrorVariant<Rule>, before: &str) -> &'static str {
        let ErrorVariant::ParsingError { positives, .. } = variant else {
            return "an expression";
        };
        let operator = |rule: &Rule| matches!(rule, Rule::plus | Rule::times | Rule::power);
        let open = before.matches('(').count() > before.matches(')').count();
        match (positives.iter().any(operator), open) {
            (true, true) => "an operator or a closing parenthesis",
            (true, false) => "an operator or the end",
            (false, _) => self.sort.operand,
        }
    }

    fn column(&self, part: &Pair<'_, Rule>) -> usize {
        let before = self.text.get(..part.as_span().start());
        before.map_or(0, |before| before.chars().count()) + 1
    }

    fn refused(&self, part: &Pair<'_, Rule>, error: ExpressionError) -> ExpressionMistake {
        self.mistake(part.as_span().start(), error)
    }

    fn mistake(&self, byte: usize, error: ExpressionError) -> ExpressionMistake {
        ExpressionMistake::at(self.text, byte, error)
    }
}

/// Whether a name that means nothing yet may become one that does.
pub(super) fn begins_name(name: &str) -> bool {
    let names = NUMBERS.iter().map(|(name, _)| *name);
    let mut names = names.chain(function_names());
    names.any(|known| known.starts_with(name))
}
