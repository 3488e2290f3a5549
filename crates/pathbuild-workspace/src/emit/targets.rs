//! Which paths are emitted: those of drawings, directories and names; without any, those that `[emit] targets` means.

use std::collections::HashSet;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Role, SourceFile, Target};
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;

use super::Making;
use super::configured::Configured;
use crate::session::{Argument, Drawing, Drawings, Session, Wanted};

/// The paths to emit, and what the run knows of beside them.
#[derive(Debug, Default)]
pub(super) struct Selection {
    /// Each path, once for each time that it was asked for.
    pub(super) targets: Vec<Target>,
    /// Drawings of which every path was considered.
    pub(super) covered: Drawings,
    /// Drawings that were named, or that may define a path that was named.
    pub(super) named: Drawings,
    /// The directories that were looked through for them: those in which outputs may be stale.
    pub(super) directories: Vec<Utf8PathBuf>,
}

impl Selection {
    /// What the arguments mean, and what is wrong with them; `None` when there are none and the configuration names no targets. Paths that are
    /// joined are in the order of the arguments, which decides what is milled first.
    pub(super) fn new(
        session: &Session<'_>,
        making: &Making<'_>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let Making { request, store, found } = making;
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
            named.get(file.path(session.db())).map_or(&[][..], |drawing| &drawing.said.names)
        };
        let mut asked = Self::default();
        let is_in_order = request.join.is_some() && !found.is_library;
        let groups: Vec<&[Argument]> =
            if is_in_order { found.arguments.chunks(1).collect() } else { vec![&found.arguments] };
        for group in groups {
            let wanted = session.meant(found, group, &names);
            diagnostics.extend_from_slice(&wanted.problems);
            let covered = Drawings::new(session, wanted.drawings.clone(), known);
            let mut asking = Asking {
                session,
                diagnostics: &mut *diagnostics,
                targets: Vec::new(),
                known: HashSet::new(),
            };
            if found.is_library {
                asking.configured(&covered);
            } else {
                asking.wanted(&wanted, &covered, &named);
            }
            asked.targets.extend(asking.targets);
            if !is_in_order {
                (asked.covered, asked.directories) = (covered, wanted.below);
            }
        }
        asked.named = named;
        Some(asked)
    }

    /// Every drawing.
    pub(super) fn drawings(&self) -> impl Iterator<Item = &Drawing> {
        self.covered.iter().chain(self.named.iter())
    }
}

struct Asking<'a> {
    session: &'a Session<'a>,
    diagnostics: &'a mut Vec<Diagnostic>,
    targets: Vec<Target>,
    known: HashSet<(SourceFile, PathName)>,
}

impl Asking<'_> {
    /// The paths whose names match a target's pattern.
    fn configured(&mut self, library: &Drawings) {
        let mut configured = Configured::new(&self.session.workspace().settings);
        for Drawing { path, said, .. } in library.iter() {
            // A drawing that cannot be read may hold a target.
            self.diagnostics.extend(said.diagnostics.iter().filter(|found| found.is_error()).cloned());
            for name in &said.names {
                if configured.means(name.as_str()) {
                    self.add(path, name);
                }
            }
        }
        self.diagnostics.extend(configured.unmet());
    }

    /// A drawing must hold just one path, unless it lies in a directory that was named.
    fn wanted(&mut self, wanted: &Wanted, covered: &Drawings, named: &Drawings) {
        for Drawing { path, said, .. } in covered.iter() {
            self.diagnostics.extend_from_slice(&said.diagnostics);
            said.names.iter().for_each(|name| self.add(path, name));
        }
        let db = self.session.db();
        let get = |file: SourceFile| named.get(file.path(db));
        for Drawing { path, said, .. } in wanted.named.iter().filter_map(|file| get(*file)) {
            self.diagnostics.extend_from_slice(&said.diagnostics);
            match said.names.as_slice() {
                [] => self.diagnostics.extend(self.session.no_path(path, said)),
                [name] => self.add(path, name),
                names => self.refuse_several(path, names),
            }
        }
        for wanted in &wanted.paths {
            let Some(Drawing { path, said, .. }) = get(wanted.file) else { continue };
            self.diagnostics.extend_from_slice(&said.diagnostics);
            self.add(path, &wanted.name);
        }
        if self.targets.is_empty() && !self.diagnostics.iter().any(Diagnostic::is_error) {
            let parts = covered.iter().map(|drawing| drawing.said.parts());
            self.diagnostics.extend(self.session.no_path_anywhere(parts));
        }
    }

    /// PB512, unless a path of the drawing is wrong as drawn: then that is the nearer cause, such as a line that strayed onto another
    /// path's layer and made a second path.
    fn refuse_several(&mut self, drawing: &Utf8Path, names: &[PathName]) {
        let file = self.session.file(drawing);
        let checked = self.session.check(&self.session.targets(file, &Role::Checked));
        let found: Vec<Diagnostic> = checked.into_iter().flat_map(|checked| checked.diagnostics).collect();
        if found.iter().any(Diagnostic::is_error) {
            self.diagnostics.extend(found);
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

fn several_paths(file: &Utf8Path, names: &[PathName]) -> Diagnostic {
    let list: Value = names.iter().map(PathName::as_str).collect();
    Diagnostic::new(&messages::SEVERAL_PATHS)
        .with("names", list)
        .with("first", names[0].as_str())
        .in_file(file)
}
