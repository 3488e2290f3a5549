//! Checks a path once all its elements and texts are known, independently of values.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use crate::raw::RawPath;

/// A raw path being checked.
pub(super) struct PathCheck<'r> {
    pub(super) raw: &'r mut RawPath,
}

impl PathCheck<'_> {
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        let name = self.raw.name.as_str();
        let is_placed = diagnostic.path.is_some();
        self.raw.diagnostics.push(if is_placed { diagnostic } else { diagnostic.in_path(name) });
    }

    /// Reports missing markers.
    pub(super) fn check_markers(&mut self) {
        if self.raw.start.is_some() && self.raw.end.is_some() {
            return;
        }
        let missing = |message| {
            Diagnostic::new(message)
                .quoting("name", self.raw.name.as_str())
                .quoting("layer", self.raw.layer())
        };
        let start = self.raw.start.is_none().then(|| missing(&messages::MISSING_START));
        let end = self.raw.end.is_none().then(|| missing(&messages::MISSING_END));
        let somewhere = self.raw.drawn.elements.first().map(|element| self.raw.drawn.origin(element));
        for diagnostic in start.into_iter().chain(end) {
            let placed = match &somewhere {
                Some(origin) => origin.at(diagnostic),
                None => diagnostic,
            };
            self.report(placed);
        }
    }
}
