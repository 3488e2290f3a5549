//! Code shared by both engines: the findings of a definition, limits, and the output.

use camino::Utf8Path;
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Message, Note, Value};

use crate::rs274_translation::TranslatedText;

/// Maximum number of findings reported per definition. After correcting these, the user sees the next ones.
pub(crate) const MAX_FINDINGS: usize = 100;

/// Findings about a definition, in the order in which they were added. Their number is limited, because in a large file every byte might
/// cause one.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    found: Vec<Diagnostic>,
    pub(crate) has_error: bool,
}

impl Findings {
    /// Whether the limit is reached, so that a finding would be dropped. The first error is always accepted.
    pub(crate) fn is_full(&self, is_error: bool) -> bool {
        self.found.len() >= MAX_FINDINGS && (self.has_error || !is_error)
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
    pub(crate) fn into_result(self) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        if self.has_error { Err(self.found) } else { Ok(self.found) }
    }
}

/// Offset at which each line of a text begins, for finding the line of a byte quickly in large files.
#[derive(Debug)]
pub(crate) struct LineStarts(Vec<usize>);

impl LineStarts {
    pub(crate) fn of(text: &str) -> Self {
        Self(std::iter::once(0).chain(text.match_indices('\n').map(|(end, _)| end + 1)).collect())
    }

    /// Returns the line of the byte at an offset, counted from 1.
    pub(crate) fn line(&self, byte: usize) -> u32 {
        u32::try_from(self.index(byte)).unwrap_or(u32::MAX)
    }

    /// Returns the offset at which the line of a byte begins.
    pub(crate) fn line_start(&self, byte: usize) -> usize {
        self.index(byte).checked_sub(1).map_or(0, |index| self.0[index])
    }

    fn index(&self, byte: usize) -> usize {
        self.0.partition_point(|&start| start <= byte)
    }
}

/// The output of an engine: the text of a program, its translation, and findings about it.
#[derive(Default)]
pub(crate) struct EngineOutput {
    pub(crate) text: Vec<u8>,
    /// The translation of the text to RS274.
    pub(crate) translation: TranslatedText,
    pub(crate) origins: Vec<LineOrigin>,
    /// Warnings about doubtful constructs in the definition or the text.
    pub(crate) warnings: Vec<Diagnostic>,
    /// Notes, for example on functions that the job switches but the text does not.
    pub(crate) notes: Vec<Note>,
    /// Whether the texts switch the coolant as the job says.
    pub(crate) follows_coolant: bool,
    /// The command that the definition asks to run on the finished file, as program and arguments.
    pub(crate) post_build: Option<Vec<String>>,
}

impl EngineOutput {
    pub(crate) fn note(&mut self, message: &'static Message, name: &'static str, value: &str) {
        self.notes.push(Note { message, arguments: vec![(name, Value::quoted(value))] });
    }
}

/// Number of bytes that may still be written. This limit ends the expansion of macros that multiply text.
pub(crate) struct OutputBudget(usize);

impl OutputBudget {
    /// Creates a budget for a job with this number of steps: a fixed part, and a share for each step.
    pub(crate) fn new(steps: usize) -> Self {
        let mut fuel = Self(1 << 20);
        fuel.add_steps(steps);
        fuel
    }

    pub(crate) fn add_steps(&mut self, steps: usize) {
        self.0 = self.0.saturating_add(steps.saturating_mul(1 << 12));
    }

    pub(crate) fn spend(&mut self, cost: usize, file: &Utf8Path) -> Result<(), Box<Diagnostic>> {
        let rest = self.0.checked_sub(cost);
        self.0 = rest.ok_or_else(|| Box::new(Diagnostic::new(&posts::MACRO_SIZE).in_file(file)))?;
        Ok(())
    }
}

/// The part of a definition that produced a line of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LineOrigin {
    /// Name of the section or control text.
    pub(crate) section: &'static str,
    /// Line of the definition's file, counted from 1; 0 if the text is the default for an absent one.
    pub(crate) line: u32,
}
