//! Mathematical terms: numbers, operators and functions. (book: reference/post-definitions)
//!
//! All operators are left-associative. From lowest to highest precedence: `||`, `&&`, comparisons together with the bitwise `&`, `|` and
//! `^`, then `+ -`, `* /`, `^^` (power), signs and `!`. The order of some of these, and all functions, are defined by pathbuild, because
//! the manual does not specify them.

use std::ops::Range;

use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Message, Text};

use super::numbers::bits;
use super::variables::is_mark;

/// Maximum nesting depth of parentheses, signs and arguments of functions.
const MAX_DEPTH: usize = 64;

/// The value of a term.
#[derive(Debug)]
pub(super) struct Term {
    pub(super) value: f64,
    /// Warnings about constructs that are likely mistakes, or that CAD6 itself may not support.
    pub(super) doubts: Vec<&'static Message>,
}

/// Evaluates a text that consists of a single term. The value is always finite.
pub(super) fn evaluate(text: &str) -> Evaluated<Term> {
    let mut parser = Parser { text, at: 0, depth: 0, doubts: Vec::new() };
    let value = parser.binary(0)?;
    parser.skip_blanks();
    if parser.at < text.len() {
        return Err(parser.unexpected());
    }
    if !value.is_finite() {
        return Err(Fault::new(&posts::TERM_NOT_FINITE, 0..text.len()));
    }
    Ok(Term { value, doubts: parser.doubts })
}

/// The operators from lowest to highest precedence. The parser always takes the longest operator that fits, of whatever level.
pub(super) const LEVELS: [&[&str]; 6] =
    [&["||"], &["&&"], &["<=", ">=", "==", "!=", "<", ">", "&", "|", "^"], &["+", "-"], &["*", "/"], &["^^"]];

struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    doubts: Vec<&'static Message>,
}

impl Parser<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches(|c: char| c.is_whitespace() || is_mark(c)).len();
    }

    fn unexpected(&self) -> Box<Fault> {
        let found: String = self.rest().chars().take(1).collect();
        let end = self.at + found.len();
        if found.is_empty() {
            return Fault::new(&posts::TERM_ENDS, self.at..end);
        }
        Fault::new(&posts::TERM_UNEXPECTED, self.at..end).quoting("found", found)
    }

    fn doubt(&mut self, doubt: &'static Message) {
        if !self.doubts.contains(&doubt) {
            self.doubts.push(doubt);
        }
    }

    fn binary(&mut self, level: usize) -> Evaluated<f64> {
        let Some(operators) = LEVELS.get(level) else { return self.unary() };
        let mut value = self.binary(level + 1)?;
        let mut kinds = [false; 2];
        while let Some(operator) = self.operator(operators) {
            let start = self.at - operator.len();
            let right = self.binary(level + 1)?;
            kinds[usize::from(matches!(operator, "&" | "|" | "^"))] = true;
            value = apply(operator, value, right)
                .ok_or_else(|| Fault::new(&posts::TERM_NOT_WHOLE, start..self.at))?;
        }
        if kinds == [true; 2] {
            self.doubt(&posts::TERM_MIXED_BITS);
        }
        Ok(value)
    }

    /// Consumes an operator of this level, if one follows.
    fn operator(&mut self, operators: &'static [&'static str]) -> Option<&'static str> {
        self.skip_blanks();
        let rest = self.rest();
        let longest = LEVELS.iter().copied().flatten().filter(|operator| rest.starts_with(**operator));
        let operator = *longest.max_by_key(|operator| operator.len())?;
        operators.contains(&operator).then(|| {
            self.at += operator.len();
            operator
        })
    }

    fn unary(&mut self) -> Evaluated<f64> {
        self.skip_blanks();
        let sign = self.rest().chars().next().filter(|c| matches!(c, '+' | '-' | '!'));
        let Some(sign) = sign else { return self.operand() };
        self.at += 1;
        if sign != '!' && self.rest().trim_start_matches(is_mark).starts_with(['+', '-']) {
            self.doubt(&posts::TERM_TWO_SIGNS);
        }
        let value = self.nested(Self::unary)?;
        Ok(match sign {
            '-' => -value,
            '!' => truth(value == 0.0),
            _ => value,
        })
    }

    fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Evaluated<T>) -> Evaluated<T> {
        if self.depth == MAX_DEPTH {
            return Err(Fault::new(&posts::TEXT_DEPTH, self.at..self.at).with("limit", MAX_DEPTH));
        }
        self.depth += 1;
        let value = read(self)?;
        self.depth -= 1;
        Ok(value)
    }

    fn operand(&mut self) -> Evaluated<f64> {
        match self.rest().chars().next() {
            Some('(') => self.parenthesis(),
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_ascii_alphabetic() => self.function(),
            _ => Err(self.unexpected()),
        }
    }

    fn parenthesis(&mut self) -> Evaluated<f64> {
        self.at += 1;
        let value = self.nested(|parser| parser.binary(0))?;
        self.expect(')')?;
        Ok(value)
    }

    fn expect(&mut self, expected: char) -> Evaluated<()> {
        self.skip_blanks();
        if !self.rest().starts_with(expected) {
            return Err(self.unexpected());
        }
        self.at += expected.len_utf8();
        Ok(())
    }

    fn number(&mut self) -> Evaluated<f64> {
        let rest = self.rest();
        let length = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let span = self.at..self.at + length;
        let number = &self.text[span.clone()];
        self.at = span.end;
        number.parse().map_err(|_| Fault::new(&posts::TERM_NUMBER, span).quoting("found", number))
    }

    fn function(&mut self) -> Evaluated<f64> {
        let rest = self.rest();
        let length = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        let span = self.at..self.at + length;
        let name = &self.text[span.clone()];
        self.at = span.end;
        self.doubt(&posts::TERM_EXTENSION);
        if name == "pi" {
            return Ok(std::f64::consts::PI);
        }
        let arguments = self.arguments()?;
        call(name, &arguments).map_err(|message| Fault::new(message, span).quoting("name", name))
    }

    fn arguments(&mut self) -> Evaluated<Vec<f64>> {
        self.expect('(')?;
        let mut arguments = vec![self.nested(|parser| parser.binary(0))?];
        loop {
            self.skip_blanks();
            if !self.rest().starts_with(',') {
                break;
            }
            self.at += 1;
            arguments.push(self.nested(|parser| parser.binary(0))?);
        }
        self.expect(')')?;
        Ok(arguments)
    }
}

