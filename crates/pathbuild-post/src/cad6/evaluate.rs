//! The second phase of a call: replaces every statement by its result. (book: reference/post-definitions)

use std::ops::Range;

use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Message, Text};

use super::expand::{Expanded, is_name};
use super::numbers::{CForm, Form};
use super::term::{Evaluated, Fault, evaluate};
use super::variables::{UNDEFINED_MARK, Variables, char_of, is_mark};
use crate::PostFiles;

/// Maximum nesting depth of statements within statements.
const MAX_DEPTH: usize = 64;

pub(super) struct Environment<'a> {
    pub(super) variables: &'a mut Variables,
    pub(super) decimals: usize,
    /// Access to the files that the text may insert.
    pub(super) files: &'a dyn PostFiles,
}

#[derive(Debug, Default)]
pub(super) struct ResultLine {
    pub(super) text: String,
    /// Whether the line contained a statement or a variable. Such a line is dropped if it is empty.
    pub(super) has_statement: bool,
    /// Whether part of the line comes from a file.
    pub(super) is_inserted: bool,
    /// Offset in bytes at which the line begins in the expanded text.
    pub(super) begins: usize,
    /// Line of the definition's file that produced this line, counted from 1; 0 if unknown.
    pub(super) origin: u32,
}

#[derive(Debug)]
pub(super) struct EvaluatedText {
    pub(super) lines: Vec<ResultLine>,
    /// Warnings about terms, each with its offset in the expanded text.
    pub(super) doubts: Vec<(usize, &'static Message)>,
}

/// Evaluates the statements of an expanded text.
pub(super) fn run(text: &Expanded, environment: Environment<'_>) -> Evaluated<EvaluatedText> {
    let mut evaluator = Evaluator {
        text: &text.text,
        expanded: text,
        at: 0,
        depth: 0,
        lines: vec![ResultLine::default()],
        doubts: Vec::new(),
        environment,
    };
    evaluator.text(false)?;
    Ok(EvaluatedText { lines: evaluator.lines, doubts: evaluator.doubts })
}

/// Evaluator of an expanded text, with the position reached and the lines produced so far.
pub(super) struct Evaluator<'a> {
    pub(super) text: &'a str,
    expanded: &'a Expanded,
    pub(super) at: usize,
    depth: usize,
    pub(super) lines: Vec<ResultLine>,
    doubts: Vec<(usize, &'static Message)>,
    pub(super) environment: Environment<'a>,
}

impl<'a> Evaluator<'a> {
    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    pub(super) fn fault(&self, message: &'static Message, length: usize) -> Box<Fault> {
        Fault::new(message, self.at..(self.at + length).min(self.text.len()))
    }

    /// Copies literal text and evaluates the statements in it, up to the end of the text or, if `is_inside`, the closing brace of the
    /// enclosing statement.
    fn text(&mut self, is_inside: bool) -> Evaluated<()> {
        while let Some(c) = self.rest().chars().next() {
            match c {
                '{' => self.statement()?,
                '}' if is_inside => return Ok(()),
                '}' => return Err(self.fault(&posts::LONE_BRACE, 1)),
                '\\' => self.escape()?,
                UNDEFINED_MARK => return Err(self.undefined(self.at)),
                _ => {
                    self.at += c.len_utf8();
                    self.push(c);
                }
            }
        }
        if is_inside { Err(self.fault(&posts::OPEN_BRACE, 0)) } else { Ok(()) }
    }

    fn push(&mut self, c: char) {
        let (has_statement, begins) = (self.depth > 0, self.at);
        let line = self.line();
        match c {
            _ if is_mark(c) => line.has_statement = true,
            '\n' => self.lines.push(ResultLine { has_statement, begins, ..ResultLine::default() }),
            _ => line.text.push(c),
        }
    }

    fn line(&mut self) -> &mut ResultLine {
        if self.lines.is_empty() {
            self.lines.push(ResultLine::default());
        }
        self.lines.last_mut().expect("one was pushed if there was none")
    }

    fn undefined(&self, at: usize) -> Box<Fault> {
        let name = self.expanded.undefined_at(at);
        Fault::new(&posts::VARIABLE_UNDEFINED, at..at + 1).quoting("name", name)
    }

