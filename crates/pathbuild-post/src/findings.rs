//! What is wrong in a definition, and where: bounded, because a file of a megabyte may have a mistake in each of its letters.

use pathbuild_diagnostic::Diagnostic;

/// Findings of one definition that are reported at most. Whoever mends them sees the next ones.
pub(crate) const MOST_FINDINGS: usize = 100;

/// Findings in the order in which they were made.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    found: Vec<Diagnostic>,
    has_error: bool,
}

impl Findings {
    /// Whether there are as many as are reported. A further error counts only if there is none yet.
    pub(crate) fn is_full(&self, is_error: bool) -> bool {
        self.found.len() >= MOST_FINDINGS && (self.has_error || !is_error)
    }

    /// Adds a finding, unless there are enough.
    pub(crate) fn add(&mut self, finding: Diagnostic) {
        if !self.is_full(finding.is_error()) {
            self.has_error |= finding.is_error();
            self.found.push(finding);
        }
    }

    /// Whether one of them is an error.
    pub(crate) fn has_error(&self) -> bool {
        self.has_error
    }

    /// The findings if none is an error.
    ///
    /// # Errors
    /// All of them if one is.
    pub(crate) fn warnings(self) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        if self.has_error { Err(self.found) } else { Ok(self.found) }
    }
}

/// Where the lines of a text begin: finding a line takes no longer at the end of a file than at its beginning.
#[derive(Debug)]
pub(crate) struct LineStarts(Vec<usize>);

impl LineStarts {
    /// The lines of a text.
    pub(crate) fn of(text: &str) -> Self {
        Self(std::iter::once(0).chain(text.match_indices('\n').map(|(end, _)| end + 1)).collect())
    }

    /// The line, from 1, in which a byte is.
    pub(crate) fn line(&self, byte: usize) -> u32 {
        u32::try_from(self.index(byte)).unwrap_or(u32::MAX)
    }

    /// The byte at which the line of a byte begins.
    pub(crate) fn start(&self, byte: usize) -> usize {
        self.index(byte).checked_sub(1).map_or(0, |index| self.0[index])
    }

    fn index(&self, byte: usize) -> usize {
        self.0.partition_point(|&start| start <= byte)
    }
}