fn truth(is_true: bool) -> f64 {
    f64::from(u8::from(is_true))
}

/// Applies an operator. Returns `None` for a bitwise operator on a number that is not an integer.
fn apply(operator: &str, a: f64, b: f64) -> Option<f64> {
    Some(match operator {
        "||" => truth(a != 0.0 || b != 0.0),
        "&&" => truth(a != 0.0 && b != 0.0),
        "<=" => truth(a <= b),
        ">=" => truth(a >= b),
        "==" => truth(a == b),
        "!=" => truth(a != b),
        "<" => truth(a < b),
        ">" => truth(a > b),
        "&" => from_bits(bits(a)? & bits(b)?),
        "|" => from_bits(bits(a)? | bits(b)?),
        "^" => from_bits(bits(a)? ^ bits(b)?),
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        "/" => a / b,
        _ => libm::pow(a, b),
    })
}

fn from_bits(bits: i64) -> f64 {
    bits as f64
}

/// The number of arguments that a function takes, and its implementation.
#[derive(Clone, Copy, Debug)]
pub(super) enum Rule {
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
    /// Any number of arguments, but at least one.
    Any(fn(&[f64]) -> f64),
}

#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: &'static str,
    pub(super) rule: Rule,
    /// Description of the result, for the book.
    pub(super) about: Text,
}

macro_rules! functions {
    ($($name:literal $rule:ident $value:expr, $en:literal, $de:literal;)*) => {
        /// All functions, in the order in which they are documented. They are an extension of pathbuild, because it is unknown which
        /// functions CAD6 has. Angles are in degrees.
        pub(super) static FUNCTIONS: &[Function] = &[$(Function {
            name: $name,
            rule: Rule::$rule($value),
            about: Text { en: $en, de: $de },
        },)*];
    };
}

functions! {
    "abs" One f64::abs, "absolute value", "Betrag";
    "sqrt" One f64::sqrt, "square root", "Quadratwurzel";
    "int" One f64::trunc, "without decimals", "ohne Nachkommastellen";
    "round" One f64::round, "nearest whole number, halves away from 0", "nächste ganze Zahl, Hälften von 0 weg";
    "floor" One f64::floor, "next smaller whole number", "nächstkleinere ganze Zahl";
    "ceil" One f64::ceil, "next larger whole number", "nächstgrößere ganze Zahl";
    "sin" One |x| libm::sin(x.to_radians()), "sine", "Sinus";
    "cos" One |x| libm::cos(x.to_radians()), "cosine", "Kosinus";
    "tan" One |x| libm::tan(x.to_radians()), "tangent", "Tangens";
    "asin" One |x| libm::asin(x).to_degrees(), "arc sine", "Arkussinus";
    "acos" One |x| libm::acos(x).to_degrees(), "arc cosine", "Arkuskosinus";
    "atan" One |x| libm::atan(x).to_degrees(), "arc tangent", "Arkustangens";
    "atan2" Two |y, x| libm::atan2(y, x).to_degrees(),
        "angle of the point (second, first)", "Winkel des Punktes (zweites, erstes)";
    "mod" Two |a, b| a - b * (a / b).floor(),
        "remainder, with the sign of the second", "Rest, mit dem Vorzeichen des zweiten";
    "min" Any |all| all.iter().copied().fold(f64::INFINITY, f64::min), "the smallest", "das Kleinste";
    "max" Any |all| all.iter().copied().fold(f64::NEG_INFINITY, f64::max), "the largest", "das Größte";
}