    fn escape(&mut self) -> Evaluated<()> {
        let rest = self.rest();
        if let Some(after) = rest.strip_prefix(super::expand::INSERTION) {
            return self.insertion(after);
        }
        if let Some(byte) = rest.strip_prefix(r"\\\~").and_then(hex_byte) {
            self.at += 6;
            self.push(char_of(byte));
            return Ok(());
        }
        if rest.starts_with(r"\\\~") {
            return Err(self.fault(&posts::BYTE_EXPECTED, 4));
        }
        let escaped = rest[1..].chars().next().filter(|c| matches!(c, '~' | '{' | '}' | '\\'));
        self.at += 1 + escaped.map_or(0, char::len_utf8);
        self.push(escaped.unwrap_or('\\'));
        Ok(())
    }

    /// Inserts a file. The file's content is copied without being evaluated.
    fn insertion(&mut self, after: &str) -> Evaluated<()> {
        let start = self.at;
        let Some(length) = after.find('*') else { return Err(self.fault(&posts::INSERTION_OPEN, 5)) };
        let name: String = after[..length].chars().filter(|c| !is_mark(*c)).collect();
        let name = self.environment.variables.without_placeholders(&name).into_owned();
        self.at += 5 + length + 1;
        let span = start..self.at;
        if let Some(at) = after[..length].find(UNDEFINED_MARK) {
            return Err(self.undefined(start + 5 + at));
        }
        let content = super::expand::read(&name, self.environment.files).map_err(|reason| {
            Fault::new(&posts::INSERTION_REFUSED, span).quoting("name", name.as_str()).with("reason", reason)
        })?;
        let line = self.line();
        line.is_inserted = true;
        line.text.extend(content.iter().map(|&byte| char_of(byte)));
        Ok(())
    }

    /// Evaluates a statement and adds its result to the output.
    pub(super) fn statement(&mut self) -> Evaluated<()> {
        if self.depth == MAX_DEPTH {
            return Err(self.fault(&posts::TEXT_DEPTH, 1).with("limit", MAX_DEPTH));
        }
        self.depth += 1;
        self.line().has_statement = true;
        let start = self.at;
        self.at += 1;
        self.skip_marks();
        let first = self.rest().chars().next();
        let form = STATEMENTS.iter().find(|form| Some(form.sign) == first);
        self.at += form.map_or(0, |form| form.sign.len_utf8());
        match form {
            Some(form) => (form.run)(self, start)?,
            None => self.number(start)?,
        }
        self.close_statement(start)?;
        self.depth -= 1;
        Ok(())
    }

    fn skip_marks(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start_matches(is_mark).len();
    }

    pub(super) fn skip_blanks(&mut self) {
        let is_blank = |c: char| c.is_whitespace() || is_mark(c);
        self.at += self.rest().len() - self.rest().trim_start_matches(is_blank).len();
    }

    fn close_statement(&mut self, start: usize) -> Evaluated<()> {
        self.skip_blanks();
        if self.rest().starts_with('}') {
            self.at += 1;
            return Ok(());
        }
        if self.rest().is_empty() {
            return Err(Fault::new(&posts::OPEN_BRACE, start..start + 1));
        }
        Err(self.fault(&posts::STATEMENT_GOES_ON, 1))
    }

    pub(super) fn name(&mut self) -> Evaluated<&'a str> {
        let rest = self.rest();
        let length = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
        if !is_name(&rest[..length]) {
            return Err(self.fault(&posts::NAME_EXPECTED, rest.chars().next().map_or(0, char::len_utf8)));
        }
        self.at += length;
        Ok(&rest[..length])
    }

    fn number(&mut self, start: usize) -> Evaluated<()> {
        let form = self.form();
        let length = self.rest().find(['}', '{']).unwrap_or(self.rest().len());
        if let (Form::C(form), Some(text)) = (form, self.single_placeholder(length)) {
            return self.text_in_form(form, text, length);
        }
        let value = self.term(self.at..self.at + length)?;
        self.at += length;
        let text = form.write(value, self.environment.decimals);
        let text = text.ok_or_else(|| Fault::new(&posts::TERM_NOT_WHOLE, start..self.at))?;
        self.line().text.push_str(&text);
        Ok(())
    }

    /// Returns the text placeholder in the next `length` bytes of a statement, if these contain nothing else.
    fn single_placeholder(&self, length: usize) -> Option<char> {
        let mut inside = self.rest()[..length].chars().filter(|c| !is_mark(*c) && *c != ' ');
        let first = inside.next().filter(|c| self.environment.variables.text(*c).is_some());
        first.filter(|_| inside.next().is_none())
    }

