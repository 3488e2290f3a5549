//! Templates: literal text that contains `{$name}` and `{$name(argument, ...)}`.

use super::macros::{Macro, MacroArguments};
use crate::cambam::section::Section;

/// A text with macros, and its position in the file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Template {
    pub(super) section: Section,
    pub(super) pieces: Vec<TemplatePart>,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum TemplatePart {
    /// Text that is copied as it is, possibly with line breaks.
    Text {
        text: Box<str>,
        /// Line of the definition's file where the text begins, counted from 1; 0 for built-in texts and those of the configuration.
        line: u32,
    },
    /// A macro to be expanded.
    Macro {
        what: Macro,
        /// Line of the definition's file, counted from 1; 0 for built-in texts and those of the configuration.
        line: u32,
    },
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct TemplateError {
    /// Line of the definition's file, counted from 1.
    pub(super) line: u32,
    pub(super) fault: Fault,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Fault {
    /// `{$` without a closing `}`.
    Unclosed,
    /// Wrong arguments for a macro.
    Arguments(MacroArguments),
}

impl Template {
    /// Returns the template's text without its macros.
    pub(super) fn literal(&self) -> String {
        let literal = |piece: &TemplatePart| match piece {
            TemplatePart::Text { text, .. } => text.to_string(),
            TemplatePart::Macro { .. } => String::new(),
        };
        self.pieces.iter().map(literal).collect()
    }

    /// Parses a text that begins in `line` of its file. All errors are reported.
    pub(super) fn parse(section: Section, text: &str, line: u32) -> Result<Self, Vec<TemplateError>> {
        let mut parser = Parser { pieces: Vec::new(), errors: Vec::new(), line };
        parser.run(text);
        let Parser { pieces, errors, .. } = parser;
        if errors.is_empty() { Ok(Self { section, pieces }) } else { Err(errors) }
    }

    /// Whether the template can only produce blanks, because it contains neither macros nor characters other than blanks.
    pub(super) fn is_blank(&self) -> bool {
        self.pieces
            .iter()
            .all(|piece| matches!(piece, TemplatePart::Text { text, .. } if text.trim().is_empty()))
    }

    /// Returns the texts in braces without a dollar sign, with their lines. Such a text may be a macro that lacks its `$`, as in `{units}`.
    pub(super) fn texts_in_braces(&self) -> impl Iterator<Item = (&str, u32)> {
        let texts = self.pieces.iter().filter_map(|piece| match piece {
            TemplatePart::Text { text, line } => Some((text, *line)),
            TemplatePart::Macro { .. } => None,
        });
        texts.flat_map(|(text, first)| {
            (first..).zip(text.split('\n')).flat_map(|(line, text)| {
                let names = text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0));
                names.map(move |name| (name, line))
            })
        })
    }

    /// Returns the macros of the template, with their lines in the definition's file.
    pub(super) fn macros(&self) -> impl Iterator<Item = (&Macro, u32)> {
        self.pieces.iter().filter_map(|piece| match piece {
            TemplatePart::Macro { what, line } => Some((what, *line)),
            TemplatePart::Text { .. } => None,
        })
    }
}

struct Parser {
    pieces: Vec<TemplatePart>,
    errors: Vec<TemplateError>,
    line: u32,
}

impl Parser {
    fn run(&mut self, mut text: &str) {
        while let Some((before, call, after)) = next_call(text) {
            self.literal(before);
            match call {
                Some(call) => self.call(call),
                None => self.errors.push(TemplateError { line: self.line, fault: Fault::Unclosed }),
            }
            text = after;
        }
        self.literal(text);
    }

    fn literal(&mut self, text: &str) {
        if text.is_empty() {
            return;
        }
        self.pieces.push(TemplatePart::Text { text: text.into(), line: self.line });
        self.count_lines(text);
    }

    fn call(&mut self, call: &str) {
        let line = self.line;
        match Macro::parse(call) {
            Ok(what) => self.pieces.push(TemplatePart::Macro { what, line }),
            Err(error) => self.errors.push(TemplateError { line, fault: Fault::Arguments(error) }),
        }
        self.count_lines(call);
    }

    fn count_lines(&mut self, text: &str) {
        if self.line == 0 {
            return;
        }
        let lines = text.bytes().filter(|&byte| byte == b'\n').count();
        self.line += u32::try_from(lines).unwrap_or(0);
    }
}

/// Splits a text into the text before the next macro, the macro without its delimiters, and the rest. The macro is `None` if it is not
/// closed.
///
/// CamBam's manual also contains one macro without braces: `$set(z,5.5)`.
fn next_call(text: &str) -> Option<(&str, Option<&str>, &str)> {
    let (start, inner, close) = text.match_indices('$').find_map(|(at, _)| {
        let framed = text[..at].ends_with('{').then(|| (at - 1, at + 1, '}'));
        framed.or_else(|| text[at..].starts_with("$set(").then_some((at, at + 1, ')')))
    })?;
    let before = &text[..start];
    let Some(length) = text[inner..].find(close) else { return Some((before, None, "")) };
    let end = inner + length;
    let call = &text[inner..if close == ')' { end + 1 } else { end }];
    Some((before, Some(call), &text[end + 1..]))
}
