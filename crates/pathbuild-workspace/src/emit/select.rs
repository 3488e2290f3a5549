//! Selects the paths to emit: those of the named drawings, directories and paths; without arguments, those matched by `[emit] targets`.

use std::collections::HashSet;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Role, SourceFile, Target};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_path::PathName;

use crate::common_findings::unused_configurations;
use crate::config::Settings;
use crate::config::types::Pattern;
use crate::memo::{Answer, DrawingResult, Memo, find, read_drawings, read_named};
use crate::session::{Argument, ArgumentMatches, Selection, Session, several_paths_error};

/// The paths to emit, and the drawings that were considered.
#[derive(Debug, Default)]
pub(super) struct TargetSelection {
    /// The paths to emit, each once. If paths are joined, a path occurs as often as the arguments name it.
    pub(super) targets: Vec<Target>,
    /// Drawings whose paths were all considered.
    pub(super) covered: Vec<Answer<DrawingResult>>,
    /// Drawings that were named, or that may define a named path.
    pub(super) named: Vec<Answer<DrawingResult>>,
    /// Directories that were searched for drawings, and that are therefore searched for stale programs as well.
    pub(super) directories: Vec<Utf8PathBuf>,
}

impl TargetSelection {
    /// Resolves the arguments. Returns `None` if there are none and the configuration names no targets or no library. Paths to be joined
    /// (`is_joined`) keep the order of the arguments, which is the milling order.
    pub(super) fn new(
        session: &Session<'_>,
        memo: &Memo,
        matches: &ArgumentMatches,
        is_joined: bool,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let has_targets = !session.workspace().settings.emit.targets.value.is_empty();
        if matches.is_library && (!has_targets || !session.has_library()) {
            return None;
        }
        let subject = |path: &Utf8PathBuf| path.as_str().into();
        let named = read_named(session, memo, matches.named_drawings(), subject);
        let names = |file: SourceFile| {
            find(&named, file.path(session.db())).map_or(&[][..], |drawing| &drawing.value.names)
        };
        let mut selection = Self::default();
        let is_in_order = is_joined && !matches.is_library;
        let groups: Vec<&[Argument]> =
            if is_in_order { matches.arguments.chunks(1).collect() } else { vec![&matches.arguments] };
        for group in groups {
            let resolved = session.select_arguments(matches, group, &names);
            diagnostics.extend_from_slice(&resolved.problems);
            diagnostics.extend(unused_configurations(session, &resolved.below));
            let covered = read_drawings(session, memo, &resolved.drawings, subject);
            let mut collector = TargetCollector {
                session,
                diagnostics: &mut *diagnostics,
                targets: Vec::new(),
                known: HashSet::new(),
            };
            if matches.is_library {
                collector.add_configured(&covered);
            } else {
                collector.add_selected(&resolved, &covered, &named);
            }
            selection.targets.extend(collector.targets);
            if !is_in_order {
                (selection.covered, selection.directories) = (covered, resolved.below);
            }
        }
        selection.named = named;
        Some(selection)
    }

    pub(super) fn drawings(&self) -> impl Iterator<Item = &Answer<DrawingResult>> {
        self.covered.iter().chain(&self.named)
    }
}

struct TargetCollector<'a> {
    session: &'a Session<'a>,
    diagnostics: &'a mut Vec<Diagnostic>,
    targets: Vec<Target>,
    known: HashSet<(SourceFile, PathName)>,
}