    /// Writes a text padded with blanks, as in `{s ~PrgName~}` and `{-20s ~PrgName~}`.
    fn text_in_form(&mut self, form: CForm, text: char, length: usize) -> Evaluated<()> {
        let width = self.environment.variables.text(text).map_or(0, |text| text.chars().count());
        let Some([before, behind]) = form.blanks(width) else {
            // A C format for numbers, such as `f`, requires that the text is a number.
            let found = self.environment.variables.text(text).unwrap_or("").to_owned();
            let is_number = found.trim().parse::<f64>().is_ok_and(f64::is_finite);
            if !is_number {
                return Err(self.fault(&posts::TERM_IS_TEXT, length).quoting("found", found));
            }
            let value = self.term(self.at..self.at + length)?;
            self.at += length;
            let number = Form::C(form).write(value, self.environment.decimals);
            let number = number.ok_or_else(|| self.fault(&posts::TERM_NOT_WHOLE, 0))?;
            self.line().text.push_str(&number);
            return Ok(());
        };
        self.at += length;
        let line = self.line();
        line.text.push_str(&" ".repeat(before));
        line.text.push(text);
        line.text.push_str(&" ".repeat(behind));
        Ok(())
    }

    /// Reads the number format of a statement. A C format must be followed by a blank.
    fn form(&mut self) -> Form {
        let rest = self.rest();
        if let Some(form) = rest.chars().next().and_then(Form::of) {
            self.at += 1;
            return form;
        }
        // Forms contain no braces, so stop at the first one.
        let end = rest.find([' ', '\t', '}', '{']);
        let blank = end.filter(|end| !rest[*end..].starts_with(['}', '{']));
        let c_form = blank.and_then(|blank| Some((blank, rest[..blank].parse::<CForm>().ok()?)));
        match c_form {
            Some((blank, form)) => {
                self.at += blank;
                Form::C(form)
            }
            None => Form::Shortest,
        }
    }

    pub(super) fn term(&mut self, span: Range<usize>) -> Evaluated<f64> {
        let text = &self.text[span.clone()];
        if let Some(at) = text.find(UNDEFINED_MARK) {
            return Err(self.undefined(span.start + at));
        }
        // The text that a placeholder stands for is never evaluated as a term, but it may consist of a number.
        let plain = self.environment.variables.without_placeholders(text);
        let is_number = plain.trim_matches(|c: char| c == ' ' || is_mark(c)).parse::<f64>().is_ok();
        let found = text.chars().find_map(|c| self.environment.variables.text(c)).filter(|_| !is_number);
        if let Some(found) = found {
            return Err(Fault::new(&posts::TERM_IS_TEXT, span).quoting("found", found));
        }
        let term =
            evaluate(if is_number { &plain } else { text }).map_err(|fault| fault.shifted(span.start))?;
        self.doubts.extend(term.doubts.into_iter().map(|doubt| (span.start, doubt)));
        Ok(term.value)
    }
}

fn hex_byte(text: &str) -> Option<u8> {
    let digits = text.get(..2).filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()))?;
    u8::from_str_radix(digits, 16).ok()
}