fn call(name: &str, arguments: &[f64]) -> Result<f64, &'static Message> {
    let function = FUNCTIONS.iter().find(|function| function.name == name).ok_or(&posts::TERM_FUNCTION)?;
    match (function.rule, arguments) {
        (Rule::One(value), &[x]) => Ok(value(x)),
        (Rule::Two(value), &[x, y]) => Ok(value(x, y)),
        (Rule::Any(value), [_, ..]) => Ok(value(arguments)),
        _ => Err(&posts::TERM_ARGUMENTS),
    }
}

/// An error before it is known which control text contains it: a diagnostic and the range of the faulty piece of the text.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) span: Range<usize>,
    pub(super) diagnostic: Diagnostic,
}

pub(super) type Evaluated<T> = Result<T, Box<Fault>>;

impl Fault {
    pub(super) fn new(message: &'static Message, span: Range<usize>) -> Box<Self> {
        Box::new(Self { span, diagnostic: Diagnostic::new(message) })
    }

    pub(super) fn with(
        mut self: Box<Self>,
        name: &'static str,
        value: impl Into<pathbuild_diagnostic::Value>,
    ) -> Box<Self> {
        self.diagnostic = self.diagnostic.with(name, value);
        self
    }

    /// Sets an argument of the message to a name or a piece of the text, which is shown as a quotation.
    pub(super) fn quoting(self: Box<Self>, name: &'static str, text: impl AsRef<str>) -> Box<Self> {
        self.with(name, pathbuild_diagnostic::Value::quoted(text))
    }

    /// Converts the range of a fault from offsets in a part, which begins at the offset `by`, to offsets in the whole text.
    pub(super) fn shifted(mut self: Box<Self>, by: usize) -> Box<Self> {
        self.span = self.span.start + by..self.span.end + by;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        evaluate(text).unwrap_or_else(|fault| panic!("{text}: {fault:?}")).value
    }

    #[test]
    fn the_manual_s_examples() {
        let examples = [
            ("2^^8*2", 512.0),
            ("8/2*4", 16.0),
            ("8+2*4", 16.0),
            ("10-2/4", 9.5),
            ("100^^0.5", 10.0),
            ("24&15", 8.0),
            ("16|8", 24.0),
            ("24^31", 7.0),
            ("!12", 0.0),
        ];
        for (text, expected) in examples {
            assert_eq!(value(text), expected, "{text}");
        }
    }

    #[test]
    fn everything_is_left_associative() {
        assert_eq!(value("2^^3^^2"), 64.0);
        assert_eq!(value("10-4-3"), 3.0);
        assert_eq!(value("3>2>1"), 0.0);
    }

    #[test]
    fn operators_bind_in_their_order() {
        assert_eq!(value("1==1||0"), 1.0);
        assert_eq!(value("0&&0||1"), 1.0);
        assert_eq!(value("1||0&&0"), 1.0);
        assert_eq!(value("1+1==2"), 1.0);
        assert_eq!(value("-2^^2"), 4.0);
        assert_eq!(value("!0+1"), 2.0);
        assert_eq!(value("2*(3+4)"), 14.0);
        assert_eq!(value("5<=5&&5>=5&&5!=4&&4<5"), 1.0);
    }

    #[test]
    fn a_negative_value_may_stand_behind_an_operator() {
        assert_eq!(value("5--3"), 8.0);
        assert_eq!(value("5*-3"), -15.0);
        assert!(evaluate("5--3").unwrap().doubts.is_empty());
        assert_eq!(evaluate("--5").unwrap().doubts, [&posts::TERM_TWO_SIGNS]);
    }

    #[test]
    fn bits_and_comparisons_together_are_doubtful() {
        assert_eq!(evaluate("3&1==1").unwrap().doubts, [&posts::TERM_MIXED_BITS]);
        assert!(evaluate("(3&1)==1").unwrap().doubts.is_empty());
    }

    #[test]
    fn functions_are_an_extension() {
        assert_eq!(value("max(1, 2, 3)+sqrt(16)"), 7.0);
        assert_eq!(evaluate("pi").unwrap().doubts, [&posts::TERM_EXTENSION]);
    }

    #[test]
    fn what_is_no_term_is_refused_where_it_goes_wrong() {
        let place = |text: &str| evaluate(text).unwrap_err().span;
        assert_eq!(place("1+"), 2..2);
        assert_eq!(place("1+*2"), 2..3);
        assert_eq!(place("1,5"), 1..2);
        assert_eq!(place("(1"), 2..2);
        assert_eq!(place("1.2.3"), 0..5);
        assert_eq!(place("1/0"), 0..3);
        assert_eq!(place("1.5&1"), 3..5);
        assert_eq!(place("sinus(1)"), 0..5);
        assert_eq!(place("sin(1,2)"), 0..3);
        assert_eq!(place(""), 0..0);
    }

    #[test]
    fn nesting_has_an_end() {
        let nested = |depth: usize| format!("{}1{}", "(".repeat(depth), ")".repeat(depth));
        assert!(evaluate(&nested(64)).is_ok());
        assert!(evaluate(&nested(65)).is_err());
        assert!(evaluate(&"-".repeat(100_000)).is_err());
    }
}
