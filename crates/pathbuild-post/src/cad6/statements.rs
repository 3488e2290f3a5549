//! Statements that can contain other statements: assignments, conditions, comparisons.

use pathbuild_diagnostic::Text;
use pathbuild_diagnostic::messages::posts;

use super::evaluate::Evaluator;
use super::fault::{Evaluated, Fault};

/// Kind of a statement, identified by the character after its brace. Any other character starts a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StatementKind {
    Assignment,
    Condition,
    Comparison,
    NonExistence,
    Text,
    Remark,
    VariableName,
}

/// A statement that is not a number.
#[derive(Debug)]
pub(super) struct StatementForm {
    pub(super) sign: char,
    pub(super) kind: StatementKind,
    /// Notation, for the book.
    pub(super) form: &'static str,
    /// Result, for the book.
    pub(super) about: Text,
}

/// All statements that are not numbers.
pub(super) static STATEMENTS: &[StatementForm] = &[
    StatementForm {
        sign: '=',
        kind: StatementKind::Assignment,
        form: "{=Name {…}}",
        about: Text {
            en: "gives a variable the result of a statement; later calls see it",
            de: "gibt einer Variablen das Ergebnis einer Anweisung; spätere Aufrufe sehen es",
        },
    },
    StatementForm {
        sign: '?',
        kind: StatementKind::Condition,
        form: "{?Term {…}{…}}",
        about: Text {
            en: "the first statement if the term is not 0, else the second, which may be missing",
            de: "die erste Anweisung, wenn der Term nicht 0 ist, sonst die zweite, die fehlen darf",
        },
    },
    StatementForm {
        sign: '"',
        kind: StatementKind::Comparison,
        form: "{\"{…}{…} {…}{…}}",
        about: Text {
            en: "the third statement if the first two give the same text, else the fourth, which may be missing",
            de: "die dritte Anweisung, wenn die ersten zwei denselben Text ergeben, sonst die vierte, die fehlen darf",
        },
    },
    StatementForm {
        sign: '!',
        kind: StatementKind::NonExistence,
        form: "{!Name {…}{…}}",
        about: Text {
            en: "the first statement if the variable has no value, else the second, which may be missing",
            de: "die erste Anweisung, wenn die Variable keinen Wert hat, sonst die zweite, die fehlen darf",
        },
    },
    StatementForm {
        sign: '$',
        kind: StatementKind::Text,
        form: "{$…}",
        about: Text { en: "the text, with statements in it", de: "der Text, mit Anweisungen darin" },
    },
    StatementForm {
        sign: '*',
        kind: StatementKind::Remark,
        form: "{*…}",
        about: Text { en: "nothing: a comment", de: "nichts: ein Kommentar" },
    },
    StatementForm {
        sign: '§',
        kind: StatementKind::VariableName,
        form: "{§…}",
        about: Text {
            en: "refused: its meaning is not known",
            de: "abgelehnt: Die Bedeutung ist nicht bekannt",
        },
    },
];

impl Evaluator<'_> {
    pub(super) fn assignment(&mut self) -> Evaluated<()> {
        let name = self.name()?;
        self.blanks();
        let text = self.result()?;
        self.surroundings.variables.assign(name, &text);
        Ok(())
    }

    pub(super) fn non_existence(&mut self) -> Evaluated<()> {
        let name = self.name()?;
        let is_missing = self.surroundings.variables.get(name).is_none();
        self.branches(is_missing)
    }

    pub(super) fn conditional(&mut self) -> Evaluated<()> {
        let length = self.rest().find('{').ok_or_else(|| self.fault(&posts::BRANCH_EXPECTED, 0))?;
        let value = self.term(self.at..self.at + length)?;
        self.at += length;
        self.branches(value != 0.0)
    }

    pub(super) fn comparison(&mut self) -> Evaluated<()> {
        self.blanks();
        let first = self.result()?;
        self.blanks();
        let second = self.result()?;
        let variables = &self.surroundings.variables;
        let is_same = variables.plain(&first) == variables.plain(&second);
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

    /// Evaluates the first or the second branch. The second branch is optional; the other branch has no effect at all.
    pub(super) fn branches(&mut self, takes_first: bool) -> Evaluated<()> {
        self.blanks();
        if !self.rest().starts_with('{') {
            return Err(self.fault(&posts::BRANCH_EXPECTED, 0));
        }
        self.branch(takes_first)?;
        self.blanks();
        if self.rest().starts_with('{') {
            self.branch(!takes_first)?;
        }
        Ok(())
    }

    pub(super) fn branch(&mut self, is_taken: bool) -> Evaluated<()> {
        if is_taken {
            return self.statement();
        }
        self.at += 1;
        self.at = self.closing_brace(self.at - 1)? + 1;
        Ok(())
    }

    /// Position of the brace that closes the open statement.
    pub(super) fn closing_brace(&self, start: usize) -> Evaluated<usize> {
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