/// A statement that is not a number, such as an assignment, a condition or a comparison. The character after its brace identifies it.
pub(super) struct Statement {
    sign: char,
    /// Evaluates the statement. The second argument is the offset of the opening brace.
    run: fn(&mut Evaluator<'_>, usize) -> Evaluated<()>,
    /// Notation of the statement, for the book.
    pub(super) form: &'static str,
    /// Description of the result, for the book.
    pub(super) about: Text,
}

macro_rules! statements {
    ($($sign:literal $form:literal $run:expr, $en:literal, $de:literal;)*) => {
        /// All statements that are not numbers.
        pub(super) static STATEMENTS: &[Statement] = &[$(Statement {
            sign: $sign,
            run: $run,
            form: $form,
            about: Text { en: $en, de: $de },
        },)*];
    };
}

statements! {
    '=' "{=Name {…}}" |evaluator, _| evaluator.assignment(),
        "gives a variable the result of a statement; later calls see it",
        "weist einer Variablen das Ergebnis einer Anweisung zu; spätere Aufrufe sehen es";
    '?' "{?Term {…}{…}}" |evaluator, _| evaluator.conditional(),
        "the first statement if the term is not 0, else the second, which may be missing",
        "die erste Anweisung, wenn der Term nicht 0 ist, sonst die zweite, die fehlen darf";
    '"' "{\"{…}{…} {…}{…}}" |evaluator, _| evaluator.comparison(),
        "the third statement if the first two give the same text, else the fourth, which may be missing",
        "die dritte Anweisung, wenn die ersten zwei denselben Text ergeben, sonst die vierte, die fehlen darf";
    '!' "{!Name {…}{…}}" |evaluator, _| evaluator.non_existence(),
        "the first statement if the variable has no value, else the second, which may be missing",
        "die erste Anweisung, wenn die Variable keinen Wert hat, sonst die zweite, die fehlen darf";
    '$' "{$…}" |evaluator, _| evaluator.text(true), "the text, with statements in it", "der Text, mit Anweisungen darin";
    '*' "{*…}" |evaluator, start| evaluator.remark(start), "nothing: a comment", "nichts: ein Kommentar";
    '§' "{§…}" |evaluator, start| Err(Fault::new(&posts::STATEMENT_UNKNOWN, start..evaluator.at)),
        "refused: its meaning is not known", "abgelehnt: Die Bedeutung ist nicht bekannt";
}

impl Evaluator<'_> {
    fn remark(&mut self, start: usize) -> Evaluated<()> {
        self.at = self.closing_brace(start)?;
        Ok(())
    }

    pub(super) fn assignment(&mut self) -> Evaluated<()> {
        let name = self.name()?;
        self.skip_blanks();
        let text = self.result()?;
        self.environment.variables.assign(name, &text);
        Ok(())
    }

    fn non_existence(&mut self) -> Evaluated<()> {
        let name = self.name()?;
        let is_missing = self.environment.variables.get(name).is_none();
        self.branches(is_missing)
    }

    fn conditional(&mut self) -> Evaluated<()> {
        let length = self.rest().find('{').ok_or_else(|| self.fault(&posts::BRANCH_EXPECTED, 0))?;
        let value = self.term(self.at..self.at + length)?;
        self.at += length;
        self.branches(value != 0.0)
    }

    fn comparison(&mut self) -> Evaluated<()> {
        self.skip_blanks();
        let first = self.result()?;
        self.skip_blanks();
        let second = self.result()?;
        let variables = &self.environment.variables;
        let is_same = variables.without_placeholders(&first) == variables.without_placeholders(&second);
        self.branches(is_same)
    }

    /// Evaluates the next statement and returns its result without adding it to the output.
    pub(super) fn result(&mut self) -> Evaluated<String> {
        if !self.rest().starts_with('{') {
            return Err(self.fault(&posts::BRANCH_EXPECTED, 0));
        }
        let lines = std::mem::take(&mut self.lines);
        self.statement()?;
        let result = std::mem::replace(&mut self.lines, lines);
        Ok(result.into_iter().map(|line| line.text).collect::<Vec<_>>().join("\n"))
    }

    /// Evaluates the first or the second branch of a condition. The second branch is optional. The branch that is not taken is skipped, so errors in
    /// it are not reported.
    fn branches(&mut self, takes_first: bool) -> Evaluated<()> {
        self.skip_blanks();
        if !self.rest().starts_with('{') {
            return Err(self.fault(&posts::BRANCH_EXPECTED, 0));
        }
        self.branch(takes_first)?;
        self.skip_blanks();
        if self.rest().starts_with('{') {
            self.branch(!takes_first)?;
        }
        Ok(())
    }

    fn branch(&mut self, is_taken: bool) -> Evaluated<()> {
        if is_taken {
            return self.statement();
        }
        self.at += 1;
        self.at = self.closing_brace(self.at - 1)? + 1;
        Ok(())
    }

    fn closing_brace(&self, start: usize) -> Evaluated<usize> {
        let mut depth = 0_usize;
        let mut is_escaped = false;
        for (at, c) in self.rest().char_indices() {
            match c {
                _ if is_escaped => is_escaped = false,
                '\\' => is_escaped = true,
                '{' => depth += 1,
                '}' if depth == 0 => return Ok(self.at + at),
                '}' => depth -= 1,
                _ => {}
            }
        }
        Err(Fault::new(&posts::OPEN_BRACE, start..start + 1))
    }
}
