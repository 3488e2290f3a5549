//! A fast path for correction formulas as written by pathbuild and its predecessor. (book: language/probes)

use super::block::{Formula, Span};
use super::expression::{Binary, Code, Op};
use super::line::Parts;
use super::number;

/// Reads `(=1.000+0.441*[#51-2.000]+...)` at `start` as the formula of the last word and returns the offset after it. Leaves anything else,
/// without
/// changing the parts, to the reader of expressions.
///
/// In a program with probes, nearly all bytes belong to such formulas.
#[inline]
pub(super) fn plain_formula(bytes: &[u8], start: usize, parts: &mut Parts) -> Option<usize> {
    let word = parts.words.len().checked_sub(1)?;
    if bytes.get(start..start + 2) != Some(b"(=") || parts.words[word].span.end as usize != start {
        return None;
    }
    let first = parts.code.len();
    let applied = bytes.get(start + 2) == Some(&b'=');
    let Some(end) = sum(bytes, start + 2 + usize::from(applied), &mut parts.code) else {
        parts.code.truncate(first);
        return None;
    };
    let [code, word, span] =
        [(first, parts.code.len()), (word, word), (start, end)].map(|(a, b)| Span::new(a, b));
    let code = Code { first: code.start, end: code.end };
    parts.formulas.push(Formula { word: word.start, applied, code, span });
    Some(end)
}

/// Reads a height and the terms of the probes, up to and including the closing bracket.
fn sum(bytes: &[u8], start: usize, code: &mut Vec<Op>) -> Option<usize> {
    let (height, mut at) = number::plain(bytes, start)?;
    code.push(Op::Number(height.value));
    loop {
        match bytes.get(at)? {
            b')' => return Some(at + 1),
            b'+' => at = term(bytes, at + 1, code)?,
            _ => return None,
        }
    }
}

/// Reads `0.441*[#51-2.000]`.
fn term(bytes: &[u8], start: usize, code: &mut Vec<Op>) -> Option<usize> {
    let (weight, at) = number::plain(bytes, start)?;
    let at = passed(bytes, at, b"*[#")?;
    let (probe, at) = number::plain(bytes, at)?;
    let at = passed(bytes, at, b"-")?;
    let (height, at) = number::plain(bytes, at)?;
    let at = passed(bytes, at, b"]")?;
    code.extend([
        Op::Number(weight.value),
        Op::Number(probe.value),
        Op::Parameter,
        Op::Number(height.value),
        Op::Binary(Binary::Minus),
        Op::Binary(Binary::Times),
        Op::Binary(Binary::Plus),
    ]);
    Some(at)
}

fn passed(bytes: &[u8], at: usize, signs: &[u8]) -> Option<usize> {
    bytes[at..].starts_with(signs).then_some(at + signs.len())
}
