//! Statements that hold other statements: assignments, conditions, comparisons.

use pathbuild_diagnostic::messages::posts;

use super::evaluate::Evaluator;
use super::fault::{Evaluated, Fault};

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

    /// The result of the statement that comes next, which does not go into the text.
    pub(super) fn result(&mut self) -> Evaluated<String> {
        if !self.rest().starts_with('{') {
            return Err(self.fault(&posts::BRANCH_EXPECTED, 0));
        }
        let lines = std::mem::take(&mut self.lines);
        self.statement()?;
        let result = std::mem::replace(&mut self.lines, lines);
        Ok(result.into_iter().map(|line| line.text).collect::<Vec<_>>().join("\n"))
    }

    /// Evaluates the first branch or the second, which may be missing; the other one does nothing at all.
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

    /// The brace that closes the statement that is open.
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
