//! Compiles expressions while reading them: operands come before the operator, so that a stack suffices for evaluation.
//! (book: program/reading)

use pathbuild_diagnostic::messages::gcode as say;

use super::block::{Binary, Code, Function, Op, Span};
use super::line::{Line, UnreadableLine};
use super::number;
use crate::dialect::{Grammar, Operators};

/// Maximum nesting depth of brackets, functions and `#`. (LinuxCNC's own limit is well below 50.)
const MAX_NESTING: u8 = 40;

const FUNCTIONS: [(&[u8], Function); 12] = [
    (b"ABS", Function::Abs),
    (b"ACOS", Function::Acos),
    (b"ASIN", Function::Asin),
    (b"COS", Function::Cos),
    (b"EXP", Function::Exp),
    (b"FIX", Function::Fix),
    (b"FUP", Function::Fup),
    (b"LN", Function::Ln),
    (b"ROUND", Function::Round),
    (b"SIN", Function::Sin),
    (b"SQRT", Function::Sqrt),
    (b"TAN", Function::Tan),
];

const WORD_OPERATORS: [(&[u8], Binary); 10] = [
    (b"MOD", Binary::Modulo),
    (b"AND", Binary::And),
    (b"OR", Binary::Or),
    (b"XOR", Binary::Xor),
    (b"EQ", Binary::Equal),
    (b"NE", Binary::NotEqual),
    (b"LT", Binary::Less),
    (b"LE", Binary::LessOrEqual),
    (b"GT", Binary::Greater),
    (b"GE", Binary::GreaterOrEqual),
];

/// The operators and brackets allowed in an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Syntax {
    /// Expressions of a dialect.
    Dialect(Grammar),
    /// Correction formulas: `+ - * /`, unary minus, `( )` and `[ ]`, `#n`. (book: language/probes)
    Formula,
}

impl Syntax {
    fn has_names(self) -> bool {
        matches!(self, Self::Dialect(Grammar { has_names: true, .. }))
    }

    fn has_signs(self) -> bool {
        matches!(self, Self::Formula | Self::Dialect(Grammar { has_signs: true, .. }))
    }

    /// Returns the precedence of an operator; `None` if the operator does not exist in this syntax.
    fn level(self, operator: Binary) -> Option<u8> {
        use Binary::{And, Divide, Minus, Modulo, Or, Plus, Power, Times, Xor};
        let is_nist = matches!(self, Self::Dialect(Grammar { operators: Operators::Nist, .. }));
        match operator {
            Power if self == Self::Formula => None,
            Power => Some(5),
            Times | Divide => Some(4),
            Modulo if self != Self::Formula => Some(4),
            Plus | Minus => Some(3),
            And | Or | Xor if is_nist => Some(3),
            _ if is_nist || self == Self::Formula => None,
            And | Or | Xor => Some(1),
            _ => Some(2),
        }
    }

    fn closing(self, opening: u8) -> Option<u8> {
        match opening {
            b'[' => Some(b']'),
            b'(' if self == Self::Formula => Some(b')'),
            _ => None,
        }
    }
}

