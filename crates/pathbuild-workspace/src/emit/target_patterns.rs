//! Matches paths against `[emit] targets`. (book: reference/configuration)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;

use crate::config::{Origin, Settings};

/// Matches path names against the configured patterns, one after the other.
pub struct TargetPatterns<'a> {
    settings: &'a Settings,
    /// For each pattern, whether a path has matched it.
    is_met: Vec<bool>,
}

impl<'a> TargetPatterns<'a> {
    /// Starts with no pattern matched.
    pub fn new(settings: &'a Settings) -> Self {
        Self { settings, is_met: vec![false; settings.emit.targets.value.len()] }
    }

    /// Whether a pattern matches the path of this name.
    pub fn matches(&mut self, name: &str) -> bool {
        let mut is_target = false;
        for (pattern, is_met) in self.settings.emit.targets.value.iter().zip(&mut self.is_met) {
            let matches = pattern.matches(name);
            is_target |= matches;
            *is_met |= matches;
        }
        is_target
    }

    /// Warns about patterns that matched nothing: they are mistakes in the configuration.
    pub fn unmatched(&self) -> impl Iterator<Item = Diagnostic> {
        let targets = &self.settings.emit.targets;
        let unmatched = targets.value.iter().zip(&self.is_met).filter(|(_, is_met)| !**is_met);
        unmatched.map(|(pattern, _)| {
            let problem = Diagnostic::new(&messages::NO_TARGET).quoting("pattern", pattern.text());
            match (&self.settings.file, targets.origin) {
                (Some(file), Origin::File(line)) => problem.in_file(file).at_line(line, None),
                _ => problem,
            }
        })
    }
}
