//! Selects the paths to emit: those of the named drawings, directories and paths; without arguments, those matched by `[emit] targets`.

use std::collections::HashSet;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Role, SourceFile, Target};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use super::EmitContext;
use super::target_patterns::TargetPatterns;
use crate::session::{Argument, Drawing, Drawings, Selection, Session, several_paths};

/// The paths to emit, and the drawings that were considered.
#[derive(Debug, Default)]
pub(super) struct TargetSelection {
    /// Each path; joined paths are listed as often as they were named.
    pub(super) targets: Vec<Target>,
    /// Drawings of which all paths were considered.
    pub(super) covered: Drawings,
    /// Drawings that were named, or that may define a named path.
    pub(super) named: Drawings,
    /// Directories that were searched for drawings, and in which outputs may be stale.
    pub(super) directories: Vec<Utf8PathBuf>,
}

impl TargetSelection {
    /// Resolves the arguments; `None` if there are none and the configuration names no targets. Paths to be joined keep the order of the
    /// arguments, which is the milling order.
    pub(super) fn new(
        session: &Session<'_>,
        context: &EmitContext<'_>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let EmitContext { request, store, found } = context;
        let has_targets = !session.workspace().settings.emit.targets.value.is_empty();
        if found.is_library && (!has_targets || !session.has_library()) {
            return None;
        }
        let known = |drawing: &Utf8Path| store.as_ref()?.drawing(drawing);
        let mut named: Vec<Utf8PathBuf> = found.named().map(|file| file.path(session.db()).clone()).collect();
        named.sort_unstable_by(|a, b| a.as_str().cmp(b.as_str()));
        named.dedup();
        let named = Drawings::new(session, named, known);
        let names = |file: SourceFile| {
            named.get(file.path(session.db())).map_or(&[][..], |drawing| &drawing.result.names)
        };
        let mut selection = Self::default();
        let is_in_order = request.join.is_some() && !found.is_library;
        let groups: Vec<&[Argument]> =
            if is_in_order { found.arguments.chunks(1).collect() } else { vec![&found.arguments] };
        for group in groups {
            let resolved = session.select_arguments(found, group, &names);
            diagnostics.extend_from_slice(&resolved.problems);
            let covered = Drawings::new(session, resolved.drawings.clone(), known);
            let mut collector = TargetCollector {
                session,
                diagnostics: &mut *diagnostics,
                targets: Vec::new(),
                known: HashSet::new(),
            };
            if found.is_library {
                collector.configured(&covered);
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

    /// All drawings that were considered.
    pub(super) fn drawings(&self) -> impl Iterator<Item = &Drawing> {
        self.covered.iter().chain(self.named.iter())
    }
}

struct TargetCollector<'a> {
    session: &'a Session<'a>,
    diagnostics: &'a mut Vec<Diagnostic>,
    targets: Vec<Target>,
    known: HashSet<(SourceFile, PathName)>,
}

impl TargetCollector<'_> {
    /// Adds the paths matched by the configured patterns.
    fn configured(&mut self, library: &Drawings) {
        let mut configured = TargetPatterns::new(&self.session.workspace().settings);
        for Drawing { path, result, .. } in library.iter() {
            // An unreadable drawing may contain a target, so its errors matter.
            self.diagnostics.extend(result.diagnostics.iter().filter(|found| found.is_error()).cloned());
            for name in &result.names {
                if configured.matches(name.as_str()) {
                    self.add(path, name);
                }
            }
        }
        self.diagnostics.extend(configured.unmatched());
    }

    /// Adds the paths of the arguments. A drawing that is named itself must contain exactly one path.
    fn add_selected(&mut self, resolved: &Selection, covered: &Drawings, named: &Drawings) {
        for Drawing { path, result, .. } in covered.iter() {
            self.diagnostics.extend_from_slice(&result.diagnostics);
            result.names.iter().for_each(|name| self.add(path, name));
        }
        let db = self.session.db();
        let get = |file: SourceFile| named.get(file.path(db));
        for Drawing { path, result, .. } in resolved.named.iter().filter_map(|file| get(*file)) {
            self.diagnostics.extend_from_slice(&result.diagnostics);
            match result.names.as_slice() {
                [] => self.diagnostics.extend(self.session.no_path(path, &result.names, &result.diagnostics)),
                [name] => self.add(path, name),
                names => self.refuse_several(path, names),
            }
        }
        for resolved in &resolved.paths {
            let Some(Drawing { path, result, .. }) = get(resolved.file) else { continue };
            self.diagnostics.extend_from_slice(&result.diagnostics);
            self.add(path, &resolved.name);
        }
        if self.targets.is_empty() && !self.diagnostics.iter().any(Diagnostic::is_error) {
            let parts = covered.iter().map(|drawing| drawing.result.parts());
            self.diagnostics.extend(self.session.no_path_anywhere(parts));
        }
    }

    /// PB512, unless a path of the drawing has errors: these are the more likely cause, for example a line that strayed onto another path's
    /// layer and so made a second path.
    fn refuse_several(&mut self, drawing: &Utf8Path, names: &[PathName]) {
        let file = self.session.file(drawing);
        let checked = self.session.check(&self.session.targets(file, &Role::Checked));
        let diagnostics: Vec<Diagnostic> =
            checked.into_iter().flat_map(|checked| checked.diagnostics).collect();
        if diagnostics.iter().any(Diagnostic::is_error) {
            self.diagnostics.extend(diagnostics);
        } else {
            self.diagnostics.push(several_paths(drawing, names));
        }
    }

    fn add(&mut self, drawing: &Utf8Path, name: &PathName) {
        let file = self.session.file(drawing);
        if self.known.insert((file, name.clone())) {
            self.targets.push(self.session.target_in(file, name, Role::Emitted));
        }
    }
}