impl Line<'_> {
    /// Compiles a value: a number, a parameter, a function or a bracketed expression.
    pub(super) fn compile_value(&mut self, syntax: Syntax) -> Result<Code, UnreadableLine> {
        let first = self.out.code.len();
        self.value(syntax, 0)?;
        Ok(self.code_since(first))
    }

    /// Compiles operators and operands up to a closing bracket, which is not consumed.
    pub(super) fn compile_expression(&mut self, syntax: Syntax) -> Result<Code, UnreadableLine> {
        let first = self.out.code.len();
        self.expression(syntax, 0, 0)?;
        Ok(self.code_since(first))
    }

    fn code_since(&self, first: usize) -> Code {
        let span = Span::new(first, self.out.code.len());
        Code { first: span.start, end: span.end }
    }

    fn expression(&mut self, syntax: Syntax, loosest: u8, depth: u8) -> Result<(), UnreadableLine> {
        self.value(syntax, depth)?;
        while let Some((operator, level, length)) = self.operator(syntax) {
            if level < loosest {
                break;
            }
            self.at += length;
            self.expression(syntax, level + 1, depth)?;
            self.out.code.push(Op::Binary(operator));
        }
        Ok(())
    }

    fn operator(&mut self, syntax: Syntax) -> Option<(Binary, u8, usize)> {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let (operator, length) = match rest.first()? {
            b'*' if rest.get(1) == Some(&b'*') => (Binary::Power, 2),
            b'*' => (Binary::Times, 1),
            b'/' => (Binary::Divide, 1),
            b'+' => (Binary::Plus, 1),
            b'-' => (Binary::Minus, 1),
            letter if letter.is_ascii_alphabetic() => {
                let (word, operator) = WORD_OPERATORS.iter().find(|(word, _)| begins_with(rest, word))?;
                (*operator, word.len())
            }
            _ => return None,
        };
        Some((operator, syntax.level(operator)?, length))
    }

    fn value(&mut self, syntax: Syntax, depth: u8) -> Result<(), UnreadableLine> {
        self.skip_blanks();
        if depth > MAX_NESTING {
            return Err(self.fault(&say::NESTED_TOO_DEEPLY, self.current_span(), |d| {
                d.with("most", u64::from(MAX_NESTING))
            }));
        }
        match self.peek() {
            Some(sign @ (b'+' | b'-')) if syntax.has_signs() && !self.number_follows_sign() => {
                self.at += 1;
                self.value(syntax, depth + 1)?;
                if sign == b'-' {
                    self.out.code.push(Op::Function(Function::Negate));
                }
                Ok(())
            }
            Some(byte) if number::begins(byte) => {
                let number = self.number()?;
                self.out.code.push(Op::Number(number.value));
                Ok(())
            }
            Some(b'#') => self.parameter(syntax, depth),
            Some(byte) if syntax.closing(byte).is_some() => self.bracketed(syntax, depth),
            Some(byte) if byte.is_ascii_alphabetic() && syntax != Syntax::Formula => {
                self.function(syntax, depth)
            }
            _ => Err(self.fault(&say::VALUE_EXPECTED, self.current_span(), |d| d)),
        }
    }

    fn number_follows_sign(&self) -> bool {
        let after = self.bytes[self.at + 1..].iter().find(|byte| !matches!(byte, b' ' | b'\t'));
        after.is_some_and(|byte| byte.is_ascii_digit() || *byte == b'.')
    }

    fn bracketed(&mut self, syntax: Syntax, depth: u8) -> Result<(), UnreadableLine> {
        let Some(closing) = self.peek().and_then(|opening| syntax.closing(opening)) else {
            return Err(self.bracket_expected(b'['));
        };
        self.at += 1;
        self.expression(syntax, 0, depth + 1)?;
        self.closing_bracket(closing)
    }

    /// Consumes the bracket that ends an expression.
    pub(super) fn closing_bracket(&mut self, closing: u8) -> Result<(), UnreadableLine> {
        self.skip_blanks();
        if self.peek() == Some(closing) {
            self.at += 1;
            return Ok(());
        }
        Err(self.fault(&say::OPERATOR_EXPECTED, self.current_span(), |d| {
            d.with("bracket", char::from(closing)).quoting("operators", "+ - * / ** MOD AND OR XOR")
        }))
    }

    fn bracket_expected(&mut self, bracket: u8) -> UnreadableLine {
        self.fault(&say::BRACKET_EXPECTED, self.current_span(), |d| d.with("bracket", char::from(bracket)))
    }

    fn parameter(&mut self, syntax: Syntax, depth: u8) -> Result<(), UnreadableLine> {
        self.at += 1;
        self.skip_blanks();
        if syntax.has_names() && self.peek() == Some(b'<') {
            let name = self.name()?;
            self.out.code.push(Op::Named(name));
        } else {
            self.value(syntax, depth + 1)?;
            self.out.code.push(Op::Parameter);
        }
        Ok(())
    }

    /// Reads `<name>` and returns the range of the name.
    pub(super) fn name(&mut self) -> Result<Span, UnreadableLine> {
        let start = self.at + 1;
        let Some(length) = self.bytes[start..].iter().position(|byte| *byte == b'>') else {
            return Err(self.bracket_expected(b'>'));
        };
        self.at = start + length + 1;
        Ok(Span::new(start, start + length))
    }

    fn function(&mut self, syntax: Syntax, depth: u8) -> Result<(), UnreadableLine> {
        let rest = &self.bytes[self.at..];
        if begins_with(rest, b"ATAN") {
            return self.atan(syntax, depth);
        }
        if syntax.has_names() && begins_with(rest, b"EXISTS") {
            return self.exists();
        }
        let Some((spelling, function)) = FUNCTIONS.iter().find(|(spelling, _)| begins_with(rest, spelling))
        else {
            return Err(self.fault(&say::VALUE_EXPECTED, self.current_span(), |d| d));
        };
        self.at += spelling.len();
        self.skip_blanks();
        self.bracketed(syntax, depth)?;
        self.out.code.push(Op::Function(*function));
        Ok(())
    }

    fn atan(&mut self, syntax: Syntax, depth: u8) -> Result<(), UnreadableLine> {
        self.at += b"ATAN".len();
        self.skip_blanks();
        self.bracketed(syntax, depth)?;
        self.skip_blanks();
        if self.peek() != Some(b'/') {
            return Err(self.bracket_expected(b'/'));
        }
        self.at += 1;
        self.skip_blanks();
        self.bracketed(syntax, depth)?;
        self.out.code.push(Op::Atan);
        Ok(())
    }

    fn exists(&mut self) -> Result<(), UnreadableLine> {
        self.at += b"EXISTS".len();
        for expected in *b"[#<" {
            self.skip_blanks();
            if self.peek() != Some(expected) {
                return Err(self.bracket_expected(expected));
            }
            self.at += usize::from(expected != b'<');
        }
        let name = self.name()?;
        self.out.code.push(Op::Exists(name));
        self.closing_bracket(b']')
    }
}

fn begins_with(bytes: &[u8], spelling: &[u8]) -> bool {
    bytes.get(..spelling.len()).is_some_and(|start| start.eq_ignore_ascii_case(spelling))
}