impl TargetCollector<'_> {
    fn add_configured(&mut self, library: &[Answer<DrawingResult>]) {
        let mut configured = TargetPatterns::new(&self.session.workspace().settings);
        for drawing in library {
            // An unreadable drawing may contain a target, so its errors are reported.
            let DrawingResult { names, diagnostics, .. } = &drawing.value;
            self.diagnostics.extend(diagnostics.iter().filter(|found| found.is_error()).cloned());
            for name in names.iter().filter(|name| configured.matches(name.as_str())) {
                self.add(drawing.drawing(), name);
            }
        }
        self.diagnostics.extend(configured.unmatched(self.session));
    }

    /// Adds the paths of the arguments. A drawing that is named itself must contain exactly one path.
    fn add_selected(
        &mut self,
        resolved: &Selection,
        covered: &[Answer<DrawingResult>],
        named: &[Answer<DrawingResult>],
    ) {
        for drawing in covered {
            self.diagnostics.extend_from_slice(&drawing.value.diagnostics);
            drawing.value.names.iter().for_each(|name| self.add(drawing.drawing(), name));
        }
        let db = self.session.db();
        let get = |file: SourceFile| find(named, file.path(db));
        for drawing in resolved.named.iter().filter_map(|file| get(*file)) {
            let (path, DrawingResult { names, diagnostics, .. }) = (drawing.drawing(), &drawing.value);
            self.diagnostics.extend_from_slice(diagnostics);
            match names.as_slice() {
                [] => self.diagnostics.extend(self.session.no_path_error(path, names, diagnostics)),
                [name] => self.add(path, name),
                names => self.refuse_several(path, names),
            }
        }
        for resolved in &resolved.paths {
            let Some(drawing) = get(resolved.file) else { continue };
            self.diagnostics.extend_from_slice(&drawing.value.diagnostics);
            self.add(drawing.drawing(), &resolved.name);
        }
        if self.targets.is_empty() && !self.diagnostics.iter().any(Diagnostic::is_error) {
            let parts = covered.iter().map(|drawing| drawing.value.parts());
            self.diagnostics.extend(self.session.no_path_anywhere_error(parts));
        }
    }

    /// Reports PB512, unless a path of the drawing has errors: such errors are the more likely cause, for example a line that strayed onto another
    /// path's layer and so made a second path.
    fn refuse_several(&mut self, drawing: &Utf8Path, names: &[PathName]) {
        let file = self.session.file(drawing);
        let checked = self.session.check(&self.session.targets(file, &Role::Checked));
        let diagnostics: Vec<Diagnostic> =
            checked.into_iter().flat_map(|checked| checked.diagnostics).collect();
        if diagnostics.iter().any(Diagnostic::is_error) {
            self.diagnostics.extend(diagnostics);
        } else {
            self.diagnostics.push(several_paths_error(drawing, names));
        }
    }

    fn add(&mut self, drawing: &Utf8Path, name: &PathName) {
        let file = self.session.file(drawing);
        if self.known.insert((file, name.clone())) {
            self.targets.push(self.session.db().target(file, name.as_str(), Role::Emitted));
        }
    }
}

/// A matcher of path names against the configured patterns, which records which patterns have matched.
pub struct TargetPatterns<'a> {
    settings: &'a Settings,
    /// For each pattern, whether it has matched any path.
    is_met: Vec<bool>,
}

impl<'a> TargetPatterns<'a> {
    /// Creates a matcher in which no pattern has matched yet.
    pub fn new(settings: &'a Settings) -> Self {
        Self { settings, is_met: vec![false; settings.emit.targets.value.len()] }
    }

    /// Returns true if a pattern matches this name, and records all patterns that do.
    pub fn matches(&mut self, name: &str) -> bool {
        let mut is_target = false;
        for (pattern, is_met) in self.settings.emit.targets.value.iter().zip(&mut self.is_met) {
            let matches = pattern.matches(name);
            is_target |= matches;
            *is_met |= matches;
        }
        is_target
    }

    /// Returns an error for each pattern that has matched nothing, which is a mistake in the configuration. Returns none if a directory of the library
    /// is missing or empty, because the paths may lie there.
    pub fn unmatched(&self, session: &Session<'_>) -> Vec<Diagnostic> {
        let targets = &self.settings.emit.targets;
        let unmatched = targets.value.iter().zip(&self.is_met).filter(|(_, is_met)| !**is_met);
        let problem = |(pattern, _): (&Pattern, _)| {
            let problem = Diagnostic::new(&messages::NO_TARGET).quoting("pattern", pattern.text());
            self.settings.locate(problem, targets.origin)
        };
        let problems: Vec<Diagnostic> = unmatched.map(problem).collect();
        if problems.is_empty() || session.is_whole_library(&session.library()) {
            problems
        } else {
            Vec::new()
        }
    }
}
