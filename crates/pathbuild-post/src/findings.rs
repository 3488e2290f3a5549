//! Collects the errors and warnings of a definition. Their number is limited, because in a large file every byte might cause one.

use pathbuild_diagnostic::Diagnostic;

/// Maximum number of findings reported per definition. After correcting them, the user sees the next ones.
pub(crate) const MOST_FINDINGS: usize = 100;

/// Findings in the order in which they were added.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    found: Vec<Diagnostic>,
    /// Whether any finding is an error.
    pub(crate) has_error: bool,
}

impl Findings {
    /// Whether the limit is reached. Beyond it, an error is still accepted if there is none yet.
    pub(crate) fn is_full(&self, is_error: bool) -> bool {
        self.found.len() >= MOST_FINDINGS && (self.has_error || !is_error)
    }

    /// Adds a finding, unless the limit is reached.
    pub(crate) fn add(&mut self, finding: Diagnostic) {
        if !self.is_full(finding.is_error()) {
            self.has_error |= finding.is_error();
            self.found.push(finding);
        }
    }

    /// Returns the findings if none of them is an error.
    ///
    /// # Errors
    /// All findings if one of them is an error.
    pub(crate) fn warnings(self) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        if self.has_error { Err(self.found) } else { Ok(self.found) }
    }
}

/// The start of each line of a text, so that the line of a byte is found quickly anywhere in a file.
#[derive(Debug)]
pub(crate) struct LineStarts(Vec<usize>);

impl LineStarts {
    /// Finds the lines of a text.
    pub(crate) fn of(text: &str) -> Self {
        Self(std::iter::once(0).chain(text.match_indices('\n').map(|(end, _)| end + 1)).collect())
    }

    /// The line of a byte, counted from 1.
    pub(crate) fn line(&self, byte: usize) -> u32 {
        u32::try_from(self.index(byte)).unwrap_or(u32::MAX)
    }

    /// The start of the line that contains a byte.
    pub(crate) fn start(&self, byte: usize) -> usize {
        self.index(byte).checked_sub(1).map_or(0, |index| self.0[index])
    }

    fn index(&self, byte: usize) -> usize {
        self.0.partition_point(|&start| start <= byte)
    }
}

// Records which text of a definition produced a line of the output.

/// The text of a definition that produced a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LineOrigin {
    /// Name of the section or control text.
    pub(crate) section: &'static str,
    /// Line of the definition's file, counted from 1; 0 if the text is the default for an absent one.
    pub(crate) line: u32,
}
