//! What is wrong with a path whose elements and texts have all been found, whatever its values are.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing as messages;

use crate::raw::RawPath;

/// A raw path while it is checked.
pub(super) struct Checked<'r> {
    pub(super) raw: &'r mut RawPath,
    /// A broken entity may be the marker, or the element of a text, that is missing: what may only follow from it is not reported.
    pub(super) has_broken_circle: bool,
    pub(super) has_broken_entity: bool,
}

impl Checked<'_> {
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        let name = self.raw.name.as_str();
        let is_placed = diagnostic.path.is_some();
        self.raw.diagnostics.push(if is_placed { diagnostic } else { diagnostic.in_path(name) });
    }

    /// A marker that is missing because its circle is broken is not reported twice.
    pub(super) fn check_markers(&mut self) {
        if self.has_broken_circle || self.raw.start.is_some() && self.raw.end.is_some() {
            return;
        }
        let missing = |message| {
            Diagnostic::new(message).with("name", self.raw.name.as_str()).with("layer", self.raw.layer())
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
