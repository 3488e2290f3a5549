//! What a run found, made ready to be shown: severities applied, each finding once, in an order that does not depend on threads.
//! (book: reference/diagnostics)

mod judge;

use pathbuild_diagnostic::{Code, Diagnostic};

use crate::check::CheckedFile;
use crate::workspace::Workspace;

pub use judge::judge;

/// Everything that a run found, and what it looked at.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Sorted, without repetition.
    pub diagnostics: Vec<Diagnostic>,
    /// The drawings that were checked, in order of name; empty for commands that check none.
    pub checked: Vec<CheckedFile>,
}

impl Findings {
    /// Sorts diagnostics and drops those that say the same of the same place: many bindings or projects may have met a fault, and
    /// the one that is kept has the shortest way, of those the first in order, whichever was met first.
    pub fn new(mut diagnostics: Vec<Diagnostic>) -> Self {
        if diagnostics.iter().any(|diagnostic| !diagnostic.trace.is_empty()) {
            diagnostics.sort_by_cached_key(|it| (it.trace.len(), format!("{:?}", it.trace)));
        }
        diagnostics
            .sort_by(|a, b| a.sort_key().cmp(&b.sort_key()).then_with(|| a.message.key.cmp(b.message.key)));
        diagnostics.dedup_by(|later, earlier| is_same(earlier, later));
        Self { diagnostics, checked: Vec::new() }
    }

    /// The number of errors.
    pub fn errors(&self) -> usize {
        self.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count()
    }

    /// The number of warnings.
    pub fn warnings(&self) -> usize {
        self.diagnostics.len() - self.errors()
    }
}

impl Workspace {
    /// Findings with the severities of the configuration, in order, each once.
    pub fn findings(&self, diagnostics: Vec<Diagnostic>) -> Findings {
        Findings::new(judge(diagnostics, &self.settings, &self.working_directory))
    }
}

/// Whether two findings are one: everything is equal but the way that led there. What is too deep below one project may be so below
/// others, each by its own way.
fn is_same(a: &Diagnostic, b: &Diagnostic) -> bool {
    let arguments_agree = a.arguments == b.arguments || a.code() == Code::NestingTooDeep;
    arguments_agree
        && (a.message, &a.file, &a.path, &a.place, &a.text)
            == (b.message, &b.file, &b.path, &b.place, &b.text)
}
