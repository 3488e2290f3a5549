//! Which paths are emitted: those of drawings, directories and names; without any, those that `[emit] targets` means.

use std::collections::{HashMap, HashSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Role, SourceFile, Target, check_file, path_names};
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;

use super::configured::Configured;
use super::store::Store;
use crate::Inputs;
use crate::session::{DrawingResult, Found, Session, Wanted};

/// The paths to emit, and what the run knows of beside them.
pub(super) struct Asked {
    /// Each path once.
    pub(super) targets: Vec<Target>,
    /// Drawings of which every path was considered.
    pub(super) covered: Vec<SourceFile>,
    /// What is known of them.
    pub(super) drawings: Drawings,
    /// The directories that were looked through for them: those in which outputs may be stale.
    pub(super) directories: Vec<Utf8PathBuf>,
}

/// What drawings say alone: from earlier runs, else from the drawings themselves.
pub(super) struct Drawings {
    known: HashMap<SourceFile, DrawingResult>,
    /// Those that were read.
    read: Vec<SourceFile>,
}

impl Drawings {
    /// Reads those that nothing is known of.
    fn new(session: &Session<'_>, store: Option<&Store>, files: &[SourceFile]) -> Self {
        let known = |file: &SourceFile| Some((*file, store?.drawing(file.path(session.db()))?));
        let known: HashMap<SourceFile, DrawingResult> = files.iter().filter_map(known).collect();
        let read: Vec<SourceFile> = files.iter().filter(|file| !known.contains_key(file)).copied().collect();
        session.read_ahead(&read);
        Self { known, read }
    }

    /// The names of a drawing's paths.
    pub(super) fn names<'a>(&'a self, session: &'a Session<'_>, file: SourceFile) -> &'a [PathName] {
        self.known.get(&file).map_or_else(|| path_names(session.db(), file), |known| &known.names)
    }

    /// What is wrong with a drawing as a whole.
    pub(super) fn diagnostics<'a>(&'a self, session: &'a Session<'_>, file: SourceFile) -> &'a [Diagnostic] {
        self.known.get(&file).map_or_else(|| check_file(session.db(), file), |known| &known.diagnostics)
    }

    /// Those of which nothing was known.
    pub(super) fn read(&self) -> impl Iterator<Item = &SourceFile> {
        self.read.iter()
    }
}

impl Asked {
    /// What the arguments mean, and what is wrong with them; `None` when there are none and the configuration names no targets. `found`: what
    /// is in the directories, if all arguments are directories.
    pub(super) fn new(
        session: &Session<'_>,
        store: Option<&Store>,
        inputs: &Inputs,
        found: Option<&Found>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let is_by_configuration = inputs.inputs.is_empty();
        if is_by_configuration
            && (session.workspace().settings.emit.targets.value.is_empty() || !session.has_library())
        {
            return None;
        }
        let (wanted, directories) = if let Some(Found { drawings, directories, problems, .. }) = found {
            diagnostics.extend_from_slice(problems);
            (session.wanted_drawings(drawings.clone()), directories.clone())
        } else {
            let wanted = session.wanted(inputs);
            let directories = session.directories_below(&wanted.directories);
            (wanted, directories)
        };
        let in_directories = wanted.drawings.iter().filter(|drawing| !drawing.is_named);
        let covered: Vec<SourceFile> = in_directories.map(|drawing| drawing.file).collect();
        let drawings = Drawings::new(session, store, &covered);
        let mut asking =
            Asking { session, drawings: &drawings, diagnostics, targets: Vec::new(), known: HashSet::new() };
        if is_by_configuration {
            asking.diagnostics.extend(wanted.problems);
            asking.configured(&covered);
        } else {
            asking.named(wanted, &covered);
        }
        Some(Self { targets: asking.targets, covered, drawings, directories })
    }

    /// The same with the paths in the order of the arguments, which decides what is milled first.
    pub(super) fn in_order(
        session: &Session<'_>,
        inputs: &Inputs,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        if inputs.inputs.is_empty() {
            return Self::new(session, None, inputs, None, diagnostics);
        }
        let drawings = Drawings::new(session, None, &[]);
        let mut all = Self { targets: Vec::new(), covered: Vec::new(), drawings, directories: Vec::new() };
        for input in &inputs.inputs {
            let input = Inputs { inputs: vec![input.clone()] };
            all.targets.extend(Self::new(session, None, &input, None, diagnostics)?.targets);
        }
        Some(all)
    }
}

struct Asking<'a> {
    session: &'a Session<'a>,
    drawings: &'a Drawings,
    diagnostics: &'a mut Vec<Diagnostic>,
    targets: Vec<Target>,
    known: HashSet<(SourceFile, PathName)>,
}

impl Asking<'_> {
    /// The paths whose names match a target's pattern.
    fn configured(&mut self, library: &[SourceFile]) {
        let drawings = self.drawings;
        let mut configured = Configured::new(&self.session.workspace().settings);
        for file in library {
            // A drawing that cannot be read may hold a target.
            let errors = drawings.diagnostics(self.session, *file).iter().filter(|found| found.is_error());
            self.diagnostics.extend(errors.cloned());
            for name in drawings.names(self.session, *file) {
                if configured.means(name.as_str()) {
                    self.add(*file, name);
                }
            }
        }
        self.diagnostics.extend(configured.unmet());
    }

    /// A drawing must hold just one path, unless it lies in a directory that was named.
    fn named(&mut self, wanted: Wanted, covered: &[SourceFile]) {
        let (db, drawings) = (self.session.db(), self.drawings);
        self.diagnostics.extend(wanted.problems);
        for drawing in wanted.drawings {
            let found = drawings.diagnostics(self.session, drawing.file);
            self.diagnostics.extend_from_slice(found);
            match drawings.names(self.session, drawing.file) {
                [] if drawing.is_named => self.diagnostics.extend(self.session.no_path(drawing.file)),
                [] => {}
                names @ [_, _, ..] if drawing.is_named => self.refuse_several(drawing.file, names),
                names => names.iter().for_each(|name| self.add(drawing.file, name)),
            }
        }
        for path in &wanted.paths {
            self.diagnostics.extend_from_slice(check_file(db, path.file));
            self.add(path.file, &path.name);
        }
        if self.targets.is_empty() && !self.diagnostics.iter().any(Diagnostic::is_error) {
            let parts = |file: &SourceFile| {
                (drawings.names(self.session, *file), drawings.diagnostics(self.session, *file))
            };
            self.diagnostics.extend(self.session.no_path_anywhere(covered.iter().map(parts)));
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
