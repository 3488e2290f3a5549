use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, clean, join};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::configuration as messages;

use crate::files;
use crate::inputs::{Input, Inputs};

/// File name of a configuration.
pub const FILE_NAME: &str = "pathbuild.toml";

/// Searches for configurations.
pub(super) struct Discovery<'a> {
    pub(super) system: &'a dyn System,
    pub(super) inputs: &'a Inputs,
    pub(super) working_directory: &'a Utf8Path,
}

impl Discovery<'_> {
    /// The configuration of a run: the one above the first argument. If the argument is a program without a configuration above it, the
    /// next argument decides, and finally the working directory.
    pub(super) fn for_run(&self) -> Option<Utf8PathBuf> {
        for input in self.inputs.iter() {
            let configuration = self.above(&self.search_start_of(input));
            if configuration.is_some() || !input.is_program(|place| self.is_directory(place)) {
                return configuration;
            }
        }
        self.of_working_directory()
    }

    /// The configuration that applies in the working directory.
    pub(super) fn of_working_directory(&self) -> Option<Utf8PathBuf> {
        self.above(&clean(self.working_directory))
    }

    /// The directory of a run without configuration: that of the first argument.
    pub(super) fn search_start(&self) -> Utf8PathBuf {
        let first = self.inputs.iter().next();
        first.map_or_else(|| clean(self.working_directory), |first| self.search_start_of(first))
    }

    /// The directories of all arguments.
    pub(super) fn search_starts(&self) -> impl Iterator<Item = Utf8PathBuf> + '_ {
        self.inputs.iter().map(|input| self.search_start_of(input))
    }

    /// Whether this configuration applies to a program although the working directory has another one, or the program lies outside its tree.
    pub(super) fn is_unexpected(&self, file: &Utf8Path) -> bool {
        let tree = file.parent().unwrap_or(Utf8Path::new(""));
        let mut programs =
            self.inputs.iter().filter(|input| input.is_program(|place| self.is_directory(place))).peekable();
        programs.peek().is_some() && self.of_working_directory().as_deref() != Some(file)
            || programs.any(|program| !self.search_start_of(program).starts_with(tree))
    }

    fn search_start_of(&self, input: Input<'_>) -> Utf8PathBuf {
        clean(&self.working_directory.join(input.search_start(|place| self.is_directory(place))))
    }

    /// The configuration of a directory: the one in it, or else in the nearest directory above.
    pub(super) fn above(&self, directory: &Utf8Path) -> Option<Utf8PathBuf> {
        let mut files = directory.ancestors().map(|directory| join(directory, FILE_NAME));
        // A directory of this name, or a dangling link, counts as a configuration that cannot be read.
        let is_one = |file: &Utf8PathBuf| match self.system.kind(file) {
            FileKind::File | FileKind::Directory => true,
            FileKind::Missing => files::is_named(file),
        };
        files.find(is_one)
    }

    /// Diagnostics for arguments whose configuration is not the one of the run.
    pub(super) fn misplaced_inputs(&self, used: Option<&Utf8Path>) -> Vec<Diagnostic> {
        let place = |input: Input<'_>| match input {
            Input::Place(place) => Some(place.to_owned()),
            Input::Name(name) => self.is_directory(name.into()).then(|| name.into()),
        };
        let stranger = |place: Utf8PathBuf| {
            let other = self.above(&clean(&self.working_directory.join(&place)))?;
            (Some(&*other) != used).then(|| misplaced_input(&place, &other, used))
        };
        self.inputs.iter().filter_map(place).filter_map(stranger).collect()
    }

    /// Whether the argument is a directory; it may be one even if it contains no separator.
    fn is_directory(&self, place: &Utf8Path) -> bool {
        self.system.kind(&self.working_directory.join(place)) == FileKind::Directory
    }
}

/// The root of the Git repository that contains a directory, or the directory itself if there is none.
pub fn repository<'a>(system: &dyn System, directory: &'a Utf8Path) -> &'a Utf8Path {
    let is_repository = |directory: &&Utf8Path| system.kind(&directory.join(".git")) != FileKind::Missing;
    directory.ancestors().find(is_repository).unwrap_or(directory)
}

/// The repository that files of an untrusted tree must not lead out of. A symbolic link inside a repository does not lead into another one.
pub(super) fn confining<'a>(system: &dyn System, directory: &'a Utf8Path) -> &'a Utf8Path {
    let is_link = |place: &&Utf8Path| {
        let (Some(parent), Some(name)) = (place.parent(), place.file_name()) else { return false };
        system.canonical(place) != system.canonical(parent).join(name)
    };
    let is_repository = |place: &&Utf8Path| system.kind(&place.join(".git")) != FileKind::Missing;
    let outermost = directory.ancestors().filter(is_link).last();
    let around = outermost.and_then(|link| link.ancestors().skip(1).find(is_repository));
    around.unwrap_or_else(|| repository(system, directory))
}

fn misplaced_input(place: &Utf8Path, other: &Utf8Path, used: Option<&Utf8Path>) -> Diagnostic {
    let message =
        if used.is_some() { &messages::OTHER_CONFIGURATION } else { &messages::UNEXPECTED_CONFIGURATION };
    let diagnostic =
        Diagnostic::new(message).quoting("argument", place.as_str()).quoting("other", other.as_str());
    match used {
        Some(used) => diagnostic.quoting("used", used.as_str()),
        None => diagnostic,
    }
}
