//! Which paths are emitted: those of drawings, directories and names; without any, those that `[emit] targets` means.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Role, SourceFile, Target, check_file, path_names};
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;

use super::configured::Configured;
use crate::context::Context;
use pathbuild_workspace::Inputs;
use pathbuild_workspace::session::{Session, Wanted};

/// The paths to emit, and what the run knows of beside them.
pub(super) struct Asked {
    /// Each path once.
    pub(super) targets: Vec<Target>,
    /// Drawings of which every path was considered.
    pub(super) covered: Vec<SourceFile>,
    /// The directories that they lie in or below; nothing else is looked for stale outputs.
    pub(super) directories: Vec<Utf8PathBuf>,
}

impl Asked {
    /// What the arguments mean, and what is wrong with them; `None` when there are none and the configuration names no targets.
    pub(super) fn new(
        context: &Context,
        session: &Session<'_>,
        inputs: &Inputs,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let is_by_configuration = inputs.inputs.is_empty();
        if is_by_configuration && (context.settings.emit.targets.value.is_empty() || !session.has_library()) {
            return None;
        }
        let wanted = session.wanted(inputs);
        let mut asking = Asking { context, session, diagnostics, targets: Vec::new() };
        let in_directories = wanted.drawings.iter().filter(|drawing| !drawing.is_named);
        let covered: Vec<SourceFile> = in_directories.map(|drawing| drawing.file).collect();
        let directories = wanted.directories.clone();
        session.read_ahead(&covered);
        if is_by_configuration {
            asking.configured(&covered);
        } else {
            asking.named(wanted);
        }
        Some(Self { targets: asking.targets, covered, directories })
    }
}

impl Asked {
    /// The same with the paths in the order of the arguments, which decides what is milled first.
    pub(super) fn in_order(
        context: &Context,
        session: &Session<'_>,
        inputs: &Inputs,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let mut all = Self { targets: Vec::new(), covered: Vec::new(), directories: Vec::new() };
        if inputs.inputs.is_empty() {
            return Self::new(context, session, inputs, diagnostics);
        }
        for input in &inputs.inputs {
            let input = Inputs { inputs: vec![input.clone()] };
            all.targets.extend(Self::new(context, session, &input, diagnostics)?.targets);
        }
        Some(all)
    }
}

struct Asking<'a> {
    context: &'a Context,
    session: &'a Session<'a>,
    diagnostics: &'a mut Vec<Diagnostic>,
    targets: Vec<Target>,
}

impl Asking<'_> {
    /// The paths whose names match a target's pattern.
    fn configured(&mut self, library: &[SourceFile]) {
        let db = self.session.db();
        let mut configured = Configured::new(&self.context.settings);
        for file in library {
            // A drawing that cannot be read may hold a target.
            self.diagnostics.extend(check_file(db, *file).iter().filter(|found| found.is_error()).cloned());
            for name in path_names(db, *file) {
                if configured.means(name.as_str()) {
                    self.add(*file, name);
                }
            }
        }
        self.diagnostics.extend(configured.unmet());
    }

    /// A drawing must hold just one path, unless it lies in a directory that was named.
    fn named(&mut self, wanted: Wanted) {
        let db = self.session.db();
        self.diagnostics.extend(wanted.problems);
        for drawing in wanted.drawings {
            let found = check_file(db, drawing.file);
            self.diagnostics.extend_from_slice(found);
            let is_unreadable = found.iter().any(Diagnostic::is_error);
            match path_names(db, drawing.file) {
                [] if is_unreadable || !drawing.is_named => {}
                [] => self.diagnostics.push(self.no_path(drawing.file.path(db))),
                names @ [_, _, ..] if drawing.is_named => self.refuse_several(drawing.file, names),
                names => names.iter().for_each(|name| self.add(drawing.file, name)),
            }
        }
        for path in &wanted.paths {
            self.diagnostics.extend_from_slice(check_file(db, path.file));
            self.add(path.file, &path.name);
        }
    }

    /// PB512, unless a path of the drawing is wrong as drawn: then that is the nearer cause, such as a line that strayed onto another
    /// path's layer and made a second path.
    fn refuse_several(&mut self, file: SourceFile, names: &[PathName]) {
        let checked = self.session.check(&self.session.targets(file, &Role::Checked));
        let found: Vec<Diagnostic> = checked.into_iter().flat_map(|checked| checked.diagnostics).collect();
        if found.iter().any(Diagnostic::is_error) {
            self.diagnostics.extend(found);
        } else {
            self.diagnostics.push(several_paths(file.path(self.session.db()), names));
        }
    }

    fn add(&mut self, file: SourceFile, name: &PathName) {
        let db = self.session.db();
        let is_known = |target: &Target| target.file(db) == file && **target.name(db) == *name.as_str();
        if !self.targets.iter().any(is_known) {
            self.targets.push(self.session.target_in(file, name, Role::Emitted));
        }
    }

    fn no_path(&self, file: &Utf8Path) -> Diagnostic {
        let pattern = &*self.context.settings.general.path_pattern.value;
        Diagnostic::new(&messages::NO_PATH).with("pattern", pattern).in_file(file)
    }
}

fn several_paths(file: &Utf8Path, names: &[PathName]) -> Diagnostic {
    let list: Value = names.iter().map(PathName::as_str).collect();
    Diagnostic::new(&messages::SEVERAL_PATHS)
        .with("names", list)
        .with("first", names[0].as_str())
        .in_file(file)
}
